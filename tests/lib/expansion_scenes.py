"""Bodies that expand at a constant rate until they break, as Mott and Grady think of fragmentation: a bar held sideways, a ring."""

import re

import hvi
import numpy as np
from scipy.special import gamma
from solid_runs import row, run
from sph_scenes import Fluid

RHO, C0, CL = 2703.0, 5240.0, 6400.0  # of Al6061-T6.hvi
ENERGY = 1.2e9 * 0.075 / 2  # sigma phi_c/2: what fragsize takes for it
KINDS = 8  # strengths that a body of scattered strength is made of


def grady(rate):
    """size of fragments, m: fragsize of compute hvi/atom"""
    return np.sqrt(8 * ENERGY / RHO) / rate


def materials(folder, root, modulus):
    """files of 6061-T6 with the strengths of KINDS equal shares of a Weibull distribution of mean 1; one file without scatter"""
    text = (root / "potentials" / "Al6061-T6.hvi").read_text()
    u = (np.arange(KINDS) + 0.5) / KINDS if modulus else np.array([])
    factors = (-np.log(u)) ** (1 / modulus) / gamma(1 + 1 / modulus) if modulus else np.ones(1)
    for k, factor in enumerate(factors):
        changed, n = re.subn(r"(spall voids\n  sigma +)1.2e9", lambda m: m[1] + f"{1.2e9 * factor:.17g}", text)
        assert n == 1, k
        (folder / f"metal{k + 1}.hvi").write_text(changed)
    return len(factors)


def pair_lines(kinds, style, h):
    lines = f"pair_style hvi/sph {style}\n" + "".join(f"pair_coeff {k} {k} file metal{k}.hvi h {h:.17g}\n" for k in range(1, kinds + 1))
    return lines + "".join(f"pair_coeff {i} {j} tension yes\n" for i in range(1, kinds + 1) for j in range(i + 1, kinds + 1))


def count(result, frame):
    """number of sound pieces, by a distance of 1.5 spacings, particles that have failed left out; mask of those"""
    columns = {"id": frame["id"], **{a: frame["x"][:, k] for k, a in enumerate("xyz")}, **{"v" + a: frame["v"][:, k] for k, a in enumerate("xyz")},
               "mass": np.ones(len(frame["id"]))}
    failed = (frame["spalled"] > 0) | (frame["damage"] >= 1)
    return len(hvi.find(hvi.Frame(columns), distance=1.5 * result.dx, where=~failed).table), failed


def bar(lmp, root, folder, rate, across, fragments=24, modulus=20.0, seed=1, grains=None, strain=0.4, eta=1.5, style="cubic dim 1 dissipation riemann", name="bar"):
    """a bar as long as that many of Grady's fragments, that many particles in each, stretched from rest with v = rate x; held sideways

    eta: h in spacings; rows with 1.2 clump in tension, see Howto_sph
    """
    n = across * fragments
    dx = grady(rate) / across
    s = row(n * dx, n, margin=1.2 * strain * n * dx, rho=RHO)
    s.v[:, 0] = rate * (s.x[:, 0] - 0.5 * s.box[0])
    kinds = materials(folder, root, modulus)
    grains = across if grains is None else grains
    s.type = np.repeat(np.random.default_rng(seed).integers(1, kinds + 1, fragments * grains), across // grains)
    s.mass, s.h = {k: RHO * dx for k in range(1, kinds + 1)}, {k: 1.2 * dx for k in range(1, kinds + 1)}  # run() takes the spacing from it
    dt = 0.3 * dx / CL
    steps = int(strain / rate / dt)
    r = run(lmp, folder, s, pair_lines(kinds, style, eta * dx), "damage no spall voids", steps, dt=dt, frames=steps, units="si", name=name)
    r.dx = dx
    return r, r.frames[-1]


def ring(lmp, root, folder, rate, dx=0.25e-3, radius=20e-3, layers=4, modulus=20.0, seed=1, strain=0.8, words="damage no spall voids",
         style="cubic dim 2 dissipation riemann", eta=1.5, frames=8, name="ring"):
    """a ring in plane strain, thin against its radius, that expands at one radial speed, rate times its radius; faces free"""
    around = int(round(2 * np.pi * radius / dx))
    edges = np.sqrt(radius**2 + 2 * radius * layers * dx * (np.arange(layers + 1) / layers - 0.5))  # layers of one area
    r = 0.5 * (edges[1:] + edges[:-1])
    phi = 2 * np.pi * (np.arange(around) + 0.5) / around
    x = np.stack([np.outer(r, np.cos(phi)), np.outer(r, np.sin(phi)), np.zeros((layers, around))], -1).reshape(-1, 3)
    n, half = len(x), (2 + strain) * radius
    kinds = materials(folder, root, modulus)
    kind = np.random.default_rng(seed).integers(1, kinds + 1, n)
    m = RHO * np.pi * (edges[-1] ** 2 - edges[0] ** 2) / n
    s = Fluid(x + [half, half, 0], rate * radius * x / np.linalg.norm(x, axis=1)[:, None], np.full(n, RHO), np.zeros(n), kind, {k: m for k in range(1, kinds + 1)},
              {k: 1.2 * dx for k in range(1, kinds + 1)}, np.array([2 * half, 2 * half, 20 * dx]), (False, False, True), 2)
    dt = 0.3 * dx / CL
    steps = int(strain / rate / dt)
    result = run(lmp, folder, s, pair_lines(kinds, style, eta * dx), words, steps, dt=dt, frames=max(steps // frames, 1), units="si", name=name)
    result.dx = dx
    return result, result.frames[-1]
