"""The measurements of face_scenes.py themselves: theory in its limits, bulk, thin walls. The rest of what faces bear is in `make verify` (tests/verify/solids.py)."""

import numpy as np
import pytest
from face_scenes import CL, CP, CT, E, NU, borne, cylinder_stop, lamb, levers, mirror_face, plastic, wave

WORDS = "viscosity 0.1 0"


def test_theory_of_plates():
    """long waves are those of thin plates; bending ones have the first correction of Mindlin's plate, waves along it that of Poisson's ratio"""
    for k in (0.01, 0.02):
        thin = CP * 4 * k**2 / np.sqrt(12)
        shear = CP**2 / CT**2 * (6 - NU) / 5  # the coefficient of shear that is exact for long waves
        assert 1 - lamb(k, 4.0, True) / thin == pytest.approx(0.5 * (4 * k) ** 2 / 12 * (1 + shear), rel=0.01)
        assert 1 - lamb(k, 4.0, False) / (CP * k) == pytest.approx((2 * k * NU / (1 - NU)) ** 2 / 6, rel=0.01)
    assert levers("cubic", 0.6, 4) == pytest.approx(np.sqrt(1 - 1 / 16))  # neighbors in the own layer alone (and above and below: x = 0)
    assert levers("wendland2", 1.6, 64) == pytest.approx(1.0, rel=0.02)
    assert E == 16 and NU == pytest.approx(1 / 3)


def test_theory_of_the_cylinder():
    """plastic work is yield stress times what strain the particles end with, 2/sqrt(3) ln(x0/x)"""
    x0 = np.linspace(8, 10, 20001)
    strain = 2 / np.sqrt(3) * np.log(x0 / np.sqrt(x0**2 - 64 + 16))
    assert plastic(4.0) == pytest.approx(np.trapz(strain * 2 * np.pi * x0, x0), rel=1e-6)
    u = np.sqrt(plastic(4.0) * 0.0033 / (1.845 * np.pi * 64 * np.log(1.25)))
    assert cylinder_stop(u, 0.0, 1.845, 0.0033) == pytest.approx(4.0, abs=2e-3)
    # another way to the work of viscosity: 2 nu rho D:D, summed up over the wall
    x = np.linspace(6.0, np.sqrt(72.0), 20001)
    assert np.trapz(4 * (6 / x**2) ** 2 * 2 * np.pi * x, x) == pytest.approx(4 * np.pi * 36 * (1 / 36 - 1 / 72), rel=1e-6)
    assert cylinder_stop(u, 0.02, 1.845, 0.0033) > 4.05


@pytest.mark.long
@pytest.mark.parametrize("kernel, h", [("wendland2", 1.6), ("cubic", 1.2)])
def test_bulk(lmp, tmp_path, kernel, h):
    """no faces: all of the stress and of its gradient, less (k s)^2 at most of the wave's length, s^2 = h^2/2"""
    o = borne(lmp, tmp_path, 0, WORDS, kernel, h)
    print(o)
    for name in ("borne", "law", "shear_borne", "shear_law"):
        assert o[name] == pytest.approx(1.0, rel=(2 * np.pi / 200) ** 2 * 0.5 * h**2)
    assert o["stiffness"] == pytest.approx(1.0, rel=2e-3) and o["misfit"] < 1e-3
    p = wave(lmp, tmp_path, 0, WORDS, kernel, h)
    print(p)
    assert p["speed"] == pytest.approx(1.0, rel=2e-3) and p["front"] == pytest.approx(1.0, rel=5e-3)
    assert o["drift"] < 1e-3 and p["drift"] < 1e-3


@pytest.mark.each_value
@pytest.mark.parametrize("kernel, h", [("wendland2", 1.6), ("cubic", 1.2)])
@pytest.mark.parametrize("layers", [1, 2])
def test_thin_walls(lmp, tmp_path, kernel, h, layers):
    """even walls bear all of their stress; a wall of one layer has no thickness that could contract, so its law is that of bulk"""
    o = borne(lmp, tmp_path, layers, WORDS, kernel, h)
    print(o)
    for name in ("borne", "shear_borne", "shear_law", "shear_speed"):
        assert o[name] == pytest.approx(1.0, rel=2e-3), name
    assert o["law"] == pytest.approx((CL / CP) ** 2 if layers == 1 else 1.0, rel=2e-3)
    assert o["stiffness"] == pytest.approx(o["borne"] * o["law"], rel=1e-3)


def test_mirrored(lmp, tmp_path):
    """an eighth of a bar with three mirrors is the whole bar, at all times, its waves as strong as at the start"""
    o = mirror_face(lmp, tmp_path, 2)
    print(o)
    assert o["velocity"] < 1e-9 and o["stress"] < 1e-9
    assert 0.5 < o["largest"] < 2 and o["momentum"] < 1e-12
