#!/usr/bin/env python3
"""Speed of the package beside stock LAMMPS, and speed against error: one report.

    bench/run.py --build build --out build/bench [--size small|full] [--ranks 2] [--repeat 3]

Times are LAMMPS's own loop times.  The styles of a scene run in turn, A B C A B C ..., and the
report gives medians and the ratio run by run, so that a machine whose speed drifts does not
decide the outcome.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)

# name, input, styles (ours first), variables
SCENES = [
    ("intact lattice, rebuild every 10 steps", "dem/in.lattice", ["hvi", "bpm", "lj", "harmonic"],
     {"T": "0.0001", "every": "10", "check": "no"}),
    ("hot lattice, bonds break", "dem/in.lattice", ["hvi", "bpm", "lj"],
     {"T": "0.5", "every": "5", "check": "yes"}),
    ("sphere on plate, 6.7 km/s", "dem/in.cloud", ["hvi", "bpm"], {}),
]
FULL = {"dem/in.lattice": {"steps": "1000"}, "dem/in.cloud": {"N": "240000", "steps": "12000", "dt": "1.25e-10"}}


def lammps(args, script, variables, label):
    """Run one input; return its log as text."""
    log = os.path.join(args.out, "log.%s" % re.sub(r"\W+", "-", label))
    cmd = ["mpirun", "-np", str(args.ranks), os.path.join(args.build, "lmp"), "-in", script,
           "-log", log, "-screen", "none"]
    for key, value in variables.items():
        cmd += ["-var", key, value]
    done = subprocess.run(cmd, cwd=args.out, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("failed: %s\n%s" % (" ".join(cmd), done.stdout[-2000:]))
    with open(log) as f:
        return f.read()


def measure(text):
    """Loop time, particle-steps per second, memory per particle, rebuilds, breakdown of a log."""
    loops = re.findall(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", text)
    time, ranks, steps, atoms = (float(x) for x in loops[-1])
    memory = re.findall(r"Per MPI rank memory allocation .* = \S+ \| (\S+) \| \S+ Mbytes", text)[-1]
    parts = dict(re.findall(r"^(Pair|Bond|Neigh|Comm|Modify) +\| \S+ +\| (\S+)", text, re.M))
    return {"time": time, "rate": atoms * steps / time, "bytes": float(memory) * 2**20 * ranks / atoms,
            "builds": int(re.findall(r"Neighbor list builds = (\d+)", text)[-1]),
            "parts": {k: float(v) for k, v in parts.items()}}


def compare(args, lines, data):
    for name, script, styles, variables in SCENES:
        runs = {style: [] for style in styles}
        for n in range(args.repeat):
            for style in styles:
                extra = dict(variables, style=style)
                if args.size == "full":
                    extra.update(FULL[script])
                runs[style].append(measure(lammps(args, os.path.join(HERE, script), extra, name + style)))
        lines += ["", "## " + name, "",
                  "| style | time s | M particle-steps/s | hvi is faster by (min - max) | rebuilds | bytes/particle |"
                  " pair | bond | neigh | comm | modify |",
                  "|---|---|---|---|---|---|---|---|---|---|---|"]
        for style in styles:
            med = statistics.median
            ratios = [b["time"] / a["time"] for a, b in zip(runs[styles[0]], runs[style])]
            parts = [med(r["parts"].get(k, 0.0) for r in runs[style]) for k in ("Pair", "Bond", "Neigh", "Comm", "Modify")]
            lines.append("| %s | %.3f | %.2f | %.2f (%.2f - %.2f) | %d | %.0f | %s |" % (
                style, med(r["time"] for r in runs[style]), med(r["rate"] for r in runs[style]) / 1e6,
                med(ratios), min(ratios), max(ratios), runs[style][0]["builds"], runs[style][0]["bytes"],
                " | ".join("%.3f" % p for p in parts)))
            print(lines[-1], flush=True)
        data[name] = runs


def speed_against_error(args, lines, data):
    """The debris cloud at several time step factors: time against the drift of the ledger."""
    lines += ["", "## debris cloud: time step against error of the energy ledger", "",
              "| C | steps | wall s | largest drift | drift at the end | fragmentation F |", "|---|---|---|---|---|---|"]
    rows = []
    for c in ("0.2", "0.1", "0.05", "0.025"):
        out = os.path.join(args.out, "debris-C" + c)
        os.makedirs(out, exist_ok=True)
        variables = {"C": c, "out": out, "every": "100"}
        if args.size == "small":
            variables.update(tstop="6", N="15000")
        text = lammps(args, os.path.join(ROOT, "examples/debris-cloud/in.debris"), variables, "debris" + c)
        result = {}
        with open(os.path.join(out, "result.yaml")) as f:
            for line in f:
                key, _, value = line.partition(":")
                result[key.strip()] = value.strip()
        ratios = [float(x) for x in re.findall(r"^ +\d+ .* (\d\.\d{9}) *$", text, re.M)]
        rows.append({"C": float(c), "steps": int(result["steps"]), "wall": float(result["wall_s"]),
                     "largest": max(abs(r - 1.0) for r in ratios),
                     "end": abs(float(result["energy_ratio"]) - 1.0), "F": float(result["fragmentation"])})
        lines.append("| %(C)g | %(steps)d | %(wall).1f | %(largest).1e | %(end).1e | %(F).3f |" % rows[-1])
        print(lines[-1], flush=True)
    data["speed against error"] = rows


def figure(data, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    rows = data["speed against error"]
    plt.figure(figsize=(5, 4))
    plt.loglog([r["wall"] for r in rows], [r["largest"] for r in rows], "o-", label="largest")
    plt.loglog([r["wall"] for r in rows], [r["end"] for r in rows], "s--", label="at the end")
    for r in rows:
        plt.annotate("C = %g" % r["C"], (r["wall"], r["largest"]), textcoords="offset points", xytext=(6, 4))
    plt.axhline(1e-5, color="0.7", lw=1)
    plt.margins(x=0.2, y=0.1)
    plt.xlabel("wall time (s)")
    plt.ylabel("|drift of total energy|")
    plt.title("debris cloud: speed against error")
    plt.legend()
    plt.tight_layout()
    plt.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help="folder with lmp")
    parser.add_argument("--out", required=True, help="folder for logs and the report")
    parser.add_argument("--size", choices=["small", "full"], default="small")
    parser.add_argument("--ranks", type=int, default=min(2, os.cpu_count() or 1))
    parser.add_argument("--repeat", type=int, default=3)
    args = parser.parse_args()
    args.build, args.out = os.path.abspath(args.build), os.path.abspath(args.out)
    os.makedirs(args.out, exist_ok=True)

    cpu = "unknown processor"
    if os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo") as f:
            cpu = re.search(r"model name\s*: (.*)", f.read() + "model name : unknown").group(1)
    lines = ["# Benchmark report", "", "%s, %d ranks, size %s, %d runs of each" % (cpu, args.ranks, args.size, args.repeat)]
    data = {}
    compare(args, lines, data)
    speed_against_error(args, lines, data)
    with open(os.path.join(args.out, "report.md"), "w") as f:
        f.write("\n".join(lines) + "\n")
    with open(os.path.join(args.out, "report.json"), "w") as f:
        json.dump(data, f, indent=1)
    figure(data, os.path.join(args.out, "speed-error.png"))
    print("\nreport: %s" % os.path.join(args.out, "report.md"))


if __name__ == "__main__":
    main()
