"""Laws fitted to N(>m): exponents that went in come out, with the error that is stated."""

import hvi
import numpy as np
import pytest
from scipy.special import zeta

SIZE = 2000


def continuous_power(rng, b, m_min, n=SIZE):
    return m_min * rng.random(n) ** (-1.0 / b)


def whole(rng, share, largest, n=SIZE):
    """whole numbers 1 ... largest with probabilities proportional to share(k)"""
    k = np.arange(1, largest + 1)
    p = share(k)
    return rng.choice(k, size=n, p=p / p.sum()).astype(float)


def samples(case, rng):
    """masses, arguments of fit(), the parameter that went in"""
    return {
        "power": lambda: (continuous_power(rng, 1.3, 2e-7), {"m_min": 2e-7}, 1.3),
        "power, tail": lambda: (continuous_power(rng, 0.8, 2e-7), {"m_min": 7e-7}, 0.8),
        "power, range": lambda: (continuous_power(rng, 0.6, 1.0), {"m_min": 2.0, "m_max": 60.0}, 0.6),
        "power, whole": lambda: (5e-7 * rng.zipf(2.6, SIZE), {"m_min": 5e-7, "unit": 5e-7}, 1.6),
        "power, whole, tail": lambda: (rng.zipf(2.0, 4 * SIZE).astype(float), {"m_min": 3.0, "unit": 1.0}, 1.0),
        "power, whole, range": lambda: (whole(rng, lambda k: k**-1.5, 400), {"m_min": 2.0, "m_max": 400.0, "unit": 1.0}, 0.5),
        "exponential": lambda: (rng.exponential(3e-6, SIZE), {"law": "exponential", "m_min": 1e-6}, 3e-6),
        "exponential, range": lambda: (rng.exponential(3.0, SIZE), {"law": "exponential", "m_min": 0.5, "m_max": 5.0}, 3.0),
        "exponential, whole": lambda: (0.1 * whole(rng, lambda k: np.exp(-k / 1.7), 99),
                                       {"law": "exponential", "m_min": 0.1, "unit": 0.1}, 0.17),
        "exponential, whole, range": lambda: (whole(rng, lambda k: np.exp(-k / 6.0), 12),
                                              {"law": "exponential", "m_min": 2.0, "m_max": 12.0, "unit": 1.0}, 6.0),
    }[case]()


CASES = ["power", "power, tail", "power, range", "power, whole", "power, whole, tail", "power, whole, range", "exponential",
         "exponential, range", "exponential, whole", "exponential, whole, range"]


@pytest.mark.parametrize("case", CASES)
def test_what_went_in_comes_out(case):
    """60 samples: no bias, and the scatter is the stated standard error"""
    rng = np.random.default_rng(5)
    fits = []
    for _ in range(60):
        masses, how, truth = samples(case, rng)
        fits.append(hvi.fit(masses, **how))
    off = np.array([(fit.parameter - truth) / fit.error for fit in fits])
    assert abs(off.mean()) < 4 / np.sqrt(60)
    assert 0.7 < off.std() < 1.35
    assert np.median([fit.ks for fit in fits]) < 1.2 / np.sqrt(fits[0].n)
    assert fits[0].error < 0.12 * truth


@pytest.mark.parametrize("case", CASES)
def test_likelihood_is_largest(case):
    """the log likelihood is that of the density of the law, and no other parameter has a larger one"""
    masses, how, _ = samples(case, np.random.default_rng(6))
    fit = hvi.fit(masses, **how)
    low, high, unit = how["m_min"], how.get("m_max", np.inf), how.get("unit")
    m = masses[(masses >= low * (1 - 1e-9)) & (masses <= high * (1 + 1e-9))]
    assert fit.n == len(m) and fit.beyond == np.sum(masses > high * (1 + 1e-9))

    def likelihood(parameter):
        def density(x):
            return x ** -(1 + parameter) if fit.law == "power" else np.exp(-x / parameter)

        if unit:
            k = np.arange(round(low / unit), (2_000_000 if np.isinf(high) else round(high / unit)) + 1)
            total = density(unit * k.astype(float)).sum()
            if np.isinf(high) and fit.law == "power":
                total += unit ** -(1 + parameter) * zeta(1 + parameter, k[-1] + 1.0)
            return np.log(density(m) / total).sum()
        if fit.law == "power":
            total = (low**-parameter - high**-parameter) / parameter
        else:
            total = parameter * (np.exp(-low / parameter) - np.exp(-high / parameter))
        return np.log(density(m) / total).sum()

    best = likelihood(fit.parameter)
    assert fit.log_likelihood == pytest.approx(best, rel=1e-7)
    for factor in (0.99, 1.01):
        assert likelihood(factor * fit.parameter) < best
    # half a unit of likelihood lies one standard error away
    assert best - likelihood(fit.parameter + fit.error) == pytest.approx(0.5, rel=0.15)


def test_formulas_of_the_paper():
    """Clauset, Shalizi & Newman eqs 3.1 and 3.2"""
    masses = continuous_power(np.random.default_rng(7), 1.5, 1.0)
    fit = hvi.fit(masses, "power", m_min=1.0)
    alpha = 1 + len(masses) / np.log(masses).sum()
    assert fit.parameter + 1 == pytest.approx(alpha, rel=1e-6)
    assert fit.error == pytest.approx((alpha - 1) / np.sqrt(len(masses)), rel=1e-4)
    assert fit.above(np.array([1.0, 2.0, 4.0])) == pytest.approx(SIZE * np.array([1.0, 2.0, 4.0]) ** -fit.parameter, rel=1e-9)
    assert fit.amplitude == pytest.approx(SIZE)


@pytest.mark.parametrize("case", CASES)
def test_curve_follows_the_data(case):
    """Fit.above() is N(>m) of the data within its noise, those beyond the range included"""
    masses, how, _ = samples(case, np.random.default_rng(8))
    fit = hvi.fit(masses, **how)
    m = np.quantile(masses[(masses >= fit.m_min) & (masses <= fit.m_max)], [0.0, 0.3, 0.6, 0.9])
    want = np.array([np.sum(masses > k * (1 + 1e-9)) for k in m])
    assert np.abs(fit.above(m) - want).max() < 4 * np.sqrt(fit.n) * 0.5


def test_start_of_the_law_is_found():
    """flat below 4, a power law above: the fit begins near 4 and has its exponent"""
    rng = np.random.default_rng(9)
    masses = np.concatenate([rng.uniform(0.5, 4.0, 1500), continuous_power(rng, 1.4, 4.0, 1500)])
    fit = hvi.fit(masses, "power")
    assert 3.3 < fit.m_min < 6.0 and abs(fit.parameter - 1.4) < 4 * fit.error


@pytest.mark.parametrize("law", hvi.distribution.LAWS)
def test_the_right_law_fits_better(law):
    """on the same range the law that made the masses has the larger likelihood and the smaller distance"""
    rng = np.random.default_rng(10)
    masses = rng.zipf(2.5, SIZE).astype(float) if law == "power" else whole(rng, lambda k: np.exp(-k / 2.0), 99)
    fits = {name: hvi.fit(masses, name, m_min=1.0, unit=1.0) for name in hvi.distribution.LAWS}
    other = next(name for name in fits if name != law)
    assert fits[law].log_likelihood > fits[other].log_likelihood + 20 and fits[law].ks < 0.5 * fits[other].ks


def test_units_do_not_matter():
    masses = np.random.default_rng(11).zipf(2.2, SIZE).astype(float)
    one, small = hvi.fit(masses, unit=1.0), hvi.fit(5e-7 * masses, unit=5e-7)
    assert small.parameter == pytest.approx(one.parameter, rel=1e-6) and small.m_min == pytest.approx(5e-7 * one.m_min)


@pytest.mark.parametrize("masses, how, message", [
    ([1.0] * 5, {}, "no fit: 5 fragments"),
    ([], {}, "no fit: 0 fragments"),
    ([1.0] * 50, {"m_min": 1.0}, "all fragments in the range have the same mass"),
    (np.arange(1.0, 60.0), {"m_min": 55.0}, "only 5 fragments from 55"),
    (np.arange(1.0, 60.0), {"law": "gauss"}, "the law must be power or exponential, not gauss"),
    (np.arange(1.0, 60.0) + 0.3, {"unit": 1.0}, "the masses are not multiples of 1"),
    (np.arange(1.0, 60.0), {"m_min": -1.0}, "smallest mass must be > 0"),
    (np.concatenate([np.full(90, 9.0), [1.0] * 10]), {"m_min": 1.0, "m_max": 9.0}, "do not follow a falling law"),
])
def test_no_fit(masses, how, message):
    with pytest.raises(hvi.HVIError, match=message):
        hvi.fit(masses, **how)


@pytest.mark.parametrize("case", ["power, tail", "exponential, whole", "power, whole, range"])
def test_images_do_not_make_it_more_certain(case):
    """four times the same masses, as of a quarter model, are one sample: error, likelihood, choice of the range, how many are needed"""
    masses, how, _ = samples(case, np.random.default_rng(8))
    one, four = hvi.fit(masses, **how), hvi.fit(np.repeat(masses, 4), images=4.0, **how)
    for name in ("parameter", "error", "log_likelihood", "ks", "m_min"):
        assert getattr(four, name) == pytest.approx(getattr(one, name), rel=1e-9), name
    assert four.n == 4 * one.n and hvi.fit(np.repeat(masses, 4), **how).error == pytest.approx(one.error / 2)
    with pytest.raises(hvi.HVIError, match="only 36 fragments .*: a fit needs 40"):
        hvi.fit(np.repeat(np.arange(1.0, 10.0), 4), m_min=1.0, images=4.0)
