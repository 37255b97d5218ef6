"""Which axis of a dataset of values goes where in its picture, and which of its values are drawn."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import Selection, axes_of, check_axis, is_log
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.picture.labels import effective
from gradhesion.cli.picture.looks import Kind
from gradhesion.cli.picture.spans import Span
from gradhesion.core.problem.inputs import INPUTS

PANELS: Final = 3
"""Panels along a row or a column: the ends of an axis and its middle."""

LINES: Final = 6
"""An axis of no more values than this is a set of lines rather than a side of a map; more lines look alike."""

MOST: Final = 1000
"""Values along a side of a panel: more are finer than paper."""

DENSE: Final = 2000
"""Points that can still be seen one by one; more are drawn as their number in small cells."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Which axis of a dataset goes where in its picture."""

    x: str
    second: str | None = None
    """The other side of a map, or what distinguishes the lines of a panel."""
    columns: str | None = None
    rows: str | None = None
    middle: tuple[str, ...] = ()
    """Axes with no place of their own: they stay at their middle value."""
    is_map: bool = False
    points: int = 0
    """Of scenes that are no grid: how many there are."""

    @property
    def is_dense(self) -> bool:
        """Report whether points are too many to be seen one by one."""
        return self.points > DENSE

    @property
    def places(self) -> list[str]:
        """List the axes that have a place."""
        return [axis for axis in (self.x, self.second, self.columns, self.rows) if axis]


def plan_of(
    sizes: Mapping[str, int], x: str | None = None, y: str | None = None, kind: Kind | None = None
) -> Plan | None:
    """
    Give the finest axes to the panels, the next two to columns and rows; None if nothing varies.

    Solvers are the lines of a panel if nothing else is, and columns otherwise. What is asked for comes first.

    >>> plan_of({"k": 7, "A": 1, "lambda_over_R": 200}).places
    ['lambda_over_R', 'k']
    >>> plan_of({"k": 7, "A": 3, "lambda_over_R": 200}, x="k", y="A").places
    ['k', 'A', 'lambda_over_R']
    """
    varying = sorted((name for name, size in sizes.items() if size > 1), key=lambda name: -sizes[name])
    others = [name for name in varying if name not in (SOLVER, x, y)]
    free = [x or others.pop(0)] if x or others else []
    if not free:
        return None
    free += [y] if y else []
    free += others
    if SOLVER in varying:
        free.insert(2, SOLVER)
    first, second, columns, rows, *_ = [*free, None, None, None]
    if kind == "map" and second in (None, SOLVER):
        raise DatasetError(f"--map: a map needs two axes that vary, and here {first} alone does; use --lines")
    is_map = second not in (None, SOLVER) and (kind or ("map" if y or sizes[second] > LINES else "lines")) == "map"
    return Plan(x=str(first), second=second, columns=columns, rows=rows, middle=tuple(free[4:]), is_map=is_map)


def plan_of_points(dataset: xarray.Dataset, name: str, x: str | None) -> Plan:
    """Put points over a parameter, that with the most values if none is asked for; solvers are told apart."""
    values = {key: np.unique(dataset[key].values).size for key in effective(dataset)}
    varying = [key for key, size in values.items() if size > 1]
    if not varying:
        raise DatasetError(
            f"{name}: no parameter varies, so there is nothing to draw over; `gradhesion info` shows its value"
        )
    solvers = SOLVER if dataset.sizes.get(SOLVER, 1) > 1 else None
    count = dataset["status"].size
    along = x or max(varying, key=lambda key: values[key])
    if count > DENSE:
        return Plan(x=along, points=count, columns=solvers)
    return Plan(x=along, points=count, second=solvers)


def placed(dataset: xarray.Dataset, selection: Selection, x: str | None, y: str | None) -> xarray.Dataset:
    """Check the axes that are asked for; a parameter that follows from one axis alone takes its place."""
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


def in_order(dataset: xarray.Dataset, plan: Plan) -> xarray.Dataset:
    """Put the values along the sides of a panel into rising order; points lie along the parameter they are over."""
    if SCENE in dataset.dims:
        dataset = dataset.swap_dims({SCENE: plan.x})
    rising = {}
    for axis in (plan.x, plan.second):
        if axis and axis != SOLVER and (np.diff(dataset[axis].values) < 0.0).any():
            rising[axis] = np.argsort(dataset[axis].values, kind="stable")
    return dataset.isel(rising)


def items_of(dataset: xarray.Dataset, plan: Plan) -> dict[str, Any]:
    """
    Choose what is drawn of each axis: some values in panels, the middle where there is no place, else nearly all.

    Panels that are some of many leave the value out at which a side of theirs has no effect, as that of smooth punches.
    """
    items: dict[str, Any] = {axis: dataset.sizes[axis] // 2 for axis in plan.middle}
    most = {
        plan.x: plan.points or MOST,
        plan.second: MOST if plan.is_map else LINES,
        plan.columns: PANELS,
        plan.rows: PANELS,
    }
    idle = {INPUTS[INPUTS[side].gives].idle_without for side in (plan.x, plan.second) if side in INPUTS}
    for axis, number in most.items():
        if axis is None or dataset.sizes[axis] <= number:
            continue
        known = np.arange(dataset.sizes[axis])
        if axis in (plan.columns, plan.rows) and axis in INPUTS and INPUTS[axis].gives in idle:
            known = known[dataset[axis].values != 0.0]
        items[axis] = np.unique(known[np.linspace(0, known.size - 1, number).round().astype(int)])
    return items


def seen(dataset: xarray.Dataset, axis: str, span: Span) -> xarray.Dataset:
    """Keep what is between the limits of an axis, and one value beyond each, so that lines run to the frame."""
    values = np.asarray(dataset[axis].values, dtype=float)
    finite: NDArray[np.float64] = np.unique(values[np.isfinite(values)])
    if not span or not finite.size:
        return dataset
    low, high = span.limits(axis, finite[0], finite[-1], log=is_log(finite))
    first = finite[max(0, int(np.searchsorted(finite, low, side="right")) - 1)]
    last = finite[min(finite.size - 1, int(np.searchsorted(finite, high)))]
    kept = (values >= first) & (values <= (last if np.isfinite(high) else np.inf))
    return dataset.isel({dataset[axis].dims[0]: kept})
