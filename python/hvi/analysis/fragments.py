# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Fragments: which particles hang together, and a table of the pieces, as compute hvi/fragment makes it."""

import dataclasses

import numpy as np

from ..errors import HVIError, needed
from ..io import bonds as bond_sources
from ..io import mirror as mirrors
from ..io.frame import as_frame
from .cloud import beyond

# a row: the columns of compute hvi/fragment, in units of the dump
ROW = np.dtype([("id", np.int64), ("count", np.int64), ("mass", float), ("x", float), ("y", float), ("z", float),
                ("vx", float), ("vy", float), ("vz", float), ("ke", float), ("size", float)])
COLUMN_QUANTITIES = {"mass": "mass", "x": "distance", "y": "distance", "z": "distance", "vx": "velocity",
                     "vy": "velocity", "vz": "velocity", "ke": "energy", "size": "distance"}

FAILED = ("damage", "spalled")  # columns of compute hvi/atom


@dataclasses.dataclass
class Fragments:
    """What find() returns.

    frame: the Frame of the particles that count, n of them
    label: fragment ID of each of them, (n,) of int64
    table: one row per fragment, dtype ROW, largest mass first, equal masses in order of ID; pandas.DataFrame(table)
    unit: mass of a particle if all have the same, else None
    own: rows that are not merely images of others behind mirror planes, (fragments,) of bool
    """

    frame: object
    label: np.ndarray
    table: np.ndarray
    unit: float
    own: np.ndarray

    @property
    def summary(self):
        """The vector of compute hvi/fragment and the mass: a dict; all 0 if there are no particles."""
        t, n = self.table, len(self.label)
        mass = t["mass"].sum()
        singles = t["mass"][t["count"] == 1].sum()
        return {"fragments": len(t), "particles": n, "fragmentation": len(t) / n if n else 0.0,
                "largest_fragment_mass_fraction": t["mass"][0] / mass if n else 0.0,
                "single_particles_mass": singles, "single_particles_mass_fraction": singles / mass if n else 0.0,
                "mass": mass}

    @property
    def row(self):
        """Row in the table of each particle's fragment, (n,)."""
        order = np.argsort(self.table["id"])
        return order[np.searchsorted(self.table["id"], self.label, sorter=order)]

    def images(self, rows=slice(None)):
        """How many of the rows there are for each that is not merely the image of another; 1 without mirror planes."""
        own = self.own[rows]
        return len(own) / own.sum() if own.any() else 1.0

    def dataframe(self):
        """The table as a pandas.DataFrame, indexed by fragment ID."""
        pandas = needed("pandas", "dataframe() needs")
        return pandas.DataFrame(self.table).set_index("id")


def find(source, column=None, bonds=None, distance=None, axis=None, plane=None, where=None, failed=None, sizes=None, of_whole=None):
    """Fragments of a frame, by one of three rules; only particles that count connect others.

    source: a Frame, or a Universe or AtomGroup of hvi.open()
    column: name of a column with fragment IDs, as compute hvi/fragment/atom writes it (0: does not count)
    bonds: see hvi.io.bonds.source(); only those of the frame's time step count; default for a Universe: its bonds
    distance: particles closer than this hang together, also across periodic boundaries
    axis, plane: only particles beyond the plane (coordinate > plane), the debris cloud
    where: mask of particles that count, (n,) of bool, instead of axis and plane
    of_whole: the same of frame.whole(), images included
    failed: with distance: particles that stay alone, as with damage yes, so that fragments are the sound pieces: a mask, (n,) of bool, or
        names of columns, see has_failed(); else fragments are what has come apart
    sizes: with distance, of a frame without mirror planes: lengths of the particles, (n,); the distance is in units of the mean of two, as
        distance R h of the compute with smoothing lengths

    With a column, pieces that hang together only through particles that do not count are still one fragment: the column
    does not tell.

    Between mirror planes all are fragments of the whole: what touches a plane is one piece with its image, all else is there
    as often as there are images. A column and bonds know nothing of images, so give the distance too: a particle that is
    closer to its image than that hangs together with it. For a column that was found with damage yes say who has failed, too.
    """
    frame = as_frame(source)
    if sum(choice is not None for choice in (where, of_whole, axis if plane is None else plane)) > 1:
        raise HVIError("give a mask or an axis and a plane, not both")
    if sizes is not None and (distance is None or frame.planes or where is not None or of_whole is not None or axis is not None or plane is not None):
        raise HVIError("sizes go with a distance, and with all particles of a frame without mirror planes: take frame.whole() or select() first")
    if column is None and bonds is None and distance is None:
        bonds = getattr(getattr(getattr(source, "universe", None), "trajectory", None), "bonds", None)
    _check_rule(column, bonds, distance, frame.planes)
    if failed is not None and distance is None:
        raise HVIError("sound pieces are found by distance: by bonds or by a column there are no failed particles")
    if failed is not None and len(failed) and isinstance(failed[0], str):
        failed = has_failed(frame, failed)
    failed = np.zeros(len(frame), dtype=bool) if failed is None else failed
    if where is not None:
        frame, failed = frame.select(where), failed[where]
    if column is not None:
        counts = frame[column] != 0
        if of_whole is not None:
            of_whole = of_whole[np.tile(counts, 1 << len(frame.planes))]
        frame, failed = frame.select(counts), failed[counts]
    whole = cloud = frame.whole()
    keep = slice(None)
    if of_whole is not None:
        keep = of_whole
        cloud = whole.select(keep)
    elif axis is not None or plane is not None:
        keep = beyond(whole, axis, plane)
        cloud = whole.select(keep)
    if column is not None:
        label = _whole_ids(frame, column)
        if frame.planes:
            label = components(whole.ids, bond_sources.rows_of(_image_pairs(frame, _chains(frame.ids, label), distance, failed), whole.ids))
        label = label[keep]
    elif bonds is not None:
        pairs = bond_sources.source(bonds).at(frame.step)
        if frame.planes:
            pairs = _image_pairs(frame, frame.ids[bond_sources.rows_of(pairs, frame.ids)], distance, failed)
        label = components(cloud.ids, bond_sources.rows_of(pairs, cloud.ids))
    else:
        pairs = _close_pairs(cloud, distance, sizes)
        alone = np.tile(failed, 1 << len(frame.planes))[keep]
        label = components(cloud.ids, pairs[~alone[pairs].any(axis=1)])
    mass, table = cloud.m, tabulate(cloud, label)
    same = len(mass) and mass.min() == mass.max()
    own = table["id"] <= frame.id_step if frame.planes else np.ones(len(table), dtype=bool)
    return Fragments(cloud, label, table, float(mass[0]) if same else None, own)


def largest(source, distance):
    """The Frame of only the heaviest piece that hangs together by a distance; of a half or quarter model of the part that was computed.

    Images need no look: two particles of the part are closer to each other than either is to the other's image.
    """
    frame = as_frame(source)
    _, piece = np.unique(components(frame.ids, _close_pairs(frame, distance)), return_inverse=True)
    return frame.select(piece == np.argmax(np.bincount(piece, frame.m))) if len(frame) else frame


def has_failed(frame, columns=FAILED):
    """Mask of the particles that have failed: 1 or more in one of the columns, (n,) of bool."""
    return np.any([np.asarray(frame[name]) >= 1.0 for name in columns], axis=0)


def _check_rule(column, bonds, distance, planes):
    given = sum(rule is not None for rule in (column, bonds, distance))
    if planes and given == 1 and distance is None:
        raise HVIError(f"{'a column' if bonds is None else 'bonds'} of a {mirrors.text(planes)} does not tell what hangs together "
                       "with its image: give the distance, too")
    if given != 1 and not (planes and given == 2 and distance is not None):
        raise HVIError("fragments are found by a column, by bonds or by distance: give one of them")


def _chains(ids, label):
    """Pairs of IDs that connect all particles of a label, (k, 2)."""
    order = np.argsort(label, kind="stable")
    ids, label = ids[order], label[order]
    same = label[1:] == label[:-1]
    return np.column_stack([ids[:-1][same], ids[1:][same]])


def _image_pairs(frame, pairs, distance, failed):
    """Pairs of IDs in frame.whole(): those given, (k, 2), in all images, and of sound particles with images closer than distance.

    If any two particles on either side of a plane are closer than that, one of the two is that close to its own image.
    """
    if not (distance > 0.0 and np.isfinite(distance)):
        raise HVIError(f"distance must be > 0, not {distance}")
    images, step = [bits for bits, _ in mirrors.images(frame.planes)], frame.id_step
    found = [pairs + bits * step for bits in images]
    for b, plane in enumerate(frame.planes):
        ids = frame.ids[~failed & (2.0 * plane.depth(frame.x) < distance)]
        found += [np.column_stack([ids + bits * step, ids + (bits | 1 << b) * step]) for bits in images if not bits >> b & 1]
    return np.concatenate(found)


def both(source, failed=None, **rule):
    """Fragments by a rule of find(), and their summary; if failed particles are known, of the sound pieces, with two numbers of what has come
    apart in the summary: pieces_apart, largest_apart_mass_fraction."""
    found = find(source, failed=failed, **rule)
    if failed is None or rule.get("column") is not None or rule.get("bonds") is not None:
        return found, found.summary
    apart = find(source, **rule).summary
    return found, {**found.summary, "pieces_apart": apart["fragments"], "largest_apart_mass_fraction": apart["largest_fragment_mass_fraction"]}


def components(ids, pairs):
    """Lowest ID of the component of each particle.

    ids: (n,), rising; pairs: rows of particles that hang together, (k, 2). Returns (n,) of int64.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    n = len(ids)
    if n == 0:
        return np.zeros(0, dtype=np.int64)
    graph = coo_matrix((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    number, component = connected_components(graph, directed=False)
    lowest = np.empty(number, dtype=np.int64)
    lowest[component[::-1]] = ids[::-1]  # the last one written is the lowest
    return lowest[component]


def _close_pairs(frame, distance, sizes=None):
    from scipy.spatial import cKDTree

    if not (distance > 0.0 and np.isfinite(distance)):
        raise HVIError(f"distance must be > 0, not {distance}")
    if not len(frame):
        return np.zeros((0, 2), dtype=np.int64)
    reach = distance if sizes is None else distance * np.max(sizes, initial=0.0)
    x, owner = frame.box.images(frame.box.wrap(frame.x), reach) if frame.box else (frame.x, np.arange(len(frame)))
    pairs = cKDTree(x).query_pairs(reach, output_type="ndarray")
    limit = distance if sizes is None else 0.5 * distance * sizes[owner[pairs]].sum(axis=1)
    near = np.sum((x[pairs[:, 0]] - x[pairs[:, 1]]) ** 2, axis=1) < limit**2
    return owner[pairs[near]]


def _whole_ids(frame, column):
    label = frame[column].astype(np.int64)
    if not np.array_equal(label, frame[column]):
        raise HVIError(f"{frame.where}: column {column} has no fragment IDs: it is not whole numbers")
    return label


def tabulate(frame, label):
    """Table of the fragments, dtype ROW.

    frame: n particles; label: fragment of each, (n,)
    size = 2 sqrt(5/3) R_g: the diameter of a uniform sphere with the same radius of gyration; ke: of all its particles.
    """
    ids, first, place, count = np.unique(label, return_index=True, return_inverse=True, return_counts=True)
    m, x, v = frame.m, frame.x, frame.v

    def total(values):
        return np.bincount(place, values, minlength=len(ids))

    table = np.zeros(len(ids), dtype=ROW)
    table["id"], table["count"], table["mass"] = ids, count, total(m)
    table["ke"] = 0.5 * frame.mvv2e * total(m * np.einsum("ij,ij->i", v, v))
    spread = np.zeros(len(m))
    for k, name in enumerate("xyz"):
        start = x[first, k]  # counted from one of its particles: no difference of large numbers
        shift = x[:, k] - start[place]
        center = total(m * shift) / table["mass"]
        table[name] = start + center
        table["v" + name] = total(m * v[:, k]) / table["mass"]
        spread += (shift - center[place]) ** 2
    table["size"] = 2.0 * np.sqrt(5.0 / 3.0 * total(m * spread) / table["mass"])
    return table[np.lexsort((table["id"], -table["mass"]))]
