"""python/hvi and LAMMPS's computes give the same numbers on the same frames: fragments, cloud, per-atom IDs."""

import re
import sys

import hvi
import numpy as np
import pytest
import yaml
from hvi.analysis.cloud import MEASURES
from hvi.analysis.distribution import cumulative
from hvi.analysis.fragments import ROW
from scenes import cube, impact, scene

PLANE = 0.425 * 9.53e-3
REACH = 1.1e-3
CLOSE = 1e-10
SUMMARY = ("fragments", "particles", "fragmentation", "largest_fragment_mass_fraction", "single_particles_mass")

# compute hvi/fragment in four ways, each with its vector in thermo and its rows in a dump
WAYS = {"all": "bonds", "cloud": "bonds region beyond", "close": f"distance {REACH}",
        "closecloud": f"distance {REACH} region beyond"}


def looks(steps):
    """input: every measure in every form, every so many steps"""
    text = f"""
comm_modify cutoff 3e-3
region beyond block INF INF INF INF {PLANE} INF units box
compute bonds all hvi/fragment/atom bonds
compute near all hvi/fragment/atom distance {REACH}
compute c all hvi/cloud axis z plane {PLANE}
compute d all hvi/cloud axis z plane {PLANE} quantile 0.9
compute y all hvi/cloud axis y plane 0.0 quantile 1
dump atoms all custom {steps} atoms.dump id type x y z vx vy vz c_bonds c_near
dump_modify atoms format float %.17g time yes units yes
dump bonds all local {steps} bonds.dump index c_B[1] c_B[2]
thermo {steps}
thermo_modify lost ignore
"""
    for name, way in WAYS.items():
        text += f"compute {name} all hvi/fragment {way}\ndump {name} all local {steps} {name}.rows c_{name}[*]\n"
        text += f"dump_modify {name} format float %.17g\n"
    return text + f"""thermo_style custom step time c_c[*] c_d[*] c_y[*] {' '.join(f'c_{name}[*]' for name in WAYS)}
thermo_modify format float %.17g lost ignore
run 3000
write_data end.data
"""


@pytest.fixture(scope="module")
def cache():
    return {}


@pytest.fixture
def run(lmp, tmp_path_factory, cache):
    """(folder, thermo) of one impact, run once; the plate is thin and the box small, so that particles leave"""
    if not cache:
        folder = tmp_path_factory.mktemp("impact")
        text = impact(n=3000, rp=9.0, comm="brick").replace("fix stop", "# ")
        text = re.sub(r"(region box .*) \S+ units box", r"\1 0.012 units box", text)
        cache["run"] = folder, lmp(text + looks(600), cwd=folder).thermo
    return cache["run"]


def vector(thermo, name, k):
    width = sum(1 for column in thermo if column.startswith(f"c_{name}["))
    return [thermo[f"c_{name}[{i + 1}]"][k] for i in range(width)]


def frames(run, **how):
    folder, thermo = run
    dump = hvi.Dump(folder / "atoms.dump", data=folder / "end.data", **how)
    assert dump.steps.tolist() == thermo["Step"].tolist() and dump.units == "si"
    return zip(range(len(dump)), dump)


def test_scene_is_worth_it(run):
    """particles have left, pieces have come off, there is a cloud"""
    folder, thermo = run
    sizes = [len(frame) for _, frame in frames(run)]
    assert len(sizes) == 6 and sizes[-1] < sizes[0]
    assert thermo["c_c[12]"][-1] > 100 and thermo["c_cloud[1]"][-1] > 50 and thermo["c_all[1]"][0] == 2
    assert 1 < thermo["c_closecloud[1]"][-1] != thermo["c_cloud[1]"][-1]


@pytest.mark.parametrize("name, axis, plane, quantile", [
    ("c", "z", PLANE, 0.99), ("d", "z", PLANE, 0.9), ("y", "y", 0.0, 1.0),
])
def test_cloud(run, name, axis, plane, quantile):
    """all twelve values of compute hvi/cloud"""
    for k, frame in frames(run):
        got = hvi.measure(frame, axis, plane, quantile)
        assert list(got) == [measure for measure, _ in MEASURES], k
        assert list(got.values()) == pytest.approx(vector(run[1], name, k), rel=CLOSE, abs=0)
        assert frame.time == pytest.approx(run[1]["Time"][k], rel=1e-12)


@pytest.mark.parametrize("name", WAYS)
def test_fragments(run, name):
    """rows and vector of compute hvi/fragment by bonds and by distance, of all and of the cloud, and the IDs per atom"""
    folder = run[0]
    cloud = {"axis": "z", "plane": PLANE} if "cloud" in name else {}
    how = {"distance": REACH} if "close" in name else {"bonds": folder / "bonds.dump"}
    rows = hvi.Dump(folder / f"{name}.rows")
    column = "c_near" if "close" in name else "c_bonds"
    for k, frame in frames(run):
        found = hvi.find(frame, **how, **cloud)
        assert [found.summary[key] for key in SUMMARY] == pytest.approx(vector(run[1], name, k), rel=CLOSE, abs=0)
        want = np.stack(list(rows.rows(k).values()), axis=1)
        got = np.array(found.table.tolist()).reshape(-1, len(ROW.names))
        size = np.array([0, 0, 0, 1, 1, 1, 6e3, 6e3, 6e3, 0, 1e-2]) * CLOSE  # where large numbers cancel
        assert got.shape == want.shape and np.all(np.abs(got - want) <= size + CLOSE * np.abs(want)), k
        if not cloud:
            assert np.array_equal(found.label, frame[column])
            by_column = hvi.find(frame, column=column)
            assert np.array_equal(by_column.table, found.table) and np.array_equal(by_column.label, found.label), k
        assert np.array_equal(found.table["id"][found.row], found.label), k


def test_universe_gives_the_same(run):
    """from the double-precision columns, not from MDAnalysis's coordinates"""
    folder, thermo = run
    u = hvi.open(folder / "atoms.dump", data=folder / "end.data", bonds=folder / "bonds.dump")
    for k, ts in enumerate(u.trajectory):
        assert list(hvi.measure(u, "z", PLANE).values()) == pytest.approx(vector(thermo, "c", k), rel=CLOSE, abs=0)
        assert hvi.find(u, axis="z", plane=PLANE).summary["fragments"] == thermo["c_cloud[1]"][k]
        assert ts.time == pytest.approx(thermo["Time"][k], rel=1e-14)
    assert ts.dt == pytest.approx(np.diff(thermo["Time"])[0])


def test_displacement_of_the_front(run):
    """front velocity from two frames, as it is read from pictures"""
    thermo = run[1]
    rows = list(hvi.series((frame for _, frame in frames(run)), "z", PLANE))
    got = np.array([row["front_displacement_velocity"] for row in rows])
    there = np.flatnonzero(thermo["c_c[12]"] > 0)
    assert np.isnan(got[:there[0] + 1]).all()
    want = np.diff(thermo["c_c[4]"][there]) / np.diff(thermo["Time"][there])
    assert got[there[1:]] == pytest.approx(want, rel=CLOSE) and len(want) >= 3
    for row in hvi.series((frame.select(slice(None)) for _, frame in frames(run)), "z", 1.0):
        assert row["particles"] == 0 and row["length"] == 0.0 and np.isnan(row["front_displacement_velocity"])


@pytest.mark.parametrize("boundary", ["p p p", "p f p", "f f f"])
def test_distance_across_boundaries(lmp, tmp_path, boundary):
    """fragments by distance in periodic, mixed and triclinic boxes against the compute, coordinates scaled and wrapped"""
    for tilt in ("", "change_box all triclinic xy final 1.1 xz final -0.7 yz final 1.3 remap\n"):
        s = cube(4, 0.45, speed=0.0, periodic=True, cut=1.0, seed=4)
        text = scene(s, "s.data", boundary=boundary).replace("read_data s.data\n", "read_data s.data\n" + tilt)
        thermo = lmp(text + """comm_modify cutoff 3.0
compute f all hvi/fragment/atom distance 0.85
compute t all hvi/fragment distance 0.85
dump 1 all custom 1 a.dump id type xs ys zs vx vy vz c_f
dump_modify 1 format float %.17g
thermo_style custom step c_t[*]
run 0
""").thermo
        frame = hvi.Dump(tmp_path / "a.dump", data=tmp_path / "s.data", units="lj", mirror="none")[0]
        found = hvi.find(frame, distance=0.85)
        assert np.array_equal(found.label, frame["c_f"]), tilt
        assert 5 < len(found.table) == thermo["c_t[1]"][0] < 60, tilt


FORMS = {"apart": "", "sound": "damage yes"}  # what has come apart, what is sound


def same_rows(found, rows, size):
    """rows of a dump local are the table; size (11,) of what large numbers cancel in"""
    want = np.stack(list(rows.values()), axis=1)
    got = np.array(found.table.tolist()).reshape(-1, len(ROW.names))
    assert got.shape == want.shape and np.all(np.abs(got - want) <= CLOSE * (np.asarray(size) + np.abs(want)))
    return want


def test_apart_and_sound_on_any_ranks(lmp, tmp_path):
    """one state on 1 to 4 ranks: number, largest, and mass, momentum and energy of every piece, in both forms, are those of Python"""
    rng = np.random.default_rng(6)
    n, box = 900, 10.0
    x, v, mass = rng.uniform(0, box, (n, 3)), rng.normal(1, 3, (n, 3)), np.array([1.0, 3.0])
    text = f"state\n\n{n} atoms\n2 atom types\n" + "".join(f"0 {box} {a}lo {a}hi\n" for a in "xyz") + "\nMasses\n\n1 1\n2 3\n\nAtoms # atomic\n\n"
    text += "".join(f"{k + 1} {1 + k % 2} {' '.join(map(repr, y))}\n" for k, y in enumerate(x.tolist()))
    text += "\nVelocities\n\n" + "".join(f"{k + 1} {' '.join(map(repr, y))}\n" for k, y in enumerate(v.tolist()))
    (tmp_path / "s.data").write_text(text)
    tables = {}
    for nranks in (1, 2, 3, 4):
        text = """units lj
atom_style atomic
atom_modify map array
boundary f f f
comm_modify cutoff 2.5
fix d all property/atom d_hvi_damage ghost no
read_data s.data
pair_style zero 1.0
pair_coeff * *
neighbor 0.2 bin
set group all d_hvi_damage 0.999
group failed id 1:900:4
set group failed d_hvi_damage 1.0
"""
        for name, words in FORMS.items():
            text += f"compute {name} all hvi/fragment distance 0.75 {words}\ndump {name} all local 1 {name}.rows c_{name}[*]\n"
            text += f"dump_modify {name} format float %.17g\n"
        thermo = lmp(text + """dump all all custom 1 a.dump id type mass x y z vx vy vz d_hvi_damage
dump_modify all format float %.17g
thermo_style custom step c_apart[*] c_sound[*]
thermo_modify format float %.17g norm no
run 0
""", nranks=nranks).thermo
        frame = hvi.Dump(tmp_path / "a.dump", units="lj", mirror="none")[0]
        for name in FORMS:
            found, summary = hvi.fragments.both(frame, distance=0.75, failed=["d_hvi_damage"] if name == "sound" else None)
            assert [summary[key] for key in SUMMARY] == pytest.approx(vector(thermo, name, 0), rel=CLOSE, abs=0)
            if name == "sound":  # and with it both
                assert summary["pieces_apart"] == thermo["c_apart[1]"][0], (nranks, name)
                assert summary["largest_apart_mass_fraction"] == pytest.approx(thermo["c_apart[4]"][0], rel=CLOSE), (nranks, name)
            rows = same_rows(found, hvi.Dump(tmp_path / f"{name}.rows").rows(0), [0, 0, 0, 1, 1, 1, 10, 10, 10, 0, 1e-2])
            tables.setdefault(name, rows)
            assert np.array_equal(rows[:, :2], tables[name][:, :2])
            assert rows == pytest.approx(tables[name], rel=1e-12, abs=1e-12)
            m = mass[frame["type"] - 1]
            assert rows[:, 2].sum() == pytest.approx(m.sum(), rel=1e-13), (nranks, name)
            assert rows[:, 2] @ rows[:, 6:9] == pytest.approx(m @ v, rel=1e-11), (nranks, name)
            assert rows[:, 9].sum() == pytest.approx(0.5 * m @ (v**2).sum(axis=1), rel=1e-12), (nranks, name)
    assert 1.1 * len(tables["apart"]) < len(tables["sound"]) < n and tables["apart"][0, 1] > tables["sound"][0, 1] > 5


@pytest.mark.parametrize("nranks", [1, 2, 3, 4])
def test_apart_and_sound_of_an_impact(lmp, root, tmp_path, nranks):
    """examples/single-plate, a quarter: failed by fix hvi/johnson-cook, both forms; result.yaml, computes and Python agree on the pieces of the whole"""
    text = (root / "examples" / "single-plate" / "in.plate").read_text() + """
dump sound all local 1 sound.rows c_sound[*]
dump apart all local 1 apart.rows c_apart[*]
dump all projectile custom 1 a.dump id type x y z vx vy vz mass c_state[2] c_state[3]
dump_modify sound format float %.17g
dump_modify apart format float %.17g
dump_modify all format float %.17g colname c_state[2] damage colname c_state[3] spalled
thermo_style custom step c_apart[*] c_sound[*]
thermo_modify format float %.17g lost ignore
run 0
"""
    thermo = lmp(text, nranks=nranks, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars=dict(
        dx=1.25, D=10, v0=3000, t=1.25, Rplate=15, spall="voids", tstop=6, material_p="Al2017-T4.hvi")).thermo
    result = yaml.safe_load((tmp_path / "result.yaml").read_text())
    frame = hvi.Dump(tmp_path / "a.dump", mirror=["x=0", "y=0"])[0]
    found, summary = hvi.fragments.both(frame, distance=1.5 * 1.25e-3, failed=list(hvi.fragments.FAILED))
    assert [summary[key] for key in SUMMARY] == pytest.approx(vector(thermo, "sound", -1), rel=CLOSE, abs=0)
    apart = hvi.find(frame, distance=1.5 * 1.25e-3)
    assert [apart.summary[key] for key in SUMMARY] == pytest.approx(vector(thermo, "apart", -1), rel=CLOSE, abs=0)
    for one, name in ((found, "sound"), (apart, "apart")):
        same_rows(one, hvi.Dump(tmp_path / f"{name}.rows").rows(0), [0, 0, 0, 1e-2, 1e-2, 1e-2, 3e3, 3e3, 3e3, 0, 1e-2])
    for key in ("fragments", "fragmentation", "largest_fragment_mass_fraction", "pieces_apart", "largest_apart_mass_fraction"):
        assert float(result[key]) == pytest.approx(summary[key], abs=1e-5), key
    assert summary["fragments"] > summary["pieces_apart"] > 3
    # and so does the dump that the example writes, of which all but the plate counts
    frame = hvi.Dump(tmp_path / "plate.dump")[0]
    again = hvi.fragments.both(frame.select(frame["type"] == 1), distance=1.5 * 1.25e-3, failed=list(hvi.fragments.FAILED))[1]
    assert again == pytest.approx(summary, rel=1e-5)
    frame = hvi.Dump(tmp_path / "plate.dump", mirror="none")[0]
    debris = hvi.debris.estimate(frame, hvi.fragments.has_failed(frame), {1: 2790.0, 2: 2703.0})
    masses = debris.summary
    assert masses["subparticle_mass"] > 0 and sum(masses[f"{kind}_mass"] for kind in hvi.debris.KINDS) == pytest.approx(frame.m.sum(), rel=1e-14)


def test_reach_longer_than_the_box():
    """more than one image of each particle"""
    from hvi.io.box import Box

    box = Box.parse("pp pp pp", ["0 1", "0 10", "0 10"])
    x = np.array([[0.5, 1.0, 1.0], [0.5, 3.5, 1.0], [0.5, 8.0, 5.0]])
    still = dict.fromkeys(("vx", "vy", "vz"), np.zeros(3))
    columns = {"id": np.array([3, 5, 9]), "mass": np.ones(3), **dict(zip("xyz", x.T)), **still}
    frame = hvi.Frame(columns, box=box)
    assert hvi.find(frame, distance=2.51).label.tolist() == [3, 3, 9]
    assert hvi.find(frame, distance=2.5).label.tolist() == [3, 5, 9]  # closer than, not as close as
    images, owner = box.images(x, 2.5)
    shifts = np.round(images - x[owner], 9)
    assert {2.0, -2.0} <= set(shifts[:, 0])
    # a fixed direction: nothing across it, and what is beyond its face still has images across the others
    box = Box.parse("pp ff pp", ["0 1", "0 3", "0 10"])
    images, owner = box.images(x, 0.6)
    assert np.all((images - x[owner])[:, 1] == 0.0) and np.bincount(owner).tolist() == [3, 3, 3]


def test_units(lmp, tmp_path):
    """kinetic energies in metal and real units"""
    for units in ("metal", "real", "electron"):
        (tmp_path / units).mkdir()
        thermo = lmp(f"""units {units}
region b block 0 5 0 5 0 5
create_box 1 b
create_atoms 1 random 40 1 NULL
mass 1 26.98
pair_style zero 1.0 nocoeff
pair_coeff * *
velocity all create 300 5
compute c all hvi/cloud axis x plane 2.0
dump 1 all custom 1 a.dump id type x y z vx vy vz mass
dump_modify 1 format float %.17g units yes
thermo_style custom step c_c[*] ke
thermo_modify format float %.17g norm no
run 0
""", cwd=tmp_path / units).thermo
        frame = hvi.Dump(tmp_path / units / "a.dump")[0]
        assert frame.units == units
        assert list(hvi.measure(frame, "x", 2.0).values()) == pytest.approx(vector(thermo, "c", 0), rel=CLOSE), units
        assert hvi.find(frame, column="id").table["ke"].sum() == pytest.approx(thermo["KinEng"][0], rel=CLOSE), units


def test_table_in_pandas(run):
    pytest.importorskip("pandas")
    for _, frame in frames(run):
        found = hvi.find(frame, column="c_bonds")
    table = found.dataframe()
    assert table.index.name == "id" and list(table.columns) == list(ROW.names[1:])
    assert table.loc[found.table["id"][3], "mass"] == found.table["mass"][3]
    assert table["count"].sum() == len(frame)


def test_table_without_pandas(run, monkeypatch):
    for _, frame in frames(run):
        found = hvi.find(frame, column="c_bonds")
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(hvi.HVIError, match=r"^dataframe\(\) needs pandas: Debian's python3-pandas, or pip install pandas$"):
        found.dataframe()


def test_column_of_a_group(run):
    """ID 0 is no fragment; only whole numbers are IDs"""
    for _, frame in frames(run):
        pass
    some = frame["c_bonds"].copy()
    some[frame["type"] == 1] = 0
    part = hvi.Frame({**frame.columns, "c_bonds": some}, masses=frame.type_masses)
    found = hvi.find(part, column="c_bonds")
    assert found.summary["particles"] == np.sum(frame["type"] == 2)
    with pytest.raises(hvi.HVIError, match="column vx has no fragment IDs"):
        hvi.find(frame, column="vx")


def test_wrong_questions(run):
    for _, frame in frames(run):
        pass
    for call, message in (
        (lambda: hvi.measure(frame, "w", 0.0), "axis must be x, y or z, not w"),
        (lambda: hvi.measure(frame, "z", np.nan), "plane must be a number"),
        (lambda: hvi.measure(frame, "z", 0.0, 0.5), "quantile must be > 0.5"),
        (lambda: hvi.measure(7, "z", 0.0), "neither a frame nor a Universe"),
        (lambda: hvi.find(frame), "give one of them"),
        (lambda: hvi.find(frame, column="c_near", distance=1.0), "give one of them"),
        (lambda: hvi.find(frame, column="c_far"), "has no column c_far; it has: id type x"),
        (lambda: hvi.find(frame, distance=-1.0), "distance must be > 0"),
        (lambda: hvi.find(frame, column="c_near", plane=0.0), "needs both an axis and a plane"),
        (lambda: hvi.find(frame, bonds=run[0] / "nowhere"), "nowhere does not exist"),
        (lambda: hvi.find(frame, bonds=run[0] / "atoms.dump"), "is a dump of particles, not of bonds"),
    ):
        with pytest.raises(hvi.HVIError, match=message):
            call()


def test_bonds_of_another_run(lmp, run, tmp_path):
    """bonds between particles that are not there, or with no such step"""
    frame = hvi.Dump(run[0] / "atoms.dump", data=run[0] / "end.data")[1]
    text = (run[0] / "bonds.dump").read_text()
    (tmp_path / "few.dump").write_text(text[:text.index("ITEM: TIMESTEP", 5)])
    with pytest.raises(hvi.HVIError, match="has no frame of step 600; it has 0"):
        hvi.find(frame, bonds=tmp_path / "few.dump")
    from hvi.io.bonds import BondDump

    with pytest.raises(hvi.HVIError, match=r"has no columns a b; it has: index c_B\[1\]"):
        BondDump(run[0] / "bonds.dump", ("a", "b"))


# ---------------------------------------------------------------------- by hand
def test_edge_by_hand():
    """ties, masses, direction"""
    from hvi.analysis.cloud import edge

    values = np.array([3.0, 1.0, 2.0, 2.0, 5.0])
    assert [edge(values, np.ones(5), q) for q in (1.0, 0.8, 0.79)] == [5.0, 3.0, 3.0]
    assert edge(values, np.ones(5), 0.6) == 2.0 and -edge(-values, np.ones(5), 0.8) == 2.0
    assert edge(values, np.array([1.0, 1.0, 1.0, 1.0, 96.0]), 0.9) == 5.0
    assert edge(values, np.array([1e-9, 1e-9, 1e-9, 1e-9, 1e-12]), 0.99) == 3.0


def test_cumulative_by_hand():
    m, above, from_here = cumulative([1.0, 1.0, 4.0, 2.0, 1.0])
    assert m.tolist() == [1, 2, 4] and above.tolist() == [2, 1, 0] and from_here.tolist() == [5, 2, 1]


def test_maps():
    """sums and means in bins against the particles"""
    rng = np.random.default_rng(2)
    n = 500
    x, v, m = rng.normal(size=(n, 3)), rng.normal(size=(n, 3)), rng.uniform(1, 2, n)
    frame = hvi.Frame({"id": np.arange(n), "mass": m, **dict(zip("xyz", x.T)), **dict(zip(("vx", "vy", "vz"), v.T))})
    found = hvi.maps.phase(frame, "y", bins=(7, 5))
    assert found.values.sum() == pytest.approx(m.sum()) and found.values.shape == (7, 5)
    inside = (x[:, 1] >= found.x[2]) & (x[:, 1] < found.x[3])
    assert found.line[2] == pytest.approx(m[inside] @ v[inside, 1] / m[inside].sum())
    row = inside & (v[:, 1] >= found.y[1]) & (v[:, 1] < found.y[2])
    assert found.values[2, 1] == pytest.approx(m[row].sum())

    found = hvi.maps.field(frame, "y", plane=-0.5, bins=(6, 4))
    cloud = x[:, 1] > -0.5
    x, v, m = x[cloud], v[cloud], m[cloud]
    y = x[:, [0, 2]] - m @ x[:, [0, 2]] / m.sum()
    r = np.linalg.norm(y, axis=1)
    cell = (x[:, 1] >= found.x[1]) & (x[:, 1] < found.x[2]) & (r >= found.y[1]) & (r < found.y[2])
    assert cell.sum() > 3 and found.values[1, 1] == pytest.approx(m[cell] @ v[cell, 1] / m[cell].sum())
    with pytest.raises(hvi.HVIError, match="no particles beyond y = 99"):
        hvi.maps.field(frame, "y", plane=99.0)
