"""Wrong inputs of python3 -m hvi as data, tests/inputs/cases.yaml: each ends with one line that names culprit and remedy, or is right; nothing is left behind.

A row of cases: change: [old, new] in the case of front_runs.py, add: lines at its end, text: another one, or the name of one of FILES, name: of its file, files:
{name: text or one of FILES} beside it; line, says: of the message, right: true if there is none. A row of commands: words that are right, and says where not.
"""

import argparse
import contextlib
import functools
import io
import itertools
import os
import pathlib
import re
import resource
import signal

import pytest
import yaml
from front_runs import CASE, case_folder  # noqa: F401
from hvi import cli
from hvi.figures import style
from hvi.jobs import machine
from hvi.report import view
from hvi.shield import case as cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = yaml.safe_load((ROOT / "tests/inputs/cases.yaml").read_text())
SECONDS = 60  # no end is a hang
MATERIAL = "# DATE: 2026 UNITS: si\neos linear\n  rho0 2700\n  K 7e10\nstrength perfect\n  G 27e9\n  Y 3e8\n"
RULE = "spacing: {bumper_layers: 2, wall_layers: 3, ratio: 1%s}\nmaterials: {AA2017-T4: Al2017-T4, AA6061-T6: Al6061-T6}\n"
DUMP = "".join(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n64\nITEM: BOX BOUNDS ff ff ff\n-1 5\n-1 5\n-1 5\nITEM: ATOMS id type mass x y z vx vy vz mirror_none\n" + "".join(
    f"{k + 1} 1 1.0 {k % 4} {k // 4 % 4} {k // 16} 0 0 {1 + k % 3} 0\n" for k in range(64)) for step in (0, 100))
FILES = {
    "case": CASE, "material": MATERIAL, "dump": DUMP, "input": "variable speed index 5.0\nvariable mode index good\n", "result": "a: 1\nb:\n  - text\n",
    "study": "input: in.tiny\ngrid: {speed: [1.0, 2.0], mode: [good]}\n", "limits": "list: mine.csv\nacross: [10]\n" + RULE % "", "shots": "list: mine.csv\n" + RULE % ", across: 10",
    "brackets": "name,source,proj_mat,D_mm,km_s,bumper,tb_mm,gap_mm,wall,yield_ksi,tw_mm,on,low,high,fails,holds\n"
                "W,A,AA2017-T4,5,7.1,AA6061-T6,1.6,50,AA6061-T6,40,,wall,1.6,1.8,4,E\n",
    "list": "source,shotID,proj_mat,proj_diam,angle,velocity,bumper_mat,bumper_thick,standoff,wall_mat,wall_yield,wall_thick,result\n"
            "A,small,AA2017-T4,0.318,0,6.5,AA6061-T6,0.08,5.08,AA6061-T6,40,0.159,NP\n",
    "records": (ROOT / "python/hvi/shield/calibration.csv").read_text(),
    "empty": "", "binary": bytes(range(256)), "latin": "a: 5 \u00b5m\n".encode("latin-1"), "big": b"# x\n" * 500_000, "truncated": CASE[:CASE.index("Al6061") - 9] + "material: [",
    "two documents": CASE + "---\n" + CASE, "crlf": CASE.replace("\n", "\r\n").encode(), "mark": b"\xef\xbb\xbf" + CASE.encode(), "deep": "[\n" * 20000,  # in one line YAML looks ahead from each
    "deep line": "[" * 20000,
    "grid bomb": "input: in.tiny\ngrid:\n" + "".join(f"  {name}: [{', '.join(map(str, range(200)))}]\n" for name in "abc"), "bomb": "".join(f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9) if k else 'x'}]\n" for k in range(12)),
    "key bomb": "? " + "".join(f"[&a{k} [{', '.join([f'*a{k - 1}'] * 9) if k else 'x'}], " for k in range(12)) + "x" + "]" * 12 + "\n: 1\n", "folder": None, "missing": None}
SPOILT = {"empty": "empty", "binary": "binary", "latin": "latin", "big": "big", "folder": "folder", "missing": "missing", "bomb": "bomb", "deep": "deep"}
RUNS = {("compare", "bomb")}  # which reads lines of its own, and no YAML


def every_third(values, slow=()):
    """those between, and slow ones, are long tests"""
    return [pytest.param(value, marks=[pytest.mark.long] * (k % 3 > 0 or value in slow)) for k, value in enumerate(values)]


def put(name, what):
    """a file, by the name of one of FILES, or its text"""
    path = pathlib.Path(name)
    if what == "folder":
        path.mkdir()
    elif what != "missing":
        data = FILES.get(what, what)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())


def late(*_):
    raise TimeoutError(f"no end after {SECONDS} s")


def run(words):
    """(exit status, stdout, stderr) of a command in this process; what is not caught there fails the test, and what takes too long"""
    out, err = io.StringIO(), io.StringIO()
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGALRM)}
    signal.signal(signal.SIGALRM, late)
    signal.alarm(SECONDS)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = cli.main(words)
    except SystemExit as end:
        status = end.code
    finally:
        signal.alarm(0)
        for number, handler in before.items():
            signal.signal(number, handler)
    return status, out.getvalue(), err.getvalue()


def refused(words, case):
    """the line that a command ends with; nothing is left that was not there"""
    there = set(pathlib.Path().rglob("*"))
    status, _, err = run(words)
    assert status in (1, 2), f"{case}: exit status {status}, {err}"
    lines = [line for line in err.splitlines() if not line.startswith("hvi: warning: ")]
    if status == 2:  # the parser's, behind its usage
        lines = [line for line in lines if ": error: " in line]
    assert len(lines) == 1 and not re.search(r"[\x00-\x1f\x7f]", lines[0]) and len(lines[0]) < 3000, f"{case}: {err}"
    left = sorted(map(str, set(pathlib.Path().rglob("*")) - there))
    assert left == [], f"{case}: {left} was left"
    return lines[0]


@pytest.fixture(autouse=True)
def scene(monkeypatch, tmp_path):
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(ROOT / "potentials"))
    monkeypatch.setenv("HVI_LMP", "/bin/true")
    monkeypatch.setattr(machine, "free_memory", lambda: 1e6)  # MB, whatever the machine has
    monkeypatch.setattr(machine, "free_disk", lambda path: (1e6, path))
    monkeypatch.setattr(view.View, "still", functools.partialmethod(view.View.still, width=40))  # a picture of few pixels
    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, limits[1]))  # what allocates without end meets it
    yield
    resource.setrlimit(resource.RLIMIT_AS, limits)


def fresh(tmp_path, k):
    folder = tmp_path / str(k)
    folder.mkdir()
    os.chdir(folder)


# ---------------------------------------------------------------------- the table
def named(row):
    return " ".join(str(row.get(key, "")) for key in ("name", "change", "add", "text", "words", "says"))[:60].replace("\n", " ")


@pytest.mark.parametrize("row", TABLE["cases"], ids=named)
def test_case(row):
    text = row.get("text", CASE)
    text = FILES.get(text, text)
    for old, new in [row["change"]] if "change" in row else []:
        assert old in text
        text = text.replace(old, new)
    name = row.get("name", "emi.yaml")
    put(name, row["text"] if row.get("text") in ("folder", "missing") else text + row["add"] if "add" in row else text)
    for beside, what in row.get("files", {}).items():
        put(beside, what)
    words = ["shield", name, "--dry-run", "--mpirun", "/bin/true"]
    if row.get("right"):
        status, out, err = run(words)
        assert (status, err) == (0, "") and "sketch: " in out
        return
    said = refused(words, row)
    assert " ".join(row["says"].split()) in said, said
    assert "line" not in row or f"{name}, line {row['line']}: " in said, said


@pytest.mark.parametrize("row", TABLE["others"], ids=named)
def test_other(row):
    for name, what in row["files"].items():
        if isinstance(what, list):
            text, old, new = FILES[what[0]], *what[1:]
            assert old in text
            what = text.replace(old, new, 1)
        put(name, what)
    words = [*row["words"].split(), *(["--mpirun", "/bin/true"] if "--dry-run" in row["words"] else [])]
    if row.get("right"):
        status, _, err = run(words)
        assert (status, err) == (0, "")
    else:
        said = refused(words, row)
        assert row["says"] in said, said


# ---------------------------------------------------------------------- every key of a case, spoilt in every way
VALUES = {"nan": ".nan", "inf": ".inf", "minus": "-3", "zero": "0", "huge": "1e300", "tiny": "1e-300", "word": "big", "list": "[1, [2]]", "mapping": "{a: 1}", "nothing": "", "true": "true",
          "unit": "5 mm", "lines": '"a\\nshell touch stolen"', "formula": "$(1)", "path": "../../x", "tag": "!!python/name:os.system x"}
RIGHT = {("angle_deg", "zero"), ("angle_deg", "tiny"), ("projectile: pitch_deg", "minus"), ("projectile: pitch_deg", "zero"), ("projectile: pitch_deg", "tiny"), ("settings: tstop", "zero"),
         ("settings: back", "zero"), ("settings: back", "tiny"), ("settings: film", "zero"), ("settings: film", "minus")}
OF = {"side_mm": "shape: cube\n  side_mm: 5", "length_mm": "shape: cylinder\n  diameter_mm: 5\n  length_mm: 5", "pitch_deg": "shape: cylinder\n  diameter_mm: 5\n  length_mm: 5\n  pitch_deg: 5",
      "thickness_mm": "shape: hollow sphere\n  diameter_mm: 5\n  thickness_mm: 1.5", "file": "shape: file\n  file: x.stl", "shape": "shape: sphere\n  diameter_mm: 5"}
WORDS = {"not_modelled", *(f"settings: {name}" for name in ("kernel", "pair", "solid", "fem"))}  # whatever words: LAMMPS knows them


def spoilt_key(key, value):
    """the case with a value of that key"""
    head, _, name = key.rpartition(": ")
    if head == "settings":
        return CASE + f"settings:\n  {name}: {value}\n"
    text = CASE.replace("diameter_mm: 5", OF[name], 1) if head == "projectile" and name in OF else CASE
    indent = {"": "", "projectile": "  ", "walls": "    "}[head]
    old = re.search(rf"^{indent}(- )?{name}: .*(\n .*)*\n" if head == "" else rf"^{indent.removesuffix('    ') or '  '}(?:  |- ){name}: .*\n" if head == "walls" else rf"^{indent}{name}: .*\n",
                    text[text.index("- thickness"):] if head == "walls" else text, re.M)
    if old:
        first = "  - " if old[0].startswith("  - ") else indent
        return text.replace(old[0], f"{first}{name}: {value}\n")
    return text.replace("    gap_mm: 60\n", f"    gap_mm: 60\n    {name}: {value}\n") if head == "walls" else text + f"{name}: {value}\n"


@pytest.mark.parametrize("key", every_third([key for key, *_ in cases.rows_of_keys()]))
def test_every_key(key, tmp_path):
    name, count = key.rpartition(": ")[2], 0
    for k, (how, value) in enumerate(VALUES.items()):
        fresh(tmp_path, k)
        put("emi.yaml", spoilt_key(key, value))
        words = ["shield", "emi.yaml", "--dry-run", "--mpirun", "/bin/true"]
        plain = key in WORDS and how in ("nan", "inf", "minus", "zero", "huge", "tiny", "word", "true", "unit", "path", "tag") and key != "not_modelled"
        if (key, how) in RIGHT or plain:
            status, _, err = run(words)
            assert status == 0 and err == "", f"{key}: {value}: {err}"
            continue
        said = refused(words, f"{key}: {value}")
        assert name in said and "emi.yaml, line " in said, f"{key}: {value}: {said}"
        count += 1
    assert count > 3
    fresh(tmp_path, "twice")
    text = spoilt_key(key, "1")
    line = re.findall(rf"^.*\b{name}: 1\n", text, re.M)[-1]
    put("emi.yaml", text.replace(line, line + line.replace("- ", "  ")))
    assert name in refused(["shield", "emi.yaml", "--dry-run"], key)
    fresh(tmp_path, "unknown")
    put("emi.yaml", spoilt_key(key, "1").replace(line, line.replace(name, name + "x")))
    assert f"{name}x: no such key" in refused(["shield", "emi.yaml", "--dry-run"], key)


def test_every_key_has_a_row():
    """of the tables of keys, beside what test_every_key does with all of them"""
    text = " ".join(str(row) for row in TABLE["cases"])
    assert [key for key, *_ in cases.rows_of_keys() if key.rpartition(": ")[2] not in text and key != "not_modelled"] == []
    assert len(TABLE["cases"]) >= 100 and set(TABLE["commands"]) == set(cli.COMMANDS)


# ---------------------------------------------------------------------- every command
@pytest.mark.parametrize("command", every_third(TABLE["commands"]))
def test_every_command(command, tmp_path):
    """its words are right; each of its files spoilt, and each of its options, is an error in one line, or no matter"""
    row = TABLE["commands"][command]
    words = [command, *row["words"].split()]
    more = ["--mpirun", "/bin/true"] if "--dry-run" in words else []
    k = itertools.count()

    def beside(**changed):
        fresh(tmp_path, next(k))
        for name, what in row["files"].items():
            put(name, changed.get("what", what) if name == changed.get("name") else what)

    beside()
    if "says" in row:
        assert row["says"] in refused([*words, *more], command)
    else:
        status, _, err = run([*words, *more])
        assert status in (0, 4) and err == "", f"{command}: {err}"
    for name in row["files"]:
        for how, what in SPOILT.items():
            if (command, how) in RUNS:
                continue
            beside(name=name, what=what)
            said = refused([*words, *more], f"{command}, {name} {how}")
            assert name in said, f"{command}, {name} {how}: {said}"
        data = FILES.get(row["files"][name], "").encode()
        for how, what in (("crlf", data.replace(b"\n", b"\r\n")), ("mark", b"\xef\xbb\xbf" + data)):
            if row["files"][name] == "dump" and how == "mark":
                continue  # what LAMMPS writes has none
            beside()
            pathlib.Path(name).write_bytes(what)
            status, _, err = run([*words, *more])
            assert row.get("says", "") in err if "says" in row else status in (0, 4) and err == "", f"{command}, {name} {how}: {err}"


NUMBERS = "nan inf -1 0 1e300 1e-300 1e9 99999999999999999999 x".split() + [""]
PLACES = {"--runs", "--write", "--out", "--figure", "--file", "--lmp", "--mpirun"}  # of files: any name is one


@pytest.mark.parametrize("command", every_third(TABLE["commands"], ("limits", "view")))
def test_every_option(command, tmp_path, monkeypatch):
    """with values that are none: an error in one line, or it runs and leaves no traceback"""
    row = TABLE["commands"][command]
    parser = next(action for action in cli.options(command)._actions if isinstance(action, argparse._SubParsersAction)).choices[command]
    monkeypatch.setattr(style, "DPI", 10)
    words = [command, *row["words"].split(), *(["--mpirun", "/bin/true"] if "--dry-run" in row["words"] else [])]
    for option in (action for action in parser._actions if action.option_strings and action.nargs != 0 and not set(action.option_strings) & PLACES):
        for value in NUMBERS:
            fresh(tmp_path, f"{option.dest}-{NUMBERS.index(value)}")
            for name, what in row["files"].items():
                put(name, what)
            number = option.nargs if isinstance(option.nargs, int) else 1
            name = option.option_strings[-1]
            status, out, err = run([*words, f"{name}={value}"] if number == 1 else [*words, name, *[value] * number])
            lines = [line for line in err.splitlines() if not line.startswith("hvi: warning: ") and (status != 2 or ": error: " in line)]
            answered = status == 1 and out and command in ("hole", "compare")  # there is none, they differ
            assert answered or status in (0, 1, 2, 4) and len(lines) == (status in (1, 2)), f"{words} {name} {value!r}: {status} {err}"
