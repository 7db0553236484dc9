"""Material files in LAMMPS: where they are found, units of file and run, what wrong ones are told."""

import numpy as np
import pytest

SCENE = """units {units}
boundary p p p
atom_style sph
atom_modify map array
region box block 0 {L} 0 {L} 0 {L}
create_box 1 box
create_atoms 1 single {x} {x} {x}
mass 1 {m}
pair_style hvi/sph cubic
pair_coeff 1 1 {material}
neighbor {skin} bin
set type 1 sph/rho {rho} sph/e {E}
fix sph all hvi/sph
compute a all hvi/atom p c T
compute s all reduce sum c_a[1] c_a[2] c_a[3]
thermo_style custom step c_s[1] c_s[2] c_s[3]
thermo_modify format float %.17g
run 0
"""

# of one kg, m, s in the units of the run: mass, length, time
SCALES = {"si": (1, 1, 1), "cgs": (1e3, 1e2, 1), "micro": (1e15, 1e6, 1e6), "lj": (1, 1, 1)}


def text(name, units="si", rho=2703.0, e=0.0, material="file {name} h {h}"):
    """one particle of 1 mm^3; rho, e in SI"""
    M, L, T = SCALES[units]
    m = rho * 1e-9
    fmt = "{:.17g}".format
    material = material.format(name=name, h=fmt(1.2e-3 * L))
    return SCENE.format(units=units, material=material, L=fmt(0.01 * L), x=fmt(0.005 * L), skin=fmt(1e-4 * L),
                        m=fmt(m * M), rho=fmt(rho * M / L**3), E=fmt(m * e * M * L**2 / T**2))


def state(result, units="si"):
    """p, c, T in SI"""
    M, L, T = SCALES[units]
    p, c, temperature = (result.thermo[f"c_s[{k}]"][0] for k in (1, 2, 3))
    return p / (M / L / T**2), c / (L / T), temperature


@pytest.fixture
def potentials(root):
    return root / "potentials"


GOOD = """# DATE: 2026-02-01 UNITS: si CITATION: nobody
eos gruneisen
  rho0 2703
  C 5240
  S1 1.4
  g0 1.97
  cp 885
"""


def test_hugoniot_of_al6061(lmp, potentials):
    """5941 m/s on the same: 75.465 GPa at 3952.1 kg/m^3"""
    u = 0.5 * 5941
    Us = 5240 + 1.4 * u
    rho = 2703 * Us / (Us - u)
    p, c, T = state(lmp(text("Al6061-T6.hvi", rho=rho, e=0.5 * u * u), env={"LAMMPS_POTENTIALS": str(potentials)}))
    assert rho == pytest.approx(3952.1, abs=0.05)
    assert p == pytest.approx(2703 * Us * u, rel=1e-10)
    assert p == pytest.approx(75.465e9, abs=5e5)
    assert 8000 < c < 10000 and 2000 < T < 3000


@pytest.mark.parametrize("nranks", [1, 2])
def test_every_material_is_found_and_read(lmp, potentials, nranks):
    files = sorted(f.name for f in potentials.glob("*.hvi"))
    assert len(files) == 26
    for name in files if nranks == 1 else files[:2]:
        head = (potentials / name).read_text()
        units, date = "lj" if "UNITS: lj" in head else "si", head.split()[2]
        result = lmp(text(name, units), nranks=nranks, env={"LAMMPS_POTENTIALS": str(potentials)})
        assert result.log.count(f"Reading material file {name} with DATE: {date}") == 1 and date[:3] == "202"
        p, c, T = state(result)
        assert np.isfinite(p) and c > 0, name


@pytest.mark.parametrize("units", ["si", "cgs", "micro"])
@pytest.mark.parametrize("file_units", ["si", "cgs"])
def test_units(lmp, tmp_path, units, file_units):
    """the same state has the same pressure, sound speed and temperature in all units"""
    content = GOOD
    if file_units == "cgs":
        for a, b in (("UNITS: si", "UNITS: cgs"), ("2703", "2.703"), ("5240", "5.24e5"), ("885", "8.85e6")):
            content = content.replace(a, b)
    (tmp_path / "al.hvi").write_text(content)
    rho, e = 3100.0, 7e5
    p, c, T = state(lmp(text("al.hvi", units, rho, e)), units)
    eta = 1 - 2703 / rho
    want = 2703 * 5240**2 * eta / (1 - 1.4 * eta) ** 2 * (1 - 0.5 * 1.97 * eta) + 2703 * 1.97 * e
    assert p == pytest.approx(want, rel=1e-12)
    first = state(lmp(text("al.hvi", "si", rho, e)))
    assert (c, T) == pytest.approx(first[1:], rel=1e-12)


def test_found_by_path_before_the_potentials_folder(lmp, tmp_path, potentials):
    (tmp_path / "Ta.hvi").write_text(GOOD.replace("5240", "1000"))
    env = {"LAMMPS_POTENTIALS": str(potentials)}
    assert state(lmp(text("Ta.hvi"), env=env))[1] == pytest.approx(1000)
    assert state(lmp(text(potentials / "Ta.hvi", rho=16690), env=env))[1] == pytest.approx(3410)


def refused(lmp, name, units="si", nranks=1, **how):
    result = lmp(text(name, units), expect_fail=True, nranks=nranks, timeout=60, **how)
    assert 0 < result.returncode < 128 and "Signal" not in result.stderr, result
    return " ".join(result.error.split())


def test_wrong_file_on_two_ranks(lmp, tmp_path):
    (tmp_path / "x.hvi").write_text(GOOD.replace("C 5240", "C fast"))
    assert "x.hvi:4: eos gruneisen: C: fast is not a number" in refused(lmp, "x.hvi", nranks=2)


@pytest.mark.parametrize("nranks", [1, 2])
def test_missing_file(lmp, tmp_path, nranks):
    says = "Cannot find material file unobtainium.hvi, neither here nor in LAMMPS_POTENTIALS"
    assert says in refused(lmp, "unobtainium.hvi", nranks=nranks, env={"LAMMPS_POTENTIALS": str(tmp_path)})


def test_without_potentials(lmp, root, tmp_path):
    """the files of the tree that LAMMPS was built in, by their names; what is in LAMMPS_POTENTIALS goes before"""
    for given in ("", str(tmp_path / "none")):
        env = {"LAMMPS_POTENTIALS": given}
        assert "Reading material file Pb.hvi" in lmp(text("Pb.hvi", "si"), env=env).log
        places = f"neither here nor in LAMMPS_POTENTIALS ({given or 'not set'}) or {root / 'potentials'}"
        for name in ("unobtainium.hvi", "folder/Pb.hvi"):
            assert f"Cannot find material file {name}, {places}" in refused(lmp, name, env=env)
    (tmp_path / "Pb.hvi").write_text("# UNITS: si\neos linear\n  rho0 fast\n")
    assert "Pb.hvi:3: eos linear: rho0: fast is not a number" in refused(lmp, "Pb.hvi", env={"LAMMPS_POTENTIALS": str(tmp_path)})


@pytest.mark.parametrize("file_units, units", [("si", "lj"), ("lj", "si")])
def test_units_that_do_not_convert(lmp, tmp_path, file_units, units):
    (tmp_path / "x.hvi").write_text(GOOD.replace("UNITS: si", f"UNITS: {file_units}"))
    assert f"UNITS: {file_units} cannot be converted to units {units} of the run" in refused(lmp, "x.hvi", units)


@pytest.mark.parametrize("coeff, says", [
    ("eos shock 1 2 h 1", "shock"),
    ("eos gruneisen 2703 5240 1.4 1.97 0.48 h 1e-3", "not h"),
    ("eos gruneisen -2703 5240 1.4 1.97 0.48 885 h 1e-3", "rho0 = -2703 must be > 0"),
    ("eos mie-gruneisen 2703 5240 1.4 -1.97 885 h 1e-3", "g0 = -1.97 must be >= 0"),
    ("eos idealgas 1 h 1e-3", "gamma = 1 must be > 1"),
    ("eos linear 2703 nan h 1e-3", "nan"),
    ("eos tillotson 2700 .5 1.63 75.2e9 65e9 5e6 3e6 13.9e6 5 5 h 1e-3", "needs rho0 a b A B E0 Eiv Ecv alpha beta cp"),
    ("eos tillotson 2700 .5 1.63 75.2e9 65e9 5e6 3e6 2e6 5 5 884 h 1e-3", "Ecv = 2e+06 must be > Eiv = 3e+06"),
])
def test_wrong_short_forms(lmp, coeff, says):
    result = lmp(text("", material=coeff), expect_fail=True, timeout=60)
    assert 0 < result.returncode < 128 and says in result.error, result
