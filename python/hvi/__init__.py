# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What comes out of an impact: dumps of LAMMPS read, fragments and clouds measured as USER-HVI's computes do, figures.

    import hvi
    u = hvi.open("debris.dump", data="debris.data", bonds="bonds.dump")   # an MDAnalysis Universe
    u.trajectory[-1]
    hvi.measure(u, "z", 4.05e-3)                                          # the twelve values of compute hvi/cloud
    hvi.find(u, axis="z", plane=4.05e-3).table                            # rows of compute hvi/fragment
    answer = hvi.verdict("quick.yaml", jobs=2, ranks=1)                   # case in, verdict out: runs it as python3 -m hvi shield does
    hvi.answer("runs/quick").dataframe()                                  # what was run before, a row per run
    hvi.Run("runs/quick/dx-0.5_shift-0.0").dataframe()                    # of one run a row per moment

Without MDAnalysis: hvi.Dump("debris.dump", data="debris.data")[-1] is a frame that all functions take. Numbers are in the units of the dump;
arrays of n particles have the shape (n,), vectors (n, 3). DataFrames need pandas.
On the command line: python3 -m hvi --help
"""

import importlib

from .errors import NotThere, remedy
from .version import version

__version__ = version()
# what is given out, and where it is: imported when it is asked for, as NumPy, SciPy, matplotlib and MDAnalysis take their time
_PLACES = {"Dump": "io.dump:Dump", "Frame": "io.frame:Frame", "HVIError": "errors:HVIError", "HVIWarning": "errors:HVIWarning", "open": "io.universe:open_universe",
           "verdict": "commands.notebook:verdict", "answer": "shield.answer:read", "Run": "shield.run:Run", "find": "analysis.fragments:find", **dict.fromkeys(("beyond", "measure", "series"), "analysis.cloud:"), **dict.fromkeys(("cumulative", "fit"), "analysis.distribution:"),
           **{name: f"analysis.{name}" for name in ("cloud", "debris", "distribution", "fragments", "hole", "maps")}, "figures": "figures", "universe": "io.universe"}
__all__ = [*_PLACES]


def __getattr__(name):
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    module, inside, attribute = _PLACES[name].partition(":")
    try:
        found = importlib.import_module("." + module, __name__)
    except ModuleNotFoundError as error:
        library = (error.name or "").partition(".")[0]
        raise NotThere(f"hvi.{name} needs {library}: {remedy(library)}") from None
    return getattr(found, attribute or name) if inside else found


def __dir__():
    return sorted([*__all__, *(name for name in globals() if name.startswith("__"))])
