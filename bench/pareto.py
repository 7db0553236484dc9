# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Records of bench/run.py as points of cost and error: averages over lattice shifts, Pareto fronts, cheapest settings for a bound.

A case is a file of bench/cases, a record one run of bench/run.py. Costs are core-seconds of LAMMPS's loops, of runs on idle cores only; errors
are magnitudes, in the unit of the case. A run counts if it came to its end with a finite error and with its books closed (LEDGER).
"""

import dataclasses
import json
import math
import pathlib
import re
import sys

import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
from hvi.errors import HVIError  # noqa: E402

LEDGER = 1e-3  # largest |E/E0 - 1| of a run whose books are closed
SAME = 0.05  # ratios nearer to 1 are no difference
BOUNDS = (2, 5, 10)  # %
OTHERS = ("stock", "machdyn", "smd", "ulsph", "tlsph", "bpm", "lj")  # how methods begin that are not of this package
QUESTIONS = {"wave": "arrival and stress of a wave", "hole": "hole in a wall", "cloud": "cloud behind a thin wall",
             "verdict": "does a Whipple wall hold", "fragments": "fragments of a projectile",
             "shock": "states behind a shock", "strength": "flow and shape of a metal"}
TYPICAL = list(QUESTIONS)[:5]  # of users
GROUPS = {"exact": "exact solutions", "measured": "experiments", "dem": "discrete elements", "steps": "cost of a step"}
APART = {"method", "shift", "repeat"}  # settings that are no parameters: shift moves the lattice, for the scatter
TOGETHER = ({"kernel", "h"}, {"kernel", "eta"})  # count as one: a kernel comes with its length


# ---------------------------------------------------------------------- cases and records
def load_cases(folder):
    """{name: case} of all NAME.yaml in a folder; a case has its name, and a list of questions, besides what is in the file."""
    cases = {}
    for path in sorted(pathlib.Path(folder).glob("*.yaml")):
        try:
            case = yaml.safe_load(path.read_text(encoding="utf-8"))
        except yaml.YAMLError as problem:
            mark = getattr(problem, "problem_mark", None)
            raise HVIError(f"{path}:{mark.line + 1 if mark else 1}: no YAML: {getattr(problem, 'problem', problem)}") from None
        if not isinstance(case, dict):
            raise HVIError(f"{path}: a case is a mapping with title, group, error, resolution and methods")
        lacks = [key for key in ("title", "group", "methods", *(() if case.get("group") == "steps" else ("error", "resolution"))) if key not in case]
        if lacks:
            raise HVIError(f"{path}: no {', '.join(lacks)}")
        if case["group"] not in GROUPS:
            raise HVIError(f"{path}: group must be {', '.join(GROUPS)}, not {case['group']}")
        if case["group"] != "steps" and not (isinstance(case["error"], dict) and "main" in case["error"]):
            raise HVIError(f"{path}: error must say its main measure: {{main: NAME, unit: UNIT}}")
        questions = case.get("question") or []
        cases[path.stem] = {**case, "name": path.stem, "base": case.get("base") or {},
                            "question": [questions] if isinstance(questions, str) else list(questions),
                            "asked": dict(questions) if isinstance(questions, dict) else {},  # which error answers it, if not the main one
                            "methods": {str(method): own or {} for method, own in dict(case["methods"]).items()}}
    if not cases:
        raise HVIError(f"{folder}: no case (*.yaml)")
    return cases


def texts(path):
    """(line, text) of each record of a file: one per line in .jsonl, the whole of another"""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as problem:
        raise HVIError(f"{path}: cannot be read: {getattr(problem, 'strerror', problem)}") from None
    return [(k, line) for k, line in enumerate(text.split("\n"), 1) if line.strip()] if path.suffix == ".jsonl" else [(1, text)]


def check(record, where):
    """raises HVIError if it is no record of a run"""
    if not isinstance(record, dict):
        raise HVIError(f"{where}: a record is a JSON object")
    for key, kind in (("case", str), ("method", str), ("settings", dict)):
        if not isinstance(record.get(key), kind):
            raise HVIError(f"{where}: no {key}" if key not in record else f"{where}: {key} must be a {'word' if kind is str else 'JSON object'}")
    if not record.get("failed") and not record.get("cannot"):
        for key, kind in (("errors", dict), ("loop_s", (int, float)), ("steps", (int, float)), ("particles", (int, float))):
            if not isinstance(record.get(key), kind):
                raise HVIError(f"{where}: no {key} in the record of a run that did not fail")


def load(paths):
    """All records of files and of folders (*.json, *.jsonl, also in folders of theirs), each checked. Returns a list of dicts."""
    found = []
    for path in map(pathlib.Path, paths):
        if not path.exists():
            raise HVIError(f"{path}: no such file or folder")
        found += sorted(p for p in path.rglob("*") if p.suffix in (".json", ".jsonl")) if path.is_dir() else [path]
    records = []
    for path in dict.fromkeys(found):
        for first, text in texts(path):
            try:
                record = json.loads(text)
            except json.JSONDecodeError as problem:
                raise HVIError(f"{path}:{first + problem.lineno - 1}: no JSON: {problem.msg}") from None
            check(record, f"{path}:{first}")
            records.append(record)
    if not records:
        raise HVIError(f"{', '.join(map(str, paths))}: no records: run bench/run.py first")
    return records


def plain(value):
    """a setting in one form: 400.0 is 400, a list can be compared"""
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return tuple(plain(v) for v in value) if isinstance(value, list) else value


def value(case, settings, name):
    """a setting of a run; else that of its method, else that of all runs of the case, else None"""
    own = case["methods"].get(settings.get("method"), {})
    return plain(settings.get(name, own.get(name, case["base"].get(name))))


def identity(case, settings):
    """what two runs have in common that differ in nothing, or in the shift of the lattice and the number of the repetition alone"""
    names = {*settings, *case["methods"].get(settings.get("method"), {}), *case["base"]} - {"shift", "repeat"}
    return tuple((name, repr(value(case, settings, name))) for name in sorted(names))


# ---------------------------------------------------------------------- points
@dataclasses.dataclass
class Point:
    """Runs of one case that differ in the shift of the lattice (and the number of the repetition) alone, as means.

    settings: with method and ranks, without shift. error, scatter: main error and its standard deviation (None of one run); errors: {name:
    mean}, scatters: of each. cost, cost_scatter: core-seconds, None if no run was on idle cores. rate: microseconds of a core per particle
    and step. memory: MB, the largest. energy, momentum: of the ledger, the largest; None if it was not kept. fine: the resolution, the
    larger the finer. extra: what differs from the default beyond method and resolution. text: settings in words, without the method.
    """

    case: dict
    method: str
    settings: dict
    runs: int
    failed: str = ""
    cannot: str = ""
    error: float = None
    scatter: float = None
    errors: dict = dataclasses.field(default_factory=dict)
    scatters: dict = dataclasses.field(default_factory=dict)
    cost: float = None
    cost_scatter: float = None
    rate: float = None
    particles: int = 0
    steps: int = 0
    memory: float = None
    energy: float = None
    momentum: float = None
    fine: float = None
    extra: dict = dataclasses.field(default_factory=dict)
    text: str = ""
    default: bool = False

    @property
    def open(self):
        """energy or momentum came or went unbooked"""
        return self.energy is not None and not self.energy <= LEDGER

    @property
    def counts(self):
        return not (self.failed or self.cannot or self.open)

    @property
    def timed(self):
        return self.cost is not None

    @property
    def ours(self):
        return not self.method.lower().startswith(OTHERS)

    @property
    def name(self):
        return ", ".join(filter(None, (self.method, self.text)))

    @property
    def percent(self):
        """the main error in percent; None if it has another unit"""
        scale = {"%": 1.0, "1": 100.0}.get(str(self.case["error"].get("unit", "")))
        return None if scale is None or self.error is None else scale * self.error


def magnitude(number):
    return abs(float(number)) if isinstance(number, (int, float)) and not isinstance(number, bool) else math.nan


def latest(records):
    """One record of each shift and repetition: the last, but a busy one does not replace an idle one of the same versions."""
    best = {}
    for r in sorted(records, key=lambda r: str(r.get("date", ""))):
        shift = repr([plain(r["settings"].get(name)) for name in ("shift", "repeat")])
        old = best.get(shift)
        if not (old and old.get("idle") and not r.get("idle") and old.get("versions") == r.get("versions") and not old.get("failed")):
            best[shift] = r
    return [best[shift] for shift in sorted(best)]


def without_folders(text):
    """a message without the folders of the machine where it was made"""
    return re.sub(r"(?<![\w.])/(?:[\w.+-]+/)+", "", " ".join(str(text).split()))


def spread(values):
    return float(np.std(values, ddof=1)) if len(values) > 1 else None


def largest(numbers):
    """of those that there are; nan if one is nan"""
    numbers = [abs(float(x)) for x in numbers if x is not None]
    return float(np.max(numbers)) if numbers else None


def point(case, records):
    """The Point of records that differ in shift alone"""
    first, main, ended = records[0], case["error"]["main"], []
    whys = []
    for r in records:
        error = magnitude(r.get("errors", {}).get(main))
        if r.get("failed") or r.get("cannot"):
            whys.append(without_folders(r.get("failed") or r["cannot"]))
        elif not math.isfinite(error):
            whys.append(f"no finite error '{main}'")
        else:
            ended.append(r)
    settings = {key: plain(v) for key, v in first["settings"].items() if key not in ("shift", "repeat")}
    p = Point(case, first["method"], settings, len(records))
    if whys:
        why = "; ".join(dict.fromkeys(whys)) + (f" ({len(whys)} of {len(records)} runs)" if ended else "")
        p.failed, p.cannot = ("", why) if all(r.get("cannot") for r in records) else (why, "")
    if ended:
        idle = [r for r in ended if r.get("idle")]
        p.errors = {name: float(np.mean([magnitude(r["errors"].get(name)) for r in ended])) for name in ended[0]["errors"]}
        p.scatters = {name: spread([magnitude(r["errors"].get(name)) for r in ended]) for name in p.errors}
        p.error, p.scatter = p.errors[main], p.scatters[main]
        if idle:
            costs = [r["loop_s"] * r.get("ranks", 1) for r in idle]
            work = [r.get("particle_steps") or r["particles"] * r["steps"] for r in idle]
            p.cost, p.cost_scatter = float(np.mean(costs)), spread(costs)
            p.rate = 1e6 * sum(costs) / sum(work) if sum(work) else None
        p.particles, p.steps = (round(float(np.mean([r[key] for r in ended]))) for key in ("particles", "steps"))
        p.memory = largest(r.get("memory_MB") or None for r in ended)  # 0: it was too short to be seen
        p.energy, p.momentum = (largest(r.get("ledger", {}).get(key) for r in ended) for key in ("energy", "momentum"))
    return p


def word(setting):
    if isinstance(setting, bool):
        return "yes" if setting else "no"
    if isinstance(setting, float):
        return f"{setting:.4g}"
    return " ".join(map(word, setting)) if isinstance(setting, tuple) else "-" if setting is None else str(setting)


def default_of(case, points):
    """the Point of the default, or None; where the case does not say on how many ranks, it is that of most of the points"""
    wanted = case.get("default")
    if not wanted:
        return None
    wanted = {"ranks": common_ranks(points), **wanted}
    return next((p for p in points if p.method == wanted.get("method")
                 and all(value(case, p.settings, name) == value(case, wanted, name) for name in {*p.settings, *wanted} - APART)), None)


def common_ranks(points):
    ranks = [p.settings["ranks"] for p in points]
    return max(sorted(set(ranks)), key=ranks.count)


def extra(case, p, usual):
    """{name: value} of what a run has else than usual (settings of the default), beyond method and resolution"""
    same, found = usual.get("method") == p.method, {}
    for name in sorted({*p.settings, *(usual if same else ())} - APART - {case["resolution"]}):
        here = value(case, p.settings, name)
        its_own = not same and name in case["methods"][p.method] and here == value(case, {"method": p.method}, name)
        if here != value(case, {**usual, "method": p.method}, name) and not its_own:
            found[name] = here
    return found


def points_of(case, records):
    """All Points of a case, in the order of its methods, from coarse to fine; records: those of this case."""
    groups = {}
    for r in records:
        if r["method"] not in case["methods"]:
            raise HVIError(f"case {case['name']}: a record has the method {r['method']}, the case file only {', '.join(case['methods'])}")
        r = {**r, "settings": {"ranks": r.get("ranks", 1), **r["settings"], "method": r["method"]}}
        groups.setdefault(identity(case, r["settings"]), []).append(r)
    points = [point(case, latest(group)) for group in groups.values()]
    key, sign = case["resolution"], -1 if case.get("finer", "up") == "down" else 1
    ranks, default = common_ranks(points), default_of(case, points)
    usual = {"ranks": ranks, **(default.settings if default else {})}
    for p in points:
        fine = value(case, p.settings, key)
        p.fine = sign * fine if isinstance(fine, (int, float)) else None
        p.default = p is default
        p.extra = extra(case, p, usual)
        own = {"method": p.method}
        said = [name for name in sorted(p.settings) if name not in APART | {key, "ranks"} and value(case, p.settings, name) != value(case, own, name)]
        said += ["ranks"] if p.settings["ranks"] != ranks else []
        p.text = ", ".join(f"{name} {word(value(case, p.settings, name))}" for name in ([key] if fine is not None else []) + said)
    order = list(case["methods"])
    return sorted(points, key=lambda p: (order.index(p.method), len(p.extra), str(p.extra), -math.inf if p.fine is None else p.fine, p.text))


def all_points(cases, records):
    """{case: its Points} of cases that have records, in the order of groups and names; cases without an error (group steps) are not in it"""
    of = {}
    for r in records:
        if r["case"] not in cases:
            raise HVIError(f"unknown case {r['case']}; there are {', '.join(cases)}")
        if cases[r["case"]]["group"] != "steps":
            of.setdefault(r["case"], []).append(r)
    order = sorted(of, key=lambda name: (list(GROUPS).index(cases[name]["group"]), name))
    return {name: points_of(cases[name], of[name]) for name in order}


# ---------------------------------------------------------------------- judgments
def front(runs):
    """The Pareto front, from cheap to accurate: runs that count, with a cost, of which no other is as cheap and as accurate."""
    best, found = math.inf, []
    for p in sorted((p for p in runs if p.counts and p.timed), key=lambda p: (p.cost, p.error)):
        if p.error < best:
            best = p.error
            found.append(p)
    return found


def side(a, b, scatter_a, scatter_b):
    """-1 if a is less than b, 1 if more, 0 if that is within SAME or the scatter; where one has no scatter it is taken for that of the other"""
    known = [s for s in (scatter_a, scatter_b) if s is not None]
    scatter = math.hypot(*(known * 2)[:2]) if known else 0.0
    return 0 if abs(a - b) <= max(SAME * abs(b), scatter) else int(math.copysign(1, a - b))


def sides(p, than):
    """(cost, error) of p against another Point: -1 better, 0 the same, 1 worse; cost None where a time is not known"""
    cost = side(p.cost, than.cost, p.cost_scatter, than.cost_scatter) if p.timed and than.timed else None
    return cost, side(p.error, than.error, p.scatter, than.scatter)


@dataclasses.dataclass
class Standing:
    """Where the default is: word "front", "dominated" or why that is not known; by: the run that dominates it, with ratios to the default"""

    word: str
    by: Point = None
    cost_ratio: float = None
    error_ratio: float = None


def standing(case, points):
    """Is the default on the front?  It is dominated by a run that is nowhere worse and somewhere better beyond SAME and scatter."""
    default = next((p for p in points if p.default), None)
    if default is None:
        return Standing("not run" if case.get("default") else "no default")
    if default.failed or default.cannot:
        return Standing("fails")
    if default.open:
        return Standing("ledger open")
    if not default.timed:
        return Standing("not timed")
    rivals = [p for p in points if p.counts and p.timed and p is not default and p.cost <= default.cost and p.error <= default.error]
    better = [p for p in rivals if -1 in sides(p, default)]
    if not better:
        return Standing("front" if default in front(points) else "within 5 %")
    by = min(better, key=lambda p: (not p.ours, p.cost / default.cost * (p.error / default.error if default.error else 1.0)))
    return Standing("dominated", by, by.cost / default.cost, by.error / default.error if default.error else None)


WORDS = {(-1, -1): "dominates", (1, 1): "dominated", (0, 0): "same", (-1, 1): "trade", (1, -1): "trade", (-1, 0): "cheaper", (1, 0): "dearer",
         (0, -1): "more accurate", (0, 1): "less accurate", (None, -1): "more accurate, not timed", (None, 0): "same error, not timed",
         (None, 1): "less accurate, not timed"}


@dataclasses.dataclass
class Variation:
    """A run that differs from the default in one setting, or in that and the resolution: then base is the default in that resolution"""

    name: str
    old: str
    new: str
    point: Point
    base: Point
    word: str


def variations(case, points):
    """Runs that differ from the default in exactly one setting (other methods in its resolution only), in the order of settings."""
    default = next((p for p in points if p.default), None)
    if default is None or default.error is None:
        return []
    key, found = case["resolution"], []
    plains = {p.fine: p for p in points if p.method == default.method and not p.extra and p.error is not None}
    for p in points:
        names = [", ".join(p.extra)] if set(p.extra) in TOGETHER else list(p.extra)
        names += ["method"] if p.method != default.method else []
        base = default if not names else plains.get(p.fine)
        if p is default or len(names) > 1 or base is None or p.error is None or (p.method != default.method and p.fine != default.fine):
            continue
        name = names[0] if names else key
        old, new = ([q.method if part == "method" else value(case, q.settings, part) for part in name.split(", ")] for q in (base, p))
        old, new = (", ".join(map(word, values)) if any(v is not None for v in values) else "unset" for values in (old, new))
        said = (p.failed and "fails") or (p.open and "ledger open") or WORDS[sides(p, base)]
        found.append(Variation(name, old, new, p, base, said))
    return sorted(found, key=lambda v: (v.name != key, v.name == "method", v.name, v.base.fine or 0.0))


@dataclasses.dataclass
class Answer:
    """The cheapest run within a bound: sure if finer runs of the same settings are within it, too"""

    point: Point
    sure: bool


def finer(p, points):
    """runs of the same method and settings in finer resolutions, whether they count or not; on any number of ranks"""
    def series(q):
        return [pair for pair in identity(q.case, q.settings) if pair[0] not in ("ranks", q.case["resolution"])]

    return [q for q in points if not q.cannot and p.fine is not None and q.fine is not None and q.fine > p.fine and series(q) == series(p)]


def answer(points, bound):
    """The cheapest Answer within bound (%), confirmed ones first; those without a time last. None if there is none.

    A run whose finer ones are not all within the bound has come there by luck; none is sure whose finer ones failed. With several shifts the
    mean and one standard deviation must be within it.
    """
    def within(p):
        return p.percent is not None and p.percent * (1.0 + (p.scatter / p.error if p.scatter and p.error else 0.0)) <= bound

    able = []
    for p in points:
        if p.counts and p.ours and within(p):
            better = finer(p, points)
            if all(within(q) for q in better if q.counts):
                able.append(Answer(p, bool(better) and all(q.counts for q in better)))

    def order(found):
        p = found.point
        return not p.timed, not found.sure, p.cost if p.timed else p.particles * p.steps

    return min(able, key=order, default=None)


@dataclasses.dataclass
class Need:
    """A line of the table What does a scene need: of: the error that answers it; answers: {bound: Answer or None}; best: the Point of the
    least error, None if no run counts"""

    question: str
    case: dict
    of: str
    answers: dict
    best: Point


def scene_needs(cases, points, bounds=BOUNDS, questions=None):
    """The cheapest settings within each bound, for each question (all if None) and case; points: of all_points(). Methods of the package only."""
    asked = questions or list(QUESTIONS) + sorted({q for case in cases.values() for q in case["question"]} - set(QUESTIONS))
    found = []
    for question in asked:
        for name, runs in points.items():
            if question in cases[name]["question"]:
                of = cases[name]["asked"].get(question) or cases[name]["error"]["main"]
                seen = [dataclasses.replace(p, error=p.errors.get(of), scatter=p.scatters.get(of)) for p in runs]
                best = min((p for p in seen if p.counts and p.ours and p.error is not None), key=lambda p: p.error, default=None)
                found.append(Need(question, cases[name], of, {bound: answer(seen, bound) for bound in bounds}, best))
    return found
