"""How large are the pieces that strike a rear wall, over spacing and shift of the lattice? Sphere and bumper of A27 to A635, before the cloud is at the wall.

    python3 pieces.py --speed 4.25 --across 10 --shifts 0 0.125 0.25 0.375 0.5

Says the largest piece that is sound and hangs together, as a part of the mass of the sphere: mean, least and most over the shifts. tables.md has what came of it.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import yaml

DIAMETER = 3.18  # mm
CASE = """projectile: {{material: Al2017-T4.hvi, diameter_mm: {diameter}, fill: {fill}}}
speed_km_s: {speed}
walls:
- {{thickness_mm: 0.794, material: Al6061-T6.hvi}}
- {{thickness_mm: 3, material: Al6061-T6.hvi, gap_mm: 50.8, spacings_mm: [1]}}  # coarse: what becomes of it is not looked at
spacings_mm: [{spacing:.6g}]
shifts: [{shift}]
settings: {{film: -1, quarter: '{quarter}'}}
"""


def largest(lmp, speed, across, fill, shift, quarter):
    """the largest piece behind wall 1"""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "pieces.yaml").write_text(CASE.format(diameter=DIAMETER, fill=fill, speed=speed, spacing=DIAMETER / across, shift=shift, quarter=quarter))
        hvi = [sys.executable, "-m", "hvi"]
        subprocess.run([*hvi, "shield", folder / "pieces.yaml", "--write", folder / "run"], check=True, stdout=subprocess.DEVNULL)
        (run,) = (folder / "run").glob("*/")
        subprocess.run([lmp, "-in", "in.shield", "-screen", "none", "-var", "until", f"{60 / speed:.1f}"], cwd=run, check=True)
        subprocess.run([*hvi, "judge", "."], cwd=run, stdout=subprocess.DEVNULL)  # its status is the verdict
        return yaml.safe_load((run / "result.yaml").read_text())["wall1_largest_fragment_mass_fraction"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default=os.environ.get("HVI_LMP", "../../../build/lmp"), type=os.path.abspath)
    parser.add_argument("--speed", type=float, required=True, help="km/s")
    parser.add_argument("--across", type=int, default=10, help="particles across the sphere")
    parser.add_argument("--shifts", type=float, nargs="+", default=[0.125, 0.375], help="of its lattice, in spacings")
    parser.add_argument("--fill", choices=("lattice", "glass"), default="lattice", help="of the sphere; of a glass a shift is its number")
    parser.add_argument("--quarter", choices=("auto", "no"), default="auto", help="no: the whole shield, without mirror planes")
    args = parser.parse_args()
    found = [largest(args.lmp, args.speed, args.across, args.fill, shift, args.quarter) for shift in args.shifts]
    print(f"mean {sum(found) / len(found):.3g} least {min(found):.3g} most {max(found):.3g}; " + ", ".join(f"{a:.3g} with {s:g}" for a, s in zip(found, args.shifts)))


if __name__ == "__main__":
    main()
