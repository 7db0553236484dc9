# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What runs a case of bench/cases: one module each, with

run(case, settings, folder, lmp, ranks=1, timeout=600) -> dict
    case: the case file; settings: method, resolution and what is varied; folder: an empty pathlib.Path to work in; lmp: the program
    particles, steps: int; loop_s: LAMMPS's loop times (s of wall, all runs of it); errors, numbers: {name: number};
    ledger: {"energy": largest |E/E0 - 1|, "momentum": relative}; failed: "" or what went wrong
A method that cannot do a case raises Cannot. answer() makes the dict from a folder with LAMMPS's logs.
SETTINGS of a module: names that it knows, for methods, base and runs.
"""

import os
import pathlib
import re
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
for folder in (ROOT / "python", ROOT / "tests", ROOT / "tests" / "lib"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

os.environ.setdefault("LAMMPS_POTENTIALS", str(ROOT / "potentials"))

OFF = 0.05  # a run whose energy is off by more has failed, whatever its error


class Cannot(Exception):
    """the method has no such law, dimension or boundary; str: why"""


def merged(case, settings, known):
    """the case's base, the method's settings, then those of the run"""
    method = settings["method"]
    if method not in case["methods"]:
        raise ValueError(f"{case['title']}: there is no method {method}")
    whole = {**case.get("base", {}), **(case["methods"][method] or {}), **settings}
    if unknown := set(whole) - known - {"method", "ranks", "cannot"}:
        raise ValueError(f"{case['title']}: runner {case['runner']} has no setting {', '.join(sorted(unknown))}")
    if "cannot" in whole:
        raise Cannot(whole["cannot"])
    return whole


def logs(folder):
    """text of all logs of LAMMPS in a folder"""
    return [path.read_text(errors="replace") for path in sorted(pathlib.Path(folder).glob("log*"))]


def loop_s(folder):
    """LAMMPS's loop times, summed over runs and logs, seconds of wall"""
    return sum(float(t) for text in logs(folder) for t in re.findall(r"^Loop time of (\S+) on", text, re.M))


def steps(folder):
    """of all runs and logs"""
    return sum(int(n) for text in logs(folder) for n in re.findall(r"^Loop time of \S+ on \d+ procs for (\d+) steps", text, re.M))


def answer(folder, particles, errors, numbers=None, energy=None, momentum=None, failed=""):
    """what a runner returns; numbers that are not finite, or an energy that is off, are failures"""
    errors, numbers = ({k: float(v) for k, v in (d or {}).items()} for d in (errors, numbers))
    ledger = {k: float(v) for k, v in (("energy", energy), ("momentum", momentum)) if v is not None and np.isfinite(v)}
    if not failed and not all(np.isfinite(list(errors.values()))):
        failed = "not finite"
    if not failed and energy is not None and not np.isfinite(energy):
        failed = "energy is no number"
    if not failed and ledger.get("energy", 0.0) > OFF:
        failed = f"energy off by {100 * ledger['energy']:.0f} %"
    return {"particles": int(particles), "steps": steps(folder), "loop_s": loop_s(folder),
            "errors": {k: v for k, v in errors.items() if np.isfinite(v)}, "numbers": {k: v for k, v in numbers.items() if np.isfinite(v)},
            "ledger": ledger, "failed": failed}
