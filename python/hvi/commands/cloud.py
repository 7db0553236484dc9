# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi cloud: the measures of the debris cloud over time."""

import numpy as np

from .. import progress, tables
from ..analysis import cloud
from . import dumps
from .shared import add_output, draw, whole

EXAMPLES = """  python3 -m hvi cloud debris.dump --data debris.data --axis z --plane 4.05e-3
  python3 -m hvi cloud debris.dump --mass 1=5e-7 --mass 2=5e-7 --axis z --plane 4.05e-3 --interval 3e-6 \\
      --out cloud.csv --figure cloud"""


def add_arguments(parser):
    dumps.add_files(parser)
    dumps.add_cloud(parser, needed=True)
    dumps.add_quantile(parser)
    parser.add_argument("--frame", type=whole, action="append", metavar="K", help="only this frame; repeat (default: all)")
    dumps.add_reading(parser)
    add_output(parser, "the measures over time")


def main(args):
    dump = dumps.read(args)
    numbers = range(len(dump)) if args.frame is None else [dump.number(k) for k in args.frame]
    with progress.bar(len(numbers), "cloud") as bar:
        rows = []
        for row in cloud.series((dump[k] for k in numbers), args.axis, args.plane, args.quantile):
            rows.append(row)
            bar.update()
    table = cloud.table(rows)
    names = [name for name in table.dtype.names if args.out or name not in ("time", "front_displacement_velocity") or np.isfinite(table[name]).any()]
    print(tables.text(names, table[names].tolist(), dict(cloud.SERIES), dump.units))
    if args.out:
        tables.write_csv(args.out, names, table[names].tolist())
    draw(args.figure, "cloud", table, dump.units)
