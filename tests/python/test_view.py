"""The scene in 3D of python3 -m hvi report and view: packed particles are where they were, a page has room for them, and a browser draws, turns and cuts them."""

import base64
import functools
import html
import json
import pathlib
import re
import sys
import zlib

import numpy as np
import pytest
import yaml
from hvi import cli
from hvi.commands import view as command
from hvi.errors import HVIError
from hvi.io import packed
from hvi.io.dump import Dump
from hvi.progress import Silent
from hvi.report import page, view

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "verify"))
import browser  # noqa: E402
import chromium  # noqa: E402
import scene  # noqa: E402

EVIL = "</template><script>alert(1)</script>"
COLUMNS = "id type x y z vx vy vz time_si damage spalled p T mirror_x_lo mirror_y_lo"


def ball(radius, a=1e-3):
    """points of a lattice in a quarter of a sphere, m"""
    side = np.arange(-radius + 0.5 * a, radius, a)
    x = np.stack(np.meshgrid(side, side, side, indexing="ij"), -1).reshape(-1, 3)
    return x[(np.linalg.norm(x, axis=1) < radius) & (x[:, 0] > 0) & (x[:, 1] > 0)]


def write(path, frames):
    """frames: [(time, x (n, 3), type (n,), v (n, 3), p (n,)), ...] of a quarter model"""
    lines = []
    for step, (time, x, kind, v, p) in enumerate(frames):
        n = len(x)
        table = np.zeros((n, len(COLUMNS.split())))
        table[:, 0], table[:, 1], table[:, 2:5], table[:, 5:8], table[:, 8] = np.arange(1, n + 1), kind, x, v, time
        table[:, 9], table[:, 10], table[:, 11], table[:, 12] = 0.25, x[:, 2] < 0, p, 300
        lines.append(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: ATOMS {COLUMNS}\n")
        lines += [" ".join(f"{value:.12g}" for value in row) + "\n" for row in table]
    pathlib.Path(path).write_text("".join(lines))
    return Dump(path)


def flight(path, frames=3):
    """a ball that flies along z, at 1 and 2 km/s in its halves"""
    x = ball(4e-3)
    kind = 1 + (x[:, 2] > 0)
    v = np.column_stack([0 * x[:, 0], 0 * x[:, 0], 1e3 * kind])
    return write(path, [(1e-6 * k, x + 2e-6 * k * v, kind, v, 1e9 * (kind - 1)) for k in range(frames)])


def unpacked(frame, columns):
    """(x (n, 3), [column, ...]) as view.js takes it"""
    data, n = zlib.decompress(base64.b64decode(frame["data"])), frame["n"]
    whole = np.frombuffer(data[:6 * n], "<u2").reshape(3, n).T
    assert len(data) == (6 + columns) * n
    return np.array(frame["low"]) + np.array(frame["size"]) * (whole / 65535), [np.frombuffer(data[(6 + k) * n:(7 + k) * n], np.uint8) for k in range(columns)]


# ---------------------------------------------------------------------- packing
@pytest.mark.parametrize("size", [(1.0, 1.0, 1.0), (1e-3, 250.0, 7.0), (0.0, 1e-9, 1e9)])
def test_positions_are_quantized_in_the_box(size):
    """none is farther away than half a step, the faces of the box are exact, and columns are as they were"""
    random = np.random.default_rng(1)
    x = random.random((5000, 3)) * size - 0.3 * np.array(size)
    columns = [random.integers(0, 256, len(x)).astype(np.uint8) for _ in range(3)]
    found, bytes_ = unpacked(packed.pack(x, columns), 3)
    assert (np.abs(found - x).max(axis=0) <= np.array(size) / 131070 * 1.000001 + 1e-16).all()
    assert (np.abs(found - x).max(axis=0) >= 0.9 * np.array(size) / 131070).all()  # 16 bits, not more
    for one, other in ((found.min(axis=0), x.min(axis=0)), (found.max(axis=0), x.max(axis=0))):
        np.testing.assert_allclose(one, other, rtol=1e-12)
    for one, other in zip(bytes_, columns):
        np.testing.assert_array_equal(one, other)
    assert packed.pack(np.zeros((0, 3)), [])["n"] == 0


def test_levels():
    """linear, by roots, on both sides of 0, and beyond the range"""
    assert list(packed.levels([-1, 0, 1, 2, 3, np.nan, np.inf], 0, 2)) == [0, 0, 128, 255, 255, 0, 255]
    assert list(packed.levels([0, 1, 4], 0, 4, root=True)) == [0, 128, 255]
    assert list(packed.levels([-4, -1, 0, 1, 4], -4, 4, root=True)) == [0, 64, 128, 191, 255]
    assert list(packed.levels([5, 5], 5, 5)) == [0, 0]


@pytest.mark.parametrize("particles, least", [(20_000, 30), (200_000, 6), (3_000_000, 6)])
def test_a_page_has_room(particles, least):
    """for so many frames of noise, which nothing makes smaller: 20 MB, and not much less"""
    random = np.random.default_rng(2)
    n = -(-particles // packed.stride_of(particles))
    assert n <= packed.PARTICLES
    size = len(packed.pack(random.random((n, 3)), list(random.integers(0, 256, (packed.COLUMNS, n)).astype(np.uint8)))["data"]) + 300
    frames = packed.frames_of(particles)
    assert frames >= least and 20e6 - 1.1 * size < frames * size <= 20e6


def test_frames_that_fit():
    """evenly in time, with the first, the last and the one that is wanted"""
    frames = [{"data": "x" * 1_000_000, "k": k} for k in range(60)]
    for wanted in (0, 31, 59):
        found, place = view.fitting(frames, wanted)
        assert 18 <= len(found) <= 20 and found[place]["k"] == wanted and (found[0]["k"], found[-1]["k"]) == (0, 59)
        assert {b["k"] - a["k"] for a, b in zip(found, found[1:])} <= {2, 3, 4}
    assert view.fitting(frames[:3], 1) == (frames[:3], 1)
    assert view.fitting([{"data": "x" * 30_000_000, "k": k} for k in range(3)], 1)[0][0]["k"] == 1


# ---------------------------------------------------------------------- scenes
def test_scene_of_a_dump(tmp_path):
    """positions in the unit shown, planes for images, fields with their ranges; the still picture is of the whole"""
    dump = flight(tmp_path / "a.dump")
    found = view.of_dump(dump, Silent(), view.Look(frame=1, color="speed"))
    record = json.loads(json.dumps(found.record))
    names = [field["name"] for field in record["fields"]]
    assert names == ["part", "speed (km/s)", "damage, 1: failed or spalled", "temperature (K)", "pressure (GPa)"]
    assert (record["unit"], record["mirror"], record["first"], record["color"], len(record["frames"])) == ("mm", [[0, 0.0], [1, 0.0]], 1, 1, 3)
    assert record["fields"][0]["parts"] == [[0, "type 1"], [1, "type 2"]] and record["fields"][4]["ticks"] == [["-1", 0.0], ["0", 0.5], ["1", 1.0]]
    assert [frame["when"] for frame in record["frames"]] == ["0.00 us", "1.00 us", "2.00 us"]
    frame = dump[1]
    x, (part, speed, damage, _, pressure) = unpacked(record["frames"][1], 5)
    assert np.abs(x - 1e3 * frame.x).max() < 1e-3
    np.testing.assert_array_equal(part, frame["type"] - 1)
    np.testing.assert_array_equal(speed, np.rint(255 * np.sqrt(0.5 * frame["type"])))  # 1 and 2 of 2 km/s
    np.testing.assert_array_equal(damage, np.where(frame["spalled"] > 0, 255, 64))
    np.testing.assert_array_equal(pressure, np.where(frame["type"] == 2, 255, 128))
    assert record["radius"] == pytest.approx(0.62, abs=0.005)
    assert len(found.last[0]) == 4 * len(frame) and found.last[0].min(axis=0) == pytest.approx([-3.5, -3.5, frame.x[:, 2].min() * 1e3])
    image = found.still(60)
    assert 0.2 < (image[..., 3] > 0).mean() < 0.9
    with pytest.raises(HVIError, match="no column for the color depth; it has: id type"):
        view.of_dump(dump, Silent(), view.Look(color="depth"), more=[view.Field("depth", ("depth",), lambda frame: frame["depth"])])


def test_more_particles_than_a_page_has_room_for(tmp_path, monkeypatch):
    """each third of them, the same ones in all frames, with the volume of three"""
    monkeypatch.setattr(packed, "PARTICLES", 25)
    dump = flight(tmp_path / "a.dump")
    n, whole = len(dump[0]), view.of_dump(dump, Silent())
    assert 50 < n <= 75 and f"at most {n} particles, of which each 3. is shown, with the volume of 3" in whole.note
    x = [unpacked(frame, 5)[0] for frame in whole.record["frames"]]
    np.testing.assert_allclose(x[0], 1e3 * dump[0].x[dump[0].ids % 3 == 0], atol=1e-3)
    assert (x[2] - x[0])[:, 2].min() > 3.9 and whole.record["radius"] == pytest.approx(3 ** (1 / 3) * 0.62, abs=0.01)


def test_range_of_pressures(tmp_path):
    """a thousandth at each end does not make all others gray, and the legend says so; speeds go to the largest"""
    random = np.random.default_rng(4)
    x, p, v = random.random((4000, 3)), 1e9 * random.uniform(-1, 1, 4000), np.zeros((4000, 3))
    p[0], v[0, 2] = 1e12, 9e3
    fields = view.of_dump(write(tmp_path / "a.dump", [(0, x, np.ones(4000), v, p)]), Silent(), diameter=0.1).record["fields"]
    (low, _), (middle, _), (high, _) = fields[4]["ticks"]
    assert low == f"\u2264 -{high[2:]}" and high[:2] == "\u2265 " and 0.99 < float(high[2:]) < 1.01 and middle == "0" and fields[1]["ticks"] == [["0", 0.0], ["2.25", 0.5], ["9", 1.0]]


def test_wrong_scenes(tmp_path, monkeypatch):
    """no particles; more types than colors; none of the particles that would be left"""
    empty = np.zeros((0, 3))
    with pytest.raises(HVIError, match="no frame has a particle"):
        view.of_dump(write(tmp_path / "empty.dump", [(0, empty, empty[:, 0], empty, empty[:, 0])]), Silent())
    x = np.random.default_rng(3).random((300, 3))
    with pytest.raises(HVIError, match="more than 256 types"):
        view.of_dump(write(tmp_path / "types.dump", [(0, x, np.arange(300), x, x[:, 0])]), Silent())
    monkeypatch.setattr(packed, "PARTICLES", 1)
    with pytest.raises(HVIError, match="no ID is a multiple of 2: dump a group of at most 1 particles"):
        path = tmp_path / "odd.dump"
        write(path, [(0, x[:2], np.ones(2), x[:2], x[:2, 0])])
        path.write_text(re.sub("^2 ", "3 ", path.read_text(), flags=re.M).replace("ATOMS\n3", "ATOMS\n2"))
        view.of_dump(Dump(path), Silent())


def test_one_particle(tmp_path):
    """alone in space: a view of it, not of nothing"""
    x = np.full((1, 3), 2.0)
    found = view.of_dump(write(tmp_path / "one.dump", [(0, x, np.ones(1), x, x[:, 0])]), Silent())
    assert found.record["wide"] > 0 and found.record["high"] > 0 and np.isfinite(found.record["deep"])
    json.dumps(found.record, allow_nan=False)


# ---------------------------------------------------------------------- pages
def test_texts_of_a_scene_are_escaped(tmp_path):
    """a name with HTML is text, in the page and within its record; the policy has the checksum of the script"""
    dump = flight(tmp_path / "a.dump")
    found = view.View(dump, lambda frame: np.zeros(len(frame), dtype=int), lambda k: (EVIL, (1.0, 0.0, 0.0), 1e-3), Silent())
    text = view.page(EVIL, found)
    assert text.count("<script>") == 1 and list(browser.wrong_scripts(text)) == []
    record = json.loads(html.unescape(re.search(r"<template>(.*?)</template>", text, re.S)[1]))
    assert record["fields"][0]["parts"] == [[0, EVIL]]
    assert "</script" not in view.script() and page.checksum("alert(1)") == "sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI="
    assert len(list(browser.wrong_scripts(text.replace("<main>", "<main><script>1</script>")))) == 1
    assert len(list(browser.wrong_scripts(text.replace("script-src", "script-src &#x27;unsafe-inline&#x27;")))) == 1


def test_command(tmp_path, capsys, monkeypatch):
    """writes beside the dump and opens, or only writes; without a screen it says so"""
    flight("a.dump")
    seen = []
    monkeypatch.setattr(command.webbrowser, "open", lambda address: bool(seen.append(address)) or True)
    monkeypatch.setenv("DISPLAY", ":0")
    assert cli.main(["view", "a.dump", "--output", "b.html"]) == 0 and not seen
    assert "view: b.html" in capsys.readouterr().out
    assert cli.main(["view", "a.dump"]) == 0 and seen == [pathlib.Path("a.html").resolve().as_uri()]
    assert "3 of 3 frames, of at most" in capsys.readouterr().out
    if sys.platform.startswith("linux"):
        monkeypatch.delenv("DISPLAY")
        monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
        assert cli.main(["view", "a.dump"]) == 0 and len(seen) == 1 and "open the file in one" in capsys.readouterr().out
    assert pathlib.Path("a.html").read_text() == pathlib.Path("b.html").read_text()


def test_the_color_is_the_one_asked_for(tmp_path, monkeypatch):
    """not another whose name begins alike; of a folder, too"""
    small = functools.partialmethod(view.View.still, width=40)  # the picture is most of the time
    monkeypatch.setattr(view.View, "still", small)
    flight(tmp_path / "a.dump")
    text = (tmp_path / "a.dump").read_text()
    (tmp_path / "b.dump").write_text(text.replace(" damage spalled", " s spalled"))
    for path, word, name in (("a.dump", "damage", "damage, 1: failed or spalled"), ("b.dump", "s", "s"), ("a.dump", "velocity", "speed (km/s)"), ("a.dump", "spalled", "spalled")):
        assert cli.main(["view", str(tmp_path / path), "--color", word, "--output", str(tmp_path / "v.html")]) == 0
        page_text = html.unescape((tmp_path / "v.html").read_text())
        scene = json.loads(re.search(r"<template>(.*?)</template>", page_text, re.S).group(1))
        assert scene["fields"][scene["color"]]["name"] == name, word


def test_in_a_browser(tmp_path):
    """draws, turns, goes through time, takes colors, cuts, at two widths; prints and stands still without WebGL. A page that does none of it is found"""
    if not chromium.found():
        pytest.skip("chromium is not there (Debian: apt-get install chromium)")
    found = view.of_dump(flight(tmp_path / "a.dump"), Silent())
    (tmp_path / "a.html").write_text(view.page("a ball", found), encoding="utf-8")
    seen, wrong = browser.look(tmp_path / "a.html", tmp_path / "out")
    assert wrong == []
    steps = {name: list(here["scene"]["steps"]) for name, here in seen.items()}
    assert set(steps) == {"desk", "phone"} and all({"turned by a drag", "at the other end of time", "colored by pressure (GPa)", "without mirror images"} <= set(one) for one in steps.values())
    still = {what: {**step, "changed": 0.0} for what, step in seen["desk"]["scene"]["steps"].items()}
    assert len(list(browser.wrong_scene({**seen["desk"]["scene"], "steps": still}))) == len(still) - 1


def test_speed_of_drawing(tmp_path, monkeypatch):
    """of a ball of as many particles as asked for, whose frames take a time"""
    x = scene.ball(1000)
    assert len(np.unique(np.round(2e3 * x), axis=0)) == 1000 and np.linalg.norm(x, axis=1).max() == pytest.approx(1e-3 * (0.75 * 1000 / np.pi) ** (1 / 3), rel=0.05)
    if not chromium.found():
        pytest.skip("chromium is not there (Debian: apt-get install chromium)")
    monkeypatch.setattr(scene, "MEASURE", scene.MEASURE.replace(f"< 1000 * {scene.SECONDS}", "< 300"))
    scene.speed(1000, tmp_path / "said.yaml")
    said = yaml.safe_load((tmp_path / "said.yaml").read_text())
    assert said["particles"] == 1000 and re.fullmatch("1\\d{3} x \\d{3}", said["canvas"]) and said["frame_ms"] > 0 and said["frames_per_s"] > 0
