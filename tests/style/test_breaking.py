"""Bonds break in tension only, at r_cut, at once, for good, whoever owns their ends."""

import itertools

import numpy as np
import pytest
from dumps import frames, read_dump
from scenes import BOND, KAPPA, R_CUT, R_EQ, State, books, chain, collision, header, ledger, read_bonds, scene

N = 12
BONDS2 = f"bond_style hvi/spring\nbond_coeff 1 {KAPPA} {R_EQ!r} {R_CUT}\nbond_coeff 2 5.0 {R_EQ!r} 1.3\n"


def pulled_chain(periodic):
    """the i-th bond will be stretched by 0.04 (2i + 1); bonds of two kinds take turns; a bond more between them"""
    s = chain(N, R_EQ, start=13.7 if periodic else -8.0, box=[[-20.0, 20.0]] * 3, periodic=periodic)
    s.x[:, 1] = 0.1 * np.arange(N) % 3
    s.bond_types = 1 + np.arange(N - 1) % 2
    return s


# pull, let go, push together by as much, let go: one period in 80 steps
MOVE = """variable s equal sin(2*PI*step/80)
variable w equal cos(2*PI*step/80)*2*PI/80/dt
variable x atom 0.04*id*id*v_s
variable v atom 0.04*id*id*v_w
fix move all move variable v_x NULL NULL v_v NULL NULL
dump x all custom 1 {0} id xu yu zu
dump_modify x format float %.17g sort id
dump b all local 1 {1} c_B[1] c_B[2]
thermo 1
thermo_style custom step bonds atoms
run 80
"""


@pytest.mark.parametrize("nranks", [1, 2, 3])
def test_chain_breaks_at_r_cut(lmp, tmp_path, nranks):
    """alive while r <= r_cut, gone at the first r beyond; never back; across ranks and edges, all newton settings"""
    cases = list(itertools.product((False, True), ("on", "off", "on off", "off on"), ("brick", "tiled")))
    text = ""
    for k, (periodic, newton, comm) in enumerate(cases):
        how = dict(newton=newton, comm=comm, processors=f"{nranks} 1 1" if comm == "brick" else "* * *")
        text += "clear\n" + scene(pulled_chain(periodic), tmp_path / f"{periodic}.data", bond=BONDS2, **how)
        text += MOVE.format(f"x.{k}", f"b.{k}")
    result = lmp(text, nranks=nranks)
    r_cut = np.where(pulled_chain(False).bond_types == 1, R_CUT, 1.3)
    for k, case in enumerate(cases):
        alive = np.ones(N - 1, dtype=bool)
        where, ends = frames(tmp_path / f"x.{k}"), frames(tmp_path / f"b.{k}")
        broken_at = {}
        for step, (x, b) in enumerate(zip(where, ends)):
            d = np.diff(x.table[:, 1:], axis=0)
            d -= 40.0 * np.round(d / 40.0)
            r = np.linalg.norm(d, axis=1)
            assert np.abs(r - r_cut).min() > 1e-9, (case, step)  # no doubt
            broken_at.update({i: step for i in np.flatnonzero(alive & (r > r_cut))})
            alive &= r <= r_cut
            want = {(i + 1, i + 2) for i in np.flatnonzero(alive)}
            got = {tuple(sorted(map(int, pair))) for pair in b.table}
            assert got == want, (case, step)
            assert result.runs[k]["Bonds"][step] == len(want), (case, step)
        assert 5 <= len(broken_at) <= 9 and len(set(broken_at.values())) >= 4, "the scene breaks bonds one by one"


@pytest.mark.parametrize("nranks", [1, 2])
def test_compression_never_breaks(lmp, tmp_path, nranks):
    """a chain pushed together to a third of its length keeps every bond, and is not pushed back by them"""
    s = chain(8, R_EQ)
    text = scene(s, tmp_path / "s.data", pair="pair_style zero 2.0\npair_coeff * *\n")
    text += (f"variable x atom -0.7*(id-1)*{R_EQ!r}*step/100\nvariable v atom 0.0\nfix move all move variable v_x NULL NULL v_v NULL NULL\n")
    text += ledger(every=10) + "run 100\n"
    result = lmp(text, nranks=nranks)
    assert np.all(result.thermo["Bonds"] == 7)
    book = books(result.thermo)
    assert np.all(book["spring"] == 0) and np.all(book["broken"] == 0)


def test_hard_squeeze_never_breaks(lmp, tmp_path):
    """a bonded pair driven together deep into contact keeps its bond until it flies apart"""
    s = State([[0, 0, 0], [R_EQ, 0, 0]], [[8.0, 0, 0], [-8.0, 0, 0]], [(0, 1)], [[-9.0, 9.0]] * 3)
    text = scene(s, tmp_path / "s.data") + "fix nve all nve\n" + ledger() + "timestep 1e-4\nrun 1200\n"
    result = lmp(text)
    book, bonds = books(result.thermo), result.thermo["Bonds"]
    assert book["contact"].max() > 60.0  # of the 64 they had
    assert np.all(bonds[:np.argmax(book["spring"])] == 1)
    assert book["broken"][-1] == pytest.approx(0.5 * KAPPA * (R_CUT - R_EQ) ** 2, rel=0.02) and bonds[-1] == 0


@pytest.mark.each_value
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("nranks", [1, 2])
def test_too_long_from_the_start(lmp, tmp_path, newton, nranks):
    """broken and booked at step 0, across ranks too; no half kick is missing then"""
    s = State([[-0.8, 0, 0], [0.9, 0, 0], [2.0, 0, 0], [3.0, 0.5, 0], [3.0, 2.3, 0]],
              [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 0], [0, 3, 0]], [(0, 1), (1, 2), (2, 3), (3, 4)], [[-4.0, 4.0]] * 3)
    text = scene(s, tmp_path / "s.data", newton=newton, processors="* 1 1") + "fix nve all nve\n"
    result = lmp(text + ledger(every=1) + "run 1\n", nranks=nranks)
    book = books(result.thermo)
    want = 0.5 * KAPPA * ((1.7 - R_EQ) ** 2 + (1.8 - R_EQ) ** 2)
    assert book["broken"] == pytest.approx([want, want], rel=1e-12)
    assert list(result.thermo["Bonds"]) == [2, 2] and list(book["bonds_broken"]) == [2, 2]


@pytest.mark.parametrize("nranks", [1, 2])
def test_owners_agree_to_the_last_digit(lmp, tmp_path, nranks):
    """newton off: both owners of a bond across the box break it or neither, though its ghosts' positions are rounded"""
    rng = np.random.default_rng(5)
    spots = np.array(list(itertools.product(range(20), range(20)))) * 3.1
    n = np.column_stack([np.ones(400), rng.uniform(-0.5, 0.5, (400, 2))])
    n *= (R_CUT / np.linalg.norm(n, axis=1))[:, None]  # to a few of the last bits, which break it or do not
    second = np.column_stack([-3.3 + n[:, 0] * rng.uniform(0.1, 0.9, 400), spots + 0.1])
    first = second + [10.1, 0, 0] - n
    box = np.array([[-3.3, 6.8], [-1.3, 61.0], [-1.3, 61.0]])
    s = State(np.vstack([first, second]), 0.0, [(i, i + 400) for i in range(400)], box, periodic=True)
    text = scene(s, "s.data", newton="off") + "compute n all nbond/atom\nfix nve all nve\n" + ledger() + "run 0\n"
    text += "write_dump all custom n id c_n modify sort id\n"
    result = lmp(text, nranks=nranks)
    count = read_dump(tmp_path / "n")["c_n"]
    assert np.array_equal(count[:400], count[400:])
    assert 40 < count[:400].sum() < 360 and result.thermo["Bonds"][0] == count[:400].sum()
    assert books(result.thermo)["bonds_broken"][0] == 400 - count[:400].sum()


def test_bonds_are_counted(lmp, tmp_path):
    """thermo bonds, the ledger's count and the bonds that are there agree at every step; written data has no others"""
    s = collision()
    text = scene(s, tmp_path / "s.data") + "fix nve all nve\ntimestep 0.001\n" + ledger(every=5)
    text += "dump b all local 5 b c_B[1] c_B[2]\nrun 600\nwrite_data out.data\n"
    text += f"write_dump all local last c_B[1] c_B[2]\nclear\n{header()}pair_style hvi/contact\nbond_style hvi/spring\n"
    text += "read_data out.data\ncompute B all property/local batom1 batom2\nfix nve all nve\n"
    text += "run 0\nwrite_dump all local again c_B[1] c_B[2]\n"
    result = lmp(text)
    thermo = result.runs[0]
    there = [len(f.table) for f in frames(tmp_path / "b")]
    assert list(thermo["Bonds"]) == there
    assert np.all(thermo["c_book[22]"] == len(s.bonds) - thermo["Bonds"])
    assert np.all(np.diff(there) <= 0) and there[-1] < 0.9 * there[0]
    assert read_bonds(tmp_path / "again") == read_bonds(tmp_path / "last") and len(read_bonds(tmp_path / "last")) == there[-1]


def test_rebuilds_do_not_matter(lmp, tmp_path):
    """the same bonds break whenever the lists are rebuilt"""
    text = ""
    for k, modify in enumerate(("every 1 delay 0 check no", "every 1 delay 0 check yes", "every 3 delay 6 check no")):
        text += "clear\n" + scene(collision(), tmp_path / "s.data", skin=0.4, sort=False, bond=BOND)
        text += f"neigh_modify {modify}\nfix nve all nve\ntimestep 0.001\nrun 600\nwrite_dump all local b.{k} c_B[1] c_B[2]\n"
    lmp(text)
    sets = [read_bonds(tmp_path / f"b.{k}") for k in range(3)]
    assert sets[0] == sets[1] == sets[2] and len(sets[0]) < 0.97 * len(collision().bonds)
