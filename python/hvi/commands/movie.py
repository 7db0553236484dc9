# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi movie: all frames of a run of hvi shield from the side, as an animated GIF."""

import io
import pathlib

from .. import progress
from ..errors import HVIError, needed, writing
from ..shield.run import Scene, runs_of
from .shared import positive

EXAMPLES = "  python3 -m hvi movie runs/emi --color speed"

DPI = 110
STAY = 6  # as many times as the others the last frame stays


def add_arguments(parser):
    parser.add_argument("folder", metavar="DIR", help="as of hvi report: of several runs the finest")
    parser.add_argument("--out", metavar="FILE.gif", help="default: movie.gif in DIR")
    parser.add_argument("--color", choices=("body", "speed"), default="body", help="of the particles (default: body)")
    parser.add_argument("--rate", type=positive, default=5.0, metavar="N", help="frames per second (default: 5)")


def frames(run, color="body", progress=progress.silent):
    """Pillow images of all frames: one frame and scale, the time of each above."""
    from ..report import pictures

    image = needed("PIL.Image", "a movie needs")
    dump = run.frames()
    if len(dump) < 3:
        raise HVIError(f"{run.folder} has {len(dump)} frame{'s' * (len(dump) > 1)}, too few for a movie: give the case settings: {{film: 1}}, us between frames")
    window, found = pictures.side_window(run), []
    with progress(len(dump), "frames") as bar:
        for frame in dump:
            scene = Scene(frame, run)
            figure = pictures.velocities(run, scene, window) if color == "speed" else pictures.side(run, scene, window)
            figure.axes[0].text(0.02, 0.98, f"{scene.time:.1f} us", transform=figure.axes[0].transAxes, va="top", fontsize=11, zorder=5)
            stream = io.BytesIO()
            figure.savefig(stream, format="png", dpi=DPI)
            found.append(image.open(stream).convert("RGB"))
            bar.update()
    return found


def main(args):
    run = runs_of(args.folder)[1][0]
    images = frames(run, args.color, progress.bar)
    colors = images[len(images) // 2].quantize(256)  # the same of all frames: else they flicker
    images = [image.quantize(palette=colors) for image in images]
    out = pathlib.Path(args.out or pathlib.Path(args.folder) / "movie.gif")
    pause = int(1000.0 / args.rate)
    with writing(out):
        images[0].save(out, format="GIF", save_all=True, append_images=images[1:], duration=[pause] * (len(images) - 1) + [STAY * pause], loop=0, optimize=False)
    print(f"movie: {out} ({len(images)} frames, {run.name}; the half behind y = 0, spacing {run.dx:g} mm)")
    return 0
