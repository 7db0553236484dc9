"""python3 -m hvi: every command, its figures and tables, and what it says about wrong input."""

import argparse
import csv
import importlib
import os
import pty
import re
import subprocess
import sys

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.jobs import compare, engine

CLOUD = ["--axis", "z", "--plane", "-1e-3"]
MASS = ["--mass", "1=5e-7", "--mass", "2=5e-7"]


@pytest.fixture
def files(tmp_path):
    """a cloud of 300 particles in three frames, some of them in pairs and chains; bonds and data file of the last"""
    rng = np.random.default_rng(1)
    n = 300
    x, v = 1e-2 * rng.normal(size=(n, 3)), 1e3 * rng.normal(size=(n, 3))
    length = np.minimum(rng.geometric(0.5, n), 12)
    ends = np.cumsum(length)
    label = np.searchsorted(ends, np.arange(n), side="right")
    bonds = [(i + 1, i + 2) for i in range(n - 1) if label[i] == label[i + 1]]
    first = np.searchsorted(label, label) + 1
    atoms, local = "", ""
    for step in (0, 100, 200):
        head = f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF {{}}\n{{}}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: {{}}\n"
        y = x + v * 1e-8 * step
        atoms += head.format("ATOMS", n, "ATOMS id type x y z vx vy vz c_frag") + "".join(
            f"{i + 1} {1 + i % 2} {' '.join(map(repr, [*y[i].tolist(), *v[i].tolist()]))} {first[i]}\n" for i in range(n))
        local += head.format("ENTRIES", len(bonds), "ENTRIES index c_b[1] c_b[2]") + "".join(
            f"{k + 1} {a} {b}\n" for k, (a, b) in enumerate(bonds))
    (tmp_path / "a.dump").write_text(atoms)
    (tmp_path / "bonds.dump").write_text(local)
    (tmp_path / "a.data").write_text(
        f"LAMMPS data file via write_data, version, timestep = 200, units = si\n\n{n} atoms\n2 atom types\n"
        f"{len(bonds)} bonds\n\nMasses\n\n1 5e-7\n2 5e-7\n\nAtoms # bond\n\n" + "".join(f"{i + 1} 1 {1 + i % 2} 0 0 0\n" for i in range(n))
        + "\nBonds\n\n" + "".join(f"{k + 1} 1 {a} {b}\n" for k, (a, b) in enumerate(bonds)))
    return tmp_path


@pytest.fixture
def command(root):
    """runs python3 -m hvi in a process of its own: (exit status, stdout, stderr)"""

    def run(*words):
        done = subprocess.run([sys.executable, "-m", "hvi", *words], env={**os.environ, "PYTHONPATH": str(root / "python")},
                              text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=120)
        return done.returncode, done.stdout, done.stderr

    return run


def read_csv(path):
    with open(path, newline="") as stream:
        return list(csv.DictReader(stream))


def pictures(folder, name):
    """both are there, and have something drawn in them"""
    from matplotlib.image import imread

    picture = imread(folder / f"{name}.png")[..., :3]
    assert (folder / f"{name}.pdf").read_bytes().startswith(b"%PDF") and picture.shape[1] > 400
    assert 0.001 < np.mean(picture.min(axis=2) < 0.9) < 0.95  # neither blank nor full


# ---------------------------------------------------------------------- commands
def test_help_and_version(command, root):
    status, out, _ = command("--help")
    assert status == 0 and all(name in out for name in cli.COMMANDS)
    version = re.search(r'HVI_VERSION\[\] = "([^"]+)"', (root / "src" / "USER-HVI" / "hvi_version.h").read_text()).group(1)
    assert command("--version")[1] == f"lammps-hvi {version}\n" and hvi.__version__ == version


@pytest.mark.parametrize("name", cli.COMMANDS)
def test_examples_in_help(name, capsys):
    """every command explains itself, and its examples are commands that it takes"""
    with pytest.raises(SystemExit) as end:
        cli.main([name, "--help"])
    assert end.value.code == 0
    out = capsys.readouterr().out
    examples = importlib.import_module(f"hvi.commands.{name}").EXAMPLES
    assert examples in out
    examples = examples.replace("\\\n", " ").splitlines()
    for line in examples:
        words = line.split()
        assert words[:3] == ["python3", "-m", "hvi"], line
        assert cli.parse(words[3:]).command == name, line


def test_howto(files, root):
    """the table of Howto_python has all commands, its commands are known, and its scripts run"""
    import shlex
    import shutil

    text = (root / "doc" / "src" / "Howto_python.rst").read_text()
    assert sorted(re.findall(r"^``(\w+)``  ", text, re.M)) == sorted(cli.COMMANDS)
    lines = re.findall(r"^   python3 -m hvi ((?!--help).*)$", text.replace("\\\n", " "), re.M)
    assert len(lines) >= 7
    for line in lines:
        cli.parse(shlex.split(line))
    for old, new in (("a.dump", "debris.dump"), ("a.data", "debris.data")):
        shutil.copy(old, new)
    blocks = re.findall(r"code-block:: python\n\n(.*?)\n(?=\S)", text, re.S)
    assert len(blocks) == 2
    for block in blocks:
        exec(re.sub(r"^   ", "", block, flags=re.M), {})
    pictures(files, "side")


def test_info(command, files):
    status, out, err = command("info", "a.dump")
    assert (status, err) == (0, "") and "columns: id type x y z vx vy vz c_frag\nmodel: not said\n" in out
    assert [line.split() for line in out.splitlines()[4:]] == [[str(k), str(100 * k), "-", "300"] for k in range(3)]


def test_cloud(command, files):
    words = ["cloud", "a.dump", "--data", "a.data", *CLOUD, "--dt", "1e-8", "--out", "c.csv", "--figure", "c"]
    status, out, err = command(*words)
    assert (status, err) == (0, "")
    pictures(files, "c")
    rows = read_csv("c.csv")
    frames = hvi.Dump("a.dump", data="a.data", dt=1e-8)
    for row, want in zip(rows, hvi.series(frames, "z", -1e-3)):
        assert {name: float(value) for name, value in row.items()} == pytest.approx(want, rel=1e-15, nan_ok=True)
    text = out.splitlines()
    assert text[0].split() == list(rows[0]) and text[1].split()[:3] == ["s", "m", "m"] and len(text) == 2 + 3 + 2
    assert [float(word) for word in text[4].split()] == pytest.approx([float(value) for value in rows[2].values()], rel=1e-5)


def test_fragments(command, files):
    """the same from column and bonds; table and fits are those of the library"""
    common = ["fragments", "a.dump", "--data", "a.data", "--fit", "both", "--mmin", "5e-7", "--top", "3"]
    status, out, err = command(*common, "--bonds", "bonds.dump", "--out", "f.csv", "--figure", "f")
    assert (status, err) == (0, "")
    pictures(files, "f")
    found = hvi.find(hvi.Dump("a.dump", data="a.data")[-1], column="c_frag")
    rows = read_csv("f.csv")
    assert [[float(value) for value in row.values()] for row in rows] == [list(row) for row in found.table.tolist()]
    assert f"fragments: {len(found.table)}\n" in out and "frame 2, step 200\n" in out
    for law in ("power", "exponential"):
        assert str(hvi.fit(found.table["mass"], law, 5e-7, unit=5e-7)) in out
    table = out.split("\n\n")[1].splitlines()
    assert table[0].split() == list(rows[0]) and len(table) == 5
    column = command(*common, "--column", "c_frag")[1]
    assert column in out  # all but the names of the figures


def test_fragments_of_all_frames(files, capsys):
    assert cli.main(["fragments", "a.dump", *MASS, *CLOUD, "--bonds", "bonds.dump", "--all", "--out", "f.csv"]) == 0
    rows = read_csv("f.csv")
    for frame, row in zip(hvi.Dump("a.dump", masses={1: 5e-7, 2: 5e-7}), rows):
        summary = hvi.find(frame, bonds="bonds.dump", axis="z", plane=-1e-3).summary
        want = {"frame": frame.number, "step": frame.step, "time": np.nan, **summary}
        assert {name: float(value) for name, value in row.items()} == pytest.approx(want, rel=1e-15, nan_ok=True)
    assert len(rows) == 3 and len({row["particles"] for row in rows}) > 1 and len(capsys.readouterr().out.splitlines()) == 5


@pytest.mark.parametrize("kind", ["phase", "field"])
def test_map(files, capsys, kind):
    assert cli.main(["map", "a.dump", *MASS, "--kind", kind, "--figure", "m", "--frame", "0", "--bins", "30", "20"]) == 0
    assert capsys.readouterr().out == "figure: m.png\nfigure: m.pdf\n"
    pictures(files, "m")


@pytest.mark.parametrize("words", [
    [], ["--color", "velocity", "--up", "y"], ["--color", "axial", "--axis", "x"], ["--color", "c_frag"],
    ["--color", "fragment", "--column", "c_frag", "--plane", "0"], ["--thickness", "5e-3", "--diameter", "1e-3"],
])
def test_view(files, words):
    assert cli.main(["view", "a.dump", *MASS, "--figure", "v", *words]) == 0
    pictures(files, "v")


def test_view_is_right_handed(files):
    """what is nearer to the eye is drawn over what is behind it, whichever way is up"""
    import hvi.figures
    from matplotlib.image import imread

    corner = np.array([[-1.0] * 3, [1.0] * 3])
    for k, (axis, up) in enumerate((("z", "x"), ("z", "y"), ("x", "z"), ("y", "x"), ("y", "z"), ("x", "y"))):
        a, b = "xyz".index(axis), "xyz".index(up)
        eye = np.cross(np.eye(3)[a], np.eye(3)[b])  # right x up points to the eye
        x = np.vstack([0.3 * eye, -0.3 * eye, corner])
        front, behind = (1, 2) if k % 3 else (2, 1)  # types: red, blue
        frame = hvi.Frame({"id": np.arange(4), "type": np.array([front, behind, 3, 3]), **dict(zip("xyz", x.T))})
        hvi.figures.save(hvi.figures.side(frame, axis, up, diameter=0.5), "v.png")
        picture = imread("v.png")[..., :3]
        height, width = picture.shape[:2]
        middle = picture[int(0.45 * height):int(0.55 * height), int(0.45 * width):int(0.6 * width)]
        colors = [0.784, 0.216, 0.227], [0.184, 0.384, 0.659]
        red, blue = (np.any(np.abs(middle - color).max(axis=2) < 0.02) for color in colors)
        assert (red, blue) == (front == 1, front == 2), (axis, up)


def test_view_of_words(files):
    """colored by a column of words, with their names in the legend"""
    import hvi.figures

    frame = hvi.Dump("a.dump")[0]
    words = hvi.Frame({**frame.columns, "element": np.where(frame["type"] == 1, "Al", "Fe")})
    figure = hvi.figures.side(words, color="element")
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["Al", "Fe"]
    words.columns["heat"] = np.where(frame.ids == 5, np.nan, 1.0)
    with pytest.raises(hvi.HVIError, match="heat of particle 5 is nan"):
        hvi.figures.side(words, color="heat")


def test_bench(root):
    """bench/reading.py measures what it says"""
    done = subprocess.run([sys.executable, "-W", "ignore", root / "bench" / "reading.py", "--particles", "900", "--peer"],
                          env={**os.environ, "PYTHONPATH": str(root / "python")}, text=True, capture_output=True, timeout=120)
    assert done.returncode == 0 and done.stdout.count(" s wall ") == 11 and done.stdout.startswith("900 particles")


def test_one_kind_of_figure(files):
    assert cli.main(["map", "a.dump", *MASS, "--figure", "only.pdf"]) == 0
    assert not os.path.exists("only.png") and not os.path.exists("only.pdf.png") and os.path.exists("only.pdf")


def test_compare_results(command, files):
    (files / "a").mkdir()
    (files / "a" / "result.yaml").write_text("# a run\n\nlattice: sc\nratio: 2.0\nsteps: 10\nzero: 0\nonly: 1\n")
    (files / "b.yaml").write_text("lattice: fcc   # other\nratio: 1.5\nsteps: 10\nzero: 0.0\nmore: x\n")
    status, out, err = command("compare", "a", "b.yaml", "--rtol", "0.3", "--out", "d.csv")
    assert (status, err) == (1, "")
    lines = {line.split()[0]: line.split()[1:] for line in out.splitlines()[1:]}
    assert lines["ratio"] == ["2", "1.5", "-0.5", "-0.25"] and lines["steps"] == ["10", "10", "0", "0"]
    assert lines["lattice"] == ["sc", "fcc", "differs"] and lines["only"] == ["1", "-", "differs"]
    assert lines["zero"] == ["0", "0", "0", "0"]
    assert "larger than 0.3: lattice, only, more" in out
    assert [row["key"] for row in read_csv("d.csv")] == ["lattice", "ratio", "steps", "zero", "only", "more"]
    assert cli.main(["compare", "a", "b.yaml", "--keys", "ratio", "steps", "--rtol", "0.25"]) == 0
    assert cli.main(["compare", "a", "b.yaml", "--keys", "ratio", "--rtol", "0.2499"]) == 1
    assert compare.relative(0, 1) == np.inf and compare.relative(-2.0, -1.0) == 0.5


def test_compare_lists_in_results(files):
    """as hvi shield writes them: reasons, and margins; lists may be indented, too"""
    for name, hole in (("a", 4), ("b", 5)):
        engine.write_yaml(files / f"{name}.yaml", {"verdict": "fails", "reasons": [f"a hole of {hole} mm", "spall"], "margins": {"hole_mm": hole, "layers": 3}, "steps": 5})
    (files / "c.yaml").write_text((files / "a.yaml").read_text().replace("\n- ", "\n  - "))
    assert compare.read_result("c.yaml") == compare.read_result("a.yaml")
    found = compare.read_result("a.yaml")
    assert found == {"verdict": "fails", "reasons": "a hole of 4 mm; spall", "margins.hole_mm": 4, "margins.layers": 3, "steps": 5}
    assert cli.main(["compare", "a.yaml", "b.yaml", "--keys", "margins.hole_mm", "--rtol", "0.2"]) == 1
    engine.write_yaml(files / "r.yaml", {"remedies": [{"settings": {"tstop": 12.2}}, {"spacings_mm": 0.2, "C": [1, 2]}], "rules": [], "quarter": True, "hole_mm": float("nan")})
    assert compare.read_result("r.yaml") == {"remedies": "settings: tstop: 12.2; spacings_mm: 0.2; C: 1; 2", "rules": "", "quarter": "true", "hole_mm": ".nan"}
    assert cli.main(["compare", "r.yaml", "r.yaml", "--rtol", "0"]) == 0
    assert cli.main(["compare", "a.yaml", "b.yaml", "--keys", "margins.layers", "verdict", "--rtol", "0"]) == 0


def test_compare_of_long_texts(command, files):
    """reasons do not make the table wider: they are cut there, and below it in full"""
    text = "verdict: {}\nreasons:\n  - {}\n  - spall\nsteps: 5\n"
    (files / "a.yaml").write_text(text.format("fails", "wall 2 is perforated by a hole of 20.02 mm"))
    (files / "b.yaml").write_text(text.format("holds", "none"))
    status, out, err = command("compare", "a.yaml", "b.yaml", "--out", "d.csv")
    table, found, below = out.partition("\nreasons\n")
    assert (status, err, found) == (0, "", "\nreasons\n") and max(map(len, table.splitlines())) < 80
    assert "  wall 2 is perforated by a hole of 20....  none; spall " in table
    assert below == "  A: wall 2 is perforated by a hole of 20.02 mm\n     spall\n  B: none\n     spall\n"
    assert read_csv("d.csv")[1]["A"] == "wall 2 is perforated by a hole of 20.02 mm; spall"


def test_compare_dumps(files, capsys):
    text = (files / "a.dump").read_text()
    (files / "b.dump").write_text(text[:text.index("ITEM: TIMESTEP\n200")])
    assert cli.main(["compare", "a.dump", "b.dump", *MASS, *CLOUD, "--bonds", "bonds.dump", "bonds.dump"]) == 0
    lines = {line.split()[0]: line.split()[1:] for line in capsys.readouterr().out.splitlines()[1:]}
    for which, name in enumerate(("a.dump", "b.dump")):
        frame = hvi.Dump(name, masses={1: 5e-7, 2: 5e-7})[-1]
        summary = hvi.find(frame, bonds="bonds.dump", axis="z", plane=-1e-3).summary
        want = {**hvi.measure(frame, "z", -1e-3), **summary, "step": frame.step}
        got = {key: float(values[which]) for key, values in lines.items()}
        assert got == pytest.approx({key: want[key] for key in lines}, rel=1e-5), name
    assert "fragmentation" in lines and lines["step"][3] == "-0.5"
    assert cli.main(["compare", "a.dump", "a.dump", *MASS, *CLOUD, "--rtol", "0"]) == 0


# ---------------------------------------------------------------------- wrong input
WRONG = [
    (["cloud", "none.dump", *CLOUD], "none.dump does not exist"),
    (["cloud", "a.data", *CLOUD], "a.data is not a LAMMPS text dump"),
    (["cloud", "a.dump", *CLOUD], "has no masses: give a data file, the mass of each type, or dump the column mass"),
    (["cloud", "a.dump", "--mass", "1=2", *CLOUD], "no mass for type 2; known are 1=2"),
    (["cloud", "a.dump", *MASS, *CLOUD, "--frame", "3"], "there is no frame 3: a.dump has 3 complete frames, 0 to 2"),
    (["cloud", "a.dump", *MASS, *CLOUD, "--quantile", "0.4"], "the quantile must be > 0.5"),
    (["cloud", "a.dump", "--data", "a.data", "--units", "lj", *CLOUD], "a.dump is in units si, not lj"),
    (["cloud", "a.dump", *MASS, "--axis", "z", "--plane", "9", "--figure", "c"], "no frame has particles beyond the plane"),
    (["cloud", "a.dump", *MASS, *CLOUD, "--out", "none/c.csv"], "cannot write none/c.csv: No such file"),
    (["fragments", "a.dump", *MASS], "what is a fragment? give --column, --bonds or --distance"),
    (["fragments", "a.dump", *MASS, "--column", "c_x"], "has no column c_x; it has: id type x y z vx vy vz c_frag"),
    (["fragments", "a.dump", *MASS, "--bonds", "bonds.dump", "--bond-columns", "p", "q"], "has no columns p q; it has: index"),
    (["fragments", "a.dump", *MASS, "--bonds", "a.data", "--frame", "0"], "are those of step 200, not of step 0"),
    (["fragments", "a.dump", *MASS, "--column", "c_frag", "--fit", "power", "--mmin", "1"], "only 0 fragments from 1"),
    (["fragments", "a.dump", *MASS, "--column", "c_frag", "--all", "--figure", "f"], "--all makes a table"),
    (["map", "a.dump", *MASS, "--plane", "9", "--figure", "m"], "no particles beyond z = 9"),
    (["map", "a.dump", *MASS, "--bins", "0", "5", "--figure", "m"], "a map needs at least one bin each way"),
    (["map", "a.dump", *MASS, "--figure", "none/m"], "cannot write none/m: No such file"),
    (["view", "a.dump", *MASS, "--color", "fragment", "--figure", "v"], "what is a fragment?"),
    (["view", "a.dump", *MASS, "--color", "heat", "--figure", "v"], "has no column heat; it has: id"),
    (["view", "a.dump", *MASS, "--up", "z", "--figure", "v"], "up must be another direction than the axis"),
    (["compare", "a.dump", "none"], "none does not exist"),
    (["compare", "a.dump", "a.data"], "cannot compare a dump with a result.yaml"),
    (["compare", "a.dump", "a.dump", *MASS], "to compare two dumps give --plane"),
    (["compare", "a.data", "a.data", "--keys", "front"], "a.data, line 14: not YAML"),
]


@pytest.mark.parametrize("words, message", WRONG, ids=lambda value: value[0] if isinstance(value, list) else value[:30])
def test_wrong_input(files, capsys, words, message):
    """one line that says what, and exit status 1"""
    assert cli.main(words) == 1
    err = capsys.readouterr().err
    assert message in err and err.startswith("hvi: ") and err.count("\n") == 1


@pytest.mark.parametrize("words, message", [
    ([], "COMMAND"), (["draw"], "invalid choice"), (["cloud", "a.dump", "--axis", "z"], "--plane"),
    (["cloud", "a.dump", *CLOUD, "--mass", "5"], "5 is not TYPE=MASS"),
    (["cloud", "a.dump", *CLOUD, "--mass", "1=-5"], "is not TYPE=MASS"),
    (["cloud", "a.dump", *CLOUD, "--dt", "0"], "0 is not a number > 0"), (["map", "a.dump"], "--figure"),
])
def test_wrong_options(capsys, words, message):
    with pytest.raises(SystemExit) as end:
        cli.main(words)
    assert end.value.code == 2 and message in capsys.readouterr().err


def test_lists_add_up():
    """no word is lost of an option that takes several and is given twice"""
    for command in cli.COMMANDS:
        parser = next(action for action in cli.options(command)._actions if isinstance(action, argparse._SubParsersAction)).choices[command]
        for option in (action for action in parser._actions if action.option_strings and action.nargs == "+"):
            said = argparse.Namespace(**{option.dest: option.default})
            for word in "xy":
                option(parser, said, [word], option.option_strings[0])
            assert getattr(said, option.dest) == ["x", "y"], (command, option.option_strings)


def test_errors_leave_no_traceback(command, files):
    for words in (["cloud", "none.dump", *CLOUD], ["compare", "a.dump", "a.dump"]):
        status, out, err = command(*words)
        assert status == 1 and "Traceback" not in err and err.count("\n") == 1, words


def test_reader_that_stops(files, root):
    """python3 -m hvi ... | head: no complaint when nobody reads on"""
    words = [sys.executable, "-m", "hvi", "fragments", "a.dump", *MASS, "--column", "c_frag"]
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(words, env={**os.environ, "PYTHONPATH": str(root / "python")}, stdout=write, stderr=subprocess.PIPE, timeout=60)
    os.close(write)
    assert done.stderr == b"" and done.returncode == 1


def test_cut_off_dump(files, capsys):
    """what is whole is used, with a warning that names the frame; nothing whole is an error"""
    text = (files / "a.dump").read_text()
    (files / "cut.dump").write_text(text[:-500])
    assert cli.main(["cloud", "cut.dump", *MASS, *CLOUD]) == 0
    out, err = capsys.readouterr()
    assert len(out.splitlines()) == 2 + 2
    assert re.fullmatch(r"hvi: warning: left out frame cut.dump \(step 200\): it ends after \d+ of 300 rows\n", err)
    (files / "cut.dump").write_text(text[:5000])
    assert cli.main(["cloud", "cut.dump", *MASS, *CLOUD]) == 1
    assert re.search(r"no complete frame: cut.dump \(step 0\): it ends after \d+ of 300 rows", capsys.readouterr().err)


def test_not_a_number(files, capsys):
    text = (files / "a.dump").read_text().split("\n")
    words = text[9 + 16].split()
    text[9 + 16] = " ".join([*words[:5], "nan", *words[6:]])
    (files / "nan.dump").write_text("\n".join(text))
    assert cli.main(["cloud", "nan.dump", *MASS, *CLOUD]) == 1
    assert "frame 0 of nan.dump (step 0): vx of particle 17 is nan" in capsys.readouterr().err


def test_bar_on_a_terminal_only(files, root):
    """long work shows a bar where somebody looks, and leaves the output clean"""
    code = "import hvi.progress as p; p.DELAY = 0.0; from hvi.cli import main; main()"
    words = [sys.executable, "-c", code, "cloud", "a.dump", *MASS, *CLOUD]
    environment = {**os.environ, "PYTHONPATH": str(root / "python")}
    quiet = subprocess.run(words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
    master, slave = pty.openpty()
    seen = subprocess.run(words, env=environment, stdout=subprocess.PIPE, stderr=slave, text=True, timeout=60)
    os.close(slave)
    shown = os.read(master, 100_000).decode()
    os.close(master)
    assert quiet.stderr == "" and quiet.stdout == seen.stdout and len(quiet.stdout.splitlines()) == 5
    assert "cloud:   0%" in shown and "reading a.dump:   0%" in shown and re.search(r"\r *\r$", shown)
