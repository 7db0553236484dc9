"""Hard cases of solids for hard.py: scenes, methods, criteria; with those of impacts (hard_impacts.py) the list CASES.

Settings are words of pair hvi/sph, or of stock LAMMPS "stock STYLE" (hard_stock.py). Kernel and h are those of the impacts: cubic, 1.2 spacings.
"""

import numpy as np
import spacing_scenes
from body_scenes import SOUND, rest
from face_scenes import CL, COURANT, ELASTIC, G, JC, NU, RHO, block, go, spinning
from hard_cases import BOOKS, ENERGY, Case
from hard_impacts import ALUMINUM, WORDS
from hard_impacts import CASES as IMPACTS
from hard_stock import stock
from lammps_runs import Stopped
from solid_runs import Gruneisen, bisect, material, momentum_error, run
from sph_scenes import Fluid
from tensile_scenes import nearest, rings, strip

ART = "artstress 0.3 4"
TENSILE = {**WORDS, "artificial stress": f"viscosity 1 2 {ART}"}
WIDER = {"artificial stress h 1.5": (f"viscosity 1 2 {ART}", 1.5), "riemann artificial stress h 1.5": (f"dissipation riemann {ART}", 1.5)}
STOCK = {"stock tlsph": "stock tlsph", "stock ulsph": "stock ulsph"}
PAIRED = 0.5  # spacings: nearer than this to its nearest neighbor a sound particle is one of a pair


def books(r, momentum):
    """energy: largest drift in units of the first total; momentum: largest change, in units of `momentum`"""
    return dict(energy=np.abs(r.thermo["c_book[9]"] - 1).max(), momentum=max(momentum_error(r.thermo)) / momentum)


def paired(f, spacing, dim=3):
    """fraction of sound particles with the nearest neighbor below half of the spacing, of a frame of solid_runs.run"""
    sound = (f["spalled"] == 0) & (f["damage"] < 1)
    return (nearest(f["x"][:, :dim])[sound] < PAIRED * spacing).mean() if sound.any() else 0.0


def mirrored(f, half, middle, spacing):
    """largest distance of a particle from where the mirror image across x = middle of its partner is; IDs of partners differ by half"""
    where = np.full((2 * half, 3), np.nan)
    where[f["id"] - 1] = f["x"]
    miss = where[:half] * [-1, 1, 1] + [2 * middle, 0, 0] - where[half:]
    here = np.isfinite(miss).all(1)
    return np.sqrt((miss[here] ** 2).sum(1).max()) / spacing if here.any() else np.nan


# tension


def rubber_rings(lmp, folder, setting):
    """speed 0.059 c, 20 frames; pieces of the worse ring, least of the first percentile of distances to nearest neighbors, rebound"""
    words, h = setting if isinstance(setting, tuple) else (setting, 1.2)
    if words.startswith("stock"):
        return stock(lmp, folder, "rings", words)
    dx = 0.2
    r, frames = rings(lmp, folder, words, dx=dx, h=h)
    x0, last = r.frames[0], r.frames[-1]
    left = x0["type"] == 1
    partner = np.zeros(2 * left.sum(), int)  # the second ring is the first one moved, not mirrored: by places
    order = {tuple(np.round(p / dx * 2).astype(int)): k for k, p in enumerate(x0["x"][:, :2] - [20, 15])}
    for (a, b), k in order.items():
        partner[k] = order[(-a, b)]
    x = np.full((len(partner), 2), np.nan)
    x[last["id"] - 1] = last["x"][:, :2] - [20, 15]
    miss = np.sqrt(((x[partner] * [-1, 1] - x) ** 2).sum(1))
    mass = 1.01 * dx**2 * len(partner) * 0.059
    return dict(books(r, mass), pieces=max(f["pieces"] for f in frames), nearest=min(f["near"] for f in frames),
                pairs=max(paired(f, dx, 2) for f in r.frames), rebound=-frames[-1]["v"], mirror=np.nanmax(miss) / dx)


def stretched_strip(lmp, folder, setting):
    """by 10 %, places a little out of order"""
    words, h = setting if isinstance(setting, tuple) else (setting, 1.2)
    r, near = strip(lmp, folder, words, h=h, strain=0.1)
    return dict(books(r, np.abs(r.frames[0]["v"]).sum()), nearest=near.min(), farthest=near.max(), pairs=(near < PAIRED).mean())


def considere(rate):
    """largest nominal stress of a bar of Al6061-T6.hvi, uniform, cold: (A + B e^n)(1 + C ln rate) exp(-e), Pa"""
    e = np.linspace(0, 0.3, 3001)
    return ((324.1e6 + 113.8e6 * e**0.42) * (1 + 0.002 * np.log(rate)) * np.exp(-e)).max()


def tensile_bar(lmp, folder, words, n=5, length=20, dx=0.5e-3, V=100.0, strain=0.8):
    """a bar of Al6061-T6 of n by n by length particles between grips of 3 layers that go apart at +-V, its velocity linear from the start:
    largest nominal stress in units of that of theory, elongation where the force has fallen to half, the force at the end over the largest"""
    if words.startswith("stock"):
        return stock(lmp, folder, "bar", words, considere=considere(2e4))
    x = dx * block([length + 6, n, n])
    k, L = len(x), length * dx
    ends = np.abs(x[:, 0]) > 0.5 * L
    box = np.array([3 * L, 6 * n * dx, 6 * n * dx])
    s = Fluid(x + 0.5 * box, np.zeros((k, 3)), np.full(k, 2703.0), np.zeros(k), np.where(ends, 2, 1), {1: 2703 * dx**3, 2: 2703 * dx**3},
              {1: 1.2 * dx, 2: 1.2 * dx}, box, (False,) * 3)
    s.v[:, 0] = np.clip(2 * V * x[:, 0] / L, -V, V)
    pair = f"pair_style hvi/sph cubic {words}\npair_coeff * * file {ALUMINUM} h {1.2 * dx:.17g}\npair_coeff 1 2 tension yes\ngroup ends type 2\n"
    dt = 0.2 * 1.2 * dx / 6500
    steps = int(strain * L / (2 * V) / dt)
    r = run(lmp, folder, s, pair, "damage yes spall voids", steps, dt=dt, frames=max(1, steps // 10), more="fix hold ends setforce 0 0 0",
            ledger="clamps ends", every=max(1, steps // 200), units="si", lost="ignore")
    t = r.thermo
    E0 = t["c_book[1]"][0] + t["c_book[2]"][0]
    clamps = t["c_book[9]"] * E0 - t["c_book[1]"] - t["c_book[2]"]  # minus the work of the grips
    force = -np.diff(clamps) / (np.diff(t["Time"]) * 2 * V)
    force = np.convolve(force, np.ones(5) / 5, "same")
    top, e = force.argmax(), 2 * V * 0.5 * (t["Time"][1:] + t["Time"][:-1]) / L
    fallen = np.flatnonzero(force[top:] < 0.5 * force[top])
    return dict(books(r, s.m @ np.abs(s.v[:, 0])), strength=force[top] / (n * dx) ** 2 / considere(2 * V / L),
                elongation=e[top + fallen[0]] if len(fallen) else e[-1], load_end=np.abs(force[-10:]).max() / force[top],
                pairs=paired(r.frames[-1], dx))


# spin and shear


def spun(r, s, reference):
    """angular momentum about z of all frames: largest part that is lost or gained"""
    J = np.array([np.cross(f["x"] - reference, f["v"])[:, 2].sum() if len(f["x"]) == len(s.x) else np.nan for f in r.frames])
    return np.abs(J / J[0] - 1).max()


def spinning_square(lmp, folder, words):
    """8 by 8, corners at 0.05 of the speed of sound, 3 turns"""
    if words.startswith("stock"):
        return stock(lmp, folder, "square", words)
    o = spinning(lmp, folder, 8, words, "cubic", 1.2, turns=3.0)
    d = block([8, 8])
    total = RHO * 0.05 * CL / (3.5 * np.sqrt(2)) * np.hypot(d[:, 0], d[:, 1]).sum()
    return dict(energy=o["drift"], momentum=o["momentum"] / total, spin=o["worst"], kinetic=o["kinetic"], turned=o["turned"], shape=o["shape"])


def spinning_disc(lmp, folder, words, R=8.0, speed=0.05, turns=3.0):
    """a disc, its rim at 0.05 of the speed of sound; set spinning of a sudden it pulses about the steady state of theory (plane strain), in which
    von Mises stress is steady: its mean over mass and the second half of time, in units of that of theory"""
    d = block([int(2 * R) + 2] * 2)
    r0 = np.hypot(d[:, 0], d[:, 1])
    d, r0 = d[r0 < R], r0[r0 < R]
    k, w = len(d), speed * CL / R
    box = np.array([3 * R, 3 * R, 1.0])
    s = Fluid(d + 0.5 * box * [1, 1, 0], np.cross([0, 0, w], d), np.full(k, RHO), np.zeros(k), np.ones(k, int), {1: RHO}, {1: 1.2}, box,
              (False, False, True), 2)
    r, _, _ = go(lmp, folder, s, words, "cubic", 1.2, turns * 2 * np.pi / w, 200, "d", skin=0.3, lost="ignore")
    c, q = RHO * w**2 / (8 * (1 - NU)), np.sqrt(k / np.pi)  # its radius by its area
    sr, st = c * (3 - 2 * NU) * (q**2 - r0**2), c * ((3 - 2 * NU) * q**2 - (1 + 2 * NU) * r0**2)
    sz = NU * (sr + st)
    theory = np.sqrt(0.5 * ((sr - st) ** 2 + (st - sz) ** 2 + (sz - sr) ** 2)).mean()
    late = r.frames[len(r.frames) // 2:]
    kinetic = [(f["v"] ** 2).sum() for f in (r.frames[0], late[-1])]
    return dict(books(r, RHO * w * r0.sum()), spin=spun(r, s, 0.5 * box * [1, 1, 0]), kinetic=kinetic[1] / kinetic[0],
                von_mises=np.mean([f["vm"].mean() for f in late]) / theory)


def shear_layer(lmp, folder, words, length=24, high=12, rate=0.01, Y=0.06, strain=1.0):
    """a layer between two that go past each other, periodic along it: simple shear by 1 of an elastic-plastic solid. Mean shear stress from
    0.1 on in units of Y/sqrt(3); stiffness at first in units of G"""
    path = material(folder / "soft.hvi", ELASTIC[0], f"strength perfect G {G} Y {Y}")
    grid = high + 6
    x = block([length, grid])
    k, ends = len(x), np.abs(x[:, 1]) > 0.5 * high
    box = np.array([length, 2.0 * grid, 1.0])
    s = Fluid(x + 0.5 * box * [1, 1, 0], np.zeros((k, 3)), np.full(k, RHO), np.zeros(k), np.where(ends, 2, 1), {1: RHO, 2: RHO}, {1: 1.2, 2: 1.2},
              box,
              (True, False, True), 2)
    s.v[:, 0] = rate * np.clip(x[:, 1], -0.5 * high, 0.5 * high)
    pair = (f"pair_style hvi/sph cubic dim 2 {words}\npair_coeff * * file {path} h 1.2\npair_coeff 1 2 tension yes\ngroup ends type 2\n")
    dt = COURANT * 1.2 / CL
    steps = int(strain / rate / dt)
    r = run(lmp, folder, s, pair, JC, steps, dt=dt, frames=max(1, steps // 500), more="fix hold ends setforce 0 0 0", ledger="clamps ends", name="l")
    inner = (np.abs(x[:, 1]) < 0.5 * high - 3)
    g = rate * np.array([f["time"] for f in r.frames])
    stress = np.array([f["sxy"][inner].mean() for f in r.frames])
    first = (g > 0) & (g < 0.6 * Y / np.sqrt(3) / G)
    f = r.frames[-1]
    return dict(books(r, np.abs(s.v[:, 0]).sum()), stiffness=(stress[first] / g[first]).mean() / G,
                strength=stress[g > 0.1].mean() / (Y / np.sqrt(3)), pairs=(nearest(f["x"][:, :2])[inner] < PAIRED).mean())


# places and steps that are hard


def breathing(extra=0.0, n=8, speed=0.02):
    """a free cube of n^3 particles, its velocity inwards; extra: one more that far from one of the middle"""
    x = block([n] * 3)
    if extra:
        x = np.concatenate([x, x[[np.argmin((x**2).sum(1))]] + [extra, 0, 0]])
    k, box = len(x), np.full(3, 3.0 * n)
    s = Fluid(x + 0.5 * box, -speed * CL * x / (0.5 * n), np.full(k, RHO), np.zeros(k), np.ones(k, int), {1: RHO}, {1: 1.2}, box, (False,) * 3)
    return s


def breathe(lmp, folder, words, s, steps, dt=None, name="b"):
    path = material(folder / "elastic.hvi", *ELASTIC)
    pair = f"pair_style hvi/sph cubic {words}\npair_coeff * * file {path} h 1.2\n"
    return run(lmp, folder, s, pair, JC, steps, dt=dt, frames=max(1, steps // 20), name=name)


def same_place(lmp, folder, words, steps=400):
    """two particles a millionth of a spacing apart in a cube that breathes: largest speed in units of that at the start, time that as many steps
    reach in units of that without the second one"""
    alone = breathe(lmp, folder, words, breathing(), steps, name="alone")
    s = breathing(1e-6)
    r = breathe(lmp, folder, words, s, steps)
    v = np.sqrt((s.v**2).sum(1))
    most = max(np.sqrt((f["v"] ** 2).sum(1).max()) for f in r.frames)
    return dict(books(r, s.m @ v), speed=most / v.max(), pace=r.thermo["Time"][-1] / alone.thermo["Time"][-1])


def long_step(lmp, folder, words):
    """a fixed step of 3 h/c: refused, warned of, or ended by an error"""
    try:
        r = breathe(lmp, folder, words, breathing(), 200, dt=3 * 1.2 / CL)
    except Stopped:
        return dict(caught=1)
    return dict(caught=any("above the stable" in w for w in r.warnings))


def cold_start(lmp, folder, words):
    """a free block of aluminum at rest, without energy, on a lattice or like a glass: largest speed over that of sound"""
    return {fill: rest(lmp, folder, fill, words, kernel="cubic", h=1.2, end=2e-6)["largest"] / SOUND for fill in ("lattice", "glass")}


def glass_noise(lmp, folder, words):
    """like a glass, periodic, pressed by 5 %: kinetic energy it makes of itself over that of compression, scatter of stress over pressure"""
    o = rest(lmp, folder, "glass", words, kernel="cubic", h=1.2, compressed=0.05, end=2e-6)
    return dict(noise=o["energy"], scatter=o["scatter"] / (2703 * 5240.0**2 * 0.05 / 1e9))


# hot and cold (cm, g, us, Mbar)

HOT = 5e-3  # energy per mass of the hot half: some 560 K more


def hot_cold(lmp, folder, words, n=200, speed=0.02):
    """a row of aluminum, half of it hot and so much lighter that its pressure is 0: at rest, the largest speed over that of sound; hit by the cold
    half, the velocity of the contact in units of that of the two Hugoniots"""
    al = Gruneisen(2.703, 0.524, 1.4, 1.97)
    path = material(folder / "al.hvi", "eos gruneisen rho0 2.703 C 0.524 S1 1.4 g0 1.97 a 0 cp 8.85e-6 T0 300", "strength perfect G 0.276 Y 0.0003")

    def p(rho, e):
        return al.p(rho, e) if rho > al.rho0 else al.c0**2 * (rho - al.rho0) + al.g0 * al.rho0 * e

    rho_hot, dx = bisect(lambda q: p(q, HOT), 0.8 * al.rho0, al.rho0), 1 / n

    def shocked(P, rho0, e0):
        """velocity behind a shock of that pressure"""
        rho = bisect(lambda q: p(q, e0 + 0.5 * P * (1 / rho0 - 1 / q)) - P, rho0, 1.3 * rho0)
        return np.sqrt(P * (1 / rho0 - 1 / rho))

    P = bisect(lambda q: shocked(q, al.rho0, 0.0) + shocked(q, rho_hot, HOT) - speed, 1e-5, 0.1)
    contact = shocked(P, rho_hot, HOT)
    x = np.zeros((2 * n, 3))
    x[:, 0] = 0.1 + (np.arange(2 * n) + 0.5) * dx
    hot = np.arange(2 * n) >= n
    out = {}
    for name, v in (("rest", 0.0), ("hit", speed)):
        rho = np.where(hot, rho_hot, al.rho0)
        mass = {1: al.rho0 * dx, 2: rho_hot * dx}
        s = Fluid(x, np.zeros((2 * n, 3)), rho, np.where(hot, HOT * mass[2], 0.0), np.where(hot, 2, 1), mass, {1: 1.2 * dx, 2: 1.2 * dx},
                  np.array([2.2, 20 * dx, 20 * dx]), (False, True, True), 1)
        s.v[~hot, 0] = v
        dt = 0.2 * 1.2 * dx / 0.65
        steps = int(0.6 / 0.56 / dt)
        pair = f"pair_style hvi/sph cubic dim 1 {words}\npair_coeff * * file {path} h {1.2 * dx:.17g}\n"
        r = run(lmp, folder, s, pair, JC, steps, dt=dt, frames=steps, name=name)
        f = r.frames[-1]
        if v:
            near = np.abs(np.arange(2 * n) - n + 0.5) < 20
            out.update(books(r, s.m @ np.abs(s.v[:, 0])), contact=f["v"][near, 0].mean() / contact)
        else:
            out["rest"] = np.abs(f["v"][:, 0]).max() / al.c0
    return out


# two spheres


def two_spheres(lmp, folder, words, across=8, dx=0.5e-3, V=2000.0, room=6.0, steps=400):
    """two spheres of Al6061-T6 head on at +-V, each the mirror image of the other; room: box in diameters"""
    half = dx * block([across] * 3)
    half = half[(half**2).sum(1) < (0.5 * across * dx) ** 2]
    n, D = len(half), across * dx
    a = half - [0.5 * D + 0.5 * dx, 0, 0]
    box = np.array([room * D] * 3)
    x = np.concatenate([a, a * [-1, 1, 1]])
    s = Fluid(x + 0.5 * box, np.zeros((2 * n, 3)), np.full(2 * n, 2703.0), np.zeros(2 * n), np.repeat([1, 2], n), {1: 2703 * dx**3, 2: 2703 * dx**3},
              {1: 1.2 * dx, 2: 1.2 * dx}, box, (False,) * 3)
    s.v[:, 0] = np.repeat([V, -V], n)
    pair = f"pair_style hvi/sph cubic {words}\npair_coeff * * file {ALUMINUM} h {1.2 * dx:.17g}\n"
    r = run(lmp, folder, s, pair, "damage no spall voids", steps, frames=steps, units="si", lost="ignore")
    return r, s, n, box, dx


def head_on(lmp, folder, words):
    r, s, n, box, dx = two_spheres(lmp, folder, words)
    f = r.frames[-1]
    y = f["x"] - 0.5 * box
    return dict(books(r, s.m @ np.abs(s.v[:, 0])), mirror=mirrored(f, n, 0.5 * box[0], dx),
                axes=abs((y[:, 1] ** 2).sum() / (y[:, 2] ** 2).sum() - 1), pairs=paired(f, dx))


def crossed_face(lmp, folder, words):
    """the same in a box that the cloud leaves"""
    r, s, n, box, dx = two_spheres(lmp, folder, words, room=2.4, steps=1000)
    gone = r.thermo["c_book[21]"][-1]
    return dict(books(r, s.m @ np.abs(s.v[:, 0])), gone=gone / (2 * n), count=abs(gone + r.thermo["Atoms"][-1] - 2 * n))


def unlike_spacings(ratio):
    """plates of spacings 1 and ratio; errors of stress on the plateaus, of density in the three layers next to the contact"""
    def scene(lmp, folder, words):
        o = spacing_scenes.plates(lmp, folder, ratio, True)
        return dict(energy=o["energy"], stress=max(abs(o[k][0]) for k in ("fine", "coarse")), contact=max(o[k][2] for k in ("fine", "coarse")))

    return scene


NEAR = {"pairs": 1e-3}  # of particles: no pairing
ARTIFICIAL = {"riemann artificial stress": f"dissipation riemann {ART}"}

# causes, each tried

TORN = dict.fromkeys(("pieces", "nearest", "pairs", "rebound"), "tensile instability: artificial stress and h 1.5 hold it")
BUCKLES = {"rebound": "h of 1.2 spacings is too narrow for a ring of 5 particles: h 1.5 rebounds with 0.73"}
UNEVEN = dict.fromkeys(("nearest", "farthest"), "tensile instability: artificial stress and h 1.5 hold it")
NARROW = {"farthest": "artificial stress needs a wider kernel: 1.04 with h 1.5"}
VISCOUS = {"strength": "of the rate: 1.02 at a quarter of the speed; how, is not known"}
COARSE = {"energy": "of the step, not of the pair: as large without it, 8e-5 at a quarter of the step"}
SQUEEZED = {"pairs": "neighbors along the impact are squeezed together and stay so in tension: 8 of 248 with artificial stress"}
UNWEIGHTED = {"contact": "densities next to the contact are integrated with sums over unlike neighbors"}
MET = {"pairs": "8 of 248, one place and its mirror images, where the spheres met"}

SOLIDS = [
    Case("rings", "rubber rings that meet", rubber_rings, {**TENSILE, **WIDER, **STOCK},
         {**BOOKS, **NEAR, "pieces": 1, "nearest": (0.5, np.inf), "rebound": (0.5, 1.0), "mirror": 1e-6},
         (),
         {**dict.fromkeys(WORDS, TORN), "artificial stress": BUCKLES}),
    Case("strip", "a strip that is stretched by 10 %", stretched_strip, {**TENSILE, **WIDER},
         {**BOOKS, **NEAR, "nearest": (0.9, np.inf), "farthest": 1.1}, (*TENSILE, *WIDER),
         {**dict.fromkeys(WORDS, UNEVEN), "artificial stress": NARROW}),
    Case("bar", "a tensile bar to fracture", tensile_bar, {**TENSILE, **STOCK},
         {**BOOKS, "strength": (0.85, 1.15), "elongation": (0.03, 0.6), "load_end": 0.05, "pairs": 0.01}, (),
         {"riemann": VISCOUS, "viscosity": VISCOUS}),
    Case("square", "a square that spins", spinning_square, {**WORDS, **STOCK},
         {**BOOKS, "spin": 1e-10, "kinetic": (0.97, 1.001), "turned": (0.98, 1.001), "shape": 0.1},
         ("riemann",)),
    Case("disc", "a disc that spins", spinning_disc, WORDS,
         {**BOOKS, "spin": 1e-10, "kinetic": (0.97, 1.001), "von_mises": (0.85, 1.15)}),
    Case("solid-shear", "a layer sheared by 1", shear_layer, WORDS, {**BOOKS, **NEAR, "stiffness": (0.95, 1.05), "strength": (0.95, 1.05)}),
    Case("same-place", "two particles at the same place in a solid", same_place, WORDS, {**BOOKS, "speed": 2.0, "pace": (0.5, np.inf)}, tuple(WORDS),
         {"riemann": COARSE, "viscosity": COARSE}),
    Case("solid-long-step", "a fixed step three times too long", long_step, WORDS, {"caught": (1, np.inf)}, ("riemann",)),
    Case("cold", "a block at zero pressure without energy", cold_start, WORDS, {"lattice": 1e-10, "glass": 1e-10}, ("riemann",)),
    Case("noise", "a glass under pressure, at rest", glass_noise, WORDS, {"noise": 1e-3, "scatter": 0.1}),
    Case("hot-cold", "hot aluminum beside cold, then hit by it", hot_cold, WORDS,
         {**BOOKS, "rest": 1e-6, "contact": (0.97, 1.03)}, ("riemann",)),
    Case("head-on", "two spheres head on, 4 km/s", head_on, {**WORDS, **ARTIFICIAL}, {**BOOKS, "mirror": 1e-3, "axes": 1e-6, "pairs": 0.01},
         ("riemann",),
         {**dict.fromkeys(WORDS, SQUEEZED), **dict.fromkeys(ARTIFICIAL, MET)}),
    Case("face", "a face crossed by the cloud", crossed_face, WORDS, {**BOOKS, "gone": (0.05, 1.0), "count": 0}, ("riemann",)),
    # these two were measured before their bounds were written: those are what equal spacings have, 0.4 and 4 %
    *(Case(f"solid-spacing-{k}", f"plates of solids of spacings 1 and {k} that meet", unlike_spacings(k),
           {"riemann": WORDS["riemann"]}, {"energy": ENERGY, "stress": 0.01, "contact": 0.05}, (),
           {"riemann": UNWEIGHTED}, "after") for k in (2, 4))]

CASES = [*SOLIDS, *IMPACTS]
