"""The curves of a dataset, taken out of their padding, and the planes that they are drawn in."""

from itertools import groupby
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from numpy.typing import NDArray

from figures.style import DEPTH, INK, LOAD, RADIUS, zero_lines

Values = NDArray[np.float64]

PLANES: Final = {"a": ("indentation", "load"), "b": ("contact_radius", "indentation"), "c": ("contact_radius", "load")}
"""Abscissa and ordinate of the three panels of a path."""

LABELS: Final = {"contact_radius": RADIUS, "indentation": DEPTH, "load": LOAD}


def values_of(dataset: xarray.Dataset, *names: str) -> list[Values]:
    """Return variables of one curve of one scene, without the padding of its end."""
    columns = [np.asarray(dataset[name].values, dtype=float).ravel() for name in names]
    there = ~np.isnan(columns[0])
    return [column[there] for column in columns]


def plane_of(dataset: xarray.Dataset, prefix: str, plane: str) -> tuple[Values, Values]:
    """Return abscissa and ordinate of a curve; its variables begin with a prefix."""
    x, y = values_of(dataset, *(prefix + name for name in PLANES[plane]))
    return x, y


def dress(axes: Axes, plane: str) -> None:
    """Name the axes of a plane, and mark their zeros."""
    x, y = PLANES[plane]
    axes.set(xlabel=LABELS[x], ylabel=LABELS[y])
    zero_lines(axes, upright=x == "indentation")
    if x == "contact_radius":
        axes.set_xlim(left=0.0)


def draw_equilibrium(axes: Axes, dataset: xarray.Dataset, plane: str, **looks: Any) -> None:
    """Draw the equilibrium curve: the stable parts as lines, the unstable ones dotted."""
    x, y = plane_of(dataset, "", plane)
    (stable,) = (values > 0.5 for values in values_of(dataset, "stable"))
    looks = {"color": INK, "lw": 1.0, **looks}
    kept = stable.copy()
    kept[1:] |= stable[:-1]  # a branch ends at its fold
    kept[:-1] |= stable[1:]
    axes.plot(x, np.where(kept, y, np.nan), **looks)
    axes.plot(x, np.where(stable, np.nan, y), **(looks | {"ls": (0, (1, 1)), "lw": 0.8 * looks["lw"]}))


def draw_path(
    axes: Axes, dataset: xarray.Dataset, plane: str, loading: Any, unloading: Any, width: float = 0.8
) -> None:
    """Draw the path: loading broad, unloading narrow over it, so that both show where they are one; jumps dashed."""
    x, y = plane_of(dataset, "path_", plane)
    flags = np.column_stack(values_of(dataset, "path_jump", "path_unloading"))
    for (jump, back), run in groupby(range(1, x.size), key=lambda i: tuple(flags[i])):  # of lines i-1 to i
        lines = list(run)
        first, last = lines[0], lines[-1]
        looks = {"color": unloading, "lw": width, "zorder": 2.2} if back else {"color": loading, "lw": 2.4 * width}
        dashed = {"ls": (0, (3, 1.5)), "lw": width} if jump else {}
        axes.plot(x[first - 1 : last + 1], y[first - 1 : last + 1], **(looks | dashed))
