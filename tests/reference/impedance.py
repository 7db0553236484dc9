"""Plates that meet, and sound at a step of impedance: exact solutions.

Plates have Hugoniots Us = c0 + s u, so P = rho0 Us u: Mie-Grueneisen's law gives these whatever Gamma is.
"""

import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class Metal:
    rho0: float
    c0: float
    s: float
    gamma: float = 2.0
    b: float = 0.48

    def pressure(self, u):
        """behind a shock that brings material from rest to u"""
        return self.rho0 * (self.c0 + self.s * u) * u

    def density(self, u):
        return self.rho0 * (self.c0 + self.s * u) / (self.c0 + (self.s - 1) * u)

    def shock_speed(self, u):
        return self.c0 + self.s * u


AL6061, AL2024, COPPER = Metal(2703.0, 5240.0, 1.40, 1.97), Metal(2785.0, 5328.0, 1.338, 2.00), Metal(8930.0, 3940.0, 1.489, 2.02, 0.47)


def match(flyer, target, speed):
    """velocity and pressure between a flyer and a target at rest: equal pressures, a quadratic equation for u"""
    a = flyer.rho0 * flyer.s - target.rho0 * target.s
    b = -flyer.rho0 * (flyer.c0 + 2 * flyer.s * speed) - target.rho0 * target.c0
    c = flyer.pressure(speed)
    u = -c / b if abs(a * speed) < 1e-12 * abs(b) else (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a)
    return u, target.pressure(u)


class Flyer:
    """Plate of thickness L on [-L, 0] at `speed`, target on [0, L] at rest, until the faster shock reaches a rear face.

    shift: velocity of the frame. at_mass(t): parts from left to right, dm, rho, u, p.
    """

    def __init__(self, flyer, target, speed, length, shift=0.0):
        self.flyer, self.target, self.speed, self.length, self.shift = flyer, target, speed, length, shift
        self.u, self.p = match(flyer, target, speed)
        self.us = flyer.shock_speed(speed - self.u), target.shock_speed(self.u)  # into the material at rest
        self.last = length / max(self.us)

    def at_mass(self, t):
        a, b, ua, ub = self.flyer, self.target, self.speed - self.u, self.u
        m = [a.rho0 * (self.length - self.us[0] * t), a.rho0 * self.us[0] * t, b.rho0 * self.us[1] * t, b.rho0 * (self.length - self.us[1] * t)]
        u = np.array([self.speed, self.u, self.u, 0.0]) + self.shift
        return np.array(m), np.array([a.rho0, a.density(ua), b.density(ub), b.rho0]), u, np.array([0.0, self.p, self.p, 0.0])


def coefficients(z1, z2):
    """of the pressure: reflected and transmitted, for a wave from z1 to z2"""
    return (z2 - z1) / (z2 + z1), 2 * z2 / (z2 + z1)


class Pulse:
    """A small pulse p(x) = amplitude cos^4 about x0, half width w, that moves right through rho, c = first into second at x = 0"""

    def __init__(self, first=(1.0, 1.0), second=(2.0, 1.5), amplitude=1e-4, x0=-0.5, w=0.25):
        self.first, self.second, self.amplitude, self.x0, self.w = first, second, amplitude, x0, w
        self.z1, self.z2 = first[0] * first[1], second[0] * second[1]
        self.r, self.t = coefficients(self.z1, self.z2)

    def shape(self, x):
        s = (x - self.x0) / self.w
        return self.amplitude * np.where(np.abs(s) < 1, np.cos(0.5 * np.pi * np.clip(s, -1, 1)) ** 4, 0.0)

    def at(self, x, t):
        """rho, u, p, of first order in the amplitude"""
        x = np.asarray(x, float)
        (rho1, c1), (rho2, c2) = self.first, self.second
        come, back, through = self.shape(x - c1 * t), self.r * self.shape(-x - c1 * t), self.t * self.shape((x / c2 - t) * c1)
        left = x < 0
        p = np.where(left, come + back, through)
        u = np.where(left, (come - back) / self.z1, through / self.z2)
        return np.array([np.where(left, rho1 + p / c1**2, rho2 + p / c2**2), u, p])
