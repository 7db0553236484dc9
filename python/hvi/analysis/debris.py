# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Debris below the spacing: how many pieces a failed particle stands for, by the size that compute hvi/atom fragsize has for it.

An estimate of one size per particle, not a distribution: a failed particle of mass m and density rho whose pieces of size s are smaller
than itself, d = (6 m/(pi rho))^(1/3), counts as m/(rho pi/6 s^3) = (d/s)^3 spheres of that size. In three dimensions only: in planes and rows of
particles m is per length or area, which has neither a diameter nor a number of spheres.
"""

import dataclasses

import numpy as np

from ..errors import HVIError

COLUMN = "fragsize"
KINDS = ("resolved", "subparticle", "unknown")


@dataclasses.dataclass
class Debris:
    """What n particles stand for.

    mass: of each particle, (n,)
    pieces: their number, (n,): 1 if it is resolved, more below the spacing, 0 where the size of the pieces is unknown
    size: diameter of a piece, (n,); of what is resolved that of the particle, 0 where it is unknown
    """

    mass: np.ndarray
    pieces: np.ndarray
    size: np.ndarray

    @property
    def kind(self):
        """Place in KINDS of each particle, (n,)."""
        return np.where(self.pieces == 0.0, 2, np.where(self.pieces > 1.0, 1, 0))

    def shares(self, values):
        """Sums of values (n,) over what is resolved, below the spacing, unknown: (3,)."""
        return np.bincount(self.kind, values, minlength=len(KINDS))

    @property
    def summary(self):
        """Masses of the three kinds, which add up to that of all; number and mean size (by mass) of the pieces below the spacing."""
        shares = self.shares(self.mass)
        below = self.kind == 1
        size = self.mass[below] @ self.size[below] / shares[1] if shares[1] > 0.0 else 0.0
        return {**{f"{kind}_mass": share for kind, share in zip(KINDS, shares)}, "subparticle_pieces": self.pieces[below].sum(),
                "subparticle_size": size}


def estimate(frame, failed, density, column=COLUMN):
    """Debris of the particles of a frame.

    failed: mask, (n,); density: of the solid matter, {type: rho}; column: size of the fragments that a particle has failed into, 0: unknown
    Pieces that are not smaller than the particle are not resolved better than by it: it counts as one.
    HVIError if the frame is a plane or a row of particles.
    """
    if frame.flat:
        same = " and ".join("xyz"[k] for k in frame.flat)
        raise HVIError(f"{frame.where}: all particles have the same {same}. In a plane or a row of particles masses are per length or area, so pieces "
                       "below the spacing have no number: leave out the density")
    size = np.asarray(frame[column], dtype=float)
    frame.require_finite(size[:, None], (column,))
    if len(size) and size.min() < 0.0:
        raise HVIError(f"{frame.where}: column {column} is no size: {size.min():g}")
    own = np.cbrt(6.0 * frame.m / (np.pi * frame.by_type(density, "density")))
    unknown = failed & (size == 0.0)
    below = failed & (size > 0.0) & (size < own)
    pieces = np.where(unknown, 0.0, 1.0)
    pieces[below] = (own[below] / size[below]) ** 3
    return Debris(frame.m, pieces, np.where(below, size, np.where(unknown, 0.0, own)))
