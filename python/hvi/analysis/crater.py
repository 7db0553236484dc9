# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The crater in a thick target: its profile over the radius, depth below the face of the target, diameter in that face."""

import dataclasses
import math

import numpy as np
from scipy.spatial import cKDTree

from ..errors import HVIError
from ..io.frame import axis_number, whole

WIDE = 1.2  # smoothing length, in spacings
AZIMUTHS = 12
STEP = 0.25  # of the points along a line, in spacings
RIM = (0.7, 0.9)  # of the target's radius: where its face is as it was
EDGE = 0.25  # spacings below the face: where the crater ends


@dataclasses.dataclass
class Crater:
    """Lengths in the units of the dump.

    r, floor: (n,) the profile, mean over azimuths of how far the target's surface is along the axis; NaN where there is none
    face: that of the target, at its rim; depth: of the surface on the axis below it; diameter: in it, NaN if there is no crater in it; volume: below it
    toward: the outward side of the face along the axis, -1 or 1
    """

    r: np.ndarray
    floor: np.ndarray
    face: float
    depth: float
    diameter: float
    volume: float
    toward: int


def _kernel(q):
    """cubic spline of the distance in smoothing lengths, in units of 1/h^3"""
    return np.where(q < 1, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(q < 2, 0.25 * (2 - q) ** 3, 0.0)) / math.pi


def _fill(tree, points, spacing):
    """(n,) part of the volume around points (n, 3) that the particles of a tree fill; each has a cube of the spacing"""
    h = WIDE * spacing
    distance, _ = tree.query(points, k=min(96, tree.n), distance_upper_bound=2 * h)
    return _kernel(np.minimum(distance / h, 2.0)).sum(axis=1) / WIDE**3


def _surface(tree, across, deep, high, spacing):
    """where lines along the axis leave the target: (n,) of places across (n, 2); NaN where they are never in it"""
    s = np.arange(deep, high, STEP * spacing)
    points = np.concatenate([np.column_stack([np.broadcast_to(place, (len(s), 2)), s]) for place in across])
    fill = _fill(tree, points, spacing).reshape(len(across), len(s))
    found = np.full(len(across), np.nan)
    for k, line in enumerate(fill):
        inside = np.nonzero(line >= 0.5)[0]
        if len(inside) and inside[0] == 0:  # from the undisturbed matter on
            outside = np.nonzero(line < 0.5)[0]
            last = outside[0] if len(outside) else len(s)
            if last < len(s):
                found[k] = s[last - 1] + STEP * spacing * (line[last - 1] - 0.5) / (line[last - 1] - line[last])
    return found


def measure(source, spacing, types, axis="z", center=(0.0, 0.0), toward=-1):
    """The Crater in the target.

    spacing: of the lattice that the target was made of; types: those of its particles; center: where the axis of the crater is, across it.
    toward: the projectile came from the lower (-1) or the upper side (1) along the axis. The surface is where half of the volume is filled, by a
    cubic kernel of 1.2 spacings, seen from the inside; the target must reach undisturbed around the crater and below it. Mirror planes of the
    record are undone. HVIError: no such particles, or no face at the rim.
    """
    frame = whole(source)
    along = axis_number(axis)
    chosen = frame.of_types(types)
    if chosen.sum() < 2:
        raise HVIError(f"{frame.where}: no two particles of type {', '.join(map(str, types))}")
    x = frame.x[chosen]
    others = [k for k in range(3) if k != along]
    x = np.column_stack([x[:, others] - np.asarray(center), toward * x[:, along]])  # outward is up
    tree = cKDTree(x)
    radius = np.quantile(np.hypot(x[:, 0], x[:, 1]), 0.99)
    if not 1e-4 * radius < spacing < 1e4 * radius:
        raise HVIError(f"{frame.where}: a spacing of {spacing:g} is not that of a target with a radius of {radius:g}")
    deep, high = np.quantile(x[:, 2], 0.01) + 3 * spacing, x[:, 2].max() + 3 * spacing
    turn = 2 * math.pi * (np.arange(AZIMUTHS) + 0.5) / AZIMUTHS
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    r = np.arange(0.0, RIM[1] * radius, 0.5 * spacing)
    with np.errstate(invalid="ignore"):
        lines = [_surface(tree, r_k * ring if r_k else np.zeros((1, 2)), deep, high, spacing) for r_k in r]
    floor = np.array([np.mean(line[~np.isnan(line)]) if (~np.isnan(line)).any() else np.nan for line in lines])
    rim = floor[r >= RIM[0] * radius]
    if not len(rim) or np.isnan(rim).any():
        raise HVIError(f"{frame.where}: the target has no face from {RIM[0]:g} to {RIM[1]:g} of its radius: is it too small for this crater?")
    face = float(np.median(rim))
    below = face - floor
    outside = np.nonzero(~(below > EDGE * spacing))[0]
    diameter, volume = math.nan, 0.0
    if len(outside) and outside[0] > 0:
        k = outside[0]
        edge = r[k - 1] + 0.5 * spacing * (below[k - 1] - EDGE * spacing) / (below[k - 1] - below[k])
        diameter = 2 * edge
        radii, depths = np.append(r[:k], edge), np.append(below[:k], 0.0)
        volume = float(np.sum(math.pi * np.diff(radii**2) * 0.5 * (depths[1:] + depths[:-1])))
    return Crater(r, toward * floor, toward * face, float(below[0]), float(diameter), volume, toward)
