# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The hole in a plate, as compute hvi/hole measures it: doc/src/compute_hvi_hole.rst has the definition.

Other than the compute, it does not guess whether the plate is cut at the center: mirror planes are those of the record.
"""

import dataclasses
import math
from typing import Optional
import warnings

import numpy as np
from scipy import ndimage

from ..errors import HVIError, HVIWarning
from ..io.frame import as_frame, axis_number
from . import fragments

# as in compute_hvi_hole.cpp and hvi_plate.cpp
PER_OCTAVE, OCTAVES, NBINS, TAIL, MARGIN, FINEST = 64, 40, 4096, 0.01, 0.1, 0.75
MAXNODES, MAXLINE, PIECE, FINE, MOST_PARTS = 4.0e6, 1.0e5, 0.05, 8, 4
SAID = {1: "yes", 0: "none", -1: "unknown, there is no plate around the center, or nothing in the layer"}
ALL_NEIGHBORS = np.ones((3, 3), dtype=int)


@dataclasses.dataclass
class Hole:
    """values: the eleven of the compute, by name; the map: areal (nx, ny) at the nodes x (nx,), y (ny,), None of an empty layer

    edge: mass per area at the edge of the hole; inside (nx, ny): what belongs to it, None if there is none
    """

    values: dict
    areal: Optional[np.ndarray] = None
    x: Optional[np.ndarray] = None
    y: Optional[np.ndarray] = None
    edge: float = 0.0
    inside: Optional[np.ndarray] = None


class Layer:
    """Particles near the plane: mass m (n,), s (n,) from the plane, y (n, 2) from the center."""

    def __init__(self, m, s, y, mirrored, natoms, thickness):
        self.mirrored = mirrored
        self.unit = 2.0 ** (59 - math.frexp(m.max())[1] - math.frexp(natoms + 1.0)[1])  # masses are added up as whole numbers
        least = math.sqrt(np.ptp(y[:, 0]) * np.ptp(y[:, 1]) / len(m))
        self.half = 0.5 * thickness if thickness else max(least, self._half(np.abs(s)))
        near = np.abs(s) <= self.half
        self.m, self.s, self.y = m[near], s[near], y[near]
        parts = np.cbrt(self.m / m[m > 0].min()) + 0.01
        self.parts = np.clip(parts.astype(int), 1, MOST_PARTS)  # along each edge, as large as the finest particle
        self.cells = int((self.parts.astype(np.int64) ** 3).sum())
        self.grain = 0.0  # how far parts are from each other
        self.farthest = np.abs(self.s).max(initial=0.0)

    @staticmethod
    def _half(s):
        """4 times the median of those that are that near, by repetition from above"""
        farthest = s.max()
        if farthest == 0.0:
            return 0.0
        with np.errstate(divide="ignore"):
            octave = OCTAVES + np.log2(s / farthest)
        bins = OCTAVES * PER_OCTAVE
        number = np.cumsum(np.bincount(np.clip(octave * PER_OCTAVE, 0, bins - 1).astype(int), minlength=bins))

        def quantile(q, last):
            return int(np.searchsorted(number, q * number[min(last, bins - 1)]))

        last = quantile(0.35, bins) + 3 * PER_OCTAVE
        while (following := quantile(0.5, last) + 2 * PER_OCTAVE) < last:
            last = following
        return farthest * 2.0 ** ((last + 1.0) / PER_OCTAVE - OCTAVES)

    def extent(self):
        """lowest and highest corner of the plate, strays left out; None of a line or nothing"""
        count, lo, hi = len(self.m), np.zeros(2), np.zeros(2)
        if not count or not np.all(np.ptp(self.y, axis=0) > 0.0):
            return None
        for k in range(2):
            low, high = self.y[:, k].min(), self.y[:, k].max()
            bins = np.minimum((NBINS * (self.y[:, k] - low) / (high - low)).astype(int), NBINS - 1)
            number, width = np.bincount(bins, minlength=NBINS), (high - low) / NBINS
            first, last = (int(np.searchsorted(np.cumsum(n), TAIL * count)) for n in (number, number[::-1]))
            lo[k], hi[k] = first * width + low, (NBINS - last) * width + low
            margin = MARGIN * (hi[k] - lo[k])
            lo[k], hi[k] = lo[k] - margin, hi[k] + margin
            if self.mirrored[k]:
                hi[k] = max(hi[k], -lo[k])
                lo[k] = -hi[k]
        return lo, hi

    def spacing(self, plate):
        """cube root of the volume per particle of the intact plate, from its mass per area and the width of its layers"""
        scale, variance = float(1 << 30), 0.0
        if self.farthest > 0.0 and (far := np.hypot(*self.y.T) >= plate.far * plate.h).any():
            s = self.s[far] / self.farthest
            mean, square = (np.rint(scale * v).astype(np.int64).sum() / scale / len(s) for v in (s, s * s))
            variance = self.farthest**2 * max(square - mean * mean, 0.0)
        density = plate.intact / (np.rint(self.unit * self.m).astype(np.int64).sum() / self.unit / self.cells)
        a = 1.0 / math.sqrt(density)
        for _ in range(50):
            a = np.cbrt(math.sqrt(12.0 * variance + a * a) / density)
        return float(a)


class Plate:
    """Map of the mass per area, areal (n0, n1), node (i, j) at h (first + (i, j)) from the center."""

    def __init__(self, layer, lo, hi, spacing):
        width = hi - lo
        self.h = max(spacing, math.sqrt(width[0] * width[1] / MAXNODES), *(width / MAXLINE))
        if self.h > spacing:
            warnings.warn(HVIWarning(f"a map with spacing {spacing:g} would be too large, it is {self.h:g}"), stacklevel=3)
        self.first = np.floor(lo / self.h).astype(int) - 3
        self.n = np.ceil(hi / self.h).astype(int) + 4 - self.first
        nodes = [first + np.arange(n) for first, n in zip(self.first, self.n)]
        self.distance = np.hypot(nodes[0][:, None], nodes[1])  # from the center, in spacings
        self.areal = self._spread(layer)
        self._find_intact()

    def _spread(self, layer):
        """each particle by a cubic B-spline, a larger one in parts that are as fine as the finest"""
        mass = np.zeros(self.n, dtype=np.int64)
        for sx in (-1, 1) if layer.mirrored[0] else (1,):
            for sy in (-1, 1) if layer.mirrored[1] else (1,):
                number = layer.parts**2
                c = np.arange(number.sum()) - np.repeat(np.cumsum(number) - number, number)
                parts = np.repeat(layer.parts, number)
                at = np.stack([c // parts, c % parts], axis=1) - 0.5 * (parts - 1)[:, None]
                u = (np.repeat(layer.y * (sx, sy), number, axis=0) + layer.grain * at) / self.h - self.first
                on = np.all((u >= 1.0) & (u < self.n - 2), axis=1)
                u, m = u[on], np.repeat(layer.unit * layer.m / number, number)[on]
                i = u.astype(int)
                f = u - i
                g = 1.0 - f
                w = (g * g * g / 6.0, 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), 2.0 / 3.0 - g * g * (1.0 - 0.5 * g), f * f * f / 6.0)
                for a in range(4):
                    for b in range(4):
                        np.add.at(mass, (i[:, 0] + a - 1, i[:, 1] + b - 1), (m * w[a][:, 0] * w[b][:, 1] + 0.5).astype(np.int64))
        return mass / (layer.unit * self.h * self.h)

    def _find_intact(self):
        """far: where the outer half of the mass begins; intact: mass per area there"""
        ring = np.bincount(self.distance.astype(int).ravel(), weights=self.areal.ravel(), minlength=self.n.sum())
        self.far, inner = len(ring), 0.0
        while inner < 0.5 * ring.sum() and self.far > 0:
            self.far -= 1
            inner += ring[self.far]
        far = self.distance >= self.far
        values = np.sort(self.areal[far & (self.areal > 0.0)])[::-1]  # first guess: half of the mass there has more
        self.intact = 0.0
        if not len(values):
            return
        self.intact = values[min(np.searchsorted(np.cumsum(values), 0.5 * values.sum()), len(values) - 1)]
        filled = far & (self.areal >= 0.5 * self.intact)
        filled[[0, -1]] = filled[:, [0, -1]] = False
        away = filled & (ndimage.minimum_filter(self.areal, 3) >= 0.5 * self.intact)
        narrow = 4 * away.sum() < filled.sum()  # nearly all edge
        values = np.sort(self.areal[filled if narrow else away])
        if len(values):
            self.intact = values[3 * len(values) // 4 if narrow else len(values) // 2]

    def _moves(self, marked):
        """moves of a chess king to the next marked node, (n0, n1)"""
        return ndimage.distance_transform_cdt(~marked, "chessboard") if marked.any() else np.full(self.n, self.n.sum())

    def find_hole(self, fill, mirrored):
        """1: a hole, which is then inside; 0: none; -1: there is no plate around the center"""
        self.enough, self.inside = fill * self.intact, None
        label, number = ndimage.label(self.areal >= self.enough, ALL_NEIGHBORS)
        far = (label > 0) & (self.distance >= self.far)
        mass = np.bincount(label[far], weights=self.areal[far], minlength=number + 1)
        if not mass.sum() > 0.0:
            return -1
        plate = (label > 0) & (mass >= PIECE * mass.sum())[label]
        self.areal[(label > 0) & ~plate] = 0.0  # a fragment must not shape the edge
        gap = self._moves(plate)
        middle, width = tuple(-self.first), 1
        if not all(0 <= m < n for m, n in zip(middle, label.shape)):
            return -1
        while True:
            label, number = ndimage.label(gap > width, ALL_NEIGHBORS)
            size = np.bincount(label.ravel(), minlength=number + 1)
            for border in (label[0], label[-1], label[:, 0], label[:, -1]):
                size[border] = -1
            size[0] = 0
            pick = label[middle]
            if gap[middle] <= 1 and not mirrored:
                pick = int(np.argmax(size))
            if size[pick] > 0:
                break
            if gap[middle] <= width:
                return -1 if gap[middle] > 1 else 0
            width += 1 + width // 4
        self.inside = (gap > 0) & (self._moves(label == pick) <= width + width // 2)
        return 1

    def samples(self):
        """(places (k, 2) from the center, areas (k,)) of small pieces of the hole"""
        coarse = min(max(int(512.0 / math.sqrt(self.inside.sum())), 1), FINE)
        corners = sum(self.inside[a:self.n[0] - 1 + a, b:self.n[1] - 1 + b].astype(int) for a in (0, 1) for b in (0, 1))
        i, j = np.nonzero(corners)
        parts = np.where(corners[i, j] == 4, coarse, FINE)
        cell = np.repeat(np.arange(len(i)), parts**2)
        m = parts[cell]
        k = np.arange(len(cell)) - np.repeat(np.cumsum(parts**2) - parts**2, parts**2)
        u, w, i, j = (k // m + 0.5) / m, (k % m + 0.5) / m, i[cell], j[cell]
        here = (1.0 - u) * ((1.0 - w) * self.areal[i, j] + w * self.areal[i, j + 1]) + u * ((1.0 - w) * self.areal[i + 1, j] + w * self.areal[i + 1, j + 1])
        in_hole = here < self.enough
        y = self.h * (self.first + np.stack([i + u, j + w], axis=1))
        return y[in_hole], (self.h * self.h / (m * m))[in_hole]

    def measure(self, sectors):
        """(diameter, smallest, largest, center (2,), area)"""
        y, area = self.samples()
        variance, total = 0.5 * self.h * self.h, np.cumsum(area)[-1]
        center = np.cumsum(area[:, None] * y, axis=0)[-1] / total  # in the order of the compute: sectors must not depend on round-off
        corrected = math.pi * variance + total
        diameter = 2.0 * math.sqrt(corrected / math.pi)
        sectors = min(max(2 * int(0.5 * math.pi * diameter / self.h), 8), sectors)
        angle = np.arctan2(y[:, 1] - center[1], y[:, 0] - center[0])
        k = np.minimum((sectors * (0.5 + 0.5 * angle / math.pi)).astype(int), sectors - 1)
        squares = np.bincount(k, weights=area, minlength=sectors) * sectors / math.pi
        r = np.sqrt(0.5 * squares + 0.25 * (np.roll(squares, 1) + np.roll(squares, -1)) + variance)
        across = r[:sectors // 2] + r[sectors // 2:]
        return diameter, across.min(), across.max(), center, corrected


def measure(source, axis, center, plane, *, thickness=None, dr=None, fill=0.5, reference=None, sectors=36, types=None, distance=None):
    """The Hole in the plate of the particles of some types, or of all, as it is seen along the axis; with a distance, of the largest piece of these.

    center: (2,) coordinates across the axis in alphabetical order, at best in the middle of the hole
    plane: coordinate of the plate's middle plane along the axis
    distance: particles closer than this hang together, see fragments.largest()
    other keywords: those of the compute
    """
    frame, along = as_frame(source), axis_number(axis)
    across = [k for k in range(3) if k != along]
    center, names = np.array(center, dtype=float), ["xyz"[k] for k in across]
    if not 0.0 < fill < 1.0 or not 8 <= sectors <= 3600 or sectors % 2:
        raise HVIError(f"fill must be > 0 and < 1, and sectors even, from 8 to 3600, not {fill:g} and {sectors}")
    cut, natoms = {p.axis: p.at for p in frame.planes if p.axis != along}, len(frame)
    share = 0.5 ** len(cut)
    if types is not None:
        frame = frame.select(frame.of_types(types))
    if distance is not None:
        frame = fragments.largest(frame, distance)
    size = np.abs(frame.x).max(initial=0.0)
    mirrored = [k in cut and abs(cut[k] - c) <= 1e-9 * size for k, c in zip(across, center)]
    there = [k for k, folded in zip(across, mirrored) if folded]
    frame = frame.without_planes(there).whole()  # planes elsewhere
    values = dict.fromkeys(["diameter", "smallest", "largest", *(f"center_{name}" for name in names), "area", "share", "layer", "reference", "spacing"], 0.0)
    values["found"] = -1
    if not len(frame):
        return Hole(values)
    layer = Layer(frame.m, frame.x[:, along] - plane, frame.x[:, across] - center, mirrored, natoms, thickness)
    extent = layer.extent()
    if extent is None:
        return Hole(values)
    lo, hi = extent
    area = np.prod(hi - lo) * 0.5 ** len(there) / layer.cells
    layer.grain = max(float(np.cbrt(2.0 * min(layer.half, layer.farthest) * area)), math.sqrt(area))
    step = layer.grain = layer.spacing(Plate(layer, lo, hi, layer.grain))
    if dr and dr < FINEST * step:
        warnings.warn(HVIWarning(f"dr {dr:g} is too small for particles {step:g} apart, using {FINEST * step:g}"), stacklevel=2)
    plate = Plate(layer, lo, hi, max(dr, FINEST * step) if dr else step)
    plate.intact = reference or plate.intact
    values.update(share=share, layer=2.0 * layer.half, reference=float(plate.intact), spacing=plate.h, found=plate.find_hole(fill, any(mirrored)))
    nodes = [c + plate.h * (first + np.arange(n)) for c, first, n in zip(center, plate.first, plate.n)]
    if values["found"] == 1:
        diameter, smallest, largest, at, area = plate.measure(sectors)
        values.update({"diameter": diameter, "smallest": float(smallest), "largest": float(largest), "area": float(area),
                       **{f"center_{name}": float(c + a) for name, c, a in zip(names, center, at)}})
    return Hole(values, plate.areal, *nodes, plate.enough, plate.inside)
