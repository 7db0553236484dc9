"""Fuzzes the readers of C++ and of Python, and LAMMPS with random inputs: make fuzz MINUTES=10.

    python3 tests/fuzz/fuzz.py --minutes 10 --jobs 2 --out build-sanitize/fuzz --lmp build-sanitize/lmp [--seed N] [--only material,python-case,lammps]

Each of the fuzzers runs for these minutes, as many at once as there are jobs. What they find is in the folder --out, by fuzzer, and the status is 1. The C++ ones
are built with clang and libFuzzer, and go on from the corpus that they left there.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import inputs
import readers
import seeds
from seeds import ROOT

CPP = ("material", "table")
PYTHON = tuple("python-" + kind for kind in readers.KINDS)
ALL = ("lammps", *CPP, *PYTHON)
FLAGS = "-std=c++17 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -Wno-unused-command-line-argument".split()


def build(kind, out):
    """a libFuzzer of a check of fuzz_readers.h; its path"""
    compiler = shutil.which("clang++")
    if not compiler:
        sys.exit("lammps-hvi: clang++ is missing (Debian: apt-get install clang)")
    lib, program = ROOT / "lib" / "hvi", out / f"fuzz_{kind}"
    command = [compiler, *FLAGS, f"-DFUZZ_CHECK=check_{kind}", *(f"-I{lib / room}" for room in ("math", "space", "material")), "-I/usr/include/eigen3",
               str(ROOT / "tests" / "fuzz" / "fuzz_main.cpp"), *map(str, sorted((lib / "material").glob("*.cpp"))), "-o", str(program)]
    subprocess.run(command, check=True)
    return program


def run_cpp(kind, out, seed, seconds):
    """(executions, findings)"""
    out.mkdir(parents=True, exist_ok=True)
    program, corpus, words = build(kind, out), out / "corpus", out / "words"
    corpus.mkdir(exist_ok=True)
    for k, text in enumerate(seeds.of(kind)):
        (corpus / f"seed-{k}").write_bytes(text)
    words.write_text(seeds.dictionary(kind))
    n, end = 0, time.monotonic() + seconds
    while (left := int(end - time.monotonic())) > 0:  # it ends with what it finds
        command = [program, corpus, f"-max_total_time={left}", f"-seed={seed}", f"-dict={words}", f"-artifact_prefix={out}/found-", "-max_len=8192", "-timeout=10",
                   "-rss_limit_mb=2048", "-print_final_stats=1"]
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
        (out / "log").write_text(done.stdout)
        n += int((re.findall(r"number_of_executed_units: (\d+)", done.stdout) or [0])[-1])
        seed += 1
        if done.returncode:
            print(done.stdout[-3000:])
    return n, sorted(path.name for path in out.glob("found-*"))


def run_python(kind, out, seed, seconds):
    """in a process of its own, which may fall"""
    code = "import sys, readers; readers.limit(); n, found = readers.run(sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4])); print(n, *map(repr, found.items()), sep='\\n')"
    done = subprocess.run([sys.executable, "-c", code, kind, str(out), str(seed), str(seconds)], stdout=subprocess.PIPE, text=True, check=False,
                          cwd=ROOT / "tests" / "fuzz")
    lines = done.stdout.split("\n")
    if done.returncode:
        return 0, [f"the process ended with status {done.returncode}; its last file is {out}/now.{readers.KINDS[kind]}"]
    return int(lines[0]), [line for line in lines[1:] if line]


def run_lammps(lmp, out, seed, seconds):
    n, ran, found, messages = inputs.run(lmp, out, seed, seconds)
    (out / "messages.txt").write_text("".join(f"{count} {text}\n" for text, count in sorted(messages.items(), key=lambda item: -item[1])))
    print(f"lammps: {ran} of {n} inputs ran to their end, the others ended with {len(messages)} different messages", flush=True)
    return n, [f"{where}: {name}" for where, name in found.items()]


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--minutes", type=float, default=10, help="of each of the fuzzers")
    options.add_argument("--jobs", type=int, default=os.cpu_count(), help="fuzzers at once")
    options.add_argument("--out", type=pathlib.Path, default=ROOT / "build-sanitize" / "fuzz")
    options.add_argument("--lmp", type=pathlib.Path, default=ROOT / "build-sanitize" / "lmp")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", default=",".join(ALL), help="some of " + ",".join(ALL))
    args = options.parse_args()
    chosen = args.only.split(",")
    if unknown := [name for name in chosen if name not in ALL]:
        options.error(f"no fuzzer {', '.join(unknown)}; there are {', '.join(ALL)}")
    out, lmp, seconds = args.out.resolve(), args.lmp.resolve(), 60 * args.minutes
    if "lammps" in chosen and not lmp.is_file():
        options.error(f"{lmp} is not there: make build BUILD=build-sanitize SANITIZE=ON")

    def one(name):
        if name == "lammps":
            return name, run_lammps(lmp, out / name, args.seed, seconds)
        if name in CPP:
            return name, run_cpp(name, out / name, args.seed, seconds)
        return name, run_python(name.removeprefix("python-"), out / name, args.seed, seconds)

    bad = False
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for name, (n, found) in pool.map(one, chosen):
            print(f"{name}: {n} executions, {len(found)} findings", *found, sep="\n  ", flush=True)
            bad |= bool(found) or not n
    print(f"what was found is in {out}; seed {args.seed}")
    return bad


if __name__ == "__main__":
    sys.exit(main())
