"""What computes say of walls of elements: what hangs together in them, and what they are at any step that somebody looks at."""

import numpy as np
import pytest
from dumps import read_dump
from fem_scenes import DX, EDGE, STATE, plate, read_state, start, strike_plate
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

REACH = 1.5 * DX
LAYOUTS = [(1, "on"), (1, "off"), (2, "on"), (2, "off"), (3, "off")]
FRAGMENTS = f"""compute piece all hvi/fragment distance {REACH} damage {{0}}
compute name all hvi/fragment/atom distance {REACH} damage {{0}}
compute hard all hvi/atom damage spalled
variable hold equal c_piece[1]
run {{1}}
print "pieces $(c_piece[1]:%.0f) $(c_piece[2]:%.0f) $(c_piece[4]:%.15g)"
write_dump all custom names id type x y z c_name c_hard[*] modify sort id format float %.17g
"""


def fragments(lmp, text, damage="no", steps=0, nranks=1):
    """Number of fragments, of particles, the part of the largest of the mass; the dump"""
    r = lmp(text + FRAGMENTS.format(damage, steps), nranks=nranks)
    row = next(line for line in r.log.splitlines() if line.startswith("pieces"))
    return [float(word) for word in row.split()[1:]], read_names()


def read_names():
    table = read_dump("names").table
    return dict(id=table[:, 0].astype(int), type=table[:, 1].astype(int), x=table[:, 2:5], name=table[:, 5].astype(int), failed=(table[:, 6] >= 1) | (table[:, 7] > 0))


def by_hand(mesh, got, alone):
    """Lowest ID in its fragment of each particle, 0 of nodes: elements that hold hang together by their nodes, free particles by distance"""
    nodes, count = len(mesh.nodes), mesh.per_edge**3
    failed = got["failed"] if alone else np.zeros(len(got["id"]), bool)
    edges, held, first = [], np.zeros(len(failed), bool), nodes
    for corners, n in zip(mesh.elements, mesh.n):
        inside = first + np.arange(count if n else 0)
        first, held[inside] = first + len(inside), True
        if n == 0 or not failed[inside].all():
            edges += [(corners[0], k) for k in [*corners[1:], *inside[~failed[inside]]]]
    matter = np.flatnonzero(~failed & (got["type"] != mesh.node_type))
    for i in matter[~held[matter]]:
        near = matter[np.linalg.norm(got["x"][matter] - got["x"][i], axis=1) < REACH]
        edges += [(i, k) for k in near]
    i, j = np.array(edges).T
    label = connected_components(coo_matrix((np.ones(len(i)), (i, j)), shape=2 * (len(failed),)), directed=False)[1]
    ids = np.where(got["type"] == mesh.node_type, 10**9, got["id"])
    lowest = np.full(label.max() + 1, 10**9)
    np.minimum.at(lowest, label, ids)
    return np.where(got["type"] == mesh.node_type, 0, lowest[label])


def cut(mesh):
    """in two at x = 0: nodes there are there twice, with a slit between them"""
    mesh.elements = mesh.elements.copy()
    right = np.flatnonzero(mesh.corners.mean(axis=1)[:, 0] > 0)
    there = np.flatnonzero(np.abs(mesh.nodes[:, 0]) < 1e-9)
    new = np.arange(len(mesh.nodes))
    new[there] = len(mesh.nodes) + np.arange(len(there))
    mesh.nodes = np.concatenate([mesh.nodes, mesh.nodes[there]])
    mesh.elements[right] = new[mesh.elements[right]]
    mesh.nodes[np.unique(mesh.elements[right]), 0] += 0.01 * DX
    return mesh


def empty_strip(mesh):
    """elements without particles between others"""
    mesh.n = np.where(np.abs(mesh.corners.mean(axis=1)[:, 0]) < EDGE, 0, mesh.n)
    return mesh


def of_particles(text):
    """the same without elements, of a mesh whose particles are all free"""
    words = {"fix wall all": "#", " fix wall elements Elements": f"\nset type 2 mass {2703.0 * DX**3}", "f_wall f_wall[*]": "", "pair_coeff 3 3 nodes": ""}
    for old, new in words.items():
        text = text.replace(old, new)
    return text.replace("pair_coeff 2 2", "pair_coeff 2*3 2*3")


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", LAYOUTS)
def test_a_plate_is_one_piece(lmp, nranks, newton):
    """as the same plate of particles; a cut one is two, unless free particles are between; elements without particles hold others together"""
    for mesh, pieces in [(plate(core=0), 1), (plate(), 1), (cut(plate(core=0)), 2), (cut(plate()), 1), (empty_strip(plate(core=0)), 1),
                         (empty_strip(cut(plate(core=0))), 2)]:
        (number, count, largest), got = fragments(lmp, start(mesh, newton=newton), nranks=nranks)
        assert (number, count) == (pieces, mesh.n.astype(bool).sum() * mesh.per_edge**3 + len(mesh.free))
        assert largest == pytest.approx(1 / pieces, rel=1e-12)
        assert np.array_equal(got["name"], by_hand(mesh, got, False))
    everything = plate(core=100)
    assert not len(everything.elements)
    assert fragments(lmp, of_particles(start(everything, newton=newton)), nranks=nranks)[0] == [1, 576, pytest.approx(1, rel=1e-12)]


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", LAYOUTS)
@pytest.mark.parametrize("damage", ["yes", "no"])
def test_failed_ones_are_alone(lmp, nranks, newton, damage):
    """Elements that spall and stay elements hold nothing"""
    mesh, strike_it = strike_plate()
    text = start(mesh, newton=newton, fem="convert no", spall="principal") + strike_it
    (number, _, _), got = fragments(lmp, text, damage, 36, nranks)
    embedded = np.arange(len(got["id"])) < len(mesh.nodes) + (mesh.n > 0).sum() * mesh.per_edge**3
    assert 0 < got["failed"][embedded].sum() < 0.8 * embedded.sum()
    assert np.array_equal(got["name"], by_hand(mesh, got, damage == "yes"))
    assert number == len(np.unique(got["name"])) - 1


def test_groups_and_regions(lmp):
    """A strip of elements whose particles do not count holds nothing together"""
    text = start(plate(core=0)) + f"region strip block {-1.01 * EDGE} {1.01 * EDGE} INF INF INF INF units box side out\nrun 0\n"
    both = f"compute {{0}} {{1}} hvi/fragment distance {REACH} {{2}}\n"
    text += "group sides region strip\n" + both.format("a", "sides", "") + both.format("b", "all", "region strip") + both.format("c", "all", "")
    text += 'thermo_style custom step c_a[1] c_b[1] c_c[1]\nrun 0\n'
    for nranks in (1, 3):
        table = lmp(text, nranks=nranks).thermo
        assert [table[f"c_{k}[1]"][0] for k in "abc"] == [2, 2, 1], nranks


@pytest.mark.parametrize("nranks", [1, 2])
def test_body_of_a_wall(lmp, nranks):
    """compute hvi/wall: the body of a plate is all of it, whatever elements hold, when it has begun to move"""
    mesh, strike_it = strike_plate()
    wall = f"compute w all hvi/wall axis z wall 2 {-2 * EDGE} {2 * EDGE} nodes 3 layers 4 pieces {REACH}\n"
    table = lmp(start(mesh, every=5) + wall + "thermo_style custom step c_w[1][34] c_w[1][30] c_w[1][32]\n" + strike_it + "run 10\n", nranks=nranks).thermo
    mass = 2703.0 * DX**3 * ((mesh.n > 0).sum() * mesh.per_edge**3 + (mesh.free_type == 2).sum())
    assert table["c_w[1][34]"] == pytest.approx(mass, rel=1e-9)
    assert not table["c_w[1][30]"].any() and not table["c_w[1][32]"].any()


LOOK = """compute state all hvi/atom p e eps sxx syy szz sxy sxz syz damage voids void_damage vm
compute most all reduce max c_state[*]
compute sum all reduce sum vx vy vz
compute ke all ke
compute w all hvi/wall axis z wall 2 {low} {high} nodes 3 layers 4
variable power equal c_w[1][6]
fix first all ave/time 7 1 7 c_most[*] c_sum[*] c_ke v_power file first format " %.17g"
"""


@pytest.mark.parametrize("nranks", [1, 2])
def test_looked_at_by_fixes(lmp, nranks):
    """The same numbers by fix ave/time at steps without thermo output as at steps that have some, wherever the fix is; the run goes the same way"""
    mesh, strike_it = strike_plate()
    got = {}
    for every in (7, 100):
        text = start(mesh, every=every, fem="strain 0.1")
        for line in ("compute book", "compute state", "thermo_style", "thermo_modify"):  # the book's energies are tallied, which tells of the step
            text = "".join(row for row in text.splitlines(True) if not row.startswith(line))
        look = LOOK.format(low=-2 * EDGE, high=2 * EDGE)
        text = text.replace("fix wall all", look + "fix wall all", 1) + look.splitlines()[-1].replace("first", "last") + "\n" + strike_it
        lmp(text + "run 28\n" + STATE.format("state"), nranks=nranks)
        got[every] = {name: np.loadtxt(name) for name in ("first", "last")}, read_state("state")
    often, seldom = got[7][0], got[100][0]
    assert often["first"].shape == (5, 19) and (np.abs(often["first"][-1, [13, 16, 17, 18]]) > 0).all()
    for name in ("first", "last"):
        assert np.array_equal(often["last"], seldom[name]), name
    assert all(np.array_equal(got[7][1][k], got[100][1][k]) for k in got[7][1])
