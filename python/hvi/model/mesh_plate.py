# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Plates of hexahedra across z: squares and circles, with free particles in the middle and elements that grow outward."""

import numpy as np

from ..errors import HVIError
from . import bodies, mesh


def graded(length, first, growth, largest):
    """Sizes that fill a length after an element of size first: each larger by the same ratio, at most growth, up to largest"""

    def sizes(ratio, count):
        return np.minimum(first * ratio ** np.arange(1.0, count + 1), largest)

    count = max(1, int(length / first + 0.5))
    if growth > 1.0:
        count = min(count, 1 + int(np.searchsorted(np.cumsum(sizes(growth, count)), length * (1 - 1e-9))))
    low, high = 1.0, growth
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sizes(middle, count).sum() < length else (low, middle)
    found = sizes(low, count)
    return found * (length / found.sum())


def _axis(half, element, fine, growth, largest):
    """Coordinates from 0 to half: elements of equal size up to fine, then growing"""
    cells = int(np.ceil(fine / element - 1e-6))
    rest = half - cells * element
    if growth == 1.0 or rest < 1.5 * element:
        count = max(1, int(half / element + 0.5))
        return half * np.arange(count + 1) / count
    return np.concatenate([element * np.arange(cells), cells * element + np.cumsum([0.0, *graded(rest, element, growth, largest)])])


def _grid(x, y):
    """Points and quadrilaterals of a tensor product, x fastest"""
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    i = (np.arange(len(x) - 1) + len(x) * np.arange(len(y) - 1)[:, None]).ravel()
    return points, np.stack([i, i + 1, i + len(x) + 1, i + len(x)], axis=-1)


def _around(rays):
    """Points and quadrilaterals of rays, (rays, points on each, 2), turning to the left; first along the ray"""
    k, m = rays.shape[:2]
    i = (np.arange(m - 1) + m * np.arange(k - 1)[:, None]).ravel()
    return rays.reshape(-1, 2), np.stack([i, i + 1, i + m + 1, i + m], axis=-1)


def _directions(count):
    """Unit vectors from x to y, both exact"""
    angle = 0.5 * np.pi * np.arange(count + 1) / count
    found = np.column_stack([np.cos(angle), np.sin(angle)])
    found[-1] = 0.0, 1.0
    return found


def _reflect(points, quads, axis):
    """With the mirror image; nodes in the plane are the same"""
    there = points[:, axis] != 0.0
    number = np.where(there, len(points) + np.cumsum(there) - 1, np.arange(len(points)))
    image = points[there] * np.where(np.arange(2) == axis, -1.0, 1.0)
    return np.concatenate([points, image]), np.concatenate([quads, number[quads][:, [[1, 0, 3, 2], [3, 2, 1, 0]][axis]]])


def _disk(radius, sectors, spacing):
    """Particles of equal area in a quarter of a regular polygon, (k, 2)

    A square lattice that relaxes near the rim: there each particle goes to the center of its Voronoi cell (Lloyd), with images
    beyond the rim. Cut at the rim the lattice would have gaps up to its spacing, or particles of many masses.
    """
    from scipy.spatial import Voronoi

    area = sectors / 8 * radius**2 * np.sin(2 * np.pi / sectors)
    grid = spacing * (np.arange(int(radius / spacing) + 4) + 0.5)
    x = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
    far = np.hypot(*x.T)
    order = np.argsort(np.round(far / spacing, 6), kind="stable")
    shells = np.flatnonzero(np.diff(np.round(far[order] / spacing, 6)) > 0) + 1  # whole ones, so that x and y are alike
    x = x[order[: shells[np.argmin(np.abs(shells - area / spacing**2))]]]
    edge = np.sqrt(4 * area / np.pi)
    far = np.hypot(*x.T)
    near, free = far > edge - 8 * spacing, far > edge - 4 * spacing
    own = np.flatnonzero(near)
    for _ in range(80):
        y = x[own]
        y = np.concatenate([y, y * [-1, 1], y * [1, -1], -y])
        cells = Voronoi(np.concatenate([y, y * (2 * edge / np.hypot(*y.T) - 1)[:, None]]))
        pairs, ends = cells.ridge_points, np.array(cells.ridge_vertices)
        size, first = np.zeros(len(own)), np.zeros((len(own), 2))
        for side in (0, 1):
            mine = (pairs[:, side] < len(own)) & (ends >= 0).all(axis=1)
            at, (a, b) = pairs[mine, side], cells.vertices[ends[mine]].transpose(1, 0, 2)
            center = cells.points[at]
            (ax, ay), (bx, by) = (a - center).T, (b - center).T
            part = 0.5 * np.abs(ax * by - ay * bx)
            np.add.at(size, at, part)
            np.add.at(first, at, part[:, None] * (center + a + b) / 3)
        move = free[own]
        x[own[move]] = (first / size[:, None])[move]
    return x


def _lattice(half, element, fine, growth, largest):
    """A quarter of a rectangle: points, quadrilaterals; particles of its own and their area: none"""
    points, quads = _grid(*(_axis(h, element, fine, growth, largest) for h in half))
    return points, quads, np.zeros((0, 2)), 0.0


def _butterfly(radius, element, need, hold, growth, largest):
    """A quarter of a circle around a square lattice that reaches as far as there is need, or more"""
    cells = max(1, int(np.ceil(max(need, min(hold, 0.5 * radius)) / element - 1e-6)))
    a = cells * element
    if 1.6 * a > radius:
        raise HVIError(f"a round plate of radius {radius:g} has no room around a square lattice of {2 * a:g}: smaller elements or core, "
                       "or a circular core")
    points, quads = _grid(*[element * np.arange(cells + 1)] * 2)
    out = _directions(2 * cells)
    side = np.concatenate([np.stack([np.full(cells, a), element * np.arange(cells)], axis=-1),
                           np.stack([element * np.arange(cells, -1, -1), np.full(cells + 1, a)], axis=-1)])
    circle = 2 * a if radius > 2 * a + 0.5 * element else radius
    count = max(1, int(np.hypot(*(circle * out - side).T).mean() / element + 0.5))
    s = np.arange(count + 1)[:, None] / count
    rays = side[:, None] * (1 - s) + circle * out[:, None] * s
    if circle < radius:
        steps = circle + np.cumsum(graded(radius - circle, element, growth, largest))
        rays = np.concatenate([rays, out[:, None] * steps[:, None]], axis=1)
    more, rings = _around(rays)
    return (*_glued(points, quads, more, rings, element), np.zeros((0, 2)), 0.0)


def _glued(points, quads, more, rings, element):
    """Two meshes as one, with equal nodes once"""
    both = np.concatenate([points, more])
    _, first, number = np.unique(np.round(both / element, 6), axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return both[first[order]], rank[number.ravel()][np.concatenate([quads, rings + len(points)])]


def _circular(half, radius, element, n, core, hold, growth, largest):
    """A quarter of an O-grid around a circle of free particles; also those, and the area of the polygon they fill"""
    out = _directions(2 * max(1, int(2 * np.pi * (core + 0.5 * element) / (8 * element) + 0.5)))
    sectors = 4 * (len(out) - 1)
    width = radius if half is None else half
    if width < core + element:
        raise HVIError(f"no room for elements around a core of {core:g} in a plate of {width:g}")
    equal = min(hold, width if half is None else max(core + element, 0.6 * width))  # then a square's rings begin to leave the circle
    count = int((equal - core) / element + 0.5)
    start = core + count * element
    if start > width - 0.5 * element:
        reach = core + (width - core) * np.arange(count + 1) / count
    else:
        rest = graded(width - start, element, growth, largest)
        reach = np.concatenate([core + element * np.arange(count + 1), start + np.cumsum(rest)])
    reach = np.broadcast_to(reach, (len(out), len(reach)))
    if half is not None:
        beyond = np.maximum(0.0, (reach - start) / (half - start))
        reach = reach + beyond**2 * (half / out.max(axis=1) - half)[:, None]
    points, quads = _around(out[:, None] * reach[:, :, None])
    return points, quads, _disk(core, sectors, element / n), sectors / 2 * core**2 * np.sin(2 * np.pi / sectors)


def size(side, element, n, layers, core=0.0, hold=np.inf, growth=1.0, largest=np.inf, quarter=False):
    """(free particles, embedded particles, nodes) of a square plate() with a ragged core, about, without making it"""
    half, parts = 0.5 * side, 1 if quarter else 4
    cells = len(_axis(half, element, min(hold, half), growth, largest)) - 1
    each = layers * n**3 / element**2
    inner = np.pi / 4 * core**2
    outer = np.pi / 4 * hold**2 if hold < half else half**2
    nodes = (cells + 1 if quarter else 2 * cells + 1) ** 2 - parts * inner / element**2
    return parts * inner * each, parts * (outer - inner) * each, nodes * (layers + 1)


def plate(thickness, element, side=None, radius=None, n=2, core=0.0, hold=np.inf, circle=False, growth=1.0, largest=np.inf, layers=None,
          quarter=False, center=(0.0, 0.0), bottom=0.0, type=1, node_type=None):
    """A Mesh of a plate across z, from bottom to bottom + thickness

    side: of a square, or both of a rectangle; or radius: of a round plate
    element: edge in the plane; layers: through the thickness (default: cubes, as nearly as the thickness allows)
    n: particles per edge of elements, 0: none
    core: radius in which there are free particles, element/n apart, instead of elements
    hold: radius up to which elements hold particles; beyond, they are larger than their inner neighbor by growth, up to largest
    circle: free particles fill a circle, and elements lie around it in rings; else cells of a square lattice are one or the other
    quarter: x > 0, y > 0 only, with nodes in the planes
    """
    half = None if side is None else 0.5 * np.broadcast_to(np.asarray(side, dtype=float), 2)
    if (half is None) == (radius is None):
        raise HVIError("a plate is square (side) or round (radius)")
    width = radius if half is None else half.min()
    if layers is None:
        layers = max(1, int(min(thickness / element, bodies.MOST) + 0.5))
    if not (thickness > 0.0 and 0.0 < element <= width and layers >= 1):
        raise HVIError(f"a plate needs a thickness > 0, elements that fit in it and at least one layer, not {thickness:g}, {element:g}, {layers}")
    if not 1.0 <= growth <= 2.0 or largest < element:
        raise HVIError(f"elements grow by a ratio from 1 to 2 up to a size of at least {element:g}, not by {growth:g} up to {largest:g}")
    if n < 0 or (core > 0.0 and n == 0):
        raise HVIError(f"particles per edge of an element must be {'1 or more with a core of free particles' if core > 0.0 else '0 or more'}, not {n}")
    if growth > 1.0 and not hold < width:
        raise HVIError("elements grow beyond the radius up to which they hold particles: say which, below that of the plate")
    wide = radius if half is None else half.max()
    fine = min(hold, wide)
    across = (fine + (wide - fine) * (1.0 if growth == 1.0 else element / min(largest, wide))) / element  # elements, about
    bodies.refuse_many(4 * min(across, bodies.MOST) ** 2 * layers, "elements")
    bodies.refuse_many(4 * min(fine / element, bodies.MOST) ** 2 * layers * float(n) ** 3)
    around = core + (1.5 if n > 1 else 2.5) * element  # two layers of particles or more also where the core is ragged
    if core < 0.0 or (core > 0.0 and min(hold, width) < around):
        raise HVIError(f"free particles up to {core:g} need elements with particles around them: at least up to {around:g}, "
                       f"not {min(hold, width):g}")
    if circle and not core >= element:
        raise HVIError(f"a circular core is at least as wide as an element, {element:g}, not {core:g}")
    if circle and half is not None and half[0] != half[1]:
        raise HVIError("a circular core is in a round or square plate, not in a rectangle")
    if quarter and np.any(center):
        raise HVIError("mirrors of a quarter model are at x = 0 and y = 0: it can only be around 0 0")
    if circle:
        points, quads, disk, area = _circular(None if half is None else half[0], radius, element, n, core, hold, growth, largest)
    elif half is None:
        points, quads, disk, area = _butterfly(radius, element, around if core else 0.0, hold, growth, largest)
    else:
        points, quads, disk, area = _lattice(half, element, min(hold, half.max()), growth, largest)
    parts = 4
    if quarter:
        area, parts = area / 4, 1
    else:
        for axis in (0, 1):
            points, quads = _reflect(points, quads, axis)
            disk = np.concatenate([disk, disk * np.where(np.arange(2) == axis, -1.0, 1.0)])
    far = np.hypot(*points[quads].mean(axis=1).T)
    rows = len(points) * np.arange(layers)[:, None, None]
    cells = np.concatenate([rows + quads, rows + quads + len(points)], axis=-1).reshape(-1, 8)
    z = bottom + thickness * np.arange(layers + 1) / layers
    points = np.column_stack([np.tile(points + center, (layers + 1, 1)), np.repeat(z, len(points))])
    loose = np.tile(far < core, layers) & (not circle)
    holds = np.tile(far < hold, layers) & (n > 0) & ~loose
    whole = np.pi * radius**2 if half is None else 4 * half.prod()
    made = mesh.assemble(points, cells, n, holds, loose, type, node_type, mirror="x 0 lo mirror y 0 lo" if quarter else "none",
                         volume=whole * thickness * parts / 4)
    if circle:
        sheets = layers * n
        z = bottom + thickness * (np.arange(sheets) + 0.5) / sheets
        made.free = np.column_stack([np.tile(disk + center, (sheets, 1)), np.repeat(z, len(disk))])
        made.free_type = np.full(len(made.free), type)
        made.free_volume = np.full(len(made.free), area * thickness / len(made.free))
    return made
