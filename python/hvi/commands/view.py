# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi view: particles from the side."""

from ..analysis import cloud, fragments
from . import dumps
from .shared import add_output, draw, positive

EXAMPLES = """  python3 -m hvi view debris.dump --data debris.data --axis z --thickness 8e-3 --figure side
  python3 -m hvi view debris.dump --data debris.data --axis z --plane 4.05e-3 \\
      --color fragment --bonds bonds.dump --figure pieces"""


def add_arguments(parser):
    dumps.add_files(parser)
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=False)
    parser.add_argument("--up", choices="xyz", help="direction that points up (default: the next after the axis)")
    parser.add_argument("--color", default="type", metavar="WHAT", help="type, velocity, axial, fragment or a column (default: type)")
    parser.add_argument("--thickness", type=positive, metavar="D", help="only a slice through the center of mass (default: all)")
    parser.add_argument("--diameter", type=positive, metavar="D", help="of the dots (default: the spacing of the particles)")
    dumps.add_rules(parser)
    dumps.add_reading(parser)
    add_output(parser, "the view", required=True, out=False)


def main(args):
    frame = dumps.read(args)[args.frame]
    found = None
    if args.color == "fragment":
        found = fragments.find(frame, **dumps.rule(args))
    elif args.plane is not None:
        frame = frame.select(cloud.beyond(frame, args.axis, args.plane))
    draw(args.figure, "side", frame, args.axis, args.up, args.color, args.thickness, found, args.diameter)
