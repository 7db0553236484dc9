"""Where elements of fix hvi/fem and free particles meet: what it reflects, that it carries stress at rest, and what is conserved.

More kernels, n, angles and layers: tests/verify/interface.py, Howto_fem_interface.
"""

import numpy as np
import pytest
from interface_scenes import bar, reflection, spun, squeezed

PAIR = "dissipation riemann"
BOUNDS = {"smooth": 0.015, "steep": 0.025}


@pytest.fixture(scope="module")
def known():
    """bars of elements only, by pulse and its way"""
    return {}


def reflects(lmp, folder, known, pulse, far=100, **words):
    if (pulse, far) not in known:
        known[pulse, far] = bar(lmp, folder, "none", pulse=pulse, far=far)
    one = bar(lmp, folder, "right", pulse=pulse, pair=PAIR, far=far, **words)
    assert one["drift"] < 1e-4
    assert one["momentum"] < 1e-12
    return one, reflection(one, known[pulse, far])


@pytest.mark.parametrize("pulse, far", [("smooth", 60), *(pytest.param(one, 100, marks=pytest.mark.long) for one in BOUNDS)])
def test_pulse(lmp, tmp_path, known, pulse, far):
    """A pulse from elements into particles; a ragged interface is hardly worse, and a flat one does not push sideways"""
    one, flat = reflects(lmp, tmp_path, known, pulse, far)
    assert one["sideways"] < 1e-10
    assert 0.0 < flat < BOUNDS[pulse]
    assert reflects(lmp, tmp_path, known, pulse, far, ragged=True)[1] < flat + 0.003


@pytest.mark.long
@pytest.mark.parametrize("pulse", BOUNDS)
def test_other_kernel(lmp, tmp_path, known, pulse):
    one, found = reflects(lmp, tmp_path, known, pulse, kernel="wendland2 1.6")
    assert one["sideways"] < 1e-10
    assert 0.0 < found < BOUNDS[pulse]


def test_tied(lmp, tmp_path):
    """is hybrid as long as nothing fails: the same bits"""
    words = dict(pair=PAIR, far=30, ragged=True)
    hybrid, tied = (bar(lmp, tmp_path, "right", fem=fem, **words) for fem in ("", "convert no"))
    assert np.abs(hybrid["end"]).max() > 0.4
    assert np.array_equal(hybrid["end"], tied["end"])


def test_nothing_held(lmp, tmp_path, known):
    """Without particles in elements there is a gap, and the measure says so: a free end reflects all (elements damp it on its way)"""
    found = reflects(lmp, tmp_path, known, "smooth", 60, hold=0)[1]
    print(f"reflected {100 * found:.2f} %")
    assert 0.9 < found < 1.01


@pytest.mark.long
def test_into_elements(lmp, tmp_path):
    """The pulse is in particles most of the time, which keep energy to 1.2e-4 without any elements"""
    one, reference = (bar(lmp, tmp_path, free, pair=PAIR, far=60, side=1) for free in ("right", "all"))
    assert one["drift"] < reference["drift"] + 1e-5
    assert one["momentum"] < 1e-12
    assert reflection(one, reference) < BOUNDS["smooth"]


@pytest.mark.parametrize("kernel, bound", [("cubic 1.2", 0.02), pytest.param("wendland2 1.6", 1e-3, marks=pytest.mark.long)])
def test_at_rest(lmp, tmp_path, kernel, bound):
    """A body under uniform strain: what pairs and elements do to a node or a particle cancels, and it stays at rest"""
    for ragged, limit in ((False, bound), (True, 0.022)):  # speeds of ragged ones: 0.025, 0.030 (with hourglass/viscous 0.1 0.022, 0.025)
        out = squeezed(lmp, tmp_path, kernel=kernel, pair=PAIR, ragged=ragged)
        assert 0.0 < out["nodes"] < limit
        assert 0.0 < out["free"] < limit
        assert out["speed"] < 1.5 * limit


@pytest.mark.parametrize("kernel", ["cubic 1.2", pytest.param("wendland2 1.6", marks=pytest.mark.long)])
def test_spin(lmp, tmp_path, kernel):
    """A block, half elements and half particles, turns as one body"""
    turned, drift, result = spun(lmp, tmp_path, kernel=kernel, pair=PAIR)
    assert turned < 1e-7
    assert drift < 1e-6
    assert result.thermo["f_wall"][-1] == result.thermo["f_wall"][0]
