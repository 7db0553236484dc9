# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Shocks through layered bodies (examples/layered-shock) against the exact wave pattern (tests/reference/fronts.py).

Errors: L1 of u, p, rho in percent of the range, mean over the particles. Settings: n per unit length; dissipation none, paper (coefficient alpha_rho),
auto or riemann, and a, b of the viscosity; h in spacings; hvar yes or no; kernel; gap; C is the step in units of spacing over closing speed.
"""

import sys

import numpy as np
import yaml

from . import ROOT, answer, merged

from lammps_runs import Stopped, executor
from reference import fronts, layers, measures

sys.path.insert(0, str(ROOT / "examples" / "layered-shock"))
from laminates import CASES

SETTINGS = {"n", "dissipation", "alpha_rho", "a", "b", "h", "hvar", "kernel", "gap", "C"}


def variables(s):
    """of the input"""
    if s["n"] % 10:
        raise ValueError(f"n must be a multiple of 10, not {s['n']}")
    alpha = {"none": 0, "paper": s.get("alpha_rho", 0.3), "auto": "auto"}
    pair = "dissipation riemann" if s["dissipation"] == "riemann" else f"viscosity {s.get('a', 1)} {s.get('b', 2)} interface {alpha[s['dissipation']]}"
    words = {"n": s["n"], "pair": pair, **{k: s[k] for k in ("kernel", "gap") if k in s}}
    if "hvar" in s:
        words["hvar"] = {"yes": "variable", "no": "constant"}[s["hvar"]]
    return words | ({"eta": s["h"]} if "h" in s else {}) | ({"dt": s["C"] / s["n"]} if "C" in s else {})


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = merged(case, settings, SETTINGS)
    which = case["scene"]
    words = {**CASES[which], **variables(s), "out": folder}
    try:
        executor(lmp, folder)(ROOT / "examples" / "layered-shock" / "in.layers", nranks=ranks, vars=words, timeout=timeout)
    except Stopped as why:
        return answer(folder, round(1.1 * s["n"]), {}, failed=str(why))
    result = yaml.safe_load((folder / "result.yaml").read_text())
    x, u, p, rho, ratio, _ = np.loadtxt(folder / "profile.dat").T
    pattern = fronts.Tracking(layers.CASES[which](gap=s.get("gap", 0.0)), result["time"] * (1 + 1e-12), 0.006)
    error = measures.l1(rho / ratio / s["n"], x, (u, p, rho), pattern, result["time"])
    top = pattern.at(result["time"], np.linspace(0, np.sum(rho / ratio) / s["n"], 4000))[2].max()
    return answer(folder, result["particles"], dict(zip(("L1 u", "L1 p", "L1 rho"), 100 * np.array(error))),
                  {"peak_percent_off": 100 * (p.max() / top - 1)}, abs(result["energy_ratio"] - 1), float(result["momentum_error"]))
