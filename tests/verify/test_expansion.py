"""Bodies that expand until they break, against Grady's size of fragments: bars held sideways by spall voids, thin rings. Long form: tests/verify/expansion.py"""

import numpy as np
import pytest
from expansion_scenes import bar, count, grady, ring

ART = "cubic dim 2 dissipation riemann artstress 0.3 4"


def test_bars(lmp, root, tmp_path):
    """Number of sound pieces over Grady's: within a factor of five, the same at any rate, and not converged: it grows with the particles in a piece.

    The theory has one energy per volume; the law takes up the less the thinner the layer that fails.
    """
    number, length = {}, 24
    for rate, across in ((1e4, 20), (1e5, 20), (1e6, 20), (1e5, 10), (1e5, 40)):
        r, f = bar(lmp, root, tmp_path, rate, across, fragments=length)
        n, failed = count(r, f)
        number[rate, across] = n / length
        sizes = f["fragsize"][failed]
        print(f"{rate:g}/s, {across} particles in a Grady size: {n / length:.2f} pieces, failed {failed.mean():.3f}, fragsize/s {np.median(sizes) / grady(rate):.2f}")
        assert 1.5 < n / length < 5 and 0.05 < failed.mean() < 0.6, (rate, across)
        assert np.abs(r.thermo["c_book[9]"] - 1).max() < 1e-6, (rate, across)
        assert np.median(sizes) == pytest.approx(grady(rate), rel=0.15)  # what particles say of themselves is the theory
    rates = [number[rate, 20] for rate in (1e4, 1e5, 1e6)]
    assert max(rates) / min(rates) < 1.15  # over a factor of a hundred in size
    assert 1 < number[1e5, 20] / number[1e5, 10] < 2 and 1 < number[1e5, 40] / number[1e5, 20] < 1.5


def test_bar_without_scatter(lmp, root, tmp_path):
    """nothing tells one place from the other: all of it fails at once, but for what release from the ends has reached"""
    r, f = bar(lmp, root, tmp_path, 1e5, 20, modulus=0)
    n, failed = count(r, f)
    assert n == 2 and failed.mean() > 0.9


def test_ring_does_not_spall(lmp, root, tmp_path):
    """the mean tension in a thin ring is that of plastic flow, Y/sqrt(3) in plane strain, a sixth of sigma: the law has nothing to do in it"""
    r, f = ring(lmp, root, tmp_path, 5e4, style=ART, strain=0.4)
    for f in r.frames:
        if f["time"] * 5e4 > 0.05:
            tension = -np.median(f["p"])
            n, failed = count(r, f)
            print(f"{5e4 * f['time']:.3f}: tension {tension:.3g}, pieces {n}, failed {failed.mean():.4f}, D {np.median(f['void_damage']):.4f}")
            assert failed.mean() < 0.01 and np.median(f["void_damage"]) < 0.01
        if 0.05 < f["time"] * 5e4 < 0.32:
            Y = 3**0.5 * tension
            assert n == 1 and f["void_damage"].max() < 0.02 and np.median(f["vm"]) == pytest.approx(Y, rel=0.06)


@pytest.mark.long
def test_ring_with_johnson_cook(lmp, root, tmp_path):
    """strain breaks it: damage johnson-cook with scatter, artificial stress against clumping; the number is Grady's within a factor of five at any rate"""
    ratio = []
    for rate in (5e4, 1e5):
        r, f = ring(lmp, root, tmp_path, rate, words="damage johnson-cook spall voids weibull 20 7", style=ART, strain=0.5)
        n, failed = count(r, f)
        ratio.append(n / (2 * np.pi * 20e-3 / grady(rate)))
        print(f"{rate:g}/s: pieces {n}, over Grady's {ratio[-1]:.2f}, failed {failed.mean():.3f}")
        assert 1 < ratio[-1] < 5 and 0.02 < failed.mean() < 0.4, rate
        assert np.abs(r.thermo["c_book[9]"] - 1).max() < 1e-6, rate
    assert ratio[1] == pytest.approx(ratio[0], rel=0.25)
