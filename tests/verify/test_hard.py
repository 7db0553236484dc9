"""Hard cases (tests/hard.py), short form: every criterion is met, or missed with its cause in the table of doc/src/Howto_hard.rst."""

import csv
import pathlib

import hard
import pytest

HERE = pathlib.Path(__file__).resolve().parent
CASES = {c.name: c for c in hard.cases()}


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
    """hard_criteria.csv was there before the first run; the cases have not moved away from it"""
    with open(HERE / "hard_criteria.csv") as f:
        rows = {(r["case"], r["measure"]): (r["least"], r["most"]) for r in csv.DictReader(line for line in f if line[0] != "#")}
    now = {(c.name, m): tuple("" if abs(b) == float("inf") else f"{b:g}" for b in c.bounds(m)) for c in CASES.values() for m in c.criteria}
    assert rows == now


def test_causes_are_of_the_table():
    """what hard.csv says is missed is what the cases have a cause for, line by line"""
    for r in hard.read():
        case = CASES[r["case"]]
        measures = {k: float(v) for k, v in (pair.rsplit(":", 1) for pair in r["measures"].split())}
        assert not hard.unexpected(case, hard.Outcome(r["case"], r["method"], measures, r["stopped"], r["cannot"])), (r["case"], r["method"])


def test_the_table_of_the_howto():
    """is that of hard.csv: python3 tests/hard.py --table"""
    text = (HERE.parents[1] / "doc" / "src" / "Howto_hard.rst").read_text()
    assert hard.table(hard.read()) in text
