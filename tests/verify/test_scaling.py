"""Plate on plate (Watson & Steinhauser, figure 4): energies do not depend on size if eps ~ s^3 and kappa ~ s."""

import numpy as np
import pytest

TIMES = np.linspace(0.0, 2.3, 200)  # microseconds


@pytest.fixture
def energies(lmp, root, tmp_path):
    """time, kinetic, contact, spring, broken, total; parts of the energy at the start"""

    def run(**variables):
        folder = tmp_path / "-".join(f"{k}{v}" for k, v in variables.items())
        folder.mkdir()
        lmp(root / "examples" / "dem-scaling" / "in.scaling", vars={**variables, "out": folder}, cwd=folder)
        table = np.loadtxt(next(folder.glob("energy-*.dat")))
        assert np.abs(table[:, 5] - 1).max() < 2e-5
        return table

    return run


def difference(a, b, column=1):
    """mean over time, of the kinetic energy unless said otherwise"""
    return np.abs(np.interp(TIMES, a[:, 0], a[:, column]) - np.interp(TIMES, b[:, 0], b[:, column])).mean()


def test_energies_of_two_sizes_agree_when_scaled(energies):
    """half the size, eight times the particles: within 4 %, wiggles of single layers; unscaled or as eq 5 is printed, not"""
    fine, coarse = energies(n=8), energies(n=4)
    unscaled = energies(n=4, scaled="no")
    printed = energies(n=4, eps=0.01 / 4)  # gamma = eps/s: eps twice, not eight times that of half the size
    assert fine[:, 1].min() < 0.6  # a good part of the energy is in contacts at the turning point
    assert difference(fine, coarse) < 0.04
    assert difference(fine, unscaled) > 0.08
    assert difference(fine, printed) > 0.06


def test_the_laws_have_no_length_of_their_own(energies):
    """everything twice as large, T for the same thermal speed: the same numbers at twice the time"""
    one = energies(n=4, tstop=1.0)
    two = energies(n=4, t=4, L=8, Tstart=2400, tstop=2.0)
    m = min(len(one), len(two))
    assert m > 50
    assert two[:m, 0] == pytest.approx(2 * one[:m, 0], rel=1e-4)
    assert np.abs(two[:m, 1:5] - one[:m, 1:5]).max() < 1e-4
