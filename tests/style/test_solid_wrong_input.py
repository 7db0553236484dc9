"""fix hvi/johnson-cook: what cannot be is refused, with a message that says what is wrong."""

import pytest
from solid_scenes import MATERIAL
from sph_scenes import random_fluid, scene

PAIR = "pair_style hvi/sph cubic {words}\npair_coeff * * file {path} h 1.25\n"


@pytest.fixture
def refused(lmp, tmp_path):
    def run(message, jc="all hvi/johnson-cook", words="", text=None, fix="fix sph all hvi/sph\n", pair=None, more=""):
        path = tmp_path / "test.hvi"
        path.write_text(text or MATERIAL.format(sigma_p=3.0))
        s = random_fluid(5, h=1.25)
        pair = pair or PAIR.format(words=words, path=path)
        r = lmp(scene(s, tmp_path / "s.data", pair, fix=fix) + f"fix jc {jc}\n" + more + "run 0\n", expect_fail=True)
        assert message in r.error, r.error

    return run


@pytest.mark.parametrize("words, message", [
    ("spall", "Illegal fix hvi/johnson-cook spall command: missing argument"),
    ("spall tension", "spall must be none, pressure, principal, zero, voids, tuler-butcher or grady, not tension"),
    ("temperature hot", "temperature must be energy or work, not hot"),
    ("damage maybe", "maybe"),
    ("weibull 3", "Illegal fix hvi/johnson-cook weibull command: missing argument"),
    ("weibull 0 1", "weibull modulus must be 0.01 or more, not 0"),
    ("weibull -2 1", "weibull modulus must be 0.01 or more, not -2"),
    ("weibull nan 1", "nan"),
    ("weibull inf 1", "inf"),
    ("weibull 3 0", "weibull seed must be > 0, not 0"),
    ("weibull 3 -1", "weibull seed must be > 0, not -1"),
    ("weibull 3 1.5", "1.5"),
    ("weibull 3 1 damage no", "weibull scatters damage: it needs damage yes"),
    ("strain 1", "Unknown fix hvi/johnson-cook keyword: strain"),
    ("strength perfect", "no material has a section strength perfect"),
    ("strength rubber", "no material has a section strength rubber")])
def test_words(refused, words, message):
    refused(message, jc=f"all hvi/johnson-cook {words}")


def test_what_it_needs(refused):
    text = MATERIAL.format(sigma_p=3.0)
    refused("needs fix hvi/sph, which calls it", fix="")
    refused("fix hvi/johnson-cook works with form sum", words="form symmetric")
    refused("More than one fix hvi/johnson-cook", more="fix other all hvi/johnson-cook\n")
    refused("has no section damage johnson-cook; use damage no", jc="all hvi/johnson-cook damage johnson-cook",
            text=text[:text.index("damage")] + text[text.index("spall"):])
    refused("no material has a section strength", pair="pair_style hvi/sph cubic\npair_coeff * * eos tait 1.0 4.0 7 h 1.2\n")
    refused("needs fix hvi/johnson-cook", jc="all hvi/dt 0.2", more="compute s all hvi/atom damage\nrun 0\n")


@pytest.mark.parametrize("words", ["gradient plain", "dissipation riemann gradient law"])
def test_uncorrected_gradients(refused, words):
    refused("Pair style hvi/sph: gradient plain and gradient law were removed: leave the word out, for solids have corrected gradients", words=words)


@pytest.mark.parametrize("words, message", [
    ("artstress", "Illegal pair_style hvi/sph artstress command: missing argument"),
    ("artstress 0.3", "Illegal pair_style hvi/sph artstress command: missing argument"),
    ("artstress -0.3 4", "artstress must be >= 0, not -0.3"),
    ("artstress 0.3 -4", "artstress must be >= 0, not -4"),
    ("artstress 0.3 0", "artstress needs 0 < n <= 50, not 0"),
    ("artstress 0.3 51", "artstress needs 0 < n <= 50, not 51"),
    ("artstress some 4", "some"),
    ("artstress 0.3 four", "four"),
    ("artstress nan 4", "nan"),
    ("artstress 0.3 inf", "inf"),
    ("artstress 0.3 4 form symmetric", "works with form sum")])
def test_artificial_stress(refused, words, message):
    refused(message, words=words)


def test_artificial_stress_needs(refused):
    refused("artstress needs fix hvi/johnson-cook, which keeps the stress", words="artstress 0.3 4", jc="all hvi/dt 0.2")
    # a row of h 0.4: the next particle is beyond its reach
    path = "pair_style hvi/sph cubic artstress 0.3 4\npair_coeff * * file test.hvi h 0.4\n"
    refused("is beyond the reach of its h 0.4", pair=path, more="set group all sph/rho 0.9\n")
