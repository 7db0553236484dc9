#!/usr/bin/env python3
"""Pictures of a run of in.plate, from its frames and result.yaml: python3 plot.py [FOLDER] -> plate.png

A row per frame: plate and projectile, axial velocity, von Mises stress from the side, the plate from the front. From the side
particles of quarter models are at their distance from the axis; of whole ones a slice of 4 mm is shown.
"""
import glob
import os
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402


def read(frame):
    """columns by name, lengths in mm, of the whole"""
    whole = frame.whole()
    return {n: whole[n] * (1e3 if n in "xyz" else 1) for n in ("type", "x", "y", "z", "vz", "vm")}


def main(folder):
    with open(os.path.join(folder, "result.yaml")) as f:
        result = yaml.safe_load(f)
    paths = sorted(glob.glob(os.path.join(folder, "frame.*.dump")))
    found = [hvi.Dump(path)[-1] for path in paths]
    # not the start, nor what a run of other particles has left here: nothing leaves the box
    found = [frame for frame in found[1:] if len(frame) == len(found[0]) and frame.step <= result["steps"]]
    if not found:
        sys.exit(f"no frame.*.dump in {folder}: run in.plate there first")
    quarter = len(found[-1].planes) == 2
    frames = [(1e6 * frame.time, read(frame)) for frame in found]
    for _, d in frames:  # what is shown from the side: of a quarter model all of it
        d["shown"] = d["y"] > 0 if quarter else np.abs(d["y"]) < 2
        d["r"] = np.sign(d["x"]) * np.hypot(d["x"], d["y"]) if quarter else d["x"]
        d["plate"] = (d["type"] == 2) & (np.abs(d["z"]) < 6)
    last = frames[-1][1]
    edge = 1.05 * np.abs(last["x"][last["plate"]]).max()
    z_range, r_range = (-25, max(30, last["z"][last["shown"]].max() + 2)), (-edge, edge)
    fig, axes = plt.subplots(len(frames), 4, figsize=(19, 1.2 + 3.6 * len(frames)), squeeze=False, sharex="col", layout="constrained",
                             gridspec_kw={"width_ratios": (1.2, 1.2, 0.7, 1)})
    for (time, d), (side, speed, stress, above) in zip(frames, axes):
        size, shown, near = 5 * result["dx_mm"], d["shown"], d["shown"] & d["plate"]
        for k, color, what in ((2, "tab:blue", "plate"), (1, "tab:red", "projectile")):
            m = shown & (d["type"] == k)
            side.scatter(d["z"][m], d["r"][m], s=size, c=color, lw=0, label=what)
        fast = speed.scatter(d["z"][shown], d["r"][shown], s=size, c=1e-3 * d["vz"][shown], cmap="inferno_r", vmin=-1, vmax=6, lw=0)
        for ax, x, y, m in ((stress, "z", "r", near), (above, "x", "y", d["plate"])):
            loaded = ax.scatter(d[x][m], d[y][m], s=size, c=1e-6 * d["vm"][m], cmap="viridis", vmin=0, vmax=400, lw=0)
        side.set_title(f"{time:.3g} us", loc="left")
        side.set_ylabel("distance from the axis (mm)" if quarter else "x (mm)")
        above.set_ylabel("y (mm)")
        for ax, x, y in ((side, z_range, r_range), (speed, z_range, r_range), (stress, (-6, 6), r_range), (above, r_range, r_range)):
            ax.set(xlim=x, ylim=y, aspect="auto" if ax is stress else "equal")
    for ax, label in zip(axes[-1], ("z (mm)", "z (mm)", "z (mm), stretched", "x (mm)")):
        ax.set_xlabel(label)
    fig.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper left", ncol=2, markerscale=3)
    fig.colorbar(fast, ax=axes[:, 1], location="top", label="axial velocity (km/s)", shrink=0.8, aspect=40, pad=0.01)
    fig.colorbar(loaded, ax=axes[:, 2:], location="top", label="plate: von Mises stress (MPa); right: from the front", shrink=0.8, aspect=60, pad=0.01)
    what = "all particles, at their distance from the axis" if quarter else "slices of 4 mm through the axis"
    fig.supxlabel(f"spacing {result['dx_mm']:.3g} mm; from the side: {what}; hole at {result['time_us']:.3g} us: {result['hole_diameter_mm']:.1f} mm")
    fig.savefig(os.path.join(folder, "plate.png"), dpi=70)


main(sys.argv[1] if len(sys.argv) > 1 else ".")
