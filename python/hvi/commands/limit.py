# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi limit: up to where does the wall hold?"""

from .. import tables
from ..errors import HVIError
from ..jobs import engine, runs
from ..shield import ble, calibration, decision, quantity
from ..shield import case as cases
from ..shield.limit import Limit
from . import running

EXAMPLES = """  python3 -m hvi limit emi.yaml --on D
  python3 -m hvi limit emi.yaml --on thickness2 --from 0.5 --to 3 --step 0.1 --jobs 2 --ranks 1
  python3 -m hvi limit emi.yaml --on D --at gap2=100 angle=45
  python3 -m hvi limit emi.yaml --on gap2 --from 20 --to 120 --step 10"""


def add_arguments(parser):
    running.add_case(parser)
    parser.add_argument("--on", required=True, metavar="WHAT", help="D, speed, angle, thickness1, thickness2, ..., gap2, ...")
    running.add_at(parser)
    running.add_range(parser)
    running.add_runs(parser)


def main(args):
    case, given = quantity.changed(cases.read(args.case), args.at, args.on)
    limit = Limit(case, args.runs.resolve() / case.name / f"limit-{args.on}{given}", args.on, args.from_, args.to_, args.step_)
    runner = runs.Runner(args)
    first, values = runs.left(limit.first(), limit.more), limit.values
    print(f"{case.name}: {args.on} from {values[0]:g} to {values[-1]:g} {limit.unit}, {len(values)} values, {len(first)} runs to begin with, at most {len(limit.most())}", flush=True)
    if args.dry_run:
        runner.show(first)
    if args.dry_run or first:
        running.plan_searches(case, {None: limit}, limit.folder, runner, args.dry_run)
    if args.dry_run:
        return 0
    (limit.folder / "limit.yaml").unlink(missing_ok=True)
    with engine.table_of(limit.every, limit.folder / "runs.csv"):
        failed = runner.run(first, f"{case.name} limit", limit.more)
    print(engine.overview(limit.every(), decision.shown(case)))
    if failed:
        raise HVIError(f"no limit: {len(failed)} runs failed: {', '.join(job.name for job in failed)}")
    print()
    print(tables.text(("spacing_mm", "shift", "holds", "undecided", "fails", "runs"), limit.rows()))
    done = [job.result() for job in limit.every()]
    answer = limit.answer()
    sure = ble.beside(lambda: calibration.read().of_limit(limit, answer)) if answer["limit"] is not None else "none: there is no limit"
    answer = {**answer, "calibration": sure, "undecided_runs": limit.undecided(), "runs": len(done), "core_s": round(sum(result.get("core_s", 0) for result in done), 1),
              "equations": limit.equations()}
    running.save(limit.folder / "limit.yaml", answer)
    print("\n".join(said(answer)))
    print(f"table: {limit.folder / 'runs.csv'}, answer: {limit.folder / 'limit.yaml'}")
    return 0 if answer["limit"] is not None else decision.STATUS["undecided"]


def said(answer):
    """lines for the eye"""
    unit, cost = answer["unit"], [f"cost: {answer['runs']} runs, {answer['core_s']:g} core-seconds"]
    cost = [line for name, reasons in answer["undecided_runs"].items() for line in (f"undecided: {name}", *(f"  - {reason}" for reason in reasons))] + cost
    cost = ble.said_of_limits(answer["equations"], unit) + cost
    if answer["limit"] is None:
        return ["limit: not found", *(f"  - {reason}" for reason in answer["reasons"]), *cost]
    spacing, shifts = answer["change_by_spacing"], answer["range_over_shifts"]
    return [f"holds {answer['holds']} {unit}, fails {answer['fails']}, between them undecided: limit on {answer['on']}, its middle {answer['limit']:g} {unit}",
            f"band: the last refinement moved it by {spacing:+g} {unit}" if spacing is not None else "band: one spacing only, nothing says how much it matters",
            f"      shifts of the lattice by up to {shifts:g} {unit}" if shifts is not None else "      one shift of the lattice only",
            f"      steps of {answer['step']:g} {unit}", *(f"note: {text}" for text in answer["notes"]), *calibration.said_of_limit(answer["calibration"], unit), *cost]
