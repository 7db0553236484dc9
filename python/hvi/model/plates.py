# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Plates for SPH: square lattices in layers, each turned by its own angle, coarser outward; written as LAMMPS data files."""

import dataclasses

import numpy as np

from ..errors import HVIError
from . import bodies


@dataclasses.dataclass
class Plate:
    """x: (n, 3), across z from 0 to thickness; type: (n,), 1 in the middle; volume: of a particle of each type, (types,)

    spacing: in the plane, of each type, (types,); step: through the thickness; angles: of the layers, degrees, (layers,)
    """

    x: np.ndarray
    type: np.ndarray
    volume: np.ndarray
    spacing: np.ndarray
    step: float
    angles: np.ndarray
    radius: float
    quarter: bool


def stack(angles, layers):
    """Angle of each of the layers, (layers,).

    As many angles as layers are taken as they are. Fewer are repeated up to the middle and mirrored there, so that the
    stack is symmetric, and balanced: each angle as often as the others. 0 45 in 8 layers: 0 45 0 45 45 0 45 0.
    """
    angles = np.atleast_1d(np.asarray(angles, dtype=float))
    if len(angles) == layers:
        return angles
    if len(angles) == 1:
        return np.repeat(angles, layers)
    if layers % (2 * len(angles)):
        raise HVIError(f"a symmetric and balanced stack of {len(angles)} angles has a multiple of {2 * len(angles)} layers, "
                       f"not {layers}; or give an angle for each layer")
    half = np.tile(angles, layers // (2 * len(angles)))
    return np.concatenate([half, half[::-1]])


def make(radius, thickness, spacing, layers=None, angles=(0.0,), zones=(), quarter=False):
    """A round Plate.

    spacing: in the plane, in the middle; layers: how many through the thickness (default: as thick as wide, or thinner)
    angles: see stack(); zones: radii, beyond each of which the spacing in the plane is twice that before, a type each
    quarter: only x > 0, y > 0, for mirrors in x = 0 and y = 0

    Cells tile the plane: a wide one is either one particle or four narrow ones, so nothing overlaps and no mass is
    missing where zones meet. The edge is that of the cells.
    """
    if layers is None:
        layers = max(1, int(np.ceil(min(thickness / spacing, bodies.MOST) - 0.01)))
    if layers < 1:
        raise HVIError(f"a plate has at least one layer, not {layers}")
    if not (0.0 < thickness and 0.0 < spacing <= radius):
        raise HVIError(f"a plate needs a thickness > 0 and a spacing that fits its radius, not {thickness:g}, {spacing:g}, {radius:g}")
    bodies.refuse_many(np.pi * (radius / spacing) ** 2 * layers if radius / spacing < bodies.MOST else np.inf)  # without zones
    zones = np.asarray(zones, dtype=float)
    if not np.isfinite(np.asarray(angles, dtype=float)).all():
        raise HVIError(f"angles must be numbers of degrees, not {' '.join(f'{a:g}' for a in np.atleast_1d(angles))}")
    if len(zones) and not (zones[0] > 0.0 and (np.diff(zones) > 0.0).all() and zones[-1] < radius):
        raise HVIError(f"the radii of zones must rise and be below that of the plate, {radius:g}: {' '.join(f'{r:g}' for r in zones)}")
    turns = stack(angles, layers)
    wide = spacing * 2.0 ** np.arange(len(zones) + 1)
    made = {turn: _layer(turn, radius, wide, zones, quarter) for turn in np.unique(turns)}
    step = thickness / layers
    sheets = [np.column_stack([made[turn][0], np.full(len(made[turn][0]), (k + 0.5) * step)]) for k, turn in enumerate(turns)]
    return Plate(np.concatenate(sheets), np.concatenate([made[turn][1] for turn in turns]), wide**2 * step, wide, step, turns,
                 radius, quarter)


def _layer(turn, radius, wide, zones, quarter):
    """Places in the plane (n, 2) and types (n,) of a layer turned by so many degrees."""
    coarse = wide[-1]
    n = int(np.ceil(radius / coarse)) + 2
    grid = np.arange(-n, n) + 0.5
    shift = 0.0
    if quarter and turn % 90.0:
        if turn % 45.0 or len(zones):
            raise HVIError(f"a layer at {turn:g} degrees{' with zones' if len(zones) else ''} has no mirrors: quarter plates can have "
                           "0, 90 and, without zones, 45 degrees")
        shift = np.sqrt(0.125) * wide[0]  # else its diagonals would lie in the mirrors
    cells = coarse * np.stack(np.meshgrid(grid, grid, indexing="ij"), -1).reshape(-1, 2)
    places, types = [], []
    for k in range(len(wide) - 1, -1, -1):
        stay = np.hypot(*cells.T) > zones[k - 1] if k else np.ones(len(cells), dtype=bool)
        places.append(cells[stay])
        types.append(np.full(stay.sum(), k + 1))
        quarters = 0.25 * wide[k] * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])
        cells = (cells[~stay][:, None, :] + quarters).reshape(-1, 2)
    x, kind = np.concatenate(places), np.concatenate(types)
    c, s = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}.get(turn % 360.0, (np.cos(np.radians(turn)), np.sin(np.radians(turn))))
    x = x @ np.array([[c, s], [-s, c]]) + shift
    inside = np.hypot(*x.T) < radius
    if quarter:
        inside &= (x > 0.0).all(axis=1)
    return x[inside], kind[inside]


def write(path, plate, density, title=""):
    """A data file of atom_style sph, at rest and without internal energy."""
    margin = plate.spacing[-1]
    low, high = np.full(3, -(plate.radius + margin)), np.full(3, plate.radius + margin)
    planes = (0, 1) if plate.quarter else ()
    low[list(planes)] = 0.0
    low[2], high[2] = 0.0, plate.step * len(plate.angles)
    bodies.write_data(path, plate.x, plate.type, density * plate.volume, density, low, high, planes, f"plate {title}")
