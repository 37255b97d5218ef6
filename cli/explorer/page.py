"""One page from a dataset: figures, data, script and style in a single file that needs no network."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import xarray
from bokeh.document import Document
from bokeh.embed import file_html
from bokeh.models import CustomJS
from bokeh.palettes import Viridis256
from bokeh.resources import INLINE
from jinja2 import Environment

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.reader import has_curves
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.choice import chosen
from gradhesion.cli.explorer.data import Entry, study_data
from gradhesion.cli.explorer.figures import BAR, BARE, Part, map_of, plane_of, ranges, section_of
from gradhesion.cli.explorer.lines import lines_of
from gradhesion.cli.explorer.plain import words
from gradhesion.cli.explorer.scene_study import scene_study
from gradhesion.cli.names.scenes import SCENE, SOLVER

_OWN: Final = Path(__file__).parent
_SCRIPTS: Final = ("numbers", "scene", "controls", "maps", "sections", "curves", "address", "downloads", "explorer")
"""The script of a page, in the order in which its parts need each other."""


def page(dataset: xarray.Dataset, file: str, variables: Sequence[str], places: Sequence[str]) -> str:
    """Write a dataset as a page.

    Parameters
    ----------
    file
        The name of the dataset, which the page shows.
    variables, places
        What to take of it: variables by name (all if none), and AXIS=VALUE for the nearest value of an axis.
    """
    cut = chosen(dataset, variables, places)
    planes, units, tracks = lines_of(cut) if has_curves(dataset) else ([], {}, {})
    study, shown = study_data(cut, units)
    kind = "curves" if planes else _kind_of(study)
    sides = ("x", "y") if kind == "maps" else ("x",)
    count = 0 if planes else min(2, len(shown))
    shared = ranges()
    parts: Part = {
        "ranges": shared,
        "maps": [map_of(i, shared) for i in range(count)] if kind == "maps" else [],
        "sections": [
            {side: section_of(i, side, BAR if kind == "maps" else BARE) for side in sides} for i in range(count)
        ],
        "planes": [plane_of(i, *plane) for i, plane in enumerate(planes)],
    }
    document = Document(title=str(dataset.attrs["title"]))
    sections = [section for both in parts["sections"] for section in both.values()]
    for part in (*parts["maps"], *sections, *parts["planes"]):
        document.add_root(part["figure"])
    study |= tracks | {"kind": kind, "palette": list(Viridis256), "file": file, "scene": scene_study(cut)}
    args = {"study": study, "variables": shown, "parts": parts}
    document.js_on_event("document_ready", CustomJS(args=args, code="explorer.start(study, variables, parts)"))
    about = {
        "kind": kind,
        "file": file,
        "attributes": dataset.attrs,
        "profile": words(str(dataset.attrs.get("profile", ""))),
        "sliders": bool(study["axes"]),
        "slope": " ".join(slope_warnings(cut)),
        "sections": count,
        "sides": sides,
        "planes": len(planes),
        "style": _read("page.css"),
        "script": "\n".join(_read(f"{name}.js") for name in _SCRIPTS),
    }
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(_read("page.html"))
    return file_html(document, INLINE, document.title, template=template, template_variables=about)


def _kind_of(study: Entry) -> str:
    """Report the kind of a page by what varies: maps over two axes, lines over one, points."""
    axes = [axis["name"] for axis in study["axes"] if axis["name"] != SOLVER]
    over = any("places" in parameter for parameter in study["parameters"])
    if not axes or (SCENE in axes and not over):
        raise DatasetError("nothing varies, so there is nothing to explore; `gradhesion info` shows the values")
    return "points" if SCENE in axes else "maps" if len(axes) > 1 else "lines"


def _read(name: str) -> str:
    """Read a file of this package."""
    return (_OWN / name).read_text(encoding="utf-8")
