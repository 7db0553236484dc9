# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""How sure is a verdict, or a limit?  What tests have said of shields that were computed with such a margin.

A file of records has a row per run of the studies of hvi limits and hvi shots that were run, with its margins and what tests say of that wall and projectile. Of a
shield whose limit shots bracket, tests say that all thicker walls (smaller projectiles) hold and all thinner ones (larger) fail; within the bracket they say nothing.
That is taken for granted of margins, too: a shield that held with a large margin computed to be used up holds with a smaller one. So each shield has one vote on a margin,
however many runs it has.
"""

import dataclasses
import math
import pathlib
import re

from .. import texts
from ..errors import HVIError
from ..jobs import engine
from ..material import library
from . import brackets, shots
from .case import SETTINGS
from .projectile import FILLS

FILE = pathlib.Path(__file__).with_name("calibration.csv")
MARGINS = {"rear_plastic_strain": "a plastic strain of {:.2g} at its rear", "bulge_over_thickness": "a bulge of {:.2g} thicknesses",
           "failed_share": "failed particles down to {:.2g} of its layers"}  # of a wall that holds;
APART = "apart_over_projectile"  # of one that fails
ALIKE = 0.02  # lengths and speeds of one shield in two lists
COARSER = 1.1  # than the records' are spacings of a case that they may judge, at most: that of hvi limit stays while the diameter varies
FINER = 1.25  # likewise for the projectile's: with 14 across a wall holds that fails with 10, and in tests (examples/whipple-shield/limits)
HEAD: dict[str, type] = {**dict.fromkeys(("command", "date", "margin", "limits_in_the_band_of_the_others"), str), **dict.fromkeys(("rows", "shields"), int),
        **dict.fromkeys(("spacing", "settings", "model", "materials", "scores", "scores_by_other_reports"), dict)}  # what a file must say
MODEL = ("kernel", "eta", "pair", "solid", "debris", "C", "edge", "layers")  # settings that change what a run computes


def model_of(case):
    """{name: value} of what changes what a run computes, beside spacings"""
    return {**{name: case.setting(name) for name in MODEL}, "fill": case.projectile.fill}


def complete(head):
    """the model of a file of records, which may be older than some of the names"""
    given = {name: value for name, value in head["settings"].items() if name in MODEL}
    return {**{name: SETTINGS[name].default for name in MODEL}, "fill": head["spacing"].get("fill", FILLS[0]), **given, **head["model"]}


@dataclasses.dataclass(frozen=True)
class Run:
    """A row. on: what varies in its bracket, or a dash for a shot of none; low, high: of the bracket; limit: that the search has found, none for shots; test: holds, fails, or between"""

    shield: str
    source: str
    on: str
    km_s: float
    D_mm: float
    bumper_mm: float
    gap_mm: float
    wall_mm: float
    low: float
    high: float
    limit: float
    across: float
    shift: float
    verdict: str
    test: str
    bulge_over_thickness: float
    rear_plastic_strain: float
    failed_share: float
    apart_over_projectile: float

    def severity(self, by):
        """how near it was, for comparing: all that hold are below all that fail"""
        return (1, getattr(self, APART)) if self.verdict == "fails" else (0, getattr(self, by))

    def error(self):
        """of the computed limit, see brackets.error()"""
        return brackets.error(self.on, self.low, self.high, self.limit)

    def needed(self):
        """(least, most) by which the computed limit must be exceeded so that the measured one is: a wall by so many times, a diameter by 1 over that"""
        return tuple(sorted((edge / self.limit) ** (1 if self.on == "wall" else -1) for edge in (self.low, self.high)))


COLUMNS = tuple(field.name for field in dataclasses.fields(Run))
WORDS = {"on": (*brackets.ON, "-"), "verdict": shots.SAID, "test": ("holds", "fails", "between")}


def same_source(one, other):
    """of two reports by what lists call them: NASA CR-4343 and CR-4343"""
    a, b = (re.sub(r"\W|_", "", name).lower() for name in (one, other))
    return a in b or b in a


def may_judge(one, other, reports=False):
    """False of runs of the same shield, and of the same report if one is a shot by itself, or with reports whatever they are"""
    return one.shield != other.shield and not ((reports or "-" in (one.on, other.on)) and same_source(one.source, other.source))


def vote(runs, severity, by):
    """what the tests of one shield say of such a margin: holds, fails, or between"""
    held = any(run.test == "holds" and run.severity(by) >= severity for run in runs)
    failed = any(run.test == "fails" and run.severity(by) <= severity for run in runs)
    return "between" if held == failed else "holds" if held else "fails"


def counted(votes):
    votes = list(votes)
    return {"held": votes.count("holds"), "failed": votes.count("fails"), "between": votes.count("between"), "shields": len(votes)}


def lengths(case):
    """what a Run has of a case"""
    return {"km_s": case.speed_km_s, "D_mm": case.projectile.size_mm, "bumper_mm": case.walls[0].thickness_mm, "gap_mm": case.walls[-1].gap_mm, "wall_mm": case.walls[-1].thickness_mm}


def scope(of):
    """in what a case must be within the records; of: lengths()"""
    return {"speed in km/s": of["km_s"], **{f"{words} over diameter": of[name] / of["D_mm"] for name, words in (("bumper_mm", "wall 1"), ("gap_mm", "gap"), ("wall_mm", "wall 2"))}}


def of_result(case, result, **more):
    """the Run of a result.yaml; nothing if another wall than the last decided"""
    margins = result.get("margins") or {}
    if result.get("decided_by") != f"wall{len(case.walls)}" or not margins:
        return None
    mg = 1e-3 * library.density_of(library.of_case(case.material), si=True)[0] * case.projectile.volume_mm3
    found = {"failed_share": margins["deepest_failed_layer"] / margins["layers"], APART: margins["apart_mass_mg"] / mg,
             **{name: margins[name] for name in ("bulge_over_thickness", "rear_plastic_strain")}}
    empty = {**dict.fromkeys(COLUMNS, math.nan), "shield": "", "source": "", "on": "-", "test": "between"}
    return Run(**{**empty, **lengths(case), "verdict": result["verdict"], **{name: float(f"{value:.4g}") for name, value in found.items()}, **more})


# ---------------------------------------------------------------------- the file
@dataclasses.dataclass(frozen=True)
class Records:
    """head: what the file says of itself; runs: its rows; left_out: shields that were taken out, for the case in question is theirs"""

    head: dict
    runs: tuple
    left_out: tuple = ()

    @property
    def shields(self):
        """{name: its runs that have a verdict}"""
        found = {}
        for run in self.runs:
            found.setdefault(run.shield, []).extend([run] if run.verdict != "undecided" else [])
        return {name: runs for name, runs in found.items() if runs}

    @property
    def limits(self):
        """{name: a run with the geometric mean of the limits over shifts}, of brackets"""
        return {name: dataclasses.replace(of[0], limit=math.prod(run.limit for run in of) ** (1 / len(of))) for name, of in self.limits_by_shift.items()}

    @property
    def limits_by_shift(self):
        """{name: [a run with the limit of each shift, ...]}, of brackets"""
        found = {}
        for run in self.runs:
            if run.limit == run.limit:
                found.setdefault(run.shield, {})[run.shift] = run
        return {name: list(of.values()) for name, of in found.items()}

    def near(self, km_s):
        """{name: {"km_s": speed, "errors_percent": [of each shift]}}: computed limits beside measured ones, of all shields at the same or the next lower speed and at the next higher one"""
        of, speeds = self.limits_by_shift, {runs[0].km_s for runs in self.limits_by_shift.values()}
        near = {max((v for v in speeds if v <= km_s), default=None), min((v for v in speeds if v > km_s), default=None)}
        return {name: {"km_s": runs[0].km_s, "errors_percent": [round(100 * run.error()) for run in runs]} for name, runs in of.items() if runs[0].km_s in near}

    def finest(self):
        """those of the most particles across"""
        most = max(run.across for run in self.runs)
        return dataclasses.replace(self, runs=tuple(run for run in self.runs if run.across == most))

    def without(self, runs, reports=False):
        """those that may judge these runs"""
        return dataclasses.replace(self, runs=tuple(run for run in self.runs if all(may_judge(one, run, reports) for one in runs)), left_out=tuple(dict.fromkeys(run.shield for run in runs)))

    def votes(self, severity, by):
        return counted(vote(runs, severity, by) for runs in self.shields.values())

    # ------------------------------------------------------------------ nothing is judged by itself
    def share(self, run, by, reports=False):
        """of those that held at such a margin; what is between counts as a half. by None: of those of the same verdict, whatever the margin"""
        others = self.without([run], reports)
        if by:
            of = others.votes(run.severity(by), by)
            return (of["held"] + 0.5 * of["between"]) / of["shields"] if of["shields"] else 0.5
        each = [[one.test == "holds" for one in runs if one.verdict == run.verdict and one.test != "between"] for runs in others.shields.values()]
        shares = [sum(held) / len(held) for held in each if held]
        return sum(shares) / len(shares) if shares else 0.5

    def score(self, by, reports=False):
        """mean squared error of share(), each shield weighing once: 0 is right, 0.25 what a coin has"""
        errors = []
        for runs in self.shields.values():
            if known := [(self.share(run, by, reports) - (run.test == "holds")) ** 2 for run in runs if run.test != "between"]:
                errors.append(sum(known) / len(known))
        return sum(errors) / len(errors) if errors else math.nan

    def check(self):
        """{what: its score}, and of how many shields the measured limit is in the band of the others"""
        limits, inside = self.limits, 0
        for one in limits.values():
            others = [other.needed() for other in self.without([one]).limits.values()]
            low, high = one.needed()
            inside += bool(others) and low <= max(most for _, most in others) and high >= min(least for least, _ in others)
        scores = [{name or "verdict alone": round(self.score(name, reports), 4) for name in (None, *MARGINS)} for reports in (False, True)]
        return {"scores": scores[0], "scores_by_other_reports": scores[1], "limits_in_the_band_of_the_others": f"{inside} of {len(limits)}"}

    # ------------------------------------------------------------------ what they say of a case
    def for_case(self, case, varied=()):
        """those that may judge a case; HVIError: it is outside of what they cover. varied: attributes of a Run that the question leaves open"""
        why = self.outside(case)
        found = None if why else self.alike(case)
        if not why and found is None:
            why = [f"its spacings are {'coarser' if max(self.over(case, min(run.across for run in self.runs))) > COARSER else 'finer'} than those of the records, and answers go with them"]
        if why:
            raise HVIError(f"the case is outside of what the records cover: {'; '.join(why)}")

        def same(run):
            free = {*varied, {"wall": "wall_mm", "diameter": "D_mm"}.get(run.on)}
            return all(abs(getattr(run, name) / value - 1) < ALIKE for name, value in lengths(case).items() if name not in free)

        runs = tuple(run for run in self.runs if run.across == found[0])
        return dataclasses.replace(self, runs=runs).without([run for run in runs if same(run)])

    def alike(self, case):
        """(particles across of records, which of the case's spacings is theirs), the finest that is one, or None"""
        for which in reversed(range(len(case.spacings_mm))):
            for across in sorted({run.across for run in self.runs}, reverse=True):
                over = self.over(case, across, which)
                if over[0] >= 1 / FINER and max(over) <= COARSER:
                    return across, which
        return None

    def over(self, case, across, which=-1):
        """a case's spacings, of the projectile and of walls, over those that the rule of the records makes"""
        near, far = shots.spacings({**self.head["spacing"], "across": across}, *(lengths(case)[name] for name in ("D_mm", "bumper_mm", "wall_mm")))
        given = [case.spacings_mm[which], *((wall.spacings_mm or case.spacings_mm)[which] for wall in case.walls)]
        return [dx / least for dx, least in zip(given, (near, near, far))]

    def outside(self, case):
        """in which ways a case is not like the records, as texts"""
        found = [] if case.projectile.shape == "sphere" else [f"its projectile is a {case.projectile.shape}, not a sphere"]
        found += [f"it has {len(case.walls)} wall{'s' * (len(case.walls) > 1)}, not 2"] if len(case.walls) != 2 else []
        found += [f"angle_deg is {case.angle_deg:g}, not 0"] if case.angle_deg else []
        found += ["it has what is not modelled"] if case.not_modelled else []
        found += [f"method is {case.method()}, not sph"] if case.method() else []
        for name in dict.fromkeys([case.material, *(wall.material for wall in case.walls)]):
            known, path = self.head["materials"].get(pathlib.Path(name).name), library.of_case(name)
            if known is None:
                found.append(f"{library.stem(name)} is in none of them")
            elif not path.is_file() or engine.digest(path.read_bytes()) != known:
                found.append(f"the file of {library.stem(name)} is not that of the records")
        known = complete(self.head)
        found += [f"{'projectile' if name == 'fill' else 'settings'}: {name} is {value}, not {known[name]}" for name, value in model_of(case).items() if value != known[name]]
        for name, value in scope(lengths(case)).items() if not found else ():
            values = [scope(vars(run))[name] for run in self.runs]
            if not min(values) * 0.999 <= value <= max(values) * 1.001:
                found.append(f"{name} {value:.3g}, of the records {min(values):.3g} to {max(values):.3g}")
        return found

    def basis(self):
        return {"runs": len(self.runs), "left_out": list(self.left_out), "records": f"{self.head['date']}: {self.head['command']}"}

    def of_verdict(self, case, results):
        """how many shields held with the margin of a case; results: {member: result.yaml} of all its runs"""
        verdicts = {result["verdict"] for result in results.values()}
        if verdicts not in ({"holds"}, {"fails"}):
            raise HVIError("runs that are undecided, or differ, have no margin: hvi limit says how near the limit is")
        records, by = self.for_case(case), self.head["margin"]
        runs = [of_result(case, result) for (which, _), result in results.items() if which == self.alike(case)[1]]
        if None in runs:
            raise HVIError("the last wall does not decide, and records are of last walls")
        if not records.shields:
            raise HVIError("no records are left, all are of this shield")
        worst = max(runs, key=lambda run: run.severity(by))
        margin = APART if worst.verdict == "fails" else by
        return {"verdict": worst.verdict, "margin": margin, "value": getattr(worst, margin), **records.votes(worst.severity(by), by), **records.basis(),
                "near": records.near(case.speed_km_s), "score": self.head["scores_by_other_reports"][by]}

    def of_limit(self, limit, answer):
        """between which values the measured limit is, as those of the records are, and how many of their shields hold with the case's own value"""
        case, wall = limit.case, limit.key == "thickness_mm" and limit.wall == len(limit.case.walls) - 1
        if not (wall or limit.key == "size_mm"):
            raise HVIError(f"there are no measured limits over {answer['on']}: records are of the last wall's thickness and of diameters")
        computed, records = answer["limit"], self.for_case(limit.at(answer["limit"]), ["wall_mm" if wall else "D_mm"])
        needed = [one.needed() for one in records.limits.values()]
        if not needed:
            raise HVIError("no measured limits are left, all are of this shield")
        least, most = min(low for low, _ in needed), max(high for _, high in needed)
        times = (least, most) if wall else (1 / most, 1 / least)
        own = case.walls[-1].thickness_mm if wall else case.projectile.size_mm
        margin = own / computed if wall else computed / own
        votes = ["holds" if margin >= high else "fails" if margin < low else "between" for low, high in needed]
        change, ends = abs(answer["change_by_spacing"] or 0), answer["undecided"]
        numeric = max(min(ends[0], computed - change), 0), max(ends[1], computed + change)  # steps, shifts, spacings
        return {"measured_over_computed": [round(value, 4) for value in times], "band": [float(f"{end * by:.4g}") for end, by in zip(numeric, times)],
                "own": own, "margin": round(margin, 4), **counted(votes), **records.basis(), "near": records.near(case.speed_km_s), "in_the_band_of_the_others": self.head["limits_in_the_band_of_the_others"]}


def read(path=None):
    """The Records of a file: those of the package, or another's. Lines that begin with # are a mapping that says what it is of."""
    path = pathlib.Path(path or FILE)
    try:
        head = texts.load(path, "\n".join(line[1:].removeprefix(" ") for line in texts.read(path).splitlines() if line.startswith("#"))) or {}
    except HVIError:
        if not path.is_file():
            raise
        head = {}
    if missing := [key for key, kind in HEAD.items() if not isinstance(head, dict) or not isinstance(head.get(key), kind)]:
        raise HVIError(f"{path}: the lines that begin with # must say {', '.join(missing)}: make it with python3 -m hvi calibrate")
    names, rows = texts.table(path)
    if tuple(names) != COLUMNS:
        raise HVIError(f"{path}: the columns must be {','.join(COLUMNS)}")
    runs = []
    for number, row in rows:
        if len(row) != len(COLUMNS):
            raise HVIError(f"{path}, line {number}: {len(row)} values in {len(COLUMNS)} columns")
        cells = dict(zip(COLUMNS, row))
        for field in dataclasses.fields(Run):
            name, text = field.name, cells[field.name]
            if name in WORDS and text not in WORDS[name]:
                raise HVIError(f"{path}, line {number}: {name} must be {', '.join(WORDS[name])}, not {text!r}")
            if field.type is float:
                try:
                    cells[name] = float(text) if text else math.nan
                    if text and not math.isfinite(cells[name]):
                        raise ValueError
                except ValueError:
                    raise HVIError(f"{path}, line {number}: {name} must be a number, not {text!r}") from None
        runs.append(Run(**cells))
    found = Records(head, tuple(runs))
    if not runs or head["rows"] != len(runs) or head["shields"] != len({run.shield for run in runs}) or head["margin"] not in tuple(MARGINS):
        raise HVIError(f"{path}: its first lines speak of {head['rows']} rows of {head['shields']} shields by {head['margin']}, and there are {len(runs)} rows of "
                       f"{len({run.shield for run in runs})}: make it again with python3 -m hvi calibrate")
    return found


# ---------------------------------------------------------------------- for the eye
def tests(found):
    """of how many shields what is known"""
    left = f", without {', '.join(found['left_out'])}, which it is itself" if found["left_out"] else ""
    return (f"{found['held']} of {found['shields']} shields held in tests, {found['failed']} failed, of {found['between']} it is not known "
            f"({found['runs']} runs, records of {found['records'].partition(':')[0]}{left})")


def said_of_near(near):
    """lines of Records.near()"""
    def said(percent):
        return "right" if not percent else f"{abs(percent)} % {'safe' if percent > 0 else 'UNSAFE'}"

    each = ", ".join(f"{name} ({of['km_s']:g} km/s) {' / '.join(map(said, of['errors_percent']))}" for name, of in near.items())
    return [f"          computed limits of shields tested at the nearest speeds, by each shift (100 ln of computed over measured): {each}"] if near else []


def said_of_verdict(found):
    """lines of of_verdict(), or of the reason why there is nothing"""
    if isinstance(found, str):
        return [f"how sure: {found}"]
    apart = f"{found['value']:.2g} of the projectile's mass apart behind the wall"
    margin = apart if found["margin"] == APART else f"a wall that {found['verdict']} with {MARGINS[found['margin']].format(found['value'])}"
    worth = f"judged by other reports, such shares are off by {found['score']:.2g} in the mean square, a coin by 0.25"
    return [f"how sure: with {margin}, {tests(found)}", f"          {worth}{': the margin says nothing' if found['score'] >= 0.25 else ''}", *said_of_near(found.get("near", {}))]


def said_of_limit(found, unit):
    """the same of of_limit()"""
    if isinstance(found, str):
        return [f"how sure: {found}"]
    (least, most), (low, high) = found["measured_over_computed"], found["band"]
    return [f"how sure: measured limits were {least:.2f} to {most:.2f} times computed ones; with that and the band above, {low:g} to {high:g} {unit}",
            f"          of the records themselves, {found['in_the_band_of_the_others']} measured limits overlap such a band",
            f"          {found['own']:g} {unit}, of the case, is on the {'safe' if found['margin'] >= 1 else 'unsafe'} side by a factor of {found['margin']:.2f}: with it {tests(found)}",
            *said_of_near(found.get("near", {}))]
