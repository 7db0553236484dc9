#!/usr/bin/env python3
"""Builds and tests the package in its forms: compiler x LAMMPS version x built in or plugin x sanitizers x sizes of integers.

    python3 tests/verify/matrix.py                   all cells that the record does not have for these sources; writes tests/verify/matrix.md
    python3 tests/verify/matrix.py --only ^clang     those whose name it is found in          --list: names only
    python3 tests/verify/matrix.py --jobs 2 --make CMAKE_ARGS="-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"

A cell is one build, all warnings in our files counted, and a short list of tests. What was interrupted goes on where it
stopped: each cell is recorded (tests/verify/matrix.json) as it ends, with a hash of the sources that it is of.
"""

import argparse
import datetime
import hashlib
import itertools
import json
import os
import pathlib
import re
import shlex
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT, RECORD = ROOT / "build-matrix", ROOT / "tests/verify/matrix.json"
TESTED = ("tests/unit", "tests/style", "tests/lib", "tests/conftest.py", "tests/CMakeLists.txt", "tests/force-styles", "examples/single-plate/in.plate",
          "examples/standard-shocks", "potentials", "Makefile")  # what the tests below read
COMPILERS = ("g++", "clang++")
VERSIONS = {"20250204": "4 Feb 2025", "20260704": "4 Jul 2026"}
FORMS = ("built in", "plugin")
# forces of pairs and bonds, laws, elements, restart files, wrong input: one file of each kind
TESTS = ("pairs", "densities", "fem_mechanics", "sph_forces", "restart", "collectives", "force_styles")


def cells():
    """[(name, compiler, version, form, sanitize, sizes), ...]"""
    builds = [(c, v, False, "smallbig") for c, v in itertools.product(COMPILERS, VERSIONS)]
    builds += [("g++", "20250204", True, "smallbig"), ("g++", "20250204", False, "bigbig"), ("clang++", "20260704", False, "bigbig"),
               ("g++", "20250204", False, "smallsmall")]  # which 4 Jul 2026 does not have
    for compiler, version, sanitize, sizes in builds:
        for form in FORMS if not sanitize else FORMS[:1]:  # the stock program has no sanitizers to load the plugin with
            name = "-".join([compiler, version, *["sanitize"] * sanitize, *[sizes] * (sizes != "smallbig"), *["plugin"] * (form == "plugin")])
            yield name, compiler, version, form, sanitize, sizes


def sources():
    """hash of what cells are made of"""
    files = subprocess.run(["git", "ls-files", "src", "lib", "cmake", *TESTED], cwd=ROOT, text=True, capture_output=True, check=True).stdout.split()
    h = hashlib.sha256()
    for f in sorted(files):
        if (ROOT / f).exists():
            h.update(f.encode() + (ROOT / f).read_bytes())
    return h.hexdigest()[:12]


def run(command, log, cwd=ROOT, **more):
    with open(log, "w") as out:
        return subprocess.run([str(c) for c in command], cwd=cwd, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, **more).returncode


def make(folder, compiler, version, sanitize, sizes, jobs, more):
    """'' or what went wrong; the number of warnings in our files"""
    words = dict(word.split("=", 1) for word in more)
    if compiler != "g++":  # cmake's own choice, so that a LAMMPS that was built for it is taken
        words["CMAKE_ARGS"] = f"-DCMAKE_CXX_COMPILER={compiler} " + words.get("CMAKE_ARGS", "")
    folder.mkdir(parents=True, exist_ok=True)
    code = run(["make", "build", f"BUILD={folder}", f"LAMMPS_VERSION={version}", f"SANITIZE={'ON' if sanitize else 'OFF'}", f"SIZES={sizes}", f"JOBS={jobs}",
                *(f"{k}={v}" for k, v in words.items())], folder / "make.log")
    text = (folder / "make.log").read_text(errors="replace")
    warnings = len(set(re.findall(r"^.*(?:src/USER-HVI|lib/hvi|tests/unit)/.*warning: .*$", text, re.M)))
    if code:
        return f"does not build: {folder.name}/make.log", warnings
    cache = (folder / "CMakeCache.txt").read_text()
    real = subprocess.run([re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)[1], "--version"], text=True, capture_output=True).stdout
    if ("clang" in real) != ("clang" in compiler):
        return "was built by " + real.splitlines()[0], warnings
    said = subprocess.run([ROOT / "cmake/env.sh", folder / "lmp", "-h"], text=True, capture_output=True).stdout
    bits = tuple(re.search(rf"sizeof\({name}\): *(\d+)-bit", said)[1] for name in ("tagint", "bigint"))
    if bits != {"smallsmall": ("32", "32"), "smallbig": ("32", "64"), "bigbig": ("64", "64")}[sizes]:
        return f"has not the integers of {sizes}", warnings
    return "", warnings


def test(folder, form):
    """(passed, failed) of the unit tests and of the short list"""
    env = {**os.environ, "HVI_ROOT": str(ROOT), "HVI_LMP": str(folder / "lmp"), "HVI_LMP_STOCK": str(folder / "lmp-stock"), "HVI_PLUGIN": str(folder / "hviplugin.so"),
           "PYTHONDONTWRITEBYTECODE": "1", "MPLBACKEND": "Agg", "LAMMPS_POTENTIALS": str(ROOT / "potentials"), "OMPI_MCA_mpi_yield_when_idle": "1"}
    log = folder / f"tests-{form.replace(' ', '-')}.log"
    if form == "plugin":  # LAMMPS loads what it finds there
        env |= {"HVI_LMP": str(folder / "lmp-stock"), "LAMMPS_PLUGIN_PATH": str(folder)}
    python = subprocess.run([ROOT / "cmake/find-python.sh", "numpy", "pytest"], text=True, capture_output=True, check=True).stdout.strip()
    run([ROOT / "cmake/env.sh", python, "-m", "pytest", "-q", "-p", "no:cacheprovider", *(ROOT / f"tests/style/test_{t}.py" for t in TESTS)], log, env=env)
    passed, failed = (sum(map(int, re.findall(rf"(\d+) {word}", log.read_text(errors="replace").splitlines()[-1]))) for word in ("passed", "(?:failed|errors?)"))
    if form != "plugin":
        code = run([ROOT / "cmake/env.sh", folder / "tests/hvi_unit"], folder / "unit.log", folder / "tests", env=env)
        text = (folder / "unit.log").read_text(errors="replace")
        passed += int((re.findall(r"\[  PASSED  \] (\d+) tests?", text) or [0])[-1])
        failed += max(int((re.findall(r"(\d+) FAILED TESTS?", text) or [0])[-1]), int(code != 0))
    return passed, failed


def table(record):
    compilers = {c: subprocess.run([c, "--version"], text=True, capture_output=True).stdout.splitlines()[0] for c in COMPILERS}
    lines = ["# Builds and tests of the package in its forms", "",
             "Written by `tests/verify/matrix.py` from its record; what was not run says so.", "",
             "Compilers: " + "; ".join(compilers.values()) + ".",
             "Tests: those of the library (`tests/unit`, of the forms that are built in) and " + ", ".join(f"`{t}`" for t in TESTS) + " of `tests/style`.", "",
             "| compiler | LAMMPS | form | sanitizers | integers | warnings in our files | tests passed | failed | sources | date |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for name, compiler, version, form, sanitize, sizes in cells():
        got = record.get(name)
        row = [compiler, VERSIONS[version], form, "address, undefined" if sanitize else "none", sizes]
        if got is None:
            row += ["not run", "", "", "", ""]
        elif got["problem"]:
            row += [got["problem"], "", "", got["sources"], got["date"]]
        else:
            row += [got["warnings"], got["passed"], got["failed"], got["sources"], got["date"]]
        lines.append("| " + " | ".join(map(str, row)) + " |")
    (ROOT / "tests/verify/matrix.md").write_text("\n".join(lines) + "\n")


def main():
    a = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    a.add_argument("--only", default="", help="a regular expression for names of cells")
    a.add_argument("--list", action="store_true")
    a.add_argument("--jobs", default=2, type=int)
    a.add_argument("--make", default="", help='further words of make, as one text: DEPS=no CMAKE_ARGS="..."')
    o = a.parse_args()
    OUT.mkdir(exist_ok=True)
    file = RECORD
    record = json.loads(file.read_text()) if file.exists() else {}
    now, bad = sources(), 0
    for name, compiler, version, form, sanitize, sizes in cells():
        if not re.search(o.only, name):
            continue
        if o.list or record.get(name, {}).get("sources") == now:
            print(name, "" if o.list else "done before")
            continue
        folder = OUT / name.removesuffix("-plugin")
        problem, warnings = make(folder, compiler, version, sanitize, sizes, o.jobs, shlex.split(o.make))
        passed, failed = (0, 0) if problem else test(folder, form)
        record[name] = dict(problem=problem, warnings=warnings, passed=passed, failed=failed, sources=now, date=datetime.date.today().isoformat())
        file.write_text(json.dumps(record, indent=1) + "\n")
        table(record)
        bad += bool(problem or failed or not passed)
        print(name, problem or f"{passed} passed, {failed} failed, {warnings} warnings", flush=True)
    if not o.list:
        table(record)
    raise SystemExit(bool(bad))


if __name__ == "__main__":
    main()
