"""Spall by growth of voids: against the law's own equations, and in plate impacts (examples/spall).

Rows in one-dimensional strain. Constants are those of the material file; nothing here is fitted.
"""

import re

import numpy as np
import pytest
from hvi.jobs import measures
from reference.voids import C0, CL, RHO0, S1, SHEAR, constants, law
from solid_runs import row


def stretch(lmp, root, folder, epsdot, strain, steps=4000):
    """the same of the middle of a row, whose particles all have v = epsdot x"""
    n, a = 40, 1e-3 * 1e4 / epsdot
    s = row(n * a, n, margin=2 * n * a, rho=RHO0)
    middle = 0.5 * s.box[0]
    s.v[:, 0] = epsdot * (s.x[:, 0] - middle)
    s.write(folder / "row.data")
    return lmp(f"""units si
boundary f p p
atom_style sph
atom_modify map array
processors * 1 1
read_data row.data
pair_style hvi/sph cubic dim 1 viscosity 0 0
pair_coeff 1 1 file {root}/potentials/Al6061-T6.hvi h {1.2 * a:.17g}
neighbor {0.3 * a:.17g} bin
neigh_modify every 1 delay 0 check yes
fix solid all hvi/johnson-cook strength none damage no spall voids
fix move all hvi/sph
fix hold all setforce 0 0 0
timestep {strain / epsdot / steps:.17g}
region middle block {middle - 3 * a:.17g} {middle + 3 * a:.17g} INF INF INF INF
group middle region middle
compute S all hvi/atom p e voids void_damage spalled
compute M middle reduce ave c_S[*]
thermo 1
thermo_style custom step time c_M[*]
thermo_modify format float %.12g
run {steps}
""").thermo


@pytest.mark.parametrize("epsdot", [1e4, *(pytest.param(more, marks=pytest.mark.long) for more in (1e5, 1e6)), 1e7])
def test_stretched_at_a_constant_rate(lmp, root, tmp_path, epsdot):
    """strength, energy and strain at failure are those of the law's equations; they are near sigma (epsdot/rate)^m and sigma phi_c/2

    The part of sigma (epsdot/rate)^m that matter bears falls from 0.94 at 1e4/s to 0.86 at 1e7/s: the larger the rate, the more voids have
    opened, and damage has been done, when tension is largest.
    """
    k = constants(root)
    strength, energy, strain = law(k, epsdot)
    t = stretch(lmp, root, tmp_path, epsdot, 1.1 * strain)
    bad = np.flatnonzero(t["c_M[4]"] >= 1)[0]
    found = -t["c_M[1]"].min(), RHO0 * t["c_M[2]"][bad], epsdot * t["Time"][bad]
    scale = k["sigma"] * (epsdot / k["rate"]) ** k["m"]
    print(f"{epsdot:.0e}: law {strength:.4e} {energy:.4e} {strain:.5f}, row", [f"{v:.4e}" for v in found], "of the scale",
          strength / scale, energy / (0.5 * scale * k["phi_c"]), f"largest difference {100 * max(abs(a / b - 1) for a, b in zip(found, (strength, energy, strain))):.3f} %")
    assert found == pytest.approx((strength, energy, strain), rel=2e-3)
    assert 0.85 < strength / scale < 0.95
    assert 1.0 < energy / (0.5 * scale * k["phi_c"]) < 1.25


# plate impacts


RUNS = {}  # several tests look at the same run


@pytest.fixture
def shot(lmp, root, tmp_path):
    """result.yaml of in.spall after hvi measure, and the record: t (us), u, largest tension, push, failed particles"""

    def run(**variables):
        key = tuple(sorted(variables.items()))
        if key not in RUNS:
            folder = tmp_path / str(len(RUNS))
            folder.mkdir()
            env = {"LAMMPS_POTENTIALS": f"{root}/potentials:{root}/examples/spall"}
            lmp(root / "examples" / "spall" / "in.spall", cwd=folder, vars={**variables, "out": folder}, env=env)
            RUNS[key] = measures.measure(folder), np.loadtxt(folder / "surface.dat").T
            result = RUNS[key][0]
            print(variables, {k: result[k] for k in ("pull_back_m_s", "spall_strength_GPa", "strain_rate_per_s", "spall_plane_mm", "void_work_J_m2")})
            assert abs(result["energy_ratio"] - 1) < 1e-4 and result["momentum_error"] < 1e-13
        return RUNS[key]

    return run


@pytest.mark.parametrize("n", [16, 64])
def test_what_is_read_off_a_record(shot, n):
    """pull-back, strength, strain rate by their definitions, from the record, independently of hvi.pullback"""
    r, (t, u, pull, push, bad) = shot(n=n)
    half = np.flatnonzero(u < 0.5 * u.max())
    top = np.where(t > t[half[half < u.argmax()][-1]] + 0.5e6 * 2e-3 / C0, u, 0).argmax()  # not what rings behind the shock
    rise = next(k for k in range(top, len(u)) if u[k] - u[top:k + 1].min() > 0.1 * (u[top] - u[top:k + 1].min()) and u[top:k + 1].min() < 0.98 * u[top])
    low = top + u[top:rise + 1].argmin()
    du = u[top] - u[low]
    half = top + np.flatnonzero(u[top:] < u[top] - 0.5 * du)[0]
    tenth = 1 + np.flatnonzero(u[:half] >= u[top] - 0.1 * du)[-1]
    passed = [t[k] - (u[k] - u[top] + part * du) / (u[k] - u[k - 1]) * (t[k] - t[k - 1]) for part, k in ((0.1, tenth), (0.5, half))]
    rate = 0.4 * du / (2 * C0 * 1e-6 * (passed[1] - passed[0]))
    assert r["record"] == "ok" and (r["plate"] == "ok") == (n >= 32)
    assert r["pull_back_m_s"] == pytest.approx(du, rel=1e-4)
    assert r["spall_strength_GPa"] == pytest.approx(0.5e-9 * RHO0 * C0 * du, rel=1e-4)
    assert r["strain_rate_per_s"] == pytest.approx(rate, rel=1e-4)
    assert r["first_failure_us"] == pytest.approx(t[np.flatnonzero(bad > 0)[0]], abs=1.01 * (t[1] - t[0]))
    assert r["failed_particles"] == bad[-1] and r["record_us"] == pytest.approx(t[-1], abs=1.01 * (t[1] - t[0]))
    assert (r["largest_tension_GPa"], r["peak_GPa"]) == pytest.approx((1e-9 * pull.max(), 1e-9 * push.max()), rel=1e-5)
    assert r["failed_from_mm"] <= r["spall_plane_mm"] <= r["failed_to_mm"] < r["failed_from_mm"] + r["failed_particles"] * 2 / n
    # the plateau: both elastic waves, as in test_solids.py
    hel = 324.1e6 * RHO0 * CL**2 / (2 * SHEAR)
    if n >= 64:
        assert r["top_m_s"] == pytest.approx(500 - hel / RHO0 * (1 / C0 - 1 / CL), rel=0.01)


def test_a_record_without_spall(shot):
    """no limit of tension, so no failure; and a record that ends before the surface falls says so"""
    r = shot(n=32, spall="none")[0]
    assert r["failed_particles"] == 0 and np.isnan([r["spall_plane_mm"], r["first_failure_us"], r["failed_from_mm"], r["failed_to_mm"]]).all()
    r = shot(n=32, tstop=1.1)[0]
    assert r["record"].startswith("no pull-back") and r["failed_particles"] == 0 and np.isnan(r["spall_strength_GPa"])


def test_density_and_sound_are_those_of_the_target(shot):
    """of its material file, of which the bulk speed of sound is C; the record is 3.5 flyers and the target long at that speed"""
    r = shot(n=16, flyer="quartz.hvi", target="Cu-OFHC.hvi", hf=1, ht=2)[0]
    assert (r["target_density_kg_m3"], r["target_sound_speed_m_s"]) == (8930, 3940)
    assert r["record_us"] == pytest.approx((2e-3 + 3.5e-3) / 3940 * 1e6, rel=0.01)


@pytest.mark.parametrize("n", [(16, 32, 64, 128), pytest.param((16, 32, 64, 128, 256), marks=pytest.mark.long)], ids=len)
def test_convergence(shot, n):
    """pull-back velocity by voids changes by less from each spacing to the next, by 2 % from 128 to 256 particles per flyer; that of the limit is without order

    Energy per area goes down with the spacing: softening is local, so damage goes into thinner layers.
    """
    du, energy, instant = (np.array([shot(n=k, **how)[0][key] for k in n])
                           for key, how in (("pull_back_m_s", {}), ("void_work_J_m2", {}), ("pull_back_m_s", dict(spall="principal"))))
    print("du", du, "energy", energy, "instant", instant)
    change = du[2:] / du[1:-1] - 1
    assert np.all(change < 0) and np.all(np.abs(change) < 0.035) and np.all(np.diff(np.abs(change)) < 0)
    assert len(n) < 5 or abs(change[-1]) < 0.02
    assert np.abs(instant[1:] / instant[:-1] - 1).max() > 0.15
    assert np.all((0.75 < energy[1:] / energy[:-1]) & (energy[1:] / energy[:-1] < 0.9))


LIMIT = 145.2  # m/s, pull-back by voids: Aitken's limit of 128, 256 and 512 particles per flyer, of the table in examples/spall/README.md


@pytest.mark.parametrize("n, bound", [(32, 0.10), (64, 0.07), (128, 0.04), pytest.param(256, 0.025, marks=pytest.mark.long)])
def test_distance_to_the_limit(shot, n, bound):
    """pull-back by voids is above its limit by 8.9, 5.6, 3.0, 1.6 % with 32, 64, 128, 256 particles per flyer

    5 % from 32 particles on was the goal. It is missed: 32 and 64 do not reach it. Bounds are near what is found, so that what gets worse is seen.
    """
    du = shot(n=n)[0]["pull_back_m_s"]
    print(n, du, du / LIMIT - 1)
    assert 1 < du / LIMIT < 1 + bound
    if n == 256:  # the limit, from what does not take a run of 512
        a, b, c = (shot(n=k)[0]["pull_back_m_s"] for k in (64, 128, 256))
        assert c - (c - b) ** 2 / (c - 2 * b + a) == pytest.approx(LIMIT, rel=0.01)


@pytest.mark.long
def test_rows_that_clump(shot):
    """with h = 1.2 spacings nearest neighbors lie where the kernel gets steeper: 256 particles per flyer clump in tension, and part too soon"""
    assert shot(n=64, eta=1.2)[0]["pull_back_m_s"] == pytest.approx(shot(n=64)[0]["pull_back_m_s"], rel=0.02)
    assert shot(n=256, eta=1.2)[0]["pull_back_m_s"] < 0.9 * shot(n=256)[0]["pull_back_m_s"]


def test_damage_by_strain_leaves_a_plane_pull_to_voids(shot, root, tmp_path):
    """with the eps_min of the file; with that of its source, 1e-6, strain parts the plates at a third of the strength"""
    text = (root / "potentials" / "Al6061-T6.hvi").read_text()
    without = re.sub(r"  eps_min .*\n", "", text)
    assert without != text
    (tmp_path / "without.hvi").write_text(without)
    how = dict(n=32)
    voids, both = shot(**how)[0], shot(damage="yes", **how)[0]
    strain = shot(damage="yes", target=tmp_path / "without.hvi", **how)[0]
    for key in ("pull_back_m_s", "spall_plane_mm", "failed_particles", "void_work_J_m2"):
        assert both[key] == voids[key] > 0, key
    assert strain["spall_strength_GPa"] < 0.4 * both["spall_strength_GPa"] and strain["failed_particles"] > 3 * both["failed_particles"]


@pytest.mark.long
def test_rates(shot, root):
    """the same plates 0.1 to 10 times as thick: strength by voids goes with the strain rate, the instant limit knows none

    Beside the exponent m of the law, that of the law's own strength is less by a tenth (test_stretched_at_a_constant_rate), and that read off
    records less again (examples/spall).
    """
    k = constants(root)
    slopes = []
    for spall in ("voids", "principal"):
        found = np.array([[shot(n=128, hf=h, ht=2 * h, spall=spall)[0][q] for q in ("strain_rate_per_s", "spall_strength_GPa")] for h in (20, 2, 0.2)])
        slopes.append(np.polyfit(*np.log(found.T), 1)[0])
        if spall == "voids":
            part = found[:, 1] * 1e9 / (k["sigma"] * (found[:, 0] / k["rate"]) ** k["m"])
    print("exponents", slopes, "of the law's sigma", part)
    assert 0.7 * k["m"] < slopes[0] < k["m"]
    assert abs(slopes[1]) < 0.01
    assert np.all((0.8 < part) & (part < 1.05))


@pytest.mark.parametrize("V", [pytest.param(600, marks=pytest.mark.long), 1000, pytest.param(1500, marks=pytest.mark.long)])
def test_place_of_first_failure(shot, V):
    """an instant limit is passed where the head of the flyer's release runs in the release fan of the free surface

    That head runs at a = (c0 + 2 s u) c_l/c0 behind the shock of speed Us = c0 + s u; the fan's ends at a and c0. So the least depth is where
    the head meets the end of the fan, the largest where it meets its head, both in the plates' thickness at rest. Voids need time:
    they fail deeper than where both heads meet, and no deeper than where both ends meet, which run at c0: there tension is whole first, and lasts.
    """
    n, hf, ht = 128, 2.0, 4.0
    u = V / 2
    a, Us = (C0 + 2 * S1 * u) * CL / C0, C0 + S1 * u
    deep = ht - 0.5 * (ht - hf) * (1 + a / Us)
    shallow = C0 * ((ht + hf + C0 * ht / Us + a * hf / Us) / (a + C0) - ht / Us)
    instant, voids = (shot(n=n, v0=V, spall=spall)[0]["spall_plane_mm"] for spall in ("principal", "voids"))
    whole = 0.5 * (ht + hf) - 0.5 * (ht - hf) * C0 / Us
    print(V, "bounds", shallow, deep, whole, "instant", instant, "voids", voids)
    reach = 3.0 * hf / n  # of the kernel
    assert shallow - reach < instant < deep + reach
    assert max(instant, deep) < voids < whole
