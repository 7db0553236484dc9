"""Links of READMEs and pages lead to files, pages, sections and labels that are there; so do paths in their text."""

import re

import pytest
from conftest import ROOT

SOURCES = ROOT / "doc" / "src"
READMES = [p for p in sorted(ROOT.rglob("*.md")) if not any(part.startswith((".", "build", "runs")) for part in p.relative_to(ROOT).parts)]
PAGES = sorted(SOURCES.glob("*.rst"))
FOLDERS = "bench|cmake|doc|examples|lib|potentials|python|src|tests"
MADE = re.compile(r"examples/\S+/(runs|result\.yaml|log\.lammps)|NAME")  # by a run; a name that stands for others


def anchors(text):
    """as GitHub makes them of headings"""
    heads = re.findall(r"^#+ (.+)$", re.sub(r"```.*?```", "", text, flags=re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", head)).strip().lower().replace(" ", "-") for head in heads}


def sections(text):
    """titles of a page in reStructuredText"""
    return {title.strip() for title, line in re.findall(r"^(\S.*)\n([=\"~^'-]{3,})$", text, re.M) if len(line) >= len(title.rstrip())}


def named(page):
    """what a page can be quoted for: its sections, and paragraphs that begin in bold"""
    text = (SOURCES / f"{page}.rst").read_text()
    return sections(text) | {bold.rstrip(".:") for bold in re.findall(r"\*\*([^*\n]+)\*\*", text)}


def lost_in_markdown(path, text):
    for shown, link in re.findall(r"\[([^]]*)\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", text, flags=re.S)):
        file, _, anchor = link.partition("#")
        if "://" in link:
            continue
        target = path.parent / file if file else path
        if not target.exists():
            yield f"[{shown}]({link}): no such file"
        elif anchor and anchor not in anchors(target.read_text()):
            yield f"[{shown}]({link}): no such heading"


def lost_in_page(text, labels):
    for word in re.findall(r":doc:`(?:[^`<]*<)?/?(\w+)>?`", text):
        if not (SOURCES / f"{word}.rst").is_file():
            yield f":doc:`{word}`: no such page"
    for word in re.findall(r":ref:`(?:[^`<]*<)?([\w-]+)>?`", text):
        if word not in labels:
            yield f":ref:`{word}`: no such label"
    targets = sections(text) | set(re.findall(r"^\.\. _([^:\n]+):", text, re.M))
    for word in re.findall(r"(?<![:`\w])`([^`<>\n]+)`_(?!\w)", re.sub(r"``[^`]*``", "", text)):
        if word not in targets:
            yield f"`{word}`_: no such section"
    for path in re.findall(r"(?:literalinclude|include|image|figure):: (\S+)", text):
        if not (SOURCES / path).is_file():
            yield f"{path}: no such file"


def lost_sections(text):
    """:doc:`Page`, "Section"; [Page](../Page.rst), "Section"; and plain Page, "Section" """
    page = r"(?::doc:`(?:[^`<]*<)?(?P<doc>\w+)>?`|\b(?P<plain>Howto_\w+|(?:pair|bond|fix|compute)_hvi_\w+)(?:\]\([^)]*\))?)"
    for found in re.finditer(page + r", \"(?P<title>[^\"]+)\"", text):
        name, title = found["doc"] or found["plain"], found["title"]
        if (SOURCES / f"{name}.rst").is_file() and title not in named(name):
            yield f"{name}, \"{title}\": no such section"


def lost_paths(text):
    for path in re.findall(rf"`((?:{FOLDERS})/[\w./*-]*[\w*])/?`", text):
        if not MADE.search(path) and not list(ROOT.glob(path)):
            yield f"{path}: no such file or folder"


@pytest.fixture(scope="module")
def labels():
    return {label for page in PAGES for label in re.findall(r"^\.\. _([\w-]+):", page.read_text(), re.M)}


@pytest.mark.parametrize("path", READMES, ids=lambda path: str(path.relative_to(ROOT)))
def test_readmes(path):
    text = path.read_text()
    assert [*lost_in_markdown(path, text), *lost_sections(text), *lost_paths(text)] == []


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_pages(path, labels):
    text = path.read_text()
    assert [*lost_in_page(text, labels), *lost_sections(text), *lost_paths(text)] == []


def test_a_lost_one_is_found(labels):
    here = ROOT / "README.md"
    assert len(list(lost_in_markdown(here, "[a](doc/src/Howto_no.rst) [b](README.md#no-heading) [c](README.md#install) [d](https://x.org)"))) == 2
    assert len(list(lost_in_page(":doc:`Howto_no` :doc:`x <Howto_no>` :doc:`Howto_front` :ref:`no-label` :ref:`x <fracture-walls>` `No section`_ ``x`_``", labels))) == 4
    assert len(list(lost_sections(':doc:`Howto_front`, "No section" [Howto_front](doc/src/Howto_front.rst), "Studies" Howto_front, "None"'))) == 2
    assert list(lost_paths("``examples/none`` ``tests/style/test_build.py`` ``doc/records/*.jsonl``")) == ["examples/none: no such file or folder"]
