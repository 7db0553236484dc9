# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The curves of a material file as one figure."""

import textwrap

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from ..material import curves
from .style import BODIES, STYLE, label_axes, legend, new_figure

SHOCK, ISENTROPE = "black", BODIES[1]
EPS, RATE, T = 0.1, 1e4, 300.0  # where the other two of strain, rate and temperature are held


def _none(ax, text):
    """a panel that has nothing to show says why"""
    what = ax.get_ylabel().partition(" (")[0]
    ax.clear()
    ax.set_axis_off()
    ax.text(0.5, 0.5, textwrap.fill(f"no {what}: {text}", 34), ha="center", va="center", fontsize=STYLE["size"], color="0.4", transform=ax.transAxes)


def _because(material, kind):
    why = material.why.get(kind)
    return f"no section {kind}" + (f"; {why}" if why else "")


def _name(material, kind, law):
    """of a law in a legend; says how many of its numbers are assumed"""
    assumed = material.assumed().get((kind, law), {})
    return law + (f" ({len(assumed)} of {len(material.notes[kind, law])} assumed)" if assumed else "")


def draw(material):
    """Us over u, p over u, p and T over density (Hugoniot and isentrope), yield stress over strain, rate and temperature, spall strength over rate"""
    si = material.units != "lj"
    GPa, km_s, unit = (1e9, 1e3, " (GPa)") if si else (1.0, 1.0, " (lj)")
    speed = " (km/s)" if si else " (lj)"
    figure, axes = new_figure(9.2, columns=2, rows=4)
    shock, pressure, density, heat, strain, fast, hot, spall = axes.flat
    figure.suptitle(material.name + (f": {material.title}" if material.title else ""), fontsize=STYLE["size"] + 1, wrap=True, parse_math=False)

    label_axes(shock, f"particle velocity u{speed}", f"shock velocity{speed}")
    label_axes(pressure, f"particle velocity u{speed}", f"pressure{unit}")
    label_axes(density, "density / reference density", f"pressure{unit}")
    label_axes(heat, "density / reference density", "temperature (K)")
    label_axes(strain, f"plastic strain (at {RATE:g}/s, {T:g} K)", f"yield stress{unit}")
    label_axes(fast, f"strain rate (1/s; strain {EPS:g}, {T:g} K)", f"yield stress{unit}")
    label_axes(hot, f"temperature (K; strain {EPS:g}, {RATE:g}/s)", f"yield stress{unit}")
    label_axes(spall, "strain rate (1/s)", f"spall strength{unit}")

    eos = material.laws("eos")[0]
    if eos in ("table", "idealgas"):
        for ax in (shock, pressure, density, heat):
            _none(ax, f"no curves of eos {eos}")
    else:
        _shocks(curves.Eos(material), (shock, pressure, density, heat), GPa, km_s)
    strong = [law for law in material.laws("strength") if law != "none"]
    if strong:
        _yields(material, strong, (strain, fast, hot), GPa)
    else:
        for ax in (strain, fast, hot):
            _none(ax, "a liquid, strength none" if material.laws("strength") else _because(material, "strength"))
    if material.laws("spall"):
        _spall(material, spall, GPa)
    else:
        _none(spall, _because(material, "spall"))
    return figure


def _shocks(eos, axes, GPa, km_s):
    shock, pressure, density, heat = axes
    up = np.linspace(0.0, 1.2 * eos.c0, 121)[1:]
    Us, p, rho, e = eos.hugoniot(up)
    shock.plot(up / km_s, Us / km_s, color=SHOCK, lw=STYLE["line"])
    pressure.plot(up / km_s, p / GPa, color=SHOCK, lw=STYLE["line"])
    eta = 1.0 - eos.rho0 / rho
    ps, _, Ts = eos.isentrope(eta)
    density.plot(rho / eos.rho0, p / GPa, color=SHOCK, lw=STYLE["line"], label="Hugoniot")
    density.plot(rho / eos.rho0, ps / GPa, "--", color=ISENTROPE, lw=STYLE["line"], label="isentrope")
    legend(density)
    if not eos.cp:
        return _none(heat, "the eos has no cp")
    heat.plot(rho / eos.rho0, eos.temperature(rho, e), color=SHOCK, lw=STYLE["line"], label="Hugoniot")
    heat.plot(rho / eos.rho0, Ts, "--", color=ISENTROPE, lw=STYLE["line"], label="isentrope")
    legend(heat)


def _yields(material, laws, axes, GPa):
    strain, fast, hot = axes
    eps, rate = np.linspace(0.0, 1.0, 201), np.geomspace(1.0, 1e7, 100)
    for law, color in zip(laws, BODIES):
        v = material.in_si(("strength", law))
        line = {"color": color, "lw": STYLE["line"], "label": _name(material, "strength", law)}
        strain.plot(eps, curves.yield_stress(law, v, eps, RATE, T) / GPa, **line)
        fast.semilogx(rate, curves.yield_stress(law, v, EPS, rate, T) / GPa, **line)
        melt = curves.melting(law, v)
        temperature = np.linspace(T, 1.05 * melt if np.isfinite(melt) else 1500.0, 400)
        hot.plot(temperature, curves.yield_stress(law, v, EPS, RATE, temperature) / GPa, **line)
    for ax in axes:
        ax.set_ylim(0.0, 1.15 * ax.get_ylim()[1])
    strain.set_ylim(0.0, 1.3 * strain.get_ylim()[1])  # room for the legend
    legend(strain, loc="upper left")


def _spall(material, ax, GPa):
    rate = np.geomspace(1e3, 1e7, 100)
    for law, color in zip(material.laws("spall"), BODIES):
        ax.loglog(rate, curves.spall_strength(material, law, rate) / GPa, color=color, lw=STYLE["line"], label=_name(material, "spall", law))
        if law == "voids":
            ax.loglog(rate[::9], curves.borne(material, rate[::9]) / GPa, "--", color=color, lw=STYLE["line"], label="borne when stretched")
    low, high = ax.get_ylim()
    ax.set_ylim(0.7 * low, high * 1.7 ** (1 + len(material.laws("spall"))))  # room for the legend
    ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_formatter(NullFormatter())
    legend(ax)
