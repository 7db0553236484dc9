"""compute hvi/energy clamps GROUP books what other fixes do to its particles: energy and momentum close again."""

import numpy as np
import pytest
from scenes import R_EQ, State, books, chain, collision, cube, ledger, momentum_error, scene

GROUPS = "group held id 1:9\ngroup rest subtract all held\n"  # the cube's face x = 0


def check(book, state, tolerance=1e-6):
    scale = np.abs(book["kinetic"] + book["contact"] + book["spring"]).max()
    assert np.abs(book["total"] - book["total"][0]).max() <= tolerance * scale
    p = np.array([book["p" + c] + book["left_p" + c] - book["j" + c] for c in "xyz"])
    swing = np.abs([book["p" + c] for c in "xyz"]).max() + np.abs([book["j" + c] for c in "xyz"]).max()
    assert np.abs(p - p[:, :1]).max() <= 1e-11 * swing


# what is done to the held particles; its impulse must be far from nothing
CLAMPS = {
    "setforce": ("velocity held set 0 0 0\n", "fix nve all nve\nfix c held setforce 0 0 0\n"),
    "setforce, moving": ("velocity held set 0.3 0 0\n", "fix nve all nve\nfix c held setforce 0 0 0\n"),
    "partial": ("velocity held set NULL NULL 0\n", "fix nve all nve\nfix c held setforce NULL NULL 0\n"),
    "addforce": ("", "fix nve all nve\nfix c held addforce 0.7 -0.2 0.1\n"),
    "gravity": ("", "fix nve all nve\nfix c held addforce 0.0 v_g 0.0\n"),
    "linear": ("velocity held set -0.4 0.1 0\n", "fix nve rest nve\nfix c held move linear -0.4 0.1 0\n"),
    "wiggle": (f"velocity held set {-0.8 * np.pi!r} 0 0\n", "fix nve rest nve\nfix c held move wiggle -0.2 0 0 0.5\n"),
    "not moved": ("velocity held set 0 0 0\n", "fix nve rest nve\n"),
    "viscous": ("", "fix nve all nve\nfix c held viscous 0.8\n"),
    "spring": ("", "fix nve all nve\nfix c held spring/self 40.0\n"),
    "gravity, fix": ("", "fix nve all nve\nfix c held gravity 2.0 vector 0 0 -1\n"),
}


@pytest.mark.parametrize("what", CLAMPS)
def test_clamped_block(lmp, what):
    """a vibrating block with one face held, pulled or pushed"""
    before, fixes = CLAMPS[what]
    s = cube(3, 0.05, 0.4, seed=2)
    s.v[:, 0] -= 0.5
    book = ledger("clamps held", every=10)
    text = scene(s, "s.data") + GROUPS + before + "variable g equal -0.5*(1+step/300)\n" + book + fixes
    book = books(lmp(text + "timestep 1e-4\nrun 3000\n").thermo)
    check(book, s)
    j = np.abs([book["j" + c] for c in "xyz"]).max()
    assert j > 0.1
    if what not in ("setforce", "partial", "not moved"):  # those do no work
        assert np.abs(book["clamps"]).max() > 1e-3 * book["total"][0]
    assert np.abs(book["bonds_broken"]).max() == 0


@pytest.mark.parametrize("newton, nranks", [("on", 1), ("off", 1), ("on", 2), ("off", 2)])
def test_pulled_chain_breaks(lmp, newton, nranks):
    """the end of a chain is drawn away until it breaks, from rank to rank: what the clamp gave is in the chain or broke with it"""
    s = chain(6, start=-5 * R_EQ - 0.25, box=[[-12.0, 12.0]] * 3)  # ranks meet at x = 0: it passes while its bond is tight
    s.v[:, 1] = 0.01 * np.arange(6)
    text = scene(s, "s.data", newton=newton, processors="* 1 1") + "group held id 1 6\ngroup end id 6\ngroup first id 1\ngroup rest subtract all held\n"
    text += ledger("clamps held", every=20) + "fix nve rest nve\nfix a first move linear 0 0 0\nfix b end move linear 2.5 0 0\n"
    book = books(lmp(text + "timestep 1e-3\nrun 1200\n", nranks=nranks).thermo)
    assert book["bonds_broken"][-1] >= 1 and book["bonds_broken"][0] == 0
    scale = book["kinetic"].max() + book["spring"].max()
    assert np.abs(book["total"] - book["total"][0]).max() <= 2e-5 * scale
    p = np.array([book["p" + c] - book["j" + c] for c in "xyz"])
    assert np.abs(p - p[:, :1]).max() <= 1e-12 * np.abs(p).max() + 1e-12 * np.abs(book["jx"]).max()
    assert book["clamps"][-1] < -0.3 * book["broken"][-1]


def test_time_step_may_change(lmp):
    """clamps and fix hvi/dt together, bonds breaking: the sum of momentum less impulse still stands"""
    s = collision(4)
    s.v[:4 * 16, 0] = 0.0
    text = scene(s, "s.data") + "group held id 1:16\n" + ledger("clamps held", every=20)
    text += "fix nve all nve\nfix c held setforce 0 0 0\nfix step all hvi/dt 0.02\nrun 1500\n"
    book = books(lmp(text).thermo)
    assert book["bonds_broken"][-1] > 0 and np.abs(book["jx"][-1]) > 1.0
    assert momentum_error(book, s) <= 1e-12
    assert np.abs(book["ratio"] - 1).max() <= 2e-5


def test_clamps_in_other_units(lmp):
    """impulse and work carry the units' conversion factors"""
    s = cube(3, 0.05, 0.4, seed=2)
    text = scene(s, "s.data", units="metal") + GROUPS + ledger("clamps held") + "fix nve all nve\nfix c held addforce 0.01 0 0\n"
    book = books(lmp(text + "timestep 1e-6\nrun 3000\n").thermo)
    check(book, s)
    assert book["jx"][-1] == pytest.approx(9 * 0.01 * 3e-3 / 1.0364269e-4, rel=1e-6)


def test_restart_keeps_clamps(lmp):
    """the booked work goes on after a restart"""
    s = cube(3, 0.05, 0.4, seed=2)
    middle = ledger("clamps held", every=10) + "fix nve all nve\nfix c held addforce 0.7 0 0\n"
    whole = lmp(scene(s, "s.data", sort=False) + GROUPS + middle + "timestep 1e-3\nrestart 100 r\nrun 200\n").thermo
    part = lmp("read_restart r.100\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n" + middle + "timestep 1e-3\nrun 100\n").thermo
    for name in whole:
        assert part[name][-1] == whole[name][-1], name


@pytest.mark.parametrize("order, good", [("after", False), ("before", True)])
def test_order_matters_and_is_checked(lmp, order, good):
    """the compute must come before the fixes whose forces it books"""
    s = State([[0, 0, 0], [1.2, 0, 0]], 0.0, [(0, 1)], [[-4.0, 6.0]] * 3)
    fixes, book = "fix nve all nve\nfix c held setforce 0 0 0\n", ledger("clamps held")
    text = scene(s, "s.data", bond="bond_style hvi/spring\nbond_coeff 1 1.0 1.1 1.3\n") + "group held id 1\n"
    text = text.replace("bond_style", "#\nbond_style")
    result = lmp(text + (book + fixes if good else fixes + book) + "run 1\n", expect_fail=not good)
    if not good:
        assert "must be defined before fix c (setforce)" in result.error


@pytest.mark.parametrize("newton, nranks", [("on", 1), ("off", 1), ("on", 2)])
def test_newcomers_bring_what_they_have(lmp, newton, nranks):
    """a particle put among the clamped ones in touch with another: the total grows by its energy, no clamp has worked

    It takes the place in memory of one that has left fast.
    """
    s = State([[0, 0, 0], [0, 5, 0], [7.99, 0, 0]], [[0, 0, 0], [0, 0, 0], [300.0, 0, 0]], [], [[-8.0, 8.0]] * 3)
    dt, v, r = 1e-4, 0.5, 1.0
    text = scene(s, "s.data", newton=newton, bond="bond_style none\n", processors="* 1 1") + "group held id 2\n" + ledger("clamps held", every=1)
    text += f"thermo_modify lost ignore\nregion spot block {r} {r + 1e-9} 0 1e-9 0 1e-9\nfix nve all nve\ntimestep {dt}\nrun 10\n"
    text += f"fix drop held deposit 1 1 20 4711 region spot vx {v} {v}\nfix c held addforce 0 0 0\nrun 60\n"
    result = lmp(text, nranks=nranks)
    book, atoms = books(result.thermo), result.thermo["Atoms"]
    assert list(np.unique(atoms)) == [2.0, 3.0] and atoms[-1] == 3 and book["left_count"][0] == 1
    came = np.flatnonzero(np.diff(atoms) > 0)[-1]
    phi, push = 0.25, 6.0  # of hvi/contact at r = sigma
    gain = np.diff(book["total"])
    assert gain[came] == pytest.approx(0.5 * v * v + phi + 0.5 * dt * push * v, abs=1e-6)
    assert np.abs(np.delete(gain, came)).max() < 1e-6
    assert book["clamps"] == pytest.approx(0.0, abs=1e-6)
    assert np.abs(book["jx"]).max() < 1e-12
    assert book["px"][came + 1] - book["px"][0] == pytest.approx(v, abs=1e-12)
