# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Particles, hexahedra and surfaces that scenes are made of, as data files."""
