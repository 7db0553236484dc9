"""Universes of hvi.open(): all columns, particles that leave and come, bonds, MDAnalysis's own ways of opening and copying."""

import pickle

import hvi
import numpy as np
import pytest
from hvi.io.data import DataFile
from scenes import cube, scene


def pairs(bonds):
    return {tuple(sorted(pair)) for pair in np.asarray(bonds).tolist()}


@pytest.fixture
def leaving(lmp, tmp_path):
    """a cube that flies apart in a box with fixed faces; bonds in both forms; columns of all kinds"""
    s = cube(5, speed=4.0, cut=0.6, margin=1.0, types=2)
    lmp(scene(s, "s.data") + """thermo_modify lost ignore
fix nve all nve
timestep 0.002
variable B2 atom id
compute frag all hvi/fragment/atom bonds
dump c all custom 50 c.dump id type x y z vx vy vz fx fy fz c_frag v_B2
dump_modify c format float %.17g
dump b all local 50 b.dump index c_B[1] c_B[2]
dump g all custom 50 g.dump id type x y z c_frag
dump_modify g thresh x > 3.0
run 400
write_data end.data
""")
    return tmp_path


def test_universe(leaving):
    u = hvi.open(leaving / "c.dump", data=leaving / "s.data", bonds=leaving / "b.dump", mirror="none")  # a cube that ends near 0
    dump = hvi.Dump(leaving / "c.dump", mirror="none")
    sizes = [h.n for h in dump.headers]
    assert sizes[0] == 125 == len(u.atoms) and sizes[-1] < 115 and len(u.trajectory) == 9
    assert set(u.atoms.types) == {"1", "2"} and set(u.atoms.masses) == {1.0, 1.5}
    counts = []
    for k, ts in enumerate(u.trajectory):
        frame = dump[k]
        here = u.atoms.present
        assert ts.frame == k and ts.data["step"] == 50 * k and here.sum() == sizes[k]
        assert np.array_equal(u.atoms.ids[here], frame.ids), k
        assert np.array_equal(u.atoms.c_frag[here], frame["c_frag"]) and np.isnan(u.atoms.c_frag[~here]).all(), k
        assert np.array_equal(u.atoms.v_B2[here], frame.ids), k
        assert u.atoms.positions[here] == pytest.approx(frame.x, rel=1e-6) and np.isnan(u.atoms.positions[~here]).all(), k
        assert u.atoms.velocities[here] == pytest.approx(frame.v, rel=1e-6), k
        assert u.atoms.forces[here, 1] == pytest.approx(frame["fy"], rel=1e-6), k
        assert ts.dimensions is None  # not periodic
        found = hvi.find(u)  # by the bonds of this frame
        assert np.array_equal(found.label, frame["c_frag"]), k
        counts.append(found.summary["fragments"])
    assert counts[-1] > counts[0] > 1
    u.trajectory[3]
    half = u.atoms[u.atoms.present & (u.atoms.x > 3.0)]
    assert np.array_equal(hvi.find(half).frame.ids, half.ids)
    assert hvi.measure(half, "z", 0.0)["particles"] == np.sum(half.z > 0.0)


def test_universe_copies(leaving):
    u = hvi.open(str(leaving / "c.dump"), data=str(leaving / "s.data"))
    u.trajectory[4]
    for other in (u.copy(), pickle.loads(pickle.dumps(u))):
        assert other.trajectory.ts.frame == 4
        other.trajectory[7]
        assert np.array_equal(other.atoms.present, np.isin(u.atoms.ids, hvi.Dump(leaving / "c.dump")[7].ids))
        assert u.trajectory.ts.frame == 4


def test_topology_bonds(leaving):
    """the bonds of the first frame, from either source; those of another moment are used for no fragments"""
    first = hvi.open(leaving / "c.dump", bonds=leaving / "b.dump")
    start = DataFile(leaving / "s.data").bonds
    assert pairs(first.atoms.ids[first.bonds.indices]) == pairs(start)
    assert len(hvi.open(leaving / "c.dump", data=leaving / "s.data").bonds) == len(start)
    u = hvi.open(leaving / "c.dump", data=leaving / "end.data", mirror="none")
    assert len(u.atoms) == 125 and 0 < len(u.bonds) == len(DataFile(leaving / "end.data").bonds) < len(start)
    u.trajectory[-1]
    assert np.array_equal(hvi.find(u).label, u.trajectory.raw["c_frag"])
    u.trajectory[0]
    with pytest.raises(hvi.HVIError, match="those of step 400, not of step 0: dump the bonds"):
        hvi.find(u)


def test_particles_that_come(leaving):
    """a dump with a threshold: particles come and go"""
    u = hvi.open(leaving / "g.dump")
    with pytest.raises(hvi.HVIError, match='is not in the topology: use hvi.open.*atoms="all"'):
        for _ in u.trajectory:
            pass
    u = hvi.open(leaving / "g.dump", atoms="all")
    seen = set()
    for k, ts in enumerate(u.trajectory):
        ids = hvi.Dump(leaving / "g.dump")[k].ids
        assert np.array_equal(u.atoms.ids[u.atoms.present], ids), k
        seen.update(ids.tolist())
    assert seen == set(u.atoms.ids) and len(seen) < 125
    u = hvi.open(leaving / "g.dump", data=leaving / "s.data")  # which knows them all
    types = DataFile(leaving / "s.data").atoms[1]
    assert np.array_equal(u.atoms.types, types.astype(str)) and [ts.data["present"].sum() for ts in u.trajectory] == [
        h.n for h in hvi.Dump(leaving / "g.dump").headers]


def test_registered_format(leaving):
    """MDAnalysis finds the reader by its format, with its own topology too"""
    import hvi.io.universe  # noqa: F401
    import MDAnalysis

    path = str(leaving / "c.dump")
    u = MDAnalysis.Universe(path, format="LAMMPSHVI", topology_format="LAMMPSHVI")
    assert len(u.trajectory) == 9 and np.array_equal(u.trajectory[2].data["c_frag"][u.trajectory.ts.data["present"]],
                                                     hvi.Dump(path)[2]["c_frag"])
    v = MDAnalysis.Universe(str(leaving / "s.data"), path, atom_style="id resid type x y z", format="LAMMPSHVI")
    assert v.trajectory[5].positions[v.trajectory.ts.data["present"]] == pytest.approx(hvi.Dump(path)[5].x, rel=1e-6)


def test_periodic_cell(lmp, tmp_path):
    text = scene(cube(3, periodic=True), "s.data").replace(
        "read_data s.data\n", "read_data s.data\nchange_box all triclinic xy final 0.9 xz final -1.1 yz final 0.7 remap\n")
    lmp(text + "dump 1 all custom 1 a.dump id type x y z\nrun 0\n")
    u = hvi.open(tmp_path / "a.dump")
    from MDAnalysis.lib.mdamath import triclinic_vectors

    assert triclinic_vectors(u.dimensions) == pytest.approx(u.trajectory.raw.box.vectors, abs=1e-5)
