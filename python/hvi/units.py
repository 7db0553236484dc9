# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""LAMMPS's unit systems: energy from mass and velocity, names for labels, and readable scales for figures."""

import numpy as np

from .errors import HVIError

# energy of m v^2: "mvv2e" of LAMMPS's Update::set_units()
MVV2E = {"lj": 1.0, "real": 48.88821291**2, "metal": 1.0364269e-4, "si": 1.0, "cgs": 1.0, "electron": 1.06657236,
         "micro": 1.0, "nano": 1.0}

_NAMES = {  # distance, time, mass, velocity, energy, momentum
    "lj": ("sigma", "tau", "m", "sigma/tau", "epsilon", "m sigma/tau"),
    "real": ("A", "fs", "g/mol", "A/fs", "kcal/mol", "g/mol A/fs"),
    "metal": ("A", "ps", "g/mol", "A/ps", "eV", "g/mol A/ps"),
    "si": ("m", "s", "kg", "m/s", "J", "kg m/s"),
    "cgs": ("cm", "s", "g", "cm/s", "erg", "g cm/s"),
    "electron": ("bohr", "fs", "u", "bohr/atu", "hartree", "u bohr/atu"),
    "micro": ("um", "us", "pg", "um/us", "pg um^2/us^2", "pg um/us"),
    "nano": ("nm", "ns", "ag", "nm/ns", "ag nm^2/ns^2", "ag nm/ns"),
}
QUANTITIES = ("distance", "time", "mass", "velocity", "energy", "momentum")

# figures in SI units: the largest of these that the data reach
_SCALES = {
    "distance": ((1.0, "m"), (1e-3, "mm"), (1e-6, "um")),
    "time": ((1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")),
    "mass": ((1.0, "kg"), (1e-3, "g"), (1e-6, "mg"), (1e-9, "ug")),
    "velocity": ((1e3, "km/s"), (1.0, "m/s")),
    "energy": ((1e3, "kJ"), (1.0, "J"), (1e-3, "mJ")),
    "momentum": ((1.0, "kg m/s"), (1e-3, "g m/s")),
}


def check(units):
    """The name of the unit system; HVIError if LAMMPS has no such units."""
    if units not in MVV2E:
        raise HVIError(f"unknown units {units}: LAMMPS has {', '.join(MVV2E)}")
    return units


def name(quantity, units):
    """Unit of a quantity of QUANTITIES, as text; '' for anything else (counts, ratios)."""
    return _NAMES[check(units)][QUANTITIES.index(quantity)] if quantity in QUANTITIES else ""


def scale(quantity, values, units):
    """(factor, unit) for a figure: values / factor are readable numbers in that unit.

    Only SI is rescaled (mm, us, km/s, ...); other systems were chosen by the user for their numbers.
    """
    if units != "si" or quantity not in _SCALES:
        return 1.0, name(quantity, units)
    finite = np.abs(np.asarray(values, dtype=float))
    finite = finite[np.isfinite(finite)]
    largest = finite.max() if finite.size else 1.0
    for factor, text in _SCALES[quantity]:
        if largest >= factor:
            return factor, text
    return _SCALES[quantity][-1]


def label(text, unit):
    """'text (unit)', or text alone where there is no unit"""
    return f"{text} ({unit})" if unit else text
