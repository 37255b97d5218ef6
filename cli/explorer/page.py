"""One page from a dataset: figures, data, script and style in a single file that needs no network."""

import tomllib
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from bokeh.document import Document
from bokeh.embed import file_html
from bokeh.models import ColumnDataSource, CustomJS, CustomJSTicker, CustomJSTickFormatter, LinearColorMapper, Range1d
from bokeh.models.annotations import ColorBar
from bokeh.palettes import Viridis256
from bokeh.plotting import figure
from bokeh.resources import INLINE
from jinja2 import Environment

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.reader import has_curves, is_fit
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.dataset.read.sensitivities import spread
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.data import Entry, lines_of, study_data, words
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, curve_of
from gradhesion.cli.names.outputs import PARETO_POINT, SI
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.picture.curves import JUMPS, wants_si
from gradhesion.cli.picture.labels import given
from gradhesion.cli.picture.looks import check_dimensions, check_names
from gradhesion.cli.study.text.toml import toml_of
from gradhesion.core.problem.inputs import INPUTS

MOST: Final = 20_000_000
"""Values in a page: it is 110 MB then, and takes a browser some seconds to open."""
INK: Final = "#333333"
QUIET: Final = "#888888"
FONT: Final = "12px"
BAR: Final = 66
BARE: Final = 16
"""Pixels to the right of frames, on a page with bars of colours and without: frames stand in line."""
Part = dict[str, Any]
LOOKS: Final[Part] = {
    "tools": "pan,wheel_zoom,box_zoom,reset,save", "toolbar_location": "above", "active_drag": None,
    "min_border": 4, "min_border_left": 78, "sizing_mode": "stretch_both", "output_backend": "canvas",
}  # fmt: skip
"""The looks of every figure; a finger that moves the page is not caught."""
_SCRIPTS: Final = ("numbers", "scene", "controls", "maps", "sections", "curves", "address", "downloads", "explorer")
"""The script of a page, in the order in which its parts need each other."""


def write_page(
    dataset: xarray.Dataset, file: str, variables: Sequence[str], places: Sequence[str], path: Path, *, overwrite: bool
) -> None:
    """Write a dataset, whose name is `file`, as a page: some variables (all if none), at AXIS=VALUE of some axes.

    DatasetError says what it lacks, OutputError why the page cannot be written.
    """
    with replacement(path, overwrite=overwrite) as temporary:
        if is_fit(dataset):
            raise DatasetError(f"{file}: contains a fit, and a page needs scenes; `gradhesion plot` draws it")
        check_dimensions(dataset)
        text = _page(dataset, file, chosen(dataset, variables, places))
        with writing(path):
            temporary.write_text(text, encoding="utf-8")


def _page(dataset: xarray.Dataset, file: str, cut: xarray.Dataset) -> str:
    """Make the page of a dataset, of which it shows what is cut out."""
    planes, units, tracks = lines_of(cut) if has_curves(dataset) else ([], {}, {})
    study, shown = study_data(cut, units)
    kind = "curves" if planes else _kind_of(study)
    count, maps = 0 if planes else min(2, len(shown)), kind == "maps"
    sides, shared = ("x", "y") if maps else ("x",), {side: Range1d(start=0, end=1) for side in ("x", "y")}
    parts: Part = {
        "ranges": shared,
        "maps": [_map_of(i, shared) for i in range(count if maps else 0)],
        "sections": [{side: _section_of(i, side, BAR if maps else BARE) for side in sides} for i in range(count)],
        "planes": [],
    }
    for i, (x, y) in enumerate(planes):
        plot = _figure(f"plane{i}", BARE)
        parts["planes"].append({"figure": plot, "lines": _lines(plot), "x": x, "y": y})
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
    page: str = file_html(document, INLINE, document.title, template=template, template_variables=about)
    return page


def chosen(dataset: xarray.Dataset, variables: Sequence[str], places: Sequence[str]) -> xarray.Dataset:
    """Cut a dataset down to some variables and to some values of axes; `status` stays."""
    if PARETO_POINT in dataset.dims:
        raise DatasetError("Pareto fronts have no page; draw them with `gradhesion plot`")
    dataset, parts = spread(dataset)
    dataset = dataset.drop_vars([*parts])  # the strongest, which readers can see
    scenes = dataset["status"].dims
    names = [name for name in map(str, dataset.data_vars) if curve_of(name) not in (*RAGGED, *STATE_CURVES)]
    known = [name for name in names if name != "status" and dataset[name].dims[: len(scenes)] == scenes]
    check_names("variable", variables, known, "a page cannot show it")
    if not known:
        raise DatasetError(JUMPS)
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
            f"{size:,} values are too many for a page, which takes {MOST:,}; choose fewer with --at AXIS=VALUE or "
            "--variable, or make a coarser study"
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
    others = {
        name: {key: value for key, value in one.items() if key not in keys}
        for name, one in stored.items()
        if isinstance(one, dict) and name not in ("parameters", "physical")
    }
    tables = {name: toml_of({name: one}).partition("]\n")[2].strip() for name, one in others.items() if one}
    return {"given": keys, "head": toml_of(head | ({"kind": "curve"} if has_curves(dataset) else {})), "tables": tables}


def _read(name: str) -> str:
    """Read a file of this package."""
    return (Path(__file__).parent / name).read_text(encoding="utf-8")


def _map_of(number: int, shared: Part) -> Part:
    """Make a map: an image, the lines through its cell, and a bar of colours."""
    plot = _figure(f"map{number}", BAR, "map", shared)
    image = ColumnDataSource({"image": [np.zeros((1, 1), np.uint32)], "x": [0.0], "y": [0.0], "dw": [1.0], "dh": [1.0]})
    plot.image_rgba(image="image", x="x", y="y", dw="dw", dh="dh", source=image)
    cell = _source("x", "y", "left", "right", "bottom", "top")
    for colour, width in (("white", 2.5), (INK, 0.8)):
        plot.vspan(x="x", source=cell, line_color=colour, line_width=width, line_alpha=0.6)
        plot.hspan(y="y", source=cell, line_color=colour, line_width=width, line_alpha=0.6)
    for colour, width in (("white", 4.0), ("#d62728", 2.0)):
        plot.quad("left", "right", "top", "bottom", source=cell, fill_alpha=0.0, line_color=colour, line_width=width)
    mapper = LinearColorMapper(palette=Viridis256, low=0, high=1)
    looks: Part = {"width": 12, "padding": 5, "major_label_text_font_size": FONT, "bar_line_color": QUIET}
    bar = ColorBar(color_mapper=mapper, border_line_color=None, **_ticks(f"map{number}.bar"), **looks)
    plot.add_layout(bar, "right")
    _listen(plot, f"'map', {number}")
    return {"figure": plot, "image": image, "cell": cell, "mapper": mapper, "bar": bar}


def _section_of(number: int, side: str, right: int) -> Part:
    """Make a section: the values along one axis through the cell, or over a parameter."""
    plot = _figure(f"section{number}{side}", right)
    lines = _lines(plot)
    dots = _source("x", "y", "marker", "size", "fill", "colour")
    looks: Part = {"marker": "marker", "size": "size", "fill_color": "fill", "line_color": "colour", "line_width": 1.2}
    plot.scatter("x", "y", source=dots, **looks)
    here = _source("x", "y", "at")
    plot.vspan(x="at", source=here, line_color=QUIET, line_width=0.8, line_alpha=0.6)
    plot.scatter("x", "y", source=here, size=10, fill_color="#d62728", line_color="white", line_width=1.5)
    _listen(plot, f"'{side}', {number}")
    return {"figure": plot, "lines": lines, "dots": dots, "here": here}


def _source(*columns: str) -> ColumnDataSource:
    """Make a source of some columns, still empty."""
    return ColumnDataSource({name: [] for name in columns})


def _lines(plot: figure) -> ColumnDataSource:
    """Give a figure lines, each with its own look."""
    lines = _source("xs", "ys", "colour", "dash", "width")
    plot.multi_line("xs", "ys", source=lines, line_color="colour", line_dash="dash", line_width="width")
    return lines


def _figure(name: str, right: int, place: str = "", ranges: Part | None = None) -> figure:
    """Make a figure that fills its place in the page, at a size that can be read.

    The script gives it ticks by the name of a place, its own if none; maps share their ranges.
    """
    sides = {f"{side}_range": one for side, one in (ranges or {"x": (0, 1), "y": (0, 1)}).items()}
    plot = figure(name=name, **LOOKS, **sides, min_border_right=right)
    plot.toolbar.update(logo=None, autohide=True)
    for side, axis in (("x", plot.xaxis[0]), ("y", plot.yaxis[0])):
        axis.update(**_ticks(f"{place or name}.{side}"))
        for part in ("axis", "major"):
            axis.update(**{f"{part}_label_text_font_size": FONT, f"{part}_label_text_color": INK})
        axis.update(axis_label_text_font_style="normal", minor_tick_line_color=None)
    plot.grid.grid_line_color = "#e5e5e5"
    plot.outline_line_color = QUIET
    return plot


def _ticks(place: str) -> Part:
    """Make what asks the script for ticks and for their words."""
    return {
        "ticker": CustomJSTicker(major_code=f"return explorer.ticks('{place}', cb_data.start, cb_data.end)"),
        "formatter": CustomJSTickFormatter(code=f"return explorer.tickWords('{place}', tick)"),
    }


def _listen(plot: figure, which: str) -> None:
    """Report the script of a pointer that moves or taps."""
    for event, word in (("mousemove", "hover"), ("tap", "tap"), ("doubletap", "tap")):  # a second tap at once is a tap
        plot.js_on_event(event, CustomJS(code=f"explorer.{word}({which}, cb_obj)"))
