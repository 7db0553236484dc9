# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Does the wall hold? A table of rules on measured numbers; the same for a run and, below, for many.

The wall that decides is the last one that was reached. It fails if it is perforated, or if anything behind it is apart.
"""

import dataclasses
import math
import types
from typing import Callable, Optional

from ..material import laws
from . import case as cases
from .script import BULGE, CONTINUE, FEW, STILL

NEEDED = cases.LAYERS  # layers of particles in the wall that decides
SPARED = 1e-4  # of the energy of the shot: less does no harm to a wall that was not reached
SHARE = 0.03  # of what a wall has been given: less that is still to come does not turn it
LEAK = 1e-3  # of the energy balance
BESIDE = 1e-3  # of the projectile
FINER = 1.05  # particles that much finer than those of a wall slip through between them
BEYOND = 0.5  # of the plastic strain of a wall's rear, in the coarse particles of its outer part: then these may decide, too
COARSER = 1.2  # a wall of particles that much coarser than those of what strikes it holds what a finer one does not
HEAT = 1e-3  # of the energy of the shot
FILLED = 0.1  # of the particles that have the volume of the projectile

ALWAYS, UNLESS, FAILS, HOLDS, NOTE = "undecided", "undecided unless it fails", "fails", "holds", "note"


@dataclasses.dataclass(frozen=True)
class Rule:
    """What a number says of the verdict.

    effect: ALWAYS undecided, whatever else; UNLESS the wall fails all the same: then a note; FAILS; HOLDS (why it does); NOTE
    when: condition on Measured; why: reason of the condition and its threshold; says: sentence of it; remedy: {key of the case: value}, what to do as words
    """

    name: str
    effect: str
    when: Callable
    why: str
    says: Callable
    remedy: Optional[Callable] = None
    each: bool = False  # when gives the walls that it applies to, one sentence for each


@dataclasses.dataclass(frozen=True)
class Finding:
    """A rule that applies to a run: its name, sentence, remedy as words and as keys of the case"""

    name: str
    effect: str
    text: str
    advice: str
    remedy: dict


class Measured(types.SimpleNamespace):
    """Numbers of a run that rules ask for: r, result.yaml's; d, number of the wall that decides"""

    def of(self, key, k=None):
        return self.r[f"wall{k or self.d}_{key}"]


def measured(shield, result):
    """Measured of a run; shield: its script.Shield, result: what record.measure() found"""
    case, d, n = shield.case, result["walls_reached"], result["walls"]
    m = Measured(r=result, d=d, n=n, case=case, shield=shield, last=d == n)
    m.hole = result[f"hole{d}_diameter_mm"]
    m.unknown = m.last and math.isnan(m.hole)
    m.hole = 0.0 if math.isnan(m.hole) else m.hole
    m.apart, m.spall = m.of("apart_mass_mg"), m.of("spall_mass_mg")
    m.spared = SHARE * m.of("energy_ratio") + SPARED if m.last else SPARED  # as script.OVER ends a run
    m.late = not m.last and m.of("cloud_energy_ratio") > m.spared
    m.parts = shield.images * m.of("apart_particles")
    m.plugged = m.last and m.hole > 0 and m.parts == 0 and result["momentum_left_ratio"] < 1e-3
    m.few = m.last and m.hole == 0 and 0 < m.parts < FEW
    m.off = abs(result["energy_ratio"] - 1)
    m.missed, m.beside = max((m.of("missed_fraction", k), k) for k in range(1, n + 1) if f"wall{k}_missed_fraction" in result)
    walls = shield.geometry.walls
    finest = min([shield.geometry.a, *(wall.spacing for wall in walls[:d - 1])])
    m.sieve = walls[d - 1].spacing / finest
    m.coarser = max(walls[d - 1].spacing, walls[d - 1].dz) / finest  # layers of settings may be thicker than they are apart in their plane
    m.slips = m.last and m.hole == 0 and m.spall == 0 and m.apart > 0 and m.sieve > FINER
    m.failed = m.last and not m.plugged and (m.hole > 0 or (m.parts >= FEW and m.missed <= BESIDE and not m.slips))
    solid = shield.settings["solid"]
    m.solid = solid
    m.whole = case.whole(d)
    m.ball_whole = [lack for lack in laws.lacking(case.material, solid).items() if lack[0] == "spall"]  # what breaks a projectile is tension
    m.thickness = case.walls[d - 1].thickness_mm
    m.tstop = 1.5 * max(shield.geometry.tstop_us, result["time_us"])
    m.coarse = [k for k in range(1, d) if m.of("layers", k) < NEEDED]
    m.ended = f" at {result['time_us']:.1f} us, the end at the latest" if result["ended_by"] == "time" else ""
    m.torn = [k for k in range(1, d + 1) if m.of("torn", k)]
    return m


def finer_wall(m):
    """remedy where a wall is coarser than what strikes it: as keys of the case, and as words"""
    if m.coarser > 1.001 * m.sieve:
        return {"settings": {"layers": None}}, "take more layers, or let spacings_mm say how many"
    cheap = "; with core_mm they cost little" if m.case.walls[m.d - 1].method == "sph" else ""
    return {f"wall {m.d}: spacings_mm": None}, f"take spacings for it as fine as those of the projectile{cheap}"


RULES = (
    Rule("not modelled", ALWAYS, lambda m: bool(m.case.not_modelled), "stuffing, MLI and honeycomb have no model",
         lambda m: f"the shield has {', '.join(m.case.not_modelled)}, which is not modelled (as stuffing, MLI and honeycomb are not)",
         lambda m: ({}, "test it, or take it out and judge what is left")),
    Rule("late", ALWAYS, lambda m: m.late, f"the next wall is not struck yet, and {SPARED:g} of the energy of the shot harms no wall",
         lambda m: f"the cloud of wall {m.d} has not arrived at the next wall after {m.r['time_us']:.1f} us",
         lambda m: ({"settings": {"tstop": round(m.tstop, 1)}}, f"take settings: {{tstop: {m.tstop:.1f}}}")),
    Rule("thin", ALWAYS, lambda m: not m.late and m.of("layers") < NEEDED, f"{NEEDED} layers are the least that bend, stretch and spall",
         lambda m: f"wall {m.d}, which decides, has {m.of('layers')} layer(s) of particles, and {NEEDED} are needed",
         lambda m: ({"spacings_mm": finest(m, m.d)}, f"take spacings_mm of {finest(m, m.d):.4g} or finer, or spacings and layers for this wall")),
    Rule("leaky", ALWAYS, lambda m: m.off > LEAK, "forces that lose energy are not those of the model",
         lambda m: f"the energy of the ledger is off by {100 * m.off:.2g} percent", lambda m: ({"settings": {"C": 0.3}}, "take settings: C smaller")),
    Rule("tied", ALWAYS, lambda m: m.r["method"] == "tied", "its elements cannot fail",
         lambda m: "method tied lets no element become particles", lambda m: ({"method": "hybrid"}, "take method hybrid")),
    Rule("stopped", UNLESS, lambda m: m.r["ended_by"] == "until", "nobody knows what comes later",
         lambda m: f"the run was stopped at {m.r['time_us']:.1f} us, before its event was over", lambda m: ({}, f"go on with {CONTINUE}, or run it again")),
    Rule("blunt", ALWAYS, lambda m: m.r["elements_failed_without_particles"] > 0, "they bear what they cannot bear",
         lambda m: f"{m.r['elements_failed_without_particles']} elements that hold no particles have failed and stay",
         lambda m: ({"hold_mm": None}, "take a larger hold_mm")),
    Rule("torn", ALWAYS, lambda m: bool(m.torn), "debris meets nothing beyond",
         lambda m: f"wall {m.torn[-1]} has become particles up to elements that hold none", lambda m: ({"hold_mm": None}, "take a larger hold_mm")),
    Rule("comes", UNLESS, lambda m: m.last and m.of("still_to_come") > m.spared, f"{SHARE:g} of what the wall has been given, and {SPARED:g} of the shot",
         lambda m: f"{100 * m.of('still_to_come'):.2g} percent of the energy of the shot are still on their way to wall {m.d}{m.ended}",
         lambda m: ({"settings": {"tstop": round(m.tstop, 1)}}, f"take settings: {{tstop: {m.tstop:.1f}}}")),
    Rule("pushed", UNLESS, lambda m: not m.late and m.of("push_percent") > 100 * STILL, f"less than {100 * STILL:g} percent of its momentum in a tenth of the time that is enough is the end of the load",
         lambda m: f"wall {m.d} is still pushed, its momentum changes by {m.of('push_percent'):.2g} percent in {0.1 * m.shield.geometry.enough_us:.2g} us{m.ended}",
         lambda m: ({"settings": {"tstop": round(m.tstop, 1)}}, f"take settings: {{tstop: {m.tstop:.1f}}}")),
    Rule("bulges", UNLESS, lambda m: m.last and abs(m.of("bulge_m_s")) > BULGE, f"less than {BULGE:g} m/s is no more than the ringing of an elastic plate, and tears nothing",
         lambda m: f"the bulge of wall {m.d} still moves, at {m.of('bulge_m_s'):.3g} m/s{m.ended}",
         lambda m: ({"settings": {"tstop": round(m.tstop, 1)}}, f"take settings: {{tstop: {m.tstop:.1f}}}")),
    Rule("missed", UNLESS, lambda m: m.missed > BESIDE, f"{BESIDE:g} of the projectile is more than a stray particle",
         lambda m: f"debris of {100 * m.missed:.2g} percent of the projectile's mass passed beside wall {m.beside}",
         lambda m: ({f"wall {m.beside}: radius_mm": wider(m)}, f"take radius_mm of {wider(m)} for it")),
    Rule("plugged", UNLESS, lambda m: m.plugged, "nothing came through: thin, not open",
         lambda m: f"wall {m.d} has less than half of its mass over a width of {m.hole:.4g} mm, but nothing came through",
         lambda m: ({"spacings_mm": None}, "take smaller spacings_mm")),
    Rule("slips", UNLESS, lambda m: m.slips, f"particles {FINER:g} times finer pass between those of the wall",
         lambda m: f"what came through wall {m.d} may have slipped between its particles, {m.sieve:.2g} times as far apart as those of the cloud",
         lambda m: ({"spacings_mm": None}, "take spacings that are alike")),
    Rule("coarser", UNLESS, lambda m: m.last and m.coarser > COARSER, "a single wall struck by a fragment holds from 6 to 15 percent too early with particles 1.4 times as coarse, from 10 to 20 percent and more with twice (examples/crater)",
         lambda m: f"the particles of wall {m.d} are {m.coarser:.2g} times as far apart as those of what strikes it: it holds what a finer one does not",
         finer_wall),
    Rule("few", UNLESS, lambda m: m.few, f"with fewer than {FEW} particles apart, other shifts of the lattice say anything",
         lambda m: f"no more than {m.parts} particles are apart behind wall {m.d}, and {FEW} are needed", lambda m: ({"spacings_mm": None}, "take smaller spacings_mm")),
    Rule("no plate", UNLESS, lambda m: m.unknown, "a hole is what a plate around it has",
         lambda m: f"whether wall {m.d} has a hole is unknown, for no plate in one piece is left around the place that is struck",
         lambda m: ({f"wall {m.d}: radius_mm": None}, "take a larger radius_mm for it, or smaller spacings_mm")),
    Rule("whole", UNLESS, lambda m: m.whole, "what cannot fail in tension holds whatever comes, and what cannot by plastic strain holds at two thirds of the thickness",
         lambda m, found: found[1], lambda m, found: found[2:], each=True),
    Rule("perforated", FAILS, lambda m: m.last and not m.plugged and m.hole > 0, "light goes through",
         lambda m: f"wall {m.d} is perforated by a hole of {m.hole:.4g} mm"),
    Rule("spall", FAILS, lambda m: m.last and m.spall > 0, "as ballistic-limit equations define failure",
         lambda m: f"wall {m.d} has detached spall of {m.spall:.4g} mg"),
    Rule("through", FAILS, lambda m: m.last and m.apart > m.spall, "as ballistic-limit equations define failure",
         lambda m: f"{m.apart - m.spall:.4g} mg of other material came through wall {m.d}"),
    Rule("spared", HOLDS, lambda m: not m.last and not m.late, f"{SPARED:g} of the energy of the shot harms no wall",
         lambda m: f"what has passed wall {m.d} has {m.of('cloud_energy_ratio'):.2g} of the energy of the shot, less than {SPARED:g}"),
    Rule("sound", HOLDS, lambda m: m.last and not m.plugged and not m.unknown and m.hole == 0 and m.apart == 0, "nothing came through",
         lambda m: f"wall {m.d} has no hole and no detached spall"),
    Rule("beyond", NOTE, lambda m: m.last and m.of("outer_plastic_strain") > BEYOND * m.of("rear_plastic_strain") > 0, "coarse particles hold what finer ones do not, so they should be away from what decides",
         lambda m: f"beyond its core the rear of wall {m.d} has a plastic strain of {m.of('outer_plastic_strain'):.2g}, {m.of('rear_plastic_strain'):.2g} is the most there is: its outer part is coarse for that",
         lambda m: ({f"wall {m.d}: core_mm": None}, "take a larger core_mm for it")),
    Rule("heat", NOTE, lambda m: m.r["conversion_heat_ratio"] > HEAT, "energy that is not of the impact",
         lambda m: f"{100 * m.r['conversion_heat_ratio']:.2g} percent of the energy have become heat when elements became particles, and 0.1 are no matter",
         lambda m: ({"core_mm": None}, "take a wider core_mm")),
    Rule("hourglass", NOTE, lambda m: m.r["hourglass_energy_ratio"] > HEAT, "energy that is not of the impact",
         lambda m: f"{100 * m.r['hourglass_energy_ratio']:.2g} percent of the energy are in hourglass forces of elements, and 0.1 are no matter",
         lambda m: ({"spacings_mm": None}, "take smaller spacings_mm")),
    Rule("filled", NOTE, lambda m: abs(m.r["projectile_particles"] / m.r["projectile_particles_planned"] - 1) > FILLED, "they share its mass, so each has another than its cell has room for",
         lambda m: f"the projectile has {m.r['projectile_particles']} particles where {m.r['projectile_particles_planned']} fit: "
                   f"each has {m.r['projectile_particles_planned'] / m.r['projectile_particles']:.2g} times the mass of its cell",
         lambda m: ({"spacings_mm": None}, "take smaller spacings_mm")),
    Rule("ball", NOTE, lambda m: m.ball_whole, "what cannot fail stays in one piece", lambda m, lack: cases.lacks(f"the projectile is of {m.case.material}", *lack), each=True),
    Rule("coarse", NOTE, lambda m: m.coarse, "the cloud is that of this wall, too",
         lambda m, k: f"wall {k}, which does not decide, has {m.of('layers', k)} layer(s) of particles, and {NEEDED} are better for its cloud",
         lambda m, k: ({"spacings_mm": finest(m, k)}, f"take spacings_mm of {finest(m, k):.4g} or finer, or spacings and layers for this wall"), each=True),
)


def finest(m, k):
    return float(f"{m.case.walls[k - 1].thickness_mm / NEEDED:.4g}")


def wider(m):
    return math.ceil(1.1 * max(m.of("missed_reach_mm", m.beside), 1e3 * m.shield.geometry.walls[m.beside - 1].radius))


def findings(m):
    """[Finding, ...] of the rules that apply"""
    found = []
    for rule in RULES:
        said = rule.when(m)
        for words in ([(m, k) for k in said] if rule.each else [(m,)] if said else []):
            keys, advice = rule.remedy(*words) if rule.remedy else ({}, "")
            found.append(Finding(rule.name, rule.effect, rule.says(*words), advice, keys))
    return found


def of_run(shield, result):
    """The first keys of result.yaml: verdict, reasons, notes, remedies, decided_by, margins"""
    m = measured(shield, result)
    found = findings(m)

    def texts(*effects, advice=True):
        return [f"{f.text} -- {f.advice}" if advice and f.advice else f.text for f in found if f.effect in effects]

    if texts(ALWAYS):
        verdict = "undecided"
    elif m.failed:
        verdict = "fails"
    else:
        verdict = "undecided" if texts(UNLESS) else "holds"
    reasons = {"holds": texts(HOLDS), "fails": texts(FAILS), "undecided": texts(ALWAYS, UNLESS) + texts(FAILS, HOLDS)}[verdict]
    fails = verdict == "fails"  # whatever is done of what is doubtful: no remedies
    notes = (texts(UNLESS, advice=False) if fails else []) + texts(NOTE)
    remedies = [] if fails else list({str(f.remedy): f.remedy for f in found if f.remedy and f.effect != NOTE}.values())
    return {"verdict": verdict, "reasons": reasons, **({"notes": notes} if notes else {}), **({"remedies": remedies} if remedies else {}),
            "rules": [f.name for f in found], "decided_by": "none" if m.late else f"wall{m.d}",
            "margins": {"hole_mm": math.nan if m.unknown else m.hole, "apart_mass_mg": m.apart, "apart_particles": m.parts, "bulge_over_thickness": m.of("bulge_over_thickness"),
                        "deepest_failed_layer": m.of("deepest_failed_layer"), "layers": m.of("layers"), "rear_plastic_strain": m.of("rear_plastic_strain"),
                        "push_percent": m.of("push_percent"), "bulge_m_s": m.of("bulge_m_s"), "still_to_come": m.of("still_to_come"), "missed_fraction": m.missed}}
