"""Scenes of solids for the verification tests: materials, rows and lattices, runs, frames, and what theory says about them."""

import numpy as np
from dumps import frames, named
from sph_scenes import SUPPORT, Fluid, norm, shape

STATE = ("p", "e", "T", "eps", "epsdot", "damage", "spalled", "vm", "sxx", "syy", "szz", "sxy", "voids", "void_damage", "fragsize")


def material(path, *sections, units="lj"):
    """sections: "kind law key value ...", each on a line of its own in the file"""
    lines = [f"# DATE: 2026-01-01 UNITS: {units} CONTRIBUTOR: test CITATION: none"]
    for section in sections:
        kind, law, *words = section.split()
        lines += [f"{kind} {law}"] + [f"  {key} {value}" for key, value in zip(words[::2], words[1::2])]
    path.write_text("\n".join(lines) + "\n")
    return path


def row(length, n, x0=0.0, margin=0.1, rho=1.0):
    """n particles over a length, one row; box with a margin at both ends"""
    dx = length / n
    x = np.zeros((n, 3))
    x[:, 0] = x0 + (np.arange(n) + 0.5) * dx
    box = np.array([length + 2 * margin, 20 * dx, 20 * dx])
    x[:, 0] += margin
    return Fluid(x, np.zeros((n, 3)), np.full(n, rho), np.zeros(n), np.ones(n, int), {1: rho * dx}, {1: 1.2 * dx}, box,
                 (False, True, True), 1)


def run(lmp, folder, s, pair, jc, steps, more="", dt=None, frames=None, units="lj", lost="error", ledger="", every=None, name="f",
        skin=0.3, **how):
    """runs the scene; frames: steps of the dump (every so many), None for the last one only"""
    spacing = min(s.h.values()) / 1.2
    s.write(folder / f"{name}.data")
    text = f"""units {units}
dimension {2 if s.dim == 2 else 3}
boundary {' '.join('p' if a else 'f' for a in s.periodic)}
atom_style sph
atom_modify map array
{'processors * 1 1' if s.dim == 1 else ''}
read_data {name}.data
{pair}
neighbor {skin * spacing:.17g} bin
neigh_modify every 1 delay 0 check yes
fix jc all hvi/johnson-cook {jc}
compute book all hvi/energy {ledger}
fix sph all hvi/sph
{f'timestep {dt:.17g}' if dt else 'fix step all hvi/dt 0.2'}
compute S all hvi/atom {' '.join(STATE)}
compute R all property/atom rho
dump d all custom {frames or max(steps, 1)} {name}.dump id type x y z vx vy vz c_R c_S[*]
dump_modify d format float %.17g sort id time yes
thermo {every or frames or max(1, steps // 20)}
thermo_style custom step time dt atoms &
 c_book[1] c_book[2] c_book[9] c_book[10] c_book[11] c_book[12] c_book[13] c_book[14] c_book[15] &
 c_book[16] c_book[17] c_book[18] c_book[21]
thermo_modify format float %.17g lost {lost}
{more}
"""
    if steps:
        text += f"run {steps}\n"
    result = lmp(text, **how)
    result.frames = read_frames(folder / f"{name}.dump")
    return result


def read_frames(path):
    return [dict(named(f, R="rho", S=" ".join(STATE)), time=f.time) for f in frames(path)]


def momentum_error(t):
    """largest change of momentum (particles + what left - clamps), by direction"""
    return [np.abs(p - p[0]).max() for p in (t[f"c_book[{10 + k}]"] + t[f"c_book[{13 + k}]"] - t[f"c_book[{16 + k}]"] for k in range(3))]


def consistency(kernel, h, dim):
    """the sum over neighbors, - V sum_j x dW/dx, inside a lattice of spacing 1: 1 for gradients of linear fields that are exact without M"""
    k = int(np.ceil(SUPPORT[kernel] * h))
    x = np.stack(np.meshgrid(*[np.arange(-k, k + 1)] * dim, indexing="ij"), -1).reshape(-1, dim)
    x = x[np.abs(x).sum(1) > 0]
    r = np.sqrt((x**2).sum(1))
    return -(x[:, 0] ** 2 / r * norm(kernel, dim) / h ** (dim + 1) * shape(kernel, r / h)[1]).sum()


class Gruneisen:
    """Mie-Grueneisen, linear Hugoniot, Gamma rho = const"""

    def __init__(self, rho0, c0, s, g0):
        self.rho0, self.c0, self.s, self.g0 = rho0, c0, s, g0

    def p(self, rho, e):
        eta = 1 - self.rho0 / rho
        pH = self.rho0 * self.c0**2 * eta / (1 - self.s * eta) ** 2
        return pH * (1 - 0.5 * self.g0 * eta) + self.g0 * self.rho0 * e


def bisect(f, a, b):
    fa = f(a)
    for _ in range(200):
        m = 0.5 * (a + b)
        fm = f(m)
        if (fm > 0) == (fa > 0):
            a, fa = m, fm
        else:
            b = m
    return 0.5 * (a + b)


def piston(eos, G, Y, u):
    """elastic-plastic piston into a hypoelastic, perfectly plastic half-space at rest, planar: the states and speeds of both shocks

    The precursor ends where S = 4/3 G ln(rho/rho0) reaches 2/3 Y; both shocks keep mass, momentum and energy.
    """
    S, rho0 = 2 / 3 * Y, eos.rho0
    rho1 = rho0 * np.exp(Y / (2 * G))

    def state(rho, rho_, sigma_, e_):
        dV = 1 / rho_ - 1 / rho

        def miss(p):
            return eos.p(rho, e_ + 0.5 * (sigma_ + p + S) * dV) - p

        p = bisect(miss, 0.0, 10 * eos.rho0 * eos.c0**2)
        return p, e_ + 0.5 * (sigma_ + p + S) * dV

    p1, e1 = state(rho1, rho0, 0.0, 0.0)
    u1 = np.sqrt((p1 + S) * (1 / rho0 - 1 / rho1))

    def speed(rho):
        p, e = state(rho, rho1, p1 + S, e1)
        return u1 + np.sqrt(max((p - p1) * (1 / rho1 - 1 / rho), 0.0))

    rho2 = bisect(lambda r: speed(r) - u, rho1 * (1 + 1e-12), 1.4 * rho1)
    p2, e2 = state(rho2, rho1, p1 + S, e1)
    return dict(rho1=rho1, p1=p1, u1=u1, D1=u1 * rho1 / (rho1 - rho0), rho2=rho2, p2=p2, u2=u, e2=e2,
                D2=u1 + (u - u1) * rho2 / (rho2 - rho1), S=S)


def crossings(x, f, level):
    """where f(x) crosses the level, linear between points"""
    k = np.nonzero((f[1:] - level) * (f[:-1] - level) < 0)[0]
    return x[k] + (level - f[k]) / (f[k + 1] - f[k]) * (x[k + 1] - x[k])
