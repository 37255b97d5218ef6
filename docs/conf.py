"""How Sphinx builds the manual: `make docs`, offline and with warnings as errors."""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

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
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
napoleon_google_docstring = False
napoleon_use_rtype = False
