"""fix hvi/balance: columns of equal cost, and the same answer as on one rank."""

import itertools

import numpy as np
import pytest
from dumps import read_dump
from scenes import books

OUT = "compute cost all hvi/atom cost\ncompute rank all property/atom proc\ndump d all custom 1 {} id type x y z vx vy vz fx fy fz c_cost c_rank\ndump_modify d sort id format float %.17g\n"


def impact(root, share, words=""):
    """a quarter of a sphere on a plate, 1 us, balanced every 10 steps"""
    text = (root / "examples/single-plate/in.plate").read_text()
    for old, new in (("processors   * * 1 ", "comm_style   tiled #" if "hvi" in share else "processors   * * 1 "), ("fix          share all balance 50 1.05 shift xy 20 1.02 weight var cost", f"fix share all {share}"),
                     ("variable tstop      index 16 ", "variable tstop      index 1 ")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    head, _, _ = text.partition("write_dump")
    return head + words


@pytest.fixture
def shot(lmp, root, tmp_path):
    def run(share, nranks, name):
        text = impact(root, share, f"unfix step\nundump frame\ncompute rank all property/atom proc\ndump d all custom 1 {name} id type x y z vx vy vz fx fy fz c_cost c_rank\n"
                      "dump_modify d sort id format float %.17g\nthermo_style custom step f_share f_share[*]\nrun 0\n")
        result = lmp(text, nranks=nranks, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
        return result, read_dump(tmp_path / name)

    return run


def loads(frame):
    return np.bincount(frame["c_rank"].astype(int), frame["c_cost"])


def placed(frame, name):
    """by places: IDs of create_atoms are given rank by rank"""
    return frame[name][np.lexsort([np.round(frame[a], 8) for a in "xyz"])]


def apart(frame, axes):
    """rectangles of ranks in these axes have nothing in common"""
    ranks = [frame["c_rank"] == r for r in np.unique(frame["c_rank"])]
    box = [[(frame[a][one].min(), frame[a][one].max()) for a in axes] for one in ranks]
    return all(any(p[k][1] < q[k][0] or q[k][1] < p[k][0] for k in range(len(axes))) for p, q in itertools.combinations(box, 2))


def test_columns_of_equal_cost(shot):
    """in an impact: a grid cannot share it as well; states are those of one rank"""
    one = shot("hvi/balance 10 1.02", 1, "one")[1]
    grid = shot("balance 10 1.02 shift xy 20 1.01 weight var cost", 6, "grid")[1]
    result, frame = shot("hvi/balance 10 1.02", 6, "ours")
    cost = loads(frame)
    print("columns", cost, "grid", loads(grid), result.thermo)
    assert len(cost) == 6 and 0.05 < (frame["c_cost"] < 1).mean() < 0.95 and apart(frame, "xy")
    assert cost.max() < 1.1 * cost.mean() < loads(grid).max() / 1.05
    assert result.thermo["f_share"][-1] <= result.thermo["f_share[1]"][-1] and result.thermo["f_share"][-1] < 1.1
    assert result.thermo["f_share[2]"][-1] == pytest.approx(cost.max(), rel=0.1)
    for name in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz"):
        assert np.abs(placed(frame, name) - placed(one, name)).max() < 1e-9 * np.abs(one[name]).max(), name


@pytest.mark.parametrize("axis, newton, nranks", [("x", "on", 4), ("y", "off", 3), pytest.param("z", "on", 4, marks=pytest.mark.long), ("z", "off", 4)])
def test_along_an_axis(lmp, root, tmp_path, axis, newton, nranks):
    """newton on and off; the books are those of one rank"""
    text = (root / "tests/inputs/in.solid").read_text().replace("boundary s s s", "boundary s s s\ncomm_style tiled").replace("run 30", f"fix share all hvi/balance 5 1.0 axis {axis}\n")
    text = text.replace("newton on", f"newton {newton}") + OUT.format("d") + "run 20\nrun 0\n"
    one, several = (lmp(text, nranks=n, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")}).runs[0] for n in (1, nranks))
    assert all(np.allclose(one[f"c_book[{k}]"], several[f"c_book[{k}]"], rtol=1e-9, atol=0) for k in (1, 9))
    frame = read_dump(tmp_path / "d")
    assert len(np.unique(frame["c_rank"])) == nranks
    assert apart(frame, "xyz".replace(axis, "")) and not apart(frame, axis)
    cost = loads(frame)
    assert cost.max() < 1.05 * cost.mean()


@pytest.mark.parametrize("first, second", [(1, 3), (2, 2), (3, 1), pytest.param(4, 2, marks=pytest.mark.long)])
def test_restart(lmp, root, tmp_path, first, second):
    """columns are made anew where a run goes on, on as many ranks or others: places, forces and energies are those of the run that was not interrupted"""
    env = {"LAMMPS_POTENTIALS": str(root / "potentials")}
    text = (root / "tests/inputs/in.solid").read_text().replace("boundary s s s", "boundary s s s\ncomm_style tiled").replace("run 30", "fix share all hvi/balance 5 1.0\n")
    fixes = text.partition("velocity left")[2].partition("\n")[2]
    whole = lmp(text + OUT.format("whole") + "restart 12 half\nrun 30\n", nranks=first, cwd=tmp_path, env=env)
    part = lmp("newton on\ncomm_style tiled\nread_restart half.12\npair_style hvi/sph cubic dissipation riemann\npair_coeff * * file Al6061-T6.hvi spacing 1e-3\n"
               + fixes + OUT.format("part") + "run 18\n", nranks=second, cwd=tmp_path, env=env)
    one, other = read_dump(tmp_path / "whole"), read_dump(tmp_path / "part")
    assert len(np.unique(other["c_rank"])) == second and loads(other).max() < 1.1 * loads(other).mean()
    assert np.array_equal(one["id"], other["id"])
    for name in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz"):
        assert np.abs(one[name] - other[name]).max() < 1e-10 * np.abs(one[name]).max(), name
    assert all(part.thermo[f"c_book[{k}]"][-1] == pytest.approx(whole.thermo[f"c_book[{k}]"][-1], rel=1e-10) for k in (1, 9))


@pytest.mark.parametrize("steps", [0, 10])
def test_each_run_looks_at_its_start(lmp, root, tmp_path, steps):
    """also at a step at which the last run has looked, when a command has taken particles away since"""
    text = (root / "tests/inputs/in.solid").read_text().replace("boundary s s s", "boundary s s s\ncomm_style tiled")
    text = text.replace("run 30", "fix share all hvi/balance 5 1.0\n") + f"thermo_style custom step f_share f_share[*]\nrun {steps}\n"
    text += "region half block INF $(bound(all,xmin)+0.4*(bound(all,xmax)-bound(all,xmin))) INF INF INF INF units box\ndelete_atoms region half\n"
    text += OUT.format("d") + "run 0\n"
    r = lmp(text, nranks=2, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    cost = loads(read_dump(tmp_path / "d"))
    assert len(cost) == 2 and cost.max() < 1.1 * cost.mean()
    assert not steps or r.thermo["f_share[2]"][-1] == pytest.approx(cost.max())


@pytest.mark.parametrize("newton, nranks", [("on", 1), pytest.param("on", 3, marks=pytest.mark.long), ("off", 2)])
def test_leavers(lmp, root, tmp_path, newton, nranks):
    """particles leave through faces of a box while columns are made anew, all of them in the end: none is lost without being counted"""
    text = (root / "tests/inputs/in.solid").read_text().replace("boundary s s s", "boundary f f f\ncomm_style tiled").replace("newton on", f"newton {newton}")
    text = text.replace("run 30", "velocity all set 20000 15000 0 units box\nfix share all hvi/balance 2 1.0\nthermo 1\nthermo_style custom step atoms c_book[*]\n"
                        "thermo_modify lost ignore norm no format float %.17g\nrun 400\n").replace("fix step all hvi/dt 0.5", "timestep 5e-9")
    result = lmp(text, nranks=nranks, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")}).thermo
    book, atoms = books(result), result["Atoms"]
    assert atoms[0] == 324 and len(set(atoms)) > 5 and atoms[-1] == 0 and np.array_equal(atoms + book["left_count"], np.full(len(atoms), 324))
    for name in ("mass", "px", "py"):
        assert np.abs(book[name] + book[f"left_{name}"] - book[name][0]).max() < 1e-12 * book[name][0], name
    assert np.abs(book["ratio"] - 1).max() < 1e-3
