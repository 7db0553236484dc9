# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi calibrate: makes the records that verdicts and limits are judged by, and judges them by each other."""

import pathlib

from .. import tables
from ..errors import HVIError
from ..shield import brackets, calibration, collected, shots
from ..shield.collected import within

EXAMPLES = """  python3 -m hvi calibrate examples/whipple-shield/limits/limits.yaml --runs runs --file python/hvi/shield/calibration.csv
  python3 -m hvi calibrate limits.yaml --shots chosen.yaml --runs runs --file mine.csv
  python3 -m hvi calibrate"""


def add_arguments(parser):
    parser.add_argument("study", nargs="?", metavar="STUDY.yaml", help="of hvi limits, whose runs are made into records; without it a file is only looked at")
    parser.add_argument("--shots", metavar="STUDY.yaml", help="of hvi shots, whose runs are taken, too")
    parser.add_argument("--add", type=pathlib.Path, metavar="FILE.csv", help="records that were made before, of the same rule of spacings, which are kept beside those of the study")
    parser.add_argument("--runs", type=pathlib.Path, default="runs", metavar="DIR", help="folder of their runs (default: runs)")
    parser.add_argument("--file", type=pathlib.Path, metavar="FILE.csv", help="the records; needed with a study (hvi shield and hvi limit read %s)" % within(calibration.FILE))


def main(args):
    if args.study and not args.file:
        raise HVIError("a study needs --file FILE.csv, where its records go")
    if args.add and not args.study:
        raise HVIError("--add needs a study, beside whose records these are kept")
    if args.shots and not args.study:
        raise HVIError("--shots needs a study of hvi limits, whose rule of spacings is theirs")
    args.file = args.file or calibration.FILE
    if args.study:
        published = shots.Study(args.shots) if args.shots else None
        collected.write(args.file, collected.collect(brackets.Study(args.study), args.runs.resolve(), published, calibration.read(args.add) if args.add else None))
    records = calibration.read(args.file)
    head, fine = records.head, records.finest()
    rows = []
    for name, runs in fine.shields.items():
        counts = [sum(run.test == test for run in runs) for test in ("holds", "fails")]
        limit = fine.limits.get(name)
        rows.append((name, runs[0].km_s, len(runs), *counts, *(f"{value:.3f}" for value in (limit.needed() if limit else ())), *(() if limit else ("-", "-"))))
    print(tables.text(("shield", "km_s", "runs", "test_holds", "test_fails", "least", "most"), rows))
    print("least, most: a wall must exceed the computed limit by so many times, a diameter must be so many times smaller, for the measured limit to be reached")
    checked = fine.check()
    print(tables.text(("mean square of", "by_other_shields", "by_other_reports"), [(name, score, checked["scores_by_other_reports"][name]) for name, score in checked["scores"].items()]))
    print(f"0 is right, 0.25 a coin; used: {head['margin']}; measured limits whose range overlaps the band of the other shields: {checked['limits_in_the_band_of_the_others']}")
    print(f"{args.file}: {head['rows']} runs of {head['shields']} shields, {head['date']}: {head['command']}")
    return 0
