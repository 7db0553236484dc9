# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Tables as text for the eye and as CSV for programs."""

import csv

import numpy as np

from . import units as unit_systems
from .errors import writing


def number(value):
    """A value as text: whole numbers whole, others with six digits."""
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return f"{float(value):.6g}"
    return str(value)


def text(names, rows, quantities=None, units=None, left=False):
    """Columns one under the other, aligned to the right, or left, with a line of units if quantities {name: quantity} are given."""
    lines = [list(names)]
    if quantities and units:
        lines.append([unit_systems.name(quantities.get(name), units) for name in names])
    lines += [[number(value) for value in row] for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(names))]
    aligned = str.ljust if left else str.rjust
    return "\n".join("  ".join(aligned(word, w) for word, w in zip(line, widths)).rstrip() for line in lines)


def write_csv(path, names, rows):
    """A CSV file; numbers with all their digits."""
    with writing(path), open(path, "w", newline="", encoding="utf-8") as stream:
        csv_to(stream, names, rows)


def csv_to(stream, names, rows):
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
