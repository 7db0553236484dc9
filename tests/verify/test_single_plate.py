"""examples/single-plate, coarse and short: a hole, a cloud and a closed ledger; other materials, angles, shapes."""

import pytest
import yaml


def plate(lmp, root, folder, nranks=1, **variables):
    lmp(root / "examples" / "single-plate" / "in.plate", nranks=nranks, cwd=folder,
        env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
    return yaml.safe_load((folder / "result.yaml").read_text())


@pytest.mark.parametrize("nranks", [1, 2])
def test_default(lmp, root, tmp_path, nranks):
    """4,500 particles: measured 26.1 mm, 6.2 km/s at 16 us; the front and the ledger are there at 6 us already"""
    r = plate(lmp, root, tmp_path, nranks=nranks, tstop=6)
    assert r["particles"] == 4504
    assert abs(r["energy_ratio"] - 1) < 1e-3
    assert 5000 < r["front_velocity_m_s"] < 7000
    assert 0.2 < r["rubble_fraction"] < 0.7
    assert 12 < r["hole_min_mm"] <= r["hole_diameter_mm"] <= r["hole_max_mm"] < 27


@pytest.mark.parametrize("variables", [
    dict(mat_p="Cu-OFHC.hvi", rho_p=8930, v0=3000), dict(angle=45), dict(shape="cylinder"), dict(v0=1000, t=5)], ids=str)
def test_variants(lmp, root, tmp_path, variables):
    r = plate(lmp, root, tmp_path, tstop=2, dx=1.25, **variables)
    assert abs(r["energy_ratio"] - 1) < 1e-3


def test_density_of_another_material_is_noticed(lmp, root, tmp_path):
    r = lmp(root / "examples" / "single-plate" / "in.plate", cwd=tmp_path, vars={"out": tmp_path, "mat_p": "Cu-OFHC.hvi"}, expect_fail=True,
            env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert "is not that of the material file" in r.log
