"""Spall by an impulse or at Grady's limit in a scene: restart, data files, ranks, what it does, what is refused."""

import numpy as np
import pytest
import voids_scenes as voids
from solid_scenes import FIXES, MATERIAL, NEIGHBOR, reader, start, state

LAWS = {"tuler-butcher": "spall tuler-butcher\n  sigma_0 0.1\n  lambda 2\n  K 0.004\n",
        "grady": "spall grady\n  eps_c 0.02\n"}
JC = "damage no spall "


@pytest.fixture
def material(tmp_path):
    path = tmp_path / "laws.hvi"
    path.write_text(MATERIAL.format(sigma_p=3.0) + "".join(LAWS.values()))
    return path


def parted(f, law):
    """some have spalled, some have not; of an impulse a part is there"""
    assert 5 < f["spalled"].sum() < 500 and not f["voids"].any()
    if law == "tuler-butcher":
        assert ((f["void_damage"] > 0.01) & (f["spalled"] == 0)).sum() > 5 and (f["spalled"] == (f["void_damage"] == 1)).all()
    assert (f["vm"][f["spalled"] == 1] == 0).all() and (f["p"][f["spalled"] == 1] >= 0).all()


@pytest.mark.each_value
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("nranks, words", [(1, "viscosity 1 2"), (2, "viscosity 1 2 h variable")])
def test_restart(lmp, tmp_path, material, law, nranks, words):
    """30 steps, restart, 30 more: the same bits as 60 at once"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, words, steps=0, sort=False, jc=JC + law, more="restart 30 half\n") + "run 59\n" + voids.OUT.format("whole"), nranks=nranks)
    lmp("read_restart half.30\n" + NEIGHBOR + FIXES.format(JC + law) + "run 29\n" + voids.OUT.format("part"), nranks=nranks)
    one, two = voids.read(tmp_path / "whole"), voids.read(tmp_path / "part")
    parted(one, law)
    for name in one:
        assert np.array_equal(one[name], two[name]), name


@pytest.mark.parametrize("law", LAWS)
def test_ranks(lmp, tmp_path, material, law):
    text = start(state(seed=23), tmp_path, material, steps=40, jc=JC + law) + voids.OUT
    lmp(text.format("one"))
    one = voids.read(tmp_path / "one")
    parted(one, law)
    for nranks in (2, 4):
        lmp(text.format("all"), nranks=nranks)
        got = voids.read(tmp_path / "all")
        assert np.array_equal(one["spalled"], got["spalled"]), nranks
        for name in one:
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * max(1.0, np.abs(one[name]).max()), name


@pytest.mark.each_value
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("nranks", [1, 3])
def test_data_file(lmp, tmp_path, material, law, nranks):
    """30 steps, write_data, read_data, 30 more: as if not interrupted"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=0, jc=JC + law) + "run 30\nwrite_data half.data\n" + voids.OUT.format("half") + "run 30\n" + voids.OUT.format("whole"))
    text = reader(material, jc=JC + law)
    has_state = law == "tuler-butcher"
    assert ("\njc_voids # id voids damage work initiation\n" in (tmp_path / "half.data").read_text()) == has_state
    if has_state:
        text = text.replace("fix jc NULL jc_forces", "fix jc NULL jc_forces fix jc NULL jc_voids")
    lmp(text + voids.OUT.format("read") + "run 30\n" + voids.OUT.format("part"), nranks=nranks)
    half, whole, again, part = (voids.read(tmp_path / f) for f in ("half", "whole", "read", "part"))
    parted(whole, law)
    for one, two, tolerance in ((half, again, 1e-13), (whole, part, 1e-9)):
        for name in one:
            assert np.abs(one[name] - two[name]).max() <= tolerance * max(1.0, np.abs(one[name]).max()), name


def test_impulse(lmp, tmp_path, material):
    """what each step uses up of K, from the stress at its end; that in the forces has an energy that was extrapolated"""
    frames = "".join(f"run 1\n{voids.OUT.format(f'f.{k}')}" for k in range(8))
    lmp(start(state(seed=23), tmp_path, material, steps=10, jc=JC + "tuler-butcher") + frames)
    f = [voids.read(tmp_path / f"f.{k}") for k in range(8)]
    n = 0
    for step, (one, two) in enumerate(zip(f, f[1:])):
        stress = np.array([[two["sxx"], two["sxy"], two["sxz"]], [two["sxy"], two["syy"], two["syz"]], [two["sxz"], two["syz"], two["szz"]]])
        above = np.maximum(np.linalg.eigvalsh(stress.transpose(2, 0, 1))[:, 2] - 0.1, 0)
        sound = two["spalled"] == 0
        assert (two["void_damage"] - one["void_damage"])[sound] == pytest.approx(0.004 * above[sound] ** 2 / 0.004, rel=0.03, abs=1e-4)
        n += (above[sound] > 0).sum()
    assert n > 100


def test_grady(lmp, tmp_path, material):
    """who has spalled in a step was at the limit of its yield stress, and who has not is below it; 3 %: rates and energy of the forces are extrapolated"""
    frames = "".join(f"run 1\n{voids.OUT.format(f'f.{k}')}" for k in range(8))
    lmp(start(state(seed=23), tmp_path, material, steps=10, jc=JC + "grady") + frames)
    f = [voids.read(tmp_path / f"f.{k}") for k in range(8)]
    near = parted = 0
    for step, (one, two) in enumerate(zip(f, f[1:])):
        stress = np.array([[two["sxx"], two["sxy"], two["sxz"]], [two["sxy"], two["syy"], two["syz"]], [two["sxz"], two["syz"], two["szz"]]])
        largest = np.linalg.eigvalsh(stress.transpose(2, 0, 1))[:, 2]
        flows = (two["spalled"] == 0) & (two["eps"] > one["eps"] + 1e-6)  # on the yield surface: Y is von Mises's stress
        limit = np.sqrt(2 * two["rho"] * 16 * 0.02 * two["vm"])
        assert (largest[flows] < 1.03 * limit[flows]).all(), step
        near += (largest[flows] > 0.8 * limit[flows]).sum()
        new = (two["spalled"] == 1) & (one["spalled"] == 0)
        stress = np.array([[one["sxx"], one["sxy"], one["sxz"]], [one["sxy"], one["syy"], one["syz"]], [one["sxz"], one["syz"], one["szz"]]])
        before = np.linalg.eigvalsh(stress.transpose(2, 0, 1))[:, 2] / np.sqrt(2 * one["rho"] * 16 * 0.02 * 0.25)
        assert (before[new] > 0.6).all(), step
        parted += new.sum()
    assert near > 5 and parted > 5


@pytest.mark.parametrize("law", ["principal", "grady", "voids", "damage"])
def test_fragments(lmp, tmp_path, material, law):
    """size of fragments from the rate at which a particle's density falls when it fails, and from then on; nothing of what is sound"""
    energy = {"grady": 0.25 * 0.02, "voids": 0.5 * 0.6 * 0.04}
    text = MATERIAL.format(sigma_p=0.5) + (LAWS["grady"] if law == "grady" else voids.VOIDS)
    material.write_text(text)
    jc = "damage yes spall none" if law == "damage" else JC + law
    frames = "".join(f"run 1\n{voids.OUT.format(f'f.{k}')}" for k in range(25))
    lmp(start(state(seed=23), tmp_path, material, steps=10, jc=jc) + frames)
    f = [voids.read(tmp_path / f"f.{k}") for k in range(25)]
    n = 0
    for k, (one, two) in enumerate(zip(f, f[1:])):
        failed = two["vm"] == 0  # S of rubble is 0
        assert (two["fragsize"][~failed] == 0).all()
        old = failed & (one["vm"] == 0)
        assert np.array_equal(one["fragsize"][old], two["fragsize"][old])
        new = failed & (one["vm"] != 0)
        if law == "voids":
            began = [next((j for j in range(k + 1) if f[j]["void_damage"][i] > 0.01), k + 1) for i in np.flatnonzero(new)]
            new[np.flatnonzero(new)[np.array(began, dtype=int) == 0]] = False
            began = [j for j in began if j]
        else:
            began = [k + 1] * new.sum()
        for i, j in zip(np.flatnonzero(new), began):
            rate = -np.log(f[j]["rho"][i] / f[j - 1]["rho"][i]) / 0.004
            want = np.sqrt(8 * energy.get(law, energy["voids"])) / rate if rate > 0 else 0.0
            assert two["fragsize"][i] == pytest.approx(want, rel=0.05, abs=0.0 if abs(rate) > 0.05 else np.inf), (i, j, rate)
        n += new.sum()
    assert n > 5


def test_unknown_fragments(lmp, tmp_path, material):
    """of a material without an energy of spall the size is 0, unknown"""
    material.write_text(MATERIAL.format(sigma_p=0.5))
    lmp(start(state(seed=23), tmp_path, material, steps=40, jc=JC + "principal") + voids.OUT.format("f"))
    f = voids.read(tmp_path / "f")
    assert f["spalled"].sum() > 5 and not f["fragsize"].any()


def test_wrong_input(lmp, tmp_path, material):
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=3, jc=JC + "tuler-butcher") + "write_restart half\n")
    r = lmp("read_restart half\n" + NEIGHBOR + FIXES.format("damage no spall voids") + "run 1\n", expect_fail=True)
    assert "was written with strength johnson-cook damage no spall tuler-butcher" in r.error and "spall voids" in r.error
    law = LAWS["tuler-butcher"]
    for wrong, message in (("sigma_0 0.1", "sigma_0 = -1"), ("lambda 2", "lambda = 0"), ("K 0.004", "K = 0"), ("  K 0.004\n", "missing key K")):
        material.write_text(MATERIAL.format(sigma_p=3.0) + law.replace(wrong, message.replace(" = ", " ") if "=" in message else ""))
        r = lmp(start(s, tmp_path, material, steps=0, jc=JC + "tuler-butcher"), expect_fail=True)
        assert "spall tuler-butcher" in r.error and message in r.error, r.error
    material.write_text(MATERIAL.format(sigma_p=3.0) + LAWS["grady"])
    r = lmp(start(s, tmp_path, material, steps=0, jc="strength none spall grady") + "run 0\n", expect_fail=True)
    assert "has no yield stress, which spall grady takes its limit from" in r.error, r.error
    material.write_text(MATERIAL.format(sigma_p=3.0))
    for law in LAWS:
        r = lmp(start(s, tmp_path, material, steps=1, jc=JC + law))
        assert any(f"has no section spall {law} and does not spall" in w for w in r.warnings)
