"""python/hvi reads what LAMMPS writes: dumps in all forms, cut-off and damaged ones, data files; one frame at a time."""

import gzip
import tracemalloc
import warnings

import hvi
import numpy as np
import pytest
from hvi.io.bonds import BondDump
from hvi.io.data import DataFile
from hvi.progress import Silent, bar
from scenes import cube, scene

FORMS = {"x": "x y z ix iy iz", "xs": "xs ys zs ix iy iz", "xu": "xu yu zu", "xsu": "xsu ysu zsu",
         "all": "x y z xsu ysu zsu ix iy iz"}
TILTS = {"orthogonal": "", "triclinic": "change_box all triclinic xy final 0.9 xz final -1.1 yz final 0.7 remap\n",
         "other way": "change_box all triclinic xy final -0.9 xz final -1.1 yz final -0.7 remap\n"}


def dump_text(columns="id type x y z vx vy vz", steps=(0, 10), rows=("1 1 0 0 0 1 2 3", "2 1 .5 .5 .5 4 5 6")):
    return "".join(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
                   f"ITEM: ATOMS {columns}\n" + "".join(row + "\n" for row in rows) for step in steps)


def pairs(bonds):
    return {tuple(sorted(pair)) for pair in np.asarray(bonds).tolist()}


@pytest.fixture
def written(tmp_path):
    """writes a text and opens it as a dump"""

    def write(text, name="a.dump", **how):
        path = tmp_path / name
        path.write_text(text)
        return hvi.Dump(path, **how)

    return write


# ---------------------------------------------------------------------- forms that LAMMPS writes
@pytest.mark.parametrize("shape", TILTS)
def test_coordinates(lmp, tmp_path, shape):
    """unwrapped coordinates from every form of them, in a periodic box that particles leave again and again; any order"""
    s = cube(4, 0.1, speed=10.0, periodic=True, cut=1.0)
    text = scene(s, "s.data") + "fix nve all nve\ntimestep 0.002\ncompute frag all hvi/fragment/atom bonds\n"
    text = text.replace("read_data s.data\n", "read_data s.data\n" + TILTS[shape])
    for name, columns in FORMS.items():
        order = "sort id" if name != "xs" else "sort -3"  # falling coordinate
        text += f"dump {name} all custom 100 {name}.dump id type {columns} vx vy vz c_frag\n"
        text += f"dump_modify {name} {order} format float %.17g\n"
    text += "dump unsorted all custom 100 unsorted.dump vz vy vx zu yu xu c_frag type id\n"
    text += "dump_modify unsorted format float %.17g\n"
    lmp(text + "run 300\n")

    dumps = {name: hvi.Dump(tmp_path / f"{name}.dump", units="lj") for name in [*FORMS, "unsorted"]}
    raw = dumps["unsorted"].rows(3)["id"]
    assert not np.all(np.diff(raw) > 0)
    length = dumps["x"][0].box.vectors.diagonal()
    for k in range(4):
        frames = {name: dump[k] for name, dump in dumps.items()}
        want = np.stack([frames["xu"][c] for c in ("xu", "yu", "zu")], axis=1)
        for name, frame in frames.items():
            assert frame.step == 100 * k and np.array_equal(frame.ids, np.arange(1, 65))
            assert frame.x == pytest.approx(want, abs=1e-12 * length.max()), name
            assert np.array_equal(frame.v, frames["xu"].v) and np.array_equal(frame["c_frag"], frames["xu"]["c_frag"])
            assert frame.box.periodic == (True, True, True)
        box = frames["x"].box
        wrapped = box.wrap(want)
        assert np.all((box.to_scaled(wrapped) >= -1e-12) & (box.to_scaled(wrapped) < 1 + 1e-12)), k
        turns = box.to_scaled(want) - box.to_scaled(wrapped)
        assert turns == pytest.approx(np.rint(turns), abs=1e-12), k
    assert len(np.unique(np.rint(turns), axis=0)) > 10  # they went around


def test_general_triclinic(lmp, tmp_path):
    """boxes that do not lie along x, dumped as they are"""
    lmp("""units lj
lattice custom 1.0 a1 1.5 0.5 0.2 a2 -0.4 1.2 0.3 a3 0.1 -0.3 1.4 basis 0 0 0 triclinic/general
create_box 1 NULL 0 3 0 3 0 3
create_atoms 1 box
mass 1 1.0
pair_style zero 1.0
pair_coeff * *
velocity all create 400.0 1 loop geom
fix 1 all nve
dump 1 all custom 50 g.dump id type x y z ix iy iz xu yu zu
dump_modify 1 triclinic/general yes format float %.17g
run 200
""")
    dump = hvi.Dump(tmp_path / "g.dump", units="lj")
    vectors = np.array([[1.5, 0.5, 0.2], [-0.4, 1.2, 0.3], [0.1, -0.3, 1.4]])
    vectors *= 3.0 / np.linalg.det(vectors) ** (1 / 3)  # density 1
    assert dump[0].box.vectors == pytest.approx(vectors, rel=1e-12)
    frame = dump[-1]
    assert np.abs(frame["ix"]).max() >= 1
    columns = {name: column for name, column in frame.columns.items() if name not in ("xu", "yu", "zu")}
    wrapped = hvi.Frame(columns, box=frame.box)
    assert wrapped.x == pytest.approx(frame.x, abs=1e-11)


def test_time_units_words_and_many_files(lmp, tmp_path):
    """ITEM: TIME and UNITS, element names, one file per step given in any order, packed files"""
    s = cube(3, types=2)
    lmp(scene(s, "s.data") + """fix nve all nve
timestep 0.002
dump 1 all custom 5 one.dump id element type x y z mass
dump_modify 1 time yes units yes element Al Fe
dump 2 all custom 5 many.*.dump id type x y z
run 20
""")
    dump = hvi.Dump(tmp_path / "one.dump")
    assert dump.units == "lj" and [dump.time(k) for k in range(5)] == pytest.approx([0, 0.01, 0.02, 0.03, 0.04])
    frame = dump[2]
    assert frame.time == pytest.approx(0.02) and frame.units == "lj"
    assert np.array_equal(frame["element"], np.where(s.types == 1, "Al", "Fe"))
    assert np.array_equal(frame.m, np.array(s.masses)[s.types - 1])
    with pytest.raises(hvi.HVIError, match="is in units lj, not si"):
        hvi.Dump(tmp_path / "one.dump", units="si")

    files = sorted(tmp_path.glob("many.*.dump"))
    assert [p.name for p in files][1] == "many.10.dump"  # not in order of time
    many = hvi.Dump(files, dt=0.002)
    assert many.steps.tolist() == [0, 5, 10, 15, 20] and many.time(3) == pytest.approx(0.03)
    assert hvi.Dump(files, interval=7.0).time(2) == 14.0
    back = tmp_path / "back.dump"
    back.write_text("".join(files[k].read_text() for k in (0, 2, 3, 2)))
    with pytest.raises(hvi.HVIError, match=r"back.dump: frame 3 goes back to step 15 \(a resumed run\?\)"):
        hvi.Dump(back, interval=7.0)
    assert hvi.Dump(back).at_step(15) == 3  # the later one

    packed = tmp_path / "one.dump.gz"
    packed.write_bytes(gzip.compress((tmp_path / "one.dump").read_bytes()))
    again = hvi.Dump(packed)
    for k in (4, 0, 2):
        assert np.array_equal(again[k].x, dump[k].x) and np.array_equal(again[k]["element"], dump[k]["element"])
    packed.write_bytes(packed.read_bytes()[:-40])
    with pytest.raises(hvi.HVIError, match="cannot read .*gz"):
        hvi.Dump(packed)


def test_frames_that_need_more_than_one_block(tmp_path, monkeypatch):
    """the search for frames gives the same however the file is cut into blocks"""
    text = "".join(dump_text(steps=(k,), rows=[f"{i + 1} 1 0 0 {k} 0 0 0" for i in range(k % 7)]) for k in range(40))
    path = tmp_path / "a.dump"
    path.write_text(text)
    want = [(h.start, h.step, h.n, h.body, h.size, h.rows) for h in hvi.Dump(path).headers]
    assert [w[2] for w in want] == [k % 7 for k in range(40)]
    for chunk, head in ((1, 300), (17, 300), (1000, 300), (299, 301)):
        monkeypatch.setattr("hvi.io.scan.CHUNK", chunk)
        monkeypatch.setattr("hvi.io.scan.HEAD", head)
        assert [(h.start, h.step, h.n, h.body, h.size, h.rows) for h in hvi.Dump(path).headers] == want, (chunk, head)
    assert hvi.Dump(path)[0].x.shape == (0, 3) and hvi.Dump(path)[13].x[:, 2].tolist() == [13.0] * 6


# ---------------------------------------------------------------------- damage
def test_cut_off_anywhere(tmp_path):
    """wherever a dump ends, whole frames are read and the rest is reported; never half a frame, never another error"""
    text = dump_text(steps=(0, 10, 20))
    path = tmp_path / "cut.dump"
    for end in range(len(text)):
        path.write_text(text[:end])
        starts = [text.index(f"ITEM: TIMESTEP\n{step}\n") for step in (0, 10, 20)] + [len(text)]
        whole = sum(end >= stop for stop in starts[1:])
        if whole == 0:
            with pytest.raises(hvi.HVIError, match="cut off|ends after|empty|does not begin|incomplete"):
                hvi.Dump(path)
            continue
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            dump = hvi.Dump(path)
        assert len(dump) == whole and dump[-1].v[:, 2].tolist() == [3.0, 6.0], end
        assert len(caught) == len(dump.problems) == (end not in starts)


def test_a_run_that_was_resumed(written):
    """cut off in the middle of a row, or of the header, then appended to: the frames around are read"""
    one = dump_text(steps=(0,))
    with pytest.warns(hvi.HVIWarning, match="left out frame .*step 0.*it has 3 rows instead of 2"):
        assert written(one + "3 1 0 0 0 0 0 0\n" + dump_text(steps=(10,))).steps.tolist() == [10]
    with pytest.warns(hvi.HVIWarning, match="left out"):  # what is said once is kept
        assert written("ITEM: UNITS\ncgs\n" + one + "3 1 0 0 0 0 0 0\n" + dump_text(steps=(10,))).units == "cgs"
    for cut in (len(one) - 7, len(one) - 18, one.index("ATOMS id") + 8, one.index("NUMBER") + 3):
        with pytest.warns(hvi.HVIWarning, match="left out frame .*(ends after|cut off|incomplete)"):
            dump = written(one + one.replace("TEP\n0", "TEP\n5")[:cut] + dump_text(steps=(10, 20)))
        assert dump.steps.tolist() == [0, 10, 20], cut
        assert all(np.array_equal(frame.v, [[1, 2, 3], [4, 5, 6]]) for frame in dump), cut


def test_parts_of_frames_are_refused(tmp_path):
    """one file for each rank (%): other particles at the same step; the frame that a resumed run has written again has the same ones, and is read as ever"""
    names = [tmp_path / name for name in "abc"]
    rows = [f"{k} 1 0 0 0 0 0 0" for k in range(1, 5)]
    for first, second in ((rows[:2], rows[2:]), (rows[:3], rows[3:]), (rows, [])):
        for name, steps, own in zip(names, ((0, 10), (0, 10), (20,)), (first, second, rows)):
            name.write_text(dump_text(steps=steps, rows=own))
        with pytest.raises(hvi.HVIError, match=r"/a and \S+/b both have a frame of step 0, of different particles: parts of a frame .* into one file"):
            hvi.Dump(names)
    for name, steps in zip(names, ((0, 10), (10, 20), (20,))):
        name.write_text(dump_text(steps=steps, rows=rows))
    assert hvi.Dump(names).steps.tolist() == [0, 10, 10, 20, 20]
    for name, steps in zip(names, ((0, 10), (0, 10), (20,))):
        name.write_text(dump_text(steps=steps, rows=()))
    assert len(hvi.Dump(names)) == 5


def test_frames_with_few_particles_are_no_parts(tmp_path):
    """a group that changes may have none in one of two frames of a step, or others before it has the same; two empty ones beside others are parts"""
    names, rows = [tmp_path / name for name in "abc"], [f"{k} 1 0 0 0 0 0 0" for k in range(1, 5)]

    def steps_of(*files):
        for name, frames in zip(names, files):
            name.write_text("".join(dump_text(steps=(step,), rows=own) for step, own in frames.items()))
        return sorted(hvi.Dump(names[:len(files)]).steps.tolist())

    assert steps_of({0: [], 10: []}, {10: rows[1:2], 20: rows}) == [0, 10, 10, 20]
    assert steps_of({0: [], 10: rows[:1], 20: rows}, {10: rows[1:2], 20: rows}) == [0, 10, 10, 20, 20]
    for files in (({0: rows[:2]}, {0: rows[2:]}), ({0: [], 10: rows[:2]}, {0: rows, 10: rows[2:]}), ({0: []}, {0: rows, 10: rows}, {10: []})):
        with pytest.raises(hvi.HVIError, match="both have a frame of step .* different particles"):
            steps_of(*files)


def test_parts_without_ids_are_refused(tmp_path):
    """particles by all their columns, bonds by their pairs"""
    names = [tmp_path / name for name in "ab"]

    def write(columns, *files):
        for name, rows in zip(names, files):
            name.write_text(dump_text(columns, rows=rows))
        return names

    with pytest.raises(hvi.HVIError, match="different particles: parts of a frame"):
        hvi.Dump(write("type x y z", ["1 0 0 0", "1 1 0 0"], ["1 2 0 0"]))
    assert len(hvi.Dump(write("type x y z", ["1 0 0 0", "1 1 0 0"], ["1 1 0 0", "1 0 0 0"]))) == 4

    def bonds(*files):
        for name in write("index batom1 batom2", *files):
            name.write_text(name.read_text().replace("ITEM: ATOMS", "ITEM: ENTRIES"))
        return BondDump(names).at(10).tolist()

    for files in ((["1 1 2", "2 2 3"], ["1 4 5"]), (["1 4 5"], ["1 1 2", "2 2 3"]), (["1 4 5"], [])):
        with pytest.raises(hvi.HVIError, match="different bonds: parts of a frame .* all bonds of a frame into one file"):
            bonds(*files)
    assert bonds(["1 1 2", "2 2 3"], ["1 2 3"]) == [[2, 3]]


@pytest.mark.parametrize("old, new, message", [
    ("2 1 .5 .5 .5 4 5 6", "2 1 .5 .5 .5 4 5", r"step 10.*columns changed from 8 to 7 at row 2"),
    ("2 1 .5 .5 .5 4 5 6", "2 1 .5 .5 .5 4 5 six", r"step 10.*could not convert string 'six'"),
    ("2 1 .5 .5 .5 4 5 6", "1 1 .5 .5 .5 4 5 6", r"step 10.*particle 1 is there twice"),
    ("2 1 .5 .5 .5 4 5 6", "2.5 1 .5 .5 .5 4 5 6", r"id in row 2 is 2.5, not a whole number"),
    ("2 1 .5 .5 .5 4 5 6", "", r"1 rows instead of 2"),
    ("1 1 0 0 0 1 2 3\n2", "1 1 0 0 0 1 2\n2", r"the first row has 7 values for 8 columns"),
])
def test_rows_that_do_not_fit(written, old, new, message):
    first, second = dump_text(steps=(0,)), dump_text(steps=(10,))
    dump = written(first + second.replace(old, new))
    assert dump[0].v[1, 2] == 6.0
    with pytest.raises(hvi.HVIError, match=message):
        dump[1]


@pytest.mark.parametrize("name, message", [
    ("z", "no coordinates"), ("vy", "has no column vy; it has: id"), ("type", "has no column type"),
])
def test_missing_columns(written, name, message):
    columns = "id type x y z vx vy vz".split()
    dump = written(dump_text(columns=" ".join("q" if c == name else c for c in columns)), masses={1: 1.0})
    with pytest.raises(hvi.HVIError, match=message):
        hvi.measure(dump[0], "z", -1.0)


@pytest.mark.parametrize("word", ["nan", "-nan", "inf"])
@pytest.mark.parametrize("column, name", [(4, "z"), (6, "vy")])
def test_not_a_number(written, word, column, name):
    row = "2 1 .5 .5 .5 4 5 6".split()
    row[column] = word
    dump = written(dump_text(rows=("1 1 0 0 0 1 2 3", " ".join(row))), masses={1: 1.0})
    with pytest.raises(hvi.HVIError, match=rf"frame 0 of .*step 0.*: {name} of particle 2 is -?{word.strip('-')}"):
        hvi.measure(dump[0], "z", -1.0)


@pytest.mark.parametrize("content, message", [
    (b"", "is empty"), (b"LAMMPS (4 Feb 2025)\n", "is not a LAMMPS text dump"), (b"ITEM: \xff\xfe", "no complete frame"),
    (b"ITEM: TIMESTEP\nx\nITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS id\n", "no complete frame.*invalid literal"),
])
def test_not_a_dump(tmp_path, content, message):
    (tmp_path / "x").write_bytes(content)
    with pytest.raises(hvi.HVIError, match=message):
        hvi.Dump(tmp_path / "x")


def test_wrong_questions(written, tmp_path):
    dump = written(dump_text())
    with pytest.raises(hvi.HVIError, match="there is no frame 2: .* has 2 complete frames, 0 to 1"):
        dump[2]
    with pytest.raises(hvi.HVIError, match="has no frame of step 7; it has 0 10"):
        dump.at_step(7)
    with pytest.raises(hvi.HVIError, match="has no masses"):
        dump[0].m
    with pytest.raises(hvi.HVIError, match="no mass for type 1; known are 2=3"):
        written(dump_text(), masses={2: 3.0})[0].m
    with pytest.raises(hvi.HVIError, match="unknown units furlong"):
        written(dump_text(), units="furlong")
    with pytest.raises(hvi.HVIError, match="nowhere does not exist"):
        hvi.Dump("nowhere")
    with pytest.raises(hvi.HVIError, match="is a folder"):
        hvi.Dump(tmp_path)
    (tmp_path / "a.dump").write_text(dump_text(steps=(0,)))
    with pytest.raises(hvi.HVIError, match="has become shorter"):
        dump[1]


# ---------------------------------------------------------------------- data files
def test_data_file(lmp, tmp_path):
    s = cube(4, cut=0.3, types=2)
    lmp(scene(s, "s.data") + "fix kept all property/atom d_q\nrun 7\nwrite_data out.data pair ij\n")
    assert "\nkept # d_q\n" in (tmp_path / "out.data").read_text()  # sections of fixes do not disturb
    for name, step, units in (("s.data", None, None), ("out.data", 7, "lj")):
        data = DataFile(tmp_path / name)
        assert (data.step, data.units, data.masses) == (step, units, {1: 1.0, 2: 1.5})
        assert pairs(data.bonds) == pairs(s.bonds + 1), name
        ids, types = data.atoms
        assert np.array_equal(ids, np.arange(1, 65)) and np.array_equal(types, s.types), name
    text = (tmp_path / "out.data").read_text()
    (tmp_path / "cut.data").write_text(text[:text.index("Bonds") + 200])
    with pytest.raises(hvi.HVIError, match="section Bonds.*cut off"):
        DataFile(tmp_path / "cut.data").bonds
    with pytest.raises(hvi.HVIError, match="is not a LAMMPS data file"):
        DataFile(tmp_path / "in.1")


# ---------------------------------------------------------------------- memory
def test_one_frame_in_memory(tmp_path):
    """reading 24 frames takes the memory of one or two"""
    n, rng = 2000, np.random.default_rng(1)

    def peak(frames):
        path = tmp_path / f"{frames}.dump"
        with open(path, "w") as stream:
            for step in range(frames):
                x = rng.normal(size=(n, 6))
                rows = [f"{i + 1} 1 {' '.join(map(repr, row))}" for i, row in enumerate(x.tolist())]
                stream.write(dump_text(steps=(step,), rows=rows))
        dump = hvi.Dump(path, masses={1: 1.0})
        tracemalloc.start()
        assert len(list(hvi.series(dump, "z", 0.0))) == frames
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    hvi.measure(hvi.Frame({k: np.zeros(1) for k in "x y z vx vy vz mass".split()}), "z", 1.0)
    few, many = peak(3), peak(24)
    assert few < 24 * 8 * 8 * n and many < 1.3 * few


# ---------------------------------------------------------------------- progress
class Terminal:
    def __init__(self, tty=True):
        self.text, self.tty = "", tty

    def isatty(self):
        return self.tty

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_progress(monkeypatch):
    """on a terminal, after a while; nowhere else"""
    assert isinstance(bar(10, "work", Terminal(False)), Silent)
    for delay, seen in ((0.0, True), (1000.0, False)):
        monkeypatch.setattr("hvi.progress.DELAY", delay)
        terminal = Terminal()
        with bar(10, "work", terminal, mininterval=0) as b:
            for _ in range(10):
                b.update()
        assert ("work:  50%" in terminal.text) == seen
    monkeypatch.setitem(__import__("sys").modules, "tqdm", None)
    assert isinstance(bar(10, "work", Terminal()), Silent)
