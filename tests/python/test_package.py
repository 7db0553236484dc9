"""python/ as a package: source distribution, wheel from it, the version of both, what they bring; the command in a virtual environment. Nothing is fetched."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

HOOK = "import sys, setuptools.build_meta as backend; print(getattr(backend, sys.argv[1])(sys.argv[2]))"  # as pip and build call it


@pytest.fixture
def python(tmp_path):
    """runs Python away from the source tree, without its paths and without a network"""
    env = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "HVI_ROOT", "LAMMPS_POTENTIALS", "PYTHONPYCACHEPREFIX")}
    env.update(PIP_NO_INDEX="1", PYTHONDONTWRITEBYTECODE="1", no_proxy="", http_proxy="http://127.0.0.1:9", https_proxy="http://127.0.0.1:9")

    def run(*words, cwd=tmp_path, path=""):
        r = subprocess.run([sys.executable, *map(str, words)], cwd=cwd, env={**env, "PYTHONPATH": str(path)}, text=True,
                           capture_output=True, timeout=120)
        assert r.returncode == 0, r.stdout + r.stderr
        return r.stdout

    return run


def files(folder):
    """of Python in it and its rooms"""
    return {str(p.relative_to(folder)) for p in folder.rglob("*.py")}


def test_wheel_from_source_distribution(root, tmp_path, python):
    """the version is that of the header, here one that is nowhere else"""
    header = tmp_path / "tree" / "src" / "USER-HVI" / "hvi_version.h"
    header.parent.mkdir(parents=True)
    text, changes = re.subn(r'(HVI_VERSION\[\] = )"[^"]+"', r'\1"7.8.9"', (root / "src" / "USER-HVI" / "hvi_version.h").read_text())
    assert changes == 1
    header.write_text(text)
    shutil.copytree(root / "python", tmp_path / "tree" / "python", ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    for name in ("potentials", "cmake", "examples", "LICENSE"):
        (tmp_path / "tree" / name).symlink_to(root / name)

    python("-c", HOOK, "build_sdist", tmp_path, cwd=tmp_path / "tree" / "python")
    (sdist,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path / "unpacked")
    (source,) = (tmp_path / "unpacked").iterdir()
    assert source.name.endswith("-7.8.9")
    modules = files(root / "python" / "hvi")
    assert "io/dump.py" in modules and files(source / "hvi") == modules and brought(source, root)

    shutil.rmtree(tmp_path / "tree")
    python("-c", HOOK, "build_wheel", tmp_path, cwd=source)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name == "lammps_hvi-7.8.9-py3-none-any.whl"
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    assert files(site / "hvi") == modules and (site / "hvi/shield/calibration.csv").is_file() and brought(site, root)

    assert python("-c", "import hvi; print(hvi.__file__, hvi.__version__)", path=site).split() == [str(site / "hvi" / "__init__.py"), "7.8.9"]
    assert "usage: " in python("-m", "hvi", "--help", path=site)
    code = "from hvi.material import library; from hvi.shield import shots; print(library.find('Pb.hvi'), shots.SETTINGS)"
    assert python("-c", code, path=site).split() == [str(site / "hvi/data" / name) for name in ("potentials/Pb.hvi", "examples/whipple-shield/shots/all.yaml")]


def brought(folder, root):
    """whether the files that the package needs are copies of those of the tree"""
    needed = [*root.glob("potentials/*.hvi"), *root.glob("examples/whipple-shield/cases/*.yaml"), root / "examples/whipple-shield/shots/all.yaml", root / "cmake/env.sh", root / "LICENSE"]
    return len(needed) > 25 and all((folder / "hvi/data" / path.relative_to(root)).read_bytes() == path.read_bytes() for path in needed)


def test_no_wheel_without_materials(root, tmp_path):
    """a copy of python/ alone, which older versions of pip make, is no package: one line says so"""
    shutil.copytree(root / "python", tmp_path / "python", ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    for header in (False, True):
        if header:
            (tmp_path / "src/USER-HVI").mkdir(parents=True)
            shutil.copy(root / "src/USER-HVI/hvi_version.h", tmp_path / "src/USER-HVI")
        done = subprocess.run([sys.executable, "-c", HOOK, "build_wheel", tmp_path], cwd=tmp_path / "python", text=True, capture_output=True)
        assert done.returncode == 1 and "install from the" in done.stderr.splitlines()[-1] and "with pip 21.3 or later" in done.stderr.splitlines()[-1]
        assert not list(tmp_path.glob("*.whl"))


@pytest.mark.long
def test_command_in_a_virtual_environment(root, tmp_path, monkeypatch, lmp_exe):
    """pip install in a path with blanks, from a tree that nobody may write in, which stays as it is; then the command, outside of the tree, as root or not"""
    pytest.importorskip("ensurepip", reason="no virtual environments here (Debian: python3-venv)")
    env = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "HVI_", "LAMMPS_", "PIP_", "OMPI_"))}
    env.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1", HOME=str(tmp_path))

    def run(*words, status=0, **more):
        done = subprocess.run([str(word) for word in words], cwd=work, env={**env, **more}, text=True, capture_output=True, timeout=200)
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout if status == 0 else done.stderr
    work = tmp_path / "my work"
    work.mkdir()
    run(sys.executable, "-m", "venv", "--system-site-packages", work / "v e")
    before = sorted(path for path in (root / "python").rglob("*") if "__pycache__" not in path.parts)
    run(work / "v e/bin/python", "-m", "pip", "install", "-q", "--no-build-isolation", "--no-deps", root / "python")
    assert sorted(path for path in (root / "python").rglob("*") if "__pycache__" not in path.parts) == before
    hvi = work / "v e/bin/hvi"
    where = run(work / "v e/bin/python", "-c", "import hvi; print(hvi.__file__)")
    assert where.startswith(str(work / "v e"))
    shutil.copy(root / "examples/whipple-shield/cases/quick.yaml", work)
    assert "sketch: " in run(hvi, "shield", "quick.yaml", "--dry-run")  # with materials
    said = run(hvi, "shield", "quick.yaml", status=1, PATH="/usr/bin:/bin")
    assert said.startswith("hvi: no LAMMPS with USER-HVI, looked for --lmp, HVI_LMP, lmp") and "give its build/lmp" in said and said.count("\n") == 1
    run(hvi, "shield", "quick.yaml", "--write", "there")
    assert "of 2 ranks and Al6061-T6.hvi ends well" in run(hvi, "doctor", HVI_LMP=str(lmp_exe))
    (work / "on path").mkdir()
    (work / "on path/lmp").symlink_to(lmp_exe)
    assert f"{lmp_exe.resolve()}, version" in run(hvi, "doctor", PATH=f"{work / 'on path'}:{env['PATH']}")
