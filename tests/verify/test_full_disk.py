"""python3 -m hvi shield where the disk is full, or files may not be longer: it says so, takes nothing half for a result, and the next call goes on to the same bits."""

import contextlib
import os
import resource
import subprocess

import pytest
from kill_runs import Shield, same

pytestmark = pytest.mark.filterwarnings("ignore::hvi.errors.HVIWarning")  # of few layers


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, lmp_exe, root):
    run = Shield(tmp_path_factory.mktemp("whole"), "plate", lmp_exe, root)
    assert run.call()[0] == run.UNDECIDED
    return run


@pytest.fixture
def small(tmp_path):
    """a disk of its own, of 16 MB"""
    path = tmp_path / "small"
    path.mkdir()
    if os.geteuid() or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16m", "tmpfs", path], check=False, capture_output=True).returncode:
        pytest.skip("no file system can be mounted here")
    yield path
    subprocess.run(["umount", "-l", path], check=True)


def test_full_disk(small, undisturbed, lmp_exe, root):
    """it is full from the second leg on: the run fails and says why; with room again it ends as one that was not disturbed"""
    run = Shield(small, "plate", lmp_exe, root)
    process = run.begin(1)
    run.wait_for(run.is_in_leg(1), process)
    with contextlib.suppress(OSError), open(small / "filler", "wb", buffering=0) as filler:
        while True:
            filler.write(bytes(4096))
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 1 and ("disk is full" in said or "No space left" in said) and "Traceback" not in said, said
    assert not (run.folder / "result.yaml").exists() and run.is_good()
    (small / "filler").unlink()
    status, said = run.call()
    assert status == run.UNDECIDED, said
    same(run, undisturbed)


def test_files_that_may_not_be_longer(tmp_path, undisturbed, lmp_exe, root):
    """ulimit -f: whoever writes more is ended by a signal, here files of MPI are the first; nothing is taken for a result"""
    run = Shield(tmp_path, "plate", lmp_exe, root)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, before[1]))
    try:
        status, said = run.call()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert status == 1 and "FAILED: exit status" in said and "Traceback" not in said and not (run.folder / "chain.yaml").exists(), said
    status, said = run.call()
    assert status == run.UNDECIDED, said
    same(run, undisturbed)


def test_two_calls_in_a_folder(tmp_path, undisturbed, lmp_exe, root):
    """of the same case share its run; what both say is the same"""
    run = Shield(tmp_path, "plate", lmp_exe, root)
    calls = [run.begin(1) for _ in range(2)]
    said = [call.communicate(timeout=300)[0] for call in calls]
    assert [call.returncode for call in calls] == [run.UNDECIDED] * 2, said
    assert len(list(run.folder.glob("log.*.lammps"))) == len(list(undisturbed.folder.glob("log.*.lammps")))
    same(run, undisturbed)
