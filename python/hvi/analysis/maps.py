# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Velocity maps: how fast what is where. Sums over particles in bins, weighted with mass."""

import dataclasses
from typing import Optional

import numpy as np

from ..errors import HVIError
from ..io.frame import axis_number, whole
from .cloud import beyond

MOST = 10_000  # bins each way


@dataclasses.dataclass
class Map:
    """values: (nx, ny); x, y: edges of the bins, (nx + 1,), (ny + 1,); line: None or one value per bin of x, (nx,)"""

    values: np.ndarray
    x: np.ndarray
    y: np.ndarray
    line: Optional[np.ndarray] = None


def _cloud(source, axis, plane, bins):
    frame = whole(source)
    if plane is not None:
        frame = frame.select(beyond(frame, axis, plane))
    if not len(frame):
        raise HVIError(f"{frame.where}: no particles" + ("" if plane is None else f" beyond {axis} = {plane:g}"))
    if not (min(bins) >= 1 and max(bins) <= MOST):
        raise HVIError(f"a map needs at least one bin each way, {MOST} at most, not {bins[0]} x {bins[1]}")
    return frame, axis_number(axis)


def _edges(values, n):
    low, high = values.min(), values.max()
    if not high > low:  # all at one place
        low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    return np.linspace(low, high, n + 1)


def phase(source, axis, plane=None, bins=(200, 120)):
    """Mass in bins of position along the axis (x) and axial velocity (y); line: mean axial velocity at a position.

    plane: only what is beyond it. Masses in the units of the dump; line is NaN where nothing is.
    """
    frame, along = _cloud(source, axis, plane, bins)
    s, vs, m = frame.x[:, along], frame.v[:, along], frame.m
    x, y = _edges(s, bins[0]), _edges(vs, bins[1])
    mass, _, _ = np.histogram2d(s, vs, (x, y), weights=m)
    momentum, _ = np.histogram(s, x, weights=m * vs)
    column, _ = np.histogram(s, x, weights=m)
    return Map(mass, x, y, _ratio(momentum, column))


def field(source, axis, plane=None, bins=(200, 100)):
    """Mean axial velocity in bins of position along the axis (x) and distance from it (y); NaN where nothing is.

    The axis runs through the center of mass of what is shown. plane: only what is beyond it.
    """
    frame, along = _cloud(source, axis, plane, bins)
    across = [k for k in range(3) if k != along]
    s, vs, m = frame.x[:, along], frame.v[:, along], frame.m
    y = frame.x[:, across] - m @ frame.x[:, across] / m.sum()
    r = np.linalg.norm(y, axis=1)
    edges = _edges(s, bins[0]), np.linspace(0.0, r.max() or 1.0, bins[1] + 1)
    momentum, _, _ = np.histogram2d(s, r, edges, weights=m * vs)
    mass, _, _ = np.histogram2d(s, r, edges, weights=m)
    return Map(_ratio(momentum, mass), *edges)


@dataclasses.dataclass
class Impacts:
    """momentum (along the axis) and energy per area, (n, n) of the edges x (n + 1,) in both directions; summary: dict of totals

    frame: the particles on their way, k of the whole; kinetic: energy of each, (k,); coming: which of the whole these are, a mask
    """

    momentum: np.ndarray
    energy: np.ndarray
    x: np.ndarray
    summary: dict
    frame: object
    kinetic: np.ndarray
    coming: np.ndarray


def impacts(source, axis, plane, bins=80, after=None, reach=None):
    """Where particles on the way to the plane will strike it if they fly on freely: a witness plate.

    after: only particles beyond this coordinate; reach: half the width of the map, default where 99 % of the energy is
    """
    frame = whole(source)
    along = axis_number(axis)
    across = [k for k in range(3) if k != along]
    coming = (frame.x[:, along] < plane) & (frame.v[:, along] > 0.0)
    if after is not None:
        coming &= frame.x[:, along] > after
    frame = frame.select(coming)
    if not len(frame) or not 1 <= bins <= MOST:
        raise HVIError(f"{frame.where}: nothing is on the way to {axis} = {plane:g}" if 1 <= bins <= MOST else f"a map needs bins, {MOST} each way at most, not {bins}")
    m, v = frame.m, frame.v
    flight = (plane - frame.x[:, along]) / v[:, along]
    x = frame.x[:, across] + flight[:, None] * v[:, across]
    p, e = m * v[:, along], 0.5 * frame.mvv2e * m * np.einsum("ij,ij->i", v, v)
    r = np.hypot(*x.T)
    order = np.argsort(r)
    share = np.cumsum(e[order]) / e.sum()
    if reach is None:
        reach = r[order][np.searchsorted(share, 0.99)] or 1.0
    edges = np.linspace(-reach, reach, bins + 1)
    area = (edges[1] - edges[0]) ** 2
    both = [np.histogram2d(*x.T, (edges, edges), weights=w)[0] / area for w in (p, e)]
    return Impacts(*both, edges, {
        "particles": len(m), "mass": m.sum(), "momentum": p.sum(), "kinetic_energy": e.sum(), "first_arrival_in": flight.min(),
        "radius_of_half_the_energy": r[order][np.searchsorted(share, 0.5)],
        "largest_momentum_per_area": both[0].max(), "largest_energy_per_area": both[1].max()},
        frame, e, coming)


def _ratio(a, b):
    return np.divide(a, b, out=np.full_like(a, np.nan), where=b > 0.0)
