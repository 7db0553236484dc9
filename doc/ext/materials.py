"""The directive ".. materials::" is the table of all material files of the folder potentials/: what each has, lacks and assumes.

The files are read by python/hvi/material.py, as `python3 -m hvi material` does, without the rest of that package, which needs NumPy.
"""

import importlib
import pathlib
import sys
import types

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = {"file": 14, "eos": 17, "strength": 11, "damage": 10, "spall": 10, "lacks": 18, "assumed": 20}
TITLES = {"lacks": "lacks: why", "assumed": "assumed", "eos": "eos, in units of the file"}


def rows(folder):
    """a {column: text} per file"""
    if "hvi" not in sys.modules:
        package = sys.modules["hvi"] = types.ModuleType("hvi")
        package.__path__ = [str(ROOT / "python" / "hvi")]
    return importlib.import_module("hvi.material").everything(folder)


def escaped(text):
    """plain text in reStructuredText"""
    return "".join("\\" + c if c in "\\*`_|" else c for c in text)


def lines(folder):
    """the table as reStructuredText"""
    text = [".. list-table::", "   :header-rows: 1", "   :class: materials", f"   :widths: {' '.join(map(str, COLUMNS.values()))}", ""]
    for row in [{name: TITLES.get(name, name) for name in COLUMNS}, *rows(folder)]:
        for k, name in enumerate(COLUMNS):
            value = row[name] + (f". {row['what']}" if name == "file" and "what" in row else "")
            text.append(f"   {'* -' if k == 0 else '  -'} {escaped(value)}")
    return text


def setup(app):
    from docutils.parsers.rst import Directive
    from docutils.statemachine import StringList
    from docutils import nodes

    class Materials(Directive):
        def run(self):
            folder = ROOT / "potentials"
            for path in folder.glob("*.hvi"):
                self.state.document.settings.env.note_dependency(str(path))
            node = nodes.Element()
            self.state.nested_parse(StringList(lines(folder), source="potentials"), self.content_offset, node)
            return node.children

    app.add_directive("materials", Materials)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
