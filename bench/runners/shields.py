# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A case of hvi shield, or a study of hvi shots, as an input with variables: what the runner impact runs where a scene is a YAML file."""

import dataclasses
import pathlib
import warnings

import yaml
from hvi.errors import HVIError
from hvi.jobs import engine
from hvi.shield import chain, elements, geometry, script, shots
from hvi.shield import case as cases

from lammps_runs import Stopped
from . import Cannot

OF_A_CASE, OF_A_STUDY = ("dx", "shift", "method"), ("shot", "finer")  # variables beside the settings of a case


def whole_elements(thickness, dx):
    """(layers of particles in a wall, of them along the edge of an element); Cannot if they are no whole elements. mm"""
    layers = geometry.layers(thickness, dx)
    n = elements.per_edge(layers)
    if n is None:
        raise Cannot(f"{layers} layers of particles (spacing {dx:g} mm) are no whole elements of 2 or 3 each way")
    return layers, n


class Shields:
    """The YAML file of a case (variables dx, shift, method), or of a study (shot; finer: divides the spacings of its rule)"""

    def __init__(self, path):
        self.path, self.name = pathlib.Path(path), pathlib.Path(path).name
        self.study = "list" in (engine.read_yaml(self.path) or {})

    def check(self, variables, where):
        for name in variables:
            if name not in (*(OF_A_STUDY if self.study else OF_A_CASE), *cases.SETTINGS):
                raise HVIError(f"{where}: {self.name} has no setting '{name}'")

    def published(self, names, finer=1.0):
        """[(Shot, Case), ...] of a study"""
        study = shots.Study(self.path)
        study.rule = {name: value if name in ("ratio", "core") else value * float(finer) for name, value in study.rule.items()}
        return [(shot, study.case(shot)) for shot in shots.named(study.shots, names, self.path)]

    def case(self, variables, folder):
        """of one spacing and shift; the file that it is read from is in the folder"""
        given = dict(variables)
        if self.study:
            ((_, case),) = self.published([given.pop("shot")], given.pop("finer", 1.0))
            return dataclasses.replace(case, settings={**case.settings, **given})
        said = yaml.safe_load(self.path.read_text())
        said.update(spacings_mm=[given.pop("dx")], shifts=[given.pop("shift", 0)], method=given.pop("method", "sph"))
        if said["method"] != "sph":
            for wall in said["walls"]:
                whole_elements(wall["thickness_mm"], said["spacings_mm"][0])
        said["settings"] = {**said.get("settings", {}), **given}
        (folder / self.name).write_text(yaml.safe_dump(said))
        return cases.read(folder / self.name)

    def write(self, variables, folder):
        """the folder of a run; its script.Shield"""
        with warnings.catch_warnings():  # of few layers
            warnings.simplefilter("ignore")
            case = self.case(variables, folder)
        return chain.write_run(case, 0, case.shifts[0], folder)

    def run(self, lmp, variables, folder, **how):
        """(Result of the run, result.yaml); lmp: tests/lib/lammps_runs.py's executor"""
        shield = self.write(variables, folder)
        r = lmp(folder / script.BEGIN, **how)
        (folder / "log.lammps").write_text(r.log)
        try:
            chain.write_result(shield, folder)
        except HVIError as why:  # of what the run has left; a case that is wrong has been refused before
            raise Stopped(str(why)) from None
        return r, engine.read_yaml(folder / "result.yaml")
