"""Two particles at a time, by hand: contact and spring as LAMMPS reports them."""

import numpy as np
import pytest
from dumps import read_dump
from scenes import BOND, KAPPA, PAIR, R_CUT, R_EQ, State, contact, header, scene, spring

BOX = [[-3.0, 5.0]] * 3
MEASURE = ("compute P all pair/local dist eng force\ncompute S all bond/local dist engpot force\nfix nve all nve\n"
           "thermo_style custom step pe evdwl ebond\nthermo_modify norm no format float %.16e\nrun 0\n")
WRITE = ("write_dump all custom f.{0} id fx fy fz modify format float %.17g sort id\n"
         "write_dump all local p.{0} c_P[*] modify format float %.17g\n"
         "write_dump all local s.{0} c_S[*] modify format float %.17g\n")


def two(r, bonded, types=(1, 1)):
    """not along an axis, so that every component is seen"""
    n = np.array([2.0, -3.0, 6.0]) / 7.0
    return State([[0.1, 0.2, 0.3], np.array([0.1, 0.2, 0.3]) + r * n], 0.0, [(0, 1)] if bonded else [], BOX,
                 types=np.array(types), masses=(1.0, 2.0))


def check(result, tmp_path, k, r, want_contact, want_spring):
    (e_c, f_c), (e_s, f_s) = map(float, want_contact), map(float, want_spring)
    row = {name: column[0] for name, column in result.runs[k].items()}
    assert row["E_vdwl"] == pytest.approx(e_c, rel=1e-12, abs=1e-14)
    assert row["E_bond"] == pytest.approx(e_s, rel=1e-12, abs=1e-14)
    assert row["PotEng"] == pytest.approx(e_c + e_s, rel=1e-12, abs=1e-14)
    dump = read_dump(tmp_path / f"f.{k}")
    f = (f_c + f_s) * np.array([2.0, -3.0, 6.0]) / 7.0
    for axis, c in enumerate("xyz"):
        assert dump["f" + c] == pytest.approx([-f[axis], f[axis]], rel=1e-11, abs=1e-12), (r, c)
    for rows, e, f in ((read_dump(tmp_path / f"p.{k}").table, e_c, f_c), (read_dump(tmp_path / f"s.{k}").table, e_s, f_s)):
        for dist, energy, push in rows:
            assert (dist, energy, push) == pytest.approx((r, e, f), rel=1e-11, abs=1e-12)


DISTANCES = (0.7, 0.9, 1.0, 1.1, R_EQ - 1e-6, R_EQ + 1e-6, 1.2, 1.45, 1.499999)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("F", [1, 4])
@pytest.mark.parametrize("bonded", [True, False], ids=["bonded", "free"])
def test_energy_and_force(lmp, tmp_path, bonded, F, newton):
    """the same contact law for bonded and free pairs, a spring in tension only"""
    pair = PAIR.replace("contact", f"contact prefactor {F}")
    text = ""
    for k, r in enumerate(DISTANCES):
        text += "clear\n" + scene(two(r, bonded), tmp_path / f"{k}.data", pair=pair, newton=newton)
        text += MEASURE + WRITE.format(k)
    result = lmp(text)
    for k, r in enumerate(DISTANCES):
        check(result, tmp_path, k, r, contact(r, F=F), spring(r) if bonded else (0.0, 0.0))
        assert len(read_dump(tmp_path / f"s.{k}").table) == bonded
        assert len(read_dump(tmp_path / f"p.{k}").table) == (r < R_EQ)


@pytest.mark.parametrize("mix, epsilon, sigma", [
    ("geometric", np.sqrt(1.0 * 2.0), np.sqrt(1.0 * 1.3)),
    ("arithmetic", np.sqrt(1.0 * 2.0), (1.0 + 1.3) / 2),
    ("sixthpower", 2 * np.sqrt(2.0) * 1.3**3 / (1.0 + 1.3**6), ((1.0 + 1.3**6) / 2) ** (1 / 6)),
    ("explicit", 3.0, 0.9),
])
def test_two_types(lmp, tmp_path, mix, epsilon, sigma):
    """coefficients of unlike pairs: mixed as pair_modify says, or given; r_eq follows sigma"""
    pair = "pair_style hvi/contact\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 2.0 1.3\n"
    pair += "pair_coeff 1 2 3.0 0.9\n" if mix == "explicit" else f"pair_modify mix {mix}\n"
    cases = [(types, q) for types in ((1, 1), (1, 2), (2, 1), (2, 2)) for q in (0.9, 1.1, 1.13)]
    law = {(1, 1): (1.0, 1.0), (1, 2): (epsilon, sigma), (2, 1): (epsilon, sigma), (2, 2): (2.0, 1.3)}
    text = ""
    for k, (types, q) in enumerate(cases):
        text += "clear\n" + scene(two(q * law[types][1], False, types), tmp_path / f"{k}.data", pair=pair)
        text += MEASURE + WRITE.format(k)
    result = lmp(text)
    for k, (types, q) in enumerate(cases):
        eps, sig = law[types]
        check(result, tmp_path, k, q * sig, contact(q * sig, eps, sig), (0.0, 0.0))


@pytest.mark.parametrize("F", [1, 4])
def test_continuous_at_r_eq(lmp, tmp_path, F):
    """energy and force on either side of r_eq: with the printed shift of 1 the energy would jump by 3/4 F eps"""
    pair = PAIR.replace("contact", f"contact prefactor {F}")
    distances = [R_EQ * (1 + s * d) for d in (1e-9, 1e-6, 1e-4) for s in (-1, 1)]
    text = ""
    for k, r in enumerate(distances):
        text += "clear\n" + scene(two(r, True), tmp_path / f"{k}.data", pair=pair) + MEASURE + WRITE.format(k)
    result = lmp(text)
    for k, r in enumerate(distances):
        gap = abs(r - R_EQ)
        assert abs(result.runs[k]["PotEng"][0]) <= 60 * F * gap**2 + 1e-15
        assert np.abs(read_dump(tmp_path / f"f.{k}")["fz"]).max() <= 60 * F * gap


def test_coefficients_survive_restart_and_data(lmp, tmp_path):
    """write_restart and write_data keep all coefficients, the prefactor and the mixing"""
    s = two(0.95, True, (1, 2))
    s.x[1] = s.x[0] + [0.0, 0.0, 1.2]
    pair = "pair_style hvi/contact prefactor 2.5\npair_coeff 1 1 1.0 1.1\npair_coeff 2 2 2.0 1.3\npair_modify mix arithmetic\n"
    show = "fix nve all nve\nthermo_style custom step pe evdwl ebond\nthermo_modify norm no format float %.16e\nrun 0\n"
    text = scene(s, tmp_path / "a.data", pair=pair, bond="bond_style hvi/spring\nbond_coeff 1 31.0 1.05 1.4\n") + show
    text += "write_restart a.restart\nwrite_data b.data pair ij\n"
    text += "clear\nread_restart a.restart\n" + show
    text += f"clear\n{header()}pair_style hvi/contact prefactor 2.5\nbond_style hvi/spring\nread_data b.data\n" + show
    first, restart, data = lmp(text).runs
    e = float(contact(1.2, np.sqrt(2.0), 1.2, 2.5)[0]), 0.5 * 31.0 * 0.15**2
    assert (first["E_vdwl"][0], first["E_bond"][0]) == pytest.approx(e, rel=1e-12)
    for name in first:
        assert restart[name] == first[name]
        assert data[name] == first[name]


@pytest.mark.parametrize("d", [(1, 0, 0), (0, 1, 0), (1, 1, 1)])
def test_across_periodic_boundary(lmp, tmp_path, d):
    """a bonded pair that reaches over an edge of the box has the same force"""
    r = 1.3
    n = np.array(d) / np.linalg.norm(d)
    start = np.where(n > 0, 4.5, 1.0)
    s = State([start, start + r * n], 0.0, [(0, 1)], BOX, periodic=True)
    result = lmp(scene(s, tmp_path / "s.data") + MEASURE + WRITE.format(0))
    assert result.runs[0]["E_bond"][0] == pytest.approx(0.5 * KAPPA * (r - R_EQ) ** 2, rel=1e-12)
    f = read_dump(tmp_path / "f.0")
    assert [f["f" + c][0] for c in "xyz"] == pytest.approx(list(KAPPA * (r - R_EQ) * n), rel=1e-11, abs=1e-12)


def test_bond_style_alone_and_pair_style_alone(lmp, tmp_path):
    """neither style needs the other"""
    s = two(1.0, True)
    s.x = np.vstack([s.x, s.x[1] + [1.3, 0, 0]])
    s = State(s.x, 0.0, [(1, 2)], BOX, masses=(1.0, 1.0))
    show = "fix nve all nve\nthermo_style custom step pe\nthermo_modify norm no format float %.16e\nrun 0\n"
    a = lmp(scene(s, tmp_path / "a.data", pair="pair_style none\ncomm_modify cutoff 3.0\n", bond=BOND) + show)
    b = lmp(scene(s, tmp_path / "b.data", bond="bond_style none\n") + show)
    assert a.thermo["PotEng"][0] == pytest.approx(spring(1.3)[0], rel=1e-12)
    assert b.thermo["PotEng"][0] == pytest.approx(contact(1.0)[0], rel=1e-12)


def test_ghost_cutoff_is_asked_for(lmp, tmp_path):
    """the bond style asks for ghosts beyond r_cut by itself"""
    bond = f"bond_style hvi/spring\nbond_coeff 1 {KAPPA} {R_EQ!r} 3.5\n"
    s = State([[0, 0, 0], [3.4, 0, 0]], 0.0, [(0, 1)], [[-4.0, 7.0]] * 3)
    result = lmp(scene(s, tmp_path / "s.data", bond=bond, processors="2 1 1") + MEASURE, nranks=2)
    assert result.thermo["E_bond"][0] == pytest.approx(0.5 * KAPPA * (3.4 - R_EQ) ** 2, rel=1e-12)
    assert float(result.log.split("ghost atom cutoff = ")[1].split()[0]) >= 3.5 > R_CUT
