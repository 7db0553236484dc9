"""Tillotson's equation of state and tables in LAMMPS: tables from Python, both ways to name them, units, restart, wrong ones."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq

from hvi import HVIError
from hvi.material.eos_table import write_eos_table

SCENE = """units {units}
boundary p p p
atom_style sph
atom_modify map array
region box block 0 {L} 0 {L} 0 {L}
create_box 1 box
create_atoms 1 single {x} {x} {x}
mass 1 {m}
pair_style hvi/sph cubic
pair_coeff 1 1 {material} h {h}
neighbor {skin} bin
set type 1 sph/rho {rho} sph/e {E}
fix sph all hvi/sph
{more}
compute a all hvi/atom p c T
compute s all reduce sum c_a[1] c_a[2] c_a[3]
thermo_style custom step c_s[1] c_s[2] c_s[3]
thermo_modify format float %.17g
run 0
"""

# of one kg, m, s in the units of the run: mass, length, time
SCALES = {"si": (1, 1, 1), "cgs": (1e3, 1e2, 1), "micro": (1e15, 1e6, 1e6)}


def text(material, units="si", rho=2900.0, e=5e5, more=""):
    """one particle; rho, e in SI"""
    M, L, T = SCALES[units]
    m = rho * 1e-9
    fmt = "{:.17g}".format
    return SCENE.format(units=units, material=material, L=fmt(0.01 * L), x=fmt(0.005 * L), h=fmt(1.2e-3 * L),
                        skin=fmt(1e-4 * L), m=fmt(m * M), rho=fmt(rho * M / L**3), E=fmt(m * e * M * L**2 / T**2), more=more)


def state(result, units="si"):
    """p, c, T in SI"""
    M, L, T = SCALES[units]
    p, c, temperature = (result.thermo[f"c_s[{k}]"][0] for k in (1, 2, 3))
    return p / (M / L / T**2), c / (L / T), temperature


RHO0, C0, S, G0 = 2703.0, 5240.0, 1.4, 1.97


def mie_gruneisen(rho, e):
    eta = 1 - RHO0 / rho
    if eta <= 0:
        return C0**2 * (rho - RHO0) + RHO0 * G0 * e
    return RHO0 * C0**2 * eta / (1 - S * eta) ** 2 * (1 - 0.5 * G0 * eta) + RHO0 * G0 * e


def write(path, units="si", **how):
    """aluminum from 2433 to 4055 kg/m^3, with a node at its reference state"""
    M, L, T = SCALES[units]
    rho = RHO0 * np.linspace(0.9, 1.5, 61)
    e = np.linspace(-1e5, 3e6, 32)
    p = np.array([[mie_gruneisen(r, x) for x in e] for r in rho])
    temperature = 300 + np.array([[x / 885 for x in e]] * len(rho))
    how = {"rho0": RHO0 * M / L**3, **how}
    write_eos_table(path, rho * M / L**3, e * L**2 / T**2, p * M / L / T**2, temperature, units=units, **how)
    return path


def tillotson(rho, e):
    """Al-Tillotson.hvi, typed once more"""
    x = rho / 2700
    mu, z = x - 1, 1 / x - 1
    heat = 1.63 * rho * e / (1 + e / (5e6 * x**2))
    dense = 0.5 * rho * e + heat + 75.2e9 * mu + 65e9 * mu**2
    vapor = 0.5 * rho * e + (heat + 75.2e9 * mu * np.exp(-5 * z)) * np.exp(-5 * z**2)
    if mu >= 0 or e <= 3e6:
        return dense
    return vapor if e >= 13.9e6 else ((e - 3e6) * vapor + (13.9e6 - e) * dense) / (13.9e6 - 3e6)


@pytest.mark.parametrize("rho, e", [(3500, 2e6), (2500, 1e6), (1500, 6e6), (300, 1.3e7), (1000, 2e7), (3000, 2e7)])
def test_tillotson(lmp, root, rho, e):
    env = {"LAMMPS_POTENTIALS": str(root / "potentials")}
    file = state(lmp(text("file Al-Tillotson.hvi", rho=rho, e=e), env=env))
    short = state(lmp(text("eos tillotson 2700 0.5 1.63 75.2e9 65e9 5e6 3e6 13.9e6 5 5 884", rho=rho, e=e)))
    assert file == short
    assert short[0] == pytest.approx(tillotson(rho, e), rel=1e-12)
    if rho < 2700:
        assert short[2] == pytest.approx(300 + e / 884)
    d = 1e-3
    e1, e2 = (e + k * d * tillotson(rho, e) / rho**2 for k in (1, -1))  # to second order along the isentrope
    slope = (tillotson(rho + d, e1) - tillotson(rho - d, e2)) / (2 * d)
    assert short[1] ** 2 == pytest.approx(slope, rel=1e-6)


@pytest.mark.each_value
@pytest.mark.parametrize("density", ["linear", "log"])
@pytest.mark.parametrize("interpolation, of_p, of_c", [("bilinear", 1e-4, 0.03), ("bicubic", 1e-7, 1e-5)])
def test_table_gives_the_formula(lmp, tmp_path, density, interpolation, of_p, of_c):
    """to what the spacing of 1 % in density allows, three nodes away from the law's kink: p in units of rho0 c0^2, c relative"""
    write(tmp_path / "al.table", density=density, interpolation=interpolation)
    law = "eos mie-gruneisen 2703 5240 1.4 1.97 885"
    for rho, e in ((2791.0, 7e4), (3507.0, 1.93e6)):
        p, c, T = state(lmp(text("eos table al.table", rho=rho, e=e)))
        assert p == pytest.approx(mie_gruneisen(rho, e), abs=of_p * RHO0 * C0**2)
        assert c == pytest.approx(state(lmp(text(law, rho=rho, e=e)))[1], rel=of_c)
        assert T == pytest.approx(300 + e / 885, rel=1e-9)


@pytest.mark.parametrize("nranks", [1, 2])
def test_both_ways_to_name_it(lmp, tmp_path, nranks):
    folder = tmp_path / "potentials"
    folder.mkdir()
    write(folder / "al.table", date="2026-02-01")
    (folder / "al.hvi").write_text("# UNITS: cgs\neos table\n  file al.table\nspall limit\n  sigma_p 1e10\n")
    env = {"LAMMPS_POTENTIALS": str(folder)}
    one, two = (lmp(text(words), nranks=nranks, env=env) for words in ("eos table al.table", "file al.hvi"))
    short = state(one)
    assert short == state(two)
    assert [r.log.count("Reading table file al.table with DATE: 2026-02-01") for r in (one, two)] == [1, 1]
    assert short[0] == pytest.approx(mie_gruneisen(2900.0, 5e5), rel=1e-6)


@pytest.mark.parametrize("material", ["file Al-Tillotson.hvi", "eos table al.table"])
def test_plates_meet(lmp, root, tmp_path, material):
    """the example of Howto_sph with other laws: behind the shocks p = rho0 Us u, u = 1000 m/s, e = u^2/2"""
    write(tmp_path / "al.table")
    (example,) = re.findall(r"(?=   # two aluminum plates)(.*?)\n(?=\S)", (root / "doc/src/Howto_sph.rst").read_text(), re.S)
    rho0, law = (2700, tillotson) if "Tillotson" in material else (2703, mie_gruneisen)
    old = "eos gruneisen 2703 5240 1.4 1.97 0.48 885"
    assert old in example
    example = example.replace(old, material)
    thermo = lmp(example, env={"LAMMPS_POTENTIALS": str(root / "potentials")}).thermo
    rho = brentq(lambda r: law(r, 5e5) - rho0 * 1e6 / (1 - rho0 / r), 1.01 * rho0, 1.49 * rho0)
    assert thermo["c_mean"][-1] == pytest.approx(law(rho, 5e5), rel=0.02)
    assert abs(thermo["c_book[9]"] - 1).max() < 1e-4


def test_the_example_of_the_docs(lmp, root, tmp_path):
    (code,) = re.findall(r"code-block:: python\n(.*?)\n(?=\S)", (root / "doc/src/Howto_materials.rst").read_text(), re.S)
    exec(re.sub(r"^   ", "", code, flags=re.M), {})
    p, c, T = state(lmp(text("eos table gas.table", rho=1.2, e=2.5e5)))
    assert p == pytest.approx(0.4 * 1.2 * 2.5e5, rel=1e-5)
    assert c**2 == pytest.approx(1.4 * 0.4 * 2.5e5, rel=1e-4)


@pytest.mark.each_value
@pytest.mark.parametrize("units", ["si", "cgs", "micro"])
@pytest.mark.parametrize("file_units", ["si", "cgs", "micro"])
def test_units(lmp, tmp_path, units, file_units):
    write(tmp_path / "al.table", units=file_units)
    p, c, T = state(lmp(text("eos table al.table", units)), units)
    assert p == pytest.approx(mie_gruneisen(2900.0, 5e5), rel=1e-6)
    assert 5000 < c < 8000
    assert T == pytest.approx(300 + 5e5 / 885, rel=1e-9)


def test_restart_reads_it_again(lmp, tmp_path):
    write(tmp_path / "al.table")
    first = state(lmp(text("eos table al.table", more="run 0\nwrite_restart r")))
    again = text("eos table al.table").split("fix sph")[1]
    assert state(lmp("read_restart r\nfix sph" + again)) == first
    (tmp_path / "al.table").unlink()
    result = lmp("read_restart r\nfix sph" + again, expect_fail=True)
    assert "Cannot find table file al.table" in result.error


def refused(lmp, material, nranks=1, **how):
    result = lmp(text(material, **how), expect_fail=True, nranks=nranks, timeout=60)
    assert 0 < result.returncode < 128 and "Signal" not in result.stderr, result
    return " ".join(result.error.split())


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("rho, e", [(2000.0, 0.0), (4100.0, 0.0), (3000.0, -2e5), (3000.0, 3.1e6)])
def test_out_of_range_at_run_time(lmp, tmp_path, nranks, rho, e):
    write(tmp_path / "al.table")
    error = refused(lmp, "eos table al.table", nranks=nranks, rho=rho, e=e)
    assert ("equation of state table al.table (densities 2432.7 to 4054.5, energies -100000 to 3e+06) of particle 1 (type 1) "
            f"has no answer at density {rho:g}") in error


TABLE = """# UNITS: si
rho0 1.5
interpolation bilinear

pressure 3 2
e     0    2
1    -1    0
1.5   0    1.5
2     1    3
"""


def test_the_table_above_is_right(lmp, tmp_path):
    (tmp_path / "x.table").write_text(TABLE)
    assert state(lmp(text("eos table x.table", rho=1.75, e=1.0)))[0] == pytest.approx((0 + 1.5 + 1 + 3) / 4)


@pytest.mark.parametrize("nranks", [1, 2])
def test_wrong_table_in_a_material_file(lmp, tmp_path, nranks):
    (tmp_path / "x.hvi").write_text("# UNITS: si\neos table\n  file x.table\n")
    says = "x.hvi:3: eos table: Cannot find table file x.table, neither here nor in LAMMPS_POTENTIALS"
    assert says in refused(lmp, "file x.hvi", nranks)
    (tmp_path / "x.table").write_text(TABLE.replace("1.5   0", "1.5   x"))
    assert "x.hvi:3: eos table: x.table:8: pressure: x is not a number" in refused(lmp, "file x.hvi", nranks)


def test_missing_words(lmp, tmp_path):
    assert "Cannot find table file x.table" in refused(lmp, "eos table x.table")
    (tmp_path / "h").write_text(TABLE)  # so h is taken for the file
    assert "after the material must come h or spacing and its value, not" in refused(lmp, "eos table")


@pytest.mark.parametrize("how, says", [
    ({"units": "metal"}, "unknown units metal"),
    ({"density": "cubic"}, "density must be linear or log"),
    ({"interpolation": "spline"}, "interpolation must be bilinear or bicubic"),
    ({"rho": [1, 1]}, "densities must be two or more finite numbers that increase"),
    ({"rho": [0, 1]}, "densities must be > 0"),
    ({"e": [0, np.nan]}, "energies must be two or more"),
    ({"pressure": [[1, 2]]}, "pressure must have a row per density"),
    ({"pressure": [[1, 2], [3, np.inf]]}, "pressure must be finite"),
    ({"temperature": lambda rho, e: np.nan}, "temperature must be finite"),
    ({"comment": "UNITS: cgs"}, "the comment must be plain ASCII"),
    ({"path": "nowhere/x.table"}, "cannot write nowhere/x.table"),
])
def test_writer_refuses(how, says):
    good = {"path": "x.table", "rho": [1, 2], "e": [0, 1], "pressure": lambda rho, e: rho * e}
    write_eos_table(**good)
    with pytest.raises(HVIError, match=says):
        write_eos_table(**{**good, **how})
