#!/usr/bin/env python3
"""Strong and weak scaling on the cores that there are, and a model beyond them that is checked by counting.

    bench/scaling.py --build build --out build/scaling [--only times,costs,follow,check,model,columns] [--dx 0.5]

times   examples/single-plate (a quarter) and bench/sph/in.solid on 1 and 2 ranks: wall times
costs   processor time of a particle and of a ghost: in.solid, periodic, on 1 rank: the smaller, the more ghosts
follow  the plate on 1 rank: who is awake where, lists made, time of a particle-step
check   both scenes on 4, 8 and 16 ranks, the plate in columns of a grid and bisected, whatever the number of cores: bytes and messages that Open MPI's monitoring of its
        messages (pml monitoring) counts, against what the model says; volumes, never times
model   what these numbers make of large plates and cubes on many ranks; check and model need what costs and follow left in --out
columns how evenly fixes that balance share the plate, on more ranks than cores, too: sums of costs, never times

Only Open MPI can do the check.  The model is in functions without LAMMPS; tests/python/test_scaling_model.py tests them.
"""
import argparse
import copy
import glob
import itertools
import json
import math
import os
import re
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
PLATE = os.path.join(ROOT, "examples/single-plate/in.plate")
SOLID = os.path.join(HERE, "sph/in.solid")
DOUBLE = 8

# atom_style sph: x, rho, esph, vest to ghosts; f, drho, desph back; x, tag, type, mask, rho, esph, cv, vest of a new one
FORWARD, REVERSE, BORDER = 8, 5, 12
REDUCTIONS = 2  # of a step over all ranks: hvi/lists, hvi/dt
ATOM_BYTES = 156 + 28  # of atom_style sph and hvi/lists, owned particles and ghosts
BALANCE_REDUCTIONS = 30  # of fix balance shift: 18 and 26 were counted on 4 and 16 ranks
MEDIAN = 20  # reductions by which RCB finds where to cut one direction, not counted: the tolerance is the cost of a particle
TOUCH = 1e-9  # m: nothing is between what is so near
BUILD_REDUCTIONS = {"grid": 4, "bisected": 9}  # of new lists, counted: shrink-wrapped box, ranks that ghosts come from (of unequal domains), narrowest domain; layout of tiles


# ---------------------------------------------------------------------- the model, without LAMMPS

def exchanges(lists):
    """How often a step of solids sends to ghosts, and back: atom_style, limits, tractions, displacements; atom_style, M and L, forces."""
    return 3 + lists, 3


def sent_ghosts(widths, ranks, cut, periodic):
    """Particles that a rank in the middle of a full lattice gets from others, for one forward exchange.

    widths: of its domain, spacings; ranks: the grid; a direction with one rank costs no message, but what it adds to the
    ghosts of directions before it is copied on by those after it."""
    now, sent = float(np.prod(widths)), 0.0
    wide = list(widths)
    for k in range(3):
        more = now * 2 * cut / wide[k] if periodic[k] or ranks[k] > 1 else 0.0
        if ranks[k] > 1:
            sent += more
        now += more
        wide[k] += 2 * cut if more else 0.0
    return sent


def halo_messages(ranks, periodic):
    """Messages of one exchange with ghosts, all ranks together, domains being wider than the cutoff."""
    return sum(2 * math.prod(ranks) // n * (n if around else n - 1) for n, around in zip(ranks, periodic) if n > 1)


def list_messages(ranks):
    """Those of new lists beside halo_messages(), empty ones too: who has left for the rank next door, and how many are to
    come, in either direction, if these are two ranks; numbers of new ghosts."""
    return math.prod(ranks) * sum((4 if n > 2 else 2) + 2 for n in ranks if n > 1)


class Map:
    """Particles over the x-y plane as a density in bins: how many there are in any column; columns are rows of x from, x to, y from, y to."""

    def __init__(self, x, y, weight, edges):
        self.edges = edges
        table = np.histogram2d(x, y, bins=(edges, edges), weights=weight)[0]
        self.cumulated = np.pad(table.cumsum(0).cumsum(1), ((1, 0), (1, 0)))

    def between(self, other, share):
        """this share of the way to another map of the same bins"""
        made = copy.copy(self)
        made.cumulated = (1 - share) * self.cumulated + share * other.cumulated
        return made

    def below(self, x, y):
        """how many have smaller x and y, linear within bins; of arrays of one shape"""
        def place(values):
            at = np.clip(np.interp(values, self.edges, np.arange(len(self.edges))), 0, len(self.edges) - 1)
            low = np.minimum(at.astype(int), len(self.edges) - 2)
            return low, at - low
        (i, u), (j, v) = place(x), place(y)
        c = self.cumulated
        return (1 - u) * (1 - v) * c[i, j] + u * (1 - v) * c[i + 1, j] + (1 - u) * v * c[i, j + 1] + u * v * c[i + 1, j + 1]

    def inside(self, columns, margin=0.0):
        """how many are in each column, made wider on all sides by margin"""
        left, right, front, rear = columns[:, 0] - margin, columns[:, 1] + margin, columns[:, 2] - margin, columns[:, 3] + margin
        return self.below(right, rear) - self.below(right, front) - self.below(left, rear) + self.below(left, front)

    def grid(self, n, least=0.0):
        """columns of fix balance shift xy: n[0] by n[1]"""
        xcuts, ycuts = (self.cuts(k, n[k], least) for k in (0, 1))
        return np.stack([np.repeat(xcuts[:-1], n[1]), np.repeat(xcuts[1:], n[1]), np.tile(ycuts[:-1], n[0]), np.tile(ycuts[1:], n[0])], 1)

    def bisected(self, n):
        """columns of fix hvi/balance: LAMMPS's RCB halves n ranks and the weight, across the direction in which the narrower part is the wider one"""
        def halves(column, n):
            if n == 1:
                return [column]
            lower = (n - 1) // 2 + 1
            found = [self.halved(column, axis, lower / n) for axis in (0, 1)]
            axis = int(np.argmax([min(cut - column[2 * k], column[2 * k + 1] - cut) for k, cut in enumerate(found)]))
            one, other = column.copy(), column.copy()
            one[2 * axis + 1] = other[2 * axis] = found[axis]
            return halves(one, lower) + halves(other, n - lower)

        ends = []
        for marginal in (self.cumulated[:, -1], self.cumulated[-1]):  # RCB begins with the box about all particles
            full = np.flatnonzero(np.diff(marginal))
            ends += [self.edges[full[0]], self.edges[full[-1] + 1]]
        return np.array(halves(np.array(ends), n))

    def halved(self, column, axis, share):
        """where a column is cut so that this share of its weight is below"""
        ends, sides = column[2 * axis:2 * axis + 2], column[2 - 2 * axis:4 - 2 * axis]
        at = np.concatenate([ends[:1], self.edges[(self.edges > ends[0]) & (self.edges < ends[1])], ends[1:]])
        of = [self.below(*(at, np.full_like(at, side))[::1 - 2 * axis]) for side in sides]
        weight = of[1] - of[0]
        return float(np.interp(weight[0] + share * (weight[-1] - weight[0]), weight, at))

    def cuts(self, axis, n, least=0.0):
        """where fix balance shift cuts a direction for n ranks: equal shares of all, apart by least"""
        edge = self.edges
        marginal = self.cumulated[:, -1] if axis == 0 else self.cumulated[-1]
        at = np.interp(np.linspace(0.0, marginal[-1], n + 1), marginal + 1e-12 * np.arange(len(edge)), edge)
        at[0], at[-1] = edge[0], edge[-1]
        for k in range(1, n):
            at[k] = max(at[k], at[k - 1] + least)
        for k in range(n - 1, 0, -1):
            at[k] = min(at[k], at[k + 1] - least)
        return at


def tiled_messages(columns, cut):
    """of each column in one exchange with ghosts: LAMMPS sends to all that are within the cutoff in x, or in y; what came in x is passed on in y, so corners cost no message"""
    left, right, front, rear = columns.T
    found = np.zeros(len(columns), int)
    for k, (x0, x1, y0, y1) in enumerate(columns):
        beside, before = (front < y1) & (rear > y0), (left < x1) & (right > x0)
        found[k] = sum(np.count_nonzero(near) for near in (beside & (left < x0) & (right > x0 - cut), beside & (right > x1) & (left < x1 + cut),
                                                           before & (front < y0) & (rear > y0 - cut), before & (rear > y1) & (front < y1 + cut)))
    return found


def step_time(work, ghosts, ranks, near, sides, p, layout="grid"):
    """Seconds of a step, by what they go for.

    work: seconds that particles and ghosts cost, by rank; ghosts: by rank; near: messages of a rank in one exchange; sides: of a domain, with neighbors; p: see parameters().
    What one rank has more than the mean, all wait for; messages of a rank follow one another; reductions go up and down a tree."""
    mean, most = float(np.mean(work)), float(np.max(work))
    doubles = p["forward"] + p["reverse"] + p["builds"] * (p["border"] - FORWARD)
    messages = near * sum(p["exchanges"]) + p["builds"] * (2 * sides + near)
    reductions = REDUCTIONS + p["builds"] * BUILD_REDUCTIONS[layout]
    levels = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    if layout == "grid":
        reductions += p["balance_reductions"] / 50
    elif levels:  # RCB has them among half as many ranks at each level
        reductions += (2 * MEDIAN + 2) * (levels + 1) / 2 / 50
    halo = messages * p["latency"] + DOUBLE * doubles * float(np.max(ghosts)) / p["bandwidth"] if ranks > 1 else 0.0
    return {"work": mean, "waiting": most - mean, "halo": halo, "reductions": reductions * 2 * levels * p["latency"]}


def memory_of_rank(owned, ghosts, total, p):
    """bytes: particles, ghosts, and atom_modify map array: 4 for each ID there is, on every rank"""
    return p["owned_bytes"] * owned + p["ghost_bytes"] * ghosts + 4.0 * total


def grid_of(ranks):
    """two factors, as near to a square as they are"""
    return max((n, ranks // n) for n in range(1, int(math.sqrt(ranks)) + 1) if ranks % n == 0)


# ---------------------------------------------------------------------- runs

def scene(name, variables):
    """The head of an input, up to its runs."""
    if name == "plate":
        with open(PLATE) as f:
            text, mark, _ = f.read().partition("variable     left equal")
        if not mark:
            sys.exit("%s has no line 'variable left'" % PLATE)
        return text + "undump frame\nthermo 1000000\nthermo_style custom step cpu nbuild f_move time f_share\nthermo_modify lost ignore\n"
    with open(SOLID) as f:
        text, mark, rest = f.read().partition("run          ${stir}")
    if not mark:
        sys.exit("%s has no line 'run ${stir}'" % SOLID)
    text = text.replace("$(v_L/2)", "%s" % variables["Z"])
    return text + "comm_modify vel no\nneigh_modify every 1 delay 0 check yes\nthermo_style custom step time\nthermo 1000000\n"


def run(args, label, name, variables, tail, ranks, count=False, changes=()):
    """Run a scene, with changes of its text; its log, and what messages were counted: (bytes, messages, reductions) of all ranks."""
    folder = os.path.join(args.out, re.sub(r"[^\w.]+", "-", label))
    os.makedirs(folder, exist_ok=True)
    for old in glob.glob(os.path.join(folder, "*")):
        os.remove(old)
    with open(os.path.join(folder, "in"), "w") as f:
        text = scene(name, variables)
        for old, new in changes:
            if text.count(old) != 1:
                sys.exit("%s: no line with %s" % (name, old))
            text = text.replace(old, new)
        f.write(text + tail)
    cmd = ["mpirun", "-np", str(ranks)] + (["--oversubscribe"] if ranks > 2 else [])
    if count:
        cmd += ["--mca", "pml", "ob1,monitoring", "--mca", "pml_monitoring_enable", "2", "--mca", "pml_monitoring_enable_output", "3", "--mca", "pml_monitoring_filename", "mon"]
    cmd += [os.path.join(os.path.abspath(args.build), "lmp"), "-in", "in", "-screen", "none"]
    for key, value in variables.items():
        cmd += ["-var", key, str(value)]
    done = subprocess.run(cmd, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit("failed: %s in %s\n%s" % (" ".join(cmd), folder, done.stdout[-2000:]))
    with open(os.path.join(folder, "log.lammps")) as f:
        log = f.read()
    return (log, counted(folder, ranks)) if count else log


def counted(folder, ranks):
    """Sums of the files of pml monitoring: bytes and messages between ranks, calls that all ranks take part in."""
    size = number = calls = 0
    for rank in range(ranks):
        path = os.path.join(folder, "mon.%d.prof" % rank)
        if not os.path.exists(path):
            sys.exit("%s is missing: this MPI has no pml monitoring, which the check needs (Open MPI 4)" % path)
        with open(path) as f:
            text = f.read()
        for a, b in re.findall(r"^E\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs sent", text, re.M):
            size, number = size + int(a), number + int(b)
        if rank == 0:
            world = text.partition("MPI_COMM_WORLD")[2]
            calls = int(re.search(r"^A2A\t\d+\t\d+ bytes\t(\d+) msgs", world, re.M).group(1))
    return size, number, calls


def read_log(log):
    """What a log says of its last run, and the setup report."""
    found = {}
    loop = re.findall(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", log, re.M)[-1]
    found["time"], found["steps"], found["atoms"] = float(loop[0]), int(loop[2]), int(loop[3])
    found["cpu"] = found["time"] * 0.01 * float(re.findall(r"^([\d.]+)% CPU use", log, re.M)[-1])
    found["ghosts"] = float(re.findall(r"^Nghost: +(\S+) ave", log, re.M)[-1])
    found["builds"] = int(re.findall(r"^Neighbor list builds = (\d+)", log, re.M)[-1])
    found["cut"] = float(re.findall(r"ghost atom cutoff = (\S+)", log)[-1])
    found["memory"] = float(re.findall(r"memory allocation .* = \S+ \| (\S+) \| \S+ Mbytes", log)[-1]) * 2**20
    words = re.findall(r"doubles per ghost: (\d+) forward and (\d+) reverse in each step, (\d+) when new", log)[-1]
    found["forward"], found["reverse"], found["border"] = FORWARD + int(words[0]), REVERSE + int(words[1]), BORDER + int(words[2])
    found["terms"] = re.findall(r"^  terms: (.*)$", log, re.M)[-1]
    found["arrays"] = re.findall(r"^  arrays, bytes: (.*)$", log, re.M)[-1]
    found["grid"] = [int(n) for n in re.findall(r"(\d+) by (\d+) by (\d+) MPI processor grid", log)[-1]]
    return found


def plate_variables(dx):
    return {"dx": dx}


UNTIL = "variable ahead equal 16e-6-time\nfix stop all halt 1 v_ahead < 0.0 error continue message no\nrun 1000000\n"


def table(*heads):
    print("| %s |\n%s|" % (" | ".join(heads), "|---" * len(heads)), flush=True)


def times(args, data):
    """Wall times of whole runs, 1 and 2 ranks in turn."""
    rows = []
    table("scene", "ranks", "particles", "steps", "s", "us of a core per particle and step", "load of the machine")
    coarse = round(args.dx * 2 ** (1 / 3), 4)
    cases = [("plate, %g mm" % args.dx, "plate", plate_variables(args.dx), n) for n in (1, 2)]
    cases += [("plate, %g mm" % coarse, "plate", plate_variables(coarse), 1)]
    cases += [("solid, 32 x 32 x %d" % z, "solid", {"L": 32, "Z": z, "style": "riemann", "dir": os.path.join(HERE, "sph")}, n)
              for z, n in ((16, 1), (16, 2), (32, 2))]
    for label, name, variables, ranks in cases:
        tail = UNTIL if name == "plate" else "run 20\nrun 100\n"
        log = run(args, "times %s %d" % (label, ranks), name, variables, tail, ranks)
        found = read_log(log)
        rows.append({"scene": label, "ranks": ranks, "particles": found["atoms"], "steps": found["steps"], "s": found["time"],
                     "us": 1e6 * found["time"] * ranks / found["steps"] / found["atoms"], "load": os.getloadavg()[0]})
        print("| %(scene)s | %(ranks)d | %(particles)d | %(steps)d | %(s).1f | %(us).2f | %(load).1f |" % rows[-1], flush=True)
    data["times"] = rows


def costs(args, data):
    """Processor seconds of a particle and of a ghost, from cubes with more and fewer ghosts each; the least of some runs."""
    rows = []
    for side in (10, 12, 16, 20, 24, 28):
        variables = {"L": side, "Z": side, "style": "riemann", "dir": os.path.join(HERE, "sph")}
        found = [read_log(run(args, "costs %d" % side, "solid", variables, "run 20\nrun %d\n" % (200 if side < 16 else 40), 1)) for _ in range(args.repeat)]
        best = min(found, key=lambda f: f["cpu"])
        rows.append([best["atoms"], best["ghosts"], best["cpu"] / best["steps"]])
        print("%d particles, %d ghosts: %.2f us a particle" % (*rows[-1][:2], 1e6 * rows[-1][2] / rows[-1][0]), flush=True)
    rows = np.array(rows)
    share = 1.0 / rows[:, 2]  # relative errors count
    seconds = np.linalg.lstsq(rows[:, :2] * share[:, None], np.ones(len(rows)), rcond=None)[0]
    off = np.abs(rows[:, :2] @ seconds * share - 1).max()
    data["costs"] = {"rows": rows.tolist(), "particle_s": seconds[0], "ghost_s": seconds[1], "off": off}
    print("particle %.2f us, ghost %.2f us (fit off by %.0f %% at most)" % (1e6 * seconds[0], 1e6 * seconds[1], 100 * off), flush=True)


def follow(args, data):
    """The plate on one rank in one run: positions and who is asleep into dumps; time and lists of each 50 steps."""
    tail = "compute asleep all hvi/atom asleep\ndump d all custom 5 dump.* x y c_asleep c_cost\ndump_modify d format float %.5g\nthermo 50\n" + UNTIL
    log = run(args, "follow", "plate", plate_variables(args.dx), tail, 1)
    atoms = read_log(log)["atoms"]
    rows = re.findall(r"^ +(\d+) +(\S+) +(\d+) +(\S+) +\S+ +(\S+) *$", log, re.M)
    rows = np.array([[float(a) for a in row] for row in rows])
    rows = rows[np.flatnonzero(rows[:, 0] == 0)[-1]:]  # of the last run
    if rows[-1, 0] % 50:
        rows = rows[:-1]
    step, seconds, builds, asleep = rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3]
    mean = 0.5 * (asleep[1:] + asleep[:-1])
    spent, lists = np.diff(seconds), np.diff(builds)
    awake_s, asleep_s = np.linalg.lstsq(np.stack([50 * (atoms - mean), 50 * mean], 1), spent, rcond=None)[0]
    data["follow"] = {"dx": args.dx, "atoms": atoms, "steps": int(step[-1]), "seconds": seconds[-1], "builds": builds[-1] / step[-1], "lists": (lists / 50).tolist(),
                      "awake_s": awake_s, "asleep_s": max(asleep_s, 0.0), "frames": [int(n) for n in step], "awake": (1 - asleep / atoms).tolist()}
    print("awake %.2f us, asleep %.2f us a step; %.2f lists a step (%s); awake %s" % (
        1e6 * awake_s, 1e6 * asleep_s, data["follow"]["builds"], " ".join("%.2f" % n for n in lists / 50),
        " ".join("%.2f" % a for a in data["follow"]["awake"])), flush=True)


def read_maps(args, steps):
    """Of frames of follow and those LATER and twice LATER steps later: maps of all particles, of those awake, and of the costs that fixes see."""
    maps = []
    for step in steps:
        frames = [np.loadtxt(os.path.join(args.out, "follow", "dump.%d" % n), skiprows=9, unpack=True) for n in (step, step + LATER, step + 2 * LATER)]
        wide = 2e-3 * args.dx  # whole spacings: others would see stripes in a lattice
        edges = wide * np.arange(math.ceil(max(frame[:2].max() for frame in frames) / wide) + 1)
        maps.append([[Map(x, y, w, edges) for w in (np.ones(len(x)), 1 - asleep, cost)] for x, y, asleep, cost in frames])
    return maps


def check(args, data):
    """Volumes of steps in between: what a run counts less what a shorter one does."""
    rows = []
    table("scene, steps", "ranks", "new lists", "bytes a step, counted", "by ghosts in the log", "by shape", "messages", "model", "reductions", "model",
          "fullest column to the mean", "model")
    plate = plate_variables(args.dx)
    windows = [("plate", plate, 10, 45), ("plate", plate, 160, 195), ("plate", plate, 360, 395),
               ("solid", {"L": 32, "Z": 32, "style": "riemann", "dir": os.path.join(HERE, "sph")}, 100, 120)]
    for name, variables, first, last in windows:
        for layout, ranks in itertools.product(LAYOUTS if name == "plate" else ("grid",), args.checked):
            ends = [run(args, "check %s %s %d %d" % (name, layout, ranks, n), name, variables, "run %d\n" % n, ranks, count=True, changes=LAYOUTS[layout]) for n in (first, last)]
            a, b = (read_log(log) for log, _ in ends)
            size, number, calls = (v - u for u, v in zip(ends[0][1], ends[1][1]))
            steps, builds = last - first, b["builds"] - a["builds"]
            # columns are those of the last fix balance, that of the start among them, when nobody sleeps yet
            maps = read_maps(args, [first // 50 * 50])[0][0] if name == "plate" else None
            row = predict(name, variables, ranks, a, b, steps, builds, maps, first, layout)
            row["imbalance"] = 1.0
            if name == "plate":
                row["imbalance"] = float(re.findall(r"^ +%d .* (\S+) *$" % last, ends[1][0], re.M)[-1])
            row.update(scene=name, layout=layout, ranks=ranks, first=first, last=last, builds=builds, bytes=size / steps, messages=number / steps, reductions=calls / steps)
            rows.append(row)
            print("| %(scene)s, %(layout)s, %(first)d-%(last)d | %(ranks)d | %(builds)d | %(bytes).0f | %(bytes_by_ghosts).0f | %(bytes_by_shape).0f | %(messages).1f | "
                  "%(model_messages).1f | %(reductions).2f | %(model_reductions).2f | %(imbalance).2f | %(model_imbalance).2f |" % row, flush=True)
    data["check"] = rows


TILED = (("processors   * * 1 ", "comm_style   tiled # "),)
LAYOUTS = {"grid": (), "bisected": (*TILED, ("balance 50 1.05 shift xy 20 1.02 weight var cost", "hvi/balance 50 1.05"))}
LATER, LOOKS = 5, 10  # steps at 0.5 mm between dumps, and between two looks of fixes that balance: as long as 50 at a fifth of the spacing
BALANCES = {"grid, fix balance shift xy": LAYOUTS["grid"], "bisected, fix hvi/balance": LAYOUTS["bisected"],
            "bisected in three directions, fix balance rcb": (*TILED, ("shift xy 20 1.02", "rcb"))}


def columns(args, data):
    """Cost of the fullest rank over the mean, half-way between two looks of the fix that balances, over a run of the plate; ghosts at its end."""
    rows = []
    table("columns", "ranks", "cost of fullest ranks to the mean, in all", "most", "ghosts over particles at the end")
    for ranks in args.columns:
        for label, changes in BALANCES.items():
            tail = "dump d all custom %d dump.* proc c_cost\n" % (LOOKS // 2) + UNTIL
            changes = (*changes, ("balance 50", "balance %d" % LOOKS))
            found = read_log(run(args, "columns %s %d" % (label, ranks), "plate", plate_variables(args.dx), tail, ranks, changes=changes))
            full, mean = [], []
            for path in glob.glob(os.path.join(args.out, re.sub(r"[^\w.]+", "-", "columns %s %d" % (label, ranks)), "dump.*")):
                if int(path.rpartition(".")[2]) % LOOKS:
                    rank, cost = np.loadtxt(path, skiprows=9, unpack=True)
                    loads = np.bincount(rank.astype(int), cost, ranks)
                    full.append(loads.max())
                    mean.append(loads.mean())
            rows.append({"columns": label, "ranks": ranks, "over": sum(full) / sum(mean), "most": float((np.array(full) / mean).max()), "ghosts": found["ghosts"] * ranks / found["atoms"]})
            print("| %(columns)s | %(ranks)d | %(over).2f | %(most).2f | %(ghosts).2f |" % rows[-1], flush=True)
    data["columns"] = rows


def predict(name, variables, ranks, a, b, steps, builds, maps, steps_done, layout):
    """Bytes and messages of a step of all ranks: with the ghosts that the log counts, and with those of the shape."""
    grid = b["grid"]
    forward, reverse = exchanges(True)
    doubles = b["forward"] + b["reverse"]
    # atom_style sends borders instead of its forward exchange in steps with new lists
    doubles += builds / steps * (b["border"] - FORWARD)
    imbalance = 1.0
    if name == "solid":
        side = [variables["L"], variables["L"], variables["Z"]]
        widths = [s / n for s, n in zip(side, grid)]
        shape = ranks * sent_ghosts(widths, grid, b["cut"], (True,) * 3)
        full = [w + 2 * b["cut"] for w in widths]
        every = ranks * (np.prod(full) - np.prod(widths))
        measured = 0.5 * ranks * (a["ghosts"] + b["ghosts"]) * shape / every  # ghosts of a rank of its own are not sent
        per, lists = halo_messages(grid, (True,) * 3), list_messages(grid)
    else:
        measured = 0.5 * ranks * (a["ghosts"] + b["ghosts"])
        everyone, _, weighed = maps
        weighed = everyone if steps_done < 50 else weighed
        columns = weighed.grid(grid, 0.7e-3 * variables["dx"]) if layout == "grid" else weighed.bisected(ranks)
        shape = float((everyone.inside(columns, b["cut"]) - everyone.inside(columns)).sum())
        shares = weighed.inside(columns)
        imbalance = float(shares.max() / shares.mean())
        if layout == "grid":
            per, lists = halo_messages(grid, (False,) * 3), list_messages(grid)
        else:
            per = int(tiled_messages(columns, b["cut"]).sum())
            lists = per + 2 * int(tiled_messages(columns, TOUCH).sum())
    reductions = REDUCTIONS + builds / steps * BUILD_REDUCTIONS[layout] if name == "plate" else 1 + builds / steps  # no hvi/dt, no change of the box
    messages = (forward + reverse) * per + builds / steps * lists
    return {"ghosts": measured, "shape_ghosts": shape, "bytes_by_ghosts": DOUBLE * doubles * measured, "bytes_by_shape": DOUBLE * doubles * shape,
            "model_messages": messages, "model_reductions": reductions, "model_imbalance": imbalance}


def parameters(args, data):
    """Of the model: counted, measured here, and those of the machine that is asked about."""
    found = read_log(open(os.path.join(args.out, "follow", "log.lammps")).read())
    p = {k: found[k] for k in ("forward", "reverse", "border", "cut")}
    p.update(exchanges=exchanges(True), builds=data["follow"]["builds"], balance_reductions=BALANCE_REDUCTIONS,
             latency=args.latency, bandwidth=args.bandwidth / args.ranks_per_node)
    for key in ("awake_s", "asleep_s"):
        p[key] = data["follow"][key] / args.core
    p["ghost_share"] = data["costs"]["ghost_s"] / data["costs"]["particle_s"]
    p["cut_spacings"] = p["cut"] / (1e-3 * data["follow"]["dx"])
    log = open(os.path.join(args.out, "follow", "log.lammps")).read()
    records, kept = re.findall(r"memory: (\d+) bytes per owned and ghost particle, (\d+) more", log)[-1]
    near = float(re.findall(r"^Ave neighs/atom = (\S+)", log, re.M)[-1])
    p["ghost_bytes"] = float(records) + ATOM_BYTES
    p["owned_bytes"] = p["ghost_bytes"] + float(kept) + 24 + 8 * near  # hvi/lists; the list, and the neighbors within reach
    return p


def plate_steps(maps, ranks, n, n0, dx0, p, layout="grid"):
    """step_time() in the mean over the maps, and the fullest rank: of the same plate with n particles in place of n0.

    Work is that of half-way between two looks of a fix that balances, every 50 steps; with n0 particles every LOOKS."""
    finer = (n / n0) ** (1 / 3)
    frame, late = divmod((LOOKS / 2 if n == n0 else 25 / finer) / LATER, 1)
    cut, skin, k = p["cut"] / finer, 0.7e-3 * dx0 / finer, n / n0
    grid = grid_of(ranks)
    total, fullest = {}, (0.0, 0.0)
    for frames in maps:
        everyone, awake, cost = (one.between(other, late) for one, other in zip(*(frames[int(frame):] + frames[-1:])[:2]))
        weighed = frames[0][2]
        columns = weighed.grid(grid, skin) if layout == "grid" else weighed.bisected(ranks)
        inside, active = k * everyone.inside(columns), k * awake.inside(columns)
        ghosts, busy = k * everyone.inside(columns, cut) - inside, k * awake.inside(columns, cut) - active
        if ranks == 1:
            ghosts, busy = 0 * ghosts, 0 * busy
        work = p["awake_s"] * (active + p["ghost_share"] * busy) + p["asleep_s"] * (inside - active)
        if layout == "grid":
            sides = 4
            near = sides * math.ceil(cut / np.diff(columns)[:, ::2].min())
        else:
            near, sides = (int(tiled_messages(columns, reach).max()) for reach in (cut, TOUCH))
        for key, value in step_time(work, ghosts, ranks, near, sides, p, layout).items():
            total[key] = total.get(key, 0.0) + value / len(maps)
        loads = cost.inside(columns)
        total["fullest"], total["mean"] = total.get("fullest", 0.0) + float(loads.max()), total.get("mean", 0.0) + float(loads.mean())
        total["alone"] = total.get("alone", 0.0) + float((p["awake_s"] * active + p["asleep_s"] * (inside - active)).sum()) / len(maps)
        i = (inside + ghosts).argmax()
        fullest = max(fullest, (float(inside[i]), float(ghosts[i])), key=sum)
    total["steps"], total["over"] = finer, total["fullest"] / total["mean"]
    return summary(total, fullest, n, ranks, p)


def cube_steps(ranks, n, p):
    """The same for a full periodic cube of the same material, all awake, cut into ranks cubes."""
    side = (n / ranks) ** (1 / 3)
    ghosts = sent_ghosts((side,) * 3, (2,) * 3, p["cut_spacings"], (True,) * 3)
    work = np.array([p["awake_s"] * (n / ranks + p["ghost_share"] * ghosts)])
    total = step_time(work, np.array([ghosts]), ranks, 6 * math.ceil(p["cut_spacings"] / side), 6, p)
    total["alone"], total["steps"] = p["awake_s"] * n, 1.0
    return summary(total, (n / ranks, ghosts), n, ranks, p)


def summary(total, fullest, n, ranks, p):
    total["ghost_work"] = total["work"] - total["alone"] / ranks
    total["step"] = total["work"] + total["waiting"] + total["halo"] + total["reductions"]
    total["efficiency"] = total["alone"] / ranks / total["step"]
    total["efficiency_balanced"] = total["alone"] / ranks / (total["step"] - total["waiting"])
    total["memory"] = memory_of_rank(*fullest, n, p)
    return total


def model(args, data):
    """Plates of up to 1e9 particles on up to 1e4 ranks."""
    p, n0 = parameters(args, data), data["follow"]["atoms"]
    # of each interval the middle would be best; the start is not counted, which has nobody awake
    maps = read_maps(args, data["follow"]["frames"][1:-1])
    print("bytes per ghost and step %d, exchanges %d and %d, lists %.2f a step, ghost %.2f of a particle's time" % (
        DOUBLE * (p["forward"] + p["reverse"]), *p["exchanges"], p["builds"], p["ghost_share"]))
    table("scene", "particles", "ranks", "per rank", "ms a step", "run h", "efficiency", "if nobody waited", "ghosts' work", "waiting", "halo",
          "reductions", "fullest rank MB, of that map", "cost of the fullest rank to the mean")
    rows, many = [], (64, 256, 1024, 4096, 10000)
    cases = [(layout, n, ranks) for layout in LAYOUTS for n, ranks in [*((n0, ranks) for ranks in (2, 16, 64)), *itertools.product((10 ** k for k in range(6, 10)), many)]]
    cases += [("cube", 10 ** k, ranks) for k in (6, 9) for ranks in many]
    for name, n, ranks in cases:
        t = plate_steps(maps, ranks, n, n0, data["follow"]["dx"], p, name) if name in LAYOUTS else cube_steps(ranks, n, p)
        hours = t["step"] * data["follow"]["steps"] * t["steps"] / 3600
        rows.append(dict(t, scene=name, particles=n, ranks=ranks, hours=hours))
        print("| %s | %.3g | %d | %.0f | %.3g | %s | %.2f | %.2f | %s | %.0f, %.0f%s | %.2f |" % (
            name, n, ranks, n / ranks, 1e3 * t["step"], "%.3g" % hours if name in LAYOUTS else "", t["efficiency"], t["efficiency_balanced"],
            " | ".join("%.0f %%" % (100 * t[key] / t["step"]) for key in ("ghost_work", "waiting", "halo", "reductions")),
            t["memory"] / 1e6, 4e-6 * n, " **too much**" if t["memory"] > args.memory else "", t.get("over", 1.0)), flush=True)
    data["model"] = rows


STAGES = ("times", "costs", "follow", "check", "model", "columns")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default="build/scaling")
    parser.add_argument("--only", default=",".join(STAGES), help="stages, separated by commas")
    parser.add_argument("--dx", type=float, default=0.5, help="spacing of the plate, mm")
    parser.add_argument("--checked", type=lambda text: [int(n) for n in text.split(",")], default=[4, 8, 16], help="numbers of ranks of stage check")
    parser.add_argument("--columns", type=lambda text: [int(n) for n in text.split(",")], default=[4, 16, 64], help="numbers of ranks of that stage")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--latency", type=float, default=2e-6, help="of a message and of a hop of a reduction, s")
    parser.add_argument("--bandwidth", type=float, default=25e9, help="of a node, bytes/s each way")
    parser.add_argument("--ranks-per-node", type=int, default=64)
    parser.add_argument("--memory", type=float, default=4e9, help="of a rank, bytes")
    parser.add_argument("--core", type=float, default=1.0, help="speed of a core there, of a core here")
    args = parser.parse_args()
    stages = args.only.split(",")
    if set(stages) - set(STAGES):
        parser.error("--only takes " + ", ".join(STAGES))
    args.out = os.path.abspath(args.out)
    os.makedirs(args.out, exist_ok=True)
    path = os.path.join(args.out, "scaling.json")
    data = {}
    if os.path.exists(path):
        with open(path) as f:
            data = json.load(f)
    for stage in stages:
        print("## " + stage, flush=True)
        globals()[stage](args, data)
        with open(path, "w") as f:
            json.dump(data, f, indent=1)


if __name__ == "__main__":
    main()
