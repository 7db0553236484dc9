"""Variable h: density and h behind shocks, unequal spacings side by side, and neighbor lists that are long enough at every step.

Lengths in spacings or as said; ideal gas. Figures with the tests are measured ones; bounds leave some room.
"""

import re

import numpy as np
import pytest
from dumps import frames, read_dump
from scipy.spatial import cKDTree
from reference import gas
from spacing_scenes import lattice
from sph_scenes import SUPPORT, Fluid, ideal_gas, norm, random_fluid, rates, riemann_rates, scene, shape

DUMP = """write_dump all custom {0} id x y z vx c_R c_H[1] c_H[2] modify sort id format float %.15g
"""
UNTIL = """compute H all hvi/atom h p
compute R all property/atom rho
fix step all hvi/dt 0.3
variable t equal f_step[2]
fix stop all halt 1 v_t > {0} error continue message no
thermo 10
"""
WORST = {}  # of the jumps of shocks
DISSIPATIONS = {"riemann": "dissipation riemann", "monaghan": "viscosity 1 2", "auto": "interface auto"}


def read_last(path):
    """x (n, 3), v, rho, h, p by ID"""
    a = read_dump(path).table
    return a[:, 1:4], a[:, 4], a[:, 5], a[:, 6], a[:, 7]


def number(x, h, box, kernel, dim):
    """n_i = sum_j W(x_ij, h_i) over all particles, i itself and images included"""
    y = x[:, :dim] % box[:dim]
    tree, w0 = cKDTree(y, boxsize=box[:dim]), norm(kernel, dim)
    out = np.empty(len(x))
    for i, near in enumerate(tree.query_ball_point(y, SUPPORT[kernel] * h)):
        d = y[near] - y[i]
        d -= box[:dim] * np.round(d / box[:dim])
        out[i] = w0 / h[i] ** dim * shape(kernel, np.sqrt((d**2).sum(1)) / h[i])[0].sum()
    return out


# ------------------------------------------------------------------ behind shocks


def collide(lmp, tmp_path, dim, nx, rows, words, jitter=0.0, gamma=5 / 3, u=1.0, eta=1.2, hmin=0.2):
    """two streams of gas meet at x = nx: compression 1.89. Behind the shocks: rho/(m n), rho/exact, p/exact, h/(h0 (rho0/rho)^(1/dim))"""
    x = lattice(0.0, [2 * nx] + [rows] * (dim - 1), (1.0, 1.0))
    x[:, :dim] += np.random.default_rng(1).uniform(-jitter, jitter, (len(x), dim))
    v = np.zeros_like(x)
    v[:, 0] = np.where(x[:, 0] < nx, u, -u)
    S = 0.25 * (gamma + 1) * u + np.sqrt((0.25 * (gamma + 1) * u) ** 2 + gamma)  # of the shock, in the gas ahead, where p = rho = 1
    box = np.array([2.0 * nx] + [rows] * (dim - 1) + [20.0] * (3 - dim), float)
    n = len(x)
    s = Fluid(x, v, np.ones(n), np.full(n, 1 / (gamma - 1)), np.ones(n, int), {1: 1.0}, {1: eta}, box, (True,) * 3, dim)
    pair = f"pair_style hvi/sph cubic dim {dim} {words} h variable {hmin} 1.5\npair_coeff * * eos idealgas {gamma!r} h {eta}\n"
    t = 0.5 * nx / S
    lmp(scene(s, tmp_path / "s.data", pair) + UNTIL.format(t) + "run 100000\n" + DUMP.format(tmp_path / "last"))
    x, v, rho, h, p = read_last(tmp_path / "last")
    depth = np.abs(x[:, 0] - nx) / ((S - u) * t)
    behind, middle = (depth > 0.25) & (depth < 0.75), depth < 0.15
    ratio = rho / number(x, h, box, "cubic", dim)
    follows = h / (eta * rho ** (-1 / dim))
    assert behind.sum() > 20
    return dict(ratio=ratio[behind], middle=ratio[middle], rho=rho[behind].mean() * (S - u) / S,
                p=p[behind].mean() / (1 + S * u), h=follows[behind], compression=rho[behind].mean())


@pytest.mark.parametrize("dim, nx, rows", [(1, 150, 1), (2, 50, 10), (3, 24, 6)])
def test_density_and_h_behind_shocks(lmp, tmp_path, dim, nx, rows):
    """rho against m n of the actual places: riemann to 0.5 % in the mean, to 1 % for each particle (3D: 2 %, where the lattice breaks up);
    monaghan is 1.5 % off in 1D, auto 1.4 % in 2D and 3D. h is what rho says. The pair of particles that met first keeps an error."""
    got = {name: collide(lmp, tmp_path, dim, nx, rows, words) for name, words in DISSIPATIONS.items()}
    for name, g in got.items():
        print(f"{dim}D {name:9} rho/(m n): mean {g['ratio'].mean():.4f} min {g['ratio'].min():.4f} max {g['ratio'].max():.4f}, in the middle "
              f"{g['middle'].min():.3f} to {g['middle'].max():.3f}; rho/exact {g['rho']:.4f} p/exact {g['p']:.4f}")
        assert np.abs(g["h"] - 1).max() < 1e-12
        assert 1.8 < g["compression"] < 1.95 and abs(g["ratio"].mean() - 1) < 0.02
    g = got["riemann"]
    assert abs(g["ratio"].mean() - 1) < 0.005 and np.abs(g["ratio"] - 1).max() < (0.02 if dim == 3 else 0.01)
    assert g["rho"] == pytest.approx(1, abs=0.015) and g["p"] == pytest.approx(1, abs=0.015)
    assert (abs(got["monaghan"]["ratio"].mean() - 1) > 0.01) == (dim == 1)


# ------------------------------------------------------------------ unequal spacings


def two_spacings(lmp, tmp_path, dim, nx, rows, words, t, mach=None, gamma=1.4, eta=1.2, ratio=4, dense=1.0):
    """fine in 0 < x < 2, ratio times as coarse and of density dense in 2 < x < 4, periodic, p = 1/gamma, rho = c = 1 in the fine one

    A shock of that mach starts at x = 1.5. Of p and v where the fine and the coarse gas are behind it: the mean over exact.
    """
    fine, p, rho, up = 1.0 / nx, 1.0, 1.0, 0.0
    parts = [lattice(0.0, [2 * nx] + [ratio * rows] * (dim - 1), (fine, fine))]
    if mach:
        (rho, up, p), _ = gas.shock((1.0, 0.0, 1.0 / gamma), mach, gamma)
        p *= gamma
        count = int(round(1.4 * rho * nx))
        start = 1.5 - count * fine / rho
        parts[0] = parts[0][(parts[0][:, 0] < start) | (parts[0][:, 0] > 1.5)]
        parts.append(lattice(start, [count] + [ratio * rows] * (dim - 1), (fine / rho, fine)))
    parts.append(lattice(2.0, [2 * nx // ratio] + [rows] * (dim - 1), (ratio * fine, ratio * fine)))
    x, part = np.concatenate(parts), np.repeat(np.arange(len(parts)), [len(a) for a in parts])
    pushed, kind = (part == 1) & bool(mach), np.where(part == len(parts) - 1, 2, 1)
    v = np.zeros_like(x)
    v[:, 0] = np.where(pushed, up, 0.0)
    mass = {1: fine**dim, 2: dense * (ratio * fine) ** dim}
    density = np.where(pushed, rho, np.where(kind == 2, dense, 1.0))
    e = np.where(pushed, p, 1.0) / density / gamma / (gamma - 1)
    box = np.array([4.0] + [ratio * rows * fine] * (dim - 1) + [80 * fine] * (3 - dim))
    s = Fluid(x, v, density, e * np.array([mass[k] for k in kind]), kind, mass, {1: eta * fine, 2: ratio * eta * fine}, box, (True,) * 3, dim)
    pair = f"pair_style hvi/sph cubic dim {dim} {words} h variable\npair_coeff 1 2 tension yes\n"
    pair += "".join(f"pair_coeff {k} {k} eos idealgas {gamma} h {s.h[k]}\n" for k in (1, 2))
    text = scene(s, tmp_path / "s.data", pair, skin=0.3 * fine) + UNTIL.format(t)
    text += "variable speed atom sqrt(vx*vx+vy*vy+vz*vz)\ncompute fastest all reduce max v_speed\ncompute book all hvi/energy\n"
    text += "thermo_style custom step v_t c_fastest c_book[9]\nrun 100000\n" + DUMP.format(tmp_path / "last")
    thermo = lmp(text).thermo
    x, v, rho, h, p = read_last(tmp_path / "last")
    out = dict(thermo=thermo, x=x[:, 0], v=v, rho=rho / np.where(kind == 2, dense, 1.0), p=gamma * p)
    if mach:
        behind, ahead = gas.shock((1.0, 0.0, 1.0 / gamma), mach, gamma)[0], (dense, 0.0, 1.0 / gamma)
        star, u = (float(a) for a in gas.star(behind, ahead, gamma))
        since = t - 0.5 / mach
        contact, front = 2.0 + u * since, 2.0 + since * (star - 1.0 / gamma) / (dense * u)
        # the start of the shock leaves a wiggle in what was at x = 1.5; the front is as wide as coarse particles make it
        where = {"fine": (kind == 1) & (x[:, 0] > 1.6 + up * t) & (x[:, 0] < contact),
                 "coarse": (kind == 2) & (x[:, 0] < contact + 0.6 * (front - contact))}
        assert all(k.sum() > 2 for k in where.values())
        out["jumps"] = {name: ((p[k].mean() - 1 / gamma) / (star - 1 / gamma), v[k].mean() / u) for name, k in where.items()}
    return out


@pytest.mark.each_value
@pytest.mark.parametrize("ratio", [2, 4])
@pytest.mark.parametrize("dim, nx, rows", [(1, 100, 1), (2, 40, 4)])
def test_unequal_spacings_at_rest(lmp, tmp_path, dim, nx, rows, ratio):
    """it does not stay at rest: particles next to the interface find new places, with ratio 4 at up to 0.13 c with monaghan, 0.06 c with riemann,
    and come to rest; their densities stay within 16 % and 1.5 %"""
    for name, words in DISSIPATIONS.items():
        g = two_spacings(lmp, tmp_path, dim, nx, rows, words, 2.0, ratio=ratio)
        speed, energy = g["thermo"]["c_fastest"], g["thermo"]["c_book[9]"]
        print(f"{dim}D ratio {ratio} {name:9} largest speed/c {speed.max():.3f}, at the end {speed[-1]:.3f}; rho {g['rho'].min():.3f} to "
              f"{g['rho'].max():.3f}, p {g['p'].min():.3f} to {g['p'].max():.3f}, largest errors {100 * np.abs(g['rho'] - 1).max():.2f} % and "
              f"{100 * np.abs(g['p'] - 1).max():.2f} %; energy {np.abs(energy - 1).max():.1e}")
        assert speed.max() < (0.07 if name == "riemann" else 0.13) and speed[-1] < 0.25 * speed.max() + 0.005
        low, high = (0.97, 1.03) if name == "riemann" else (0.75, 1.15)
        assert all(low < g[k].min() and g[k].max() < high for k in ("p", "rho")), name
        assert np.abs(energy - 1).max() < 1e-4, name


@pytest.mark.parametrize("name, dim, nx, rows, ratio, dense", [("monaghan", 1, 100, 1, 4, 1.0), ("monaghan", 2, 64, 3, 4, 1.0)] + [
    ("riemann", dim, nx, rows, ratio, dense) for dim, nx, rows in ((1, 100, 1), (2, 64, 3)) for ratio in (2, 4) for dense in (1.0, 4.0, 0.25)] + [
    ("riemann", 2, 64, 6, 1, 1.0)])
def test_shock_into_coarser(lmp, tmp_path, name, dim, nx, rows, ratio, dense):
    """a shock of Mach 1.2 goes on with the same jumps in the same gas, and leaves those of the exact Riemann problem in a denser or lighter
    one: riemann to 4.2 %, monaghan to 5 % in the same gas"""
    g = two_spacings(lmp, tmp_path, dim, nx, rows, DISSIPATIONS[name], 1.2, mach=1.2, ratio=ratio, dense=dense)
    jumps = g["jumps"]
    worst = 100 * np.abs(np.array(list(jumps.values())) - 1).max()
    WORST[name, ratio == 1] = max(worst, WORST.get((name, ratio == 1), 0))
    print(f"{name} {'equal' if ratio == 1 else 'unequal'}, largest error so far {WORST[name, ratio == 1]:.2f} %")
    print(f"\n{dim}D ratio {ratio} dense {dense} {name} errors of jumps of p, u, %:", *(f"{where} {100 * a - 100:.1f} {100 * b - 100:.1f}" for where, (a, b) in jumps.items()))
    off = 0.05 if name == "riemann" else 0.08
    assert jumps["fine"] == pytest.approx((1, 1), abs=off)
    assert jumps["coarse"] == pytest.approx((1, 1), abs=off)


# ------------------------------------------------------------------ neighbor lists


EVERY = """compute R all property/atom drho desph rho esph
compute H all hvi/atom h
dump d all custom 1 {0} id x y z vx vy vz fx fy fz c_R[1] c_R[2] c_R[3] c_R[4] c_H
dump_modify d format float %.17g sort id
"""


@pytest.mark.each_value
@pytest.mark.parametrize("neigh", ["delay 5 every 5 check yes", "delay 0 every 1 check yes"])
@pytest.mark.parametrize("name", ["monaghan", "riemann"])
@pytest.mark.parametrize("types", [1, 2])
def test_lists_are_long_enough(lmp, tmp_path, name, neigh, types):
    """a hot ball blows up in cold gas: rates and forces at a step are those of all pairs, found by brute force, so none is missed

    Two types: half of the gas is in particles of 5/3 of the spacing and h, the ball is at their interface. The state that rates belong to is that
    of the step before, extrapolated. One pair left out shows in two particles.
    """
    limits, dt, skin, steps = (0.5, 1.5), 0.01, 0.6, 160
    if types == 1:
        s, wide = random_fluid(9, jitter=0.1, seed=4, types=1, speed=0.0, h=1.2), {1: 1.2}
    else:
        x = np.concatenate([lattice(0.0, [5, 10, 10], (1.0, 1.0)), lattice(5.0, [3, 6, 6], (5 / 3, 5 / 3))])
        kind = np.where(x[:, 0] < 5, 1, 2)
        wide = {1: 1.0, 2: 5 / 3}
        x += 0.1 * np.random.default_rng(4).uniform(-1, 1, x.shape)
        s = Fluid(x, 0 * x, np.ones(len(x)), np.ones(len(x)), kind, {1: 1.0, 2: (5 / 3) ** 3}, wide, np.full(3, 10.0))
    H, box = np.array([wide[k] for k in s.type]), s.box[0]
    s.rho[:] = 1.0
    hot = ((s.x - 0.5 * box) ** 2).sum(1) < (2.3 if types == 1 else 3.0) ** 2
    s.esph = np.where(hot, 30.0, 1.0) / (1.4 * 0.4) * s.m
    pair = f"pair_style hvi/sph cubic {DISSIPATIONS[name]} h variable {limits[0]} {limits[1]}\n"
    pair += "".join(f"pair_coeff {k} {k} eos idealgas 1.4 h {h:.17g}\n" for k, h in wide.items())
    pair += "pair_coeff 1 2 tension yes\n" if types == 2 else ""
    text = scene(s, tmp_path / "s.data", pair, skin=skin).replace("every 1 delay 0 check yes", neigh)
    result = lmp(text + f"timestep {dt}\n" + EVERY.format(tmp_path / "all") + f"run {steps}\n")
    builds, dangerous = (int(re.search(rf"^{words} = (\d+)", result.log, re.M).group(1)) for words in ("Neighbor list builds", "Dangerous builds"))
    assert 3 <= builds < steps / 4 and dangerous == 0
    frame = {f.step: f for f in frames(tmp_path / "all")}
    solve = riemann_rates if name == "riemann" else rates
    grown = 0
    for step in (24, 49, 74, 99, 124, 149, 157):
        before, now = frame[step - 1], frame[step]
        column = lambda f, names: np.stack([f[k] for k in names.split()], 1)
        s.x = column(now, "x y z")
        s.v = column(before, "vx vy vz") + dt * column(before, "fx fy fz") / s.m[:, None]
        s.rho = before["c_R[3]"] + dt * before["c_R[1]"]
        s.esph = before["c_R[4]"] + dt * before["c_R[2]"]
        h = H * np.clip(s.rho ** (-1 / 3), *limits)
        more = dict(follows=(h > H * limits[0]) & (h < H * limits[1])) if name == "riemann" else {}
        want = solve(s, dict.fromkeys(wide, ideal_gas(1.4)), "cubic", h=h, **more)
        for key, got in (("f", column(now, "fx fy fz")), ("drho", now["c_R[1]"]), ("de", now["c_R[2]"])):
            wrong = np.abs(got - want[key]) > 1e-10 * np.abs(want[key]).max()
            assert wrong.sum() == 0, (step, key)
        i, j = np.triu_indices(len(h), 1)
        d = s.x[i] - s.x[j]
        r = np.sqrt(((d - box * np.round(d / box)) ** 2).sum(1))
        start, follows = 0.5 * (H[i] + H[j]), h / H
        reach = 2 * (start * np.maximum(follows[i], follows[j]) if name == "riemann" else 0.5 * (h[i] + h[j]))
        grown += (r < reach)[r > 2 * start + skin].sum()
    print(f"{name:9} {neigh}: builds {builds}, pairs beyond reach and skin of the start: {grown}, h {h.min():.2f} to {h.max():.2f}")
    assert grown > 100  # a list for h of the start would miss them
