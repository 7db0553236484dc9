"""Scenes of the standard shocks, with their exact solutions and bounds. shock_runs.py runs them, shocks.py makes the tables.

METHODS are lines of a pair style; nothing in them, nor anything else that is a choice (kernel, h/spacing, step), depends on the case.

Particles. 1D: one row, dim 1. "sod" has equal masses, so spacings as 1/rho; the other rows equal spacing and masses as rho (but equal
mass through the shock that is there at the start of "interface"). 2D, 3D: square and simple cubic lattices about the origin, no
particle on it. A gas that would expand at the ends is mirrored and periodic, so every scene of one dimension but sound and unlike
plates has a mirror image of itself. h = 1.2 spacings of the type, kernel gauss (the gradient of cubic sums up to 1.022 on a row at
1.2 spacings, an error that no resolution cures; gauss: 0.9997). h variable, within limits that the exact solution does not reach
(hmax at least 10 on rows; at most 2 in 2D and 3D, where Sedov's empty middle would have more). Step: fix hvi/dt 0.2, at the end up to
five shorter equal ones that meet the time.

Errors. In one dimension by element, as measures.l1: a particle is compared with the mean of the exact field over its own mass; in two
and three with the exact field at its place. The errors are weighted with the exact volumes of the particles, in 2D and 3D with the
shells that the particles' radii part space into, so that the sum is the L1 norm over space, and divided by the range of the exact
field in the window. u is the radial velocity in 2D, 3D.

Bounds. Before anything was run: where the solution is not smooth it may be smeared over REACH = 3 smoothing lengths on both sides,
kernel and viscous shock together. So the bound of L1 is the L1 distance between the exact field and its mean over REACH h on both
sides, h that of the exact density: REACH h d/2 for an edge of height d, nothing for a ramp, of second order where it bends. It is taken
as it is for u and p, and twice for rho, whose contacts and walls keep what went wrong when the shock was born (wall heating: Noh 1987).
Orders: shocks are captured with first order; less what measured orders scatter, 0.8 for u and p, 0.6 for rho.
"""

import dataclasses
import functools

import numpy as np
from reference import gas, impedance

ETA, KERNEL, COURANT, REACH = 1.2, "gauss", 0.2, 3.0
ORDER = dict(rho=0.6, u=0.8, p=0.8)
ENERGY, MOMENTUM, SYMMETRY = 1e-3, 1e-11, 1e-6  # momentum: round-off of thousands of steps; symmetry: the same, grown by shocks
FIELDS = ("rho", "u", "p")
METHODS = {"monaghan": "viscosity 1 2", "interface": "viscosity 1 2 interface auto", "riemann": "dissipation riemann", "stock": None}


# ------------------------------------------------------------------ what a scene is


@dataclasses.dataclass
class Scene:
    """Particles at the start and how to run them.

    x, v (N, 3), rho, e (per mass), type (N,); mass, h, eos: by type, lists; box: (lo, hi) by axis; periodic: of x, y, z
    mirror: list of permutations of the particles, each with the axis it reflects; measured: particles that are compared, in order
    """

    x: np.ndarray
    v: np.ndarray
    rho: np.ndarray
    e: np.ndarray
    type: np.ndarray
    mass: list
    h: list
    eos: list
    box: np.ndarray
    periodic: str
    spacing: float
    mirror: list
    measured: np.ndarray
    units: str = "lj"
    tension: bool = True


class Case:
    """dim; times: when to look, the last is the end; n: resolutions of the short and of the long form; window: what is compared

    scene(n), exact(t, ...): see the classes below. gamma: of the gas, None if it is none. limits: least and largest density.
    """

    dim, gamma, units = 1, 1.4, "lj"
    fields = FIELDS

    def __init__(self, name, times, short, long, at=None):
        self.name, self.times, self.short, self.long = name, times, short, long
        self.bound_n = at or short[-1]

    def bounds(self, n=None):
        """{field: bound of L1} at resolution n"""
        n = n or self.bound_n
        return {f: (2 if f == "rho" else 1) * self.smeared(n, k) for k, f in enumerate(FIELDS) if f in self.fields}

    def hlimits(self):
        """hmin, hmax: what the exact densities need; on a row, where long lists cost little, hmax at least 10"""
        lo, hi = self.densities()
        if self.dim == 1:
            return 0.9 / hi, max(10.0, 1.1 / lo)
        return 0.9 * hi ** (-1 / self.dim), min(1.1 * lo ** (-1 / self.dim) if lo > 0 else 2.0, 2.0)


def mean_around(x, f, reach):
    """of f, constant between the edges x, over `reach` on both sides of the middles, as far as there are edges"""
    total = np.concatenate([[0], np.cumsum(f * np.diff(x))])
    middle = 0.5 * (x[1:] + x[:-1])
    lo, hi = np.maximum(middle - reach, x[0]), np.minimum(middle + reach, x[-1])
    return (np.interp(hi, x, total) - np.interp(lo, x, total)) / (hi - lo)


class Row(Case):
    """one dimension. profile(t): parts of the half that is measured: mass edges m, x edges, rho, u, p"""

    window = (-np.inf, np.inf)

    def smeared(self, n, k):
        """distance of field k from its mean over REACH h on both sides, as the errors are measured"""
        m, x, *q = self.profile(self.times[-1])
        middle, width = 0.5 * (x[1:] + x[:-1]), np.diff(x)
        inside = (middle > self.window[0]) & (middle < self.window[1])
        distance = np.abs(mean_around(x, q[k], REACH * ETA * self.spacings(n, m, q[0])) - q[k])
        return np.sum((distance * width)[inside]) / width[inside].sum() / np.ptp(q[k][inside])

    def errors(self, n, scene, frame):
        """{field: L1}, and arrays x, exact (3, N), got (3, N), inside for pictures"""
        m, x, *q = self.profile(self.times[-1])
        which = scene.measured
        mass = np.array(scene.mass)[scene.type[which] - 1]
        edge = m[0] + np.concatenate([[0], np.cumsum(mass)]) + self.offset(mass, m)
        dm = np.diff(m)
        with np.errstate(invalid="ignore"):
            exact = np.array([np.diff(np.interp(edge, m, np.concatenate([[0], np.cumsum(f * dm)]))) / mass for f in q])
        there = np.interp(edge, m, x)
        volume, middle = np.diff(there), 0.5 * (there[1:] + there[:-1])
        inside = (middle > self.window[0]) & (middle < self.window[1]) & (edge[:-1] >= m[0] - 1e-9 * mass) & (edge[1:] <= m[-1] + 1e-9 * mass)
        got = np.array([frame["rho"][which], frame["v"][which, 0], frame["p"][which]])
        xm = 0.5 * (x[1:] + x[:-1])
        seen = (xm > self.window[0]) & (xm < self.window[1])
        l1 = {f: np.sum((volume * np.abs(got[k] - exact[k]))[inside]) / volume[inside].sum() / np.ptp(q[k][seen])
              for k, f in enumerate(FIELDS) if f in self.fields}
        return l1, frame["x"][which, 0], exact, got, inside

    def offset(self, mass, m):
        return 0.0

    def line(self):
        """exact solution for pictures: x, (rho, u, p)"""
        m, x, *q = self.profile(self.times[-1])
        middle = 0.5 * (x[1:] + x[:-1])
        seen = (middle > self.window[0]) & (middle < self.window[1])
        return middle[seen], np.array(q)[:, seen]

    def densities(self):
        """least and largest density, relative to that of the same mass at the start, at the end; 20 % beyond"""
        m, x, rho, *_ = self.profile(self.times[-1])
        ratio = rho / self.start(m)
        return np.min(ratio) / 1.2, np.max(ratio) * 1.2

    def spacings(self, n, m, rho):
        """of the particles that belong to the parts of the profile"""
        return self.masses(n, m) / rho


def row(parts, mirrored, spacing, n, eos, periodic=True, units="lj", tension=True, e_of=None):
    """Scene of a row. parts: (lo, hi, spacing, (rho, u, e), type), from left to right; mirrored: about the left end"""
    x, size, v, rho, e, kind = [], [], [], [], [], []
    for lo, hi, dx, (r, u, energy), t in parts:
        k = round((hi - lo) / dx)
        at = lo + (np.arange(k) + 0.5) * (hi - lo) / k
        x.append(at), size.append(np.full(k, (hi - lo) / k)), kind.append(np.full(k, t))
        for array, value in ((v, u), (rho, r), (e, energy)):
            array.append(np.full(k, value) if np.isscalar(value) else value(at))
    x, size, v, rho, e, kind = (np.concatenate(a) for a in (x, size, v, rho, e, kind))
    measured, mirror = np.arange(len(x)), []
    lo, hi = parts[0][0], parts[-1][1]
    if mirrored:
        x, v = np.concatenate([2 * lo - x[::-1], x]), np.concatenate([-v[::-1], v])
        size, rho, e, kind = (np.concatenate([a[::-1], a]) for a in (size, rho, e, kind))
        measured = measured + len(measured)
        mirror = [(np.arange(len(x))[::-1], 0)]
        lo = 2 * lo - hi
    types = sorted(set(kind))
    first = [np.flatnonzero(kind == t)[0] for t in types]
    width = 4.0 * max(size)
    margin = 0.0 if periodic else 0.5 * (hi - lo)
    box = np.array([[lo - margin, hi + margin], [-width, width], [-width, width]])
    full = lambda a: np.stack([a, 0 * a, 0 * a], axis=1)  # noqa: E731
    # the densities of pulses differ within a type: the mass is that at rest
    rest = [p[3][0] if np.isscalar(p[3][0]) else p[3][0](np.inf) for p in parts]
    of = {p[4]: r for p, r in zip(parts, rest)}
    return Scene(full(x), full(v), rho, e, kind, [of[t] * size[k] for t, k in zip(types, first)], [ETA * size[k] for k in first],
                 eos, box, "pff" if periodic else "sff", spacing, mirror, measured, units, tension)


# ------------------------------------------------------------------ gas in one dimension


def fine(solution, lo, hi, t, cells=40000, anchor=None):
    """profile of solution.at; anchor: (x, mass to the left of it), for flow through the left end"""
    x = np.linspace(lo, hi, cells + 1)
    q = solution.at(0.5 * (x[1:] + x[:-1]), t)
    m = np.concatenate([[0], np.cumsum(q[0] * np.diff(x))])
    if anchor:
        m += anchor[1] - np.interp(anchor[0], x, m)
    return m, x, *q


class Tube(Row):
    """a Riemann problem on [0, 1], mirrored; equal: masses, else spacings"""

    def __init__(self, name, left, right, tstop, short, long, equal=False, window=None, at=None):
        super().__init__(name, [tstop], short, long, at)
        self.left, self.right, self.equal, self.window = left, right, equal, window or (-np.inf, np.inf)
        self.solution = gas.Riemann(left, right)

    def scene(self, n, method=None):
        (rl, ul, pl), (rr, ur, pr) = self.left, self.right
        second = 1 / n * (rl / rr if self.equal and method != "stock" else 1)
        types = (1, 2) if rl != rr else (1, 1)
        parts = [(0.0, 0.5, 1 / n, (rl, ul, pl / rl / 0.4), types[0]), (0.5, 1.0, second, (rr, ur, pr / rr / 0.4), types[1])]
        return row(parts, True, 1 / n, n, ["idealgas 1.4"] * types[1])

    @functools.lru_cache
    def profile(self, t):
        us = float(gas.star(self.left, self.right)[1])
        return fine(self.solution, 0.0, 1.0, t, anchor=(0.5 + us * t, 0.5 * self.left[0]))

    def offset(self, mass, m):
        return -m[0]  # the mass coordinate begins with the first particle

    def start(self, m):
        return np.where(0.5 * (m[1:] + m[:-1]) < 0.5 * self.left[0], self.left[0], self.right[0])

    def masses(self, n, m):
        return (self.left[0] if self.equal else self.start(m)) / n


class Interface(Row):
    """a shock of Mach 3 meets a gas that is `ratio` times as dense; equal spacing where the gas is not shocked, mass as rho"""

    window = (-0.6, 0.45)

    def __init__(self, ratio, short, long):
        super().__init__(f"interface-{ratio}", [0.15], short, long)
        self.ratio, self.solution = ratio, gas.ShockOnDense(ratio)
        self.lo, self.hi = -0.8, 1.0

    def scene(self, n, method=None):
        s, dx = self.solution, 1 / n
        rho, u, p = s.behind
        close = dx if method == "stock" else dx / rho  # equal mass through the shock
        e = [q[2] / q[0] / 0.4 for q in (s.behind, s.light, s.dense)]
        parts = [(self.lo, s.xs, close, (rho, 0.0, e[0]), 1), (s.xs, 0.0, dx, (1.0, s.light[1], e[1]), 2),
                 (0.0, self.hi, dx, (self.ratio, s.dense[1], e[2]), 3)]
        return row(parts, True, dx, n, ["idealgas 1.4"] * 3)

    @functools.lru_cache
    def profile(self, t):
        return fine(self.solution, self.lo, self.hi, t)

    def start(self, m):
        s = self.solution
        middle, a = 0.5 * (m[1:] + m[:-1]), (s.xs - self.lo) * s.behind[0]
        return np.where(middle < a, s.behind[0], np.where(middle < a - s.xs, 1.0, self.ratio))

    def masses(self, n, m):
        return np.where(self.start(m) == self.ratio, self.ratio, 1.0) / n


class Blasts(Row):
    """Woodward & Colella between walls, mirrored; the exact solution is lagrange() with many cells"""

    cells = 1600

    def __init__(self, short, long, at):
        super().__init__("woodward-colella", [0.038], short, long, at)

    def scene(self, n, method=None):
        parts = [(lo, hi, 1 / n, (1.0, 0.0, p / 0.4), 1) for lo, hi, p in ((0.0, 0.1, 1000.0), (0.1, 0.9, 0.01), (0.9, 1.0, 100.0))]
        return row(parts, True, 1 / n, n, ["idealgas 1.4"])

    @functools.lru_cache
    def profile(self, t):
        s = gas.woodward_colella(self.cells, t)
        return np.concatenate([[0], np.cumsum(s.dm)]), s.x, s.rho, s.u, s.p

    def start(self, m):
        return np.ones(len(m) - 1)

    def densities(self):
        return 0.02, 30.0  # about 28 when the blasts meet (Woodward & Colella)

    def masses(self, n, m):
        return 1 / n


class NohRow(Row):
    """Noh's problem on a row with free ends: the gas is cold, p = 1e-6"""

    gamma, window = 5 / 3, (0.0, 0.36)

    def __init__(self, short, long):
        super().__init__("noh-1d", [0.6], short, long)
        self.solution = gas.Noh(1)

    def scene(self, n, method=None):
        scene = row([(0.0, 1.0, 1 / n, (1.0, -1.0, 1.5e-6), 1)], True, 1 / n, n, [f"idealgas {5 / 3:.17g}"], periodic=False)
        return scene

    @functools.lru_cache
    def profile(self, t):
        return fine(self.solution, 0.0, 1.0 - t, t)

    def start(self, m):
        return np.ones(len(m) - 1)

    def masses(self, n, m):
        return 1 / n


# ------------------------------------------------------------------ not gas


class Plates(Row):
    """a flyer plate on a plate at rest, 10 mm each, free behind; symmetric impacts in the frame of the contact. n: particles per plate"""

    gamma, units, length = None, "si", 0.01

    def __init__(self, name, flyer, target, speed, short, long):
        self.symmetric = flyer == target
        self.solution = impedance.Flyer(flyer, target, speed, self.length, -0.5 * speed if self.symmetric else 0.0)
        super().__init__(name, [0.4 * self.solution.last, 0.8 * self.solution.last], short, long)

    def scene(self, n, method=None):
        s, dx = self.solution, self.length / n
        parts = [(-self.length, 0.0, dx, (s.flyer.rho0, s.speed + s.shift, 0.0), 1), (0.0, self.length, dx, (s.target.rho0, s.shift, 0.0), 2)]
        eos = [f"gruneisen {a.rho0} {a.c0} {a.s} {a.gamma} {a.b} 0" for a in (s.flyer, s.target)]
        scene = row(parts, False, dx, n, eos, periodic=False, units="si", tension=False)
        scene.box[0] = -3 * self.length, 3 * self.length
        if self.symmetric:
            scene.mirror = [(np.arange(2 * n)[::-1], 0)]
        return scene

    @functools.lru_cache
    def profile(self, t):
        dm, *q = self.solution.at_mass(t)
        split = 2000  # parts of equal state, for integrals
        dm, q = np.repeat(dm / split, split), [np.repeat(f, split) for f in q]
        m = np.concatenate([[0], np.cumsum(dm)])
        x = -self.length + (self.solution.speed + self.solution.shift) * t + np.concatenate([[0], np.cumsum(dm / q[0])])
        return m, x, *q

    def start(self, m):
        left = 0.5 * (m[1:] + m[:-1]) < self.solution.flyer.rho0 * self.length
        return np.where(left, self.solution.flyer.rho0, self.solution.target.rho0)

    def masses(self, n, m):
        return self.start(m) * self.length / n

    def numbers(self, n, scene, frames):
        """relative errors of P, rho, u and Us: the plateau in the target is 25 to 75 % of what its shock has passed. P in 1/(rho0 Us u)"""
        s, target = self.solution, scene.type == 2
        mass = (np.arange(n) + 0.5) * s.target.rho0 * self.length / n  # from the contact
        passed = s.target.rho0 * s.us[1] * self.times[-1]
        on = (mass > 0.25 * passed) & (mass < 0.75 * passed)
        last = frames[-1]
        got = {"P": last["p"][target][on].mean() / s.p, "rho": last["rho"][target][on].mean() / s.target.density(s.u),
               "u": (last["v"][target, 0][on].mean() - s.shift) / s.u}
        place = []
        for frame in frames:  # where the velocity falls to half
            u = (frame["v"][target, 0] - s.shift) / s.u
            k = np.flatnonzero(u > 0.5)[-1]
            place.append(np.interp(-0.5, -u[k:k + 2], mass[k:k + 2]))
        got["Us"] = (place[1] - place[0]) / (self.times[1] - self.times[0]) / s.target.rho0 / s.us[1]
        return {k: v - 1 for k, v in got.items()}

    number_bounds = dict(P=0.01, rho=0.01, u=0.01, Us=0.01)


class Sound(Row):
    """A pulse of sound at a step of impedance, p = K (rho/rho0 - 1). Reflection and transmission by the integrals of p, which for
    pulses of the same shape are the coefficients times the ratio of the widths, and by the largest p."""

    gamma, fields = None, ("u", "p")

    def __init__(self, short, long):
        super().__init__("sound", [0.8], short, long)
        self.solution = impedance.Pulse()
        self.lo, self.hi = -1.0, 1.2

    def scene(self, n, method=None):
        s, dx, parts = self.solution, 1 / n, []
        for lo, hi, (rho, c), t in ((self.lo, 0.0, s.first, 1), (0.0, self.hi, s.second, 2)):
            state = [lambda x, k=k: s.at(x, 0.0)[k] if np.all(np.isfinite(x)) else rho for k in (0, 1)]
            parts.append((lo, hi, dx, (state[0] if t == 1 else rho, state[1] if t == 1 else 0.0, 0.0), t))
        parts[0] = (*parts[0][:3], (lambda x: s.at(x, 0.0)[0] if np.ndim(x) else s.first[0], lambda x: s.at(x, 0.0)[1], 0.0), 1)
        scene = row(parts, False, dx, n, [f"linear {rho} {rho * c * c}" for rho, c in (s.first, s.second)], periodic=False)
        return scene

    @functools.lru_cache
    def profile(self, t):
        return fine(self.solution, self.lo, self.hi, t)

    def start(self, m):
        return np.where(0.5 * (m[1:] + m[:-1]) < -self.lo * self.solution.first[0], self.solution.first[0], self.solution.second[0])

    def masses(self, n, m):
        return self.start(m) / n

    def numbers(self, n, scene, frames):
        s, last = self.solution, frames[-1]
        left = scene.type == 1
        incident = s.amplitude * s.w * 0.75  # the integral of cos^4
        p = last["p"] / n
        return {"R": p[left].sum() / incident / s.r - 1, "T": p[~left].sum() / incident * s.first[1] / s.second[1] / s.t - 1,
                "R_peak": last["p"][left].max() / s.amplitude / s.r - 1, "T_peak": last["p"][~left].max() / s.amplitude / s.t - 1}

    number_bounds = dict(R=0.01, T=0.01)  # of the peaks, which viscosity lowers in first order: only shown


# ------------------------------------------------------------------ two and three dimensions


class Round(Case):
    """a lattice about the origin. n: particles per unit length of the half width `size`"""

    gamma, size, periodic = 5 / 3, 1.0, False

    def __init__(self, name, dim, times, short, long, at=None):
        super().__init__(name, times, short, long, at)
        self.dim = dim

    def lattice(self, n):
        dx = self.size / n
        axis = (np.arange(2 * n) - n + 0.5) * dx
        x = np.stack(np.meshgrid(*[axis] * self.dim, indexing="ij"), -1).reshape(-1, self.dim)
        return x if self.periodic else x[(x**2).sum(1) < self.size**2]

    def scene(self, n, method=None):
        x, dx = self.lattice(n), self.size / n
        r = np.sqrt((x**2).sum(1))
        rho, u, e = self.initial(r, dx)
        full = np.zeros((len(x), 3))
        full[:, :self.dim] = x
        v = full * (u / r)[:, None]
        box = np.array([[-self.size, self.size]] * self.dim + [[-0.5 * dx, 0.5 * dx]] * (3 - self.dim))
        key = np.round(x / dx - 0.5).astype(int) + n
        place = -np.ones([2 * n] * self.dim, int)
        place[tuple(key.T)] = np.arange(len(x))
        mirror = [(place[tuple((2 * n - 1 - key[:, a] if a == b else key[:, a]) for a in range(self.dim))], b) for b in range(self.dim)]
        bounds = ("p" if self.periodic else "s") * self.dim + "p" * (3 - self.dim)
        return Scene(full, v, np.full(len(x), 1.0), e, np.ones(len(x), int), [dx**self.dim], [ETA * dx], [f"idealgas {self.gamma:.17g}"],
                     box, bounds, dx, mirror, np.arange(len(x)))

    def errors(self, n, scene, frame):
        r = np.sqrt((frame["x"]**2).sum(1))
        exact = self.solution.at(r, self.times[-1])
        radial = (frame["v"] * frame["x"]).sum(1) / r
        got = np.array([frame["rho"], radial, frame["p"]])
        inside = r < self.window
        order = np.flatnonzero(inside)[np.argsort(r[inside], kind="stable")]
        edge = np.concatenate([[0], 0.5 * (r[order][1:] + r[order][:-1]), [self.window]])
        share = np.diff(edge**self.dim) / self.window**self.dim
        span = self.span()
        l1 = {f: np.sum(share * np.abs(got[k] - exact[k])[order]) / span[k] for k, f in enumerate(FIELDS)}
        return l1, r, exact, got, inside

    def line(self):
        r = np.linspace(1e-6, self.window, 2001)
        return r, self.solution.at(r, self.times[-1])

    def span(self):
        return np.ptp(self.solution.at(np.linspace(1e-6, self.window, 20001), self.times[-1]), axis=1)

    def smeared(self, n, k):
        x = np.linspace(-1.5 * self.window, 1.5 * self.window, 60001)
        r = 0.5 * (x[1:] + x[:-1])
        q = self.solution.at(np.abs(r), self.times[-1])
        q[1] *= np.sign(r)
        h = ETA * self.size / n * np.minimum(1 / np.maximum(q[0], 1e-9) ** (1 / self.dim), self.hlimits()[1])
        inside = (r > 0) & (r < self.window)
        distance = np.abs(mean_around(x, q[k], REACH * h) - q[k])[inside] * r[inside] ** (self.dim - 1)
        return distance.sum() / (r[inside] ** (self.dim - 1)).sum() / self.span()[k]


class NohBall(Round):
    window = 0.36

    def __init__(self, dim, short, long, at=None):
        super().__init__(f"noh-{dim}d", dim, [0.6], short, long, at)
        self.solution = gas.Noh(dim)

    def initial(self, r, dx):
        return 1.0, -np.ones_like(r), np.full_like(r, 1.5e-6)

    def densities(self):
        return 1.0, 1.2 * 4.0**self.dim


class Explosion(Round):
    """energy 1, even over what the kernel reaches from the origin; size such that the shock is at 0.8 of it at t = 1"""

    periodic, size, window = True, 1.44, 1.44

    def __init__(self, dim, short, long, at=None):
        super().__init__(f"sedov-{dim}d", dim, [1.0], short, long, at)
        self.solution = gas.Sedov(dim)

    def initial(self, r, dx):
        hot = r < 2 * ETA * dx
        return 1.0, np.zeros_like(r), np.where(hot, 1 / (hot.sum() * dx**self.dim), 1.5e-6)

    def densities(self):
        return 0.0, 1.2 * 4.0


# ------------------------------------------------------------------ the cases

ALL = [
    Tube("sod", (1, 0, 1), (0.125, 0, 0.1), 0.2, (200, 400), (200, 400, 800), equal=True),
    Tube("sod-spacing", (1, 0, 1), (0.125, 0, 0.1), 0.2, (100, 200), (100, 200, 400, 800)),
    Tube("blast-left", (1, 0, 1000), (1, 0, 0.01), 0.012, (100, 200), (100, 200, 400, 800)),
    Tube("blast-right", (1, 0, 0.01), (1, 0, 100), 0.035, (100, 200), (100, 200, 400, 800)),
    Tube("sjoegreen", (1, -2, 0.4), (1, 2, 0.4), 0.12, (200,), (200, 400, 800), window=(0.13, 0.87), at=400),
    Blasts((200,), (200, 400, 800), at=400),
    NohRow((100, 200), (100, 200, 400, 800)),
    NohBall(2, (25, 50), (25, 50, 100)),
    NohBall(3, (8,), (8, 14, 20), at=14),
    Explosion(2, (16, 32), (16, 32, 64)),
    Explosion(3, (8,), (8, 12, 16), at=12),
    Interface(10, (100, 200), (100, 200, 400)),
    Interface(100, (100, 200), (100, 200, 400)),
    Sound((100, 200), (100, 200, 400, 800)),
    *[Plates(f"al-al-{v}", impedance.AL6061, impedance.AL6061, float(v), (100, 200), (100, 200, 400))
      for v in (500, 1000, 2000, 3000, 5000, 5941, 6700, 7000, 10000)],
    Plates("al-cu-5750", impedance.AL2024, impedance.COPPER, 5750.0, (100, 200), (100, 200, 400)),
]
CASES = {c.name: c for c in ALL}
