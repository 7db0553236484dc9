"""Scenes where particles of solids clump in tension: rubber rings that meet, a strip that is stretched; and what tells that they did."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from solid_runs import material, run
from sph_scenes import Fluid

RING = dict(rho0=1.01, mu=0.22, speed=0.059, inner=3.0, outer=4.0)  # Gray, Monaghan & Swift 2001; cm, g/cc, speed of sound 1


def pieces(x, reach):
    """how many connected components of more than one percent of the particles; links are shorter than reach"""
    pairs = cKDTree(x).query_pairs(reach, output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(x), len(x)))
    label = connected_components(graph, directed=False)[1]
    return int((np.bincount(label) > 0.01 * len(x)).sum())


def nearest(x):
    """distance to the nearest neighbor, by particle"""
    return cKDTree(x).query(x, k=2)[0][:, 1]


def rings(lmp, folder, words, dx=0.2, h=1.5, kernel="cubic", t_end=160.0, frames=20, name="rings", courant=0.3, voids=None):
    """two rubber rings meet head-on; they are bodies of their own: what makes them bounce is not tension between them

    voids: the section "spall voids ..." of the rubber, which then fails by it
    """
    c = np.sqrt(1 + 4 / 3 * RING["mu"])
    path = material(folder / "rubber.hvi", f"eos linear rho0 {RING['rho0']} K {RING['rho0']}",
                    f"strength perfect G {RING['mu'] * RING['rho0']} Y 1e6", *([voids] if voids else []))
    k = int(np.ceil(RING["outer"] / dx))
    q = dx * (np.arange(-k, k) + 0.5)
    ring = np.stack(np.meshgrid(q, q, indexing="ij"), -1).reshape(-1, 2)
    r = np.sqrt((ring**2).sum(1))
    ring = ring[(r > RING["inner"]) & (r < RING["outer"])]
    n, apart = len(ring), RING["outer"] + 1.5 * dx
    x = np.zeros((2 * n, 3))
    x[:n, :2], x[n:, :2] = ring - [apart, 0], ring + [apart, 0]
    box = np.array([40.0, 30.0, 1.0])
    x[:, :2] += box[:2] / 2
    m = RING["rho0"] * dx**2
    s = Fluid(x, np.zeros((2 * n, 3)), np.full(2 * n, RING["rho0"]), np.zeros(2 * n), np.repeat([1, 2], n), {1: m, 2: m}, {1: h * dx, 2: h * dx},
              box, (False, False, True), 2)
    s.v[:, 0] = np.repeat([RING["speed"], -RING["speed"]], n)
    pair = f"pair_style hvi/sph {kernel} dim 2 form sum {words} h constant\npair_coeff * * file {path} h {h * dx:.17g}\n"
    dt = courant * h * dx / c
    steps = int(t_end / dt)
    every = max(1, steps // frames)
    spall = "voids" if voids else "none"
    result = run(lmp, folder, s, pair, f"strength perfect damage no spall {spall}", steps, dt=dt, frames=every, name=name, lost="ignore")
    out = []
    for f in result.frames:
        left = f["type"] == 1
        y = f["x"][:, :2]
        out.append(dict(t=f["time"], v=f["v"][left, 0].mean() / RING["speed"], pieces=max(pieces(y[k], 1.7 * dx) for k in (left, ~left)),
                        near=np.quantile(nearest(y), 0.01) / dx, p=f["p"].min(), failed=int((f["spalled"] > 0).sum()), damaged=f["void_damage"].max(),
                        voids=f["voids"].max()))
    return result, out


def strip(lmp, folder, words, kernel="cubic", h=1.2, length=40, width=8, strain=0.2, rate=0.004, seed=3, name="strip"):
    """an elastic strip, its places a little out of order, is pulled at both ends; c = sqrt(24)

    Returns the result and, for the last frame, distances to the nearest neighbor, in units of the median.
    """
    path = material(folder / "metal.hvi", "eos linear rho0 1 K 16", "strength perfect G 6 Y 1000")
    rng = np.random.default_rng(seed)
    q = np.stack(np.meshgrid(np.arange(length), np.arange(width), indexing="ij"), -1).reshape(-1, 2) + 0.5
    n, box = len(q), np.array([2.0 * length, 3.0 * width, 1.0])
    x = np.zeros((n, 3))
    x[:, :2] = q + [0.5 * length, width] + rng.normal(0, 1e-3, (n, 2))
    ends = (q[:, 0] < 3) | (q[:, 0] > length - 3)
    s = Fluid(x, np.zeros((n, 3)), np.ones(n), np.zeros(n), np.where(ends, 2, 1), {1: 1.0, 2: 1.0}, {1: h, 2: h}, box, (False, False, True), 2)
    s.v[:, 0] = rate * (x[:, 0] - 0.5 * box[0])
    pair = f"pair_style hvi/sph {kernel} dim 2 form sum {words} h constant\npair_coeff * * file {path} h {h}\npair_coeff 1 2 tension yes\n"
    dt = 0.2 * h / np.sqrt(24)
    steps = int(strain / rate / dt)
    r = run(lmp, folder, s, pair + "group ends type 2\n", "strength perfect damage no spall none", steps, dt=dt, frames=steps,
            more="fix hold ends setforce 0 0 0", ledger="clamps ends", every=100, name=name)
    near = nearest(r.frames[-1]["x"][~ends, :2])
    return r, near / np.median(near)
