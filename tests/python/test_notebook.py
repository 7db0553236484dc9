"""hvi in notebooks: case in, verdict out; DataFrames; help(); the script of Howto_python runs."""

import concurrent.futures
import os
import pathlib
import pydoc
import re
import signal
import subprocess
import sys

import hvi
import numpy as np
import pytest
import yaml
from front_runs import begun, case_folder, change  # noqa: F401
from hvi.shield.record import UNITS, WALL

ONE = change("shifts: [0, 0.5]", "shifts: [0]")


def ask(case, **more):
    return hvi.verdict(case, mpirun="./mpirun", **more)


def test_verdict_of_a_file(folder):
    """as the command; what was run is not run again; what happens at signals is as before"""
    (folder / "emi.yaml").write_text(ONE)
    handlers = [signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)]
    found = ask("emi.yaml", jobs=2, ranks=1)
    assert (found.verdict, found.name, len(found.runs)) == ("fails", "emi", 2) and found.reasons[0].startswith("both runs say so") and found.runs[0].result["ranks"] == 1
    assert [signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)] == handlers and found.said["command"].endswith("shield emi.yaml --runs runs --jobs 2 --ranks 1")
    before = begun(folder)
    assert ask(folder / "emi.yaml").verdict == "fails" and begun(folder) == before


def test_verdict_of_a_mapping(folder):
    """under a name of its own, as a loop over thickness needs it"""
    case = yaml.safe_load(ONE)
    found = {}
    for thickness in (1.2, 2.4):
        case["walls"][1]["thickness_mm"] = thickness
        found[thickness] = ask(case, name=f"wall-{thickness}", runs="mine")
    assert [answer.verdict for answer in found.values()] == ["fails", "holds"] and found[2.4].case.walls[1].thickness_mm == 2.4
    assert found[1.2].areal_densities[1] == pytest.approx(0.5 * found[2.4].areal_densities[1]) and (folder / "mine/wall-2.4/verdict.yaml").is_file()
    assert found[1.2].margins["hole_mm"] == 5 and found[2.4].margins["hole_mm"] == 0


def test_verdict_with_numbers_of_numpy(folder):
    """as a loop over numpy.linspace has them; a value of another kind is named"""
    case = yaml.safe_load(ONE)
    case["walls"][1]["thickness_mm"], case["speed_km_s"], case["shifts"], case["spacings_mm"] = np.float64(2.4), np.float32(7), (np.int64(0),), np.array([0.2, 0.4])
    found = ask(case, name="numpy")
    assert found.verdict == "holds" and found.case.walls[1].thickness_mm == 2.4 and [run.dx for run in found.runs] == [0.2, 0.4] and found.case.speed_km_s == 7
    with pytest.raises(hvi.HVIError, match="the case has a value that is neither number, text, list nor mapping: .*PosixPath"):
        ask({**case, "settings": {"pair": folder}}, name="numpy")


def test_verdict_leaves_files_of_the_user(folder):
    """RUNS/NAME.yaml is written again only if hvi.verdict() has written it; one with the same case stays as it is"""
    case = yaml.safe_load(ONE)
    assert ask(case, name="again", runs=".").verdict == "fails"
    case["walls"][1]["thickness_mm"] = 2.4
    assert ask(case, name="again", runs=".").verdict == "holds"
    (folder / "emi.yaml").write_text(ONE)
    with pytest.raises(hvi.HVIError, match=r"emi.yaml is there, not written by hvi.verdict\(\), and of another case: take another name"):
        ask(case, name="emi", runs=".")
    assert ask(yaml.safe_load(ONE), name="emi", runs=".").verdict == "fails" and (folder / "emi.yaml").read_text() == ONE


def test_verdict_in_a_thread(folder):
    """where Python sets no handlers of signals"""
    (folder / "emi.yaml").write_text(ONE)
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        assert pool.submit(ask, "emi.yaml").result().verdict == "fails"


@pytest.mark.parametrize("how, message", [
    ({"case": {}}, "a mapping needs a name: its runs are in the folder RUNS/NAME"), ({"case": "emi.yaml", "name": "x"}, "a name is for a mapping"), ({"case": "none.yaml"}, "none.yaml does not exist|cannot read none.yaml"),
    ({"case": "emi.yaml", "jobs": 0}, r"hvi.verdict\(\): argument --jobs: 0 is not a whole number from 1 on"), ({"case": "emi.yaml", "shift": 3}, r"hvi.verdict\(\): unrecognized arguments: --shift=3"),
    ({"case": "emi.yaml", "write": "x"}, "write is for the command line"), ({"case": "emi.yaml", "dry_run": True}, r"hvi.verdict\(\): argument --dry-run: ignored explicit argument"),
    ({"case": {}, "name": "../x"}, "the name '../x' must be that of a folder in runs, without a path"), ({"case": {"speed_km_s": 7}, "name": "half"}, "runs/half.yaml.*is missing")])
def test_wrong_verdicts(folder, how, message):
    """errors are HVIErrors, none ends Python"""
    with pytest.raises(hvi.HVIError, match=message):
        ask(**how)


def test_a_run_that_fails(folder, monkeypatch):
    monkeypatch.setenv("FAKE_FAIL", "dx-0.2")
    with pytest.raises(hvi.HVIError, match="no verdict: 2 of 4 runs failed: dx-0.2"):
        ask("emi.yaml")


def test_run_over_time(folder):
    """columns of pieces.dat by name, in SI, four times a quarter; a number of each wall at each moment"""
    pandas = pytest.importorskip("pandas")
    (folder / "emi.yaml").write_text(ONE)
    run = ask("emi.yaml").runs[0]
    table = run.dataframe()
    assert isinstance(table, pandas.DataFrame) and table.index.name == "time (us)" and list(table.index) == [0.0, run.result["time_us"]] and table.shape[1] == 2 * len(WALL)
    assert table["wall2 spall_mass (kg)"].iloc[-1] == pytest.approx(1e-6 * run.result["wall2_spall_mass_mg"]) == pytest.approx(4e-6)
    assert table["wall2 hole_diameter (m)"].iloc[-1] == 5e-3 and table["wall2 apart_number"].iloc[-1] == 80 and set(UNITS) <= set(WALL)
    (run.folder / "pieces.dat").unlink()
    with pytest.raises(hvi.HVIError, match="cannot read .*pieces.dat"):
        run.dataframe()


def frame():
    return hvi.Frame({"id": np.array([3, 5]), "type": np.array([1, 2]), "x": np.array([0.5, 1.5])})


def test_frame_as_a_table():
    pytest.importorskip("pandas")
    table = frame().dataframe()
    assert table.index.name == "id" and list(table.columns) == ["type", "x"] and table.loc[5, "x"] == 1.5


def test_tables_without_pandas(folder, monkeypatch):
    """an HVIError that says how to get it, whatever is asked"""
    found = ask("emi.yaml")
    monkeypatch.setitem(sys.modules, "pandas", None)
    for one in (found, found.runs[0], frame()):
        with pytest.raises(hvi.HVIError, match=r"^dataframe\(\) needs pandas: Debian's python3-pandas, or pip install pandas$"):
            one.dataframe()


def test_help():
    """has the words that it begins with, and what hvi gives out, with what it is; without MDAnalysis, too, which the error names"""
    text = pydoc.plain(pydoc.render_doc(hvi))
    assert 'hvi.verdict("quick.yaml", jobs=2, ranks=1)' in text and "verdict(case, name=None, runs='runs', **options)" in text and "class Dump" in text and "open = open_universe(" in text
    for name in hvi.__all__:
        said = getattr(hvi, name).__doc__
        assert said and len(said) > 30, name
    code = "import sys; sys.modules['MDAnalysis'] = None; import hvi, pydoc; assert 'class Dump' in pydoc.plain(pydoc.render_doc(hvi)); hvi.open"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env={**os.environ, "PYTHONPATH": str(pathlib.Path(hvi.__file__).parents[1])})
    assert done.returncode == 1 and done.stderr.splitlines()[-1] == "hvi.errors.NotThere: hvi.open needs MDAnalysis: Debian's python3-mdanalysis, or pip install MDAnalysis"


def test_script_of_the_page(root, lmp_exe, tmp_path, monkeypatch):
    """runs from an empty folder, with the numbers of the verdict; the page shows it"""
    for module in ("pandas", "MDAnalysis"):
        pytest.importorskip(module)
    assert ".. literalinclude:: notebook.py" in (root / "doc/src/Howto_python.rst").read_text()
    monkeypatch.setenv("HVI_LMP", str(lmp_exe))
    monkeypatch.setenv("PYTHONPATH", str(root / "python"))
    done = subprocess.run([sys.executable, str(root / "doc/src/notebook.py")], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    found = hvi.answer(tmp_path / "runs/coarse")
    assert f"\n{found!r}\n" in done.stdout and found.verdict in ("fails", "undecided") and len(found.runs) == 2
    assert f"{found.verdict} {found.margins} {sum(found.areal_densities)} kg/m^2" in done.stdout and (tmp_path / "coarse.png").stat().st_size > 10_000
    momentum, hole = map(float, re.search(r"^([\d.e-]+) ([\d.e-]+)$", done.stdout, re.M).groups())
    assert hole == pytest.approx(1e-3 * found.runs[0].result["hole2_diameter_mm"]) and momentum >= found.runs[0].result["wall2_momentum_N_s"] * (1 - 1e-9) > 0
