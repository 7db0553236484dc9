"""What dissipation does to motion that it should leave alone: a shear layer, Gresho's vortex, a body in rigid rotation.

Two dimensions. The figures are in doc/src/Howto_sph_verification.rst, "Shear and rotation".
"""

import functools

import numpy as np
import pytest
from dumps import read_dump
from reference.flow2d import Flow
from sph_scenes import Fluid, ideal_gas, scene, tait

WORDS = {"monaghan 1 2": "viscosity 1 2", "monaghan 0.1 0.2": "viscosity 0.1 0.2", "riemann": "dissipation riemann"}
LAWS = {"tait": ("tait 1.0 10.0 7", tait(1.0, 10.0), 0.0), "gas": ("idealgas 1.4", ideal_gas(1.4), 100 / 0.56)}  # c = 10
KERNELS = {"tait": "cubic", "gas": "quintic"}
ETA = 1.2

RUN = """fix step all hvi/dt 0.3
variable t equal f_step[2]
compute K all ke
compute book all hvi/energy
variable L atom mass*((x-{center})*vy-(y-{center})*vx)
compute L all reduce sum v_L
thermo_style custom step v_t c_K c_L c_book[9]
thermo_modify norm no format float %.16g
thermo 50
fix stop all halt 1 v_t > {t} error continue message no
run 100000
write_dump all custom last x y vx vy modify sort id format float %.15g
"""


def square(n, jitter):
    """positions (n^2, 2) in the unit square"""
    x = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), -1).reshape(-1, 2) + 0.5
    return (x + np.random.default_rng(1).uniform(-jitter, jitter, x.shape)) / n % 1


def solve(lmp, tmp_path, x, v, e, n, words, eos, kernel, t, rho=None, box=1.0, center=0.5, more=""):
    """thermo; x, v at the end"""
    flat = lambda a: np.hstack([a, np.zeros((len(a), 1))])
    m = 1 / n**2
    s = Fluid(flat(x), flat(v), np.ones(len(x)) if rho is None else rho, m * e * np.ones(len(x)), np.ones(len(x), int), {1: m}, {1: ETA / n},
              np.array([box, box, 20 / n]), (box == 1, box == 1, True), 2)
    pair = f"pair_style hvi/sph {kernel} {words}\npair_coeff * * eos {eos} h {ETA / n}\n"
    thermo = lmp(scene(s, tmp_path / "s.data", pair, skin=0.3 / n) + more + RUN.format(t=t, center=center)).thermo
    a = read_dump(tmp_path / "last").table
    if not more:
        assert np.abs(thermo["c_book[9]"] - 1).max() < 1e-3
    return thermo, a[:, :2], a[:, 2:]


# ------------------------------------------------------------------ shear layer: v_x = sin(2 pi y), c = 10, one crossing


def viscosity(kinetic, t):
    """which makes a layer lose this part of its energy"""
    return -np.log(kinetic) / (8 * np.pi**2 * t)


def shear(x):
    return np.stack([np.sin(2 * np.pi * x[:, 1]), np.zeros(len(x))], 1)


@pytest.fixture
def layer(lmp, tmp_path):
    @functools.cache
    def run(name, law, n, jitter):
        x, (eos, _, e) = square(n, jitter), LAWS[law]
        thermo, _, _ = solve(lmp, tmp_path, x, shear(x), e, n, WORDS[name], eos, KERNELS[law], 1.0)
        return viscosity(thermo["c_K"][-1] / thermo["c_K"][0], thermo["v_t"][-1])

    return run


def prototype(law, n, jitter, **more):
    x, (_, laws, e) = square(n, jitter), LAWS[law]
    flow = Flow(x, shear(x), np.ones(len(x)), np.full(len(x), e), 1 / n**2, ETA / n, laws, KERNELS[law], **more)
    kinetic = flow.advance(1.0, 0.25 * ETA / n / 10)
    return viscosity(kinetic[-1] / kinetic[0], flow.t)


@pytest.mark.parametrize("jitter", [0.0, 0.1])
@pytest.mark.parametrize("law", LAWS)
def test_shear_layer(layer, law, jitter):
    """effective viscosity: goes with the spacing for monaghan, with its square or better for riemann"""
    nu = {name: [layer(name, law, n, jitter) for n in (16, 32)] for name in WORDS}
    for name, (coarse, fine) in nu.items():
        print(f"{law} {KERNELS[law]} jitter {jitter} {name:16} n = 16: {coarse:.5f}  32: {fine:.5f}  order {np.log2(coarse / fine):.1f}")
    order = {name: np.log2(coarse / fine) for name, (coarse, fine) in nu.items()}
    assert 0.8 < order["monaghan 1 2"] < 1.1 and 0.3 < order["monaghan 0.1 0.2"] < 1.1
    assert order["riemann"] > 1.9
    assert nu["riemann"][1] < 0.18 * nu["monaghan 1 2"][1]
    assert nu["riemann"][1] < 1.1 * nu["monaghan 0.1 0.2"][1]


def test_prototype_and_switches(layer):
    """the prototype has the style's viscosity; Balsara's switch divides that of monaghan by 7, of riemann by 10; corrected gradients by nothing"""
    cases = {"monaghan": dict(), "monaghan balsara": dict(balsara=True), "riemann": dict(viscosity=None),
             "riemann corrected": dict(viscosity=None, corrected=True), "riemann balsara": dict(viscosity=None, balsara=True)}
    nu = {name: prototype("tait", 16, 0.1, **more) for name, more in cases.items()}
    for name, value in nu.items():
        print(f"prototype, tait, cubic, jitter 0.1, n = 16: {name:18} {value:.5f}")
    assert nu["monaghan"] == pytest.approx(layer("monaghan 1 2", "tait", 16, 0.1), rel=0.05)
    assert nu["riemann"] == pytest.approx(layer("riemann", "tait", 16, 0.1), rel=0.05)
    assert 4 < nu["monaghan"] / nu["monaghan balsara"] < 10
    assert nu["riemann corrected"] == pytest.approx(nu["riemann"], rel=0.1)
    assert nu["riemann balsara"] < 0.25 * nu["riemann"]


# ------------------------------------------------------------------ rotation


def gresho(r):
    """v, p: a triangle of velocity, highest at r = 0.2, that pressure holds"""
    s = np.maximum(r, 1e-9)
    v = np.where(r < 0.2, 5 * r, np.where(r < 0.4, 2 - 5 * r, 0))
    p = np.where(r < 0.2, 5 + 12.5 * r**2, np.where(r < 0.4, 9 + 12.5 * r**2 - 20 * r + 4 * np.log(s / 0.2), 3 + 4 * np.log(2)))
    return v, p


def test_gresho_vortex(lmp, tmp_path):
    """one turn of the innermost, c = 2.9, quintic, n = 32"""
    n = 32
    x = square(n, 0.0)
    d = x - 0.5
    r = np.hypot(*d.T)
    speed, p = gresho(r)
    turn = lambda d, r: np.stack([-d[:, 1], d[:, 0]], 1) / r[:, None]
    kept, error = {}, {}
    for name, words in WORDS.items():
        thermo, y, v = solve(lmp, tmp_path, x, speed[:, None] * turn(d, r), 1.5 * p, n, words, f"idealgas {5 / 3!r}", "quintic", 0.4 * np.pi)
        d1 = y - 0.5
        r1 = np.hypot(*d1.T)
        kept[name] = thermo["c_K"][-1] / thermo["c_K"][0]
        error[name] = np.abs((v * turn(d1, r1)).sum(1) - gresho(r1)[0])[r1 < 0.5].mean()
        momentum = thermo["c_L"][-1] / thermo["c_L"][0]
        print(f"vortex {name:16} kinetic energy kept {kept[name]:.3f}, mean error of v {error[name]:.3f}, angular momentum {momentum:.3f}")
        assert momentum == pytest.approx(1, abs=0.15), name
    assert kept["riemann"] > 1.25 * kept["monaghan 1 2"] and error["riemann"] < 0.92 * error["monaghan 1 2"]
    # but the kinks at r = 0.2 and 0.4 are viscous: a tenth of Monaghan's viscosity keeps more
    assert kept["monaghan 0.1 0.2"] > 1.25 * kept["riemann"]


@pytest.mark.parametrize("name", ["monaghan 1 2", "riemann"])
def test_rigid_rotation(lmp, tmp_path, name):
    """a free disk of liquid turns once, held by a force towards its center: angular momentum to round-off"""
    n, K, omega, pull = 16, 100.0, 1.0, 5.0
    x = (np.stack(np.meshgrid(np.arange(-n, n), np.arange(-n, n), indexing="ij"), -1).reshape(-1, 2) + 0.5) / n
    r = np.hypot(*x.T)
    x, r = x[r < 1], r[r < 1]
    rho = 1 + 0.5 * (pull - omega**2) * (1 - r**2) / K
    v = omega * np.stack([-x[:, 1], x[:, 0]], 1)
    trap = f"variable fx atom -{pull}*mass*(x-2)\nvariable fy atom -{pull}*mass*(y-2)\nfix trap all addforce v_fx v_fy 0.0\n"
    thermo, y, w = solve(lmp, tmp_path, x + 2, v, 0.0, n, WORDS[name], f"linear 1.0 {K}", "cubic", 2 * np.pi, rho, 4.0, 2.0, trap)
    d = y - 2
    kept, L = thermo["c_K"] / thermo["c_K"][0], thermo["c_L"] / thermo["c_L"][0] - 1
    error = np.abs(w - omega * np.stack([-d[:, 1], d[:, 0]], 1)).mean()
    print(f"disk {name:16} kinetic energy kept {kept[-1]:.5f}, mean error of v {error:.4f}, angular momentum {np.abs(L).max():.1e}")
    assert np.abs(L).max() < 1e-12
    assert np.abs(kept - 1).max() < 0.03 and error < (0.012 if name == "riemann" else 0.002)
