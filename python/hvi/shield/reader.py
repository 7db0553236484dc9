# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""YAML files by their nodes, which know their lines: messages name file, line and key. Tables of keys that they may have."""

import difflib
import math
import operator
import pathlib
from typing import Any, Callable, NamedTuple

import yaml

from ..errors import HVIError

REQUIRED = object()
SIZES = 1e-9, 1e9  # of numbers beside 0: what is beyond is a slip, and products of it no number
UNITS = {"_mm": " mm", "_km_s": " km/s", "_deg": " degrees", "_ksi": " ksi"}


class Reader:
    """The nodes of a YAML file. Methods that read a value take its node and key, and raise HVIError."""

    def __init__(self, path):
        self.path, self.at = pathlib.Path(path), {}  # at: nodes of what was read, by key
        try:
            self.root = yaml.compose(self.path.read_text())
        except OSError as problem:
            raise HVIError(f"cannot read {path}: {problem.strerror}") from None
        except yaml.MarkedYAMLError as problem:
            mark = problem.problem_mark or problem.context_mark
            raise HVIError(f"{path}, line {mark.line + 1}: not YAML: {problem.problem or problem.context}") from None
        except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as problem:
            raise HVIError(f"{path}: not YAML: {' '.join(str(problem).split())}") from None
        if self.root is None:
            raise HVIError(f"{path} is empty")

    def wrong(self, key, text, node=None):
        node = node or self.at.get(key) or self.root
        raise HVIError(f"{self.path}, line {node.start_mark.line + 1}: {key}: {text}")

    def mapping(self, node, key, fields):
        """{name: value} of fields {name: (function of node and key, default)}"""
        inside = f"{key}: " if key else ""
        if not isinstance(node, yaml.MappingNode):
            self.wrong(key or "the case", f"must be 'name: value' lines with {', '.join(fields)}", node)
        found = {}
        for name_node, value in node.value:
            if not isinstance(name_node, yaml.ScalarNode):  # as text a few aliases of aliases are gigabytes
                self.wrong(key or "the case", "a name must be a word", name_node)
            name = name_node.value
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

    def number(self, above=-math.inf, least=-math.inf, below=math.inf, whole=False):
        def read(node, key):
            try:
                value = float(node.value)
            except (TypeError, ValueError):
                value = math.nan
            unit = next((word for end, word in UNITS.items() if key.endswith(end)), "")
            if not math.isfinite(value):
                said = f", not {node.value!r}" if isinstance(node, yaml.ScalarNode) else ", not a list"
                self.wrong(key, f"must be a number of{unit}, without the unit{said}" if unit else f"must be a number{said}", node)
            if value and not SIZES[0] <= abs(value) <= SIZES[1]:
                self.wrong(key, f"must be {SIZES[0]:g} to {SIZES[1]:g} in size, or 0, not {node.value}", node)
            if whole and (value < 1 or value != int(value)):
                self.wrong(key, f"must be a whole number from 1 on, not {node.value}", node)
            if not (value > above and value >= least and value < below):
                bounds = [f"{word} {bound:g}" for word, bound in (("above", above), ("at least", least), ("below", below)) if math.isfinite(bound)]
                self.wrong(key, f"must be {' and '.join(bounds)}{unit}, not {node.value}", node)
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
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.wrong(key, "must be a word", node)
        return node.value

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


def fields(reader, table):
    """{name: (function of node and key, default)} of a table of keys, as Reader.mapping takes them"""
    return {name: (key.read(reader), key.default) for name, key in table.items()}
