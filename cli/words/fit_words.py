"""A fit in words, and as a table: values with their intervals, what goes together, how well the loop is met."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.dataset.model_range import slope_told
from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names import FLAGS as WORDS
from gradhesion.cli.names import PARAMETER, PARAMETER_UNITS
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.core.problem.status import FLAGS

TOGETHER: Final = 0.9
"""Correlations from which on two values are said to go together."""
TOO_MUCH: Final = 1.5
"""Chi square over its degrees of freedom: what is more is no noise as it was given."""
COLUMNS: Final = ("value", "standard_deviation", "low", "high", "on_bound")
"""The columns of a table, after the parameter and its unit."""


def fit_described(dataset: xarray.Dataset, file: Path) -> Iterator[str]:
    """Report what a fit found, line by line."""
    measured = dataset["residual"].size
    cycles = np.unique(dataset["measured_cycle"].values).size
    yield dataset.attrs["title"]
    yield (
        f"{file}: a fit of {counted(measured, 'point')} in {counted(cycles, 'cycle')}, "
        f"{bytes_in_words(file.stat().st_size)}"
    )
    yield ""
    yield f"profile: {dataset.attrs.get('profile', '')}"
    left_out = int(dataset.attrs.get("data_rows_left_out", 0))
    were = f"; {counted(left_out, 'row')} without a number left out" if left_out else ""
    yield f"data: {dataset.attrs.get('data_file', 'a file')}{were}"
    depth, load = (float(dataset.attrs.get(f"noise_of_{name}", np.nan)) for name in ("indentation", "load"))
    yield f"noise: {1e9 * depth:.3g} nm and {1e9 * load:.3g} nN, {dataset.attrs.get('noise_is', '')}"
    yield ""
    yield f"fitted, with 95 % intervals ({dataset.attrs.get('intervals', '')})"
    yield from values_told(dataset)
    if fixed := [name for name in INPUTS if name in dataset.coords]:
        yield ""
        yield "given"
        for name in fixed:
            unit = str(dataset[name].attrs.get("units", "1"))
            yield f"  {name:<20} {dataset[name].item():g}{'' if unit == '1' else ' ' + unit}"
    yield ""
    yield from _quality(dataset)
    yield from _origin(dataset)


def values_told(dataset: xarray.Dataset) -> Iterator[str]:
    """Report each value with its interval."""
    for i, name in enumerate(map(str, dataset[PARAMETER].values)):
        unit = str(dataset[PARAMETER_UNITS].values[i])
        value, deviation, low, high = (float(dataset[column].values[i]) for column in COLUMNS[:4])
        at_end = "  at an end of its range" if dataset["on_bound"].values[i] else ""
        written = f"{value:.6g} +- {deviation:.2g}{'' if unit == '1' else ' ' + unit}"
        yield f"  {name:<20} {written:<34} {low:.6g} to {high:.6g}{at_end}"


def _quality(dataset: xarray.Dataset) -> Iterator[str]:
    """Report how well the loop is met, and what goes together."""
    chi_square, degrees = float(dataset["chi_square"]), int(dataset["degrees_of_freedom"])
    yield f"chi square: {chi_square:.6g} for {degrees:,} degrees of freedom ({chi_square / degrees:.3g} each)"
    if chi_square > TOO_MUCH * degrees:
        yield "  more than the noise: another minimum, another model, or more noise than was given"
    if not int(dataset["converged"]):
        yield "  it did not converge"
    names, correlation = list(map(str, dataset[PARAMETER].values)), dataset["correlation"].values
    for i, one in enumerate(names):
        for j, other in enumerate(names[:i]):
            if abs(correlation[i, j]) > TOGETHER:
                yield f"correlation of {other} and {one}: {correlation[i, j]:.3f}"
    yield from (f"outside the range of the model: {line}" for line in slope_told(dataset))
    status = int(dataset["status"])
    for name, bit in FLAGS.items():
        if status & bit:
            yield f"status: {name}: {WORDS[name]}"


def _origin(dataset: xarray.Dataset) -> Iterator[str]:
    """Report where a fit comes from."""
    yield ""
    yield "origin"
    yield f"  {dataset.attrs['source']}"
    yield from (f"  {line}" for line in str(dataset.attrs.get("history", "")).splitlines())
    if "study_sha256" in dataset.attrs:
        yield f"  study with sha256 {dataset.attrs['study_sha256']}"


def fit_tabled(dataset: xarray.Dataset) -> Iterator[str]:
    """Write the values of a fit as CSV, a line each, with all their digits."""
    yield ",".join(("parameter", "unit", *COLUMNS))
    for i, name in enumerate(map(str, dataset[PARAMETER].values)):
        row = [dataset[column].values[i].item() for column in COLUMNS]
        yield ",".join((name, str(dataset[PARAMETER_UNITS].values[i]), *(repr(item) for item in row)))
