# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Cumulative mass distribution of fragments, N(>m), and laws fitted to it by maximum likelihood.

power        N(>m) = A m^-b: density m^-(1+b). Clauset, Shalizi & Newman, SIAM Review 51 (2009) 661: estimator eq 3.1 (3.5
             for whole numbers), choice of the lower end by the Kolmogorov-Smirnov distance section 3.3.
exponential  N(>m) = N0 exp(-m/mu). Grady & Kipp, J. Appl. Phys. 58 (1985) 1210.

Fragments of equal particles have masses that are whole multiples of the particle mass (the unit); then the sums of the
discrete laws are used, because the continuous ones are biased where fragments have few particles. Both laws have one
parameter theta and the form p = exp(-theta T) / Z(theta), with T = log m (theta = 1 + b) or T = m (theta = 1/mu). The
likelihood is largest where the mean of T is -d log Z/d theta; the standard error of theta is 1 / sqrt(n d2 log Z/d theta2).
"""

import dataclasses

import numpy as np

from ..errors import HVIError

LAWS = ("power", "exponential")
FEWEST = 10  # fragments that a fit needs


def cumulative(masses, number=None):
    """N(>m) as a step function: (m, above, from_here), one entry per different mass, rising.

    number: how many there are of each mass, (k,), default: one
    above: number of fragments heavier than m; from_here: number of those that are at least as heavy
    """
    m, place, count = np.unique(np.asarray(masses, dtype=float), return_inverse=True, return_counts=True)
    if number is not None:
        count = np.bincount(place, number, minlength=len(m))
    from_here = np.cumsum(count[::-1])[::-1]
    return m, from_here - count, from_here


@dataclasses.dataclass
class Fit:
    """A law fitted to the n fragments with m_min <= m <= m_max.

    parameter, error: b (no unit) or mu (mass), and its standard error for this range
    unit: particle mass if masses were taken as multiples of it, else None
    log_likelihood: of the n masses; for laws on the same range the larger one fits better (one parameter each)
    ks: largest difference between the cumulative shares of data and law
    """

    law: str
    parameter: float
    error: float
    m_min: float
    m_max: float
    n: int
    beyond: int
    unit: float
    log_likelihood: float
    ks: float

    @property
    def amplitude(self):
        """A of N(>m) = A m^-b, N0 of N0 exp(-m/mu), such that N(>=m_min) is that of the data; without an upper end"""
        scaled = self.m_min**self.parameter if self.law == "power" else np.exp(self.m_min / self.parameter)
        return (self.n + self.beyond) * scaled

    def above(self, m):
        """Expected number of fragments heavier than m, for m (k,) within the range; those beyond m_max included."""
        m = np.asarray(m, dtype=float)
        if self.unit:
            t = np.floor(m / self.unit * (1 + 1e-9)) + 1  # the next whole number
        else:
            t = m / self.m_min
        return self.beyond + self.n * _Law(self.law, self.unit, self.m_min, self.m_max).share_from(t, self._theta)

    @property
    def _theta(self):
        return _theta(self.law, self.parameter, self.unit or self.m_min)

    def __str__(self):
        name, unit = ("b", "") if self.law == "power" else ("mu", " (mass)")
        upper = f" to {self.m_max:.6g}" if np.isfinite(self.m_max) else " on"
        return (f"{self.law}: {name} = {self.parameter:.6g} +- {self.error:.2g}{unit}, {self.n} fragments "
                f"from {self.m_min:.6g}{upper}, log likelihood {self.log_likelihood:.6g}, KS {self.ks:.3g}")


def _theta(law, parameter, scale):
    return 1.0 + parameter if law == "power" else scale / parameter


class _Law:
    """A law in masses t: whole numbers of units, or multiples of m_min."""

    def __init__(self, law, unit, m_min, m_max):
        self.power, self.discrete = law == "power", unit is not None
        scale = unit or m_min
        self.a, self.b = m_min / scale, m_max / scale
        if self.discrete:
            self.a, self.b = round(self.a), round(self.b) if np.isfinite(self.b) else np.inf

    def statistic(self, t):
        return np.log(t) if self.power else t

    def _sum_from(self, t, theta):
        """Sum (or integral) of exp(-theta T) from t on to infinity, relative to exp(-theta T(a)) for the exponential"""
        if self.power:
            if self.discrete:
                from scipy.special import zeta

                return zeta(theta, t)
            return t ** (1.0 - theta) / (theta - 1.0)
        tail = np.exp(-theta * (t - self.a))
        return tail / -np.expm1(-theta) if self.discrete else tail / theta

    def _sum(self, t, theta):
        """Sum (or integral) from t to the upper end."""
        total = self._sum_from(t, theta)
        if np.isfinite(self.b):
            total = total - self._sum_from(self.b + 1.0 if self.discrete else self.b, theta)
        return total

    def log_z(self, theta):
        return np.log(self._sum(self.a, theta)) - (0.0 if self.power else theta * self.a)

    def share_from(self, t, theta):
        """Share of the masses >= t within the range."""
        return np.clip(self._sum(np.clip(t, self.a, None), theta) / self._sum(self.a, theta), 0.0, 1.0)

    def fit(self, t):
        """theta, its standard error, log likelihood"""
        from scipy.optimize import minimize_scalar

        mean, n = self.statistic(t).mean(), len(t)
        low = 1.0 if self.power else 0.0
        if not t.max() > t.min():
            raise HVIError("all fragments in the range have the same mass: no law can be fitted")
        guess = 1.0 / (mean - self.statistic(self.a))

        def cost(log):
            theta = low + np.exp(log)
            return theta * mean + self.log_z(theta)

        ends = np.log(guess) + np.array([-7.0, 4.0])
        with np.errstate(all="ignore"):
            best = minimize_scalar(cost, bounds=ends, method="bounded", options={"xatol": 1e-10}).x
        if min(abs(best - ends)) < 1e-3:
            raise HVIError("the masses in the range do not follow a falling law")
        above = np.exp(best)
        step = 1e-3 * above
        logs = [self.log_z(low + above + k * step) for k in (-1, 0, 1)]
        curvature = (logs[0] - 2.0 * logs[1] + logs[2]) / step**2
        return low + above, 1.0 / np.sqrt(n * curvature), -n * cost(best)

    def distance(self, t, theta):
        """Kolmogorov-Smirnov distance of sorted t from the law."""
        values, first = np.unique(t, return_index=True)
        heavier = 1.0 - first / len(t)  # share >= value, of the data
        law = self.share_from(values, theta)
        if self.discrete:
            return float(np.abs(heavier - law).max())
        return float(max(np.abs(heavier - law).max(), np.abs(np.append(heavier[1:], 0.0) - law).max()))


def fit(masses, law="power", m_min=None, m_max=np.inf, unit=None, images=1.0):
    """A Fit of the law "power" or "exponential" to fragment masses (k,), from m_min to m_max.

    m_min: default: the mass from which on the law is closest to the data (smallest Kolmogorov-Smirnov distance, at least
    FEWEST fragments); the standard error does not contain the uncertainty of this choice
    unit: particle mass, if all masses are multiples of it
    images: how many of the masses there are for each that is not merely that of an image behind mirror planes
    (Fragments.images()): error, likelihood and how many a fit needs are those of the others

    Raises HVIError if there are too few fragments or the law cannot be fitted.
    """
    if law not in LAWS:
        raise HVIError(f"the law must be {' or '.join(LAWS)}, not {law}")
    masses = np.sort(np.asarray(masses, dtype=float))
    if unit is not None and len(masses) and not np.allclose(masses / unit, np.rint(masses / unit), rtol=1e-6, atol=1e-3):
        raise HVIError(f"the masses are not multiples of {unit:g}")
    if m_min is not None and not m_min > 0.0:
        raise HVIError(f"the smallest mass must be > 0, not {m_min:g}")
    fewest = int(np.ceil(FEWEST * images - 1e-9))
    if m_min is not None:
        return _of_one(_fit_from(masses, law, m_min, m_max, unit, fewest), images)
    fits = []
    for start in _starts(masses[masses <= m_max], fewest):
        try:
            fits.append(_fit_from(masses, law, start, m_max, unit, fewest))
        except HVIError:
            continue
    if not fits:
        raise HVIError(f"no fit: {len(masses)} fragments, {fewest} of two or more different masses are needed")
    return _of_one(min(fits, key=lambda f: f.ks), images)


def _of_one(fit, images):
    return dataclasses.replace(fit, error=fit.error * images**0.5, log_likelihood=fit.log_likelihood / images)


def _starts(masses, fewest, most=60):
    """Different masses with at least fewest fragments from there on; not more than most, evenly in the logarithm"""
    starts = np.unique(masses[:max(len(masses) - fewest + 1, 0)])
    if len(starts) > most:
        wanted = np.geomspace(starts[0], starts[-1], most)
        starts = starts[np.unique(np.minimum(np.searchsorted(starts, wanted), len(starts) - 1))]
    return starts


def _fit_from(masses, law, m_min, m_max, unit, fewest):
    small = 1e-9 if unit is None else 1e-9 * unit / m_min
    if unit is not None:  # ends on whole numbers
        m_min = unit * np.ceil(m_min / unit - 1e-6)
        m_max = unit * np.floor(m_max / unit + 1e-6) if np.isfinite(m_max) else np.inf
    inside = masses[(masses >= m_min * (1 - small)) & (masses <= m_max * (1 + small))]
    if len(inside) < fewest:
        raise HVIError(f"only {len(inside)} fragments from {m_min:g} to {m_max:g}: a fit needs {fewest}")
    scale = unit or m_min
    t = np.rint(inside / unit) if unit else np.maximum(inside / m_min, 1.0)
    model = _Law(law, unit, m_min, m_max)
    theta, error, likelihood = model.fit(t)
    if law == "power":
        parameter = theta - 1.0
    else:
        parameter, error = scale / theta, scale / theta * error / theta
    if unit is None:  # density per mass, not per multiple of m_min
        likelihood -= len(t) * np.log(scale)
    heavier = int(np.sum(masses > m_max * (1 + small)))
    return Fit(law, float(parameter), float(error), float(m_min), float(m_max), len(t), heavier, unit, float(likelihood),
               model.distance(t, theta))
