#!/usr/bin/env python3
"""What labelling fragments costs in time steps of the same run, stock computes beside.

    bench/fragments.py --build build --out build/bench-fragments [--size small|full] [--ranks 2] [--repeat 3]

Times are LAMMPS's own loop times, medians of differences between runs that follow each other.
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

# states of the debris cloud at which fragments are timed, and what in.debris has changed there
STATES = [("start", {}), ("after the impact", {}), ("end", {"skin": "0.8", "bins": "1.8", "C": "0.15"})]
STOCK = ["fragment", "aggregate", "cluster"]
SIZES = {"small": {"still": "20", "move": "300"}, "full": {"still": "10", "move": "400"}}


def lammps(args, script, variables, label, may_fail=False, folder=None):
    """Run one input, in args.out if no other folder is given; return its log as text.  If it may fail: None if it did, or took 10 minutes."""
    log = os.path.join(args.out, "log.%s" % re.sub(r"\W+", "-", label))
    cmd = ["mpirun", "-np", str(args.ranks), os.path.join(args.build, "lmp"), "-in", script,
           "-log", log, "-screen", "none"]
    for key, value in variables.items():
        cmd += ["-var", key, value]
    if may_fail:
        cmd = ["timeout", "600"] + cmd
    done = subprocess.run(cmd, cwd=folder or args.out, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
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


def states(args):
    """Restart files of the debris cloud, made once: 20 steps after the start, at 3 us, at the end."""
    out = os.path.join(args.out, "fragments-" + args.size)
    files = [os.path.join(out, "state.%d" % n) for n in range(len(STATES))]
    a, b = (os.path.join(out, "debris.restart." + x) for x in "ab")
    variables = {"out": out, "N": "740000" if args.size == "full" else "30000", "C": "0.25"}
    example = os.path.join(ROOT, "examples/debris-cloud")    # which has the inputs that these include
    os.makedirs(out, exist_ok=True)
    start = time.time()
    if not os.path.exists(files[1]):
        lammps(args, os.path.join(HERE, "dem/in.states"), dict(variables, tstop="3"), "states-impact", folder=example)
        shutil.move(a, files[0])
        shutil.move(b, files[1])
    if not os.path.exists(files[2]):
        end = "32" if args.size == "full" else "12"
        lammps(args, os.path.join(HERE, "dem/in.states.continue"), {**variables, "tstop": end, "from": files[1]}, "states-flight", folder=example)
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
    lines = ["# Fragments", "", "%s, %d ranks, size %s, %d runs of each" % (cpu, args.ranks, args.size, args.repeat)]
    data = {}
    fragments(args, lines, data)
    with open(os.path.join(args.out, "report.md"), "w") as f:
        f.write("\n".join(lines) + "\n")
    with open(os.path.join(args.out, "report.json"), "w") as f:
        json.dump(data, f, indent=1)
    print("\nreport: %s" % os.path.join(args.out, "report.md"))


if __name__ == "__main__":
    main()
