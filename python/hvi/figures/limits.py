# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Ballistic limits over speed: those of equations, and those of simulations."""

import numpy as np

from .style import BODIES, STYLE, label_axes, legend, new_figure


def _equations(ax, speeds, curves):
    """curves of ballistic_limit() drawn; the highest of what matters"""
    speeds, highest = np.asarray(speeds), 0.0
    for k, (name, points) in enumerate(curves.items()):
        d, valid = np.array([d for d, _ in points]), np.array([valid for _, valid in points])
        color, line = BODIES[k % len(BODIES)], STYLE["line"] * (1 + 0.22 * (len(curves) - 1 - k))  # those below show beside those above
        ax.plot(speeds, d, "--", color=color, lw=0.5 * line, alpha=0.8)
        ax.plot(speeds, np.where(valid, d, np.nan), color=color, lw=line, label=name, solid_capstyle="butt")
        highest = max(highest, d[speeds >= min(3.0, speeds[-1])].max())
    if curves:
        ax.plot([], [], "--", color="0.4", lw=0.7 * STYLE["line"], label="beyond a range of validity")
    return highest


def _said(ax, title, what, over="speed (km/s)"):
    ax.set_title(title, fontsize=STYLE["size"], parse_math=False)  # names may have $
    label_axes(ax, over, what)
    legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=4, columnspacing=1.2)


def limit_curve(values, curves, points, title, what, over="speed (km/s)"):
    """Limits over speed or another quantity, with bars from what all hold to what all fail; points: [(value, limit, low, high), ...]; values, curves: as of ballistic_limit(), {} if there are none"""
    figure, ((ax,),) = new_figure(4.4)
    highest = _equations(ax, values, curves)
    x, y, low, high = np.array(points).reshape(-1, 4).T
    ax.errorbar(x, y, [y - low, high - y], fmt="o-", color="black", ms=5, lw=STYLE["line"], capsize=3, label="simulation")
    margin = 0.05 * (values[-1] - values[0]) or 0.3
    ax.set(xlim=(values[0] - margin, values[-1] + margin), ylim=(0, 1.25 * max([highest, *high])))
    _said(ax, title, what, over)
    return figure


def ballistic_limit(speeds, curves, title, point=None):
    """Critical diameter over speed; curves: {name: [(diameter in mm, is it within the ranges of validity)]}; point: (speed, diameter) of a case"""
    figure, ((ax,),) = new_figure(4.4)
    highest = _equations(ax, speeds, curves)
    if point is not None:
        ax.plot(*point, "o", color="black", ms=5, clip_on=False, label=f"the case, {point[1]:g} mm")
        highest = max(highest, point[1])
    ax.set(xlim=(speeds[0], speeds[-1]), ylim=(0, 1.25 * highest))
    _said(ax, title, "critical diameter (mm): fails above")
    return figure


def limit_brackets(brackets, rows, equations):
    """Limits over the middle of what shots bracket, over speed: bars of the shots, points of the simulation with their band from what holds to what fails over all shifts, and of equations

    brackets: [shield.brackets.Bracket, ...]; rows: Found.row() of each; equations: {bracket: {name: (limit, ...)}}. Above 1 is safe on both kinds: limits on a
    diameter are turned over.
    """
    figure, ((ax,),) = new_figure(4.4)
    where = {one.name: k for k, one in enumerate(sorted(brackets, key=lambda one: one.shot.speed_km_s))}

    def ratio(one, limit):
        return limit / one.middle if one.on == "wall" else one.middle / limit

    for one in brackets:
        edges = sorted(ratio(one, edge) for edge in (one.low, one.high))
        ax.fill_between([where[one.name] - 0.4, where[one.name] + 0.4], *edges, color="0.8", lw=0, label="shots: the limit is here" if where[one.name] == 0 else None)
    for k, name in enumerate(dict.fromkeys(name for one in equations.values() for name in one)):
        points = [(where[one.name] + 0.05 * (k - 2), ratio(one, equations[one.name][name][0])) for one in brackets if name in equations[one.name]]
        ax.plot(*zip(*points), "_", color=BODIES[k % len(BODIES)], ms=9, mew=2, label=name)
    number = sorted({row["across"] for row in rows})
    for k, across in enumerate(number):
        points = []
        for one in brackets:
            found = [row for row in rows if row["bracket"] == one.name and row["across"] == across and row["limit"]]
            if found:
                mean = sum(ratio(one, row["limit"]) for row in found) / len(found)
                ends = [ratio(one, row[end]) for row in found for end in ("holds", "fails")]  # between them undecided
                points.append((where[one.name] + 0.12 * (k - 0.5 * (len(number) - 1)), mean, mean - min(ends), max(ends) - mean))
        if points:
            x, y, low, high = zip(*points)
            ax.errorbar(x, y, [low, high], fmt="osD^v"[k % 5], color="black", mfc="white" if k else "black", ms=6, capsize=3, label=f"simulation, {across:g} across")
    known = {one.name: one for one in brackets}
    between = [(row["bracket"], sorted(ratio(known[row["bracket"]], row[end]) for end in ("holds", "fails"))) for row in rows
               if not row["limit"] and row["holds"] and row["fails"]]
    if between:
        ax.vlines([where[name] + 0.2 for name, _ in between], *zip(*(ends for _, ends in between)), color="black", ls=":", label="not ended: here")
    ax.axhline(1.0, color="0.4", lw=0.5 * STYLE["line"])
    ax.set_xticks(list(where.values()), [f"{name}\n{one.shot.speed_km_s:g}" for name, one in sorted(((one.name, one) for one in brackets), key=lambda pair: where[pair[0]])])
    _said(ax, "Limits of shields: simulation and equations over what shots bracket", "limit over the measured one: safe above 1", "bracket, speed (km/s)")
    return figure
