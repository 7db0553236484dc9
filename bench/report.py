#!/usr/bin/env python3
# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Speed against error, from records and case files alone: speed-error.md, speed-error.html and figures.

    python3 bench/report.py --records build/bench/records --out build/bench     folders or files, *.json and *.jsonl
    python3 bench/report.py --records bench/records --needs [--rst]             the table What does a scene need, to the screen
    python3 bench/report.py --records bench/records --headline [--rst]          the table of defaults
    python3 bench/report.py --records bench/records --experiments [--rst]       that of defaults beside experiments

The same records make the same files, byte by byte.
"""

import argparse
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
if str(HERE) not in sys.path:
    sys.path.insert(0, str(HERE))
import blocks  # noqa: E402
import pareto  # noqa: E402
import sections  # noqa: E402
from blocks import Heading, Items, Number, Picture, Table  # noqa: E402
from pareto import all_points, front, load, load_cases, scene_needs  # noqa: E402, F401
from hvi.errors import HVIError  # noqa: E402

TITLE = "Speed against error"
FOLDER = "speed-error"  # of the figures
DPI, DPI_PAGE = 100, 150
HOW = ["Cost: core-seconds of LAMMPS's time loops (wall time by ranks), without the set-up. Only runs on idle cores have one; a run counts as busy "
       "where other jobs used a tenth of a core or more.",
       "Error: as each case says, as a magnitude. Runs that differ in the shift of the lattice alone are one point: mean +- standard deviation "
       "(number of runs).",
       f"Ledger: the largest |E/E0 - 1| of a run, and the relative error of its momentum. A run whose energy is off by more than {pareto.LEDGER:g} "
       "is open: it is in no front and answers no question, like one that failed.",
       "Front: the runs of which no other is as cheap and as accurate (Pareto). The default is on it unless a run is nowhere worse and somewhere "
       "better by more than 5 % and the scatter.",
       "One setting at a time: dominates is cheaper and more accurate by more than 5 % and the scatter, dominated the reverse, trade one for the "
       "other; the rest is as it says."]


def counts(records):
    """{"runs", "idle", "busy", "failed", "cannot"}: numbers of records; idle and busy of those that came to their end"""
    ended = [r for r in records if not r.get("failed") and not r.get("cannot")]
    idle = sum(bool(r.get("idle")) for r in ended)
    return {"runs": len(records), "idle": idle, "busy": len(ended) - idle, "failed": sum(bool(r.get("failed")) for r in records),
            "cannot": sum(bool(r.get("cannot")) and not r.get("failed") for r in records)}


def counted(records):
    """what was run, in a sentence"""
    n = counts(records)
    text = (f"{n['runs']} runs: {n['idle']} timed on idle cores; {n['busy']} on busy cores, of which the errors are used and the times are not; "
            f"{n['failed']} failed; {n['cannot']} that the method cannot do.")
    return text if n["idle"] else text + " No run was timed: figures show particle-steps in place of core-seconds, and there are no fronts."


def distinct(records, make):
    """what records say, each once, sorted; without what is empty"""
    return sorted({text for r in records if (text := pareto.without_folders(make(r)))})


def versions_text(record):
    v = record.get("versions") or {}
    names = {"hvi": "lammps-hvi", "lammps": "LAMMPS", "compiler": "", "python": "Python"}
    return ", ".join(f"{name} {v[key]}".strip() for key, name in names.items() if v.get(key))


def machine_text(record):
    m = record.get("machine") or {}
    parts = (str(m.get("cpu") or ""), f"{m['cores']} cores" if m.get("cores") else "", f"{m['memory_GiB']} GiB" if m.get("memory_GiB") else "")
    return ", ".join(filter(None, parts))


def command_text(record):
    """without the words that say which part it was"""
    return re.sub(r" --(?:cases|methods)[ =](?:'[^']*'|\"[^\"]*\"|\S+)", "", str(record.get("command") or ""))


def period(records):
    dates = distinct(records, lambda r: str(r.get("date") or "")[:10])
    return "no date" if not dates else dates[0] if len(dates) == 1 else f"{dates[0]} to {dates[-1]}"


def origin(records):
    """rows: when, with what, where, how it was run"""
    rows = [["date", period(records)]]
    for name, make in (("versions", versions_text), ("machine", machine_text), ("command", command_text)):
        said = distinct(records, make)
        rows += [[name if k == 0 else "", text] for k, text in enumerate(said[:4])] or [[name, "not in the records"]]
        rows += [["", f"and {len(said) - 4} others: see the records"]] if len(said) > 4 else []
    return Table(["what", ""], rows)


def of_binaries(records):
    """whether all records are of one binary, or at least those of each case"""
    binaries = {(r["case"], (r.get("versions") or {}).get("binary")) for r in records}
    if any(binary is None for _, binary in binaries) or len(binaries) > len({case for case, _ in binaries}):
        return ""
    return ", all of one binary" if len({binary for _, binary in binaries}) == 1 else ", those of a case of one binary"


def cautions(records, cases, points):
    """what a reader must know of these records"""
    timed = [r for r in records if r.get("idle") and not r.get("failed") and not r.get("cannot")]
    said = []
    if len(distinct(timed, machine_text)) > 1:
        said.append("Times are of several machines: compare them within one only.")
    if len(distinct(records, versions_text)) > 1:
        said.append("Records are of several versions" + of_binaries(records) + ".")
    dirty = sum("dirty" in str((r.get("versions") or {}).get("hvi")) for r in records)
    if dirty:
        said.append(f"{dirty} records are of sources with changes that were in no commit yet.")
    absent = [name for name in cases if not any(r["case"] == name for r in records)]
    if absent:
        said.append(f"Cases without a record: {', '.join(absent)}.")
    return said


class Report:
    """Sections of the report, {title: blocks}, and its figures, {name: matplotlib Figure}"""

    def __init__(self, cases, records):
        import figures

        self.cases, self.records = cases, records
        self.points = all_points(cases, records)
        self.figures = {}
        picture = figures.headline(cases, self.points)
        top = [counted(records), *cautions(records, cases, self.points)]
        if picture:
            self.figures["headline.png"] = picture
            top.append(Picture("headline.png", "Cost against error, the Pareto front of each case",
                               "The best that the methods of this package do in each case: core-seconds across, error up. Rings: defaults."))
        missing = [case["title"] for name, case in cases.items() if name in self.points and not front(p for p in self.points[name] if p.ours)]
        top += [f"Without a front, as no run that counts was timed: {', '.join(missing)}."] if missing and picture else []
        top.append(sections.headline(cases, self.points))
        self.sections = {"Result": top}
        needs = sections.needs(cases, self.points)
        if needs.rows:
            self.sections["What does a scene need"] = [needs, sections.NEEDS]
        self.sections["How to read it"] = [Items(HOW)]
        for name, runs in self.points.items():
            self.sections[self.cases[name]["title"]] = list(self.of_case(name, runs, figures))
        costs = list(self.costs())
        if costs:
            self.sections["What a step costs"] = costs
        failed = sections.failures(cases, self.points, records)
        self.sections["What failed"] = [failed] if failed.rows else ["Nothing failed."]
        self.sections["Runs behind it"] = [origin(records)]

    def of_case(self, name, runs, figures):
        case = self.cases[name]
        if case.get("about"):
            yield " ".join(str(case["about"]).split())
        picture = figures.of_case(case, runs)
        if picture:
            self.figures[f"{name}.png"] = picture
            untimed = sum(not (p.failed or p.cannot or p.timed) for p in runs)
            timed = any(p.timed for p in runs if not (p.failed or p.cannot))
            zero = any(p.error == 0 for p in runs if not (p.failed or p.cannot))
            across = "core-seconds" if timed else "particle-steps, as no run was timed,"
            caption = f"Case {name}: {across} across, {case['error']['main']} up."
            caption += f" Not drawn, as not timed: {untimed}." if untimed and timed else ""
            caption += " Errors of zero are drawn at the lower edge." if zero else ""
            yield Picture(f"{name}.png", f"{case['title']}: cost against error", caption)
        default = next((p for p in runs if p.default), None)
        if default and default.error is not None:
            cost = f"{sections.number(default.cost)} core-seconds" if default.timed else "not timed"
            yield f"Default: {default.name}: {sections.with_unit(default)}, {cost}. On the front: {sections.standing_text(case, runs)}."
        else:
            yield f"Default: {sections.standing_text(case, runs)}."
        yield sections.runs(case, runs)
        theirs, changed = sections.others(case), sections.variations(case, runs)
        if theirs.rows:
            yield theirs
        if changed.rows:
            yield Heading(3, "One setting at a time, around the default")
            yield changed

    def costs(self):
        for name, case in self.cases.items():
            records = [r for r in self.records if r["case"] == name]
            if case["group"] == "steps" and records:
                yield Heading(3, case["title"])
                if case.get("about"):
                    yield " ".join(str(case["about"]).split())
                yield sections.steps(case, records)

    def markdown(self):
        parts = [Heading(1, TITLE)]
        for title, section in self.sections.items():
            parts.append(Heading(2, title))
            parts += [Picture(f"{FOLDER}/{part.name}", part.alt, part.caption) if isinstance(part, Picture) else part for part in section]
        return blocks.markdown([*parts, "Made by bench/report.py from the records; not to be edited."])

    def html(self):
        import figures
        import webpage

        n = counts(self.records)
        tiles = [(n["runs"], "runs"), (n["idle"], "timed on idle cores"), (n["busy"], "on busy cores: times not used"), (n["failed"], "failed"),
                 (n["cannot"], "cannot be done by the method"), (len(self.points), "cases")]
        subtitle = "; ".join([*distinct(self.records, versions_text)[:1], *distinct(self.records, machine_text)[:1], period(self.records)])
        pictures = {name: figures.png(figure, DPI_PAGE) for name, figure in self.figures.items()}
        return webpage.of_document(TITLE, subtitle, [(Number(k), text) for k, text in tiles], self.sections, pictures,
                                   "Made by bench/report.py from the records. No part of this page is loaded from elsewhere.")

    def write(self, folder):
        """All files; returns their paths"""
        import figures

        folder = pathlib.Path(folder)
        made = {folder / "speed-error.md": self.markdown().encode("ascii"), folder / "speed-error.html": self.html().encode()}
        made.update({folder / FOLDER / name: figures.png(figure, DPI) for name, figure in self.figures.items()})
        try:
            (folder / FOLDER).mkdir(parents=True, exist_ok=True)
            for path, data in made.items():
                path.write_bytes(data)
        except OSError as problem:
            raise HVIError(f"cannot write {problem.filename}: {problem.strerror}") from None
        return list(made)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--records", nargs="+", required=True, help="folders or files, *.json and *.jsonl")
    parser.add_argument("--cases", default=HERE / "cases", type=pathlib.Path, help="folder of case files")
    parser.add_argument("--out", type=pathlib.Path, help="folder for the report")
    parser.add_argument("--needs", action="store_true", help="print the table What does a scene need, five typical questions")
    parser.add_argument("--headline", action="store_true", help="print the table of defaults")
    parser.add_argument("--experiments", action="store_true", help="print the table of defaults beside experiments")
    parser.add_argument("--rst", action="store_true", help="print as reStructuredText")
    args = parser.parse_args(words)
    if not (args.out or args.needs or args.headline or args.experiments):
        parser.error("say where to write (--out) or what to print (--needs, --headline, --experiments)")
    try:
        cases, records = load_cases(args.cases), load(args.records)
        points = all_points(cases, records)
        asked = [sections.experiments(cases, points)] * args.experiments + [sections.headline(cases, points)] * args.headline + [sections.needs(cases, points, pareto.TYPICAL), sections.NEEDS] * args.needs
        if asked:
            print((blocks.rst if args.rst else blocks.markdown)(asked), end="")
        if args.out:
            made = Report(cases, records).write(args.out)
            print(f"report: {made[0]}, {made[1]}, {len(made) - 2} figures; {counted(records)}")
    except HVIError as problem:
        print(f"report: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
