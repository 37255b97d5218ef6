"""How Sphinx builds the manual: `make docs`, offline and with warnings as errors."""

import sys
from importlib.metadata import version as version_of
from importlib.util import find_spec
from pathlib import Path

from sphinx.application import Sphinx

FOLDER = Path(__file__).parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent)]  # for mathml, and for docs.generated

from docs import generated  # noqa: E402

project = "gradhesion"
author = "gradhesion developers"
copyright = author  # noqa: A001 (so Sphinx calls it)
version = release = version_of("gradhesion")

extensions = ["myst_parser", "sphinx_copybutton", "mathml"]
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
html_css_files = ["manual.css"]
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True
copybutton_selector = "div:not(.highlight-output):not(.highlight-text) > div.highlight > pre"
html_show_sphinx = False


def _math_font() -> str:
    """Find the font for formulae, STIX Two Math under the SIL Open Font Licence, in the package that has it."""
    package = find_spec("ziamath")
    assert package
    assert package.origin
    return str(Path(package.origin).parent / "fonts" / "STIXTwoMath-Regular.ttf")


html_static_path = ["static", _math_font()]


def setup(app: Sphinx) -> None:
    """Write the pages that follow from the program before the others are read."""
    app.connect("builder-inited", lambda _: generated.write())
