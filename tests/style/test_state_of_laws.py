"""What one law has begun in the state of solids is refused by others that would misread it: data files, which do not say by which law they
came to be, and changes of material and group between runs."""

import numpy as np
import pytest
import voids_scenes as voids
from solid_scenes import FIXES, MATERIAL, SOFT, reader, start, state

LAWS = voids.VOIDS + "spall tuler-butcher\n  sigma_0 0.1\n  lambda 2\n  K 0.004\nspall grady\n  eps_c 0.02\n"
HARD, SOFT = (text.format(sigma_p=3.0) + LAWS for text in (MATERIAL, SOFT))
JC = "damage no spall "


def write(lmp, tmp_path, text, jc, nranks=1):
    path = tmp_path / "law.hvi"
    path.write_text(text)
    lmp(start(state(seed=23), tmp_path, path, steps=30, jc=jc) + "write_data half.data\n" + voids.OUT.format("half"), nranks=nranks)
    return path, voids.read(tmp_path / "half")


def again(path, jc, sections=True):
    text = reader(path, jc=jc)
    return text.replace("fix jc NULL jc_forces", "fix jc NULL jc_forces fix jc NULL jc_voids") if sections else text


@pytest.mark.each_value
@pytest.mark.parametrize("law, others, what", [
    ("voids", ("tuler-butcher", "grady", "principal", "none"), "have voids, by spall voids, but are of strength johnson-cook"),
    ("tuler-butcher", ("voids", "grady", "pressure", "none"), "have impulse used up, by spall tuler-butcher, but are of strength johnson-cook")])
@pytest.mark.parametrize("nranks", [1, 3])
def test_spall(lmp, tmp_path, law, others, what, nranks):
    """a part of K that was damage by voids, or tension that comes back: refused, with how many particles, whose law, and what to do"""
    path, half = write(lmp, tmp_path, HARD, JC + law, nranks)
    begun = (half["spalled"] == 0) & (half["void_damage"] > 0)
    assert begun.sum() > 5 and half["spalled"].sum() > 5
    for other in others:
        r = lmp(again(path, JC + other) + "run 1\n", nranks=nranks, expect_fail=True)
        numbers = [int(word) for word in r.error.split("Fix hvi/johnson-cook: ")[1].split()[:1]]
        assert what in r.error and "unfix jc and give it anew" in r.error, r.error
        assert 0 < numbers[0] < begun.sum() and "of type 1 (material " in r.error, other
        assert ("spall " + other in r.error.split("but are of")[1]) == (other != "none")
    r = lmp(again(path, JC + law) + voids.OUT.format("read"), nranks=nranks)
    assert np.array_equal(voids.read(tmp_path / "read")["void_damage"], half["void_damage"])
    # as it says
    lmp(again(path, JC + others[0]) + f"unfix jc\nfix jc all hvi/johnson-cook {JC}{others[0]}\n" + voids.OUT.format("anew"), nranks=nranks)
    assert not voids.read(tmp_path / "anew")["void_damage"].any()


def test_softening(lmp, tmp_path):
    """damage by a law with u_f is how far it has softened, by one without how far it is from failure"""
    path, half = write(lmp, tmp_path, SOFT, "spall none")
    assert ((half["damage"] > 0) & (half["damage"] < 1)).sum() > 5
    lmp(again(path, "spall none") + "run 1\n")
    r = lmp(again(path, JC + "none") + "run 1\n", expect_fail=True)
    assert "have damage that softens, by damage of a law with u_f, but are of" in r.error
    path.write_text(HARD)
    r = lmp(again(path, "spall none") + "run 1\n", expect_fail=True)
    assert "have damage that softens, by damage of a law with u_f, but are of" in r.error
    path, half = write(lmp, tmp_path, HARD, "spall none")
    lmp(again(path, JC + "none", False) + "run 1\n")  # no damage is no other damage
    path.write_text(SOFT)
    r = lmp(again(path, "spall none", False) + "run 1\n", expect_fail=True)
    assert "have damage that does not soften, by damage of a law without u_f, but are of" in r.error and "with softening" in r.error


def test_nothing_begun(lmp, tmp_path):
    """laws without a state of their own change as they like; so does rubble"""
    path, half = write(lmp, tmp_path, HARD.replace("sigma_p 3.0", "sigma_p 0.5"), JC + "principal")
    assert half["spalled"].sum() > 5
    for law in ("voids", "tuler-butcher", "grady", "zero", "none"):
        lmp(again(path, JC + law, False) + voids.OUT.format("read"))
        assert np.array_equal(voids.read(tmp_path / "read")["spalled"], half["spalled"]), law


@pytest.mark.parametrize("nranks", [1, 2])
def test_other_material_or_group(lmp, tmp_path, nranks):
    """particles that are no more of the law, between runs and from a data file"""
    path, half = write(lmp, tmp_path, HARD, JC + "voids")
    without = tmp_path / "without.hvi"
    without.write_text(MATERIAL.format(sigma_p=3.0))
    text = again(path, JC + "voids")
    other = f"pair_coeff 2 2 file {without} h 1.25\n"
    for more in (other + "run 1\n", "run 1\n" + other + "run 1\n"):
        r = lmp(text + more, nranks=nranks, expect_fail=True)
        assert f"of type 2 (material {without}) have voids, by spall voids, but are of strength johnson-cook in this run" in r.error, r.error
    some = text.replace(FIXES.split("\n")[1].format(JC + "voids"), "group one type 1\nfix jc one hvi/johnson-cook " + JC + "voids")
    r = lmp(some + "group one type 1\nrun 1\n", nranks=nranks, expect_fail=True)
    assert "of type 2" in r.error and "no solid, outside of group one," in r.error, r.error
