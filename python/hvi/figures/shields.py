# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Shields side by side: areal densities of their walls by role with the verdicts, and their limits over speed or another quantity in one diagram."""

import numpy as np

from .style import BODIES, STYLE, label_axes, legend, new_figure

VERDICTS = {"holds": "#1d7a3f", "fails": "#b3261e", "undecided": "#9a6200"}  # as the report has them; others are gray
MARKERS = "osD^v<>"


def shields(bars, curves):
    """A Figure: the bars, below them a diagram for each kind of curve.

    bars: [(name, verdict, {role: kg/m^2}), ...]; curves: {(label of the axis, label of the limit): [(name, [(value, limit, low, high), ...]), ...]}
    """
    high = 1.0 + 0.4 * len(bars)
    figure, axes = new_figure(high + 3.6 * len(curves), rows=1 + len(curves), height_ratios=[high, *[3.6] * len(curves)])
    _bars(axes[0, 0], bars)
    place = {name: k for k, (name, *_) in enumerate(bars)}
    for ax, ((over, what), several) in zip(axes[1:, 0], curves.items()):
        for name, points in several:
            x, y, low, up = np.array(points).T
            k = place[name]
            wider = 0.3 * (len(bars) - 1 - k)  # those below show beside those above
            ax.errorbar(x, y, [y - low, up - y], fmt=f"{MARKERS[k % len(MARKERS)]}-", color=BODIES[k % len(BODIES)], ms=5 * (1 + wider), lw=STYLE["line"] * (1 + wider), capsize=3, label=_plain(name))
        ax.set_ylim(bottom=0)
        label_axes(ax, over, what)
        legend(ax)
    return figure


def _bars(ax, bars):
    """areal densities, one shield below the other, the first on top; its verdict at the end of each"""
    left = np.zeros(len(bars))
    for k, role in enumerate(dict.fromkeys(role for _, _, walls in bars for role in walls)):
        values = np.array([walls.get(role, 0.0) for _, _, walls in bars])
        ax.barh(range(len(bars)), values, left=left, color=BODIES[1:][k % (len(BODIES) - 1)], height=0.6, label=role)
        left += values
    for k, (_, verdict, _) in enumerate(bars):
        ax.annotate(verdict, (left[k], k), (4, 0), textcoords="offset points", va="center", fontsize=STYLE["size"], color=VERDICTS.get(verdict, "0.4"), weight="bold")
    ax.set_yticks(range(len(bars)), [_plain(name) for name, *_ in bars])
    ax.set(xlim=(0, 1.25 * left.max()), ylim=(len(bars) - 0.4, -0.6))
    label_axes(ax, "areal density (kg/m$^2$)")
    legend(ax, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=4)


def _plain(name):
    """a name whose $ is no formula"""
    return name.replace("$", r"\$")
