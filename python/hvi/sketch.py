# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A case to scale: where the projectile flies, and what of the walls will be struck."""

import math

from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

SPREAD = 30.0  # degrees: half the cone in which most of a cloud flies, about the normal of wall 1 and about the path


def faces(case):
    """(front, rear) of each wall in mm, the front of wall 1 at 0"""
    found, z = [], 0.0
    for wall in case.walls:
        z += wall.gap_mm or 0.0
        found.append((z, z + wall.thickness_mm))
        z += wall.thickness_mm
    return found


def struck(case, z, start):
    """(lowest, highest) x in mm that the cloud from a wall whose rear face is at start strikes at z"""
    x = start * math.tan(math.radians(case.angle_deg))
    half = 0.5 * case.diameter_mm
    steep = min(case.angle_deg + SPREAD, 85.0)
    return x - half - (z - start) * math.tan(math.radians(SPREAD)), x + half + (z - start) * math.tan(math.radians(steep))


def draw(case, radii):
    """A Figure; radii: of the walls, in mm"""
    walls = list(zip(case.walls, faces(case), radii))
    R, slope = 0.5 * case.diameter_mm, math.tan(math.radians(case.angle_deg))
    end = walls[-1][1][1]
    reach = max(radii)
    back = max(2.5 * R + 0.1 * end, 0.12 * reach)  # how far before wall 1 the projectile is drawn
    ahead = 0.12 * (end + back) + R
    figure = Figure(figsize=(min(11.0, max(5.0, 2.2 + 7.0 * (end + back + ahead) / (2.4 * reach))), 7.0))
    axes = figure.add_subplot()
    if len(walls) > 1:
        rear, last = walls[0][1][1], walls[-1][1][0]
        low, high = zip(struck(case, rear, rear), struck(case, last, rear))
        axes.add_patch(Polygon([(rear, low[0]), (last, low[1]), (last, high[1]), (rear, high[0])], color="#f2b134", alpha=0.25, lw=0,
                               label=f"cloud, {SPREAD:g} deg about path and normal"))
    for k, (wall, (front, rear), radius) in enumerate(walls, 1):
        axes.add_patch(Rectangle((front, -radius), rear - front, 2 * radius, color="#2f62a8", lw=0))
        low, high = struck(case, front, walls[0][1][1]) if k > 1 else (-R, R)
        missed = high > radius or low < -radius
        axes.plot([front, front], [max(low, -radius), min(high, radius)], color="#c8373a", lw=3, solid_capstyle="butt",
                  label="struck" if k == 1 else None)
        axes.annotate(f"wall {k}\n{wall.thickness_mm:g} mm\n{wall.material.rpartition('/')[2].removesuffix('.hvi')}"
                      + ("\nmissed in part" if missed else ""), (0.5 * (front + rear), radius), (0, 4), textcoords="offset points",
                      ha="center", va="bottom", fontsize=8, color="#c8373a" if missed else "black")
        if k > 1:
            before = walls[k - 2][1][1]
            axes.annotate("", (before, -0.9 * min(radii)), (front, -0.9 * min(radii)), arrowprops={"arrowstyle": "<->", "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
            axes.text(0.5 * (before + front), -0.9 * min(radii), f"{wall.gap_mm:g} mm", ha="center", va="bottom", fontsize=8)
    z = [-R - back, end + ahead]  # of the center; the projectile touches wall 1 where x = 0
    axes.plot(z, [(value + R) * slope for value in z], color="black", lw=0.8, ls="--", label="path of the center")
    axes.add_patch(Circle((z[0], (z[0] + R) * slope), R, color="#555555", lw=0))
    axes.annotate(f"{case.diameter_mm:g} mm {case.material.rpartition('/')[2].removesuffix('.hvi')}\n{case.speed_km_s:g} km/s, {case.angle_deg:g} deg",
                  (z[0], (z[0] + R) * slope - R), (0, -4), textcoords="offset points", ha="center", va="top", fontsize=8)
    axes.set_aspect("equal")
    axes.set_xlim(z[0] - 2 * R, z[1])
    top = max(reach, abs((z[0] + R) * slope) + R)
    axes.set_ylim(-1.15 * top, 1.3 * top)
    axes.set_xlabel("z (mm)")
    axes.set_ylabel("x (mm)")
    axes.legend(loc="upper left", fontsize=7, frameon=False)
    axes.set_title(f"{case.name}, to scale", fontsize=10)
    figure.tight_layout()
    return figure
