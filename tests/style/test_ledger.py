"""The ledger closes when it should, and shows what nobody booked, by the right amount."""

import re

import numpy as np
import pytest
from scenes import BOND, KAPPA, LEDGER, PAIR, R_CUT, R_EQ, State, books, chain, collision, cube, forces, ledger, momentum_error, scene

NVE = "fix nve all nve\n"


@pytest.mark.parametrize("newton, nranks", [("on", 1), ("off", 1), ("on", 2), ("off", 3)])
def test_closes_while_bonds_break(lmp, newton, nranks):
    """energy to 1e-5, momentum and mass to round-off, in a collision that breaks a twentieth of the bonds"""
    s = collision()
    # several ranks: a start closer to the breaking, in fewer steps
    text = scene(s, "s.data", newton=newton) + NVE + "fix step all hvi/dt 0.02\n" + ledger(every=50) + "run 2600\n"
    result = lmp(text if nranks == 1 else text.replace("dt 0.02", "dt 0.05").replace("2600", "1000"), nranks=nranks)
    book = books(result.thermo)
    assert result.thermo["Bonds"][-1] < (0.95 if nranks == 1 else 0.9) * len(s.bonds)
    assert book["broken"][-1] > 1e-3 * book["total"][0]
    assert book["ratio"][0] == 1.0
    assert np.abs(book["ratio"] - 1).max() <= (1e-5 if nranks == 1 else 2e-5)
    assert np.array_equal(book["ratio"], book["total"] / book["total"][0])
    assert momentum_error(book, s) <= 1e-12
    assert np.abs(book["mass"] / 250 - 1).max() <= 1e-12
    assert np.all(book["left_count"] == 0) and np.all(book["left"] == 0) and np.all(book["clamps"] == 0)


@pytest.mark.parametrize("newton, nranks", [("on", 1), ("off", 1), ("on", 2), ("off", 2)])
def test_burst_books_the_half_kicks(lmp, newton, nranks):
    """every bond of a block breaks: phi(r) + dt/2 F.v closes; phi(r) alone misses 1e-3 here"""
    s = cube(5, 0.02, 0.3, seed=9, margin=15)
    s.v += 4.0 * (s.x - s.x.mean(axis=0))
    result = lmp(scene(s, "s.data", newton=newton) + NVE + "timestep 0.001\n" + ledger(every=10) + "run 150\n", nranks=nranks)
    book = books(result.thermo)
    assert result.thermo["Bonds"][-1] == 0
    assert book["broken"][-1] > 0.05 * book["total"][0]
    assert np.abs(book["ratio"] - 1).max() <= 1e-5
    assert momentum_error(book, s) <= 1e-12


@pytest.mark.each_value
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("touched", [False, True], ids=["free", "kicked"])
def test_one_bond_by_hand(lmp, newton, nranks, touched):
    """phi(r) + dt/2 F.v_rel, v_rel averaged over before and after the second half kick, to the last digits"""
    dt, m = 0.01, np.array([1.0, 1.0, 3.0])
    x = np.array([[0.0, 0.0, 0.0], [1.3, 0.1, 0.0], [1.3, -0.94 if touched else -3.0, 0.3]])
    v = np.array([[-1.2, 0.3, 0.0], [1.4, 0.0, 0.5], [0.0, 1.0, 0.0]])
    s = State(x, v, [(0, 1)], [[-4.0, 5.0]] * 3, types=[1, 1, 2], masses=(1.0, 3.0))
    steps = 30
    result = lmp(scene(s, "s.data", newton=newton, processors="* 1 1") + NVE + f"timestep {dt}\n" + ledger(every=1) + f"run {steps}\n",
                 nranks=nranks)

    # the same velocity Verlet here
    broken, want, f = 0.0, [0.0], forces(s)[0]
    for _ in range(steps):
        half = s.v + 0.5 * dt * f / m[:, None]
        s.x += dt * half
        d = s.x[0] - s.x[1]
        r = np.linalg.norm(d)
        phi, pull = 0.5 * KAPPA * (r - R_EQ) ** 2, -KAPPA * (r - R_EQ) * d / r
        snap = len(s.bonds) and r > R_CUT
        if snap:
            s.bonds = s.bonds[:0]
        f = forces(s)[0]
        s.v = half + 0.5 * dt * f / m[:, None]
        if snap:
            mean = 0.5 * (half + s.v)
            broken = phi + 0.5 * dt * pull @ (mean[0] - mean[1])
        want.append(broken)
    assert broken > 0
    book = books(result.thermo)
    assert book["broken"] == pytest.approx(np.array(want), rel=1e-10, abs=1e-13)
    assert list(book["bonds_broken"]) == [float(w > 0) for w in want]


@pytest.mark.parametrize("units", ["lj", "metal", "real", "si", "cgs"])
def test_entries_are_what_lammps_says(lmp, units):
    """kinetic, contact, spring and momentum as other commands of LAMMPS compute them, in all units"""
    s = cube(3, 0.1, types=2)
    text = scene(s, "s.data", units=units) + NVE + ledger()
    text += "variable m equal mass(all)\nvariable px equal vcm(all,x)*mass(all)\n"
    text += "thermo_style custom step evdwl ebond ke v_m v_px c_book[*]\nthermo_modify norm no format float %.16e\nrun 0\n"
    row = lmp(text).thermo
    book = books(row)
    mvv2e = {"lj": 1.0, "metal": 1.0364269e-4, "real": 48.88821291**2, "si": 1.0, "cgs": 1.0}[units]
    m = np.array(s.masses)[s.types - 1]
    assert book["kinetic"][0] == pytest.approx(0.5 * mvv2e * np.sum(m[:, None] * s.v**2), rel=1e-6)
    assert book["kinetic"][0] == pytest.approx(row["KinEng"][0], rel=1e-12)
    assert book["contact"][0] == pytest.approx(row["E_vdwl"][0], rel=1e-12)
    assert book["spring"][0] == pytest.approx(row["E_bond"][0], rel=1e-12)
    assert book["mass"][0] == pytest.approx(m.sum(), rel=1e-13) == row["v_m"][0]
    assert book["px"][0] == pytest.approx(row["v_px"][0], rel=1e-10)
    assert book["total"][0] == pytest.approx(book["kinetic"][0] + book["contact"][0] + book["spring"][0], rel=1e-13)
    assert book["ratio"][0] == 1.0 and book["mass0"][0] == book["mass"][0]
    assert all(book[f"p0{c}"][0] == book[f"p{c}"][0] for c in "xyz")
    nothing = "internal broken left clamps left_px left_py left_pz jx jy jz left_mass left_count bonds_broken bonds_left viscous plastic missed voids frozen"
    assert all(book[name][0] == 0.0 for name in nothing.split())


def test_page_names_the_entries(root):
    """the table of the page, row by row, has the entries that the tests know, in their order"""
    page = (root / "doc/src/compute_hvi_energy.rst").read_text()
    rows = re.findall(r"^   (\d+)(?: - (\d+))?\| (.*)\| (energy|none|mass\*velocity|mass)$", page, re.M)
    names = [name for first, last, name, _ in rows for _ in range(int(first), int(last or first) + 1)]
    units = [unit for first, last, _, unit in rows for _ in range(int(first), int(last or first) + 1)]
    assert [int(row[0]) for row in rows][0] == 1 and len(names) == len(LEDGER) == 32
    keys = dict(p="momentum of the particles", left_p="momentum that left", j="impulse", p0="momentum at the start", mass="mass of the particles",
                left_mass="mass that left", left_count="number of particles that left", bonds_broken="number of bonds that broke",
                bonds_left="number of bonds that left", mass0="mass at the start", frozen="number of particles that are frozen", total="total, the sum", ratio="total/initial")
    for entry, name, unit in zip(LEDGER, names, units):
        key = entry[:-1] if entry[-1] in "xyz" else entry
        assert name.startswith(keys.get(key, key)), entry
        assert unit == ("mass*velocity" if entry[-1] in "xyz" else "mass" if "mass" in entry else
                        "none" if entry in ("ratio", "left_count", "bonds_broken", "bonds_left", "frozen") else "energy"), entry


# what somebody does between two runs -> change of the total, from the state before

def _kinetic(s):
    return 0.5 * np.sum(np.array(s.masses)[s.types - 1][:, None] * s.v**2)


def _without(s, keep):
    number = np.cumsum(keep) - 1
    bonds = np.array([(number[i], number[j]) for i, j in s.bonds if keep[i] and keep[j]])
    return State(s.x[keep], s.v[keep], bonds, s.box, types=s.types[keep], masses=s.masses)


def _total(s, **law):
    _, e_contact, e_spring, _ = forces(s, **law)
    return _kinetic(s) + e_contact + e_spring


def _stopped(s):
    moved = State(s.x, s.v.copy(), s.bonds, s.box, types=s.types, masses=s.masses)
    moved.v[:10] = 0.0
    return _total(moved)


def _moved(s):
    moved = State(s.x.copy(), s.v, s.bonds, s.box, types=s.types, masses=s.masses)
    moved.x[:10, 0] += 0.05
    return _total(moved)


CORRUPTIONS = {
    "velocity": ("group g id 1:10\nvelocity g set 0 0 0\n", _stopped),
    "mass": ("mass 2 1.75\n", lambda s: _total(State(s.x, s.v, s.bonds, s.box, types=s.types, masses=(1.0, 1.75)))),
    "bond_coeff": (f"bond_coeff 1 {1.01 * KAPPA} {R_EQ!r} {R_CUT}\n", lambda s: _total(s, kappa=1.01 * KAPPA)),
    "pair_coeff": ("pair_coeff * * 1.02 1.0\n", lambda s: _total(s, eps=np.full((9, 9), 1.02))),
    "displace": ("group g id 1:10\ndisplace_atoms g move 0.05 0 0 units box\n", _moved),
    "delete_atoms": ("group g id 1:10\ndelete_atoms group g bond yes compress no\n",
                     lambda s: _total(_without(s, np.arange(len(s.x)) >= 10))),
    "delete_bonds": ("group g id 1:10\ndelete_bonds g bond 1 any remove\n",
                     lambda s: _total(State(s.x, s.v, [b for b in s.bonds if min(b) >= 10], s.box, types=s.types,
                                            masses=s.masses))),
}


@pytest.mark.parametrize("what", CORRUPTIONS)
def test_shows_what_is_not_booked(lmp, what):
    """each term corrupted in turn between two runs: the total moves by what was done to it"""
    command, after = CORRUPTIONS[what]
    s = cube(4, 0.1, 0.5, types=2)
    text = scene(s, "s.data") + NVE + ledger() + "run 0\n" + command + "run 0\n"
    first, second = (books(t) for t in lmp(text).runs)
    want = after(s) - _total(s)
    assert abs(want) > 1e-3 * _total(s)
    assert first["total"][0] == pytest.approx(_total(s), rel=1e-12)
    assert second["total"][0] - first["total"][0] == pytest.approx(want, rel=1e-9)
    assert second["ratio"][0] - 1 == pytest.approx(want / _total(s), rel=1e-9)
    assert second["left"][0] == second["clamps"][0] == second["broken"][0] == 0.0


@pytest.mark.parametrize("nranks", [1, 2])
def test_bodies_at_rest_are_no_start(lmp, nranks):
    """total/initial refers to the first total that is not 0, also across a restart"""
    s = State([[0, 0, 0], [3, 0, 0]], 0.0, [], [[-8.0, 8.0]] * 3)
    laws = NVE + ledger() + "timestep 0.001\n"
    begin = scene(s, "s.data", bond="bond_style none\n") + laws + "run 0\n"
    move = "group one id 1\nvelocity one set 1 0 0\nrun 10\nvelocity one set 2 0 0\nrun 10\n"
    for text in begin + move, begin + "write_restart half\nclear\nread_restart half\n" + PAIR + laws + move:
        rest, one, two = (books(t) for t in lmp(text, nranks=nranks).runs)
        assert rest["total"][0] == 0.0 and list(rest["ratio"]) == [1.0]
        assert one["ratio"] == pytest.approx([1, 1]) and two["ratio"] == pytest.approx([4, 4]) and two["p0x"] == pytest.approx([1, 1])


def test_shows_an_unbooked_force(lmp):
    """fix addforce without clamps: total and momentum grow by its work and impulse"""
    s = cube(3, 0.02, 0.1)
    text = scene(s, "s.data") + ledger() + NVE + "fix push all addforce 0.5 0 0\ntimestep 0.002\nrun 200\n"
    book = books(lmp(text).thermo)
    t = 0.4
    drift = 0.5 * 0.25 * t**2 * 27 + 0.0  # from rest on the whole: all accelerate alike, v.F adds up to nothing
    assert book["total"][-1] - book["total"][0] == pytest.approx(drift, rel=1e-3)
    assert book["px"][-1] - book["px"][0] == pytest.approx(0.5 * t * 27, rel=1e-12)
    assert book["jx"][-1] == 0.0


def test_pulled_chain_balance(lmp):
    """a chain that flies apart: kinetic energy lost is what its broken springs took"""
    s = chain(5, R_EQ)
    s.v[:, 0] = 6.0 * (np.arange(5) - 2)
    book = books(lmp(scene(s, "s.data", pair=PAIR, bond=BOND) + NVE + "timestep 1e-4\n" + ledger() + "run 2000\n").thermo)
    assert book["spring"][-1] == 0.0 and book["contact"][-1] == 0.0 and book["bonds_broken"][-1] == 4
    assert book["kinetic"][0] - book["kinetic"][-1] == pytest.approx(book["broken"][-1], rel=1e-5)
    assert book["broken"][-1] == pytest.approx(4 * 0.5 * KAPPA * (R_CUT - R_EQ) ** 2, rel=0.02)

