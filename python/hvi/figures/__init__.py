# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Figures of frames and measures, of ballistic limits; in modules of their own those of materials and cases. All with matplotlib."""

from .frames import BODIES, ballistic_limit, cloud, distribution, field, hole, impacts, limit_curve, phase, save, side, spacing  # noqa: F401
