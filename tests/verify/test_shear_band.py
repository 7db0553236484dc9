"""Damage with softening by plastic displacement: the energy that a shear band takes up does not go with the spacing."""

import numpy as np
import pytest
from dumps import read_dump

H, V, Y, D1, U_F, COLUMNS = 1e-3, 20.0, 0.3e9, 0.05, 30e-6, 6
MATERIAL = """# UNITS: si
eos gruneisen
  rho0 2703
  C 5240
  S1 1.4
  g0 1.97
  a 0.48
  cp 885
strength perfect
  G 27.6e9
  Y {Y}
damage johnson-cook
  D1 {D1}
  D2 0
  D3 0
  D4 0
  D5 0
  u_f {u_f}
"""


def band(lmp, folder, n):
    """a strip, n layers high, is sheared uniformly, then held at both sides until it has parted; damage and plastic strain of its layers"""
    a = H / n
    (folder / "strip.hvi").write_text(MATERIAL.format(Y=Y, D1=D1, u_f=U_F))
    lmp(f"""units si
dimension 2
boundary p f p
atom_style sph
atom_modify map array
lattice sq {a} origin 0.5 0.5 0
region box block 0 {COLUMNS * a} {-7 * a} {H + 7 * a} {-0.5 * a} {0.5 * a} units box
create_box 1 box
region strip block INF INF {-3 * a} {H + 3 * a} INF INF units box
create_atoms 1 region strip
region inner block INF INF 0 {H} INF INF units box
group inner region inner
group ends subtract all inner
mass 1 {2703 * a * a}
set group all sph/rho 2703
variable vx atom {V / H}*y
velocity all set v_vx NULL NULL
pair_style hvi/sph cubic dim 2 dissipation riemann
pair_coeff 1 1 file strip.hvi h {1.2 * a}
neighbor {0.3 * a} bin
neigh_modify every 1 delay 0 check yes
fix move all hvi/sph
fix solid all hvi/johnson-cook strength perfect spall none
fix hold ends setforce 0 0 0
fix dt all hvi/dt 0.4
variable left equal {3**0.5 * (D1 * H + 3.5 * U_F) / V + 2e-6}-time
fix stop all halt 1 v_left <= 0 error continue message no
compute S all hvi/atom damage eps
run 1000000
write_dump inner custom out.{n} y c_S[*] modify format float %.9g sort id
""")
    f = read_dump(folder / f"out.{n}").table
    layers = f[np.argsort(f[:, 0], kind="stable")].reshape(n, COLUMNS, 3).mean(1)
    return layers[:, 1], layers[:, 2]


@pytest.mark.parametrize("layers", [(16, 32), pytest.param((16, 32, 64), marks=pytest.mark.long)], ids=len)
def test_energy_per_area(lmp, tmp_path, layers):
    """two and four times as many layers: the same energy, that of 2.2 layers in each of the bands, where a law of strain would have a half and a quarter

    A layer that has failed has taken up Y u_f/2 per area, one of damage D the part 2 D - D^2 of that. Bands come at both sides, where the strip is held.
    """
    taken = {}
    for n in layers:
        D, eps = band(lmp, tmp_path, n)
        D = np.minimum(D, 1)
        bands = 1 + (np.diff(np.flatnonzero(D > 0.05)) > 2).sum()
        taken[n] = (2 * D - D**2).sum() / bands
        print(n, "layers: bands", bands, "layers failed", (D == 1).sum(), "energy/(Y u_f/2)", taken[n], "largest plastic strain", eps.max(), D.round(2))
        assert (D == 1).any() and eps.max() > D1 + 0.9 * U_F * n / H  # the strain at failure does go with it
    energy = np.array(list(taken.values()))
    assert np.abs(energy / energy.mean() - 1).max() < 0.1
    assert 1 < energy.mean() < 3
