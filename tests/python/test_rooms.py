"""The rooms of python/hvi import only those below them, modules go in no circle, and heavy libraries wait until they are asked for."""

import ast
import importlib
import os
import subprocess
import sys

import hvi
import pytest
from graphs import circles
from hvi import cli

GROUND = "errors places progress tables texts units version"  # modules beside the rooms that all of them may import
BELOW = {"io": "", "material": "", "analysis": "io", "model": "io", "jobs": "material", "shield": "io material model jobs", "figures": "io material analysis shield",
         "report": "io material analysis jobs shield figures", "commands": "io material analysis model jobs shield figures report"}
HEAVY = "MDAnalysis PIL matplotlib meshio numpy pandas scipy tqdm yaml".split()


def graph(folder):
    """{module: {module of hvi that it imports, wherever in it}}, io/dump as io.dump, a room as its __init__"""
    names = {str(path.relative_to(folder).with_suffix("")).replace("/", ".").removesuffix(".__init__"): path for path in sorted(folder.rglob("*.py"))}
    edges = {}
    for name, path in names.items():
        edges[name], here = set(), ["hvi", *path.relative_to(folder).parts[:-1]]
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.level:
                package = [*here[:len(here) + 1 - node.level], *(node.module or "").split(".")]
                found = ".".join(filter(None, package[1:]))
                several = [".".join(filter(None, (found, alias.name))) for alias in node.names]
                edges[name] |= {one if one in names else found for one in several}
            elif isinstance(node, (ast.Import, ast.ImportFrom)):
                assert not any((getattr(node, "module", None) or alias.name).split(".")[0] == "hvi" for alias in node.names), f"{path}: imports of hvi are relative"
    return edges


def room_of(module):
    return module.partition(".")[0] if module.partition(".")[0] in BELOW else ""


def wrong(edges):
    """imports of a room that is not below"""
    def may(there, here):
        return there in GROUND.split() if room_of(there) == "" else room_of(there) in (room_of(here), *BELOW.get(room_of(here), "").split())
    return [f"{here} imports {there}" for here in edges for there in sorted(edges[here]) if not may(there, here) and (here, there) != ("__main__", "cli")]


def test_rooms_import_those_below(root):
    folder = root / "python" / "hvi"
    assert {path.parent.name for path in folder.glob("*/__init__.py")} == set(BELOW)
    known = set()
    for room, below in BELOW.items():  # the table itself goes one way
        assert set(below.split()) <= known
        known.add(room)
    assert wrong(graph(folder)) == []


def test_no_circle_of_modules(root):
    edges = graph(root / "python" / "hvi")
    assert len(edges) > 70 and "io.dump" in edges["io.bonds"]
    assert circles({here: dict.fromkeys(there) for here, there in edges.items()}) == []


@pytest.mark.parametrize("text, found", [("from ..errors import HVIError", ""), ("from ..io.dump import Dump", ""), ("def f():\n    from ..report import page", "analysis.new imports report.page"),
                                         ("from .. import cli, tables", "analysis.new imports cli"), ("from . import cloud", ""), ("from ..model import bodies as b", "analysis.new imports model.bodies")])
def test_a_wrong_import_is_found(tmp_path, text, found):
    for name in ("errors", "tables", "cli", "io/dump", "model/bodies", "report/page", "analysis/cloud", "analysis/new"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / f"{name}.py").write_text(text if name == "analysis/new" else "")
    assert wrong(graph(tmp_path)) == [found] * bool(found)


def test_what_hvi_gives_out():
    """is where its table says, and documented names are in it"""
    given = {name: getattr(hvi, name) for name in hvi.__all__}
    assert {"Dump", "Frame", "HVIError", "HVIWarning", "open", "find", "fit", "measure", "cumulative", "figures", "hole", "maps", "debris", "cloud", "fragments", "universe"} <= set(given)
    assert given["open"] is given["universe"].open_universe and given["measure"] is given["cloud"].measure and set(given) <= set(dir(hvi))
    assert "open" in dir(hvi) and all(name in hvi.__all__ or name.startswith("__") for name in dir(hvi))
    with pytest.raises(AttributeError, match="no attribute nothing"):
        hvi.nothing


def test_commands_are_modules(root):
    """each with its options, examples and main(); the others of the room are what they share"""
    modules = {path.stem for path in (root / "python/hvi/commands").glob("*.py")} - {"__init__"}
    assert set(cli.COMMANDS) <= modules and modules - set(cli.COMMANDS) == {"dumps", "filling", "notebook", "running", "shared"}
    for name in cli.COMMANDS:
        module = importlib.import_module(f"hvi.commands.{name}")
        assert module.EXAMPLES.startswith(f"  python3 -m hvi {name} ") and callable(module.main) and callable(module.add_arguments)


def loaded(root, code):
    """heavy libraries that are there after this code"""
    code += f"\nimport sys; print(*(name for name in {HEAVY} if name in sys.modules))"
    return set(subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, check=True, env={**os.environ, "PYTHONPATH": str(root / "python")}).stdout.splitlines()[-1].split())


def test_heavy_libraries_wait(root):
    """for --help nothing is there, for the options of a command what it reads cases and dumps with"""
    assert loaded(root, "import hvi, hvi.cli; hvi.cli.options()") == set()
    each = f"""import os, sys
from hvi import cli
for name in {list(cli.COMMANDS)}:
    if os.fork() == 0:  # in a process of its own, and one start of Python for all
        cli.options(name)
        print(name, *(heavy for heavy in {HEAVY} if heavy in sys.modules), flush=True)
        os._exit(0)
    assert os.wait()[1] == 0, name
"""
    done = subprocess.run([sys.executable, "-c", each], text=True, capture_output=True, check=True, env={**os.environ, "PYTHONPATH": str(root / "python")})
    found = {name: set(heavy) for name, *heavy in map(str.split, done.stdout.splitlines())}
    assert set(found) == set(cli.COMMANDS)
    assert {name: heavy for name, heavy in found.items() if not heavy <= {"numpy", "yaml"}} == {}
