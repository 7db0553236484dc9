"""The references for standard shocks (reference/gas.py, reference/impedance.py) against published states, conservation, the jump
conditions, and each other. No LAMMPS in here."""

import numpy as np
import pytest
from reference import gas, impedance

pytestmark = pytest.mark.long  # what they test changes with tests/reference only

PROBLEMS = {  # Toro's book, Sjoegreen's problem besides: left, right, p, u, rho on both sides of the contact
    "sod": ((1, 0, 1), (0.125, 0, 0.1), 0.303130, 0.927453, (0.426319, 0.265574)),
    "left blast": ((1, 0, 1000), (1, 0, 0.01), 460.894, 19.5975, (0.575062, 5.99924)),
    "right blast": ((1, 0, 0.01), (1, 0, 100), 46.0950, -6.19633, (5.99242, 0.575113)),
    "sjoegreen": ((1, -2, 0.4), (1, 2, 0.4), 0.00189387, 0.0, (0.0218521, 0.0218521)),
    "stock": ((1, 0, 1), (0.25, 0, 0.25), 0.4821156, 0.5855558, (0.5938536, 0.3963812)),  # exact_solution.dat of the package SPH
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_star_states(name):
    left, right, p, u, rho = PROBLEMS[name]
    ps, us = gas.star(left, right)
    assert (ps, us) == pytest.approx((p, u), rel=3e-6, abs=1e-9)
    beside = gas.sample([us - 1e-9, us + 1e-9], left, right)
    assert beside[0] == pytest.approx(rho, rel=3e-6)
    assert beside[1:] == pytest.approx(np.array([[u, u], [p, p]]), rel=3e-6, abs=1e-8)


@pytest.mark.parametrize("name", PROBLEMS)
def test_profiles_of_riemann_problems(name):
    """between the waves: the ends and the star states; in fans the characteristic u -+ c has the speed s, entropy and the
    invariant u +- 2c/(gamma - 1) are those of the gas ahead; through shocks mass, momentum and energy are kept"""
    gamma = 1.4
    left, right = PROBLEMS[name][:2]
    ps, us = gas.star(left, right, gamma)
    far = abs(us) + abs(left[1]) + abs(right[1]) + 2 * max(gas.sound(left, gamma), gas.sound(right, gamma)) * np.sqrt(max(1, ps / min(left[2], right[2])))
    for ahead, sign in ((left, -1), (right, 1)):  # the wave that goes to this side
        s = us + sign * np.linspace(1e-9, far, 200001)
        rho, u, p = gas.sample(s, left, right, gamma)
        assert [rho[-1], u[-1], p[-1]] == pytest.approx(ahead, rel=1e-14)
        c = np.sqrt(gamma * p / rho)
        moved = np.flatnonzero(np.diff(p))
        if ps > ahead[2]:
            assert len(moved) == 1, sign  # one jump
            k = moved[0]
            speed = 0.5 * (s[k] + s[k + 1])
            kept = [np.array([r, r * v, 0.5 * r * v * v + q / (gamma - 1)]) for r, v, q in ((rho[k], u[k], p[k]), ahead)]
            jump = flux((rho[k], u[k], p[k]), gamma) - flux(ahead, gamma)
            assert jump == pytest.approx(speed * (kept[0] - kept[1]), rel=1e-3, abs=1e-6 * abs(jump).max()), sign
        else:
            fan = slice(moved[0] + 1, moved[-1])
            assert len(s[fan]) > 100, sign
            assert u[fan] + sign * c[fan] == pytest.approx(s[fan], rel=1e-9, abs=1e-9)
            assert p / rho**gamma == pytest.approx(np.full(len(p), ahead[2] / ahead[0]**gamma), rel=1e-9)
            assert u - sign * 2 * c / (gamma - 1) == pytest.approx(
                np.full(len(u), ahead[1] - sign * 2 * gas.sound(ahead, gamma) / (gamma - 1)), rel=1e-9, abs=1e-8)


def totals(solution, lo, hi, t, gamma, n=400000):
    x = lo + (np.arange(n) + 0.5) * (hi - lo) / n
    rho, u, p = solution.at(x, t)
    return np.array([rho, rho * u, 0.5 * rho * u * u + p / (gamma - 1)]).sum(1) * (hi - lo) / n


def flux(state, gamma):
    rho, u, p = state
    return np.array([rho * u, rho * u * u + p, u * (0.5 * rho * u * u + gamma / (gamma - 1) * p)])


@pytest.mark.parametrize("name", PROBLEMS)
def test_riemann_conserves(name):
    """mass, momentum and energy of all waves: what was there and what has come in at the ends"""
    left, right = PROBLEMS[name][:2]
    s, t = gas.Riemann(left, right, 0.0), 0.01
    change = totals(s, -1, 1, t, 1.4) - totals(s, -1, 1, 0.0, 1.4)
    came = t * (flux(left, 1.4) - flux(right, 1.4))
    assert change == pytest.approx(came, rel=2e-3, abs=2e-5 * max(left[2], right[2]) + 1e-5)


@pytest.mark.parametrize("ratio", [10, 100])
def test_shock_on_a_dense_gas(ratio):
    """before and after the shock is at the interface; the shock obeys the jump conditions; a limit: a wall"""
    s = gas.ShockOnDense(ratio)
    jump = flux(s.behind, 1.4) - flux(s.light, 1.4)
    inside = [np.array([rho, rho * u, 0.5 * rho * u * u + p / 0.4]) for rho, u, p in (s.behind, s.light)]
    assert jump == pytest.approx(s.speed * (inside[0] - inside[1]), rel=1e-12)
    for t in (0.5 * s.hit, 0.15):
        change = totals(s, -2, 2, t, 1.4) - totals(s, -2, 2, 0.0, 1.4)
        assert change == pytest.approx(t * (flux(s.behind, 1.4) - flux(s.dense, 1.4)), rel=2e-4, abs=2e-3)
    p, u = gas.star(s.behind, s.dense)
    assert p > s.behind[2] and -u < -s.light[1]
    wall = gas.star(s.behind, (1e9, s.light[1], 1.0))[0]
    assert p < wall


@pytest.mark.parametrize("dim, rho", [(1, 4), (2, 16), (3, 64)])
def test_noh(dim, rho):
    """Noh's solution: rho 4/16/64, shock at t/3; mass and energy of the gas that was within 1"""
    s, t = gas.Noh(dim), 0.6
    n, edge = 400000, 1 - t
    r = (np.arange(n) + 0.5) * edge / n
    q = s.at(r, t)
    assert q[0][0] == pytest.approx(rho) and s.speed == pytest.approx(1 / 3)
    assert r[np.flatnonzero(q[1] < 0)[0]] == pytest.approx(t / 3, abs=1e-5)
    shell = r ** (dim - 1) * edge / n
    assert np.sum(q[0] * shell) == pytest.approx(1 / dim, rel=1e-4)
    assert np.sum((0.5 * q[0] * q[1] ** 2 + 1.5 * q[2]) * shell) == pytest.approx(0.5 / dim, rel=1e-4)


@pytest.mark.parametrize("dim, energy, radius", [(1, 2, 1.491374), (2, 1, 1.153787), (3, 1, 1.151666)])
def test_sedov(dim, energy, radius):
    """the radii 1.491374, 1.153787, 1.151666 at t = 1 belong to 1, 2 and 3 dimensions in this order, the first to energy 1 on either side, 2 in all"""
    s = gas.Sedov(dim, energy)
    assert s.radius(1.0) == pytest.approx(radius, abs=6e-7)
    assert dim * s.integral(s.g * s.lam**dim) == pytest.approx(1, abs=1e-6)  # all mass
    n = 400000
    r = (np.arange(n) + 0.5) * 1.01 * radius / n
    rho, u, p = s.at(r, 1.0)
    assert s.area * np.sum((0.5 * rho * u * u + 1.5 * p) * r ** (dim - 1)) * 1.01 * radius / n == pytest.approx(energy, rel=1e-4)
    front = s.delta * radius  # strong shock
    behind = s.at(np.array([s.radius(1.0) * (1 - 1e-9)]), 1.0)[:, 0]
    assert behind == pytest.approx((4, 0.75 * front, 0.75 * front**2), rel=1e-5)


def test_lagrange_on_sod_and_blasts():
    """first order in the mean with shocks: against the exact Riemann problem"""
    for left, right, t in (((1, 0, 1), (0.125, 0, 0.1), 0.2), ((1, 0, 1000), (1, 0, 0.01), 0.012)):
        errors = []
        for n in (100, 200, 400):
            x = np.linspace(0, 1, n + 1)
            states = np.where(0.5 * (x[1:] + x[:-1]) < 0.5, np.array(left)[:, None], np.array(right)[:, None])
            s = gas.lagrange(x, *states, t)
            exact = gas.Riemann(left, right).at(0.5 * (s.x[1:] + s.x[:-1]), t)
            errors.append([np.sum(np.abs(a - b) * np.diff(s.x)) / np.ptp(b) for a, b in zip((s.rho, s.u, s.p), exact)])
            assert s.dm.sum() == pytest.approx(0.5 * (left[0] + right[0]))
            energy = np.sum(s.dm * (0.5 * s.u**2 + s.p / s.rho / 0.4))
            assert energy == pytest.approx(0.5 * (left[2] + right[2]) / 0.4, rel=1e-12)
        order = np.log2(np.array(errors[:-1]) / errors[1:])
        assert np.all(order.mean(axis=0) > 0.75), (errors, order)
        assert max(errors[-1]) < 0.02, t


@pytest.mark.long
def test_woodward_colella_converges_to_itself():
    """L1 between n and 2 n cells halves; peak of the density 6.3 to 6.7 near x = 0.78 and of the velocity near 14, as in Woodward & Colella"""
    runs = [gas.woodward_colella(n) for n in (200, 400, 800)]
    difference = []
    for a, b in zip(runs[:-1], runs[1:]):
        m = b.dm.reshape(-1, 2)
        mean = [(np.array(q).reshape(-1, 2) * m).sum(1) / m.sum(1) for q in (b.rho, b.u, b.p)]
        difference.append([np.sum(np.abs(p - q) * np.diff(a.x)) / np.ptp(q) for p, q in zip((a.rho, a.u, a.p), mean)])
    order = np.log2(np.array(difference[0]) / difference[1])
    assert np.all(order[1:] > 0.7) and order[0] > 0.4, (difference, order)
    assert max(difference[1][1:]) < 0.01
    s = runs[-1]
    middle = 0.5 * (s.x[1:] + s.x[:-1])
    assert s.rho[(middle > 0.775) & (middle < 0.785)].max() == pytest.approx(6.5, abs=0.2)
    assert s.u.max() == pytest.approx(13.9, abs=0.3)


# ------------------------------------------------------------------ plates and sound


FLYERS = {500: (3.777, 2829.5), 1000: (8.028, 2951.4), 2000: (17.948, 3182.3), 3000: (29.760, 3397.3), 5000: (59.061, 3785.9),
          5941: (75.465, 3952.1), 6700: (89.917, 4079.1), 7000: (95.929, 4127.8), 10000: (165.424, 4569.7)}  # GPa, kg/m^3: P = rho0 Us u, Us = c0 + s u, u = V/2


@pytest.mark.parametrize("speed", FLYERS)
def test_symmetric_flyers(speed):
    u, p = impedance.match(impedance.AL6061, impedance.AL6061, speed)
    assert u == pytest.approx(speed / 2, rel=1e-12)
    assert p / 1e9 == pytest.approx(FLYERS[speed][0], abs=6e-4) and impedance.AL6061.density(u) == pytest.approx(FLYERS[speed][1], abs=0.06)


def test_asymmetric_flyer():
    """jump conditions; the same pressure from both Hugoniots; exchanged plates: the same pressure"""
    u, p = impedance.match(impedance.AL2024, impedance.COPPER, 5750.0)
    assert (u, p / 1e9) == pytest.approx((1880.7, 113.20), abs=0.05)
    assert impedance.AL2024.pressure(5750 - u) == pytest.approx(p, rel=1e-12)
    assert impedance.match(impedance.COPPER, impedance.AL2024, 5750.0) == pytest.approx((5750 - u, p), rel=1e-9)


def test_flyer_profile_conserves():
    for flyer, target in ((impedance.AL6061,) * 2, (impedance.AL2024, impedance.COPPER)):
        s = impedance.Flyer(flyer, target, 5750.0, 0.01)
        dm, rho, u, p = s.at_mass(0.7 * s.last)
        assert dm.sum() == pytest.approx(0.01 * (flyer.rho0 + target.rho0)) and np.all(dm > 0)
        assert np.sum(dm * u) == pytest.approx(0.01 * flyer.rho0 * 5750.0)
        gained = 0.5 * p * (1 / np.array([flyer.rho0] * 2 + [target.rho0] * 2) - 1 / rho)  # Hugoniot
        assert np.sum(dm * (0.5 * u * u + gained)) == pytest.approx(0.5 * 0.01 * flyer.rho0 * 5750.0**2)


def test_sound_at_a_step():
    """continuous pressure and velocity at the step; momentum and energy of the three pulses"""
    s = impedance.Pulse()
    assert (s.r, s.t) == pytest.approx((0.5, 1.5)) and impedance.coefficients(2.0, 2.0) == (0.0, 1.0)
    for t in (0.4, 0.5, 0.6):
        a, b = s.at(np.array([-1e-9, 1e-9]), t).T
        assert a[1:] == pytest.approx(b[1:], rel=1e-6, abs=1e-12), t
    x = np.linspace(-1.5, 1.5, 600001)
    rest = np.where(x < 0, s.first[0], s.second[0])
    c = np.where(x < 0, s.first[1], s.second[1])
    before, after = ([np.sum(rest * u), np.sum(0.5 * rest * u * u + 0.5 * p * p / rest / c**2)] for _, u, p in (s.at(x, 0.0), s.at(x, 0.8)))
    assert after == pytest.approx(before, rel=1e-4)
