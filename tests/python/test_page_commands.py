"""Command lines of README.md, the tutorial and the other pages: each is known word by word, and runs here, or NOT_HERE says why it does not.

Those of examples: test_readmes.py.
"""

import os
import re
import shlex
import subprocess
import sys

import pytest
from conftest import ROOT
from hvi import cli
from input_variables import known

PAGES = [ROOT / "README.md", ROOT / "bench" / "README.md", ROOT / "tests" / "fuzz" / "README.md", *sorted((ROOT / "doc" / "src").glob("*.rst"))]
BEGINS = r"(?:\w+=\S+ +)*(?:apt-get|git|cd|make|cmake|ctest|export|hvi|build/hvi|venv/bin/\w+|mpirun|lmp|build/lmp|cmake/env\.sh|python3)(?=\s|$)"
HVI = (["python3", "-m", "hvi"], ["hvi"], ["build/hvi"], ["venv/bin/hvi"])

# why a line does not run here; the first that is found in it
NOT_HERE = (
    (r"^(make|cmake|ctest)\b", "a build, or all tests: tests/style/test_build.py, .ci/run"),
    (r"^(apt-get|git)\b|pip install|-m venv|venv/bin/", "needs a network, or root; pip and venv: tests/python/test_package.py"),
    (r"CASE|mine\.csv|mine\.yaml|SEED|KIND|more\.csv|/path/to|\$HOME|\$HVI|\$SCRATCH|part\.inp|FILE", "names are the user's"),
    (r"debris\.dump|cloud1\.dump|film\.\d", "of the output of a run: tests/python/test_hvi_command.py, test_report.py have others"),
    (r"hvi (report|movie|export|judge|compare|view runs/)", "of the folder of a run: tests/python/test_report.py, tests/verify/test_shield.py"),
    (r"hvi (shield|limit|curve|shots|limits)\b(?!.*(--dry-run|--equations|--write))", "minutes or more: short ones in tests/verify/test_shield.py, tests/python"),
    (r"hvi calibrate \S+\.yaml", "of the runs of a search: tests/python/test_calibration.py"),
    (r"hvi doctor", "tests/python/test_doctor.py"),
    (r"(my|thick)\.yaml", "of the tutorial: tests/python/test_tutorial.py"),
    (r"hvi body|--fill glass|--size", "some seconds each: tests/python/test_body.py"),
    (r"\blmp\b.*-in ", "of an input of the page, or of hours; inputs of pages: tests/python/test_docs.py, test_tutorial.py"),
    (r"python3 (bench|tests)/", "minutes or more: make bench, make verify, make fuzz"),
    (r"^(cd|export)\b", "for the lines below it"),
)


def lines(path):
    """command lines of blocks of code, without comments, continued lines joined"""
    text = path.read_text().replace("\\\n", " ")
    if path.suffix == ".md":
        text = re.sub(r"```(?!bash).*?```", "", text, flags=re.S)
    text = re.sub(r"^\.\. code-block:: (?!bash|none).*\n\n(?:(?: .*)?\n)+?(?=\S)", "", text, flags=re.M)
    margin = r" {4}" if path.suffix == ".md" else r" {3}"
    for line in re.findall(rf"^{margin}({BEGINS}.*)$", text, re.M):
        yield re.sub(r"\s+(#.*)?$", "", line)


def literals(path):
    """commands in the text, of which words may be left out"""
    mark = r"(?<!`)`([^`\n]+)`(?!`)" if path.suffix == ".md" else r"``([^`]+?)``"
    for text in re.findall(mark, path.read_text()):
        yield from (part.strip() for part in re.split(r";|, and |, with", " ".join(text.split())) if re.match(BEGINS, part.strip()))


ALL = [(path.name if path.suffix == ".rst" else str(path.relative_to(ROOT)), line) for path in PAGES for line in lines(path)]


def parts(line):
    """simple commands of a line, as words"""
    words = []
    for word in [*shlex.split(line), "&&"]:
        if word not in ("&&", ";"):
            words.append(word)
        elif words:
            yield words
            words = []


def after(words):
    """without what stands before a command: X=Y, cmake/env.sh, mpirun -np N"""
    while words and (re.match(r"\w+=", words[0]) or words[0] == "cmake/env.sh"):
        words = words[1:]
    if words[:2] == ["mpirun", "-np"]:
        words = words[3:]
    return words


def hvi(words):
    """words behind python3 -m hvi, or None"""
    return next((words[len(start):] for start in HVI if words[:len(start)] == start), None)


def targets():
    return set(re.search(r"^\.PHONY: (.+)$", (ROOT / "Makefile").read_text(), re.M).group(1).split())


def wrong(words, whole=True):
    """what is wrong with a command, or None; whole: all words are there"""
    words = after(words)
    if (said := hvi(words)) is not None:
        if whole:
            try:
                cli.parse(said)
            except SystemExit as status:
                return None if status.code == 0 else "hvi refuses it"
            return None
        names = [word for word in said[:1] if re.fullmatch(r"[a-z]+", word)]
        if any(name not in cli.COMMANDS for name in names):
            return f"no command {names[0]}"
        takes = options(names[0]) if names else {"--help", "--version"}
        lost = [word for word in said if word.startswith("--") and word.partition("=")[0] not in takes]
        return f"no option {lost[0]}" if lost else None
    if words[:1] == ["make"]:
        lost = [word for word in words[1:] if word not in targets() and not re.search(rf"\b{re.escape(word.partition('=')[0])}\b", (ROOT / "Makefile").read_text())]
        return f"no target or variable {lost[0]}" if lost else None
    if words[:1] == ["python3"] and words[1:] and words[1] not in ("-m", "-c"):
        return None if (ROOT / words[1]).is_file() or list(ROOT.glob(f"examples/*/{words[1]}")) else f"no file {words[1]}"
    if words[:3] == ["python3", "-m", "pytest"]:
        files = [word.partition("::")[0] for word in words if word.startswith("tests/")]
        return next((f"no file {file}" for file in files if not (ROOT / file).is_file()), None)
    if words[:1] in (["lmp"], ["build/lmp"]) and "-in" in words[:-1]:
        name = words[words.index("-in") + 1]
        scripts = [*ROOT.glob(f"examples/**/{name}")] or [ROOT / "examples/whipple-shield/in.shield"] * (name == "in.continue")
        takes = {one for script in scripts for one in known(script)} | {"NAME"}
        lost = [words[k + 1] for k, word in enumerate(words[:-1]) if word == "-var" and scripts and words[k + 1] not in takes and name != "in.continue"]
        return f"{name} has no variable {lost[0]}" if lost else None
    if words[:2] == ["cmake", "--preset"]:
        return None if f'"{words[2]}"' in (ROOT / "cmake" / "CMakePresets.json").read_text() else f"no preset {words[2]}"
    return None


def options(command):
    """of a command of hvi"""
    parser = cli.options(command)
    several = next(action for action in parser._actions if getattr(action, "choices", None))
    return set(several.choices[command]._option_string_actions)


def why(line):
    return next((reason for pattern, reason in NOT_HERE if re.search(pattern, line)), None)


def test_lines_are_found():
    assert len(ALL) > 80 and {name for name, _ in ALL} >= {"README.md", "Tutorial.rst", "Howto_front.rst", "Howto_python.rst", "Howto_ble.rst", "Howto_build.rst"}


def test_lines_are_known():
    """each word, by the parser of hvi, the Makefile, variables of inputs"""
    assert [f"{name}: {line}: {found}" for name, line in ALL for words in parts(line) if (found := wrong(words))] == []


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name if path.suffix == ".rst" else path.parent.name)
def test_words_in_the_text_are_known(path):
    broken = []
    for text in literals(path):
        try:
            words = shlex.split(text)
        except ValueError:  # a part of a command with an open quote
            continue
        broken += [f"{text}: {found}"] if (found := wrong(words, whole=False)) else []
    assert broken == []


@pytest.mark.parametrize("line", ["python3 -m hvi shield CASE.yaml --job 2 --spacing 1", "hvi limit CASE.yaml --from 2", "make demos", "make demo RANK=2", "python3 tests/none.py",
                                  "cmake --preset fast", "lmp -in in.plate -var spacing 1", "mpirun -np 2 lmp -in in.shield -var up 10"])
def test_a_wrong_line_is_found(line):
    assert [found for words in parts(line) if (found := wrong(words))]


@pytest.mark.parametrize("text", ["hvi shields", "python3 -m hvi fragments --distanc R", "make demos"])
def test_a_wrong_word_is_found(text):
    assert wrong(shlex.split(text), whole=False)


def test_reasons_are_used():
    """none is for a line that is gone"""
    for pattern, reason in NOT_HERE:
        assert any(re.search(pattern, line) for _, line in ALL), reason


HERE = [(name, line) for name, line in dict.fromkeys(ALL) if not why(line)]


def test_lines_run(tmp_path, lmp_exe):
    """all others as they stand, in the order of a page, in a folder that has the folders of the source tree"""
    assert len(HERE) >= 10
    environment = {**os.environ, "HVI_LMP": str(lmp_exe), "PYTHONPATH": str(ROOT / "python"), "LAMMPS_POTENTIALS": str(ROOT / "potentials"), "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"}
    (tmp_path / "build").mkdir()
    (tmp_path / "build/hvi").write_text('#!/bin/sh\nexec python3 -m hvi "$@"\n')  # the tree of the tests may have another build folder, or none
    (tmp_path / "build/hvi").chmod(0o755)
    for link, target in (("examples", ROOT / "examples"), ("potentials", ROOT / "potentials"), ("python", ROOT / "python"), ("bin/python3", sys.executable)):
        (tmp_path / link).parent.mkdir(exist_ok=True)
        (tmp_path / link).symlink_to(target)
    for name, line in HERE:
        folder = tmp_path / name.partition(".")[0].replace("/", "-")
        if not folder.is_dir():
            folder.mkdir()
            for link in ("examples", "potentials", "python", "build"):
                (folder / link).symlink_to(tmp_path / link)
        done = subprocess.run(["bash", "-c", line], cwd=folder, env=environment, text=True, capture_output=True, timeout=900)
        assert done.returncode == 0, f"{name}: {line}: {done.stdout[-1000:]}{done.stderr[-1000:]}"
