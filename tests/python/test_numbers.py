"""doc/numbers.py: tables of pages are those of doc/records; what is wrong is found; a row is run again."""

import importlib.util
import json
import subprocess
import sys

import pytest
from conftest import ROOT

spec = importlib.util.spec_from_file_location("numbers_of_pages", ROOT / "doc" / "numbers.py")
numbers = importlib.util.module_from_spec(spec)
spec.loader.exec_module(numbers)

HEAD = '{"title": "holes", "depends": ["src", "in/*.txt"], "columns": ["dx mm", "what", "hole mm"]}\n'
ROW = ('{"command": "cd case && sh run.sh", "commit": "%s", "machine": "2 cores", "load": "%s", "row": {"dx mm": 0.50, "what": "a|b *c", "hole mm": 18.90},'
       ' "keys": {"hole mm": "result.yaml:holes.1 * 1e3"}}\n')
PAGES = {"page.md": "# Title\n\n<!-- numbers holes -->\n<!-- /numbers -->\n\nend\n", "doc/page.rst": "Title\n=====\n\n.. numbers speeds\n\n.. /numbers\n\nend\n"}


@pytest.fixture
def tree(tmp_path):
    """a repository with two records, two pages and a run"""
    for name, text in {**PAGES, "doc/records/holes.jsonl": HEAD + ROW % ("abc1234", "idle"), "case/run.sh": "python3 -c 'import yaml; print(yaml.dump(dict(holes=[1, 0.0192345])))' > result.yaml; ls ../potentials ../build\n",
                       "doc/records/speeds.jsonl": HEAD + ROW % ("abc1234", "idle") + ROW.replace(', "hole mm": 18.90', "").replace(' "keys": {"hole mm"', ' "keys": {"dx mm"') % ("def5678", "busy"),
                       "potentials/x": "", "build/lmp": "", "src/a.cpp": "1\n", "in/b.txt": "1\n", "other": "1\n"}.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def call(tree, *words):
    return numbers.main(list(words), tree)


def edit(path, old, new, count=1):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, count))


def test_pages_are_those_of_the_records(capsys):
    """python3 doc/numbers.py"""
    assert numbers.main(["--check"]) == 0, capsys.readouterr().err


def test_records_are_ascii_and_depend_on_files_that_are_there():
    found, wrong = numbers.records(ROOT)
    assert wrong == []
    lost = [f"{name}: {path}" for name, record in found.items() for path in record.head["depends"] if not list(ROOT.glob(path))]
    assert lost == []


def test_rows_that_were_run_say_their_commit():
    """of a run whose commit was not noted: up to the one that brought its numbers"""
    without = [f"{name} row {k}" for name, record in numbers.records(ROOT)[0].items() for k, row in enumerate(record.rows, 1) if row["command"] and not row["commit"]]
    assert without == []


def test_filled_in_both_languages(tree):
    assert call(tree) == 0
    assert (tree / "page.md").read_text() == (
        "# Title\n\n<!-- numbers holes -->\n\n| dx mm | what | hole mm |\n| --- | --- | --- |\n| 0.50 | a\\|b *c | 18.90 |\n\n"
        "Commit abc1234, 2 cores, idle: `cd case && sh run.sh`\n\n<!-- /numbers -->\n\nend\n")
    page = (tree / "doc/page.rst").read_text()
    for said in ("* - dx mm\n     - what\n     - hole mm\n     - commit\n     - load\n", "* - 0.50\n     - a\\|b \\*c\n     - 18.90\n     - abc1234\n     - idle\n",
                 "     - \\-\n     - def5678\n     - busy\n\n2 cores: ``cd case && sh run.sh``\n\n.. /numbers\n\nend\n"):
        assert said in page
    docutils = pytest.importorskip("docutils.core")
    html = docutils.publish_string(page, writer_name="html", settings_overrides={"report_level": 1, "halt_level": 1}).decode()
    assert "<td>a|b *c</td>" in html and html.count("<td>") + html.count("<th class") == 15


def test_idempotent_and_ascii(tree):
    assert call(tree) == 0
    before = {path: path.read_bytes() for path in tree.rglob("page.*")}
    assert call(tree) == 0 and call(tree, "--check") == 0
    assert before == {path: path.read_bytes() for path in tree.rglob("page.*")} and all(text.isascii() for text in before.values())


def again(tree):
    (tree / "other.md").write_text((tree / "page.md").read_text())


@pytest.mark.parametrize("change, message", [
    (lambda tree: edit(tree / "page.md", "18.90", "18.91"), "page.md: block holes is not that of its record"),
    (lambda tree: edit(tree / "page.md", "18.90 |", "18.9 |"), "page.md: block holes is not that of its record"),
    (lambda tree: edit(tree / "doc/page.rst", "18.90", "18.91"), "doc/page.rst: block speeds is not that of its record"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", "18.90", "18.91"), "page.md: block holes is not that of its record"),
    (lambda tree: (tree / "doc/records/holes.jsonl").unlink(), "page.md: block holes has no record doc/records/holes.jsonl"),
    (again, "page.md: block holes is used twice, first in other.md"),
    (lambda tree: (tree / "page.md").write_text("nothing\n"), "doc/records/holes.jsonl: no page has a block of it"),
    (lambda tree: edit(tree / "page.md", "<!-- /numbers -->", ""), "page.md: block holes has no end"),
    (lambda tree: edit(tree / "page.md", "<!-- numbers holes -->", ""), "page.md line 11: an end without a beginning"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", "idle", "quiet"), "holes.jsonl line 2: load must be idle, busy or empty, not 'quiet'"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", "abc1234", "before abc1234"), "holes.jsonl line 2: commit must be as abc1234, abc1234-dirty, up to abc1234 or empty, not 'before abc1234'"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", '"hole mm": 18.90', '"hole": 18.90'), "holes.jsonl line 2: no column 'hole'"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", '"title"', '"titel"'), "holes.jsonl: line 1 must have title, depends and columns"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", "18.90}", "18.90"), "holes.jsonl line 2:"),
    (lambda tree: edit(tree / "doc/records/holes.jsonl", "2 cores", "\u00b5"), "holes.jsonl: not ASCII"),
])
def test_what_is_wrong_is_found(tree, change, message, capsys):
    assert call(tree) == 0
    change(tree)
    assert call(tree, "--check") == 1
    assert message in capsys.readouterr().err


def test_program_ends_with_1(tree):
    done = subprocess.run([sys.executable, ROOT / "doc" / "numbers.py", "--run", "no-such"], capture_output=True, text=True)
    assert done.returncode == 1 and "no record doc/records/no-such.jsonl" in done.stderr


@pytest.fixture
def commits(tree):
    """three commits: all; what is no dependence; a file of a glob"""
    def git(*words):
        return subprocess.run(["git", "-C", str(tree), "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True, capture_output=True, text=True).stdout.strip()
    git("init", "-q")
    found = []
    for name in ("src/a.cpp", "other", "in/b.txt"):
        (tree / name).write_text(name)
        git("add", "-A")
        git("commit", "-qm", name)
        found.append(git("rev-parse", "--short=7", "HEAD"))
    return found


def test_stale(tree, commits, capsys):
    edit(tree / "doc/records/speeds.jsonl", "abc1234", commits[1])
    edit(tree / "doc/records/speeds.jsonl", "def5678", "")
    edit(tree / "doc/records/holes.jsonl", "abc1234", commits[2])
    assert call(tree, "--stale") == 0
    assert capsys.readouterr().out == f"speeds: 1 commit of what it depends on since {commits[1]}; no commit is said\n"
    edit(tree / "doc/records/holes.jsonl", commits[2], "abc1234")
    assert call(tree, "--stale") == 0 and "holes: commit abc1234 is unknown here\n" in capsys.readouterr().out
    edit(tree / "doc/records/holes.jsonl", "abc1234", f"up to {commits[0]}")
    assert call(tree, "--stale") == 0 and f"holes: 1 commit of what it depends on since {commits[0]}\n" in capsys.readouterr().out
    edit(tree / "doc/records/holes.jsonl", commits[0], commits[2])
    assert call(tree, "--stale") == 0 and "holes" not in capsys.readouterr().out


def test_a_row_of_others_has_no_commit(tree, commits, capsys):
    """it makes no column of commits, and is not old"""
    row = ROW % (commits[2], "idle")
    (tree / "doc/records/holes.jsonl").write_text(HEAD + '{"command": "", "commit": "", "machine": "", "load": "", "row": {"what": "measured", "hole mm": 19.1}}\n' + row.replace("cd case && sh run.sh", ""))
    assert call(tree) == 0 and f"| - | measured | 19.1 |\n| 0.50 | a\\|b *c | 18.90 |\n\nCommit {commits[2]}, 2 cores, idle\n" in (tree / "page.md").read_text()
    assert call(tree, "--stale") == 0 and "holes" not in capsys.readouterr().out


def test_run_again(tree, commits, capsys):
    """in a copy of the folder; only what its keys name, in the digits of before, and the commit, machine and load of now"""
    assert call(tree) == 0 and call(tree, "--run", "holes", "--build", str(tree / "build")) == 0
    assert not (tree / "case/result.yaml").exists()
    row = json.loads((tree / "doc/records/holes.jsonl").read_text().splitlines()[1])
    assert row["row"] == {"dx mm": 0.5, "what": "a|b *c", "hole mm": 19.23} and row["commit"] == commits[2] and row["load"] in ("idle", "busy") and " cores of a" in row["machine"]
    text = (tree / "page.md").read_text()
    assert "| 0.50 | a\\|b *c | 19.23 |" in text and f"Commit {commits[2]}, " in text
    with (tree / "doc/records/holes.jsonl").open("a") as record:  # of others: not run
        record.write('{"command": "", "commit": "", "machine": "", "load": "", "row": {"what": "measured", "hole mm": 19.1}}\n')
    assert call(tree, "--run", "holes", "--build", str(tree / "build")) == 0 and "| measured | 19.1 |" in (tree / "page.md").read_text()
    (tree / "src/a.cpp").write_text("changed")
    assert call(tree, "--run", "holes", "1") == 0 and f"Commit {commits[2]}-dirty, " in (tree / "page.md").read_text()


def test_a_command_of_two_records_runs_once(tree, commits, capsys):
    edit(tree / "case/run.sh", "", f"date >>{tree / 'times'}\n", 1)
    (tree / "doc/records/widths.jsonl").write_text((tree / "doc/records/holes.jsonl").read_text().replace("18.90", "17.90"))
    edit(tree / "page.md", "end", "<!-- numbers widths -->\n<!-- /numbers -->\n\nend")
    assert call(tree, "--run", "holes", "widths", "--build", str(tree / "build")) == 0
    assert len((tree / "times").read_text().splitlines()) == 1
    assert all(json.loads((tree / f"doc/records/{name}.jsonl").read_text().splitlines()[1])["row"]["hole mm"] == 19.23 for name in ("holes", "widths"))


@pytest.mark.parametrize("old, new, words, message", [
    ("holes.1", "holes.7", ["holes"], "hole mm: nothing at result.yaml:holes.7 * 1e3"), ("sh run.sh", "sh no.sh", ["holes"], "sh no.sh ended with 2:"),
    ("cd case && ", "", ["holes"], "the row says no folder"), ("cd case", "cd ../case", ["holes"], "folder ../case: must be in the repository"),
    (', "keys": {"hole mm": "result.yaml:holes.1 * 1e3"}', "", ["holes"], "row 1 does not say where its numbers are found"),
    ("18", "18", ["holes", "2"], "no row 2; there are 1"), ("18", "18", ["hole"], "no record doc/records/hole.jsonl"), ("18", "18", ["holes", "a"], "no record doc/records/a.jsonl"), ("18", "18", ["holes", "holes", "1"], "no record doc/records/1.jsonl")])
def test_run_refused(tree, old, new, words, message, capsys):
    edit(tree / "doc/records/holes.jsonl", old, new)
    assert call(tree, "--run", *words, "--build", str(tree / "build")) == 1
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("old, new, want", [("18.90", 19.2345, "19.23"), ("0.10", 0.1034, "0.10"), ("1e-07", 2.34e-6, "2e-06"), ("1500", 1482.6, "1483"), ("9.5", 123.4, "123"),
                                            ("3.10", 2.0, "2.00"), ("-2.0e-07", 1.23e-7, "1.2e-07")])
def test_digits(old, new, want):
    assert numbers.like(numbers.Digits(old), new) == want


@pytest.mark.parametrize("value, want", [("-0.000", "0.000"), ("-0e+00", "0e+00"), ("-0.001", "-0.001"), ("-0.5", "-0.5"), ("0.02, -0.00, -0.10", "0.02, 0.00, -0.10"), ("5-0", "5-0"), (True, "yes"), (None, "-")])
def test_cells(value, want):
    """no zero has a sign"""
    assert numbers.plain(value) == want


RAN = {"core_s": 1.0, "wall_s": 2.0, "said": "case a: 1.5 of 7\ncase b: 2.5 of 8\n"}


@pytest.mark.parametrize("where, want", [
    ("t.csv:1.b", 4.5), ("t.csv:[a=1].b", 2.0), ("t.csv:[a=3,b=4.5].a", 3.0), ("t.yaml:rows.[of=x.y].value * 1e2", 250.0), ("t.yaml:rows.0.of", "x.y"), ("run:core_s", 1.0), ("run:wall_s * 1e3", 2000.0),
    (r"said:case b: (\S+)", 2.5), (r"said:^case a.*of (\d+)$ * -1", -8.0), (["{:.2f} / {}", "t.csv:0.b", "t.yaml:rows.0.of"], "2.00 / x.y")])
def test_number_of_a_table_of_the_run_and_of_what_it_said(tmp_path, where, want):
    (tmp_path / "t.csv").write_text("a,b\n1,2\n3,4.5\n")
    (tmp_path / "t.yaml").write_text("rows: [{of: x.y, value: 2.5}, {of: z, value: 1}]\n")
    assert numbers.number_at(tmp_path, where, RAN) == want


@pytest.mark.parametrize("where", ["t.csv:[b=2].a", "t.csv:[a=5].b", "said:case c: (.)", ["{:.2f}", "t.csv:0.c"], ["{:.1f}", "said:(case)"]])
def test_what_is_not_there_or_there_twice(tmp_path, where):
    (tmp_path / "t.csv").write_text("a,b,c\n1,2,x\n3,2,y\n")
    with pytest.raises((KeyError, IndexError, TypeError, ValueError)):
        numbers.number_at(tmp_path, where, RAN)
