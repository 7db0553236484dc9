"""Stands in for mpirun and LAMMPS:  fake_lammps.py -np N LMP -in in.whipple -log FILE -var NAME VALUE ... [-var ...]

The shield holds up to a diameter of FAKE_LIMIT + dx + shift / 10, then is undecided, and fails from FAKE_UNSURE more on; a
thickness of wall 2 adds to the limit what it has more than 1.2 mm. FAKE_SLEEP: seconds that it takes; FAKE_FAIL: fails in
folders whose name has this in it, FAKE_SAVE: leaves restart files there; FAKE_PLAN: what plan.yaml says; FAKE_NOTE: the list notes of a verdict fails, "|" between.
"""

import os
import pathlib
import sys
import time

variables = {}
for word in sys.argv[sys.argv.index("-in") + 4:]:
    if word == "-var":
        name = None
    elif name is None:
        name = word
        variables[name] = []
    else:
        variables[name].append(word)

with open("tries", "a") as tries:
    tries.write(f"{variables.get('resume', ['no'])[0]}\n")
if variables.get("dry") != ["yes"] and pathlib.Path("shield.state").exists():
    pathlib.Path("shield.state").write_text("")  # as in.whipple, which saves its variables when it goes on
if os.environ.get("FAKE_SAVE", "nothing") in os.getcwd():
    for name in ("shield.restart.a", "shield.state"):
        pathlib.Path(name).write_text("")
if os.environ.get("FAKE_FAIL", "nothing") in os.getcwd():
    print("ERROR: Lost atoms (as told to)")
    sys.exit(1)
time.sleep(float(os.environ.get("FAKE_SLEEP", "0")))
if variables.get("dry") == ["yes"]:
    pathlib.Path("plan.yaml").write_text(os.environ["FAKE_PLAN"])
    sys.exit(0)

D, dx, shift = (float(variables[name][0]) for name in ("D", "dx", "shift"))
limit = float(os.environ.get("FAKE_LIMIT", "4")) + dx + 0.1 * shift + float(variables["thickness"][-1]) - 1.2
unsure = float(os.environ.get("FAKE_UNSURE", "0"))
verdict = "holds" if D <= limit else "undecided" if D <= limit + unsure else "fails"
if "outside" in variables:
    verdict = "undecided"
reason = {"holds": "'wall 2: no hole, no detached spall'", "fails": "'wall 2: perforated'", "undecided": "'wall 2: it still moves -- take -var tstop 40.5'"}[verdict]
notes = os.environ.get("FAKE_NOTE", "") if verdict == "fails" else ""
notes = "\n".join(["", "notes:", *(f"  - {note}" for note in notes.split("|"))]) if notes else ""
pathlib.Path("result.yaml").write_text(f"""verdict: {verdict}
reasons:
  - {reason}{notes}
hole1_diameter_mm: {D + 3}
particles: {int((D / dx)**3)}
core_s: {dx**-4:.1f}
package_version: 0.1.0
""")
