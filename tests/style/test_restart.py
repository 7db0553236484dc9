"""A run that is interrupted while bonds break goes on as if it had not been."""

import numpy as np
import pytest
from dumps import read_dump
from scenes import BONDS, DUMP, LEDGER, collision, ledger, read_bonds, scene

MIDDLE, END = 385, 485  # the step is growing there: a new choice would differ
LOCAL = "compute B all property/local batom1 batom2\n"
FIXES = "fix nve all nve\nfix step all hvi/dt 0.1\n"
THERMO = ledger(every=5, more="f_step[*]") + "thermo_modify norm no\n"


def whole_run(newton="on"):
    text = scene(collision(), "s.data", sort=False, newton=newton)
    text += FIXES + THERMO + f"restart {MIDDLE} half\nrun {END}\n"
    return text + DUMP.format("whole") + BONDS.format("b.whole")


def continued_run(newton="on", comm="brick"):
    text = f"newton {newton}\ncomm_style {comm}\nread_restart half.{MIDDLE}\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
    text += LOCAL + FIXES + THERMO
    text += "balance 1.0 rcb\n" if comm == "tiled" else ""  # LAMMPS forgets what it read for fixes that are not there yet
    return text + f"run {END - MIDDLE}\n" + DUMP.format("part") + BONDS.format("b.part")


@pytest.mark.parametrize("nranks, newton", [(1, "on"), (1, "off"), (2, "on")])
def test_bit_exact_on_the_same_ranks(lmp, tmp_path, nranks, newton):
    """positions, velocities, forces, bonds, time, step and every ledger entry: the same bits, without sorting"""
    whole = lmp(whole_run(newton), nranks=nranks).thermo
    part = lmp(continued_run(newton), nranks=nranks).thermo
    a, b = read_dump(tmp_path / "whole"), read_dump(tmp_path / "part")
    assert all(np.array_equal(a[name], b[name]) for name in a)
    assert read_bonds(tmp_path / "b.whole") == read_bonds(tmp_path / "b.part")
    later = whole["Step"] >= MIDDLE
    assert np.array_equal(whole["Step"][later], part["Step"])
    for name in whole:
        # the sums over pairs of the first step of a run are added up in setup, in the same order
        assert np.array_equal(whole[name][later], part[name]), name
    left = whole["Bonds"]
    assert part["f_step[3]"][0] == 4
    assert left[0] > left[whole["Step"] == MIDDLE][0] > left[-1]  # in the middle of breaking


@pytest.mark.parametrize("first, second, newton, comm", [(1, 2, "on", "tiled"), (2, 3, "on", "brick"), (2, 1, "off", "brick")])
def test_other_layouts(lmp, tmp_path, first, second, newton, comm):
    """on another number of ranks or another division of space: ledger totals carried on, the same bonds in this short run"""
    whole = lmp(whole_run(newton), nranks=first).thermo
    part = lmp(continued_run(newton, comm), nranks=second).thermo
    k = np.flatnonzero(whole["Step"] == MIDDLE)[0]
    for c, name in enumerate(LEDGER):
        scale = whole["c_book[8]"][0] if c < 8 else max(1.0, np.abs(whole[f"c_book[{c + 1}]"]).max())
        assert part[f"c_book[{c + 1}]"][0] == pytest.approx(whole[f"c_book[{c + 1}]"][k], abs=1e-12 * scale), name
    assert part["c_book[5]"][0] > 0 and part["c_book[22]"][0] > 0
    assert np.abs(part["c_book[9]"] - 1).max() < 5e-5
    assert part["Bonds"][-1] == pytest.approx(whole["Bonds"][-1], rel=1e-3)
    assert len(read_bonds(tmp_path / "b.part") ^ read_bonds(tmp_path / "b.whole")) <= 1


def test_start_energy_is_remembered(lmp):
    """total/initial refers to the start of the first run: what is taken from a continued one shows"""
    whole = lmp(whole_run()).thermo
    part = lmp(continued_run() + "velocity all set 0 0 0\nrun 0\n").thermo
    assert part["c_book[1]"][0] == 0.0
    assert part["c_book[8]"][0] == pytest.approx(whole["c_book[8]"][-1] - whole["c_book[1]"][-1], rel=1e-9)
    assert part["c_book[9]"][0] == pytest.approx(part["c_book[8]"][0] / whole["c_book[8]"][0], rel=1e-14)
    assert part["c_book[9]"][0] < 0.9


def test_second_run_command(lmp):
    """run 200 twice books what run 400 books"""
    text = scene(collision(), "s.data", sort=False) + FIXES + "unfix step\ntimestep 3e-4\n" + THERMO.replace("f_step[*]", "")
    one = lmp(text + "run 800\n").thermo
    two = lmp(text + "run 400\nrun 400\n").thermo
    assert two["Bonds"][-1] == one["Bonds"][-1] < 600
    assert two["c_book[5]"][-1] == pytest.approx(one["c_book[5]"][-1], rel=1e-9)
    assert two["c_book[8]"][-1] == pytest.approx(one["c_book[8]"][-1], rel=1e-9)
