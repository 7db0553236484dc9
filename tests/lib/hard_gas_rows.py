"""Hard cases on rows, and the round blasts: scenes of shock_scenes.py and more of their kind, each with its exact solution; for hard_gas.py.

What is in shock_scenes.py is run as it is, at the resolution of its bounds (tests/verify/shock_bounds.csv, written down before its first run).
New here: gas and shocked metal that expand into nothing, an isentrope through the vapor dome, hot gas beside cold metal, gas of no pressure and
energy, density 1000 : 1, spacings 2 and 4 to 1, tables at their edges, steps that are too long. Bounds come from the exact solutions, as there:
what REACH smoothing lengths on both sides smear.
"""

import csv
import functools
import pathlib

import numpy as np
from hard_cases import Cannot
from hvi.material import library
from hvi.material.curves import Eos
from hvi.material.eos_table import write_eos_table
from lammps_runs import Stopped
from reference import impedance
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial import cKDTree
from shock_runs import cannot, prepared, read_frame, read_log, run, script, stock_step, write_data
from shock_scenes import COURANT, ETA, REACH, Interface, NohRow, Plates, Row, Tube, mean_around, row
from shock_scenes import CASES as SHOCKS

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTICLE_MEANS = ("rho", "u", "p")


def paired(x, spacing, kind, near=0.5):
    """part of the particles whose nearest neighbor of the same type is nearer than `near` of the spacing that their density says"""
    close = 0
    for t in np.unique(kind):
        if (kind == t).sum() > 1:
            close += (cKDTree(x[kind == t]).query(x[kind == t], k=2)[0][:, 1] < near * spacing[kind == t]).sum()
    return close / len(x)


def bounds_of(name):
    """n, {measure: bound} of a case of shock_scenes.py"""
    with open(ROOT / "tests" / "verify" / "shock_bounds.csv") as f:
        r = next(r for r in csv.DictReader(line for line in f if line[0] != "#") if r["case"] == name)
    return int(r["n"]), {k: float(r[f"l1_{k}"]) for k in PARTICLE_MEANS if r[f"l1_{k}"]}


def on_row(case, n, at_rest=None):
    """a Case.scene of hard.py for a case of shock_scenes.py; settings are names of methods there

    at_rest: speed of sound of a scene in which nothing should move: error of momentum in units of that times the mass
    """

    def scene(lmp, folder, method):
        if cannot(case, method):
            raise Cannot(cannot(case, method))
        o = run(case, method, n, lmp.exe, folder, timeout=600)
        if o.error:
            raise Stopped(o.error)
        full = prepared(case, method, n)[0]
        mass = np.array(full.mass)[full.type - 1]
        out = {**o.l1, **o.numbers, "energy": o.energy, "momentum": o.momentum}
        if at_rest:
            table = read_log((folder / "log").read_text())[0]
            out["momentum"] = np.abs(table[:, 7:10] - table[0, 7:10]).max() / (mass.sum() * at_rest)
        if method == "stock":
            return out
        last = read_frame(folder / f"frame.{len(case.times) - 1}", mass)
        if full.mirror:
            out["symmetry"] = o.symmetry
        size = (mass / last["rho"]) ** (1 / case.dim)
        # a lattice that is squeezed by 4 in one direction, as by a shock, has neighbors at 1/2 (2D), 0.4 (3D) of the spacing without pairing
        out["paired"] = paired(last["x"], size, full.type, 0.5 if case.dim == 1 else 0.25)
        return out

    return scene


# ------------------------------------------------------------------ into nothing


def along_isentrope(pressure, rho, e, end, steps=20000):
    """rho, e, p, c and the velocity that expansion has given, u = int c/rho d rho, from (rho, e) down to the density `end`"""
    x = np.linspace(np.log(rho), np.log(end), steps)
    slope = lambda y, e: pressure(np.exp(y), e) / np.exp(y)  # noqa: E731  de/d ln rho
    es = solve_ivp(slope, (x[0], x[-1]), [e], "DOP853", x, rtol=1e-11, atol=1e-11 * abs(e), max_step=(x[0] - x[-1]) / 400).y[0]
    r, d = np.exp(x), x[1] - x[0]
    p = pressure(r, es)
    c = np.sqrt(np.maximum(np.gradient(p, r), 0.0))
    u = np.concatenate([[0.0], np.cumsum(0.5 * (c[1:] + c[:-1]) * -d)])
    return r, es, p, c, u


class Nothing:
    """gas of rho = p = 1 in x < 1 expands into nothing: the centered rarefaction, until it is back at x = 0. By the mass M from the front,
    c = c0 s, M = rho0 c0 t s^((gamma + 1)/(gamma - 1)), u = 2 c0 (1 - s)/(gamma - 1)"""

    def __init__(self, t, gamma=1.4):
        self.c0, self.gamma, self.front = np.sqrt(gamma), gamma, 2 * np.sqrt(gamma) / (gamma - 1)
        self.mass = self.c0 * t  # that has begun to move

    def at(self, M):
        """rho, u, p by the mass from the front"""
        g = self.gamma
        s = np.minimum(M / self.mass, 1.0) ** ((g - 1) / (g + 1))
        return np.array([s ** (2 / (g - 1)), self.front * (1 - s), s ** (2 * g / (g - 1))])


class Release(Row):
    """gas into nothing; errors by mass, for by volume it would be the front alone that counts"""

    def __init__(self, n):
        super().__init__("vacuum-gas", [0.5], (n,), (n,))
        self.solution = Nothing(0.5)

    def scene(self, n, method=None):
        scene = row([(0.0, 1.0, 1 / n, (1.0, 0.0, 2.5), 1)], True, 1 / n, n, ["idealgas 1.4"], periodic=False)
        scene.box[0] = -6.0, 6.0
        return scene

    @functools.lru_cache
    def exact(self, cells=200000):
        """rho, u, p over the mass from the middle, edges of cells"""
        edge = np.linspace(0.0, 1.0, cells + 1)
        return edge, self.solution.at(1.0 - 0.5 * (edge[1:] + edge[:-1]))

    def densities(self):
        return 0.05, 1.2

    def profile(self, t):  # for the step of stock, which needs speeds only
        edge, q = self.exact()
        return edge, edge, *np.maximum(q, 1e-12)

    def means(self, f, n):
        return f.reshape(n, -1).mean(axis=1)

    def errors(self, n, scene, frame):
        k = scene.measured
        got = frame["rho"][k], frame["v"][k, 0], frame["p"][k]
        exact = [self.means(f, n) for f in self.exact()[1]]
        l1 = {f: np.abs(g - e).mean() / np.ptp(e) for f, g, e in zip(PARTICLE_MEANS, got, exact)}
        return {**l1, "front": got[1][-1] / exact[1][-1] - 1}, None, None, None, None

    def criteria(self, n):
        """the exact fields against their means over REACH ETA particles on both sides; the front not slower than the mean over as many, nor
        faster than 5 % above the mean over the mass of the last particle"""
        edge, q = self.exact()
        reach = REACH * ETA / n
        l1 = [np.abs(mean_around(edge, f, reach) - f).mean() / np.ptp(f) for f in q]
        outer = edge[:-1] > 1 - reach - 1 / n
        slow = q[1][outer].mean() / self.means(q[1], n)[-1] - 1
        return {f: float(f"{b * (2 if f == 'rho' else 1):.3g}") for f, b in zip(PARTICLE_MEANS, l1)} | {"front": (float(f"{slow:.3g}"), 0.05)}


class Spalled(Plates):
    """plates that meet, until their shocks have been released at the rear faces: these are then at 2 u, and a little more, as the isentrope of the
    shocked state says (the shocks have heated the metal); stops before the fans from both faces meet and pull"""

    def __init__(self, speed, n):
        super().__init__("vacuum-plate", impedance.AL6061, impedance.AL6061, speed, (n,), (n,))
        self.times = [1.5 * self.solution.last]
        law, u = Eos(library.read(str(ROOT / "potentials" / "Al6061-T6.hvi"))), 0.5 * speed
        _, _, rho, e = (float(a) for a in law.hugoniot(u))
        r, _, p, _, v = along_isentrope(law.pressure, rho, e, 0.6 * rho)
        self.surface = np.interp(0.0, -p, v)  # what expansion to p = 0 gives

    def densities(self):
        return 0.6, 2.0

    def errors(self, n, scene, frame):
        return {}, None, None, None, None

    def numbers(self, n, scene, frames):
        outer = frames[-1]["v"][-n:, 0][int(0.8 * n):int(0.97 * n)]  # behind the tail of the fan, but for the last particles
        # in the laboratory 2 u is the speed of the flyer; here half of it is the frame's
        return {"surface": abs(outer.mean() / self.surface - 1), "double": abs(outer.mean() / self.solution.speed - 0.5)}


class Dome(Row):
    """a slab of aluminum, Tillotson, as a shock of `pressure` leaves it, expands into nothing on both sides, by its isentrope. Seen before the waves
    meet in the middle; and, if it becomes vapor rather than pull, when all of it has expanded."""

    gamma, units, length = None, "si", 0.01

    def __init__(self, pressure, n, later=()):
        self.law = Eos(library.read(str(ROOT / "potentials" / "Al-Tillotson.hvi")))
        energy = lambda rho: 0.5 * pressure * (1 / self.law.rho0 - 1 / rho)  # noqa: E731
        self.rho = brentq(lambda rho: float(self.law.pressure(rho, energy(rho))) - pressure, 1.05 * self.law.rho0, 4 * self.law.rho0)
        self.e = energy(self.rho)
        self.path = along_isentrope(self.law.pressure, self.rho, self.e, 0.01 * self.rho)
        c = self.path[3][1]
        super().__init__(f"vapor-dome-{pressure / 1e9:.0f}", [t * self.length / c for t in (0.8, *later)], (n,), (n,))

    def scene(self, n, method=None):
        v = self.law.v
        words = " ".join(f"{v[k]:.17g}" for k in ("rho0", "a", "b", "A", "B", "E0", "Eiv", "Ecv", "alpha", "beta", "cp"))
        return row([(0.0, self.length, self.length / n, (self.rho, 0.0, self.e), 1)], True, self.length / n, n, [f"tillotson {words}"],
                   periodic=False, units="si")

    def densities(self):
        return 0.02, 1.2

    def errors(self, n, scene, frame):
        return {}, None, None, None, None

    def numbers(self, n, scene, frames):
        """before the waves meet: isentrope: mean |e - e_s(rho)| over that at the start; back: falls of u from the middle to the face, which should
        be none, over the largest u; surface: velocity behind the fan, where p is 0, relative error (if nothing comes later)"""
        first, (r, e, p, _, u) = frames[0], self.path
        v = first["v"][n:, 0]
        out = {"isentrope": np.abs(first["e"] - np.interp(first["rho"], r[::-1], e[::-1])).mean() / self.e,
               "back": np.maximum(-np.diff(v), 0.0).sum() / v.max()}
        if len(self.times) == 1:
            out["surface"] = abs(v[int(0.85 * n):int(0.97 * n)].mean() / u[np.argmax(p <= 0)] - 1)
        return out


# ------------------------------------------------------------------ what differs much


class HotGas(Row):
    """gas of 10 GPa (1e5 bar) between plates of cold aluminum: a shock in the metal, a rarefaction in the gas; gas of 100 kg/m^3, gamma 1.4"""

    units, length = "si", 0.01

    def __init__(self, n):
        self.metal, self.start_p, self.start_rho = impedance.AL6061, 1e10, 100.0
        c = np.sqrt(1.4 * self.start_p / self.start_rho)
        fan = lambda p: 5 * c * (1 - (p / self.start_p) ** (1 / 7))  # noqa: E731
        self.u = brentq(lambda u: fan(self.metal.pressure(u)) - u, 0.0, 0.99 * brentq(lambda u: self.metal.pressure(u) - self.start_p, 0, 2000))
        self.p = self.metal.pressure(self.u)
        # the fan comes back from the middle of the gas after this, so that the plateau is short of it
        super().__init__("hot-gas", [1.5 * self.length / c], (n,), (n,))
        self.gamma = None  # the metal is no gas: nothing for stock

    def scene(self, n, method=None):
        m, dx = self.metal, self.length / n
        parts = [(-3 * self.length, 0.0, dx, (self.start_rho, 0.0, self.start_p / self.start_rho / 0.4), 1),
                 (0.0, self.length, dx, (m.rho0, 0.0, 0.0), 2)]
        eos = ["idealgas 1.4", f"gruneisen {m.rho0} {m.c0} {m.s} {m.gamma} {m.b} 0"]
        return row(parts, True, dx, n, eos, periodic=False, units="si", tension=False)

    def densities(self):
        return 0.3, 2.0

    def errors(self, n, scene, frame):
        return {}, None, None, None, None

    def numbers(self, n, scene, frames):
        """p, u, rho of the metal between 25 and 75 % of what the shock has passed; p of the gas over as long a way from the contact"""
        last, right = frames[-1], np.arange(len(scene.x)) >= len(scene.x) // 2
        metal, hot = right & (scene.type == 2), right & (scene.type == 1)
        place = (np.arange(metal.sum()) + 0.5) * self.length / n
        passed = self.metal.shock_speed(self.u) * self.times[0]
        on = (place > 0.25 * passed) & (place < 0.75 * passed)
        x = last["x"][hot, 0] - last["x"][metal, 0].min()
        near = (x < -0.25 * passed) & (x > -0.75 * passed)
        mean = lambda f, k, j: last[f][k][j].mean()  # noqa: E731
        return {"p": abs(mean("p", metal, on) / self.p - 1), "rho": abs(mean("rho", metal, on) / self.metal.density(self.u) - 1),
                "u": abs(last["v"][metal, 0][on].mean() / self.u - 1), "p_gas": abs(mean("p", hot, near) / self.p - 1)}


class Spaced(Interface):
    """a shock of Mach 3 goes from spacing dx to `coarse` dx in the same gas: nothing should happen there"""

    def __init__(self, coarse, n):
        super().__init__(1, (n,), (n,))
        self.name, self.coarse = f"spacing-{coarse}-shock", coarse

    def scene(self, n, method=None):
        s, dx = self.solution, 1 / n
        rho, u, p = s.behind
        e = [q[2] / q[0] / 0.4 for q in (s.behind, s.light, s.dense)]
        parts = [(self.lo, s.xs, dx / rho, (rho, 0.0, e[0]), 1), (s.xs, 0.0, dx, (1.0, s.light[1], e[1]), 2),
                 (0.0, self.hi, self.coarse * dx, (1.0, s.dense[1], e[2]), 3)]
        return row(parts, True, dx, n, ["idealgas 1.4"] * 3)

    def masses(self, n, m):
        s, middle = self.solution, 0.5 * (m[1:] + m[:-1])
        return np.where(middle < (s.xs - self.lo) * s.behind[0] - s.xs, 1.0, self.coarse) / n


class SpacedRest(Row):
    """gas at rest, spacing dx beside `coarse` dx, for a time in which sound goes 1.2 of the length: largest errors of any particle"""

    def __init__(self, coarse, n):
        super().__init__(f"spacing-{coarse}-rest", [1.0], (n,), (n,))
        self.coarse = coarse

    def scene(self, n, method=None):
        parts = [(lo, lo + 0.5, k / n, (1.0, 0.0, 2.5), t) for lo, k, t in ((0.0, 1, 1), (0.5, self.coarse, 2))]
        return row(parts, True, 1 / n, n, ["idealgas 1.4"] * 2)

    def densities(self):
        return 0.5, 2.0

    def errors(self, n, scene, frame):
        worst = dict(rho=frame["rho"] - 1, p=frame["p"] - 1, u=np.abs(frame["v"]).max(axis=1) / np.sqrt(1.4))
        return {k: np.abs(v).max() for k, v in worst.items()}, None, None, None, None


# ------------------------------------------------------------------ no pressure, no energy


class ColdNoh(NohRow):
    """as NohRow, but no energy at all: the speed of sound is 0"""

    def __init__(self, n):
        super().__init__((n,), (n,))
        self.name = "cold-noh"

    def scene(self, n, method=None):
        scene = super().scene(n, method)
        scene.e[:] = 0.0
        return scene


class ColdBlast(Tube):
    """a blast into gas at rest of no pressure and no energy: the limit of the strong shock"""

    def __init__(self, n):
        super().__init__("cold-blast", (1, 0, 1000), (1, 0, 1e-9), 0.012, (n,), (n,))

    def scene(self, n, method=None):
        scene = super().scene(n, method)
        scene.e[scene.e < 1.0] = 0.0
        return scene


# ------------------------------------------------------------------ said or silent


SOD = SHOCKS["sod-spacing"]


class Tabled(Tube):
    """the shock tube SOD with a table for the gas, over densities and energies as given"""

    def __init__(self, name, rho, e):
        super().__init__(name, SOD.left, SOD.right, 0.2, (SOD.bound_n,), (SOD.bound_n,))
        self.rho, self.e = rho, e

    def scene(self, n, method=None):
        scene = super().scene(n, method)
        scene.eos = ["table gas.table"] * len(scene.eos)
        return scene

    def write(self, folder):
        folder.mkdir(exist_ok=True)
        write_eos_table(folder / "gas.table", np.linspace(*self.rho, 21), np.linspace(*self.e, 21), lambda rho, e: 0.4 * rho * e, units="lj",
                        comment="ideal gas, gamma 1.4")


def tabled(margin):
    """a gas by a table that reaches from the exact states of SOD by `margin` (its top density, times) further

    differs: largest difference of the errors from those of the gas by its formula; silent: 1 if a table that ends at 0.9 of the energy behind the
    shock goes on without a word.
    """

    def scene(lmp, folder, method):
        n = SOD.bound_n
        whole, short = Tabled("whole", (0.1, margin), (1.0, 4.0)), Tabled("short", (0.1, margin), (1.0, 2.55))
        for case in (whole, short):
            case.write(folder / case.name)
        law = run(SOD, method, n, lmp.exe, folder / "law")
        inside = run(whole, method, n, lmp.exe, folder / "whole")
        if law.error or inside.error:
            raise Stopped(law.error or inside.error)
        beyond = run(short, method, n, lmp.exe, folder / "short")
        return {"differs": max(abs(inside.l1[f] - law.l1[f]) for f in law.l1), "silent": float("table" not in beyond.error),
                "energy": inside.energy, "momentum": inside.momentum}

    return scene


def long_step(lmp, folder, method):
    """SOD with three times the step that the formula of fix hvi/dt (for stock: of the fastest signal) has with C = 1, the limit of stability.
    silent: 1 if the answer is wrong, beyond bounds or twice what it is with C = 0.2, and neither an error, nor a warning, nor an energy that
    drifts by more than 1e-3 says so"""
    n, words = SOD.bound_n, "fix step all hvi/dt"
    right = run(SOD, method, n, lmp.exe, folder / "right")
    if right.error:
        raise Stopped(right.error)
    scene, _, rows = prepared(SOD, method, n)
    write_data(scene, folder / "data")
    if method == "stock":
        head, dt = script(SOD, scene, method, n).partition("timestep")[0], stock_step(SOD, n) / COURANT
    else:
        head = script(SOD, scene, method, n).partition(words)[0]
        dt = 2 * float(lmp(head + f"{words} 0.5\nrun 0\n").thermo["Dt"][0])
    frame, steps = folder / "frame.0", int(np.ceil(SOD.times[0] / (3 * dt)))
    frame.unlink(missing_ok=True)
    try:
        r = lmp(head + f"timestep {SOD.times[0] / steps:.17g}\nrun {steps}\nwrite_dump all custom frame.0 id x y z vx vy vz c_s[1] c_s[2]"
                       f"{'' if method == 'stock' else ' c_p'} modify sort id format float %.17g\n")
    except Stopped:
        return {"silent": 0.0}
    drift = np.abs(r.thermo["c_book[9]"] - 1).max()
    last = read_frame(frame, np.array(scene.mass)[scene.type - 1])
    finite = all(np.isfinite(a).all() for a in last.values())
    last = {k: a.reshape(-1, rows, *a.shape[1:]).mean(axis=1) for k, a in last.items()}
    l1 = SOD.errors(n, SOD.scene(n, method), last)[0] if finite else {}
    wrong = not finite or any(l1[f] > max(SOD.bounds(n)[f], 2 * right.l1[f]) for f in l1)
    return {"silent": float(wrong and not (r.warnings or not drift <= 1e-3))}
