"""Elements in restart and data files: a run that is interrupted goes on as if it had not been, with elements that have become particles."""

import itertools
import re

import numpy as np
import pytest
from fem_scenes import OPEN, PULL, STATE, laws, opened, opens, plate, read_state, start, strike_plate

# faces that stay: those of a shrunk box move by a part of what the box was when LAMMPS read it, so that after a restart bins of
# neighbors, and the order of sums with them, may be others
BOX = dict(boundary="f f f", box=" ".join(["-4e-3 4e-3"] * 3))
FAILS = "strain 0.1 probe 2e-3 2e-3 -1e-3"  # the first elements become particles at step 27, and 8 more soon after
MIDDLE, END = 30, 36


def whole(rest, **more):
    mesh, strike_it = strike_plate()
    return start(mesh, fem=FAILS, every=5, more="f_wall[1][1] f_wall[1][7] f_wall[1][11]", **{**BOX, **more}) + strike_it + rest


def continued(read="read_restart half", fem=FAILS, newton="on", **more):
    """the same words without the box and what is in it"""
    mesh, _ = strike_plate()
    text = start(mesh, fem=fem, every=5, more="f_wall[1][1] f_wall[1][7] f_wall[1][11]", newton=newton, data="again.data", **{**BOX, **more})
    last = text.index("pair_style")
    head = f"newton {newton}\n" + ("atom_modify sort 0 0\n" if read.startswith("read_restart") else "")
    if read.startswith("read_restart"):
        head += read + "\nfix prop all property/atom rmass ghost yes\n"
    else:
        head = text[:last]
    body = text[last:].split("\n")
    at = next(k for k, line in enumerate(body) if line.startswith("read_data"))
    body[at] = "" if read.startswith("read_restart") else read
    return head + "\n".join(body)


def same(a, b, tolerance=0.0, renumbered=False):
    if renumbered:  # read_data ... add append: IDs begin at 1 again, in the order they had
        a, b = ({k: v for k, v in one.items() if k != "id"} for one in (a, b))
    for name in a:
        assert np.abs(a[name] - b[name]).max() <= tolerance * np.abs(a[name]).max(), name


def books(a, b, tolerance=0.0):
    later = a["Step"] >= b["Step"][0]
    for name in a:
        size = np.abs(a["c_book[12]" if name in ("c_book[10]", "c_book[11]") else name]).max()
        assert np.abs(a[name][later] - b[name]).max() <= tolerance * size, name


TIMES = [(10, 12), (20, 22), (MIDDLE, END)]


@pytest.mark.each_value
@pytest.mark.parametrize("spall, ranks, times", [
    *itertools.product(["none"], [(1, "on"), (2, "on"), (2, "off")], TIMES), *itertools.product(["voids"], [(1, "on"), (2, "on")], TIMES[::2])])
def test_goes_on(lmp, tmp_path, spall, ranks, times):
    """states, forces, the step, all that is booked, probes, with open voids too: the same bits"""
    (nranks, newton), (middle, end), (law, pull) = ranks, times, laws(spall, tmp_path)
    a = lmp(whole(pull + f"restart {middle} half\nrun {end}\n" + STATE.format("whole"), newton=newton, **law), nranks=nranks).runs[0]
    again = continued(f"read_restart half.{middle}", newton=newton, **law)
    b = lmp(again + f"run {end - middle}\n" + STATE.format("part") + OPEN, nranks=nranks).runs[0]
    books(a, b)
    same(read_state("whole"), read_state("part"))
    assert (b["f_wall"][0] < 64) == (middle == MIDDLE) and (end < END or b["f_wall"][-1] < b["f_wall"][0])
    assert a["Dt"].min() < a["Dt"].max() and np.abs(b["f_wall[1][1]"]).min() > 0
    if law:
        opened()


@pytest.mark.parametrize("first, second", [(1, 3), (3, 2)])
def test_other_ranks(lmp, first, second):
    a = lmp(whole(f"run {MIDDLE}\nwrite_restart half\nrun {END - MIDDLE}\n" + STATE.format("whole")), nranks=first).runs[1]
    b = lmp(continued() + f"run {END - MIDDLE}\n" + STATE.format("part"), nranks=second).runs[0]
    books(a, b, 1e-10)
    same(read_state("whole"), read_state("part"), 1e-10)


def test_changed_after_a_restart(lmp):
    """forces anew"""
    change = "velocity all set 0 0 0\nrun 0\n"
    lmp(whole(f"run {MIDDLE}\nwrite_restart half\n" + change + STATE.format("whole")))
    lmp(continued() + change + STATE.format("part"))
    a, b = read_state("whole"), read_state("part")
    same(a, b, 1e-12)
    assert np.abs(a["V"]).max() == 0.0 < np.abs(a["F"]).max()


def test_wrong_fixes_after_a_restart(lmp):
    """without the fix nodes are particles of no material; with another ID elements are missing"""
    lmp(whole(f"run {MIDDLE}\nwrite_restart half\n"))
    text = continued()
    r = lmp("\n".join(line for line in text.split("\n") if "f_wall" not in line and "fix wall" not in line) + "run 1\n", expect_fail=True)
    assert "type 3 has no material" in r.error
    r = lmp(text.replace("fix wall", "fix other").replace("f_wall", "f_other") + "run 1\n", expect_fail=True)
    assert "has no elements" in r.error


def test_all_elements_gone(lmp):
    """a run, and a restart file, in which nothing is left of the mesh but its particles"""
    text = whole("run 60\nrun 5\nwrite_restart half\n").replace("strain 0.1", "strain 1e-12")
    r = lmp(text)
    assert r.runs[1]["f_wall"][-1] == 0
    assert (r.runs[1]["Atoms"][-1] == len(strike_plate()[0].free) + 8 * 64).all()
    r = lmp(continued(fem=FAILS.replace("strain 0.1", "strain 1e-12")) + "run 5\n")
    assert r.thermo["f_wall"][-1] == 0


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("spall, middle", [("none", 20), ("none", 30), ("voids", 30)])
def test_data_file(lmp, tmp_path, nranks, spall, middle):
    """write_data, read_data with all sections: the state to its digits, and then the run as if not interrupted"""
    def fixed(text):  # the step of fix hvi/dt grows from what is stable, also after a data file
        return re.sub(r"fix step all hvi/dt \S+", "timestep 1e-8", text)

    law, pull = laws(spall, tmp_path)
    first = pull + f"run {middle}\nwrite_data half.data\n" + STATE.format("half") + OPEN
    lmp(fixed(whole(first + f"run {END - middle}\n" + STATE.format("whole"), **law)))
    if law:
        opened()
    found = [line.split("#")[0].strip() for line in open("half.data") if line[:1].isalpha()]
    words = []
    for name in found:
        owner = {"wall": "wall", "move": "move", "soli": "solid"}.get(name[:4])
        if name == "Elements":
            words.append("fix wall elements Elements")
        elif name == "prop":
            words.append("fix prop NULL prop")
        elif owner:
            words.append(f"fix {owner} NULL {name}")
    assert sum(w.startswith("fix wall NULL wall_state_") for w in words) > 10
    assert any("solid_voids" in w for w in words) == bool(law)
    text = fixed(continued("read_data half.data add append " + " ".join(words), **law))
    lmp(text + "run 0\n" + STATE.format("read") + f"run {END - middle}\n" + STATE.format("part"), nranks=nranks)
    half, read, whole_, part = (read_state(f) for f in ("half", "read", "whole", "part"))
    same(half, read, 1e-12, renumbered=True)
    same(whole_, part, 1e-12, renumbered=True)
    # what is not asked for is not lost without a word
    for k, w in enumerate(words):
        if k in (0, 3) or "prop" in w:
            r = lmp(text.replace(w, ""), expect_fail=True)
            assert "Unknown identifier in data file" in r.error or "Unknown" in r.error, w


@pytest.mark.parametrize("nranks", [1, 2])
def test_another_law(lmp, tmp_path, nranks):
    """elements keep their voids when fix hvi/johnson-cook is given anew: another law of spall is refused, with particles in them or not"""
    law = opens(tmp_path / "opens.hvi")
    for n in (0, 2):
        text = start(plate(core=0, n=n), **law) + PULL + "run 20\nunfix solid\nfix solid all hvi/johnson-cook damage no spall {}\nrun 1\n"
        lmp(text.format("voids"), nranks=nranks)
        for other in ("none", "principal"):
            r = lmp(text.format(other), nranks=nranks, expect_fail=True)
            assert "has voids, by spall voids, which its type does not have in this run" in r.error, r.error


def test_a_run_that_ends_early(lmp):
    """fix halt, between outputs: files written then have the same as those of a run to that step"""
    halt = "variable step equal step\nfix stop all halt 1 v_step >= 23 error continue\n"
    early = whole(halt + "run 60\n" + STATE.format("early")).replace("thermo 5\n", "thermo 1000\n")
    assert "thermo 1000" in early
    lmp(early)
    lmp(whole("run 23\n" + STATE.format("right")))
    same(read_state("early"), read_state("right"))


@pytest.mark.parametrize("nranks", [1, 2])
def test_books_that_begin_late(lmp, nranks):
    """compute hvi/energy of a run that goes on: its first total is what the first line says, with energies of particles and elements as they are, not
    as forces are asked for"""
    text = whole("run 20\n")
    book = next(line for line in text.splitlines() if line.startswith("compute book"))
    shown = [line for line in text.splitlines() if line.startswith(("thermo_style", "thermo_modify"))]
    early = lmp(text + "run 5\n", nranks=nranks).runs[1]
    text = "\n".join(line for line in text.splitlines() if line not in (book, *shown))
    late = lmp(text + "\n" + "\n".join([book, *shown]) + "\nrun 5\n", nranks=nranks).thermo
    assert np.array_equal(early["c_book[8]"], late["c_book[8]"]) and early["f_wall[10]"][0] > 0 and early["Dt"].min() > 0
    assert late["c_book[9]"][0] == pytest.approx(1.0, abs=1e-14)
    assert late["c_book[9]"][-1] == pytest.approx(late["c_book[8]"][-1] / late["c_book[8]"][0], abs=1e-14)
