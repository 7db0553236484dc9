# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Published shots on double walls, one rule of spacings for all of them, beside equations.

A study says which list and which rule; each shot becomes a case of hvi shield, so runs, verdicts and what is done are its.
"""

import dataclasses
import difflib
import math
import pathlib
import re

from .. import texts
from ..errors import HVIError
from ..material import laws
from ..places import DATA
from . import ble, decision
from . import case as cases
from .projectile import FILLS, Projectile
from .reader import REQUIRED, Reader

SETTINGS = DATA / "examples" / "whipple-shield" / "shots" / "all.yaml"  # of a list that comes without a study
CM = 10.0  # mm
SMALLEST, LARGEST = 1e-6, 1e5  # of the numbers of a list
FINEST = 1e-4  # mm, to which spacings are rounded
SAID = ("fails", "undecided", "holds")
OBSERVED = {"P": "fails", "NP": "holds"}
WORDS = ("shotID", "proj_mat", "bumper_mat", "wall_mat", "result")
LENGTHS = ("proj_diam", "bumper_thick", "standoff", "wall_thick")
COLUMNS = (*WORDS, *LENGTHS, "angle", "velocity", "wall_yield")


@dataclasses.dataclass(frozen=True)
class Shot:
    name: str
    source: str
    projectile: str  # alloys as the list has them
    diameter_mm: float
    angle_deg: float
    speed_km_s: float
    bumper: str
    bumper_mm: float
    gap_mm: float
    wall: str
    yield_ksi: float
    wall_mm: float
    observed: str  # P or NP

    @property
    def folder(self):
        return re.sub(r"[^\w.+-]", "-", self.name)

    def alloys(self):
        return self.projectile, self.bumper, self.wall


def read_list(path):
    """The shots of a CSV file: lengths in cm, degrees, km/s, ksi, P or NP; lines that begin with # are remarks."""
    names, rows = texts.table(path)
    head = [name.strip() for name in names]
    if missing := [name for name in COLUMNS if name not in head]:
        raise HVIError(f"{path}: no column {', '.join(missing)}")
    found = {}
    for number, row in rows:
        def wrong(text):
            raise HVIError(f"{path}, line {number}: {text}")

        if len(row) != len(head):
            wrong(f"{len(row)} values in {len(head)} columns")
        cells = {name: text.strip() for name, text in zip(head, row)}
        shot = _shot(cells, wrong)
        if shot.folder in found:
            wrong(f"shot {shot.name} is there twice")
        found[shot.folder] = shot
    if not found:
        raise HVIError(f"{path}: no shots")
    return list(found.values())


def _shot(cells, wrong):
    """a row of the list, checked"""
    if empty := [name for name in WORDS if not cells[name]]:
        wrong(f"{empty[0]} is empty")
    value = {}
    for name in (*LENGTHS, "angle", "velocity", "wall_yield"):
        try:
            value[name] = float(cells[name])
        except ValueError:
            value[name] = math.nan
        if not (0 <= value[name] < math.inf and (value[name] > 0 or name == "angle")):
            wrong(f"{name} must be a number above 0{' or 0' if name == 'angle' else ''}, not {cells[name]!r}")
        if not (value[name] == 0 or SMALLEST <= value[name] < LARGEST):
            wrong(f"{name} must be {SMALLEST:g} to {LARGEST:g}, not {cells[name]}: lengths are in cm, speeds in km/s, stresses in ksi")
    if value["angle"] >= 90:
        wrong(f"angle must be below 90 degrees, not {cells['angle']}")
    if cells["result"] not in OBSERVED:
        wrong(f"result must be P or NP, not {cells['result']!r}")
    if not cells["shotID"].strip("."):
        wrong(f"shotID {cells['shotID']} can be no name of a folder")
    mm = {name: round(CM * value[name], 9) for name in LENGTHS}
    return Shot(cells["shotID"], cells.get("source", ""), cells["proj_mat"], mm["proj_diam"], value["angle"], value["velocity"],
                cells["bumper_mat"], mm["bumper_thick"], mm["standoff"], cells["wall_mat"], value["wall_yield"], mm["wall_thick"], cells["result"])


class Study:
    """A study file: the list, which of its shots, and the one rule for all of them."""

    def __init__(self, path):
        path = pathlib.Path(path)
        alone = path.suffix.lower() == ".csv"  # a list without a study has the settings of all.yaml
        reader = Reader(SETTINGS if alone else path)
        whole = reader.number(above=0, sane=(1e-3, 1e3))
        names = reader.several(reader.text, distinct=True)
        data = reader.mapping(reader.root, "", {
            "list": (reader.text, REQUIRED), "shots": (names, None),
            "spacing": (lambda node, key: reader.mapping(node, key, {
                **{name: (whole, REQUIRED) for name in ("across", "bumper_layers", "wall_layers", "ratio")}, "core": (whole, None)}), REQUIRED),
            "finer": (lambda node, key: reader.mapping(node, key, {
                "factor": (reader.number(above=0, below=1), REQUIRED), "shots": (names, REQUIRED)}), None),
            "shifts": (reader.several(reader.number(least=0, below=1), distinct=True), (0.0,)),
            "settings": (lambda node, key: cases.read_settings(reader, node, key), {}), "materials": (material_table(reader), REQUIRED), "stand_ins": (material_table(reader), {})})
        self.path, self.name, self.rule, self.shifts, self.settings = path, texts.name_of(path), data["spacing"], data["shifts"], data["settings"]
        self.materials, self.stand_ins = {**data["materials"], **data["stand_ins"]}, data["stand_ins"]
        if both := sorted(set(data["materials"]) & set(self.stand_ins)):
            reader.wrong("stand_ins", f"{both[0]} is among materials, too")
        shots = read_list(path if alone else path.parent / data["list"])
        wanted, finer = (None, None) if alone else (data["shots"], data["finer"])
        self.shots = named(shots, wanted, path) if wanted else shots
        self.factor = finer["factor"] if finer else None
        self.finer = {shot.name for shot in named(self.shots, finer["shots"], path)} if finer else set()
        for shot in self.shots:
            for alloy in shot.alloys():
                if alloy not in self.materials:
                    raise HVIError(f"{reader.path}: shot {shot.name}: no material for {alloy}; give it one in materials, or in stand_ins if it is of another alloy")

    def case(self, shot):
        factors = [1.0, self.factor] if shot.name in self.finer else [1.0]
        return case_of(shot, self.rule, self.materials, self.shifts, self.settings, f"{self.path}: shot {shot.name}", factors)


def material_table(reader):
    """reads {alloy: material file}"""
    def read(node, key):
        try:
            pairs = [(str(name.value), value) for name, value in node.value]
        except (TypeError, ValueError):
            reader.wrong(key, "must be 'alloy: material' lines", node)
        return {name: laws.find(reader, value, f"{key}: {name}") for name, value in pairs}
    return read


def spacings(rule, diameter, bumper, wall):
    """of projectile and wall 1, and of the rear wall"""
    near = min(diameter / rule["across"], bumper / rule["bumper_layers"], wall / rule["wall_layers"])
    return near, min(wall / rule["wall_layers"], rule["ratio"] * near)


def case_of(shot, rule, materials, shifts, settings, where, factors=(1.0,)):
    """A shot as a case of hvi shield: the projectile and wall 1 at one spacing, the rear wall no coarser than ratio times that, in a square alone if there is a core

    rule: across, bumper_layers, wall_layers, ratio, core (half side of the square over the gap, or None), fill (of the projectile); materials: {alloy: material}; where: what messages begin with; factors: of the spacings
    """
    near, far = spacings(rule, shot.diameter_mm, shot.bumper_mm, shot.wall_mm)
    first, last = (tuple(round(dx * factor, 4) for factor in factors) for dx in (near, far))
    if min(first + last) < FINEST:
        raise HVIError(f"{where}: the rule of spacings makes {min(near, far):.3g} mm, and {FINEST:g} mm are the least: are lengths in their units?")
    ball, bumper, wall = (materials[alloy] for alloy in shot.alloys())
    case = cases.Case(name=shot.folder, projectile=Projectile(ball, diameter_mm=shot.diameter_mm, fill=rule.get("fill", FILLS[0])), speed_km_s=shot.speed_km_s, angle_deg=shot.angle_deg,
                      walls=(cases.Wall(shot.bumper_mm, bumper, spacings_mm=first, method="sph"),
                             cases.Wall(shot.wall_mm, wall, gap_mm=shot.gap_mm, spacings_mm=last, method="sph", yield_ksi=shot.yield_ksi,
                                        core_mm=round(rule["core"] * shot.gap_mm, 3) if rule.get("core") else None)),
                      spacings_mm=first, shifts=shifts, settings=settings)

    def wrong(key, text):
        raise HVIError(f"{where}: {key}: {text}")
    case.check(wrong)
    return case


def named(shots, names, where):
    """those of the names, in their order"""
    known = {shot.name: shot for shot in shots}
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1, 0.5)
            raise HVIError(f"{where}: no shot {name}" + (f"; did you mean {near[0]}?" if near else ""))
    return [known[name] for name in names]


# ---------------------------------------------------------------------- what came of it
class Outcome:
    """The runs of a shot, by spacing and shift, and what they say."""

    def __init__(self, shot, case, folder):
        self.shot, self.case = shot, case
        self.jobs = {member: decision.job(case, member, folder / shot.folder / decision.member_name(case, member),
                                        f"{shot.folder}_{decision.member_name(case, member)}", remove=("cloud1.dump",))
                     for member in decision.members(case)}

    def done(self, which):
        """True if all runs of a spacing are"""
        return which < len(self.case.spacings_mm) and all(self.jobs[which, shift].result() for shift in self.case.shifts)

    def at(self, which):
        """(verdict, reasons) at one spacing; "" if not all of its runs are done"""
        if not self.done(which):
            return "", []
        said = {shift: decision.verdict(self.jobs[which, shift])[:2] for shift in self.case.shifts}
        if len({verdict for verdict, _ in said.values()}) > 1:
            return "undecided", ["the verdict differs over the shift of the lattice"]
        return said[self.case.shifts[-1]]

    def both(self):
        """the verdict of both spacings, as hvi shield draws it; "" if there are not two that are done"""
        if not (self.done(0) and self.done(1)):
            return ""
        return decision.decide(self.case, {member: decision.verdict(job) for member, job in self.jobs.items()})[0]

    def margin(self):
        """how near it was, at the coarse spacing"""
        found = self.jobs[0, self.case.shifts[-1]].result() or {}
        margins = found.get("margins") or {}
        if not margins:
            return ""
        if found["verdict"] != "holds" and (margins["hole_mm"] != 0 or margins["apart_mass_mg"] > 0):  # nan: unknown
            return f"hole {margins['hole_mm']:.3g} mm, {margins['apart_mass_mg']:.3g} mg apart"
        return f"bulge {margins['bulge_over_thickness']:.2g} t, layer {margins['deepest_failed_layer']:g} of {margins['layers']:g} failed"

    def core_hours(self):
        return sum((job.result() or {}).get("core_s", 0) for job in self.jobs.values()) / 3600


def ratios_of(outcome):
    """{equation: (diameter over the critical one, which ranges of validity are left)}"""
    shot, found = outcome.shot, {}
    of = ble.from_case(outcome.case)
    for name in ble.equations(of):
        d, left = ble.critical_diameter(name, of, shot.speed_km_s, shot.angle_deg)
        found[name] = (shot.diameter_mm / (CM * d), left)
    return found


def shown(ratio):
    """a cell of the table: * if that is an extrapolation"""
    return f"{ratio[0]:.2f}{'*' if ratio[1] else ''}"


def row(outcome, ratios):
    """a shot in the table; ratios: those of ratios_of"""
    shot, (said, reasons) = outcome.shot, outcome.at(0)
    return {"shot": shot.name, "projectile": shot.projectile, "D_mm": shot.diameter_mm, "km_s": shot.speed_km_s, "deg": shot.angle_deg,
            "bumper": shot.bumper, "tb_mm": shot.bumper_mm, "gap_mm": shot.gap_mm, "wall": shot.wall, "tw_mm": shot.wall_mm,
            "dx_mm": outcome.case.spacings_mm[0], "observed": shot.observed, "predicted": said, "finer": outcome.at(1)[0], "both": outcome.both(),
            "margin": outcome.margin(), **{name: shown(ratio) for name, ratio in ratios.items()},
            "core_h": round(outcome.core_hours(), 4), "reasons": "; ".join(reasons)}


def by_equation(ratio):
    """what an equation says of a diameter over its critical one"""
    return "fails" if ratio[0] >= 1 else "holds"


def confusion(pairs):
    """{(observed, said): how many}; pairs: observed, P or NP, and said, nothing where nothing was run"""
    found = {(seen, said): 0 for seen in OBSERVED for said in SAID}
    for seen, said in pairs:
        if said:
            found[seen, said] += 1
    return found


def counts(outcomes, ratios):
    """[(who, counts)]: simulation and equations on the same shots, and again on those that were run finer"""
    found = []
    for words, of in (("", [o for o in outcomes if o.done(0)]), (", where finer", [o for o in outcomes if o.done(0) and o.done(1)])):
        if not of:
            continue
        found.append((f"simulation{words}", confusion((o.shot.observed, o.at(0)[0]) for o in of)))
        if words:
            found.append(("the same, finer", confusion((o.shot.observed, o.at(1)[0]) for o in of)))
            found.append(("both spacings", confusion((o.shot.observed, o.both()) for o in of)))
        found += [(name + words, confusion((o.shot.observed, by_equation(ratios[o.shot.name][name])) for o in of)) for name in ratios[of[0].shot.name]]
    return found


def counts_table(found):
    names = ("", *(f"{seen}: {said}" for seen in OBSERVED for said in SAID), "right", "wrong")
    rows = []
    for who, table in found:
        right = sum(table[seen, said] for seen, said in OBSERVED.items())
        wrong = table["P", "holds"] + table["NP", "fails"]
        rows.append((who, *table.values(), right, wrong))
    return names, rows
