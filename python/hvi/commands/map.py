# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi map: velocities over positions."""

from . import dumps
from .shared import add_output, draw, whole

EXAMPLES = """  python3 -m hvi map debris.dump --data debris.data --axis z --figure phase
  python3 -m hvi map debris.dump --data debris.data --axis z --kind field --figure field.png"""


def add_arguments(parser):
    dumps.add_files(parser)
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=False)
    parser.add_argument("--kind", choices=("phase", "field"), default="phase",
                        help="phase: mass over position and velocity; field: mean velocity over position and radius (default: phase)")
    parser.add_argument("--bins", type=whole, nargs=2, metavar="N", help="bins to the right and upwards")
    dumps.add_reading(parser)
    add_output(parser, "the map", required=True, out=False)


def main(args):
    bins = {"bins": tuple(args.bins)} if args.bins else {}
    draw(args.figure, args.kind, dumps.read(args)[args.frame], args.axis, args.plane, **bins)
