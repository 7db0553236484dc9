"""Spall voids: what rows bear that are stretched at a constant rate, against an integration of the equations of the law by themselves."""

import numpy as np
import pytest
from solid_runs import Gruneisen, material, row, run

EOS = Gruneisen(2703.0, 5240.0, 1.4, 1.97)
G, Y = 27.6e9, 0.29e9
LAW = dict(sigma=1.2e9, rate=1e5, m=0.2, phi_c=0.075)


def metal(path):
    return material(path, "eos gruneisen rho0 2703 C 5240 S1 1.4 g0 1.97 a 1.97 cp 885", f"strength perfect G {G} Y {Y}",
                    "spall voids " + " ".join(f"{k} {v}" for k, v in LAW.items()), units="si")


def tension(rho, e):
    """in tension the law of the package goes on with rho0 c0^2 mu; Gamma rho is constant with a = g0"""
    mu = rho / EOS.rho0 - 1
    return -(EOS.rho0 * EOS.c0**2 * mu + (EOS.g0 + 1.97 * mu) * EOS.rho0 * e)


def integrated(rate, step=1e-5):
    """stretched in one direction with v = rate x, from rest: time, tension, phi, D; the midpoint rule, steps short for how fast tension relaxes"""
    t = phi = D = e = 0.0
    out = []

    def rates(t, phi, D, e):
        rho, div = EOS.rho0 / (1 + rate * t), rate / (1 + rate * t)
        T = (1 - phi) * tension(rho / (1 - phi), e)
        S = min(4 / 3 * G * np.log(1 + rate * t), 2 / 3 * Y * (1 - D))
        grow = LAW["rate"] * (T / (LAW["sigma"] * (1 - D))) ** (1 / LAW["m"]) if T > 0 else 0.0
        return T, (1 - phi) * grow, (1 - phi) * grow / LAW["phi_c"], (T + S) * div / rho

    while D < 0.999:
        T, *a = rates(t, phi, D, e)
        out.append((t, T, phi, D))
        relax = a[0] / LAW["m"] * EOS.rho0 * EOS.c0**2 / max(T, 1.0) + a[1] / (1 - D) / LAW["m"]
        dt = min(step / rate, 0.05 / relax if relax > 0 else 1)
        b = rates(t + 0.5 * dt, phi + 0.5 * dt * a[0], D + 0.5 * dt * a[1], e + 0.5 * dt * a[2])[1:]
        t, phi, D, e = t + dt, phi + dt * b[0], D + dt * b[1], e + dt * b[2]
    return np.array(out).T


def stretched(lmp, folder, rate, n, c=6600.0, strain=0.11):
    """the middle of a row with v = rate x, which release from its free ends does not reach before it has failed"""
    length = 2.2 * c * strain / rate
    s = row(length, n, margin=strain * length, rho=EOS.rho0)
    s.v[:, 0] = rate * (s.x[:, 0] - 0.5 * s.box[0])
    dx = length / n
    dt = 0.2 * dx / c
    steps = int(strain / rate / dt)
    path = metal(folder / "metal.hvi")
    pair = f"pair_style hvi/sph quintic dim 1 viscosity 0 0\npair_coeff 1 1 file {path} h {1.2 * dx:.17g}\n"
    r = run(lmp, folder, s, pair, "strength perfect damage no spall voids", steps, dt=dt, frames=1, every=50, units="si", name="s")
    mid = n // 2
    f = {q: np.array([frame[q][mid] for frame in r.frames]) for q in ("p", "voids", "void_damage", "spalled", "vm", "rho")}
    f["t"] = np.array([frame["time"] for frame in r.frames])
    return r, f


@pytest.mark.parametrize("rate", [pytest.param(1e4, marks=pytest.mark.long), 1e5, pytest.param(1e6, marks=pytest.mark.long)])
def test_strength_at_a_rate(lmp, tmp_path, rate):
    t, T, phi, D = integrated(rate)
    r, f = stretched(lmp, tmp_path, rate, 400)
    ratio = -f["p"].min() / T.max()
    failed = f["t"][f["spalled"] > 0]
    print(rate, "peak", -f["p"].min(), "law", T.max(), "ratio", ratio, "of sigma", T.max() / LAW["sigma"] * (rate / LAW["rate"]) ** -LAW["m"],
          "failed", failed[0] / t[-1] if len(failed) else None, "phi", f["voids"].max() / phi[-1])
    assert ratio == pytest.approx(1, abs=0.003)
    assert len(failed) and failed[0] == pytest.approx(t[-1], rel=0.01)
    # all the way there
    before = (f["t"] < 0.95 * t[-1])
    assert np.abs(f["p"][before] + np.interp(f["t"][before], t, T)).max() < 0.03 * T.max()
    assert np.abs(f["voids"][before] - np.interp(f["t"][before], t, phi)).max() < 0.03 * LAW["phi_c"]
    assert np.abs(f["vm"][before & (f["t"] > 0.2 * t[-1])] - Y * (1 - np.interp(f["t"], t, D)[before & (f["t"] > 0.2 * t[-1])])).max() < 0.03 * Y
    assert np.abs(r.thermo["c_book[9]"] - 1).max() < 2e-4
