"""No circle of includes among the units of lib/hvi and src/USER-HVI, so that each can be understood, and used, with only what is below it; and the
rooms of lib/hvi include those before them only, without LAMMPS. No test imports a test.

A unit is a header with its .cpp files: those whose name is that of the header or begins with it and an underscore (the longest such
header), else those that include it before any other header of the package. What a unit includes is what all its files include.
"""

import ast
import collections
import re

import pytest
from graphs import circles


def includes(path, headers):
    """headers of the folder that a file includes, without .h, in their order"""
    names = re.findall(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)\.h"', path.read_text(), re.M)
    return [n for n in names if n in headers]


def unit(path, headers):
    name = path.stem
    own = [h for h in headers if (name + "_").startswith(h + "_")]
    if own:
        return max(own, key=len)
    return next(iter(includes(path, headers)), name)


def graph(folder):
    """{unit: {unit it includes: the files that do}}"""
    headers = {p.stem for p in folder.rglob("*.h")}
    edges = collections.defaultdict(lambda: collections.defaultdict(list))
    for path in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
        here = unit(path, headers)
        for there in includes(path, headers):
            if there != here:
                edges[here][there].append(path.name)
    return {a: dict(b) for a, b in edges.items()}


def story(way, edges):
    steps = [f"{a} includes {b} in {', '.join(dict.fromkeys(edges[a][b]))}" for a, b in zip(way, way[1:])]
    return " -> ".join(way) + "\n    " + "\n    ".join(steps)


def test_no_circle_of_includes(root):
    edges = {**graph(root / "lib" / "hvi"), **graph(root / "src" / "USER-HVI")}
    assert len(edges) > 40
    found = circles(edges)
    assert not found, f"{len(found)} circles of includes:\n" + "\n".join(story(way, edges) for way in found)


BELOW = {"math": "", "space": "math", "material": "math space", "sph": "math space material", "elements": "math space material", "measure": "space", "dem": ""}


def test_rooms_include_those_below(root):
    lib = root / "lib" / "hvi"
    assert {p.name for p in lib.iterdir()} == set(BELOW)
    room = {p.name: p.parent.name for p in lib.rglob("*.h")}
    wrong = []
    for path in sorted([*lib.rglob("*.h"), *lib.rglob("*.cpp")]):
        for name in re.findall(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', path.read_text(), re.M):
            if room.get(name) not in (path.parent.name, *BELOW[path.parent.name].split()):
                wrong.append(f"{path.parent.name}/{path.name} includes {name}")
    assert not wrong


@pytest.mark.parametrize("files, want", [
    ({"a.h": "b", "b.h": "c", "c.h": "", "a.cpp": "a c", "c.cpp": "c"}, []),  # a diamond is no circle
    ({"a.h": "", "a.cpp": "a b", "b.h": "", "b.cpp": "b a"}, ["a b a"]),  # in the .cpp files only
    ({"a.h": "", "a_more.cpp": "b a", "b.h": "a"}, ["a b a"]),  # of a further file, in whatever order it includes
    ({"a.h": "", "a_b.h": "a", "a_b_more.cpp": "a a_b"}, []),  # which belongs to the longest name
    ({"a.h": "", "x.cpp": "a b", "b.h": "a"}, ["a b a"]),  # of a file of another name: it is that of its first header
    ({"a.h": "b", "b.h": "c", "c.h": "a", "d.h": "a"}, ["a b c a"]),
    ({"a.h": "b", "b.h": "a", "c.h": "d", "d.h": "c", "a.cpp": "a c"}, ["a b a", "c d c"]),
    ({"a.h": "a", "b.h": "missing"}, []),
])
def test_circles_are_found(tmp_path, files, want):
    for name, text in files.items():
        (tmp_path / name).write_text('#include "pair.h"\n#include <vector>\n' + "".join(f'#include "{n}.h"\n' for n in text.split()))
    edges = graph(tmp_path)
    assert [" ".join(way) for way in circles(edges)] == want
    for way in circles(edges):
        assert all(step in story(way, edges) for step in way)


def test_no_test_imports_a_test(root):
    """nor does what they share; no module has the name of another, and in the root of tests there is only conftest.py"""
    files = sorted((root / "tests").rglob("*.py"))
    wrong = {f"{path.parent.name}/{path.name} imports {name}" for path in files for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, (ast.Import, ast.ImportFrom))
             for name in [getattr(node, "module", None) or "", *(alias.name for alias in node.names)] if any(part.startswith("test_") for part in name.split("."))}
    assert not wrong
    assert [name for name, n in collections.Counter(path.stem for path in files).items() if n > 1] == []
    assert [path.name for path in files if path.parent.name == "tests"] == ["conftest.py"]
