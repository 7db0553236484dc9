# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The file of records of calibration.py, from the run folders of hvi limits and hvi shots."""

import dataclasses
import datetime
import math
import pathlib

from .. import tables, texts
from ..errors import HVIError, writing
from ..jobs import engine
from ..places import ROOT
from . import brackets, calibration, shots


class Collected:
    """Runs of studies, from their folders; what must be the same in all of them"""

    def __init__(self, study):
        self.study, self.runs, self.materials, self.versions, self.model = study, [], {}, set(), {}

    def take(self, job, **more):
        """the result of a job that was run with the settings and the input that the study has now; whether LAMMPS was changed since is not asked"""
        result, record = (engine.read_yaml(job.folder / name) for name in (engine.RESULT, "job.yaml"))
        if result is None or engine.LAST not in result:
            return None
        if (record or {}).get("variables") != job.variables or record.get("input") != job.record["input"]:
            raise HVIError(f"{job.folder} was run with other settings, or another input, than {self.study.path} has now: run it again")
        self.model = calibration.model_of(job.case)
        for name, digest in record.get("files", {}).items():
            if self.materials.setdefault(pathlib.Path(name).name, digest) != digest:
                raise HVIError(f"{job.folder} was run with another {name} than others: run them again")
        self.versions.add(f"LAMMPS {result['lammps_version']}, USER-HVI {result['package_version']}")
        return calibration.of_result(job.case, result, **more)

    def bracket(self, found):
        """the runs of a search, with the limit that they have found"""
        one, places = found.bracket, {}
        for place, value in enumerate(found.values):
            test = ("between" if one.low < value < one.high else "holds" if (value >= one.high) == (one.on == "wall") else "fails")
            if (found.folder / found.name(place)).is_dir():
                run = self.take(found.job(place), shield=one.name, source=one.shot.source, on=one.on, low=one.low, high=one.high, across=found.across, shift=found.shift, test=test)
                places.update({place: run} if run else {})
        found.search.said.update({place: run.verdict for place, run in places.items()})
        a, b, c, d = found.search.borders()
        ended = None not in (a, b, c, d) and abs(a - b) == abs(c - d) == 1  # no value is left between them
        limit = float(f"{math.sqrt(found.values[a] * found.values[d]):.5g}") if ended else math.nan
        self.runs += [dataclasses.replace(places[place], limit=limit) for place in sorted(places)]

    def shot(self, shot, outcome, across):
        """a published shot at the first spacing; one that a bracket names is of its shield"""
        of = next((one for one in self.study.brackets if shot.name in f"{one.fails} {one.holds}".split() and calibration.same_source(shot.source, one.shot.source)), None)
        its = {"shield": of.name, "on": of.on, "low": of.low, "high": of.high} if of else {"shield": shot.name}
        for (which, shift), job in outcome.jobs.items():
            if which == 0 and not shot.angle_deg:
                run = self.take(job, **its, source=shot.source, across=across, shift=shift, test=shots.OBSERVED[shot.observed])
                self.runs += [run] if run else []


def collect(study, runs, published=None, before=None):
    """the Records of a study of hvi limits and one of hvi shots, from the folder of their runs; before: Records whose runs are kept, of the same rule"""
    collected = Collected(study)
    for across in sorted(study.across):
        for shift in study.shifts:
            for one in study.brackets:
                collected.bracket(brackets.Found(study, one, across, shift, runs / study.name / one.name))
    if published:
        if ({"across": published.rule["across"], **study.rule}, study.settings) != (published.rule, published.settings) or published.rule["across"] not in study.across:
            raise HVIError(f"{published.path} has other spacings or settings than {study.path}: records are of one rule")
        for shot in published.shots:
            collected.shot(shot, shots.Outcome(shot, published.case(shot), runs / published.name), published.rule["across"])
    if not collected.runs:
        raise HVIError(f"{runs / study.name} has no runs of {study.path} that are done")
    command = f"python3 -m hvi calibrate {within(study.path)}" + (f" --shots {within(published.path)}" if published else "")
    head = {"command": command, "date": datetime.date.today().isoformat(), "rows": len(collected.runs), "shields": len({run.shield for run in collected.runs}),
            "spacing": {"across": sorted(study.across), **study.rule}, "settings": study.settings, "model": collected.model, "materials": dict(sorted(collected.materials.items())), "versions": sorted(collected.versions)}
    if before:
        join(head, before, collected.runs)
    records = calibration.Records(head, tuple(collected.runs))
    checked = records.finest().check()
    head.update(limits=len(records.finest().limits), margin=min(calibration.MARGINS, key=lambda name: checked["scores_by_other_reports"][name]), **checked)
    return records


def join(head, before, runs):
    """the runs of earlier records, with the head of all; HVIError: they are of another rule, or one of them was run again"""
    def rule(of):
        return {**of["spacing"], "across": None}, of["settings"], calibration.complete(of)

    if rule(before.head) != rule(head):
        raise HVIError("--add: those records have other spacings, settings or another model than the study")
    for name, digest in before.head["materials"].items():
        if head["materials"].setdefault(name, digest) != digest:
            raise HVIError(f"--add: those records were run with another {name} than the study: run them again")
    searches = [{(run.shield, run.across, run.shift) for run in some} for some in (before.runs, runs)]
    if twice := sorted(searches[0] & searches[1]):
        raise HVIError(f"--add: {twice[0][0]} with {twice[0][1]:g} across, shift {twice[0][2]:g}, is in those records and in the study")
    runs[:0] = before.runs
    across = sorted({*before.head["spacing"]["across"], *head["spacing"]["across"]})
    head.update(rows=len(runs), shields=len({run.shield for run in runs}), spacing={**head["spacing"], "across": across}, materials=dict(sorted(head["materials"].items())),
                versions=sorted({*before.head.get("versions", ()), *head["versions"]}), command=f"{head['command']} --add those of {before.head['date']}: {before.head['command']}")


def within(path):
    """a path of the source tree as from its root, of another file the name"""
    path = pathlib.Path(path).resolve()
    return path.relative_to(ROOT) if ROOT in path.parents else path.name


def write(path, records):
    """what calibration.read() reads"""
    rows = [["" if value != value else value for value in vars(run).values()] for run in records.runs]
    with writing(path), texts.whole(path) as stream:
        stream.writelines(f"# {line}\n" for line in engine.yaml_of(records.head).splitlines())
        tables.csv_to(stream, calibration.COLUMNS, rows)
