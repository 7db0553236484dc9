# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What runs of the examples have recorded, measured and put into their result.yaml."""

import pathlib

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
    engine.write_yaml(path, result)
    return result
