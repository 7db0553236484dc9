"""compute hvi/fragment/atom, hvi/fragment and hvi/cloud, and the distributed search for connected components."""

import itertools
import os
import re
import shutil
import subprocess

import numpy as np
import pytest
from dumps import frames, read_dump
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

BOX = 12.0
RANKS = [(1, "on", ""), (2, "off", ""), (3, "on", "tiled"), (4, "off", "tiled"), (4, "on", "")]
LAYOUT = {"": "", "tiled": "comm_style tiled\nbalance 1.0 rcb\n"}


# ---------------------------------------------------------------------- graphs
def lowest(n, pairs, where=None):
    """ID of every vertex's component, IDs are 1 .. n; 0 where a vertex is left out"""
    where = np.ones(n, bool) if where is None else where
    pairs = np.asarray(pairs, dtype=int).reshape(-1, 2) - 1
    pairs = pairs[where[pairs[:, 0]] & where[pairs[:, 1]]]
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    _, label = connected_components(graph, directed=False)
    low = np.full(label.max() + 1, n + 1)
    np.minimum.at(low, label, np.arange(1, n + 1))
    return np.where(where, low[label], 0)


def separation(x, i, j, length=BOX):
    d = x[i] - x[j]
    return np.linalg.norm(d - length * np.round(d / length), axis=-1)


def lattice(n, rng):
    """n^3 points of a periodic simple cubic lattice in random order and their neighbor pairs (IDs)"""
    grid = np.arange(n**3).reshape(n, n, n)
    pairs = np.concatenate([np.stack([grid, np.roll(grid, -1, k)], -1).reshape(-1, 2) for k in range(3)])
    x = np.stack(np.meshgrid(*3 * [np.arange(n)], indexing="ij"), -1).reshape(-1, 3) * BOX / n + 0.1
    order = rng.permutation(n**3)
    place = np.argsort(order)
    return x[order], place[pairs] + 1


def snake(n, rng):
    """one chain through all points of a lattice, to and fro, so that it crosses every border between ranks again and again"""
    x = np.stack(np.meshgrid(*3 * [np.arange(n)], indexing="ij"), -1)
    x[1::2] = x[1::2, ::-1]
    x[:, 1::2] = x[:, 1::2, ::-1]
    x[1::2] = x[1::2]
    x = x.reshape(-1, 3) * BOX / n + 0.1
    order = rng.permutation(n**3)
    place = np.argsort(order) + 1
    return x[order], np.stack([place[:-1], place[1:]], -1)


def graphs():
    rng = np.random.default_rng(4)
    result = {}
    for density in (0.3, 0.8):
        x = rng.uniform(0, BOX, (700, 3))
        i, j = rng.integers(0, 700, (2, 60000))
        near = (i != j) & (separation(x, i, j) < 2.5)
        pairs = np.unique(np.sort(np.stack([i, j], -1)[near] + 1, axis=1), axis=0)
        result[f"random{density}"] = x, pairs[rng.random(len(pairs)) < density * 700 / len(pairs)]
    result["snake"] = snake(8, rng)
    x, pairs = lattice(8, rng)
    result["giant"] = x, pairs
    result["singles"] = x, pairs[:0]
    result["half"] = x, pairs[rng.random(len(pairs)) < 0.3]
    result["corner"] = x / 4, pairs[(x[pairs - 1].max(axis=(1, 2)) - x[pairs - 1].min(axis=(1, 2)) < BOX / 2)]  # empty ranks
    return result


def write_data(path, x, pairs, v=None, image=None):
    n = len(x)
    image = np.zeros((n, 3), int) if image is None else image
    lines = ["fragments", "", f"{n} atoms", f"{len(pairs)} bonds", "2 atom types", "2 bond types", ""]
    lines += [f"0 {BOX} {a}lo {a}hi" for a in "xyz"]
    lines += ["", "Masses", "", "1 1", "2 3", "", "Atoms # bond", ""]
    lines += [f"{i + 1} 1 {1 + i % 2} {p[0]} {p[1]} {p[2]} {m[0]} {m[1]} {m[2]}" for i, (p, m) in enumerate(zip(x, image))]
    if v is not None:
        lines += ["", "Velocities", ""]
        lines += [f"{i + 1} {p[0]} {p[1]} {p[2]}" for i, p in enumerate(v)]
    if len(pairs):
        lines += ["", "Bonds", ""]
        lines += [f"{k + 1} 1 {a} {b}" for k, (a, b) in enumerate(pairs)]
    path.write_text("\n".join(lines) + "\n")


HEAD = """
units lj
atom_style bond
newton {newton}
comm_modify cutoff 3.2
{before}
read_data {data} extra/bond/per/atom 8 extra/special/per/atom 60
pair_style zero 1.0
pair_coeff * *
bond_style zero
bond_coeff * 1.0
special_bonds lj/coul 1 1 1
neighbor 0.2 bin
{layout}
"""


def by_id(frame, name):
    return frame[name][np.argsort(frame["id"])]


# ---------------------------------------------------------------------- bonds
@pytest.mark.parametrize("nranks,newton,layout", RANKS)
def test_bonds_against_scipy(lmp, tmp_path, nranks, newton, layout):
    text = ""
    for name, (x, pairs) in graphs().items():
        write_data(tmp_path / f"data.{name}", x, pairs)
        text += "clear\n" + HEAD.format(newton=newton, before="", data=f"data.{name}", layout=LAYOUT[layout]) + f"""
group odd type 1
compute all all hvi/fragment/atom bonds
compute odd odd hvi/fragment/atom bonds
compute t all hvi/fragment bonds
dump 1 all custom 1 dump.{name} id c_all c_odd
dump 2 all local 1 rows.{name} c_t[*]
dump_modify 2 format float %.17g
thermo_style custom step c_t[*]
thermo_modify format float %.17g
run 0
"""
    r = lmp(text, nranks=nranks)
    for (name, (x, pairs)), thermo in zip(graphs().items(), r.runs):
        n = len(x)
        frame = read_dump(tmp_path / f"dump.{name}")
        want = lowest(n, pairs)
        odd = np.arange(n) % 2 == 0
        assert np.array_equal(by_id(frame, "c_all"), want), name
        assert np.array_equal(by_id(frame, "c_odd"), lowest(n, pairs, odd)), name

        ids, count = np.unique(want, return_counts=True)
        mass = np.where(odd, 1.0, 3.0)
        m = np.array([mass[want == i].sum() for i in ids])
        got = np.array([thermo[f"c_t[{k}]"][0] for k in range(1, 6)])
        single = m[count == 1].sum()
        assert got == pytest.approx([len(ids), n, len(ids) / n, m.max() / m.sum(), single], rel=1e-14), name

        rows = read_dump(tmp_path / f"rows.{name}")
        order = np.lexsort((ids, -m))
        assert np.array_equal(rows["c_t[1]"], ids[order]), name
        assert np.array_equal(rows["c_t[2]"], count[order]), name
        assert np.array_equal(rows["c_t[3]"], m[order]), name


BREAKING = """
units lj
atom_style bond
newton {newton}
boundary p p p
comm_modify cutoff 3.2
read_data data extra/bond/per/atom 8 extra/special/per/atom 60
pair_style hvi/contact
pair_coeff * * 1.0 1.0
special_bonds lj/coul 1 1 1
bond_style hvi/spring
bond_coeff * 20.0 1.12 1.7
neighbor 0.3 bin
neigh_modify every 5 delay 0 check yes
timestep 0.005
fix 1 all nve
compute all all hvi/fragment/atom bonds
compute t all hvi/fragment bonds
compute b all property/local btype batom1 batom2
dump 1 all custom 1 dump id c_all
dump 2 all local 1 bonds index c_b[*]
thermo 1
thermo_style custom step c_t[*]
run 60
"""


@pytest.mark.parametrize("nranks,newton", [(1, "on"), (2, "off"), (3, "on")])
def test_on_the_step_a_bond_breaks(lmp, tmp_path, nranks, newton):
    """every step of a lattice that tears itself apart, most of them without a rebuild, against the bonds of that step"""
    rng = np.random.default_rng(1)
    x, pairs = lattice(10, rng)
    write_data(tmp_path / "data", x, pairs, v=rng.normal(0, 4, x.shape))
    r = lmp(BREAKING.format(newton=newton), nranks=nranks)
    fragments, bonds = ({f.step: f for f in frames(tmp_path / name)} for name in ("dump", "bonds"))
    nbonds = []
    for n, step in enumerate(r.thermo["Step"]):
        live = np.stack([bonds[step]["c_b[2]"], bonds[step]["c_b[3]"]], -1)[bonds[step]["c_b[1]"] > 0]
        want = lowest(len(x), live)
        assert np.array_equal(by_id(fragments[step], "c_all"), want), step
        assert r.thermo["c_t[1]"][n] == len(np.unique(want))
        nbonds.append(len(live))
    assert nbonds[0] == 3000 and nbonds[-1] < 2000
    assert len(np.unique(nbonds)) > 30  # some break on most steps
    assert len(np.unique(r.thermo["c_t[1]"])) > 10


# ---------------------------------------------------------------------- distance
def close_pairs(x, cutoff):
    tree = pytest.importorskip("scipy.spatial").cKDTree(x % BOX, boxsize=BOX)
    return tree.query_pairs(cutoff, output_type="ndarray") + 1


@pytest.mark.each_value
@pytest.mark.parametrize("nranks,newton,layout", RANKS)
@pytest.mark.parametrize("cutoff", [0.6, 1.6])  # shorter and longer than the pair cutoff
def test_distance(lmp, tmp_path, nranks, newton, layout, cutoff):
    rng = np.random.default_rng(2)
    x = rng.uniform(0, BOX, (1500 if cutoff < 1 else 300, 3))
    write_data(tmp_path / "data", x, [], v=rng.normal(0, 2, x.shape))
    r = lmp(HEAD.format(newton=newton, before="fix d all property/atom d_hvi_damage ghost no", data="data",
                        layout=LAYOUT[layout]) + f"""
group odd id 1:{len(x)}:2
set group all d_hvi_damage 0.5
group failed id 1:{len(x)}:7
set group failed d_hvi_damage 1.0
compute all all hvi/fragment/atom distance {cutoff}
compute odd odd hvi/fragment/atom distance {cutoff}
compute sound all hvi/fragment/atom distance {cutoff} damage yes
region left block INF 5 INF INF INF INF
compute t all hvi/fragment distance {cutoff} region left
compute f all hvi/fragment distance {cutoff} damage yes
dump 1 all custom 7 dump id x y z c_all c_odd c_sound
dump_modify 1 format float %.17g
thermo_style custom step c_t[1] c_t[2] c_t[5] c_f[1] c_f[2]
thermo 7
timestep 0.01
fix 1 all nve
run 28
""", nranks=nranks)
    n = len(x)
    ids = np.arange(1, n + 1)
    failed = ids % 7 == 1
    found = set()
    for k, frame in enumerate(frames(tmp_path / "dump")):
        x = np.stack([by_id(frame, a) for a in "xyz"], -1)
        pairs = close_pairs(x, cutoff)
        want = lowest(n, pairs)
        found.add(len(np.unique(want)))
        assert np.array_equal(by_id(frame, "c_all"), want), frame.step
        assert np.array_equal(by_id(frame, "c_odd"), lowest(n, pairs, ids % 2 == 1)), frame.step
        sound = np.where(failed, ids, lowest(n, pairs, ~failed))
        assert np.array_equal(by_id(frame, "c_sound"), sound), frame.step
        inside = x[:, 0] % BOX <= 5
        label, count = np.unique(lowest(n, pairs, inside)[inside], return_counts=True)
        assert r.thermo["c_t[1]"][k] == len(label) and r.thermo["c_t[2]"][k] == inside.sum()
        mass = np.where(ids % 2 == 1, 1, 3)
        assert r.thermo["c_t[5]"][k] == mass[label[count == 1] - 1].sum()
        assert r.thermo["c_f[1]"][k] == len(np.unique(sound)) and r.thermo["c_f[2]"][k] == n
    assert len(found) >= 3


# ---------------------------------------------------------------------- rows
@pytest.mark.parametrize("nranks", [1, 4])
def test_rows(lmp, tmp_path, nranks):
    """every number of every row from the particles; sums; order; thermo, fix ave/time and dump local agree"""
    rng = np.random.default_rng(3)
    x, pairs = graphs()["random0.8"]
    image = rng.integers(-2, 3, x.shape)
    v = rng.normal(1, 3, x.shape)
    write_data(tmp_path / "data", x, pairs, v, image)
    r = lmp(HEAD.format(newton="on", before="", data="data", layout="") + """
compute t all hvi/fragment bonds
fix 1 all ave/time 1 1 1 c_t[*] mode scalar file ave format " %.17g"
dump 1 all local 1 rows c_t[*]
dump_modify 1 format float %.17g
variable p1 equal "vcm(all,x)*mass(all)"
thermo_style custom step c_t[*] ke
thermo_modify format float %.17g norm no
run 0
""", nranks=nranks)
    rows = read_dump(tmp_path / "rows").table
    label = lowest(len(x), pairs)
    ids = np.unique(label)
    m = np.where(np.arange(len(x)) % 2 == 0, 1.0, 3.0)
    xu = x + BOX * image
    want = []
    for i in ids:
        k = label == i
        mass = m[k].sum()
        center = m[k] @ xu[k] / mass
        gyration = np.sqrt(m[k] @ ((xu[k] - center) ** 2).sum(1) / mass)
        want.append([i, k.sum(), mass, *center, *(m[k] @ v[k] / mass), 0.5 * m[k] @ (v[k] ** 2).sum(1),
                     2 * np.sqrt(5 / 3) * gyration])
    want = np.array(want)
    want = want[np.lexsort((want[:, 0], -want[:, 2]))]
    assert rows == pytest.approx(want, rel=1e-12, abs=1e-12)
    assert np.all(rows[rows[:, 1] == 1, 10] == 0)
    assert rows[:, 2].sum() == m.sum()
    assert rows[:, 2] @ rows[:, 6:9] == pytest.approx(m @ v, rel=1e-13)
    assert rows[:, 9].sum() == pytest.approx(r.thermo["KinEng"][0], rel=1e-13)
    vector = [r.thermo[f"c_t[{k}]"][0] for k in range(1, 6)]
    assert vector == pytest.approx([len(ids), len(x), len(ids) / len(x), want[0, 2] / m.sum(), want[want[:, 1] == 1, 2].sum()])
    assert np.loadtxt(tmp_path / "ave")[1:] == pytest.approx(vector, rel=1e-14)


def test_rows_follow_a_new_run_at_the_same_step(lmp, tmp_path):
    x, pairs = lattice(6, np.random.default_rng(5))
    write_data(tmp_path / "data", x, pairs)
    r = lmp(HEAD.format(newton="on", before="", data="data", layout="") + """
compute t all hvi/fragment bonds
thermo_style custom step c_t[1]
run 0
delete_bonds all bond 1 remove
run 0
""", nranks=2)
    assert r.runs[0]["c_t[1]"][0] == 1 and r.runs[1]["c_t[1]"][0] == 216


# ---------------------------------------------------------------------- cloud
def quantile(value, mass, q):
    order = np.argsort(value)
    return value[order][np.searchsorted(np.cumsum(mass[order]), q * mass.sum() * (1 - 1e-12))]


@pytest.mark.each_value
@pytest.mark.parametrize("nranks,layout", [(1, ""), (3, "tiled"), (4, "")])
@pytest.mark.parametrize("axis", "xyz")
def test_cloud(lmp, tmp_path, nranks, layout, axis):
    """an ellipsoidal shell that grows from a moving center, with unequal masses, some strays and a plate behind the plane"""
    rng = np.random.default_rng(6)
    a = "xyz".index(axis)
    n = 1000
    u = rng.normal(size=(n, 3))
    u /= np.linalg.norm(u, axis=1)[:, None]
    shape = np.array([1.0, 1.0, 1.0])
    shape[a] = 1.5
    x = 7 + 2 * u * shape
    v = 0.5 * u * shape
    v[:, a] += 4
    x[:5, a] = 11.9  # strays
    x[n - 200:, a] = 1  # the plate
    write_data(tmp_path / "data", x, [], v)
    r = lmp(HEAD.format(newton="on", before="", data="data", layout=LAYOUT[layout]) + f"""
compute c all hvi/cloud axis {axis} plane 3.5
compute d all hvi/cloud axis {axis} plane 3.5 quantile 0.9
compute m all hvi/cloud axis {axis} plane 3.5 quantile 1
compute none all hvi/cloud axis {axis} plane 12.5
dump 1 all custom 1 dump id x y z
dump_modify 1 format float %.17g
thermo_style custom step c_c[*] c_d[*] c_m[*] c_none[*]
thermo_modify format float %.17g norm no
run 0
""", nranks=nranks)
    frame = read_dump(tmp_path / "dump")
    x = np.stack([by_id(frame, k) for k in "xyz"], -1)
    m = np.where(np.arange(n) % 2 == 0, 1.0, 3.0)
    k = x[:, a] > 3.5
    x, v, m = x[k], v[k], m[k]
    s, vs = x[:, a], v[:, a]
    y, vy = (np.delete(w - m @ w / m.sum(), a, axis=1) for w in (x, v))
    rho = np.linalg.norm(y, axis=1)
    vr = (y * vy).sum(1) / rho
    for name, q in (("c", 0.99), ("d", 0.9), ("m", 1.0)):
        front, rear, radius = quantile(s, m, q), -quantile(-s, m, q), quantile(rho, m, q)
        head, tail, rim = s >= front, s <= rear, rho >= radius * (1 - 1e-9)
        want = [front - rear, 2 * radius, (front - rear) / radius, front, rear, m[head] @ vs[head] / m[head].sum(),
                m[tail] @ vs[tail] / m[tail].sum(), m[rim] @ vr[rim] / m[rim].sum(), m.sum(), m @ vs,
                0.5 * m @ (v**2).sum(1), len(m)]
        got = [r.thermo[f"c_{name}[{i}]"][0] for i in range(1, 13)]
        assert got == pytest.approx(want, rel=1e-12), name
        if name == "d":  # what it was made as, whatever the strays do
            # s is uniform on a shell; the radius is sqrt(0.99) of the full one
            assert got[:3] == pytest.approx([4.8, 3.98, 2.41], rel=0.05), name
            assert got[5:8] == pytest.approx([4.675, 3.325, 0.498], rel=0.03), name
    assert all(r.thermo[f"c_none[{i}]"][0] == 0 for i in range(1, 13))


def test_cloud_of_a_lattice_is_the_same_on_any_ranks(lmp, tmp_path):
    """ties by symmetry: which of them lie at the edge must not depend on round-off"""
    text = """
units lj
atom_style atomic
lattice sc 1.0
region b block 0 10 0 10 0 10
create_box 1 b
create_atoms 1 box
mass 1 1
velocity all create 1.0 4 loop geom
pair_style zero 1.0
pair_coeff * *
compute c all hvi/cloud axis x plane 2.5 quantile 0.9
thermo_style custom step c_c[*]
thermo_modify format float %.17g norm no
run 0
"""
    one, four = (lmp(text, nranks=n).thermo for n in (1, 4))
    for name in one:
        assert four[name] == pytest.approx(one[name], rel=1e-12, abs=1e-12), name


# ---------------------------------------------------------------------- wrong input
SMALL = """
units lj
atom_style {style}
region b block 0 8 0 8 0 8
create_box 1 b {extra}
create_atoms 1 random 20 1 b
mass 1 1
pair_style zero 1.0
pair_coeff * *
{line}
thermo_style custom step c_x[1]
run 0
"""


@pytest.mark.parametrize("nranks", [1, 2])
def test_ghosts_reach_as_far_as_is_looked(lmp, nranks):
    """beyond the reach of forces and skin: the cutoff of communication sets itself, and the fragments are those of a cutoff that was given"""
    def fragments(line):
        r = lmp(SMALL.format(style="atomic", extra="", line=line + "compute x all hvi/fragment distance 2.0"), nranks=nranks)
        return r.thermo["c_x[1]"][0], float(re.search(r"ghost atom cutoff = ([\d.]+)", r.log)[1])

    (alone, reach), (given, _) = fragments(""), fragments("comm_modify cutoff 5\n")
    assert alone == given < 20 and reach == 2.3  # and the skin


def test_bonds_need_bonds(lmp):
    r = lmp(SMALL.format(style="atomic", extra="", line="compute x all hvi/fragment bonds"), expect_fail=True)
    assert "atom style with bonds" in r.error


@pytest.mark.parametrize("line,pieces", [("", 1), ("special_bonds lj/coul 0 0 0\n", 1), ("neigh_modify exclude type 1 1\n", 2), ("group one id 1\nneigh_modify exclude group one all\n", 2),
                                         ("neigh_modify exclude molecule/intra all\n", 2), ("neigh_modify exclude molecule/inter all\n", 1)])
def test_what_lists_leave_out(lmp, line, pieces):
    """bonded pairs of weight 0 are in no list, but near each other; excluded ones do not connect"""
    text = f"""
units lj
atom_style molecular
atom_modify map array
boundary f f f
region box block 0 4 0 4 0 4
create_box 1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 9
create_atoms 1 single 1.5 2 2
create_atoms 1 single 2.5 2 2
mass 1 1
pair_style zero 1.2
pair_coeff * *
set group all mol 1
bond_style zero
bond_coeff * 1.0
{{}}create_bonds single/bond 1 1 2
{line}compute x all hvi/fragment distance 1.1
thermo_style custom step c_x[1]
run 0
"""
    assert lmp(text.format("special_bonds lj/coul 1 1 1\n")).thermo["c_x[1]"][0] == pieces


def test_bond_longer_than_the_ghosts_reach(lmp, tmp_path):
    write_data(tmp_path / "data", np.array([[3.0, 6, 6], [9, 6, 6]]), [[1, 2]])
    text = """
units lj
atom_style bond
boundary f f f
processors 2 1 1
comm_modify cutoff {cutoff}
read_data data
pair_style zero 1.0
pair_coeff * *
compute x all hvi/fragment bonds
thermo_style custom step c_x[1]
run 0
"""
    r = lmp(text.format(cutoff=2), nranks=2, expect_fail=True)
    assert "comm_modify cutoff" in r.stdout + r.stderr
    assert lmp(text.format(cutoff=5.5), nranks=2).thermo["c_x[1]"][0] == 1


@pytest.mark.parametrize("words", ["hvi/fragment distance 1.5", "hvi/cloud axis z plane 0.1", "hvi/hole axis z centre 2 2 plane 2"])
def test_what_is_no_number_is_said(lmp, words):
    """neither left out nor sorted"""
    text = f"""units lj
atom_modify map array
boundary f f f
region box block 0 5 0 5 0 5
create_box 1 box
lattice sc 1.0 origin 0.5 0.5 0.5
create_atoms 1 box
mass 1 1
pair_style zero 1.2
pair_coeff * *
comm_modify cutoff 3
neighbor 0.3 bin
variable bad atom exp(1e4)-exp(1e4)
set atom 9 vy v_bad
compute x all {words}
thermo_style custom step c_x[1]
run 0
"""
    found = lmp(text, expect_fail=True).stdout
    assert re.search(rf"Compute {words.split()[0]}: particle 9 is at 3.5 1.5 0.5 with velocity 0 -?nan 0 at step 0: the simulation is unstable", found), found


# ---------------------------------------------------------------------- hvi_components alone
@pytest.fixture(scope="module")
def snake_exe(root, tmp_path_factory):
    compiler = shutil.which(os.environ.get("MPICXX", "mpicxx"))
    if not compiler:
        pytest.fail("no mpicxx: set MPICXX", pytrace=False)
    exe = tmp_path_factory.mktemp("components") / "snake"
    rooms = root / "lib" / "hvi"
    subprocess.run([compiler, "-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror",
                    "-Wno-cast-function-type", "-D_GLIBCXX_ASSERTIONS", f"-I{rooms / 'measure'}", f"-I{rooms / 'space'}",
                    str(root / "tests" / "components" / "snake.cpp"), str(rooms / "measure" / "hvi_components.cpp"), "-o", str(exe)],
                   check=True)
    return exe


def search(root, exe, nranks, graphs):
    """graphs: (layout, graph, n), all in one run; what it prints of each"""
    words = [str(word) for graph in graphs for word in graph]
    out = subprocess.run([root / "cmake" / "env.sh", "mpirun", "-np", str(nranks), exe, *words], check=True,
                         stdout=subprocess.PIPE, text=True, timeout=300).stdout.splitlines()
    found = [dict(zip(line.split()[::2], line.split()[1::2])) for line in out]
    assert [(f["layout"], f["graph"], int(f["vertices"])) for f in found] == graphs
    assert all(f["wrong"] == "0" for f in found), out
    return found


@pytest.mark.parametrize("nranks", [1, 2, 3, 4])
def test_components(root, snake_exe, nranks):
    search(root, snake_exe, nranks, list(itertools.product(("blocks", "cyclic", "random"), ("chain", "cut", "pairs", "empty"), (1, 2, 7, 3000))))


@pytest.mark.parametrize("nranks", [8, 13, *(pytest.param(more, marks=pytest.mark.long) for more in (16, 32))])
def test_rounds(root, snake_exe, nranks):
    """logarithm of the ranks, whatever the length of the chain and however often it crosses"""
    chains = (("blocks", 2000), ("cyclic", 2000), ("cyclic", 20000), ("random", 20000))
    for result in search(root, snake_exe, nranks, [(layout, "chain", n) for layout, n in chains]):
        assert int(result["components"]) == 1
        assert int(result["rounds"]) == int(np.ceil(np.log2(nranks)))
