"""Elements that other styles act on: what these do to particles in elements goes to nodes, as force and as heat, and nothing is lost."""

import itertools

import numpy as np
import pytest
from fem_scenes import DX, EDGE, P, PAIR, STATE, TOTAL, plate, read_state, start, strike, strike_plate

CONTACT = f"hvi/contact {1e-2:g} {0.9 * DX:g}"  # J, m
LJ = f"lj/cut {2e-3:g} {0.8 * DX:g}"
LAYOUTS = [dict(nranks=2), dict(newton="off"), dict(nranks=3, newton="off")]


def hybrid(text, *beside):
    """The styles in this order, {} is hvi/sph; type 1 is of the others, which act between it and particles of the wall, too"""
    first, last = text.index("pair_style"), text.index("fix move")
    lines = [line.split() for line in text[first:last].split("\n")]
    coeff = "".join(" ".join([*words[:3], "hvi/sph", *words[3:]]) + "\n" for words in lines if words and words[0] == "pair_coeff" and words[1] != "1")
    styles = ""
    for style in beside:
        styles += " " + {"{}": "hvi/sph " + PAIR, "lj/cut": f"lj/cut {2.5 * DX}"}.get(style.split()[0], style.split()[0])
        if style != "{}":
            coeff += f"pair_coeff 1 1 {style}\npair_coeff 1 2 {style}\npair_coeff 1 3 none\n"
    return text[:first] + f"pair_style hybrid/overlay{styles}\n" + coeff + "pair_modify shift yes\n" + text[last:]


def books(table):
    """how far the total of energy, and momentum, stray"""
    total, momentum = table[f"c_book[{TOTAL}]"], np.column_stack([table[f"c_book[{P + k}]"] for k in range(3)])
    return np.abs(total / total[0] - 1).max(), np.abs(momentum - momentum[0]).max() / (np.abs(momentum[0]).max() or 1.0)


def struck(lmp, beside, core, dt=2e-8, nranks=1, newton="on"):
    """A ball of another style strikes the plate off its axis: elements, and free particles in the middle if there is a core"""
    mesh = plate(core=core)
    ball = strike(mesh, radius=0.8, gap=1.0, v=400.0, at=(1.2 * EDGE, 0.6 * EDGE))
    text = hybrid(start(mesh, newton=newton, every=round(1.6e-7 / dt)), *beside).replace("fix step all hvi/dt 0.4", f"timestep {dt}")
    r = lmp(text + ball + f"run {round(3.2e-6 / dt)}\n" + STATE.format("state.dump"), nranks=nranks)
    return r.thermo, read_state("state.dump")


@pytest.mark.parametrize("beside, core", [(("{}", CONTACT), 1.1), ((CONTACT, "{}"), 0), (("{}", LJ), 0), ((LJ, "{}"), 1.1)])
def test_nothing_is_lost(lmp, beside, core):
    """Momentum to round-off, energy as velocity Verlet keeps it, to the square of the step; the same on all layouts"""
    one, state = struck(lmp, beside, core)
    assert one["c_book[2]"][-1] > 0.02  # heat of the wall, J
    energy, momentum = books(one)
    finer = books(struck(lmp, beside, core, dt=1e-8)[0])
    assert momentum < 1e-14 > finer[1]
    assert finer[0] < 7e-4 and finer[0] < 0.27 * energy
    for how in LAYOUTS:
        table, got = struck(lmp, beside, core, **how)
        assert books(table)[1] < 1e-14, how
        assert all(np.abs(state[k] - got[k]).max() <= 1e-11 * np.abs(state[k]).max() for k in state), how


def test_weights(lmp):
    """One particle above a wall: force and torque on nodes are those on it with another sign, by hand; particles in elements have none left"""
    mesh = plate(core=0)
    mesh.free, mesh.free_type, mesh.free_volume = np.array([[0.05 * EDGE, -0.03 * EDGE, 0.02 * EDGE]]), np.array([1]), np.array([DX**3])
    for how in ({}, *LAYOUTS):
        lmp(hybrid(start(mesh, newton=how.get("newton", "on")), "{}", CONTACT) + "run 0\n" + STATE.format("state.dump"), nranks=how.get("nranks", 1))
        got = read_state("state.dump")
        ball, nodes, held = (got["type"] == t for t in (1, 3, 2))
        eps, sigma = map(float, CONTACT.split()[1:])
        d = got["X"][ball] - got["X"][held]
        r = np.linalg.norm(d, axis=1)[:, None]
        f = np.where(r < 2 ** (1 / 6) * sigma, eps * (12 * sigma**12 / r**14 - 6 * sigma**6 / r**8) * d, 0.0)
        assert (f != 0).any(axis=1).sum() == 4 and np.abs(got["F"][held]).max() == 0.0, how
        assert got["F"][ball][0] == pytest.approx(f.sum(axis=0), rel=1e-9), how
        assert got["F"][nodes].sum(axis=0) == pytest.approx(-f.sum(axis=0), rel=1e-9), how
        torque = np.cross(got["X"][nodes], got["F"][nodes]).sum(axis=0)
        assert torque == pytest.approx(-np.cross(got["X"][held], f).sum(axis=0), rel=1e-8), how


def test_heat(lmp):
    """Conduction between free particles and those in elements: what the core loses goes to elements, which keep it"""
    text = start(plate(), every=10).replace("pair_style hvi/sph", "pair_style hybrid/overlay sph/heatconduction hvi/sph").replace("file", "hvi/sph file")
    text = text.replace("3 3 nodes", f"3 3 hvi/sph nodes\npair_coeff 1*2 1*2 sph/heatconduction 1.0 {2.4 * DX}\npair_coeff 1*2 3 none")
    for nranks, newton in itertools.product((1, 2), ("on", "off")):
        hot = "group core subtract all wall_embedded\ngroup nodes type 3\ngroup core subtract core nodes\nset group core sph/e 1e-4\n"
        table = lmp(text.replace("newton on", f"newton {newton}") + "run 0\n" + hot + "run 40\n", nranks=nranks).runs[1]
        assert table["f_wall[10]"][-1] > 0.6 * table["c_book[8]"][0], (nranks, newton)
        assert books(table)[0] < 2e-7, (nranks, newton)


@pytest.mark.parametrize("nranks", [1, 3])
def test_fixes_act_on_nodes(lmp, nranks):
    """Forces of fixes on particles in elements only would be lost: refused by name; where nodes are in the group, too, it is theirs that count"""
    mesh, strike_it = strike_plate()
    text = start(mesh) + strike_it + "group matter type 1 2\ngroup wall type 2 3\nfix down {} addforce 0 0 -1e-3\nrun 2\n"
    r = lmp(text.format("matter"), nranks=nranks, expect_fail=True)
    assert "fix down (addforce)" in r.error and "which its group matter must have, too" in r.error
    for group in ("ball", "wall", "all"):
        lmp(text.format(group), nranks=nranks)
