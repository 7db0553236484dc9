"""Forces and rates of SPH on one state: those of the equations, on every layout, in every scene."""

import itertools
import re
import subprocess

import numpy as np
import pytest
from conftest import ROOT
from sph_scenes import RATES, ideal_gas, linear, norm, random_fluid, rates, read_rates, riemann_rates, scene, tait, weight_ratio

KERNELS = ("lucy", "quadratic", "cubic", "quartic", "quintic", "gauss", "wendland2", "wendland4")
TAIT = {1: tait(1.0, 4.0), 2: tait(1.7, 3.0)}
COEFF = "pair_coeff 1 1 eos tait 1.0 4.0 7 h {0[1]}\npair_coeff 2 2 eos tait 1.7 3.0 7 h {0[2]}\n"


def close(got, want, tolerance=1e-12):
    for name in ("f", "de", "drho"):
        scale = np.abs(want[name]).max()
        assert scale > 0, name
        assert np.abs(got[name] - want[name]).max() <= tolerance * scale, name


def one(lmp, tmp_path, state, pair, nranks=1, **kw):
    lmp(scene(state, tmp_path / "s.data", pair, **kw) + RATES.format("f"), nranks=nranks)
    return read_rates(tmp_path / "f")


@pytest.mark.each_value
@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("dim", [1, 2, 3])
def test_kernels(lmp, tmp_path, kernel, dim):
    """against all pairs in NumPy with the kernel's norm from quadrature"""
    h = 2.6 if kernel == "lucy" else 1.1
    state = random_fluid({1: 40, 2: 11, 3: 8}[dim], dim=dim, seed=3, h=h, jitter=0.2)
    pair = f"pair_style hvi/sph {kernel} dim {dim}\n" + COEFF.format(state.h) + "pair_coeff 1 2 tension yes\n"
    close(one(lmp, tmp_path, state, pair), rates(state, TAIT, kernel))


SCENES = {
    "plain": ("", "", dict()),
    "symmetric": ("form symmetric", "", dict(form="symmetric")),
    "density": ("interface 0.3", "", dict(alpha=0.3)),
    "density-symmetric": ("interface 0.8 form symmetric", "", dict(alpha=0.8, form="symmetric")),
    "auto": ("interface auto", "", dict(alpha="auto")),
    "auto-bodies": ("interface auto form symmetric", "pair_coeff 1 2 tension no\n", dict(alpha="auto", form="symmetric", tension=False)),
    "bodies": ("", "pair_coeff 1 2 tension no\n", dict(tension=False)),
    "viscosity": ("viscosity 0.5 0.25", "", dict(visc=(0.5, 0.25))),
    "all": ("interface 0.5 viscosity 2 3", "pair_coeff 1 2 tension no\n", dict(alpha=0.5, visc=(2, 3), tension=False)),
    "riemann": ("dissipation riemann", "", dict(riemann=True)),
    "riemann-bodies": ("dissipation riemann", "pair_coeff 1 2 tension no\n", dict(riemann=True, tension=False)),
    "all-symmetric": ("interface 0.5 form symmetric", "pair_coeff 1 2 tension no\n", dict(alpha=0.5, form="symmetric", tension=False)),
}


def solve(state, eos, kernel, riemann=False, follows=None, **terms):
    return riemann_rates(state, eos, kernel, follows=follows, **terms) if riemann else rates(state, eos, kernel, **terms)


@pytest.mark.each_value
@pytest.mark.parametrize("h", ["same", "differs", "variable"])
@pytest.mark.parametrize("name", SCENES)
def test_scenes(lmp, tmp_path, name, h):
    """what a scene adds, alone and together; h one, by type, by particle"""
    words, coeff, terms = SCENES[name]
    state = random_fluid(8, seed=5, h=[1.2, 1.0] if h == "differs" else 1.1)
    state.rho[:40] *= 0.75  # some under tension
    pair = f"pair_style hvi/sph cubic {words} {'h variable 0.7 1.1' if h == 'variable' else ''}\n"
    pair += COEFF.format(state.h) + (coeff or "pair_coeff 1 2 tension yes\n")
    text = scene(state, tmp_path / "s.data", pair)
    hi = follows = None
    if h == "variable":
        # the first run sets the scale of h; then density changes
        start = np.array([state.h[t] for t in state.type])
        factor = np.random.default_rng(8).uniform(0.6, 1.9, len(start))
        hi = np.clip(start * (1 / factor) ** (1 / 3), 0.7 * start, 1.1 * start)
        follows = (hi > 0.7 * start) & (hi < 1.1 * start)
        assert (hi == 1.1 * start).any() and follows.any()
        new = state.rho * factor
        (tmp_path / "rho").write_text("\n".join(f"{i + 1} {r:.17g}" for i, r in enumerate(new)))
        text += "run 0\nvariable new atomfile rho\nset group all sph/rho v_new\n"
        (tmp_path / "rho").write_text(f"{len(new)}\n" + (tmp_path / "rho").read_text() + "\n")
        state.rho = new
    lmp(text + RATES.format("f"))
    want = solve(state, TAIT, "cubic", h=hi, follows=follows, **terms)
    if not terms.get("tension", True):
        welded = solve(state, TAIT, "cubic", h=hi, follows=follows, **{**terms, "tension": True})
        assert np.abs(welded["f"] - want["f"]).max() > 0.01 * np.abs(want["f"]).max()
    close(read_rates(tmp_path / "f"), want)


SPACINGS = {  # laws, rho0 of those that have one, masses of two types, h, by how much type 2 counts more than type 1 in three dimensions
    "volumes": (TAIT, {1: 1.0, 2: 1.7}, (1.0, 5.1), [1.0, 1.3], 3.0),  # at rho0, whatever h is
    "same h": (TAIT, {1: 1.0, 2: 1.7}, (1.0, 5.1), [1.2, 1.2], 3.0),
    "masses": ({1: ideal_gas(1.4), 2: ideal_gas(1.6)}, {}, (1.0, 1.7), [1.0, 1.3], 1.7),  # less than 1.3^3
    "h": ({1: ideal_gas(1.4), 2: ideal_gas(1.6)}, {}, (1.0, 5.1), [1.0, 1.3], 1.3**3),
    "neither": ({1: ideal_gas(1.4), 2: ideal_gas(1.6)}, {}, (1.7, 1.0), [1.0, 1.3], 1.0),  # the lighter one is larger
    "gas and liquid": ({1: ideal_gas(1.4), 2: tait(1.7, 3.0)}, {2: 1.7}, (1.0, 5.1), [1.0, 1.3], 1.3**3),
}


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton, h", [(1, "on", "constant"), (1, "on", "variable"), (3, "off", "variable")])
@pytest.mark.parametrize("name", SPACINGS)
def test_riemann_of_unequal_spacings(lmp, tmp_path, name, nranks, newton, h):
    """types that count differently in each other's density, and have wide kernels between them"""
    eos, rho0, (m1, m2), wide, ratio = SPACINGS[name]
    state = random_fluid(7, seed=21, h=wide)
    state.esph *= np.array([m1, m2 / 1.7])[state.type - 1]  # energies per mass as they were
    state.mass = {1: m1, 2: m2}
    assert weight_ratio(state, 1, 2, rho0) == pytest.approx(ratio, rel=1e-12)
    laws = ("eos tait 1.0 4.0 7" if 1 in rho0 else "eos idealgas 1.4", "eos tait 1.7 3.0 7" if 2 in rho0 else "eos idealgas 1.6")
    pair = f"pair_style hvi/sph cubic dissipation riemann h {h}\npair_coeff 1 2 tension yes\n"
    pair += "".join(f"pair_coeff {k} {k} {laws[k - 1]} h {wide[k - 1]}\n" for k in (1, 2))
    follows = np.full(len(state.x), h == "variable")
    want = riemann_rates(state, eos, "cubic", follows=follows, rho0=rho0)
    got = one(lmp, tmp_path, state, pair, nranks=nranks, newton=newton)
    close(got, want)
    assert got["de"].sum() == pytest.approx(-(got["f"] * state.v).sum(), rel=1e-10)
    if ratio != 1:
        plain = riemann_rates(state, eos, "cubic", follows=follows, rho0={1: m1, 2: m2})  # of equal volumes
        assert np.abs(plain["f"] - want["f"]).max() > 0.01 * np.abs(want["f"]).max()


@pytest.mark.each_value
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("nranks", [1, 2, 3, 4])
@pytest.mark.parametrize("words", ["interface 0.3", "dissipation riemann"])
def test_layouts(lmp, tmp_path, nranks, periodic, words):
    """newton on and off, brick and tiled, periodic images: 1e-12; total force and the virial"""
    state = random_fluid(7, seed=7, h=[1.1, 1.0], periodic=periodic)
    pair = f"pair_style hvi/sph cubic {words} h variable\n" + COEFF.format(state.h)
    if words == "interface 0.3":
        want = rates(state, TAIT, "cubic", alpha=0.3, tension=False)
    else:
        want = riemann_rates(state, TAIT, "cubic", tension=False, follows=np.full(len(state.x), True))
    cases = list(itertools.product(("on", "off"), ("brick", "tiled")))
    text = ""
    for k, (newton, comm) in enumerate(cases):
        text += "clear\n" + scene(state, tmp_path / "s.data", pair, newton=newton, comm=comm)
        text += "compute W all pressure NULL virial\ncompute S all stress/atom NULL virial\ncompute sum all reduce sum c_S[*]\n"
        text += "thermo_style custom step vol c_W[*] c_sum[*]\nthermo_modify norm no format float %.16e\n" + RATES.format(f"f.{k}")
    result = lmp(text, nranks=nranks)
    assert len(result.runs) == len(cases)
    w = want["virial"][[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    for k, case in enumerate(cases):
        got = read_rates(tmp_path / f"f.{k}")
        close(got, want)
        assert np.abs(got["f"].sum(0)).max() <= 1e-12 * np.abs(got["f"]).max(), case
        row = {name: column[0] for name, column in result.runs[k].items()}
        assert np.abs([row[f"c_W[{a}]"] * row["Volume"] for a in range(1, 7)] - w).max() <= 1e-11 * np.abs(w).max(), case
        assert np.abs([-row[f"c_sum[{a}]"] for a in range(1, 7)] - w).max() <= 1e-11 * np.abs(w).max(), case


@pytest.mark.parametrize("words", ["form sum interface 0.5", "form symmetric interface 0.5", "dissipation riemann"])
def test_energy_of_pairs(lmp, tmp_path, words):
    """internal energy gains what kinetic energy loses: sum of de/dt = - sum of f.v, momentum is kept"""
    state = random_fluid(8, seed=9, h=1.2)
    pair = f"pair_style hvi/sph quintic {words}\n" + COEFF.format(state.h)
    got = one(lmp, tmp_path, state, pair)
    power = (got["f"] * state.v).sum()
    assert got["de"].sum() == pytest.approx(-power, rel=1e-12)
    assert abs(power) > 1.0


def test_equations_of_state(lmp, tmp_path):
    """two laws in one scene: an ideal gas and a linear solid"""
    state = random_fluid(8, seed=13, h=1.2)
    pair = "pair_style hvi/sph wendland4\npair_coeff 1 1 eos idealgas 1.4 h 1.2\npair_coeff 2 2 eos linear 1.7 9.0 h 1.2\n"
    close(one(lmp, tmp_path, state, pair), rates(state, {1: ideal_gas(1.4), 2: linear(1.7, 9.0)}, "wendland4", tension=False))


def test_energy_no(lmp, tmp_path):
    """the energy equation can be left out"""
    state = random_fluid(7, seed=15, h=1.2)
    got = one(lmp, tmp_path, state, "pair_style hvi/sph cubic energy no\n" + COEFF.format(state.h))
    assert np.abs(got["de"]).max() == 0.0
    want = rates(state, TAIT, "cubic", tension=False)
    assert np.abs(got["f"] - want["f"]).max() <= 1e-12 * np.abs(want["f"]).max()


def test_many_neighbors(lmp, tmp_path):
    """more neighbors than the vectorized loop takes at a time"""
    state = random_fluid(10, seed=17, h=2.2)
    want = rates(state, TAIT, "cubic", tension=False)
    close(one(lmp, tmp_path, state, "pair_style hvi/sph cubic\n" + COEFF.format(state.h)), want)


def test_norms_are_known():
    """the reference itself: cubic spline 1/6, 5/(14 pi), 1/(4 pi); Lucy in 3D 105/(16 pi)"""
    assert norm("cubic", 1) == pytest.approx(1 / 6, rel=1e-12)
    assert norm("cubic", 2) == pytest.approx(5 / (14 * np.pi), rel=1e-12)
    assert norm("cubic", 3) == pytest.approx(1 / (4 * np.pi), rel=1e-12)
    assert norm("lucy", 3) == pytest.approx(105 / (16 * np.pi), rel=1e-12)


@pytest.mark.parametrize("nranks", [1, 3])
def test_large_ids(lmp, lmp_exe, tmp_path, nranks):
    """from 2^30 on LAMMPS's lists of all pairs would count some twice, unless IDs have 64 bits: refused; other lists do not mind, on any rank"""
    state = random_fluid(6, seed=4, h=1.1)
    text = scene(state, tmp_path / "s.data", "pair_style hvi/sph cubic\n" + COEFF.format(state.h) + "pair_coeff 1 2 tension yes\n").replace("map array", "map hash")
    large = re.sub(r"(?m)^(\d+)(?=( [-+.\de]+){3,}$)", lambda id: str(int(id[1]) + 1_500_000_000), (tmp_path / "s.data").read_text())
    lmp(text + RATES.format("small"), nranks=nranks)
    (tmp_path / "s.data").write_text(large)
    nsq = text.replace(" bin", " nsq")
    lmp(text + RATES.format("bin"), nranks=nranks)
    lmp(nsq.replace("newton on", "newton off") + RATES.format("off"), nranks=nranks)
    names = ["bin", "off"]
    said = subprocess.run([ROOT / "cmake/env.sh", lmp_exe, "-h"], text=True, capture_output=True, check=True).stdout
    if re.search(r"sizeof\(tagint\): *64-bit", said):
        lmp(nsq + RATES.format("nsq"), nranks=nranks)
        names.append("nsq")
    else:
        assert "IDs up to 1500000216 are too large for neighbor style nsq" in lmp(nsq + "run 0\n", nranks=nranks, expect_fail=True).error
    for name in names:
        close(read_rates(tmp_path / name), read_rates(tmp_path / "small"))
