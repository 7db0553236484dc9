"""The reference for plates of elastic, perfectly plastic solids (reference/elastic_plastic.py) against the jump conditions, published states and
the piston of solid_runs.py; and flyers of state_scenes.py against it, coarse."""

import dataclasses

import numpy as np
import pytest
from reference import impedance
from reference.elastic_plastic import AL6061, CU, METALS, PB, Solid, impact, waves
from solid_runs import Gruneisen, piston
from state_scenes import CASES, PISTON, flyer

TABLE = [(500, 3.777, 2829.5), (1000, 8.028, 2951.4), (2000, 17.948, 3182.3), (3000, 29.760, 3397.3), (5000, 59.061, 3785.9),
         (5941, 75.465, 3952.1), (6700, 89.917, 4079.1), (7000, 95.929, 4127.8), (10000, 165.424, 4569.7)]  # Al 6061, Us = c0 + s u: V, GPa, rho


def pressure(s, rho, e):
    """Grueneisen's law as LS-DYNA's manual prints it"""
    mu = rho / s.rho0 - 1
    top = 1 + (1 - 0.5 * s.g0) * mu - 0.5 * s.a * mu**2
    bottom = 1 - (s.s1 - 1) * mu - s.s2 * mu**2 / (mu + 1) - s.s3 * mu**3 / (mu + 1) ** 2
    return s.rho0 * s.c0**2 * mu * top / bottom**2 + (s.g0 + s.a * mu) * s.rho0 * e


def keep(solid, states):
    """mass, momentum and energy through each shock, in the frame of the material at rest; and the states themselves"""
    rho0, u0, sigma0, e0 = solid.rho0, 0.0, 0.0, 0.0
    for w in states:
        assert w.rho * (w.D - w.u) == pytest.approx(rho0 * (w.D - u0), rel=1e-10)
        assert w.sigma - sigma0 == pytest.approx(rho0 * (w.D - u0) * (w.u - u0), rel=1e-10)
        gain = rho0 * (w.D - u0) * (w.e + 0.5 * w.u**2 - e0 - 0.5 * u0**2)
        assert gain == pytest.approx(w.sigma * w.u - sigma0 * u0, rel=1e-10)
        assert w.p == pytest.approx(pressure(solid, w.rho, w.e), rel=1e-10)
        assert w.sigma - w.p == pytest.approx(min(4 / 3 * solid.G * np.log(w.rho / solid.rho0), 2 / 3 * solid.Y), rel=1e-10, abs=1e-10 * w.p)
        rho0, u0, sigma0, e0 = w.rho, w.u, w.sigma, w.e


@pytest.mark.parametrize("name", CASES)
def test_jumps(name):
    flying, target, speed = CASES[name]
    left, right = impact(flying, target, speed)
    keep(flying, left)
    keep(target, right)
    assert left[-1].sigma == pytest.approx(right[-1].sigma, rel=1e-10)
    assert left[-1].u + right[-1].u == pytest.approx(speed, rel=1e-12)


def test_waves():
    """elastic, two waves or one: speeds in order, a precursor at the elastic limit, and no jump in between"""
    for s in METALS.values():
        c = np.sqrt(s.c0**2 + 4 / 3 * s.G / s.rho0)
        tiny = waves(s, 1e-3)
        assert len(tiny) == 1 and tiny[0].D == pytest.approx(c, rel=1e-5), s
        found = [waves(s, u) for u in np.geomspace(1e-1, 3e3, 400)]
        count = [len(w) for w in found]
        assert list(np.diff(count)[np.diff(count) != 0]) == [1, -1], s
        two = [w for w in found if len(w) == 2]
        assert two[0][1].u < 1.03 * two[0][0].u, s  # the steps of u
        assert found[-1][0].D > two[0][0].D > two[-1][1].D, s
        for w in two:
            assert w[0].rho == pytest.approx(s.rho0 * np.exp(s.Y / 2 / s.G), rel=1e-12)
            assert w[1].D - w[0].u < w[0].rho / s.rho0 * w[0].D  # slower, per mass
        assert all(np.diff([w[-1].sigma for w in found]) > 0), s


def test_against_piston():
    eos = Gruneisen(PISTON.rho0, PISTON.c0, PISTON.s1, PISTON.g0)
    a, b = waves(PISTON, 0.01)
    want = piston(eos, PISTON.G, PISTON.Y, 0.01)
    for key, value in dict(rho1=a.rho, p1=a.p, u1=a.u, D1=a.D, rho2=b.rho, p2=b.p, u2=b.u, e2=b.e, D2=b.D, S=b.sigma - b.p).items():
        assert value == pytest.approx(want[key], rel=1e-10), key
    assert (a.D, b.D, b.rho, b.p) == pytest.approx((0.652066, 0.550553, 2.839227, 0.0144555), rel=1e-4)


def test_without_strength():
    liquid = dataclasses.replace(AL6061, Y=0.0)
    for V, p, rho in TABLE:
        (w,) = impact(liquid, liquid, V)[1]
        assert (round(w.p / 1e9, 3), round(w.rho, 1)) == (p, rho)
        assert w.D == pytest.approx(5240 + 1.40 * V / 2, rel=1e-10)
    al, cu = Solid(2785.0, 5328.0, 1.338, 2.00, 0.48), dataclasses.replace(CU, Y=0.0)
    (w,) = impact(al, cu, 5750.0)[1]
    assert (w.u, w.p) == pytest.approx(impedance.match(impedance.AL2024, impedance.COPPER, 5750.0), rel=1e-10)
    # a cubic Hugoniot: Us = C/(1 - S1 eta - S2 eta^2 - S3 eta^3), eta = u/Us
    (w,) = waves(dataclasses.replace(PB, Y=0.0), 500.0)
    eta = w.u / w.D
    assert w.D * (1 - 1.429 * eta - 0.8506 * eta**2 + 1.64 * eta**3) == pytest.approx(2006, rel=1e-10)


@pytest.mark.parametrize("name, n, kernel, h, bounds", [pytest.param("al-al-500", 128, "wendland2", 1.6, dict(sigma=0.003, rho=0.001, u=0.001, Us=0.01), marks=pytest.mark.long),
                                                          ("al-cu-5750", 96, "wendland2", 1.6, dict(sigma=0.012, rho=0.006, u=0.002, Us=0.006))])
def test_flyers(lmp, tmp_path, name, n, kernel, h, bounds):
    """the plateau bears p + 2 Y/3, of which the second is 5 % in the first case, and its mass goes where its density says"""
    out = flyer(lmp, tmp_path, *CASES[name], n=n, kernel=kernel, h=h)
    for side in ("flyer", "target"):
        got = {**out[side]["plateau"], "Us": out[side]["Us"]}
        print(side, {k: f"{v:+.2e}" for k, v in got.items()}, f"number {out[side]['number']:+.2e}")
        for key, bound in bounds.items():
            assert abs(got[key]) < bound, (side, key)
    assert out["drift"] < 1e-3 and out["momentum"] < 1e-12


def test_columns_are_exact(lmp, tmp_path):
    """what a column of one particle across gives is what one of 3 x 3 gives"""
    one, nine = (flyer(lmp, tmp_path, *CASES["al-cu-5750"], n=24, across=m)["target"] for m in (1, 3))
    for field in ("sigma", "rho", "u", "e"):
        assert nine["layers"][field] == pytest.approx(one["layers"][field], rel=1e-8, abs=1e-8 * np.abs(one["layers"][field]).max())
