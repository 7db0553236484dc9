"""examples/whipple-shield with walls of elements: they break as particles do, the books stay closed, a run that is killed goes on, and where elements
cannot break the verdict is undecided."""

import hvi
import pytest
import yaml
from hvi import shield_mesh

CLOCK = "wall_s", "core_s", "particle_steps_per_s"
SMALL = dict(quarter="yes", dx=0.4, spacing=12, radius1=9, radius2=14, tstop=5)
WALL = {"side": 20e-3, "thickness": 0.8e-3, "element": 0.8e-3, "n": 2, "core": 4e-3, "hold": 8e-3, "growth": 1.2, "largest": 3e-3, "quarter": True, "type": 2, "node_type": 4}
REAR = {**WALL, "side": 32e-3, "core": 7e-3, "hold": 14e-3, "type": 3, "node_type": 5}


@pytest.fixture
def shield(lmp, root, tmp_path):
    def run(folder="run", meshes=(WALL, REAR), fails=False, kill=None, nranks=1, **variables):
        files = [tmp_path / f"{folder}{k}.data" for k in range(len(meshes))]
        for file, words in zip(files, meshes):
            shield_mesh.write(file, str(root / "potentials" / "Al2024-T3.hvi"), **words)
        given = {"out": tmp_path / folder, **({"plate": files} if files else {}), **variables}
        r = lmp(root / "examples" / "whipple-shield" / "in.whipple", cwd=tmp_path / folder, expect_fail=fails, kill=kill, nranks=nranks,
                env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars=given)
        return r if fails or kill else yaml.safe_load((tmp_path / folder / "result.yaml").read_text())

    return run


@pytest.mark.parametrize("nranks", [1, 2])
def test_hybrid_walls(shield, tmp_path, nranks):
    """beside all-SPH: holes, clouds, momentum; and what became of the elements"""
    r, sph = shield(nranks=nranks, method="hybrid", **SMALL), shield("sph", meshes=(), **SMALL)
    assert (r["method"], sph["method"], sph["elements"], sph["elements_left"]) == ("hybrid", "sph", 0, 0)
    assert 0 < r["elements_left"] < r["elements"] and r["elements"] == sum(hvi_mesh(words).quality()["elements"] for words in (WALL, REAR))
    assert abs(r["energy_ratio"] - 1) < 1e-4 and r["momentum_error"] < 1e-12 and abs(r["mass_error"]) < 1e-12
    for key, rel in (("hole1_diameter_mm", 0.12), ("wall1_cloud_velocity_ratio", 0.1), ("wall1_cloud_energy_ratio", 0.02), ("wall1_momentum_ratio", 0.03),
                     ("wall1_energy_ratio", 0.03), ("wall2_momentum_ratio", 0.05), ("wall2_energy_ratio", 0.1), ("front_velocity_m_s", 0.02)):
        assert r[key] == pytest.approx(sph[key], rel=rel), key
    assert 0 < r["wall1_converted_fraction"] < 0.2 and 0 < r["wall2_converted_fraction"] < 0.3
    assert 0 < r["conversion_heat_ratio"] < 0.01 and 0 < r["hourglass_energy_ratio"] < 0.02
    warned = [text for text in r.get("notes", []) if "energy have become heat" in text or "in hourglass forces" in text]
    assert len(warned) == (r["conversion_heat_ratio"] > 1e-3) + (r["hourglass_energy_ratio"] > 1e-3)
    assert r["verdict"] == "undecided" and any("2 layer(s) of particles" in text for text in r["reasons"])
    assert not any("farther out" in text for text in r["reasons"])
    frame = hvi.Dump(str(tmp_path / "run" / "shield.dump"))[0]
    assert set(frame["type"]) == {1, 2, 3}  # nodes are in no dump
    plan = yaml.safe_load((tmp_path / "run" / "plan.yaml").read_text())
    assert plan["wall1_elements"] + plan["wall2_elements"] == r["elements"] and plan["settings"]["method"] == "hybrid"


def hvi_mesh(words):
    from hvi.mesh_plate import plate

    return plate(**words)


def test_a_run_with_elements_goes_on(shield, tmp_path):
    """killed when wall 2 is about to be made: the same bits"""
    vars = dict(SMALL, method="hybrid", keep=0.3)
    whole = shield("whole", **vars)
    dump = tmp_path / "part" / "cloud1.dump"
    shield("part", kill=dump.exists, **vars)
    assert 'variable reached equal "1"' in (tmp_path / "part" / "shield.state").read_text()
    part = shield("part", resume="yes", **vars)
    assert [(key, part[key], value) for key, value in whole.items() if part[key] != value and key not in CLOCK] == []
    assert (tmp_path / "part" / "shield.dump").read_bytes() == (tmp_path / "whole" / "shield.dump").read_bytes()


ALONE = dict(quarter="yes", dx=0.4, walls=1, tstop=3, keep=-1)
NARROW = {**WALL, "core": 0.8e-3, "hold": 2.8e-3, "node_type": 3}


def test_elements_that_cannot_break(shield):
    """too few of them hold particles: they fail and stay, and the others become particles to the last: no verdict"""
    r = shield(meshes=(NARROW,), method="hybrid", radius1=10, **ALONE)
    undecided(r, "elements that hold no particles have failed and stay -- take a mesh that holds particles farther out")
    undecided(r, "wall 1 has become particles up to elements that hold none")
    assert r["conversion_heat_ratio"] > 1e-3 and any("have become heat when elements became particles" in text for text in r["notes"])


def test_tied_elements_do_not_break(shield):
    r = shield(meshes=({**WALL, "node_type": 3},), method="tied", radius1=10, **ALONE)
    undecided(r, "method tied lets no element become particles -- take method hybrid")
    assert r["elements_left"] == r["elements"] and r["conversion_heat_ratio"] == 0 and abs(r["energy_ratio"] - 1) < 1e-5


@pytest.mark.parametrize("words, variables, message", [
    ({}, {"method": "fem"}, "method must be sph, hybrid or tied, not fem"),
    (None, {"method": "hybrid"}, "method hybrid needs walls of elements: -var plate with a file"),
    ({}, {"method": "hybrid", "zones": 2}, "zones must be 1 with method hybrid, not 2"),
    ({}, {"method": "hybrid", "probes": "yes"}, "probes are patches of particles, and need method sph, not hybrid"),
    ({"thickness": 1.2e-3}, {"method": "hybrid"}, "must have type 2 with nodes of type 3, be 0.8 mm thick, with sheets of particles 0.4 mm apart, and reach out to 10 mm"),
    ({"n": 3}, {"method": "hybrid"}, "is 0.8 mm thick, with sheets 0.2667 mm apart, and reaches out to 10 mm"),
    ({"side": 19e-3}, {"method": "hybrid"}, "and reaches out to 9.5 mm"),
    ({"node_type": 1}, {"method": "hybrid"}, "and 0 nodes of those")])
def test_wrong_input(shield, words, variables, message):
    meshes = () if words is None else ({**WALL, "node_type": 3, **words},)
    r = shield(meshes=meshes, fails=True, radius1=10, **{**ALONE, **variables})
    assert message in r.stdout + r.log, r.stdout[-2000:]


def undecided(r, text):
    assert r["verdict"] == "undecided" and len([said for said in r["reasons"] if text in said]) == 1, r["reasons"]
