# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Hexahedra for fix hvi/fem with the particles they hold, and free particles beside them; written as LAMMPS data files."""

import dataclasses
from typing import Optional

import numpy as np

from ..errors import HVIError
from ..io import data

# nodes of a hexahedron in the order of VTK and of Abaqus's C3D8, and its faces seen from outside: -x +x -y +y -z +z
CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
FACES = np.array([[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]])
_ALONG = np.array([[1, 3, 4], [0, 2, 5], [3, 1, 6], [2, 0, 7], [5, 7, 0], [4, 6, 1], [7, 5, 2], [6, 4, 3]])  # next along x, y, z
_EDGES = np.array([(a, b) for a in range(8) for b in _ALONG[a] if a < b])


def weights(n):
    """Shape functions N_a at the centers of n^3 subcells, x fastest: (n^3, 8)"""
    s = (2 * np.arange(n) + 1) / n - 1
    z, y, x = np.meshgrid(s, s, s, indexing="ij")
    return _shapes(np.column_stack([x.ravel(), y.ravel(), z.ravel()]))


def _shapes(at):
    return 0.125 * np.prod(1 + CORNERS * at[:, None], axis=-1)


def volumes(corners):
    """of hexahedra, (m,), from their corners, (m, 8, 3): exact, det J is quadratic in each coordinate"""
    total = np.zeros(len(corners))
    for point in CORNERS / np.sqrt(3):
        factor = 1 + CORNERS * point
        slopes = 0.125 * np.stack([CORNERS[:, i] * factor[:, i - 1] * factor[:, i - 2] for i in range(3)])
        total += np.linalg.det(slopes @ corners)
    return total


@dataclasses.dataclass
class Mesh:
    """nodes: (N, 3); elements: rows of nodes, (M, 8), in the order CORNERS; type: of their material, (M,);
    n: particles an element holds along an edge, 0 for none, (M,)
    free: free particles, (P, 3), with free_type, (P,), and free_volume, (P,)
    node_type: of all nodes; box: (2, 3), None: around it all; periodic: directions in which the elements wrap around
    mirror: of a part of a model, as in the first line of data files; volume: what elements and free particles should have, or None
    """

    nodes: np.ndarray
    elements: np.ndarray
    type: np.ndarray
    n: np.ndarray
    free: np.ndarray
    free_type: np.ndarray
    free_volume: np.ndarray
    node_type: int
    box: Optional[np.ndarray] = None
    periodic: tuple = (False, False, False)
    mirror: str = "none"
    volume: Optional[float] = None

    @property
    def per_edge(self):
        """n of the elements that hold particles, 0 if there are none"""
        return int(self.n.max(initial=0))

    @property
    def corners(self):
        """of the elements, (M, 8, 3), each element in one piece where it wraps around"""
        x = self.nodes[self.elements]
        around = np.array(self.periodic)
        if around.any():
            length = (self.box[1] - self.box[0])[around]
            step = x[:, :, around] - x[:, :1, around]
            x[:, :, around] -= length * np.round(step / length)
        return x

    @property
    def embedded(self):
        """Particles in elements, (K, n^3, 3), of the K elements with n > 0"""
        return weights(self.per_edge) @ self.corners[self.n > 0] if self.per_edge else np.zeros((0, 0, 3))

    def masses(self, density):
        """{type: mass} of a particle: of free ones; if there are none, the mean of those held; of nodes the mean"""
        volume = volumes(self.corners)
        found = {}
        for kind in np.unique([*self.type, *self.free_type]).astype(int):
            free, held = self.free_volume[self.free_type == kind], (self.type == kind) & (self.n > 0)
            if len(free):
                if np.ptp(free) > 1e-6 * free.max():
                    raise HVIError(f"free particles of type {kind} have volumes from {free.min():g} to {free.max():g}: particles of a type "
                                   "have one mass, so the cells of free particles must be of one size")
                found[kind] = density * free.mean()
            elif held.any():
                found[kind] = density * volume[held].mean() / self.per_edge**3
            else:
                found[kind] = density * volume[self.type == kind].mean()
        if self.node_type in found:
            raise HVIError(f"nodes need a type of their own: {self.node_type} is that of a material")
        if len(self.nodes):
            found[self.node_type] = density * volume.sum() / len(self.nodes)
        return dict(sorted(found.items()))

    def check(self):
        """Refuses what fix hvi/fem could not compute with."""
        if not len(self.elements) + len(self.free):
            raise HVIError("a mesh without elements and particles")
        if len(np.unique(self.n[self.n > 0])) > 1:
            raise HVIError(f"all elements that hold particles hold the same number, not n = {' '.join(map(str, np.unique(self.n[self.n > 0])))}")
        bad = np.flatnonzero(_jacobians(self.corners).min(axis=1) <= 0.0)
        if len(bad):
            raise HVIError(f"{len(bad)} elements are turned inside out or flat; the first is number {bad[0] + 1}, around "
                           f"{' '.join(f'{c:g}' for c in self.corners[bad[0]].mean(axis=0))}")
        neighbors(self.elements)

    def write(self, path, density, title=""):
        """A data file of atom_style sph, at rest and without internal energy: nodes first, then particles of elements, then free ones

        read_data FILE fix ID elements Elements, with ID that of fix hvi/fem. If types do not begin at 1, with add append.
        """
        self.check()
        masses, held = self.masses(density), self.embedded
        box = self._box() if self.box is None else np.asarray(self.box, dtype=float)
        inside = held.reshape(-1, 3)
        nodes, free = self.nodes, self.free
        if any(self.periodic):
            around, length = np.array(self.periodic), box[1] - box[0]
            nodes, inside, free = (np.where(around, box[0] + (x - box[0]) % length, x) for x in (nodes, inside, free))
        x = np.concatenate([nodes, inside, free]) + 0.0  # no -0
        count = self.per_edge**3
        kind = np.concatenate([np.full(len(nodes), self.node_type), np.repeat(self.type[self.n > 0], count), self.free_type])
        rho = np.where(kind == self.node_type, 0.0, density)
        first = np.where(self.n > 0, len(nodes) + 1 + count * (np.cumsum(self.n > 0) - 1), 0)
        rows = np.column_stack([self.type, self.elements + 1, self.n, first])
        data.write(path, f"mesh {title}, mirror {self.mirror}", box, masses, x, kind, rho, (16, 16), [("Elements", rows)] if len(rows) else ())

    def _box(self):
        """Around all, with an element's width to spare; nothing beyond mirrors"""
        x = np.concatenate([self.nodes, self.free])
        edges = _edge_lengths(self.corners)
        margin = edges.max() if len(edges) else self.free_volume.max() ** (1 / 3)
        box = np.array([x.min(axis=0) - margin, x.max(axis=0) + margin])
        for k, axis in enumerate("xy"):
            if f"{axis} 0 lo" in self.mirror:
                box[0, k] = 0.0
        return box

    def quality(self):
        """{name: value}: what is there, how good its shapes are, and how much of it"""
        corners = self.corners
        found = {"elements": len(self.elements), "elements_with_particles": int((self.n > 0).sum()), "nodes": len(self.nodes),
                 "embedded_particles": int((self.n**3).sum()), "free_particles": len(self.free)}
        if len(corners):
            edges = _edge_lengths(corners)
            found.update(min_scaled_jacobian=_jacobians(corners).min(), max_edge_ratio=(edges.max(axis=1) / edges.min(axis=1)).max(),
                         smallest_edge=edges.min(), largest_edge=edges.max(), largest_growth=self._growth(corners))
            if self.per_edge:
                held = edges[self.n > 0] / self.per_edge
                found.update(smallest_embedded_spacing=held.min(), largest_embedded_spacing=held.max())
        found["volume"] = volumes(corners).sum() + self.free_volume.sum()
        if self.volume is not None:
            found["volume_over_exact"] = found["volume"] / self.volume
        return found

    def _growth(self, corners):
        """Largest ratio of the widths of two elements with a common face, across it"""
        across = np.linalg.norm(np.diff(corners[:, FACES].mean(axis=2).reshape(-1, 3, 2, 3), axis=2)[:, :, 0], axis=-1)
        (a, fa), (b, fb) = neighbors(self.elements)
        ratio = across[a, fa // 2] / across[b, fb // 2]
        return max(ratio.max(initial=1.0), (1 / ratio).max(initial=1.0))


def neighbors(elements):
    """Two elements and their common face, both as (elements, numbers of the face in FACES), of all inner faces"""
    faces = np.sort(elements[:, FACES], axis=-1).reshape(-1, 4)
    order = np.lexsort(faces.T)
    faces = faces[order]
    same = (faces[1:] == faces[:-1]).all(axis=1)
    if (same[1:] & same[:-1]).any():
        where = order[np.flatnonzero(same[1:] & same[:-1])[0]] // 6
        raise HVIError(f"three elements have a face in common; one is number {where + 1}")
    return divmod(order[:-1][same], 6), divmod(order[1:][same], 6)


def _edge_lengths(corners):
    return np.linalg.norm(corners[:, _EDGES[:, 0]] - corners[:, _EDGES[:, 1]], axis=-1)


def _jacobians(corners):
    """Scaled Jacobian at each corner, (M, 8): 1 for a box"""
    away = (corners[:, _ALONG] - corners[:, :, None]) * (-CORNERS)[:, :, None]
    length = np.prod(np.linalg.norm(away, axis=-1), axis=-1)
    return np.linalg.det(away) / np.where(length > 0.0, length, 1.0)


def assemble(points, cells, n, holds, free, type=1, node_type=None, same=None, **more):
    """A Mesh of cells (rows of points in the order CORNERS) that hold particles, are n^3 free particles, or neither: masks, (m,)

    type: of all cells or of each; same: for each point the one that is the same node; more: further fields of the Mesh
    """
    if n < 0 or (n == 0 and (holds.any() or free.any())):
        raise HVIError(f"particles per edge must be 1 or more where elements hold particles or are free ones, not {n}")
    types = np.broadcast_to(type, len(cells)).astype(int)
    x, kept = points[cells[free]], cells[~free]
    particles = (weights(n) @ x).reshape(-1, 3) if n else np.zeros((0, 3))
    rows = kept if same is None else same[kept]
    used, elements = np.unique(rows, return_inverse=True)
    return Mesh(points[used], elements.reshape(-1, 8), types[~free], np.where(holds[~free], n, 0), particles, np.repeat(types[free], n**3),
                np.repeat(volumes(x) / max(n, 1)**3, n**3), int(types.max(initial=0)) + 1 if node_type is None else node_type, **more)


def _mask(mask, default, shape, centers):
    if mask is None:
        return np.full(len(centers), default)
    if callable(mask):
        return np.asarray(mask(centers), dtype=bool)
    mask = np.asarray(mask, dtype=bool)
    if mask.shape != shape:
        raise HVIError(f"a mask of cells has the shape {shape}, not {mask.shape}")
    return mask.ravel(order="F")


def block(nx, ny, nz, map=1.0, n=2, holds=None, free=None, empty=None, periodic=(False, False, False), type=1, node_type=None):
    """A Mesh of nx ny nz cells

    map: edge of a cell, or of each direction, or a function that takes points of the lattice, (k, 3), with cells of edge 1
    from 0 to nx, ny, nz, to where they are
    holds, free, empty: which cells are elements with n^3 particles (default: all that are not free or empty, if n > 0), which
    are n^3 free particles, which are nothing: arrays (nx, ny, nz), or functions of the cells' centers, (k, 3), as mapped
    periodic: directions in which the last cell is the neighbor of the first, and the box ends with the block
    type: of all, or (nx, ny, nz)
    """
    cells = np.array([nx, ny, nz])
    if (cells < 1).any() or (cells[list(periodic)] < 3).any():
        raise HVIError(f"a block has at least 1 cell each way, 3 where it is periodic, not {nx} {ny} {nz}")
    lattice = np.indices(cells + 1).reshape(3, -1, order="F").T
    points = np.asarray(map(lattice.astype(float)) if callable(map) else lattice * np.asarray(map, dtype=float))
    stride = np.array([1, nx + 1, (nx + 1) * (ny + 1)])
    low = np.indices(cells).reshape(3, -1, order="F").T @ stride
    hexes = low[:, None] + ((CORNERS + 1) // 2) @ stride
    same = box = None
    if any(periodic):
        low_side = np.where(periodic, lattice % cells, lattice)
        same = low_side @ stride
        box = np.array([points.min(axis=0), points.max(axis=0)])
        shift = points - points[same] - np.where(low_side < lattice, box[1] - box[0], 0.0)
        if np.abs(shift).max() > 1e-9 * np.ptp(points, axis=0).max():
            raise HVIError("a periodic block must have the same nodes on both sides, a box apart")
        margin = np.where(periodic, 0.0, _edge_lengths(points[hexes]).max())
        box += np.outer([-1, 1], margin)
    shape, centers = (nx, ny, nz), points[hexes].mean(axis=1)
    free, empty = _mask(free, False, shape, centers), _mask(empty, False, shape, centers)
    holds = _mask(holds, n > 0, shape, centers) & ~free
    if (free & empty).any():
        raise HVIError("cells of free particles are not empty")
    types = np.broadcast_to(type, shape).ravel(order="F")
    there = ~empty
    return assemble(points, hexes[there], n, holds[there], free[there], types[there], node_type, same, box=box, periodic=tuple(bool(p) for p in periodic))
