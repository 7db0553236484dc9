# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""One frame of a dump: the particles that were there at that moment, in double precision, in order of their IDs."""

import numpy as np

from . import units as unit_systems
from .errors import HVIError

INTEGERS = {"id", "mol", "type", "proc", "procp1", "ix", "iy", "iz"}  # columns that LAMMPS writes as whole numbers

# where coordinates come from: the first that is complete; (columns, scaled by the box, unwrapped)
_COORDINATES = ((("xu", "yu", "zu"), False, True), (("xsu", "ysu", "zsu"), True, True),
                (("x", "y", "z"), False, False), (("xs", "ys", "zs"), True, False))


class Frame:
    """Columns of one frame.

    frame["c_frag"] is a column, frame.columns the dict of all. Arrays of n particles, rows in order of IDs if the dump
    has them. Units are those of the dump.

    number: place in the dump, from 0; step: LAMMPS's time step; time: or None; box: a Box; units: "si", ...
    """

    def __init__(self, columns, *, number=0, step=0, time=None, box=None, units="si", masses=None, where="frame"):
        self.columns = columns
        self.number, self.step, self.time, self.box, self.units = number, step, time, box, units
        self.type_masses = masses or {}
        self.where = where
        self._cache = {}

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

    def select(self, mask):
        """The same frame with only the particles where mask (n,) is true."""
        return Frame({name: column[mask] for name, column in self.columns.items()}, number=self.number, step=self.step,
                     time=self.time, box=self.box, units=self.units, masses=self.type_masses, where=self.where)

    def _once(self, name, make):
        if name not in self._cache:
            self._cache[name] = make()
        return self._cache[name]

    @property
    def ids(self):
        """LAMMPS's atom IDs, (n,) of int64, rising."""
        return self["id"]

    @property
    def x(self):
        """Coordinates (n, 3), unwrapped: xu, else xsu, else x or xs with ix iy iz if these are there.

        Without image flags coordinates of periodic boxes stay as they are, inside the box.
        """
        return self._once("x", self._coordinates)

    @property
    def v(self):
        """Velocities (n, 3) from vx vy vz."""
        return self._once("v", lambda: self._vectors(("vx", "vy", "vz")))

    @property
    def m(self):
        """Masses (n,): those given by type, else the column mass."""
        return self._once("m", self._masses)

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
        vectors = np.stack([self[name] for name in names], axis=1)
        self.require_finite(vectors, names)
        return vectors

    def require_finite(self, values, names):
        """HVIError that names the first particle with NaN or infinity in values (n, k) of the columns names (k,)."""
        if not np.isfinite(values).all():
            row, k = np.argwhere(~np.isfinite(values))[0]
            who = f"particle {self.columns['id'][row]}" if "id" in self else f"row {row + 1}"
            raise HVIError(f"{self.where}: {names[k]} of {who} is {values[row, k]}")

    def _coordinates(self):
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
        return x

    def _masses(self):
        if not self.type_masses and "mass" in self:
            m = np.asarray(self["mass"], dtype=float)
        elif not self.type_masses:
            raise HVIError(f"{self.where} has no masses: give a data file, the mass of each type, or dump the column mass")
        else:
            m = self.by_type(self.type_masses, "mass")
        self.require_finite(m[:, None], ("mass",))
        if len(m) and not m.min() > 0.0:
            raise HVIError(f"{self.where}: a mass is {m.min():g}; masses must be > 0")
        return m


def as_frame(source):
    """A Frame of what analysis functions accept: a Frame, or a Universe or AtomGroup of hvi.open()."""
    if isinstance(source, Frame):
        return source
    try:
        universe = source.universe
        frame = universe.trajectory.raw
    except AttributeError:
        raise HVIError(f"neither a frame nor a Universe of hvi.open(): {type(source).__name__}") from None
    if source is universe or len(source.atoms) == len(universe.atoms):
        return frame
    return frame.select(np.isin(frame.ids, source.atoms.ids))


def axis_number(axis):
    """0, 1, 2 of "x", "y", "z"."""
    if axis not in ("x", "y", "z"):
        raise HVIError(f"axis must be x, y or z, not {axis}")
    return "xyz".index(axis)
