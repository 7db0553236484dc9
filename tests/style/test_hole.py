"""compute hvi/hole: plates with holes that are known.

Bounds, in particle spacings, set before anything was run: equal-area diameter 0.15 on average over plates, smallest and largest
diameter 1; 0.1 for what strays, debris and fragments change.
"""

import numpy as np
import pytest
from hole_scenes import THERMO, head, plate, radius, write_data
from scipy import ndimage

NAMES = "d dmin dmax x y area share layer reference dr found".split()
MEAN, EXTREME, CHANGE = 0.15, 1.0, 0.1


def values(thermo, name="h"):
    return dict(zip(NAMES, [thermo[f"c_{name}[{k}]"][0] for k in range(1, 12)]))


def measure(lmp, tmp_path, plates, keywords="", nranks=1):
    """what the compute says of each of these plates; all in one run"""
    text = ""
    for k, x in enumerate(plates):
        write_data(tmp_path / f"data.{k}", x)
        text += head(f"data.{k}") + f"compute h all hvi/hole axis z centre 0 0 plane 0 {keywords}" + THERMO.format("c_h[*]")
    r = lmp(text, nranks=nranks)
    return [values(t) for t in r.runs], r


def table(result, name):
    return np.array([r[name] for r in result])


# ---------------------------------------------------------------------- circles
@pytest.mark.parametrize("kind", ["sc", "turned", "fcc", "random"])
def test_circles(lmp, tmp_path, kind):
    """round and square plates, 3 to 8 layers, holes up to 80 % of the plate"""
    rng = np.random.default_rng(1)
    cases = [(5, 10), (5, 9), (6, 14), (7, 12), (8, 20), (10, 15), (12, 15), (14, 28), (16, 20), (20, 25), (30, 40), (40, 50)]
    layers = [3, 4, 5, 6, 7, 8, 4, 5, 6, 7, 8, 3]
    plates = [plate(kind, n, w, rng, ("round", "square")[k % 2]) for k, (n, (_, w)) in enumerate(zip(layers, cases))]
    plates = [x[radius(x) > r] for x, (r, _) in zip(plates, cases)]
    got, _ = measure(lmp, tmp_path, plates)
    d = 2.0 * np.array([r for r, _ in cases])
    off = {name: table(got, name) - d for name in ("d", "dmin", "dmax")}
    print(f"{kind}: mean |error| {abs(off['d']).mean():.4f}, mean of dmin {off['dmin'].mean():.4f}, of dmax {off['dmax'].mean():.4f}", {k: np.round(v, 2) for k, v in off.items()})
    assert abs(off["d"]).mean() <= MEAN
    if kind != "random":
        assert abs(off["d"].mean()) <= MEAN / 2
    for name in ("dmin", "dmax"):
        assert (abs(off[name]).mean() if kind == "random" else abs(off[name]).max()) <= EXTREME
    assert np.hypot(table(got, "x"), table(got, "y")).max() <= EXTREME / 2
    assert table(got, "area") == pytest.approx(np.pi / 4 * table(got, "d") ** 2, rel=1e-12)
    assert np.all(table(got, "share") == 1)
    assert table(got, "dr") == pytest.approx(1, abs=0.08)
    thick = np.array(layers) * (4 ** (1 / 3) / 2 if kind == "fcc" else 1)
    assert table(got, "reference") == pytest.approx(thick, rel=0.2 if kind == "random" else 0.1)
    assert np.all(table(got, "layer") > thick) and np.all(table(got, "layer") < 4 * thick)


@pytest.mark.parametrize("kind", [*(pytest.param(more, marks=pytest.mark.long) for more in ("sc", "turned")), "random"])
def test_other_shapes(lmp, tmp_path, kind):
    """ellipse, turned; a circle off the center by a third of its radius; and one that X,Y is not in"""
    rng = np.random.default_rng(2)
    radii = np.array([8, 10, 14, 20])
    ellipses, off, far = [], [], []
    for r in radii:
        x = plate(kind, 4, 2.2 * r, rng, "square")
        t = rng.uniform(0, np.pi)
        u = x[:, 0] * np.cos(t) + x[:, 1] * np.sin(t)
        v = x[:, 1] * np.cos(t) - x[:, 0] * np.sin(t)
        ellipses.append(x[(u / r) ** 2 + (v / (0.7 * r)) ** 2 > 1])
        off.append(x[radius(x, (r / 3, 0)) > r])
        far.append(x[radius(x, (0, -0.9 * r)) > r / 2])
    got, _ = measure(lmp, tmp_path, ellipses + off + far)
    e, o, f = got[:4], got[4:8], got[8:]
    assert abs(table(e, "d") - 2 * radii * 0.7**0.5).mean() <= MEAN
    assert abs(table(e, "dmin") - 1.4 * radii).max() <= EXTREME
    assert abs(table(e, "dmax") - 2 * radii).max() <= EXTREME
    assert abs(table(o, "d") - 2 * radii).mean() <= MEAN
    assert abs(table(o, "x") - radii / 3).max() <= 0.3 and abs(table(o, "y")).max() <= 0.3
    assert abs(table(f, "d") - radii).mean() <= MEAN
    assert abs(table(f, "y") + 0.9 * radii).max() <= 0.3 and abs(table(f, "x")).max() <= 0.3


def test_what_is_no_plate_does_not_count(lmp, tmp_path):
    """1 % strays in the hole, a fragment in its middle, debris in front and behind, some beyond the rim, all at once"""
    rng = np.random.default_rng(3)
    names = ["none", "strays", "fragment", "debris", "rim", "all"]
    plates = []
    for kind, r in (("sc", 6), ("turned", 10), ("random", 10), ("fcc", 16)):
        x = plate(kind, 5, 2 * r, rng, "square")
        rest, out = x[radius(x) > r], x[radius(x) < r]
        debris = out * [2.5, 2.5, 0] + [0, 0, 1] * rng.uniform(10, 150, (len(out), 1)) * rng.choice([1, -1, 1], (len(out), 1))
        extra = {"none": rest[:0], "strays": out[rng.random(len(out)) < 0.01], "fragment": out[radius(out) < 0.4 * r],
                 "debris": debris, "rim": rng.uniform(-1, 1, (20, 3)) * [9 * r, 9 * r, 2]}
        extra["rim"] = extra["rim"][radius(extra["rim"]) > 3 * r]
        extra["all"] = np.concatenate(list(extra.values()))
        plates += [np.concatenate([rest, extra[n]]) for n in names]
    got, _ = measure(lmp, tmp_path, plates)
    for k in range(0, len(got), len(names)):
        for name, r in zip(names, got[k:]):
            assert r["d"] == pytest.approx(got[k]["d"], abs=CHANGE), (k, name)
            assert r["dmin"] == pytest.approx(got[k]["dmin"], abs=3 * CHANGE), (k, name)
            assert r["dmax"] == pytest.approx(got[k]["dmax"], abs=3 * CHANGE), (k, name)


def test_cracks(lmp, tmp_path):
    """from the hole to the rim, narrow and wide, and a plate in three pieces"""
    x = plate("turned", 4, 20, np.random.default_rng(4))
    x = x[radius(x) > 10]
    angle = np.degrees(np.arctan2(x[:, 1], x[:, 0])) % 360
    right, y = x[:, 0] > 0, abs(x[:, 1])
    pieces = [angle < 120, (angle >= 120) & (angle < 240), angle >= 240]
    apart = [[np.cos(np.radians(a)), np.sin(np.radians(a)), 0] for a in (60, 180, 300)]
    plates = [x, x[~(right & (y < 0.6))], x[~(right & (y < 1))], x[~(right & (y < 3))], x[~(right & (y < 5))],
              np.concatenate([x[p] + a for p, a in zip(pieces, np.array(apart))])]
    got, r = measure(lmp, tmp_path, plates)
    d = table(got, "d") - 20
    assert abs(d[:3]).max() <= 2 * MEAN
    assert abs(d[3:5]).max() <= 2  # part of a crack may count, 6 and 10 wide
    assert 1 <= d[5] <= 2  # pieces moved by 1
    assert not [w for w in r.warnings if "hvi/hole" in w]


# ---------------------------------------------------------------------- no hole
def test_no_hole(lmp, tmp_path):
    rng = np.random.default_rng(5)
    plates = [plate(kind, n, 15, rng, s) for kind, n, s in
              [("sc", 1, "round"), ("sc", 3, "square"), ("turned", 5, "round"), ("fcc", 8, "round"), ("random", 5, "square")]]
    pit = plates[1][~((radius(plates[1]) < 7) & (plates[1][:, 2] > 0.5))]  # a third of the thickness
    got, r = measure(lmp, tmp_path, plates + [pit])
    for g in got:
        assert [g[n] for n in NAMES[:6]] == [0] * 6
        assert g["share"] == 1 and g["reference"] > 0 and g["dr"] > 0
    assert not [w for w in r.warnings if "hvi/hole" in w]


def test_nothing_left(lmp, tmp_path):
    """the whole plate gone but a rag; X,Y beside the plate; no particles in group or layer; too few to be a plate"""
    x = plate("sc", 3, 15, np.random.default_rng(6))
    beside = x[x[:, 0] > 4]
    got, r = measure(lmp, tmp_path, [x[radius(x, (12, 0)) < 3], beside])
    assert sum("no plate around the centre" in w for w in r.warnings) == 2
    for g in got:
        assert [g[n] for n in NAMES[:6]] == [0] * 6 and g["found"] == -1

    few = [np.zeros((1, 3)), np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0, 0, 0], [1, 1, 0.5]]),
           np.stack([np.arange(50) - 25.0, np.sin(np.arange(50)), 0 * np.arange(50)], -1)]
    got, _ = measure(lmp, tmp_path, few, nranks=2)
    assert np.all(np.isfinite([list(g.values()) for g in got])) and np.all(table(got, "d") == 0)

    write_data(tmp_path / "data", x)
    r = lmp(head("data") + """
group none empty
compute h none hvi/hole axis z centre 0 0 plane 0
compute g all hvi/hole axis z centre 0 0 plane 9 thickness 1
""" + THERMO.format("c_h[*] c_g[*]"), nranks=2)
    for name in "hg":
        *rest, found = values(r.thermo, name).values()
        assert set(rest) == {0} and found == -1, name


# ---------------------------------------------------------------------- the same in any guise
def irregular(rng, width=22):
    """a hole with five lobes, strays, a fragment and debris in random order, with its area by counting pixels"""
    x = plate("turned", 4, width, rng, "square")

    def edge(u, v):
        return 9 + 1.5 * np.cos(5 * np.arctan2(v, u)) + 0.5 * np.sin(np.arctan2(v, u))

    inside = radius(x) < edge(x[:, 0], x[:, 1])
    out = x[inside]
    debris = out + [0, 0, 1] * rng.uniform(8, 30, (len(out), 1))
    x = np.concatenate([x[~inside], debris, out[radius(out) < 3], out[rng.random(len(out)) < 0.02]])
    u, v = np.meshgrid(*2 * [np.arange(-15, 15, 0.02) + 0.01])
    return x[rng.permutation(len(x))], 4e-4 * (np.hypot(u, v) < edge(u, v)).sum()


def definition(x, dr, layer, fill=0.5, sectors=36, fine=16):
    """the compute's documentation in NumPy, with the map's spacing and the layer given; X,Y = 0 is in the hole"""
    x = x[abs(x[:, 2]) <= layer / 2]
    reach = np.ceil(abs(x[:, :2]).max() / dr).astype(int) + 4
    index = np.arange(-reach, reach + 1)
    node = dr * index

    def spline(t):
        t = abs(t) / dr
        return np.where(t < 1, (4 - 6 * t**2 + 3 * t**3) / 6, np.where(t < 2, (2 - t) ** 3 / 6, 0))

    areal = spline(node[:, None] - x[:, 0]) @ spline(node[:, None] - x[:, 1]).T / dr**2

    distance = np.hypot(index[:, None], index)
    ring = np.bincount(distance.astype(int).ravel(), areal.ravel())[::-1].cumsum()[::-1]
    far = distance >= np.nonzero(ring >= ring[0] / 2)[0].max()
    v = np.sort(areal[far])
    guess = v[np.searchsorted(v.cumsum(), v.sum() / 2)]
    eight = np.ones((3, 3))
    v = np.sort(areal[far & ndimage.binary_erosion(areal >= guess / 2, eight)])
    reference = v[len(v) // 2]

    filled = areal >= fill * reference
    label, n = ndimage.label(filled, eight)
    mass = np.bincount(label[filled & far], areal[filled & far], n + 1)
    is_plate = (mass >= 0.05 * mass.sum())[label] & filled
    areal = np.where(filled & ~is_plate, 0, areal)
    label, n = ndimage.label(ndimage.binary_erosion(~is_plate, eight, border_value=1), eight)
    assert 0 != label[reach, reach] != label[0, 0]
    hole = ndimage.binary_dilation(label == label[reach, reach], eight) & ~is_plate

    t = (np.arange(fine) + 0.5) / fine
    i, j = np.nonzero(hole[:-1, :-1] | hole[1:, :-1] | hole[:-1, 1:] | hole[1:, 1:])
    i, j, u, v = i[:, None, None], j[:, None, None], t[:, None], t
    here = (areal[i, j] * (1 - u) * (1 - v) + areal[i + 1, j] * u * (1 - v) + areal[i, j + 1] * (1 - u) * v +
            areal[i + 1, j + 1] * u * v) < fill * reference
    px = np.broadcast_to(node[i] + dr * u, here.shape)[here]
    py = np.broadcast_to(node[j] + dr * v, here.shape)[here]
    pixel, extra = (dr / fine) ** 2, dr**2 / 2
    area = len(px) * pixel + np.pi * extra
    sector = (sectors * (np.arctan2(py - py.mean(), px - px.mean()) / (2 * np.pi) + 0.5)).astype(int) % sectors
    rsq = np.bincount(sector, minlength=sectors) * pixel * sectors / np.pi
    r = np.sqrt((np.roll(rsq, 1) + 2 * rsq + np.roll(rsq, -1)) / 4 + extra)
    across = r[:sectors // 2] + r[sectors // 2:]
    return dict(zip(NAMES, [2 * np.sqrt(area / np.pi), across.min(), across.max(), px.mean(), py.mean(), area, 1, layer,
                            reference, dr, 1]))


def test_definition(lmp, tmp_path):
    """against NumPy and against pixels"""
    x, area = irregular(np.random.default_rng(7))
    (got,), _ = measure(lmp, tmp_path, [x], "dr 1.1 thickness 6")
    want = definition(x, 1.1, 6)
    assert got == pytest.approx(want, rel=2e-3, abs=5e-3)
    assert got["reference"] == pytest.approx(want["reference"], rel=1e-9)
    assert got["d"] == pytest.approx(np.sqrt(4 * area / np.pi), abs=2 * MEAN)
    (other,), _ = measure(lmp, tmp_path, [x], "dr 1.1 thickness 6 fill 0.7 sectors 16")
    assert other == pytest.approx(definition(x, 1.1, 6, 0.7, 16), rel=2e-3, abs=5e-3)
    assert other["d"] > got["d"] + 0.3


def test_ranks(lmp, tmp_path):
    """to the last digit, in every layout, some of them with empty ranks"""
    x, _ = irregular(np.random.default_rng(8))
    write_data(tmp_path / "data", x, box=[(-23, 23), (-23, 23), (-3, 200)])
    results = []
    for nranks, comm in [(1, "brick"), (2, "tiled"), (3, "brick"), (4, "tiled"), (4, "brick")]:
        text = "processors * * 2\n" if (nranks, comm) == (4, "brick") else ""
        text = text + head("data", comm=comm).replace("clear\n", "")
        r = lmp(text + "compute h all hvi/hole axis z centre 0.3 -0.2 plane 0.1" + THERMO.format("c_h[*]"), nranks=nranks)
        results.append(values(r.thermo))
    assert results[0]["d"] == pytest.approx(18, abs=1)
    assert all(r == results[0] for r in results[1:])


def test_axes_and_units(lmp, tmp_path):
    """any axis, any place, any units"""
    x, _ = irregular(np.random.default_rng(9))
    text = ""
    scale, place = 1e-4, np.array([3e-3, -12e-3, 5e-3])
    for axis, order in (("x", (2, 0, 1)), ("y", (0, 2, 1)), ("z", (0, 1, 2))):
        y = (scale * x + place)[:, order]
        write_data(tmp_path / f"data.{axis}", y, masses=(2.7e-9,), box=np.stack([y.min(0) - scale, y.max(0) + scale], -1))
        text += head(f"data.{axis}", units="si", cut=1.5e-4)
        text += f"compute h all hvi/hole plane {place[2]} axis {axis} center {place[0]} {place[1]}" + THERMO.format("c_h[*]")
    r = lmp(text)
    (want,), _ = measure(lmp, tmp_path, [x])
    for name in NAMES[:3] + ["layer", "dr"]:
        want[name] *= scale
    want["x"], want["y"] = (scale * want[c] + p for c, p in zip("xy", place))
    want["area"] *= scale**2
    want["reference"] *= 2.7e-9 / scale**2
    for case, thermo in enumerate(r.runs):
        got = values(thermo)
        assert {k: got[k] / want[k] for k in NAMES} == pytest.approx(dict.fromkeys(NAMES, 1), rel=1e-6), case


def test_masses(lmp, tmp_path):
    """layers of different mass, by type and by particle; the projectile's particles are not in the group"""
    x, _ = irregular(np.random.default_rng(10))
    types = 1 + (abs(x[:, 2]) > 1)
    ball = np.random.default_rng(1).uniform(-8, 8, (3000, 3))
    everything, types = np.concatenate([x, ball]), np.concatenate([types, np.full(len(ball), 3)])
    for style in ("atomic", "sphere"):
        write_data(tmp_path / f"data.{style}", everything, types, (1.0, 4.0, 2.0), style=style)
    keywords = "hvi/hole axis z centre 0 0 plane 0 dr 1 thickness 5"
    text = "".join(head(f"data.{s}", style=s) + f"group g type 1 2\ncompute h g {keywords}\ncompute a all {keywords}\n" +
                   THERMO.format("c_h[*] c_a[*]") for s in ("atomic", "sphere"))
    r = lmp(text, nranks=2)
    (want,), _ = measure(lmp, tmp_path, [x], "dr 1 thickness 5")
    a, b = (values(t) for t in r.runs)
    ratio = [a[n] / b[n] for n in NAMES]
    assert ratio[:3] == pytest.approx([1] * 3, rel=1e-9)
    assert ratio[8] == pytest.approx(6 / np.pi, rel=1e-9)  # diameter 1: mass = density * pi / 6
    assert a["reference"] == pytest.approx(want["reference"] * 2.5, rel=1e-3)  # 2 layers of 1, 2 of 4
    assert a["d"] == pytest.approx(want["d"], abs=0.05)
    assert values(r.runs[0], "a")["d"] < want["d"] - 1  # with the ball the hole is smaller or there is none


def test_half_and_quarter(lmp, tmp_path):
    x = plate("sc", 4, 20, np.random.default_rng(11), shift=False)
    x = x[(x[:, 0] / 10) ** 2 + (x[:, 1] / 8) ** 2 > 1]
    assert np.allclose(sorted(map(tuple, x)), sorted(map(tuple, x * [-1, -1, 1])))
    parts = [x, x[x[:, 0] > 0], x[x[:, 1] < 0], x[(x[:, 0] > 0) & (x[:, 1] > 0)], x[(x[:, 0] < 0) & (x[:, 1] > 0)]]
    exact, _ = measure(lmp, tmp_path, parts, "dr 1")
    default, _ = measure(lmp, tmp_path, parts)
    assert table(exact, "share").tolist() == [1, 0.5, 0.5, 0.25, 0.25]
    for e, d in zip(exact, default):
        for name in NAMES[:6] + ["reference", "dr"]:
            assert e[name] == pytest.approx(exact[0][name], rel=1e-9, abs=1e-9), name
        assert [d[n] for n in NAMES[:3]] == pytest.approx([default[0][n] for n in NAMES[:3]], abs=CHANGE / 2)
    assert default[0]["dmin"] == pytest.approx(16, abs=EXTREME) and default[0]["dmax"] == pytest.approx(20, abs=EXTREME)


def test_unwrapped(lmp, tmp_path):
    """a plate across the borders of a periodic box"""
    x, _ = irregular(np.random.default_rng(12))
    box = np.array([(-30.0, 30), (-35, 35), (-10, 60)])
    length = box[:, 1] - box[:, 0]
    moved = x + [30, 30, 55]
    image = np.floor((moved - box[:, 0]) / length).astype(int)
    assert len(np.unique(image, axis=0)) == 8
    write_data(tmp_path / "data", moved - image * length, box=box, image=image)
    r = lmp(head("data", boundary="p p p") + "compute h all hvi/hole axis z centre 30 30 plane 55" + THERMO.format("c_h[*]"),
            nranks=2)
    (want,), _ = measure(lmp, tmp_path, [x])
    assert values(r.thermo)["d"] == pytest.approx(want["d"], abs=1e-6)
    assert values(r.thermo)["x"] == pytest.approx(want["x"] + 30, abs=1e-6)


def test_thickness(lmp, tmp_path):
    """any number of layers, plane in the middle or at the face, all debris of a hole of 80 % in the group"""
    rng = np.random.default_rng(13)
    text, n = "", 0
    for layers in (1, 2, 3, 4, 6):
        x = plate("sc", layers, 20, rng)
        rest, out = x[radius(x) > 16], x[radius(x) < 16]
        debris = out * [2, 2, 0] + [0, 0, 1] * rng.uniform(3 * layers, 60 * layers, (len(out), 1))
        write_data(tmp_path / f"data.{layers}", np.concatenate([rest, debris]))
        for z in (0, 0.2, -layers / 2):
            text += head(f"data.{layers}") + f"compute h all hvi/hole axis z centre 0 0 plane {z}" + THERMO.format("c_h[*]")
            n += 1
    got = [values(t) for t in lmp(text).runs]
    error = abs(table(got, "d") - 32)
    assert len(got) == n and error.mean() <= MEAN and error.max() <= 2 * MEAN


def test_single_layer(lmp, tmp_path):
    """flat but for round-off, whole or with a hole, in quarters, too: the layer holds all of it"""
    rng = np.random.default_rng(15)
    x = plate("sc", 1, 20, rng, shift=False)
    x[:, 2] = rng.choice([0, 1e-13, -1e-13], len(x))
    quarter = x[(x[:, 0] > 0) & (x[:, 1] > 0)]
    got, r = measure(lmp, tmp_path, [x, x[radius(x) > 10], quarter, quarter[radius(quarter) > 10]])
    assert np.all(table(got, "found") == [0, 1, 0, 1]) and np.all(table(got, "d")[::2] == 0)
    assert table(got, "d")[1::2] == pytest.approx(20, abs=2 * MEAN)
    assert np.all(table(got, "layer") > 1.5) and np.all(table(got, "layer") < 3)
    assert not [w for w in r.warnings if "hvi/hole" in w]


# ---------------------------------------------------------------------- in LAMMPS
def test_in_a_run_and_after_restart(lmp, tmp_path):
    """thermo, a variable and fix ave/time agree on every step of a hole that grows; a continued run goes on the same"""
    x = plate("sc", 3, 16, np.random.default_rng(14))
    write_data(tmp_path / "data", x[radius(x) > 6], box=[(-30, 30), (-30, 30), (-3, 3)])
    start = head("data") + "variable vx atom 0.1*x\nvariable vy atom 0.1*y\nvelocity all set v_vx v_vy 0.0\n"
    use = """
compute h all hvi/hole axis z centre 0 0 plane 0
variable d equal 10*c_h[1]
fix a all ave/time 1 1 1 c_h[1] c_h[6] file ave format " %.17g"
fix m all nve
timestep 1.0
thermo 1
thermo_style custom step c_h[*] v_d
thermo_modify format float %.17g
"""
    r = lmp(start + use + "run 4", nranks=2)
    d = r.thermo["c_h[1]"]
    assert d[0] == pytest.approx(12, abs=2 * MEAN) and d[-1] == pytest.approx(1.4 * 12, abs=0.5) and np.all(np.diff(d) > 0)
    assert r.thermo["v_d"] == pytest.approx(10 * d, rel=1e-15)
    ave = np.loadtxt(tmp_path / "ave")
    assert np.array_equal(ave[:, 1], d) and np.array_equal(ave[:, 2], r.thermo["c_h[6]"])

    lmp(start + use + "run 2\nwrite_restart restart", nranks=2)
    again = lmp("comm_modify cutoff 1.5\nread_restart restart\npair_style zero 1.5\npair_coeff * *\n" + use + "run 2", nranks=3)
    for name in [f"c_h[{k}]" for k in range(1, 11)]:
        assert np.array_equal(again.thermo[name], r.thermo[name][2:]), name


@pytest.mark.parametrize("first, second", [(1, 1), (2, 3)])
def test_a_plate_that_has_flown_away_before_a_restart(lmp, tmp_path, first, second):
    """by several times its depth: its hole is that of the run that goes on; another place is far away, as it was"""
    x = plate("sc", 3, 16, np.random.default_rng(14))
    write_data(tmp_path / "data", x[radius(x) > 6], box=[(-30, 30), (-30, 30), (-3, 60)])
    use = """
compute h all hvi/hole axis z centre {} 0 plane 0 thickness 200
fix m all nve
timestep 1.0
thermo 5
thermo_style custom step c_h[1] c_h[11]
thermo_modify format float %.17g
"""
    start = head("data") + "velocity all set 0 0 2\n" + use.format(0)
    through = lmp(start + "run 20", nranks=first).thermo
    lmp(start + "run 10\nwrite_restart restart", nranks=first)
    again = "comm_modify cutoff 1.5\nread_restart restart\npair_style zero 1.5\npair_coeff * *\n"
    r = lmp(again + use.format(0) + "run 10", nranks=second)
    assert np.array_equal(r.thermo["c_h[1]"], through["c_h[1]"][2:]) and (r.thermo["c_h[11]"] == 1).all() and not any("hvi/hole" in w for w in r.warnings)
    r = lmp(again + use.format(1) + "run 10", nranks=second)
    assert (r.thermo["c_h[11]"] == -1).all() and any("far away from 1 0" in w for w in r.warnings)
    assert "the fix h_COMPUTE_STORE that it made is gone" in lmp(start + "unfix h_COMPUTE_STORE\nrun 1", expect_fail=True).error


def test_two_dimensions(lmp):
    r = lmp("dimension 2\nregion r block 0 1 0 1 -0.5 0.5\ncreate_box 1 r\nmass 1 1\n"
            "compute h all hvi/hole axis z centre 0 0 plane 0", expect_fail=True)
    assert "hvi/hole needs a three-dimensional simulation" in r.error


def test_maps_that_cannot_be(lmp, tmp_path):
    """a map finer than the particles is not made; a reference that no plate has is told"""
    x = plate("turned", 3, 15, np.random.default_rng(15))
    x = x[radius(x) > 8]
    (fine,), r = measure(lmp, tmp_path, [x], "dr 1e-9")
    assert fine["d"] == pytest.approx(16, abs=2 * MEAN) and fine["dr"] == pytest.approx(0.75, abs=0.05)
    assert any("too small" in w for w in r.warnings)
    (dense,), r = measure(lmp, tmp_path, [x], "reference 9")
    assert dense["d"] == 0 and any("no plate" in w for w in r.warnings)
