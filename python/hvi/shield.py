# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi shield: does the wall hold?  One case at several spacings and shifts of the lattice, one verdict."""

import pathlib
import re

import yaml

from . import case as cases
from . import runs, tables
from .errors import HVIError

INPUT = runs.ROOT / "examples" / "whipple-shield" / "in.whipple"
STATUS = {"holds": 0, "fails": 3, "undecided": 4}  # exit status of each verdict


def source(args):
    path = pathlib.Path(args.input or INPUT)
    if not path.is_file():
        raise HVIError(f"{path} is not there: run from the source tree, or give --input FILE")
    return runs.Input(path)


def members(case):
    """(number of the spacing, shift) of each run of a case, coarse first"""
    return [(which, shift) for which in range(len(case.spacings_mm)) for shift in case.shifts]


def member_name(case, member):
    return runs.job_name({"dx": case.spacings_mm[member[0]], "shift": member[1]})


def job(case, source, member, folder, name=None, remove=()):
    weight = (case.spacings_mm[0] / case.spacings_mm[member[0]]) ** 4  # particles and steps
    return runs.Job(source, name or member_name(case, member), case.variables(*member), folder, weight=weight, remove=remove,
                    restart="shield.state" if "resume" in source.known else None)


def verdict(job):
    """(verdict, reasons) of a run that is done"""
    result = job.result()
    said, reasons = result.get("verdict"), result.get("reasons") or []
    if said not in STATUS:
        raise HVIError(f"{job.folder / 'result.yaml'}: no verdict, holds, fails or undecided, but {said}")
    return said, [as_key(str(reason)) for reason in (reasons if isinstance(reasons, list) else [reasons])]


def as_key(reason):
    """a remedy of in.whipple, -var NAME VALUE, as a key of the case"""
    reason = re.sub(r"-var radius[12]? ([\d.]+) for it", r"radius_mm of \1 for it", reason)
    reason = re.sub(r"-var dx ([\d.]+)", r"spacings_mm of \1", reason)
    return re.sub(r"-var (\w+) ([\d.]+)", r"settings: {\1: \2}", reason)


def decide(case, said):
    """The verdict of all runs, {member: (verdict, reasons)}, with reasons: undecided where they differ."""
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
    texts = {}  # why runs are undecided; if all agree on another verdict, what the finest says of it
    for member, (verdict, why) in said.items():
        for text in why:
            if verdict == "undecided" or not reasons and member == (len(case.spacings_mm) - 1, case.shifts[-1]):
                texts.setdefault(text, []).append(member_name(case, member))
    told = [f"{text} ({', '.join(names)})" for text, names in texts.items()]
    if reasons or per[0] == {"undecided"}:
        return "undecided", reasons + told
    (verdict,) = per[0]
    return verdict, [f"all {len(said)} runs say so: spacings of {', '.join(f'{dx:g}' for dx in case.spacings_mm)} mm, "
                     f"{len(case.shifts)} shift{'s' if len(case.shifts) > 1 else ''} of the lattice", *told]


def shown(case):
    """columns of the table of runs"""
    n = len(case.walls)
    return ["verdict", *(f"hole{k}_diameter_mm" for k in range(1, n + 1)), f"wall{n}_spall_mass_mg", "particles", "time_us", "core_s"]


def save(path, mapping):
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(yaml.safe_dump(mapping, sort_keys=False, width=1000))
    except OSError as problem:
        raise HVIError(f"cannot write {path}: {problem.strerror}") from None


def main(args):
    found = source(args)
    case = cases.read(args.case, found)
    runner = runs.Runner(args)
    folder = args.runs.resolve() / case.name
    if args.dry_run:
        return plan(case, found, runner, folder)
    jobs = {member: job(case, found, member, folder / member_name(case, member)) for member in members(case)}
    (folder / "verdict.yaml").unlink(missing_ok=True)  # that of another case, or of fewer runs
    todo = [j for j in jobs.values() if j.result() is None]
    print(f"{case.name}: {len(jobs)} runs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    try:
        failed = runner.run(todo, case.name)
    finally:
        runs.write_table(jobs.values(), folder / "runs.csv")
    print(runs.overview(jobs.values(), shown(case)))
    if failed:
        raise HVIError(f"no verdict: {len(failed)} of {len(jobs)} runs failed: {', '.join(j.name for j in failed)}")
    said, reasons = decide(case, {member: verdict(j) for member, j in jobs.items()})
    save(folder / "verdict.yaml", {"verdict": said, "reasons": reasons, "runs": {j.name: verdict(j)[0] for j in jobs.values()},
                                   "core_s": round(sum(j.result().get("core_s", 0) for j in jobs.values()), 1)})
    print(f"verdict: {said}")
    for reason in reasons:
        print(f"  - {reason}")
    print(f"table: {folder / 'runs.csv'}, verdict: {folder / 'verdict.yaml'}")
    return STATUS[said]


def plan(case, source, runner, folder):
    """what would be run: particles, steps, time and memory of each spacing, by in.whipple itself, and a sketch"""
    from . import figures, sketch

    jobs = [runs.Job(source, f"dx-{dx:g}", {**case.variables(which, case.shifts[0]), "dry": "yes"},
                     folder / "plan" / f"dx-{dx:g}", product="plan.yaml", last="disk_MB") for which, dx in enumerate(case.spacings_mm)]
    source.check(jobs[0].variables, "--dry-run")
    for made in jobs:  # times are of this moment and these ranks
        (made.folder / made.product).unlink(missing_ok=True)
    failed = runner.run(jobs, "plan")
    if failed:
        raise HVIError(f"no plan: {', '.join(j.name for j in failed)} failed")
    keys = ["projectile_particles", *(f"wall{k}_{what}" for k in range(1, len(case.walls) + 1) for what in ("particles", "layers")),
            "tstop_us", "steps", "seconds", "memory_MB", "disk_MB"]
    print(tables.text(("each run", *(j.name for j in jobs)), [(key, *(j.result().get(key, "-") for j in jobs)) for key in keys]))
    seconds = sum(j.result().get("seconds", 0) for j in jobs) * len(case.shifts)
    print(f"{len(members(case))} runs, {len(case.shifts)} of each spacing: about {runs.duration(seconds / runner.jobs)}, "
          f"{runner.jobs} at a time on {runner.ranks} ranks each")
    plan = jobs[-1].result()
    print(tables.text(("wall", "front_mm", "radius_mm", "middle_mm", "struck_at_mm"), [
        (k, sketch.faces(case)[k - 1][0], *(plan[f"wall{k}_{what}"] for what in ("radius_mm", "middle_mm", "struck_at_mm"))) for k in range(1, len(case.walls) + 1)]))
    for path in figures.save(sketch.draw(case, plan), str(folder / "sketch.png")):
        print(f"sketch: {path}")
    return 0
