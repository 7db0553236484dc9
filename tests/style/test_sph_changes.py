"""What scripts change between runs: fixes taken away, pair styles given again, another simulation after clear. The last word counts."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from dumps import read_dump
from solid_scenes import MATERIAL, PAIR
from sph_scenes import RATES as RATES_ONCE
from sph_scenes import random_fluid, rates, read_rates, scene, tait

DUMP = "write_dump all custom late id c_S[1] modify format float %.17g sort id\n"
TOP = "variable top equal c_top\nprint 'top is ${top}'\n"
FLUID = "pair_style hvi/sph cubic {0}\npair_coeff 1 1 eos tait 1.0 4.0 7 h 1.2\npair_coeff 2 2 eos tait 1.7 3.0 7 h 1.2\n"
LJ = "pair_style lj/cut 1.5\npair_coeff * * 0.1 0.8\n"
RATES = RATES_ONCE + "uncompute R\n"
STEP = "timestep 0.004\n"


@pytest.fixture
def solids(tmp_path):
    """a run of a few solid particles with a compute hvi/atom that has been initialized, but not been asked; then what follows"""
    (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    s = random_fluid(4, seed=61, jitter=0.05, h=1.2)
    s.rho[:] = 1.0
    s.mass, s.esph = {1: 1.0, 2: 1.0}, np.zeros(len(s.x))

    def text(values, more, words=""):
        pair = PAIR.format(kernel="cubic", words=words, path=tmp_path / "m.hvi") + "pair_coeff 1 2 tension yes\n"
        return (scene(s, tmp_path / "s.data", pair) + "fix jc all hvi/johnson-cook\n" + STEP
                + f"compute S all hvi/atom {values} e\ncompute top all reduce max c_S[1]\nrun 20\n" + more)

    return text


def print_of(result):
    return float(next(line for line in result.log.splitlines() if line.startswith("top is")).split()[-1])


# ---------------------------------------------------------------------- compute hvi/atom, whose sources have gone

def all_fail(lmp, tmp_path, cases):
    """each text must end with its error, and without a crash; side by side, for one mostly waits for MPI"""

    def one(k, text, says):
        try:
            r = lmp(text, cwd=tmp_path / str(k), expect_fail=True)
        except pytest.fail.Exception as failure:
            return str(failure)
        return None if says in " ".join(r.error.split()) and 0 < r.returncode < 128 else f"{says!r}: {r}"

    with ThreadPoolExecutor(12) as pool:
        wrong = [w for w in pool.map(lambda a: one(a[0], *a[1]), enumerate(cases)) if w]
    assert not wrong, "\n".join(wrong)


def test_sources_that_have_gone(lmp, tmp_path, solids):
    """no memory of a fix or a pair style that is no more: an error that names what is missing"""
    cases = [("eps", "", "unfix jc\n", "eps needs fix hvi/johnson-cook"), ("damage", "", "unfix jc\nunfix sph\n", "damage needs fix hvi/johnson-cook"),
             ("h", "h variable", "unfix jc\nunfix sph\n", "h needs fix hvi/sph, which keeps it"), ("p", "", LJ, "p needs pair style hvi/sph"),
             ("eps", "", LJ, "eps needs pair style hvi/sph"), ("p", "", "pair_style none\n", "p needs pair style hvi/sph"),
             ("p", "", "unfix HVI_STORE\n", "p needs pair style hvi/sph")]
    all_fail(lmp, tmp_path, [(solids(values, more + asked, words), f"Compute hvi/atom {says}")
                             for values, words, more, says in cases for asked in (DUMP, TOP)])


def test_what_needs_nothing_goes_on(lmp, solids, tmp_path):
    """values that do not need a fix outlive it; those of a fix given anew are its own"""
    here = print_of(lmp(solids("p", TOP)))
    assert print_of(lmp(solids("p", "unfix jc\n" + TOP))) == here > 0.1
    assert print_of(lmp(solids("p", "unfix jc\nunfix sph\n" + TOP))) == here
    assert print_of(lmp(solids("h", "unfix jc\nunfix sph\n" + TOP))) == 1.25
    assert print_of(lmp(solids("eps", TOP))) > 0.001
    assert print_of(lmp(solids("eps", "unfix jc\nfix other all hvi/johnson-cook\n" + TOP))) == 0.0
    lmp(solids("damage", DUMP))
    assert read_dump(tmp_path / "late").table[:, 1].max() > 0.001


# ---------------------------------------------------------------------- pair_style hvi/sph given again

RHO0 = "print 'rho0 $(f_sph[1]) $(f_sph[2])'\n"  # what fix hvi/sph finds in the registry
ANEW = "velocity all set 0.1 0 0 sum yes\n"  # particles that a command has changed start from what is in the output


@pytest.fixture
def fluid(tmp_path):
    s = random_fluid(7, seed=63, jitter=0.15, h=1.2)
    return s, scene(s, tmp_path / "s.data", FLUID.format("")) + STEP


def densities(result):
    return [[float(a) for a in line.split()[1:]] for line in result.log.splitlines() if line.startswith("rho0")]


def test_other_settings(lmp, tmp_path, fluid):
    """kernel, h and materials of the second pair_style, after a run with the first; the same after clear"""
    s, text = fluid
    other = "pair_style hvi/sph quintic form symmetric viscosity 0.5 1\npair_coeff 1 1 eos tait 0.9 5.0 7 h 1.0\npair_coeff 2 2 eos tait 1.5 2.0 7 h 1.1\n"
    r = lmp(text + RHO0 + "run 5\n" + other + RHO0 + ANEW + RATES.format("f") + "run 3\n" + FLUID.format("") + RHO0 + ANEW + RATES.format("g") + "clear\n" + text
            + "run 2\n" + other + RHO0 + ANEW + RATES.format("k"))
    assert densities(r) == [[1.0, 1.7], [0.9, 1.5], [1.0, 1.7], [0.9, 1.5]]
    first, second = {1: tait(1.0, 4.0), 2: tait(1.7, 3.0)}, {1: tait(0.9, 5.0), 2: tait(1.5, 2.0)}
    for name, eos, h, kernel, terms in (("f", second, {1: 1.0, 2: 1.1}, "quintic", dict(form="symmetric", visc=(0.5, 1.0))), ("g", first, s.h, "cubic", {}),
                                        ("k", second, {1: 1.0, 2: 1.1}, "quintic", dict(form="symmetric", visc=(0.5, 1.0)))):
        got = read_rates(tmp_path / name)
        s.x, s.v, s.rho, s.esph, s.h = got["x"], got["v"], got["rho"], got["esph"], h
        want = rates(s, eos, kernel, tension=False, **terms)
        for key in ("f", "de", "drho"):
            assert np.abs(got[key] - want[key]).max() <= 1e-11 * np.abs(want[key]).max(), (name, key)


def test_a_type_without_a_material(lmp, fluid):
    """the second pair style, under hybrid, leaves type 2 to another: its material is gone"""
    pair = "pair_style hybrid hvi/sph cubic lj/cut 1.0\npair_coeff 1 1 hvi/sph eos tait 0.9 10 7 h 1.2\npair_coeff 2 2 lj/cut 1 0.5\npair_coeff 1 2 none\n"
    r = lmp(fluid[1] + "run 2\n" + RHO0 + pair + RHO0 + "run 1\n" + RHO0)
    assert densities(r) == [[1.0, 1.7], [0.9, 0.0], [0.9, 0.0]]


def test_what_the_first_gave_is_forgotten(lmp, tmp_path, fluid):
    given = "Fix hvi/store is made by pair style hvi/sph and cannot be given in an input"
    one = "pair_coeff 1 1 eos tait 1.0 4.0 7 h 1.2\n"
    beside = ("pair_style hybrid/overlay hvi/sph cubic lj/cut 1.0\npair_coeff 1 1 hvi/sph eos tait 1 10 7 h 1.2\npair_coeff * 2 lj/cut 1 1\n"
              "pair_coeff 1 2 hvi/sph tension yes\n")
    cases = [("pair_style hvi/sph quintic\n", "All pair coeffs are not set"), ("pair_style hvi/sph quintic\n" + one, "All pair coeffs are not set"),
             (beside, "Pair style hvi/sph: type 2 has no material"), ("unfix HVI_STORE\n", "Pair style hvi/sph: type 1 has no material"),
             ("unfix HVI_STORE\n" + one, "Pair style hvi/sph: type 2 has no material"), ("fix store all hvi/store\n", given),
             ("fix HVI_STORE all hvi/store\n", given), (LJ, "Fix hvi/sph needs pair style hvi/sph")]
    all_fail(lmp, tmp_path, [(fluid[1] + "run 2\n" + more + "run 1\n", says) for more, says in cases])


def test_without_the_store(lmp, tmp_path, fluid):
    """a script that unfixes what it has not made can go on when all materials are given anew"""
    s, text = fluid
    coeffs = "".join(line for line in FLUID.splitlines(True) if "pair_coeff" in line)
    lmp(text + "run 2\n" + ANEW + RATES.format("f"))
    lmp(text + "run 2\nunfix HVI_STORE\n" + coeffs + ANEW + RATES.format("g"))
    assert (tmp_path / "f").read_bytes() == (tmp_path / "g").read_bytes()


def test_another_pair_style_in_between(lmp, tmp_path, fluid):
    """without its fix, a run with lj/cut; then SPH again"""
    s, text = fluid
    lmp(text + "unfix sph\n" + LJ + "fix nve all nve\nrun 2\nunfix nve\n" + FLUID.format("") + "fix sph all hvi/sph\n" + RATES.format("f"))
    got = read_rates(tmp_path / "f")
    s.x, s.v = got["x"], got["v"]
    want = rates(s, {1: tait(1.0, 4.0), 2: tait(1.7, 3.0)}, "cubic", tension=False)
    for key in ("f", "de", "drho"):
        assert np.abs(got[key] - want[key]).max() <= 1e-11 * np.abs(want[key]).max(), key
