# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What a frame says: the debris cloud, fragments, holes, maps."""
