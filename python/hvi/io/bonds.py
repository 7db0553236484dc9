# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Which particles are bonded, at the moment of a frame."""

import os
import warnings

import numpy as np

from ..errors import HVIError, HVIWarning
from ..progress import silent
from .data import DataFile
from .dump import Dump
from .scan import open_binary


class BondDump:
    """Bonds of every frame, from dump local with batom1 and batom2 of compute property/local among its columns.

    columns: their names in the dump; default batom1 batom2, else the last two columns
    """

    def __init__(self, paths, columns=None, progress=silent):
        self.dump = Dump(paths, progress=progress)
        if self.dump.headers[0].label == "ATOMS":
            raise HVIError(f"{self.dump.paths[0]} is a dump of particles, not of bonds (dump local)")
        have = self.dump.columns
        if columns is None:
            columns = ("batom1", "batom2") if {"batom1", "batom2"} <= set(have) else have[-2:]
        if len(columns) != 2 or not set(columns) <= set(have):
            raise HVIError(f"{self.dump.paths[0]} has no columns {' '.join(columns)}; it has: {' '.join(have)}")
        self.columns = tuple(columns)
        self.dump.refuse_parts(self.columns, "bonds")

    def at(self, step):
        """Pairs of atom IDs at a time step, (m, 2) of int64; HVIError if the dump has no such step."""
        k = self.dump.at_step(step)
        rows = self.dump.rows(k)
        pairs = np.stack([rows[name] for name in self.columns], axis=1)
        if pairs.dtype.kind not in "if" or not np.array_equal(pairs, np.rint(pairs)) or (len(pairs) and pairs.min() < 1):
            raise HVIError(f"{self.dump.headers[k].where}: columns {' '.join(self.columns)} are not atom IDs; "
                           f"there are: {' '.join(rows)}")
        return pairs.astype(np.int64)


class BondData:
    """Bonds of one moment, from a data file."""

    def __init__(self, data):
        self.data = data if isinstance(data, DataFile) else DataFile(data)
        self._pairs, self._told = None, False

    def at(self, step):
        """Pairs of atom IDs, (m, 2); HVIError if the file was written at another time step."""
        if self.data.step is not None and self.data.step != step:
            raise HVIError(f"the bonds in {self.data.path} are those of step {self.data.step}, not of step {step}: "
                           "dump the bonds with dump local")
        if self.data.step is None and step and not self._told:
            warnings.warn(HVIWarning(f"{self.data.path} does not say of which time step its bonds are: they are taken for those of step {step}"), stacklevel=2)
            self._told = True
        if self._pairs is None:
            self._pairs = self.data.bonds
        return self._pairs


class Fixed:
    """The same pairs always, as given by the caller."""

    def __init__(self, pairs):
        self.pairs = np.asarray(pairs, dtype=np.int64).reshape(-1, 2)

    def at(self, step):
        return self.pairs


def source(bonds, columns=None, progress=silent):
    """An object with at(step) from a path (dump local or data file), several paths, an array of pairs, or such one."""
    if bonds is None or hasattr(bonds, "at"):
        return bonds
    if isinstance(bonds, np.ndarray):
        return Fixed(bonds)
    if isinstance(bonds, DataFile):
        return BondData(bonds)
    if isinstance(bonds, (str, os.PathLike)):
        with open_binary(bonds) as stream:
            if stream.read(5) != b"ITEM:":
                return BondData(bonds)
    return BondDump(bonds, columns, progress)


def rows_of(pairs, ids):
    """Pairs of rows in a frame of pairs of atom IDs; pairs with a particle that is not in the frame are left out.

    pairs: (m, 2); ids: (n,), rising. Returns (k, 2), k <= m.
    """
    if not len(ids):
        return np.zeros((0, 2), dtype=np.int64)
    rows = np.minimum(np.searchsorted(ids, pairs), len(ids) - 1)
    return rows[np.all(ids[rows] == pairs, axis=1)]
