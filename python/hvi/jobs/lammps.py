# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Which LAMMPS runs: given on the command line, by HVI_LMP, built in the source tree, or on PATH; what it is; how MPI starts it."""

import os
import pathlib
import re
import shutil
import subprocess

from ..errors import HVIError
from ..places import ENV, IN_TREE, ROOT

PROGRAMS = ("lmp", "lmp_mpi")  # names on PATH
STYLES = ("hvi/sph", "hvi/johnson-cook", "hvi/dt", "hvi/fem", "hvi/wall", "hvi/atom", "hvi/energy", "hvi/fragment")  # of inputs that are written here
SECONDS = 60  # that LAMMPS may take to say what it is


def environment():
    """words before a command that let mpirun run as root, in containers, with more ranks than cores"""
    if not ENV.is_file():
        return []
    return [str(ENV)] if os.access(ENV, os.X_OK) else ["sh", str(ENV)]


def said(words, **more):
    """what a program prints, whether it likes it or not; "" if it cannot be started or has no end"""
    try:
        return subprocess.run([*environment(), *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              timeout=SECONDS, **more).stdout
    except (OSError, subprocess.TimeoutExpired):
        return ""


def help_of(lmp):
    return said([lmp, "-help"])


def lacks(text):
    """styles that a LAMMPS with this -help does not have; a style stands in a list between blanks"""
    return [style for style in STYLES if style not in text.split()]


def find(given=None):
    """The program, as a whole path, or an HVIError that says where it was looked for; on PATH only one with the package"""
    for name, chosen in (("--lmp", given), ("HVI_LMP", os.environ.get("HVI_LMP"))):
        if chosen:
            return _checked(chosen, "" if name == "--lmp" else " (it is HVI_LMP)")
    built = ROOT / "build" / "lmp"
    if IN_TREE and built.is_file():
        return _checked(built, "")
    looked = ["--lmp", "HVI_LMP", *([str(built)] if IN_TREE else [])]
    for name in PROGRAMS:
        found = shutil.which(name)
        if found and not lacks(help_of(found)):
            return pathlib.Path(found).resolve()
        looked.append(f"{found}, which has no USER-HVI" if found else f"{name} on PATH")
    tree = "run make" if IN_TREE else "run make in the source tree of lammps-hvi and give its build/lmp"
    raise HVIError(f"no LAMMPS with USER-HVI, looked for {', '.join(looked)}: {tree}, or set HVI_LMP or --lmp to the program")


def _checked(path, said_by):
    path = pathlib.Path(path)
    if not os.path.isfile(path):
        raise HVIError(f"{path}{said_by} does not exist: run make first, or give --lmp FILE")
    if not os.access(path, os.X_OK):
        raise HVIError(f"{path}{said_by} cannot be executed: run make first, or give --lmp FILE")
    return path.resolve()


def check_mpirun(mpirun):
    if not shutil.which(mpirun):
        raise HVIError(f"{mpirun} is not there: install MPI, or give --mpirun FILE")


def version(text):
    """of a LAMMPS with this -help, None if it is none"""
    found = re.search(r"Massively Parallel Simulator - (.+)", text)
    return found and found[1].strip()


def mpi(text):
    """(kind of MPI, version) of a LAMMPS with this -help, or of an mpirun with this --version"""
    for pattern, kind in ((r"Open MPI\)? v?(\d+(?:\.\d+)+)", "Open MPI"), (r"open(?:rte|mpi)\S* .*?(\d+(?:\.\d+)+)", "Open MPI"), (r"MPICH (?:Version|version):?\s*(\d+(?:\.\d+)+)", "MPICH"),
                          (r"HYDRA build details:\s+Version:\s+(\d+(?:\.\d+)+)", "MPICH"), (r"Intel\(R\) MPI Library.*?(\d{4}(?:\.\d+)*)", "Intel MPI")):
        if found := re.search(pattern, text, re.S if "HYDRA" in pattern else 0):
            return kind, found[1]
    return ("MPI STUBS", "") if "MPI STUBS" in text else None
