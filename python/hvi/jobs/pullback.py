# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Plate impact with spall (examples/spall/in.spall): what the speed of the target's free surface says of its strength.

The surface moves at a plateau behind the shock. It slows down by du as the releases of both free faces meet and pull the target apart, and
speeds up again (the pull-back signal) if the target fails there. With the density rho and the bulk speed of sound c of the target at rest

    spall strength = rho c du/2,    strain rate = -(du/dt)/(2 c)

in the linear approximation, without a correction for the elastic front (T. Antoun et al., Spall Fracture, Springer, New York 2003).
"""

import dataclasses
import math

import numpy as np

from ..errors import HVIError, reading

FALLEN, RISEN = 0.02, 0.1  # pull-back: u has fallen by this part of its top, and risen again by this part of the fall
FROM, TO = 0.1, 0.5  # the part of the fall whose slope is the strain rate: voids bend the rest
NOISE = 1e-4  # of the speed of the flyer: what falls by less is no signal
ENOUGH = 32  # particles through the flyer: with fewer the kernel blunts the pull-back

SURFACE = ("t", "u", "tension", "push", "failed")  # us, m/s, Pa, Pa, number
FAILED = ("t", "failed", "depth")  # us, number, sum in mm
PROFILE = ("id", "type", "x0", "x", "u", "p", "sxx", "vm", "eps", "damage", "spalled", "voids", "void_damage")  # SI units
NEEDED = ("v0_m_s", "flyer_mm", "target_mm", "n", "target_density_kg_m3", "target_sound_speed_m_s", "record_us")  # of result.yaml


@dataclasses.dataclass
class PullBack:
    """of a record; top and low: rows of it"""

    top: int
    low: int
    fall: float  # m/s
    slope: float  # -du/dt, m/s per us
    seen: bool  # has u risen again?


def find(t, u, ringing):
    """the pull-back in u (m/s) over t (us)

    What rings behind the shock is passed over: the top is looked for from the time ringing after u has come to half of its maximum. top is the last
    row that is not below any before it, low the least u since, as soon as u has fallen by FALLEN and risen by RISEN. In a record that
    ends before, slope is no number, and fall is that from the top to the least u so far. None if the record ends while it rings.
    """
    half, start, top, low = 0.5 * u.max(), 0.0, None, None
    for k, now in enumerate(u):
        if top is None and now < half:
            start = t[k]
        if t[k] > start + ringing and (top is None or now >= u[top]):
            top = low = k
        if top is None:
            continue
        if now < u[low]:
            low = k
        if u[top] - u[low] > FALLEN * u[top] and now - u[low] > RISEN * (u[top] - u[low]):
            fall = u[top] - u[low]
            end = top + int(np.flatnonzero(u[top:] < u[top] - TO * fall)[0])
            begin = 1 + int(np.flatnonzero(u[:end] >= u[top] - FROM * fall)[-1])
            first, last = (np.interp(u[top] - part * fall, u[[k, k - 1]], t[[k, k - 1]]) for part, k in ((FROM, begin), (TO, end)))
            return PullBack(top, low, fall, (TO - FROM) * fall / (last - first), True)
    return None if top is None else PullBack(top, low, u[top] - u[low], math.nan, False)


def columns(path, names):
    """{name: column} of a file of numbers below lines that begin with #"""
    with reading(path):
        text = path.read_text()
    if text and not text.endswith("\n"):
        raise HVIError(f"{path} ends in the middle of a line: it is cut off")
    rows = []
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("#") or not line.strip():
            continue
        try:
            row = [float(word) for word in line.split()]
        except ValueError:
            raise HVIError(f"{path}, line {number}: '{line}' is not numbers") from None
        if len(row) != len(names):
            raise HVIError(f"{path}, line {number}: {len(row)} numbers in place of {len(names)} ({' '.join(names)})")
        if not np.isfinite(row).all():
            raise HVIError(f"{path}, line {number}: a number is not finite")
        rows.append(row)
    if not rows:
        raise HVIError(f"{path} has no rows")
    return dict(zip(names, np.array(rows).T))


def record(path, names, until):
    """columns whose first is the time, from 0 to the end of the run, us"""
    found = columns(path, names)
    t = found["t"]
    if len(t) < 2:
        raise HVIError(f"{path} has one row: there is no record to measure")
    if (np.diff(t) <= 0).any():
        row = int(np.flatnonzero(np.diff(t) <= 0)[0])
        raise HVIError(f"{path}: the time {t[row + 1]:g} us comes after {t[row]:g} us")
    if t[-1] + 1.5 * (t[-1] - t[-2]) < until * (1 - 1e-5):  # the last row may be one of its steps before the end
        raise HVIError(f"{path} ends at {t[-1]:g} us, the run at {until:g} us: it is cut off, or of another run")
    return found


def measured(folder, result):
    """{key: value} of surface.dat, failed.dat and profile.dat of a folder, and of what in.spall has put into result.yaml"""
    wrong = [key for key in NEEDED if not isinstance(result.get(key), (int, float))]
    if wrong:
        raise HVIError(f"{folder / 'result.yaml'}: no number {', '.join(wrong)}, which in.spall writes")
    _, hf, ht, n, rho, c, until = (result[key] for key in NEEDED)
    surface = record(folder / "surface.dat", SURFACE, until)
    failing = record(folder / "failed.dat", FAILED, until)
    profile = columns(folder / "profile.dat", PROFILE)
    t, u = surface["t"], surface["u"]
    found = find(t, u, 0.5e3 * hf / c)  # half of the time that a wave takes through the flyer
    seen = found is not None and found.seen and found.fall > NOISE * abs(result["v0_m_s"])
    du = found.fall if seen else math.nan
    first = int(np.argmax(failing["failed"] > 0))
    count = failing["failed"][first]
    plane = failing["depth"][first] / count if count else math.nan  # mean of those that fail first
    depth = ht - 1e3 * profile["x0"][((profile["damage"] >= 1) | (profile["spalled"] > 0)) & (profile["type"] == 2)]
    said = "ok"
    if not seen:
        said = "no pull-back, so no spall or too early an end (tstop)"
    elif not count:
        said = "a pull-back, but nothing has failed"
    return {
        "peak_GPa": digits(1e-9 * surface["push"].max()),
        "largest_tension_GPa": digits(1e-9 * surface["tension"].max()),
        "top_m_s": digits(u[found.top] if found else math.nan),
        "pull_back_m_s": digits(du),
        "spall_strength_GPa": digits(0.5e-9 * rho * c * du),
        "strain_rate_per_s": round(1e6 * found.slope / (2 * c)) if seen else math.nan,
        "spall_plane_mm": round(float(plane), 4),
        "first_failure_us": float(failing["t"][first]) if count else math.nan,
        "failed_from_mm": round(float(depth.min()), 4) if depth.size else math.nan,
        "failed_to_mm": round(float(depth.max()), 4) if depth.size else math.nan,
        "record": said,
        "plate": "ok" if n >= ENOUGH else f"fewer than {ENOUGH} particles through the flyer, so the pull-back is blunted",
    }


def digits(value):
    return float(f"{value:.6g}")
