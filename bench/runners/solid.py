# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Solids: waves in bulk and walls, bending, Verney's shell and cylinder, Taylor's cylinder, by particles, elements, and MACHDYN's tlsph.

Scenes are those of tests/lib/verney_taylor_scenes.py, tests/lib/face_scenes.py and tests/lib/fem_mechanics_scenes.py. Errors in percent.
Of a method: kind (particles, elements, tlsph), and words (of pair_style hvi/sph), or fem (of fix hvi/fem).
Settings: layers (through a thickness) or n (per radius, per width of a pulse), kernel, h (in spacings), variable, C, skin (in units of h/1.2).
"""

import numpy as np

from . import answer, machdyn, merged

import face_scenes
import fem_mechanics_scenes as fem
import verney_taylor_scenes as vt
from lammps_runs import Stopped, executor

LENGTH, FOOT = (21.4, 21.7), (6.97, 7.24)  # mm, of Taylor's cylinder by other codes
RADIUS = 3.2e-3
HOW = {"words": "words", "kernel": "kernel", "h": "h", "C": "courant", "skin": "skin", "variable": "variable"}
SETTINGS = {"kind", "n", "layers", "fem", "element_C", *HOW, *machdyn.SETTINGS}


def of_particles(s):
    return {word: s[name] for name, word in HOW.items() if name in s}


def of_elements(s):
    return {"fem": s.get("fem", ""), **({"courant": s["element_C"]} if "element_C" in s else {})}


def off(ratio):
    """percent"""
    return 100 * abs(ratio - 1)


def shell(lmp, folder, s):
    if s["kind"] == "elements":
        o = fem.verney(lmp, folder, s["layers"], t_end=115.0, **of_elements(s))
    else:
        o = vt.verney(lmp, folder, 2.0 / s["layers"], t_end=115.0, octant=True, **of_particles(s))
    errors = {"inner radius": off(o["inner"] / 4), "strength": off(vt.strength(o["inner"]))}
    return o, errors, {"inner_cm": o["inner"], "stops_at_us": o["stops_at"], "strength_over_exact": vt.strength(o["inner"])}


def cylinder(lmp, folder, s):
    o = face_scenes.verney_cylinder(lmp, folder, 2.0 / s["layers"], **of_particles(s))
    return o, {"inner radius": off(o["inner"] / 4), "strength": off(o["strength"])}, {"inner_cm": o["inner"], "stops_at_us": o["stops_at"]}


def taylor(lmp, folder, s):
    dx = RADIUS / s["n"]
    if s["kind"] == "elements":
        o = fem.taylor(lmp, folder, dx, fem.COPPER, t_end=70e-6, **of_elements(s))
    elif s["kind"] == "tlsph":
        o = machdyn.taylor(lmp, folder, dx, fem.COPPER, 70e-6, s)
    else:
        o = vt.taylor(lmp, folder, dx, laws=fem.COPPER, quarter=True, t_end=70e-6, **of_particles(s))
    return o, of_shape(o["length"], o["foot"]), {"length_mm": o["length"], "foot_mm": o["foot"]}


def of_shape(length, foot):
    """against the middles of the ranges of other codes"""
    errors = {"length": off(length / np.mean(LENGTH)), "foot": off(foot / np.mean(FOOT))}
    return {"shape": np.sqrt(0.5 * (errors["length"] ** 2 + errors["foot"] ** 2)), **errors}


def wall(lmp, folder, s):
    n = s["layers"]
    if s["kind"] == "elements":
        o = fem.standing(lmp, folder, "plate", nt=n, length=40, periods=1.0, fem=s.get("fem", ""), factor=s.get("element_C", 0.5))
        k = 2 * np.pi / 40
        return o, {"speed": off(o["frequency"] * face_scenes.CP * k / face_scenes.lamb(k, 1.0, False))}, {"amplitude": o["amplitude"]}
    how = of_particles(s)
    r, t, _, _, o = face_scenes.standing(lmp, folder, n, how.pop("words"), how.pop("kernel"), how.pop("h"), 40 * n, False, **how)
    o = {**o, "particles": len(t.x), **face_scenes.books(r)}
    return o, {"speed": off(o["speed"]), "borne": off(o["borne"]), "loss": 100 * o["loss"]}, {"noise": o["noise"]}


def bending(lmp, folder, s):
    if s["kind"] == "elements":
        o = fem.standing(lmp, folder, "bending", nt=s["layers"], length=20, periods=1.0, fem=s.get("fem", ""), factor=s.get("element_C", 0.5))
        return o, {"frequency": off(o["frequency"])}, {"amplitude": o["amplitude"]}
    o = face_scenes.bending(lmp, folder, s["layers"], **of_particles(s))
    return o, {"frequency": off(o["frequency"]), "loss": 100 * o["loss"]}, {"misfit": o["misfit"]}


def pulse(lmp, folder, s):
    n = s["n"]
    if s["kind"] == "elements":
        o = fem.pulse(lmp, folder, 20 * n, n, fem=s.get("fem", ""), factor=s.get("element_C", 0.5))
    elif s["kind"] == "tlsph":
        o = machdyn.pulse(lmp, folder, 20 * n, n, s)
    else:
        o = face_scenes.wave(lmp, folder, 0, length=20 * n, wide=float(n), **of_particles(s))
    return o, {"L1 v": 100 * o["l1"], "height": off(2 * o["height"])}, {}


SCENES = {"verney": shell, "verney-cylinder": cylinder, "taylor": taylor, "wall": wall, "bending": bending, "pulse": pulse}


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    s = {"kind": "particles", **merged(case, settings, SETTINGS)}
    call = executor(lmp, folder)
    try:
        o, errors, numbers = SCENES[case["scene"]](lambda text, **_: call(text, nranks=ranks, timeout=timeout), folder, s)
    except Stopped as why:
        return answer(folder, 0, {}, failed=str(why))
    return answer(folder, o.get("particles", o.get("elements", 0)), errors, numbers, o["drift"])
