"""Mirror planes: half, quarter and eighth models are what the whole one is, on every layout; impulse; wrong input."""

import itertools

import numpy as np
import pytest
from mirror_scenes import part, same, start
from solid_scenes import OUT, PAIR, read
from sph_scenes import scene


@pytest.mark.parametrize("words", ["viscosity 1 2", "viscosity 1 2 h variable", "interface 0.3", "artstress 0.3 4"])
def test_as_the_whole(lmp, tmp_path, material, words):
    """30 steps with stress, yielding and failure: forces, rates, stress of half, quarter and eighth models"""
    text = "".join("clear\n" + start(p, tmp_path, material, words=words)[0] + OUT.format("f" + p) for p in ("", "x", "xy", "xyz"))
    lmp(text)
    whole = read(tmp_path / "f")
    assert (whole["eps"] > 0.01).mean() > 0.2 and (whole["damage"] >= 1).sum() > 10
    for planes in ("x", "xy", "xyz"):
        same(whole, read(tmp_path / f"f{planes}"), part(planes)[1], planes)


@pytest.mark.parametrize("mass", [{1: 1.0, 2: 1.0}, {1: 1.0, 2: 2.0}], ids=["equal", "unequal"])
def test_fluid(lmp, tmp_path, material, mass):
    """without strength, in form symmetric, and with Riemann problems, whose slopes are sums of a first sweep; unequal masses of the same density at
    zero pressure have weights there"""
    for words, wide in (("", 1.25), ("form symmetric", 1.25), ("dissipation riemann", 1.25), ("dissipation riemann h variable", 1.25),
                        ("dissipation riemann h variable", 1.6)):
        text = "".join("clear\n" + start(p, tmp_path, material, words=words, solid=False, mass=mass)[0] + OUT.format("f" + p) for p in ("", "xyz"))
        text = text.replace("vm sxx", "p sxx").replace("p c eps damage spalled p sxx syy szz sxy sxz syz", "p c p p p p p p p p p p")
        text = text.replace(f"pair_coeff 2 2 file {material} h 1.25", f"pair_coeff 2 2 file {material} h {wide}")
        if "riemann" in words:  # else p* = 0 here, and its sign, so whether bodies touch, is that of a rounding
            text = text.replace("tension no", "tension yes")
        weighed = "riemann" in words and mass[2] != mass[1]
        assert ("weights of spacings: type 2 counts 2 times" in lmp(text).log) == weighed, words
        same(read(tmp_path / "f"), read(tmp_path / "fxyz"), part("xyz")[1], "xyz")


@pytest.mark.parametrize("nranks", [1, *(pytest.param(n, marks=pytest.mark.long) for n in (2, 3)), 4])
def test_layouts(lmp, tmp_path, material, nranks):
    cases = list(itertools.product(("on", "off"), ("brick", "tiled"), (None, "hi")))
    lmp("".join("clear\n" + start("xy", tmp_path, material, sides=sides)[0] + OUT.format(f"one.{sides}") for sides in (None, "hi")))
    text = "".join("clear\n" + start("xy", tmp_path, material, newton=newton, comm=comm, sides=sides)[0] + OUT.format(f"f.{k}")
                   for k, (newton, comm, sides) in enumerate(cases))
    lmp(text, nranks=nranks)
    for k, case in enumerate(cases):
        one, got = read(tmp_path / f"one.{case[2]}"), read(tmp_path / f"f.{k}")
        for name in ("x", "v", "f", "S", "eps", "de"):
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * np.abs(one[name]).max(), (case, name)
    low, high = read(tmp_path / "one.None"), read(tmp_path / "one.hi")
    assert np.abs(low["f"] + high["f"]).max() <= 1e-9 * np.abs(low["f"]).max()


@pytest.mark.parametrize("nranks", [1, 3])
def test_layouts_of_two_sweeps(lmp, tmp_path, material, nranks):
    """slopes of images go to owners that may be ghosts, and come back from there"""
    out = OUT.replace("vm sxx", "p sxx").replace("p c eps damage spalled p sxx syy szz sxy sxz syz", "p c p p p p p p p p p p")
    riemann = dict(words="dissipation riemann h variable", solid=False, more="pair_coeff 1 2 tension yes\n")
    lmp("clear\n" + start("xy", tmp_path, material, **riemann)[0] + out.format("one"))
    cases = list(itertools.product(("on", "off"), ("brick", "tiled")))
    lmp("".join("clear\n" + start("xy", tmp_path, material, newton=newton, comm=comm, **riemann)[0] + out.format(f"f.{k}")
                for k, (newton, comm) in enumerate(cases)), nranks=nranks)
    one = read(tmp_path / "one")
    for k, case in enumerate(cases):
        got = read(tmp_path / f"f.{k}")
        for name in ("x", "v", "f", "drho", "de"):
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * np.abs(one[name]).max(), (case, name)


BOOK = """fix step all hvi/dt 0.2
compute book all hvi/energy
thermo 10
thermo_style custom step press c_book[1] c_book[9] c_book[10] c_book[11] c_book[12] c_book[16] c_book[17] c_book[18]
thermo_modify format float %.17g
"""


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 3])
@pytest.mark.parametrize("newton", ["on", "off"])
def test_books(lmp, tmp_path, material, newton, nranks):
    """momentum is what the planes gave, to round-off; energy and pressure are the whole model's"""
    t = lmp(start("xy", tmp_path, material, steps=200, more=BOOK, newton=newton)[0], nranks=nranks).thermo
    whole = lmp(start("", tmp_path, material, steps=200, more=BOOK)[0]).thermo
    scale = np.abs(part("xy")[0].v).sum()
    for p, j in ((10, 16), (11, 17), (12, 18)):
        change, impulse = t[f"c_book[{p}]"] - t[f"c_book[{p}]"][0], t[f"c_book[{j}]"] - t[f"c_book[{j}]"][0]
        assert np.abs(change - impulse).max() < 1e-12 * scale, p
    assert np.abs(t["c_book[16]"]).max() > 0.01 * scale and np.abs(t["c_book[18]"]).max() == 0.0
    assert np.abs(t["c_book[9]"] - 1).max() < 1e-3
    early = slice(0, 4)
    assert t["c_book[1]"][early] * 4 == pytest.approx(whole["c_book[1]"][early], rel=1e-9)
    # pressure refers to the box: the quarter's is a quarter of the whole one's
    assert t["Press"][early] == pytest.approx(whole["Press"][early], rel=1e-8)


def test_reflected(lmp, tmp_path, material):
    """what crosses a plane comes back, with its stress, and the plane's impulse is booked"""
    s, _ = part("x")
    s.x, s.v, s.type = np.array([[1.5, 6.0, 6.0]]), np.array([[-40.0, 3.0, 0.0]]), np.array([1])
    s.rho, s.esph = np.ones(1), np.zeros(1)
    pair = PAIR.format(kernel="cubic", words="viscosity 0 0 mirror x 0.0 lo", path=material)
    text = scene(s, tmp_path / "s.data", pair) + "fix jc all hvi/johnson-cook\ntimestep 0.001\n"
    r = lmp(text + BOOK.replace("fix step all hvi/dt 0.2\n", "") + "run 100\n" + OUT.format("f"))
    f = read(tmp_path / "f")
    assert f["x"][0, 0] == pytest.approx(2.5, abs=0.3) and f["v"][0, 0] > 39 and f["v"][0, 1] == pytest.approx(3.0, abs=1e-3)
    t = r.runs[0]
    assert t["c_book[16]"][-1] == pytest.approx(t["c_book[10]"][-1] - t["c_book[10]"][0], rel=1e-12)


def test_restart(lmp, tmp_path, material):
    """30 steps, restart, 30 more: the same bits as 60 at once, the planes are in the restart file"""
    text, _ = start("xy", tmp_path, material, steps=0, sort=False, more=BOOK.replace("fix step all hvi/dt 0.2\n", "") + "restart 30 half\n")
    one = lmp(text + "run 59\n" + OUT.format("whole")).thermo
    text = "read_restart half.30\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix sph all hvi/sph\nfix jc all hvi/johnson-cook\ntimestep 0.004\n"
    two = lmp(text + BOOK.replace("fix step all hvi/dt 0.2\n", "") + "run 29\n" + OUT.format("part")).thermo
    a, b = read(tmp_path / "whole"), read(tmp_path / "part")
    for name in a:
        assert np.array_equal(a[name], b[name]), name
    assert one["c_book[16]"][-1] == two["c_book[16]"][-1]


@pytest.mark.parametrize("words,message", [
    ("mirror x", "missing"),
    ("mirror x 0 lo mirror x 3 hi", "more than one mirror x"),
    ("mirror w 0 lo", "must be x, y or z"),
    ("mirror x 0 left", "must be lo or hi"),
    ("mirror x nan lo", ""),
    ("mirror x 3.0 lo", "on the mirror plane"),
    ("mirror x 0.0 hi", "on the mirror plane"),
])
def test_wrong_input(lmp, tmp_path, material, words, message):
    s, _ = part("xyz")
    viscosity = "" if "riemann" in words else "viscosity 1 2 "
    pair = PAIR.format(kernel="cubic", words=viscosity + words, path=material)
    r = lmp(scene(s, tmp_path / "s.data", pair) + "timestep 0.001\nrun 1\n", expect_fail=True)
    assert message.lower() in r.log.lower() + r.stdout.lower()


def test_periodic(lmp, tmp_path, material):
    s, _ = part("xyz")
    s.periodic = (True, False, False)
    r = lmp(scene(s, tmp_path / "s.data", PAIR.format(kernel="cubic", words="mirror x 0 lo", path=material)) + "run 1\n", expect_fail=True)
    assert "not periodic" in r.log + r.stdout


def test_what_has_come_to_a_plane(lmp, tmp_path, material):
    """during runs a particle may come as near to a plane as numbers do: the next run takes it there"""
    text, _ = start("x", tmp_path, material, steps=0, sort=False, more="")
    r = lmp(text + "run 3\nset atom 1 x 1e-20\nrun 3\n")
    assert len(r.runs) >= 2
