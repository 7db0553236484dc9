"""python3 -m hvi shield, killed without notice at any moment: the next call goes on, and ends with the same bits as a run that was not disturbed."""

import contextlib
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest
import yaml
from hvi.jobs import engine
from hvi.shield import chain
from shield_runs import read, wall

pytestmark = pytest.mark.filterwarnings("ignore::hvi.errors.HVIWarning")  # of few layers
CLOCK = "wall_s", "core_s", "particle_steps_per_s"
LEGS = 5
CASES = {
    "particles": ((wall(0.8, radius=7), wall(0.8, gap=12, radius=9)), dict(quarter="no", dx=0.6, tstop=6, film=1)),
    "hybrid": ((wall(0.8, radius=10, core_mm=4, hold_mm=8), wall(0.8, gap=6, radius=12)), dict(method="hybrid", dx=0.4, tstop=4, film=1, edge="absorb", rim=1)),
}
# hvi shield with a restart file each so many particle-steps, in a process of its own
SCRIPT = "import sys; from hvi import cli; from hvi.shield import chain; chain.LEG = float(sys.argv.pop(1)); raise SystemExit(cli.main())"


def at_work(folder):
    """PIDs of processes in a folder: mpirun, and ranks"""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cwd"):
        with contextlib.suppress(OSError):
            if pathlib.Path(os.readlink(path)) == folder:
                found.append(int(path.parent.name))
    return found


class Shield:
    """The run of a case in a folder, by calls of the front door"""

    def __init__(self, folder, name, lmp_exe, root):
        walls, words = CASES[name]
        self.at, self.folder = folder, folder / f"runs/{name}/dx-{words['dx']}_shift-0.0"
        made = chain.shield_of(read(folder / f"{name}.yaml", *walls, **words), 0, 0)
        leg = made.particles() * made.steps() / LEGS
        self.words = [sys.executable, "-c", SCRIPT, repr(leg), "shield", f"{name}.yaml"]
        self.environment = {**os.environ, "PYTHONPATH": str(root / "python"), "HVI_LMP": str(lmp_exe)}

    def begin(self, nranks):
        return subprocess.Popen([*self.words, "--ranks", str(nranks)], cwd=self.at, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def call(self, nranks=1):
        """(exit status, what it has printed)"""
        process = self.begin(nranks)
        said, _ = process.communicate(timeout=200)
        return process.returncode, said

    def killed(self, moment, nranks=1, ranks_too=True):
        """the front door, and mpirun with its ranks, get SIGKILL once moment() is true"""
        process = self.begin(nranks)
        end = time.monotonic() + 100
        while not moment():
            assert process.poll() is None and time.monotonic() < end, process.communicate()[0]
            time.sleep(0.001)
        process.kill()
        while ranks_too and (found := at_work(self.folder)):
            for pid in found:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            time.sleep(0.005)
        process.stdout.close()
        process.wait()
        assert not (self.folder / "result.yaml").exists()

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

    def result(self):
        found = yaml.safe_load((self.folder / "result.yaml").read_text())
        return {key: value for key, value in found.items() if key not in CLOCK}

    def dumps(self):
        return {path.name: path.read_bytes() for path in self.folder.glob("*.dump")}


@pytest.fixture
def shield(tmp_path, lmp_exe, root):
    return lambda name="particles", folder=tmp_path: Shield(folder, name, lmp_exe, root)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, lmp_exe, root):
    """undisturbed(name, nranks): the Shield of a run that nobody killed"""
    known = {}

    def run(name, nranks=1):
        if (name, nranks) not in known:
            known[name, nranks] = made = Shield(tmp_path_factory.mktemp("whole"), name, lmp_exe, root)
            status, said = made.call(nranks)
            assert status == 4 and len(list(made.folder.glob("log.*.lammps"))) == LEGS, said
        return known[name, nranks]

    return run


def same(one, two):
    assert repr(one.result()) == repr(two.result())  # nan is nan
    assert one.dumps() == two.dumps() and len(one.dumps()) > 4
    assert not [path.name for path in (*one.folder.glob("*restart*"), *one.folder.glob("chain*"))]  # nothing is left over


@pytest.mark.parametrize("name, nranks", [("particles", 1), ("particles", 2), ("hybrid", 1), pytest.param("hybrid", 2, marks=pytest.mark.long)])
def test_same_bits(shield, undisturbed, name, nranks):
    """killed in each leg: while it runs, when a restart file appears with its first byte, when the record of the chain has just been replaced"""
    run = shield(name)
    restart = run.folder / "shield.restart.a", run.folder / "shield.restart.b"
    for moment in (lambda: run.steps() > 0, restart[0].exists, lambda: run.chain()["leg"] >= 1, restart[1].exists, run.is_in_leg(2), lambda: run.chain()["leg"] >= 3):
        run.killed(moment, nranks)
    status, said = run.call(nranks)
    assert status == 4, said
    same(run, undisturbed(name, nranks))


def test_half_a_file_beside(shield, undisturbed):
    """that was being written when the run was killed: it is the other one"""
    run = shield()
    run.killed(run.is_in_leg(1))
    named, other = run.files()
    data = named.read_bytes()
    other.write_bytes(data[:len(data) // 2])
    (run.folder / "chain.yaml.new").write_text("{leg: 2, fi")
    assert run.call()[0] == 4
    same(run, undisturbed("particles"))


@pytest.mark.parametrize("leg", [1, 2])
@pytest.mark.parametrize("spoil", [lambda data: data[:len(data) // 2], lambda data: data[:9999] + bytes([data[9999] ^ 1]) + data[10000:]])
def test_damaged_file(shield, undisturbed, leg, spoil):
    """the one that is gone on from: the run goes on from the one before, after the first leg it begins anew, and says so"""
    run = shield()
    run.killed(run.is_in_leg(leg))
    named, before = run.files()
    before = before.name if leg > 1 else "its beginning"
    named.write_bytes(spoil(named.read_bytes()))
    status, said = run.call()
    assert status == 4 and f"{named} is gone or damaged: the run goes on from {before}" in " ".join(said.split()), said
    same(run, undisturbed("particles"))


def test_a_leg_that_ends_alone(shield, undisturbed):
    """the front door is killed, LAMMPS is not: what it has done by the next call counts"""
    run = shield()
    run.killed(run.is_in_leg(2), ranks_too=False)
    leg, end = run.chain()["leg"], time.monotonic() + 60
    while at_work(run.folder):
        assert time.monotonic() < end
        time.sleep(0.02)
    log = run.folder / f"log.{leg + 1}.lammps"
    when = log.stat().st_mtime_ns
    assert run.chain()["leg"] == leg and "Total wall time" in log.read_text()
    assert run.call()[0] == 4 and log.stat().st_mtime_ns == when and len(list(run.folder.glob("log.*.lammps"))) == LEGS
    same(run, undisturbed("particles"))


def test_on_other_ranks(shield, undisturbed):
    """the same verdict, closed balances: forces differ in their last digits, and fracture shows that"""
    run, whole = shield(), undisturbed("particles").result()
    run.killed(run.is_in_leg(2))
    assert run.call(2)[0] == 4
    r = run.result()
    assert r["ranks"] == 2 and whole["ranks"] == 1 and (r["verdict"], r["rules"]) == (whole["verdict"], whole["rules"])
    for key in ("hole1_diameter_mm", "wall1_passed_mass_mg", "wall1_energy_ratio", "wall2_momentum_ratio"):
        assert r[key] == pytest.approx(whole[key], rel=0.1), key
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-10 and abs(r["mass_error"]) < 1e-10
