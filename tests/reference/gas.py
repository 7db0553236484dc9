"""Exact and high-resolution solutions for shocks in an ideal gas, p = (gamma - 1) rho e. NumPy; SciPy for the ODE of Sedov.

star, sample   the Riemann problem (E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, chapter 4)
ShockOnDense   a shock that meets an interface: two Riemann problems, one after the other
Noh            cold gas that falls on a plane, a line or a point (W. F. Noh, J. Comput. Phys. 72 (1987) 78)
Sedov          point explosion (L. I. Sedov, Similarity and Dimensional Methods in Mechanics, chapter IV): the similarity equations
               by a Runge-Kutta method, the constant by the integral of the energy
lagrange       second-order Lagrangian Godunov scheme (MUSCL-Hancock in the mass coordinate, exact Riemann solver) between walls

States are (rho, u, p). All functions of position take arrays.
"""

import numpy as np


def sound(state, gamma):
    return np.sqrt(gamma * state[2] / state[0])


def _wave(p, rho, pk, gamma):
    """|change of velocity| (signed: > 0 in a shock) across the wave from pk to p, and its derivative"""
    a, b = 2 / ((gamma + 1) * rho), (gamma - 1) / (gamma + 1) * pk
    root = np.sqrt(a / (p + b))
    c = np.sqrt(gamma * pk / rho)
    power = (p / pk) ** ((gamma - 1) / (2 * gamma))
    shock = p > pk
    return (np.where(shock, (p - pk) * root, 2 * c / (gamma - 1) * (power - 1)),
            np.where(shock, root * (1 - 0.5 * (p - pk) / (p + b)), power * c / (gamma * p)))


def star(left, right, gamma=1.4, tolerance=1e-14):
    """pressure and velocity between the waves; states of numbers or arrays"""
    (rl, ul, pl), (rr, ur, pr) = ([np.asarray(q, float) for q in s] for s in (left, right))
    z = (gamma - 1) / (2 * gamma)
    cl, cr = np.sqrt(gamma * pl / rl), np.sqrt(gamma * pr / rr)
    # start: both waves rarefactions, which is exact for those and too high for none
    total = np.maximum(cl + cr - 0.5 * (gamma - 1) * (ur - ul), 1e-6 * (cl + cr))
    p = (total / (cl / pl**z + cr / pr**z)) ** (1 / z)
    for _ in range(60):
        (f, df), (g, dg) = _wave(p, rl, pl, gamma), _wave(p, rr, pr, gamma)
        new = np.maximum(p - (f + g + ur - ul) / (df + dg), 1e-3 * p)
        change = np.max(np.abs(new - p) / new)
        p = new
        if change < tolerance:
            break
    return p, 0.5 * (ul + ur + _wave(p, rr, pr, gamma)[0] - _wave(p, rl, pl, gamma)[0])


def sample(s, left, right, gamma=1.4):
    """rho, u, p at the speeds s = (x - x0)/t"""
    ps, us = (float(q) for q in star(left, right, gamma))
    s = np.asarray(s, dtype=float)
    out = np.empty((3,) + s.shape)
    for (rho, u, p), sign in ((left, 1), (right, -1)):  # the right half is the left half of the mirrored problem
        half = s <= us if sign > 0 else s > us
        x, u, um = sign * s[half], sign * u, sign * us
        c = np.sqrt(gamma * p / rho)
        if ps > p:
            q, g = ps / p, (gamma - 1) / (gamma + 1)
            behind = x > u - c * np.sqrt((gamma + 1) / (2 * gamma) * q + (gamma - 1) / (2 * gamma))
            now = np.where(behind, [[rho * (q + g) / (g * q + 1)], [um], [ps]], [[rho], [u], [p]])
        else:
            cm = c * (ps / p) ** ((gamma - 1) / (2 * gamma))
            inside = np.clip(2 / (gamma + 1) + (gamma - 1) / ((gamma + 1) * c) * (u - x), cm / c, 1)
            now = np.array([rho * inside ** (2 / (gamma - 1)), u + 2 * c / (gamma - 1) * (1 - inside),
                            p * inside ** (2 * gamma / (gamma - 1))])
        out[:, half] = now * np.array([[1], [sign], [1]])
    return out


class Riemann:
    """left and right meet at x0"""

    def __init__(self, left, right, x0=0.5, gamma=1.4):
        self.left, self.right, self.x0, self.gamma = left, right, x0, gamma

    def at(self, x, t):
        x = np.asarray(x, float)
        if t <= 0:
            return np.where(x < self.x0, np.array(self.left)[:, None], np.array(self.right)[:, None])
        return sample((x - self.x0) / t, self.left, self.right, self.gamma)


def shock(ahead, mach, gamma=1.4):
    """state behind a shock that moves to the right at mach times the sound speed into `ahead`, and its speed"""
    rho, u, p = ahead
    c, m2 = sound(ahead, gamma), mach**2
    return ((gamma + 1) * m2 / ((gamma - 1) * m2 + 2) * rho, u + 2 * c / (gamma + 1) * (mach - 1 / mach),
            p * (1 + 2 * gamma / (gamma + 1) * (m2 - 1))), u + c * mach


class ShockOnDense:
    """A shock that starts at xs meets at the place 0 a gas that is `ratio` times as dense, at the same pressure.

    In the frame of the gas behind the shock, which is at rest; ahead of it rho = 1, p = 1.
    """

    def __init__(self, ratio, mach=3.0, xs=-0.1, gamma=1.4):
        (rho, u, p), speed = shock((1.0, 0.0, 1.0), mach, gamma)
        self.behind, self.light, self.dense = (rho, 0.0, p), (1.0, -u, 1.0), (ratio, -u, 1.0)
        self.xs, self.speed, self.gamma = xs, speed - u, gamma
        self.hit = -xs / speed  # the interface moves at -u, the shock at speed - u
        self.place = -u * self.hit

    def at(self, x, t):
        x = np.asarray(x, float)
        behind, light, dense = (np.array(s)[:, None] for s in (self.behind, self.light, self.dense))
        if t < self.hit:
            return np.where(x < self.xs + self.speed * t, behind, np.where(x < self.light[1] * t, light, dense))
        return sample((x - self.place) / max(t - self.hit, 1e-300), self.behind, self.dense, self.gamma)


class Noh:
    """gas of density 1 that falls at speed 1 on the origin of a space of dim dimensions"""

    def __init__(self, dim, gamma=5 / 3):
        self.dim, self.gamma = dim, gamma
        self.ratio = (gamma + 1) / (gamma - 1)
        self.speed = 0.5 * (gamma - 1)  # of the shock

    def at(self, r, t):
        """rho, inward and outward velocity u (< 0: inward), p at the distances r"""
        r = np.asarray(r, float)
        inside = r < self.speed * t
        rho2 = self.ratio**self.dim
        ahead = (1 + t / np.maximum(r, 1e-300)) ** (self.dim - 1)
        return np.array([np.where(inside, rho2, ahead), np.where(inside, 0.0, -1.0), np.where(inside, 0.5 * (self.gamma - 1) * rho2, 0.0)])


class Sedov:
    """energy at the origin of a gas of density rho0 without pressure.

    With lambda = r/R, R ~ t^delta, delta = 2/(dim + 2): u = R' f, rho = rho0 g, p = rho0 R'^2 h. alpha: E = alpha rho0 R^(dim+2)/t^2.
    """

    def __init__(self, dim, energy=1.0, rho0=1.0, gamma=5 / 3):
        from scipy.integrate import solve_ivp

        self.dim, self.energy, self.rho0, self.gamma = dim, energy, rho0, gamma
        self.delta = delta = 2 / (dim + 2)
        k = (delta - 1) / delta  # R R''/R'^2

        def slope(s, y):
            """of f, ln g, ln h by s = ln lambda: mass, momentum, entropy"""
            lam, f, g, h = np.exp(s), y[0], np.exp(y[1]), np.exp(y[2])
            w = f - lam
            # w f' + (h/g) H' = -k f, H' = gamma G' - 2 k/w, w G' + f' = -(dim - 1) f/lambda
            c2 = gamma * h / g
            df = (-k * f + 2 * k * h / (g * w) + c2 * (dim - 1) * f / (lam * w)) / (w - c2 / w)
            dG = -(df + (dim - 1) * f / lam) / w
            return lam * np.array([df, dG, gamma * dG - 2 * k / w])

        start = [2 / (gamma + 1), np.log((gamma + 1) / (gamma - 1)), np.log(2 / (gamma + 1))]
        self.s = -np.concatenate([np.linspace(0, 0.2, 4001), np.geomspace(0.2, 6, 4000)[1:]])
        y = solve_ivp(slope, (0, self.s[-1]), start, method="DOP853", t_eval=self.s, rtol=1e-12, atol=1e-14).y
        self.lam, self.f, self.g, self.h = np.exp(self.s), y[0], np.exp(y[1]), np.exp(y[2])
        self.area = {1: 2.0, 2: 2 * np.pi, 3: 4 * np.pi}[dim]
        integrand = (0.5 * self.g * self.f**2 + self.h / (gamma - 1)) * self.lam**dim  # d lambda = lambda ds
        rest = self.h[-1] / (gamma - 1) * self.lam[-1] ** dim / dim  # about the origin h is constant and g is 0
        self.alpha = self.area * delta**2 * (self.integral(integrand) + rest)
        self.constant = (energy / (self.alpha * rho0)) ** (1 / (dim + 2))

    def integral(self, y):
        """of y d(ln lambda) up to the shock"""
        from scipy.interpolate import CubicSpline

        return float(CubicSpline(self.s[::-1], y[::-1]).integrate(self.s[-1], self.s[0]))

    def radius(self, t):
        return self.constant * t**self.delta

    def at(self, r, t):
        r = np.asarray(r, float)
        R = self.radius(t)
        speed = self.delta * R / t
        lam, inside = np.clip(r / R, self.lam[-1], 1), r < R
        f, g, h = (np.interp(lam, self.lam[::-1], q[::-1]) for q in (self.f, self.g, self.h))
        return np.array([np.where(inside, self.rho0 * g, self.rho0), np.where(inside, speed * f, 0.0), np.where(inside, self.rho0 * speed**2 * h, 0.0)])


class Lagrange:
    """cells of the mass coordinate: dm, edges x, rho, u, p, at time t"""

    def __init__(self, t, dm, x, rho, u, p, steps):
        self.t, self.dm, self.x, self.rho, self.u, self.p, self.steps = t, dm, x, rho, u, p, steps


def limited(d):
    """slopes from differences to the next cell (van Leer)"""
    a, b = d[..., :-1], d[..., 1:]
    return np.where(a * b > 0, 2 * a * b / np.where(a + b == 0, 1, a + b), 0.0)


def lagrange(x, rho, u, p, tstop, gamma=1.4, cfl=0.5):
    """from the edges x (n + 1,) and states (n,) to tstop between walls at both ends.

    In the mass coordinate d(1/rho)/dt = du/dm, du/dt = -dp/dm, dE/dt = -d(pu)/dm, E = u^2/2 + e.
    """
    x, dm = np.array(x, float), np.asarray(rho) * np.diff(x)
    q = np.array([1 / np.asarray(rho, float), u, p], float)
    energy = 0.5 * q[1] ** 2 + q[2] * q[0] / (gamma - 1)
    t, steps = 0.0, 0
    sign = np.array([[1.0], [-1.0], [1.0]])
    wide = np.concatenate([dm[1::-1], dm, dm[:-3:-1]])
    apart = 0.5 * (wide[1:] + wide[:-1])
    while t < tstop * (1 - 1e-14):
        dt = min(cfl * np.min(dm / np.sqrt(gamma * q[2] / q[0])), tstop - t)
        ghosts = np.concatenate([sign * q[:, 1::-1], q, sign * q[:, :-3:-1]], axis=1)
        slope = limited(np.diff(ghosts) / apart)  # of all but the outermost cells
        inner = ghosts[:, 1:-1]
        half = 0.5 * slope * wide[1:-1]
        # the values at a cell's edges half a step later
        rate = np.array([slope[1], -slope[2], -gamma * inner[2] / inner[0] * slope[1]])
        lo, hi = (inner + s * half + 0.5 * dt * rate for s in (-1, 1))
        bad = (lo[0] <= 0) | (hi[0] <= 0) | (lo[2] <= 0) | (hi[2] <= 0)
        lo, hi = (np.where(bad, inner, a) for a in (lo, hi))
        ps, us = star((1 / hi[0, :-1], hi[1, :-1], hi[2, :-1]), (1 / lo[0, 1:], lo[1, 1:], lo[2, 1:]), gamma, 1e-9)
        us[0] = us[-1] = 0.0
        x = x + dt * us
        q[0] += dt / dm * np.diff(us)
        q[1] -= dt / dm * np.diff(ps)
        energy -= dt / dm * np.diff(ps * us)
        q[2] = (gamma - 1) / q[0] * (energy - 0.5 * q[1] ** 2)
        t, steps = t + dt, steps + 1
    return Lagrange(t, dm, x, 1 / q[0], q[1], q[2], steps)


def woodward_colella(n, tstop=0.038, cfl=0.5):
    """two blasts that meet (P. Woodward & P. Colella, J. Comput. Phys. 54 (1984) 115): p 1000 | 0.01 | 100 between walls"""
    x = np.linspace(0, 1, n + 1)
    middle = 0.5 * (x[1:] + x[:-1])
    p = np.where(middle < 0.1, 1000.0, np.where(middle < 0.9, 0.01, 100.0))
    return lagrange(x, np.ones(n), np.zeros(n), p, tstop, 1.4, cfl)
