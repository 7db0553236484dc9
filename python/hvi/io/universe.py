# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""MDAnalysis Universes of LAMMPS dumps that keep every column, and particles that leave.

Importing this module registers the format LAMMPSHVI, so that also
MDAnalysis.Universe("x.dump", format="LAMMPSHVI", topology_format="LAMMPSHVI") works.

MDAnalysis wants the same particles in every frame. The topology therefore has all particles of the first frame (and of the
data file, if there is one); those that are not in a frame have NaN coordinates there and are False in u.atoms.present.
MDAnalysis stores coordinates in single precision; ts.data and trajectory.raw have them in double.
"""

import re

import numpy as np
from MDAnalysis import Universe
from MDAnalysis.coordinates.base import ReaderBase
from MDAnalysis.core.groups import AtomGroup
from MDAnalysis.core.topology import Topology
from MDAnalysis.core.topologyattrs import (Atomids, Atomtypes, Bonds, Masses, Resids, Resnums, Segids, TopologyAttr)
from MDAnalysis.exceptions import NoDataError
from MDAnalysis.lib.mdamath import triclinic_box
from MDAnalysis.lib.util import store_init_arguments
from MDAnalysis.topology.base import TopologyReaderBase

from ..errors import HVIError
from . import bonds as bond_sources
from .data import DataFile
from .dump import Dump

FORMAT = "LAMMPSHVI"


def open_universe(dump, data=None, bonds=None, *, atoms="first", bond_columns=None, masses=None, units=None, mirror=None,
                  dt=None, interval=None):
    """An MDAnalysis Universe of a dump (path, paths or a Dump).

    data: data file (write_data): masses, bonds
    bonds: dump local with the bonds of every frame (or a second data file, or pairs of IDs (m, 2)). The topology has the
    bonds of the first frame, from the data file if only that is given; u.trajectory.bonds has those of any step, and
    hvi.find(u) uses these
    atoms: "first": the topology has the particles of the first frame and of the data file; "all": of every frame, which
    reads the whole dump once (needed where particles are added or a dump_modify region or thresh lets others in)
    bond_columns: names of the two columns with atom IDs in the dump of bonds, see hvi.io.bonds.BondDump
    masses, units, mirror, dt, interval: see hvi.Dump

    Coordinates, velocities and forces are numbers of the dump, in its units, unwrapped where it allows (Frame.x).
    Raises HVIError where files are missing, cut off or do not fit together.
    """
    data = DataFile(data) if isinstance(data, str) or hasattr(data, "__fspath__") else data
    if not isinstance(dump, Dump):
        dump = Dump(dump, data=data, masses=masses, units=units, mirror=mirror, dt=dt, interval=interval)
    if atoms not in ("first", "all"):
        raise HVIError(f"atoms must be first or all, not {atoms}")
    if bonds is None and data is not None and data.has_bonds:
        bonds = data
    bonds = bond_sources.source(bonds, bond_columns)
    first = dump[0]  # held, so that it is parsed once
    topology = _topology(dump, data, atoms)
    universe = Universe(topology)
    universe.trajectory = HVIReader(dump.paths[0], dump=dump, ids=topology.ids.values, bonds=bonds)
    del first
    if bonds is not None:
        _add_bonds(universe, bonds, dump)
    universe.add_TopologyAttr(Columns(universe.trajectory.raw.columns))
    return universe


def _topology(dump, data, atoms):
    """Topology of all particles of the first (or every) frame and the data file: IDs, types, masses"""
    first = dump[0]
    ids, types, masses = first.ids, first["type"] if "type" in first else None, first["mass"] if "mass" in first else None

    def add(more_ids, more_types, more_masses):
        nonlocal ids, types, masses
        new = ~np.isin(more_ids, ids)
        if new.any():
            ids = np.concatenate([ids, more_ids[new]])
            types = None if types is None else np.concatenate([types, more_types[new]])
            masses = None if masses is None else np.concatenate([masses, more_masses[new]])

    for number in range(1, len(dump) if atoms == "all" else 1):
        frame = dump[number]
        add(frame.ids, frame["type"] if types is not None else None, frame["mass"] if masses is not None else None)
    if data is not None:
        ids_there, types_there = data.atoms
        add(ids_there, types_there, np.array([data.masses.get(t, np.nan) for t in types_there]))
    order = np.argsort(ids)
    attributes = [Atomids(ids[order]), Resids(np.ones(1, dtype=int)), Resnums(np.ones(1, dtype=int)),
                  Segids(np.array(["SYSTEM"], dtype=object))]
    if types is not None:
        attributes.append(Atomtypes(types[order].astype(str).astype(object)))
        if dump.masses:
            kinds, place = np.unique(types[order], return_inverse=True)
            masses, order = np.array([dump.masses.get(t, np.nan) for t in kinds])[place], slice(None)
    if masses is not None:
        attributes.append(Masses(masses[order]))
    return Topology(len(ids), 1, 1, attrs=attributes)


def _add_bonds(universe, bonds, dump):
    try:
        pairs = bonds.at(int(dump.steps[0]))
    except HVIError:
        if not isinstance(bonds, bond_sources.BondData):
            raise
        pairs = bonds.data.bonds  # of another moment; trajectory.bonds knows that, the topology cannot
    pairs = bond_sources.rows_of(pairs, universe.atoms.ids)
    universe.add_TopologyAttr(Bonds([tuple(pair) for pair in np.sort(pairs, axis=1).tolist()]))


class HVIReader(ReaderBase):
    """Reads text dumps. trajectory.raw: the Frame as read, only the particles that are there, in double precision;
    trajectory.bonds: where bonds come from, or None; ts.data: every column, (number of atoms in the topology,), NaN (0 in
    columns of whole numbers) for absent particles; present, step, time, and box.

    ts.time is the time of the dump, or the time step where the dump has no time; ts.dt that between the first two frames.
    """

    format = FORMAT
    units = {"time": None, "length": None, "velocity": None, "force": None}

    @store_init_arguments
    def __init__(self, filename, dump=None, ids=None, bonds=None, **kwargs):
        super().__init__(filename, **{k: kwargs[k] for k in ("convert_units", "dt", "time_offset") if k in kwargs})
        self.dump = dump or Dump(filename)
        self.bonds = bonds
        self.raw = self.dump[0]
        self.ids = self.raw.ids if ids is None else ids
        self.n_atoms = len(self.ids)
        self._interval = self._time(1) - self._time(0) if len(self.dump) > 1 else 1.0
        self.ts = self._Timestep(self.n_atoms, positions=True, velocities="vx" in self.raw, forces="fx" in self.raw,
                                 **self._ts_kwargs)
        self._read_frame(0)

    @property
    def n_frames(self):
        return len(self.dump)

    def _time(self, number):
        time = self.dump.time(number)
        return float(self.dump.headers[number].step) if time is None else time

    def _reopen(self):
        self.ts.frame = -1

    def _read_next_timestep(self, ts=None):
        if self.ts.frame + 1 >= self.n_frames:
            raise EOFError
        return self._read_frame(self.ts.frame + 1)

    def _read_frame(self, number):
        raw = self.raw if self.raw.number == number else self.dump[number]
        ts = self.ts
        rows = self._rows(raw)
        ts.positions = _spread(raw.x, rows, self.n_atoms)
        for letter, name in (("v", "velocities"), ("f", "forces")):
            columns = [letter + k for k in "xyz"]
            if all(c in raw for c in columns):
                setattr(ts, name, _spread(np.stack([raw[c] for c in columns], axis=1), rows, self.n_atoms))
            elif getattr(ts, f"has_{name}"):
                setattr(ts, name, np.full((self.n_atoms, 3), np.nan))  # those of the frame before are not its own
        ts.data = {name: _spread(column, rows, self.n_atoms) for name, column in raw.columns.items()}
        ts.data["id"] = self.ids
        ts.data["present"] = _spread(np.ones(len(raw), dtype=bool), rows, self.n_atoms)
        ts.data["step"], ts.data["box"] = raw.step, raw.box
        ts.data["time"], ts.data["dt"] = self._time(number), self._ts_kwargs.get("dt", self._interval)
        ts.dimensions = _dimensions(raw.box)
        ts.frame = number
        self.raw = raw
        return ts

    def _rows(self, raw):
        """Rows in the topology of the particles of a frame, None if they are the same"""
        if np.array_equal(raw.ids, self.ids):
            return None
        rows = np.minimum(np.searchsorted(self.ids, raw.ids), self.n_atoms - 1)
        strange = np.flatnonzero(self.ids[rows] != raw.ids)
        if len(strange):
            raise HVIError(f"{raw.where}: particle {raw.ids[strange[0]]} (of {len(strange)}) is not in the topology: "
                           'use hvi.open(..., atoms="all")')
        return rows

    def close(self):
        if hasattr(self, "dump"):
            self.dump.close()


def _spread(values, rows, n):
    """values of the particles that are there, in an array for all n"""
    if rows is None:
        return values
    kind = values.dtype.kind
    full = np.zeros((n, *values.shape[1:]), dtype=values.dtype)
    if kind == "f":
        full.fill(np.nan)
    full[rows] = values
    return full


def _dimensions(box):
    """MDAnalysis's unit cell, None unless the box is periodic in all directions: else it would wrap where LAMMPS does not"""
    if not all(box.periodic) or np.triu(box.vectors, 1).any():
        return None
    return triclinic_box(*box.vectors)


class HVIParser(TopologyReaderBase):
    """IDs, types and masses from the first frame of a dump."""

    format = FORMAT

    def parse(self, **kwargs):
        return _topology(Dump(self.filename), None, "first")


class Columns(TopologyAttr):
    """Columns of the dump as attributes of AtomGroups, for the present frame: u.atoms.c_frag, u.atoms.present.

    Characters that cannot stand in a name become _: c_book[1] is u.atoms.c_book_1. Names that MDAnalysis has already are
    left to it.
    """

    attrname = singular = "dumpcolumns"
    target_classes: list = []
    per_object = None

    def __init__(self, names):
        self.names = tuple(names)
        self._guessed = False
        self.values = ()
        self.transplants = {**{cls: [] for cls in type(self).transplants}, AtomGroup: []}
        taken = set()
        for name in (*self.names, "present"):
            safe = re.sub(r"\W+", "_", name).strip("_")
            if not safe.isidentifier() or hasattr(AtomGroup, safe) or safe in taken:
                continue
            taken.add(safe)
            self.transplants[AtomGroup].append((safe, property(_getter(name))))

    def copy(self):
        return type(self)(self.names)

    def __reduce__(self):
        return type(self), (self.names,)


def _getter(name):
    def get(group):
        data = group.universe.trajectory.ts.data
        if name not in data:
            raise NoDataError(f"this frame has no column {name}")
        return data[name][group.ix]

    get.__doc__ = f"column {name} of the dump, in this frame"
    return get
