"""Which axis of a dataset of values goes where in its picture, which of them are drawn, and what is said of others."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import Selection, axes_of, check_axis, is_log
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import effective, equations, fixed
from gradhesion.cli.picture.looks import Looks, limits_of
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
    """Which axis of a dataset goes where in its picture; the second is the lines of a panel or a side of a map."""

    x: str
    second: str | None = None
    columns: str | None = None
    rows: str | None = None
    middle: Sequence[str] = ()
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

    def arrange(self, values: xarray.DataArray) -> NDArray[Any]:
        """Put values over rows, columns, the second side of a panel and the first: one item where there is no axis."""
        over = [self.rows, self.columns, self.second, self.x]
        own = values.squeeze([axis for axis in values.dims if axis not in over]).transpose(*filter(None, over))
        return own.values.reshape([own.sizes[axis] if axis else 1 for axis in over])


def planned(dataset: xarray.Dataset, selection: Selection, looks: Looks) -> tuple[xarray.Dataset, Plan]:
    """Choose which axis of a narrowed dataset goes where; a parameter that is asked for takes the place of its axis."""
    x, y = looks.x, looks.y
    gone = {*selection.over, *(one.axis for one in selection.between)}
    for option, name in (("--x", x), ("--y", y)):
        dataset = _placed(dataset, f"{option} {name}", name, {*selection.fixed, *gone}) if name else dataset
    if SCENE not in dataset.dims:
        sizes = {str(axis): size for axis, size in dataset["status"].sizes.items() if axis not in gone}
        return dataset, plan_of(sizes, x, y, looks.kind)
    looks.refuse(["y", "kind"], "points are drawn as points over one parameter, which --x chooses")
    values = {key: np.unique(dataset[key].values).size for key in effective(dataset)}
    along = x or max(values, key=lambda key: values[key], default="")
    if values.get(along, 0) < 2:
        raise DatasetError("no parameter varies, so there is nothing to draw over; `gradhesion info` shows the values")
    count = dataset["status"].size
    solvers = SOLVER if dataset.sizes.get(SOLVER, 1) > 1 else None
    sides = (None, solvers) if count > DENSE else (solvers, None)
    return dataset.swap_dims({SCENE: along}), Plan(x=along, points=count, second=sides[0], columns=sides[1])


def _placed(dataset: xarray.Dataset, option: str, name: str, taken: Collection[str]) -> xarray.Dataset:
    """Check an axis that is asked for; a parameter that follows from one axis alone takes its place."""
    if name in taken:
        raise DatasetError(f"{option}: {name} is fixed or reduced by --at or --over; remove one of the two")
    if name == SOLVER:
        raise DatasetError(f"{option}: solvers are always lines or panels; choose a parameter")
    own = dataset[name].dims if name in dataset.coords else ()
    if len(own) == 1 and own[0] not in (name, SCENE, *taken):
        if not np.isfinite(dataset[name].values).all():
            raise DatasetError(f"{option}: it has no finite value in some scenes; choose {own[0]}")
        return dataset.swap_dims({own[0]: name})
    if name not in axes_of(dataset) or np.unique(dataset[name].values).size < 2:
        check_axis(dataset, option, name)
        raise DatasetError(f"{option}: it has one value only; choose an axis that varies")
    return dataset


def plan_of(
    sizes: Mapping[str, int], x: str | None = None, y: str | None = None, kind: Literal["lines", "map"] | None = None
) -> Plan:
    """Give the finest axes to the panels, the next two to columns and rows.

    Solvers are the lines of a panel if nothing else is, and columns otherwise. What is asked for comes first.

    >>> plan_of({"k": 7, "A": 1, "lambda_over_R": 200}).places
    ['lambda_over_R', 'k']
    >>> plan_of({"k": 7, "A": 3, "lambda_over_R": 200}, x="k", y="A").places
    ['k', 'A', 'lambda_over_R']
    """
    varying = sorted((name for name, size in sizes.items() if size > 1), key=lambda name: -sizes[name])
    others = [name for name in varying if name not in (SOLVER, x, y)]
    if not (x or others):
        raise DatasetError("nothing varies, so there is nothing to draw over; fix fewer axes, or see `gradhesion info`")
    free = [x or others.pop(0), *([y] if y else []), *others]
    if SOLVER in varying:
        free.insert(2, SOLVER)
    first, second, columns, rows, *_ = [*free, None, None, None]
    has_sides = second not in (None, SOLVER)
    if kind == "map" and not has_sides:
        raise DatasetError(f"--map: a map needs two axes that vary, and here {first} alone does; use --lines")
    is_map = has_sides and (kind or ("map" if y or sizes[str(second)] > LINES else "lines")) == "map"
    return Plan(x=str(first), second=second, columns=columns, rows=rows, middle=tuple(free[4:]), is_map=is_map)


def within(dataset: xarray.Dataset, plan: Plan, looks: Looks) -> xarray.Dataset:
    """Put values into rising order along the sides of a panel, and keep those between the limits."""
    for axis, span in ((plan.x, looks.xlim), (plan.second, looks.ylim if plan.is_map else "")):
        if not axis or axis == SOLVER:
            continue
        dataset = dataset.sortby(axis)
        values = np.asarray(dataset[axis].values, dtype=float)
        finite = values[np.isfinite(values)]
        if span and finite.size:  # and one value beyond each, so that lines run to the frame
            low, high = limits_of(span, axis, finite[0], finite[-1], log=is_log(finite))
            first, last = max(0, np.searchsorted(finite, low, side="right") - 1), np.searchsorted(finite, high) + 1
            dataset = dataset.isel({axis: slice(first, min(last, finite.size) if np.isfinite(high) else None)})
    return dataset


def some_of(dataset: xarray.Dataset, plan: Plan) -> xarray.Dataset:
    """Choose what is drawn of each axis: some values in panels, the middle where there is no place, else nearly all.

    Panels that are some of many leave the value out at which a side of theirs has no effect, as that of smooth punches.
    """
    items: dict[str, Any] = {axis: dataset.sizes[axis] // 2 for axis in plan.middle}
    most = dict.fromkeys((plan.columns, plan.rows), PANELS)
    most |= {plan.x: plan.points or MOST, plan.second: MOST if plan.is_map else LINES}
    idle = {INPUTS[INPUTS[side].gives].idle_without for side in (plan.x, plan.second) if side in INPUTS}
    for axis, number in most.items():
        if axis and dataset.sizes[axis] > number:
            known = np.arange(dataset.sizes[axis])
            if number == PANELS and axis in INPUTS and INPUTS[axis].gives in idle:
                known = known[dataset[axis].values != 0.0]
            items[axis] = np.unique(known[np.linspace(0, known.size - 1, number).round().astype(int)])
    return dataset.isel(items)


def caption_of(part: xarray.Dataset, whole: xarray.Dataset, plan: Plan, selection: Selection) -> Iterator[str]:
    """Write the parameters that are not drawn, and what stands for the axes that are fixed, reduced or cut."""
    between = {one.axis: one.value for one in selection.between}
    yield from (f"{equations(name, value)[0]} (interpolated)" for name, value in between.items())
    yield from fixed(part, whole, [*plan.places, *selection.over, *between])
    yield from (f"{how} over {SYMBOLS[axis]}" for axis, how in selection.over.items())
    for axis in (plan.x, plan.second):
        if axis and part.sizes[axis] < whole.sizes[axis]:
            yield f"{part.sizes[axis]:,} of {whole.sizes[axis]:,} values of {SYMBOLS[axis]}"
