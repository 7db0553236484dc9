# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Many runs of a LAMMPS input: each in its own folder, some at a time, those that are done left alone.

A run is done if its folder has a complete result.yaml and its job.yaml says that input, files that it includes, variables
and the files that these read were the same. One that was interrupted goes on from its restart files where a second input does that. Ctrl-C ends
what runs; what another process is still at (after kill -9 of the first) is waited for.
"""

import collections
import contextlib
import fcntl
import hashlib
import itertools
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

import yaml

from .. import tables, texts
from ..errors import HVIError, writing
from ..material.library import potentials

RESULT, LAST = "result.yaml", "package_version"  # what a run is for, and the last key in it: it is there if the file is complete
PATIENCE = 10  # seconds that mpirun has to end its ranks
BEGINS, SILENT = 60, 1800  # seconds after which it is said that LAMMPS has not begun, or has written nothing
KILLED = {-signal.SIGTERM, -signal.SIGKILL, 128 + signal.SIGTERM, 128 + signal.SIGKILL}  # exit statuses of mpirun
DAY = 86400  # seconds
FULL = 100_000  # bytes: less is a full disk
END = b"LammpS RestartT\0"  # of a restart file
CLAIM = 128  # bytes of a claim in a lock file, all the same

LOADER, DUMPER = (getattr(yaml, f"C{name}", getattr(yaml, name)) for name in ("SafeLoader", "SafeDumper"))  # ten times as fast where PyYAML has libyaml

Claim = collections.namedtuple("Claim", "began key batch")  # of a run by a call: when the call began (ns), Job.key() of what it asked for, the batch of Slurm's jobs that it waits for


def read_yaml(path):
    """the mapping in a YAML file; None if there is none"""
    try:
        data = yaml.load(texts.read(path), Loader=LOADER)
    except Exception:  # of many kinds: constructors do not check what they take
        return None
    return data if isinstance(data, dict) else None


def yaml_of(mapping):
    return yaml.dump(mapping, Dumper=DUMPER, sort_keys=False, width=1000)


def write_yaml(path, mapping):
    """a YAML file, whole or not at all"""
    with texts.whole(path) as out:
        out.write(yaml_of(mapping))


def is_whole(path):
    """whether a restart file ends as LAMMPS ends it; it says nothing itself where the disk is full"""
    with contextlib.suppress(OSError), open(path, "rb") as file:
        file.seek(-len(END), os.SEEK_END)
        return file.read() == END
    return False


def checksum_of(path):
    """of a file that is on the disk then"""
    found = hashlib.sha256()
    with open(path, "rb") as file:
        os.fsync(file.fileno())
        while part := file.read(1 << 20):
            found.update(part)
    return found.hexdigest()


def frames(folder, pattern):
    """dumps in order of their steps"""
    return sorted(pathlib.Path(folder).glob(pattern), key=lambda path: int(re.sub(r"\D", "", path.name) or 0))


class Input:
    """A LAMMPS input and what it includes, as texts: copies of them are run."""

    def __init__(self, path):
        self.path, self.texts = pathlib.Path(path).resolve(), {}
        self.name = self.path.name
        self._read(self.name)
        self.known = {}  # variables that -var may set: {name: may it have several values}
        joined = re.sub(r"&[ \t]*\n", " ", "\n".join(self.texts.values()))
        self.commands = re.sub(r"""("[^"\n]*"|'[^'\n]*')|#.*""", r"\1", joined)  # without comments
        for name, values in re.findall(r'\bvariable\s+(\w+)\s+index\b(?=([^"\n]*))', self.commands):
            self.known[name] = self.known.get(name, False) or len(values.split()) > 1
        said = [line.split() for line in re.findall(r"^\s*hvi/variables\s+known\s(.*)", self.commands, re.M)]
        if said:  # the input itself says which; what it names as optional may be lists
            named = {name for line in said for name in line} - {"optional"}
            optional = {name for line in said if "optional" in line for name in line[line.index("optional") + 1:]}
            self.known = {name: name in optional or self.known.get(name, True) for name in named}

    def _read(self, name):
        self.texts[name] = text = texts.read(self.path.parent / name)
        for other in re.findall(r"^\s*include\s+([\w./-]+)\s*(?:#.*)?$", text, re.M):  # names without variables
            if not os.path.isabs(other) and not inside(other):
                raise HVIError(f"{self.path.parent / name}: include {other}: a run has copies of what it includes, in its own folder: put the file beside the input, or give its whole path")
            if other not in self.texts and (not os.path.isabs(other) or os.path.isfile(other)):  # a whole path may be that of a file that the run makes
                self._read(other)

    def checksum(self):
        return digest("\0".join(self.texts[name] for name in sorted(self.texts)).encode())

    def reads(self, variables):
        """names of the files that commands read with these variables, or else their defaults: materials, data, molecules, inputs"""
        known = {name: value.strip("\"'") for name, value in re.findall(r"^\s*variable\s+(\w+)\s+(?:index|string|getenv)\s+(\S+)", self.commands, re.M)}
        known.update((name, words(value)[0]) for name, value in variables.items())

        def filled(word):
            return re.sub(r"\$\{(\w+)\}|\$(\w)", lambda match: str(known.get(match[1] or match[2], "$")), word.strip("\"'"))

        named = re.findall(r"^\s*(?:read_data|read_restart|molecule\s+\S+|pair_coeff\s.*?\b(?:file|eos\s+table))\s+(\S+)", self.commands, re.M)
        named += re.findall(r"^\s*include\s+(\S*\$\S*)", self.commands, re.M)  # the others are in texts
        return [word for word in map(filled, named) if "$" not in word and "*" not in word]

    def check(self, variables, where):
        """LAMMPS takes any name after -var; one that the input does not know would change nothing"""
        for name, value in variables.items():
            if name not in self.known:
                raise HVIError(f"{where}: {self.name} has no variable '{name}'")
            if odd := [word for word in words(value) if word.startswith("-") and not number(word) or "\n" in word or not word]:
                raise HVIError(f"{where}: variable '{name}' of {self.name}: {odd[0]!r} is no value: LAMMPS would take it for an option, or for nothing")
            if isinstance(value, list) and not self.known[name]:
                raise HVIError(f"{where}: variable '{name}' of {self.name} is one value, not a list")

    def copy_to(self, folder):
        for name, text in self.texts.items():  # LAMMPS reads on while it runs
            if os.path.isabs(name):
                continue  # is there for all runs
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)


def inside(name):
    """is this the name, or a pattern of names, of files in a folder or below it?"""
    return not os.path.isabs(name) and ".." not in pathlib.PurePath(name).parts


def number(word):
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False


def digest(data):
    return hashlib.sha256(data).hexdigest()[:16]


def words(value):
    """a value of a variable as LAMMPS's words: a list has a word for each"""
    return [str(v) for v in (value if isinstance(value, list) else [value])]


def job_name(case):
    """a folder name from what varies: tD-0.1_v0-5000"""
    return "_".join(re.sub(r"[^\w.+-]", "-", f"{name}-{'+'.join(words(value))}") for name, value in case.items()) or "as-is"


class Job:
    """One run of an input in its own folder; goes_on: the input that goes on with it, restart: pattern of the files from which."""

    def __init__(self, source, name, variables, folder, restart=None, remove=(), weight=1.0, made=None, goes_on=None):
        self.input, self.name, self.variables, self.folder = source, name, variables, pathlib.Path(folder)
        self.restart, self.remove, self.weight, self.goes_on = restart, remove, weight, goes_on  # weight: how much of all work this is
        self.record = {"input": source.checksum(), "variables": variables}
        if goes_on:
            self.record["continue"] = goes_on.checksum()
        self.make, meshes = made or (None, {})  # a function of path and words, {file: words}: what the run finds in its folder
        if meshes:
            self.record["made"] = meshes
        if files := self._files():
            self.record["files"] = files
        self.process, self.lock, self.start, self.problem, self.advice, self.asked = None, None, None, "", "", False
        self.resumed, self.saved = False, []  # if it went on, and from what
        self.launched, self.stamp = 0.0, 0.0  # of the last call of LAMMPS: when, by this machine's clock without steps, and by that of the files
        self.began = 0  # when the call began that this job is of, which its engine says (ns)
        self.batch = ""  # of Slurm's jobs, that it was submitted in; "": runs without Slurm

    def _files(self):
        """checksums of the files that variables name, and that the inputs read: materials with their tables, plates"""
        found = {}

        def note(word, places):
            of = (pathlib.Path(os.path.normpath(place / word)) for place in places)  # an absolute path stays what it is; folders of runs may not be there yet
            path = next(filter(os.path.isfile, of), None)
            if path is None or self.folder.resolve() in path.resolve().parents:  # what is in the folder was written by the run
                return
            found[word] = digest(path.read_bytes())
            for table in re.findall(r"^[ \t]*file[ \t]+([^\s#]+)", path.read_text(errors="replace"), re.M) if path.suffix == ".hvi" else ():
                note(table, (*potentials(), self.folder))

        for word in (word for value in self.variables.values() for word in words(value)):
            if re.search(r"\.\w*[a-z]\w*$", word):
                note(word, potentials())
        for source in filter(None, (self.input, self.goes_on)):
            for word in source.reads(self.variables):
                note(word, (*potentials(), self.folder))
        return found

    def key(self):
        """checksum of what is run in the folder: of another case, or another state of the same, it is another"""
        return digest(json.dumps(self.record, default=str).encode())

    def result(self):
        """the results if the job is done with these variables, input and files, else None"""
        if not self.begun():
            return None
        result = read_yaml(self.folder / RESULT)
        return result if result and LAST in result else None

    def begun(self):
        """True if it was started before, with these variables, input and files"""
        return read_yaml(self.folder / "job.yaml") == self.record

    def restart_files(self):
        """what the run left to go on from, newest last"""
        found = self.folder.glob(self.restart) if self.restart and self.begun() else []
        return sorted(filter(is_whole, found), key=lambda path: path.stat().st_mtime)

    def _saved(self):
        """files with particles and their times, [[path, ns], ...]"""
        return sorted([str(path), path.stat().st_mtime_ns] for path in [*self.folder.glob("*.restart*")] or self.restart_files())

    def has_saved_more(self):
        """whether another call would come farther than this one: what it would go on from is new, and whole"""
        return any([str(path), path.stat().st_mtime_ns] not in self.saved for path in self.restart_files()[-1:])

    def mark(self, saved=None):
        """a call begins: time, problem and what is saved count from now; saved: of a call that has begun already"""
        self.start, self.problem, self.advice, self.saved = time.monotonic(), "", "", self._saved() if saved is None else saved

    def words(self):
        """LAMMPS's options"""
        files = self.restart_files()
        options = ["-in", (self.goes_on if files else self.input).name, "-log", "log.lammps"]
        for name, value in self.variables.items():
            options += ["-var", name, *words(value)]
        return options + (["-var", "from", str(files[-1].relative_to(self.folder))] if files else [])

    @property
    def lock_file(self):
        """beside the folder, which is emptied; locked while a process is at this run, its text is the claim of the last call that asked for the run"""
        return self.folder.parent / f".{self.folder.name}.lock"

    def last_claim(self):
        """the Claim in the lock file; began is 0 if no call has asked for this run"""
        found = None
        with contextlib.suppress(OSError):
            found = re.match(r"(\d+) (\w+) (\S*)", self.lock_file.read_text(errors="replace"))
        return Claim(int(found[1]), found[2], found[3]) if found else Claim(0, "", "")

    def claim(self, batch=""):
        """from now on jobs of other batches leave this run alone, whatever case they are of and whenever Slurm starts them

        A claim always has the same length and is written over the last one in one piece: a process that reads the file at that moment finds one of the two, and
        a lock on the file stays.
        """
        self.batch = batch
        text = f"{max(self.began, self.last_claim().began)} {self.key()} {batch}".ljust(CLAIM).encode()
        with writing(self.lock_file):
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            file = os.open(self.lock_file, os.O_RDWR | os.O_CREAT, 0o666)
            try:
                if os.pread(file, CLAIM, 0) != text:
                    os.pwrite(file, text, 0)
            finally:
                os.close(file)

    def is_of_later_call(self):
        """whether a call that began later than this one has asked for this run in another state: of such calls the one that began last counts

        Not the one that has claimed the run last: a call may come to a run hours after it began, and a search does not know before which runs it wants. Clocks of
        the machines where calls begin must agree.
        """
        last = self.last_claim()
        return last.began > self.began and last.key != self.key()

    def leave_to_later_call(self):
        """nothing is run"""
        self.problem, self.advice = f"{self.folder}: a later call has asked for this run", "its files are left as they are: call again to run this case"

    def take(self):
        """True if no other process is at this run; from now on none can be. Processes that it starts keep the lock."""
        self.folder.parent.mkdir(parents=True, exist_ok=True)
        lock = os.open(self.lock_file, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(lock)
            return False
        self.lock = lock
        return True

    def leave(self):
        if self.lock is not None:
            os.close(self.lock)
            self.lock = None

    def begin(self, command):
        """start it, in an empty folder unless it goes on; nothing left there can be taken for a result"""
        self.resumed = bool(self.restart_files())
        if not self.resumed:
            shutil.rmtree(self.folder, ignore_errors=True)
        self.saved = self._saved()
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / RESULT).unlink(missing_ok=True)
        for source in filter(None, (self.input, self.goes_on)):
            source.copy_to(self.folder)
        for name, said in self.record.get("made", {}).items():
            self.make(self.folder / name, **said)
        (self.folder / "job.yaml").write_text(yaml_of(self.record))
        self.launch(command)

    def launch(self, command, more=False):
        """more: what it prints is added to what there is"""
        environment = {**os.environ, "LAMMPS_POTENTIALS": os.pathsep.join(map(str, potentials()))}
        with open(self.folder / "output.txt", "a" if more else "w") as out:
            os.utime(out.fileno())
            self.launched, self.stamp = time.monotonic(), os.stat(out.fileno()).st_mtime
            self.process = subprocess.Popen(command(self), cwd=self.folder, stdin=subprocess.DEVNULL, stdout=out, env=environment,
                                            stderr=subprocess.STDOUT, start_new_session=True, pass_fds=[self.lock])

    def ended(self, command, timeout):
        """True when it is over, by itself or by the time limit; self.problem then says what is wrong"""
        if self.start is None:
            self.start, self.problem, self.advice = time.monotonic(), "", ""
        late = timeout and time.monotonic() - self.start > timeout
        if self.process is None:  # another process was at it, or it has yet to begin
            if self.take():
                theirs = self.last_claim().batch != self.batch if self.batch else self.is_of_later_call()  # looked at under the lock, which is held until the result is there
                if self.result() is None and theirs:
                    self.leave_to_later_call()
                elif self.result() is None:
                    if not self.batch:
                        self.claim()
                    self.begin(command)
                    return False
            elif late:
                self.problem = f"another process is at it for more than {timeout:g} s"
            else:
                return False
            self.leave()
            return True
        status = self.process.poll()
        if status is None and not late or status == 0 and self.goes_on_now(command):
            return False
        if status is None:
            end([self])
            self.problem = f"stopped after {timeout:g} s"
            self.advice = ("call again: it goes on from what it has saved" if self.has_saved_more() else
                           "it has saved nothing new, another call would come no farther: take a longer --timeout")
        elif status != 0:
            self.problem = said_of(status)
            if any(re.search(r"ERROR: Unrecognized \w+ style '(hvi/|sph')", line) for line in self.last_lines()):
                self.advice = "this LAMMPS has no USER-HVI, or an older one: hvi doctor says more"
        elif self.result() is None:
            self.problem = f"no complete {RESULT}"
        if not self.problem:
            self.problem = self.finish()
        if self.problem and shutil.disk_usage(self.folder).free < FULL:
            self.advice = "the disk is full"
        killed = status is None or status in KILLED  # from outside, a rank by a lack of memory, all with their job: that says nothing about the file
        if self.problem and self.resumed and not killed and self._saved() == self.saved:
            for path in self.restart_files()[-1:]:  # it came no farther: what it went on from may be what is wrong, the next try takes the one before, or begins anew
                path.unlink()
        for pattern in [] if self.problem else self.remove:
            for path in self.folder.glob(pattern):
                if path.name not in (RESULT, "job.yaml"):  # without them it would not be done
                    path.unlink()
        self.process = None
        self.leave()
        return True

    def goes_on_now(self, command):
        """after a call of LAMMPS that ended well: True if it was not the last of the run, and the next one has begun"""
        return False

    def finish(self):
        """what is done with a run that has ended well; what went wrong, "" if nothing"""
        return ""

    def ask_to_end(self):
        """once: a second signal would make mpirun leave without its ranks"""
        if self.process is not None and not self.asked:
            self.process.terminate()
            self.asked = True

    def kill(self):
        """if it still runs; with its ranks, which have groups of their own and would see only later that mpirun is gone"""
        if self.process is not None and self.process.poll() is None:
            ranks = []
            with contextlib.suppress(OSError):  # where there is no such file they end by themselves
                ranks = pathlib.Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text().split()
            os.killpg(self.process.pid, signal.SIGKILL)
            for rank in ranks:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(int(rank), signal.SIGKILL)
            self.process.wait()
        self.leave()

    def stage(self):
        """(part of the run that is done, words on it); here nothing is known of it"""
        return 0.0, ""

    def silence(self):
        """("not begun" or "quiet", what is said) of a run that writes nothing, else None: mpirun waits for ever for a rank that was killed while others were being started"""
        if self.process is None:
            return None
        last, waited = 0.0, time.monotonic() - self.launched
        for path in self.folder.glob("*"):
            with contextlib.suppress(OSError):  # removed just now
                last = max(last, path.stat().st_mtime if path.name != "output.txt" else 0.0)
        ends = "Ctrl-C ends all runs of this call, the next call goes on"
        if last <= self.stamp:
            return ("not begun", f"LAMMPS has not begun after {duration(waited)}, mpirun may be waiting for a rank that was killed; {ends}") if waited > BEGINS else None
        quiet = time.time() - last
        return ("quiet", f"nothing written for {duration(quiet)}: large runs may be at work, if no rank is {ends}") if quiet > SILENT else None

    def last_lines(self, n=8):
        """the end of what LAMMPS and mpirun said, from the first error on if there is one"""
        try:
            lines = [line.rstrip() for line in (self.folder / "output.txt").read_text(errors="replace").splitlines()]
        except OSError:
            return []
        lines = [line for line in lines if line]
        frame = next((i for i, line in enumerate(lines) if re.fullmatch("-{60,}", line)), 0)  # what mpirun says after that hides why
        lines = lines[:frame] or lines
        errors = [i for i, line in enumerate(lines) if line.startswith("ERROR") or "*** Process received signal ***" in line]
        return lines[max(0, errors[0] - 1):][:n] if errors else lines[-n:]


def end(jobs):
    """mpirun ends its ranks when it is told to; if it does not listen, or Ctrl-C is pressed again, it is killed"""
    try:
        for job in jobs:
            job.ask_to_end()
        until = time.monotonic() + PATIENCE
        for job in jobs:
            if job.process is not None:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    job.process.wait(timeout=max(until - time.monotonic(), 0.0))
    finally:
        for job in jobs:
            job.kill()


def said_of(status):
    """an exit status in words; that of mpirun is 128 + the signal that ended a rank"""
    number = -status if status < 0 else status - 128
    known = {member.value: member.name for member in signal.Signals}
    return f"exit status {status}" + (f" ({known[number]}{': out of memory?' if number == signal.SIGKILL else ''})" if number in known else "")


def duration(seconds):
    """in the unit of which there are some"""
    for unit, size, most in (("s", 1, 90), ("min", 60, 5400), ("h", 3600, 48 * 3600), ("days", DAY, 730 * DAY)):
        if seconds < most:
            return f"{seconds / size:.{int(unit == 'h')}f} {unit}"
    return f"{seconds / (365.25 * DAY):,.0f} years"


def cell(value):
    """a variable or a result as a cell of a table"""
    return "; ".join(map(str, value)) if isinstance(value, list) else value


def same(one, other):
    """words that are equal, or the same numbers"""
    pairs = list(itertools.zip_longest(words(one), words(other), fillvalue=""))
    return all(a == b or number(a) and number(b) and float(a) == float(b) for a, b in pairs)


def write_table(jobs, path):
    """A CSV file: job, variables, results of all jobs that are done; a variable that is another than the result of its name has the column NAME_variable"""
    done = [(job, {**result, "job": job.name}) for job in jobs if (result := job.result())]
    other = {name for job, result in done for name, value in job.variables.items() if not same(result.get(name, value), value)}

    def variables(job):
        return {f"{name}_variable" if name in other else name: value for name, value in job.variables.items()}

    rows = [{**variables(job), **result} for job, result in done]
    columns = list(dict.fromkeys(["job", *(n for j in jobs for n in variables(j)), *(n for row in rows for n in row)]))
    path.parent.mkdir(parents=True, exist_ok=True)
    tables.write_csv(path, columns, [[cell(row.get(name, "")) for name in columns] for row in rows])


@contextlib.contextmanager
def table_of(jobs, path):
    """write_table() at the end, of a part of the runs, too; what stopped them is what is said, not that there is no room for the table either

    jobs: function without arguments
    """
    try:
        yield
    except BaseException:
        with contextlib.suppress(OSError, HVIError):
            write_table(jobs(), path)
        raise
    with writing(path):
        write_table(jobs(), path)


def overview(jobs, keys):
    """A table for the eye: all jobs, with those of the keys that any of them has."""
    results = [(job, job.result() or {}) for job in jobs]
    shown = [key for key in keys if any(key in result for _, result in results)]
    rows = [(job.name, "done" if result else job.problem or "not run", *(cell(result.get(key, "-")) for key in shown)) for job, result in results]
    return tables.text(("run", "state", *shown), rows)
