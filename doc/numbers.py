#!/usr/bin/env python3
# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Tables of measured numbers: writes those of doc/records into the pages that have markers for them.

    doc/numbers.py                    fills all blocks of *.md and *.rst
    doc/numbers.py --check            changes nothing; names each block, marker or record that is wrong, and exits 1
    doc/numbers.py --stale            records that are older than the files they depend on
    doc/numbers.py --run NAME...      runs the commands of records again, each once, and rewrites their rows
    doc/numbers.py --run NAME ROW     that of row 1, 2, ... only

A record is doc/records/NAME.jsonl: a head, then one line per row of the table.

    {"title": "...", "depends": ["src/USER-HVI", "examples/*/in.*"], "columns": ["dx mm", "hole mm"]}
    {"command": "cd examples/single-plate && ../../build/lmp -in in.plate", "commit": "abc1234", "machine": "2 cores of ...", "load": "idle",
     "row": {"dx mm": 1.0, "hole mm": 18.90}, "keys": {"hole mm": "result.yaml:hole_diameter_mm"}}

Optional keys of a row, for --run: "folder", where the command is typed, from the root of the repository, if it does not begin with "cd FOLDER &&"; "keys", where
numbers are found, optionally with " * FACTOR" behind:

    FILE:KEY                KEY as in a.b.0 (YAML, JSON; of a CSV file ROW.COLUMN, ROW from 0); [NAME=TEXT, ...] in place of a number is the only row that has these
    said:PATTERN            the group of a regular expression in what the command has printed; . matches ends of lines, too
    run:core_s, run:wall_s  core-seconds and seconds of the command

A value of the table has the digits that it has in the record. ["{:.2f} / {:.0f}", KEY, KEY] writes several into one cell (str.format).

"commit" is the state of the code that was run: a commit, "abc1234-dirty" with changes that were not committed, or "up to abc1234" where it was not noted: the commit
that brought the numbers into the repository, so that the run is of it or of an earlier one. The command is the one that runs the row today. It is empty for values that others have measured. In a page:

    <!-- numbers NAME -->             .. numbers NAME
    <!-- /numbers -->                 .. /numbers
"""

import argparse
import csv
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
KNOWN = {"command", "commit", "machine", "load", "row", "folder", "keys"}
MARKS = {".md": (r"<!-- numbers (\S+) -->", "<!-- /numbers -->"), ".rst": (r"\.\. numbers (\S+)", ".. /numbers")}


class Wrong(Exception):
    """what is wrong with a record or a page"""


class Digits(str):
    """a number as it is written in a record"""


def load(text, where):
    try:
        return json.loads(text, parse_float=Digits, parse_int=Digits)
    except ValueError as problem:
        raise Wrong(f"{where}: {problem}") from None


def written(value):
    """JSON, numbers with their own digits"""
    if isinstance(value, Digits):
        return str(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)}: {written(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(map(written, value)) + "]" if isinstance(value, list) else json.dumps(value)


class Record:
    def __init__(self, path):
        self.path, self.name, self.where = path, path.stem, path.name
        if not path.read_bytes().isascii():
            raise Wrong(f"{self.where}: not ASCII")
        lines = [load(line, f"{self.where} line {k}") for k, line in enumerate(path.read_text().splitlines(), 1) if line.strip()]
        if not lines or not isinstance(lines[0], dict) or set(lines[0]) != {"title", "depends", "columns"}:
            raise Wrong(f"{self.where}: line 1 must have title, depends and columns")
        self.head, self.rows = lines[0], lines[1:]
        self.columns = self.head["columns"]
        for k, row in enumerate(self.rows, 2):
            if not isinstance(row, dict) or not {"command", "commit", "machine", "load", "row"} <= set(row) <= KNOWN:
                raise Wrong(f"{self.where} line {k}: keys must be command, commit, machine, load, row and optionally folder, keys")
            if not isinstance(row["commit"], str) or not re.fullmatch(r"((up to )?[0-9a-f]{7,40}(-dirty)?)?", row["commit"]):
                raise Wrong(f"{self.where} line {k}: commit must be as abc1234, abc1234-dirty, up to abc1234 or empty, not {row['commit']!r}")
            if row["load"] not in ("idle", "busy", ""):
                raise Wrong(f"{self.where} line {k}: load must be idle, busy or empty, not {row['load']!r}")
            if unknown := set(row["row"]) - set(self.columns) or set(row.get("keys", ())) - set(row["row"]):
                raise Wrong(f"{self.where} line {k}: no column {sorted(unknown)[0]!r}")
        if not self.rows:
            raise Wrong(f"{self.where}: no rows")

    def save(self):
        self.path.write_text("".join(written(line) + "\n" for line in (self.head, *self.rows)))

    def several(self, key):
        """whether rows that were run differ in it"""
        return len({row[key] for row in self.ran()}) > 1

    def ran(self):
        """rows that were run here, not those that others have measured"""
        return [row for row in self.rows if row["command"] or row["commit"]]

    def table(self):
        """heads and cells; what differs between rows of commit, machine and load has a column"""
        more = [key for key in ("commit", "machine", "load") if self.several(key)]
        cells = [[*(row["row"].get(name) for name in self.columns), *(row[key] or None for key in more)] for row in self.rows]
        return [*self.columns, *more], cells

    def origin(self):
        """the line below the table"""
        first = next(iter(self.ran()), self.rows[0])
        same = [f"commit {first['commit']}" if first["commit"] and not self.several("commit") else "",
                *(first[key] for key in ("machine", "load") if not self.several(key))]
        text = ", ".join(filter(None, same))
        commands = list(dict.fromkeys(row["command"] for row in self.rows if row["command"]))
        said = ", ".join(f"`{one}`" for one in commands) if len(commands) <= 2 else f"commands in `doc/records/{self.name}.jsonl`"
        text = ": ".join(filter(None, (text, said)))
        return text[:1].upper() + text[1:] if text[:1] != "`" else text


def plain(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "-" if value is None else re.sub(r"(?<![^\s,])-(0(\.0*)?(e[-+]?\d+)?)(?![^\s,])", r"\1", str(value))


def markdown(record):
    heads, cells = record.table()
    lines = [heads, ["---"] * len(heads), *cells]
    origin = record.origin()
    return ["", *("| " + " | ".join(plain(cell).replace("|", "\\|") for cell in line) + " |" for line in lines), "", *([origin, ""] if origin else [])]


def rst_text(text):
    """of a cell or a line: `x` is a literal, no other character is markup"""
    parts = re.split(r"`([^`]*)`", text)
    for k in range(0, len(parts), 2):
        parts[k] = re.sub(r"([\\*|`])|(_)(?!\w)", lambda m: "\\" + m.group(0), parts[k])
    text = "".join(part if k % 2 == 0 else f"``{part}``" for k, part in enumerate(parts))
    text = re.sub(r"(``)(?=\w)", r"\1", text)
    return "\\" + text if re.match(r"([-+*:]|\(?\w+[.)]|\.\.)(\s|$)|:\S", text) else text


def rst(record):
    heads, cells = record.table()
    lines = ["", ".. list-table::", "   :header-rows: 1", ""]
    for line in (heads, *cells):
        for k, cell in enumerate(line):
            lines.append(("   * - " if k == 0 else "     - ") + rst_text(plain(cell)))
    lines = [line.rstrip() for line in lines]
    origin = record.origin()
    return [*lines, "", *([rst_text(origin), ""] if origin else [])]


def records(root):
    """{name: Record}, and what is wrong"""
    found, wrong = {}, []
    for path in sorted((root / "doc" / "records").glob("*.jsonl")):
        try:
            found[path.stem] = Record(path)
        except Wrong as problem:
            wrong.append(f"doc/records/{problem}")
            found[path.stem] = None
    return found, wrong


def pages(root):
    for folder, names, files in os.walk(root):
        names[:] = sorted(n for n in names if not n.startswith((".", "build", "runs")))
        for name in sorted(files):
            if pathlib.Path(name).suffix in MARKS:
                yield pathlib.Path(folder) / name


def fill(path, text, found, used, wrong, root):
    """the page with its blocks as the records give them; used: {name: page}"""
    begin, end = MARKS[path.suffix]
    where, out, lines, k = path.relative_to(root), [], text.split("\n"), 0
    while k < len(lines):
        out.append(lines[k])
        mark, k = re.fullmatch(begin, lines[k]), k + 1
        if not mark:
            if lines[k - 1] == end:
                wrong.append(f"{where} line {k}: an end without a beginning")
            continue
        name, first = mark.group(1), k
        while k < len(lines) and lines[k] != end and not re.fullmatch(begin, lines[k]):
            k += 1
        if k == len(lines) or lines[k] != end:
            wrong.append(f"{where}: block {name} has no end")
            out += lines[first:k]
            continue
        if name in used:
            wrong.append(f"{where}: block {name} is used twice, first in {used[name]}")
        if name not in found:
            wrong.append(f"{where}: block {name} has no record doc/records/{name}.jsonl")
        used.setdefault(name, where)
        record = found.get(name)
        out += lines[first:k] if record is None else markdown(record) if path.suffix == ".md" else rst(record)
        out.append(end)
        k += 1
    return "\n".join(out)


def process(root, check):
    """fills the pages, or says which are not filled; what is wrong, as a list"""
    found, wrong = records(root)
    used = {}
    for path in pages(root):
        text = path.read_bytes().decode()
        new = fill(path, text, found, used, wrong, root)
        if new == text:
            continue
        if not check:
            path.write_text(new)
            print(f"{path.relative_to(root)}: written")
            continue
        begin = MARKS[path.suffix][0]
        was, now = (split(begin, one) for one in (text, new))
        wrong += [f"{path.relative_to(root)}: block {name} is not that of its record" for name in now if was.get(name) != now[name]]
    return wrong + [f"doc/records/{name}.jsonl: no page has a block of it" for name in found if name not in used]


def split(begin, text):
    """{name: lines after its marker}"""
    parts = re.split(f"^{begin}$", text, flags=re.M)
    return dict(zip(parts[1::2], parts[2::2]))


def git(root, *words):
    done = subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


def stale(root):
    """one line per record that is not of the present state of what it depends on"""
    lines = []
    for name, record in records(root)[0].items():
        paths = [f":(glob){path}" for path in record.head["depends"]] if record else []
        said = {}
        for commit in dict.fromkeys(row["commit"] for row in record.ran()) if paths else ():
            sure = re.sub(r"^up to |-dirty$", "", commit)
            later = git(root, "rev-list", "--count", f"{sure}..HEAD", "--", *paths) if sure else None
            said[commit] = ("no commit is said" if not commit else f"commit {sure} is unknown here" if later is None else
                            f"{later} commit{'s' if later != '1' else ''} of what it depends on since {commit.removeprefix('up to ')}" if int(later) or commit.endswith("-dirty") else "")
        if text := "; ".join(filter(None, said.values())):
            lines.append(f"{name}: {text}")
    return lines


def shadow(root, folder, target, build):
    """a copy of a folder of the repository, with links to all that is beside it and above, so that relative paths lead where they should"""
    here, there = root, target
    for name in [*pathlib.PurePath(folder).parts, None]:
        for one in here.iterdir():
            if one.name != name and not one.name.startswith(".git") and not (here == root and one.name == "build"):
                if name is None and here != root:  # the folder itself; what it has run stays behind
                    if one.name == "runs":
                        continue
                    subprocess.run(["cp", "-r", str(one), str(there / one.name)], check=True)
                else:
                    (there / one.name).symlink_to(one)
        if name is not None:
            here, there = here / name, there / name
            there.mkdir()
    if not (target / "build").exists():
        (target / "build").symlink_to(build)
    return there


def within(value, part):
    """what a part of a key names"""
    if not part.startswith("["):
        return value[int(part) if isinstance(value, list) else part]
    wanted = dict(one.strip().split("=", 1) for one in part[1:-1].split(","))
    found = [row for row in value if all(str(row[name]) == text for name, text in wanted.items())]
    if len(found) != 1:
        raise ValueError(f"{len(found)} rows {part}")
    return found[0]


def number_at(folder, where, ran):
    """a value by its key; ran: core_s and wall_s of the command, said by it"""
    if isinstance(where, list):
        return where[0].format(*(number_at(folder, one, ran) for one in where[1:]))
    place, factor = found.groups() if (found := re.fullmatch(r"(.*) \* ([-+.\deE]+)", where, re.S)) else (where, 1)
    file, _, key = place.partition(":")
    if file == "run":
        value = ran[key]
    elif file == "said":
        value = re.search(key, ran["said"], re.S | re.M)[1]
    else:
        import yaml

        path = folder / file
        with open(path, newline="") as opened:
            value = list(csv.DictReader(opened)) if path.suffix == ".csv" else yaml.safe_load(opened)
        for part in re.findall(r"\[[^]]*\]|[^.]+", key):
            value = within(value, part)
    try:
        return float(value) * float(factor) + 0.0
    except ValueError:
        return value


def like(old, new):
    """a number in the digits of the old one"""
    if not isinstance(new, float) or not math.isfinite(new):
        return str(new)
    digits = re.sub(r"[eE].*", "", old).lstrip("-").replace(".", "").lstrip("0") if isinstance(old, Digits) else ""
    n = max(len(digits), 1) if isinstance(old, Digits) else 6
    if isinstance(old, Digits) and "." not in old and "e" not in old.lower():
        return Digits(f"{new:.0f}")
    if not isinstance(old, Digits):
        return Digits(f"{new:.{n}g}")
    if "e" in old.lower():
        return Digits(f"{new:.{n - 1}e}")
    text = f"{new:#.{n}g}" if abs(new) < 10**n else f"{new:.0f}"
    return Digits(text.rstrip("."))


def place_of(row):
    """folder and command of a row"""
    command, folder = row["command"], row.get("folder")
    if folder is None and (found := re.match(r"cd (\S+) && (.*)", command, re.S)):
        folder, command = found.groups()
    if folder is None or not command:
        raise Wrong("the row says no folder: its command must begin with cd FOLDER &&, or it has a key folder")
    if pathlib.PurePath(folder).is_absolute() or ".." in pathlib.PurePath(folder).parts:
        raise Wrong(f"folder {folder}: must be in the repository")
    return folder, command


def environment(root, folder, build, scratch):
    """of a command; its python3 is one that has the modules of the examples and of the tests, which run the programs of the build"""
    found = subprocess.run([str(ROOT / "cmake" / "find-python.sh"), "numpy", "scipy", "matplotlib", "yaml", "pytest"], capture_output=True, text=True).stdout.strip()
    (scratch / "bin").mkdir()
    (scratch / "bin" / "python3").symlink_to(found or sys.executable)
    programs = {"HVI_LMP": build / "lmp", "HVI_LMP_STOCK": build / "lmp-stock", "HVI_PLUGIN": build / "hviplugin.so", "HVI_ROOT": root}
    return {**os.environ, **{name: str(path) for name, path in programs.items()}, "PATH": f"{scratch / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(root / "python"), "LAMMPS_POTENTIALS": f"{root / 'potentials'}:{folder}"}


def run(root, names, number, build):
    """runs commands of records again, each once, whatever number of records it makes, and rewrites the rows"""
    sys.path.insert(0, str(ROOT / "bench"))
    import run as bench

    found, wrong = records(root)
    tasks = {}
    for name in dict.fromkeys(names):
        record = found.get(name)
        if record is None:
            raise Wrong(next((one for one in wrong if f"/{name}.jsonl" in one), f"no record doc/records/{name}.jsonl"))
        if number is not None and not 1 <= number <= len(record.rows):
            raise Wrong(f"{name}: no row {number}; there are {len(record.rows)}")
        chosen = {k: row for k, row in enumerate(record.rows, 1) if number in (None, k)}
        some = any(row.get("keys") for row in chosen.values())
        for k, row in chosen.items():
            if some and not row.get("keys"):
                print(f"{name}: row {k} stays, as it does not say where its numbers are found")
                continue
            if not row.get("keys"):
                raise Wrong(f"{name}: row {k} does not say where its numbers are found (keys)")
            tasks.setdefault(place_of(row), {}).setdefault(name, []).append(row)
    for (folder, command), all_rows in tasks.items():
        print(f"{folder}: {command}", flush=True)
        with tempfile.TemporaryDirectory() as scratch, tempfile.TemporaryDirectory() as programs:
            there = shadow(root, folder, pathlib.Path(scratch), build)
            env = environment(root, there, build, pathlib.Path(programs))
            others, start, spent = bench.Others(), time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([str(ROOT / "cmake" / "env.sh"), "bash", "-c", command], cwd=there, env=env, capture_output=True, text=True)
            wall, load, after = time.monotonic() - start, others.used(), resource.getrusage(resource.RUSAGE_CHILDREN)
            if done.returncode:
                raise Wrong(f"{', '.join(all_rows)}: {command} ended with {done.returncode}:\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
            ran = {"wall_s": wall, "said": done.stdout}
            ran["core_s"] = after.ru_utime + after.ru_stime - spent.ru_utime - spent.ru_stime
            box = bench.machine()
            for name, rows in all_rows.items():
                dirty = git(root, "status", "--porcelain", "--", *(f":(glob){path}" for path in found[name].head["depends"]))
                for row in rows:
                    for column, where in row["keys"].items():
                        try:
                            row["row"][column] = like(row["row"][column], number_at(there, where, ran))
                        except (OSError, KeyError, IndexError, TypeError, ValueError, re.error) as problem:
                            raise Wrong(f"{name}: {column}: nothing at {where} ({type(problem).__name__}: {problem})") from None
                    row.update(commit=(git(root, "rev-parse", "--short=7", "HEAD") or "") + ("-dirty" if dirty else ""),
                               machine=f"{box['cores']} cores of a{'n' if box['cpu'][0] in 'AEIOaeio' else ''} {box['cpu']}", load="idle" if bench.is_idle(load, wall) else "busy")
        for name in all_rows:
            found[name].save()


def main(words=None, root=ROOT):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true", help="change nothing, exit 1 if a block is not that of its record")
    what.add_argument("--stale", action="store_true", help="list records that are older than what they depend on")
    what.add_argument("--run", nargs="+", metavar="NAME", help="run the commands of records again, or of one row, and fill the pages")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="folder with lmp, for --run")
    args = parser.parse_args(words)
    try:
        if args.stale:
            lines = stale(root)
            print("\n".join(lines) or "no record is older than what it depends on")
            return 0
        if args.run:
            one_row = len(args.run) == 2 and args.run[1].isdigit()
            run(root, args.run[:1] if one_row else args.run, int(args.run[1]) if one_row else None, args.build.resolve())
        wrong = process(root, args.check)
    except Wrong as problem:
        wrong = [str(problem)]
    for one in wrong:
        print(f"numbers: {one}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
