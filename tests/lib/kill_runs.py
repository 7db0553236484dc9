"""Runs that are killed without notice, and go on: shields by the front door, a debris cloud by its two inputs.

    python3 tests/lib/kill_runs.py [--kills 50] [--only particles debris ...] [--seed 4711] [--out DIR]

Each case is run once as it is, then with kills at random moments, of all processes or of one rank, some in each run; what is left at the end is compared.
Seed and moments are printed. tests/verify/test_kills.py is this with fewer kills.
"""

import argparse
import contextlib
import math
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

import yaml

if __name__ == "__main__":
    sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[2] / "python")]

from hvi.jobs import engine
from hvi.shield import chain
from shield_runs import read, wall

CLOCK = "wall_s", "core_s", "particle_steps_per_s"
LEGS = 5
CASES = {
    "particles": ((wall(0.8, radius=7), wall(0.8, gap=12, radius=9)), dict(quarter="no", dx=0.6, tstop=4, film=1)),
    "plate": ((wall(2, radius=8),), dict(dx=0.5, tstop=4, film=1)),
    "hybrid": ((wall(0.8, radius=10, core_mm=4, hold_mm=8), wall(0.8, gap=6, radius=12)), dict(method="hybrid", dx=0.4, tstop=4, film=1, edge="absorb", rim=1)),
}
# hvi shield with a restart file each so many particle-steps, in a process of its own
SCRIPT = "import sys; from hvi import cli; from hvi.shield import chain; chain.LEG = float(sys.argv.pop(1)); raise SystemExit(cli.main())"


def at_work(folder, name=""):
    """PIDs of processes in a folder: mpirun, and ranks; name: of one program only"""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cwd"):
        with contextlib.suppress(OSError):
            if pathlib.Path(os.readlink(path)) == folder and name in ("", (path.parent / "comm").read_text().strip()):
                found.append(int(path.parent.name))
    return found


def has_begun(pids):
    """one of these ranks has its log open, so all have passed MPI_Init: Open MPI may wait for ever for a rank that dies before"""
    for pid in pids:
        with contextlib.suppress(OSError):
            if any(re.search(r"/log[^/]*[.]lammps$", os.readlink(file)) for file in pathlib.Path(f"/proc/{pid}/fd").iterdir()):
                return True
    return False


def kill(pids):
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


class Killed:
    """A run in self.folder, by calls of begin(nranks)"""

    def call(self, nranks=1):
        """(exit status, what it has printed)"""
        process = self.begin(nranks)
        said, _ = process.communicate(timeout=1500)
        return process.returncode, said

    def killed(self, moment, nranks=1, ranks_too=True, may_be_over=False):
        """what was begun, and mpirun with its ranks, get SIGKILL once moment() is true, before the run is over"""
        process = self.begin(nranks)
        self.wait_for(moment, process)
        process.kill()
        while ranks_too and (found := at_work(self.folder)):
            kill(found)
            time.sleep(0.005)
        process.stdout.close()
        process.wait()
        assert may_be_over or not (self.folder / "result.yaml").exists()

    def rank_killed(self, moment, nranks=2):
        """one rank gets SIGKILL once moment() is true: the call ends by itself, with an exit status that says so"""
        process = self.begin(nranks)
        self.wait_for(moment, process)
        while not has_begun(ranks := at_work(self.folder, "lmp")) and process.poll() is None:
            time.sleep(0.001)
        kill(ranks[-1:])
        said, _ = process.communicate(timeout=1500)
        assert not at_work(self.folder), "ranks that nobody waits for"
        return process.returncode, said, bool(ranks)

    def wait_for(self, moment, process):
        end = time.monotonic() + 1500
        while True:
            looked = time.monotonic()
            if moment():
                return
            assert process.poll() is None and time.monotonic() < end, process.communicate()[0]
            time.sleep(max(0.001, 3 * (time.monotonic() - looked)))  # a look at files must not take a core from what is waited for


class Shield(Killed):
    """The run of a case in a folder, by calls of the front door"""

    UNDECIDED = 4  # exit status of all cases here: too few layers

    def __init__(self, folder, name, lmp_exe, root):
        walls, words = CASES[name]
        self.at, self.folder = folder, folder / f"runs/{name}/dx-{words['dx']}_shift-0.0"
        made = chain.shield_of(read(folder / f"{name}.yaml", *walls, **words), 0, 0)
        leg = (made.particles() + made.nodes()) * made.steps() / LEGS
        self.words = [sys.executable, "-c", SCRIPT, repr(leg), "shield", f"{name}.yaml"]
        self.environment = {**os.environ, "PYTHONPATH": str(root / "python"), "HVI_LMP": str(lmp_exe)}

    def begin(self, nranks):
        return subprocess.Popen([*self.words, "--ranks", str(nranks)], cwd=self.at, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def chain(self):
        return engine.read_yaml(self.folder / "chain.yaml") or {"leg": 0, "step": 0}

    def steps(self):
        """of the last row of walls.dat"""
        try:
            rows = [line.split() for line in (self.folder / "walls.dat").read_text().splitlines()]
        except OSError:
            return -1
        return max((int(row[0]) for row in rows if len(row) == 2 and row[0].isdigit()), default=-1)

    def is_in_leg(self, number):
        """beyond its first steps, or later"""
        return lambda: self.chain()["leg"] >= number and self.steps() > self.chain()["step"]

    def files(self):
        """the restart file that is gone on from, and the other one"""
        return sorted((self.folder / f"shield.restart.{letter}" for letter in "ab"), key=lambda path: path.name != self.chain()["file"])

    def is_good(self):
        """the file that the chain names is whole"""
        state = self.chain()
        return not state["leg"] or engine.checksum_of(self.folder / state["file"]) == state["checksum"]

    def result(self):
        found = yaml.safe_load((self.folder / "result.yaml").read_text())
        return {key: value for key, value in found.items() if key not in CLOCK}

    def dumps(self):
        return {path.name: path.read_bytes() for path in self.folder.glob("*.dump")}

    def compare(self, whole, nranks, whole_ranks):
        """the same bits on the same ranks, on others the same verdict and closed balances"""
        if nranks == whole_ranks:
            return same(self, whole)
        r, w = self.result(), whole.result()
        assert (r["verdict"], r["rules"]) == (w["verdict"], w["rules"])
        assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-10 and abs(r["mass_error"]) < 1e-10
        assert not [path.name for path in (*self.folder.glob("*restart*"), *self.folder.glob("chain*"))]
        times = sorted(int(path.name.split(".")[1]) for path in self.folder.glob("film.*.dump"))
        assert len(times) == len(list(whole.folder.glob("film.*.dump"))), times


class Debris(Killed):
    """examples/debris-cloud with some hundred particles: begun by in.debris, gone on with by in.debris.continue from the newer restart file that is whole"""

    VARIABLES = {"N": 600, "Rplate": 8, "tstop": 1.5, "keep": 100, "every": 10, "frames": 2}
    UNDECIDED = 0

    def __init__(self, folder, name, lmp_exe, root):
        self.folder, self.lmp, self.root = folder / "debris", lmp_exe, root
        self.folder.mkdir(parents=True)
        for path in (root / "examples/debris-cloud").glob("*debris*"):
            if path.name.startswith(("in.", "legs.")):
                shutil.copy(path, self.folder)

    def newest(self):
        files = sorted(filter(engine.is_whole, self.folder.glob("debris.restart.?")), key=lambda path: path.stat().st_mtime_ns)
        return files[-1] if files else None

    def begin(self, nranks):
        file = self.newest()
        words = ["-in", "in.debris.continue", "-var", "from", file.name] if file else ["-in", "in.debris"]
        for key, value in self.VARIABLES.items():
            words += ["-var", key, str(value)]
        return subprocess.Popen([self.root / "cmake/env.sh", "mpirun", "-np", str(nranks), self.lmp, *words], cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def steps(self):
        with contextlib.suppress(OSError):
            rows = [line.split() for line in (self.folder / "log.lammps").read_text(errors="replace").splitlines()]
            return max((int(row[0]) for row in rows if len(row) == 13 and row[0].isdigit()), default=-1)
        return -1

    def is_good(self):
        """one of two files is whole, once there was one"""
        there = list(self.folder.glob("debris.restart.?"))
        return len(there) < 2 or self.newest() is not None

    def compare(self, whole, nranks, whole_ranks):
        """the same cloud, closed balances"""
        r, w = (yaml.safe_load((run.folder / "result.yaml").read_text()) for run in (self, whole))
        assert all(r[key] == w[key] for key in ("particles", "plate_layers", "bonds_start", "spacing_mm"))
        for key, most in (("energy_ratio", 1e-4), ("bonds_left", 0.03), ("front_velocity_m_s", 0.03), ("energy_start_J", 1e-6)):
            assert math.isclose(r[key], w[key], rel_tol=most), (key, r[key], w[key])
        assert r["momentum_error"] < 1e-11 and abs(r["mass_error"]) < 1e-11


def same(one, two):
    assert repr(one.result()) == repr(two.result())  # nan is nan
    assert one.dumps() == two.dumps() and len(one.dumps()) > 4
    assert not [path.name for path in (*one.folder.glob("*restart*"), *one.folder.glob("chain*"))]  # nothing is left over


CLASSES = {**dict.fromkeys(CASES, Shield), "debris": Debris}


def round_of(name, folder, whole, lmp_exe, root, seed, kills, whole_ranks=2, say=lambda line: None):
    """A run with so many kills at moments that the seed says, then to its end, as whole, an undisturbed one; each kill leaves a whole file to go on from"""
    rng = random.Random(seed)
    run = CLASSES[name](folder, name, lmp_exe, root)
    last = whole.last
    steps = sorted(rng.randrange(-1, int(0.9 * last)) for _ in range(kills))
    for step in steps:
        delay, one, done = rng.uniform(0.0, 0.2), rng.random() < 0.5, run.steps()
        nranks = rng.choice((1, 2)) if whole_ranks == 0 else whole_ranks
        begun = time.monotonic()

        def moment():
            return run.steps() >= max(step, done if step >= 0 else -1) and time.monotonic() > begun + delay

        say(f"{name}: seed {seed}, {nranks} ranks, {'one rank' if one else 'all'} killed after step {step}, {delay:.3f} s")
        if one:
            status, said, there = run.rank_killed(moment, nranks)
            assert status != 0 or not there or (run.folder / "result.yaml").exists(), said
        else:
            run.killed(moment, nranks, may_be_over=True)
        if (run.folder / "result.yaml").exists():  # it was over, or between two calls
            break
        assert run.is_good(), f"no whole restart file: seed {seed}, step {step}"
    nranks = whole_ranks or rng.choice((1, 2))
    for _ in range(2):  # a call that was killed in the very first steps may have left nothing: the next one begins anew
        status, said = run.call(nranks)
        if status == run.UNDECIDED:
            break
    assert status == run.UNDECIDED, f"seed {seed}: {said}"
    run.compare(whole, nranks, whole_ranks)
    return len(steps)


def undisturbed(name, folder, lmp_exe, root, nranks):
    """a run that nobody kills, whose last step is known"""
    made = CLASSES[name](folder, name, lmp_exe, root)
    status, said = made.call(nranks)
    assert status == made.UNDECIDED, said
    made.last = made.steps()
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--kills", type=int, default=50, help="of each case")
    parser.add_argument("--only", nargs="*", choices=CLASSES, default=list(CLASSES))
    parser.add_argument("--seed", type=int, default=4711)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("kills"))
    parser.add_argument("--lmp", type=pathlib.Path, default=pathlib.Path("build/lmp"))
    args = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    for name in args.only:
        folder = args.out.resolve() / name
        shutil.rmtree(folder, ignore_errors=True)
        whole = undisturbed(name, folder / "whole", args.lmp.resolve(), root, 2)
        done, number = 0, 0
        while done < args.kills:
            done += round_of(name, folder / str(number), whole, args.lmp.resolve(), root, args.seed + number, min(10, args.kills - done), say=print)
            shutil.rmtree(folder / str(number))
            number += 1
        print(f"{name}: {done} kills in {number} runs, all ended as the one that was not killed")


if __name__ == "__main__":
    main()
