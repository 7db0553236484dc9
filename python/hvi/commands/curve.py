# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi curve: the limit of a shield over a list of speeds, as a table, CSV and a picture, with ballistic-limit equations beside.

At each speed a search of hvi limit; all of them share the runs at a time. What was run is not run again.
"""

import dataclasses
import math

from .. import tables
from ..errors import HVIError
from ..jobs import engine, runs
from ..shield import ble, decision
from ..shield import case as cases
from ..shield.limit import Limit
from . import running
from .shared import draw

EXAMPLES = "  python3 -m hvi curve emi.yaml --speeds 3:9:4 --from 2 --to 8 --step 0.5 --jobs 2 --ranks 1"


def add_arguments(parser):
    running.add_case(parser)
    running.add_speeds(parser, (3.0, 9.0, 7))
    parser.add_argument("--on", default="D", metavar="WHAT", help="D, or thickness1, thickness2, ... (default: D)")
    running.add_range(parser)
    running.add_runs(parser)


def row(speed, limit):
    """numbers of a speed: the limit, between which values it is, what is wrong with it"""
    answer = limit.answer()
    between = answer.get("undecided", [math.nan, math.nan])
    return {"speed_km_s": speed, "limit": math.nan if answer["limit"] is None else answer["limit"], "low": between[0], "high": between[1],
            "runs": sum(len(search.said) for search in limit.searches.values()), "why_not": "; ".join(answer.get("reasons", []))}


def equations(case, speeds):
    """{equation: [(critical diameter in mm, is it within its ranges), ...]} over speeds, or why there are none"""
    def curves():
        of = ble.from_case(case)
        return ble.curves(of, ble.equations(of), speeds, case.angle_deg)

    return ble.beside(curves)


def main(args):
    case = cases.read(args.case)
    speeds = running.evenly(*args.speeds)
    folder = args.runs.resolve() / case.name / f"curve-{args.on}"
    limits = {speed: Limit(dataclasses.replace(case, speed_km_s=speed), folder, args.on, args.from_, args.to_, args.step_, name=f"v-{speed:g}_") for speed in speeds}
    runner = runs.Runner(args)
    first = [job for limit in limits.values() for job in limit.first()]
    print(f"{case.name}: {args.on} over {len(speeds)} speeds, {len(first)} runs to begin with", flush=True)
    if args.dry_run:
        runner.show(first)
        return 0

    def more(job):
        return next(limit for limit in limits.values() if job.name in limit.jobs).more(job)

    def every():
        return [job for limit in limits.values() for job in limit.every()]

    with engine.table_of(every, folder / "runs.csv"):
        failed = runner.run(first, f"{case.name} curve", more)
    if failed:
        raise HVIError(f"no curve: {len(failed)} runs failed: {', '.join(job.name for job in failed)}")
    return report(case, args.on, limits, folder, every())


def report(case, on, limits, folder, jobs):
    """table, curve.csv, curve.yaml, curve.png; exit status"""
    rows = [row(speed, limit) for speed, limit in limits.items()]
    unit = next(iter(limits.values())).unit
    fine = running.evenly(min(limits), max(limits), 60) if len(limits) > 1 else [*limits]
    known = equations(case, [*limits]) if on == "D" else f"none: the equations are for a diameter, not for {on}"
    names = [] if isinstance(known, str) else list(known)
    columns = ("speed_km_s", f"limit_{unit}", "low", "high", "runs", *names)
    cells = [(line["speed_km_s"], *(line[key] for key in ("limit", "low", "high", "runs")), *(known[name][k][0] for name in names)) for k, line in enumerate(rows)]
    shown = [[value if value == value else "-" for value in line] for line in cells]
    print(tables.text(columns, shown))
    for line in rows:
        if line["why_not"]:
            print(f"no limit at {line['speed_km_s']:g} km/s: {line['why_not']}")
    if isinstance(known, str):
        print(f"equations: {known}")
    print(f"low to high: up to there all runs hold, from there all fail; cost: {len(jobs)} runs, {sum(job.result().get('core_s', 0) for job in jobs):g} core-seconds")
    tables.write_csv(folder / "curve.csv", columns, cells)
    running.save(folder / "curve.yaml", {"on": on, "unit": unit, "points": [{key: value for key, value in line.items() if value == value} for line in rows]})
    points = [(line["speed_km_s"], line["limit"], line["low"], line["high"]) for line in rows if math.isfinite(line["limit"])]
    curves = {} if isinstance(known, str) else equations(case, fine)
    what = "critical diameter" if on == "D" else f"limit on {on}"
    title = f"{case.name}: {case.projectile.shape} on " + " + ".join(f"{wall.thickness_mm:g}" for wall in case.walls) + f" mm, {case.angle_deg:g} degrees, {min(case.spacings_mm):g} mm between particles"
    draw(str(folder / "curve.png"), "limit_curve", fine, curves, points, title, f"{what} ({unit})")
    print(f"table: {folder / 'curve.csv'}")
    return 0 if len(points) == len(rows) else decision.STATUS["undecided"]
