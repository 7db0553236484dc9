"""compute hvi/wall: the same numbers as a dump gives another program; ranks, newton, restart, mirrors; wrong input."""

import re

import hvi
import numpy as np
import pytest
import rear_faces
from hvi.shield import record

HEAD = """
units si
atom_style sph
atom_modify map array sort 0 0.0
newton {newton}
boundary f f f
region box block {low} 8e-3 {low} 8e-3 -8e-3 16e-3 units box
create_box 3 box
lattice sc 6e-4 origin 0.5 0.5 0.5
region ball sphere 0 0 -1.8e-3 1.8e-3 units box
create_atoms 1 region ball
region one cylinder z 0 0 5.4e-3 0 1.2e-3 units box
create_atoms 2 region one
region two cylinder z 0 0 6e-3 6e-3 7.8e-3 units box
create_atoms 3 region two
change_box all x final {edge} 8e-3 y final {edge} 8e-3 units box
mass * $(2703*6e-4^3)
pair_style hvi/sph cubic dissipation riemann {mirror}
pair_coeff * * file Al6061-T6.hvi h 7.2e-4
set group all sph/rho 2703
group ball type 1
velocity ball set 0 0 3000 units box
"""
MODEL = """
neighbor 4.8e-4 bin
neigh_modify every 1 delay 0 check yes
fix move all hvi/sph
fix solid all hvi/johnson-cook damage no spall voids
fix step all hvi/dt 0.6
compute w all hvi/wall axis z wall 2 0 1.2e-3 layers 2 radius 5.4e-3 wall 3 6e-3 1.8e-3 layers 3 radius 6e-3 pieces 9e-4
compute state all hvi/atom damage spalled eps
thermo_modify lost ignore
"""
PRINT = "run 0 post no\n" + "".join(f"print 'row {k} " + " ".join(f"$(c_w[{k}][{c}]:%.15g)" for c in range(1, 1 + len(record.WALL))) + "'\n" for k in (1, 2))
NAMES = record.WALL


@pytest.fixture
def walls(lmp, root, tmp_path):
    def run(text, nranks=1, **kw):
        r = lmp(text, nranks=nranks, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)
        return r if kw.get("expect_fail") else [dict(zip(NAMES, map(float, row.split()))) for row in re.findall(r"^row \d (.*)", r.log, re.M)]

    return run


def scene(newton="on", quarter=False, steps=60):
    head = HEAD.format(newton=newton, low=0 if quarter else -8e-3, edge=-6e-4 if quarter else -8e-3, mirror="mirror x 0 lo mirror y 0 lo" if quarter else "")
    return head + MODEL + (f"run {steps} post no\n" if steps else "")


def equal(one, two, rel):
    for a, b in zip(one, two):
        for name in NAMES:
            scale = max(abs(a[name]), abs(b[name]))
            least = 1e-9 if name == "push" else 1e-15 if name in ("plane_x", "plane_y") else 1e-25  # centers are 0 to round-off, m
            assert abs(a[name] - b[name]) <= rel * scale + least, name


@pytest.mark.parametrize("quarter", [False, True])
def test_as_a_dump_says(walls, tmp_path, quarter):
    """sums, what has passed, what is apart, bulge and hole from positions, velocities and IDs; pieces of a quarter are those of the whole"""
    dump = "write_dump all custom end.dump id type mass x y z vx vy vz c_state[1] c_state[2] c_state[3] modify colname c_state[1] damage colname c_state[2] spalled format float %.17g\n"
    first, second = walls(scene(steps=150, quarter=quarter) + PRINT + dump)
    frame, whole = (hvi.Dump(str(tmp_path / "end.dump"), units="si", mirror=planes)[0] for planes in ("none", ["x=0", "y=0"] if quarter else "none"))
    kind, z, v, m = frame["type"].astype(int), frame.x[:, 2], frame.v[:, 2], frame.m
    energy = 0.5 * m * (frame.v**2).sum(axis=1)
    failed = hvi.fragments.has_failed(frame)
    coming = (kind != 3) & (z < 6e-3) & (v > 0)
    assert second["coming_mass"] == pytest.approx(m[coming].sum(), rel=1e-12) and second["coming_energy"] == pytest.approx(energy[coming].sum(), rel=1e-12)
    foreign = (kind == 1) & (z > 1.2e-3) & (v > 0)
    assert ((kind == 3) & (v > 0)).sum() > 10  # what is behind has not passed
    assert first["passed_mass"] == pytest.approx(m[foreign].sum(), rel=1e-12) and first["passed_energy"] == pytest.approx(energy[foreign].sum(), rel=1e-12)
    assert first["momentum"] == pytest.approx(m[kind == 2] @ v[kind == 2], rel=1e-10) and first["mass"] == pytest.approx(m[kind == 2].sum(), rel=1e-12)
    assert first["tip"] == pytest.approx(z[kind < 3].max(), rel=1e-12)

    def pieces(where, sound):
        label = np.full(len(kind), -1)
        label[where] = np.arange(where.sum()) + len(kind)  # alone
        some = where & ~(failed & sound)
        label[some] = hvi.find(frame.select(some), distance=9e-4).label
        return label

    mine = pieces(kind == 2, True)
    heavy = max(set(mine[kind == 2]), key=lambda n: m[mine == n].sum())
    member = np.flatnonzero(mine == heavy)[np.argmin(frame.ids[mine == heavy])]
    everything = [pieces(np.ones(len(kind), dtype=bool), sound) for sound in (True, False)]
    body, hull = (label == label[member] for label in everything)
    flown = (z - 1.2e-3) / np.where(v > 0, v, 1)
    aside = (kind != 2) & (v > 0) & (np.hypot(*(frame.x[:, :2] - flown[:, None] * frame.v[:, :2]).T) > 5.4e-3)  # of wall 2, which does not come from wall 1
    hidden = rear_faces.hidden(frame, hull & (kind == 2), 2703)
    passed = (kind < 3) & (z > 1.2e-3) & (v > 0) & ~body & ~aside & ~hidden
    assert first["missed_mass"] == pytest.approx(m[(kind == 1) & (z > 1.2e-3) & aside].sum()) and first["cloud_mass"] == pytest.approx(m[passed].sum(), rel=1e-12) and first["cloud_mass"] > 0
    assert first["apart_mass"] == pytest.approx(m[passed & ~hull].sum(), rel=1e-12, abs=1e-20)
    assert first["spall_mass"] == pytest.approx(m[passed & ~hull & (kind == 2)].sum(), rel=1e-12, abs=1e-20)
    assert first["apart_number"] == (passed & ~hull).sum()
    assert first["bulge"] == pytest.approx(z[body & (kind == 2)].max() + 3e-4 - 1.2e-3, rel=1e-9)
    found, said = hvi.fragments.both(whole.select(passed), distance=9e-4, failed=list(hvi.fragments.FAILED))
    assert (first["fragments"], first["pieces_apart"]) == (said["fragments"], said["pieces_apart"]) and first["fragments"] > first["pieces_apart"] > 5
    assert first["largest_mass"] == pytest.approx(found.table["mass"][0], rel=1e-12)
    assert first["largest_velocity"] == pytest.approx(found.table["vz"][0], rel=1e-10) or np.sum(found.table["mass"] > 0.999 * found.table["mass"][0]) > 1
    assert first["largest_apart_mass"] == pytest.approx(said["largest_apart_mass_fraction"] * said["mass"], rel=1e-12)
    assert first["rear_strain"] > 0.01 and first["failed_depth"] > 0 and first["plastic_power"] > 0
    assert first["hole_found"] == first["plane_found"] == 1 and 3.6e-3 < first["hole_min"] <= first["hole_diameter"] <= first["hole_max"] < 9e-3
    assert 0 < second["body_mass"] <= second["mass"] * (1 + 1e-12)


LOOSE = """
group wall type 2
variable high atom z+5e-3*exp(-(x*x+y*y)/1.6e-5)
set group wall z v_high
delete_atoms group ball
create_atoms 1 single {0} units box
create_atoms 1 single 0 4e-3 3.9e-3 units box
set type 1 sph/rho 2703
group ball type 1
velocity ball set 0 0 10 units box
"""


@pytest.mark.parametrize("nranks", [1, pytest.param(2, marks=pytest.mark.long), 4])
def test_what_lies_in_a_bulge_has_not_come_through(walls, nranks):
    """A wall that has bulged by four thicknesses: loose particles before its rear face are not behind it, those behind are, and what flies where it has a hole"""
    text = scene(steps=0)
    for place, apart in (("0 0 3.5e-3", 1), ("0 0 9.5e-3", 2), ("0.3e-3 -0.2e-3 1.5e-3", 1)):  # the other one is behind the slope of the bulge
        first, _ = walls(text + LOOSE.format(place) + "run 0 post no\n" + PRINT, nranks)
        assert first["bulge"] > 4e-3 and (first["apart_number"], first["pieces_apart"]) == (apart, apart), place
    hole = "region hole cylinder z 0 0 1.3e-3 EDGE EDGE units box\ngroup hole region hole\ngroup gone intersect hole wall\ndelete_atoms group gone\n"
    first, _ = walls(text + LOOSE.format("0 0 3.5e-3").replace("delete_atoms group ball", hole + "delete_atoms group ball") + "run 0 post no\n" + PRINT, nranks)
    assert first["apart_number"] == 2 and first["hole_found"] == 1


def test_internal_forces_cancel(walls):
    """the push on a wall is the change of its momentum; before it is struck there is none"""
    text = scene(steps=20) + PRINT + "run 1 post no\n" + PRINT
    rows = walls(text)
    assert abs(rows[1]["push"]) < 1e-6 * abs(rows[0]["push"]) and rows[0]["push"] > 0
    assert rows[2]["momentum"] > rows[0]["momentum"] > 0


@pytest.mark.parametrize("nranks, newton", [pytest.param(2, "on", marks=pytest.mark.long), (3, "on"), (2, "off")])
def test_ranks_and_newton(walls, nranks, newton):
    """on one state: the forces of a long run differ in their last digits, and fracture shows that"""
    equal(walls(scene(steps=20) + PRINT), walls(scene(newton, steps=20) + PRINT, nranks), 1e-8)


def test_restart_keeps_where_particles_were(walls):
    begun = walls(scene(steps=40) + PRINT + "write_restart half\n")
    again = walls("read_restart half\n" + MODEL + PRINT)
    assert begun[0]["rear_strain"] > 0 and begun[0]["failed_depth"] == again[0]["failed_depth"]
    equal(begun, again, 1e-9)


def test_defaults(walls):
    """layers 1, radius without end, struck in the middle, which is on the axis: as said"""
    text = scene(steps=40) + PRINT
    said = "wall 2 0 1.2e-3 layers 2 radius 5.4e-3 wall 3 6e-3 1.8e-3 layers 3 radius 6e-3"
    assert said in text
    one, two, three = (walls(text.replace(said, words)) for words in (
        "wall 2 0 1.2e-3 wall 3 6e-3 1.8e-3", "wall 2 0 1.2e-3 layers 1 radius 1e20 center 0 0 struck 0 0 wall 3 6e-3 1.8e-3 layers 1 radius 1e20 center 0 0 struck 0 0",
        "wall 2 0 1.2e-3 struck 0 0 center 1e-3 0 wall 3 6e-3 1.8e-3"))
    assert one == two and one[0]["hole_found"] == 1
    assert three[0]["hole_diameter"] == one[0]["hole_diameter"] and three[0]["far_free"] > one[0]["far_free"]


LIKE = MODEL.replace("compute w all", "compute first all").replace(" pieces 9e-4", "") + "compute w all hvi/wall like first pieces 9e-4\n"


@pytest.mark.parametrize("nranks", [1, 2])
def test_walls_of_another(walls, nranks):
    """like: the same rows, one record of first places for both, also after a restart"""
    text = scene(steps=40) + PRINT
    assert walls(text.replace(MODEL, LIKE), nranks) == walls(text, nranks)
    walls(scene(steps=40).replace(MODEL, LIKE) + "write_restart half\n", nranks)
    begun, again = (walls("read_restart half\n" + model + PRINT, nranks) for model in (MODEL.replace("compute w ", "compute first ").replace("c_w", "c_first")
                                                                                     + "compute w all hvi/wall like first pieces 9e-4\n", LIKE))
    equal(begun, again, 1e-12)
    assert begun[0]["failed_depth"] > 0


def test_a_wall_that_was_drilled(walls):
    """nothing has reached wall 2, but its hole was there"""
    drilled = scene(steps=20).replace("change_box all", "region drill cylinder z 0 0 1.8e-3 5e-3 8e-3 units box\ndelete_atoms region drill\nchange_box all")
    one = walls(drilled + PRINT)
    assert one[1]["hole_found"] == 1 and one[1]["hole_diameter"] == pytest.approx(3.8e-3, rel=0.1) and one[1]["energy"] == 0
    later = walls(drilled.replace("run 20 post no", "fix r all ave/time 5 1 5 c_w[*] mode vector\nrun 20 post no") + PRINT)  # looked at five times
    equal(one, later, 1e-9)


def test_a_wall_that_is_drilled_between_runs(walls):
    """what was found of an untouched wall in one run does not count in the next"""
    drill = "region drill cylinder z 0 0 1.8e-3 5e-3 8e-3 units box\ndelete_atoms region drill\n"
    found = walls(scene(steps=20) + PRINT + drill + PRINT)
    assert [row["hole_found"] for row in found[1::2]] == [0, 1] and found[3]["hole_diameter"] == pytest.approx(3.8e-3, rel=0.1)


DRILLED = HEAD.format(newton="on", low=-8e-3, edge=-8e-3, mirror="").replace(
    "change_box all", "region drill cylinder z 0 0 1.8e-3 -1e-3 2e-3 units box\ndelete_atoms region drill\nchange_box all")


@pytest.mark.parametrize("struck, found", [("0 0", 1), ("30e-3 0", -1)])
def test_a_drilled_wall_that_flies_before_a_restart(walls, struck, found):
    """by more than its depth: the hole is still where the wall was struck, if that was on the wall"""
    model = MODEL.replace("wall 2 0 1.2e-3", f"wall 2 0 1.2e-3 struck {struck}")
    start = DRILLED.replace("velocity ball set 0 0 3000", "velocity all set 0 0 500") + "timestep 5e-8\n" + model.replace("fix step", "# fix step")
    begun = walls(start + "run 100\n" + PRINT + "write_restart half\n")
    again = walls("read_restart half\n" + model + PRINT)
    assert [row["hole_found"] for row in (begun[0], again[0])] == [found, found]
    if found == 1:
        assert begun[0]["hole_diameter"] == pytest.approx(3.8e-3, rel=0.1) and begun[0]["plane_diameter"] > 0
    equal(begun, again, 1e-9)


def test_fluids(walls):
    """pieces of matter without fix hvi/johnson-cook: what has none of its values counts as sound"""
    model = re.sub("^(fix solid|compute state).*\n", "", MODEL, flags=re.M)
    row = walls(DRILLED.replace("h 7.2e-4", "h 7.2e-4 strength none") + model + PRINT)[0]
    assert row["hole_found"] == 1 and row["hole_diameter"] == pytest.approx(3.8e-3, rel=0.1)
    assert row["body_mass"] == pytest.approx(row["mass"]) and row["rear_strain"] == 0


def test_hybrid(walls):
    """under pair_style hybrid/overlay, where LAMMPS's list has another order than the rows of fix hvi/lists, the rows are the same.  The ball comes
    a little aslant: in the symmetric scene particles lie on borders of the hole's sectors, to round-off"""
    aslant = scene().replace("velocity ball set 0 0 3000", "velocity ball set 37 11 3000")
    text = aslant.replace("pair_style hvi/sph cubic dissipation riemann", "pair_style hybrid/overlay zero 1e-4 hvi/sph cubic dissipation riemann")
    text = text.replace("pair_coeff * * file", "pair_coeff * * zero\npair_coeff * * hvi/sph file")
    equal(walls(text + PRINT), walls(aslant + PRINT), 1e-9)


def test_quarter_is_a_quarter(walls):
    whole, part = walls(scene(steps=20) + PRINT), walls(scene(quarter=True, steps=20) + PRINT)
    for a, b in zip(whole, part):
        for name in NAMES[:17]:
            share = 1 if name in ("tip", "failed_depth", "rear_strain", "missed_reach", "far_free") else 4
            assert share * b[name] == pytest.approx(a[name], rel=1e-6, abs=1e-6 if name == "push" else 1e-15), name
        assert b["bulge"] == pytest.approx(a["bulge"], rel=1e-6) and b["hole_found"] == a["hole_found"] == 0


WALLS = "compute w all hvi/wall axis z "
