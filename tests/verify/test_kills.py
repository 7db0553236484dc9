"""Runs that are killed without notice at random moments, one rank of two or all, go on from a whole restart file, and end as those that nobody killed.

The seed of a round is its parameter; `python3 tests/lib/kill_runs.py` does the same by hand.
"""

import pytest
from kill_runs import CLASSES, round_of, undisturbed

pytestmark = pytest.mark.filterwarnings("ignore::hvi.errors.HVIWarning")  # of few layers
WHOLE = {}


@pytest.fixture
def whole(tmp_path_factory, lmp_exe, root):
    """whole(name): the run that nobody kills, once"""
    def run(name):
        if name not in WHOLE:
            WHOLE[name] = undisturbed(name, tmp_path_factory.mktemp("whole"), lmp_exe, root, 2)
        return WHOLE[name]

    return run


@pytest.mark.parametrize("name, seed", [pytest.param("plate", 1, marks=pytest.mark.long), ("debris", 2)])
def test_killed(whole, tmp_path, lmp_exe, root, name, seed):
    """the same bits of a shield, the same cloud of debris"""
    assert round_of(name, tmp_path, whole(name), lmp_exe, root, seed, 3) == 3


def test_files_outlive_killed_ranks(tmp_path, lmp_exe, root):
    """calls that go on from the same file, lose a rank (to a lack of memory, say) before they have saved more, and leave that file as it is"""
    run = CLASSES["plate"](tmp_path, "plate", lmp_exe, root)
    run.killed(run.is_in_leg(1), 2)
    lost = 0
    while lost < 2:  # not counted: a call that LAMMPS, or the one before it, had saved more for, just before the kill
        leg = run.chain()["leg"]
        status, said, there = run.rank_killed(lambda: True, 2)
        assert status == 1 and there and run.is_good() and run.chain()["leg"] in (leg, leg + 1), said
        lost += run.chain()["leg"] == leg


@pytest.mark.long
@pytest.mark.parametrize("seed", [4711, 4712, 4713, 4714, 4715])
@pytest.mark.parametrize("name", CLASSES)
def test_killed_often(whole, tmp_path, lmp_exe, root, name, seed):
    """50 kills of each example, in five runs"""
    assert round_of(name, tmp_path, whole(name), lmp_exe, root, seed, 10, say=print) == 10
