# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Tables and sentences of the report on speed against error, as blocks, from the points of cases."""

import math
import statistics

import pareto
from blocks import Bold, Marks, Number, Table, number

NEEDS = ("The cheapest settings of this package that answer within a bound, with core-seconds of the time loop on an idle core. The error of all "
         "finer runs of the same settings is within the bound, too; ? where there is no finer run that says so. In brackets: the least error where "
         "none is within.")


def unit_of(case):
    unit = str(case["error"].get("unit", ""))
    return "" if unit == "1" else unit


def error_text(p):
    """mean error with its scatter and the number of runs, in the unit of the case"""
    if p.error is None:
        return Number("-")
    if p.scatter is None:
        return number(p.error)
    text, scatter = number(p.error), number(p.scatter)
    if "e" not in text and p.error > 0:  # the digits of number(), with zeros at the end
        places = max(0, 2 - math.floor(math.log10(p.error)))
        text, scatter = f"{p.error:.{places}f}", f"{p.scatter:.{places}f}"
    return Number(f"{text} +- {scatter} ({p.runs})")


def with_unit(p):
    return f"{error_text(p)} {unit_of(p.case)}".strip()


def at_cost(p):
    return f"{p.name}: {number(p.cost)} s" if p.timed else f"{p.name} (not timed)"


def ratio(x):
    return "-" if x is None else f"x {x:.2f}" if 0.1 <= x < 10 else f"x {number(x)}"


# ---------------------------------------------------------------------- all cases
def standing_text(case, points):
    """is the default on the front, in words"""
    said = pareto.standing(case, points)
    if said.word != "dominated":
        return {"front": "yes", "within 5 %": "yes, within 5 %", "no default": "no default named", "not run": "default not run",
                "fails": "default fails", "ledger open": "its ledger is open"}.get(said.word, "not known: not timed")
    other = "" if said.by.ours else " (not of this package)"
    return f"no: {said.by.name}{other}: cost {ratio(said.cost_ratio)}, error {ratio(said.error_ratio)}"


def headline(cases, points):
    """the default of each case, whether it is on the front, the cheapest run"""
    rows = []
    for name, runs in points.items():
        case, default = cases[name], next((p for p in runs if p.default), None)
        cheap = min((p for p in runs if p.counts and p.ours and p.timed), key=lambda p: (p.cost, p.error), default=None)
        unit = unit_of(case)
        said = standing_text(case, runs)
        shown = default if default and default.error is not None else None
        rows.append([case["title"], case["error"]["main"] + (f", {unit}" if unit else ""), default.name if default else "-",
                     error_text(shown) if shown else Number("-"), number(shown.cost if shown else None),
                     Bold(said) if said.startswith("no:") else said, f"{at_cost(cheap)}, {with_unit(cheap)}" if cheap else "-"])
    return Table(["case", "error", "default", "its error", "core-s", "on the front", "cheapest run"], rows)


def finer_text(case):
    """what is known of a finer run, where that is a value whose error is the main one"""
    crossing = case.get("crossing")
    if not crossing or "finest" not in case:
        return ""
    return f" (finer: {number(100 * abs(case['finest']['numbers'][crossing['as']] / crossing['reference'] - 1))} %)"


def experiments(cases, points):
    """the default of each case that was measured, but of single shots, whose verdicts are right or wrong by chance"""
    rows = []
    for name, runs in points.items():
        case, default = cases[name], next((p for p in runs if p.default and p.counts), None)
        if case["group"] == "measured" and "shots" not in case and default:
            rows.append([case["title"], default.name, f"{error_text(default)} {unit_of(case)}{finer_text(case)}", number(default.cost)])
    return Table(["measured", "settings", "mean error", "core-seconds"], rows)


def need_cell(need, bound):
    found = need.answers[bound]
    if found:
        return at_cost(found.point) + ("" if found.sure else " ?")
    if need.best is None:
        return "- (no run counts)"
    return f"- (best {number(need.best.percent)} %)" if need.best.percent is not None else f"- (error in {unit_of(need.case) or 'no unit'})"


def needs(cases, points, questions=None):
    """the table What does a scene need; questions: those that are in it, all if None"""
    found, rows, last = pareto.scene_needs(cases, points, questions=questions), [], None
    for need in found:
        title = pareto.QUESTIONS.get(need.question, need.question)
        name = need.case["title"] if need.of == need.case["error"]["main"] else f"{need.case['title']}: {need.of}"
        rows.append(["" if title == last else title, name, *(need_cell(need, bound) for bound in pareto.BOUNDS)])
        last = title
    return Table(["question", "case", *(f"within {bound} %" for bound in pareto.BOUNDS)], rows)


def failures(cases, points, records):
    """what failed, cannot be done, or has an open ledger"""
    rows = []
    for runs in points.values():
        for p in runs:
            why = p.failed or (p.cannot and f"cannot: {p.cannot}") or (p.open and open_text(p))
            if why:
                rows.append([p.case["title"], p.method, p.text or "-", why])
    for name, case in cases.items():
        if case["group"] == "steps":
            found = step_costs(case, [r for r in records if r["case"] == name])
            rows += [[case["title"], c["method"], c["text"] or "-", c["why"]] for c in found if c["why"]]
    return Table(["case", "method", "settings", "why"], rows)


def open_text(p):
    return f"ledger open: energy off by {number(100 * p.energy)} %" if p.energy == p.energy else "ledger open: energy is no number"


# ---------------------------------------------------------------------- one case
def runs(case, points):
    """All runs of a case; other errors each in a column, or in one where there are many"""
    best = {id(p) for p in pareto.front(points)}
    main = case["error"]["main"]
    others = list(dict.fromkeys(name for p in points for name in p.errors if name != main))
    apart = others if len(others) <= 3 else []
    rows = []
    for p in points:
        said = p.failed or (p.cannot and f"cannot: {p.cannot}") or (p.open and open_text(p)) or ("" if p.timed else "not timed: cores were busy")
        marks = Marks(*(["default"] if p.default else []), *(["front"] if id(p) in best else []))
        done = p.error is not None
        row = [marks, p.method, p.text, *(number(x if done else None) for x in (p.particles, p.steps)), number(p.cost), number(p.rate),
               number(p.memory and round(p.memory)), error_text(p)]
        if apart or not others:
            row += [number(p.errors.get(name)) for name in apart]
        else:
            row.append("; ".join(f"{name} {number(p.errors[name])}" for name in others if name in p.errors))
        rows.append([*row, number(p.energy), number(p.momentum), said])
    unit = unit_of(case)
    return Table(["mark", "method", "settings", "particles", "steps", "core-s", "us per particle-step", "MB", main + (f" ({unit})" if unit else ""),
                  *(apart or (["other errors"] if others else [])), "energy", "momentum", "remark"], rows)


def variations(case, points):
    """what one setting changes, around the default"""
    rows = []
    for v in pareto.variations(case, points):
        p, base, key = v.point, v.base, case["resolution"]
        timed = p.timed and base.timed
        cost = ratio(p.cost / base.cost) if timed and base.cost else "-"
        error = ratio(p.error / base.error) if base.error else "-"
        text = Bold if v.word == "dominates" else str
        at = pareto.word(pareto.value(case, base.settings, key)) if v.name != key else "-"
        rows.append([text(v.name), text(f"{v.old} to {v.new}"), Number(at), text(cost), error_text(base), error_text(p), text(error), Marks(v.word)])
    return Table(["setting", "change", f"at {case['resolution']}", "cost", "error of default", "error", "ratio", "so it"], rows)


def others(case):
    """points of other people"""
    unit = unit_of(case)
    rows = [[str(o["name"]), number(float(o["core_s"])), number(float(o["error"])), str(o.get("source", ""))] for o in case.get("points") or []]
    return Table(["published by others", "core-s", f"error{f' ({unit})' if unit else ''}", "source"], rows)


# ---------------------------------------------------------------------- the cost of a step
def step_costs(case, records):
    """A dict for each method and settings but for repetitions: method, settings, text, particles, why (it failed), rates (us of a core per
    particle and step, of idle runs), bytes per particle. records: of this case"""
    groups = {}
    for r in records:
        settings = {"ranks": r.get("ranks", 1), **r["settings"]}
        others = tuple((name, pareto.plain(v)) for name, v in sorted(settings.items()) if name not in ("method", "repeat"))
        groups.setdefault((others, r["method"]), []).append(r)
    order, found = list(case["methods"]), []
    for settings, method in sorted(groups, key=lambda key: (str(key[0]), order.index(key[1]) if key[1] in order else -1)):
        group = pareto.latest(groups[settings, method])
        whys = [pareto.without_folders(r.get("failed") or r.get("cannot")) for r in group if r.get("failed") or r.get("cannot")]
        idle = [r for r in group if r.get("idle") and not whys]
        found.append({"method": method, "settings": settings, "text": ", ".join(f"{name} {pareto.word(v)}" for name, v in settings),
                      "particles": None if whys else group[0]["particles"], "why": "; ".join(dict.fromkeys(whys)),
                      "rates": [1e6 * r["loop_s"] * r.get("ranks", 1) / (r["particles"] * r["steps"]) for r in idle],
                      "bytes": pareto.largest(r.get("numbers", {}).get("bytes_per_particle") for r in group)})
    return found


def steps(case, records):
    """medians of step_costs with the least and the most, beside the default's in the same settings"""
    found, default = step_costs(case, records), (case.get("default") or {}).get("method")
    usual = {c["settings"]: statistics.median(c["rates"]) for c in found if c["method"] == default and c["rates"]}
    rows = []
    for c in found:
        rates, unit = c["rates"], usual.get(c["settings"])
        middle = statistics.median(rates) if rates else None
        spread = f"{number(min(rates))} to {number(max(rates))}" if len(rates) > 1 else "-"
        rows.append([Marks("default") if c["method"] == default else "", c["method"], c["text"], number(c["particles"]), number(middle), spread,
                     Number(f"{middle / unit:.2f}") if rates and unit else Number("-"), number(c["bytes"] and round(c["bytes"])),
                     c["why"] or ("" if rates else "not timed: cores were busy")])
    names = ["mark", "method", "settings", "particles", "us per particle-step", "least to most", "of the default's", "bytes per particle", "remark"]
    return Table(names, rows)
