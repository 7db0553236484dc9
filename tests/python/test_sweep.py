"""python3 -m hvi sweep runs jobs, goes on where it stopped, survives failures; examples/debris-studies: plot.py draws."""

import csv
import os
import re
import signal
import subprocess
import sys
import time
import types

import hvi
import pytest
import yaml
from hvi import cli
from hvi.jobs import engine, runs
from hvi.jobs import sweep as study_of

# some hundred particles; result.yaml as in the examples; mode: good, or a way to fail; from: what it goes on from
INPUT = """variable n index 5
variable speed index 1.0
variable mode index good
variable from index no
if "${mode} == slow" then "shell sleep 60"
if "${mode} == refused" then "print 'this mode is refused'" "quit 1"
atom_style bond
lattice sc 1.0
region box block 0 $n 0 $n 0 $n
create_box 1 box bond/types 1 extra/bond/per/atom 6
create_atoms 1 box
mass * 1.0
pair_style hvi/contact
pair_coeff * * 0.1 0.890898718
velocity all create ${speed} 4711
fix move all nve
if "${mode} == bad" then "pair_coeff * * nonsense"
run 10
if "${mode} == silent" then "quit 0"
if "${mode} == cut" then "print 'particles: 125' file result.yaml" "quit 0"
print 'particles: $(atoms:%.0f)' file result.yaml
print 'resumed: from ${from}' append result.yaml
print 'package_version: 0.1.0' append result.yaml
"""
STUDY = {"input": "in.tiny", "variables": {"n": 5}, "grid": {"speed": [1.0, 2.0], "mode": ["good"]}}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "in.tiny").write_text(INPUT)
    (tmp_path / "in.plain").write_text(INPUT.replace("variable from index no\n", ""))
    (tmp_path / "in.tiny.continue").write_text("# the second input\n" + INPUT)
    return tmp_path


@pytest.fixture
def sweep(root, folder, lmp_exe):
    """sweep(study, option, ...) -> finished process; the study is a mapping or a text"""
    def run(study, *extra, wait=True):
        (folder / "tiny.yaml").write_text(study if isinstance(study, str) else yaml.safe_dump(study, sort_keys=False))
        command = [sys.executable, "-m", "hvi", "sweep", "tiny.yaml", "--lmp", lmp_exe, "--ranks", "1", *extra]
        process = subprocess.Popen([str(c) for c in command], cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   env={**os.environ, "PYTHONPATH": str(root / "python")})
        if not wait:
            return process
        process.text = process.communicate(timeout=120)[0]
        return process

    return run


def table(folder):
    with open(folder / "runs/tiny.csv", newline="") as f:
        return {row["job"]: row for row in csv.DictReader(f)}


def log_times(folder):
    return {p.parent.name: p.stat().st_mtime_ns for p in folder.glob("runs/tiny/*/log.lammps")}


def test_records_are_measured(sweep, folder, root):
    """a study of examples/spall: pull-back and strength are in its table, as hvi measure puts them into result.yaml"""
    study = {"input": str(root / "examples/spall/in.spall"), "variables": {"n": 8}, "grid": {"v0": [500]}}
    assert sweep(study).returncode == 0
    row = table(folder)["v0-500"]
    result = yaml.safe_load((folder / "runs/tiny/v0-500/result.yaml").read_text())
    assert 0.5 < float(row["spall_strength_GPa"]) < 1.5 and float(row["spall_strength_GPa"]) == result["spall_strength_GPa"]


def test_failed_job_is_reported_and_others_finish(sweep, folder):
    process = sweep({**STUDY, "grid": {"mode": ["bad", "silent", "cut", "good"], "speed": [1.0]}})
    assert process.returncode == 1, process.text
    assert "mode-bad_speed-1.0  FAILED" in process.text and "| ERROR: " in process.text and "nonsense" in process.text
    assert "mode-silent_speed-1.0  FAILED: no complete result.yaml" in process.text
    assert "mode-cut_speed-1.0  FAILED: no complete result.yaml" in process.text
    assert "mode-good_speed-1.0  ok" in process.text
    assert "1 of 4 jobs are done" in process.text
    assert list(table(folder)) == ["mode-good_speed-1.0"]
    assert table(folder)["mode-good_speed-1.0"]["particles"] == "125"


def test_point_of_a_grid_without_variables(sweep, folder):
    """has a folder of its own, not that of all runs; what makes a run done is never removed"""
    process = sweep({**STUDY, "grid": {"shot": [{"speed": 2.0}, {}]}, "remove": ["*.yaml", "log.*"]})
    assert process.returncode == 0 and "2 of 2 jobs are done" in process.text and set(table(folder)) == {"speed-2.0", "as-is"}
    assert (folder / "runs/tiny/.study").is_file() and not log_times(folder)


def test_variable_and_result_of_one_name(folder):
    """the table has both where they differ, as the table on the screen has the result"""
    jobs = [types.SimpleNamespace(name=f"steps-{steps}", variables={"steps": steps, "job": 7, "n": [1, 2]}, result=lambda steps=steps: {"steps": min(steps, 310), "n": [1, 2], "p": 5})
            for steps in (100, 1000)]
    engine.write_table(jobs, folder / "runs/tiny.csv")
    assert list(table(folder).values()) == [
        {"job": "steps-100", "steps_variable": "100", "job_variable": "7", "n": "1; 2", "steps": "100", "p": "5"},
        {"job": "steps-1000", "steps_variable": "1000", "job_variable": "7", "n": "1; 2", "steps": "310", "p": "5"}]


def test_numbers_in_other_digits_do_not_differ(folder):
    """a number is written by LAMMPS in its own way"""
    values = {"1e-3": 0.001, 2.0: 2, "x": "x"}
    jobs = [types.SimpleNamespace(name=f"v-{value}", variables={"v": value, "n": ["1e-3", 2.0]}, result=lambda found=found: {"v": found, "n": [0.001, 2]}) for value, found in values.items()]
    engine.write_table(jobs, folder / "runs/tiny.csv")
    assert list(table(folder).values()) == [{"job": job.name, "v": str(found), "n": "0.001; 2"} for job, found in zip(jobs, values.values())]
    assert engine.same(5, "5.0") and not any(engine.same(*pair) for pair in ((5, 6), ("5", "5 m"), ([1, 2], [1]), ("x", "X"), (1, [1, 1])))


def test_what_an_input_says_is_not_hidden(sweep):
    """an input that ends itself has said why; mpirun's many lines come after that"""
    process = sweep({**STUDY, "grid": {"mode": ["refused"]}})
    assert process.returncode == 1 and "FAILED: exit status 1" in process.text
    assert "    | this mode is refused\n    | see " in process.text


def test_goes_on_where_it_stopped(sweep, folder):
    """two jobs at a time; done jobs are left alone until a variable or the input changes"""
    assert sweep(STUDY, "--jobs", "2").returncode == 0
    first = log_times(folder)
    assert sorted(first) == ["speed-1.0_mode-good", "speed-2.0_mode-good"]
    assert "0 to run" in sweep(STUDY).text
    assert log_times(folder) == first

    # a result that was cut off, and one more point in the grid
    (folder / "runs/tiny/speed-1.0_mode-good/result.yaml").write_text("particles: 125\nener")
    more = {**STUDY, "grid": {"speed": [1.0, 2.0, 3.0], "mode": ["good"]}}
    process = sweep(more)
    assert process.returncode == 0 and "3 jobs, 1 done before, 2 to run" in process.text
    second = log_times(folder)
    assert second["speed-2.0_mode-good"] == first["speed-2.0_mode-good"]
    assert second["speed-1.0_mode-good"] != first["speed-1.0_mode-good"]

    process = sweep({**more, "variables": {"n": 6}})
    assert "0 done before, 3 to run" in process.text
    assert {row["particles"] for row in table(folder).values()} == {"216"}

    (folder / "in.tiny").write_text(INPUT.replace("run 10\n", "run 11\n"))
    assert "0 done before, 3 to run" in sweep({**more, "variables": {"n": 6}}, "--dry-run").text


@pytest.mark.long
def test_goes_on_within_a_job(sweep, folder):
    """by the second input from the newest restart file; not if the variables have changed, and not after a failure"""
    study = {**STUDY, "grid": {"mode": ["good"]}, "restart": "tiny.restart.*", "continue": "in.tiny.continue"}
    job = folder / "runs/tiny/mode-good"
    assert sweep(study).returncode == 0 and table(folder)["mode-good"]["resumed"] == "from no"
    for suffix in "ba":
        (job / f"tiny.restart.{suffix}").write_bytes(engine.END)
        time.sleep(0.02)
    (job / "result.yaml").unlink()
    assert sweep(study).returncode == 0 and table(folder)["mode-good"]["resumed"] == "from tiny.restart.a"
    assert "# the second input" in (job / "log.lammps").read_text()
    (job / "result.yaml").unlink()
    assert sweep({**study, "variables": {"n": 6}}).returncode == 0 and table(folder)["mode-good"]["resumed"] == "from no"
    assert not list(job.glob("tiny.restart.*"))

    study["grid"] = {"mode": ["bad"]}
    assert sweep(study).returncode == 1
    (folder / "runs/tiny/mode-bad/tiny.restart.a").write_bytes(engine.END)
    assert "-in in.tiny.continue" in (text := sweep(study, "--dry-run").text) and "-var from tiny.restart.a" in text
    assert sweep(study).returncode == 1 and not (folder / "runs/tiny/mode-bad/tiny.restart.a").exists()


def test_time_limit_and_interrupt(sweep, folder):
    slow = {**STUDY, "grid": {"mode": ["slow", "good"]}}
    process = sweep(slow, "--timeout", "2")
    assert process.returncode == 1 and "mode-slow  FAILED: stopped after 2 s" in process.text and "mode-good  ok" in process.text

    log = folder / "runs/tiny/mode-slow/log.lammps"
    log.unlink()
    process = sweep(slow, wait=False)
    while not log.exists():
        time.sleep(0.1)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    text = process.communicate(timeout=30)[0]
    assert process.returncode == 130 and "call again to go on" in text
    assert list(table(folder)) == ["mode-good"]  # the table is written all the same
    asleep = [p for p in os.listdir("/proc") if p.isdigit() and working_folder(p) == str(folder / "runs/tiny/mode-slow")]
    assert asleep == []  # no rank is left behind


def test_run_that_writes_nothing(folder, monkeypatch, capsys):
    """is told of, once: files from before its start do not count"""
    job = engine.Job(engine.Input(folder / "in.tiny"), "quiet", {}, folder / "job")
    job.folder.mkdir()

    def said(launched, *files):
        now = time.time()
        job.launched, job.stamp = time.monotonic() - launched, now - launched
        for name, age in files:
            (job.folder / name).touch()
            os.utime(job.folder / name, (now - age, now - age))
        return job.silence()

    assert said(4000, ("in.tiny", 4001)) is None  # nothing runs
    job.process = object()
    assert said(50) is None
    kind, text = said(100, ("in.tiny", 101), ("output.txt", 1))
    assert kind == "not begun" and text.startswith("LAMMPS has not begun after 2 min")
    assert said(100, ("log.lammps", 99)) is said(4000, ("in.tiny", 4001), ("log.lammps", 1700)) is None
    assert said(4000, ("log.lammps", 3000))[1].startswith("nothing written for 50 min")

    class Place:
        here, looks = True, 0

        def begin(self, jobs, say):
            jobs[0].stamp = 0.0

        def ended(self, jobs, say):
            self.looks += 1
            return jobs[:] if self.looks > 3 else []

        def stop(self, jobs):
            pass

    monkeypatch.setattr(runs, "WATCH", 0)
    job.start = time.monotonic()
    assert runs.run(Place(), 1, [job], "test") == []
    assert (text := capsys.readouterr().out).count("quiet: nothing written for 50 min") == 1 and f"see {job.folder}" in text


def working_folder(process):
    try:
        return os.readlink(f"/proc/{process}/cwd")
    except OSError:
        return ""


def test_full_size_and_dry_run(sweep, folder):
    study = {**STUDY, "full": {"variables": {"n": 9}, "grid": {"speed": [5.0]}}}
    process = sweep(study, "--full", "--dry-run")
    (line,) = [line for line in process.text.splitlines() if "mpirun" in line]
    assert "-var n 9 -var speed 5.0 -var mode good" in line
    assert process.returncode == 0 and not (folder / "runs").exists()


@pytest.mark.parametrize("study, message", [
    ("grid: [", "tiny.yaml, line 1: not YAML: "),
    ("- grid", "not a mapping of"),
    ({**STUDY, "input": "in.missing"}, "input in.missing is not there"),
    ({**STUDY, "restart": "tiny.restart.*"}, "restart (files to go on from) and continue (the input that does) are given together"),
    ({**STUDY, "continue": "in.tiny.continue"}, "given together"),
    ({**STUDY, "restart": "tiny.restart.*", "continue": "in.missing"}, "continue in.missing is not there"),
    ({**STUDY, "restart": "tiny.restart.*", "continue": "in.plain", "variables": {}}, "in.plain has no variable 'from'"),
    ({**STUDY, "grids": {}}, "unknown key grids"),
    ({**STUDY, "grid": {"speed": 1.0}}, "speed must be a list"),
    ({**STUDY, "grid": {}}, "nothing to vary"),
    ({**STUDY, "variables": {"spede": 1.0}}, "in.tiny has no variable 'spede'"),
    ({**STUDY, "grid": {"speed": [1.0, 1.0]}}, "the same job twice"),
    ({**STUDY, "grid": {"shot": [{"speed": 1.0, "n": 5}, {"speed": 2.0}], "speed": [3.0]}}, "tiny.yaml: grid: more than one axis sets speed: set it in one of them"),
])
def test_wrong_study(sweep, study, message):
    process = sweep(study)
    assert process.returncode == 1 and message in process.text and "Traceback" not in process.text


@pytest.mark.parametrize("value", ["yes", "off", "~", "010", "1:30", "1_000", "2026-11-27", "0x10"])
def test_values_reach_lammps_as_they_are_written(folder, value):
    """YAML 1.1 reads these as true, null, 8, 90, ...: they need quotes"""
    text = "input: in.tiny\nvariables: {{n: 5}}\ngrid:\n  mode: [good, {}]\n"
    (folder / "s.yaml").write_text(text.format(value))
    with pytest.raises(hvi.HVIError, match=f"line 4: {re.escape(value)} would reach LAMMPS as another word: write it in quotes"):
        study_of.Study(folder / "s.yaml")
    (folder / "s.yaml").write_text(text.format(f"'{value}'"))
    assert study_of.Study(folder / "s.yaml").cases == [{"mode": "good"}, {"mode": value}]
    (folder / "s.yaml").write_text(text.format("good2") + f"full: {{variables: {{n: {value}}}}}\n")
    with pytest.raises(hvi.HVIError, match="line 5: .* would reach LAMMPS"):
        study_of.Study(folder / "s.yaml")


def test_numbers_are_read_as_lammps_reads_them(folder):
    (folder / "s.yaml").write_text("input: in.tiny\ngrid: {speed: [1, 2.50, -3e-3, .5, 1.0e+3, 0]}\n")
    assert [case["speed"] for case in study_of.Study(folder / "s.yaml").cases] == [1, 2.5, "-3e-3", 0.5, 1000.0, 0]  # YAML 1.1 takes -3e-3 for a text


def test_files_that_the_input_names(folder):
    """a run is done only while these are as they were; what the run itself has written does not matter"""
    (folder / "in.tiny").write_text(INPUT + "variable material index mine.hvi # other.hvi\nread_data ../../plate.data &\n  add append\npair_coeff * * file ${material}\n")
    (folder / "s.yaml").write_text(yaml.safe_dump({**STUDY, "input": "in.tiny"}))

    def files():
        return study_of.Study(folder / "s.yaml").jobs(folder / "runs")[0].record.get("files")

    assert files() is None
    job = folder / "runs/s/speed-1.0_mode-good"
    job.mkdir(parents=True)
    (folder / "runs/plate.data").write_text("a")
    (job / "mine.hvi").write_text("b")
    assert files() == {"../../plate.data": engine.digest(b"a")}
    (folder / "runs/plate.data").write_text("c")
    assert files() == {"../../plate.data": engine.digest(b"c")}
    (folder / "in.tiny").write_text((folder / "in.tiny").read_text().replace("mine.hvi", "Cu-OFHC.hvi"))
    assert set(files()) == {"../../plate.data", "Cu-OFHC.hvi"}
    (folder / "tabled.hvi").write_text("# UNITS: si\neos table\n  file ../../../some.table  # sesame\nstrength perfect\n")
    (folder / "some.table").write_text("1")
    (folder / "in.tiny").write_text(INPUT + "variable plate index x.data\nvariable material index other.hvi\nread_data '${plate}'\npair_coeff * * file ${material}\n")
    (folder / "s.yaml").write_text(yaml.safe_dump({**STUDY, "variables": {"plate": "../../plate.data", "material": str(folder / "tabled.hvi")}}))
    assert set(files()) == {"../../plate.data", str(folder / "tabled.hvi"), "../../../some.table"}
    (folder / "in.tiny").write_text(INPUT + "variable where index /nowhere\ninclude ${where}/in.more\n")
    (folder / "in.more").write_text("run 1\n")
    (folder / "s.yaml").write_text(yaml.safe_dump({**STUDY, "variables": {"where": str(folder)}}))
    assert files() == {f"{folder}/in.more": engine.digest(b"run 1\n")}
    (folder / "s.yaml").write_text(yaml.safe_dump({**STUDY, "variables": {"mode": "../../plate.data"}, "grid": {"speed": [1.0]}}))
    assert files() is None  # what is not read may be written
    (folder / "in.tiny").write_text(INPUT + "pair_coeff 1 1 eos table ../../../some.table &\n  h 1\n")
    assert files() == {"../../../some.table": engine.digest(b"1")}


def test_comments_are_no_commands(folder):
    """LAMMPS joins lines before it looks for comments, and # in quotes is none"""
    (folder / "in.tiny").write_text("# variable a index 1\nvariable b index '#' 2\nprint '#' # &\nvariable c index 3\nvariable d index 4 &\n 5 # 6\nread_data x # y\n")
    assert engine.Input(folder / "in.tiny").known == {"b": True, "d": True}
    (folder / "in.tiny").write_text("variable a index 1\nhvi/variables known a # b\n")
    assert engine.Input(folder / "in.tiny").known == {"a": False}


def test_variables_without_a_value(folder):
    (folder / "s.yaml").write_text("input: in.tiny\nvariables:\ngrid: {speed: [1]}\n")
    assert study_of.Study(folder / "s.yaml").fixed == {}
    (folder / "s.yaml").write_text("input: in.tiny\nvariables: {n: }\ngrid: {speed: [1]}\n")
    with pytest.raises(hvi.HVIError, match="line 2: a variable without a value"):
        study_of.Study(folder / "s.yaml")


def test_wrong_options(sweep):
    assert "no full size" in sweep(STUDY, "--full").text
    assert "mpi-of-nowhere is not there" in sweep(STUDY, "--mpirun", "mpi-of-nowhere").text
    assert "/nowhere does not exist" in sweep(STUDY, "--lmp", "/nowhere").text


def test_studies_are_right(root, folder, lmp_exe, capsys):
    """the studies of the example name variables that in.debris has, at both sizes"""
    for study in (root / "examples/debris-studies/studies").glob("*.yaml"):
        for size in ([], ["--full"] if "\nfull:" in study.read_text() else []):
            assert cli.main(["sweep", str(study), "--lmp", str(lmp_exe), "--dry-run", *size]) == 0, f"{study} {size}: {capsys.readouterr()}"


def test_plots(root, folder):
    """all figures and tables can be drawn from the tables that are kept in results"""
    plot = [sys.executable, root / "examples/debris-studies/plot.py"]
    done = subprocess.run([*plot, "--out", folder], cwd=folder, text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    for name in ("convergence", "parameters", "thickness", "fragmentation", "sensitivity"):
        assert (folder / f"{name}.png").stat().st_size > 5000
    assert done.stdout.count("\n|---|") == 9  # seven studies, two of them with a table for each lattice
    nothing = subprocess.run([*plot, "--tables", folder], cwd=folder, text=True, capture_output=True)
    assert nothing.returncode == 1 and "run hvi sweep first" in nothing.stderr


def test_debris_cloud_in_a_sweep(sweep, root, folder):
    """the example itself, with 600 particles: the keys that the figures need are there and make sense"""
    study = {"input": str(root / "examples/debris-cloud/in.debris"), "variables": {"tstop": 1.5, "frames": 1, "layers": 3, "Rplate": 8},
             "grid": {"lattice": ["sc"]}, "remove": ["debris.restart.*", "*.dump"]}
    process = sweep(study)
    assert process.returncode == 0, process.text
    (row,) = table(folder).values()
    assert row["plate_layers"] == "3" and float(row["particles"]) < 1000
    assert 0 < float(row["projectile_largest_fragment_mass_fraction"]) <= 1
    assert 0.5 < float(row["axial_velocity_ratio_displacement"]) < 1.5
    assert float(row["displacement_from_us"]) == pytest.approx(1.125, abs=0.1)
    assert not list(folder.glob("runs/tiny/*/*.dump"))


def test_inputs_of_the_debris_cloud_are_straight(root):
    """no label, jump or condition; at most 90 lines; the second has the same variables, spacings, box and rest"""
    first, second, rest = ((root / "examples/debris-cloud" / name).read_text() for name in ("in.debris", "in.debris.continue", "legs.debris"))
    for text in (first, second, rest):
        assert not re.findall(r"^\s*(label|jump|next|if|quit|clear|shell)\b", text, re.M) and text.isascii()
        assert len(text.splitlines()) <= 90
    at_top = [line for line in second.splitlines() if " index " in line and " from " not in line]
    assert len(at_top) == 15 and [line for line in at_top if line not in first.splitlines()] == []
    begin, end = "# spacings", "binsize $(1.3*v_req)\n"
    assert first[first.index(begin):first.index(end)] == second[second.index(begin):second.index(end)]
    assert first.count("include ") == 1 and re.findall(r"^include +(\S+)", second, re.M) == ["${out}/debris.front", "legs.debris"]


def reach_of(log):
    """of the first neighbor lists"""
    return set(re.findall(r"ghost atom cutoff = (\S+)", log.read_text()))


@pytest.mark.long
def test_debris_cloud_goes_on(sweep, root, folder):
    """by in.debris.continue, from a restart file of the impact and one of the flight, before the front is noted and after: the same cloud"""
    example = root / "examples/debris-cloud"
    study = {"input": str(example / "in.debris"), "variables": {"N": 2000, "keep": 2040}, "grid": {"lattice": ["sc"]},
             "restart": "debris.restart.*", "continue": str(example / "in.debris.continue"), "remove": ["*.png"]}
    assert sweep(study).returncode == 0
    (whole,) = table(folder).values()
    job = folder / "runs/tiny/lattice-sc"
    begun, reach = hvi.Dump(job / "debris.dump"), reach_of(job / "log.lammps")
    assert 4080 < int(whole["steps"]) < 6120  # a: step 2040 of the impact; b: 4080, when the front is noted already
    assert int(whole["particles_left_the_box"]) < 20  # the box grows with the cloud
    a, b, front = ((job / name).read_bytes() for name in ("debris.restart.a", "debris.restart.b", "debris.front"))
    for file, state, noted in (("a", a, b""), ("a", a, front), ("b", b, front)):
        for path in (*job.glob("debris.restart.*"), job / "result.yaml"):
            path.unlink()
        (job / f"debris.restart.{file}").write_bytes(state)
        (job / "debris.front").write_bytes(noted)
        assert sweep(study).returncode == 0, file
        assert f"read_restart debris.restart.{file}\n" in (job / "log.lammps").read_text()
        assert file == "b" or reach_of(job / "log.lammps") == reach
        (row,) = table(folder).values()
        assert all(row[key] == whole[key] for key in ("particles", "plate_layers", "bonds_start", "spacing_mm")), file
        assert int(row["steps"]) == pytest.approx(int(whole["steps"]), rel=0.1) and 12 <= float(row["time_us"]) < 12.3, file
        for key, most in (("energy_ratio", 1e-5), ("bonds_left", 0.01), ("front_velocity_m_s", 0.01), ("hole_diameter_mm", 0.02), ("energy_start_J", 1e-6)):
            assert float(row[key]) == pytest.approx(float(whole[key]), rel=most), key
        assert float(row["axial_velocity_ratio_displacement"]) == pytest.approx(float(whole["axial_velocity_ratio_displacement"]), abs=0.05), file
        assert float(row["momentum_error"]) < 1e-12 and abs(float(row["mass_error"])) < 1e-12, file
        assert 9 <= float(row["displacement_from_us"]) < 9.3 and (not noted or row["displacement_from_us"] == whole["displacement_from_us"])
        went_on = hvi.Dump(job / "debris.dump")
        assert len(went_on) > len(begun) and list(went_on.steps[:len(begun)]) == list(begun.steps), file  # appended to
        begun = went_on
