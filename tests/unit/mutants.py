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
import concurrent.futures
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
NEGATED = "template <class T> T hvi_negated(T x) { if constexpr (std::is_same_v<T, bool>) return !x; else return -x; }\n" \
          "inline const int hvi_mutant = std::getenv(\"HVI_MUTANT\") ? std::atoi(std::getenv(\"HVI_MUTANT\")) : -1;\n"
HEADERS = "gtest/gtest.h Eigen/Dense algorithm cmath cstdlib filesystem fstream functional map random sstream type_traits".split()


def sites(text):
    """(offset, original, mutant, lines of the statement, switch) of all mutants of a source. A switch is (start, end, before, between, after):
    text[start:end] becomes before + the mutated text + between + the text + after, where a number says which of the two is run."""
    tokens = [m for m in TOKEN.finditer(text) if not m[0].startswith(("//", "/*")) and not m[0].lstrip().startswith("#")]
    word = [m[0] for m in tokens] + [""] * 2
    line = lambda offset: text.count("\n", 0, offset) + 1
    edges = [-1] + [k for k, w in enumerate(word) if w in ("{", "}", ";")] + [len(tokens)]
    fixed = False
    for begin, end in zip(edges, edges[1:]):
        inside = range(begin + 1, end)
        if not inside or "static_assert" in word[begin + 1:end]:
            continue
        lines = line(tokens[begin + 1].start()), line(tokens[end - 1].end())
        message = any(word[k].startswith('"') for k in inside)
        fixed = (bool({"constexpr", "case", "template", "enum", "using"} & set(word[begin + 1:end]))
                 or fixed and (word[begin] == "}" or word[begin] == "{" and word[begin - 1] in ("=", ",", "{", "(")))    # constants: no switch
        first = next((k for k in range(end - 1, begin, -1) if word[k] in (")", "else") and is_statement(word, k + 1, end)), begin) + 1
        whole = (tokens[first].start(), tokens[end].end(), "{ if (hvi_mutant == %d) { ", " } else { ", " } }") if is_statement(word, first, end) else None
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
            elif w == "return" and k + 1 < end and word[end] == ";" and word[k + 1] != "{":
                value = tokens[k + 1].start(), tokens[end - 1].end()
                yield (m.start(), text[m.start():value[1]], f"return hvi_negated({text[slice(*value)]})", lines,
                       (m.start(), value[1], "if (hvi_mutant == %d) ", "; else ", ""))
            elif k == first and whole:
                yield m.start(), text[m.start():tokens[end].end()], ";", lines, whole
            if new:
                around = whole if w[-1] == "=" and len(w) == 2 and w[0] in "+-*/" else expression(word, tokens, k)
                yield m.start(), w, new, lines, None if fixed else around


def is_statement(word, k, end):
    """Whether what can be left out stands from token k to the ; at end."""
    if word[end] != ";" or word[k] in KEYWORDS or not re.match(r"[A-Za-z_*]", word[k]):
        return False
    depth = [0]
    for x in word[k:end]:
        depth.append(depth[-1] + (x in "([") - (x in ")]"))
    return (word[k] in ("break", "continue") or word[k + 1] in ("=", ".", "->", "(", "[", "++", "--", "+=", "-=", "*=", "/=")) and not depth[-1] and min(depth) == 0


def expression(word, tokens, k):
    """A switch for the smallest expression with token k that stands by itself."""
    if re.match(r"\.?\d|true$|false$", word[k]):
        return tokens[k].start(), tokens[k].end(), "(hvi_mutant == %d ? ", " : ", ")"
    ends = []
    for step, opens, closes in ((-1, ")]}", "([{"), (1, "([{", ")]}")):
        depth, at = 0, k
        while 0 < at < len(tokens) - 1:
            x = word[at + step]
            if not depth and (x in (",", ";", "=", "?", ":", "return") or x in closes or x in ("{", "}") or (x[-1] == "=" and x in SWAPS and x[0] in "+-*/")):
                break
            depth += (x in opens) - (x in closes)
            at += step
        ends.append(at)
    return tokens[ends[0]].start(), tokens[ends[1]].end(), "(hvi_mutant == %d ? (", ") : (", "))"


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
        text = "".join(f"#include <{h}>\n" for h in HEADERS) + NEGATED
        if not (out / "all.h.gch").exists() or (out / "all.h").read_text() != text:
            (out / "all.h").write_text(text)
            subprocess.run([*self.compile, "-x", "c++-header", out / "all.h", "-o", out / "all.h.gch"], check=True)
        self.sources = sorted(self.src.rglob("*.cpp"))
        self.tests = [f.stem for f in self.sources if "tests" in f.parts]
        self.deps, self.parts, self.lines = {}, {}, {}
        self.pool = concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", 2)))
        list(self.pool.map(self.objects, self.sources))    # all once as it stands; what has not changed since is kept
        archive = out / "libhvi.a"
        archive.unlink(missing_ok=True)
        subprocess.run(["ar", "qcs", archive, *(out / f"{f.stem}.o" for f in self.sources if "tests" not in f.parts)], check=True)
        for t in self.tests:
            self.measure(t, archive)

    def objects(self, f):
        o, d, key = (self.out / (f.stem + e) for e in (".o", ".d", ".key"))
        known = lambda: [pathlib.Path(x) for x in d.read_text().replace("\\\n", " ").split(":", 1)[1].split() if str(self.src) in x]
        digest = lambda: hashlib.md5(b"".join(x.read_bytes() for x in known())).hexdigest()
        if not (o.exists() and key.exists() and all(x.exists() for x in known()) and key.read_text() == digest()):
            subprocess.run([*self.compile, "--coverage", "-include", self.out / "all.h", "-MMD", "-c", f, "-o", o], check=True)
            key.write_text(digest())
        self.deps[f.stem] = {str(x) for x in known()}

    def measure(self, t, archive):
        """A test's program: which objects of the library it takes, which lines it executes, how long it takes."""
        known, program = self.out / f"{t}.json", self.out / t
        key = lambda parts: hashlib.md5("".join((self.out / f"{p}.key").read_text() for p in parts).encode()).hexdigest()
        self.lines[t] = json.loads(known.read_text()) if known.exists() else {"parts": [t], "key": ""}
        if key(self.lines[t]["parts"]) != self.lines[t]["key"]:
            if subprocess.run([*self.link[0], self.out / f"{t}.o", archive, f"-Wl,-Map={self.out}/map", *self.link[1], "-o", program]).returncode:
                raise SystemExit(f"{t} does not link")
            parts = [t, *sorted(set(re.findall(r"libhvi\.a\((\w+)\.o\)", (self.out / "map").read_text())))]
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
            known.write_text(json.dumps({"key": key(parts), "parts": parts, "seconds": seconds, "lines": lines}))
            self.lines[t] = json.loads(known.read_text())
        self.parts[t] = self.lines[t]["parts"]

    def run(self, program, seconds, mutant=-1):
        limit = lambda: (resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds))), resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30)))
        work = self.out / "work"
        work.mkdir(exist_ok=True)
        r = subprocess.run([ROOT / "cmake/env.sh", program], preexec_fn=limit, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=work, text=True,
                           errors="replace", env={**os.environ, "GTEST_FAIL_FAST": "1", "HVI_MUTANT": str(mutant), "TMPDIR": str(work)})
        if r.returncode == 0:
            return None, r.stdout
        if r.returncode in (-24, -9, 152, 137):
            return "timeout", r.stdout
        return (re.findall(r"\[  FAILED  \] (\w[\w/.]*)", r.stdout) or re.findall(r"\[ RUN      \] (\S+)", r.stdout) or ["start"])[-1], r.stdout

    def compile_mutants(self, mutants, made, only=None):
        """Compiles all that includes one of them and is not made. Returns those that stand where the compiler says that something is wrong."""
        touched = {}
        for k, f, text, offset, old, new, lines, switch in sorted(mutants, key=lambda m: -m[3]):
            text = touched.get(f, text)
            if len(mutants) == 1 or not switch:
                touched[f] = text[:offset] + new + text[offset + len(old):]
            else:
                start, end, before, between, after = switch
                plain = text[start:end]
                mutated = (plain[:offset - start] + new + plain[offset - start + len(old):]).replace("\n", " ")    # lines keep their numbers
                touched[f] = text[:start] + before % k + mutated + between + plain + after + text[end:]
        for f, text in touched.items():
            (self.src / f).write_text(text)
        (self.out / "mutant").mkdir(exist_ok=True)

        def one(source):
            target = self.out / "mutant" / f"{source.stem}.o"
            r = subprocess.run([*self.compile, "-include", self.out / "all.h", "-c", source, "-o", target], stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "CCACHE_DISABLE": "1"})
            if not r.returncode:
                made[source.stem] = target
                return set()
            places = {(f, int(n)) for f, n in re.findall(r"/src/(lib/[\w./]+):(\d+)", r.stderr)}
            return ({m[0] for m in mutants if any((m[1], n) in places for n in range(m[6][0], m[6][1] + 1))}
                    or {m[0] for m in mutants if str(self.src / m[1]) in self.deps[source.stem]})

        paths = {str(self.src / f) for f in touched}
        wrong = set().union(*self.pool.map(one, [s for s in self.sources if s.stem not in made and s.stem in (only or self.deps) and self.deps[s.stem] & paths]))
        for f in touched:
            shutil.copyfile(ROOT / f, self.src / f)
        return wrong

    def judge(self, mutant, made, programs, alone):
        """Outcome of a mutant, and by which test. Alone it is compiled as far as that takes."""
        number, f, lines = mutant[0], str(self.src / mutant[1]), mutant[6]
        users = [t for t in self.tests if any(f in self.deps[p] for p in self.parts[t])]
        counts = lambda t, more: [self.lines[t]["lines"].get(f, {}).get(str(n)) for n in range(lines[0] - more, lines[1] + more + 1)]
        data = any(x is not None for t in users for x in counts(t, 0))
        runs = [t for t in users if any(counts(t, 0))] or [t for t in users if not data or any(counts(t, 2))]    # gcov may count in the next line
        stem = pathlib.Path(f).stem[4:]
        for t in sorted(runs, key=lambda t: (t[5:] not in stem and stem not in t, self.lines[t]["seconds"])):
            if alone and self.compile_mutants([mutant], made, self.parts[t]):
                return "does not compile", ""
            if t not in programs:
                programs[t] = self.out / "mutant" / t
                subprocess.run([*self.link[0], *(made.get(p, self.out / f"{p}.o") for p in self.parts[t]), *self.link[1], "-o", programs[t]], check=True)
            failed, _ = self.run(programs[t], 10 + 10 * self.lines[t]["seconds"], number)
            if failed:
                return ("timeout", t) if failed == "timeout" else ("killed", failed)
        if not runs and alone and self.compile_mutants([mutant], made, {next(s for s in self.deps if f in self.deps[s])}):
            return "does not compile", ""
        return "survived", " ".join(sorted(t[5:] for t in runs)) or "none runs it"


def split_batch(todo, found, count):
    """Of the next ones: those that can be switched together, those to be compiled alone, the others."""
    batch, alone, taken = [], [], collections.defaultdict(list)
    for k in todo[:count]:
        f, switch = found[k][0], found[k][-1]
        if not switch:
            alone.append(k)
        elif all(switch[1] <= start or end <= switch[0] for start, end in taken[f]):
            taken[f].append(switch[:2])
            batch.append(k)
    return batch, alone, [k for k in todo if k not in set(batch + alone)]


def write(rows):
    with open(RECORD, "w", newline="") as f:
        out = csv.DictWriter(f, FIELDS, lineterminator="\n")
        out.writeheader()
        out.writerows(sorted(rows, key=lambda r: (r["file"], int(r["line"]), int(r["column"]))))


def report(rows, seed):
    compiled = [r for r in rows if r["outcome"] != "does not compile"]
    count = lambda rows, *what: sum(r["outcome"] in what for r in rows)
    reasons = collections.Counter(r["explanation"].split(":")[0] for r in compiled if r["outcome"] == "survived")
    meant = {"equivalent": "no input tells them from the source", "boundary": "only a number that is met exactly does, and to either side both are right",
             "same root": "an iteration takes another path to it", "rounding": "below the last digit", "resources": "no result shows it",
             "style": "more than one rank is needed; the test that is named fails with each of them"}
    text = ["# Mutants of the library", "", "Written by `python3 tests/unit/mutants.py` (`make mutate`) from mutants.csv, which has each mutant.", "",
            f"Seed {seed}: {len(rows)} mutants, {len(rows) - len(compiled)} of them do not compile. Of the {len(compiled)} others the unit tests kill "
            f"{count(compiled, 'killed', 'timeout')} ({count(compiled, 'timeout')} by running without end); {count(compiled, 'survived')} survive:", "",
            *(f"- {n} {why or 'not explained'}{': ' + meant[why] if why in meant else ''}" for why, n in reasons.most_common()), "", "| room | compile | killed | survive |", "|---|---|---|---|"]
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
            for offset, old, new, lines, switch in sites(text):
                start = text.rfind("\n", 0, offset) + 1
                key = str(f.relative_to(ROOT)), text.count("\n", 0, offset) + 1, offset - start + 1, " ".join(old.split()), " ".join(new.split())
                comment = switch and "//" in text[switch[0]:switch[1]]
                found[key] = str(f.relative_to(ROOT)), text, offset, old, new, lines, None if comment else switch
        identity = lambda r: (r["file"], int(r["line"]), int(r["column"]), r["original"], r["mutant"])
        rows = [r for r in rows if identity(r) in found]    # what the sources do not have any more goes
        order = sorted(found)
        random.Random(a.seed).shuffle(order)
        recorded = {identity(r): r for r in rows}
        print(f"{len(found)} sites in {len(files)} files, {len(rows)} in the record")
        todo = [k for k in order if (k in recorded and recorded[k]["outcome"] == a.again and a.only in k[0] if a.again else k not in recorded)]
        while todo and (a.again or sum(r["outcome"] != "does not compile" for r in rows) < a.count):
            batch, alone, todo = split_batch(todo, found, len(todo) if a.again else a.count - sum(r["outcome"] != "does not compile" for r in rows))
            mutants = [(n, *found[k]) for n, k in enumerate(batch)]
            programs, made = {}, {}
            while mutants:    # what cannot be switched is compiled by itself
                wrong = build.compile_mutants(mutants, made)
                if not wrong:
                    break
                alone += [batch[m[0]] for m in mutants if m[0] in wrong]
                mutants = [m for m in mutants if m[0] not in wrong]
            print(f"{len(mutants)} together, {len(alone)} each by itself", flush=True)
            for k in [batch[m[0]] for m in mutants] + alone:
                if k in alone:
                    mutants, programs, made = [(0, *found[k])], {}, {}
                m = next(m for m in mutants if m[1:] == found[k])
                outcome, test = build.judge(m, made, programs, k in alone)
                r = recorded.setdefault(k, dict(zip(FIELDS, [*k, "", "", ""])))
                if r not in rows:
                    rows.append(r)
                r |= {"outcome": outcome, "test": test, "explanation": r["explanation"] if outcome == "survived" else ""}
                write(rows)
                print(f"{k[0]}:{k[1]}:{k[2]}  {k[3][:60]} -> {k[4][:60]}: {outcome} {test}", flush=True)
    report(rows, a.seed)


if __name__ == "__main__":
    main()
