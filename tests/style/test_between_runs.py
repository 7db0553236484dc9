"""What commands between runs, restarts and other fixes once made wrong without a word, in solids, liquids, discrete elements and their books."""

import re

import numpy as np
import pytest
import solid_scenes
from dumps import read_dump
from scenes import books

MATERIAL = solid_scenes.MATERIAL.format(sigma_p=3.0)
HEAD = """units lj
boundary p p {z}
atom_style sph
lattice sc 1.0
region box block 0 {a} 0 {a} 0 40
create_box 2 box
region upper block 0 {a} 0 {a} {upper}
region lower block {lower}
create_atoms 1 region upper
create_atoms 2 region lower
pair_style hvi/sph cubic
pair_coeff * * file m.hvi spacing 1.0
group upper type 1
group lower type 2
"""
MOVE = "fix sph all hvi/sph\nfix jc all hvi/johnson-cook spall none damage no\n"
STATE = "compute S all hvi/atom eps vm\ndump d all custom 1 {0} id c_S[1] c_S[2]\ndump_modify d sort id format float %.12g\n"


@pytest.fixture
def blocks(tmp_path):
    """blocks(upper, lower, ...) -> input up to pair_coeff, of two blocks of one material"""
    (tmp_path / "m.hvi").write_text(MATERIAL)
    return lambda upper="10 16", lower="0 4 0 4 4 8", a=4, z="f": HEAD.format(upper=upper, lower=lower, a=a, z=z)


# ---------------------------------------------------------------------- restarts
@pytest.mark.parametrize("nranks, command", [(1, "delete_atoms group lower compress no"), (2, "balance 1.0 shift z 20 1.0")])
def test_order_of_particles_since_read_restart(lmp, blocks, nranks, command):
    """records of the file go to particles by their place on a rank: a command that changes it, before the fix, is told"""
    lmp(blocks(lower="1 3 1 3 5 9") + MOVE + "velocity lower set 0 0 2.0\ntimestep 0.02\nrun 100\n" + STATE.format("one") + "write_restart half\nrun 0\n")
    one, eps = read_dump("one", sort=True), {}
    assert (one["c_S[1]"] > 0.1).sum() > 20
    for order, text in (("after", MOVE + command), ("before", command + "\n" + MOVE)):
        text = "processors 1 1 *\nread_restart half\ngroup lower type 2\n" + text + "\n" + STATE.format(order) + "run 0\n"
        r = lmp(text, nranks=nranks, expect_fail=None)
        if r.returncode or order == "before":
            break
        eps[order] = read_dump(order, sort=True)
        kept = np.isin(one["id"], eps[order]["id"])
        np.testing.assert_array_equal(one["c_S[1]"][kept], eps[order]["c_S[1]"])
    said = r.error if r.returncode else " ".join(r.warnings)
    assert eps and ("another order than the numbers that the file has" in said or "make LAMMPS forget what the file has" in said)


@pytest.mark.parametrize("order", ["before", "after"])
def test_timestep_since_read_restart(lmp, blocks, order):
    """holds, wherever fix hvi/dt stands"""
    lmp(blocks() + MOVE + "fix step all hvi/dt 0.2\nrun 5\nwrite_restart half\n")
    words = {"before": "timestep 1e-3\n{}", "after": "{}timestep 1e-3\n"}[order].format("fix step all hvi/dt 0.2\n")
    steps = lmp("read_restart half\n" + MOVE + words + "thermo_style custom step dt\nthermo 1\nrun 2\n").thermo["Dt"]
    assert steps[0] == pytest.approx(1e-3) and steps.max() < 2e-3


# ---------------------------------------------------------------------- what moves particles
@pytest.mark.parametrize("fix", ["deform 1 x final 0 4.4 remap x", "press/berendsen iso 0 0 1.0"])
def test_a_box_that_takes_particles_along(lmp, blocks, fix):
    assert "it may move particles with the box" in lmp(blocks(z="p") + MOVE + f"timestep 0.02\nfix box all {fix}\nrun 1\n", expect_fail=True).error


def test_a_box_that_grows_around_particles(lmp, blocks):
    r = lmp(blocks(z="p") + MOVE + "timestep 0.02\nfix box all deform 1 z final 0 44 remap none\nthermo_style custom step vol\nrun 10\n")
    assert r.thermo["Volume"][-1] == pytest.approx(1.1 * r.thermo["Volume"][0])


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("words", ["lists relative", "lists displacement"])
def test_where_particles_are_between_runs(lmp, blocks, words, nranks):
    """in the periodic box, also those of a cloud in flight, whose lists are good for long"""
    text = blocks(upper="28 36", lower="0 1 0 1 30 31", z="p").replace("create_atoms 2", "# create_atoms 2")
    r = lmp(text.replace("pair_coeff * *", "pair_coeff 1 1").replace("create_box 2", "create_box 1").replace("group lower", "# group lower") + f"fix sph all hvi/sph {words}\nfix jc all hvi/johnson-cook spall none damage no\n"
            "velocity all set 0 0 1.0\ntimestep 0.05\nrun 260\nregion low block INF INF INF INF 0 10\nvariable n equal count(all,low)\nprint \"there: $(v_n)\"\n", nranks=nranks)
    assert int(re.search(r"^there: (\d+)", r.log, re.M)[1]) == 16 * 9


@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("stop", ["fix stop all halt 1 v_late > 0.5 error continue"])
def test_where_particles_are_after_a_run_that_is_stopped(lmp, stop, nranks):
    """in the periodic box; what goes on from there, without a setup, is the run that was not stopped"""
    text = "processors * * 1\n" + GRAINS
    for old, new in (("boundary p p f", "boundary p p p"), ("hvi/contact", "hvi/contact lists relative"),
                     ("block 0 4 0 4 0 20", "block 0 8 0 8 0 10"), ("block 0 4 0 4 2 8", "block 2 6 2 6 0 8.1"),
                     ("set 0 0 -0.5", "set 0 0 50\nvelocity all ramp vx 1 -1 x 2 6 sum yes"), ("0.005", "0.01")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    text += "fix nve all nve\nthermo_style custom step ke\nthermo_modify norm no format float %.15g\nvariable late equal step>=28\n"
    r = lmp(text + stop + "\nrun 100000000\ntimer timeout off\nregion whole block 0 8 0 8 0 10\ngroup g region whole\n"
            "print \"there: $(count(g)) of $(atoms)\"\n" + ("unfix stop\n" if "halt" in stop else "") + "run 50 pre no\n", nranks=nranks)
    assert re.search(r"^there: 225 of 225", r.log, re.M), re.search("^there: .*", r.log, re.M)
    if "halt" in stop:
        r = r.thermo, lmp(text + f"run {int(r.thermo['Step'][-1])}\n", nranks=nranks).thermo
        assert r[0]["KinEng"][-1] == pytest.approx(r[1]["KinEng"][-1], rel=1e-9) and abs(r[1]["KinEng"][-1] - r[1]["KinEng"][0]) > 1e-3


def test_a_piston_that_is_let_go(lmp, blocks):
    """stands still, so pushes no more, whatever velocity fix move has left it"""
    text = blocks(upper="10 16", lower="0 6 0 6 6 9", a=6) + "compute book all hvi/energy\nfix sph upper hvi/sph walls lower\nfix jc all hvi/johnson-cook spall none damage no\nfix mv lower move linear NULL NULL 0.2\n" \
        "timestep 0.02\ncompute v upper reduce ave vz\nthermo 100\nthermo_style custom step c_v c_book[8]\nrun 100\nunfix mv\n"
    kept, halted = (lmp(text + stop + "run 400\n").thermo for stop in ("", "velocity lower set 0 0 0\n"))
    assert halted["c_v"][-1] > 0.2 and kept["c_v"][-1] == pytest.approx(halted["c_v"][-1], rel=1e-9)
    for one in (kept, halted):
        assert one["c_book[8]"][-4:] == pytest.approx(one["c_book[8]"][-5], rel=1e-3)


@pytest.mark.parametrize("nranks", [1, 2])
def test_bodies_that_become_one_type(lmp, blocks, nranks):
    """stay two bodies, with the same forces; what has failed would be rubble of one type"""
    text = blocks(upper="9 15").replace("hvi/sph cubic", "hvi/sph cubic dissipation riemann") + MOVE + "velocity upper set 0 0 -2\ntimestep 0.02\nrun 20\n"
    found = []
    for command in ("", "set group upper type 2\n"):
        lmp(text + command + STATE.format("out") + "run 20\n", nranks=nranks)
        found.append(read_dump("out", sort=True))
    assert found[0]["c_S[2]"].max() > 0.1
    for name, values in found[0].items():
        assert found[1][name] == pytest.approx(values, abs=1e-10), name


@pytest.mark.parametrize("command", ["", "velocity far set 0 0 0.1\n"])
def test_forces_after_particles_have_come_back(lmp, blocks, command):
    """are those of the last run's step, not of that in which these were integrated last"""
    text = blocks(upper="9 15").replace("hvi/sph cubic", "hvi/sph cubic dissipation riemann") + "region far block INF INF INF INF 30 32\ncreate_atoms 1 region far\ngroup far region far\n"
    text += "group near subtract all far\ngroup moves union all\n" + MOVE.replace("sph all", "sph moves") + "velocity upper set 0 0 -2\nvelocity far set 0 0 0\ntimestep 0.1\nrun 1\ngroup moves clear\ngroup moves union near\ntimestep 0.001\nrun 200\n"
    dump = "write_dump near custom {} id fx fy fz modify sort id format float %.17g\n"
    lmp(text + dump.format("end") + "group moves union near far\n" + command + "run 0\n" + dump.format("begin"))
    end, begin = (np.array([read_dump(name)[f] for f in ("fx", "fy", "fz")]) for name in ("end", "begin"))
    assert np.abs(end).max() > 0.1 and begin == pytest.approx(end, abs=1e-11 * np.abs(end).max())


# ---------------------------------------------------------------------- fixes and materials given again
@pytest.mark.parametrize("again", [False, True])
def test_fix_given_anew(lmp, blocks, again):
    """has lost what it kept of particles, and says so"""
    r = lmp(blocks() + MOVE + "timestep 0.02\nrun 2\n" + ("unfix sph\nfix sph all hvi/sph\n" if again else "") + "run 2\n")
    assert any("Fix hvi/sph is given anew" in text for text in r.warnings) == again


@pytest.mark.parametrize("rho0", [1.0, 3.0])
def test_material_given_anew(lmp, blocks, tmp_path, rho0):
    """masses go by it, densities do not"""
    text = blocks() + MOVE + "timestep 0.02\nrun 0\n"
    (tmp_path / "other.hvi").write_text(MATERIAL.replace("rho0 1.0", f"rho0 {rho0}"))
    r = lmp(text + "pair_coeff 1 1 file other.hvi spacing 1.0\nrun 0\n")
    assert any("type 1 had a material of density 1 at rest in the last run" in text for text in r.warnings) == (rho0 == 3.0)
    r = lmp(text + f"pair_coeff 1 1 file other.hvi spacing 1.0\nset type 1 sph/rho {rho0}\nrun 0\n")
    assert not any("at rest in the last run" in text for text in r.warnings)


def test_solid_without_a_density_at_rest(lmp, blocks, tmp_path):
    """has no limits that are made of it"""
    text = blocks()
    (tmp_path / "m.hvi").write_text(re.sub(r"eos gruneisen.*?(?=strength)", "eos idealgas\n  gamma 1.4\n", MATERIAL, count=1, flags=re.S))
    assert "without a density at rest (rho0)" in lmp(text.replace("spacing 1.0", "h 1.2") + "mass * 1.0\nset group all sph/rho 1.0\n" + MOVE + "run 0\n", expect_fail=True).error


@pytest.mark.parametrize("comes", [False, True])
def test_liquids_that_come_later(lmp, blocks, tmp_path, comes):
    """a type without particles whose material has no strength: a warning where fix deposit may bring some"""
    text = blocks().replace("create_atoms 2", "# create_atoms 2").replace("pair_coeff * * file m.hvi", "pair_coeff 1 1 file m.hvi spacing 1.0\npair_coeff 2 2 file w.hvi")
    (tmp_path / "w.hvi").write_text(MATERIAL[:MATERIAL.index("strength")])
    r = lmp(text + MOVE + "timestep 0.02\n" + "fix come all deposit 1 2 100 123 region lower units box\n" * comes + "run 1\n")
    assert any("material w.hvi (type 2) has no section strength" in text for text in r.warnings) == comes


# ---------------------------------------------------------------------- neighbors and books
@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "on"), (3, "off")])
@pytest.mark.parametrize("exclude, force", [("", True), ("neigh_modify exclude type 1 1\n", False), ("neigh_modify exclude group all all\n", False), ("neigh_modify exclude type 1 2\n", True)])
def test_excluded_images(lmp, exclude, force, nranks, newton):
    """a particle beside a mirror plane and its image do what two particles do"""
    text = f"newton {newton}\n" + "units lj\nboundary f p p\natom_style sph\nregion box block -20 20 0 20 0 20\ncreate_box 2 box\ncreate_atoms 1 single 0.4 10 10\n{}pair_style hvi/sph cubic {}\npair_coeff * * eos tait 1.0 4.0 7 h 1.2\nmass * 1.0\n" \
        "set group all sph/rho 1.1\nneighbor 0.5 bin\n" + exclude + "fix sph all hvi/sph\ncompute f all reduce max fx\nthermo_style custom step c_f\nthermo_modify format float %.15g\nrun 0\n"
    whole, half = (lmp(text.format(*words), nranks=nranks).thermo["c_f"][0] for words in (("create_atoms 1 single -0.4 10 10\n", ""), ("", "mirror x 0 lo")))
    assert half == pytest.approx(whole, rel=1e-12) and (whole > 0.1) == force


GRAINS = """units lj
boundary p p f
atom_style bond
lattice sc 1.0
region box block 0 4 0 4 0 20
region b block 0 4 0 4 2 8
create_box 1 box
create_atoms 1 region b
mass 1 1.0
pair_style hvi/contact
pair_coeff * * 1.0 0.890898718
velocity all set 0 0 -0.5
timestep 0.005
"""


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("first", ["wall", "compute"])
def test_clamps_and_a_wall_that_reflects(lmp, first, nranks):
    """its work is booked, whichever is defined first"""
    wall, book = "fix w all wall/reflect zlo 1.0\n", "compute book all hvi/energy clamps all\n"
    r = lmp(GRAINS + "fix nve all nve\n" + (wall + book if first == "wall" else book + wall) + "thermo_style custom step c_book[7] c_book[9]\nthermo 100\nrun 1000\n", nranks=nranks)
    assert np.ptp(r.thermo["c_book[7]"]) > 1e-3 and r.thermo["c_book[9]"] == pytest.approx(1.0, abs=1e-3)


def test_clamps_of_a_dynamic_group(lmp):
    text = GRAINS + "region zone block -9 99 -9 99 12 20\ngroup zone dynamic all region zone every 1\ncompute book all hvi/energy clamps zone\nfix nve all nve\nrun 1\n"
    assert "group zone is dynamic" in lmp(text, expect_fail=True).error


@pytest.mark.parametrize("nranks, newton", [(1, "on"), pytest.param(2, "on", marks=pytest.mark.long), (3, "off")])
def test_what_other_fixes_take_out_of_clamped_groups(lmp, nranks, newton):
    """is no work of clamps, and shows in the total; what clamps have done to it until then stays booked"""
    text = GRAINS.replace("boundary p p f", "boundary p p p").replace("sc 1.0", "sc 0.1").replace("set 0 0 -0.5", "set 0.3 0 1 units box")
    text = f"newton {newton}\n{text}compute book all hvi/energy clamps all\nfix nve all nve\n{{}}region whole block INF INF INF INF INF INF\n" \
        "fix take all evaporate 5 2 whole 123\nthermo_style custom step atoms c_book[*]\nthermo_modify norm no format float %.17g\nthermo 5\nrun 30\n"
    r = lmp(text.format(""), nranks=nranks)
    book, n = books(r.thermo), r.thermo["Atoms"]
    assert n[0] - n[-1] == 12 and any("of the energy has gone" in w for w in r.warnings)
    assert book["ratio"] == pytest.approx(n / n[0], rel=1e-9)
    assert all(np.abs(book[name]).max() < 1e-9 for name in ("clamps", "jx", "jz"))

    # a force of 1; particles go after the first half of each fifth kick

    book = books(lmp(text.format("fix push all addforce 0 0 1\n"), nranks=nranks).thermo)
    t = 1 + 0.005 * np.arange(0, 30, 5)  # velocity at the start of each five steps
    kicks = [(n[:-1], t, t + 4.5 * 0.005), (n[1:], t + 4.5 * 0.005, t + 5 * 0.005)]
    assert np.diff(book["jz"]) == pytest.approx(sum(m * (b - a) for m, a, b in kicks), rel=1e-9)
    assert np.diff(book["clamps"]) == pytest.approx(-sum(m * (b * b - a * a) / 2 for m, a, b in kicks), rel=1e-9)


@pytest.mark.each_value
@pytest.mark.parametrize("fix, said", [("HVI_LEDGER all hvi/ledger", "Fix hvi/ledger is made by the styles that need it"), ("HVI_STORE all hvi/store", "Fix hvi/store is made by pair style hvi/sph")])
@pytest.mark.parametrize("begin", ["", "compute book all hvi/energy\nfix nve all nve\nrun 5\n"])
def test_fixes_that_styles_make(lmp, fix, said, begin):
    """an input cannot give them, nor empty the books by it"""
    assert said in lmp(GRAINS + begin + f"fix {fix}\nrun 1\n", expect_fail=True).error


# ---------------------------------------------------------------------- bonded molecules
EDGES = [(i, i | 1 << k) for i in range(8) for k in range(3) if not i >> k & 1]
CUBE = "cube\n\n8 atoms\n12 bonds\n\nCoords\n\n" + "".join(f"{k + 1} {k >> 2} {k >> 1 & 1} {k & 1}\n" for k in range(8)) \
    + "\nTypes\n\n" + "".join(f"{k + 1} 1\n" for k in range(8)) + "\nBonds\n\n" + "".join(f"{n + 1} 1 {i + 1} {j + 1}\n" for n, (i, j) in enumerate(EDGES))
MOLECULES = """units lj
newton {newton}
atom_style bond
lattice sc 1.0
region box block 0 32 0 32 0 40
region plate block 0 {edge} 0 {edge} 0 {edge}/2
boundary f f f
create_box 2 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 30
create_atoms 2 region plate
group gone id 1:4
delete_atoms group gone compress no
mass * 1.0
"""
LAWS = """pair_style hvi/contact
pair_coeff * * 0.1 0.890898718
special_bonds lj/coul 1 1 1
bond_style hvi/spring
bond_coeff 1 4.0 1.0 1.34
molecule cube cube.mol
fix move all nve
timestep 0.001
compute pieces all hvi/fragment bonds
thermo_style custom step atoms bonds c_pieces[1]
"""
DROP = "region top block 5 25 5 25 20 30\n" \
    "fix drop all deposit 2 0 2 4242 region top mol cube near 2.0 vz -2 -2 vx 0 0 vy 0 0 units box\nrun 4\nunfix drop\n"


@pytest.mark.parametrize("nranks, newton, edge", [(1, "on", 31.9), *(pytest.param(*more, marks=pytest.mark.long) for more in ((1, "off", 5.9), (2, "on", 5.9))), (3, "off", 5.9)])
def test_molecules_that_come(lmp, tmp_path, nranks, newton, edge):
    """bonded cubes, by fix deposit in a run, by a command after it, and after a restart

    The first scene fills the arrays of particles, so that a row that is too short ends it.
    """
    (tmp_path / "cube.mol").write_text(CUBE)
    head = MOLECULES.format(newton=newton, edge=edge).replace("31.9/2", "15.9").replace("5.9/2", "2.9")
    r = lmp(head + LAWS + DROP + "create_atoms 0 single 15 15 35 mol cube 123\nrun 2\nwrite_restart half\n", nranks=nranks)
    plate = r.runs[0]["Atoms"][0]
    assert [(t["Atoms"][-1] - plate, t["Bonds"][-1], t["c_pieces[1]"][-1] - plate) for t in r.runs] == [(16, 24, 2), (24, 36, 3)]
    r = lmp("read_restart half\n" + LAWS + "create_atoms 0 single 15 15 38 mol cube 123\nrun 2\n", nranks=nranks)
    assert r.thermo["Bonds"][-1] == 48 and r.thermo["c_pieces[1]"][-1] == plate + 4


BALL = """units lj
newton {newton}
atom_style bond
lattice sc 1.0
region box block -10 10 -10 10 -10 10
region ball sphere 0 0 -5.5 3
region plate block -6 6 -6 6 0 2.5
boundary f f f
create_box 2 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 30
create_atoms 1 region ball
create_atoms 2 region plate
mass * 1.0
pair_style hvi/contact
pair_coeff * * 0.1 0.890898718
special_bonds lj/coul 0 1 1
create_bonds many all all 1 0.0 1.1
special_bonds lj/coul 1 1 1
bond_style hvi/spring
bond_coeff 1 4.0 1.0 1.34
thermo_modify lost ignore
group ball type 1
velocity ball set 0.1 0.05 5
fix move all nve
fix step all hvi/dt 0.1
"""
FREE = BALL.replace("{newton}", "on")


@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "off"), pytest.param(3, "on", marks=pytest.mark.long)])
def test_molecules_by_bonds_that_are_left(lmp, nranks, newton):
    """reset_atoms mol after a run in which bonds break: as compute hvi/fragment/atom; a plate that was cut hangs together no more"""
    text = BALL.format(newton=newton) + "run 350\n{}reset_atoms mol all single yes\ncompute piece all hvi/fragment/atom bonds\nrun 0\n" \
        "write_dump all custom now id mol c_piece\n"
    cut = "region half block 0 INF INF INF -0.5 INF\ngroup half region half\ndelete_bonds half bond 1 any remove\n"
    for commands, number in ("", 2), (cut, None):
        r = lmp(text.format(commands), nranks=nranks)
        now = read_dump("now", sort=True)
        pieces = set(zip(now["mol"], now["c_piece"]))
        assert len(pieces) == len(set(now["mol"])) == len(set(now["c_piece"])) and len(pieces) > 1, commands
        assert number is None or int(re.findall(r"number of new molecule IDs = (\d+)", r.log)[-1]) == number


@pytest.mark.parametrize("nranks", [1, 2])
def test_commands_that_find_no_bonds(lmp, nranks):
    """LAMMPS's compute fragment/atom in a run, and lists of bonds to particles that are gone"""
    said = "Compute stock (fragment/atom) finds no bonds of bond style hvi/spring in a run: use compute hvi/fragment/atom"
    assert said in lmp(FREE + "compute stock all fragment/atom\nrun 0\n", nranks=nranks, expect_fail=True).error
    r = lmp(FREE + "run 2\ngroup some id 400:405\ndelete_atoms group some compress no\nreset_atoms mol all\n", nranks=nranks, expect_fail=True)
    said = r"there are bonds to particle 40\d, which is gone: use delete_atoms with bond yes"
    assert re.search(said, r.error)
    r = lmp(FREE + "thermo_modify lost/bond ignore\nrun 2\ngroup some id 400:405\ndelete_atoms group some compress no\n"
            "write_restart one\nwrite_restart two\nrun 2\n", nranks=nranks)
    assert len(re.findall(said + ", without which reset_atoms mol finds no bonds", r.log)) == 1


@pytest.mark.parametrize("nranks", [1, 2])
def test_pieces_of_before_a_command(lmp, nranks):
    """are not those of after it, though output of the run has asked for them at this step"""
    text = FREE + "compute f all hvi/fragment bonds\nthermo_style custom step c_f[1]\nrun 350\n{}\nwrite_dump all local now index c_f[2] c_f[9]\n"
    lmp(text.format("velocity all set 0 0 100"), nranks=nranks)
    assert read_dump("now")["c_f[9]"] == pytest.approx([100, 100], rel=1e-12)
    r = lmp(text.format("delete_atoms group ball bond yes"), nranks=nranks, expect_fail=None)
    if r.returncode:
        assert nranks > 1 and "ghosts are not there: use run 0 first" in r.error
    else:
        assert list(read_dump("now")["c_f[2]"]) == [507]


# ---------------------------------------------------------------------- ghosts
BAR = """units lj
atom_style {style}
atom_modify map array
region box block 0 10 0 4 0 4
create_box 2 box{more}
lattice sc 1.0
region bar block 0 10 0.9 2.1 0.9 2.1
create_atoms 1 region bar
region far block 4.9 5.1 2.9 3.1 2.9 3.1
create_atoms 2 region far
mass * 1.0
pair_style zero 1.5
pair_coeff * *
"""


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2, 3])
@pytest.mark.parametrize("command", ["delete_atoms group dust compress no", "displace_atoms dust move 0.1 0 0", "balance 1.0 shift x 5 1.0"])
def test_pieces_after_a_command_that_takes_ghosts_away(lmp, command, nranks):
    """without a run in between: an error, no crash and no wrong pieces; with one they are right"""
    text = BAR.format(style="atomic", more="") + "compute pa all hvi/fragment/atom distance 1.2\nrun 0\ngroup dust type 2\n" + command + "\n{}write_dump all custom now id type c_pa modify sort id\n"
    r = lmp(text.format(""), nranks=nranks, expect_fail=None)
    if r.returncode:
        assert "ghosts are not there: use run 0 first" in r.error
    lmp(text.format("run 0\n"), nranks=nranks)
    now = read_dump("now", sort=True)
    assert len(set(now["c_pa"][now["type"] == 1])) == 1
    assert r.returncode or nranks == 1 and command.startswith("balance")


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("commands", ['run 4 every 2 "delete_atoms group dust compress no" "write_dump all custom now id type c_pa"', "run 0\ncomm_style tiled\nwrite_dump all custom now id type c_pa"])
def test_pieces_in_commands_of_a_run(lmp, commands, nranks):
    """likewise in run every, and where LAMMPS knows no ghosts of the new style of communication yet"""
    r = lmp(BAR.format(style="atomic", more="") + "compute pa all hvi/fragment/atom distance 1.2\nrun 0\ngroup dust type 2\n" + commands + "\n", nranks=nranks, expect_fail=None)
    if r.returncode:
        assert "ghosts are not there: use run 0 first" in r.error
    else:
        now = read_dump("now")
        assert nranks == 1 and "tiled" in commands and len(set(now["c_pa"][now["type"] == 1])) == 1


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("value", ["asleep", "cost"])
def test_inactive_particles_after_a_command_that_takes_some_away(lmp, value, nranks):
    """those of the last forces are others: an error, and all cost the same, as the command balance asks for weights after it has moved particles"""
    text = "units lj\natom_style sph\nboundary f f f\nlattice sc 1.0 origin 0.5 0.5 0.5\nregion box block -2 30 0 8 0 8\ncreate_box 2 box\n" \
        "region a block 16 28 0 8 0 8\nregion b block -1 3 2 6 2 6\ncreate_atoms 1 region b\ncreate_atoms 2 region a\ngroup b type 1\nmass * 1\n" \
        "set group all sph/rho 1.0\npair_style hvi/sph cubic\npair_coeff * * eos linear 1.0 3.0 h 1.2\nvelocity b ramp vx 0.3 0.6 y 0 8\nfix m all hvi/sph\n" \
        f"compute s all hvi/atom {value}\ntimestep 0.02\nrun 5\ndelete_atoms group b compress no\n{{}}write_dump all custom now id c_s\n"
    if value == "asleep":
        said = "asleep: a command since the last run has moved, made or taken away particles: use run 0 first"
        assert said in lmp(text.format(""), nranks=nranks, expect_fail=True).error
    else:
        lmp(text.format(""), nranks=nranks)
        assert list(read_dump("now")["c_s"]) == 768 * [1]
        weigh = "variable w atom c_s\nbalance 1.0 shift x 5 1.0 weight var w\n"
        for commands in weigh, "run 5\n" + weigh, "run 5\ndelete_atoms group b compress no\n" + weigh:
            assert "rebalancing" in lmp(text.replace("run 5\ndelete_atoms group b compress no\n", commands).format(""), nranks=nranks).log
    lmp(text.format("run 0\n"), nranks=nranks)
    assert list(read_dump("now")["c_s"]) == 768 * [{"asleep": 1, "cost": 0.4}[value]]


@pytest.mark.parametrize("pair", ["hvi/sph cubic", "hvi/contact"])
def test_masses_that_ghosts_do_not_have(lmp, pair):
    """an error; not where the atom style sends them, or the fix does"""
    laws = {"hvi/contact": "pair_coeff * * 1.0 1.0\n",
            "hvi/sph cubic": "pair_coeff * * eos tait 1.0 4.0 7 h 1.2\nset group all sph/rho 1.1\nfix sph all hvi/sph\n"}[pair]
    text = "units lj\natom_style {}\nfix p all property/atom {}\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\ncreate_atoms 1 random 9 123 NULL\n" \
        "mass * 1.0\nset group all mass 1.0\npair_style " + pair + "\n" + laws + "run 0\n"
    said = "Masses of particles are not those of their ghosts: use fix ID all property/atom rmass ghost yes"
    assert said in lmp(text.format("sph", "rmass"), expect_fail=True).error
    assert said in lmp(text.format("sph", "rmass i_one"), nranks=2, expect_fail=True).error
    lmp(text.format("sph", "rmass ghost yes"))
    lmp(text.format("hybrid sph sphere", "i_one"))


@pytest.mark.parametrize("nranks", [1, 2])
def test_bonds_after_a_command_that_takes_ghosts_away(lmp, nranks):
    text = BAR.format(style="bond", more=" bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 12") + "special_bonds lj/coul 0 1 1\nbond_style zero\nbond_coeff * 1.0\ncreate_bonds many all all 1 0.9 1.1\n" \
        "compute n all hvi/atom nbonds\nrun 0\ngroup dust type 2\ndelete_atoms group dust compress no\n{}write_dump all custom now id c_n\n"
    assert "ghosts are not there: use run 0 first" in lmp(text.format(""), nranks=nranks, expect_fail=True).error
    lmp(text.format("run 0\n"), nranks=nranks)
    assert read_dump("now")["c_n"].sum() == 2 * (4 * 10 + 4 * 10)  # four periodic rows, ten squares


def test_a_state_that_is_looked_at_without_a_step(lmp, root, tmp_path, monkeypatch):
    """timestep 0: a data file of it has numbers only, and can be read"""
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))
    text = (root / "tests/inputs/in.solid").read_text().replace("fix step all hvi/dt 0.5", "timestep 2e-8")
    lmp(text + "timestep 0\nrun 3\nwrite_data state.data nocoeff\n")
    assert "nan" not in (tmp_path / "state.data").read_text()
    sections = "".join(f" fix {of} NULL {of}{part}" for of, part in (("move", "_rates"), ("move", "_step"), ("solid", "_forces"), ("solid", "_voids")))
    begin, rest = text.split("create_atoms 1")[0], text[text.index("pair_style"):]
    fixes = "fix move all hvi/sph\nfix solid all hvi/johnson-cook\n"
    rest = "".join(line + "\n" for line in rest.splitlines() if not line.startswith(("fix move", "fix solid", "velocity")))
    lmp(begin + fixes + f"read_data state.data add append fix move NULL NULL fix solid NULL NULL{sections}\n" + "group left type 1\ngroup right type 2\n" + rest)
