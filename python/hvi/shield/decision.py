# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi shield: does the wall hold?  One case at several spacings and shifts of the lattice, one verdict."""

import itertools
import math
import pathlib
import shlex
import shutil

import yaml

from .. import tables
from ..errors import HVIError
from ..jobs import engine
from . import ble, chain, elements, geometry, script
from . import case as cases

STATUS = {"holds": 0, "fails": 3, "undecided": 4}  # exit status of each verdict


def members(case):
    """(number of the spacing, shift) of each run of a case, coarse first"""
    return [(which, shift) for which in range(len(case.spacings_mm)) for shift in case.shifts]


def member_name(case, member):
    return engine.job_name({"dx": case.spacings_mm[member[0]], "shift": member[1]})


def job(case, member, folder, name=None, remove=()):
    weight = (case.spacings_mm[0] / case.spacings_mm[member[0]]) ** 4  # particles and steps
    return chain.Job(case, *member, name or member_name(case, member), folder, weight=weight, remove=remove)


def verdict(job):
    """(verdict, reasons, notes) of a run that is done; notes: what is doubtful in a run that fails nevertheless"""
    result = job.result()
    if result is None:
        raise HVIError(f"{job.folder}: its result is gone or of another case: does another call use the same folder? Call again, or take another --runs DIR")
    said = result.get("verdict")
    if said not in STATUS:
        raise HVIError(f"{job.folder / 'result.yaml'}: no verdict, holds, fails or undecided, but {said}")
    return said, *(list(result.get(key) or []) for key in ("reasons", "notes"))


def decide(case, said):
    """(verdict, reasons, notes) of all runs, {member: the same of each}: undecided where they differ."""
    def where(which):
        return f"{case.spacings_mm[which]:g} mm"

    reasons = []
    if len(case.spacings_mm) < 2:
        reasons.append("one spacing only: nothing says how much it matters; give spacings_mm a second, finer one")
    per = {which: {said[which, shift][0] for shift in case.shifts} for which in range(len(case.spacings_mm))}
    for which, found in per.items():
        if len(found) > 1:
            reasons.append(f"the verdict differs over the shift of the lattice at {where(which)}: " + ", ".join(
                f"{said[which, shift][0]} with {shift:g}" for shift in case.shifts))
    if len({frozenset(found) for found in per.values()}) > 1:
        reasons.append("the verdict differs over the spacing: " + ", ".join(f"{' or '.join(sorted(found))} at {where(which)}" for which, found in per.items()))
    if {"holds", "fails"} <= set.union(*per.values()):
        reasons.append("so near the limit finer spacings_mm may decide; python3 -m hvi limit says how near it is")
    finest = len(case.spacings_mm) - 1, case.shifts[-1]
    texts = {}  # why runs are undecided; if all agree on another verdict, what the finest says of it
    for member, (verdict, why, _) in said.items():
        for text in why:
            if verdict == "undecided" or not reasons and member == finest:
                texts.setdefault(text, []).append(member_name(case, member))
    told = [f"{text} ({', '.join(names)})" for text, names in texts.items()]
    if reasons or per[0] == {"undecided"}:
        return "undecided", reasons + told, []
    (verdict,) = per[0]
    notes = [f"{text} ({member_name(case, finest)})" for text in said[finest][2]]
    return verdict, [f"all {len(said)} runs say so: spacings of {', '.join(f'{dx:g}' for dx in case.spacings_mm)} mm, "
                     f"{len(case.shifts)} shift{'s' if len(case.shifts) > 1 else ''} of the lattice", *told], notes


def finer(case, said, jobs):
    """What would say more, as keys of the case: the finest spacing that can be decided and one with a layer more in the last wall, and what that costs.

    said: {member: (verdict, reasons, notes)}; None if no spacing can decide
    """
    if case.not_modelled or "whole" in (jobs[0, case.shifts[0]].result().get("rules") or ()):
        return None
    last, which = case.walls[-1], len(case.spacings_mm) - 1
    fine = (last.spacings_mm or case.spacings_mm)[-1]
    layers = math.ceil(last.thickness_mm / fine - 0.01)
    first = 1.0 if layers >= cases.LAYERS else last.thickness_mm / cases.LAYERS / fine
    steps = (last.thickness_mm / n / fine for n in itertools.count(max(layers, cases.LAYERS) + 1))
    second = next(r for r in itertools.islice(steps, 100) if r * cases.RATIO <= first and fits(case, r))
    stay = first == 1.0 and all(said[which, shift][0] != "undecided" for shift in case.shifts)  # those of the finest need not be run again

    def spacings(own):
        return [float(f"{own[-1] * ratio:.4g}") for ratio in (first, second)]

    spent = sum(jobs[which, shift].result().get("core_s", 0) for shift in case.shifts)
    return {"spacings_mm": spacings(case.spacings_mm), **{f"wall {k}: spacings_mm": spacings(wall.spacings_mm) for k, wall in enumerate(case.walls, 1) if wall.spacings_mm},
            "runs": len(case.shifts) * (1 if stay else 2), "core_s": float(f"{spent * (second**-4 + (0 if stay else first**-4)):.2g}")}


def fits(case, ratio):
    """True if walls with elements can have them with the finest spacings of a case times ratio"""
    return all(elements.per_edge(geometry.layers(wall.thickness_mm, ratio * (wall.spacings_mm or case.spacings_mm)[-1]))
               for wall in case.walls if wall.method != "sph")


def said_of_finer(case, found):
    """a line for the eye"""
    keys = ", ".join(f"{key}: {value}" for key, value in found.items() if key.endswith("spacings_mm"))
    more = "more runs, those of the finest spacing stay" if found["runs"] == len(case.shifts) else "runs, with the remedies above"
    return f"next finer: {keys}: {found['runs']} {more}; about {found['core_s']:g} core-seconds"


def shown(case):
    """columns of the table of runs"""
    n = len(case.walls)
    return ["verdict", *(f"hole{k}_diameter_mm" for k in range(1, n + 1)), f"wall{n}_spall_mass_mg", "areal_density_kg_m2", "particles", "time_us", "core_s"]


def save(path, mapping):
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(yaml.safe_dump(mapping, sort_keys=False, width=1000))
    except OSError as problem:
        raise HVIError(f"cannot write {path}: {problem.strerror}") from None


def command(args, ranks):
    """what was asked for, as it is typed"""
    given = (("--runs", args.runs), ("--jobs", args.jobs), ("--ranks", ranks), ("--lmp", args.lmp))
    return shlex.join(["python3", "-m", "hvi", "shield", str(args.case), *(str(word) for option, value in given if value for word in (option, value))])


def main(args):
    case = cases.read(args.case)
    if args.write:
        return write(case, args.write)
    folder = args.runs.resolve() / case.name
    if args.dry_run:
        return plan(case, folder, args.jobs, args.ranks or 2)
    runner = engine.Runner(args)
    jobs = {member: job(case, member, folder / member_name(case, member)) for member in members(case)}
    (folder / "verdict.yaml").unlink(missing_ok=True)  # that of another case, or of fewer runs
    todo = [j for j in jobs.values() if j.result() is None]
    if todo:
        refuse_too_large(case, [chain.plan_of(j.shield) for j in todo], folder, min(runner.jobs, len(todo)))
    print(f"{case.name}: {len(jobs)} runs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    with engine.table_of(jobs.values, folder / "runs.csv"):
        failed = runner.run(todo, case.name)
    if failed:
        print(engine.overview(jobs.values(), shown(case)))
        raise HVIError(f"no verdict: {len(failed)} of {len(jobs)} runs failed: {', '.join(j.name for j in failed)}")
    each = {member: verdict(j) for member, j in jobs.items()}
    said, reasons, notes = decide(case, each)
    further = finer(case, each, jobs) if said == "undecided" else None
    more = {name: value for name, value in (("notes", notes), ("next_finer", further)) if value}
    equations = ble.beside(ble.predictions, case)
    (folder / "case.yaml").write_text(pathlib.Path(args.case).read_text())
    save(folder / "verdict.yaml", {"verdict": said, "reasons": reasons, **more, "runs": {j.name: verdict(j)[0] for j in jobs.values()},
                                   "areal_density_kg_m2": chain.plan_of(jobs[0, case.shifts[0]].shield)["areal_density_kg_m2"],
                                   "equations": equations, "core_s": round(sum(j.result().get("core_s", 0) for j in jobs.values()), 1),
                                   "command": command(args, runner.ranks)})
    print(engine.overview(jobs.values(), shown(case)))
    print(f"verdict: {said}")
    print("\n".join([*(f"  - {text}" for text in reasons), *(["notes:"] if notes else []), *(f"  - {text}" for text in notes),
                     *([said_of_finer(case, further)] if further else [])]))
    print(f"table: {folder / 'runs.csv'}, verdict: {folder / 'verdict.yaml'}")
    print("\n".join(ble.said(equations)))
    return STATUS[said]


def free_memory():
    """MB that processes can still have, None where nothing says so"""
    try:
        lines = pathlib.Path("/proc/meminfo").read_text().splitlines()
        return next(int(line.split()[1]) / 1e3 for line in lines if line.startswith("MemAvailable"))
    except (OSError, StopIteration, ValueError):
        return None


def refuse_too_large(case, plans, folder, jobs):
    """before anything is made: runs that the machine has no room for; plans: [plan, ...] of the spacings, jobs: runs at a time"""
    free, most = free_memory(), max(plans, key=lambda plan: plan["memory_MB"])
    dx = most["dx_mm"]
    what = f"spacings_mm: {dx:g} mm makes some {most['particles']:.3g} particles"
    if most["particles"] > 2**31 - 1:
        raise HVIError(f"{case.name}: {what}, more than LAMMPS can number: are lengths in mm?")
    if free is not None and most["memory_MB"] * jobs > free:
        fit = math.ceil(100 * dx * (most["memory_MB"] * jobs / free) ** (1 / 3)) / 100
        raise HVIError(f"{case.name}: {what}, {most['memory_MB']:.3g} MB of memory{f' in each of {jobs} runs at a time' if jobs > 1 else ''}, and {free:.0f} are free: "
                       f"take {fit:g} mm or more{', or fewer jobs at a time' if jobs > 1 else ''}; --write makes the input for another machine")
    existing = next(path for path in (folder, *folder.parents) if path.exists())
    disk = shutil.disk_usage(existing).free / 1e6
    if (needed := sum(plan["disk_MB"] for plan in plans) * len(case.shifts)) > disk:
        raise HVIError(f"{case.name}: some {needed:.3g} MB would be written, and {disk:.0f} are free in {existing}: take a larger settings: film, or another --runs DIR")


def plan(case, folder, jobs, ranks):
    """what would be run: particles, areal densities, steps, time and memory of each spacing, from geometry alone; and a sketch"""
    from .. import figures
    from ..figures import sketch

    plans = [chain.plan_of(chain.shield_of(case, which, case.shifts[0])) for which in range(len(case.spacings_mm))]
    n = len(case.walls)
    keys = ["projectile_particles", *(f"wall{k}_{what}" for k in range(1, n + 1) for what in ("particles", "layers", "areal_density_kg_m2")), "areal_density_kg_m2",
            "tstop_us", "particles", "steps", "core_s", "memory_MB", "disk_MB"]
    print(tables.text(("each run", *(f"dx-{dx:g}" for dx in case.spacings_mm)), [
        (key, *(f"about {tables.number(found[key])}" if key in ("steps", "core_s", "memory_MB", "disk_MB") else found[key] for found in plans)) for key in keys]))
    core = sum(found["core_s"] for found in plans) * len(case.shifts)
    print(f"{len(members(case))} runs, {len(case.shifts)} of each spacing: at most about {engine.duration(core / (jobs * ranks))}, {jobs} at a time on {ranks} ranks each, "
          "on idle cores; a run ends when its event is over")
    finest = plans[-1]
    print(tables.text(("wall", "front_mm", "radius_mm", "middle_mm", "struck_at_mm"), [
        (k, case.faces()[k - 1][0], *(finest[f"wall{k}_{what}"] for what in ("radius_mm", "middle_mm", "struck_at_mm"))) for k in range(1, n + 1)]))
    if n <= 20:
        folder.mkdir(parents=True, exist_ok=True)
        for path in figures.save(sketch.draw(case, finest), str(folder / "sketch.png")):
            print(f"sketch: {path}")
    refuse_too_large(case, plans, folder, jobs)
    return 0


def write(case, folder):
    """inputs of all runs, and how to run them"""
    for member in members(case):
        where = folder / member_name(case, member)
        chain.write_run(case, *member, where)
        print(f"cd {shlex.quote(str(where))} && mpirun -np 2 lmp -in {script.BEGIN} && python3 -m hvi judge .")
    return 0
