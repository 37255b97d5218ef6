"""Which axis of a dataset goes where in its picture, and which of its values are drawn."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import Selection, axes_of, check_axis, is_log
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.picture.looks import Kind
from gradhesion.cli.picture.spans import Span

PANELS: Final = 3
"""Panels along a row or a column: the ends of an axis and its middle."""

LINES: Final = 6
"""An axis of no more values than this is a set of lines rather than a side of a map; more lines look alike."""

MOST: Final = 1000
"""Values along a side of a panel: more are finer than paper."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Which axis of a dataset goes where in its picture."""

    x: str
    second: str | None
    """The other side of a map, or what distinguishes the lines of a panel."""
    is_map: bool
    columns: str | None
    rows: str | None
    middle: tuple[str, ...]
    """Axes with no place of their own: they stay at their middle value."""


def plan_of(
    sizes: Mapping[str, int], x: str | None = None, y: str | None = None, kind: Kind | None = None
) -> Plan | None:
    """
    Give the finest axes to the panels, the next two to columns and rows; None if nothing varies.

    Solvers are the lines of a panel if nothing else is, and columns otherwise. What is asked for comes first.

    Raises
    ------
    DatasetError
        A map is asked for, and one axis alone varies.

    >>> plan_of({"k": 7, "A": 1, "lambda_over_R": 200})
    Plan(x='lambda_over_R', second='k', is_map=True, columns=None, rows=None, middle=())
    >>> plan_of({"k": 7, "A": 3, "lambda_over_R": 200}, x="k", y="A")
    Plan(x='k', second='A', is_map=True, columns='lambda_over_R', rows=None, middle=())
    """
    varying = sorted((name for name, size in sizes.items() if size > 1), key=lambda name: -sizes[name])
    others = [name for name in varying if name not in (SOLVER, x, y)]
    free = [x or others.pop(0)] if x or others else []
    if y and free:
        free.append(y)
    free += others
    if not free:
        return None
    if SOLVER in varying:
        free.insert(2, SOLVER)
    places: list[str | None] = [*free, None, None, None]
    first, second, columns, rows = free[0], *places[1:4]
    if kind == "map" and second in (None, SOLVER):
        raise DatasetError(f"--map: a map needs two axes that vary, and here {first} alone does; use --lines")
    is_map = second not in (None, SOLVER) and (kind or ("map" if y or sizes[second] > LINES else "lines")) == "map"
    return Plan(x=first, second=second, is_map=is_map, columns=columns, rows=rows, middle=tuple(free[4:]))


def placed(dataset: xarray.Dataset, selection: Selection, x: str | None, y: str | None) -> xarray.Dataset:
    """
    Check the axes that are asked for as x and y; a parameter that follows from one axis alone takes its place.

    Raises
    ------
    DatasetError
        One is not an axis, does not vary, or is taken otherwise.
    """
    if y and SCENE in dataset.dims:
        raise DatasetError(f"--y {y}: points are drawn over one parameter; choose it with --x")
    if x and x == y:
        raise DatasetError(f"--x {x} --y {y}: one axis cannot be both sides; choose another for one of them")
    for option, name in (("--x", x), ("--y", y)):
        if name is None:
            continue
        requested = f"{option} {name}"
        if name in {*selection.fixed, *selection.over, *(one.axis for one in selection.between)}:
            raise DatasetError(f"{requested}: {name} is fixed or reduced by --at or --over; remove one of the two")
        if name == SOLVER:
            raise DatasetError(f"{requested}: solvers are always lines or panels; choose a parameter")
        own = dataset[name].dims if name in dataset.coords else ()
        if len(own) == 1 and own[0] not in (name, SCENE) and own[0] not in selection.over:
            if not np.isfinite(dataset[name].values).all():
                raise DatasetError(f"{requested}: it has no finite value in some scenes; choose {own[0]}")
            dataset = dataset.swap_dims({own[0]: name})
        elif name not in axes_of(dataset) or np.unique(dataset[name].values).size < 2:
            check_axis(dataset, requested, name)
            raise DatasetError(f"{requested}: it has one value only; choose an axis that varies")
    return dataset


def items_of(sizes: Mapping[str, int], plan: Plan) -> dict[str, Any]:
    """Choose what is drawn of each axis: some values in panels, the middle where there is no place, else nearly all."""
    items: dict[str, Any] = {axis: sizes[axis] // 2 for axis in plan.middle}
    most = {plan.x: MOST, plan.second: MOST if plan.is_map else LINES, plan.columns: PANELS, plan.rows: PANELS}
    for axis, number in most.items():
        if axis is not None and sizes[axis] > number:
            items[axis] = sorted({round(item) for item in np.linspace(0, sizes[axis] - 1, number)})
    return items


def seen(dataset: xarray.Dataset, axis: str, span: Span) -> xarray.Dataset:
    """
    Keep what is between the limits of an axis, and one value beyond each, so that lines run to the frame.

    Raises
    ------
    DatasetError
        The limits cannot be read, or nothing is between them.
    """
    values = np.asarray(dataset[axis].values, dtype=float)
    finite: NDArray[np.float64] = np.unique(values[np.isfinite(values)])
    if not span or not finite.size:
        return dataset
    low, high = span.within(axis, finite[0], finite[-1], log=is_log(finite))
    first = finite[max(0, int(np.searchsorted(finite, low, side="right")) - 1)]
    last = finite[min(finite.size - 1, int(np.searchsorted(finite, high)))]
    kept = (values >= first) & (values <= (last if np.isfinite(high) else np.inf))
    return dataset.isel({dataset[axis].dims[0]: kept})
