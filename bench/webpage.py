# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The report as one HTML file, with its figures in it: nothing is loaded from elsewhere. Built of the parts of python3 -m hvi report."""

import base64
import re

import blocks
import pareto  # noqa: F401, where hvi is
from hvi.report import page
from hvi.report.page import Html, tag

WORDS = {"front": "holds", "default": "accent", "dominates": "holds", "dominated": "fails", "fails": "fails",
         "ledger open": "fails", "trade": "undecided"}
# a space within "3 s", "2 %", "x 0.5", ", n 400" is no place for a new line
KEEP = re.compile(r"\d (?=[s%](?!\w))|\bx (?=\d)|(?<=, )\w+ (?=[-\d.]+(?:[,:]|$))")
# dark where the reader's system is; figures stay on white
STYLE = """
.word { font-size: .85em; padding: 0 7px; } .word + .word { margin-left: 4px; } .word.accent { --said: #2f62a8; } .word.soft { --said: #6b6b6b; }
figure img { max-width: 840px; background: #fff; border-radius: 8px; }
table { font-size: .86rem; } tbody tr.front { background: color-mix(in srgb, var(--accent) 9%, transparent); } th, td { padding-left: 6px; }
td.n { white-space: nowrap; } thead th { white-space: normal; vertical-align: bottom; } td:not(.n) { min-width: 5.5em; }
main { max-width: 1440px; } header.top > div { max-width: 1400px; } .scroll { margin: 10px 0 14px; } nav { font-size: .85rem; }
@media (prefers-color-scheme: dark) and (not print) {
  :root { --ink: #dfe5ea; --soft: #9aa7b2; --line: #333d46; --back: #12171c; --card: #1b2229; --accent: #86b0ea; }
  pre { background: #151b21; } thead th { border-bottom-color: #4a5661; }
}
"""


def inline(cell):
    """a cell or a text of the report"""
    text = str(cell).replace("+-", "\u00b1")
    text = KEEP.sub(lambda m: m[0][:-1] + "\u00a0", text)
    if isinstance(cell, blocks.Marks):
        return page.join([tag("span", word, class_=f"word {WORDS.get(word, 'soft')}") for word in cell.words])
    if isinstance(cell, blocks.Bold):
        return tag("b", text)
    return Html(tag("span", text)) if isinstance(cell, blocks.Number) else text


def table(block):
    """page.table, with its columns to the right by what the report says they are"""
    right = block.numeric()
    names = [name.replace("core-s", "core\u2011s") for name in block.names]
    head = tag("tr", *(tag("th", name, scope="col", class_="n" if r else None) for name, r in zip(names, right)))
    rows = [tag("tr", *(tag("td", inline(cell), class_="n" if r else None) for cell, r in zip(row, right)),
                class_="front" if any(isinstance(cell, blocks.Marks) and "front" in cell.words for cell in row) else None) for row in block.rows]
    caption = [tag("caption", block.caption)] if block.caption else []
    return tag("div", tag("table", *caption, tag("thead", head), tag("tbody", *rows)), class_="scroll", tabindex="0")


def body(parts, pictures):
    for block in parts:
        if isinstance(block, blocks.Heading):
            yield tag(f"h{block.level}", block.text)
        elif isinstance(block, blocks.Table):
            yield table(block)
        elif isinstance(block, blocks.Items):
            yield page.items([inline(text) for text in block.texts])
        elif isinstance(block, blocks.Picture):
            data = base64.b64encode(pictures[block.name]).decode()
            yield tag("figure", tag("img", src=f"data:image/png;base64,{data}", alt=block.alt), tag("figcaption", block.caption))
        else:
            yield tag("p", inline(block))


def of_document(title, subtitle, tiles, sections, pictures, footer):
    """The text of the page. sections: {title: blocks}; tiles: [(number, what it counts)]; pictures: {name: PNG}"""
    head = [tag("div", tag("h1", title), tag("p", subtitle), class_="words")]
    made = [page.section(name, *body(parts, pictures)) for name, parts in sections.items()]
    counts = tag("div", *(tag("div", tag("b", number), tag("span", text), class_="tile") for number, text in tiles), class_="tiles")
    text = page.page(title, "report", head, [counts, *made, tag("footer", footer)])
    return re.sub("</style>", lambda _: STYLE + "</style>", text, count=1)
