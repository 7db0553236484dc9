# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Closed surfaces of triangles (STL files): what they enclose."""

import numpy as np

from ..errors import HVIError, needed


def read(path):
    """Triangles of a file, (n, 3, 3): corners; HVIError if it cannot be read or is not closed"""
    meshio = needed("meshio", "STL files need")
    try:
        mesh = meshio.read(path, file_format="stl")
        corners = np.asarray(mesh.points, dtype=float)
        cells = np.vstack([block.data for block in mesh.cells if block.type == "triangle"])
    except (OSError, ValueError, KeyError, IndexError, UnicodeDecodeError, meshio.ReadError, SystemExit) as problem:
        raise HVIError(f"cannot read {path} as an STL file: {' '.join(str(problem).split()) or type(problem).__name__}") from None
    unit = np.ptp(corners, axis=0).max()
    if not np.abs(corners).max() < 1e6 * unit:
        raise HVIError(f"{path}: its corners are in one point, a million times its size from the origin, or not numbers")
    known, number = np.unique(np.round(corners / (1e-6 * unit)).astype(np.int64), axis=0, return_inverse=True)  # corners of files are not exactly the same
    cells = number.reshape(-1)[cells]
    edges = np.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]])
    there, back = (set(map(tuple, pairs)) for pairs in (edges, edges[:, ::-1]))
    if len(there) < len(edges) or there != back:
        raise HVIError(f"{path} is not closed: each edge must be one of two triangles, with the same sense around; mend it where it was made")
    return (known * (1e-6 * unit))[cells]


CONVEX = 1.1  # times the shadow of the hull: a body with more is hollow or bent


def volume(triangles):
    """that is enclosed, by the divergence theorem"""
    a, b, c = np.moveaxis(triangles, 1, 0)
    return float(abs((a * np.cross(b, c)).sum()) / 6)


def least(triangles, directions=500):
    """the least width over directions and normals of large faces; of a hollow or bent body, what lies behind each other in the direction of the largest shadow, in the mean: twice the wall of a shell"""
    from scipy.spatial import ConvexHull

    k = np.arange(directions) + 0.5
    z, turn = k / directions, np.pi * (1 + 5**0.5) * k
    r = np.sqrt(1 - z**2)
    ways = np.concatenate([np.eye(3), np.column_stack([r * np.cos(turn), r * np.sin(turn), z])])
    hull = ConvexHull(np.unique(triangles.reshape(-1, 3), axis=0))
    points, faces = hull.points[hull.vertices], hull.points[hull.simplices]
    large = np.argsort(-np.linalg.norm(np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]), axis=1))[:directions]
    found = min(float(np.ptp(points @ way)) for way in (*ways, *hull.equations[large, :3]))
    around, own = (shadows(of, ways) for of in (faces, triangles))
    most = own.argmax()
    return min(found, volume(triangles) / own[most]) if own[most] > CONVEX * around[most] else found


def shadows(triangles, ways):
    """areas that a closed surface shades along directions; what lies behind each other counts each time"""
    a, b, c = np.moveaxis(triangles, 1, 0)
    return 0.25 * np.abs(np.cross(b - a, c - a) @ ways.T).sum(axis=0)


def middle(x):
    """of the box around points (n, 3)"""
    return 0.5 * (x.min(axis=0) + x.max(axis=0))


def inside(triangles, x, y, z):
    """[(number in x, number in y, numbers in z), ...] of sites of a lattice that are inside: what a line along z crosses changes sides"""
    found = []
    low, high = triangles[:, :, :2].min(axis=1), triangles[:, :, :2].max(axis=1)
    for i, px in enumerate(x):
        row = np.flatnonzero((low[:, 0] <= px) & (high[:, 0] > px))
        for j, py in enumerate(y):
            near = row[(low[row, 1] <= py) & (high[row, 1] > py)]
            crossed = _crossings(triangles[near], px, py)
            if len(crossed):
                odd = np.searchsorted(np.sort(crossed), z) % 2 == 1
                if odd.any():
                    found.append((i, j, np.flatnonzero(odd)))
    return found


def _crossings(triangles, px, py):
    """z where the line through (px, py) along z meets triangles; a corner or edge counts for one of its triangles only"""
    def side(p, q):  # on which side of the edge p q; a point on the edge is on the side that its two triangles agree on
        turned = (p[:, 0] > q[:, 0]) | ((p[:, 0] == q[:, 0]) & (p[:, 1] > q[:, 1]))
        p, q = np.where(turned[:, None], q, p), np.where(turned[:, None], p, q)
        area = (q[:, 0] - p[:, 0]) * (py - p[:, 1]) - (q[:, 1] - p[:, 1]) * (px - p[:, 0])
        return (area >= 0) != turned, np.where(turned, -area, area)

    a, b, c = np.moveaxis(triangles, 1, 0)
    (on_c, wc), (on_a, wa), (on_b, wb) = side(a, b), side(b, c), side(c, a)
    hit = (on_a == on_b) & (on_b == on_c) & (wa + wb + wc != 0)
    total = (wa + wb + wc)[hit]
    return (wa[hit] * a[hit, 2] + wb[hit] * b[hit, 2] + wc[hit] * c[hit, 2]) / total
