"""How large are the pieces that strike a rear wall, over spacing and shift of the lattice? Sphere and bumper of A27 to A635, before the cloud is at the wall.

    python3 pieces.py --speed 4.25 --across 10 --shifts 0 0.125 0.25 0.375 0.5
    python3 pieces.py --speed 3.63 --across 14 --sigma 1.5       the sphere's sigma of spall voids 1.5 times that of its file
    python3 pieces.py --speed 3.63 --across 14 --rate 1e6 2      its flow stress twice as large at 1e6 1/s, 1.1 times at 1e4
    python3 pieces.py --speed 3.63 --across 14 --scale 3         all lengths, and the time, three times as large

Says the largest piece that is sound and hangs together, as a part of the mass of the sphere: mean, least and most over the shifts. tables.md has what came of it.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

METAL = pathlib.Path(__file__).resolve().parents[3] / "potentials" / "Al2017-T4.hvi"
CASE = """projectile: {{material: {material}, diameter_mm: {diameter:.6g}, fill: {fill}}}
speed_km_s: {speed}
walls:
- {{thickness_mm: {bumper:.6g}, material: Al6061-T6.hvi}}
- {{thickness_mm: {wall:.6g}, material: Al6061-T6.hvi, gap_mm: {gap:.6g}, spacings_mm: [{coarse:.6g}]}}  # coarse: what becomes of it is not looked at
spacings_mm: [{spacing:.6g}]
shifts: [{shift}]
settings: {{film: -1, quarter: '{quarter}', solid: {solid}}}
"""


def metal(factors, rate):
    """text of the file of the sphere: {(section, key): so many times as large}, and D and p of the second rate term of its strength"""
    text = METAL.read_text()
    for (section, key), factor in factors.items():
        text, n = re.subn(rf"(?ms)(^{section}\n(?:(?!^\w).)*?^  {key} +)(\S+)", lambda old: f"{old[1]}{factor * float(old[2]):.6g}", text, count=1)
        if n != 1:
            sys.exit(f"{METAL}: no {key} in its section {section}")
    return text.replace("\nstrength johnson-cook\n", f"\nstrength johnson-cook\n  D {rate[0]:g}\n  p {rate[1]:g}\n") if rate else text


def largest(lmp, speed, across, fill, shift, quarter, solid, sphere, scale):
    """the largest piece behind wall 1; sphere: the text of its file"""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "sphere.hvi").write_text(sphere)
        (folder / "pieces.yaml").write_text(CASE.format(material=folder / "sphere.hvi", diameter=3.18 * scale, bumper=0.794 * scale, wall=3 * scale, gap=50.8 * scale, coarse=scale,
                                                        fill=fill, speed=speed, spacing=3.18 * scale / across, shift=shift, quarter=quarter, solid=solid))
        hvi = [sys.executable, "-m", "hvi"]
        subprocess.run([*hvi, "shield", folder / "pieces.yaml", "--write", folder / "run"], check=True, stdout=subprocess.DEVNULL)
        (run,) = (folder / "run").glob("*/")
        subprocess.run([lmp, "-in", "in.shield", "-screen", "none", "-var", "until", f"{60 * scale / speed:.1f}"], cwd=run, check=True)
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
    parser.add_argument("--solid", default="damage yes spall voids", help="as in the settings of a case")
    parser.add_argument("--sigma", type=float, default=1.0, help="of spall voids of the sphere, over that of its file")
    parser.add_argument("--phi-c", type=float, default=1.0, help="likewise")
    parser.add_argument("--flow", type=float, default=1.0, help="A and B of its strength johnson-cook, likewise")
    parser.add_argument("--rate", type=float, nargs=2, metavar=("D", "p"), help="a second rate term of that strength: (rate/D)^(1/p), D in 1/s")
    parser.add_argument("--scale", type=float, default=1.0, help="of all lengths")
    args = parser.parse_args()
    factors = {("spall voids", "sigma"): args.sigma, ("spall voids", "phi_c"): args.phi_c, ("strength johnson-cook", "A"): args.flow, ("strength johnson-cook", "B"): args.flow}
    sphere = metal(factors, args.rate)
    found = [largest(args.lmp, args.speed, args.across, args.fill, shift, args.quarter, args.solid, sphere, args.scale) for shift in args.shifts]
    print(f"mean {sum(found) / len(found):.3g} least {min(found):.3g} most {max(found):.3g}; " + ", ".join(f"{a:.3g} with {s:g}" for a, s in zip(found, args.shifts)))


if __name__ == "__main__":
    main()
