# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Places of particles like those of atoms in a glass: even, without rows."""

import numpy as np

SKIN = 0.4  # of the list of neighbors, spacings
FAR = 0.2  # longest way of a step
DRAG = 0.9  # what is left of the way of the last step

# Pairs push each other apart, r in spacings: (steps, how far, reach, push over r). First 1/(r + .1)^2 less its value at the reach, as
# Diehl et al., PASA 32 (2015) e048, eq. 12, which is steep and keeps the nearest apart; then the gradient of the kernel wendland2 with h = 1.2,
# whose sum it makes even.
STAGES = ((100, 0.03, 2.0, lambda r: ((r + 0.1) ** -2 - 2.1**-2) / r), (20, 0.05, 2.4, lambda r: 5 / 1.2 * (1 - r / 2.4) ** 3))


def relax(shape, n, seed=1):
    """Places (n, 3) of n particles that fill a shape (bodies.Shape). The same numbers make the same places.

    Images behind the faces, as dense as the particles, keep them half a spacing from it: the surface is a layer, and flat where the face is.
    """
    from scipy.spatial import cKDTree

    unit = np.cbrt(shape.volume / n)
    x = _start(shape, n, unit, np.random.default_rng(seed))
    for steps, far, reach, push in STAGES:
        last, way = None, np.zeros_like(x)
        for _ in range(steps):
            if last is None or ((x - last) ** 2).sum(axis=1).max() > (0.5 * SKIN * unit) ** 2:
                last, images = x, shape.images_near(x, (reach + SKIN) * unit)
                pairs = cKDTree(shape.with_images(x, images)[0]).query_pairs((reach + SKIN) * unit, output_type="ndarray")
                i, j = pairs[pairs.min(axis=1) < n].T.copy()
            y, weight = shape.with_images(x, images)
            d = (y[i] - y[j]) / unit
            r = np.sqrt(np.einsum("ij,ij->i", d, d))
            d *= np.where(r < reach, push(np.maximum(r, 1e-6)), 0.0)[:, None]
            force = np.stack([(np.bincount(i, c * weight[j], len(y)) - np.bincount(j, c * weight[i], len(y)))[:n] for c in d.T], axis=1)
            way = DRAG * way + far * force
            way *= np.minimum(1.0, FAR / np.maximum(np.sqrt((way**2).sum(axis=1)), 1e-300))[:, None]
            x = shape.keep(x + unit * way)
    return x


def _start(shape, n, unit, rng):
    """at random, but nowhere too many, which would take long to relax: a sequence of low discrepancy, each moved by up to half a spacing"""
    root = 1.2207440846057596  # x^4 = x + 1: the powers of 1/x are as far from rational as three numbers can be
    u = (0.5 + np.arange(1, n + 1)[:, None] * root ** -np.arange(1.0, 4.0) + rng.random(3)) % 1.0
    return shape.keep(shape.spread(u) + unit * (rng.random((n, 3)) - 0.5))
