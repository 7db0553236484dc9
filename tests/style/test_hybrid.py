"""SPH under pair_style hybrid: forces and rates are those without it, whatever is beside it, on every layout."""

import itertools

import mirror_scenes
import numpy as np
import pytest
from dumps import read_dump
from hybrid_scenes import BESIDE, COEFF, STEPS, hybrid, others, text, together
from solid_scenes import OUT, PAIR, read, state
from sph_report import tables
from sph_scenes import random_fluid, scene

RIEMANN = "pair_style hvi/sph cubic dissipation riemann h variable\npair_coeff 1 1 eos tait 1.0 4.0 7 h 1.1\npair_coeff 2 2 eos tait 1.7 3.0 7 h 1.0\n"
RIEMANN += "pair_coeff 1 2 tension yes\n"
FLUID_OUT = OUT.replace("eps damage spalled vm sxx syy szz sxy sxz syz", "p p p p p p p p p p")


def parts(kind, material):
    """a scene of SPH (two types): particles, its pair commands, its fixes, what is put out"""
    jc = "fix jc {0} hvi/johnson-cook\n"
    if kind == "solids":
        s = state(seed=51)
        s.rho *= 0.97
        return s, PAIR.format(kernel="cubic", words="artstress 0.3 4", path=material) + "pair_coeff 1 2 tension no\n", jc, OUT
    if kind == "riemann":
        return random_fluid(7, seed=53, h=[1.1, 1.0], jitter=0.15), RIEMANN, "", FLUID_OUT
    s, _ = mirror_scenes.part("xy")
    words = "viscosity 1 2 mirror x 0.0 lo mirror y 0.0 lo"
    return s, PAIR.format(kernel="cubic", words=words, path=material) + "pair_coeff 1 2 tension no\n", jc, OUT


def close(got, want, case):
    for name in want:
        if name == "type":
            continue
        scale = np.abs(want[name]).max()
        assert np.abs(got[name] - want[name]).max() <= 1e-12 * scale, (case, name)


# what is beside, and how: types of its own, the same types, nothing
CASES = [("hybrid", "lj/cut"), ("hybrid", "hvi/contact"), ("hybrid/overlay", "hvi/contact"), ("hybrid/overlay", "zero"), ("hybrid", "")]


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, pytest.param(2, marks=pytest.mark.long), 3, pytest.param(4, marks=pytest.mark.long)])
@pytest.mark.parametrize("kind", ["solids", "riemann", "mirrors"])
def test_as_without(lmp, tmp_path, material, kind, nranks):
    """10 steps, newton on and off: state, forces, rates and stress of SPH particles, and the forces of those beside them"""
    s, pair, fixes, out = parts(kind, material)
    t = others(s)
    commands = text(s, pair, fixes, out, tmp_path, "plain")
    t.type[:], t.mass = 1, {1: 1.0}
    for k, (beside, coeff) in enumerate(COEFF.items()):
        commands += "clear\n" + scene(t, tmp_path / "t.data", f"pair_style {BESIDE[beside]}\npair_coeff 1 1 {coeff.split(maxsplit=1)[1]}\n", fix="fix nve all nve\n")
        commands += f"timestep 0.004\nrun {STEPS}\ndump d all custom 1 t{k} id fx fy fz\ndump_modify d format float %.17g sort id\nrun 0\n"
    table = tables(lmp(commands).log)[0]
    want = read(tmp_path / "plain")
    if kind != "riemann":
        assert (want["eps"] > 0.001).mean() > 0.2
    alone = {beside: read_dump(tmp_path / f"t{k}").table[:, 1:] for k, beside in enumerate(COEFF)}
    assert all(np.abs(f).max() > 0.1 for f in alone.values())
    t.type[:], t.mass = 3, {**s.mass, 3: 1.0}
    cases = list(itertools.product(CASES, ("on", "off")))
    whole, commands = together(s, t), ""
    for k, ((style, beside), newton) in enumerate(cases):
        own = beside in COEFF
        commands += text(whole if own else s, hybrid(pair, style, beside), fixes, out, tmp_path, f"f{k}", "ours" if own else "all", newton=newton)
    found = tables(lmp(commands, nranks=nranks).log)
    n = len(s.x)
    assert len(found) == len(cases)
    for k, case in enumerate(cases):
        assert all(found[k][name] == table[name] for name in ("style", "rows", "terms")), case
        assert found[k]["sent"] == (table["sent"] if case[1] == "on" else [table["sent"][0], 0, 2]), case
        got = read(tmp_path / f"f{k}")
        close({name: a[:n] for name, a in got.items()}, want, case)
        if case[0][1] in alone:
            f = alone[case[0][1]]
            assert np.abs(got["f"][n:] - f).max() <= 1e-12 * np.abs(f).max(), case


def test_restart(lmp, tmp_path, material):
    """a hybrid comes back from a restart file with all that SPH needs: the same bits"""
    s, pair, fixes, out = parts("mirrors", material)
    whole = together(s, others(s))
    pair = hybrid(pair, "hybrid", "hvi/contact")
    coeffs = "".join(line for line in pair.splitlines(True) if "pair_coeff" in line)
    commands = text(whole, pair, fixes, out, tmp_path, "whole", "ours", more="restart 6 half\n", sort=False)
    lmp(commands)
    again = "read_restart half.6\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix nve rest nve\nfix sph ours hvi/sph\n"
    again = again.replace("neighbor", coeffs + "neighbor")  # LAMMPS keeps settings only of styles in a hybrid
    lmp(again + fixes.format("ours") + f"timestep 0.004\nrun {STEPS - 6}\n" + out.format("part"))
    one, two = read(tmp_path / "whole"), read(tmp_path / "part")
    for name in one:
        assert np.array_equal(one[name], two[name]), name


@pytest.mark.each_value
@pytest.mark.parametrize("nranks, newton", [(1, "on"), (2, "off"), (3, "on")])
@pytest.mark.parametrize("style", ["", "hybrid", "hybrid/overlay zero 0.5", "hybrid/overlay zero 3.0"])
def test_contacts_that_outgrow_lists(lmp, style, nranks, newton):
    """by fix adapt: an error, also through hybrid; from a sigma of pair_coeff that is large enough they are all there"""
    coeff = "pair_coeff * * " + ("hvi/contact " if style else "") + "0.1 {}\n" + ("pair_coeff * * zero\n" if "zero" in style else "")
    grow = "fix grow all adapt {} pair hvi/contact sigma * * v_s\n"
    text = f"units lj\nnewton {newton}\natom_style atomic\nlattice sc 1.0\nregion box block 0 6 0 6 0 6\ncreate_box 1 box\ncreate_atoms 1 box\n" \
        f"mass * 1.0\npair_style {style} hvi/contact\n{coeff}variable s equal 0.890898718+0.06*step\n{grow}thermo_style custom step pe\n" \
        "thermo_modify norm no\nrun 10\n"
    assert "as sigma has grown: give pair_coeff the largest sigma" in lmp(text.format(0.890898718, 1), nranks=nranks, expect_fail=True).error
    for every in 1, 5:
        assert lmp(text.format(1.6, every), nranks=nranks).thermo["PotEng"][-1] == pytest.approx(7218.7017, rel=1e-6), every


def test_scaled_is_refused(lmp, tmp_path, material):
    """its factors are for forces, not for the rates of density and energy: LAMMPS refuses it for atom_style sph"""
    s, pair, fixes, out = parts("solids", material)
    pair = hybrid(pair, "hybrid/scaled 0.5", "hvi/contact").replace(" hvi/contact\n", " 1.0 hvi/contact\n", 1)
    r = lmp(text(together(s, others(s)), pair, fixes, out, tmp_path, "f", "ours"), expect_fail=True)
    assert "Atom style is not compatible with pair_style hybrid/scaled" in r.error, r.error


@pytest.mark.parametrize("given", [True, False])
def test_types_that_lose_their_contact(lmp, tmp_path, material, given):
    """to a style that is given for all pairs, while hvi/sph has those of one type only: a warning, once"""
    s, pair, fixes, out = parts("riemann", material)
    words = hybrid(pair, "hybrid/overlay", "zero")
    assert "pair_coeff 1 2 hvi/sph tension yes\n" in words
    r = lmp(text(s, words if given else words.replace("pair_coeff 1 2 hvi/sph tension yes\n", ""), fixes, out, tmp_path, "f") + "run 1\n")
    assert r.log.count("types 1 and 2 have materials but do not feel each other") == (not given)
