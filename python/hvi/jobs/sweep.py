# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A LAMMPS input for many values of its variables, as a study file says."""

import itertools
import math
import os

from ..errors import HVIError, reading
from . import engine, measures

KEYS = {"input", "variables", "grid", "ranks", "timeout", "restart", "continue", "remove", "full"}
MOST = 10_000  # jobs


class Job(engine.Job):
    """A run of a study; what it has recorded is measured when it ends"""

    def finish(self):
        try:
            if measures.functions_of(self.folder):
                measures.measure(self.folder)
        except HVIError as problem:
            return str(problem)
        return ""


class Study:
    """A study file: the input, and the variables of each job."""

    def __init__(self, path, full=False):
        if not path.is_file():
            raise HVIError(f"{path}: no such file")
        with reading(path):
            study = engine.loaded(path.read_text(), path)
        if not isinstance(study, dict):
            raise HVIError(f"{path}: not a mapping of {', '.join(sorted(KEYS))}")
        self.path = path
        if full:
            if not isinstance(study.get("full"), dict):
                raise HVIError(f"{path}: no full size (key 'full') in this study")
            study = {**study, **{key: {**self._mapping(study, key), **value} if isinstance(value, dict) else value
                                 for key, value in study["full"].items()}}
        unknown = set(study) - KEYS
        if unknown:
            raise HVIError(f"{path}: unknown key {', '.join(sorted(map(str, unknown)))}; known: {', '.join(sorted(KEYS))}")
        self.name = path.stem + ("-full" if full else "")
        self.ranks, self.timeout = study.get("ranks"), study.get("timeout")
        self.restart, self.remove = study.get("restart"), study.get("remove") or []
        if (self.restart is None) != ("continue" not in study):
            raise HVIError(f"{path}: restart (files to go on from) and continue (the input that does) are given together, or neither")
        self.input = self._input(study, "input")
        self.goes_on = self._input(study, "continue") if self.restart else None
        self.fixed = self._mapping(study, "variables")
        self.cases = self._cases(study)
        for case in self.cases:
            self.input.check({**self.fixed, **case}, path)
            if self.goes_on:
                self.goes_on.check({**self.fixed, **case, "from": ""}, path)

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
        if not axes:
            raise HVIError(f"{self.path}: no grid: nothing to vary")
        if math.prod(map(len, axes)) > MOST:
            raise HVIError(f"{self.path}: a grid of {math.prod(map(len, axes))} jobs; {MOST} at most are run")
        found = [{n: v for part in point for n, v in part.items()} for point in itertools.product(*axes)]
        names = [engine.job_name(c) for c in found]
        twice = {n for n in names if names.count(n) > 1}
        if twice:
            raise HVIError(f"{self.path}: the same job twice: {', '.join(sorted(twice))}")
        return found

    def jobs(self, folder):
        return [Job(self.input, name, {**self.fixed, **case}, folder / self.name / name, self.restart, self.remove, goes_on=self.goes_on)
                for case, name in ((case, engine.job_name(case)) for case in self.cases)]
