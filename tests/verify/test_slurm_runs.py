"""hvi ... --engine slurm with a real Slurm on this machine (tests/lib/slurm_cluster.py) and LAMMPS: time limits, drained nodes, calls that are killed, failures, a
controller that is away. Each ends with the records of runs without Slurm. `-s` prints what happens, with times.

A run is held where a test wants it: MPIRUN waits as long as there is a file hold.NAME whose pattern is in its folder and words. Slurm's time limits are
whole minutes, and looked at every half minute.
"""

import re
import shlex
import signal
import subprocess
import sys
import time

import pytest
import yaml
from kill_runs import CLOCK, SCRIPT
from shield_runs import mapping, wall
from slurm_cluster import PROGRAMS, SECONDS, Cluster, lacks

from hvi.shield import case as cases
from hvi.shield import chain

MPIRUN = """#!/bin/sh
for file in '{folder}'/hold.*; do
  [ -e "$file" ] || continue
  pattern=$(cat "$file")
  case "$PWD $*" in *$pattern*) while [ -e "$file" ]; do sleep 0.2; done;; esac
done
exec {mpirun} "$@"
"""
LEGS = 3  # of a run
# some hundred bonded particles; its result.yaml as in the examples
TINY = """variable speed index 1.0
atom_style bond
lattice sc 1.0
region box block 0 5 0 5 0 5
create_box 1 box bond/types 1 extra/bond/per/atom 6
create_atoms 1 box
mass * 1.0
pair_style hvi/contact
pair_coeff * * 0.1 0.890898718
velocity all create ${speed} 4711
fix move all nve
run 10
print 'particles: $(atoms:%.0f)' file result.yaml
print 'energy: $(ke:%.15g)' append result.yaml
print 'package_version: 0.1.0' append result.yaml
"""


def test_what_is_missing_is_named(monkeypatch):
    """the tests below are skipped where Slurm is not installed, and say which programs they want"""
    monkeypatch.setenv("PATH", "/nowhere")
    assert [name for name in PROGRAMS if name in ("sbatch", "squeue")] == [name for name in lacks() if name in ("sbatch", "squeue")]


@pytest.fixture(scope="module")
def cluster():
    if missing := lacks():
        pytest.skip(f"{', '.join(missing)} not found: apt-get install slurm-wlm munge")
    with Cluster(nodes=2, cpus=2) as found:
        yield found


class Call:
    """A call of the front door in a process of its own; what it prints is in a file"""

    count = 0

    def __init__(self, scene, *words):
        Call.count += 1
        scene.calls.append(self)
        self.path, self.begun = scene.folder / f"call{Call.count}.txt", time.monotonic()
        self.words, self.cluster = words, scene.cluster
        with open(self.path, "w") as out:
            self.process = subprocess.Popen([sys.executable, "-c", SCRIPT, repr(scene.leg), *map(str, words)], cwd=scene.folder, env=scene.environment, stdin=subprocess.DEVNULL,
                                            stdout=out, stderr=subprocess.STDOUT)

    @property
    def said(self):
        return self.path.read_text()

    def sees(self, text):
        """waits until it has printed that"""
        self.cluster.wait_for(lambda: text in self.said or self.process.poll() is not None, f"'{text}' in\n{self.said}")
        assert text in self.said, self.said
        print(f"{time.monotonic() - self.begun:6.1f} s: {text}")

    def ends(self, status):
        try:
            found = self.process.wait(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.process.kill()
            pytest.fail(f"no end: {self.cluster.queue()} {self.said}")
        print(f"{time.monotonic() - self.begun:6.1f} s: exit status {found} of hvi {shlex.join(map(str, self.words))}:\n" + "".join(f"    | {line}\n" for line in self.said.splitlines()))
        assert found == status, self.said
        return self.said


class Scene:
    """A folder with cases, and the calls there"""

    def __init__(self, cluster, folder, lmp_exe, root):
        self.cluster, self.folder, self.calls = cluster, folder, []
        self.environment = {**cluster.environment, "PYTHONPATH": str(root / "python"), "PYTHONUNBUFFERED": "1", "HVI_LMP": str(lmp_exe)}
        mpirun = folder / "mpirun"
        mpirun.write_text(MPIRUN.format(folder=folder, mpirun="mpirun"))
        mpirun.chmod(0o755)
        self.leg = 4e8

    def case(self, *shifts, **words):
        """plate.yaml: a sphere on a plate, some hundred particles, three calls of LAMMPS for each shift"""
        text = {**mapping(wall(2, radius=8), dx=0.8, **{"tstop": 4, **words}), "shifts": list(shifts)}
        path = self.folder / "plate.yaml"
        path.write_text(yaml.safe_dump(text))
        made = chain.shield_of(cases.read(path), 0, shifts[0])
        self.leg = (made.particles() + made.nodes()) * made.steps() / LEGS

    def hold(self, name, pattern):
        (self.folder / f"hold.{name}").write_text(pattern)

    def release(self, name):
        (self.folder / f"hold.{name}").unlink()

    def run(self, shift):
        return self.folder / f"runs/plate/dx-0.8_shift-{shift}"

    def call(self, *words, command=("shield", "plate.yaml"), ranks=1):
        return Call(self, *command, "--engine", "slurm", "--poll", "1", "--ranks", ranks, "--mpirun", "./mpirun", *words)

    def jobs(self):
        """[(array, index, state, node), ...] of this test: of jobs whose names are those of its batches, which are in its folder"""
        rows = self.cluster.said("squeue", "--noheader", "--array", "--states=all", "--format=%F %K %T %N %Z").splitlines()
        found = [tuple(row.split()[:4]) if len(row.split()) == 5 else (*row.split()[:3], "") for row in rows if str(self.folder) in row]
        return sorted(found, key=lambda job: (int(job[0]), job[1:]))

    def states(self):
        return sorted(state for _, _, state, _ in self.jobs())

    def arrays(self):
        return sorted({array for array, *_ in self.jobs()}, key=int)

    def same_as_local(self):
        """the same bits as runs without Slurm, but for times"""
        Call(self, "shield", "plate.yaml", "--runs", "local", "--ranks", "1").ends(self.status)
        paths = sorted((self.folder / "local/plate").glob("*/result.yaml"))
        for path in paths:
            mine, other = (yaml.safe_load(file.read_text()) for file in (self.folder / "runs/plate" / path.parent.name / path.name, path))
            assert repr({key: value for key, value in mine.items() if key not in CLOCK}) == repr({key: value for key, value in other.items() if key not in CLOCK})
            for dump in path.parent.glob("*.dump"):
                assert dump.read_bytes() == (self.folder / "runs/plate" / path.parent.name / dump.name).read_bytes()
        said = [yaml.safe_load((self.folder / runs / "plate/verdict.yaml").read_text()) for runs in ("runs", "local")]
        assert len({repr({key: value for key, value in one.items() if key not in ("command", "core_s", "next_finer")}) for one in said}) == 1  # which has times, too
        return len(paths)

    status = 4  # undecided: too few layers


@pytest.fixture
def scene(cluster, tmp_path, lmp_exe, root):
    found = Scene(cluster, tmp_path, lmp_exe, root)
    yield found
    for call in found.calls:  # of a test that has failed
        call.process.kill()
        call.process.wait()
    cluster.clear()


@pytest.mark.long
def test_time_limit(scene):
    """a run that has saved something is submitted again and ends, with the bits of one that was not stopped; one that has saved nothing fails, until it is called again"""
    scene.case(0, 0.5)
    scene.hold("first", "shift-0.0*in.continue")
    scene.hold("second", "shift-0.5*in.shield")
    call = scene.call("--time", "1")
    call.sees("Slurm: 2 RUNNING")
    call.sees("dx-0.8_shift-0.0: its job was cut off (TIMEOUT) and had saved more: submitted again")
    scene.release("first")
    said = call.ends(1)
    assert "dx-0.8_shift-0.0  ok" in said and "no verdict: 1 of 2 runs failed: dx-0.8_shift-0.5" in said
    assert "dx-0.8_shift-0.5  FAILED: its Slurm job ended (TIMEOUT) without a result; it has saved nothing new, another job would come no farther: take a longer --time" in said
    assert scene.states() == ["COMPLETED", "TIMEOUT", "TIMEOUT"]
    scene.release("second")
    assert "2 runs, 1 done before, 1 to run" in scene.call("--time", "1").ends(scene.status)
    assert scene.states() == ["COMPLETED", "COMPLETED", "TIMEOUT", "TIMEOUT"] and scene.same_as_local() == 2


@pytest.mark.long
def test_drained_nodes(scene):
    """jobs that wait stay in the queue, and run where a node comes back"""
    scene.case(0, 0.25, 0.5, 0.75)
    scene.hold("all", "in.shield")
    call = scene.call("--sbatch=--exclusive")  # a node each
    call.sees("2 RUNNING")
    scene.cluster.wait_for(lambda: scene.states() == ["PENDING", "PENDING", "RUNNING", "RUNNING"], "two that wait")
    assert scene.cluster.said("scontrol", "update", "nodename=n[0-1]", "state=drain", "reason=test") == ""
    scene.release("all")
    scene.cluster.wait_for(lambda: scene.states() == ["COMPLETED", "COMPLETED", "PENDING", "PENDING"], "two that are done")
    time.sleep(5)
    assert call.process.poll() is None and scene.states() == ["COMPLETED", "COMPLETED", "PENDING", "PENDING"] and set(scene.cluster.states().values()) == {"drained"}
    assert re.search(r"Slurm: 2 PENDING \(.*(Nodes|Node|Resources).*\)", call.said), call.said
    assert scene.cluster.said("scontrol", "update", "nodename=n0", "state=resume") == ""
    call.ends(scene.status)
    assert scene.states() == ["COMPLETED"] * 4 and sorted(node for *_, node in scene.jobs()) == ["n0", "n0", "n0", "n1"] and len(scene.arrays()) == 1
    assert scene.cluster.said("scontrol", "update", "nodename=n1", "state=resume") == ""


@pytest.mark.long
def test_front_door_killed(scene):
    """its jobs run on; the next call waits for those that are in the queue, and submits none of them again"""
    scene.case(0, 0.25, 0.5)
    scene.hold("first", "shift-0.0*in.continue")
    scene.hold("second", "shift-0.25*in.shield")
    call = scene.call()
    call.sees("Slurm: ")
    scene.cluster.wait_for(lambda: (scene.run(0.5) / "result.yaml").exists(), "first result")
    call.process.kill()
    call.ends(-signal.SIGKILL)
    scene.release("first")
    scene.cluster.wait_for(lambda: (scene.run(0.0) / "result.yaml").exists(), "second result")
    call = scene.call()
    call.sees("dx-0.8_shift-0.25: in the queue already, Slurm job")
    call.process.send_signal(signal.SIGINT)
    assert f"what is in Slurm's queue runs on: call again to go on, or scancel {scene.arrays()[0]}\n" in call.ends(130)
    scene.release("second")
    assert "1 to run" in scene.call().ends(scene.status)
    assert scene.states() == ["COMPLETED"] * 3 and len(scene.arrays()) == 1 and scene.same_as_local() == 3


@pytest.mark.long
def test_changed_while_queued(scene):
    """a call that finds a job of another form of its case names it; if that job starts after the case has run in its new form, it leaves the run as it is"""
    scene.case(0)
    assert scene.cluster.said("scontrol", "update", "nodename=n[0-1]", "state=drain", "reason=test") == ""
    call = scene.call()
    call.sees("Slurm: 1 PENDING")
    call.process.send_signal(signal.SIGINT)
    call.ends(130)
    scene.case(0, tstop=5)
    assert f"still in Slurm's queue for this folder: scancel {scene.arrays()[0]}, or another --runs DIR" in scene.call().ends(1)
    Call(scene, "shield", "plate.yaml", "--ranks", "1").ends(scene.status)
    before = {path.name: path.read_bytes() for path in scene.run(0.0).iterdir()}
    assert "result.yaml" in before and scene.states() == ["PENDING"]
    assert scene.cluster.said("scontrol", "update", "nodename=n[0-1]", "state=resume") == ""
    scene.cluster.wait_for(lambda: scene.states() == ["FAILED"], "job of the first form")
    assert {path.name: path.read_bytes() for path in scene.run(0.0).iterdir()} == before


@pytest.mark.long
def test_failures(scene):
    """each is submitted once, and says what LAMMPS or Slurm has said"""
    scene.case(0, solid="damage nonsense")
    said = scene.call().ends(1)
    assert "FAILED: exit status 1" in said and re.search(r"    \| ERROR: .*nonsense", said) and scene.states() == ["FAILED"]
    scene.case(0)
    scene.hold("all", "in.shield")
    call = scene.call()
    call.sees("1 RUNNING")
    scene.cluster.said("scancel", scene.arrays()[-1])
    assert "FAILED: its Slurm job ended (CANCELLED) without a result" in call.ends(1) and scene.states() == ["CANCELLED", "FAILED"]
    scene.release("all")
    assert "Slurm would take it (sbatch --test-only): sbatch --ntasks=1 --time=5 --array=0-0\n" in scene.call("--time", "5", "--dry-run").ends(0)
    assert "hvi: sbatch: invalid partition specified: none; allocation failure: Invalid partition name specified (sbatch " in scene.call("--partition", "none", "--dry-run").ends(1)
    said = scene.call("--partition", "none").ends(1)
    assert "hvi: sbatch: invalid partition specified: none; Batch job submission failed: Invalid partition name specified (sbatch --ntasks=1 --partition=none)" in said
    said = scene.call("--sbatch=--mem=1000T").ends(1)
    assert "hvi: sbatch: " in said and "Batch job submission failed" in said


@pytest.mark.long
def test_requeued(scene):
    """a job that Slurm starts again goes on from the restart file; a controller that is away for a while is waited for"""
    scene.case(0)
    scene.hold("all", "in.continue")
    call = scene.call()
    scene.cluster.wait_for(lambda: (scene.run(0.0) / "chain.yaml").exists(), "restart file")
    first = (scene.run(0.0) / "log.1.lammps").stat().st_mtime_ns
    assert scene.cluster.said("scontrol", "requeue", f"{scene.arrays()[0]}_0") == ""
    call.sees("Slurm: 1 PENDING (BeginTime)")
    scene.cluster.stop("slurmctld")
    call.sees("looking again each 1 s")
    scene.cluster.start_controller()
    scene.cluster.wait_for(lambda: scene.states() != [], "controller")
    scene.cluster.said("scontrol", "update", f"jobid={scene.arrays()[0]}_0", "StartTime=now")
    scene.cluster.wait_for(lambda: scene.states() == ["RUNNING"], "second start")
    scene.release("all")
    call.ends(scene.status)
    assert (scene.run(0.0) / "log.1.lammps").stat().st_mtime_ns == first and len(scene.arrays()) == 1 and scene.same_as_local() == 1


@pytest.mark.long
def test_searches_and_studies(scene):
    """a limit submits what it wants to know next; a sweep over two nodes; both as without Slurm"""
    scene.case(0, v=2, tstop=8)
    words = ("limit", "plate.yaml", "--on", "thickness1", "--from", "2.4", "--to", "8.8", "--step", "1.6")
    found = []
    for call in (scene.call(command=words), Call(scene, *words, "--runs", "local", "--ranks", "1")):
        call.process.wait(timeout=SECONDS)
        print(call.said)
        folder = scene.folder / ("local" if "local" in call.words else "runs")
        found.append((call.process.returncode, {key: value for key, value in yaml.safe_load((folder / "plate/limit-thickness1/limit.yaml").read_text()).items() if key != "core_s"}))
    assert found[0] == found[1] and len(scene.arrays()) == 3
    (scene.folder / "in.tiny").write_text(TINY)
    (scene.folder / "tiny.yaml").write_text("input: in.tiny\ngrid: {speed: [1.0, 2.0]}\n")
    scene.call("--nodes", "2", command=("sweep", "tiny.yaml"), ranks=2).ends(0)
    Call(scene, "sweep", "tiny.yaml", "--runs", "local", "--ranks", "2").ends(0)
    assert (scene.folder / "runs/tiny.csv").read_text() == (scene.folder / "local/tiny.csv").read_text()
    assert [node for *_, node in scene.jobs()][-2:] == ["n[0-1]"] * 2
    scene.environment["SLURM_MPI_TYPE"] = "pmix"
    scene.call("--nodes", "1", "--runs", "srun", "--mpirun", "srun", command=("sweep", "tiny.yaml"), ranks=2).ends(0)
    outputs = [*scene.folder.glob("runs/tiny/*/output.txt"), *scene.folder.glob("srun/tiny/*/output.txt")]
    assert len(outputs) == 4 and all("1 by 1 by 2 MPI processor grid" in path.read_text() for path in outputs)  # not two runs of one rank
