"""Every mistake ends with LAMMPS's own error that names what is wrong: no crash, no hang, no silent wrong number."""

import pytest
from scenes import BOND, PAIR, State, cube, scene

GOOD = "fix nve all nve\nfix step all hvi/dt 0.1\ncompute book all hvi/energy\nthermo_style custom step c_book[*]\nrun 2\n"


def attempt(lmp, commands=GOOD, pair=PAIR, bond=BOND, state=None, nranks=1, change=None, **how):
    s = state or cube(3, 0.02, 0.1, types=2)
    text = scene(s, "s.data", pair=pair, bond=bond, **how) + commands
    if change:
        assert change[0] in text
        text = text.replace(*change)
    result = lmp(text, nranks=nranks, expect_fail=True, timeout=60)
    assert result.returncode > 0, "a signal"  # < 0 or > 128: a crash
    assert result.returncode < 128 and "Signal" not in result.stderr, result
    return " ".join(result.error.split())


def test_the_scene_is_right_otherwise(lmp):
    """what the cases below spoil works by itself"""
    assert lmp(scene(cube(3, 0.02, 0.1, types=2), "s.data") + GOOD).thermo["c_book[9]"][-1] == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("pair, says", [
    ("pair_style hvi/contact prefactor", "Illegal pair_style hvi/contact prefactor"),
    ("pair_style hvi/contact prefactor 0.0", "prefactor must be > 0, not 0.0"),
    ("pair_style hvi/contact prefactor -1", "prefactor must be > 0, not -1"),
    ("pair_style hvi/contact prefactor nan", "'nan'"),
    ("pair_style hvi/contact prefactor inf", "'inf'"),
    ("pair_style hvi/contact prefactor four", "four"),
    ("pair_style hvi/contact factor 4", "Unknown pair_style hvi/contact keyword: factor"),
    ("pair_style hvi/contact 2.5", "Unknown pair_style hvi/contact keyword: 2.5"),
])
def test_pair_style(lmp, pair, says):
    assert says in attempt(lmp, pair=pair + "\npair_coeff * * 1.0 1.0\n")


@pytest.mark.parametrize("coeff, says", [
    ("* * 1.0", "pair_coeff hvi/contact"),
    ("* *", "pair_coeff"),
    ("* * 1.0 1.0 1.12", "takes I J epsilon sigma, but got extra: 1.12"),
    ("* * 0.0 1.0", "epsilon must be > 0, not 0.0"),
    ("* * -1.0 1.0", "epsilon must be > 0, not -1.0"),
    ("* * 1.0 0.0", "sigma must be > 0, not 0.0"),
    ("* * 1.0 -2", "sigma must be > 0, not -2"),
    ("* * nan 1.0", "'nan'"),
    ("* * 1.0 nan", "'nan'"),
    ("* * inf 1.0", "'inf'"),
    ("* * 1.0 inf", "'inf'"),
    ("* * 1.0 small", "small"),
    ("3 3 1.0 1.0", "3"),
    ("1 x 1.0 1.0", "x"),
    ("1 1 1.0 1.0", "coeffs are not set"),
])
def test_pair_coeff(lmp, coeff, says):
    assert says in attempt(lmp, pair=f"pair_style hvi/contact\npair_coeff {coeff}\n")


def test_no_pair_coeff(lmp):
    assert "coeffs are not set" in attempt(lmp, pair="pair_style hvi/contact\n")


def test_pair_coeff_of_unlike_types_alone(lmp):
    assert "coeffs are not set" in attempt(lmp, pair="pair_style hvi/contact\npair_coeff 2 1 1.0 1.0\n")


@pytest.mark.parametrize("coeff, says", [
    ("1 27.0 1.12", "bond_coeff hvi/spring"),
    ("1", "bond_coeff"),
    ("1 27.0 1.12 1.5 9", "takes T kappa r_eq r_cut, but got extra: 9"),
    ("1 0 1.12 1.5", "kappa must be > 0, not 0"),
    ("1 -27 1.12 1.5", "kappa must be > 0, not -27"),
    ("1 nan 1.12 1.5", "'nan'"),
    ("1 inf 1.12 1.5", "'inf'"),
    ("1 27.0 0 1.5", "r_eq must be > 0, not 0"),
    ("1 27.0 -1.12 1.5", "r_eq must be > 0, not -1.12"),
    ("1 27.0 nan 1.5", "'nan'"),
    ("1 27.0 1.12 1.12", "r_cut must be > r_eq = 1.12, not 1.12"),
    ("1 27.0 1.5 1.12", "r_cut must be > r_eq = 1.5, not 1.12"),
    ("1 27.0 1.12 nan", "'nan'"),
    ("1 27.0 1.12 inf", "'inf'"),
    ("2 27.0 1.12 1.5", "2"),
    ("1 stiff 1.12 1.5", "stiff"),
])
def test_bond_coeff(lmp, coeff, says):
    assert says in attempt(lmp, bond=f"bond_style hvi/spring\nbond_coeff {coeff}\n")


def test_no_bond_coeff(lmp):
    assert "Bond coeffs are not set" in attempt(lmp, bond="bond_style hvi/spring\n")


def test_bond_style_takes_no_arguments(lmp):
    attempt(lmp, bond=BOND.replace("spring\n", "spring harmonic\n"))


@pytest.mark.parametrize("weights", ["lj/coul 0 1 1", "lj/coul 1 1 0.5", "lj 1 0 1", "coul 1 1 0.9", "dreiding", "charmm"])
def test_special_bonds(lmp, weights):
    assert "requires special_bonds lj/coul 1 1 1" in attempt(lmp, GOOD.replace("run", f"special_bonds {weights}\nrun"))


@pytest.mark.parametrize("args, says", [
    ("all hvi/dt", "fix hvi/dt"),
    ("all hvi/dt 0", "factor C must be > 0 and < 1, not 0"),
    ("all hvi/dt 1.0", "factor C must be > 0 and < 1, not 1.0"),
    ("all hvi/dt -0.1", "factor C must be > 0 and < 1, not -0.1"),
    ("all hvi/dt nan", "'nan'"),
    ("all hvi/dt big", "big"),
    ("all hvi/dt 0.1 min", "fix hvi/dt min"),
    ("all hvi/dt 0.1 max", "fix hvi/dt max"),
    ("all hvi/dt 0.1 every", "fix hvi/dt every"),
    ("all hvi/dt 0.1 floor", "fix hvi/dt floor"),
    ("all hvi/dt 0.1 floor -0.1", "floor must be >= 0 and < 1, not -0.1"),
    ("all hvi/dt 0.1 floor 1", "floor must be >= 0 and < 1, not 1"),
    ("all hvi/dt 0.1 floor nan", "'nan'"),
    ("all hvi/dt 0.1 min -1", "min must be >= 0, not -1"),
    ("all hvi/dt 0.1 min nan", "'nan'"),
    ("all hvi/dt 0.1 max 0", "max must be > 0, not 0"),
    ("all hvi/dt 0.1 max -1", "max must be > 0, not -1"),
    ("all hvi/dt 0.1 max nan", "'nan'"),
    ("all hvi/dt 0.1 every 0", "every must be > 0, not 0"),
    ("all hvi/dt 0.1 every 2.5", "2.5"),
    ("all hvi/dt 0.1 min 0.1 max 0.01", "min 0.1 must be below max 0.01"),
    ("all hvi/dt 0.1 largest 1", "Unknown fix hvi/dt keyword: largest"),
    ("all hvi/dt 0.1 0.2", "0.2"),
])
def test_fix_hvi_dt(lmp, args, says):
    assert says in attempt(lmp, f"fix nve all nve\nfix step {args}\nrun 2\n")


def test_two_fixes_hvi_dt(lmp):
    assert "More than one fix hvi/dt" in attempt(lmp, change=("run", "fix again all hvi/dt 0.2\nrun"))


def test_fix_hvi_dt_without_our_styles(lmp):
    error = attempt(lmp, "fix nve all nve\nfix step all hvi/dt 0.1\nrun 2\n", pair="pair_style lj/cut 1.0\npair_coeff * * 1 1\n",
                    bond="bond_style harmonic\nbond_coeff 1 27.0 1.12\n")
    assert "needs a pair style, bond style or fix that limits the time step" in error


def test_step_below_min(lmp):
    error = attempt(lmp, "fix nve all nve\nfix step all hvi/dt 0.1 min 0.05 max 0.1\nrun 2\n")
    assert "fell below min 0.05" in error and "at step 0" in error


def test_nothing_limits_the_step(lmp):
    s = State([[0, 0, 0], [3, 0, 0]], 0.0, [], [[-5.0, 5.0]] * 3, masses=(1.0, 1.0))
    assert "give it a max" in attempt(lmp, state=s)


@pytest.mark.parametrize("value", ["1e308*10-1e308*10", "1e308*10", "-1e308*10"], ids=["nan", "inf", "-inf"])
@pytest.mark.parametrize("nranks", [1, 2])
def test_velocity_is_no_number(lmp, value, nranks):
    """the fix sees it on whichever rank it is, before the run starts"""
    s = cube(3, 0.02, 0.1, cut=1.0, types=2)
    s.x *= 1.5  # nobody is in touch
    bad = f"variable bad atom {value}+0*x\nset atom 27 vz v_bad\nrun"
    error = attempt(lmp, state=s, nranks=nranks, change=("run", bad))
    assert "not a number at step 0" in error and "NaN" in error


@pytest.mark.parametrize("nranks", [1, 2])
def test_exact_overlap(lmp, nranks):
    """two particles in one place"""
    s = cube(3, 0.02, 0.1, types=2)
    s.x[13] = s.x[4]
    error = attempt(lmp, state=s, nranks=nranks)
    assert "particles 5 and 14 are at the same place at step 0" in error or "particles 14 and 5 are" in error


@pytest.mark.parametrize("command, says", [
    ("compute book g hvi/energy", "group must be all"),
    ("compute book all hvi/energy clamps", "compute hvi/energy clamps"),
    ("compute book all hvi/energy clamps nobody", "group ID nobody"),
    ("compute book all hvi/energy holds g", "Unknown compute hvi/energy keyword: holds"),
    ("fix x all hvi/ledger", "use compute hvi/energy"),
])
def test_compute_hvi_energy(lmp, command, says):
    assert says in attempt(lmp, f"group g id 1 2\nfix nve all nve\n{command}\nrun 1\n")


def test_respa(lmp):
    respa = "run_style respa 2 2 bond 1 pair 2\nrun"
    assert "respa" in attempt(lmp, "fix nve all nve\nrun 1\n", change=("run 1", respa + " 1"))
    assert "respa" in attempt(lmp, "fix nve all nve\nrun 1\n", bond="bond_style none\n", change=("run 1", respa.replace("bond 1 ", "") + " 1"))
    assert "respa" in attempt(lmp, "fix nve all nve\nfix s all hvi/dt 0.1\nrun 1\n", change=("run 1", respa + " 1"))


def test_minimize(lmp):
    assert "cannot be minimized" in attempt(lmp, "minimize 0 1e-6 10 10\n")


def test_atom_style_without_bonds(lmp):
    text = ("units lj\natom_style atomic\nregion b block 0 5 0 5 0 5\ncreate_box 1 b\ncreate_atoms 1 single 1 1 1\nmass 1 1\n"
            + PAIR + "bond_style hvi/spring\n")
    assert lmp(text + "fix nve all nve\nrun 1\n", expect_fail=True).error


def test_angles_are_not_booked(lmp):
    text = scene(cube(3, types=2), "s.data").replace("atom_style bond", "atom_style angle")
    text = text.replace("read_data s.data", "read_data s.data extra/angle/types 1 extra/angle/per/atom 1")
    text += "angle_style zero\nangle_coeff 1\nfix nve all nve\ncompute book all hvi/energy\nrun 1\n"
    assert "does not book angle" in lmp(text, expect_fail=True).error


def test_restart_from_other_styles(lmp):
    """a restart with other coefficients than the run's keeps what was asked for; one with missing fixes says so"""
    lmp(scene(cube(3, types=2), "s.data") + GOOD + "write_restart r\n")
    result = lmp("read_restart r\nbond_coeff 1 27.0 1.12 1.0\n", expect_fail=True)
    assert "r_cut must be > r_eq" in result.error
