"""What a run of LAMMPS leaves behind, and runs outside of pytest: executor(), runner() and command_line(). In tests it is the fixture lmp of conftest.py that runs LAMMPS."""

import argparse
import ast
import functools
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import numpy as np

ENV = pathlib.Path(__file__).resolve().parents[2] / "cmake" / "env.sh"


def alone(folder):
    """Environment of a program on one rank: Open MPI starts no daemon for it, which takes three times as long as the rest; folder: its own, as others' would be mixed up."""
    return {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_tmpdir_base": str(folder)}


class Result:
    """What one LAMMPS run left behind.

    stdout, stderr, log: text; returncode; command; cwd (a Path)
    runs: for every run or minimize one dict of NumPy columns; thermo: the last of them
    """

    def __init__(self, command, cwd, returncode, stdout, stderr, log):
        self.command, self.cwd, self.returncode = command, cwd, returncode
        self.stdout, self.stderr, self.log = stdout, stderr, log
        self.runs = read_thermo(log)

    @property
    def thermo(self):
        if not self.runs:
            raise AssertionError("no thermo output in the log\n" + str(self))
        return self.runs[-1]

    @property
    def warnings(self):
        return [line for line in self.log.splitlines() if line.startswith("WARNING")]

    @property
    def error(self):
        """the text of LAMMPS's error line, '' if there is none"""
        found = re.search(r"^ERROR[^:\n]*: *(.*)$", self.log + "\n" + self.stdout, re.M)
        return found.group(1) if found else ""

    def __str__(self):
        return (f"in {self.cwd}: {shlex.join(map(str, self.command))}\nreturn code {self.returncode}\n"
                f"{self.stdout[-6000:]}\n{self.stderr[-3000:]}")


def read_thermo(log):
    """Thermo tables of a log in the default (one) style: a list of {column: array}."""
    runs, names, rows = [], None, []

    def close():
        if names:
            table = np.array(rows, dtype=float).reshape(len(rows), len(names))
            runs.append({n: table[:, i] for i, n in enumerate(names)})

    for line in log.splitlines():
        words = line.split()
        if words and words[0] == "Step":
            close()
            names, rows = words, []
        elif names:
            if line.startswith("Loop time"):
                close()
                names, rows = None, []
            elif len(words) == len(names):
                try:
                    rows.append([float(w) for w in words])
                except ValueError:
                    pass  # a warning between the lines
    close()
    return runs


class Stopped(Exception):
    """a run that ended with an error, did not end, or has numbers that are none; str: what is said of it"""


def executor(exe, folder):
    """lmp(text or Path, nranks=1, vars={}, timeout=600) -> Result; what goes wrong is raised as Stopped; lmp.exe: the program"""
    count = 0

    def lmp(text, nranks=1, vars=None, timeout=600):
        nonlocal count
        count += 1
        infile = text
        if not isinstance(text, pathlib.Path):
            infile = folder / f"in.{count}"
            infile.write_text(text)
        log = folder / f"log.{count}"
        command = [ENV, *(["mpirun", "-np", nranks] if nranks > 1 else []), exe, "-in", infile, "-log", log]
        for name, value in (vars or {}).items():
            command += ["-var", name, *(value if isinstance(value, (list, tuple)) else [value])]
        command = ["timeout", "-k", "5", str(timeout), *map(str, command)]
        quicker = alone(folder / "mpi" / str(count)) if nranks == 1 else {}
        done = subprocess.run(command, cwd=folder, env={**os.environ, **quicker}, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
        r = Result(command, folder, done.returncode, done.stdout, done.stderr, log.read_text() if log.exists() else "")
        if done.returncode:
            raise Stopped(r.error or (f"no end after {timeout} s" if done.returncode in (124, 137) else f"ended with {done.returncode}"))
        return r

    lmp.exe = exe  # for runners of their own
    return lmp


def runner(exe, folder):
    def lmp(text):
        (folder / "in.run").write_text(text)
        command = [str(ENV), str(exe), "-in", "in.run", "-log", "log.run"]
        o = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ)
        r = Result(command, folder, o.returncode, o.stdout, o.stderr, (folder / "log.run").read_text())
        if o.returncode:
            sys.exit(str(r))
        return r

    return lmp


def command_line(doc, scenes, **values):
    """main of a module of scenes, functions scene(lmp, folder, ...): python3 MODULE [--lmp FILE] SCENE NAME=VALUE ..., which prints the numbers of what it returns

    values: objects that a VALUE can name
    """
    def read(text):
        try:
            return values[text] if text in values else ast.literal_eval(text)
        except (ValueError, SyntaxError):
            return pathlib.Path(text).resolve() if text.endswith(".hvi") else text

    scenes = {scene.__name__: scene for scene in scenes}
    a = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=os.environ.get("HVI_LMP", ENV.parents[1] / "build" / "lmp"), type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("scene", choices=scenes)
    a.add_argument("words", nargs="*", metavar="NAME=VALUE", help="arguments of the scene")
    o = a.parse_args()
    words = {name: read(text) for name, _, text in (word.partition("=") for word in o.words)}
    with tempfile.TemporaryDirectory() as folder:
        found = scenes[o.scene](functools.partial(executor(o.lmp, pathlib.Path(folder)), timeout=36000), pathlib.Path(folder), **words)
    print(" ".join(f"{k} {v:.6g}" for k, v in found.items() if isinstance(v, (int, float, np.number))))
