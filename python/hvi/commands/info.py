# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi info: what is in a dump."""

from .. import progress, tables
from ..io import mirror
from ..io.dump import Dump
from . import dumps

EXAMPLES = "  python3 -m hvi info debris.dump"


def add_arguments(parser):
    dumps.add_files(parser)


def main(args):
    dump = Dump(args.files, progress=progress.bar)
    first = dump.headers[0]
    print(f"{len(dump)} frames, {first.n} {(first.label or '').lower()} in the first, units {dump.said_units() or 'not said'}")
    print(f"columns: {' '.join(dump.columns)}")
    print(f"model: {mirror.text(next((said for said in map(dump.mirror, range(len(dump))) if said is not None), None))}")
    rows = [(k, h.step, "-" if h.time is None else h.time, h.n) for k, h in enumerate(dump.headers)]
    print(tables.text(("frame", "step", "time", "rows"), rows))
