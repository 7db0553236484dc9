"""python3 -m hvi hole and compute hvi/hole: the same eleven values on the same particles; LAMMPS's dumps and data files."""

import hvi
import numpy as np
import plate_scenes
import pytest
from hole_scenes import THERMO, head, plate, radius, write_data
from hvi import cli
from hvi.analysis import hole
from hvi.io import mirror
from hvi.io.data import DataFile

CLOSE = 1e-10
OUT = "write_dump all custom {} id type mass xu yu zu {} modify format float %.17g {}\n"
PLAIN = OUT.format("{}", "", "")


def vector(thermo, name="h"):
    return [thermo[f"c_{name}[{k}]"][-1] for k in range(1, 12)]


def same(found, want, names=(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10)):
    got = list(found.values.values())
    size = want[9] or 1.0
    for k in names:  # a center at 0 is so to round-off
        assert got[k] == pytest.approx(want[k], rel=CLOSE, abs=CLOSE * size * (k in (3, 4))), list(found.values)[k]


def debris(x, rng):
    """a fragment in the hole, strays in it, and what flies behind the plate"""
    around = rng.uniform(-1, 1, (60, 3)) * [8, 8, 2]
    piece = plate("sc", 3, 2, rng) + [1.0, 2.0, 0.0]
    return np.concatenate([x, around, piece, rng.uniform(-9, 9, (300, 3)) * [1, 1, 0.2] + [0, 0, 18]])


SCENES = {  # particles, keywords of the compute, those in Python
    "round": (lambda rng: plate("turned", 4, 24, rng), 9.0, "", {}),
    "debris": (lambda rng: plate("sc", 5, 26, rng), 10.0, "", {}),
    "random, square": (lambda rng: plate("random", 4, 22, rng, "square"), 8.0, "", {}),
    "given": (lambda rng: plate("fcc", 3, 22, rng), 7.0, "thickness 5 dr 1.3 fill 0.4 reference 2.9 sectors 24", dict(
        thickness=5, dr=1.3, fill=0.4, reference=2.9, sectors=24)),
    "too fine": (lambda rng: plate("turned", 3, 20, rng), 6.0, "dr 0.2", dict(dr=0.2)),
    "single layer": (lambda rng: plate("sc", 1, 24, rng), 6.0, "", {}),
    "no hole": (lambda rng: plate("turned", 3, 20, rng), 0.0, "", {}),
    "cracked": (lambda rng: (x := plate("sc", 3, 26, rng))[~((x[:, 0] > 0) & (np.abs(x[:, 1]) < 1.8))], 8.0, "", {}),
    "gone": (lambda rng: plate("sc", 3, 12, rng) + [40, 0, 0], 0.0, "", {}),
    "another plane": (lambda rng: np.zeros((0, 3)), 0.0, "", {}),
}


@pytest.mark.parametrize("name", SCENES)
def test_as_the_compute(lmp, tmp_path, name):
    """plates with all that may come to a hole, from a dump and from a data file"""
    make, r, words, how = SCENES[name]
    rng = np.random.default_rng(5)
    x = make(rng)
    if name == "another plane":
        x = plate("sc", 3, 10, rng) * [1, 0, 1]  # a line: nothing across
    x = x[radius(x, (0.6, -0.4)) > r * (1 + 0.2 * np.cos(3 * np.arctan2(x[:, 1], x[:, 0])))]
    x = debris(x, rng) if name == "debris" else x
    if name == "gone":
        x = np.concatenate([x, x * [-1, 1, 1]])
    write_data(tmp_path / "d", x, types=1 + (np.arange(len(x)) % 2), masses=(1.0, 1.5))
    r = lmp(head("d") + f"compute h all hvi/hole axis z centre 0 0 plane 0 {words}" + THERMO.format("c_h[*]") + PLAIN.format("d.dump") + "write_data e.data\n")
    want = vector(r.thermo)
    for frame in (hvi.Dump(tmp_path / "d.dump", units="lj", mirror="none")[0], DataFile(tmp_path / "e.data").frame(mirror=())):
        found = hole.measure(frame, "z", (0, 0), 0.0, **how)
        same(found, want)
    assert want[10] == {"no hole": 0, "gone": -1, "another plane": -1}.get(name, 1)
    assert (found.inside is not None) == (want[10] == 1)


def test_other_axes_types_and_planes(lmp, tmp_path, capsys):
    """across y, of one of two types, quarter and half with planes at any place and side; in a periodic box; command and figure"""
    rng = np.random.default_rng(7)
    x = plate("sc", 4, 20, rng, shift=False)
    x = x[radius(x, (0, 0)) > 7 + np.cos(2 * np.arctan2(x[:, 1], x[:, 0]))][:, [0, 2, 1]] + [3.0, 1.0, -2.0]
    shot = rng.uniform(-3, 3, (200, 3)) + [3.0, 1.0, -2.0]
    parts = {"whole": (x[:, 0] > -99, ""), "half": (x[:, 2] < -2.0, "z=-2,hi"), "quarter": ((x[:, 2] < -2.0) & (x[:, 0] > 3.0), "z=-2,hi x=3")}
    values = {}
    for name, (there, words) in parts.items():
        y = np.concatenate([x[there], shot])
        types = np.repeat([2, 1], [there.sum(), len(shot)])
        box = [(-30, 30)] * 3
        write_data(tmp_path / "d", y, types=types, masses=(3.0, 1.0), box=box)
        r = lmp(head("d", boundary="p f p") + "group plate type 2\ncompute h plate hvi/hole axis y centre 3 -2 plane 1" + THERMO.format("c_h[*]") + PLAIN.format("p.dump"))
        planes = mirror.of_words(words.split() or "none")
        frame = hvi.Dump(tmp_path / "p.dump", units="lj", mirror=planes)[0]
        found = hole.measure(frame, "y", (3, -2), 1.0, types=[2])
        same(found, vector(r.thermo))
        values[name] = found.values
        out = tmp_path / "o.csv"
        options = ["hole", str(tmp_path / "p.dump"), "--units", "lj", "--axis", "y", "--center", "3", "-2", "--plane", "1", "--type", "2",
                   *(w for word in words.split() or ["none"] for w in ("--mirror", word))]
        assert cli.main([*options, "--out", str(out), "--figure", str(tmp_path / "h.png")]) == 0, name
        said = capsys.readouterr().out
        assert "hole: yes\n" in said and ("what follows is of the whole" in said) == bool(words) and (tmp_path / "h.png").stat().st_size > 8000
        assert out.read_text().split()[1] == ",".join(str(v) for v in found.values.values()), name
        assert cli.main([*options, "--all"]) == 0 and f"{found.values['diameter']:.6g}" in capsys.readouterr().out, name
    for name, share in (("half", 0.5), ("quarter", 0.25)):
        assert values[name]["share"] == share and values[name]["diameter"] == pytest.approx(values["whole"]["diameter"], rel=1e-3)
        assert values[name]["area"] == pytest.approx(values["whole"]["area"], rel=2e-3)
    # a plane that does not go through the center is one, too: what is measured is the whole
    off = hole.measure(frame, "y", (3.2, -1.9), 1.0, types=[2]).values
    assert off["share"] == 0.25 and off["diameter"] == pytest.approx(values["quarter"]["diameter"], rel=2e-3) and off["center_x"] == pytest.approx(3.0, abs=0.05)  # of a spacing of 1


PIECE = """
group plate type 2
compute piece plate hvi/fragment/atom distance 1.5
compute pieces plate hvi/fragment distance 1.5
compute most plate reduce max c_pieces[3] c_pieces[1] replace 2 1 inputs local
variable lowest equal c_most[2]
variable largest atom "c_piece == v_lowest"
run 0
group largest variable largest
compute h largest hvi/hole axis z centre 0 0 plane 0 {}
"""


@pytest.mark.each_value
@pytest.mark.parametrize("name", ["whole", "quarter"])
@pytest.mark.parametrize("thickness", [None, 30.0])
def test_largest_piece(lmp, tmp_path, capsys, name, thickness):
    """rubble in the hole, 1.6 spacings from its edge and from plane to plane, is no plate; as by the lines in compute_hvi_hole.rst"""
    x = plate("sc", 3, 22, np.random.default_rng(9), shift=False)
    out = np.abs(x[:, :2]).max(axis=1)
    x = np.where((out < 8)[:, None], x * [1 - 0.6 / 7.5, 1 - 0.6 / 7.5, 1], x)[out > 5]
    x = x[(x[:, 0] > 0) & (x[:, 1] > 0)] if name == "quarter" else x
    shot = np.random.default_rng(2).uniform(0.5, 3, (50, 3))
    write_data(tmp_path / "d", np.concatenate([x, shot]), types=np.repeat([2, 1], [len(x), len(shot)]), masses=(3.0, 1.0))
    word = f"thickness {thickness}" if thickness else ""
    r = lmp(head("d", cut=3.0) + PIECE.format(word) + THERMO.format("c_h[*]") + PLAIN.format("p.dump"))
    planes = ["x=0", "y=0"] if name == "quarter" else ["none"]
    frame = hvi.Dump(tmp_path / "p.dump", units="lj", mirror=planes)[0]
    found = hole.measure(frame, "z", (0, 0), 0.0, types=[2], distance=1.5, thickness=thickness)
    same(found, [r.runs[-1][f"c_h[{k}]"][-1] for k in range(1, 12)])
    assert found.values["diameter"] == pytest.approx(32 / np.sqrt(np.pi), abs=0.2)
    assert hole.measure(frame, "z", (0, 0), 0.0, types=[2], thickness=thickness).values["diameter"] < 12  # all that is there
    words = ["hole", str(tmp_path / "p.dump"), "--units", "lj", "--plane", "0", "--distance", "1.5", *(w for p in planes for w in ("--mirror", p))]
    assert cli.main([*words, "--type", "2", *(["--thickness", str(thickness)] if thickness else [])]) == 0
    assert f"diameter: {found.values['diameter']:.6g}" in capsys.readouterr().out
    assert cli.main([*words, "--type", "3"]) == 1 and "hole: unknown" in capsys.readouterr().out  # no particles


def test_a_record_is_needed(tmp_path, capsys):
    """a data file that looks like a quarter and says nothing is refused; with no plate around the center there is no diameter, and exit status 1"""
    x = plate("sc", 3, 20, np.random.default_rng(3), shift=False)
    quarter = x[(x[:, 0] > 0) & (x[:, 1] > 0) & (radius(x) > 6)]
    write_data(tmp_path / "q.data", quarter)
    words = ["hole", str(tmp_path / "q.data"), "--units", "lj", "--plane", "0"]
    assert cli.main(words) == 1 and "has no record of mirror planes" in capsys.readouterr().err
    assert cli.main([*words, "--quarter"]) == 0
    assert "share: 0.25\n" in capsys.readouterr().out
    (tmp_path / "r.data").write_text((tmp_path / "q.data").read_text().replace("plate\n", "plate, mirror x 0 lo mirror y 0 lo\n", 1))
    assert cli.main([*words[:1], str(tmp_path / "r.data"), *words[2:]]) == 0 and "share: 0.25\n" in capsys.readouterr().out
    assert cli.main([*words, "--mirror", "none"]) == 1
    out = capsys.readouterr().out
    assert "hole: unknown, there is no plate around the center" in out and "diameter" not in out
    for center in (-30, -25, 22, 500):  # beside the plate
        assert cli.main([*words, "--quarter", "--center", str(center), "0"]) == 1 and "hole: unknown" in capsys.readouterr().out
    assert cli.main([*words, "--quarter", "--fill", "1"]) == 1 and "fill must be > 0 and < 1" in capsys.readouterr().err
    write_data(tmp_path / "s.data", x, style="sphere")
    assert cli.main(["hole", str(tmp_path / "s.data"), "--plane", "0"]) == 1
    assert "atom_style sphere is not read here, but angle, atomic, bond" in capsys.readouterr().err


@pytest.mark.parametrize("quarter", ["yes", "no"])
def test_impact(lmp, root, tmp_path, quarter):
    """in.plate as it is, coarse: the hole of the moving plate, with what has failed, by the record in its dump"""
    more = "".join(f"print 'value {k} $(c_hole[{k}]:%.17g)'\n" for k in range(1, 12))
    r = lmp(plate_scenes.text(quarter=quarter == "yes") + more + "write_dump all custom fine.dump ${columns} modify ${names} format float %.17g\n",
            env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"dx": 0.8, "t": 2.4, "Rplate": 15, "tstop": 3})
    want = [float(line.split()[2]) for line in r.log.splitlines() if line.startswith("value ")]
    assert len(want) == 11 and want[10] == 1 and want[6] == (0.25 if quarter == "yes" else 1)
    dump = hvi.Dump(tmp_path / "fine.dump")
    plate_types = [t for t in np.unique(dump[0]["type"]) if t > 1]
    frame = dump[0]
    assert np.sum((frame["damage"] >= 1) | (frame["spalled"] > 0)) > 10
    middle = 1.2e-3
    same(hole.measure(frame, "z", (0, 0), middle, types=plate_types), want)
