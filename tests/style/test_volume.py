"""pair_coeff ... volume V and spacing A: masses, densities, h and skin, also after a restart; wrong input."""

import re

import numpy as np
import pytest
from dumps import read_dump

HEAD = """units si
atom_style sph
atom_modify map array
boundary f f f
lattice sc 1e-3
region box block -5 5 -5 5 -5 5
create_box 1 box
region ball sphere 0 0 0 2.5
create_atoms 1 region ball
pair_style hvi/sph cubic
{coeff}
fix move all hvi/sph
timestep 1e-9
neigh_modify every 1 delay 0 check yes
{more}
run 1
"""
COEFF = "pair_coeff 1 1 file Al6061-T6.hvi h 1.2e-3 {}"


def run(lmp, root, coeff, more="", **kw):
    return lmp(HEAD.format(coeff=coeff, more=more), env={"LAMMPS_POTENTIALS": str(root / "potentials")}, **kw)


OUT = "compute R all property/atom rho\ndump d all custom 1 {} id mass c_R\ndump_modify d format float %.17g sort id\n"


def test_mass_and_density(lmp, root, tmp_path):
    run(lmp, root, COEFF.format("volume 2e-9"), OUT.format("out"))
    a = read_dump(tmp_path / "out").table
    assert np.abs(a[:, 1] / (2703 * 2e-9) - 1).max() < 1e-12 and np.abs(a[:, 2] / 2703 - 1).max() < 1e-9


def test_restart_keeps_a_mass_that_was_changed(lmp, root, tmp_path):
    run(lmp, root, COEFF.format("volume 2e-9") + "\nmass 1 7e-6", "restart 1 r.*")
    lmp("read_restart r.1\nfix move all hvi/sph\nneigh_modify every 1 delay 0 check yes\n" + OUT.format("out") + "run 0\n",
        env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert read_dump(tmp_path / "out")["mass"] == pytest.approx(7e-6, rel=1e-12)


def test_without_it_a_density_must_be_given(lmp, root):
    assert "has no density at step" in run(lmp, root, COEFF.format("") + "\nmass 1 2.7e-6", expect_fail=True).log


FILE = "pair_coeff 1 1 file Al6061-T6.hvi "


def cutoff(r):
    """of the neighbor lists: reach of the kernel and skin"""
    return float(re.findall(r"master list distance cutoff = (\S+)", r.log)[-1])


@pytest.mark.parametrize("words, h, mass", [("spacing 0.9e-3", 1.08e-3, 2703 * 0.9e-3**3), ("spacing 0.9e-3 h 1.3e-3", 1.3e-3, 2703 * 0.9e-3**3),
                                            ("h 1.3e-3 spacing 0.9e-3 volume 5e-10", 1.3e-3, 2703 * 5e-10)])
def test_spacing(lmp, root, tmp_path, words, h, mass):
    """h, mass, density, skin: those of longhand, to the last digit"""
    r = run(lmp, root, FILE + words, OUT.format("out"))
    a = read_dump(tmp_path / "out").table
    assert np.abs(a[:, 1] / mass - 1).max() < 1e-12 and np.abs(a[:, 2] / 2703 - 1).max() < 1e-9
    assert cutoff(r) == pytest.approx(2 * h + 0.7 * 0.9e-3, rel=1e-6)
    run(lmp, root, FILE + f"h {h:.17g} volume {mass / 2703:.17g}\nneighbor 0.63e-3 bin", OUT.format("other"))
    assert read_dump(tmp_path / "other").table == pytest.approx(a, rel=1e-12)


@pytest.mark.parametrize("dim, power", [(1, 1), (2, 2)])
def test_spacing_below_three_dimensions(lmp, root, tmp_path, dim, power):
    text = HEAD.replace("hvi/sph cubic", f"hvi/sph cubic dim {dim}").replace("region ball sphere 0 0 0 2.5", "region ball block -5 5 0 0 0 0")
    lmp(text.format(coeff=FILE + "spacing 1e-3", more=OUT.format("out")), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert np.abs(read_dump(tmp_path / "out")["mass"] / (2703 * 1e-3**power) - 1).max() < 1e-12


def test_spacing_leaves_other_masses(lmp, root, tmp_path):
    """those of mass and of data files; not those of an earlier pair_coeff, which are of its material"""
    run(lmp, root, "mass 1 7e-6\n" + FILE + "spacing 1e-3", OUT.format("out"))
    assert read_dump(tmp_path / "out")["mass"] == pytest.approx(7e-6, rel=1e-12)
    run(lmp, root, FILE + "spacing 1e-3\nmass 1 7e-6\n" + FILE + "spacing 1e-3", OUT.format("after"))
    assert read_dump(tmp_path / "after")["mass"] == pytest.approx(7e-6, rel=1e-12)
    run(lmp, root, FILE + "spacing 1e-3\npair_coeff 1 1 file Cu-OFHC.hvi spacing 1e-3", OUT.format("copper"))
    assert read_dump(tmp_path / "copper")["mass"] == pytest.approx(8930e-9, rel=1e-3)


def test_mass_of_another_material(lmp, root, tmp_path):
    """when the pair style is given again it is replaced; after a restart file it stays, with a warning that names it"""
    again = "pair_style hvi/sph cubic\npair_coeff 1 1 file Cu-OFHC.hvi spacing 1e-3"
    r = run(lmp, root, FILE + "spacing 1e-3\n" + again, OUT.format("out"))
    assert read_dump(tmp_path / "out")["mass"] == pytest.approx(8930e-9, rel=1e-3) and not [w for w in r.warnings if "keeps its mass" in w]
    run(lmp, root, FILE + "spacing 1e-3", "restart 1 r.*")
    r = lmp(f"read_restart r.1\n{again}\nfix move all hvi/sph\nneigh_modify every 1 delay 0 check yes\nrun 0\n", env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert [w for w in r.warnings if "type 1 keeps its mass 2.703e-06, that of Cu-OFHC.hvi at a spacing of 0.001 is 8.9" in w]


def test_skin_follows_spacings(lmp, root):
    """of the last pair_coeff, run after run"""
    r = run(lmp, root, FILE + "spacing 0.9e-3", "run 1\ninfo comm\n" + FILE + "spacing 0.8e-3 h 1.08e-3\nrun 0\ninfo comm")
    found = [float(c) for c in re.findall(r"^Communication cutoff = (\S+)", r.log + r.stdout, re.M)][:2]
    assert found == pytest.approx([2.16e-3 + 0.63e-3, 2.16e-3 + 0.56e-3], rel=1e-6)


def test_density_without_an_answer(lmp, root):
    """-1, too, which no particle was asked for before"""
    assert "no answer at density -1 " in run(lmp, root, FILE + "spacing 1e-3", "set atom 1 sph/rho -1", expect_fail=True).log


def test_skin_is_the_users(lmp, root):
    """one that is given; without a spacing; under hybrid, whose other styles have needs of their own"""
    text = FILE + "spacing 0.9e-3"
    assert cutoff(run(lmp, root, text + "\nneighbor 0.2e-3 bin")) == pytest.approx(2.36e-3, rel=1e-6)
    assert cutoff(run(lmp, root, FILE + "h 1.08e-3 volume 0.729e-9")) == pytest.approx(3.16e-3, rel=1e-6)
    hybrid = HEAD.replace("pair_style hvi/sph cubic", "pair_style hybrid/overlay hvi/sph cubic zero 1e-3")
    coeff = "pair_coeff 1 1 hvi/sph file Al6061-T6.hvi spacing 0.9e-3\npair_coeff * * zero"
    assert cutoff(lmp(hybrid.format(coeff=coeff, more=""), env={"LAMMPS_POTENTIALS": str(root / "potentials")})) == pytest.approx(3.16e-3, rel=1e-6)


def test_spacing_after_a_restart(lmp, root, tmp_path):
    """skin and h; masses are those of the file, whatever the input gives again"""
    run(lmp, root, FILE + "spacing 0.9e-3\nmass 1 7e-6", "restart 1 r.*")
    for again in ("", "pair_style hvi/sph cubic\n" + FILE + "spacing 0.9e-3\n"):
        r = lmp(f"read_restart r.1\n{again}fix move all hvi/sph\nneigh_modify every 1 delay 0 check yes\n" + OUT.format("out") + "run 0\n",
                env={"LAMMPS_POTENTIALS": str(root / "potentials")})
        assert cutoff(r) == pytest.approx(2.79e-3, rel=1e-6), again
        assert read_dump(tmp_path / "out")["mass"] == pytest.approx(7e-6, rel=1e-12), again
        (tmp_path / "out").unlink()


@pytest.mark.parametrize("coeff,message", [
    (FILE + "spacing", "spacing"), (FILE + "spacing 0", "spacing must be > 0"), (FILE + "spacing 1e-3 spacing 1e-3", "unexpected spacing"),
    (FILE + "1e-3", "h or spacing and its value, not 1e-3"), ("pair_coeff 1 1 eos idealgas 1.4 spacing 1e-3", "no density at rest"),
    (FILE + "spacing 1e-3 strength none strength none", "unexpected strength"),
    (COEFF.format("volume"), "volume"), (COEFF.format("volume 0"), "volume must be > 0"), (COEFF.format("volume nan"), "volume"),
    (COEFF.format("volume 1e-9 volume 1e-9"), "unexpected volume"), ("pair_coeff 1 1 eos idealgas 1.4 h 1.2e-3 volume 1e-9", "no density at rest")], ids=str)
def test_wrong_input(lmp, root, coeff, message):
    assert message in run(lmp, root, coeff, expect_fail=True).log
