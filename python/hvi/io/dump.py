# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Text dumps (dump custom, dump atom, dump local) as a sequence of frames, one in memory at a time."""

import io
import os
import re
import warnings
import weakref

import numpy as np

from .. import units as unit_systems
from ..errors import HVIError, HVIWarning
from ..progress import silent
from . import mirror as mirrors
from .data import DataFile
from .frame import INTEGERS, Frame
from .scan import open_binary, scan


def parse(raw, n, names, where):
    """{name: column (n,)} of n rows of text; float64, but int64 for INTEGERS and text where the first row has words.

    raw: bytes; names: columns; where: for messages. Raises HVIError on a row that does not fit.
    """
    if n == 0:
        return {name: np.zeros(0, dtype=np.int64 if name in INTEGERS else float) for name in names}
    words = raw[:raw.find(b"\n")].split()
    if len(words) != len(names):
        raise HVIError(f"{where}: the first row has {len(words)} values for {len(names)} columns")
    text = [not _is_number(word) for word in words]
    try:
        if any(text):
            kinds = [(f"f{k}", "U64" if t else float) for k, t in enumerate(text)]
            table = np.loadtxt(io.BytesIO(raw), dtype=kinds, comments=None, ndmin=1)
            columns = [table[f"f{k}"] for k in range(len(names))]
        else:
            columns = np.asfortranarray(np.loadtxt(io.BytesIO(raw), comments=None, ndmin=2)).T
    except ValueError as error:
        raise HVIError(f"{where}: {_first_sentence(error)}") from None
    if len(columns[0]) != n:
        raise HVIError(f"{where}: {len(columns[0])} rows instead of {n}")
    return {name: _whole(column, name, where) if name in INTEGERS else column for name, column in zip(names, columns)}


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def _first_sentence(error):
    return re.split(r"[;.] ", str(error).replace("\n", " "))[0].rstrip(".")


def _whole(column, name, where):
    if column.dtype.kind == "U":
        if name == "type":
            return column  # labels
        raise HVIError(f"{where}: {name} in row 1 is {column[0]}, not a whole number")
    with np.errstate(invalid="ignore"):
        whole = column.astype(np.int64)
    if not np.array_equal(whole, column):
        row = np.flatnonzero(whole != column)[0]
        raise HVIError(f"{where}: {name} in row {row + 1} is {column[row]:g}, not a whole number")
    return whole


class Dump:
    """Frames of one dump file or of several (one per time step, say), in order of time: len(), [k], iteration.

    data: path of a data file (write_data): masses and units, if the dump has none
    masses: {type: mass}; goes before the column mass and the data file
    units: of the dump; default: what the dump or the data file says, else si
    mirror: planes that the scene is cut at, like ("x=0", "y=0"), or "none"; goes before what the dump or the data file says
    dt: time per step; interval: time per frame, for dump_modify every/time; for dumps without ITEM: TIME
    progress: see hvi.progress

    Nothing but the frames' headers is kept. A frame that was cut off is left out with an HVIWarning, and
    listed in problems. Raises HVIError if there is no frame at all.
    """

    def __init__(self, paths, *, data=None, masses=None, units=None, mirror=None, dt=None, interval=None,
                 progress=silent):
        self.paths = [str(p) for p in ([paths] if isinstance(paths, (str, os.PathLike)) else paths)]
        if not self.paths:
            raise HVIError("no dump file")
        files = [scan(path, progress) for path in self.paths]
        files.sort(key=lambda headers: next((h.step for h in headers if h.step is not None), -1))
        found = [h for headers in files for h in headers]
        self.headers = [h for h in found if not h.problem]
        self.problems = [f"{h.where}: {h.problem}" for h in found if h.problem]
        if not self.headers:
            raise HVIError("no complete frame: " + self.problems[0])
        for problem in self.problems:
            warnings.warn(HVIWarning(f"left out frame {problem}"), stacklevel=2)
        self._packed, self._last = None, None
        self.refuse_parts()
        self.dt, self.interval = dt, interval
        if interval is not None and np.any(np.diff(self.steps) <= 0):
            back = int(np.flatnonzero(np.diff(self.steps) <= 0)[0]) + 1
            raise HVIError(f"{self.paths[0]}: frame {back} goes back to step {self.steps[back]} (a resumed run?): its time does "
                           "not follow from the interval between frames")
        if interval is not None and self.steps[0] and any(h.time is None for h in self.headers):
            raise HVIError(f"{self.paths[0]}: the first frame is of step {self.steps[0]}, not 0: its time does not follow from the interval between frames (dump_modify time yes writes it)")
        steps = sorted({h.step for h in found if h.step is not None})  # a frame that was cut off may be there again
        self._place = {step: place for place, step in enumerate(steps)}
        self._fill_in(data, masses, units, mirrors.of_words(mirror))

    def refuse_parts(self, names=(), what="particles"):
        """of frames, one for each rank: a frame that a resumed run has written again has rows in common with the one before, or one of the two is empty

        names: of the columns that tell rows apart; default: IDs, or all columns of particles without
        """
        full, empty, parts = {}, {}, []
        for header in self.headers:
            by = names or (("id",) if "id" in header.columns else header.columns if header.label == "ATOMS" else ())
            if not by:
                continue
            one = (full if header.n else empty).setdefault(header.step, header)
            if one.path == header.path or not header.n or not set(by) <= set(one.columns):
                continue
            if not set(self._keys(one, by)).isdisjoint(self._keys(header, by)):
                return
            parts.append((one, header))
            if len(parts) > 1:
                break
        halves = [(full[step], empty[step]) for step in full if step in empty and full[step].path != empty[step].path]
        if parts or len(halves) > 1:
            one, other = (parts or halves)[0]
            raise HVIError(f"{one.path} and {other.path} both have a frame of step {one.step}, of different {what}: parts of a frame (dump with %, or of several groups) "
                           f"are not put together: let LAMMPS write all {what} of a frame into one file")

    def _keys(self, header, names):
        columns = self._parsed(header)
        return zip(*(columns[name].tolist() for name in names))

    def _fill_in(self, data, masses, units, planes):
        data = DataFile(data) if isinstance(data, (str, os.PathLike)) else data
        self._said, self._else = planes, data.mirror if data else None
        for header in self.headers:
            if header.units and header.units != self.said_units():
                raise HVIError(f"{header.where} is in units {header.units}, frames before it in {self.said_units()}")
        said = self.said_units() or (data.units if data else None)
        if units and said and units != said:
            raise HVIError(f"{self.paths[0]} is in units {said}, not {units}")
        self.units = unit_systems.check(units or said or "si")
        self.masses = dict(masses or {})
        if not self.masses and data and not ("mass" in self.columns):
            self.masses = data.masses

    def said_units(self):
        """What the dump says of its units, or None; a frame without rows cannot say it in a column"""
        return next((h.units for h in self.headers if h.units), None)

    @property
    def columns(self):
        """Names of the columns of the first frame."""
        return self.headers[0].columns

    @property
    def steps(self):
        """Time step of every frame, (number of frames,) of int64."""
        return np.array([h.step for h in self.headers], dtype=np.int64)

    def time(self, number):
        """Time of a frame, None if it is not known."""
        header = self.headers[number]
        if header.time is not None:
            return header.time
        if self.interval is not None:
            return self._place[header.step] * self.interval  # those that were cut off count
        return header.step * self.dt if self.dt is not None else None

    def __len__(self):
        return len(self.headers)

    def __iter__(self):
        return (self[k] for k in range(len(self)))

    def number(self, k):
        """Number of a frame from 0; negative ones count from the end. HVIError if there is none."""
        if not -len(self) <= k < len(self):
            raise HVIError(f"there is no frame {k}: {self.paths[0]} has {len(self)} complete frames, 0 to {len(self) - 1}")
        return k % len(self)

    def mirror(self, number):
        """Mirror planes of a frame: as given, else those of the dump, else of the data file; None if nobody says."""
        said = (self._said, self.headers[number].mirror, self._else)
        return next((planes for planes in said if planes is not None), None)

    def at_step(self, step):
        """Number of the (last) frame of a time step; HVIError if there is none."""
        found = np.flatnonzero(self.steps == step)
        if not len(found):
            raise HVIError(f"{self.paths[0]} has no frame of step {step}; it has {_some(self.steps)}")
        return int(found[-1])

    def rows(self, k):
        """Columns of frame k as written, in the order of the file."""
        return self._parsed(self.headers[self.number(k)])

    def _parsed(self, header):
        return parse(self._read(header), header.n, header.columns, header.where)

    def __getitem__(self, k):
        """Frame k, sorted by ID where the dump has IDs; negative k count from the end."""
        k = self.number(k)
        last = self._last() if self._last else None  # the frame read last, if somebody still holds it
        if last is not None and last.number == k:
            return last
        header = self.headers[k]
        if header.box is None:
            raise HVIError(f"{header.where} has no box: is it a dump of particles?")
        columns = self.rows(k)
        if "id" in columns:
            columns = _sorted(columns, header.where)
        frame = Frame(columns, number=k, step=header.step, time=self.time(k), box=header.box, units=self.units,
                      masses=self.masses, mirror=self.mirror(k), where=f"frame {k} of {header.where}")
        self._last = weakref.ref(frame)
        return frame

    def _read(self, header):
        if not header.path.endswith(".gz"):
            with open_binary(header.path) as stream:
                stream.seek(header.body)
                raw = stream.read(header.size)
        else:  # kept open: going forward is cheap, going back starts again
            if self._packed is None or self._packed[0] != header.path:
                self.close()
                self._packed = header.path, open_binary(header.path)
            self._packed[1].seek(header.body)
            raw = self._packed[1].read(header.size)
        if len(raw) != header.size:
            raise HVIError(f"{header.where} has become shorter since it was opened")
        return raw

    def close(self):
        if self._packed:
            self._packed[1].close()
        self._packed = None

    def __getstate__(self):
        return {**self.__dict__, "_packed": None, "_last": None}


def _sorted(columns, where):
    ids = columns["id"]
    step = np.diff(ids)
    if not np.all(step > 0):
        order = np.argsort(ids, kind="stable")
        columns = {name: column[order] for name, column in columns.items()}
        double = np.flatnonzero(np.diff(columns["id"]) == 0)
        if len(double):
            raise HVIError(f"{where}: particle {columns['id'][double[0]]} is there twice")
    return columns


def _some(steps):
    return " ".join(map(str, steps[:8])) + (f" ... {steps[-1]}" if len(steps) > 8 else "")
