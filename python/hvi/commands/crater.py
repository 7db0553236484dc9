# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi crater: the crater in a thick target."""

from .. import tables
from ..errors import HVIError
from . import dumps
from .shared import add_output, draw, positive, real, show

EXAMPLES = """  python3 -m hvi crater crater.dump --spacing 0.6e-3 --type 2
  python3 -m hvi crater frame.*.dump --spacing 0.6e-3 --type 2 --all --out growth.csv"""


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="FILE", help="dump file, or several of one run (plain or .gz)")
    parser.add_argument("--spacing", type=positive, required=True, metavar="A", help="of the lattice that the target was made of")
    parser.add_argument("--axis", choices="xyz", default="z", help="direction of the impact (default: z)")
    parser.add_argument("--center", type=real, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"), help="where the axis of the crater is, across it (default: 0 0)")
    parser.add_argument("--from-above", action="store_true", help="the projectile came from the upper side of the axis")
    dumps.add_types(parser, ": the target")
    parser.add_argument("--all", action="store_true", help="a row for every frame instead of the values of one")
    dumps.add_frame(parser)
    dumps.add_reading(parser)
    add_output(parser, "the profile")


def main(args):
    from ..analysis import crater

    def look(frame):
        types = args.type or sorted(set(frame["type"].tolist()))
        return crater.measure(frame, args.spacing, types, args.axis, args.center, 1 if args.from_above else -1)

    def values(found):
        return {"depth": found.depth, "diameter": found.diameter, "volume": found.volume, "face": found.face}

    frames = dumps.read(args)
    if args.all:
        if args.figure:
            raise HVIError("--all makes a table; for a figure choose one frame with --frame")
        return dumps.all_frames(args, frames, "crater", lambda frame: values(look(frame)), {"depth": "distance", "diameter": "distance", "face": "distance"})
    frame = frames[args.frame]
    found = look(frame)
    print(dumps.moment(frame))
    show(values(found))
    if args.out:
        tables.write_csv(args.out, ("r", "surface"), list(zip(found.r, found.floor)))
    draw(args.figure, "crater", frame, found)
    return 0
