"""python3 -m hvi shield: cases read and refused, runs shared out, verdicts drawn from them; LAMMPS is a fake here."""

import contextlib
import dataclasses
import fcntl
import math
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import termios
import time
import types

import hvi
import numpy as np
import pytest
import yaml
from front_runs import CASE, begun, case_folder, change, front, tries, wait_for  # noqa: F401
from hvi import cli
from hvi.errors import HVIError
from hvi.figures import sketch
from hvi.io.data import DataFile
from hvi.jobs import engine, machine
from hvi.material import laws, library
from hvi.model import bodies, stl
from hvi.shield import ble, chain, decision, projectile, record
from hvi.shield import case as cases
from scipy.spatial import ConvexHull


MINE = "# DATE: 2026 UNITS: si\neos linear\n  rho0 2700\n  K 7e10\nstrength johnson-cook\n  G 27e9\n  A 3e8\n  B 1e8\n  n 0.4\n  C 0\n  m 1\n  Tref 300\n  Tm 900"


# ---------------------------------------------------------------------- cases
def test_case_as_variables(folder, root):
    case = cases.read("emi.yaml")
    assert case.spacings_mm == (0.4, 0.2)  # coarse first
    assert case.variables(1, 0.5) == {
        "dx": 0.2, "shift": 0.5, "D": 5.0, "v0": 7100.0, "angle": 0.0, "material_p": "Al2024-T3.hvi", "walls": 2, "thickness": [0.8, 1.2],
        "gap": [0, 60.0], "material": ["Al2024-T3.hvi", "Al6061-T6.hvi"]}
    (folder / "mine.hvi").write_text(MINE)
    (folder / "emi.yaml").write_text(CASE.replace("gap_mm: 60", "gap_mm: 60\n    spacings_mm: [0.3, 0.5]\n    radius_mm: 40").replace(
        "0.8, material: Al2024-T3}", "0.8, material: mine}") + "angle_deg: 30\nsettings: {tstop: 40, layers: [2, 3]}\n")
    found = cases.read("emi.yaml").variables(0, 0.0)
    assert found["spacings"] == [0.4, 0.5] and found["radius"] == [0, 40.0] and found["angle"] == 30.0
    assert found["material"] == [str(folder / "mine.hvi"), "Al6061-T6.hvi"] and found["tstop"] == 40 and found["layers"] == [2, 3]


def test_material_in_other_units(folder):
    """masses are those of the density, whatever the units of the file"""
    cgs = MINE.replace("UNITS: si", "UNITS: cgs")
    for old, new in (("rho0 2700", "rho0 2.7"), ("K 7e10", "K 7e11"), ("G 27e9", "G 27e10"), ("A 3e8", "A 3e9"), ("B 1e8", "B 1e9")):
        cgs = cgs.replace(old, new)
    (folder / "emi.yaml").write_text(CASE.replace("material: Al2024-T3", "material: mine").replace("material: Al6061-T6", "material: mine"))
    plans = []
    for text in (MINE, cgs):
        (folder / "mine.hvi").write_text(text)
        shield = chain.shield_of(cases.read("emi.yaml"), 0, 0.0)
        plans.append((shield.mass(), *shield.rho, chain.plan_of(shield)["areal_density_kg_m2"], ble.from_case(shield.case).wall_density))
    assert plans[1] == pytest.approx(plans[0], rel=1e-12) and plans[0][1:] == (2700, 2700, 2700, pytest.approx(5.4), pytest.approx(2.7))


def test_the_case_of_one_run(folder):
    """what is written into the folder of a run is read as the same case, of one spacing and shift"""
    (folder / "emi.yaml").write_text(CASE.replace("gap_mm: 60", "gap_mm: 60\n    spacings_mm: [0.3, 0.5]\n    radius_mm: 40") + "angle_deg: 30\n"
                                     "settings: {tstop: 40, layers: [2, 3], edge: clamp}\nnot_modelled: [MLI, a blanket]\n")
    one = cases.read("emi.yaml").one(1, 0.5)
    (folder / "one.yaml").write_text(yaml.safe_dump(one.mapping()))
    assert cases.read("one.yaml") == dataclasses.replace(one, name="one")
    assert (one.spacings_mm, one.shifts, one.walls[1].spacings_mm) == ((0.2,), (0.5,), (0.3,))


def test_materials_are_those_that_the_case_names(folder):
    """not files of their name in the working directory, or of another wall"""
    (folder / "cases").mkdir()
    (folder / "cases/emi.yaml").write_text(CASE)
    (folder / "Al6061-T6.hvi").write_text(MINE)
    shield = chain.shield_of(cases.read("cases/emi.yaml"), 0, 0.0)
    assert shield.texts()["Al6061-T6.hvi"] == (library.POTENTIALS / "Al6061-T6.hvi").read_text() and shield.rho[2] == 2703
    (folder / "cases/Al6061-T6.hvi").write_text(MINE)
    shield = chain.shield_of(cases.read("cases/emi.yaml"), 0, 0.0)
    assert shield.texts()["Al6061-T6.hvi"] == MINE and shield.rho[2] == 2700
    (folder / "cases/weak").mkdir()
    (folder / "cases/weak/Al2024-T3.hvi").write_text(MINE)
    (folder / "cases/emi.yaml").write_text(CASE.replace("0.8, material: Al2024-T3", "0.8, material: weak/Al2024-T3.hvi"))
    with pytest.raises(HVIError, match=r"wall 1: material: .*weak/Al2024-T3.hvi and .*potentials/Al2024-T3.hvi have one name"):
        cases.read("cases/emi.yaml")


def test_equations_know_the_density_of_today(folder):
    (folder / "emi.yaml").write_text(CASE.replace("material: Al6061-T6", "material: mine"))
    for rho in (2700, 5400):
        (folder / "mine.hvi").write_text(MINE.replace("rho0 2700", f"rho0 {rho}"))
        assert ble.from_case(cases.read("emi.yaml")).wall_density == pytest.approx(1e-3 * rho)


@pytest.mark.parametrize("spacings, message", [("[0.3, 0.5]", None), ("[0.5, 0.3]", "wall 2: spacings_mm: 0.3, 0.5 mm grow where those of the case, 0.4, 0.2 mm, become finer"),
                                               ("[0.3, 0.3]", "wall 2: spacings_mm: the largest must be 1.2 times the smallest at least")])
def test_spacings_of_a_wall_become_finer(folder, spacings, message):
    """so that the verdict of two spacings is one"""
    (folder / "emi.yaml").write_text(CASE.replace("gap_mm: 60", f"gap_mm: 60\n    spacings_mm: {spacings}"))
    with pytest.raises(HVIError, match=message) if message else contextlib.nullcontext():
        cases.read("emi.yaml")


def test_a_folder_keeps_its_run(folder, capsys):
    """--write does not mix a run with another case, and judge does not take it for one"""
    assert cli.main(["shield", "emi.yaml", "--write", "w"]) == 0 and cli.main(["shield", "emi.yaml", "--write", "w"]) == 0
    (folder / "w/dx-0.4_shift-0.0/walls.dat").write_text("")
    assert cli.main(["shield", "emi.yaml", "--write", "w"]) == 0
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", "speed_km_s: 5"))
    capsys.readouterr()
    before = (folder / "w/dx-0.2_shift-0.0/case.yaml").read_text()
    assert cli.main(["shield", "emi.yaml", "--write", "w"]) == 1
    assert "w/dx-0.4_shift-0.0 has a run, and in.shield there is not that of this case" in capsys.readouterr().err
    assert (folder / "w/dx-0.2_shift-0.0/case.yaml").read_text() == before  # all or nothing
    of = folder / "w/dx-0.4_shift-0.0/case.yaml"
    of.write_text(re.sub("gap_mm: .*", "gap_mm: 61", of.read_text()))
    assert cli.main(["judge", str(of.parent)]) == 1 and "wall2_front_mm is 60.8 in plan.yaml, and 61.8 by case.yaml" in capsys.readouterr().err


def test_a_thick_last_wall_has_a_next_spacing(folder):
    """of hundreds of layers, where one more changes nothing; of layers that the case gives there is none"""
    (folder / "emi.yaml").write_text(CASE.replace("thickness_mm: 1.2", "thickness_mm: 250\n    radius_mm: 8"))
    case = cases.read("emi.yaml")
    said = {member: ("undecided", [], []) for member in decision.members(case)}
    jobs = {member: types.SimpleNamespace(result=lambda: {"core_s": 1.0}) for member in said}
    found = decision.finer(case, said, jobs)["spacings_mm"]
    assert found == [0.2, 0.1667]
    (folder / "again.yaml").write_text((folder / "emi.yaml").read_text().replace("[0.2, 0.4]", str(found)))
    assert cases.read("again.yaml").spacings_mm == tuple(found)  # what is proposed is taken
    thin = dataclasses.replace(case, walls=(case.walls[0], dataclasses.replace(case.walls[1], thickness_mm=1.2)))
    assert decision.finer(thin, said, jobs)["spacings_mm"] == [0.2, 0.15]
    assert decision.finer(dataclasses.replace(thin, settings={"layers": (3, 3)}), said, jobs) is None


def test_tables_of_keys(capsys):
    """each key of a case says what it is, and --help shows all of them"""
    with pytest.raises(SystemExit):
        cli.main(["shield", "--help"])
    shown = capsys.readouterr().out
    for table, name in ((cases.KEYS, cases.Case), (cases.WALL, cases.Wall)):
        fields = {field.name for field in dataclasses.fields(name)} - {"name"} | ({"method"} if name is cases.Case else set())
        assert set(table) == fields
    assert set(projectile.KEYS) - {"file"} | {"files", "of_files"} == {field.name for field in dataclasses.fields(projectile.Projectile)}
    for key, _, text in cases.rows_of_keys():
        assert f"\n{key} " in shown and (text or key.endswith("thickness_mm"))
    page = pathlib.Path(cases.__file__).parents[3] / "doc/src/case_keys.txt"
    assert page.read_text() == shown[shown.index("key  "):].rstrip() + "\n", f"python3 -m hvi shield --help | sed -n '/^key  /,$p' > {page}"


@pytest.mark.parametrize("particles, least, report", [(5_000, 31, 31), (20_000, 31, 31), (200_000, 15, 6), (1_100_000, 2, 2), (1_200_000, 1, 1)])
def test_frames_stay_within_the_budget(particles, least, report):
    """31 of 20,000 particles, fewer of more, in 500 MB; the page holds those of the plan whatever they contain"""
    for tstop in (3.0, 21.69, 33.4, 99.95, 1000.0):
        shield = types.SimpleNamespace(particles=lambda: particles, nodes=lambda: 0, embedded=lambda: 0, steps=lambda: 1000, settings={}, case=types.SimpleNamespace(setting=lambda _: 0), geometry=types.SimpleNamespace(tstop_us=tstop))
        shield.settings["film"] = chain.film_of(shield)
        plan = chain.size_of(shield)
        assert least <= plan["frames"] <= chain.FRAMES + 2 and plan["frames"] * chain.ROW * particles <= chain.BUDGET or plan["frames"] == 1, f"{tstop}: {plan}"
        assert report <= plan["frames_in_report"] <= plan["frames"] and plan["frames_MB"] <= 500 and plan["disk_MB"] > plan["frames_MB"], f"{tstop}: {plan}"


def test_frames_end_when_it_is_enough(folder):
    """by default; frames of the case's own interval have no end"""
    late = "variable        late equal v_us>"
    text = chain.shield_of(cases.read("emi.yaml"), 0, 0.0).text()
    assert late in text and " skip v_late " in text
    (folder / "emi.yaml").write_text(CASE + "settings: {film: 2}\n")
    text = chain.shield_of(cases.read("emi.yaml"), 0, 0.0).text()
    assert "skip" not in text and "every/time 2e-06" in text


def test_own_material_without_strength(folder, capsys):
    """a file beside the case is looked into like those of the package; what is a comment there is none"""
    (folder / "mine.hvi").write_text("# strength\neos linear # strength\n")
    (folder / "emi.yaml").write_text(change("Al6061-T6", "mine"))
    assert front("shield") == 1
    assert "emi.yaml, line 9: wall 2: material: mine has no section strength" in capsys.readouterr().err


def test_cases_of_the_example(root):
    found = [cases.read(path) for path in (root / "examples/whipple-shield/cases").glob("*.yaml")]
    assert len(found) >= 3
    assert cases.read(root / "examples/whipple-shield/studies/convergence.yaml").spacings_mm == (0.4, 0.267, 0.2)


def test_input_of_the_example(root):
    """examples/whipple-shield/in.shield is what hvi shield writes for quick.yaml at 0.5 mm"""
    case = cases.read(root / "examples/whipple-shield/cases/quick.yaml")
    assert (root / "examples/whipple-shield/in.shield").read_text() == chain.shield_of(case, 1, 0.0).text()


# ---------------------------------------------------------------------- shield
@pytest.mark.parametrize("D, verdict, status", [(4.1, "holds", 0), (4.3, "undecided", 4), (4.43, "undecided", 4), (4.6, "fails", 3)])
def test_verdict_of_all_runs(folder, capsys, D, verdict, status):
    """limits of the fake: 4.2 and 4.25 at 0.2 mm, 4.4 and 4.45 at 0.4 mm"""
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", f"diameter_mm: {D}"))
    assert front("shield", "--jobs", "2") == status
    out = capsys.readouterr().out
    saved = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())
    if D == 4.43:
        assert "so near the limit finer spacings_mm may decide" in saved["reasons"][2]
    assert list(saved)[:2] == ["verdict", "reasons"] and saved["verdict"] == verdict and f"\nverdict: {verdict}\n  - {saved['reasons'][0]}\n" in out
    assert tries(folder) == {name: 1 for name in saved["runs"]} and len(saved["runs"]) == 4
    assert saved["command"] == "python3 -m hvi shield emi.yaml --runs runs --jobs 2 --ranks 2"
    assert (folder / "runs/emi/case.yaml").read_text() == (folder / "emi.yaml").read_text()
    assert saved["core_s"] == pytest.approx(2 * (0.2**-4 + 39.1), abs=0.1)
    for name, said in saved["runs"].items():
        assert re.search(rf"^ *{name} +done +{said} ", out, re.M)
    reasons = "\n".join(saved["reasons"])
    assert ("differs over the spacing" in reasons) == (status == 4) and ("the verdict differs over the shift of the lattice at 0.4 mm: fails with 0, holds with 0.5" in reasons
                                                                    if D == 4.43 else "differs over the shift" not in reasons)


@pytest.mark.parametrize("D, wall, ball, verdict", [(4, "Ti-6Al-4V", "Al2024-T3", "undecided"), (6, "Ti-6Al-4V", "Al2024-T3", "fails"), (4, "Al6061-T6", "Ti-6Al-4V", "holds")])
def test_what_cannot_tear_in_tension(folder, capsys, D, wall, ball, verdict):
    """a wall without a law of spall is none that holds: a file of it has nothing that lets it fail"""
    text = CASE.replace("diameter_mm: 5", f"diameter_mm: {D}").replace("material: Al6061-T6", f"material: {wall}").replace("  material: Al2024-T3", f"  material: {ball}")
    (folder / "emi.yaml").write_text(text)
    assert front("shield", "--dry-run") == 0
    assert (f"hvi: warning: emi.yaml, line 9: wall 2 is of {wall}.hvi, whose file has no law of spall (damage yes spall voids), so it does not fail in tension: if the shield holds, "
            "the verdict will be undecided -- give its file such a section, or take a law that it has, by settings: {solid: ...}\n" in capsys.readouterr().err) == (wall[0] == "T")
    assert front("shield", "--jobs", "3") == decision.STATUS[verdict]
    said = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())
    place = "reasons" if verdict == "undecided" else "notes"
    what = f"wall 2 is of {wall}.hvi" if wall[0] == "T" else f"the projectile is of {ball}.hvi"
    assert said["verdict"] == verdict and "next_finer" not in said
    (why,) = [text for text in said[place] if text.startswith(f"{what}, whose file has no law of spall (damage yes spall voids)")]
    assert (" -- give its file such a section, or take a law that it has, by settings: {solid: ...} (" in why) == (verdict == "undecided")  # of failing runs there are no remedies


@pytest.mark.parametrize("material, law, remedy", [
    ("Ta", "steinberg-guinan", "take settings: {solid: damage yes spall voids strength steinberg-guinan}, which all materials of this case have"),
    ("Pb", "steinberg-guinan", "take settings: {solid: damage yes spall voids strength steinberg-guinan}, which all materials of this case have"),
    ("PMMA", "perfect", "these have none: give PMMA a section strength johnson-cook")])
def test_a_material_without_the_law_is_refused(folder, capsys, material, law, remedy):
    """its file has a law of strength, but not the one that the run takes: it would be a liquid, and nothing would say so"""
    (folder / "emi.yaml").write_text(change("  material: Al2024-T3\nspeed", f"  material: {material}\nspeed"))
    assert front("shield") == 1
    assert f"emi.yaml, line 4: projectile: material: {material} has strength {law}, and the run takes johnson-cook: it would be a liquid; " in (err := capsys.readouterr().err)
    assert remedy in err and not (folder / "runs").exists()
    if law == "steinberg-guinan":
        (folder / "emi.yaml").write_text(change("  material: Al2024-T3\nspeed", f"  material: {material}\nspeed") + f"settings: {{solid: damage no spall voids strength {law}}}\n")
        assert front("shield") in (0, 3, 4)


def test_laws_that_a_material_lacks():
    for name, solid, lacking in (("Al6061-T6", "damage yes spall voids", []), ("Ti-6Al-4V", "damage yes spall voids", ["spall"]), ("Ti-6Al-4V", "damage no spall voids", ["spall", "damage"]),
                                 ("Ti-6Al-4V", "spall none", ["spall"]), ("steel-304", "damage yes spall voids", ["damage"]), ("steel-304", "damage no spall voids", ["damage"]),
                                 ("steel-304", "damage johnson-cook", ["spall", "damage"]), ("PMMA", "", ["spall", "damage"]), ("Al6061-T6", "damage johnson spall voids", ["damage"]),
                                 ("Al6061-T6", "damage no spall none", ["spall", "damage"]), ("Al6061-T6", "damage off spall pressure", ["spall", "damage"]),
                                 ("Al6061-T6", "damage on spall voids", []), ("Al6061-T6", "damage no damage true spall voids", []), ("Al6061-T6", "spall voids spall none damage false", ["spall", "damage"]),
                                 ("Al6061-T6", "spall zero strength none", ["damage"])):
        assert list(laws.lacking(f"{name}.hvi", solid)) == lacking, (name, solid)
    assert laws.lacking("steel-304.hvi", "damage no spall voids") == {"damage": "with damage no"}


def test_settings_that_are_right(folder):
    (folder / "emi.yaml").write_text(CASE + "settings: {tstop: 0, C: 0.5, pair: riemann, solid: no damage, edge: clamp, quarter: no, film: -1, layers: [3, 4]}\n")
    found = cases.read("emi.yaml")
    assert found.setting("solid") == "no damage" and found.setting("layers") == (3, 4) and found.setting("eta") == 1.2


def test_few_layers_are_said_beforehand(folder, capsys):
    (folder / "emi.yaml").write_text(change("[0.2, 0.4]", "[0.2, 0.61]"))
    assert front("shield") == 4  # 2 layers at 0.61 mm
    assert capsys.readouterr().err == ("hvi: warning: emi.yaml, line 11: 0.61 mm leaves fewer than 3 layers of particles in the last wall: if that decides, "
                                       "the verdict will be undecided\n")
    (folder / "emi.yaml").write_text(CASE)
    assert front("shield") == 3 and capsys.readouterr().err == ""


def test_materials_in_wrong_units_are_said_beforehand(folder, root, capsys):
    """each file once; the package's own never"""
    text = (root / "potentials" / "Al6061-T6.hvi").read_text()
    (folder / "own.hvi").write_text(re.sub(r"(?m)^  A  .*", "  A 324", text, count=1))
    (folder / "emi.yaml").write_text(CASE.replace("material: Al2024-T3}", "material: own}").replace("material: Al6061-T6", "material: own"))
    assert front("shield", "--dry-run") == 0
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and said.startswith(f"hvi: warning: {folder / 'own.hvi'}: strength johnson-cook: A = 324 is far from what is usual with its eos, "), said


def test_dry_run(folder, capsys):
    """the plan of each spacing, from geometry alone, and a sketch that shows what passes beside; nothing is run"""
    from matplotlib.image import imread

    assert front("shield", "--dry-run", "--jobs", "2") == 0
    out = capsys.readouterr().out
    cost = re.search(r"^ *core_s +about (\S+) +about (\S+)$", out, re.M).groups()
    seconds = sum(map(float, cost)) / 2  # two of each spacing, on four cores
    assert f"4 runs, 2 of each spacing: at most about {engine.duration(seconds)} if the wall fails, up to 3 times that if it does not, 2 at a time on 2 ranks each, on idle cores" in out
    count = [math.pi * (15 / dx) ** 2 * n1 / 4 + math.pi * (60 / dx) ** 2 * n2 / 4 + math.pi / 6 * (5 / dx) ** 3 / 4 for dx, n1, n2 in ((0.4, 2, 3), (0.2, 4, 6))]
    said = re.search(r"^ *particles +(\d+) +(\d+)$", out, re.M)
    assert [int(word) for word in said.groups()] == pytest.approx(count, abs=1)
    assert re.search(r"^ *wall2_areal_density_kg_m2 +3.244 +3.244$", out, re.M) and re.search(r"^ *areal_density_kg_m2 +5.472 +5.472$", out, re.M), out
    assert re.search(r"^ +2 +60.8 +60 +0 +0$", out, re.M) and not tries(folder) and not list(folder.glob("runs/**/*.yaml"))
    picture = imread(folder / "runs/emi/sketch.png")[..., :3]
    assert 0.01 < np.mean(picture.min(axis=2) < 0.9) < 0.6
    case = cases.read("emi.yaml")
    plan = chain.plan_of(chain.shield_of(case, 0, 0.0))
    texts = [text.get_text() for text in sketch.draw(case, plan).axes[0].texts]
    assert "wall 2: 1.2 mm\nAl6061-T6" in texts and "wall 1: 0.8 mm\nAl2024-T3" in texts and "60 mm" in texts
    texts = [text.get_text() for text in sketch.draw(case, {**plan, "wall2_radius_mm": 30}).axes[0].texts]
    assert "wall 2: 1.2 mm\nAl6061-T6\ncloud passes beside" in texts


@pytest.mark.each_value
@pytest.mark.parametrize("text, message", [
    (CASE.replace("[0.2, 0.4]", "[0.4, 0.02]"), "MB of memory"), (CASE.replace("diameter_mm: 5", "diameter_mm: 1000"), "more than LAMMPS can number: are lengths in mm?"),
    (CASE + "angle_deg: 89.9\n", "more than LAMMPS can number"), (CASE.replace("gap_mm: 60", "gap_mm: 1000000"), "more than LAMMPS can number"),
    (CASE.replace("gap_mm: 60", "gap_mm: 60\n" + "\n".join("  - {thickness_mm: 1.2, material: Al6061-T6, gap_mm: 60}" for _ in range(998))), "particles, "),
    (CASE.replace("gap_mm: 60", "gap_mm: 60\n" + "\n".join("  - {thickness_mm: 1.2, material: Al6061-T6, gap_mm: 60}" for _ in range(999))), "walls: 1001 walls, 1000 at most")],
    ids=["fine", "large", "grazing", "far", "many", "more"])
@pytest.mark.parametrize("words", [("--dry-run",), ()], ids=["plan", "run"])
def test_too_large(folder, capsys, text, message, words):
    """what no machine here can hold is refused before a particle is made, with the number of particles"""
    (folder / "emi.yaml").write_text(text)
    start = time.process_time()
    assert front("shield", *words) == 1 and message in capsys.readouterr().err and not tries(folder)
    assert time.process_time() - start < 30  # seconds: it would hang else; a second of them is usual


def test_time_of_a_plan(folder, capsys):
    """a case that says when its runs end has no later end; no more runs at a time than there are, and none is shorter than the longest"""
    (folder / "emi.yaml").write_text(CASE + "settings: {tstop: 40}\n")
    assert front("shield", "--dry-run", "--jobs", "9", "--ranks", "1") == 0
    out = capsys.readouterr().out
    longest = float(re.search(r"^ *core_s .* about (\S+)$", out, re.M)[1])
    assert f": at most about {engine.duration(longest)}, 4 at a time on 1 ranks each, on idle cores; a run ends when its event is over\n" in out


def test_no_room_on_the_disk(folder, capsys, monkeypatch):
    """all frames, and restart files of the runs at a time"""
    plans = [chain.plan_of(chain.shield_of(cases.read("emi.yaml"), which, 0.0)) for which in (0, 1)]
    needed = 2 * sum(plan["frames_MB"] for plan in plans) + max(plan["disk_MB"] - plan["frames_MB"] for plan in plans)
    for free, status in ((needed - 1, 1), (needed + 1, 0)):
        monkeypatch.setattr(machine, "free_disk", lambda path, free=free: (free, path))
        assert front("shield", "--dry-run") == status
    assert "MB would be written, and " in capsys.readouterr().err


def test_undecided_runs_and_what_is_not_modelled(folder, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_UNSURE", "9")
    assert front("shield") == 4
    assert "verdict: undecided\n  - 1 percent of the energy of the shot are still on their way to wall 2 at 95.9 us, the end at the latest -- take settings: {tstop: 143.8} (dx-0.4_shift-0.0, " in capsys.readouterr().out
    monkeypatch.delenv("FAKE_UNSURE")
    (folder / "emi.yaml").write_text(CASE + "not_modelled: [MLI, honeycomb]\n")
    assert front("shield") == 4
    assert engine.read_yaml(folder / "runs/emi/dx-0.2_shift-0.0/job.yaml")["variables"]["outside"] == "MLI, honeycomb"


def test_both_runs(folder, capsys):
    (folder / "emi.yaml").write_text(change("shifts: [0, 0.5]", "shifts: [0]"))
    assert front("shield") == 3 and "  - both runs say so: spacings of 0.4, 0.2 mm, 1 shift of the lattice\n" in capsys.readouterr().out


def test_notes_are_not_causes(folder, capsys, monkeypatch):
    """what would make a run undecided if it did not fail comes after the causes, by itself, and without a remedy, as none changes the verdict; both of all finest runs"""
    monkeypatch.setenv("FAKE_NOTE", "yes")
    assert front("shield") == 3
    finest = "(dx-0.2_shift-0.0, dx-0.2_shift-0.5)"
    causes = ["all 4 runs say so: spacings of 0.4, 0.2 mm, 2 shifts of the lattice", f"wall 2 is perforated by a hole of 5 mm {finest}", f"wall 2 has detached spall of 4 mg {finest}"]
    notes = [f"1 percent of the energy of the shot are still on their way to wall 2 at 95.9 us, the end at the latest {finest}",
             f"debris of 12 percent of the projectile's mass passed beside wall 2 {finest}"]
    assert "\n".join(["verdict: fails", *(f"  - {text}" for text in causes), "notes:", *(f"  - {text}" for text in notes), "table: "]) in capsys.readouterr().out
    saved = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())
    assert list(saved)[:3] == ["verdict", "reasons", "notes"] and saved["reasons"] == causes and saved["notes"] == notes
    monkeypatch.delenv("FAKE_NOTE")
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield") == 3 and "notes:" not in capsys.readouterr().out + (folder / "runs/emi/verdict.yaml").read_text()


def test_one_spacing_is_no_verdict(folder, capsys):
    (folder / "emi.yaml").write_text(change("[0.2, 0.4]", "[0.4]"))
    assert front("shield") == 4
    assert "verdict: undecided\n  - one spacing only: nothing says how much it matters" in capsys.readouterr().out


@pytest.mark.parametrize("ball", ["fill: glass\n  diameter_mm: 5", "shape: file\n  file: ball.data"])
def test_particles_in_files(folder, ball):
    """The front door runs what is not on a lattice, and what is done is not run again; particles of a file that has changed are another projectile"""
    text = change("diameter_mm: 5", ball).replace("[0.2, 0.4]", "[0.5]")
    (folder / "emi.yaml").write_text(text)
    made = bodies.make(bodies.sphere(2.5e-3), 5e-4, "glass", 1)

    def write(by, density=2785):
        bodies.write_data(folder / "ball.data", by * made.x, 1, [2785 * made.volume] * len(made.x), density, made.x.min(axis=0) - 5e-4, made.x.max(axis=0) + 5e-4, (), "ball")

    write(1)
    if "file" in ball:
        with pytest.raises(HVIError, match="shifts: particle files have no lattice that could be shifted"):
            cases.read("emi.yaml")
        (folder / "emi.yaml").write_text(text.replace("shifts: [0, 0.5]\n", ""))
    assert front("shield") == 4
    first = begun(folder)
    assert len(first) == len(list(folder.glob("runs/emi/*/ball.data"))) == (1 if "file" in ball else 2)
    assert front("shield") == 4 and begun(folder) == first
    write(1.001)
    assert front("shield") == 4
    assert all((begun(folder)[name] == first[name]) == ("glass" in ball) for name in first)


def test_particles_of_a_file_do_not_touch_the_wall(folder):
    """half of a spacing belongs to each, as to those of a glass of a sphere"""
    made = bodies.make(bodies.sphere(2.5e-3), 5e-4, "glass", 1)
    bodies.write_data(folder / "ball.data", made.x, 1, [2785 * made.volume] * len(made.x), 2785, made.x.min(axis=0) - 5e-4, made.x.max(axis=0) + 5e-4, (), "ball")
    extent, *_ = projectile.measured(str(folder / "ball.data"), 2785.0)
    assert 0.25 < 0.5 * extent - 1e3 * (made.x[:, 2] - stl.middle(made.x)[2]).max() < 0.35


@pytest.mark.parametrize("name, sides, turn, refused", [("plate.stl", (10, 10, 1.9), 0, "1.9 mm"), ("plate.stl", (10, 10, 2.1), 0, ""), ("plate.stl", (10, 10, 1.9), 45, "1.9 mm"), ("plate.stl", (10, 10, 2.1), 45, ""),
                                                        ("plate.data", (5, 5, 1.5), 0, "1.5 mm"), ("plate.data", (5, 5, 2.0), 0, "")])
def test_plates_of_files_have_layers(folder, name, sides, turn, refused):
    """four particles across the thinnest of a body of a file, however it lies: not of the sphere of its mass"""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    if name.endswith("stl"):
        corners = np.array([[x, y, z] for x in (0, sides[0]) for y in (0, sides[1]) for z in (0, sides[2])]) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        faces = [corners[list(face)] for a, b, p, q in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)) for face in ((a, b, p), (a, p, q))]
        text = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x:.9f} {y:.9f} {z:.9f}\n" for x, y, z in face) + "endloop\nendfacet\n" for face in faces)
        (folder / name).write_text(f"solid plate\n{text}endsolid plate\n")
    else:
        x = 5e-4 * np.stack(np.meshgrid(*(np.arange(round(side / 0.5)) for side in sides)), axis=-1).reshape(-1, 3)
        bodies.write_data(folder / name, x, 1, [2785 * 1.25e-10], 2785, x.min(axis=0), x.max(axis=0), (), "plate")
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", f"shape: file\n  file: {name}").replace("[0.2, 0.4]", "[0.5]").replace("shifts: [0, 0.5]", "shifts: [0]"))
    if refused:
        with pytest.raises(HVIError, match=f"spacings_mm: 0.5 mm leaves fewer than 4 particles across the projectile of {refused}"):
            cases.read("emi.yaml")
    else:
        assert cases.read("emi.yaml").projectile.volume_mm3 == pytest.approx(math.prod(sides), rel=1e-5)  # places of STL are rounded


def surface(points):
    """triangles of the hull of points, (n, 3, 3), normals outward"""
    points = np.array(points, float)
    middle, faces = points.mean(axis=0), points[ConvexHull(points).simplices]
    return np.array([(a, b, c) if np.dot(np.cross(b - a, c - a), a - middle) > 0 else (a, c, b) for a, b, c in faces])


def test_least_width_of_surfaces():
    """of bodies without hollows the width of the slab that they fit into, of a shell twice its wall"""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    x = np.random.default_rng(1).normal(size=(1000, 3))
    ball = surface(x / np.linalg.norm(x, axis=1)[:, None])
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    assert stl.least(surface(corners)) == pytest.approx(1, rel=1e-9)
    assert stl.least(surface(corners * (10, 10, 0.55) @ turn)) == pytest.approx(0.55, rel=1e-9)
    assert stl.least(surface([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])) == pytest.approx(2, rel=1e-9)
    assert stl.least(ball) == pytest.approx(2, rel=0.03)
    assert stl.least(np.concatenate([ball, 0.9 * ball[:, ::-1]])) == pytest.approx(0.2, rel=0.1)


@pytest.mark.parametrize("types_, masses, density, style, message", [
    (1, [3.5e-7], 2785, "sph", ""), (1, [3.5e-7], 8930, "sph", "ball.data has a density of 8930 kg/m^3, and the material of the projectile 2785: python3 -m hvi body --material"),
    (2, [3.5e-7, 7e-7], 2785, "sph", "ball.data has particles of several masses or densities"), (2, [3.5e-7, 3.5e-7], 2785, "sph", ""),
    (2, [3.5e-7, 3.5e-7], [2785, 8930], "sph", "ball.data has particles of several masses or densities"), (1, [3.5e-7], 2785, "hybrid", "ball.data: atom_style hybrid is not read here")])
def test_particle_files_are_of_the_material(folder, types_, masses, density, style, message):
    """its density, and one mass: a projectile is of equal particles of one material"""
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", "shape: file\n  file: ball.data").replace("[0.2, 0.4]", "[0.5]").replace("shifts: [0, 0.5]\n", ""))
    x = 5e-4 * np.stack(np.meshgrid(*3 * (np.arange(6),)), axis=-1).reshape(-1, 3)
    kind = 1 + np.arange(len(x)) % types_
    bodies.write_data(folder / "ball.data", x, kind, masses, np.array(density)[kind - 1] if isinstance(density, list) else density, x.min(axis=0), x.max(axis=0), (), "ball")
    path = folder / "ball.data"
    path.write_text(path.read_text().replace("Atoms # sph", f"Atoms # {style}"))
    if message:
        with pytest.raises(HVIError, match=re.escape(message)):
            cases.read("emi.yaml")
    else:
        assert cases.read("emi.yaml").projectile.volume_mm3 == pytest.approx(216 * 3.5e-7 / 2785 * 1e9)


def test_goes_on(folder, capsys, monkeypatch):
    """what failed or is changed is run again, and nothing else; no verdict from a part of the runs"""
    monkeypatch.setenv("FAKE_FAIL", "dx-0.2_shift-0.5")
    assert front("shield") == 1
    out, err = capsys.readouterr()
    assert "dx-0.2_shift-0.5  FAILED: exit status 1" in out and "| ERROR: Lost atoms" in out and "verdict:" not in out
    assert err == "hvi: no verdict: 1 of 4 runs failed: dx-0.2_shift-0.5\n" and not (folder / "runs/emi/verdict.yaml").exists()
    monkeypatch.delenv("FAKE_FAIL")
    first = begun(folder)
    assert front("shield") == 3 and "4 runs, 3 done before, 1 to run" in capsys.readouterr().out
    assert {name for name, when in begun(folder).items() if when != first[name]} == {"dx-0.2_shift-0.5"}
    (folder / "mine.hvi").write_text(MINE + "\n")
    (folder / "emi.yaml").write_text(change("Al6061-T6", "mine"))
    assert front("shield") == 3 and "4 runs, 0 done before" in capsys.readouterr().out
    assert front("shield") == 3 and "4 runs, 4 done before" in capsys.readouterr().out
    (folder / "mine.hvi").write_text(MINE + " \n")  # the name is the same, the file is not
    assert front("shield") == 3 and "4 runs, 0 done before" in capsys.readouterr().out
    assert (folder / "runs/emi/verdict.yaml").exists()
    (folder / "mine.hvi").write_text(MINE)
    monkeypatch.setenv("FAKE_FAIL", "dx-0.2_shift-0.5")
    assert front("shield") == 1 and not (folder / "runs/emi/verdict.yaml").exists()  # no verdict is left of other runs


def test_run_goes_on_from_what_it_left(folder, capsys):
    """a run that was stopped goes on from its last restart file, in the folder that it has; not if it is of another case"""
    assert front("shield") == 3
    stopped = folder / "runs/emi/dx-0.2_shift-0.0"
    (stopped / "result.yaml").unlink()
    (stopped / "shield.restart.a").write_text("")
    (stopped / "chain.yaml").write_text("{leg: 1, file: shield.restart.a}\n")
    assert front("shield") == 3 and tries(folder)[stopped.name] == 2
    assert (stopped / "tries").read_text().split() == ["no", "yes"] and not (stopped / "chain.yaml").exists()
    (stopped / "result.yaml").unlink()
    (stopped / "shield.restart.a").write_text("")
    (stopped / "chain.yaml").write_text("{leg: 1, file: shield.restart.a}\n")
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield") == 3 and (stopped / "tries").read_text().split() == ["no"]


def test_result_without_verdict_is_an_error(folder, capsys):
    assert front("shield") == 3
    path = folder / "runs/emi/dx-0.4_shift-0.0/result.yaml"
    path.write_text(path.read_text().replace("verdict: fails", "perforated: no"))
    assert front("shield") == 1
    assert "no verdict, holds, fails or undecided, but None" in capsys.readouterr().err


def test_another_process_is_at_it(folder, capsys, monkeypatch):
    """after kill -9 of the front door its runs go on: the next call waits for them, and does not begin them again"""
    command = [sys.executable, "-m", "hvi", "shield", "emi.yaml", "--mpirun", "./mpirun", "--jobs", "2"]
    process = subprocess.Popen(command, cwd=folder, env={**os.environ, "FAKE_SLEEP": "4"}, stdout=subprocess.DEVNULL)
    wait_for(lambda: len(tries(folder)) == 2)
    process.kill()
    process.wait()
    assert not list(folder.glob("runs/emi/*/result.yaml"))
    first = begun(folder)
    assert front("shield", "--jobs", "4") == 3
    assert len(first) == 2 and len(begun(folder)) == 4 and first.items() <= begun(folder).items()


# ---------------------------------------------------------------------- the engine
def test_included_files_are_inputs(folder):
    """a change in one of them counts; they are copied into the folders of runs, and their variables are known"""
    (folder / "in.main").write_text("variable D index 1\ninclude more/in.part # walls\n")
    (folder / "more").mkdir()
    (folder / "more/in.part").write_text("variable t index 1\n")
    first = engine.Input(folder / "in.main")
    assert set(first.known) == {"D", "t"}
    first.copy_to(folder / "there")
    assert (folder / "there/more/in.part").read_text() == "variable t index 1\n"
    (folder / "in.whole").write_text(f"include {folder}/more/in.part\n")  # stays where it is
    whole = engine.Input(folder / "in.whole")
    whole.copy_to(folder / "whole")
    assert set(whole.known) == {"t"} and [path.name for path in (folder / "whole").iterdir()] == ["in.whole"]
    (folder / "more/in.part").write_text("variable t index 2\n")
    assert engine.Input(folder / "in.main").checksum() != first.checksum() and engine.Input(folder / "in.whole").checksum() != whole.checksum()
    (folder / "in.whole").write_text(f"include {folder}/lost/in.part\nvariable D index 1\n")  # the run may make it
    assert set(engine.Input(folder / "in.whole").known) == {"D"}
    (folder / "in.main").write_text("include in.lost\n")
    with pytest.raises(HVIError, match="cannot read .*in.lost"):
        engine.Input(folder / "in.main")


def test_stage_of_a_run(folder):
    """from the last whole line of its thermo output; nothing where there is none"""
    job = decision.job(cases.read("emi.yaml"), (0, 0.0), folder / "a")
    assert job.stage() == (0.0, "")
    (folder / "a").mkdir()
    (folder / "a/output.txt").write_text("   Step v_us Dt \n 0 0.0 1e-9\n 100 12.0 1e-9\n 200 14.")
    part, words = job.stage()
    assert part == pytest.approx(12.0 / job.shield.geometry.tstop_us) and words == f" 12.0 us, enough are {job.shield.geometry.tstop_us:.1f}"


def test_bar_on_a_terminal(folder):
    """the lines of runs stay whole beside it, and nothing of it is left"""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
    code = "import hvi.progress as p; p.DELAY = 0.0; from hvi.cli import main; raise SystemExit(main())"
    process = subprocess.Popen([sys.executable, "-c", code, "shield", "emi.yaml", "--mpirun", "./mpirun"], stdout=slave, stderr=slave)
    os.close(slave)
    shown = b""
    with contextlib.suppress(OSError):  # what a terminal gives when nobody writes any more
        while part := os.read(master, 10_000):
            shown += part
    os.close(master)
    shown = shown.decode()
    assert process.wait() == 3 and "emi:   0%|" in shown and "emi:" not in shown.partition("verdict: ")[2].partition("table:")[0]
    assert all(re.search(rf"(^|\r|\n)\[{k}/4\] dx-0.[24]_shift-0.[05]  ok", shown) for k in (1, 2, 3, 4))


# ---------------------------------------------------------------------- the real thing
REAL = """projectile: {diameter_mm: 6, material: Al2017-T4}
speed_km_s: 7
walls:
  - {thickness_mm: 1.5, material: Al6061-T6, radius_mm: 8}
  - {thickness_mm: 2.4, material: Al6061-T6, gap_mm: 10, radius_mm: 14}
spacings_mm: [0.8, 0.66]
shifts: [0]
"""


def test_real_shield(root, lmp_exe, tmp_path, monkeypatch, capsys):
    """from a YAML file to a verdict by LAMMPS: two spacings, 3 layers in the wall that decides, which a fast heavy shot goes through"""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))
    (tmp_path / "hit.yaml").write_text(REAL)
    words = ["shield", "hit.yaml", "--lmp", str(lmp_exe), "--ranks", "1", "--jobs", "2"]
    assert cli.main([*words, "--dry-run"]) == 0
    out = capsys.readouterr().out
    assert re.search(r"^ *wall2_layers +3 +4$", out, re.M) and (tmp_path / "runs/hit/sketch.png").stat().st_size > 10000
    assert cli.main(words) == 3
    out = capsys.readouterr().out
    said = yaml.safe_load((tmp_path / "runs/hit/verdict.yaml").read_text())
    assert said["verdict"] == "fails" and set(said["runs"].values()) == {"fails"} and re.search(r"wall 2 is perforated by a hole of \d", out)
    assert cli.main(words) == 3 and "2 runs, 2 done before, 0 to run" in capsys.readouterr().out


# ---------------------------------------------------------------------- walls of elements
HYBRID = change("speed_km_s: 7.1", "speed_km_s: 7.1\nmethod: hybrid")


def test_case_with_elements(folder):
    """what runs find in their folders: a mesh for each wall, of types, layers and spacing that are theirs"""
    (folder / "emi.yaml").write_text(HYBRID)
    case = cases.read("emi.yaml")
    assert case.variables(1, 0.0)["method"] == "hybrid"
    made = decision.job(case, (1, 0.0), folder / "a").record["made"]
    first, second = made["wall1.data"], made["wall2.data"]
    assert (first["type"], first["node_type"], second["type"], second["node_type"]) == (2, 4, 3, 5)
    assert (first["n"], first["layers"], first["element"], second["n"], second["layers"]) == (2, 2, pytest.approx(4e-4), 2, 3)
    assert (first["core"], first["hold"], first["side"]) == pytest.approx((4e-3, 10e-3, 30e-3))  # 1.6, 4 and 6 radii
    reach = 0.75 * 60 + 6 * 2.5  # what the cloud can strike
    assert (second["core"], second["hold"], second["side"]) == pytest.approx((0.5e-3 * reach, 1e-3 * reach, 2.5e-3 * reach))
    assert first["quarter"] is True and first["growth"] > 1
    (folder / "emi.yaml").write_text(CASE.replace("gap_mm: 60", "gap_mm: 60\n    method: tied\n    radius_mm: 30\n    core_mm: 0") + "angle_deg: 20\n")
    case = cases.read("emi.yaml")
    assert case.variables(0, 0.0)["method"] == "tied" and list(decision.job(case, (0, 0.0), folder / "b").record["made"]) == ["wall2.data"]
    words = decision.job(case, (0, 0.0), folder / "b").record["made"]["wall2.data"]
    assert words["n"] == 3 and words["core"] == 0 and "hold" not in words and words["quarter"] is False
    assert words["side"] >= 60e-3 and words["side"] / (2 * words["element"]) == pytest.approx(round(words["side"] / (2 * words["element"])))
    assert "made" not in decision.job(cases.read(written(folder, CASE)), (0, 0.0), folder / "c").record


@pytest.mark.parametrize("more, angle", [("", 0), pytest.param("", 30, marks=pytest.mark.long), (", radius_mm: 12, core_mm: 0", 0), (", radius_mm: 14, hold_mm: 12", 30)], ids=["quarter", "whole", "no core", "few beyond"])
def test_elements_are_in_the_plan(folder, monkeypatch, more, angle):
    """free and embedded particles and nodes of the files that are made; frames, memory, disk and restart files follow from these"""
    (folder / "emi.yaml").write_text(HYBRID.replace("gap_mm: 60", "gap_mm: 8").replace("thickness_mm: 0.8,", f"thickness_mm: 0.8{more},") + f"angle_deg: {angle}\n")
    case = cases.read("emi.yaml")
    shield = chain.write_run(case, 1, 0.0, folder / "run")
    plan, found = chain.plan_of(shield), [DataFile(folder / f"run/wall{k}.data").frame()["type"] for k in (1, 2)]
    for k, types_ in enumerate(found, 1):
        assert plan[f"wall{k}_particles"] == pytest.approx((types_ == 1 + k).sum(), rel=0.02) and shield.of_walls[k - 1][2] == pytest.approx((types_ == 3 + k).sum(), rel=0.03), k
    count, nodes = (sum((types_ == first + k).sum() for k, types_ in enumerate(found, 1)) for first in (1, 3))
    assert plan["particles"] == pytest.approx(count + plan["projectile_particles"], rel=0.02) and plan["nodes"] == pytest.approx(nodes, rel=0.03)
    assert plan["memory_MB"] > 35 + 3e-3 * (count + nodes) and plan["frames_MB"] == pytest.approx(1.5e-4 * plan["frames"] * plan["particles"], rel=0.01) and plan["frames_MB"] < 500
    assert plan["disk_MB"] > plan["frames_MB"] + 2.3e-3 * (count + nodes)
    monkeypatch.setattr(chain, "LEG", (count + nodes) * shield.steps() / 8)
    assert chain.legs(shield) == 8


def written(folder, text):
    (folder / "other.yaml").write_text(text)
    return "other.yaml"


@pytest.mark.parametrize("text, line, message", [
    (HYBRID.replace("[0.2, 0.4]", "[0.2, 0.16]"), 6, "wall 1: method: hybrid: 5 layers of particles (spacing 0.16 mm) are no whole elements of 2 or 3 each way: "
     "spacings_mm of 0.2 or 0.1334 would do"),
    (change("{thickness_mm: 0.8,", "{thickness_mm: 0.8, hold_mm: 5,"), 7, "wall 1: hold_mm: is of elements: method hybrid or tied"),
    (change("gap_mm: 60", "gap_mm: 60\n    method: tied").replace("{thickness_mm: 0.8,", "{thickness_mm: 0.8, method: hybrid,"), 11, "wall 2: method: tied, but another wall is hybrid"),
    (HYBRID.replace("{thickness_mm: 0.8,", "{thickness_mm: 0.8, hold_mm: 4,"), 6, "free particles up to 4 mm need elements with particles around them, up to 5.2 mm at least"),
    (change("speed_km_s: 7.1", "speed_km_s: 7.1\nmethod: fem"), 6, "method: must be sph, hybrid or tied, not fem")])
def test_wrong_elements(folder, capsys, text, line, message):
    (folder / "emi.yaml").write_text(text)
    assert front("shield") == 1
    err = capsys.readouterr().err
    assert f"emi.yaml, line {line}: " in err and message in err, err
    assert not (folder / "runs").exists()


def test_meshes_are_made(folder, capsys):
    """in the folder of each run; another hold_mm is another run; the sketch shows them"""
    text = HYBRID.replace("gap_mm: 60", "gap_mm: 10")
    (folder / "emi.yaml").write_text(text)
    assert front("shield", "--dry-run") == 0
    capsys.readouterr()
    assert front("shield") == 3 and "4 to run" in capsys.readouterr().out
    for k in (1, 2):
        head = (folder / f"runs/emi/dx-0.2_shift-0.5/wall{k}.data").read_text()[:400]
        assert f"mesh wall{k}.data, mirror x 0 lo mirror y 0 lo" in head and re.search(r"^\d+ elements$", head, re.M)
    (folder / "emi.yaml").write_text(text.replace("{thickness_mm: 0.8,", "{thickness_mm: 0.8, hold_mm: 11,"))
    assert front("shield") == 3 and "0 done before, 4 to run" in capsys.readouterr().out
    case = cases.read("emi.yaml")
    labels = [label for label in sketch.draw(case, chain.plan_of(chain.shield_of(case, 0, 0.0))).axes[0].get_legend_handles_labels()[1]]
    assert labels.count("elements") == labels.count("elements that hold particles") == 1
    assert not decision.fits(case, 0.8) and decision.fits(case, 0.5)  # 0.16 and 0.1 mm
    assert front("limit", "--on", "thickness1", "--from", "0.7", "--to", "1.1", "--step", "0.1") == 1
    assert "thickness1 0.9 mm: wall 1: method: hybrid: 5 layers" in capsys.readouterr().err


@pytest.mark.parametrize("shape, number", [("{shape: cylinder, diameter_mm: 2.4, length_mm: 9, pitch_deg: 60", 1), ("{shape: cube, side_mm: 4", 4), ("{shape: cube, side_mm: 4, pitch_deg: -30", 1),
                                           ("{shape: hollow sphere, diameter_mm: 8, thickness_mm: 1.6", 4)])
def test_real_shapes(root, lmp, tmp_path, shape, number):
    """LAMMPS makes the body that a case asks for: its mass, its extents, pitched ones to both sides, a quarter of it where planes are mirrors; the result has its number of particles, and a note
    if it is not the one planned"""
    (tmp_path / "hit.yaml").write_text(REAL.replace("{diameter_mm: 6", shape).replace("[0.8, 0.66]", "[0.4]"))
    case = cases.read(tmp_path / "hit.yaml")
    made = chain.write_run(case, 0, 0.0, tmp_path / "run")
    log = lmp(tmp_path / "run/in.shield", cwd=tmp_path / "run", vars={"until": 0.02}).log
    frame = hvi.Dump(str(sorted((tmp_path / "run").glob("film.*.dump"))[0]))[0]
    ball, body = frame.select(frame["type"] == 1), case.projectile
    assert made.images == number and number * ball.m.sum() == pytest.approx(2790 * 1e-9 * body.volume_mm3, rel=5e-6)  # a dump has six digits of a mass
    assert number * len(ball) == pytest.approx(body.volume_mm3 / 0.4**3, rel=0.1)
    assert chain.plan_of(made)["projectile_across"] == {"cylinder": 6, "cube": 10, "hollow sphere": 20}[body.shape]  # its least extent
    x = 1e3 * ball.x + [0, 0, body.radius_mm]
    c, s = math.cos(math.radians(body.pitch_deg)), math.sin(math.radians(body.pitch_deg))
    across, y, along = c * x[:, 0] - s * x[:, 2], x[:, 1], c * x[:, 2] + s * x[:, 0]
    if body.shape == "cylinder":
        assert -4.501 < along.min() < -4.2 and 4.2 < along.max() < 4.501 and 0.9 < np.hypot(across, y).max() < 1.201
    elif body.shape == "cube":
        low = -2.001 if number == 1 else 0
        assert all(low <= side.min() and 1.7 < side.max() < 2.001 for side in (across, y)) and -2.001 < along.min() < -1.7 and 1.7 < along.max() < 2.001
        assert number == 4 or min((a * across + b * along).max() for a in (-1, 1) for b in (-1, 1)) > 3.45  # all edges
    else:
        r = np.linalg.norm(x, axis=1)
        assert 2.4 <= r.min() < 2.8 and 3.6 < r.max() <= 4.0
    for text, many in ((log, len(ball)), (log.replace(f"\n{len(ball)} atoms in group ball\n", "\n50 atoms in group ball\n"), 50), ("", math.nan)):
        (tmp_path / "run/log.lammps").write_text(text)
        found = chain.judge(tmp_path / "run")
        assert found["projectile_particles"] == pytest.approx(many, nan_ok=True) and ("filled" in found["rules"]) == (many == 50)
        assert any("the projectile has 50 particles where " in note for note in found.get("notes", [])) == (many == 50)


@pytest.mark.parametrize("shape, quarter", [("diameter_mm: 6", True), pytest.param("shape: hollow sphere, diameter_mm: 8, thickness_mm: 1.6", True, marks=pytest.mark.long), ("shape: cube, side_mm: 4", True),
                                            ("shape: cylinder, diameter_mm: 4, length_mm: 6, pitch_deg: 30", False)])
def test_real_glass(root, lmp, tmp_path, shape, quarter):
    """particles without rows: the exact mass, inside of the body, another glass for each shift, the same one again; a quarter has no images closer than others"""
    (tmp_path / "hit.yaml").write_text(REAL.replace("{diameter_mm: 6", "{fill: glass, " + shape).replace("[0.8, 0.66]", "[0.4]"))
    case = cases.read(tmp_path / "hit.yaml")
    several = shape.startswith("diameter")  # of one shape: it takes as long as the rest
    made = {name: chain.write_run(case, 0, shift, tmp_path / name) for name, shift in (("run", 0.0), *([("again", 0.0), ("other", 0.25)] * several))}
    assert made["run"].images == (4 if quarter else 1) and cases.read(tmp_path / "run/case.yaml").projectile.mapping() == case.projectile.mapping()
    text = {name: (tmp_path / name / "ball.data").read_text() for name in made}
    assert not several or text["run"] == text["again"] != text["other"]
    lmp(tmp_path / "run/in.shield", cwd=tmp_path / "run", vars={"until": 0.02})
    frame = hvi.Dump(str(sorted((tmp_path / "run").glob("film.*.dump"))[0]))[0]
    ball = frame.select(frame["type"] == 1)
    assert made["run"].images * ball.m.sum() == pytest.approx(2790e-9 * case.projectile.volume_mm3, rel=5e-6)  # a dump has six digits of a mass
    x = 1e3 * ball.x + [0, 0, case.projectile.radius_mm]
    if quarter:
        assert x[:, :2].min() > 0.1  # of 0.4 mm
    else:
        c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
        x = np.column_stack([c * x[:, 0] - s * x[:, 2], x[:, 1], s * x[:, 0] + c * x[:, 2]])
        assert abs(x[:, 2]).max() < 3 and 1.6 < np.hypot(x[:, 0], x[:, 1]).max() < 2
    near = np.sort(np.linalg.norm(x[:, None] - x, axis=2), axis=1)[:, 1]
    assert near.min() > 0.7 * 0.4 and len(set(np.round(x[:, 0], 4))) > 0.9 * len(x)


def test_real_bodies_of_files(root, lmp, tmp_path):
    """an STL file and a particle file of the same tetrahedron-like body: mass, center, and no particle outside of it"""
    corners = np.array([[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6.0]]) + [10, 20, 30]
    with open(tmp_path / "body.stl", "w") as out:
        out.write("solid body\n")
        for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
            out.write("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in corners[list(face)]) + "endloop\nendfacet\n")
        out.write("endsolid body\n")
    text = REAL.replace("{diameter_mm: 6", "{shape: file, file: body.stl").replace("[0.8, 0.66]", "[0.5]")
    (tmp_path / "hit.yaml").write_text(text)
    case = cases.read(tmp_path / "hit.yaml")
    assert case.projectile.volume_mm3 == pytest.approx(36) and case.projectile.radius_mm == pytest.approx(math.sqrt(27))
    made = chain.write_run(case, 0, 0.0, tmp_path / "run")
    assert made.images == 1 and (tmp_path / "run/body.stl").exists() and cases.read(tmp_path / "run/case.yaml").projectile.volume_mm3 == pytest.approx(36)
    shutil.copy(tmp_path / "run/ball.data", tmp_path / "body.data")
    x = DataFile(tmp_path / "body.data").frame().x * 1e3 + 3
    assert x.min() > 0 and x.sum(axis=1).max() < 6 and len(x) == pytest.approx(36 / 0.125, rel=0.1)
    (tmp_path / "again.yaml").write_text(text.replace("body.stl", "body.data"))
    lmp(tmp_path / "run/in.shield", cwd=tmp_path / "run", vars={"until": 0.02})
    frame = hvi.Dump(str(sorted((tmp_path / "run").glob("film.*.dump"))[0]))[0]
    ball = frame.select(frame["type"] == 1)
    assert ball.m.sum() == pytest.approx(2790 * 36e-9, rel=1e-6) and np.allclose(0.5e3 * (ball.x.min(axis=0) + ball.x.max(axis=0)), [0, 0, -math.sqrt(27)], atol=0.5)
    again = cases.read(tmp_path / "again.yaml").projectile
    assert again.volume_mm3 == pytest.approx(36, rel=1e-6)
    (tmp_path / "hole.stl").write_text((tmp_path / "body.stl").read_text().replace("facet normal 0 0 0", "facet", 1).replace("endsolid", "endsolid").rpartition("facet normal")[0] + "endsolid body\n")
    (tmp_path / "hit.yaml").write_text(text.replace("body.stl", "hole.stl"))
    with pytest.raises(HVIError, match="hole.stl is not closed|cannot read"):
        cases.read(tmp_path / "hit.yaml")


def test_real_meshes(root, lmp, tmp_path):
    """LAMMPS takes the meshes that a case makes: as many elements as the files have"""
    (tmp_path / "hit.yaml").write_text("method: hybrid\n" + REAL.replace("[0.8, 0.66]", "[0.8]"))
    chain.write_run(cases.read(tmp_path / "hit.yaml"), 0, 0.0, tmp_path / "run")
    lmp(tmp_path / "run/in.shield", cwd=tmp_path / "run", vars={"until": 0.05})
    elements = sum(int(re.search(r"^(\d+) elements$", (tmp_path / f"run/wall{k}.data").read_text()[:400], re.M)[1]) for k in (1, 2))
    assert np.loadtxt(tmp_path / "run/history.dat")[0, 3 + record.BOOK] == elements


@pytest.mark.parametrize("coarse, fine, found", [
    ((0.04, 0.09), (0.02, 0.03), "the largest piece that strikes wall 2 has not converged: 0.06 of the projectile's mass at 0.4 mm, 0.024 at 0.2 mm"),
    ((0.02, 0.02), (0.04, 0.04), "0.02 of the projectile's mass at 0.4 mm, 0.04 at 0.2 mm"),
    ((0.04, 0.09), (0.01, 0.05), ""), ((0.04, 0.05), (0.03, 0.035), ""), ((0.0003, 0.09), (0.0001, 0.0002), ""), ((0.04, 0.09), (0.0, 0.01), ""), ((None, 0.09), (0.01, 0.01), "")])
def test_pieces_that_go_with_the_spacing(folder, coarse, fine, found):
    """geometric means over the shifts, of pieces wider than two spacings"""
    case = cases.read("emi.yaml")
    values = dict(zip(decision.members(case), (*coarse, *fine)))
    results = {member: {} if value is None else {"wall2_reached": True, "wall1_largest_fragment_mm": 5 * value**(1 / 3), "wall1_largest_fragment_mass_fraction": value}
               for member, value in values.items()}
    jobs = {member: types.SimpleNamespace(result=lambda one=one: one) for member, one in results.items()}
    notes = decision.note_of_pieces(case, jobs)
    assert len(notes) == bool(found) and all(note.endswith(found) for note in notes)
    results[0, case.shifts[0]]["wall2_reached"] = False
    assert decision.note_of_pieces(case, jobs) == []
    (folder / "emi.yaml").write_text(change("[0.2, 0.4]", "[0.2]"))
    assert decision.note_of_pieces(cases.read("emi.yaml"), jobs) == []


def test_the_note_of_pieces_is_told(folder, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_PIECE", "0.1")
    assert front("shield") == 3
    said = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())["notes"]
    assert said == ["the largest piece that strikes wall 2 has not converged: 0.1 of the projectile's mass at 0.4 mm, 0.025 at 0.2 mm"] and said[0] in capsys.readouterr().out


@pytest.mark.parametrize("command", ["shield", "limit"])
def test_runs_of_another_version_are_told(folder, capsys, monkeypatch, command):
    """a newer package takes runs that are there, and says whose they are"""
    words = ["--on", "D", "--from", "3", "--to", "6", "--step", "1"] if command == "limit" else []
    front(command, *words)
    monkeypatch.setattr(decision, "version", lambda: "9.9")
    first = capsys.readouterr().out
    front(command, *words)
    note = "runs that were done before are of USER-HVI 0.1.0, this is 9.9: remove their folders to make them anew"
    assert note not in first and note in capsys.readouterr().out
