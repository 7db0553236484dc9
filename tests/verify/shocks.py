#!/usr/bin/env python3
"""Standard shocks against exact solutions: tables and pictures. The scenes are in shock_scenes.py, the runner in shock_runs.py.

    python3 tests/verify/shocks.py --out build/verify      all methods, the resolutions of the long form: report.md, shocks.csv, pictures
    python3 tests/verify/shocks.py --bounds FILE           the bounds, without running anything
    python3 tests/verify/shocks.py --table                 doc/src/tables/shocks.inc from tests/verify/shocks.csv
"""

import argparse
import csv
import pathlib
import sys
import time

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
from shock_runs import cannot, known, measure, run  # noqa: E402
from shock_scenes import ALL, CASES, COURANT, ENERGY, ETA, FIELDS, KERNEL, METHODS, MOMENTUM, ORDER, SYMMETRY  # noqa: E402


def table_of_bounds(path):
    with open(path, "w", newline="") as f:
        f.write("# python3 tests/verify/shocks.py --bounds: written down before the first run; L1 relative to the range, order, numbers relative\n")
        out = csv.writer(f, lineterminator="\n")
        out.writerow(["case", "n", *(f"l1_{k}" for k in FIELDS), *(f"order_{k}" for k in FIELDS), "energy", "momentum", "symmetry", "numbers"])
        for c in ALL:
            b = c.bounds()
            out.writerow([c.name, c.bound_n, *(f"{b[k]:.4g}" if k in b else "" for k in FIELDS),
                          *(ORDER[k] if k in b else "" for k in FIELDS), ENERGY, MOMENTUM, SYMMETRY,
                          " ".join(f"{k}:{v}" for k, v in getattr(c, "number_bounds", {}).items())])


COLUMNS = ["case", "method", "n", "particles", "steps", "seconds", *(f"l1_{f}" for f in FIELDS), *(f"order_{f}" for f in FIELDS), "energy",
           "momentum", "symmetry", "numbers", "missed", "error"]


def missed(case, o, order=None):
    """names of the bounds that an outcome does not meet; order: {field: number} towards it from a coarser run"""
    if o.error:
        return ["run"]
    bounds = case.bounds(o.n)
    out = [f"l1_{f}" for f in o.l1 if not o.l1[f] <= bounds[f]]
    out += [f"order_{f}" for f, q in (order or {}).items() if not q >= ORDER[f]]
    out += [k for k, v in getattr(case, "number_bounds", {}).items() if not abs(o.numbers[k]) <= v]
    out += ["energy"] if not o.energy <= ENERGY else []
    out += ["momentum"] if not o.momentum <= MOMENTUM else []
    # stock's strip has no mirror image to round-off where it rings, and what it does to unlike types is undefined (Howto_sph)
    out += ["symmetry"] if case.scene(o.n).mirror and not o.symmetry <= SYMMETRY else []
    return out


def order_of(coarse, fine_):
    return {f: np.log(coarse.l1[f] / fine_.l1[f]) / np.log(fine_.n / coarse.n) for f in fine_.l1 if f in coarse.l1}


def as_row(case, o, order):
    cell = lambda d, f, form: format(d[f], form) if f in d else ""  # noqa: E731
    return [o.case, o.method, o.n, o.particles, o.steps, f"{o.seconds:.2f}", *(cell(o.l1, f, ".4g") for f in FIELDS),
            *(cell(order, f, ".2f") for f in FIELDS), f"{o.energy:.2g}", f"{o.momentum:.2g}", f"{o.symmetry:.2g}",
            " ".join(f"{k}:{v:.2g}" for k, v in o.numbers.items()), " ".join(missed(case, o, order)), o.error]


def seen(o):
    """what pictures show of density and pressure: the densest particle; the median of density where the exact one is largest; by how much pressure
    falls below that on both sides of a contact, in the inner two thirds between the waves next to it, %"""
    _, exact, got, inside = o.picture
    rho, p = exact[0], exact[2]
    out = f"densest {got[0][inside].max():.4g}, plateau {np.median(got[0][inside & (rho > 0.99 * rho[inside].max())]):.4g}"
    same = np.abs(np.diff(p)) < 1e-6 * p[1:]
    found = np.flatnonzero(same & (np.abs(np.diff(rho)) > 0.01 * rho[1:]) & inside[1:] & inside[:-1])
    if CASES[o.case].dim > 1 or len(found) != 1:
        return out
    waves = np.flatnonzero(~same)
    left, right = waves[waves < found[0]].max(initial=0) + 1, waves[waves > found[0]].min(initial=len(p) - 1)
    near = slice(found[0] + 1 - (2 * (found[0] + 1 - left)) // 3, found[0] + 1 + (2 * (right - found[0])) // 3)
    return f"{out}, dip {100 * (1 - (got[2][near] / p[near]).min(initial=np.inf)):.3g}"


def picture(case, outcomes, path):
    """profiles of the finest run of every method beside the exact solution"""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    shown = [o for o in outcomes if o.picture]
    if not shown:
        return
    there, true = case.line()
    figure, axes = plt.subplots(len(shown), 3, figsize=(15, 3.2 * len(shown)), squeeze=False)
    for line, o in zip(axes, shown):
        x, exact, got, inside = o.picture
        k = np.argsort(x)
        k = k[inside[k]]
        for a, e, g, f in zip(line, true, got, FIELDS):
            a.plot(x[k], g[k], ".", ms=2.5, color="tab:red")
            a.plot(there, e, "k-", lw=0.9)
            a.set_title(f"{o.method}, n = {o.n}: {f}" + (f", L1 {100 * o.l1[f]:.2f} %" if f in o.l1 else ""), fontsize=9)
            scale, lo, hi = np.ptp(e) or 1, e.min(), e.max()
            a.set_ylim(max(min(g[k].min(), lo), lo - 0.6 * scale) - 0.05 * scale, min(max(g[k].max(), hi), hi + 0.6 * scale) + 0.05 * scale)
    figure.suptitle(case.name)
    figure.tight_layout()
    figure.savefig(path, dpi=70)
    plt.close(figure)


def report(rows, path, head):
    """the table of the issue: problem, resolution, error, order, time; stock's error and time"""
    by = {(r[0], r[1], int(r[2])): dict(zip(COLUMNS, r)) for r in rows}
    triple = lambda r, what: " / ".join(r[f"{what}_{f}"] or "-" for f in FIELDS)  # noqa: E731
    percent = lambda r: " / ".join(f"{100 * float(r[f'l1_{f}']):.2f}" if r[f"l1_{f}"] else "-" for f in FIELDS)  # noqa: E731
    with open(path, "w") as f:
        f.write(head + "\n\nErrors: L1 of rho / u / p, percent of the range; order from the next coarser n; energy: largest drift of the total; "
                "stock: error, time.\n\n| problem | method | n | error % | bound % | order | energy | momentum | symmetry | numbers | steps | "
                "time s | missed | stock error % | stock s |\n|" + 15 * "---|" + "\n")
        for (name, method, n), r in by.items():
            if method == "stock":
                continue
            b = CASES[name].bounds(n)
            s = by.get((name, "stock", n))
            theirs = (s["error"][:40] or percent(s), s["seconds"]) if s else (cannot(CASES[name], "stock") and "cannot", "")
            f.write(f"| {name} | {method} | {n} | {r['error'] or percent(r)} | {' / '.join(f'{100 * b[q]:.2f}' if q in b else '-' for q in FIELDS)} | "
                    f"{triple(r, 'order')} | {r['energy']} | {r['momentum']} | {r['symmetry']} | {r['numbers']} | {r['steps']} | {r['seconds']} | "
                    f"{r['missed']} | {theirs[0]} | {theirs[1]} |\n")


SHOWN = {"sod": "a", "sod-spacing": "a", "blast-left": "a b", "blast-right": "a b", "sjoegreen": "a", "woodward-colella": "a", "noh-1d": "",
         "noh-2d": "c", "noh-3d": "c", "sedov-2d": "d", "sedov-3d": "d", "interface-10": "", "interface-100": "", "sound": "e", "al-al-1000": "",
         "al-al-5000": "", "al-al-10000": "", "al-cu-5750": ""}


def table(path=TESTS / "verify" / "shocks.csv"):
    """reST: the finest n of monaghan, riemann and stock: error, order, time; what misses its bound in brackets"""
    with open(path) as f:
        rows = {(r["case"], r["method"], int(r["n"])): r for r in csv.DictReader(line for line in f if line[0] != "#")}
    body = []
    for name, why in SHOWN.items():
        n = max(k for c, _, k in rows if c == name)
        cells = [name, str(n)]
        for method in ("monaghan", "riemann", "stock"):
            r = rows.get((name, method, n))
            if not r or r["error"]:
                cells += ["stops" if r else "cannot", "", ""]
                continue
            lost = r["missed"].split()
            show = lambda what, number: f"({number})" if what in lost else number  # noqa: E731
            error = [show(f"l1_{f}", f"{100 * float(r[f'l1_{f}']):.2f}") if r[f"l1_{f}"] else "\\-" for f in FIELDS]
            order = [show(f"order_{f}", f"{round(float(r[f'order_{f}']), 1) + 0.0:.1f}") if r[f"order_{f}"] else "\\-" for f in FIELDS]
            cells += [" ".join(error), " ".join(order), f"{float(r['seconds']):.1f}"]
        body.append([*cells, why])
    head = [["problem", "n", "monaghan", "", "", "riemann", "", "", "stock", "", "", "missed"], ["", "", *["error %", "order", "s"] * 3, ""]]
    width = [max(len(r[k]) for r in head + body) for k in range(12)]
    spans = ((0, 0), (1, 1), (2, 4), (5, 7), (8, 10), (11, 11))
    line = lambda r: " ".join(c.ljust(w) for c, w in zip(r, width)).rstrip()  # noqa: E731
    rule = " ".join("=" * w for w in width)
    joined = " ".join("-" * (sum(width[a:b + 1]) + b - a) for a, b in spans)
    # an empty first cell would go on with the line above
    return "\n".join([rule, line(head[0]), joined, line(["\\", *head[1][1:]]), rule, *(line(r) for r in body), rule]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=str(TESTS.parent / "build" / "lmp"))
    parser.add_argument("--out", default=str(TESTS.parent / "build" / "verify"))
    parser.add_argument("--ranks", type=int, default=1, help="of the scenes in two and three dimensions")
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--form", choices=("short", "long"), default="long")
    parser.add_argument("--add", action="store_true", help="keep what shocks.csv in --out has of other cases and methods")
    parser.add_argument("--again", action="store_true", help="run nothing, measure what is in --out")
    parser.add_argument("--timeout", type=float, default=1800)
    parser.add_argument("--bounds", metavar="FILE", help="write the bounds to FILE and stop")
    parser.add_argument("--table", action="store_true", help="print the table of the Howto and stop")
    args = parser.parse_args()
    if args.table:
        return print(table(), end="")
    if args.bounds:
        return table_of_bounds(args.bounds)
    out = pathlib.Path(args.out).resolve()
    out.mkdir(parents=True, exist_ok=True)
    methods = [m for m in args.methods.split(",") if args.again or known(args.lmp, m, out / "runs")]
    for m in set(args.methods.split(",")) - set(methods):
        print(f"{m}: this LAMMPS does not know 'pair_style hvi/sph {KERNEL} {METHODS[m]}': left out")
    names = args.cases.split(",")
    rows = []
    if args.add and (out / "shocks.csv").exists():
        with open(out / "shocks.csv") as f:
            rows = [r for r in csv.reader(line for line in f if line[0] != "#")][1:]
        rows = [r for r in rows if not (r[0] in names and r[1] in methods)]
    start = time.strftime("%Y-%m-%d")
    head = f"# python3 tests/verify/shocks.py --form {args.form}; {start}; kernel {KERNEL}, h {ETA} spacings, fix hvi/dt {COURANT}"

    def save():
        rows.sort(key=lambda r: (list(CASES).index(r[0]), list(METHODS).index(r[1]), int(r[2])))
        with open(out / "shocks.csv", "w", newline="") as f:
            f.write(head + "\n")
            w = csv.writer(f, lineterminator="\n")
            w.writerow(COLUMNS), w.writerows(rows)
        report(rows, out / "report.md", head)

    for name in names:
        case, finest = CASES[name], []
        for m in methods:
            if cannot(case, m):
                continue
            last = None
            for n in getattr(case, args.form):
                ranks = args.ranks if case.dim > 1 else 1
                folder = out / "runs" / f"{name}-{m}-{n}"
                o = measure(case, m, n, folder) if args.again else run(case, m, n, args.lmp, folder, ranks, args.timeout)
                order = order_of(last, o) if last else {}
                rows.append(as_row(case, o, order))
                print(" ".join(str(a) for a in rows[-1]), flush=True)
                if o.picture:
                    print(f"  {seen(o)}", flush=True)
                last = o if not o.error else last
            if last:
                finest.append(last)
        save()
        picture(case, finest, out / f"{name}.png")
    print(f"{out}/report.md, shocks.csv, pictures")


if __name__ == "__main__":
    main()
