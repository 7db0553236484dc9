# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi limits: measured limits of shields, one after the other, beside the simulation's and those of equations."""

from .. import tables
from ..errors import HVIError
from ..jobs import runs
from ..shield import brackets, chain
from . import running
from .shots import markdown

EXAMPLES = """  python3 -m hvi limits examples/whipple-shield/limits/limits.yaml --jobs 2 --ranks 1
  python3 -m hvi limits limits.yaml --only A55 P2
  python3 -m hvi limits limits.yaml --equations"""
SUMMARY = ("", "brackets", "mean |error| %", "mean error %", "least error %")


def add_arguments(parser):
    parser.add_argument("study", metavar="STUDY.yaml", help="which list of brackets, how many particles across, the rule of spacings")
    parser.add_argument("--only", nargs="+", action="extend", metavar="NAME", help="run only these brackets; the table has all")
    parser.add_argument("--equations", action="store_true", help="the equations alone, nothing is run")
    running.add_runs(parser)


def percent(error):
    return "" if error is None else f"{100 * error + 0.0:+.0f}"


def said_of(summary):
    return [(name, n, *(f"{100 * value:.1f}" if n else "-" for value in values)) for name, n, *values in summary]


def save(folder, study, found, equations):
    """limits.csv and limits.md; for the eye the table"""
    rows = [one.row() for one in found]
    names = list(rows[0])
    tables.write_csv(folder / "limits.csv", names, [["" if cell is None else cell for cell in row.values()] for row in rows])
    equal = list(dict.fromkeys(name for one in equations.values() for name in one))
    hidden = {"at_holds", "at_fails", "error"}
    head = [*(name for name in names if name not in hidden), "error %", *(f"{name} %" for name in equal)]
    cells = [[*("-" if row[name] is None else row[name] for name in names if name not in hidden), percent(row["error"]),
              *(percent(equations[row["bracket"]][name][1]) if name in equations[row["bracket"]] else "-" for name in equal)] for row in rows]
    summary = said_of(brackets.summary(rows, equations))
    (folder / "limits.md").write_text(f"{markdown(head, cells)}\n\n{markdown(SUMMARY, summary)}\n")
    return f"{tables.text(head, cells)}\n\n{tables.text(SUMMARY, summary)}"


def main(args):
    study = brackets.Study(args.study)
    known = {one.name: one for one in study.brackets}
    if unknown := [name for name in args.only or () if name not in known]:
        raise HVIError(f"--only: no bracket {unknown[0]} (known: {', '.join(known)})")
    chosen = set(args.only or known)
    for alloy in sorted({alloy for one in study.brackets for alloy in one.shot.alloys()} & set(study.stand_ins)):
        print(f"stand-in: {alloy} is computed as {study.stand_ins[alloy]}")
    folder = args.runs.resolve() / study.name
    equations = {one.name: brackets.equations(study, one) for one in study.brackets}
    if args.equations:
        names = list(dict.fromkeys(name for one in equations.values() for name in one))
        cells = [[one.name, one.shot.speed_km_s, one.on, one.low, one.high, *(f"{equations[one.name][name][0]:.3g} ({percent(equations[one.name][name][1])})"
                                                                         if name in equations[one.name] else "-" for name in names)] for one in study.brackets]
        print(tables.text(("bracket", "km_s", "on", "low", "high", *names), cells))
        print("\n" + tables.text(SUMMARY, said_of(brackets.summary([], equations))))
        return 0
    folder.mkdir(parents=True, exist_ok=True)
    found = [brackets.Found(study, one, across, shift, folder / one.name) for across in sorted(study.across) for shift in study.shifts for one in study.brackets]
    first = {job.name: (one, job) for one in found for job in one.more() if one.bracket.name in chosen}  # of the others what was run before
    runner = runs.Runner(args)
    if args.dry_run:
        runner.show([job for _, job in first.values()])
    if first:
        running.refuse_too_large([(name, chain.plan_of(job.shield)) for name, (_, job) in first.items()], folder, runner.here(len(first)), " by across of the study")
    if args.dry_run:
        return 0
    owner = {name: one for name, (one, _) in first.items()}

    def more(job):
        one = owner[job.name]
        one.take(job)
        new = one.more()
        owner.update({each.name: one for each in new})
        save(folder, study, found, equations)
        return new

    print(f"{study.name}: {len(chosen)} brackets, {len(study.across)} spacings, {len(study.shifts)} shifts; {len(first)} runs to begin with", flush=True)
    try:
        failed = runner.run([job for _, job in first.values()], study.name, more)
    finally:
        print(save(folder, study, found, equations))
        from .. import figures
        figures.save(figures.limit_brackets(study.brackets, [one.row() for one in found], equations), folder / "limits.png")
    print(f"table: {folder / 'limits.csv'}, {folder / 'limits.md'}, picture: {folder / 'limits.png'}")
    if failed:
        print(f"{study.name}: {len(failed)} failed: {', '.join(job.name for job in failed)}", flush=True)
    return 1 if failed else 0
