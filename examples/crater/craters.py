# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Craters beside the fit of Cour-Palais: runs in.crater for each row of craters.csv that has no depth yet, and writes what is found into it.

    python3 craters.py [--ranks R]    # runs what is left, writes craters.csv
    python3 craters.py --again        # runs the rows that have a depth once more
    python3 craters.py --table        # only prints the table
"""

import argparse
import csv
import os
import pathlib
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402
from hvi import tables  # noqa: E402
from hvi.analysis import crater  # noqa: E402
from hvi.material.library import path_of  # noqa: E402
from hvi.shield import ble  # noqa: E402
from hvi.version import ROOT  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
TABLE = HERE / "craters.csv"
DEEP = 3.5  # thickness and radius of the target, in depths of the fit
TSTOP = 3.0  # us per mm of its depth
GIVEN = ("projectile", "target", "D_mm", "km_s", "across", "damage", "rate_D", "rate_p")  # rate_D, 1/s, and rate_p: keys D and p of strength johnson-cook, of both
FOUND = ("depth_mm", "diameter_mm", "depth_over_diameter", "volume_mm3", "fit_mm", "error_percent", "particles", "core_s")


def read():
    with open(TABLE, newline="") as table:
        return list(csv.DictReader(table))


def fit(row):
    """mm: Cour-Palais, Howto_ble; the wall is thick"""
    (rho_p, *_), (rho_t, _, sound, hardness) = (ble.properties(row[name]) for name in ("projectile", "target"))
    P = 5.24 * (0.1 * float(row["D_mm"])) ** (19 / 18) * hardness**-0.25 * (rho_p / rho_t) ** 0.5 * (float(row["km_s"]) / sound) ** (2 / 3)  # cm
    return 10 * P


def material(folder, name, row):
    """a copy of the material file with the row's term of the rate"""
    text = path_of(f"{name}.hvi").read_text()
    if float(row["rate_D"]):
        head, _, rest = text.partition("strength johnson-cook\n")
        text = f"{head}strength johnson-cook\n  D {row['rate_D']}\n  p {row['rate_p']}\n{rest}"
    (folder / f"{name}.hvi").write_text(text)


def run(row, folder, ranks):
    folder.mkdir(parents=True, exist_ok=True)
    for name in {row["projectile"], row["target"]}:
        material(folder, name, row)
    depth, dx = fit(row), float(row["D_mm"]) / float(row["across"])
    values = {"dx": dx, "v0": 1000 * float(row["km_s"]), "D": row["D_mm"], "deep": round(DEEP * depth, 1), "wide": round(DEEP * depth, 1), "tstop": round(TSTOP * depth, 1),
              "frame": 1000, "solid": f"damage {row['damage']} spall voids thermal yes", "material_p": f"{row['projectile']}.hvi", "material_t": f"{row['target']}.hvi"}
    words = [word for name, value in values.items() for word in ("-var", name, str(value))]
    start = time.time()
    with open(folder / "screen", "w") as screen:
        subprocess.run([ROOT / "cmake" / "env.sh", "mpirun", "-np", str(ranks), os.environ.get("HVI_LMP", ROOT / "build" / "lmp"), "-in", HERE / "in.crater", *words], cwd=folder, check=True, stdout=screen,
                       env={**os.environ, "LAMMPS_POTENTIALS": str(folder)})
    frame = hvi.Dump(folder / "crater.dump")[0]
    found = crater.measure(frame, 1e-3 * dx, [2])
    row.update(depth_mm=f"{1e3 * found.depth:.3f}", diameter_mm=f"{1e3 * found.diameter:.3f}", depth_over_diameter=f"{found.depth / found.diameter:.3f}", volume_mm3=f"{1e9 * found.volume:.1f}", fit_mm=f"{depth:.3f}",
               error_percent=f"{100 * (1e3 * found.depth / depth - 1):+.1f}", particles=len(hvi.Dump(folder / "crater.dump", mirror="none")[0]), core_s=f"{ranks * (time.time() - start):.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--ranks", type=int, default=1)
    args = parser.parse_args()
    rows = read()
    for number, row in enumerate(rows, 1):
        if args.table or bool(row.get("depth_mm")) != args.again:
            continue
        run(row, HERE / "runs" / str(number), args.ranks)
        tables.write_csv(TABLE, (*GIVEN, *FOUND), [[row.get(name) or "" for name in (*GIVEN, *FOUND)] for row in rows])
        print(number, row["depth_mm"], row["error_percent"], flush=True)
    print(tables.text((*GIVEN, *FOUND), [[row.get(name) or "" for name in (*GIVEN, *FOUND)] for row in rows]))


if __name__ == "__main__":
    main()
