"""Solids, long form: python3 tests/verify/solids.py --lmp build/lmp --out FOLDER writes a report, solids.md; a part of `make verify`.

Verney's shell: a thick shell of beryllium collapses and stops when its plastic work has taken up the kinetic energy. (cm, g, us, Mbar;
incompressible, perfectly plastic: inner radius 4, outer 8.203 from u0 = 0.0619787 at the inner radius 8 of 8 to 10.)
Taylor's cylinder: copper, 32.4 mm by 3.2 mm radius, 227 m/s; codes have 21.4-21.7 mm final length, 6.97-7.24 mm foot radius.
What faces bear (tests/lib/face_scenes.py): standing waves, pulses and bending of walls of some layers, 0: bulk; blocks that spin, mirrors, contacts.
"""

import argparse
import pathlib
import sys
import time

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
import face_scenes  # noqa: E402
from face_scenes import bending, borne, contact, mirror_face, rubble, spinning, spinning_cube, stairs, verney_cylinder, wave  # noqa: E402
from lammps_runs import runner  # noqa: E402
from tensile_scenes import rings, strip  # noqa: E402
from verney_taylor_scenes import taylor, verney  # noqa: E402


def ring_pair(lmp, folder, dx, words, h=1.5, kernel="cubic"):
    start = time.time()
    r, frames = rings(lmp, folder, words, dx, h, kernel)
    return dict(spacing=dx, kernel=kernel, h=h, words=words, particles=len(r.frames[0]["x"]), steps=int(r.thermo["Step"][-1]), seconds=time.time() - start,
                pieces=max(f["pieces"] for f in frames), nearest=min(f["near"] for f in frames), rebound=-frames[-1]["v"],
                drift=np.abs(r.thermo["c_book[9]"] - 1).max())


def stretched(lmp, folder, strain, words, h=1.5, kernel="cubic"):
    start = time.time()
    r, near = strip(lmp, folder, words, kernel, h, strain=strain)
    return dict(strain=strain, kernel=kernel, h=h, words=words, particles=len(r.frames[0]["x"]), steps=int(r.thermo["Step"][-1]), seconds=time.time() - start,
                nearest=near.min(), farthest=near.max(), drift=np.abs(r.thermo["c_book[9]"] - 1).max())


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
    ("A strip that is stretched: distances to the nearest neighbor over the median", stretched,
     [(strain, words) for strain in (0.1, 0.2) for words in ("viscosity 1 2", f"viscosity 1 2 {ART}")]),
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
    a.add_argument("--lmp", default=TESTS.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--out", default="verify-solids", type=pathlib.Path)
    a.add_argument("--only", default="", help="a name or a part of names: " + ", ".join(scene.__name__ for _, scene, _ in LONG))
    a.add_argument("--spacing", type=lambda s: int(s) if s.isdigit() else float(s),
                   help="only this one, in cm (Taylor's cylinder: m); of walls, blocks, bars: layers; strain of the strip")
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
    whole = args.only in [scene.__name__ for _, scene, _ in LONG]
    for title, scene, cases in LONG:
        if args.only != scene.__name__ if whole else args.only not in scene.__name__:
            continue
        rows = []
        cases = [c for c in cases if args.spacing in (None, c[0])] or [(args.spacing, cases[0][1])]
        for dx, words in [(dx, args.words) for dx in dict(cases)] if args.words else cases:
            rows.append(scene(lmp, args.out, dx, words=words, **more))
            print(scene.__name__, {k: float(f"{v:.4g}") if isinstance(v, float) else v for k, v in rows[-1].items()}, flush=True)
        report += f"\n{title}\n\n{table(rows)}\n"
        (args.out / "solids.md").write_text(report)
    print(f"report: {args.out}/solids.md")
