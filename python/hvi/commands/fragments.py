# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi fragments: the pieces of a frame, how many are above a mass, and laws fitted to that."""

import numpy as np

from .. import tables
from ..analysis import distribution
from ..analysis import debris as below
from ..analysis import fragments as pieces
from ..errors import HVIError
from . import dumps
from .shared import add_output, draw, positive, whole

EXAMPLES = """  python3 -m hvi fragments debris.dump --data debris.data --bonds bonds.dump --axis z --plane 4.05e-3 \\
      --fit both --figure masses --out fragments.csv
  python3 -m hvi fragments debris.dump --data debris.data --bonds bonds.dump --axis z --plane 4.05e-3 --all --out f.csv
  python3 -m hvi fragments sph.dump --column c_frag --frame 3
  python3 -m hvi fragments quarter.dump --column c_frag --distance 6e-4 --mirror x=0 --mirror y=0
  python3 -m hvi fragments sph.dump --distance 0.45 --units lj --mass 1=1
  python3 -m hvi fragments frame.40.dump --distance 7.15e-4 --sound --density 1=2790 --density 2=2703 --plane 0.953e-3"""


def add_arguments(parser):
    dumps.add_files(parser)
    dumps.add_rules(parser)
    dumps.add_debris(parser)
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=False)
    dumps.add_types(parser, " count and connect")
    parser.add_argument("--all", action="store_true", help="the summary of every frame instead of the table of one")
    parser.add_argument("--top", type=whole, default=10, metavar="N", help="rows to print (default: 10)")
    parser.add_argument("--fit", choices=("power", "exponential", "both"), help="fit N(>m): A m^-b, N0 exp(-m/mu)")
    parser.add_argument("--mmin", type=positive, metavar="M", help="fit from this mass on (default: where the law fits best)")
    parser.add_argument("--mmax", type=positive, default=float("inf"), metavar="M", help="and up to this one")
    dumps.add_reading(parser)
    add_output(parser, "N(>m)")


def found_in(args, frame, rule):
    """(Fragments, summary with that of the debris below the spacing, that Debris or None, why there is none)"""
    if args.type is not None:
        mine = frame.of_types(args.type)
        if not mine.any() and not args.all:
            raise HVIError(f"{frame.where}: no particle has the type {', '.join(map(str, args.type))}; there are: {', '.join(map(str, np.unique(frame['type'])))}")
        frame = frame.select(mine)
    found, summary = pieces.both(frame, **rule)
    debris, missing = dumps.debris(args, found.frame)
    return found, {**summary, **(debris.summary if debris else {})}, debris, missing


def main(args):
    dump = dumps.read(args)
    rule = dumps.rule(args)
    if args.all:
        return every(args, dump, rule)
    found, summary, debris, missing = found_in(args, dump[args.frame], rule)
    print(dumps.moment(found.frame))
    dumps.show_debris(summary, missing)
    names, rows = found.table.dtype.names, found.table.tolist()
    number, kind = np.ones(len(rows)), np.zeros(len(rows), dtype=int)
    if debris:  # a failed particle is a row of its own, under its own ID
        alone = np.searchsorted(found.frame.ids, found.table["id"])
        number, kind = debris.pieces[alone], debris.kind[alone]
        names, rows = (*names, "kind", "pieces", "piece_size"), [
            (*row, below.KINDS[k], n, size) for row, k, n, size in zip(
                rows, kind, number, np.where(found.table["count"] > 1, found.table["size"], debris.size[alone]))]
    if args.top > 0 and len(rows):
        print()
        print(tables.text(names, rows[:args.top], pieces.COLUMN_QUANTITIES, dump.units))
    resolved = found.table["mass"][kind == 0]
    fits = fitted(args, resolved, found.unit, found.images(kind == 0))
    if fits:
        print()
    for fit in fits:
        print(fit)
    if args.out:
        tables.write_csv(args.out, names, rows)
    known = kind < 2
    small = (found.table["mass"][known] / number[known], number[known]) if debris else None
    draw(args.figure, "distribution", resolved, fits, dump.units, small)


def every(args, dump, rule):
    """One row per frame: when, and the summary"""
    if args.fit or args.figure:
        raise HVIError("--all makes a table; for a fit or a figure choose one frame with --frame")
    reasons = {}  # why there is no debris below the spacing: frames

    def row(frame):
        _, summary, _, missing = found_in(args, frame, rule)
        if missing:
            reasons.setdefault(missing, []).append(frame.number)
        return summary

    masses = ("mass", "single_particles_mass", *(f"{kind}_mass" for kind in below.KINDS))
    dumps.all_frames(args, dump, "fragments", row, {"subparticle_size": "distance", **dict.fromkeys(masses, "mass")})
    dumps.show_debris({}, "; ".join(reason if len(of) == len(dump) else f"{reason}, in frames {', '.join(map(str, of))}" for reason, of in reasons.items()))


def fitted(args, masses, unit, images):
    """Both laws on the same range, so that their likelihoods can be compared"""
    fits, start = [], args.mmin
    for law in {None: (), "both": distribution.LAWS}.get(args.fit, (args.fit,)):
        fits.append(distribution.fit(masses, law, start, args.mmax, unit, images))
        start = fits[0].m_min
    return fits
