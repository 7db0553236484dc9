# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A LAMMPS input for many values of its variables, as a study file says."""

import itertools
import math
import os
import re

from .. import texts
from ..errors import HVIError
from . import engine, measures

MOST = 10_000  # jobs of a study
PLAIN = r"[-+]?(0|[1-9]\d*|\d*\.\d*)([eE][-+]?\d+)?"  # a number that YAML 1.1 reads as LAMMPS does: not octal, not of base 60
KEYS = {"input", "variables", "grid", "ranks", "timeout", "restart", "continue", "remove", "full"}


class Job(engine.Job):
    """A run of a study; what it has recorded is measured when it ends"""

    def finish(self):
        try:
            if measures.functions_of(self.folder):
                measures.measure(self.folder)
        except HVIError as problem:
            return str(problem)
        return ""


def refuse_changed(root, path):
    """values of variables that YAML reads as something else than what is written: LAMMPS would get another word"""
    def scalars(node):
        if isinstance(node.value, str):
            yield node
        else:
            for item in node.value:
                yield from scalars(item[1] if isinstance(item, tuple) else item)

    def look(node):
        for key, value in node.value if isinstance(node.value, list) and node.tag.endswith(":map") else ():
            if key.value in ("variables", "grid") and not isinstance(value.value, str):
                for one in scalars(value):
                    kind = one.tag.rpartition(":")[2]
                    if one.style is None and kind != "str" and not (kind in ("int", "float") and re.fullmatch(PLAIN, one.value)):
                        raise HVIError(f"{path}, line {one.start_mark.line + 1}: " + (
                            f"{one.value} would reach LAMMPS as another word: write it in quotes, '{one.value}'" if one.value else "a variable without a value"))
            elif key.value == "full":
                look(value)

    look(root)


class Study:
    """A study file: the input, and the variables of each job."""

    def __init__(self, path, full=False):
        if not path.is_file():
            raise HVIError(f"{path}: no such file")
        study = texts.load(path)
        if not isinstance(study, dict):
            raise HVIError(f"{path}: not a mapping of {', '.join(sorted(KEYS))}")
        refuse_changed(texts.compose(path), path)
        self.path = path
        if full:
            if not isinstance(study.get("full"), dict):
                raise HVIError(f"{path}: no full size (key 'full') in this study")
            study = {**study, **{key: {**self._mapping(study, key), **value} if isinstance(value, dict) else value
                                 for key, value in study["full"].items()}}
        unknown = set(study) - KEYS
        if unknown:
            raise HVIError(f"{path}: unknown key {', '.join(sorted(map(str, unknown)))}; known: {', '.join(sorted(KEYS))}")
        self.name = texts.name_of(path) + ("-full" if full else "")
        self.ranks, self.timeout = study.get("ranks"), study.get("timeout")
        self.restart, self.remove = study.get("restart"), study.get("remove") or []
        if self.restart is not None and not isinstance(self.restart, str):
            raise HVIError(f"{path}: restart must be a pattern of file names, not {type(self.restart).__name__}")
        if not isinstance(self.remove, list):
            raise HVIError(f"{path}: remove must be a list of patterns of file names")
        for pattern in [*self.remove, *([self.restart] if self.restart else [])]:
            if not isinstance(pattern, str) or not pattern or not engine.inside(pattern):
                raise HVIError(f"{path}: {pattern!r}: restart and remove are of files in the folder of a run: no .., no whole paths")
        for key, kind, what in (("ranks", int, "a whole number from 1 on"), ("timeout", (int, float), "a number of seconds above 0")):
            if (value := study.get(key)) is not None and (isinstance(value, bool) or not isinstance(value, kind) or not 0 < value < math.inf):
                raise HVIError(f"{path}: {key} must be {what}, not {value!r}")
        if (self.restart is None) != ("continue" not in study):
            raise HVIError(f"{path}: restart (files to go on from) and continue (the input that does) are given together, or neither")
        self.input = self._input(study, "input")
        self.goes_on = self._input(study, "continue") if self.restart else None
        self.fixed = self._mapping(study, "variables")
        self.cases = self._cases(study)
        for case in self.cases:
            self.input.check({**self.fixed, **case}, path)
            if self.goes_on:
                self.goes_on.check({**self.fixed, **case, "from": "file"}, path)

    def _input(self, study, key):
        file = self.path.parent / str(study.get(key))
        if not os.path.isfile(file):  # is_file() raises for a long name
            raise HVIError(f"{self.path}: {key} {study.get(key)} is not there (paths count from the study file)")
        return engine.Input(file)

    def _mapping(self, study, key):
        value = study.get(key) or {}
        if not isinstance(value, dict):
            raise HVIError(f"{self.path}: {key} must be 'name: value' lines")
        return value

    def _cases(self, study):
        """what varies, as a list of {variable: value}: every combination of the grid's axes

        An axis is a list of values of the variable that it is named for, or of mappings that set several variables.
        The value of a variable per wall is a list itself.
        """
        axes = []
        for name, values in self._mapping(study, "grid").items():
            if not isinstance(values, list) or not values:
                raise HVIError(f"{self.path}: grid: {name} must be a list of values")
            axes.append([value if isinstance(value, dict) else {name: value} for value in values])
        if math.prod(map(len, axes)) > MOST:
            raise HVIError(f"{self.path}: the grid has {math.prod(map(len, axes)):,} points, {MOST:,} at most are run")
        if not axes:
            raise HVIError(f"{self.path}: no grid: nothing to vary")
        names = [name for axis in axes for name in set().union(*axis)]
        twice = {name for name in names if names.count(name) > 1}
        if twice:
            raise HVIError(f"{self.path}: grid: more than one axis sets {', '.join(sorted(map(str, twice)))}: set it in one of them")
        found = [{n: v for part in point for n, v in part.items()} for point in itertools.product(*axes)]
        names = [engine.job_name(c) for c in found]
        twice = {n for n in names if names.count(n) > 1}
        if twice:
            raise HVIError(f"{self.path}: the same job twice: {', '.join(sorted(twice))}")
        return found

    def jobs(self, folder):
        return [Job(self.input, name, {**self.fixed, **case}, folder / self.name / name, self.restart, self.remove, goes_on=self.goes_on)
                for case, name in ((case, engine.job_name(case)) for case in self.cases)]
