# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi shield: does the wall hold?  One case at several spacings and shifts of the lattice, one verdict."""

import contextlib
import pathlib
import shlex

from .. import tables
from ..errors import HVIError
from ..io import packed
from ..jobs import engine, lammps, runs
from ..places import program, typed
from ..shield import ble, calibration, chain, script
from ..shield import case as cases
from ..shield.decision import STATUS, decide, finer, job, lines, member_name, members, note_of_pieces, note_of_versions, said_of_finer, shown, verdict
from . import running

EXAMPLES = """  python3 -m hvi shield emi.yaml --dry-run
  python3 -m hvi shield emi.yaml --jobs 2 --ranks 1
  python3 -m hvi shield emi.yaml --write emi"""
INSTEAD = "; --write makes the input for another machine"  # of too large a run


def add_arguments(parser):
    running.add_case(parser)
    parser.add_argument("--write", type=pathlib.Path, metavar="DIR", help="only write in.shield of all runs, complete folders for LAMMPS alone, and say how to run them")
    running.add_runs(parser)


def command(args, ranks):
    """what was asked for, as it is typed"""
    jobs = args.jobs or (1 if args.engine == "local" else None)
    given = (("--runs", args.runs), ("--jobs", jobs), ("--ranks", ranks), ("--lmp", args.lmp))
    more = [f"--{name}={getattr(args, name)}" for name in ("engine", *runs.OF_SLURM) if getattr(args, name)] if args.engine == "slurm" else []
    return shlex.join([*program().split(), "shield", str(args.case), *(str(word) for option, value in given if value for word in (option, value)), *more])


def main(args):
    case = cases.read(args.case)
    if args.write:
        return write(case, args.write, args.lmp)
    folder = args.runs.resolve() / case.name
    if args.dry_run:
        return plan(case, folder, args)
    runner = runs.Runner(args)
    jobs = {member: job(case, member, folder / member_name(case, member)) for member in members(case)}
    (folder / "verdict.yaml").unlink(missing_ok=True)  # that of another case, or of fewer runs
    todo = [j for j in jobs.values() if j.result() is None]
    if todo:
        running.refuse_too_large([(case.name, chain.plan_of(j.shield)) for j in todo], folder, runner.here(len(todo)), INSTEAD)
    print(f"{case.name}: {len(jobs)} runs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    with engine.table_of(jobs.values, folder / "runs.csv"):
        failed = runner.run(todo, case.name)
    if failed:
        print(engine.overview(jobs.values(), shown(case)))
        raise HVIError(f"no verdict: {len(failed)} of {len(jobs)} runs failed: {', '.join(j.name for j in failed)}")
    each = {member: verdict(j) for member, j in jobs.items()}
    said, reasons, notes = decide(case, each)
    notes += note_of_pieces(case, jobs) + note_of_versions(jobs.values())
    further = finer(case, each, jobs) if said == "undecided" else None
    more = {name: value for name, value in (("notes", notes), ("next_finer", further)) if value}
    equations = ble.beside(ble.predictions, case)
    sure = ble.beside(lambda: calibration.read().of_verdict(case, {member: j.result() for member, j in jobs.items()}))
    (folder / "case.yaml").write_text(pathlib.Path(args.case).read_text())
    running.save(folder / "verdict.yaml", {"verdict": said, "reasons": reasons, **more, "runs": {j.name: verdict(j)[0] for j in jobs.values()},
                                           "areal_density_kg_m2": chain.plan_of(jobs[0, case.shifts[0]].shield)["areal_density_kg_m2"],
                                           "calibration": sure, "equations": equations, "core_s": round(sum(j.result().get("core_s", 0) for j in jobs.values()), 1),
                                           "command": command(args, runner.ranks)})
    print(engine.overview(jobs.values(), shown(case)))
    print(f"verdict: {said}")
    print("\n".join([*lines(reasons, notes), *([said_of_finer(case, further)] if further else [])]))
    print(f"table: {folder / 'runs.csv'}, verdict: {folder / 'verdict.yaml'}")
    print("\n".join([*calibration.said_of_verdict(sure), *ble.said(equations)]))
    return STATUS[said]


def plan(case, folder, args):
    """what would be run: particles, areal densities, steps, time and memory of each spacing, from geometry alone; and a sketch"""
    from .. import figures
    from ..figures import sketch

    words = runs.check(args)
    plans = [chain.plan_of(chain.shield_of(case, which, case.shifts[0])) for which in range(len(case.spacings_mm))]
    n = len(case.walls)
    nodes = ["nodes"] if case.method() else []
    keys = ["projectile_particles", *(f"wall{k}_{what}" for k in range(1, n + 1) for what in ("particles", "layers", "areal_density_kg_m2")), "areal_density_kg_m2",
            "tstop_us", "particles", *nodes, "steps", "core_s", "memory_MB", "frames", "frames_MB", "frames_in_report", "disk_MB"]
    print(tables.text(("each run", *(f"dx-{dx:g}" for dx in case.spacings_mm)), [
        (key, *(f"about {tables.number(found[key])}" if key in ("steps", "core_s", "memory_MB", "frames", "frames_MB", "disk_MB") else found[key] for found in plans)) for key in keys]))
    every, local = plans * len(case.shifts), args.engine == "local"
    jobs = min(args.jobs or (1 if local else len(every)), len(every))
    print(f"{len(every)} runs, {len(case.shifts)} of each spacing: {running.said_of_time(case, [found['core_s'] for found in every], jobs, args.ranks or runs.RANKS)}")
    most = "as settings: film says" if case.setting("film") else f"at most {chain.FRAMES + 2} of a run, and {chain.BUDGET / 1e6:.0f} MB, until tstop_us and at the end"
    print(f"frames: {most}; of these the scene in 3D of the report has frames_in_report or more, in {packed.TEXT / 1e6:.0f} MB")
    finest = plans[-1]
    print(tables.text(("wall", "front_mm", "radius_mm", "middle_mm", "struck_at_mm"), [
        (k, case.faces()[k - 1][0], *(finest[f"wall{k}_{what}"] for what in ("radius_mm", "middle_mm", "struck_at_mm"))) for k in range(1, n + 1)]))
    if n <= 20:
        folder.mkdir(parents=True, exist_ok=True)
        for path in figures.save(sketch.draw(case, finest), str(folder / "sketch.png")):
            print(f"sketch: {path}")
    running.refuse_too_large([(case.name, found) for found in every], folder, jobs if local else 0, INSTEAD)
    runs.ask_slurm(words, len(every))
    return 0


def write(case, folder, given=None):
    """inputs of all runs, and how to run them"""
    run = ["mpirun", "-np", "2", "lmp", "-in", script.BEGIN]
    if program() == "hvi":  # whose user has set no paths
        with contextlib.suppress(HVIError):  # runs may be for another machine
            run = [*lammps.environment(), *run[:3], str(lammps.find(given)), *run[4:]]
    for member in members(case):
        chain.check_free(chain.shield_of(case, *member), folder / member_name(case, member))
    for member in members(case):
        where = folder / member_name(case, member)
        chain.write_run(case, *member, where)
        print(f"cd {shlex.quote(str(where))} && {shlex.join(run)} && {shlex.join([*typed(), 'judge', '.'])}")
    return 0
