# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""hvi.verdict(): case in, verdict out, for notebooks and scripts."""

import argparse
import pathlib
import signal

import numpy as np
import yaml

from ..errors import HVIError, writing
from ..jobs import engine
from ..jobs.runs import end_signals
from ..shield import answer
from . import shield

HEAD = "# written by hvi.verdict(): a later call with this name writes it again\n"  # a file without it is the user's own


class _Parser(argparse.ArgumentParser):
    """whose errors are no end of the program"""

    def error(self, message):
        raise HVIError(f"hvi.verdict(): {message}")


def plain(value):
    """A value with Python's numbers and lists, which YAML knows, in place of NumPy's numbers and arrays, also within mappings and lists"""
    if isinstance(value, dict):
        return {key: plain(inside) for key, inside in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inside) for inside in value]
    return value.tolist() if isinstance(value, (np.generic, np.ndarray)) else value


def write(path, case):
    """Writes the mapping of a case to a file. A file without HEAD stays: one with the same case is taken, another is an HVIError, as is a value that YAML does not know"""
    case = plain(case)
    try:
        text = HEAD + yaml.safe_dump(case, sort_keys=False)
    except yaml.YAMLError as problem:
        raise HVIError(f"hvi.verdict(): the case has a value that is neither number, text, list nor mapping: {' '.join(str(problem).split())}") from None
    with writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists() and not path.read_bytes().startswith(HEAD.encode()):
            if engine.read_yaml(path) != case:
                raise HVIError(f"hvi.verdict(): {path} is there, not written by hvi.verdict(), and of another case: take another name or another folder runs, or delete it")
            return
        path.write_text(text, encoding="utf-8")


def verdict(case, name=None, runs="runs", **options):
    """Does the wall hold?  Runs a case as python3 -m hvi shield does and gives its hvi.shield.answer.Answer; what was run before is not run again.

    case: path of CASE.yaml, or a mapping with its keys, numbers of Python or NumPy, lengths in mm and speeds in km/s; python3 -m hvi shield --help has them all
    name: of a mapping: it is written to RUNS/NAME.yaml, and files that it names are looked for there; a RUNS/NAME.yaml of your own with another case is an error
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
        write(path, case)
    elif name:
        raise HVIError("hvi.verdict(): a name is for a mapping: the name of a file is that of its case")
    else:
        path = pathlib.Path(case)
    parser = _Parser(add_help=False, allow_abbrev=False)
    shield.add_arguments(parser)
    args = parser.parse_args([str(path), f"--runs={runs}", *(f"--{key.replace('_', '-')}={value}" for key, value in options.items() if value is not None)])
    if args.write:
        raise HVIError("hvi.verdict(): write is for the command line: it runs nothing")
    before = {number: signal.getsignal(number) for number in end_signals()}  # which end runs, and are the notebook's own again after them
    try:
        shield.main(args)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    return answer.read(path, runs)
