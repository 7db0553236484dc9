"""Forces and virial against LAMMPS's own finite differences of the energy."""

import numpy as np
import pytest
from dumps import read_dump, vectors
from scenes import PAIR, cube, scene

DIFF = """fix nve all nve
fix D all numdiff 1 1.0e-5
thermo_modify norm no
run 0
write_dump all custom f id fx fy fz f_D[1] f_D[2] f_D[3] modify format float %.17g sort id
"""
VIRIAL = """fix nve all nve
fix D all numdiff/virial 1 1.0e-5
compute W all pressure NULL virial
thermo_style custom step c_W[*] f_D[*]
thermo_modify norm no format float %.16e
run 0
"""


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("periodic", [False, True], ids=["open", "periodic"])
@pytest.mark.parametrize("F", [1, 4])
@pytest.mark.parametrize("nranks", [1, 2])
def test_forces(lmp, tmp_path, newton, periodic, F, nranks):
    """-dE/dx of a random cluster, stretched and compressed, partly broken"""
    s = cube(4, jitter=0.15, cut=0.2, periodic=periodic, types=2, seed=5)
    pair = f"pair_style hvi/contact prefactor {F}\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 1.5 0.97\n"
    lmp(scene(s, tmp_path / "s.data", pair=pair, newton=newton) + DIFF, nranks=nranks)
    dump = read_dump(tmp_path / "f")
    f = vectors(dump, "f")
    numeric = np.stack([dump[f"f_D[{k}]"] for k in (1, 2, 3)], axis=1)
    assert np.abs(f).max() > 10.0
    assert np.abs(f - numeric).max() <= 1e-7 * np.abs(f).max()


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("scale", [0.93, 1.0, 1.08], ids=["compressed", "random", "stretched"])
def test_virial(lmp, tmp_path, newton, scale):
    """-dE/dstrain of the same cluster, as LAMMPS counts pressure"""
    s = cube(4, jitter=0.1, cut=0.2, seed=6)
    s.x *= scale
    result = lmp(scene(s, tmp_path / "s.data", pair=PAIR, newton=newton) + VIRIAL)
    row = {name: column[0] for name, column in result.thermo.items()}
    w = np.array([row[f"c_W[{k}]"] for k in (1, 2, 3, 6, 5, 4)])  # xx yy zz yz xz xy, the order of the fix
    numeric = np.array([row[f"f_D[{k}]"] for k in range(1, 7)])
    assert np.abs(w - numeric).max() <= 1e-7 * np.abs(w).max()
