# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Spall by a plate impact (examples/spall): pull-back of the free surface against `exact` of the case, m/s, in percent.

Of a method: words (of pair_style hvi/sph). Settings: n (particles through the flyer), kernel, h (in spacings), C, spall.
"""

from . import ROOT, answer, merged

from lammps_runs import Stopped, executor
from hvi.errors import HVIError
from hvi.jobs import measures

VARIABLES = {"n": "n", "words": "pair", "kernel": "kernel", "h": "eta", "C": "C", "spall": "spall", "solid": "solid"}
SETTINGS = set(VARIABLES)


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = merged(case, settings, SETTINGS)
    words = {"out": folder, **{word: s[name] for name, word in VARIABLES.items() if name in s}}
    try:
        executor(lmp, folder)(ROOT / "examples" / "spall" / "in.spall", nranks=ranks, vars=words, timeout=timeout)
        r = measures.measure(folder)
    except (Stopped, HVIError) as why:
        return answer(folder, 3 * s["n"], {}, failed=str(why))
    errors = {"pull-back": 100 * abs(r["pull_back_m_s"] / case["exact"] - 1)}
    numbers = {k: r[k] for k in ("pull_back_m_s", "spall_strength_GPa", "spall_plane_mm", "first_failure_us", "void_work_J_m2", "failed_particles")}
    failed = r["record"] if r["record"] != "ok" else ""
    return answer(folder, r["particles"], errors, numbers, abs(r["energy_ratio"] - 1), float(r["momentum_error"]), failed)
