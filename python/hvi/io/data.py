# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What a data file (write_data) adds to a dump: masses of the types, bonds, IDs and types of the particles. Data files of particles."""

import io
import re

import numpy as np

from .. import units as unit_systems
from ..errors import HVIError, reading, writing
from . import mirror as mirrors
from .box import Box
from .frame import Frame
from .scan import open_binary

# atom styles that put the molecule between ID and type
_MOLECULE_FIRST = {"angle", "bond", "full", "line", "molecular", "tri"}
# where x y z begin, of atom styles with masses by type
_PLACE = {"angle": 3, "atomic": 2, "bond": 3, "charge": 3, "full": 4, "molecular": 3, "sph": 5}
# LAMMPS's own sections, and those of fixes, which have the ID of the fix
_SECTION = re.compile(rb"^([A-Z][A-Za-z ]*[a-z]|[A-Za-z_]\w*)[ \t]*(?:#[ \t]*([^\n]*))?\n", re.M)


class DataFile:
    """path: of a text data file, plain or .gz

    step: time step at which it was written, units: both None if it does not say so
    masses: {type: mass}, {} if there is no section Masses; mirror: planes, None if the first line does not say
    """

    def __init__(self, path):
        self.path = str(path)
        text = self._read()
        first = text.find(b"\n") + 1
        self._sections = {}  # name: first and last byte, comment
        found = list(_SECTION.finditer(text, first))
        for k, match in enumerate(found):
            end = found[k + 1].start() if k + 1 < len(found) else len(text)
            self._sections[match[1].decode()] = (match.end(), end, (match[2] or b"").decode("utf-8", "replace").strip())
        head = text[first:found[0].start() if found else None].decode("utf-8", "replace")
        lines = [line.split("#")[0].split() for line in head.splitlines()]
        self._counts = {" ".join(line[1:]): int(line[0]) for line in lines if line and re.fullmatch(r"\d{1,18}", line[0], re.A)}
        if "atoms" not in self._counts or "Atoms" not in self._sections:
            raise HVIError(f"{self.path} is not a LAMMPS data file: it has no section Atoms")
        title = text[:first].decode("utf-8", "replace")
        step, units = re.search(r"timestep = (\d+)", title), re.search(r"units = (\w+)", title)
        self.step = int(step[1]) if step else None
        self.units = units[1] if units else None
        self.mirror = mirrors.of_title(title, self.path)
        self.masses = self._masses()

    def _read(self, start=0, end=None):
        """Bytes of the file; the text is not kept, it may be large."""
        with open_binary(self.path) as stream:
            with reading(self.path):
                stream.seek(start)
                return stream.read(-1 if end is None else end - start)

    def _masses(self):
        if "Masses" not in self._sections:
            return {}
        table = self._table("Masses", self._counts.get("atom types"), (0, 1))
        return {int(t): float(m) for t, m in zip(self._whole(table[:, 0], "Masses"), table[:, 1])}

    def _table(self, section, rows, columns):
        """Columns (numbers from 0) of a section, (rows, len(columns)) of float64."""
        start, end, _ = self._sections[section]
        try:
            table = np.loadtxt(io.BytesIO(self._read(start, end)), usecols=columns, ndmin=2)
        except (ValueError, IndexError) as error:
            raise HVIError(f"{self.path}, section {section}: {str(error).split(';')[0]}: is the file cut off?") from None
        if rows is not None and len(table) != rows:
            raise HVIError(f"{self.path}, section {section}: {len(table)} rows instead of {rows}: is the file cut off?")
        return table

    def _whole(self, numbers, section):
        """The same as int64, which they must be."""
        if not (np.abs(numbers) < 2**53).all() or (numbers != np.floor(numbers)).any():
            raise HVIError(f"{self.path}, section {section}: an ID, a type or an image flag is not a whole number")
        return numbers.astype(np.int64)

    @property
    def has_bonds(self):
        return self._counts.get("bonds", 0) > 0

    @property
    def bonds(self):
        """Pairs of atom IDs, (m, 2) of int64."""
        if not self.has_bonds:
            return np.zeros((0, 2), dtype=np.int64)
        if "Bonds" not in self._sections:
            raise HVIError(f"{self.path} has no section Bonds: is the file cut off?")
        return self._whole(self._table("Bonds", self._counts["bonds"], (2, 3)), "Bonds")

    @property
    def _style(self):
        return (self._sections["Atoms"][2].split() or ["atomic"])[0]

    def frame(self, masses=None, units=None, mirror=None):
        """The particles as a Frame: id, type, x y z, ix iy iz if they are there; what is given goes before what the file says."""
        if units and self.units and units != self.units:
            raise HVIError(f"{self.path} is in units {self.units}, not {units}")
        if self._style not in _PLACE:
            raise HVIError(f"{self.path}: atom_style {self._style} is not read here, but {', '.join(sorted(_PLACE))}; take a dump")
        names = dict(zip(("id", "type"), (0, 2 if self._style in _MOLECULE_FIRST else 1)))
        names.update(zip("xyz", range(_PLACE[self._style], _PLACE[self._style] + 3)))
        start, end, _ = self._sections["Atoms"]
        first = self._read(start, end).lstrip().partition(b"\n")[0].split(b"#")[0].split()
        if len(first) == names["z"] + 4:
            names.update(zip(("ix", "iy", "iz"), range(names["z"] + 1, names["z"] + 4)))
        elif first and len(first) != names["z"] + 1:
            raise HVIError(f"{self.path}, section Atoms: {len(first)} columns are not those of atom_style {self._style}")
        table = self._table("Atoms", self._counts["atoms"], tuple(names.values()))
        table = table[np.argsort(table[:, 0])]
        columns = {name: self._whole(table[:, k], "Atoms") if name in ("id", "type", "ix", "iy", "iz") else table[:, k] for k, name in enumerate(names)}
        return Frame(columns, step=self.step or 0, box=self._box(start), units=unit_systems.check(units or self.units or "si"), masses=masses or self.masses,
                     mirror=self.mirror if mirror is None else mirror, where=self.path)

    def _box(self, end):
        """from the lines above the sections; which sides are periodic is not there"""
        head = self._read(0, end).decode("utf-8", "replace")
        lines = [line.split() for line in head.splitlines()]
        found = [next((line[:2] for line in lines if line[2:4] == [f"{a}lo", f"{a}hi"]), None) for a in "xyz"]
        tilt = next((line[:3] for line in lines if line[3:6] == ["xy", "xz", "yz"]), None)
        if not all(found):
            raise HVIError(f"{self.path} has no box: no lines xlo xhi, ylo yhi, zlo zhi")
        try:
            lo, hi = np.array([[float(word) for word in bounds] for bounds in found]).T
            vectors = np.diag(hi - lo)
            if tilt:
                vectors[1, 0], vectors[2, 0], vectors[2, 1] = map(float, tilt)
        except ValueError as problem:
            raise HVIError(f"{self.path}: box: {problem}") from None
        return Box(lo, vectors, (False,) * 3)

    @property
    def rho(self):
        """densities of particles of atom_style sph, (n,), None of another style"""
        return self._table("Atoms", self._counts["atoms"], (2,))[:, 0] if self._style == "sph" else None

    @property
    def atoms(self):
        """(IDs, types), (n,) of int64 each, in order of IDs."""
        style = self._style
        table = self._whole(self._table("Atoms", self._counts["atoms"], (0, 2 if style in _MOLECULE_FIRST else 1)), "Atoms")
        return tuple(table[np.argsort(table[:, 0])].T)


def write(path, title, box, masses, x, kind, rho, digits=(10, 15), sections=()):
    """A data file of atom_style sph, at rest and without internal energy.

    box: its low and high corner; masses: {type: mass}; kind, rho: types and densities of the particles x (n, 3), or one for all; digits: of
    box and places; sections: further ones, [(name, rows of whole numbers), ...]
    """
    counts = ((len(x), "atoms"), (len(masses), "atom types"), *((len(rows), name.lower()) for name, rows in sections))
    atoms = np.column_stack([np.arange(1, len(x) + 1), np.broadcast_to(kind, len(x)), np.broadcast_to(rho, len(x)), np.zeros((len(x), 2)), x])
    with writing(path), open(path, "w", encoding="ascii", errors="replace") as out:
        out.write(f"LAMMPS data file: {title}\n\n" + "".join(f"{n} {what}\n" for n, what in counts) + "\n")
        out.writelines(f"{low:.{digits[0]}g} {high:.{digits[0]}g} {a}lo {a}hi\n" for a, low, high in zip("xyz", *box))
        out.write("\nMasses\n\n" + "".join(f"{k} {m:.15g}\n" for k, m in masses.items()) + "\nAtoms # sph\n\n")
        np.savetxt(out, atoms, fmt="%d %d %.10g %d %d" + 3 * f" %.{digits[1]}g")
        for name, rows in sections:
            out.write(f"\n{name}\n\n")
            np.savetxt(out, np.column_stack([np.arange(1, len(rows) + 1), rows]), fmt="%d")
