# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What a data file (write_data) adds to a dump: masses of the types, bonds, IDs and types of the particles."""

import io
import re

import numpy as np

from . import mirror as mirrors
from .errors import HVIError
from .scan import open_binary

# atom styles that put the molecule between ID and type
_MOLECULE_FIRST = {"angle", "bond", "full", "line", "molecular", "tri"}
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
        self._counts = {kind: int(n) for n, kind in re.findall(r"^\s*(\d+)\s+(atoms|bonds|atom types)\b", head, re.M)}
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
            try:
                stream.seek(start)
                return stream.read(-1 if end is None else end - start)
            except (OSError, EOFError) as error:
                raise HVIError(f"cannot read {self.path}: {error}") from None

    def _masses(self):
        if "Masses" not in self._sections:
            return {}
        table = self._table("Masses", self._counts.get("atom types"), (0, 1))
        return {int(t): float(m) for t, m in table}

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
        return self._table("Bonds", self._counts["bonds"], (2, 3)).astype(np.int64)

    @property
    def atoms(self):
        """(IDs, types), (n,) of int64 each, in order of IDs."""
        style = (self._sections["Atoms"][2].split() or ["atomic"])[0]
        table = self._table("Atoms", self._counts["atoms"], (0, 2 if style in _MOLECULE_FIRST else 1)).astype(np.int64)
        return tuple(table[np.argsort(table[:, 0])].T)
