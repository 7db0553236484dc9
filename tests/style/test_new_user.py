"""What users of LAMMPS try on the first day: it works, or what is wrong is said."""

import re

import numpy as np
import pytest
from dumps import read_dump

TARGET = """units si
atom_style sph
atom_modify map array
boundary f f f
region box block -0.01 0.01 -0.01 0.01 -0.01 0.01 units box
create_box 3 box
lattice sc 0.001 origin 0.5 0.5 0.5
region ball sphere 0 0 -0.004 0.002 units box
region wall block -0.006 0.006 -0.006 0.006 0 0.002 units box
create_atoms 1 region ball
create_atoms 2 region wall
group ball type 1
pair_style hvi/sph cubic {words}
pair_coeff 1 1 file Al6061-T6.hvi spacing 0.001
pair_coeff 2 2 file Al6061-T6.hvi spacing 0.001
pair_coeff 3 3 file {third}
velocity ball set 0 0 3000 units box
fix move all hvi/sph
{solid}
fix step all hvi/dt 0.6
compute book all hvi/energy
thermo 10
thermo_style custom step dt atoms c_book[1] c_book[8] c_book[9]
thermo_modify lost error
{more}
run {steps}
"""


@pytest.fixture(autouse=True)
def materials(root, monkeypatch):
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))


COPPER = "Cu-OFHC.hvi spacing 0.001"
COMES = """region aside block -0.0095 -0.0092 -0.006 0.006 0 0.002 units box
fix dep all deposit 6 3 5 4711 region aside near 0.0008 vx 600 600 vy 0 0 vz 0 0 units box
"""


def scene(more="", third=COPPER, words="dissipation riemann", solid="fix solid all hvi/johnson-cook", steps=60):
    return TARGET.format(more=more, third=third, words=words, solid=solid, steps=steps)


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2, 3])
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("words,solid", [("dissipation riemann", True), ("h variable dissipation riemann", True), ("viscosity 1 2", False), ("dissipation riemann", False)])
def test_deposit(lmp, tmp_path, nranks, newton, words, solid):
    """particles of a type that has a spacing come during a run: without pressure, energy or stress, and fly as they were thrown until they strike; energy is off by what they bring"""
    more = COMES + "compute s all hvi/atom p e vm\ndump d all custom 20 d.* id type vx vy vz c_s[*] mass\ndump_modify d sort id format float %.15g\n"
    text = scene(more, words=words, solid="fix solid all hvi/johnson-cook" if solid else "").replace("p e vm", "p e vm" if solid else "p e")
    t = lmp(f"newton {newton}\n" + text, cwd=tmp_path, nranks=nranks).thermo
    assert t["Atoms"][-1] == t["Atoms"][0] + 6
    new = {step: rows[rows[:, 1] == 3] for step in (20, 60) for rows in [read_dump(tmp_path / f"d.{step}").table]}
    assert len(new[20]) == 4  # at steps 1, 6, 11, 16
    assert np.allclose(new[20][:, 2:5], [600.0, 0, 0], rtol=1e-12, atol=1e-9)
    assert np.all(np.abs(new[20][:, 5:-1]) < 1e-3)
    assert new[60][:, 2].min() < 590 and np.abs(new[60][:, 5]).max() > 1e7  # some have struck the wall
    assert np.allclose(new[20][:, -1], 8.93e-6, rtol=1e-12)  # their mass
    brought = 6 * 0.5 * new[20][0, -1] * 600.0**2
    assert t["c_book[8]"][-1] == pytest.approx(t["c_book[8]"][0] + brought, rel=2e-3)


@pytest.mark.parametrize("nranks", [1, 2])
def test_deposit_with_masses_of_particles(lmp, tmp_path, nranks):
    """as fix hvi/fem needs them: that of the type, not what was in its place"""
    text = scene(COMES + "dump d all custom 20 d.* id type mass\ndump_modify d sort id\n").replace("create_atoms 1", "fix m all property/atom rmass ghost yes\ncreate_atoms 1")
    text = text.replace("fix move", "set type 1*2 mass 2.7e-6\nfix move")
    lmp(text, cwd=tmp_path, nranks=nranks)
    rows = read_dump(tmp_path / "d.60").table
    assert (rows[:, 1] == 3).sum() == 6 and np.allclose(rows[rows[:, 1] == 3, 2], 8.93e-6, rtol=1e-5)


@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_deposit_in_parts(lmp, tmp_path, nranks):
    """two runs, and a run from a restart file, end as one run does: energies, and what belongs to which body"""
    tail = "compute b all hvi/atom body\nthermo 10\nthermo_style custom step c_book[1] c_book[2]\n"
    last = "write_dump all custom {} id type x vx c_b modify sort id format float %.17g\n"
    solid = "fix solid all hvi/johnson-cook damage yes spall voids"
    text = scene(COMES.replace("deposit 6 3 5 4711", "deposit 6 3 2 4711") + tail, solid=solid)
    fixes = "".join(line + "\n" for line in text.splitlines() if line.startswith(("fix", "compute", "thermo", "region aside", "pair_"))).replace("thermo_style custom step dt atoms c_book[1] c_book[8] c_book[9]\n", "")
    lmp(text.replace("run 60", "run 60\n" + last.format("one")), cwd=tmp_path, nranks=nranks)
    lmp(text.replace("run 60", "run 30\nwrite_restart half\nrun 30\n" + last.format("two")), cwd=tmp_path, nranks=nranks)
    lmp("read_restart half\n" + fixes + "run 30\n" + last.format("three"), cwd=tmp_path, nranks=nranks)
    one, two, three = (read_dump(tmp_path / name).table for name in ("one", "two", "three"))
    assert len(one) == len(two) == len(three) and (one[:, 1] == 3).sum() == 6 and len(set(one[one[:, 1] == 3, 4])) == 6
    for other in (two, three):
        assert np.array_equal(one[:, 4], other[:, 4])
        assert np.allclose(one[:, 2], other[:, 2], rtol=0, atol=1e-9) and np.allclose(one[:, 3], other[:, 3], rtol=0, atol=1e-3)


def test_bodies_of_what_comes(lmp, tmp_path):
    """what comes in different steps are different bodies, until they are looked at"""
    lmp(scene(COMES + "compute b all hvi/atom body\ndump d all custom 60 d.* id type c_b\ndump_modify d sort id format float %.17g\n", solid="fix solid all hvi/johnson-cook damage yes spall voids"), cwd=tmp_path)
    rows = read_dump(tmp_path / "d.60").table
    assert len(set(rows[rows[:, 1] == 3, 2])) == 6 and len(set(rows[rows[:, 1] != 3, 2])) == 2


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("groups,wrong", [("fix move old hvi/sph\nfix solid all", "has no density at step 1"), ("fix move all hvi/sph\nfix solid old", "a solid, comes at step 1 and is not in group old")])
def test_deposit_outside_of_groups(lmp, groups, wrong, nranks):
    text = scene(COMES).replace("fix move all hvi/sph\nfix solid all", "group old type 1 2\n" + groups)
    assert wrong in " ".join(lmp(text, nranks=nranks, expect_fail=True).error.split())


def test_deposit_without_a_density(lmp):
    r = lmp(scene(COMES, third="Cu-OFHC.hvi h 0.0012\nmass 3 9e-6"), expect_fail=True)
    assert re.search(r"particle \d+ \(type 3\) has no density at step 1: .*spacing or volume", " ".join(r.error.split()))


def warnings(result, of):
    return [line for line in (result.stdout + result.log).splitlines() if "WARNING" in line and of in line]


WITHOUT = "Al6061-T6.hvi spacing 0.001\nset atom 1 type 3"  # a type with its own material that has a particle


def test_nothing_is_warned_of_otherwise(lmp):
    r = lmp(scene(third=WITHOUT))
    assert warnings(r, "no particles") == warnings(r, "Compute hvi/energy") == []
    r = lmp(scene(third=WITHOUT) + "delete_atoms group ball\nvelocity all set 0 0 10\nrun 20\n")  # what a command does between runs is no drift
    assert warnings(r, "no particles") == warnings(r, "Compute hvi/energy") == []
    r = lmp(scene(COMES))
    assert warnings(r, "no particles") == []


@pytest.mark.parametrize("nranks", [1, 2])
def test_type_without_particles(lmp, nranks):
    said = set(warnings(lmp(scene(), nranks=nranks), "no particles"))
    assert len(said) == 1 and re.search("there are no particles of type 3, which has material Cu-OFHC.hvi: .* units box", said.pop())
    meters = scene(third=WITHOUT.partition("\n")[0]).replace("0.002 units box\nregion wall", "0.002\nregion wall").replace("velocity ball", "#")
    assert "there are no particles of type 1" in warnings(lmp(meters, nranks=nranks), "no particles")[0]


@pytest.mark.each_value
@pytest.mark.parametrize("line,wrong", [("fix n all nve", "Fix n (nve) moves 320 particles that fix hvi/sph moves, too"), ("fix n ball nve", "Fix n (nve) moves 32 particles"),
                                        ("fix n ball move linear 0 0 1", "Fix n (move) moves 32 particles")])
@pytest.mark.parametrize("nranks", [1, 2])
def test_two_integrators(lmp, line, wrong, nranks):
    assert wrong in " ".join(lmp(scene(line, WITHOUT), nranks=nranks, expect_fail=True).error.split())


def test_another_integrator_of_other_particles(lmp):
    text = scene("fix n ball nve", WITHOUT).replace("fix move all hvi/sph", "group rest type 2 3\nfix move rest hvi/sph").replace("velocity ball", "group ball clear\ngroup ball type 1\nvelocity ball")
    assert lmp(text).thermo["Step"][-1] == 60


@pytest.mark.parametrize("nranks", [1, 2])
def test_energy_that_another_fix_takes(lmp, nranks):
    """once, whatever follows"""
    said = set(warnings(lmp(scene("fix n all langevin 300 300 1e-6 4711", WITHOUT), nranks=nranks), "Compute hvi/energy"))
    assert len(said) == 1 and re.search(r"Compute hvi/energy: 0\.\d+ of the energy has gone during runs, up to step \d+: does another fix do work", said.pop())


def test_energy_that_goes_slowly_over_many_runs(lmp):
    """less than a hundredth of it in each run, which none of them would tell by itself"""
    (said,) = set(warnings(lmp(scene("thermo 5\nfix n all langevin 300 300 3e-4 4711", WITHOUT, steps=5) + 9 * "run 5\n"), "Compute hvi/energy"))
    gone, step = re.search(r"Compute hvi/energy: (0\.\d+) of the energy has gone during runs, up to step (\d+):", said).groups()
    assert 0.01 < float(gone) < 0.015 and int(step) >= 20, said


@pytest.mark.parametrize("nranks", [1, 2])
def test_smoothing_length_of_other_units(lmp, nranks):
    text = scene(third="Al6061-T6.hvi spacing 0.001\nset atom 1 type 3").replace("pair_coeff 1 1 file Al6061-T6.hvi spacing 0.001", "pair_coeff 1 1 file Al6061-T6.hvi h 1.2 volume 1e-9")
    grown = text.replace("create_atoms 2 region wall", "create_atoms 2 region wall\nregion more block -0.0099 0.0099 -0.0099 0.0099 0.003 0.0099 units box\ncreate_atoms 2 region more")
    found = " ".join(lmp(grown, nranks=nranks, expect_fail=True).error.split())
    assert re.search(r"particle \d+ \(type \d\) has \d{4} neighbors within reach and skin at step 0, more than the 2000 that neigh_modify one allows: is a smoothing length of 1.2 that of its spacing", found), found


def test_laws_that_there_are(lmp):
    said = lmp(scene(third=WITHOUT, solid="fix solid all hvi/johnson-cook strength zerilli-armstrong"), expect_fail=True).error
    assert "(there are: johnson-cook of Al6061-T6.hvi, steinberg-guinan of Al6061-T6.hvi)" in " ".join(said.split())


@pytest.mark.parametrize("nranks", [1, 2])
def test_how_a_data_file_is_read_is_said(lmp, tmp_path, nranks):
    """what write_data prints is what read_data needs"""
    fixes = "fix move all hvi/sph\nfix solid all hvi/johnson-cook"
    r = lmp(scene(third=WITHOUT, steps=20) + "write_data end.data\n", cwd=tmp_path, nranks=nranks)
    clauses = re.findall(r"^  section \S+: for read_data, (fix \S+ NULL \S+)$", r.log, re.M)
    assert len(clauses) == 5
    text = f"""units si
atom_style sph
atom_modify map array
boundary f f f
region small block 0 0.001 0 0.001 0 0.001 units box
create_box 3 small
{fixes}
read_data end.data add merge {' '.join(clauses)}
pair_style hvi/sph cubic dissipation riemann
pair_coeff * * file Al6061-T6.hvi spacing 0.001
run 0
"""
    assert lmp(text, cwd=tmp_path, nranks=nranks).thermo["Step"][-1] == 0
