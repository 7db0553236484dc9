# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Meshes of other programs, through meshio: eight-node hexahedra, and sets of them."""

import numpy as np

from . import mesh
from .errors import HVIError

_FLAT = {"vertex", "line", "triangle", "quad"}  # edges and surfaces that lie in the hexahedra


def load(path, n=0, cells=None, scale=1.0, move=(0.0, 0.0, 0.0), type=1, node_type=None):
    """A Mesh of the hexahedra of a file

    n: particles per edge of the elements, or, with cells, of those in the set of cells of this name
    scale, move: x = scale * (what the file says) + move
    Nodes of elements that are numbered inside out are put in order.
    """
    try:
        import meshio
    except ImportError:
        raise HVIError("to import a mesh meshio is needed (Debian: python3-meshio, for /usr/bin/python3)") from None
    try:
        found = meshio.read(path)
    except (Exception, SystemExit) as error:  # meshio ends the program where it knows no reader
        said = " ".join(str(error).split()) or "no reader for it"
        raise HVIError(f"cannot read {path} as a mesh: {said}") from None
    hexes = [k for k, c in enumerate(found.cells) if c.type == "hexahedron"]
    other = sorted({c.type for c in found.cells} - _FLAT - {"hexahedron"})
    if other or not hexes:
        raise HVIError(f"{path}: fix hvi/fem knows hexahedra of eight nodes, not {', '.join(other) or 'a mesh without any'}")
    elements = np.concatenate([found.cells[k].data for k in hexes]).astype(int)
    points = np.zeros((len(found.points), 3))
    points[:, : found.points.shape[1]] = found.points
    points = scale * points + np.asarray(move, dtype=float)
    double = np.flatnonzero((np.diff(np.sort(elements, axis=1), axis=1) == 0).any(axis=1))
    if len(double):
        raise HVIError(f"{path}: {len(double)} hexahedra have a node twice, the first is number {double[0] + 1}: wedges are not known here")
    inverted = mesh.volumes(points[elements]) < 0.0
    elements[inverted] = elements[inverted][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    holds = np.full(len(elements), n > 0)
    if cells is not None:
        if cells not in found.cell_sets:
            raise HVIError(f"{path} has no set of cells {cells}, but {', '.join(sorted(found.cell_sets)) or 'none'}")
        rows = found.cell_sets[cells]
        holds = np.concatenate([np.isin(np.arange(len(found.cells[k].data)), rows[k]) for k in hexes])
    made = mesh.assemble(points, elements, n, holds, np.zeros(len(elements), dtype=bool), type, node_type)
    made.check()
    return made, int(inverted.sum())
