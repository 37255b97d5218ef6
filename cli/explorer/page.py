"""One page from a dataset: figures, data, script and style in a single file that needs no network."""

import tomllib
from collections.abc import Sequence
from contextlib import suppress
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
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.data import Entry, lines_of, study_data
from gradhesion.cli.explorer.figures import BAR, BARE, map_of, plane_of, ranges, section_of
from gradhesion.cli.explorer.plain import words
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, curve_of
from gradhesion.cli.names.outputs import PARETO_POINT, SI
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.picture.curves import wants_si
from gradhesion.cli.picture.labels import given
from gradhesion.cli.study.text.written import toml_of
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.inputs import INPUTS

MOST: Final = 20_000_000
"""Values in a page: it is 110 MB then, and takes a browser some seconds to open."""
_SCRIPTS: Final = ("numbers", "scene", "controls", "maps", "sections", "curves", "address", "downloads", "explorer")
"""The script of a page, in the order in which its parts need each other."""


def page(dataset: xarray.Dataset, file: str, variables: Sequence[str], places: Sequence[str]) -> str:
    """Write a dataset, whose name is `file`, as a page: some variables (all if none), at AXIS=VALUE of some axes."""
    cut = chosen(dataset, variables, places)
    planes, units, tracks = lines_of(cut) if has_curves(dataset) else ([], {}, {})
    study, shown = study_data(cut, units)
    kind = "curves" if planes else _kind_of(study)
    count, maps = 0 if planes else min(2, len(shown)), kind == "maps"
    sides, shared = ("x", "y") if maps else ("x",), ranges()
    parts: dict[str, Any] = {
        "ranges": shared,
        "maps": [map_of(i, shared) for i in range(count if maps else 0)],
        "sections": [{side: section_of(i, side, BAR if maps else BARE) for side in sides} for i in range(count)],
        "planes": [plane_of(i, *plane) for i, plane in enumerate(planes)],
    }
    document = Document(title=str(dataset.attrs["title"]))
    sections = [section for both in parts["sections"] for section in both.values()]
    for part in (*parts["maps"], *sections, *parts["planes"]):
        document.add_root(part["figure"])
    study |= tracks | {"kind": kind, "palette": list(Viridis256), "file": file, "scene": _study_of_a_scene(cut)}
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


def chosen(dataset: xarray.Dataset, variables: Sequence[str], places: Sequence[str]) -> xarray.Dataset:
    """Cut a dataset down to some variables and to some values of axes; `status` stays."""
    if PARETO_POINT in dataset.dims:
        raise DatasetError("Pareto fronts have no page; draw them with `gradhesion plot`")
    parts = [str(name) for name in dataset.data_vars if parts_of(dataset, str(name))]
    dataset = spread(dataset).drop_vars(parts)
    scenes = dataset["status"].dims
    hidden = ("status", *(name for name in dataset.data_vars if curve_of(str(name)) in (*RAGGED, *STATE_CURVES)))
    known = [
        str(name) for name in dataset.data_vars if name not in hidden and dataset[name].dims[: len(scenes)] == scenes
    ]
    for name in variables:
        if name not in known:
            raise DatasetError(f"--variable {name}: a page cannot show it; {did_you_mean(name, known)}")
    if not known:
        raise DatasetError(
            "jumps are not drawn: `gradhesion info --jumps` lists them; "
            'for a page of the cycle add "path" to the outputs of the study'
        )
    if has_curves(dataset):
        shown = variables or [name for name in known if name + SI not in known]  # curves are drawn in units alone
        wants_si(shown, variables)
    else:  # those in units first, and last what is there in units too
        shown = variables or sorted(known, key=lambda name: (name + SI in known, not name.endswith(SI)))
    cut = dataset[[*shown, "status"]]
    cut = selection_of(cut, places).narrowed(cut)
    size = sum(variable.size for variable in cut.data_vars.values())
    if size > MOST:
        raise DatasetError(
            f"{size:,} values are too many for a page, which takes {MOST:,}: choose one value of an axis with --at, as "
            f"in --at AXIS=VALUE, or fewer variables with --variable, or make a coarser study"
        )
    return cut


def _kind_of(study: Entry) -> str:
    """Report the kind of a page by what varies: maps over two axes, lines over one, points."""
    axes = [axis["name"] for axis in study["axes"] if axis["name"] != SOLVER]
    over = any("places" in parameter for parameter in study["parameters"])
    if not axes or (SCENE in axes and not over):
        raise DatasetError("nothing varies, so there is nothing to explore; `gradhesion info` shows the values")
    return "points" if SCENE in axes else "maps" if len(axes) > 1 else "lines"


def _study_of_a_scene(dataset: xarray.Dataset) -> Entry:
    """Describe the study of one scene: the keys that give it, each with its table, and all else that it has as TOML."""
    stored: dict[str, Any] = {}
    with suppress(tomllib.TOMLDecodeError, RecursionError):
        stored = tomllib.loads(str(dataset.attrs.get("study", "")))
    keys = {name: INPUTS[name].table for name in given(dataset.coords)}
    own = [str(name) for name in dataset.data_vars if name != "status" and not str(name).endswith(SI)]
    head = {"title": f"A scene of: {dataset.attrs.get('title', 'a dataset')}", "outputs": stored.get("outputs", own)}
    tables: dict[str, str] = {}
    for name, table in stored.items():
        if isinstance(table, dict) and name not in ("parameters", "physical"):
            others = {key: value for key, value in table.items() if key not in keys}
            tables |= {name: toml_of({name: others}).partition("]\n")[2].strip()} if others else {}
    return {"given": keys, "head": toml_of(head | ({"kind": "curve"} if has_curves(dataset) else {})), "tables": tables}


def _read(name: str) -> str:
    """Read a file of this package."""
    return (Path(__file__).parent / name).read_text(encoding="utf-8")
