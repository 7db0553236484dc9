# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi mesh: hexahedra, of a plate or of another program."""

import argparse

from .. import tables
from ..errors import HVIError
from ..model import mesh_import, mesh_plate
from . import filling
from .shared import positive, real, show, whole

EXAMPLES = """  python3 -m hvi mesh wall.data --side 300e-3 --thickness 1e-3 --element 0.5e-3 --core 8e-3 --hold 12e-3 --circle \\
      --growth 1.2 --largest 5e-3 --quarter --material potentials/Al2024-T3.hvi
  python3 -m hvi mesh plate.data --radius 20e-3 --thickness 1e-3 --element 0.5e-3 --particles 2 --density 2785
  python3 -m hvi mesh part.data --import part.inp --scale 1e-3 --particles 2 --set STRUCK --density 2785"""
PLATE = ("thickness", "element", "layers", "core", "hold", "circle", "growth", "largest", "quarter", "center", "bottom")
IMPORTED = ("set", "scale", "move")


class OneOrTwo(argparse.Action):
    def __call__(self, parser, namespace, values, option_string=None):
        values = [*(getattr(namespace, self.dest) or ()), *values]
        if len(values) > 2:
            parser.error(f"{option_string} takes one or two numbers, not {len(values)}")
        setattr(namespace, self.dest, values)


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE fix ID elements Elements)")
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--side", type=positive, nargs="+", action=OneOrTwo, metavar="L", help="of a square plate, or both of a rectangle")
    group.add_argument("--radius", type=positive, metavar="R", help="of a round plate")
    group.add_argument("--import", dest="import_", metavar="MESH", help="hexahedra of a file that meshio reads (Abaqus, Gmsh, VTK, ...)")
    parser.add_argument("--particles", type=whole, default=2, metavar="N", help="per edge of an element that holds some; 0: none does (default: 2)")
    parser.add_argument("--type", type=whole, default=1, metavar="TYPE", help="of the material (default: 1)")
    parser.add_argument("--node-type", type=whole, metavar="TYPE", help="of the nodes (default: the next)")
    filling.add_density(parser)
    group = parser.add_argument_group("plates, across z")
    group.add_argument("--thickness", type=positive, metavar="T", help="of the plate")
    group.add_argument("--element", type=positive, metavar="E", help="edge of elements in the plane")
    group.add_argument("--layers", type=whole, metavar="N", help="elements through the thickness (default: as thick as wide)")
    group.add_argument("--core", type=positive, metavar="R", help="free particles, E/N apart, instead of elements up to this radius")
    group.add_argument("--circle", action="store_true", default=None, help="the core is a circle with rings of elements around it, not cells of a lattice")
    group.add_argument("--hold", type=positive, metavar="R", help="elements hold particles up to this radius (default: all)")
    group.add_argument("--growth", type=positive, metavar="G", help="beyond, elements grow by this ratio from one to the next (default: 1)")
    group.add_argument("--largest", type=positive, metavar="E", help="up to this size")
    group.add_argument("--quarter", action="store_true", default=None, help="only x > 0, y > 0, for mirrors")
    group.add_argument("--center", type=real, nargs=2, metavar=("X", "Y"), help="of the plate (default: 0 0)")
    group.add_argument("--bottom", type=real, metavar="Z", help="the plate is from Z to Z + T (default: 0)")
    group = parser.add_argument_group("imported meshes")
    group.add_argument("--scale", type=positive, metavar="S", help="units of the run per unit of the file (default: 1)")
    group.add_argument("--move", type=real, nargs=3, metavar=("X", "Y", "Z"), help="after that (default: 0 0 0)")
    group.add_argument("--set", metavar="NAME", help="only elements of this set of cells hold particles (default: all)")


def main(args):
    given, imported = ({name: getattr(args, name) for name in names if getattr(args, name) is not None} for names in (PLATE, IMPORTED))
    common = {"n": args.particles, "type": args.type, "node_type": args.node_type}
    inverted = 0
    if args.import_:
        if given:
            raise HVIError(f"--{next(iter(given))} is of plates, not of imported meshes")
        made, inverted = mesh_import.load(args.import_, cells=args.set, scale=args.scale or 1.0, move=args.move or (0.0, 0.0, 0.0), **common)
    else:
        for name in ("thickness", "element"):
            if name not in given:
                raise HVIError(f"a plate needs --{name}")
        if imported:
            raise HVIError(f"--{next(iter(imported))} is of imported meshes, not of plates")
        side = None if args.side is None else args.side if len(args.side) > 1 else args.side[0]
        made = mesh_plate.plate(side=side, radius=args.radius, **given, **common)
    density, said = filling.density(args)
    made.write(args.file, density, filling.title(args))
    found = made.quality()
    show({**found, "mass": density * found["volume"]})
    if inverted:
        print(f"elements that were inside out: {inverted}")
    print(said)
    print(tables.text(("type", "mass", "of"), [(k, m, "nodes" if k == made.node_type else "material") for k, m in made.masses(density).items()]))
