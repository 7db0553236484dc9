# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Dumps and data files of LAMMPS, read a frame at a time."""
