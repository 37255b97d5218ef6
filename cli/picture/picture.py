"""The right picture for a dataset: of values, of curves or of fits."""

from collections.abc import Callable, Sequence
from pathlib import Path

import xarray
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.reader import has_curves, is_fit
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import PARETO_POINT
from gradhesion.cli.picture.curves import drawn_curves
from gradhesion.cli.picture.fits import drawn_fits
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.values import draw_fronts, drawn


def picture_of(
    dataset: xarray.Dataset,
    variables: Sequence[str],
    looks: Looks,
    *,
    at: Sequence[str] = (),
    over: Sequence[str] = (),
    interpolate: bool = False,
    x: str | None = None,
    y: str | None = None,
    data: Path | None = None,
    notes: Callable[[str], None] = lambda _: None,
) -> Figure:
    """Draw a dataset of any kind, as `gradhesion plot` and `gr.plot` do.

    Axes are fixed or reduced by `at` and `over`, as options write them; `notes` takes what is to be known of that.
    """
    if is_fit(dataset):
        choices = {"--over": over, "--variable": variables, "--x": x, "--y": y, "--data": data}
        return drawn_fits(dataset, looks, [word for word, value in choices.items() if value], at)
    selection = selection_of(dataset, at, over, interpolate=interpolate)
    for note in selection.notes:
        notes(note)
    if not has_curves(dataset):
        if data is not None:
            raise DatasetError(f"--data {data}: measured points go on curves, and this is a map; leave it out")
        draw = draw_fronts if PARETO_POINT in dataset.dims else drawn
        return draw(dataset, variables, selection, x, y, looks)
    if of_maps := [word for word, on in (("--over", over), ("--interpolate", interpolate)) if on]:
        raise DatasetError(f"{of_maps[0]}: curves are drawn as they are; choose scenes with --at")
    return drawn_curves(selection.narrowed(dataset), variables, x, y, looks, data, notes)
