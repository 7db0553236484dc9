"""One-dimensional SPH with interface density dissipation, form "sum": the equations as written, for tests and tables.

Zisis, van der Linden & Giannopapa 2013, eqs 9-25, with the viscosity's dimension put right (q = rho_i rho_j Pi). With
V = m/rho, v_ij = v_i - v_j, x_ij = x_i - x_j, r = |x_ij|, dW = dW/dr(r, h_ij), h_ij = (h_i + h_j)/2, n = x_ij/r:

    drho_i = rho_i sum_j V_j v_ij.n dW + sum_j alpha (p_i - p_j)/c_ij V_j dW
    dv_i   = -(1/rho_i) sum_j V_j (p_i + p_j + q_ij) n dW
    de_i   =  (1/rho_i) sum_j V_j (p_i + q_ij/2) v_ij.n dW
    q_ij   = rho_i rho_j/rho_ij (-a c_ij mu + b mu^2) if v_ij.x_ij < 0, mu = h_ij v_ij.x_ij/(r^2 + 0.01 h_ij^2)

rho_ij and c_ij are means. Particles of different bodies with p_i + p_j <= 0 (unless tension is asked for) only approach: of their terms those with
q_ij remain, and v_ij.n dW in drho_i while they come nearer. Kernel: Gaussian cut at 3h, renormalized. Variable h: eq 20, dh/dt = -(h/rho) drho/dt, integrated:
h rho = const, and h stays within limits. Rates are those of the full step, with rho, e, v (and so h)
extrapolated to it from the half step before. Masses are per unit area. Units: any consistent set.
"""

import dataclasses
import math

import numpy as np

from . import measures

RANGE = 3.0  # support/h


def gradient(r, h):
    """dW/dr of the Gaussian, cut at 3h and renormalized for the cut"""
    q = r / h
    return np.where(q < RANGE, -2.0 * q * np.exp(-q * q) / (h * h * math.sqrt(math.pi) * math.erf(RANGE)), 0.0)


@dataclasses.dataclass
class State:
    """Arrays (n,): x, v, rho, e (per mass), m; material of each: rho0, K; material, body: numbers, from 0.

    h0: smoothing length at rho0; variable: h = h0 rho0/rho within limits, else h0
    """

    x: np.ndarray
    v: np.ndarray
    rho: np.ndarray
    e: np.ndarray
    h0: np.ndarray
    m: np.ndarray
    rho0: np.ndarray
    K: np.ndarray
    material: np.ndarray
    body: np.ndarray
    variable: bool = False
    limits: tuple = (0.5, 1.25)  # of h/h0

    @property
    def h(self):
        return self.h0 * np.clip(self.rho0 / self.rho, *self.limits) if self.variable else self.h0

    @property
    def p(self):
        return self.K * (self.rho / self.rho0 - 1.0)

    @property
    def c(self):
        return np.sqrt(self.K / self.rho0)


def create(layers, n, eta=1.2, variable=False):
    """particles 1/n apart, in the middles of equal parts of each layer; h0 = eta/n"""
    count = [round((a.hi - a.lo) * n) for a in layers]
    x = np.concatenate([a.lo + (np.arange(k) + 0.5) * (a.hi - a.lo) / k for a, k in zip(layers, count)])
    m, rho0, K, v, body, number = (np.repeat(values, count) for values in zip(
        *[(a.mass / k, a.rho0, a.K, float(a.u), a.body, number) for number, (a, k) in enumerate(zip(layers, count))]))
    return State(x, v, rho0.copy(), np.zeros_like(x), np.full_like(x, eta / n), m, rho0, K, number, body, variable)


def pairs(s):
    """indices i, j of all pairs within the support of their mean h, each once"""
    h = s.h
    order = np.argsort(s.x, kind="stable")
    x = s.x[order]
    reach, first, second = RANGE * h.max(), [], []
    for k in range(1, len(x)):
        near = np.flatnonzero(x[k:] - x[:-k] < reach)
        if not len(near):
            break
        first.append(order[near])
        second.append(order[near + k])
    i, j = np.concatenate(first), np.concatenate(second)
    near = np.abs(s.x[i] - s.x[j]) < RANGE * 0.5 * (h[i] + h[j])
    return i[near], j[near]


def automatic(p, rho, c, vn, bonded):
    """alpha of i and of j from the states on both sides of a pair, without a constant to choose.

    The velocity of the contact in the acoustic Riemann problem between i and j is the mean, weighted by z = rho c, plus
    (p_i - p_j)/(z_i + z_j) along n. Taking it in place of the mean of v_i and v_j in drho_i = rho_i sum_j V_j 2 (v_i - v*).grad W
    gives the density dissipation with alpha_i = 2 rho_i c_ij/(z_i + z_j). It moves volume between particles, and makes none:
    sum m dtau = -sum m drho/rho^2 = 0. So it is where two bodies meet. Within a body a pressure difference that comes with
    |dp| = z |dv| is a sound wave or a weak shock, which momentum and viscosity carry; only what is beyond that is an error of
    the density, and dissipated.
    p, rho, c: pairs of arrays, of i and of j; vn = v_ij.x_ij/r; bonded: the pair carries tension (one body)
    """
    z = rho[0] * c[0], rho[1] * c[1]
    dp = np.abs(p[0] - p[1])
    wave = np.where(bonded, np.minimum(*z) * np.abs(vn), 0.0)
    excess = np.maximum(0.0, dp - wave) / np.where(dp > 0.0, dp, 1.0)
    both = excess * (c[0] + c[1]) / (z[0] + z[1])
    return rho[0] * both, rho[1] * both


def rates(s, alpha=0.0, a=1.0, b=2.0, tension=False):
    """dv, drho, de, arrays (n,). alpha: number, or function as automatic(); a, b: viscosity; tension: also between bodies"""
    i, j = pairs(s)
    p, c, h, V = s.p, s.c, s.h, s.m / s.rho
    d = s.x[i] - s.x[j]
    r, h = np.abs(d), 0.5 * (h[i] + h[j])
    dW = gradient(r, h)
    vn = (s.v[i] - s.v[j]) * d / r  # < 0: approaching
    cij, rij = 0.5 * (c[i] + c[j]), 0.5 * (s.rho[i] + s.rho[j])
    mu = h * vn * r / (r * r + 0.01 * h * h)
    q = np.where(vn < 0.0, s.rho[i] * s.rho[j] / rij * (-a * cij * mu + b * mu * mu), 0.0)
    bonded = tension | (s.body[i] == s.body[j])
    carried = np.where(bonded | (p[i] + p[j] > 0.0), 1.0, 0.0)
    if callable(alpha):
        alpha_i, alpha_j = alpha((p[i], p[j]), (s.rho[i], s.rho[j]), (c[i], c[j]), vn, bonded)
    else:
        alpha_i = alpha_j = alpha
    force = -V[i] * V[j] * (carried * (p[i] + p[j]) + q) * dW * d / r  # on i
    phi = carried * (p[i] - p[j]) / cij * dW
    stretch = np.where(vn < 0.0, 1.0, carried)  # bodies that part do not stretch each other

    def total(on_i, on_j):
        return np.bincount(i, on_i, len(s.x)) + np.bincount(j, on_j, len(s.x))

    dv = total(force, -force) / s.m
    drho = s.rho * total(stretch * V[j] * vn * dW, stretch * V[i] * vn * dW) + total(alpha_i * V[j] * phi, -alpha_j * V[i] * phi)
    de = total(V[j] * (carried * p[i] + 0.5 * q) * vn * dW, V[i] * (carried * p[j] + 0.5 * q) * vn * dW) / s.rho
    return dv, drho, de


def run(s, tstop, dt, each=None, **how):
    """Leapfrog to tstop, in place; how: see rates(); each(t, s): called at every full step. Returns s at the full step.

    s holds full-step values extrapolated from the half step; v, rho, e here are those of the half step.
    """
    steps = round(tstop / dt)
    v, rho, e = s.v.copy(), s.rho.copy(), s.e.copy()
    dv, drho, de = rates(s, **how)
    for k in range(steps):
        if each:
            each(k * dt, s)
        kick = dt if k else 0.5 * dt
        v, rho, e = v + kick * dv, rho + kick * drho, e + kick * de
        s.x = s.x + dt * v
        s.v, s.rho, s.e = v + 0.5 * dt * dv, rho + 0.5 * dt * drho, e + 0.5 * dt * de
        dv, drho, de = rates(s, **how)
    if steps:
        s.v, s.rho, s.e = v + 0.5 * dt * dv, rho + 0.5 * dt * drho, e + 0.5 * dt * de
    if each:
        each(steps * dt, s)
    return s


def errors(s, exact, t, by="element"):
    """L1 errors of u, p and rho, a dict: see measures.l1"""
    return dict(zip(("u", "p", "rho"), measures.l1(s.m, s.x, (s.v, s.p, s.rho), exact, t, by)))
