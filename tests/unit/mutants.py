#!/usr/bin/env python3
"""Mutants of the library against its unit tests: what no test of tests/unit notices is not tested there.

    python3 tests/unit/mutants.py                        until tests/unit/mutants.csv has 300 mutants that compile (--count N: N); goes on where it stopped
    python3 tests/unit/mutants.py --again survived       the survivors once more, after new tests; killed: all others
    python3 tests/unit/mutants.py --report               tests/unit/mutants.md from the record, without running anything

A mutant differs from the source in one token, or lacks a statement, or returns the negative. Sites are drawn at random, the same for
the same seed and sources. Unit tests are programs of their own here, compiled without optimization, LAMMPS and ccache; a mutant runs
those that execute its statement (by gcov), the likeliest first, until one fails. Explanations are the last column of the record.
"""

import argparse
import collections
import csv
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = ROOT / "tests/unit/mutants.csv"
FIELDS = ["file", "line", "column", "original", "mutant", "outcome", "test", "explanation"]
ROOMS = ["math", "space", "material", "sph", "elements", "measure", "dem"]
MUTATED = ["math/*", "space/*", "material/*", "sph/hvi_kernel.h", "sph/hvi_artstress.h", "elements/*", "measure/*", "dem/*"]
SWAPS = {"+": "-", "*": "/", "<": "<=", ">": ">=", "==": "!=", "&&": "||", "+=": "-=", "*=": "/="}
SWAPS |= {b: a for a, b in SWAPS.items()}
WORDS = {"true": "false", "min": "max"}
WORDS |= {b: a for a, b in WORDS.items()}
KEYWORDS = set("return if for while do else switch case default const static constexpr struct class template typename public private using "
               "explicit inline typedef namespace friend operator new delete throw enum union virtual sizeof goto".split())
TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:else\b.*?^[ \t]*\#endif|(?:\\\n|[^\n])*)|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'
    |0x[0-9a-fA-F.]+(?:p[-+]?\d+)?\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?\w*|\w+|::|->|<<=|>>=|<<|[-+*/<>=!&|^%]=|&&|\|\||\+\+|--|\S""", re.X | re.S | re.M)
NEGATED = "template <class T> T hvi_negated(T x) { if constexpr (std::is_same_v<T, bool>) return !x; else return -x; }\n"
HEADERS = "gtest/gtest.h Eigen/Dense algorithm cmath filesystem fstream functional map random sstream type_traits".split()


def sites(text):
    """(offset, original, mutant, first line and last line of the statement) of all mutants of a source."""
    tokens = [m for m in TOKEN.finditer(text) if not m[0].startswith(("//", "/*")) and not m[0].lstrip().startswith("#")]
    word = [m[0] for m in tokens] + [""] * 2
    line = lambda offset: text.count("\n", 0, offset) + 1
    edges = [-1] + [k for k, w in enumerate(word) if w in ("{", "}", ";")] + [len(tokens)]
    for begin, end in zip(edges, edges[1:]):
        inside = range(begin + 1, end)
        if not inside or "static_assert" in word[begin + 1:end]:
            continue
        lines = line(tokens[begin + 1].start()), line(tokens[end - 1].end())
        message = any(word[k].startswith('"') for k in inside)
        for k in inside:
            w, m, before, after = word[k], tokens[k], word[k - 1], word[k + 1]
            new = None
            if w in SWAPS:
                apart = text[m.start() - 1].isspace() and text[m.end()].isspace() and before != "operator" and re.match(r"[\w)\]]", before[-1])
                new = SWAPS[w] if apart and not (message and w in "+-") else None
            elif w in WORDS and after not in ("=", ";"):
                new = WORDS[w]
            elif re.match(r"\.?\d", w) and not w.startswith("0x") and not (before == "[" and re.match(r"\w", word[k - 3]) and word[k - 3] != "return"):
                new = f"({w} * 1.1)" if re.search(r"[.eE]", w) and float(w.rstrip("fFlL")) else f"({w} + 1)"
            elif w == "return" and k + 1 < end and word[end] == ";":
                yield m.start(), text[m.start():tokens[end - 1].end()], f"return hvi_negated({text[tokens[k + 1].start():tokens[end - 1].end()]})", lines
            elif (word[end] == ";" and w not in KEYWORDS and re.match(r"[A-Za-z_*]", w) and (k == begin + 1 or before in (")", "else"))
                  and (w in ("break", "continue") or after in ("=", ".", "->", "(", "[", "++", "--", "+=", "-=", "*=", "/="))
                  and "{" not in text[m.start():tokens[end].start()]):
                depth = 0    # a statement from here to ;, not the end of a for (...)
                for x in word[k:end]:
                    depth += (x in "([") - (x in ")]")
                    if depth < 0:
                        break
                if depth == 0:
                    yield m.start(), text[m.start():tokens[end].end()], ";", lines
            if new:
                yield m.start(), w, new, lines


class Build:
    def __init__(self, out, compiler):
        self.out, self.src = out, out / "src"
        for part in ("lib/hvi", "tests/unit"):
            shutil.copytree(ROOT / part, self.src / part, dirs_exist_ok=True)
            for f in [f for f in (self.src / part).rglob("*") if not (ROOT / f.relative_to(self.src)).exists()]:
                f.unlink()
        if not (self.src / "potentials").exists():
            (self.src / "potentials").symlink_to(ROOT / "potentials")
        mpi = subprocess.run(["mpicxx", "--showme:compile"], capture_output=True, text=True).stdout
        link = subprocess.run(["mpicxx", "--showme:link"], capture_output=True, text=True).stdout
        include = " ".join(f"-I{self.src}/lib/hvi/{r}" for r in ROOMS)
        self.compile = shlex.split(f"{compiler} -std=c++17 -O0 -march=native -w -I{self.src}/tests/unit {include} -isystem /usr/include/eigen3 {mpi}")
        self.link = shlex.split(f"{compiler} --coverage"), shlex.split(f"-lgtest_main -lgtest -lpthread {link}")
        (out / "all.h").write_text("".join(f"#include <{h}>\n" for h in HEADERS) + NEGATED)
        if not (out / "all.h.gch").exists():
            subprocess.run([*self.compile, "-x", "c++-header", out / "all.h", "-o", out / "all.h.gch"], check=True)
        self.sources = sorted(self.src.rglob("*.cpp"))
        self.tests = [f.stem for f in self.sources if "tests" in f.parts]
        self.deps, self.parts, self.lines = {}, {}, {}
        for f in self.sources:    # all once as it stands; what has not changed since is kept
            self.objects(f)
        archive = out / "libhvi.a"
        archive.unlink(missing_ok=True)
        subprocess.run(["ar", "qcs", archive, *(out / f"{f.stem}.o" for f in self.sources if "tests" not in f.parts)], check=True)
        for t in self.tests:
            self.measure(t, archive)

    def objects(self, f):
        o, d, key = (self.out / (f.stem + e) for e in (".o", ".d", ".key"))
        digest = lambda: hashlib.md5(b"".join(pathlib.Path(x).read_bytes() for x in read_deps(d))).hexdigest()
        if not (d.exists() and all(pathlib.Path(x).exists() for x in read_deps(d)) and o.exists() and key.exists() and key.read_text() == digest()):
            subprocess.run([*self.compile, "--coverage", "-include", self.out / "all.h", "-MMD", "-c", f, "-o", o], check=True)
            key.write_text(digest())
        self.deps[f.stem] = {x for x in read_deps(d) if str(self.src) in x}

    def measure(self, t, archive):
        """A test's program: which objects of the library it takes, which lines it executes, how long it takes."""
        known, program = self.out / f"{t}.json", self.out / t
        r = subprocess.run([*self.link[0], self.out / f"{t}.o", archive, f"-Wl,-Map={self.out}/map", *self.link[1], "-o", program])
        if r.returncode:
            raise SystemExit(f"{t} does not link")
        parts = [t, *sorted(set(re.findall(r"libhvi\.a\((\w+)\.o\)", (self.out / "map").read_text())))]
        key = hashlib.md5("".join((self.out / f"{p}.key").read_text() for p in parts).encode()).hexdigest()
        if not known.exists() or json.loads(known.read_text())["key"] != key:
            for f in self.out.glob("*.gcda"):
                f.unlink()
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            failed, out = self.run(program, 600)
            if failed:
                raise SystemExit(f"{t} fails without a mutant:\n{out}")
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            lines = collections.defaultdict(dict)
            for p in parts:
                data = subprocess.run(["gcov", "-t", "-j", f"{p}.gcda"], cwd=self.out, capture_output=True, check=True).stdout
                for f in json.loads(data)["files"]:
                    for x in f["lines"] if str(self.src) in f["file"] else ():
                        n = str(x["line_number"])
                        lines[f["file"]][n] = lines[f["file"]].get(n, 0) + x["count"]
            known.write_text(json.dumps({"key": key, "parts": parts, "seconds": seconds, "lines": lines}))
        self.lines[t] = json.loads(known.read_text())
        self.parts[t] = self.lines[t]["parts"]

    def run(self, program, seconds):
        limit = lambda: (resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds))), resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30)))
        work = self.out / "work"
        work.mkdir(exist_ok=True)
        r = subprocess.run([ROOT / "cmake/env.sh", program], preexec_fn=limit, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=work, text=True,
                           errors="replace", env={**os.environ, "GTEST_FAIL_FAST": "1", "TMPDIR": str(work)})
        if r.returncode == 0:
            return None, r.stdout
        if r.returncode in (-24, -9, 152, 137):
            return "timeout", r.stdout
        return (re.findall(r"\[  FAILED  \] (\w[\w/.]*)", r.stdout) or re.findall(r"\[ RUN      \] (\S+)", r.stdout) or ["start"])[-1], r.stdout

    def judge(self, f, lines):
        """Outcome and test of the mutant that stands in the copy of f."""
        f, within = str(f), [str(n) for n in range(lines[0], lines[1] + 1)]
        users = [t for t in self.tests if any(f in self.deps[p] for p in self.parts[t])]
        seen = {t: [self.lines[t]["lines"].get(f, {}).get(n) for n in within] for t in users}
        data = any(x is not None for counts in seen.values() for x in counts)
        runs = [t for t in users if not data or any(seen[t])]
        stem = pathlib.Path(f).stem[4:]
        runs.sort(key=lambda t: (t[5:] not in stem and stem not in t, sum(f in self.deps[p] for p in self.parts[t]), self.lines[t]["seconds"]))
        made = {}

        def make(p):
            if p not in made:
                source = next(s for s in self.sources if s.stem == p)
                made[p] = self.out / "mutant" / f"{p}.o"
                made[p].parent.mkdir(exist_ok=True)
                return subprocess.run([*self.compile, "-include", self.out / "all.h", "-c", source, "-o", made[p]], stderr=subprocess.DEVNULL,
                                      env={**os.environ, "CCACHE_DISABLE": "1"}).returncode == 0
            return True

        for t in runs or sorted((s for s in self.deps if f in self.deps[s]), key=lambda s: len(self.deps[s]))[:1]:
            changed = [p for p in self.parts.get(t, [t]) if f in self.deps[p]]
            if not all(make(p) for p in changed):
                return "does not compile", ""
            if not runs:
                return "survived", "none runs it"
            objects = [made.get(p, self.out / f"{p}.o") for p in self.parts[t]]
            program = self.out / "mutant" / "program"
            if subprocess.run([*self.link[0], *objects, *self.link[1], "-o", program], stderr=subprocess.DEVNULL).returncode:
                return "does not compile", ""
            failed, _ = self.run(program, 10 + 10 * self.lines[t]["seconds"])
            if failed:
                return ("timeout", t) if failed == "timeout" else ("killed", failed)
        return "survived", " ".join(sorted(t[5:] for t in runs))


def read_deps(d):
    return d.read_text().replace("\\\n", " ").split(":", 1)[1].split()


def write(rows):
    with open(RECORD, "w", newline="") as f:
        out = csv.DictWriter(f, FIELDS, lineterminator="\n")
        out.writeheader()
        out.writerows(sorted(rows, key=lambda r: (r["file"], int(r["line"]), int(r["column"]))))


def report(rows, seed):
    compiled = [r for r in rows if r["outcome"] != "does not compile"]
    count = lambda rows, *what: sum(r["outcome"] in what for r in rows)
    reasons = collections.Counter(r["explanation"].split(":")[0] for r in compiled if r["outcome"] == "survived")
    text = ["# Mutants of the library", "", "Written by `python3 tests/unit/mutants.py` (`make mutate`) from mutants.csv, which has each mutant.", "",
            f"Seed {seed}: {len(rows)} mutants, {len(rows) - len(compiled)} of them do not compile. Of the {len(compiled)} others the unit tests kill "
            f"{count(compiled, 'killed', 'timeout')} ({count(compiled, 'timeout')} by running without end); {count(compiled, 'survived')} survive:", "",
            *(f"- {n}: {why or 'not explained'}" for why, n in reasons.most_common()), "", "| room | compile | killed | survive |", "|---|---|---|---|"]
    for room in ROOMS:
        part = [r for r in compiled if r["file"].startswith(f"lib/hvi/{room}/")]
        text.append(f"| {room} | {len(part)} | {count(part, 'killed', 'timeout')} | {count(part, 'survived')} |")
    RECORD.with_suffix(".md").write_text("\n".join(text) + "\n")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--count", type=int, default=300, help="mutants that compile")
    p.add_argument("--seed", type=int, default=36)
    p.add_argument("--out", type=pathlib.Path, default=ROOT / "build-mutate", help="build folder")
    p.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    p.add_argument("--again", metavar="OUTCOME", help="run those of the record with this outcome")
    p.add_argument("--only", default="", help="with --again: files whose name contains this")
    p.add_argument("--report", action="store_true")
    a = p.parse_args()
    rows = list(csv.DictReader(open(RECORD))) if RECORD.exists() else []
    if not a.report:
        a.out.mkdir(parents=True, exist_ok=True)
        build = Build(a.out.resolve(), a.compiler)
        files = sorted(f for pattern in MUTATED for f in (ROOT / "lib/hvi").glob(pattern))
        found = {}
        for f in files:
            text = f.read_text()
            for offset, old, new, lines in sites(text):
                start = text.rfind("\n", 0, offset) + 1
                key = str(f.relative_to(ROOT)), text.count("\n", 0, offset) + 1, offset - start + 1, " ".join(old.split()), " ".join(new.split())
                found[key] = f, text[:offset] + new + text[offset + len(old):], lines
        identity = lambda r: (r["file"], int(r["line"]), int(r["column"]), r["original"], r["mutant"])
        rows = [r for r in rows if identity(r) in found]    # what the sources do not have any more goes
        order = sorted(found)
        random.Random(a.seed).shuffle(order)
        recorded = {identity(r): r for r in rows}
        again = [k for k in order if k in recorded and recorded[k]["outcome"] == a.again and a.only in k[0]]
        print(f"{len(found)} sites in {len(files)} files, {len(rows)} in the record")
        for k in again if a.again else order:
            if not a.again and (k in recorded or sum(r["outcome"] != "does not compile" for r in rows) >= a.count):
                continue
            f, text, lines = found[k]
            copy = build.src / f.relative_to(ROOT)
            copy.write_text(text)
            outcome, test = build.judge(copy, lines)
            copy.write_text(f.read_text())
            r = recorded.get(k) or dict(zip(FIELDS, [*k, "", "", ""]))
            if k not in recorded:
                rows.append(r)
            r |= {"outcome": outcome, "test": test, "explanation": r["explanation"] if outcome == "survived" else ""}
            write(rows)
            print(f"{k[0]}:{k[1]}:{k[2]}  {k[3][:60]} -> {k[4][:60]}: {outcome} {test}", flush=True)
    report(rows, a.seed)


if __name__ == "__main__":
    main()
