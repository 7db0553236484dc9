# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The version is written in src/USER-HVI/hvi_version.h; everything else about the package is in pyproject.toml."""

import pathlib
import re

from setuptools import setup

HEADER = pathlib.Path(__file__).resolve().parents[1] / "src" / "USER-HVI" / "hvi_version.h"
setup(version=re.search(r'HVI_VERSION\[\] = "([^"]+)"', HEADER.read_text()).group(1))
