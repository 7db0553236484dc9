# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi compare: shields side by side, or two runs."""

import dataclasses

from .. import tables
from ..analysis import cloud
from ..analysis import fragments as pieces
from ..errors import HVIError
from ..jobs import compare
from ..shield import answer
from . import dumps
from .shared import draw, real

EXAMPLES = """  python3 -m hvi compare runs/double runs/triple runs/stuffed --figure shields --out shields.csv
  python3 -m hvi compare double.yaml triple.yaml --runs runs
  python3 -m hvi compare run1/result.yaml run2/result.yaml
  python3 -m hvi compare run1 run2 --rtol 0.05 --keys length_ratio fragmentation
  python3 -m hvi compare run1/debris.dump run2/debris.dump --mass 1=5e-7 --mass 2=5e-7 --axis z --plane 4.05e-3 \\
      --bonds run1/bonds.dump run2/bonds.dump"""


RUNS_ONLY = ("keys", "rtol", "plane", "bonds", "column", "distance")  # options of two runs


def add_arguments(parser):
    parser.add_argument("paths", nargs="+", metavar="PATH", help="of shields: folders of hvi shield, limit and curve, or cases; else two of result.yaml, folder with one, or dump")
    parser.add_argument("--runs", default="runs", metavar="DIR", help="where the folders of cases are (default: runs)")
    parser.add_argument("--keys", nargs="+", action="extend", metavar="KEY", help="of two runs only these (default: all)")
    parser.add_argument("--rtol", type=real, metavar="T", help="of two runs: exit status 1 if a relative difference is larger than T")
    parser.add_argument("--out", metavar="FILE.csv", help="write the table with all digits")
    parser.add_argument("--figure", metavar="NAME", help="of shields: draw areal densities with verdicts, and curves: NAME.png and NAME.pdf, or only the one that NAME ends in")
    dumps.add_frame(parser)
    dumps.add_cloud(parser, needed=False)
    dumps.add_quantile(parser)
    dumps.add_rules(parser, several=True)
    dumps.add_reading(parser, several=True)


def main(args):
    shields = [answer.is_case(path) or answer.is_folder(path) for path in args.paths]
    if any(shields):
        if not all(shields):
            raise HVIError(f"cannot compare a shield with what is none: {args.paths[shields.index(True)]} and {args.paths[shields.index(False)]}")
        return of_shields(args)
    if len(args.paths) != 2:
        raise HVIError(f"two runs are compared, not {len(args.paths)}; shields are cases, or folders of hvi shield, limit and curve")
    if args.figure:
        raise HVIError("--figure is for shields: cases, or folders of hvi shield, limit and curve")
    return of_runs(args)


def of_shields(args):
    """a column for each on the screen, a row in the CSV file"""
    given = [f"--{option}" for option in RUNS_ONLY if getattr(args, option) is not None]
    if given:
        raise HVIError(f"{given[0]} is for two runs, not for shields")
    found = [answer.read(path, args.runs) for path in args.paths]
    names = [one.name for one in found]
    found = [dataclasses.replace(one, name=str(path)) if names.count(one.name) > 1 else one for one, path in zip(found, args.paths)]
    columns, rows = answer.side_by_side(found)
    print(tables.text(("", *(one.name for one in found)), [(name, *(row.get(name, compare.MISSING) for row in rows)) for name in columns]))
    for one in found:
        for folder in one.left_out:
            print(f"left out: {one.folder / folder}: of other values than the case's, or of an older version: call hvi limit or curve again, its runs stay")
    if args.out:
        tables.write_csv(args.out, ("shield", *columns), [(one.name, *(row.get(name, "") for name in columns)) for one, row in zip(found, rows)])
    draw(args.figure, "shields", answer.bars_of(found), answer.curves_of(found))
    return 0


def of_runs(args):
    """two runs"""
    runs = args.paths
    kinds = [dumps.is_dump(path) for path in runs]
    if kinds[0] != kinds[1]:
        raise HVIError(f"cannot compare a dump with a result.yaml: {runs[0]} and {runs[1]}")
    if kinds[0]:
        if args.plane is None:
            raise HVIError("to compare two dumps give --plane, and --axis if it is not z")
        found = [dumps.read(args, path, args.data and args.data[k]) for k, path in enumerate(runs)]
        if found[0].units != found[1].units:
            raise HVIError(f"{runs[0]} is in units {found[0].units}, {runs[1]} in {found[1].units}: their numbers cannot be compared")
        both = [measures(args, dump[args.frame], k) for k, dump in enumerate(found)]  # a frame at a time
    else:
        both = [compare.read_result(path) for path in runs]
    if args.keys:
        unknown = [key for key in args.keys if not any(key in result for result in both)]
        if unknown:
            raise HVIError(f"there is no {' '.join(unknown)}; there are: {' '.join(both[0])}")
        both = [{key: result[key] for key in args.keys if key in result} for result in both]
    table = compare.rows(*both)
    names = ("", "A", "B", "B - A", "relative")
    print(tables.text(names, [[compare.cut(value) for value in row] for row in table]))
    for key, left, right, *_ in table:
        if (left, right) != (compare.cut(left), compare.cut(right)):
            print(key)
            for name, value in (("A", left), ("B", right)):
                print(f"  {name}: " + "\n     ".join(tables.number(value).split("; ")))
    if args.out:
        tables.write_csv(args.out, ("key", *names[1:]), table)
    if args.rtol is not None and not compare.largest(table) <= args.rtol:
        print(f"larger than {args.rtol:g}: {', '.join(row[0] for row in table if compare.largest([row]) > args.rtol)}")
        return 1
    return 0


def measures(args, frame, which):
    """Cloud and, if there is a rule for them, fragments of the cloud in a frame of one of two dumps"""
    result = {"step": frame.step}
    if frame.time is not None:
        result["time"] = frame.time
    result.update(cloud.measure(frame, args.axis, args.plane, args.quantile))
    if dumps.has_rule(args):
        summary = pieces.both(frame, **dumps.rule(args, args.bonds and args.bonds[which]))[1]
        result.update({name: value for name, value in summary.items() if name not in ("mass", "particles")})
    return result
