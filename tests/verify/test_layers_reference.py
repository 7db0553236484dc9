"""The references for layered shocks against exact states, each other and conservation; the SPH prototype against numbers
measured with an independent code (equations.md section 1). No LAMMPS in here."""

import numpy as np
import pytest
from reference import fronts, layers, rule, sph1d

pytestmark = pytest.mark.long  # what they test changes with tests/reference only

ALPHA, BETA = layers.laminate()[1:3]


def body(lo, hi, u, rho0=1.0, K=1.0, number=0):
    return layers.Layer("", lo, hi, rho0, K, u, number)


# ------------------------------------------------------------------ Riemann problem


@pytest.mark.parametrize("other, p, dL, dR, u", [(ALPHA, 0.640388, 1.640388, 1.640388, 0.5),
                                                 (BETA, 0.599594, 1.599594, 1.299797, 0.525919)])
def test_exact_states(other, p, dL, dR, u):
    """from the jump conditions: alpha at speed 1 on a target at rest"""
    star = layers.riemann(0.0, 1.0, ALPHA.K, ALPHA.c, 0.0, 0.0, other.K, other.c)
    assert star == pytest.approx((p, u), abs=6e-7)
    assert (1 + star[0] / ALPHA.K, 1 + star[0] / other.K) == pytest.approx((dL, dR), abs=6e-7)
    a, b = fronts.Material(ALPHA, 0), fronts.Material(other, 1)
    assert fronts.riemann((0.0, 1.0), a, (0.0, 0.0), b) == pytest.approx(star, rel=1e-14)


def test_waves_obey_the_jump_conditions_and_the_integral_of_rarefactions():
    """random states, compressed and stretched, of different materials: [p][tau] = -[u]^2, or du = dp/(rho c) by quadrature"""
    rng = np.random.default_rng(1)
    n = 300
    K, c = np.exp(rng.uniform(-2, 2, (2, n))), np.exp(rng.uniform(-1, 1, (2, n)))
    p, u = K * rng.uniform(-0.6, 3, (2, n)), rng.normal(0, 1, (2, n))
    ps, us = layers.riemann(p[0], u[0], K[0], c[0], p[1], u[1], K[1], c[1])
    nodes, weights = np.polynomial.legendre.leggauss(200)
    assert np.all(np.isfinite(ps)) and np.all(ps > -np.min(K, axis=0))
    shocks = 0
    for k, side in ((0, -1), (1, 1)):
        du = side * (us - u[k])  # across the wave, > 0 in a shock
        shock = ps > p[k]
        shocks += np.sum(shock)
        dtau = c[k]**2 / (ps + K[k]) - c[k]**2 / (p[k] + K[k])
        assert ((ps - p[k]) * dtau)[shock] == pytest.approx(-(du**2)[shock], rel=1e-8, abs=1e-13)
        assert np.all(du[shock] > 0), side
        q = 0.5 * (p[k] + ps) + 0.5 * (ps - p[k]) * nodes[:, None]
        integral = 0.5 * (ps - p[k]) * (weights[:, None] * c[k] / (q + K[k])).sum(axis=0)  # rho c = (p + K)/c
        mild = ~shock & ((ps + K[k]) / (p[k] + K[k]) > 1e-2)  # the quadrature cannot do more
        assert np.sum(mild) > 50, side
        assert du[mild] == pytest.approx(integral[mild], rel=1e-9, abs=1e-13), side
    assert 100 < shocks < 2 * n - 100


# ------------------------------------------------------------------ Godunov scheme


def test_godunov_converges_with_second_order_in_a_simple_wave():
    """a compression pulse that runs to the right through one material: p is constant along dm/dt = rho c"""
    def pressure(m):
        return 0.5 * np.where(np.abs(m - 0.6) < 0.4, np.cos(np.pi * (m - 0.6) / 0.8)**4, 0.0)

    t, fine = 0.25, np.linspace(0, 2, 400001)
    there = fine + (1 + pressure(fine)) * t
    assert np.all(np.diff(there) > 0)  # not yet a shock
    errors = []
    for cells in (100, 200, 400):
        s = layers.solve([body(0, 2, 0.0)], t, cells, start=lambda m: (pressure(m), np.log1p(pressure(m))))
        errors.append(np.mean(np.abs(s.p - np.interp(s.m, there, pressure(fine)))))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(order > 1.8), (errors, order)
    assert errors[-1] < 1e-4


def test_godunov_keeps_momentum_and_length():
    """to round-off, with gap, contact and separation; the lengths of bodies follow from cells and from the ways of their ends"""
    s = layers.solve(layers.laminate((2.0, 1.0, 0.5), (1.0, 1.0, 0.25), gap=0.05), 0.75, 300)
    momentum, volume, length = s.after - s.before
    assert abs(momentum) < 1e-14 * len(s.times)
    assert volume == pytest.approx(length, abs=1e-14 * len(s.times))
    assert abs(volume) > 0.02


def test_free_flight_and_rest_stay_exact():
    s = layers.solve(layers.laminate(gap=0.3), 0.2, 200)
    assert np.all(s.p == 0) and np.all(np.abs(s.u) == 0.5)
    t = fronts.Tracking(layers.laminate(gap=0.3), 0.2)
    x, u, p, rho, material = t.at(0.2, s.m)
    assert x == pytest.approx(s.x, abs=1e-13) and np.all(p == 0) and np.all(np.abs(u) == 0.5)


# ------------------------------------------------------------------ front tracking, and both against each other


def difference(case, t, cells, step, gap):
    """mean |difference| of x, u, p between both methods, u and p as part of their range"""
    stack = layers.CASES[case](gap=gap)
    s, f = layers.solve(stack, t, cells), fronts.Tracking(stack, t, step)
    x, u, p, rho, _ = f.at(t, s.m)
    return np.array([np.mean(np.abs(s.x - x)), np.mean(np.abs(s.u - u)) / np.ptp(u), np.mean(np.abs(s.p - p)) / np.ptp(p)])


@pytest.mark.parametrize("case, gap", [("test", 0.0), ("test", 0.1), *(pytest.param(*one, marks=pytest.mark.long) for one in (
    ("al_glass_al", 0.0), ("al_carbon_al", 0.0), ("st_carbon_st", 0.0))), ("st_glass_st", 0.1)])
def test_both_methods_agree(case, gap):
    """all waves of the paper's cases to t = 0.75; a shock costs the scheme some two cells"""
    coarse, fine = difference(case, 0.75, 400, 0.005, gap), difference(case, 0.75, 800, 0.005, gap)
    assert fine[0] < 2e-4
    assert np.all(fine[1:] < 6e-3), fine
    assert np.all(fine < 0.75 * coarse), (coarse, fine)


def test_front_tracking_converges():
    """x with second order in the size of stairs, u and p between first and second where fans cross"""
    stack = layers.laminate()
    m = (np.arange(5000) + 0.5) / 5000 * sum(a.mass for a in stack)
    runs = [fronts.Tracking(stack, 0.75, step).at(0.75, m) for step in (0.04, 0.02, 0.01, 0.0025)]
    error = np.array([[np.mean(np.abs(a - b)) for a, b in zip(r[:3], runs[-1][:3])] for r in runs[:-1]])
    assert np.all(error[0, 0] / error[2, 0] > 10)
    assert np.all(error[0] / error[2] > 3.5), error
    assert np.all(error[2] < 2e-3), error


def test_front_tracking_keeps_momentum_and_length():
    stack = layers.laminate((2.0, 1.0, 0.5), (1.0, 1.0, 0.25), gap=0.05)
    f = fronts.Tracking(stack, 0.75, 0.005)
    edge, lo, hi, p, u, *_ = f.zones(0.75)
    before = sum(a.mass * a.u for a in stack)
    assert np.sum(np.diff(edge) * u) == pytest.approx(before, abs=1e-5)
    # the right end of each body: by the lengths of zones, and by the way it has gone
    for face in (k for k, g in enumerate(f.fronts) if g.face and g.end == np.inf and g.face.a):
        front = f.fronts[face]
        here = np.flatnonzero(edge[1:] == front.m)[0]
        assert hi[here] == pytest.approx(front.x[0] + front.left[1] * (0.75 - front.t), abs=1e-9), face


def test_shock_arrives_when_it_should():
    """gauge A: the gap, then a Lagrangian shock speed c sqrt(d); behind it u* and p*"""
    stack, gap = layers.laminate(gap=0.1), 0.1
    t, u, p = fronts.Tracking(stack, 0.4).gauge(layers.gauges(stack)[0])
    arrival = gap + 0.1 / np.sqrt(1.6403882)
    assert t[1] == pytest.approx(arrival, abs=1e-7)
    assert (u[1], p[1]) == pytest.approx((0.0, 0.6403882), abs=1e-7)
    s = layers.solve(stack, 0.4, 2000, at=layers.gauges(stack))
    crossing = s.times[np.argmax(s.gauge_u[:, 0] > -0.25)]
    assert crossing == pytest.approx(arrival, abs=2e-3)


@pytest.mark.parametrize("bonded", [False, True])
def test_bodies_part_and_layers_do_not(bonded):
    """two equal plates: the releases from both ends meet at the interface, which opens, or carries tension if bonded"""
    stack = [body(0, 0.2, 0.4), body(0.2, 0.4, -0.4, number=0 if bonded else 1)]
    f = fronts.Tracking(stack, 0.6, 0.01)
    m = np.linspace(0.001, 0.399, 200)
    x, u, p, *_ = f.at(0.6, m)
    for cells, close in ((400, 1e-3), (800, 5e-4)):
        s = layers.solve(stack, 0.6, cells)
        xs, us, ps, *_ = s.at(s.t, m)
        assert np.mean(np.abs(x - xs)) < close and np.mean(np.abs(p - ps)) < 5 * close
    at_interface = [side[0] for g in f.fronts if g.face and g.face.a and g.face.b for side in (g.left, g.right)]
    gap = x[100] - x[99]
    if bonded:
        assert min(at_interface) < -0.2 and gap < 0.01
    else:
        assert min(at_interface) > -1e-14 and gap > 0.1
        assert np.mean(u[:100]) == pytest.approx(-np.mean(u[100:]), abs=1e-6) and np.mean(u[:100]) < -0.3


# ------------------------------------------------------------------ SPH prototype


@pytest.fixture(scope="module")
def impact():
    """the Test case half-way, n = 100, variable h"""
    return sph1d.run(sph1d.create(layers.laminate(gap=0.03), 100, variable=True), 0.15, 4e-4, alpha=0.3)


@pytest.mark.parametrize("alpha", [0.0, 0.5, sph1d.automatic])
def test_rates_keep_momentum_energy_and_volume(impact, alpha):
    """sum m dv = 0, sum m (v dv + de) = 0; the paper's dissipation keeps sum V drho, the automatic one the volume, sum m dtau"""
    s = impact
    dv, drho, de = sph1d.rates(s, alpha=alpha)
    scale = np.sum(s.m * np.abs(dv))
    assert scale > 1
    assert abs(np.sum(s.m * dv)) < 1e-14 * scale
    assert abs(np.sum(s.m * (s.v * dv + de))) < 1e-14 * scale
    change = drho - sph1d.rates(s, alpha=0.0)[1]
    moved = s.m / s.rho * change / (s.rho if callable(alpha) else 1.0)
    assert abs(np.sum(moved)) < 1e-13
    assert (np.abs(moved).sum() > 1e-3) == (alpha != 0.0)


@pytest.mark.parametrize("compression", [1.2, 1.05])
@pytest.mark.parametrize("v0", [0.3, 0.1])
def test_rates_of_three_particles_by_hand(compression, v0):
    """body 0: particle 0; body 1: particles 1, 2; everything written out; 0 and 2 pull if 1.05, part if 0.1"""
    from math import erf, exp, pi, sqrt
    x, v, rho, m, h = [0.0, 0.9, 2.1], [v0, -0.1, 0.2], [compression, 1.1, 0.8], [1.0, 1.5, 1.5], [1.0, 1.0, 1.3]
    K, rho0 = [2.0, 1.0, 1.0], [1.0, 1.0, 1.0]
    s = sph1d.State(*map(np.array, (x, v, rho, [0.0] * 3, h, m, rho0, K, [0, 1, 1], [0, 1, 1])))
    p, c = [2 * (compression - 1), 0.1, -0.2], [sqrt(2), 1, 1]
    dv, drho, de = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            if i == j:
                continue
            n, r, hh = np.sign(x[i] - x[j]), abs(x[i] - x[j]), 0.5 * (h[i] + h[j])
            dW = -2 * r / hh**3 / sqrt(pi) / erf(3) * exp(-(r / hh)**2)
            vn, V = (v[i] - v[j]) * n, m[j] / rho[j]
            mu = hh * vn * r / (r**2 + 0.01 * hh**2)
            q = rho[i] * rho[j] / (0.5 * (rho[i] + rho[j])) * (-0.5 * (c[i] + c[j]) * mu + 2 * mu**2) if vn < 0 else 0.0
            pull = 0.0 if (i == 0) != (j == 0) and p[i] + p[j] <= 0 else 1.0
            dv[i] -= V * (pull * (p[i] + p[j]) + q) * n * dW / rho[i]
            if pull or vn < 0:
                drho[i] += rho[i] * V * vn * dW
            drho[i] += pull * 0.3 * (p[i] - p[j]) / (0.5 * (c[i] + c[j])) * V * dW
            de[i] += V * (pull * p[i] + q / 2) * vn * dW / rho[i]
    for got, hand in zip(sph1d.rates(s, alpha=0.3), (dv, drho, de)):
        assert got == pytest.approx(hand, rel=1e-13)


def test_leapfrog_is_of_second_order():
    """positions, velocities and densities with steps dt, dt/2, dt/4, n = 50"""
    runs = []
    for dt in (4e-3, 2e-3, 1e-3, 5e-4):
        s = sph1d.run(sph1d.create(layers.laminate(), 50, variable=True), 0.16, dt, alpha=0.3)
        runs.append(np.array([s.x, s.v, s.rho]))
    change = np.array([np.abs(a - b).max(axis=1) for a, b in zip(runs[:-1], runs[1:])])
    assert np.all(np.log2(change[:-1] / change[1:]) > 1.6), change


@pytest.mark.parametrize("alpha, u, p, peak", [(0.0, 0.62, 1.44, 0.706), (0.3, 0.73, 1.61, 0.637), (0.8, 0.91, 2.5, None)])
def test_prototype_meets_the_independent_code(alpha, u, p, peak):
    """Test case, n = 400, t = 0.2: L1 errors in percent and peak pressure of equations.md. They are those with variable h."""
    stack = layers.laminate()
    s = sph1d.run(sph1d.create(stack, 400, variable=True), 0.2, 1e-4, alpha=alpha)
    error = sph1d.errors(s, fronts.Tracking(stack, 0.2), 0.2)
    assert 100 * error["u"] == pytest.approx(u, abs=0.04)
    assert 100 * error["p"] == pytest.approx(p, abs=0.07)
    if peak:
        assert s.p.max() == pytest.approx(peak, abs=6e-4)
    assert np.all(np.diff(s.x) > 0)


def test_automatic_dissipation_between_two_bodies_is_the_acoustic_riemann_solver():
    """drho_i = rho_i sum_j V_j 2 (v_i - v*).grad W, v* = (z_i v_i + z_j v_j + (p_i - p_j) n)/(z_i + z_j), but for the weights of v"""
    s = sph1d.create([body(0, 0.1, 0.0, rho0=1.0, K=2.0), body(0.1, 0.2, 0.0, rho0=0.3, K=1.0, number=1)], 10)
    s.rho *= [1.2, 1.1]
    drho = sph1d.rates(s, alpha=sph1d.automatic)[1]  # at rest: the pressures alone
    z = s.rho * s.c
    star = (s.p[0] - s.p[1]) / z.sum()  # to the right: 0 is on the left
    dW = sph1d.gradient(0.1, 0.12)
    assert drho[0] == pytest.approx(s.rho[0] * s.m[1] / s.rho[1] * 2 * (0 - star) * -dW, rel=1e-13)
    assert drho[1] == pytest.approx(s.rho[1] * s.m[0] / s.rho[0] * 2 * (0 - star) * dW, rel=1e-13)


@pytest.mark.parametrize("family", [pytest.param("three", marks=pytest.mark.long), "strong", pytest.param("five", marks=pytest.mark.long)])
def test_automatic_dissipation_beats_the_constants_on_layers_it_was_not_made_from(family):
    """seeded random stacks: mean L1 error of p against 0.3 and 0.8, overshoot against 0.3"""
    result = rule.evaluate(family, seed=20, count=4, alphas=(0.3, 0.8, sph1d.automatic), n=100)
    small, large, auto = result["l1_p"]
    assert np.mean(auto) < 0.93 * np.mean(small) and np.mean(auto) < 0.85 * np.mean(large)
    assert np.mean(result["overshoot"][2]) < 0.8 * np.mean(result["overshoot"][0])
    assert np.sum(result["crossings"][2]) <= np.sum(result["crossings"][0])  # strong: one, whatever alpha; README of the example
