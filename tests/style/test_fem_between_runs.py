"""What commands and fixes between runs of elements once made wrong without a word, and what their measures left out."""

import pathlib
import re

import numpy as np
import pytest
from fem_scenes import ALUMINUM, EDGE, STATE, plate, read_state, start, strike_plate
from hvi.model.mesh import block

ELASTIC = "convert no viscosity 0 0"
VIBRATES = "thermo 1\nthermo_style custom step c_book[8] c_book[9] f_wall[10]\nthermo_modify format float %.15g\nvelocity all ramp vz -50 50 z -2e-3 2e-3 units box\ngroup nodes type 3\n"


def cubes(n=0, **more):
    """4 x 4 x 4 elements about the origin, with n^3 particles each"""
    return start(block(4, 4, 4, map=lambda x: (x - 2) * EDGE, n=n, type=2, node_type=3), courant=0.8, every=1, **{"fem": ELASTIC, **more})


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (3, "off")])
@pytest.mark.parametrize("n", [0, 2])
def test_commands_that_touch_nodes(lmp, n, nranks, newton):
    """change the energy by their work, here none"""
    touch = "velocity nodes set 0 0 1e-12 sum yes units box\nrun 10\n"
    r = lmp(cubes(n, newton=newton) + VIBRATES + "run 10\n" + 5 * touch, nranks=nranks)
    assert len(r.runs) == 6
    for run in r.runs:
        assert run["c_book[9]"] == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize("nranks", [1, 2])
def test_fixes_that_change_forces_of_nodes(lmp, nranks):
    """come and go, after fix hvi/fem: the first line of the next run is the last one of that before, also from a restart file"""
    hold = "region top block INF INF INF INF 1.5e-3 INF units box\ngroup top region top\nvelocity top set NULL NULL 0 units box\n"
    text = cubes() + VIBRATES + hold
    clamp = "fix hold top setforce NULL NULL 0\n"
    r = lmp(text + clamp + "run 20\nwrite_restart half\nrun 5\nunfix hold\nrun 20\n" + clamp + "velocity top set NULL NULL 0 units box\nrun 5\n", nranks=nranks)
    first, second, free, held = (run["c_book[8]"] for run in r.runs)
    for run in (first, second, free):
        assert run == pytest.approx(first[0], rel=1e-8)
    assert held == pytest.approx(held[0], rel=1e-8)
    begin, rest = text.index("fix move"), text[text.index("neighbor"):text.index("velocity all ramp")]
    rest = re.sub(r"read_data .*\n", "", text[begin:text.index("neighbor")]) + rest + "region top block INF INF INF INF 1.5e-3 INF units box\n" + clamp
    went_on = lmp("atom_modify sort 0 0\nread_restart half\nfix prop all property/atom rmass ghost yes\n" + rest + "run 5\n", nranks=nranks).thermo["c_book[8]"]
    assert went_on == pytest.approx(first[0], rel=1e-8)


@pytest.mark.parametrize("nranks", [1, 2])
def test_energy_is_the_same_wherever_it_is_read(lmp, nranks):
    """of the fix, of its elements, of embedded particles, of the wall"""
    text = cubes(2, fem=ELASTIC + " local 1") + VIBRATES + "compute l all reduce sum f_wall[16] inputs local\ncompute a all hvi/atom e\ncompute s all reduce sum c_a\nvariable l equal c_l*2703*1e-9\nvariable s equal c_s*2703*1e-9/8\n" \
        "compute w all hvi/wall axis z wall 2 -2e-3 4e-3 nodes 3\nthermo_style custom step f_wall[10] v_l v_s c_w[1][5] c_book[8]\nthermo_modify norm no format float %.15g\nrun 30\n"
    t = lmp(text, nranks=nranks).thermo
    assert np.ptp(t["f_wall[10]"]) > 0.1 * t["f_wall[10]"].max()
    for name in ("v_l", "v_s"):
        assert t[name] == pytest.approx(t["f_wall[10]"], rel=1e-9), name
    assert t["c_w[1][5]"] == pytest.approx(t["c_book[8]"], rel=1e-9)


@pytest.mark.parametrize("shift", [0.0, -1e-9])
def test_probe_in_a_periodic_box(lmp, shift):
    """reads the element that it is in, wherever its first node is wrapped to"""
    mesh = block(8, 3, 2, map=lambda x: (x - [0, 0, 2]) * EDGE, n=0, type=2, node_type=3, periodic=(True, True, False))
    text = start(mesh, boundary="p p s", fem="probe 0.5e-3 1.5e-3 -0.5e-3") + f"velocity all ramp vz 10 90 x 0 8e-3 units box\ndisplace_atoms all move {shift:g} 0 0 units box\n"
    t = lmp(text + "thermo_style custom step f_wall[1][11]\nrun 0\n").thermo
    assert t["f_wall[1][11]"][0] == pytest.approx(15.0, abs=1e-3)


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("reach", [0.4e-3, 0.6e-3])
def test_pieces_of_a_quarter(lmp, reach, nranks):
    """elements hang together with their images, however far their particles are from the plane"""
    found = []
    for whole in (True, False):
        mesh = plate(*((4, 4) if whole else (2, 2)), 1, core=0, whole=whole)
        mesh.mirror = "" if whole else "x 0 lo y 0 lo"
        text = start(mesh, pair="cubic dissipation riemann" + ("" if whole else " mirror x 0 lo mirror y 0 lo"))
        found.append(lmp(text + f"compute f all hvi/fragment distance {reach}\nthermo_style custom step c_f[*]\nrun 0\n", nranks=nranks).thermo)
    assert found[0]["c_f[1]"][0] == found[1]["c_f[1]"][0] == 1 and found[0]["c_f[2]"][0] == found[1]["c_f[2]"][0] == 16 * 8


def test_walls_and_their_nodes(lmp):
    """that two walls share, or that are not in the group, are refused"""
    mesh, strike = strike_plate(v=1000.0)
    text = start(mesh) + strike + "group material type 1 2\nregion some block INF 0 INF INF INF INF\ngroup some region some\ngroup part union material some\n"
    for words, said in (("material hvi/wall axis z wall 2 -2e-3 2e-3 nodes 3", "group material not all of its nodes"), ("all hvi/wall axis z wall 2 -2e-3 2e-3", "wall 1 has elements, and group all not all of its nodes"),
                        ("part hvi/wall axis z wall 2 -2e-3 2e-3 nodes 3", "group part not all of its nodes"),
                        ("all hvi/wall axis z wall 2 -2e-3 2e-3 nodes 3 wall 1 0 2e-3 nodes 3", "walls 1 and 2 share a type of particles or nodes")):
        assert said in lmp(text + f"compute w {words}\nthermo_style custom step c_w[1][4]\nrun 1\n", expect_fail=True).error


def test_energy_that_elements_do_not_take(lmp):
    mesh, strike = strike_plate(v=1000.0)
    assert "elements begin without" in lmp(start(mesh) + strike + "set type 2 sph/e 1e-3\nrun 1\n", expect_fail=True).error


def test_two_elements_with_one_ID(lmp):
    """on two ranks"""
    text = start(block(8, 3, 2, map=lambda x: (x - [4, 1.5, 2]) * EDGE, n=0, type=2, node_type=3))
    data = open("mesh.data").read()
    head, rows = data[:data.index("Elements")], data[data.index("Elements"):].split("\n")
    rows = [re.sub(r"^48 ", "1 ", row) for row in rows]
    open("mesh.data", "w").write(head + "\n".join(rows))
    for nranks in (1, 2):
        assert "two elements have the ID 1" in lmp(text.replace("processors * * *", f"processors {nranks} 1 1") + "run 1\n", nranks=nranks, expect_fail=True).error


def test_state_after_all_this(lmp):
    """an impact in one run, and in three with forces of a fix that come and go in between, which do nothing"""
    mesh, strike = strike_plate(v=1000.0)
    text = start(mesh) + strike
    lmp(text + "run 30\n" + STATE.format("one"))
    none = "fix none all addforce 0 0 0\nrun 10\nunfix none\n"
    lmp(text + "run 10\n" + none + "run 10\n" + STATE.format("three"))
    one, three = read_state("one"), read_state("three")
    for name in ("X", "V", "c_state[2]"):
        np.testing.assert_allclose(three[name], one[name], rtol=1e-9, atol=1e-9 * np.abs(one[name]).max())


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (3, "off")])
@pytest.mark.parametrize("scene", ["modulus", "spalled"])
def test_forces_of_a_new_run(lmp, scene, nranks, newton):
    """are those of the end of the last one, also where the modulus has changed, or elements have failed that stay"""
    weak = pathlib.Path("weak.hvi").absolute()
    weak.write_text(re.sub(r"sigma_p +1.2e9", "sigma_p 0.05e9", ALUMINUM.read_text()))
    spalls = scene == "spalled"
    mesh, strike_it = strike_plate(**(dict(v=600.0) if spalls else dict(v=5000.0, core=0)))
    text = start(mesh, every=1, newton=newton, **(dict(fem="convert no", spall="principal", material=weak) if spalls else {}))
    text = text.replace("hvi/johnson-cook damage no", f"hvi/johnson-cook strength {'johnson-cook' if spalls else 'steinberg-guinan'} damage no")
    text = text.replace("szz sxy sxz syz damage voids", "szz sxy sxz syz spalled voids" if spalls else "szz sxy sxz syz damage voids")
    lmp(text + strike_it + f"run {30 if spalls else 10}\n" + STATE.format("end.dump") + "run 0\n" + STATE.format("begin.dump"), nranks=nranks)
    end, begin = read_state("end.dump"), read_state("begin.dump")
    if spalls:
        assert (end["c_state[10]"] > 0).sum() > 10
    assert np.array_equal(end["X"], begin["X"]) and np.array_equal(end["V"], begin["V"])
    assert begin["F"] == pytest.approx(end["F"], abs=1e-9 * np.abs(end["F"]).max())


@pytest.mark.parametrize("nranks", [1, 2])
def test_orphans_at_a_mirror_plane(lmp, nranks):
    """the inner elements of a row hang together across the plane, and stay when the outer ones have failed"""
    found = []
    for n, low in ((4, -2), (2, 0)):
        mesh = block(n, 1, 1, map=lambda x: (x + [low, 0, 0]) * EDGE, n=2, type=2, node_type=3)
        box = " ".join(f"{a * EDGE:.17g} {5 * EDGE}" for a in (-5 if low else 0, -5, -5))
        text = start(mesh, boundary="f f f", box=box, pair="cubic" + ("" if low else " mirror x 0 lo"), fem="strain 0.05")
        text += f"group nodes type 3\nvariable outer atom 1000*((x>{1.5 * EDGE})+(x<-{1.5 * EDGE}))\nvelocity nodes set NULL NULL v_outer units box\n"
        t = lmp(text + "thermo_style custom step f_wall f_wall[1] f_wall[6]\nrun 60\n", nranks=nranks).thermo
        found.append([t[name][-1] for name in ("f_wall", "f_wall[1]", "f_wall[6]")])
    assert found == [[2, 2, 0], [1, 1, 0]]


@pytest.mark.parametrize("nranks, newton, command", [
    (1, "off", ""), (3, "on", ""), (1, "on", "balance 1.0 shift z 5 1.05\nwrite_restart before\n"), (2, "off", "delete_atoms overlap 1e-5 ball ball compress no\nwrite_restart before\n")])
def test_masses_are_there_in_the_first_run(lmp, nranks, newton, command):
    """for computes and fixes that ask for them before it begins, wherever they stand: center and gyration as in a second run, and a ball that has its momentum taken stands"""
    mesh, strike_it = strike_plate()
    measures = "compute center ball com\ncompute width ball gyration\nvariable z equal xcm(ball,z)\nvariable v equal vcm(ball,z)\n" \
        "thermo_style custom step c_center[3] v_z c_width v_v\nthermo_modify format float %.15g\n"
    text = start(mesh, newton=newton).replace("fix move all", "group ball type 1\nfix still ball momentum 1 linear 1 1 1\nfix move all") + strike_it + measures
    first, second = lmp(text + command + "run 10\nrun 0\n", nranks=nranks).runs
    assert first["c_center[3]"] == pytest.approx(first["v_z"], rel=1e-9) and abs(first["v_z"][0]) > EDGE
    assert first["c_width"][-1] == pytest.approx(second["c_width"][0], rel=1e-12) and first["c_width"][0] > 0.5 * EDGE
    assert first["v_v"][0] == pytest.approx(-3000) and abs(first["v_v"][-1]) < 1e-6
    if command:  # a restart file from before the first run
        again = text.split("\n", 1)[0] + "\natom_modify map yes\nread_restart before\nfix prop all property/atom rmass ghost yes\n" + text[text.index("group ball type 1"):]
        again = "\n".join(line for line in again.splitlines() if not line.startswith(("read_data", "velocity", "group ball"))) + "\n"
        later = lmp(again + "run 10\n", nranks=nranks).thermo
        assert [later[name][0] for name in ("c_center[3]", "c_width", "v_v")] == pytest.approx([first[name][0] for name in ("c_center[3]", "c_width", "v_v")], rel=1e-12)
