# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Figures of speed against error: one for a case, one for the fronts of all. Each returns a matplotlib Figure; png() its bytes."""

import io
import math
import textwrap

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from pareto import GROUPS, QUESTIONS, front
from PIL import Image

WIDTH = 7.0  # inches
COLORS = ("#2f62a8", "#c8373a", "#4b9349", "#d8892f", "#8a5aa3", "#1b9aa3", "#8c5a3c", "#d464a4", "#6b6b6b", "#9a9a1f")
MARKERS = "osD^vPXhp<>d"
SIZE, SMALL = 9, 7.5  # of letters, points
INK, SOFT = "#1c2329", "#5a6670"
HERE = {"font.family": "DejaVu Sans", "axes.edgecolor": SOFT, "xtick.color": SOFT, "ytick.color": SOFT, "xtick.labelcolor": INK,
        "ytick.labelcolor": INK, "axes.labelcolor": INK, "text.color": INK}
COST, WORK = "core-seconds", "million particle-steps (no times: the cores were busy)"


def png(figure, dpi):
    """A small PNG, the same bytes each time: a palette in place of four channels"""
    figure.set_dpi(dpi)
    figure.canvas.draw()
    picture = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[:, :, :3].copy(), "RGB")
    stream = io.BytesIO()
    picture.quantize(96, dither=Image.Dither.NONE).save(stream, format="png", optimize=True)
    return stream.getvalue()


def plain(x, _=None):
    return f"{x:.10g}" if 1e-3 <= abs(x) < 1e6 else f"$10^{{{round(math.log10(x))}}}$" if x > 0 and abs(math.log10(x) % 1) < 1e-9 else f"{x:.0e}"


def log_axis(axis, low, high):
    """Marks at decades where there are many, at 1, 2, 5 or closer where there are few"""
    decades = math.log10(high / low)
    choices = ((3.5, (1.0,)), (1.3, (1.0, 2.0, 5.0)), (0.7, (1.0, 2.0, 3.0, 5.0, 7.0)), (0.0, (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)))
    subs = next(marks for least, marks in choices if decades > least)
    axis.set_major_locator(LogLocator(10.0, subs=subs, numticks=12))
    axis.set_major_formatter(FuncFormatter(plain))
    axis.set_minor_formatter(NullFormatter())
    axis.grid(True, color="#e4e8eb", lw=0.6)


def room(values, share=0.08):
    """(lowest, highest) with a margin on a logarithmic axis, at least a factor 1.5 in all"""
    low, high = min(values), max(values)
    wide = max((high / low) ** share, (1.5 * low / high) ** 0.5, 1.12)
    return low / wide, high * wide


def new(heights, **how):
    with matplotlib.rc_context(HERE):
        figure = Figure(figsize=(WIDTH, sum(heights)), constrained_layout=True)
        FigureCanvasAgg(figure)
        axes = figure.subplots(len(heights), 1, squeeze=False, gridspec_kw={"height_ratios": heights}, **how)[:, 0]
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(labelsize=SIZE)
        ax.set(xscale="log", yscale="log")
        ax.set_axisbelow(True)
    return figure, axes


def legend(ax, handles):
    """to the right of the axes"""
    ax.legend(handles=handles, fontsize=SMALL, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.02), borderaxespad=0.2, handlelength=1.8,
              labelspacing=0.45)


def key(label, width=26, **how):
    return Line2D([], [], label="\n".join(textwrap.wrap(label, width)), **how)


class Labels:
    """Texts beside points where nothing else is; what finds no place is left out unless it must be there."""

    def __init__(self, figure, ax, points):
        figure.canvas.draw()  # sizes of the axes
        self.figure, self.ax = figure, ax
        self.taken = [np.array([x - 5, y - 5, x + 5, y + 5]) for x, y in ax.transData.transform(points)] if len(points) else []

    def add(self, text, at, must=False, **how):
        """at: in the units of the axes. Places around it from near to far are tried"""
        x, y = self.ax.transData.transform(at)
        box = self.ax.get_window_extent()
        note = self.ax.text(*at, text, **how)
        size = note.get_window_extent(self.figure.canvas.get_renderer())
        w, h = size.width, size.height
        best = None
        for far in (8, 18, 30, 46) if must else (7,):
            for dx, dy in ((1, 0.6), (-1, -0.6), (1, -0.6), (-1, 0.6), (0, 1), (0, -1), (1, 0), (-1, 0)):
                cx, cy = x + dx * (far + w / 2), y + dy * far + np.sign(dy) * h / 2
                place = np.array([cx - w / 2 - 1, cy - h / 2 - 1, cx + w / 2 + 1, cy + h / 2 + 1])
                outside = place[0] < box.x0 or place[1] < box.y0 or place[2] > box.x1 or place[3] > box.y1
                hits = sum(np.prod(np.clip(np.minimum(place[2:], t[2:]) - np.maximum(place[:2], t[:2]), 0.0, None)) for t in self.taken)
                if best is None or (outside, hits) < best[0]:
                    best = (outside, hits), place, far
            if best[0] == (False, 0.0):
                break
        if best[0] != (False, 0.0) and not must:
            note.remove()
            return
        _, place, far = best
        self.taken.append(place)
        corner = self.ax.transData.inverted().transform(place[:2] + 1)
        note.set_position(corner)
        note.set(ha="left", va="bottom")
        if far > 8:
            middle = self.ax.transData.inverted().transform((place[:2] + place[2:]) / 2)
            self.ax.annotate("", at, middle, arrowprops={"arrowstyle": "-", "color": SOFT, "lw": 0.7, "shrinkB": 6, "shrinkA": 0.5 * h}, zorder=1)


def axis_name(case):
    unit = case["error"].get("unit", "")
    return f"{case['error']['main']} ({unit})" if unit and str(unit) != "1" else f"{case['error']['main']}"


def of_case(case, points):
    """Core-seconds across, main error up: a line per method over its resolutions, the front, the default, points of others. None if nothing is drawn.

    Where no run has a time, particle-steps stand across.
    """
    drawn = [p for p in points if not (p.failed or p.cannot)]
    timed = any(p.timed for p in drawn)
    drawn = [p for p in drawn if p.timed or not timed]
    others = [o for o in case.get("points") or [] if timed]
    positive = [e for e in [*(p.error for p in drawn), *(float(o["error"]) for o in others)] if e > 0]
    if not positive:
        return None
    floor = 0.5 * min(positive)  # where errors of zero are drawn
    at = {id(p): (p.cost if timed else 1e-6 * p.particles * p.steps, max(p.error, floor)) for p in drawn}
    theirs = [(float(o["core_s"]), max(float(o["error"]), floor)) for o in others]
    figure, (ax,) = new([4.3])
    handles = []
    best = front(drawn)
    if best:
        x, y = np.array([at[id(p)] for p in best]).T
        ax.step(x, y, where="post", color="#1c2329", lw=5, alpha=0.13, zorder=1, solid_capstyle="round")
    for k, method in enumerate(dict.fromkeys(p.method for p in drawn)):
        color, marker = COLORS[k % len(COLORS)], MARKERS[k % len(MARKERS)]
        ours = [p for p in drawn if p.method == method]
        how = {"color": color, "marker": marker, "ms": 5.5, "lw": 1.5, "ls": "-" if ours[0].ours else (0, (4, 2))}
        line = [p for p in ours if not p.extra]
        if line:
            ax.plot(*np.array([at[id(p)] for p in line]).T, zorder=3, **how)
        for p in ours:
            if p.extra or p.open:
                ax.plot(*at[id(p)], marker=marker, ms=4.5 if p.extra else 5.5, mfc="white", mec=color, mew=1.0, ls="", zorder=4)
            if p.scatter:
                x, y = at[id(p)]
                ax.plot((x, x), (max(y - p.scatter, floor), y + p.scatter), color=color, lw=1.0, zorder=2)
        handles.append(key(method, **how))
    for k, (o, place) in enumerate(zip(others, theirs)):
        how = {"color": "#1c2329", "marker": "*PXD8"[k % 5], "ms": 9 - 2 * (k % 5 > 0), "ls": ""}
        ax.plot(*place, zorder=4, **how)
        handles.append(key(str(o["name"]), **how))
    if best:
        handles.append(key("Pareto front", color="#1c2329", lw=5, alpha=0.13))
    if any(p.extra for p in drawn):
        handles.append(key("small, open: another setting", color=SOFT, marker="o", ms=4.5, mfc="white", ls=""))
    if any(p.open for p in drawn):
        handles.append(key("open: ledger not closed", color=SOFT, marker="o", ms=5.5, mfc="white", ls=""))
    places = [*at.values(), *theirs]
    ax.set(xlim=room([x for x, _ in places]), ylim=room([y for _, y in places], 0.1))
    log_axis(ax.xaxis, *ax.get_xlim())
    log_axis(ax.yaxis, *ax.get_ylim())
    ax.set_xlabel(COST if timed else WORK, fontsize=SIZE)
    ax.set_ylabel(axis_name(case), fontsize=SIZE)
    default = next((p for p in drawn if p.default), None)
    if default:
        handles.append(key("default", color="black", marker="o", ms=11, mfc="none", mew=1.4, ls=""))
    legend(ax, handles)
    labels = Labels(figure, ax, places)
    if default:
        ax.plot(*at[id(default)], marker="o", ms=11, mfc="none", mec="black", mew=1.4, ls="", zorder=6)
        labels.add("default: " + "\n".join(textwrap.wrap(default.name, 30)), at[id(default)], must=True, fontsize=SIZE, weight="bold", zorder=7)
    for p in best:
        if p is not default:
            labels.add(p.text, at[id(p)], fontsize=SMALL, color=SOFT, zorder=5)
    return figure


def split(groups):
    """(title, fronts) of panels with as many cases as there are colors at most, those of one question together; groups: {group: fronts}"""
    for group in (g for g in GROUPS if g in groups):
        asked = [*QUESTIONS, None]
        fronts = sorted(groups[group], key=lambda found: asked.index(next((q for q in found[0]["question"] if q in asked), None)))
        number = math.ceil(len(fronts) / len(COLORS))
        for k in range(number):
            part = fronts[k * len(fronts) // number:(k + 1) * len(fronts) // number]
            yield GROUPS[group] + (f" ({k + 1} of {number})" if number > 1 else ""), part


def headline(cases, points):
    """The front of the package's methods in each case, a panel per group; rings: defaults. None if no run has a time."""
    groups = {}
    for name, runs in points.items():
        best = [p for p in front(p for p in runs if p.ours) if p.error > 0]
        default = next((p for p in runs if p.default and p.counts and p.timed), None)
        if best:
            groups.setdefault(cases[name]["group"], []).append((cases[name], best, default))
    if not groups:
        return None
    panels = list(split(groups))
    heights = [max(2.3, 0.55 + 0.175 * sum(len(textwrap.wrap(case["title"], 30)) for case, *_ in fronts)) for _, fronts in panels]
    figure, axes = new(heights, sharex=True)
    every = [p.cost for _, fronts in panels for _, best, default in fronts for p in [*best, *([default] if default else [])]]
    for ax, (title, fronts) in zip(axes, panels):
        units = {str(case["error"].get("unit", "")) for case, *_ in fronts}
        handles, errors = [], []
        for k, (case, best, default) in enumerate(fronts):
            unit = str(case["error"].get("unit", ""))
            how = {"color": COLORS[k], "marker": MARKERS[k], "ms": 4.5, "lw": 1.3, "ls": "-"}
            ax.plot([p.cost for p in best], [p.error for p in best], **how)
            handles.append(key(case["title"] + (f" ({unit})" if len(units) > 1 and unit else ""), 30, **how))
            errors += [p.error for p in best]
            if default and default.error > 0:
                ax.plot(default.cost, default.error, "o", ms=9, mfc="none", mec="black", mew=1.2, zorder=5)
                ax.plot(default.cost, default.error, **{**how, "ls": ""})
                errors.append(default.error)
        ax.set(xlim=room(every, 0.05), ylim=room(errors, 0.1))
        log_axis(ax.xaxis, *ax.get_xlim())
        log_axis(ax.yaxis, *ax.get_ylim())
        unit = units.pop() if len(units) == 1 else ""
        ax.set_ylabel(f"error ({unit})" if unit and unit != "1" else "error", fontsize=SIZE)
        ax.set_title(title, fontsize=SIZE, loc="left", weight="bold")
        if ax is axes[-1]:
            handles.append(key("default", color="black", marker="o", ms=9, mfc="none", mew=1.2, ls=""))
        legend(ax, handles)
    axes[-1].set_xlabel(COST, fontsize=SIZE)
    return figure
