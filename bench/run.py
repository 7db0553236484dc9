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
import shutil
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)

# name, input, styles (ours first), variables
SCENES = [
    ("intact lattice, rebuild every 10 steps", "dem/in.lattice", ["hvi", "bpm", "lj", "harmonic"],
     {"T": "0.0001", "every": "10", "check": "no"}),
    ("hot lattice, bonds break", "dem/in.lattice", ["hvi", "bpm", "lj"],
     {"T": "0.5", "every": "5", "check": "yes"}),
    ("sphere on plate, 6.7 km/s", "dem/in.cloud", ["hvi", "bpm"], {}),
    ("stirred liquid, SPH without strength", "sph/in.tait", ["hvi", "parity", "stock"], {}),
    ("stirred solid: strength, damage, spall", "sph/in.solid", ["hvi", "riemann", "law", "plain", "ulsph"], {"dir": os.path.join(HERE, "sph")}),
]
FULL = {"dem/in.lattice": {"steps": "1000"}, "dem/in.cloud": {"N": "240000", "steps": "12000", "dt": "1.25e-10"},
        "sph/in.tait": {"steps": "400"}}

# states of the debris cloud at which fragments are timed, and what in.debris has changed there
STATES = [("start", {}), ("after the impact", {}), ("end", {"skin": "0.8", "bins": "1.8", "C": "0.15"})]
STOCK = ["fragment", "aggregate", "cluster"]
SIZES = {"small": {"still": "20", "move": "300"}, "full": {"still": "10", "move": "400"}}


def lammps(args, script, variables, label, may_fail=False):
    """Run one input; return its log as text.  If it may fail: None if it did, or took 10 minutes."""
    log = os.path.join(args.out, "log.%s" % re.sub(r"\W+", "-", label))
    cmd = ["mpirun", "-np", str(args.ranks), os.path.join(args.build, "lmp"), "-in", script,
           "-log", log, "-screen", "none"]
    for key, value in variables.items():
        cmd += ["-var", key, value]
    if may_fail:
        cmd = ["timeout", "600"] + cmd
    done = subprocess.run(cmd, cwd=args.out, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode and may_fail:
        return None
    if done.returncode:
        sys.exit("failed: %s\n%s" % (" ".join(cmd), done.stdout[-2000:]))
    with open(log) as f:
        return f.read()


def measure(text):
    """Loop time, particle-steps per second, memory per particle, rebuilds, use of the cores, breakdown of a log."""
    loops = re.findall(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", text)
    time, ranks, steps, atoms = (float(x) for x in loops[-1])
    memory = re.findall(r"Per MPI rank memory allocation .* = \S+ \| (\S+) \| \S+ Mbytes", text)[-1]
    parts = dict(re.findall(r"^(Pair|Bond|Neigh|Comm|Modify) +\| \S+ +\| (\S+)", text, re.M))
    return {"time": time, "rate": atoms * steps / time, "bytes": float(memory) * 2**20 * ranks / atoms,
            "builds": int(re.findall(r"Neighbor list builds = (\d+)", text)[-1]),
            "cpu": float(re.findall(r"([\d.]+)% CPU use", text)[-1]),
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


def states(args):
    """Restart files of the debris cloud, made once: 20 steps after the start, at 3 us, at the end."""
    out = os.path.join(args.out, "fragments-" + args.size)
    files = [os.path.join(out, "state.%d" % n) for n in range(len(STATES))]
    a, b = (os.path.join(out, "debris.restart." + x) for x in "ab")
    variables = {"debris": os.path.join(ROOT, "examples/debris-cloud/in.debris"), "out": out,
                 "size": "paper" if args.size == "full" else "small", "C": "0.25"}
    os.makedirs(out, exist_ok=True)
    start = time.time()
    if not os.path.exists(files[1]):
        lammps(args, os.path.join(HERE, "dem/in.states"), dict(variables, tstop="3"), "states-impact")
        shutil.move(a, files[0])
        shutil.move(b, files[1])
    if not os.path.exists(files[2]):
        shutil.copy(files[1], b)
        lammps(args, os.path.join(HERE, "dem/in.states"), dict(variables, resume="b"), "states-flight")
        shutil.move(b, files[2])
    print("states of the debris cloud: %.0f s" % (time.time() - start), flush=True)
    for name in os.listdir(out):    # dumps of hundreds of Mbytes
        if not name.startswith("state."):
            os.remove(os.path.join(out, name))
    return files


def parse(text):
    """What in.fragments prints: results by name, and measurements of its runs by name."""
    results = {k: float(v) for k, v in re.findall(r"^== (\w+) ([-+.\de]+)$", text, re.M)}
    runs = {}
    chunks = re.split(r"^== run (\w+)$", text, flags=re.M)
    for name, chunk in zip(chunks[1::2], chunks[2::2]):
        runs.setdefault(name, []).append(measure(chunk))
    return results, runs


def cost(runs, name, steps, key=lambda r: r["time"]):
    """Seconds that one labelling takes: runs with it less the runs without that went before."""
    return statistics.median(key(a) - key(b) for a, b in zip(runs[name], runs["none"])) / steps


def time_fragments(args, name, variables):
    """One state: ours (a dict of results and costs), and the same for each stock compute."""
    script = os.path.join(HERE, "dem/in.fragments")
    still, move = int(variables["still"]), int(variables["move"])
    runs = {}
    for n in range(args.repeat):
        results, once = parse(lammps(args, script, variables, "fragments-" + name))
        for key in once:
            runs.setdefault(key, []).extend(once[key])
    step = statistics.median(r["time"] for r in runs["off"]) / move
    ours = dict(results, name=name, step=step, cpu=statistics.median(r["cpu"] for r in runs["off"]),
                rebuilds=100 * statistics.median(r["builds"] for r in runs["off"]) / move,
                slower=[a["time"] / b["time"] - 1 for a, b in zip(runs["on"], runs["off"])])
    for what in ("label", "table", "cloud"):
        ours[what + "_s"] = cost(runs, what, still)
        ours[what + "_modify_s"] = cost(runs, what, still, lambda r: r["parts"]["Modify"])
    stock = []
    for style in STOCK:
        row = {"name": name, "style": style, "right": results["label"], "step": step}
        text = lammps(args, script, dict(variables, style=style, still="2"), style + "-" + name,
                      may_fail=style == "fragment")
        if text:
            results_too, runs = parse(text)
            row.update(found=results_too[style], s=cost(runs, style, 2))
        stock.append(row)
    return ours, stock


def fragments(args, lines, data):
    """Cost of labelling and statistics in time steps of the same run, and stock computes beside them."""
    rows = [time_fragments(args, name, dict(SIZES[args.size], **changed, state=state))
            for (name, changed), state in zip(STATES, states(args))]
    ours = [r[0] for r in rows]
    stock = sorted((s for r in rows for s in r[1]), key=lambda s: STOCK.index(s["style"]))
    data["fragments"] = {"ours": ours, "stock": stock}

    lines += ["", "## fragments of the debris cloud, %d particles" % ours[0]["atoms"], "",
              "Idle cores: LAMMPS's CPU use was %.0f %% or more; much less than 100 %% spoils the numbers." % min(r["cpu"] for r in ours), "",
              "| state | time us | broken bonds | fragments | step ms (rebuilds in 100) | what | ms (LAMMPS's timer) | in steps |"
              " every 100 steps: slower by | measured (min - max) |",
              "|---|---|---|---|---|---|---|---|---|---|"]
    for r in ours:
        lines.append("| %s | %.2f | %.1f %% | %d | %.2f (%.1f) |" % (
            r["name"], r["us"], 100 * (1 - r["bonds"] / ours[0]["bonds"]), r["label"], 1e3 * r["step"], r["rebuilds"]))
        slower = [100 * f(r["slower"]) for f in (statistics.median, min, max)]
        for what, style in (("label", "hvi/fragment/atom"), ("table", "hvi/fragment"), ("cloud", "hvi/cloud")):
            steps = r[what + "_s"] / r["step"]
            lines[-1] += " %s | %.2f (%.2f) | %.2f | %.2f %% | %s |" % (
                style, 1e3 * r[what + "_s"], 1e3 * r[what + "_modify_s"], steps, steps,
                "%.1f %% (%.1f - %.1f)" % tuple(slower) if what == "table" else "")
            print(lines[-1], flush=True)
            if what != "cloud":
                lines.append("| | | | | |")
    lines += ["", "| stock compute | state | fragments found | there are | ms | in steps |", "|---|---|---|---|---|---|"]
    for r in ours:
        lines.append("| fragment/atom beside hvi/spring | %s | %d | %d | | |" % (r["name"], r["fragment"], r["label"]))
    for s in stock:
        found, ms = "none: it crashed", " | "
        if "found" in s:
            found, ms = "%d" % s["found"], "%.0f | %.1f" % (1e3 * s["s"], s["s"] / s["step"])
        lines.append("| %s/atom | %s | %s | %d | %s |" % (s["style"], s["name"], found, s["right"], ms))
        print(lines[-1], flush=True)


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
    fragments(args, lines, data)
    with open(os.path.join(args.out, "report.md"), "w") as f:
        f.write("\n".join(lines) + "\n")
    with open(os.path.join(args.out, "report.json"), "w") as f:
        json.dump(data, f, indent=1)
    figure(data, os.path.join(args.out, "speed-error.png"))
    print("\nreport: %s" % os.path.join(args.out, "report.md"))


if __name__ == "__main__":
    main()
