# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Mirror planes: of which part of a scene a file is, and how it says so.

A dump says it in columns with the same number in every row, that of the plane's coordinate: mirror_x_lo (all particles are
above it) or mirror_x_hi, and so for y and z; or mirror_none. Its time is in the column time_UNITS, like time_si. Both are
columns, not items of the header, because MDAnalysis takes no header but the shortest. A data file says it in its first line:
mirror x 0 lo mirror y 0 lo, the words of pair_style hvi/sph, or mirror none.
"""

import dataclasses
import re

import numpy as np

from ..errors import HVIError
from ..units import MVV2E

_COLUMN = re.compile(r"mirror_(?:none|([xyz])_(lo|hi))")
_TITLE = re.compile(r"\bmirror (?:none|([xyz]) (\S+) (lo|hi))\b")
_NAMES = ("whole", "half", "quarter", "eighth")
LAYER = 0.1  # a face has at least this share of n^(2/3) particles, n of them in all


@dataclasses.dataclass(frozen=True)
class Plane:
    """axis: 0, 1, 2 for x, y, z; at: coordinate; side: "lo" if what is there is above it, "hi" if below"""

    axis: int
    at: float
    side: str = "lo"

    def __str__(self):
        return f"mirror {'xyz'[self.axis]} {self.at:.10g} {self.side}"

    def depth(self, x):
        """Distances (n,) of particles x (n, 3) from the plane, > 0 on their side of it."""
        return x[:, self.axis] - self.at if self.side == "lo" else self.at - x[:, self.axis]


def checked(planes, where):
    """The same, in order of their axes; HVIError if there are two of an axis or one is not at a number."""
    planes = tuple(sorted(planes, key=lambda plane: plane.axis))
    if len({plane.axis for plane in planes}) < len(planes) or not np.isfinite([plane.at for plane in planes]).all():
        raise HVIError(f"{where}: mirror planes must be one for each of x, y, z at most, each at a number: {text(planes)}")
    return planes


def of_row(names, row, where):
    """(planes or None, time or None, units or None) from the columns names of a dump and its first row of words."""
    planes, said, time, units = [], False, None, None
    for name, word in zip(names, row):
        found = _COLUMN.fullmatch(name)
        if found:
            said = True
            if found[1]:
                planes.append(Plane("xyz".index(found[1]), float(word), found[2]))
        elif name.startswith("time_") and name[5:] in MVV2E:
            time, units = float(word), name[5:]
    return checked(planes, where) if said else None, time, units


def of_title(title, where):
    """Planes from the first line of a data file, None if it does not say."""
    found = _TITLE.findall(title)
    try:
        return checked([Plane("xyz".index(axis), float(at), side) for axis, at, side in found if axis], where) if found else None
    except ValueError:
        raise HVIError(f"{where}: a mirror plane must be at a number: {title.strip()}") from None


def of_words(words):
    """Planes from what the user says: planes, or words like "none", "x=0", "y=1e-3,hi"; None stays None."""
    if words is None:
        return None
    words = [words] if isinstance(words, (str, Plane)) else list(words)
    planes = []
    if "none" in words and len(words) > 1:
        raise HVIError("mirror none and mirror planes contradict each other")
    for word in words:
        found = re.fullmatch(r"([xyz])=([^,]+)(?:,(lo|hi))?", word) if isinstance(word, str) else None
        try:
            if isinstance(word, Plane):
                planes.append(word)
            elif word != "none":
                planes.append(Plane("xyz".index(found[1]), float(found[2]), found[3] or "lo"))
        except (TypeError, ValueError):
            raise HVIError(f"a mirror plane is said like x=0 or y=1e-3,hi, or none, not {word}") from None
    return checked(planes, "mirror")


def text(planes):
    """'quarter (mirror x 0 lo, mirror y 0 lo)', 'whole', 'not said'"""
    if planes is None:
        return "not said"
    return _NAMES[min(len(planes), 3)] + (f" ({', '.join(map(str, planes))})" if planes else "")


def images(planes):
    """(bits, signs (3,)) of the part and of each of its images: bit b is set if it is behind planes[b]; the part is the first."""
    for bits in range(1 << len(planes)):
        signs = np.ones(3)
        for b, plane in enumerate(planes):
            if bits >> b & 1:
                signs[plane.axis] = -1.0
        yield bits, signs


def suspects(x, periodic):
    """Planes at 0 in which particles x (n, 3) could well have images: all are on one side, many of them right at it."""
    from scipy.spatial import cKDTree

    planes, step = [], None
    for axis in range(3):
        low, high = (x[:, axis].min(), x[:, axis].max()) if len(x) > 1 else (0.0, 0.0)
        if periodic[axis] or not (low > 0.0 or high < 0.0) or low == high:
            continue
        if step is None:
            step = np.percentile(cKDTree(x).query(x[:: max(len(x) // 2000, 1)], k=2)[0][:, 1], 10)  # in a solid its spacing
        plane = Plane(axis, 0.0, "lo" if low > 0.0 else "hi")
        if np.sum(plane.depth(x) < 0.75 * step) > max(3.0, LAYER * len(x) ** (2 / 3)):
            planes.append(plane)
    return tuple(planes)
