"""Solids, long form: python3 tests/solids.py --lmp build/lmp [--spacing 0.7 0.5] prints what test_solids.py has no time for.

Verney's shell: a thick shell of beryllium collapses and stops when its plastic work has taken up the kinetic energy. (cm, g, us, Mbar;
incompressible, perfectly plastic: inner radius 4, outer 8.203 from u0 = 0.0619787 at the inner radius 8 of 8 to 10.)
Taylor's cylinder: copper, 32.4 mm by 3.2 mm radius, 227 m/s; codes have 21.4-21.7 mm final length, 6.97-7.24 mm foot radius.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from conftest import Result  # noqa: E402
from solid_runs import material, run  # noqa: E402
from sph_scenes import Fluid  # noqa: E402


def runner(exe, folder):
    def lmp(text):
        (folder / "in.run").write_text(text)
        command = [str(HERE.parent / "cmake" / "env.sh"), str(exe), "-in", "in.run", "-log", "log.run"]
        o = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ)
        r = Result(command, folder, o.returncode, o.stdout, o.stderr, (folder / "log.run").read_text())
        if o.returncode:
            sys.exit(str(r))
        return r

    return lmp


def verney(lmp, folder, dx, h=1.2, kernel="cubic", words="viscosity 0.5 0.5", t_end=150.0):
    path = material(folder / "Be.hvi", "eos gruneisen rho0 1.845 C 0.7998 S1 1.124 g0 1.11 a 0.16 T0 300", "strength perfect G 1.510 Y 0.0033")
    k = int(np.ceil(10 / dx))
    x = dx * (np.stack(np.meshgrid(*[np.arange(-k, k)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5)
    r0 = np.sqrt((x**2).sum(1))
    x = x[(r0 > 8) & (r0 < 10)]
    r0 = np.sqrt((x**2).sum(1))
    n = len(x)
    s = Fluid(x + 12.0, np.zeros((n, 3)), np.full(n, 1.845), np.zeros(n), np.ones(n, int), {1: 1.845 * dx**3}, {1: h * dx}, np.full(3, 24.0), (False,) * 3)
    s.v = -0.0619787 * (8 / r0**1.5)[:, None] ** 2 * x
    steps = int(t_end / (0.2 * h * dx / 1.35))
    pair = f"pair_style hvi/sph {kernel} form sum {words} h constant\npair_coeff 1 1 file {path} h {h * dx}\n"
    start = time.time()
    r = run(lmp, folder, s, pair, "strength perfect damage no spall none", steps, dt=t_end / steps, frames=max(1, steps // 50))
    inner, speed = [], []
    for f in r.frames:
        y = f["x"] - 12.0
        rad = np.sqrt((y**2).sum(1))
        inner.append(np.median(np.cbrt(np.maximum(512 + rad**3 - r0**3, 0))))
        speed.append(((y * f["v"]).sum(1) / rad).mean())
    k = int(np.argmin(inner))
    rad = np.sqrt(((r.frames[k]["x"] - 12.0) ** 2).sum(1))
    t = r.thermo
    return (f"Verney {kernel} {words} dx {dx} n {n} steps {steps} wall {time.time() - start:.0f} s: stops at inner {inner[k]:.3f} (4.000) outer "
            f"{np.quantile(rad, 0.995) + dx / 4:.3f} (8.203), t {r.frames[k]['time']:.0f}, drift {np.abs(t['c_book[9]'] - 1).max():.1e}, kinetic left "
            f"{t['c_book[1]'].min() / t['c_book[1]'][0]:.4f}")


def taylor(lmp, folder, dx, root=HERE.parent, h=1.2, V=227.0, L=32.4e-3, R=3.2e-3, t_end=80e-6):
    """two cylinders meet, each the mirror image of the other: the rigid wall without friction"""
    q = dx * (np.arange(-int(R / dx) - 1, int(R / dx) + 1) + 0.5)
    z = dx * (np.arange(int(round(L / dx))) + 0.5)
    half = np.stack(np.meshgrid(z, q, q, indexing="ij"), -1).reshape(-1, 3)
    half = half[(half[:, 1] ** 2 + half[:, 2] ** 2) < R * R]
    n = len(half)
    x = np.concatenate([half, half * [-1, 1, 1]])
    box = np.array([2.2 * L, 8 * R, 8 * R])
    s = Fluid(x + box / 2, np.zeros((2 * n, 3)), np.full(2 * n, 8930.0), np.zeros(2 * n), np.repeat([1, 2], n), {1: 8930 * dx**3, 2: 8930 * dx**3},
              {1: h * dx, 2: h * dx}, box, (False,) * 3)
    s.v[:, 0] = np.repeat([-V, V], n)
    pair = f"pair_style hvi/sph cubic form sum viscosity 1 2 h constant\npair_coeff * * file {root}/potentials/Cu-OFHC.hvi h {h * dx}\n"
    start = time.time()
    steps = int(t_end / (0.2 * h * dx / 5500))
    r = run(lmp, folder, s, pair, "damage no spall none", steps, dt=t_end / steps, frames=steps, units="si", lost="ignore")
    y = r.frames[-1]["x"][:n] - box / 2 if len(r.frames[-1]["x"]) == 2 * n else np.full((n, 3), np.nan)
    rad = np.sqrt(y[:, 1] ** 2 + y[:, 2] ** 2)
    foot = rad[-y[:, 0] < 1e-3] if y[:, 0].mean() < 0 else rad[y[:, 0] < 1e-3]  # of a disc, from its second moment; and the outermost particle
    return (f"Taylor dx {dx} n {2 * n} wall {time.time() - start:.0f} s: length {1e3 * (y[:, 0].max() - y[:, 0].min() + dx):.2f} mm (21.4-21.7), foot radius "
            f"{1e3 * np.sqrt(2 * (foot**2).mean()):.2f} mm (6.97-7.24; "
            f"outermost particle {1e3 * rad.max():.2f}, 99 % {1e3 * np.quantile(foot, 0.99):.2f}), drift {np.abs(r.thermo['c_book[9]'] - 1).max():.1e}")


if __name__ == "__main__":
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=HERE.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--out", default="verify-solids", type=pathlib.Path)
    a.add_argument("--spacing", nargs="*", type=float, default=[0.7, 0.5])
    a.add_argument("--taylor", nargs="*", type=float, default=[0.8e-3, 0.64e-3])
    args = a.parse_args()
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    lmp = runner(args.lmp, args.out)
    for dx in args.spacing:
        print(verney(lmp, args.out, dx), flush=True)
    for dx in args.taylor:
        print(taylor(lmp, args.out, dx), flush=True)
