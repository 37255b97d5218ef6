"""How Sphinx builds the manual: `make docs`, offline and with warnings as errors."""

import sys
from importlib.metadata import version as version_of
from importlib.util import find_spec
from pathlib import Path

from sphinx.application import Sphinx

FOLDER = Path(__file__).parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent)]  # for mathml, and for docs.notebooks

from docs import notebooks  # noqa: E402

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


def _with_notebook(app: Sphinx, page: str, text: list[str]) -> None:
    """Put a link to the notebook of a page below its title."""
    if page in notebooks.PAGES and app.builder.format == "html":
        title, _, rest = text[0].partition("\n")
        address = f"notebooks/{page}.ipynb"
        text[0] = (
            f'{title}\n\n<a class="notebook" href="{address}" download>Download this page as a notebook</a>\n{rest}'
        )


def _write_notebooks(app: Sphinx, error: Exception | None) -> None:
    """Write the notebooks beside the pages."""
    if error is None and app.builder.format == "html":
        notebooks.write(Path(app.outdir) / "notebooks")


def setup(app: Sphinx) -> None:
    """Add what pages have on the site and not in the repository."""
    app.connect("source-read", _with_notebook)
    app.connect("build-finished", _write_notebooks)
