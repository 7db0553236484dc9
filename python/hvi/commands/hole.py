# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi hole: the hole in a plate."""

from .. import tables
from ..errors import HVIError
from ..io import mirror
from ..io.data import DataFile
from . import dumps
from .shared import add_output, draw, positive, real, show, whole

EXAMPLES = """  python3 -m hvi hole frame.10.dump --plane 0.5e-3 --type 2 --figure hole
  python3 -m hvi hole shield.dump --center 2.5e-3 0 --plane 31.4e-3 --type 3 --distance 0.4e-3 --thickness 1
  python3 -m hvi hole frame.*.dump --plane 0.5e-3 --type 2 --all --out holes.csv
  python3 -m hvi hole wall.data --quarter --plane 0.5e-3"""


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="FILE", help="dump file, or several of one run (plain or .gz); or one data file (write_data)")
    parser.add_argument("--axis", choices="xyz", default="z", help="direction in which the plate is looked at (default: z)")
    parser.add_argument("--center", type=real, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"),
                        help="a point in the plate across the axis, at best in the middle of the hole (default: 0 0)")
    parser.add_argument("--plane", type=real, required=True, metavar="Z", help="coordinate of the plate's middle plane along the axis")
    dumps.add_types(parser, ": the plate")
    parser.add_argument("--distance", type=positive, metavar="R", help="only the largest piece of these, of particles closer than R: what drifts in the hole is "
                        "no plate (default: all)")
    parser.add_argument("--thickness", type=positive, metavar="H", help="of the layer around the plane that is looked at (default: it is measured)")
    parser.add_argument("--dr", type=positive, metavar="D", help="spacing of the map (default: it is measured)")
    parser.add_argument("--fill", type=real, default=0.5, metavar="F", help="share of the intact plate's mass per area that makes plate (default: 0.5)")
    parser.add_argument("--reference", type=positive, metavar="M", help="mass per area of the intact plate (default: it is measured)")
    parser.add_argument("--sectors", type=whole, default=36, metavar="N", help="for the smallest and largest diameter (default: 36)")
    parser.add_argument("--all", action="store_true", help="a row for every frame instead of the values of one")
    dumps.add_frame(parser)
    dumps.add_reading(parser)
    add_output(parser, "the map of mass per area with the edge of the hole")


def main(args):
    from ..analysis import hole as holes

    def look(frame):
        return holes.measure(frame, args.axis, args.center, args.plane, thickness=args.thickness, dr=args.dr, fill=args.fill,
                             reference=args.reference, sectors=args.sectors, types=args.type, distance=args.distance)

    frames = dumps.read(args) if dumps.is_dump(args.files[0]) else of_data(args)
    if args.all:
        if args.figure:
            raise HVIError("--all makes a table; for a figure choose one frame with --frame")
        lengths = ("diameter", "smallest", "largest", "layer", "spacing", *(f"center_{c}" for c in "xyz"))
        return dumps.all_frames(args, frames, "hole", lambda frame: look(frame).values, dict.fromkeys(lengths, "distance"))
    frame = frames[args.frame]
    found = look(frame)
    print(dumps.moment(frame))
    print(f"hole: {holes.SAID[found.values['found']]}")
    show({name: value for name, value in found.values.items() if found.values["found"] >= 0 or name in ("share", "layer", "reference", "spacing", "found")})
    if args.out:
        tables.write_csv(args.out, list(found.values), [list(found.values.values())])
    draw(args.figure, "hole", frame, found, args.axis)
    return 0 if found.values["found"] >= 0 else 1


def of_data(args):
    """The one Frame of a data file, in a list"""
    if len(args.files) > 1 or args.data or args.dt or args.interval:
        raise HVIError(f"{args.files[0]} is no dump: one data file, without --data, --dt and --interval, or dumps")
    frame = DataFile(args.files[0]).frame(dict(args.mass or ()), args.units, mirror.of_words(args.mirror))
    dumps.say_model(frame.planes)
    if args.frame not in (0, -1):
        raise HVIError(f"{args.files[0]} is a data file, which has one frame, 0: there is no frame {args.frame}")
    return [frame]
