# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Two runs side by side: result.yaml of two examples, or the same measures of two dumps."""

import math
import os

from .. import texts
from ..errors import HVIError

MISSING = "-"
WIDE = 40  # characters of a text in a table


def read_result(path):
    """{key: value} of a result.yaml, "key: value" per line; numbers as int or float, all else as text.

    A list "- text" belongs to the key before and is joined; so does what is indented: "margins:" and "  hole_mm: 0" are margins.hole_mm.
    """
    if os.path.isdir(path):
        path = os.path.join(path, "result.yaml")
    lines = texts.read(path).splitlines()
    result, parent, given = {}, None, {}
    for number, raw in enumerate(lines, 1):
        line = raw.split(" #")[0].strip()
        if not line or line.startswith("#") or line == "---":
            continue
        inside = (raw[0] == " " or line.startswith("- ")) and parent is not None
        if inside and line.startswith("- "):
            result[parent] = "; ".join(filter(None, [result.get(parent), line[2:]]))
            continue
        key, found, value = line.partition(":")
        key, value = key.strip(), value.strip().strip("\"'")
        if not found:
            raise HVIError(f"{path}, line {number}: not key: value")
        if not inside:
            if key in given:
                raise HVIError(f"{path}, line {number}: {key} is there twice, first in line {given[key]}")
            given[key], parent = number, None if value else key
        if inside:
            key = f"{parent}.{key}"
            if key in result or not value:
                raise HVIError(f"{path}, line {number}: {key} has no value of its own: mappings in mappings are not compared")
        if value:
            result[key] = _value(value)
    if not result:
        raise HVIError(f"{path} has no values")
    return result


def _value(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def relative(a, b):
    """(b - a) / |a|; 0 if they are equal, infinite if only a is 0, NaN if they are no numbers"""
    if not (isinstance(a, (int, float)) and isinstance(b, (int, float))):
        return math.nan
    if a == b:
        return 0.0
    return (b - a) / abs(a) if a else math.copysign(math.inf, b)


def rows(a, b):
    """(key, value in a, value in b, difference, relative difference) of all keys, in the order of a, then what only b has.

    What one does not have is MISSING; for texts the relative difference is "" if they are equal, else "differs".
    """
    table = []
    for key in [*a, *(key for key in b if key not in a)]:
        left, right = a.get(key, MISSING), b.get(key, MISSING)
        if all(isinstance(value, (int, float)) for value in (left, right)):
            table.append((key, left, right, right - left, relative(left, right)))
        else:
            table.append((key, left, right, "", "" if left == right else "differs"))
    return table


def cut(value):
    """a text short enough for a table"""
    return f"{value[:WIDE - 3]}..." if isinstance(value, str) and len(value) > WIDE else value


def largest(table):
    """Largest relative difference of all numbers in rows(); infinite where texts differ, a key is missing or one is NaN"""
    sizes = [0.0]
    for *_, change in table:
        if change == "differs" or (isinstance(change, float) and math.isnan(change)):
            sizes.append(math.inf)
        elif change != "":
            sizes.append(abs(change))
    return max(sizes)
