"""python3 -m hvi body, and plate --fill glass: exact mass and center, even places, smooth surfaces."""

import functools

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.model import bodies
from scipy.spatial import cKDTree

SHAPES = {
    "sphere": (bodies.sphere(8.0), 4 / 3 * np.pi * 512),
    "quarter of a sphere": (bodies.sphere(8.0, quarter=True), np.pi * 512 / 3),
    "hollow sphere": (bodies.sphere(8.0, 4.5), 4 / 3 * np.pi * (512 - 4.5**3)),
    "cylinder": (bodies.cylinder(6.0, 9.3), np.pi * 36 * 9.3),
    "tube": (bodies.cylinder(7.0, 8.0, 3.0), np.pi * 40 * 8),
    "box": (bodies.box([9.0, 11.0, 7.5]), 9 * 11 * 7.5),
    "plate": (bodies.cylinder(15.0, 2.0, middle=1.0), np.pi * 450),
    "one layer": (bodies.cylinder(15.0, 1.0, middle=0.5, quarter=True), np.pi * 225 / 4),
    "periodic": (bodies.box([6.0, 5.0, 9.0], periodic=(0, 1)), 270.0),
}
LONG = "cylinder", "tube", "one layer"  # as glass; in the short form these are lattices, and the others are none


@functools.lru_cache(None)
def filled(name, fill):
    return bodies.make(SHAPES[name][0], 1.0, fill)


def whole(body):
    """with what mirrors and periodic sides add, up to 4 spacings"""
    x = body.x
    for k in body.shape.planes:
        x = np.concatenate([x, x * np.where(np.arange(3) == k, -1, 1)])
    for k in body.shape.endless:
        wide = (body.shape.high - body.shape.low)[k] * (np.arange(3) == k)
        x = np.concatenate([x, x + wide, x - wide])
    return x


@pytest.mark.parametrize("name, fill", [pytest.param(name, fill, marks=[pytest.mark.long] * ((fill == "lattice") != (name in LONG))) for name in SHAPES for fill in ("glass", "lattice")])
def test_mass_and_center_are_exact(name, fill):
    shape, volume = SHAPES[name]
    body = filled(name, fill)
    assert body.volume * len(body.x) == pytest.approx(volume, rel=1e-14)
    if fill == "glass":
        assert len(body.x) == round(volume)
    middle = body.x.mean(axis=0)
    wanted = [0.0, 0.0, {"plate": 1.0, "one layer": 0.5}.get(name, 0.0)]
    known = [k for k in range(3) if k not in shape.planes and k not in shape.endless]  # the others are right by symmetry
    assert middle[known] == pytest.approx(np.array(wanted)[known], abs=1e-12)
    r, z = np.linalg.norm(body.x, axis=1), body.x[:, 2]
    rho = np.hypot(*body.x[:, :2].T)
    inside = {"sphere": r < 8, "quarter of a sphere": (r < 8) & (body.x[:, :2] > 0).all(axis=1), "hollow sphere": (4.5 < r) & (r < 8),
              "cylinder": (rho < 6) & (abs(z) < 4.65), "tube": (3 < rho) & (rho < 7) & (abs(z) < 4),
              "box": (abs(body.x) < [4.5, 5.5, 3.75]).all(axis=1), "plate": (rho < 15) & (0 < z) & (z < 2),
              "one layer": (rho < 15) & (0 < z) & (z < 1) & (body.x[:, :2] > 0).all(axis=1),
              "periodic": (abs(body.x) <= [3, 2.5, 4.5]).all(axis=1)}[name]
    assert inside.all()


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.long] * (name in LONG)) for name in SHAPES])
def test_glass_is_even(name):
    """nobody is near another; the kernel's density is that of the body; the outermost layer is smooth"""
    body = filled(name, "glass")
    near = cKDTree(whole(body)).query(body.x, k=2)[0][:, 1] / body.spacing
    assert near.min() > 0.6 and 0.94 < near.mean() < 1.03 and near.std() < 0.07
    found = bodies.measure(body)
    assert found["nearest_min"] == pytest.approx(near.min()) and found["nearest_spread"] == pytest.approx(near.std())
    if "density_inside" in found:
        assert abs(found["density_inside"] - 1) < 0.015 and found["density_inside_spread"] < 0.01
    if "density_face_spread" in found:
        assert found["density_face_spread"] < (0.15 if name in ("hollow sphere", "tube") else 0.08)  # outside and inside differ
        assert found["face_depth_spread"] < 0.15 and found["face_depth_min"] > 0.25
    else:
        assert name == "box"  # too small to have what is far from all edges


def test_measure_by_hand():
    """density by the sum over all pairs, and what a lattice in a box has"""
    shape = bodies.sphere(4.5)
    body = bodies.make(shape, 1.0)
    q = np.linalg.norm(body.x[:, None] - body.x, axis=-1) / (1.6 * body.spacing)
    density = np.where(q < 2, 21 / (16 * np.pi * 1.6**3) * (1 - q / 2) ** 4 * (2 * q + 1), 0).sum(axis=1)
    outer = np.linalg.norm(body.x, axis=1) > 4.5 - body.spacing
    found = bodies.measure(body)
    assert found["density_face_spread"] == pytest.approx(density[outer].std() / density[outer].mean())
    deep = 4.5 - np.linalg.norm(body.x, axis=1) > 3.2 * body.spacing
    assert found["density_inside"] == pytest.approx(density[deep].mean())
    found = bodies.measure(bodies.make(bodies.box([9, 9, 9]), 1.0, "lattice"))
    assert found["nearest_min"] == pytest.approx(1) and found["density_inside_spread"] < 1e-12 and found["face_depth_min"] == pytest.approx(0.5)


def test_a_lattice_sphere_has_a_rough_surface():
    """what the glass is for: the outermost layer of a lattice is steps"""
    lattice, glass = (bodies.measure(filled("sphere", fill)) for fill in ("lattice", "glass"))
    assert lattice["density_face_spread"] > 4 * glass["density_face_spread"]
    assert lattice["face_depth_spread"] > 4 * glass["face_depth_spread"]


def test_no_rows():
    """the structure factor of a lattice is N at its reciprocal vectors; that of the glass is nowhere near, in no direction"""
    lattice, glass = (filled("sphere", fill).x for fill in ("lattice", "glass"))
    rng = np.random.default_rng(2)
    way = rng.normal(size=(400, 3))
    way = np.concatenate([np.eye(3), way / np.linalg.norm(way, axis=1)[:, None]])
    waves = np.concatenate([k * way for k in 2 * np.pi * np.linspace(0.9, 1.3, 9)])
    peak = [max(abs(np.exp(1j * (x @ w)).mean()) ** 2 for w in waves) for x in (lattice, glass)]
    assert peak[0] > 0.9 and peak[1] < 0.1


def test_same_seed_same_places_and_another_seed_others():
    shape = bodies.cylinder(4.0, 5.0)
    one = bodies.make(shape, 1.0).x
    assert (bodies.make(shape, 1.0, seed=1).x == one).all()
    assert np.abs(bodies.make(shape, 1.0, seed=2).x - one).max() > 0.1


def test_units_do_not_matter():
    one, other = bodies.make(bodies.sphere(5.0), 1.0).x, bodies.make(bodies.sphere(5e-3), 1e-3).x
    assert np.abs(1e3 * other - one).max() < 0.05  # rounding grows while it relaxes


@pytest.mark.parametrize("make, message", [
    (lambda: bodies.make(bodies.sphere(-1.0), 1.0), "radius > 0"), (lambda: bodies.make(bodies.sphere(1.0, 1.0), 0.1), "inner radius"),
    (lambda: bodies.make(bodies.box([1, 0, 1]), 0.1), "size in y > 0"), (lambda: bodies.make(bodies.cylinder(2, np.inf), 0.1), "length > 0"),
    (lambda: bodies.make(bodies.sphere(1.0), 0.0), "spacing > 0"), (lambda: bodies.make(bodies.sphere(1.0), 0.9), "fewer than 8"),
    (lambda: bodies.make(bodies.sphere(2.0), 1.0), "surface is not smooth"),
    (lambda: bodies.make(bodies.sphere(1.0), 3.0), "at least as thick"), (lambda: bodies.make(bodies.sphere(5.0, 4.5), 1.0), "at least as thick"),
    (lambda: bodies.make(bodies.sphere(1.0), 1e-4), "units of the body"),
    (lambda: bodies.make(bodies.box([2, 5, 5], periodic=(0,)), 1.0), "3 spacings wide, 3, in x"),
    (lambda: bodies.box([5, 5, 5], quarter=True, periodic=(0,)), "not periodic there")])
def test_wrong_bodies(make, message):
    with pytest.raises(hvi.HVIError, match=message):
        make()


@pytest.mark.parametrize("words, message", [
    ("--shape sphere --size 1 2 3", "a sphere has --radius and may have --inner"), ("--shape box --radius 3", "a box has --size"),
    ("--shape cylinder --radius 3", "--radius and --length"), ("--shape sphere --radius 3 --length 3", "nothing else"),
    ("--shape sphere --radius 3 --periodic x", "for boxes")])
def test_wrong_words(words, message, capsys):
    assert cli.main(["body", "b.data", *words.split(), "--spacing", "1", "--density", "1"]) == 1
    assert message in capsys.readouterr().err
    plate = ["plate", "p.data", "--radius", "5", "--thickness", "2", "--spacing", "1", "--density", "1", "--fill", "glass"]
    assert cli.main([*plate, "--angles", "45"]) == 1 and "a plate of glass has no" in capsys.readouterr().err
    assert cli.main([*plate, "--layers", "2"]) == 1 and "a plate of glass has no" in capsys.readouterr().err


@pytest.mark.parametrize("quarter", [False, True])
def test_lammps_reads_them(quarter, lmp, root, capsys):
    """a hollow sphere and a plate of glass in one box: masses, places, and the density of the kernel that was promised"""
    more = ["--quarter"] if quarter else []
    assert cli.main(["body", "ball.data", "--shape", "sphere", "--radius", "8e-3", "--inner", "2e-3", "--spacing", "1e-3",
                     "--material", str(root / "potentials" / "Al6061-T6.hvi"), *more]) == 0
    assert "particles: " in capsys.readouterr().out
    assert cli.main(["plate", "wall.data", "--radius", "9e-3", "--thickness", "2e-3", "--spacing", "1e-3", "--fill", "glass",
                     "--density", "2703", *more]) == 0
    share = 4 if quarter else 1
    masses = [2703 * np.pi * v / share for v in (4 / 3 * (8e-3**3 - 2e-3**3), 9e-3**2 * 2e-3)]
    low = 0 if quarter else -0.02
    mirror = "mirror x 0 lo mirror y 0 lo" if quarter else ""
    r = lmp(f"""units si
atom_style sph
atom_modify map array
boundary f f f
region box block {low} 0.02 {low} 0.02 -0.02 0.02
create_box 2 box
read_data ball.data add append shift 0 0 -0.008 group ball
read_data wall.data add append offset 1 0 0 0 0 group wall
pair_style hvi/sph wendland2 {mirror}
pair_coeff * * eos tait 2703 5000 7 h 1.6e-3
fix move all hvi/sph
run 0
print "mass $(mass(ball):%.15g) $(mass(wall):%.15g) $(xcm(ball,z):%.15g) $(xcm(wall,z):%.15g) $(bound(wall,zmin)) $(bound(wall,zmax))"
""")
    found = list(map(float, [line for line in r.log.splitlines() if line.startswith("mass ")][-1].split()[1:]))
    assert found[:2] == pytest.approx(masses, rel=1e-13)
    assert found[2:4] == pytest.approx([-8e-3, 1e-3], abs=1e-15)
    assert found[4] > 0.3e-3 and found[5] < 1.7e-3
