"""How Sphinx builds the manual: `make docs`, offline and with warnings as errors."""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

from sphinx.application import Sphinx

sys.path.insert(0, str(Path(__file__).parent))  # for mathml

project = "gradhesion"
author = "gradhesion developers"
copyright = author  # noqa: A001 (so Sphinx calls it)
version = release = version_of("gradhesion")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "mathml"]
exclude_patterns = ["_build"]
nitpicky = False
suppress_warnings = ["config.cache"]

# The pages are read on a git host as well: its headings have the same anchors, its formulae the same dollars.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True

html_theme = "furo"
html_title = f"gradhesion {version}"
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False

default_role = "code"  # docstrings have single backticks around code
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings give types in words, where numpy's would be spelt out over three lines
napoleon_google_docstring = False
napoleon_use_rtype = False


def _without_type(_app: Sphinx, _what: str, _name: str, _object: object, _options: object, lines: list[str]) -> None:
    """Make a section of what is returned, which has no type here, a description: it would be taken for types."""
    for i, line in enumerate(lines[:-2]):
        if line == "Returns" and lines[i + 1] == "-------":
            end = next((j for j in range(i + 2, len(lines)) if not lines[j]), len(lines))
            lines[i + 2 : end] = [":", *(f"    {written}" for written in lines[i + 2 : end])]
            return


def setup(app: Sphinx) -> None:
    """Have docstrings changed before napoleon reads them."""
    app.connect("autodoc-process-docstring", _without_type, priority=400)
