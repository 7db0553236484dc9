# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Finds the frames of a text dump in one pass, without parsing their numbers.

A frame is a few items of one or two lines ("ITEM: TIMESTEP", ...) and then rows, one line each, after "ITEM: ATOMS ..."
or "ITEM: ENTRIES ...". The pass finds the items and counts the lines between them, so a frame that was cut off is known
before anybody asks for it: at the end of the file, or in the middle where a restarted run has appended.
"""

import dataclasses
import gzip
import os
from typing import Optional

from ..errors import HVIError, reading
from ..progress import silent
from . import mirror as mirrors
from .box import Box

CHUNK = 1 << 24  # bytes read at a time
HEAD = 1 << 14  # an item and the lines that belong to it are shorter than this


@dataclasses.dataclass
class Header:
    """Where a frame is and what its header says.

    start, body: bytes in the file where the frame and its rows begin; size: bytes of the rows; n: rows announced;
    rows: lines found; label: ATOMS, ENTRIES or what dump_modify label says; columns: their names; mirror: planes, None if
    it does not say; problem: why this frame cannot be read, or None
    """

    path: str
    start: int
    step: Optional[int] = None
    n: Optional[int] = None
    box: Optional[Box] = None
    time: Optional[float] = None
    units: Optional[str] = None
    label: Optional[str] = None
    mirror: Optional[tuple] = None
    columns: tuple = ()
    body: Optional[int] = None
    size: int = 0
    rows: int = 0
    problem: Optional[str] = None

    @property
    def where(self):
        return f"{self.path} (step {self.step})" if self.step is not None else f"{self.path} (byte {self.start})"


def open_binary(path):
    """A file opened for reading; one whose name ends in .gz is unpacked on the way."""
    try:
        if os.path.isdir(path):
            raise HVIError(f"{path} is a folder, not a file")
        return gzip.open(path, "rb") if str(path).endswith(".gz") else open(path, "rb")
    except FileNotFoundError:
        raise HVIError(f"{path} does not exist") from None
    except OSError as error:
        raise HVIError(f"cannot read {path}: {error.strerror or error}") from None


def _items(stream, bar):
    """(offset, its first bytes, lines that end in it, size in bytes) of every item"""
    base, data, at, offset, text, lines = 0, b"", 0, None, b"", 0
    while True:
        new = stream.read(CHUNK)
        bar.update(len(new))
        data += new
        limit = len(data) - HEAD if new else len(data)  # items that begin later may be cut: next time
        while at < limit:
            found = data.find(b"ITEM:", at, limit + 4)
            end = limit if found < 0 else found
            lines += data.count(b"\n", at, end)
            at = end
            if found < 0:
                break
            if offset is not None:
                yield offset, text[:base + found - offset], lines, base + found - offset
            offset, text, lines = base + found, data[found:found + HEAD], 0
            at += 5
        if not new:
            break
        if limit > 0:
            base, data, at = base + limit, data[limit:], 0
    if offset is not None:
        end = len(data)
        rest = data[data.rfind(b"\n") + 1:]
        if rest and b"ITEM".startswith(rest):  # one more item had just begun
            end -= len(rest)
        yield offset, text, lines, base + end - offset
        if end < len(data):
            yield base + end, rest, 0, len(rest)


def _read_item(header, offset, text, lines, size):
    """Adds an item to the header; True if it was the last of its frame. ValueError if it makes no sense."""
    title, found, rest = text[5:].partition(b"\n")
    if not found:
        raise ValueError("the header is cut off")
    title = title.decode("utf-8", "replace").strip()
    below = rest.decode("utf-8", "replace").split("\n", 3)[:-1]  # complete lines only
    if title == "TIMESTEP":
        header.step = int(below[0])
    elif title.startswith("NUMBER OF "):
        header.n = int(below[0])
    elif title.startswith("BOX BOUNDS"):
        header.box = Box.parse(title[10:], below[:3])
    elif title == "UNITS":
        header.units = below[0].strip()
    elif title == "TIME":
        header.time = float(below[0])
    else:
        header.label, *columns = title.split()
        header.columns = tuple(columns)
        header.body = offset + len(text.partition(b"\n")[0]) + 1
        header.size = offset + size - header.body
        header.rows = lines - 1
        if header.step is None or header.n is None:
            raise ValueError("the header is incomplete")
        if header.rows < header.n:
            raise ValueError(f"it ends after {header.rows} of {header.n} rows")
        if header.rows > header.n:
            raise ValueError(f"it has {header.rows} rows instead of {header.n}")
        if header.label == "ATOMS" and header.n:
            header.mirror, time, units = mirrors.of_row(header.columns, below[0].split(), header.where)
            header.time = time if header.time is None else header.time
            header.units = header.units or units
        return True
    return False


def scan(path, progress=silent):
    """Headers of all frames of a dump, also of those that cannot be read (Header.problem says why).

    progress(total, what): a context manager with update(n), see hvi.progress
    Raises HVIError if the file is missing, is empty or is no text dump.
    """
    path = str(path)
    with open_binary(path) as stream, progress(os.path.getsize(path), f"reading {os.path.basename(path)}") as bar:
        with reading(path):
            first = stream.read(5)
            if first != b"ITEM:":
                what = "is not a LAMMPS text dump: it does not begin with ITEM:" if first else "is empty"
                raise HVIError(f"{path} {what}")
            stream.seek(0)
            return _headers(path, _items(stream, bar))


def _headers(path, items):
    headers, header, units, seen = [], None, None, set()
    for offset, text, lines, size in items:
        kind = text[5:].split(b"\n", 1)[0].split()[:1]
        kind = kind[0] if kind else b""
        if header is not None and kind in seen:  # the header began again: the frame before was cut off in its header
            header.problem = header.problem or "the header is cut off"
            headers.append(header)
            header = None
        if header is None:
            header, seen = Header(path, offset), set()
        seen.add(kind)
        try:
            last = _read_item(header, offset, text, lines, size)
        except IndexError:
            header.problem, last = header.problem or "the header is cut off", False
        except ValueError as error:
            header.problem = header.problem or str(error)
            last = header.body is not None
        if last:
            units = header.units = header.units or units  # written with the first frame only
            headers.append(header)
            header = None
    if header is not None:
        header.problem = header.problem or "the header is cut off"
        headers.append(header)
    return headers
