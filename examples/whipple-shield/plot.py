#!/usr/bin/env python3
"""What a run of in.whipple has left: python3 plot.py [FOLDER] -> shield.png (slices, walls from the front), probes.png (if there are any)

Quarter models are completed by their mirror images.
"""
import glob
import os
import pathlib
import re
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402

folder = sys.argv[1] if len(sys.argv) > 1 else "."
with open(os.path.join(folder, "result.yaml")) as f:
    result = yaml.safe_load(f)
COLORS = ["tab:red", "tab:blue", "tab:green", "tab:orange", "tab:purple"]
DOT = 4 * max(1.0, result["dx_mm"] / 0.2)  # coarse particles are large


def read(path):
    """rows type x y z, in mm, von Mises stress of the last frame, of the whole"""
    frame = hvi.Dump(path, mirror=["x=0", "y=0"] if result["quarter"] else "none")[-1].whole()
    return np.column_stack([frame["type"], 1e3 * frame.x, frame["vm" if "vm" in frame else "c_state[4]"]])


def slice_of(data):
    """what is near the plane y = 0"""
    return data[np.abs(data[:, 2]) < max(2.0, 1.5 * result["dx_mm"])]


walls, zones = result["walls_reached"], result.get("zones", 1)
final = read(os.path.join(folder, "shield.dump"))
fig, axes = plt.subplots(2, max(walls, 2), figsize=(6.5 * max(walls, 2), 12), squeeze=False)
for ax in axes[:, walls:].flat:
    ax.axis("off")
before = [os.path.join(folder, "cloud%d.dump" % k) for k in range(1, walls)]
frames = [read(path) for path in before] + [final]
wall_of = lambda data: np.where(data[:, 0] == 1, 0, 1 + (data[:, 0] - 2) // zones).astype(int)
for k, (ax, data) in enumerate(zip(axes[0], frames)):
    cut = slice_of(data)
    if k < walls - 1:
        for w, color in zip(range(walls + 1), COLORS):
            m = wall_of(cut) == w
            if not m.any():
                continue
            ax.scatter(cut[m, 3], cut[m, 1], s=DOT, c=color, lw=0, label="wall %d" % w if w else "projectile")
        ax.legend(loc="upper left", fontsize=8)
        ax.set_title("before wall %d, %.1f us" % (k + 2, result["wall%d_until_us" % (k + 1)]))
    else:
        dots = ax.scatter(cut[:, 3], cut[:, 1], s=DOT, c=1e-6 * cut[:, 4], cmap="inferno", vmin=0, vmax=400, lw=0)
        fig.colorbar(dots, ax=ax, label="von Mises stress, MPa", shrink=0.7)
        ax.set_title("at the end, %.1f us" % result["time_us"])
    ax.set_aspect("equal")
    ax.set_xlabel("z, mm")
    ax.set_ylabel("x, mm")
for w, ax in zip(range(1, walls + 1), axes[1]):
    mine = final[wall_of(final) == w]
    middle = np.median(mine[:, 3])
    mine = mine[np.abs(mine[:, 3] - middle) < 5.0]
    dots = ax.scatter(mine[:, 1], mine[:, 2], s=DOT, c=mine[:, 3] - middle, cmap="viridis", lw=0)
    fig.colorbar(dots, ax=ax, label="out of plane, mm", shrink=0.7)
    ax.set_aspect("equal")
    ax.set_title("wall %d from the front: hole %.1f mm" % (w, result["hole%d_diameter_mm" % w]))
    ax.set_xlabel("x, mm")
    ax.set_ylabel("y, mm")
fig.tight_layout()
fig.savefig(os.path.join(folder, "shield.png"), dpi=70)

files = sorted(glob.glob(os.path.join(folder, "probe*_*.dat")), key=lambda path: [int(n) for n in re.findall(r"\d+", os.path.basename(path))])
if files:
    fig, (above, below) = plt.subplots(2, 1, figsize=(8, 8), sharex=True)
    for path in files:
        wall, at = re.match(r"probe(\d+)_(.*)\.dat", os.path.basename(path)).groups()
        t = np.loadtxt(path, ndmin=2)
        above.plot(t[:, 1], 1e-6 * t[:, 2], label="wall %s, %s mm" % (wall, at))
        below.plot(t[:, 1], t[:, 3])
    above.set_ylabel("von Mises stress, MPa")
    below.set_ylabel("velocity across the wall, m/s")
    below.set_xlabel("us")
    above.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(os.path.join(folder, "probes.png"), dpi=80)
