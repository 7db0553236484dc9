"""Particles that no equation of state answers for: an error, or frozen and counted. Density that falls fast stays above 0, and limits the step."""

import numpy as np
import pytest
from solid_runs import material

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


@pytest.mark.each_value
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


SOLID = """newton {newton}
units si
atom_style sph
atom_modify map yes
boundary s s s
lattice sc 1e-3 origin 0.5 0.5 0.5
region box block -8 8 -8 8 -14 14
create_box 1 box
region lower block -3 3 -3 3 -6 0
region upper block -3 3 -3 3 0 6
create_atoms 1 region lower
create_atoms 1 region upper
mass * 2.703e-6
set group all sph/rho 2703.0
group upper region upper
velocity upper set 0 0 {v} units box
pair_style hvi/sph cubic {pair}
pair_coeff * * file steep.hvi h 1.3e-3
fix move all hvi/sph bad freeze 400
fix solid all hvi/johnson-cook damage no spall none {words}
fix step all hvi/dt 0.3 floor 0
neighbor 0.3e-3 bin
compute book all hvi/energy
compute s all hvi/atom eps sxx
compute e all sph/e/atom
compute rho all sph/rho/atom
thermo 1
thermo_style custom step dt c_book[8] c_book[10] c_book[11] c_book[12] c_book[32] c_book[9]
thermo_modify format float %.15g
"""
STEEP = "eos gruneisen rho0 2703 C 5240 S1 8 g0 1.97 cp 885 T0 300"
STRENGTHS = {"strength perfect": "strength perfect G 27.6e9 Y 0.3e9",
             "strength steinberg-guinan thermal no": "strength steinberg-guinan G0 27.6e9 Y0 0.29e9 Ymax 0.68e9 beta 125 n 0.1 A 6.52e-11 B 6.16e-4 Tm0 1220 g0 1.97 a 1.5"}


@pytest.mark.each_value
@pytest.mark.parametrize("pair", ["viscosity 1 2", "dissipation riemann artstress 0.3 4"])
@pytest.mark.parametrize("words", STRENGTHS)
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (2, "off")])
def test_frozen_in_a_solid(lmp, tmp_path, words, nranks, newton, pair):
    """from the start, and when density passes the pole of the law: books are closed, nothing is NaN"""
    material(tmp_path / "steep.hvi", STEEP, STRENGTHS[words], units="si")
    for v, number, steps in ((-100.0, 1, 40), (-30000.0, 4, 12)):
        text = SOLID.format(newton=newton, v=v, pair=pair, words=words)
        bad = BAD.format(43) if number == 1 else ""
        r = lmp(text + bad + f"run {steps}\n" + OUT.replace("c_rho c_e", "c_rho c_e c_s[*]").format(tmp_path / "frozen") + "write_data frozen.data\n", nranks=nranks)
        t = r.thermo
        assert "nan" not in (tmp_path / "frozen.data").read_text()
        frozen = rows(tmp_path / "frozen")
        assert np.isfinite(frozen).all() and all(np.isfinite(column).all() for column in t.values())
        count = (frozen[:, 7] == 0.0).sum()
        assert t["c_book[32]"][-1] == count >= number
        most = 2.703e-6 * 216 * abs(v)
        for k in (10, 11, 12):
            assert np.abs(t[f"c_book[{k}]"] - t[f"c_book[{k}]"][0]).max() < 1e-12 * most
        if number == 1:  # the leapfrog's own error in the first step of a contact, with or without that particle
            assert np.abs(t["c_book[8]"] - t["c_book[8]"][0]).max() < 1e-3 * 0.5 * most * abs(v)
