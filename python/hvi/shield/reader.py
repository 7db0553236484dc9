# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""YAML files by their nodes, which know their lines: messages name file, line and key. Tables of keys that they may have."""

import difflib
import math
import operator
import pathlib
import re
from typing import Any, Callable, NamedTuple

import yaml

from .. import texts
from ..errors import HVIError

REQUIRED = object()
SANE = 1e-6, 1e7  # mm
UNITS = {"_mm": " mm", "_km_s": " km/s", "_deg": " degrees", "_ksi": " ksi"}


class Reader:
    """The nodes of a YAML file. Methods that read a value take its node and key, and raise HVIError."""

    def __init__(self, path):
        self.path, self.at = pathlib.Path(path), {}  # at: nodes of what was read, by key
        self.root = texts.compose(self.path)
        if self.root is None:
            raise HVIError(f"{path} is empty")

    def wrong(self, key, text, node=None):
        node = node or self.at.get(key) or self.root
        raise HVIError(f"{self.path}, line {node.start_mark.line + 1}: {' '.join(f'{key}: {text}'.split())}")

    def mapping(self, node, key, fields):
        """{name: value} of fields {name: (function of node and key, default)}"""
        inside = f"{key}: " if key else ""
        if not isinstance(node, yaml.MappingNode):
            self.wrong(key or "the case", f"must be 'name: value' lines with {', '.join(fields)}", node)
        found = {}
        for name_node, value in node.value:
            name = name_node.value if isinstance(name_node, yaml.ScalarNode) else "a list or mapping"
            if name not in fields:
                near = difflib.get_close_matches(name, fields, 1, 0.5)
                self.wrong(inside + name, "no such key" + (f"; did you mean {near[0]}?" if near else "") + f" (known: {', '.join(fields)})", name_node)
            if name in found:
                self.wrong(inside + name, "is there twice", name_node)
            self.at[inside + name] = value
            found[name] = fields[name][0](value, inside + name)
        for name, (_, default) in fields.items():
            if name not in found and default is REQUIRED:
                self.wrong(inside + name, "is missing", node)
            found.setdefault(name, default)
        return found

    def number(self, above=-math.inf, least=-math.inf, below=math.inf, whole=False, sane=None):
        """sane: (least, most) of what is no mistake; of lengths in mm SANE"""
        def read(node, key):
            try:
                value = float(node.value)
            except (TypeError, ValueError):
                value = math.nan
            unit = next((word for end, word in UNITS.items() if key.endswith(end)), "")
            if not math.isfinite(value):
                said = f", not {node.value!r}" if isinstance(node, yaml.ScalarNode) else ", not a list"
                self.wrong(key, f"must be a number of{unit}, without the unit{said}" if unit else f"must be a number{said}", node)
            if whole and (value < 1 or value != int(value)):
                self.wrong(key, f"must be a whole number from 1 on, not {node.value}", node)
            if not (value > above and value >= least and value < below):
                bounds = [f"{word} {bound:g}" for word, bound in (("above", above), ("at least", least), ("below", below)) if math.isfinite(bound)]
                self.wrong(key, f"must be {' and '.join(bounds)}{unit}, not {node.value}", node)
            low, high = sane or (SANE if unit == " mm" else (0, math.inf))
            if value and not low <= abs(value) <= high:
                self.wrong(key, f"{node.value}{unit} is out of all reason, {low:g} to {high:g} is possible: is it in the right units?", node)
            return int(value) if whole else value
        return read

    def several(self, item, distinct=False):
        def read(node, key):
            if not isinstance(node, yaml.SequenceNode) or not node.value:
                self.wrong(key, "must be a list, like [0.4, 0.2]", node)
            values = tuple(item(n, key) for n in node.value)
            if distinct and len(set(values)) < len(values):
                self.wrong(key, "a value is there twice", node)
            return values
        return read

    def text(self, node, key):
        if not isinstance(node, yaml.ScalarNode) or not node.value or node.tag.endswith(":null"):
            self.wrong(key, "must be a word", node)
        if not node.value.isprintable():
            self.wrong(key, f"must be words in one line, without control characters, not {node.value!r}", node)
        return node.value

    def words(self, node, key):
        """words that go into a LAMMPS input: with quotes, $, # or & they could be more than that"""
        value = self.text(node, key)
        if odd := re.search(r"[^\w .:+*/-]", value, re.A):
            self.wrong(key, f"{odd[0]!r} cannot be in words of a LAMMPS input: letters, digits, blanks and _ . : + - * / can", node)
        return value

    def choice(self, known, hint=""):
        def read(node, key):
            if node.value not in known:
                *most, last = known
                said = node.value if isinstance(node, yaml.ScalarNode) else "a list"
                self.wrong(key, f"must be {', '.join(most)} or {last}, not {said}{hint}", node)
            return node.value
        return read


# ---------------------------------------------------------------------- tables of keys
class Key(NamedTuple):
    """read: of a Reader, gives what reads a value; default, REQUIRED if there is none; text: what it is"""

    read: Callable[[Reader], Callable]
    default: Any
    text: str


def number(**bounds):
    return operator.methodcaller("number", **bounds)


def choice(*known, hint=""):
    return operator.methodcaller("choice", known, hint)


def several(item, distinct=False):
    return lambda reader: reader.several(item(reader), distinct)


word = operator.attrgetter("text")
lammps_words = operator.attrgetter("words")


def fields(reader, table):
    """{name: (function of node and key, default)} of a table of keys, as Reader.mapping takes them"""
    return {name: (key.read(reader), key.default) for name, key in table.items()}
