"""python/bin/hvi, the command line of the source tree: which Python and which LAMMPS it takes, from wherever it is called, and its one line where it cannot."""

import os
import shutil
import subprocess
import sys

import pytest
from front_runs import CASE

LACKS = "lacks numpy, scipy, matplotlib, PyYAML"


def script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


@pytest.fixture
def tree(root, tmp_path):
    """a source tree in a folder with blanks and more, whose build has a LAMMPS that says nothing"""
    folder = tmp_path / "a tree's \"copy\""
    for name in ("python", "potentials", "cmake", "src/USER-HVI", "examples/whipple-shield"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).symlink_to(root / name)
    (folder / "python").unlink()
    shutil.copytree(root / "python", folder / "python", ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
    built(folder / "build", folder)
    return folder


def built(build, tree):
    """a build folder"""
    script(build / "lmp", "exit 0")
    (build / "CMakeCache.txt").write_text("")
    (build / "hvi").symlink_to(tree / "python/bin/hvi")


@pytest.fixture
def call(tmp_path):
    """runs a launcher; python: of HVI_PYTHON, path: what PATH has in front"""
    def run(launcher, *words, cwd=tmp_path, python=sys.executable, path="", **more):
        env = {key: value for key, value in os.environ.items() if not key.startswith(("HVI_", "PYTHON", "LAMMPS_"))}
        env.update(more, PATH=f"{path}:{env['PATH']}" if path else env["PATH"], **({"HVI_PYTHON": str(python)} if python else {}))
        done = subprocess.run([str(launcher), *map(str, words)], cwd=cwd, env=env, text=True, capture_output=True, timeout=120)
        return done.returncode, done.stdout, done.stderr
    return run


@pytest.fixture
def poor(tmp_path):
    """a Python without libraries"""
    return script(tmp_path / "poor bin/python3", f'exec "{sys.executable}" -I -S "$@"')


def test_from_anywhere(call, tree, tmp_path):
    """by its path from another folder, by chains of links, on PATH; the help has the name that was called"""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/hvi").symlink_to(tree / "build/hvi")
    (tmp_path / "far/away").mkdir(parents=True)
    (tmp_path / "far/away/hvi").symlink_to("../../bin/hvi")
    for launcher, cwd, path in ((tree / "build/hvi", tmp_path, ""), ("build/hvi", tree, ""), ("./hvi", tmp_path / "far/away", ""), ("hvi", tree / "python", tmp_path / "bin"), (tree / "python/bin/hvi", "/", "")):
        status, out, err = call(launcher, "--help", cwd=cwd, path=path)
        assert (status, err) == (0, "") and out.startswith("usage: hvi "), f"{launcher} in {cwd}: {err}"
    status, out, err = call(tree / "build/hvi", "shield", "--help")
    assert (status, err) == (0, "") and "  hvi shield emi.yaml --dry-run" in out and "python3 -m hvi" not in out


def test_a_copy_does_not_work(call, tree, tmp_path):
    shutil.copy(tree / "python/bin/hvi", tmp_path / "hvi")
    status, out, err = call(tmp_path / "hvi", "--version")
    assert (status, out, err.count("\n")) == (1, "", 1) and "a copy does not work" in err


def test_modules_of_the_folder_are_not_taken(call, tree, tmp_path):
    """of the folder it is called in: its yaml.py is a user's"""
    (tmp_path / "yaml.py").write_text("raise SystemExit('not this one')\n")
    (tmp_path / "emi.yaml").write_text(CASE)
    status, out, err = call(tree / "build/hvi", "shield", "emi.yaml", "--dry-run")
    assert (status, err) == (0, "") and "sketch: " in out


def test_lammps_of_the_build_that_was_called(call, tree, tmp_path):
    """HVI_LMP, else lmp beside the link to the launcher if that is a build folder, else build/lmp"""
    (tmp_path / "emi.yaml").write_text(CASE)
    built(tmp_path / "other build", tree)
    script(tmp_path / "bin/lmp", "exit 0")  # somebody else's
    (tmp_path / "bin/hvi").symlink_to(tree / "build/hvi")
    (tmp_path / "bin/two").symlink_to(tmp_path / "other build/hvi")
    given = script(tmp_path / "given", "exit 0")
    study = tmp_path / "study.yaml"
    (tmp_path / "in.tiny").write_text("variable speed index 5.0\n")
    study.write_text("input: in.tiny\ngrid: {speed: [1.0]}\n")
    for launcher, lmp, more in (("python/bin/hvi", tree / "build/lmp", {}), ("build/hvi", tree / "build/lmp", {}), (tmp_path / "bin/hvi", tree / "build/lmp", {}),
                                (tmp_path / "bin/two", tmp_path / "other build/lmp", {}), ("build/hvi", given, {"HVI_LMP": str(given)})):
        status, out, err = call(tree / launcher, "sweep", study, "--dry-run", "--mpirun", "/bin/true", **more)
        assert status == 0 and f" {lmp} -in" in out and str(tree / "cmake/env.sh") in out, f"{launcher}: {out}{err}"


def test_python_with_all_is_found(call, tree, poor):
    """the first python3 on PATH lacks libraries: /usr/bin/python3, and a line that says what is missing where neither has them"""
    fake = f"{poor.parent}"
    status, out, err = call(tree / "build/hvi", "--version", python=None, path=fake)
    other = subprocess.run(["/usr/bin/python3", "-c", "import numpy, scipy, matplotlib, yaml"], capture_output=True, check=False).returncode if os.path.exists("/usr/bin/python3") else 1
    if other == 0:
        assert call(tree / "build/hvi", "shield", "none.yaml", python=None, path=fake)[2].startswith("hvi: cannot read none.yaml")
    assert (status, err) == (0, "") and out.startswith("lammps-hvi ")
    status, out, err = call(tree / "build/hvi", "shield", "none.yaml", python=poor)
    assert (status, out, err.count("\n")) == (1, "", 1) and f"{poor} {LACKS}" in err and "apt-get install python3-numpy " in err and "pip install numpy " in err and "HVI_PYTHON=FILE" in err


def test_a_python_that_cannot(call, tree, tmp_path):
    wrong = script(tmp_path / "wrong", "exit 1")
    status, out, err = call(tree / "build/hvi", "doctor", python=wrong)
    assert (status, out, err.count("\n")) == (1, "", 1) and f"{wrong} does not run" in err
    status, _, err = call(tree / "build/hvi", "doctor", python="no such program")
    assert status == 1 and "no such program is not there" in err and err.count("\n") == 1


def test_an_old_python_is_told(root, tmp_path):
    """where the command line itself is started by one"""
    code = "import sys; sys.version_info = (3, 8, 1); from hvi.cli import main; sys.exit(main(['doctor']))"
    done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(root / "python")}, text=True, capture_output=True)
    assert done.returncode == 1 and done.stderr.startswith("hvi: ") and done.stderr.endswith(", 3.9 or later is needed\n") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("version", ["2.7", "3.8"])
def test_old_python(call, tree, tmp_path, version):
    """the launcher asks it in words that any version understands"""
    code = f"import sys; sys.version_info = ({version.replace('.', ', ')}, 1); exec(sys.argv[1])"
    old = script(tmp_path / "old", f"exec '{sys.executable}' -c '{code}' \"$2\"")
    status, out, err = call(tree / "build/hvi", "doctor", python=old)
    assert (status, out, err.count("\n")) == (1, "", 1) and f"{old} is {version}, 3.9 or later is needed" in err


def test_doctor_runs_where_libraries_are_missing(call, tree, poor):
    """and help, and the version, on a Python that has none"""
    status, out, err = call(tree / "build/hvi", "doctor", python=poor)
    assert status == 1 and err.startswith("hvi: WRONG: ") and err.count("\n") == 1
    for name, debian in (("numpy", "numpy"), ("scipy", "scipy"), ("PyYAML", "yaml")):
        assert any(line.startswith(f"WRONG  {name} ") and f"not there: Debian's python3-{debian}, or pip install {name}" in line for line in out.splitlines()), out
    assert call(tree / "build/hvi", "--help", python=poor)[0] == call(tree / "build/hvi", "--version", python=poor)[0] == 0


def test_missing_library_in_one_line(root, tmp_path, poor):
    """python3 -m hvi, with a Python that has none of them"""
    (tmp_path / "emi.yaml").write_text(CASE)
    code = f"import sys; sys.path.insert(0, {str(root / 'python')!r}); from hvi.cli import main; sys.exit(main(['shield', 'emi.yaml']))"
    done = subprocess.run([str(poor), "-c", code], text=True, capture_output=True)
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert " has no numpy: Debian's python3-numpy, or pip install numpy; HVI_PYTHON names another" in done.stderr or " has no PyYAML: Debian's python3-yaml, or " in done.stderr, done.stderr


def test_how_to_run_what_was_written(call, tree, tmp_path):
    """the line that --write prints has whole paths: the folder is another, and nothing is set there"""
    (tmp_path / "emi.yaml").write_text(CASE)
    status, out, err = call(tree / "build/hvi", "shield", "emi.yaml", "--write", "there")
    assert (status, err) == (0, "")
    line = out.splitlines()[0].replace("mpirun -np 2", "echo would run")
    env = {key: value for key, value in os.environ.items() if not key.startswith(("HVI_", "PYTHON"))}
    done = subprocess.run(["sh", "-c", line], cwd=tmp_path, env={**env, "HVI_PYTHON": sys.executable}, text=True, capture_output=True)
    assert done.stdout.startswith(f"would run {tree / 'build/lmp'} -in in.shield\n")
    assert done.returncode == 1 and "No module" not in done.stderr and done.stderr.startswith("hvi: ") and done.stderr.count("\n") == 1, done.stderr


def test_signal_reaches_it(call, tree):
    """the shell of the launcher is gone when Python runs: what ends the command ends it"""
    text = (tree / "python/bin/hvi").read_text()
    assert text.count("\nexec \"$python\" -c") == 1


@pytest.mark.skipif(os.geteuid() != 0 or not shutil.which("setpriv"), reason="only root can become somebody else")
def test_as_somebody_who_cannot_write(call, tree, tmp_path):
    """in the tree nor at home"""
    work = tmp_path / "work"
    work.mkdir()
    (work / "emi.yaml").write_text(CASE)
    work.chmod(0o777)
    above = [path for path in (tmp_path, *tmp_path.parents) if not path.stat().st_mode & 0o001]
    modes = [(path, path.stat().st_mode) for path in above]
    try:
        for path in above:
            path.chmod(path.stat().st_mode | 0o011)
        become = ["--reuid=65534", "--regid=65534", "--clear-groups"]
        if call("setpriv", *become, "test", "-r", (tree / "potentials" / "Pb.hvi"))[0] or call("setpriv", *become, sys.executable, "-c", "import numpy, scipy, matplotlib, yaml")[0]:
            pytest.skip("nobody may not even read here")
        status, out, err = call("setpriv", *become, tree / "build/hvi", "shield", "emi.yaml", "--dry-run", cwd=work, HOME="/nonexistent", MPLCONFIGDIR="")
        assert status == 0 and "sketch: " in out and "Traceback" not in err
    finally:
        for path, mode in modes:
            path.chmod(mode)
