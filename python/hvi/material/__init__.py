# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Material files: what they have, lack and assume, and the curves of their laws."""
