"""Pictures and pages of datasets."""

import io
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Literal

import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import gradhesion.accessor  # noqa: F401 (registers `dataset.gr`)
from gradhesion.cli.errors import OutputError
from gradhesion.cli.installation import checked
from gradhesion.cli.picture.looks import Looks, looks_of
from gradhesion.cli.picture.picture import picture_of
from gradhesion.cli.picture.pictured import styled
from gradhesion.cli.study.text.quantities import as_written
from gradhesion.datasets import Data, data_of

Limits = tuple[float | str | None, float | str | None]
"""Two ends of a part of an axis: numbers in SI, quantities, or None for all there is."""

BAR: Final = "<colorbar>"
"""What matplotlib labels the axes of a colour bar."""
_WAITING: Final[list[Any]] = []
"""Pictures of this cell that have not been shown."""


class Panels(list[Axes]):
    """The axes of a picture; a notebook shows their figure once, at the end of the cell that draws it."""

    def __init__(self, figure: Figure, looks: Looks) -> None:
        super().__init__(axes for axes in figure.axes if axes.get_label() != BAR)
        self.figure = figure
        self._looks = looks
        _show_later(self)

    def savefig(self, file: Any, **options: Any) -> None:
        """Save the figure in its own style, as `matplotlib.figure.Figure.savefig`."""
        with styled(self._looks):
            self.figure.savefig(file, **options)

    def _repr_png_(self) -> bytes:
        """Draw the figure for a notebook."""
        _WAITING[:] = [one for one in _WAITING if one is not self]
        content = io.BytesIO()
        self.savefig(content, format="png")
        return content.getvalue()


def plot(
    dataset: Data,
    variables: Sequence[str] | str | None = None,
    *,
    at: Mapping[str, Any] | None = None,
    over: Mapping[str, str] | None = None,
    interpolate: bool = False,
    x: str | None = None,
    y: str | None = None,
    kind: Literal["lines", "map"] | None = None,
    width: float | str | None = None,
    height: float | str | None = None,
    colour_map: str | None = None,
    levels: int | str | Sequence[float | str] | None = None,
    labels: bool = True,
    title: bool | str = True,
    caption: bool = True,
    xlabel: str | None = None,
    ylabel: str | None = None,
    clabel: str | None = None,
    style: str | Path | None = None,
    data: str | Path | None = None,
    xlim: Limits | None = None,
    ylim: Limits | None = None,
    band: Literal["quantiles", "std", "none"] | None = None,
) -> Panels:
    r"""Draw a dataset: lines over one axis, a map over two, panels of maps over more; curves as curves, a fit whole.

    Parameters
    ----------
    dataset
        A dataset, or the path of its file.
    variables
        Variables to draw, by name; force and energy if None.
    at
        Axes fixed at the value nearest to this one: {"A": 0.02, "R": "2 um", "solver": "exact"}; quantities as in
        `solve`. Of fits of several loops {"loop": 0}, or the name of a file, draws one.
    over
        Axes reduced by "max", "min" or "mean", or to the place of an extreme by "argmax" or "argmin": {"k": "max"}.
    interpolate
        Whether `at` interpolates between two values.
    x, y
        The axes along the sides of a panel; of curves "contact_radius", "indentation" or "load".
    kind
        "lines" or "map" in the place of what the number of values suggests.
    width, height
        The sides of the figure: inches, "8 cm", or as a width "column" (90 mm) or "page" (190 mm).
    colour_map
        A colour map of matplotlib; "viridis" if None.
    levels
        Contour levels: about how many, or which ones: [0.5, 1.0], in SI, or ["10 nJ", "20 nJ"].
    labels
        Whether contours have numbers on them.
    title
        What stands above the panels: the title of the study if True, nothing if False, or words of your own.
    caption
        Whether the parameters that are not drawn are written above the panels.
    xlabel, ylabel, clabel
        What the axes, and the bar of colours of a map, are called, in the place of what is along them. A unit in
        brackets at the end is that of the numbers, "force (nN)"; without one the unit of the numbers is added.
    style
        A style of matplotlib on top of "gradhesion.style", by name or file; "gradhesion.journal" is one.
    data
        On curves: a table (CSV or NetCDF) of measured points, with two or more of the columns indentation, load and
        contact_radius, and their units in the header.
    xlim, ylim
        The parts of the axes that are drawn: (0.1, 0.5), ("50 nm", None). What is seen sets the other axis.
    band
        What is drawn around values of uncertain inputs: "quantiles" (5 % to 95 % of samples), "std" (a standard
        deviation on each side) or "none"; what the dataset has if None. At few values it is bars.

    Returns
    -------
    The axes of the panels, without those of colour bars, to be changed as any axes of matplotlib. A notebook shows
    their figure, which is `figure` and not one of pyplot, once at the end of the cell; `savefig("map.pdf")` saves it.

    Raises
    ------
    DatasetError
        The dataset was not written by this program, lacks what is requested, or nothing varies in it; a size, a colour
        map or a style does not exist.

    Examples
    --------
    >>> import gradhesion as gr
    >>> punch = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, A=0.01, a_max_over_R=1.0)
    >>> lines = gr.solve(punch, lambda_over_R=[0.1, 0.2, 0.4])
    >>> (panel,) = gr.plot(lines, "pull_off_force", width="column", title=False)
    >>> panel.get_xlabel()
    '$\\lambda/R$'
    """
    with data_of(dataset) as values:
        looks = looks_of(
            variables=_listed(variables), at=_wishes(at), over=_wishes(over), interpolate=interpolate, x=x, y=y,
            kind=kind, width=width, height=height, colour_map=colour_map, levels=levels, labels=labels, title=title,
            caption=caption, xlabel=xlabel, ylabel=ylabel, clabel=clabel, style=style, data=data, xlim=xlim, ylim=ylim,
            band=band,
        )  # fmt: skip
        figure = picture_of(values, looks)
    return Panels(figure, looks)


def explore(
    dataset: Data,
    file: str | Path | None = None,
    *,
    variables: Sequence[str] | str | None = None,
    at: Mapping[str, Any] | None = None,
    overwrite: bool = False,
) -> Path:
    """Write a dataset as one page with maps, sections and sliders, for any browser.

    Parameters
    ----------
    dataset
        A dataset, or the path of its file.
    file
        The page, .html; next to the file of the dataset if None.
    variables
        Variables to include, by name; all if None.
    at
        Axes fixed at the value nearest to this one.
    overwrite
        Whether an existing page is replaced.

    Returns
    -------
    The path of the page.

    Raises
    ------
    DatasetError
        The dataset was not written by this program, lacks what is requested, is too large for a page, or nothing varies
        in it.
    OutputError
        The page exists or cannot be written.
    MissingExtraError
        Bokeh is not installed, or too old.
    """
    with checked():
        from gradhesion.cli.explorer.page import write_page  # noqa: PLC0415 (Bokeh)
    if file is None and isinstance(dataset, xarray.Dataset):
        example = 'gr.explore(dataset, "map.html")'
        raise OutputError(f"a page of a dataset in memory needs a name; write for example {example}")
    path = Path(dataset).with_suffix(".html") if file is None else Path(file)
    if path.suffix.lower() not in {".html", ".htm"}:
        raise OutputError(f"{path}: the name of a page ends in .html")
    with data_of(dataset) as values:
        name = str(values.attrs["title"]) if isinstance(dataset, xarray.Dataset) else Path(dataset).name
        write_page(values, name, _listed(variables), _wishes(at), path, overwrite=overwrite)
    return path


def _listed(names: Sequence[str] | str | None) -> list[str]:
    """Give names as a list."""
    return [names] if isinstance(names, str) else [*(names or ())]


def _wishes(wishes: Mapping[str, Any] | None) -> list[str]:
    """Write wishes as a command takes them."""
    return [f"{axis}={as_written(value)}" for axis, value in (wishes or {}).items()]


def _show_later(picture: Any) -> None:
    """Show a picture when the cell that runs has ended, unless it is shown before; outside a notebook do nothing."""
    ipython = sys.modules.get("IPython")
    shell: Any = ipython.get_ipython() if ipython else None
    if getattr(shell, "kernel", None) is None:  # a script, or a terminal
        return
    if _show_all not in shell.events.callbacks["post_execute"]:
        shell.events.register("post_execute", _show_all)
    _WAITING.append(picture)


def _show_all() -> None:
    """Show what waits; each picture notes that it is shown."""
    display = import_module("IPython.display").display  # there in a notebook, and needed nowhere else
    for picture in [*_WAITING]:
        display(picture)
    _WAITING.clear()
