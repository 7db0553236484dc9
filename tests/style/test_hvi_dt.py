"""fix hvi/dt: C sqrt(m/k) of the stiffest pair, m its reduced mass, now or where it will turn back; what limits it."""

import re

import numpy as np
import pytest
from scenes import KAPPA, PAIR, R_EQ, State, collision, contact, cube, scene
from timestep_scenes import APPROACH, C, CONTACT, GROWING, MAXIMUM, SHOW, SIGNAL, SPRING, three_pairs

BOX = [[-8.0, 8.0]] * 3


def stiffness(r, eps=1.0, sigma=1.0, F=1.0):
    q = (sigma / r) ** 6
    return F * eps * (156 * q * q - 42 * q) / r**2


def turning(e, eps=1.0, sigma=1.0, F=1.0):
    """where a pair of energy e turns back"""
    return sigma * (0.5 + np.sqrt(e / (F * eps))) ** (-1 / 6)


def first(lmp, s, args=f"{C} max 1.0", nranks=1, **how):
    row = lmp(scene(s, "s.data", **how) + f"fix step all hvi/dt {args}\n" + SHOW + "run 0\n", nranks=nranks).thermo
    assert row["f_step[1]"][0] == row["f_step"][0] == row["Dt"][0]
    return row["Dt"][0], row["f_step[3]"][0]


def pair(r, v=0.0, bonded=False, frame=(0.0, 0.0, 0.0)):
    """masses 1 and 3, closing at speed v"""
    n = np.array([1.0, 2.0, -2.0]) / 3.0
    return State([[0, 0, 0], r * n], np.array([v * n, 0 * n]) + frame, [(0, 1)] if bonded else [], BOX, types=[1, 2], masses=(1.0, 3.0))


M = 0.75  # reduced mass


@pytest.mark.each_value
@pytest.mark.parametrize("F", [1.0, 4.0])
@pytest.mark.parametrize("r", [0.8, 0.95, 1.1])
def test_contact_at_rest(lmp, r, F):
    """limited by the stiffness of a pair in touch"""
    dt, why = first(lmp, pair(r), pair=PAIR.replace("contact", f"contact prefactor {F}"))
    assert dt == pytest.approx(C * np.sqrt(M / stiffness(r, F=F)), rel=1e-12) and why == CONTACT


def test_spring_at_rest(lmp):
    """limited by an intact bond, stretched or slack"""
    for r in (R_EQ + 1e-3, 1.4):
        dt, why = first(lmp, pair(r, bonded=True))
        assert dt == pytest.approx(C * np.sqrt(M / KAPPA), rel=1e-12) and why == SPRING, r


def test_broken_bond_is_no_limit(lmp):
    """a bond that breaks at step 0 counts no more"""
    assert first(lmp, pair(1.6, bonded=True)) == (1.0, MAXIMUM)


@pytest.mark.each_value
@pytest.mark.parametrize("v", [1.0, 12.0])
@pytest.mark.parametrize("r", [0.95, 1.13, 1.3])
def test_approach(lmp, r, v):
    """limited by the stiffness where an approaching pair turns back, before it is in touch and in touch"""
    q = r**-6.0
    e = 0.5 * M * v**2 + (q * q - q + 0.25 if r < R_EQ else 0.0)
    dt, why = first(lmp, pair(r, v))
    assert dt == pytest.approx(C * np.sqrt(M / stiffness(turning(e))), rel=1e-12) and why == APPROACH


def test_receding_and_sliding_pairs_do_not_count(lmp):
    """only the closing part of the velocity counts"""
    assert first(lmp, pair(1.2, -2.0))[0] == pytest.approx(0.1 * R_EQ / 2.0, rel=1e-12)  # travel alone
    s = pair(1.0)
    s.v[0] = [2.0 / np.sqrt(5) * 0.3, -1.0 / np.sqrt(5) * 0.3, 0.0]
    assert first(lmp, s)[0] == pytest.approx(C * np.sqrt(M / stiffness(1.0)), rel=1e-9)


def test_distant_particles_do_not_meet_unseen(lmp):
    """no pair may come closer by more than a tenth of r_eq in a step"""
    dt, why = first(lmp, pair(6.0, 50.0))
    v = 50.0 * np.array([1.0, 2.0, -2.0]) / 3.0
    assert dt == pytest.approx(0.1 * R_EQ / np.linalg.norm(v), rel=1e-12) and why == APPROACH


def test_frame_does_not_matter(lmp):
    """a moving observer sees the same step: free flight costs nothing"""
    a, b = first(lmp, pair(1.2, 3.0)), first(lmp, pair(1.2, 3.0, frame=(1e3, -2e3, 5e2)))
    assert a[0] == pytest.approx(b[0], rel=1e-9) and a[1] == b[1]


def test_max(lmp):
    """never above max"""
    assert first(lmp, pair(1.0), f"{C} max 1e-4") == (1e-4, MAXIMUM)
    assert first(lmp, pair(3.0), f"{C} max 0.02") == (0.02, MAXIMUM)


def test_timestep_after_a_restart(lmp):
    """a step that the user changes is bounded at once, as at the start of a run; one that is not goes on"""
    text = scene(pair(3.0), "s.data") + f"fix step all hvi/dt {C} max 0.02\n" + SHOW + "run 3\nwrite_restart r\n"
    lmp(text)
    again = f"read_restart r\nfix step all hvi/dt {C} max 0.02\n{{}}" + SHOW + "run 1\n"
    assert list(lmp(again.format("")).thermo["Dt"]) == [0.02, 0.02]
    assert list(lmp(again.format("timestep 0.5\n")).thermo["Dt"]) == [0.02, 0.02]


@pytest.mark.each_value
@pytest.mark.parametrize("newton, nranks, comm", [("off", 1, "brick"), ("on", 2, "brick"), ("off", 2, "tiled"), ("on", 3, "tiled")])
def test_same_on_any_layout(lmp, newton, nranks, comm):
    """the stiffest pair may lie across ranks"""
    s = collision(4)
    s.x[:64, 0] += 0.1
    one, other = first(lmp, s), first(lmp, s, newton=newton, comm=comm, nranks=nranks)
    assert one[0] == pytest.approx(other[0], rel=1e-13) and one[1] == other[1] == APPROACH
    s = cube(4, 0.1, 0.0)
    one, other = first(lmp, s), first(lmp, s, newton=newton, comm=comm, nranks=nranks)
    assert one[0] == pytest.approx(other[0], rel=1e-13) and one[1] == other[1] == CONTACT


def test_shrinks_at_once_and_grows_slowly(lmp):
    """a bounce: the step follows the stiffness down, comes back bit by bit (limiter 4), reaches max again"""
    s = pair(1.5, 6.0)
    s.box *= 10.0
    t = lmp(scene(s, "s.data") + f"fix step all hvi/dt {C} max 0.02 every 1\n" + SHOW + "run 2000\n").thermo
    dt, why = t["Dt"], t["f_step[3]"]
    growth = dt[1:] / dt[:-1]
    assert growth.max() <= 1.05 and growth[why[1:] == GROWING].min() > 1.0
    assert np.ptp(growth[why[1:] == GROWING]) < 1e-9
    assert {APPROACH, GROWING} <= set(why)
    stiff = C * np.sqrt(M / stiffness(turning(0.5 * M * 36)))
    assert dt.min() == pytest.approx(stiff, rel=0.1) and dt[-1] > 1.3 * dt.min()
    # time is the sum of the steps; step n was made with the dt chosen at its start
    assert t["f_step[2]"] == pytest.approx(np.concatenate([[0], np.cumsum(dt[:-1])]), rel=1e-10)
    assert t["Time"] == pytest.approx(t["f_step[2]"], rel=1e-12)


def test_empty_box(lmp):
    """when everybody has left there is nothing to resolve but max"""
    s = State([[7.5, 0, 0]], [[10.0, 0, 0]], [], BOX)
    t = lmp(scene(s, "s.data") + f"fix step all hvi/dt {C} max 0.02\n" + SHOW + "thermo_modify lost ignore\nrun 50\n").thermo
    assert t["Dt"].min() > 0.005


def test_every(lmp):
    """chosen every N steps, and whenever lists are rebuilt"""
    s = cube(3, 0.05, 0.3)
    t = lmp(scene(s, "s.data", skin=1.0) + f"fix step all hvi/dt {C} every 7\n" + SHOW + "run 50\n").thermo
    changed = np.flatnonzero(np.diff(t["Dt"]))  # row n+1 shows the dt chosen at the end of step n+1
    assert set((changed + 1) % 7) == {0} and len(changed) >= 5


@pytest.mark.parametrize("write, rest", [('run 48 every 12 "write_restart r.*"', 'run 24 every 12 "write_restart s.*"'), ("restart 12 r.*\nrun 48", "restart 12 s.*\nrun 24")])
def test_every_after_a_restart(lmp, write, rest):
    """the same steps, whether the file is of the middle of a run or of its end"""
    def steps(runs):
        return {int(n): dt for run in runs for n, dt in zip(run["Step"], run["Dt"])}

    step = f"fix step all hvi/dt {C} every 10\n" + SHOW
    wrote = steps(lmp(scene(cube(3, 0.05, 0.3), "s.data", skin=1.0) + step + write + "\n").runs)
    went_on = steps(lmp("read_restart r.24\n" + step + rest + "\n").runs)
    assert len(set(went_on.values())) > 2 and went_on == {n: dt for n, dt in wrote.items() if n >= 24}


# one physical pair, m = 1e-6 kg, eps = 1e-3 J, sigma = 1 mm, and its time step in seconds
EV, AMU, KCAL = 1.602176634e-19, 1.66053906660e-27, 4184.0 / 6.02214076e23
UNITS = {  # kg, J, m, s in units of ...
    "si": (1.0, 1.0, 1.0, 1.0), "cgs": (1e3, 1e7, 1e2, 1.0), "micro": (1e18 / 1e3, 1e15, 1e6, 1e6),
    "metal": (1 / AMU, 1 / EV, 1e10, 1e12), "real": (1 / AMU, 1 / KCAL, 1e10, 1e15), "lj": (1e6, 1e3, 1e3, 1e3 * 1e-6**0.5 * 1e3**0.5),
}


@pytest.mark.each_value
@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("kind", [CONTACT, SPRING, APPROACH])
def test_units(lmp, units, kind):
    """the same physical time step in all units"""
    kg, joule, metre, second = UNITS[units]
    if units == "lj":  # m, eps, sigma = 1: the unit of time is sigma sqrt(m/eps)
        second = 1.0 / (1e-3 * np.sqrt(1e-6 / 1e-3))
    r, v = {CONTACT: (1.0, 0.0), SPRING: (1.3, 0.0), APPROACH: (1.3, 400.0)}[kind]
    s = State([[0, 0, 0], [1e-3 * metre * r, 0, 0]], [[v * metre / second, 0, 0], [0, 0, 0]], [(0, 1)] if kind == SPRING else [],
              np.array(BOX) * 1e-3 * metre, masses=(1e-6 * kg,))
    kappa = 2e4
    dt, why = first(lmp, s, f"{C} max {1.0 * second}", units=units, skin=0.3e-3 * metre,
                    pair=f"pair_style hvi/contact\npair_coeff * * {1e-3 * joule!r} {1e-3 * metre!r}\n",
                    bond=f"bond_style hvi/spring\nbond_coeff 1 {kappa * joule / metre**2!r} {R_EQ * 1e-3 * metre!r} {1.5e-3 * metre!r}\n")
    m, eps, sigma = 0.5e-6, 1e-3, 1e-3
    want = {CONTACT: stiffness(1e-3, eps, sigma), SPRING: kappa,
            APPROACH: stiffness(turning(0.5 * m * v**2, eps, sigma), eps, sigma)}[kind]
    assert dt / second == pytest.approx(C * np.sqrt(m / want), rel=1e-6) and why == kind


SPH, TOUCH, TIE = "sph", "contact", "spring"


@pytest.mark.parametrize("nranks", [1, 2])
def test_all_sources_are_heard(lmp, nranks):
    """pair styles under hybrid and a bond style, each the stiffest in turn"""
    want = {SPH: 1.2 / 40.0, TOUCH: np.sqrt(0.5 / stiffness(1.0, eps=1e3)), TIE: np.sqrt(0.5 / 1e4)}
    for name, why, how in ((SPH, SIGNAL, dict(sound=40.0)), (TOUCH, CONTACT, dict(eps=1e3)), (TIE, SPRING, dict(kappa=1e4))):
        row = lmp(three_pairs(**how), nranks=nranks).thermo
        assert row["Dt"][0] == pytest.approx(C * want[name], rel=1e-12) and row["f_step[3]"][0] == why, name


def test_growth_is_that_of_the_sources(lmp):
    """SPH alone lets the step grow by 1 %, stiff pairs by 0.05 %, also those beside SPH"""
    growth = {}
    alone = "group gone type 2 3\ndelete_atoms group gone bond yes\nbond_style none\npair_style hvi/sph cubic\npair_coeff * * eos tait 1.0 40.0 7 h 1.2\n"
    for name, more, word in ((SPH, alone, ""), ("all", "", "hvi/sph ")):
        text = three_pairs(sound=40.0, more=more) + f"pair_coeff 1 1 {word}eos tait 1.0 4.0 7 h 1.2\nrun 30\n"  # sound gets slower
        t = lmp(text.replace(f"hvi/dt {C} max 1e3", f"hvi/dt {C} max 1e3 every 1")).thermo
        growth[name] = t["Dt"][1:] / t["Dt"][:-1]
        assert (t["f_step[3]"][1:] == GROWING).all(), name
    assert growth[SPH] == pytest.approx(1.01, rel=1e-9) and growth["all"] == pytest.approx(1.0005, rel=1e-9)


TWO = """units lj
atom_style sph
atom_modify map array
region box block -9 9 -9 9 -9 9
create_box 2 box
create_atoms 1 single 0 0 0
create_atoms 1 single 1 0 0
mass * 1.0
set group all sph/rho 1.0
pair_style hvi/sph cubic
pair_coeff * * eos tait 1.0 1.0 7 h 1.2
fix fluid all hvi/sph
"""


def faster(sound):
    """the same two particles with another speed of sound"""
    return f"pair_coeff * * eos tait 1.0 {sound} 7 h 1.2\n"


@pytest.mark.parametrize("nranks", [1, 2])
def test_floor(lmp, nranks):
    """a hundredth of the first step ends the run by default, another part if asked for; 0: never"""
    step = f"fix step all hvi/dt {C} {{}}\n{SHOW.replace('fix nve all nve', '')}run 1\n"
    for words, part in (("", 0.01), ("floor 0.2", 0.2), ("floor 0", 1e-5)):
        row = lmp(TWO + step.format(words) + faster(0.999 / part) + "run 1\n", nranks=nranks).thermo
        assert row["Dt"][0] == pytest.approx(C * 1.2 * part / 0.999, rel=1e-12) and row["f_step[3]"][0] == SIGNAL
    for words, part in (("", 0.01), ("floor 0.2", 0.2)):
        error = lmp(TWO + step.format(words) + faster(1.001 / part) + "run 1\n", nranks=nranks, expect_fail=True).error
        dt = C * 1.2
        assert re.search(rf"Time step {dt * part / 1.001:.5g}\d* of fix hvi/dt fell below floor {part} times the first one, {dt:g}, at step 1", error), error
        assert "give fix hvi/dt another floor" in error, words


def test_floor_is_no_matter_of_contacts(lmp):
    """whose bounce may be a thousand times shorter than the way there: they have min"""
    text = scene(pair(1.5, 1.0), "s.data") + f"fix step all hvi/dt {C} max 0.02 every 1\n" + SHOW + "run 0\nvelocity all ramp vx 0 -1e5 x 0 1 units box\nrun 0\n"
    t = lmp(text).thermo
    assert t["Dt"][0] < 1e-3 * 0.02


@pytest.mark.parametrize("nranks", [1, 2])
def test_floor_after_a_restart(lmp, nranks):
    """the first step is that of the first run"""
    step = f"fix step all hvi/dt {C}\nrun 1\n" + faster(50.0) + "run 1\nwrite_restart r\n"
    lmp(TWO + step, nranks=nranks)
    again = f"read_restart r\n{faster(99.0)}fix fluid all hvi/sph\nfix step all hvi/dt {C}\nrun 1\n"
    lmp(again, nranks=nranks)
    assert f"the first one, {C * 1.2:g}" in lmp(again.replace("coeff * * eos tait 1.0 99.0", "coeff * * eos tait 1.0 101.0"), nranks=nranks, expect_fail=True).error


@pytest.mark.parametrize("stiff", [1, 2])
def test_every_contact_of_a_hybrid(lmp, stiff):
    """two hvi/contact under hybrid: whichever is stiffer limits"""
    s = State([[0, 0, 0], [1.0, 0, 0], [5, 0, 0], [6.0, 0, 0]], 0.0, [], BOX, types=[1, 1, 2, 2], masses=(1.0, 1.0))
    pair = "pair_style hybrid hvi/contact hvi/contact\npair_coeff 1 2 none\n"
    for k in (1, 2):
        pair += f"pair_coeff {k} {k} hvi/contact {k} {50.0 if k == stiff else 1.0} 1.0\n"
    dt, why = first(lmp, s, pair=pair)
    assert dt == pytest.approx(C * np.sqrt(0.5 / stiffness(1.0, eps=50.0)), rel=1e-12) and why == CONTACT


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 3])
@pytest.mark.parametrize("speed, why", [(0.0, CONTACT), (6.0, APPROACH)])
def test_one_mass_or_several(lmp, speed, why, nranks):
    """of particles of one mass the limits are found in batches: as of those whose masses differ in the last digits"""
    steps = []
    for heavier in (0.0, 1e-13):
        s = cube((7, 6, 5), jitter=0.2, speed=speed, cut=1.0, types=2, seed=4)
        s.masses = (1.0, 1.0 + heavier)
        steps.append(first(lmp, s, nranks=nranks))
    (fast, because), (general, reason) = steps
    assert because == reason == why
    assert fast == pytest.approx(general, rel=1e-12)
    # by brute force
    i, j = np.triu_indices(len(s.x), 1)
    d, u = s.x[i] - s.x[j], s.v[i] - s.v[j]
    r = np.linalg.norm(d, axis=1)
    near = r < R_EQ + 0.3
    if why == CONTACT:
        assert fast == pytest.approx(C * np.sqrt(0.5 / stiffness(r.min())), rel=1e-12)
    else:
        rate = np.minimum((d * u).sum(axis=1) / r, 0.0)[near]
        e = np.where(rate < 0.0, 0.25 * rate**2 + contact(r[near])[0], 0.0)
        assert fast == pytest.approx(C * np.sqrt(0.5 / stiffness(turning(e.max()))), rel=1e-12)


GAS = "pair_coeff * * eos idealgas 1.4 h 1.2\n"
METAL = "# UNITS: lj\neos gruneisen\n  rho0 1\n  C 1\n  S1 1.4\n  g0 2\n  a 0.5\n  cp 1\n  T0 300\nstrength perfect\n  G 0.3\n  Y 0.1\n"
CASES = {  # words of pair_style, pair_coeff, fixes, square of the speed of sound of an energy per mass
    "monaghan": ("", GAS, "", lambda e: 0.56 * e),
    "riemann": ("dissipation riemann", GAS, "", lambda e: 0.56 * e),
    "variable": ("dissipation riemann h variable", GAS, "", lambda e: 0.56 * e),
    "solid": ("", "pair_coeff * * file metal.hvi h 1.2\n", "fix solid all hvi/johnson-cook strength perfect damage no spall none thermal no\n", lambda e: 1.0 + 4.5 * e + 0.4),
}


def cold_and_hot(case, cold, hot, box=40.0, words="", y="f", newton="on"):
    """particles at rest, one of them hot, the last; the first has a neighbor at 1.0"""
    own, coeff, fixes, _ = CASES[case]
    text = f"units lj\nnewton {newton}\natom_style sph\natom_modify map array\nboundary f {y} f\nregion box block 0 40 0 {box} 0 40\ncreate_box 2 box\n"
    text += "".join(f"create_atoms 1 single {x[0]} {x[1]} {x[2]}\n" for x in cold) + f"create_atoms 2 single {hot[0]} {hot[1]} {hot[2]}\nmass * 1.0\n"
    text += f"set group all sph/rho 1.0\nset type 1 sph/e 1.0\nset type 2 sph/e 1e4\npair_style hvi/sph cubic {own} {words}\n{coeff}fix fluid all hvi/sph\n{fixes}"
    return text + "neighbor 0.3 bin\n"


@pytest.fixture
def metal(tmp_path):
    (tmp_path / "metal.hvi").write_text(METAL)


@pytest.mark.parametrize("case", CASES)
def test_sound_of_what_is_alone(lmp, metal, case):
    """counts no more than what is not there: a hot particle limits the step from when others come near"""
    pairs = [[10, 10, 10], [11, 10, 10]]
    sound = {e: np.sqrt(CASES[case][3](e)) for e in (1.0, 1e4)}
    step = f"fix step all hvi/dt {C}\n{SHOW.replace('fix nve all nve', '')}run 0\n"
    beyond = 14.0 if case == "variable" else 12.8  # what lists reach: of the largest h
    for hot, e in (((30, 10, 10), 1.0), ((10, beyond, 10), 1.0), ((10, 12.3, 10), 1e4)):
        row = lmp(cold_and_hot(case, pairs, hot) + step).thermo
        assert row["Dt"][0] == pytest.approx(C * 1.2 / sound[e], rel=1e-9) and row["f_step[3]"][0] == SIGNAL, hot


@pytest.mark.parametrize("case", ["monaghan", "riemann", "solid"])
def test_neighbors_anywhere(lmp, metal, case):
    """on another rank, by newton on and off; across a periodic face; its own ghost, and its own image in a mirror plane"""
    hot = C * 1.2 / np.sqrt(CASES[case][3](1e4))
    cold = C * 1.2 / np.sqrt(CASES[case][3](1.0))
    step = f"fix step all hvi/dt {C}\n{SHOW.replace('fix nve all nve', '')}run 0\n"
    pairs = [[10, 10, 10], [11, 10, 10]]

    def dt(*args, nranks=1, more="", **how):
        return lmp(cold_and_hot(case, *args, **how) + more + step, nranks=nranks).thermo["Dt"][0]

    for newton in ("on", "off"):
        for a, b in ((19.5, 20.5), (20.5, 19.5)):
            assert dt([*pairs, [a, 20, 20]], [b, 20, 20], nranks=2, more="", newton=newton) == pytest.approx(hot, rel=1e-9), (newton, a)
        assert dt([*pairs, [20, 0.5, 20]], [20, 39.5, 20], y="p", newton=newton) == pytest.approx(hot, rel=1e-9)
        assert dt([[10, 1, 10], [11, 1, 10]], [30, 1, 10], box=2.0, y="p", newton=newton) == pytest.approx(hot, rel=1e-9)
    for x, want in ((1.0, hot), (1.5, cold)):
        assert dt([[10, 10, 10], [11, 10, 10]], [x, 30, 10], words="mirror x 0 lo") == pytest.approx(want, rel=1e-9), x


@pytest.mark.parametrize("nranks", [1, 2])
def test_error_names_the_particle(lmp, nranks):
    """with the fastest sound over its h, on whichever rank it is, and its state"""
    text = cold_and_hot("riemann", [[10, 10, 10], [11, 10, 10], [30, 10, 10], [5, 30, 10]], [31, 10, 10])
    text += f"set type 2 sph/e 1.0\nset atom 4 sph/e 1e9\nfix step all hvi/dt {C}\nrun 0\nset type 2 sph/e 1e6\nset type 2 sph/rho 0.5\nrun 0\n"
    for more, says in (("", "below floor 0.01"), (f"fix step all hvi/dt {C} min 0.01\nrun 0\n", "below min 0.01")):
        said = lmp(text.replace("rho 0.5\nrun 0\n", "rho 0.5\n" + (more or "run 0\n")), nranks=nranks, expect_fail=True).error
        c = np.sqrt(0.56 * 1e6)
        assert says in said and f"the fastest sound is {c:.5g}" in said
        assert "of particle 5 (type 2) at density 0.5, energy per mass 1000000, h 1.2" in said, more
