"""The commands in the READMEs of the examples, as they stand: programs, files and variables are there; the quick ones run."""

import os
import re
import shlex
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT
from hvi import cli
from input_variables import known

EXAMPLES = sorted(path.parent for path in (ROOT / "examples").glob("**/README.md"))
# what a block of commands leaves behind for the next ones
MADE = re.compile(r"cloud\d\.dump|wall\d\.data|runs(/.*)?|fronts")
QUICK = {"layered-shock": 0, "standard-shocks": 0, "stock-comparison": 0, "spall": 0}  # number of the command: a second


def blocks(folder):
    """indented lines of a README that begin with a command, comments off and continued lines joined"""
    text = (folder / "README.md").read_text().replace("\\\n", " ")
    lines = re.findall(r"^    (\S.*)$", re.sub(r"```.*?```", "", text, flags=re.S), re.M)
    return [line for line in lines if re.match(r"(\.\./|\./|mpirun|python3|sh |export|cmake|for )", line)]


def commands(folder):
    """every simple command, a list of words"""
    for line in blocks(folder):
        for part in re.split(r"&&|;", " ".join(shlex.split(line, comments=True, posix=False))):
            words = [word for word in shlex.split(part) if word not in ("do", "done")]
            if words and words[0] != "for":
                yield words
    for line in re.findall(r"^        (mpirun .*)$", (folder / "README.md").read_text(), re.M):  # the body of a loop
        yield shlex.split(line.split(";")[0])


def check_variables(folder, words, where):
    scripts = [words[k + 1] for k, word in enumerate(words) if word == "-in"]
    assert len(scripts) == 1 and (folder / scripts[0]).is_file(), where
    names = [words[k + 1] for k, word in enumerate(words) if word == "-var"]
    assert [name for name in names if name not in known(folder / scripts[0])] == [], where


def check(folder, words):
    where = f"{folder.name}/README.md: {shlex.join(words)}"
    assert "&" not in words, f"{where}: a line goes on after \\ in a shell"
    if words[0] == "export":
        for value in (word.partition("=")[2] for word in words[1:]):
            assert all((folder / path.replace("$PWD", str(folder))).is_dir() for path in value.split(":")), where
        return
    if words[0] == "mpirun":
        assert words[1] == "-np" and words[2].isdigit(), where
        words = words[3:]
    if words[0].endswith("lmp"):
        assert (folder / words[0]).resolve() == ROOT / "build" / "lmp", where
        check_variables(folder, words, where)
    elif words[0].endswith("build/hvi"):
        assert os.path.normpath(folder / words[0]) == str(ROOT / "build" / "hvi"), where  # a link
        cli.parse(words[1:])
    elif words[0] in ("python3", "sh"):
        assert (folder / words[1]).is_file(), where
        for word in words[2:]:
            if re.search(r"[./]", word) and not MADE.fullmatch(word):
                assert (folder / word).exists() or list(folder.glob(word)), where
    else:
        pytest.fail(f"{where}: what is {words[0]}?")


@pytest.mark.parametrize("folder", EXAMPLES, ids=lambda path: path.name)
def test_commands(folder):
    found = list(commands(folder))
    assert found
    for words in found:
        check(folder, words)


@pytest.mark.parametrize("folder", EXAMPLES, ids=lambda path: path.name)
def test_variables(folder):
    """every -var of the text, in whatever sentence, is one of an input of the folder, or of the one it runs"""
    text = (folder / "README.md").read_text()
    inputs = [*folder.glob("in.*"), *((folder / "../debris-cloud").glob("in.*") if folder.name == "debris-studies" else ())]
    names = {name for script in inputs for name in known(script)} | {"NAME"}
    assert sorted(set(re.findall(r"-var (\w+)", text)) - names) == []


def prose(folder):
    """a README without its blocks of numbers"""
    return re.sub(r"^<!-- numbers \S+ -->\n.*?^<!-- /numbers -->\n", "", (folder / "README.md").read_text(), flags=re.S | re.M)


def test_short():
    """details belong in tables.md beside it, numbers of runs in doc/records"""
    texts = {folder.name: prose(folder) for folder in EXAMPLES}
    assert not any("numbers -->" in text for text in texts.values())
    assert {name: lines for name, text in texts.items() if (lines := text.count("\n")) > 70} == {}
    words = {name: len(text.split()) for name, text in texts.items()}
    assert sum(words.values()) <= 8000, words


@pytest.mark.parametrize("wrong, name", [("../../build/lmp -in in.nothing", "layered-shock"), ("lmp -in in.layers", "layered-shock"),
                                         ("../../build/lmp -in in.layers -var gaps 1", "layered-shock"), ("../../build/lmp -in in.layers &", "layered-shock"), ("python3 draw.py", "layered-shock"), ("python3 -m hvi measure .", "spall"), ("../build/hvi measure .", "spall"),
                                         ("export LAMMPS_POTENTIALS=$PWD/potentials", "spall")])
def test_a_wrong_one_is_found(wrong, name):
    with pytest.raises(AssertionError):
        check(ROOT / "examples" / name, shlex.split(wrong))


@pytest.mark.parametrize("name", QUICK)
def test_quick_ones_run(lmp_exe, tmp_path, name):
    """in a copy of the folder beside a build, with the program and the Python of these tests"""
    folder = tmp_path / "examples" / name
    shutil.copytree(ROOT / "examples" / name, folder, ignore=shutil.ignore_patterns("result.yaml", "runs"))
    for link, target in (("build/lmp", lmp_exe), ("build/hvi", ROOT / "python/bin/hvi"), ("potentials", ROOT / "potentials"), ("python", ROOT / "python"), ("tests", ROOT / "tests"),
                         ("bin/python3", sys.executable)):
        (tmp_path / link).parent.mkdir(exist_ok=True)
        (tmp_path / link).symlink_to(target)
    lines = blocks(folder)
    first = [line for line in lines if not line.startswith("export")][QUICK[name]]
    script = "set -e\n" + "\n".join(line for line in lines if line.startswith("export")) + f"\n{first}\n"
    plots = [line for line in lines if line.startswith("python3 plot.py .")]
    script += "\n".join(plots)
    environment = {key: value for key, value in os.environ.items() if key not in ("LAMMPS_POTENTIALS", "PYTHONPATH", "HVI_ROOT")}
    done = subprocess.run([ROOT / "cmake" / "env.sh", "bash", "-c", script], cwd=folder, text=True, capture_output=True, timeout=200,
                          env={**environment, "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"})
    assert done.returncode == 0, script + done.stdout[-2000:] + done.stderr[-2000:]
    assert (folder / "result.yaml").is_file() and (not plots or list(folder.glob("*.png")))
