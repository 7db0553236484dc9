# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Parts of a report that can be written as Markdown, reStructuredText and HTML: headings, texts (str), tables, lists, pictures."""

import csv
import dataclasses
import io
import re

STRONG = {"default", "front", "dominates"}  # marks that are bold

class Bold(str):
    """a text in bold"""


class Number(str):
    """a number as text, to the right in tables"""


class Marks(str):
    """words that mark a row"""

    def __new__(cls, *words):
        made = super().__new__(cls, ", ".join(words))
        made.words = words
        return made


@dataclasses.dataclass
class Heading:
    level: int
    text: str


@dataclasses.dataclass
class Items:
    texts: list


@dataclasses.dataclass
class Picture:
    name: str
    alt: str
    caption: str


@dataclasses.dataclass
class Table:
    names: list
    rows: list
    caption: str = ""

    def numeric(self):
        """for each column: does it hold numbers only, or nothing"""
        columns = list(zip(*self.rows)) or [()] * len(self.names)
        return [any(isinstance(c, Number) for c in column) and all(isinstance(c, Number) or c in ("", "-") for c in column) for column in columns]


def number(x):
    """Three digits, without an exponent where that can be read; - for None"""
    if x is None:
        return Number("-")
    if isinstance(x, int):
        return Number(x)
    if x != 0 and not 1e-3 <= abs(x) < 1e6:
        return Number(re.sub(r"\.?0*e([-+])0*", lambda m: "e-" if m[1] == "-" else "e", f"{x:.2e}"))
    text = f"{x:.3g}"
    return Number(f"{float(text):.0f}" if "e" in text else text)


def escaped(text):
    """for Markdown, in plain ASCII"""
    text = re.sub(r"([\\|*_`\[\]])", r"\\\1", str(text)).replace("<", "&lt;").replace(">", "&gt;")
    return text.encode("ascii", "xmlcharrefreplace").decode()


def cell(value):
    strong = isinstance(value, Bold) or (isinstance(value, Marks) and STRONG & set(value.words))
    return f"**{escaped(value)}**" if strong else escaped(value)


def table_markdown(table):
    lines = [f"*{escaped(table.caption)}*", ""] if table.caption else []
    lines.append("| " + " | ".join(map(escaped, table.names)) + " |")
    lines.append("|" + "|".join("---:" if right else "---" for right in table.numeric()) + "|")
    return lines + ["| " + " | ".join(map(cell, row)) + " |" for row in table.rows]


def markdown(parts):
    """The parts as the text of a Markdown file"""
    lines = []
    for part in parts:
        if isinstance(part, Heading):
            lines += ["#" * part.level + " " + escaped(part.text)]
        elif isinstance(part, Table):
            lines += table_markdown(part)
        elif isinstance(part, Items):
            lines += [f"- {cell(text)}" for text in part.texts]
        elif isinstance(part, Picture):
            lines += [f"![{escaped(part.alt)}]({part.name})", "", f"*{escaped(part.caption)}*"]
        else:
            lines += [cell(part)]
        lines.append("")
    return "\n".join(lines).rstrip("\n") + "\n"


def rst(parts):
    """Texts and tables as reStructuredText, tables as csv-table"""
    lines = []
    for part in parts:
        if isinstance(part, Table):
            lines += [f".. csv-table:: {safe(part.caption)}".rstrip(), "   :header-rows: 1", ""]
            text = io.StringIO()
            csv.writer(text, lineterminator="\n").writerows([safe(c) for c in row] for row in (part.names, *part.rows))
            lines += ["   " + line for line in text.getvalue().splitlines()]
        else:
            lines += [safe(part)]
        lines.append("")
    return "\n".join(lines).rstrip("\n") + "\n"


def safe(text):
    """for reStructuredText; a - alone would begin a list there"""
    text = re.sub(r"([\\*`|_])", r"\\\1", str(text)).encode("ascii", "backslashreplace").decode()
    return re.sub(r"^([-+.])", r"\\\1", text)
