"""python3 -m hvi plate and impacts: lattices of plates, and where a cloud will strike."""

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.analysis import maps
from hvi.io import mirror
from hvi.io.data import DataFile
from hvi.material import library
from hvi.model import plates
from scipy.spatial import cKDTree


def nearest(x):
    return cKDTree(x).query(x, k=2)[0][:, 1]


@pytest.mark.parametrize("angles", [[0], [30], [0, 45], [0, 45, 45, 0, 20, 70, 70, 20]], ids=str)
def test_lattice(angles):
    """16 mm across, 8 layers, finer through the thickness: what is where, and how much"""
    p = plates.make(8e-3, 0.8e-3, 0.2e-3, 8, angles)
    assert p.volume == pytest.approx([0.2e-3**2 * 1e-4])
    z = np.unique(np.round(p.x[:, 2], 12))
    assert z == pytest.approx((np.arange(8) + 0.5) * 1e-4)  # symmetric: half a step to either face
    assert np.hypot(*p.x[:, :2].T).max() < 8e-3
    assert len(p.x) * p.volume[0] == pytest.approx(np.pi * 8e-3**2 * 0.8e-3, rel=5e-3)
    for k, angle in enumerate(p.angles):
        sheet = p.x[np.abs(p.x[:, 2] - z[k]) < 1e-9, :2]
        assert nearest(sheet) == pytest.approx(0.2e-3), angle
        a = np.radians(angle)
        back = sheet @ np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) / 0.2e-3 - 0.5
        assert np.abs(back - np.round(back)).max() < 1e-6, angle  # turned by this angle and no other
    assert p.angles == pytest.approx(p.angles[::-1]) or len(angles) == 8


def test_quasi_isotropic_stack():
    assert list(plates.stack([0, 45], 8)) == [0, 45, 0, 45, 45, 0, 45, 0]
    assert list(plates.stack([0, 30, 60], 6)) == [0, 30, 60, 60, 30, 0]
    assert list(plates.stack([0, 90, 10], 3)) == [0, 90, 10]
    with pytest.raises(hvi.HVIError, match="multiple of 4 layers, not 6"):
        plates.stack([0, 45], 6)


@pytest.mark.parametrize("quarter", [False, True])
def test_zones(quarter):
    """Cells tile the plane: no mass is missing where the spacing doubles, and nothing is closer than in the finer zone"""
    p = plates.make(40e-3, 1e-3, 0.5e-3, 2, zones=[10e-3, 20e-3], quarter=quarter)
    assert list(p.spacing) == [0.5e-3, 1e-3, 2e-3]
    r = np.hypot(*p.x[:, :2].T)
    for k, (low, high) in enumerate([(0, 10e-3), (10e-3, 20e-3), (20e-3, 40e-3)]):
        mine = r[p.type == k + 1]
        assert mine.min() > low - 1.5e-3 and mine.max() < high + 1.5e-3
    inside = (np.abs(p.x[:, :2]) < 24e-3).all(axis=1)  # the borders of the widest cells
    assert p.volume[p.type[inside] - 1].sum() == pytest.approx(48e-3**2 * 1e-3 / (4 if quarter else 1))
    # each point of the plane is in one cell
    sheet = p.x[:, 2] < 0.5e-3
    at, half = p.x[sheet, :2], 0.5 * p.spacing[p.type[sheet] - 1]
    rng = np.random.default_rng(5)
    points = rng.uniform(0 if quarter else -20e-3, 20e-3, (2000, 2))
    owners = (np.abs(points[:, None, :] - at[None]) < half[None, :, None]).all(-1).sum(1)
    assert (owners == 1).all()


@pytest.mark.parametrize("angle", [0, 45, 90])
def test_quarter_with_its_mirrors_is_whole(angle):
    p = plates.make(8e-3, 0.4e-3, 0.2e-3, 2, [angle], quarter=True)
    assert p.x[:, :2].min() > 0.05e-3
    whole = np.concatenate([p.x * s for s in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, 1))])
    assert nearest(whole).min() > 0.139e-3  # 0.2/sqrt(2) across a mirror at 45 degrees
    assert len(whole) * p.volume[0] == pytest.approx(np.pi * 8e-3**2 * 0.4e-3, rel=1e-2)


@pytest.mark.parametrize("change, message", [
    (dict(layers=0), "at least one layer"), (dict(spacing=-1e-4), "thickness > 0 and a spacing"), (dict(thickness=0.0), "thickness > 0"),
    (dict(zones=[5e-3, 4e-3]), "must rise"), (dict(zones=[9e-3]), "below that of the plate"),
    (dict(angles=[30], quarter=True), "30 degrees has no mirrors"), (dict(angles=[45], zones=[4e-3], quarter=True), "with zones")], ids=str)
def test_wrong_plates(change, message):
    with pytest.raises(hvi.HVIError, match=message):
        plates.make(**{**dict(radius=8e-3, thickness=0.8e-3, spacing=0.2e-3), **change})


def test_lammps_reads_it(lmp, root, tmp_path, capsys):
    """mass = density of the material file times volume, at the place it is shifted to, two types after the one that is there"""
    material = root / "potentials" / "Al2024-T3.hvi"
    assert cli.main(["plate", "w.data", "--radius", "8e-3", "--thickness", "0.8e-3", "--spacing", "0.4e-3", "--zones", "4e-3",
                     "--material", str(material)]) == 0
    said = dict(line.split(": ") for line in capsys.readouterr().out.splitlines() if ": " in line)
    data = DataFile("w.data")
    assert data.masses == pytest.approx({1: 2785 * 0.4e-3**3, 2: 2785 * 0.8e-3**2 * 0.4e-3})
    r = lmp("""units si
atom_style sph
atom_modify map array
boundary f f f
region box block 0 1e-3 0 1e-3 0 1e-3
create_box 3 box
mass 1 1
read_data w.data add append offset 1 0 0 0 0 shift 0 0 0.05 group wall
compute rho all sph/rho/atom
pair_style hvi/sph cubic
pair_coeff * * eos tait 2785 5000 7 h 1e-3
compute rhos all reduce ave c_rho
thermo_style custom step c_rhos
run 0
print "mass $(mass(wall)) $(count(wall)) $(bound(wall,zmin)) $(bound(wall,zmax))"
""")
    mass, count, low, high = map(float, [line for line in r.log.splitlines() if line.startswith("mass ")][-1].split()[1:])
    assert mass == pytest.approx(float(said["mass"]), rel=1e-5) and count == int(said["particles"])
    assert (low, high) == pytest.approx((0.0502, 0.0506))
    assert r.thermo["c_rhos"][-1] == pytest.approx(2785)


def test_density_of_material_files(root, tmp_path):
    assert library.density_of(root / "potentials" / "Cu-OFHC.hvi") == (8930.0, "si")
    for path in (root / "potentials").glob("*.hvi"):
        assert library.density_of(path)[0] > 0, path
    (tmp_path / "no.hvi").write_text("# UNITS: cgs\neos tait\n  rho0 2.7\n  c0 5e5\n")
    assert library.density_of(tmp_path / "no.hvi") == (2.7, "cgs") and library.density_of(tmp_path / "no.hvi", si=True) == (pytest.approx(2700), "si")
    for text, si, said in (("si\nstrength perfect\n  rho0 3\n", False, "strength perfect: unknown key rho0"), ("si\neos idealgas\n  gamma 1.4\n", False, "no rho0"),
                           ("lj\neos linear\n  rho0 1\n  K 1\n", True, "no rho0 .* SI")):
        (tmp_path / "no.hvi").write_text(f"# UNITS: {text}")
        with pytest.raises(hvi.HVIError, match=f"no.hvi.*: {said}"):
            library.density_of(tmp_path / "no.hvi", si)


def cloud(planes=()):
    x = np.array([[1.2, 2.2, 0], [0.5, 0.5, -5], [1, 1, 3], [0, 0, 12]], dtype=float)
    v = np.array([[0.1, 0, 1], [0, 0, 2], [0, 0, -1], [0, 0, 1]], dtype=float)
    columns = {"id": np.arange(1, 5), "mass": np.array([1.0, 2.0, 1.0, 1.0])}
    columns.update({name: x[:, k] for k, name in enumerate("xyz")})
    columns.update({"v" + name: v[:, k] for k, name in enumerate("xyz")})
    return hvi.Frame(columns, units="lj", mirror=planes)


def test_impacts():
    """two of four are on the way: to (2.2, 2.2) with p = 1 and e = 0.505, and to (0.5, 0.5) with p = 4 and e = 4"""
    found = maps.impacts(cloud(), "z", 10.0, bins=8, reach=4.0)
    assert found.summary["particles"] == 2 and found.summary["momentum"] == 5.0
    assert found.summary["kinetic_energy"] == pytest.approx(4.505)
    assert found.summary["first_arrival_in"] == pytest.approx(7.5)
    assert found.momentum[6, 6] == 1.0 and found.momentum[4, 4] == 4.0 and found.momentum.sum() == 5.0
    assert found.energy[6, 6] == pytest.approx(0.505)
    assert maps.impacts(cloud(), "z", 10.0, after=-1.0).summary["particles"] == 1
    four = maps.impacts(cloud(mirror.of_words(["x=0", "y=0"])), "z", 10.0, bins=8, reach=4.0)
    assert four.momentum.sum() == 20.0 and (four.momentum == four.momentum[::-1]).all() and (four.momentum == four.momentum[:, ::-1]).all()
    with pytest.raises(hvi.HVIError, match="nothing is on the way"):
        maps.impacts(cloud(), "z", -10.0)
