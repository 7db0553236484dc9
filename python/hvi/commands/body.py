# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi body: spheres, cylinders and boxes of particles."""

from ..errors import HVIError
from ..model import bodies
from . import filling
from .shared import positive

EXAMPLES = """  python3 -m hvi body ball.data --shape sphere --radius 5e-3 --spacing 0.5e-3 --material potentials/Al6061-T6.hvi
  python3 -m hvi body shell.data --shape sphere --radius 5e-3 --inner 3e-3 --spacing 0.5e-3 --density 2785 --quarter
  python3 -m hvi body rod.data --shape cylinder --radius 2e-3 --length 10e-3 --spacing 0.4e-3 --density 2785 --seed 7
  python3 -m hvi body block.data --shape box --size 4e-3 4e-3 8e-3 --spacing 0.4e-3 --fill lattice --density 2785"""
NEEDED = {"sphere": {"radius"}, "cylinder": {"radius", "length"}, "box": {"size"}}


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE add append); the center is at 0 0 0")
    parser.add_argument("--shape", choices=tuple(NEEDED), required=True, help="a cylinder is along z")
    parser.add_argument("--radius", type=positive, metavar="R", help="of a sphere or cylinder")
    parser.add_argument("--inner", type=positive, metavar="R", help="radius inside, of a hollow one")
    parser.add_argument("--length", type=positive, metavar="L", help="of a cylinder")
    parser.add_argument("--size", type=positive, nargs=3, metavar=("X", "Y", "Z"), help="of a box")
    parser.add_argument("--periodic", nargs="+", action="extend", choices="xyz", default=[], metavar="D", help="directions of a box in which it goes on periodically")
    parser.add_argument("--spacing", type=positive, required=True, metavar="S", help="of particles: as many as cubes of it have the volume of the body")
    parser.add_argument("--quarter", action="store_true", help="only x > 0, y > 0, for mirrors")
    filling.add_filling(parser, "glass", "even, without rows, or a cubic lattice about the center")


def main(args):
    needed = NEEDED[args.shape]
    given = {name for name in ("radius", "inner", "length", "size") if getattr(args, name) is not None}
    allowed = needed | ({"inner"} if "radius" in needed else set())
    if not needed <= given <= allowed:
        words = " and ".join("--" + name for name in sorted(needed, reverse=True))
        raise HVIError(f"a {args.shape} has {words}{' and may have --inner' if 'inner' in allowed else ''}, nothing else, not "
                       f"{' '.join('--' + name for name in sorted(given)) or 'none of these'}")
    if args.periodic and args.shape != "box":
        raise HVIError(f"--periodic is for boxes, not for a {args.shape}")
    sizes = {name: getattr(args, name) for name in given}
    if args.periodic:
        sizes["periodic"] = ["xyz".index(c) for c in args.periodic]
    filling.fill(args, getattr(bodies, args.shape)(**sizes, quarter=args.quarter), "body")
