"""Particles to whom nothing happens are left out, and the rest does not notice: fix hvi/sph sleep."""

import numpy as np
import pytest
from dumps import named, read_dump
from solid_scenes import MATERIAL
from sph_scenes import Fluid, scene

WATER = "pair_style hvi/sph cubic {}\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"
METAL = "pair_style hvi/sph cubic {}\npair_coeff 1 1 file m.hvi h 1.25\npair_coeff 2 2 file m.hvi h 1.25\npair_coeff 1 2 tension no\n"
JC = "fix jc all hvi/johnson-cook\n"
OUT = "compute R all property/atom drho desph rho esph\ncompute S all hvi/atom {}\n"
STRESS = "sxx syy szz sxy sxz syz"
WRITE = "write_dump all custom {} id type x y z vx vy vz fx fy fz c_R[*] c_S[*] modify format float %.17g sort id\n"
THERMO = "thermo 1\nthermo_style custom step dt ke f_sph\nthermo_modify norm no format float %.17g\n"
WORDS = ["", "h variable", "dissipation riemann", "artstress 0.3 4"]


def lattice(counts, corner, velocity=(0.0, 0.0, 0.0)):
    x = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), -1).reshape(-1, 3) + 0.5 + np.array(corner, float)
    return x, np.zeros_like(x) + velocity


def bodies(*blocks, box, periodic=False):
    """one type each; c is 4"""
    x, v = (np.vstack(a) for a in zip(*blocks))
    n, kind = len(x), np.repeat(np.arange(len(blocks)) + 1, [len(b[0]) for b in blocks])
    return Fluid(x, v, np.ones(n), np.zeros(n), kind, {1: 1.0, 2: 1.0}, {1: 1.25, 2: 1.25}, np.array(box, float), (periodic,) * 3)


def impact(shift=2.4):
    """a cube strikes a long plate near its end, at half the speed of sound; its other end is asleep all through; shift: against cells of 3.1"""
    s = bodies(lattice((60, 7, 3), (4, 4, 6)), lattice((3, 3, 3), (8.2, 6.1, 9.6), (0, 0, -2.0)), box=(72, 19, 28))
    s.x += shift
    return s


def text(s, tmp_path, sleep, words="", solid=True, pair=None, **kw):
    (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    word = f"sleep {sleep}" if sleep else ""
    out = scene(s, tmp_path / "s.data", pair or (METAL if solid else WATER).format(words), fix=f"fix sph all hvi/sph {word}\n", **kw)
    return out + (JC if solid else "") + OUT.format(STRESS if solid else "p c") + THERMO + "timestep 0.05\n"


def columns(path):
    return named(read_dump(path), R="drho de rho e", S=None)


def apart(one, other):
    return {name: np.abs(one[name] - other[name]).max() / np.abs(other[name]).max() for name in one}


def unnoticed(lmp, tmp_path, words, shift=2.4, nranks=1, comm="brick"):
    """positions, velocities, density, energies, stress, forces after an impact, against all awake on one rank"""
    solid = words != "water"
    how = dict(words=words if solid else "", solid=solid)
    s, run = impact(shift), "run 12\n" + WRITE
    lmp(text(s, tmp_path, "no", **how) + run.format("all"))
    want = columns(tmp_path / "all")
    bounds = {"exact": 1e-12, "": 1e-7}
    r = lmp("clear\n".join(text(s, tmp_path, sleep, comm=comm, **how) + run.format(f"some{sleep}") for sleep in bounds), nranks=nranks)
    for (sleep, bound), thermo in zip(bounds.items(), r.runs):
        t = thermo["f_sph"]
        assert 0.1 * len(s.x) < t[-1] < 0.7 * len(s.x) < t[0] <= len(s.x), sleep
        error = apart(columns(tmp_path / f"some{sleep}"), want)
        assert max(error.values()) <= bound, (sleep, error)
    assert np.abs(want["v"]).max() > 0.5 and np.abs(want["rho"] - 1).max() > 0.01


@pytest.mark.parametrize("words", ["water", *WORDS])
def test_the_rest_does_not_notice(lmp, tmp_path, words):
    unnoticed(lmp, tmp_path, words)


@pytest.mark.parametrize("shift", [0.0, *(pytest.param(more, marks=pytest.mark.long) for more in (0.6, 1.8)), 1.2])
def test_wherever_cells_end(lmp, tmp_path, shift):
    """some awake have neighbors asleep, who count in M when the first signal comes"""
    unnoticed(lmp, tmp_path, "", shift)


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, comm", [(2, "brick"), (4, "brick"), (4, "tiled")])
@pytest.mark.parametrize("words", ["water", ""])
def test_on_any_ranks(lmp, tmp_path, words, nranks, comm):
    unnoticed(lmp, tmp_path, words, 2.4, nranks, comm)


def test_larger_differences_count_as_less(lmp, tmp_path):
    """the larger EPS, the more sleep, and the more it shows"""
    s, run = impact(), "run 12\n" + WRITE
    lmp(text(s, tmp_path, "no") + run.format("all"))
    asleep, error = [], []
    for sleep in ("exact", "1e-8", "1e-6", "1e-4"):
        asleep.append(lmp(text(s, tmp_path, sleep) + run.format("some")).thermo["f_sph"][-1])
        error.append(apart(columns(tmp_path / "some"), columns(tmp_path / "all"))["f"])
    assert (np.diff(asleep) > 0).all() and (np.diff(error) > 0).all(), (asleep, error)
    assert error[-1] > 1e-7  # so the bounds above mean something


@pytest.mark.parametrize("words, solid", [("", True), ("", False)])
def test_asleep_in_flight_awake_when_it_strikes(lmp, tmp_path, words, solid):
    """a body in flight through periodic faces, to a plate at rest: all sleep until they are near, and nobody far from the other"""
    s = bodies(lattice((5, 5, 5), (3, 11, 3), (0.0, 1.5, 0.2)), lattice((40, 4, 12), (0, 0, 0)), box=(40, 24, 12), periodic=True)
    t = lmp(text(s, tmp_path, "", words, solid) + "run 120\n").thermo
    n, gap = len(s.x), 24 - 16 - 1.5 * 0.05 * t["Step"]  # of faces; particles are half a spacing inside
    cell = 2.5 + 2 * 0.3
    assert (t["f_sph"][gap > 2 * cell] == n).all() and (gap > 2 * cell).sum() > 5
    awake = n - t["f_sph"][(gap > 0.7) & (gap < 1.5)]  # reach 2.5, of centers
    assert (awake > 125).all() and (awake < n).all() and len(awake) > 8
    assert t["KinEng"][-1] < 0.98 * t["KinEng"][0]


@pytest.mark.parametrize("nranks", [1, 2])
def test_pushed_while_asleep(lmp, tmp_path, nranks):
    """another fix pushes what has been asleep for a while, far from the impact: as if all were awake"""
    push = "region far block 50 INF INF INF INF INF\ngroup far region far\nvariable f equal 0.02*(step>5)\nfix push far addforce 0 0 v_f\n"
    s, run = impact(), push + "run 14\n" + WRITE
    lmp(text(s, tmp_path, "no") + run.format("all"))
    r = lmp(text(s, tmp_path, "") + run.format("some"), nranks=nranks)
    assert r.thermo["f_sph"][3] > 0.3 * len(s.x)
    want = columns(tmp_path / "all")
    error = apart(columns(tmp_path / "some"), want)
    assert max(error.values()) <= 1e-7 and want["v"][s.x[:, 0] > 60, 2].min() > 1e-3, error


def test_velocities_that_differ_do_not_sleep(lmp, tmp_path):
    """two bodies side by side, near each other, out of reach: where they are near both are awake; with one velocity nobody"""
    for velocity, some in (((0.0, 0.0, 0.0), False), ((1e-4, 0.0, 0.0), True), ((0.3e-10 * 4, 0.0, 0.0), False)):
        s = bodies(lattice((12, 12, 6), (4, 4, 4)), lattice((12, 12, 6), (4, 18, 4), velocity), box=(20, 34, 14))
        t = lmp(text(s, tmp_path, "") + "run 1\n" + WRITE.format("a")).thermo
        awake = len(s.x) - t["f_sph"][-1]
        assert 0.1 * len(s.x) <= awake < len(s.x) if some else awake == 0, (velocity, awake)
        assert np.abs(columns(tmp_path / "a")["f"]).max() < 1e-6, velocity


@pytest.mark.parametrize("nranks", [1, 2])
def test_mirrors(lmp, tmp_path, nranks):
    """what moves along the axis of a plane is awake, wherever it is, and does as with all awake; what moves beside it may sleep"""
    for velocity, asleep in (((0.0, 0.0, 0.0), True), ((0.0, 0.7, -0.3), True), ((-0.5, 0.0, 0.0), False), ((0.5, 0.0, 0.0), False)):
        s = bodies(lattice((4, 4, 4), (1.1 if velocity[0] else 0.0, 4, 4), velocity), box=(12, 12, 12))
        how = dict(words="mirror x 0.0 lo")
        t = lmp(text(s, tmp_path, "", **how) + "run 30\n" + WRITE.format("some"), nranks=nranks).thermo["f_sph"]
        assert (t == (64 if asleep else 0)).all(), velocity
        lmp(text(s, tmp_path, "no", **how) + "run 30\n" + WRITE.format("all"))
        one, other = columns(tmp_path / "some"), columns(tmp_path / "all")
        assert np.abs(one["x"] - other["x"]).max() < 1e-12, velocity
        if velocity[0] < 0:
            assert np.abs(other["f"]).max() > 0.1, velocity  # it has met its image


def test_who_never_sleeps(lmp, tmp_path):
    """what has a pressure at rest, or was compressed, or heated; dissipation riemann without solids; energy no with solids; sleep no"""
    s = bodies(lattice((6, 6, 6), (2, 2, 2)), box=(10, 10, 10))
    cases = {"": (dict(solid=False), 216), "no": (dict(solid=False, sleep="no"), 0), "gas": (dict(pair="pair_style hvi/sph cubic\npair_coeff * * eos idealgas 1.4 h 1.25\n", solid=False), 0)}
    cases |= {"riemann": (dict(solid=False, words="dissipation riemann"), 0), "solid": (dict(), 216), "solid riemann": (dict(words="dissipation riemann"), 216)}
    cases |= {"solid energy no": (dict(words="energy no"), 0), "energy no": (dict(solid=False, words="energy no"), 216)}
    for name, (how, asleep) in cases.items():
        r = lmp(text(s, tmp_path, how.pop("sleep", ""), **how) + "run 1\n")
        assert (r.thermo["f_sph"] == asleep).all(), name
    for change in ("set atom 100 sph/rho 1.0001\n", "set atom 100 sph/e 1e-5\n", "velocity all set 1e-5 0 0\nvelocity all ramp vx 0 1e-5 x 2 8 units box\n"):
        r = lmp(text(s, tmp_path, "", solid=False) + change + "run 0\n")
        assert r.thermo["f_sph"][0] < 216, change
    for change in ("set atom 100 sph/rho 1.00000000001\n", "set atom 100 sph/e 1e-21\n", "velocity all set 1e5 0 0\n"):
        r = lmp(text(s, tmp_path, "", solid=False) + change + "run 0\n")
        assert r.thermo["f_sph"][0] == 216, change


def test_cost(lmp, tmp_path):
    """what fix balance weighs particles with: less for inactive ones, from the last forces"""
    out = "compute a all hvi/atom asleep cost\nvariable off atom abs(c_a[2]-ternary(c_a[1]>0,0.4,1))\ncompute off all reduce max v_off\ncompute n all reduce sum c_a[1] c_a[2]\n"
    s = impact()
    t = lmp(text(s, tmp_path, "") + out + "thermo_style custom step c_off c_n[1] c_n[2]\nthermo_modify norm no\nrun 12\n").thermo
    assert (t["c_off"] < 1e-12).all() and 0 < t["c_n[1]"][-1] < len(s.x)
    assert t["c_n[2]"][-1] == pytest.approx(len(s.x) - 0.6 * t["c_n[1]"][-1], rel=1e-6)


def test_others_are_awake(lmp, tmp_path):
    """particles of other styles under hybrid never count as asleep"""
    s = bodies(lattice((5, 5, 5), (4, 4, 4)), lattice((5, 5, 5), (24, 4, 4), (0.0, 0.1, 0.0)), box=(36, 14, 14))
    pair = "pair_style hybrid hvi/sph cubic lj/cut 1.2\npair_coeff 1 1 hvi/sph eos tait 1.0 4.0 7 h 1.25\npair_coeff * 2 lj/cut 1e-3 0.9\n"
    lines = scene(s, tmp_path / "s.data", pair, fix="group one type 1\ngroup two type 2\nfix sph one hvi/sph\nfix nve two nve\n")
    out = "compute a all hvi/atom asleep\ncompute one one reduce sum c_a\ncompute two two reduce sum c_a\n"
    t = lmp(lines + out + "timestep 0.05\nthermo_style custom step c_one c_two f_sph\nthermo_modify norm no\nrun 3\n").thermo
    assert (t["c_one"][1:] == 125).all() and (t["c_two"] == 0).all() and (t["f_sph"][1:] == 125).all()


def test_ranks_share_who_is_awake(lmp, tmp_path):
    """the weight of compute hvi/atom asleep: each rank has half of those awake, with the way they go unchanged"""
    s, n = impact(), len(impact().x)
    out = """compute asleep all hvi/atom asleep
variable awake atom 1-c_asleep
compute awake all reduce sum v_awake
compute least all reduce min c_asleep
compute most all reduce max c_asleep
compute proc all property/atom proc
variable here atom (1-c_asleep)*(c_proc==0)
compute here all reduce sum v_here
"""
    thermo = "thermo_style custom step f_sph c_awake c_least c_most c_here\nthermo_modify norm no\n"
    found = {}
    for weight in ("", "weight var cost"):
        more = f"variable cost atom 1-0.9*c_asleep\nfix share all balance 4 1.0 rcb {weight}\n"
        t = lmp(text(s, tmp_path, "", comm="tiled") + out + thermo + more + "run 12\n" + WRITE.format("a"), nranks=2).thermo
        assert np.array_equal(t["c_awake"], n - t["f_sph"]) and t["c_least"][-1] == 0 and t["c_most"][-1] == 1, weight
        found[weight] = t["c_here"][-1] / t["c_awake"][-1], columns(tmp_path / "a")
    (plain, one), (weighted, other) = found.values()
    assert abs(weighted - 0.5) < 0.1 < 0.2 < abs(plain - 0.5), (plain, weighted)
    assert max(apart(one, other).values()) < 1e-11


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("words", ["water", ""])
@pytest.mark.parametrize("sleep", ["exact", ""])
def test_restart_with_sleepers(lmp, tmp_path, words, sleep, nranks):
    """interrupted while some sleep and others wake: the same bits"""
    solid = words != "water"
    s = impact()
    first = text(s, tmp_path, sleep, words if solid else "", solid, sort=False)
    move = "fix step all hvi/dt 0.2\n"
    a = lmp(first + move + "restart 10 half\nrun 18\n" + WRITE.format("whole"), nranks=nranks).thermo
    again = "read_restart half.10\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n" + first[first.index("fix sph"):]
    b = lmp(again + move + "run 8\n" + WRITE.format("part"), nranks=nranks).thermo
    one, two = columns(tmp_path / "whole"), columns(tmp_path / "part")
    for name in one:
        assert np.array_equal(one[name], two[name]), name
    for name in b:
        assert np.array_equal(a[name][10:], b[name]), name
    assert 0 < a["f_sph"][-1] <= a["f_sph"][10] < a["f_sph"][0]


def test_wrong_input(lmp, tmp_path):
    lines = text(bodies(lattice((4, 4, 4), (2, 2, 2)), box=(8, 8, 8)), tmp_path, "exact", solid=False)
    for value in ("0.1", "0", "1e-14", "-1e-8"):
        r = lmp(lines.replace("sleep exact", f"sleep {value}") + "run 0\n", expect_fail=True)
        assert f"Fix hvi/sph sleep must be exact, no or a part of the speed of sound from 1e-13 to 1e-4, not {value}" in r.error
    assert "Expected floating point parameter instead of 'well'" in lmp(lines.replace("sleep exact", "sleep well"), expect_fail=True).error
    assert "Illegal fix hvi/sph sleep command: missing argument" in lmp(lines.replace("sleep exact", "sleep"), expect_fail=True).error
    for value in ("1e-4", "1e-13"):
        assert lmp(lines.replace("sleep exact", f"sleep {value}") + "run 0\n").thermo["f_sph"][0] == 64
