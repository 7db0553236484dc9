#!/usr/bin/env python3
"""Records of plate impacts, and what the runs of run.sh gave.

    python3 plot.py FOLDER...   one or more runs (result.yaml, surface.dat, profile.dat): draws FOLDER/record.png
    python3 plot.py             the runs of run.sh under runs/: the figures and tables of README.md

The strength of matter that is stretched at a constant rate (tests/reference/voids.py) is drawn beside what records give.
"""

import csv
import os
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

here = os.path.dirname(os.path.abspath(__file__))
root = os.environ.get("HVI_ROOT", os.path.join(here, "..", ".."))
sys.path.insert(0, os.path.join(root, "tests"))
from reference import voids

NS = (8, 16, 32, 64, 128, 256, 512)
THICK = ("20", "6.3", "2", "0.63", "0.2", "0.063")
RHO_C = {"Al6061": (2703.0, 5240.0), "Cu": (8930.0, 3940.0)}
FILE = {"Al6061": "Al6061-T6", "Cu": "Cu-OFHC"}
COLOR = {"voids": "C0", "principal": "C3", "none": "0.5"}


def read(name):
    """result.yaml, and the record: t (us), u, largest tension, failed particles"""
    folder = name if os.path.isdir(name) else os.path.join("runs", name)
    with open(os.path.join(folder, "result.yaml")) as f:
        return yaml.safe_load(f), np.loadtxt(os.path.join(folder, "surface.dat")).T


def table(rows):
    head, *rest = rows
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rest:
        print("| " + " | ".join(row) + " |")
    print()


def rate_without_fracture(name, sigma, rho, c):
    """-(du/dt)/(2 c) of the free surface of a run that does not spall, between 10 and 90 % of du = 2 sigma/(rho c), as the rates of shots.csv"""
    r, (t, u, *_) = read(name)
    du, top = 2 * sigma / (rho * c), r["top_m_s"]
    low = next((k for k in range(u.argmax(), len(u)) if u[k] < top - 0.9 * du), None)
    if low is None:
        return np.nan
    high = np.flatnonzero(u[:low] >= top - 0.1 * du)[-1]
    return 0.8 * du / (2e-6 * c * (t[low] - t[high]))


def record(folder):
    r, (t, u, pull, bad) = read(folder)
    x = np.loadtxt(os.path.join(folder, "profile.dat"))
    fig, (a, b) = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    a.plot(t, u)
    for level in (r["top_m_s"], r["top_m_s"] - r["pull_back_m_s"]):
        a.axhline(level, color="0.7", lw=0.8)
    a.set(xlabel="t (us)", ylabel="free surface (m/s)",
          title=f"pull-back {r['pull_back_m_s']:.1f} m/s, {r['spall_strength_GPa']:.3f} GPa at {r['strain_rate_per_s']:.3g}/s")
    b.plot(1e3 * x[:, 2], x[:, 11], ".-", ms=3, label="voids, part of volume")
    b.plot(1e3 * x[:, 2], x[:, 12], ".-", ms=3, label="damage by voids")
    b.axvline(r["target_mm"] - r["spall_plane_mm"], color="0.7", lw=0.8)
    b.set(xlabel="x at the start (mm)", title=f"first failure {r['spall_plane_mm']:.3f} mm below the surface")
    b.legend()
    fig.savefig(os.path.join(folder, "record.png"), dpi=110)


def convergence():
    got = {s: [read(f"n{n}-{s}") for n in NS] for s in ("voids", "principal")}
    fig, ax = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    for n, (_, (t, u, *_)) in zip(NS, got["voids"]):
        if n > 8:
            ax[0].plot(t, u, lw=1, label=f"{n} per flyer")
    ax[0].set(xlim=(0.55, 2.1), ylim=(280, 510), xlabel="t (us)", ylabel="free surface (m/s)", title="spall voids")
    ax[0].legend()
    for s, runs in got.items():
        ax[1].semilogx(NS, [r["spall_strength_GPa"] for r, _ in runs], "o-", color=COLOR[s], label=s)
    ax[1].set(xlabel="particles through the flyer", title="sigma* (GPa)", ylim=(0, 1.3))
    ax[1].axvspan(8, 32, color="0.93")
    ax[1].legend()
    ax[2].loglog(NS, [1e-3 * r["void_work_J_m2"] for r, _ in got["voids"]], "o-")
    ax[2].set(xlabel="particles through the flyer", title="work of opening voids (kJ/m$^2$)")
    fig.savefig("convergence.png", dpi=110)
    rows = [["particles through the flyer", "spacing um", "pull-back m/s", "change", "sigma* GPa", "rate /s", "largest -p GPa",
             "first failure, mm below the surface", "particles failed", "void work kJ/m2", "principal: pull-back m/s", "sigma* GPa", "first failure"]]
    last = None
    for n, (v, _), (p, _) in zip(NS, got["voids"], got["principal"]):
        change = "" if last is None else f"{100 * (v['pull_back_m_s'] / last - 1):+.1f} %"
        last = v["pull_back_m_s"]
        rows.append([str(n), f"{v['spacing_um']:.1f}", f"{last:.1f}", change, f"{v['spall_strength_GPa']:.3f}", f"{v['strain_rate_per_s']:.2g}",
                     f"{v['largest_tension_GPa']:.2f}", f"{v['spall_plane_mm']:.2f}", f"{v['failed_particles']:.0f}", f"{1e-3 * v['void_work_J_m2']:.1f}", f"{p['pull_back_m_s']:.1f}",
                     f"{p['spall_strength_GPa']:.3f}", f"{p['spall_plane_mm']:.2f}"])
    table(rows)


def rates(shots):
    k = voids.constants(pathlib.Path(root))
    fig, a = plt.subplots(figsize=(7, 4.6), layout="constrained")
    e = np.geomspace(4e3, 5e6, 30)
    a.loglog(e, 1e-9 * k["sigma"] * (e / k["rate"]) ** k["m"], "k--", lw=0.8, label="sigma (rate/rate$_0$)$^m$ of the file")
    a.loglog(e, [1e-9 * voids.law(k, q)[0] for q in e], "k-", lw=0.8, label="matter stretched at a constant rate")
    rows = [["flyer / target mm"] + [f"{s}, {n} per flyer: {w}" for s, n in (("voids", 64), ("voids", 128), ("principal", 128)) for w in ("sigma* GPa", "rate /s")]
            + ["largest -p, 128, GPa", "file's sigma at that rate", "sigma* of it", "stretched at that rate"]]
    for s, n, mark in (("voids", 64, "o"), ("voids", 128, "s"), ("principal", 128, "^")):
        runs = [read(f"h{h}-{n}-{s}")[0] for h in THICK]
        x, y = (np.array([r[q] for r in runs]) for q in ("strain_rate_per_s", "spall_strength_GPa"))
        a.loglog(x, y, mark + "-", color=COLOR[s], mfc="none" if n == 64 else COLOR[s], label=f"{s}, {n} per flyer: m {np.polyfit(np.log(x), np.log(y), 1)[0]:.3f}")
    for name, mark, f in (("34 um", "D", "6061-20"), ("47 um", "v", "6061-80")):
        own = [s for s in shots if s["name"].startswith(f)]
        a.loglog([float(s["rate"]) for s in own], [float(s["sigma"]) for s in own], mark, color="C2", mfc="none", label=f"measured, 6061 of {name}")
    a.set(xlabel="strain rate (1/s)", ylabel="spall strength (GPa)", title="500 m/s, flyers of 20 to 0.063 mm, targets twice as thick")
    a.grid(alpha=0.3, which="both")
    a.legend(fontsize=7)
    fig.savefig("rates.png", dpi=110)
    for h in THICK:
        v, w, p = (read(f"h{h}-{q}")[0] for q in ("64-voids", "128-voids", "128-principal"))
        scale = 1e-9 * k["sigma"] * (w["strain_rate_per_s"] / k["rate"]) ** k["m"]
        cells = [c for r in (v, w, p) for c in (f"{r['spall_strength_GPa']:.3f}", f"{r['strain_rate_per_s']:.2g}")]
        rows.append([f"{h} / {2 * float(h):g}", *cells, f"{w['largest_tension_GPa']:.2f}", f"{scale:.3f}", f"{w['spall_strength_GPa'] / scale:.2f}",
                     f"{1e-9 * voids.law(k, w['strain_rate_per_s'])[0]:.3f}"])
    table(rows)


def measured(shots):
    fig, a = plt.subplots(figsize=(4.6, 4.4), layout="constrained")
    rows = [["shot", "flyer / target mm", "v m/s", "peak GPa: paper, here", "sigma* GPa: measured", "voids 64", "128", "of the measured", "principal 128",
             "rate /s, without fracture", "of the record", "file's sigma at the first", "largest -p GPa", "first failure, mm below the surface"]]
    for s in shots:
        name = "shot-" + s["name"].replace(" ", "_")
        rho, c = RHO_C[s["target"]]
        k = voids.constants(pathlib.Path(root), FILE[s["target"]])
        v, w, p, q = (read(f"{name}-{how}")[0] for how in ("voids-64", "voids-128", "principal-128", "none-128"))
        sigma = float(s["sigma"])
        rate = rate_without_fracture(f"{name}-none-128", 1e9 * sigma, rho, c)
        good, spalls = (r["record"] == "ok" for r in (p, w))
        if spalls:
            a.plot(sigma, w["spall_strength_GPa"], "o" if s["target"] == "Al6061" else "s", color="C0", mfc="none" if s["flyer"] == "quartz" else "C0")
        if good:
            a.plot(sigma, p["spall_strength_GPa"], "^", color="C3", mfc="none" if s["flyer"] == "quartz" else "C3")
        file = 1e-9 * k["sigma"] * (rate / k["rate"]) ** k["m"]
        rows.append([s["name"] + (" (\\*)" if s["note"] else ""), f"{s['flyer']} {s['hf']} / {s['ht']}", s["v0"], f"{float(s['peak']):.2f}, {q['peak_GPa']:.2f}",
                     s["sigma"], *(f"{r['spall_strength_GPa']:.3f}" if spalls else "-" for r in (v, w)), f"{w['spall_strength_GPa'] / sigma:.2f}" if spalls else "-",
                     f"{p['spall_strength_GPa']:.3f}" if good else "-", f"{rate:.2g}" if rate == rate else "-", f"{w['strain_rate_per_s']:.2g}" if spalls else "-", f"{file:.2f}" if rate == rate else "-",
                     f"{w['largest_tension_GPa']:.2f}", f"{w['spall_plane_mm']:.2f}" if w["failed_particles"] else "none fails"])
    a.plot([0, 2], [0, 2], "k-", lw=0.8)
    a.fill_between([0, 2], [0, 1.6], [0, 2.4], color="0.9", lw=0, label="20 %")
    a.plot([], [], "o", color="C0", label="voids, 6061 on 6061")
    a.plot([], [], "o", color="C0", mfc="none", label="voids, quartz on 6061")
    a.plot([], [], "s", color="C0", label="voids, Cu on Cu")
    a.plot([], [], "^", color="C3", label="principal")
    a.set(xlim=(0.4, 2), ylim=(0.4, 2), xlabel="sigma* measured (GPa)", ylabel="computed, 128 per flyer")
    a.legend(fontsize=7)
    fig.savefig("shots.png", dpi=110)
    table(rows)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        for folder in sys.argv[1:]:
            record(folder)
    else:
        with open(os.path.join(here, "shots.csv")) as f:
            shots = list(csv.DictReader(line for line in f if not line.startswith("#")))
        convergence()
        rates(shots)
        measured(shots)
