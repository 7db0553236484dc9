# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi doctor: is all there that hvi needs?  A line for each thing, ok or WRONG, with the remedy.  Needs no library itself."""

import importlib
import importlib.metadata
import os
import pathlib
import re
import shlex
import shutil
import sys
import tempfile

from ..errors import HVIError, remedy
from ..jobs import lammps, machine
from ..material import library
from ..places import DATA, EXAMPLE, IN_TREE, POTENTIALS, ROOT, typed
from ..version import version

EXAMPLES = """  python3 -m hvi doctor --lmp build/lmp --runs /scratch/runs
  python3 -m hvi doctor"""

NEEDED = {"numpy": ("numpy", (1, 23)), "scipy": ("scipy", (1, 8)), "matplotlib": ("matplotlib", (3, 5)), "yaml": ("PyYAML", (5, 1))}  # {module: (distribution, oldest version)}
BESIDE = {"tqdm": ("tqdm", "progress bars"), "PIL": ("Pillow", "hvi movie"), "MDAnalysis": ("MDAnalysis", "hvi.open()"), "pandas": ("pandas", "dataframe()"),
          "meshio": ("meshio", "STL files, hvi mesh --import")}
DISK, MEMORY = 1000, 500  # MB: with less even small runs may stop
RANKS = 2
MARK = "hvi doctor: ranks"
INPUT = f"""units si
atom_style sph
atom_modify map array
region box block 0 0.01 0 0.01 0 0.01 units box
create_box 1 box
lattice sc 0.001 origin 0.5 0.5 0.5
create_atoms 1 box
pair_style hvi/sph cubic dissipation riemann
pair_coeff 1 1 file MATERIAL spacing 0.001
fix move all hvi/sph
run 1
variable ranks equal extract_setting(world_size)
print "{MARK} ${{ranks}}"
"""
ALLOY = "Al6061-T6.hvi"


def add_arguments(parser):
    parser.add_argument("--lmp", metavar="FILE", help="LAMMPS with USER-HVI (default: $HVI_LMP, build/lmp of the source tree, or lmp on PATH)")
    parser.add_argument("--mpirun", default="mpirun", metavar="FILE", help="how ranks are started (default: mpirun)")
    parser.add_argument("--runs", type=pathlib.Path, default="runs", metavar="DIR", help="folder where runs would go (default: runs)")


def of_lammps(given):
    """(right, what, text) of the program; its path and -help, None if there is no such LAMMPS"""
    try:
        path = lammps.find(given)
    except HVIError as problem:
        return [(False, "LAMMPS", str(problem))], None, ""
    text = lammps.help_of(path)
    if not lammps.version(text):
        said = " ".join(text.split())[:200] or "nothing"
        return [(False, "LAMMPS", f"{path} -help says no version ({said}): it is no LAMMPS, or cannot start on this machine: run make here, PORTABLE=yes for a copy")], None, ""
    rows = [(True, "LAMMPS", f"{path}, version {lammps.version(text)}")]
    absent = lammps.lacks(text)
    if len(absent) == len(lammps.STYLES):
        rows.append((False, "USER-HVI", f"{path} has none of its styles: it is another LAMMPS; run make and take build/lmp, or set HVI_LMP to it"))
    elif absent:
        rows.append((False, "USER-HVI", f"{path} has no style {', '.join(absent)}: it is of an older package; run make, or set HVI_LMP to a newer one"))
    elif older := changed_since(path):
        rows.append((False, "USER-HVI", f"{path} is older than {older}: run make"))
    else:
        rows.append((True, "USER-HVI", f"has all {len(lammps.STYLES)} styles that inputs of hvi need"))
    return rows, path, text


def changed_since(path):
    """a source of the tree whose build this program is, newer than it; None if there is none"""
    if not IN_TREE or path.parent.parent != ROOT:
        return None
    made = path.stat().st_mtime
    sources = [source for folder in ("src", "lib") for source in sorted((ROOT / folder).rglob("*.*")) if source.suffix in (".h", ".cpp")]
    return next((source.relative_to(ROOT) for source in sources if source.stat().st_mtime > made), None)


def of_mpi(mpirun, path, text):
    """mpirun, and whether the program and it are of one MPI: two ranks know of each other"""
    try:
        lammps.check_mpirun(mpirun)
    except HVIError as problem:
        yield False, "mpirun", str(problem)
        return
    own, other = (lammps.mpi(said) for said in (lammps.said([mpirun, "--version"]), text))
    names = [" ".join(one).strip() if one else "an unknown MPI" for one in (own, other)]
    yield True, "mpirun", f"{shutil.which(mpirun)}, {names[0]}"
    if path is None:
        return
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "in.doctor").write_text(INPUT.replace("MATERIAL", ALLOY))
        words = [mpirun if os.sep not in mpirun else os.path.abspath(mpirun), "-np", RANKS, path, "-in", "in.doctor", "-log", "none"]
        said = lammps.said(words, cwd=folder, env={**os.environ, "LAMMPS_POTENTIALS": os.pathsep.join(map(str, library.potentials()))})
    ranks = [line.split()[-1] for line in said.splitlines() if line.startswith(MARK)]
    if ranks == [str(RANKS)]:
        yield True, "a run", f"of {RANKS} ranks and {ALLOY} ends well; LAMMPS was built with {names[1]}"
    elif ranks and set(ranks) == {"1"}:
        yield False, "a run", f"{mpirun} starts {len(ranks)} runs of one rank each: it is of {names[0]}, LAMMPS of {names[1]}; give the mpirun of that MPI with --mpirun, or build LAMMPS anew"
    else:
        lines = [line.strip() for line in said.splitlines() if line.strip()]
        why = next((line for line in lines if line.startswith("ERROR")), lines[-1] if lines else "nothing is printed, or no end within a minute")
        remedies = "; MPI of mpirun and of LAMMPS differ" if own and other and own != other else ""
        yield False, "a run", f"of {RANKS} ranks stops: {why[:300]} ({names[0]}, LAMMPS built with {names[1]}{remedies})"


def of_python():
    yield True, "Python", f"{sys.executable}, {sys.version.split()[0]}"
    for module, (name, oldest) in NEEDED.items():
        right, text = state_of(module, name)
        if right and tuple(int(part) for part in re.findall(r"\d+", text)[:2]) < oldest:
            right, text = False, f"{text}, {'.'.join(map(str, oldest))} or later is needed"
        yield right, name, text if right else f"{text}: {remedy(module)}; HVI_PYTHON names another Python"
    for module, (name, what) in BESIDE.items():
        right, text = state_of(module, name)
        yield right or text == "not there", name, text if right else f"{text}, only for {what}: {remedy(module)}"


def state_of(module, name):
    """(it can be imported, its version or why not)"""
    try:
        importlib.import_module(module)
    except ModuleNotFoundError as problem:
        return False, "not there" if problem.name == module else f"needs {problem.name}, which is not there"
    except Exception as problem:  # libraries that do not fit each other end in many ways
        return False, f"cannot be imported ({' '.join(str(problem).split())[:200]})"
    try:
        return True, importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return True, "there"


def of_materials():
    for folder in library.potentials():
        own = folder == POTENTIALS
        if not folder.is_dir():
            yield False, "materials", f"{folder} is no folder: " + ("install the package again" if own else "it is in LAMMPS_POTENTIALS; correct or unset that")
            continue
        names = sorted(path for path in folder.iterdir() if path.suffix == ".hvi")
        wrong = []
        for path in names:
            try:
                library.read(path)
            except HVIError as problem:
                wrong.append(str(problem))
        if own and not names:
            wrong.append(f"{folder} has no material files: install the package again")
        yield not wrong, "materials", wrong[0] + (f", and {len(wrong) - 1} more" if len(wrong) > 1 else "") if wrong else f"{len(names)} files in {folder}"


def of_machine(runs):
    disk, there = machine.free_disk(runs)
    try:
        with tempfile.TemporaryFile(dir=there):
            writable = True
    except OSError:
        writable = False
    yield writable and disk >= DISK, "disk", (f"{there} cannot be written: give another --runs DIR" if not writable else
                                              f"{disk:,.0f} MB free in {there}" + ("" if disk >= DISK else f", less than {DISK}: make room, or give another --runs DIR"))
    free, cores = machine.free_memory(), machine.cores()
    yield free is None or free >= MEMORY, "machine", f"{cores} core{'s' * (cores > 1)}" + ("" if free is None else f", {free:,.0f} MB of memory free") + (
        "" if free is None or free >= MEMORY else f", less than {MEMORY}: end other programs")


def main(args):
    wrong, count = [], 0

    def show(rows):
        nonlocal count
        for right, what, text in rows:
            print(f"{'ok' if right else 'WRONG':5}  {what:10}  {text}", flush=True)
            count += 1
            if not right and what not in wrong:
                wrong.append(what)

    show([(True, "lammps-hvi", f"{version()}, {'source tree ' + str(ROOT) if IN_TREE else 'installed in ' + str(DATA.parent)}")])
    rows, path, text = of_lammps(args.lmp)
    show(rows)
    show(of_mpi(args.mpirun, path if rows[-1][0] else None, text))
    show(of_python())
    show(of_materials())
    show(of_machine(args.runs))
    if wrong:
        raise HVIError(f"WRONG: {', '.join(wrong)}")
    print(f"all is there; to begin with: {shlex.join([*typed(), 'shield', str(EXAMPLE)])} --jobs {min(2, machine.cores())} --ranks 1")
    return 0
