"""python3 -m hvi crater: known craters in lattices, quarters, craters seen from the other side, targets that are too small."""

import hvi
import numpy as np
import pytest
from crater_targets import bowl, target
from hvi.analysis import crater
from hvi.errors import HVIError

A = 1.0


@pytest.mark.parametrize("depth, wide", [(8.0, 8.0), (6.5, 9.0), (10.0, 7.0)])
def test_bowl(depth, wide):
    """to a fraction of the spacing: depth, diameter, volume"""
    found = crater.measure(target(hole=bowl(depth, wide)), A, [2], toward=1)
    assert found.depth == pytest.approx(depth, abs=0.6 * A) and found.diameter == pytest.approx(2 * wide, abs=1.5 * A)
    assert found.volume == pytest.approx(2 / 3 * np.pi * wide**2 * depth, rel=0.08) and found.face == pytest.approx(0.0, abs=0.05)
    inner = found.r < 0.6 * wide
    np.testing.assert_allclose(-found.floor[inner], depth * np.sqrt(1 - (found.r[inner] / wide) ** 2), atol=0.7 * A)


def test_moved_turned_and_cut():
    """the same for a target that has moved, one that is struck from below, and a quarter"""
    plain = crater.measure(target(hole=bowl(8.0, 8.0)), A, [2], toward=1)
    moved = crater.measure(target(hole=bowl(8.0, 8.0), shift=(3.0, -2.0, 0.7)), A, [2], center=(3.0, -2.0), toward=1)
    assert (moved.depth, moved.diameter, moved.face) == pytest.approx((plain.depth, plain.diameter, plain.face + 0.7), abs=1e-9)
    frame = target(hole=bowl(8.0, 8.0))
    turned = hvi.Frame({**frame.columns, "z": -frame["z"]}, units="lj")
    assert crater.measure(turned, A, [2], toward=-1).depth == pytest.approx(plain.depth, abs=1e-9)
    sideways = hvi.Frame({**frame.columns, "x": frame["z"], "z": frame["x"]}, units="lj")
    assert crater.measure(sideways, A, [2], axis="x", toward=1).depth == pytest.approx(plain.depth, abs=1e-9)


def test_no_crater():
    found = crater.measure(target(), A, [2], toward=1)
    assert found.depth == pytest.approx(0.0, abs=0.02) and np.isnan(found.diameter) and found.volume == 0.0


def test_wrong():
    with pytest.raises(HVIError, match="no two particles of type 3"):
        crater.measure(target(), A, [3], toward=1)
    with pytest.raises(HVIError, match="no face from 0.7 to 0.9 of its radius: is it too small"):
        crater.measure(target(radius=12, deep=14, hole=lambda x: np.hypot(x[:, 0], x[:, 1]) < 11.2), A, [2], toward=1)
