"""examples/single-plate, coarse and short: a hole, a cloud and closed balances; a quarter and whole bodies; elements; other materials, angles, shapes."""

import hvi
import numpy as np
import plate_scenes
import pytest
import yaml
from hvi.model import bodies, mesh_plate
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

KEYS = """particles steps time_us core_s ranks energy_ratio energy_missed_ratio momentum_error mass_error lammps_version package_version
    hole_diameter_mm front_velocity_m_s cloud_length_mm cloud_diameter_mm length_ratio axial_velocity_ratio fragments fragmentation
    largest_fragment_mass_fraction pieces_apart largest_apart_mass_fraction largest_rear_mass_fraction projectile_fails_in_tension
    plate_fails_in_tension""".split()


def plate(lmp, root, folder, nranks=1, fails=False, script="in.plate", edits=None, **variables):
    """result.yaml of a run in the folder; edits: words of plate_scenes.text()"""
    text = plate_scenes.text(**edits) if edits else plate_scenes.FOLDER / script
    r = lmp(text, nranks=nranks, cwd=folder, expect_fail=fails, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
    return r if fails else yaml.safe_load((folder / "result.yaml").read_text())


def frames(folder):
    """frames of a run in order of time, without images"""
    return [hvi.Dump(path, mirror="none")[-1] for path in sorted(folder.glob("frame.*.dump"))]


WHOLE = {"quarter": False}


@pytest.mark.parametrize("nranks", [pytest.param(1, marks=pytest.mark.long), 2])
def test_default(lmp, root, tmp_path, nranks):
    """the front and the balance are there at 6 us; the hole is on its way"""
    r = plate(lmp, root, tmp_path, nranks=nranks, edits=WHOLE, tstop=6)
    assert [k for k in KEYS if k not in r] == []
    assert r["particles"] == 10600 and r["time_us"] == pytest.approx(6, abs=0.1)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-12 and r["mass_error"] == 0
    assert 5000 < r["front_velocity_m_s"] < 7000
    assert 12 < r["hole_min_mm"] <= r["hole_diameter_mm"] <= r["hole_max_mm"] < 27
    assert 0.5 < r["fragmentation"] <= 1  # the sphere is rubble


@pytest.mark.parametrize("eta", [1.2, 1.0])
def test_ghosts_of_fragments(lmp, root, tmp_path, eta):
    """fragments are looked for at 2.9 spacings, forces at 3.1 by default and 2.7 with a small eta: neither an error nor a warning"""
    r = lmp(root / "examples" / "single-plate" / "in.plate", cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")},
            vars=dict(out=tmp_path, dx=1.25, Rplate=15, tstop=1, eta=eta))
    assert not [w for w in r.warnings if "cutoff" in w], r.warnings


def test_quarter_is_the_whole(lmp, root, tmp_path):
    """every measure, after impact and passage"""
    quarter, whole = [plate(lmp, root, tmp_path / name, edits=edits, tstop=8, Rplate=25) for name, edits in (("quarter", None), ("whole", WHOLE))]
    assert 4 * quarter["particles"] == whole["particles"]
    for key in ("hole_diameter_mm", "front_velocity_m_s", "cloud_length_mm", "cloud_diameter_mm", "cloud_mass_g", "cloud_kinetic_J"):
        assert quarter[key] == pytest.approx(whole[key], rel=1e-2), key
    assert abs(quarter["energy_ratio"] - 1) < 1e-3 and quarter["momentum_error"] < 1e-10


@pytest.mark.parametrize("D, t", [(6, 30), (6, 3), (10, 20)])
def test_a_plate_of_any_thickness_is_whole(lmp, root, tmp_path, D, t):
    """its layers of 1 mm are all there: plates thicker than 1.5 D were cut off at the end of the box"""
    plate(lmp, root, tmp_path, dx=1, Rplate=15, tstop=0.02, D=D, t=t)
    layer = sum((i + 0.5) ** 2 + (j + 0.5) ** 2 < 15**2 for i in range(15) for j in range(15))
    assert np.sum(frames(tmp_path)[0]["type"] == 2) == t * layer


@pytest.mark.parametrize("dx, t, layers", [(1, 1.6, 2), (1, 1.4, 1), (0.8, 0.3, 1), (0.8, 2.4, 3)])
def test_plates_have_whole_layers(lmp, root, tmp_path, dx, t, layers):
    """and the result says what was made of the thickness"""
    r = plate(lmp, root, tmp_path, dx=dx, Rplate=8, tstop=0.02, t=t)
    z = frames(tmp_path)[0]
    z = z["z"][z["type"] == 2]
    assert len(np.unique(np.round(z, 9))) == layers and z.max() == pytest.approx(1e-3 * dx * (layers - 0.5), rel=1e-6) and r["plate_mm"] == pytest.approx(dx * layers, rel=1e-6)


def test_a_wide_projectile_is_whole(lmp, root, tmp_path):
    """beside a plate that is narrower"""
    plate(lmp, root, tmp_path, dx=1, Rplate=3, tstop=0.02)
    wide, narrow = frames(tmp_path)[0], plate(lmp, root, tmp_path / "usual", dx=1, tstop=0.02) and frames(tmp_path / "usual")[0]
    assert np.sum(wide["type"] == 1) == np.sum(narrow["type"] == 1)


def test_frames(lmp, root, tmp_path):
    """at the start, every us, and the end in a file of its own, once each"""
    r = plate(lmp, root, tmp_path, dx=1.25, Rplate=15, frame=1, tstop=2.5)
    times = [1e6 * frame.time for frame in frames(tmp_path)]
    assert r["time_us"] == pytest.approx(2.5, abs=0.1) and times[0] == 0 and times == pytest.approx([0, 1, 2], abs=0.1)
    assert 1e6 * hvi.Dump(tmp_path / "plate.dump")[-1].time == pytest.approx(r["time_us"], abs=1e-3)


@pytest.mark.parametrize("nranks, D", [(1, 10), (2, 10), (1, 9)])
def test_rear_half(lmp, root, tmp_path, nranks, D):
    """what of the half away from the plate hangs together, from the dumps by SciPy: particles known by their place in the first frame, without a layer in the middle"""
    r = plate(lmp, root, tmp_path, nranks=nranks, Rplate=20, v0=3500, tstop=8, D=D)
    first, last = frames(tmp_path)[0], hvi.Dump(tmp_path / "plate.dump", mirror="none")[-1]
    rear = first["id"][(first["type"] == 1) & (first["z"] < -0.5e-3 * D - 1e-4)]
    x = last.x[np.isin(last["id"], rear)]
    pairs = cKDTree(x).query_pairs(1.5e-3, output_type="ndarray")
    piece = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), (len(x), len(x))))[1]
    assert len(x) == len(rear) and (len(x) == (first["type"] == 1).sum() / 2 if D == 10 else 0.4 < len(x) / (first["type"] == 1).sum() < 0.5)
    assert r["largest_rear_mass_fraction"] == pytest.approx(np.bincount(piece).max() / len(x), abs=1e-5)
    assert 0.02 < r["largest_rear_mass_fraction"] < 0.98 and r["largest_rear_mass_fraction"] != r["largest_apart_mass_fraction"]


def test_says_what_does_not_fail(lmp, root, tmp_path):
    """a plate whose file has no section for the law that is asked for"""
    result = plate(lmp, root, tmp_path, dx=1.25, Rplate=15, tstop=1, material_t="Al6061-T6-Esposito2024.hvi")
    assert (result["projectile_fails_in_tension"], result["plate_fails_in_tension"]) == (1, 0)


@pytest.mark.parametrize("edits, variables", [(None, dict(material_p="Cu-OFHC.hvi", v0=3000)), ({"quarter": False, "angle": True}, dict(angle=45)),
                                              (None, dict(v0=1000, t=5)), (None, dict(damage="yes"))], ids=str)
def test_variants(lmp, root, tmp_path, edits, variables):
    r = plate(lmp, root, tmp_path, edits=edits, tstop=2, dx=1.25, Rplate=20, **variables)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-10


@pytest.mark.parametrize("nranks, fem", [(1, "strain 0.3"), (2, "strain 0.3"), (1, "strain 0.3 convert no")])
def test_elements_are_as_particles(lmp, root, tmp_path, nranks, fem):
    """in.hybrid: a plate of elements around free particles: what breaks comes out as with particles alone, within a spacing"""
    mesh_plate.plate(2e-3, 2e-3, side=40e-3, n=2, core=10e-3, hold=16e-3, growth=1.2, largest=4e-3, quarter=True, type=2, node_type=3).write(tmp_path / "plate.data", 2703.0)
    sph = plate(lmp, root, tmp_path / "sph", Rplate=20, tstop=4)
    r = plate(lmp, root, tmp_path / "fem", nranks=nranks, script="in.hybrid", plate=tmp_path / "plate.data", fem=fem, tstop=4)
    assert set(sph) == set(r) and set(hvi.Dump(tmp_path / "fem" / "plate.dump")[-1]["type"]) == {1, 2}  # no nodes in dumps
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-12 and abs(r["mass_error"]) < 1e-12
    assert r["front_velocity_m_s"] == pytest.approx(sph["front_velocity_m_s"], rel=2e-3)
    for key, bound in (("cloud_length_mm", 0.05), ("cloud_diameter_mm", 0.05), ("hole_diameter_mm", 0.05)):
        assert r[key] == pytest.approx(sph[key], rel=bound), key


@pytest.mark.parametrize("quarter", [pytest.param(False, marks=pytest.mark.long), True])
def test_bodies_of_glass(lmp, root, tmp_path, quarter):
    """both from files, read where in.plate creates them: their masses, to the last digit, not those of sites"""
    sphere, wall = bodies.sphere(5e-3, quarter=quarter), bodies.cylinder(20e-3, 2e-3, quarter=quarter, middle=1e-3)
    for name, shape in (("ball.data", sphere), ("wall.data", wall)):
        bodies.write(tmp_path / name, bodies.make(shape, 1e-3), 2703)
    r = plate(lmp, root, tmp_path, edits=dict(quarter=quarter, body="ball.data", wall="wall.data"), dx=1, Rplate=20, tstop=2)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and abs(r["mass_error"]) < 1e-12
    assert 10 < r["hole_diameter_mm"] < 20 and r["cloud_mass_g"] > 0.5
    frame = hvi.Dump(tmp_path / "plate.dump", mirror=["none"])[-1]
    for k, shape in ((1, sphere), (2, wall)):
        assert frame.m[frame["type"] == k].sum() == pytest.approx(2703 * shape.volume, rel=5e-6)  # six digits, as dumps have


@pytest.mark.parametrize("variables,message", [
    (dict(material_p="Unobtainium.hvi"), "Unobtainium.hvi"), (dict(damage="maybe"), "maybe"), (dict(spall="often"), "often"), (dict(tstopp=3), "did you mean tstop?"),
    (dict(dx=0), "dx must be a number above 0"), (dict(D=-1), "D must be a number above 0"), (dict(out="no/such/folder"), "Cannot open dump file")], ids=str)
def test_wrong_input(lmp, root, tmp_path, variables, message):
    """LAMMPS's errors, before the first step"""
    r = plate(lmp, root, tmp_path, fails=True, **{"out": ".", **variables})
    assert message in r.log[-400:] + r.stdout[-400:] and "Loop time" not in r.stdout


def test_log(lmp, root, tmp_path):
    """no warning; the scene is described once"""
    r = lmp(plate_scenes.FOLDER / "in.plate", env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars=dict(dx=1.25, Rplate=20, tstop=6))
    assert r.warnings == [] and r.log.count("material: laws") == 1
