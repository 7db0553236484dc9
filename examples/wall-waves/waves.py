#!/usr/bin/env python3
"""Waves in walls, from waves.dat of in.waves: arrivals, speeds and peaks beside plate theory.

    python3 waves.py FOLDER [--at 60 95 130] [--material Al2024-T3.hvi] [--thickness 0.8] [--share 0.1] [--wall 2] [--table waves1.csv] [--figure waves1.png]
                            [--maps walls1.png]
"""

import argparse
import csv
import os
import pathlib
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, os.environ.get("HVI_PYTHON", str(here.parents[1] / "python")))
from hvi.material import library

NAMES = "us p sxx syy szz sxy sxz syz vm vx vy vz x y z".split()
LONGITUDINAL = ("r mm", "arrival us", "middle of the rise us", "speed since the one before mm/us", "of plate theory", "peak us", "von Mises MPa", "radial stress MPa",
                "radial velocity m/s", "source: von Mises MPa", "over the source's")
DIGITS = (1, 2, 2, 3, 3, 2, 1, 1, 2, 1, 2)
SOURCE = {(1, 60): 74.3, (1, 95): 68.4, (1, 130): 61.9, (2, 60): 63.9, (2, 95): 44.7, (2, 130): 37.2}  # MPa, the source's simulation


def read(path, distances):
    """{(wall, distance): {name: array}}: means of the two probes of a place, at the faces; *_bend: half their difference"""
    blocks, steps, rows = [], [], 0
    with open(path) as stream:
        for line in stream:
            words = line.split()
            if words[0] == "#":
                continue
            if rows == 0:
                rows = int(words[1])
                blocks.append([])
                steps.append(float(words[0]))
            else:
                blocks[-1].append([float(word) for word in words[1:]])
                rows -= 1
    if rows:  # the last one is not complete: the run goes on, or was stopped
        blocks.pop(), steps.pop()
    found = np.array(blocks)
    if found.shape[1] != 4 * len(distances):
        raise SystemExit(f"{path} has {found.shape[1]} probes, not four (two walls, two faces) at each of {len(distances)} distances: see --at")
    records = {}
    for k, distance in enumerate(distances):
        for wall in range(2):
            front, rear = (found[:, 4 * k + 2 * wall + face].T for face in (0, 1))
            record = dict(zip(NAMES, 0.5 * (front + rear)))
            record["step"] = np.array(steps)
            record["r"] = 1e3 * np.hypot(record["x"][0], record["y"][0])  # of the element, which is where its center is
            record.update({f"{name}_bend": half for name, half in zip(NAMES[1:], 0.5 * (rear - front)[1:])})
            records[wall + 1, distance] = record
    return records


class Plate:
    """Waves of small amplitude in a plate of a material; mm and us"""

    def __init__(self, material, thickness):
        law = library.read(material)
        eos = law.in_si(("eos", "gruneisen"))
        rho, K, G = eos["rho0"], eos["rho0"] * eos["C"] ** 2, law.in_si(("strength", "johnson-cook"))["G"]
        self.rho, self.h = rho, thickness
        self.E, self.nu = 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G)
        self.plate = 1e-3 * np.sqrt(self.E / (rho * (1 - self.nu**2)))
        self.bulk = 1e-3 * np.sqrt((K + 4 / 3 * G) / rho)
        self.shear = 1e-3 * np.sqrt(G / rho)

    def frequency(self, k):
        """omega of the bending wave with k = 2 pi/length (Mindlin, shear correction pi^2/12):
        (k^2 - omega^2/(kappa c_s^2)) (k^2 - omega^2/c_p^2) = 12 omega^2/(h c_p)^2"""
        p, s = 1 / self.plate**2, 12 / (np.pi * self.shear) ** 2
        a, b = p * s, k**2 * (p + s) + 12 * p / self.h**2
        return np.sqrt((b - np.sqrt(b**2 - 4 * a * k**4)) / (2 * a))

    def bends(self, omega):
        """(speed of the group, wave length) of the bending wave with this omega"""
        k = np.geomspace(1e-3, 3 / self.h, 4000)
        return np.interp(omega, self.frequency(k), np.gradient(self.frequency(k), k)), 2 * np.pi / np.interp(omega, self.frequency(k), k)


def first_peak(t, y):
    """index of the first local maximum of half the largest value of the time that is looked at, or more"""
    inner = (y[1:-1] >= y[:-2]) & (y[1:-1] > y[2:]) & (y[1:-1] >= 0.5 * y.max())
    return 1 + int(np.argmax(inner)) if inner.any() else int(np.argmax(y))


def arrival(t, y, share):
    """(time at which y has come to this share of its first peak, time and value of the peak)"""
    peak = first_peak(t, y)
    first = int(np.argmax(y[: peak + 1] >= share * y[peak]))
    low, high = y[first - 1], y[first]
    return t[first - 1] + (share * y[peak] - low) / (high - low) * (t[first] - t[first - 1]), t[peak], y[peak]


def crossings(t, y):
    """times at which y changes its sign"""
    k = np.flatnonzero(y[:-1] * y[1:] < 0)
    return t[k] - y[k] * (t[k + 1] - t[k]) / (y[k + 1] - y[k])


def membrane(record, share, until):
    """(arrival, middle of the rise, time of the peak, its von Mises and radial stress in MPa, largest radial velocity in m/s) of the longitudinal wave

    arrival: a share of the peak; the head of a pulse that widens runs ahead, so that speeds are those of the middle, half of the peak
    """
    early = record["us"] < until
    t, vm = record["us"][early], record["vm"][early]
    when, at, peak = arrival(t, vm, share)
    k = first_peak(t, vm)
    return when, arrival(t, vm, 0.5)[0], at, 1e-6 * peak, 1e-6 * record["sxx"][early][k], record["vx"][early].max()


def passing(record, least=0.01):
    """(times, omega): when the velocity across the wall has which frequency, from its crossings of zero, where it is not below this share of its peak"""
    t, v = record["us"], record["vz"]
    times = crossings(t, v)
    strong = [np.abs(v[(t >= a) & (t <= b)]).max(initial=0) >= least * np.abs(v).max() for a, b in zip(times[:-1], times[1:])]
    times, omega = 0.5 * (times[1:] + times[:-1])[strong], (np.pi / np.diff(times))[strong]
    falls = np.append(np.diff(omega) < 0, True)  # fast waves are short ones; what comes back from the edge is not looked at
    last = len(falls) if falls.all() else int(np.argmin(falls)) + 1
    return times[:last], omega[:last]


def bending(near, far, plate):
    """rows (omega, length, speed of the group between two probes, the same by Mindlin) for the frequencies that were seen at both"""
    (t1, w1), (t2, w2) = passing(near), passing(far)
    rows = []
    for omega in w2:
        if len(w1) > 1 and w1.min() <= omega <= w1.max():
            speed, length = plate.bends(omega)
            passed = np.interp(-omega, -w1, t1)
            rows.append((omega, length, (far["r"] - near["r"]) / (np.interp(-omega, -w2, t2) - passed), speed))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--at", type=float, nargs="+", default=[60, 95, 130], help="distances of the probes, mm")
    parser.add_argument("--material", default="Al2024-T3.hvi")
    parser.add_argument("--thickness", type=float, default=0.8, help="mm")
    parser.add_argument("--share", type=float, default=0.1, help="of the first peak of von Mises stress, which counts as arrival")
    parser.add_argument("--side", type=float, default=300, help="of the walls, mm: what comes back from the edge is left out")
    parser.add_argument("--wall", type=int, choices=(1, 2), help="this one alone")
    parser.add_argument("--table", help="writes the longitudinal wave as CSV")
    parser.add_argument("--figure", help="draws the records")
    parser.add_argument("--maps", help="draws the walls, from elements.*.dump")
    args = parser.parse_args()
    records = read(os.path.join(args.folder, "waves.dat"), args.at)
    records = {place: record for place, record in records.items() if args.wall in (None, place[0])}
    if not records:
        raise SystemExit(f"{args.folder} has no wall {args.wall}")
    plate = Plate(args.material, args.thickness)
    print(f"{args.material}: E {1e-9 * plate.E:.1f} GPa, nu {plate.nu:.3f}; speeds mm/us: plate {plate.plate:.3f}, "
          f"bulk {plate.bulk:.3f}, shear {plate.shear:.3f}, bending at most {plate.shear * np.pi / np.sqrt(12):.2f}")
    struck, table = {}, []
    for wall in sorted({w for w, _ in records}):
        nearest = records[wall, min(args.at)]
        struck[wall] = membrane(nearest, args.share, np.inf)[0] - nearest["r"] / plate.plate
        print(f"\nwall {wall}, longitudinal wave\n\n| {' | '.join(LONGITUDINAL)} |\n|{'---|' * len(LONGITUDINAL)}")
        before = None
        for distance in args.at:
            record = records[wall, distance]
            until = struck[wall] + (args.side - record["r"]) / plate.plate  # from the edge
            row = membrane(record, args.share, until)
            speed = (record["r"] - before[0]) / (row[1] - before[1]) if before else np.nan
            other = SOURCE.get((wall, distance), np.nan)
            values = [f"{x:.{n}f}" if np.isfinite(x) else "" for x, n in zip((record["r"], *row[:2], speed, speed / plate.plate, *row[2:], other, row[3] / other), DIGITS)]
            print("| " + " | ".join(values) + " |")
            table.append([wall, f"{distance:g}", *values])
            before = record["r"], row[1]
        print(f"\nwall {wall}, bending: speed of the group between two probes, mm/us\n\n| from | to mm | 1/us | length mm | measured | Mindlin | ratio |\n|---|---|---|---|---|---|---|")
        ranges = []
        for near, far in zip(args.at[:-1], args.at[1:]):
            rows = bending(records[wall, near], records[wall, far], plate)
            for omega, length, speed, theory in rows:
                print(f"| {near:g} | {far:g} | {omega:.3f} | {length:.1f} | {speed:.3f} | {theory:.3f} | {speed / theory:.3f} |")
            if rows:
                _, length, speed, theory = np.array(rows).T
                ranges.append(f"wall {wall}, bending, {near:g} to {far:g} mm: length {length.min():.1f} to {length.max():.1f} mm, ratio {(speed / theory).min():.2f} to {(speed / theory).max():.2f}")
        print("", *ranges, sep="\n")
    if args.table:
        with open(args.table, "w", newline="") as out:
            csv.writer(out, lineterminator="\n").writerows([["wall", "at mm", *LONGITUDINAL], *table])
    found = pathlib.Path(args.folder, "result.yaml"), pathlib.Path(args.folder, "log.lammps")
    if all(path.exists() for path in found):
        print(f"\nenergy - 1: at the end {float(re.search(r'energy_ratio: (.+?),', found[0].read_text())[1]) - 1:.1e}, largest of the rows of {found[1].name} {largest_drift(found[1]):.1e}")
    if args.figure:
        draw(args, records, plate, struck)
    if args.maps:
        maps(args, records)


def largest_drift(log):
    """what c_book[9] of thermo is off 1 where it is farthest"""
    rows, column = [0.0], None
    for words in (line.split() for line in log.read_text().splitlines()):
        if words[:1] == ["Step"]:
            column = words.index("c_book[9]")
        elif words[:2] == ["Loop", "time"]:
            column = None
        elif column is not None and len(words) > column and words[0].isdigit():
            rows.append(float(words[column]) - 1)
    return max(rows, key=abs)


def maps(args, records):
    """von Mises stress of the elements of each wall at the times of the dumps, in the quarter that is computed"""
    files = sorted(pathlib.Path(args.folder).glob("elements.*.dump"), key=lambda path: int(path.name.split(".")[1]))[1:]
    some = next(iter(records.values()))
    walls = sorted({wall for wall, _ in records})
    tables = [np.loadtxt(path, skiprows=9) for path in files]  # id type x y z p sxx ... vm eps damage e n
    figure, axes = plt.subplots(len(walls), len(files), figsize=(2.6 * len(files) + 1, 2.6 * len(walls)), sharex=True, sharey=True, squeeze=False)
    for column, (path, table) in enumerate(zip(files, tables)):
        for row, wall in enumerate(walls):
            axis, mine = axes[row, column], table[:, 1] == 2 * wall  # type of its material
            x, y, vm = 1e3 * table[mine, 2], 1e3 * table[mine, 3], 1e-6 * table[mine, 12]
            image = axis.scatter(x, y, c=vm, s=6, marker="s", vmin=0, vmax=100, linewidths=0, rasterized=True)
            axis.plot(args.at, [0.8] * len(args.at), "r|", ms=6)
            axis.set_aspect("equal")
            if row == 0:
                axis.set_title(f"{np.interp(int(path.name.split('.')[1]), some['step'], some['us']):.0f} us", fontsize=10)
            if column == 0:
                axis.set_ylabel(f"wall {wall}, mm")
    figure.colorbar(image, ax=axes, label="von Mises stress, MPa", shrink=0.8)
    figure.savefig(args.maps, dpi=75, bbox_inches="tight")


def draw(args, records, plate, struck):
    walls = sorted({w for w, _ in records})
    what = (("sxx", 1e-6, "radial stress, MPa"), ("vm", 1e-6, "von Mises stress, MPa"), ("vx", 1, "radial velocity, m/s"), ("vz", 1, "velocity across the wall, m/s"))
    figure, axes = plt.subplots(len(what), len(walls), figsize=(6.5 * len(walls), 10), sharex=True, squeeze=False)
    for column, wall in enumerate(walls):
        for row, (name, factor, label) in enumerate(what):
            axis = axes[row, column]
            for k, distance in enumerate(args.at):
                r = records[wall, distance]
                axis.plot(r["us"], factor * r[name], f"C{k}", lw=1.2, label=f"{distance:g} mm")
                speed = plate.shear * np.pi / np.sqrt(12) if name == "vz" else plate.plate
                axis.axvline(struck[wall] + distance / speed, color=f"C{k}", lw=0.7, ls=":")
            axis.set_ylabel(label)
        axes[0, column].set_title(f"wall {wall}")
        axes[0, column].legend(frameon=False)
        axes[-1, column].set_xlabel("time, us")
    figure.tight_layout()
    figure.savefig(args.figure, dpi=90)


if __name__ == "__main__":
    main()
