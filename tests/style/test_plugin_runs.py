"""The plugin in a stock LAMMPS computes what the built-in styles compute, to the last bit."""

import numpy as np
import pytest
from dumps import read_dump
from scenes import BONDS, DUMP, collision, ledger, read_bonds, scene


def outcome(cwd, result, name):
    return result.thermo, read_dump(cwd / f"d.{name}"), read_bonds(cwd / f"b.{name}")


def same(a, b):
    return all(np.array_equal(x[n], y[n]) for x, y in zip(a[:2], b[:2]) for n in x) and a[2] == b[2]


def scene_to_run():
    text = scene(collision(4), "s.data") + "fix nve all nve\nfix step all hvi/dt 0.1 max 0.001\n"
    return text + ledger(every=20) + "run 500\n"


@pytest.fixture
def built_in(lmp, tmp_path):
    return outcome(tmp_path, lmp(scene_to_run() + DUMP.format("d.0") + BONDS.format("b.0")), "0")


@pytest.mark.parametrize("how", ["plugin load", "LAMMPS_PLUGIN_PATH"])
def test_same_numbers(lmp, lmp_stock, plugin, tmp_path, built_in, how):
    """loaded by command or found by itself"""
    load, env = (f"plugin load {plugin}\n", {}) if how == "plugin load" else ("", {"LAMMPS_PLUGIN_PATH": str(plugin.parent)})
    result = lmp(load + scene_to_run() + DUMP.format("d.1") + BONDS.format("b.1"), exe=lmp_stock, env=env)
    assert same(outcome(tmp_path, result, "1"), built_in)
    assert built_in[0]["Bonds"][-1] < built_in[0]["Bonds"][0]


@pytest.mark.parametrize("way", ["built in", "plugin", "plugin path"])
def test_clear_and_again(lmp, lmp_stock, lmp_exe, plugin, tmp_path, built_in, way):
    """after clear the same run gives the same bits, and nothing of the first ledger is left"""
    load = f"plugin load {plugin}\n" if way == "plugin" else ""
    env = {"LAMMPS_PLUGIN_PATH": str(plugin.parent)} if way == "plugin path" else {}
    tail = [DUMP.format(f"d.{k}") + BONDS.format(f"b.{k}") for k in (1, 2)]
    result = lmp(load + scene_to_run() + tail[0] + "clear\n" + load + scene_to_run() + tail[1], exe=lmp_exe if way == "built in" else lmp_stock, env=env)
    assert len(result.runs) == 2
    for k in (0, 1):
        got = (result.runs[k], read_dump(tmp_path / f"d.{k + 1}"), read_bonds(tmp_path / f"b.{k + 1}"))
        assert same(got, built_in), k


def test_without_the_plugin_stock_says_so(lmp, lmp_stock, built_in):
    """stock LAMMPS alone does not know the styles"""
    assert "hvi/contact" in lmp(scene_to_run(), exe=lmp_stock, expect_fail=True).error


def test_plugin_on_two_ranks(lmp, lmp_stock, plugin):
    """plugin and built-in agree on two ranks too"""
    short = scene_to_run().replace("run 500", "run 40")
    a, b = lmp(short, nranks=2).thermo, lmp(f"plugin load {plugin}\n" + short, exe=lmp_stock, nranks=2).thermo
    assert all(np.array_equal(a[n], b[n]) for n in a)
