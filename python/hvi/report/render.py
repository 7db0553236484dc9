# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Particles as lit spheres: a depth buffer in NumPy, shaded by its normals, by what is hidden in hollows, and by shadows."""

import numpy as np
from scipy.ndimage import gaussian_filter, map_coordinates

SUPER = 2  # pixels across that become one
LIGHT = np.array([-0.38, 0.5, 0.78])  # towards it: to the right, up, to the eye


def basis(eye, up):
    """Rows: right, up, towards the eye, of unit length; eye: direction in which the eye is, up: roughly up there."""
    eye = np.asarray(eye, dtype=float) / np.linalg.norm(eye)
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def splat(x, radius, window, shape):
    """(depth, number of the sphere or -1) of each pixel, (rows, columns) each, the lowest row first.

    x: (n, 3) to the right, up, to the eye; radius: (n,); window: left, right, low, high; all in the same length, that of depth too
    """
    rows, columns = shape
    scale = columns / (window[1] - window[0])
    depth, who = np.full(rows * columns, -np.inf), np.full(rows * columns, -1, dtype=np.int64)
    column = np.floor((x[:, 0] - window[0]) * scale).astype(np.int64)
    row = np.floor((x[:, 1] - window[2]) * scale).astype(np.int64)
    sizes = np.round(np.maximum(radius * scale, 0.8), 1)  # in pixels
    for size in np.unique(sizes):
        reach = int(size)
        mine = np.flatnonzero((sizes == size) & (column >= -reach) & (column < columns + reach) & (row >= -reach) & (row < rows + reach))
        mine = mine[np.argsort(x[mine, 2], kind="stable")]  # of several at a pixel the last stays: the nearest
        for i in range(-reach, reach + 1):
            for j in range(-reach, reach + 1):
                high = size**2 - i**2 - j**2
                if high < 0.0:
                    continue
                c, r = column[mine] + i, row[mine] + j
                inside = (c >= 0) & (c < columns) & (r >= 0) & (r < rows)
                place, one = r[inside] * columns + c[inside], mine[inside]
                near = x[one, 2] + np.sqrt(high) / scale
                nearer = near > depth[place]
                depth[place[nearer]], who[place[nearer]] = near[nearer], one[nearer]
    return depth.reshape(shape), who.reshape(shape)


def _smooth(values, covered, width):
    """Gaussian mean of what is covered; wide ones from a part of the pixels, for time"""
    step = max(1, int(width / 2.5))
    some = covered[::step, ::step]
    weight = gaussian_filter(some.astype(np.float32), width / step)
    mean = gaussian_filter(np.where(some, values[::step, ::step], 0.0).astype(np.float32), width / step) / np.maximum(weight, 1e-6)
    if step == 1:
        return mean
    rows, columns = (np.arange(n, dtype=np.float32) / step for n in values.shape)
    return map_coordinates(mean, np.meshgrid(rows, columns, indexing="ij"), order=1, mode="nearest")


def _shadow(x, radius, seen, window, shape):
    """1 where light comes to the places seen (k, 3), 0 where something is between; soft at edges"""
    turn = basis(LIGHT, (0.0, 1.0, 0.0))
    lit, places = x @ turn.T, seen @ turn.T
    pixel = 1.5 * (window[1] - window[0]) / shape[1]
    low, high = places.min(axis=0), places.max(axis=0)
    size = np.ceil((high - low)[:2] / pixel).astype(int) + 3
    frame = (low[0] - pixel, low[0] + (size[0] - 1) * pixel, low[1] - pixel, low[1] + (size[1] - 1) * pixel)
    depth, _ = splat(lit, radius, frame, (size[1], size[0]))
    c = np.clip(((places[:, 0] - frame[0]) / pixel).astype(int), 1, size[0] - 2)
    r = np.clip(((places[:, 1] - frame[2]) / pixel).astype(int), 1, size[1] - 2)
    bias = 1.2 * np.median(radius)
    return np.mean([depth[r + j, c + i] < places[:, 2] + bias for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)


def picture(x, radius, rgb, view, window, width):
    """(rows, columns, 4) of uint8, the highest row first, clear where nothing is.

    x: (n, 3); radius: (n,); rgb: (n, 3) from 0 to 1; view: basis(); window: left, right, low, high along its first two rows
    """
    height = max(1, int(width * (window[3] - window[2]) / (window[1] - window[0]) + 0.5))
    shape = SUPER * height, SUPER * width
    seen = x @ view.T
    depth, who = splat(seen, radius, window, shape)
    covered = who >= 0
    if not covered.any():
        return np.zeros((height, width, 4), dtype=np.uint8)
    scale = shape[1] / (window[1] - window[0])
    ball = float(np.median(radius)) * scale  # pixels
    lowest = depth[covered].min()
    height_map = (np.where(covered, depth - lowest, 0.0) * scale).astype(np.float32)  # for time
    # normals: of the spheres themselves, and of the surface that they make together
    columns, rows = np.meshgrid(*(np.arange(n, dtype=np.float32) + 0.5 for n in shape[::-1]))
    one = np.where(covered, who, 0)
    pixels = np.column_stack([(seen[:, :2] - (window[0], window[2])) * scale, np.maximum(radius * scale, 0.8)]).astype(np.float32)[one]
    nx = np.clip((columns - pixels[..., 0]) / pixels[..., 2], -1, 1)
    ny = np.clip((rows - pixels[..., 1]) / pixels[..., 2], -1, 1)
    nz = np.sqrt(np.maximum(1.0 - nx**2 - ny**2, 0.04))
    gy, gx = np.gradient(_smooth(height_map, covered, max(ball, 1.5)))
    gx, gy = np.clip(gx, -1.2, 1.2), np.clip(gy, -1.2, 1.2)  # at edges they are steps
    flat = np.stack([-gx, -gy, np.ones_like(gx)])
    flat /= np.sqrt((flat**2).sum(axis=0))
    normal = np.float32(0.45) * np.stack([nx, ny, nz]) + np.float32(0.55) * flat
    normal /= np.sqrt((normal**2).sum(axis=0))
    light = (LIGHT / np.linalg.norm(LIGHT)).astype(np.float32)
    straight = np.clip(np.tensordot(light, normal, 1), 0.0, None)
    half = light + np.array((0.0, 0.0, 1.0), dtype=np.float32)
    gloss = np.clip(np.tensordot(half / np.linalg.norm(half), normal, 1), 0.0, None) ** 24
    # hollows get less of the light from all around; what is far in front hides nothing
    hidden = np.zeros(shape, dtype=np.float32)
    for around in (2.0 * max(ball, 1.0), 6.0 * max(ball, 1.0)):
        over = np.clip((_smooth(height_map, covered, around) - height_map) / around, 0.0, None)
        hidden += np.minimum(0.5 * over, 0.8) * np.exp(-((over / 3.0) ** 2))
    open_ = 1.0 / (1.0 + hidden)
    places = np.stack([window[0] + columns[covered] / scale, window[2] + rows[covered] / scale, depth[covered]], axis=1)
    shade = np.ones(shape, dtype=np.float32)
    shade[covered] = _shadow(seen, radius, places, window, shape)
    bright = open_ * (0.52 + 0.66 * straight * (0.45 + 0.55 * shade))
    colors = rgb.astype(np.float32)[one] * bright[..., None] + (0.16 * gloss * shade)[..., None]
    colors = np.clip(colors, 0.0, 1.0) * covered[..., None]
    rgba = np.concatenate([colors, covered[..., None].astype(np.float32)], axis=-1)
    rgba = rgba.reshape(height, SUPER, width, SUPER, 4).mean(axis=(1, 3))[::-1]
    rgba[..., :3] /= np.maximum(rgba[..., 3:], 1e-9)
    return np.round(255.0 * np.clip(rgba, 0.0, 1.0)).astype(np.uint8)
