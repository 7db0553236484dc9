#!/usr/bin/env python3
# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The scene in 3D of python3 -m hvi view in headless Chromium without a graphics card: its picture for the pages, and how fast it is drawn.

    tests/verify/scene.py picture RUNS OUT.png         of a folder as of hvi report: three times of the finest run; doc/src/img/view_scene.png is that of quick.yaml
    tests/verify/scene.py speed PARTICLES OUT.yaml     of a ball of so many particles, in a window of 1400 pixels: one frame, and frames per second while it turns
"""

import io
import pathlib
import sys
import tempfile

import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests/lib")]

import chromium  # noqa: E402
from hvi.io import packed  # noqa: E402
from hvi.io.dump import Dump  # noqa: E402
from hvi.progress import Silent  # noqa: E402
from hvi.report import view  # noqa: E402
from hvi.shield.run import runs_of  # noqa: E402

PANEL, WINDOW = 470, 1400  # pixels
FRAMES, SECONDS = 7, 10  # of the measurement
# time from the begin of drawing a frame until its pixels are there, ms, in the order of drawing; frames that a turning scene shows in a second
MEASURE = """(async () => {
  const canvas = document.querySelector(".scene canvas"), gl = canvas.getContext("webgl2"), pixel = new Uint8Array(4), next = () => new Promise(requestAnimationFrame);
  const turn = () => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", cancelable: true })), ms = [];
  const drawn = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits for it
  for (let k = 0; k < %d; k++) {
    let begin = 0;
    requestAnimationFrame(() => { drawn(); begin = performance.now(); }); // before the scene asks for its frame, which is drawn between the two
    turn();
    await next();
    drawn();
    ms.push(performance.now() - begin);
  }
  let shown = 0;
  const begin = performance.now();
  while (performance.now() - begin < 1000 * %d) {
    turn();
    await next();
    shown++;
  }
  drawn();
  return { ms, rate: 1000 * shown / (performance.now() - begin), width: canvas.width, height: canvas.height };
})()""" % (FRAMES, SECONDS)


def picture(runs, out):
    """the projectile in wall 1, the cloud before wall 2, the end; the second and third cut, by speed and by part"""
    from matplotlib import font_manager
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), 15)
    run = runs_of(runs)[1][0]
    struck = float(run.result["wall1_until_us"])  # so long it takes until the cloud strikes wall 2, or the end
    found = view.of_run(run, Silent())
    times = [float(frame["when"].split()[0]) for frame in found.record["frames"]]
    panels = []
    with tempfile.TemporaryDirectory() as folder, chromium.Chromium() as browser:
        page = pathlib.Path(folder, "scene.html")
        page.write_text(view.page(run.name, found), encoding="utf-8")
        browser.open(page, PANEL)
        browser.wait_for_scene()
        for time, color, cut in ((0.4 * struck, "pressure", "none"), (struck, "speed", "y >"), (times[-1], "part", "y >")):
            frame = min((abs(one - time), k) for k, one in enumerate(times))[1]
            number = next(k for k, field in enumerate(found.record["fields"]) if field["name"].startswith(color))
            for name, value, event in (("time", frame, "input"), ("color", number, "change"), ("cut", cut, "change")):
                browser.run(f"(() => {{ const e = document.querySelector('[data-is={name}]'); e.value = '{value}'; e.dispatchEvent(new Event('{event}')); }})()")
            browser.run(f"(async () => {{ while (document.querySelector('.scene').dataset.frame !== '{frame}') await new Promise(requestAnimationFrame); }})()")
            shot = pathlib.Path(folder, "shot.png")
            browser.shot(shot, ".stage")
            panels.append(Image.open(io.BytesIO(shot.read_bytes())).convert("RGB"))
            ImageDraw.Draw(panels[-1]).text((12, 10), f"{times[frame]:.1f} us, {color}", fill=(28, 35, 41), font=font)
    whole = Image.new("RGB", (sum(one.width for one in panels), panels[0].height), "white")
    for k, one in enumerate(panels):
        whole.paste(one, (k * one.width, 0))
    whole.save(out, optimize=True)


def ball(number):
    """(n, 3) of so many points of a cubic lattice of spacing 1 mm, those that are nearest to its middle, m"""
    half = np.ceil((0.75 * number / np.pi) ** (1 / 3)) + 1
    side = np.arange(-half, half) + 0.5
    x = np.stack(np.meshgrid(side, side, side, indexing="ij"), -1).reshape(-1, 3)
    return 1e-3 * x[np.argsort(np.linalg.norm(x, axis=1), kind="stable")[:number]]


def speed(number, out):
    if number > packed.PARTICLES:
        raise SystemExit(f"scene.py: of more than {packed.PARTICLES} particles the scene leaves some out")
    with tempfile.TemporaryDirectory() as folder, chromium.Chromium() as browser:
        x, dump, page = ball(number), pathlib.Path(folder, "ball.dump"), pathlib.Path(folder, "ball.html")
        rows = np.random.default_rng(1).permutation(np.column_stack([np.arange(1, number + 1), 1 + (x[:, 2] > 0), x, 1e3 * x]))  # in no order, as particles of a run after a while
        head = f"ITEM: UNITS\nsi\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{number}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: ATOMS id type x y z vx vy vz"
        np.savetxt(dump, rows, "%d %d %g %g %g %g %g %g", header=head, comments="")
        page.write_text(view.page("ball", view.of_dump(Dump(dump), Silent(), look=view.Look(color="speed"))), encoding="utf-8")
        browser.open(page, WINDOW)
        browser.wait_for_scene()
        found = browser.run(MEASURE)
    said = {"particles": number, "canvas": f"{found['width']} x {found['height']}", "frame_ms": round(float(np.median(found["ms"])), 1), "frames_per_s": round(found["rate"], 2)}
    pathlib.Path(out).write_text(yaml.safe_dump(said, sort_keys=False))
    print(said)


def main(words):
    if not chromium.found():
        print("scene.py: skipped, chromium is not there (Debian: apt-get install chromium)")
        raise SystemExit(77)  # as tests/verify/whole.py knows it
    elif len(words) == 3 and words[0] == "picture":
        picture(words[1], words[2])
    elif len(words) == 3 and words[0] == "speed" and words[1].isdigit():
        speed(int(words[1]), words[2])
    else:
        raise SystemExit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
