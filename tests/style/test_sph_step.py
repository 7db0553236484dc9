"""The time step of SPH, from the force loop: against the formula in NumPy for all pairs; how far a step may carry; how often it is chosen."""

import itertools

import numpy as np
import pytest
from solid_scenes import MATERIAL, OUT, read, state
from sph_scenes import SUPPORT, Fluid, ideal_gas, random_fluid, scene, tait
from timestep_scenes import APPROACH, GROWING, SHOW, SIGNAL, three_pairs

C = 0.25
LINES = SHOW.replace("fix nve all nve\n", "")
EOS = {1: tait(1.0, 4.0), 2: ideal_gas(1.4)}
PAIR = "pair_style hvi/sph {kernel} dim {dim} {words}\npair_coeff 1 1 eos tait 1.0 4.0 7 h {h[1]}\npair_coeff 2 2 eos idealgas 1.4 h {h[2]}\npair_coeff 1 2 tension yes {cross}\n"


def least(x, v, c, h, kernel, visc, box=None, wide=False):
    """shortest l/c of particles, l/(c + u + 0.6 (a c + b mu)) of pairs within reach that approach; visc(i, j): a, b, none with
    Riemann problems, whose a is 1, and b mu 0.6 u; wide: the larger h reaches"""
    half = 0.5 * SUPPORT[kernel]
    i, j = np.triu_indices(len(x), 1)
    d = x[i] - x[j]
    if box is not None:
        d -= box * np.round(d / np.where(box > 0, box, np.inf))
    r = np.sqrt((d**2).sum(1))
    u = -((v[i] - v[j]) * d).sum(1) / r
    hij = 0.5 * (h[i] + h[j])
    near = (r < SUPPORT[kernel] * (np.maximum(h[i], h[j]) if wide else hij)) & (u > 0)
    i, j, r, u, hij = i[near], j[near], r[near], u[near], hij[near]
    pair_c = np.maximum(c[i], c[j])
    if visc:
        a, b = visc(i, j)
        viscous = a * pair_c + b * hij * r * u / (r**2 + 0.01 * hij**2)
    else:
        viscous = pair_c + 0.6 * u
    return (half * h / c).min(), (half * hij / (pair_c + u + 0.6 * viscous)).min(initial=np.inf)


def state_of(s):
    c = np.empty(len(s.x))
    for t in set(s.type):
        k = s.type == t
        c[k] = EOS[t](s.rho[k], (s.esph / s.m)[k])[1]
    return c, np.array([s.h[t] for t in s.type])


def visc_of(s, own, cross):
    def visc(i, j):
        mixed = s.type[i] != s.type[j]
        return np.where(mixed, cross[0], own[0]), np.where(mixed, cross[1], own[1])

    return visc


def first(lmp, text, **how):
    row = lmp(text + f"fix step all hvi/dt {C}\n" + LINES + "run 0\n", **how).thermo
    return row["Dt"][0], row["f_step[3]"][0]


KINDS = {  # words of pair_style, of the pair of types, a and b of one type and of two
    "viscosity": ("viscosity 0.8 1.5", "viscosity 0.3 4.0", (0.8, 1.5), (0.3, 4.0)),
    "defaults": ("", "", (1.0, 2.0), (1.0, 2.0)),
    "riemann": ("dissipation riemann", "", None, None),
}


@pytest.mark.each_value
@pytest.mark.parametrize("kernel, dim", [("cubic", 3), ("quintic", 2), ("lucy", 3), ("wendland4", 1)])
@pytest.mark.parametrize("kind", KINDS)
def test_against_all_pairs(lmp, tmp_path, kind, kernel, dim):
    """of random fluids, slow and fast, with two h: what limits is a pair, then a particle"""
    words, cross, own, other = KINDS[kind]
    h = {t: a * 2.0 / SUPPORT[kernel] for t, a in ((1, 1.3), (2, 1.1))}
    limits = set()
    for seed, speed in ((3, 2.5), (4, 0.5), (5, 1e-3)):
        s = random_fluid({1: 30, 2: 12, 3: 7}[dim], dim, seed=seed, speed=speed, h=[h[1], h[2]])
        c, sizes = state_of(s)
        alone, pair = least(s.x, s.v, c, sizes, kernel, own and visc_of(s, own, other), s.box, kind == "riemann")
        text = scene(s, tmp_path / "s.data", PAIR.format(kernel=kernel, dim=dim, words=words, h=h, cross=cross))
        dt, why = first(lmp, text)
        assert dt == pytest.approx(C * min(alone, pair), rel=1e-12) and why == SIGNAL, speed
        limits.add(pair < alone)
    assert True in limits


def test_of_a_particle(lmp, tmp_path):
    """nobody approaches: all fly apart from the middle"""
    s = random_fluid(5, 3, seed=6, speed=0.0, h=[1.3, 1.1], periodic=False)
    s.x, s.box = s.x + 4.0, s.box + 8.0
    s.v = 0.1 * (s.x - s.x.mean(0))
    c, h = state_of(s)
    alone, pair = least(s.x, s.v, c, h, "cubic", visc_of(s, (1, 2), (1, 2)))
    dt, why = first(lmp, scene(s, tmp_path / "s.data", PAIR.format(kernel="cubic", dim=3, words="", h=s.h, cross="")))
    assert pair == np.inf and dt == pytest.approx(C * alone, rel=1e-12) and why == SIGNAL


@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_same_on_any_layout(lmp, tmp_path, nranks):
    """newton on and off, brick and tiled: the pair may lie across ranks and faces"""
    h = {1: 1.3, 2: 1.1}
    s = random_fluid(7, seed=8, speed=2.0, h=[1.3, 1.1])
    c, sizes = state_of(s)
    alone, pair = least(s.x, s.v, c, sizes, "cubic", visc_of(s, (1, 2), (1, 2)), s.box)
    assert pair < 0.5 * alone
    for newton, comm in itertools.product(("on", "off"), ("brick", "tiled")):
        text = scene(s, tmp_path / "s.data", PAIR.format(kernel="cubic", dim=3, words="", h=h, cross=""), newton=newton, comm=comm)
        dt, _ = first(lmp, text, nranks=nranks)
        assert dt == pytest.approx(C * pair, rel=1e-12), (newton, comm)


@pytest.mark.parametrize("words", ["", "h variable", "dissipation riemann"])
def test_solids(lmp, tmp_path, words):
    """after 40 steps, stressed, some of them failed: signals are longitudinal"""
    (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    s = state()
    pair = f"pair_style hvi/sph cubic {words}\npair_coeff * * file m.hvi h 1.25\npair_coeff 1 2 tension no\n"
    text = scene(s, tmp_path / "s.data", pair) + "fix jc all hvi/johnson-cook\ntimestep 0.004\nrun 40\n"
    # changed velocities start particles anew: forces are then those of what is put out
    text += "velocity all ramp vx 0.01 1.31 x 0.0 8.0 sum yes units box\n" + OUT.format("f")
    dt, why = first(lmp, text)
    d = read(tmp_path / "f")
    failed = (d["damage"] >= 1) | (d["spalled"] > 0)
    h = np.clip(1.25 * np.cbrt(1 / d["rho"]), 0.5 * 1.25, 1.25**2) if "variable" in words else np.full(len(d["x"]), 1.25)
    c = np.sqrt(d["c"] ** 2 + 4 / 3 * np.where(failed, 0.0, 6.0) / d["rho"])
    alone, pair = least(d["x"], d["v"], c, h, "cubic", None if "riemann" in words else lambda i, j: (1.0, 2.0), s.box, True)
    assert 5 < failed.sum() < 0.9 * len(failed) and pair < alone
    assert dt == pytest.approx(C * pair, rel=1e-10) and why == SIGNAL


def two(r, u, words="", more="", h=1.25, frame=(0, 0, 0), kinds=(1, 1), box=20.0):
    """two particles of sound 4, at a distance, closing at speed u along a diagonal"""
    n = np.array([1.0, 2.0, -2.0]) / 3
    v = np.stack([u * n, 0 * n]) + frame
    x = np.stack([0 * n, r * n]) + 0.5 * box
    s = Fluid(x, v, np.ones(2), np.zeros(2), np.array(kinds), {1: 1.0, 2: 1.0}, {1: h, 2: h}, np.full(3, box), (False,) * 3)
    return s, f"pair_style hvi/sph cubic {words}\npair_coeff * * eos tait 1.0 4.0 7 h {h}\n{more}"


def test_only_within_reach_and_nearing(lmp, tmp_path):
    """reach 2.5: beyond it only the way of a step counts, a quarter of the reach, in any frame"""
    h, c = 1.25, 4.0

    def dt(*args, **kw):
        s, pair = two(*args, **kw)
        return first(lmp, scene(s, tmp_path / "s.data", pair))

    for r, u in ((0.9, 1.0), (2.4, 1.0), (2.499, 3.0)):
        mu = h * r * u / (r**2 + 0.01 * h**2)
        assert dt(r, u) == (pytest.approx(C * h / (c + u + 0.6 * (c + 2 * mu)), rel=1e-12), SIGNAL)
        assert dt(r, u, frame=(300, -50, 7))[0] == pytest.approx(dt(r, u)[0], rel=1e-9)
    assert dt(2.4, -1.0) == (pytest.approx(C * h / c, rel=1e-12), SIGNAL)
    assert dt(2.501, 1.0) == (pytest.approx(C * h / c, rel=1e-12), SIGNAL)
    n = np.abs(np.array([1.0, 2.0, -2.0]) / 3)
    for u in (9.0, 40.0, -40.0):  # the diagonal of the box of velocities
        assert dt(2.7, u) == (pytest.approx(0.25 * 2 * h / np.linalg.norm(u * n), rel=1e-12), APPROACH)
        assert dt(2.7, u, frame=(1e3, 0, 1e2))[0] == pytest.approx(dt(2.7, u)[0], rel=1e-9)
    # of the smallest h
    small = "pair_coeff 2 2 eos tait 1.0 4.0 7 h 1.0\n"
    assert dt(2.7, 40.0, more=small, kinds=(1, 1))[0] == pytest.approx(0.25 * 2 * 1.0 / 40, rel=1e-12)


@pytest.mark.parametrize("words, least", [("h variable", 0.5), ("h variable 0.8 1.1", 0.8), ("h variable 0.1 10", 0.1)])
def test_beyond_reach_of_h_as_it_is(lmp, tmp_path, words, least):
    """variable h: its start, then that of a particle that has become eight times, and 8000 times as dense, not the smallest it may become"""
    s, pair = two(2.7, 40.0, words=words, more="pair_coeff 2 2 eos linear 1.0 16.0 h 1.25\n", kinds=(1, 2))
    text = scene(s, tmp_path / "s.data", pair) + f"fix step all hvi/dt {C}\n" + LINES + "run 0\n"
    for rho in (8.0, 8000.0):
        text += f"set type 2 sph/rho {rho}\nfix step all hvi/dt {C}\nrun 0\n"
    for run, shrunk in zip(lmp(text).runs, (1.0, 0.5, 0.05), strict=True):
        assert run["Dt"][0] == pytest.approx(0.25 * 2 * 1.25 * max(shrunk, least) / 40, rel=1e-12), shrunk
        assert run["f_step[3]"][0] == APPROACH


def test_travel_keeps_contacts_seen(lmp, tmp_path):
    """two blocks meet at five times the speed of sound, from beyond reach: never more than a quarter of the reach deeper in a step"""
    x = np.stack(np.meshgrid(*[np.arange(4)] * 3, indexing="ij"), -1).reshape(-1, 3) + 4.0
    x = np.vstack([x, x + [13.3, 0, 0]]) + [0, 20, 20]
    v = np.zeros_like(x)
    v[:64, 0] = 20.0
    s = Fluid(x, v, np.ones(128), np.zeros(128), np.repeat([1, 2], 64), {1: 1.0, 2: 1.0}, {1: 1.25, 2: 1.25}, np.array([60.0, 52, 52]), (False,) * 3)
    pair = "pair_style hvi/sph cubic\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"
    text = scene(s, tmp_path / "s.data", pair) + f"fix step all hvi/dt 0.9\ncompute book all hvi/energy\n{LINES}"
    text += "group left type 1\ngroup right type 2\nvariable gap equal bound(right,xmin)-bound(left,xmax)\n"
    text += "thermo_style custom step dt f_step[3] v_gap c_book[9]\nthermo_modify norm no format float %.16g\nrun 35\n"
    t = lmp(text).thermo
    gap, before = t["v_gap"], t["v_gap"] > 2.5
    assert before.sum() > 5 and (t["f_step[3]"][before] == APPROACH).any()
    deeper = np.minimum(gap, 2.5)
    assert (-np.diff(deeper))[before[:-1]].max() <= 0.625 * (1 + 1e-9)
    assert set(t["f_step[3]"]) >= {APPROACH, SIGNAL} and np.abs(t["c_book[9]"] - 1).max() < 0.1


@pytest.mark.parametrize("r, u", [(1.1, 1.0), (1.3, 9.0), (1.3, 40.0)])
def test_mirrors(lmp, tmp_path, r, u):
    """one that flies toward a plane: the step is that of it and a second one in place of its image"""
    pair = "pair_style hvi/sph cubic {}\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"
    steps = []
    for words, x, v in (("mirror x 10.0 lo", [[10 + r, 8, 8]], [[-u, 0, 0]]), ("", [[10 + r, 8, 8], [10 - r, 8, 8]], [[-u, 0, 0], [u, 0, 0]])):
        n = len(x)
        s = Fluid(np.array(x, float), np.array(v, float), np.ones(n), np.zeros(n), np.ones(n, int), {1: 1.0}, {1: 1.25}, np.full(3, 20.0), (False,) * 3)
        steps.append(first(lmp, scene(s, tmp_path / "s.data", pair.format(words))))
    assert steps[0] == (pytest.approx(steps[1][0], rel=1e-12), steps[1][1])
    assert steps[1][1] == (SIGNAL if r == 1.1 else APPROACH)


@pytest.mark.parametrize("u, why", [(-40.0, SIGNAL), (40.0, APPROACH)])
def test_mirrors_far(lmp, tmp_path, u, why):
    """away from a plane nothing is met; beyond reach of its image a particle may come nearer by what is left to the reach, less a skin"""
    s = Fluid(np.array([[13.0, 8, 8]]), np.array([[-u, 0, 0.0]]), np.ones(1), np.zeros(1), np.ones(1, int), {1: 1.0}, {1: 1.25}, np.full(3, 20.0), (False,) * 3)
    dt, limiter = first(lmp, scene(s, tmp_path / "s.data", "pair_style hvi/sph cubic mirror x 10.0 lo\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"))
    assert limiter == why
    assert dt == pytest.approx(C * 1.25 / 4.0, rel=1e-12) if why == SIGNAL else 0.625 / (2 * u) < dt < (6.0 - 2.5 + 0.625) / (2 * u)


def test_every(lmp, tmp_path):
    """SPH alone: each step, from what the forces have found; with N those steps; beside contacts and springs each tenth by default"""
    s, pair = two(1.4, 0.3)
    text = scene(s, tmp_path / "s.data", pair, skin=1.0)

    def changed(text, more=""):
        t = lmp(text + f"fix step all hvi/dt {C} {more}\n{LINES}run 40\n").thermo
        assert t["f_step[3]"][0] == SIGNAL
        return np.flatnonzero(np.diff(t["Dt"])) + 1

    assert len(changed(text)) >= 38 and list(changed(text, "every 1")) == list(changed(text))
    assert set(changed(text, "every 7") % 7) == {0} and len(changed(text, "every 7")) == 5
    r = lmp(three_pairs(sound=40.0) + "velocity fluid ramp vx 0.0 -0.01 x 0 1 units box\nneigh_modify delay 100\nrun 45\n").runs[-1]
    assert set((np.flatnonzero(np.diff(r["Dt"])) + 1) % 10) == {0}
    # and each step again when they are gone
    alone = "group gone type 2 3\ndelete_atoms group gone bond yes\nbond_style none\npair_style hvi/sph cubic\npair_coeff * * eos tait 1.0 4.0 7 h 1.2\nrun 20\n"
    r = lmp(three_pairs(sound=40.0) + alone).runs[-1]
    assert len(np.flatnonzero(np.diff(r["Dt"]))) == 20 and (r["f_step[3]"][1:] == GROWING).all()
