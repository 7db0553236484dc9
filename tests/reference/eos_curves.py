#!/usr/bin/env python3
"""Equations of state in figures: Hugoniots against measured ones, and what a law's vapor changes in releases from shocks.

    python3 tests/reference/eos_curves.py hugoniots     Tillotson's law: speed of shocks off c + s u, %, at particle velocities up to 5 km/s
    python3 tests/reference/eos_curves.py release       aluminum 1100 released to p = 0: density, energy and velocity, with hot expanded
                                                        matter and without, %

The laws are those of python/hvi/material/curves.py, which tests/python/test_material.py compares with LAMMPS.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
if __name__ == "__main__":
    sys.path[:0] = [str(ROOT / "python")]

import numpy as np  # noqa: E402
from hvi.material import curves, library  # noqa: E402

MEASURED = {"Al-Tillotson": (5386, 1.339, 500), "Cu-Tillotson": (3940, 1.489, 500), "Fe-Tillotson": (3955, 1.580, 1000)}  # c, s, first u: see test_eos_tillotson.cpp


def law(name):
    return curves.Eos(library.read(ROOT / "potentials" / f"{name}.hvi"))


def off(name):
    """speed of shocks over the measured one - 1, least and most"""
    c, s, first = MEASURED[name]
    u = np.arange(first, 5001.0, 250.0)
    found = law(name).hugoniot(u)[0] / (c + s * u) - 1
    return found.min(), found.max()


def released(eos, u, step=1e-4):
    """density, energy and velocity where the isentrope from the shock with this particle velocity comes to p = 0, and the pressure of the shock"""
    _, p0, rho, e = (float(a) for a in eos.hugoniot(u))
    speed = u

    def c(rho, e):
        d, p = 1e-5 * rho, eos.pressure(rho, e)
        up, down = (float(eos.pressure(rho + k * d, e + k * d * p / rho**2)) for k in (1, -1))
        return np.sqrt(max(up - down, 0.0) / (2 * d))

    def de(x, e):  # by ln rho
        return float(eos.pressure(np.exp(x), e)) / np.exp(x)

    x, p, sound = np.log(rho), p0, c(rho, e)
    while p > 0:
        k1 = de(x, e)
        k2 = de(x - step / 2, e - step / 2 * k1)
        k3 = de(x - step / 2, e - step / 2 * k2)
        k4 = de(x - step, e - step * k3)
        last = x, e, speed, p
        x, e = x - step, e - step / 6 * (k1 + 2 * (k2 + k3) + k4)
        now = c(np.exp(x), e)
        speed, sound, p = speed + 0.5 * step * (sound + now), now, float(eos.pressure(np.exp(x), e))
    part = last[3] / (last[3] - p)  # of the last step, to p = 0
    x, e, speed = (a + part * (b - a) for a, b in zip(last[:3], (x, e, speed)))
    return np.array([np.exp(x), e, speed]), p0


def main():
    if sys.argv[1:] == ["hugoniots"]:
        for name in MEASURED:
            low, high = off(name)
            print(f"{name} {100 * low:.2f} to {100 * high:.2f} %")
    elif sys.argv[1:] == ["release"]:
        eos, line = law("Al1100-O"), law("Al1100-O")
        line._expanded = lambda rho, p, thin: p
        for u in (6000.0, 10000.0):
            (with_it, p), (without, _) = released(eos, u), released(line, u)
            change = 100 * np.abs(with_it / without - 1)
            print(f"two bodies at {2e-3 * u:g} km/s, {1e-9 * p:.0f} GPa: density {change[0]:.3f}, energy {change[1]:.3f}, velocity {change[2]:.4f} %")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
