"""python3 -m hvi limits: brackets read and refused, searches over a geometric grid, errors with their sign, equations beside; LAMMPS is a fake here."""

import csv
import math

import pytest
from front_runs import HEAD, LIST, STUDY, begun, case_folder, front, mine_folder, tries  # noqa: F401
from hvi.errors import HVIError
from hvi.jobs import machine
from hvi.shield import brackets, shots
from hvi.version import ROOT

EXAMPLE = ROOT / "examples" / "whipple-shield" / "limits" / "limits.yaml"


def rows_of(folder):
    with open(folder / "runs/mine/limits.csv", newline="") as table:
        return list(csv.DictReader(table))


def test_summary_of_shifts():
    """the mean over shifts, and the safer of them, which is what hvi shield calls a wall that holds; of brackets with all shifts"""
    rows = [{"bracket": name, "across": 10.0, "error": error} for name, error in (("A", -0.3), ("A", 0.1), ("B", 0.2), ("B", 0.4), ("C", -0.1), ("D", None))]
    found = {name: values for name, *values in brackets.summary(rows, {})}
    assert found["simulation, 10 across"] == pytest.approx([3, 0.5 / 3, 0.1 / 3, -0.1]) and found["10 across, safer shift"] == pytest.approx([2, 0.25, 0.25, 0.1])
    assert list(name for name, *_ in brackets.summary(rows[-2:], {})) == ["simulation, 10 across"]


def test_list_of_the_example():
    found = {one.name: one for one in brackets.Study(EXAMPLE).brackets}
    assert list(found) == ["A27", "A36", "A425", "A55", "A635", "P2", "N1", "R2"]
    one = found["A425"]
    assert (one.on, one.low, one.high, one.shot.diameter_mm, one.shot.speed_km_s, one.shot.bumper_mm, one.shot.gap_mm, one.shot.yield_ksi) == (
        "wall", 2.20, 2.31, 3.18, 4.25, 0.794, 50.8, 40)
    assert found["P2"].on == "diameter" and found["P2"].shot.wall_mm == 1.47


def test_equations_of_the_example():
    """what the equations of the literature miss the brackets by, as counted elsewhere: Reimerdes 7, JSC 11, modJSC 12, NNO 16, CK01 26 %"""
    study = brackets.Study(EXAMPLE)
    mean = {name: 100 * value for name, _, value, *_ in brackets.summary([], {one.name: brackets.equations(study, one) for one in study.brackets})}
    for name, percent in (("Reimerdes", 7), ("JSC", 11), ("modJSC", 12), ("NNO", 16), ("CK01", 26)):
        assert mean[name] == pytest.approx(percent, abs=0.6)


def test_labels_of_the_shots_agree():
    """shots of one source: what a bracket says of a shot is what the list of shots says"""
    seen = {shot.name: shot.observed for shot in shots.read_list(shots.SETTINGS.parent / "shots.csv")}
    study, compared = brackets.Study(EXAMPLE), 0
    for one in study.brackets:
        for said, names in (("P", one.fails), ("NP", one.holds)):
            for word in names.split():
                if word in seen and one.name.startswith("A"):
                    assert seen[word] == said, word
                    compared += 1
    assert compared == 4  # 4, 13, 18, G


@pytest.mark.parametrize("on, low, high, limit, error", [
    ("wall", 2.0, 2.5, 2.2, 0.0), ("wall", 2.0, 2.5, 3.0, math.log(3.0 / 2.5)), ("wall", 2.0, 2.5, 1.6, -math.log(2.0 / 1.6)),
    ("diameter", 2.0, 2.5, 2.2, 0.0), ("diameter", 2.0, 2.5, 3.0, -math.log(3.0 / 2.5)), ("diameter", 2.0, 2.5, 1.6, math.log(2.0 / 1.6))])
def test_error(on, low, high, limit, error):
    """safe is above 0: a thicker wall, a smaller projectile than measured"""
    assert brackets.Bracket(None, on, low, high, "", "").error(limit) == pytest.approx(error)


WRONG = [
    ("wall,1.6,1.8", "walls,1.6,1.8", "line 3: on must be wall or diameter, not 'walls'"),
    ("wall,1.6,1.8", "wall,1.8,1.6", "line 3: low 1.8 must be below high 1.6"),
    ("A,AA2017-T4,5,", "A,AA2017-T4,,", "line 3: D_mm must be a number above 0, not ''"),
    ("40,1.8,diameter", "40,,diameter", "line 4: tw_mm must be a number above 0, not ''"),
    ("\nD,B", "\nW,B", "line 4: bracket W is there twice"),
    ("8,-", "8", "line 4: 15 values in 16 columns"),
    ("km_s,", "speed,", "no column km_s"),
    (LIST[LIST.index("W,A"):], "", "no brackets"),
]


@pytest.mark.parametrize("old, new, message", WRONG)
def test_wrong_list(mine, old, new, message):
    (mine / "mine.csv").write_text(LIST.replace(old, new, 1))
    with pytest.raises(HVIError, match="mine.csv.*" + message.replace("(", r"\(")):
        brackets.read_list(mine / "mine.csv")


@pytest.mark.parametrize("old, new, message", [
    ("across: [10]", "across: [0]", "line 2: across: must be above 0, not 0"), ("across", "acros", "acros: no such key; did you mean across?"),
    ("across: [10]", "across: [10]\nbrackets: [V]", r"line 3: brackets: no bracket V \(known: W, D\)"),
    (", AA6061-T6: Al6061-T6", "", "bracket W: no material for AA6061-T6"), ("ratio: 1", "ratio: -1", "spacing: ratio: must be above 0, not -1")])
def test_wrong_study(mine, old, new, message):
    (mine / "mine.yaml").write_text(STUDY.replace(old, new, 1))
    with pytest.raises(HVIError, match=message):
        brackets.Study(mine / "mine.yaml")


def test_limits(mine, capsys):
    """the fake holds up to D = 4 + dx + shift / 10 + t - 1.2, dx a tenth of the sphere: a wall of 1.7 and 1.65 mm, spheres of 5.11 and 5.17 mm"""
    assert front("limits", "--jobs", "3", case="mine.yaml") == 0
    out, rows = capsys.readouterr().out, rows_of(mine)
    assert [(row["bracket"], row["shift"]) for row in rows] == [("W", "0.0"), ("D", "0.0"), ("W", "0.5"), ("D", "0.5")]
    for row, true, low, high in zip(rows, (1.7, 4.6 / 0.9, 1.65, 4.65 / 0.9), (1.6, 4.0) * 2, (1.8, 4.5) * 2):
        holds, fails, limit = (float(row[name]) for name in ("holds", "fails", "limit"))
        assert min(holds, fails) <= true <= max(holds, fails) and max(holds, fails) / min(holds, fails) == pytest.approx(1.05, rel=1e-3)
        assert limit == pytest.approx(math.sqrt(holds * fails), rel=1e-4) and (holds > fails) == (row["bracket"] == "W")
        assert float(row["error"]) == pytest.approx(0.0 if row["bracket"] == "W" else -math.log(limit / 4.5), abs=2e-4)
        assert int(row["runs"]) <= 9 and float(row["core_s"]) > 0
    assert set(tries(mine).values()) == {1}
    assert "simulation, 10 across" in out and "Reimerdes" in out
    assert (mine / "runs/mine/limits.png").stat().st_size > 10000 and "| W |" in (mine / "runs/mine/limits.md").read_text()
    before = begun(mine)
    assert front("limits", case="mine.yaml") == 0
    assert begun(mine) == before and rows_of(mine) == rows


def test_what_does_not_fit_is_refused(mine, capsys, monkeypatch):
    monkeypatch.setattr(machine, "free_memory", lambda: 50)
    for words in ((), ("--dry-run",)):
        assert front("limits", *words, case="mine.yaml") == 1 and not tries(mine)
        assert "hvi: D_across-10_shift-0_diameter-" in (err := capsys.readouterr().err) and "MB of memory, and 50 are free: take " in err and err.endswith(" or more by across of the study\n")


@pytest.mark.long
def test_what_is_stopped_goes_on(mine, monkeypatch, capsys):
    monkeypatch.setenv("FAKE_FAIL", "wall-1.7")
    assert front("limits", "--only", "W", case="mine.yaml") == 1
    assert "failed: W_across-10" in capsys.readouterr().out and [row["limit"] != "" for row in rows_of(mine)] == [False, False, True, False]  # D was not asked for
    monkeypatch.delenv("FAKE_FAIL")
    assert front("limits", "--only", "W", case="mine.yaml") == 0
    assert float(rows_of(mine)[0]["limit"]) == pytest.approx(1.7, rel=0.03)


def test_undecided_is_said(mine, monkeypatch):
    """what is neither is within the limit's step: its middle is that of what holds and what fails"""
    monkeypatch.setenv("FAKE_UNSURE", "0.3")
    assert front("limits", "--only", "W", case="mine.yaml") == 0
    row = rows_of(mine)[0]
    assert int(row["undecided"]) > 0 and float(row["holds"]) / float(row["fails"]) > 1.15


def test_only_these_and_equations(mine, capsys):
    assert front("limits", "--only", "V", case="mine.yaml") == 1
    assert "--only: no bracket V (known: W, D)" in capsys.readouterr().err
    assert front("limits", "--equations", case="mine.yaml") == 0
    assert "Reimerdes" in capsys.readouterr().out and not tries(mine)


@pytest.mark.parametrize("holds, dotted", [(1.9, True), (None, False)])
def test_a_search_that_has_not_ended_is_in_the_picture(mine, holds, dotted):
    """between what holds and what fails, over the middle of the bracket, as a dotted line; with one end alone there is none"""
    from hvi.figures import limit_brackets
    found = brackets.read_list(mine / "mine.csv")
    row = {"bracket": "W", "across": 10.0, "limit": None, "holds": holds, "fails": 1.7}
    (ax,) = limit_brackets(found, [row], {}).axes
    ends = [line[:, 1] for one in ax.collections if hasattr(one, "get_segments") for line in one.get_segments()]
    assert len(ends) == dotted
    if dotted:
        assert list(ends[0]) == pytest.approx([1.7 / found[0].middle, 1.9 / found[0].middle])
