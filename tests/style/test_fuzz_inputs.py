"""Random inputs out of the keywords of our pages end well or with a message of LAMMPS; what was found once stays mended. More of them: make fuzz."""

import pathlib
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))
import grammar  # noqa: E402
import inputs  # noqa: E402

FOUND = {path.stem: path for path in sorted((pathlib.Path(grammar.__file__).parent / "found" / "lammps").glob("*.in"))}
INTERNAL = {"fix_hvi_ledger", "fix_hvi_lists", "fix_hvi_store"}
PAGES = {path.stem for kind in ("pair", "bond", "fix", "compute") for path in grammar.PAGES.glob(f"{kind}_hvi_*.rst")} - INTERNAL


@pytest.mark.parametrize("page", sorted(PAGES))
def test_every_keyword_has_a_rule(page):
    """a new keyword of a page must get one"""
    assert grammar.keywords(page) == set(grammar.RULES.get(page, ()))


@pytest.mark.parametrize("name", FOUND)
def test_what_was_found(lmp_exe, tmp_path, name):
    path = FOUND[name]
    grammar.beside(tmp_path)
    wrong, message = inputs.check(lmp_exe, shutil.copy(path, tmp_path), 300)
    assert not wrong, wrong
    expected = [line.partition("says ")[2] for line in path.read_text().splitlines() if line.startswith("# says ")]
    assert all(text in message for text in expected) and bool(expected) == bool(message), message


def test_pre_no_is_as_pre_yes(lmp_exe, tmp_path):
    """where a fix is gone, and the next run is told not to set up"""
    grammar.beside(tmp_path)
    for word in ("no", "yes"):
        text = FOUND["unfix-pre-no"].read_text().partition("run 3")[0]
        (tmp_path / "in.fuzz").write_text(f"{text}run 3 pre {word}\nwrite_dump all custom {word} id x y z vx vy vz fx fy fz modify format float %.17g sort id\n")
        assert inputs.check(lmp_exe, tmp_path / "in.fuzz", 300) == ("", "")
    assert (tmp_path / "no").read_text() == (tmp_path / "yes").read_text()


def test_random_inputs(lmp_exe, tmp_path):
    n, ran, found, messages = inputs.run(lmp_exe, tmp_path, "short", count=12)
    assert n == 12 and not found, found
    assert ran >= 4, messages


@pytest.mark.long
def test_more_random_inputs(lmp_exe, tmp_path):
    n, ran, found, messages = inputs.run(lmp_exe, tmp_path, "long", count=150)
    assert n == 150 and not found, found
    assert ran > 40, messages


PROGRAMS = {  # in place of LAMMPS: what is said to be wrong of it
    "kill -SEGV $$": "without a message", "sleep 20": "no end", "exit 1": "without a message", "echo 'x.cpp:3: runtime error: shift'; echo 'ERROR: x'; exit 1": "runtime error",
    "echo 'ERROR on proc 0: x (y.cpp:3)'; exit 1": "", "exit 0": ""}


@pytest.mark.parametrize("program", PROGRAMS)
def test_it_finds(tmp_path, program):
    (tmp_path / "in.fuzz").write_text("run 0\n")
    (tmp_path / "lmp").write_text(f"#!/bin/sh\n{program}\n")
    (tmp_path / "lmp").chmod(0o755)
    wrong, message = inputs.check(tmp_path / "lmp", tmp_path / "in.fuzz", 5)
    what = PROGRAMS[program]
    assert what in wrong and bool(what) == bool(wrong), wrong
    assert message == ("ERROR on proc 0: x (y.cpp:3)" if "on proc" in program else "")


def test_an_input_is_that_of_its_seed(tmp_path):
    one, two, other = (grammar.write(seed, tmp_path / str(k))[0].read_text() for k, seed in enumerate(("a", "a", "b")))
    assert one == two != other
