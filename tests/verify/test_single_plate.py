"""examples/single-plate, coarse and short: a hole, a cloud and closed books; quarter models; other materials, angles, shapes."""

import hvi
import numpy as np
import pytest
import yaml
from hvi import bodies, mesh_plate
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

KEYS = """particles steps time_us wall_s ranks particle_steps_per_s energy_ratio energy_missed_ratio momentum_error mass_error lammps_version package_version
    hole_diameter_mm front_velocity_m_s cloud_length_mm cloud_diameter_mm length_ratio axial_velocity_ratio fragments fragmentation
    largest_fragment_mass_fraction pieces_apart largest_apart_mass_fraction largest_rear_mass_fraction projectile_fails_in_tension
    plate_fails_in_tension""".split()


def plate(lmp, root, folder, nranks=1, fails=False, **variables):
    folder.mkdir(exist_ok=True)
    r = lmp(root / "examples" / "single-plate" / "in.plate", nranks=nranks, cwd=folder, expect_fail=fails,
            env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
    return r if fails else yaml.safe_load((folder / "result.yaml").read_text())


@pytest.mark.parametrize("nranks", [1, 2])
def test_default(lmp, root, tmp_path, nranks):
    """measured at 16 us: 24.7 mm, 6.3 km/s; the front and the books are there at 6 us already"""
    r = plate(lmp, root, tmp_path, nranks=nranks, tstop=6)
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
            vars=dict(out=tmp_path, quarter="yes", dx=1.25, Rplate=15, tstop=1, eta=eta))
    assert not [w for w in r.warnings if "cutoff" in w], r.warnings


def test_quarter_is_the_whole(lmp, root, tmp_path):
    """every measure, after impact and passage"""
    quarter, whole = [plate(lmp, root, tmp_path / q, quarter=q, tstop=8, Rplate=25) for q in ("yes", "no")]
    assert 4 * quarter["particles"] == whole["particles"]
    for key in ("hole_diameter_mm", "front_velocity_m_s", "cloud_length_mm", "cloud_diameter_mm", "cloud_mass_g", "cloud_kinetic_J"):
        assert quarter[key] == pytest.approx(whole[key], rel=1e-2), key
    assert abs(quarter["energy_ratio"] - 1) < 1e-3 and quarter["momentum_error"] < 1e-10


@pytest.mark.parametrize("D, t", [(6, 30), (6, 3), (10, 20)])
def test_a_plate_of_any_thickness_is_whole(lmp, root, tmp_path, D, t):
    """its layers of 1 mm are all there: plates thicker than 1.5 D were cut off at the end of the box"""
    plate(lmp, root, tmp_path, quarter="yes", dx=1, Rplate=15, tstop=0.02, D=D, t=t)
    layer = sum((i + 0.5) ** 2 + (j + 0.5) ** 2 < 15**2 for i in range(15) for j in range(15))
    assert yaml.safe_load((tmp_path / "plan.yaml").read_text())["plate_particles"] == t * layer


def test_runs_on_behind_the_last_frame(lmp, root, tmp_path):
    r = plate(lmp, root, tmp_path, quarter="yes", dx=1.25, Rplate=15, frame=[1, 2], tstop=3)
    assert r["time_us"] == pytest.approx(3, abs=0.1)
    assert sorted(f.name for f in tmp_path.glob("frame.*")) == ["frame.1.dump", "frame.2.dump", "frame.3.dump"]


@pytest.mark.parametrize("nranks, D", [(1, 10), (2, 10), (1, 9)])
def test_rear_half(lmp, root, tmp_path, nranks, D):
    """what of the half away from the plate hangs together, from the dumps by SciPy: particles known by their place in the first frame, without a layer in the middle"""
    r = plate(lmp, root, tmp_path, nranks=nranks, quarter="yes", Rplate=20, v0=3500, frame=[0.0625, 8], tstop=8, D=D)
    first, last = [hvi.Dump(tmp_path / f"frame.{t}.dump", mirror="none")[-1] for t in ("0.0625", "8")]
    rear = first["id"][(first["type"] == 1) & (first["z"] < -0.5e-3 * D - 1e-4 + 3500 * first.time)]
    x = last.x[np.isin(last["id"], rear)]
    pairs = cKDTree(x).query_pairs(1.5e-3, output_type="ndarray")
    piece = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), (len(x), len(x))))[1]
    assert len(x) == len(rear) and (len(x) == (first["type"] == 1).sum() / 2 if D == 10 else 0.4 < len(x) / (first["type"] == 1).sum() < 0.5)
    assert r["largest_rear_mass_fraction"] == pytest.approx(np.bincount(piece).max() / len(x), abs=1e-5)
    assert 0.02 < r["largest_rear_mass_fraction"] < 0.98 and r["largest_rear_mass_fraction"] != r["largest_apart_mass_fraction"]


def test_says_what_does_not_fail(lmp, root, tmp_path):
    """a plate whose file has no section for the law that is asked for: in the result and at the end of the log"""
    r = lmp(root / "examples" / "single-plate" / "in.plate", cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")},
            vars=dict(out=tmp_path, quarter="yes", dx=1.25, Rplate=15, tstop=1, material_t="Al6061-T6-Esposito2024.hvi"))
    result = yaml.safe_load((tmp_path / "result.yaml").read_text())
    assert (result["projectile_fails_in_tension"], result["plate_fails_in_tension"]) == (1, 0)
    said = [line for line in r.log.splitlines() if line.startswith("note: ")]  # not the commands that print it
    assert said == ["note: the plate, Al6061-T6-Esposito2024.hvi, does not fail in tension with damage no spall voids thermal yes"]


@pytest.mark.parametrize("variables", [
    dict(material_p="Cu-OFHC.hvi", v0=3000), dict(angle=45), dict(shape="cylinder"), dict(v0=1000, t=5), dict(damage="yes", edge="clamped")], ids=str)
def test_variants(lmp, root, tmp_path, variables):
    r = plate(lmp, root, tmp_path, tstop=2, dx=1.25, Rplate=20, **variables)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-10


@pytest.mark.parametrize("nranks, method, keep", [(1, "hybrid", 0), (2, "hybrid", 1), (1, "tied", 0)])
def test_elements_are_as_particles(lmp, root, tmp_path, nranks, method, keep):
    """a wall with elements around free particles: what breaks comes out as with particles alone, within a spacing; over restart files, too"""
    mesh_plate.plate(2e-3, 2e-3, side=40e-3, n=2, core=10e-3, hold=16e-3, growth=1.2, largest=4e-3, quarter=True, type=2, node_type=3).write(tmp_path / "wall.data", 2703.0)
    common = dict(quarter="yes", Rplate=20, tstop=4)
    sph = plate(lmp, root, tmp_path / "sph", **common)
    r = plate(lmp, root, tmp_path / "fem", nranks=nranks, method=method, plate=tmp_path / "wall.data", keep=keep, **common)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-12 and abs(r["mass_error"]) < 1e-12
    assert r["front_velocity_m_s"] == pytest.approx(sph["front_velocity_m_s"], rel=2e-3)
    for key, bound in (("cloud_length_mm", 0.05), ("cloud_diameter_mm", 0.05), ("hole_diameter_mm", 0.05)):
        assert r[key] == pytest.approx(sph[key], rel=bound), key
    wrong = plate(lmp, root, tmp_path / "wrong", fails=True, method=method)
    assert f"method {method} needs a plate with elements" in wrong.stdout


@pytest.mark.parametrize("quarter", ["no", "yes"])
def test_bodies_of_glass(lmp, root, tmp_path, quarter):
    """both from files: their masses, to the last digit, not those of sites; a wrong length is refused"""
    sphere, wall = bodies.sphere(5e-3, quarter=quarter == "yes"), bodies.cylinder(20e-3, 2e-3, quarter=quarter == "yes", middle=1e-3)
    for name, shape in (("ball.data", sphere), ("wall.data", wall)):
        bodies.write(tmp_path / name, bodies.make(shape, 1e-3), 2703)
    how = dict(dx=1, Rplate=20, shape="ball.data", plate="wall.data", quarter=quarter, tstop=2)
    r = plate(lmp, root, tmp_path, **how)
    assert abs(r["energy_ratio"] - 1) < 1e-3 and abs(r["mass_error"]) < 1e-12
    assert 10 < r["hole_diameter_mm"] < 20 and r["cloud_mass_g"] > 0.5
    frame = hvi.Dump(tmp_path / "frame.2.dump", mirror=["none"])[-1]
    for k, shape in ((1, sphere), (2, wall)):
        assert frame.m[frame["type"] == k].sum() == pytest.approx(2703 * shape.volume, rel=5e-6)  # six digits, as dumps have
    stopped = plate(lmp, root, tmp_path, fails=True, **{**how, "D": 8})
    assert "D = 8 mm is not the length of the body" in stopped.log + stopped.stdout


@pytest.mark.parametrize("variables,message", [
    (dict(quarter="half"), "quarter must be yes or no"), (dict(quarter="yes", angle=10), "angle must be 0"),
    (dict(shape="cube"), "shape must be"), (dict(edge="glued"), "edge must be"), (dict(plate="no-such.data"), "plate must be plain or a file"),
    (dict(material_p="Unobtainium.hvi"), "Unobtainium.hvi"), (dict(damage="maybe"), "maybe"), (dict(spall="often"), "often"),
    (dict(dx=0), "dx must be above 0"), (dict(v0=0), "v0 must be above 0"), (dict(D=-1), "D must be above 0"), (dict(dx=6), "two particles across"),
    (dict(angle=90), "angle must be from 0 to less than 90"), (dict(Rplate=4), "the plate must be wider than the projectile"),
    (dict(dry="maybe"), "dry must be yes or no"), (dict(D=1e5, Rplate=1e5), "more than LAMMPS can number"), (dict(tstopp=3), "did you mean tstop?"),
    (dict(v0=5.9), "is below 100 m/s, which this model is not for: is it in km/s?"), (dict(dx=2, frame=[4, 1]), "each after the one before: 1 is not")], ids=str)
def test_wrong_input(lmp, root, tmp_path, variables, message):
    r = plate(lmp, root, tmp_path, fails=True, **variables)
    assert message in r.log + r.stdout


@pytest.mark.parametrize("case, used", [(dict(dx=1), 67), (dict(dx=0.5, quarter="yes"), 165), (dict(dx=0.4, quarter="yes"), 288),
                                        (dict(dx=0.6, quarter="yes", v0=4000, D=8, t=3), 98)], ids=str)
def test_memory_of_the_plan(lmp, root, tmp_path, case, used):
    """MB at most in the whole run on one rank, by /usr/bin/time -v; the last was not looked at for the formula"""
    lmp(root / "examples" / "single-plate" / "in.plate", vars=dict(case, dry="yes", out=tmp_path), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert yaml.safe_load((tmp_path / "plan.yaml").read_text())["memory_MB"] == pytest.approx(used, rel=0.2)


def test_out_is_one_word(lmp, root, tmp_path):
    """LAMMPS would take a path with a blank for two, and remove a file that is no business of its"""
    (tmp_path / "some").touch()
    r = lmp(root / "examples" / "single-plate" / "in.plate", cwd=tmp_path, expect_fail=True, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": "some folder"})
    assert "out must be one word: a path without blanks" in r.log + r.stdout and (tmp_path / "some").exists()


def test_plan_and_log(lmp, root, tmp_path):
    """what is planned is what is run, where a frame comes before the end of the trial too; a line for each 2 % of the time, no warning twice, nothing
    said twice of a scene that stays; a dry run stops before"""
    case = dict(dx=1.25, Rplate=20, quarter="yes", frame=[0.5, 4, 9], tstop=6)
    r = lmp(root / "examples" / "single-plate" / "in.plate", vars=dict(case, dry="yes", out=tmp_path), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    plan = yaml.safe_load((tmp_path / "plan.yaml").read_text())
    assert "This was the plan" in r.log and not list(tmp_path.glob("*.dump")) + list(tmp_path.glob("result.yaml")) + list(tmp_path.glob("plate.*"))
    (tmp_path / "run").mkdir()
    r = lmp(root / "examples" / "single-plate" / "in.plate", vars=dict(case, out=tmp_path / "run"), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    result = yaml.safe_load((tmp_path / "run" / "result.yaml").read_text())
    assert result["particles"] == plan["projectile_particles"] + plan["plate_particles"] and plan["plate_layers"] == pytest.approx(2, rel=0.05)
    assert result["steps"] == pytest.approx(plan["steps"], rel=0.4) and plan["tstop_us"] == 6 and plan["seconds"] > 0 and plan["memory_MB"] > 20
    frames = [tmp_path / "run" / f"frame.{us}.dump" for us in ("0.5", "4", "6")]
    assert plan["disk_MB"] == pytest.approx(1e-6 * sum(f.stat().st_size for f in frames), abs=0.1)
    us, stage = [np.concatenate([run[name] for run in r.runs]) for name in ("v_us", "v_stage")]
    assert 40 < len(np.unique(us)) < 70 and np.diff(us).max() < 0.2 and set(stage) == {1, 1.5} and np.all(np.diff(stage) >= 0)
    assert len(set(r.warnings)) == len(r.warnings) and r.log.count("material: laws") == 1
    table = r.log[r.log.index("until us    steps        s"):].splitlines()[1:5]
    times, steps = [[float(row.split()[k]) for row in table[:3]] for k in (0, 1)]
    assert times == pytest.approx([0.5, 4, 6], abs=0.2) and sum(steps) == int(table[3].split()[1]) == result["steps"]
