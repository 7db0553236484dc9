#!/usr/bin/env python3
# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Speed against error: runs the cases of bench/cases, one record per run, and writes the report.

    bench/run.py --build build --out build/bench               the short form (make bench); --size full: make bench-full
    bench/run.py ... --cases sod,ceg3 --methods riemann        a part
    bench/run.py ... --dry                                     what would run
    bench/run.py --publish --out build/bench                   its records into bench/records, the report of them into doc

A run that is there (same settings, same binary) is not run again, so that a harness that was stopped goes on; what ran while the
cores had other things to do is, when they have none (--busy keeps it). Times of busy runs are in no figure.
"""

import argparse
import datetime
import functools
import hashlib
import importlib
import itertools
import json
import multiprocessing
import os
import pathlib
import platform
import re
import resource
import shutil
import subprocess
import sys
import threading
import time
import traceback

import yaml

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
BUSY = 0.1  # cores that others used in the mean while LAMMPS was at work: times do not count beyond
DAEMON = 0.06  # s of a core that a run itself may leave to others
TOLD = ("title", "question", "about", "short", "full", "points", "default", "error", "name")  # what a run does not depend on


class Wrong(Exception):
    """what is wrong with what was asked"""


def load_case(path):
    try:
        case = yaml.safe_load(path.read_text())
    except yaml.YAMLError as problem:
        raise Wrong(f"{path}: not YAML: {' '.join(str(problem).split())}") from None
    if not isinstance(case, dict):
        raise Wrong(f"{path}: not a mapping")
    wanted = {"title", "group", "about", "runner", "methods", "default", "short"}
    wanted |= {"error", "resolution"} if case.get("group") != "steps" else set()
    lacking = wanted - set(case)
    if lacking:
        raise Wrong(f"{path}: lacks {', '.join(sorted(lacking))}")
    case["name"] = path.stem
    return case


def settings_of(case, size):
    """the runs of a case as a list of settings, each once: the products of the lists in its entries"""
    out, seen = [], set()
    for entry in [*case["short"], *(case.get("full") or [] if size == "full" else [])]:
        names = list(entry)
        for values in itertools.product(*(v if isinstance(v, list) else [v] for v in entry.values())):
            s = dict(zip(names, values))
            if s.get("method") not in case["methods"]:
                raise Wrong(f"{case['name']}: method {s.get('method')} is none of {', '.join(case['methods'])}")
            key = json.dumps(s, sort_keys=True)
            if key not in seen:
                seen.add(key)
                out.append(s)
    return out


def key_of(name, settings):
    return hashlib.sha1(json.dumps([name, settings], sort_keys=True).encode()).hexdigest()[:12]


def made_of():
    """inputs, scenes of tests, materials and Python that runs are made of"""
    for pattern in ("bench/runners/*.py", "bench/stock/*", "bench/dem/*", "bench/sph/*", "tests/lib/*.py", "tests/reference/*.py", "python/hvi/**/*.py",
                    "examples/*/in.*", "examples/*/legs.*", "examples/whipple-shield/*/*.yaml", "examples/*/shots.csv", "examples/whipple-shield/shots/*.csv", "potentials/*.hvi"):
        for path in sorted(ROOT.glob(pattern)):
            if path.is_file() and not path.name.startswith("hard"):
                yield path


@functools.cache
def files():
    """their hash"""
    made = hashlib.sha256()
    for path in made_of():
        made.update(path.read_bytes())
    return made.hexdigest()


def source_of(case):
    """hash of what a run is made of besides settings and binary: what the case says, and files()"""
    said = json.dumps({k: v for k, v in case.items() if k not in TOLD}, sort_keys=True, default=str)
    return hashlib.sha256((said + files()).encode()).hexdigest()[:12]


class Others:
    """What the cores do for others from the start of this to now, in cores, by /proc/stat less what this process and its children
    have used in the same time; None where /proc/stat is not, or the time is too short to tell."""

    def __init__(self):
        self.began, self.own = self.now(), self.ours()

    @staticmethod
    def ours():
        return sum(r.ru_utime + r.ru_stime for r in (resource.getrusage(k) for k in (resource.RUSAGE_CHILDREN, resource.RUSAGE_SELF)))

    @staticmethod
    def now():
        try:
            fields = [int(a) for a in pathlib.Path("/proc/stat").read_text().splitlines()[0].split()[1:9]]
        except (OSError, ValueError):
            return None
        return time.monotonic(), (sum(fields) - fields[3] - fields[4]) / os.sysconf("SC_CLK_TCK")  # without idle and waiting for disks

    def used(self):
        there = self.now()
        if there is None or self.began is None:
            return None
        return (there[1] - self.began[1] - (self.ours() - self.own)) / max(there[0] - self.began[0], 1e-9)


def is_idle(load, wall, starts=1):
    """whether times count: a program of MPI that is started alone starts a daemon, which is no child of ours: 0.04 s; runs of several parts start several"""
    return load is not None and load < BUSY + DAEMON * starts / max(wall, 0.01)


class Memory(threading.Thread):
    """largest resident size of a process of LAMMPS below this one, in MB, looked at 25 times a second; 0 where /proc is not"""

    def __init__(self, program):
        super().__init__(daemon=True)
        self.program, self.most, self.done = str(program), 0.0, threading.Event()

    def run(self):
        while not self.done.wait(0.04):
            self.most = max([self.most, *self.below(os.getpid())])

    def below(self, pid):
        try:
            for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
                for child in (task / "children").read_text().split():
                    if os.readlink(f"/proc/{child}/exe") == self.program:
                        found = re.search(r"^VmHWM:\s+(\d+)", pathlib.Path(f"/proc/{child}/status").read_text(), re.M)
                        yield int(found.group(1)) / 1024 if found else 0.0
                    yield from self.below(child)
        except OSError:  # it ended meanwhile
            return


def measured(pipe, case, settings, folder, lmp, ranks, timeout):
    """in a process of its own, whose children are LAMMPS alone: what the runner returns with times, load and memory"""
    sys.path.insert(0, str(HERE))
    runner = importlib.import_module(f"runners.{case['runner']}")
    Cannot = importlib.import_module("runners").Cannot
    record = {"failed": "", "cannot": ""}
    memory = Memory(lmp)
    memory.start()
    others, start = Others(), time.time()
    try:
        record.update(runner.run(case, settings, folder, lmp, ranks=ranks, timeout=timeout))
    except Cannot as why:
        record["cannot"] = str(why)
    except Exception as problem:  # the others go on; main() ends with an error
        traceback.print_exc()
        record.update(failed=f"bench: {type(problem).__name__}: {problem}", errors={}, numbers={}, ledger={})
    record["wall_s"] = round(time.time() - start, 3)
    memory.done.set()
    memory.join()
    load = others.used()
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    record.update(core_s=round(spent.ru_utime + spent.ru_stime, 3), memory_MB=round(memory.most, 1), load=None if load is None else round(load, 3),
                  idle=is_idle(load, record["wall_s"], record.pop("starts", 1)))
    pipe.send(record)


def run_one(case, settings, folder, lmp):
    """a record"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    ranks = int(settings.get("ranks", 1))
    here, there = multiprocessing.Pipe(duplex=False)
    job = multiprocessing.get_context("fork").Process(target=measured, args=(there, case, settings, folder, lmp, ranks, case.get("timeout", 1800)))
    job.start()
    there.close()
    try:
        record = here.recv()
    except EOFError:
        raise Wrong(f"{case['name']} {settings}: the runner stopped (above); what it left is in {folder}") from None
    job.join()
    record.update(case=case["name"], group=case["group"], method=settings["method"], settings=settings, ranks=ranks,
                  key=key_of(case["name"], settings), particle_steps=record.get("particles", 0) * record.get("steps", 0))
    return record


def machine():
    text = {f: pathlib.Path(f).read_text() if pathlib.Path(f).exists() else "" for f in ("/proc/cpuinfo", "/proc/meminfo")}
    cpu = re.search(r"model name\s*: (.*)", text["/proc/cpuinfo"])
    memory = re.search(r"MemTotal:\s+(\d+)", text["/proc/meminfo"])
    gib = round(int(memory.group(1)) / 2**20) if memory else None
    return {"cpu": cpu.group(1) if cpu else platform.machine(), "cores": os.cpu_count(), "memory_GiB": gib}


def versions(lmp):
    said = subprocess.run([str(ROOT / "cmake" / "env.sh"), str(lmp), "-h"], capture_output=True, text=True).stdout
    git = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True).stdout.strip()
    find = lambda pattern: (re.search(pattern, said) or ["", ""])[1].strip()  # noqa: E731
    return {"hvi": git or "unknown", "lammps": find(r"Parallel Simulator - (.*)"), "compiler": re.sub(r" with .*", "", find(r"Compiler: (.*)")),
            "python": platform.python_version(), "binary": hashlib.sha256(lmp.read_bytes()).hexdigest()[:12]}


def kept(file, now, source, busy):
    """whether the record in a file stands: of this binary and these sources, no failure of the harness itself, and timed if that can be had"""
    if not file.exists():
        return False
    r = json.loads(file.read_text())
    same = r["versions"]["binary"] == now["binary"] and r["source"] == source and not r["failed"].startswith("bench: ")
    return same and (r["idle"] or busy or bool(r["cannot"]) or r["load"] is None)


def show(record):
    said = record["failed"] or record["cannot"] or " ".join(f"{k} {v:.4g}" for k, v in [*record["errors"].items(), *record.get("numbers", {}).items()])
    cost = "" if record["cannot"] else f"; {record.get('loop_s', 0) * record['ranks']:.1f} core-s"
    cost += "" if record["idle"] or record["cannot"] else f", busy: others used {record['load']} cores"
    return f"{record['case']} {' '.join(f'{k}={v}' for k, v in record['settings'].items())}: {said}{cost}"


def publish(out):
    """records of a folder, one file per case, into bench/records: of runs that the case files have; those of a case of one binary and one source"""
    target, found = HERE / "records", {}
    for case in (load_case(f) for f in sorted((HERE / "cases").glob("*.yaml"))):
        keys = {key_of(case["name"], s) for s in settings_of(case, "full")}
        records = [json.loads(f.read_text()) for f in sorted((out / "records" / case["name"]).glob("*.json")) if f.stem in keys]
        found[case["name"]] = sorted(records, key=lambda r: json.dumps(r["settings"], sort_keys=True))
    every = [r for records in found.values() for r in records]
    broken = [r for r in every if r["failed"].startswith("bench: ")]
    if not every or broken:
        raise Wrong(f"{show(broken[0])}: mend the harness, then run it again" if broken else f"{out}: no records")
    mixed = [name for name, records in found.items() if len({(r["versions"]["binary"], r["source"]) for r in records}) > 1]
    if mixed:
        raise Wrong(f"{out}: records of more than one binary, or of more than one state of the sources, in {', '.join(mixed)}: run them again")
    target.mkdir(exist_ok=True)
    for name, records in found.items():
        if records:
            (target / f"{name}.jsonl").write_text("".join(json.dumps(r, sort_keys=True) + "\n" for r in records))


def chosen(args):
    """the cases asked for"""
    names = args.cases.split(",") if args.cases else sorted(f.stem for f in (HERE / "cases").glob("*.yaml"))
    for name in names:
        if not (HERE / "cases" / f"{name}.yaml").exists():
            raise Wrong(f"no case {name}; there are {', '.join(sorted(f.stem for f in (HERE / 'cases').glob('*.yaml')))}")
    return [load_case(HERE / "cases" / f"{name}.yaml") for name in names]


def work(args):
    """runs what is not there; how many runs the harness itself could not do"""
    now, box, broken = versions(args.lmp), machine(), 0
    todo = [(case, s) for case in chosen(args) for s in settings_of(case, args.size)
            if not args.methods or s["method"] in args.methods.split(",")]
    for number, (case, settings) in enumerate(todo, 1):
        file = args.out / "records" / case["name"] / f"{key_of(case['name'], settings)}.json"
        source = source_of(case)
        if not args.again and kept(file, now, source, args.busy):
            continue
        if args.dry:
            print(case["name"], settings)
            continue
        if args.until and time.time() > args.until:
            print(f"time is up: {len(todo) - number + 1} runs are left at most; the same command goes on")
            break
        folder = args.out / "runs" / case["name"] / file.stem
        record = run_one(case, settings, folder, args.lmp)
        record.update(date=datetime.datetime.now().isoformat(timespec="seconds"), versions=now, source=source, machine=box,
                      command=f"bench/run.py --size {args.size} --cases {case['name']} --methods {settings['method']!r}")
        if not args.keep:
            shutil.rmtree(folder, ignore_errors=True)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(record, sort_keys=True, indent=1) + "\n")
        print(f"[{number}/{len(todo)}] {show(record)}", flush=True)
        broken += record["failed"].startswith("bench: ")
    return broken


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build", type=pathlib.Path, help="folder with lmp")
    parser.add_argument("--lmp", type=pathlib.Path, help="another LAMMPS than the one in --build")
    parser.add_argument("--out", default=ROOT / "build" / "bench", type=pathlib.Path, help="folder for records and the report")
    parser.add_argument("--size", choices=("short", "full"), default="short")
    parser.add_argument("--cases", default="", help="names of bench/cases, by commas")
    parser.add_argument("--methods", default="", help="names, by commas")
    parser.add_argument("--again", action="store_true", help="run also what is there")
    parser.add_argument("--busy", action="store_true", help="keep runs whose times do not count")
    parser.add_argument("--keep", action="store_true", help="keep the folders of the runs")
    parser.add_argument("--minutes", type=float, help="begin no run after so many")
    parser.add_argument("--dry", action="store_true", help="say what would run")
    parser.add_argument("--publish", action="store_true", help="records of --out into bench/records, the report into doc")
    args = parser.parse_args()
    args.until = args.minutes and time.time() + 60 * args.minutes
    broken = 0
    args.out, args.lmp = args.out.resolve(), (args.lmp or args.build / "lmp").resolve()
    try:
        if args.publish:
            publish(args.out)
            records, target = HERE / "records", ROOT / "doc"
        else:
            if not args.lmp.exists():
                raise Wrong(f"{args.lmp} is not there: run make first")
            broken = work(args)
            records, target = args.out / "records", args.out
    except Wrong as problem:
        sys.exit(f"bench: {problem}")
    if not args.dry:
        import report

        code = report.main(["--records", str(records), "--out", str(target)])
        sys.exit(f"bench: {broken} runs stopped in the harness itself: see above" if broken else code)


if __name__ == "__main__":
    main()
