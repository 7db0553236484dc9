"""Every style of the package has a page, every page has LAMMPS's sections in LAMMPS's order, all in ASCII.

What is not so is a warning, and `make doc` takes warnings as errors. tests/python/test_docs.py asks too, without Sphinx.
"""

import pathlib
import re

SECTIONS = ["Syntax", "Examples", "Description", "Restrictions", "Related commands", "Default"]


def styles(headers):
    """(kind, name) of every style macro in the headers of a folder"""
    found = set()
    for header in sorted(pathlib.Path(headers).glob("*.h")):
        for kind, name in re.findall(r"^(Pair|Bond|Fix|Compute|Region|Command)Style\(([^,]+),", header.read_text(), re.M):
            found.add((kind.lower(), name))
    return found


def page_name(kind, name):
    return (name if kind == "command" else f"{kind}_{name}").replace("/", "_").replace("-", "_")


def problems(source, headers):
    """what is wrong with the pages in the folder source, one line each"""
    source = pathlib.Path(source)
    wanted = {page_name(*style): style for style in styles(headers)}
    pages = {p.stem: p for p in source.glob("*hvi_*.rst")}

    for stem in sorted(wanted.keys() - pages.keys()):
        yield f"{' style '.join(wanted[stem])} has no page {stem}.rst"
    for stem in sorted(pages.keys() - wanted.keys()):
        yield f"{stem}.rst describes a style that does not exist"

    for stem in sorted(wanted.keys() & pages.keys()):
        text = pages[stem].read_text(errors="replace")
        if not re.search(rf"^(pair_style|bond_style|fix|compute|region)? *{wanted[stem][1]} command\n=+$", text, re.M):
            yield f"{stem}.rst has no title '... {wanted[stem][1]} command'"
        titles = re.findall(r'^([^\n]+)\n"{4,}$', text, re.M)
        if [t for t in titles if t in SECTIONS] != SECTIONS:
            yield f"{stem}.rst: sections are {titles}, want {SECTIONS} in this order"

    for path in sorted(source.glob("*.rst")):
        if not path.read_bytes().isascii():
            yield f"{path.name} is not plain ASCII"


def check(app):
    from sphinx.util import logging

    for problem in problems(app.srcdir, app.config.stylepages_headers):
        logging.getLogger(__name__).warning("%s", problem)


def setup(app):
    app.add_config_value("stylepages_headers", "", "env")
    app.connect("builder-inited", check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
