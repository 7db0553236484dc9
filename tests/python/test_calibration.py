"""python3 -m hvi calibrate, and what hvi shield and hvi limit say of how sure they are: made-up records with known answers; LAMMPS is a fake here."""

import dataclasses
import math
import pathlib
import re

import pytest
import yaml
from front_runs import case_folder, front, mine_folder  # noqa: F401
from hvi import cli
from hvi.errors import HVIError
from hvi.jobs import engine
from hvi.material import library
from hvi.shield import brackets, calibration, case as cases, collected
from hvi.shield.limit import Limit
from hvi.version import ROOT

STRAIN = "rear_plastic_strain"
MATERIALS = {name: engine.digest(library.find(name).read_bytes()) for name in ("Al2017-T4.hvi", "Al6061-T6.hvi")}
CASE = """projectile: {diameter_mm: 4, material: Al2017-T4}
speed_km_s: 6
walls:
  - {thickness_mm: 1.0, material: Al6061-T6}
  - {thickness_mm: 2.0, material: Al6061-T6, gap_mm: 60}
spacings_mm: [0.4, 0.3]
"""


def run(shield, verdict, margin, test, wall=2.0, **more):
    """a row of a shield whose wall varies; margin: strain where it holds, mass apart where it fails"""
    own = {"shield": shield, "source": f"report of {shield}", "on": "wall", "km_s": 6.5, "D_mm": 4.0, "bumper_mm": 1.0, "gap_mm": 70.0, "wall_mm": wall, "low": 1.8, "high": 2.2,
           "limit": 2.0, "across": 12.0, "shift": 0.0, "bulge_over_thickness": margin, STRAIN: margin, "failed_share": 0.5, "apart_over_projectile": margin if verdict == "fails" else 0.0}
    return calibration.Run(**{**own, "verdict": verdict, "test": test, **more})


def records(*runs, **head):
    known = {"command": "python3 -m hvi calibrate made-up.yaml", "date": "2026-01-01", "rows": len(runs), "shields": len({one.shield for one in runs}), "materials": MATERIALS, "settings": {},
             "model": {name: cases.SETTINGS[name].default for name in calibration.MODEL},
             "spacing": {"across": [12.0], "bumper_layers": 2, "wall_layers": 3, "ratio": 2}, "margin": STRAIN}
    found = calibration.Records({**known, **head}, runs)
    found.head.update(found.check())
    return found


# what three shields have at small strains, 0.1, 0.3 and more: A fails from 0.2 on, B holds up to a mass of 0.5 apart, C up to 0.05, and nothing is known from there to 0.3;
# the ends make the scope of speeds, gaps and walls wide
ROWS = (run("A", "holds", 0.1, "holds", 3.0, km_s=5.0, low=2.4, high=2.6), run("A", "holds", 0.2, "fails", km_s=5.0, low=2.4, high=2.6), run("A", "fails", 0.1, "fails", 1.0, km_s=5.0, low=2.4, high=2.6),
        run("B", "fails", 0.5, "holds", 1.9, gap_mm=50.0, low=1.0, high=1.1), run("B", "fails", 0.6, "fails", 0.9, gap_mm=50.0, low=1.0, high=1.1),
        run("C", "holds", 0.05, "holds", 2.3, km_s=7.0), run("C", "holds", 0.3, "fails", 1.7, km_s=7.0), run("C", "holds", 0.2, "between", 2.0, km_s=7.0),
        run("C", "undecided", 0.9, "fails", 1.6, km_s=7.0))

LARGE = run("E", "holds", 0.1, "holds", 3.0, D_mm=5.5, limit=math.nan)  # makes the scope of diameters wide


@pytest.fixture(name="case")
def case_of_a_file(tmp_path):
    return lambda text=CASE: cases.read(write(tmp_path / "case.yaml", text))


def write(path, text):
    path.write_text(text)
    return path


def result(verdict="holds", strain=0.1, mg=0.0, **more):
    margins = {"hole_mm": 0.0, "apart_mass_mg": mg, "bulge_over_thickness": 0.3, "deepest_failed_layer": 2, "layers": 5, STRAIN: strain}
    return {"verdict": verdict, "decided_by": "wall2", "margins": margins, **more}


def both(coarse, fine):
    return {(0, 0.0): coarse, (1, 0.0): fine}


# ---------------------------------------------------------------------- a verdict
@pytest.mark.parametrize("verdict, strain, mg, held, failed", [
    ("holds", 0.05, 0, 3, 0), ("holds", 0.1, 0, 2, 0), ("holds", 0.15, 0, 1, 0), ("holds", 0.2, 0, 1, 1), ("holds", 0.3, 0, 1, 2),
    ("fails", 9, 9, 1, 2), ("fails", 9, 50, 0, 2), ("fails", 9, 60, 0, 3)])
def test_votes(case, verdict, strain, mg, held, failed):
    """each shield has one, whatever it has runs; 4 mm of 2017-T4 are 93.5 mg, so that 0.1, 0.53 and 0.64 are apart"""
    found = records(*ROWS).of_verdict(case(), both(result(verdict, 0.0), result(verdict, strain, mg)))
    assert (found["held"], found["failed"], found["between"], found["shields"], found["runs"]) == (held, failed, 3 - held - failed, 3, 9)
    assert (found["margin"], found["value"]) == ((STRAIN, strain) if verdict == "holds" else ("apart_over_projectile", pytest.approx(mg / 93.5, rel=2e-3)))


def test_the_worst_of_runs_as_fine_as_the_records_counts(case):
    found = records(*ROWS).of_verdict(case(), {(0, 0.0): result(strain=0.9), (1, 0.0): result(strain=0.02), (1, 0.25): result(strain=0.2)})
    assert found["value"] == 0.2
    assert calibration.said_of_verdict(found)[0] == ("how sure: with a wall that holds with a plastic strain of 0.2 at its rear, 1 of 3 shields held in tests, 1 failed, of 1 it is not known "
                                                     "(9 runs, records of 2026-01-01)")
    finer = case(CASE.replace("[0.4, 0.3]", "[0.33, 0.22]"))  # 12 and 18 across
    assert records(*ROWS).of_verdict(finer, both(result(strain=0.1), result(strain=0.02)))["value"] == 0.1


@pytest.mark.parametrize("results, message", [
    (both(result(), result("fails")), "undecided, or differ"), (both(result(), result("undecided")), "undecided, or differ"), (both(result("undecided"), result("undecided")), "undecided, or differ"),
    (both(result(), result(decided_by="wall1")), "the last wall does not decide")])
def test_no_margin(case, results, message):
    with pytest.raises(HVIError, match=message):
        records(*ROWS).of_verdict(case(), results)


def test_case_that_is_a_record_is_left_out(case):
    """a shield within two percent, whatever its wall; of shots also the others of the report"""
    all_of, own = records(*ROWS), CASE.replace("speed_km_s: 6", "speed_km_s: 5.05").replace("gap_mm: 60", "gap_mm: 69.5")
    found = all_of.of_verdict(case(own), both(result(), result(strain=0.2)))
    assert found["left_out"] == ["A"] and (found["held"], found["failed"], found["shields"], found["runs"]) == (1, 0, 2, 6)
    assert "without A, which it is itself" in calibration.said_of_verdict(found)[0]
    assert all_of.of_verdict(case(own.replace("5.05", "5.2")), both(result(), result(strain=0.2)))["left_out"] == []
    shot = run("17", "holds", 0.1, "fails", on="-", source="NASA report of A", km_s=6.0, gap_mm=60.0, limit=math.nan, low=math.nan, high=math.nan)
    found = records(*ROWS, shot).of_verdict(case(), both(result(), result()))
    assert found["left_out"] == ["17"] and (found["shields"], found["runs"]) == (2, 6)  # A is of the same report
    found = records(*ROWS, shot).of_verdict(case(own), both(result(), result()))
    assert found["left_out"] == ["A"] and (found["shields"], found["runs"]) == (2, 6)
    with pytest.raises(HVIError, match="no records are left, all are of this shield"):
        records(*ROWS[:3]).of_verdict(case(own.replace("69.5", "70").replace("5.05", "5")), both(result(), result()))


OUTSIDE = [
    ("{diameter_mm: 4,", "{shape: cube, side_mm: 4,", "its projectile is a cube, not a sphere"), ("speed_km_s: 6", "speed_km_s: 6\nangle_deg: 30", "angle_deg is 30, not 0"),
    ("speed_km_s: 6", "speed_km_s: 7.1", "speed in km/s 7.1, of the records 5 to 7"), ("gap_mm: 60", "gap_mm: 90", "gap over diameter 22.5, of the records 12.5 to 17.5"),
    ("  - {thickness_mm: 1.0, material: Al6061-T6}\n", "", "it has 1 wall, not 2"), ("spacings_mm", "  - {thickness_mm: 2.0, material: Al6061-T6, gap_mm: 60}\nspacings_mm", "it has 3 walls, not 2"),
    ("[0.4, 0.3]", "[0.6, 0.5]", "its spacings are coarser than those of the records"), ("gap_mm: 60", "gap_mm: 60, spacings_mm: [1, 0.8]", "coarser"),
    ("[0.4, 0.3]", "[0.26, 0.2]", "its spacings are finer than those of the records, and answers go with them"),
    ("Al2017-T4", "Cu-OFHC", "Cu-OFHC is in none of them"), ("speed_km_s: 6", "speed_km_s: 6\nnot_modelled: [MLI]", "what is not modelled"), ("speed_km_s: 6", "speed_km_s: 6\nsettings: {eta: 1.3}", "eta is 1.3, not 1.2"),
    ("speed_km_s: 6", "speed_km_s: 6\nsettings: {debris: yes}", "settings: debris is yes, not no"), ("{diameter_mm: 4,", "{fill: glass, diameter_mm: 4,", "projectile: fill is glass, not lattice")]


@pytest.mark.parametrize("old, new, message", OUTSIDE)
def test_outside(case, old, new, message):
    """nothing is said of what is not like the records"""
    text = CASE.replace(old, new, 1)
    other = case(text if "{thickness_mm: 1.0" in text else text.replace(", gap_mm: 60", ""))  # nothing is in front of wall 1
    with pytest.raises(HVIError, match="the case is outside of what the records cover: .*" + message):
        records(*ROWS).for_case(other)


def test_records_older_than_a_setting(case):
    """had its default"""
    old = records(*ROWS)
    old.head["model"] = {name: value for name, value in old.head["model"].items() if name not in ("debris", "fill")}
    assert len(old.for_case(case()).shields) == 3
    with pytest.raises(HVIError, match="debris is yes, not no"):
        old.for_case(case(CASE.replace("speed_km_s: 6", "speed_km_s: 6\nsettings: {debris: yes}")))
    old.head["settings"] = {"debris": "yes"}  # what the study gave is known
    assert len(old.for_case(case(CASE.replace("speed_km_s: 6", "speed_km_s: 6\nsettings: {debris: yes}"))).shields) == 3


@pytest.mark.parametrize("old, new", [("speed_km_s: 6", "speed_km_s: 7"), ("gap_mm: 60", "gap_mm: 60, spacings_mm: [1, 0.7]"), ("speed_km_s: 6", "speed_km_s: 6\nsettings: {film: 1}")])
def test_inside(case, old, new):
    assert len(records(*ROWS).for_case(case(CASE.replace(old, new))).shields) == 3


def test_material_that_has_changed(case):
    with pytest.raises(HVIError, match="the file of Al6061-T6 is not that of the records"):
        records(*ROWS, materials={**MATERIALS, "Al6061-T6.hvi": "0123456789abcdef"}).for_case(case())


def test_records_of_several_spacings(case):
    """those count that are as fine as the case; 4 mm at 0.2 are 20 across"""
    fine = [dataclasses.replace(one, across=16.0) for one in ROWS[:5]]
    of = records(*ROWS, *fine)
    assert len(of.for_case(case()).runs) == 9 and len(of.for_case(case(CASE.replace("[0.4, 0.3]", "[0.4, 0.2]"))).runs) == 5 and len(of.finest().runs) == 5


# ---------------------------------------------------------------------- nothing is judged by itself
def test_score():
    """shields that agree with the others are right, those that do not are wrong; one that is alone has a coin"""
    agree = [run(name, "holds", margin, test) for name in "AB" for margin, test in ((0.1, "holds"), (0.3, "fails"))]
    assert records(*agree).score(STRAIN) == 0
    differ = [run("A", "holds", 0.1, "fails"), run("B", "holds", 0.1, "holds")]
    assert records(*differ).score(STRAIN) == 1 and records(*differ).score(None) == 1
    assert records(*differ[:1]).score(STRAIN) == 0.25
    same = [dataclasses.replace(one, source="X") for one in agree]
    assert records(*same).score(STRAIN) == 0 and records(*same).score(STRAIN, reports=True) == 0.25
    assert records(*agree).score(None) == 0.25  # of all that hold half held


def test_runs_of_a_shield_weigh_once():
    many = [run("A", "holds", 0.1 + 0.001 * k, "fails") for k in range(20)]
    rest = [run(name, "holds", 0.2, "holds") for name in "BC"]
    assert records(*many, *rest).votes((0, 0.15), STRAIN) == {"held": 2, "failed": 1, "between": 0, "shields": 3}
    assert records(*many, *rest).score(None) == pytest.approx((1 + 0.25 + 0.25) / 3)


def test_limits_in_the_band_of_the_others():
    assert records(*ROWS).check()["limits_in_the_band_of_the_others"] == "1 of 3"  # C, from 0.9 to 1.1, is between A and B
    assert records(*ROWS[:3]).check()["limits_in_the_band_of_the_others"] == "0 of 1"


# ---------------------------------------------------------------------- a limit
@pytest.mark.parametrize("on, computed, times, band, margin, held, failed", [
    ("thickness2", 1.6, (0.5, 1.3), (0.75, 2.21), 1.25, 2, 0), ("thickness2", 1.5, (0.5, 1.3), (0.7, 2.08), 1.3333, 3, 0), ("thickness2", 2.0, (0.5, 1.3), (0.95, 2.73), 1.0, 1, 1),
    ("D", 4.0, (1 / 1.3, 2), (3.9 / 1.3, 8.2), 1.0, 1, 1), ("D", 4.8, (1 / 1.3, 2), (4.7 / 1.3, 9.8), 1.2, 2, 0)])
def test_limit(case, tmp_path, on, computed, times, band, margin, held, failed):
    """measured walls are 1.2 to 1.3 (A), 0.5 to 0.55 (B), 0.9 to 1.1 (C) times the computed ones; of diameters it is one over that"""
    limit = Limit(case(), tmp_path, on)
    answer = {"limit": computed, "undecided": [computed - 0.1, computed + 0.1], "change_by_spacing": 0.05, "on": on}
    found = records(*ROWS, LARGE).of_limit(limit, answer)
    assert found["measured_over_computed"] == pytest.approx(times, abs=1e-4) and found["band"] == pytest.approx(band, rel=1e-3) and found["margin"] == margin
    assert (found["held"], found["failed"], found["between"], found["shields"]) == (held, failed, 3 - held - failed, 3)
    assert f"to {found['band'][1]:g} mm" in calibration.said_of_limit(found, "mm")[0] and f"{held} of 3 shields held in tests, {failed} failed" in calibration.said_of_limit(found, "mm")[2]


def test_band_has_the_change_by_spacing(case, tmp_path):
    answer = {"limit": 1.6, "undecided": [1.5, 1.7], "change_by_spacing": -0.4, "on": ""}
    assert records(*ROWS).of_limit(Limit(case(), tmp_path, "thickness2"), answer)["band"] == pytest.approx((0.6, 2.6))
    assert records(*ROWS).of_limit(Limit(case(), tmp_path, "thickness2"), {**answer, "change_by_spacing": None})["band"] == pytest.approx((0.75, 2.21))


def test_no_calibration_of_a_limit(case, tmp_path):
    answer = {"limit": 6.0, "undecided": [5.0, 7.0], "change_by_spacing": None, "on": "speed_km_s"}
    for on in ("speed", "thickness1"):
        with pytest.raises(HVIError, match="there are no measured limits over"):
            records(*ROWS).of_limit(Limit(case(), tmp_path, on), answer)
    with pytest.raises(HVIError, match="wall 2 over diameter 1.5, of the records 0.225 to 0.75"):
        records(*ROWS).of_limit(Limit(case(), tmp_path, "thickness2"), answer)
    own = CASE.replace("speed_km_s: 6", "speed_km_s: 5").replace("gap_mm: 60", "gap_mm: 70")
    assert records(*ROWS).of_limit(Limit(case(own), tmp_path, "thickness2"), {**answer, "limit": 1.6})["left_out"] == ["A"]


@pytest.mark.parametrize("on, limit, needed", [("wall", 2.0, (1.2, 1.3)), ("diameter", 3.0, (3 / 2.6, 3 / 2.4)), ("diameter", 2.0, (2 / 2.6, 2 / 2.4))])
def test_needed(on, limit, needed):
    """measured from 2.4 to 2.6: a wall must be so many times thicker than computed, a projectile so many times smaller"""
    assert run("A", "holds", 0.1, "holds", on=on, low=2.4, high=2.6, limit=limit).needed() == pytest.approx(needed)


def test_limit_is_the_mean_over_shifts():
    shifted = [dataclasses.replace(ROWS[0], shift=0.5, limit=2.42)]
    assert records(*ROWS, *shifted).limits["A"].limit == pytest.approx(2.2)


@pytest.mark.parametrize("km_s, near", [
    (6.0, {"A": {"km_s": 5.0, "errors_percent": [-18, 4]}, "B": {"km_s": 6.5, "errors_percent": [60]}}), (6.5, {"B": {"km_s": 6.5, "errors_percent": [60]}, "C": {"km_s": 7.0, "errors_percent": [0]}}),
    (8.0, {"C": {"km_s": 7.0, "errors_percent": [0]}}), (4.0, {"A": {"km_s": 5.0, "errors_percent": [-18, 4]}})])
def test_limits_near(km_s, near):
    """of the shields at the next speeds, each shift: A of 2.4 to 2.6 mm has 2 and 2.7, B of 1 to 1.1 has 2"""
    found = records(*ROWS, dataclasses.replace(ROWS[0], shift=0.25, limit=2.7)).near(km_s)
    assert found == near
    alike = [dataclasses.replace(ROWS[0], shield="F", limit=2.5)]
    assert list(records(*ROWS, *alike).near(5.0)) == ["A", "B", "F"]  # two at one speed


def test_limits_near_are_said(case, tmp_path):
    """of a verdict and of a limit; a computed limit that is thinner than the tested one is in capitals; results of before have none"""
    of = records(*ROWS, LARGE)
    line = "          computed limits of shields tested at the nearest speeds, by each shift (100 ln of computed over measured): A (5 km/s) 18 % UNSAFE, B (6.5 km/s) 60 % safe"
    found = of.of_verdict(case(), both(result(), result()))
    assert calibration.said_of_verdict(found)[-1] == line
    limit = of.of_limit(Limit(case(), tmp_path, "thickness2"), {"limit": 1.6, "undecided": [1.5, 1.7], "change_by_spacing": None, "on": "thickness2"})
    assert calibration.said_of_limit(limit, "mm")[-1] == line
    del found["near"]
    assert len(calibration.said_of_verdict(found)) == 2
    own = of.of_verdict(case(CASE.replace("speed_km_s: 6", "speed_km_s: 5").replace("gap_mm: 60", "gap_mm: 70")), both(result(), result()))
    assert list(own["near"]) == ["B"]  # not the shield itself


# ---------------------------------------------------------------------- the file
def test_the_file_of_the_package():
    """what it says of itself is so"""
    found = calibration.read()
    study = ROOT / found.head["command"].split()[4]
    known = {one.name: one for one in brackets.Study(study).brackets}
    assert found.head["rows"] == len(found.runs) and set(found.limits) <= set(known) and found.head["limits"] == len(found.finest().limits) > 0
    checked = found.finest().check()
    assert {key: found.head[key] for key in checked} == checked and found.head["margin"] == min(calibration.MARGINS, key=checked["scores_by_other_reports"].get)
    assert set(found.head["materials"]) <= {path.name for path in (ROOT / "potentials").glob("*.hvi")}
    for one in found.runs:
        if one.on != "-":
            bracket = known[one.shield]
            error = bracket.error(one.wall_mm if one.on == "wall" else one.D_mm)
            assert (one.low, one.high) == (bracket.low, bracket.high) and (one.limit != one.limit or one.km_s == bracket.shot.speed_km_s)
            assert error == 0 or one.test == ("holds" if error > 0 else "fails")


def test_written_and_read(tmp_path):
    of = records(*ROWS)
    collected.write(tmp_path / "mine.csv", of)
    found = calibration.read(tmp_path / "mine.csv")
    assert found.head == of.head and found.runs == of.runs and [path.name for path in tmp_path.iterdir()] == ["mine.csv"]


@pytest.mark.parametrize("old, new, message", [
    ("# command:", "# commands:", "lines that begin with # must say command"), ("rows: 9", "rows: 8", "first lines speak of 8 rows of 3 shields"), ("shields: 3", "shields: 4", "speak of 9 rows of 4"),
    ("margin: rear", "margin: front", "by front_plastic_strain"), ("shield,source", "shield,report", "the columns must be shield,source,on"), ("wall,5.0", "walls,5.0", "line 33: on must be wall, diameter, -, not 'walls'"),
    ("wall,5.0", "wall,quick", "line 33: km_s must be a number, not 'quick'"), ("wall,5.0", "wall", "line 33: 18 values in 19 columns"), ("holds,holds", "holds,held", "line 33: test must be holds"),
    ("# command:", "# {command:", "must say")])
def test_wrong_file(tmp_path, old, new, message):
    collected.write(tmp_path / "mine.csv", records(*ROWS))
    text = (tmp_path / "mine.csv").read_text()
    line = next(k for k, one in enumerate(text.splitlines(), 1) if one.startswith("A,"))
    assert old in text
    write(tmp_path / "mine.csv", text.replace(old, new, 1))
    with pytest.raises(HVIError, match="mine.csv.*" + message.replace("33", str(line))):
        calibration.read(tmp_path / "mine.csv")
    with pytest.raises(HVIError, match="cannot read"):
        calibration.read(tmp_path / "none.csv")


# ---------------------------------------------------------------------- commands
def calibrate(*words):
    return cli.main(["calibrate", *map(str, words)])


SHOTS = """list: shots.csv
spacing: {across: 10, bumper_layers: 2, wall_layers: 3, ratio: 1}
materials: {AA2017-T4: Al2017-T4, AA6061-T6: Al6061-T6}
"""
LIST = """source,shotID,proj_mat,proj_diam,angle,velocity,bumper_mat,bumper_thick,standoff,wall_mat,wall_yield,wall_thick,result
C,S1,AA2017-T4,0.5,0,7,AA6061-T6,0.16,5,AA6061-T6,40,0.18,NP
report A,4,AA2017-T4,0.5,0,7,AA6061-T6,0.16,5,AA6061-T6,40,0.16,P
C,S3,AA2017-T4,0.5,45,7,AA6061-T6,0.16,5,AA6061-T6,40,0.17,P
"""


def test_calibrate(mine, capsys, monkeypatch):  # noqa: F811
    """from runs of the fake, which need not be done all; limits are those that hvi limits finds"""
    assert calibrate("mine.yaml", "--file", "mine-records.csv") == 1 and "has no runs of" in capsys.readouterr().err and not (mine / "mine-records.csv").exists()
    assert front("limits", "--jobs", "3", case="mine.yaml") == 0
    write(mine / "shots.yaml", SHOTS), write(mine / "shots.csv", LIST)
    assert front("shots", "--jobs", "3", case="shots.yaml") == 0
    before = {path: path.stat().st_mtime_ns for path in (mine / "runs").rglob("*")}
    assert calibrate("mine.yaml", "--shots", "shots.yaml", "--file", "mine-records.csv") == 0
    assert {path: path.stat().st_mtime_ns for path in (mine / "runs").rglob("*")} == before
    found, out = calibration.read(mine / "mine-records.csv"), capsys.readouterr().out
    assert found.head["command"] == f"python3 -m hvi calibrate {collected.within('mine.yaml')} --shots {collected.within('shots.yaml')}" and found.head["materials"] == MATERIALS and "used: rear_plastic_strain" in out
    assert found.limits["W"].limit == pytest.approx(1.7, rel=0.03) and found.limits["D"].limit == pytest.approx(4.6 / 0.9, rel=0.03)
    assert len({(one.shield, one.shift) for one in found.runs if one.on != "-"}) == 4 and len(list(mine.glob("runs/**/tries"))) == len(found.runs) + 1  # S3 is oblique
    assert [(one.shield, one.test) for one in found.runs if one.on == "-"] == [("S1", "holds")]
    assert [(one.km_s, one.test) for one in found.runs if one.shield == "W" and one.limit != one.limit] == [(7.0, "fails")]  # shot 4 is an edge of W
    for one in found.runs:
        if one.shield == "W" and one.limit == one.limit:
            assert one.test == ("holds" if one.wall_mm >= 1.8 else "fails" if one.wall_mm <= 1.6 else "between") and (one.verdict == "fails") == (one.apart_over_projectile > 0)
    monkeypatch.setattr(calibration, "FILE", mine / "mine-records.csv")
    assert calibrate("--file", "mine-records.csv") == 0 and f"{len(found.runs)} runs of 3 shields" in capsys.readouterr().out
    # a study a part at a time: what was recorded before is kept, and judged with the rest
    text, whole = (mine / "mine.yaml").read_text(), found
    for shift in ("0", "0.5"):
        write(mine / "mine.yaml", text.replace("shifts: [0, 0.5]", f"shifts: [{shift}]"))
        assert calibrate("mine.yaml", "--file", f"{shift}.csv", *(("--add", "0.csv") if shift == "0.5" else ())) == 0
    found, brackets_of = calibration.read(mine / "0.5.csv"), [one for one in whole.runs if one.on != "-" and one.limit == one.limit]
    assert sorted(map(str, found.runs)) == sorted(map(str, brackets_of)) and found.check() == dataclasses.replace(whole, runs=tuple(brackets_of)).check() and "--add those of" in found.head["command"]
    assert calibrate("mine.yaml", "--file", "no.csv", "--add", "0.5.csv") == 1 and "with 10 across, shift 0.5, is in those records and in the study" in capsys.readouterr().err
    write(mine / "other.csv", (mine / "0.csv").read_text().replace("ratio: 1.0", "ratio: 2.0"))
    assert calibrate("mine.yaml", "--file", "no.csv", "--add", "other.csv") == 1 and "have other spacings, settings or another model" in capsys.readouterr().err
    write(mine / "other.csv", re.sub(r"(Al6061-T6.hvi: )'?[0-9a-f]+'?", r"\1'0123'", (mine / "0.csv").read_text()))
    assert calibrate("mine.yaml", "--file", "no.csv", "--add", "other.csv") == 1 and "with another Al6061-T6.hvi than the study" in capsys.readouterr().err
    assert calibrate("--add", "0.csv") == 1 and "--add needs a study" in capsys.readouterr().err and not (mine / "no.csv").exists()
    write(mine / "mine.yaml", text)
    # a search that was not ended has no limit; runs of other settings are refused
    for path in (mine / "runs/mine/W").glob("W_across-10_shift-0_wall-1.6*"):
        (path / "result.yaml").unlink()
    assert calibrate("mine.yaml", "--file", "mine-records.csv") == 0
    assert [one.limit == one.limit for one in calibration.read(mine / "mine-records.csv").runs if one.shield == "W" and one.shift == 0] == [False] * sum(
        (path / "result.yaml").is_file() for path in (mine / "runs/mine/W").glob("W_across-10_shift-0_*"))
    write(mine / "mine.yaml", (mine / "mine.yaml").read_text() + "settings: {eta: 1.3}\n")
    assert calibrate("mine.yaml", "--file", "mine-records.csv") == 1 and "was run with other settings, or another input, than" in capsys.readouterr().err
    assert calibrate("mine.yaml") == 1 and "a study needs --file" in capsys.readouterr().err
    assert calibrate("--shots", "shots.yaml") == 1 and "--shots needs a study" in capsys.readouterr().err


@pytest.mark.parametrize("rows, verdict_says, limit_says", [((*ROWS, LARGE), "4 shields held in tests", "measured limits were 0.77 to 2.00 times"), (ROWS[:5], "outside of what the records cover: speed", None)])
def test_commands_say_it(folder, capsys, monkeypatch, rows, verdict_says, limit_says):  # noqa: F811
    """under the verdict and under the limit, and in their files"""
    collected.write(folder / "records.csv", records(*rows))
    monkeypatch.setattr(calibration, "FILE", folder / "records.csv")
    write(folder / "emi.yaml", CASE.replace("speed_km_s: 6", "speed_km_s: 6.8").replace("gap_mm: 60", "gap_mm: 65"))
    status = front("shield")
    said, out = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text()), capsys.readouterr().out
    assert status in (0, 3) and verdict_says in out and "how sure: " in out and (isinstance(said["calibration"], str) or said["calibration"]["shields"] == 4)
    assert front("limit", "--on", "D", "--from", "3.3", "--to", "7", "--step", "0.1", "--jobs", "3") == 0
    said, out = yaml.safe_load((folder / "runs/emi/limit-D/limit.yaml").read_text()), capsys.readouterr().out
    assert "how sure: " in out and (limit_says is None or limit_says in out) and list(said)[-1] == "equations"
    if limit_says:
        assert said["calibration"]["band"][0] < said["limit"] < said["calibration"]["band"][1]
    else:
        assert said["calibration"].startswith("none: the case is outside")


def test_paths_are_those_of_the_source_tree():
    assert str(collected.within(ROOT / "examples/whipple-shield/limits/limits.yaml")) == "examples/whipple-shield/limits/limits.yaml" and collected.within(pathlib.Path("/tmp/mine.yaml")) == "mine.yaml"


def test_records_of_the_package_are_of_its_materials():
    """else verdicts lose their records without a word in any test: all of a file counts, its citations, too"""
    known = calibration.read().head["materials"]
    assert len(known) >= 2 and known == {name: engine.digest(library.find(name).read_bytes()) for name in known}
