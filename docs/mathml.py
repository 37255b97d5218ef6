"""Formulae as MathML, which browsers draw themselves: no script from elsewhere, and no LaTeX to build the pages.

A formula that docutils cannot translate is a warning, and so ends `make docs`.
"""

import re
from typing import Any, Final

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.typing import ExtensionMetadata
from sphinx.writers.html5 import HTML5Translator

UNKNOWN: Final = {r"\dots": r"\ldots", "*": r"\ast "}
"""What docutils does not know or draws too high, and what it does."""

FUNCTION: Final = r"<mi[^>]*>[a-z]{2,}</mi>\s*<mo>&ApplyFunction;</mo>"
THIN: Final = '<mspace width="0.1667em"></mspace>'

JOINED: Final = r"\(<math.*?</math>[,.;:)]*|<math(?:(?!block|</math>).)*</math>[,.;:)]+"
"""A formula with what stands next to it."""


def _inline(writer: HTML5Translator, node: nodes.math) -> None:
    """Write a formula of a line."""
    writer.body.append(_translated(node, block=False))
    raise nodes.SkipNode


def _displayed(writer: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula that stands by itself."""
    writer.body.append(f'<div class="formula">{_translated(node, block=True)}</div>\n')
    raise nodes.SkipNode


def _translated(node: nodes.Element, *, block: bool) -> str:
    """Translate a formula from LaTeX."""
    formula = re.sub(r"(frac)\s*(\d)\s*(\d)", r"\1{\2}{\3}", node.astext())  # it takes the 12 of \frac12 for twelve
    for command, known in UNKNOWN.items():
        formula = formula.replace(command, known)
    try:
        return _spaced(str(tex2mathml(formula, as_block=block)))
    except MathError as error:
        logging.getLogger(__name__).warning("formula %r: %s", node.astext(), error, location=node)
        return ""


def _spaced(drawn: str) -> str:
    """Put the spaces of TeX beside functions such as sin, none beside a slash or a bar, and primes of the font."""
    drawn = re.sub(rf"({FUNCTION})(?!\s*(<mrow>\s*)?<mo[^>]*>\()", rf"\1{THIN}", drawn)
    drawn = re.sub(rf"((?:</m(?:i|n|frac|sub|sup|subsup|row)>|\)</mo>)\s*)({FUNCTION})", rf"\1{THIN}\2", drawn)
    drawn = drawn.replace("<mo>'</mo>", "<mi>&prime;</mi>")
    return re.sub(r'<mo stretchy="false">([/|])<', r'<mo lspace="0" rspace="0" stretchy="false">\1<', drawn)


def _joined(_app: Sphinx, _page: str, _template: str, context: dict[str, Any], _doctree: nodes.document | None) -> None:
    """Let no line end between a formula and its brackets, comma or full stop, where browsers would end it."""
    if "body" in context:
        context["body"] = re.sub(JOINED, r'<span class="joined">\g<0></span>', context["body"], flags=re.DOTALL)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Offer the renderer as `mathml`."""
    app.connect("html-page-context", _joined)
    app.add_html_math_renderer("mathml", (_inline, None), (_displayed, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
