# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi sweep: studies one after the other."""

import os
import pathlib

from .. import texts
from ..errors import HVIError
from ..jobs import engine, runs
from ..jobs.sweep import Study
from . import running

EXAMPLES = """  python3 -m hvi sweep studies/parameters.yaml
  python3 -m hvi sweep studies/*.yaml --jobs 2 --ranks 1"""
OWNER = ".study"  # in the folder of its runs: path of the study
SHOWN = ("verdict", "perforated", "particles", "steps", "time_us", "core_s")


def add_arguments(parser):
    parser.add_argument("study", nargs="+", metavar="STUDY.yaml", help="input, variables, and the grid of what varies")
    parser.add_argument("--full", action="store_true", help="the study's full size; runs go to DIR/NAME-full")
    running.add_runs(parser)


def own(study, folder, before, dry):
    """HVIError if the runs in this folder are those of another study that is still there; says there whose they are"""
    said = folder / OWNER
    other = next((one.path for one in before if one.name == study.name), None) or (pathlib.Path(texts.read(said).strip()) if said.is_file() else None)
    if other and other.is_file() and not other.samefile(study.path):
        raise HVIError(f"{folder} has the runs of {other}: rename {study.path}, or take another --runs DIR")
    if not dry:
        folder.mkdir(parents=True, exist_ok=True)
        with texts.whole(said) as out:
            out.write(f"{study.path.resolve()}\n")


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
    return done == len(jobs) and not failed


def main(args):
    studies = [Study(pathlib.Path(path), args.full) for path in {os.path.abspath(path): path for path in args.study}.values()]
    for k, study in enumerate(studies):
        own(study, args.runs.resolve() / study.name, studies[:k], args.dry_run)
    return 0 if all([one(study, args) for study in studies]) else 1
