"""Pictures and pages of datasets."""

import io
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import xarray
from matplotlib.figure import Figure

import gradhesion.accessor  # noqa: F401 (registers `dataset.gr`)
from gradhesion.cli.dataset.reader import has_curves
from gradhesion.cli.dataset.selection import selection_of
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.errors import DatasetError, MissingExtraError, OutputError
from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names import SCENE, SOLVER
from gradhesion.cli.picture.curve_picture import drawn_curves
from gradhesion.cli.picture.picture import drawn
from gradhesion.cli.picture.pictured import styled
from gradhesion.datasets import Data, data_of
from gradhesion.wording import in_python


def plot(
    dataset: Data,
    variables: Sequence[str] | str | None = None,
    *,
    at: Mapping[str, Any] | None = None,
    over: Mapping[str, str] | None = None,
    interpolate: bool = False,
    x: str | None = None,
    y: str | None = None,
) -> Figure:
    r"""
    Draw a dataset: lines over one axis, a map over two, panels of maps over more; curves as curves.

    Parameters
    ----------
    dataset
        A dataset, or the path of its file.
    variables
        What to draw, by name; the force and the energy if None.
    at
        Axes fixed at the value nearest to this one: {"A": 0.02, "R": "2 um", "solver": "exact"}.
    over
        Axes reduced by "max", "min" or "mean", or to the place of an extreme by "argmax" or "argmin": {"k": "max"}.
    interpolate
        Whether `at` interpolates between two values.
    x, y
        The axes along the sides of a panel.

    Returns
    -------
    The figure of matplotlib, not of pyplot: a notebook shows it, `figure.savefig("map.pdf")` keeps it, `figure.axes`
    are its panels, to be changed.

    Raises
    ------
    DatasetError
        The dataset is none of this program, lacks what is asked for, or nothing varies in it.

    Examples
    --------
    >>> import gradhesion as gr
    >>> punch = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, A=0.01, a_max_over_R=1.0)
    >>> lines = gr.solve(punch, lambda_over_R=[0.1, 0.2, 0.4])
    >>> print(*(panel.get_xlabel() for panel in gr.plot(lines, "pull_off_force").axes))
    $\lambda/R$
    """
    names = _listed(variables)
    with in_python(), data_of(dataset) as values:
        _check_dimensions(values)
        selection = selection_of(values, _wishes(at), _wishes(over), interpolate=interpolate)
        if not has_curves(values):
            figure = drawn(values, names, selection, x=x, y=y)
        elif given := [word for word, on in (("over", over), ("x", x), ("y", y), ("interpolate", interpolate)) if on]:
            raise DatasetError(f"{given[0]}: curves are drawn as they are; choose scenes with at")
        else:
            figure = drawn_curves(selection.narrowed(values), names)
    vars(figure)["_repr_png_"] = partial(_png, figure)
    return figure


def explore(
    dataset: Data,
    file: str | Path | None = None,
    *,
    variables: Sequence[str] | str | None = None,
    at: Mapping[str, Any] | None = None,
    overwrite: bool = False,
) -> Path:
    """
    Write a dataset as one page with maps, sections and sliders, for any browser.

    Parameters
    ----------
    dataset
        A dataset, or the path of its file.
    file
        The page, .html; beside the file of the dataset if None.
    variables
        What to take, by name; everything if None.
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
        The dataset is none of this program, lacks what is asked for, is too large for a page, or nothing varies in it.
    OutputError
        The page exists or cannot be written.
    MissingExtraError
        Bokeh is not installed.
    """
    try:
        from gradhesion.cli.explorer.page import page  # noqa: PLC0415 (Bokeh)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in {"bokeh", "jinja2"}:
            raise
        raise MissingExtraError("explore needs Bokeh: install it with `pip install bokeh`") from None
    if file is None and isinstance(dataset, xarray.Dataset):
        raise OutputError(
            'a page of a dataset in memory needs a name; write for example gr.explore(dataset, "map.html")'
        )
    path = Path(dataset).with_suffix(".html") if file is None else Path(file)
    if path.suffix.lower() not in {".html", ".htm"}:
        raise OutputError(f"{path}: the name of a page ends in .html")
    with in_python(), data_of(dataset) as values, replacement(path, overwrite=overwrite) as temporary:
        _check_dimensions(values)
        name = str(values.attrs["title"]) if isinstance(dataset, xarray.Dataset) else Path(dataset).name
        text = page(values, name, _listed(variables), _wishes(at))
        with writing(path):
            temporary.write_text(text, encoding="utf-8")
    return path


def _check_dimensions(dataset: xarray.Dataset) -> None:
    """Refuse dimensions that no picture knows."""
    others = [str(dim) for dim in dataset["status"].dims if dim not in (*INPUTS, SCENE, SOLVER)]
    if others:
        raise DatasetError(
            f"the dataset: its dimension {others[0]} is no parameter, and pictures are drawn over parameters; draw it "
            f'with xarray, as in dataset["pull_off_force"].plot(x="{others[0]}"), or name a list of points "{SCENE}"'
        )


def _listed(names: Sequence[str] | str | None) -> list[str]:
    """Give names as a list."""
    return [names] if isinstance(names, str) else [*(names or ())]


def _wishes(wishes: Mapping[str, Any] | None) -> list[str]:
    """Write wishes as a command takes them."""
    return [f"{axis}={value}" for axis, value in (wishes or {}).items()]


def _png(figure: Figure) -> bytes:
    """Draw a figure for a notebook."""
    content = io.BytesIO()
    with styled():
        figure.savefig(content, format="png")
    return content.getvalue()
