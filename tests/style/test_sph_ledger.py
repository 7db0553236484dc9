"""Two blocks collide: the books of energy, momentum and mass close, on any ranks, with variable h, with particles that leave."""

import numpy as np
import pytest
from sph_scenes import Fluid, random_fluid, rates, riemann_rates, scene, tait

LEDGER = """compute book all hvi/energy
compute T all pressure NULL virial
thermo 5
thermo_style custom step dt time atoms f_step[3] c_book[*]
thermo_modify norm no lost ignore format float %.17g
"""
PAIR = "pair_style hvi/sph cubic {0}\npair_coeff 1 1 eos gruneisen 1.0 1.0 1.4 2.0 0.48 1.0 h 1.2\npair_coeff 2 2 eos tait 1.7 1.5 7 h 1.2\n"


def blocks(speed=0.8, offset=12.0):
    """two free blocks of different materials, 6 x 5 x 4 each, that meet at 2 * speed (sound speeds 1 and 1.5)"""
    one = np.stack(np.meshgrid(np.arange(6), np.arange(5), np.arange(4), indexing="ij"), -1).reshape(-1, 3) + 0.5
    x = np.concatenate([one, one + [7.2, 0.3, 0.2]]) + offset
    kind = np.repeat([1, 2], len(one))
    v = np.zeros_like(x)
    v[:, 0] = np.where(kind == 1, speed, -speed)
    v += np.random.default_rng(2).normal(0, 0.01, v.shape)
    rho = np.where(kind == 1, 1.0, 1.7)
    return Fluid(x, v, rho, np.zeros(len(x)), kind, {1: 1.0, 2: 1.7}, {1: 1.2, 2: 1.2}, np.array([40.0, 30.0, 29.0]), (False,) * 3)


def run(lmp, tmp_path, words="", C=0.1, nranks=1, state=None, until=6.0, newton="on", comm="brick"):
    state = state or blocks()
    text = scene(state, tmp_path / "s.data", PAIR.format(words), newton=newton, comm=comm)
    text += f"fix step all hvi/dt {C}\n" + LEDGER + f"variable t equal f_step[2]\nfix stop all halt 1 v_t > {until} error continue message no\nrun 100000\n"
    return lmp(text, nranks=nranks).thermo


@pytest.mark.parametrize("words", ["", "h variable", "interface 0.3", "form symmetric", "h variable 0.8 1.1 form symmetric",
                                   "dissipation riemann", "dissipation riemann h variable"])
def test_books_close(lmp, tmp_path, words):
    """energy to 1e-3 at the default step, momentum and mass to round-off; viscosity only heats"""
    t = run(lmp, tmp_path, words)
    kinetic, internal, total, heat = t["c_book[1]"], t["c_book[2]"], t["c_book[8]"], t["c_book[28]"]
    assert internal[-1] > 0.1 * kinetic[0] and kinetic[-1] < 0.8 * kinetic[0]
    assert np.abs(t["c_book[9]"] - 1).max() < 1e-3
    assert np.abs(total - kinetic - internal).max() <= 1e-12 * total[0]
    scale = 120 * 2.7 * 0.8
    for k in (10, 11, 12):
        assert np.abs(t[f"c_book[{k}]"] - t[f"c_book[{k}]"][0]).max() < 1e-13 * scale
    assert np.abs(t["c_book[19]"] / t["c_book[19]"][0] - 1).max() < 1e-14
    assert (np.diff(heat) >= 0).all() and 0.1 * internal[-1] < heat[-1] < kinetic[0]


def test_drift_falls_with_the_step(lmp, tmp_path):
    """leapfrog: second order, so half the step leaves about a quarter of the drift; the table of Howto_sph_verification"""
    drift = {C: np.abs(run(lmp, tmp_path, "h variable", C=C, until=4.0)["c_book[9]"] - 1).max() for C in (0.05, 0.1, 0.2, 0.3, 0.6)}
    for C, largest in drift.items():
        print(f"C {C}: largest drift / energy {largest:.3e}")
    assert drift[0.1] < 0.4 * drift[0.2] and drift[0.05] < 0.4 * drift[0.1]
    assert drift[0.2] < 5e-3


@pytest.mark.parametrize("nranks, newton, comm", [(2, "on", "tiled"), (3, "off", "brick"), (4, "on", "brick")])
def test_ranks(lmp, tmp_path, nranks, newton, comm):
    """smooth enough to stay together: energies and the viscous heat to 1e-9"""
    one = run(lmp, tmp_path, "h variable interface 0.3", until=3.0)
    t = run(lmp, tmp_path, "h variable interface 0.3", until=3.0, nranks=nranks, newton=newton, comm=comm)
    assert np.array_equal(t["Step"], one["Step"])
    for k in (1, 2, 8, 28):
        assert t[f"c_book[{k}]"] == pytest.approx(one[f"c_book[{k}]"], rel=1e-9, abs=1e-9), k


def test_leaving(lmp, tmp_path):
    """what leaves takes its momentum, kinetic and internal energy along"""
    state = blocks(offset=4.0)
    state.box[:] = [17.0, 9.6, 8.6]  # splashes hit the faces
    t = run(lmp, tmp_path, "h variable", state=state, until=12.0, nranks=2)
    assert t["c_book[21]"][-1] > 20 and t["Atoms"][-1] == 240 - t["c_book[21]"][-1]
    assert t["c_book[6]"][-1] > 1.0
    assert np.abs(t["c_book[9]"] - 1).max() < 2e-3
    assert np.abs(t["c_book[19]"] + t["c_book[20]"] - t["c_book[19]"][0]).max() < 1e-12 * t["c_book[19]"][0]
    for k in range(3):
        p = t[f"c_book[{10 + k}]"] + t[f"c_book[{13 + k}]"]
        assert p[0] == pytest.approx(t[f"c_book[{24 + k}]"][0])


def test_time_step(lmp, tmp_path):
    """at rest C h/c (h half the reach); shorter while bodies approach; the same in a moving frame"""
    still = random_fluid(6, seed=1, types=1, jitter=0.0, speed=0.0, h=1.2)
    still.rho[:] = 1.0
    pair = "pair_style hvi/sph {0}\npair_coeff * * eos tait 1.0 4.0 7 h {1}\n"
    for kernel, h, half in (("cubic", 1.2, 1.2), ("quintic", 0.8, 1.2), ("lucy", 2.4, 1.2)):
        text = scene(still, tmp_path / "s.data", pair.format(kernel, h)) + "fix step all hvi/dt 0.3\nthermo_style custom step dt f_step[3]\n"
        t = lmp(text + "thermo_modify format float %.15g\nrun 0\n").thermo
        assert t["Dt"][0] == pytest.approx(0.3 * half / 4.0, rel=1e-12) and t["f_step[3]"][0] == 5
    near, far = run(lmp, tmp_path, until=0.2), run(lmp, tmp_path, until=0.2, state=blocks(0.1))
    assert near["Dt"][0] < 0.7 * far["Dt"][0]
    moving = blocks()
    moving.v += [3.0, -2.0, 1.0]
    assert run(lmp, tmp_path, until=0.2, state=moving)["Dt"][0] == pytest.approx(near["Dt"][0], rel=1e-12)


def test_bodies_do_not_weld(lmp, tmp_path):
    """two rods in 1D that touch and move apart: tension no, nothing holds them; tension yes, they stay one"""
    gap = {}
    for name in ("no", "yes"):
        x = np.zeros((80, 3))
        x[:, 0] = np.arange(80) + 20.5
        kind = np.repeat([1, 2], 40)
        v = np.zeros_like(x)
        v[:, 0] = np.where(kind == 1, -0.02, 0.02)
        rods = Fluid(x, v, np.ones(80), np.zeros(80), kind, {1: 1.0, 2: 1.0}, {1: 1.2, 2: 1.2}, np.array([121.0, 20, 20]), (False, True, True), 1)
        pair = "pair_style hvi/sph cubic dim 1\npair_coeff * * eos linear 1.0 1.0 h 1.2\n" + f"pair_coeff 1 2 tension {name}\n"
        text = scene(rods, tmp_path / "s.data", pair) + "fix step all hvi/dt 0.2\ngroup left type 1\ngroup right type 2\n"
        text += "variable gap equal bound(right,xmin)-bound(left,xmax)\nvariable t equal f_step[2]\n"
        text += "fix stop all halt 1 v_t > 100 error continue message no\nthermo 20\nthermo_style custom step v_t v_gap\nrun 100000\n"
        t = lmp(text).thermo
        gap[name], time = t["v_gap"], t["v_t"]
        if name == "no":
            assert gap["no"][-1] == pytest.approx(1 + 0.04 * time[-1], rel=0.01) and time[-1] > 90, name
    assert gap["yes"].max() < 1.5


@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_heat_of_particles_that_are_integrated(lmp, tmp_path, nranks):
    """the entry viscous holds what flows into the energies of particles of fix hvi/sph, not into those that keep theirs: by hand from all pairs"""
    s = random_fluid(7, seed=91, h=1.2)
    some = (s.x[:, 0] < 3.1) | (s.type == 2) & (s.x[:, 1] > 4.3)
    groups = "region one block INF 3.1 INF INF INF INF units box\nregion two block INF INF 4.3 INF INF INF units box\ngroup one region one\ngroup high region two\n"
    groups += "group kind type 2\ngroup two intersect high kind\ngroup some union one two\nfix sph some hvi/sph\n"
    text, want = "", []
    eos = {1: tait(1.0, 4.0), 2: tait(1.7, 3.0)}
    for words, solve in (("viscosity 1.5 0.5", lambda: rates(s, eos, "cubic", visc=(1.5, 0.5), tension=False)),
                         ("dissipation riemann", lambda: riemann_rates(s, eos, "cubic", tension=False))):
        pair = f"pair_style hvi/sph cubic {words}\npair_coeff 1 1 eos tait 1.0 4.0 7 h 1.2\npair_coeff 2 2 eos tait 1.7 3.0 7 h 1.2\n"
        heats = solve()["heats"]
        assert 0.2 * heats.sum() < heats[some].sum() < 0.8 * heats.sum(), words
        for newton, fix in (("on", groups), ("off", groups), ("on", "fix sph all hvi/sph\n")):
            text += "clear\n" + scene(s, tmp_path / "s.data", pair, newton=newton, fix=fix) + "compute book all hvi/energy\n"
            text += "thermo_style custom step c_book[28]\nthermo_modify format float %.17g\ntimestep 1e-9\nrun 1\n"
            want.append(heats[some].sum() if fix == groups else heats.sum())
    found = [r["c_book[28]"][-1] / 1e-9 for r in lmp(text, nranks=nranks).runs]
    assert found == pytest.approx(want, rel=1e-6)


@pytest.mark.parametrize("words", ["", "dissipation riemann"])
def test_books_that_begin_late(lmp, tmp_path, words):
    """compute hvi/energy defined between two runs: its first total is that of its first line"""
    text = scene(blocks(), tmp_path / "s.data", PAIR.format(words)) + "fix step all hvi/dt 0.1\nrun 60\n" + LEDGER + "run 20\n"
    t = lmp(text).thermo
    assert t["c_book[2]"][0] > 0.01 * t["c_book[1]"][0] and np.ptp(t["c_book[2]"]) > 1e-3 * t["c_book[2]"][0]
    assert np.abs(t["c_book[9]"] * t["c_book[8]"][0] / t["c_book[8]"] - 1).max() < 1e-14
