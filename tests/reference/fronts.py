"""Shocks through layered bodies by front tracking: every wave is a front that moves through the mass at constant speed.

Between events the solution is piecewise constant. Events are two fronts that meet, a front that meets an interface, and a gap
that closes; each is a Riemann problem, solved to round-off. Shocks and interfaces are exact. Rarefaction fans are stairs of
jumps with |ln d| <= step, whose states lie on the rarefaction curve and whose speeds -[u]/[tau] keep lengths exact; what
this costs is of second order in step. Problem, laws and units: layers.py.
"""

import heapq
import itertools
import math

import numpy as np

from . import layers as L

DROP = 1e-10  # |ln d| below which an outgoing wave is left out


def wave(ps, p, K, c):
    """as layers.wave, for numbers"""
    d = (ps + K) / (p + K)
    if d > 1.0:
        r = math.sqrt(d)
        return c * (r - 1.0 / r), 0.5 * c * (r + 1.0 / r) / (ps + K)
    return c * math.log(d), c / (ps + K)


def riemann(a, ma, b, mb):
    """pressure and velocity between states a on the left and b on the right, (p, u), of materials ma and mb: see layers.riemann"""
    (pL, uL), (pR, uR) = a, b
    zL, zR = (pL + ma.K) / ma.c, (pR + mb.K) / mb.c
    floor = -min(ma.K, mb.K)
    p = (zR * pL + zL * pR + zL * zR * (uL - uR)) / (zL + zR)
    p = max(p, 0.9 * floor)
    for _ in range(50):
        (fL, dL), (fR, dR) = wave(p, pL, ma.K, ma.c), wave(p, pR, mb.K, mb.c)
        new = max(p - (fL + fR - (uL - uR)) / (dL + dR), floor + 0.1 * (p - floor))
        change, p = abs(new - p), new
        if change < 1e-9 * (p - floor):
            break
    return p, 0.5 * (uL + uR + wave(p, pR, mb.K, mb.c)[0] - wave(p, pL, ma.K, ma.c)[0])


class Material:
    """numbers of one layer; index: which"""

    def __init__(self, layer, index):
        self.K, self.c, self.index = float(layer.K), float(layer.c), index

    def tau(self, state):
        return self.c**2 / (state[0] + self.K)


class Front:
    """A jump that was at m at time t and moves through the mass at speed s until time end; left, right: states (p, u).

    A wave has a material; an interface has a face instead, s = 0, and x: positions of its two sides at time t.
    prev, next: neighbors
    """

    __slots__ = "m t s left right material face x end prev next".split()

    def __init__(self, m, t, s, left, right, material=None, face=None):
        self.m, self.t, self.s, self.left, self.right, self.material, self.face = m, t, s, left, right, material, face
        self.x = tuple(face.x) if face else None
        self.end, self.prev, self.next = math.inf, None, None

    def at(self, t):
        return self.m + self.s * (t - self.t)


class Interface:
    """between materials a and b (None: nothing there); bonded: carries tension; x: positions of both sides at time t"""

    def __init__(self, a, b, bonded, x):
        self.a, self.b, self.bonded, self.x, self.t = a, b, bonded, list(x), 0.0
        self.open = x[1] > x[0]

    def move(self, t, left, right):
        dt, self.t = t - self.t, t
        for k, state in enumerate((left, right)):
            if state is not None:
                self.x[k] += state[1] * dt

    def resolve(self, left, right):
        """states on both sides after waves have come in; opens and closes the gap"""
        if self.a and self.b:
            if self.open and self.x[1] - self.x[0] <= L.CLOSED:
                self.open = False
            if not self.open:
                star = riemann(left, self.a, right, self.b)
                if self.bonded or star[0] >= 0.0:
                    return star, star
                self.open = True
        return (self.a and (0.0, left[1] - wave(0.0, left[0], self.a.K, self.a.c)[0]),
                self.b and (0.0, right[1] + wave(0.0, right[0], self.b.K, self.b.c)[0]))


class Tracking:
    """The solution from t = 0 to tstop. layers: as in layers.solve; step: largest |ln d| of a jump in a fan.

    at(t, m): profile; gauge(m): history. fronts: all there ever were; events: their number
    """

    def __init__(self, layers, tstop, step=0.01):
        self.layers, self.tstop, self.step, self.events = layers, tstop, step, 0
        self.edges = np.concatenate([[0.0], np.cumsum([a.mass for a in layers])])
        self.fronts, self._heap, self._order = [], [], itertools.count()
        materials = [None, *(Material(a, k) for k, a in enumerate(layers)), None]
        ends = [None, *layers, None]
        for k, m in enumerate(self.edges):
            a, b = ends[k:k + 2]
            face = Interface(*materials[k:k + 2], bool(a and b and a.body == b.body), (a.hi if a else math.nan, b.lo if b else math.nan))
            self.fronts.append(Front(float(m), 0.0, 0.0, a and (0.0, a.u), b and (0.0, b.u), face=face))
            if k:
                self._link(*self.fronts[-2:])
        for f in list(self.fronts):
            self._meet(0.0, f, f)
        while self._heap and self._heap[0][0] <= tstop:
            t, _, a, b = heapq.heappop(self._heap)
            if a.end == b.end == math.inf and (a is b or a.next is b):
                self._meet(t, a, b)
        self._tabulate()

    @staticmethod
    def _link(a, b):
        if a:
            a.next = b
        if b:
            b.prev = a

    def _schedule(self, t, a, b, distance, closing):
        heapq.heappush(self._heap, (t + max(0.0, distance) / closing, next(self._order), a, b))

    def _meet(self, t, a, b):
        """neighbors a and b are at one place, or something happens at a = b: put there what comes out of it"""
        self.events += 1
        old = b if b.face else a
        m, face = old.at(t), old.face
        left, right, before, after = a.left, b.right, a.prev, b.next
        a.end = b.end = t
        if face:
            face.move(t, old.left, old.right)
            star = face.resolve(left, right)
            new = self._wave(m, t, left, star[0], face.a, -1) if face.a else []
            out = self._wave(m, t, right, star[1], face.b, +1) if face.b else []
            stand = Front(m, t, 0.0, new[-1].right if new else left, out[0].left if out else right, face=face)
            new = [*new, stand, *out]
            if face.a and face.b and face.open and stand.left[1] - stand.right[1] > 1e-12:
                self._schedule(t, stand, stand, face.x[1] - face.x[0], stand.left[1] - stand.right[1])
        else:
            star = riemann(left, a.material, right, a.material)
            new = self._wave(m, t, left, star, a.material, -1)
            new += self._wave(m, t, right, new[-1].right if new else left, a.material, +1)
        self.fronts += new
        for f, g in zip([before, *new], [*new, after]):
            self._link(f, g)
            if f and g and f.s > g.s:
                self._schedule(t, f, g, g.at(t) - f.at(t), f.s - g.s)

    def _wave(self, m, t, ahead, behind, material, side):
        """fronts of the wave from state ahead to state behind, from left to right; it moves to the left (side -1) or right (+1)"""
        s = math.log((behind[0] + material.K) / (ahead[0] + material.K))
        if abs(s) < DROP:
            return []
        n = 1 if s > 0.0 else math.ceil(-s / self.step)
        states = [((ahead[0] + material.K) * math.exp(s * k / n) - material.K, ahead[1] + side * s * material.c * k / n) for k in range(1, n)]
        states = [ahead, *states, behind][::-side]
        return [Front(m, t, side * abs((b[1] - a[1]) / (material.tau(b) - material.tau(a))), a, b, material)
                for a, b in zip(states[:-1], states[1:])]

    # ---- looking at it

    def _tabulate(self):
        none = (math.nan, math.nan)
        self._m, self._t, self._s, self._end = np.array([(f.m, f.t, f.s, f.end) for f in self.fronts]).T
        self._left, self._right = (np.array([getattr(f, side) or none for f in self.fronts]) for side in ("left", "right"))

    def zones(self, t):
        """edges m (n + 1,), x on the left and right end of each zone (n,), p, u (n,), material (n,), small (n + 1,): side of waves in fans, else 0"""
        live = np.flatnonzero((self._t <= t) & (t < self._end))
        m = self._m[live] + self._s[live] * (t - self._t[live])
        live = live[np.argsort(m, kind="stable")]
        m = np.sort(m, kind="stable")
        p, u = self._right[live[:-1]].T
        material = np.clip(np.searchsorted(self.edges, 0.5 * (m[1:] + m[:-1])) - 1, 0, len(self.layers) - 1)
        K, c = (np.array([getattr(a, name) for a in self.layers])[material] for name in ("K", "c"))
        lo, hi = np.empty(len(p)), np.empty(len(p))
        width = c**2 / (p + K) * np.diff(m)
        for k, w in enumerate(width):
            f = self.fronts[live[k]]
            lo[k] = f.x[1] + f.right[1] * (t - f.t) if f.face else hi[k - 1]
            hi[k] = lo[k] + w
        jump = np.zeros(len(m))
        jump[1:-1] = np.abs(np.log((p + K)[1:] / (p + K)[:-1]))
        small = np.where(jump <= 1.001 * self.step, np.sign(self._s[live]), 0.0)
        return m, lo, hi, p, u, material, small

    def at(self, t, m):
        """x, u, p, rho, material at mass coordinates m (any shape) at time t; stairs that stand for fans are made straight"""
        edge, lo, hi, p, u, material, small = self.zones(t)
        m = np.asarray(m, dtype=float)
        k = np.clip(np.searchsorted(edge, m, side="right") - 1, 0, len(p) - 1)
        with np.errstate(invalid="ignore", divide="ignore"):
            part = np.where(edge[k + 1] > edge[k], (m - edge[k]) / (edge[k + 1] - edge[k]), 0.5)
        x = lo[k] + part * (hi[k] - lo[k])
        # a zone is flat up to half a stair before a fan's first jump; between two jumps of a fan only its middle counts
        width = np.diff(edge)
        same = (small[1:] == small[:-1]) & (small[1:] != 0.0)
        a, b = edge[:-1].copy(), edge[1:].copy()
        for side in range(1, len(p)):  # jump between zones side - 1 and side
            if small[side]:
                if same[side - 1] and not same[side]:
                    a[side] = min(a[side] + 0.5 * width[side - 1], 0.5 * (edge[side] + edge[side + 1]))
                if same[side] and not same[side - 1]:
                    b[side - 1] = max(b[side - 1] - 0.5 * width[side], 0.5 * (edge[side] + edge[side - 1]))
        middle = 0.5 * (edge[1:] + edge[:-1])
        a, b = np.where(same, middle, a), np.where(same, middle, b)
        points = np.stack([a, b], axis=1).ravel()
        u, p = (np.interp(m, points, np.repeat(q, 2)) for q in (u, p))
        material = material[k]
        K, c = (np.array([getattr(layer, name) for layer in self.layers])[material] for name in ("K", "c"))
        return x, u, p, (p + K) / c**2, material

    def gauge(self, m):
        """times (n,), u (n,), p (n,) at mass coordinate m: values from each time on; the first time is 0"""
        wave = np.flatnonzero(self._s != 0.0)
        t = self._t[wave] + (m - self._m[wave]) / self._s[wave]
        hit = (t >= self._t[wave]) & (t < np.minimum(self._end[wave], self.tstop))
        wave, t = wave[hit], t[hit]
        order = np.argsort(t, kind="stable")
        wave, t = wave[order], t[order]
        behind = np.where((self._s[wave] > 0.0)[:, None], self._left[wave], self._right[wave])
        k = min(max(np.searchsorted(self.edges, m) - 1, 0), len(self.layers) - 1)
        return np.append(0.0, t), np.append(self.layers[k].u, behind[:, 1]), np.append(0.0, behind[:, 0])
