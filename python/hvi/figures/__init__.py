# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Figures of frames and measures, of ballistic limits; in modules of their own those of materials and cases. All with matplotlib."""

from .frames import cloud, crater, distribution, field, hole, impacts, phase, side, spacing  # noqa: F401
from .limits import ballistic_limit, limit_brackets, limit_curve  # noqa: F401
from .shields import shields  # noqa: F401
from .style import BODIES, save  # noqa: F401
