"""fix hvi/balance: columns of equal cost, and the same answer as on one rank."""

import itertools

import numpy as np
import pytest
from dumps import read_dump

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


@pytest.mark.parametrize("axis, newton, nranks", [("x", "on", 4), ("y", "off", 3), ("z", "on", 4), ("z", "off", 4)])
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
