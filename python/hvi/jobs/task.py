# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A run in its Slurm job:  python3 -m hvi.jobs.task INDEX, in the folder of a batch, which hvi/jobs/slurm.py describes."""

import pathlib
import pickle
import sys

from ..errors import HVIError
from . import engine, runs


def main(index):
    """exit status: 0 the run has its result, 1 it has failed and INDEX.yaml says why, 130 it was stopped and says nothing"""
    local, jobs = pickle.loads(pathlib.Path("runs.pickle").read_bytes())  # of the same user, by the same version, as job.sh is
    job, left = jobs[index], pathlib.Path(f"{index}.yaml").resolve()
    left.unlink(missing_ok=True)  # where Slurm starts a job again
    job.start = None  # of the clock where it was submitted
    runs.as_interrupts()
    try:
        runs.run(local, 1, [job], job.name)
    except HVIError as problem:
        job.problem, job.advice = str(problem), ""
    except KeyboardInterrupt:
        return 130
    if job.problem:
        engine.write_yaml(left, {"problem": job.problem, "advice": job.advice})
    return 1 if job.problem else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
