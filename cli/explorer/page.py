"""One page from a dataset: figures, data, script and style in a single file that needs no network."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

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
from gradhesion.cli.explorer.figures import Part, map_of, plane_of, ranges, section_of
from gradhesion.cli.explorer.lines import lines_of
from gradhesion.cli.explorer.plain import words
from gradhesion.cli.explorer.scene_study import scene_study
from gradhesion.cli.names.scenes import SCENE, SOLVER

_OWN: Final = Path(__file__).parent
_SCRIPTS: Final = (
    "numbers",
    "theme",
    "scene",
    "controls",
    "maps",
    "sections",
    "curves",
    "address",
    "downloads",
    "explorer",
)
"""The script of a page, in the order in which its parts need each other."""

_SIDES: Final = ("x", "y")


def page(dataset: xarray.Dataset, file: str, variables: Sequence[str], places: Sequence[str]) -> str:
    """
    Write a dataset as a page.

    Parameters
    ----------
    file
        The name of the dataset, which the page shows.
    variables, places
        What to take of it: variables by name (all if none), and AXIS=VALUE for the nearest value of an axis.
    """
    cut = chosen(dataset, variables, places)
    curves = has_curves(dataset)
    lines = lines_of(cut) if curves else None
    study, shown = study_data(cut, lines.units if lines else {})
    kind = "curves" if curves else _kind_of(study)
    document = Document(title=str(dataset.attrs["title"]))
    parts: Part = {}
    if lines:
        study |= {"tracks": lines.tracks, "labels": lines.labels}
        parts["planes"] = [plane_of(i, *plane) for i, plane in enumerate(lines.planes)]
    else:
        sides = _SIDES if kind == "maps" else ("x",)
        count = min(2, len(shown))
        if kind == "maps":
            shared = ranges()
            parts |= {"ranges": shared, "maps": [map_of(i, shared) for i in range(count)]}
        parts["sections"] = [{side: section_of(i, side) for side in sides} for i in range(count)]
    for figure in _figures(parts):
        document.add_root(figure)
    study |= {"kind": kind, "palette": list(Viridis256), "file": file, "scene": scene_study(cut)}
    args = {"study": study, "variables": shown, "parts": parts}
    document.js_on_event("document_ready", CustomJS(args=args, code="explorer.start(study, variables, parts)"))
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    about = {
        "kind": kind,
        "file": file,
        "attributes": dataset.attrs,
        "profile": words(str(dataset.attrs.get("profile", ""))),
        "sliders": bool(study["axes"]),
        "slope": " ".join(slope_warnings(cut)),
        "sections": len(parts.get("sections", ())),
        "sides": _SIDES if kind == "maps" else ("x",),
        "planes": len(parts.get("planes", ())),
        "columns": max(len(parts.get("sections", ())), len(parts.get("planes", ()))),
        "style": _read("page.css"),
        "script": "\n".join(_read(f"{name}.js") for name in _SCRIPTS),
    }
    template = environment.from_string(_read("page.html"))
    return file_html(document, INLINE, document.title, template=template, template_variables=about)


def _kind_of(study: Entry) -> str:
    """Report the kind of a page by what varies: maps over two axes, lines over one, points."""
    axes = [axis["name"] for axis in study["axes"]]
    if SCENE in axes and not any("places" in parameter for parameter in study["parameters"]):
        axes = []
    if not [axis for axis in axes if axis != SOLVER]:
        raise DatasetError("nothing varies, so there is nothing to explore; `gradhesion info` shows the values")
    if SCENE in axes:
        return "points"
    return "maps" if len([axis for axis in axes if axis != SOLVER]) > 1 else "lines"


def _figures(parts: Part) -> list[Any]:
    """List the figures of a page."""
    sections = [section for both in parts.get("sections", ()) for section in both.values()]
    return [part["figure"] for part in (*parts.get("maps", ()), *sections, *parts.get("planes", ()))]


def _read(name: str) -> str:
    """Read a file of this package."""
    return (_OWN / name).read_text(encoding="utf-8")
