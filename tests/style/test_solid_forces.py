"""Solids in scenes: every layout, restart with stress and damage, books, gradients along any axes; their forces are in test_corrected.py."""

import itertools

import numpy as np
import pytest
from solid_runs import material as metal
from sph_scenes import Fluid, random_fluid, scene

# si-like numbers in lj units: rho0 1, c0 4; strength and damage so that a part yields, some fail
MATERIAL = """# DATE: 2026-01-01 UNITS: lj CONTRIBUTOR: test CITATION: none
eos gruneisen
  rho0 1.0
  C 4.0
  S1 1.4
  g0 2.0
  a 0.5
  cp 1.0
  T0 300
strength johnson-cook
  G 6.0
  A 0.25
  B 0.4
  n 0.4
  C 0.01
  m 1.0
  epsdot0 1.0
  Tref 300
  Tm 900
damage johnson-cook
  D1 0.02
  D2 0.04
  D3 -1.5
  D4 0.01
  D5 0.5
  epsdot0 1.0
spall limit
  sigma_p {sigma_p}
"""
PAIR = "pair_style hvi/sph {kernel} {words}\npair_coeff 1 1 file {path} h 1.25\npair_coeff 2 2 file {path} h 1.25\n"
OUT = """compute S all hvi/atom p c eps damage spalled vm sxx syy szz sxy sxz syz
compute R all property/atom drho desph rho esph
dump d all custom 1 {0} id type x y z vx vy vz fx fy fz c_R[1] c_R[2] c_R[3] c_R[4] c_S[*]
dump_modify d format float %.17g sort id
run 0
undump d
uncompute S
uncompute R
"""


def read(path):
    lines = path.read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    a = np.array([line.split() for line in lines[start:]], dtype=float)
    out = dict(type=a[:, 1].astype(int), x=a[:, 2:5], v=a[:, 5:8], f=a[:, 8:11], drho=a[:, 11], de=a[:, 12], rho=a[:, 13], esph=a[:, 14])
    out.update(zip(("p", "c", "eps", "damage", "spalled", "vm"), a[:, 15:21].T), S=a[:, 21:27])
    return out


def state(seed=21, speed=0.35, **kw):
    s = random_fluid(8, seed=seed, jitter=0.05, speed=speed, h=1.25, types=2, **kw)
    s.mass = {1: 1.0, 2: 1.0}
    s.rho = np.ones(len(s.x))
    s.esph = np.zeros(len(s.x))
    s.h = {1: 1.25, 2: 1.25}
    # a field with shear, compression and stretch, smooth
    k = 2 * np.pi / s.box[0]
    s.v += 0.8 * np.stack([np.sin(k * s.x[:, 1]), np.sin(k * s.x[:, 2]) + np.sin(k * s.x[:, 1]), np.cos(k * s.x[:, 0])], -1)
    return s


@pytest.fixture
def material(tmp_path):
    path = tmp_path / "test.hvi"
    path.write_text(MATERIAL.format(sigma_p=3.0))
    return path


def start(s, tmp_path, material, words="viscosity 1 2", tension="yes", more="", steps=40, jc="", kernel="cubic", **kw):
    pair = PAIR.format(kernel=kernel, words=words, path=material) + f"pair_coeff 1 2 tension {tension}\n"
    text = scene(s, tmp_path / "s.data", pair, **kw) + f"fix jc all hvi/johnson-cook {jc}\ntimestep 0.004\n"
    return text + more + (f"run {steps}\n" if steps else "")


def as_tensor(d):
    """the deviator, from the whole stress of the dump"""
    xx, yy, zz, xy, xz, yz = (d["S"] + np.outer(d["p"], [1, 1, 1, 0, 0, 0])).T
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)


ART = "viscosity 1 2 artstress 0.3 4"


def test_no_artificial_stress(lmp, tmp_path, material):
    """eps 0 is none at all"""
    s, found = state(seed=26), []
    for words in ("viscosity 1 2", "viscosity 1 2 artstress 0 4"):
        lmp(start(s, tmp_path, material, words=words, steps=10) + OUT.format("f"))
        found.append(read(tmp_path / "f"))
    for name in found[0]:
        assert np.array_equal(found[0][name], found[1][name]), name


@pytest.mark.parametrize("words", ["viscosity 1 2", ART], ids=["", "artstress"])
@pytest.mark.parametrize("nranks", [1, 2, 3, 4])
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


@pytest.mark.parametrize("jc, words", [("", ART), ("damage no spall none", ART), *((jc, "viscosity 1 2") for jc in (
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
