"""Large plastic strain: Verney's shell of beryllium, which collapses and stops, and Taylor's cylinder of copper. What they are: tests/verify/solids.py."""

import pathlib
import time

import numpy as np
from solid_runs import material, momentum_error, run
from sph_scenes import Fluid

ROOT = pathlib.Path(__file__).resolve().parents[2]


def verney(lmp, folder, dx, words="viscosity 0.1 0.5", h=1.2, kernel="cubic", t_end=150.0, octant=False, courant=0.2, skin=0.3,
           variable=False):
    """octant: an eighth of the shell, between mirrors; skin in spacings"""
    path = material(folder / "Be.hvi", "eos gruneisen rho0 1.845 C 0.7998 S1 1.124 g0 1.11 a 0.16 T0 300", "strength perfect G 1.510 Y 0.0033")
    k = int(np.ceil(10 / dx))
    x = dx * (np.stack(np.meshgrid(*[np.arange(-k, k)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5)
    r0 = np.sqrt((x**2).sum(1))
    x = x[(r0 > 8) & (r0 < 10) & ((x > 0).all(1) | (not octant))]
    r0 = np.sqrt((x**2).sum(1))
    n, center = len(x), 0.0 if octant else 12.0
    s = Fluid(x + center, np.zeros((n, 3)), np.full(n, 1.845), np.zeros(n), np.ones(n, int), {1: 1.845 * dx**3}, {1: h * dx}, np.full(3, 12.0 + center),
              (False,) * 3)
    s.v = -0.0619787 * (8 / r0**1.5)[:, None] ** 2 * x
    steps = int(t_end / (courant * h * dx / 1.35))
    how = f"h {'variable' if variable else 'constant'} {'mirror x 0 lo mirror y 0 lo mirror z 0 lo' if octant else ''}"
    pair = f"pair_style hvi/sph {kernel} form sum {words} {how}\npair_coeff 1 1 file {path} h {h * dx}\n"
    start = time.time()
    r = run(lmp, folder, s, pair, "strength perfect damage no spall none", steps, dt=t_end / steps, frames=max(1, steps // 50), skin=skin)
    inner = []
    for f in r.frames:
        y = f["x"] - center
        rad = np.sqrt((y**2).sum(1))
        inner.append(np.median(np.cbrt(np.maximum(512 + rad**3 - r0**3, 0))))
    k = int(np.argmin(inner))
    t = r.thermo
    return dict(spacing=dx, kernel=kernel, h=h, words=words, particles=n, steps=steps, seconds=time.time() - start, inner=inner[k],
                stops_at=r.frames[k]["time"], drift=np.abs(t["c_book[9]"] - 1).max(), momentum=max(momentum_error(t)),
                kinetic=t["c_book[1]"].min() / t["c_book[1]"][0], strength=strength(inner[k]),
                viscous=stop(0.5 * viscosity(words) * 1.316 * h * dx / 10))


def strength(r):
    """of a shell that stops at the inner radius r, in units of the exact one: kinetic energy over plastic work on the way"""
    x = np.linspace(r, 8, 4001)
    return 2 * 1.845 * 0.0619787**2 * 8**4 * (1 / 8 - 1 / 10) / (8 * 0.0033 * np.trapz(x * x * np.log(np.cbrt(x**3 + 488) / x), x))


def viscosity(words):
    """the linear coefficient; riemann has none"""
    return float(words.split("viscosity")[1].split()[0]) if "viscosity" in words else 0.0


def stop(nu, r=8.0, R=10.0, u=0.0619787, rho=1.845, Y=0.0033):
    """where an incompressible shell of kinematic viscosity nu stops: kinetic energy = plastic + viscous work, v = u (r/x)^2

    2 pi rho u^2 r^4 (1/r - 1/R); 8 pi Y u r^2 ln(R/r); 16 pi rho nu u^2 r^4 (1/r^3 - 1/R^3).
    Monaghan's linear viscosity is nu = a c h/10 in three dimensions, half of it where only one half of the pairs approach.
    """
    volume, dr = R**3 - r**3, 1e-3
    K = 2 * np.pi * rho * u * u * r**4 * (1 / r - 1 / R)
    while K > 0:
        R = np.cbrt(r**3 + volume)
        u = np.sqrt(K / (2 * np.pi * rho * r**4 * (1 / r - 1 / R)))
        K -= dr * (8 * np.pi * Y * r * r * np.log(R / r) + 16 * np.pi * rho * nu * u * r**4 * (1 / r**3 - 1 / R**3))
        r -= dr
    return r


def taylor(lmp, folder, dx, words="viscosity 1 2", root=ROOT, h=1.2, V=227.0, L=32.4e-3, R=3.2e-3, t_end=80e-6,
           kernel="cubic", laws=None, quarter=False, courant=0.2, skin=0.3, variable=False):
    """two cylinders meet, each the mirror image of the other: the rigid wall without friction

    laws: sections of a material file in place of Cu-OFHC.hvi; quarter: of each, between mirrors; skin in spacings
    """
    q = dx * (np.arange(-int(R / dx) - 1, int(R / dx) + 1) + 0.5)
    z = dx * (np.arange(int(round(L / dx))) + 0.5)
    half = np.stack(np.meshgrid(z, q, q, indexing="ij"), -1).reshape(-1, 3)
    half = half[((half[:, 1] ** 2 + half[:, 2] ** 2) < R * R) & ((half[:, 1:] > 0).all(1) | (not quarter))]
    n = len(half)
    x = np.concatenate([half, half * [-1, 1, 1]])
    box = np.array([2.2 * L, 8 * R, 8 * R])
    center = box / 2 * ([1, 0, 0] if quarter else 1)
    s = Fluid(x + center, np.zeros((2 * n, 3)), np.full(2 * n, 8930.0), np.zeros(2 * n), np.repeat([1, 2], n), {1: 8930 * dx**3, 2: 8930 * dx**3},
              {1: h * dx, 2: h * dx}, box, (False,) * 3)
    s.v[:, 0] = np.repeat([-V, V], n)
    path = material(folder / "Cu.hvi", *laws, units="si") if laws else f"{root}/potentials/Cu-OFHC.hvi"
    how = f"h {'variable' if variable else 'constant'} {'mirror y 0 lo mirror z 0 lo' if quarter else ''}"
    pair = f"pair_style hvi/sph {kernel} form sum {words} {how}\npair_coeff * * file {path} h {h * dx}\n"
    start = time.time()
    steps = int(t_end / (courant * h * dx / 5500))
    r = run(lmp, folder, s, pair, "damage no spall none", steps, dt=t_end / steps, frames=steps, units="si", lost="ignore", skin=skin)
    y = r.frames[-1]["x"][:n] - center if len(r.frames[-1]["x"]) == 2 * n else np.full((n, 3), np.nan)
    rad = np.sqrt(y[:, 1] ** 2 + y[:, 2] ** 2)
    foot = rad[-y[:, 0] < 1e-3] if y[:, 0].mean() < 0 else rad[y[:, 0] < 1e-3]  # of a disc, from its second moment; and the outermost particle
    t = r.thermo
    return dict(spacing=1e3 * dx, words=words, particles=2 * n, steps=steps, seconds=time.time() - start,
                length=1e3 * (y[:, 0].max() - y[:, 0].min() + dx), foot=1e3 * np.sqrt(2 * (foot**2).mean()), widest=1e3 * rad.max(),
                drift=np.abs(t["c_book[9]"] - 1).max(), momentum=max(momentum_error(t)) / (s.m @ np.abs(s.v[:, 0])),
                speed=np.abs(r.frames[-1]["v"]).max() / V)
