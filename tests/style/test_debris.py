"""fix hvi/debris: a ball that flies apart in all directions fails into fragments smaller than its particles, which become as many."""

import hvi
import numpy as np
import pytest

BALL = """
units si
newton {newton}
atom_style sph
atom_modify map array
boundary f f f
region box block {low} 0.1 {low} 0.1 -0.1 0.1 units box
create_box 1 box
fix masses all property/atom rmass ghost yes
lattice sc 4e-4 origin 0.5 0.5 0.5
region ball sphere 0 0 0 1.6e-3 units box
create_atoms 1 region ball
change_box all x final {edge} 0.1 y final {edge} 0.1 units box
mass 1 1.0
set type 1 mass $(2703*4e-4^3)
pair_style hvi/sph cubic dissipation riemann {mirror}
pair_coeff 1 1 file Al6061-T6.hvi spacing 4e-4
variable vx atom {rate}*x
variable vy atom {rate}*y
variable vz atom {rate}*z
velocity all set v_vx v_vy v_vz
"""
MODEL = """
fix move all hvi/sph
fix solid all hvi/johnson-cook damage no spall voids
fix step all hvi/dt 0.6 max 3e-8
fix debris all hvi/debris {words}
compute book all hvi/energy
compute state all hvi/atom fragsize e
thermo_style custom step f_step[2] dt atoms f_debris c_book[*]
thermo_modify format float %.17g lost ignore
thermo 20
"""
DUMP = "write_dump all custom {} id type mass x y z vx vy vz c_state[1] c_state[2] modify sort id format float %.17g\n"
RATE = 8e5  # 1/s
EDGE = 4e-4
MASS = 2703 * EDGE**3  # of a particle


@pytest.fixture
def ball(lmp, root, tmp_path):
    def run(after, nranks=1, words="", newton="on", quarter=False, rate=RATE, head=None, **kw):
        low, edge, mirror = (0, -4e-4, "mirror x 0 lo mirror y 0 lo") if quarter else (-0.1, -0.1, "")
        text = (head or BALL.format(newton=newton, low=low, edge=edge, mirror=mirror, rate=rate)) + MODEL.format(words=words) + after
        return lmp(text, nranks=nranks, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)

    return run


def frame(path):
    return hvi.Dump(str(path), units="si")[0]


def divided(end):
    """of how many pieces each particle is one, (n,)"""
    return np.round(MASS / end.m)


@pytest.mark.parametrize("nranks, newton", [(1, "on"), pytest.param(3, "on", marks=pytest.mark.long), (4, "off")])
def test_pieces(ball, tmp_path, nranks, newton):
    """mass, momentum, energy and the middle of each particle stay; pieces fly on as all does, from one place; fragments as coarse as particles change nothing"""
    thermo = ball("run 200\n" + DUMP.format("end.dump"), nranks=nranks, newton=newton).thermo
    end, pieces = frame(tmp_path / "end.dump"), np.array(thermo["f_debris"])
    whole = int(thermo["Atoms"][0])
    number = divided(end)
    assert pieces[0] == 0 and pieces[-1] == (number > 1).sum() > 0.95 * len(end)
    assert (1 / number).sum() == pytest.approx(whole) and len(end) > 8 * whole
    assert end.m.sum() == pytest.approx(whole * 2703 * 4e-4**3, rel=1e-12)
    ratio = np.array(thermo["c_book[9]"])
    made = np.flatnonzero(np.diff(pieces))
    assert len(made) and abs(ratio - 1).max() < 1e-3 and all(abs(ratio[k + 1] - ratio[k]) < 1e-6 for k in made)
    p = end.m @ end.v
    assert abs(p).max() < 1e-9 * (end.m @ np.linalg.norm(end.v, axis=1))
    # what each piece adds to the velocity of its particle goes with its place as velocities do in the whole ball
    r, v = np.linalg.norm(end.x, axis=1), np.linalg.norm(end.v, axis=1)
    slope = (r @ v) / (r @ r)
    rest = end.v - slope * end.x
    assert np.sqrt((rest**2).sum(axis=1).mean()) < 0.25 * v.mean()
    flown = RATE * thermo["f_step[2]"][-1]
    assert slope == pytest.approx(RATE / (1 + flown), rel=0.1)


def test_energy_of_spreading(ball, tmp_path):
    """what pieces gain in kinetic energy they lose in internal energy: that of the ledger does not notice, and both are as computed from rate and size"""
    thermo = ball("thermo 1\nrun 200\n" + DUMP.format("end.dump"), words="every 1").thermo
    kinetic, internal, pieces = (np.array(thermo[name]) for name in ("c_book[1]", "c_book[2]", "f_debris"))
    k = np.argmax(np.diff(pieces))
    gain = kinetic[k + 1] - kinetic[k]
    assert gain > 0 and gain + internal[k + 1] - internal[k] == pytest.approx(0, abs=1e-3 * gain)


@pytest.mark.parametrize("words, most", [("most 2", 2), ("", 3)])
def test_number_of_pieces(ball, tmp_path, words, most):
    """as many to an edge as fragments, by their own size at the rate at which it failed, but no more than asked for"""
    thermo = ball("run 200\n" + DUMP.format("end.dump"), words=words, rate=3e6).thermo
    end = frame(tmp_path / "end.dump")
    number = divided(end)
    assert set(number) <= {n**3 for n in range(1, most + 1)} and number.max() == most**3
    assert end.m.sum() == pytest.approx(MASS * thermo["Atoms"][0], rel=1e-12)


def test_sizes_are_distributed(ball, tmp_path):
    """Grady and Kipp (1985): the share of matter in fragments of less than x times the mean mass is 1 - (1 + x) exp(-x); so many particles are divided into 8, into 27, or stay whole"""
    ball("run 250\n" + DUMP.format("end.dump"), rate=5.5e5)
    end = frame(tmp_path / "end.dump")
    number, size = divided(end), end["c_state[1]"]
    assert (size > 0).all()
    within = [1 - (1 + x) * np.exp(-x) for x in ((EDGE / (edges * size)) ** 3 for edges in (1.5, 2.5))]
    for found, share in ((number > 1, within[0]), (number > 8, within[1])):
        count, expected = (found / number).sum(), (share / number).sum()
        assert abs(count - expected) < 4 * np.sqrt((share * (1 - share) / number).sum())


def test_what_does_not_fail_stays(ball, tmp_path):
    """a ball that hardly opens, and one whose fragments are as large as its particles"""
    for rate in (0, 2e5):
        thermo = ball("run 100\n", rate=rate).thermo
        assert set(thermo["f_debris"]) == {0} and len(set(thermo["Atoms"])) == 1


def test_quarter(ball, tmp_path):
    """between mirror planes: a quarter of the mass, of the pieces, of the energy; nothing beyond a plane"""
    fast = {"words": "most 2", "rate": 2e6}  # fragments so small that all are divided, whatever their IDs
    whole = ball("run 200\n" + DUMP.format("whole.dump"), **fast).thermo
    part = ball("run 200\n" + DUMP.format("part.dump"), quarter=True, **fast).thermo
    one, four = frame(tmp_path / "part.dump"), frame(tmp_path / "whole.dump")
    assert 4 * len(one) == len(four) and 4 * one.m.sum() == pytest.approx(four.m.sum(), rel=1e-12) and one.x[:, :2].min() >= 0
    assert 4 * part["c_book[1]"][-1] == pytest.approx(whole["c_book[1]"][-1], rel=2e-3)
    assert part["c_book[9]"][-1] == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("at, nranks", [(60, 1), (100, 2), (160, 1)])
def test_restart(ball, tmp_path, nranks, at):
    """before, when and after pieces are due: as in a run that is not stopped, but for round-off of what is extrapolated"""
    more = 180 - at
    ball(f"run {at}\nwrite_restart part.restart\n", nranks=nranks)
    ball(f"run {more}\n" + DUMP.format("two.dump"), nranks=nranks, head="units si\natom_modify map array\nread_restart part.restart\nfix masses all property/atom rmass ghost yes\n")
    one = ball(f"run {at + more}\n" + DUMP.format("one.dump"), nranks=nranks).thermo
    assert one["f_debris"][0] < one["f_debris"][-1]
    one, two = frame(tmp_path / "one.dump"), frame(tmp_path / "two.dump")
    assert len(one) == len(two)
    first, second = (f.x[np.lexsort(np.round(f.x, 9).T)] for f in (one, two))  # IDs of pieces go by ranks
    assert np.allclose(first, second, rtol=0, atol=1e-9)


def test_at_faces_and_on_many_ranks(ball):
    """what would be put beyond a fixed face leaves as a whole, and all of it is counted; ranks that are too narrow are an error"""
    head = BALL.format(newton="on", low=-0.1, edge=-0.1, mirror="", rate=RATE).replace("box block -0.1 0.1 -0.1 0.1 -0.1 0.1", "box block -2e-3 2e-3 -4e-3 4e-3 -4e-3 4e-3").replace("x final -0.1 0.1 y final -0.1 0.1", "x final -2e-3 2e-3 y final -4e-3 4e-3")
    thermo = ball("run 200\n", head=head).thermo
    assert thermo["f_debris"][-1] > 0 and abs(np.array(thermo["c_book[9]"]) - 1).max() < 1e-3
    assert thermo["Atoms"][-1] < thermo["Atoms"].max()
    narrow = BALL.format(newton="on", low=-0.1, edge=-0.1, mirror="", rate=RATE).replace("region box", "processors 4 1 1\nregion box") + "balance 1.0 x 0.499 0.5 0.501\n"
    said = ball("run 200\n", nranks=4, head=narrow, expect_fail=True)
    assert "Fix hvi/debris puts pieces up to" in said.log


def test_clamped_stay(ball):
    """particles that another fix holds are not divided, and the energy that clamps are said to give is none"""
    thermo = ball("group rim type 1\nfix rim rim setforce 0 0 0\nuncompute book\ncompute book all hvi/energy clamps rim\nrun 200\n").thermo
    assert set(thermo["f_debris"]) == {0} and abs(np.array(thermo["c_book[9]"]) - 1).max() < 1e-6
