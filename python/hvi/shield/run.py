# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What a run of a shield has left: its plan, result and dumps, as the report, movies and exports take them."""

import dataclasses
import functools
import pathlib
import warnings

import numpy as np

from ..errors import HVIError, needed
from ..io.dump import Dump
from ..jobs import engine
from ..material.library import stem
from ..units import label
from . import case as cases
from .record import OF_A_PIECE, OF_THE_MODEL, UNITS, WALL, Record
from .script import CASE


class Said(dict):
    """A mapping of a file: what it lacks is an error that names file and key"""

    def __init__(self, path, mapping):
        super().__init__(mapping)
        self.path = path

    def __missing__(self, key):
        raise HVIError(f"{self.path} has no {key}: it is of another version of this package; run it again")


class Scene:
    """A frame of a run, whole, in mm, us and km/s: x, v (n, 3), body (n,): 0 the projectile, k wall k; radius (n,): of spheres of the particles' volume; spacing (n,)"""

    def __init__(self, frame, run):
        self.frame, whole = frame, frame.whole()
        self.whole = whole
        self.time = 1e6 * frame.time
        self.x, self.v = 1e3 * whole.x, 1e-3 * whole.v
        kind = whole["type"].astype(int)
        self.body, self.radius, self.spacing = run.bodies()[kind], run.radii()[kind], run.spacings()[kind]
        self.failed = (whole["damage"] >= 1.0) | (whole["spalled"] > 0.0)


class Run:
    """The folder of one run, as runs/quick/dx-0.5_shift-0.0.

    result, plan: mappings of result.yaml and plan.yaml, units in the names; case: the Case; walls: how many, reached: the last one that was struck; dx: mm between particles of the projectile;
    frames(): the hvi.Dump of all frames, scene(name): a dump in mm, us, km/s
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.name = self.folder.resolve().name
        self.result, self.plan = (engine.read_yaml(self.folder / f"{name}.yaml") for name in ("result", "plan"))
        self.job = engine.read_yaml(self.folder / "job.yaml") or {}
        if not self.result or engine.LAST not in self.result:
            raise HVIError(f"{self.folder}: no complete result.yaml: is the run over?")
        if not self.plan or not isinstance(self.plan.get("settings"), dict) or "materials" not in self.plan:
            raise HVIError(f"{self.folder / 'plan.yaml'} does not say what was run (materials, settings): it is of another version of this package; run it again")
        self.result = Said(self.folder / "result.yaml", self.result)
        self.plan, self.settings = (Said(self.folder / "plan.yaml", mapping) for mapping in (self.plan, self.plan["settings"]))
        self.walls, self.reached = int(self.result["walls"]), int(self.result["walls_reached"])
        self.materials = [str(name) for name in self.plan["materials"]]

    def of_wall(self, k, what):
        return self.plan[f"wall{k}_{what}"]

    def outers(self):
        """{type of the particles in the outer part of a wall: wall}"""
        return {int(self.plan[key]): k for k in range(1, self.walls + 1) if (key := f"wall{k}_outer_type") in self.plan}

    def by_type(self, values, outer):
        """values of the projectile and the walls as an array over types, 0 is none; outer(value): of the outer part of a wall"""
        outers = self.outers()
        found = np.zeros(1 + max([len(values), *outers]), dtype=np.asarray(values).dtype)
        found[1:1 + len(values)] = values
        for kind, k in outers.items():
            found[kind] = outer(values[k])
        return found

    def bodies(self):
        """of each type: 0 the projectile, k wall k"""
        return self.by_type(list(range(self.walls + 1)), lambda k: k)

    def type_names(self):
        """{type: "wall 1, Al6061-T6"}"""
        names = {1 + k: f"{f'wall {k}' if k else 'projectile'}, {stem(material)}" for k, material in enumerate(self.materials)}
        return {**names, **{kind: f"{names[1 + k]}, outer part" for kind, k in self.outers().items()}}

    def spacings(self):
        """the longest of a particle's cell, mm, for each type"""
        longest = [self.dx] + [max(self.of_wall(k, "spacing_mm"), self.of_wall(k, "thickness_mm") / self.of_wall(k, "layers")) for k in range(1, self.walls + 1)]
        return self.by_type(longest, lambda value: 2 * value)

    def radii(self):
        """of spheres of the volume of a particle, mm, for each type"""
        sides = [self.dx]
        for k in range(1, self.walls + 1):
            high = self.of_wall(k, "thickness_mm") / self.of_wall(k, "layers")
            sides.append((self.of_wall(k, "spacing_mm") ** 2 * high) ** (1 / 3))
        return (0.75 / np.pi) ** (1 / 3) * self.by_type(sides, lambda side: 2 * side)

    def faces(self, k):
        """front and rear of wall k before the shot, mm"""
        front = self.of_wall(k, "front_mm")
        return front, front + self.of_wall(k, "thickness_mm")

    @functools.cached_property
    def case(self):
        """the Case of this run"""
        with warnings.catch_warnings():  # what they say was said before it was run
            warnings.simplefilter("ignore")
            return dataclasses.replace(cases.read(self.folder / CASE), name=self.name)

    @property
    def R(self):
        """radius of the projectile, mm"""
        return self.case.projectile.radius_mm

    @property
    def dx(self):
        """of its particles, mm"""
        return self.case.spacings_mm[0]

    def dataframe(self):
        """A pandas.DataFrame with a row per moment, index "time (us)": for each wall the columns of compute hvi/wall, as "wall2 momentum (kg m/s)", in SI, of the whole shield also where a
        quarter was modeled. HVIError if pandas, or a file of the run, is not there."""
        pandas = needed("pandas", "dataframe() needs")
        record = Record(self.folder)
        images, columns = 4 if str(self.settings["quarter"]) == "yes" else 1, {}
        for k in range(1, self.walls + 1):
            for name in WALL:
                unit = UNITS.get(name)
                times = images if unit in OF_THE_MODEL and name not in OF_A_PIECE or name == "apart_number" else 1
                columns[label(f"wall{k} {name}", unit)] = times * getattr(record.pieces, name)[:, k - 1]
        return pandas.DataFrame(columns, index=pandas.Index(record.seldom_us, name="time (us)"))

    def dumps(self):
        """paths of all frames, in order of time"""
        found = engine.frames(self.folder, "film.*.dump")
        return [path for path in (*found, *(self.folder / f"cloud{k}.dump" for k in range(1, self.reached)), self.folder / "shield.dump") if path.is_file()]

    def frames(self):
        """A Dump of all frames, one of each step; HVIError if there is none"""
        paths = self.dumps()
        if not paths:
            raise HVIError(f"{self.folder}: no shield.dump, cloud1.dump or film.*.dump: there is nothing to draw")
        steps = {}
        for path in paths:
            steps.setdefault(int(Dump(path).steps[-1]), path)
        return Dump([steps[step] for step in sorted(steps)])

    def scene(self, name):
        """The Scene of a dump by its name, None if it is not there"""
        path = self.folder / name
        return Scene(Dump(path)[-1], self) if path.is_file() else None

    def film(self, most=6):
        """Scenes over time: begin, middle and end of each stage, and more of the last one"""
        dump = self.frames()
        times = np.array([1e6 * dump.time(k) for k in range(len(dump))])
        ends = [float(self.result[f"wall{k}_until_us"]) for k in range(1, self.reached + 1)]
        begin = ends[-2] if len(ends) > 1 else 0.0
        targets = [0.0, 0.5 * ends[0], *ends[:-1], *(begin + part * (ends[-1] - begin) for part in (0.2, 0.5, 1.0))]
        if len(targets) > most:  # many walls
            targets = [0.0, *targets[2:][1 - most:]]
        return [Scene(dump[int(k)], self) for k in dict.fromkeys(int(np.argmin(np.abs(times - t))) for t in targets)]


def texts(mapping, key):
    """a list of texts, where a file has a list, one text or none"""
    found = mapping.get(key) or []
    return [str(text) for text in (found if isinstance(found, list) else [found])]


def runs_of(folder):
    """(verdict.yaml or None, [Run, ...] with the finest first) of a folder of hvi shield, or of a single run"""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise HVIError(f"{folder} is not a folder")
    said = engine.read_yaml(folder / "verdict.yaml")
    if said and not (isinstance(said.get("runs"), dict) and said["runs"]):
        raise HVIError(f"{folder / 'verdict.yaml'} names no runs: call python3 -m hvi shield again")
    if said:
        return said, sorted((Run(folder / str(name)) for name in said["runs"]), key=lambda run: (run.dx, -run.case.shifts[0]))
    if (folder / "result.yaml").is_file():
        return None, [Run(folder)]
    raise HVIError(f"{folder} has neither verdict.yaml (of python3 -m hvi shield) nor result.yaml (of one of its runs)")
