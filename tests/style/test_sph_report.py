"""The table at the start of a run says once what the run is; each warning comes once when it should, and not otherwise."""

import re

import numpy as np
import pytest
from mirror_scenes import part
from solid_scenes import MATERIAL, OUT, read
from sph_report import tables
from sph_scenes import Fluid, random_fluid, scene


# ---------------------------------------------------------------------- what the table says

def neighbors(s, support):
    """mean number within reach of the mean h, by type; all images, by brute force"""
    near = np.zeros(len(s.x))
    h = np.array([s.h[t] for t in s.type])
    for i in range(len(s.x)):
        d = s.x - s.x[i]
        d -= s.box * np.round(d / s.box)
        near[i] = (np.sqrt((d**2).sum(1)) < support * 0.5 * (h[i] + h)).sum() - 1
    return {t: near[s.type == t].mean() for t in (1, 2)}


@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_numbers(lmp, tmp_path, nranks):
    """particles, spacing, h, neighbors (of all pairs by hand) and densities; by type, whatever the layout"""
    s = random_fluid(8, seed=81, h=[1.25, 1.0], jitter=0.3, spacing=1.3)
    s.rho *= np.where(s.type == 1, 1.0, 1.05)
    text, want = "", []
    for words, support in (("cubic", 2.0), ("quartic h variable", 2.5), ("cubic dissipation riemann", 2.0)):
        pair = f"pair_style hvi/sph {words}\npair_coeff 1 1 eos tait 1.0 4.0 7 h {s.h[1]}\npair_coeff 2 2 eos tait 1.7 3.0 7 h {s.h[2]}\n"
        want.append(neighbors(s, support))
        for newton in ("on", "off"):
            text += "clear\n" + scene(s, tmp_path / "s.data", pair, newton=newton, comm="tiled" if newton == "off" else "brick") + "run 0\n"
    found = tables(lmp(text, nranks=nranks).log)
    assert len(found) == 6
    for k, table in enumerate(found):
        assert set(table["rows"]) == {1, 2}
        for t, rho0 in ((1, 1.0), (2, 1.7)):
            row, rho = table["rows"][t], s.rho[s.type == t] / rho0
            assert row["number"] == (s.type == t).sum()
            assert row["spacing"] == pytest.approx(np.cbrt(s.mass[t] / rho0), rel=1e-4) and row["h"] == pytest.approx(s.h[t] / 1.3, rel=1e-3)
            assert row["neighbors"] == pytest.approx(want[k // 2][t], rel=6e-4), (k, t)
            assert row["density"] == pytest.approx([rho.mean(), rho.min(), rho.max()], abs=6e-4), (k, t)
            assert row["name"] == "tait" and row["laws"] == "tait", (k, t)


def block(counts, spacing=1.0, v=None, rho=1.0, dim=3, places=None, kind=None, box=None, mass=None):
    """a lattice in a box with room around it"""
    x = np.stack(np.meshgrid(*[np.arange(k) for k in counts], indexing="ij"), -1).reshape(-1, 3).astype(float)
    x = (places or 1.0) * spacing * (x - x.mean(0))
    n = len(x)
    box = np.full(3, 3.0 * spacing * max(counts)) if box is None else np.asarray(box, float)
    kind = np.ones(n, int) if kind is None else kind
    mass = spacing**dim if mass is None else mass
    v = np.zeros((n, 3)) if v is None else v
    return Fluid(x + box / 2, v, np.full(n, float(rho)), np.zeros(n), kind, {1: mass}, {1: 1.2 * spacing}, box, (False,) * 3)


def plain(s, tmp_path, h=1.2, words="cubic", more="", units="lj", fix="fix sph all hvi/sph\n", eos="tait 1.0 4.0 7"):
    pair = f"pair_style hvi/sph {words}\npair_coeff 1 1 eos {eos} h {h:.17g}\n"
    return scene(s, tmp_path / f"s{len(list(tmp_path.iterdir()))}.data", pair, fix=fix, skin=0.25 * h).replace("units lj", f"units {units}") + more


def test_layers(lmp, tmp_path):
    """of plates, wherever they lie; not of a ball, nor of what is spread out; density at rest where fix hvi/sph will fill it in"""
    counts = [(12, 11, 3), (4, 12, 12), (10, 1, 12), (9, 9, 9)]
    ball = block((9, 9, 9))
    keep = ((ball.x - ball.box / 2) ** 2).sum(1) < 1.0
    ball.x, ball.v, ball.rho, ball.esph, ball.type = (a[keep] for a in (ball.x, ball.v, ball.rho, ball.esph, ball.type))
    text = "".join("clear\n" + plain(block(c), tmp_path) + "run 0\n" for c in counts)
    text += "clear\n" + plain(block((9, 9, 4), places=1.5), tmp_path) + "run 0\n"
    text += "clear\n" + plain(block((9, 9, 4), rho=0.0), tmp_path).replace("h 1.2", "h 1.2 volume 1.0") + "run 0\n"
    found = [t["rows"][1] for t in tables(lmp(text).log)]
    assert [row["layers"] for row in found] == ["3", "4", "1", "9", "-", "4"]
    assert found[-1]["density"] == [1.0, 1.0, 1.0]


SOLID = "pair_style hvi/sph cubic {0}\npair_coeff 1 1 file {1}/m.hvi h 1.25\npair_coeff 2 2 eos tait 1.0 4.0 7 h 1.25\n"
FLUID = "pair_style hvi/sph cubic {0}\npair_coeff 1 1 file {1}/m.hvi h 1.25 strength none\npair_coeff 2 2 eos tait 1.0 4.0 7 h 1.25\n"

# words, fix hvi/johnson-cook (None: none): records, numbers kept, sent forward and back, terms, laws of both types
SCENES = [
    ("", None, 160, 23, 0, 0, ["viscosity"], "", ""),
    ("interface auto h variable energy no", None, 160, 23, 0, 0, ["viscosity", "interface density dissipation", "variable h", "no energy equation"], "", ""),
    ("dissipation riemann", None, 160 + 96, 23, 11, 11, ["Riemann problems"], "", ""),
    ("mirror x -0.1 lo", None, 160, 23, 0, 0, ["viscosity", "mirror planes"], "", ""),
    # traction, and with bodies or rubble the record of what touches; limits and traction forward; L, H, M, nu back, and forces
    ("", "", 160 + 192 + 128 + 4, 23 + 21, 3 + 15, 22 + 3, ["viscosity", "stress", "corrected forces"],
     ", strength johnson-cook, damage johnson-cook, spall principal", ", liquid"),
    ("dissipation riemann artstress 0.3 4", "damage no spall none", 160 + 192 + 128 + 64 + 4, 23 + 21, 3 + 6 + 15 + 6, 22 + 3,
     ["Riemann problems", "stress", "corrected forces", "artificial stress"], ", strength johnson-cook", ", liquid"),
]


def test_what_a_scene_carries(lmp, tmp_path):
    """terms and laws; bytes that are in LAMMPS's sum of memory too; what records are sent, by hand; the same table with newton off, without the way back"""
    (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    s = block((26, 26, 26), kind=np.repeat([1, 2], 13 * 26 * 26))
    s.mass, s.h, text = {1: 1.0, 2: 1.0}, {1: 1.25, 2: 1.25}, ""
    few = block((6, 6, 6), kind=np.repeat([1, 2], 108))
    few.mass, few.h = s.mass, s.h
    for one, newton in ((s, "on"), (few, "off")):
        for words, jc, *_ in SCENES:
            pair = (FLUID if jc is None else SOLID).format(words, tmp_path)
            text += "clear\n" + scene(one, tmp_path / f"s{newton}.data", pair, newton=newton) + ("" if jc is None else f"fix jc all hvi/johnson-cook {jc}\n") + "run 0\n"
    r = lmp(text)
    found = tables(r.log)
    mega = [float(a) for a in re.findall(r"^Per MPI rank memory allocation \(min/avg/max\) = (\S+) ", r.log, re.M)]
    assert len(found) == len(mega) == 2 * len(SCENES)
    for k, table in enumerate(found):
        words, jc, records, kept, forward, reverse, terms, one, two = SCENES[k % len(SCENES)]
        assert table["terms"] == terms and table["memory"] == [records, 8 * kept], (words, jc)
        assert sum(table["arrays"].values()) == records and ("traction" in table["arrays"]) == (jc is not None)
        assert table["sent"] == [forward + 3, reverse if k < len(SCENES) else 0, 2], (words, jc)
        assert table["style"].startswith("Pair style hvi/sph cubic dim 3 form sum h ")
        assert [table["rows"][t]["laws"] for t in (1, 2)] == ["gruneisen" + one, "tait" + two]
    # the memory that LAMMPS adds up grows by what the table says, for as many particles as it has room for: multiples of 16384
    for k in (4, 5):  # Riemann problems without solids keep the neighbors within reach besides
        more = (SCENES[k][2] - SCENES[0][2] + 8 * (SCENES[k][3] - SCENES[0][3])) / 2**20 * 16384
        room = (mega[k] - mega[0]) / more
        assert mega[k] - mega[0] > 1.0 and room == pytest.approx(round(room), abs=0.02), (k, room)
        assert round(room) == 2, k


def test_doubles_of_lists(lmp, tmp_path):
    """displacements go to ghosts while hvi/lists is in charge, not where LAMMPS decides on lists"""
    s = block((6, 6, 6))
    more = ["", "neigh_modify every 2\n", "fix size all deform 1 x erate 0.1 remap none\n"]
    text = "".join("clear\n" + plain(s, tmp_path, more=m) + "run 0\n" for m in more)
    text += "clear\n" + plain(s, tmp_path, fix="fix sph all hvi/sph lists displacement\n") + "run 0\n"
    assert [t["sent"] for t in tables(lmp(text).log)] == [[3, 0, 2], [0, 0, 2], [0, 0, 2], [0, 0, 2]]


def test_once_per_scene(lmp, tmp_path):
    """not again while the scene is the same, on any ranks; warnings at each run, but not for parts of one nor when files are written"""
    s = block((6, 6, 6), v=None)
    text = plain(s, tmp_path, h=0.8, fix="group left id < 109\nfix sph left hvi/sph\n", more="timestep 5.0\nvelocity all set 0 0 0\n")
    text += "run 0\nwrite_restart r\nwrite_data d\nrun 4 pre no every 2 NULL\nrun 0\nrun 0 pre no\n"
    for nranks in (1, 2):
        r = lmp(text, nranks=nranks)
        assert len(tables(r.log)) == len(tables(r.stdout)) == 1, nranks
        for words in ("reaches 1.6 spacings", "are integrated by no fix", "time step 5 is above"):
            assert sum(words in w for w in r.warnings) == 3, (words, r.warnings)


@pytest.mark.parametrize("nranks", [1, 2])
def test_again_when_the_scene_changes(lmp, tmp_path, nranks):
    """other words, smoothing lengths, masses, of fewer particles too, more particles: not fewer, nor those that clear and a restart file bring back"""
    s = block((6, 6, 6))
    s.write(tmp_path / "again.data")
    fixes = "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix sph all hvi/sph\ntimestep 0.001\n"
    last = "write_restart r\nclear\nread_restart r\n" + fixes + "run 1\n"
    parts = [("run 1\nrun 1\n", 1), ("pair_coeff 1 1 eos tait 1.0 4.0 7 h 1.25\nrun 1\n", 1), ("mass 1 1.01\nrun 1\n", 1), ("run 0\n", 0),
             ("group few id 1\ndelete_atoms group few compress no\nrun 1\n", 0), ("create_atoms 1 single 3.0 3.0 3.0\nset type 1 sph/rho 1.0\nrun 1\n", 1),
             (last, 0), (last, 0), ("clear\nread_restart r\nmass 1 1.02\n" + fixes + "run 1\n", 1),
             ("clear\nread_restart r\n" + fixes + "group some id 2:9\ndelete_atoms group some compress no\nmass 1 1.3\nrun 1\n", 1),
             ("clear\n" + plain(s, tmp_path, more="timestep 0.001\n") + "run 1\n", 1), ("clear\n" + plain(s, tmp_path) + "run 0\n", 1)]
    text = plain(s, tmp_path, more="timestep 0.001\n") + "".join(part + "print 'next part'\n" for part, _ in parts)
    logs = lmp(text, nranks=nranks).log.split("\nnext part")[:-1]
    assert [len(tables(log)) for log in logs] == [number for _, number in parts]
    r = lmp("read_restart r\n" + fixes + "run 1\n", nranks=nranks)  # another process, another log
    assert len(tables(r.log)) == 1


# ---------------------------------------------------------------------- warnings

def case(says, s, silent=False, **how):
    return says, s, silent, how


SI = dict(units="si", h=1.2e-3, eos="tait 1000.0 1500.0 7")
DT = "fix step all hvi/dt 0.2\n"


def falling(speed, spacing=1e-3, rho=1000.0):
    """two halves that meet"""
    s = block((6, 6, 6), spacing, rho=rho, mass=rho * spacing**3)
    s.v[:, 2] = np.where(s.x[:, 2] < s.box[2] / 2, speed, 0.0)
    return s


def cases():
    some = block((6, 6, 6))
    some.rho[:7] = 1.3
    some.rho[7:12] = 1.19
    row, sheet = block((12, 1, 1), box=(20, 20, 20)), block((8, 8, 1), box=(20, 20, 20))
    far = 2000.0 * 2.4
    reach, near, off, step, slow, wide = ("kernel of type 1 reaches {} spacings", "neighbors in the mean, the kernel needs {} or more", "particles of type 1 start with a density",
                                          "the time step {} is above", "the largest difference of velocities is {} m/s", "cutoffs long along {}")
    good, around = block((6, 6, 6)), block((6, 6, 6), box=(6, 6, 6))
    around.periodic = (True,) * 3
    return [
        case(reach.format(1.6), good, h=0.8), case(reach.format(5.4), good, h=2.7), case(reach, around, True, h=1.01), case(reach, around, True, h=2.49),
        # half of what a kernel reaches counts
        case(reach, good, True, h=0.8, words="quintic"), case(reach.format(6), good, h=2.0, words="quintic"), case(reach, good, True, h=2.4, words="lucy"),
        case(off.replace("particles", "7 particles"), some), case(off, good, True), case(off, block((6, 6, 6), rho=0.81), True),
        case("216 " + off, block((6, 6, 6), rho=0.7)), case(off, block((6, 6, 6), rho=0.7), True, eos="idealgas 1.4"),
        case(near.format(28), block((6, 6, 6), places=1.6)), case(near, good, True), case(near.format(10), block((8, 8, 1), places=1.6, box=(20, 20, 20)), words="cubic dim 2"),
        case(near, sheet, True, words="cubic dim 2"), case(near.format(2), block((12, 1, 1), places=2.3, box=(40, 20, 20)), words="cubic dim 1 dissipation riemann"),
        case(near, row, True, words="gauss dim 1"),
        # the sums of gradients of kernels on a row
        case("by the kernel of type 1 are 1.0224 times the right ones", row, words="cubic dim 1"), case("are 0.9853 times", row, words="wendland2 dim 1", h=1.6),
        case("gradients", row, True, words="cubic dim 1 dissipation riemann"), case("gradients", row, True, words="quintic dim 1"),
        case("gradients", row, True, words="quartic dim 1 dissipation riemann"), case("gradients", sheet, True, words="cubic dim 2"),
        # h/c at rest
        case(step.format(0.31) + " the stable one, about 0.3:", good, more="timestep 0.31\n"), case("time step", good, True, more="timestep 0.29\n"),
        case("time step", good, True, more="timestep 0.31\n" + DT),
        case(slow.format(5), falling(5.0), more=DT, **SI), case("velocities", falling(5000.0), True, more=DT, **SI), case("velocities", falling(11.0), True, more=DT, **SI),
        case("velocities", falling(5.0), True, more="timestep 1e-8\n", **SI), case("velocities", falling(0.0), True, more=DT, **SI),
        case("velocities", falling(5.0, 1.0, 1.0), True, more=DT),
        case(slow.format(5), falling(500.0, 0.1, 1.0), more=DT, units="cgs", h=0.12, eos="tait 1.0 1.5e5 7"),
        case("velocities", falling(5000.0, 0.1, 1.0), True, more=DT, units="cgs", h=0.12, eos="tait 1.0 1.5e5 7"),
        case(slow.format(5), falling(5.0, 1.0, 1.0), more=DT, units="micro", eos="tait 1.0 1500 7"),
        case(slow.format(5), falling(5.0, 1.0, 1.0), more=DT, units="nano", eos="tait 1.0 1500 7"),
        case(wide.format("y"), block((6, 6, 6), box=(20, 1.01 * far, 20))), case("cutoffs long", block((6, 6, 6), box=(20, 0.99 * far, 20)), True),
    ]


def test_warnings(lmp, tmp_path):
    """each in one run, and no other than it; silent in the scene that differs in this alone"""
    text, all_cases = "", cases()
    for says, s, silent, how in all_cases:
        text += "clear\n" + plain(s, tmp_path, **how) + "run 0\nprint 'next case'\n"
    logs = lmp(text).log.split("print 'next case'")[:-1]
    assert len(logs) == len(all_cases)
    for (says, s, silent, how), log in zip(all_cases, logs):
        said = [line for line in log.splitlines() if line.startswith("WARNING")]
        if silent:
            assert not said, (says, how, said)
        else:
            assert len(said) == 1 and says in said[0], (says, how, said)


def test_density_of_new_particles_only(lmp, tmp_path):
    """what a run has made of it is no mistake; what comes later is asked"""
    s = block((6, 6, 6), rho=0.7)
    text = plain(s, tmp_path, more="timestep 0.001\n") + "run 2\nrun 2\nread_data more.data add append\nrun 0\n"
    new = block((2, 2, 2), rho=1.4)
    new.box, new.x = s.box, new.x - new.box / 2 + 2.0
    new.write(tmp_path / "more.data")
    said = [w for w in lmp(text).warnings if "start with a density" in w]
    assert len(said) == 2 and ": 216 particles of type 1" in said[0] and ": 8 particles of type 1" in said[1] and "more than 20 %" in said[0], said


def test_neighbors_of_new_particles_only(lmp, tmp_path):
    """a cloud has few by right"""
    s = block((6, 6, 6))
    s.v = 20.0 * (s.x - s.box / 2)
    r = lmp(plain(s, tmp_path, words="cubic viscosity 0 0", more="timestep 0.001\n") + "run 60\nmass 1 1.001\nrun 1\n")
    assert tables(r.log)[1]["rows"][1]["neighbors"] < 28 < tables(r.log)[0]["rows"][1]["neighbors"]
    assert not r.warnings, r.warnings


@pytest.mark.parametrize("nranks", [1, 2])
def test_restart_round_trip(lmp, tmp_path, nranks):
    """planes, a type that is a liquid by pair_coeff, volumes and a mass that was changed later: the same table, the same bits as without the restart"""
    (tmp_path / "m.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    s, _ = part("xy")
    s.rho[:] = 0.0  # that of the material
    pair = f"pair_style hvi/sph cubic mirror x 0.0 lo mirror y 0.0 lo\npair_coeff 1 1 file {tmp_path}/m.hvi h 1.25 volume 0.98\n"
    pair += f"pair_coeff 2 2 file {tmp_path}/m.hvi h 1.2 strength none volume 1.03\npair_coeff 1 2 tension yes viscosity 0.7 1.1\nmass 1 1.01\n"
    fixes = "fix sph all hvi/sph\nfix jc all hvi/johnson-cook\ntimestep 0.004\n"
    mass = "print 'masses {} {}'\n".format(*(f"$(mass[{np.argmax(s.type == t) + 1}])" for t in (1, 2)))
    text = scene(s, tmp_path / "s.data", pair, fix=fixes, sort=False) + "restart 20 half\nrun 39\n" + mass + OUT.format("whole")
    one = lmp(text, nranks=nranks)
    two = lmp("read_restart half.20\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n" + fixes + "run 19\n" + mass + OUT.format("part"), nranks=nranks)
    a, b = read(tmp_path / "whole"), read(tmp_path / "part")
    liquid = a["type"] == 2
    assert a["vm"][liquid].max() == 0.0 < a["vm"][~liquid].max()
    for name in a:
        assert np.array_equal(a[name], b[name]), name
    first, later = tables(one.log)[0], tables(two.log)[0]
    for name in ("style", "terms", "memory", "sent"):
        assert first[name] == later[name], name
    assert "mirror x 0 lo mirror y 0 lo" in later["style"] and later["rows"][2]["laws"] == "gruneisen, liquid"
    for t in (1, 2):
        assert all(first["rows"][t][name] == later["rows"][t][name] for name in ("number", "spacing", "h", "laws"))
        assert first["rows"][t]["density"] == [1.0, 1.0, 1.0]
    for r in (one, two):
        assert [float(m) for m in re.search(r"^masses (\S+) (\S+)$", r.log, re.M).groups()] == [1.01, 1.03] and not r.warnings, r.warnings
