"""Lattices with craters, as frames."""

import hvi
import numpy as np


def target(radius=24, deep=24, hole=None, shift=(0.0, 0.0, 0.0), quarter=False):
    """a cylinder of a lattice of spacing 1 below z = 0, type 2, without what hole(x) takes away, and a particle of type 1 far above"""
    n = radius + 1
    x = np.stack(np.meshgrid(np.arange(-n, n) + 0.5, np.arange(-n, n) + 0.5, -np.arange(deep) - 0.5, indexing="ij"), -1).reshape(-1, 3)
    keep = np.hypot(x[:, 0], x[:, 1]) < radius
    if hole:
        keep &= ~hole(x)
    if quarter:
        keep &= (x[:, :2] > 0).all(axis=1)
    x = np.concatenate([x[keep], [[0.5, 0.5, 9.0]]]) + shift
    columns = {"id": np.arange(len(x)) + 1, "type": np.append(np.full(len(x) - 1, 2), 1), "mass": np.ones(len(x)), **dict(zip("xyz", x.T))}
    return hvi.Frame(columns, units="lj", mirror=(("x", "lo", 0.0), ("y", "lo", 0.0)) if quarter else ())


def bowl(depth, wide):
    """half an ellipsoid"""
    return lambda x: (x[:, 0]**2 + x[:, 1]**2) / wide**2 + x[:, 2]**2 / depth**2 < 1
