# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Runs as jobs of Slurm: arrays by sbatch, a job for each run. In its job a run is what it is without Slurm: hvi.jobs.task runs it there.

A batch is one call of sbatch: a folder in DIR/.slurm whose name is that of its jobs, with

    runs.yaml     [[folder, checksum of what is run there, what it had saved], ...]: the number of a run is its index in the array
    runs.pickle   how LAMMPS is run, and the same runs as their command made them
    job.sh        the script
    number        of the array, once sbatch has said it
    INDEX.yaml    of a run that has failed: problem, advice;   INDEX.txt: what its job has printed

One call at a time looks for batches and submits: it holds a lock on DIR/.slurm/lock. Which jobs are in the queue is asked by these names, so any later call
finds those of an earlier one. A call that asks for a run writes the name of its batch into the run's lock file (engine.Job.claim): a job of another
batch that starts later leaves the run alone, and so does a call, which may wait for hours, where one that began later has asked for another state of the run
(engine.Job.is_of_later_call). There may be no accounting, and Slurm forgets a job minutes after its end: how a run
has ended is in its own folder, or in INDEX.yaml. A job that has left neither was stopped from outside. It is submitted again if the run has saved more
since, and has failed otherwise, so there is an end.
"""

import collections
import contextlib
import fcntl
import os
import pathlib
import pickle
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

from ..errors import HVIError, writing
from ..places import PACKAGE
from . import engine

POLL = 10.0  # seconds between looks at the queue
LOOKS = 3  # in a row that must find a job over that has left no record: other machines see files of a shared disk late
PATIENCE = 4 * 3600  # seconds of refusals after which a call without jobs in the queue ends: a controller may be away, or a limit on jobs in the queue be reached, for a while
HOUR = 3600  # seconds that a batch is kept without a number: sbatch did not answer, and its jobs may still turn up in the queue
ARRAY = 1000  # jobs of an array: what Slurm allows by default is 1001
SECONDS = 120  # that a command of Slurm may take
ENDED = set("BOOT_FAIL CANCELLED COMPLETED DEADLINE FAILED NODE_FAIL OUT_OF_MEMORY PREEMPTED REVOKED TIMEOUT".split())
CUT_OFF = {"BOOT_FAIL", "NODE_FAIL", "PREEMPTED", "TIMEOUT", None}  # by no fault of the run; None: Slurm has forgotten the job
SCRIPT = """#!/bin/sh
# of {what}: python3 -m hvi submits this, an element of the array for each run
export PYTHONPATH={package}"${{PYTHONPATH:+:$PYTHONPATH}}"
exec {python} -m hvi.jobs.task "$SLURM_ARRAY_TASK_ID"
"""

Entry = collections.namedtuple("Entry", "job state reason")  # of the queue: number of the array, state, why it waits


class Refused(HVIError):
    """A command of Slurm failed; the message is its own"""


class NoSlurm(HVIError):
    """This machine has no such command"""


def said(words):
    """what a command of Slurm prints; Refused with its message if it fails"""
    # the user's defaults would hide jobs, or wait until all have ended
    environment = {name: value for name, value in os.environ.items() if not name.startswith("SQUEUE_") and name != "SBATCH_WAIT"}
    try:
        done = subprocess.run(words, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", timeout=SECONDS, check=False)
    except FileNotFoundError:
        raise NoSlurm(f"{words[0]} is not there: --engine slurm is for a machine that can submit jobs to Slurm; --engine local runs here") from None
    except (OSError, subprocess.TimeoutExpired) as problem:
        raise Refused(f"{words[0]}: {problem}") from None
    if done.returncode:
        lines = [re.sub(rf"^{words[0]}: (error: |fatal: )?", "", line) for line in done.stderr.splitlines()]
        raise Refused(f"{words[0]}: {'; '.join(filter(None, lines)) or engine.said_of(done.returncode)}")
    return done.stdout


def options(args, ranks):
    """words of sbatch that the options of the command line ask for"""
    try:
        own = shlex.split(args.sbatch or "")
    except ValueError as problem:
        raise HVIError(f"--sbatch {args.sbatch}: {problem}") from None
    if own and not own[0].startswith("-"):
        raise HVIError(f"--sbatch {args.sbatch}: options of sbatch, such as --sbatch='--mem=4G --qos=long'")
    if {"-W", "--wait"} & set(own):
        raise HVIError(f"--sbatch={shlex.quote(args.sbatch)}: leave out {'--wait' if '--wait' in own else '-W'}: hvi itself waits for its jobs")
    if (args.nodes or 1) > ranks:
        raise HVIError(f"--nodes {args.nodes}: a run of {ranks} ranks has no use for so many: more --ranks, or fewer --nodes")
    given = (("ntasks", ranks), ("nodes", args.nodes), ("time", args.time), ("partition", args.partition), ("account", args.account))
    return [*own, *(f"--{name}={value}" for name, value in given if value)]


def tested(words, number):
    """a line on whether Slurm would take so many jobs with these options now; Refused if not"""
    words = ["sbatch", *words, f"--array=0-{min(number, ARRAY) - 1}"]
    try:
        said([*words, "--test-only", "--wrap=true"])
    except NoSlurm as problem:
        return f"not checked by Slurm: {problem}"
    except Refused as problem:
        raise Refused(f"{problem} ({shlex.join(words)})") from None
    return f"Slurm would take it (sbatch --test-only): {shlex.join(words)}"


def is_old(folder):
    with contextlib.suppress(OSError):
        return time.time() - folder.stat().st_mtime > HOUR
    return True


class Batch:
    """One call of sbatch, read from its folder"""

    def __init__(self, folder):
        self.folder, self.name = folder, folder.name
        self.runs = [(pathlib.Path(run), of, saved) for run, of, saved in engine.read_yaml(folder / "runs.yaml")["runs"]]

    @classmethod
    def all_in(cls, folder):
        """those that are readable; others were left by a call that was killed before it called sbatch"""
        for path in sorted(folder.glob("hvi-*")):
            with contextlib.suppress(TypeError, KeyError, ValueError):
                yield cls(path)


class Slurm:
    """Runs are jobs of Slurm; what is submitted stays in the queue when the call ends."""

    most, here = sys.maxsize, False

    def __init__(self, args, local):
        """local: the engine that the jobs use"""
        self.local, self.folder, self.pause = local, args.runs.resolve() / ".slurm", args.poll or POLL
        self.words = options(args, local.ranks)
        self.place, self.kept = {}, set()  # {job: (name of its batch, index)}; names of batches that show why a run has failed
        self.over = collections.Counter()  # looks that have found a job over, and no record
        self.unsent, self.drafts, self.has_sent = [], {}, False  # jobs to be submitted; {jobs: folder of their batch, which sbatch has refused}; whether it has taken any
        self.left = []  # jobs whose runs a later call has asked for
        self.numbers, self.kinds, self.problems, self.next = {}, None, {}, 0.0  # of Slurm's arrays by their names; states said last; {what is refused: (message, since when)}; time of the next look
        for program in () if args.dry_run else ("sbatch", "squeue"):
            said([program, "--version"])

    def show(self, jobs):
        """what would be submitted, what each job runs, whether Slurm would take it"""
        if jobs:
            print(shlex.join(self.sbatch("hvi", len(jobs), self.folder)))
            self.local.show(jobs)
            print(tested(self.words, len(jobs)), flush=True)

    def sbatch(self, name, number, folder):
        """ours behind the user's: the last one counts"""
        return ["sbatch", *self.words, "--parsable", f"--job-name={name}", f"--array=0-{number - 1}", f"--chdir={folder}", "--output=%a.txt", "--open-mode=append", "--requeue", "--export=ALL",
                str(folder / "job.sh")]

    # ------------------------------------------------------------------ into the queue
    def begin(self, jobs, say):
        for job in jobs:
            job.began = self.local.began
        self.unsent += jobs
        self.send(say)

    def send(self, say):
        """Those that an earlier call has submitted, and that have not ended, are waited for; the others are submitted.

        A refusal ends a call that has submitted nothing and waits for no job: its options may be wrong. Others may be of the moment: the next looks try again, for
        PATIENCE while none of the jobs is in the queue, since with these a limit on their number ends, too.
        """
        try:
            with self.alone():
                self.leave_to_later_calls()
                self.adopt(self.unsent, say)
                self.submit([job for job in self.unsent if job not in self.place], say)
        except Refused as problem:
            if not self.has_sent and not self.place:
                raise
            self.refused("trying", problem, say, counts=not self.place)
        else:
            self.problems.pop("trying", None)
        self.unsent = [job for job in self.unsent if job not in self.place]

    def leave_to_later_calls(self):
        """runs that these have asked for are not submitted, nor are jobs of them in the queue taken up"""
        left = [job for job in self.unsent if job.is_of_later_call()]
        for job in left:
            job.mark()
            job.leave_to_later_call()
        self.left += left
        self.unsent = [job for job in self.unsent if job not in left]

    @contextlib.contextmanager
    def alone(self):
        """while another call submits, this call waits: a batch that is not in the queue yet looks like one that is over"""
        with writing(self.folder):
            self.folder.mkdir(parents=True, exist_ok=True)
            lock = open(self.folder / "lock", "w")
        with lock:
            with writing(self.folder):
                fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def refused(self, what, problem, say, counts):
        """said once, not at each look; counts: the time, of which there is an end"""
        said, since = self.problems.get(what, ("", time.monotonic()))
        if counts and time.monotonic() - since > PATIENCE:
            raise Refused(f"{problem}; no success for {engine.duration(PATIENCE)}: put that right and call again to go on; what is done is kept, and what is in the queue runs on")
        if said != str(problem):
            say(f"{problem}; {what} again each {self.pause:g} s")
        self.problems[what] = str(problem), since if counts else time.monotonic()

    def adopt(self, jobs, say):
        folders, wanted = {job.folder for job in jobs}, {(job.folder, job.key()): job for job in jobs}
        batches = [batch for batch in Batch.all_in(self.folder) if any(run in folders for run, *_ in batch.runs)]
        names = collections.defaultdict(list)  # {job: names of the batches that have its run in this state}
        for batch in batches:
            for folder, of, _ in batch.runs:
                if (folder, of) in wanted:
                    names[wanted[folder, of]].append(batch.name)
        for job, known in names.items():  # before the look, since the job may start right after it; a batch that has the run already keeps it
            last = job.last_claim().batch
            job.claim(last if last in known else known[0])
        queue = self.queue([batch.name for batch in batches]) if batches else {}
        own, others, where = {}, [], None  # {job: (batch, index, what it had saved)}; jobs of another case, as scancel takes them, and the folder of one
        for batch in batches:
            active, wrong = [index for index in range(len(batch.runs)) if self.is_active(queue.get((batch.name, index)))], []
            for index in active:
                folder, of, saved = batch.runs[index]
                job = wanted.get((folder, of))
                if job and (job not in own or batch.name == job.batch):  # of several batches with this run the one that has it
                    own[job] = batch.name, index, saved
                elif not job and folder in folders:
                    wrong.append(index)
                    where = folder
            if wrong:
                number = queue[batch.name, wrong[0]].job
                others += [number] if wrong == active else [f"{number}_{index}" for index in wrong]
            if not active:
                self.forget(batch.name)
        if others:
            raise HVIError(f"{where}: another case, or another state of this one, is still in Slurm's queue for this folder: scancel {' '.join(others)}, or another --runs DIR")
        for job, (name, index, saved) in own.items():
            job.mark(saved)
            job.claim(name)
            self.take(job, name, index)
            say(f"{job.name}: in the queue already, Slurm job {queue[name, index].job}_{index}")

    def submit(self, jobs, say):
        for first in range(0, len(jobs), ARRAY):
            self.submit_array(jobs[first:first + ARRAY], say)

    def draft(self, jobs):
        """folder of a new batch"""
        with writing(self.folder):
            what = re.sub(r"[^\w.+-]", "-", jobs[0].folder.parent.name, flags=re.ASCII)[:40]
            folder = pathlib.Path(tempfile.mkdtemp(prefix=f"hvi-{what}-", dir=self.folder))
            for job in jobs:
                job.mark()
                job.batch = folder.name
            (folder / "runs.pickle").write_bytes(pickle.dumps((self.local, jobs)))
            (folder / "job.sh").write_text(SCRIPT.format(what=what, package=shlex.quote(str(PACKAGE.parent)), python=shlex.quote(sys.executable)))
            engine.write_yaml(folder / "runs.yaml", {"runs": [[str(job.folder), job.key(), job.saved] for job in jobs]})
        return folder

    def submit_array(self, jobs, say):
        folder = self.drafts.get(tuple(jobs))
        if folder is None or folder.name in self.numbers or not folder.exists():  # numbers: its jobs were in the queue nevertheless
            folder = self.drafts[tuple(jobs)] = self.draft(jobs)
        for job in jobs:  # at each try, since another call for the same state may have claimed it in between
            job.claim(folder.name)
        try:
            number = self.numbers[folder.name] = said(self.sbatch(folder.name, len(jobs), folder)).strip().partition(";")[0]
        except Refused as problem:  # the folder stays: after a timeout jobs may be in the queue nevertheless, and the next look or call finds them
            raise Refused(f"{problem} ({shlex.join(['sbatch', *self.words])})") from None
        del self.drafts[tuple(jobs)]
        self.has_sent = True
        with writing(folder):
            (folder / "number").write_text(number)
        for index, job in enumerate(jobs):
            self.take(job, folder.name, index)
        say(f"submitted: {len(jobs)} run{'s' * (len(jobs) > 1)}, Slurm job {self.numbers[folder.name]}, {folder}")

    def take(self, job, name, index):
        self.place[job], self.over[job] = (name, index), 0

    def forget(self, name):
        """the folder of a batch with nothing in the queue, and no run that this call has an eye on"""
        folder = self.folder / name
        is_over = name in self.numbers or (folder / "number").exists() or is_old(folder) and folder not in self.drafts.values()
        if is_over and name not in self.kept and name not in {name for name, _ in self.place.values()}:
            shutil.rmtree(folder, ignore_errors=True)

    # ------------------------------------------------------------------ looks at the queue
    @staticmethod
    def is_active(entry):
        return entry is not None and entry.state not in ENDED

    def queue(self, names):
        """{(name, index): Entry} of all jobs of these batches that Slurm remembers"""
        found = {}
        for line in said(["squeue", f"--name={','.join(names)}", "--states=all", "--array", "--noheader", "--format=%j|%K|%F|%T|%r"]).splitlines():
            words = line.split("|", 4)
            if len(words) == 5 and words[1].isdigit():  # else no job of an array, but a remark of the site
                name, index, *entry = words
                found[name, int(index)] = Entry(*entry)
                self.numbers[name] = entry[0]
        return found

    def ended(self, jobs, say):
        if time.monotonic() < self.next:
            return []
        self.next = time.monotonic() + self.pause
        if self.unsent:
            self.send(say)
        left, self.left = self.left, []
        jobs = [job for job in jobs if job in self.place]
        return left + (self.over_in_queue(jobs, say) if jobs else [])

    def over_in_queue(self, jobs, say):
        """which of these jobs, all submitted, have ended; those that were cut off are submitted again"""
        try:
            queue = self.queue(sorted({self.place[job][0] for job in jobs}))
        except Refused as problem:  # the controller is away: jobs run on, and that they are not seen says nothing
            self.refused("looking", problem, say, counts=False)
            return []
        self.problems.pop("looking", None)
        self.tell([queue.get(self.place[job]) for job in jobs], say)
        over, again = [], []
        for job in jobs:
            entry = queue.get(self.place[job])
            if self.is_active(entry):
                self.over[job] = 0
                continue
            self.over[job] += 1
            state = entry.state if entry else None
            if self.has_left_record(job, state):
                over.append(job)
            elif self.over[job] >= LOOKS and state in CUT_OFF and job.has_saved_more():
                say(f"{job.name}: its job was cut off ({state or 'it is not in the queue'}) and had saved more: submitted again")
                again.append(job)
            elif self.over[job] >= LOOKS:
                job.problem, job.advice = self.without_record(job, state)
                over.append(job)
        ended = {job: self.place.pop(job)[0] for job in (*over, *again)}
        self.kept |= {name for job, name in ended.items() if job.problem}
        self.unsent += again  # at the next look: a refusal must not hide which runs are over
        for name in {*ended.values()} - {name for (name, _), entry in queue.items() if self.is_active(entry)}:
            self.forget(name)
        return over

    def has_left_record(self, job, state):
        """whether a run whose job has ended has a result, or a failure, which is in job.problem then"""
        name, index = self.place[job]
        left = engine.read_yaml(self.folder / name / f"{index}.yaml")
        if left and (state is None or state not in CUT_OFF):  # a run that is cut off with its job may take that for a failure of its own
            job.problem, job.advice = left["problem"], left["advice"]
            return True
        return job.result() is not None

    def without_record(self, job, state):
        """problem and advice of such a run"""
        name, index = self.place[job]
        problem = f"its Slurm job ended ({state or 'it is not in the queue'}) without a result"
        if state == "TIMEOUT":
            return problem, "it has saved nothing new, another job would come no farther: take a longer --time"
        if state in CUT_OFF:
            return problem, "it has saved nothing new: call again to submit it again"
        said_last = []
        with contextlib.suppress(OSError):
            said_last = [line.strip() for line in (self.folder / name / f"{index}.txt").read_text(errors="replace").splitlines() if line.strip()][-1:]
        return problem, "; ".join([*said_last, f"see {self.folder / name}"])

    def tell(self, entries, say):
        """how many runs are in which state, when there is another state"""
        kinds = collections.Counter(f"{entry.state} ({entry.reason})" if entry.state == "PENDING" else entry.state for entry in entries if self.is_active(entry))
        if kinds and set(kinds) != self.kinds:
            say("Slurm: " + ", ".join(f"{number} {kind}" for kind, number in sorted(kinds.items())))
            self.kinds = set(kinds)

    # ------------------------------------------------------------------ the end
    def stop(self, jobs):
        """they run on"""

    def interrupted(self, jobs):
        numbers = sorted({self.numbers[name] for name, _ in self.place.values() if name in self.numbers})
        return f"what is in Slurm's queue runs on: call again to go on{', or ' + ' '.join(['scancel', *numbers]) if numbers else ''}"
