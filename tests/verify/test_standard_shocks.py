"""examples/standard-shocks: the inputs run, measure what they say, and agree with the scenes of tests/verify/shocks.py"""

import re
import sys

import numpy as np
import pytest
from reference import impedance

MONAGHAN, AUTO = "viscosity 1 2", "viscosity 1 2 interface auto"
AL_CU = dict(file_f="Al2024-T3.hvi", rho_f=impedance.AL2024.rho0, c_f=impedance.AL2024.c0, s_f=impedance.AL2024.s,
             file_t="Cu-OFHC.hvi", rho_t=impedance.COPPER.rho0, c_t=impedance.COPPER.c0, s_t=impedance.COPPER.s)


@pytest.fixture(scope="module")
def example(root):
    sys.path.insert(0, str(root / "examples" / "standard-shocks"))
    return root / "examples" / "standard-shocks"


@pytest.fixture
def run(lmp, root, example, tmp_path):
    """what plot.py makes of a run of an input of the example"""

    def one(script, **variables):
        import plot

        folder = tmp_path / "-".join([script, *(str(a).replace(" ", "-") for a in variables.values())])
        folder.mkdir()
        lmp(example / script, vars={**variables, "out": folder}, cwd=folder, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
        done = plot.Run(str(folder))
        plot.single(done)
        assert (folder / "profile.png").stat().st_size > 10000
        assert done.result["energy_ratio"] == pytest.approx(1, abs=1e-3)
        assert done.result["momentum_error"] < 1e-12 and done.result["mass_error"] == 0.0
        return done

    return one


@pytest.mark.parametrize("script, variables, case, n", [
    ("in.sod", dict(n=400), "sod", 400),
    ("in.sod", dict(n=200, masses="unequal", pair=MONAGHAN), "sod-spacing", 200),
    ("in.sod", dict(n=100, p_l=1000.0, p_r=0.01, rho_r=1.0, tstop=0.012), "blast-left", 100),
    ("in.noh", dict(n=100), "noh-1d", 100),
    pytest.param("in.noh", dict(n=25, dim=2), "noh-2d", 25, marks=pytest.mark.long),
    ("in.noh", dict(n=8, dim=3, pair=AUTO), "noh-3d", 8),
    pytest.param("in.flyer", dict(n=100, v0=5000), "al-al-5000", 100, marks=pytest.mark.long),
    ("in.flyer", dict(n=100, v0=5750, **AL_CU), "al-cu-5750", 100),
])
def test_as_the_scene(run, lmp_exe, tmp_path, script, variables, case, n):
    """the same problem as in tests/lib/shock_scenes.py, set up in LAMMPS's own words: the same errors"""
    import shock_runs
    import shock_scenes

    method = {MONAGHAN: "monaghan", AUTO: "interface"}.get(variables.get("pair"), "riemann")
    got = run(script, **variables)
    scene = shock_runs.run(shock_scenes.CASES[case], method, n, lmp_exe, tmp_path / "scene")
    assert got.result["particles"] == scene.particles
    assert got.l1 == pytest.approx(scene.l1, rel=5e-3)  # limits of h are rounder, plates have another frame


def test_plateau(run):
    """exact values by hand (u = v0/2; u and P of Al 2024 on Cu as in tests/verify/test_shock_references.py), measured within 0.1 %"""
    r = run("in.flyer", n=100, v0=2000).result
    assert r["velocity_exact_m_s"] == pytest.approx(1000) and r["shock_speed_exact_m_s"] == pytest.approx(5240 + 1.4 * 1000)
    assert r["pressure_exact_Pa"] == pytest.approx(2703 * 6640 * 1000)
    assert r["density_exact_kg_m3"] == pytest.approx(2703 * 6640 / 5640, rel=1e-6)
    for k in ("pressure", "density", "velocity", "shock_speed"):
        unit = dict(pressure="Pa", density="kg_m3", velocity="m_s", shock_speed="m_s")[k]
        assert r[f"{k}_error"] == pytest.approx(r[f"{k}_{unit}"] / r[f"{k}_exact_{unit}"] - 1, abs=1e-5)
        assert abs(r[f"{k}_error"]) < 1e-3
    u, p = impedance.match(impedance.AL2024, impedance.COPPER, 5750.0)
    r = run("in.flyer", n=50, v0=5750, **AL_CU).result
    assert r["velocity_exact_m_s"] == pytest.approx(u, rel=1e-6) and r["pressure_exact_Pa"] == pytest.approx(p, rel=1e-6)


def test_steps_of_sod(run):
    """no step is longer than that of the gas at rest; none shorter than that of its h, the fastest sound and all of the shock's
    velocity between two neighbors"""
    from reference import gas

    n, tstop = 80, 0.1
    left, right = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1)
    rho, u, p = states = gas.sample(np.linspace(-2, 2, 1001), left, right)
    assert rho.max() == 1.0  # the nearest neighbors are those at rest
    length = 0.2 * 1.5 * 1.2 / n  # C l, l = 1.5 h of the kernel gauss, h = 1.2 spacings
    longest, shortest = length / gas.sound(left, 1.4), length / (1.6 * gas.sound(states, 1.4).max() + 1.36 * u.max())
    assert tstop / longest < run("in.sod", n=n, tstop=tstop).result["steps"] < tstop / shortest + 5  # five equal ones at the end


def test_hugoniots_are_those_of_the_files(root, example):
    """in the input, in run.sh and in the command of README.md"""
    found = []
    for name in ("in.flyer", "run.sh", "README.md"):
        text = " ".join(re.sub(r"variable (\w+) +index (\S+).*", r"-var \1 \2", (example / name).read_text()).replace("\\\n", " ").split())
        found += re.findall(r"-var file_(\w) (\S+) -var rho_\1 (\S+) -var c_\1 (\S+) -var s_\1 ([\d.]+)", text)
    assert len(found) == 6
    for _, name, *values in found:
        eos = (root / "potentials" / name).read_text().split("eos gruneisen")[1].split("\n\n")[0]
        assert [float(v) for v in values] == [float(re.search(rf"^ *{k} +(\S+)", eos, re.M).group(1)) for k in ("rho0", "C", "S1")]
