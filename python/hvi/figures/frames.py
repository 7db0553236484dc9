# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Side views, velocity maps, N(>m), the cloud over time. Each returns a matplotlib Figure."""

import numpy as np
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.lines import Line2D
from scipy import ndimage
from scipy.spatial import cKDTree

from .. import units as unit_systems
from ..analysis import maps
from ..analysis.distribution import cumulative
from ..errors import HVIError
from ..io.frame import as_frame, axis_number, whole
from .style import BESIDE, BODIES, MASS, SINGLE, STYLE, VELOCITY, color_bar, equal_axes, label_axes, legend, new_figure


def _moment(frame):
    """'step 500' or 'time' for a title"""
    if frame.time is None:
        return f"step {frame.step}"
    factor, unit = unit_systems.scale("time", [frame.time], frame.units)
    return f"{frame.time / factor:.4g} {unit}"


# ---------------------------------------------------------------------- side view
def spacing(frame, sample=2000):
    """Distance to the nearest other particle that a tenth of the particles do not reach, from a sample: size of the dots.

    In a solid that is its spacing; in a cloud of pieces that of the particles in pieces, where a mean would be far more.
    """
    if len(frame) < 2:
        return 0.0
    some = frame.x[:: max(len(frame) // sample, 1)]
    return float(np.percentile(cKDTree(frame.x).query(some, k=2)[0][:, 1], 10))


def side(source, axis="z", up=None, color="type", thickness=None, fragments=None, diameter=None):
    """Particles seen from the side, the axis to the right; the nearest in front.

    up: direction that points up, default the next one of x y z after the axis
    color: "type", "velocity" (magnitude), "axial" (velocity along the axis), "fragment" (particles in its fragment, single
    particles gray and behind; needs fragments: the Fragments of this frame, which then are shown) or the name of a column
    thickness: of a slice: only particles within half of it from the center of mass, in the direction of view
    diameter: of the dots; default: spacing()
    """
    frame = whole(source)
    up = up or "yzx"[axis_number(axis)]
    a, b = axis_number(axis), axis_number(up)
    if a == b:
        raise HVIError("up must be another direction than the axis")
    d = diameter if diameter is not None else spacing(frame)
    if color == "fragment":
        if fragments is None:
            raise HVIError("color fragment needs the fragments: by a column, bonds or distance")
        frame = fragments.frame
    if not len(frame):
        raise HVIError(f"{frame.where}: no particles")
    values, text, kind = _colors(frame, axis, color, fragments)
    depth = frame.x[:, 3 - a - b]
    depth = depth if (b - a) % 3 == 1 else -depth  # towards the eye
    single = (values == 1) & (kind == "pieces")
    order = np.lexsort((depth, ~single))
    if thickness is not None:
        middle = np.average(depth, weights=frame.m)
        order = order[np.abs(depth[order] - middle) <= 0.5 * thickness]
        if not len(order):
            raise HVIError(f"no particles in a slice of {thickness:g}")
    x, values, single = frame.x[order][:, [a, b]], values[order], single[order]
    factor, unit = unit_systems.scale("distance", x, frame.units)
    x, d = x / factor, d / factor

    margin = 0.5 * d or 0.01 * np.ptp(x) or 1.0
    figure, ax, beside, per_unit = equal_axes(*((k.min() - margin, k.max() + margin) for k in x.T), bar=kind != "types")
    how, extend = _color_map(kind, values)
    size = max(d * per_unit, 0.3) ** 2  # square of the diameter in points
    ax.scatter(*x[single].T, s=size, color=SINGLE, linewidths=0, rasterized=True)
    dots = ax.scatter(*x[~single].T, s=size, c=values[~single], linewidths=0, rasterized=True, **how)
    if kind == "types":
        _legend_of_types(ax, text, how)
    else:
        bar = color_bar(figure, dots, text, extend, cax=beside)
        if kind == "pieces":
            ticks = np.outer(10.0 ** np.arange(9), (1, 2, 5)).ravel()
            ticks = [t for t in ticks if dots.norm.vmin <= t <= dots.norm.vmax]
            bar.set_ticks(ticks, labels=[f"{t:.0f}" for t in ticks], minor=False)
            bar.minorticks_off()
    label_axes(ax, unit_systems.label(axis, unit), unit_systems.label(up, unit))
    cut = "" if thickness is None else f", slice of {thickness / factor:.3g} {unit}"
    ax.set_title(_moment(frame) + cut, fontsize=STYLE["size"], loc="left")
    return figure


def _colors(frame, axis, color, fragments):
    """values (n,), label, kind: types | pieces | plain; values of kind types count from 1, label is {value: name}"""
    if color == "type" and frame["type"].dtype.kind != "U":
        return frame["type"], {t: f"type {t}" for t in np.unique(frame["type"])}, "types"
    if color in frame and frame[color].dtype.kind == "U":  # elements, type labels
        names, place = np.unique(frame[color], return_inverse=True)
        return place + 1, dict(enumerate(names, 1)), "types"
    if color == "fragment":
        return fragments.table["count"][fragments.row], "particles in the fragment (gray: 1)", "pieces"
    if color in ("velocity", "axial"):
        v = frame.v[:, axis_number(axis)] if color == "axial" else np.linalg.norm(frame.v, axis=1)
        factor, unit = unit_systems.scale("velocity", v, frame.units)
        return v / factor, unit_systems.label(f"v{axis}" if color == "axial" else "speed", unit), "plain"
    values = frame[color]
    frame.require_finite(values[:, None], (color,))
    return values, color, "plain"


def _color_map(kind, values):
    """keywords for scatter(), and at which ends the color bar goes on"""
    if kind == "types":
        most = max(values.max(), 2)
        colors = ListedColormap([BODIES[t % len(BODIES)] for t in range(most)])
        return {"cmap": colors, "vmin": 0.5, "vmax": most + 0.5}, "neither"
    if kind == "pieces":
        return {"cmap": VELOCITY, "norm": LogNorm(2, max(values.max(), 3))}, "neither"
    low, high = np.percentile(values, [0.5, 99.5])  # a few fast strays do not take all the colors
    ends = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    extend = ends[values.min() < low, values.max() > high]
    return {"cmap": VELOCITY, "vmin": low, "vmax": high if high > low else low + 1.0}, extend


def _legend_of_types(ax, names, how):
    marks = [Line2D([], [], marker="o", linestyle="", markersize=5, color=how["cmap"](t - 1), label=name)
             for t, name in names.items()]
    legend(ax, 0, handles=marks, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=len(names), borderpad=0.0, handletextpad=0.2)


# ---------------------------------------------------------------------- velocity maps
def phase(source, axis, plane=None, bins=(200, 120)):
    """Axial velocity against position: mass per bin, and the mean as a line (maps.phase)."""
    frame = as_frame(source)
    found = maps.phase(frame, axis, plane, bins)
    fx, ux = unit_systems.scale("distance", found.x, frame.units)
    fy, uy = unit_systems.scale("velocity", found.y, frame.units)
    fm, um = unit_systems.scale("mass", found.values, frame.units)
    figure, ((ax,),) = new_figure(4.0)
    values = np.where(found.values > 0.0, found.values, np.nan) / fm
    mesh = ax.pcolormesh(found.x / fx, found.y / fy, values.T, cmap=MASS, rasterized=True,
                         norm=LogNorm(np.nanmin(values) / 3.0, np.nanmax(values)))
    ax.plot(0.5 * (found.x[1:] + found.x[:-1]) / fx, found.line / fy, color=BODIES[0], lw=STYLE["line"], label="mean")
    legend(ax, 0, loc="lower right")
    color_bar(figure, mesh, unit_systems.label("mass per bin", um), ax=ax, **BESIDE)
    label_axes(ax, unit_systems.label(axis, ux), unit_systems.label(f"v{axis}", uy))
    ax.set_title(_moment(frame), fontsize=STYLE["size"], loc="left")
    return figure


def field(source, axis, plane=None, bins=(200, 100)):
    """Mean axial velocity over position along the axis and distance from it (maps.field)."""
    frame = as_frame(source)
    found = maps.field(frame, axis, plane, bins)
    factor, unit = unit_systems.scale("distance", np.append(found.x, found.y), frame.units)
    fv, uv = unit_systems.scale("velocity", found.values, frame.units)
    ends = ((edges[0] / factor, edges[-1] / factor) for edges in (found.x, found.y))
    figure, ax, beside, _ = equal_axes(*ends, bar=True)
    mesh = ax.pcolormesh(found.x / factor, found.y / factor, found.values.T / fv, cmap=VELOCITY, rasterized=True)
    color_bar(figure, mesh, unit_systems.label(f"mean v{axis}", uv), cax=beside)
    label_axes(ax, unit_systems.label(axis, unit), unit_systems.label("distance from the axis", unit))
    ax.set_title(_moment(frame), fontsize=STYLE["size"], loc="left")
    return figure


# ---------------------------------------------------------------------- distribution, time
def impacts(source, found, axis="z"):
    """Momentum and energy per area on a wall (maps.impacts)."""
    frame = as_frame(source)
    factor, unit = unit_systems.scale("distance", found.x, frame.units)
    names = [name for name in "xyz" if name != axis]
    figure, ((left, right),) = new_figure(3.2, 2)
    for ax, values, quantity in ((left, found.momentum, "momentum"), (right, found.energy, "energy")):
        shown = np.where(values > 0.0, values, np.nan)
        top = np.nanmax(shown)
        mesh = ax.pcolormesh(found.x / factor, found.x / factor, shown.T, cmap="inferno", norm=LogNorm(1e-4 * top, top), rasterized=True)
        text = f"{unit_systems.name(quantity, frame.units)}/{unit_systems.name('distance', frame.units)}^2"
        color_bar(figure, mesh, f"{quantity} per area ({text})", "min", ax=ax, orientation="horizontal", pad=0.02, fraction=0.05)
        ax.set_aspect("equal")
        label_axes(ax, unit_systems.label(names[0], unit), unit_systems.label(names[1], unit))
    left.set_title(f"{_moment(frame)}, bins of {(found.x[1] - found.x[0]) / factor:.3g} {unit}", fontsize=STYLE["size"], loc="left")
    return figure


def hole(frame, found, axis="z"):
    """Map of a plate's mass per area in shares of the intact one, the edge of the hole, and the circle with its area. found: a hole.Hole"""
    if found.areal is None:
        raise HVIError(f"{frame.where}: nothing in the layer, there is no map")
    names = [name for name in "xyz" if name != axis]
    factor, unit = unit_systems.scale("distance", np.concatenate([found.x, found.y]), frame.units)
    x, y, values = found.x / factor, found.y / factor, found.values
    figure, ((ax,),) = new_figure(4.8)
    mesh = ax.pcolormesh(x, y, found.areal.T / values["reference"], cmap="Greys", vmin=0.0, vmax=1.5, shading="nearest", rasterized=True)
    if found.inside is not None:
        # what is plate, and what is an opening elsewhere, has no edge here
        near = ndimage.binary_dilation(found.inside, np.ones((3, 3)))
        ax.contour(x, y, np.where(near, found.areal, np.nan).T, [found.edge], colors=[BODIES[0]], linewidths=STYLE["line"] + 0.4)
        angle = np.linspace(0.0, 2.0 * np.pi, 361)
        at = [values[f"center_{name}"] / factor for name in names]
        r = 0.5 * values["diameter"] / factor
        ax.plot(at[0] + r * np.cos(angle), at[1] + r * np.sin(angle), "--", color=BODIES[1], lw=STYLE["line"],
                label=f"equal area, {2.0 * r:.4g} {unit}; {values['smallest'] / factor:.4g} to {values['largest'] / factor:.4g} {unit}")
        legend(ax, 0, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    color_bar(figure, mesh, "mass per area / intact", "max", ax=ax)
    ax.set_aspect("equal")
    label_axes(ax, unit_systems.label(names[0], unit), unit_systems.label(names[1], unit))
    return figure


def distribution(masses, fits=(), units="si", small=None):
    """N(>m) on logarithmic axes, with Fits as lines over their range.

    small: (masses, numbers) of all pieces with those below the spacing, drawn as another curve
    """
    m, _, from_here = cumulative(masses)
    if not len(m):
        raise HVIError("no fragments")
    factor, unit = unit_systems.scale("mass", m, units)
    figure, ((ax,),) = new_figure(4.2)
    ax.step(m / factor, from_here, where="pre", color="black", lw=STYLE["line"], label="fragments")
    ax.vlines(m[-1] / factor, 0.5, from_here[-1], color="black", lw=STYLE["line"])
    highest = from_here[0]
    if small is not None:
        every, _, number = cumulative(*small)
        ax.step(every / factor, number, where="pre", color="0.6", lw=STYLE["line"], zorder=0, label="with debris below the spacing (estimate)")
        highest = max(highest, number[0])
    for fit, color, dashes in zip(fits, (BODIES[0], BODIES[1]), ("--", ":")):
        upper = min(m[-1], fit.m_max)
        line = np.geomspace(fit.m_min, upper, 300)
        if fit.unit:  # between the steps
            line = fit.unit * (np.unique(np.floor(line / fit.unit * (1 + 1e-9))))
            drawn = line + 0.5 * fit.unit
        else:
            drawn = line
        above = fit.above(line)
        if fit.law == "power":
            value = rf"$m^{{-b}}$, b = {fit.parameter:.3g} $\pm$ {fit.error:.2g}"
        else:
            value = rf"$e^{{-m/\mu}}$, $\mu$ = {fit.parameter / factor:.3g} $\pm$ {fit.error / factor:.2g} {unit}"
        above = np.where(above > 0.5, above, np.nan)
        ax.plot(drawn / factor, above, dashes, color=color, lw=STYLE["line"] + 0.4, label=value)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylim(0.7, 1.5 * highest)
    label_axes(ax, unit_systems.label("m", unit), "N(> m)")
    legend(ax, 0)
    return figure


def cloud(table, units="si"):
    """Cloud measures over time (or steps): sizes and ratio above, velocities below. table: cloud.table()."""
    table = table[table["particles"] > 0]
    if not len(table):
        raise HVIError("no frame has particles beyond the plane")
    timed = np.isfinite(table["time"]).all()
    ft, ut = unit_systems.scale("time", table["time"], units) if timed else (1.0, "")
    time = table["time"] / ft if timed else table["step"]
    figure, axes = new_figure(4.8, columns=2, rows=2, sharex=True)
    panels = ((("front", "front"), ("rear", "rear")), (("length", "length"), ("diameter", "diameter")),
              (("front_velocity", "front"), ("rear_velocity", "rear"), ("expansion_velocity", "expansion"),
               ("front_displacement_velocity", "front, displacement")),
              (("ratio", "length / radius"),))
    for ax, panel, quantity in zip(axes.flat, panels, ("distance", "distance", "velocity", None)):
        factor, unit = unit_systems.scale(quantity, [table[name] for name, _ in panel], units)
        for (name, text), color in zip(panel, BODIES):
            if np.isfinite(table[name]).any():
                ax.plot(time, table[name] / factor, "o-", ms=3, color=color, lw=STYLE["line"], label=text)
        names = {"front": "position", "length": "size", "front_velocity": "velocity", "ratio": "length / radius"}
        label_axes(ax, y=unit_systems.label(names[panel[0][0]], unit))
        if len(panel) > 1:
            legend(ax, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=2, borderpad=0.0, handlelength=1.5, columnspacing=1.0)
    for ax in axes[1]:
        label_axes(ax, x=unit_systems.label("time", ut) if timed else "step")
    return figure


def crater(frame, found):
    """Profile of a crater; found: an analysis.crater.Crater of the frame"""
    factor, unit = unit_systems.scale("distance", found.r, frame.units)
    figure, ((ax,),) = new_figure(3.2)
    r, below = found.r / factor, found.toward * (found.floor - found.face) / factor
    ax.plot(np.concatenate([-r[::-1], r]), np.concatenate([below[::-1], below]), color=BODIES[0], lw=STYLE["line"])
    ax.axhline(0.0, color="0.6", lw=0.5 * STYLE["line"])
    ax.set_aspect("equal")
    label_axes(ax, unit_systems.label("distance from the axis", unit), unit_systems.label("from the face", unit))
    return figure
