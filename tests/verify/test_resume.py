"""python3 -m hvi shield, killed without notice at any moment: the next call goes on, and ends with the same bits as a run that was not disturbed."""

import time

import pytest
from kill_runs import LEGS, Shield, at_work, same

pytestmark = pytest.mark.filterwarnings("ignore::hvi.errors.HVIWarning")  # of few layers


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


@pytest.mark.parametrize("name, nranks, often", [("particles", 2, False), *(pytest.param(name, nranks, True, marks=pytest.mark.long) for name in ("particles", "hybrid") for nranks in (1, 2))])
def test_same_bits(shield, undisturbed, name, nranks, often):
    """killed in each leg: while it runs, when a restart file appears with its first byte, when the record of the chain has just been replaced; in the short form once of each"""
    run = shield(name)
    restart = run.folder / "shield.restart.a", run.folder / "shield.restart.b"
    first = restart[0].exists, lambda: run.chain()["leg"] >= 1, run.is_in_leg(2)
    for moment in (lambda: run.steps() > 0, first[0], first[1], restart[1].exists, first[2], lambda: run.chain()["leg"] >= 3) if often else first:
        run.killed(moment, nranks)
    status, said = run.call(nranks)
    assert status == 4, said
    same(run, undisturbed(name, nranks))


@pytest.mark.long
def test_half_a_file_beside(shield, undisturbed):
    """that was being written when the run was killed: it is the other one"""
    run = shield()
    run.killed(run.is_in_leg(1))
    named, other = run.files()
    data = named.read_bytes()
    other.write_bytes(data[:len(data) // 2])
    (run.folder / "chain.yaml.0123abcd.new").write_text("{leg: 2, fi")
    assert run.call()[0] == 4
    same(run, undisturbed("particles"))


def cut(data):
    return data[:len(data) // 2]


def flip(data):
    return data[:9999] + bytes([data[9999] ^ 1]) + data[10000:]


@pytest.mark.parametrize("leg, spoil", [(1, cut), pytest.param(2, flip, marks=pytest.mark.long), pytest.param(1, flip, marks=pytest.mark.long), pytest.param(2, cut, marks=pytest.mark.long)])
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
