"""python3 -m hvi compare of shields, and the Answer of a case that it reads; LAMMPS is a fake here."""

import csv

import pytest
import yaml
from front_runs import case_folder, change, front  # noqa: F401
from hvi import cli
from hvi.errors import HVIError
from hvi.figures import shields
from hvi.shield import answer

ONE = change("shifts: [0, 0.5]", "shifts: [0]")
MIDDLE = "  - {thickness_mm: 0.5, material: Al6061-T6, gap_mm: 20}\n"
TRIPLE = ONE.replace("  - thickness_mm: 1.2", f"{MIDDLE}  - thickness_mm: 1.2").replace("gap_mm: 60", "gap_mm: 40").replace("diameter_mm: 5", "diameter_mm: 4")
SINGLE = ONE[:ONE.index("  - {thickness")] + "  - {thickness_mm: 3, material: Al6061-T6}\n" + ONE[ONE.index("spacings_mm"):]


@pytest.fixture(name="three")
def folder_of_three(folder):
    """a double wall that fails with its limits, a triple one that holds, a single one that was not run"""
    for name, text in (("emi", ONE), ("triple", TRIPLE), ("single", SINGLE)):
        (folder / f"{name}.yaml").write_text(text)
    assert front("shield") == 3 and front("shield", case="triple.yaml") == 0
    return folder


def table_of(path):
    with open(path, newline="") as table:
        return {row["shield"]: row for row in csv.DictReader(table)}


def test_shields_side_by_side(three, capsys, monkeypatch):
    """walls stand in the columns of their roles; verdict, margins, limit, density and cost as the folders have them; cases without runs are there too"""
    monkeypatch.setenv("FAKE_POWER", "1")
    assert front("limit", "--on", "thickness2", "--from", "1.2", "--to", "3.2", "--step", "0.5") == 0
    assert front("limit", "--on", "D", "--at", "gap2=80", "--from", "3", "--to", "6", "--step", "1") == 0
    for case in ("emi.yaml", "triple.yaml"):
        assert front("curve", "--speeds", "6:7:2", "--from", "3", "--to", "7", "--step", "1", case=case) == 0
    capsys.readouterr()
    assert cli.main(["compare", "runs/emi", "triple.yaml", "single.yaml", "--out", "a.csv", "--figure", "a.png"]) == 0
    out, rows = capsys.readouterr().out, table_of("a.csv")
    assert [rows[name]["verdict"] for name in ("emi", "triple", "single")] == ["fails", "holds", "not run"] and rows["emi"]["decided_by"] == "rear"
    assert [rows[name]["bumper_mm"] for name in ("emi", "triple", "single")] == ["0.8", "0.8", ""] and [rows[name]["intermediate_mm"] for name in ("emi", "triple", "single")] == ["", "0.5", ""]
    assert [(rows[name]["rear_mm"], rows[name]["rear_gap_mm"]) for name in ("emi", "triple", "single")] == [("1.2", "60.0"), ("1.2", "40.0"), ("3.0", "")]
    names = list(rows["emi"])
    assert names.index("bumper_mm") < names.index("intermediate_gap_mm") < names.index("rear_mm")
    found = yaml.safe_load((three / "runs/emi/verdict.yaml").read_text())
    assert float(rows["emi"]["areal_density_kg_m2"]) == pytest.approx(found["areal_density_kg_m2"], abs=1e-3) and float(rows["emi"]["core_s"]) == pytest.approx(found["core_s"], abs=0.1)
    assert float(rows["emi"]["hole_mm"]) == 5 and float(rows["triple"]["hole_mm"]) == 0 and rows["single"]["hole_mm"] == "" and rows["emi"]["runs"] == "2"
    limit = yaml.safe_load((three / "runs/emi/limit-thickness2/limit.yaml").read_text())
    assert float(rows["emi"]["limit_rear_mm"]) == limit["limit"] and limit["holds"].startswith("from ") and rows["triple"]["limit_rear_mm"] == ""
    assert float(rows["emi"]["over_limit_rear"]) == pytest.approx(1.2 / float(limit["holds"].split()[1]))
    assert rows["emi"]["limit_rear_holds"] == limit["holds"] and rows["emi"]["limit_rear_spacing_mm"] == "0.2" and float(rows["emi"]["search_core_s"]) > limit["core_s"]
    assert "left out: runs/emi/limit-D_gap2-80: of other values than the case's" in out and "limit_D_mm" not in names
    assert [line.split()[1:] for line in out.splitlines() if line.split()[:1] == ["intermediate_mm"]] == [["-", "0.5", "-"]]
    drawn = shields(answer.bars_of([answer.read(name) for name in ("runs/emi", "runs/triple", "single.yaml")]), answer.curves_of([answer.read(name) for name in ("runs/emi", "runs/triple")]))
    bars, curves = drawn.axes
    assert [text.get_text() for text in bars.texts] == ["fails", "holds", "not run"] and (three / "a.png").stat().st_size > 10_000
    assert [text.get_text() for text in bars.get_legend().get_texts()] == ["bumper", "intermediate", "rear"] and curves.get_xlabel() == "speed (km/s)"
    assert [text.get_text() for text in curves.get_legend().get_texts()] == ["emi", "triple"]


@pytest.mark.parametrize("own, holds, over", [(1.0, "from 2.5", 0.4), (2.5, "from 2.5", 1.0), (2.2, "from 2.5", 0.88), (1.0, "up to 1.6", 1.6), (1.6, "up to 1.6", 1.0), (2.0, "up to 1.6", 0.8),
                                              (0, "from 45", None)])
def test_limits_that_hold_below_and_above(own, holds, over):
    """1 is where all runs hold, whichever side holds: between there and the limit, the middle of 2, the case is undecided, which is no margin; of an angle of 0 there is no ratio"""
    assert answer.over_limit({"limit": 2.0, "own": own, "holds": holds}) == (over and pytest.approx(over))


def test_no_limit_no_margin():
    assert answer.over_limit({"limit": None, "own": 1.0}) is None


def test_roles():
    """the last wall is the rear, the first of several the bumper; those between are counted from the front"""
    assert answer.roles(1, 1) == ["rear"] and answer.roles(2, 4) == ["bumper", "rear"] and answer.roles(3, 3) == ["bumper", "intermediate", "rear"]
    assert answer.roles(3, 4) == ["bumper", "intermediate1", "rear"] and answer.roles(4, 4) == ["bumper", "intermediate1", "intermediate2", "rear"]


def test_answer_of_a_folder(three):
    """what is in verdict.yaml and its runs; a row of the DataFrame per run"""
    pytest.importorskip("pandas")
    found = answer.read("runs/emi")
    assert repr(found).startswith("emi: fails\n  - both runs say so") and found.case.walls[1].gap_mm == 60 and [run.dx for run in found.runs] == [0.2, 0.4]
    table = found.dataframe()
    assert list(table.index) == ["dx-0.4_shift-0.0", "dx-0.2_shift-0.0"] and list(table["spacing_mm"]) == [0.4, 0.2] and set(table["verdict"]) == {"fails"}
    assert table["core_s"].sum() == found.core_s and {"hole2_diameter_mm", "energy_ratio"} <= set(table.columns)


def test_another_state_of_the_case(three, capsys):
    """a case that was changed since does not take the answer of before; frames for pictures and the order of values do not change it"""
    (three / "emi.yaml").write_text(ONE.replace("gap_mm: 60", "gap_mm: 50"))
    assert cli.main(["compare", "emi.yaml", "triple.yaml"]) == 1 and "runs/emi is of another state of emi.yaml (its runs are dx-0.2_shift-0.0, dx-0.4_shift-0.0), or of files that it names: call python3 -m hvi shield" in capsys.readouterr().err
    (three / "emi.yaml").write_text(ONE.replace("spacings_mm: [0.2, 0.4]", "spacings_mm: [0.4, 0.2]\nsettings: {film: 2}"))
    assert cli.main(["compare", "emi.yaml", "triple.yaml"]) == 0


SPACINGS = "spacings_mm: [0.2, 0.4]"


@pytest.mark.parametrize("old, new", [(SPACINGS, "spacings_mm: [0.2, 0.3]"), ("shifts: [0]", "shifts: [0, 0.5]"), ("gap_mm: 60", "gap_mm: 60\n    spacings_mm: [0.2, 0.3]"), *(pytest.param(*pair, marks=pytest.mark.long) for pair in (
    (SPACINGS, "spacings_mm: [0.2, 0.3, 0.4]"), (SPACINGS, "spacings_mm: [0.4]"), ("shifts: [0]", "shifts: [0.25]")))])
def test_another_spacing_is_another_state(three, capsys, old, new):
    """of the case or of a wall: neither verdict nor limit are taken for those of the case of today; the folder alone still has both"""
    words = ["--on", "thickness2", "--from", "1.2", "--to", "3.2", "--step", "1"]
    assert front("limit", *words) == 0 and list(answer.read("emi.yaml").limits) == list(answer.read("runs/emi").limits) == ["limit-thickness2"]
    (three / "emi.yaml").write_text(ONE.replace(old, new))
    with pytest.raises(HVIError, match=r"another state of emi.yaml \(its runs are dx-0.2_shift-0.0, dx-0.4_shift-0.0\)"):
        answer.read("emi.yaml")
    assert answer.read("runs/emi").verdict == "fails" and list(answer.read("runs/emi").limits) == ["limit-thickness2"]
    (three / "runs/emi/verdict.yaml").unlink()
    assert answer.read("emi.yaml").left_out == ("limit-thickness2",)


FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


def write_stl(path, side):
    """a tetrahedron with three right angles at a corner, mm"""
    corners = ["0 0 0", f"{side} 0 0", f"0 {side} 0", f"0 0 {side}"]
    facets = [f"facet normal 0 0 0\nouter loop\n{''.join(f'vertex {corners[k]}{chr(10)}' for k in face)}endloop\nendfacet\n" for face in FACES]
    path.write_text(f"solid body\n{''.join(facets)}endsolid body\n")


@pytest.mark.parametrize("change_of_files", ["material", *(pytest.param(one, marks=pytest.mark.long) for one in ("projectile", "name"))])
def test_files_of_the_case_that_have_changed(folder, root, monkeypatch, change_of_files):
    """a verdict, a limit and a curve are of the files that the case named then: another material of the same name, another body of the same name, another name of the body"""
    text = ONE.replace("diameter_mm: 5", "shape: file\n  file: ball.stl").replace("material: Al6061-T6", "material: mine")
    (folder / "emi.yaml").write_text(text)
    write_stl(folder / "ball.stl", 6)
    material = (root / "potentials/Al6061-T6.hvi").read_text()
    (folder / "mine.hvi").write_text(material)
    monkeypatch.setenv("FAKE_LIMIT", "3.5")
    words = ["--on", "thickness2", "--from", "1", "--to", "4", "--step", "1"]
    assert front("shield") == 3 and front("limit", *words) == 0 and front("curve", "--speeds", "6:7:2", *words) == 0
    found = answer.read("emi.yaml")
    assert list(found.limits) == ["limit-thickness2"] and list(found.curves) == ["curve-thickness2"] and not found.left_out
    assert answer.read("runs/emi").limits == found.limits
    if change_of_files == "material":
        (folder / "mine.hvi").write_text(material + "# another\n")
    elif change_of_files == "projectile":
        write_stl(folder / "ball.stl", 7)
    else:
        (folder / "ball.stl").rename(folder / "other.stl")
        (folder / "emi.yaml").write_text(text.replace("ball.stl", "other.stl"))
    with pytest.raises(HVIError, match=r"runs/emi is of another state of emi.yaml \(its runs are .*\), or of files that it names: call python3 -m hvi shield"):
        answer.read("emi.yaml")
    (folder / "runs/emi/verdict.yaml").unlink()
    found = answer.read("emi.yaml")
    assert not found.limits and not found.curves and found.left_out == ("limit-thickness2", "curve-thickness2")


def test_limits_of_an_older_version(folder):
    """which does not say of which files they are"""
    (folder / "emi.yaml").write_text(ONE)
    assert front("limit", "--on", "thickness2", "--from", "1.2", "--to", "4.2", "--step", "1") == 0
    path = folder / "runs/emi/limit-thickness2/limit.yaml"
    said = yaml.safe_load(path.read_text())
    assert set(said["files"]) == {"Al2024-T3.hvi", "Al6061-T6.hvi"} and list(answer.read("emi.yaml").limits) == ["limit-thickness2"]
    path.write_text(yaml.safe_dump({key: value for key, value in said.items() if key != "files"}))
    assert answer.read("emi.yaml").left_out == ("limit-thickness2",)


def test_wrong_shields(three, capsys):
    (three / "a.yaml").write_text("steps: 5\n")
    (three / "runs/old/limit-D").mkdir(parents=True)
    (three / "runs/old/limit-D/limit.yaml").write_text("limit: 5\n")
    (three / "old.yaml").write_text(ONE)
    for words, message in ((["emi.yaml", "a.yaml"], "cannot compare a shield with what is none: emi.yaml and a.yaml"), (["emi.yaml", "runs"], "a shield with what is none: emi.yaml and runs"),
                           (["emi.yaml", "triple.yaml", "--rtol", "1"], "--rtol is for two runs, not for shields"), (["a.yaml", "a.yaml", "a.yaml"], "two runs are compared, not 3"),
                           (["a.yaml", "a.yaml", "--figure", "x"], "--figure is for shields"), (["runs/old"], "runs/old has limits or curves only: give the case itself, CASE.yaml, and --runs runs"),
                           (["old.yaml", "a.yaml"], "a shield with what is none: old.yaml and a.yaml")):
        assert cli.main(["compare", *words]) == 1 and message in capsys.readouterr().err, words
    capsys.readouterr()
    assert cli.main(["compare", "old.yaml"]) == 0 and "left out: runs/old/limit-D: of other values than the case's, or of an older version" in capsys.readouterr().out
    with pytest.raises(HVIError, match="nowhere does not exist"):
        answer.read("nowhere")
    with pytest.raises(HVIError, match="runs is no folder of python3 -m hvi shield, limit or curve"):
        answer.read("runs")
