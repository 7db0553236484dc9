#!/usr/bin/env python3
"""Compare runs of in.sod, in.noh and in.flyer with the exact solutions.

    python3 plot.py FOLDER...   one or more runs (result.yaml, profile.dat): adds l1_density, l1_u, l1_p to result.yaml, draws
                                FOLDER/profile.png
    python3 plot.py             the runs of run.sh: the same, and the figures and tables of README.md

Exact solutions: tests/reference/gas.py, impedance.py. Errors: L1 over space, by the range of the exact field, as in tests/lib/shock_scenes.py.
"""

import glob
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

here = os.path.dirname(os.path.abspath(__file__))
tests = os.path.join(os.environ.get("HVI_ROOT", os.path.join(here, "..", "..")), "tests")
sys.path[:0] = [tests, os.path.join(tests, "lib")]
import shock_scenes as scenes
from reference import impedance

METHODS = {"viscosity 1 2": "monaghan", "viscosity 1 2 interface auto": "auto", "dissipation riemann": "riemann"}  # words of the pair style
COLORS = {"monaghan": "C0", "auto": "C1", "riemann": "C3"}
NAMES = {"sod": ("density", "velocity", "pressure"), "noh": ("density", "outward velocity", "pressure"),
         "flyer": ("density, kg/m^3", "velocity, m/s", "pressure, GPa")}


class Run:
    """one run: x (of Noh the radius), got and inside by particle; line: exact x and fields; l1 by field rho, u, p"""

    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "result.yaml")) as f:
            self.result = r = yaml.safe_load(f)
        self.problem, self.n, self.dim, self.method = r["problem"], r["n"], r["dimension"], METHODS.get(r["pair"], r["pair"])
        table = np.loadtxt(os.path.join(folder, "profile.dat"))
        case, frame = getattr(self, self.problem)(r, table)
        self.case = case
        self.l1, self.x, _, self.got, self.inside = case.errors(self.n, case.scene(self.n), frame)
        self.line = case.line()
        r.update({key: float(f"{self.l1[k]:.6g}") for key, k in {"l1_density": "rho", "l1_u": "u", "l1_p": "p"}.items()})
        with open(os.path.join(folder, "result.yaml"), "w") as f:
            yaml.safe_dump(r, f, sort_keys=False)

    @staticmethod
    def sod(r, table):
        left, right = (tuple(float(a) for a in r[k]) for k in ("left", "right"))
        case = scenes.Tube("sod", left, right, r["time"], (), (), equal=r["masses"] == "equal", at=r["n"])
        return case, frame_of(table[np.argsort(table[:, 0])])

    @staticmethod
    def noh(r, table):
        case = scenes.NohRow((0,), ()) if r["dimension"] == 1 else scenes.NohBall(r["dimension"], (), (), at=r["n"])
        case.times, case.window = [r["time"]], 0.6 * r["time"] if r["dimension"] > 1 else (0.0, 0.6 * r["time"])
        x = table[:, 4:7]
        k = np.lexsort(x.T[::-1])
        frame = dict(x=x[k], v=(table[:, 1] / table[:, 0])[k, None] * x[k], rho=table[k, 2], p=table[k, 3])
        return case, frame

    @staticmethod
    def flyer(r, table):
        """of like plates the case is in the frame of the contact"""
        class Plates(scenes.Plates):
            length = 1e-3 * r["thickness_mm"]

        case = Plates("flyer", *(impedance.Metal(*(float(b) for b in r[f"Hugoniot_{a}"])) for a in ("flyer", "target")), float(r["v0_m_s"]), (r["n"],), ())
        frame = frame_of(table[np.argsort(table[:, 0])])
        frame["v"][:, 0] += case.solution.shift
        frame["x"][:, 0] += case.solution.shift * 1e-6 * r["time_us"]
        return case, frame

    def fields(self):
        """x, got of the particles in the window, in order; exact x, fields; for pictures, in the frame of the input"""
        k = np.argsort(self.x)
        k = k[self.inside[k]]
        x, got, (there, exact) = self.x[k], self.got[:, k].copy(), self.line
        if self.problem == "flyer":
            shift, exact = self.case.solution.shift, exact.copy()
            x, there = 1e3 * (x - shift * self.case.times[-1]), 1e3 * (there - shift * self.case.times[-1])
            for a in (got, exact):
                a[1] -= shift
                a[2] *= 1e-9
        return x, got, there, exact

    def label(self):
        return f"{self.method}, n = {self.n}"


def frame_of(table):
    x, v = np.zeros((2, len(table), 3))
    x[:, 0], v[:, 0] = table[:, 0], table[:, 1]
    return dict(x=x, v=v, rho=table[:, 2], p=table[:, 3])


def draw(axes, runs, l1=True):
    """rho, u, p of runs of one problem over the exact solution"""
    there, exact = runs[0].fields()[2:]
    for ax, k, name in zip(axes, range(3), NAMES[runs[0].problem]):
        ax.plot(there, exact[k], "k-", lw=0.9, label="exact")
        for run in runs:
            x, got, *_ = run.fields()
            ax.plot(x, got[k], ".", ms=3, color=COLORS.get(run.method), label=run.label() + (f": {100 * list(run.l1.values())[k]:.2f} %" if l1 else ""))
        ax.set_title(name, fontsize=10)
        ax.legend(fontsize=7)


def save(figure, name):
    figure.tight_layout()
    figure.savefig(name, dpi=90)
    plt.close(figure)


def single(run):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4))
    draw(axes, [run])
    save(figure, os.path.join(run.folder, "profile.png"))


def gases(runs):
    rows = [[runs[f"sod-{d}-400"] for d in COLORS], [runs["blast-monaghan-400"], runs["blast-riemann-400"]]]
    figure, axes = plt.subplots(2, 3, figsize=(15, 8))
    for line, several, title in zip(axes, rows, ("Sod", "blast")):
        draw(line, several)
        line[0].set_ylabel(title)
        for ax in line:
            ax.set_xlabel("x")
    save(figure, "sod.png")


def noh(runs):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.2))
    for ax, several in zip(axes, ([f"noh1-{d}-400" for d in COLORS], [f"noh2-{d}-50" for d in COLORS], [f"noh3-{d}-14" for d in COLORS])):
        several = [runs[name] for name in several]
        there, exact = several[0].fields()[2:]
        ax.plot(there, exact[0], "k-", lw=0.9, label="exact")
        for run in several:
            x, got, *_ = run.fields()
            ax.plot(x, got[0], ".", ms=3 if run.dim < 3 else 1.5, color=COLORS.get(run.method), label=f"{run.label()}: {100 * run.l1['rho']:.1f} %")
        ax.set_title(f"density, {several[0].dim}D, t = 0.6")
        ax.set_xlabel("r")
        ax.legend(fontsize=7)
    save(figure, "noh.png")


def flyer(runs):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.2))
    several = [runs[f"flyer-{d}-200"] for d in COLORS]
    there, exact = several[0].fields()[2:]
    for ax, zoom in zip(axes, (False, True)):
        ax.plot(there, exact[2], "k-", lw=0.9, label="exact")
        for run in several:
            x, got, *_ = run.fields()
            ax.plot(x, got[2], ".", ms=3, color=COLORS.get(run.method), label=run.label())
        ax.set_title("pressure, GPa, Al on Al, 5 km/s" + (", enlarged" if zoom else ""), fontsize=10)
        ax.set_xlabel("x, mm")
        if zoom:
            ax.set_ylim(0.97 * exact[2].max(), 1.03 * exact[2].max())
    axes[0].legend(fontsize=7)
    for d in COLORS:
        chain = sorted((r for name, r in runs.items() if name.startswith(f"flyer-{d}-v") or name == f"flyer-{d}-200"), key=lambda r: r.result["v0_m_s"])
        axes[2].plot([1e-3 * r.result["v0_m_s"] for r in chain], [100 * float(r.result["pressure_error"]) for r in chain], "o-", ms=4, color=COLORS[d], label=d)
    axes[2].set_title("error of the pressure on the plateau, %, Al on Al, n = 200", fontsize=10)
    axes[2].set_xlabel("v0, km/s")
    axes[2].axhline(0, color="k", lw=0.6)
    axes[2].legend(fontsize=7)
    save(figure, "flyer.png")


def table(runs):
    print("| run | L1(rho) % | L1(u) % | L1(p) % | order | energy - 1 | momentum error | steps | time s |\n|" + 9 * "---|")
    last = None
    for name, run in runs.items():
        r, kind, orders = run.result, name.removesuffix(f"-{run.n}"), ""
        if last and last[0] == kind:
            orders = ", ".join("%.2f" % (np.log(last[1].l1[k] / run.l1[k]) / np.log(run.n / last[1].n)) for k in run.l1)
        print("| %s | %s | %s | %.1e | %s | %d | %.2f |" % (name, " | ".join("%.2f" % (100 * a) for a in run.l1.values()), orders,
                                                        r["energy_ratio"] - 1, r["momentum_error"], r["steps"], r["wall_s"]))
        last = kind, run
    print("\n| v0 m/s | dissipation | P GPa | exact | error of P % | of rho % | of u % | of Us % | largest of these three |\n|" + 9 * "---|")
    for name, run in sorted(runs.items(), key=lambda a: a[1].result.get("v0_m_s", 0)):
        r = run.result
        if run.problem == "flyer" and run.n == 200:
            error = {k: 100 * float(r[f"{k}_error"]) for k in ("pressure", "density", "velocity", "shock_speed")}
            print("| %g%s | %s | %.3f | %.3f | %s |" % (r["v0_m_s"], "" if r["target"] == r["flyer"] else f", {r['flyer']} on {r['target']}".replace(".hvi", ""), run.method,
                  1e-9 * r["pressure_Pa"], 1e-9 * r["pressure_exact_Pa"], " | ".join("%.3f" % e for e in (*error.values(), max(list(error.values())[1:], key=abs)))))
    print("\n| largest error of P on the plateaus of aluminum plates, % | dissipation |\n|---|---|")
    for d in COLORS:
        of = [abs(100 * float(r.result["pressure_error"])) for name, r in runs.items() if r.problem == "flyer" and r.n == 200 and r.method == d and r.result["target"] == r.result["flyer"]]
        if of:
            print(f"| {max(of):.3f} | {d} |")
    print("\n| run | density behind the shock | exact |\n|---|---|---|")
    for name, run in runs.items():
        if name.startswith(("blast", "noh")):
            print("| %s | %.3f | %.3f |" % (name, *behind(run)))


def behind(run):
    """mean density of the particles in the middle half of the densest plateau of the exact solution, and the exact one"""
    x, got, there, exact = run.fields()
    plateau = there[exact[0] > (1 - 1e-6) * exact[0].max()]
    middle, half = 0.5 * (plateau.min() + plateau.max()), 0.25 * np.ptp(plateau)
    return got[0, np.abs(x - middle) < half].mean(), exact[0].max()


def main():
    folders = sys.argv[1:] or glob.glob("runs/*")
    folders = [f for f in folders if os.path.exists(os.path.join(f, "result.yaml"))]
    if not folders:
        sys.exit("no runs: sh run.sh first, see README.md")
    runs = {os.path.basename(os.path.normpath(f)): Run(f) for f in folders}
    runs = dict(sorted(runs.items(), key=lambda a: (a[0].removesuffix(f"-{a[1].n}"), a[1].n)))
    if sys.argv[1:]:
        for run in runs.values():
            single(run)
    else:
        gases(runs), noh(runs), flyer(runs)
    table(runs)


if __name__ == "__main__":
    main()
