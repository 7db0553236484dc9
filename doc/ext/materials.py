"""Tables of the pages on materials, made by python/hvi/material/library.py, which needs no NumPy.

".. materials::" is the table of all material files of the folder potentials/: what each has, lacks and assumes.
".. sets:: KIND LAW" is the table of the numbers that these files have for a law, in SI, and of what is assumed of them.
".. parameters:: KIND LAW" is the table of a law: its content has a line "key meaning" per key, unit, range and default come from the code.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNITS = {"number": "", "length": "m", "density": "kg/m^3", "speed": "m/s", "pressure": "Pa", "per_pressure": "1/Pa", "specific_energy": "J/kg", "heat_capacity": "J/kg/K",
         "temperature": "K", "per_temperature": "1/K", "rate": "1/s", "impulse": "Pa^lambda s"}
COLUMNS = {"file": 15, "eos": 14, "strength": 12, "damage": 10, "spall": 9, "lacks; assumed": 24, "sources": 16}


def library():
    sys.path.insert(0, str(ROOT / "python"))
    from hvi.material import library

    return library


def rows(folder):
    """a {column: text} per file"""
    return library().everything(folder)


def parameters(kind, law, content):
    """the table of a law as reStructuredText; ValueError if the keys of the content are not those of the law, in its order"""
    meanings = dict(line.split(None, 1) for line in content if line.strip())
    keys = library().LAWS[kind, law]
    if list(meanings) != [key for key, *_ in keys]:
        raise ValueError(f"{kind} {law} has the keys {' '.join(key for key, *_ in keys)}, not {' '.join(meanings)}")
    text = [".. list-table::", "   :header-rows: 1", "   :widths: 14 50 12 12 12", ""]
    cells = [["key", "meaning", "unit (SI)", "range", "default"]]
    for key, quantity, bounds, preset in keys:
        cells.append([f"*{key}*", meanings[key], UNITS[quantity], bounds.replace("in ", "") or "any", "required" if preset is None else f"{preset:g}"])
    for line in cells:
        text += [f"   {'  -' if k else '* -'} {cell}" for k, cell in enumerate(line)]
    return text


def escaped(text):
    """plain text in reStructuredText"""
    return "".join("\\" + c if c in "\\*`_|-" else c for c in text)


def brief(note):
    """what is assumed, without unit and the word itself"""
    return re.sub(r"^([\w/^]+, )?assumed(: |, )", "", note)


def sets(folder, kind, law):
    """the sets of a law as reStructuredText: keys that are given in some file, and what is assumed"""
    section, files = (kind, law), [library().read(path) for path in sorted(folder.glob("*.hvi"))]
    files = [one for one in files if section in one.sections and one.units != "lj"]
    keys = [(key, quantity) for key, quantity, *_ in library().LAWS[section] if any(key in one.notes[section] for one in files)]
    text = [".. list-table::", "   :header-rows: 1", "   :class: materials", ""]
    cells = [["file", *(f"{key} {UNITS[quantity]}".strip() for key, quantity in keys), "assumed"]]
    for one in files:
        assumed = one.assumed().get(section, {})
        cells.append([one.name, *(f"{one.in_si(section)[key]:g}".replace("e+0", "e").replace("e+", "e") for key, _ in keys),
                      "; ".join(f"{', '.join(k for k in assumed if brief(assumed[k]) == note)}: {note}" for note in dict.fromkeys(map(brief, assumed.values()))) or "-"])
    if all(row[-1] == "-" for row in cells[1:]):
        cells = [row[:-1] for row in cells]
    if len(keys) > 8:  # a row per key
        cells = [list(row) for row in zip(*cells)]
    for line in cells:
        text += [f"   {'  -' if k else '* -'} {escaped(cell)}" for k, cell in enumerate(line)]
    return text


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

    class Parameters(Directive):
        required_arguments = 2
        has_content = True

        def run(self):
            self.state.document.settings.env.note_reread()  # the code may have changed
            try:
                text = parameters(*self.arguments, self.content)
            except (KeyError, ValueError) as problem:
                raise self.error(f"parameters: {problem}") from None
            node = nodes.Element()
            self.state.nested_parse(StringList(text, source="library.py"), self.content_offset, node)
            return node.children

    class Sets(Directive):
        required_arguments = 2

        def run(self):
            self.state.document.settings.env.note_reread()
            try:
                text = sets(ROOT / "potentials", *self.arguments)
            except KeyError as problem:
                raise self.error(f"sets: no law {problem}") from None
            node = nodes.Element()
            self.state.nested_parse(StringList(text, source="potentials"), self.content_offset, node)
            return node.children

    app.add_directive("materials", Materials)
    app.add_directive("sets", Sets)
    app.add_directive("parameters", Parameters)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
