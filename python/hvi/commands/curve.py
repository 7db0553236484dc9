# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi curve: the limit of a shield over a list of speeds, gaps, angles, ..., as a table, CSV and a picture, with ballistic-limit equations beside.

At each value a search of hvi limit; all of them share the runs at a time. What was run is not run again.
"""

import math

from .. import tables
from ..errors import HVIError
from ..jobs import engine, runs
from ..shield import ble, decision, quantity
from ..shield import case as cases
from ..shield.limit import Limit
from . import running
from .shared import draw

EXAMPLES = """  python3 -m hvi curve emi.yaml --speeds 3:9:4 --from 2 --to 8 --step 0.5 --jobs 2 --ranks 1
  python3 -m hvi curve emi.yaml --over gap2=20:100:5 --on thickness2 --from 0.5 --to 4 --step 0.25
  python3 -m hvi curve emi.yaml --over angle=0:60:4 --at gap2=80"""


def add_arguments(parser):
    running.add_case(parser)
    running.add_over(parser, (3.0, 9.0, 7))
    parser.add_argument("--on", default="D", metavar="WHAT", help="D, or speed, angle, thickness1, thickness2, ..., gap2, ... (default: D)")
    running.add_at(parser)
    running.add_range(parser)
    running.add_runs(parser)


def row(value, over, limit):
    """numbers of a value: the limit, between which values it is, on which sides of these all runs hold and fail, what is wrong with it"""
    answer = limit.answer()
    between = answer.get("undecided", [math.nan, math.nan])
    return {over.name: value, "limit": math.nan if answer["limit"] is None else answer["limit"], "low": between[0], "high": between[1],
            "holds": answer.get("holds", math.nan), "fails": answer.get("fails", math.nan),
            "runs": sum(len(search.said) for search in limit.searches.values()), "why_not": "; ".join(answer.get("reasons", []))}


def equations(case, over, values):
    """{equation: [(critical size in mm, is it within its ranges), ...]} over values, or why there are none

    The size is that of limits; equations have the diameter of a sphere of the same mass.
    """
    def curves():
        found = {}
        for at in (over.at(case, value) for value in values):
            of = ble.from_case(at)
            for name, points in ble.curves(of, ble.equations(of), [at.speed_km_s], at.angle_deg).items():
                found.setdefault(name, []).extend((d * at.projectile.size_mm / at.diameter_mm, within) for d, within in points)
        return found

    return ble.beside(curves)


def main(args):
    word, values = args.over or ("speed", args.speeds)
    case, given = quantity.changed(cases.read(args.case), args.at, args.on, word)
    over, values = quantity.find(case, word, "--over"), running.evenly(*values)
    if args.on == word:
        raise HVIError(f"--on {word}: {word} is what the curve is over")
    folder = args.runs.resolve() / case.name / (f"curve-{args.on}" + ("" if word == "speed" else f"_over-{word}") + given)
    limits = {value: Limit(over.checked(case, value, f"--over {word}" if args.over else "--speeds"), folder, args.on, args.from_, args.to_, args.step_,
                           name=f"{'v' if word == 'speed' else word}-{value:g}_") for value in values}
    runner = runs.Runner(args)

    def more(job):
        return next(limit for limit in limits.values() if job.name in limit.jobs).more(job)

    first = runs.left([job for limit in limits.values() for job in limit.first()], more)
    print(f"{case.name}: {args.on} over {len(values)} {'speeds' if word == 'speed' else f'values of {word}'}, {len(first)} runs to begin with", flush=True)
    if args.dry_run:
        runner.show(first)
    if args.dry_run or first:
        running.plan_searches(case, limits, folder, runner, args.dry_run, over)
    if args.dry_run:
        return 0
    for ending in ("yaml", "csv", "png"):  # of an earlier call
        (folder / f"curve.{ending}").unlink(missing_ok=True)

    def every():
        return [job for limit in limits.values() for job in limit.every()]

    with engine.table_of(every, folder / "runs.csv"):
        failed = runner.run(first, f"{case.name} curve", more)
    if failed:
        raise HVIError(f"no curve: {len(failed)} runs failed: {', '.join(job.name for job in failed)}")
    return report(case, args.on, over, limits, folder, every())


def title_of(case, over, on):
    """of the picture: the shield, and of the shot all that does not vary"""
    walls = " + ".join(f"{wall.thickness_mm:g}" for wall in case.walls)
    shot = [f"{value:g} {unit}" for word, value, unit in (("speed", case.speed_km_s, "km/s"), ("angle", case.angle_deg, "degrees")) if word not in (over.word, on)]
    return f"{case.name}: {', '.join([f'{case.projectile.shape} on {walls} mm', *shot])}, {min(case.spacings_mm):g} mm between particles"


def report(case, on, over, limits, folder, jobs):
    """table, curve.csv, curve.yaml, curve.png; exit status"""
    rows = [row(value, over, limit) for value, limit in limits.items()]
    unit = next(iter(limits.values())).unit
    fine = running.evenly(min(limits), max(limits), 60) if len(limits) > 1 else [*limits]
    known = equations(case, over, [*limits]) if on == "D" else f"none: the equations are for a diameter, not for {on}"
    names = [] if isinstance(known, str) else list(known)
    columns = (over.name, f"limit_{unit}", "low", "high", "holds", "fails", "runs", *names)
    values = ("limit", "low", "high", "holds", "fails", "runs")
    cells = [(line[over.name], *(line[key] for key in values), *(known[name][k][0] for name in names)) for k, line in enumerate(rows)]
    shown = [[value if value == value else "-" for value in line] for line in cells]
    print(tables.text(columns, shown))
    for line in rows:
        if line["why_not"]:
            print(f"no limit at {line[over.name]:g} {over.unit}: {line['why_not']}")
    for note in dict.fromkeys(note for limit in limits.values() for note in limit.answer().get("notes", [])):
        print(f"note: {note}")
    if isinstance(known, str):
        print(f"equations: {known}")
    print(f"holds, fails: of all runs, between them undecided; cost: {len(jobs)} runs, {sum(job.result().get('core_s', 0) for job in jobs):g} core-seconds")
    tables.write_csv(folder / "curve.csv", columns, cells)
    running.save(folder / "curve.yaml", {"on": on, "unit": unit, "over": over.name, "case": case.mapping(), "files": next(iter(limits.values())).files,
                                         "points": [{key: value for key, value in line.items() if value == value} for line in rows],
                                         "core_s": round(sum(job.result().get("core_s", 0) for job in jobs), 1)})
    points = [(line[over.name], line["limit"], line["low"], line["high"]) for line in rows if math.isfinite(line["limit"])]
    curves = {} if isinstance(known, str) else equations(case, over, fine)
    what = "critical diameter" if on == "D" else f"limit on {on}"
    draw(str(folder / "curve.png"), "limit_curve", fine, curves, points, title_of(case, over, on), f"{what} ({unit})", f"{over.word} ({over.unit})")
    print(f"table: {folder / 'curve.csv'}")
    return 0 if len(points) == len(rows) else decision.STATUS["undecided"]
