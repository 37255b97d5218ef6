"""Optima in words: how many are at a bound, and how many points a set of best compromises has."""

from collections.abc import Iterator

import numpy as np
import xarray

from gradhesion.cli.names.outputs import PARETO_POINT
from gradhesion.cli.terminal.amounts import counted


def bound_lines(variable: xarray.DataArray) -> Iterator[str]:
    """Say at which bounds how many optima are."""
    values = variable.values
    ends = zip(np.atleast_1d(variable.attrs["flag_masks"]), variable.attrs["flag_meanings"].split(), strict=True)
    counts = [
        (words.replace("_at_its_", " at its ").replace("_bound", " bound"), int((values & bit != 0).sum()))
        for bit, words in ends
    ]
    for words, count in counts:
        if count:
            yield f"  {words:<44} {count:,} of {counted(values.size, 'optimum').replace('optimums', 'optima')}"
    if not any(count for _, count in counts):
        yield "  no optimum is at a bound"


def point_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Say how many points the Pareto fronts have; nothing for another dataset."""
    if PARETO_POINT not in dataset.dims:
        return
    first = next(str(name) for name in dataset.data_vars if PARETO_POINT in dataset[name].dims)
    counts = np.asarray(dataset[first].notnull().sum(PARETO_POINT))
    least, greatest = int(counts.min()), int(counts.max())
    yield ""
    yield f"Pareto fronts: {least:,}" + (f" to {greatest:,}" if greatest > least else "") + " points per scene"
