"""Every mistake with SPH ends with LAMMPS's own error that names what is wrong: no crash, no hang, no silent wrong number."""

from concurrent.futures import ThreadPoolExecutor

import pytest

# each case replaces a part of this, which works

GOOD = """units lj
dimension 3
boundary p p p
atom_style sph
atom_modify map array
lattice sc 1.0
region box block 0 5 0 4 0 4
create_box 2 box
create_atoms 1 box
region right block 2.4 INF INF INF INF INF
set region right type 2
mass * 1.0
set group all sph/rho 1.0
pair_style hvi/sph cubic
pair_coeff * * eos tait 1.0 10.0 7 h 1.2
compute at all hvi/atom p
fix move all hvi/sph
timestep 0.001
thermo_style custom step temp
run 2
"""


@pytest.fixture
def attempt(lmp, tmp_path):
    """Runs all cases (what to replace, by what, what the error says[, in which input]) side by side: one mostly waits for MPI."""

    def one(k, nranks, old, new, says, good=GOOD):
        assert good.count(old) == 1, old
        try:
            r = lmp(good.replace(old, new), cwd=tmp_path / str(k), nranks=nranks, expect_fail=True, timeout=120)
        except pytest.fail.Exception as failure:  # no error, or no end
            return f"{new!r}: {failure}"
        error = " ".join(r.error.split())
        if not 0 < r.returncode < 128 or "Signal" in r.stderr:
            return f"{new!r}: a crash: {r}"
        return None if says in error else f"{new!r}: says {error!r}, not {says!r}"

    def run(cases, nranks=1):
        with ThreadPoolExecutor(12) as pool:
            wrong = list(pool.map(lambda a: one(a[0], nranks, *a[1]), enumerate(cases)))
        assert not any(wrong), "\n".join(w for w in wrong if w)

    return run


def style(words, says):
    return ("hvi/sph cubic", f"hvi/sph {words}", says)


def coeff(words, says):
    return ("* * eos tait 1.0 10.0 7 h 1.2", words, says)


def test_the_scene_is_right_otherwise(lmp):
    assert lmp(GOOD).thermo["Step"][-1] == 2


def test_pair_style(attempt):
    attempt([
        style("", "Illegal pair_style hvi/sph command: missing argument"),
        style("spline", "Unknown pair_style hvi/sph kernel spline: use one of lucy"),
        style("dim 3", "Unknown pair_style hvi/sph kernel dim"),
        style("cubic quintic", "Unknown pair_style hvi/sph keyword: quintic"),
        style("cubic 2.4", "Unknown pair_style hvi/sph keyword: 2.4"),
        style("cubic dim", "Illegal pair_style hvi/sph dim command: missing argument"),
        style("cubic dim 0", "dim must be 1 to 3 in a box of dimension 3, not 0"),
        style("cubic dim 4", "dim must be 1 to 3 in a box of dimension 3, not 4"),
        style("cubic dim -1", "not -1"),
        style("cubic dim 2.5", "2.5"),
        style("cubic form", "Illegal pair_style hvi/sph form command: missing argument"),
        style("cubic form mean", "form must be sum or symmetric, not mean"),
        style("cubic viscosity", "Illegal pair_style hvi/sph viscosity command: missing argument"),
        style("cubic viscosity 1", "Illegal pair_style hvi/sph viscosity command: missing argument"),
        style("cubic viscosity -1 2", "viscosity must be >= 0, not -1"),
        style("cubic viscosity 1 -2", "viscosity must be >= 0, not -2"),
        style("cubic viscosity nan 2", "'nan'"),
        style("cubic viscosity 1 inf", "'inf'"),
        style("cubic viscosity 1 form sum", "'form'"),
        style("cubic interface", "Illegal pair_style hvi/sph interface command: missing argument"),
        style("cubic interface -0.3", "interface must be >= 0, not -0.3"),
        style("cubic interface nan", "'nan'"),
        style("cubic dissipation", "Illegal pair_style hvi/sph dissipation command: missing argument"),
        style("cubic dissipation godunov", "dissipation must be monaghan or riemann, not godunov"),
        style("cubic viscosity 1 2 dissipation riemann", "takes the place of viscosity and interface"),
        style("cubic dissipation riemann interface auto", "takes the place of viscosity and interface"),
        style("cubic dissipation riemann form symmetric", "has its own form of the equations"),
        style("lucy dissipation riemann stock yes", "has its own form of the equations"),
        style("cubic h", "Illegal pair_style hvi/sph h command: missing argument"),
        style("cubic h 1.2", "h must be constant or variable, not 1.2"),
        style("cubic h variable 0.5", "Illegal pair_style hvi/sph h command: missing argument"),
        style("cubic h variable 0 1.2", "0 < hmin <= 1 <= hmax, not 0 1.2"),
        style("cubic h variable 1.1 1.2", "0 < hmin <= 1 <= hmax, not 1.1 1.2"),
        style("cubic h variable 0.5 0.9", "0 < hmin <= 1 <= hmax, not 0.5 0.9"),
        style("cubic h variable 0.5 nan", "'nan'"),
        style("cubic h constant 0.5 1.2", "Unknown pair_style hvi/sph keyword: 0.5"),
        style("cubic energy", "Illegal pair_style hvi/sph energy command: missing argument"),
        style("cubic energy 2", "2"),
        style("cubic stock", "Illegal pair_style hvi/sph stock command: missing argument"),
        style("cubic stock maybe", "maybe"),
        style("cubic stock yes", "stock yes does what the package SPH does: kernel lucy"),
    ])


def test_pair_coeff(attempt):
    attempt([
        coeff("*", "pair_coeff"),
        coeff("* *", "Illegal pair_coeff hvi/sph command: missing argument"),
        coeff("1 3 eos tait 1 10 7 h 1.2", "3"),
        coeff("1 x eos tait 1 10 7 h 1.2", "x"),
        coeff("* * tait 1 10 7 h 1.2", "Unknown pair_coeff hvi/sph keyword: tait"),
        coeff("* * eos", "Illegal pair_coeff hvi/sph eos command: missing argument"),
        coeff("* * eos water 1 10 7 h 1.2", "Unknown equation of state water in pair_coeff hvi/sph: use one of linear"),
        coeff("* * eos tait 1 10", "eos tait needs rho0 c0 gamma"),
        coeff("* * eos tait 1 10 h 1.2", "eos tait needs rho0 c0 gamma, not h"),
        coeff("* * eos tait 1 10 7 8 h 1.2", "after the material must come h or spacing and its value, not 8"),
        coeff("* * eos tait -1 10 7 h 1.2", "eos tait: rho0 = -1 must be > 0"),
        coeff("* * eos tait 1 0 7 h 1.2", "eos tait: c0 = 0 must be > 0"),
        coeff("* * eos tait 1 10 nan h 1.2", "not nan"),
        coeff("* * eos tait 1 10 inf h 1.2", "not inf"),
        coeff("* * eos idealgas 1.0 h 1.2", "eos idealgas: gamma = 1 must be > 1"),
        coeff("* * eos tait 1 10 7", "after the material must come h or spacing and its value"),
        coeff("* * eos tait 1 10 7 h", "Illegal pair_coeff hvi/sph h command: missing argument"),
        coeff("* * eos tait 1 10 7 h 0", "h must be > 0, not 0"),
        coeff("* * eos tait 1 10 7 h -1.2", "h must be > 0, not -1.2"),
        coeff("* * eos tait 1 10 7 h nan", "'nan'"),
        coeff("* * eos tait 1 10 7 h wide", "'wide'"),
        coeff("* * eos tait 1 10 7 h 1.2 1.3", "unexpected 1.3 after h 1.2"),
        coeff("* * eos tait 1 10 7 h 1.2 strength", "Illegal pair_coeff hvi/sph strength command: missing argument"),
        coeff("* * eos tait 1 10 7 h 1.2 strength perfect", "strength must be none, not perfect: laws of strength are chosen by fix hvi/johnson-cook"),
        coeff("* * eos tait 1 10 7 h 1.2 strength none 3", "unexpected 3 after strength none"),
        coeff("* * file", "Illegal pair_coeff hvi/sph file command: missing argument"),
        coeff("* * file no.hvi h 1.2", "no.hvi"),
        coeff("1 2 eos tait 1 10 7 h 1.2", "a material is given to types I I"),
        coeff("1 1 eos tait 1 10 7 h 1.2", "coeffs are not set"),
        coeff("* * tension yes", "coeffs are not set"),
        coeff("* * tension", "Illegal pair_coeff hvi/sph tension command: missing argument"),
        coeff("1 2 tension 1.5", "1.5"),
        coeff("1 1 tension yes", "tension is for pairs of different types"),
        coeff("2 1 tension yes", "coeffs are not set"),
        coeff("* * viscosity 1", "Illegal pair_coeff hvi/sph viscosity command: missing argument"),
        coeff("* * viscosity -1 2", "viscosity must be >= 0, not -1"),
        coeff("* * viscosity 1 nan", "'nan'"),
        coeff("* * tension yes viscosity 1 2 3", "Unknown pair_coeff hvi/sph keyword: 3"),
        ("pair_coeff * * eos tait 1.0 10.0 7 h 1.2", "", "coeffs are not set"),
    ])


def test_scene(attempt):
    """units, atom style, integrators and what does not go with SPH"""
    lj = "pair_style lj/cut 1.0\npair_coeff * * 1 1\n"
    pair = GOOD[GOOD.index("pair_style"):GOOD.index("compute")]
    fix = GOOD[GOOD.index("fix move"):GOOD.index("timestep")]
    hybrid = "pair_style hybrid/overlay hvi/sph cubic lj/cut 1.0\npair_coeff 1 1 hvi/sph eos tait 1 10 7 h 1.2\npair_coeff 2 2 lj/cut 1 1\n"
    lucy = GOOD[GOOD.index("cubic"):GOOD.index("compute")]
    plain = GOOD.replace("atom_style sph", "atom_style atomic").replace("set group all sph/rho 1.0\n", "")
    attempt([
        *[("units lj", f"units {name}", "si, cgs, micro, nano or lj") for name in ("real", "metal", "electron")],
        ("units lj", "units lj\n", "Pair style hvi/sph needs density, energy and velocity estimates", plain),
        (plain[plain.index("pair_style"):], "fix 1 all hvi/sph\n", "Fix hvi/sph needs density, energy and velocity estimates", plain),
        (lucy, "lucy stock yes\npair_coeff * * eos linear 1 100 h 2.4\n", "stock yes knows eos tait and idealgas only, not linear"),
        ("set group all sph/rho 1.0", "run_style respa 2 2\nset group all sph/rho 1.0", "respa"),
        ("run 2", "minimize 0 1e-6 10 10", "does not support minimization"),
        (GOOD[GOOD.index("fix move"):], "min_style quickmin\nminimize 0 1e-6 10 10\n", "Pair style hvi/sph does not support minimization"),
        (fix, "fix move all hvi/sph now\n", "Unknown fix hvi/sph keyword: now"),
        (fix, "fix move all hvi/sph walls\n", "Illegal fix hvi/sph walls command: missing argument"),
        (fix, "fix move all hvi/sph walls sides\n", "Could not find fix hvi/sph walls group ID sides"),
        (fix, fix + "fix again all hvi/sph\n", "More than one fix hvi/sph"),
        (pair, lj, "Compute hvi/atom p needs pair style hvi/sph"),
        (GOOD[GOOD.index("pair_style"):GOOD.index("fix")], lj, "Fix hvi/sph needs pair style hvi/sph"),
        (GOOD[GOOD.index("cubic"):], "cubic h variable\npair_coeff * * eos tait 1 10 7 h 1.2\nfix 1 all nve\nrun 1\n",
         "h variable needs fix hvi/sph"),
        ("run 2", "fix d all deform 1 x erate 0.1 remap v\nrun 2", "fix deform with remap v"),
        (pair, hybrid + "pair_coeff 1 2 lj/cut 1 1\npair_coeff 1 2 hvi/sph tension yes\n", "type 2 has no material"),
        (pair, "pair_style hybrid hvi/sph cubic hvi/sph quintic\npair_coeff 1 1 hvi/sph 1 eos tait 1 10 7 h 1.2\n"
         "pair_coeff 2 2 hvi/sph 2 eos tait 1 10 7 h 1.2\npair_coeff 1 2 hvi/sph 1 tension no\n", "More than one pair style hvi/sph"),
        *[(pair, f"pair_style hybrid/overlay {styles}\npair_coeff * * sph/rhosum 2.4\npair_coeff * * hvi/sph eos tait 1 10 7 h 1.2\n",
           "integrates density, which pair style sph/rhosum writes over: leave it out, or use stock yes")
          for styles in ("sph/rhosum 1 hvi/sph cubic", "hvi/sph cubic sph/rhosum 1")],
    ])


def test_compute_hvi_atom(attempt):
    attempt([
        ("hvi/atom p", "hvi/atom", "Illegal compute hvi/atom command: missing argument"),
        ("hvi/atom p", "hvi/atom pressure", "Unknown compute hvi/atom value pressure: use p, e, T, c, h, eps"),
        ("hvi/atom p", "hvi/atom p t", "Unknown compute hvi/atom value t"),
        ("hvi/atom p", "hvi/atom p nbonds", "nbonds needs an atom style with bonds"),
    ])


def test_dimension(attempt):
    """a row or a plane of particles in a box of three dimensions"""
    plane = GOOD.replace("0 4 0 4\n", "0 4 0 1\n")
    flat = GOOD.replace("dimension 3", "dimension 2").replace("sc 1.0", "sq 1.0").replace("0 4 0 4\n", "0 4 -0.5 0.5\n")
    attempt([
        (*style("cubic dim 2", "dim 2: the box is only 1 long along z"), plane),
        (*style("cubic dim 1", "particles extend along 2 directions"), plane.replace("p p p", "p p f")),
        (*style("cubic dim 3", "dim must be 1 to 2 in a box of dimension 2, not 3"), flat),
        style("cubic dim 2", "particles extend along 3 directions"),
        style("cubic dim 1", "particles extend along 3 directions"),
    ])


BAD = "group one id 7\n{}\nrun 2\n"


def test_state(attempt):
    """a density at or below zero or no number, an energy that is none, an overlap: the particle is named"""
    nan = "variable bad atom 1e308*10-1e308*10+0*x\n"
    grow = "variable out atom 400*(x-2)\nvelocity one set 0 0 0\nvelocity all set v_out 0 0 sum yes\ntimestep 0.005"
    cases = [("run 2", BAD.format(text), says) for text, says in [
        ("set group one sph/rho 0.0", "particle 7 (type 1) has no density at step 0: give it one before the run"),
        ("region spot block 1 3 1 3 1 3\nfix drop all deposit 1 1 1 4711 region spot", "has no density at step 1: give it one before the run"),
        ("set group one sph/rho -1.0", "of particle 7 (type 1) has no answer at density -1 "),
        (nan + "set group one sph/rho v_bad", "of particle 7 (type 1) has no answer at density"),
        (nan + "set group one sph/e v_bad", "of particle 7 (type 1) has no answer at density 1 and energy"),
        (grow, "Lost atoms"),
        ("displace_atoms one move 1 0 0", "particles 7 and 8 are at the same place at step 0"),
        (nan + "velocity one set v_bad NULL NULL", "nan"),
    ]]
    attempt(cases)
    attempt([cases[2], cases[6]], nranks=2)


def test_nobody_integrates(lmp):
    """LAMMPS goes on, as other fixes than ours may do it, but says so"""
    text = GOOD.replace("fix move all hvi/sph", "fix move all nve")
    for fix in ("hvi/sph", "sph", "sph/stationary"):
        text += f"unfix move\nfix move all {fix}\nrun 1\n"
    warning = "no fix integrates density and energy and estimates velocities, as fix hvi/sph does"
    assert sum(warning in w for w in lmp(text).warnings) == 1


def test_kernel_gauss_in_hybrid(attempt, lmp):
    """gauss is a pair style too, which hybrid takes for the next of its styles: there the kernel is gaussian"""
    hybrid = GOOD.replace("hvi/sph cubic", "hybrid/overlay hvi/sph gaussian").replace("* * eos", "* * hvi/sph eos")
    attempt([("gaussian", "gauss", "pair_style", hybrid)])
    assert lmp(hybrid).thermo["Step"][-1] == 2
