"""hvi/recall: the variables of a run, lists and words with blanks too, for one that goes on with it."""

import pytest

SHOW = "print '${dx} ${pair} ${mark}'\nlabel more\nprint 'frame ${frame}'\nnext frame\njump SELF more\n"
GIVEN = {"dx": "0.5", "frame": ["4", "8 or 9", "12"], "pair": "dissipation riemann", "mark": "it's", "out": "."}
LINES = [f"{GIVEN['dx']} {GIVEN['pair']} {GIVEN['mark']}", "frame 4", "frame 8 or 9", "frame 12"]


def shown(result):
    return [line for line in result.stdout.splitlines() if line.startswith(("0.5", "frame"))]


@pytest.fixture
def written(lmp):
    """a run that writes its variables, and has them all afterwards"""
    r = lmp("variable k loop 3\nvariable e equal 1\nhvi/recall write run.given except out\n" + SHOW, vars=GIVEN)
    assert shown(r) == LINES
    return r.cwd / "run.given"


@pytest.mark.parametrize("nranks", [1, 2])
def test_taken_up(lmp, written, nranks):
    text = written.read_text()
    assert [line.split()[2] for line in text.splitlines()[1:]] == ["dx", "frame", "pair", "mark"]
    assert shown(lmp("include run.given\nvariable dx index 1\n" + SHOW, nranks=nranks)) == LINES
    assert shown(lmp("include run.given\n" + SHOW, vars={"dx": 0.5, "frame": GIVEN["frame"]})) == LINES


@pytest.mark.parametrize("name, value, was", [
    ("dx", "0.4", "0.5"), ("frame", ["4", "8"], "4 8 or 9 12"), ("frame", ["4", "8 or 9", "12", "16"], "4 8 or 9 12"),
    ("pair", "dissipation monaghan", "dissipation riemann")], ids=str)
def test_others_are_refused(lmp, written, name, value, was):
    r = lmp("include run.given\n" + SHOW, vars={name: value}, expect_fail=True)
    now = value if isinstance(value, str) else " ".join(value)
    assert f"a variable has changed: {name} was '{was}', and is '{now}' now" in r.error


@pytest.mark.parametrize("text, message", [
    ("hvi/recall write", "Illegal hvi/recall command: missing argument"), ("hvi/recall variable dx", "Illegal hvi/recall variable command"),
    ("hvi/recall read run.given", "must be followed by write or variable, not read"),
    ("hvi/recall write run.given but dx", "unknown keyword but"), ("hvi/recall write no/such/folder", "cannot write file no/such/folder"),
    ("variable dx equal 1\nhvi/recall variable dx 1", "variable dx is not of style index")], ids=str)
def test_wrong_input(lmp, text, message):
    assert message in lmp(text + "\n", expect_fail=True).error
