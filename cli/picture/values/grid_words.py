"""The words around a grid of scenes: what is drawn, what is not, and what stands for the axes that are reduced."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.read.reductions import Taken
from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.names.scenes import SOLVER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import Unit, effective, equation, label
from gradhesion.cli.picture.values.layout import Plan


def axis_of_place(selection: Selection) -> str | None:
    """Report the axis whose value is drawn, where the place of an extreme is asked for."""
    return next((axis for axis, how in selection.over.items() if how.startswith("arg")), None)


def named_in(name: str, selection: Selection, unit: Unit) -> str:
    """Name what is drawn of a variable."""
    axis = axis_of_place(selection)
    if axis is None:
        return label(name, unit)
    extreme = "maximum" if selection.over[axis] == "argmax" else "minimum"
    return f"{label(axis, unit)} at {extreme} {SYMBOLS[name].split(' $')[0]}"


def caption_of(
    dataset: xarray.Dataset, plan: Plan, items: Mapping[str, Any], selection: Selection, taken: Taken
) -> list[str]:
    """Write the parameters that are not drawn, and what stands for the axes that are fixed or reduced."""
    written = []
    between = {one.axis: one.value for one in selection.between}
    follows = {plan.x, plan.second, plan.columns, plan.rows, *selection.over}
    for name in (SOLVER, *effective(dataset)):
        values = np.atleast_1d(dataset[name].values) if name in dataset.coords else np.empty(0)
        if name in between:
            written.append(f"{equation(name, between[name])} (interpolated)")
        elif name in plan.middle:
            written.append(f"{equation(name, values[values.size // 2])} (one of {values.size})")
        elif values.size == 1 and name not in follows:
            written.append(equation(name, values.item()))
    written += [f"{how} over {SYMBOLS[axis]}" for axis, how in selection.over.items()]
    if taken.left_out:
        written.append(f"{taken.left_out:,} failed {'scene' if taken.left_out == 1 else 'scenes'} left out")
    if taken.flat:
        written.append(f"{taken.flat:,} left out where all values are equal")
    for axis in (plan.x, plan.second):
        if axis and axis in items and axis not in (plan.columns, plan.rows):
            written.append(f"{len(items[axis]):,} of {dataset.sizes[axis]:,} values of {SYMBOLS[axis]}")
    return [*written, *slope_warnings(dataset)]
