# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A case to scale: where the projectile flies, and what of the walls will be struck."""

import math

from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from ..material.library import stem
from ..shield.elements import radii
from ..shield.geometry import OPEN


def cloud(case, z):
    """(lowest, highest) x in mm that is struck at z: by the projectile on wall 1, behind it by the cloud of wall 1"""
    angle, R = math.radians(case.angle_deg), case.projectile.radius_mm
    rear = case.faces()[0][1]
    way = (OPEN * (z - rear) + 6 * R if z > rear else R) / math.cos(angle)
    return R * math.tan(angle) - way, (max(z, 0.0) + R) * math.tan(angle) + way


def draw(case, plan):
    """A Figure; plan: of chain.plan_of(), with wallK_radius_mm, wallK_middle_mm, wallK_struck_at_mm"""
    sizes, middles, spots = ([plan[f"wall{k}_{what}"] for k in range(1, len(case.walls) + 1)] for what in ("radius_mm", "middle_mm", "struck_at_mm"))
    places, R, slope = case.faces(), case.projectile.radius_mm, math.tan(math.radians(case.angle_deg))
    end = places[-1][1]
    wide = [r if wall.method == "sph" else radii(case, k, 0.0)[2] for k, (wall, r) in enumerate(zip(case.walls, sizes), 1)]
    low, high = (min(m - r for m, r in zip(middles, wide)), max(m + r for m, r in zip(middles, wide)))
    begin, stop = -max(6 * R, 0.25 * end), 1.15 * end + 2 * R  # of what is drawn along z
    low = min(low, (begin + R) * slope - 2 * R - 0.06 * (high - low))
    width, height = stop - begin + 2 * R, 1.3 * (high - low)
    scale = min(8.0 / width, 6.5 / height)  # inches per mm
    left = begin - max(1.5 * R, 0.7 / scale)  # room for words at the projectile
    width = stop - left
    figure = Figure(figsize=(max(5.0, scale * width + 1.5), scale * height + 1.5), constrained_layout=True)
    axes = figure.add_subplot()
    if len(places) > 1:
        z = (places[0][1], places[-1][0])
        sides = [cloud(case, value) for value in z]
        axes.add_patch(Polygon([(z[0], sides[0][0]), (z[1], sides[1][0]), (z[1], sides[1][1]), (z[0], sides[0][1])], color="#f2b134", alpha=0.25, lw=0,
                               label="cloud of wall 1"))
    for k, (wall, (front, rear), r, middle, spot) in enumerate(zip(case.walls, places, sizes, middles, spots), 1):
        _wall(axes, case, k, (front, rear), middle, r)
        sides = cloud(case, front)
        inside = max(sides[0], middle - r), min(sides[1], middle + r)
        missed = sides[0] < middle - r - 0.2 or sides[1] > middle + r + 0.2  # the plan has tenths of mm
        axes.plot([front, front], inside, color="#c8373a", lw=2, solid_capstyle="butt", label="struck" if k == 1 else None)
        axes.plot([0.5 * (front + rear)], [spot], "x", color="black", ms=5, label="struck by the shot itself" if k == 1 else None)
        axes.annotate(f"wall {k}: {wall.thickness_mm:g} mm\n{stem(wall.material)}" + ("\ncloud passes beside" if missed else ""),
                      (0.5 * (front + rear), middle + wide[k - 1]), (0, 3), textcoords="offset points", ha="center", va="bottom", fontsize=7,
                      color="#c8373a" if missed else "black")
        if k > 1:
            before, y = places[k - 2][1], low - 0.06 * (high - low)
            axes.annotate("", (before, y), (front, y), arrowprops={"arrowstyle": "<->", "lw": 0.7, "shrinkA": 0, "shrinkB": 0})
            axes.annotate(f"{wall.gap_mm:g} mm", (0.5 * (before + front), y), (0, -4), textcoords="offset points", ha="center", va="top", fontsize=7)
    axes.plot([begin, stop], [(z + R) * slope for z in (begin, stop)], color="black", lw=0.7, ls="--", label="path of the center")
    axes.add_patch(Circle((begin, (begin + R) * slope), R, color="#555555", lw=0))
    axes.annotate(f"{case.projectile}, {stem(case.material)}\n{case.speed_km_s:g} km/s, {case.angle_deg:g} deg", (begin, (begin + R) * slope - R), (0, -3),
                  textcoords="offset points", ha="center", va="top", fontsize=7)
    axes.set(aspect="equal", xlim=(left, stop), ylim=(low - 0.14 * (high - low), high + 0.16 * (high - low)), xlabel="z (mm)", ylabel="x (mm)")
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title(f"{case.name}, to scale", fontsize=9, parse_math=False)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2 if case.method() else 4, fontsize=7, frameon=False)
    return figure


def _wall(axes, case, k, faces, middle, r):
    """particles dark, elements with particles lighter, those without beyond"""
    bands = [(r, "#2f62a8", None)]
    if case.walls[k - 1].method != "sph":
        core, hold, half = radii(case, k, 0.0)
        bands = [(half, "#c9d8ea", "elements"), (min(hold, half), "#7ea3d0", "elements that hold particles"), (core, "#2f62a8", None)]
    known = axes.get_legend_handles_labels()[1]
    for size, color, label in bands:
        axes.add_patch(Rectangle((faces[0], middle - size), faces[1] - faces[0], 2 * size, color=color, lw=0, label=None if label in known else label))
