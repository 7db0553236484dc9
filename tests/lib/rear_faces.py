"""What the body of a wall hides, as compute hvi/wall has it, from positions alone."""

import itertools

import numpy as np


def hidden(frame, own, rho, anchor=(0.0, 0.0)):
    """of each particle, the axis is z: does matter in `own` reach beyond it in all columns, one finest spacing wide, around its place, by half of that at least?"""
    spacing = (frame.m / rho) ** (1 / 3)
    width, reaches = spacing[own].min(), {}
    index = lambda x: np.floor((x - anchor) / width).astype(int)  # noqa: E731
    for place, height, d in zip(frame.x[own, :2], frame.x[own, 2], spacing[own]):
        lo, hi = index(place - 0.75 * d), index(place + 0.75 * d)
        for c in itertools.product(range(lo[0], hi[0] + 1), range(lo[1], hi[1] + 1)):
            reaches[c] = max(reaches.get(c, -np.inf), height)
    first, last = index(frame.x[own, :2].min(axis=0)), index(frame.x[own, :2].max(axis=0))

    def hides(p, q, height):
        there = [c for c in itertools.product(range(p - 1, p + 2), range(q - 1, q + 2)) if (np.array(c) >= first).all() and (np.array(c) <= last).all()]
        return (p, q) in there and all(height < reaches.get(c, -np.inf) - 0.5 * width for c in there)

    return np.array([hides(p, q, height) for (p, q), height in zip(index(frame.x[:, :2]), frame.x[:, 2])])
