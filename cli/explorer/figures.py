"""The figures of a page, still empty: its script fills them, and is notified of what happens in them."""

from typing import Any, Final

import numpy as np
from bokeh.models import (
    ColumnDataSource,
    CustomJS,
    CustomJSTicker,
    CustomJSTickFormatter,
    LinearColorMapper,
    Range1d,
)
from bokeh.models.annotations import ColorBar
from bokeh.palettes import Viridis256
from bokeh.plotting import figure

INK: Final = "#333333"
FONT: Final = "13px"
LEFT: Final = 88
RIGHT: Final = 74
"""Pixels beside the frame of a figure, for the numbers of its axis and for a bar of colours: frames stand in line."""

TOOLS: Final = "pan,wheel_zoom,box_zoom,reset,save"

Part = dict[str, Any]


def ranges() -> Part:
    """Make a range for each side; maps share theirs."""
    return {side: Range1d(start=0, end=1) for side in ("x", "y")}


def map_of(number: int, shared: Part) -> Part:
    """Make a map: an image, the lines through its cell, and a bar of colours."""
    plot = _figure(f"map{number}", shared["x"], shared["y"], TOOLS)
    image = ColumnDataSource({"image": [np.zeros((1, 1), np.uint32)], "x": [0.0], "y": [0.0], "dw": [1.0], "dh": [1.0]})
    plot.image_rgba(image="image", x="x", y="y", dw="dw", dh="dh", source=image)
    cell = ColumnDataSource({name: [] for name in ("x", "y", "left", "right", "bottom", "top")})
    for colour, width in (("white", 2.5), (INK, 0.8)):
        plot.vspan(x="x", source=cell, line_color=colour, line_width=width, line_alpha=0.6)
        plot.hspan(y="y", source=cell, line_color=colour, line_width=width, line_alpha=0.6)
    for colour, width in (("white", 4.0), ("#d62728", 2.0)):
        plot.quad("left", "right", "top", "bottom", source=cell, fill_alpha=0.0, line_color=colour, line_width=width)
    mapper = LinearColorMapper(palette=Viridis256, low=0, high=1)
    bar = ColorBar(
        color_mapper=mapper,
        ticker=_ticker(f"map{number}.bar"),
        formatter=_formatter(f"map{number}.bar"),
        width=12,
        padding=5,
        major_label_text_font_size=FONT,
        border_line_color=None,
        bar_line_color="#888888",
        scale_alpha=1.0,
    )
    plot.add_layout(bar, "right")
    _dress(plot, "map.x", "map.y")
    _listen(plot, f"'map', {number}")
    return {"figure": plot, "image": image, "cell": cell, "mapper": mapper, "bar": bar}


def section_of(number: int, side: str) -> Part:
    """Make a section: the values along one axis through the cell, or over a parameter."""
    plot = _figure(
        f"section{number}{side}", Range1d(start=0, end=1), Range1d(start=0, end=1), "pan,box_zoom,reset,save"
    )
    lines = ColumnDataSource({name: [] for name in ("xs", "ys", "colour", "dash", "width")})
    plot.multi_line("xs", "ys", source=lines, line_color="colour", line_dash="dash", line_width="width")
    dots = ColumnDataSource({name: [] for name in ("x", "y", "marker", "size", "fill", "colour")})
    plot.scatter(
        "x", "y", source=dots, marker="marker", size="size", fill_color="fill", line_color="colour", line_width=1.2
    )
    here = ColumnDataSource({"x": [], "y": [], "at": []})
    plot.vspan(x="at", source=here, line_color="#888888", line_width=0.8, line_alpha=0.6)
    plot.scatter("x", "y", source=here, size=10, fill_color="#d62728", line_color="white", line_width=1.5)
    _dress(plot, f"section{number}{side}.x", f"section{number}{side}.y")
    _listen(plot, f"'section{side}', {number}")
    return {"figure": plot, "lines": lines, "dots": dots, "here": here}


def plane_of(number: int, x: str, y: str) -> Part:
    """Make a plane of curves, one variable over another."""
    own = ranges()
    plot = _figure(f"plane{number}", own["x"], own["y"], TOOLS)
    lines = ColumnDataSource({name: [] for name in ("xs", "ys", "colour", "dash", "width")})
    plot.multi_line("xs", "ys", source=lines, line_color="colour", line_dash="dash", line_width="width")
    _dress(plot, f"plane{number}.x", f"plane{number}.y")
    return {"figure": plot, "lines": lines, "x": x, "y": y}


def _figure(name: str, x: Range1d, y: Range1d, tools: str) -> figure:
    """Make a figure that fills its place in the page."""
    plot = figure(
        name=name,
        x_range=x,
        y_range=y,
        tools=tools,
        active_drag=None,  # a finger that moves the page must not be caught
        sizing_mode="stretch_both",
        toolbar_location="above",
        output_backend="canvas",
        min_border=4,
        min_border_left=LEFT,
        min_border_right=RIGHT,
        border_fill_color=None,  # the script sets both: a first coat of white would shimmer through on a dark page
        background_fill_color=None,
    )
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    return plot


def _dress(plot: figure, x: str, y: str) -> None:
    """Give the axes of a figure the ticks of the script, and a size at which they can be read."""
    for axis, place in ((plot.xaxis[0], x), (plot.yaxis[0], y)):
        axis.ticker = _ticker(place)
        axis.formatter = _formatter(place)
        axis.axis_label_text_font_size = FONT
        axis.axis_label_text_font_style = "normal"
        axis.axis_label_text_color = INK
        axis.major_label_text_font_size = FONT
        axis.major_label_text_color = INK
        axis.minor_tick_line_color = None
    plot.grid.grid_line_color = "#e5e5e5"
    plot.outline_line_color = "#888888"


def _ticker(place: str) -> CustomJSTicker:
    """Make a ticker that asks the script."""
    return CustomJSTicker(major_code=f"return explorer.ticks('{place}', cb_data.start, cb_data.end)")


def _formatter(place: str) -> CustomJSTickFormatter:
    """Make a formatter that asks the script."""
    return CustomJSTickFormatter(code=f"return explorer.tickWords('{place}', tick)")


def _listen(plot: figure, which: str) -> None:
    """Report the script of a pointer that moves, taps or leaves."""
    for event, word in (("mousemove", "hover"), ("tap", "tap"), ("doubletap", "tap")):  # a second tap at once is a tap
        plot.js_on_event(event, CustomJS(code=f"explorer.{word}({which}, cb_obj)"))
