#!/usr/bin/env python3
"""What a run of in.whipple has left: python3 plot.py [FOLDER] -> shield.png (from the side; walls from the front), probes.png (if there are any)

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
from matplotlib.lines import Line2D

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402
from hvi.figures import BODIES  # noqa: E402

folder = sys.argv[1] if len(sys.argv) > 1 else "."
with open(os.path.join(folder, "result.yaml")) as f:
    result = yaml.safe_load(f)
with open(os.path.join(folder, "plan.yaml")) as f:
    plan = yaml.safe_load(f)
NEAR = 5.0  # mm from the wall that are shown of it
SLAB = max(2.0, 1.5 * result["dx_mm"])  # half of the slice of an oblique shot, mm


def read(path):
    """rows of body (0: projectile, 1: wall 1, ...) and x y z in mm, of the whole"""
    frame = hvi.Dump(path, mirror=["x=0", "y=0"] if result["quarter"] else "none")[-1].whole()
    body = np.where(frame["type"] == 1, 0, 1 + (frame["type"] - 2) // result.get("zones", 1))
    return np.column_stack([body, 1e3 * frame.x])


def dots(ax, x, y, order, **how):
    """particles a little wider than their spacing on the scale of ax, 1.8 points at least; the last in order is in front"""
    points = 72 * ax.get_position().width * ax.figure.get_figwidth() / np.ptp(ax.get_xlim())
    size = max(1.3 * points * result["dx_mm"], 1.8) ** 2
    return ax.scatter(x[order], y[order], s=size, lw=0, rasterized=True, **{k: v[order] if isinstance(v, np.ndarray) else v for k, v in how.items()})


walls = result["walls_reached"]
reached = range(1, walls + 1)
names = ["cloud%d.dump" % k for k in range(1, walls)] + ["shield.dump"]
frames = [read(os.path.join(folder, name)) for name in names]
final = frames[-1]
middle = [np.median(final[final[:, 0] == w, 3]) for w in reached]
radius = max(plan["wall%d_radius_mm" % w] for w in reached) + NEAR
center = [plan["wall%d_middle_mm" % w] for w in reached]
x_range = min(center) - radius, max(center) + radius
z_range = middle[0] - 0.5 * radius, middle[-1] + radius

# a row of side views with one frame, a row of walls with one frame; heights in inches
columns, wide, gap, left, right, below, head, bar = walls, 5.4, 0.7, 0.7, 0.9, 0.75, 0.75, 0.15
high = [wide * np.ptp(x_range) / np.ptp(z_range), wide * 2 * radius / np.ptp(x_range)]
total = left + columns * wide + (columns - 1) * gap + right, below + sum(high) + 1.0 + head
fig = plt.figure(figsize=total)


def panel(row, column):
    bottom = below + (high[1] + 1.0) * (row == 0)
    return fig.add_axes(((left + column * (wide + gap)) / total[0], bottom / total[1], wide / total[0], high[row] / total[1]))


for k, data in enumerate(frames):
    ax = panel(0, k)
    ax.set(xlim=z_range, ylim=x_range, xlabel="z (mm)", ylabel="distance from the axis (mm)" if result["quarter"] else "x (mm)")
    mine = data[data[:, 2] >= 0] if result["quarter"] else data[np.abs(data[:, 2]) <= SLAB]
    across = np.sign(mine[:, 1]) * np.hypot(mine[:, 1], mine[:, 2]) if result["quarter"] else mine[:, 1]
    color = np.array([BODIES[b % len(BODIES)] for b in range(walls + 1)])[mine[:, 0].astype(int)]
    dots(ax, mine[:, 3], across, np.argsort(-mine[:, 0], kind="stable"), c=color)
    inside = (mine[:, 3] >= z_range[0]) & (mine[:, 3] <= z_range[1]) & (across >= x_range[0]) & (across <= x_range[1])
    when = result["wall%d_until_us" % (k + 1)] if k < walls - 1 else result["time_us"]
    what = "before wall %d" % (k + 2) if k < walls - 1 else "at the end"
    ax.set_title("%s, %.1f us (%d of %d particles outside)" % (what, when, np.sum(~inside), len(mine)), fontsize=11)
for w in reached:
    ax = panel(1, w - 1)
    ax.set(xlim=x_range, ylim=(-radius, radius), xlabel="x (mm)", ylabel="y (mm)")
    mine = final[(final[:, 0] == w) & (np.abs(final[:, 3] - middle[w - 1]) <= NEAR)]
    shown = dots(ax, mine[:, 1], mine[:, 2], np.argsort(-mine[:, 3]), c=mine[:, 3] - middle[w - 1], cmap="coolwarm", vmin=-NEAR, vmax=NEAR)
    hole = result["hole%d_diameter_mm" % w]
    ax.set_title("wall %d from the front, %.1f us: hole %s" % (w, result["time_us"], "unknown" if np.isnan(hole) else "%.1f mm" % hole), fontsize=11)
where = (left + walls * wide + (walls - 1) * gap + 0.15) / total[0], below / total[1], bar / total[0], high[1] / total[1]
fig.colorbar(shown, cax=fig.add_axes(where), label="z from the wall's median (mm)")
marks = [Line2D([], [], marker="o", ls="", color=BODIES[w % len(BODIES)], label="wall %d" % w if w else "projectile") for w in range(walls + 1)]
fig.legend(handles=marks, loc="upper center", ncol=walls + 1, frameon=False, bbox_to_anchor=(0.5, 1.0))
above = "all particles, at their distance from the axis" if result["quarter"] else "a slice of %g mm through the axis" % (2 * SLAB)
fig.text(0.5, 0.12 / total[1], "spacing %.3g mm; above: %s; below: what is within %g mm of the wall" % (result["dx_mm"], above, NEAR),
         ha="center", fontsize=10 if walls > 1 else 7)
fig.savefig(os.path.join(folder, "shield.png"), dpi=80)

files = sorted(glob.glob(os.path.join(folder, "probe*_*.dat")), key=lambda path: [int(n) for n in re.findall(r"\d+", os.path.basename(path))])
if files:
    fig, (above, below) = plt.subplots(2, 1, figsize=(8, 8), sharex=True)
    for path in files:
        wall, at = re.match(r"probe(\d+)_(.*)\.dat", os.path.basename(path)).groups()
        t = np.loadtxt(path, ndmin=2)
        above.plot(t[:, 1], 1e-6 * t[:, 2], label="wall %s, %s mm" % (wall, at))
        below.plot(t[:, 1], t[:, 3])
    above.set_ylabel("von Mises stress (MPa)")
    below.set_ylabel("velocity across the wall (m/s)")
    below.set_xlabel("time (us)")
    above.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(os.path.join(folder, "probes.png"), dpi=80)
