"""The end of the time of a job: LAMMPS's timer timeout ends a run as its last step would, and what is written then is gone on from."""

import numpy as np
import pytest
from fem_scenes import STATE, read_state, start, strike_plate
from scenes import BONDS, DUMP, cube, read_bonds, read_dump, scene

TIMEOUT = "timer timeout 0:00:01 every 10\nrun 100000000\nwrite_restart half\nrun 5\nprint \"at $(step)\"\n"


def stopped(r):
    """the step at which it was, which depends on the machine: the whole run writes a file there, too"""
    step = int(r.thermo["Step"][-1])
    assert step > 0 and step % 10 == 0 and f"at {step}\n" in r.stdout and "Wall time limit reached" in r.stdout  # later runs are skipped
    return step


@pytest.mark.parametrize("nranks", [2, pytest.param(1, marks=pytest.mark.long)])
def test_elements(lmp, nranks):
    mesh, strike_it = strike_plate(nx=4, ny=4)
    text = start(mesh, every=10, fem="strain 0.1") + strike_it
    step = stopped(lmp(text + TIMEOUT, nranks=nranks))
    lmp(text + f"restart {step} whole\nrun {step + 9}\n" + STATE.format("whole.dump"), nranks=nranks)
    head, body = text[:text.index("fix prop")], text[text.index("pair_style"):text.index("group ball")]
    body = "\n".join(line for line in body.splitlines() if not line.startswith("read_data"))
    newton = next(line for line in head.splitlines() if line.startswith("newton"))
    lmp(f"{newton}\natom_modify sort 0 0\nread_restart half\nfix prop all property/atom rmass ghost yes\n{body}\nrun 9\n" + STATE.format("part.dump"), nranks=nranks)
    a, b = read_state("whole.dump"), read_state("part.dump")
    for name in a:
        assert np.abs(a[name] - b[name]).max() <= 1e-12 * np.abs(a[name]).max(), name  # elements have failed: sums are of another order


def test_bonds(lmp, tmp_path):
    """lists are made anew in every step: the restart file makes them so in its step, and fix hvi/dt sees a pair that approaches from there on"""
    text = scene(cube(5, jitter=0.1, speed=3.0, periodic=True), "s.data", sort=False) + "neigh_modify check no\n"
    fixes = "fix nve all nve\nfix step all hvi/dt 0.1\ncompute book all hvi/energy\nthermo 10\nthermo_style custom step c_book[9]\nthermo_modify lost ignore\n"
    step = stopped(lmp(text + fixes + TIMEOUT))
    whole = lmp(text + fixes + f"restart {step} whole\nrun {step + 9}\n" + DUMP.format("a") + BONDS.format("a.bonds")).thermo
    part = lmp("read_restart half\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check no\ncompute B all property/local batom1 batom2\n" + fixes + "run 9\n"
               + DUMP.format("b") + BONDS.format("b.bonds")).thermo
    a, b = read_dump(tmp_path / "a"), read_dump(tmp_path / "b")
    for name in a:  # the whole run brings particles back into the box before forces of that step, a run that is stopped after them
        assert np.abs(a[name] - b[name]).max() <= 1e-10 * np.abs(a[name]).max(), name
    assert read_bonds(tmp_path / "a.bonds") == read_bonds(tmp_path / "b.bonds")
    assert part["c_book[9]"][-1] == pytest.approx(whole["c_book[9]"][-1], rel=1e-12)
