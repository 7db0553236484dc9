"""Stands in for sbatch and squeue, by the name that it is called with:  sbatch OPTIONS SCRIPT, squeue OPTIONS

Its state is in the folder FAKE_SLURM: calls (a line of JSON for each sbatch), queue (a line NAME|INDEX|JOB|STATE|REASON for each job, as squeue prints it).
FAKE_PLAN: words, of which each call of sbatch takes the next one, and later calls the last:

    run      every job runs to its end now: COMPLETED or FAILED
    stop     every job runs, and gets SIGTERM when its run has begun: TIMEOUT
    wait     jobs are PENDING; with FAKE_START squeue runs them after it has printed that
    STATE    jobs have never run, and ended so
    nothing  jobs are accepted, and forgotten

FAKE_REFUSE: message with which sbatch refuses, with --test-only too; a file "away" or "busy" in the folder: squeue or sbatch finds no controller, and removes the file. squeue
begins with a remark, as the wrappers of some sites do. FAKE_JOBS: socket of fake_jobs.py, which runs job.sh where that is the usual one.
"""

import json
import os
import pathlib
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).parent))
from fake_jobs import Job  # noqa: E402

HOME = pathlib.Path(os.environ["FAKE_SLURM"])
QUEUE, CALLS = HOME / "queue", HOME / "calls"


def text_of(path):
    return path.read_text() if path.exists() else ""


def elements(folder, indices, stop=False):
    """jobs of an array, all at a time; their states at the end"""
    tries = [pathlib.Path(line[4:]) / "tries" for line in (folder / "runs.yaml").read_text().splitlines() if line.startswith("- - ")]  # yaml takes longer to load than all of this
    usual = "FAKE_JOBS" in os.environ and (folder / "job.sh").read_text().endswith(f"\nexec {os.environ['FAKE_PYTHON']} -m hvi.jobs.task \"$SLURM_ARRAY_TASK_ID\"\n")
    before, processes = [text_of(path) for path in tries], []
    for index in indices:
        environment = {**os.environ, "SLURM_ARRAY_TASK_ID": str(index)}
        if usual:
            processes.append(Job(folder, index, environment))
            continue
        with open(folder / f"{index}.txt", "a") as out:
            processes.append(subprocess.Popen(["sh", "job.sh"], cwd=folder, env=environment, stdout=out, stderr=subprocess.STDOUT))
    for index, process in zip(indices, processes):
        until = time.monotonic() + 60
        while stop and text_of(tries[index]) == before[index] and time.monotonic() < until:
            time.sleep(0.02)
    if stop:
        time.sleep(0.2)  # they save
        for process in processes:
            process.terminate()
    return ["FAILED" if process.wait() and not stop else "TIMEOUT" if stop else "COMPLETED" for process in processes]


def sbatch(words):
    if "--version" in words:
        return
    if "FAKE_REFUSE" in os.environ:
        sys.exit(f"sbatch: error: {os.environ['FAKE_REFUSE']}\nsbatch: error: Batch job submission failed: so it is")
    if (HOME / "busy").exists():
        (HOME / "busy").unlink()
        sys.exit("sbatch: error: Batch job submission failed: Unable to contact slurm controller (connect failure)")
    if "--test-only" in words:
        return
    number = len(CALLS.read_text().splitlines()) if CALLS.exists() else 0
    with open(CALLS, "a") as out:
        out.write(json.dumps(words) + "\n")
    options = dict(word[2:].split("=", 1) for word in words if word.startswith("--") and "=" in word)
    plan = os.environ.get("FAKE_PLAN", "run").split()
    how, folder = plan[min(number, len(plan) - 1)], pathlib.Path(options["chdir"])
    indices = range(int(options["array"].split("-")[1]) + 1)
    states = elements(folder, indices, how == "stop") if how in ("run", "stop") else ["PENDING" if how == "wait" else how for _ in indices]
    with open(QUEUE, "a") as out:
        for index, state in enumerate(states if how != "nothing" else ()):
            out.write(f"{options['job-name']}|{index}|{number + 1}|{state}|{'Resources' if state == 'PENDING' else 'None'}\n")
    (HOME / f"{number + 1}").symlink_to(folder)
    print(f"{number + 1};fake")


def squeue(words):
    if "--version" in words:
        return
    if (HOME / "away").exists():
        (HOME / "away").unlink()
        sys.exit("slurm_load_jobs error: Unable to contact slurm controller (connect failure)")
    (names,) = (word.split("=")[1].split(",") for word in words if word.startswith("--name="))
    rows = [line.split("|") for line in text_of(QUEUE).splitlines()]
    print("squeue of this site | maintenance on Monday\n" + "".join("|".join(row) + "\n" for row in rows if row[0] in names), end="")
    if "FAKE_START" in os.environ:
        for number in sorted({row[2] for row in rows if row[3] == "PENDING"}):
            waiting = [row for row in rows if row[2:4] == [number, "PENDING"]]
            for row, state in zip(waiting, elements(HOME / number, [int(row[1]) for row in waiting])):
                row[3:] = state, "None"
        QUEUE.write_text("".join("|".join(row) + "\n" for row in rows))


if __name__ == "__main__":
    {"sbatch": sbatch, "squeue": squeue}[sys.argv[1]](sys.argv[2:])
