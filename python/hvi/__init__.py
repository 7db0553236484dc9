# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What comes out of an impact: dumps of LAMMPS read, fragments and clouds measured as USER-HVI's computes do, figures.

    import hvi
    u = hvi.open("debris.dump", data="debris.data", bonds="bonds.dump")   # an MDAnalysis Universe
    u.trajectory[-1]
    hvi.measure(u, "z", 4.05e-3)                                          # the twelve values of compute hvi/cloud
    hvi.find(u, axis="z", plane=4.05e-3).table                            # rows of compute hvi/fragment

Without MDAnalysis: hvi.Dump("debris.dump", data="debris.data")[-1] is a frame that all functions take.
On the command line: python3 -m hvi --help
"""

import importlib

from . import debris
from .cloud import beyond, measure, series
from .distribution import cumulative, fit
from .dump import Dump
from .errors import HVIError, HVIWarning
from .fragments import find
from .frame import Frame
from .version import version

__version__ = version()
__all__ = ["Dump", "Frame", "HVIError", "HVIWarning", "beyond", "cumulative", "debris", "figures", "find", "fit", "hole", "maps", "measure",
           "open", "series", "universe"]

_LATER = ("figures", "hole", "maps", "universe")  # matplotlib, scipy.ndimage, MDAnalysis


def __getattr__(name):
    if name == "open":
        return importlib.import_module(".universe", __name__).open_universe
    if name in _LATER:
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__} has no attribute {name}")
