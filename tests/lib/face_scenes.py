"""Scenes that tell what faces of solids bear: waves along and across walls, a block that spins free, mirrors, contacts, Verney's cylinder.

Each runs once (or twice, to compare) and returns a dict of numbers; ratios are those to theory. Walls lie in x and y, n layers of a cubic lattice
of spacing 1 through the thickness n, uniform along y (a periodic box of one particle), so that the theory is that of plane strain.
Waves are linear: strains of 1e-5 to 1e-4.
"""

import time

import numpy as np
from scipy.optimize import brentq, least_squares
from solid_runs import crossings, material, momentum_error, run
from sph_scenes import SUPPORT, Fluid, shape

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


def levers(kernel, h, layers):
    """the frequency of bending by a gradient that is exact for linear fields only, forces being the adjoint, in units of the exact one

    v_x = z x has the gradient z in x; the corrected sum has sum(w_ij z_j)/sum(w_ij) with w_ij = -V x_ij dW/dx: near a face that is farther
    inside. The layers bend with these levers, and their forces have them again.
    """
    z, grid = np.arange(layers) - 0.5 * (layers - 1), np.arange(-int(SUPPORT[kernel] * h) - 1, int(SUPPORT[kernel] * h) + 2)
    x, y, zj, zi = np.meshgrid(grid, grid, z, z, indexing="ij")
    r = np.sqrt(x**2 + y**2 + (zj - zi) ** 2)
    w = -(x**2) * shape(kernel, r / h)[1] / np.maximum(r, 1e-300) * (r > 0) * (r < SUPPORT[kernel] * h)
    lever = (w * zj).sum((0, 1, 2)) / w.sum((0, 1, 2))
    return np.sqrt(12 * (lever**2).sum() / layers**3)


# scenes


def wall(length, layers, h, width=1, ends=True, margin=4.0, turned=False):
    """particles of a wall, middle of the thickness at z = 0 (the box is not); ends: periodic along x; layers 0: no faces, 4 particles across a
    periodic box; turned: the lattice by atan(1/2) about y, so that faces are stairs, as at the rim of a crater (thickness and length nearly those)"""
    nz = layers or 4
    if turned:
        a = np.sqrt(5)
        nz, length = round(nz * a) / a, round(length / a) * a
        x = lattice(round(length / a), 1, round(nz * a)) * [a, 1, 1 / a]
        x[:, 0] -= 0.5 * a - (-2 * np.floor(x[:, 2] * a) % 5 + 0.5) / a
    else:
        x = lattice(length, width, nz)
    shift = np.array([0.0 if ends else margin, 0.0, margin if layers else 0.0])
    n = len(x)
    s = Fluid(x + shift, np.zeros((n, 3)), np.full(n, RHO), np.zeros(n), np.ones(n, int), {1: RHO}, {1: h},
              np.array([length, width, nz]) + 2 * shift, (ends, True, not layers))
    return s, x - [0, 0, 0.5 * nz]


def lattice(*counts):
    return np.stack(np.meshgrid(*[np.arange(n) for n in counts], indexing="ij"), -1).reshape(-1, len(counts)) + 0.5


def go(lmp, folder, s, words, kernel, h, t_end, frames, name, pair="", jc=JC, courant=None, **how):
    """runs to t_end; about so many frames. Result, steps, seconds"""
    path = material(folder / "elastic.hvi", *ELASTIC)
    every = int(np.ceil(t_end / frames / ((courant or COURANT) * h / CL)))
    steps = every * frames
    text = f"pair_style hvi/sph {kernel} dim {s.dim} form sum {words} h constant\npair_coeff * * file {path} h {h:.17g}\n{pair}"
    start = time.time()
    r = run(lmp, folder, s, text, jc, steps, dt=t_end / steps, frames=every, name=name, skin=how.pop("skin", 0.1), **how)
    return r, steps, time.time() - start


def head(first, words, kernel, h, s, steps, seconds):
    return dict(first, kernel=kernel, h=h, words=words, particles=len(s.x), steps=steps, seconds=seconds)


def books(r):
    return dict(drift=np.abs(r.thermo["c_book[9]"] - 1).max(), momentum=max(momentum_error(r.thermo)))


def standing(lmp, folder, layers, words, kernel, h, length, shear, amplitude=1e-4, width=1, turned=False, rubble=0, name="w", **how):
    """a standing wave in the plane of a wall, v = A sin(k x) along x, or y for shear, a period of it

    Momentum, rho dv/dt = b d(sigma)/dx, and the law, d(sigma)/dt = l M dv/dx with the modulus M of theory: b is the part of their stress that
    the particles bear, l that of the stress they should have; w^2 = b l w_0^2. noise: rms of what stress differs from the wave, where it is largest.
    """
    s, x = wall(length, layers + 2 * rubble, h, width, turned=turned)
    k, pair, jc = 2 * np.pi / s.box[0], "", JC
    sound = (np.abs(x[:, 2]) < 0.5 * layers) | (rubble == 0)
    if rubble:
        s.type, s.mass, s.h, jc = np.where(sound, 1, 2), {1: RHO, 2: RHO}, {1: h, 2: h}, "strength perfect damage yes spall none"
        for name_, Y, eps in (("sound", 1e3, 1e3), ("rubble", 1e-15, 1e-15)):
            material(folder / f"{name_}.hvi", ELASTIC[0], f"strength perfect G 6 Y {Y}",
                     f"damage johnson-cook D1 {eps} D2 0 D3 0 D4 0 D5 0 epsdot0 1")
        pair = f"pair_coeff 1 1 file {folder}/sound.hvi h {h:.17g}\npair_coeff 2 2 file {folder}/rubble.hvi h {h:.17g}\npair_coeff 1 2 tension yes\n"
    if shear:
        w0, modulus = CT * k, G
        s.v[:, 1] = amplitude * CT * np.sin(k * x[:, 0])
    else:
        w0 = lamb(k, sound.sum() / (s.box[0] * width), False) if layers else CL * k
        modulus = RHO * (w0 / k) ** 2
        s.v[:, 0] = amplitude * CL * np.sin(k * x[:, 0])
        if layers:  # it gets thinner as it is stretched
            s.v[:, 2] = -NU / (1 - NU) * amplitude * CL * k * x[:, 2] * np.cos(k * x[:, 0])
    s.v[~sound] = 0.0
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, 2 * np.pi / w0, 50, name, pair, jc, **how)
    t, x = np.array([f["time"] for f in r.frames]), x[sound]
    v = 2 * np.array([f["v"][sound, int(shear)] @ np.sin(k * x[:, 0]) for f in r.frames]) / len(x)
    sigma = np.array([f["sxy" if shear else "sxx"][sound] for f in r.frames])
    stress = 2 * sigma @ np.cos(k * x[:, 0]) / len(x)
    a, w, g, off = ring(t, v, w0)
    sa, sw, sg, _ = ring(t, stress, w0)
    borne = RHO * abs(complex(-g, w)) * abs(a) / (k * abs(sa))
    top = np.argmax(np.abs(stress))
    noise = np.sqrt(2 * ((sigma[top] - stress[top] * np.cos(k * x[:, 0])) ** 2).mean()) / abs(stress[top])
    return r, s, steps, seconds, dict(borne=borne, law=abs(complex(-sg, sw)) * abs(sa) / (modulus * k * abs(a)), stiffness=(w / w0) ** 2,
                                      speed=w / w0, loss=1 - np.exp(-2 * np.pi * g / w), noise=noise, misfit=off)


def borne(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=200, width=1, turned=False, **how):
    """a wall of so many layers, 0: bulk, with a long standing wave in its plane: the part of stress that is borne, the law's part of stress,
    and what they give together, as a factor of stiffness and of speed; the last two for shear, too"""
    r, s, steps, seconds, o = standing(lmp, folder, layers, words, kernel, h, length, False, width=width, turned=turned, **how)
    q, _, more, time_, p = standing(lmp, folder, layers, words, kernel, h, length, True, width=width, turned=turned, **how)
    return dict(head(dict(layers=layers), words, kernel, h, s, steps + more, seconds + time_), **o, shear_borne=p["borne"], shear_law=p["law"],
                shear_speed=p["speed"], shear_noise=p["noise"], shear_misfit=p["misfit"], drift=max(books(r)["drift"], books(q)["drift"]))


def rubble(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=200, failed=2):
    """the sound layers swing between others that have failed and are at rest: these bear neither tension nor shear, and are free to get out of the
    way of pressure, so that the sound wall swings as if it were alone, but for some kernels' viscosity

    Rms of what its velocity differs from that wave over a period, and the largest wave in the failed ones, both as parts of the first velocity;
    and how far the failed ones are thrown off, in units of how far the sound ones swing.
    """
    r, s, steps, seconds, _ = standing(lmp, folder, layers, words, kernel, h, length, False, rubble=failed)
    k, t = 2 * np.pi / length, np.array([f["time"] for f in r.frames])
    w0 = lamb(k, layers, False)
    shape = np.sin(k * s.x[:, 0])
    sound, other = (2 * np.array([f["v"][q, 0] @ shape[q] for f in r.frames]) / q.sum() for q in (s.type == 1, s.type == 2))
    A = sound[0]
    off = np.abs(r.frames[-1]["x"] - s.x)[s.type == 2, 2].max() * w0 / A
    return dict(head(dict(layers=layers), words, kernel, h, s, steps, seconds), miss=np.sqrt(((sound / A - np.cos(w0 * t)) ** 2).mean()),
                dragged=np.abs(other).max() / A, thrown=off, failed=(r.frames[-1]["damage"] >= 1)[s.type == 2].mean(), **books(r))


def stairs(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, **more):
    """as *borne*, for a wall out of a lattice that is turned: its faces are stairs"""
    return borne(lmp, folder, layers, words, kernel, h, turned=True, **more)


def bending(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, slender=20, width=1, **how):
    """a standing bending wave of a wall, as long as 20 thicknesses, for a period, against Rayleigh-Lamb; a lattice of n layers with all its
    stress has sqrt(1 - 1/n^2) of the frequency, since it has that of its layers in their middles, and with
    a gradient that is exact for linear fields only that of levers()"""
    length = slender * layers
    s, x = wall(length, layers, h, width)
    k = 2 * np.pi / length
    w0 = lamb(k, layers, True)
    up = 1e-3 * w0  # it moves by 1e-3 spacings
    s.v[:, 2] = up * np.sin(k * x[:, 0])
    s.v[:, 0] = -up * k * x[:, 2] * np.cos(k * x[:, 0])
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, 2 * np.pi / w0, 50, "b", **how)
    t = np.array([f["time"] for f in r.frames])
    v = 2 * np.array([f["v"][:, 2] @ np.sin(k * x[:, 0]) for f in r.frames]) / len(x)
    a, w, g, off = ring(t, v, w0)
    return dict(head(dict(layers=layers), words, kernel, h, s, steps, seconds), frequency=w / w0, lattice=np.sqrt(1 - 1 / layers**2),
                levers=levers(kernel, h, layers), loss=1 - np.exp(-2 * np.pi * g / w), misfit=off, drift=books(r)["drift"])


def wave(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=300, wide=15.0, **how):
    """a pulse runs along a wall from its free end: speed of the middle of its momentum, which dispersion leaves alone, and of its front, at half of
    its height; between 0.3 and 0.7 of the length; and L1 at the end against the pulse that a string carries, in units of what that has"""
    s, x = wall(length, layers, h, ends=False)
    A = 1e-4 * CL
    s.v[:, 0] = A * np.exp(-0.5 * (x[:, 0] / wide) ** 2)
    if layers:
        s.v[:, 2] = NU / (1 - NU) * x[:, 2] * x[:, 0] / wide**2 * s.v[:, 0]
    c = CP if layers else CL
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, 0.8 * length / c, 40, "p", **how)
    t = np.array([f["time"] for f in r.frames])
    columns = np.array([f["v"][:, 0].reshape(length, -1).mean(1) for f in r.frames])
    place = x[:, 0].reshape(length, -1)[:, 0]
    middle = columns @ place / columns.sum(1)
    front = np.array([(crossings(place, u, 0.5 * u.max()) if u.max() > 0 else [np.nan])[-1] for u in columns])
    tail = 0.5 * (front.max() - 6 * wide)
    string = 0.5 * A * sum(np.exp(-0.5 * ((place - sign * c * t[-1]) / wide) ** 2) for sign in (1, -1))

    def speed(y):
        k = (y > 0.3 * length) & (y < 0.7 * length)
        return np.polyfit(t[k], y[k], 1)[0] / c if k.sum() > 4 else np.nan

    return dict(head(dict(layers=layers), words, kernel, h, s, steps, seconds), speed=speed(middle), front=speed(front),
                height=columns[-1].max() / columns[0].max(), l1=np.abs(columns[-1] - string).sum() / string.sum(),
                noise=np.abs(columns[-1][place < max(tail, 1)]).max() / A, **books(r))


def block(counts, apart=0.0):
    """particles of a block around the origin"""
    return np.pad(lattice(*counts) - 0.5 * np.array(counts), ((0, 0), (0, 3 - len(counts))))


def spinning(lmp, folder, n, words="viscosity 0.1 0", kernel="wendland2", h=1.6, dim=2, speed=0.05, turns=10.0):
    """a square of n by n particles (dim 3: a cube) is set spinning, its corners at a part of the longitudinal speed of sound

    Angular momentum, kinetic energy and the angle at the end, in units of those of a rigid body; the worst place, less the best rotation, on the
    way and at the end, in spacings. (Spin stretches it, by rho v^2/E, and the start is sudden: it pulses.)
    """
    d = block([n] * dim)
    k = len(d)
    R = 0.5 * (n - 1) * np.sqrt(2)
    w = speed * CL / R
    box = np.full(3, 3.0 * n)
    if dim == 2:
        box[2] = 1.0
    s = Fluid(d + 0.5 * box * [1, 1, dim == 3], np.cross([0, 0, w], d), np.full(k, RHO), np.zeros(k), np.ones(k, int), {1: RHO}, {1: h}, box,
              (False, False, dim == 2), dim)
    t_end = turns * 2 * np.pi / w
    r, steps, seconds = go(lmp, folder, s, words, kernel, h, t_end, 100, "s", skin=0.3, lost="ignore")
    J, kinetic, shape, angle = [], [], [], [0.0]
    for f in r.frames:
        if len(f["x"]) < k:
            J.append(np.nan)
            break
        x, v = f["x"] - f["x"].mean(0), f["v"]
        J.append(np.cross(x, v)[:, 2].sum())
        kinetic.append((v**2).sum())
        c, q = (x[:, :2] * d[:, :2]).sum(), (x[:, 1] * d[:, 0] - x[:, 0] * d[:, 1]).sum()
        a = np.arctan2(q, c)
        angle.append(angle[-1] + (a - angle[-1] + np.pi) % (2 * np.pi) - np.pi)
        turned = np.stack([np.cos(a) * d[:, 0] - np.sin(a) * d[:, 1], np.sin(a) * d[:, 0] + np.cos(a) * d[:, 1], d[:, 2]], 1)
        shape.append(np.sqrt(((x - turned) ** 2).sum(1).max()))
    J, kinetic = np.array(J) / J[0], np.array(kinetic) / kinetic[0]
    return dict(head(dict(across=n), words, kernel, h, s, steps, seconds), dim=dim, spin=J[-1], worst=np.abs(J - 1).max(), kinetic=kinetic[-1],
                turned=angle[-1] / (2 * np.pi * turns), shape=max(shape), shape_end=shape[-1], **books(r))


def spinning_cube(lmp, folder, n, words="viscosity 0.1 0", kernel="wendland2", h=1.6, **more):
    return spinning(lmp, folder, n, words, kernel, h, dim=3, **more)


def mirror_face(lmp, folder, n, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=40):
    """a bar of n by n particles, free all around, with pulses from both ends that meet in its middle; and an eighth of it with three mirrors:
    largest difference of velocity and of stress, in units of those of the pulse, at all times"""
    A, t_end = 1e-4 * CL, 2 * length / CL
    out, steps, seconds = [], 0, 0.0
    for eighth in (False, True):
        x = block([length, n, n])
        if eighth:
            x = x[(x > 0).all(1)]
        k = len(x)
        box = np.array([length, n, n]) + 8.0
        low = 0.0 if eighth else 0.5 * box
        s = Fluid(x + low, np.zeros((k, 3)), np.full(k, RHO), np.zeros(k), np.ones(k, int), {1: RHO}, {1: h}, box, (False,) * 3)
        s.v[:, 0] = -A * np.sign(x[:, 0]) * np.exp(-0.5 * ((np.abs(x[:, 0]) - 0.5 * length) / 5) ** 2)
        mirrors = " ".join(f"mirror {a} 0 lo" for a in "xyz") if eighth else ""
        r, more, sec = go(lmp, folder, s, f"{words} {mirrors}", kernel, h, t_end, 20, "m", skin=0.3)
        out.append((x, r))
        steps, seconds = steps + more, seconds + sec
    (x, whole), (_, part) = out
    here = (x > 0).all(1)
    v = max(np.abs(a["v"][here] - b["v"]).max() for a, b in zip(whole.frames, part.frames)) / A
    sigma = max(np.abs(a[c][here] - b[c]).max() for a, b in zip(whole.frames, part.frames) for c in ("sxx", "syy", "szz", "sxy")) / (RHO * CL * A)
    size = max(np.abs(f["v"]).max() for f in whole.frames) / A
    return dict(head(dict(across=n), words, kernel, h, s, steps, seconds), velocity=v, stress=sigma, largest=size, **books(part))


def contact(lmp, folder, layers, words="viscosity 0.1 0", kernel="wendland2", h=1.6, length=300, wide=10.0):
    """a pulse of pressure along a wall (layers 0: bulk) meets a contact of two bodies, against the same wall in one piece

    Behind it: its momentum and height in units of those without contact, and by how many spacings it is late; before it what came back, and how
    much neighbors differ there, as parts of the height.
    """
    s, x = wall(length, layers, h, ends=False)
    s.type = np.where(x[:, 0] < 0.5 * length, 1, 2)
    s.mass, s.h = {1: RHO, 2: RHO}, {1: h, 2: h}
    shape = np.exp(-0.5 * ((x[:, 0] - 0.3 * length) / wide) ** 2)
    A, c, out = 1e-4 * CL, CP if layers else CL, []
    s.v[:, 0] = A * shape
    if layers:
        s.v[:, 2] = NU / (1 - NU) * x[:, 2] * (x[:, 0] - 0.3 * length) / wide**2 * s.v[:, 0]
    for joined in (True, False):
        r, steps, seconds = go(lmp, folder, s, words, kernel, h, 0.4 * length / c, 10, "c", pair="pair_coeff 1 2 tension yes\n" if joined else "")
        out.append((r.frames[-1]["v"][:, 0].reshape(length, -1).mean(1), books(r), seconds))
    (u1, _, first), (u, book, seconds) = out
    X = x[:, 0].reshape(length, -1)[:, 0]
    behind, near = X > 0.5 * length, (X > 0.2 * length) & (X < 0.5 * length)

    def middle(a):
        return (X * a)[behind].sum() / a[behind].sum()

    top = u1[behind].max()
    return dict(head(dict(layers=layers), words, kernel, h, s, 2 * steps, first + seconds), passed=u[behind].sum() / u1[behind].sum(),
                height=u[behind].max() / top, late=middle(u1) - middle(u), back=np.abs(u - u1)[near].max() / top,
                noise=np.abs(np.diff((u - u1)[near])).max() / top, **book)


def verney_cylinder(lmp, folder, dx, words="viscosity 0.1 0.5", h=1.2, kernel="cubic", stop=4.0, t_end=170.0, courant=None, skin=0.3):
    """Verney's shell as a cylinder: beryllium (cm, g, us, Mbar), from 8 to 10, plane strain, stops at the inner radius 4

    Incompressible: v = u r/x at the radius x, r the inner one, R^2 - r^2 stays; D = diag(-1, 1) v/x in the plane, D_zz = 0, so that the rate of
    plastic strain is sqrt(2/3 D:D) = 2/sqrt(3) v/x. Per length: kinetic energy pi rho u^2 r^2 ln(R/r), plastic work in dt = dr/u the integral
    of Y 2/sqrt(3) u r/x^2 2 pi x dx, which is 4 pi/sqrt(3) Y r ln(R/r) dr. Monaghan's linear viscosity is nu = a c h/8 in two dimensions,
    half of it where one half of the pairs approach: 2 rho nu D:D = 4 rho nu v^2/x^2, 4 pi rho nu u r^2 (1/r^2 - 1/R^2) dr.
    """
    rho, Y = 1.845, 0.0033
    u0 = np.sqrt(plastic(stop) * Y / (rho * np.pi * 64 * np.log(10 / 8)))
    path = material(folder / "Be.hvi", "eos gruneisen rho0 1.845 C 0.7998 S1 1.124 g0 1.11 a 0.16 T0 300", "strength perfect G 1.510 Y 0.0033")
    k = int(np.ceil(10 / dx))
    x = dx * block([2 * k] * 2)
    r0 = np.sqrt((x**2).sum(1))
    x, r0 = x[(r0 > 8) & (r0 < 10)], r0[(r0 > 8) & (r0 < 10)]
    n = len(x)
    s = Fluid(x + [12, 12, 0], -u0 * 8 / r0[:, None] ** 2 * x, np.full(n, rho), np.zeros(n), np.ones(n, int), {1: rho * dx**2}, {1: h * dx},
              np.array([24.0, 24.0, 20 * dx]), (False, False, True), 2)
    steps = int(t_end / ((courant or COURANT) * h * dx / 1.35))
    pair = f"pair_style hvi/sph {kernel} dim 2 form sum {words} h constant\npair_coeff 1 1 file {path} h {h * dx}\n"
    start = time.time()
    r = run(lmp, folder, s, pair, JC, steps, dt=t_end / steps, frames=max(1, steps // 50), lost="ignore", skin=skin)
    inner = np.array([np.median(np.sqrt(np.maximum(64 + ((f["x"] - [12, 12, 0]) ** 2).sum(1) - r0**2, 0))) if len(f["x"]) == n else np.inf
                      for f in r.frames])
    k = int(np.argmin(inner))
    kinetic = r.thermo["c_book[1]"]
    a = 0.0 if "riemann" in words else float((words.split("viscosity")[1:] or ["1"])[0].split()[0])
    return dict(spacing=dx, kernel=kernel, h=h, words=words, particles=n, steps=steps, seconds=time.time() - start, inner=inner[k],
                stops_at=r.frames[k]["time"], kinetic=kinetic.min() / kinetic[0], strength=plastic(stop) / plastic(inner[k]),
                viscous=cylinder_stop(u0, a * 0.658 * h * dx / 8, rho, Y), **books(r))


def plastic(r):
    """plastic work per length and yield stress, of a cylinder that goes from the inner radius 8 to r"""
    x = np.linspace(r, 8, 4001)
    return 4 * np.pi / np.sqrt(3) * np.trapz(x * 0.5 * np.log1p(36 / x**2), x)


def cylinder_stop(u, nu, rho, Y, r=8.0, R=10.0, dr=1e-3):
    """where it stops with a kinematic viscosity"""
    area = R**2 - r**2
    energy = np.pi * rho * u * u * r * r * np.log(R / r)
    while energy > 0 and r > dr:
        R = np.sqrt(r**2 + area)
        u = np.sqrt(energy / (np.pi * rho * r * r * np.log(R / r)))
        energy -= dr * (4 * np.pi / np.sqrt(3) * Y * r * np.log(R / r) + 4 * np.pi * rho * nu * u * r * r * (1 / r**2 - 1 / R**2))
        r -= dr
    return r
