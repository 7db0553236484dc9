#!/usr/bin/env python3
# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The picture of python3 -m hvi view in Gallery.rst and Howto_report.rst: a scene at several times, beside each other, as Chromium draws it.

    python3 tests/verify/view_pictures.py runs/quick doc/src/img/view_scene.png --frames 3 9 30 --color velocity
"""

import argparse
import pathlib
import sys
import tempfile

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/lib"), str(ROOT / "python")]

import chromium  # noqa: E402
from hvi import cli  # noqa: E402

WIDTH, GAP = 620, 10  # pixels of a page; between pictures

SHOW = """(async () => {
  const time = document.querySelector('[data-is="time"]');
  time.value = %d;
  time.dispatchEvent(new Event("input"));
  for (let k = 0; k < 3; k++) await new Promise(requestAnimationFrame);
})()"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", metavar="DIR", help="as of hvi view")
    parser.add_argument("out", metavar="OUT.png")
    parser.add_argument("--frames", type=int, nargs="+", required=True, metavar="K", help="numbers from 0; the last of them gives the view its range")
    parser.add_argument("--color", default="type")
    args = parser.parse_args()
    if not chromium.found():
        sys.exit("view_pictures.py: chromium is not there (Debian: apt-get install chromium)")
    images = []
    with tempfile.TemporaryDirectory() as folder, chromium.Chromium() as browser:
        page, shot = pathlib.Path(folder, "page.html"), pathlib.Path(folder, "shot.png")
        if cli.main(["view", args.folder, f"--frame={args.frames[-1]}", "--color", args.color, "--output", str(page)]):
            sys.exit(1)
        browser.open(page, WIDTH)
        browser.wait_for_scene()
        for k in args.frames:
            browser.run(SHOW % k)
            browser.shot(shot, ".stage")
            images.append(Image.open(shot).convert("RGB"))
    joined = Image.new("RGB", (sum(image.width for image in images) + GAP * (len(images) - 1), images[0].height), "white")
    for k, image in enumerate(images):
        joined.paste(image, (k * (image.width + GAP), 0))
    joined.quantize(128).save(args.out, optimize=True)


if __name__ == "__main__":
    main()
