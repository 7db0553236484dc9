# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Meshes of other programs, through meshio: eight-node hexahedra, and sets of them."""

import re

import numpy as np

from ..errors import HVIError, needed
from . import mesh

FARTHEST = 1e100  # coordinates, so that volumes are finite
_FLAT = {"vertex", "line", "triangle", "quad"}  # edges and surfaces that lie in the hexahedra


def load(path, n=0, cells=None, scale=1.0, move=(0.0, 0.0, 0.0), type=1, node_type=None):
    """A Mesh of the hexahedra of a file

    n: particles per edge of the elements, or, with cells, of those in the set of cells of this name
    scale, move: x = scale * (what the file says) + move
    Nodes of elements that are numbered inside out are put in order; returned is also how many.
    """
    meshio = needed("meshio", "meshes of other programs need")
    try:
        found = meshio.read(path)
    except SystemExit:  # which is what it does where a reader fails
        raise HVIError(f"cannot read {path} as a mesh: meshio does not understand it") from None
    except Exception as error:  # of many kinds: its readers do not check what they take
        raise HVIError(f"cannot read {path} as a mesh: {' '.join(str(error).split())} ({error.__class__.__name__})") from None
    hexes = [k for k, c in enumerate(found.cells) if c.type == "hexahedron"]
    other = sorted({c.type for c in found.cells} - _FLAT - {"hexahedron"})
    if other or not hexes:
        raise HVIError(f"{path}: fix hvi/fem knows hexahedra of eight nodes, not {', '.join(other) or 'a mesh without any'}")
    elements, points = _numbers(path, [found.cells[k].data for k in hexes], found.points)
    points = scale * points + np.asarray(move, dtype=float)
    double = np.flatnonzero((np.diff(np.sort(elements, axis=1), axis=1) == 0).any(axis=1))
    if len(double):
        raise HVIError(f"{path}: {len(double)} hexahedra have a node twice, the first is number {double[0] + 1}: wedges are not known here")
    inverted = mesh.volumes(points[elements]) < 0.0
    elements[inverted] = elements[inverted][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    holds = np.full(len(elements), n > 0)
    if cells is not None:
        if cells not in found.cell_sets:
            raise HVIError(f"{path} has no set of cells {cells}, but {', '.join(sorted(map(str, found.cell_sets))) or 'none'}")
        rows = found.cell_sets[cells]
        if str(path).lower().endswith(".inp"):
            _check_set(path, cells)
        if len(rows) != len(found.cells):
            raise HVIError(f"{path}: meshio does not say which cells are in the set {cells}")
        holds = np.concatenate([np.isin(np.arange(len(found.cells[k].data)), () if rows[k] is None else rows[k]) for k in hexes])
    made = mesh.assemble(points, elements, n, holds, np.zeros(len(elements), dtype=bool), type, node_type)
    made.check()
    return made, int(inverted.sum())


def _numbers(path, blocks, points):
    """Nodes of hexahedra (M, 8) and coordinates (N, 3): meshio does not look whether there are as many as there should be, and the nodes that are named"""
    points = np.asarray(points)
    if points.ndim != 2 or not 1 <= points.shape[1] <= 3 or any(np.ndim(block) != 2 or np.shape(block)[1] != 8 for block in blocks):
        raise HVIError(f"cannot read {path} as a mesh: a node has not three coordinates, or a hexahedron not eight nodes")
    elements = np.concatenate(blocks).astype(int)
    if elements.min(initial=0) < 0 or elements.max(initial=-1) >= len(points):
        raise HVIError(f"cannot read {path} as a mesh: a hexahedron names a node that is not among the {len(points)} there are")
    x = np.zeros((len(points), 3))
    x[:, :points.shape[1]] = points
    if not (np.abs(x) < FARTHEST).all():
        raise HVIError(f"cannot read {path} as a mesh: a coordinate is no number, or {FARTHEST:g} and more")
    return elements, x


def _check_set(path, name):
    """Refuses sets that meshio 5 takes for others: it keeps the last part of a set in several, and numbers those of *ELEMENT by themselves"""
    with open(path, encoding="utf-8", errors="replace") as stream:
        lines = re.findall(r"^\*(ELEMENT|ELSET)\b([^\n]*)", stream.read(), re.M | re.I)
    said = [(word.upper(), re.search(r"\bELSET *= *([^,\n]+)", rest, re.I)) for word, rest in lines]
    places = [word for word, found in said if found and found[1].strip() == name]
    of_elements = [found[1].strip() if found else None for word, found in said if word == "ELEMENT"]
    if len(places) != 1 or (places == ["ELEMENT"] and (None in of_elements or len(set(of_elements)) < len(of_elements))):
        raise HVIError(f"{path}: the set {name} is not told rightly by meshio; give its elements in one *ELSET of that name")
