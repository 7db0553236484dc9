# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Where everything of a case is, in meters and microseconds: walls, what the cloud can strike, the box, the end.

The same as examples/whipple-shield/in.whipple takes, where a case does not say otherwise; see doc/src/Howto_shield.rst.
"""

import dataclasses
import math


OPEN = 0.75  # a cloud opens by 37 degrees to all sides of the normal and of the flight,
WIDE = 6  # from a place that many radii of the projectile wide to all sides
SOUND = 5000.0  # m/s
MARGIN = 0.005  # m, of the box beside walls
BACK = 20.0  # mm in front of wall 1 at least


@dataclasses.dataclass(frozen=True)
class WallGeometry:
    """A wall, in m: faces along z, spacing of particles in the plane, layers through it dz apart, its radius, x of its middle and of where it is struck"""

    front: float
    rear: float
    thickness: float
    spacing: float
    layers: int
    dz: float
    radius: float
    middle: float
    struck: float


@dataclasses.dataclass(frozen=True)
class Geometry:
    """Of a case at one spacing: a, R, spacing and radius of the projectile; box: xlo, xhi, ylo, yhi, zlo; near: pieces are closer; widest spacing (all m).

    Times in us: tstop, the end at the latest; arrival of the projectile itself at the last wall, its passage of itself, crossing of that wall by sound
    """

    a: float
    R: float
    walls: tuple
    tstop_us: float
    arrival_us: float
    passage_us: float
    crossing_us: float
    box: tuple
    quarter: bool
    near: float
    widest: float


def of(case, which):
    """The Geometry of a case at its spacing number which"""
    a, R, v0 = 1e-3 * case.spacings_mm[which], 0.5e-3 * case.diameter_mm, 1e3 * case.speed_km_s
    angle = math.radians(case.angle_deg)
    cosine, tangent = math.cos(angle), math.tan(angle)
    quarter = {"auto": not case.angle_deg, "yes": True, "no": False}[str(case.settings.get("quarter", "auto"))]
    walls, xlo, xhi, W, rear1 = [], 0.0, 0.0, 0.0, None
    for k, ((front, rear), wall) in enumerate(zip(case.faces(), case.walls)):
        front, th = 1e-3 * front, 1e-3 * wall.thickness_mm
        dx = 1e-3 * (wall.spacings_mm or case.spacings_mm)[which]
        layers = int(case.settings["layers"][k]) if "layers" in case.settings else math.ceil(th / dx - 0.01)
        opens = max(3 * th, WIDE * R) if k == 0 else OPEN * (front - rear1) + WIDE * R
        rear1 = front + th if k == 0 else rear1
        opens = opens / cosine + 0.5 * front * tangent
        radius = 1e-3 * wall.radius_mm if wall.radius_mm else opens
        middle = (0.5 * front + R) * tangent
        walls.append(WallGeometry(front, front + th, th, dx, layers, th / layers, radius, middle, (front + 0.5 * th + R) * tangent))
        opens = max(radius, opens)
        W, xlo, xhi = max(W, opens), min(xlo, middle - opens), max(xhi, middle + opens)
    last = walls[-1]
    arrival, passage, crossing = 1e6 * (last.front + R) / (v0 * cosine), 2e6 * R / (v0 * cosine), 1e6 * last.thickness / SOUND
    tstop = float(case.settings.get("tstop", 0)) or float(f"{3 * arrival + 4 * passage + 10 * crossing:.4g}")
    back = float(case.settings.get("back", 0)) or round(max(500 * last.front, BACK), 1)
    widest = max([a, *(max(w.spacing, w.dz) for w in walls)])
    box = (0.0 if quarter else xlo - MARGIN, xhi + MARGIN, 0.0 if quarter else -(W + MARGIN), W + MARGIN, -2 * R - 1e-3 * back)
    return Geometry(a, R, tuple(walls), tstop, arrival, passage, crossing, box, quarter, 1.5 * widest, widest)
