#!/usr/bin/env python3
"""Tables of studies, from what hvi sweep has written: python3 studies/means.py runs/NAME.csv... -> runs/NAME-table.csv, runs/NAME-means.csv

NAME-table.csv has a run per line, with these columns more:

    mean_error_percent    mean of the magnitudes of the relative errors of hole, front, length and diameter of CEG test 3
    hole_of_fit_percent   hole over the fit of experiments (README.md, "Fragments, holes, stress fronts"), less 100
    energy_off            energy over that at the start, less 1

NAME-means.csv has the means of runs that differ in the shift of the lattice alone, and half of their range (columns *_half).
"""

import csv
import statistics
import sys

MEASURED = {"hole_diameter_mm": 18.9, "front_velocity_m_s": 5296.0, "cloud_length_mm": 81.1, "cloud_diameter_mm": 65.6}
MEANS = ("steps", *MEASURED, "mean_error_percent", "energy_off", "energy_missed_ratio")
GIVEN = {"D": 10.0, "t": 2.0, "v0": 5941.0}  # of in.plate


def complete(row):
    given = {name: float(row.get(name) or value) for name, value in GIVEN.items()}
    fit = given["D"] * (2.8 * (given["v0"] / 5240) ** 0.448 * (given["t"] / given["D"]) ** 0.516 + 0.6)
    errors = [abs(float(row[name]) / value - 1) for name, value in MEASURED.items()]
    return {**row, "mean_error_percent": f"{100 * statistics.mean(errors):.3f}", "hole_of_fit_percent": f"{100 * (float(row['hole_diameter_mm']) / fit - 1):.2f}",
            "energy_off": f"{float(row['energy_ratio']) - 1:.1e}"}


def means(rows):
    groups = {}
    for row in rows:
        groups.setdefault("_".join(part for part in row["job"].split("_") if not part.startswith("shift-")), []).append(row)
    for job, some in groups.items():
        values = {name: [float(row[name]) for row in some] for name in MEANS}
        yield {"job": job, "runs": len(some), **{name: f"{statistics.mean(v):.9g}" for name, v in values.items()},
               **{f"{name}_half": f"{0.5 * (max(v) - min(v)):.3g}" for name, v in values.items()}}


def write(path, rows):
    with open(path, "w", newline="") as out:
        writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"{path}: {len(rows)} rows")


for table in sys.argv[1:] or sys.exit(__doc__):
    with open(table, newline="") as found:
        runs = [complete(row) for row in csv.DictReader(found)]
    write(table.replace(".csv", "-table.csv"), runs)
    write(table.replace(".csv", "-means.csv"), list(means(runs)))
