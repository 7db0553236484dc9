"""Fixtures for all Python tests: run LAMMPS.

Run by ctest (`make test`) or by hand: `pytest tests/style/test_x.py` uses build/. Tests marked long run with `-m long` only, as in
`make verify`.
"""

import os
import pathlib
import shlex
import signal
import subprocess
import sys

import pytest

ROOT = pathlib.Path(os.environ.get("HVI_ROOT", pathlib.Path(__file__).resolve().parents[1]))
sys.path[:0] = [str(ROOT / folder) for folder in ("tests/lib", "python", "bench", "doc/ext")]  # pytest itself puts tests there, for reference
from corrected_scenes import commands_of_pair  # noqa: E402
from lammps_runs import Result, alone  # noqa: E402
from solid_scenes import MATERIAL  # noqa: E402


def _built(variable, name):
    path = ROOT / os.environ.get(variable, f"build/{name}")  # which may be absolute
    if not path.exists():
        pytest.fail(f"{path} does not exist: run make first, or set {variable}", pytrace=False)
    return path


def pytest_configure(config):
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # what a script starts in the background; programs that tests interrupt would inherit it
        signal.signal(signal.SIGINT, signal.default_int_handler)
    config.addinivalue_line("markers", "long: in make verify only, that is with -m long")
    config.addinivalue_line("markers", "each_value: each value of its parameters once; all their combinations in the long form")


def once_each(items):
    """IDs of some of the items of a test, in which each value of its parameters is"""
    values = {item.callspec.id: {(name, repr(value)) for name, value in item.callspec.params.items()} for item in items}
    missing, found = set().union(*values.values()), set()
    while missing:
        found.add(one := max(values, key=lambda one: len(values[one] & missing)))
        missing -= values[one]
    return found


@pytest.hookimpl(tryfirst=True)  # before -m chooses
def pytest_collection_modifyitems(config, items):
    tests = {}
    for item in items:
        if item.get_closest_marker("each_value"):
            tests.setdefault(item.function, []).append(item)
    for some in tests.values():
        short = once_each([item for item in some if not item.get_closest_marker("long")])
        for item in some:
            if item.callspec.id not in short:
                item.add_marker(pytest.mark.long)
    if not config.option.markexpr:
        config.hook.pytest_deselected(items=[i for i in items if i.get_closest_marker("long")])
        items[:] = [i for i in items if not i.get_closest_marker("long")]


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def lmp_exe():
    """LAMMPS with the package built in"""
    return _built("HVI_LMP", "lmp")


@pytest.fixture(scope="session")
def lmp_portable(lmp_exe):
    """one for any machine (make build PORTABLE=yes BUILD=build-portable), if HVI_LMP_PORTABLE names it, else lmp_exe"""
    return _built("HVI_LMP_PORTABLE", "") if "HVI_LMP_PORTABLE" in os.environ else lmp_exe


@pytest.fixture(scope="session")
def lmp_stock():
    """the same LAMMPS without the package"""
    return _built("HVI_LMP_STOCK", "lmp-stock")


@pytest.fixture(scope="session")
def plugin():
    return _built("HVI_PLUGIN", "hviplugin.so")


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """every test runs in its own folder"""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def lmp(tmp_path, lmp_exe):
    """Runs LAMMPS on an input text (or the Path of an input file) and returns a Result.

    lmp(text, nranks=1, vars={"name": value or list}, expect_fail=False or True or None, exe=other program,
        extra=["-sf", "opt"],
        cwd=folder, timeout=seconds, env={...})
    A wrong return code or a hang fails the test. Each call has its own log.
    """
    count = 0

    def run(text, nranks=1, vars=None, cwd=None, expect_fail=False, exe=None, extra=(), timeout=300, env=None):
        nonlocal count
        count += 1
        cwd = pathlib.Path(cwd or tmp_path)
        cwd.mkdir(parents=True, exist_ok=True)
        if isinstance(text, pathlib.Path):
            infile = text
        else:
            infile = cwd / f"in.{count}"
            infile.write_text(text)
        log = cwd / f"log.{count}"
        command = [ROOT / "cmake" / "env.sh"]
        if nranks > 1:
            command += ["mpirun", "-np", str(nranks)]
        command += [exe or lmp_exe, "-in", infile, "-log", log]
        for name, value in (vars or {}).items():
            values = value if isinstance(value, (list, tuple)) else [value]
            command += ["-var", name, *map(str, values)]
        command = [str(c) for c in [*command, *extra]]
        quicker = alone(tmp_path.parent / f"{tmp_path.name}.mpi" / str(count)) if nranks == 1 else {}
        # a group of its own: on a hang mpirun and all its ranks end
        process = subprocess.Popen(command, cwd=cwd, env={**os.environ, **quicker, **(env or {})}, text=True, errors="replace",
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   start_new_session=True)
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 15)
            try:
                out, err = process.communicate(timeout=10)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, 9)
                out, err = process.communicate()
            pytest.fail(f"no end after {timeout} s: {shlex.join(command)}\n{out[-3000:]}\n{err[-2000:]}", pytrace=False)
        result = Result(command, cwd, process.returncode, out, err, log.read_text() if log.exists() else "")
        if expect_fail and result.returncode == 0:
            pytest.fail(f"should have failed: {result}", pytrace=False)
        if expect_fail is False and result.returncode != 0:
            pytest.fail(str(result), pytrace=False)
        return result

    return run


@pytest.fixture
def material(tmp_path):
    """the file of solid_scenes.MATERIAL"""
    path = tmp_path / "test.hvi"
    path.write_text(MATERIAL.format(sigma_p=3.0))
    return path


@pytest.fixture
def pair(tmp_path):
    """the commands of the two materials of corrected_scenes, as a function of the words of pair_style"""
    return commands_of_pair(tmp_path)
