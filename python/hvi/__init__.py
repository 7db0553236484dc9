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

from .version import version

__version__ = version()
# what is given out, and where it is: imported when it is asked for, as NumPy, SciPy, matplotlib and MDAnalysis take their time
_PLACES = {"Dump": "io.dump", "Frame": "io.frame", "HVIError": "errors", "HVIWarning": "errors", "beyond": "analysis.cloud", "cumulative": "analysis.distribution",
           "find": "analysis.fragments", "fit": "analysis.distribution", "measure": "analysis.cloud", "series": "analysis.cloud"}
_MODULES = {"cloud": "analysis.cloud", "debris": "analysis.debris", "distribution": "analysis.distribution", "figures": "figures", "fragments": "analysis.fragments",
            "hole": "analysis.hole", "maps": "analysis.maps", "universe": "io.universe"}
__all__ = [*_PLACES, *_MODULES, "open"]


def __getattr__(name):
    if name == "open":
        return importlib.import_module(".io.universe", __name__).open_universe
    if name in _MODULES:
        return importlib.import_module("." + _MODULES[name], __name__)
    if name in _PLACES:
        return getattr(importlib.import_module("." + _PLACES[name], __name__), name)
    raise AttributeError(f"module {__name__} has no attribute {name}")


def __dir__():
    return sorted({*globals(), *__all__})
