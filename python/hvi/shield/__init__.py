# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A shield and what strikes it: cases, their runs, verdicts, limits, equations."""
