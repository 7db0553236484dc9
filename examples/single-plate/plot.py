#!/usr/bin/env python3
"""Pictures of a run of in.plate, from its frames and result.yaml: python3 plot.py [FOLDER] -> plate.png

A row per frame: a slice of 4 mm with plate and projectile, axial velocity, von Mises stress; the plate from the front.
Quarter models are mirrored.
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


def read(path, quarter):
    """columns by name, lengths in mm, of the whole"""
    frame = hvi.Dump(path, mirror=["x=0", "y=0"] if quarter else "none")[-1].whole()
    d = {n: frame["vm" if "vm" in frame else "c_state[4]"] if n == "vm" else frame[n] for n in ("type", "x", "y", "z", "vz", "vm")}
    return {n: a * (1e3 if n in "xyz" else 1) for n, a in d.items()}


def main(folder):
    with open(os.path.join(folder, "result.yaml")) as f:
        result = yaml.safe_load(f)
    files = glob.glob(os.path.join(folder, "frame.*.dump"))
    frames = sorted((float(os.path.basename(f)[6:-5]), f) for f in files if float(os.path.basename(f)[6:-5]) <= result["time_us"] + 0.01)
    if not frames:
        sys.exit(f"no frame.*.dump in {folder}: run in.plate there first")
    fig, axes = plt.subplots(len(frames), 4, figsize=(19, 4.4 * len(frames)), squeeze=False)
    for row, (time, name) in zip(axes, frames):
        d = read(name, result["model_share"] < 1)
        slab, size = np.abs(d["y"]) < 2, 5 * result["dx_mm"]
        side, speed, stress, above = row
        for k, color, what in ((2, "tab:blue", "plate"), (1, "tab:red", "projectile")):
            m = slab & (d["type"] == k)
            side.scatter(d["z"][m], d["x"][m], s=size, c=color, lw=0, label=what)
        side.legend(loc="upper left")
        side.set_title(f"{time:g} us")
        dots = speed.scatter(d["z"][slab], d["x"][slab], s=size, c=d["vz"][slab], cmap="inferno", vmin=0, lw=0)
        fig.colorbar(dots, ax=speed)
        speed.set_title("axial velocity, m/s")
        m = d["type"] == 2
        near = m & (np.abs(d["z"]) < 6)
        dots = stress.scatter(d["z"][slab & near], d["x"][slab & near], s=2 * size, c=1e-6 * d["vm"][slab & near], cmap="viridis", vmin=0, vmax=400, lw=0)
        fig.colorbar(dots, ax=stress)
        stress.set_title("plate: von Mises stress, MPa")
        top = near & (d["z"] < 6)
        dots = above.scatter(d["x"][top], d["y"][top], s=size, c=1e-6 * d["vm"][top], cmap="viridis", vmin=0, vmax=400, lw=0)
        fig.colorbar(dots, ax=above)
        above.set_title("from the front, von Mises stress, MPa" + (f"; hole {result['hole_diameter_mm']:.1f} mm" if name == frames[-1][1] else ""))
        for ax in row:
            ax.set_aspect("auto" if ax is stress else "equal")
            ax.set_xlabel("x, mm" if ax is above else "z, mm")
            ax.set_ylabel("y, mm" if ax is above else "x, mm")
    fig.tight_layout()
    fig.savefig(os.path.join(folder, "plate.png"), dpi=70)


main(sys.argv[1] if len(sys.argv) > 1 else ".")
