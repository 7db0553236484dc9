#!/usr/bin/env python3
"""Blocks of aluminum at rest, of particles on a lattice or like glass: how much they move by themselves.

    python3 tests/lib/body_scenes.py --lmp build/lmp --fill glass --words "dissipation riemann" --compressed 0.05

prints speeds (rms and largest, m/s, and rms over the speed of sound), kinetic energy over that of compression, and the scatter of stress
in GPa after 5 us. A cube of 12 spacings of 0.5 mm, an elastic-plastic solid, free at density rho0, or, with --compressed E, periodic and
denser by that, cold: rho = rho0 (1 + E), p = p(rho, 0), places the same. --liquid: without strength.
"""

import argparse
import pathlib
import sys
import tempfile

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "python")]
from hvi.model import bodies  # noqa: E402
from solid_runs import STATE, material, read_frames  # noqa: E402
from lammps_runs import runner  # noqa: E402

DX, RHO, SOUND, SHEAR, YIELD, ACROSS = 0.5e-3, 2703.0, 5240.0, 27.6e9, 0.29e9, 12


def rest(lmp, folder, fill, words, kernel="wendland2", h=1.6, compressed=0.0, liquid=False, end=5e-6, seed=1):
    """{name: value} at the end"""
    folder = pathlib.Path(folder)
    body = bodies.make(bodies.box(np.full(3, ACROSS * DX), periodic=(0, 1, 2) if compressed else ()), DX, fill, seed)
    rho = RHO * (1 + compressed)
    bodies.write(folder / "block.data", body, rho)
    file = material(folder / "block.hvi", f"eos gruneisen rho0 {RHO} C {SOUND} S1 1.4 g0 1.97 a 0.48 T0 300",
                    "strength none" if liquid else f"strength perfect G {SHEAR} Y {YIELD}", units="si")
    lmp(f"""units si
boundary {'p p p' if compressed else 's s s'}
atom_style sph
atom_modify map array
read_data block.data
pair_style hvi/sph {kernel} {words}
pair_coeff 1 1 file {file.name} h {h * DX:.17g}
neighbor {0.3 * DX} bin
neigh_modify every 1 delay 0 check yes
{'' if liquid else 'fix jc all hvi/johnson-cook strength perfect damage no spall none'}
fix move all hvi/sph
fix step all hvi/dt 0.3
compute S all hvi/atom {'p e' if liquid else ' '.join(STATE)}
compute R all property/atom rho
variable left equal {end}-time
fix halt all halt 1 v_left < 0.0 error continue message no
thermo 100
run 1000000
write_dump all custom end.dump id type x y z vx vy vz c_R c_S[*] modify time yes sort id format float %.17g
""")
    f = read_frames(folder / "end.dump")[0]
    speed = np.linalg.norm(f["v"], axis=1)
    stress = f["p"] - f.get("sxx", 0.0)
    work = 0.5 * SOUND**2 * compressed**2  # per mass, to the first order
    return dict(particles=len(speed), rms=np.sqrt((speed**2).mean()), largest=speed.max(), of_sound=np.sqrt((speed**2).mean()) / SOUND,
                energy=0.5 * (speed**2).mean() / work if work else np.nan, scatter=stress.std() / 1e9)


if __name__ == "__main__":
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=TESTS.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--fill", default="glass", choices=("glass", "lattice"))
    a.add_argument("--words", default="viscosity 1 2", help="of the pair style")
    a.add_argument("--kernel", default="wendland2")
    a.add_argument("--h", default=1.6, type=float, help="in spacings")
    a.add_argument("--compressed", default=0.0, type=float, metavar="E")
    a.add_argument("--liquid", action="store_true")
    a.add_argument("--seed", default=1, type=int)
    o = vars(a.parse_args())
    exe = o.pop("lmp")
    with tempfile.TemporaryDirectory() as folder:
        found = rest(runner(exe, pathlib.Path(folder)), folder, **o)
    print(" ".join(f"{k} {v:.3g}" for k, v in found.items()))
