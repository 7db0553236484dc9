# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What commands that read dumps share: which frame of which file, which part of it, and what a fragment is."""

import argparse
import functools
import os

import numpy as np

from .. import progress, tables
from ..analysis import debris as below
from ..analysis import fragments as pieces
from ..errors import HVIError
from ..io import mirror
from ..io import bonds as bond_sources
from ..io.dump import Dump
from ..io.scan import open_binary
from ..units import MVV2E
from .shared import LARGEST, MANY, positive, real, show, whole


# ---------------------------------------------------------------------- options
def by_type(text, what="MASS", like="1=2.5e-7"):
    """(type, value) of TYPE=VALUE"""
    kind, _, value = text.partition("=")
    try:
        kind, value = int(kind), float(value)
    except ValueError:
        value = 0.0
    if not (0.0 < value < LARGEST and 0 < kind <= MANY):
        raise argparse.ArgumentTypeError(f"{text} is not TYPE={what}, like {like}")
    return kind, value


def kind(text):
    """number or label of a type"""
    return int(text) if text.lstrip("-").isdigit() else text


class Quarter(argparse.Action):
    """two planes more, if they are not there yet"""

    def __call__(self, parser, namespace, values, option_string=None):
        setattr(namespace, self.dest, list(dict.fromkeys([*(getattr(namespace, self.dest) or ()), "x=0", "y=0"])))


def add_files(parser):
    parser.add_argument("files", nargs="+", metavar="FILE", help="dump file, or several of one run (plain or .gz)")


def add_frame(parser):
    parser.add_argument("--frame", type=whole, default=-1, metavar="K", help="which frame, from 0; negative from the end (default: -1)")


def add_types(parser, text):
    parser.add_argument("--type", type=kind, nargs="+", action="extend", metavar="TYPE", help=f"only particles of these types{text} (default: all)")


def add_reading(parser, several=False):
    group = parser.add_argument_group("what the dump does not say")
    group.add_argument("--data", metavar="FILE", nargs=2 if several else None, help="data file (write_data): masses, bonds")
    group.add_argument("--mass", action="append", type=by_type, metavar="TYPE=MASS", help="mass of the particles of a type; repeat")
    group.add_argument("--units", choices=sorted(MVV2E), help="LAMMPS units (default: the dump's or the data file's, else si)")
    group.add_argument("--mirror", action="append", metavar="D=C[,SIDE]",
                       help="mirror plane of a half or quarter model, like x=0 or y=1e-3,hi (all is above it: lo, default; below "
                       "it: hi); repeat; or none (default: what the dump or the data file says)")
    group.add_argument("--quarter", action=Quarter, nargs=0, dest="mirror", help="--mirror x=0 --mirror y=0")
    group.add_argument("--dt", type=positive, metavar="T", help="time per step, for dumps without time")
    group.add_argument("--interval", type=positive, metavar="T", help="time between frames (dump_modify every/time)")


def add_cloud(parser, needed):
    group = parser.add_argument_group("the cloud: all particles beyond a plane")
    group.add_argument("--axis", choices="xyz", required=needed, default=None if needed else "z", help="direction of the impact" + ("" if needed else " (default: z)"))
    group.add_argument("--plane", type=real, metavar="X", required=needed, help="coordinate of the plane" + ("" if needed else " (default: all particles)"))


def add_quantile(parser):
    parser.add_argument("--quantile", type=real, default=0.99, metavar="Q", help="share of the mass inside an edge (default: 0.99)")


def add_rules(parser, several=False):
    group = parser.add_argument_group("what is a fragment (one of; at mirror planes --distance, too)")
    group.add_argument("--column", metavar="NAME", help="column with fragment IDs (compute hvi/fragment/atom)")
    group.add_argument("--bonds", metavar="FILE", nargs=2 if several else None, help="dump local with batom1 batom2 of every frame, or a data file")
    group.add_argument("--distance", type=positive, metavar="R", help="particles closer than R hang together")
    group.add_argument("--bond-columns", nargs=2, metavar="NAME", help="columns with the two atom IDs (default: the last two)")
    group.add_argument("--sound", action="store_true", help="with --distance: failed particles stay alone (damage yes); without, what has come apart")
    group.add_argument("--failed-columns", nargs="+", action="extend", metavar="NAME", help="a particle with 1 or more in one of these has failed (default: damage spalled)")


def add_debris(parser):
    group = parser.add_argument_group("debris below the spacing, with --sound")
    group.add_argument("--density", action="append", type=functools.partial(by_type, what="RHO", like="1=2785"), metavar="TYPE=RHO",
                       help="of the solid matter of a type; repeat. Failed particles count as pieces of the size in the column fragsize")
    group.add_argument("--size-column", metavar="NAME", default=below.COLUMN, help="that column, if it has another name")


# ---------------------------------------------------------------------- what they say
def opened(args, paths, data=None):
    """The Dump of these files, as the options say"""
    return Dump(paths, data=data or args.data, masses=dict(args.mass or ()), units=args.units, mirror=args.mirror, dt=args.dt, interval=args.interval, progress=progress.bar)


def read(args, paths=None, data=None):
    """The Dump of the options; says of which model"""
    dump = opened(args, paths or args.files, data)
    say_model(dump.mirror(-1))
    return dump


def say_model(planes):
    if planes:
        print(f"model: {mirror.text(planes)}; what follows is of the whole")


def is_dump(path):
    if os.path.isdir(path):
        return False
    with open_binary(path) as stream:
        return stream.read(5) == b"ITEM:"


def moment(frame):
    return f"frame {frame.number}, step {frame.step}" + ("" if frame.time is None else f", time {frame.time:.6g}")


def has_rule(args):
    return any(rule is not None for rule in (args.column, args.bonds, args.distance))


def rule(args, bonds=None):
    """What is a fragment, as the options say: keywords of fragments.find()"""
    if not has_rule(args):
        raise HVIError("what is a fragment? give --column, --bonds or --distance")
    bonds = bond_sources.source(bonds or args.bonds, args.bond_columns, progress.bar)
    where = {} if args.plane is None else {"axis": args.axis, "plane": args.plane}
    failed = list(args.failed_columns or pieces.FAILED) if args.sound else None
    return {"column": args.column, "bonds": bonds, "distance": args.distance, "failed": failed, **where}


def debris(args, frame):
    """(Debris of the particles of a frame or None, why there is none)"""
    if args.density and not args.sound:
        raise HVIError("what is below the spacing are pieces of failed particles: --density needs --sound")
    if not args.sound:
        return None, None
    if args.size_column not in frame:
        return None, f"not known: the dump has no column {args.size_column} (compute hvi/atom fragsize)"
    if not args.density:
        return None, "not counted: give --density TYPE=RHO"
    return below.estimate(frame, pieces.has_failed(frame, args.failed_columns or pieces.FAILED), dict(args.density), args.size_column), None


def show_debris(summary, missing):
    show(summary)
    if missing:
        print(f"debris below the spacing: {missing}")


def all_frames(args, frames, what, row_of, quantities):
    """A row for every frame: when, and what row_of(frame) says; quantities: of columns, {name: quantity}"""
    rows = []
    with progress.bar(len(frames), what) as bar:
        for frame in frames:
            rows.append({"frame": frame.number, "step": frame.step, "time": np.nan if frame.time is None else frame.time, **row_of(frame)})
            bar.update()
    names = list(dict.fromkeys(name for row in rows for name in row))
    rows = [tuple(row.get(name, np.nan) for name in names) for row in rows]
    print(tables.text(names, rows, {"time": "time", **quantities}, frame.units))
    if args.out:
        tables.write_csv(args.out, names, rows)
