# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Particles of a frame as text that a page can hold: quantized, column after column, deflated, in base 64.

Bytes of n particles before they are deflated: x, then y, then z, 2 n each, from 0 to 65535 in the box of the particles; then the
columns, n each. A page gives them to the graphics card as they are.
"""

import base64
import zlib

import numpy as np

TEXT = 20_000_000  # characters of all frames of a page
PARTICLES = 200_000  # of a frame; of more every second, third, ... is left
COLUMNS = 5  # at most: part, speed, damage, temperature, pressure
LEVELS = 65535  # steps of a coordinate in the box


def frames_of(particles, columns=COLUMNS):
    """How many frames of so many particles a page holds, whatever they contain, at least 1; particles: number of them; columns: number of bytes beside coordinates"""
    size = min(particles, PARTICLES) * (6 + columns)
    return max(1, int(TEXT / (4 / 3 * 1.001 * size + 1000)))  # base 64; deflate adds 5 bytes to each 16 kB of noise; the rest of a frame's record


def stride_of(particles):
    """Every which particle is left, so that they are PARTICLES at most"""
    return -(-particles // PARTICLES) or 1


def levels(values, low, high, root=False):
    """Values (n,) as bytes (n,): 0 at low and below, 255 at high and above; root: by the root of the distance from 0, on both sides; what is no number is 0"""
    values = np.asarray(values, dtype=float)
    if root:
        values, low, high = (np.sign(v) * np.sqrt(np.abs(v)) for v in (values, low, high))
    part = np.nan_to_num((values - low) / (high - low), nan=0.0) if high > low else np.zeros(len(values))
    return np.rint(255 * np.clip(part, 0, 1)).astype(np.uint8)


def pack(x, columns):
    """{n, low: [3], size: [3], data: text} of particles at x (n, 3), finite, with columns [(n,) of uint8, ...]; low and size are of their box, in the units of x.

    A coordinate low + size * k / 65535 is at most size / 131070 from where it was.
    """
    low, high = (x.min(axis=0), x.max(axis=0)) if len(x) else (np.zeros(3), np.zeros(3))
    size = np.where(high > low, high - low, 1.0)
    whole = np.rint((x - low) / size * LEVELS).astype("<u2")
    data = zlib.compress(b"".join([whole.T.tobytes(), *(np.ascontiguousarray(column, dtype=np.uint8).tobytes() for column in columns)]), 9)
    return {"n": len(x), "low": [float(v) for v in low], "size": [float(v) for v in size], "data": base64.b64encode(data).decode()}
