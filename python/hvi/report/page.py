# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""HTML in one file: elements whose texts are escaped by themselves, tables, pictures as data, the style of the page."""

import base64
import hashlib
import html
import io
import re

from .. import tables

STYLE = """
:root { --ink: #1c2329; --soft: #5a6670; --line: #dfe4e8; --back: #f3f5f7; --card: #fff; --accent: #2f62a8; --said: #6b6b6b; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--back); color: var(--ink); font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; overflow-wrap: break-word; }
main { max-width: 1180px; margin: 0 auto; padding: 0 20px 40px; }
header.top { background: #17212b; color: #fff; padding: 26px 20px 30px; border-bottom: 6px solid var(--said); }
header.top > div { max-width: 1140px; margin: 0 auto; display: flex; gap: 14px 28px; align-items: center; flex-wrap: wrap; }
header.top h1 { margin: 0; font-size: 1.7rem; line-height: 1.2; }
header.top p { margin: 4px 0 0; color: #b9c5cf; }
header.top .words { flex: 1 1 320px; min-width: 0; }
.said { background: var(--said); color: #fff; border-radius: 10px; padding: 12px 26px; font-size: 1.9rem; font-weight: 700; letter-spacing: .04em; text-transform: uppercase; white-space: nowrap; }
.holds { --said: #1d7a3f; } .fails { --said: #b3261e; } .undecided { --said: #9a6200; }
nav { margin: 16px 0 0; font-size: .9rem; display: flex; flex-wrap: wrap; gap: 4px 16px; }
a { color: var(--accent); }
section { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 20px 24px 24px; margin-top: 20px; }
h2 { margin: 0 0 10px; font-size: 1.25rem; } h3 { margin: 22px 0 8px; font-size: 1rem; }
.two { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 20px 28px; align-items: start; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(140px, 1fr)); gap: 12px; margin: 18px 0 0; }
.tile { border: 1px solid var(--line); border-radius: 10px; padding: 10px 14px; }
.tile b { display: block; font-size: 1.35rem; font-variant-numeric: tabular-nums; } .tile span { color: var(--soft); font-size: .85rem; }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(330px, 100%), 1fr)); gap: 16px; }
.pair { grid-template-columns: repeat(auto-fill, minmax(min(430px, 100%), 1fr)); } figure.mid img { max-width: 780px; }
figure { margin: 0; break-inside: avoid; } figure img { display: block; width: 100%; height: auto; } figure.tall img { max-height: 560px; object-fit: contain; }
figcaption { color: var(--soft); font-size: .88rem; margin-top: 4px; } figcaption b { color: var(--ink); }
.scroll { overflow-x: auto; max-width: 100%; } .scroll:focus-visible { outline: 2px solid var(--accent); }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; min-width: 50%; }
caption { text-align: left; color: var(--soft); font-size: .88rem; padding-bottom: 6px; }
th, td { padding: 5px 12px 5px 0; text-align: left; border-bottom: 1px solid var(--line); vertical-align: top; } td.n, th.n { text-align: right; }
thead th { white-space: nowrap; border-bottom: 2px solid #b9c3cb; } tbody th { font-weight: 500; } .short tbody th { white-space: nowrap; }
td.path { overflow-wrap: anywhere; }
pre { margin: 8px 0; padding: 12px 14px; background: #f6f8fa; border: 1px solid var(--line); border-radius: 8px; overflow-x: auto; font: .82rem/1.45 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
pre.wrap { white-space: pre-wrap; overflow-wrap: anywhere; }
.word { display: inline-block; border-radius: 6px; padding: 0 8px; white-space: nowrap; color: #fff; background: var(--said); font-weight: 600; }
.key { display: flex; flex-wrap: wrap; gap: 4px 18px; margin: 0 0 12px; padding: 0; list-style: none; font-size: .9rem; } .key i { display: inline-block; width: .9em; height: .9em; border-radius: 50%; margin-right: 6px; vertical-align: -.08em; }
.scene .live { display: none; } .scene.on .live { display: block; } .scene.on .still { display: none; }
.stage { position: relative; } .stage canvas { display: block; width: 100%; aspect-ratio: 16 / 9; border: 1px solid var(--line); border-radius: 8px; touch-action: pan-y; cursor: grab; }
.stage .axes { position: absolute; right: 8px; top: 8px; width: 64px; height: 64px; pointer-events: none; }
.ruler { position: absolute; left: 14px; bottom: 12px; font-size: .85rem; pointer-events: none; } .ruler i { display: block; border-bottom: 3px solid var(--ink); }
.bar { display: flex; flex-wrap: wrap; gap: 8px 16px; align-items: center; margin: 10px 0; font-size: .9rem; } .bar input[type=range] { flex: 1 1 120px; min-width: 0; } .bar output { min-width: 5.5em; font-variant-numeric: tabular-nums; }
.bar button, .bar select { font: inherit; max-width: 100%; }
.key .legend { display: inline-block; position: relative; width: min(320px, 70vw); height: 12px; margin: 0 24px 22px 14px; border-radius: 3px; vertical-align: middle; } .legend b { position: absolute; top: 14px; transform: translateX(-50%); font-weight: 400; font-size: .85rem; }
.note { color: var(--soft); font-size: .92rem; }
ul { padding-left: 1.2em; } li { margin: 3px 0; }
footer { color: var(--soft); font-size: .85rem; margin-top: 22px; }
@media (max-width: 760px) { .stage canvas { aspect-ratio: 1; } main { padding: 0 12px 30px; } section { padding: 16px 14px 18px; } .two { grid-template-columns: minmax(0, 1fr); } .said { font-size: 1.5rem; } header.top h1 { font-size: 1.35rem; } }
@media print {
  @page { size: A4; margin: 14mm; }
  body { background: #fff; font-size: 9.5pt; } main { padding: 0; max-width: none; } nav { display: none; }
  section { border: 0; border-top: 1px solid #999; border-radius: 0; padding: 10px 0; } h2, h3, .key { break-after: avoid; } tr, .tile { break-inside: avoid; }
  .scene .live, .scene.on .live { display: none; } .scene.on .still { display: block; }
  header.top, .said, .word, .key i { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  .tiles { grid-template-columns: repeat(6, 1fr); gap: 6px; } .tile { padding: 6px 8px; } .tile b { font-size: 1.1rem; }
  .scroll, pre { overflow: visible; } pre { font-size: 7.5pt; white-space: pre-wrap; overflow-wrap: anywhere; } table { font-size: 8pt; } th, td { padding-right: 6px; } thead th { white-space: normal; }
  .row { grid-template-columns: repeat(3, minmax(0, 1fr)); } .pair { grid-template-columns: 1fr 1fr; } .two { grid-template-columns: 1fr 1fr; } figure.tall img { max-height: 105mm; }
}
"""
VOID = {"meta", "img", "input"}


class Html(str):
    """text that is HTML already"""


def tag(name, /, *children, **attributes):
    """An element; children that are no Html are escaped, attributes always. class_ stands for class."""
    words = "".join(f' {key.rstrip("_").replace("_", "-")}="{html.escape(str(value), quote=True)}"' for key, value in attributes.items() if value is not None)
    inside = "".join(child if isinstance(child, Html) else html.escape(str(child)) for child in children)
    return Html(f"<{name}{words}>" if name in VOID else f"<{name}{words}>{inside}</{name}>")


def join(parts):
    return Html("".join(part if isinstance(part, Html) else html.escape(str(part)) for part in parts))


def items(texts, **attributes):
    return tag("ul", *(tag("li", text) for text in texts), **attributes)


def table(names, rows, text=None, class_=None):
    """Numbers to the right; where it is too wide it can be scrolled."""
    rows = [list(row) for row in rows]
    right = [all(isinstance(row[k], (int, float)) for row in rows) and bool(rows) for k in range(len(names))]
    head = tag("tr", *(tag("th", name, class_="n" if r else None, scope="col") for name, r in zip(names, right)))
    body = [tag("tr", *(tag("th" if k == 0 else "td", value if isinstance(value, Html) else tables.number(value), class_="n" if right[k] else None,
                            scope="row" if k == 0 else None) for k, value in enumerate(row))) for row in rows]
    caption = [tag("caption", text)] if text else []
    return tag("div", tag("table", *caption, tag("thead", head), tag("tbody", *body), class_=class_), class_="scroll", tabindex="0")


def image(png, alt):
    """A picture within the page; png: bytes of the file"""
    return tag("img", src=f"data:image/png;base64,{base64.b64encode(png).decode()}", alt=alt)


def picture(figure, alt, caption="", dpi=150, class_=None):
    """A figure of matplotlib, within the page"""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi)
    return tag("figure", image(stream.getvalue(), alt), tag("figcaption", caption), class_=class_)


def section(title, *children):
    name = "".join(c if c.isalnum() else "-" for c in title.lower())
    return tag("section", tag("h2", title), *children, id=name)


def checksum(script):
    """of a script, as a policy of content names it"""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def page(title, kind, head, sections, script=""):
    """The whole text of the file; kind: a class of the style, for its color; script: the only one that a browser runs there, by its checksum, if any; nothing is loaded"""
    policy = f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src '{checksum(script) if script else 'none'}'"
    titles = [re.match(r'<section id="([^"]*)"><h2>(.*?)</h2>', part) for part in sections]
    links = [tag("a", Html(found[2]), href=f"#{found[1]}") for found in titles if found]
    return ("<!DOCTYPE html>\n" + tag("html", tag("head", tag("meta", charset="utf-8"), tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
                                                  tag("meta", http_equiv="Content-Security-Policy", content=policy),
                                                  tag("title", title), tag("style", Html(STYLE))),
                                      tag("body", tag("header", tag("div", *head), class_="top"), tag("main", *([tag("nav", *links)] if links else []), *sections), *([tag("script", Html(script))] if script else []), class_=kind), lang="en") + "\n")
