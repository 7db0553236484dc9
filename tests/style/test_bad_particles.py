"""Particles that no equation of state answers for: an error, or frozen and counted. Density that falls fast stays above 0, and limits the step."""

import numpy as np
import pytest

N = 6
GAS = """units lj
atom_style sph
atom_modify map array
boundary p p p
lattice sc 1.0 origin 0.5 0.5 0.5
region box block 0 {n} 0 {n} 0 {n}
create_box 1 box
create_atoms 1 box
mass 1 1.0
set group all sph/rho 1.0 sph/e 2.5
set group all x 0.5
velocity all create 0.01 7
pair_style hvi/sph cubic {pair}
pair_coeff 1 1 eos idealgas 1.4 h 1.2
neighbor 0.3 bin
fix move all hvi/sph {words}
compute book all hvi/energy
compute e all sph/e/atom
compute rho all sph/rho/atom
thermo 1
thermo_style custom step dt c_book[2] c_book[8] c_book[10] c_book[11] c_book[12] c_book[19] c_book[24] c_book[25] c_book[26] c_book[32]
thermo_modify format float %.15g
timestep 0.05
""".replace("set group all x 0.5\n", "")
BAD = "set atom {} sph/rho -1.0\n"
OUT = "write_dump all custom {} id x y z vx vy vz c_rho c_e modify sort id format float %.17g\n"


def gas(words="", pair="viscosity 1 2"):
    return GAS.format(n=N, words=words, pair=pair)


def rows(path):
    return np.loadtxt(path.read_text().split("ITEM: ATOMS")[1].splitlines()[1:])


def test_is_an_error(lmp):
    r = lmp(gas() + BAD.format(43) + "run 2\n", expect_fail=True)
    assert "equation of state idealgas of particle 43 (type 1) has no answer at density -1 and energy per mass 2.5" in r.stdout


@pytest.mark.parametrize("pair", ["viscosity 1 2", "dissipation riemann"])
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (2, "off")])
def test_frozen(lmp, tmp_path, nranks, newton, pair):
    """it goes on with its velocity and energy, and pushes nothing: the others move as if it were not there; momentum, mass and energy are closed"""
    text = f"newton {newton}\n" + gas("bad freeze 1", pair)
    r = lmp(text + BAD.format(43) + "run 20\n" + OUT.format(tmp_path / "frozen"), nranks=nranks)
    assert "Fix hvi/sph: no equation of state answers for particle 43 (type 1) at step 0" in r.stdout
    t = r.thermo
    assert (np.array(t["c_book[32]"]) == 1).all() and (np.array(t["c_book[19]"]) == N**3).all()
    for now, start in ((10, 24), (11, 25), (12, 26)):
        assert np.abs(np.array(t[f"c_book[{now}]"]) - t[f"c_book[{start}]"][0]).max() < 1e-12 * N**3
    other = lmp(text + "group bad id 43\ndelete_atoms group bad compress no\nrun 20\n" + OUT.format(tmp_path / "without"), nranks=nranks)
    drift, alone = (np.array(run["c_book[8]"]) - run["c_book[8]"][0] for run in (t, other.thermo))
    np.testing.assert_allclose(drift, alone, rtol=0, atol=1e-10)
    frozen, without = rows(tmp_path / "frozen"), rows(tmp_path / "without")
    bad = frozen[:, 0] == 43
    assert frozen[bad, 7] == 0 and frozen[bad, 8] == 2.5
    np.testing.assert_allclose(frozen[~bad], without, rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("nranks", [1, 2])
def test_deleted(lmp, tmp_path, nranks):
    """it is taken out with the next lists and booked as what leaves; where losing particles is an error, too"""
    text = gas("bad delete 1").replace("neighbor 0.3 bin", "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check no").replace("c_book[32]", "c_book[32] c_book[20] c_book[21] atoms").replace(
        "hvi/sph bad", "hvi/sph lists displacement bad")
    r = lmp(text + BAD.format(43) + "run 20\n" + OUT.format(tmp_path / "deleted"), nranks=nranks)
    t = r.thermo
    assert [t[name][-1] for name in ("c_book[32]", "c_book[19]", "c_book[20]", "c_book[21]", "Atoms")] == [1, N**3 - 1, 1, 1, N**3 - 1]
    lmp(text + "group bad id 43\ndelete_atoms group bad compress no\nrun 20\n" + OUT.format(tmp_path / "without"), nranks=nranks)
    np.testing.assert_allclose(rows(tmp_path / "deleted"), rows(tmp_path / "without"), rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("nranks", [1, 2])
def test_more_than_allowed(lmp, nranks):
    r = lmp(gas("bad freeze 2") + "".join(BAD.format(i) for i in (5, 43, 170)) + "run 20\n", nranks=nranks, expect_fail=True)
    assert "3 particles take no part any more at step" in r.stdout and "more than the 2 that bad allows" in r.stdout


def test_restart(lmp, tmp_path):
    """it stays frozen, with the same count"""
    lmp(gas("bad freeze 1") + BAD.format(43) + f"run 5\nwrite_restart {tmp_path}/r\nrun 5\n" + OUT.format(tmp_path / "one"))
    again = gas("bad freeze 1")
    head = f"read_restart {tmp_path}/r\n" + again[again.index("pair_style"):]
    r = lmp(head + "run 5\n" + OUT.format(tmp_path / "two"))
    assert set(r.thermo["c_book[32]"]) == {1.0}
    one, two = rows(tmp_path / "one"), rows(tmp_path / "two")
    np.testing.assert_allclose(one, two, rtol=1e-11, atol=1e-12)
    assert two[two[:, 0] == 43, 7] == 0


def test_density_of_nothing_is_an_error(lmp):
    """a density that was never given is no frozen particle"""
    r = lmp(gas("bad freeze 1").replace("sph/rho 1.0 ", "") + "run 2\n", expect_fail=True)
    assert "has no density at step 0" in r.stdout


@pytest.mark.parametrize("pair", ["viscosity 1 2", "dissipation riemann"])
def test_fast_expansion(lmp, tmp_path, pair):
    """a step in which density falls by its rate to less than nothing: dt div v = 1.8; exp(-1.8) is what is left of it"""
    text = gas(pair=pair).replace("boundary p p p", "boundary s s s").replace("velocity all create 0.01 7", "velocity all ramp vx -3.6 3.6 x 0 6 units box\n"
                                  "velocity all ramp vy -3.6 3.6 y 0 6 units box\nvelocity all ramp vz -3.6 3.6 z 0 6 units box").replace("timestep 0.05", "timestep 0.5")
    lmp(text + "run 1\n" + OUT.format(tmp_path / "d"))
    rho = rows(tmp_path / "d")[:, 7]
    assert (rho > 0).all() and rho.min() < 0.3


def test_limits_the_step(lmp):
    """with fix hvi/dt density changes by no more than half in a step, where sound would let it: cold gas"""
    text = gas().replace("boundary p p p", "boundary s s s").replace("sph/e 2.5", "sph/e 2.5e-9").replace(
        "velocity all create 0.01 7", "velocity all ramp vx -3 3 x 0 6 units box\nvelocity all ramp vy -3 3 y 0 6 units box\nvelocity all ramp vz -3 3 z 0 6 units box")
    r = lmp(text + "fix step all hvi/dt 0.9\nthermo_style custom step dt\nrun 5\n")
    assert max(r.thermo["Dt"]) <= 0.5 / 3.0 * 1.01 * 1.2 and min(r.thermo["Dt"]) > 0
