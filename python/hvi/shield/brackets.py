# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Shields whose limit published shots bracket: the limit of the simulation and of equations beside the measured one.

A study says which list, how many particles across the projectile, and the one rule of spacings for all of them. The limit of each bracket is looked for
by bisection over a geometric grid about the measured one, by runs as those of hvi shield.
"""

import dataclasses
import math
import pathlib
import re

from .. import texts
from ..errors import HVIError
from . import ble, decision, shots
from .limit import Search
from .projectile import FILLS
from .reader import REQUIRED, Reader, choice

COLUMNS = ("name", "source", "proj_mat", "D_mm", "km_s", "bumper", "tb_mm", "gap_mm", "wall", "yield_ksi", "tw_mm", "on", "low", "high", "fails", "holds")
ON = {"wall": "wall_mm", "diameter": "diameter_mm"}  # what varies: member of Shot
BEGIN = 3  # steps on both sides of the measured limit that a search begins with


@dataclasses.dataclass(frozen=True)
class Bracket:
    """low, high: the limit lies between, mm; fails, holds: the shots that say so"""

    shot: shots.Shot  # but for what varies
    on: str
    low: float
    high: float
    fails: str
    holds: str

    @property
    def name(self):
        return self.shot.name

    @property
    def middle(self):
        return math.sqrt(self.low * self.high)

    def at(self, value):
        return dataclasses.replace(self.shot, **{ON[self.on]: value})

    def error(self, limit):
        return error(self.on, self.low, self.high, limit)


def error(on, low, high, limit):
    """ln(limit / nearest edge of a bracket), 0 within it; above 0 is safe: a thicker wall, a smaller projectile than measured"""
    edge = min(max(limit, low), high)
    return (1 if on == "wall" else -1) * math.log(limit / edge)


def read_list(path):
    """The brackets of a CSV file: mm, km/s, ksi; a dash is no shot on that side; lines that begin with # are remarks."""
    head, rows = texts.table(path)
    if missing := [name for name in COLUMNS if name not in head]:
        raise HVIError(f"{path}: no column {', '.join(missing)}")
    found = []
    for number, row in rows:
        def wrong(text):
            raise HVIError(f"{path}, line {number}: {text}")

        if len(row) != len(head):
            wrong(f"{len(row)} values in {len(head)} columns")
        found.append(_bracket({name: text.strip() for name, text in zip(head, row)}, wrong))
        if found[-1].name in [one.name for one in found[:-1]]:
            wrong(f"bracket {found[-1].name} is there twice")
    if not found:
        raise HVIError(f"{path}: no brackets")
    return found


def _bracket(cells, wrong):
    if not cells["name"].strip(".") or re.search(r"[^\w.+-]", cells["name"]):
        wrong(f"name {cells['name']!r} is one of folders, too: letters, digits and . _ + - only")
    if cells["on"] not in ON:
        wrong(f"on must be {' or '.join(ON)}, not {cells['on']!r}")
    varies = {"wall": "tw_mm", "diameter": "D_mm"}[cells["on"]]
    value = {}
    for name in ("D_mm", "km_s", "tb_mm", "gap_mm", "yield_ksi", "tw_mm", "low", "high"):
        if name == varies:
            value[name] = 0.0
            continue
        try:
            value[name] = float(cells[name])
        except ValueError:
            value[name] = math.nan
        if not 0 < value[name] < math.inf:
            wrong(f"{name} must be a number above 0, not {cells[name]!r}")
        if not shots.SMALLEST <= value[name] < shots.LARGEST:
            wrong(f"{name} must be {shots.SMALLEST:g} to {shots.LARGEST:g}, not {cells[name]}: lengths are in mm, speeds in km/s, stresses in ksi")
    if value["low"] >= value["high"]:
        wrong(f"low {value['low']:g} must be below high {value['high']:g}")
    shot = shots.Shot(cells["name"], cells["source"], cells["proj_mat"], value["D_mm"], 0.0, value["km_s"], cells["bumper"], value["tb_mm"], value["gap_mm"],
                      cells["wall"], value["yield_ksi"], value["tw_mm"], "")
    return Bracket(shot, cells["on"], value["low"], value["high"], cells["fails"], cells["holds"])


class Study:
    """A study file: the list, and the one rule for all of its brackets."""

    def __init__(self, path):
        self.path = path = pathlib.Path(path)
        reader = Reader(path)
        whole, table = reader.number(above=0, sane=(1e-3, 1e3)), shots.material_table(reader)
        data = reader.mapping(reader.root, "", {
            "list": (reader.text, REQUIRED), "brackets": (reader.several(reader.text, distinct=True), None),
            "across": (reader.several(whole, distinct=True), REQUIRED),
            "spacing": (lambda node, key: reader.mapping(node, key, {**{name: (whole, REQUIRED) for name in ("bumper_layers", "wall_layers", "ratio")}, "core": (whole, None)}), REQUIRED),
            "shifts": (reader.several(reader.number(least=0, below=1), distinct=True), (0.0,)), "fill": (choice(*FILLS)(reader), FILLS[0]),
            "step": (reader.number(above=0, below=0.5, sane=(1e-3, 1)), 0.05), "range": (reader.number(above=1, below=10), 2.0),
            "settings": (lambda node, key: shots.cases.read_settings(reader, node, key), {}), "materials": (table, REQUIRED), "stand_ins": (table, {})})
        self.name, self.across, self.rule, self.shifts, self.settings = texts.name_of(path), data["across"], data["spacing"], data["shifts"], data["settings"]
        if data["fill"] != FILLS[0]:
            self.rule = {**self.rule, "fill": data["fill"]}
        self.materials, self.stand_ins = {**data["materials"], **data["stand_ins"]}, data["stand_ins"]
        self.step, self.brackets = 1 + data["step"], read_list(path.parent / data["list"])
        self.half = math.ceil(math.log(data["range"]) / math.log(self.step))
        if names := data["brackets"]:
            known = {one.name: one for one in self.brackets}
            if unknown := [name for name in names if name not in known]:
                reader.wrong("brackets", f"no bracket {unknown[0]} (known: {', '.join(known)})")
            self.brackets = [known[name] for name in names]
        for bracket in self.brackets:
            for alloy in bracket.shot.alloys():
                if alloy not in self.materials:
                    raise HVIError(f"{path}: bracket {bracket.name}: no material for {alloy}")

    def values(self, bracket):
        return [float(f"{bracket.middle * self.step**k:.4g}") for k in range(-self.half, self.half + 1)]

    def case(self, bracket, across, value):
        return shots.case_of(bracket.at(value), {**self.rule, "across": across}, self.materials, self.shifts, self.settings, f"{self.path}: bracket {bracket.name}")


class Found:
    """The search of one bracket at so many particles across and one shift of the lattice."""

    def __init__(self, study, bracket, across, shift, folder):
        self.study, self.bracket, self.across, self.shift, self.folder = study, bracket, across, shift, folder
        self.values, self.jobs = study.values(bracket), {}
        middle = study.half
        self.search = Search(2 * middle, (middle - BEGIN, middle + BEGIN), turned=bracket.on == "wall")

    def name(self, place):
        return f"{self.bracket.name}_across-{self.across:g}_shift-{self.shift:g}_{self.bracket.on}-{self.values[place]:g}"

    def job(self, place):
        case, name = self.study.case(self.bracket, self.across, self.values[place]), self.name(place)
        return decision.job(case, (0, self.shift), self.folder / name, name, remove=["cloud*.dump", "film.*.dump"])

    def more(self):
        """jobs that the search asks for next; what is done already is taken as it is"""
        wanted = []
        while new := self.search.next():
            for place in new:
                self.jobs[place] = job = self.job(place)
                if job.result() is None:
                    wanted.append(job)
                else:
                    self.take(job)
            if wanted:
                break
        return wanted

    def take(self, job):
        place = next(place for place, one in self.jobs.items() if one is job)
        self.search.said[place] = decision.verdict(job)[0]

    @property
    def borders(self):
        """value up to which it holds, and from which it fails; None where the search has not come so far"""
        holds, _, _, fails = self.search.borders()
        return tuple(None if place is None else self.values[place] for place in (holds, fails))

    @property
    def limit(self):
        """geometric middle of the last value that holds and the first that fails; None: not in the range, or not done"""
        holds, fails = self.borders
        return None if None in (holds, fails) or not self.search.done else math.sqrt(holds * fails)

    def margins(self, value):
        """what the run at a value says of how near it was"""
        found = next((job.result() for place, job in self.jobs.items() if self.values[place] == value), None)
        margins = (found or {}).get("margins") or {}
        if not margins:
            return ""
        if found["verdict"] == "holds":
            return f"bulge {margins['bulge_over_thickness']:.2g} t, layer {margins['deepest_failed_layer']:g} of {margins['layers']:g} failed"
        return f"hole {margins['hole_mm']:.3g} mm, {margins['apart_mass_mg']:.3g} mg apart"

    def row(self):
        one, (holds, fails) = self.bracket, self.borders
        results = [job.result() or {} for job in self.jobs.values()]
        return {"bracket": one.name, "km_s": one.shot.speed_km_s, "on": one.on, "low": one.low, "high": one.high, "across": self.across, "shift": self.shift,
                "holds": holds, "fails": fails, "limit": self.limit and round(self.limit, 4), "error": self.limit and round(one.error(self.limit), 4),
                "undecided": sum(said == "undecided" for said in self.search.said.values()), "at_holds": self.margins(holds), "at_fails": self.margins(fails),
                "runs": len(self.search.said), "core_s": round(sum(result.get("core_s", 0) for result in results), 1)}


def equations(study, bracket):
    """{equation: (limit, error, what of it is beyond its range)} of those that have one limit in the range"""
    values = study.values(bracket)
    found = ble.limits(lambda value: study.case(bracket, study.across[0], value), values[0], values[-1])
    return {name: (one["limits"][0], bracket.error(one["limits"][0]), one["outside"]) for name, one in found.items() if len(one["limits"]) == 1}


def summary(rows, of_equations):
    """[(name, brackets, mean |error|, mean error, least error)] of the simulation (mean over shifts, and the safer shift) and of equations; of_equations: {bracket: equations()}"""
    def line(name, errors):
        n = len(errors)
        return (name, n, *((sum(map(abs, errors)) / n, sum(errors) / n, min(errors)) if n else (math.nan,) * 3))

    across = sorted({row["across"] for row in rows})
    found = []
    for number in across:
        errors = {}
        for row in rows:
            if row["across"] == number and row["error"] is not None:
                errors.setdefault(row["bracket"], []).append(row["error"])
        found.append(line(f"simulation, {number:g} across", [sum(each) / len(each) for each in errors.values()]))
        shifts = max(map(len, errors.values()), default=0)
        if shifts > 1:  # hvi shield says holds where all shifts do
            found.append(line(f"{number:g} across, safer shift", [max(each) for each in errors.values() if len(each) == shifts]))
    names = dict.fromkeys(name for one in of_equations.values() for name in one)
    return found + [line(name, [one[name][1] for one in of_equations.values() if name in one]) for name in names]
