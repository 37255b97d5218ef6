"""A fit in words, and as a table: values with their intervals, what goes together, how well the loop is met."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.dataset.read.model_range import slope_warnings, tabor_warnings
from gradhesion.cli.names.fits import MINIMUM, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.core.answers.flags import FLAG_WORDS
from gradhesion.core.loops.fitted import poor_from
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.status import FLAGS, POOR_FIT

TOGETHER: Final = 0.9
"""Correlations from which on two values are said to go together."""
WIDENED: Final = 1.1
"""The widening of intervals from which on it is said."""
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
    yield from of_data(dataset)
    depth, load = noise_of(dataset)
    yield f"noise: {1e9 * depth:.3g} nm and {1e9 * load:.3g} nN, {dataset.attrs.get('noise_is', '')}"
    if "contact_depth" in dataset:
        at, deviation = (1e9 * float(dataset[name]) for name in ("contact_depth", "contact_depth_deviation"))
        yield (
            f"contact point: {at:.6g} +- {deviation:.2g} nm, found before the fit "
            f"({dataset.attrs.get('contact_point', '')})"
        )
    yield ""
    yield f"fitted, with 95 % intervals ({intervals_of(dataset)})"
    yield from value_lines(dataset)
    yield from of_given(dataset)
    yield ""
    yield from _quality(dataset)
    yield from of_origin(dataset)


def of_data(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the punch and the data of fits."""
    yield f"profile: {dataset.attrs.get('profile', '')}"
    yield from (f"{law}: {dataset.attrs[law]}" for law in ("toughness", "rate") if law in dataset.attrs)
    words = {"data_rows_left_out": "without a number", "data_rows_of_pauses": "of pauses"}
    counts = {what: int(dataset.attrs.get(name, 0)) for name, what in words.items()}
    out = [f"{counted(count, 'row')} {what} left out" for what, count in counts.items() if count]
    if "raw_points" in dataset and (raw := int(dataset["raw_points"].sum())) > int(dataset["kept_points"].sum()):
        out.append(f"{counted(raw, 'point')} averaged along the path")
    yield "; ".join([f"data: {dataset.attrs.get('data_file', 'a file')}", *out])


def of_given(dataset: xarray.Dataset) -> Iterator[str]:
    """Report what was given as a number."""
    if fixed := [name for name in INPUTS if name in dataset.coords]:
        yield ""
        yield "given"
        for name in fixed:
            unit = str(dataset[name].attrs.get("units", "1"))
            yield f"  {name:<20} {dataset[name].item():g}{'' if unit == '1' else ' ' + unit}"


def intervals_of(dataset: xarray.Dataset) -> str:
    """Say where the intervals of one fit come from, and by how much they are widened."""
    source = str(dataset.attrs.get("intervals", ""))
    factor = float(dataset["interval_widening"]) if "interval_widening" in dataset else 1.0
    return f"{source}, widened by {factor:.3g} for residuals above the noise" if factor > WIDENED else source


def noise_of(dataset: xarray.Dataset) -> tuple[float, float]:
    """Give the standard deviations of depth and load of one fit; version 0.2 wrote them as attributes."""
    names = ("noise_of_indentation", "noise_of_load")
    depth, load = (float(dataset[name] if name in dataset else dataset.attrs.get(name, np.nan)) for name in names)
    return depth, load


def value_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report each value with its interval."""
    names = list(map(str, dataset[PARAMETER].values))
    width = max(20, *map(len, names))
    for i, name in enumerate(names):
        unit = str(dataset[PARAMETER_UNITS].values[i])
        value, deviation, low, high = (float(dataset[column].values[i]) for column in COLUMNS[:4])
        at_end = "  at an end of its range" if dataset["on_bound"].values[i] else ""
        if at_end and "low_searched" in dataset:
            ends = (float(dataset[column].values[i]) for column in ("low_searched", "high_searched"))
            at_end += ", {:.6g} to {:.6g}".format(*ends)
        written = f"{value:.6g} +- {deviation:.2g}{'' if unit == '1' else ' ' + unit}"
        yield f"  {name:<{width}} {written:<34} {low:.6g} to {high:.6g}{at_end}"


def _quality(dataset: xarray.Dataset) -> Iterator[str]:
    """Report how well the loop is met, and what goes together."""
    chi_square, degrees = float(dataset["chi_square"]), int(dataset["degrees_of_freedom"])
    status = int(dataset["status"])
    yield f"chi square: {chi_square:.6g} for {degrees:,} degrees of freedom; reduced {chi_square / degrees:.3g}"
    if status & POOR_FIT or chi_square > poor_from(degrees) * degrees:
        yield f"  a poor fit: the noise explains {poor_from(degrees):.3g} at most; try another model or other ranges"
    if not int(dataset["converged"]):
        yield "  it did not converge"
    names, correlation = list(map(str, dataset[PARAMETER].values)), dataset["correlation"].values
    for i, each in enumerate(dataset["minimum_value"].values if MINIMUM in dataset.dims else ()):
        values = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, each, strict=True))
        yield f"another minimum within the noise: chi square {float(dataset['minimum_chi_square'][i]):.6g} at {values}"
    for i, one in enumerate(names):
        for j, other in enumerate(names[:i]):
            if abs(correlation[i, j]) > TOGETHER:
                yield f"correlation of {other} and {one}: {correlation[i, j]:.3f}"
    if "alike" in dataset.attrs:
        yield f"indistinguishable: {dataset.attrs['alike']}"
    if "tabor_parameter" in dataset:
        tabor = float(dataset["tabor_parameter"])
        comment = str(dataset["tabor_parameter"].attrs.get("comment", ""))
        beyond = list(tabor_warnings(tabor, comment))
        yield from beyond or [f"Tabor parameter {tabor:.3g} ({comment})"]
    yield from (f"outside the range of the model: {line}" for line in slope_warnings(dataset))
    for name, bit in FLAGS.items():
        if status & bit:
            yield f"status: {name}: {FLAG_WORDS[name]}"


def of_origin(dataset: xarray.Dataset) -> Iterator[str]:
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
