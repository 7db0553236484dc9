#!/usr/bin/env python3
"""Compare runs of in.layers with the exact solution: python3 plot.py [runs] -> figures beside it, tables for README.md.

    python3 plot.py FOLDER...   one or more runs (result.yaml, profile.dat, gauges.dat): adds l1_u, l1_p, l1_density and
                                crossings to result.yaml, draws FOLDER/profile.png and FOLDER/gauges.png
    python3 plot.py             the runs of run.sh: the same, and all figures and tables

The exact solution is tests/reference/fronts.py (front tracking). Errors: tests/reference/measures.py, by = "element".
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
sys.path.insert(0, here)
sys.path.insert(0, os.path.join(os.environ.get("HVI_ROOT", os.path.join(here, "..", "..")), "tests"))
from laminates import CASES, case_of
from reference import fronts, layers, measures

GAUGES = "ABC"
COLORS = {"none": "C0", "0.3": "C2", "0.8": "C3", "auto": "C1", "riemann": "C4"}


class Run:
    """One run with its exact solution"""

    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "result.yaml")) as f:
            self.result = r = yaml.safe_load(f)  # LAMMPS may print 1e-15, text to YAML
        r.update({k: float(r[k]) for k in ("momentum_error", "mass_error")})
        if r["n"] % 10:
            sys.exit(f"{folder}: n must be a multiple of 10, not {r['n']}: layers are a whole number of spacings then")
        self.case = case_of(r["rho"], r["Ca"])
        self.layers = layers.laminate(r["rho"], r["Ca"], r["gap"])
        self.n, self.t = r["n"], r["time"]
        self.x, self.u, self.p, self.rho, self.ratio, material = np.loadtxt(os.path.join(folder, "profile.dat")).T
        self.mass = np.array(r["rho"])[material.astype(int) - 1] / self.n
        self.gauges = np.loadtxt(os.path.join(folder, "gauges.dat"))
        self.exact = fronts.Tracking(self.layers, self.t * (1 + 1e-12), 0.003)
        self.m = np.linspace(0, self.mass.sum(), 40000)
        self.fields = self.exact.at(self.t, self.m)  # x, u, p, rho

    def judge(self):
        """L1 errors, largest pressure and particles out of order, in result.yaml too"""
        l1 = measures.l1(self.mass, self.x, (self.u, self.p, self.rho), self.exact, self.t)
        self.l1 = dict(zip(("l1_u", "l1_p", "l1_density"), map(float, l1)))
        extra = {**self.l1, "p_max_exact": self.fields[2].max()}
        self.result.update({key: float(f"{value:.6g}") for key, value in extra.items()}, crossings=int(np.sum(np.diff(self.x) <= 0.0)))
        with open(os.path.join(self.folder, "result.yaml"), "w") as f:
            yaml.safe_dump(self.result, f, sort_keys=False)

    def judge_gauges(self):
        """per gauge: worst arrival of a shock, in spacings over the wave speed; worst mean over a plateau, part of u0"""
        out = []
        t = self.gauges[:, 0]
        target = [a for a in self.layers if a.body == 1]
        for k, (m, layer) in enumerate(zip(layers.gauges(self.layers), target)):
            times, u, p = self.exact.gauge(m)
            shocks = measures.jumps(times, u)
            late = []
            for when, before, after in shocks:
                if when > self.t - 5.0 / self.n / layer.c:
                    continue  # not yet through
                j = np.searchsorted(times, when)
                tau = [layer.c**2 / (q + layer.K) for q in (p[j - 1], p[j])]
                speed = layer.rho0**-1 / np.sqrt(tau[0] * tau[1]) * layer.c  # through the mass, in spacings of the start
                late.append((measures.arrival(t, self.gauges[:, k + 1], before, after, when) - when) * self.n * speed)
            flat = []
            rest = 8.0 / self.n / layer.c  # what a shock needs to pass
            for a, b, v in measures.plateaus(times, u, self.t, 2.5 * rest):
                inside = (t > a + rest) & (t < b - rest)
                flat.append(np.mean(self.gauges[inside, k + 1]) - v)
            out.append((late, flat))
        return out

    def title(self):
        return "Test case" if self.case == "test" else self.case.replace("_", "-")

    def label(self):
        """coefficient of the density dissipation, or riemann"""
        alpha = self.result["pair"].split()[-1]
        return "none" if alpha == "0" else alpha

    def name(self):
        return "riemann" if self.label() == "riemann" else r"$\alpha_\rho$ " + self.label()


def profiles(runs, name):
    """u, p, rho/rho0 of several runs over one exact solution; below: the part behind the impact, larger"""
    fig, axes = plt.subplots(2, 3, figsize=(15, 8))
    first = runs[0]
    x, u, p, rho, material = first.fields
    rho0 = np.array([a.rho0 for a in first.layers])[material]
    for row in axes:
        for ax, field, title in zip(row, (u, p, rho / rho0), ("velocity", "pressure", "density / initial density")):
            ax.plot(x, field, "k-", lw=0.9, label="exact")
            ax.set_title(title)
            ax.set_xlabel("x")
        for run in runs:
            for ax, field in zip(row, (run.u, run.p, run.ratio)):
                ax.plot(run.x, field, ".", ms=3, color=COLORS.get(run.label(), "C5"), label=run.name())
    disturbed = x[np.abs(p) > 1e-9]
    lo, hi = disturbed.min(), disturbed.max()
    for ax, field in zip(axes[1], (u, p, rho / rho0)):
        ax.set_xlim(lo - 0.1 * (hi - lo), hi + 0.1 * (hi - lo))
        middle = field[np.argmax(p)]
        reach = 0.1 if field is u else 0.12 * np.ptp(field)
        ax.set_ylim(middle - reach, middle + reach)
    axes[0, 0].legend(fontsize=8)
    fig.suptitle("%s, gap %g, n = %d, t = %g (below: enlarged)" % (first.title(), first.result["gap"], first.n, first.t))
    fig.tight_layout()
    fig.savefig(name, dpi=100)
    plt.close(fig)


def pressures(columns, name):
    """pressure profiles; columns: one list of runs per case"""
    fig, axes = plt.subplots(1, len(columns), figsize=(4.2 * len(columns), 4), squeeze=False)
    for ax, runs in zip(axes[0], columns):
        ax.plot(runs[0].fields[0], runs[0].fields[2], "k", lw=0.8, label="exact")
        for run in runs:
            ax.plot(run.x, run.p, ".", ms=3, color=COLORS.get(run.label(), "C5"), label=run.name())
        ax.set_title("%s, t = %g" % (runs[0].title(), runs[0].t))
        ax.set_xlabel("x")
        ax.legend(fontsize=7)
    axes[0, 0].set_ylabel("pressure")
    fig.tight_layout()
    fig.savefig(name, dpi=100)
    plt.close(fig)


def gauges(columns, name):
    """velocity at the gauges; columns: one list of runs per case"""
    fig, axes = plt.subplots(1, len(columns), figsize=(4.2 * len(columns), 4), squeeze=False)
    for ax, runs in zip(axes[0], columns):
        for k, m in enumerate(layers.gauges(runs[0].layers)):
            times, u, _ = runs[0].exact.gauge(m)
            ax.step(np.append(times, runs[0].t), np.append(u, u[-1]), "k", lw=0.8, where="post", label="exact" if k == 0 else None)
            for run, style in zip(runs, ("-", "--", ":")):
                ax.plot(run.gauges[:, 0], run.gauges[:, k + 1], style, color="C%d" % k, lw=1.3,
                        label=GAUGES[k] + ", " + run.name())
        ax.set_title("%s, gap %g" % (runs[0].title(), runs[0].result["gap"]))
        ax.set_xlabel("t")
    axes[0, 0].set_ylabel("velocity")
    fig.tight_layout(rect=(0, 0, 1, 0.86))
    fig.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncol=5 if len(columns) > 1 else 2, fontsize=8, frameon=False)
    fig.savefig(name, dpi=100)
    plt.close(fig)


def row(name, run):
    r = run.result
    print("| %s | %.3f | %.3f | %.3f | %.4f | %.4f | %d | %.1e | %.1e | %.2f |"
          % (name, 100 * r["l1_u"], 100 * r["l1_p"], 100 * r["l1_density"], run.p.max(), r["p_max_exact"], r["crossings"],
             r["energy_ratio"] - 1, r["momentum_error"], r["wall_s"]))


HEAD = "\n| %s | L1(u) % | L1(p) % | L1(rho) % | largest p | exact | crossings | energy - 1 | momentum | s |\n|" + 10 * "---|"


def table(title, pattern, runs):
    chosen = [(name, run) for name, run in runs.items() if pattern(name)]
    if chosen:
        print(HEAD.replace("%s", title))
        for name, run in chosen:
            row(name, run)


def main():
    folders = sys.argv[1:] or sorted(f for f in glob.glob("runs/*") if os.path.exists(os.path.join(f, "result.yaml")))
    if not folders:
        sys.exit("no runs: sh run.sh first, see README.md")
    runs = {}
    for folder in folders:
        runs[os.path.basename(os.path.normpath(folder))] = run = Run(folder)
        run.judge()
        if sys.argv[1:]:
            profiles([run], os.path.join(folder, "profile.png"))
            gauges([[run]], os.path.join(folder, "gauges.png"))
    table("run", lambda name: True, runs)
    if sys.argv[1:]:
        return

    for gap in ("0", "0.1"):
        several = [runs[f"test-{gap}-{a}"] for a in COLORS if f"test-{gap}-{a}" in runs]
        if several:
            profiles(several, f"profiles-gap{gap}.png")
    cases = [case for case in CASES if case + "-0.3" in runs]
    columns = [[runs[f"{case}-{a}"] for a in ("0.3", "auto", "riemann") if f"{case}-{a}" in runs] for case in cases]
    if columns:
        gauges(columns, "gauges.png")
        pressures(columns, "pressures.png")

    print("\n| order of L1 | u | p | rho |\n|---|---|---|---|")
    for kind in ("0.3", "auto", "riemann"):
        chain = [runs[k] for k in (f"n100-{kind}", f"n200-{kind}", f"test-0-{kind}", f"n800-{kind}", f"n1600-{kind}") if k in runs]
        for a, b in zip(chain[:-1], chain[1:]):
            order = [np.log(a.l1[k] / b.l1[k]) / np.log(b.n / a.n) for k in a.l1]
            print(f"| alpha_rho {kind}, n {a.n} to {b.n} | " + " | ".join("%.2f" % o for o in order) + " |")

    print("\n| gauges | shocks late by, in spacings over the wave speed (A; B; C) | mean over plateaus less exact, % of u0 |\n|---|---|---|")
    worst = {}  # of all cases without a gap
    for name, run in runs.items():
        if name.split("-")[0] in cases:
            late, flat = zip(*run.judge_gauges())
            text = lambda lists, form: "; ".join(" ".join(form % v for v in values) or "-" for values in lists)
            print(f"| {name} | {text(late, '%.2f')} | {text([[100 * v for v in f] for f in flat], '%.2f')} |")
            late, flat = (max(np.abs(np.concatenate(lists)), default=0.0) for lists in (late, flat))
            worst[run.label()] = np.maximum(worst.get(run.label(), 0.0), (late, 100 * flat))
    for label, (late, flat) in worst.items():
        print(f"| largest, {label} | {late:.2f} | {flat:.3f} |")


if __name__ == "__main__":
    main()
