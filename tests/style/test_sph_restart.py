"""A run that is interrupted in the middle of a shock goes on as if it had not been."""

import numpy as np
import pytest
from sph_scenes import RATES, random_fluid, read_rates, scene

MIDDLE, END = 60, 110  # at 120 the restart command would rebuild the list
PAIR = "pair_style hvi/sph cubic {0}\npair_coeff 1 1 eos tait 1.0 4.0 7 h 1.2\npair_coeff 2 2 eos idealgas 1.4 h 1.3\n"
THERMO = "compute book all hvi/energy\nthermo 10\nthermo_style custom step dt time f_step[*] c_book[*]\nthermo_modify norm no format float %.17g\n"
STATE = dict(seed=41, jitter=0.1, speed=0.8, periodic=True)


def whole(tmp_path, h, newton, rest=f"restart {MIDDLE} half\nrun {END}\n"):
    state = random_fluid(8, **STATE)
    text = scene(state, tmp_path / "s.data", PAIR.format(h), newton=newton, sort=False)
    return text + "fix step all hvi/dt 0.2\n" + THERMO + rest + RATES.format("whole")


def continued(newton, more="", pair=""):
    text = f"newton {newton}\nread_restart half.{MIDDLE}\n{pair}neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
    return text + "fix sph all hvi/sph\nfix step all hvi/dt 0.2\n" + THERMO + more + f"run {END - MIDDLE}\n" + RATES.format("part")


@pytest.mark.each_value
@pytest.mark.parametrize("h", ["interface 0.3 h constant", "interface 0.3 h variable", "dissipation riemann h variable"])
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (1, "off"), (2, "on")])
def test_bit_exact_on_the_same_ranks(lmp, tmp_path, h, nranks, newton):
    """positions, velocities, density, energy, rates, time step and every ledger entry: the same bits"""
    a = lmp(whole(tmp_path, h, newton), nranks=nranks).runs[0]
    b = lmp(continued(newton), nranks=nranks).runs[0]
    one, two = read_rates(tmp_path / "whole"), read_rates(tmp_path / "part")
    for name in one:
        assert np.array_equal(one[name], two[name]), name
    later = a["Step"] >= MIDDLE
    assert np.array_equal(a["Step"][later], b["Step"])
    for name in a:
        assert np.array_equal(a[name][later], b[name]), name
    assert a["Dt"].min() < a["Dt"].max() and a["c_book[28]"][-1] > 0.01 * a["c_book[1]"][0]  # it shocks


def test_two_runs_are_one(lmp, tmp_path):
    """run 60 and 50 more is run 110; a particle changed in between starts anew"""
    one = lmp(whole(tmp_path, "interface 0.3 h variable", "on", rest="unfix step\ntimestep 0.01\nthermo_style custom step\nrun 110\n"))
    a = read_rates(tmp_path / "whole")
    lmp(whole(tmp_path, "interface 0.3 h variable", "on", rest="unfix step\ntimestep 0.01\nthermo_style custom step\nrun 60\nrun 50\n"))
    b = read_rates(tmp_path / "whole")
    assert one.runs
    # a second list is built at step 60, in another order of pairs
    for name in a:
        assert np.abs(a[name] - b[name]).max() <= 1e-11 * np.abs(a[name]).max(), name
    lmp(whole(tmp_path, "interface 0.3 h variable", "on",
              rest="unfix step\ntimestep 0.01\nthermo_style custom step\nrun 60\nvelocity all set 0 0 0\nrun 0\n"))
    c = read_rates(tmp_path / "whole")
    assert np.abs(c["v"]).max() == 0.0 and np.abs(c["de"]).max() == 0.0 < np.abs(a["de"]).max()


@pytest.mark.parametrize("first, second", [(1, 2), (3, 1)])
def test_other_ranks(lmp, tmp_path, first, second):
    lmp(whole(tmp_path, "interface 0.3 h variable", "on"), nranks=first)
    lmp(continued("on"), nranks=second)
    one, two = read_rates(tmp_path / "whole"), read_rates(tmp_path / "part")
    for name in one:
        assert np.abs(one[name] - two[name]).max() <= 1e-9 * np.abs(one[name]).max(), name


def test_other_settings_are_refused(lmp, tmp_path):
    """a restart goes on with the equations it was written with"""
    lmp(whole(tmp_path, "interface 0.3 h variable", "on"))
    pair = "pair_style hvi/sph quintic\npair_coeff * * eos tait 1.0 4.0 7 h 1.2\n"
    r = lmp(continued("on", pair=pair), expect_fail=True)
    assert "restart file was written with pair_style hvi/sph cubic dim 3 form sum h variable" in r.error
    lmp(continued("on", pair=PAIR.format("interface 0.3 h variable")))


GAS = "pair_style hvi/sph cubic\npair_coeff * * eos idealgas 1.4 h 1.2\n"
STEP = "timestep 0.01\nthermo 1\nthermo_style custom step ke\nthermo_modify norm no format float %.15g\n"


def test_restart_files_written_outside_a_run(lmp, tmp_path):
    """before the first run, and after a command has changed velocities: a particle starts from what the file holds"""
    state = random_fluid(6, seed=43, jitter=0.1, types=1)
    more = "read_restart {0}\n" + GAS + "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix sph all hvi/sph\n" + STEP
    text = scene(state, tmp_path / "s.data", GAS) + STEP
    one = lmp(text + "write_restart r0\nrun 3\nvelocity all set 0.1 0 0 sum yes\nvelocity all scale 1.0\nwrite_restart r1\nrun 2\n").runs
    start, later = lmp(more.format("r0") + "run 3\n").thermo, lmp(more.format("r1") + "run 2\n").thermo
    assert start["KinEng"] == pytest.approx(one[0]["KinEng"], rel=1e-12)
    assert later["KinEng"] == pytest.approx(one[1]["KinEng"], rel=1e-12)


def test_joining_the_group(lmp, tmp_path):
    """particles that join between runs start from their own state"""
    state = random_fluid(6, seed=45, jitter=0.1, types=1)
    text = scene(state, tmp_path / "s.data", GAS, fix="region half block INF 3 INF INF INF INF\ngroup flow region half\nfix sph flow hvi/sph\n")
    text += STEP + "run 3\nregion rest block 3 INF INF INF INF INF\ngroup flow region rest\nrun 3\n" + RATES.format("f")
    lmp(text)
    got = read_rates(tmp_path / "f")
    assert (got["rho"] > 0.5).all() and np.abs(got["esph"] - state.esph).min() > 0


def test_a_piston_is_felt_at_its_speed(lmp, tmp_path):
    """particles outside the group, moved by fix move: forces see their velocity, as if hvi/sph moved them"""
    states = []
    for name in ("move", "hvi/sph"):
        state = random_fluid(6, seed=47, jitter=0.1, types=2)
        state.v[state.type == 2] = [0.4, 0, 0]
        fix = "group wall type 2\ngroup gas type 1\n"
        if name == "move":
            fix += "fix sph gas hvi/sph\nfix move wall move linear 0.4 0 0\n"
        else:
            fix += "fix sph all hvi/sph\nfix hold wall setforce 0 0 0\n"
        pair = "pair_style hvi/sph cubic energy no\npair_coeff * * eos tait 1.0 4.0 7 h 1.2\npair_coeff 1 2 tension yes\n"
        lmp(scene(state, tmp_path / "s.data", pair, fix=fix) + "timestep 0.01\nrun 2\n" + RATES.format("f"))
        states.append(read_rates(tmp_path / "f"))
    gas = state.type == 1
    # densities of the wall differ after the first step, since only one of the two integrates them
    assert np.abs(states[0]["rho"] - states[1]["rho"])[gas].max() < 0.01 * np.abs(states[1]["rho"] - state.rho)[gas].max()
    assert np.abs(states[1]["drho"][gas]).max() > 0.1
