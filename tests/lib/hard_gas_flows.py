"""Hard cases in two dimensions: gas and liquid that shear, spin, leave the box, or whose particles lie unevenly; for hard_gas.py.

Spacing 1 (of the finer particles), gas of gamma 1.4 with rho = p = 1, so c = 1.18, unless said otherwise. Settings of the methods are words of the
pair style, or "stock" for the package SPH (sums of density over a reach of 3.2 spacings, viscosity 0.75, fixed step), or "ulsph" for smd/ulsph of
MACHDYN (the same reach and step, viscosity 1): liquids only, since its gas has p = (1 - gamma) rho e, the wrong sign.
"""

import dataclasses

import numpy as np
from dumps import read_dump
from hard_cases import Cannot
from hard_gas_rows import paired
from lammps_runs import Stopped
from reference.elastic_plastic import METALS
from reference.gas import shock
from solid_runs import momentum_error
from sph_scenes import Fluid, scene
from state_scenes import flyer
from tensile_scenes import pieces

KERNEL, ETA, COURANT, REACH = "wendland2", 1.6, 0.2, 3.2
GAMMA, C = 1.4, np.sqrt(1.4)
BOOK = "thermo_style custom step time dt " + " ".join(f"c_book[{k}]" for k in (1, 2, 9, *range(10, 19), 21)) + "\n"


def grid(nx, ny, spacing=1.0, low=(0.0, 0.0)):
    """(n, 2), from low"""
    return spacing * (np.stack(np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"), -1).reshape(-1, 2) + 0.5) + low


def fluid(x, v, box, rho=1.0, e=1 / (GAMMA - 1), kind=None, mass=None, h=None, periodic=(True, True, True), eta=ETA):
    """of positions and velocities (n, 2); e per mass"""
    n, flat = len(x), lambda a: np.hstack([a, np.zeros((len(a), 1))])  # noqa: E731
    kind = np.ones(n, int) if kind is None else kind
    mass = mass or {1: 1.0}
    m = np.array([mass[k] for k in kind])
    return Fluid(flat(x), flat(v), rho * np.ones(n), e * m * np.ones(n), kind, mass, h or {t: eta for t in mass}, np.array([*box, 20.0]), periodic, 2)


def go(lmp, folder, s, words, t, laws=None, kernel=KERNEL, boundary=None, fastest=C, spacing=1.0, at_rest=None, variable="h constant", name="s",
       timeout=600):
    """runs to t: x, v (n, 2), rho, e, p at the end, energy, momentum, thermo

    laws: {type: words of eos}; boundary: in place of that of s; fastest: signal, for the step of stock;
    at_rest: speed of sound of a scene in which nothing should move: error of momentum in units of that times the mass
    """
    laws = laws or {k: f"idealgas {GAMMA}" for k in s.mass}
    stock = words == "stock"
    if words == "ulsph":
        return ulsph(lmp, folder, s, t, next(iter(laws.values())).split(), fastest, timeout)
    if stock:
        law, reach = next(iter(laws.values())).split(), REACH * spacing
        if law[0] == "idealgas":
            pair = ("pair_style hybrid/overlay sph/rhosum 1 sph/idealgas\n"
                    f"pair_coeff * * sph/rhosum {reach}\npair_coeff * * sph/idealgas 0.75 {reach}\n")
        else:
            pair = f"pair_style sph/taitwater\npair_coeff * * {law[1]} {law[2]} 0.75 {reach}\n"
        steps = int(np.ceil(t / (COURANT * 0.5 * reach / (1.5 * fastest))))
        fix, end = "fix sph all sph\n", f"timestep {t / steps:.17g}\nrun {steps}\n"
    else:
        pair = f"pair_style hvi/sph {kernel} {words} {variable}\n"
        pair += "".join(f"pair_coeff {k} {k} eos {law} h {s.h[k]:.17g}\n" for k, law in laws.items())
        pair += "".join(f"pair_coeff {a} {b} tension yes\n" for a in laws for b in laws if a < b)
        fix = "fix sph all hvi/sph\n"
        end = (f"fix step all hvi/dt {COURANT}\nvariable left equal {t:.17g}-time\nfix stop all halt 1 v_left < 0 error continue message no\n"
               "run 1000000\n")
    text = scene(s, folder / f"{name}.data", pair, skin=0.3 * spacing, fix=fix)
    if boundary:
        text = text.replace(f"boundary {' '.join('p' if a else 'f' for a in s.periodic)}", f"boundary {boundary} {boundary} p")
    text += "compute book all hvi/energy\ncompute R all property/atom rho esph\n" + ("" if stock else "compute P all hvi/atom p\n")
    text += "thermo 1\n" + BOOK + "thermo_modify format float %.17g lost ignore\n" + end
    text += f"write_dump all custom {name}.last id type mass x y vx vy c_R[1] c_R[2]{'' if stock else ' c_P'} modify sort id format float %.17g\n"
    r = lmp(text, timeout=timeout)
    a = read_dump(folder / f"{name}.last").table
    if not np.isfinite(a).all() or not np.isfinite(r.thermo["c_book[9]"]).all():
        raise Stopped("numbers that are none")
    m = a[:, 2]
    out = dict(id=a[:, 0].astype(int), type=a[:, 1].astype(int), m=m, x=a[:, 3:5], v=a[:, 5:7], rho=a[:, 7], e=a[:, 8] / m, thermo=r.thermo)
    out["p"] = a[:, 9] if not stock else (GAMMA - 1) * out["rho"] * out["e"]
    return closed(out, s, at_rest)


def closed(out, s, at_rest=None):
    """with its books"""
    m, thermo = out["m"], out["thermo"]
    total = m.sum() * at_rest if at_rest else max((m[:, None] * np.abs(out["v"])).sum(), (s.m[:, None] * np.abs(s.v)).sum())
    out["books"] = {"energy": np.abs(thermo["c_book[9]"] - 1).max(), "momentum": max(momentum_error(thermo)) / total}
    return out


ULSPH = """units lj
dimension 2
boundary f f p
newton off
atom_style smd
atom_modify map array
comm_modify vel yes
read_data smd.data
pair_style smd/ulsph *DENSITY_CONTINUITY *VELOCITY_GRADIENT *NO_GRADIENT_CORRECTION
pair_coeff 1 1 *COMMON {rho} {c} 1.0 1.0 0.0 *EOS_TAIT {gamma} *END
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
fix smd all smd/integrate_ulsph
compute book all hvi/energy
compute R all smd/rho
thermo 1
""" + BOOK + """thermo_modify format float %.17g lost ignore
timestep {dt:.17g}
run {steps}
write_dump all custom smd.last id type mass x y vx vy c_R modify sort id format float %.17g
"""


def ulsph(lmp, folder, s, t, law, fastest, timeout):
    """go() with smd/ulsph, for one type of liquid"""
    if law[0] != "tait":
        raise Cannot("its gas has p = (1 - gamma) rho e, the wrong sign")
    n, m, half = len(s.x), s.mass[1], 0.5 * REACH
    head = ["smd", "", f"{n} atoms", "1 atom types", ""] + [f"{lo:.17g} {hi:.17g} {a}lo {a}hi" for a, lo, hi in
                                                             (("x", 0, s.box[0]), ("y", 0, s.box[1]), ("z", -0.5, 0.5))]
    place = [" ".join(f"{a:.17g}" for a in x) for x in s.x]
    rows = [f"{i + 1} 1 1 {m / s.rho[i]:.17g} {m:.17g} {half} 0.5 {place[i]} {place[i]}" for i in range(n)]
    speeds = [f"{i + 1} " + " ".join(f"{a:.17g}" for a in v) for i, v in enumerate(s.v)]
    (folder / "smd.data").write_text("\n".join([*head, "", "Atoms # smd", "", *rows, "", "Velocities", "", *speeds, ""]))
    steps = int(np.ceil(t / (COURANT * half / (1.5 * fastest))))
    r = lmp(ULSPH.format(rho=law[1], c=law[2], gamma=law[3], dt=t / steps, steps=steps), timeout=timeout)
    a = read_dump(folder / "smd.last").table
    if not np.isfinite(a).all():
        raise Stopped("numbers that are none")
    return closed(dict(id=a[:, 0].astype(int), type=a[:, 1].astype(int), m=a[:, 2], x=a[:, 3:5], v=a[:, 5:7], rho=a[:, 7], thermo=r.thermo), s)


def pairing(o):
    return {"paired": paired(o["x"], np.sqrt(o["m"] / o["rho"]), o["type"])}


def noise(o, rho=1.0):
    """of a gas at rest: rms speed and rms error of pressure and density, all relative to c, p, rho there"""
    c = np.sqrt(GAMMA / rho)
    rms = lambda a: np.sqrt((a**2).mean())  # noqa: E731
    return {"speed": rms(np.hypot(*o["v"].T) / c), "p": rms(o["p"] - 1), "rho": rms(o["rho"] / rho - 1)}


# ------------------------------------------------------------------ at rest


def contrast(ratio, n=24, jitter=0.1):
    """half of the box has `ratio` times the density at the same pressure; particles off their lattice by up to 0.1 spacings. Until the sound of the
    light gas has gone twice through the box"""

    def run(lmp, folder, words):
        x = grid(n, n)
        heavy = x[:, 0] > 0.5 * n
        x = (x + np.random.default_rng(1).uniform(-jitter, jitter, x.shape)) % n
        rho = np.where(heavy, ratio, 1.0)
        s = fluid(x, 0 * x, (n, n), rho, 2.5 / rho, np.where(heavy, 2, 1), {1: 1.0, 2: float(ratio)})
        o = go(lmp, folder, s, words, 2 * n / C, at_rest=C)
        side = [np.abs(o["rho"][o["type"] == t].mean() / r - 1) for t, r in ((1, 1.0), (2, ratio))]
        found = noise(o, np.where(o["type"] == 2, ratio, 1.0))
        return {"speed": found["speed"], "p": found["p"], "rho": max(side), **o["books"], **pairing(o)}

    return run


def spacings(coarse, mach=None, nx=40, rows=4):
    """fine in 0 < x < 2 nx, `coarse` times as coarse in 2 nx < x < 4 nx, rho = c = 1

    At rest: for the time in which sound goes through the box once: largest errors. Shocked: Mach 1.2 from x = 1.5 nx; mean p and u behind it on both
    sides of the contact over exact, in the windows of verify/test_variable_h.py, where the shock has been.
    """

    def run(lmp, folder, words):
        fine = 1.0
        start, rho, p, u = 2.0 * nx, 1.0, 1.0, 0.0
        parts, m = [grid(2 * nx, coarse * rows)], rows * coarse
        if mach:
            (rho, u, p), _ = shock((1.0, 0.0, 1 / GAMMA), mach)
            p *= GAMMA
            count = int(round(rho * nx))
            start = 1.5 * nx - count * fine / rho
            pushed = grid(count, m)
            pushed[:, 0] = start + pushed[:, 0] / rho
            ahead = parts[0]
            parts = [ahead[(ahead[:, 0] < start) | (ahead[:, 0] > 1.5 * nx)], pushed]
        parts.append(grid(2 * nx // coarse, rows, coarse, (2.0 * nx, 0.0)))
        x, part = np.concatenate(parts), np.repeat(np.arange(len(parts)), [len(a) for a in parts])
        hot, last = (part == 1) & bool(mach), part == len(parts) - 1
        v = np.stack([np.where(hot, u, 0.0), np.zeros(len(x))], 1)
        density = np.where(hot, rho, 1.0)
        e = np.where(hot, p / rho, 1.0) / GAMMA / (GAMMA - 1)
        s = fluid(x, v, (4 * nx, m), density, e, np.where(last, 2, 1), {1: 1.0, 2: float(coarse**2)}, {1: 1.2, 2: 1.2 * coarse})
        o = go(lmp, folder, s, words, (0.9 if mach else 2.0) * nx, kernel="cubic", variable="h variable", fastest=2.0, at_rest=None if mach else 1.0,
               spacing=coarse if words == "stock" else 1.0)
        if not mach:
            worst = {"rho": np.abs(o["rho"] - 1).max(), "p": np.abs(GAMMA * o["p"] - 1).max(), "u": np.hypot(*o["v"].T).max()}
            return {**worst, **o["books"], **pairing(o)}
        t, x = 0.9 * nx, o["x"][:, 0]
        contact, front = 2 * nx + u * (t - 0.5 * nx / mach), 1.5 * nx + mach * t
        # the jump that the shock began as leaves a wiggle; behind that is the fan from the other end; the front is some coarse particles wide
        wiggle = 1.6 * nx + u * t
        assert 1.5 * nx - count / rho + (u + np.sqrt(p / rho)) * t < wiggle
        out = {}
        for side, k, column in (("fine", (o["type"] == 1) & (x > wiggle) & (x < contact), coarse * rows),
                                ("coarse", (o["type"] == 2) & (x < contact + 0.6 * (front - contact)), rows)):
            if k.sum() < 2 * column:
                raise Stopped(f"{k.sum()} particles, less than two columns, where the shock has been in the {side} gas")
            out |= {f"p_{side}": abs((GAMMA * o["p"][k].mean() - 1) / (p - 1) - 1), f"u_{side}": abs(o["v"][k, 0].mean() / u - 1)}
        return {**out, **o["books"], **pairing(o)}

    return run


def random_rest(jitter, n=24):
    """gas at rest of particles that are displaced by up to `jitter` spacings, for four times the time of sound through the box: their noise"""

    def run(lmp, folder, words):
        x = (grid(n, n) + np.random.default_rng(2).uniform(-jitter, jitter, (n * n, 2))) % n
        o = go(lmp, folder, fluid(x, 0 * x, (n, n)), words, 4 * n / C, at_rest=C)
        return {**noise(o), **o["books"], **pairing(o)}

    return run


def twins(apart, n=20):
    """a gas at rest with one particle more, at `apart` spacings from another"""

    def run(lmp, folder, words):
        x = grid(n, n)
        k = n * (n // 2) + n // 2
        x = np.vstack([x, x[k] + apart * np.array([0.6, 0.8])])
        o = go(lmp, folder, fluid(x, 0 * x, (n, n)), words, n / C, at_rest=C)
        return {"u": np.hypot(*o["v"].T).max() / C, "rho": np.abs(o["rho"].mean() - 1), **o["books"]}

    return run


# ------------------------------------------------------------------ shear and spin


def shear(lmp, folder, words, n=32):
    """v_x = sin(2 pi y/n) at Mach 0.1, until the fastest have crossed the box once: kinetic energy that is lost, error of v; settings: words of the
    pair style, or as of vortices()"""
    kernel, eta, words = words if isinstance(words, tuple) else (KERNEL, ETA, words)
    x = (grid(n, n) + np.random.default_rng(1).uniform(-0.1, 0.1, (n * n, 2))) % n
    wave = lambda x: np.stack([np.sin(2 * np.pi * x[:, 1] / n), 0 * x[:, 1]], 1)  # noqa: E731
    s = fluid(x, wave(x), (n, n), e=100 / (GAMMA * (GAMMA - 1)), eta=eta)  # c = 10
    o = go(lmp, folder, s, words, n, kernel=kernel, fastest=11.0)
    kinetic = lambda v: (v**2).sum()  # noqa: E731
    return {"lost": 1 - kinetic(o["v"]) / kinetic(s.v), "v": np.abs(o["v"] - wave(o["x"])).mean(), **o["books"], **pairing(o)}


def kelvin_helmholtz(lmp, folder, words, n=48):
    """layers of density 1 and 2 at the same pressure, velocities -1/2 and 1/2 at a Mach number of 0.27 and 0.38; two waves of v_y = 0.02

    Chandrasekhar's growth of a wave on a vortex sheet between incompressible fluids: cosh(s t), s = k sqrt(rho1 rho2)/(rho1 + rho2); until s t = 2.
    Settings: words of the pair style, or these and n. grows: ln of what the wave of v_y has grown by over that of theory.
    symmetry: of the mirror images about the middle of the dense layer.
    """
    words, n = words if isinstance(words, tuple) else (words, n)
    dense = lambda x: np.abs(x[:, 1] - 0.5 * n) < 0.25 * n  # noqa: E731
    x = grid(n, n)
    heavy, k, p = dense(x), 4 * np.pi / n, 2.5
    rho = np.where(heavy, 2.0, 1.0)
    decay = lambda y: np.exp(-k * np.abs(y - 0.75 * n)) - np.exp(-k * np.abs(y - 0.25 * n))  # noqa: E731
    # free of divergence and, on both sides of a sheet, of curl: else half of it would go as sound
    along = sum(s * np.sign(x[:, 1] - a * n) * np.exp(-k * np.abs(x[:, 1] - a * n)) for s, a in ((-1, 0.75), (1, 0.25)))
    v = np.stack([np.where(heavy, 0.5, -0.5) + 0.02 * np.cos(k * x[:, 0]) * along, 0.02 * np.sin(k * x[:, 0]) * decay(x[:, 1])], 1)
    s = fluid(x, v, (n, n), rho, 2.5 * p / rho, np.where(heavy, 2, 1), {1: 1.0, 2: 2.0})
    rate = k * np.sqrt(2.0) / 3.0
    t = 2.0 / rate
    o = go(lmp, folder, s, words, t, fastest=np.sqrt(GAMMA * p) + 1)

    def wave(x, v):  # amplitude of v_y, of any phase, as the layers drift
        w = decay(x[:, 1])
        return np.hypot(*(2 * (w * v[:, 1] * f(k * x[:, 0])).sum() / (w * decay(x[:, 1])).sum() for f in (np.sin, np.cos)))

    image = (np.arange(n)[:, None] * n + (n - 1 - np.arange(n))[None, :]).ravel()
    y = o["x"]
    d = np.stack([y[:, 0] - y[image, 0], y[:, 1] + y[image, 1] - n], 1)
    d -= n * np.round(d / n)
    return {"grows": np.log(wave(o["x"], o["v"]) / wave(x, v)) / np.log(np.cosh(rate * t)), "symmetry": np.abs(d).max(), **o["books"], **pairing(o)}


def spinning(shape, n=12, turns=1.0):
    """a disc or square of liquid (Tait, c = 15 times the speed of its rim) with a free surface, of radius or half side n, for a turn or a quarter

    A disc in rigid rotation is at rest in its own frame: the liquid bears the tension, p = - rho w^2 (R^2 - r^2)/2, up to 0.2 % of rho c^2.
    A square throws out arms. Settings: words of the pair style, or as of vortices().
    """

    def run(lmp, folder, words):
        kernel, eta, words = words if isinstance(words, tuple) else (KERNEL, ETA, words)
        d = grid(2 * n, 2 * n) - n
        r = np.hypot(*d.T)
        if shape == "disc":
            d, r = d[r < n], r[r < n]
        w, wide = 1 / n, 6.0 * n
        v = w * np.stack([-d[:, 1], d[:, 0]], 1)
        s = fluid(d + 0.5 * wide, v, (wide, wide), e=0.0, periodic=(False, False, True), eta=eta)
        law = "tait 1.0 15.0 7"
        p = -0.5 * w**2 * (n**2 - r**2) if shape == "disc" else 0 * r
        s.rho = (1 + 7 * p / 15**2) ** (1 / 7)
        s.mass[1] = s.rho.mean()
        o = go(lmp, folder, s, words, turns * 2 * np.pi / w, {1: law}, kernel=kernel, fastest=15.0)
        turn = lambda x, v: (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]).sum()  # noqa: E731
        y, J = o["x"] - 0.5 * wide, turn(d, v)
        out = {"angular": abs(turn(y, o["v"]) / J - 1), **o["books"], **pairing(o), "pieces": pieces(o["x"], 1.6)}
        if shape == "disc":
            out["v"] = np.sqrt(((o["v"] - w * np.stack([-y[:, 1], y[:, 0]], 1)) ** 2).sum(1).mean()) / (w * n)
        return out

    return run


def vortices(n=24):
    """Taylor and Green's vortices, u = 0.3 c, of disordered particles, until the fastest have gone twice through a vortex; settings: kernel and h in
    spacings, and words"""

    def run(lmp, folder, setting):
        kernel, eta, words = setting
        x = (grid(n, n) + np.random.default_rng(3).uniform(-0.2, 0.2, (n * n, 2))) % n
        k = 2 * np.pi / n
        v = 0.3 * C * np.stack([np.sin(k * x[:, 0]) * np.cos(k * x[:, 1]), -np.cos(k * x[:, 0]) * np.sin(k * x[:, 1])], 1)
        o = go(lmp, folder, fluid(x, v, (n, n), eta=eta), words, n / (0.3 * C), kernel=kernel)
        return {"rho": np.sqrt(((o["rho"] - 1) ** 2).mean()), **o["books"], **pairing(o)}

    return run


# ------------------------------------------------------------------ out of the box


def faces(lmp, folder, words, n=10):
    """a round cloud of gas expands and moves to a corner; faces of the box are fixed (what crosses them is lost), follow it (s), or follow it from
    where they are (m). lost: part that the fixed ones lost; kept: largest part that the others did; count: who neither is there nor booked"""
    d = grid(2 * n, 2 * n) - n
    d = d[np.hypot(*d.T) < n]
    wide = 3.0 * n
    v = np.tile([1.0 * C, 0.6 * C], (len(d), 1))
    out = {"energy": 0.0, "momentum": 0.0, "kept": 0.0, "count": 0.0}
    for b in "fsm":
        s = fluid(d + 0.5 * wide, v, (wide, wide), periodic=(False, False, True))
        o = go(lmp, folder, s, words, 1.5 * n / C, boundary=b, name=b)
        left = len(d) - len(o["x"])
        out |= {k: max(out[k], o["books"][k]) for k in ("energy", "momentum")}
        out["count"] = max(out["count"], abs(o["thermo"]["c_book[21]"][-1] - left))
        if b == "f":
            out["lost"] = left / len(d)
        else:
            out["kept"] = max(out["kept"], left / len(d))
    return out


# ------------------------------------------------------------------ glass


def impact(fill):
    """plates of liquid aluminum meet at 5 km/s in three dimensions, particles on a lattice or like glass: errors of the target's shocked state"""

    def run(lmp, folder, words):
        if words == "stock":
            raise Cannot("no such law")
        liquid = dataclasses.replace(METALS["al"], Y=0.0)
        o = flyer(lmp, folder, liquid, liquid, 5000.0, n=48, across=4, words=words, fill=fill)
        q = o["target"]
        state = {k: abs(q["plateau"][k]) for k in ("sigma", "rho", "u")}
        return {**state, "scatter": q["scatter"]["sigma"], "energy": o["drift"], "momentum": o["momentum"]}

    return run
