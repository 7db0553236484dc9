"""SPH as a sub-style of pair_style hybrid: particles beside it, and its commands as those of a sub-style."""

import numpy as np
from sph_scenes import Fluid, random_fluid, scene

STEPS = 10
BESIDE = {"lj/cut": "lj/cut 2.5", "hvi/contact": "hvi/contact", "zero": "zero 4.5"}
COEFF = {"lj/cut": "lj/cut 1.0 0.8", "hvi/contact": "hvi/contact 1.0 1.1"}


def others(s):
    """particles of type 3, all over the place and in the midst of those of s, which do not feel them"""
    t = random_fluid(4, spacing=1.1, jitter=0.1, seed=55, types=1)
    center = s.x.mean(0)
    x = t.x - t.x.mean(0) + center
    return Fluid(x, t.v, np.ones(len(x)), np.zeros(len(x)), np.full(len(x), 3), {**s.mass, 3: 1.0}, s.h, s.box, s.periodic)


def together(s, t):
    a = [np.concatenate([getattr(s, name), getattr(t, name)]) for name in ("x", "v", "rho", "esph", "type")]
    return Fluid(*a, t.mass, s.h, s.box, s.periodic)


def hybrid(pair, style, beside):
    """the same commands as sub-style of a hybrid"""
    out = ""
    for line in pair.splitlines():
        words = line.split()
        if words[0] == "pair_style":
            other = BESIDE[beside] if beside else ""
            first, second = (" ".join(words[1:]), other) if beside != "lj/cut" else (other, " ".join(words[1:]))
            out += f"pair_style {style} {first} {second}\n"
        else:
            out += " ".join([*words[:3], "hvi/sph", *words[3:]]) + "\n"
    if beside == "zero":
        return out + "pair_coeff 1*2 1*2 zero\n"
    return out + f"pair_coeff 3 3 {COEFF[beside]}\npair_coeff 1*2 3 none\n" if beside else out


def text(s, pair, fixes, out, tmp_path, name, group="all", more="", **kw):
    groups = "" if group == "all" else "group ours type 1 2\ngroup rest type 3\nfix nve rest nve\n"
    fix = groups + fixes.format(group) + f"fix sph {group} hvi/sph\n"
    return ("clear\n" + scene(s, tmp_path / f"{name}.data", pair, fix=fix, **kw) + "timestep 0.004\n" + more + f"run {STEPS}\n"
            + out.format(tmp_path / name))
