#!/usr/bin/env python3
"""Run a LAMMPS input for many values of its variables:  python3 sweep.py studies/NAME.yaml

Each job has its own folder RUNS/NAME/JOB with its log and result.yaml; a table of all results is in RUNS/NAME.csv.
Call again to go on: jobs that are done are skipped, unless their variables or the input have changed since.  A job that
was interrupted goes on from its last restart file if the study names such files.  Jobs that fail are reported and do not
stop the others.

Exit status: 0 all jobs are done, 1 some failed, 2 a wrong study or option, 130 interrupted (Ctrl-C).
"""
import argparse
import csv
import hashlib
import itertools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEYS = {"input", "variables", "grid", "ranks", "timeout", "restart", "remove", "full"}
LAST = "package_version"  # the last key of result.yaml: it is there if the file is complete


class StudyError(Exception):
    """the study or an option is wrong; the text says what"""


def read_yaml(path):
    """the mapping in a YAML file; None if there is none"""
    try:
        data = yaml.safe_load(path.read_text())
    except (OSError, yaml.YAMLError, UnicodeDecodeError):
        return None
    return data if isinstance(data, dict) else None


class Study:
    """A study file: the input, and the variables of each job."""

    def __init__(self, path, full=False):
        if not path.is_file():
            raise StudyError(f"{path}: no such file")
        try:
            study = yaml.safe_load(path.read_text())
        except (yaml.YAMLError, UnicodeDecodeError) as problem:
            raise StudyError(f"{path}: not YAML: {problem}") from None
        if not isinstance(study, dict):
            raise StudyError(f"{path}: not a mapping of {', '.join(sorted(KEYS))}")
        if full:
            if not isinstance(study.get("full"), dict):
                raise StudyError(f"{path}: no full size (key 'full') in this study")
            study = {**study, **{key: {**(study.get(key) or {}), **value} if isinstance(value, dict) else value
                                 for key, value in study["full"].items()}}
        unknown = set(study) - KEYS
        if unknown:
            raise StudyError(f"{path}: unknown key {', '.join(sorted(map(str, unknown)))}; known: {', '.join(sorted(KEYS))}")
        self.path, self.name = path, path.stem + ("-full" if full else "")
        self.ranks, self.timeout = study.get("ranks"), study.get("timeout")
        self.restart, self.remove = study.get("restart"), study.get("remove") or []
        self.input = (path.parent / str(study.get("input"))).resolve()
        if not self.input.is_file():
            raise StudyError(f"{path}: input {study.get('input')} is not there (paths count from the study file)")
        self.text = self.input.read_text()
        self.fixed = self._mapping(study, "variables")
        self.cases = self._cases(study)
        self._check_variables()

    def _mapping(self, study, key):
        value = study.get(key) or {}
        if not isinstance(value, dict):
            raise StudyError(f"{self.path}: {key} must be 'name: value' lines")
        return value

    def _cases(self, study):
        """what varies, as a list of {variable: value}: every combination of the grid's axes

        An axis is a list of values of the variable that it is named for, or of mappings that set several variables.
        """
        axes = []
        for name, values in self._mapping(study, "grid").items():
            if not isinstance(values, list) or not values:
                raise StudyError(f"{self.path}: grid: {name} must be a list of values")
            axes.append([value if isinstance(value, dict) else {name: value} for value in values])
        if not axes:
            raise StudyError(f"{self.path}: no grid: nothing to vary")
        found = [{n: v for part in point for n, v in part.items()} for point in itertools.product(*axes)]
        names = [job_name(c) for c in found]
        twice = {n for n in names if names.count(n) > 1}
        if twice:
            raise StudyError(f"{self.path}: the same job twice: {', '.join(sorted(twice))}")
        return found

    def _check_variables(self):
        """LAMMPS takes any name after -var; one that the input does not know would change nothing"""
        known = set(re.findall(r"\bvariable\s+(\w+)\s+index\b", self.text))
        for name in {n for case in self.cases for n in case} | set(self.fixed):
            if name not in known:
                raise StudyError(f"{self.path}: {self.input.name} has no variable '{name}'")

    def checksum(self):
        return hashlib.sha256(self.text.encode()).hexdigest()[:16]


def job_name(case):
    """a folder name from what varies: tD-0.1_v0-5000"""
    return "_".join(re.sub(r"[^\w.+-]", "-", f"{name}-{value}") for name, value in case.items())


class Job:
    """One run of the input in its own folder."""

    def __init__(self, study, case, runs):
        self.study, self.case, self.name = study, case, job_name(case)
        self.variables = {**study.fixed, **case}
        self.folder = runs / study.name / self.name
        self.record = {"input": study.checksum(), "variables": self.variables}
        self.process, self.start, self.problem, self.resumed = None, None, "", False

    def result(self):
        """the results if the job is done with these variables and this input, else None"""
        if not self.begun():
            return None
        result = read_yaml(self.folder / "result.yaml")
        return result if result and LAST in result else None

    def begun(self):
        """True if it was started before, with these variables and this input"""
        return read_yaml(self.folder / "job.yaml") == self.record

    def restart_files(self):
        """what the run left to go on from, newest last"""
        pattern = self.study.restart
        return sorted(self.folder.glob(pattern), key=lambda path: path.stat().st_mtime) if pattern and self.begun() else []

    def command(self, args):
        command = [args.mpirun, "-np", str(args.ranks), str(args.lmp), "-in", self.study.input.name, "-log", "log.lammps"]
        for name, value in self.variables.items():
            command += ["-var", name, str(value)]
        if files := self.restart_files():
            command += ["-var", "resume", files[-1].suffix[1:]]
        env = ROOT / "cmake" / "env.sh"  # lets mpirun run as root, in containers, with more ranks than cores
        return [str(env), *command] if env.is_file() else command

    def begin(self, args):
        """start it, in an empty folder unless it goes on; nothing left there can be taken for a result"""
        command = self.command(args)
        self.resumed = bool(self.restart_files())
        if not self.resumed:
            shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "result.yaml").unlink(missing_ok=True)
        (self.folder / self.study.input.name).write_text(self.study.text)  # LAMMPS reads on while it runs
        (self.folder / "job.yaml").write_text(yaml.safe_dump(self.record, sort_keys=False))
        self.start = time.monotonic()
        with open(self.folder / "output.txt", "w") as out:
            self.process = subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=out,
                                            stderr=subprocess.STDOUT, start_new_session=True)

    def ended(self, timeout):
        """True when it is over, by itself or by the time limit; self.problem then says what is wrong"""
        status = self.process.poll()
        if status is None:
            if timeout and time.monotonic() - self.start > timeout:
                self.end()
                self.problem = f"stopped after {timeout:g} s"
                return True
            return False
        if status != 0:
            self.problem = f"exit status {status}"
        elif self.result() is None:
            self.problem = "no complete result.yaml"
        if self.problem and self.resumed:  # what it went on from may be what is wrong: the next try begins anew
            for path in self.restart_files():
                path.unlink()
        for pattern in [] if self.problem else self.study.remove:
            for path in self.folder.glob(pattern):
                path.unlink()
        return True

    def end(self):
        """mpirun ends its ranks when it is told to; if it does not listen it is killed"""
        self.process.terminate()
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()

    def last_lines(self, n=8):
        """the end of what LAMMPS and mpirun said, from the first error on if there is one"""
        try:
            lines = [line.rstrip() for line in (self.folder / "output.txt").read_text(errors="replace").splitlines()]
        except OSError:
            return []
        lines = [line for line in lines if line]
        errors = [i for i, line in enumerate(lines) if line.startswith("ERROR")]
        return lines[max(0, errors[0] - 1):][:n] if errors else lines[-n:]


def run(jobs, args, timeout):
    """run jobs, some at a time; returns those that failed. Ctrl-C ends what runs and is passed on."""
    waiting, running, failed, done = list(jobs), [], [], 0
    start = time.monotonic()
    try:
        while waiting or running:
            while waiting and len(running) < args.jobs:
                running.append(waiting.pop(0))
                running[-1].begin(args)
            for job in [j for j in running if j.ended(timeout)]:
                running.remove(job)
                done += 1
                now = time.monotonic()
                left = (now - start) / done * (len(waiting) + len(running))
                state = f"FAILED: {job.problem}" if job.problem else "ok"
                print(f"[{done}/{len(jobs)}] {job.name}  {state}  {now - job.start:.0f} s"
                      + (f"   about {duration(left)} left" if waiting or running else ""), flush=True)
                if job.problem:
                    failed.append(job)
                    print("".join(f"    | {line}\n" for line in job.last_lines()) + f"    | see {job.folder}", flush=True)
            time.sleep(0.05)
    finally:
        for job in running:
            job.end()
    return failed


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def write_table(jobs, path):
    """a CSV table: job, variables, results of all jobs that are done"""
    rows = [{"job": job.name, **result, **job.variables} for job in jobs if (result := job.result())]
    columns = list(dict.fromkeys(["job", *(n for j in jobs for n in j.variables), *(n for row in rows for n in row)]))
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as out:
        table = csv.DictWriter(out, columns, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    return len(rows)


def find_lmp(given):
    """LAMMPS with the package: as given, from HVI_LMP, or from build/"""
    lmp = pathlib.Path(given or os.environ.get("HVI_LMP") or ROOT / "build" / "lmp")
    if not lmp.is_file():
        raise StudyError(f"{lmp} does not exist: run make first, or give --lmp FILE")
    return lmp.resolve()


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path, nargs="+", help="study files, see studies/*.yaml")
    parser.add_argument("--runs", type=pathlib.Path, default="runs", help="folder for the runs (default: runs)")
    parser.add_argument("--jobs", type=int, default=1, help="jobs at a time (default: 1)")
    parser.add_argument("--ranks", type=int, help="MPI ranks of a job (default: the study's, or 2)")
    parser.add_argument("--timeout", type=float, help="end a job after this many seconds (default: the study's, or never)")
    parser.add_argument("--lmp", help="LAMMPS with USER-HVI (default: $HVI_LMP, or build/lmp of this repository)")
    parser.add_argument("--mpirun", default="mpirun", help="how ranks are started (default: mpirun)")
    parser.add_argument("--full", action="store_true", help="the study's full size; runs go to RUNS/NAME-full")
    parser.add_argument("--dry-run", action="store_true", help="show what would be run, write nothing")
    return parser


def sweep(path, args):
    """one study; returns True if all its jobs are done"""
    study = Study(path, args.full)
    args = argparse.Namespace(**{**vars(args), "ranks": args.ranks or study.ranks or 2, "lmp": find_lmp(args.lmp)})
    if args.jobs < 1 or args.ranks < 1:
        raise StudyError("--jobs and --ranks must be 1 or more")
    if not shutil.which(args.mpirun):
        raise StudyError(f"{args.mpirun} is not there: install MPI, or give --mpirun FILE")
    runs = args.runs.resolve()
    jobs = [Job(study, case, runs) for case in study.cases]
    todo = [job for job in jobs if job.result() is None]
    print(f"{study.name}: {len(jobs)} jobs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    if args.dry_run:
        for job in todo:
            print(" ".join(job.command(args)))
        return True
    table = runs / f"{study.name}.csv"
    try:
        failed = run(todo, args, args.timeout or study.timeout)
    finally:
        rows = write_table(jobs, table)
        print(f"{study.name}: {rows} of {len(jobs)} jobs are done, table: {table}", flush=True)
    if failed:
        print(f"{study.name}: {len(failed)} failed: {', '.join(job.name for job in failed)}", flush=True)
    return not failed


def main(argv=None):
    args = options().parse_args(argv)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C
    try:
        return 0 if all([sweep(path, args) for path in args.study]) else 1
    except StudyError as problem:
        print(f"sweep.py: {problem}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted: call again to go on", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
