"""What commands on dumps once said wrong, left out, or ended in a traceback at, each in the smallest dump that shows it."""

import csv

import hvi
import numpy as np
import pytest
import yaml
from crater_targets import bowl, target
from hvi import cli
from hvi.analysis import crater
from hvi.commands import sweep
from hvi.errors import HVIError, HVIWarning

BOX = "ff ff ff\n-1 1\n-1 1\n-1 1\n"


def write(path, frames, columns, units=""):
    """frames: [(step, rows), ...]"""
    text = f"ITEM: UNITS\n{units}\n" if units else ""
    for step, rows in frames:
        text += f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS {BOX}ITEM: ATOMS {columns}\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows)
    path.write_text(text)
    return str(path)


def said(capsys, *words, status=0):
    """{name: value} of the output"""
    assert cli.main(list(words)) == status, capsys.readouterr()
    out = capsys.readouterr()
    return {key: value.strip() for key, _, value in (line.partition(":") for line in out.out.splitlines())} if status == 0 else out.err


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


# ---------------------------------------------------------------------- fragments
def test_impacts_of_a_quarter(tmp_path, capsys):
    """a piece off both planes is four, one that touches a plane is two with its image one: six by any rule"""
    rows = [(k + 1, 1, 1e-6, *((5e-3, 5e-3) if k < 4 else (0.2e-3, 5e-3)), 1e-3 + 0.5e-3 * (k % 4), 0, 0, 1000, 1 if k < 4 else 5, 0, 0) for k in range(7)]
    dump = write(tmp_path / "q.dump", [(0, rows)], "id type mass x y z vx vy vz c_frag mirror_x_lo mirror_y_lo")
    (tmp_path / "bonds.dump").write_text("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n5\nITEM: BOX BOUNDS " + BOX + "ITEM: ENTRIES batom1 batom2\n1 2\n2 3\n3 4\n5 6\n6 7\n")
    impacts = ("impacts", dump, "--axis", "z", "--plane", "20e-3")
    for rule in (["--distance", "0.6e-3"], ["--column", "c_frag", "--distance", "0.6e-3"], ["--bonds", "bonds.dump", "--distance", "0.6e-3"]):
        assert said(capsys, *impacts, *rule)["fragments"] == "6", rule
    for rule in (["--column", "c_frag"], ["--bonds", "bonds.dump"]):
        assert "does not tell what hangs together with its image" in said(capsys, *impacts, *rule, status=1)
    after = said(capsys, *impacts, "--column", "c_frag", "--distance", "0.6e-3", "--after", "2.2e-3")  # the last of four, four times; none of three
    assert (after["fragments"], after["particles"]) == ("4", "4")
    frame = hvi.Dump(dump)[0]
    with pytest.raises(HVIError, match="a mask or an axis and a plane"):
        hvi.find(frame, distance=1e-3, where=np.ones(7, bool), of_whole=np.ones(28, bool))


def test_fragments_of_types(tmp_path, capsys):
    rows = [(1, "Al", 1.0, 0, 0, 0, 0, 0, 1), (2, "Al", 1.0, 0.1, 0, 0, 0, 0, 1), (3, "Fe", 1.0, 0.2, 0, 0, 0, 0, 1)]
    dump = write(tmp_path / "l.dump", [(0, rows)], "id type mass x y z vx vy vz")
    assert said(capsys, "fragments", dump, "--distance", "0.15", "--mirror", "none", "--type", "Al")["mass"] == "2"
    for words in (["1"], ["Cu", "7"]):
        assert f"no particle has the type {', '.join(words)}; there are: Al, Fe" in said(capsys, "fragments", dump, "--distance", "0.15", "--mirror", "none", "--type", *words, status=1)
    later = write(tmp_path / "m.dump", [(0, rows[:2]), (1, rows)], "id type mass x y z vx vy vz")
    assert cli.main(["fragments", later, "--distance", "0.15", "--mirror", "none", "--type", "Fe", "--all", "--out", "fe.csv"]) in (0, None)
    assert [row["particles"] for row in csv.DictReader(open("fe.csv"))] == ["0", "1"]
    frame = hvi.Dump(dump, mirror="none")[0]
    assert frame.of_types("Al").sum() == 2 and frame.of_types(["Fe", "Al"]).all() and hvi.Frame({"id": np.arange(2), "type": np.array([1, 2])}).of_types(2).tolist() == [False, True]


def test_frames_with_other_columns(tmp_path, capsys):
    """all columns of all frames, nan where a frame has none"""
    full, bare = [(1, 1, 1.0, 0, 0, 0, 0, 0, 1, 0, 1, 1e-3)], [(1, 1, 1.0, 0, 0, 0, 0, 0, 1, 0, 1)]
    one = write(tmp_path / "one.dump", [(0, full)], "id type mass x y z vx vy vz damage spalled fragsize")
    two = write(tmp_path / "two.dump", [(1, bare)], "id type mass x y z vx vy vz damage spalled")
    for files in ((one, two), (two.replace("two", "zero"), one)):
        if "zero" in files[0]:
            write(tmp_path / "zero.dump", [(0, bare)], "id type mass x y z vx vy vz damage spalled")
            write(tmp_path / "one.dump", [(1, full)], "id type mass x y z vx vy vz damage spalled fragsize")
        assert cli.main(["fragments", *files, "--distance", "0.5", "--density", "1=1", "--all", "--sound", "--mirror", "none", "--out", "all.csv"]) in (0, None)
        rows = list(csv.reader(open("all.csv")))
        mass = dict(zip(rows[0], rows[2 if "zero" in files[0] else 1]))["subparticle_mass"], dict(zip(rows[0], rows[1 if "zero" in files[0] else 2]))["subparticle_mass"]
        assert float(mass[0]) > 0 and mass[1] == "nan" and {len(row) for row in rows} == {len(rows[0])} and "no column fragsize (compute hvi/atom fragsize), in frames" in capsys.readouterr().out


# ---------------------------------------------------------------------- units and times
def test_units_of_a_dump_that_begins_empty(tmp_path, capsys):
    rows = [(k, 1, 27.0, 0.1 * k, 0, 0.5, 0, 0, 3.0, 1.0) for k in (1, 2)]
    dump = write(tmp_path / "e.dump", [(0, []), (10, rows)], "id type mass x y z vx vy vz time_metal")
    assert hvi.Dump(dump).units == "metal" and cli.main(["info", dump]) in (0, None) and "units metal" in capsys.readouterr().out
    with pytest.raises(HVIError, match="is in units si, frames before it in metal"):
        hvi.Dump([dump, write(tmp_path / "si.dump", [(20, rows)], "id type mass x y z vx vy vz time_si")])
    assert "is in units metal, not micro" in said(capsys, "cloud", dump, "--axis", "z", "--plane", "0", "--units", "micro", status=1)


def test_times_by_the_interval(tmp_path, capsys):
    """a frame that was cut off has had its time, and a dump that begins later has none"""
    rows = [[(k, 1, 1.0, 0, 0.01 * k, 0.1 * t, 0, 0, 1.0) for k in (1, 2)] for t in range(4)]
    columns = "id type mass x y z vx vy vz"
    text = open(write(tmp_path / "a.dump", [(10 * t, rows[t]) for t in range(4)], columns)).read()
    third = text.index("ITEM: TIMESTEP\n20\n")
    cut = text[:third] + text[third:].split("ITEM: ATOMS")[0] + f"ITEM: ATOMS {columns}\n1 1 1.0 0\n" + text[text.index("ITEM: TIMESTEP\n30\n"):]
    (tmp_path / "cut.dump").write_text(cut)
    with pytest.warns(HVIWarning, match="left out"):
        dump = hvi.Dump("cut.dump", interval=1e-3)
    assert [dump.time(k) for k in range(3)] == [0.0, 1e-3, 3e-3]
    (tmp_path / "again.dump").write_text(cut.replace("ITEM: TIMESTEP\n30\n", text[third:text.index("ITEM: TIMESTEP\n30\n")] + "ITEM: TIMESTEP\n30\n"))  # a run that was killed and resumed
    with pytest.warns(HVIWarning, match="left out"):
        dump = hvi.Dump("again.dump", interval=1e-3)
    assert [dump.time(k) for k in range(4)] == pytest.approx([0.0, 1e-3, 2e-3, 3e-3])
    later = write(tmp_path / "later.dump", [(40, rows[0])], columns)
    with pytest.raises(HVIError, match="the first frame is of step 40, not 0"):
        hvi.Dump(later, interval=1e-3)


def test_compare_of_two_units(tmp_path, capsys):
    rows = [(k, 1, 1.0, 0, 0.1 * k, 0.5, 0, 0, 1.0) for k in (1, 2)]
    one, two = (write(tmp_path / f"{units}.dump", [(0, rows)], "id type mass x y z vx vy vz", units) for units in ("si", "metal"))
    assert "si.dump is in units si" in said(capsys, "compare", one, two, "--plane", "0", status=1)
    assert cli.main(["compare", one, one, "--plane", "0", "--rtol", "1e-9"]) in (0, None)


def test_bonds_of_an_unknown_step(tmp_path):
    data = "LAMMPS data file by hand\n\n2 atoms\n1 bonds\n1 atom types\n1 bond types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nMasses\n\n1 1.0\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0.5 0 0\n\nBonds\n\n1 1 1 2\n"
    (tmp_path / "b.data").write_text(data)
    dump = hvi.Dump(write(tmp_path / "b.dump", [(0, [(1, 1, 0, 0, 0, 0, 0, 1), (2, 1, 0.5, 0, 0, 0, 0, 1)]), (1000, [(1, 1, 0, 0, 0, 0, 0, 1), (2, 1, 0.9, 0, 0, 0, 0, 1)])], "id type x y z vx vy vz"), masses={1: 1.0}, mirror="none")
    bonds = hvi.io.bonds.source("b.data")
    assert hvi.find(dump[0], bonds=bonds).summary["fragments"] == 1
    with pytest.warns(HVIWarning, match="does not say of which time step its bonds are"):
        hvi.find(dump[1], bonds=bonds)


# ---------------------------------------------------------------------- craters, holes, options
@pytest.mark.parametrize("toward", [-1, 1])
def test_face_of_a_crater(toward):
    """is where it is, from whichever side it was struck"""
    frame = target(hole=bowl(8.0, 8.0))
    there = hvi.Frame({**frame.columns, "z": toward * frame["z"] + 5.0}, units="lj")
    found = crater.measure(there, 1.0, [2], toward=toward)
    assert found.face == pytest.approx(5.0, abs=0.05) and found.floor[0] == pytest.approx(found.face - toward * found.depth) and found.depth == pytest.approx(8.0, abs=0.6)


def test_craters_of_labels_and_of_one_particle(tmp_path, capsys):
    frame = target(radius=10, deep=8)
    rows = [(i, "iron" if t == 1 else "target", 1.0, *x) for i, t, x in zip(frame.ids, frame["type"], frame.x)]
    dump = write(tmp_path / "c.dump", [(0, rows)], "id type mass x y z")
    words = ("crater", dump, "--spacing", "1", "--mirror", "none", "--from-above", "--units", "lj")
    assert float(said(capsys, *words, "--type", "target")["depth"]) == pytest.approx(0.0, abs=0.02)
    assert "no two particles of type iron" in said(capsys, *words, "--type", "iron", status=1)
    assert "--all makes a table" in said(capsys, *words, "--all", "--figure", "no.png", status=1)


def test_frames_of_a_data_file(tmp_path, capsys):
    assert cli.main(["body", "ball.data", "--shape", "box", "--size", "20e-3", "20e-3", "2e-3", "--spacing", "1e-3", "--fill", "lattice", "--density", "2785"]) in (0, None)
    assert "there is no frame 1" in said(capsys, "hole", "ball.data", "--plane", "0", "--frame", "1", status=1)


def test_options_that_contradict_or_add_up(tmp_path, capsys):
    rows = [(k, 1, 1.0, 0.1 * k, 0.1, 0.1, 0, 0, 1.0) for k in (1, 2)]
    dump = write(tmp_path / "o.dump", [(0, rows)], "id type mass x y z vx vy vz")
    assert "give one of them" in said(capsys, "view", dump, "--figure", "a.png", "--output", "a.html", "--mirror", "none", status=1)
    assert "contradict each other" in said(capsys, "cloud", dump, "--axis", "z", "--plane", "-1", "--mirror", "none", "--quarter", status=1)
    assert cli.parse(["info", dump]).files == [dump] and cli.parse(["cloud", dump, "--axis", "z", "--plane", "0", "--mirror", "x=0", "--quarter"]).mirror == ["x=0", "y=0"]
    for words in (["--mirror", "z=0", "--quarter"], ["--quarter", "--mirror", "z=0"]):
        assert cli.main(["cloud", dump, "--axis", "z", "--plane", "-1", *words]) in (0, None)
        assert len(hvi.Dump(dump, mirror=cli.parse(["cloud", dump, "--axis", "z", "--plane", "-1", *words]).mirror)[0].whole()) == 16
    args = cli.parse(["hole", dump, "--plane", "-1e-3", "--center", "-1e-3", "-2.5E-4"])
    assert args.plane == -1e-3 and list(args.center) == [-1e-3, -2.5e-4]


# ---------------------------------------------------------------------- results and studies
def test_mappings_in_mappings(tmp_path, capsys):
    for name, hole in (("a", 1), ("b", 9)):
        (tmp_path / f"{name}.yaml").write_text(yaml.safe_dump({"margins": {"wall1": {"hole": hole}, "wall2": {"hole": 5}}}))
    assert cli.main(["compare", "a.yaml", "b.yaml", "--rtol", "0.01"]) == 1
    assert "larger than 0.01: margins.wall1.hole\n" in capsys.readouterr().out


def test_studies_of_one_name(tmp_path, capsys):
    for folder in "AB":
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "in.t").write_text("variable a index 1\n")
        (tmp_path / folder / "p.yaml").write_text("input: in.t\ngrid: {a: [1, 2]}\n")
    assert "has the runs of A/p.yaml: rename B/p.yaml" in said(capsys, "sweep", "A/p.yaml", "B/p.yaml", "--ranks", "1", status=1)
    sweep.own(sweep.Study(tmp_path / "A/p.yaml"), tmp_path / "runs/p", [], False)
    sweep.own(sweep.Study(tmp_path / "A/p.yaml"), tmp_path / "runs/p", [], False)
    with pytest.raises(HVIError, match="has the runs of .*A/p.yaml"):
        sweep.own(sweep.Study(tmp_path / "B/p.yaml"), tmp_path / "runs/p", [], False)
    (tmp_path / "A/p.yaml").rename(tmp_path / "A/q.yaml")
    sweep.own(sweep.Study(tmp_path / "B/p.yaml"), tmp_path / "runs/p", [], False)


# ---------------------------------------------------------------------- MDAnalysis
def test_universe(tmp_path):
    one = write(tmp_path / "one.dump", [(0, [(1, 1, 0, 0, 0, 7, 7, 7), (2, 1, 0.5, 0, 0, 7, 7, 7), (3, 1, 0.9, 0, 0, 7, 7, 7)])], "id type x y z vx vy vz")
    two = write(tmp_path / "two.dump", [(1, [(1, 1, 0, 0, 0), (2, 1, 0.5, 0, 0), (3, 1, 0.9, 0, 0)])], "id type x y z")
    u = hvi.open([one, two], masses={1: 1.0}, mirror="none")
    assert u.atoms.velocities[0, 0] == 7.0
    u.trajectory[1]
    assert np.isnan(u.atoms.velocities).all()
    u.trajectory[0]
    assert u.atoms.velocities[0, 0] == 7.0
    assert len(hvi.io.frame.as_frame(u.atoms[:2] + u.atoms[1:2])) == 2
