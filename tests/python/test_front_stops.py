"""python3 -m hvi shield: what stops it from outside; LAMMPS is a fake here."""

import os
import pathlib
import pty
import signal
import subprocess
import sys
import termios
import time
import types

import pytest
import yaml
from front_runs import CASE, case_folder, change, front, tries, wait_for  # noqa: F401
from hvi import cli, texts
from hvi.jobs import engine
from hvi.shield import case as cases
from hvi.shield import decision, script

COMMAND = [sys.executable, "-m", "hvi", "shield", "emi.yaml", "--mpirun", "./mpirun", "--jobs", "2"]


def at_work(folder):
    """PIDs of processes in folders of runs"""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cwd"):
        try:
            if pathlib.Path(os.readlink(path)).is_relative_to(folder / "runs"):
                found.append(path.parent.name)
        except OSError:
            pass
    return found


def test_a_call_that_ends_while_it_is_looked_at(folder, monkeypatch):
    """it has not ended, or it has, and then its result is written; no look at it sees both"""
    job, advanced = decision.job(cases.read("emi.yaml"), (0, 0.0), folder / "a"), []
    monkeypatch.setattr(job, "advance", lambda: advanced.append(1) or True)
    monkeypatch.setattr(job, "result", lambda: advanced or None)
    job.folder.mkdir()
    job.process = types.SimpleNamespace(poll=iter([None, 0, 0]).__next__)
    assert not job.ended(None, None) and advanced == []
    assert job.ended(None, None) and advanced == [1] and job.problem == ""


def begin(folder, **how):
    process = subprocess.Popen(COMMAND, cwd=folder, env={**os.environ, "FAKE_SLEEP": "60", **how.pop("env", {})}, **how)
    wait_for(lambda: len(tries(folder)) == 2)
    assert at_work(folder)
    return process


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_told_to_end(folder, number):
    """exit status 130, nothing goes on, nothing is taken for a result, and the next call does the rest; which run has saved nothing is said"""
    process = begin(folder, env={"FAKE_SAVE": "shift-0.5"}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    wait_for(lambda: list(folder.glob("runs/emi/*/chain.yaml")))
    process.send_signal(number)
    assert "interrupted: call again to go on; 1 run has saved nothing and will begin anew: dx-0.4_shift-0.0\n" in process.communicate(timeout=30)[1] and process.returncode == 130
    assert not at_work(folder) and not list(folder.glob("runs/**/result.yaml")) and not (folder / "runs/emi/verdict.yaml").exists()
    assert front("shield") == 3 and len(tries(folder)) == 4


def test_ctrl_c_again(folder):
    """runs that do not listen are killed at the second time; the terminal is as it was"""
    (folder / "mpirun").write_text((folder / "mpirun").read_text().replace("#!/bin/sh\n", "#!/bin/sh\ntrap '' TERM INT\n"))
    master, slave = pty.openpty()
    before = termios.tcgetattr(slave)
    process = begin(folder, stdin=slave, stdout=slave, stderr=slave, start_new_session=True)
    process.send_signal(signal.SIGINT)
    time.sleep(0.7)
    assert process.poll() is None and at_work(folder)
    start = time.monotonic()
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=30) == 130 and time.monotonic() - start < 5 and not at_work(folder)
    assert termios.tcgetattr(slave) == before
    os.close(master)
    os.close(slave)


@pytest.mark.long
def test_nohup(folder):
    """SIGHUP that is ignored already stays so"""
    process = begin(folder, env={"FAKE_SLEEP": "2"}, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN), stdout=subprocess.DEVNULL)
    process.send_signal(signal.SIGHUP)
    assert process.wait(timeout=60) == 3


def test_timeout(folder, capsys, monkeypatch):
    """no verdict; what the next call will do is said, and it goes on only if the run has saved something since"""
    monkeypatch.setenv("FAKE_SLEEP", "60")
    monkeypatch.setenv("FAKE_SAVE", "dx-0.2")
    assert front("shield", "--timeout", "1", "--jobs", "4") == 1
    out, err = capsys.readouterr()
    assert "dx-0.2_shift-0.0  FAILED: stopped after 1 s; call again: it goes on from what it has saved" in out
    assert "dx-0.4_shift-0.0  FAILED: stopped after 1 s; it has saved nothing new, another call would come no farther: take a longer --timeout" in out
    assert "no verdict: 4 of 4 runs failed" in err and "verdict:" not in out and not (folder / "runs/emi/verdict.yaml").exists()
    monkeypatch.setenv("FAKE_SAVE", "no")
    assert front("shield", "--timeout", "1", "--jobs", "4") == 1
    assert capsys.readouterr().out.count("it has saved nothing new") == 4 and (folder / "runs/emi/dx-0.2_shift-0.0/shield.restart.a").exists()
    monkeypatch.setenv("FAKE_SLEEP", "0")
    assert front("shield") == 3
    assert (folder / "runs/emi/dx-0.2_shift-0.0/tries").read_text().split() == ["no", "yes", "yes"]
    assert (folder / "runs/emi/dx-0.4_shift-0.0/tries").read_text().split() == ["no"]  # in a folder that was emptied


def test_crash_of_a_run_that_went_on(folder, monkeypatch):
    """what it has saved since then is kept; what brought it no farther is not gone on from again"""
    path = folder / "runs/emi/dx-0.2_shift-0.0"
    monkeypatch.setenv("FAKE_SAVE", "dx-0.2_shift-0.0")
    monkeypatch.setenv("FAKE_FAIL", "dx-0.2_shift-0.0")
    for said, save in ((["no"], True), (["no", "yes"], True), (["no", "yes", "yes"], False), (["no"], False)):
        if not save:
            monkeypatch.setenv("FAKE_SAVE", "nothing")
        assert front("shield") == 1 and (path / "tries").read_text().split() == said
        assert (path / "shield.restart.a").exists() == save


@pytest.mark.parametrize("lines, seen, unseen", [
    (["ERROR: Lost atoms", "Last input line: run 5", "-" * 70, "MPI_ABORT was invoked"], "Lost atoms", "MPI_ABORT"),
    (["step 5", "[vm:1] *** Process received signal ***", *(f"[vm:1] [{k}] lmp(+0x{k})" for k in range(30))], "received signal", "[29]"),
    (["step 4", "step 5"], "step 5", "ERROR")])
def test_last_lines(folder, lines, seen, unseen):
    (folder / "in.main").write_text("")
    (folder / "a").mkdir()
    (folder / "a/output.txt").write_text("\n".join(lines))
    said = "\n".join(engine.Job(engine.Input(folder / "in.main"), "a", {}, folder / "a").last_lines())
    assert seen in said and unseen not in said


@pytest.mark.parametrize("seconds, words", [(0, "0 s"), (89, "89 s"), (600, "10 min"), (5400, "1.5 h"), (170000, "47.2 h"), (172800, "2 days"), (3e7, "347 days"), (63115200, "2 years"),
                                            (3600 * 82576814.6, "9,420 years")])
def test_durations(seconds, words):
    assert engine.duration(seconds) == words


@pytest.mark.parametrize("speed, asks", [("-6", ""), ("0", ""), ("0.006", "; is it in km/s?"), ("6000", "; is it in m/s?")])
def test_units_are_asked_for_where_they_may_be_why(folder, capsys, speed, asks):
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", f"speed_km_s: {speed}"))
    assert front("shield", "--dry-run") == 1 and capsys.readouterr().err.endswith(f"must be at least 0.1 and below 100 km/s, not {speed}{asks}\n")


def test_lammps_without_the_package(folder, capsys):
    """a run stops at the first style of ours"""
    (folder / "mpirun").write_text("#!/bin/sh\necho \"ERROR: Unrecognized pair style 'hvi/sph' (src/force.cpp:275)\"\nexit 1\n")
    assert front("shield") == 1 and "FAILED: exit status 1; this LAMMPS has no USER-HVI, or an older one: hvi doctor says more" in capsys.readouterr().out


@pytest.mark.parametrize("status, words", [(1, "exit status 1"), (139, "exit status 139 (SIGSEGV)"), (-9, "exit status -9 (SIGKILL: out of memory?)"),
                                           (137, "exit status 137 (SIGKILL: out of memory?)"), (255, "exit status 255")])
def test_status_in_words(status, words):
    assert engine.said_of(status) == words


def test_what_cannot_be(folder, capsys, monkeypatch):
    """one line each: a folder that is a file, a disk that is full, LAMMPS that is no program, mpirun that is not there"""
    (folder / "file").write_text("")
    assert front("shield", "--runs", "file") == 1 and "Not a directory" in capsys.readouterr().err
    assert front("shield", "--lmp", "emi.yaml") == 1 and "emi.yaml cannot be executed: run make first, or give --lmp FILE" in capsys.readouterr().err
    assert cli.main(["shield", "emi.yaml", "--mpirun", "./none"]) == 1 and "./none is not there: install MPI" in capsys.readouterr().err
    monkeypatch.setenv("FAKE_FAIL", "dx-0.2_shift-0.0")
    monkeypatch.setattr(engine, "FULL", float("inf"))
    assert front("shield") == 1 and "dx-0.2_shift-0.0  FAILED: exit status 1; the disk is full" in capsys.readouterr().out

    def full(*_):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr(engine, "write_table", full)
    assert front("shield", "--runs", "r") == 1 and "r/emi/runs.csv: No space left on device\n" in capsys.readouterr().err
    monkeypatch.setattr(script.Shield, "copy_to", full)
    assert front("shield") == 1
    said = capsys.readouterr().err
    assert "hvi: cannot run in " in said and "dx-0.2_shift-0.0: No space left on device; put that right and call again to go on\n" in said


def test_two_calls_at_once(folder, capsys):
    """on the same case they share the runs; another case in the same folder takes the results away, and no verdict is made of what is left"""
    first = subprocess.Popen(COMMAND, cwd=folder, env={**os.environ, "FAKE_SLEEP": "0.5"}, stdout=subprocess.DEVNULL)
    second = subprocess.Popen(COMMAND, cwd=folder, env={**os.environ, "FAKE_SLEEP": "0.5"}, stdout=subprocess.DEVNULL)
    assert (first.wait(timeout=60), second.wait(timeout=60)) == (3, 3)
    assert [path.read_text().split().count("no") for path in folder.glob("runs/**/tries")] == [1] * 4  # each is begun once
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", "speed_km_s: 7"))
    first = subprocess.Popen(COMMAND, cwd=folder, env={**os.environ, "FAKE_SLEEP": "2"}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    last = folder / "runs/emi/dx-0.2_shift-0.5"
    wait_for(lambda: (engine.read_yaml(last / "job.yaml") or {}).get("variables", {}).get("v0") == 7000 and not (last / "result.yaml").exists())  # those of 0.4 mm are done
    (folder / "emi.yaml").write_text(change("speed_km_s: 7.1", "speed_km_s: 6"))
    assert front("shield", "--jobs", "4") == 3
    assert "its result is gone or of another case" in first.communicate(timeout=60)[1] and first.returncode == 1
    assert yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())["verdict"] == "fails"


def test_a_result_written_by_two_at_once(tmp_path):
    """both are written whole, the last one stays, and nothing else does, also where one is given up"""
    path = tmp_path / "verdict.yaml"
    with texts.whole(path) as first:
        first.write("verdict: ")
        engine.write_yaml(path, {"verdict": "holds"})
        first.write("fails\n")
        first.flush()
        assert path.read_text() == "verdict: holds\n"
    assert path.read_text() == "verdict: fails\n"
    with pytest.raises(KeyboardInterrupt), texts.whole(path) as given_up:
        given_up.write("verdict: ")
        raise KeyboardInterrupt
    assert path.read_text() == "verdict: fails\n" and list(tmp_path.iterdir()) == [path]
    with pytest.raises(OSError, match="none/verdict.yaml'$"):
        engine.write_yaml(tmp_path / "none/verdict.yaml", {})


def test_half_a_file_of_a_call_that_was_killed(tmp_path):
    """goes with the next result of its name; those that may still be written to, and of other names, stay"""
    old, fresh, other, foreign = (tmp_path / f"{name}.new" for name in ("verdict.yaml." + 32 * "0", "verdict.yaml." + 32 * "1", "limit.yaml." + 32 * "0", "verdict.yaml.mine"))
    for half in (old, fresh, other, foreign):
        half.write_text("verd")
    for half in (old, other, foreign):
        os.utime(half, (time.time() - 2 * texts.ABANDONED,) * 2)
    engine.write_yaml(tmp_path / "verdict.yaml", {"verdict": "holds"})
    assert sorted(tmp_path.iterdir()) == sorted([tmp_path / "verdict.yaml", fresh, other, foreign])


def test_next_finer(folder, capsys):
    """an undecided verdict says which spacing would be next, and what it costs; one that is decided does not"""
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", "diameter_mm: 4.3"))
    assert front("shield") == 4
    # 6 layers of 0.2 mm in 1.2 mm: 8 of 0.15, as 7 are no 1.2 times finer; 2 runs of 625 core-seconds become (0.2 / 0.15)^4 times as long
    assert "\nnext finer: spacings_mm: [0.2, 0.15]: 2 more runs, those of the finest spacing stay; about 4000 core-seconds\ntable: " in capsys.readouterr().out
    assert yaml.safe_load((folder / "runs/emi/verdict.yaml").read_text())["next_finer"] == {"spacings_mm": [0.2, 0.15], "runs": 2, "core_s": 4000.0}
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", "diameter_mm: 4.3").replace("[0.2, 0.4]", "[0.2, 0.15]"))
    before = tries(folder)
    front("shield")
    assert "4 runs, 2 done before, 2 to run" in capsys.readouterr().out and {name: tries(folder)[name] for name in before} == before
    (folder / "emi.yaml").write_text(change("diameter_mm: 5", "diameter_mm: 4.3").replace("gap_mm: 60", "gap_mm: 60\n    spacings_mm: [0.3, 0.4]"))
    assert front("shield") == 4
    assert "next finer: spacings_mm: [0.2, 0.16], wall 2: spacings_mm: [0.3, 0.24]: 2 more" in capsys.readouterr().out
    (folder / "emi.yaml").write_text(change("[0.2, 0.4]", "[0.8]").replace("1.2\n", "1.5\n"))  # 2 layers are too few: 3, and 4; 2.44 core-seconds each
    assert front("shield") == 4
    assert "next finer: spacings_mm: [0.5, 0.375]: 4 runs, with the remedies above; about 130 core-seconds\n" in capsys.readouterr().out
    (folder / "emi.yaml").write_text(change("[0.2, 0.4]", "[0.401]"))  # 3 layers, but for round-off
    assert front("shield") == 4
    assert "next finer: spacings_mm: [0.401, 0.3]: 2 more runs, those of the finest spacing stay" in capsys.readouterr().out
    (folder / "emi.yaml").write_text(CASE)
    assert front("shield") == 3 and "next finer" not in capsys.readouterr().out
    (folder / "emi.yaml").write_text(CASE + "not_modelled: [MLI]\n")
    assert front("shield") == 4 and "next finer" not in capsys.readouterr().out


def test_next_finer_of_undecided_runs(folder, capsys, monkeypatch):
    """their remedies come first, and they are run again"""
    monkeypatch.setenv("FAKE_UNSURE", "9")
    assert front("shield") == 4
    # 1250 core-seconds of two runs, again and (0.2 / 0.15)^4 times
    assert "next finer: spacings_mm: [0.2, 0.15]: 4 runs, with the remedies above; about 5200 core-seconds\n" in capsys.readouterr().out


def test_one_seed(folder, capsys):
    (folder / "emi.yaml").write_text(CASE + "settings: {solid: damage yes spall voids weibull 12 4711}\n")
    assert front("shield") == 3
    assert capsys.readouterr().err == "hvi: warning: emi.yaml, line 13: all runs have the same seed of weibull: what another would change is in no verdict\n"
