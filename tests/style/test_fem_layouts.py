"""Elements on any number of ranks, through migration, conversion, mirror planes and periodic faces: the same numbers, and nothing lost."""

import numpy as np
import pytest
from dumps import read_dump
from hvi.model.mesh import block
from scipy.spatial import cKDTree
from sph_report import tables
from fem_scenes import DX, EDGE, J, MASS, OPEN, P, STATE, TOTAL, VOIDS, laws, plate, read_state, start, strike, strike_plate

FAILS = "strain 0.1"  # the first elements become particles at step 27
ROUND = "fix even all balance 3 1.0 {}\n"
LAYOUTS = {
    "2": dict(nranks=2),
    "4": dict(nranks=4),
    "1 newton off": dict(newton="off"),
    "3 newton off": dict(nranks=3, newton="off"),
    "1 sorted": dict(sort="sort 3 0"),
    "2 brick balanced": dict(nranks=2, balance="shift xyz 10 1.0"),
    "4 tiled": dict(nranks=4, comm="tiled", balance="rcb"),
    "3 tiled newton off sorted": dict(nranks=3, comm="tiled", balance="rcb", newton="off", sort="sort 3 0"),
}


def difference(a, b):
    """largest of all quantities, each in units of its largest value; by ID"""
    assert np.array_equal(a["id"], b["id"]) and np.array_equal(a["type"], b["type"])
    return max(np.abs(a[k] - b[k]).max() / (np.abs(a[k]).max() or 1.0) for k in a)


def column(table, first, n=1):
    return np.column_stack([table[f"c_book[{k}]"] for k in range(first, first + n)])


def run_struck(lmp, nranks=1, balance="", steps=40, between="", **more):
    mesh, strike_it = strike_plate()
    text = start(mesh, fem=FAILS, **more) + (ROUND.format(balance) if balance else "") + strike_it
    r = lmp(text + f"run {steps}\n" + between + STATE.format("state.dump"), nranks=nranks)
    return r.runs, read_state("state.dump")


def test_a_wall_of_elements_alone(lmp):
    """pairs of embedded particles are left out, and nothing warns of it"""
    r = lmp(start(plate(core=0)) + "run 0\n")
    assert "Pair style hvi/sph cubic" in r.log and "neighbors in the mean" not in r.log


@pytest.mark.parametrize("nranks, newton", [(1, "off"), (2, "on"), (3, "on"), (3, "off")])
def test_neighbors_of_the_table_are_of_free_particles(lmp, nranks, newton):
    """by hand: those of type 2 that no element holds, with all within reach that are not in elements together"""
    lmp(start(plate()) + "run 0\nwrite_dump wall_embedded custom held id\nwrite_dump all custom all id type x y z modify sort id\n")
    all_ = read_dump("all")
    x = np.column_stack([all_[a] for a in "xyz"])[all_["type"] == 2]
    free = ~np.isin(all_["id"][all_["type"] == 2], read_dump("held")["id"])
    pairs = cKDTree(x).query_pairs(2 * 1.2 * DX)
    assert 0 < free.sum() < len(free)
    want = sum(int(free[i]) + int(free[j]) for i, j in pairs) / free.sum()
    r = lmp(start(plate(), newton=newton) + "run 0\n", nranks=nranks)
    assert tables(r.log)[0]["rows"][2]["neighbors"] == pytest.approx(want, rel=6e-4)


KICK = "velocity all set NULL NULL 100 sum yes units box\n"
ONE = {}  # on one rank


@pytest.fixture
def one(lmp):
    if not ONE:
        ONE["table"], ONE["anew"] = run_struck(lmp, between=STATE.format("first.dump") + "write_restart middle\n" + KICK + "run 0\n")
        ONE["state"], ONE["restart"] = read_state("first.dump"), open("middle", "rb").read()
        assert ONE["table"][0]["f_wall"][0] == 64 and 10 < ONE["table"][0]["f_wall"][-1] < 50
    return ONE


@pytest.mark.parametrize("layout", LAYOUTS)
def test_same_on_every_layout(lmp, one, layout):
    """40 steps of an impact in which a third of the elements become particles, on their way between ranks: positions, velocities, forces,
    states and all that is booked"""
    runs, got = run_struck(lmp, **LAYOUTS[layout])
    assert difference(one["state"], got) < 1e-11
    for name, values in one["table"][0].items():
        assert np.abs(values - runs[0][name]).max() <= 1e-11 * np.abs(values).max() + 1e-15, name


@pytest.mark.parametrize("layout", [pytest.param(name, marks=[pytest.mark.long] * (k % 2 == 0)) for k, name in enumerate(LAYOUTS)])
def test_forces_on_one_state(lmp, one, tmp_path, layout):
    """of a restart file with elements and what others have become, forces made anew"""
    how = LAYOUTS[layout]
    (tmp_path / "middle").write_bytes(one["restart"])
    lmp(again(**how) + KICK + "run 0\n" + STATE.format("anew.dump"), nranks=how.get("nranks", 1))
    got = read_state("anew.dump")
    assert np.abs(got["F"] - one["anew"]["F"]).max() <= 1e-12 * np.abs(got["F"]).max()
    assert difference(one["anew"], got) < 1e-11


def again(newton="on", comm="brick", sort="sort 0 0", **_):
    mesh, _ = strike_plate()
    text = start(mesh, fem=FAILS, newton=newton, comm=comm, sort=sort)
    first, rest = text.index("fix prop"), text.index("pair_style")
    head = "\n".join(line for line in text[:first].split("\n") if line.split(" ")[0] in ("newton", "processors")) + "\nread_restart middle\n"
    head += f"comm_style {comm}\natom_modify {sort}\nfix prop all property/atom rmass ghost yes\n"
    return head + "\n".join(line for line in text[rest:].split("\n") if not line.startswith("read_data"))


@pytest.mark.parametrize("order", ["before", "after"])
def test_nodes_go_when_ranks_change(lmp, order):
    """Elements fail in the step in which fix balance hands half of the other rank to theirs: the map of particles by ID knows nothing of what was there.
    Rank 1 has one column of elements of six, all of which fail, and gets a half across, with an element that reaches beyond its ghosts"""
    mesh = block(6, 8, 1, map=lambda x: (x - [3, 4, 1]) * [-EDGE, -EDGE, EDGE], n=4, type=2, node_type=3)
    center = mesh.corners.mean(axis=1)
    last = np.argsort(np.abs(center[:, :2] - [1.5 * EDGE, -0.5 * EDGE]).sum(axis=1) < 0.1 * EDGE, kind="stable")
    mesh.elements, mesh.type, mesh.n = mesh.elements[last], mesh.type[last], mesh.n[last]
    box = f"{-5.1 * EDGE} {9.1 * EDGE} {-8 * EDGE} {8 * EDGE} {-6 * EDGE} {6 * EDGE}"  # the ranks meet at x = 2 EDGE
    text = start(mesh, box=box, boundary="f f f", comm="tiled", fem="strain 0.02").replace(f"h {1.2 * DX}", f"h {0.3 * EDGE}").replace("processors * * *", "processors * 1 1")
    balance = f"variable w atom 1+4*(x>{2 * EDGE})*(step<2)\nfix even all balance 2 1.3 rcb weight var w\n"
    text = text.replace("fix wall all", balance + "fix wall all") if order == "before" else text.replace("neighbor", balance + "neighbor")
    text += f"group nodes type 3\nregion tip block {2.1 * EDGE} INF INF INF INF INF units box\ngroup tip region tip\ngroup tip intersect nodes tip\n"
    text += "variable vz atom 3e6*z\nvelocity tip set NULL NULL v_vz\nrun 4\n"
    one, two = (lmp(text + STATE.format(f"{n}.dump"), nranks=n).thermo for n in (1, 2))
    assert list(one["f_wall"]) == list(two["f_wall"]) == [48, 40]
    assert difference(read_state("1.dump"), read_state("2.dump")) < 1e-11


def test_nothing_is_lost(lmp):
    """through conversion: momentum to round-off, mass too, energy to (omega dt)^2; with an error linear in dt it is 2e-4"""
    mesh, strike_it = strike_plate()
    table = lmp(start(mesh, fem=FAILS, courant=0.1, every=40) + strike_it + "run 160\n").thermo
    assert table["f_wall"][-1] < 50 and table["f_wall[7]"][-1] > 0.1
    assert np.abs(column(table, TOTAL) / table["c_book[8]"][0] - 1).max() < 5e-5
    assert abs(table["c_book[9]"][-1] - 1) < 1.5e-5
    momentum, mass = column(table, P, 3), column(table, MASS)
    assert np.abs(momentum - momentum[0]).max() <= 1e-12 * np.abs(momentum[0]).max()
    assert np.abs(mass / mass[0] - 1).max() < 1e-14


def test_clamps(lmp):
    """half of the plate, with elements that become particles, is held at the speed it has: its work and impulse are booked"""
    mesh, strike_it = strike_plate()
    text = start(mesh, fem=FAILS, courant=0.1, every=40, clamps="clamps held")
    groups = "region side block 0.1e-3 INF INF INF INF INF units box\ngroup side region side\ngroup balls type 1\ngroup held subtract side balls\n"
    text = text.replace("compute book", groups + "compute book")
    text += "fix hold held setforce 0 0 0\n" + strike_it + "velocity all set 30 100 0 sum yes units box\n"
    table = lmp(text + "run 160\n").thermo
    assert table["f_wall"][-1] < 55
    assert np.abs(column(table, TOTAL) / table["c_book[8]"][0] - 1).max() < 1e-4
    moved = column(table, P, 3) - column(table, J, 3)
    impulse = np.abs(column(table, J, 3)).max()
    assert impulse > 0.01 * np.abs(moved).max()
    assert np.abs(moved - moved[0]).max() <= 1e-12 * np.abs(moved[0]).max()


def test_two_runs_are_one(lmp):
    """a list is built between them, in another order of pairs"""
    whole = run_struck(lmp, steps=40)[1]
    parts = run_struck(lmp, steps=20, between="run 20\n")[1]
    assert difference(whole, parts) < 1e-10


def test_moved_between_runs(lmp):
    """all moved: forces as before; nodes moved: their particles go along; nodes apart: pressure by their volume"""
    between = STATE.format("before.dump") + "group nodes type 3\n{}\nrun 0\n"
    got = {}
    for name, what in (("all", "displace_atoms all move 1e-5 2e-5 0 units box"), ("nodes", "displace_atoms nodes move 0 0 -2e-3 units box"),
                       ("particles", "group held type 2\nvelocity held set 1000 0 0 units box")):
        got[name] = run_struck(lmp, steps=20, between=between.format(what))[1]
    before = read_state("before.dump")
    a = got["all"]
    assert np.abs(a["X"] - before["X"] - [1e-5, 2e-5, 0]).max() < 1e-15
    assert np.abs(a["F"] - before["F"]).max() < 1e-6 * np.abs(before["F"]).max()
    b = got["nodes"]
    inside = (b["type"] == 2) & (np.hypot(b["x"], b["y"]) > 1.6 * EDGE)
    assert np.abs(b["X"] - before["X"] - [0, 0, -2e-3])[inside].max() < 1e-15
    assert np.abs(got["particles"]["V"] - before["V"])[inside].max() < 1e-9


def test_stretched_between_runs(lmp):
    """a block of elements that a command stretches: density by volume"""
    mesh = plate(core=0)
    lmp(start(mesh) + "run 0\ndisplace_atoms all ramp x 0 1e-6 x -3e-3 3e-3 units box\nrun 0\n" + STATE.format("d"))
    got = read_state("d")
    inside = got["type"] == 2
    assert got["c_rho[1]"][inside] == pytest.approx(2703 / (1 + 1e-6 / 6e-3), rel=1e-9)
    assert (got["c_state[1]"][inside] < 0).all()


@pytest.mark.parametrize("spall", ["none", "voids"])
def test_quarter(lmp, tmp_path, spall):
    """the quarter behind two mirror planes is the quarter of the whole, with open voids too"""
    law, pull = laws(spall, tmp_path)
    whole, strike_it = strike_plate()
    runs = lmp(start(whole, fem=FAILS, **law) + strike_it + pull + "run 0\n" + STATE.format("start") + "run 40\n" + STATE.format("whole")).runs
    begin, a = read_state("start"), read_state("whole")
    quarter = plate(nx=3, ny=3, whole=False)
    quarter.mirror = "x 0 lo y 0 lo"
    strike_it = strike(quarter)
    text = start(quarter, fem=FAILS, pair="cubic dissipation riemann mirror x 0 lo mirror y 0 lo", **law)
    part = lmp(text + strike_it + pull + "run 0\n" + STATE.format("start") + "run 40\n" + STATE.format("quarter") + OPEN, nranks=2).runs
    if law:
        assert (read_state("open")[VOIDS] > 1e-4).sum() >= 16
    begin_b, b = read_state("start"), read_state("quarter")
    assert part[1]["f_wall"][-1] * 4 == runs[1]["f_wall"][-1] < 50
    for name in ("c_book[1]", "c_book[2]", "c_book[8]", f"c_book[{P + 2}]", f"c_book[{MASS}]", "f_wall[7]"):
        assert part[1][name] * 4 == pytest.approx(runs[1][name], rel=1e-9), name

    # who is who

    key = {(t, *np.round(x / (0.1 * DX)).astype(int)): k for k, (t, x) in enumerate(zip(begin["type"], begin["X"]))}
    first = {i: k for k, i in enumerate(begin_b["id"])}
    last = {i: k for k, i in enumerate(a["id"])}
    for k, i in enumerate(b["id"]):
        j = first[i]
        other = last[begin["id"][key[(begin_b["type"][j], *np.round(begin_b["X"][j] / (0.1 * DX)).astype(int))]]]
        assert np.abs(b["X"][k] - a["X"][other]).max() < 1e-9 * EDGE
        assert np.abs(b["V"][k] - a["V"][other]).max() < 1e-6
        assert abs(b[VOIDS][k] - a[VOIDS][other]) < 1e-10


@pytest.mark.parametrize("nranks", [1, 3])
def test_across_periodic_faces(lmp, nranks):
    """where the faces of the box are does not matter"""
    states = []
    for k, shift in enumerate(([0, 0, 0], [1.3 * EDGE, -0.6 * EDGE, 0])):
        mesh = plate(nx=6, ny=6, periodic=(True, True, False))
        strike_it = strike(mesh)
        mesh.nodes, mesh.free = mesh.nodes + shift, mesh.free + shift
        table = lmp(start(mesh, fem=FAILS, boundary="p p s", data=f"{k}.data") + strike_it + "run 40\n" + STATE.format("d"), nranks=nranks).runs[0]
        assert table["f_wall"][0] == 64 and table["f_wall"][-1] < 50, shift
        states.append((table, read_state("d")))
    (table_a, a), (table_b, b) = states
    assert np.array_equal(a["id"], b["id"])
    assert np.abs(a["V"] - b["V"]).max() < 1e-9 * np.abs(a["V"]).max()
    assert np.abs(a["F"] - b["F"]).max() < 1e-8 * np.abs(a["F"]).max()
    assert table_a["c_book[8]"] == pytest.approx(table_b["c_book[8]"], rel=1e-11)


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 3])
@pytest.mark.parametrize("lost", ["error", "ignore"])
def test_elements_that_leave_the_box(lmp, lost, nranks):
    mesh, strike_it = strike_plate()
    text = start(mesh, boundary="f f f").replace("lost error", f"lost {lost}") + "velocity all set 5000 0 0 units box\n"
    r = lmp(text + "run 1000\n", expect_fail=True, nranks=nranks)
    assert "must not leave the box" in r.error or "Lost atoms" in r.error
    assert 0 < r.returncode < 128


def test_measures_know_matter_once(lmp):
    """fragments, hole and cloud of group all: particles, in elements or free, no nodes"""
    mesh, strike_it = strike_plate()
    measures = "compute frag{0} {1} hvi/fragment distance {2}\ncompute cloud{0} {1} hvi/cloud axis z plane -1\ncompute hole{0} {1} hvi/hole axis z centre 0 0 plane -1e-3\n"
    text = start(mesh, fem=FAILS, more="c_frag1[*] c_cloud1[*] c_hole1[*] c_frag2[*] c_cloud2[*] c_hole2[*]")
    ours = "group matter type 1 2\n" + "".join(measures.format(k, g, 1.3 * DX) for k, g in ((1, "all"), (2, "matter")))
    text = text.replace("thermo_style", "comm_modify cutoff 2e-3\n" + ours + "thermo_style")
    table = lmp(text + strike_it + "run 40\n" + STATE.format("d")).runs[0]
    for name in table:
        if name.startswith(("c_frag1", "c_cloud1", "c_hole1")):
            assert np.array_equal(table[name], table[name.replace("1[", "2[")]), name
    matter = len(mesh.free) + mesh.embedded.shape[0] * mesh.embedded.shape[1]
    assert (table["c_frag1[2]"] == matter).all() and table["f_wall"][-1] < 50
    assert table["c_cloud1[9]"] == pytest.approx(table[f"c_book[{MASS}]"], rel=1e-9)
