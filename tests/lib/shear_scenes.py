"""Flow in two dimensions that dissipation should leave alone: a shear layer and Gresho's vortex, by the pair style or by the prototype of it.

    python3 tests/lib/shear_scenes.py --lmp build/lmp layers "words=dissipation riemann" laws=gas sizes=16,32,64
    python3 tests/lib/shear_scenes.py vortices "words=viscosity 1 2" sizes=32,64

print, for these numbers of particles per wavelength, effective viscosities (tait16, gas16 ...), or the part of kinetic energy that is left and the mean error
of velocity (kept32, error32 ...); layers_by_prototype, vortices_by_prototype: with viscosity=None for Riemann problems, balsara=True, corrected=True.
"""

import pathlib
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "python")]
from dumps import read_dump  # noqa: E402
from lammps_runs import command_line  # noqa: E402
from reference.flow2d import Flow  # noqa: E402
from sph_scenes import Fluid, ideal_gas, scene, tait  # noqa: E402

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


def solve(lmp, tmp_path, x, v, e, n, words, eos, kernel, t, rho=None, box=1.0, center=0.5, more="", eta=ETA):
    """thermo; x, v at the end"""
    def flat(a):
        return np.hstack([a, np.zeros((len(a), 1))])

    m = 1 / n**2
    s = Fluid(flat(x), flat(v), np.ones(len(x)) if rho is None else rho, m * e * np.ones(len(x)), np.ones(len(x), int), {1: m}, {1: eta / n},
              np.array([box, box, 20 / n]), (box == 1, box == 1, True), 2)
    pair = f"pair_style hvi/sph {kernel} {words}\npair_coeff * * eos {eos} h {eta / n}\n"
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


def layer(lmp, tmp_path, words, law, n, jitter=0.1, kernel=None, eta=ETA):
    """viscosity"""
    x, (eos, _, e) = square(n, jitter), LAWS[law]
    thermo, _, _ = solve(lmp, tmp_path, x, shear(x), e, n, words, eos, kernel or KERNELS[law], 1.0, eta=eta)
    return viscosity(thermo["c_K"][-1] / thermo["c_K"][0], thermo["v_t"][-1])


def prototype(law, n, jitter, **more):
    x, (_, laws, e) = square(n, jitter), LAWS[law]
    flow = Flow(x, shear(x), np.ones(len(x)), np.full(len(x), e), 1 / n**2, ETA / n, laws, KERNELS[law], **more)
    kinetic = flow.advance(1.0, 0.25 * ETA / n / 10)
    return viscosity(kinetic[-1] / kinetic[0], flow.t)


def layers(lmp, tmp_path, words, sizes, laws=tuple(LAWS), **more):
    return {f"{law}{n}": layer(lmp, tmp_path, words, law, n, **more) for law in np.atleast_1d(laws) for n in np.atleast_1d(sizes)}


def layers_by_prototype(lmp, tmp_path, sizes, laws=tuple(LAWS), jitter=0.1, **more):
    return {f"{law}{n}": prototype(law, n, jitter, **more) for law in np.atleast_1d(laws) for n in np.atleast_1d(sizes)}


# ------------------------------------------------------------------ Gresho's vortex: one turn of the innermost, c = 2.9


def gresho(r):
    """v, p: a triangle of velocity, highest at r = 0.2, that pressure holds"""
    s = np.maximum(r, 1e-9)
    v = np.where(r < 0.2, 5 * r, np.where(r < 0.4, 2 - 5 * r, 0))
    p = np.where(r < 0.2, 5 + 12.5 * r**2, np.where(r < 0.4, 9 + 12.5 * r**2 - 20 * r + 4 * np.log(s / 0.2), 3 + 4 * np.log(2)))
    return v, p


def turn(d, r):
    return np.stack([-d[:, 1], d[:, 0]], 1) / r[:, None]


def vortex_start(n):
    """x, v, p"""
    x = square(n, 0.0)
    r = np.hypot(*(x - 0.5).T)
    speed, p = gresho(r)
    return x, speed[:, None] * turn(x - 0.5, r), p


def vortex_error(x, v):
    d = x % 1 - 0.5
    r = np.hypot(*d.T)
    return np.abs((v * turn(d, r)).sum(1) - gresho(r)[0])[r < 0.5].mean()


def vortex(lmp, tmp_path, words, n):
    """kinetic energy kept, mean error of v, angular momentum over that of the start"""
    x, v, p = vortex_start(n)
    thermo, y, w = solve(lmp, tmp_path, x, v, 1.5 * p, n, words, f"idealgas {5 / 3!r}", "quintic", 0.4 * np.pi)
    return thermo["c_K"][-1] / thermo["c_K"][0], vortex_error(y, w), thermo["c_L"][-1] / thermo["c_L"][0]


def vortices(lmp, tmp_path, words, sizes):
    return {f"{name}{n}": value for n in np.atleast_1d(sizes) for name, value in zip(("kept", "error", "momentum"), vortex(lmp, tmp_path, words, n))}


def vortices_by_prototype(lmp, tmp_path, sizes, **more):
    out = {}
    for n in np.atleast_1d(sizes):
        x, v, p = vortex_start(n)
        flow = Flow(x, v, np.ones(len(x)), 1.5 * p, 1 / n**2, ETA / n, ideal_gas(5 / 3), "quintic", **more)
        kinetic = flow.advance(0.4 * np.pi, 0.25 * ETA / n / 4)
        out.update({f"kept{n}": kinetic[-1] / kinetic[0], f"error{n}": vortex_error(flow.x, flow.v)})
    return out


if __name__ == "__main__":
    command_line(__doc__, (layers, layers_by_prototype, vortices, vortices_by_prototype))
