# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Impacts of the examples beside experiments: an input that writes result.yaml, run with -var settings. What a case file has for it:

scene: input that is run, from the folder bench on; a method may have one of its own. Settings are its variables. Or a case of hvi shield, a YAML file: settings
  are dx (mm), shift, method, and those of a case; or a study of hvi shots
base: variables of all runs; common: those of runs of scene only, not of a method's own; methods: those of each, over base; or cannot: why
after: measure: what a run has recorded is measured by hvi measure and put into its result.yaml
measures: {name of a number: key of result.yaml}, or in one of methods (stock inputs)
reference: {name: measured value}, or targets: {method: {name: value}}; errors: "mean error" over these and one of each, %
finest: {numbers: {name: value}}, our own finest run, or in one of methods: error "to finest", %
parts: runs that are one point together, each with variables and reference of its own; errors are means over them
divide: {dx: [t, layers]}: a variable as the quotient of two, of which the second is none of the input
table: {file: CSV, names: [...], variables: [columns], reference: {name: column}}: rows of a table are the parts
crossing: {of: name, at: value, over: variable, scale: factor, as: name, reference: value}: the variable at which a number of the parts falls
  through a value
shots: [names]: the parts are published shots of the study, and the error is the share of wrong verdicts, %; setting finer divides the spacings that its
  rule gives
meshes: {file: words of hvi mesh}: walls of elements for methods that have them, of 2 or 3 particles each way
drift: true: the error is the largest and the last deviation of the books of energy, %
combine: {name: measures}: a further error, the mean of those of these measures
Of parts, steps are the sum and particles the mean over them. The ledger's energy is that of the end; energy_largest is the largest deviation
in the output of the run.
"""

import csv
import math
import os
import re
import time

from . import ROOT, Cannot, shields

from hvi.errors import HVIError
from hvi.jobs import engine, measures
from hvi.shield import elements, shots
from lammps_runs import Stopped, executor

BENCH = ROOT / "bench"
OPEN = 1e-3  # of the initial energy: a ledger that is farther off at the end is a failure; during the impact of few particles it swings by more
OURS = ("method", "ranks", "repeat")  # settings that are none of the input's
OWN = ("scene", "measures", "finest", "meshes", "cannot")  # words of a method that are none, either
UNIT = re.compile(r"_(mm|km_s|m_s|GPa)$")
BIG = ("*.dump", "*.data", "*.restart.*", "*.restart", "*.png")


def run(case, settings, folder, lmp, ranks=1, timeout=600):
    """as bench/runners/__init__.py has it"""
    name = settings["method"]
    if name not in case["methods"]:
        raise HVIError(f"{case['title']}: no method '{name}' among {', '.join(case['methods'])}")
    method = case["methods"][name] or {}
    if "cannot" in method:
        raise Cannot(method["cannot"])
    os.environ.setdefault("LAMMPS_POTENTIALS", os.pathsep.join([str(ROOT / "potentials"), str(ROOT / "examples" / "spall")]))
    variables = variables_of(case, method, settings)
    source = source_of(BENCH / method.get("scene", case["scene"]))
    record = {"particles": 0, "steps": 0, "loop_s": 0.0, "errors": {}, "numbers": {}, "ledger": {}, "failed": ""}
    end, done, moved = time.monotonic() + timeout, [], 0
    for number, (part, given, reference) in enumerate(parts(case, name, variables, source)):
        where = folder / str(number)
        where.mkdir(parents=True)
        for file, words in (method.get("meshes") or {}).items():
            make_mesh(where / file, given, words)
        source.check(given, case["title"])
        try:
            found, ledger, seconds = one(source, given, where, lmp, ranks, max(end - time.monotonic(), 1.0), case.get("after"))
        except Stopped as why:
            record["failed"] = f"{part}: {why}" if part else str(why)
            return record
        finally:
            for pattern in BIG:
                for path in where.glob(pattern):
                    path.unlink()
        record["steps"] += int(found["steps"])
        moved += int(found["steps"]) * int(found["particles"])
        record["particles"] = round(moved / max(record["steps"], 1))
        record["loop_s"] = round(record["loop_s"] + seconds, 4)
        for key, value in ledger.items():
            record["ledger"][key] = max(value, record["ledger"].get(key, 0.0))
        done.append((part, given, reference, found))
        record["starts"] = len(done)
    answers(case, method, done, record)
    if not record["failed"] and record["ledger"].get("energy", 0.0) > OPEN:
        record["failed"] = f"energy off by {100 * record['ledger']['energy']:.2g} %"
    return record


def source_of(scene):
    """an input, or what writes one"""
    return shields.Shields(scene) if scene.suffix == ".yaml" else engine.Input(scene)


def variables_of(case, method, settings):
    """of the input: what the case says, over that the method, over that the settings"""
    return {**({} if "scene" in method else case.get("common", {})), **case.get("base", {}), **{k: v for k, v in method.items() if k not in OWN},
            **{k: v for k, v in settings.items() if k not in OURS}}


def parts(case, name, variables, source):
    """[(name, variables, reference), ...] of the runs that are one point together"""
    if "shots" in case:
        return [(shot.name, {"shot": shot.name, **variables}, {"verdict": shots.OBSERVED[shot.observed]}) for shot, _ in source.published(case["shots"])]
    if "table" in case:
        return from_table(case["table"], variables)
    found, reference = [], case.get("targets", {}).get(name, case.get("reference", {}))
    for part in case.get("parts", [{}]):
        given = {**variables, **{k: v for k, v in part.items() if k not in ("name", "reference")}}
        for quotient, (over, under) in case.get("divide", {}).items():
            if not float(given.get(under) or 0) > 0:
                raise HVIError(f"{case['title']}: {under} must be a number above 0, not {given.get(under)}")
            given[quotient] = round(float(given[over]) / float(given.pop(under)), 9)
        found.append((part.get("name", ""), given, part.get("reference", reference)))
    return found


def from_table(words, variables):
    """parts of a CSV file: rows by name, columns that are variables, and columns that are measured"""
    with open(BENCH / words["file"], encoding="utf-8") as lines:
        rows = {row["name"]: row for row in csv.DictReader(line for line in lines if not line.startswith("#"))}
    if missing := [name for name in words["names"] if name not in rows]:
        raise HVIError(f"{words['file']}: no row {', '.join(missing)}")
    return [(name, {**{column: rows[name][column] for column in words["variables"]}, **variables},
             {measure: float(rows[name][column]) for measure, column in words["reference"].items()}) for name in words["names"]]


def make_mesh(path, variables, words):
    """the wall in elements of n particles of the spacing each way; Cannot if the layers of particles are no whole elements"""
    dx = float(variables["dx"])
    layers, n = shields.whole_elements(1e3 * words["thickness"], dx)
    element = 1e-3 * n * dx
    elements.write(path, **words, element=element, n=n, layers=layers // n, growth=elements.GROWTH, largest=elements.LARGEST * element)


def one(source, variables, folder, lmp, ranks, timeout, after=None):
    """runs the input, and hvi measure if that comes after; (result.yaml, ledger, loop time in s)"""
    words = {k: v if isinstance(v, list) else str(v) for k, v in variables.items()}
    try:
        if isinstance(source, shields.Shields):
            r, result = source.run(executor(lmp, folder), variables, folder, nranks=ranks, timeout=timeout)
        else:
            source.copy_to(folder)  # with what it includes
            r, result = executor(lmp, folder)(folder / source.name, nranks=ranks, vars=words, timeout=timeout), None
    except Stopped as why:  # an input that refuses something prints it before it quits
        lines = [line for path in folder.glob("log.*") for line in path.read_text().splitlines()]
        said = [line for line in lines if line.strip() and not line.startswith(("quit", "Total wall"))]
        raise Stopped(f"{why}: {said[-1]}" if said and str(why).startswith("ended with") else str(why)) from None
    try:
        result = result or (measures.measure(folder) if after == "measure" else engine.read_yaml(folder / "result.yaml"))
    except HVIError as why:
        raise Stopped(str(why)) from None
    if not result or "particles" not in result or "steps" not in result:
        raise Stopped("no complete result.yaml")
    ledger = {}
    ratios = [float(x) for table in r.runs for name in ("c_book[9]", "v_kept") if name in table for x in table[name]]
    ratios += [float(result["energy_ratio"])] if "energy_ratio" in result else []
    if ratios:
        off = [abs(x - 1.0) if math.isfinite(x) else math.inf for x in ratios]
        ledger.update(energy=off[-1], energy_largest=max(off))
    if "momentum_error" in result:
        ledger["momentum"] = float(result["momentum_error"])
    if not all(math.isfinite(x) for x in ledger.values()):
        raise Stopped("energy or momentum is not finite")
    seconds = sum(float(x) for x in re.findall(r"^Loop time of (\S+) on", r.log, re.M))
    return result, ledger, seconds


def answers(case, method, done, record):
    """numbers and errors of the parts into the record; what is missing or no number is its failure"""
    measures = method.get("measures", case.get("measures", {}))
    errors, wrong = {}, 0
    for part, _, reference, found in done:
        ahead = f"{part} " if part else ""
        for name, key in measures.items():
            value = found.get(key)
            if name == "verdict":
                wrong += value != reference[name]
                record["numbers"][f"{ahead}right"] = int(value == reference[name])
                continue
            try:
                value = float(value)
            except (TypeError, ValueError):
                value = math.nan
            if not math.isfinite(value):
                record["failed"] = record["failed"] or f"{ahead}no {name}: {found.get('record', found.get(key))}"
                continue
            record["numbers"][ahead + name] = value
            if name in reference:
                errors.setdefault(name, []).append(100 * abs(value / float(reference[name]) - 1.0))
    if "verdict" in measures:
        record["errors"]["wrong verdicts"] = 100.0 * wrong / len(done)
    if case.get("drift"):
        record["errors"] = {"largest drift": 100 * record["ledger"]["energy_largest"], "drift at the end": 100 * record["ledger"]["energy"]}
    if "crossing" in case and not record["failed"]:
        crossing(case["crossing"], done, measures, record, errors)
    if record["failed"]:
        return
    if errors:
        mean = {UNIT.sub("", name): sum(x) / len(x) for name, x in errors.items()}
        parts = {name: sum(mean[UNIT.sub("", m)] for m in of) / len(of) for name, of in case.get("combine", {}).items()}
        record["errors"] = {"mean error": sum(mean.values()) / len(mean), **(mean if len(mean) > 1 else {}), **parts, **record["errors"]}
    finest = method.get("finest", case.get("finest", {})).get("numbers", {})
    apart = [abs(record["numbers"][name] / value - 1.0) for name, value in finest.items() if name in record["numbers"]]
    if apart:
        record["errors"]["to finest"] = 100 * sum(apart) / len(apart)


def crossing(words, done, measures, record, errors):
    """the variable at which a number falls through a value between two parts, by a straight line, as a number of its own"""
    rows = [(float(given[words["over"]]), float(found[measures[words["of"]]])) for _, given, _, found in done]
    for (x0, y0), (x1, y1) in zip(rows, rows[1:]):
        if y0 >= words["at"] > y1:
            value = words.get("scale", 1.0) * (x0 + (x1 - x0) * (y0 - words["at"]) / (y0 - y1))
            record["numbers"][words["as"]] = value
            errors.setdefault(words["as"], []).append(100 * abs(value / words["reference"] - 1.0))
            return
    record["failed"] = (f"{words['of']} does not fall through {words['at']} from {rows[0][0]:g} to {rows[-1][0]:g}: "
                        + ", ".join(f"{y:.3g}" for _, y in rows))
