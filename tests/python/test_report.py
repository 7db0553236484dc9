"""python3 -m hvi report, movie, export: one file that shows what a folder says and runs nothing of it; pictures; files for ParaView read back."""

import gzip
import html.parser
import json
import pathlib
import re

import numpy as np
import pytest
import yaml
from hvi import cli
from hvi.commands import movie
from hvi.errors import HVIError
from hvi.io.dump import Dump
from hvi.report import page, pictures, render, report, view
from hvi.shield import ble
from hvi.shield import case as cases
from hvi.shield.run import Run, runs_of

EVIL = "<script>alert(1)</script>"
NAME = "<img src=x onerror=alert(1)>"  # a name of a folder and of a file has no slash
COLUMNS = "id type mass x y z vx vy vz time_si p damage spalled vm e eps fragsize mirror_x_lo mirror_y_lo"


def lattice(kind, dx, low, high, radius, speed):
    """rows type x y z vz of a quarter of a cylinder, mm and m/s"""
    side = np.arange(0.5 * dx, radius, dx)
    z = np.arange(low + 0.5 * dx, high, dx)
    x = np.stack(np.meshgrid(side, side, z, indexing="ij"), -1).reshape(-1, 3)
    x = x[np.hypot(x[:, 0], x[:, 1]) < radius]
    return np.column_stack([np.full(len(x), kind), x, np.full(len(x), speed)])


def write_dump(path, step, time, rows, columns=COLUMNS):
    n = len(rows)
    table = np.zeros((n, len(columns.split())))
    table[:, 0], table[:, 1], table[:, 2] = np.arange(1, n + 1), rows[:, 0], 1e-6
    table[:, 3:6], table[:, 8], table[:, 9] = 1e-3 * rows[:, 1:4], rows[:, 4], time
    body = "\n".join(" ".join(f"{v:.9g}" for v in row) for row in table)
    path.write_text(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS ff ff ff\n-0.001 0.02\n-0.001 0.02\n-0.02 0.05\nITEM: ATOMS {columns}\n{body}\n")


def make_run(folder, dx, shift=0.0, verdict="fails", material="Al6061-T6.hvi", film=False, reason="wall 2 is perforated by a hole of 3 mm", outside=""):
    """what a run leaves of two walls, 6 mm apart"""
    folder.mkdir(parents=True)
    plan = {"projectile_particles": 8, "projectile_across": 4.0}
    for k, front in ((1, 0.0), (2, 7.0)):
        plan.update({f"wall{k}_{what}": value for what, value in (("particles", 100), ("layers", 1), ("radius_mm", 8.0), ("middle_mm", 0.0), ("struck_at_mm", 0.0),
                                                                  ("front_mm", front), ("thickness_mm", 1.0), ("spacing_mm", dx))})
    settings = {"quarter": "yes", "solid": "damage no spall voids", "tstop": 9.0}
    (folder / "plan.yaml").write_text(yaml.safe_dump({**plan, "materials": ["Al2017-T4.hvi", material, "Al6061-T6.hvi"], "settings": settings}))
    walls = [{"thickness_mm": 1.0, "material": "Al6061-T6.hvi"}, {"thickness_mm": 1.0, "material": "Al6061-T6.hvi", "gap_mm": 6}]
    case = {"projectile": {"diameter_mm": 4, "material": "Al2017-T4"}, "speed_km_s": 6, "walls": walls, "spacings_mm": [dx], "shifts": [shift], "settings": {"tstop": 9.0}}
    (folder / "case.yaml").write_text(yaml.safe_dump({**case, **({"not_modelled": [outside]} if outside else {})}))
    result = {"verdict": verdict, "reasons": [reason], "decided_by": "wall2", "margins": {"hole_mm": 3.0, "layers": 3}, "walls": 2, "walls_reached": 2,
              "energy_ratio": 0.9999, "momentum_error": 1e-15, "ranks": 1, "core_s": 4.0, "particles": 99, "lammps_version": 20250204}
    for k, until in ((1, 2.0), (2, 9.0)):
        result.update({f"wall{k}_until_us": until, f"wall{k}_bulge_over_thickness": 0.5, f"hole{k}_diameter_mm": 3.0, f"hole{k}_min_mm": 2.9, f"hole{k}_max_mm": 3.1, f"wall{k}_layers": 3})
    (folder / "result.yaml").write_text(yaml.safe_dump({**result, "package_version": "0.1.0"}, sort_keys=False))
    (folder / "job.yaml").write_text(yaml.safe_dump({"variables": {"dx": dx, "shift": shift, "thickness": [1, 1]}, "files": {material: "0" * 16}}))
    first, ball = lattice(2, dx, 0.0, 1.0, 8.0, 0.0), lattice(1, dx, 4.0, 6.0, 1.5, 5000.0)
    second = lattice(3, dx, 7.0, 8.0, 8.0, 100.0)
    second = second[np.hypot(second[:, 1], second[:, 2]) > 1.5]
    write_dump(folder / "cloud1.dump", 50, 2e-6, np.concatenate([ball, first]))
    write_dump(folder / "shield.dump", 200, 9e-6, np.concatenate([ball + [0, 0, 0, 6, -4000], first, second]))
    for k in range(3 if film else 0):
        write_dump(folder / f"film.{10 + 50 * k:09d}.dump", 10 + 50 * k, 1e-6 * (0.2 + 3 * k), np.concatenate([ball - [0, 0, 0, 3 - k, 0], first]))


@pytest.fixture(autouse=True)
def small(monkeypatch):
    """pictures of few pixels, for time"""
    monkeypatch.setattr(pictures, "DPI", 40)
    monkeypatch.setattr(movie, "DPI", 40)


@pytest.fixture
def no_pictures(monkeypatch):
    """for tests of texts: pictures are most of the time of a page"""
    monkeypatch.setattr(report.Report, "images", lambda self, bar: ("", []))
    monkeypatch.setattr(report.Report, "scene", lambda self, bar: "")


@pytest.fixture(name="several")
def folder_of_several(tmp_path):
    """as of hvi shield, with names and texts that are HTML"""
    folder = tmp_path / NAME
    material = f"{NAME}.hvi"
    (tmp_path / material).write_text(f"# DATE: 2026 UNITS: si\n# [S] a source & {EVIL} </pre>\n\neos gruneisen\n  rho0 2700\nstrength johnson-cook\n")
    for dx in (0.5, 1.0):
        make_run(folder / f"dx-{dx:g}", dx, material=str(tmp_path / material), film=dx == 0.5, reason=EVIL)
    (folder / "case.yaml").write_text(f"# {EVIL}\nspeed_km_s: 6\n")
    (folder / "verdict.yaml").write_text(yaml.safe_dump({"verdict": "fails", "reasons": [EVIL, "all 2 runs say so"], "notes": ["a note"], "runs": {"dx-1": "fails", "dx-0.5": "fails"},
                                                         "calibration": f"none: {EVIL}", "core_s": 8.0, "next_finer": {"spacings_mm": [0.5, 0.4], "runs": 1, "core_s": 20.0}, "command": f"python3 -m hvi shield '{NAME}.yaml'"}))
    return folder


class Seen(html.parser.HTMLParser):
    """elements, attributes and text of a page, as a browser takes them"""

    def __init__(self, text):
        super().__init__()
        self.elements, self.text, self.inside = [], [], []
        self.feed(text)

    def handle_starttag(self, name, attributes):
        self.elements.append((name, dict(attributes)))
        if name not in page.VOID:
            self.inside.append(name)

    def handle_endtag(self, name):
        assert self.inside.pop() == name, f"{name} is closed where it is not open"

    def handle_data(self, data):
        if not {"style", "script", "template"} & set(self.inside):
            self.text.append(data)

    def all(self, name):
        return [attributes for element, attributes in self.elements if element == name]


def test_report(several, capsys):
    """what comes from files is text; the finest run leads, all are in the table; no part is elsewhere"""
    assert cli.main(["report", str(several)]) == 0
    path = several / "report.html"
    assert capsys.readouterr().out.startswith(f"report: {path}")
    text = path.read_text()
    seen = Seen(text)
    assert not seen.inside and not {"iframe", "object", "link"} & {name for name, _ in seen.elements}
    assert re.findall(r"<script[^>]*>(.*?)</script>", text, re.S) == [view.script()]  # the browser runs it by its checksum, and no other: tests/verify/browser.py
    record = json.loads(html.unescape(re.search(r"<template>(.*?)</template>", text, re.S)[1]))
    assert [name for _, name in record["fields"][0]["parts"]] == ["projectile, Al2017-T4", f"wall 1, {NAME}", "wall 2, Al6061-T6"] and len(record["frames"]) == 5
    assert not any(key.startswith("on") for _, attributes in seen.elements for key in attributes)
    pictures = seen.all("img")
    assert len(pictures) >= 12 and all(p["src"].startswith("data:image/png;base64,") and p["alt"] for p in pictures)
    assert all(a["href"].startswith("#") for a in seen.all("a")) and {a["href"][1:] for a in seen.all("a")} <= {s.get("id") for s in seen.all("section")}
    assert "http" not in re.sub(r"base64,[^\"]*|<template>.*?</template>|http-equiv", "", text.replace(view.script(), ""), flags=re.S)
    words = "".join(seen.text)
    assert words.count(EVIL) >= 4 and f"How sure: none: {EVIL}." in words and NAME in words  # reasons, case, source
    order = re.findall(r"<h[123]>([^<]*)", text)
    wanted = ["Verdict", "Reasons", "Notes", "What the verdict cannot know", "Scene in 3D", "What was run", "Side view in time", "Speeds", "Walls", "Bulge of wall 2", "Where the cloud strikes", "How near it was",
              "Ballistic-limit equations", "Resolution and ledger", "All runs", "Materials and their sources", "Settings", "Repeat it", "Versions"]
    assert order[0].startswith("Does the shield hold?") and [title for title in order if title in wanted and title != "Walls"] == [title for title in wanted if title != "Walls"]
    assert "finest run, dx-0.5 (spacing 0.5 mm)" in words and "dx-1" in words and f"python3 -m hvi shield '{NAME}.yaml'" in words
    assert "mpirun -np 1 lmp -in in.shield && python3 -m hvi judge ." in words
    assert "next finer: spacings_mm: [0.5, 0.4]: 1 more runs" in words
    assert "HAS CHANGED since the run" in words and "damage no spall voids" in words
    assert [d for d in seen.all("div") if d.get("class") == "said"] and "\u2715 fails" in words and seen.all("body")[0]["class"] == "fails"


def test_report_of_one_run(tmp_path, capsys):
    """says that one run is one; a verdict that holds is not red; equations have the strength that the case says, and no text says otherwise"""
    make_run(tmp_path / "one", 1.0, verdict="holds")
    path = tmp_path / "one/case.yaml"
    case = yaml.safe_load(path.read_text())
    case["walls"][1]["yield_ksi"] = 10
    path.write_text(yaml.safe_dump(case))
    (tmp_path / "one/job.yaml").unlink()
    assert cli.main(["report", str(tmp_path / "one"), "--out", "a.html"]) == 0
    seen = Seen((tmp_path / "a.html").read_text())
    words = "".join(seen.text)
    assert f"JSC: JSC Whipple 2011 [RC11]{ble.predictions(cases.read(path))['JSC']['critical_diameter_mm']:.4g}" in words and "whatever yield_ksi" not in words
    assert "One run: nothing says how far" in words and seen.all("body")[0]["class"] == "holds"


def test_report_of_a_run_by_hand(tmp_path, capsys, no_pictures):
    """equations say nothing of what is not modelled; core-seconds may be unknown"""
    make_run(tmp_path / "one", 1.0, verdict="undecided", outside="MLI, of 20 layers")
    (tmp_path / "one/job.yaml").unlink()
    path = tmp_path / "one/result.yaml"
    path.write_text(path.read_text().replace("core_s: 4.0", "core_s: .nan"))
    assert cli.main(["report", str(tmp_path / "one"), "--out", "a.html"]) == 0
    words = "".join(Seen((tmp_path / "a.html").read_text()).text)
    assert "do not have what one names in not_modelled: MLI, of 20 layers" in words and "JSC Whipple 2011" not in words and "unknowncore time of 1 run" in words


def test_report_of_what_is_not_known(several, capsys):
    """a hole that nobody knows, reasons that are one text"""
    result = several / "dx-1/result.yaml"
    result.write_text(result.read_text().replace("hole1_diameter_mm: 3.0", "hole1_diameter_mm: .nan"))
    verdict = yaml.safe_load((several / "verdict.yaml").read_text())
    (several / "verdict.yaml").write_text(yaml.safe_dump({**verdict, "reasons": "one text", "core_s": None}))
    assert cli.main(["report", str(several)]) == 0
    text = (several / "report.html").read_text()
    assert "<td>unknown</td>" in text and "<td>nan</td>" not in text and "<li>one text</li>" in text


def test_wrong_folders(tmp_path, capsys):
    make_run(tmp_path / "run", 1.0)
    (tmp_path / "empty").mkdir()
    for folder, message in (("none", "is not a folder"), ("empty", "neither verdict.yaml (of python3 -m hvi shield) nor result.yaml")):
        assert cli.main(["report", str(tmp_path / folder)]) == 1 and message in capsys.readouterr().err
    result = tmp_path / "run/result.yaml"
    whole = result.read_text()
    result.write_text(whole.replace("package_version", "version"))
    assert cli.main(["report", str(tmp_path / "run")]) == 1 and "no complete result.yaml" in capsys.readouterr().err
    result.write_text(whole.replace("verdict: fails", "verdict: perhaps"))
    assert cli.main(["report", str(tmp_path / "run")]) == 1 and "must be holds, fails, undecided, not perhaps" in capsys.readouterr().err
    result.write_text(whole)
    plan = (tmp_path / "run/plan.yaml").read_text()
    (tmp_path / "run/plan.yaml").write_text(plan.replace("wall2_radius_mm", "wall2_r"))
    assert cli.main(["report", str(tmp_path / "run")]) == 1 and "run/plan.yaml has no wall2_radius_mm: it is of another version" in capsys.readouterr().err
    (tmp_path / "run/plan.yaml").write_text(plan)
    result.write_text(whole.replace("ranks:", "rank:"))
    assert cli.main(["report", str(tmp_path / "run")]) == 1 and "run/result.yaml has no ranks: it is of another version" in capsys.readouterr().err
    result.write_text(whole)
    (tmp_path / "empty/verdict.yaml").write_text("verdict: holds\nruns: {}\n")
    assert cli.main(["report", str(tmp_path / "empty")]) == 1 and "verdict.yaml names no runs" in capsys.readouterr().err
    (tmp_path / "run/plan.yaml").write_text("steps: 3\n")
    assert cli.main(["report", str(tmp_path / "run")]) == 1 and "does not say what was run" in capsys.readouterr().err


# ---------------------------------------------------------------------- pictures
def test_nearest_sphere_is_seen():
    """depth of the middle of a sphere is its top; the nearer one hides the other, whatever comes first"""
    x = np.array([[0.0, 0.0, 2.0], [-0.1, 0.0, 0.0], [3.0, 0.0, 0.0]])
    for order in ([0, 1, 2], [2, 1, 0]):
        depth, who = render.splat(x[order], np.ones(3), (-2.0, 5.0, -2.0, 2.0), (80, 140))
        assert order[who[40, 40]] == 0 and depth[40, 40] == pytest.approx(3.0, abs=0.01)
        assert order[who[40, 100]] == 2 and depth[40, 100] == pytest.approx(1.0, abs=0.01)
        assert who[0, 0] == -1 and depth[0, 0] == -np.inf and (who >= 0).mean() * 28.0 == pytest.approx(2.0 * np.pi + 0.2, rel=0.01), order  # two discs, and what of a third is beside the first


def test_light_and_shadow():
    """above to the left is brighter; a plate under a sphere is darker on the other side of it; nothing is clear"""
    gray = np.full((1, 3), 0.6)
    image = render.picture(np.zeros((1, 3)), np.ones(1), gray, np.eye(3), (-1.5, 1.5, -1.5, 1.5), 90).astype(int)
    assert image.shape == (90, 90, 4) and image[30, 30, 0] > image[60, 60, 0] + 30 and image[45, 45, 3] == 255 and image[2, 2, 3] == 0
    side = np.arange(-5, 5, 0.25)
    plate = np.stack(np.meshgrid(side, side, [0.0], indexing="ij"), -1).reshape(-1, 3)
    x = np.concatenate([plate, [[0.0, 0.0, 3.0]]])
    radius = np.append(np.full(len(plate), 0.2), 1.0)
    image = render.picture(x, radius, np.repeat(gray, len(x), axis=0), np.eye(3), (-5.0, 5.0, -5.0, 5.0), 100).astype(int)
    light = -render.LIGHT[:2] / render.LIGHT[2] * 3.0  # where its shadow falls
    dark, bright = (image[int(50 - 10 * s * light[1]) - 3:, :][:6, int(50 + 10 * s * light[0]) - 3:][:, :6, 0].mean() for s in (1.0, -1.0))
    assert dark < 0.9 * bright


def test_scene_is_the_whole(tmp_path):
    """four times the particles of a quarter, in mm, us, km/s; spheres of their volume"""
    make_run(tmp_path / "run", 0.5)
    run = Run(tmp_path / "run")
    scene = run.scene("shield.dump")
    part = len(scene.frame)
    assert len(scene.x) == 4 * part and scene.time == pytest.approx(9.0) and scene.v[:, 2].max() == pytest.approx(1.0)
    assert sorted(np.unique(scene.body)) == [0, 1, 2] and scene.x[:, 0].min() == pytest.approx(-scene.x[:, 0].max())
    assert 4 / 3 * np.pi * scene.radius[scene.body == 0][0] ** 3 == pytest.approx(0.125)
    left = pictures.body_of(run, scene, 2)
    assert len(left) == (scene.body == 2).sum()
    case = run.case
    assert (case.diameter_mm, case.speed_km_s, [w.gap_mm for w in case.walls]) == (4.0, 6.0, [None, 6.0])


def write_whole(folder, walls):
    """shield.dump of a run as a whole model: [(wall, front and rear in mm, (x, y) of a hole of 3 mm or None), ...]"""
    side, rows = np.arange(-7.75, 8, 0.5), []
    for k, low, high, hole in walls:
        x = np.stack(np.meshgrid(side, side, np.arange(low + 0.25, high, 0.5), indexing="ij"), -1).reshape(-1, 3)
        x = x[np.hypot(x[:, 0], x[:, 1]) < 8]
        x = x[np.hypot(x[:, 0] - hole[0], x[:, 1] - hole[1]) > 1.5] if hole else x
        rows.append(np.column_stack([np.full(len(x), 1 + k), x, np.zeros(len(x))]))
    write_dump(folder / "shield.dump", 200, 9e-6, np.concatenate(rows), COLUMNS.replace("mirror_x_lo mirror_y_lo", "mirror_none"))


def test_the_circle_is_at_the_hole(tmp_path):
    """of an oblique shot it is not where the shot struck, on both faces; without a hole in the frame it is there"""
    make_run(tmp_path / "run", 0.5)
    write_whole(tmp_path / "run", [(1, 0.0, 1.0, None), (2, 7.0, 8.0, (2.0, -1.0))])
    run = Run(tmp_path / "run")
    scene = run.scene("shield.dump")
    assert pictures.hole_center(run, scene, 2) == pytest.approx((2.0, -1.0), abs=0.1) and pictures.hole_center(run, scene, 1) == (0.0, 0.0)
    for rear, y in ((False, -1.0), (True, 1.0)):  # the view from behind has -y to the right
        (circle,) = pictures.face(run, scene, 2, rear).axes[0].lines
        middle = [0.5 * (values.min() + values.max()) for values in (circle.get_xdata(), circle.get_ydata())]
        assert middle == pytest.approx([y, 2.0], abs=0.1) and np.ptp(circle.get_xdata()) == pytest.approx(3.0, abs=0.01), f"rear {rear}"


def test_a_wall_near_by_hides_no_other(tmp_path):
    """a wall 1 that is within the reach of wall 2 is in no picture of it; its debris on wall 2 is"""
    make_run(tmp_path / "run", 0.5)
    plan = tmp_path / "run/plan.yaml"
    plan.write_text(plan.read_text().replace("wall2_front_mm: 7.0", "wall2_front_mm: 2.0"))
    write_whole(tmp_path / "run", [(1, 0.0, 1.0, None), (1, 4.5, 5.0, (0.0, 0.0)), (2, 2.0, 3.0, None)])
    run = Run(tmp_path / "run")
    scene = run.scene("shield.dump")

    def layers(k, body):
        return [*np.unique(np.round(scene.x[pictures.near_wall(run, scene, k) & (scene.body == body), 2], 2))]
    assert layers(2, 1) == [4.75] and layers(2, 2) == [2.25, 2.75]
    assert layers(1, 1) == [0.25, 0.75] and layers(1, 2) == []


def test_energy_of_the_tile_is_the_largest_of_the_table(tmp_path, no_pictures):
    """no tile with a small error over a table with a large one"""
    make_run(tmp_path / "one", 1.0)
    result = tmp_path / "one/result.yaml"
    text = result.read_text()
    for missed, tile in ((7.4e-4, "<b>7.4e-04</b><span>energy missed by the time integration"), (-7.4e-6, "<b>1.0e-04</b><span>energy missing in the ledger")):
        result.write_text(f"energy_missed_ratio: {missed}\n{text}")
        assert cli.main(["report", str(tmp_path / "one")]) == 0 and tile in (tmp_path / "one/report.html").read_text(), missed


# ---------------------------------------------------------------------- movie and export
def test_movie(several, tmp_path, capsys):
    """a frame for each moment, the last stays; with too few of them a remedy"""
    from PIL import Image

    assert cli.main(["movie", str(several), "--rate", "10", "--out", "m.gif"]) == 0 and "5 frames, dx-0.5" in capsys.readouterr().out
    with Image.open(tmp_path / "m.gif") as image:
        assert image.n_frames == 5 and image.info["duration"] == 100
        image.seek(4)
        assert image.info["duration"] == 600
    assert cli.main(["movie", str(several / "dx-1")]) == 1 and "2 frames, too few for a movie: give the case settings: {film: 1}" in capsys.readouterr().err


def test_export_read_back(several, tmp_path, capsys):
    """positions, velocities and columns with units as in the dump, of the whole; times in the PVD"""
    meshio = pytest.importorskip("meshio", reason="meshio is not there (Debian: python3-meshio)")
    assert cli.main(["export", str(several), "--out", "a/shield.pvd"]) == 1 and "cannot write" in capsys.readouterr().err
    for folder in (".", ".."):
        assert cli.main(["export", str(several), "--out", folder]) == 1 and f"--out {folder} is a folder: it must be a name" in capsys.readouterr().err
    assert cli.main(["export", str(several)]) == 0
    assert "5 frames, lengths in m, times in s" in capsys.readouterr().out
    import xml.etree.ElementTree as tree

    sets = tree.parse(several / "shield.pvd").getroot().findall("Collection/DataSet")
    assert [float(s.get("timestep")) for s in sets] == pytest.approx([0.2e-6, 2e-6, 3.2e-6, 6.2e-6, 9e-6])
    mesh = meshio.read(several / sets[-1].get("file"))
    scene = Run(several / "dx-0.5").scene("shield.dump").whole
    np.testing.assert_array_equal(mesh.points, scene.x)
    np.testing.assert_array_equal(mesh.point_data["velocity (m/s)"], scene.v)
    np.testing.assert_array_equal(mesh.point_data["mass (kg)"], scene.m)
    assert {"p (Pa)", "vm (Pa)", "e (J/kg)", "damage", "type", "fragsize (m)"} <= set(mesh.point_data) and not {"x", "time_si", "mirror_x_lo"} & set(mesh.point_data)
    assert cli.main(["export", str(several / "dx-0.5/shield.dump"), "--part", "--out", str(tmp_path / "part")]) == 0
    assert len(meshio.read(tmp_path / "part.0000.vtu").points) == len(mesh.points) // 4


def test_export_without_meshio(several, monkeypatch):
    """numbers of a VTU file are after their length in bytes, in base 64, whole numbers as such"""
    import base64
    import xml.etree.ElementTree as tree

    monkeypatch.setitem(__import__("sys").modules, "meshio", None)
    assert cli.main(["export", str(several), "--out", "x"]) == 0
    piece = tree.parse("x.0004.vtu").getroot().find("UnstructuredGrid/Piece")
    scene = Run(several / "dx-0.5").scene("shield.dump").whole
    n = len(scene.x)
    assert (piece.get("NumberOfPoints"), piece.get("NumberOfCells")) == (str(n), str(n))

    def values(element):
        data = base64.b64decode(element.text, validate=True)
        assert int.from_bytes(data[:8], "little") == len(data) - 8 and element.get("format") == "binary"
        return np.frombuffer(data[8:], {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[element.get("type")])
    np.testing.assert_array_equal(values(piece.find("Points/DataArray")), scene.x.ravel())
    cells = {element.get("Name"): values(element) for element in piece.findall("Cells/DataArray")}
    assert list(cells["connectivity"]) == list(range(n)) and list(cells["offsets"]) == list(range(1, n + 1)) and set(cells["types"]) == {1}  # VTK_VERTEX
    assert piece.find("Points/DataArray").get("Name") == "position (m)"
    said = {element.get("Name"): values(element) for element in tree.parse("x.0004.vtu").getroot().findall("UnstructuredGrid/FieldData/DataArray")}
    assert said["TimeValue"] == [9e-6] and said["type 1: projectile, Al2017-T4"] == [1] and said["type 3: wall 2, Al6061-T6"] == [3] and len(said) == 4
    kinds = {element.get("Name"): element.get("type") for element in piece.findall("PointData/DataArray")}
    assert kinds["type"] == "Int64" and kinds["mass (kg)"] == "Float64" and {element.get("NumberOfComponents") for element in piece.findall("PointData/DataArray")} == {None, "3"}


def test_export_to_ovito(tmp_path, capsys):
    """one dump of all frames, whole, with units, times, names of types and units in the names of columns; our own reader takes it back"""
    make_run(tmp_path / "run", 1.0)
    assert cli.main(["export", str(tmp_path / "run"), "--to", "ovito", "--out", "x"]) == 0
    assert capsys.readouterr().out.strip() == "exported: x.lammpstrj, 2 frames, lengths in m, times in s; types: 1 projectile, Al2017-T4; 2 wall 1, Al6061-T6; 3 wall 2, Al6061-T6"
    dump, scene = Dump("x.lammpstrj", mirror="none"), Run(tmp_path / "run").scene("shield.dump").whole
    frame = dump[1]
    assert (dump.units, list(dump.steps), [dump.time(k) for k in range(2)]) == ("si", [50, 200], [2e-6, 9e-6])
    np.testing.assert_allclose(frame.x, scene.x, rtol=1e-8)
    np.testing.assert_allclose(frame.v, scene.v, rtol=1e-8)
    np.testing.assert_array_equal(frame.ids, scene.ids)
    assert {"p_Pa", "vm_Pa", "e_J/kg", "fragsize_m", "mass"} <= set(frame.columns) and not {"time_si", "mirror_x_lo"} & set(frame.columns)
    assert {(kind, name) for kind, name in zip(frame["type"], frame["element"])} >= {(1, "projectile_Al2017-T4"), (3, "wall2_Al6061-T6")}


@pytest.mark.long
def test_export_in_vtk(tmp_path):
    """VTK's own reader, which is that of ParaView, finds time, names of types, units, positions and velocities"""
    pytest.importorskip("vtkmodules", reason="VTK's Python module is not there (Debian: python3-vtk9)")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    make_run(tmp_path / "run", 1.0)
    assert cli.main(["export", str(tmp_path / "run"), "--out", "x"]) == 0
    frames = Run(tmp_path / "run").frames()
    assert len(frames) == 2
    for k, frame in enumerate(frames):
        whole, reader = frame.whole(), vtkXMLUnstructuredGridReader()
        reader.SetFileName(f"x.{k:04d}.vtu")
        reader.Update()
        grid = reader.GetOutput()
        points, data, said = grid.GetPoints().GetData(), grid.GetPointData(), grid.GetFieldData()
        assert (reader.GetErrorCode(), points.GetName(), grid.GetNumberOfCells(), {grid.GetCellType(cell) for cell in (0, len(whole) - 1)}) == (0, "position (m)", len(whole), {1})  # VTK_VERTEX
        np.testing.assert_array_equal(vtk_to_numpy(points), whole.x)
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("velocity (m/s)")), whole.v)
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("type")), whole["type"])
        assert {"p (Pa)", "vm (Pa)", "e (J/kg)", "damage", "fragsize (m)", "mass (kg)"} <= {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
        found = {said.GetArrayName(i): said.GetArray(i).GetTuple1(0) for i in range(said.GetNumberOfArrays())}
        assert found == {"TimeValue": frame.time, "type 1: projectile, Al2017-T4": 1, "type 2: wall 1, Al6061-T6": 2, "type 3: wall 2, Al6061-T6": 3}


@pytest.mark.long
def test_export_in_ovito(tmp_path):
    """OVITO finds frames, times, names of types, positions, velocities and columns with their units"""
    io = pytest.importorskip("ovito.io", reason="OVITO's Python module is not there (pip install ovito)")
    make_run(tmp_path / "run", 1.0)
    assert cli.main(["export", str(tmp_path / "run"), "--to", "ovito", "--out", "x"]) == 0
    pipeline, frames = io.import_file("x.lammpstrj"), Run(tmp_path / "run").frames()
    assert pipeline.source.num_frames == len(frames) == 2
    for k, frame in enumerate(frames):
        whole, data = frame.whole(), pipeline.compute(k)
        assert (data.attributes["Timestep"], data.attributes["Time"]) == (frame.step, pytest.approx(frame.time))
        np.testing.assert_array_equal(data.particles["Particle Identifier"], whole.ids)
        np.testing.assert_allclose(data.particles["Position"], whole.x, rtol=1e-8)
        np.testing.assert_allclose(data.particles["Velocity"], whole.v, rtol=1e-8)
        np.testing.assert_allclose(data.particles["Mass"], whole.m, rtol=1e-8)
        np.testing.assert_array_equal(data.particles["Particle Type"], whole["type"])
        assert {one.id: one.name for one in data.particles["Particle Type"].types}.items() >= {(kind, {1: "projectile_Al2017-T4", 2: "wall1_Al6061-T6", 3: "wall2_Al6061-T6"}[kind]) for kind in set(whole["type"])}
        assert {"p_Pa", "vm_Pa", "damage", "fragsize_m"} <= set(data.particles.keys())


@pytest.mark.parametrize("box", ["BOX BOUNDS pp ff ff\n-1 1\n-2 2\n-3 3\n", "BOX BOUNDS xy xz yz pp pp pp\n-1 1.5 0.5\n-2 2 0\n-3 3 0\n"])
def test_export_of_boxes(tmp_path, box):
    """periodic and triclinic ones stay what they are; coordinates are unwrapped; types have the names that are given"""
    (tmp_path / "a.dump").write_text(f"ITEM: UNITS\nlj\nITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: {box}ITEM: ATOMS id type x y z ix iy iz\n1 1 0.5 0 0 1 0 0\n2 2 0 1 0 0 0 0\n")
    assert cli.main(["export", "a.dump", "--to", "ovito", "--names", "ball", "my plate", "--mirror", "none", "--mass", "1=1", "--mass", "2=3"]) == 0
    old, new = Dump("a.dump", mirror="none")[0], Dump("a.lammpstrj", mirror="none")[0]
    np.testing.assert_allclose(new.x, old.x)
    np.testing.assert_allclose(new.box.vectors, old.box.vectors)
    np.testing.assert_allclose(new.box.origin, old.box.origin)
    assert new.box.periodic == old.box.periodic and new.x[0, 0] > 2 and list(new["element"]) == ["ball", "myplate"] and list(new["mass"]) == [1, 3] and new.units == "lj" and new.time is None


LJ = "ITEM: UNITS\nlj\nITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-2 2\n-3 3\nITEM: ATOMS id type x y z\n1 1 0.5 0 0\n2 2 0 1 0\n"
OVITO = ["--to", "ovito", "--mirror", "none"]


def test_export_leaves_what_it_reads(tmp_path, capsys):
    """a dump by the name of what would be written, plain, packed, linked, or of another frame, stays whole; so does what was there if the export fails"""
    dump, packed = tmp_path / "x.lammpstrj", tmp_path / "y.lammpstrj.gz"
    dump.write_text(LJ)
    packed.write_bytes(gzip.compress(LJ.encode()))
    (tmp_path / "y.lammpstrj").write_text("of another run")
    for name, out in (("x.lammpstrj", "x.ovito.lammpstrj"), ("y.lammpstrj.gz", "y.ovito.lammpstrj")):
        assert cli.main(["export", name, *OVITO]) == 0 and f"exported: {out}, 1 frames" in capsys.readouterr().out and len(Dump(out, mirror="none")[0]) == 2
    (tmp_path / "z.lammpstrj").symlink_to(dump)
    (tmp_path / "z.pvd").symlink_to(dump)
    (tmp_path / "v.0000.vtu").symlink_to(dump)
    (tmp_path / "w.dump").write_text(LJ.replace("\n7\n", "\n5\n"))
    for words in (["x.lammpstrj", *OVITO, "--out", "x"], ["x.lammpstrj", *OVITO, "--out", "z.lammpstrj"], ["x.lammpstrj", "--mirror", "none", "--out", "z"], ["x.lammpstrj", "--mirror", "none", "--out", "v"],
                  ["w.dump", "x.lammpstrj", *OVITO, "--out", "x"]):
        assert cli.main(["export", *words]) == 1 and "is read here and cannot be written: give another --out" in capsys.readouterr().err, words
    assert dump.read_text() == LJ and (tmp_path / "y.lammpstrj").read_text() == "of another run"
    (tmp_path / "w.dump").write_text(LJ + LJ.replace("\n7\n", "\n8\n").replace("2 2 0", "1 2 0"))  # the second frame has a particle twice
    (tmp_path / "w.lammpstrj").write_text("of an earlier call")
    assert cli.main(["export", "w.dump", *OVITO]) == 1 and (tmp_path / "w.lammpstrj").read_text() == "of an earlier call" and not list(tmp_path.glob("*.new"))
    (tmp_path / "folder.lammpstrj").mkdir()
    capsys.readouterr()
    assert cli.main(["export", "x.lammpstrj", *OVITO, "--out", "folder"]) == 1 and "cannot write folder.lammpstrj: Is a directory" in capsys.readouterr().err


def test_export_of_names_that_do_not_fit(tmp_path, capsys):
    """types with labels keep them; a name is never empty, which would shift columns"""
    (tmp_path / "a.dump").write_text(LJ.replace("1 1 0.5", "1 Al 0.5").replace("2 2 0", "2 Cu 0"))
    for to in ([], ["--to", "ovito"]):
        assert cli.main(["export", "a.dump", "--mirror", "none", *to, "--names", "ball", "plate"]) == 1
        assert "--names: types have labels already in a.dump, such as Al: leave --names out" in capsys.readouterr().err
        assert cli.main(["export", "a.dump", "--mirror", "none", *to, "--names", "ball", " "]) == 1 and "--names: a name is empty" in capsys.readouterr().err
    assert cli.main(["export", "a.dump", *OVITO]) == 0 and list(Dump("a.lammpstrj", mirror="none")[0]["type"]) == ["Al", "Cu"]


def test_texts_are_escaped():
    """whatever is no Html is text, in attributes too"""
    made = page.tag("p", EVIL, page.tag("b", "x & y"), title='"><i>')
    assert made == '<p title="&quot;&gt;&lt;i&gt;">&lt;script&gt;alert(1)&lt;/script&gt;<b>x &amp; y</b></p>'
    assert EVIL not in page.table(("a",), [(EVIL,), (1.5,)], EVIL) and EVIL not in page.join([EVIL])


def test_only_runs_that_are_whole(several):
    """a verdict of runs that are not there is no report"""
    said = yaml.safe_load((several / "verdict.yaml").read_text())
    said["runs"]["dx-2"] = "fails"
    (several / "verdict.yaml").write_text(yaml.safe_dump(said))
    with pytest.raises(HVIError, match="dx-2: no complete result.yaml"):
        runs_of(pathlib.Path(several))
