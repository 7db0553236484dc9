"""Docutils takes the index of a letter with an accent for a limit, as that of a sum, and puts it under the letter, for \\dot e_i and
{\\dot e}_i alike. index_beside() puts it beside the letter. Needs neither Docutils nor Sphinx.
"""

import html
import re
import xml.etree.ElementTree as ET

SPACE = "http://www.w3.org/1998/Math/MathML"
ACCENTS = set("\u02d9\u00a8\u02dc\u02c9\u00af\u02c6\u02c7\u02d8\u00b4\u0060\u02da\u22ef\u20d7\u2192")  # dot, ddot, tilde, bar, hat ...


def index_beside(mathml):
    """the formula with munderover(letter, index, accent) as msub(mover(letter, accent), index)"""
    ET.register_namespace("", SPACE)
    # XML does not know HTML's names of characters
    root = ET.fromstring(re.sub(r"&(?!(?:lt|gt|amp|quot);)\w+;", lambda m: html.unescape(m.group()), mathml))
    for parent in list(root.iter()):
        for place, node in enumerate(list(parent)):
            if node.tag != f"{{{SPACE}}}munderover":
                continue
            letter, index, over = node
            if over.tag == f"{{{SPACE}}}mo" and over.text in ACCENTS:
                accented, beside = (ET.Element(f"{{{SPACE}}}{name}") for name in ("mover", "msub"))
                accented.extend([letter, over])
                beside.extend([accented, index])
                beside.tail = node.tail
                parent[place] = beside
    return ET.tostring(root, encoding="unicode", short_empty_elements=False)
