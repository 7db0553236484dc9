"""Formulas as MathML, which browsers draw by themselves: no script, no font, no remote host."""

from accents import index_beside
from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

logger = logging.getLogger(__name__)


def convert(node, block):
    tex = node.astext()
    try:
        try:
            mathml = latex2mathml.tex2mathml(tex, as_block=block)  # docutils 0.20 and later
        except TypeError:
            mathml = latex2mathml.tex2mathml(tex, inline=not block)
        return index_beside(mathml)
    except (SyntaxError, ValueError) as problem:  # MathError of later docutils is a ValueError
        logger.warning("formula %r: %s", tex, problem, location=node)
        return ""


def visit_inline(self, node):
    self.body.append(f'<span class="math">{convert(node, False)}</span>')
    raise nodes.SkipNode


def visit_block(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math"))
    if node["number"]:
        self.body.append(f'<span class="eqno">({get_node_equation_number(self, node)})</span>')
    self.body.append(convert(node, True) + "</div>\n")
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
