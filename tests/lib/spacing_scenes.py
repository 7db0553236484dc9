"""Plates of aluminum of different spacings that meet at 2 km/s, three dimensions: plateaus, and what stands on both sides of the contact.

Lengths in m, SI units. For tests/verify/test_spacings.py and the hard cases.
"""

import dataclasses

import numpy as np
from dumps import read_dump
from reference.elastic_plastic import METALS, impact
from solid_runs import STATE, material
from sph_scenes import Fluid
from state_scenes import sections

N, SPEED, SPACING, ETA = 96, 2000.0, 1e-4, 1.2  # layers of the finer plate; h in spacings

INPUT = """units si
boundary f p p
atom_style sph
atom_modify map array
processors * 1 1
read_data {data}
pair_style hvi/sph cubic dissipation riemann
pair_coeff 1 1 file {file} h {fine:.17g}
pair_coeff 2 2 file {file} h {coarse:.17g}
neighbor {skin:.17g} bin
neigh_modify every 1 delay 0 check yes one 10000 page 1000000
{strength}
compute book all hvi/energy
fix move all hvi/sph
compute S all hvi/atom {state}
compute R all property/atom rho
thermo 50
thermo_style custom step time c_book[9]
fix step all hvi/dt 0.2
variable left equal {end:.17g}-time
fix halt all halt 1 v_left < 0.0 error continue message no
run 1000000
write_dump all custom {dump} id type x vx c_R c_S[*] modify sort id format float %.17g
"""


def lattice(low, counts, spacing):
    """(n, 3), from low along x; spacing (a, b) along x and across"""
    x = np.stack(np.meshgrid(*[np.arange(k) + 0.5 for k in counts], indexing="ij"), -1).reshape(-1, len(counts))
    out = np.zeros((len(x), 3))
    out[:, : len(counts)] = x * ([spacing[0]] + [spacing[1]] * (len(counts) - 1))
    out[:, 0] += low
    return out


def plates(lmp, tmp_path, ratio, solid):
    """a plate hits one that is ratio times as coarse. Errors: of stress and density on the plateaus, of density next to the contact (3 layers)"""
    metal = METALS["al"] if solid else dataclasses.replace(METALS["al"], Y=0.0)
    exact = impact(metal, metal, SPEED)[0][-1]
    dx, gap, length = SPACING, 0.5 * (1 + ratio) * SPACING, N * SPACING
    end = 0.6 * length * metal.rho0 / impact(metal, metal, SPEED)[0][0].m + gap / SPEED
    x = np.concatenate([lattice(0.2 * length, [N, ratio, ratio], (dx, dx)),
                        lattice(1.2 * length + gap, [N // ratio, 1, 1], (ratio * dx, ratio * dx))])
    kind = np.where(x[:, 0] < 1.2 * length, 1, 2)
    v = np.zeros_like(x)
    v[:, 0] = np.where(kind == 1, SPEED, 0.0)
    wide = {1: ETA * dx, 2: ETA * ratio * dx}
    s = Fluid(x, v, np.full(len(x), metal.rho0), np.zeros(len(x)), kind, {1: metal.rho0 * dx**3, 2: metal.rho0 * (ratio * dx) ** 3}, wide,
              np.array([2.6 * length + 1.2 * SPEED * end, ratio * dx, ratio * dx]), (False, True, True), 3)
    s.write(tmp_path / "s.data")
    file = material(tmp_path / "al.hvi", *sections(metal), units="si")
    state = STATE if solid else ("p", "e")
    done = lmp(INPUT.format(data=tmp_path / "s.data", file=file, fine=wide[1], coarse=wide[2], skin=0.3 * dx, state=" ".join(state), end=end,
                            dump=tmp_path / "f", strength="fix jc all hvi/johnson-cook strength perfect damage no spall none" if solid else ""))
    a = read_dump(tmp_path / "f").table
    kind, x, rho = a[:, 1], a[:, 2], a[:, 4] / exact.rho - 1
    stress = (-a[:, 5 + STATE.index("sxx")] if solid else a[:, 5]) / exact.sigma - 1
    depth = np.abs(x - 0.5 * (x[kind == 1].max() + x[kind == 2].min()))
    behind = exact.m / exact.rho * end  # thickness of what the shock has passed, nearly
    out = dict(energy=np.abs(done.thermo["c_book[9]"] - 1).max())
    for name, k, layer in (("fine", 1, ratio**2), ("coarse", 2, 1)):
        mine = np.nonzero(kind == k)[0]
        plateau = mine[(depth[mine] > 0.35 * behind) & (depth[mine] < 0.75 * behind)]
        near = mine[np.argsort(depth[mine])[: 3 * layer]]
        out[name] = stress[plateau].mean(), rho[plateau].mean(), np.abs(rho[near]).max()
    return out
