# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Walls of a case as elements: what mesh a wall needs, and its file in the folder of a run."""

import math
import pathlib

from ..errors import HVIError
from ..material import library
from ..model import mesh_plate
from . import geometry

CORE = 1.6  # radii of the projectile: free particles under its impact
MARGIN = 1.25  # of the radius that is struck: beyond, elements without particles
GROWTH, LARGEST = 1.2, 4  # of elements there; in units of those that hold particles


def per_edge(number):
    """particles along the edge of an element, None if none fits this number of layers"""
    return next((n for n in (2, 3) if number % n == 0), None)


def fitting(thickness, number):
    """[spacing, ...] in mm that would do instead: with the next number of layers to both sides"""
    found = (next((n for n in sequence if per_edge(n)), None) for sequence in (range(number - 1, 0, -1), range(number + 1, number + 4)))
    return [math.ceil(1e4 * thickness / n) / 1e4 for n in found if n]


def half_side(case, k):
    """of wall k, mm"""
    reach = geometry.reaches(case)[k - 1]
    return case.walls[k - 1].radius_mm or (reach if k == 1 else MARGIN * reach)


def radii(case, k, element):
    """(core, hold, half) of wall k in mm: free particles up to core, elements with particles up to hold, the side is twice half

    Debris meets nothing where elements hold no particles. So they do wherever it can arrive; only wall 1 is struck in its middle alone.
    """
    wall, reach, R = case.walls[k - 1], geometry.reaches(case)[k - 1], case.projectile.radius_mm / math.cos(math.radians(case.angle_deg))
    half = half_side(case, k)
    core = wall.core_mm if wall.core_mm is not None else CORE * R if k == 1 else 0.5 * min(reach, half)
    hold = wall.hold_mm or (max(2 / 3 * reach, core + 4 * element) if k == 1 else reach)
    return core, hold, half


def of_wall(case, k, which):
    """words of write() for wall k at the case's spacing number which; HVIError if there is no such mesh"""
    wall = case.walls[k - 1]
    dx = (wall.spacings_mm or case.spacings_mm)[which]
    number = geometry.layers_of(case, k, which)
    n = per_edge(number)
    if n is None:
        raise HVIError(f"{number} layers of particles (spacing {dx:g} mm) are no whole elements of 2 or 3 each way: "
                       f"spacings_mm of {' or '.join(f'{value:g}' for value in fitting(wall.thickness_mm, number))} would do")
    element = n * dx
    core, hold, half = radii(case, k, element)
    if core > 0.0 and min(hold, half) < core + 1.5 * element:
        raise HVIError(f"free particles up to {core:g} mm need elements with particles around them, up to {core + 1.5 * element:.4g} mm at least: "
                       f"there is room up to {min(hold, half):.4g}; take a larger {'radius_mm' if half < hold else 'hold_mm'} or a smaller core_mm")
    graded = half > hold + 1.5 * element
    half = max(half, element * math.ceil(half / element - 1e-6)) if not graded else half  # whole elements
    words = {"side": 2e-3 * half, "thickness": 1e-3 * wall.thickness_mm, "element": 1e-3 * element, "n": n, "layers": number // n, "core": 1e-3 * core,
             "quarter": geometry.is_quarter(case)}
    if graded:
        words.update(hold=1e-3 * hold, growth=GROWTH, largest=LARGEST * 1e-3 * element)
    return {**words, "type": 1 + k, "node_type": 1 + len(case.walls) + k, "material": wall.material}


def size(case, k, which):
    """(free particles, embedded particles, nodes) of wall k in the model, about"""
    words = of_wall(case, k, which)
    names = "side", "element", "n", "layers", "core", "hold", "growth", "largest", "quarter"
    return mesh_plate.size(**{name: words[name] for name in names if name in words})


def of_case(case, which):
    """{file: words} of the walls that have elements"""
    return {file_of(k): of_wall(case, k, which) for k, wall in enumerate(case.walls, 1) if wall.method != "sph"}


def file_of(k):
    return f"wall{k}.data"


def write(path, material, **words):
    """its file, of the density of a material file"""
    mesh_plate.plate(**words).write(path, library.density_of(library.of_case(material), si=True)[0], pathlib.Path(path).name)
