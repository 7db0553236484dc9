# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""One frame of a dump: the particles that were there at that moment, in double precision, in order of their IDs."""

import functools

import numpy as np

from .. import units as unit_systems
from ..errors import HVIError, needed
from . import mirror as mirrors
from .box import Box

INTEGERS = {"id", "mol", "type", "proc", "procp1", "ix", "iy", "iz"}  # columns that LAMMPS writes as whole numbers

FEW = 8  # particles of a whole scene can be that many mirror images of one, at one coordinate along its axis: they say nothing of dimensions

# where coordinates come from: the first that is complete; (columns, scaled by the box, unwrapped)
_COORDINATES = ((("xu", "yu", "zu"), False, True), (("xsu", "ysu", "zsu"), True, True),
                (("x", "y", "z"), False, False), (("xs", "ys", "zs"), True, False))


class Frame:
    """Columns of one frame.

    frame["c_frag"] is a column, frame.columns the dict of all. Arrays of n particles, rows in order of IDs if the dump
    has them: ids (n,), x and v (n, 3), m (n,). Units are those of the dump: m, m/s, kg in si.

    number: place in the dump, from 0; step: LAMMPS's time step; time: or None; box: a Box; units: "si", ...
    mirror: planes that it is cut at, () of a whole scene, None if nobody knows: see hvi.io.mirror
    flat: see the property; of a part of a frame it is that of the frame, as few particles do not tell
    """

    def __init__(self, columns, *, number=0, step=0, time=None, box=None, units="si", masses=None, mirror=(), where="frame", flat=None):
        self.columns = columns
        self.number, self.step, self.time, self.box, self.units = number, step, time, box, units
        self.type_masses = masses or {}
        self.mirror = mirror
        self.where = where
        if flat is not None:
            self.flat = flat

    def __len__(self):
        return len(next(iter(self.columns.values()), ()))

    def __repr__(self):
        return f"<Frame {self.number}: step {self.step}, {len(self)} particles, columns {' '.join(self.columns)}>"

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        """A column, (n,); HVIError that names the columns there are."""
        try:
            return self.columns[name]
        except KeyError:
            raise HVIError(f"{self.where} has no column {name}; it has: {' '.join(self.columns)}") from None

    def numbers(self, name):
        """The same, which must not be text."""
        column = self[name]
        if column.dtype.kind == "U":
            raise HVIError(f"{self.where}: {name} is text in row 1, {column[0]}, not a number")
        return column

    def dataframe(self):
        """A pandas.DataFrame with a row per particle and the columns of the dump, index id if there is one. HVIError if pandas is not there."""
        pandas = needed("pandas", "dataframe() needs")
        table = pandas.DataFrame(self.columns)
        return table.set_index("id") if "id" in table else table

    def of_types(self, types):
        """Mask of the particles of one or some types, numbers or labels, (n,) of bool"""
        column, asked = self["type"], np.atleast_1d(types)
        if column.dtype.kind == "U" or asked.dtype.kind == "U":
            column, asked = column.astype(str), asked.astype(str)
        return np.isin(column, asked)

    def select(self, mask):
        """The same frame with only the particles where mask (n,) is true."""
        return self._with({name: column[mask] for name, column in self.columns.items()}, self.box, self.planes)

    def _with(self, columns, box, planes):
        return Frame(columns, number=self.number, step=self.step, time=self.time, box=box, units=self.units,
                     masses=self.type_masses, mirror=planes, where=self.where, flat=self.flat)

    def without_planes(self, axes):
        """The same frame, cut only at the planes across other axes (0, 1, 2) than these."""
        return self._with(self.columns, self.box, tuple(plane for plane in self.planes if plane.axis not in axes))

    @functools.cached_property
    def flat(self):
        """Axes (0, 1, 2) along which all particles have the same coordinate as written, a tuple: of a plane or a row of particles, where a mass
        is per length or area. () of FEW particles or less, or without coordinates."""
        names = next((names for names, _, _ in _COORDINATES if all(name in self for name in names)), ())
        return tuple(k for k, name in enumerate(names) if len(self) > FEW and np.ptp(self.numbers(name)) == 0.0)

    @property
    def planes(self):
        """Mirror planes, a tuple; HVIError if nothing says whether there are any, and it looks as if."""
        if self.mirror is None:
            self.mirror = ()
            if any(all(name in self for name in names) for names, _, _ in _COORDINATES):
                planes = mirrors.suspects(self.x, self.box.periodic if self.box else (False,) * 3)
                if planes:
                    self.mirror = None
                    words = " ".join(f"--mirror {'xyz'[p.axis]}=0{',hi' * (p.side == 'hi')}" for p in planes)
                    raise HVIError(f"{self.where} has no record of mirror planes, and looks like a {mirrors.text(planes)}: unknown "
                                   f"whether it is the whole; say {words}, or --mirror none")
        return self.mirror

    def whole(self):
        """The whole scene: this frame, if there are no mirror planes, else with the images of all particles.

        Rows of the part come first, then those of each image, with IDs above all of those before. Coordinates are in x y z,
        unwrapped; velocities, forces and shear stresses (sxy sxz syz) are those of the images, other columns are repeated.
        """
        return self._with_images if self.planes else self

    @property
    def id_step(self):
        """By how much the IDs of an image are above those of the one before, in whole()."""
        return int(self.ids.max()) if len(self) else 1

    @functools.cached_property
    def _with_images(self):
        images = list(mirrors.images(self.planes))
        letters = dict(zip("xyz", range(3)))
        old = {name for names, _, _ in _COORDINATES for name in names} | {"ix", "iy", "iz"}
        columns = {}
        for name, column in self.columns.items():
            if name in old:
                continue
            axes = name[1:] if name in ("vx", "vy", "vz", "fx", "fy", "fz", "sxy", "sxz", "syz") else ""
            flips = [np.prod([signs[letters[a]] for a in axes]) for _, signs in images]
            parts = [-self.numbers(name) if flip < 0 else column for flip in flips]
            if name == "id":
                parts = [column + bits * self.id_step for bits, _ in images]
            columns[name] = np.concatenate(parts)
        at = np.zeros(3)
        for plane in self.planes:
            at[plane.axis] = plane.at
        x = np.concatenate([np.where(signs < 0.0, 2.0 * at - self.x, self.x) for _, signs in images])
        columns.update(zip("xyz", x.T))
        return self._with(columns, self.box and self._whole_box(), ())

    def _whole_box(self):
        origin, vectors = self.box.origin.copy(), self.box.vectors.copy()
        for plane in self.planes:
            k = plane.axis
            low, high = origin[k], origin[k] + vectors[k, k]
            reach = max(abs(low - plane.at), abs(high - plane.at))
            origin[k], vectors[k, k] = plane.at - reach, 2.0 * reach
        return Box(origin, vectors, self.box.periodic)

    @property
    def ids(self):
        """LAMMPS's atom IDs, (n,) of int64, rising."""
        return self["id"]

    @functools.cached_property
    def x(self):
        """Coordinates (n, 3), unwrapped: xu, else xsu, else x or xs with ix iy iz if these are there.

        Without image flags coordinates of periodic boxes stay as they are, inside the box.
        """
        for names, scaled, unwrapped in _COORDINATES:
            if all(name in self for name in names):
                break
        else:
            raise HVIError(f"{self.where} has no coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu); "
                           f"it has: {' '.join(self.columns)}")
        x = self._vectors(names)
        if scaled:
            x = self.box.from_scaled(x)
        if not unwrapped and all(name in self for name in ("ix", "iy", "iz")):
            x = x + self._vectors(("ix", "iy", "iz")) @ self.box.vectors
        self.require_finite(x, names)
        return x

    @functools.cached_property
    def v(self):
        """Velocities (n, 3) from vx vy vz."""
        return self._vectors(("vx", "vy", "vz"))

    @functools.cached_property
    def m(self):
        """Masses (n,): those given by type, else the column mass."""
        if not self.type_masses and "mass" in self:
            m = self.numbers("mass")
        elif not self.type_masses:
            raise HVIError(f"{self.where} has no masses: give a data file, the mass of each type, or dump the column mass")
        else:
            m = self.by_type(self.type_masses, "mass")
        self.require_finite(m[:, None], ("mass",))
        if len(m) and not m.min() > 0.0:
            raise HVIError(f"{self.where}: a mass is {m.min():g}; masses must be > 0")
        return m

    @property
    def mvv2e(self):
        """energy = 0.5 mvv2e m v^2"""
        return unit_systems.MVV2E[self.units]

    def by_type(self, values, what):
        """A number for each particle, (n,), from {type: number}; HVIError that names a type without one."""
        types, place = np.unique(self["type"], return_inverse=True)
        unknown = [str(t) for t in types if t not in values]
        if unknown:
            known = ", ".join(f"{t}={value:g}" for t, value in values.items())
            raise HVIError(f"{self.where}: no {what} for type {' '.join(unknown)}; known are {known}")
        return np.array([values[t] for t in types], dtype=float)[place]

    def _vectors(self, names):
        vectors = np.stack([self.numbers(name) for name in names], axis=1)
        self.require_finite(vectors, names)
        return vectors

    def require_finite(self, values, names):
        """HVIError that names the first particle with NaN or infinity in values (n, k) of the columns names (k,)."""
        if not np.isfinite(values).all():
            row, k = np.argwhere(~np.isfinite(values))[0]
            who = f"particle {self.columns['id'][row]}" if "id" in self else f"row {row + 1}"
            raise HVIError(f"{self.where}: {names[k]} of {who} is {values[row, k]}")


def as_frame(source):
    """A Frame of what analysis functions accept: a Frame, or a Universe or AtomGroup of hvi.open()."""
    if isinstance(source, Frame):
        return source
    try:
        universe = source.universe
        frame = universe.trajectory.raw
    except AttributeError:
        raise HVIError(f"neither a frame nor a Universe of hvi.open(): {type(source).__name__}") from None
    if source is universe or len(source.atoms.unique) == len(universe.atoms):
        return frame
    return frame.select(np.isin(frame.ids, source.atoms.ids))


def whole(source):
    """The Frame of what analysis functions accept, with all images behind mirror planes: what they measure."""
    return as_frame(source).whole()


def axis_number(axis):
    """0, 1, 2 of "x", "y", "z"."""
    if axis not in ("x", "y", "z"):
        raise HVIError(f"axis must be x, y or z, not {axis}")
    return "xyz".index(axis)
