"""The report in doc/speed-error.md, and the tables of README.md and doc/src/tables/needs.inc, are those of the records in bench/records."""

import figures
import pareto
import pytest
import report
from conftest import ROOT

RECORDS = [str(ROOT / "bench" / "records")]


@pytest.fixture(scope="module")
def published():
    return report.load_cases(ROOT / "bench" / "cases"), report.load(RECORDS)


@pytest.mark.parametrize("drawn", [False, pytest.param(True, marks=pytest.mark.long)])
def test_the_report_is_of_the_records(published, monkeypatch, drawn):
    """python3 bench/report.py --records bench/records --out doc; the short form draws no figures, as tests/python/test_bench_report.py does"""
    if not drawn:
        monkeypatch.setattr(figures, "of_case", lambda case, runs: any(not (run.failed or run.cannot) for run in runs))
        monkeypatch.setattr(figures, "headline", lambda cases, points: True)
    made = report.Report(*published)
    assert made.markdown() == (ROOT / "doc" / "speed-error.md").read_text()
    for name in made.figures:
        assert (ROOT / "doc" / report.FOLDER / name).exists()


@pytest.mark.parametrize("page, words", [("README.md", ["--experiments"]), ("doc/src/tables/needs.inc", ["--needs", "--rst"])])
def test_tables_of_pages_are_of_the_records(page, words, capsys):
    """python3 bench/report.py --records bench/records and these words"""
    assert report.main(["--records", *RECORDS, *words]) == 0
    assert capsys.readouterr().out.strip() in (ROOT / page).read_text()


def test_records_of_a_case_are_of_one_binary(published):
    """those of exact solutions with a default that has a time; of others, which cost minutes, the report says what was not run or timed"""
    cases, records = published
    assert {r["case"] for r in records} == set(cases)
    for name in cases:
        assert len({(r["versions"]["binary"], r["source"]) for r in records if r["case"] == name}) == 1, name
    for name, points in pareto.all_points(cases, records).items():
        default = [p for p in points if p.default]
        assert cases[name]["group"] != "exact" or len(default) == 1 and default[0].timed, name
