"""One variable of a dataset of points, over one parameter."""

from typing import Final

import numpy as np
import xarray
from matplotlib.figure import SubFigure

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.reader import is_turned
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.dataset.read.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import SOLVER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.doubts import BOUND, at_bound, doubts_in, entries
from gradhesion.cli.picture.labels import effective, equation, label, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.scales import scale
from gradhesion.cli.picture.values import panels
from gradhesion.cli.picture.values.bands import band_entry, band_of
from gradhesion.cli.picture.values.density import draw_density, number_scenes
from gradhesion.cli.picture.values.layout import seen
from gradhesion.cli.picture.values.levels import levels_of, levels_of_flags, levels_of_names, limited
from gradhesion.cli.picture.values.part import Part

DENSE: Final = 2000
"""Points that can still be seen one by one; more are drawn as their number in small cells."""


def draw_scenes(
    part: SubFigure,
    dataset: xarray.Dataset,
    name: str,
    over: str | None,
    looks: Looks = PLAIN,
) -> Part:
    """Draw a variable of points over a parameter, that with the most values if none is asked for."""
    variable = dataset[name]
    known = effective(variable)
    varying = [key for key in known if np.unique(variable[key].values).size > 1]
    if not varying:
        raise DatasetError(
            f"{name}: no parameter varies, so there is nothing to draw over; `gradhesion info` shows its value"
        )
    along = over or max(varying, key=lambda key: np.unique(variable[key].values).size)
    dataset = seen(dataset, along, looks.xlim)
    variable, status = dataset[name], dataset["status"]
    values = variable.values.astype(float)
    if not np.isfinite(values).any():
        raise DatasetError(f"{name}: no value in any scene drawn; `gradhesion info` reports why")
    x = scale(variable[along].values, along, looks.xlim)
    solvers = [str(one) for one in np.atleast_1d(variable[SOLVER].values)] if SOLVER in variable.coords else [""]
    finite = values[np.isfinite(values)]
    values = np.where(np.isfinite(values), values, np.nan)
    flags = np.atleast_2d(np.where(np.isnan(values), 0, status.values))[:, x.order]
    doubts = doubts_in(flags, name, turned=is_turned(dataset))
    if name == "status":
        codes = np.unique(finite)
        values = np.where(np.isnan(values), np.nan, np.searchsorted(codes, values))
        levels = levels_of_flags(codes, looks)
    elif labels := parameters_of(variable):
        codes = np.unique(finite)
        values = np.where(np.isnan(values), np.nan, np.searchsorted(codes, values))
        levels = levels_of_names([SYMBOLS[labels[int(code)]] for code in codes], looks)
    else:
        levels = levels_of(float(finite.min()), float(finite.max()), looks=looks)
    dense = values.size > DENSE and not levels.names
    if dense:
        looks.refuse(["band"], f"more than {DENSE:,} points are drawn as their density, which has no bars")
    band = None if dense or levels.names else band_of(dataset, name, Selection(), looks)
    levels = limited(levels, np.append(finite, band.extremes()) if band else finite, name)
    series = dict(zip(solvers, np.atleast_2d(values)[:, x.order], strict=True))
    unit = unit_for(name, finite if levels.names else levels.extremes, log=levels.log)
    grid = part.subplots(1, len(solvers) if dense else 1, sharex=True, sharey=True, squeeze=False)[0]
    doubtful = []
    if dense:
        for axes, (solver, row) in zip(grid, series.items(), strict=True):
            draw_density(axes, x, row, levels, unit)
            axes.set_title(solver if len(solvers) > 1 else "")
        number_scenes(part, grid)
    else:
        doubtful += [(doubt, dict(zip(solvers, doubt.marks(flags), strict=True))) for doubt in doubts]
        met = at_bound(dataset, name)
        if met is not None and bool(met.any()):
            doubtful.append((BOUND, dict(zip(solvers, np.atleast_2d(met.values)[:, x.order], strict=True))))
        edges = [np.atleast_2d(edge.values)[:, x.order] for edge in (band.low, band.high)] if band else []
        bands = {solver: (edges[0][i], edges[1][i]) for i, solver in enumerate(solvers)} if band else None
        panels.draw_points(grid[0], x, series, levels, unit, doubtful, bands)
    for axes in grid:
        axes.set_xlabel(label(along, x.unit))
        axes.set_ylabel("" if levels.names else label(name, unit))
        axes.label_outer()
    width = (4.2 if len(grid) == 1 else 3.0 * len(grid)) + (1.6 if levels.names else 0.0)
    caption = [equation(SOLVER, solvers[0])] if SOLVER in variable.coords and len(solvers) == 1 else []
    caption += [equation(key, np.ravel(variable[key].values)[0]) for key in known if key not in (*varying, along)]
    if others := [SYMBOLS[key] for key in varying if key != along]:
        caption.append("varying too: " + ", ".join(others))
    if dense:
        caption += [f"{int(doubt.marks(flags).sum()):,} scenes: {doubt.words}" for doubt in doubts]
        gaps = int(np.isnan(values).sum())
        caption += [f"{gaps:,} {'scene' if gaps == 1 else 'scenes'} without a value"] if gaps else []
    caption += slope_warnings(dataset)
    shown = [] if dense else entries([doubt for doubt, _ in doubtful], in_map=False, gaps=bool(np.isnan(values).any()))
    shown += [band_entry(band, 0)] if band else []
    return Part(width=width, height=3.1, entries=shown, caption=caption)
