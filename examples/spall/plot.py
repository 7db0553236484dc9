#!/usr/bin/env python3
"""Records of plate impacts, and what the runs of run.sh gave.

    python3 plot.py FOLDER...   one or more runs after hvi measure (result.yaml, surface.dat, profile.dat): draws FOLDER/record.png
    python3 plot.py             the runs of run.sh under runs/: the figures of README.md, its tables on the screen, found.csv, all columns of all shots, and runs/metals.csv
    python3 plot.py --raised    writes runs/raised/FILE.hvi: sigma so large that matter stretched at the file's rate bears the file's sigma, for run.sh

The strength of matter that is stretched at a constant rate (tests/reference/voids.py) is drawn beside what records give.
"""

import csv
import os
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np
import yaml

here = os.path.dirname(os.path.abspath(__file__))
root = os.environ.get("HVI_ROOT", os.path.join(here, "..", ".."))
sys.path[:0] = [os.path.join(root, "tests"), os.path.join(root, "python")]
from hvi.material import curves, library
from reference import voids

NS = (8, 16, 32, 64, 128, 256, 512)
THICK = ("20", "6.3", "2", "0.63", "0.2", "0.063")
COLOR = {"voids": "C0", "principal": "C3", "none": "0.5"}

# of the material file of the target: its name here, and its color
METAL = {"Al6061-T6": ("6061", "C0"), "Al1100-O": ("1100-O", "C9"), "Al5083-H116": ("5083", "C2"), "Cu-OFHC": ("copper", "C1"), "Fe-Armco": ("iron", "C4"),
         "steel-304": ("steel 304", "C5"), "steel-1020": ("mild steel", "0.3")}


def read(name):
    """result.yaml, and the record: t (us), u, largest tension, push, failed particles"""
    folder = name if os.path.isdir(name) else os.path.join("runs", name)
    with open(os.path.join(folder, "result.yaml")) as f:
        return yaml.safe_load(f), np.loadtxt(os.path.join(folder, "surface.dat")).T


def table(rows, file=None):
    """prints it, and writes it as CSV"""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    lines.insert(1, "|" + "---|" * len(rows[0]))
    print("\n".join(lines) + "\n")
    if file:
        with open(os.path.join(here, file), "w", newline="") as f:
            csv.writer(f, lineterminator="\n").writerows([cell.replace("\\*", "*") for cell in row] for row in rows)


def rate_without_fracture(name, sigma):
    """-(du/dt)/(2 c) of the free surface of a run that does not spall, between 10 and 90 % of du = 2 sigma/(rho c), as the rates of shots.csv"""
    r, (t, u, *_) = read(name)
    rho, c = r["target_density_kg_m3"], r["target_sound_speed_m_s"]
    du, top = 2 * sigma / (rho * c), r["top_m_s"]
    low = next((k for k in range(u.argmax(), len(u)) if u[k] < top - 0.9 * du), None)
    if low is None:
        return np.nan
    high = np.flatnonzero(u[:low] >= top - 0.1 * du)[-1]
    return 0.8 * du / (2e-6 * c * (t[low] - t[high]))


def raised(file):
    """sigma so raised, of what the file has"""
    one = library.read(os.path.join(root, "potentials", file + ".hvi"))
    v = one.in_si(("spall", "voids"))
    return curves.sigma_for(one, v["sigma"], v["rate"]) / v["sigma"]


def write_raised():
    os.makedirs("runs/raised", exist_ok=True)
    for file in METAL:
        head, section, rest = pathlib.Path(root, "potentials", file + ".hvi").read_text().partition("\nspall voids\n")
        more, n = re.subn(r"(?m)^  sigma +(\S+)", lambda found: f"  sigma {raised(file) * float(found[1]):.6g}", rest, count=1)
        if n != 1:
            sys.exit(f"{file}.hvi: no sigma in a section spall voids")
        pathlib.Path("runs", "raised", file + ".hvi").write_text(head + section + more)


def record(folder):
    r, (t, u, *_) = read(folder)
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


def plain(axis, ticks):
    """a logarithmic axis with these numbers, not powers of ten"""
    axis.set_major_locator(matplotlib.ticker.FixedLocator(ticks))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda y, _: f"{y:g}"))
    axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def convergence():
    got = {s: [read(f"n{n}-{s}") for n in NS] for s in ("voids", "principal")}
    fig, ax = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    for n, (_, (t, u, *_)) in zip(NS, got["voids"]):
        if n > 8:
            ax[0].plot(t, u, lw=1, label=f"{n} per flyer")
    ax[0].set(xlim=(0.55, 2.1), ylim=(200, 510), xlabel="t (us)", ylabel="free surface (m/s)", title="spall voids")
    ax[0].legend(loc="lower right", ncol=2)
    for s, runs in got.items():
        ax[1].semilogx(NS, [r["spall_strength_GPa"] for r, _ in runs], "o-", color=COLOR[s], label=s)
    ax[1].set(xlabel="particles through the flyer", title="sigma* (GPa)", ylim=(0, 1.3))
    ax[1].axvspan(8, 32, color="0.93")
    ax[1].legend(loc="lower right")
    ax[2].loglog(NS, [1e-3 * r["void_work_J_m2"] for r, _ in got["voids"]], "o-")
    ax[2].set(xlabel="particles through the flyer", title="work of opening voids (kJ/m$^2$)")
    plain(ax[2].yaxis, (30, 40, 50, 60, 80))
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
    a, b, c = (v["pull_back_m_s"] for v, _ in got["voids"][-3:])
    rows.append([f"limit (Aitken, of {NS[-3]} to {NS[-1]})", "", f"{c - (c - b)**2 / (c - 2 * b + a):.1f}", *[""] * (len(rows[0]) - 3)])
    table(rows)


def rates(shots):
    k = voids.constants(pathlib.Path(root))
    fig, a = plt.subplots(figsize=(7, 4.6), layout="constrained")
    e = np.geomspace(4e3, 5e6, 30)
    a.loglog(e, 1e-9 * k["sigma"] * (e / k["rate"]) ** k["m"], "k--", lw=0.8, label="sigma (rate/rate$_0$)$^m$ of the file")
    a.loglog(e, [1e-9 * voids.law(k, q)[0] for q in e], "k-", lw=0.8, label="matter stretched at a constant rate")
    rows = [["flyer / target mm"] + [f"{s}, {n} per flyer: {w}" for s, n in (("voids", 64), ("voids", 128), ("principal", 128)) for w in ("sigma* GPa", "rate /s")]
            + ["largest -p, 128, GPa", "file's sigma at that rate", "sigma* of it", "stretched at that rate"]]
    powers = []
    for s, n, mark in (("voids", 64, "o"), ("voids", 128, "s"), ("principal", 128, "^")):
        runs = [read(f"h{h}-{n}-{s}")[0] for h in THICK]
        x, y = (np.array([r[q] for r in runs]) for q in ("strain_rate_per_s", "spall_strength_GPa"))
        powers.append(f"{np.polyfit(np.log(x), np.log(y), 1)[0]:.3f}")
        a.loglog(x, y, mark + "-", color=COLOR[s], mfc="none" if n == 64 else COLOR[s], label=f"{s}, {n} per flyer: m {powers[-1]}")
    for name, mark, f in (("34 um", "D", "6061-20"), ("47 um", "v", "6061-80")):
        own = [s for s in shots if s["name"].startswith(f)]
        a.loglog([float(s["rate"]) for s in own], [float(s["sigma"]) for s in own], mark, color="C2", mfc="none", label=f"measured, 6061 of {name}")
    a.set(xlabel="strain rate (1/s)", ylabel="spall strength (GPa)", title="500 m/s, flyers of 20 to 0.063 mm, targets twice as thick")
    a.grid(alpha=0.3, which="both")
    plain(a.yaxis, (0.6, 0.8, 1, 1.5, 2))
    a.legend(fontsize=7)
    fig.savefig("rates.png", dpi=110)
    for h in THICK:
        v, w, p = (read(f"h{h}-{q}")[0] for q in ("64-voids", "128-voids", "128-principal"))
        scale = 1e-9 * k["sigma"] * (w["strain_rate_per_s"] / k["rate"]) ** k["m"]
        cells = [c for r in (v, w, p) for c in (f"{r['spall_strength_GPa']:.3f}", f"{r['strain_rate_per_s']:.2g}")]
        rows.append([f"{h} / {2 * float(h):g}", *cells, f"{w['largest_tension_GPa']:.2f}", f"{scale:.3f}", f"{w['spall_strength_GPa'] / scale:.2f}",
                     f"{1e-9 * voids.law(k, w['strain_rate_per_s'])[0]:.3f}"])
    rows.append(["power of the rate", *(cell for power in powers for cell in (power, "")), *[""] * 4])
    table(rows)


def measured(shots):
    fig, ax = plt.subplots(1, 2, figsize=(10.4, 4.8), layout="constrained")
    rows = [["shot", "flyer / target mm", "v m/s", "peak GPa: paper, here", "rate /s: paper", "without fracture", "of the record", "sigma* GPa: measured", "voids 64", "128", "of the measured", "128, sigma raised", "principal 128",
             "file's sigma at the second rate", "largest -p GPa", "first failure, mm below the surface"]]
    found, strengths = {}, {}
    for s in shots:
        name = "shot-" + s["name"].replace(" ", "_")
        k = voids.constants(pathlib.Path(root), s["target"])
        v, w, more, q = (read(f"{name}-{how}")[0] for how in ("voids-64", "voids-128", "raised-128", "none-128"))
        p = read(f"{name}-principal-128")[0] if s["target"] == "Al6061-T6" else None
        sigma = float(s["sigma"])
        rate = rate_without_fracture(f"{name}-none-128", 1e9 * sigma)
        given = float(s["rate"]) if s["note"] == "t" else np.nan
        spalls, pulls = w["record"] == "ok", w["record"] == "ok" or w["record"].startswith("a pull-back")
        color, filled = METAL[s["target"]][1], s["flyer"] != "quartz"
        if pulls:
            strengths[s["name"]] = w["spall_strength_GPa"]
            ax[0].loglog(sigma, w["spall_strength_GPa"], "o" if spalls else "x", color=color, mfc=color if filled else "none")
        if p and p["record"] == "ok":
            ax[0].loglog(sigma, p["spall_strength_GPa"], "^", color="C3", mfc="C3" if filled else "none", ms=4)
        if pulls and given == given:
            ax[1].loglog(given, sigma, "s", color=color, mfc="none")
            ax[1].loglog(given, w["spall_strength_GPa"], "o" if spalls else "x", color=color)
        found.setdefault(s["target"], []).append((sigma, w["spall_strength_GPa"] if pulls else np.nan, spalls, given,
                                                  more["spall_strength_GPa"] if more["record"] == "ok" else np.nan, q["peak_GPa"] / float(s["peak"])))
        file = 1e-9 * k["sigma"] * (rate / k["rate"]) ** k["m"]
        mark = " (\\*)" if s["note"] == "v" else " (\\*\\*)" if s["note"] == "p" else ""

        def number(x, form):
            return format(x, form) if x == x else "-"

        def strength(r):
            return f"{r['spall_strength_GPa']:.3f}" if r["record"] == "ok" else f"({r['spall_strength_GPa']:.3f})" if r["record"].startswith("a pull-back") else "-"

        rows.append([s["name"] + mark, f"{s['flyer']} {s['hf']} / {s['ht']}", s["v0"], f"{float(s['peak']):.2f}, {q['peak_GPa']:.2f}", number(given, ".2g"), number(rate, ".2g"),
                     f"{w['strain_rate_per_s']:.2g}" if pulls else "-", s["sigma"], strength(v), strength(w),
                     f"{w['spall_strength_GPa'] / sigma:.2f}" if pulls else "-", strength(more), f"{p['spall_strength_GPa']:.3f}" if p and p["record"] == "ok" else "-", number(file, ".2f"),
                     f"{w['largest_tension_GPa']:.2f}", f"{w['spall_plane_mm']:.2f}" if w["failed_particles"] else "none fails"])
    x = np.array([0.7, 4.0])
    ax[0].loglog(x, x, "k-", lw=0.8)
    ax[0].fill_between(x, 0.8 * x, 1.2 * x, color="0.9", lw=0, label="20 %")
    for name in found:
        ax[0].plot([], [], "o", color=METAL[name][1], label=METAL[name][0])
    ax[0].plot([], [], "ko", mfc="none", label="flyer of quartz")
    ax[0].plot([], [], "kx", label="a pull-back, but not parted")
    ax[0].plot([], [], "^", color="C3", ms=4, label="6061, principal")
    ax[0].set(xlim=(0.7, 4), ylim=(0.4, 4), xlabel="sigma* measured (GPa)", ylabel="computed, 128 per flyer (GPa)")
    e = np.geomspace(3e4, 1e6, 20)
    for name in found:
        if any(given == given for _, _, _, given, _, _ in found[name]):
            k, (label, color) = voids.constants(pathlib.Path(root), name), METAL[name]
            ax[1].loglog(e, 1e-9 * k["sigma"] * (e / k["rate"]) ** k["m"], "--", lw=0.8, color=color)
            ax[1].plot([], [], "s", color=color, mfc="none", label=f"{label}: measured")
            ax[1].plot([], [], "o", color=color, label="computed")
            ax[1].plot([], [], "--", lw=0.8, color=color, label="sigma (rate/rate$_0$)$^m$ of the file")
    ax[1].set(xlabel="strain rate of the papers (1/s)", ylabel="sigma* (GPa)", title="shots whose rate is published", ylim=(0.7, 5))
    for a in ax:
        a.grid(alpha=0.3, which="both")
        a.legend(fontsize=7)
        for axis in (a.xaxis, a.yaxis) if a is ax[0] else (a.yaxis,):
            plain(axis, (0.4, 0.6, 0.8, 1, 1.5, 2, 3, 4))
    fig.savefig("shots.png", dpi=110)
    table(rows, "found.csv")
    summary = [["metal", "shots", "with a pull-back", "parted", "of the measured: mean", "least", "most", "scatter about the mean", "measured: most of the least", "peak, of the published", "phi_c", "sigma raised by %", "parted then", "of the measured then"]]
    for name, values in found.items():
        sigma, got, parted, _, more, peak = np.array(values).T
        of, then = (got / sigma)[got == got], (more / sigma)[more == more]
        phi_c = voids.constants(pathlib.Path(root), name)["phi_c"]
        summary.append([METAL[name][0], str(len(sigma)), str(len(of)), f"{parted.sum():.0f}", *(f"{x:.2f}" for x in (of.mean(), of.min(), of.max(), of.std() / of.mean())),
                        f"{sigma.max() / sigma.min():.2f}", f"{peak.min():.2f} to {peak.max():.2f}", f"{phi_c:.3f}", f"{100 * raised(name) - 100:.0f}",
                        str(len(then)), f"{then.mean():.2f}" if len(then) else "-"])
    table(summary, os.path.abspath("runs/metals.csv"))
    powers = [["shots of", "power of the published rate: measured", "computed, 128 per flyer"]]
    for paper in dict.fromkeys(s["paper"] for s in shots):
        own = [(float(s["rate"]), float(s["sigma"]), strengths[s["name"]]) for s in shots if s["paper"] == paper and s["note"] == "t" and s["name"] in strengths]
        if len(own) > 2:
            rate, of, got = np.log(own).T
            powers.append([paper, *(f"{np.polyfit(rate, y, 1)[0]:.3f}" for y in (of, got))])
    table(powers)


if __name__ == "__main__":
    if sys.argv[1:] == ["--raised"]:
        write_raised()
    elif sys.argv[1:]:
        for folder in sys.argv[1:]:
            record(folder)
    else:
        with open(os.path.join(here, "shots.csv")) as f:
            shots = list(csv.DictReader(line for line in f if not line.startswith("#")))
        for shot in shots:
            shot.update({body: shot[body].removesuffix(".hvi") for body in ("flyer", "target")})
        convergence()
        rates(shots)
        measured(shots)
