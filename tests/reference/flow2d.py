"""Smooth flow in two dimensions, periodic unit square, equal masses, constant h: both dissipations of pair style hvi/sph, and two
things the style does not have, to see what they would bring.

balsara: Monaghan's viscosity, or the jump of velocity in Riemann problems, times (f_i + f_j)/2,
    f = |div v|/(|div v| + |curl v| + 1e-4 c/h) (Balsara 1995)
corrected: gradients of dissipation riemann times the inverse of sum_j V_j (x_j - x_i) (x) grad W_ij (exact for linear fields)

Rates and leapfrog as in doc/src/Howto_sph.rst and on the page of fix hvi/sph.
"""

import dataclasses

import numpy as np
from scipy.spatial import cKDTree
from sph_scenes import SUPPORT, norm, shape


@dataclasses.dataclass
class Flow:
    """x, v (n, 2); rho, e (n,), e per mass; law(rho, e) -> p, c"""

    x: np.ndarray
    v: np.ndarray
    rho: np.ndarray
    e: np.ndarray
    m: float
    h: float
    law: object
    kernel: str = "cubic"
    viscosity: tuple = (1.0, 2.0)  # None: riemann
    balsara: bool = False
    corrected: bool = False

    def __post_init__(self):
        self.scale = norm(self.kernel, 2) / self.h**2
        self.W0 = self.scale * shape(self.kernel, np.zeros(1))[0][0]

    def rates(self, v, rho, e):
        """dv/dt, drho/dt, de/dt"""
        n, V = len(rho), self.m / rho
        p, c = self.law(rho, e)
        tree = cKDTree(self.x % 1.0, boxsize=1.0)
        i, j = tree.query_pairs(SUPPORT[self.kernel] * self.h, output_type="ndarray").T
        d = self.x[i] - self.x[j]
        d -= np.round(d)
        r = np.hypot(*d.T)
        w, dw = shape(self.kernel, r / self.h)
        w, F = self.scale * w, self.scale / self.h * dw / r
        vij = v[i] - v[j]
        u = (vij * d).sum(1)
        self.pairs = (V, p, c, d, r, w, F, vij, u)

        def total(one, other):  # what i gets, what j gets
            return np.bincount(i, one, n) + np.bincount(j, other, n)

        force, drho, dE = (self.monaghan if self.viscosity else self.riemann)(i, j, v, rho, total)
        f = [total(force * d[:, a], -force * d[:, a]) for a in (0, 1)]
        return np.stack(f, 1) / self.m, drho, dE / self.m

    def monaghan(self, i, j, v, rho, total):
        V, p, c, d, r, w, F, vij, u = self.pairs
        mu = self.h * np.minimum(u, 0) / (r**2 + 0.01 * self.h**2)
        a, b = self.viscosity
        q = rho[i] * rho[j] * (-a * 0.5 * (c[i] + c[j]) * mu + b * mu**2) / (0.5 * (rho[i] + rho[j]))
        if self.balsara:
            turn = d[:, 0] * vij[:, 1] - d[:, 1] * vij[:, 0]
            div, curl = (np.abs(total(V[j] * s * F, V[i] * s * F)) for s in (u, turn))
            q *= self.switch(i, j, div, curl, c)
        work = V[i] * V[j] * u * F
        return (-V[i] * V[j] * (p[i] + p[j] + q) * F, rho * total(V[j] * u * F, V[i] * u * F),
                total(work * (p[i] + 0.5 * q), work * (p[j] + 0.5 * q)))

    def switch(self, i, j, div, curl, c):
        f = div / (div + curl + 1e-4 * c / self.h)
        return 0.5 * (f[i] + f[j])

    def gradients(self, i, j, a, total):
        """(n, 2): of a, its differences weighted with volumes"""
        V, p, c, d, r, w, F, vij, u = self.pairs
        g = np.stack([total(-V[j] * (a[i] - a[j]) * F * d[:, k], -V[i] * (a[i] - a[j]) * F * d[:, k]) for k in (0, 1)], 1)
        if not self.corrected:
            return g
        B = np.empty((len(a), 2, 2))
        for k in (0, 1):
            for l in (0, 1):
                B[:, k, l] = total(-V[j] * d[:, k] * d[:, l] * F, -V[i] * d[:, k] * d[:, l] * F)
        return np.linalg.solve(B, g[:, :, None])[:, :, 0]

    def riemann(self, i, j, v, rho, total, A=1.2, steep=1.5):
        V, p, c, d, r, w, F, vij, u = self.pairs

        def limited(a, b):
            size = np.minimum(0.5 * np.abs(a + b), 2 * np.minimum(np.abs(a), np.abs(b)))
            return np.where(a * b > 0, np.sign(a) * size, 0.0)

        u = u / r
        e = d / r[:, None]
        gv = [self.gradients(i, j, v[:, k], total) for k in (0, 1)]
        gp = self.gradients(i, j, p, total)
        along = [sum((gv[k][s] * e).sum(1) * e[:, k] for k in (0, 1)) for s in (i, j)]
        keep = 0.5 / (1 + steep * np.maximum(0, -u) / np.minimum(c[i], c[j]))
        u_i, u_j = (keep * limited(u, 2 * r * a - u) for a in along)
        dp = p[i] - p[j]
        dp_i, dp_j = (0.5 * limited(dp, 2 * r * (gp[s] * e).sum(1) - dp) for s in (i, j))
        z_i, z_j = rho[i] * c[i], rho[j] * c[j]
        sound = (0.5 * u * (z_i - z_j) - dp) / (z_i + z_j)
        z_i, z_j = z_i + A * rho[i] * np.maximum(0, sound - 0.5 * u), z_j + A * rho[j] * np.maximum(0, -0.5 * u - sound)
        jump = u_i + u_j - u
        if self.balsara:
            div, curl = np.abs(gv[0][:, 0] + gv[1][:, 1]), np.abs(gv[1][:, 0] - gv[0][:, 1])
            jump *= self.switch(i, j, div, curl, c)
        star = (z_j * (p[i] - dp_i) + z_i * (p[j] + dp_j) + z_i * z_j * jump) / (z_i + z_j)
        delta = (0.5 * (z_i - z_j) * u + z_j * u_j - z_i * u_i + dp_i + dp_j - dp) / (z_i + z_j)
        number = total(w, w) + self.W0
        G_i, G_j = (V[k] / number[k] * F * r for k in (i, j))
        flow = 2 * V[i] * V[j] / (V[i] + V[j]) * 2 * F * r * delta
        G = G_i + G_j
        return (-star * G / r, rho * (total(u * F * r, u * F * r) / number + total(-flow, flow)),
                total(star * (G_i * u - G * delta), star * (G_j * u + G * delta)))

    def advance(self, t, dt):
        """about t; kinetic energy per mass at every step"""
        steps = int(np.ceil(t / dt))
        ve, re, ee = self.v.copy(), self.rho.copy(), self.e.copy()
        rates = self.rates(ve, re, ee)
        kinetic = [0.5 * (self.v**2).sum(1).mean()]
        for _ in range(steps):
            ve, re, ee = (s + dt * k for s, k in zip((self.v, self.rho, self.e), rates))
            half = [s + 0.5 * dt * k for s, k in zip((self.v, self.rho, self.e), rates)]
            self.x = self.x + dt * half[0]
            rates = self.rates(ve, re, ee)
            self.v, self.rho, self.e = (s + 0.5 * dt * k for s, k in zip(half, rates))
            kinetic.append(0.5 * (self.v**2).sum(1).mean())
        self.t = steps * dt
        return np.array(kinetic)
