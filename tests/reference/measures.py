"""How far a particle run of layered bodies is from the exact solution (fronts.Tracking, or layers.Solution at its time)."""

import numpy as np


def l1(mass, x, fields, exact, t, by="element"):
    """Mean over the particles of |error| divided by the range of the exact field, for fields = (u, p, rho): three numbers.

    mass (n,), x (n,), fields (3, n): particles in their order at the start. What a particle is compared with:
    by = "element": the mean of the exact field over the particle's own mass, so that the one particle a shock is in counts with
         what it should have, whatever side its middle is on (at n = 400 that alone moves L1(u) by 0.05 %);
    by = "material": the exact field at the particle's mass coordinate; by = "position": the one at the particle's position.
    """
    m = np.cumsum(mass) - 0.5 * mass
    whole = exact.at(t, (np.arange(20000) + 0.5) / 20000 * np.sum(mass))
    if by == "element":
        parts = (np.arange(16) + 0.5) / 16 - 0.5
        true = [f.mean(axis=1) for f in exact.at(t, m[:, None] + parts * mass[:, None])[1:4]]
    elif by == "material":
        true = exact.at(t, m)[1:4]
    else:
        true = [np.interp(x, whole[0], f) for f in whole[1:4]]
    return [np.mean(np.abs(got - f)) / np.ptp(field) for got, f, field in zip(fields, true, whole[1:4])]


def jumps(times, u, smallest=0.05):
    """shocks in an exact gauge history (values from each time on): list of (time, u before, u after)"""
    return [(times[k], u[k - 1], u[k]) for k in range(1, len(times)) if abs(u[k] - u[k - 1]) > smallest]


def plateaus(times, u, tstop, shortest):
    """stretches of an exact gauge history without a wave, not shorter than given: list of (begin, end, u)"""
    ends = np.append(times[1:], tstop)
    return [(a, b, v) for a, b, v in zip(times, ends, u) if b - a >= shortest]


def arrival(t, u, before, after, near):
    """when the history t, u passes half-way from before to after, the crossing nearest to the time near; nan: never"""
    level = 0.5 * (before + after)
    d = u - level
    k = np.flatnonzero(d[1:] * d[:-1] <= 0.0)
    if not len(k):
        return np.nan
    crossing = t[k] - d[k] * (t[k + 1] - t[k]) / np.where(d[k + 1] == d[k], 1.0, d[k + 1] - d[k])
    return crossing[np.argmin(np.abs(crossing - near))]
