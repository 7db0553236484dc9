# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""How figures look, and how they are written."""

import os

import numpy as np
from matplotlib.figure import Figure

from ..errors import writing

WIDTH = 6.4  # inches
DPI = 200
BODIES = ("#c8373a", "#2f62a8", "#5a9a57", "#8a5aa3", "#d8892f", "#6b6b6b")  # types 1, 2, ...
STYLE = {"size": 9, "line": 1.4}
SINGLE = "#c9c9c9"
MASS, VELOCITY = "Greys", "viridis"
BESIDE = {"pad": 0.01, "fraction": 0.035, "aspect": 25}  # where a color bar stands


def save(figure, name):
    """Writes name.png and name.pdf, or only the one that name says. Returns the paths."""
    stem, end = os.path.splitext(str(name))
    paths = [str(name)] if end in (".png", ".pdf") else [f"{name}.png", f"{name}.pdf"]
    for path in paths:
        with writing(path):
            figure.savefig(path, dpi=DPI, metadata={"CreationDate": None} if path.endswith(".pdf") else None)
    return paths


def new_figure(height, columns=1, rows=1, **how):
    figure = Figure(figsize=(WIDTH, height), constrained_layout=True)
    axes = figure.subplots(rows, columns, squeeze=False, **how)
    for ax in axes.flat:
        plain(ax)
    return figure, axes


def equal_axes(x, y, bar):
    """A figure with one pair of axes of equal scales that just holds the ranges x and y (lowest, highest).

    Returns figure, axes, axes for a color bar (None without), points (1/72 inch) per unit of length.
    """
    left, right, below, above = 0.65, 0.95 if bar else 0.15, 0.55, 0.35  # inches around the axes
    wide, high = np.ptp(x), np.ptp(y)
    scale = min((WIDTH - left - right) / wide, 7.0 / high)
    w, h = max(wide * scale, 2.0), max(high * scale, 0.8)
    total = left + w + right, below + h + above
    figure = Figure(figsize=total)
    ax = figure.add_axes((left / total[0], below / total[1], w / total[0], h / total[1]))
    ax.set(xlim=x, ylim=y)
    ax.set_aspect("equal", anchor="W")
    beside = None
    if bar:
        beside = figure.add_axes(((left + w + 0.1) / total[0], below / total[1], 0.12 / total[0], h / total[1]))
    plain(ax)
    return figure, ax, beside, 72.0 * scale


def plain(ax):
    ax.spines[["top", "right"]].set_visible(False)
    ax.tick_params(labelsize=STYLE["size"])


def label_axes(ax, x=None, y=None):
    if x is not None:
        ax.set_xlabel(x, fontsize=STYLE["size"])
    if y is not None:
        ax.set_ylabel(y, fontsize=STYLE["size"])


def color_bar(figure, artist, text, extend="neither", **where):
    bar = figure.colorbar(artist, extend=extend, **where)
    bar.set_label(text, fontsize=STYLE["size"])
    bar.ax.tick_params(labelsize=STYLE["size"])
    bar.outline.set_visible(False)
    return bar


def legend(ax, smaller=1, **where):
    ax.legend(fontsize=STYLE["size"] - smaller, frameon=False, **where)
