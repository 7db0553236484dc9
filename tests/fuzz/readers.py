"""The readers of python/hvi, fed with any bytes: only HVIError may come out, in bounded time and memory.

    python3 tests/fuzz/readers.py KIND FILE    one file
"""

import contextlib
import io
import pathlib
import random
import resource
import signal
import sys
import time
import traceback
import warnings

import mutate
import numpy as np
import seeds

from hvi.errors import HVIError
from hvi.io.data import DataFile
from hvi.io.dump import Dump
from hvi.jobs import sweep
from hvi.material import library
from hvi.model import mesh_import, stl
from hvi.shield import calibration, case, shots

KINDS = {"case": "yaml", "dump": "dump", "data": "data", "material": "hvi", "surface": "stl", "abaqus": "inp", "vtk": "vtk", "shots": "csv", "records": "csv", "study": "yaml"}
SECONDS, BYTES = 10, 2 << 30  # that one file may take


def _case(path):
    for model in (True, False):
        with contextlib.suppress(HVIError):
            found = case.read(path, model)
            found.mapping(), str(found.projectile), found.faces()
            if model:
                found.variables(0, found.shifts[0])


def _dump(path):
    with contextlib.closing(Dump(path)) as dump:
        for k in range(len(dump)):
            with contextlib.suppress(HVIError):
                frame = dump[k]
                frame.flat, frame.planes
                if not np.isfinite(frame.x).all():
                    raise AssertionError("coordinates that are not finite")
                frame.whole(), frame.m


def _data(path):
    data = DataFile(path)
    for read in (lambda: data.bonds, lambda: data.atoms, lambda: data.frame().x):
        with contextlib.suppress(HVIError):
            read()


def _material(path):
    library.row(library.read(path))


def _mesh(path):
    for cells in (None, "STRUCK"):
        with contextlib.suppress(HVIError):
            made, _ = mesh_import.load(path, 2, cells)
            if not all(np.isfinite(block).all() for block in (made.nodes, made.corners)):
                raise AssertionError("coordinates that are not finite")


def _study(path):
    for full in (False, True):
        with contextlib.suppress(HVIError):
            sweep.Study(path, full).jobs(path.parent)


READ = {"case": _case, "dump": _dump, "data": _data, "material": _material, "surface": lambda path: stl.volume(stl.read(path)), "abaqus": _mesh, "vtk": _mesh, "shots": shots.read_list,
        "records": calibration.read, "study": _study}


class TooLong(BaseException):
    """not an Exception: nobody may catch it on the way"""


def _stop(*_):
    raise TooLong(f"more than {SECONDS} s")


def check(kind, path):
    """what is wrong, as text; '' if nothing is"""
    signal.signal(signal.SIGPROF, _stop)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)  # of its own time: others may keep the machine busy
    quiet = io.StringIO()
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet):
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", "invalid value encountered in cast")  # whole numbers made of NaN
            READ[kind](path)
    except HVIError as problem:
        return "" if str(problem).strip() else "an HVIError that says nothing"
    except (Exception, TooLong):
        return traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return ""


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))


def beside(folder):
    """files that others name"""
    (folder / "body.stl").write_text(seeds.STL)
    (folder / "x.table").write_text(seeds.table())
    (folder / "in.test").write_text(seeds.INPUT)


def run(kind, folder, seed, seconds=None, count=None):
    """Mutates files until time or count is over; what was found is in folder, named by the seed. Returns (executions, {where it was raised: seed})"""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    beside(folder)
    texts, words, found, n = seeds.of(kind), seeds.words(kind), {}, 0
    end = time.monotonic() + (seconds or 1e9)
    while n != count and time.monotonic() < end:
        rng = random.Random(f"{kind} {seed} {n}")
        path = folder / f"now.{KINDS[kind]}"
        path.write_bytes(mutate.mutated(rng, texts, words))
        wrong = check(kind, path)
        if wrong:
            frames = [line.strip() for line in wrong.splitlines() if "python/hvi" in line]
            where = f"{frames[-1] if frames else ''} {wrong.strip().splitlines()[-1][:60]}"
            if where not in found:
                found[where] = f"{seed}-{n}"
                path.rename(folder / f"{seed}-{n}.{KINDS[kind]}")
                (folder / f"{seed}-{n}.txt").write_text(wrong)
        n += 1
    return n, found


if __name__ == "__main__":
    limit()
    print(check(sys.argv[1], pathlib.Path(sys.argv[2])) or "nothing is wrong")
