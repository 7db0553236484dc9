# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi report: the page of a shield."""

import pathlib

from .. import progress
from ..errors import writing

EXAMPLES = """  python3 -m hvi report runs/emi
  python3 -m hvi report . --out shield.html"""


def add_arguments(parser):
    parser.add_argument("folder", metavar="DIR", help="folder with verdict.yaml (runs/CASE of hvi shield), or with result.yaml")
    parser.add_argument("--out", metavar="FILE.html", help="default: report.html in DIR")


def main(args):
    from ..report.report import Report

    report = Report(args.folder)
    out = pathlib.Path(args.out or pathlib.Path(args.folder) / "report.html")
    with progress.bar(None, "pictures") as bar:
        text = report.html(bar)
    with writing(out):
        out.write_text(text, encoding="utf-8")
    print(f"report: {out} ({len(text) / 1e6:.1f} MB)")
    return 0
