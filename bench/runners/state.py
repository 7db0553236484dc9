# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Flyers of elastic, perfectly plastic solids and the piston: tests/lib/state_scenes.py, against the exact states.

Errors in percent, the worse side: L1 of sigma_x, rho, u, e over the layers that the first wave has passed, in units of the jump; of the
plateaus, and of the speed of the plastic shock and its precursor.
Of a method: words (of pair_style hvi/sph), or stock: tlsph, ulsph. Settings: n (layers of a plate), kernel, h (in spacings), variable, C, skin (in
spacings), dim, gap.
"""

import numpy as np

from . import answer, machdyn, merged

from lammps_runs import Stopped, executor
from state_scenes import CASES, FIELDS, flyer

HOW = {"kernel": "kernel", "h": "h", "words": "words", "variable": "variable", "C": "courant", "skin": "skin", "dim": "dim", "gap": "gap"}
SETTINGS = {"n", "stock", *HOW, *machdyn.SETTINGS}


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = merged(case, settings, SETTINGS)
    flying, target, speed = CASES[case["scene"]]
    execute = executor(lmp, folder)
    call = lambda text: execute(text, nranks=ranks, timeout=timeout)  # noqa: E731
    if s.get("stock"):
        return machdyn.flyer(flying, target, speed, s, folder, call)
    try:
        out = flyer(call, folder, flying, target, speed, n=s["n"],
                    **{word: s[name] for name, word in HOW.items() if name in s})
    except Stopped as why:
        return answer(folder, 2 * s["n"], {}, failed=str(why))
    sides = [out["flyer"], out["target"]]
    worst = lambda values: 100 * np.abs(values).max()  # noqa: E731
    errors = {f"L1 {f}": worst([q["l1"][f] for q in sides]) for f in FIELDS}
    errors.update({f"plateau {f}": worst([q["plateau"][f] for q in sides]) for f in FIELDS})
    errors["speed of the shock"] = worst([q["Us"] for q in sides])
    first, last = sides[1]["exact"][0], sides[1]["exact"][-1]
    if 0.1 * last.u < first.u < last.u:  # a smaller one is lost in the foot of the shock at these resolutions
        errors["speed of the precursor"] = worst([q["precursor"] for q in sides])
    numbers = {"contact_e_percent_off": 100 * sides[1]["contact"]["e"]}
    return answer(folder, out["particles"], errors, numbers, out["drift"], out["momentum"])
