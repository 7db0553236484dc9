"""python3 -m hvi shield, --write, judge: the input is straight, its chain has the same bits however it is cut, and rules say what numbers mean."""

import math
import re
import types

import numpy as np
import pytest
import yaml
from hvi import cli, errors
from hvi.shield import chain, decision, record, script, verdict
from hvi.shield import case as cases
from shield_runs import write_record

CASE = """projectile: {diameter_mm: 3, material: Al2017-T4}
speed_km_s: 5
walls:
  - {thickness_mm: 0.75, material: Al6061-T6}
  - {thickness_mm: 2.25, material: Al2024-T3, gap_mm: 8}
spacings_mm: [0.75]
shifts: [0]
settings: {tstop: 8}
"""


def read(path, text=CASE):
    path.write_text(text)
    return cases.read(path)


@pytest.mark.parametrize("change", [("", ""), ("speed_km_s: 5", "speed_km_s: 5\nangle_deg: 40"), ("tstop: 8", "tstop: 8, edge: clamp, rim: 1"), ("tstop: 8", "tstop: 8, debris: yes"), ("gap_mm: 8", "gap_mm: 8, core_mm: 3, spacings_mm: [0.5]")])
def test_inputs_are_straight(tmp_path, change):
    """no label, jump or condition; at most 80 lines; the second differs only where it goes on"""
    for new in (True, False):
        text = chain.shield_of(read(tmp_path / "c.yaml", CASE.replace(*change)), 0, 0.0).text(new)
        lines = text.splitlines()
        assert len(lines) <= 80 + (15 if "edge" in change[1] else 5 if "debris" in change[1] else 0), len(lines)
        assert not [line for line in lines if re.match(r"\s*(label|jump|next|if|include)\b", line)] and text.isascii(), new
        assert ("read_restart" in text) is not new and ("create_atoms" in text) is new
    first, second = (chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0).text(new).splitlines() for new in (True, False))
    assert first[first.index("fix             move all hvi/sph"):] == second[second.index("fix             move all hvi/sph"):]


@pytest.mark.parametrize("thickness, gap, material, more", [(2.25, 8.25, "Al2024-T3", 3), (2.25, 8.1, "Al2024-T3", 4), (1.5, 8.25, "Al6061-T6", 4), (2.0, 8.1, "Al6061-T6", 5)])
def test_lines_of_a_further_wall(tmp_path, thickness, gap, material, more):
    """region, create_atoms, a row of compute hvi/wall; a lattice of its own and a law of its own where they differ"""
    wall = f"  - {{thickness_mm: {thickness}, material: {material}, gap_mm: {gap}}}\n"
    two, three = (len(chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("spacings_mm", new + "spacings_mm")), 0, 0.0).text().splitlines()) for new in ("", wall))
    assert three - two == more and two <= 73


def test_frames(tmp_path):
    """those of a case go on as long as the run may, and the plan has room for them; a search, which would remove them, writes none"""
    own = read(tmp_path / "c.yaml", CASE.replace("tstop: 8", "film: 0.5"))
    shield = chain.shield_of(own, 0, 0.0)
    assert shield.latest_us > shield.geometry.tstop_us and chain.size_of(shield)["frames"] == math.floor(shield.latest_us / 0.5) + 2
    patterns = ["cloud*.dump", "film.*.dump"]
    for case, frames in ((read(tmp_path / "c.yaml"), False), (own, True)):
        assert ("every/time" in decision.job(case, (0, 0.0), tmp_path, "x", remove=patterns).shield.text()) is frames
        assert "every/time" in decision.job(case, (0, 0.0), tmp_path, "x").shield.text()


@pytest.mark.parametrize("change", [("", ""), ("gap_mm: 8", "gap_mm: 8, core_mm: 3, spacings_mm: [0.5]"), ("tstop: 8", "tstop: 8, debris: yes")], ids=["uniform", "core", "debris"])
def test_write_run_and_judge(lmp, tmp_path, capsys, monkeypatch, change):
    """a folder that LAMMPS alone can run, with no materials elsewhere; cut into three it has the same bits, and both the same verdict"""
    (tmp_path / "c.yaml").write_text(CASE.replace(*change))
    monkeypatch.chdir(tmp_path)
    for folder in ("one", "three"):
        assert cli.main(["shield", "c.yaml", "--write", folder]) == 0
    assert "mpirun -np 2 lmp -in in.shield && python3 -m hvi judge ." in capsys.readouterr().out
    said = []
    for folder, ends in (("one", [2, 5, 8]), ("three", [2, 5, 8])):
        where = tmp_path / folder / "dx-0.75_shift-0.0"
        wanted = set(re.findall(r"[\w.-]+\.hvi\b", (where / script.BEGIN).read_text()))  # LAMMPS would take those of its tree
        assert wanted and wanted <= {path.name for path in where.iterdir()}
        for leg, until in enumerate(ends):
            command = where / (script.CONTINUE if leg else script.BEGIN)
            if folder == "three" and leg == 1:  # one that is stopped in the middle leaves rows, which do not count
                lmp(command, cwd=where, env={"LAMMPS_POTENTIALS": ""}, vars={"until": 4, "from": "r.a", "to": "r.lost"})
            lmp(command, cwd=where, env={"LAMMPS_POTENTIALS": ""}, vars={"until": until, "to": f"r.{'ab'[leg % 2]}", **({"from": f"r.{'ba'[leg % 2]}"} if leg else {})})
        (where / "log.1.lammps").write_text("LAMMPS (4 Feb 2025)\nLoop time of 1.0 on 1 procs for 100000 steps with 900 atoms\n")
        status = cli.main(["judge", str(where)])
        result = yaml.safe_load((where / "result.yaml").read_text())
        assert status == {"holds": 0, "fails": 3, "undecided": 4}[result["verdict"]] and f"verdict: {result['verdict']}\n" in capsys.readouterr().out, folder
        assert list(result)[:2] == ["verdict", "reasons"] and list(result)[-1] == "package_version", folder
        said.append(result)
    one, three = ((tmp_path / folder / "dx-0.75_shift-0.0/shield.dump").read_bytes() for folder in ("one", "three"))
    assert one == three and said[0] == said[1]
    assert said[0]["walls_reached"] == 2 and said[0]["wall1_perforated"] and abs(said[0]["energy_ratio"] - 1) < 1e-3
    assert said[0]["momentum_error"] < 1e-9 and abs(said[0]["mass_error"]) < 1e-9 and said[0]["hole1_diameter_mm"] > 3
    assert (tmp_path / "one/dx-0.75_shift-0.0/cloud1.dump").exists()
    of = tmp_path / "one/dx-0.75_shift-0.0/case.yaml"
    of.write_text(re.sub("speed_km_s: .*", "speed_km_s: 5.1", of.read_text()))
    assert cli.main(["judge", str(of.parent)]) == 1 and re.search(r"the run began with [\d.]+ J, and the projectile of case.yaml has [\d.]+ J", capsys.readouterr().err)


def test_front_door_runs_it(root, lmp_exe, tmp_path, capsys, monkeypatch):
    """table, verdict, what is done is left alone"""
    (tmp_path / "c.yaml").write_text(CASE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("hvi.report.pictures.DPI", 40)
    words = ["shield", "c.yaml", "--lmp", str(lmp_exe), "--ranks", "1"]
    status = cli.main(words)
    assert status in (0, 3, 4) and "1 runs, 0 done before, 1 to run" in capsys.readouterr().out
    assert cli.main(words) == status and "1 runs, 1 done before, 0 to run" in capsys.readouterr().out
    assert (tmp_path / "runs/c/verdict.yaml").exists() and not list(tmp_path.glob("runs/c/*/chain.yaml"))
    assert cli.main(["report", "runs/c"]) == 0
    page = (tmp_path / "runs/c/report.html").read_text()
    assert page.count("data:image/png") > 12 and "Plane of wall 2" in page and "Wall 2: no picture" not in page


@pytest.mark.long
def test_report_of_a_coarse_film(root, lmp_exe, tmp_path, monkeypatch):
    """the last frame before wall 2 is that of the start: the page says so in place of the picture"""
    (tmp_path / "c.yaml").write_text(CASE.replace("tstop: 8", "tstop: 4, film: 3.5"))
    monkeypatch.chdir(tmp_path)
    assert cli.main(["shield", "c.yaml", "--lmp", str(lmp_exe), "--ranks", "1"]) in (0, 3, 4) and cli.main(["report", "runs/c"]) == 0
    page = (tmp_path / "runs/c/report.html").read_text()
    assert "Wall 2: no picture. The last frame before it is struck is of 0.0 us" in page and "Plane of wall 2" not in page


@pytest.mark.parametrize("dx, message", [("0.004", "more than LAMMPS can number"), ("0.0095", "MB of memory")])
def test_what_the_machine_cannot_hold_is_refused(tmp_path, capsys, monkeypatch, dx, message):
    """from geometry alone, before a particle is made"""
    (tmp_path / "c.yaml").write_text(CASE.replace("[0.75]", f"[0.7, {dx}]"))
    monkeypatch.chdir(tmp_path)
    for words in (["--dry-run"], []):
        assert cli.main(["shield", "c.yaml", *words]) == 1
        err = capsys.readouterr().err
        assert f"spacings_mm: {dx} mm makes some" in err and message in err, words
    assert not (tmp_path / "runs/c/dx-0.7_shift-0.0").exists()


def test_rows_after_a_restart_count_once(tmp_path):
    """those of the run that was stopped go; so does a block that was cut off"""
    (tmp_path / "w").write_text("# fix\n0 2\n1 1 1\n2 2 2\n20 2\n1 3 3\n2 4 4\n40 2\n1 5 5\n2 6 6\n20 2\n1 7 7\n2 8 8\n40 2\n1 9\n")
    steps, rows = record.rows_of(tmp_path / "w")
    assert list(steps) == [0, 20] and rows.shape == (2, 2, 2) and rows[1].tolist() == [[7, 7], [8, 8]]
    (tmp_path / "h").write_text("0 0.0 1\n100 1.0 2\n200 2.0 3\n100 1.5 4\n200 2.\n")
    steps, rows = record.rows_of(tmp_path / "h")
    assert list(steps) == [0, 100] and rows[1].tolist() == [1.5, 4]


def result(**changed):
    """of two walls of which the second holds"""
    found = {"walls": 2, "walls_reached": 2, "time_us": 30.0, "energy_ratio": 1.0, "ended_by": "event", "method": "sph", "elements_failed_without_particles": 0, "momentum_left_ratio": 0.0,
             "conversion_heat_ratio": 0.0, "hourglass_energy_ratio": 0.0, "projectile_particles": 67, "projectile_particles_planned": 67}
    for k in (1, 2):
        found.update({f"wall{k}_{key}": 0 for key in ("apart_mass_mg", "apart_particles", "spall_mass_mg", "still_to_come", "missed_fraction", "missed_reach_mm", "push_percent", "bulge_m_s", "torn",
                                                      "bulge_over_thickness", "deepest_failed_layer", "rear_plastic_strain", "outer_plastic_strain", "cloud_energy_ratio")})
        found.update({f"hole{k}_diameter_mm": 0.0, f"wall{k}_layers": 3, f"wall{k}_energy_ratio": 0.3})
    return {**found, "wall1_cloud_energy_ratio": 0.7, **changed}


def apart(mg=2.0, particles=3, **changed):
    """changes of result(): so much is apart behind wall 2, as particles of the model, a quarter"""
    return {"wall2_apart_mass_mg": mg, "wall2_apart_particles": particles, **changed}


@pytest.mark.parametrize("changed, said, rules", [
    ({}, "holds", ["sound"]), (apart(hole2_diameter_mm=3.0, wall2_spall_mass_mg=1.0), "fails", ["perforated", "spall", "through"]),
    (apart(), "fails", ["through"]), (apart(wall2_missed_fraction=0.01, wall2_missed_reach_mm=40.0), "undecided", ["missed", "through"]),
    (apart(particles=2), "undecided", ["few", "through"]), (apart(particles=2, wall2_spall_mass_mg=2.0), "undecided", ["few", "spall"]),
    (apart(particles=1, hole2_diameter_mm=3.0), "fails", ["perforated", "through"]), ({"hole2_diameter_mm": 3.0, "momentum_left_ratio": 0.01}, "fails", ["perforated"]),
    (apart(particles=2, hole2_diameter_mm=math.nan), "undecided", ["few", "no plate", "through"]),
    (apart(wall2_layers=2, hole2_diameter_mm=3.0), "undecided", ["thin", "perforated", "through"]),
    ({"hole2_diameter_mm": 3.0}, "undecided", ["plugged"]), ({"hole2_diameter_mm": math.nan}, "undecided", ["no plate"]),
    ({"wall2_still_to_come": 0.00911}, "undecided", ["comes", "sound"]), ({"wall2_still_to_come": 0.00909}, "holds", ["sound"]),
    ({"wall2_push_percent": 3.1}, "undecided", ["pushed", "sound"]), ({"energy_ratio": 0.998}, "undecided", ["leaky", "sound"]),
    (apart(wall2_push_percent=3.1), "fails", ["pushed", "through"]),
    ({"wall2_bulge_m_s": 31.0}, "undecided", ["bulges", "sound"]), ({"wall2_bulge_m_s": 29.0}, "holds", ["sound"]),
    (apart(wall2_bulge_m_s=31.0), "fails", ["bulges", "through"]), ({"wall2_bulge_m_s": -31.0, "ended_by": "time"}, "undecided", ["bulges", "sound"]),
    ({"walls_reached": 1}, "undecided", ["late"]), ({"walls_reached": 1, "wall1_cloud_energy_ratio": 5e-5}, "holds", ["spared"]),
    ({"wall1_layers": 2}, "holds", ["sound", "coarse"]), ({"method": "tied"}, "undecided", ["tied", "sound"]),
    ({"ended_by": "until"}, "undecided", ["stopped", "sound"]), (apart(ended_by="until"), "fails", ["stopped", "through"]),
    ({"ended_by": "until", "walls_reached": 1, "wall1_cloud_energy_ratio": 5e-5}, "undecided", ["stopped", "spared"])])
def test_rules(tmp_path, changed, said, rules):
    """each rule by the number that it is about, and what it makes of the verdict"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    found = verdict.of_run(shield, result(**changed))
    assert (found["verdict"], found["rules"]) == (said, rules)
    assert found["reasons"] and all("-var" not in text for text in found["reasons"])
    if said == "fails" and "pushed" in rules:
        assert any("still pushed" in text for text in found["notes"])
    if said == "fails":  # whatever is done
        assert "remedies" not in found and not any("tstop" in text for text in found.get("notes", []))
    if "bulges" in rules:
        (text,) = [text for text in [*found["reasons"], *found.get("notes", [])] if "bulge" in text]
        assert ("at 30.0 us, the end at the latest" in text) is (changed.get("ended_by") == "time") and text.endswith("-- take settings: {tstop: 45.0}") is (said != "fails")
    if "few" in rules:
        assert {"spacings_mm": None} in found["remedies"] and any(text.startswith("no more than 8 particles are apart behind wall 2, and 10 are needed") for text in found["reasons"])
    if "thin" in rules:
        assert {"spacings_mm": 0.75} in found["remedies"]


def test_whole_walls_and_what_is_not_modelled(tmp_path):
    """material files decide; the wall that cannot fail in tension is named"""
    shield = chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("Al2024-T3", "Ti-6Al-4V") + "not_modelled: [MLI]\n"), 0, 0.0)
    found = verdict.of_run(shield, result())
    assert found["verdict"] == "undecided" and found["rules"] == ["not modelled", "whole", "sound"]
    assert any(text.startswith("wall 2 is of Ti-6Al-4V.hvi, whose file has no law of spall (damage yes spall voids)") for text in found["reasons"])


def test_thick_layers_are_coarse(tmp_path):
    """layers of 1.33 spacings hold too early, whatever their spacing in the plane; all spacings have the same ones, which a note says"""
    for layers, rules in ((3, ["coarser", "sound"]), (4, ["sound"])):
        text = CASE.replace("thickness_mm: 2.25", "thickness_mm: 3").replace("settings: {tstop: 8}", f"settings: {{tstop: 8, layers: [1, {layers}]}}")
        found = verdict.of_run(chain.shield_of(read(tmp_path / "c.yaml", text), 0, 0.0), result(wall1_layers=3))
        assert found["rules"] == rules, layers
    assert any("1.3 times as far apart" in text and text.endswith("take more layers, or let spacings_mm say how many") for text in
               verdict.of_run(chain.shield_of(read(tmp_path / "c.yaml", text.replace("[1, 4]", "[1, 3]")), 0, 0.0), result(wall1_layers=3))["reasons"])
    case = read(tmp_path / "c.yaml", text.replace("[0.75]", "[0.75, 0.6]"))
    said = {member: ("holds", [], []) for member in decision.members(case)}
    assert decision.decide(case, said)[::2] == ("holds", ["settings: layers are the same with all spacings: how much they matter is not known"])


def test_reasons_of_all_shifts(tmp_path):
    """numbers of the finest runs as ranges, the worst among them; walls and materials are no numbers, and other words another text"""
    case = read(tmp_path / "c.yaml", CASE.replace("[0.75]", "[0.75, 0.6]").replace("shifts: [0]", "shifts: [0, 0.25, 0.5]"))
    said = {(which, shift): ("fails", [f"wall 2 of Al6061-T6 has a hole of {hole} mm", "spall"], [f"moves at {-100 * hole} m/s to wall {wall}, 1e-3 of it"])
            for which, shift, hole, wall in [(0, 0, 1, 2), (0, 0.25, 1, 2), (0, 0.5, 1, 2), (1, 0, 11.31, 2), (1, 0.25, 6.854, 1), (1, 0.5, 9, 1)]}
    verdict, (_, *reasons), notes = decision.decide(case, said)
    one, two, three = (f"dx-0.6_shift-{shift}" for shift in ("0.0", "0.25", "0.5"))
    assert verdict == "fails" and reasons == [f"wall 2 of Al6061-T6 has a hole of 6.854 to 11.31 mm ({one}, {two}, {three})", f"spall ({one}, {two}, {three})"]
    assert notes == [f"moves at -1131.0 m/s to wall 2, 1e-3 of it ({one})", f"moves at -900 to -685.4 m/s to wall 1, 1e-3 of it ({two}, {three})"]


@pytest.mark.parametrize("kind", ["spall", "damage"])
def test_elements_that_cannot_fail(tmp_path, kind):
    """by words of fix hvi/fem"""
    text = CASE.replace("spacings_mm: [0.75]", "method: hybrid\nspacings_mm: [0.375]")
    shield = chain.shield_of(read(tmp_path / "c.yaml", text.replace("tstop: 8", f"tstop: 8, fem: strain 0.3 {kind} no")), 0, 0.0)
    found = verdict.of_run(shield, result(method="hybrid"))
    assert found["verdict"] == "undecided" and sum(f"with settings: {{fem: {kind} no}} of its elements" in text for text in found["reasons"]) == 2
    with pytest.raises(errors.HVIError, match="settings: fem: whether elements become particles is said by method"):
        read(tmp_path / "c.yaml", text.replace("tstop: 8", "tstop: 8, fem: strain 0.3 convert no"))


def test_walls_coarser_than_what_strikes_them(tmp_path):
    """1.2 times is a matter of rounding, 1.3 holds too early; one that fails, fails"""
    for spacing, rules in ((0.89, ["sound"]), (0.98, ["coarser", "sound"])):
        shield = chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("gap_mm: 8", f"gap_mm: 8, spacings_mm: [{spacing}]").replace("thickness_mm: 2.25", "thickness_mm: 3.6")), 0, 0.0)
        assert shield.walls[1].spacing == pytest.approx(1e-3 * spacing)
        found = verdict.of_run(shield, result())
        assert (found["verdict"], found["rules"]) == ("undecided" if "coarser" in rules else "holds", rules)
    assert {"wall 2: spacings_mm": None} in found["remedies"] and verdict.of_run(shield, result(hole2_diameter_mm=3.0, wall2_apart_particles=1))["verdict"] == "fails"


GRADED = CASE.replace("[0.75]", "[0.375]").replace("gap_mm: 8", "gap_mm: 8, core_mm: 3")


def test_a_wall_with_a_core(tmp_path):
    """by hand: 2.25 mm are 3 layers of 0.75 mm outside and 6 of 0.375 inside, in 3 mm to each side, whole cells of 0.75; the two are one body"""
    shield = chain.shield_of(read(tmp_path / "c.yaml", GRADED), 0, 0.0)
    wall, text = shield.walls[1], shield.text()
    assert (wall.layers, wall.core, -wall.core_lo, wall.core_hi) == (6, *3 * (pytest.approx(3e-3),)) and wall.dz == pytest.approx(wall.spacing) and (wall.outer.layers, wall.outer.spacing) == (3, pytest.approx(7.5e-4))
    assert shield.outers == [2] and shield.outer_type(2) == 4 and shield.matter == "1:3 4" and shield.geometry.widest == pytest.approx(7.5e-4)
    for line in ("create_box 4 box", "pair_coeff 3 4 tension yes", "create_atoms 4 region outer2", "region outer2 intersect 2 disc2 around2"):
        assert line in " ".join(text.split()), line
    assert " outer 4 layers 6 radius" in text
    area, square = np.pi * wall.radius**2, 36e-6
    assert wall.particles == pytest.approx((6 * square + 6 / 8 * (area - square)) / 3.75e-4**2)
    plan = chain.plan_of(shield)
    assert (plan["wall2_core_mm"], plan["wall2_outer_type"]) == (3.0, 4) and "wall1_core_mm" not in plan


@pytest.mark.parametrize("share", [0.72, 0.9, 20])
def test_a_core_whose_corners_reach_the_edge_is_all_of_it(tmp_path, share):
    radius = 1e3 * chain.shield_of(read(tmp_path / "c.yaml", GRADED), 0, 0.0).walls[1].radius
    shield = chain.shield_of(read(tmp_path / "c.yaml", GRADED.replace("core_mm: 3", f"core_mm: {share * radius}")), 0, 0.0)
    wall = shield.walls[1]
    assert shield.outers == [] and wall.layers == 6 and "tension" not in shield.text() and wall.particles == pytest.approx(6 * np.pi * wall.radius**2 / 3.75e-4**2)


def test_the_core_of_an_oblique_shot(tmp_path):
    """covers where the flight and the normal meet the wall, and as much around"""
    shield = chain.shield_of(read(tmp_path / "c.yaml", GRADED.replace("speed_km_s: 5", "speed_km_s: 5\nangle_deg: 45")), 0, 0.0)
    wall = shield.walls[1]
    assert wall.struck > 8e-3 and -wall.core_lo == pytest.approx(3e-3) and wall.struck + 3e-3 <= wall.core_hi < wall.struck + 3.76e-3 and wall.core == pytest.approx(3e-3)
    for corner in (wall.core_lo, wall.core_hi):
        assert math.hypot(corner - wall.middle, wall.core) < wall.radius
    assert all(abs(x / wall.outer.spacing - round(x / wall.outer.spacing)) < 1e-9 for x in (wall.core_lo, wall.core_hi, wall.core))  # whole cells


def test_what_happens_beyond_the_core(tmp_path):
    """the rear of the outer part may have half of the strain; more is said in the notes"""
    shield = chain.shield_of(read(tmp_path / "c.yaml", GRADED), 0, 0.0)
    for strain, noted in ((0.09, False), (0.11, True)):
        found = verdict.of_run(shield, result(wall2_rear_plastic_strain=0.2, wall2_outer_plastic_strain=strain))
        assert found["verdict"] == "holds" and ("beyond" in found["rules"]) is noted and any("take a larger core_mm" in text for text in found.get("notes", [])) is noted


@pytest.mark.parametrize("old, new, message", [
    ("core_mm: 3", "core_mm: 2.9", "wall 2: core_mm: must be 3 mm at least"), ("core_mm: 3", "core_mm: 3, hold_mm: 9", "wall 2: hold_mm: is of elements"),
    ("core_mm: 3", "core_mm: 3, spacings_mm: [1.2]", "leave 1 in the outer part"), ("tstop: 8", "tstop: 8, layers: [2, 5]", "5 layers of particles leave 2.5 in the outer part")])
def test_a_core_that_cannot_be(tmp_path, old, new, message):
    (tmp_path / "c.yaml").write_text(GRADED.replace(old, new))
    with pytest.raises(errors.HVIError, match=message):
        cases.read(tmp_path / "c.yaml")


def test_what_ends_a_run_does_not_leave_it_undecided():
    """what may still be on its way when the event is over is what the verdict spares: else a run ends between the two"""
    assert (script.OVER["share"], script.OVER["coming"]) == (verdict.SHARE, verdict.SPARED) and script.OVER["push"] < script.STILL and script.OVER["bulge"] < script.BULGE


def test_few_are_those_of_the_whole_shield(tmp_path):
    """a particle of a quarter stands for four: 12 decide, 8 do not; the input asks for as many, and so does what says how a run has ended"""
    for quarter, decide in (("yes", 3), ("no", 10)):
        shield = chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("settings: {", f"settings: {{quarter: {quarter}, ")), 0, 0.0)
        assert shield.few == decide and f"f_pieces[2][32] >= {decide} ||" in shield.text()
        for particles, said in ((decide, "fails"), (decide - 1, "undecided")):
            found = verdict.of_run(shield, result(**apart(particles=particles)))
            assert (found["verdict"], found["margins"]["apart_particles"]) == (said, particles * shield.images)


def record_of(shield, **of_last_wall):
    """a Record of 20 looks, 2 us apart, beyond tstop; changes: {column: value or values of the last wall}"""
    us = np.arange(20) * 2.0 + shield.geometry.tstop_us
    columns = {name: np.zeros((20, shield.n)) for name in record.WALL}
    for name, value in {"momentum": 0.1, "mass": 1.0, "energy": 1.0, **of_last_wall}.items():
        columns[name][:, -1] = value
    rows = types.SimpleNamespace(**columns)
    return types.SimpleNamespace(walls=rows, pieces=rows, us=us, seldom_us=us, time_us=float(us[-1]))


@pytest.mark.parametrize("changed, over", [
    ({}, True), ({"coming_energy": 1e9}, False), ({"plastic_power": 1e12}, False), ({"momentum": 0.1 * 1.1 ** np.arange(20)}, False), ({"momentum": 0.1 * 1.05 ** np.arange(20)}, True),
    ({"bulge": 5e-5 * np.arange(20)}, True), ({"bulge": 7e-5 * np.arange(20)}, False), ({"apart_number": 2}, True), ({"apart_number": 2, "bulge": 7e-5 * np.arange(20)}, False),
    ({"apart_number": 3, "bulge": 7e-5 * np.arange(20)}, True), ({"hole_found": 1, "bulge": 7e-5 * np.arange(20)}, False), ({"hole_found": 1, "apart_number": 1, "bulge": 7e-5 * np.arange(20)}, True),
    ({"bulge": 7e-5 * np.arange(20), "momentum": 30.0}, True)],
    ids=["rest", "comes", "flows", "pushed", "let go", "slow", "bulges", "few", "few and bulges", "fails", "plugged and bulges", "hole", "flies as a whole"])
def test_when_an_event_is_over(tmp_path, changed, over):
    """the bulge of wall 2 grows by 25 or 35 m/s; it moves as a whole by 30 m/s; its momentum changes by 3.3 or 1.8 percent in 0.8 us, a tenth of the time that is enough"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    assert shield.geometry.walls[1].thickness == pytest.approx(2.25e-3) and record.over(shield, record_of(shield, **changed)) is over


def test_growth_is_that_of_the_last_rows(tmp_path):
    """by hand: the last value less the mean of five, over two looks, less the way of all of the wall"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    found = record_of(shield, bulge=[9.0] * 15 + [0.0, 0.0, 0.0, 1e-3, 2e-3], momentum=2.0, mass=4.0)
    assert record.growth(found, 1) == pytest.approx((2e-3 - 3e-3 / 5) / 4e-6 - 0.5)


def test_push_is_that_of_the_last_rows(tmp_path):
    """by hand, in a tenth of the time that is enough; the same for a shield of twice the size that takes twice the time"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    found = record_of(shield, momentum=[9.0] * 15 + [1.0, 1.0, 1.0, 1.0, 1.25])
    assert record.push(found, 1, 40.0) == pytest.approx((1.25 - 5.25 / 5) / 1.25 / 4 * 4)
    found.seldom_us = 2 * found.seldom_us
    assert record.push(found, 1, 80.0) == pytest.approx((1.25 - 5.25 / 5) / 1.25 / 4 * 4)


@pytest.mark.parametrize("gap", [2.5, 8])
@pytest.mark.parametrize("tips, struck, reached, until", [([0.4, 0.5, 0.9], 0.0, 1, 3.0), ([0.4, 0.9, 1.0], 0.1, 2, 1.0), ([0.95, 1.0, 1.0], 0.1, 2, 1.0), ([0.3, 0.9, 0.95], 0.0, 1, 3.0)])
def test_what_has_reached_the_next_wall(tmp_path, gap, tips, struck, reached, until):
    """matter comes near to it, at 6 spacings (0.75 mm) or half of the gap, and pushes it: else the wall before decides, by its numbers at the end, and never by those of the begin

    tips: of wall 1, in gaps, at 1, 2 and 3 us; struck: momentum of wall 2 at the end
    """
    shield = chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("gap_mm: 8", f"gap_mm: {gap}")), 0, 0.0)
    places = [1e-3 * (0.75 + gap * tip) for tip in (0, *tips)]
    write_record(tmp_path / "run", 2, [0, 1, 2, 3], {(1, "tip"): places, (2, "momentum"): [0, 0, 0, struck], (1, "momentum"): [0, 1, 2, 3]})
    found = record.measure(shield, tmp_path / "run")
    assert (found["walls_reached"], found["wall1_until_us"]) == (reached, until) and found["wall1_momentum_N_s"] == shield.images * until
    assert verdict.of_run(shield, found)["decided_by"] == f"wall{reached}"


def test_files_that_are_not_of_the_run(tmp_path):
    """columns of history.dat that are more or fewer, or of elements where there are none; a value that is no number: an error that names the file"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    write_record(tmp_path, 2, [0, 1, 2], {})
    assert record.measure(shield, tmp_path)["elements"] == 0
    path = tmp_path / "history.dat"
    right = path.read_text()
    for change in (lambda line: line.rsplit(" ", 3)[0], lambda line: line + " 1", lambda line: line + 12 * " 7"):
        path.write_text("".join(change(line) + "\n" for line in right.splitlines()))
        with pytest.raises(errors.HVIError, match="history.dat must have 34 columns after the step, as in.shield of this case writes them; it has (31|35|46)"):
            record.measure(shield, tmp_path)
    path.write_text(right)
    write_record(tmp_path, 2, [0, 1, 2], {(2, "fragments"): [0, math.nan, 0]})
    with pytest.raises(errors.HVIError, match=r"(walls|pieces).dat: a value at step 100 is no number"):
        record.measure(shield, tmp_path)


def test_time_of_a_run_whose_log_is_gone(tmp_path):
    """a run that was continued by hand, its first log written over: what it took is unknown, and steps per second are those of what is logged"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    write_record(tmp_path, 2, [0, 1, 2], {})  # 200 steps
    log = "Loop time of 2.0 on 3 procs for 80 steps with 900 atoms\n"
    (tmp_path / "log.lammps").write_text(log)
    found = record.measure(shield, tmp_path)
    assert math.isnan(found["wall_s"]) and math.isnan(found["core_s"]) and found["particle_steps_per_s"] == 80 * 900 / 2
    (tmp_path / "log.1.lammps").write_text(log.replace("80", "120").replace("900", "950"))  # of the begin: those that have left since are not in the other
    found = record.measure(shield, tmp_path)
    assert (found["wall_s"], found["core_s"], found["particle_steps_per_s"], found["particles"]) == (4.0, 12.0, 200 * 900 / 4, 900)


def test_a_wall_that_debris_misses(tmp_path):
    """what flies past wall 2 has not reached it, and leaves the verdict undecided all the same"""
    shield = chain.shield_of(read(tmp_path / "c.yaml"), 0, 0.0)
    write_record(tmp_path, 2, [0, 1, 2], {(1, "tip"): [0, 8e-3, 9e-3], (2, "missed_mass"): [0, 0, 0.3 * shield.mass() / shield.images]})
    found = record.measure(shield, tmp_path)
    assert found["walls_reached"] == 1 and not found["wall2_reached"] and found["wall2_missed_fraction"] == pytest.approx(0.3)
    said = verdict.of_run(shield, found)
    assert said["verdict"] == "undecided" and "missed" in said["rules"]


def test_push_does_not_go_with_the_end_that_is_asked_for(tmp_path):
    """the same wall at the same time: tstop of the case says when to look, not how still a wall must be"""
    found = [chain.shield_of(read(tmp_path / "c.yaml", CASE.replace("tstop: 8", f"tstop: {tstop}")), 0, 0.0) for tstop in (0, 7, 60)]
    assert len({shield.geometry.tstop_us for shield in found}) == 3 and len({shield.geometry.enough_us for shield in found}) == 1
    quiet = {re.search(r"abs\(f_pieces\[2\]\[4\]-f_lately\[2\]\[2\]\) < ([\d.]+)\*", shield.text())[1] for shield in found}
    assert len(quiet) == 1 and found[0].geometry.tstop_us == found[0].geometry.enough_us


def test_names_of_rules_are_unique():
    names = [rule.name for rule in verdict.RULES]
    assert len(set(names)) == len(names) and all(rule.why for rule in verdict.RULES)
    assert np.isfinite(verdict.SPARED) and isinstance(verdict.RULES[0].when(types.SimpleNamespace(case=types.SimpleNamespace(not_modelled=()))), bool)
    assert cases.LAYERS == verdict.NEEDED
