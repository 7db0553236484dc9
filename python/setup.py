# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What pyproject.toml cannot say: the version, which is written in src/USER-HVI/hvi_version.h, and the files of the source tree that the package needs and
are no Python.  They are copied into its folder data (hvi/places.py) when a wheel or a source distribution is made; git has them once."""

import atexit
import pathlib
import re
import shutil
import sys
import tempfile

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
HEADER = HERE.parent / "src" / "USER-HVI" / "hvi_version.h"
UNPACKED = HERE / "hvi" / "data"  # of a source distribution, which has no tree around it
NEEDED = ("potentials/*", "cmake/env.sh", "examples/whipple-shield/cases/*.yaml", "examples/whipple-shield/shots/all.yaml", "LICENSE")


def version():
    for file, pattern in ((HERE / "PKG-INFO", r"(?m)^Version: (\S+)$"), (HEADER, r'HVI_VERSION\[\] = "([^"]+)"')):
        if file.exists():
            return re.search(pattern, file.read_text()).group(1)
    sys.exit(f"lammps-hvi: there is no {HEADER}: install from the source tree, with pip 21.3 or later")


def copy_needed(folder):
    source = UNPACKED if UNPACKED.is_dir() else HERE.parent
    for pattern in NEEDED:
        found = [path for path in sorted(source.glob(pattern)) if path.is_file()]
        if not found:
            sys.exit(f"lammps-hvi: there is no {source / pattern}: install from the whole source tree, with pip 21.3 or later")
        for path in found:
            target = pathlib.Path(folder) / path.relative_to(source)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, target)


class BuildPy(build_py):
    def run(self):
        super().run()
        if not getattr(self, "editable_mode", False):  # that is in the tree
            copy_needed(pathlib.Path(self.build_lib) / "hvi" / "data")


class SDist(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        copy_needed(pathlib.Path(base_dir) / "hvi" / "data")


options = {}
if "sdist" not in sys.argv:
    scratch = tempfile.mkdtemp(prefix="lammps-hvi-")  # a folder build in the tree would bring modules of before into the wheel
    atexit.register(shutil.rmtree, scratch, ignore_errors=True)
    options.update(build={"build_base": scratch}, egg_info={"egg_base": scratch})  # and not everybody may write there
setup(version=version(), cmdclass={"build_py": BuildPy, "sdist": SDist}, options=options)
