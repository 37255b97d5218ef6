"""The figures of a page, still empty: its script fills them, and is notified of what happens in them."""

from typing import Any, Final

import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, CustomJSTicker, CustomJSTickFormatter, LinearColorMapper, Range1d
from bokeh.models.annotations import ColorBar
from bokeh.palettes import Viridis256
from bokeh.plotting import figure

INK: Final = "#333333"
QUIET: Final = "#888888"
FONT: Final = "12px"
BAR: Final = 66
BARE: Final = 16
"""Pixels to the right of frames, on a page with bars of colours and without: frames stand in line."""
TOOLS: Final = "pan,wheel_zoom,box_zoom,reset,save"
Part = dict[str, Any]


def ranges() -> Part:
    """Make a range for each side; maps share theirs."""
    return {side: Range1d(start=0, end=1) for side in ("x", "y")}


def map_of(number: int, shared: Part) -> Part:
    """Make a map: an image, the lines through its cell, and a bar of colours."""
    plot = _figure(f"map{number}", "map", shared, BAR)
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


def section_of(number: int, side: str, right: int) -> Part:
    """Make a section: the values along one axis through the cell, or over a parameter."""
    plot = _figure(f"section{number}{side}", f"section{number}{side}", ranges(), right)
    lines = _lines(plot)
    dots = _source("x", "y", "marker", "size", "fill", "colour")
    looks: Part = {"marker": "marker", "size": "size", "fill_color": "fill", "line_color": "colour", "line_width": 1.2}
    plot.scatter("x", "y", source=dots, **looks)
    here = _source("x", "y", "at")
    plot.vspan(x="at", source=here, line_color=QUIET, line_width=0.8, line_alpha=0.6)
    plot.scatter("x", "y", source=here, size=10, fill_color="#d62728", line_color="white", line_width=1.5)
    _listen(plot, f"'{side}', {number}")
    return {"figure": plot, "lines": lines, "dots": dots, "here": here}


def plane_of(number: int, x: str, y: str) -> Part:
    """Make a plane of curves, one variable over another."""
    plot = _figure(f"plane{number}", f"plane{number}", ranges(), BARE)
    return {"figure": plot, "lines": _lines(plot), "x": x, "y": y}


def _source(*columns: str) -> ColumnDataSource:
    """Make a source of some columns, still empty."""
    return ColumnDataSource({name: [] for name in columns})


def _lines(plot: figure) -> ColumnDataSource:
    """Give a figure lines, each with its own look."""
    lines = _source("xs", "ys", "colour", "dash", "width")
    plot.multi_line("xs", "ys", source=lines, line_color="colour", line_dash="dash", line_width="width")
    return lines


def _figure(name: str, place: str, sides: Part, right: int) -> figure:
    """Make a figure that fills its place in the page, with the ticks of the script, at a size that can be read."""
    plot = figure(
        name=name,
        x_range=sides["x"],
        y_range=sides["y"],
        tools=TOOLS,
        active_drag=None,  # a finger that moves the page must not be caught
        sizing_mode="stretch_both",
        toolbar_location="above",
        output_backend="canvas",
        min_border=4,
        min_border_left=78,
        min_border_right=right,
    )
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    for side, axis in (("x", plot.xaxis[0]), ("y", plot.yaxis[0])):
        axis.update(**_ticks(f"{place}.{side}"))
        for words in ("axis", "major"):
            axis.update(**{f"{words}_label_text_font_size": FONT, f"{words}_label_text_color": INK})
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
