# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi view: particles in 3D, as a page to turn, or from the side, as a picture."""

import os
import pathlib
import sys
import webbrowser

import numpy as np

from .. import progress
from ..analysis import cloud, fragments
from ..errors import HVIError, writing
from ..io.frame import axis_number
from ..shield.run import runs_of
from . import dumps
from .shared import add_output, draw, positive

EXAMPLES = """  python3 -m hvi view runs/emi
  python3 -m hvi view debris.dump --data debris.data --color velocity --output debris.html
  python3 -m hvi view debris.dump --data debris.data --axis z --thickness 8e-3 --figure side
  python3 -m hvi view debris.dump --data debris.data --axis z --plane 4.05e-3 \\
      --color fragment --bonds bonds.dump --figure pieces"""

COLORS = {"type": "part", "velocity": "speed", "T": "temperature", "p": "pressure", "damage": "damage"}  # of the page: first words of its fields


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="DUMP|DIR", help="dump file, or several of one run (plain or .gz), or a folder as of hvi report")
    parser.add_argument("--output", "--out", metavar="FILE.html", help="only write the page, and do not open it (default: view.html in DIR, or beside the dump)")
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=False)
    parser.add_argument("--up", choices="xyz", help="direction that points up (default: the next after the axis)")
    parser.add_argument("--color", default="type", metavar="WHAT", help="type, velocity, axial, fragment (with --figure) or a column (default: type)")
    parser.add_argument("--thickness", type=positive, metavar="D", help="with --figure: only a slice through the center of mass (default: all)")
    parser.add_argument("--diameter", type=positive, metavar="D", help="of the particles (default: the spacing of the particles)")
    dumps.add_rules(parser)
    dumps.add_reading(parser)
    add_output(parser, "a picture from the side in place of the page", out=False)


def main(args):
    if args.figure:
        figure(args)
    else:
        page(args)


def figure(args):
    if args.output:
        raise HVIError("--output is for the page, --figure draws a picture in its place: give one of them")
    if pathlib.Path(args.files[0]).is_dir():
        raise HVIError(f"{args.files[0]} is a folder: --figure draws a frame of a dump; without --figure a folder becomes a page")
    frame = dumps.read(args)[args.frame]
    found = None
    if args.color == "fragment":
        found = fragments.find(frame, **dumps.rule(args))
    elif args.plane is not None:
        frame = frame.select(cloud.beyond(frame, args.axis, args.plane))
    draw(args.figure, "side", frame, args.axis, args.up, args.color, args.thickness, found, args.diameter)


# ---------------------------------------------------------------------- the page
def page(args):
    from ..report import view

    for option, given in (("--thickness", args.thickness), ("--plane", args.plane), ("--color fragment", args.color == "fragment" or None), ("--column, --bonds or --distance", dumps.has_rule(args) or None)):
        if given is not None:
            raise HVIError(f"{option} needs --figure NAME: the page has all particles, and a cut")
    first = pathlib.Path(args.files[0])
    if first.is_dir() and (len(args.files) > 1 or args.diameter):
        raise HVIError("give one folder, whose particles have their size, or the dumps of one run")
    run = runs_of(first)[1][0] if first.is_dir() else None
    dump = dumps.opened(args, run.frames().paths) if run else dumps.read(args)
    with progress.bar(len(dump), "frames") as bar:
        look = look_of(args, dump.number(args.frame), "y >" if run else "none")
        found = view.of_run(run, bar, look, dump, more_of(args)) if run else view.of_dump(dump, bar, look, args.diameter, more_of(args))
    out = pathlib.Path(args.output or (first / "view.html" if run else first.with_name(first.name.removesuffix(".gz").removesuffix(".dump") + ".html")))
    text = view.page(run.name if run else first.name, found)
    with writing(out):
        out.write_text(text, encoding="utf-8")
    print(f"view: {out} ({len(text) / 1e6:.1f} MB; {found.note})")
    if not args.output and not opened(out):
        print("there is no screen with a browser: open the file in one")


def look_of(args, frame, cut):
    """the axis to the right, the eye above and a little behind"""
    from ..report.view import Look

    right, up = (np.eye(3)[axis_number(letter)] for letter in (args.axis, args.up or "yzx"[axis_number(args.axis)]))
    if (right == up).all():
        raise HVIError("up must be another direction than the axis")
    return Look(eye=tuple(0.5 * right + 0.35 * up + 0.8 * np.cross(right, up)), up=tuple(up), frame=frame, cut=cut, color=COLORS.get(args.color, args.color))


def more_of(args):
    """the Field of a color that the page does not have by itself"""
    from ..report.view import Field

    if args.color in COLORS:
        return []
    if args.color == "axial":
        return [Field("axial", ("v" + args.axis,), lambda frame: frame.v[:, axis_number(args.axis)])]
    return [Field(args.color, (args.color,), lambda frame: frame.numbers(args.color))]


def opened(path):
    """whether a browser shows it; without a screen none is tried, for one of a terminal would take that over"""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return False
    return webbrowser.open(path.resolve().as_uri())
