"""Wrong inputs as data: tests/inputs/bad.yaml. Each ends with an error that says what is wrong, or runs and is right: no signal, no hang, no report of a sanitizer."""

import pathlib
import re
import shlex
import shutil
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import yaml

INPUTS = pathlib.Path(__file__).resolve().parents[1] / "inputs"
LIMIT = 120  # s; most end in 0.2
SHORT, PAIRS = 7, 60  # one row of so many runs on one rank in the short form, on two ranks
NUMBER = re.compile(r"[-+\d.e]*\d")
SCENES = sorted(path.name[3:] for path in INPUTS.glob("in.*"))


def edited(text, at, put):
    """the line that begins with at, which there must be once, is put instead; start and end: before and after all"""
    if at in ("start", "end"):
        return put + "\n" + text if at == "start" else text + put + "\n"
    lines = text.split("\n")
    (k,) = [k for k, line in enumerate(lines) if line.startswith(at)]
    return "\n".join([*lines[:k], *([put] if put else []), *lines[k + 1:]])


def read_rows():
    """{name of a group: its rows}: what is said or what holds, -var values, [(file, at, put)]"""
    groups = {}
    for k, group in enumerate(yaml.safe_load((INPUTS / "bad.yaml").read_text())):
        rows = groups[f"{k}-{group['scene']}-{group.get('file', group.get('at', 'run'))}"] = []
        for left, says in group["rows"]:
            put = group.get("put", "{}").replace("{}", left)
            edits = [("scene", at, text) for at, text in group.get("with", {}).items()]
            edits += [] if "vars" in group else [(group.get("file", "scene"), group.get("at", "run "), put)]
            edits = [(file, at, text.replace(" ; ", "\n")) for file, at, text in edits]
            rows.append(dict(scene=group["scene"], left=left, says=says, edits=edits, vars=group.get("vars", "").replace("{}", left), plugin="plugin" in group))
    return groups


GROUPS = read_rows()
ROWS = [row for rows in GROUPS.values() for row in rows]


def shown(text):
    """in one line"""
    return " ".join(text.split())


def matches(says, text):
    """... in what a row says is any text"""
    return re.search(".*?".join(map(re.escape, shown(says).split("..."))), text) is not None


@pytest.fixture
def start(lmp, lmp_stock, plugin, root, tmp_path, monkeypatch):
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))

    def run(row, folder, nranks):
        scene, folder = row["scene"], tmp_path / folder
        folder.mkdir()
        path = root / scene if "/" in scene else INPUTS / f"in.{scene}"
        for pattern in ("in.*", "*.data", "legs.*", "*.shock", "*.collapse"):
            for other in [*path.parent.glob(pattern)]:
                shutil.copy(other, folder)
        for file, at, put in row.get("edits", ()):
            target = folder / (path.name if file == "scene" else file)
            target.write_text(edited(target.read_text(), at, put.replace("PLUGIN", str(plugin))))
        if row.get("edits"):  # rows include the scene as it is
            (folder / "in").write_text((folder / path.name).read_text())
            shutil.copy(path, folder)
        else:
            shutil.copy(path, folder / "in")
        words = shlex.split(row.get("vars", ""))
        extra = [word for name, value in dict(zip(words[::2], words[1::2])).items() for word in ("-var", name, value)]
        return lmp(folder / "in", cwd=folder, nranks=nranks, extra=extra, timeout=LIMIT, exe=lmp_stock if row.get("plugin") else None, expect_fail=None)

    return run


@pytest.fixture(scope="session")
def plain():
    """{scene: what it gives by itself on one rank}"""
    return {}


def last(result):
    return np.array([column[-1] for column in result.thermo.values()])


def wrong(row, result, there):
    """what is wrong with the outcome of a row, '' if nothing is; there: that of its scene"""
    says = row["says"]
    if not 0 <= result.returncode < 128 or re.search("[Ss]ignal: |Sanitizer|runtime error: ", result.stdout + result.stderr):
        return "a crash"
    if isinstance(says, str):
        error = shown(result.error)
        return "no error" if result.returncode == 0 else "" if matches(says, error) else f"says {error!r}"
    if result.returncode:
        return f"does not run: {shown(result.error)!r}"
    if not all(np.isfinite(column).all() for run in result.runs for column in run.values()):
        return "a number that is none"
    usual = [NUMBER.sub("", w) for w in there.warnings] if there else []
    expected = [*says.get("warns", []), *says.get("may", []), "New thermo_style command"]
    more = [w for w in result.warnings if NUMBER.sub("", w) not in usual and not any(matches(e, w) for e in expected)]
    missing = [e for e in says.get("warns", []) if not any(matches(e, w) for w in result.warnings)]
    if more or missing:
        return f"warns of {more}, and not of {missing}"
    if "same" in says and not np.allclose(last(result)[1:], last(there)[1:], rtol=says["same"], atol=0):
        return f"ends with {last(result)}, the scene with {last(there)}"
    if "energy" in says and not abs(result.thermo["c_book[9]"][-1] - 1) < says["energy"]:
        return f"ratio of energies {result.thermo['c_book[9]'][-1]}"
    for name, value in says.get("ends", {}).items():
        if result.thermo[name][-1] != value:
            return f"{name} is {result.thermo[name][-1]}"
    return ""


def check(rows, start, plain, nranks):
    for scene in {row["scene"] for row in rows} & set(SCENES) - set(plain):
        plain[scene] = start(dict(scene=scene), scene, 1)

    def one(k):
        row = rows[k]
        try:
            problem = wrong(row, start(row, f"{k}.{nranks}", nranks), plain.get(row["scene"]))
        except (pytest.fail.Exception, ValueError) as failure:  # no end; a line that is not there, or twice
            problem = failure
        return f"{row['vars'] or row['edits']}\n  on {nranks} ranks: {problem}\n  not {row['says']}" if problem else None

    with ThreadPoolExecutor(4) as pool:
        problems = [p for p in pool.map(one, range(len(rows))) if p]
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("scene", SCENES)
def test_scene(start, scene):
    """what rows spoil works by itself; the elements are few, of which there is a warning"""
    result = start(dict(scene=scene), scene, 1)
    assert wrong(dict(says=dict(energy=1e-3)), result, result if scene == "elements" else None) == ""


@pytest.mark.parametrize("group", GROUPS)
def test_on_one_rank(start, plain, group):
    check(GROUPS[group][::SHORT], start, plain, 1)


def test_some_on_two_ranks(start, plain):
    check(ROWS[::PAIRS], start, plain, 2)


@pytest.mark.long
@pytest.mark.parametrize("group", GROUPS)
def test_all_on_one_rank(start, plain, group):
    check(GROUPS[group], start, plain, 1)


@pytest.mark.long
@pytest.mark.parametrize("group", GROUPS)
def test_all_on_two_ranks(start, plain, group):
    check(GROUPS[group], start, plain, 2)


def test_rows_are_there(root):
    """at least 250 rows; every style, every keyword and name that its page lists is in one"""
    assert len(ROWS) >= 250 and len({str((row["scene"], row["edits"], row["vars"])) for row in ROWS}) == len(ROWS)
    texts = [" ".join([row["vars"], *(f"{at} {put}" for _, at, put in row["edits"])]) for row in ROWS]
    missing = []
    for header in (root / "src" / "USER-HVI").glob("*.h"):
        for kind, style in re.findall(r"^(\w+)Style\(([\w/-]+),", header.read_text(), re.M):
            page = (root / "doc" / "src" / f"{header.stem.replace('hvi_hvi', 'hvi')}.rst").read_text()
            syntax = page[page.index("Syntax\n"):page.index("Examples\n")]
            listed = " ".join(re.findall(r"^\*[^=\n]*\b(?:keyword|NAMEs|MODE|KERNEL) = ((?:.|\n(?!\n|\*|\s+\.\.))*)", syntax, re.M))
            words = set(re.findall(r"\*([\w/]+)\*", listed)) | set(re.findall(r"^\s+\*([\w/]+)\* value", syntax, re.M))
            of_style = [t for t in texts if re.search(rf"(?<![\w/]){re.escape(style)}(?![\w/])", t)]
            if kind in ("Pair", "Bond"):
                of_style += [t for t in texts if re.match(rf" ?{kind.lower()}_coeff", t)]
            if not of_style:
                missing.append(style)
            missing += [f"{style} {word}" for word in words if not any(re.search(rf"(?<![\w/]){re.escape(word)}(?![\w/])", t) for t in of_style)]
    assert not missing, f"no row in {INPUTS / 'bad.yaml'} has {sorted(missing)}"
