# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The debris cloud: all particles beyond a plane, measured as compute hvi/cloud does (its page has the definitions)."""

import numpy as np

from ..errors import HVIError
from ..io.frame import as_frame, axis_number, whole

TIE = 1e-9  # distances that differ by less are equal
TIE_MASS = 1e-12  # shares of the mass likewise

# the vector of compute hvi/cloud: (name, quantity)
MEASURES = (("length", "distance"), ("diameter", "distance"), ("ratio", None), ("front", "distance"),
            ("rear", "distance"), ("front_velocity", "velocity"), ("rear_velocity", "velocity"),
            ("expansion_velocity", "velocity"), ("mass", "mass"), ("momentum", "momentum"),
            ("kinetic_energy", "energy"), ("particles", None))
# a row of series(); front_displacement_velocity: of the front since the frame before
SERIES = (("frame", None), ("step", None), ("time", "time"), *MEASURES, ("front_displacement_velocity", "velocity"))
_WHOLE = ("frame", "step", "particles")


def beyond(source, axis, plane):
    """Mask of the particles with coordinate > plane along axis "x", "y" or "z", (n,)."""
    if axis is None or plane is None:
        raise HVIError("the cloud needs both an axis and a plane")
    if not np.isfinite(plane):
        raise HVIError(f"the plane must be a number, not {plane}")
    return as_frame(source).x[:, axis_number(axis)] > plane


def measure(source, axis, plane, quantile=0.99):
    """The twelve values of compute hvi/cloud, a dict in its order; all 0 if no particle is beyond the plane.

    Of the whole cloud: between mirror planes mass, momentum, energy and number are those of all images together.

    source: a Frame, or a Universe or AtomGroup of hvi.open(); axis: "x", "y", "z"; plane: distance units
    All values are in the units of the dump: lengths, velocities, mass, momentum, kinetic energy; ratios have none.
    quantile: share of the mass inside an edge, > 0.5 and <= 1
    """
    if not 0.5 < quantile <= 1.0:
        raise HVIError(f"the quantile must be > 0.5 and <= 1, not {quantile}")
    frame = whole(source)
    result = dict.fromkeys((name for name, _ in MEASURES), 0.0)
    result["particles"] = 0
    frame = frame.select(beyond(frame, axis, plane))
    if not len(frame):
        return result
    along = axis_number(axis)
    across = [(along + 1) % 3, (along + 2) % 3]
    m, x, v = frame.m, frame.x, frame.v
    mass = m.sum()
    s, vs = x[:, along], v[:, along]
    y = x[:, across] - m @ x[:, across] / mass
    vy = v[:, across] - m @ v[:, across] / mass
    r = np.hypot(y[:, 0], y[:, 1])
    vr = np.divide(np.einsum("ij,ij->i", y, vy), r, out=np.zeros_like(r), where=r > 0.0)

    front, rear, radius = edge(s, m, quantile), -edge(-s, m, quantile), edge(r, m, quantile)
    length = front - rear

    def mean(values, where):
        return float(m[where] @ values[where] / m[where].sum())

    result.update(
        length=length, diameter=2.0 * radius, ratio=length / radius if radius > 0.0 else 0.0, front=front, rear=rear,
        front_velocity=mean(vs, s >= front - TIE * length), rear_velocity=mean(vs, s <= rear + TIE * length),
        expansion_velocity=mean(vr, r >= (1.0 - TIE) * radius), mass=float(mass), momentum=float(m @ vs),
        kinetic_energy=float(0.5 * frame.mvv2e * (m @ np.einsum("ij,ij->i", v, v))), particles=len(m))
    return result


def edge(values, m, quantile):
    """Smallest of the values (n,) up to which, inclusive, the share quantile of the mass lies.

    m: masses (n,). Mass is counted in whole units of 2^-61 of all of it, as compute hvi/cloud does, so that the order of
    the particles does not matter.
    """
    unit = 62 - np.frexp(m.sum())[1]  # frexp: one more than C's ilogb
    order = np.argsort(values, kind="stable")
    weight = np.cumsum(np.rint(np.ldexp(m[order], unit)).astype(np.int64))
    wanted = round((1.0 - TIE_MASS) * quantile * float(weight[-1]))
    return float(values[order[np.searchsorted(weight, wanted)]])


def series(frames, axis, plane, quantile=0.99):
    """Rows {name: value} with the names of SERIES, one for each of the frames (any iterable), read one after another.

    front_displacement_velocity is the velocity of the front as it is read from pictures and as Watson & Steinhauser
    (Materials 10, 2017, 379) measure it: its displacement since the frame before divided by the time between them. It
    is NaN where there is no frame before with a cloud, or no time.
    """
    before = None
    for frame in frames:
        row = {"frame": frame.number, "step": frame.step, "time": np.nan if frame.time is None else frame.time,
               **measure(frame, axis, plane, quantile), "front_displacement_velocity": np.nan}
        if before and before["particles"] and row["particles"] and row["time"] > before["time"]:
            row["front_displacement_velocity"] = (row["front"] - before["front"]) / (row["time"] - before["time"])
        before = row
        yield row


def table(rows):
    """Rows of series() as a structured array."""
    dtype = [(name, np.int64 if name in _WHOLE else float) for name, _ in SERIES]
    return np.array([tuple(row[name] for name, _ in SERIES) for row in rows], dtype=dtype)
