#!/usr/bin/env python3
"""Material files with other constants of spall voids, for onset-constants.yaml: python3 constants.py [FOLDER] writes them there.

LAMMPS_POTENTIALS must have that folder beside the package's.
"""
import pathlib
import re
import sys

potentials = pathlib.Path(__file__).resolve().parents[3] / "potentials"
folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
folder.mkdir(parents=True, exist_ok=True)
for metal in ("Al2017-T4", "Al6061-T6"):
    head, section, rest = (potentials / f"{metal}.hvi").read_text().partition("\nspall voids\n")
    for key, factor in (("sigma", 1.1), ("m", 0.5), ("phi_c", 0.5), ("phi_c", 2.0)):
        text, n = re.subn(rf"(?m)^  {key} +(\S+).*", lambda old: f"  {key} {factor * float(old[1]):.6g}    # {factor:g} of {old[1]}", rest, count=1)
        if n != 1:
            sys.exit(f"{metal}.hvi: no {key} in its section spall voids")
        (folder / f"{metal}-{key}-{factor:g}.hvi").write_text(head + section + text)
