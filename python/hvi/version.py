# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The version of the package, which is written in src/USER-HVI/hvi_version.h and nowhere else."""

import re

from .places import ROOT

HEADER = ROOT / "src" / "USER-HVI" / "hvi_version.h"


def version():
    """From the source tree this file is in; from the installed package where there is no tree."""
    try:
        return re.search(r'HVI_VERSION\[\] = "([^"]+)"', HEADER.read_text()).group(1)
    except FileNotFoundError:
        from importlib import metadata

        try:
            return metadata.version("lammps-hvi")
        except metadata.PackageNotFoundError:  # a copy of this folder alone
            return "of unknown version"
