# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What runs a case of bench/cases: one module each, with

run(case, settings, folder, lmp, ranks=1, timeout=600) -> dict
    case: the case file; settings: method, resolution and what is varied; folder: an empty pathlib.Path to work in; lmp: the program
    particles, steps: int; loop_s: LAMMPS's loop times (s of wall, all runs of it); errors, numbers: {name: number};
    ledger: {"energy": largest |E/E0 - 1|, "momentum": relative}; failed: "" or what went wrong
A method that cannot do a case raises Cannot.
"""


class Cannot(Exception):
    """why a method cannot do a case"""
