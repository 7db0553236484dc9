# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What commands that run LAMMPS share: how it is run, of which case, over which values."""

import argparse
import math
import pathlib
import textwrap

from .. import tables
from ..errors import HVIError, writing
from ..jobs import engine, machine
from ..shield import case as cases
from ..shield import script
from .shared import count, least0, positive

MOST = 1000  # speeds
SIZES = "particles", "steps", "core_s", "memory_MB"  # of a run, in a table


def add_runs(parser):
    group = parser.add_argument_group("how LAMMPS is run; call again to go on where it stopped")
    group.add_argument("--runs", type=pathlib.Path, default="runs", metavar="DIR", help="folder for the runs (default: runs)")
    group.add_argument("--engine", choices=("local", "slurm"), default="local", help="runs are processes of this machine, or jobs of Slurm (default: local)")
    group.add_argument("--jobs", type=count, metavar="N", help="runs at a time (default: 1; with slurm all)")
    group.add_argument("--ranks", type=count, metavar="R", help="MPI ranks of a run (default: the study's, or 2)")
    group.add_argument("--timeout", type=positive, metavar="S", help="end a run after this many seconds (default: the study's, or never)")
    group.add_argument("--lmp", metavar="FILE", help="LAMMPS with USER-HVI (default: $HVI_LMP, build/lmp of the source tree, or lmp on PATH)")
    group.add_argument("--mpirun", default="mpirun", metavar="FILE", help="how ranks are started, by FILE -n R (default: mpirun)")
    group.add_argument("--dry-run", action="store_true", help="show what would be run")
    group = parser.add_argument_group("with --engine slurm: a job for each run; what stopped at the time limit is submitted again if it has saved more")
    group.add_argument("--nodes", type=count, metavar="N", help="nodes of a run (default: as its ranks fit)")
    group.add_argument("--time", metavar="LIMIT", help="time limit of a job as sbatch takes it, such as 4:00:00 (default: that of the partition)")
    group.add_argument("--partition", metavar="NAME", help="partition of the jobs")
    group.add_argument("--account", metavar="NAME", help="account that they are charged to")
    group.add_argument("--sbatch", metavar="'OPTIONS'", help="further options of sbatch, such as --sbatch='--mem=4G --qos=long'")
    group.add_argument("--poll", type=positive, metavar="S", help="seconds between looks at the queue (default: 10)")


def add_case(parser):
    """a case; --help says what it may have"""
    parser.add_argument("case", metavar="CASE.yaml", help="projectile, speed, angle, walls, spacings")
    usual = parser.format_help
    rows = [(name, default, line) for name, default, text in cases.rows_of_keys() for name, default, line in wrapped(name, default, text)]
    parser.format_help = lambda: f"{usual()}\nkeys of CASE.yaml:\n{tables.text(('key', 'default', 'what it is'), rows, left=True)}\n"


def wrapped(name, default, text):
    for k, line in enumerate(textwrap.wrap(text, 80) or [""]):
        yield (name, default, line) if k == 0 else ("", "", line)


def add_range(parser):
    for name, text, default in (("from", "lowest value", "half of the case's"), ("to", "highest value", "twice the case's"), ("step", "between values that are tried", "a 20th of the case's")):
        parser.add_argument("--" + name, dest=name + "_", type=positive if name == "step" else least0, metavar="X",
                            help=f"{text}, mm, km/s or degrees (default: {default}; of angle 0 to 75 by 5)")


def add_at(parser):
    """values that are not the case's"""
    parser.add_argument("--at", type=setting, nargs="+", action="extend", default=[], metavar="WHAT=X", help="these values in place of the case's: D, speed, angle, thickness1, ..., gap2, ... in mm, km/s, degrees")


def setting(text):
    """gap2=100 as (gap2, 100.0)"""
    word, found, value = text.partition("=")
    if not found:
        raise argparse.ArgumentTypeError(f"{text} is not WHAT=X, like gap2=100")
    return word, least0(value)


def add_over(parser, default):
    """speeds A:B:N or WHAT=A:B:N, as (word, (first, last, number))"""
    group = parser.add_mutually_exclusive_group()
    add_speeds(group, default)
    group.add_argument("--over", type=over, metavar="WHAT=A:B:N", help="another quantity in place of the speed: gap2=20:100:5, angle=0:60:4, thickness1=..., D=...")


def over(text):
    word, found, values = text.partition("=")
    if not found:
        raise argparse.ArgumentTypeError(f"{text} is not WHAT=FIRST:LAST:NUMBER, like gap2=20:100:5")
    return word, row_of(values, least0)


def add_speeds(parser, default):
    """A:B:N, as (first, last, number)"""
    parser.add_argument("--speeds", type=speeds, default=default, metavar="A:B:N", help="first, last, number of speeds, km/s (default: {:g}:{:g}:{})".format(*default))


def speeds(text):
    return row_of(text, positive, "speed")


def row_of(text, kind, what="value"):
    """A:B:N as (first, last, number)"""
    try:
        first, last, number = text.split(":")
        first, last, number = kind(first), kind(last), count(number)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not FIRST:LAST:NUMBER, like 1:15:15") from None
    if first >= last:
        raise argparse.ArgumentTypeError(f"{text}: the first {what} must be below the last")
    if number > MOST or len({f"{value:g}" for value in evenly(first, last, number)}) < number:
        raise argparse.ArgumentTypeError(f"{text}: {MOST} {what}s at most, which differ in six digits")
    return first, last, number


def evenly(first, last, n):
    return [first + (last - first) * k / (n - 1) for k in range(n)] if n > 1 else [first]


def said_of_time(case, cores, jobs, ranks):
    """how long runs take, so many at a time; cores: [core-seconds until tstop, ...] of all of them"""
    jobs, longest = min(jobs, len(cores)), script.longest(case)
    longer = f" if the wall fails, up to {longest} times that if it does not" if longest > 1 else ""
    return f"at most about {engine.duration(max(sum(cores) / jobs, *cores) / ranks)}{longer}, {jobs} at a time on {ranks} ranks each, on idle cores; a run ends when its event is over"


def refuse_too_large(plans, folder, jobs, instead):
    """before anything is made: runs that the machine has no room for

    plans: [(what is run, plan), ...] of all runs; jobs: runs on this machine at a time; instead: what else than coarser spacings would help
    """
    free, (name, most) = machine.free_memory(), max(plans, key=lambda one: one[1]["memory_MB"])
    dx = most["dx_mm"]
    if free is not None and most["memory_MB"] * jobs > free:
        fit = math.ceil(100 * dx * (most["memory_MB"] * jobs / free) ** (1 / 3)) / 100
        raise HVIError(f"{name}: spacings_mm: {dx:g} mm makes some {most['particles']:.3g} particles, {most['memory_MB']:.3g} MB of memory"
                       f"{f' in each of {jobs} runs at a time' if jobs > 1 else ''}, and {free:.0f} are free: take {fit:g} mm or more{', or fewer jobs at a time' if jobs > 1 else ''}{instead}")
    disk, existing = machine.free_disk(folder)
    kept, restarts = sum(plan["frames_MB"] for _, plan in plans), sorted((plan["disk_MB"] - plan["frames_MB"] for _, plan in plans), reverse=True)  # which a run removes when it is done
    if (needed := kept + sum(restarts[:jobs or None])) > disk:
        raise HVIError(f"{name}: some {needed:.3g} MB would be written, and {disk:.0f} are free in {existing}: take a larger settings: film, or another --runs DIR")


def plan_searches(case, limits, folder, runner, show, over=None):
    """Searches for which the machine has no room are refused, show: after a table of what they take at most.

    limits: {value: Limit}; over: the Quantity of these values, None if there is but one search
    """
    most = [(f"{case.name}, {f'{over.word} {at:g} {over.unit}, ' if over else ''}{limit.on} {value:g} {limit.unit}", plan) for at, limit in limits.items() for value, plan in limit.most()]
    jobs = min(runner.jobs, 2 * len(case.shifts) * len(limits))  # a search asks for two runs at a time
    if show:
        at_ends = [at for k, at in enumerate(limits) if k in (0, len(limits) - 1)]
        columns = [*([over.name] if over else []), "spacing_mm", limits[at_ends[0]].quantity.name, *SIZES]
        print(tables.text(columns, [(*([at] if over else []), plan["dx_mm"], value, *(plan[key] for key in SIZES)) for at in at_ends for ends in limits[at].plans() for value, plan in ends]))
        print(f"at most {len(most)} runs, as a rule far fewer: {said_of_time(case, [plan['core_s'] for _, plan in most], jobs, runner.ranks)}")
    refuse_too_large(most, folder, runner.here(jobs), ", or a narrower range")


def save(path, mapping):
    """an answer as a YAML file"""
    with writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        engine.write_yaml(path, mapping)
