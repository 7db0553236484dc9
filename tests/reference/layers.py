"""Shocks through layered bodies with p = K (rho/rho0 - 1): exact Riemann solver, Lagrangian Godunov scheme.

Since p depends on rho only, mass and momentum determine the flow (a p-system). In the mass coordinate m, dm = rho dx:

    dtau/dt = du/dm,   du/dt = -dp/dm,   tau = 1/rho

The sound speed c = sqrt(K/rho0) is constant, p = c^2 (rho - rho0). Across any shock [p][tau] = -[u]^2 gives, with
d = rho_behind/rho_ahead, |u* - u| = c (d - 1)/sqrt(d) = 2 c sinh(ln(d)/2); across a rarefaction |u* - u| = c |ln d|. Both hold
from any state ahead, compressed or not. Waves move through the mass at c sqrt(rho_ahead rho_behind) and c rho.

Layers of one body are bonded: they carry tension. Different bodies only press on each other: an interface between bodies
opens where its pressure would be negative, and closes again when the gap does. Ends are free surfaces (p = 0).

Units: any consistent set; the cases below are dimensionless (closing speed u0 = 1, K = rho0 u0^2/Ca), Zisis, van der
Linden & Giannopapa 2013. One dimension: masses are per unit area.
"""

import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class Layer:
    """lo, hi: position at the start; rho0, K: material; u: velocity at the start; body: layers of one body are bonded"""

    name: str
    lo: float
    hi: float
    rho0: float
    K: float
    u: float
    body: int = 0

    @property
    def c(self):
        return np.sqrt(self.K / self.rho0)

    @property
    def mass(self):
        """per unit area; layers start at rho0"""
        return self.rho0 * (self.hi - self.lo)


# rho0 in kg/m^3 and Cauchy number of Zisis et al., table 3
MATERIALS = {"Al": (2700.0, 3.7), "Glass": (1900.0, 7.6), "Carbon": (1900.0, 1.1), "St": (8000.0, 3.9)}


def laminate(rho=(1.0, 1.0, 0.5), Ca=(1.0, 1.0, 0.25), gap=0.0, u=0.5, names=("gamma", "alpha", "beta", "alpha")):
    """The geometry of Zisis et al.: projectile gamma [0, 0.5), then the target alpha beta alpha, 0.2 each.

    rho, Ca: of projectile, alpha and beta; u: speed of both towards each other
    Their table 1 prints the second alpha's place as beta's.
    """
    layers = []
    edges = (0.0, 0.5, 0.7, 0.9, 1.1)
    for k, which in enumerate((0, 1, 2, 1)):
        shift = gap if k else 0.0
        layers.append(Layer(names[k], edges[k] + shift, edges[k + 1] + shift, rho[which], rho[which] / Ca[which],
                            -u if k else u, body=1 if k else 0))
    return layers


def real_case(outer, inner, gap=0.0):
    """projectile and outer layers of one material, the middle of another: names as in MATERIALS; rho in units of 1000"""
    rho, Ca = zip(*(MATERIALS[name] for name in (outer, outer, inner)))
    return laminate(tuple(r / 1000.0 for r in rho), Ca, gap, names=(outer, outer, inner, outer))


CASES = {
    "test": laminate,
    "al_glass_al": lambda gap=0.0: real_case("Al", "Glass", gap),
    "al_carbon_al": lambda gap=0.0: real_case("Al", "Carbon", gap),
    "st_glass_st": lambda gap=0.0: real_case("St", "Glass", gap),
    "st_carbon_st": lambda gap=0.0: real_case("St", "Carbon", gap),
}


def gauges(layers):
    """mass coordinates of the middles of the layers of the last body: A, B, C"""
    edge = np.concatenate([[0.0], np.cumsum([a.mass for a in layers])])
    return [0.5 * (edge[k] + edge[k + 1]) for k, a in enumerate(layers) if a.body == layers[-1].body]


# ------------------------------------------------------------------ waves and the Riemann problem (arrays or numbers)


def wave(ps, p, K, c):
    """|change of velocity| across the wave from p ahead to ps behind (> 0: shock, < 0: rarefaction), and d/dps of it"""
    d = (ps + K) / (p + K)  # ratio of densities
    r = np.sqrt(d)
    shock = d > 1.0
    return c * np.where(shock, r - 1.0 / r, np.log(d)), c * np.where(shock, 0.5 * (r + 1.0 / r), 1.0) / (ps + K)


def riemann(pL, uL, KL, cL, pR, uR, KR, cR):
    """Pressure and velocity of the contact between two states: f_L(p) + f_R(p) = u_L - u_R by Newton, to round-off.

    The left side is concave and rises from -inf at p = -min(K): Newton's steps come from the left after the first.
    """
    floor = -np.minimum(KL, KR)
    zL, zR = (pL + KL) / cL, (pR + KR) / cR  # rho c
    p = (zR * pL + zL * pR + zL * zR * (uL - uR)) / (zL + zR)  # acoustic
    p = np.maximum(p, 0.9 * floor)
    for _ in range(50):
        (fL, dL), (fR, dR) = wave(p, pL, KL, cL), wave(p, pR, KR, cR)
        new = np.maximum(p - (fL + fR - (uL - uR)) / (dL + dR), floor + 0.1 * (p - floor))
        change, p = np.abs(new - p), new
        if np.all(change < 1e-9 * (p - floor)):  # the next error is the square of this
            break
    return p, 0.5 * (uL + uR + wave(p, pR, KR, cR)[0] - wave(p, pL, KL, cL)[0])


# ------------------------------------------------------------------ Lagrangian Godunov scheme


CLOSED = 1e-12  # a gap below this is a contact


@dataclasses.dataclass
class Solution:
    """Cells at time t, arrays (cells,): m mass coordinate and x position of the middle, u, p, rho, material (index of the layer).

    Gauges: times (steps + 1,), gauge_u (steps + 1, gauges).
    before, after: sum of momentum, of the volume of cells, and of the lengths of bodies from the ways of their ends
    """

    t: float
    m: np.ndarray
    x: np.ndarray
    u: np.ndarray
    p: np.ndarray
    rho: np.ndarray
    material: np.ndarray
    times: np.ndarray
    gauge_u: np.ndarray
    before: np.ndarray
    after: np.ndarray

    def at(self, t, m):
        """x, u, p, rho, material at mass coordinates m (any shape): linear between middles of cells, not across interfaces"""
        assert t == self.t
        m = np.asarray(m, dtype=float)
        last = np.flatnonzero(np.diff(self.material))
        material = np.searchsorted(0.5 * (self.m[last] + self.m[last + 1]), m, side="right")
        out = np.empty((4, *m.shape))
        for k in np.unique(material):
            cells, here = self.material == k, material == k
            for row, field in zip(out, (self.x, self.u, self.p, self.rho)):
                row[here] = np.interp(m[here], self.m[cells], field[cells])
        return (*out, material)


def _limit(a, b):
    """van Leer's limiter: harmonic mean, 0 at extrema"""
    ab = a * b
    return np.where(ab > 0.0, 2.0 * ab / np.where(a + b == 0.0, 1.0, a + b), 0.0)


def solve(layers, tstop, cells=6000, cfl=0.8, at=(), start=None):
    """Second-order (MUSCL-Hancock, van Leer) Lagrangian Godunov scheme with the exact Riemann solver.

    layers: list of Layer from left to right, bodies numbered without holes; cells: in all, shared out by travel time
    at: mass coordinates of gauges; start: function m -> p, u at the start instead of p = 0, u = layer.u
    Returns a Solution.
    """
    travel = np.array([(a.hi - a.lo) / a.c for a in layers])
    count = np.maximum(4, np.rint(cells * travel / travel.sum()).astype(int))
    material = np.repeat(np.arange(len(layers)), count)
    K, c, u, body, dm = (np.repeat(values, count) for values in zip(
        *[(a.K, a.c, a.u, a.body, a.mass / n) for a, n in zip(layers, count)]) for values in [np.array(values)])
    m = np.cumsum(dm) - 0.5 * dm
    p = np.zeros_like(m)
    if start is not None:
        p, u = start(m)
    tau = c**2 / (p + K)

    # every body has one node more than cells; left, right: nodes of the cells; first, last: cells at the ends of bodies
    left = np.arange(len(m)) + body
    right = left + 1
    first, last = np.flatnonzero(np.diff(body, prepend=-1)), np.flatnonzero(np.diff(body, append=body[-1] + 1))
    pairs = list(zip(last[:-1], first[1:]))  # cells on both sides of each gap
    inner = np.flatnonzero(body[1:] == body[:-1])
    smooth = material[1:] == material[:-1]  # slopes do not reach across interfaces
    x = np.empty(len(m) + len(first))
    for a, b in zip(first, last):
        x0 = layers[material[a]].lo
        x[left[a]:right[b] + 1] = x0 + np.concatenate([[0.0], np.cumsum((tau * dm)[a:b + 1])])

    def slope(q):
        d = np.where(smooth, np.diff(q), 0.0)
        return _limit(np.append(d, 0.0), np.insert(d, 0, 0.0))

    def surface(k, side, pk, uk):
        """velocity of a free surface on the left (side -1) or right (+1) of cell k"""
        return uk - side * wave(0.0, pk, K[k], c[k])[0]

    def totals():
        return np.array([np.sum(dm * u), np.sum(dm * tau), np.sum(x[right[last]] - x[left[first]])])

    before = totals()
    where = np.searchsorted(np.cumsum(dm), at)
    times, history = [0.0], [u[where]]
    us, ps = np.empty(len(x)), np.empty(len(x))
    t = 0.0
    while t < tstop:
        dt = min(cfl * np.min(dm * tau / c), tstop - t)
        for i, j in pairs:  # end a step where a gap closes
            gap = x[left[j]] - x[right[i]]
            closing = surface(i, 1, p[i], u[i]) - surface(j, -1, p[j], u[j])
            if CLOSED < gap < closing * dt:
                dt = gap / closing
        # values at both ends of each cell, half a step on
        dp, du = slope(p), slope(u)
        pm, um = p - 0.5 * dt / dm * (c / tau)**2 * du, u - 0.5 * dt / dm * dp
        pl, pr, ul, ur = pm - 0.5 * dp, pm + 0.5 * dp, um - 0.5 * du, um + 0.5 * du
        i, j = inner, inner + 1
        ps[right[i]], us[right[i]] = riemann(pr[i], ur[i], K[i], c[i], pl[j], ul[j], K[j], c[j])
        ps[left[first]], us[left[first]] = 0.0, surface(first, -1, pl[first], ul[first])
        ps[right[last]], us[right[last]] = 0.0, surface(last, 1, pr[last], ur[last])
        for i, j in pairs:
            if x[left[j]] - x[right[i]] <= CLOSED:
                pc, uc = riemann(pr[i], ur[i], K[i], c[i], pl[j], ul[j], K[j], c[j])
                if pc > 0.0:
                    ps[[right[i], left[j]]], us[[right[i], left[j]]] = pc, uc
        tau = tau + dt / dm * (us[right] - us[left])
        u = u - dt / dm * (ps[right] - ps[left])
        p = c**2 / tau - K
        x = x + dt * us
        t += dt
        times.append(t)
        history.append(u[where])
    return Solution(t, m, 0.5 * (x[left] + x[right]), u, p, 1.0 / tau, material, np.array(times), np.array(history),
                    before, totals())
