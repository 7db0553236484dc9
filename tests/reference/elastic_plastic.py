"""Plates of elastic, perfectly plastic solids that meet: exact states behind plane shocks.

The deviator is hypoelastic, with constant shear modulus G and yield stress Y: in uniaxial strain the compressive stress is p + S with
S = min(4/3 G ln(rho/rho0), 2/3 Y). p is Grueneisen's law with a cubic Hugoniot, as in lib/hvi/material/hvi_eos_gruneisen.h (LS-DYNA's EOS 4).

A shock keeps mass, momentum and energy: with the mass flux m, and V = 1/rho, between ahead (0) and behind (1)

    u1 - u0 = m (V0 - V1),   sigma1 - sigma0 = m (u1 - u0),   e1 - e0 = 1/2 (sigma1 + sigma0) (V0 - V1).

Below the elastic limit there is one elastic shock; above it a precursor to rho0 exp(Y/(2G)), and a plastic shock as long as that is slower;
else one shock, overdriven. Since p is linear in e, the state behind a shock follows from its density in closed form.
"""

import dataclasses

import numpy as np
from scipy.optimize import brentq


@dataclasses.dataclass(frozen=True)
class Solid:
    """Grueneisen's law, and G and Y of perfect plasticity; a liquid has Y = 0"""

    rho0: float
    c0: float
    s1: float
    g0: float
    a: float = 0.0
    s2: float = 0.0
    s3: float = 0.0
    G: float = 0.0
    Y: float = 0.0

    def hugoniot(self, rho):
        """pressure and energy of the plain Hugoniot, from rest at rho0"""
        eta = 1 - self.rho0 / rho
        ph = self.rho0 * self.c0**2 * eta / (1 - eta * (self.s1 + eta * (self.s2 + eta * self.s3))) ** 2
        return ph, 0.5 * ph * eta / self.rho0

    def gamma(self, rho):
        return self.g0 + self.a * (rho / self.rho0 - 1)

    def p(self, rho, e):
        """in compression"""
        ph, eh = self.hugoniot(rho)
        return ph + self.gamma(rho) * self.rho0 * (e - eh)

    def deviator(self, rho):
        """S = -sxx"""
        return min(4 / 3 * self.G * np.log(rho / self.rho0), 2 / 3 * self.Y)

    def densest(self):
        """the density of the pole of the Hugoniot, infinite if there is none"""
        eta = np.linspace(0, 1, 100001)
        d = 1 - eta * (self.s1 + eta * (self.s2 + eta * self.s3))
        below = np.flatnonzero(d <= 0)
        return self.rho0 / (1 - eta[below[0] - 1]) if len(below) else np.inf


@dataclasses.dataclass(frozen=True)
class State:
    """behind a shock; u from the material at rest, sigma the compressive stress, m the mass flux through the shock, D its speed (at rest)"""

    rho: float
    u: float
    sigma: float
    p: float
    e: float
    m: float = 0.0
    D: float = 0.0


def behind(solid, ahead, rho):
    """the state of this density behind a shock into the state ahead"""
    dV, S = 1 / ahead.rho - 1 / rho, solid.deviator(rho)
    slope = solid.gamma(rho) * solid.rho0  # dp/de
    p = (solid.p(rho, ahead.e) + 0.5 * slope * (ahead.sigma + S) * dV) / (1 - 0.5 * slope * dV)
    sigma = p + S
    m = np.sqrt((sigma - ahead.sigma) / dV)
    return State(rho, ahead.u + m * dV, sigma, p, ahead.e + 0.5 * (sigma + ahead.sigma) * dV, m, ahead.u + m / ahead.rho)


def to_speed(solid, ahead, u):
    """the state behind one shock into the state ahead that brings the material to u"""
    # up to where the denominator above vanishes, or the pole of the Hugoniot
    top = min(solid.densest(), 20 * ahead.rho)
    while 0.5 * solid.gamma(top) * solid.rho0 * (1 / ahead.rho - 1 / top) >= 1:
        top = ahead.rho + 0.99 * (top - ahead.rho)
    hi = ahead.rho + np.array([1e-6, 1e-3, 1e-2, *np.linspace(0.02, 0.999, 200)]) * (top - ahead.rho)
    hi = next((r for r in hi if behind(solid, ahead, r).u > u), None)
    if hi is None:
        raise ValueError(f"Grueneisen's law with this Hugoniot has no shock to {u}")
    rho = brentq(lambda r: behind(solid, ahead, r).u - u, ahead.rho * (1 + 1e-13), hi, xtol=1e-15 * ahead.rho, rtol=1e-15)
    return behind(solid, ahead, rho)


def waves(solid, u):
    """states behind the shocks, the fastest first, that bring a solid from rest to u"""
    rest = State(solid.rho0, 0.0, 0.0, 0.0, 0.0)
    if solid.Y == 0:
        return [to_speed(solid, rest, u)]
    limit = behind(solid, rest, solid.rho0 * np.exp(solid.Y / (2 * solid.G)))
    if u > limit.u:
        plastic = to_speed(solid, limit, u)
        if plastic.m < limit.m:
            return [limit, plastic]
    return [to_speed(solid, rest, u)]


def impact(flyer, target, speed):
    """waves in a flyer of this speed (from its own rest) and a target at rest; the contact's velocity is that of the target's last"""

    def excess(u):
        return waves(target, u)[-1].sigma - waves(flyer, speed - u)[-1].sigma

    u = 0.5 * speed if flyer == target else brentq(excess, 1e-9 * speed, speed * (1 - 1e-9), xtol=1e-15 * speed, rtol=1e-15)
    return waves(flyer, speed - u), waves(target, u)


# Steinberg, UCRL-MA-106439 (1996): G0 and Y0

AL6061 = Solid(2703.0, 5240.0, 1.40, 1.97, 0.48, G=27.6e9, Y=0.29e9)
CU = Solid(8930.0, 3940.0, 1.489, 2.02, 0.47, G=47.7e9, Y=0.12e9)
TA = Solid(16690.0, 3410.0, 1.20, 1.67, 0.42, G=69e9, Y=0.77e9)
PB = Solid(11340.0, 2006.0, 1.429, 2.74, 0.54, 0.8506, -1.64, G=8.6e9, Y=0.008e9)
METALS = dict(al=AL6061, cu=CU, ta=TA, pb=PB)
