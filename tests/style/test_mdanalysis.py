"""MDAnalysis reads what a run leaves behind: data file and dump, with the bonds that are still there."""

import numpy as np
import pytest
from dumps import read_dump
from scenes import BONDS, collision, ledger, read_bonds, scene

MDAnalysis = pytest.importorskip("MDAnalysis")


@pytest.fixture
def files(lmp, tmp_path):
    s = collision(4)
    text = scene(s, "s.data") + "fix nve all nve\ntimestep 0.0005\n" + ledger(every=100)
    text += "dump d all custom 250 traj.lammpsdump id type x y z vx vy vz\ndump_modify d sort id format float %.17g\nrun 1500\n"
    text += "write_data final.data\n" + BONDS.format("bonds")
    result = lmp(text)
    bonds = read_bonds(tmp_path / "bonds")
    assert 0 < len(bonds) < len(s.bonds) == result.thermo["Bonds"][0]
    return tmp_path, bonds


def pairs(universe):
    return {tuple(sorted(int(i) for i in universe.atoms[list(bond)].ids)) for bond in universe.bonds.indices}


def test_data_file(files):
    """topology, positions, velocities and masses; broken bonds are not in it"""
    folder, bonds = files
    u = MDAnalysis.Universe(str(folder / "final.data"), atom_style="id resid type x y z")
    assert len(u.atoms) == 128 and pairs(u) == bonds
    last = read_dump(folder / "traj.lammpsdump")
    order = np.argsort(u.atoms.ids)
    assert u.atoms.positions[order, 0] == pytest.approx(last["x"], abs=1e-5)
    v = u.atoms.velocities[order, 2]  # in MDAnalysis's units
    assert v / np.abs(v).max() == pytest.approx(last["vz"] / np.abs(last["vz"]).max(), abs=1e-5)
    assert np.all(u.atoms.masses == 1.0)


def test_trajectory(files):
    """the dump on top of the data file: every frame, bonds at hand"""
    folder, bonds = files
    u = MDAnalysis.Universe(str(folder / "final.data"), str(folder / "traj.lammpsdump"), atom_style="id resid type x y z",
                            format="LAMMPSDUMP", lammps_coordinate_convention="unscaled")
    assert len(u.trajectory) == 7
    u.trajectory[-1]
    lengths = u.bonds.values()
    assert len(lengths) == len(bonds) and lengths.max() <= 1.5 * (1 + 1e-5)
    fragments = u.atoms.fragments
    assert len(fragments) > 1 and sum(len(f) for f in fragments) == 128
