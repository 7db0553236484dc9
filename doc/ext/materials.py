"""The directive ".. materials::" is the table of all material files of the folder potentials/: what each has, lacks and assumes.

The files are read by python/hvi/material/library.py, as `python3 -m hvi material` does; neither needs NumPy.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = {"file": 15, "eos": 14, "strength": 12, "damage": 10, "spall": 9, "lacks; assumed": 24, "sources": 16}


def rows(folder):
    """a {column: text} per file"""
    sys.path.insert(0, str(ROOT / "python"))
    from hvi.material import library

    return library.everything(folder)


def escaped(text):
    """plain text in reStructuredText"""
    return "".join("\\" + c if c in "\\*`_|-" else c for c in text)


def lines(folder):
    """the table as reStructuredText"""
    text = [".. list-table::", "   :header-rows: 1", "   :class: materials", f"   :widths: {' '.join(map(str, COLUMNS.values()))}", ""]
    cells = [list(COLUMNS)]
    for row in rows(folder):
        lacks = "" if row["lacks"] == "-" else f"lacks {row['lacks']}. "
        assumed = "" if row["assumed"] == "-" else f"Assumed: {row['assumed']}"
        cells.append([f"{row['file']}: {row['what']}", row["eos"], row["strength"], row["damage"], row["spall"], lacks + assumed or "-", row["sources"]])
    for line in cells:
        text += [f"   {'  -' if k else '* -'} {escaped(cell)}" for k, cell in enumerate(line)]
    return text


def setup(app):
    from docutils.parsers.rst import Directive
    from docutils.statemachine import StringList
    from docutils import nodes

    class Materials(Directive):
        def run(self):
            folder = ROOT / "potentials"
            self.state.document.settings.env.note_reread()  # files may have come or changed
            node = nodes.Element()
            self.state.nested_parse(StringList(lines(folder), source="potentials"), self.content_offset, node)
            return node.children

    app.add_directive("materials", Materials)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
