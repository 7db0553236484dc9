# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Bodies for SPH, filled with particles on a lattice or like glass: equal masses, exact total, center of mass in the center."""

import dataclasses
from typing import Optional

import numpy as np

from ..errors import HVIError
from ..io import data
from . import glass

SMOOTH = 0.15  # depth of the outermost particle of a glass, spacings, at least; half is usual
HEAVIEST = 10.0  # of images of what is near the middle of small round bodies
MOST = 1e8  # particles, and sites of which they are chosen


def _images(z, low, high, least, most, periodic=False):
    """[(way, rows)]: images way[0] z + way[1] of z between mirrors at low and high, between least and most; of images, too, where the mirrors are near"""
    thick = high - low
    many = int(max(most - high, low - least) / (2 * thick)) + 2
    ways = [(1, 2 * k * thick) for k in range(-many, many + 1) if k]
    if periodic:
        ways += [(1, (2 * k + 1) * thick) for k in range(-many, many)]
    else:
        ways += [(-1, 2 * k * thick + 2 * low) for k in range(-many, many + 1)]
    found = [(way, np.flatnonzero((way[0] * z + way[1] > least) & (way[0] * z + way[1] < most))) for way in ways]
    return [(way, rows) for way, rows in found if len(rows)]


@dataclasses.dataclass(frozen=True)
class Round:
    """outside of a sphere or cylinder about the origin, and inside of a hollow one: columns of x that make r; inner 0 for a full one"""

    columns: tuple
    outer: float
    inner: float = 0.0
    surface = True

    @property
    def thick(self):
        return self.outer - self.inner if self.inner else 2 * self.outer

    def _r(self, x):
        return np.sqrt((x[:, self.columns] ** 2).sum(axis=1))

    def _to(self, x, old, new):
        """x with r = new"""
        x = x.copy()
        x[:, self.columns] *= (new / np.maximum(old, 1e-300))[:, None]
        return x

    def depth(self, x):
        """distance from the nearest surface, < 0 outside; (n,)"""
        r = self._r(x)
        return np.minimum(self.outer - r, r - self.inner) if self.inner else self.outer - r

    def keep(self, x):
        """what is outside by less than the body is thick goes as far inside"""
        r = self._r(x)
        new = np.where(r > self.outer, 2 * self.outer - r, np.where(r < self.inner, 2 * self.inner - r, r))
        return self._to(x, r, new)

    def spread(self, u):
        """places, as dense everywhere, of u between 0 and 1; (n, columns)"""
        d = len(self.columns)
        r, turn = (self.inner**d + u[:, 0] * (self.outer**d - self.inner**d)) ** (1 / d), 2 * np.pi * u[:, 1]
        rho = r if d == 2 else r * np.sqrt(1 - (2 * u[:, 2] - 1) ** 2)
        flat = [rho * np.cos(turn), rho * np.sin(turn)]
        return np.column_stack(flat if d == 2 else [*flat, r * (2 * u[:, 2] - 1)])

    def near(self, x, reach):
        """[(way, rows)] of those with images less than reach from a surface"""
        return _images(self._r(x), self.inner, self.outer, max(self.inner - reach, 0.0), self.outer + reach)

    def image(self, x, way):
        """places, and weights that make the images as dense as particles: they stand for parts of wider or narrower shells"""
        r = np.maximum(self._r(x), 1e-300)
        new = np.maximum(way[0] * r + way[1], 0.0)
        return self._to(x, r, new), np.minimum((new / r) ** (len(self.columns) - 1), HEAVIEST)


@dataclasses.dataclass(frozen=True)
class Slab:
    """the two faces across a column of x; or, without high, a mirror plane; or faces that are the same place, of a periodic box"""

    column: int
    low: float
    high: float = np.inf
    periodic: bool = False

    @property
    def thick(self):
        return self.high - self.low

    @property
    def surface(self):
        return bool(np.isfinite(self.high)) and not self.periodic

    def depth(self, x):
        return np.minimum(x[:, self.column] - self.low, self.high - x[:, self.column])

    def keep(self, x):
        z = x[:, self.column]
        over, under = (z - self.thick, z + self.thick) if self.periodic else (2 * self.high - z, 2 * self.low - z)
        x = x.copy()
        x[:, self.column] = np.where(z > self.high, over, np.where(z < self.low, under, z))
        return x

    @property
    def columns(self):
        return (self.column,)

    def spread(self, u):
        return self.low + self.thick * u

    def near(self, x, reach):
        z = x[:, self.column]
        if self.thick == np.inf:
            return [((-1, 2 * self.low), np.flatnonzero(z < self.low + reach))]
        return _images(z, self.low, self.high, self.low - reach, self.high + reach, self.periodic)

    def image(self, x, way):
        x = x.copy()
        x[:, self.column] = way[0] * x[:, self.column] + way[1]
        return x, np.ones(len(x))


@dataclasses.dataclass(frozen=True)
class Shape:
    """parts: Round and Slab; volume; low, high: corners of the box around it, (3,); planes: columns of mirror planes at 0"""

    parts: tuple
    volume: float
    low: np.ndarray
    high: np.ndarray
    planes: tuple

    @property
    def endless(self):
        """columns in which it is periodic"""
        return [p.column for p in self.parts if isinstance(p, Slab) and p.periodic]

    @property
    def center(self):
        """of mass, of the whole"""
        return np.array([0.0, 0.0, 0.5 * (self.low[2] + self.high[2])])

    def depths(self, x):
        """of each part that is a surface, after two of none, (n, 2 + parts)"""
        return np.column_stack([np.full((len(x), 2), np.inf), *(p.depth(x) for p in self.parts if p.surface)])

    def inside(self, x):
        return np.all([p.depth(x) > 0.0 for p in self.parts], axis=0)

    def keep(self, x):
        for p in self.parts:
            x = p.keep(x)
        return x

    def spread(self, u):
        """places, as dense everywhere, of u between 0 and 1, (n, 3)"""
        x = u.copy()
        for p in self.parts:
            if p.thick < np.inf:
                x[:, p.columns] = p.spread(u[:, p.columns])
        x[:, self.planes] = np.abs(x[:, self.planes])
        return x

    def images_near(self, x, reach, parts=None):
        """which particles have images less than reach outside: for with_images(), as long as nobody moves far"""
        found = []
        for p in self.parts if parts is None else parts:
            found.append((p, p.near(x, reach)))
            x = self.with_images(x, found[-1:])[0]
        return found

    @staticmethod
    def with_images(x, found):
        """x, and the images behind it; of images, too, at edges. And their weights: 1 for what is no image"""
        weight = np.ones(len(x))
        for p, ways in found:
            made = [(*p.image(x[rows], way), weight[rows]) for way, rows in ways]
            x = np.concatenate([x, *(m[0] for m in made)])
            weight = np.concatenate([weight, *(m[1] * m[2] for m in made)])
        return x, weight


@dataclasses.dataclass(frozen=True)
class Body:
    """x: (n, 3); volume: of a particle; spacing: cube root of it; step: of the lattice, (3,), or None for glass"""

    x: np.ndarray
    shape: Shape
    volume: float
    step: Optional[np.ndarray] = None

    @property
    def spacing(self):
        return np.cbrt(self.volume)


def _positive(**sizes):
    for name, value in sizes.items():
        if not 0.0 < value < np.inf:
            raise HVIError(f"a body needs a {name} > 0, not {value:g}")


def _hollow(radius, inner, **sizes):
    _positive(radius=radius, **sizes)
    if not 0.0 <= inner < radius:
        raise HVIError(f"the inner radius must be from 0 to below {radius:g}, not {inner:g}")


def _shape(parts, volume, half, middle, quarter):
    low, high = np.array([0.0, 0.0, middle]) - half, np.array([0.0, 0.0, middle]) + half
    if quarter:
        parts, low, volume = (Slab(0, 0.0), Slab(1, 0.0), *parts), np.array([0.0, 0.0, low[2]]), volume / 4
    return Shape(tuple(parts), volume, low, high, (0, 1) if quarter else ())


def sphere(radius, inner=0.0, quarter=False):
    """about the origin; inner: radius of the hole inside"""
    _hollow(radius, inner)
    return _shape([Round((0, 1, 2), radius, inner)], 4 / 3 * np.pi * (radius**3 - inner**3), np.full(3, radius), 0.0, quarter)


def cylinder(radius, length, inner=0.0, quarter=False, middle=0.0):
    """along z; middle: its z"""
    _hollow(radius, inner, length=length)
    parts = [Round((0, 1), radius, inner), Slab(2, middle - length / 2, middle + length / 2)]
    return _shape(parts, np.pi * (radius**2 - inner**2) * length, np.array([radius, radius, length / 2]), middle, quarter)


def box(size, quarter=False, periodic=()):
    """size: of the whole, (3,); periodic: columns in which the model has no faces"""
    if quarter and {0, 1} & set(periodic):
        raise HVIError("a quarter has mirrors in x and y and is not periodic there")
    _positive(**{f"size in {c}": s for c, s in zip("xyz", size)})
    half = 0.5 * np.asarray(size, dtype=float)
    parts = [Slab(k, -half[k], half[k], k in periodic) for k in range(3)]
    return _shape(parts, np.prod(size), half, 0.0, quarter)


def refuse_many(count, what="particles"):
    """more than fits into a machine, before they are made"""
    if count > MOST:
        raise HVIError(f"{count:.3g} {what} are more than this can make, {MOST:.0e}: is the spacing in the units of the body?")


def make(shape, spacing, fill="glass", seed=1):
    """A Body of as many particles as volumes of spacing^3 fit in, of equal masses.

    fill: lattice, cubic about the center, as wide as the spacing, in z and in boxes such that the layers fit; or glass, see glass.relax()
    """
    if not 0.0 < spacing < np.inf:
        raise HVIError(f"particles need a spacing > 0, not {spacing:g}")
    thin = min(p.thick for p in shape.parts)
    if not thin > 0.99 * spacing:
        raise HVIError(f"a body must be at least as thick as the spacing of its particles, {spacing:g}, not {thin:g}")
    for k in shape.endless:
        if shape.high[k] - shape.low[k] < 2.99 * spacing:
            raise HVIError(f"a periodic box must be 3 spacings wide, {3 * spacing:g}, in {'xyz'[k]}, not {shape.high[k] - shape.low[k]:g}")
    if shape.volume < 8 * spacing**3:
        raise HVIError(f"the body has room for {shape.volume / spacing**3:.3g} particles, fewer than 8, of spacing {spacing:g}")
    refuse_many(shape.volume / spacing**3)
    x, step = _lattice(shape, spacing) if fill == "lattice" else (glass.relax(shape, round(shape.volume / spacing**3), seed), None)
    if len(x) == 0:
        raise HVIError(f"no site of a lattice of spacing {spacing:g} is in the body: give a smaller one, or glass")
    shift = shape.center - x.mean(axis=0)
    shift[[*shape.planes, *shape.endless]] = 0.0
    x += shift
    if not shape.inside(x).all() or fill == "glass" and shape.depths(x).min() < SMOOTH * spacing:
        raise HVIError(f"the surface is not smooth: a body of {len(x)} particles is too small for {fill}, round ones need some 10 across; give a smaller "
                       f"spacing than {spacing:g}, another seed, or the other fill")
    return Body(x, shape, shape.volume / len(x), step)


def _lattice(shape, spacing):
    """sites (n, 3) and steps (3,)"""
    faces = {p.column: p for p in shape.parts if isinstance(p, Slab) and p.high < np.inf}
    lines, step = [], np.full(3, spacing)
    for k in range(3):
        if k in faces:
            low, thick = faces[k].low, faces[k].high - faces[k].low
            n = max(1, round(thick / spacing))
            if k in shape.planes:
                n = 2 * max(1, round(thick / (2 * spacing)))  # no site is in the mirror
            step[k] = thick / n
        else:
            n = 2 * int(np.ceil(shape.high[k] / spacing))
            refuse_many(float(n) ** 2, "sites of the lattice")
            low = -0.5 * n * spacing
        lines.append(low + (np.arange(n) + 0.5) * step[k])
    refuse_many(np.prod([float(len(line)) for line in lines]), "sites of the lattice")
    x = np.stack(np.meshgrid(*lines, indexing="ij"), -1).reshape(-1, 3)
    return x[shape.inside(x)], step


def measure(body, h=1.6):
    """How even: {name: value}, lengths in spacings.

    Distances to the nearest neighbor; density, relative, that kernel wendland2 with a smoothing length of h spacings makes of the places (the package's
    default): inside, where the kernel is whole, and of the outermost layer (there it is cut off: only its spread says something) away from edges;
    depth of that layer. What a body is too small for is missing.
    """
    from scipy.spatial import cKDTree

    unit, reach = body.spacing, 2 * h * body.spacing
    n, shape = len(body.x), body.shape
    mirrors = shape.images_near(body.x, reach, [p for p in shape.parts if not p.surface])
    y, _ = shape.with_images(body.x, mirrors)
    tree = cKDTree(y)
    nearest = tree.query(body.x, k=2)[0][:, 1] / unit
    pairs = tree.query_pairs(reach, output_type="ndarray")
    q = np.sqrt(((y[pairs[:, 0]] - y[pairs[:, 1]]) ** 2).sum(axis=1)) / (h * unit)
    w = (1 - q / 2) ** 4 * (2 * q + 1)  # Wendland's C2, Adv. Comput. Math. 4 (1995) 389
    total = 1 + np.bincount(pairs[:, 0], w, len(y))[:n] + np.bincount(pairs[:, 1], w, len(y))[:n]
    density = 21 / (16 * np.pi * h**3) * total
    depths = np.sort(shape.depths(body.x), axis=1) / unit
    deep, outer = depths[:, 0] > 2 * h, depths[:, 0] < 1
    face = outer & (depths[:, 1] > 2 * h)
    out = dict(nearest_min=nearest.min(), nearest_mean=nearest.mean(), nearest_spread=nearest.std())
    if deep.any():
        out.update(density_inside=density[deep].mean(), density_inside_spread=density[deep].std() / density[deep].mean())
    if face.any():
        out["density_face_spread"] = density[face].std() / density[face].mean()
        out.update(face_depth_min=depths[face, 0].min(), face_depth_mean=depths[face, 0].mean(), face_depth_spread=depths[face, 0].std())
    return out


def write(path, body, density, title=""):
    """A data file of atom_style sph, at rest and without internal energy."""
    shape, margin = body.shape, body.spacing
    low, high = shape.low - margin, shape.high + margin
    low[list(shape.planes)] = 0.0
    low[shape.endless], high[shape.endless] = shape.low[shape.endless], shape.high[shape.endless]
    write_data(path, body.x, 1, [density * body.volume], density, low, high, shape.planes, title)


def write_data(path, x, kind, masses, density, low, high, planes, title):
    """planes: columns with a mirror plane at 0, all particles being above it; masses: of types from 1 on"""
    mirror = " ".join(f"mirror {'xyz'[k]} 0 lo" for k in planes) or "mirror none"
    data.write(path, f"{title}, {mirror}", (low, high), dict(enumerate(masses, 1)), x, kind, density)
