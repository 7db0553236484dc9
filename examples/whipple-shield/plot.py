#!/usr/bin/env python3
"""What a run of hvi shield has left: python3 plot.py FOLDER -> shield.png in the folder of the run (from the side; walls from the front)

Quarter models are completed by their mirror images.
"""
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from hvi.figures import BODIES  # noqa: E402
from hvi.shield.run import Run  # noqa: E402

run = Run(sys.argv[1] if len(sys.argv) > 1 else ".")
result, quarter = run.result, run.result["quarter"] == "yes"
NEAR = 5.0  # mm from the wall that are shown of it
SLAB = max(2.0, 1.5 * run.dx)  # half of the slice of an oblique shot, mm


def rows(scene):
    """body (0: projectile, 1: wall 1, ...) and x y z in mm, of the whole"""
    return np.column_stack([scene.body, scene.x])


def dots(ax, x, y, order, **how):
    """particles a little wider than their spacing on the scale of ax, 1.8 points at least; the last in order is in front"""
    points = 72 * ax.get_position().width * ax.figure.get_figwidth() / np.ptp(ax.get_xlim())
    size = max(1.3 * points * run.dx, 1.8) ** 2
    return ax.scatter(x[order], y[order], s=size, lw=0, rasterized=True, **{k: v[order] if isinstance(v, np.ndarray) else v for k, v in how.items()})


walls = run.reached
reached = range(1, walls + 1)
named = [("before wall %d" % (k + 1), "cloud%d.dump" % k) for k in range(1, walls)] + [("at the end", "shield.dump")]
scenes = [(what, scene) for what, name in named if (scene := run.scene(name))]  # without frames there is only the end
final = rows(scenes[-1][1])
middle = [np.median(final[final[:, 0] == w, 3]) for w in reached]
radius = max(run.of_wall(w, "radius_mm") for w in reached) + NEAR
center = [run.of_wall(w, "middle_mm") for w in reached]
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


for k, (what, scene) in enumerate(scenes):
    ax, data = panel(0, k), rows(scene)
    ax.set(xlim=z_range, ylim=x_range, xlabel="z (mm)", ylabel="distance from the axis (mm)" if quarter else "x (mm)")
    mine = data[data[:, 2] >= 0] if quarter else data[np.abs(data[:, 2]) <= SLAB]
    across = np.sign(mine[:, 1]) * np.hypot(mine[:, 1], mine[:, 2]) if quarter else mine[:, 1]
    color = np.array([BODIES[b % len(BODIES)] for b in range(walls + 1)])[mine[:, 0].astype(int)]
    dots(ax, mine[:, 3], across, np.argsort(-mine[:, 0], kind="stable"), c=color)
    inside = (mine[:, 3] >= z_range[0]) & (mine[:, 3] <= z_range[1]) & (across >= x_range[0]) & (across <= x_range[1])
    ax.set_title("%s, %.1f us (%d of %d particles outside)" % (what, scene.time, np.sum(~inside), len(mine)), fontsize=11)
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
above = "all particles, at their distance from the axis" if quarter else "a slice of %g mm through the axis" % (2 * SLAB)
fig.text(0.5, 0.12 / total[1], "spacing %.3g mm; above: %s; below: what is within %g mm of the wall" % (run.dx, above, NEAR),
         ha="center", fontsize=10 if walls > 1 else 7)
fig.savefig(run.folder / "shield.png", dpi=80)
