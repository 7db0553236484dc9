"""bench/report.py: what is on the front, which settings a scene needs, and files that show it, from records made up here."""

import html.parser
import io
import json
import os
import re
import subprocess
import sys

import blocks
import figures
import numpy as np
import pareto
import pytest
import report
import sections
import yaml
from conftest import ROOT
from hvi.errors import HVIError
from hvi.report import page
from PIL import Image

EVIL = "<script>alert(1)</script> | *star*"
SOD = {"title": "Sod's shock tube", "group": "exact", "question": ["shock", "wave"], "about": f"A tube. {EVIL}",
       "error": {"main": "L1 p", "unit": "%"}, "resolution": "n", "base": {"C": 0.2, "kernel": "gauss", "h": 1.2},
       "methods": {"riemann": None, "monaghan": {"words": "viscosity 1 2"}, "stock sph": {"stock": "sph"}},
       "default": {"method": "riemann", "n": 400}}
HOLE = {"title": "Hole in a plate", "group": "measured", "question": "hole", "error": {"main": "hole", "unit": "%"}, "resolution": "dx",
        "finer": "down", "methods": {"riemann": {}, "hybrid": {"method": "hybrid"}}, "default": {"method": "riemann", "dx": 0.5},
        "points": [{"name": "LS-DYNA", "core_s": 40000, "error": 4.4, "source": "somebody 2024"}]}
DEM = {"title": "Drift of the ledger", "group": "dem", "error": {"main": "drift", "unit": "ppm"}, "resolution": "C", "finer": "down",
       "methods": {"hvi": {}}, "default": {"method": "hvi", "C": 0.1}}
STEP = {"title": "A lattice", "group": "steps", "methods": {"hvi": {"style": "hvi"}, "bpm/spring": {"style": "bpm"}}, "default": {"method": "hvi"}}
CASES = {"sod": SOD, "hole": HOLE, "drift": DEM, "lattice": STEP}


def record(case, error=None, cost=1.0, method="riemann", idle=True, failed="", cannot="", energy=1e-6, **settings):
    """a record as bench/run.py writes it; cost: core-seconds; ranks is a setting"""
    ranks, measure = settings.get("ranks", 1), CASES[case].get("error", {}).get("main")
    settings = {"method": method, **settings}
    n = settings.get("n", 100)
    return {"case": case, "group": CASES[case]["group"], "method": method, "settings": settings, "key": "0", "failed": failed, "cannot": cannot,
            "errors": {} if error is None else {measure: error, "other": 2 * error}, "numbers": {"bytes_per_particle": 700},
            "ledger": {"energy": energy, "momentum": 1e-15}, "particles": 10 * n, "steps": n, "ranks": ranks, "particle_steps": 10 * n * n,
            "wall_s": 1.1 * cost, "core_s": 1.1 * cost, "loop_s": cost / ranks, "memory_MB": 120.0, "load": 0.01 if idle else 0.5, "idle": idle,
            "versions": {"hvi": "v1", "lammps": "4 Feb 2025", "compiler": "GNU C++ 12", "python": "3.11.2"}, "date": "2026-11-20",
            "machine": {"cpu": "AMD EPYC", "cores": 2, "memory_GiB": 16}, "command": f"bench/run.py --size full --cases {case} --methods '{method}'"}


def write_cases(folder, cases=None):
    folder.mkdir()
    for name, case in (CASES if cases is None else cases).items():
        (folder / f"{name}.yaml").write_text(yaml.safe_dump(case, sort_keys=False))
    return folder


@pytest.fixture(name="cases")
def case_files(tmp_path):
    return pareto.load_cases(write_cases(tmp_path / "cases"))


def points(cases, records, name="sod"):
    return pareto.all_points(cases, records)[name]


def names(found):
    return [p.name for p in found]


SERIES = [("riemann", 100, 9.0, 1.0), ("riemann", 200, 4.5, 4.0), ("riemann", 400, 2.2, 16.0), ("riemann", 800, 1.1, 64.0),
          ("monaghan", 100, 12.0, 0.8), ("monaghan", 200, 8.0, 3.2), ("monaghan", 400, 5.0, 12.8), ("monaghan", 800, 3.0, 50.0)]


def series():
    return [record("sod", error, cost, method, n=n) for method, n, error, cost in SERIES]


# ---------------------------------------------------------------------- front, default
def test_front(cases):
    """by hand; what failed, has an open ledger or no time is not on it, however cheap and accurate; equal cost: the more accurate"""
    bad = [record("sod", 0.1, 0.1, n=100, C=0.3, failed="ERROR: Lost atoms"), record("sod", 0.1, 0.1, n=100, C=0.4, energy=2e-3),
           record("sod", 0.1, 0.1, n=100, C=0.1, idle=False), record("sod", float("nan"), 0.1, n=100, h=1.0),
           record("sod", 3.9, 4.0, n=200, kernel="cubic"), record("sod", 2.2, 17.0, n=400, h=1.0)]
    found = pareto.front(points(cases, series() + bad))
    assert names(found) == ["monaghan, n 100", "riemann, n 100", "monaghan, n 200", "riemann, n 200, kernel cubic", "riemann, n 400",
                            "riemann, n 800"]


@pytest.mark.parametrize("extra, word, by", [
    ([], "front", None),
    ([dict(error=2.0, cost=8.0, n=400, kernel="cubic")], "dominated", "riemann, n 400, kernel cubic"),
    ([dict(error=2.15, cost=15.7, n=400, kernel="cubic")], "within 5 %", None),
    ([dict(error=2.0, cost=8.0, n=400, kernel="cubic", idle=False)], "front", None),
    ([dict(error=2.0, cost=8.0, n=400, kernel="cubic", energy=0.1)], "front", None),
    ([dict(error=2.0, cost=8.0, n=400, method="stock sph", energy=None)], "dominated", "stock sph, n 400"),
    ([dict(error=1.0, cost=2.0, n=400, method="stock sph"), dict(error=2.0, cost=8.0, n=400, h=1.0)], "dominated", "riemann, n 400, h 1")])
def test_standing(cases, extra, word, by):
    """of the runs that dominate the default one of the package is named, if there is one"""
    found = pareto.standing(cases["sod"], points(cases, series() + [record("sod", **e) for e in extra]))
    assert found.word == word and (found.by.name if found.by else None) == by
    if by:
        assert found.cost_ratio == pytest.approx(0.5) and found.error_ratio == pytest.approx(2.0 / 2.2)


def test_standing_of_what_is_not_known(cases):
    rest = [r for r in series() if r["settings"] != {"method": "riemann", "n": 400}]

    def word(*of_default, case=cases["sod"]):
        return pareto.standing(case, points({"sod": case}, rest + list(of_default))).word

    assert word() == "not run"
    assert word(record("sod", 2.2, 16.0, n=400, idle=False)) == "not timed"
    assert word(record("sod", failed="ERROR: out of range", n=400)) == "fails"
    assert word(record("sod", 2.2, 16.0, n=400, energy=5e-3)) == "ledger open"
    assert word(case={**cases["sod"], "default": None}) == "no default"
    assert word(record("sod", 2.2, 16.0, n=400.0, C=0.2)) == "front"  # said in other words


# ---------------------------------------------------------------------- averages
def test_shifts_are_averaged(cases):
    """mean and standard deviation of magnitudes; times of the idle ones only; a better mean within the scatter is not better"""
    shifts = (2.0, 16.0, True, {}), (-2.6, 18.0, True, {"shift": 0.25}), (3.2, 99.0, False, {"shift": 0.75})
    runs = [record("sod", e, c, n=400, idle=idle, **shift) for e, c, idle, shift in shifts]
    variant = record("sod", 2.2, 8.0, n=400, kernel="cubic")
    default, other = points(cases, runs + [variant])
    assert default.runs == 3 and default.error == pytest.approx(2.6) and default.scatter == pytest.approx(0.6)
    assert default.cost == pytest.approx(17.0)
    assert default.rate == pytest.approx(1e6 * 34.0 / (2 * 4000 * 400)) and default.errors["other"] == pytest.approx(5.2)
    assert sections.error_text(default) == "2.60 +- 0.60 (3)"
    assert other.error < 0.95 * default.error and pareto.sides(other, default) == (-1, 0)
    [v] = pareto.variations(cases["sod"], [default, other])
    assert v.word == "cheaper"
    runs.append(record("sod", failed="ERROR: Lost atoms", n=400, shift=0.5))
    [failed] = points(cases, runs)
    assert not failed.counts and failed.failed == "ERROR: Lost atoms (1 of 4 runs)"


def test_repeated_records(cases):
    """the last record counts; a busy one of the same versions does not take the place of an idle one"""
    old, busy = record("sod", 2.2, 16.0, n=400), {**record("sod", 2.2, 30.0, n=400, idle=False), "date": "2026-11-21"}
    new = {**record("sod", 2.0, 12.0, n=400), "date": "2026-11-22", "versions": {"hvi": "v2"}}
    assert points(cases, [busy, old])[0].cost == 16.0
    assert points(cases, [new, busy, old])[0].cost == 12.0
    assert points(cases, [old, {**busy, "versions": {"hvi": "v2"}}])[0].cost is None


# ---------------------------------------------------------------------- one setting at a time
def test_variations(cases):
    """one setting, in the default's resolution or with the default in theirs; a kernel with its h is one; two settings are none"""
    more = [record("sod", 2.0, 8.0, n=400, C=0.3), record("sod", 2.4, 20.0, n=400, C=0.1), record("sod", 4.0, 5.0, n=200, C=0.1),
            record("sod", 2.21, 8.0, n=400, kernel="wendland2", h=1.6), record("sod", 1.0, 1.0, n=400, C=0.3, kernel="cubic"),
            record("sod", 1.9, 1.0, n=400, h=1.0, idle=False), record("sod", 1.0, 1.0, n=400, h=1.5, energy=1e-2),
            record("sod", 2.2, 16.1, n=400, ranks=2), record("sod", 1.0, 1.0, n=100, method="stock sph"),
            record("sod", 5.0, 1.0, n=400, method="monaghan", words="viscosity 2 2")]
    found = {(v.name, v.new, v.base.text): v.word for v in pareto.variations(cases["sod"], points(cases, series() + more))}
    assert found == {("n", "100", "n 400"): "trade", ("n", "200", "n 400"): "trade", ("n", "800", "n 400"): "trade",
                     ("C", "0.3", "n 400"): "dominates", ("C", "0.1", "n 400"): "dominated", ("C", "0.1", "n 200"): "trade",
                     ("h, kernel", "1.6, wendland2", "n 400"): "cheaper", ("h", "1", "n 400"): "more accurate, not timed",
                     ("h", "1.5", "n 400"): "ledger open", ("ranks", "2", "n 400"): "same", ("method", "monaghan", "n 400"): "trade"}
    table = sections.variations(cases["sod"], points(cases, series() + more))
    bold = [row for row in table.rows if isinstance(row[0], blocks.Bold)]
    assert [row[1] for row in bold] == ["0.2 to 0.3"] and bold[0][3] == "x 0.50" and bold[0][6] == "x 0.91"


def test_merged_settings_are_the_same_run(cases):
    """records that say all settings, those of the case and of the method too, are the same points"""
    own = {"riemann": {}, "monaghan": {"words": "viscosity 1 2"}}
    full = [{**r, "settings": {**SOD["base"], **own[r["method"]], **r["settings"]}} for r in series()]
    short, long = points(cases, series()), points(cases, full)
    assert names(long) == names(short) and [p.extra for p in long] == [{}] * len(long)
    assert [p.default for p in long] == [p.default for p in short]


# ---------------------------------------------------------------------- what a scene needs
def need(cases, records, name="sod", question="wave"):
    found = [n for n in pareto.scene_needs(cases, pareto.all_points(cases, records)) if n.question == question and n.case["name"] == name]
    assert len(found) == 1
    return [sections.need_cell(found[0], bound) for bound in pareto.BOUNDS]


def test_needs(cases):
    """cheapest within 2, 5, 10 %: by hand from SERIES; the finest run has none that confirms it"""
    assert need(cases, series()) == ["riemann, n 800: 64 s ?", "riemann, n 200: 4 s", "riemann, n 100: 1 s"]
    assert need(cases, series(), question="shock") == need(cases, series())


def test_needs_without_luck(cases):
    """a coarse run that is better than finer ones of its settings is luck, also where those have no time or other ranks; failed ones say nothing"""
    lucky = record("sod", 1.0, 0.5, n=100, C=0.1)
    assert need(cases, series() + [lucky])[0] == "riemann, n 100, C 0.1: 0.5 s ?"
    for how in ({}, {"idle": False}, {"ranks": 2}):
        finer = record("sod", 3.0, 2.0, n=200, C=0.1, **how)
        assert need(cases, series() + [lucky, finer]) == ["riemann, n 800: 64 s ?", "riemann, n 100, C 0.1: 0.5 s", "riemann, n 100, C 0.1: 0.5 s"], how
    for bad in ({"failed": "ERROR: Lost atoms"}, {"energy": 0.1}):
        assert need(cases, series() + [lucky, record("sod", 3.0, 2.0, n=200, C=0.1, **bad)])[0] == "riemann, n 100, C 0.1: 0.5 s ?"
    confirmed = [record("sod", 0.9, 90.0, n=1600)]
    assert need(cases, series() + [lucky, *confirmed])[0] == "riemann, n 800: 64 s"  # one that is confirmed goes before a cheaper one that is not


def test_needs_of_what_does_not_count(cases):
    """other packages, open ledgers, failed runs; no time is better than no answer; a mean and its deviation must be within"""
    bad = [record("sod", 0.1, 0.1, n=100, method="stock sph"), record("sod", 0.1, 0.1, n=100, C=0.3, energy=0.1),
           record("sod", 0.1, 0.1, n=100, C=0.4, failed="no end after 600 s")]
    assert need(cases, series() + bad) == need(cases, series())
    assert need(cases, bad) == ["- (no run counts)"] * 3
    busy = [{**r, "idle": False} if r["settings"]["n"] in (100, 200) else r for r in series()]
    assert need(cases, busy) == ["riemann, n 800: 64 s ?", "monaghan, n 400: 12.8 s", "monaghan, n 400: 12.8 s"]
    busy = [{**r, "idle": False} for r in series()]
    assert need(cases, busy) == [f"riemann, n {n} (not timed){sure}" for n, sure in ((800, " ?"), (200, ""), (100, ""))]
    wide = [record("sod", e, 1.0, n=100, C=0.1, shift=k) for k, e in enumerate((1.5, 2.0))]  # 1.75 +- 0.35
    assert need(cases, series()[:4] + wide)[0] == "riemann, n 800: 64 s ?"


def test_needs_where_smaller_is_finer(cases):
    runs = [record("hole", e, c, dx=dx) for dx, e, c in ((1, 4.0, 1.0), (0.5, 3.0, 8.0), (0.25, 2.5, 64.0))]
    assert need(cases, runs, "hole", "hole") == ["- (best 2.5 %)", "riemann, dx 1: 1 s", "riemann, dx 1: 1 s"]
    runs[2]["errors"]["hole"] = 6.0
    assert need(cases, runs, "hole", "hole") == ["- (best 3 %)", "- (best 3 %)", "riemann, dx 1: 1 s"]


# ---------------------------------------------------------------------- the cost of a step
def test_cost_of_a_step(cases):
    """medians over repetitions of core-seconds per particle-step; busy and failed runs have none"""
    unit = 1e-6 * 1000 * 100  # core-seconds at 1 us
    runs = [record("lattice", None, c * unit, "hvi", repeat=k, ranks=2) for k, c in enumerate((1.0, 3.0, 1.2))]
    runs += [record("lattice", None, c * unit, "bpm/spring", idle=idle, repeat=k, ranks=2) for k, (c, idle) in enumerate(((2.4, True), (9.0, False)))]
    runs += [record("lattice", None, unit, "bpm/spring", failed="ERROR: Bond atoms missing (/some/where/src/ntopo.cpp:60)", repeat=0, N=5)]
    rows = {(row[1], row[2]): row[4:] for row in sections.steps(cases["lattice"], runs).rows}
    assert rows["hvi", "ranks 2"] == ["1.2", "1 to 3", "1.00", "700", ""]
    assert rows["bpm/spring", "ranks 2"] == ["2.4", "-", "2.00", "700", ""]
    assert rows["bpm/spring", "N 5, ranks 1"][0] == "-"
    assert pareto.all_points(cases, runs) == {}
    failed = sections.failures(cases, {}, runs).rows
    assert failed == [["A lattice", "bpm/spring", "N 5, ranks 1", "ERROR: Bond atoms missing (ntopo.cpp:60)"]]


# ---------------------------------------------------------------------- files
def campaign():
    """records of all cases: busy ones, failed ones, shifts, variations"""
    runs = series() + [record("sod", 2.3, c, n=400, shift=k) for k, c in ((0.25, 16.5), (0.5, 15.9))]
    runs += [record("sod", 2.2 + 0.1 * k, 12.0 + 2 * k, n=400, C=c) for k, c in enumerate((0.1, 0.3, 0.4))]
    runs += [record("sod", 2.0, 9.0, n=400, kernel="cubic"), record("sod", 2.5, 9.0, n=400, h=1.0, idle=False)]
    runs += [record("sod", failed=f"ERROR: {EVIL} (/home/me/lammps/src/thermo.cpp:11)", method="stock sph", n=n) for n in (100, 200)]
    runs += [record("hole", e, c, dx=dx) for dx, e, c in ((1, 6.0, 10.0), (0.5, 3.5, 90.0), (0.25, 2.5, 800.0))]
    runs.append(record("hole", 0.0, 20.0, "hybrid", dx=1))
    runs += [record("hole", cannot="no elements of 0.5 mm", method="hybrid", dx=0.5), record("hole", 5.0, 300.0, "hybrid", dx=0.25, energy=0.02)]
    runs += [record("drift", e, c, "hvi", idle=False, C=step) for step, e, c in ((0.2, 93.0, 1.7), (0.1, 23.0, 2.2), (0.05, 7.0, 3.0))]
    return runs + [{**record("lattice", None, 0.1 * (1 + k), "hvi", repeat=k), "versions": {"hvi": f"v{k}"}} for k in range(3)]


class Seen(html.parser.HTMLParser):
    """elements, attributes and text of a page; what is not closed where it was opened fails"""

    def __init__(self, text):
        super().__init__()
        self.elements, self.text, self.inside = [], [], []
        self.feed(text)
        assert self.inside == []

    def handle_starttag(self, name, attributes):
        self.elements.append((name, dict(attributes)))
        if name not in page.VOID:
            self.inside.append(name)

    def handle_endtag(self, name):
        assert self.inside.pop() == name, f"{name} is closed where it is not open"

    def handle_data(self, data):
        if "style" not in self.inside:
            self.text.append(data)


@pytest.fixture(name="made", scope="module")
def made_report(tmp_path_factory):
    """(folder, words for the command line) of a report"""
    folder = tmp_path_factory.mktemp("bench")
    (folder / "records" / "sod").mkdir(parents=True)
    for k, r in enumerate(campaign()):
        if r["case"] == "sod":
            (folder / "records" / "sod" / f"{k}.json").write_text(json.dumps(r, indent=1))
        else:
            with open(folder / "records" / f"{r['case']}.jsonl", "a", encoding="utf-8") as stream:
                stream.write(json.dumps(r) + "\n")
    words = ["--cases", str(write_cases(folder / "cases")), "--records", str(folder / "records")]
    assert report.main([*words, "--out", str(folder / "out")]) == 0
    return folder, words


def test_markdown(made):
    """counts, links, failures; nothing of the machine where it ran"""
    folder, _ = made
    data = (folder / "out" / "speed-error.md").read_bytes()
    assert data.isascii()
    text = data.decode()
    n = len(campaign())
    assert (f"{n} runs: {n - 7} timed on idle cores; 4 on busy cores, of which the errors are used and the times are not; 2 failed; "
            "1 that the method cannot do.") in text
    links = re.findall(r"!\[[^]]*\]\(([^)]*)\)", text)
    assert links == [f"speed-error/{name}.png" for name in ("headline", "sod", "hole", "drift")]
    assert all((folder / "out" / link).is_file() for link in links)
    failed = text.partition("## What failed")[2].partition("\n## ")[0]
    assert "| Sod's shock tube | stock sph | n 100 | ERROR: &lt;script&gt;alert(1)&lt;/script&gt; \\| \\*star\\* (thermo.cpp:11) |" in failed
    assert "| Hole in a plate | hybrid | dx 0.5 | cannot: no elements of 0.5 mm |" in failed
    assert "| hybrid | dx 0.25 | ledger open: energy off by 2 % |" in failed
    assert failed.count("\n|") == 2 + 4
    assert "Records are of several versions." in text and "Times are of several machines" not in text
    assert "/home" not in text and "<script" not in text
    assert ("| Sod's shock tube | L1 p, % | riemann, n 400 | 2.27 +- 0.06 (3) | 16.1 | **no: riemann, n 400, kernel cubic: cost x 0.56, "
            "error x 0.88** |") in text
    assert "LS-DYNA | 40000 | 4.4 | somebody 2024" in text
    assert "Without a front, as no run that counts was timed: Drift of the ledger." in text
    rows = [line for line in text.splitlines() if line.startswith("|")]
    tables = "\n".join(line if line.startswith("|") else "" for line in text.splitlines()).split("\n\n")
    assert rows and all(len({len(re.findall(r"(?<!\\)\|", row)) for row in table.strip().splitlines()}) <= 1 for table in tables)


def test_page(made):
    """one file, valid, nothing from elsewhere; texts of records are texts"""
    folder, _ = made
    text = (folder / "out" / "speed-error.html").read_text(encoding="utf-8")
    seen = Seen(text)
    said = "".join(seen.text)
    assert EVIL in said and "Hole in a plate" in said and "2.27 \u00b1 0.06 (3)" in said
    assert not [e for e in seen.elements if e[0] in ("script", "link", "iframe", "object", "base")]
    pictures = [attributes for name, attributes in seen.elements if name == "img"]
    assert len(pictures) == 4 and all(p["src"].startswith("data:image/png;base64,") and p["alt"] for p in pictures)
    ids = {a["id"] for _, a in seen.elements if "id" in a}
    assert all(a["href"][0] == "#" and a["href"][1:] in ids for name, a in seen.elements if name == "a")
    assert not re.search(r"url\(|@import|https?://", text)


def test_figures(made):
    """small files, 700 pixels wide"""
    folder, _ = made
    for path in (folder / "out" / "speed-error").iterdir():
        with Image.open(path) as picture:
            assert picture.width == 700 and 200 < picture.height < 1000, path
            pixels = np.asarray(picture.convert("RGB"))
        assert path.stat().st_size < 40_000 and (pixels != 255).any(axis=2).mean() > 0.01
        edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
        assert (edge == 255).all(), f"{path.name} is cut off"


def test_same_bytes_again(made, tmp_path):
    """whatever the order of the files and of Python's sets"""
    folder, words = made
    files = sorted((folder / "records").rglob("*.json*"), reverse=True)
    command = [sys.executable, ROOT / "bench" / "report.py", *words[:2], "--records", *files, "--out", tmp_path / "again"]
    done = subprocess.run(command, env={**os.environ, "PYTHONHASHSEED": "7"}, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith(f"report: {tmp_path / 'again' / 'speed-error.md'}"), done.stderr
    first, second = ({p.relative_to(top): p.read_bytes() for p in top.rglob("*") if p.is_file()} for top in (folder / "out", tmp_path / "again"))
    assert len(first) == 6 and first == second


def test_labels_do_not_lie_on_each_other(cases):
    """of the default and of the front, nor on points; all within the axes"""
    figure = figures.of_case(cases["sod"], points(cases, campaign_of("sod")))
    figure.canvas.draw()
    ax = figure.axes[0]
    boxes = [text.get_window_extent() for text in ax.texts if text.get_text()]
    assert any(text.get_text().startswith("default: riemann, n 400") for text in ax.texts) and len(boxes) > 4
    assert not [1 for k, a in enumerate(boxes) for b in boxes[:k] if a.overlaps(b)]
    lines = [line for line in ax.lines if line.get_marker() not in ("None", None, "")]
    marks = np.concatenate([ax.transData.transform(np.column_stack(line.get_data())) for line in lines])
    assert not [1 for box in boxes for x, y in marks if box.contains(x, y)]
    frame = ax.get_window_extent()
    assert all(frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1 for box in boxes)
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    assert [name for name in ("riemann", "monaghan", "Pareto front", "default") if name not in legend] == [] and "stock sph" not in legend


def campaign_of(name):
    return [r for r in campaign() if r["case"] == name]


def test_figure_without_times(cases):
    """particle-steps across, no front; nothing at all if all failed; zero errors have a place"""
    figure = figures.of_case(cases["drift"], points(cases, campaign_of("drift"), "drift"))
    assert figure.axes[0].get_xlabel() == figures.WORK and "Pareto front" not in [t.get_text() for t in figure.axes[0].get_legend().get_texts()]
    assert figure.axes[0].get_ylabel() == "drift (ppm)"
    assert figures.of_case(cases["sod"], points(cases, [record("sod", failed="ERROR", n=100)])) is None
    hole = figures.of_case(cases["hole"], points(cases, campaign_of("hole"), "hole"))
    lowest = min(y for line in hole.axes[0].lines for y in line.get_ydata())
    assert lowest == pytest.approx(1.25) and hole.axes[0].get_ylim()[0] < lowest
    assert figures.headline(cases, pareto.all_points(cases, campaign_of("drift"))) is None


def test_tables_on_the_screen(made, capsys):
    """for README and documentation; the five questions of users only"""
    _, words = made
    assert report.main([*words, "--needs"]) == 0
    text = capsys.readouterr().out
    assert "| arrival and stress of a wave | Sod's shock tube | riemann, n 400, kernel cubic: 9 s ? | riemann, n 200: 4 s |" in text
    assert "| hole in a wall | Hole in a plate |" in text and "states behind" not in text
    assert report.main([*words, "--needs", "--headline", "--rst"]) == 0
    core = pytest.importorskip("docutils.core")
    problems = io.StringIO()
    tree = core.publish_doctree(capsys.readouterr().out, settings_overrides={"warning_stream": problems, "report_level": 1})
    assert problems.getvalue() == ""
    def all_of(node, name):
        return node.findall(lambda inner: inner.tagname == name)

    cells = [[entry.astext() for entry in all_of(row, "entry")] for row in all_of(tree, "row")]
    assert ["hole in a wall", "Hole in a plate", "hybrid, dx 1: 20 s ?", "riemann, dx 0.5: 90 s", "riemann, dx 1: 10 s"] in cells
    assert ["Drift of the ledger", "drift, ppm", "hvi, C 0.1", "23", "-", "not known: not timed", "-"] in cells


@pytest.mark.parametrize("name, text, said", [
    ("a.jsonl", json.dumps(record("sod", 1.0)) + '\n\n{"case": "sod", \n', r"a.jsonl:3: no JSON"),
    ("a.json", '{\n"case": 1,\n oops}', r"a.json:3: no JSON"),
    ("a.jsonl", json.dumps({**record("sod", 1.0), "case": "soda"}), r"unknown case soda; there are .*sod"),
    ("a.jsonl", json.dumps({**record("sod", 1.0), "method": "rieman"}), r"case sod: a record has the method rieman, the case file only riemann"),
    ("a.jsonl", "[]", r"a.jsonl:1: a record is a JSON object"),
    ("a.jsonl", '{"case": "sod"}', r"a.jsonl:1: no method"),
    ("a.jsonl", json.dumps({k: v for k, v in record("sod", 1.0).items() if k != "loop_s"}), r"a.jsonl:1: no loop_s in the record of a run that"),
    ("a.txt", "", r"no records: run bench/run.py first")],
    ids=["line", "file", "case", "method", "list", "key", "loop", "none"])
def test_wrong_records(tmp_path, capsys, name, text, said):
    folder = tmp_path / "records"
    folder.mkdir()
    (folder / name).write_text(text)
    assert report.main(["--cases", str(write_cases(tmp_path / "cases")), "--records", str(folder), "--out", str(tmp_path / "out")]) == 1
    output = capsys.readouterr()
    assert re.search(said, output.err) and output.err.startswith("report: ") and output.out == "" and not (tmp_path / "out").exists()


@pytest.mark.parametrize("text, said", [
    ("title: [", r"x.yaml:1: no YAML"), ("[]", r"x.yaml: a case is a mapping"), ("title: a", r"x.yaml: no group, methods, error, resolution"),
    (json.dumps({**SOD, "group": "odd"}), r"group must be exact"), (json.dumps({**SOD, "error": "L1"}), r"error must say its main measure")],
    ids=["YAML", "mapping", "keys", "group", "error"])
def test_wrong_cases(tmp_path, text, said):
    folder = write_cases(tmp_path / "cases", {})
    with pytest.raises(HVIError, match="no case"):
        pareto.load_cases(folder)
    (folder / "x.yaml").write_text(text)
    with pytest.raises(HVIError, match=said):
        pareto.load_cases(folder)


def test_missing_file_and_words(tmp_path, capsys):
    cases = str(write_cases(tmp_path / "cases"))
    assert report.main(["--cases", cases, "--records", "nowhere", "--out", "out"]) == 1
    assert "nowhere: no such file or folder" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        report.main(["--cases", cases, "--records", cases])
    assert "--out" in capsys.readouterr().err


def test_numbers():
    """three digits, no exponent where that can be read"""
    said = [str(blocks.number(x)) for x in (None, 3, 0.0, 1.2345, 12345.6, 999999.0, 1.5e7, 2.5e-6, -0.012345)]
    assert said == ["-", "3", "0", "1.23", "12300", "1000000", "1.5e7", "2.5e-6", "-0.0123"]
    assert pareto.without_folders("ERROR: no (/a/b-c/d.cpp:12) at 3 m/s and /x/y\n z") == "ERROR: no (d.cpp:12) at 3 m/s and y z"
