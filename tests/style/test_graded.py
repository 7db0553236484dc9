"""A wall of two parts, fine in its middle and twice as coarse around it (core_mm): one body to forces and to what hangs together."""

import re

import hvi
import numpy as np
import pytest
from hvi.analysis import hole
from hvi.errors import HVIError
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

A, HALF, THICK, RADIUS = 3e-4, 3.6e-3, 1.2e-3, 9e-3  # spacing of the core, its half side, thickness and radius of the wall

HEAD = """
units si
atom_style sph
atom_modify map array sort 0 0.0
boundary f f f
region box block -1e-2 1e-2 -1e-2 1e-2 -4e-3 4e-3 units box
create_box 2 box
"""
FINE = f"lattice sc {A} origin 0.5 0.5 0.5\n"
COARSE = f"lattice sc {2 * A} origin 0.5 0.5 0.5\n"
REGIONS = f"""
region disc cylinder z 0 0 {RADIUS} 0 {THICK} units box
region core block -{HALF} {HALF} -{HALF} {HALF} 0 {THICK} units box
region around block -{HALF} {HALF} -{HALF} {HALF} 0 {THICK} units box side out
region rim intersect 2 disc around
"""
GRADED = FINE + REGIONS + "create_atoms 1 region core\n" + COARSE + "create_atoms 2 region rim\n"
UNIFORM = FINE + REGIONS + "create_atoms 1 region core\ncreate_atoms 2 region rim\n"
STYLE = f"""
pair_style hvi/sph cubic dissipation riemann
pair_coeff 1 1 file Al6061-T6.hvi spacing {A}
pair_coeff 2 2 file Al6061-T6.hvi spacing {{coarse}}
pair_coeff 1 2 tension yes
"""
FIXES = """
fix move all hvi/sph
fix solid all hvi/johnson-cook damage no spall voids
compute book all hvi/energy
compute rho all property/atom rho
"""


@pytest.fixture
def run(lmp, root, tmp_path):
    def run(text, nranks=1, **kw):
        return lmp(text, nranks=nranks, cwd=tmp_path, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)

    return run


def plate(cells, coarse):
    return HEAD + cells + STYLE.format(coarse=coarse)


def test_the_two_parts_fill_the_wall(run):
    """cells of the core and of the outer part meet face to face: the mass is that of the wall, but for its round edge"""
    r = run(plate(GRADED, 2 * A) + FIXES + f"compute w all hvi/wall axis z wall 1 0 {THICK} outer 2 layers 4 radius {RADIUS} pieces 1.25 h\nrun 0\nprint 'w $(c_w[1][16]:%.15g) $(c_w[1][34]:%.15g) $(c_w[1][35])'\n")
    mass, body, hole = map(float, re.search(r"^w (.*)", r.log, re.M)[1].split())
    core = 4 * HALF**2 * THICK
    assert mass == pytest.approx(body, rel=1e-12) and hole == 0
    fine = core / A**3
    coarse = (mass / 2703 - core) / (8 * A**3)
    assert abs(coarse - round(coarse)) < 1e-6 and mass / 2703 == pytest.approx(np.pi * RADIUS**2 * THICK, rel=0.02) and round(fine) == 2304


@pytest.mark.parametrize("nranks", [1, 2])
def test_a_linear_velocity_is_seen_exactly(run, tmp_path, nranks):
    """density of every particle after a step, at the seam and at free faces, too: that of the velocity gradient"""
    L = np.array([[2e3, -1e3, 5e2], [3e3, 1e3, -2e3], [1e3, 4e3, 1.5e3]])
    rows = "\n".join(f"variable v{c} atom {'+'.join(f'({L[k, j]}*{d})' for j, d in enumerate('xyz'))}" for k, c in enumerate("xyz"))
    run(plate(GRADED, 2 * A) + rows + "\nvelocity all set v_vx v_vy v_vz\n" + FIXES + "timestep 1e-10\nrun 1\nwrite_dump all custom end.dump id type mass x y z vx vy vz c_rho modify format float %.17g sort id\n", nranks)
    frame = hvi.Dump(str(tmp_path / "end.dump"), units="si", mirror="none")[0]
    change = frame["c_rho"] / 2703 - 1
    assert set(frame["type"].astype(int)) == {1, 2} and np.abs(change / (-1e-10 * np.trace(L)) - 1).max() < 1e-5


def test_it_bends_as_a_uniform_one(run, tmp_path):
    """the middle of a plate that is struck softly, over time: that of a plate of fine particles everywhere. Seam and outer part have three quarters of the bent zone"""
    said = {}
    for name, cells, coarse in (("graded", GRADED, 2 * A), ("uniform", UNIFORM, A)):
        text = plate(cells, coarse) + "variable vz atom 30*exp(-(x^2+y^2)/(2*2.5e-3^2))\nvelocity all set NULL NULL v_vz\n" + FIXES + f"""
fix step all hvi/dt 0.5
region middle cylinder z 0 0 {2 * A} INF INF units box
group middle region middle
compute at middle com
thermo 20
thermo_style custom step c_book[9]
variable us equal 1e6*f_step[2]
fix at all print 10 "at ${{us}} $(c_at[3]-0.5*{THICK})" screen no file at.{name}
run 200 post no
"""
        run(text)
        said[name] = np.array([line.split()[1:] for line in (tmp_path / f"at.{name}").read_text().splitlines() if line.startswith("at")], dtype=float)
    us = said["uniform"][:, 0]
    graded = np.interp(us, said["graded"][:, 0], said["graded"][:, 1])
    assert np.abs(graded - said["uniform"][:, 1]).max() < 0.03 * np.abs(said["uniform"][:, 1]).max()


@pytest.mark.parametrize("radius", [*(pytest.param(more, marks=pytest.mark.long) for more in (0.6e-3, 0.9e-3)), 0.75e-3, 2.4e-3])
def test_a_hole_in_the_core_is_that_of_a_fine_wall(run, tmp_path, radius):
    """the outer part does not hide narrow holes, and has none of its own: diameters of both, and those of another program"""
    found = {}
    for name, cells, coarse in (("graded", GRADED, 2 * A), ("uniform", UNIFORM, A)):
        cut = f"region hole cylinder z 0 0 {radius} INF INF units box\ndelete_atoms region hole compress no\n"
        r = run(plate(cells, coarse) + cut + FIXES + f"compute w all hvi/wall axis z wall 1 0 {THICK} outer 2 layers 4 radius {RADIUS} pieces 1.25 h\nrun 0\n"
                "print 'w $(c_w[1][35]) $(c_w[1][36]:%.15g) $(c_w[1][40]:%.15g)'\nwrite_dump all custom end.dump id type mass x y z modify format float %.17g\n", nranks=2 if name == "graded" else 1)
        found[name] = np.array(re.search(r"^w (.*)", r.log, re.M)[1].split(), dtype=float)
        frame = hvi.Dump(str(tmp_path / "end.dump"), units="si", mirror="none")[0]
        other = hole.measure(frame, "z", (0, 0), 0.5 * THICK, thickness=1.0)
        assert other.values["diameter"] == pytest.approx(found[name][1], rel=1e-9)
    assert found["uniform"][0] == found["graded"][0] == 1 and found["uniform"][1] > 0
    assert found["graded"][1:] == pytest.approx(found["uniform"][1:], rel=0.05)


def test_strain_of_the_outer_part(run):
    """by hand: all of it strained, wherever the wall stands; layers are those of the core"""
    first = None
    for front in (0.0, 8e-3, 12.34e-3):
        text = plate(GRADED, 2 * A) + f"displace_atoms all move 0 0 {front} units box\n" + FIXES + f"compute w all hvi/wall axis z wall 1 {front} {THICK} outer 2 layers 4 radius {RADIUS}\n"
        text = text.replace("-4e-3 4e-3 units box", "-4e-3 16e-3 units box")
        r = run(text + "group outer type 2\nvelocity outer set 0 0 0\nvariable vx atom 200*x/1e-3*(type==2)\nvelocity all set v_vx NULL NULL\ntimestep 1e-8\nrun 20 post no\nprint 'w $(c_w[1][12]:%.6g) $(c_w[1][43]:%.6g)'\n")
        rear, outer = map(float, re.search(r"^w (.*)", r.log, re.M)[1].split())
        assert 0 < outer <= rear, front
        first = first or (rear, outer)
        assert (rear, outer) == pytest.approx(first, rel=1e-3), front


@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (3, "off")])
def test_what_hangs_together_in_smoothing_lengths(run, tmp_path, nranks, newton):
    """particles at random, two smoothing lengths: those closer than 1.1 times the mean of the two"""
    rng = np.random.default_rng(7)
    x, kind, h = rng.uniform(-3e-3, 3e-3, (400, 3)), rng.integers(1, 3, 400), {1: 3.6e-4, 2: 7.2e-4}
    atoms = "".join(f"create_atoms {k} single {' '.join(f'{c:.17g}' for c in at)} units box\n" for k, at in zip(kind, x))
    style = STYLE.format(coarse=2 * A).replace("pair_coeff 1 2 tension yes", "")
    text = HEAD.replace("boundary", f"newton {newton}\nboundary") + atoms + style + "comm_modify vel no\n" + FIXES
    run(text + "compute f all hvi/fragment/atom distance 1.1 h\ncompute n all hvi/fragment distance 1.1 h\nrun 0\nprint 'n $(c_n[1])'\nwrite_dump all custom end.dump id type mass x y z vx vy vz c_f modify sort id format float %.17g\n", nranks)
    frame = hvi.Dump(str(tmp_path / "end.dump"), units="si", mirror="none")[0]
    pairs = cKDTree(frame.x).query_pairs(1.1 * 7.2e-4, output_type="ndarray")
    i, j = pairs.T
    size = np.array([h[int(k)] for k in frame["type"]])
    near = np.linalg.norm(frame.x[i] - frame.x[j], axis=1) < 0.55 * (size[i] + size[j])
    number, label = connected_components(coo_matrix((np.ones(near.sum()), (i[near], j[near])), shape=(len(size),) * 2), directed=False)
    lowest = np.array([frame.ids[label == k].min() for k in range(number)])
    assert 20 < number < 390 and not near.all() and np.array_equal(frame["c_f"].astype(int), lowest[label])
    assert np.array_equal(hvi.find(frame, distance=1.1, sizes=size).label, lowest[label])
    with pytest.raises(HVIError, match="sizes go with a distance"):
        hvi.find(frame, column="c_f", sizes=size)


def test_smoothing_lengths_need_the_pair_style(lmp, tmp_path):
    r = lmp("units lj\natom_style atomic\nregion b block 0 4 0 4 0 4\ncreate_box 1 b\nlattice sc 1\ncreate_atoms 1 box\nmass 1 1\npair_style lj/cut 1.5\npair_coeff 1 1 1 1\ncompute f all hvi/fragment distance 1.25 h\nrun 0\n",
            cwd=tmp_path, expect_fail=True)
    assert "distance R h needs pair style hvi/sph" in r.error


def test_types_without_smoothing_length_are_refused(run):
    """particles of another pair style would never hang together"""
    text = plate(GRADED, 2 * A)
    text = text[:text.index("pair_style")] + f"""pair_style hybrid hvi/sph cubic dissipation riemann lj/cut 1e-3
pair_coeff 1 1 hvi/sph file Al6061-T6.hvi spacing {A}
pair_coeff 2 2 lj/cut 1e-20 3e-4
pair_coeff 1 2 none
mass 2 1e-6
fix move all hvi/sph
compute f all hvi/fragment distance 1.25 h
run 0
"""
    r = run(text, expect_fail=True)
    assert "has particles of type 2, which pair style hvi/sph has no smoothing length for" in r.error, r
