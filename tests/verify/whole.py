#!/usr/bin/env python3
"""Everything that takes long, part by part: the work of `make verify`.

    python3 tests/verify/whole.py --build build                 the parts that the record does not have for this commit; writes BUILD/verify/whole.md
    python3 tests/verify/whole.py --build build --only '^kills' those whose name it is found in        --list: names only
    python3 tests/verify/whole.py --build build --publish       and writes record and table to tests/verify/whole.json and whole.md, too

Parts are the programs of this folder, each test that is marked long, and a report in a real browser. A part that fails does not stop the others. Each is
recorded as it ends (BUILD/verify/whole.json, added to the published record), with its command and the commit, so a call that was interrupted goes on; what it
printed is in BUILD/verify/NAME.log.
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHIELD = ROOT / "examples/whipple-shield/cases/quick.yaml"
VERDICTS = (0, 3, 4)  # holds, fails, cannot be told
SKIPPED = 77  # what the programs of browsers end with where there is none
TABLE, RECORD = "tests/verify/whole.md", "tests/verify/whole.json"


def parts(build, out, ranks):
    """[(name, command, statuses that are right), ...]"""
    for program in ("shocks", "solids", "states", "expansion", "interface", "hard"):
        words = ["--ranks", str(ranks)] if program == "shocks" else []
        more = shlex.split(os.environ.get("VERIFY_ARGS" if program == "shocks" else f"{program.upper()}_ARGS", ""))
        yield program, [sys.executable, ROOT / f"tests/verify/{program}.py", "--lmp", build / "lmp", "--out", out, *words, *more], (0,)
    listed = subprocess.run(["ctest", "--test-dir", build, "-N", "-C", "long", "-L", "long"], text=True, capture_output=True, check=True).stdout
    for test in re.findall(r"Test +#\d+: (\S+)", listed):
        yield test, ["ctest", "--test-dir", build, "--output-on-failure", "-C", "long", "-R", f"^{test}$"], (0,)
    hvi = [sys.executable, "-m", "hvi"]
    yield "shield", [*hvi, "shield", SHIELD, "--lmp", build / "lmp", "--runs", out, "--jobs", str(ranks), "--ranks", "1"], VERDICTS
    yield "report", [*hvi, "report", out / "quick"], (0,)
    yield "browser", [sys.executable, ROOT / "tests/verify/browser.py", out / "quick/report.html", out / "browser"], (0,)
    yield "scene", [sys.executable, ROOT / "tests/verify/scene.py", "picture", out / "quick", out / "scene.png"], (0,)


def said(log):
    """how many tests passed, failed and were skipped, where a log says so"""
    last = re.findall(r"^(?:\d+: )?((?:\d+ \w+(?:, )?)+) in [\d.]+s", log, re.M)
    return last[-1] if last else ""


def result_of(code, right, summary):
    """'failed, status 1', 'skipped', 'passed, 2 skipped', 'passed'"""
    skipped, passed = (int((re.findall(rf"(\d+) {word}", summary) or [0])[0]) for word in ("skipped", "passed"))
    if code not in (*right, SKIPPED):
        return f"failed, status {code}"
    if code == SKIPPED or skipped and not passed:
        return "skipped"
    return f"passed, {skipped} skipped" if skipped else "passed"


def state():
    """commit, with a mark where the tree differs from it in more than the table"""
    def git(*words):
        return subprocess.run(["git", *words], cwd=ROOT, text=True, capture_output=True).stdout.strip()

    return (git("rev-parse", "--short", "HEAD") or "no git") + (" and changes" if git("status", "--porcelain", "--", ".", f":!{TABLE}", f":!{RECORD}") else "")


def table(record, names):
    lines = ["# Everything that takes long", "", "Written by `tests/verify/whole.py` (`make verify`) from its record; a part that was not run says so. Minutes are of shared cores and count for nothing.", "",
             "| part | result | said | minutes | commit | date |", "|---|---|---|---|---|---|"]
    for name in names:
        got = record.get(name)
        row = [name, "not run", "", "", "", ""] if got is None else [name, got["result"], got["said"], f"{got['minutes']:.1f}", got["commit"], got["date"]]
        lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


def main():
    a = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    a.add_argument("--build", default=ROOT / "build", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--ranks", default=min(2, os.cpu_count() or 1), type=int)
    a.add_argument("--only", default="", help="a regular expression for names of parts")
    a.add_argument("--list", action="store_true")
    a.add_argument("--publish", action="store_true", help="write the table into the tree")
    o = a.parse_args()
    out = o.build / "verify"
    out.mkdir(parents=True, exist_ok=True)
    file = out / "whole.json"
    record = {}
    for one in (ROOT / RECORD, file):  # what was published, of any machine; what this build has run since
        record |= json.loads(one.read_text()) if one.exists() else {}
    all_parts = list(parts(o.build, out, o.ranks))
    env = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
    for name, command, right in all_parts:
        if not re.search(o.only, name):
            continue
        now, words, before = state(), shlex.join(str(word).replace(f"{o.build}", "BUILD").replace(f"{ROOT}/", "") for word in command), record.get(name, {})
        if o.list or before.get("commit") == now and before.get("command") == words and before["result"] == "passed" and "changes" not in now:
            print(name, "" if o.list else "done before")
            continue
        if name == "shield":
            shutil.rmtree(out / "quick", ignore_errors=True)  # what is done is done for hvi shield, whatever LAMMPS has done it
        began = time.monotonic()
        with open(out / f"{name}.log", "w") as log:
            code = subprocess.run([ROOT / "cmake/env.sh", *map(str, command)], cwd=ROOT, env=env, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT).returncode
        text = (out / f"{name}.log").read_text(errors="replace")
        # ctest does not show what a test that passed has printed
        kept = o.build / "Testing/Temporary/LastTest.log"
        summary = said(kept.read_text(errors="replace") if command[0] == "ctest" and kept.exists() else text)
        result = result_of(code, right, summary)
        record[name] = dict(command=words, result=result, said=summary, minutes=(time.monotonic() - began) / 60, commit=now, date=datetime.date.today().isoformat())
        file.write_text(json.dumps(record, indent=1))
        print(f"{name}: {result} {summary}", flush=True)
    if o.list:
        return
    text = table(record, [name for name, _, _ in all_parts])
    (out / "whole.md").write_text(text)
    if o.publish:
        (ROOT / TABLE).write_text(text)
        (ROOT / RECORD).write_text(json.dumps(record, indent=1) + "\n")
    bad = [name for name, _, _ in all_parts if re.search(o.only, name) and record.get(name, {}).get("result", "").startswith("failed")]
    if bad:
        raise SystemExit("failed: " + ", ".join(bad) + f"; logs in {out}")


if __name__ == "__main__":
    main()
