"""Cases that once went wrong in silence: particles in one place, two bonds on a pair, commands repeated between runs."""

import numpy as np
import pytest
from dumps import read_dump
from scenes import BONDS, KAPPA, PAIR, R_EQ, State, books, cube, ledger, read_bonds, scene

BOX = [[-8.0, 8.0]] * 3
STEP = "fix nve all nve\nfix step all hvi/dt 0.1\nthermo 1\nthermo_style custom step time dt\nthermo_modify norm no format float %.16e\n"


@pytest.mark.parametrize("nranks", [1, 2])
def test_same_place(lmp, nranks):
    """two particles in one place: an error that names them, with or without fix hvi/dt"""
    s = State([[0, 0, 0], [3, 0, 0], [3, 0, 0]], 0.0, [], BOX)
    result = lmp(scene(s, "s.data") + "fix nve all nve\nrun 10\n", nranks=nranks, expect_fail=True)
    assert "at the same place" in result.error and "2" in result.error and "3" in result.error


def test_two_bonds_on_a_pair(lmp, tmp_path):
    """the one that is too long breaks, the other holds, none comes back at a rebuild"""
    s = State([[-0.6, 0, 0], [0.6, 0, 0]], [[-2.0, 0, 0], [2.0, 0, 0]], [(0, 1), (0, 1)], BOX, bond_types=[1, 2])
    bond = f"bond_style hvi/spring\nbond_coeff 1 {KAPPA} {R_EQ!r} 3.0\nbond_coeff 2 {2 * KAPPA} {R_EQ!r} 1.3\n"
    text = scene(s, "s.data", bond=bond) + "fix nve all nve\n" + ledger() + "compute T all property/local btype\ntimestep 0.001\n"
    result = lmp(text + "run 400\nwrite_dump all local types c_T\n")
    book = books(result.thermo)
    assert book["bonds_broken"][-1] == 1 and result.thermo["Bonds"][-1] == 1
    assert int((tmp_path / "types").read_text().split()[-1]) == 1
    assert book["broken"][-1] == pytest.approx(0.5 * 2 * KAPPA * (1.3 - R_EQ) ** 2, rel=0.05)


def test_create_bonds_again(lmp, tmp_path):
    """bonds that are there are not made twice, though runs free the lists that tell"""
    s = cube(3, 0.02, 0.0)
    again = "special_bonds lj/coul 0 1 1\ncreate_bonds many all all 1 0.0 1.4\nspecial_bonds lj/coul 1 1 1\n"
    result = lmp(scene(s, "s.data") + "fix nve all nve\nthermo_style custom step bonds\nrun 1\n" + again + "run 1\n" + again + "run 1\n" + BONDS.format("b"))
    assert [t["Bonds"][-1] for t in result.runs] == [len(s.bonds)] * 3
    assert len(read_bonds(tmp_path / "b")) == len(s.bonds)


def test_two_contacts_in_a_hybrid(lmp):
    """fix hvi/dt hears every hvi/contact of a hybrid"""
    s = State([[0, 0, 0], [0.95, 0, 0], [5, 0, 0], [5.95, 0, 0]], 0.0, [], BOX, types=[1, 1, 2, 2], masses=(1.0, 1.0))
    dt = {}
    for name, pair in (("plain", PAIR.replace("* * 1.0", "* * 4.0")),
                       ("hybrid", "pair_style hybrid hvi/contact hvi/contact prefactor 4\npair_coeff 1 * hvi/contact 1 1.0 1.0\npair_coeff 2 2 hvi/contact 2 1.0 1.0\n")):
        dt[name] = lmp(scene(s, "s.data", pair=pair) + STEP + "run 0\n").thermo["Dt"][0]
    assert dt["hybrid"] == pytest.approx(dt["plain"], rel=1e-12)


def test_run_in_pieces(lmp):
    """a run cut in pieces takes the steps of the whole one"""
    s = cube(4, 0.04, 3.0)
    whole = lmp(scene(s, "s.data") + STEP + "run 300\n").thermo
    pieces = lmp(scene(s, "s.data") + STEP + "run 300 every 10 NULL\n").runs
    assert len(pieces) == 1 or len(pieces) == 30
    assert pieces[-1]["Time"][-1] == pytest.approx(whole["Time"][-1], rel=0.02)


def test_clock_turned_back(lmp):
    """reset_timestep after read_restart does not freeze time"""
    s = cube(3, 0.02, 0.1)
    lmp(scene(s, "s.data") + STEP + "run 3000\nwrite_restart r\n")
    text = "read_restart r\nreset_timestep 0\nneighbor 0.3 bin\n" + STEP + "run 50\n"
    t = lmp(text).thermo
    assert t["Dt"].min() > 1e-3


def test_clamps_forgotten(lmp):
    """a new compute hvi/energy without clamps books none"""
    s = cube(3, 0.02, 0.1)
    text = scene(s, "s.data") + "group held id 1:9\n" + ledger("clamps held") + "uncompute book\n" + ledger()
    book = books(lmp(text + "fix nve all nve\nfix c held setforce 0 0 0\ntimestep 1e-3\nrun 50\n").thermo)
    assert np.all(book["clamps"] == 0) and np.all(book["jx"] == 0)


def test_gas_without_energy(lmp):
    """stays where it is: its speed of sound, not quite zero, has a square with an inverse on any scale of length"""
    r = lmp("""units si
atom_style sph
lattice sc 1e-4
region b block 0 6 0 6 0 6
create_box 1 b
create_atoms 1 box
mass 1 1e-12
set group all sph/rho 1
pair_style hvi/sph cubic dissipation riemann
pair_coeff 1 1 eos idealgas 1.4 h 1.2e-4
fix move all hvi/sph
fix step all hvi/dt 0.2 max 1e-3
neighbor 1e-5 bin
run 3
write_dump all custom end vx vy vz modify format float %.17g
""")
    assert not read_dump(r.cwd / "end").table.any()
