"""The tutorial, as it stands: its files, commands and outputs."""

import os
import re
import shlex
import subprocess
import sys

import pytest
from hvi import cli


def blocks(root, language):
    text = (root / "doc" / "src" / "Tutorial.rst").read_text()
    text = text[text.index("2. Your shield"):]
    return [re.sub(r"^   ", "", found, flags=re.M) for found in re.findall(rf"^\.\. code-block:: {language}\n\n((?:   .*\n|\n)+)", text, re.M)]


def commands(root):
    return [shlex.split(line, comments=True) for block in blocks(root, "bash") for line in block.splitlines() if line]


@pytest.fixture
def reader(root, lmp_exe, tmp_path):
    """what a reader has by then, and does"""
    for name, text in zip(("my.yaml", "thick.yaml"), blocks(root, "yaml"), strict=True):
        (tmp_path / name).write_text(text)
    (tmp_path / "potentials").symlink_to(root / "potentials")
    environment = {**os.environ, "HVI_LMP": str(lmp_exe), "PYTHONPATH": str(root / "python")}

    def do(words, status=0):
        assert words[0] == "build/hvi"
        done = subprocess.run([sys.executable, "-m", "hvi", *words[1:]], cwd=tmp_path, env=environment, text=True, capture_output=True, timeout=1500)
        assert done.returncode == status, done.stdout[-2000:] + done.stderr[-2000:]
        return done.stdout

    return do


def test_commands_are_known(root):
    found = commands(root)
    assert [words[1] for words in found] == ["material", "ble", "shield", "shield", "report", "shield", "limit"]
    for words in found:
        cli.parse(words[1:])


def test_before_it_runs(root, reader, tmp_path):
    material, ble, plan = commands(root)[:3]
    assert "Al2017-T4" in reader(material)
    said, table = reader(ble), blocks(root, "none")[0]
    assert [line.split() for line in table.splitlines() if line and line.split() not in map(str.split, said.splitlines())] == []
    reader(plan)
    assert (tmp_path / "runs/my/sketch.png").is_file()


@pytest.mark.parametrize("number, steps, energy", [(0, 100, 1e-5), (1, 40, 5e-4)], ids=["solid", "liquid"])
def test_inputs_run(lmp, root, number, steps, energy):
    """the straight inputs, cut short: no warning, something is struck, and the energy balance is kept"""
    inputs = [text.strip() for text in blocks(root, "LAMMPS")]
    assert len(inputs) == 2 and all(len(text.split("\n")) < 30 for text in inputs)
    text, count = re.subn(r"^run +\d+$", f"thermo {steps}\nrun {steps}", inputs[number], flags=re.M)
    assert count == 1
    r = lmp(text, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert r.warnings == [] and abs(r.thermo["c_book[9]"] - 1).max() < energy
    struck = {0: lambda t: t["c_cloud[6]"][-1] > 0, 1: lambda t: t["c_most"][-1] > 1e7}[number]
    assert struck(r.thermo)


@pytest.mark.long
def test_verdicts(root, reader, tmp_path):
    """numbers of milligrams differ by compiler and processor, verdicts must not"""
    mine, report, thick = commands(root)[3:6]
    for words, text, status in ((mine, blocks(root, "none")[1], 3), (thick, blocks(root, "none")[2], 0)):
        said = reader(words, status)
        assert all(line in said for line in text.splitlines()[:2]), said
    reader(report)
    assert "</html>" in (tmp_path / "runs/my/report.html").read_text()
