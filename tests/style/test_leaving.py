"""Particles that leave through a fixed face take energy, momentum and mass with them, all booked."""

import os
import shutil
import subprocess

import numpy as np
import pytest
from scenes import R_EQ, State, books, contact, cube, ledger, momentum_error, scene, spring

LOST = "thermo_modify lost ignore format float %.16e\n"


def fly(s, steps, dt=0.001, newton="on", every=10, rebuild="every 1 check yes", **how):
    return (scene(s, "s.data", newton=newton, **how) + f"neigh_modify {rebuild}\nfix nve all nve\n" + ledger(every=every) + LOST
            + f"timestep {dt}\nrun {steps}\n")


def check(book, s, tolerance):
    """energy closes, nothing of momentum and mass is missing"""
    assert np.abs(book["ratio"] - 1).max() <= tolerance
    assert momentum_error(book, s) <= 1e-12
    mass = np.array(s.masses)[s.types - 1].sum()
    assert book["mass"] + book["left_mass"] == pytest.approx(np.full(len(book["mass"]), mass), rel=1e-13)


@pytest.mark.each_value
@pytest.mark.parametrize("newton, nranks, comm", [("on", 1, "brick"), ("off", 1, "brick"), ("on", 2, "tiled"), ("off", 2, "brick"),
                                                  ("on", 3, "brick"), ("off", 3, "tiled")])
def test_block_torn_at_the_face(lmp, newton, nranks, comm):
    """a bonded, vibrating, compressed block flies through a corner: springs and contacts reach across all the time"""
    s = cube(4, 0.08, 0.6, cut=0.1, seed=4, types=2)
    s.x *= 0.97
    s.v += [8.0, 5.0, 3.0]
    s.box = np.array([[-5.0, 5.2], [-5.0, 5.4], [-4.0, 8.0]])
    result = lmp(fly(s, 600, newton=newton, comm=comm), nranks=nranks)
    book, thermo = books(result.thermo), result.thermo
    check(book, s, 1e-5)
    left = book["left_count"]
    assert left[0] == 0 and left[-1] > 40 and len(set(left)) > 10  # one by one
    assert np.array_equal(64 - thermo["Atoms"], left)
    assert np.array_equal(len(s.bonds) - thermo["Bonds"], book["bonds_broken"] + book["bonds_left"])
    assert book["bonds_left"][-1] > 50


@pytest.mark.each_value
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("kind", ["bonded", "contact", "both leave", "apart"])
def test_one_pair_by_hand(lmp, kind, newton, nranks):
    """what is booked is kinetic energy and what the pair still had, to the order of a step"""
    r = 1.35 if kind == "bonded" else 2.5 if kind == "apart" else 0.95
    bonded = kind in ("bonded", "both leave")
    direction = [0.0, 1.0, 0.0] if kind == "both leave" else [1.0, 0.0, 0.0]
    v, dt = np.array([3.0, 0.0, 0.0]), 1e-5
    s = State([np.array([4.9991, 0.0, 0.0]), np.array([4.9991, 0.0, 0.0]) - r * np.array(direction)], [v, v], [(0, 1)] if bonded else [],
              [[-5.0, 5.0]] * 3, types=[1, 2], masses=(1.0, 3.0))
    book = books(lmp(fly(s, 60, dt, newton=newton, every=5, processors="* 1 1", rebuild="every 1 check no"), nranks=nranks).thermo)
    two = kind == "both leave"
    assert book["left_count"][-1] == (2 if two else 1)
    kinetic = 0.5 * 9.0 * (4.0 if two else 1.0)
    inner = float(contact(r)[0]) + (float(spring(r)[0]) if bonded else 0.0)
    assert book["left"][-1] == pytest.approx(kinetic + inner, rel=2e-2 if inner else 1e-12)
    assert np.abs(book["ratio"] - 1).max() <= 1e-8
    assert momentum_error(book, s) <= 1e-13
    assert book["left_mass"][-1] == (4.0 if two else 1.0)
    assert book["bonds_left"][-1] == bonded and book["bonds_broken"][-1] == 0


@pytest.mark.parametrize("boundary", ["p f f", "f f p", "s f f", "m f s"])
def test_other_faces(lmp, boundary):
    """nobody leaves through periodic and shrink-wrapped faces; a pair that reaches across the one is torn at a fixed one"""
    x = np.array([[4.7, 0, 0], [-4.2 if boundary[0] == "p" else 3.6, 0, 0], [-3, 0, 0], [0, 0, 3.0], [2, 2, -3.0]])
    v = np.array([[0, 8.0, 0], [0, 0, 0.5], [-6, 0, 0], [0, 0, 6.0], [0, 0, -6.0]])
    s = State(x, v, [(0, 1)], [[-5.0, 5.0]] * 3)
    book = books(lmp(fly(s, 1800, 0.0005, boundary=boundary)).thermo)
    assert book["left_count"][-1] == 1 + sum(boundary[i] == "f" for i in (0, 4, 4))
    assert book["bonds_broken"][-1] + book["bonds_left"][-1] == 1
    check(book, s, 1e-5)


@pytest.mark.each_value
@pytest.mark.parametrize("newton, nranks, comm", [("on", 1, "brick"), ("on", 4, "brick"), ("off", 3, "tiled"), ("off", 4, "brick")])
def test_at_the_start(lmp, newton, nranks, comm):
    """particles moved out between runs leave at setup, with their bonds"""
    s = cube(3, 0.02, 0.1, margin=2.0)
    text = scene(s, "s.data", newton=newton, comm=comm) + "fix nve all nve\n" + ledger() + LOST + "run 0\n"
    text += "group g id 19:27\nset group g vx 1.0\ndisplace_atoms g move 0.3 0 0 units box\nrun 0\n"
    text += f"variable shifted atom x+xhi-{2.4 + R_EQ / 2}\nset group all x v_shifted\nrun 0\nrun 10\n"
    runs = [books(t) for t in lmp(text, nranks=nranks).runs]
    before, after = runs[1], runs[2]
    assert after["left_count"][0] == 9 and after["left_mass"][0] == 9.0
    assert after["total"][0] == pytest.approx(before["total"][0], rel=1e-12)
    assert after["bonds_left"][0] == 9 + 12  # to the next plane and within its own
    assert runs[3]["total"][-1] == pytest.approx(after["total"][0], rel=1e-5)


def test_lost_atoms_stop_by_default(lmp):
    """with thermo_modify lost error LAMMPS's own message ends the run"""
    s = State([[4.9, 0, 0], [3.7, 0, 0]], [[5.0, 0, 0]] * 2, [(0, 1)], [[-5.0, 5.0]] * 3)
    result = lmp(fly(s, 500).replace(LOST, ""), expect_fail=True)
    assert "Lost atoms" in result.error or "bond atoms" in result.error.lower()


def test_warned_once_per_time(lmp):
    """thermo_modify lost warn says how many left and when"""
    s = State([[4.9, 0, 0], [0, 0, 0]], [[5.0, 0, 0], [0, 0, 0]], [], [[-5.0, 5.0]] * 3)
    result = lmp(fly(s, 200).replace("lost ignore", "lost warn"), nranks=2)
    assert sum("1 particles left the box" in w for w in result.warnings) == 1


@pytest.mark.parametrize("newton", ["on", "off"])
def test_clamped_particles_may_leave(lmp, newton):
    """what clamps gave to a particle that is gone stays booked"""
    s = cube(3, 0.02, 0.2, seed=8, margin=1.0)
    text = scene(s, "s.data", newton=newton) + "group held id 10:18\n" + ledger("clamps held") + LOST
    text += "fix nve all nve\nfix a held addforce 9.0 0 0\ntimestep 0.0005\nrun 2500\n"
    book = books(lmp(text).thermo)
    assert book["left_count"][-1] >= 9 and book["jx"][-1] > 50
    p = book["px"] + book["left_px"] - book["jx"]
    assert np.abs(p - p[0]).max() <= 1e-11 * np.abs(book["jx"]).max()
    assert np.abs(book["total"] - book["total"][0]).max() <= 2e-5 * np.abs(book["clamps"]).max()


def test_pair_style_alone(lmp):
    """without bonds the leaving contacts are booked too"""
    s = cube(3, 0.05, 0.3, margin=1.0)
    s.bonds = s.bonds[:0]
    s.x *= 0.95
    s.v += [4.0, 0.0, 0.0]
    book = books(lmp(fly(s, 1200, bond="bond_style none\n")).thermo)
    check(book, s, 1e-5)
    assert book["left_count"][-1] > 20


PAIR_APART = [[4.9991, 0.0, 0.0], [4.9991 - 0.95, 0.0, 0.0]]


def pair_at_the_face(pair, more="", atoms="atom_style bond", commands="", newton="on", kinds=1):
    """a pair that flies through the face x = 5: its first particle leaves in the first steps"""
    text = f"units lj\n{atoms}\natom_modify map array\nnewton {newton}\nprocessors * 1 1\nboundary f f f\nregion box block -5 5 -5 5 -5 5\n"
    text += f"create_box {kinds} box\nspecial_bonds lj/coul 1 1 1\n" if "bond" not in atoms else (
        f"create_box {kinds} box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4\nspecial_bonds lj/coul 1 1 1\n")
    for x, y, z in PAIR_APART:
        text += f"create_atoms {kinds} single {x!r} {y} {z}\n"
    text += f"mass * 1.0\nvelocity all set 3.0 0 0\n{commands}{pair}neighbor 0.3 bin\nneigh_modify every 1 check no\n{more}fix nve all nve\n"
    text += "compute book all hvi/energy\nthermo 5\nthermo_style custom step atoms c_book[*]\n" + LOST + "timestep 1e-5\nrun 60\n"
    return text


SPH_BESIDE = "pair_style hybrid hvi/sph cubic hvi/contact\npair_coeff 1 1 hvi/sph eos tait 1 10 7 h 1.2\npair_coeff 2 2 hvi/contact 1 1\npair_coeff 1 2 none\n"


@pytest.mark.each_value
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("nranks", [1, 2])
def test_contact_beside_a_style_without_single(lmp, newton, nranks):
    """LAMMPS's hybrid has no single() then; the contact's energy leaves all the same"""
    result = lmp(pair_at_the_face(SPH_BESIDE, atoms="atom_style hybrid sph bond", newton=newton, kinds=2), nranks=nranks)
    book = books(result.thermo)
    assert book["left_count"][-1] == 1
    assert book["left"][-1] == pytest.approx(4.5 + float(contact(0.95)[0]), rel=2e-2)
    assert np.abs(book["ratio"] - 1).max() <= 1e-8
    assert not any("not booked" in w for w in result.warnings)


@pytest.mark.parametrize("style", ["hybrid", "hybrid/overlay", "hybrid/scaled"])
def test_contacts_of_a_hybrid_of_two(lmp, style):
    """each pair of types by its own law, scaled where LAMMPS scales; none between types that do not meet"""
    s = cube(4, 0.05, 0.3, margin=1.0, types=2, seed=3)
    s.bonds = s.bonds[:0]
    s.x *= 0.95
    s.v += [5.0, 0.0, 0.0]
    scale = ("1.0 ", "0.5 ") if "scaled" in style else ("", "")
    pair = f"pair_style {style} {scale[0]}hvi/contact {scale[1]}hvi/contact prefactor 4\npair_coeff 1 1 hvi/contact 1 1.0 1.0\n"
    pair += "pair_coeff 2 2 hvi/contact 2 1.0 1.0\npair_coeff 1 2 none\n"
    result = lmp(fly(s, 1200, pair=pair, bond="bond_style none\n"))
    book = books(result.thermo)
    check(book, s, 1e-5)
    assert book["left_count"][-1] > 40 and not any("not booked" in w for w in result.warnings)


@pytest.mark.parametrize("nranks", [1, 2])
def test_styles_that_read_data_of_particles(lmp, nranks):
    """whose energy types and distance do not tell: not booked, not made up, said once"""
    pair = "pair_style lj/cut/coul/cut 2.0\npair_coeff * * 1.0 1.0\n"
    more = "create_atoms 1 single 4.9985 3.0 0\nset group all charge 3.0\nvelocity all set 3.0 0 0\n"
    result = lmp(pair_at_the_face(pair, atoms="atom_style charge", commands=more), nranks=nranks)
    book = books(result.thermo)
    assert book["left_count"][-1] == 2
    assert book["left"][-1] == pytest.approx(2 * 4.5, rel=1e-2)  # kinetic alone; the pair has some 10 more
    assert sum("lj/cut/coul/cut between particles that leave" in w for w in result.warnings) == 1


def test_stock_style_that_knows_types_only(lmp):
    """lj/cut is asked through its single()"""
    result = lmp(pair_at_the_face("pair_style lj/cut 1.12\npair_coeff * * 1.0 1.0\npair_modify shift yes\n"))
    book = books(result.thermo)
    assert book["left_count"][-1] == 1 and book["left"][-1] > 4.5 + 0.5
    assert np.abs(book["ratio"] - 1).max() <= 1e-7
    assert not any("not booked" in w for w in result.warnings)


@pytest.mark.parametrize("nranks", [1, 3])
def test_triclinic_and_periodic(lmp, nranks):
    """who tears is found across periodic faces of a tilted box"""
    s = cube(4, 0.05, 0.3, seed=6)
    s.bonds = s.bonds[:0]
    s.x *= 0.95
    s.v += [6.0, 1.0, 0.0]
    s.box = np.array([[-3.0, 6.0], [1.0, 9.0], [1.5, 9.5]])
    s.x[:, 1:] += (s.x[:, 1:] < s.box[1:, 0]) * 8.0
    tilt = "change_box all triclinic xy final 2.0 yz final -1.5\n"
    text = fly(s, 1300, boundary="f p p", bond="bond_style none\n").replace("neighbor 0.3", tilt + "neighbor 0.3")
    book = books(lmp(text, nranks=nranks).thermo)
    check(book, s, 1e-5)
    assert book["left_count"][-1] > 40


@pytest.fixture(scope="module")
def traffic(root, tmp_path_factory):
    """LAMMPS that writes how many bytes each of its ranks got from all others at once"""
    compiler = shutil.which(os.environ.get("MPICC", "mpicc"))
    if not compiler:
        pytest.fail("no mpicc: set MPICC", pytrace=False)
    folder = tmp_path_factory.mktemp("traffic")
    subprocess.run([compiler, "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", str(root / "tests" / "components" / "traffic.c"), "-o",
                    str(folder / "traffic.so")], check=True)

    def run(lmp, lmp_exe, text, nranks):
        script = folder / "lmp"
        script.write_text(f'#!/bin/sh\nexport ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0"\nLD_PRELOAD={folder}/traffic.so exec {lmp_exe} "$@"\n')
        script.chmod(0o755)
        result = lmp(text, nranks=nranks, exe=script)
        return result, [int((result.cwd / f"traffic.{k}").read_text()) for k in range(nranks)]

    return run


def test_nobody_is_told_where_nothing_can_tear(lmp, lmp_exe, traffic):
    """SPH alone: energy goes with its particles"""
    pair = "pair_style hvi/sph cubic\npair_coeff * * eos tait 1 10 7 h 1.2\n"
    result, got = traffic(lmp, lmp_exe, pair_at_the_face(pair, atoms="atom_style sph", commands="set group all sph/rho 1.0\n"), 3)
    assert books(result.thermo)["left_count"][-1] == 1 and got == [0, 0, 0]


@pytest.mark.parametrize("bonded", [True, False])
def test_who_is_near_is_told(lmp, lmp_exe, traffic, bonded):
    """a row along y, one particle of each rank near the face; that of rank 0 leaves, and tears something apart on rank 1"""
    x = np.array([[4.9991, 7.3, 0], [4.9, 8.2, 0], [4.9, 20.0, 0], [4.9, 28.0, 0]])
    s = State(x, [[3.0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]], [[0, 1]] if bonded else [], [[-5, 5], [0, 31], [-5, 5]])
    text = fly(s, 60, 1e-5, every=5, processors="1 * 1", rebuild="every 1 check no", **({} if bonded else {"bond": "bond_style none\n"}))
    result, got = traffic(lmp, lmp_exe, text, 4)
    book = books(result.thermo)
    assert book["left_count"][-1] == 1 and book["bonds_left"][-1] == bonded
    assert book["left"][-1] > 4.6 and np.abs(book["ratio"] - 1).max() <= 1e-8
    assert max(got[2:]) < 64 <= min(got[:2])  # bytes of a leaver


@pytest.mark.parametrize("newton, nranks", [("on", 1), *(pytest.param(*more, marks=pytest.mark.long) for more in (("off", 1), ("on", 2))), ("off", 3)])
def test_bonds_that_are_turned_off(lmp, newton, nranks):
    """go with their particles as the others, and without energy"""
    s = cube(4, 0.0, 0.0)
    s.v[:, 2] = 4.0
    s.box = np.array([[-4.0, 10.0], [-4.0, 10.0], [-4.0, 4.6]])
    text = fly(s, 500, newton=newton)
    on, off = (lmp(text.replace("timestep", command + "timestep"), nranks=nranks).thermo for command in ("", "delete_bonds all bond 1\n"))
    assert off["Bonds"][0] == 144 and 0 < off["Bonds"][-1] < 100 and np.array_equal(off["Bonds"], on["Bonds"])
    assert np.array_equal(off["Bonds"] + books(off)["bonds_left"], np.full(len(off["Bonds"]), 144.0)) and books(off)["ratio"] == pytest.approx(1.0, abs=1e-12)
