# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The version is written in src/USER-HVI/hvi_version.h; everything else about the package is in pyproject.toml."""

import pathlib
import re

from setuptools import setup

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = (  # of the version: an unpacked source distribution has it in its metadata, and no header
    (HERE / "PKG-INFO", r"(?m)^Version: (\S+)$"),
    (HERE.parent / "src" / "USER-HVI" / "hvi_version.h", r'HVI_VERSION\[\] = "([^"]+)"'),
)
file, pattern = next((s for s in SOURCES if s[0].exists()), SOURCES[-1])
setup(version=re.search(pattern, file.read_text()).group(1))
