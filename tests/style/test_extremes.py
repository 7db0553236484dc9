"""The very few and the very many: one particle, ranks without any, a box that grows without end, all leaving at once, tilted boxes, balancing all the time."""

import struct

import numpy as np
import pytest
from fem_scenes import STATE, read_state, start, strike_plate
from scenes import BOND, BONDS, DUMP, PAIR, State, books, cube, ledger, momentum_error, read_bonds, read_dump, scene
from sph_scenes import RATES, Fluid, random_fluid, read_rates
from sph_scenes import scene as sph_scene

GAS = "pair_style hvi/sph cubic\npair_coeff * * eos idealgas 1.4 h 1.2\n"
MEMORY = """p=$PPID
while [ "$(cat /proc/$p/comm)" != lmp ]; do p=$(cut -d' ' -f4 /proc/$p/stat); done
grep VmRSS /proc/$p/status >> memory
"""
FAR = """units lj
atom_style {style}
atom_modify map array
boundary s s s
region box block -5 5 -5 5 -5 5
create_box 1 box {bonds}
region body block -2 2 -2 2 -2 2
lattice sc 1 origin 0.5 0.5 0.5
create_atoms 1 region body
mass 1 1
{pair}
velocity all ramp vx -{v} {v} x -2 2 units box
velocity all ramp vy -{v} {v} y -2 2 units box
velocity all ramp vz -{v} {v} z -2 2 units box
compute book all hvi/energy
thermo {every}
thermo_style custom step lx c_book[9]
run {steps} every {every} "shell sh memory.sh"
"""
STYLES = {
    "sph": dict(style="sph", bonds="", pair=GAS + "set group all sph/rho 1 sph/e 1\nfix move all hvi/sph\nfix step all hvi/dt 0.3 max 0.02"),
    "dem": dict(style="bond", bonds="bond/types 1 extra/bond/per/atom 6", pair="special_bonds lj/coul 1 1 1\n" + PAIR + BOND + "fix move all nve\ntimestep 0.01"),
}


def grown(lmp, tmp_path, name, steps, v):
    """kB of memory at ten times, of 64 particles that fly apart; length of the box, ratio of energies"""
    (tmp_path / "memory.sh").write_text(MEMORY)
    (tmp_path / "memory").unlink(missing_ok=True)
    r = lmp(FAR.format(steps=steps, every=steps // 10, v=v, **STYLES[name]), timeout=3000)
    found = [int(line.split()[1]) for line in (tmp_path / "memory").read_text().splitlines()]
    assert len(found) == 10
    return found, r.runs[-1]["lx"][-1] if "lx" in r.runs[-1] else r.runs[-1]["Lx"][-1], r.runs[-1]["c_book[9]"][-1]


@pytest.mark.parametrize("name", STYLES)
def test_a_box_that_grows(lmp, tmp_path, name):
    """bins of half a cutoff would be 1e9 at the end, of LAMMPS's lists and of its sorting: a box of a thousand cutoffs takes what one of a hundred does"""
    memory, length, ratio = grown(lmp, tmp_path, name, 1000, 100.0)
    assert length > 400 and ratio == pytest.approx(1.0, abs=1e-2)
    assert memory[-1] < memory[0] + 60_000, memory


@pytest.mark.long
@pytest.mark.parametrize("name", STYLES)
def test_a_box_that_grows_for_a_million_steps(lmp, tmp_path, name):
    memory, _, ratio = grown(lmp, tmp_path, name, 1_000_000, 5.0)
    assert memory[-1] < memory[0] + 60_000 and memory[-1] < memory[4] + 2_000 and ratio == pytest.approx(1.0, abs=1e-2), memory


def test_bins_are_given_back(lmp, tmp_path):
    """what neigh_modify and atom_modify have set is set again after a run, what they set between runs stays, and restart files that are written in a run have it"""
    text = FAR.format(steps=200, every=100, v=500.0, **STYLES["dem"]).replace(' every 100 "shell sh memory.sh"', "") + "change_box all x final -5 5 y final -5 5 z final -5 5 units box\n"
    text = text.replace("boundary s s s", "boundary m m m").replace("thermo 100\n", "thermo 100\natom_modify sort 777 0.25\nrestart 100 r.1 r.2\n")
    other = "pair_style zero 2.0\npair_coeff * *\nrun 0\n"  # lists are described where they are not those of the run before
    again = f"{other}{PAIR}run 0\nneigh_modify binsize 3.0\n{other}{PAIR}run 0\nneigh_modify binsize 0.0\n{other}{PAIR}run 0\n"
    r = lmp(text + "restart 0\ndelete_atoms group all\ncreate_atoms 1 single 0 0 0\n" + again)
    half = 0.5 * float(r.log.split("master list distance cutoff = ")[-1].split()[0])
    sizes = [float(line.split("binsize = ")[1].split(",")[0]) for line in r.log.splitlines() if "binsize = " in line]
    assert sizes == pytest.approx([half, 1.15, half, 3.0, 3.0, 1.15, half], rel=1e-4)
    for name in ("r.1", "r.2"):  # LAMMPS writes how often it sorts, a flag, and the size of bins
        data = (tmp_path / name).read_bytes()
        at = data.index(struct.pack("i", 777))
        assert struct.unpack("d", data[at + 8:at + 16]) == (0.25,), name


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 3])
@pytest.mark.parametrize("n", [1, 2])
def test_one_and_two_particles(lmp, tmp_path, n, nranks):
    """ranks without any; two fly into each other: momentum stays, energy is closed"""
    x = np.array([[0.0, 0.0, 0.0], [1.6, 0.1, 0.0]])[:n]
    v = np.array([[0.5, 0.0, 0.0], [-0.5, 0.0, 0.0]])[:n]
    state = State(x, v, [(0, 1)] if n == 2 else [], [[-6.0, 8.0]] * 3)
    r = lmp(scene(state, "s.data") + "fix nve all nve\ntimestep 0.002\n" + ledger() + "run 800\n", nranks=nranks)
    assert momentum_error(books(r.thermo), state) < 1e-13 and np.abs(r.thermo["c_book[9]"] - 1).max() < 1e-3
    assert n == 1 or r.thermo["c_book[3]"].max() > 0.01  # they have touched
    fluid = Fluid(x + 4.0, v, np.ones(n), np.ones(n), np.ones(n, int), {1: 1.0}, {1: 1.2}, np.full(3, 10.0), (False,) * 3)
    r = lmp(sph_scene(fluid, tmp_path / "f.data", GAS) + "timestep 0.005\n" + ledger() + "run 200\n", nranks=nranks)
    assert np.abs(r.thermo["c_book[9]"] - 1).max() < 1e-3
    got = [r.thermo[f"c_book[{k}]"] for k in (10, 11, 12)]
    assert max(np.abs(p - p[0]).max() for p in got) < 1e-14
    assert n == 1 or np.ptp(r.thermo["c_book[1]"]) > 1e-3


@pytest.mark.parametrize("nranks", [1, 2])
def test_all_leave_at_once(lmp, nranks):
    """1e5 particles beyond a fixed face in one step: their number, mass, momentum and energy are in the books"""
    text = ("units lj\natom_style bond\natom_modify map array\nboundary f f f\nspecial_bonds lj/coul 1 1 1\nregion box block -1 101 -1 101 -1 81\nlattice sc 0.125 origin 0.5 0.5 0.5\n"
            "region body block 0 100 0 100 0 80 units box\ncreate_box 2 box bond/types 1\ncreate_atoms 1 region body\nmass * 2\n" + PAIR + BOND
            + "group one id 1\nset group one type 2\nvelocity all set 1000 0 0 units box\nvelocity one set 0 0 0 units box\nfix nve all nve\ntimestep 1.0\n"
            "neigh_modify every 1 delay 0 check yes\nthermo_modify lost ignore\n" + ledger(every=1) + "thermo_modify lost ignore\nrun 2\n")
    b = books(lmp(text, nranks=nranks).thermo)
    n = 50 * 50 * 40 - 1
    assert b["left_count"][-1] == n and b["mass"][-1] == 2.0
    assert b["left_mass"][-1] == 2.0 * n and b["left_px"][-1] == 2000.0 * n and b["px"][-1] == 0.0
    assert b["left"][-1] == pytest.approx(1e6 * n, rel=1e-13) and b["ratio"][-1] == pytest.approx(1.0, abs=1e-13)


@pytest.mark.parametrize("nranks", [1, 3])
def test_tilted_boxes(lmp, tmp_path, nranks):
    """a periodic state twice beside itself: sheared by half of the box it is the same state, of a fluid and of bonded particles"""
    s = random_fluid(5, seed=7, jitter=0.2, types=1)
    twice = Fluid(np.vstack([s.x, s.x + [s.box[0], 0, 0]]), *(np.concatenate([a, a]) for a in (s.v, s.rho, s.esph, s.type)), s.mass, s.h, s.box * [2, 1, 1])
    tilt = f"change_box all triclinic\nchange_box all xy final {s.box[0]:.17g} units box\n"
    text = sph_scene(twice, tmp_path / "f.data", GAS)
    at, end = text.index("pair_style"), "timestep 0.01\nrun 3\n"
    lmp(text + end + RATES.format("straight"))
    lmp(text[:at] + tilt + text[at:] + end + RATES.format("tilted"), nranks=nranks)
    a, b = (read_rates(tmp_path / name) for name in ("straight", "tilted"))
    for name in ("f", "drho", "de", "rho", "esph", "v"):
        assert np.abs(a[name] - b[name]).max() <= 1e-11 * np.abs(a[name]).max(), name
    c = cube(5, periodic=True)
    two, half = State(np.vstack([c.x, c.x + [c.box[0, 1], 0, 0]]), np.vstack([c.v, c.v]), np.vstack([c.bonds, c.bonds + len(c.x)]), c.box * [[2], [1], [1]], True), 0.5 * c.box[0, 1]

    def joined(axes):
        """bonds across faces of these axes join a particle and the copy beside the one it was bonded to"""
        return [(i, (j + len(c.x) * sum(two.x[i % len(c.x), a] - two.x[j % len(c.x), a] > half for a in axes)) % len(two.x)) for i, j in np.vstack([c.bonds, c.bonds + len(c.x)])]

    two.bonds = np.array(joined([0]))
    tilt = f"change_box all triclinic\nchange_box all xy final {c.box[0, 1]:.17g} units box\n"
    text = scene(two, "s.data")
    at, end = text.index("pair_style"), "fix nve all nve\ntimestep 0.002\nrun 20\n"
    lmp(text + end + DUMP.format("a") + BONDS.format("a.bonds"))
    two.bonds = np.array(joined([0, 1]))
    two.write(tmp_path / "s.data")
    lmp(text[:at] + tilt + text[at:] + end + DUMP.format("b") + BONDS.format("b.bonds"), nranks=nranks)
    a, b = read_dump(tmp_path / "a"), read_dump(tmp_path / "b")
    for name in ("fx", "fy", "fz", "vx", "vy", "vz"):
        assert np.abs(a[name] - b[name]).max() <= 1e-11 * np.abs(a[name]).max(), name
    assert len(read_bonds(tmp_path / "a.bonds")) == len(read_bonds(tmp_path / "b.bonds")) == len(two.bonds)


def test_balanced_all_the_time(lmp):
    """fix balance rcb every 10 steps, elements that fail, ghosts that change ranks: as on one rank"""
    mesh, strike_it = strike_plate()
    states = []
    for nranks, comm, balance in ((1, "brick", ""), (3, "tiled", "fix all all balance 10 1.0 rcb\n")):
        text = start(mesh, fem="strain 0.1", comm=comm, every=5) + strike_it + balance
        r = lmp(text + "run 40\n" + STATE.format("out"), nranks=nranks)
        states.append((read_state("out"), r.thermo))
    (a, one), (b, three) = states
    assert one["f_wall"][-1] < one["f_wall"][0]  # elements have failed
    assert np.array_equal(one["f_wall"], three["f_wall"])
    for name in ("X", "V"):
        assert np.abs(a[name] - b[name]).max() <= 1e-9 * np.abs(a[name]).max(), name
    assert np.abs(three["c_book[9]"] - one["c_book[9]"]).max() < 1e-10


@pytest.mark.long
def test_soak(lmp, tmp_path):
    """five minutes of a bonded body that is shaken in a periodic box: flat memory, closed balances; with a constant step, as one that follows the state takes energy away"""
    (tmp_path / "memory.sh").write_text(MEMORY)
    s = cube(4, speed=0.3, periodic=True)
    text = scene(s, "s.data") + "fix nve all nve\nfix step all hvi/dt 0.1 max 0.002\ntimer timeout 0:05:00 every 1000\n" + ledger(every=10000)
    r = lmp(text + 'run 100000000 every 20000 "shell sh memory.sh"\n', timeout=2000)
    memory = [int(line.split()[1]) for line in (tmp_path / "memory").read_text().splitlines()]
    steps = r.thermo["Step"][-1]
    print("soak:", steps, "steps, memory", memory[0], memory[-1], "kB, ratio", r.thermo["c_book[9]"][-1])
    assert steps > 100_000 and memory[-1] < memory[1] + 1000, memory
    assert np.abs(r.thermo["c_book[9]"] - 1).max() < 1e-3 and momentum_error(books(r.thermo), s) < 1e-10
