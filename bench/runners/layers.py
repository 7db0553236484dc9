# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Shocks through layered bodies (examples/layered-shock) against the exact wave pattern (tests/reference/fronts.py).

Errors: L1 of u, p, rho in percent of the range, mean over the particles. Settings: n per unit length, and the input's variables:
dissipation, alpha_rho, eta (named h here), kernel, hvar, a, b, gap; C is the step in units of spacing over closing speed.
"""

import numpy as np
import yaml

from . import ROOT, answer, merged

from hard import Stopped, executor
from reference import fronts, layers, measures

VARIABLES = ("n", "dissipation", "alpha_rho", "kernel", "hvar", "a", "b", "gap")
SETTINGS = {"h", "C", *VARIABLES}


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = merged(case, settings, SETTINGS)
    which = case["scene"]
    words = {k: s[k] for k in VARIABLES if k in s}
    words.update({"case": which, "out": folder}, **({"eta": s["h"]} if "h" in s else {}), **({"dt": s["C"] / s["n"]} if "C" in s else {}))
    try:
        executor(lmp, folder)(ROOT / "examples" / "layered-shock" / "in.layers", nranks=ranks, vars=words, timeout=timeout)
    except Stopped as why:
        return answer(folder, round(1.1 * s["n"]), {}, failed=str(why))
    result = yaml.safe_load((folder / "result.yaml").read_text())
    x, u, p, rho, ratio, _ = np.loadtxt(folder / "profile.dat").T
    unit = 1.0 if which == "test" else 1000.0  # of the real materials: kg/m^3
    p, rho = p / unit, rho / unit
    pattern = fronts.Tracking(layers.CASES[which](gap=s.get("gap", 0.0)), result["time"] * (1 + 1e-12), 0.006)
    error = measures.l1(rho / ratio / s["n"], x, (u, p, rho), pattern, result["time"])
    top = pattern.at(result["time"], np.linspace(0, np.sum(rho / ratio) / s["n"], 4000))[2].max()
    return answer(folder, result["particles"], dict(zip(("L1 u", "L1 p", "L1 rho"), 100 * np.array(error))),
                  {"peak_percent_off": 100 * (p.max() / top - 1)}, abs(result["energy_ratio"] - 1), float(result["momentum_error"]))
