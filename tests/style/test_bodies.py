"""Sound matter that has come apart does not heal where it meets again: it is another body, as if of another type."""

import struct

import numpy as np
import pytest
from dumps import read_dump
from fem_scenes import ALUMINUM, EDGE, plate, start

DX = 1e-3
BLOCKS = """units si
newton {newton}
atom_style sph
atom_modify map yes
boundary {boundary}
lattice sc 1e-3 origin 0.5 0.5 0.5
region box block {low} 8 -8 8 -14 14
create_box 2 box
region lower block {low} 3 -3 3 -6 0
region upper block {low} 3 -3 3 {gap} {top}
create_atoms 1 region lower
create_atoms {type} region upper
mass * 2.703e-6
set group all sph/rho 2703.0
group upper region upper
pair_style hvi/sph cubic dissipation riemann {pair}
pair_coeff * * file {file} h 1.3e-3
{tension}
fix move all hvi/sph
fix solid all hvi/johnson-cook damage yes spall pressure
fix step all hvi/dt 0.4
neighbor 0.3e-3 bin
compute s all hvi/atom p sxx syy szz sxy sxz syz body
variable up equal vcm(upper,z)
thermo_style custom step time v_up
thermo_modify format float %.15g
"""
OUT = "write_dump all custom {} id x y z vx vy vz c_s[*] modify sort id format float %.17g\n"
APART = "velocity upper set 0 0 {} units box\n"


def blocks(newton="on", type=1, gap=2, mirror=False):
    text = BLOCKS.format(file=ALUMINUM, newton=newton, type=type, gap=gap, top=gap + 6, low=0 if mirror else -3, pair="mirror x 0 lo" if mirror else "",
                         tension="pair_coeff 1 2 tension no" if type == 2 else "", boundary="f s s" if mirror else "s s s")
    return text.replace("block -3 8", "block -8 8")


def rows(path):
    table = read_dump(path).table
    return table[:, 1:-1], table[:, -1].astype(int)


def same(path, other, close=1e-11):
    (a, _), (b, _) = rows(path), rows(other)
    for k in range(a.shape[1]):
        scale = np.abs(b[:, k]).max()
        assert np.abs(a[:, k] - b[:, k]).max() <= close * scale, (k, np.abs(a[:, k] - b[:, k]).max(), scale)


@pytest.mark.each_value
@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (3, "off")])
def test_two_pieces_of_one_type(lmp, tmp_path, nranks, newton, mirror):
    """They meet, and part again, as two types without tension do: the same bits on one rank"""
    for type in (1, 2):
        lmp(blocks(newton, type, mirror=mirror) + APART.format(-300.0) + "run 500\n" + OUT.format(f"{type}.dump"), nranks=nranks if type == 1 else 1)
    same(tmp_path / "1.dump", tmp_path / "2.dump", 0.0 if nranks == 1 else 1e-6)
    state, label = rows(tmp_path / "1.dump")
    half = len(label) // 2
    assert set(label[:half]) == {1} and set(label[half:]) == {half + 1}
    assert state[half:, 5].mean() - state[:half, 5].mean() > 20.0  # they have come apart again


def test_one_piece(lmp, tmp_path):
    """What begins as one is one: the halves hold each other back"""
    lmp(blocks(gap=0) + APART.format(20.0) + "run 200\n" + OUT.format("one.dump"))
    state, label = rows(tmp_path / "one.dump")
    assert set(label) == {1}
    assert abs(state[len(label) // 2:, 5].mean()) < 19.0


@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "off")])
def test_does_not_heal(lmp, tmp_path, nranks, newton):
    """Halves that have been apart when labels were made are two bodies from then on, also when they are put back, and after a restart"""
    text = blocks(newton, gap=0)
    move = "displace_atoms upper move 0 0 {} units box\nrun {}\n"
    apart = text + "timestep 1e-9\nunfix step\nrun 50\n" + move.format(5 * DX, 20)
    lmp(apart + OUT.format("early.dump"), nranks=nranks)
    assert set(rows(tmp_path / "early.dump")[1]) == {1}  # no labels were made since the first step
    lmp(apart + "run 40\nwrite_restart apart.restart\n" + move.format(-5 * DX, 0) + OUT.format("back.dump") + APART.format(20.0) + "run 20\n" + OUT.format("straight.dump"), nranks=nranks)
    label = rows(tmp_path / "back.dump")[1]
    half = len(label) // 2
    assert set(label[:half]) == {1} and set(label[half:]) == {half + 1}
    assert rows(tmp_path / "straight.dump")[0][half:, 5].mean() == pytest.approx(20.0, rel=1e-6)  # nothing holds it
    head = text[text.index("pair_style"):]
    again = "units si\n" + f"newton {newton}\natom_modify map yes\nread_restart apart.restart\n" + head + "timestep 1e-9\nunfix step\nrun 0\n" + move.format(-5 * DX, 0)
    lmp(again + APART.format(20.0) + "run 20\n" + OUT.format("again.dump"), nranks=nranks)
    same(tmp_path / "again.dump", tmp_path / "straight.dump", 1e-9)
    assert (rows(tmp_path / "again.dump")[1] == label).all()


@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "off")])
def test_hangs_on_elements(lmp, tmp_path, nranks, newton):
    """What hangs on elements has the label 0; a piece beside them its own"""
    mesh = plate()
    piece = np.array([[0.25, 0.25, 3.0], [0.75, 0.25, 3.0]]) * EDGE
    mesh.free = np.concatenate([mesh.free, piece])
    mesh.free_type = np.concatenate([mesh.free_type, [2, 2]])
    mesh.free_volume = np.concatenate([mesh.free_volume, [mesh.free_volume[0]] * 2])
    text = start(mesh, newton=newton, spall="pressure") + "compute s all hvi/atom body\nrun 0\n"
    lmp(text + "group held type 2\nwrite_dump held custom e.dump id z z z z z z c_s modify sort id\n", nranks=nranks)
    z, label = rows(tmp_path / "e.dump")
    beside = z[:, 0] > 2 * EDGE
    assert beside.sum() == 2 and len(set(label[beside])) == 1 and (label[beside] > 0).all()
    assert (label[~beside] == 0).all()


def test_types_that_labels_have_room_for(lmp):
    """a number says type and label: more types than it has room for are refused"""
    text = blocks().replace("create_box 2 box", "create_box 1024 box")
    assert lmp(text + "run 0\n", expect_fail=True).error.startswith("Pair style hvi/sph has at most 1023 types, not 1024")


@pytest.mark.parametrize("after, old, message", [
    (b"cubic", struct.pack("<ii", 1001, 5), "Pair hvi/sph: the restart file is of another version of the package"),
    (b"hvi/dt\0", struct.pack("<dd", -1.0, 1e-9), "Fix hvi/dt: the restart file is of another version of the package")])
def test_restart_files_of_another_version(lmp, tmp_path, after, old, message):
    """files with what was there before sections had headers are refused, not misread"""
    lmp(blocks() + "run 1\nwrite_restart now.restart\n")
    data = (tmp_path / "now.restart").read_bytes()
    mark = struct.pack("<Q", 0x4856490000000001)
    at = data.rindex(mark, 0, data.index(after)) if message.startswith("Pair") else data.index(mark, data.index(after))
    (tmp_path / "old.restart").write_bytes(data[:at] + old + data[at + len(old):])
    text = blocks()
    again = "units si\natom_modify map yes\nread_restart old.restart\n" + text[text.index("pair_style"):] if message.startswith("Fix") else "atom_modify map yes\nread_restart old.restart\n"
    assert lmp(again + "run 0\n", expect_fail=True).error.startswith(message)


def test_without_a_law_of_failure(lmp, tmp_path):
    """What no law lets fail is parted by clumps of particles only: two pieces at the start are two bodies, a piece that comes apart stays one"""
    text = blocks(gap=0).replace("damage yes spall pressure", "damage no spall none") + "pair_coeff 1 2 tension no\ntimestep 1e-9\nunfix step\n"
    lmp(text + "run 0\ndisplace_atoms upper move 0 0 5e-3 units box\nrun 150\n" + OUT.format("apart.dump"))
    assert set(rows(tmp_path / "apart.dump")[1]) == {1}
    lmp(blocks().replace("damage yes spall pressure", "damage no spall none") + "pair_coeff 1 2 tension no\nrun 0\n" + OUT.format("two.dump"))
    assert len(set(rows(tmp_path / "two.dump")[1])) == 2


@pytest.mark.parametrize("nranks, newton", [(1, "on"), pytest.param(2, "on", marks=pytest.mark.long), (3, "off")])
def test_a_body_comes_to_its_image(lmp, tmp_path, nranks, newton):
    """Two blocks that meet in the plane between them, and one of them that meets its image there: both rebound, alike"""
    whole = blocks(newton).replace("-6 0\n", "-8 -2\n").replace("2 8\n", "2 8\n")
    assert "-8 -2" in whole
    speeds = "velocity upper set 0 0 -150 units box\nvelocity lower set 0 0 150 units box\n"
    end = "unfix step\ntimestep 4e-8\nthermo 100\nrun 700\n"
    text = whole.replace("group upper", "group lower region lower\ngroup upper") + speeds + end
    r = lmp(text, nranks=nranks)
    half = text.replace("create_atoms 1 region lower\n", "").replace("pair_style hvi/sph cubic dissipation riemann", "pair_style hvi/sph cubic dissipation riemann mirror z 0 lo").replace(
        "-14 14", "0 14").replace("s s s", "s s f")
    m = lmp(half.replace("group lower region lower\n", "").replace("velocity lower set 0 0 150 units box\n", "") + OUT.format("half.dump"), nranks=nranks)
    assert r.thermo["v_up"][-1] > 15 and m.thermo["v_up"] == pytest.approx(r.thermo["v_up"], abs=1e-6 * 150)
    assert set(rows(tmp_path / "half.dump")[1]) == {1}


@pytest.mark.parametrize("nranks, newton", [(1, "on"), pytest.param(2, "on", marks=pytest.mark.long), (3, "off")])
def test_a_body_that_a_plane_cuts(lmp, tmp_path, nranks, newton):
    """is one with its image, until it is pulled away: then it bounces there, too; so after a restart"""
    text = blocks(newton, gap=0).replace("create_atoms 1 region lower\n", "").replace("dissipation riemann", "dissipation riemann mirror z 0 lo").replace("s s s", "s s f").replace("-14 14", "0 14")
    text += "unfix step\ntimestep 4e-8\nthermo 10\n"
    r = lmp(text + "velocity all set 0 0 20 units box\nrun 40\n", nranks=nranks)
    assert r.thermo["v_up"].min() < 19  # it is held
    move = "displace_atoms all move 0 0 {} units box\n"
    parted = text + "run 1\n" + move.format(5 * DX) + "run 104\nwrite_restart apart.restart\n"
    back = move.format(-5 * DX) + "velocity all set 0 0 20 units box\nrun 40\n"
    assert lmp(parted + back, nranks=nranks).runs[-1]["v_up"] == pytest.approx(20.0, rel=1e-9)
    again = f"units si\nnewton {newton}\natom_modify map yes\nread_restart apart.restart\n" + text[text.index("pair_style"):]
    assert lmp(again + "run 0\n" + back, nranks=4 - nranks).runs[-1]["v_up"] == pytest.approx(20.0, rel=1e-9)


@pytest.mark.parametrize("kernel", ["cubic", "wendland2"])
def test_terms_that_were_not_asked_for(lmp, kernel):
    """What no law lets fail, of one type, is one body: with h variable, too, whose loop knows bodies"""
    text = blocks().replace("damage yes spall pressure", "damage no spall none").replace("create_box 2", "create_box 1").replace("hvi/sph cubic", f"hvi/sph {kernel}")
    assert "pair_coeff * *" in text
    ends = []
    for more in ("", "h variable 1 1"):
        r = lmp(text.replace("dissipation riemann", f"dissipation riemann {more}") + APART.format(-300.0) + "unfix step\ntimestep 4e-8\nthermo 100\nrun 300\n")
        ends.append(r.thermo["v_up"])
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)


def test_bodies_of_two_files(lmp, tmp_path):
    """labels are IDs: read_data add append shifts them, so a block read twice is two bodies"""
    one = blocks().replace("create_atoms 1 region upper\n", "") + "unfix step\ntimestep 4e-8\nrun 1\nwrite_data one.data\n"
    lmp(one)
    sections = " ".join(f"fix {fix} NULL {name}" for fix, name in (("move", "NULL"), ("move", "move_rates"), ("move", "move_step"), ("solid", "NULL"), ("solid", "solid_forces")))
    text = blocks()
    head = text[:text.index("region lower")]
    text = head + "fix move all hvi/sph\nfix solid all hvi/johnson-cook damage yes spall pressure\n" + "".join(
        f"read_data one.data add append {shift} nocoeff {sections}\n" for shift in ("", f"shift 0 0 {12 * DX}")) + text[text.index("pair_style"):].replace(
        "fix move all hvi/sph\nfix solid all hvi/johnson-cook damage yes spall pressure\n", "").replace("variable up equal vcm(upper,z)\n", "").replace(" v_up", "")
    lmp(text + "unfix step\ntimestep 4e-8\nreset_timestep 1\nrun 0\n" + OUT.format("two.dump"))
    label = rows(tmp_path / "two.dump")[1]
    half = len(label) // 2
    assert set(label[:half]) == {1} and set(label[half:]) == {half + 1}


def test_lines_of_data_files(lmp, tmp_path):
    """numbers have all their digits and an exponent at the front of a wave: LAMMPS must be able to read the lines"""
    text = blocks(gap=0).replace("-3 3 -3 3", "-6 6 -6 6")
    lmp(text + APART.format(-1e-3) + "run 12\nwrite_data wave.data\n")
    lines = open("wave.data").read().splitlines()
    sections = [line.split("# id")[1].split() for line in lines if "# id" in line]
    assert len(sections) == 5 and max(map(len, sections)) * 25 + 12 < 256 and max(map(len, lines)) < 256
