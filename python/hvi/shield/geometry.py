# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Where everything of a case is, in meters and microseconds: walls, what the cloud can strike, the box, the end; see doc/src/Howto_shield.rst."""

import dataclasses
import math

OPEN = 0.75  # a cloud opens by 37 degrees to all sides of the normal and of the flight,
WIDE = 6  # from a place that many radii of the projectile wide to all sides
SOUND = 5.0  # km/s
MARGIN = 0.005  # m, of the box beside walls
BACK = 20.0  # mm in front of wall 1 at least


@dataclasses.dataclass(frozen=True)
class WallGeometry:
    """A wall, in m: faces along z, spacing of particles in the plane, layers through it dz apart, its radius, x of its middle and of where it is struck

    core: half the width in y of the rectangle in its middle that has such particles, beyond they are twice as far apart in all directions; 0: all of it has
    core_lo, core_hi: its ends in x
    """

    front: float
    rear: float
    thickness: float
    spacing: float
    layers: int
    dz: float
    radius: float
    middle: float
    struck: float
    core: float = 0.0
    core_lo: float = 0.0
    core_hi: float = 0.0

    @property
    def outer(self):
        """this wall as its outer part is"""
        return dataclasses.replace(self, spacing=2 * self.spacing, layers=self.layers // 2, dz=2 * self.dz)

    @property
    def particles(self):
        """about, of the whole wall"""
        whole = math.pi * self.radius**2
        fine = 2 * self.core * (self.core_hi - self.core_lo) if self.core else whole
        return (fine * self.layers + (whole - fine) * self.layers / 8) / self.spacing**2


@dataclasses.dataclass(frozen=True)
class Geometry:
    """Of a case at one spacing: a, R, spacing and radius of the projectile; box: xlo, xhi, ylo, yhi, zlo; widest spacing (all m).

    Times in us: tstop, the end of what fails; enough, what tstop is if the case does not say it; arrival of the projectile itself at the last wall, its passage of itself, crossing of that wall by sound
    """

    a: float
    R: float
    walls: tuple
    tstop_us: float
    enough_us: float
    arrival_us: float
    passage_us: float
    crossing_us: float
    box: tuple
    quarter: bool
    widest: float


def layers(thickness, dx):
    """of particles no more than dx apart"""
    return math.ceil(thickness / dx - 0.01)


def layers_of(case, k, which):
    """of wall k, from 1 on, at the case's spacing number which"""
    if "layers" in case.settings:
        return case.settings["layers"][k - 1]
    wall = case.walls[k - 1]
    dx = (wall.spacings_mm or case.spacings_mm)[which]
    return 2 * layers(wall.thickness_mm, 2 * dx) if is_graded(wall) else layers(wall.thickness_mm, dx)


def is_graded(wall):
    """has it fine particles in its middle alone?"""
    return wall.method == "sph" and wall.core_mm is not None


def core_of(wall, spacing, radius, middle, struck):
    """WallGeometry's core, core_lo and core_hi: whole cells of the outer part, about where the normal and the flight strike; zeros if two cells would not be left around it"""
    if not is_graded(wall):
        return 0.0, 0.0, 0.0
    cell, width = 2 * spacing, 1e-3 * wall.core_mm
    half, low, high = (cell * math.ceil(x / cell - 1e-6) for x in (width, width - min(0.0, struck), width + max(0.0, struck)))
    corner = math.hypot(half, max(high - middle, low + middle))
    return (half, -low, high) if corner < radius - 2 * cell else (0.0, 0.0, 0.0)


def reaches(case):
    """[radius of wall k that can be struck, mm, ...]"""
    faces, R, angle = case.faces(), case.projectile.radius_mm, math.radians(case.angle_deg)
    ways = (max(3 * (rear - front), WIDE * R) if k == 0 else OPEN * (front - faces[0][1]) + WIDE * R for k, (front, rear) in enumerate(faces))
    return [way / math.cos(angle) + 0.5 * front * math.tan(angle) for way, (front, _) in zip(ways, faces)]


def least_radius(case, rear):
    """of a wall, mm, that the projectile does not strike at its edge"""
    angle = math.radians(case.angle_deg)
    return 0.5 * rear * math.tan(angle) + 1.5 * case.projectile.radius_mm / math.cos(angle)


def least_time(case):
    """us, before which nothing can have struck the last wall and crossed it"""
    front, rear = case.faces()[-1]
    return (front + 3 * case.projectile.radius_mm) / (case.speed_km_s * math.cos(math.radians(case.angle_deg))) + (rear - front) / SOUND


def may_be_quarter(case):
    return not case.angle_deg and case.projectile.symmetric


def is_quarter(case):
    return case.setting("quarter") != "no" and may_be_quarter(case)


def of(case, which):
    """The Geometry of a case at its spacing number which"""
    a, R, v0 = 1e-3 * case.spacings_mm[which], 1e-3 * case.projectile.radius_mm, 1e3 * case.speed_km_s
    angle, quarter = math.radians(case.angle_deg), is_quarter(case)
    cosine, tangent = math.cos(angle), math.tan(angle)
    walls, xlo, xhi, W = [], 0.0, 0.0, 0.0
    for k, ((front, _), wall, reach) in enumerate(zip(case.faces(), case.walls, reaches(case)), 1):
        front, th, n = 1e-3 * front, 1e-3 * wall.thickness_mm, layers_of(case, k, which)
        radius = 1e-3 * (wall.radius_mm or reach)
        middle = (0.5 * front + R) * tangent
        spacing = 1e-3 * (wall.spacings_mm or case.spacings_mm)[which]
        struck = (front + 0.5 * th + R) * tangent
        walls.append(WallGeometry(front, front + th, th, spacing, n, th / n, radius, middle, struck, *core_of(wall, spacing, radius, middle, struck)))
        opens = max(radius, 1e-3 * reach)
        W, xlo, xhi = max(W, opens), min(xlo, middle - opens), max(xhi, middle + opens)
    last = walls[-1]
    arrival, passage, crossing = 1e6 * (last.front + R) / (v0 * cosine), 2e6 * R / (v0 * cosine), 1e3 * last.thickness / SOUND
    enough = float(f"{3 * arrival + 4 * passage + 10 * crossing:.4g}")
    tstop = case.setting("tstop") or enough
    back = case.setting("back") or round(max(500 * last.front, BACK), 1)
    widest = max([a, *(max(w.spacing, w.dz) * (2 if w.core else 1) for w in walls)])
    box = (0.0 if quarter else xlo - MARGIN, xhi + MARGIN, 0.0 if quarter else -(W + MARGIN), W + MARGIN, -2 * R - 1e-3 * back)
    return Geometry(a, R, tuple(walls), tstop, enough, arrival, passage, crossing, box, quarter, widest)
