"""python3 -m hvi ... --engine slurm: what is submitted, how ended jobs are told apart, what a second call takes up. Slurm and LAMMPS are fakes here;
tests/verify/test_slurm_runs.py does it with both."""

import fcntl
import json
import os
import pickle
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import pytest
import yaml
from front_runs import change, front, tries, wait_for, case_folder  # noqa: F401
from hvi import cli
from hvi.jobs import engine, runs, slurm

CASE = change("spacings_mm: [0.2, 0.4]", "spacings_mm: [0.4]")  # two runs, shifts 0 and 0.5; one spacing decides nothing
UNDECIDED = 4
SUBMIT = ("--engine", "slurm", "--poll", "0.01", "--ranks", "3")


@pytest.fixture(scope="module")
def jobs(root):
    """socket of what runs the jobs; its name has 107 bytes at most, so not in the folder of the test"""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, root / "tests/lib/fake_jobs.py", f"{folder}/socket"]
        with subprocess.Popen(words, env={**os.environ, "PYTHONPATH": str(root / "python")}, stdout=subprocess.PIPE) as server:
            assert server.stdout.readline() == b"ready\n"
            yield f"{folder}/socket"
            server.terminate()


@pytest.fixture
def fake(folder, root, jobs, monkeypatch):
    """the folder of the fake, whose commands are first on PATH"""
    (folder / "emi.yaml").write_text(CASE)
    home = folder / "slurm"
    (home / "bin").mkdir(parents=True)
    for name in ("sbatch", "squeue"):
        (home / "bin" / name).write_text(f"#!/bin/sh\nexec '{sys.executable}' -I -S '{root}/tests/lib/fake_slurm.py' {name} \"$@\"\n")
        (home / "bin" / name).chmod(0o755)
    monkeypatch.setenv("FAKE_SLURM", str(home))
    monkeypatch.setenv("FAKE_JOBS", jobs)
    monkeypatch.setenv("FAKE_PYTHON", sys.executable)
    monkeypatch.setenv("PATH", f"{home / 'bin'}:{os.environ['PATH']}")
    return home


def calls(fake):
    path = fake / "calls"
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def batches(folder):
    return sorted(path.name for path in folder.glob("runs/.slurm/hvi-*"))


def claims(folder):
    """the batch that has each run"""
    return {path.name: path.read_text().split()[-1] for path in folder.glob("runs/emi/.*.lock")}


def records(folder):
    """what is compared of two engines: verdict and table; times are the fake's, so the same"""
    said = yaml.safe_load((folder / "verdict.yaml").read_text())
    return {key: value for key, value in said.items() if key != "command"}, (folder / "runs.csv").read_text()


def test_the_same_records(folder, fake, capsys, monkeypatch):
    """one array for the runs of a verdict, and nothing is left of it; verdict and table are those of runs on this machine"""
    monkeypatch.delenv("FAKE_JOBS")  # these by job.sh itself
    assert front("shield", *SUBMIT, "--time", "4:00:00", "--nodes", "2", "--partition", "p1", "--account", "a1", "--sbatch=--mem=4G --qos 'so long'") == UNDECIDED
    out = capsys.readouterr().out
    assert "submitted: 2 runs, Slurm job 1, " in out and out.count("  ok  ") == 2
    (words,) = calls(fake)
    name = next(word for word in words if word.startswith("--job-name=hvi-emi-")).partition("=")[2]
    at = folder / "runs/.slurm" / name
    assert words == ["--mem=4G", "--qos", "so long", "--ntasks=3", "--nodes=2", "--time=4:00:00", "--partition=p1", "--account=a1", "--parsable", f"--job-name={name}", "--array=0-1",
                     f"--chdir={at}", "--output=%a.txt", "--open-mode=append", "--requeue", "--export=ALL", str(at / "job.sh")]
    assert set(tries(folder).values()) == {1} and len(tries(folder)) == 2 and batches(folder) == []
    said = yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())["command"]
    assert said.endswith("--engine=slurm --nodes=2 --time=4:00:00 --partition=p1 --account=a1 '--sbatch=--mem=4G --qos '\"'\"'so long'\"'\"'' --poll=0.01")
    assert front("shield", "--runs", "local", "--ranks", "3") == UNDECIDED
    assert records(folder / "runs/emi") == records(folder / "local/emi")
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 1  # all is done


def test_commands_share_it(folder, fake, capsys):
    """a search submits what its last answers ask for; --jobs is the most in the queue at a time; arrays have an end"""
    assert front("limit", "--on", "D", "--from", "3", "--to", "6", "--step", "1", *SUBMIT) == 0
    assert len(calls(fake)) > 2 and sum(tries(folder).values()) == yaml.safe_load((folder / "runs/emi/limit-D/limit.yaml").read_text())["runs"]
    for command in ("shield", "limit", "limits", "curve", "shots", "sweep"):
        assert cli.parse([command, "x", *(("--on", "D") if command == "limit" else ()), "--engine", "slurm", "--time", "5"]).time == "5"


def test_some_at_a_time(folder, fake, monkeypatch):
    assert front("shield", *SUBMIT, "--jobs", "1") == UNDECIDED
    assert [word for words in calls(fake) for word in words if word.startswith("--array")] == ["--array=0-0"] * 2
    (folder / "emi.yaml").write_text(CASE.replace("[0, 0.5]", "[0, 0.25, 0.5]"))
    monkeypatch.setattr(slurm, "ARRAY", 2)
    assert front("shield", *SUBMIT, "--runs", "more") == UNDECIDED
    assert [word for words in calls(fake)[2:] for word in words if word.startswith("--array")] == ["--array=0-1", "--array=0-0"]


# ---------------------------------------------------------------------- jobs that end without a result
def test_stopped_and_submitted_again(folder, fake, capsys, monkeypatch):
    """as long as it saves more, and no longer; the next job goes on from there"""
    monkeypatch.setenv("FAKE_SAVE", "shift-0.5")
    monkeypatch.setenv("FAKE_SLEEP", "2")
    monkeypatch.setenv("FAKE_PLAN", "stop stop run")
    assert front("shield", *SUBMIT) == 1
    out, err = capsys.readouterr()
    assert out.count("_shift-0.5: its job was cut off (TIMEOUT) and had saved more: submitted again\n") == 2 and "_shift-0.0: " not in out
    assert out.count("_shift-0.0  FAILED: its Slurm job ended (TIMEOUT) without a result; it has saved nothing new, another job would come no farther: take a longer --time") == 1
    assert len(calls(fake)) == 3 and "no verdict: 1 of 2 runs failed" in err
    assert (folder / "runs/emi/dx-0.4_shift-0.5/tries").read_text().split() == ["no", "yes", "yes"]
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 4 and set(tries(folder).values()) == {3, 1}  # the others began anew
    assert batches(folder) == []


def test_saved_more(folder):
    """only a whole restart file that is new: a job that is cut off while it writes has no right to another"""
    (folder / "in.main").write_text("")
    (folder / "a").mkdir()
    job = engine.Job(engine.Input(folder / "in.main"), "a", {}, folder / "a", restart="x.restart.*")
    engine.write_yaml(folder / "a/job.yaml", job.record)
    first, second = (folder / f"a/x.restart.{k}" for k in (1, 2))
    job.mark()
    assert not job.has_saved_more()
    first.write_bytes(engine.END)
    assert job.has_saved_more()
    job.mark()
    second.write_bytes(engine.END[:5])
    assert not job.has_saved_more()
    second.write_bytes(engine.END)
    os.utime(second, ns=(0, first.stat().st_mtime_ns + 10**9))
    assert job.has_saved_more()


@pytest.mark.parametrize("plan, says", [
    ("CANCELLED", "its Slurm job ended (CANCELLED) without a result; see "), ("FAILED", "its Slurm job ended (FAILED) without a result; see "),
    ("NODE_FAIL", "its Slurm job ended (NODE_FAIL) without a result; it has saved nothing new: call again to submit it again"), ("nothing", "its Slurm job ended (it is not in the queue) without a result; it has saved nothing new: call again to submit it again")])
def test_job_without_a_record(folder, fake, capsys, monkeypatch, plan, says):
    """one submission, one message; the next call tries again"""
    monkeypatch.setenv("FAKE_PLAN", f"{plan} run")
    assert front("shield", *SUBMIT) == 1
    assert capsys.readouterr().out.count(says) == 2 and len(calls(fake)) == 1
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 2 and batches(folder) == []


def test_job_that_cannot_begin(folder, fake, capsys, monkeypatch):
    """the last words of the job itself are shown"""
    monkeypatch.setattr(sys, "executable", "/no/python")
    assert front("shield", *SUBMIT) == 1
    assert "/no/python: not found; see " in capsys.readouterr().out and len(calls(fake)) == 1


def test_run_that_fails(folder, fake, capsys, monkeypatch):
    """for good, with what LAMMPS has said; that other runs are done is kept, and a failure is forgotten when the run is tried again"""
    monkeypatch.setenv("FAKE_FAIL", "dx-0.4_shift-0.0")
    assert front("shield", *SUBMIT) == 1
    out, err = capsys.readouterr()
    assert "dx-0.4_shift-0.0  FAILED: exit status 1  " in out and "    | ERROR: Lost atoms (as told to)" in out and "1 of 2 runs failed" in err
    (batch,) = batches(folder)
    (left,) = (folder / "runs/.slurm" / batch).glob("[0-9].yaml")
    assert len(calls(fake)) == 1 and yaml.safe_load(left.read_text()) == {"problem": "exit status 1", "advice": ""}
    monkeypatch.delenv("FAKE_FAIL")
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 2 and sum(tries(folder).values()) == 2 and batches(folder) == []


def test_what_a_job_cannot_write(folder, fake, capsys, monkeypatch):
    """it says so where it was called; what the call itself cannot write is said before anything is submitted"""
    (folder / "runs/emi").mkdir(parents=True)
    (folder / "runs/emi/dx-0.4_shift-0.0").write_text("")
    assert front("shield", *SUBMIT) == 1
    assert "dx-0.4_shift-0.0  FAILED: cannot run in " in capsys.readouterr().out
    (folder / "more/emi/.dx-0.4_shift-0.0.lock").mkdir(parents=True)
    assert front("shield", *SUBMIT, "--runs", "more") == 1
    assert f"cannot write {folder}/more/emi/.dx-0.4_shift-0.0.lock: Is a directory" in capsys.readouterr().err and len(calls(fake)) == 1


# ---------------------------------------------------------------------- calls that end before their jobs
@pytest.fixture
def waiting(folder, fake, capsys, monkeypatch):
    """a call that was interrupted while its jobs wait"""
    monkeypatch.setenv("FAKE_PLAN", "wait")
    look = slurm.Slurm.ended

    def interrupt(self, jobs, say):
        look(self, jobs, say)
        raise KeyboardInterrupt

    with monkeypatch.context() as only:
        only.setattr(slurm.Slurm, "ended", interrupt)
        assert front("shield", *SUBMIT) == 130
    out, err = capsys.readouterr()
    assert "\nSlurm: 2 PENDING (Resources)\n" in out
    assert "interrupted: what is in Slurm's queue runs on: call again to go on, or scancel 1\n" in err and tries(folder) == {}
    return fake


def test_next_call_takes_them_up(folder, waiting, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_START", "yes")
    assert front("shield", *SUBMIT) == UNDECIDED
    out = capsys.readouterr().out
    assert all(f": in the queue already, Slurm job 1_{index}\n" in out for index in range(2)) and "submitted" not in out
    assert len(calls(waiting)) == 1 and set(tries(folder).values()) == {1} and batches(folder) == []


def test_jobs_that_end_without_a_call(folder, waiting, capsys, monkeypatch):
    """their results are there; nothing is submitted"""
    monkeypatch.setenv("FAKE_START", "yes")
    os.system("squeue --name=none >/dev/null")
    assert front("shield", *SUBMIT) == UNDECIDED and "2 runs, 2 done before, 0 to run" in capsys.readouterr().out and len(calls(waiting)) == 1


def test_another_case_in_the_queue(folder, waiting, capsys):
    """its jobs would write into the same folders"""
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield", *SUBMIT) == 1
    assert "another case, or another state of this one, is still in Slurm's queue for this folder: scancel 1, or another --runs DIR" in capsys.readouterr().err
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", "speed_km_s: 7").replace("[0, 0.5]", "[0.5]"))
    assert front("shield", *SUBMIT) == 1 and "scancel 1_1, or another" in capsys.readouterr().err
    assert len(calls(waiting)) == 1


def test_the_controller_is_away(folder, waiting, capsys, monkeypatch):
    """a look that fails says nothing about jobs; the first one of a call does, since they might be submitted twice"""
    (waiting / "away").write_text("")
    assert front("shield", *SUBMIT) == 1 and "hvi: squeue: slurm_load_jobs error: Unable to contact slurm controller" in capsys.readouterr().err
    monkeypatch.setenv("FAKE_START", "yes")
    look, looks = slurm.Slurm.queue, []

    def second_is_away(self, names):
        looks.append(names)
        if len(looks) == 2:
            (waiting / "away").write_text("")
        return look(self, names)

    monkeypatch.setattr(slurm.Slurm, "queue", second_is_away)
    assert front("shield", *SUBMIT) == UNDECIDED
    assert capsys.readouterr().out.count("squeue: slurm_load_jobs error: Unable to contact slurm controller (connect failure); looking again each 0.01 s\n") == 1
    assert len(calls(waiting)) == 1


@pytest.mark.parametrize("name", ["hvi-emi--", "hvi-emi-zzzzzzzzz"])
def test_claim_of_a_waiting_job_stays(folder, waiting, monkeypatch, name):
    """a run that has ended in one batch, where another one waits yet, waits in a second batch: further calls leave it to that, whatever the order of names, also where they
    cannot ask the queue, or find both jobs in it"""
    queue, ended = waiting / "queue", slurm.Slurm.ended
    queue.write_text(queue.read_text().replace("|0|1|PENDING|Resources", "|0|1|TIMEOUT|None"))

    def interrupt(self, jobs, say):
        ended(self, jobs, say)
        raise KeyboardInterrupt

    def named(prefix, dir):
        assert name.startswith(prefix)
        (dir / name).mkdir()
        return dir / name

    with monkeypatch.context() as only:
        only.setattr(slurm.Slurm, "ended", interrupt)
        only.setattr(slurm.tempfile, "mkdtemp", named)
        assert front("shield", *SUBMIT) == 130 and len(calls(waiting)) == 2
        before = claims(folder)
        assert before[".dx-0.4_shift-0.0.lock"] == name != before[".dx-0.4_shift-0.5.lock"]
        (waiting / "away").write_text("")
        assert front("shield", *SUBMIT) == 1 and claims(folder) == before
        queue.write_text(queue.read_text().replace("|0|1|TIMEOUT|None", "|0|1|PENDING|Resources"))
        assert front("shield", *SUBMIT) == 130 and claims(folder) == before
    assert os.system(f"cd '{folder}/runs/.slurm/{name}' && SLURM_ARRAY_TASK_ID=0 sh job.sh >/dev/null") == 0 and list(tries(folder).values()) == [1]


def test_the_controller_is_away_while_jobs_are_in_the_queue(folder, waiting, capsys, monkeypatch):
    """a call that has submitted nothing itself waits on, too, for as long as it takes; so it does where it has another job to submit"""
    monkeypatch.setattr(slurm, "PATIENCE", -1)  # a time that counts would end the call
    monkeypatch.setattr(slurm, "LOOKS", 1)
    monkeypatch.setattr(engine.Job, "has_saved_more", lambda job: True)
    monkeypatch.setenv("FAKE_PLAN", "wait run")
    ended, looks, queue = slurm.Slurm.ended, [], waiting / "queue"

    def away(self, jobs, say):
        looks.append(len(self.unsent))
        if len(looks) == 3:
            queue.write_text(queue.read_text().replace("|0|1|PENDING|Resources", "|0|1|TIMEOUT|None"))
        if len(looks) == 5:
            monkeypatch.setenv("FAKE_START", "yes")
        if len(looks) in (1, 4):
            (waiting / "away").write_text("")
        self.next = 0.0
        return ended(self, jobs, say)

    monkeypatch.setattr(slurm.Slurm, "ended", away)
    assert front("shield", *SUBMIT) == UNDECIDED
    out = capsys.readouterr().out
    assert looks[:5] == [0, 0, 0, 1, 1] and out.count("; looking again each 0.01 s\n") == 1 and out.count("; trying again each 0.01 s\n") == 1
    assert len(calls(waiting)) == 2 and list(tries(folder).values()) == [1, 1] and batches(folder) == []


def test_left_by_a_kill(folder, fake):
    """between folder and sbatch: what is not complete is passed over"""
    for name, text in (("hvi-emi-1", None), ("hvi-emi-2", ""), ("hvi-emi-3", "runs: [[5]]\n")):
        (folder / "runs/.slurm" / name).mkdir(parents=True)
        if text is not None:
            (folder / "runs/.slurm" / name / "runs.yaml").write_text(text)
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 1


def test_another_case_has_run_since(folder, waiting, monkeypatch):
    """without Slurm, which does not ask the queue: a job that starts then leaves what it finds"""
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield", "--ranks", "3") == UNDECIDED
    before = {path: path.read_bytes() for path in folder.glob("runs/emi/*/*")}
    monkeypatch.setenv("FAKE_START", "yes")
    slurm.said(["squeue", "--name=none"])
    assert {path: path.read_bytes() for path in folder.glob("runs/emi/*/*")} == before
    for path in (folder / "runs/.slurm" / batches(folder)[0] / f"{index}.yaml" for index in range(2)):
        assert yaml.safe_load(path.read_text())["problem"].endswith(": a later call has asked for this run")


def test_changed_and_changed_back(folder, waiting, monkeypatch):
    """a job that no later call has taken up leaves the run alone, also of the same case, and what another process is at; one that has been taken up runs"""
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield", "--ranks", "3") == UNDECIDED
    batch = folder / "runs/.slurm" / batches(folder)[0]
    local, jobs = pickle.loads((batch / "runs.pickle").read_bytes())
    assert jobs[0].take()  # another process is at the run when the job starts, and its folder is empty yet
    shutil.rmtree(jobs[0].folder)
    later = threading.Timer(1.0, jobs[0].leave)
    later.start()
    before = {path: path.read_bytes() for path in folder.glob("runs/emi/*/*")}
    assert os.system(f"cd '{batch}' && SLURM_ARRAY_TASK_ID=0 sh job.sh >/dev/null") != 0
    later.join()
    assert {path: path.read_bytes() for path in folder.glob("runs/emi/*/*")} == before and (batch / "0.yaml").exists()
    (folder / "emi.yaml").write_text(CASE)
    monkeypatch.setenv("FAKE_START", "yes")
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(waiting)) == 1
    assert all(yaml.safe_load(path.read_text())["variables"]["v0"] == 7100 for path in folder.glob("runs/emi/*/job.yaml"))
    assert batches(folder) == []


def test_two_jobs_of_a_run(folder, waiting, monkeypatch):
    """the second was submitted when the first, of a sbatch that had not answered, was not in the queue yet: the first one leaves the run to it"""
    (folder / "slurm/queue").write_text("")
    first = folder / "runs/.slurm" / batches(folder)[0]
    (first / "number").unlink()
    monkeypatch.setenv("FAKE_PLAN", "nothing")
    monkeypatch.setattr(slurm, "LOOKS", 1)
    assert front("shield", *SUBMIT) == 1
    assert os.system(f"cd '{first}' && SLURM_ARRAY_TASK_ID=0 sh job.sh >/dev/null") != 0 and (first / "0.yaml").exists() and tries(folder) == {}


def test_another_case_has_run_before(folder, fake):
    """a job takes the place of what was there when it was submitted"""
    assert front("shield", "--ranks", "3") == UNDECIDED
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", "speed_km_s: 7"))
    assert front("shield", *SUBMIT) == UNDECIDED
    assert all(yaml.safe_load(path.read_text())["variables"]["v0"] == 7000 for path in folder.glob("runs/emi/*/job.yaml"))


def test_one_call_submits_at_a_time(folder, fake, monkeypatch):
    """a batch that is not in the queue yet must not look like one that is over"""
    usual, free = slurm.said, []

    def said(words):
        if "--version" not in words and words[0] == "sbatch":
            with open(folder / "runs/.slurm/lock") as lock:
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    free.append(True)
                except BlockingIOError:
                    free.append(False)
        return usual(words)

    monkeypatch.setattr(slurm, "said", said)
    assert front("shield", *SUBMIT) == UNDECIDED and free == [False]
    with open(folder / "runs/.slurm/lock") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # it is left


@pytest.mark.parametrize("answered, age, left", [(False, 60, 1), (False, 7200, 0), (True, 60, 0)])
def test_batch_without_an_answer(folder, fake, monkeypatch, answered, age, left):
    """of a sbatch that timed out: jobs may turn up in the queue for an hour"""
    monkeypatch.setenv("FAKE_REFUSE", "Socket timed out")
    assert front("shield", *SUBMIT) == 1
    monkeypatch.delenv("FAKE_REFUSE")
    batch = folder / "runs/.slurm" / batches(folder)[0]
    if answered:
        (batch / "number").write_text("1")
    os.utime(batch, (time.time() - age,) * 2)
    assert front("shield", *SUBMIT) == UNDECIDED and batches(folder) == [batch.name] * left


def test_the_controller_is_away_in_a_search(folder, fake, capsys, monkeypatch):
    """what it could not take is submitted at a later look"""
    begin, begins = slurm.Slurm.begin, []

    def second_is_away(self, jobs, say):
        begins.append(len(jobs))
        if len(begins) == 2:
            (fake / "busy").write_text("")
        begin(self, jobs, say)

    monkeypatch.setattr(slurm.Slurm, "begin", second_is_away)
    assert front("limit", "--on", "D", "--from", "3", "--to", "6", "--step", "1", *SUBMIT) == 0
    out = capsys.readouterr().out
    assert out.count("sbatch: Batch job submission failed: Unable to contact slurm controller") == 1 and out.count("; trying again each 0.01 s\n") == 1 and len(begins) > 2
    assert out.count("  ok  ") == sum(begins) == sum(tries(folder).values()) and batches(folder) == []


def test_refused_again_and_again(folder, fake, capsys, monkeypatch):
    """said once of each program, and one folder for all tries"""
    send, sends = slurm.Slurm.send, []

    def four_are_away(self, say):
        sends.append(len(batches(folder)))
        if 2 <= len(sends) <= 5:
            (fake / ("busy" if len(sends) < 5 else "away")).write_text("")
        send(self, say)

    monkeypatch.setattr(slurm.Slurm, "send", four_are_away)
    assert front("shield", *SUBMIT, "--jobs", "1") == UNDECIDED
    out = capsys.readouterr().out
    assert [out.count(f"\n{program}: ") for program in ("sbatch", "squeue")] == [1, 1] and out.count("trying again") == 2 and sends == [0, 0, 1, 1, 1, 1] and len(calls(fake)) == 2 and batches(folder) == []


def test_two_calls_for_the_same_state_are_refused(folder, fake, monkeypatch):
    """the one whose jobs Slurm takes has the run, though the other one has claimed it since"""
    send, sends = slurm.Slurm.send, []

    def another_claims(self, say):
        sends.append(batches(folder))
        if len(sends) == 2:
            (fake / "busy").write_text("")
        if len(sends) == 3:
            shutil.copytree(folder / "runs/.slurm" / sends[2][0], folder / "runs/.slurm/hvi-emi-other")
            self.unsent[0].claim("hvi-emi-other")
        send(self, say)

    monkeypatch.setattr(slurm.Slurm, "send", another_claims)
    assert front("shield", *SUBMIT, "--jobs", "1") == UNDECIDED
    assert len(sends) == 3 and len(calls(fake)) == 2 and list(tries(folder).values()) == [1, 1] and "hvi-emi-other" not in claims(folder).values()


EDITED = CASE.replace("speed_km_s: 7.1", "speed_km_s: 7")


def speeds(folder):
    """v0 of what has been run last in each folder"""
    return {path.parent.name: yaml.safe_load(path.read_text())["variables"]["v0"] for path in folder.glob("runs/**/job.yaml")}


@pytest.mark.parametrize("hour", [-1, 3600])
def test_later_call_while_one_is_refused(folder, fake, capsys, monkeypatch, hour):
    """what it has run stays, however long the refusal has taken; the same folder of a batch is for all tries"""
    monkeypatch.setattr(slurm, "HOUR", hour)
    send, sends = slurm.Slurm.send, []

    def refused_until_a_later_call(self, say):
        sends.append(batches(folder))
        if len(sends) in (2, 3):
            (fake / "busy").write_text("")
        if len(sends) == 4:
            (folder / "emi.yaml").write_text(EDITED)
            assert front("shield", "--ranks", "3") == UNDECIDED
        send(self, say)

    monkeypatch.setattr(slurm.Slurm, "send", refused_until_a_later_call)
    assert front("shield", *SUBMIT, "--jobs", "1") == 1
    assert capsys.readouterr().out.count(": a later call has asked for this run; its files are left as they are: call again to run this case") == 1
    assert len(sends) == 4 and sends[2] == sends[3] != [] and len(calls(fake)) == 1
    assert list(speeds(folder).values()) == [7000] * 2 and len([*folder.glob("runs/emi/*/result.yaml")]) == 2


@pytest.mark.parametrize("engine_of", [runs.Local, slurm.Slurm])
@pytest.mark.parametrize("words", [("shield",), ("limit", "--on", "D", "--from", "3", "--to", "6", "--step", "1")])
def test_later_call_before_a_run_is_begun(folder, fake, capsys, monkeypatch, engine_of, words):
    """a call that comes to a run after one that began later has run it leaves it alone; a search does so, too, which did not know before which runs it wants"""
    begin, left = engine_of.begin, []

    def second_is_late(self, jobs, say):
        if not left and tries(folder):
            (folder / "emi.yaml").write_text(EDITED)
            left.append(0)
            assert front(*words, "--ranks", "3") in (0, UNDECIDED)
            left.append(speeds(folder))
        begin(self, jobs, say)

    monkeypatch.setattr(engine_of, "begin", second_is_late)
    assert front(*words, *(SUBMIT if engine_of is slurm.Slurm else ("--ranks", "3")), "--jobs", "1") == 1
    assert ": a later call has asked for this run; its files are left as they are" in capsys.readouterr().out
    assert {name: speed for name, speed in speeds(folder).items() if speed == 7000} == left[1]


def test_which_call_counts(folder):
    """of calls for another state the one that began last; calls for the same state share it, and the later one is not forgotten"""
    (folder / "in.main").write_text("variable v index 1\n")

    def job(began, v):
        made = engine.Job(engine.Input(folder / "in.main"), "a", {"v": v}, folder / "a")
        made.began = began
        return made

    first, second, same = job(1, 1), job(2, 2), job(1, 2)
    assert not first.is_of_later_call() and first.last_claim() == (0, "", "")
    first.claim("hvi-1")
    assert not second.is_of_later_call() and first.last_claim() == (1, first.key(), "hvi-1")
    second.claim()
    assert first.is_of_later_call() and not second.is_of_later_call() and not same.is_of_later_call()
    same.claim("hvi-3")
    assert first.is_of_later_call() and first.last_claim() == (2, second.key(), "hvi-3")


def test_claim_is_never_half_written(folder):
    """a job that reads it at that moment would leave its run; the file, which is locked while a process is at the run, stays"""
    (folder / "in.main").write_text("")
    job = engine.Job(engine.Input(folder / "in.main"), "a", {}, folder / "a")
    job.claim("hvi-emi-0")
    os.utime(job.lock_file, (0, 0))
    before, over, found = os.stat(job.lock_file), threading.Event(), set()
    job.claim("hvi-emi-0")
    assert os.stat(job.lock_file).st_mtime_ns == 0  # nothing new, nothing written

    def read():
        while not over.is_set():
            found.add(job.last_claim().batch)

    reader = threading.Thread(target=read)
    reader.start()
    for k in range(2000):
        job.claim(f"hvi-emi-{k % 2}")
    over.set()
    reader.join()
    assert found <= {"hvi-emi-0", "hvi-emi-1"} and os.stat(job.lock_file).st_ino == before.st_ino


def test_refused_for_good(folder, fake, capsys, monkeypatch):
    """after a while a call ends with Slurm's own words; the next call goes on"""
    monkeypatch.setattr(slurm, "PATIENCE", 0.3)
    ended = slurm.Slurm.ended

    def then_no_more(self, jobs, say):
        monkeypatch.setenv("FAKE_REFUSE", "QOSMaxSubmitJobPerUserLimit")
        return ended(self, jobs, say)

    with monkeypatch.context() as only:
        only.setattr(slurm.Slurm, "ended", then_no_more)
        assert front("shield", *SUBMIT, "--jobs", "1") == 1
    out, err = capsys.readouterr()
    problem = "sbatch: QOSMaxSubmitJobPerUserLimit; Batch job submission failed: so it is (sbatch --ntasks=3)"
    assert out.count(f"{problem}; trying again each 0.01 s\n") == 1 and out.count("  ok  ") == 1
    assert f"hvi: {problem}; no success for 0 s: put that right and call again to go on; what is done is kept, and what is in the queue runs on\n" in err
    monkeypatch.delenv("FAKE_REFUSE")
    assert front("shield", *SUBMIT) == UNDECIDED and len(calls(fake)) == 2


def test_time_that_counts(monkeypatch):
    """not that while its own jobs are in the queue, with which a limit on their number may end"""
    now, said = [0.0], []
    monkeypatch.setattr(slurm.time, "monotonic", lambda: now[0])
    place = slurm.Slurm.__new__(slurm.Slurm)
    place.problems, place.pause = {}, 10
    for now[0], counts in ((0.0, False), (1e6, False), (1e6 + slurm.PATIENCE, True), (2e6, False), (2e6 + slurm.PATIENCE, True)):
        place.refused("trying", "sbatch: no", said.append, counts)
    assert said == ["sbatch: no; trying again each 10 s"]
    now[0] += 1
    with pytest.raises(slurm.Refused, match="^sbatch: no; no success for 4.0 h: put that right and call again to go on"):
        place.refused("trying", "sbatch: no", said.append, True)


def test_lines_of_runs_that_are_over(folder, waiting, capsys, monkeypatch):
    """are printed though another one, found in the same look, cannot be submitted again"""
    monkeypatch.setenv("FAKE_START", "yes")
    monkeypatch.setenv("FAKE_REFUSE", "no more")
    monkeypatch.setattr(slurm, "LOOKS", 1)
    usual = slurm.Slurm.has_left_record
    monkeypatch.setattr(slurm.Slurm, "has_left_record", lambda self, job, state: job.name != "dx-0.4_shift-0.0" and usual(self, job, state))
    monkeypatch.setattr(slurm, "CUT_OFF", {"COMPLETED"})
    monkeypatch.setattr(engine.Job, "has_saved_more", lambda job: True)
    assert front("shield", *SUBMIT) == 1
    out, err = capsys.readouterr()
    assert "dx-0.4_shift-0.0: its job was cut off (COMPLETED) and had saved more: submitted again\n" in out and "dx-0.4_shift-0.5  ok  " in out and "hvi: sbatch: no more; " in err


@pytest.mark.parametrize("command, kept", [("kill -TERM $$", True), ("exit 143", True), ("kill -KILL $$", True), ("exit 137", True), ("exit 1", False)])
def test_what_a_run_went_on_from(folder, command, kept):
    """stays where the run was killed before it came farther, by Slurm, a lack of memory or by hand: that says nothing against the file"""
    (folder / "in.main").write_text("")
    (folder / "a").mkdir()
    job = engine.Job(engine.Input(folder / "in.main"), "a", {}, folder / "a", restart="x.restart.*")
    engine.write_yaml(folder / "a/job.yaml", job.record)
    (folder / "a/x.restart.1").write_bytes(engine.END)
    wait_for(lambda: job.ended(lambda job: ["sh", "-c", command], None))
    assert job.problem and job.resumed and bool(job.restart_files()) == kept


def test_a_job_that_starts_again(folder, fake, monkeypatch):
    """Slurm puts it back into the queue: its failure before counts no more"""
    monkeypatch.setenv("FAKE_FAIL", "dx-0.4_shift-0.0")
    assert front("shield", *SUBMIT) == 1
    (batch,) = (folder / "runs/.slurm").glob("hvi-*")
    local, jobs = pickle.loads((batch / "runs.pickle").read_bytes())
    (index,) = [k for k, job in enumerate(jobs) if job.name == "dx-0.4_shift-0.0"]
    assert (batch / f"{index}.yaml").exists() and isinstance(local, runs.Local) and local.ranks == 3
    monkeypatch.delenv("FAKE_FAIL")
    monkeypatch.setenv("SLURM_ARRAY_TASK_ID", str(index))
    assert os.system(f"cd '{batch}' && sh job.sh >/dev/null") == 0
    assert not (batch / f"{index}.yaml").exists() and jobs[index].result() and engine.LAST in jobs[index].result()


# ---------------------------------------------------------------------- what is refused
def test_refused(folder, fake, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_REFUSE", "invalid partition specified: none")
    assert front("shield", *SUBMIT, "--partition", "none") == 1
    assert "hvi: sbatch: invalid partition specified: none; Batch job submission failed: so it is (sbatch --ntasks=3 --partition=none)\n" in capsys.readouterr().err
    (batch,) = batches(folder)
    assert calls(fake) == []
    monkeypatch.delenv("FAKE_REFUSE")
    assert front("shield", *SUBMIT) == UNDECIDED and batches(folder) == [batch]  # its jobs may be in the queue all the same


@pytest.mark.parametrize("words, says", [
    (("--nodes", "2"), "--nodes is for --engine slurm"), (("--time", "5"), "--time is for --engine slurm"), ((*SUBMIT, "--nodes", "4"), "--nodes 4: a run of 3 ranks has no use for so many"),
    ((*SUBMIT, "--sbatch", "long"), "--sbatch long: options of sbatch, such as"), ((*SUBMIT, "--sbatch='x"), "--sbatch 'x: No closing quotation"),
    ((*SUBMIT, "--sbatch=--mem=4G --wait"), "--sbatch='--mem=4G --wait': leave out --wait: hvi itself waits for its jobs"), ((*SUBMIT, "--sbatch", "-W"), "--sbatch=-W: leave out -W: ")])
def test_wrong_options(folder, fake, capsys, words, says):
    assert front("shield", *words) == 1 and says in capsys.readouterr().err and calls(fake) == []


def test_value_that_looks_like_an_option():
    """one word after --sbatch is its value"""
    assert cli.parse(["shield", "x", "--sbatch", "--mem=4G", "--ranks", "3"]).sbatch == "--mem=4G"
    assert cli.parse(["shield", "x", "--sbatch=--mem=4G", "--time", "5"]).sbatch == "--mem=4G"


def test_defaults_of_the_user(monkeypatch):
    """which would hide jobs, or make sbatch wait; those of how to submit stay"""
    for name in ("SQUEUE_USERS", "SQUEUE_STATES", "SBATCH_WAIT", "SBATCH_QOS"):
        monkeypatch.setenv(name, "x")
    assert sorted(line for line in slurm.said(["env"]).splitlines() if line.startswith(("SQUEUE_", "SBATCH_"))) == ["SBATCH_QOS=x"]


def test_no_slurm(folder, capsys, monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    assert front("shield", *SUBMIT) == 1
    assert capsys.readouterr().err.endswith("hvi: sbatch is not there: --engine slurm is for a machine that can submit jobs to Slurm; --engine local runs here\n")


def test_dry_run(folder, fake, capsys, monkeypatch):
    """what would be submitted, and what each job runs; memory of this machine is no matter"""
    assert front("limit", "--on", "D", *SUBMIT, "--dry-run") == 0
    out = capsys.readouterr().out
    assert "sbatch --ntasks=3 --parsable --job-name=hvi --array=0-3 " in out and out.count("/mpirun -n 3 ") == 4 and calls(fake) == []
    monkeypatch.setattr("hvi.jobs.machine.free_memory", lambda: 1)
    assert front("shield", "--dry-run") == 1 and "MB of memory" in capsys.readouterr().err
    assert front("shield", *SUBMIT, "--dry-run") == 0 and "2 at a time on 3 ranks each" in capsys.readouterr().out


@pytest.mark.parametrize("words", [("shield",), ("limit", "--on", "D")])
def test_dry_run_asks_slurm(folder, fake, capsys, monkeypatch, words):
    """whether it would take these options, where there is Slurm; without it the options are looked at all the same"""
    number = {"shield": 1, "limit": 3}[words[0]]
    assert front(*words, *SUBMIT, "--partition", "p1", "--dry-run") == 0
    assert f"Slurm would take it (sbatch --test-only): sbatch --ntasks=3 --partition=p1 --array=0-{number}\n" in capsys.readouterr().out
    monkeypatch.setenv("FAKE_REFUSE", "invalid partition specified: none")
    assert front(*words, *SUBMIT, "--partition", "none", "--dry-run") == 1
    assert f"hvi: sbatch: invalid partition specified: none; Batch job submission failed: so it is (sbatch --ntasks=3 --partition=none --array=0-{number})\n" in capsys.readouterr().err
    monkeypatch.setenv("PATH", "/nowhere")
    assert front(*words, *SUBMIT, "--dry-run") == 0
    assert "not checked by Slurm: sbatch is not there: --engine slurm is for a machine that can submit jobs to Slurm; --engine local runs here\n" in capsys.readouterr().out
    assert front(*words, *SUBMIT, "--nodes", "4", "--dry-run") == 1 and "--nodes 4: a run of 3 ranks" in capsys.readouterr().err
    assert front(*words, "--nodes", "2", "--dry-run") == 1 and "--nodes is for --engine slurm" in capsys.readouterr().err
