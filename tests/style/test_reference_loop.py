"""What has no loop in vectors: the style says so, and gives what the equations give."""

import re

import numpy as np
import pytest
from corrected import rates
from corrected_scenes import ANEW, H, body, same, script, solid
from solid_scenes import OUT, read
from sph_scenes import scene

FLUID = "pair_style hvi/sph {}\npair_coeff * * eos tait 1.0 4.0 7 h 1.25\n"
TIMES = re.compile(r"^  reference loop, pair by pair: takes about (\d) times as long as loops in vectors \(pair_style hvi/sph, Loops\)$", re.M)


def test_says_so(lmp, tmp_path, pair):
    """one line of the setup report, where it is so"""
    s = body(n=4)
    words = {"cubic": None, "gauss interface auto h variable": None, "cubic dissipation riemann": None, "quintic": 3, "lucy stock yes viscosity 1 0": 3,
             "cubic form symmetric": 3, "wendland2 dissipation riemann": 7}
    text = "".join("clear\n" + scene(s, tmp_path / "s.data", FLUID.format(w)) + "run 0\nprint 'next case'\n" for w in words)
    solids = {"": None, "dissipation riemann h variable": None, "interface 0.3": 2, "artstress 0.3 4": 2, "dissipation riemann artstress 0.3 4": 2}
    text += "".join(script(s, tmp_path, pair, w) + "run 0\nprint 'next case'\n" for w in solids)
    r = lmp(text)
    logs = r.log.split("\nnext case")[:-1]
    for log, (w, times) in zip(logs, [*words.items(), *solids.items()], strict=True):
        found = [int(number) for number in TIMES.findall(log)]
        assert found == ([times] if times else []), w
    assert not [w for w in r.warnings if "loop" in w]


def coeff(d, scale=1.0):
    """h of pair_coeff, of each particle"""
    return scale * np.array([H[t] for t in d["type"]])


TERMS = {
    "artstress": ("artstress 0.3 4", dict(art=(0.3, 4))),
    "artstress-power": ("h variable artstress 0.5 2.55", dict(art=(0.5, 2.55))),
    "interface": ("interface 0.3", dict(alpha=0.3)),
    "interface-auto": ("h variable interface auto", dict(alpha="auto")),
    "both": ("interface auto artstress 0.3 4", dict(art=(0.3, 4), alpha="auto")),
}


@pytest.mark.each_value
@pytest.mark.parametrize("tension", [True, False])
@pytest.mark.parametrize("name", TERMS)
def test_solids(lmp, tmp_path, pair, name, tension):
    """after 12 steps of bodies that expand, with yielding and failed particles: against all pairs in NumPy"""
    words, terms = TERMS[name]
    s = body(seed=61)
    s.rho *= 0.97
    lmp(script(s, tmp_path, pair, words, tension=tension) + "run 12\n" + ANEW + OUT.format("f"))
    d = read(tmp_path / "f")
    state = solid(s, d)
    if "variable" in words:  # from the density at the start
        state.h = np.clip(state.h * (0.97 * state.rho0 / state.rho) ** (1 / 3), 0.5 * state.h, 1.25 * state.h)
    terms = dict(terms, art=(*terms["art"], coeff(d))) if "art" in terms else terms
    want, without = rates(state, tension, **terms), rates(state, tension)
    assert 0.02 < state.failed.mean() < 0.5 and (d["eps"] > 0.01).mean() > 0.2
    same(d, want, case=name)
    for term, of in (("art", "f"), ("art", "de"), ("alpha", "drho")):
        if term in terms:
            assert np.abs(want[of] - without[of]).max() > 1e-3 * np.abs(want[of]).max(), (term, of)
    assert d["de"].sum() == pytest.approx(-(d["f"] * d["v"]).sum(), rel=1e-11)


@pytest.mark.parametrize("kernel", ["lucy", "quadratic", "quartic", "wendland4", "gauss"])
def test_kernels_of_solids(lmp, tmp_path, pair, kernel):
    """each by itself, beside those of test_corrected"""
    s = body(seed=62, n=6, periodic=False)
    text = script(s, tmp_path, pair, "artstress 0.3 4", kernel=kernel)
    if kernel == "lucy":
        text = text.replace("h 1.3", "h 2.6").replace("h 1.15", "h 2.3")
    lmp(text + "run 20\n" + ANEW + OUT.format("f"))
    d = read(tmp_path / "f")
    state = solid(s, d, kernel=kernel)
    if kernel == "lucy":
        state.h = 2 * state.h
    same(d, rates(state, art=(0.3, 4, state.h)))
