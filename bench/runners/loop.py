# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The cost of a step: an input of bench/dem or bench/sph for one style, its last loop. Nothing is compared with a solution."""

import pathlib
import re
import subprocess

HERE = pathlib.Path(__file__).resolve().parents[1]
ENV = HERE.parent / "cmake" / "env.sh"


def measure(text):
    """particles, steps, s of the last loop of a log; steps per list, bytes per particle, seconds by LAMMPS's table"""
    loops = re.findall(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", text)
    seconds, ranks, steps, atoms = (float(x) for x in loops[-1])
    memory = re.findall(r"Per MPI rank memory allocation .* = \S+ \| (\S+) \| \S+ Mbytes", text)[-1]
    parts = re.findall(r"^(Pair|Bond|Neigh|Comm|Modify) +\| \S+ +\| (\S+)", text, re.M)
    return {"particles": int(atoms), "steps": int(steps), "loop_s": seconds,
            "numbers": {"bytes_per_particle": round(float(memory) * 2**20 * ranks / atoms), "rebuilds": int(re.findall(r"Neighbor list builds = (\d+)", text)[-1]),
                        **{f"{k.lower()}_s": float(v) for k, v in parts}}}


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    variables = {**case.get("base", {}), **{k: v for k, v in settings.items() if k not in ("method", "ranks", "repeat")}}
    style = case["methods"][settings["method"]]["style"]
    command = [ENV, "mpirun", "-np", ranks, lmp, "-in", HERE / case["scene"], "-log", "log", "-screen", "none", "-var", "style", style]
    if case.get("folder"):
        command += ["-var", "dir", HERE / case["folder"]]
    for key, value in variables.items():
        command += ["-var", key, value]
    done = subprocess.run(["timeout", str(timeout), *map(str, command)], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        found = re.search(r"^ERROR[^:\n]*: *(.*)$", done.stdout, re.M)
        return {"failed": found.group(1) if found else f"ended with {done.returncode}", "particles": 0, "steps": 0, "loop_s": 0, "errors": {}, "numbers": {}, "ledger": {}}
    return {"failed": "", "errors": {}, "ledger": {}, **measure((folder / "log").read_text())}
