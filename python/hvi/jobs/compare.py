# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Two runs side by side: result.yaml of two examples, or the same measures of two dumps."""

import math
import os

from .. import texts
from ..errors import HVIError

MISSING = "-"
WIDE = 40  # characters of a text in a table


def read_result(path):
    """{key: value} of a result.yaml; numbers as int or float, all else as text: items of a list are joined, hole_mm of the mapping margins is margins.hole_mm"""
    if os.path.isdir(path):
        path = os.path.join(path, "result.yaml")
    result, first, root = {}, {}, texts.compose(path)

    def add(mapping, before):
        for key, node in mapping.value:
            name, line = before + _text(key), key.start_mark.line + 1
            if first.setdefault(name, key) is not key:
                raise HVIError(f"{path}, line {line}: {name} is there twice, first in line {first[name].start_mark.line + 1}")
            if node.tag == "tag:yaml.org,2002:map":
                add(node, f"{name}.")
            else:
                result[name] = _value(_text(node))

    if root is not None and root.tag == "tag:yaml.org,2002:map":
        add(root, "")
    if not result:
        raise HVIError(f"{path} has no values, key: value")
    return result


def _text(node):
    """of a YAML node: a scalar as it is written"""
    if isinstance(node.value, str):
        return node.value
    return "; ".join(": ".join(map(_text, item)) if isinstance(item, tuple) else _text(item) for item in node.value)


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
