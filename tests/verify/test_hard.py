"""Hard cases (tests/verify/hard.py), short form: every criterion is met, or missed with its cause in doc/src/tables/hard.inc."""

import csv
import pathlib

import hard
import pytest

HERE = pathlib.Path(__file__).resolve().parent
CASES = {c.name: c for c in hard.cases()}
assert len(CASES) == len(hard.cases()), "names"


@pytest.mark.parametrize("name, method", [
    pytest.param(c.name, m, marks=[] if m in c.short else [pytest.mark.long])
    for c in CASES.values() for m in c.methods if not m.startswith("stock")])
def test_hard(name, method, lmp_exe, tmp_path):
    case = CASES[name]
    o = hard.run(case, method, hard.executor(lmp_exe, tmp_path), tmp_path)
    if o.cannot:
        pytest.skip(o.cannot)
    assert not hard.unexpected(case, o), o.measures


def test_criteria_are_those_written_down():
    """hard_criteria.csv was there before the first run, but for what it says came after; the cases have not moved away from it"""
    with open(HERE / "hard_criteria.csv") as f:
        rows = {(r["case"], r["measure"]): (r["least"], r["most"], r["since"]) for r in csv.DictReader(line for line in f if line[0] != "#")}
    now = {(c.name, m): (*("" if abs(b) == float("inf") else f"{b:g}" for b in c.bounds(m)), c.since) for c in CASES.values() for m in c.criteria}
    assert rows == now


def test_causes_are_of_the_table():
    """what hard.csv says is missed is what the cases have a cause for, line by line"""
    for r in hard.read():
        case = CASES[r["case"]]
        assert not hard.unexpected(case, hard.Outcome(r["case"], r["method"], hard.numbers(r), r["stopped"], r["cannot"])), (r["case"], r["method"])


@pytest.mark.parametrize("measures, stopped, word", [
    ({"a": 0.29, "b": 0.4, "pairs": 0.05}, "", ""),
    ({"a": 0.31, "b": 0.4, "pairs": 0.05}, "", "a 0.31 is worse"),
    ({"a": 0.2, "b": 0.3, "pairs": 0.05}, "", "b 0.3 is worse"),
    ({"a": 0.2, "b": 1.6, "pairs": 0.05}, "", "b 1.6 is worse"),  # on the other side of its range
    ({"a": 0.2, "b": 0.5, "pairs": 0.07}, "", "pairs 0.07 is worse"),
    ({"a": 0.01, "b": 0.5, "pairs": 0.02}, "", "a 0.01 is met"),
    ({}, "density -1.5e3 at step 7 (src/a.cpp:1)", "run"),
])
def test_known_misses_have_bounds(measures, stopped, word):
    criteria = {"a": 0.1, "b": (1.0, 1.5), "pairs": 0.01}
    case = hard.Case("c", "", None, {"m": ""}, criteria, known={"m": dict.fromkeys(criteria, "why")})
    rows = [{"case": "c", "method": "m", "measures": "a:0.2 b:0.5 pairs:0.02", "stopped": ""}]
    said = hard.unexpected(case, hard.Outcome("c", "m", measures, stopped), rows)
    assert word in said and bool(said) == bool(word)


@pytest.mark.parametrize("said, same", [
    ("density -1.6e+03 at step 9 (src/a.cpp:12) (t = 3)", True), ("energy -1.5e3 at step 7 (src/a.cpp:1)", False)])
def test_known_stops_are_of_one_kind(said, same):
    case = hard.Case("c", "", None, {"m": ""}, {"a": 0.1}, known={"m": {"run": "why"}})
    rows = [{"case": "c", "method": "m", "measures": "", "stopped": "density -1.5e3 at step 7 (src/a.cpp:1)"}]
    assert bool(hard.unexpected(case, hard.Outcome("c", "m", {}, said), rows)) != same


def test_the_table_of_the_howto():
    """is that of hard.csv: python3 tests/verify/hard.py --table > doc/src/tables/hard.inc"""
    folder = HERE.parents[1] / "doc" / "src"
    assert (folder / "tables" / "hard.inc").read_text() == hard.table(hard.read())
    assert ".. include:: tables/hard.inc" in (folder / "Howto_hard.rst").read_text()
