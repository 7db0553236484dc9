# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""hvi.verdict(): case in, verdict out, for notebooks and scripts."""

import argparse
import pathlib
import signal

import yaml

from ..errors import HVIError, writing
from ..shield import answer
from . import shield


class _Parser(argparse.ArgumentParser):
    """whose errors are no end of the program"""

    def error(self, message):
        raise HVIError(f"hvi.verdict(): {message}")


def verdict(case, name=None, runs="runs", **options):
    """Does the wall hold?  Runs a case as python3 -m hvi shield does and gives its hvi.shield.answer.Answer; what was run before is not run again.

    case: path of CASE.yaml, or a mapping with its keys, lengths in mm and speeds in km/s; python3 -m hvi shield --help has them all
    name: of a mapping: it is written to RUNS/NAME.yaml, and files that it names are looked for there
    runs: folder for the runs, those of the case in RUNS/CASE
    options: of the command: jobs=1, runs at a time; ranks=2, MPI ranks of a run; timeout, seconds; lmp, mpirun: programs

    The Answer has verdict, "holds", "fails" or "undecided", reasons and notes, margins, areal_densities in kg/m^2, core_s, runs, dataframe().
    Raises HVIError where the case is wrong, LAMMPS is not found or a run fails.
    """
    if isinstance(case, dict):
        if not name:
            raise HVIError("hvi.verdict(): a mapping needs a name: its runs are in the folder RUNS/NAME")
        if pathlib.Path(name).name != name:
            raise HVIError(f"hvi.verdict(): the name {name!r} must be that of a folder in {runs}, without a path")
        path = pathlib.Path(runs) / f"{name}.yaml"
        with writing(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(yaml.safe_dump(case, sort_keys=False), encoding="utf-8")
    elif name:
        raise HVIError("hvi.verdict(): a name is for a mapping: the name of a file is that of its case")
    else:
        path = pathlib.Path(case)
    parser = _Parser(add_help=False, allow_abbrev=False)
    shield.add_arguments(parser)
    args = parser.parse_args([str(path), f"--runs={runs}", *(f"--{key.replace('_', '-')}={value}" for key, value in options.items() if value is not None)])
    if args.write:
        raise HVIError("hvi.verdict(): write is for the command line: it runs nothing")
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}  # which end runs, and are the notebook's own again after them
    try:
        shield.main(args)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    return answer.read(path, runs)
