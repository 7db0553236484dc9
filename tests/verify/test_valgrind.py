"""Small runs under valgrind: no read of memory that was not written or is not there. Sanitizers see the latter only."""

import pathlib
import shutil
import signal
import subprocess

import pytest
from whole_runs import VARIABLES, WHOLE_RUNS

pytestmark = pytest.mark.long
FOUND = 99
SUPPRESSIONS = ["/usr/share/openmpi/openmpi-valgrind.supp", pathlib.Path(__file__).with_name("valgrind.supp")]  # of Open MPI itself


@pytest.fixture
def watched(lmp_portable, tmp_path):
    """a program that runs LAMMPS under valgrind"""
    valgrind = shutil.which("valgrind")
    if not valgrind:
        pytest.skip("no valgrind (Debian: apt-get install valgrind)")
    tried = subprocess.run([valgrind, "-q", lmp_portable, "-h"], capture_output=True, text=True)
    if tried.returncode == -signal.SIGILL:
        pytest.skip("this valgrind does not know all instructions of this processor: make build PORTABLE=yes BUILD=build-portable, then HVI_LMP_PORTABLE=build-portable/lmp")
    assert tried.returncode == 0, tried.stderr
    script = tmp_path / "lmp"
    script.write_text(f'#!/bin/sh\nexec {valgrind} -q --error-exitcode={FOUND} {" ".join(f"--suppressions={s}" for s in SUPPRESSIONS)} --log-file=valgrind.%p.log {lmp_portable} "$@"\n')
    script.chmod(0o755)
    return script


@pytest.mark.parametrize("scene", WHOLE_RUNS)
def test_no_memory_is_read_that_was_not_written(lmp, watched, root, tmp_path, scene):
    lmp(scene(root), nranks=2, exe=watched, vars=VARIABLES.get(scene), env={"LAMMPS_POTENTIALS": str(root / "potentials")}, timeout=1500)
    logs = list(tmp_path.glob("valgrind.*.log"))
    assert len(logs) >= 2 and {log.name: text for log in logs if "lammps" in (text := log.read_text()).lower()} == {}
