# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Runs many jobs as the options of the command line say, in one of two engines: processes of this machine, or Slurm.

An engine has most (runs at a time where --jobs says nothing), here (whether runs are on this machine), pause (seconds between looks at how far runs are) and

    begin(jobs, say)   takes jobs that are to be run; say(line) prints
    ended(jobs, say)   [job, ...]: which of these have ended; job.problem says what went wrong, "" if nothing
    interrupted(jobs)  the message after Ctrl-C, of those that have begun
    stop(jobs)         the call ends before these have
"""

import os
import signal
import sys
import threading
import time

from .. import progress
from ..errors import HVIError
from . import engine, lammps, slurm

OF_SLURM = ("nodes", "time", "partition", "account", "sbatch", "poll")  # options
RANKS = 2  # of a run, by default
LOOK = 0.05  # seconds between looks for runs that are over
WATCH = 10  # seconds between looks for runs that write nothing


class Local:
    """Runs are processes of this machine: LAMMPS, started by mpirun."""

    most, here, pause = 1, True, 0.5

    def __init__(self, ranks, timeout, mpirun, lmp):
        """lmp: path, or None; timeout: seconds, or None"""
        self.began = time.time_ns()  # of the call: of two calls that ask for a run the one that began last counts
        self.ranks, self.timeout, self.mpirun = ranks, timeout, mpirun
        self.lmp = lammps.find(lmp)
        lammps.check_mpirun(mpirun)
        if os.sep in mpirun:
            self.mpirun = os.path.abspath(mpirun)  # runs have folders of their own

    def command(self, job):
        """-n, not -np: srun knows it, too"""
        return [*lammps.environment(), self.mpirun, "-n", str(self.ranks), str(self.lmp), *job.words()]

    def show(self, jobs):
        """what would be run"""
        for job in jobs:
            print(" ".join(self.command(job)))

    def begin(self, jobs, say):
        """each begins when it is looked at"""
        for job in jobs:
            job.began = self.began

    def ended(self, jobs, say):
        return [job for job in jobs if self._ended(job)]

    def _ended(self, job):
        try:
            return job.ended(self.command, self.timeout)
        except OSError as problem:  # every other run would meet the same
            raise HVIError(f"cannot run in {job.folder}: {problem.strerror}{f': {problem.filename}' if problem.filename else ''}; "
                           "put that right and call again to go on") from None

    def stop(self, jobs):
        engine.end(jobs)

    def interrupted(self, jobs):
        anew = [job.name for job in jobs if job.process is not None and not job.restart_files()]
        return "call again to go on" + (f"; {len(anew)} run{'s have' if len(anew) > 1 else ' has'} saved nothing and will begin anew: {', '.join(anew)}" if anew else "")


def end_signals():
    """signals that end a call; none outside the main thread, where Python sets no handlers"""
    return (signal.SIGTERM, signal.SIGHUP) if threading.current_thread() is threading.main_thread() else ()


def as_interrupts():
    """SIGTERM and SIGHUP end a call as Ctrl-C does; nohup still works"""
    for ends in end_signals():
        if signal.getsignal(ends) != signal.SIG_IGN:
            signal.signal(ends, signal.default_int_handler)


def left(jobs, more):
    """those that are not done, of jobs and of what follows from the others"""
    found, looked_at = [], list(jobs)
    for job in looked_at:
        if job.result() is None:
            found.append(job)
        else:
            looked_at += more(job)
    return found


def run(place, most, jobs, what, more=lambda job: []):
    """Runs those that are not done in an engine, place, so many at a time; returns those that failed.

    more(job): jobs that follow from one that is done
    Ctrl-C stops what runs and is passed on.
    """
    waiting, running, failed, over, work = list(jobs), [], [], 0, 0.0
    start, look, watch, told = time.monotonic(), 0.0, 0.0, set()
    form = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}{postfix}"
    with progress.bar(1, what, sys.stdout, bar_format=form) as bar:
        try:
            while waiting or running:
                new = []
                while waiting and len(running) + len(new) < most:
                    job = waiting.pop(0)
                    if job.result() is None:
                        new.append(job)
                    else:
                        waiting += more(job)
                if new:
                    place.begin(new, bar.write)
                    running += new
                for job in place.ended(running, bar.write):
                    running.remove(job)
                    over, work = over + 1, work + job.weight
                    if job.problem:
                        failed.append(job)
                    else:
                        waiting += more(job)
                    left = sum(j.weight for j in waiting + running)
                    bar.write(f"[{over}/{over + len(waiting) + len(running)}] {_line(job)}"
                              + (f"   about {engine.duration((time.monotonic() - start) / work * left)} left" if left else ""))
                if place.here and time.monotonic() > watch:
                    watch = time.monotonic() + WATCH
                    for job in running:
                        if (silence := job.silence()) and (job, silence[0]) not in told:
                            told.add((job, silence[0]))
                            bar.write(f"{job.name}: {silence[1]}; see {job.folder}")
                if not isinstance(bar, progress.Silent) and time.monotonic() > look:
                    stages = [job.stage() for job in running]
                    bar.total = work + sum(j.weight for j in waiting + running)
                    bar.n = work + sum(part * job.weight for (part, _), job in zip(stages, running))
                    bar.set_postfix_str("; ".join(job.name + text for (_, text), job in zip(stages, running)))
                    look = time.monotonic() + place.pause
                time.sleep(LOOK)
        except KeyboardInterrupt:
            print(f"interrupted: {place.interrupted(running)}", file=sys.stderr)
            raise
        finally:
            place.stop(running)
    return failed


def _line(job):
    took = f"{time.monotonic() - job.start:.0f} s"
    if not job.problem:
        return f"{job.name}  ok  {took}"
    return "\n".join([f"{job.name}  FAILED: {job.problem}{f'; {job.advice}' if job.advice else ''}  {took}", *(f"    | {line}" for line in job.last_lines()), f"    | see {job.folder}"])


def check(args, ranks=None):
    """refuses options that the engine does not take; words of sbatch, none with --engine local"""
    if args.engine == "slurm":
        return slurm.options(args, ranks or args.ranks or RANKS)
    if given := [name for name in OF_SLURM if getattr(args, name)]:
        raise HVIError(f"--{given[0]} is for --engine slurm")
    return []


def ask_slurm(words, number):
    """says whether it would take so many jobs of these words, if there are any: of plans, which need no LAMMPS and no Runner"""
    if words:
        print(slurm.tested(words, number), flush=True)


class Runner:
    """Runs jobs as the options of the command line say."""

    def __init__(self, args, ranks=None, timeout=None):
        self.ranks = args.ranks or ranks or RANKS
        local = Local(self.ranks, args.timeout or timeout, args.mpirun, args.lmp)
        check(args, self.ranks)
        self.place = slurm.Slurm(args, local) if args.engine == "slurm" else local
        self.show = self.place.show
        self.jobs = args.jobs or self.place.most
        as_interrupts()

    def here(self, number):
        """how many of so many runs are on this machine at a time"""
        return min(self.jobs, number) if self.place.here else 0

    def run(self, jobs, what, more=lambda job: []):
        return run(self.place, self.jobs, jobs, what, more)
