# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi plate: a round plate of particles, in layers or like glass."""

import numpy as np

from .. import tables
from ..errors import HVIError
from ..model import bodies, plates
from . import filling
from .shared import positive, real, whole

EXAMPLES = """  python3 -m hvi plate wall.data --radius 20e-3 --thickness 0.8e-3 --spacing 0.2e-3 --layers 8 --angles 0 45 \\
      --material potentials/Al2024-T3.hvi
  python3 -m hvi plate far.data --radius 140e-3 --thickness 0.8e-3 --spacing 0.2e-3 --zones 20e-3 40e-3 80e-3 \\
      --density 2785 --quarter
  python3 -m hvi plate thin.data --radius 20e-3 --thickness 0.8e-3 --spacing 0.2e-3 --fill glass --density 2785"""


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE add append)")
    for name, text in (("radius", "of the plate"), ("thickness", "of the plate"), ("spacing", "of particles in the plane")):
        parser.add_argument("--" + name, type=positive, required=True, metavar=name[0].upper(), help=text)
    parser.add_argument("--layers", type=whole, metavar="N", help="particles through the thickness (default: as wide as in the plane)")
    parser.add_argument("--angles", type=real, nargs="+", action="extend", metavar="DEG",
                        help="one for all layers, one per layer, or a set that is stacked symmetric and balanced (default: 0)")
    parser.add_argument("--zones", type=positive, nargs="+", action="extend", default=[], metavar="R", help="beyond each of these radii the spacing doubles and the type is the next")
    parser.add_argument("--quarter", action="store_true", help="only x > 0, y > 0, for mirrors")
    filling.add_filling(parser, "lattice", "lattice in layers, or glass: without layers, angles and zones")


def main(args):
    if args.fill == "glass":
        if args.layers is not None or args.angles or args.zones:
            raise HVIError("a plate of glass has no --layers, --angles and --zones: those are of lattices")
        return filling.fill(args, bodies.cylinder(args.radius, args.thickness, quarter=args.quarter, middle=0.5 * args.thickness), "plate")
    made = plates.make(args.radius, args.thickness, args.spacing, args.layers, args.angles or [0.0], args.zones, args.quarter)
    density, said = filling.density(args)
    plates.write(args.file, made, density, filling.title(args))
    count = np.bincount(made.type, minlength=len(made.volume) + 1)[1:]
    print(f"particles: {len(made.x)}")
    print(f"angles: {' '.join(f'{a:g}' for a in made.angles)}")
    print(said)
    print(f"mass: {density * (count @ made.volume):.6g}")
    rows = [(k + 1, count[k], made.spacing[k], made.step, density * made.volume[k]) for k in range(len(count))]
    print(tables.text(("type", "particles", "spacing", "step", "mass"), rows))
