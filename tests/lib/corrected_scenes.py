"""Two materials mixed: their files and commands, bodies of them, and what corrected.py gets of a dump of their run."""

import numpy as np
from corrected import Solid
from solid_scenes import MATERIAL, as_tensor
from sph_scenes import random_fluid, scene

RHO0, G, H = {1: 1.0, 2: 1.7}, {1: 6.0, 2: 9.0}, {1: 1.3, 2: 1.15}
JC = "fix jc all hvi/johnson-cook {}\ntimestep 0.004\n"
UNBROKEN = "damage no spall none"
ANEW = "velocity all ramp vx 0.01 0.31 x 0.0 8.0 sum yes units box\n"  # of all: forces are then those of the state in the output
FAILING = ["dissipation riemann", "viscosity 1 2 h variable"]


def commands_of_pair(folder):
    """the commands of two materials, as a function of the words of pair_style"""
    for t in RHO0:
        text = MATERIAL.format(sigma_p=3.0).replace("rho0 1.0", f"rho0 {RHO0[t]}").replace("G 6.0", f"G {G[t]}")
        (folder / f"m{t}.hvi").write_text(text)

    def commands(words="", tension=True, kernel="cubic", elastic=False):
        if elastic:
            for t in RHO0:
                path = folder / f"m{t}.hvi"
                path.write_text(path.read_text().replace("A 0.25", "A 1e3"))
        text = f"pair_style hvi/sph {kernel} {words}\n" + "".join(f"pair_coeff {t} {t} file {folder}/m{t}.hvi h {H[t]}\n" for t in H)
        return text + f"pair_coeff 1 2 tension {'yes' if tension else 'no'}\n"

    return commands


def body(dim=3, seed=41, n=None, periodic=True, speed=0.35, jitter=0.1):
    """two materials mixed on a jittered lattice, in a field with shear, compression and stretch"""
    s = random_fluid(n or {1: 24, 2: 12, 3: 7}[dim], dim, seed=seed, jitter=jitter, speed=speed, periodic=periodic)
    s.mass, s.h = dict(RHO0), dict(H)
    s.rho, s.esph = np.array([RHO0[t] for t in s.type]), np.zeros(len(s.x))
    k = 2 * np.pi / s.box[0]
    x, y, z = s.x.T
    s.v += 0.8 * np.stack([np.sin(k * y) - np.sin(k * x), np.sin(k * z) + np.sin(k * y), np.cos(k * x)], -1) * (np.arange(3) < dim)
    if not periodic:  # room around it, but not below 0, where mirrors are
        s.box = s.box + np.where(np.arange(3) < dim, 4.0, 0.0)
    return s


def solid(s, d, variable=False, kernel="cubic", planes=()):
    """of the dump d of a run of s"""
    failed = (d["damage"] >= 1) | (d["spalled"] > 0)
    rho0, g, h = (np.array([a[t] for t in d["type"]]) for a in (RHO0, G, H))
    if variable:
        h = np.clip(h * (rho0 / d["rho"]) ** (1 / s.dim), 0.5 * h, 1.25 * h)
    c = np.sqrt(d["c"] ** 2 + 4 / 3 * np.where(failed, 0, g) / d["rho"])
    out = Solid(x=d["x"], v=d["v"], m=s.m, rho=d["rho"], rho0=rho0, p=d["p"], S=as_tensor(d), c=c,
                h=h, kind=d["type"], failed=failed, box=s.box * s.periodic, kernel=kernel, dim=s.dim)
    for k in planes:
        out = out.mirrored(k, 0.0)
    return out


def same(got, want, tolerance=1e-10, case=""):
    for name in ("f", "drho", "de"):
        assert np.abs(got[name] - want[name][:len(got["x"])]).max() <= tolerance * np.abs(want[name]).max(), (case, name)


def script(s, tmp_path, pair, words="", jc="", name="s", tension=True, kernel="cubic", elastic=False, **kw):
    return "clear\n" + scene(s, tmp_path / f"{name}.data", pair(words, tension, kernel, elastic), **kw) + JC.format(jc)


def lump(seed=45, n=6, jitter=0.03, types=2):
    """so even that M is limited nowhere: at corners its least eigenvalue is near 0.44"""
    s = body(seed=seed, n=n, periodic=False, jitter=jitter, speed=0.1)
    if types == 1:
        s.type[:], s.rho[:], s.mass = 1, 1.0, {1: 1.0, 2: 1.0}
    s.x, s.box = s.x + 4.0, s.box + 6.0
    s.v *= 0.5
    return s
