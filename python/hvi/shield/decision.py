# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Does the wall hold?  One case at several spacings and shifts of the lattice, one verdict."""

import dataclasses
import itertools
import math
import re
import statistics

from ..errors import HVIError
from ..jobs import engine
from ..version import version
from . import chain, elements, geometry
from . import case as cases

STATUS = {"holds": 0, "fails": 3, "undecided": 4}  # exit status of each verdict
CHANGES = 1.5  # of the mass of the largest piece between two spacings, beyond its range over the shifts (examples/whipple-shield/limits/tables.md),
NUMBER = re.compile(r"(?<![\w.-])(?<!wall )-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")  # in a text, that is not part of a name
LUMP = 2  # if it is wider than so many spacings: smaller ones are as coarse as the particles


def members(case):
    """(number of the spacing, shift) of each run of a case, coarse first"""
    return [(which, shift) for which in range(len(case.spacings_mm)) for shift in case.shifts]


def member_name(case, member):
    return engine.job_name({"dx": case.spacings_mm[member[0]], "shift": member[1]})


def job(case, member, folder, name=None, remove=()):
    """remove: patterns of files that nobody needs when the run is done; frames among them are not written at all unless the case asks for them"""
    if any(pattern.startswith("film") for pattern in remove) and not case.setting("film"):
        case = dataclasses.replace(case, settings={**case.settings, "film": -1})
    weight = (case.spacings_mm[0] / case.spacings_mm[member[0]]) ** 4  # particles and steps
    return chain.Job(case, *member, name or member_name(case, member), folder, weight=weight, remove=remove)


def verdict(job):
    """(verdict, reasons, notes) of a run that is done; notes: what is doubtful in a run that fails nevertheless"""
    result = job.result()
    if result is None:
        raise HVIError(f"{job.folder}: its result is gone or of another case: does another call use the same folder? Call again, or take another --runs DIR")
    said = result.get("verdict")
    if said not in STATUS:
        raise HVIError(f"{job.folder / 'result.yaml'}: no verdict, holds, fails or undecided, but {said}")
    return said, *(list(result.get(key) or []) for key in ("reasons", "notes"))


def decide(case, said):
    """(verdict, reasons, notes) of all runs, {member: the same of each}: undecided where they differ."""
    def where(which):
        return f"{case.spacings_mm[which]:g} mm"

    reasons = []
    if len(case.spacings_mm) < 2:
        reasons.append("one spacing only: nothing says how much it matters; give spacings_mm a second, finer one")
    per = {which: {said[which, shift][0] for shift in case.shifts} for which in range(len(case.spacings_mm))}
    for which, found in per.items():
        if len(found) > 1:
            reasons.append(f"the verdict differs over the shift of the lattice at {where(which)}: " + ", ".join(
                f"{said[which, shift][0]} with {shift:g}" for shift in case.shifts))
    if len({frozenset(found) for found in per.values()}) > 1:
        reasons.append("the verdict differs over the spacing: " + ", ".join(f"{' or '.join(sorted(found))} at {where(which)}" for which, found in per.items()))
    if {"holds", "fails"} <= set.union(*per.values()):
        reasons.append("so near the limit finer spacings_mm may decide; hvi limit says how near it is")
    if reasons or per[0] == {"undecided"}:
        return "undecided", reasons + said_by(case, [(member, why) for member, (verdict, why, _) in said.items() if verdict == "undecided"]), []
    (verdict,) = per[0]
    finest = [(len(case.spacings_mm) - 1, shift) for shift in case.shifts]
    causes, notes = (said_by(case, [(member, said[member][k]) for member in finest], NUMBER.split) for k in (1, 2))
    return verdict, [f"{'both' if len(said) == 2 else f'all {len(said)}'} runs say so: spacings of {', '.join(f'{dx:g}' for dx in case.spacings_mm)} mm, "
                     f"{len(case.shifts)} shift{'s' if len(case.shifts) > 1 else ''} of the lattice", *causes], notes + note_of_layers(case)


def said_by(case, each, wording=lambda text: [text]):
    """[text (names of the runs that say so), ...] of [(member, texts), ...]; texts of one wording as one, with the least and the largest of each of its numbers"""
    found = {}
    for member, texts in each:
        for text in texts:
            found.setdefault(tuple(wording(text)), []).append((text, member_name(case, member)))
    lines = []
    for same in found.values():
        numbers = [sorted(set(of), key=float) for of in zip(*(NUMBER.findall(text) for text, _ in same))]
        ranges = iter([of[0] if len(of) == 1 else f"{of[0]} to {of[-1]}" for of in numbers])
        lines.append(f"{NUMBER.sub(lambda _: next(ranges), same[0][0])} ({', '.join(name for _, name in same)})")
    return lines


def note_of_layers(case):
    """[note] where walls do not become finer with the spacing; else []"""
    same = "layers" in case.settings and len(case.spacings_mm) > 1
    return ["settings: layers are the same with all spacings: how much they matter is not known"] if same else []


def note_of_versions(jobs):
    """[note] where runs that are done were made by another version of the package than this one; else []"""
    made = sorted({said for one in jobs if (said := str(one.result()[engine.LAST])) != version()})
    return [f"runs that were done before are of USER-HVI {', '.join(made)}, this is {version()}: remove their folders to make them anew"] if made else []


def note_of_pieces(case, jobs):
    """[note] where the largest piece that strikes the last wall differs between the two finest spacings; else []"""
    last, finest = len(case.walls), len(case.spacings_mm) - 1
    if last < 2 or finest < 1:
        return []
    found = []
    for which in (finest - 1, finest):
        results = [jobs[which, shift].result() for shift in case.shifts]
        if not all(one.get(f"wall{last}_reached") and one.get(f"wall{last - 1}_largest_fragment_mm", 0.0) > LUMP * case.spacings_mm[which] for one in results):
            return []
        found.append([one[f"wall{last - 1}_largest_fragment_mass_fraction"] for one in results])
    coarse, fine = found
    if max(fine) >= min(coarse) and max(coarse) >= min(fine):
        return []
    coarse, fine = map(statistics.geometric_mean, found)
    if max(coarse / fine, fine / coarse) < CHANGES:
        return []
    return [f"the largest piece that strikes wall {last} has not converged: {coarse:.2g} of the projectile's mass at {case.spacings_mm[-2]:g} mm, {fine:.2g} at {case.spacings_mm[-1]:g} mm"]


def finer(case, said, jobs):
    """What would say more, as keys of the case: the finest spacing that can be decided and one with a layer more in the last wall, and what that costs.

    said: {member: (verdict, reasons, notes)}; None if no spacing can decide
    """
    if case.not_modelled or "layers" in case.settings or "whole" in (jobs[0, case.shifts[0]].result().get("rules") or ()):
        return None
    last, which = case.walls[-1], len(case.spacings_mm) - 1
    fine = (last.spacings_mm or case.spacings_mm)[-1]
    pair = 2 if geometry.is_graded(last) else 1  # layers come so
    layers = pair * geometry.layers(last.thickness_mm, pair * fine)
    first = 1.0 if layers >= cases.LAYERS else last.thickness_mm / cases.LAYERS / fine
    more = max(layers, cases.LAYERS) + pair
    enough = math.ceil(cases.RATIO * last.thickness_mm / (first * fine) - 1e-9)
    steps = (last.thickness_mm / n / fine for n in itertools.count(more + max(0, -(-(enough - more) // pair)) * pair, pair))
    second = next((ratio for ratio in itertools.islice(steps, 100) if fits(case, ratio)), None)
    if second is None:
        return None
    stay = first == 1.0 and all(said[which, shift][0] != "undecided" for shift in case.shifts)  # those of the finest need not be run again

    def spacings(own):
        return [float(f"{own[-1] * ratio:.4g}") for ratio in (first, second)]

    spent = sum(jobs[which, shift].result().get("core_s", 0) for shift in case.shifts)
    return {"spacings_mm": spacings(case.spacings_mm), **{f"wall {k}: spacings_mm": spacings(wall.spacings_mm) for k, wall in enumerate(case.walls, 1) if wall.spacings_mm},
            "runs": len(case.shifts) * (1 if stay else 2), "core_s": float(f"{spent * (second**-4 + (0 if stay else first**-4)):.2g}")}


def fits(case, ratio):
    """True if walls with elements can have them with the finest spacings of a case times ratio"""
    return all(elements.per_edge(geometry.layers(wall.thickness_mm, ratio * (wall.spacings_mm or case.spacings_mm)[-1]))
               for wall in case.walls if wall.method != "sph")


def said_of_finer(case, found):
    """a line for the eye"""
    keys = ", ".join(f"{key}: {value}" for key, value in found.items() if key.endswith("spacings_mm"))
    more = "more runs, those of the finest spacing stay" if found["runs"] == len(case.shifts) else "runs, with the remedies above"
    return f"next finer: {keys}: {found['runs']} {more}; about {found['core_s']:g} core-seconds"


def shown(case):
    """columns of the table of runs"""
    n = len(case.walls)
    return ["verdict", *(f"hole{k}_diameter_mm" for k in range(1, n + 1)), f"wall{n}_spall_mass_mg", "areal_density_kg_m2", "particles", "time_us", "core_s"]


def lines(reasons, notes):
    """for the eye"""
    return [*(f"  - {text}" for text in reasons), *(["notes:"] if notes else []), *(f"  - {text}" for text in notes)]
