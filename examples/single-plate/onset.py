#!/usr/bin/env python3
"""Onset of fragmentation: python3 onset.py [FOLDER, default: runs] -> the tables of README.md, onset.png, from the sweeps of studies/onset*.yaml

What is lost is what is not in the largest piece, of the sphere or of its half that was away from the plate; a velocity at which a share is
lost lies on the straight line between the velocities that were run, where it is passed first.
"""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

D = 9.53  # mm
KEYS = {"apart": "largest_apart_mass_fraction", "rear": "largest_rear_mass_fraction", "sound": "largest_fragment_mass_fraction"}
# discrete elements, ../debris-studies: 10 % and half of the sphere lost, km/s
ELEMENTS = {0.1: ("2.9, 7.7", "6.0, 7.8"), 0.16: ("2.2-2.3, 5", "4.1, 7.2"), 0.4: ("2.2-2.3, 3.3", "3.2-3.7, 4.8-5.6")}


def measured(thickness):
    """km/s, of t/D: Piekutowski 2003"""
    return 1.436 * thickness ** (-1 / 3) if thickness < 0.16 else 2.60


def read(folder, *names):
    """{(t/D, spacings in the sphere, layers, shift, material): {velocity in km/s: row}} of these sweeps"""
    found = {}
    for name in names:
        path = os.path.join(folder, name + ".csv")
        if not os.path.exists(path):
            continue
        with open(path) as f:
            rows = list(csv.DictReader(f))
        done = [row for row in rows if row.get(KEYS["rear"])]
        if len(done) < len(rows):
            print(f"{path}: {len(rows) - len(done)} runs without a result are left out\n")
        for row in done:
            t, dx = float(row["t"]), float(row["dx"])
            key = round(t / D, 3), round(D / dx, 2), round(t / dx), float(row.get("shift") or 0), row["material_p"]
            found.setdefault(key, {})[float(row["v0"]) / 1000] = row
    return {key: dict(sorted(runs.items())) for key, runs in sorted(found.items())}


def pieces(runs, which):
    return np.array(list(runs)), np.array([float(row[KEYS[which]]) for row in runs.values()])


def lost(runs, which, share):
    """km/s; NaN where more is left at all velocities that were run, minus the least of them where less is left there"""
    v, largest = pieces(runs, which)
    below = np.flatnonzero(largest < 1 - share)
    if not below.size:
        return np.nan
    k = below[0]
    if k == 0:
        return -v[0]
    return v[k - 1] + (largest[k - 1] - 1 + share) / (largest[k - 1] - largest[k]) * (v[k] - v[k - 1])


def speed(v, onset=None):
    """text of it, with how far from the measured one"""
    off = f" ({100 * (abs(v) / onset - 1):+.0f} %)" if onset and not np.isnan(v) else ""
    return "not reached" if np.isnan(v) else f"below {-v:g}{off}" if v < 0 else f"{v:.2f}{off}"


def table(rows):
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    print("\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:]]) + "\n")


def main(folder):
    voids, principal = read(folder, "onset"), read(folder, "onset-principal")
    if not voids:
        sys.exit(f"no runs of studies/onset.yaml in {folder}: hvi sweep studies/onset.yaml")
    three = ("rear", 0.1), ("apart", 0.1), ("apart", 0.5)
    rows = [["t/D", "layers", "measured onset", "rear: 10 % lost at, km/s", "sphere: 10 % lost", "half lost", "sound: half lost",
             "`spall principal`: rear 10 %, sphere 10 %, half lost", "discrete elements, sc: 10 %, half", "fcc"]]
    for key, runs in voids.items():
        onset, other = measured(key[0]), principal.get(key)
        instant = "not run" if other is None else ", ".join(speed(lost(other, *of)) for of in three)
        rows.append([f"{key[0]:g}", str(key[2]), f"{onset:.2f}", *(speed(lost(runs, *of), onset) for of in three), speed(lost(runs, "sound", 0.5)),
                     instant, *ELEMENTS.get(key[0], ("-", "-"))])
    table(rows)
    speeds = sorted({v for runs in voids.values() for v in runs})
    rows = [["t/D", "largest piece", *(f"{v:g} km/s" for v in speeds)]]
    for key, runs in voids.items():
        for which in KEYS:
            shares = (f"{float(runs[v][KEYS[which]]):.3f}" if v in runs else "-" for v in speeds)
            rows.append([f"{key[0]:g}" if which == "apart" else "", which, *shares])
    table(rows)
    varied = read(folder, "onset-variations", "onset-finest", "onset-thin", "onset-constants")
    rows = [["t/D", "changed", "largest piece apart, at km/s", "of the rear half, at the same", "rear: 10 % lost at", "sphere: 10 % lost", "half lost"]]
    plain = "Al2017-T4.hvi"
    for key, runs in sorted([*voids.items(), *varied.items()], key=lambda item: (item[0][0], item[0][4] != plain, item[0][1], item[0][3], item[0][4])):
        onset = measured(key[0])
        what = [f"{key[1]:g} across, {key[2]} layer{'s' * (key[2] > 1)}"] if key[3] == 0 and key[4] == plain else []
        what += [f"lattice shifted by {key[3]:g} spacings"] if key[3] else []
        what += [key[4]] if key[4] != plain else []
        listed = [] if key in voids else list(runs)
        rows.append([f"{key[0]:g}", ", ".join(what), "; ".join(f"{v:g}: {float(runs[v][KEYS['apart']]):.3f}" for v in listed) or "above",
                     ", ".join(f"{float(runs[v][KEYS['rear']]):.3f}" for v in listed) or "above",
                     *(speed(lost(runs, *of), onset) for of in three)])
    table(rows)
    every = [row for runs in [*voids.values(), *principal.values(), *varied.values()] for row in runs.values()]
    seconds, energy = [float(row["core_s"]) for row in every], [abs(float(row["energy_ratio"]) - 1) for row in every]
    print(f"{len(seconds)} runs, {min(seconds):.0f} to {max(seconds):.0f} core-seconds, energy to {max(energy):.0e}")
    finer = {key: [other for k, other in varied.items() if k[0] == key[0] and k[3] == 0 and k[4] == key[4]] for key in voids}
    draw({key: (runs, principal.get(key), finer[key]) for key, runs in voids.items()}, "onset.png")


def draw(panels, path):
    fig, axes = plt.subplots(1, len(panels), figsize=(3.4 * len(panels), 3.6), sharey=True, layout="constrained")
    for ax, (key, (runs, instant, finer)) in zip(np.atleast_1d(axes), panels.items()):
        ax.axvline(measured(key[0]), color="0.6", lw=4, alpha=0.5, label="measured onset")
        ax.plot(*pieces(runs, "apart"), "o-", color="C0", label=f"sphere, {key[1]:g} across")
        ax.plot(*pieces(runs, "rear"), "o--", color="C0", mfc="none", label="its rear half")
        for other, mark, color in zip(finer, "s^D", ("C2", "C1", "C4")):
            across = D / float(next(iter(other.values()))["dx"])
            ax.plot(*pieces(other, "apart"), mark + "-", color=color, label=f"sphere, {across:.4g} across")
            ax.plot(*pieces(other, "rear"), mark + "--", color=color, mfc="none")
        if instant:
            ax.plot(*pieces(instant, "apart"), "x-", color="C3", lw=0.8, label="sphere, spall principal")
        ax.set(xlabel="velocity (km/s)", title=f"t/D = {key[0]:g}", ylim=(0, 1.55), yticks=np.linspace(0, 1, 6))
        ax.legend(fontsize=7, frameon=False, loc="upper right")
    np.atleast_1d(axes)[0].set_ylabel("largest piece, part of the mass")
    fig.savefig(path, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "runs")
