"""Half and quarter models in python/hvi: the measures of the whole, by the records of dumps, beside those of the computes."""

import re

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.analysis.cloud import MEASURES
from hvi.analysis.fragments import ROW
from hvi.io import mirror
from hvi.io.box import Box
from mirror_scenes import ROOM, start
from solid_scenes import MATERIAL

RECORD = {"": ("v_plane", "mirror_none"), "x": ("v_plane", "mirror_x_lo"), "xy": ("v_plane v_plane", "mirror_x_lo mirror_y_lo")}
REACH = 0.93  # many pieces, some of them across the planes
HEIGHT = 2.0  # of the plane, above the middle
EXTENSIVE = ("mass", "momentum", "kinetic_energy", "particles")
CLOSE = 1e-10


def looks(planes, steps):
    """a dump with its record, and what the computes say, after so many steps"""
    z = ROOM + HEIGHT  # there is no plane across z
    columns, names = RECORD[planes]
    names = names.split()
    names = " ".join(f"colname {k - len(names)} {name}" for k, name in enumerate(names))
    return f"""variable clock atom time
variable plane atom 0
region beyond block INF INF INF INF {z} INF
compute st all hvi/atom p damage spalled vm
compute near all hvi/fragment/atom distance {REACH}
compute sound all hvi/fragment/atom distance {REACH} damage yes
compute c all hvi/cloud axis z plane {z}
compute d all hvi/cloud axis z plane {z} quantile 0.8
compute f all hvi/fragment distance {REACH}
compute b all hvi/fragment distance {REACH} region beyond
compute s all hvi/fragment distance {REACH} damage yes
thermo_style custom step c_c[*] c_d[*] c_f[*] c_b[*] c_s[*]
thermo_modify format float %.17g
run {steps}
write_dump all custom atoms.dump id type mass x y z vx vy vz v_clock c_st[*] c_near c_sound {columns} modify sort id &
  format float %.17g colname v_clock time_lj colname c_st[1] p colname c_st[2] damage colname c_st[3] spalled colname c_st[4] vm {names}
write_dump all local f.rows c_f[*] modify format float %.17g
write_dump all local b.rows c_b[*] modify format float %.17g
write_dump all local s.rows c_s[*] modify format float %.17g
"""


@pytest.fixture(scope="module")
def cache():
    return {}


@pytest.fixture
def runs(lmp, tmp_path_factory, cache):
    """{planes: (folder, thermo)} of the whole, half and quarter after 40 steps, run once"""
    if not cache:
        top = tmp_path_factory.mktemp("mirror")
        (top / "test.hvi").write_text(MATERIAL.format(sigma_p=3.0))
        for planes in RECORD:
            folder = top / (planes or "whole")
            folder.mkdir()
            text, _ = start(planes, folder, top / "test.hvi", steps=0)
            cache[planes] = folder, lmp(text + looks(planes, 40), cwd=folder).thermo
    return cache


def frame(runs, planes, **how):
    return hvi.Dump(runs[planes][0] / "atoms.dump", **how)[0]


def vector(thermo, name):
    return {measure: thermo[f"c_{name}[{k + 1}]"][-1] for k, (measure, _) in enumerate(MEASURES)}


def rows(folder, name):
    """rows of the compute of a whole model, its middle at 0 in x and y"""
    dump = hvi.Dump(folder / f"{name}.rows")
    table = np.stack(list(dump.rows(0).values()), axis=1)
    table[:, 3:5] -= ROOM
    return table


def in_order(table):
    """without IDs, which images do not share with the particles that the whole model has there; by mass and place"""
    table = table[:, 1:]
    return table[np.lexsort(np.round(table[:, [4, 3, 2, 1, 0]], 5).T)]


def test_scene_is_worth_it(runs):
    """pieces across each of the planes and away from both, something that has failed"""
    x, y = rows(runs[""][0], "f")[:, 3:5].T
    on = np.abs(x) < 1e-9, np.abs(y) < 1e-9
    assert all(np.sum(case) > 3 for case in (on[0] & ~on[1], on[1] & ~on[0], ~on[0] & ~on[1]))
    assert rows(runs[""][0], "f")[:, 1].max() > 8 and np.sum(frame(runs, "")["damage"] >= 1) > 10
    assert len(rows(runs[""][0], "f")) < len(rows(runs[""][0], "s"))


@pytest.mark.parametrize("name, quantile", [("c", 0.99), ("d", 0.8)])
def test_cloud(runs, name, quantile):
    """of the part as compute hvi/cloud has it between mirrors, mass and number those of the whole; and as in a whole model"""
    whole = vector(runs[""][1], name)
    for planes in RECORD:
        got = hvi.measure(frame(runs, planes), "z", ROOM + HEIGHT, quantile)
        want = {key: value * 2 ** (len(planes) * (key in EXTENSIVE)) for key, value in vector(runs[planes][1], name).items()}
        assert got == pytest.approx(want, rel=CLOSE, abs=0), planes
        assert got == pytest.approx(whole, rel=1e-8), planes  # as well as the runs agree
        assert got["particles"] == whole["particles"] and got["mass"] == pytest.approx(whole["mass"], rel=CLOSE), planes


@pytest.mark.parametrize("name", ["f", "b", "s"])
def test_fragments(runs, name):
    """by distance, by bonds and by the columns of the compute per particle, which knows of no mirrors: the rows of the whole model"""
    want = in_order(rows(runs[""][0], name))
    cloud = {"axis": "z", "plane": ROOM + HEIGHT} if name == "b" else {}
    for planes in ("x", "xy"):
        part = frame(runs, planes)
        ways = [{"distance": REACH, "failed": hvi.fragments.FAILED if name == "s" else None}]
        if name != "b":
            ways.append({"column": "c_sound" if name == "s" else "c_near", **ways[0]})
        if name == "f":
            label, ids = part["c_near"], part.ids
            chain = [(i, j) for key in np.unique(label) for i, j in zip(ids[label == key], ids[label == key][1:])]
            ways.append({"bonds": np.array([*chain, (ids[3], ids[-1] + 7)]), "distance": REACH})  # the last is of one that has left
        for way in ways:
            found = hvi.find(part, **way, **cloud)
            table = np.array(found.table.tolist()).reshape(-1, len(ROW.names))
            table[:, 4] -= 0.0 if "y" in planes else ROOM
            got = in_order(table)
            assert got.shape == want.shape and np.abs(got - want).max() < 1e-7, (planes, way)  # as well as the runs agree
            t = found.table
            across = np.abs(t["x"]) < 1e-9
            assert across.any() and np.abs(t["vx"][across]).max() < CLOSE, planes
            there = part.x[:, 2] > (ROOM + HEIGHT if cloud else 0.0)
            assert t["mass"].sum() == pytest.approx(2 ** len(planes) * part.m[there].sum(), rel=CLOSE)
            assert t["ke"].sum() == pytest.approx(want[:, 8].sum(), rel=1e-8), planes
            own = len(np.unique(found.label[found.label <= part.ids[-1]]))
            assert found.images() == pytest.approx(len(t) / own) and 1 < found.images() < 2 ** len(planes)


@pytest.mark.parametrize("name", ["f", "b", "s"])
def test_fragments_of_the_compute(runs, name):
    """table and vector of a half and of a quarter: those of the whole model, and those of Python on the same dump, IDs too"""
    want, cloud = in_order(rows(runs[""][0], name)), {"axis": "z", "plane": ROOM + HEIGHT} if name == "b" else {}
    whole = [runs[""][1][f"c_{name}[{k + 1}]"][-1] for k in range(5)]
    for planes in ("x", "xy"):
        folder, thermo = runs[planes]
        table = np.stack(list(hvi.Dump(folder / f"{name}.rows").rows(0).values()), axis=1)
        found = hvi.find(frame(runs, planes), distance=REACH, failed=hvi.fragments.FAILED if name == "s" else None, **cloud)
        python = np.array(found.table.tolist())
        assert table.shape == python.shape and np.all(np.abs(table - python) <= CLOSE * (1 + np.abs(python))), planes
        got = in_order(table - [0, 0, 0, 0, 0 if "y" in planes else ROOM, 0, 0, 0, 0, 0, 0])
        assert got.shape == want.shape and np.abs(got - want).max() < 1e-7, planes  # as well as the runs agree
        vector = [thermo[f"c_{name}[{k + 1}]"][-1] for k in range(5)]
        summary = [found.summary[key] for key in ("fragments", "particles", "fragmentation", "largest_fragment_mass_fraction", "single_particles_mass")]
        assert vector == pytest.approx(summary, rel=CLOSE) and vector == pytest.approx(whole, rel=CLOSE), planes


@pytest.mark.parametrize("planes, sides, nranks", [("y", False, 1), ("yz", True, 2), ("xyz", False, 3), ("z", True, 1)])
def test_fragments_behind_any_planes(lmp, tmp_path, material, planes, sides, nranks):
    """upper planes, along any directions, on any number of ranks"""
    text, _ = start(planes, tmp_path, material, steps=40, sides=sides)
    computes = f"compute f all hvi/fragment distance {REACH} damage yes\ncompute st all hvi/atom damage spalled\n"
    dumps = """write_dump all local f.rows c_f[*] modify format float %.17g
write_dump all custom a.dump id type mass x y z vx vy vz c_st[*] modify format float %.17g colname c_st[1] damage colname c_st[2] spalled
"""
    lmp(text.replace("run 40", computes + "run 40") + dumps, nranks=nranks)
    at = [f"{axis}={ROOM},hi" if sides else f"{axis}=0" for axis in planes]
    found = hvi.find(hvi.Dump(tmp_path / "a.dump", units="lj", mirror=at)[0], distance=REACH, failed=hvi.fragments.FAILED)
    got, want = np.stack(list(hvi.Dump(tmp_path / "f.rows").rows(0).values()), axis=1), np.array(found.table.tolist())
    assert got.shape == want.shape and np.all(np.abs(got - want) <= CLOSE * (100 + np.abs(want)))
    assert 1 < found.images() < 2 ** len(planes) and want[0, 1] > 8


def test_bonds_do_not_tell(lmp, tmp_path, material):
    """what hangs together with its image"""
    text = "units lj\natom_style hybrid sph bond\nregion box block 0 9 0 9 0 9\nboundary f f f\ncreate_box 1 box bond/types 1\n"
    text += "create_atoms 1 single 0.5 0.5 0.5\nmass 1 1.0\nset group all sph/rho 1.0\npair_style hvi/sph cubic mirror x 0 lo\n"
    text += "pair_coeff 1 1 eos tait 1 10 7 h 1.2\nbond_style zero nocoeff\nbond_coeff *\nfix sph all hvi/sph\nspecial_bonds lj/coul 1 1 1\n"
    text += "compute f all hvi/fragment bonds\nthermo_style custom step c_f[1]\nrun 0\n"
    assert "bonds do not tell what hangs together with its image" in lmp(text, expect_fail=True).error
    assert lmp(text.replace("bonds\n", "distance 1.01\n")).thermo["c_f[1]"][0] == 1


def test_its_own_image(runs):
    """a quarter, and the whole made of it: the same in every measure"""
    part = frame(runs, "xy")
    whole = part.whole()
    assert len(whole) == 4 * len(part) and whole.planes == () and whole.whole() is whole
    assert np.array_equal(whole.x[:len(part)], part.x) and np.all(np.diff(whole.ids) > 0)
    assert hvi.measure(part, "z", ROOM) == hvi.measure(whole, "z", ROOM)
    assert np.array_equal(hvi.find(part, distance=REACH).table, hvi.find(whole, distance=REACH).table)
    for name in ("phase", "field"):
        a, b = (getattr(hvi.maps, name)(f, "z", plane=ROOM) for f in (part, whole))
        assert np.array_equal(a.values, b.values, equal_nan=True), name
    a, b = (hvi.maps.impacts(f, "z", ROOM + 20.0) for f in (part, whole))
    assert np.array_equal(a.energy, b.energy) and a.summary == b.summary
    assert a.summary["momentum"] == pytest.approx(4 * np.sum((part.m * part.v[:, 2])[part.v[:, 2] > 0]), rel=CLOSE)
    shear = hvi.Frame({**part.columns, "sxy": part["p"], "sxz": part["p"]}, mirror=part.planes).whole()
    n = len(part)
    assert np.array_equal(shear["sxy"][n:2 * n], -part["p"]) and np.array_equal(shear["sxy"][3 * n:], part["p"])
    assert np.array_equal(shear["sxz"][2 * n:3 * n], part["p"])


def test_pictures(runs):
    """show the whole, as do those of fragments"""
    part = frame(runs, "xy")
    for color, found in (("type", None), ("fragment", hvi.find(part, distance=REACH))):
        left, right = hvi.figures.side(part, "z", "x", color, fragments=found).axes[0].get_ylim()
        assert left == pytest.approx(-right) and right > part.x[:, 0].max(), color


def test_planes_anywhere():
    """an upper plane and one that is not at 0: places, box, what touches; columns of coordinates of all kinds"""
    box = Box.parse("ff ff pp", ["-3 2", "1 9", "0 1"])
    x = np.array([[1.8, 1.1, 0.5], [-2.0, 4.0, 0.5], [1.0, 3.0, 0.5]])
    columns = {"id": np.array([2, 5, 9]), "mass": np.ones(3), **dict(zip(("xs", "ys", "zs"), box.to_scaled(x).T)), "vx": np.ones(3),
               "vy": np.zeros(3), "vz": np.zeros(3), "q": np.arange(3.0)}
    whole = hvi.Frame(columns, box=box, mirror=mirror.of_words(["x=2,hi", "y=1"])).whole()
    assert whole.x[3:6] == pytest.approx(x * [-1, 1, 1] + [4, 0, 0]) and whole.x[9:] == pytest.approx(x * [-1, -1, 1] + [4, 2, 0])
    assert whole.v[:, 0].tolist() == [1] * 3 + [-1] * 3 + [1] * 3 + [-1] * 3 and whole["q"].tolist() == 4 * [0, 1, 2]
    assert whole.box.origin.tolist() == [-3, -7, 0] and whole.box.vectors.diagonal().tolist() == [10, 16, 1]
    assert whole.ids.tolist() == [2, 5, 9, 11, 14, 18, 20, 23, 27, 29, 32, 36]
    found = hvi.find(hvi.Frame(columns, box=box, mirror=mirror.of_words(["x=2,hi", "y=1"])), column="id", distance=0.5)
    assert len(found.table) == 1 + 4 + 4 and found.table["count"].tolist() == [4] + 8 * [1]
    assert (found.table["x"][0], found.table["y"][0]) == pytest.approx((2, 1)) and found.table["vx"][0] == 0
    few = hvi.Frame({name: column[:0] for name, column in columns.items()}, box=box, mirror=mirror.of_words("x=2,hi"))
    assert len(few.whole()) == 0 and len(hvi.find(few, distance=1.0).table) == 0


def test_whole_models_agree(runs):
    """maps of quarter, half and whole"""
    found = [hvi.maps.impacts(frame(runs, planes), "z", ROOM + 20.0).summary for planes in RECORD]
    for other in found[1:]:
        assert other == pytest.approx({**found[0], "radius_of_half_the_energy": other["radius_of_half_the_energy"],
                                       **{key: other[key] for key in other if key.startswith("largest")}}, rel=1e-8)


def test_compare(runs, capsys):
    """cloud and fragments of quarter and whole, side by side: nothing differs; of the part without its record nearly all does"""
    words = ["compare", *(str(runs[planes][0] / "atoms.dump") for planes in ("", "xy")), "--plane", str(ROOM + HEIGHT), "--distance", str(REACH),
             "--rtol", "1e-8"]
    assert cli.main(words) == 0
    assert cli.main([*words, "--mirror", "none"]) == 1
    differ = capsys.readouterr().out.split("larger than 1e-08: ")[1]
    assert all(key in differ for key in ("diameter", "mass", "fragmentation"))


def test_record(runs, capsys):
    """time, units and planes from the columns; said by the command"""
    for planes, text in (("", "whole"), ("x", "half (mirror x 0 lo)"), ("xy", "quarter (mirror x 0 lo, mirror y 0 lo)")):
        path = str(runs[planes][0] / "atoms.dump")
        dump = hvi.Dump(path)
        assert dump.units == "lj" and dump.time(0) == pytest.approx(40 * 0.004, rel=1e-12), planes
        assert mirror.text(dump.mirror(0)) == text
        assert cli.main(["info", path]) == 0 and f"model: {text}\n" in capsys.readouterr().out
        assert cli.main(["cloud", path, "--axis", "z", "--plane", str(ROOM)]) == 0, planes
        assert (f"model: {text}; what follows is of the whole\n" in capsys.readouterr().out) == bool(planes)


def test_flags_and_unknown(runs, capsys, tmp_path):
    """a dump that says nothing and ends at a plane is refused; flags go before the record"""
    text = (runs["xy"][0] / "atoms.dump").read_text()
    said = re.sub(r" mirror_x_lo mirror_y_lo", " a b", text)
    (tmp_path / "old.dump").write_text(said)
    cloud = ["--axis", "z", "--plane", str(ROOM)]
    assert cli.main(["cloud", "old.dump", *cloud]) == 1
    assert ("has no record of mirror planes, and looks like a quarter (mirror x 0 lo, mirror y 0 lo): unknown whether it is the "
            "whole; say --mirror x=0 --mirror y=0, or --mirror none") in capsys.readouterr().err
    for call in (lambda f: hvi.find(f, distance=1.0), lambda f: hvi.maps.phase(f, "z"), lambda f: hvi.maps.impacts(f, "z", 99.0),
                 lambda f: hvi.figures.side(f), lambda f: f.select(slice(None))):
        with pytest.raises(hvi.HVIError, match="no record of mirror planes"):
            call(hvi.Dump("old.dump")[0])
    (tmp_path / "atoms.dump").write_text(text)
    outputs = []
    for words in (["old.dump", "--quarter"], ["old.dump", "--mirror", "x=0", "--mirror", "y=0.0,lo"], ["atoms.dump"],
                  ["atoms.dump", "--mirror", "none"], ["old.dump", "--mirror", "none"], ["atoms.dump", "--mirror", "y=0"]):
        assert cli.main(["cloud", *words, *cloud]) == 0
        outputs.append(capsys.readouterr().out)
    assert outputs[0] == outputs[1] == outputs[2] != outputs[3] == outputs[4] and "half" in outputs[5]
    # the data file says it where the dump does not
    data = "LAMMPS data file: part, mirror x 0 lo mirror y 0 lo\n\n1 atoms\n\nAtoms # atomic\n\n1 1 0 0 0\n"
    (tmp_path / "part.data").write_text(data)
    assert cli.main(["cloud", "old.dump", "--data", "part.data", *cloud]) == 0 and capsys.readouterr().out == outputs[0]


@pytest.mark.parametrize("words, message", [
    (["cloud", "--mirror", "x"], "a mirror plane is said like x=0 or y=1e-3,hi, or none, not x"),
    (["cloud", "--mirror", "x=0,left"], "not x=0,left"), (["cloud", "--mirror", "none", "--mirror", "x=0"], "contradict each other"),
    (["cloud", "--mirror", "x=0", "--mirror", "x=1"], "one for each of x, y, z at most"), (["cloud", "--mirror", "x=nan"], "each at a number"),
    (["fragments", "--column", "c_near"], "a column of a quarter (mirror x 0 lo, mirror y 0 lo) does not tell what hangs together with its image: give the distance"),
    (["fragments", "--column", "c_near", "--bonds", "f.rows", "--distance", "1"], "give one of them"),
])
def test_wrong_input(runs, capsys, monkeypatch, words, message):
    monkeypatch.chdir(runs["xy"][0])
    plane = ["--axis", "z", "--plane", str(ROOM)]
    assert cli.main([words[0], "atoms.dump", *words[1:], *plane]) == 1
    assert message in capsys.readouterr().err
