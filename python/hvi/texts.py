# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Text files: those of users and YAML in them are read with a limit of their size, never executed, and byte order marks and line ends of Windows are no matter;
what must be whole for its reader is written beside its name first."""

import contextlib
import csv
import glob
import os
import pathlib
import re
import time
import uuid

from .errors import HVIError, reading

LARGEST = 100_000_000  # bytes of a text file,
YAML = 250_000  # of one in YAML, whose reader takes a second for so many,
NODES = 50_000  # and values in it, those that aliases repeat counted each time
ABANDONED = 3600  # seconds since a half-written file was last written to


def data_of(path, most=LARGEST):
    """The bytes of a text file; HVIError says why there are none"""
    with reading(path):
        with open(path, "rb") as stream:
            data = stream.read(most + 1)
        if len(data) > most:
            raise HVIError(f"{path} is larger than {most:,} bytes, more than any file of its kind needs: is it the right one?")
        if b"\0" in data:
            raise HVIError(f"{path} is no text file: it has a byte of 0")
        return data


def read(path, most=LARGEST):
    """The text of a file in UTF-8, whatever ends its lines"""
    data = data_of(path, most)
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as problem:
        raise HVIError(f"{path}, line {data.count(bytes([10]), 0, problem.start) + 1}: no UTF-8 text (byte {data[problem.start]:#x}): save it as UTF-8") from None


@contextlib.contextmanager
def whole(path):
    """A stream for a text file that others see whole or not at all, also where the machine stops; of processes that write it at once, the last one's stays"""
    for left in pathlib.Path(path).parent.glob(f"{glob.escape(pathlib.Path(path).name)}.*.new"):  # by a call that was killed
        with contextlib.suppress(OSError):
            if re.fullmatch(r"[0-9a-f]{32}", left.name[len(pathlib.Path(path).name) + 1:-4]) and time.time() - left.stat().st_mtime > ABANDONED:
                left.unlink()
    new = pathlib.Path(path).with_name(f"{pathlib.Path(path).name}.{uuid.uuid4().hex}.new")
    try:
        with open(new, "w", newline="", encoding="utf-8") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(new, path)
    except OSError as problem:
        if problem.filename in (new, str(new)):
            problem.filename = str(path)
        raise
    finally:
        new.unlink(missing_ok=True)


def name_of(path):
    """of the folder of the runs of a case or study: that of its file without the ending"""
    name = pathlib.Path(path).stem
    if not name.strip(".") or not name.isprintable():
        raise HVIError(f"{str(path)!r}: runs have the name of this file, and {name!r} can be none of a folder: rename the file")
    return name


def table(path):
    """(names, [(line, cells), ...]) of a CSV file; lines that begin with # are remarks"""
    kept = [(number, line) for number, line in enumerate(read(path).splitlines(), 1) if line.strip() and not line.startswith("#")]
    try:
        rows = list(csv.reader([line for _, line in kept], strict=True))
        if len(rows) < len(kept):
            raise csv.Error("a quote is open at the end of a line")
    except csv.Error as problem:
        raise HVIError(f"{path}: not a CSV table: {problem}") from None
    return rows[0] if rows else [], [(number, row) for (number, _), row in zip(kept[1:], rows[1:])]


def compose(path, text=None):
    """The root node of a YAML file, or of the text of it that is YAML; None if it is empty"""
    import yaml

    try:
        root = yaml.compose(read(path, YAML) if text is None else text, Loader=yaml.SafeLoader)
        if root is not None:
            _count(root, {}, path)
        return root
    except yaml.MarkedYAMLError as problem:
        mark = problem.problem_mark or problem.context_mark
        raise HVIError(f"{path}, line {mark.line + 1}: not YAML: {problem.problem or problem.context}") from None
    except yaml.YAMLError as problem:
        raise HVIError(f"{path}: not YAML: {' '.join(str(problem).split())}") from None
    except RecursionError:
        raise HVIError(f"{path}: lists and mappings within each other go deeper than can be read") from None


def _count(node, known, path):
    """how many values a node has, aliases as often as they are there; known: {node: its number, None while it is counted}"""
    if id(node) not in known:
        known[id(node)] = None
        inside = [] if isinstance(node.value, str) else [part for item in node.value for part in (item if isinstance(item, tuple) else (item,))]
        known[id(node)] = 1 + sum(_count(part, known, path) for part in inside)
    found = known[id(node)]
    if found is None or found > NODES:
        raise HVIError(f"{path}, line {node.start_mark.line + 1}: " + ("an alias within what it stands for" if found is None else f"aliases make more than {NODES:,} values of this"))
    return found


def load(path, text=None):
    """What a YAML file says, of plain kinds: numbers, texts, lists, mappings; a key that is there twice is an error"""
    import yaml

    root = compose(path, text)
    if root is None:
        return None
    _refuse_twice(root, path)
    try:
        return yaml.SafeLoader("").construct_document(root)
    except yaml.MarkedYAMLError as problem:
        raise HVIError(f"{path}, line {problem.problem_mark.line + 1}: not YAML of plain values: {problem.problem}") from None
    except Exception as problem:  # of many kinds, such as a date that is none: constructors do not check what they take
        raise HVIError(f"{path}: not YAML of plain values: {' '.join(str(problem).split())}") from None


def _refuse_twice(node, path):
    if isinstance(node.value, str):
        return
    seen = set()
    for item in node.value:
        key, value = item if isinstance(item, tuple) else (None, item)
        if key is not None:
            if isinstance(key.value, str) and key.value in seen and key.value != "<<":
                raise HVIError(f"{path}, line {key.start_mark.line + 1}: {key.value}: is there twice")
            seen.add(key.value if isinstance(key.value, str) else id(key))
        _refuse_twice(value, path)
