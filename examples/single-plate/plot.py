#!/usr/bin/env python3
"""Side view of the cloud, the hole from above, velocity and von Mises stress of a run of in.plate: python3 plot.py [FOLDER] -> plate.png"""
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

folder = sys.argv[1] if len(sys.argv) > 1 else "."
with open(os.path.join(folder, "result.yaml")) as f:
    result = yaml.safe_load(f)
with open(os.path.join(folder, "plate.dump")) as f:
    lines = f.read().splitlines()
start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
data = np.array([line.split() for line in lines[start:]], dtype=float)
kind, (x, y, z), (vx, vy, vz), (p, damage, spalled, vm) = data[:, 1], 1e3 * data[:, 2:5].T, data[:, 5:8].T, data[:, 8:12].T
dx = result["dx_mm"]
slab = np.abs(y) < 2.0
size = 8.0 * dx

fig, axes = plt.subplots(2, 2, figsize=(13, 11))
side, above, speed, stress = axes.flat
for k, color, name in ((2, "tab:blue", "plate"), (1, "tab:red", "projectile")):
    m = slab & (kind == k)
    side.scatter(z[m], x[m], s=size, c=color, lw=0, label=name)
side.legend(loc="upper left")
side.set_title("a slice, at %.1f us" % result["time_us"])
m = (kind == 2) & (np.abs(z) < 10)
above.scatter(x[m], y[m], s=size, c=z[m], cmap="viridis", lw=0)
above.set_title("plate from the front: hole %.1f mm" % result["hole_diameter_mm"])
for ax, value, title, top in ((speed, vz, "axial velocity, m/s", vz.max()), (stress, 1e-6 * vm, "von Mises stress, MPa", 400)):
    dots = ax.scatter(z[slab], x[slab], s=size, c=value[slab], cmap="inferno", vmin=0, vmax=top, lw=0)
    fig.colorbar(dots, ax=ax)
    ax.set_title(title)
for ax in axes.flat:
    ax.set_aspect("equal")
    ax.set_xlabel("x, mm" if ax is above else "z, mm")
    ax.set_ylabel("y, mm" if ax is above else "x, mm")
stress.set_aspect("auto")
stress.set_xlim(-15, 20)
stress.set_ylim(-27, 27)
above.set_xlim(-27, 27)
above.set_ylim(-27, 27)
fig.tight_layout()
fig.savefig(os.path.join(folder, "plate.png"), dpi=80)
