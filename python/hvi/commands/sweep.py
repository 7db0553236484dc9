# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi sweep: studies one after the other."""

import pathlib

from ..errors import HVIError
from ..jobs import engine, runs
from ..jobs.sweep import Study
from . import running

EXAMPLES = """  python3 -m hvi sweep studies/parameters.yaml
  python3 -m hvi sweep studies/*.yaml --jobs 2 --ranks 1"""
SHOWN = ("verdict", "perforated", "particles", "steps", "time_us", "core_s")


def add_arguments(parser):
    parser.add_argument("study", nargs="+", metavar="STUDY.yaml", help="input, variables, and the grid of what varies")
    parser.add_argument("--full", action="store_true", help="the study's full size; runs go to DIR/NAME-full")
    running.add_runs(parser)


def one(study, args):
    """one study; returns True if all its jobs are done"""
    runner = runs.Runner(args, study.ranks, study.timeout)
    folder = args.runs.resolve()
    jobs = study.jobs(folder)
    todo = [job for job in jobs if job.result() is None]
    print(f"{study.name}: {len(jobs)} jobs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    if args.dry_run:
        runner.show(todo)
        return True
    table = folder / f"{study.name}.csv"
    try:
        with engine.table_of(lambda: jobs, table):
            failed = runner.run(todo, study.name)
            print(engine.overview(jobs, SHOWN))
    finally:
        done = sum(job.result() is not None for job in jobs)
        print(f"{study.name}: {done} of {len(jobs)} jobs are done, table: {table}", flush=True)
    if failed:
        print(f"{study.name}: {len(failed)} failed: {', '.join(job.name for job in failed)}", flush=True)
    return not failed


def main(args):
    studies = [Study(pathlib.Path(path), args.full) for path in args.study]
    for k, study in enumerate(studies):
        for other in studies[:k]:
            if study.name == other.name:
                raise HVIError(f"{other.path} and {study.path} would both have the runs {args.runs / study.name}: rename one, or give them calls with --runs of their own")
    return 0 if all([one(study, args) for study in studies]) else 1
