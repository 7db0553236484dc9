"""Lists of bonded elements made anew by relative motion: no pair in touch and no bond is missed, and flight costs few lists."""

import itertools

import numpy as np
import pytest
from dumps import read_dump, vectors
from scenes import BONDS, DUMP, PAIR, R_EQ, State, collision, cube, forces, read_bonds, scene

LAYOUTS = [(1, "brick"), (2, "brick"), (4, "brick"), (2, "tiled"), (4, "tiled")]
THERMO = "thermo 1\nthermo_style custom step atoms bonds nbuild ndanger\n"


def bodies(*parts, box, periodic=True):
    """parts: (n, corner, velocity): cubes of n^3 bonded particles"""
    cubes = [cube(n, 0.01, 0.1, seed=k + 1) for k, (n, _, _) in enumerate(parts)]
    first = np.cumsum([0] + [len(c.x) for c in cubes])
    x = np.vstack([c.x + np.array(p[1]) for c, p in zip(cubes, parts)])
    v = np.vstack([c.v + np.array(p[2]) for c, p in zip(cubes, parts)])
    bonds = np.vstack([c.bonds + k for c, k in zip(cubes, first)])
    return State(x, v, bonds, [[0.0, b] for b in box], periodic)


SCENES = {
    # blocks that break each other; dt is a hundredth of the time in which one flies by a particle
    "impact": (collision(5, 15.8), 0.0007, (60, 100, 250)),
    # past each other, just in touch, across the faces of a periodic box
    "passing": (bodies((5, (5, 4, 9), (8, 0, 0)), (5, (13, 4 + 5 * R_EQ - 0.05, 9), (-8, 0, 0)), box=(30, 24, 24)), 0.002, (150, 150, 700)),
    # through three faces into what rests beyond
    "faces": (bodies((5, (16, 13, 10), (6, 6, 6)), (6, (2.2, 0.5, 14), (0, 0, 0)), box=(26, 24, 22)), 0.002, (300, 300, 300)),
}


def text(name, tmp_path, comm="brick", lists="relative", neigh="", newton="on"):
    s, dt, _ = SCENES[name]
    pair = PAIR.replace("contact", f"contact lists {lists}", 1)
    return (scene(s, tmp_path / "s.data", pair=pair, comm=comm, newton=newton) + f"{neigh}fix nve all nve\n"
            + ("fix even all balance 50 1.0 rcb\n" if comm == "tiled" else "") + f"timestep {dt}\n{THERMO}")


def runs(name, folder=""):
    return "".join(f"run {n}\n{DUMP.format(f'{folder}f{k}')}{BONDS.format(f'{folder}b{k}')}" for k, n in enumerate(SCENES[name][2]))


def error(name, tmp_path, k):
    """forces at the end of run k against all pairs and bonds by brute force, in parts of the largest"""
    s = SCENES[name][0]
    dump = read_dump(tmp_path / f"f{k}")
    bonds = np.array(sorted(read_bonds(tmp_path / f"b{k}"))) - 1
    x = np.stack([dump[c] for c in "xyz"], axis=1)
    f = forces(State(x, 0.0, bonds, s.box, s.periodic))[0]
    return np.abs(vectors(dump, "f") - f).max() / np.abs(f).max()


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, comm", [pytest.param(*layout, marks=[pytest.mark.long] * (layout in ((4, "brick"), (2, "tiled")))) for layout in LAYOUTS])
@pytest.mark.parametrize("name", SCENES)
def test_forces_are_those_of_all_pairs(lmp, tmp_path, name, nranks, comm):
    """newton on and off, at the ends of three runs, with the list as old as it may be; flight takes less lists than with displacement; none is late"""
    cases = [(lists, newton) for lists in ("relative", "displacement") for newton in ("on", "off")]
    for lists, newton in cases:
        (tmp_path / lists / newton).mkdir(parents=True)
    found = lmp("clear\n".join(text(name, tmp_path, comm, lists, newton=newton) + runs(name, f"{lists}/{newton}/") for lists, newton in cases),
                nranks=nranks).runs
    found = {case: found[3 * k:3 * k + 3] for k, case in enumerate(cases)}
    for newton in ("on", "off"):
        relative, other = found["relative", newton], found["displacement", newton]
        for k in range(3):
            assert error(name, tmp_path / "relative" / newton, k) <= 1e-12, (newton, k)
        assert all(t["Ndanger"][-1] == 0 for t in relative), newton
        count = [sum(t["Nbuild"][-1] for t in one) for one in (relative, other)]
        assert count[0] < (1.2 if name == "impact" else 0.85) * count[1], (newton, count)


@pytest.mark.parametrize("name", SCENES)
def test_a_list_that_stays_gives_others(lmp, tmp_path, name):
    """so the test above can fail"""
    lmp(text(name, tmp_path, neigh="neigh_modify delay 100000 check no\n") + runs(name))
    assert max(error(name, tmp_path, k) for k in range(3)) > 1e-3


@pytest.mark.parametrize("name", SCENES)
def test_runs_without_setup_are_one_run(lmp, tmp_path, name):
    """pre no: lists in the same steps, and the last bit"""
    found = []
    for more in ("run 120\n", "run 33\nrun 80 pre no\nrun 7 pre no\n"):
        r = lmp(text(name, tmp_path) + more + DUMP.format("end"))
        found.append((r.thermo["Nbuild"][-1], (tmp_path / "end").read_bytes()))
    assert found[0] == found[1] and found[0][0] > 0


def test_a_velocity_that_is_no_number_stops_the_run(lmp, tmp_path):
    """in the first look at it"""
    r = lmp(text("impact", tmp_path) + "run 10\nvariable bad atom exp(1e4)-exp(1e4)\nset atom 7 vx v_bad\nrun 20\n", expect_fail=True)
    assert all(part in r.error for part in ("Particle 7 is at ", "nan", " at step 11: the simulation is unstable"))


def test_not_for_another_pair_style(lmp, tmp_path):
    """a run of hvi/contact with lists relative leaves nothing to one of another style: LAMMPS decides again"""
    count = {}
    for lists in ("relative", "displacement"):
        lines = f"""units lj
atom_style bond
atom_modify map array
boundary s s s
lattice sc 1.0
region box block 0 4 0 4 0 4
create_box 1 box bond/types 1 extra/bond/per/atom 1
create_atoms 1 box
mass 1 1
velocity all set 20 0 0
pair_style hvi/contact lists {lists}
pair_coeff 1 1 1 0.9
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
fix 1 all nve
{THERMO}run 60
pair_style lj/cut 1.5
pair_coeff 1 1 0.1 0.9
run 60
"""
        count[lists] = [t["Nbuild"][-1] for t in lmp(lines).runs]
    first, second = zip(*count.values())
    assert first[0] < 0.5 * first[1] and second[0] == second[1] >= 25, count


def test_two_in_a_hybrid(lmp):
    """lists are made anew by relative motion if both ask for it, whichever comes last"""
    count = {}
    for words in itertools.product(("relative", "displacement"), repeat=2):
        lines = f"""units lj
atom_style bond
atom_modify map array
boundary s s s
lattice sc 1.0
region box block 0 4 0 4 0 4
create_box 2 box bond/types 1 extra/bond/per/atom 1
create_atoms 1 box
set group all type/fraction 2 0.5 1234
mass * 1
velocity all set 20 0 0
pair_style hybrid hvi/contact lists {words[0]} hvi/contact lists {words[1]}
pair_coeff 1 * hvi/contact 1 1 0.9
pair_coeff 2 2 hvi/contact 2 1 0.9
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
fix 1 all nve
{THERMO}run 60
"""
        count[words] = lmp(lines).thermo["Nbuild"][-1]
    assert count.pop(("relative", "relative")) < 0.5 * min(count.values()) and len(set(count.values())) == 1, count


def test_flight_costs_few_lists(lmp, tmp_path):
    """a body in flight at once and slowly spinning apart, beside one that rests"""
    s = bodies((4, (2, 3, 2), (30, 0, 0)), (4, (2, 20, 2), (0, 0, 0)), box=(200, 40, 12), periodic=False)
    pair = PAIR.replace("contact", "contact lists {}", 1)
    count = {}
    for lists in ("relative", "displacement"):
        lines = scene(s, tmp_path / "s.data", pair=pair.format(lists)) + "fix nve all nve\ntimestep 0.005\n" + THERMO
        t = lmp(lines + "run 1000\n").thermo
        assert t["Atoms"][-1] == 128 and (lists == "displacement" or t["Ndanger"][-1] == 0)
        count[lists] = t["Nbuild"][-1]
    assert count["relative"] < 0.25 * count["displacement"], count


def test_keyword(lmp, tmp_path):
    """is displacement by default, kept by restart files; wrong words are refused; neigh_modify with other settings leaves LAMMPS in charge"""
    lines = text("faces", tmp_path, lists="displacement") + "run 50\n"
    n = lmp(lines + "write_restart r\n").thermo["Nbuild"][-1]
    again = "read_restart r\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix nve all nve\ntimestep 0.002\n" + THERMO + "run 50\n"
    assert lmp(again).thermo["Nbuild"][-1] == pytest.approx(n, abs=1)
    default = text("faces", tmp_path).replace(" lists relative", "") + "run 50\n"
    assert lmp(default).thermo["Nbuild"][-1] == n
    assert lmp(text("faces", tmp_path) + "run 50\n").thermo["Nbuild"][-1] < 0.7 * n
    late = "neigh_modify every 1 delay 1 check yes\n"
    assert lmp(text("faces", tmp_path, neigh=late) + "run 50\n").thermo["Nbuild"][-1] == pytest.approx(n, abs=1)
    for wrong, says in (("lists sometimes", "Pair_style hvi/contact lists must be relative or displacement, not sometimes"),
                        ("lists", "Illegal pair_style hvi/contact lists command: missing argument")):
        assert says in lmp(lines.replace("lists displacement", wrong), expect_fail=True).error
