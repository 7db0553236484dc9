# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi shots: published shots one after the other, beside equations."""

from .. import tables
from ..jobs import runs
from ..shield import chain, script
from ..shield.shots import Outcome, Study, by_equation, confusion, counts, counts_table, named, ratios_of, row, shown
from . import running

EXAMPLES = """  python3 -m hvi shots examples/whipple-shield/shots/chosen.yaml --jobs 2 --ranks 1
  python3 -m hvi shots mine.csv --equations
  python3 -m hvi shots all.yaml --only 2053 P-34B --dry-run"""


def add_arguments(parser):
    parser.add_argument("study", metavar="FILE", help="study (YAML), or a list of shots (CSV) that is run as examples/whipple-shield/shots/all.yaml says")
    parser.add_argument("--only", nargs="+", action="extend", metavar="SHOT", help="only these shots of it")
    parser.add_argument("--equations", action="store_true", help="the equations alone, nothing is run")
    running.add_runs(parser)


def markdown(names, rows):
    lines = [names, ["---"] * len(names), *rows]
    return "\n".join("| " + " | ".join(tables.number(cell) for cell in line) + " |" for line in lines)


def save(folder, outcomes, ratios):
    """shots.csv and shots.md of all shots of a study and what is done so far, for the eye the same"""
    table = [row(outcome, ratios[outcome.shot.name]) for outcome in outcomes]
    names = list(table[0])
    hidden = {"reasons"} if any(line["finer"] for line in table) else {"reasons", "finer", "both"}
    columns = [name for name in names if name not in hidden]
    cells = [[line[name] for name in columns] for line in table]
    summary = counts_table(counts(outcomes, ratios))
    tables.write_csv(folder / "shots.csv", names, [line.values() for line in table])
    done = f"{sum(outcome.done(0) for outcome in outcomes)} of {len(outcomes)} shots are done, and counted:"
    (folder / "shots.md").write_text(f"{markdown(columns, cells)}\n\n{done}\n\n{markdown(*summary)}\n")
    return f"{tables.text(columns, cells)}\n\n{done}\n{tables.text(*summary)}"


def plan(outcomes, folder):
    """particles and steps of each run, from geometry alone: plans.csv"""
    keys = ("projectile_particles", "wall1_particles", "wall1_layers", "wall2_particles", "wall2_layers", "tstop_us", "steps", "memory_MB")
    names, rows = ("shot", "dx_mm", *keys, "particle_steps"), []
    for outcome in outcomes:
        for which, dx in enumerate(outcome.case.spacings_mm):
            found = chain.plan_of(chain.shield_of(outcome.case, which, outcome.case.shifts[0]))
            rows.append((outcome.shot.name, dx, *(found[key] for key in keys), found["particles"] * found["steps"]))
    tables.write_csv(folder / "plans.csv", names, rows)
    print(tables.text(names, rows))
    print(f"{len(rows)} plans, {sum(line[-1] for line in rows) * len(outcomes[0].case.shifts):.3g} particle-steps in all until tstop_us, "
          f"at most {script.longest(outcomes[0].case)} times that: {folder / 'plans.csv'}")


def main(args):
    study = Study(args.study)
    shots = named(study.shots, dict.fromkeys(args.only), args.study) if args.only else study.shots
    used = {alloy for shot in shots for alloy in shot.alloys()}
    for alloy in sorted(used & set(study.stand_ins)):
        print(f"stand-in: {alloy} is computed as {study.stand_ins[alloy]}")
    folder = args.runs.resolve() / study.name
    every = [Outcome(shot, study.case(shot), folder) for shot in study.shots]
    outcomes = [outcome for outcome in every if outcome.shot in shots]
    if not args.equations:
        folder.mkdir(parents=True, exist_ok=True)
    if args.dry_run:
        words = runs.check(args)
        plan(outcomes, folder)
        runs.ask_slurm(words, sum(len(outcome.jobs) for outcome in outcomes))
        return 0
    ratios = {outcome.shot.name: ratios_of(outcome) for outcome in every}
    if args.equations:
        found = [(name, confusion((shot.observed, by_equation(ratios[shot.name][name])) for shot in shots)) for name in ratios[shots[0].name]]
        names = ("shot", "observed", *ratios[shots[0].name])
        print("diameter over the critical one; *: beyond what the equation is known to hold for")
        print(tables.text(names, [(shot.name, shot.observed, *map(shown, ratios[shot.name].values())) for shot in shots]))
        print("\n" + tables.text(*counts_table(found)))
        return 0
    jobs = [job for _, job in sorted(((member, job) for o in outcomes for member, job in o.jobs.items()), key=lambda pair: pair[0])]  # coarse ones first
    todo = [job for job in jobs if job.result() is None]
    print(f"{study.name}: {len(shots)} shots, {len(jobs)} runs, {len(jobs) - len(todo)} done before, {len(todo)} to run", flush=True)
    runner = runs.Runner(args)
    if todo:
        running.refuse_too_large([(job.name, chain.plan_of(job.shield)) for job in todo], folder, runner.here(len(todo)),
                                 " by the study's rule, or --only other shots")
    try:
        failed = runner.run(todo, study.name)
    finally:
        print(save(folder, every, ratios))
    print(f"table: {folder / 'shots.csv'}, {folder / 'shots.md'}")
    if failed:
        print(f"{study.name}: {len(failed)} failed: {', '.join(job.name for job in failed)}", flush=True)
    return 1 if failed else 0
