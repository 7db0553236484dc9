"""What computes say of walls of elements, at any step that somebody looks at."""

import numpy as np
import pytest
from fem_scenes import EDGE, STATE, read_state, start, strike_plate

LOOK = """compute state all hvi/atom p e eps sxx syy szz sxy sxz syz damage voids void_damage vm
compute most all reduce max c_state[*]
compute sum all reduce sum vx vy vz
compute ke all ke
compute w all hvi/wall axis z wall 2 {low} {high} nodes 3 layers 4
variable power equal c_w[1][6]
fix first all ave/time 7 1 7 c_most[*] c_sum[*] c_ke v_power file first format " %.17g"
"""


@pytest.mark.parametrize("nranks", [1, 2])
def test_looked_at_by_fixes(lmp, nranks):
    """The same numbers by fix ave/time at steps without thermo output as at steps that have some, wherever the fix is; the run goes the same way"""
    mesh, strike_it = strike_plate()
    got = {}
    for every in (7, 100):
        text = start(mesh, every=every, fem="strain 0.1")
        for line in ("compute book", "compute state", "thermo_style", "thermo_modify"):  # the book's energies are tallied, which tells of the step
            text = "".join(row for row in text.splitlines(True) if not row.startswith(line))
        look = LOOK.format(low=-2 * EDGE, high=2 * EDGE)
        text = text.replace("fix wall all", look + "fix wall all", 1) + look.splitlines()[-1].replace("first", "last") + "\n" + strike_it
        lmp(text + "run 28\n" + STATE.format("state"), nranks=nranks)
        got[every] = {name: np.loadtxt(name) for name in ("first", "last")}, read_state("state")
    often, seldom = got[7][0], got[100][0]
    assert often["first"].shape == (5, 19) and (np.abs(often["first"][-1, [13, 16, 17, 18]]) > 0).all()
    for name in ("first", "last"):
        assert np.array_equal(often["last"], seldom[name]), name
    assert all(np.array_equal(got[7][1][k], got[100][1][k]) for k in got[7][1])
