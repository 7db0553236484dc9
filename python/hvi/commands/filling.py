# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What commands that write particles share: their density, and how a body is filled."""

import os

from ..material import library
from ..model import bodies
from .shared import natural, positive, show


def add_density(parser):
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--density", type=positive, metavar="RHO", help="of the material, in units of the run")
    group.add_argument("--material", metavar="FILE.hvi", help="material file; the run must have its units")


def add_filling(parser, default, text):
    parser.add_argument("--fill", choices=("glass", "lattice"), default=default, help=f"{text} (default: {default})")
    parser.add_argument("--seed", type=natural, default=1, metavar="N", help="of glass: another one, another glass (default: 1)")
    add_density(parser)


def density(args):
    """(density, as it is said)"""
    value, units = (args.density, None) if args.material is None else library.density_of(args.material)
    return value, f"density: {value:.10g}" + (f" (units {units})" if units else "")


def title(args):
    return " ".join(os.path.basename(args.file).split())


def fill(args, shape, what):
    """fills a shape, writes it, and says how even it is"""
    rho, said = density(args)
    made = bodies.make(shape, args.spacing, args.fill, args.seed)
    bodies.write(args.file, made, rho, f"{what} {title(args)}, {args.fill}")
    print(f"particles: {len(made.x)}")
    print(f"spacing: {made.spacing:.10g}")
    if made.step is not None:
        print("step: " + " ".join(f"{s:.10g}" for s in made.step))
    print(said)
    print(f"mass: {rho * shape.volume:.10g}")
    print("center: " + " ".join(f"{c:.6g}" for c in shape.center))
    show(bodies.measure(made))
