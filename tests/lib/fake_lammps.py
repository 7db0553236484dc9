"""Stands in for mpirun and LAMMPS:  fake_lammps.py -np N LMP -in in.shield -log FILE -var NAME VALUE ... [-var ...]

The shield, which is that of job.yaml, holds up to a diameter of FAKE_LIMIT + dx + shift / 10, then is undecided (debris is still on its way), and fails
(with a hole) from FAKE_UNSURE more on; a thickness of wall 2 adds to the limit what it has more than 1.2 mm. FAKE_POWER: it goes with the speed to minus that;
FAKE_GAP, FAKE_ANGLE: added to it for each mm of the last gap above 60, each degree. FAKE_SLEEP: seconds that it takes; FAKE_FAIL:
fails in folders whose name has this in it, FAKE_SAVE: leaves restart files there; FAKE_NOTE: debris is on its way, and a part passed beside wall 2, whatever
the verdict; FAKE_COLUMNS: how many entries compute hvi/energy has, and the columns of compute hvi/wall. With another input it writes the result.yaml of a sweep.
"""

import os
import pathlib
import sys
import time


def variables_of_job():
    """{name: [word, ...]} of job.yaml, by its lines: to load yaml takes longer than all of this"""
    found, name, inside = {}, None, False
    for line in pathlib.Path("job.yaml").read_text().splitlines():
        if line[0] != " ":
            inside = line == "variables:"
        elif inside and line.startswith("  - "):
            found[name].append(line[4:])
        elif inside:
            name, _, value = line[2:].partition(":")
            found[name] = [value[1:]] if value else []
    return found


variables = {}
for word in sys.argv[sys.argv.index("-in") + 4:]:
    if word == "-var":
        name = None
    elif name is None:
        name = word
        variables[name] = []
    else:
        variables[name].append(word)
given = sys.argv[sys.argv.index("-in") + 1]
shield = given in ("in.shield", "in.continue")
until, to = float(variables.get("until", ["0"])[0]), variables.get("to", ["shield.restart"])[0]
if shield:
    variables = variables_of_job()

with open("tries", "a") as tries:
    tries.write(f"{'yes' if given == 'in.continue' else 'no'}\n")
if os.environ.get("FAKE_SAVE", "nothing") in os.getcwd():
    pathlib.Path("shield.restart.a").write_text("")
    pathlib.Path("chain.yaml").write_text("{leg: 1, file: shield.restart.a}\n")
if os.environ.get("FAKE_FAIL", "nothing") in os.getcwd():
    print("ERROR: Lost atoms (as told to)")
    sys.exit(1)
time.sleep(float(os.environ.get("FAKE_SLEEP", "0")))

D, dx, shift, v0 = (float(variables[name][0]) for name in ("D", "dx", "shift", "v0")) if shield else (float(variables["D"][0]), float(variables["dx"][0]), 0.0, 7100.0)
thickness = [float(value) for value in variables["thickness"]]
limit = float(os.environ.get("FAKE_LIMIT", "4")) * (7100 / v0) ** float(os.environ.get("FAKE_POWER", "0")) + dx + 0.1 * shift + thickness[-1] - 1.2
if shield:
    limit += float(os.environ.get("FAKE_GAP", "0")) * (float(variables["gap"][-1]) - 60) + float(os.environ.get("FAKE_ANGLE", "0")) * float(variables["angle"][0])
unsure = float(os.environ.get("FAKE_UNSURE", "0"))
verdict = "holds" if D <= limit else "undecided" if D <= limit + unsure else "fails"
particles, core = int((D / dx)**3), dx**-4
if not shield:
    pathlib.Path("result.yaml").write_text(f"verdict: {verdict}\nparticles: {particles}\ncore_s: {core:.1f}\npackage_version: 0.1.0\n")
    sys.exit(0)

n, note = len(thickness), "FAKE_NOTE" in os.environ
BOOK, *WALL = os.environ["FAKE_COLUMNS"].split()  # not by import of hvi, which takes longer than all of this
mass = 2785 * 3.14159265 / 6 * (1e-3 * D)**3
images = 1 if float(variables["angle"][0]) else 4
fronts, z = [], 0.0
for gap, thick in zip(variables["gap"], thickness):
    fronts.append(z + float(gap))
    z = fronts[-1] + thick
walls = []
for k in range(n):
    row = dict.fromkeys(WALL, 0.0)
    row["tip"] = 1e-3 * (fronts[k + 1] if k + 1 < n else fronts[k] + 50)
    row["momentum"] = row["mass"] = 1.0
    row["largest_mass"] = float(os.environ.get("FAKE_PIECE", "0")) * mass * (dx / 0.4) ** 2
    if k == n - 1:
        row["coming_energy"] = 0.01 / images * 0.5 * mass * v0**2 if verdict == "undecided" or note else 0.0
        row["missed_mass"] = 0.12 / images * mass if note else 0.0
        row["missed_reach"] = 0.04
        if verdict == "fails":
            row.update(hole_found=1, hole_diameter=5e-3, apart_mass=1e-6, spall_mass=1e-6, apart_number=20)
    walls.append([row[name] for name in WALL])
book = [0.0] * int(BOOK)
book[7] = book[8] = book[18] = book[26] = 1.0
book[11] = book[25] = 1.0  # momentum
book += [0.0] * (12 if "method" in variables else 0)  # of fix hvi/fem


def block(step):
    return f"{step} {n}\n" + "".join(f"{k} {' '.join(map(str, row))}\n" for k, row in enumerate(walls, 1))


for name in ("walls.dat", "pieces.dat"):
    with open(name, "a") as out:
        out.write("# as fix ave/time\n" + block(0) + block(100))
with open("history.dat", "a") as out:
    for step, us in ((0, 0.0), (100, until)):
        out.write(f"{step} {us} {1e-6 * us} {' '.join(map(str, book))}\n")
pathlib.Path(to).write_bytes(b"LammpS RestartT\0")  # whole, as it ends so
ranks = int(sys.argv[2])
pathlib.Path(sys.argv[sys.argv.index("-log") + 1]).write_text(
    f"LAMMPS (4 Feb 2025)\nLoop time of {core / ranks} on {ranks} procs for 100 steps with {particles} atoms\nTotal wall time: 0:00:01\n")
