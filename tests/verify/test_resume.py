"""Examples of impacts that are killed in flight go on, and end as if they had not been."""

import re
import shutil

import pytest
import yaml

PLATE = dict(quarter="yes", dx=1.25, frame=[2, 5], tstop=7)
CLOCK = "wall_s", "core_s", "particle_steps_per_s"


@pytest.fixture
def plate(lmp, root, tmp_path):
    def run(folder, **kw):
        vars = {"out": tmp_path / folder, **kw.pop("vars", {})}
        return lmp(root / "examples" / "single-plate" / "in.plate", cwd=tmp_path / folder, vars=vars,
                   env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)

    return run


def result(folder):
    r = yaml.safe_load((folder / "result.yaml").read_text())
    return {key: value for key, value in r.items() if key not in CLOCK}


def steps_of(state):
    """the step that a state is of, -1 if there is none yet"""
    found = re.search(r"variable at equal \"(\d+)\"", state.read_text()) if state.exists() else None
    return int(found.group(1)) if found else -1


def stopped(run, state, after, **kw):
    """a run that is killed when its state is of a later step"""
    r = run(kill=lambda: steps_of(state) > after, **kw)
    assert "resume yes" in r.stdout or "resume yes" in r.log  # how to go on
    return steps_of(state)


@pytest.mark.parametrize("nranks", [1, 2])
def test_plate_has_the_same_bits(plate, tmp_path, nranks):
    """on the same ranks; all that is told again is where it is"""
    plate("whole", nranks=nranks, vars=PLATE)
    at = stopped(lambda **kw: plate("part", **kw), tmp_path / "part" / "plate.state", 40, nranks=nranks, vars=PLATE)
    assert 40 < at < result(tmp_path / "whole")["steps"]
    plate("part", nranks=nranks, vars=dict(resume="yes"))
    assert result(tmp_path / "part") == result(tmp_path / "whole")
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
