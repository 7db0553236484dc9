#!/usr/bin/env python3
"""Runs the stock SPH examples with stock styles, in parity mode and in our own mode, in turn, and compares them.

    python3 compare.py [--lmp ../../build/lmp] [--ranks 1] [--repeat 3] [--out .] [--cases shock2,shock3,collapse]

Prints the table of README.md and draws comparison.png. Times are those of the runs alone, medians; the ratio is stock's time
over this one's, turn by turn, so that a machine whose speed drifts does not decide it. Exact solution: tests/reference/gas.py.
"""

import argparse
import os
import statistics
import subprocess
import sys

import numpy as np
import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.environ.get("HVI_ROOT", os.path.join(HERE, "..", "..")), "tests"))
from reference import gas  # noqa: E402

SHOCK = {"stock": {"style": "stock"}, "parity": {"style": "parity"}, "hvi": {},
         "hvi, cubic": {"pair": "cubic h constant interface 0.3", "h": "2"}, "hvi, cubic, interface 0": {"pair": "cubic h constant interface 0", "h": "2"}}
CASES = {
    "shock2": ("in.shock", {"dim": "2"}, SHOCK),
    "shock3": ("in.shock", {"dim": "3"}, SHOCK),
    "collapse": ("in.collapse", {}, {name: {"style": name} for name in ("stock", "parity", "hvi")}),
    "one": ("in.shock", {"dim": "2", "rho": "1"}, {name: {"style": name} for name in ("stock", "parity")}),  # gases of one type
}
WINDOW = 50.0  # on both sides of where the gases met: waves, and no more of the ends of the box than gas at rest
MEMBRANE = 0.5  # between the last particle on the left and the first on the right


def result(folder):
    """result.yaml as a dict"""
    with open(os.path.join(folder, "result.yaml")) as f:
        return yaml.safe_load(f)


def shock(folder):
    """x from the membrane, and rho, u, p of the particles and of the exact solution there: (n,), (3, n), (3, n)"""
    r = result(folder)
    x, u, rho, e, _ = np.loadtxt(os.path.join(folder, "profile.dat")).T
    near = np.abs(x - MEMBRANE) <= WINDOW
    x, u, rho, e = x[near] - MEMBRANE, u[near], rho[near], e[near]
    right = float(r["rho_right"]), 0.0, float(r["p_right"])
    return x, np.array([rho, u, 0.4 * rho * e]), gas.sample(x / float(r["time"]), (1.0, 0.0, 1.0), right)


def errors(folder):
    """mean |error| of rho, u and p over the particles"""
    _, mine, exact = shock(folder)
    return np.abs(mine - exact).mean(axis=1)


def run(args, script, variables, folder):
    os.makedirs(folder, exist_ok=True)
    command = [os.path.abspath(args.lmp), "-in", script, "-log", os.path.join(folder, "log"), "-screen", "none", "-var", "out", folder]
    if args.ranks > 1:
        command = ["mpirun", "-np", str(args.ranks), *command]
    for name, value in variables.items():
        command += ["-var", name, value]
    if subprocess.run([os.path.join(HERE, "..", "..", "cmake", "env.sh"), *command], cwd=HERE).returncode:  # the inputs read files beside them
        sys.exit("failed: " + " ".join(command))
    return float(result(folder)["wall_s"])


def table(args, case):
    script, variables, runs = CASES[case]
    folders = {name: os.path.join(args.out, "runs", case, name.replace(", ", "-").replace(" ", "")) for name in runs}
    times = {name: [] for name in runs}
    for _ in range(args.repeat):
        for name, extra in runs.items():
            times[name].append(run(args, script, {**variables, **extra}, folders[name]))
    for name, folder in folders.items():
        r = result(folder)
        ratio = statistics.median(s / t for s, t in zip(times["stock"], times[name]))
        error = " | ".join(f"{e:.4f}" for e in errors(folder)) if script == "in.shock" else "| |"
        print(f"| {case} | {name} | {error} | {float(r['energy_ratio']) - 1:.1e} | {float(r['momentum_error']):.0e} "
              f"| {r['steps']} | {statistics.median(times[name]):.2f} | {ratio:.2f} |", flush=True)
    return folders, {name: statistics.median(t) for name, t in times.items()}


def apart(case, folders):
    """distances of the places of particles between stock and parity"""
    here, there = (np.loadtxt(os.path.join(folders[name], "profile.dat")) for name in ("stock", "parity"))
    columns = slice(2, 4) if case == "collapse" else slice(0, 1)
    distance = np.linalg.norm(here[:, columns] - there[:, columns], axis=1)
    print(f"{case}: distance of places between stock and parity, mean {distance.mean():.2g}, largest {distance.max():.2g}", flush=True)


def draw(args, done):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    color = {"stock": "C0", "parity": "C2", "hvi": "C3", "hvi, cubic": "C1", "hvi, cubic, interface 0": "C4"}
    figure, axes = plt.subplots(2, 2, figsize=(12, 8.5))
    profile, error, left, right = axes.flat

    folders, _ = done["shock2"]
    for name in ("stock", "hvi"):
        x, mine, _ = shock(folders[name])
        profile.plot(x, mine[0], ".", ms=4, color=color[name], label=name)
    g = np.linspace(-WINDOW, WINDOW, 2000)
    r = result(folders["stock"])
    exact = gas.sample(g / float(r["time"]), (1.0, 0.0, 1.0), (float(r["rho_right"]), 0.0, float(r["p_right"])))
    profile.plot(g, exact[0], "k", lw=0.8, label="exact")
    profile.set(xlabel="x", ylabel="density", title="Shock tube, 2d, t = 20")
    profile.legend()

    for case, marker in (("shock2", "o"), ("shock3", "s")):
        if case not in done:
            continue
        folders, times = done[case]
        for name in folders:
            error.plot(times[name], errors(folders[name])[0], marker, ms=8, color=color[name], label=f"{name}, {case[-1]}d")
    error.set(xscale="log", ylim=(0, 0.017), xlabel="time of the run (s)", ylabel="mean |density error|", title="Error and time")
    error.legend(fontsize=8, ncol=2, loc="lower right")
    error.grid(alpha=0.3)

    for axis, name in ((left, "stock"), (right, "hvi")):
        axis.set_aspect("equal")
        if "collapse" in done:
            d = np.loadtxt(os.path.join(done["collapse"][0][name], "profile.dat"))
            water = d[:, 1] == 1
            axis.plot(d[water, 2], d[water, 3], ".", ms=1.5, color=color[name])
            axis.plot(d[~water, 2], d[~water, 3], ".", ms=1, color="0.5")
        axis.set(xlabel="x (m)", ylabel="y (m)", title=f"Water column, t = 1 s: {name}")
    figure.tight_layout()
    figure.savefig(os.path.join(args.out, "comparison.png"), dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "..", "build", "lmp"))
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--out", default=HERE)
    parser.add_argument("--cases", default="shock2,shock3,collapse", help="of these and one: in two dimensions, gases of one type")
    args = parser.parse_args()
    args.out = os.path.abspath(args.out)
    print("| case | style | error of rho | of u | of p | energy ratio - 1 | momentum error | steps | time s | stock/this |\n"
          "|---|---|---|---|---|---|---|---|---|---|")
    done = {case: table(args, case) for case in args.cases.split(",")}
    print()
    for case, (folders, _) in done.items():
        apart(case, folders)
    if "shock2" in done:
        draw(args, done)


if __name__ == "__main__":
    main()
