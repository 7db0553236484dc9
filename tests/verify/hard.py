#!/usr/bin/env python3
"""Hard cases: which methods live through them, and which do not and why. The scenes are in hard_gas.py and hard_solids.py.

    python3 tests/verify/hard.py --out build/verify       all cases and methods, stock LAMMPS beside: hard.csv, hard.md
    python3 tests/verify/hard.py --criteria FILE          the criteria, without running anything
    python3 tests/verify/hard.py --table                  doc/src/tables/hard.inc from tests/verify/hard.csv

Criteria are in tests/verify/hard_criteria.csv, written down before the first run but for those of cases that came later, as it says there. What is
known to miss one has its cause in the case.
"""

import argparse
import csv
import dataclasses
import pathlib
import re
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
import hard_gas  # noqa: E402
import hard_solids  # noqa: E402
from hard_cases import Cannot, Case  # noqa: E402, F401
from lammps_runs import Stopped, executor  # noqa: E402


@dataclasses.dataclass
class Outcome:
    case: str
    method: str
    measures: dict
    stopped: str = ""
    cannot: str = ""

    def missed(self, case):
        """{measure: number} outside the criteria; {"run": nan} if it stopped"""
        if self.stopped:
            return {"run": np.nan}
        lo = {m: case.bounds(m) for m in case.criteria}
        absent = set(case.criteria) - set(self.measures) if not self.method.startswith("stock") else set()
        assert not absent, f"{case.name}, {self.method}: not measured: {absent}"
        return {m: v for m, v in self.measures.items() if m in lo and not lo[m][0] <= v <= lo[m][1]}


def run(case, method, lmp, folder):
    """an Outcome"""
    try:
        measures = {k: float(v) for k, v in case.scene(lmp, folder, case.methods[method]).items()}
    except Cannot as why:
        return Outcome(case.name, method, {}, cannot=str(why))
    except Stopped as why:
        return Outcome(case.name, method, {}, stopped=str(why))
    bad = [k for k, v in measures.items() if not np.isfinite(v)]
    return Outcome(case.name, method, measures, stopped=f"not finite: {', '.join(bad)}" if bad else "")


def clearly(case, measure, value):
    """whether a criterion is met by so much that another machine's round-off does not decide: half of the bound, a tenth of a range"""
    lo, hi = case.bounds(measure)
    return value <= 0.5 * hi if np.isinf(lo) else lo + 0.1 * (hi - lo) <= value <= hi - 0.1 * (hi - lo)


# what a few particles or round-off decide differs more between machines than what a flow does
FEW = {"symmetry", "mirror", "paired", "pairs", "pieces", "nearest"}


def no_worse(case, measure, value, recorded):
    """whether a value is within its bounds, or beyond them by no more than 1.5 times the number of hard.csv (3 times for FEW)"""
    (lo, hi), most = case.bounds(measure), 3.0 if measure in FEW else 1.5
    return min(lo, recorded * most, recorded / most) <= value <= max(hi, recorded * most, recorded / most)


def kind_of_stop(said):
    """an error without its numbers and place"""
    return said if said.startswith("ended") else re.sub(r"\(src/.*|[-+]?\d[\d.e+-]*", "#", said)


def numbers(row):
    """{measure: number} of a row of hard.csv"""
    return {k: float(v) for k, v in (pair.rsplit(":", 1) for pair in row["measures"].split())}


def unexpected(case, outcome, rows=None):
    """what must not be: a criterion missed without a cause, a known miss that is worse than in hard.csv (or rows of its kind) or another kind of
    stop, a cause that is clearly none any more; "" if all is as it is said"""
    missed, known = set(outcome.missed(case)), set(case.known.get(outcome.method, {}))
    if outcome.cannot or outcome.method.startswith("stock"):
        return ""
    record = next((r for r in (read() if rows is None else rows) if (r["case"], r["method"]) == (case.name, outcome.method)), None)
    worse = []
    for m in missed & known:
        if not record:
            worse.append(f"{m} missed, as known, but hard.csv has no number to compare with")
        elif m == "run" and kind_of_stop(outcome.stopped) != kind_of_stop(record["stopped"]):
            worse.append(f"stops with {outcome.stopped!r}, known with {record['stopped']!r}")
        elif m != "run" and not (record["measures"] and no_worse(case, m, outcome.measures[m], numbers(record)[m])):
            worse.append(f"{m} {outcome.measures[m]} is worse than in hard.csv ({record['measures'] or record['stopped']})")
    missed |= {m for m in known - missed if m in outcome.measures and not clearly(case, m, outcome.measures[m])}
    more = [f"{m} {outcome.measures.get(m, outcome.stopped)} not within {case.bounds(m) if m in case.criteria else 'a run'}" for m in missed - known]
    less = [f"{m} {outcome.measures.get(m, '')} is met: take its cause out" for m in known - missed]
    return "; ".join(more + worse + less)


def ranges(rows):
    """lines with the least and the largest number of each measure, of rows of hard.csv"""
    found = {}
    for row in rows:
        for measure, value in numbers(row).items():
            found.setdefault(measure, []).append(value)
    return [f"{measure} {min(values):.3g} to {max(values):.3g}" for measure, values in found.items()]


def cases():
    return [*hard_gas.CASES, *hard_solids.CASES]


COLUMNS = ["case", "method", "measures", "missed", "stopped", "cannot"]


def as_row(case, o):
    show = lambda d: " ".join(f"{k}:{v:.3g}" for k, v in d.items())  # noqa: E731
    return [o.case, o.method, show(o.measures), " ".join(o.missed(case)), o.stopped, o.cannot]


def write_criteria(path):
    with open(path, "w", newline="") as f:
        f.write("# python3 tests/verify/hard.py --criteria: since first: written down before the first run; after: when numbers were known\n")
        w = csv.writer(f, lineterminator="\n")
        w.writerow(["case", "measure", "least", "most", "since"])
        for c in cases():
            for m in c.criteria:
                w.writerow([c.name, m, *("" if np.isinf(b) else f"{b:g}" for b in c.bounds(m)), c.since])


def table(rows):
    """reST: a list-table, a row per case, what each method misses with its number and that of its cause; then the causes"""
    out = [".. list-table::", "   :header-rows: 1", "   :widths: 30 40 30", "", "   * - case", "     - hvi", "     - stock LAMMPS"]
    by, numbered = {}, {}
    for r in rows:
        by.setdefault(r["case"], []).append(r)

    def because(why):
        return f" ({numbered.setdefault(why, len(numbered) + 1)})" if why else ""

    for c in cases():
        ours, theirs = [], []
        for r in by.get(c.name, []):
            numbers = dict(p.split(":") for p in r["measures"].split())
            known = c.known.get(r["method"], {})
            if r["cannot"]:
                said = "cannot" + because(r["cannot"])
            elif r["stopped"]:
                at = re.search(r" \(t = ([\d.]+)\)$", r["stopped"])
                said = "**stops**" + (f" at t = {at[1]}" if at else "") + because(known.get("run", re.sub(r" \((src/|t = )[^)]*\)", "", r["stopped"])))
            elif r["missed"]:
                causes = {}
                for m in r["missed"].split():
                    causes.setdefault(known.get(m, ""), []).append(f"{m} {numbers[m]}")
                said = "**misses** " + "; ".join(", ".join(what) + because(why) for why, what in causes.items())
            else:
                said = "passes"
            (theirs if r["method"].startswith("stock") else ours).append((r["method"].removeprefix("stock "), said))

        def joined(cells):
            same = {}
            for method, said in cells:
                same.setdefault(said, []).append(method)
            return "; ".join(f"{', '.join(methods)}: {said}" for said, methods in same.items()) or "--"

        out += [f"   * - {c.title}", f"     - {joined(ours)}", f"     - {joined(theirs)}"]
    return "\n".join([*out, "", *(f"({n}) {why}" for why, n in numbered.items())]) + "\n"


def read(path=TESTS / "verify" / "hard.csv"):
    with open(path) as f:
        return list(csv.DictReader(line for line in f if line[0] != "#"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=TESTS.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--out", default=TESTS.parent / "build" / "verify", type=pathlib.Path)
    parser.add_argument("--form", choices=("short", "long"), default="long")
    parser.add_argument("--cases", default="", help="names, by commas")
    parser.add_argument("--methods", default="", help="names, by commas")
    parser.add_argument("--add", action="store_true", help="keep what hard.csv in --out has of other cases and methods")
    parser.add_argument("--criteria", metavar="FILE", help="write the criteria to FILE and stop")
    parser.add_argument("--table", action="store_true", help="print the table of the Howto and stop")
    args = parser.parse_args()
    if args.criteria:
        return write_criteria(args.criteria)
    if args.table:
        return print(table(read()), end="")
    out = args.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    rows, wrong, ran = [], [], []
    if args.add and (out / "hard.csv").exists():
        rows = [[r[k] for k in COLUMNS] for r in read(out / "hard.csv")]
    for case in cases():
        if args.cases and case.name not in args.cases.split(","):
            continue
        for method in case.methods if args.form == "long" else case.short:
            if args.methods and method not in args.methods.split(","):
                continue
            folder = out / "hard" / f"{case.name}-{method.replace(' ', '-')}"
            folder.mkdir(parents=True, exist_ok=True)
            o = run(case, method, executor(args.lmp, folder), folder)
            rows = [r for r in rows if r[:2] != [case.name, method]] + [as_row(case, o)]
            if unexpected(case, o):
                wrong.append(f"{case.name}, {method}: {unexpected(case, o)}")
            ran.append(dict(zip(COLUMNS, rows[-1])))
            print(" | ".join(rows[-1]), flush=True)
            with open(out / "hard.csv", "w", newline="") as f:
                f.write("# python3 tests/verify/hard.py --form long\n")
                w = csv.writer(f, lineterminator="\n")
                w.writerow(COLUMNS), w.writerows(rows)
    print("\n".join(ranges(ran)))
    print("\n".join(wrong) or "all as it is said", f"\n{out}/hard.csv", sep="")
    if wrong:
        sys.exit(1)


if __name__ == "__main__":
    main()
