"""Exact states of solids, long form: python3 tests/verify/states.py --lmp build/lmp --out FOLDER writes a table, states.md; a part of `make verify`.

Flyers of elastic, perfectly plastic plates and the hypoelastic piston (tests/lib/state_scenes.py, which says where is measured) with two kernels,
h constant and variable: errors in percent of the exact states (tests/reference/elastic_plastic.py). Of asymmetric impacts the flyer comes
first, the target second. Bold is what misses its bound on the plateau. --words "dissipation riemann" or others for another pair style.
"""

import argparse
import os
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
from state_scenes import CASES, run_case  # noqa: E402

KERNELS = [("wendland2", 1.6, False), ("wendland2", 1.6, True), ("cubic", 1.2, False), ("cubic", 1.2, True)]
UNEVEN = dict(n=96, across=5, jitter=0.05)  # disorder in the lattice, which columns of one particle cannot have
BOUND, PISTON_BOUND = dict(sigma_x=0.3, rho=0.3, u=0.3, Us=0.3), dict(sigma_x=0.3, rho=0.3, u=0.3, Us=0.5, precursor=0.5)  # %
HEAD = ["case", "kernel", "h", "side", "sigma_x", "rho", "u", "e", "number", "Us", "precursor", "scatter sigma_x",
        "near sigma_x", "near rho", "contact sigma_x", "contact rho", "contact e", "seconds"]


def rows(exe, case, kernel, h, variable, **how):
    """of the table"""
    out = run_case(exe, case, kernel=kernel, h=h, variable=variable, **how)
    one = CASES[case][0] == CASES[case][1] and "jitter" not in how  # symmetric: both sides are the same
    for side in ("target",) if one else ("flyer", "target"):
        q = out[side]
        errors = [*q["plateau"].values(), q["number"], q["Us"], q["precursor"], q["scatter"]["sigma"], q["near"]["sigma"], q["near"]["rho"],
                  *(q["contact"][f] for f in ("sigma", "rho", "e"))]
        yield [case + (", uneven" if "jitter" in how else ""), f"{kernel} {h}", "variable" if variable else "constant", "both" if one else side,
               *("" if e != e else f"{100 * e:.3f}" for e in errors), f"{out['seconds']:.1f}"]


def worst(table):
    """of all rows with even plates, the largest error of each column on the plateau"""
    k = [HEAD.index(c) for c in ("sigma_x", "rho", "u", "e", "number", "Us", "precursor")]
    even = [r for r in table if "uneven" not in r[0]]
    return ", ".join(f"{HEAD[c]} {max(abs(float(r[c] or 0)) for r in even):.3f}" for c in k)


def marked(row):
    """with what misses its bound in bold"""
    bound = PISTON_BOUND if row[0].startswith("piston") else BOUND
    return "| " + " | ".join(f"**{v}**" if k in bound and v and abs(float(v)) > bound[k] else v for k, v in zip(HEAD, row)) + " |"


if __name__ == "__main__":
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=TESTS.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--out", default="verify-states", type=pathlib.Path)
    a.add_argument("--words", default="viscosity 1 2", help="of the pair style")
    a.add_argument("--cases", default=",".join(CASES), help="some of the cases")
    a.add_argument("--kernels", default="", help="some of wendland2, cubic")
    a.add_argument("--layers", type=int, help="of each plate")
    a.add_argument("--uneven", default="al-al-5000", help="cases with an uneven lattice, too; 'none' for no such")
    a.add_argument("--jobs", default=os.cpu_count(), type=int, help="runs at a time")
    o = a.parse_args()
    o.out.mkdir(parents=True, exist_ok=True)
    kernels = [k for k in KERNELS if not o.kernels or k[0] in o.kernels.split(",")]
    more = {"n": o.layers} if o.layers else {}
    todo = [(c, k, more) for k in kernels for c in o.cases.split(",")]
    todo += [(c, k, UNEVEN) for k in kernels for c in o.uneven.split(",") if c in CASES]
    print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|", flush=True)
    table = []
    with ThreadPoolExecutor(o.jobs) as pool:
        for part in pool.map(lambda q: list(rows(o.lmp, q[0], *q[1], words=o.words, **q[2])), todo):
            for row in part:
                print(marked(row), flush=True)
            table += part
    text = [f"# Exact states of solids\n\n`{o.words}`; errors in %, largest on plateaus: {worst(table)}\n"]
    text += ["| " + " | ".join(HEAD) + " |", "|---" * len(HEAD) + "|"] + [marked(r) for r in table]
    (o.out / "states.md").write_text("\n".join(text) + "\n")
    print("largest on plateaus: " + worst(table))
    for kernel, h, variable in kernels:
        print(f"of these {kernel} {h}, h {'variable' if variable else 'constant'}: "
              + worst([r for r in table if r[1:3] == [f"{kernel} {h}", "variable" if variable else "constant"]]))
    contact = [float(r[HEAD.index("contact sigma_x")]) for r in table]
    print(f"stress at contacts: {min(contact):.1f} to {max(contact):.1f}")
