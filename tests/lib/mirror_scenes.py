"""Bodies beside mirror planes: what is left of a whole one, and whether it is the same."""

import numpy as np
from solid_scenes import PAIR, state
from sph_scenes import scene

N = 6  # particles along an edge of the eighth
ROOM = 20.0  # of the box, from the center


def part(planes, seed=31, mass=None):
    """a cube of jittered particles around the origin, even in all three directions, or what is left of it on the side of the planes"""
    s = state(seed=seed)
    s.mass = mass or s.mass
    keep = (s.x < N).all(1)
    x, v, kind = s.x[keep], s.v[keep], s.type[keep]
    v = v - 0.3 * x / N  # it is pressed together
    for k in range(3):
        if "xyz"[k] in planes:
            continue
        flip = np.ones(3)
        flip[k] = -1
        x, v, kind = np.concatenate([x, x * flip]), np.concatenate([v, v * flip]), np.concatenate([kind, kind])
    s.x, s.v, s.type = x, v, kind
    s.rho, s.esph = np.ones(len(x)), np.zeros(len(x))
    shift = np.array([0.0 if a in planes else ROOM for a in "xyz"])
    s.x = s.x + shift
    s.box = np.array([ROOM if a in planes else 2 * ROOM for a in "xyz"])
    s.periodic = (False,) * 3
    return s, shift


def start(planes, tmp_path, material, steps=30, words="viscosity 1 2", jc="", sides=None, more="", solid=True, mass=None, **kw):
    s, shift = part(planes, mass=mass)
    if sides:  # the material is below the planes
        s.x = s.box - s.x
        s.v = -s.v
    mirror = "".join(f" mirror {a} {s.box['xyz'.index(a)] if sides else 0.0} {'hi' if sides else 'lo'}" for a in planes)
    name = f"s{planes}{sides}.data"
    pair = PAIR.format(kernel="cubic", words=words + mirror, path=material) + "pair_coeff 1 2 tension no\n"
    text = scene(s, tmp_path / name, pair, **kw) + (f"fix jc all hvi/johnson-cook {jc}\n" if solid else "") + "timestep 0.004\n" + more
    return text + (f"run {steps}\n" if steps else ""), shift


def same(whole, some, shift, planes, tolerance=1e-9):
    """of the whole model, the particles on this side, by place"""
    keep = np.all([whole["x"][:, k] > ROOM for k in range(3) if "xyz"[k] in planes], axis=0)
    order = np.lexsort(np.round(whole["x"][keep] - ROOM, 6).T)
    back = np.lexsort(np.round(some["x"] - shift, 6).T)
    assert keep.sum() == len(some["x"])
    for name in ("x", "v", "f", "drho", "de", "rho", "S", "eps", "damage"):
        a = whole[name][keep][order] - (ROOM if name == "x" else 0)
        b = some[name][back] - (shift if name == "x" else 0)
        assert np.abs(a - b).max() <= tolerance * np.abs(whole[name]).max(), name
