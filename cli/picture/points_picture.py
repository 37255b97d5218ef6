"""One variable of a dataset of points, over one parameter."""

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import SubFigure

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import SOLVER, SYMBOLS
from gradhesion.cli.picture import panels
from gradhesion.cli.picture.doubts import doubts_in, entries
from gradhesion.cli.picture.labels import equation, given, label, unit_for
from gradhesion.cli.picture.pictured import in_lines
from gradhesion.cli.picture.scales import scale


def draw_scenes(
    part: SubFigure, dataset: xarray.Dataset, name: str, over: str | None
) -> tuple[float, float, list[Any]]:
    """Draw a variable of points over a parameter, the first that varies if none is asked for."""
    variable, status = dataset[name], dataset["status"]
    known = given(variable.coords)
    varying = [key for key in known if np.unique(variable[key].values).size > 1]
    if not varying:
        raise DatasetError(
            f"{name}: no parameter varies, so there is nothing to draw over; `gradhesion info` tells its value"
        )
    values = variable.values.astype(float)
    if not np.isfinite(values).any():
        raise DatasetError(f"{name}: no value in any scene; `gradhesion info` tells why")
    along = over or varying[0]
    x = scale(variable[along].values, along)
    axes = part.subplots()
    solvers = np.atleast_1d(variable[SOLVER].values) if SOLVER in variable.coords else [""]
    values = np.where(np.isfinite(values), values, np.nan)
    flags = np.atleast_2d(np.where(np.isnan(values), 0, status.values))[:, x.order]
    doubts = doubts_in(flags, name)
    doubtful = [(doubt, dict(zip(solvers, doubt.marks(flags), strict=True))) for doubt in doubts]
    series = dict(zip(solvers, np.atleast_2d(values)[:, x.order], strict=True))
    finite = values[np.isfinite(values)]
    unit = unit_for(name, finite)
    levels = panels.levels_of(float(finite.min()), float(finite.max()))
    panels.draw_points(axes, x, series, levels, unit, doubtful)
    axes.set_xlabel(label(along, x.unit))
    axes.set_ylabel(label(name, unit))
    told = [equation(SOLVER, str(solvers[0]))] if SOLVER in variable.coords and len(solvers) == 1 else []
    told += [equation(key, variable[key].values[0]) for key in known if key not in (*varying, along)]
    if others := [SYMBOLS[key] for key in varying if key != along]:
        told.append("varying too: " + ", ".join(others))
    part.suptitle(in_lines(told, 4.2), fontsize=8)
    return 4.2, 3.1, entries(doubts, in_map=False, gaps=bool(np.isnan(values).any()))
