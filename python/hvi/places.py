# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Where the package finds what it needs and is no Python: in the source tree that it is in; installed, in its own folder data, where the build of the wheel
puts copies (python/setup.py lists them). How the command line was called."""

import os
import pathlib
import shutil
import sys

PACKAGE = pathlib.Path(__file__).resolve().parent
ROOT = PACKAGE.parents[1]  # of the source tree, if this file is in one
IN_TREE = (ROOT / "src" / "USER-HVI" / "hvi_version.h").is_file()
DATA = ROOT if IN_TREE else PACKAGE / "data"
POTENTIALS = DATA / "potentials"
ENV = DATA / "cmake" / "env.sh"  # settings that MPI jobs need
EXAMPLE = DATA / "examples" / "whipple-shield" / "cases" / "quick.yaml"


def program():
    """the command line as users call it"""
    return "hvi" if pathlib.Path(sys.argv[0]).name == "hvi" else "python3 -m hvi"


def typed():
    """the same as it can be typed in any folder, a list of words"""
    if program() != "hvi":
        return program().split()
    found = shutil.which("hvi")
    return ["hvi"] if found and os.path.exists(sys.argv[0]) and os.path.samefile(found, sys.argv[0]) else [os.path.abspath(sys.argv[0])]
