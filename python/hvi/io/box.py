# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The simulation box: orthogonal, triclinic or general triclinic."""

import dataclasses
import itertools

import numpy as np


@dataclasses.dataclass(frozen=True)
class Box:
    """origin: (3,); vectors: (3, 3), rows a b c; periodic: (3,) of bool. Distance units of the dump."""

    origin: np.ndarray
    vectors: np.ndarray
    periodic: tuple

    @classmethod
    def parse(cls, title, lines):
        """From the text after "ITEM: BOX BOUNDS" and the three lines below it; ValueError if they are no box.

        Conventions: LAMMPS manual, "dump" and "Howto triclinic". A triclinic dump gives the bounds of the box around
        the parallelepiped, from which its own corners follow.
        """
        words = title.split()
        if not np.isfinite([float(w) for line in lines for w in line.split()]).all():
            raise ValueError("a bound of the box is not a finite number")
        rows = np.array([[float(w) for w in line.split()] for line in lines])
        if words[:2] == ["abc", "origin"]:
            if rows.shape != (3, 4):
                raise ValueError("general triclinic box")
            return cls(rows[:, 3], rows[:, :3], cls._periodic(words[2:]))
        lo, hi = rows[:, 0].copy(), rows[:, 1].copy()
        xy = xz = yz = 0.0
        if words[:3] == ["xy", "xz", "yz"]:
            words = words[3:]
            xy, xz, yz = rows[:, 2]
            lo[0] -= min(0.0, xy, xz, xy + xz)
            hi[0] -= max(0.0, xy, xz, xy + xz)
            lo[1] -= min(0.0, yz)
            hi[1] -= max(0.0, yz)
        length = hi - lo
        return cls(lo, np.array([[length[0], 0, 0], [xy, length[1], 0], [xz, yz, length[2]]]), cls._periodic(words))

    @staticmethod
    def _periodic(words):
        return tuple(words[k] == "pp" if k < len(words) else False for k in range(3))

    def from_scaled(self, s):
        """Coordinates (n, 3) of scaled ones, 0 to 1 across the box."""
        return self.origin + s @ self.vectors

    def to_scaled(self, x):
        return np.linalg.solve(self.vectors.T, (x - self.origin).T).T

    @property
    def heights(self):
        """Distances between opposite faces, (3,)."""
        return 1.0 / np.linalg.norm(np.linalg.inv(self.vectors), axis=0)

    def wrap(self, x):
        """Into the box along its periodic directions; (n, 3)."""
        if not any(self.periodic):
            return x
        return x - np.where(self.periodic, np.floor(self.to_scaled(x)), 0.0) @ self.vectors

    def images(self, x, reach):
        """Particles (n, 3) in the box and those of their periodic images that are less than reach outside it.

        Returns coordinates (m, 3), the first n of which are the particles, and for each row the particle it is of (m,).
        """
        owner = np.arange(len(x))
        if not any(self.periodic):
            return x, owner
        margin = reach / self.heights
        s = self.to_scaled(x)
        far = [int(np.ceil(m)) if p else 0 for m, p in zip(margin, self.periodic)]
        all_x, all_owner = [x], [owner]
        for shift in itertools.product(*(range(-f, f + 1) for f in far)):
            if shift == (0, 0, 0):
                continue
            moved = s + shift
            near = np.all((moved > -margin) & (moved < 1.0 + margin) | ~np.array(self.periodic), axis=1)
            all_x.append(x[near] + np.array(shift) @ self.vectors)
            all_owner.append(owner[near])
        return np.concatenate(all_x), np.concatenate(all_owner)
