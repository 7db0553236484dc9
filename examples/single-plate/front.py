#!/usr/bin/env python3
"""How round the stress front in a plate is: python3 front.py FRAME.dump ... -> a table, front.png beside the first

Von Mises stress over the distance from the axis, in sectors of 10 degrees around 0, 45 and 90 degrees from the x axis, averaged over
the thickness and over rings 2 mm wide.  The front is where it last reaches 10 % of its largest value beyond 15 mm.  Quarter models
and whole ones.
"""
import os
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402

WIDTH, HALF = 2.0, 5.0


def read(path):
    """time in us; type; position in mm; von Mises stress in MPa"""
    frame = hvi.Dump(path)[-1]
    return 1e6 * frame.time, frame["type"], 1e3 * frame.x, 1e-6 * frame["vm"]


def profile(x, vm, angle):
    """centers of the rings, mean stress in them"""
    r, phi = np.hypot(x[:, 0], x[:, 1]), np.degrees(np.arctan2(np.abs(x[:, 1]), np.abs(x[:, 0])))
    m = np.abs(phi - angle) <= HALF
    ring = (r[m] / WIDTH).astype(int)
    n = np.bincount(ring)
    mean = np.bincount(ring, vm[m]) / np.maximum(n, 1)
    return WIDTH * (np.arange(len(n)) + 0.5)[n > 0], mean[n > 0]


def front(r, s):
    beyond = r > 15
    level = 0.1 * s[beyond].max()
    k = np.nonzero(beyond & (s >= level))[0][-1]
    if k + 1 == len(r):
        return r[k]
    return r[k] + (r[k + 1] - r[k]) * (s[k] - level) / (s[k] - s[k + 1])


def main(files):
    fig, axes = plt.subplots(2, len(files), figsize=(6.5 * len(files), 10), squeeze=False, layout="constrained", sharey="row")
    print("frame, front at 0, 45, 90 degrees in mm, 45 over the mean of 0 and 90; stress 5 mm behind it in MPa, likewise")
    for name, (above, curve) in zip(files, axes.T):
        time, kind, x, vm = read(name)
        m = (kind == 2) & (np.abs(x[:, 2]) < 6)
        x, vm = x[m], vm[m]
        ends, stress = [], []
        for angle in (0, 45, 90):
            r, s = profile(x, vm, angle)
            ends.append(front(r, s))
            curve.plot(r, s, "--" if angle == 90 else "-", label=f"{angle} degrees")
        for angle in (0, 45, 90):
            stress.append(np.interp(np.mean(ends) - 5, *profile(x, vm, angle)))
        print(name, *("%.1f" % e for e in ends), "%.3f" % (2 * ends[1] / (ends[0] + ends[2])), *("%.0f" % e for e in stress),
              "%.2f" % (2 * stress[1] / (stress[0] + stress[2])))
        dots = above.scatter(x[:, 0], x[:, 1], c=vm, s=3, lw=0, cmap="viridis", vmin=0, vmax=400)
        above.set(aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title=f"{time:.3g} us")
        curve.set(xlabel="distance from the axis (mm)", ylabel="von Mises stress (MPa)")
        curve.legend(title="mean about, from the x axis")
    fig.colorbar(dots, ax=axes[0], label="von Mises stress (MPa)")
    fig.savefig(os.path.join(os.path.dirname(files[0]) or ".", "front.png"), dpi=70)


if len(sys.argv) < 2:
    sys.exit(__doc__)
main(sys.argv[1:])
