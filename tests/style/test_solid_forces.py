"""Solids in scenes: every layout, restart with stress and damage, books, gradients along any axes; their forces are in test_corrected.py."""

import itertools

import numpy as np
import pytest
from solid_runs import material as metal
from solid_scenes import OUT, as_tensor, read, start, state
from sph_scenes import Fluid, scene


ART = "viscosity 1 2 artstress 0.3 4"


def test_no_artificial_stress(lmp, tmp_path, material):
    """eps 0 is none at all"""
    s, found = state(seed=26), []
    for words in ("viscosity 1 2", "viscosity 1 2 artstress 0 4"):
        lmp(start(s, tmp_path, material, words=words, steps=10) + OUT.format("f"))
        found.append(read(tmp_path / "f"))
    for name in found[0]:
        assert np.array_equal(found[0][name], found[1][name]), name


@pytest.mark.each_value
@pytest.mark.parametrize("words", ["viscosity 1 2", ART], ids=["", "artstress"])
@pytest.mark.parametrize("nranks", [1, *(pytest.param(n, marks=pytest.mark.long) for n in (2, 3)), 4])
def test_layouts(lmp, tmp_path, material, nranks, words):
    """newton on and off, brick and tiled, 20 steps with stress: as on one rank"""
    s = state(seed=22)
    s.rho *= 0.97
    cases = list(itertools.product(("on", "off"), ("brick", "tiled")))
    text = "".join("clear\n" + start(s, tmp_path, material, words, steps=20, newton=newton, comm=comm) + OUT.format(f"f.{k}")
                   for k, (newton, comm) in enumerate(cases))
    lmp(start(s, tmp_path, material, words, steps=20) + OUT.format("one"))
    lmp(text, nranks=nranks)
    one = read(tmp_path / "one")
    assert one["eps"].max() > 0.01
    for k, case in enumerate(cases):
        got = read(tmp_path / f"f.{k}")
        for name in ("x", "v", "f", "S", "eps", "damage", "de"):
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * np.abs(one[name]).max(), (case, name)


@pytest.mark.each_value
@pytest.mark.parametrize("words", ["viscosity 1 2", ART], ids=["", "artstress"])
@pytest.mark.parametrize("nranks", [1, 2])
def test_restart(lmp, tmp_path, material, nranks, words):
    """30 steps, restart, 30 more: the same bits as 60 at once"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, words, steps=0, sort=False, more="restart 30 half\n") + "run 59\n" + OUT.format("whole"), nranks=nranks)
    text = "read_restart half.30\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix sph all hvi/sph\n"
    lmp(text + "fix jc all hvi/johnson-cook\ntimestep 0.004\nrun 29\n" + OUT.format("part"), nranks=nranks)
    one, two = read(tmp_path / "whole"), read(tmp_path / "part")
    assert one["damage"].max() >= 1 and one["eps"].max() > 0.05
    for name in one:
        assert np.array_equal(one[name], two[name]), name


@pytest.mark.parametrize("jc, words", [("", ART), pytest.param("damage no spall none", ART, marks=pytest.mark.long), *((jc, "viscosity 1 2") for jc in (
    "", "damage no spall none", "spall pressure", "spall zero damage no", "temperature work"))])
def test_books_close(lmp, tmp_path, material, jc, words):
    """energy to 1e-3, momentum to round-off, whatever the model"""
    s = state(seed=24)
    more = "fix step all hvi/dt 0.2\ncompute book all hvi/energy\nthermo 10\nthermo_style custom step c_book[1] c_book[2] c_book[9] c_book[10] c_book[11]\n"
    t = lmp(start(s, tmp_path, material, words, steps=0, jc=jc, more=more + "thermo_modify format float %.17g\nrun 300\n")).thermo
    assert np.abs(t["c_book[9]"] - 1).max() < 1e-3
    assert t["c_book[1]"][-1] < 0.9 * t["c_book[1]"][0]
    for k in (10, 11):
        assert np.abs(t[f"c_book[{k}]"] - t[f"c_book[{k}]"][0]).max() < 1e-11


# turns of the axes: a is where the first of a scene in x, or in x and y, points to, b the second
LINES, PLANES = [("x", "y"), ("y", "z"), ("z", "x")], [("x", "y"), ("y", "z"), ("z", "x"), ("x", "z"), ("z", "y")]


def flat(dim, axes):
    """a jittered row or sheet of particles in a box of three dimensions, in a linear velocity field; the field; how it is turned"""
    rng = np.random.default_rng(71)
    n = {1: 16, 2: 8}[dim]
    grid = np.stack(np.meshgrid(*[np.arange(n)] * dim, indexing="ij"), -1).reshape(-1, dim) + rng.uniform(-0.15, 0.15, (n**dim, dim))
    x = np.zeros((len(grid), 3))
    x[:, :dim] = grid - grid.mean(0)
    L = np.zeros((3, 3))
    L[:dim, :dim] = np.array([[0.5, -0.7], [0.4, -0.2]])[:dim, :dim]
    v = x @ L.T
    turn = ["xyz".index(a) for a in axes]
    turn.append(3 - sum(turn))
    back = np.argsort(turn)
    ones = np.ones(len(x))
    return Fluid(x[:, back] + 10.0, v[:, back], ones, 0 * ones, ones.astype(int), {1: 1.0}, {1: 1.3}, np.full(3, 20.0), (False,) * 3), L, turn


@pytest.mark.parametrize("dim, turns", [(1, LINES), (2, PLANES)])
def test_corrected_gradient_along_any_axes(lmp, tmp_path, dim, turns):
    """rows along x, y, z, sheets in all planes: exact in a linear field, at edges and corners too, and the same in all of them"""
    path = metal(tmp_path / "m.hvi", "eos gruneisen rho0 1.0 C 4.0 S1 1.4 g0 2.0 a 0.5 cp 1.0 T0 300", "strength perfect G 6.0 Y 1e3")
    pair = f"pair_style hvi/sph cubic dim {dim}\npair_coeff 1 1 file {path} h 1.3\n"
    text, dt = "", 1e-4
    for k, axes in enumerate(turns):
        s, L, _ = flat(dim, axes)
        text += "clear\n" + scene(s, tmp_path / f"s{k}.data", pair) + f"fix jc all hvi/johnson-cook strength perfect damage no spall none\ntimestep {dt}\n"
        text += "run 1\n" + OUT.format(f"a{k}") + "timestep 0.02\nrun 8\n" + OUT.format(f"b{k}")
    lmp(text)
    D = 0.5 * (L + L.T)
    want = 2 * 6.0 * (D - np.trace(D) / 3 * np.eye(3)) * dt
    first = None
    for k, axes in enumerate(turns):
        turn = flat(dim, axes)[2]
        early, late = read(tmp_path / f"a{k}"), read(tmp_path / f"b{k}")
        S = as_tensor(early)[:, turn][:, :, turn]
        assert np.abs(S - want).max() <= 1e-3 * np.abs(want).max(), axes
        found = dict(early=S, late=as_tensor(late)[:, turn][:, :, turn], f=late["f"][:, turn], de=late["de"], drho=late["drho"])
        first = first or found
        for name in found:
            assert np.abs(found[name] - first[name]).max() <= 1e-12 * np.abs(first[name]).max(), (axes, name)
