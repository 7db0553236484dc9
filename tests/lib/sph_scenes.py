"""SPH states, and what the equations say about them, written out in NumPy for all pairs.

Sources: Zisis, van der Linden & Giannopapa (2013) eqs 9-25, Monaghan (1992), as put right in doc/src/Howto_sph.rst.
"""

from dataclasses import dataclass

import numpy as np
from dumps import named, read_dump


def _piecewise(q, terms, power):
    """sum of a (s - q)_+^power and its derivative"""
    w = sum(a * np.maximum(s - q, 0) ** power for a, s in terms)
    dw = sum(-power * a * np.maximum(s - q, 0) ** (power - 1) for a, s in terms)
    return w, dw


def shape(kernel, q):
    """w(q) and dw/dq, not normalized; q = r/h"""
    if kernel == "lucy":
        inside = q < 1
        return (inside * (1 + 3 * q) * (1 - q) ** 3, inside * (-12 * q * (1 - q) ** 2))
    if kernel == "quadratic":
        inside = q < 2
        return inside * (q**2 / 4 - q + 1), inside * (q / 2 - 1)
    if kernel == "cubic":
        return _piecewise(q, ((1, 2), (-4, 1)), 3)
    if kernel == "quartic":
        return _piecewise(q, ((1, 2.5), (-5, 1.5), (10, 0.5)), 4)
    if kernel == "quintic":
        return _piecewise(q, ((1, 3), (-6, 2), (15, 1)), 5)
    if kernel == "gauss":
        inside = q < 3
        return inside * np.exp(-q * q), inside * (-2 * q * np.exp(-q * q))
    if kernel == "wendland2":
        a = np.maximum(1 - q / 2, 0)
        return a**4 * (1 + 2 * q), -5 * q * a**3
    if kernel == "wendland4":
        a = np.maximum(1 - q / 2, 0)
        return a**6 * (1 + 3 * q + 35 / 12 * q * q), a**5 * (-14 / 3 * q - 35 / 3 * q * q)
    raise ValueError(kernel)


SUPPORT = dict(lucy=1, quadratic=2, cubic=2, quartic=2.5, quintic=3, gauss=3, wendland2=2, wendland4=2)


def norm(kernel, dim):
    """so that the integral over space is 1, by Gauss-Legendre quadrature"""
    x, w = np.polynomial.legendre.leggauss(60)
    ends = np.unique(np.append(np.arange(0, SUPPORT[kernel], 0.5), SUPPORT[kernel]))
    total = 0.0
    for a, b in zip(ends[:-1], ends[1:]):
        q = 0.5 * (a + b) + 0.5 * (b - a) * x
        total += 0.5 * (b - a) * np.sum(w * shape(kernel, q)[0] * q ** (dim - 1))
    return 1 / (total * {1: 2, 2: 2 * np.pi, 3: 4 * np.pi}[dim])


@dataclass
class Fluid:
    """SPH particles; mass and h by type; eos(type) -> (p, c) from rho and energy per mass"""

    x: np.ndarray
    v: np.ndarray
    rho: np.ndarray
    esph: np.ndarray
    type: np.ndarray
    mass: dict
    h: dict
    box: np.ndarray  # lengths; from 0, in directions beyond dim around 0
    periodic: tuple = (True, True, True)
    dim: int = 3

    @property
    def m(self):
        return np.array([self.mass[t] for t in self.type])

    def write(self, path):
        n = len(self.x)
        lines = ["state", "", f"{n} atoms", f"{len(self.mass)} atom types", ""]
        lo = [0.0 if a < self.dim else -0.5 * self.box[a] for a in range(3)]
        lines += [f"{lo[a]:.17g} {lo[a] + self.box[a]:.17g} {'xyz'[a]}lo {'xyz'[a]}hi" for a in range(3)]
        lines += ["", "Masses", ""] + [f"{t} {m:.17g}" for t, m in self.mass.items()] + ["", "Atoms # sph", ""]
        for i in range(n):
            values = [self.rho[i], self.esph[i], 1.0, *self.x[i]]
            lines.append(f"{i + 1} {self.type[i]} " + " ".join(f"{a:.17g}" for a in values))
        lines += ["", "Velocities", ""]
        lines += [f"{i + 1} " + " ".join(f"{a:.17g}" for a in self.v[i]) for i in range(n)]
        path.write_text("\n".join(lines) + "\n")


def random_fluid(n, dim=3, spacing=1.0, jitter=0.25, seed=1, types=2, periodic=True, speed=0.5, h=1.3, density=1.0):
    """a jittered lattice; types have masses 1, 1.7, ... and differing h if h is a list"""
    rng = np.random.default_rng(seed)
    counts = [n] * dim + [1] * (3 - dim)
    grid = np.stack(np.meshgrid(*[np.arange(k) for k in counts], indexing="ij"), -1).reshape(-1, 3).astype(float)
    x = grid + 0.5
    x[:, :dim] += rng.uniform(-jitter, jitter, (len(x), dim))
    x *= spacing
    box = np.array(counts, float) * spacing
    v = np.zeros_like(x)
    v[:, :dim] = rng.normal(0, speed, (len(x), dim))
    kind = rng.integers(1, types + 1, len(x))
    mass = {t: density * spacing**dim * (1 + 0.7 * (t - 1)) for t in range(1, types + 1)}
    rho = density * rng.uniform(0.9, 1.2, len(x)) * np.array([1 + 0.7 * (t - 1) for t in kind])
    esph = np.array([mass[t] for t in kind]) * rng.uniform(0.5, 1.5, len(x))
    hs = {t: spacing * (h[t - 1] if isinstance(h, (list, tuple)) else h) for t in range(1, types + 1)}
    if dim < 3:
        x[:, dim:] = 0.0
        box[dim:] = 20.0 * spacing
    return Fluid(x, v, rho, esph, kind, mass, hs, box, (periodic,) * dim + (True,) * (3 - dim), dim)


def rates(s, eos, kernel, form="sum", visc=(1.0, 2.0), alpha=0.0, tension=True, h=None, stock=False, dim=None):
    """force, d esph/dt, d rho/dt, viscous power (of all, and of each particle), of all pairs by brute force"""
    dim = dim or s.dim
    e = s.esph / s.m
    p, c = np.empty(len(e)), np.empty(len(e))
    for t in set(s.type):
        k = s.type == t
        p[k], c[k] = eos[t](s.rho[k], e[k])
    h = np.array([s.h[t] for t in s.type]) if h is None else h
    i, j = np.triu_indices(len(s.x), 1)
    d = s.x[i] - s.x[j]
    for a in range(3):
        if s.periodic[a]:
            d[:, a] -= s.box[a] * np.round(d[:, a] / s.box[a])
    r = np.sqrt((d**2).sum(1))
    hij = 0.5 * (h[i] + h[j])
    near = r < SUPPORT[kernel] * hij
    i, j, d, r, hij = i[near], j[near], d[near], r[near], hij[near]
    dWdr = norm(kernel, dim) / hij ** (dim + 1) * shape(kernel, r / hij)[1]
    grad = d * (dWdr / r)[:, None]
    vij = s.v[i] - s.v[j]
    g = (vij * grad).sum(1)
    vr = (vij * d).sum(1)
    mu = np.where(vr < 0, hij * vr / (r**2 + 0.01 * hij**2), 0.0)
    cij, rhoij = 0.5 * (c[i] + c[j]), 0.5 * (s.rho[i] + s.rho[j])
    Pi = (-visc[0] * cij * mu + visc[1] * mu**2) / rhoij
    m, V = s.m, s.m / s.rho
    if form == "sum":
        push_i, push_j = V[i] * V[j] * p[i], V[i] * V[j] * p[j]
        drho_i, drho_j = s.rho[i] * V[j] * g, s.rho[j] * V[i] * g
    else:
        push_i, push_j = m[i] * m[j] * p[i] / s.rho[i] ** 2, m[i] * m[j] * p[j] / s.rho[j] ** 2
        drho_i, drho_j = m[j] * g, m[i] * g
    bonded = np.full(len(i), True) if tension else s.type[i] == s.type[j]
    open_ = bonded | (p[i] + p[j] > 0)
    push_i, push_j = push_i * open_, push_j * open_
    drho_i, drho_j = drho_i * (open_ | (vr < 0)), drho_j * (open_ | (vr < 0))
    q = m[i] * m[j] * Pi
    force = -(push_i + push_j + q)[:, None] * grad
    if stock:
        de_i = de_j = 0.5 * (push_i + push_j + q) * g
    else:
        de_i, de_j = (push_i + 0.5 * q) * g, (push_j + 0.5 * q) * g
    if alpha:
        alpha_i = alpha_j = alpha
        if alpha == "auto":
            z, dp = s.rho * c, np.abs(p[i] - p[j])
            excess = np.maximum(0, dp - bonded * np.minimum(z[i], z[j]) * np.sqrt((vij**2).sum(1))) / np.where(dp == 0, 1, dp)
            alpha_i, alpha_j = (2 * cij * s.rho[k] * excess / (z[i] + z[j]) for k in (i, j))
        phi = (p[i] - p[j]) / cij * dWdr * open_
        drho_i, drho_j = drho_i + alpha_i * phi * V[j], drho_j - alpha_j * phi * V[i]
    n = len(s.x)
    f = np.zeros((n, 3))
    de, drho, heats = np.zeros(n), np.zeros(n), np.zeros(n)
    for target, value in ((i, 1), (j, -1)):
        np.add.at(f, target, value * force)
    for array, one, other in ((de, de_i, de_j), (drho, drho_i, drho_j), (heats, 0.5 * q * g, 0.5 * q * g)):
        np.add.at(array, i, one)
        np.add.at(array, j, other)
    virial = np.einsum("ka,kb->ab", d, force)
    return dict(f=f, de=de, drho=drho, heat=(q * g).sum(), heats=heats, virial=virial, p=p, c=c)


def weight_ratio(s, a, b, rho0=None):
    """by how much particles of type b count more than those of type a in the density of a; rho0: {type: of materials that have one}

    The ratio of volumes at rho0. A gas has none: that of h^dim or that of masses, whichever is nearer to 1, and 1 if one is above and one below.
    """
    masses, volumes = s.mass[b] / s.mass[a], (s.h[b] / s.h[a]) ** s.dim
    if rho0 and a in rho0 and b in rho0:
        volumes = masses * rho0[a] / rho0[b]
        return 1.0 if abs(np.log(volumes)) < 0.01 else volumes
    ratio = float(np.median([1.0, masses, volumes]))
    return 1.0 if abs(np.log(ratio)) < 0.01 else ratio


def riemann_rates(s, eos, kernel, tension=True, h=None, follows=None, A=1.2, steep=1.5, rho0=None):
    """as rates(), for dissipation riemann; follows (n,): h of which particles is a function of their density (dh/drho = -h/(dim rho))

    rho0: {type: of materials that have one}, see weight_ratio()
    """
    p, c = np.empty(len(s.x)), np.empty(len(s.x))
    for t in set(s.type):
        k = s.type == t
        p[k], c[k] = eos[t](s.rho[k], (s.esph / s.m)[k])
    h = np.array([s.h[t] for t in s.type]) if h is None else h
    V, n = s.m / s.rho, len(s.x)
    i, j = np.nonzero(~np.eye(n, dtype=bool))  # every pair twice: each row is what happens to i
    d = s.x[i] - s.x[j]
    for a in range(3):
        if s.periodic[a]:
            d[:, a] -= s.box[a] * np.round(d[:, a] / s.box[a])
    r = np.sqrt((d**2).sum(1))
    # kernels of types of different h: as wide as their mean
    H = np.array([s.h[t] for t in s.type])
    h_i, h_j = (0.5 * h[k] * (H[i] + H[j]) / H[k] for k in (i, j))
    near = r < SUPPORT[kernel] * np.maximum(h_i, h_j)
    i, j, d, r, h_i, h_j = i[near], j[near], d[near], r[near], h_i[near], h_j[near]
    e = d / r[:, None]
    counts = {(a, b): weight_ratio(s, a, b, rho0) for a in s.mass for b in s.mass}
    more = np.array([counts[s.type[a], s.type[b]] for a, b in zip(i, j)])  # w_j/w_i

    def dW(wide):  # dW/dr
        return norm(kernel, s.dim) / wide ** (s.dim + 1) * shape(kernel, r / wide)[1]

    def total(values):
        out = np.zeros((n,) + values.shape[1:])
        np.add.at(out, i, values)
        return out

    # numbers of particles, and h dW/dh = -norm/h^dim (dim w + q dw/dq); the particle itself included
    w, dw = shape(kernel, r / h_i)
    center = norm(kernel, s.dim) / h**s.dim * shape(kernel, np.zeros(n))[0]
    number = total(more * norm(kernel, s.dim) / h_i**s.dim * w) + center
    spread = total(-more * norm(kernel, s.dim) / h_i**s.dim * (s.dim * w + r / h_i * dw)) - s.dim * center
    omega = np.where(np.zeros(n, bool) if follows is None else follows, np.maximum(1 + spread / (s.dim * number), 0.25), 1.0)

    weight = (-V[j] * 0.5 * (dW(h_i) + dW(h_j)))[:, None]
    grad_v = total(weight[:, :, None] * np.einsum("ka,kb->kab", s.v[i] - s.v[j], e))
    grad_p = total(weight * ((p[i] - p[j])[:, None] * e))

    def limited(a, b):  # monotonized central
        size = np.minimum(0.5 * np.abs(a + b), 2 * np.minimum(np.abs(a), np.abs(b)))
        return np.where(a * b > 0, np.sign(a) * size, 0.0)

    u = ((s.v[i] - s.v[j]) * e).sum(1)
    closing = np.maximum(0, -u)
    beyond = [2 * np.einsum("kab,ka,kb->k", grad_v[k], d, e) - u for k in (i, j)]
    u_i, u_j = (0.5 * limited(u, b) / (1 + steep * closing / np.minimum(c[i], c[j])) for b in beyond)
    p_i, p_j = (p[k] - sign * 0.5 * limited(p[i] - p[j], 2 * (grad_p[k] * d).sum(1) - (p[i] - p[j])) for k, sign in ((i, 1), (j, -1)))
    z_i, z_j = (s.rho[k] * c[k] for k in (i, j))
    sound = (0.5 * u * (z_i - z_j) - (p[i] - p[j])) / (z_i + z_j)  # velocity of the contact, from the mean of both
    z_i, z_j = z_i + A * s.rho[i] * np.maximum(0, sound - 0.5 * u), z_j + A * s.rho[j] * np.maximum(0, -0.5 * u - sound)
    # velocities along e from the mean of both particles: of i u/2, of j -u/2
    U_i, U_j = 0.5 * u - u_i, -0.5 * u + u_j
    star_p = (z_j * p_i + z_i * p_j - z_i * z_j * (U_i - U_j)) / (z_i + z_j)
    delta = (z_i * U_i + z_j * U_j - (p_i - p_j)) / (z_i + z_j)
    viscous = -z_i * z_j * (U_i - U_j) / (z_i + z_j)
    open_ = (star_p > 0) | (True if tension else s.type[i] == s.type[j])
    star_p, delta = star_p * open_, delta * open_
    stretch = u * (open_ | (u < 0))

    G_i, G_j = (V[k] / (number[k] * omega[k]) * dW(wide) * w for k, wide, w in ((i, h_i, more), (j, h_j, 1 / more)))
    U_j = V[j] / more  # volumes over weights, in units in which w_i = 1
    K = 2 * V[i] * U_j / (V[i] + U_j) * (dW(h_i) + dW(h_j))
    pair = -(star_p * (G_i + G_j))[:, None] * e
    de = star_p * (G_i * u - (G_i + G_j) * delta)
    drho = s.rho[i] / omega[i] * more * (dW(h_i) * stretch / number[i] - K * delta)
    heats = 0.5 * viscous * (G_i + G_j) * u
    return dict(f=total(pair), de=total(de), drho=total(drho), heat=heats.sum(), heats=total(heats),
                virial=0.5 * np.einsum("ka,kb->ab", d, pair), p=p, c=c)


def tait(rho0, c0, gamma=7.0):
    def law(rho, e):
        return rho0 * c0**2 / gamma * ((rho / rho0) ** gamma - 1), c0 * (rho / rho0) ** (0.5 * (gamma - 1))

    return law


def ideal_gas(gamma):
    return lambda rho, e: ((gamma - 1) * rho * e, np.sqrt(gamma * (gamma - 1) * e))


def linear(rho0, K):
    return lambda rho, e: (K * (rho / rho0 - 1), np.full_like(rho, np.sqrt(K / rho0)))


HEAD = """units lj
dimension {dimension}
newton {newton}
boundary {boundary}
atom_style sph
atom_modify map array {sort}
comm_style {comm}
read_data {data}
"""

RATES = """compute R all property/atom drho desph rho esph
dump d all custom 1 {0} id type x y z vx vy vz fx fy fz c_R[1] c_R[2] c_R[3] c_R[4]
dump_modify d format float %.17g sort id
run 0
undump d
"""


def scene(s, data, pair, newton="on", comm="brick", sort=True, skin=0.3, fix="fix sph all hvi/sph\n"):
    """writes the data file; pair: the lines of pair_style and pair_coeff"""
    s.write(data)
    boundary = " ".join("p" if a else "f" for a in s.periodic)
    text = HEAD.format(dimension=2 if s.dim == 2 else 3, newton=newton, boundary=boundary, comm=comm, data=data,
                       sort="" if sort else "sort 0 0")
    return text + pair + f"neighbor {skin} bin\nneigh_modify every 1 delay 0 check yes\n" + fix


def read_rates(path):
    """of the last frame: dict of f (n, 3), drho, de, rho, esph, x, v by ascending id"""
    return named(read_dump(path), R="drho de rho esph")
