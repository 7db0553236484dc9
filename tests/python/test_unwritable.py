"""Files that cannot be written: a full disk, no such folder, a folder in place of a file, a folder of somebody else: one line that names the file."""

import functools
import os
import shutil
import subprocess
import sys

import pytest
from front_runs import CASE
from hvi import cli
from hvi.figures import style
from hvi.material import curves

NOBODY = 65534
MATERIAL = "Al6061-T6.hvi"
BODY = ["body", "--shape", "sphere", "--radius", "2e-3", "--spacing", "1e-3", "--fill", "lattice", "--material", MATERIAL]
COMMANDS = {
    "body": [*BODY, "FILE.data"],
    "plate": ["plate", "--radius", "3e-3", "--thickness", "1e-3", "--spacing", "5e-4", "--fill", "lattice", "--material", MATERIAL, "FILE.data"],
    "mesh": ["mesh", "--side", "2e-3", "--thickness", "1e-3", "--element", "1e-3", "--material", MATERIAL, "FILE.data"],
    "material table": ["material", MATERIAL, "Cu-OFHC.hvi", "--out", "FILE.csv"],
    "material figure": ["material", MATERIAL, "--figure", "FILE.png"],
    "cloud": ["cloud", "a.dump", "--axis", "z", "--plane", "0", "--out", "FILE.csv"],
    "export": ["export", "a.dump", "--out", "FILE"],
}
DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
-1 1
-1 1
-1 1
ITEM: ATOMS id type mass x y z vx vy vz time_si mirror_none
1 1 1 0 0 0.1 0 0 1 0 0
2 1 1 0 0 0.5 0 0 2 0 0
"""


@pytest.fixture
def folder(tmp_path, monkeypatch, root):
    monkeypatch.setattr(style, "DPI", 10)
    monkeypatch.setattr(curves, "borne", functools.partial(curves.borne, steps=10))  # numbers are no matter here
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))
    (tmp_path / "a.dump").write_text(DUMP)
    (tmp_path / "emi.yaml").write_text(CASE)
    return tmp_path


def line(words, capsys):
    """status, and what is on stderr but warnings"""
    status = cli.main(words)
    return status, [line for line in capsys.readouterr().err.splitlines() if not line.startswith("hvi: warning:")]


@pytest.mark.parametrize("name", COMMANDS)
def test_where_nothing_can_be_written(folder, capsys, name):
    """each says so in one line, with the name of the file, and leaves nothing half"""
    words = COMMANDS[name]
    given = words[-1]
    assert line(words, capsys)[0] == 0  # it can, here
    missing = str(folder / "no" / given)
    status, said = line([*words[:-1], missing], capsys)
    assert status == 1 and len(said) == 1 and str(folder / "no") in said[0] and "No such file or directory" in said[0], said
    if "." in given:
        os.makedirs(folder / "dir" / given)
        status, said = line([*words[:-1], str(folder / "dir" / given)], capsys)
        assert status == 1 and len(said) == 1 and "directory" in said[0] and given in said[0], said
        os.symlink("/dev/full", folder / f"full{given[4:]}")
        status, said = line([*words[:-1], f"full{given[4:]}"], capsys)
        assert status == 1 and len(said) == 1 and f"full{given[4:]}" in said[0] and "No space left on device" in said[0], said


@pytest.mark.parametrize("words", [["view", "gone.dump", "--output"], ["view", "gone.dump", "--figure"], ["cloud", "gone.dump", "--axis", "z", "--plane", "0", "--figure"],
                                   ["report", "gone", "--out"], ["movie", "gone", "--out"]])
def test_said_before_anything_is_read(folder, capsys, words):
    for where, reason in (("no", "No such file or directory"), ("a.dump", "Not a directory")):
        status, said = line([*words, str(folder / where / "name")], capsys)
        assert status == 1 and len(said) == 1 and f"{where}/name: {reason}" in said[0], said


def as_nobody(words, cwd, **environment):
    """who may not write here: root may write anywhere"""
    if os.geteuid():
        found = []
    elif shutil.which("setpriv"):
        found = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]
    else:
        pytest.skip("root ignores permissions, and there is no setpriv to become somebody else")
    if subprocess.run([*found, "test", "-r", str(environment["PYTHONPATH"]), "-a", "-x", str(cwd)], check=False).returncode:
        pytest.skip("nobody may not even read here")
    return subprocess.run([*found, *map(str, words)], cwd=cwd, env={**os.environ, **environment, "HOME": "/nonexistent"}, text=True, capture_output=True, timeout=120)


@pytest.fixture
def closed(root, folder):
    """a folder that only its owner may enter a file into, and not even that one; its path may be searched by all"""
    path = folder / "closed"
    path.mkdir()
    shutil.copy(folder / "emi.yaml", path)
    (path / "in.write").write_text("region box block 0 1 0 1 0 1\ncreate_box 1 box\ncreate_atoms 1 single 0.5 0.5 0.5\nmass 1 1\npair_style zero 0.4\npair_coeff * *\nwrite_restart ${to}\n")
    path.chmod(0o555)
    above = path.parent
    changed = []
    while above != above.parent and os.geteuid() == 0 and not above.stat().st_mode & 0o001:
        changed.append((above, above.stat().st_mode))
        above.chmod(above.stat().st_mode | 0o011)
        above = above.parent
    yield path
    path.chmod(0o755)
    for above, mode in changed:
        above.chmod(mode)


@pytest.mark.parametrize("words", [BODY + ["b.data"], ["shield", "emi.yaml"], ["shield", "emi.yaml", "--write", "there"], ["sweep", "none.yaml"]])
def test_folder_of_somebody_else(closed, root, lmp_exe, words):
    done = as_nobody([sys.executable, "-m", "hvi", *words], closed, PYTHONPATH=str(root / "python"), HVI_LMP=str(lmp_exe))
    said = [line for line in done.stderr.splitlines() if not line.startswith("hvi: warning:")]
    assert done.returncode in (1, 2) and len(said) == 1 and "Traceback" not in done.stderr, done.stderr
    assert "Permission denied" in said[0] or words[0] == "sweep", said


def test_lammps_in_a_folder_of_somebody_else(closed, root, lmp_exe):
    for to, reason in (("r", "Permission denied"), ("no/r", "No such file or directory")):
        done = as_nobody([root / "cmake/env.sh", lmp_exe, "-in", "in.write", "-log", "none", "-var", "to", to], closed, PYTHONPATH=str(root / "python"))
        assert done.returncode == 1 and f"Cannot open restart file {to}" in done.stdout and reason in done.stdout, done.stdout + done.stderr
