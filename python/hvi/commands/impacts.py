# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi impacts: what a cloud would do to a wall."""

from ..analysis import maps
from ..analysis import debris as below
from ..analysis import fragments as pieces
from . import dumps
from .shared import add_output, draw, positive, real, show, whole

EXAMPLES = """  python3 -m hvi impacts cloud1.dump --axis z --plane 60.8e-3 --figure witness
  python3 -m hvi impacts old.dump --axis z --plane 60.8e-3 --quarter --after 0 --bins 60 --figure witness.png
  python3 -m hvi impacts cloud1.dump --axis z --plane 60.8e-3 --after 0.8e-3 --distance 0.6e-3 --sound \\
      --density 1=2785 --density 2=2785"""


def add_arguments(parser):
    dumps.add_files(parser)
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=True)
    parser.add_argument("--after", type=real, metavar="X", help="only particles beyond this coordinate (default: all before the wall)")
    parser.add_argument("--bins", type=whole, default=80, metavar="N", help="bins across the map (default: 80)")
    parser.add_argument("--reach", type=positive, metavar="R", help="half width of the map (default: where 99 %% of the energy is)")
    dumps.add_rules(parser)
    dumps.add_debris(parser)
    dumps.add_reading(parser)
    add_output(parser, "both maps", out=False)


def main(args):
    frame = dumps.read(args)[args.frame]
    found = maps.impacts(frame, args.axis, args.plane, args.bins, args.after, args.reach)
    debris, missing = dumps.debris(args, found.frame)
    print(dumps.moment(frame))
    show(found.summary)
    if dumps.has_rule(args):
        rule = {**dumps.rule(args), "axis": None, "plane": None, "of_whole": found.coming}  # the plane is that of the wall
        show({name: value for name, value in pieces.both(frame, **rule)[1].items() if name not in ("mass", "particles")})
    if debris:
        show({**debris.summary, **{f"{kind}_kinetic_energy": share for kind, share in zip(below.KINDS, debris.shares(found.kinetic))}})
    dumps.show_debris({}, missing)
    draw(args.figure, "impacts", frame, found, args.axis)
