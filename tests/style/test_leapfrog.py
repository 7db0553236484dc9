"""Solids with gradient corrected go by the leapfrog."""

import numpy as np
import pytest
from test_corrected import UNBROKEN, body, lump, pair, script  # noqa: F401: a fixture
from test_solid_forces import OUT, read


def block(n=5, jitter=0.05, speed=0.0):
    s = body(seed=61, n=n, periodic=False, jitter=jitter)
    s.x, s.box, s.v = s.x + 2.0, s.box + 2.0, speed * s.v
    return s


WALL = "region low block INF {0} INF INF INF INF\ngroup wall region low\ngroup free subtract all wall\nfix sph free hvi/sph walls wall\n"

@pytest.mark.parametrize("words", ["viscosity 0 0", "viscosity 1 2", "dissipation riemann"])
def test_wiggle(lmp, tmp_path, pair, words):
    s = block()
    fix = WALL.format(s.x[:, 0].min() + 1.3) + "fix move wall move wiggle 0.1 0.05 0.0 2.0\n"
    out = {}
    for elastic in (True, False):
        for n in (30, 60, 120, 240, 480):
            lmp(script(s, tmp_path, pair, words, UNBROKEN, fix=fix, elastic=elastic) + f"timestep {1.2 / n}\nrun {n}\n" + OUT.format("f"))
            d = read(tmp_path / "f")
            out[n] = np.array([d["esph"].sum(), (0.5 * (d["v"]**2).sum(1) * s.m).sum(), np.abs(d["S"]).max(), d["x"][100, 0], d["eps"].max(), d["vm"].mean()])
        k = sorted(out)
        diff = np.array([out[a] - out[b] for a, b in zip(k[:-1], k[1:])])
        print(words, elastic, out[480])
        print(diff)
        print(diff[:-1] / diff[1:])
