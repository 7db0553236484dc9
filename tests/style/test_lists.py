"""Lists of neighbors made anew by relative motion: forces are those of a fresh list, and flight costs none."""

import numpy as np
import pytest
from dumps import named, read_dump
from solid_scenes import MATERIAL
from sph_scenes import Fluid, scene

REACH, SKIN = 2.5, 0.3  # cubic, h 1.25
WATER = "pair_style hvi/sph cubic\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"
METAL = "pair_style hvi/sph cubic\npair_coeff * * file {} h 1.25\n"
LAYOUTS = [(1, "brick"), (2, "brick"), (4, "brick"), (2, "tiled"), (4, "tiled")]
WRITE = "write_dump all custom {} id type x y z fx fy fz c_R[*] modify format float %.17g sort id\n"
THERMO = "thermo 1\nthermo_style custom step atoms nbuild ndanger\n"


def bodies(*blocks, box, periodic=True, speed=0.02, seed=1):
    """blocks: (counts, corner, velocity), of spacing 1; with a speed jittered, at random density and velocity; c is 4"""
    rng = np.random.default_rng(seed)
    x, v = [], []
    for counts, corner, velocity in blocks:
        x.append(np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), -1).reshape(-1, 3) + 0.5 + np.array(corner))
        v.append(np.zeros_like(x[-1]) + velocity)
    kind = np.repeat(np.arange(len(blocks)) + 1, [len(a) for a in x])
    x, v = np.vstack(x), np.vstack(v)
    rho = np.ones(len(x))
    if speed:
        x += rng.uniform(-0.05, 0.05, x.shape)
        v += rng.normal(0, speed, x.shape)
        rho = rng.uniform(0.98, 1.03, len(x))
    types = range(1, len(blocks) + 1)
    return Fluid(x, v, rho, np.zeros(len(x)), kind, dict.fromkeys(types, 1.0), dict.fromkeys(types, 1.25),
                 np.array(box, float), (periodic,) * 3)


N = (6, 6, 6)
SCENES = {
    # two blocks strike each other at the speed of sound; as solids
    "impact": (bodies((N, (12, 5.5, 9), (0, 2, 0)), (N, (12, 11.8, 9), (0, -2, 0)), box=(30, 24, 24)), 0.01, (30, 25, 45)),
    # they pass at four times that, 20 km/s in metals, where kernels reach over the gap, and once more around the box
    "passing": (bodies((N, (8, 5, 9), (8, 0, 0)), (N, (17, 11.8, 9), (-8, 0, 0)), box=(30, 24, 24)), 0.01, (30, 25, 120)),
    # one flies through three faces and strikes what rests beyond
    "faces": (bodies((N, (16, 13, 10), (3, 3, 3)), ((8, 8, 8), (2.2, 0.5, -2), (0, 0, 0)), box=(26, 24, 22)), 0.02, (40, 30, 60)),
}


def text(name, tmp_path, comm="brick", lists="relative", neigh="", solid=None):
    s, dt, _ = SCENES[name]
    pair = WATER
    if name == "impact":
        (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
        pair = METAL.format(tmp_path / "m.hvi")
    out = scene(s, tmp_path / "s.data", pair, comm=comm, skin=SKIN, fix=f"fix sph all hvi/sph sleep no lists {lists}\n")
    if comm == "tiled":
        out += "balance 1.0 rcb\nfix even all balance 10 1.0 rcb\n"
    out += "fix jc all hvi/johnson-cook\n" if name == "impact" else ""
    return out + f"{neigh}timestep {dt}\n{THERMO}compute R all property/atom drho desph\n"


def error(tmp_path, k):
    """forces, drho, desph at the end of run k, against those of a list made there; in parts of the largest"""
    late, fresh = (named(read_dump(tmp_path / f"{name}{k}"), R="drho de") for name in ("late", "fresh"))
    assert (late["id"] == fresh["id"]).all()
    return max(np.abs(late[name] - fresh[name]).max() / np.abs(fresh[name]).max() for name in ("f", "drho", "de"))


def runs(name):
    return "".join(f"run {n}\n{WRITE.format(f'late{k}')}run 0\n{WRITE.format(f'fresh{k}')}" for k, n in enumerate(SCENES[name][2]))


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, comm", LAYOUTS)
@pytest.mark.parametrize("name", SCENES)
def test_forces_are_those_of_a_fresh_list(lmp, tmp_path, name, nranks, comm):
    """at the ends of three runs, with the list as old as it may be"""
    r = lmp(text(name, tmp_path, comm) + runs(name), nranks=nranks)
    for k in range(3):
        assert error(tmp_path, k) <= 1e-12, k
    # a run and a run 0: fewer lists than steps, and none that LAMMPS calls dangerous
    assert all(0 <= t["Nbuild"][-1] < 0.7 * len(t["Nbuild"]) and t["Ndanger"][-1] == 0 for t in r.runs[::2])


@pytest.mark.parametrize("name", SCENES)
def test_a_list_that_stays_gives_others(lmp, tmp_path, name):
    """so the test above can fail"""
    lmp(text(name, tmp_path, neigh="neigh_modify delay 100000 check no\n") + runs(name))
    assert max(error(tmp_path, k) for k in range(3)) > 1e-3


@pytest.mark.parametrize("nranks", [1, 2])
def test_of_passing_bodies_the_way_is_the_same(lmp, tmp_path, nranks):
    """positions after 175 steps with relative, displacement and a list in every step: but for round-off"""
    ends = []
    for lists, neigh in (("relative", ""), ("displacement", ""), ("relative", "neigh_modify delay 0 every 1 check no\n")):
        t = lmp(text("passing", tmp_path, lists=lists, neigh=neigh) + "run 175\n" + WRITE.format("end"), nranks=nranks).thermo
        ends.append((read_dump(tmp_path / "end").table, t["Nbuild"][-1]))
    assert ends[0][1] <= ends[1][1] < ends[2][1] == 175
    box = SCENES["passing"][0].box
    for case, (end, _) in enumerate(ends[:2]):
        d = end[:, 2:5] - ends[2][0][:, 2:5]
        assert np.abs(d - box * np.round(d / box)).max() < 1e-9, case


@pytest.mark.parametrize("nranks, faces", [(1, "s"), pytest.param(1, "f", marks=pytest.mark.long), (2, "f")])
def test_flight_costs_few_lists(lmp, tmp_path, nranks, faces):
    """a body in flight; two that fly toward each other, far apart; debris that flies apart"""
    flies = bodies((N, (2, 3, 2), (3, 0.5, 0.1)), box=(60, 16, 12), periodic=False, speed=0)
    meet = bodies(((4, 4, 4), (1, 4, 4), (2, 0, 0)), ((4, 4, 4), (75, 4, 4), (-2, 0, 0)), box=(80, 12, 12), periodic=False, speed=0)
    debris = bodies(((5, 5, 5), (0, 0, 0), (0, 0, 0)), box=(200, 200, 200), periodic=False)
    debris.x = (debris.x - 2.5) * 8.0 + 100.0
    debris.v = 0.1 * (debris.x - 100.0)
    for s, way, most in ((flies, 27.0, 3), (meet, 18.0, 2), (debris, 15.0, 16)):
        count = {}
        for lists in ("relative", "displacement"):
            lines = scene(s, tmp_path / "s.data", WATER, fix=f"fix sph all hvi/sph lists {lists}\n", skin=SKIN)
            lines = lines.replace("boundary f f f", f"boundary {faces} {faces} {faces}") + "timestep 0.05\nthermo_modify lost error\n"
            count[lists] = lmp(lines + THERMO + "run 180\n", nranks=nranks).thermo["Nbuild"][-1]
        far = 2 * way / (REACH + SKIN) if nranks > 1 else 0  # a list each time two that no rank has both of have come by what ghosts reach
        assert count["relative"] <= max(most, far) and count["displacement"] >= 90, count


@pytest.mark.parametrize("faces", ["f", "s"])
def test_flight_along_faces_of_ranks(lmp, tmp_path, faces):
    """what flies past a body at rest in a direction in which no rank ends needs no lists; where ranks end it does"""
    s = bodies(((4, 4, 4), (4, 4, 4), (0, 0, 0)), ((4, 4, 4), (16, 4, 2), (0, 0, 4)), box=(24, 12, 60), periodic=False, speed=0)
    for processors, least, most in (("2 1 1", 0, 2), ("1 1 2", 180 * 0.05 * 4 / (REACH + SKIN) - 1, 90)):
        lines = scene(s, tmp_path / "s.data", WATER, fix="fix sph all hvi/sph\n", skin=SKIN).replace("boundary f f f", f"boundary {faces} {faces} {faces}")
        lines = lines.replace("read_data", f"processors {processors}\nread_data", 1) + "timestep 0.05\n" + THERMO
        t = lmp(lines + "run 180\n", nranks=2).thermo
        assert t["Atoms"][-1] == 128 and least <= t["Nbuild"][-1] <= most, (processors, t["Nbuild"][-1])


def test_what_is_beyond_the_reach_of_exchange(lmp, tmp_path):
    """one body in periodic flight on 4 ranks: a list each time it has come half a domain, and no particle lost"""
    s = bodies((N, (3, 3, 3), (3, 2, 1)), box=(24, 24, 12))
    t = lmp(scene(s, tmp_path / "s.data", WATER, skin=SKIN, fix="fix sph all hvi/sph\n") + "timestep 0.05\n" + THERMO + "run 200\n",
            nranks=4).thermo
    width = 12.0  # of the narrowest domain
    assert 200 * 0.05 * 3 / (0.5 * width) - 1 <= t["Nbuild"][-1] <= 12
    assert (t["Atoms"] == 216).all()


@pytest.mark.parametrize("nranks", [1, 2])
def test_lists_of_computes_reach_as_far_as_ghosts(lmp, tmp_path, nranks):
    """fragments over a distance beyond the reach of kernels: two bodies that come near each other are one from then on"""
    s = bodies(((2, 2, 2), (10.4, 4, 4), (1, 0, 0)), ((2, 2, 2), (25.0, 4, 4), (-1, 0, 0)), box=(60, 30, 30), speed=0)
    lines = scene(s, tmp_path / "s.data", WATER, skin=SKIN, fix="fix sph all hvi/sph\n") + "timestep 0.05\ncomm_modify cutoff 6.7\n"
    lines += "compute f all hvi/fragment distance 6.0\nthermo 5\nthermo_style custom step c_f[1] nbuild\nrun 100\n"
    t = lmp(lines, nranks=nranks).thermo
    gap = 25.5 - 11.9 - 2 * 0.05 * t["Step"]
    assert (t["c_f[1]"][gap > 6.0] == 2).all() and (t["c_f[1]"][gap < 6.0] == 1).all() and (gap < 6.0).sum() == 5


def builds(lmp, tmp_path, lists, neigh, more="run 40\n", name="faces", nranks=1):
    r = lmp(text(name, tmp_path, lists=lists, neigh=neigh) + more, nranks=nranks)
    return [t["Nbuild"][-1] for t in r.runs]


# a block comes by more than half of the skin in two steps
@pytest.mark.parametrize("neigh, lists", [("delay 5", 8), ("every 2", 20), ("check no", 40), ("delay 4 every 2 check no", 10), ("once yes", 0)])
def test_other_settings_leave_lammps_in_charge(lmp, tmp_path, neigh, lists):
    """of neigh_modify: what it says, as with lists displacement; also after a run with the defaults, and before another"""
    neigh = f"neigh_modify {neigh}\n"
    assert builds(lmp, tmp_path, "displacement", neigh) == [lists]
    assert builds(lmp, tmp_path, "relative", neigh) == [lists]
    if lists > 7:
        back = "neigh_modify delay 0 every 1 check yes\n"
        three = builds(lmp, tmp_path, "relative", back, f"run 40\n{neigh}run 40\n{back}run 40\n")
        assert three[0] < 0.5 * 20 and three[1] == lists


def test_defaults_do_not(lmp, tmp_path):
    one, other = (builds(lmp, tmp_path, lists, "")[0] for lists in ("relative", "displacement"))
    assert one < 0.5 * other


def test_runs_in_turn(lmp, tmp_path):
    """the fix given again with the other word"""
    more = "run 20\nunfix sph\nfix sph all hvi/sph sleep no lists displacement\nrun 20\nunfix sph\nfix sph all hvi/sph sleep no lists relative\nrun 20\n"
    n = builds(lmp, tmp_path, "relative", "", more)
    assert n[2] < 0.7 * n[1] and n[0] < 0.7 * n[1], n


@pytest.mark.parametrize("name", ["faces", "impact"])
def test_runs_without_setup_are_one_run(lmp, tmp_path, name):
    """pre no and every: lists in the same steps, and the last bit; forces are those of a fresh list; neigh_modify in between holds"""
    begin, end = text(name, tmp_path), WRITE.format("end")
    found = []
    for more in ("run 40\n", "run 13\nrun 20 pre no\nrun 7 pre no\n", "run 0\nrun 40 pre no every 8 NULL\n", "run 20 post no\nrun 20 pre no\n"):
        found.append((lmp(begin + more + end).thermo["Nbuild"][-1], (tmp_path / "end").read_bytes()))
    assert found[0][0] > 2 and found[1:] == found[:1] * 3
    lmp(begin + "run 20\nrun 20 pre no\n" + WRITE.format("late0") + "run 0\n" + WRITE.format("fresh0"))
    assert error(tmp_path, 0) <= 1e-12
    each = lmp(begin + "run 10\nneigh_modify check no\nrun 10 pre no\nneigh_modify check yes\nrun 10 pre no\n")
    count = [t["Nbuild"][-1] for t in each.runs]
    assert count[1] == count[0] + 10 and count[2] < count[1] + 10


@pytest.mark.parametrize("nranks", [1, 2])
def test_fixed_faces_lose_particles(lmp, tmp_path, nranks):
    """those beyond a face by no more than the reach may still be there; all of them are in the books"""
    s = bodies((N, (8, 3, 3), (3, 0, 0)), box=(20, 12, 12), periodic=False)
    lines = scene(s, tmp_path / "s.data", WATER, skin=SKIN, fix="fix sph all hvi/sph\n") + "timestep 0.02\n"
    books = "compute book all hvi/energy\nthermo 1\nthermo_style custom step atoms c_book[8] c_book[9]\nthermo_modify lost ignore norm no format float %.12g\n"
    t = lmp(lines + books + "run 300\n", nranks=nranks).thermo
    front, back = 14.0 + 3 * 0.02 * t["Step"], 8.0 + 3 * 0.02 * t["Step"]  # it spreads a little
    assert (t["Atoms"][front < 19.5] == 216).all() and front[0] < 19.5
    assert (t["Atoms"][back > 20 + REACH + 0.5] == 0).all() and back[-1] > 20 + REACH + 0.5
    assert (t["Atoms"][(front > 21 + REACH)] < 216).all()
    assert np.abs(t["c_book[9]"] - 1).max() < 1e-3
    r = lmp(lines + "thermo 10\nrun 250\n", nranks=nranks, expect_fail=True)
    assert "Lost atoms" in r.error


def test_wrong_input(lmp, tmp_path):
    lines = text("faces", tmp_path)
    for wrong, says in (("lists sometimes", "Fix hvi/sph lists must be relative or displacement, not sometimes"),
                        ("lists", "Illegal fix hvi/sph lists command: missing argument"), ("list relative", "Unknown fix hvi/sph keyword: list")):
        assert says in lmp(lines.replace("lists relative", wrong), expect_fail=True).error
    for late in ("", "run 0\n"):
        r = lmp(lines + late + "fix mine all hvi/lists\n", expect_fail=True)
        assert "Fix hvi/lists is made by pair styles and cannot be given in an input" in r.error, late
    assert "cannot be given in an input" in lmp(lines + "run 0\nfix HVI_LISTS all hvi/lists\n", expect_fail=True).error


MEET = """units si
atom_style sph
boundary {faces}
{processors}
region box block {box}
create_box 1 box
lattice sc 1.0 origin 0.5 0.5 0.5
region a block {a} 6 10 6 10
region b block {b} 6 10 6 10
create_atoms 1 region a
create_atoms 1 region b
{corners}
mass 1 1.0
set group all sph/rho 1.0
region flies block {a} 0 16 0 16
group fly region flies
velocity fly set {speed} 0 0
neighbor 0.3 bin
pair_style hvi/sph cubic
pair_coeff * * eos tait 1.0 4.0 7 h 1.25
fix sph all hvi/sph lists {lists}
timestep 0.02
thermo 25
thermo_style custom step nbuild f_sph ke
thermo_modify norm no
run {steps}
"""


@pytest.mark.each_value
@pytest.mark.parametrize("scene", ["cut", "face"])
@pytest.mark.parametrize("nranks", [1, 2, 4])
def test_meeting_deep_inside_ranks(lmp, scene, nranks):
    """two bodies that no rank has both of, or that meet across a periodic face, farther from it than ghosts reach: as with displacement, with less lists"""
    if scene == "cut":
        corners = "create_atoms 1 single -58.5 6.5 6.5 units box\ncreate_atoms 1 single 58.5 6.5 6.5 units box"
        how = dict(faces="s s s", processors="processors * 1 1", box="-60 60 0 16 0 16", a="-12 -6", b="6 10", corners=corners, speed=2, steps=450)
    else:
        how = dict(faces="p s s", processors="processors * 1 1", box="0 60 0 16 0 16", a="6 10", b="48 52", corners="", speed=-2, steps=450)
    ends, counts = [], []
    for lists in ("displacement", "relative"):
        t = lmp(MEET.format(lists=lists, **how), nranks=nranks).thermo
        ends.append(t["KinEng"][-1])
        counts.append(t["Nbuild"][-1])
        assert t["KinEng"][0] == 128 if scene == "face" else True, lists
    assert ends[0] < 0.9 * t["KinEng"][0]  # they have met
    assert ends[1] == pytest.approx(ends[0], rel=1e-9) and counts[1] < counts[0]


def test_same_place_asleep(lmp):
    """two particles at one place stop the run at its start, also where all is at rest"""
    text = MEET.format(faces="s s s", processors="", box="0 60 0 16 0 16", a="6 10", b="20 24", corners="create_atoms 1 single 7.5 7.5 7.5 units box", speed=0, lists="relative", steps=0)
    assert "at the same place at step 0" in lmp(text, expect_fail=True).stdout
