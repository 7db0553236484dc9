"""Cases of the bench (bench/cases) and their runners: consistent, and right in size where a run takes less than a second."""

import csv
import importlib
import itertools
import json

import pytest
import report
import run as bench
import runners
import yaml
from conftest import ROOT

CASES = {path.stem: yaml.safe_load(path.read_text()) for path in sorted((ROOT / "bench" / "cases").glob("*.yaml"))}
NEEDED = {"title", "group", "about", "runner", "methods", "default", "short"}
MEASURED = {"error", "resolution"}  # beside those, of all but steps: speed alone
QUESTIONS = {"wave", "hole", "cloud", "verdict", "fragments", "shock", "strength"}


def expand(entries):
    """the product of the lists of each entry"""
    for entry in entries:
        lists = [value if isinstance(value, list) else [value] for value in entry.values()]
        yield from (dict(zip(entry, values)) for values in itertools.product(*lists))


def runner(case):
    return importlib.import_module(f"runners.{case['runner']}")


def run(name, folder, lmp, ranks=1, **settings):
    case = CASES[name]
    r = runner(case).run(case, settings, folder, lmp, ranks=ranks, timeout=120)
    assert set(r) == {"particles", "steps", "loop_s", "errors", "numbers", "ledger", "failed"}
    assert r["failed"] == "" and r["particles"] > 0 and r["steps"] > 0 and r["loop_s"] > 0
    assert case["error"]["main"] in r["errors"] and all(type(v) is float for d in (r["errors"], r["numbers"], r["ledger"]) for v in d.values())
    assert set(r["ledger"]) <= {"energy", "momentum"} and r["ledger"]["energy"] < 0.02
    return r["errors"][case["error"]["main"]]


@pytest.mark.parametrize("name", CASES)
def test_case_file(name):
    case = CASES[name]
    assert NEEDED <= set(case), NEEDED - set(case)
    assert case["group"] in ("exact", "measured", "dem", "steps")
    module, short, full = runner(case), list(expand(case["short"])), list(expand(case.get("full", [])))
    if case["group"] == "steps":
        return
    assert MEASURED <= set(case), MEASURED - set(case)
    if case["group"] != "dem":  # a question may have more about it: a dict
        questions = case["question"] if isinstance(case["question"], list) else [case["question"]]
        assert questions and all(isinstance(q, dict) or q in QUESTIONS for q in questions)
    assert set(case["error"]) <= {"main", "unit", "uncertainty"} and case["error"]["unit"]
    known = getattr(module, "SETTINGS", None)
    for settings in [*short, *full]:
        assert settings["method"] in case["methods"] and case["resolution"] in settings, settings
        if known:
            try:
                runners.merged(case, settings, known)
            except runners.Cannot as why:
                assert str(why), settings
    assert case["default"] in short or case["default"] in full
    for form in (short, full):
        assert all(form.count(s) == 1 for s in form), "the same run twice"
    unused = set(case["methods"]) - {s["method"] for s in [*short, *full]}
    assert not unused, f"methods without runs: {unused}"


def test_wrong_settings():
    case = CASES["sod"]
    known = runner(case).SETTINGS
    with pytest.raises(ValueError, match="no setting kernal"):
        runners.merged(case, dict(method="riemann", n=100, kernal="cubic"), known)
    with pytest.raises(ValueError, match="no method roe"):
        runners.merged(case, dict(method="roe", n=100), known)
    with pytest.raises(runners.Cannot, match="gamma 1.4"):
        runner(case).run(CASES["noh-1d"], dict(method="stock sph", n=100), None, None)


def test_failures_are_told(tmp_path):
    """energy that is off, numbers that are none, LAMMPS's own errors"""
    assert runners.answer(tmp_path, 1, {"L1": 1.0}, energy=0.4)["failed"] == "energy off by 40 %"
    assert runners.answer(tmp_path, 1, {"L1": float("nan")})["failed"] == "not finite"
    (tmp_path / "log.1").write_text("Loop time of 1.5 on 2 procs for 10 steps with 4 atoms\nLoop time of 0.25 on 2 procs for 3 steps with 4 atoms\n")
    r = runners.answer(tmp_path, 4, {"L1": 1.0}, energy=1e-4)
    assert (r["loop_s"], r["steps"], r["failed"]) == (1.75, 13, "")


def test_sod(tmp_path, lmp_exe):
    """as tests/verify/shocks.csv has it, on one rank and on two; another step, kernel and h make differences, but no large ones"""
    with open(ROOT / "tests" / "verify" / "shocks.csv") as f:
        rows = list(csv.DictReader(line for line in f if line[0] != "#"))
    known = {r["method"]: 100 * float(r["l1_p"]) for r in rows if r["case"] == "sod" and r["n"] == "200"}

    def error(k, **settings):
        folder = tmp_path / str(k)
        folder.mkdir()
        return run("sod", folder, lmp_exe, **{"n": 200, **settings})

    for method in ("monaghan", "interface", "riemann"):
        assert error(method, method=method) == pytest.approx(known[method], rel=1e-3)
    base = error("ranks", method="riemann", ranks=2)
    assert base == pytest.approx(known["riemann"], rel=1e-3)
    others = dict(C=0.1, kernel="cubic", h=1.5, variable=False, skin=1.0)
    found = {k: error(k, method="riemann", **{k: v}) for k, v in others.items()}
    assert all(0.5 < v / base < 2.5 for v in found.values()), found
    assert found["skin"] == pytest.approx(base, rel=1e-6)
    assert all(abs(found[k] / base - 1) > 1e-3 for k in ("kernel", "h", "variable")), found


# case, settings, bounds of the main error in percent

SIZES = [("noh-3d", dict(method="riemann", n=8), 20, 25), ("layered", dict(method="riemann", n=100), 2, 4),
         ("flyer-1000", dict(method="machdyn ulsph", n=25), 5, 15), ("flyer-1000", dict(method="machdyn tlsph", n=25), 5, 15),
         ("piston", dict(method="viscosity", n=32), 3, 12), ("solid-flyer-1000", dict(method="machdyn tlsph", n=32), 5, 25),
         ("wall-wave", dict(method="viscosity", layers=2), 0, 0.3),
         ("wall-wave", dict(method="elements", layers=2), 0, 0.1), ("bending", dict(method="elements", layers=2), 0, 0.5),
         ("elastic-pulse", dict(method="elements", n=4), 1, 20), ("elastic-pulse", dict(method="machdyn tlsph", n=4), 5, 50),
         ("verney-shell", dict(method="viscosity", layers=2), 1, 10), ("verney-cylinder", dict(method="viscosity", layers=4), 0, 3),
         ("taylor", dict(method="elements", n=2), 1, 10), ("spall", dict(method="riemann", n=16), 5, 15)]


@pytest.mark.parametrize("name,settings,least,most", SIZES, ids=[f"{name}-{s['method']}".replace(" ", "-") for name, s, *_ in SIZES])
def test_size_of_errors(tmp_path, lmp_exe, name, settings, least, most):
    assert least < run(name, tmp_path, lmp_exe, **settings) < most


def test_octant(tmp_path, lmp_exe):
    """an eighth of a ball between mirrors is the whole ball"""
    found = []
    for octant in (True, False):
        folder = tmp_path / str(octant)
        folder.mkdir()
        found.append(run("noh-3d", folder, lmp_exe, method="riemann", n=6, octant=octant))
    assert found[0] == pytest.approx(found[1], rel=1e-6)


def test_records_know_what_makes_them():
    """whatever changes in a runner or in any room of python/hvi, records of before are old"""
    assert {*(ROOT / "python" / "hvi").rglob("*.py"), *(ROOT / "bench" / "runners").glob("*.py")} <= set(bench.made_of())


def test_publish(tmp_path, monkeypatch):
    """records of a case are of one binary and one state of the sources; those of two cases may be of two"""
    monkeypatch.setattr(bench, "HERE", tmp_path)
    (tmp_path / "cases").mkdir()
    for name in ("one", "two"):
        (tmp_path / "cases" / f"{name}.yaml").write_text(
            "{title: t, group: exact, about: a, runner: shock, methods: {m: {}}, default: {method: m, n: 1}, error: {main: e}, resolution: n, short: [{method: m, n: [1, 2]}]}")
        (tmp_path / "out" / "records" / name).mkdir(parents=True)

    def write(name, n, binary, source="s"):
        settings = {"method": "m", "n": n}
        record = dict(settings=settings, failed="", versions={"binary": binary}, source=source, case=name)
        (tmp_path / "out" / "records" / name / f"{bench.key_of(name, settings)}.json").write_text(json.dumps(record))

    with pytest.raises(bench.Wrong, match="no records"):
        bench.publish(tmp_path / "out")
    for name, binary in (("one", "a"), ("two", "b")):
        write(name, 1, binary), write(name, 2, binary), write(name, 3, "c")  # the last is in no case file
    bench.publish(tmp_path / "out")
    published = [json.loads(line) for name in ("one", "two") for line in (tmp_path / "records" / f"{name}.jsonl").read_text().splitlines()]
    assert [(r["case"], r["settings"]["n"]) for r in published] == [("one", 1), ("one", 2), ("two", 1), ("two", 2)]
    assert report.of_binaries(published) == ", those of a case of one binary"
    assert report.of_binaries(published[:2]) == ", all of one binary" and report.of_binaries([*published, {**published[0], "versions": {}}]) == ""
    for wrong in (dict(binary="b"), dict(binary="a", source="t")):
        write("one", 2, **wrong)
        with pytest.raises(bench.Wrong, match="more than one state of the sources, in one: run"):
            bench.publish(tmp_path / "out")
