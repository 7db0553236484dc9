"""Scenes that tell what faces of solids bear: waves along and across walls, a block that spins free, mirrors, contacts, Verney's cylinder.

Each runs once (or twice, to compare) and returns a dict of numbers; ratios are those to theory. Walls lie in x and y, n layers of a cubic lattice
of spacing 1 through the thickness n, uniform along y (a periodic box of one particle), so that the theory is that of plane strain.
Waves are linear: strains of 1e-5 to 1e-4.
"""

import time

import numpy as np
from scipy.optimize import brentq, least_squares
from solid_runs import consistency, crossings, material, momentum_error, run
from sph_scenes import Fluid

RHO, K, G = 1.0, 16.0, 6.0  # E = 16, nu = 1/3
E, NU = 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G)
CL, CT, CP = np.sqrt((K + 4 / 3 * G) / RHO), np.sqrt(G / RHO), np.sqrt(E / RHO / (1 - NU**2))  # longitudinal, shear, along a plate
ELASTIC = ("eos linear rho0 1 K 16", "strength perfect G 6 Y 1000")
JC = "strength perfect damage no spall none"
COURANT = 0.2


# theory


def lamb(k, d, bending):
    """the lowest frequency of a free plate of thickness d at the wave number k: Rayleigh-Lamb, plane strain

    With p^2 = w^2/c_l^2 - k^2, q^2 = w^2/c_t^2 - k^2, b = d/2: (q^2 - k^2)^2 cos(pb) sin(qb) + 4 k^2 p q sin(pb) cos(qb) = 0 for waves along
    the plate, with sin and cos exchanged for bending; p imaginary. Both to the limits c_plate k and c_plate d k^2/sqrt(12).
    """
    b = 0.5 * d

    def f(w):
        p, q = np.sqrt(complex(w**2 / CL**2 - k**2)), np.sqrt(complex(w**2 / CT**2 - k**2))
        if bending:  # divided by p q, so that it is real
            return ((q**2 - k**2) ** 2 * np.sin(p * b) / p * np.cos(q * b) + 4 * k**2 * q * np.sin(q * b) * np.cos(p * b)).real
        return ((q**2 - k**2) ** 2 * np.sin(q * b) / q * np.cos(p * b) + 4 * k**2 * p * np.sin(p * b) * np.cos(q * b)).real

    w = CP * d * k**2 / np.sqrt(12) if bending else CP * k
    return brentq(f, 0.8 * w, 1.02 * w, xtol=1e-14 * w, rtol=1e-14)


def ring(t, y, guess):
    """y(t) = Re A exp((i w - g) t): complex A, w, g, and what is left of it, rms in units of |A|; w is looked for from 0.3 to 1.7 of the guess"""

    def basis(w, g):
        return np.exp(-g * t)[:, None] * np.stack([np.cos(w * t), -np.sin(w * t)], 1)

    def rest(p):
        b = basis(p[0] * guess, p[1] * guess)
        return y - b @ np.linalg.lstsq(b, y, rcond=None)[0]

    scan = np.linspace(0.3, 1.7, 141)
    p = least_squares(rest, [min(scan, key=lambda w: (rest((w, 0.0)) ** 2).sum()), 0.0], xtol=1e-14, ftol=1e-14, gtol=1e-14).x
    b = basis(p[0] * guess, p[1] * guess)
    a = np.linalg.lstsq(b, y, rcond=None)[0]
    return complex(*a), p[0] * guess, p[1] * guess, np.sqrt((rest(p) ** 2).mean()) / np.hypot(*a)


# scenes


def wall(length, layers, h, width=1, ends=True, margin=4.0):
    """particles of a wall, middle of the thickness at z = 0 (the box is not); ends: periodic along x; layers 0: no faces, 4 particles across a
    periodic box"""
    nz = layers or 4
    x = np.stack(np.meshgrid(np.arange(length), np.arange(width), np.arange(nz), indexing="ij"), -1).reshape(-1, 3) + 0.5
    shift = np.array([0.0 if ends else margin, 0.0, margin if layers else 0.0])
    n = len(x)
    s = Fluid(x + shift, np.zeros((n, 3)), np.full(n, RHO), np.zeros(n), np.ones(n, int), {1: RHO}, {1: h},
              np.array([length, width, nz]) + 2 * shift, (ends, True, not layers))
    return s, x - [0, 0, 0.5 * nz]


def go(lmp, folder, s, words, kernel, h, t_end, frames, name, pair="", **how):
    """runs to t_end; about so many frames. Result, steps, seconds"""
    path = material(folder / "elastic.hvi", *ELASTIC)
    every = int(np.ceil(t_end / frames / (COURANT * h / CL)))
    steps = every * frames
    text = f"pair_style hvi/sph {kernel} dim {s.dim} form sum {words} h constant\npair_coeff * * file {path} h {h:.17g}\n{pair}"
    start = time.time()
    r = run(lmp, folder, s, text, JC, steps, dt=t_end / steps, frames=every, name=name, skin=how.pop("skin", 0.1), **how)
    return r, steps, time.time() - start


def head(first, words, kernel, h, s, steps, seconds):
    return dict(first, kernel=kernel, h=h, words=words, particles=len(s.x), steps=steps, seconds=seconds)


def books(r):
    return dict(drift=np.abs(r.thermo["c_book[9]"] - 1).max(), momentum=max(momentum_error(r.thermo)))


def standing(lmp, folder, layers, words, kernel, h, length, shear, amplitude=1e-4, width=1, name="w"):
    """a standing wave in the plane of a wall, v = A sin(k x) along x, or y for shear, a period of it

    Momentum, rho dv/dt = b d(sigma)/dx, and the law, d(sigma)/dt = l M dv/dx with the modulus M of theory: b is the part of their stress that
    the particles bear, l that of the stress they should have; w^2 = b l w_0^2.
    """
    s, x = wall(length, layers, h, width)
    k = 2 * np.pi / length
    if shear:
        w0, modulus = CT * k, G
        s.v[:, 1] = amplitude * CT * np.sin(k * x[:, 0])
    else:
        w0 = lamb(k, layers, False) if layers else CL * k
        modulus = RHO * (w0 / k) ** 2
        s.v[:, 0] = amplitude * CL * np.sin(k * x[:, 0])
        if layers:  # it gets thinner as it is stretched
            s.v[:, 2] = -NU / (1 - NU) * amplitude * CL * k * x[:, 2] * np.cos(k * x[:, 0])
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, 2 * np.pi / w0, 50, name)
    t = np.array([f["time"] for f in r.frames])
    v = 2 * np.array([f["v"][:, int(shear)] @ np.sin(k * x[:, 0]) for f in r.frames]) / len(x)
    stress = 2 * np.array([f["sxy" if shear else "sxx"] @ np.cos(k * x[:, 0]) for f in r.frames]) / len(x)
    a, w, g, off = ring(t, v, w0)
    sa, sw, sg, _ = ring(t, stress, w0)
    borne = RHO * abs(complex(-g, w)) * abs(a) / (k * abs(sa))
    return r, s, steps, seconds, dict(borne=borne, law=abs(complex(-sg, sw)) * abs(sa) / (modulus * k * abs(a)), stiffness=(w / w0) ** 2,
                                      speed=w / w0, loss=1 - np.exp(-2 * np.pi * g / w), misfit=off)


def borne(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=200, width=1):
    """a wall of so many layers, 0: bulk, with a long standing wave in its plane: the part of stress that is borne, the law's part of stress,
    and what they give together, as a factor of stiffness and of speed; the last two for shear, too"""
    r, s, steps, seconds, o = standing(lmp, folder, layers, words, kernel, h, length, False, width=width)
    q, _, more, time_, p = standing(lmp, folder, layers, words, kernel, h, length, True, width=width)
    return dict(head(dict(layers=layers), words, kernel, h, s, steps + more, seconds + time_), **o, shear_borne=p["borne"], shear_law=p["law"],
                shear_speed=p["speed"], shear_misfit=p["misfit"], drift=max(books(r)["drift"], books(q)["drift"]))


def bending(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, slender=20, width=1):
    """a standing bending wave of a wall, as long as 20 thicknesses, for a period, against Rayleigh-Lamb; a lattice of n layers with all its
    stress has sqrt(1 - 1/n^2) of the frequency, since it has that of its layers in their middles"""
    length = slender * layers
    s, x = wall(length, layers, h, width)
    k = 2 * np.pi / length
    w0 = lamb(k, layers, True)
    up = 1e-3 * w0  # it moves by 1e-3 spacings
    s.v[:, 2] = up * np.sin(k * x[:, 0])
    s.v[:, 0] = -up * k * x[:, 2] * np.cos(k * x[:, 0])
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, 2 * np.pi / w0, 50, "b")
    t = np.array([f["time"] for f in r.frames])
    v = 2 * np.array([f["v"][:, 2] @ np.sin(k * x[:, 0]) for f in r.frames]) / len(x)
    a, w, g, off = ring(t, v, w0)
    return dict(head(dict(layers=layers), words, kernel, h, s, steps, seconds), frequency=w / w0, lattice=np.sqrt(1 - 1 / layers**2),
                loss=1 - np.exp(-2 * np.pi * g / w), misfit=off, drift=books(r)["drift"])
