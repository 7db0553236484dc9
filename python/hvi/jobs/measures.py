# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi measure: what runs of the examples have recorded is measured and put into their result.yaml."""

import os
import pathlib

import yaml

from ..errors import HVIError
from . import engine, pullback

# {file of a run: function of its folder and of the mapping in its result.yaml, which gives {key: value} to add}
MEASURES = {"surface.dat": pullback.measured}


def functions_of(folder):
    """those that have something to measure in a folder"""
    return [function for name, function in MEASURES.items() if (folder / name).is_file()]


def measure(folder):
    """completes result.yaml of a run by all that its files can be measured for, and gives the mapping; nothing is written if something is wrong"""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise HVIError(f"{folder}: there is no such folder")
    functions = functions_of(folder)
    if not functions:
        raise HVIError(f"{folder}: nothing to measure: there is no {' or '.join(MEASURES)}")
    path = folder / "result.yaml"
    result = engine.read_yaml(path)
    if not result or engine.LAST not in result:
        raise HVIError(f"{path} is missing or not complete: has the run ended?")
    for function in functions:
        added = function(folder, result)
        result = {**{key: value for key, value in result.items() if key not in added and key != engine.LAST}, **added, engine.LAST: result[engine.LAST]}
    new = folder / "result.yaml.new"
    new.write_text(text(result))
    os.replace(new, path)
    return result


def text(result):
    return yaml.safe_dump(result, sort_keys=False, width=1000)


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
        print(text(result), end="")
    if problems:
        raise HVIError("; ".join(problems))
