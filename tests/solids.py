"""Solids, long form: python3 tests/solids.py --lmp build/lmp --out FOLDER writes a report, solids.md; a part of `make verify`.

Verney's shell: a thick shell of beryllium collapses and stops when its plastic work has taken up the kinetic energy. (cm, g, us, Mbar;
incompressible, perfectly plastic: inner radius 4, outer 8.203 from u0 = 0.0619787 at the inner radius 8 of 8 to 10.)
Taylor's cylinder: copper, 32.4 mm by 3.2 mm radius, 227 m/s; codes have 21.4-21.7 mm final length, 6.97-7.24 mm foot radius.
What faces bear (tests/face_scenes.py): standing waves, pulses and bending of walls of some layers, 0: bulk; blocks that spin, mirrors, contacts.
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
import face_scenes  # noqa: E402
from conftest import Result  # noqa: E402
from face_scenes import bending, borne, contact, mirror_face, rubble, spinning, spinning_cube, stairs, verney_cylinder, wave  # noqa: E402
from solid_runs import material, momentum_error, run  # noqa: E402
from sph_scenes import Fluid  # noqa: E402
from tensile_scenes import rings  # noqa: E402


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


def verney(lmp, folder, dx, words="viscosity 0.1 0.5", h=1.2, kernel="cubic", t_end=150.0, octant=False, courant=0.2, skin=0.3,
           variable=False):
    """octant: an eighth of the shell, between mirrors; skin in spacings"""
    path = material(folder / "Be.hvi", "eos gruneisen rho0 1.845 C 0.7998 S1 1.124 g0 1.11 a 0.16 T0 300", "strength perfect G 1.510 Y 0.0033")
    k = int(np.ceil(10 / dx))
    x = dx * (np.stack(np.meshgrid(*[np.arange(-k, k)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5)
    r0 = np.sqrt((x**2).sum(1))
    x = x[(r0 > 8) & (r0 < 10) & ((x > 0).all(1) | (not octant))]
    r0 = np.sqrt((x**2).sum(1))
    n, center = len(x), 0.0 if octant else 12.0
    s = Fluid(x + center, np.zeros((n, 3)), np.full(n, 1.845), np.zeros(n), np.ones(n, int), {1: 1.845 * dx**3}, {1: h * dx}, np.full(3, 12.0 + center),
              (False,) * 3)
    s.v = -0.0619787 * (8 / r0**1.5)[:, None] ** 2 * x
    steps = int(t_end / (courant * h * dx / 1.35))
    how = f"h {'variable' if variable else 'constant'} {'mirror x 0 lo mirror y 0 lo mirror z 0 lo' if octant else ''}"
    pair = f"pair_style hvi/sph {kernel} form sum {words} {how}\npair_coeff 1 1 file {path} h {h * dx}\n"
    start = time.time()
    r = run(lmp, folder, s, pair, "strength perfect damage no spall none", steps, dt=t_end / steps, frames=max(1, steps // 50), skin=skin)
    inner = []
    for f in r.frames:
        y = f["x"] - center
        rad = np.sqrt((y**2).sum(1))
        inner.append(np.median(np.cbrt(np.maximum(512 + rad**3 - r0**3, 0))))
    k = int(np.argmin(inner))
    t = r.thermo
    return dict(spacing=dx, kernel=kernel, h=h, words=words, particles=n, steps=steps, seconds=time.time() - start, inner=inner[k],
                stops_at=r.frames[k]["time"], drift=np.abs(t["c_book[9]"] - 1).max(), momentum=max(momentum_error(t)),
                kinetic=t["c_book[1]"].min() / t["c_book[1]"][0], strength=strength(inner[k]),
                viscous=stop(0.5 * viscosity(words) * 1.316 * h * dx / 10))


def strength(r):
    """of a shell that stops at the inner radius r, in units of the exact one: kinetic energy over plastic work on the way"""
    x = np.linspace(r, 8, 4001)
    return 2 * 1.845 * 0.0619787**2 * 8**4 * (1 / 8 - 1 / 10) / (8 * 0.0033 * np.trapz(x * x * np.log(np.cbrt(x**3 + 488) / x), x))


def viscosity(words):
    """the linear coefficient; riemann has none"""
    return float(words.split("viscosity")[1].split()[0]) if "viscosity" in words else 0.0


def stop(nu, r=8.0, R=10.0, u=0.0619787, rho=1.845, Y=0.0033):
    """where an incompressible shell of kinematic viscosity nu stops: kinetic energy = plastic + viscous work, v = u (r/x)^2

    2 pi rho u^2 r^4 (1/r - 1/R); 8 pi Y u r^2 ln(R/r); 16 pi rho nu u^2 r^4 (1/r^3 - 1/R^3).
    Monaghan's linear viscosity is nu = a c h/10 in three dimensions, half of it where only one half of the pairs approach.
    """
    volume, dr = R**3 - r**3, 1e-3
    K = 2 * np.pi * rho * u * u * r**4 * (1 / r - 1 / R)
    while K > 0:
        R = np.cbrt(r**3 + volume)
        u = np.sqrt(K / (2 * np.pi * rho * r**4 * (1 / r - 1 / R)))
        K -= dr * (8 * np.pi * Y * r * r * np.log(R / r) + 16 * np.pi * rho * nu * u * r**4 * (1 / r**3 - 1 / R**3))
        r -= dr
    return r


def taylor(lmp, folder, dx, words="viscosity 1 2", root=HERE.parent, h=1.2, V=227.0, L=32.4e-3, R=3.2e-3, t_end=80e-6,
           kernel="cubic", laws=None, quarter=False, courant=0.2, skin=0.3, variable=False):
    """two cylinders meet, each the mirror image of the other: the rigid wall without friction

    laws: sections of a material file in place of Cu-OFHC.hvi; quarter: of each, between mirrors; skin in spacings
    """
    q = dx * (np.arange(-int(R / dx) - 1, int(R / dx) + 1) + 0.5)
    z = dx * (np.arange(int(round(L / dx))) + 0.5)
    half = np.stack(np.meshgrid(z, q, q, indexing="ij"), -1).reshape(-1, 3)
    half = half[((half[:, 1] ** 2 + half[:, 2] ** 2) < R * R) & ((half[:, 1:] > 0).all(1) | (not quarter))]
    n = len(half)
    x = np.concatenate([half, half * [-1, 1, 1]])
    box = np.array([2.2 * L, 8 * R, 8 * R])
    center = box / 2 * ([1, 0, 0] if quarter else 1)
    s = Fluid(x + center, np.zeros((2 * n, 3)), np.full(2 * n, 8930.0), np.zeros(2 * n), np.repeat([1, 2], n), {1: 8930 * dx**3, 2: 8930 * dx**3},
              {1: h * dx, 2: h * dx}, box, (False,) * 3)
    s.v[:, 0] = np.repeat([-V, V], n)
    path = material(folder / "Cu.hvi", *laws, units="si") if laws else f"{root}/potentials/Cu-OFHC.hvi"
    how = f"h {'variable' if variable else 'constant'} {'mirror y 0 lo mirror z 0 lo' if quarter else ''}"
    pair = f"pair_style hvi/sph {kernel} form sum {words} {how}\npair_coeff * * file {path} h {h * dx}\n"
    start = time.time()
    steps = int(t_end / (courant * h * dx / 5500))
    r = run(lmp, folder, s, pair, "damage no spall none", steps, dt=t_end / steps, frames=steps, units="si", lost="ignore", skin=skin)
    y = r.frames[-1]["x"][:n] - center if len(r.frames[-1]["x"]) == 2 * n else np.full((n, 3), np.nan)
    rad = np.sqrt(y[:, 1] ** 2 + y[:, 2] ** 2)
    foot = rad[-y[:, 0] < 1e-3] if y[:, 0].mean() < 0 else rad[y[:, 0] < 1e-3]  # of a disc, from its second moment; and the outermost particle
    t = r.thermo
    return dict(spacing=1e3 * dx, words=words, particles=2 * n, steps=steps, seconds=time.time() - start,
                length=1e3 * (y[:, 0].max() - y[:, 0].min() + dx), foot=1e3 * np.sqrt(2 * (foot**2).mean()), widest=1e3 * rad.max(),
                drift=np.abs(t["c_book[9]"] - 1).max(), momentum=max(momentum_error(t)) / (s.m @ np.abs(s.v[:, 0])),
                speed=np.abs(r.frames[-1]["v"]).max() / V)


def ring_pair(lmp, folder, dx, words, h=1.5, kernel="cubic"):
    start = time.time()
    r, frames = rings(lmp, folder, words, dx, h, kernel)
    return dict(spacing=dx, kernel=kernel, h=h, words=words, particles=len(r.frames[0]["x"]), steps=int(r.thermo["Step"][-1]), seconds=time.time() - start,
                pieces=max(f["pieces"] for f in frames), nearest=min(f["near"] for f in frames), rebound=-frames[-1]["v"],
                drift=np.abs(r.thermo["c_book[9]"] - 1).max())


def table(rows):
    def cell(v):
        return f"{v:.3g}" if isinstance(v, float) and abs(v) < 1e-2 else (f"{v:.3f}" if isinstance(v, float) else str(v))

    keys = list(rows[0])
    return "\n".join(["| " + " | ".join(keys) + " |", "|" + "---|" * len(keys)] + ["| " + " | ".join(cell(r[k]) for k in keys) + " |" for r in rows])


LOW, ART = "viscosity 0.1 0.5", "artstress 0.3 4"
LITTLE = "viscosity 0.1 0"
LONG = [
    ("Verney's shell: inner radius where it stops, exact 4, as from a strength in units of Y; with the viscosity alone, by theory, *viscous*", verney,
     [(dx, LOW) for dx in (1.0, 0.7, 0.5)] + [(dx, f"{LOW} {ART}") for dx in (1.0, 0.7, 0.5)] + [(dx, "viscosity 0.5 0.5") for dx in (0.7, 0.5)]),
    ("Taylor's cylinder: final length and radius of the foot in mm; other codes 21.4-21.7 and 6.97-7.24", taylor,
     [(dx, words) for dx in (0.8e-3, 0.64e-3) for words in ("viscosity 1 2", f"viscosity 1 2 {ART}")]),
    ("Rubber rings: pieces of the worse ring, nearest neighbor (1 %) in spacings, speed after in units of that before", ring_pair,
     [(dx, words) for dx in (0.2, 0.1) for words in ("viscosity 1 2", f"viscosity 1 2 {ART}")]),
    ("Verney's cylinder: as the shell, plane strain", verney_cylinder, [(dx, LOW) for dx in (0.5, 0.35, 0.25)]),
    ("Standing waves in the plane of a wall: part of stress that is borne, part that the law has, stiffness and speed they give; then shear", borne,
     [(n, LITTLE) for n in (1, 2, 4, 0)]),
    ("The same for walls whose faces are stairs, out of a lattice that is turned by atan(1/2)", stairs, [(n, LITTLE) for n in (2, 4)]),
    ("Walls that swing between two layers of failed particles on either side, at rest: what differs from swinging alone, what is dragged along", rubble,
     [(n, LITTLE) for n in (2, 4)]),
    ("A pulse along a wall: speed of its middle and of its front", wave, [(n, LITTLE) for n in (1, 2, 4, 0)]),
    ("Bending of a wall, 20 thicknesses long: frequency; sqrt(1 - 1/n^2) is that of a lattice of n layers", bending,
     [(n, LITTLE) for n in (4, 8)]),
    ("A square of n by n that spins, ten turns: angular momentum, kinetic energy, angle", spinning, [(n, LITTLE) for n in (8, 16)]),
    ("A cube that spins about an axis across a face", spinning_cube, [(n, LITTLE) for n in (6, 8)]),
    ("An eighth of a bar with three mirrors against the whole: largest differences, in units of the wave", mirror_face,
     [(n, LITTLE) for n in (2, 4)]),
    ("A pulse of pressure through the contact of two bodies, against one body", contact, [(n, LITTLE) for n in (2, 4, 0)])]


if __name__ == "__main__":
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=HERE.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--out", default="verify-solids", type=pathlib.Path)
    a.add_argument("--only", default="", help="a part of the names: " + ", ".join(scene.__name__ for _, scene, _ in LONG))
    a.add_argument("--spacing", type=lambda s: int(s) if s.isdigit() else float(s),
                   help="only this one, in cm (Taylor's cylinder: m); of walls, blocks, bars: layers")
    a.add_argument("--words", help="of the pair style, in place of those of the long form, like 'viscosity 0.1 0.5'")
    a.add_argument("--kernel", help="not with Taylor's cylinder")
    a.add_argument("--h", type=float, help="in spacings")
    a.add_argument("--courant", type=float, help="of the scenes of faces: the step in units of h/c")
    args = a.parse_args()
    face_scenes.COURANT = args.courant or face_scenes.COURANT
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    lmp = runner(args.lmp, args.out)
    more = {k: v for k, v in (("kernel", args.kernel), ("h", args.h)) if v is not None}
    report = "# Solids\n"
    for title, scene, cases in LONG:
        if args.only not in scene.__name__:
            continue
        rows = []
        cases = [c for c in cases if args.spacing in (None, c[0])] or [(args.spacing, cases[0][1])]
        for dx, words in [(dx, args.words) for dx in dict(cases)] if args.words else cases:
            rows.append(scene(lmp, args.out, dx, words=words, **more))
            print(scene.__name__, {k: float(f"{v:.4g}") if isinstance(v, float) else v for k, v in rows[-1].items()}, flush=True)
        report += f"\n{title}\n\n{table(rows)}\n"
        (args.out / "solids.md").write_text(report)
    print(f"report: {args.out}/solids.md")
