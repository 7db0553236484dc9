# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi measure: what runs of the examples have recorded."""

from ..errors import HVIError
from ..jobs.engine import yaml_of
from ..jobs.measures import measure

EXAMPLES = """  python3 -m hvi measure .
  python3 -m hvi measure runs/*"""


def add_arguments(parser):
    parser.add_argument("folders", nargs="+", metavar="DIR", help="folder of a run, with result.yaml; what is measured is told by its files: surface.dat")


def main(args):
    problems = []
    for folder in args.folders:
        try:
            result = measure(folder)
        except HVIError as problem:
            problems.append(str(problem))
            continue
        if len(args.folders) > 1:
            print(f"# {folder}")
        print(yaml_of(result), end="")
    if problems:
        raise HVIError("; ".join(problems))
