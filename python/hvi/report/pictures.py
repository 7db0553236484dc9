# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Pictures of a run of a shield: lit particles of the whole shield, with scales. Each function returns a matplotlib Figure."""

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.cm import ScalarMappable
from matplotlib.colors import PowerNorm, to_rgb
from matplotlib.figure import Figure

from .. import figures
from ..analysis import fragments, hole, maps
from ..figures import sketch as sketches
from ..shield.script import HANGS
from . import render

COLORS = [to_rgb(c) for c in ("#e2603a", "#6f9bd1", "#86b58a", "#b39ad0", "#d8b25a", "#9aa4ad")]  # projectile, wall 1, ...
SIDE = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0))  # eye, up: z to the right
FRONT, REAR = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0)), ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
OBLIQUE = ((-0.55, 0.80, 0.52), (1.0, 0.0, 0.0))
PANEL = 4.6  # inches
DPI = 150
SPEED = "viridis"


def color(body):
    return COLORS[body % len(COLORS)]


def body_name(body):
    return f"wall {body}" if body else "projectile"


def _panel(window, labels, width=PANEL, right=0.12):
    """(figure, axes, pixels across) whose scales are equal; margins in inches"""
    left, low, high = 0.62, 0.5, 0.12
    inner = width - left - right
    w, h = width, inner * (window[3] - window[2]) / (window[1] - window[0]) + low + high
    figure = Figure(figsize=(w, h))
    axes = figure.add_axes((left / w, low / h, 1.0 - (left + right) / w, 1.0 - (low + high) / h), facecolor="#f7f8fa", xlim=window[:2], ylim=window[2:])
    axes.tick_params(labelsize=9, direction="out", length=3)
    axes.spines[:].set_color("#9aa4ad")
    axes.set_xlabel(labels[0], fontsize=9)
    axes.set_ylabel(labels[1], fontsize=9)
    return figure, axes, round(inner * DPI)


def _draw(axes, x, radius, rgb, view, window, pixels):
    axes.imshow(render.picture(x, radius, rgb, view, window, pixels), extent=window, interpolation="lanczos", aspect="equal", zorder=2)
    axes.set(xlim=window[:2], ylim=window[2:])


def by_body(scene):
    rgb = np.array([color(k) for k in range(scene.body.max() + 1)])
    return rgb[scene.body]


def speeds(scene, top):
    """colors by speed, and the norm: the root, for most is slow"""
    norm = PowerNorm(0.5, 0.0, top)
    return colormaps[SPEED](norm(np.minimum(np.linalg.norm(scene.v, axis=1), top)))[:, :3], norm


# ---------------------------------------------------------------------- side view
def side_window(run):
    """left, right, low, high of all side views, mm: the walls, and as much behind the last as the half of the shield is deep"""
    R, deep = run.R, run.faces(run.walls)[1]
    ends = [(run.of_wall(k, "middle_mm") - run.of_wall(k, "radius_mm"), run.of_wall(k, "middle_mm") + run.of_wall(k, "radius_mm")) for k in range(1, run.walls + 1)]
    low, high = min(e[0] for e in ends), max(e[1] for e in ends)
    span = max(0.75 * deep, 0.35 * (high - low))
    return (-max(5.0 * R, 0.5 * span), deep + span, low - 0.03 * (high - low), high + 0.03 * (high - low))


def side(run, scene, window, colors=None, bar=None):
    """The half behind the plane y = 0, from the side; walls that are not there yet as outlines"""
    figure, axes, pixels = _panel(window, ("z (mm)", "x (mm)"), right=0.85 if bar else 0.12, width=PANEL + (0.73 if bar else 0.0))
    keep = scene.x[:, 1] <= 0.0
    _draw(axes, scene.x[keep], scene.radius[keep], (by_body(scene) if colors is None else colors)[keep], render.basis(*SIDE), window, pixels)
    for k in range(1, run.walls + 1):
        if not (scene.body == k).any():
            front, rear = run.faces(k)
            middle, r = run.of_wall(k, "middle_mm"), run.of_wall(k, "radius_mm")
            axes.fill_betweenx((middle - r, middle + r), front, rear, facecolor="none", edgecolor="#8a949d", lw=0.8, ls="--")
    if bar:
        w, h = figure.get_size_inches()
        beside = figure.add_axes((1.0 - 0.72 / w, 0.5 / h, 0.14 / w, 1.0 - 0.62 / h))
        made = figure.colorbar(ScalarMappable(bar, SPEED), cax=beside)
        made.set_label("speed (km/s)", fontsize=9)
        beside.tick_params(labelsize=8)
    return figure


def velocities(run, scene, window, bar=True):
    """the side view with speeds"""
    rgb, norm = speeds(scene, run.case.speed_km_s)
    return side(run, scene, window, rgb, norm if bar else None)


def oblique(run, scene, width=6.4):
    """All of it in perspective of parallels, a quarter cut out, at one moment"""
    view = render.basis(*OBLIQUE)
    near = scene.x[:, 2] < run.faces(run.walls)[1] + 0.55 * (side_window(run)[1] - run.faces(run.walls)[1])
    near &= scene.x[:, 2] > 0.8 * side_window(run)[0]
    keep = near & ~((scene.x[:, 1] > 0.0) & (scene.x[:, 0] > _axis_at(run, scene.x[:, 2])))
    seen = scene.x[keep] @ view.T
    walls = scene.body[keep] > 0
    low, high = np.percentile(seen[walls], 0.05, axis=0)[:2], np.percentile(seen[walls], 99.95, axis=0)[:2]
    margin = 0.04 * (high - low)
    window = (low[0] - margin[0], high[0] + margin[0], low[1] - margin[1], high[1] + margin[1])
    figure = Figure(figsize=(width, width * (window[3] - window[2]) / (window[1] - window[0])))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.axis("off")
    _draw(axes, scene.x[keep], scene.radius[keep], by_body(scene)[keep], view, window, round(width * DPI))
    length = _round(0.2 * (window[1] - window[0]))
    x0, y0 = window[0] + 0.03 * (window[1] - window[0]), window[2] + 0.035 * (window[3] - window[2])
    axes.plot([x0, x0 + length], [y0, y0], color="#20262c", lw=2.5, solid_capstyle="butt", zorder=3)
    axes.annotate(f"{length:g} mm", (x0 + 0.5 * length, y0), (0, 4), textcoords="offset points", ha="center", va="bottom", fontsize=10, zorder=3)
    return figure


def _axis_at(run, z):
    """x of the shot at z"""
    return np.tan(np.radians(run.case.angle_deg)) * (z + run.R)


def _round(length):
    """the next lower of 1, 2, 5, 10, ..."""
    power = 10.0 ** np.floor(np.log10(length))
    return max(n * power for n in (1, 2, 5) if n * power <= length)


# ---------------------------------------------------------------------- walls
def near_wall(run, scene, k):
    """what is no farther from wall k than its bulge is high, as compute hvi/hole takes it, without other walls: these lie in front of it where gaps are narrow"""
    def near(j):
        front, rear = run.faces(j)
        reach = 2.0 * (rear - front) * (1.0 + max(float(run.result.get(f"wall{j}_bulge_over_thickness", 0.0)), 0.0))
        return np.abs(scene.x[:, 2] - 0.5 * (front + rear)) <= reach
    found = near(k)
    for j in range(1, run.walls + 1):
        if j != k:
            found &= ~((scene.body == j) & near(j))
    return found


def hole_center(run, scene, k):
    """(x, y) in mm of the middle of the hole in wall k along the axis, as compute hvi/hole finds it; where the shot struck if the frame has no hole in one plate"""
    front, rear = run.faces(k)
    struck = run.of_wall(k, "struck_at_mm")
    found = hole.measure(scene.frame, "z", (1e-3 * struck, 0.0), 0.5e-3 * (front + rear), thickness=1.0, types=np.flatnonzero(run.bodies() == k),
                         distance=1e-3 * HANGS * run.spacings().max()).values
    return (1e3 * found["center_x"], 1e3 * found["center_y"]) if found["found"] == 1 else (struck, 0.0)


def face(run, scene, k, rear):
    """A wall from the front or from behind, with the circle of its hole"""
    view = render.basis(*(REAR if rear else FRONT))
    middle, r = run.of_wall(k, "middle_mm"), 1.04 * run.of_wall(k, "radius_mm")
    window = (-r, r, middle - r, middle + r)
    figure, axes, pixels = _panel(window, ("-y (mm)" if rear else "y (mm)", "x (mm)"))
    near = near_wall(run, scene, k)
    _draw(axes, scene.x[near], scene.radius[near], by_body(scene)[near], view, window, pixels)
    diameter = float(run.result.get(f"hole{k}_diameter_mm") or 0.0)
    if diameter > 0.0:
        turn, (x, y) = np.linspace(0.0, 2.0 * np.pi, 200), hole_center(run, scene, k)
        axes.plot((-y if rear else y) + 0.5 * diameter * np.sin(turn), x + 0.5 * diameter * np.cos(turn), color="#c02020", lw=1.2, ls="--", zorder=4)
    return figure


def body_of(run, scene, k):
    """particles of the largest sound piece of wall k: what is left of it"""
    mine = np.flatnonzero(scene.body == k)
    found = fragments.find(scene.whole.select(scene.body == k), distance=HANGS, sizes=1e-3 * scene.spacing[mine], failed=fragments.FAILED)
    largest = np.argmax(found.table["mass"])
    return mine[found.row == largest]


def profile(run, scene, k, width=8.4):
    """A slice of wall k through the shot: particles, and the faces of what is left of it before and after"""
    front, rear = run.faces(k)
    thick = rear - front
    slice_ = np.abs(scene.x[:, 1]) <= slice_of(run, k) / 2
    high = thick * (1.5 + max(float(run.result.get(f"wall{k}_bulge_over_thickness", 0.0)), 0.0))
    near = slice_ & (scene.x[:, 2] > front - 2.0 * thick) & (scene.x[:, 2] < rear + high)
    left = np.zeros(len(scene.x), dtype=bool)
    left[body_of(run, scene, k)] = True
    middle, r = run.of_wall(k, "middle_mm"), run.of_wall(k, "radius_mm")
    z = scene.x[near, 2]
    low, high = min(z.min(), front) - 0.3 * thick, max(z.max(), rear) + 0.3 * thick
    window = (middle - 1.02 * r, middle + 1.02 * r, low, high)
    figure, axes, pixels = _panel(window, ("x (mm)", "z (mm)"), width=width)
    view = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])  # the shot comes from below
    rgb = by_body(scene)
    rgb[(scene.body == k) & ~left] = 0.5 * rgb[(scene.body == k) & ~left] + 0.15
    _draw(axes, scene.x[near], scene.radius[near], rgb[near], view, window, pixels)
    for value in (front, rear):
        axes.axhline(value, color="#20262c", lw=0.7, ls=":", zorder=3)
    wide = scene.spacing[scene.body == k].max()
    edges = np.arange(window[0], window[1] + wide, 1.5 * wide)
    mine = left & slice_
    place = np.digitize(scene.x[mine, 0], edges)
    height = scene.x[mine, 2] + 0.5 * thick / run.of_wall(k, "layers") * scene.spacing[mine] / run.spacings()[1 + k]
    top = np.array([height[place == j].max() if (place == j).any() else np.nan for j in range(1, len(edges))])
    axes.plot(0.5 * (edges[1:] + edges[:-1]), top, color="#c02020", lw=1.6, zorder=4, label="rear of what hangs together by sound material")
    axes.legend(fontsize=9, frameon=False, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0.1)
    w, h = figure.get_size_inches()
    figure.set_size_inches(w, h + 0.25)
    axes.set_position((0.62 / w, 0.5 / (h + 0.25), 1.0 - 0.74 / w, (h - 0.62) / (h + 0.25)))
    return figure


def slice_of(run, k):
    """thickness of the slice of profile(), mm"""
    return 3.0 * run.of_wall(k, "spacing_mm")


# ---------------------------------------------------------------------- where the next wall is struck; the sketch
def witness(run, scene, k):
    """Momentum and energy per area where the plane of wall k will be struck by what flies behind wall k-1, side by side"""
    found = maps.impacts(scene.frame, "z", 1e-3 * run.faces(k)[0], after=1e-3 * run.faces(k - 1)[1], bins=40)
    return figures.impacts(scene.frame, found, "z"), found.summary


def phase(scene, run, k):
    """mass over place and axial velocity of what is behind wall k"""
    return figures.phase(scene.frame, "z", 1e-3 * run.faces(k)[1])


def sketch(run, case):
    with rc_context({"text.parse_math": False}):  # names may have $
        figure = sketches.draw(case, run.plan)
        figure.draw_without_rendering()
    return figure
