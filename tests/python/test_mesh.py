"""python3 -m hvi mesh: hexahedra with particles, as they stand in data files; shapes, volumes, what is refused."""

import re

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.io.data import DataFile
from hvi.model import mesh, mesh_plate
from scipy.spatial import cKDTree

FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]
PLATES = {
    "square": dict(side=8.0),
    "rectangle": dict(side=(8.0, 5.0), layers=3, center=(2.0, -1.0), bottom=-3.0),
    "core": dict(side=16.0, core=2.0, hold=4.0, growth=1.2, largest=2.0),
    "plain": dict(side=12.0, n=0, hold=2.0, growth=1.3),
    "round": dict(radius=8.0),
    "round core": dict(radius=9.0, core=2.0, hold=3.5, growth=1.25, largest=1.0, n=3),
    "O-grid": dict(side=30.0, core=3.0, hold=5.0, growth=1.2, largest=3.0, circle=True),
    "O-grid, all held": dict(side=12.0, core=2.0, circle=True),
    "round O-grid": dict(radius=12.0, core=3.0, hold=5.0, growth=1.2, largest=3.0, circle=True, n=3),
}


def plate(name, **change):
    return mesh_plate.plate(**{**dict(thickness=1.0, element=0.5), **PLATES[name], **change})


def sections(path):
    """Numbers of a data file: {section: table}, and the lines above"""
    head, *rest = re.split(r"^(Masses|Atoms # sph|Elements)$", path.read_text(), flags=re.M)
    return {name: np.array([line.split() for line in text.split("\n") if line], dtype=float) for name, text in zip(rest[::2], rest[1::2])}, head


def divergence(corners):
    """Volume of hexahedra: x.n over their bilinear faces, by Gauss's rule 2 x 2, exact"""
    total = 0.0
    for face in FACES:
        a, b, c, d = (corners[:, k] for k in face)
        for u in (-(3**-0.5), 3**-0.5):
            for v in (-(3**-0.5), 3**-0.5):
                x = 0.25 * ((1 - u) * (1 - v) * a + (1 + u) * (1 - v) * b + (1 + u) * (1 + v) * c + (1 - u) * (1 + v) * d)
                xu = 0.25 * ((1 - v) * (b - a) + (1 + v) * (c - d))
                xv = 0.25 * ((1 - u) * (d - a) + (1 + u) * (c - b))
                total = total + (x * np.cross(xu, xv)).sum(axis=1) / 3
    return total


def owners(elements):
    faces = np.sort(np.concatenate([elements[:, face] for face in FACES]), axis=1)
    return np.unique(faces, axis=0, return_counts=True)


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_weights(n):
    w = mesh.weights(n)
    assert w.shape == (n**3, 8) and w.sum(axis=1) == pytest.approx(1) and (w > 0).all()
    assert w.sum(axis=0) == pytest.approx(np.full(8, n**3 / 8), rel=1e-14)
    x = w @ (mesh.CORNERS * 0.5 + 0.5)
    assert x == pytest.approx((np.indices((n, n, n)).reshape(3, -1, order="F").T + 0.5) / n)  # x fastest


@pytest.mark.parametrize("name", PLATES)
def test_file(name, tmp_path):
    """Every number of the file: IDs, types, densities, places; elements name their nodes and their first particle"""
    made = plate(name, type=3)
    made.write(tmp_path / "w.data", 2.5, "w")
    found, head = sections(tmp_path / "w.data")
    atoms, rows = found["Atoms # sph"], found["Elements"].astype(int)
    assert f"\n{len(atoms)} atoms\n2 atom types\n{len(rows)} elements\n" in head and head.startswith("LAMMPS data file: mesh w, mirror none\n")
    assert list(found["Masses"][:, 0]) == [3, 4]
    assert (atoms[:, 0] == np.arange(1, len(atoms) + 1)).all() and (rows[:, 0] == np.arange(1, len(rows) + 1)).all()
    nodes = atoms[:, 1] == 4
    count = nodes.sum()
    assert nodes[:count].all() and (atoms[nodes, 2] == 0).all() and (atoms[~nodes, 2] == 2.5).all() and (atoms[:, 3:5] == 0).all()
    assert (rows[:, 1] == 3).all() and set(rows[:, 2:10].ravel()) == set(range(1, count + 1))  # no node without an element
    n = PLATES[name].get("n", 2)
    holds = rows[:, 10] > 0
    assert (rows[holds, 10] == n).all() and (rows[~holds, 11] == 0).all()
    assert (rows[holds, 11] == count + 1 + n**3 * np.arange(holds.sum())).all()
    x = atoms[:, 5:]
    for row in rows[holds][::7]:
        corners, at = x[row[2:10] - 1], 0
        for k in range(n):
            for j in range(n):
                for i in range(n):
                    xi = (2 * np.array([i, j, k]) + 1) / n - 1
                    want = sum(np.prod(1 + s * xi) / 8 * c for s, c in zip(mesh.CORNERS, corners))
                    assert x[row[11] - 1 + at] == pytest.approx(want, abs=1e-12)
                    at += 1
    free = atoms[count + n**3 * holds.sum():]
    volume = divergence(x[rows[:, 2:10] - 1])
    assert (volume > 0).all()
    total = volume.sum() * 2.5 + len(free) * found["Masses"][0, 1]
    assert total == pytest.approx(2.5 * made.quality()["volume"], rel=1e-12)
    box = np.array([line.split()[:2] for line in head.split("\n") if "lo " in line], dtype=float)
    assert (x > box[:, 0]).all() and (x < box[:, 1]).all()


@pytest.mark.parametrize("name", PLATES)
def test_shapes(name):
    """Volume of the plate; each inner face is of two elements, the outer ones are the plate's; corners are open"""
    made, keys = plate(name), PLATES[name]
    found = made.quality()
    assert found["volume_over_exact"] == pytest.approx(1.0, abs=1e-12 if "side" in keys else 5e-3)
    if "side" in keys:
        assert found["volume"] == pytest.approx(np.prod(np.broadcast_to(keys["side"], 2)))
    assert found["min_scaled_jacobian"] > (0.3 if "circle" in keys or "radius" in keys else 1 - 1e-9)
    assert found["largest_growth"] < 1.7
    faces, count = owners(made.elements)
    assert count.max() == 2
    middle = made.nodes[faces[count == 1]].mean(axis=1) - [*keys.get("center", (0, 0)), keys.get("bottom", 0.0)]
    outside = (np.abs(middle[:, 2]) < 1e-9) | (np.abs(middle[:, 2] - 1) < 1e-9)
    if "side" in keys:
        half = np.broadcast_to(keys["side"], 2) / 2
        outside |= (np.abs(np.abs(middle[:, :2]) - half) < 1e-9).any(axis=1)
    else:
        outside |= np.hypot(*middle.T[:2]) > 0.99 * keys["radius"]
    core = keys.get("core", 0.0)
    assert (np.hypot(*middle[~outside].T[:2]) < core + 0.5).all() and (core > 0) == (not outside.all())
    held = made.corners[made.n > 0].mean(axis=1)[:, :2] - keys.get("center", (0, 0))
    assert len(held) == 0 or np.hypot(*held.T).max() < keys.get("hold", np.inf)
    if keys.get("n", 2):
        assert found["smallest_embedded_spacing"] > 0.5 * 0.5 / keys.get("n", 2)


@pytest.mark.parametrize("name", [name for name in PLATES if "center" not in PLATES[name]])
def test_quarter_with_its_mirrors_is_whole(name):
    whole, part = plate(name), plate(name, quarter=True)
    assert "x 0 lo mirror y 0 lo" in part.mirror
    assert (part.nodes[:, :2] >= 0.0).all() and ((part.nodes[:, 0] == 0.0).sum() == (part.nodes[:, 1] == 0.0).sum() > 3)
    signs = np.array([(1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, 1)])
    for a, b in ((whole.nodes, part.nodes), (whole.free, part.free), (whole.corners.mean(axis=1), part.corners.mean(axis=1)),
                 (whole.embedded.reshape(-1, 3), part.embedded.reshape(-1, 3))):
        images = np.unique(np.round((b[:, None] * signs + 0.0).reshape(-1, 3), 9) + 0.0, axis=0)
        assert images == pytest.approx(np.unique(np.round(a, 9) + 0.0, axis=0), abs=2e-9)
    assert len(whole.elements) == 4 * len(part.elements) and len(whole.free) == 4 * len(part.free)
    assert part.quality()["volume_over_exact"] == pytest.approx(whole.quality()["volume_over_exact"])
    if len(whole.free):
        assert part.masses(2.5)[1] == pytest.approx(whole.masses(2.5)[1])


@pytest.mark.long
def test_graded():
    """Sizes rise by one ratio up to the largest, and fill the length; along an axis of a plate they do, too"""
    sizes = mesh_plate.graded(138.0, 0.5, 1.2, 5.0)
    assert sizes.sum() == pytest.approx(138) and sizes[0] > 0.5 and sizes.max() == pytest.approx(5, rel=0.02)
    assert (np.diff(sizes) > -1e-12).all() and (sizes[1:] / sizes[:-1]).max() <= 1.2 + 1e-9 and sizes[0] <= 0.6
    assert mesh_plate.graded(3.1, 0.5, 1.0, 5.0) == pytest.approx(np.full(6, 3.1 / 6))
    for name in ("core", "plain", "O-grid", "round O-grid"):
        made = plate(name)
        x = np.unique(np.round(made.nodes[(np.abs(made.nodes[:, 1]) < 1e-9) & (made.nodes[:, 0] > PLATES[name]["hold"] - 0.6), 0], 9))
        assert (np.diff(x, 2) > -1e-9).all() and np.diff(x)[-1] > 1.3 * np.diff(x)[0], name
    assert len(mesh_plate.plate(1.0, 0.5, side=300.0, core=8.0, hold=12.0, circle=True, growth=1.2, largest=8.0, quarter=True).elements) < 2500


@pytest.mark.parametrize("name", ["O-grid", "round O-grid"])
def test_circular_core(name):
    """Nodes on the circle; equal masses that fill the polygon; no gap, nothing too close, also to particles of elements"""
    made = plate(name)
    n = PLATES[name].get("n", 2)
    r = np.hypot(*made.nodes[:, :2].T)
    on = np.abs(r - 3) < 1e-12
    assert r.min() > 3 - 1e-12 and on.sum() % 24 == 0
    z = made.free[:, 2].min()
    sheet = made.free[np.abs(made.free[:, 2] - z) < 1e-9, :2]
    assert len(made.free) == len(sheet) * 2 * n
    sectors = on.sum() // 3
    assert made.free_volume.sum() == pytest.approx(sectors / 2 * 9 * np.sin(2 * np.pi / sectors))
    spacing = 0.5 / n
    assert made.free_volume[0] == pytest.approx(spacing**3, rel=0.01)
    held = made.embedded.reshape(-1, 3)
    both = np.concatenate([sheet, held[np.abs(held[:, 2] - z) < 1e-9, :2]])
    near = cKDTree(both).query(both, k=2)[0][:, 1]
    assert near.min() > 0.7 * spacing
    points = np.random.default_rng(4).uniform(-3.3, 3.3, (20000, 2))
    assert cKDTree(both).query(points)[0].max() < 0.95 * spacing  # of a square lattice 0.707
    inner = np.hypot(*sheet.T) < 3 - 5 * spacing
    assert (sheet[inner] / spacing + 0.5) == pytest.approx(np.round(sheet[inner] / spacing + 0.5), abs=1e-9)  # a lattice


def test_block():
    """Cells by mask, places by map; free particles at the centers of their subcells; two materials"""
    kind = np.ones((6, 4, 3), dtype=int)
    kind[3:] = 2
    made = mesh.block(6, 4, 3, lambda x: 0.5 * x + [1, 0, 0], n=2, free=lambda c: (c[:, 0] > 3) & (c[:, 1] < 1.5), holds=lambda c: c[:, 0] > 2,
                      empty=lambda c: c[:, 1] > 1.5, type=kind)
    assert len(made.elements) == 4 * 3 * 3 and len(made.free) == 2 * 3 * 3 * 8 and made.node_type == 3
    held = made.corners.mean(axis=1)[:, 0] > 2
    assert ((made.n == 2) == held).all() and (made.type == np.where(made.corners.mean(axis=1)[:, 0] > 2.5, 2, 1)).all()
    assert (made.free_type == 2).all() and made.free_volume == pytest.approx(0.25**3)
    assert made.free.min(axis=0) == pytest.approx([3.125, 0.125, 0.125]) and made.free.max(axis=0) == pytest.approx([3.875, 1.375, 1.375])
    assert made.nodes.max(axis=0) == pytest.approx([3, 1.5, 1.5])
    assert made.masses(4.0) == pytest.approx({1: 4 * 0.25**3, 2: 4 * 0.25**3, 3: 4 * 36 * 0.125 / len(made.nodes)})
    assert made.quality()["volume"] == pytest.approx(6 * 3 * 3 * 0.125)
    swirl = mesh.block(4, 4, 4, lambda x: x + 0.1 * np.sin(x[:, [1, 2, 0]]), n=3)
    assert mesh.volumes(swirl.corners) == pytest.approx(divergence(swirl.corners), rel=1e-12)
    assert swirl.quality()["min_scaled_jacobian"] < 0.999


def test_periodic_block(tmp_path):
    made = mesh.block(3, 4, 5, (0.5, 0.25, 1.0), n=2, periodic=(False, True, True))
    assert len(made.nodes) == 4 * 4 * 5 and len(made.elements) == 60
    assert mesh.volumes(made.corners) == pytest.approx(0.125)
    assert (owners(made.elements)[1] == 1).sum() == 2 * 20  # only those at the ends of x
    made.write(tmp_path / "p.data", 1.0)
    found, head = sections(tmp_path / "p.data")
    assert "\n0 1 ylo yhi\n0 5 zlo zhi\n" in head
    x = found["Atoms # sph"][:, 5:]
    assert (x[:, 1:] >= 0).all() and (x[:, 1:] < [1, 5]).all() and len(x) == 80 + 480
    mesh.block(3, 4, 5, n=2, free=np.ones((3, 4, 5), bool)).write(tmp_path / "free.data", 1.0)
    found, head = sections(tmp_path / "free.data")
    assert "elements" not in head and list(found) == ["Masses", "Atoms # sph"]  # LAMMPS knows no header "elements" without fix hvi/fem
    held = np.unique(np.round(x[80:], 9), axis=0)
    assert len(held) == 480 and held[0] == pytest.approx([0.125, 0.0625, 0.25]) and held[-1] == pytest.approx([1.375, 0.9375, 4.75])


@pytest.mark.parametrize("change, message", [
    (dict(thickness=0.0), "thickness > 0"), (dict(layers=0), "at least one layer"), (dict(element=9.0), "elements that fit"),
    (dict(radius=8.0), "square .side. or round"), (dict(side=None), "square .side. or round"), (dict(n=-1), "0 or more, not -1"),
    (dict(n=0, core=2.0), "1 or more with a core"), (dict(growth=1.2), "grow beyond the radius"), (dict(growth=0.5), "ratio from 1 to 2"),
    (dict(growth=1.2, hold=2.0, largest=0.1), "at least 0.5"), (dict(core=2.0, hold=2.1), "at least up to 2.75"),
    (dict(core=2.0, hold=3.2, n=1), "at least up to 3.25"), (dict(core=7.9), "at least up to 8.65"), (dict(circle=True), "as wide as an element"),
    (dict(circle=True, core=2.0, side=(16.0, 12.0)), "not in a rectangle"), (dict(quarter=True, center=(1.0, 0.0)), "around 0 0"),
    (dict(side=None, radius=2.0, core=1.0), "no room around"), (dict(type=2, node_type=2), "a type of their own: 2")], ids=str)
def test_wrong_plates(change, message, tmp_path):
    with pytest.raises(hvi.HVIError, match=message):
        mesh_plate.plate(**{**dict(thickness=1.0, element=0.5, side=16.0), **change}).write(tmp_path / "w.data", 1.0)


@pytest.mark.parametrize("make, message", [
    (lambda: mesh.block(2, 0, 1), "at least 1 cell"), (lambda: mesh.block(2, 4, 4, periodic=(True, False, False)), "3 where it is periodic"),
    (lambda: mesh.block(2, 2, 2, free=np.ones((2, 2), dtype=bool)), "shape .2, 2, 2., not .2, 2."),
    (lambda: mesh.block(2, 2, 2, n=0, free=lambda c: c[:, 0] > 1), "1 or more"),
    (lambda: mesh.block(3, 3, 3, lambda x: x * (1 + x[:, :1]), periodic=(False, True, False)), "same nodes on both sides"),
    (lambda: mesh.block(2, 2, 2, free=lambda c: c[:, 0] > 1, empty=lambda c: c[:, 0] > 1), "not empty"),
    (lambda: mesh.block(2, 1, 1, lambda x: x * [-1, 1, 1]).check(), "2 elements are turned inside out or flat; the first is number 1"),
    (lambda: mesh.block(2, 1, 1, lambda x: x**2, free=lambda c: c[:, 0] > 0).masses(1.0), "cells of free particles must be of one size"),
    (lambda: mesh.block(2, 1, 1, empty=lambda c: c[:, 0] > 0).check(), "without elements")], ids=str)
def test_wrong_blocks(make, message):
    with pytest.raises(hvi.HVIError, match=message):
        make()


def test_more_wrong_meshes():
    made = mesh.block(2, 1, 1)
    made.n[0] = 3
    with pytest.raises(hvi.HVIError, match="the same number, not n = 2 3"):
        made.check()
    made = mesh.block(2, 1, 1)
    made.elements = made.elements[[0, 1, 1]]
    made.type, made.n = np.ones(3, dtype=int), np.full(3, 2)
    with pytest.raises(hvi.HVIError, match="three elements have a face in common"):
        mesh.neighbors(np.concatenate([made.elements, made.elements[1:2]]))


def test_command_and_lammps(lmp, root, tmp_path, capsys):
    """What the command prints is what LAMMPS reads; a second wall with types of its own is appended"""
    material = str(root / "potentials" / "Al2024-T3.hvi")
    words = ["--thickness", "1e-3", "--element", "0.5e-3", "--core", "2e-3", "--hold", "3e-3", "--circle", "--quarter", "--material", material]
    assert cli.main(["mesh", "a.data", "--side", "12e-3", *words]) == 0
    said = dict(line.split(": ") for line in capsys.readouterr().out.splitlines() if ": " in line)
    assert cli.main(["mesh", "b.data", "--radius", "6e-3", "--type", "3", "--bottom", "5e-3", *words]) == 0
    for name in "ab":  # without the section that is fix hvi/fem's
        text = (tmp_path / f"{name}.data").read_text()
        (tmp_path / f"{name}.plain").write_text(re.sub(r"^\d+ elements\n", "", text[:text.index("\nElements\n")], flags=re.M))
    result = lmp("""
        units si
        boundary s s s
        atom_style sph
        read_data a.plain extra/atom/types 2
        read_data b.plain add append
        group first type 1
        group second type 3
        variable n1 equal count(first)
        variable n3 equal count(second)
        variable nodes equal atoms-v_n1-v_n3
        variable m1 equal mass(first)
        print "found $(v_n1) $(v_n3) $(v_nodes) $(v_m1:%.8g)"
        """)
    n1, n3, nodes, m1 = map(float, re.search(r"^found (.*)$", result.stdout, re.M)[1].split())
    assert float(said["density"].split()[0]) == 2785 and float(said["volume_over_exact"]) == 1
    assert n1 == int(said["embedded_particles"]) + int(said["free_particles"])
    frames = [DataFile(f"{name}.data").frame() for name in "ab"]
    assert n3 == (frames[1]["type"] == 3).sum() and nodes == sum((f["type"] == k).sum() for f, k in zip(frames, (2, 4)))
    assert m1 == pytest.approx(DataFile("a.data").masses[1] * n1)


@pytest.fixture
def meshio():
    return pytest.importorskip("meshio", reason="meshio is not there (Debian: python3-meshio)")


def written(meshio, path, change=None, cells=None, sets=None):
    """12 cubes in two blocks, with a surface and a node of nobody; the fourth is numbered inside out"""
    made = mesh.block(3, 2, 2)
    elements = made.elements.copy()
    elements[3] = elements[3][[4, 5, 6, 7, 0, 1, 2, 3]]
    points = np.vstack([[[9, 9, 9]], made.nodes])
    if change:
        change(points, elements)
    elements += 1
    cells = cells or [("hexahedron", elements[:8]), ("quad", elements[:1, :4]), ("hexahedron", elements[8:])]
    meshio.Mesh(points, cells, cell_sets=sets or {}).write(path)


@pytest.mark.parametrize("kind", ["inp", "vtk", "vtu", "msh"])
def test_import(meshio, kind, tmp_path, capsys):
    written(meshio, tmp_path / f"a.{kind}")
    assert cli.main(["mesh", "w.data", "--import", f"a.{kind}", "--scale", "0.5", "--move", "1", "0", "0", "--density", "2", "--particles", "3"]) == 0
    said = dict(line.split(": ") for line in capsys.readouterr().out.splitlines() if ": " in line)
    assert said["elements that were inside out"] == "1" and said["nodes"] == "36" and float(said["mass"]) == 3
    found, _ = sections(tmp_path / "w.data")
    rows, x = found["Elements"].astype(int), found["Atoms # sph"][:, 5:]
    assert divergence(x[rows[:, 2:10] - 1]) == pytest.approx(np.full(12, 0.125)) and (rows[:, 10] == 3).all()
    assert x[:36].min(axis=0) == pytest.approx([1, 0, 0]) and x[:36].max(axis=0) == pytest.approx([2.5, 1, 1])


def test_import_of_a_set(meshio, tmp_path, capsys):
    """Elements of a set hold particles; sets that meshio does not tell rightly are refused"""
    def sets(*rows):
        return {"STRUCK": [np.array(r, dtype=int) for r in rows]}

    words = ["mesh", "w.data", "--import", "a.inp", "--set", "STRUCK", "--density", "2"]
    written(meshio, tmp_path / "a.inp", sets=sets([], [], [1, 2]))
    assert cli.main(words) == 0
    rows = sections(tmp_path / "w.data")[0]["Elements"].astype(int)
    assert list(np.flatnonzero(rows[:, 10])) == [9, 10]
    capsys.readouterr()
    written(meshio, tmp_path / "a.inp", sets=sets([1], [], [1, 2]))
    assert cli.main(words) == 1 and "in one *ELSET of that name" in capsys.readouterr().err
    text = (tmp_path / "a.inp").read_text()
    text = text[:text.index("*ELSET")]
    at = text.rindex("*ELEMENT")
    (tmp_path / "a.inp").write_text(text[:at] + re.sub(r"(\*ELEMENT.*)", r"\1, ELSET=STRUCK", text[at:]))
    assert cli.main(words) == 1 and "in one *ELSET of that name" in capsys.readouterr().err
    assert cli.main([*words[:-4], "--set", "OTHER", "--density", "2"]) == 1 and "no set of cells OTHER, but STRUCK" in capsys.readouterr().err


@pytest.mark.parametrize("change, cells, message", [
    (lambda x, e: x.__setitem__(e[5, 6] + 1, [0.9, 0.9, -3]), None, "turned inside out or flat"),
    (lambda x, e: e.__setitem__((2, 3), e[2, 2]), None, "1 hexahedra have a node twice, the first is number 3"),
    (None, [("tetra", [[1, 2, 4, 9]])], "not tetra"), (None, [("quad", [[1, 2, 5, 4]])], "not a mesh without any")], ids=str)
def test_wrong_imports(meshio, change, cells, message, tmp_path, capsys):
    written(meshio, tmp_path / "a.vtu", change, cells)
    assert cli.main(["mesh", "w.data", "--import", "a.vtu", "--density", "2"]) == 1
    assert message in capsys.readouterr().err and not (tmp_path / "w.data").exists()


@pytest.mark.parametrize("words, message", [
    (["--import", "no.vtu"], "cannot read no.vtu as a mesh"), (["--import", "a.vtu", "--core", "1"], "--core is of plates"),
    (["--side", "8", "--thickness", "1"], "needs --element"), (["--radius", "8", "--element", "1"], "needs --thickness"),
    (["--side", "8", "--thickness", "1", "--element", "1", "--scale", "2"], "--scale is of imported meshes"),
    (["--side", "8", "--thickness", "1", "--element", "1", "--circle"], "as wide as an element")], ids=str)
def test_wrong_commands(words, message, meshio, tmp_path, capsys):
    assert cli.main(["mesh", "w.data", *words, "--density", "2"]) == 1
    assert message in capsys.readouterr().err and not (tmp_path / "w.data").exists()


def test_without_meshio(monkeypatch, capsys):
    monkeypatch.setitem(__import__("sys").modules, "meshio", None)
    assert cli.main(["mesh", "w.data", "--import", "a.vtu", "--density", "2"]) == 1
    assert "python3-meshio" in capsys.readouterr().err
