"""Examples of impacts that are killed in flight go on, and end as if they had not been."""

import re
import shutil

import pytest
import yaml
from conftest import read_thermo

PLATE = dict(quarter="yes", dx=1.25, frame=[2, 5], tstop=7)
SHIELD = dict(quarter="yes", dx=0.8, spacing=12, tstop=7)
CLOCK = "wall_s", "core_s", "particle_steps_per_s"


@pytest.fixture
def example(lmp, root, tmp_path):
    def run(script, folder, **kw):
        vars = {"out": tmp_path / folder, **kw.pop("vars", {})}
        return lmp(root / "examples" / script, cwd=tmp_path / folder, vars=vars, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)

    return run


@pytest.fixture
def plate(example):
    return lambda folder, **kw: example("single-plate/in.plate", folder, **kw)


@pytest.fixture
def shield(example):
    return lambda folder, **kw: example("whipple-shield/in.whipple", folder, **kw)


def result(folder):
    r = yaml.safe_load((folder / "result.yaml").read_text())
    return {key: value for key, value in r.items() if key not in CLOCK}


def steps_of(state):
    """the step that a state is of, -1 if there is none yet"""
    found = re.search(r"variable (?:at|saved) equal \"(\d+)\"", state.read_text()) if state.exists() else None
    return int(found.group(1)) if found else -1


def logged(file):
    """steps of thermo output, those before it was stopped too"""
    return sorted({step for run in read_thermo(file.read_text()) for step in run["Step"]})


def stopped(run, state, after, **kw):
    """a run that is killed when its state is of a later step"""
    r = run(kill=lambda: steps_of(state) > after, **kw)
    assert "resume yes" in r.stdout or "resume yes" in r.log  # how to go on
    return steps_of(state)


@pytest.mark.parametrize("nranks", [pytest.param(1, marks=pytest.mark.long), 2])  # on one: test_plate_killed_while_it_writes
def test_plate_has_the_same_bits(plate, tmp_path, nranks):
    """on the same ranks; all that is told again is where it is"""
    plate("whole", nranks=nranks, vars=PLATE)
    at = stopped(lambda **kw: plate("part", **kw), tmp_path / "part" / "plate.state", 40, nranks=nranks, vars=PLATE)
    assert 40 < at < result(tmp_path / "whole")["steps"]
    plate("part", nranks=nranks, vars=dict(resume="yes"))
    assert result(tmp_path / "part") == result(tmp_path / "whole")
    assert len(re.findall("^LAMMPS .*|^until us", (tmp_path / "part" / "log.plate").read_text(), re.M)) == 1  # the table of the end
    assert logged(tmp_path / "part" / "log.plate") == logged(tmp_path / "whole" / "log.plate")
    for frame in (2, 5, 7):
        one, two = [(tmp_path / f / f"frame.{frame}.dump").read_bytes() for f in ("whole", "part")]
        assert one == two, frame
    assert not list(tmp_path.glob("*/plate.*"))  # nothing is left over


def test_plate_goes_on(plate, tmp_path):
    """on other ranks; not from half a file, nor with other variables; nor twice"""
    plate("whole", vars=PLATE)
    whole = result(tmp_path / "whole")
    stopped(lambda **kw: plate("part", **kw), tmp_path / "part" / "plate.state", 40, vars=PLATE)
    text = (tmp_path / "part" / "plate.state").read_text()
    turn = re.search("turn string \"([ab])", text).group(1)
    for folder in ("ranks", "other", "half", "swapped", "changed"):
        shutil.copytree(tmp_path / "part", tmp_path / folder)
    mine, other = [f"plate.restart.{x}" for x in (turn, "ab".replace(turn, ""))]
    data = (tmp_path / "part" / mine).read_bytes()

    plate("ranks", nranks=2, vars=dict(resume="yes"))
    r = result(tmp_path / "ranks")
    assert r.pop("ranks") == 2 and r["time_us"] == pytest.approx(7, abs=0.1)
    for key in ("hole_diameter_mm", "front_velocity_m_s", "cloud_mass_g", "cloud_kinetic_J", "energy_ratio"):
        assert r[key] == pytest.approx(whole[key], rel=0.03), key
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-12  # books go on, too

    # a file that was being written when the run was killed is the other one
    (tmp_path / "other" / other).write_bytes(data[: len(data) // 2])
    (tmp_path / "other" / "plate.state.part").write_text(text[:30])
    plate("other", vars=dict(resume="auto", **PLATE))
    assert result(tmp_path / "other") == whole

    (tmp_path / "half" / mine).write_bytes(data[: len(data) // 2])
    r = plate("half", vars=dict(resume="yes"), expect_fail=True)
    assert not (tmp_path / "half" / "result.yaml").exists() and r.returncode > 0, r

    (tmp_path / "swapped" / "plate.state").write_text(re.sub(r'at equal "\d+"', 'at equal "7"', text))
    r = plate("swapped", vars=dict(resume="yes"), expect_fail=True)
    assert re.search(rf"{mine} is of step \d+, plate.state of 7", r.log)

    r = plate("changed", vars=dict(resume="yes", dx=1.0), expect_fail=True)
    assert "a variable has changed: dx was '1.25', and is '1.0' now" in r.error
    r = plate("changed", vars=dict(resume="yes", frame=[2, 5, 6]), expect_fail=True)
    assert "a variable has changed: frame was '2 5', and is '2 5 6' now" in r.error

    r = plate("whole", vars=dict(resume="yes"), expect_fail=True)
    assert "nothing to resume" in r.log
    r = plate("whole", vars=dict(resume="perhaps"), expect_fail=True)
    assert "resume must be yes, no or auto, not perhaps" in r.log


def test_plate_killed_while_it_writes(plate, tmp_path):
    """the second restart file, which appears with its first byte"""
    plate("whole", vars=PLATE)
    plate("part", vars=PLATE, kill=(tmp_path / "part" / "plate.restart.b").exists)
    plate("part", vars=dict(resume="yes"))
    assert result(tmp_path / "part") == result(tmp_path / "whole")


def test_plate_begins_anew(plate, tmp_path):
    """auto begins if there is nothing to go on with; no restart files if none are wanted"""
    vars = dict(PLATE, dx=2.5, tstop=3)
    plate("auto", vars=dict(vars, resume="auto"))
    plate("none", vars=dict(vars, keep=0))
    one, two = result(tmp_path / "auto"), result(tmp_path / "none")
    assert one["steps"] == two["steps"] and one["hole_diameter_mm"] == pytest.approx(two["hole_diameter_mm"], rel=0.01)


def test_plate_with_the_plugin(plate, tmp_path, lmp_stock, plugin, monkeypatch):
    """which LAMMPS loads again when the run reads its restart file"""
    vars = dict(PLATE, dx=2.5, tstop=3)
    plate("built-in", vars=vars)
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin.parent))
    plate("plugin", exe=lmp_stock, vars=vars)
    one, two = result(tmp_path / "built-in"), result(tmp_path / "plugin")
    assert one["steps"] == two["steps"] and one["hole_diameter_mm"] == pytest.approx(two["hole_diameter_mm"], rel=0.01)


def bytes_of(folder, pattern):
    return {f.name: f.read_bytes() for f in folder.glob(pattern)}


@pytest.mark.parametrize("nranks", [pytest.param(1, marks=pytest.mark.long), 2])  # on one: test_shield_goes_on
def test_shield_has_the_same_bits(shield, tmp_path, nranks):
    """killed behind wall 2; all that is told again is where it is"""
    shield("whole", nranks=nranks, vars=SHIELD)
    state = tmp_path / "part" / "shield.state"
    at = stopped(lambda **kw: shield("part", **kw), state, 80, nranks=nranks, vars=SHIELD)
    assert 80 < at < result(tmp_path / "whole")["steps"] and 'variable reached equal "2"' in state.read_text()
    shield("part", nranks=nranks, vars=dict(resume="yes"))
    assert result(tmp_path / "part") == result(tmp_path / "whole")
    assert bytes_of(tmp_path / "part", "*.dump") == bytes_of(tmp_path / "whole", "*.dump")
    assert logged(tmp_path / "part" / "log.whipple") == logged(tmp_path / "whole" / "log.whipple")
    assert not [f for f in tmp_path.glob("*/shield.*") if f.name != "shield.dump"]  # nothing is left over


def test_shield_goes_on(shield, tmp_path):
    """killed while wall 2 is made: on one rank and on two; not with other variables"""
    shield("whole", vars=SHIELD)
    shield("part", vars=SHIELD, kill=(tmp_path / "part" / "cloud1.dump").exists)
    assert 'variable reached equal "1"' in (tmp_path / "part" / "shield.state").read_text()
    for folder in ("one", "two"):
        shutil.copytree(tmp_path / "part", tmp_path / folder)
    r = shield("part", vars=dict(resume="yes", t2=1.0), expect_fail=True)
    assert "a variable has changed: t2 was '0.8', and is '1.0' now" in r.error

    shield("one", vars=dict(resume="yes"))
    whole, one = result(tmp_path / "whole"), result(tmp_path / "one")
    assert one == whole and bytes_of(tmp_path / "one", "*.dump") == bytes_of(tmp_path / "whole", "*.dump")
    shield("two", nranks=2, vars=dict(resume="yes"))
    two = result(tmp_path / "two")
    assert two.pop("ranks") == 2 and two["verdict"] == whole["verdict"] and two["wall2_perforated"] is whole["wall2_perforated"]
    for key in ("hole1_diameter_mm", "hole2_diameter_mm", "wall1_passed_mass_mg", "wall1_energy_ratio", "wall2_momentum_ratio"):
        assert two[key] == pytest.approx(whole[key], rel=0.1), key
    assert abs(two["energy_ratio"] - 1) < 1e-3 and two["momentum_error"] < 1e-10 and abs(two["mass_error"]) < 1e-10


@pytest.mark.parametrize("reached", [pytest.param(1, marks=pytest.mark.long), 2])
def test_shield_of_lists_goes_on(shield, tmp_path, reached):
    """three walls, of which one is a data file; probes and rims: before wall 2, or before wall 3"""
    from hvi import plates

    plates.write(tmp_path / "turned.data", plates.make(7e-3, 1.2e-3, 0.6e-3, 4, [0, 45]), 2703.0)
    vars = dict(quarter="no", dx=0.6, walls=3, thickness=[0.6, 1.2, 0.6], gap=[0, 4, 4], radius=[6, 7, 9], layers=[1, 4, 1],
                plate=["plain", tmp_path / "turned.data", "plain"], material=["Al2024-T3.hvi", "Al6061-T6.hvi", "Al2024-T3.hvi"],
                tstop=4, edge="absorb", rim=1.2, probes="yes", probe_at=[3, 5], behind=10, keep=0.3)
    shield("whole", vars=vars)
    whole = result(tmp_path / "whole")
    tables = bytes_of(tmp_path / "whole", "probe*.dat")
    assert len(tables) == 6
    dump = tmp_path / f"part{reached}" / f"cloud{reached}.dump"
    shield(dump.parent.name, vars=vars, kill=dump.exists)
    assert f'variable reached equal "{reached}"' in (dump.parent / "shield.state").read_text()
    shield(dump.parent.name, vars=dict(resume="yes"))
    assert result(dump.parent) == whole
    assert bytes_of(dump.parent, "probe*.dat") == tables and not list(dump.parent.glob("probes*"))
