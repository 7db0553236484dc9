"""Files of users are read, never obeyed: what of them reaches an input, a folder, a terminal. What HTML escapes is in test_report.py, words of cases in inputs/cases.yaml."""

import os
import re
import subprocess
import sys

import pytest
import yaml
from front_runs import CASE, case_folder, front  # noqa: F401
from hvi import cli, texts
from hvi.errors import HVIError
from hvi.jobs import engine
from hvi.shield import case as cases
from hvi.shield import chain, decision


def test_names_in_an_input(folder):
    """that of a case stands in a remark, where quotes, & and $ would be more than that"""
    name = 'a """ & ${x} $(1) b&'
    (folder / f"{name}.yaml").write_text(CASE)
    case = cases.read(folder / f"{name}.yaml")
    first = chain.shield_of(case, 0, 0.0).text().splitlines()[0]
    assert case.name == name and re.fullmatch(r"# a --- - --x- --1- b-: a sphere [\w ./]*, [\w. ]*; written by python3 -m hvi shield", first), first


@pytest.mark.parametrize("file", ["../../victim", "/absolute", "shield.restart.a"])
def test_a_chain_goes_on_from_its_own_folder(folder, file):
    """what a chain went on from and came no farther is removed: nothing but a restart file of its own"""
    member = decision.members(cases.read("emi.yaml"))[0]
    job = decision.job(cases.read("emi.yaml"), member, folder / "runs/emi" / "run")
    job.folder.mkdir(parents=True)
    victim = folder / file.lstrip("/") if file[0] == "/" else job.folder / file
    victim.write_text("")
    engine.write_yaml(job.folder / "job.yaml", job.record)
    (job.folder / chain.CHAIN).write_text(yaml.safe_dump({"leg": 1, "file": str(victim) if file[0] == "/" else file}))
    assert bool(job.restart_files()) == (file == "shield.restart.a")


def test_includes_of_an_input(tmp_path):
    """copies are in the folder of the run; a whole path stays what it is"""
    (tmp_path / "there").mkdir()
    (tmp_path / "in.main").write_text(f"include there/in.a\ninclude {tmp_path}/in.far\n")
    (tmp_path / "there/in.a").write_text("variable a index 1\n")
    engine.Input(tmp_path / "in.main").copy_to(tmp_path / "run")
    assert sorted(str(path.relative_to(tmp_path / "run")) for path in (tmp_path / "run").rglob("in.*")) == ["in.main", "there/in.a"] and not (tmp_path / "in.far").exists()
    (tmp_path / "there/in.a").write_text("include ../../in.b\n")
    with pytest.raises(HVIError, match=r"include ../../in.b: a run has copies"):
        engine.Input(tmp_path / "in.main")


def test_a_terminal_obeys_nothing(capsys, folder):
    (folder / "emi.yaml").write_text(CASE.replace("speed_km_s: 7.1", 'speed_km_s: "\\e]0;title\\a\\e[2J"'))
    assert front("shield") == 1
    err = capsys.readouterr().err
    assert err.count("\n") == 1 and "\x1b" not in err and "\\x1b" in err
    assert cli.shown("a" * 10_000) == "a" * cli.MOST + " ..."


def test_a_file_without_end(tmp_path):
    (tmp_path / "x.yaml").symlink_to("/dev/zero")
    with pytest.raises(HVIError, match="x.yaml is larger than 250,000 bytes"):
        texts.load(tmp_path / "x.yaml")


def test_aliases_that_are_no_harm(tmp_path):
    (tmp_path / "x.yaml").write_text("a: &a {b: 1}\nc: [*a, *a]\nd: {<<: *a, e: 2}\n")
    assert texts.load(tmp_path / "x.yaml") == {"a": {"b": 1}, "c": [{"b": 1}] * 2, "d": {"b": 1, "e": 2}}


def test_what_is_run(folder, lmp_exe, root):
    """real processes: words that LAMMPS alone knows are its errors, with the status of one; YAML that would execute does not"""
    def process(text):
        (folder / "emi.yaml").write_text(text)
        words = [sys.executable, "-m", "hvi", "shield", "emi.yaml", "--lmp", str(lmp_exe), "--ranks", "1", "--jobs", "2"]
        return subprocess.run(words, env={**os.environ, "PYTHONPATH": str(root / "python")}, capture_output=True, text=True, timeout=120)

    small = CASE.replace("[0.2, 0.4]", "[0.4]")
    done = process(small + "settings: {kernel: conical}\n")
    assert done.returncode == 1 and "conical" in done.stdout and "ERROR" in done.stdout and done.stderr.count("\n") == 1 and "2 of 2 runs failed" in done.stderr, done
    for text in (small + "settings: {pair: \"dissipation riemann\\nshell touch stolen\"}\n", "!!python/object/apply:os.system [touch stolen]\n"):
        done = process(text)
        assert done.returncode == 1 and "Traceback" not in done.stderr and not list(folder.rglob("stolen")), done
