"""python3 -m hvi doctor: each thing that may be missing is a line WRONG with its remedy, and the exit status 1; LAMMPS is a script here, but for one test."""

import importlib.metadata
import os
import pathlib
import re
import shutil

import pytest
from hvi import cli
from hvi.commands import doctor
from hvi.jobs import lammps, machine
from hvi.material import library

HELP = "\\nLarge-scale Atomic/Molecular Massively Parallel Simulator - 4 Feb 2025\\n\\nMPI v3.1: Open MPI v4.1.4, package: x\\n\\n* Pair styles:\\n\\nlj/cut {}\\n"
STYLES = " ".join(lammps.STYLES)


@pytest.fixture(autouse=True)
def scene(monkeypatch, tmp_path):
    """an empty PATH but for programs of the system that LAMMPS is not among, and no settings"""
    for name in ("HVI_LMP", "LAMMPS_POTENTIALS"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "bin").mkdir()
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:/usr/bin:/bin")
    monkeypatch.setattr(lammps, "PROGRAMS", ("lmp-of-nobody",))
    monkeypatch.setattr(lammps, "ROOT", tmp_path / "tree")


def program(name, text):
    path = pathlib.Path("bin", name).absolute()
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return str(path)


def fake(styles=STYLES, ranks="$HVI_FAKE_RANKS", help=HELP, name="lmp"):
    """LAMMPS: what it is, and in a run how many ranks it sees"""
    return program(name, f"case \"$*\" in *-help*) printf '{help.format(styles)}';; *) echo '{doctor.MARK}' {ranks};; esac")


def mpirun(text="HVI_FAKE_RANKS=$2; export HVI_FAKE_RANKS; shift 2; exec \"$@\"", version="mpirun (Open MPI) 4.1.4"):
    return program("mpirun", f"case \"$*\" in --version) echo '{version}'; exit;; esac\n{text}")


@pytest.fixture
def ask(capsys):
    def call(*words):
        """(exit status, {what: (ok or WRONG, text)}, what is printed); of several lines on a thing the first that is wrong, or the last"""
        status = cli.main(["doctor", *map(str, words)])
        out, err = capsys.readouterr()
        rows = [re.fullmatch(r"(ok   |WRONG)  (.{10,}?)  (.+)", line) for line in out.splitlines()]
        found = {}
        for row in filter(None, rows):
            if found.get(row[2].strip(), ("ok",))[0] == "ok":
                found[row[2].strip()] = row[1].strip(), row[3]
        bad = [what for what, (state, _) in found.items() if state == "WRONG"]
        assert status == bool(bad) and err == (f"hvi: WRONG: {', '.join(bad)}\n" if bad else "") and all(rows[:-1]) and bool(rows[-1]) == bool(bad)
        return status, found, out
    return call


def test_all_is_there(ask):
    mpirun()
    status, found, out = ask("--lmp", fake())
    assert status == 0 and found["LAMMPS"] == ("ok", f"{os.path.realpath('bin/lmp')}, version 4 Feb 2025")
    assert found["a run"][1].startswith("of 2 ranks and Al6061-T6.hvi ends well") and found["mpirun"][1].endswith("bin/mpirun, Open MPI 4.1.4")
    assert {"lammps-hvi", "Python", "numpy", "scipy", "matplotlib", "PyYAML", "tqdm", "Pillow", "MDAnalysis", "pandas", "meshio", "materials", "disk", "machine"} <= set(found)
    assert found["numpy"][1] == importlib.metadata.version("numpy") and re.fullmatch(r"\d+ cores?, [\d,]+ MB of memory free", found["machine"][1])
    last = out.splitlines()[-1]
    assert last.startswith("all is there; to begin with: python3 -m hvi shield ")
    assert cli.parse(last.partition("python3 -m hvi ")[2].split()).command == "shield" and os.path.isfile(last.partition(" shield ")[2].split()[0])


def test_the_real_one(ask, request, monkeypatch):
    """with an MPI that starts it; its styles are those that doctor asks for"""
    monkeypatch.undo()
    _, found, _ = ask("--lmp", request.getfixturevalue("lmp_exe"))
    assert found["LAMMPS"][0] == found["USER-HVI"][0] == found["mpirun"][0] == found["a run"][0] == "ok", found


def test_no_lammps(ask, monkeypatch):
    """it says where it looked; a LAMMPS on PATH without the package is none"""
    mpirun()
    _, found, _ = ask()
    assert found["LAMMPS"] == ("WRONG", f"no LAMMPS with USER-HVI, looked for --lmp, HVI_LMP, {pathlib.Path('tree/build/lmp').absolute()}, lmp-of-nobody on PATH: "
                               "run make, or set HVI_LMP or --lmp to the program")
    assert "USER-HVI" not in found and "a run" not in found
    stock = fake("sph", name="lmp-of-nobody")
    assert f"{stock}, which has no USER-HVI: run make" in ask()[1]["LAMMPS"][1]
    good = fake(name="lmp-of-nobody")
    assert ask()[1]["LAMMPS"] == ("ok", f"{good}, version 4 Feb 2025")
    monkeypatch.setenv("HVI_LMP", "nowhere/lmp")
    assert ask()[1]["LAMMPS"] == ("WRONG", "nowhere/lmp (it is HVI_LMP) does not exist: run make first, or give --lmp FILE")
    pathlib.Path("text").write_text("")
    assert ask("--lmp", "text")[1]["LAMMPS"] == ("WRONG", "text cannot be executed: run make first, or give --lmp FILE")


def test_what_is_no_lammps(ask):
    mpirun()
    assert "-help says no version (" in ask("--lmp", "/bin/true")[1]["LAMMPS"][1]
    broken = program("lmp", "echo 'error while loading shared libraries: libmpi.so.40' >&2; exit 127")
    assert "(error while loading shared libraries: libmpi.so.40): it is no LAMMPS, or cannot start on this machine" in ask("--lmp", broken)[1]["LAMMPS"][1]


def test_lammps_without_the_package(ask):
    """none of its styles, or not all"""
    mpirun()
    _, found, _ = ask("--lmp", fake("sph"))
    assert found["USER-HVI"] == ("WRONG", f"{os.path.realpath('bin/lmp')} has none of its styles: it is another LAMMPS; run make and take build/lmp, or set HVI_LMP to it") and "a run" not in found
    _, found, _ = ask("--lmp", fake(STYLES.replace("hvi/wall", "hvi/walls")))
    assert found["USER-HVI"][0] == "WRONG" and "has no style hvi/wall: it is of an older package; run make" in found["USER-HVI"][1]


def test_sources_that_are_newer(ask, monkeypatch):
    """than the program that the tree has built; another build is left alone"""
    mpirun()
    tree = pathlib.Path("tree").absolute()
    (tree / "src/USER-HVI").mkdir(parents=True)
    (tree / "lib").mkdir()
    (tree / "build").mkdir()
    monkeypatch.setattr(doctor, "ROOT", tree)
    shutil.copy(fake(), tree / "build/lmp")
    source = tree / "src/USER-HVI/a.cpp"
    source.write_text("")
    made = (tree / "build/lmp").stat().st_mtime
    os.utime(source, (made - 10, made - 10))
    assert ask()[0] == 0
    os.utime(source, (made + 10, made + 10))
    assert ask()[1]["USER-HVI"] == ("WRONG", f"{tree}/build/lmp is older than src/USER-HVI/a.cpp: run make")
    assert ask("--lmp", fake())[0] == 0


def test_mpi_of_another_kind(ask):
    """each rank is a run of its own: mpirun is not that of the program's MPI"""
    mpirun("HVI_FAKE_RANKS=1; export HVI_FAKE_RANKS; shift 2; \"$@\"; \"$@\"", version="HYDRA build details:\n    Version:  4.0.2")
    _, found, _ = ask("--lmp", fake())
    assert found["mpirun"][1].endswith("MPICH 4.0.2")
    assert found["a run"] == ("WRONG", "mpirun starts 2 runs of one rank each: it is of MPICH 4.0.2, LAMMPS of Open MPI 4.1.4; give the mpirun of that MPI with --mpirun, or build LAMMPS anew")


def test_runs_that_stop(ask):
    """what LAMMPS, or mpirun, says"""
    mpirun("echo 'LAMMPS (4 Feb 2025)'; echo 'ERROR: Cannot find material file'; echo after; exit 1")
    assert "of 2 ranks stops: ERROR: Cannot find material file (Open MPI 4.1.4, LAMMPS built with Open MPI 4.1.4)" in ask("--lmp", fake())[1]["a run"][1]
    mpirun("echo 'There are not enough slots available'; exit 1")
    assert "stops: There are not enough slots available (" in ask("--lmp", fake())[1]["a run"][1]
    assert ask("--lmp", fake(), "--mpirun", "./none")[1]["mpirun"] == ("WRONG", "./none is not there: install MPI, or give --mpirun FILE")


@pytest.mark.parametrize("text, found", [
    ("mpirun (Open MPI) 4.1.4\n", ("Open MPI", "4.1.4")), ("MPI v3.1: Open MPI v5.0.3, package: Open", ("Open MPI", "5.0.3")), ("mpirun (Open MPI) 5.0.0rc9", ("Open MPI", "5.0.0")),
    ("HYDRA build details:\n    Version:                                 4.0.2\n", ("MPICH", "4.0.2")), ("MPI v4.0: MPICH Version:\t4.1.2\nMPICH Release date", ("MPICH", "4.1.2")),
    ("Intel(R) MPI Library for Linux* OS, Version 2021.9 Build 20230307", ("Intel MPI", "2021.9")), ("MPI v1.0: LAMMPS MPI STUBS for LAMMPS version 4 Feb 2025", ("MPI STUBS", "")), ("usage: mpirun", None)])
def test_which_mpi(text, found):
    assert lammps.mpi(text) == found


def test_packages(ask, monkeypatch):
    """one that is needed and not there, broken or too old is wrong; one that is not needed may be missing, but not be broken"""
    real = doctor.importlib.import_module

    def without(name, *package):
        if name == "scipy":
            raise ImportError("numpy.core.multiarray failed to import")
        if name in ("yaml", "pandas"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        if name == "meshio":
            raise ModuleNotFoundError("No module named 'lxml'", name="lxml")
        return real(name, *package)
    mpirun()
    monkeypatch.setattr(doctor.importlib, "import_module", without)
    monkeypatch.setitem(doctor.NEEDED, "numpy", ("numpy", (99, 1)))
    _, found, _ = ask("--lmp", fake())
    remedy = "Debian's python3-{0}, or pip install {1}; HVI_PYTHON names another Python"
    assert found["scipy"] == ("WRONG", "cannot be imported (numpy.core.multiarray failed to import): " + remedy.format("scipy", "scipy"))
    assert found["PyYAML"] == ("WRONG", "not there: " + remedy.format("yaml", "PyYAML"))
    assert found["numpy"] == ("WRONG", f"{importlib.metadata.version('numpy')}, 99.1 or later is needed: " + remedy.format("numpy", "numpy"))
    assert found["pandas"] == ("ok", "not there, only for dataframe(): Debian's python3-pandas, or pip install pandas")
    assert found["meshio"] == ("WRONG", "needs lxml, which is not there, only for STL files, hvi mesh --import: Debian's python3-meshio, or pip install meshio")


def test_needed_packages_are_those_of_the_wheel(root):
    project = (root / "python/pyproject.toml").read_text()
    needed = dict(re.findall(r'"([\w]+)(?:>=([\d.]+))?"', re.search(r"^dependencies = (.*)", project, re.M)[1]))
    assert needed == {**{name: ".".join(map(str, oldest)) for name, oldest in doctor.NEEDED.values()}, "tqdm": ""}
    assert f'requires-python = ">={".".join(map(str, cli.OLDEST))}"' in project
    launcher = (root / "python/bin/hvi").read_text()
    assert all(f'("{name}", "{module}")' in launcher for module, (name, _) in doctor.NEEDED.items()) and f"sys.version_info < {cli.OLDEST}" in launcher
    debian = re.search(r'^python="(.*)"', (root / "cmake/deps.sh").read_text(), re.M)[1].split()
    assert {"python3-numpy", "python3-scipy", "python3-matplotlib", "python3-yaml", "python3-tqdm", "python3-meshio"} <= set(debian)


def test_materials(ask, monkeypatch):
    mpirun()
    (folder := pathlib.Path("mine")).mkdir()
    (folder / "bad.hvi").write_text("# UNITS: si\neos linear\n  rho0 x\n")
    monkeypatch.setenv("LAMMPS_POTENTIALS", "mine")
    assert ask("--lmp", fake())[1]["materials"] == ("WRONG", "mine/bad.hvi:3: eos linear: rho0: x is not a number")
    monkeypatch.setenv("LAMMPS_POTENTIALS", "gone")
    assert ask("--lmp", fake())[1]["materials"] == ("WRONG", "gone is no folder: it is in LAMMPS_POTENTIALS; correct or unset that")
    monkeypatch.delenv("LAMMPS_POTENTIALS")
    monkeypatch.setattr(library, "POTENTIALS", folder / "none")
    monkeypatch.setattr(doctor, "POTENTIALS", folder / "none")
    assert ask("--lmp", fake())[1]["materials"] == ("WRONG", "mine/none is no folder: install the package again")


def test_room(ask, monkeypatch, tmp_path):
    mpirun()
    monkeypatch.setattr(machine, "free_disk", lambda folder: (12.0, tmp_path))
    monkeypatch.setattr(machine, "free_memory", lambda: 100.0)
    monkeypatch.setattr(machine, "cores", lambda: 1)
    _, found, _ = ask("--lmp", fake())
    assert found["disk"] == ("WRONG", f"12 MB free in {tmp_path}, less than 1000: make room, or give another --runs DIR")
    assert found["machine"] == ("WRONG", "1 core, 100 MB of memory free, less than 500: end other programs")
    monkeypatch.setattr(machine, "free_disk", lambda folder: (1e6, pathlib.Path("/proc")))
    assert ask("--lmp", fake())[1]["disk"] == ("WRONG", "/proc cannot be written: give another --runs DIR")
