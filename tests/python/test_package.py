"""python/ as a package: source distribution, wheel from it, the version of both. Nothing is fetched."""

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
    env = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "HVI_ROOT")}
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

    python("-c", HOOK, "build_sdist", tmp_path, cwd=tmp_path / "tree" / "python")
    (sdist,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path / "unpacked")
    (source,) = (tmp_path / "unpacked").iterdir()
    assert source.name.endswith("-7.8.9")
    modules = files(root / "python" / "hvi")
    assert "io/dump.py" in modules and files(source / "hvi") == modules

    shutil.rmtree(tmp_path / "tree")
    python("-c", HOOK, "build_wheel", tmp_path, cwd=source)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name == "lammps_hvi-7.8.9-py3-none-any.whl"
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    assert files(site / "hvi") == modules and (site / "hvi/shield/calibration.csv").is_file()

    assert python("-c", "import hvi; print(hvi.__file__, hvi.__version__)", path=site).split() == [str(site / "hvi" / "__init__.py"), "7.8.9"]
    assert "usage: " in python("-m", "hvi", "--help", path=site)
