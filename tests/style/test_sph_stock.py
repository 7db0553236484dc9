"""`stock yes` is the package SPH to round-off, so that what differs from it in other modes is meant to."""

import numpy as np
import pytest
from sph_scenes import RATES, random_fluid, read_rates, scene

LIQUID = {
    "stock": "pair_style sph/taitwater\npair_coeff * * 1.0 10.0 0.8 2.4\n",
    "hvi": "pair_style hvi/sph lucy stock yes viscosity 0.8 0\npair_coeff * * eos tait 1.0 10.0 7 h 2.4\n",
}
GAS = {
    "stock": "pair_style sph/idealgas\npair_coeff * * 0.75 2.4\n",
    "hvi": "pair_style hvi/sph lucy stock yes viscosity 0.75 0\npair_coeff * * eos idealgas 1.4 h 2.4\n",
}


# fix sph sets vest of owned particles at the start of a run, after ghosts got theirs: only a second run starts right
START = "run 0\n"


def types(law):
    """sph/idealgas never sets the viscosity of types 2 and 1 (only 1 and 2), so it is compared on one type"""
    return 1 if law is GAS else 2


def equal(a, b, tolerance=1e-12):
    for name in ("f", "drho", "de"):
        scale = np.abs(a[name]).max()
        assert scale > 0, name
        assert np.abs(a[name] - b[name]).max() <= tolerance * scale, name


@pytest.mark.each_value
@pytest.mark.parametrize("law", [LIQUID, GAS], ids=["taitwater", "idealgas"])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_forces_and_rates(lmp, tmp_path, law, dim, nranks):
    """random states, with fix sph and with fix hvi/sph"""
    state = random_fluid({2: 12, 3: 8}[dim], dim=dim, seed=20 + dim, jitter=0.3, types=types(law))
    text = ""
    for k, (style, fix) in enumerate([("stock", "sph"), ("hvi", "sph"), ("hvi", "hvi/sph")]):
        text += "clear\n" + scene(state, tmp_path / "s.data", law[style], fix=f"fix 1 all {fix}\n") + START + RATES.format(f"f{k}")
    lmp(text, nranks=nranks)
    want = read_rates(tmp_path / "f0")
    equal(want, read_rates(tmp_path / "f1"))
    equal(want, read_rates(tmp_path / "f2"))


@pytest.mark.parametrize("law", [LIQUID, GAS], ids=["taitwater", "idealgas"])
def test_short_runs(lmp, tmp_path, law):
    """100 steps: the same to the growth of round-off"""
    state = random_fluid(8, seed=31, jitter=0.1, speed=0.2, types=types(law))
    text = ""
    for k, (style, fix) in enumerate([("stock", "sph"), ("hvi", "sph"), ("hvi", "hvi/sph")]):
        text += "clear\n" + scene(state, tmp_path / "s.data", law[style], fix=f"fix 1 all {fix}\n", sort=False)
        text += START + "timestep 0.002\nrun 100\n" + RATES.format(f"f{k}")
    lmp(text)
    want, one, two = (read_rates(tmp_path / f"f{k}") for k in range(3))
    assert np.abs(want["x"] - state.x).max() > 0.01
    for got in (one, two):
        for name in ("x", "v", "rho", "esph"):
            assert np.abs(got[name] - want[name]).max() <= 1e-11 * np.abs(want[name]).max(), name


SUM = """pair_style hybrid/overlay sph/rhosum 1 {style}
pair_coeff * * sph/rhosum 2.4
pair_coeff * * {coeff}
"""


@pytest.mark.parametrize("nranks", [1, 2])
def test_overlay_with_rhosum_and_walls(lmp, tmp_path, nranks):
    """density summed by the stock style, walls whose density and energy fix sph/stationary integrates"""
    state = random_fluid(12, dim=2, seed=33, jitter=0.1, types=1)
    text = ""
    cases = [("sph/idealgas", "sph/idealgas 0.75 2.4", "sph"),
             ("hvi/sph lucy stock yes viscosity 0.75 0", "hvi/sph eos idealgas 1.4 h 2.4", "hvi/sph")]
    for k, (style, coeff, fix) in enumerate(cases):
        text += "clear\n" + scene(state, tmp_path / "s.data", SUM.format(style=style, coeff=coeff), fix="")
        text += "region low block INF INF INF 3 INF INF\ngroup wall region low\ngroup gas subtract all wall\n"
        text += f"velocity wall set 0 0 0\nfix 1 gas {fix}\nfix 2 wall sph/stationary\n{START}timestep 0.005\nrun 60\n" + RATES.format(f"f{k}")
    lmp(text, nranks=nranks)
    want, got = read_rates(tmp_path / "f0"), read_rates(tmp_path / "f1")
    low = state.x[:, 1] < 3
    assert np.array_equal(got["x"][low], want["x"][low]) and np.abs(want["esph"][low] - state.esph[low]).max() > 1e-3
    for name in ("x", "v", "rho", "esph"):
        assert np.abs(got[name] - want[name]).max() <= 1e-11 * np.abs(want[name]).max(), name


def test_restart_of_stock_mode(lmp, tmp_path):
    """fix hvi/sph in stock mode starts a run as fix sph does"""
    state = random_fluid(7, seed=35, speed=0.2)
    text = ""
    for k, (style, fix) in enumerate([("stock", "sph"), ("hvi", "hvi/sph")]):
        text += "clear\n" + scene(state, tmp_path / "s.data", LIQUID[style], fix=f"fix 1 all {fix}\n", sort=False)
        text += START + "timestep 0.002\nrun 20\n" + START + "run 20\n" + RATES.format(f"f{k}")
    lmp(text)
    want, got = read_rates(tmp_path / "f0"), read_rates(tmp_path / "f1")
    for name in ("x", "v", "rho", "esph"):
        assert np.abs(got[name] - want[name]).max() <= 1e-11 * np.abs(want[name]).max(), name


@pytest.mark.parametrize("words", ["form sum", "h variable", "interface 0.3", "energy no", "dim 1"])
def test_stock_mode_is_refused(lmp, words):
    r = lmp(f"units lj\natom_style sph\nregion b block 0 4 0 4 0 4\ncreate_box 1 b\npair_style hvi/sph lucy stock yes {words}\n",
            expect_fail=True)
    assert "stock yes does what the package SPH does" in r.error
