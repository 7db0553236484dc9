"""For tests of python3 -m hvi shield, limit and sweep: a case, a folder with it and a fake of LAMMPS, the command."""

import math
import signal
import sys
import time

import pytest
from hvi import cli
from hvi.jobs import machine, runs
from hvi.shield import brackets, chain, record

CASE = """# a shield
projectile:
  diameter_mm: 5
  material: Al2024-T3
speed_km_s: 7.1
walls:
  - {thickness_mm: 0.8, material: Al2024-T3}
  - thickness_mm: 1.2
    material: Al6061-T6
    gap_mm: 60
spacings_mm: [0.2, 0.4]
shifts: [0, 0.5]
"""


@pytest.fixture(name="folder")
def case_folder(tmp_path, root, monkeypatch):
    (tmp_path / "emi.yaml").write_text(CASE)
    mpirun = tmp_path / "mpirun"
    mpirun.write_text(f"#!/bin/sh\nexport FAKE_COLUMNS='{record.BOOK} {' '.join(record.WALL)}'\nexec '{sys.executable}' -I -S '{root}/tests/lib/fake_lammps.py' \"$@\"\n")
    mpirun.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(chain, "LEG", math.inf)  # one call of LAMMPS for a run
    monkeypatch.setattr(runs, "LOOK", 0.01)  # the fake takes less than the usual time
    monkeypatch.setattr(machine, "free_memory", lambda: 1e6)  # MB, whatever the machine has
    monkeypatch.setattr(machine, "free_disk", lambda path: (1e6, path))
    monkeypatch.setenv("HVI_LMP", str(mpirun))
    monkeypatch.setenv("PYTHONPATH", str(root / "python"))
    return tmp_path


def front(*words, case="emi.yaml"):
    """exit status of a command within this process"""
    before = signal.getsignal(signal.SIGTERM)
    try:
        return cli.main([words[0], case, *words[1:], "--mpirun", "./mpirun"])
    finally:
        signal.signal(signal.SIGTERM, before)


def tries(folder):
    """how many runs were begun in each folder"""
    return {path.parent.name: len(path.read_text().split()) for path in folder.glob("runs/**/tries")}


def begun(folder):
    """when each run was begun last"""
    return {path.parent.name: path.stat().st_mtime_ns for path in folder.glob("runs/**/tries")}


def wait_for(true, seconds=60):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.05)


def change(old, new):
    assert old in CASE
    return CASE.replace(old, new)


HEAD = ",".join(brackets.COLUMNS) + "\n"
LIST = "# a remark\n" + HEAD + """W,A,AA2017-T4,5,7.1,AA6061-T6,1.6,50,AA6061-T6,40,,wall,1.6,1.8,4 (2.60),E (2.71)
D,B,AA2017-T4,,7.1,AA6061-T6,1.6,50,AA6061-T6,40,1.8,diameter,4.0,4.5,8,-
"""
STUDY = """list: mine.csv
across: [10]
spacing: {bumper_layers: 2, wall_layers: 3, ratio: 1}
shifts: [0, 0.5]
materials: {AA2017-T4: Al2017-T4, AA6061-T6: Al6061-T6}
"""


@pytest.fixture(name="mine")
def mine_folder(folder):
    (folder / "mine.csv").write_text(LIST)
    (folder / "mine.yaml").write_text(STUDY)
    return folder
