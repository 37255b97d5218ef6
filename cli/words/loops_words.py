"""The fits of several loops in words, and as a table: a row each."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.dataset.read.model_range import slope_warnings, tabor_warnings
from gradhesion.cli.names.fits import LOOP, MINIMUM, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.words.fit_words import COLUMNS, of_data, of_given, of_origin
from gradhesion.core.problem.status import FLAGS, OF_FITS

FLAGGED: Final = FLAGS | OF_FITS
"""Every flag of a fit, with its bit."""
OWN: Final = ("reduced_chi_square", "converged", "status")
"""The columns of a loop, after those of a parameter."""


def loops_described(dataset: xarray.Dataset, file: Path) -> Iterator[str]:
    """Report what the fits of several loops found: a table with a row each, and what is said of each."""
    count = dataset.sizes[LOOP]
    yield dataset.attrs["title"]
    yield f"{file}: fits of {counted(count, 'loop')}, {bytes_in_words(file.stat().st_size)}"
    yield ""
    yield from of_data(dataset)
    yield f"noise: {dataset.attrs.get('noise_is', '')}; 95 % intervals: {dataset.attrs.get('intervals', '')}"
    yield ""
    yield from _aligned(list(_rows(dataset)))
    yield from _of_all(dataset)
    said = [*_said(dataset), *(f"outside the range of the model: {line}" for line in slope_warnings(dataset))]
    if said:
        yield ""
        yield from said
    yield from of_given(dataset)
    yield from of_origin(dataset)


def flags_of(dataset: xarray.Dataset, loop: int) -> list[str]:
    """Name what is flagged of one of several loops."""
    status = int(dataset["status"].values[loop])
    flags = [name for name, bit in FLAGGED.items() if status & bit]
    if flags == ["no_value"]:
        return flags
    names = dataset[PARAMETER].values[dataset["on_bound"].values[loop] > 0]
    converged = [] if dataset["converged"].values[loop] else ["not_converged"]
    return [*flags, *converged, *(f"on_bound:{name}" for name in names)]


def _rows(dataset: xarray.Dataset) -> Iterator[list[str]]:
    """Give the cells of the table, its head first."""
    names, units = (list(map(str, dataset[name].values)) for name in (PARAMETER, PARAMETER_UNITS))
    heads = [name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]
    yield ["file", *heads, "reduced chi square", "flags"]
    values, deviations, reduced = (
        dataset[name].values for name in ("value", "standard_deviation", "reduced_chi_square")
    )
    for i, file in enumerate(map(str, dataset["file"].values)):
        cells = [
            "-" if np.isnan(value) else f"{value:.5g} +- {deviation:.2g}"
            for value, deviation in zip(values[i], deviations[i], strict=True)
        ]
        met = "-" if np.isnan(reduced[i]) else f"{reduced[i]:.3g}"
        yield [file, *cells, met, " ".join(flags_of(dataset, i)) or "-"]


def _aligned(rows: list[list[str]]) -> Iterator[str]:
    """Write cells in columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)).rstrip()


def _of_all(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the median and the quartiles of each value over the loops."""
    values = dataset["value"].values
    sound = ~np.isnan(values).any(axis=1)
    yield ""
    yield f"median of {counted(int(sound.sum()), 'loop')}, with quartiles"
    names = list(map(str, dataset[PARAMETER].values))
    width = max(20, *map(len, names))
    for name, column in zip(names, values[sound].T, strict=True):
        low, middle, high = np.quantile(column, [0.25, 0.5, 0.75])
        yield f"  {name:<{width}} {middle:<12.6g} {low:.6g} to {high:.6g}"


def _said(dataset: xarray.Dataset) -> Iterator[str]:
    """Say why loops have no values, which other minima there are, and the alternatives that they cannot distinguish."""
    names = list(map(str, dataset[PARAMETER].values))
    comment = str(dataset["tabor_parameter"].attrs.get("comment", ""))
    for i, file in enumerate(map(str, dataset["file"].values)):
        if problem := str(dataset["problem"].values[i]):
            yield f"{file}: {problem}"
        for values in dataset["minimum_value"].values[i] if MINIMUM in dataset.dims else ():
            if not np.isnan(values).any():
                listed = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, values, strict=True))
                yield f"{file}: another minimum within the noise: {listed}"
        if alike := str(dataset["alike"].values[i]):
            yield f"{file}: indistinguishable: {alike}"
        yield from (f"{file}: {line}" for line in tabor_warnings(float(dataset["tabor_parameter"].values[i]), comment))


def loops_tabled(dataset: xarray.Dataset) -> Iterator[str]:
    """Write the values of several fits as CSV, a line for each loop and parameter, with all their digits."""
    yield ",".join(("file", "parameter", "unit", *COLUMNS, *OWN))
    names, units = (list(map(str, dataset[name].values)) for name in (PARAMETER, PARAMETER_UNITS))
    columns = [dataset[column].values for column in COLUMNS]
    own = [dataset[column].values for column in OWN]
    for i, file in enumerate(map(str, dataset["file"].values)):
        for j, (name, unit) in enumerate(zip(names, units, strict=True)):
            line = io.StringIO()
            row = [file, name, unit, *(column[i, j].item() for column in columns), *(each[i].item() for each in own)]
            csv.writer(line, lineterminator="").writerow(row)
            yield line.getvalue()
