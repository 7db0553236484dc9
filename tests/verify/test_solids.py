"""Solids against exact solutions and conservation.

Tolerances come from the method. Gradients of linear fields are exact. A front is known to a spacing. The integration is of second order in the step.
"""

import numpy as np
import pytest
from solid_runs import Gruneisen, crossings, material, momentum_error, piston, row, run
from sph_scenes import Fluid

ENERGY = 1e-3  # largest drift of the ledger, as everywhere in this package


def pair(path, kernel="quintic", h=None, dim=1, words="viscosity 1 2", types=1, tension="no"):
    h = h or {}
    text = f"pair_style hvi/sph {kernel} dim {dim} form sum {words} h constant\n"
    for t in range(1, types + 1):
        text += f"pair_coeff {t} {t} file {path} h {h[t]:.17g}\n"
    if types > 1:
        text += f"pair_coeff 1 2 tension {tension}\n"
    return text


# elastic-plastic piston, cm g us Mbar

EOS = Gruneisen(2.79, 0.533, 1.34, 2.0)
G, Y, UP = 0.286, 0.0026, 0.01
EOS_TEXT = "eos gruneisen rho0 2.79 C 0.533 S1 1.34 g0 2.0 a 0.0 T0 300"


def piston_row(lmp, folder, n, length=1.3, times=(0.8, 1.6), kernel="quintic", y=Y, name="f"):
    """two rows meet at +-UP: either is a half-space that a piston hits; n particles per unit length"""
    path = material(folder / "metal.hvi", EOS_TEXT, f"strength perfect G {G} Y {y}")
    s = row(2 * length, int(round(2 * length * n)), margin=0.05, rho=EOS.rho0)
    middle = 0.5 * s.box[0]
    s.v[:, 0] = np.where(s.x[:, 0] < middle, UP, -UP)
    dt = 0.2 / n / 0.75  # 0.2 of h/c and less
    steps = int(round((times[1] - times[0]) / dt))
    dt = (times[1] - times[0]) / steps
    count = int(round(times[1] / dt))
    r = run(lmp, folder, s, pair(path, kernel, s.h), "strength perfect damage no spall none", count, dt=dt, frames=steps, name=name)
    out = []
    for f in r.frames[1:]:
        t = f["time"]
        right = s.x[:, 0] > middle
        out.append(dict(t=t, x=f["x"][right, 0] - middle + UP * t, u=f["v"][right, 0] + UP, **{k: f[k][right] for k in ("rho", "p", "sxx", "vm", "eps", "e")}))
    return r, out


def profile(exact, t, x):
    """u of the exact solution"""
    return np.where(x < exact["D2"] * t, exact["u2"], np.where(x < exact["D1"] * t, exact["u1"], 0.0))


def test_piston_exact():
    """the solution itself against the numbers of the literature"""
    e = piston(EOS, G, Y, UP)
    assert e["D1"] == pytest.approx(0.652066, rel=1e-5)
    assert e["D2"] == pytest.approx(0.550553, rel=1e-4)
    assert e["rho2"] == pytest.approx(2.839227, rel=1e-5)
    assert e["p2"] == pytest.approx(0.0144555, rel=1e-4)


def measure_piston(n, frames, exact):
    a, b = frames
    top = 0.5 * (exact["u1"] + exact["u2"])
    x1 = [crossings(f["x"], f["u"], 0.5 * exact["u1"])[-1] for f in (a, b)]
    x2 = [crossings(f["x"], f["u"], top)[-1] for f in (a, b)]
    dt = b["t"] - a["t"]
    t = b["t"]
    gap = (exact["D1"] - exact["D2"]) * t
    one = (b["x"] > exact["D2"] * t + 0.45 * gap) & (b["x"] < exact["D1"] * t - 0.3 * gap)
    two = (b["x"] > 0.2 * exact["D2"] * t) & (b["x"] < 0.85 * exact["D2"] * t)
    inside = b["x"] < 1.05 * exact["D1"] * t
    return dict(D1=(x1[1] - x1[0]) / dt, D2=(x2[1] - x2[0]) / dt, u1=b["u"][one].mean(), p1=b["p"][one].mean(), rho1=b["rho"][one].mean(),
                vm1=b["vm"][one].mean(), u2=b["u"][two].mean(), p2=b["p"][two].mean(), rho2=b["rho"][two].mean(), vm2=b["vm"][two].mean(),
                S2=(b["p"] + b["sxx"])[two].mean(), l1=np.abs(b["u"] - profile(exact, t, b["x"]))[inside].mean() / UP)


@pytest.mark.long
def test_piston(lmp, tmp_path):
    exact, last = piston(EOS, G, Y, UP), None
    for n in (100, 200, 400):
        r, frames = piston_row(lmp, tmp_path, n, name=f"f{n}")
        m = measure_piston(n, frames, exact)
        print(n, {k: f"{v / exact[k] - 1:+.2e}" for k, v in m.items() if k in exact}, {k: m[k] for k in ("vm1", "vm2", "S2", "l1")})
        spacings = n * (frames[1]["t"] - frames[0]["t"]) * 0.55
        for k in ("D1", "D2"):
            assert m[k] == pytest.approx(exact[k], rel=1 / spacings), k
        assert np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY, n
        assert max(momentum_error(r.thermo)) < 1e-12, n
        if last:
            assert m["l1"] < 0.75 * last["l1"], n  # order 1/2: the precursor is so weak that it spreads as sqrt(viscosity t)
        last = m
    # plateaus: half a percent for what is left of the oscillations
    for k in ("rho1", "rho2"):
        assert last[k] - EOS.rho0 == pytest.approx(exact[k] - EOS.rho0, rel=0.005), k
    for k in ("u1", "p1", "u2", "p2"):
        assert last[k] == pytest.approx(exact[k], rel=0.005), k
    assert last["vm2"] == pytest.approx(Y, rel=0.005)
    assert last["S2"] == pytest.approx(-2 / 3 * Y, rel=0.005)


def test_piston_column(lmp, tmp_path):
    """the same in three dimensions with the cubic kernel of h = 1.2, whose sums on the lattice are 0.982: fronts are in time, and behind them all is right"""
    exact, n, w, length, times = piston(EOS, G, Y, UP), 50, 5, 1.3, (0.8, 1.6)
    path = material(tmp_path / "metal.hvi", EOS_TEXT, f"strength perfect G {G} Y {Y}")
    N = int(round(2 * length * n))
    x = (np.stack(np.meshgrid(np.arange(N), np.arange(w), np.arange(w), indexing="ij"), -1).reshape(-1, 3) + 0.5) / n
    x[:, 0] += 0.1
    k = len(x)
    s = Fluid(x, np.zeros((k, 3)), np.full(k, EOS.rho0), np.zeros(k), np.ones(k, int), {1: EOS.rho0 / n**3}, {1: 1.2 / n},
              np.array([2 * length + 0.2, w / n, w / n]), (False, True, True), 3)
    s.v[:, 0] = np.where(x[:, 0] < 0.5 * s.box[0], UP, -UP)
    steps = int(round((times[1] - times[0]) * n * 3.75))
    dt = (times[1] - times[0]) / steps
    r = run(lmp, tmp_path, s, pair(path, "cubic", s.h, dim=3), "strength perfect damage no spall none", 2 * steps, dt=dt, frames=steps)

    def rows(a):
        return a.reshape(N, w * w).mean(1)[N // 2:]

    frames = [dict(t=f["time"], x=rows(f["x"][:, 0]) - 0.5 * s.box[0] + UP * f["time"], u=rows(f["v"][:, 0]) + UP,
                   **{q: rows(f[q]) for q in ("rho", "p", "sxx", "vm", "eps", "e")}) for f in r.frames[1:]]
    m = measure_piston(n, frames, exact)
    print({q: f"{v / exact[q] - 1:+.2e}" for q, v in m.items() if q in exact})
    for q in ("D1", "D2"):
        assert m[q] == pytest.approx(exact[q], rel=1 / (n * 0.8 * 0.55)), q  # a spacing
    for q in ("u2", "p2"):
        assert m[q] == pytest.approx(exact[q], rel=0.01), q
    assert m["rho2"] - EOS.rho0 == pytest.approx(exact["rho2"] - EOS.rho0, rel=0.01)
    assert np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY
    assert max(momentum_error(r.thermo)) < 1e-12


@pytest.mark.long
def test_elastic_bars(lmp, tmp_path):
    """two bars meet at +-V below yield: they part at 2 L/c, stress-free, with speeds V; viscosity keeps a part, of order 1/2 in spacing"""
    V, L = 1e-3, 1.0
    path = material(tmp_path / "metal.hvi", EOS_TEXT, f"strength perfect G {G} Y {Y}")
    c = np.sqrt(EOS.c0**2 + 4 / 3 * G / EOS.rho0)
    loss = []
    for n in (100, 400):
        s = row(2 * L, 2 * n, margin=0.1, rho=EOS.rho0)
        left = s.x[:, 0] < 0.5 * s.box[0]
        s.type = np.where(left, 1, 2)
        s.mass, s.h = {1: s.mass[1], 2: s.mass[1]}, {1: s.h[1], 2: s.h[1]}
        s.v[:, 0] = np.where(left, V, -V)
        steps = 40 * int(round(2 * L / (0.2 / n) / 40))
        r = run(lmp, tmp_path, s, pair(path, h=s.h, types=2), "strength perfect damage no spall none", 2 * steps, dt=2 * L / c / steps,
                frames=steps // 40, name=f"b{n}")
        t = np.array([f["time"] for f in r.frames]) * c / L
        u = np.array([f["v"][left, 0].mean() for f in r.frames]) / V
        end = r.frames[-1]
        stress = np.sqrt((end["sxx"] ** 2).mean()) / (EOS.rho0 * c * V)
        loss.append(1 + u[-1])
        print(n, "u = 0 at", crossings(t, u, 0.0)[0], "end u/V", u[-1], "rms stress", stress, "kinetic",
              (end["v"] ** 2).sum(1).mean() / V**2)
        assert np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY, n
        assert max(momentum_error(r.thermo)) < 1e-12, n
        assert end["eps"].max() == 0.0 and not end["damage"].any(), n
    assert crossings(t, u, 0.0)[0] == pytest.approx(1.0, abs=1 / 400)
    assert loss[1] < 0.65 * loss[0] and abs(2 * loss[1] - loss[0]) < 0.01  # n^(-1/2), to nothing
    assert stress < 0.03
    assert end["x"][~left, 0].min() - end["x"][left, 0].max() == pytest.approx(1 / 400 + 2 * V * 2 * L / c, rel=0.05)


# kinematics: velocities are given, stress follows


def block(n, dim=2, h=2.0, rho=1.0, margin=6):
    """a block of n^dim particles of spacing 1, its middle in the middle of the box"""
    x = np.zeros((n**dim, 3))
    x[:, :dim] = np.stack(np.meshgrid(*[np.arange(n)] * dim, indexing="ij"), -1).reshape(-1, dim) + 0.5 + margin
    box = np.full(3, n + 2.0 * margin)
    if dim == 2:
        box[2] = 1.0
    k = len(x)
    return Fluid(x, np.zeros((k, 3)), np.full(k, rho), np.zeros(k), np.ones(k, int), {1: rho}, {1: h}, box, (False, False, dim == 2), dim)


def turned(S, angle):
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    return R @ S @ R.T


def plane(f, k):
    """deviator in the plane of the particles k"""
    m = (f["sxx"] + f["syy"] + f["szz"])[k] / 3
    return np.array([[(f["sxx"][k] - m).mean(), f["sxy"][k].mean()], [f["sxy"][k].mean(), (f["syy"][k] - m).mean()]])


LINEAR = ("eos linear rho0 1 K 16", "strength perfect G 6 Y 1000")


def test_rotated_stress(lmp, tmp_path):
    """a block is stretched and sheared by 1 %, then turned by 100 degrees about its middle: S becomes R S R^T, no energy is taken up"""
    path = material(tmp_path / "metal.hvi", *LINEAR)
    s = block(20, h=2.0)
    mid = s.box[0] / 2
    d = s.x - mid
    d[:, 2] = 0
    s.v[:, 0] = 0.01 * d[:, 0] + 0.006 * d[:, 1]
    s.v[:, 1] = 0.006 * d[:, 0] - 0.004 * d[:, 1]
    drift = []
    for dt in (0.01, 0.005):
        first, w = int(round(1 / dt)), 0.5
        turn = 10 * int(round(np.radians(100) / w / dt / 10))
        more = (f"fix hold all setforce 0 0 0\nrun {first}\nunfix hold\n"
                f"variable vx atom -{w}*(y-{mid:.17g})\nvariable vy atom {w}*(x-{mid:.17g})\nvelocity all set v_vx v_vy 0\n"
                f"variable fx atom -mass*{w * w}*(x-{mid:.17g})\nvariable fy atom -mass*{w * w}*(y-{mid:.17g})\nfix turn all setforce v_fx v_fy 0\n"
                f"run {turn}\n")
        r = run(lmp, tmp_path, s, pair(path, "quintic", s.h, dim=2, words="viscosity 0 0"), "strength perfect damage no spall none", 0, dt=dt,
                frames=10, more=more, ledger="clamps all", every=100)
        inside = np.abs(d).max(1) < 3
        a, b = r.frames[first // 10], r.frames[-1]
        S0, S1 = plane(a, inside), plane(b, inside)
        angle = w * turn * dt
        want = turned(S0, angle)
        size = np.abs(S0).max()
        vm = np.array([f["vm"][inside].mean() for f in r.frames[first // 10:]])
        e = np.array([f["e"][inside].mean() for f in r.frames[first // 10:]])
        print("S0", S0.tolist(), "S1", S1.tolist(), "error", np.abs(S1 - want).max() / size,
              "vm", vm[-1] / vm[0] - 1, "e", e[-1] / e[0] - 1, "wrong sign would be", np.abs(turned(S0, -angle) - want).max() / size)
        drift.append((np.abs(S1 - want).max() / size, abs(vm[-1] / vm[0] - 1), np.ptp(e) / e[0]))
    assert np.array(drift[0]) / drift[1] == pytest.approx(4.0, rel=0.05) and max(drift[1]) < 2e-4


@pytest.mark.parametrize("kind", [pytest.param("elastic", marks=pytest.mark.long), "johnson-cook", pytest.param("temperature work", marks=pytest.mark.long)])
def test_simple_shear(lmp, tmp_path, kind):
    """v_x = y up to gamma 1.5: the constitutive law integrated by itself"""
    sections = dict(elastic=("eos linear rho0 1 K 16", "strength johnson-cook G 6 A 1e6 B 0 n 1 C 0 m 1 epsdot0 1 Tref 300 Tm 900"))
    sections["johnson-cook"] = ("eos gruneisen rho0 1 C 4 S1 1.4 g0 2 a 0 cp 0.001 T0 300",
                                "strength johnson-cook G 6 A 0.1 B 0.2 n 0.4 C 0.02 m 1 epsdot0 0.01 Tref 300 Tm 900")
    sections["temperature work"] = sections["johnson-cook"]
    path = material(tmp_path / "metal.hvi", *sections[kind])
    s = block(28, h=2.0)
    mid = s.box[0] / 2
    s.box[0] += 60
    s.x[:, 0] += 30
    near = np.abs(s.x[:, 1] - mid) < 8  # the kernel of what is measured reaches to 6.5
    s.x, s.v, s.rho, s.esph, s.type = s.x[near], s.v[near], s.rho[near], s.esph[near], s.type[near]
    rate, end = 1.0, 1.5
    s.v[:, 0] = rate * (s.x[:, 1] - mid)
    dt = 0.002
    r = run(lmp, tmp_path, s, pair(path, "quintic", s.h, dim=2, words="viscosity 0 0"), f"damage no spall none {kind if ' ' in kind else ''}",
            int(round(end / dt)), dt=dt, frames=50, more="fix hold all setforce 0 0 0", ledger="clamps all")
    d = s.x - [mid + 30, mid, 0]
    inside = (np.abs(d[:, 0]) < 4) & (np.abs(d[:, 1]) < 1.1)
    got = [dict(gamma=rate * f["time"], rho=f["rho"][inside].mean(), e=f["e"][inside].mean(), eps=f["eps"][inside].mean(), T=f["T"][inside].mean(),
                S=plane(f, inside), vm=f["vm"][inside].mean()) for f in r.frames]

    # the law, by small steps
    S, eps, rho, e, work = np.zeros((3, 3)), 0.0, 1.0, 0.0, 0.0
    eos, G_ = Gruneisen(1.0, 4.0, 1.4, 2.0), 6.0
    n, steps, want = 4, int(round(end / dt)), []
    L = np.zeros((3, 3))
    L[0, 1] = rate
    D, W = 0.5 * (L + L.T), 0.5 * (L - L.T)
    for k in range(steps * n + 1):
        gamma = k * dt / n * rate
        if k % (50 * n) == 0:
            want.append(dict(gamma=gamma, S=S[:2, :2].copy(), eps=eps, e=e, rho=rho, work=work))
        trial = S + dt / n * (2 * G_ * (D - np.trace(D) / 3 * np.eye(3)) + W @ S - S @ W)
        vm = np.sqrt(1.5 * (trial**2).sum())
        new = trial
        if kind != "elastic":
            T = 300 + (work if kind == "temperature work" else e) / 0.001
            heat = 1 - np.clip((T - 300) / 600, 0, 1)

            def yield_(de):
                x = de / (dt / n) / 0.01
                return (0.1 + 0.2 * (eps + de) ** 0.4) * (1 + 0.02 * np.log(max(x, 1))) * heat

            if vm > yield_(0):
                lo, hi = 0.0, vm / (3 * G_)
                for _ in range(60):
                    m = 0.5 * (lo + hi)
                    lo, hi = (m, hi) if vm - 3 * G_ * m > yield_(m) else (lo, m)
                y = yield_(lo)
                eps, new, work = eps + lo, trial * (y / vm), work + lo * y / rho
        p = 16 * (rho - 1) if kind == "elastic" else eos.p(rho, e)
        e += dt / n * ((0.5 * (S + new) * D).sum() - p * np.trace(D)) / rho
        rho -= dt / n * rho * np.trace(D)
        S = new
    size = max(np.abs(w["S"]).max() for w in want)
    error = max(np.abs(g["S"] - w["S"]).max() for g, w in zip(got, want)) / size
    g, w = got[-1], want[-1]
    ideal = 6 * np.sin(g["gamma"]) if kind == "elastic" else np.nan
    print(kind, "S error", error, "Sxy", g["S"][0, 1], "ODE", w["S"][0, 1], "ideal", ideal, "eps", g["eps"], w["eps"], "e", g["e"], w["e"],
          "work", w["work"], "T", g["T"], 300 + w["e"] / 0.001, "rho", g["rho"], w["rho"])
    assert len(got) == len(want)
    assert error < 2e-3
    assert g["e"] == pytest.approx(w["e"], rel=2e-3)
    if kind == "elastic":
        assert g["S"][0, 1] == pytest.approx(ideal, rel=2e-3)
    else:
        assert g["eps"] == pytest.approx(w["eps"], rel=2e-3)
        # adiabatic: all but the elastic energy, S:S/4G, is plastic work, and heats
        elastic = g["vm"] ** 2 / 6 / G_
        assert g["e"] == pytest.approx(w["work"] + elastic, rel=5e-3)
        assert g["T"] - 300 == pytest.approx((w["work"] + elastic) / 0.001, rel=5e-3)


def disc(lmp, folder, R, speed, kernel="quintic", h=1.6, turns=0.25, words="viscosity 0 0", name="disc", pulse=0.0):
    """a free elastic disc that is set spinning and pulsing, along x and y in turn; speeds at the rim in units of sqrt(K/rho + 4/3 G/rho) = sqrt(24)"""
    path = material(folder / "metal.hvi", *LINEAR)
    s = block(2 * R, h=h, margin=R)
    d = s.x - s.box / 2
    d[:, 2] = 0
    keep = (d**2).sum(1) < R * R
    d = d[keep]
    n = len(d)
    s.x, s.v, s.rho, s.esph, s.type = s.x[keep], np.zeros((n, 3)), np.ones(n), np.zeros(n), np.ones(n, int)
    w = speed * np.sqrt(24) / R
    q = pulse * np.sqrt(24) / R
    s.v[:, 0], s.v[:, 1] = -w * d[:, 1] + q * d[:, 0], w * d[:, 0] - q * d[:, 1]
    dt = 0.2 * h / np.sqrt(24)
    steps = int(round(turns * 2 * np.pi / w / dt))
    r = run(lmp, folder, s, pair(path, kernel, s.h, dim=2, words=words), "strength perfect damage no spall none", steps, dt=dt, frames=max(1, steps // 40), name=name)

    def spin(f):
        x = f["x"] - f["x"].mean(0)
        return (x[:, 0] * f["v"][:, 1] - x[:, 1] * f["v"][:, 0]).sum()

    J = np.array([spin(f) for f in r.frames])
    kinetic = np.array([(f["v"] ** 2).sum() for f in r.frames])
    # how far it turned: best rotation of the places
    x0, x1 = r.frames[0]["x"][:, :2], r.frames[-1]["x"][:, :2]
    A = (x1 - x1.mean(0)).T @ (x0 - x0.mean(0))
    turned_by = np.degrees(np.arctan2(A[1, 0] - A[0, 1], A[0, 0] + A[1, 1]))
    return r, J / J[0], kinetic / kinetic[0], turned_by


DUCTILE = dict(D1=0.02, D2=0.04, D3=-1.5, D4=0.01, D5=0.0)


def test_damage(lmp, tmp_path):
    """a row is stretched until it fails: D is the integral of d_eps/eps_f; then no S, no tension, but compression"""
    path = material(tmp_path / "metal.hvi", "eos gruneisen rho0 1 C 4 S1 1.4 g0 2 a 0 T0 300",
                    "strength johnson-cook G 6 A 0.1 B 0.2 n 0.4 C 0.02 m 1 epsdot0 0.01 Tref 300 Tm 900",
                    "damage johnson-cook epsdot0 0.01 " + " ".join(f"{k} {v}" for k, v in DUCTILE.items()))
    s = row(40.0, 40, margin=5.0)
    d = s.x[:, 0] - s.box[0] / 2
    rate, dt = 0.1, 0.001
    s.v[:, 0] = rate * d
    mid = s.box[0] / 2
    free = "unfix hold\nvelocity all set 0 0 0\nrun 200\n"
    squeeze = f"fix hold all setforce 0 0 0\nvariable v atom -{rate}*(x-{mid:.17g})\nvelocity all set v_v 0 0\nrun 700\n"
    push = "unfix hold\nvelocity all set 0 0 0\nrun 200\n"
    r = run(lmp, tmp_path, s, pair(path, h=s.h, words="viscosity 0 0"), "strength johnson-cook damage yes spall none", 0, dt=dt, frames=1, every=100,
            more="fix hold all setforce 0 0 0\nrun 500\n" + free + squeeze + push)
    inside = np.abs(d) < 6
    stretch, still, pressed, end = r.frames[:501], r.frames[501:701], r.frames[701:1401], r.frames[-1]
    eps, damage, p, vm, epsdot = (np.array([f[k][inside].mean() for f in stretch]) for k in ("eps", "damage", "p", "vm", "epsdot"))
    alive = damage < 1
    star = np.clip(-p / np.maximum(vm, 1e-300), -10, 10)
    D = DUCTILE
    eps_f = (D["D1"] + D["D2"] * np.exp(D["D3"] * star)) * (1 + D["D4"] * np.log(np.maximum(epsdot / 0.01, 1)))
    want = np.append(0, np.cumsum(np.diff(eps) * 0.5 * (1 / eps_f[1:] + 1 / eps_f[:-1])))
    k = np.nonzero(alive)[0][-1]
    print("failed at step", k + 1, "strain", rate * (k + 1) * dt, "eps", eps[k], "s* from", star[eps > 0][0], "to", star[k], "D", damage[k], "integral", want[k],
          "worst", np.abs(want - damage)[:k].max())
    assert 50 < k < 480
    assert np.abs(want - damage)[:k].max() < 0.005  # d_eps of a step/eps_f
    assert star[k] > 2 and np.all(np.diff(damage) >= 0)
    # failed: no stress, nothing moves
    last = stretch[-1]
    assert last["rho"][inside].max() < 0.99 and not last["vm"][inside].any() and not last["sxx"][inside].any()
    whole = np.abs(still[-1]["v"][inside]).max()
    print("failed particles at rest move with", whole, "edge", np.abs(still[-1]["v"]).max(), "damaged", (last["damage"] >= 1).sum())
    assert whole == 0.0
    # compression is borne, and pushes apart again
    dense = pressed[-1]
    print("compressed to", dense["rho"][inside].mean(), "p", dense["p"][inside].mean(), "then ends move", end["v"][0, 0], end["v"][-1, 0])
    assert dense["rho"][inside].min() > 1.01
    want = -Gruneisen(1.0, 4.0, 1.4, 2.0).p(dense["rho"], dense["e"])
    assert dense["sxx"][inside] == pytest.approx(want[inside], rel=1e-9)
    assert np.array_equal(dense["p"][inside], -dense["sxx"][inside])
    assert not dense["vm"][inside].any()
    assert end["v"][-1, 0] > 0.01 and end["v"][0, 0] < -0.01


# spall, SI


def flyer(lmp, folder, root, V, n, jc="strength johnson-cook damage no spall principal", a=2e-3, words="viscosity 1 2", t_end=2.2e-6, name="s"):
    path = root / "potentials" / "Al6061-T6.hvi"
    s = row(3 * a, 3 * n, margin=2 * a, rho=2703.0)
    dx = a / n
    first = s.x[:, 0] < 2 * a + a
    s.type = np.where(first, 1, 2)
    s.mass, s.h = {1: s.mass[1], 2: s.mass[1]}, {1: s.h[1], 2: s.h[1]}
    s.v[:, 0] = np.where(first, V, 0.0)
    dt = 0.12 * dx / 6500
    steps = int(t_end / dt)
    r = run(lmp, folder, s, pair(path, h=s.h, words=words, types=2), jc, steps, dt=dt, frames=max(1, steps // 400), units="si", name=name)
    return s, r, first, a, dx


def pull_back(s, r):
    t = np.array([f["time"] for f in r.frames])
    u = np.array([f["v"][-1, 0] for f in r.frames])
    spalled = np.array([f["spalled"].any() or (f["damage"] >= 1).any() for f in r.frames])
    up = np.nonzero(u > 0.9 * u.max())[0][0]
    first = np.nonzero(spalled)[0]
    t_sp = t[first[0]] if len(first) else np.nan
    return t, u, up, t_sp


# impacts: coarse, of all speeds


def impact(lmp, folder, root, V, metal="Al6061-T6", tD=1.0, angle=0.0, N=8, end=3.0, C=0.2, jc="", words="viscosity 1 2", name="i"):
    """sphere (N spacings across) of a metal on a plate of Al 6061-T6, thickness tD diameters; debris leaves through the faces"""
    D, rho = 8e-3, {"Al6061-T6": 2703.0, "Cu-OFHC": 8930.0}[metal]
    file = folder / "sphere.hvi"
    text = (root / "potentials" / f"{metal}.hvi").read_text()
    file.write_text(text if "spall limit" in text else text + "\nspall limit\n  sigma_p 1.2e9\n")
    dx = D / N
    dp = min(dx, tD * D)
    layers = int(round(tD * D / dp))
    k = np.arange(N) - 0.5 * (N - 1)
    ball = dx * np.stack(np.meshgrid(k, k, k, indexing="ij"), -1).reshape(-1, 3)
    ball = ball[(ball**2).sum(1) <= (D / 2) ** 2]
    w = int(round(2 * D / dp))
    q = dp * (np.arange(w) - 0.5 * (w - 1))
    plate = np.stack(np.meshgrid(dp * (np.arange(layers) + 0.5), q, q, indexing="ij"), -1).reshape(-1, 3)
    ball[:, 0] -= ball[:, 0].max() + 0.5 * (dx + dp) - 0.5 * dp
    ball[:, 1] -= np.tan(angle) * 0.5 * D
    x = np.concatenate([ball, plate])
    half = 1.3 * D
    x += [1.6 * D, half, half]
    n = len(ball)
    s = Fluid(x, np.zeros_like(x), np.where(np.arange(len(x)) < n, rho, 2703.0), np.zeros(len(x)), np.where(np.arange(len(x)) < n, 1, 2),
              {1: rho * dx**3, 2: 2703.0 * dp**3}, {1: 1.2 * dx, 2: 1.2 * dp}, np.array([(3.2 + tD) * D, 2 * half, 2 * half]), (False,) * 3)
    s.v[:n] = V * np.array([np.cos(angle), np.sin(angle), 0])
    pairs = (f"pair_style hvi/sph cubic form sum {words} h constant\npair_coeff 1 1 file {file} h {s.h[1]:.17g}\n"
             f"pair_coeff 2 2 file {root}/potentials/Al6061-T6.hvi h {s.h[2]:.17g}\n")
    t_end = end * D / V
    more = f"variable t equal time\nfix stop all halt 1 v_t > {t_end:.17g} error continue\n"
    r = run(lmp, folder, s, pairs, jc, 20000, frames=20000, every=20, units="si", lost="ignore", more=more, name=name)
    t = r.thermo
    momentum = s.m @ np.abs(s.v).sum(1)
    return dict(steps=t["Step"][-1], time=t["Time"][-1] / t_end, drift=np.abs(t["c_book[9]"] - 1).max(), momentum=max(momentum_error(t)) / momentum,
                left=t["c_book[21]"][-1], atoms=t["Atoms"][-1], n=len(x), dt=(t["Dt"].min(), t["Dt"].max()), result=r)


IMPACTS = [(1e3, "Al6061-T6", 1.0, 0), (3e3, "Cu-OFHC", 0.05, 0), (7e3, "Al6061-T6", 0.05, 0), (7e3, "Cu-OFHC", 1.0, 45), (12e3, "Al6061-T6", 1.0, 0),
           (20e3, "Cu-OFHC", 1.0, 0), (20e3, "Al6061-T6", 0.05, 45)]


@pytest.mark.parametrize("V, metal, tD, angle", [pytest.param(*one, marks=[pytest.mark.long] * (one not in (IMPACTS[3], IMPACTS[6]))) for one in IMPACTS])
def test_impacts(lmp, tmp_path, root, V, metal, tD, angle):
    """any speed, thin and thick plates, heavy spheres, obliquely: it ends, and the ledger closes"""
    o = impact(lmp, tmp_path, root, V, metal, tD, np.radians(angle))
    print(V, metal, tD, angle, {k: v for k, v in o.items() if k != "result"})
    assert o["time"] > 0.8 and o["left"] > 0  # the last line of output before the end
    assert o["drift"] <= ENERGY
    assert o["momentum"] < 1e-11


# spall, and what free bodies that turn lose


def test_spall(lmp, tmp_path, root):
    """Al 6061-T6 at 300 m/s: speed of the free surface, pull-back, place of the spall

    Elastic fronts run at c_l, plastic ones at c0. By characteristics the free surface comes to V - s_H (1/(rho c0) - 1/(rho c_l)), s_H being
    the Hugoniot elastic limit, and falls back by du = s_p (1/(rho c0) + 1/(rho c_l)) (Stepanov 1976): release at c0, the wave from the spall at c_l.
    """
    V, G_, Y0, sigma, rho0, c0, a = 300.0, 27.6e9, 324.1e6 * (1 + 0.002 * np.log(1e6)), 1.2e9, 2703.0, 5240.0, 2e-3
    cl = np.sqrt(c0**2 + 4 / 3 * G_ / rho0)
    hel = Y0 * rho0 * cl**2 / (2 * G_)
    stepanov = sigma / rho0 * (1 / c0 + 1 / cl)
    found = []
    for n in (60, 120):
        s, r, first, a, dx = flyer(lmp, tmp_path, root, V, n, a=a, t_end=1.6e-6, name=f"s{n}")
        t, u, up, t_sp = pull_back(s, r)
        top = up + u[up:].argmax()
        low = top + next(k for k in range(3, len(u) - top - 3) if u[top + k] == u[top + k - 3:top + k + 4].min() and u[top + k] < u[top] - 20)
        depth = s.x[-1, 0] + 0.5 * dx - s.x[r.frames[-1]["spalled"] > 0, 0]
        assert len(depth) and np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY, n
        found.append(dict(top=u[top], du=u[top] - u[low], near=depth.min(), far=depth.max(), pull=max(f["sxx"].max() for f in r.frames)))
        o = found[-1]
        print(n, o, "top by theory", V - hel / rho0 * (1 / c0 - 1 / cl), "du by theory", stepanov, "ratio", o["du"] / stepanov,
              "half rho c0 du/s_p", 0.5 * rho0 * c0 * o["du"] / sigma, "half rho c_l du/s_p", 0.5 * rho0 * cl * o["du"] / sigma)
    fine = found[1]
    assert fine["top"] == pytest.approx(V - hel / rho0 * (1 / c0 - 1 / cl), rel=0.01)
    assert fine["pull"] <= sigma
    # the pull-back is blunted over some kernels; it comes closer with resolution, and from below
    assert 1 - fine["du"] / stepanov < 0.7 * (1 - found[0]["du"] / stepanov) < 0.12
    assert fine["du"] == pytest.approx(stepanov, rel=0.1)
    # acoustics: the releases of both faces meet a flyer's thickness from the free surface, to the width of the plastic front that
    # arrives there (the elastic one moves the surface by 2 s_H/(rho c_l), a quarter of the whole)
    rise = t[u > 0.9 * fine["top"]][0] - t[u > 0.35 * fine["top"]][0]
    print("width of the front", c0 * rise)
    assert abs(fine["near"] - a) < c0 * rise and abs(fine["far"] - a) < c0 * rise


@pytest.mark.parametrize("kernel, h", [("cubic", 1.2), pytest.param("quintic", 1.6, marks=pytest.mark.long)])
def test_spinning_disc(lmp, tmp_path, kernel, h):
    """a free elastic disc spins: momentum, energy and angular momentum are kept"""
    for R in (6, 12):
        r, J, K, angle = disc(lmp, tmp_path, R, 0.1, kernel, h, name=f"d{R}")
        print(kernel, R, "J", J[-1], "kinetic", K[-1], "turned", angle, "vm", r.frames[-1]["vm"].max())
        assert abs(J[-1] - 1) < 1e-12, R
        assert np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY, R
        assert max(momentum_error(r.thermo)) < 1e-12 * len(r.frames[0]["x"]), R


@pytest.mark.parametrize("kernel, h, words, bound", [("cubic", 1.2, "", 1e-12), ("quintic", 1.6, "artstress 0.3 4", 5e-3),
                                                     pytest.param("quintic", 1.6, "", 1e-12, marks=pytest.mark.long),
                                                     pytest.param("cubic", 1.5, "artstress 0.3 4", 2e-2, marks=pytest.mark.long),
                                                     pytest.param("cubic", 1.2, "artstress 0.3 4", 5e-2, marks=pytest.mark.long)])
def test_disc_under_stress(lmp, tmp_path, kernel, h, words, bound):
    """the same under stress of changing sign, of some percent of strain, while it turns

    Forces of artstress are not central, so that a lattice that is strained has a torque of the order of the strain; without it there is none.
    """
    r, J, K, angle = disc(lmp, tmp_path, 12, 0.1, kernel, h, words=f"viscosity 0 0 {words}", pulse=0.03)
    vm = [f["vm"].max() for f in r.frames]
    print(kernel, h, words, f"gained {100 * np.abs(J - 1).max():.2g} %", "J", J.min(), J.max(), "kinetic", K.min(), "turned", angle, "strain", max(vm) / (2 * np.sqrt(3) * 6))
    assert max(vm) > 2 * np.sqrt(3) * 6 * 0.02
    assert np.abs(J - 1).max() < bound
    assert angle == pytest.approx(90, abs=3)
    assert np.abs(r.thermo["c_book[9]"] - 1).max() < ENERGY
    assert max(momentum_error(r.thermo)) < 1e-12 * len(r.frames[0]["x"])
