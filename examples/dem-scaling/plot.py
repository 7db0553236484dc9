#!/usr/bin/env python3
"""Draw energy-N-SCALED.dat files side by side: python3 plot.py [folder] -> folder/scaling.png

Prints, for each size, the largest difference of its kinetic energy from that of the finest size.
"""
import glob
import os
import re
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder = sys.argv[1] if len(sys.argv) > 1 else "."
runs = {"yes": {}, "no": {}}
for name in glob.glob(os.path.join(folder, "energy-*-*.dat")):
    n, scaled = re.fullmatch(r"energy-(\d+)-(yes|no)\.dat", os.path.basename(name)).groups()
    runs[scaled][int(n)] = np.loadtxt(name)
if not runs["yes"]:
    sys.exit("no energy-N-yes.dat in " + folder + ": run in.scaling first, see README.md")

fig, axes = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
for ax, scaled, title in zip(axes, ("yes", "no"), ("scaled: eps ~ size$^3$, kappa ~ size", "the same eps and kappa for every size")):
    sizes = sorted(runs[scaled])
    for n, color in zip(sizes, ("C2", "C0", "C3", "C1")):
        d = runs[scaled][n]
        ax.plot(d[:, 0], d[:, 1], color, label="%d layers, kinetic" % n)
        ax.plot(d[:, 0], d[:, 2:5].sum(axis=1), color + "--", label="%d layers, potential + broken" % n)
        fine = runs[scaled][sizes[-1]]
        if n != sizes[-1]:
            diff = np.abs(np.interp(fine[:, 0], d[:, 0], d[:, 1]) - fine[:, 1])
            print("scaled %-3s  %2d against %2d layers: kinetic energy differs by %.3f at most, %.4f on average over time"
                  % (scaled, n, sizes[-1], diff.max(), np.trapz(diff, fine[:, 0]) / fine[-1, 0]))
    ax.set_xlabel("time (us)")
    ax.set_title(title)
    ax.grid(alpha=0.3)
axes[0].set_ylabel("energy / energy at the start")
axes[0].legend(fontsize=7)
fig.tight_layout()
fig.savefig(os.path.join(folder, "scaling.png"), dpi=110)
