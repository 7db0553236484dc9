"""pair_coeff ... volume V: masses and densities from the material, also after a restart; wrong input."""

import numpy as np
import pytest

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


def state(path):
    lines = path.read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    return np.array([line.split() for line in lines[start:]], dtype=float)


OUT = "compute R all property/atom rho\ndump d all custom 1 {} id mass c_R\ndump_modify d format float %.17g sort id\n"


def test_mass_and_density(lmp, root, tmp_path):
    run(lmp, root, COEFF.format("volume 2e-9"), OUT.format("out"))
    a = state(tmp_path / "out")
    assert np.abs(a[:, 1] / (2703 * 2e-9) - 1).max() < 1e-12 and np.abs(a[:, 2] / 2703 - 1).max() < 1e-9


def test_restart_keeps_a_mass_that_was_changed(lmp, root, tmp_path):
    run(lmp, root, COEFF.format("volume 2e-9") + "\nmass 1 7e-6", "restart 1 r.*")
    lmp("read_restart r.1\nfix move all hvi/sph\nneigh_modify every 1 delay 0 check yes\n" + OUT.format("out") + "run 0\n",
        env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert state(tmp_path / "out")[:, 1] == pytest.approx(7e-6, rel=1e-12)


def test_without_it_a_density_must_be_given(lmp, root):
    assert "density 0" in run(lmp, root, COEFF.format("") + "\nmass 1 2.7e-6", expect_fail=True).log


@pytest.mark.parametrize("coeff,message", [
    (COEFF.format("volume"), "volume"), (COEFF.format("volume 0"), "volume must be > 0"), (COEFF.format("volume nan"), "volume"),
    (COEFF.format("volume 1e-9 volume 1e-9"), "unexpected volume"), ("pair_coeff 1 1 eos idealgas 1.4 h 1.2e-3 volume 1e-9", "no density at rest")], ids=str)
def test_wrong_input(lmp, root, coeff, message):
    assert message in run(lmp, root, coeff, expect_fail=True).log
