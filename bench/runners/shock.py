# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Standard shocks of tests/lib/shock_scenes.py: gas, fluid flyer plates. Errors: L1 over space in percent of the range, by element.

Of a method: words (of pair_style hvi/sph), or stock: sph (LAMMPS's package SPH), ulsph, tlsph (its package MACHDYN).
Settings: n, kernel, h (in spacings), variable (h follows the density), C (of fix hvi/dt), skin (in units of h), octant (of a ball, between mirrors).
"""

from . import Cannot, answer, machdyn, merged

import shock_runs
from lammps_runs import executor
from shock_scenes import CASES

WORDS = {"kernel": "kernel", "C": "courant", "skin": "skin", "variable": "variable", "h": "eta", "octant": "mirrors"}
SETTINGS = {"n", "words", "stock", *WORDS, *machdyn.SETTINGS}


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = merged(case, settings, SETTINGS)
    scene, stock = CASES[case["scene"]], s.get("stock")
    if stock in ("ulsph", "tlsph"):
        call = executor(lmp, folder)
        return machdyn.shock(scene, s, folder, lambda text: call(text, nranks=ranks, timeout=timeout))
    if stock and (why := shock_runs.cannot(scene, "stock")):
        raise Cannot(why)
    how = {} if stock else dict(words=s["words"], **{word: s[name] for name, word in WORDS.items() if name in s})
    out = shock_runs.run(scene, "stock" if stock else "riemann", s["n"], lmp, folder, ranks, timeout, **how)
    errors = {f"L1 {k}": 100 * v for k, v in out.l1.items()}
    numbers = {f"{k}_percent_off": 100 * v for k, v in out.numbers.items()}
    return answer(folder, out.particles, errors, numbers, out.energy, out.momentum, out.error)
