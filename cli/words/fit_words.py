"""Fits in words: values with their intervals, what goes together, how well loops are met; of several a row each."""

import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
import xarray

from gradhesion.cli.dataset.read.model_range import SHORT_RANGED, slope_warnings, tabor_warnings
from gradhesion.cli.dataset.read.reader import is_fit
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import LOOP, MINIMUM, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.words.table import unit_behind
from gradhesion.core.answers.flags import FLAG_WORDS
from gradhesion.core.loops.fitted import OFFSETS, poor_from
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import CLOSING
from gradhesion.core.problem.status import ANOTHER_MINIMUM, FAILED, FLAGS, OF_FITS, POOR_FIT

TOGETHER: Final = 0.9
"""Correlations from which on two values are said to go together."""
WIDENED: Final = 1.1
"""The widening of intervals from which on it is said."""
NOISE: Final = ("noise_of_indentation", "noise_of_load")
_AT_AN_END: Final = {
    **dict.fromkeys(OFFSETS, "widen it with offsets under [fit], or look at the base line of the data"),
    **dict.fromkeys(("A", "chi", "amplitude"), "widen it; at its lower end the loop shows no waves: leave them out"),
    "k": "widen the range; at 0 the loop shows no gradient of the modulus: write k = 0",
    CLOSING: f"widen the range; at 1 the loop shows one work of adhesion: leave {CLOSING} out",
}
"""What to do about a value at an end of its range."""
SAME: Final = ("data_sha256", "measured_unloading", "measured_indentation", "measured_load", *NOISE)
"""What fits that are compared have in common."""


def fits_in_short(dataset: xarray.Dataset) -> str:
    """Say how much was fitted."""
    if LOOP in dataset.dims:
        return f"fits of {counted(dataset.sizes[LOOP], 'loop')}"
    cycles = counted(np.unique(dataset["measured_cycle"].values).size, "cycle")
    return f"a fit of {counted(dataset['residual'].size, 'point')} in {cycles}"


def fit_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report what the fits of one or several loops found, line by line."""
    yield from _of_data(dataset)
    yield from _of_loops(dataset) if LOOP in dataset.dims else _of_one(dataset)
    yield from (f"outside the range of the model: {line}" for line in slope_warnings(dataset))
    if fixed := [name for name in INPUTS if name in dataset.coords]:
        yield from ("", "given")
        yield from (f"  {name:<20} {dataset[name].item():g}{unit_behind(dataset[name])}" for name in fixed)


def _of_data(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the data and their noise."""
    attributes, one = dataset.attrs, LOOP not in dataset.dims
    out = []
    for name, what in (("data_rows_left_out", "without a number"), ("data_rows_of_pauses", "of pauses")):
        if count := int(attributes.get(name, 0)):
            out.append(f"{counted(count, 'row')} {what} left out")
    if "raw_points" in dataset and (raw := int(dataset["raw_points"].sum())) > int(dataset["kept_points"].sum()):
        out.append(f"{counted(raw, 'point')} averaged along the path")
    yield "; ".join([f"data: {attributes.get('data_file', 'a file')}", *out])
    noise = [np.ravel(dataset.get(name, attributes.get(name, np.nan))) for name in NOISE]  # version 0.2: attributes
    depth, load = (1e9 * each[0] if each.size == 1 else np.nan for each in noise)
    yield f"noise: {f'{depth:.3g} nm and {load:.3g} nN, ' if one else ''}{attributes.get('noise_is', '')}"
    if "contact_depth" in dataset and one:
        at, deviation = (1e9 * float(dataset[name]) for name in ("contact_depth", "contact_depth_deviation"))
        how = attributes.get("contact_point", "")
        yield f"contact point: {at:.6g} +- {deviation:.2g} nm, found before the fit ({how})"
    factor = float(dataset["interval_widening"]) if one and "interval_widening" in dataset else 1.0
    widened = f", widened by {factor:.3g} for residuals above the noise" if factor > WIDENED else ""
    yield ""
    yield f"fitted, with 95 % intervals ({attributes.get('intervals', '')}{widened})"


def _of_one(dataset: xarray.Dataset) -> Iterator[str]:
    """Report each value of one fit with its interval, and how well the loop is met."""
    names, units = _names(dataset)
    width = max(20, *map(len, names))
    through_a_machine = dataset.attrs.get("control") == "machine"
    values = (dataset[name].values for name in ("value", "low", "high"))
    for name, unit, value, low, high in zip(names, units, *values, strict=True):
        remark = "  of the machine's displacement" if through_a_machine and name == "indentation_offset" else ""
        written = f"{value:.6g} {unit}".removesuffix(" 1")
        yield f"  {name:<{width}} {written:<22} {low:.6g} to {high:.6g}{remark}"
    yield ""
    chi_square, degrees, status = (dataset[name].item() for name in ("chi_square", "degrees_of_freedom", "status"))
    yield f"chi square: {chi_square:.6g} for {degrees:,} degrees of freedom; reduced {chi_square / degrees:.3g}"
    for i, j in itertools.combinations(range(len(names)), 2):
        if abs(correlation := float(dataset["correlation"].values[i, j])) > TOGETHER:
            yield f"correlation of {names[i]} and {names[j]}: {correlation:.3f}"
    if "tabor_parameter" in dataset and (tabor := float(dataset["tabor_parameter"])) >= SHORT_RANGED:
        yield f"Tabor parameter {tabor:.3g} ({dataset['tabor_parameter'].attrs.get('comment', '')})"
    yield from doubts_of(dataset)
    yield from _cautions(dataset)
    yield from (f"status: {name}: {FLAG_WORDS[name]}" for name, bit in FLAGS.items() if status & bit)


def _names(dataset: xarray.Dataset) -> tuple[list[str], list[str]]:
    """List what is fitted, and the units."""
    names, units = (list(map(str, dataset[name].values)) for name in (PARAMETER, PARAMETER_UNITS))
    return names, units


def doubts_of(one: xarray.Dataset) -> Iterator[str]:
    """Say why the fit of a loop is not to be trusted, or why it has none; nothing if it is."""
    if "problem" in one.coords and (problem := str(one["problem"].values)):
        yield problem
        return
    names, _ = _names(one)
    chi_square, degrees, status = (one[name].item() for name in ("chi_square", "degrees_of_freedom", "status"))
    if not int(one["converged"]):
        yield "the fit did not converge; give more starts, or narrower ranges"
    poor = bool(status & POOR_FIT) or chi_square > poor_from(degrees) * degrees  # version 0.2 has no such flag
    if poor:
        most = f"{poor_from(degrees):.3g} is the most that noise explains"
        remedy = "try another model, wider ranges, or other noise (fit.noise), and check the signs of depth and load"
        yield f"a poor fit: reduced chi square {chi_square / degrees:.3g}, where {most}; {remedy}"
    for i, values in enumerate(one["minimum_value"].values if MINIMUM in one.dims else ()):
        if not np.isnan(values).any():
            place = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, values, strict=True))
            other = f"chi square {float(one['minimum_chi_square'][i]):.6g} at {place}, beside {chi_square:.6g}"
            remedy = "" if poor else "; narrow the ranges to the one that is meant"
            yield f"another minimum is {'nearly as low' if poor else 'within the noise'}: {other}{remedy}"
    for at in np.flatnonzero(one["on_bound"].values):
        ends = [f"{float(one[name][at]):.4g}" for name in ("low_searched", "high_searched") if name in one]
        range_of = f" of {' to '.join(ends)}, at {float(one['value'][at]):.4g}" if ends else ""
        remedy = _AT_AN_END.get(names[at], "widen the range, or give it as a number; or the data do not show it")
        yield f"{names[at]} is at an end of its range{range_of}; {remedy}"


def _cautions(one: xarray.Dataset) -> Iterator[str]:
    """Say of one fit what its loop cannot tell apart or does not obey."""
    if alike := str(one["alike"].values if "alike" in one.coords else one.attrs.get("alike", "")):
        yield f"indistinguishable: {alike}"
    if "tabor_parameter" in one:
        comment = str(one["tabor_parameter"].attrs.get("comment", ""))
        yield from tabor_warnings(float(one["tabor_parameter"]), comment)


def _of_loops(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the values of several fits in a table, the medians of the sound ones, and what is said of each."""
    names, units = _names(dataset)
    files = list(map(str, dataset["file"].values))
    value, low, high, reduced = (dataset[name].values for name in ("value", "low", "high", "reduced_chi_square"))
    table = pd.DataFrame({"file": files})
    for j, (name, unit) in enumerate(zip(names, units, strict=True)):
        table[f"{name} [{unit}]" if unit != "1" else name] = [
            "-" if np.isnan(one) else f"{one:.5g} ({least:.4g} to {most:.4g})"
            for one, least, most in zip(value[:, j], low[:, j], high[:, j], strict=True)
        ]
    table["reduced chi square"] = ["-" if np.isnan(one) else f"{one:.3g}" for one in reduced]
    flags, status = FLAGS | OF_FITS, dataset["status"].values
    table["flags"] = [" ".join(name for name, bit in flags.items() if one & bit) or "-" for one in status]
    yield from (line.rstrip() for line in table.to_string(index=False, justify="left").splitlines())
    doubtful = status & (FAILED | POOR_FIT | ANOTHER_MINIMUM) != 0
    sound = value[~doubtful & ~np.isnan(value).any(axis=1)]
    yield from ("", f"median of {counted(len(sound), 'loop')} without such a flag, with quartiles")
    for name, column in zip(names, sound.T, strict=True) if len(sound) else ():
        least, middle, most = np.quantile(column, [0.25, 0.5, 0.75])
        yield f"  {name:<20} {middle:<12.6g} {least:.6g} to {most:.6g}"
    yield ""
    for i, file in enumerate(files):
        one = dataset.isel({LOOP: i})
        yield from (f"{file}: {line}" for line in (*doubts_of(one), *_cautions(one)))


def fits_compared(datasets: Sequence[xarray.Dataset], files: Sequence[Path]) -> Iterator[str]:
    """Compare fits of the same data by Akaike's criterion, chi square + 2 p: differences to the least, and weights."""
    first = datasets[0]
    for dataset, file in zip(datasets, files, strict=True):
        if not is_fit(dataset):
            raise DatasetError(f"{file}: contains no fit; only fits can be compared, so name one file")
        for name in SAME:
            one, other = (np.asarray(each.get(name, each.attrs.get(name))) for each in (first, dataset))
            if one.shape != other.shape or not np.array_equal(one, other, equal_nan=one.dtype.kind == "f"):
                remedy = "to compare their misfits, fit the same points with the same noise"
                raise DatasetError(f"{file}: differs from {files[0]} in {name}; {remedy}")
        if np.isnan(dataset["chi_square"].values).any():
            raise DatasetError(f"{file}: a loop has no fit, so that the total misfit is undefined; leave its file out")
    table = pd.DataFrame({"file": [str(file) for file in files]})
    table["p"] = [dataset.sizes[PARAMETER] * dataset.sizes.get(LOOP, 1) for dataset in datasets]
    table["chi square"] = [float(dataset["chi_square"].sum()) for dataset in datasets]
    criteria = table["chi square"] + 2.0 * table["p"]
    table["AIC - least"] = criteria - criteria.min()
    weights = np.exp(-0.5 * table["AIC - least"])
    table["weight"] = weights / weights.sum()
    points = int(np.sum(~np.isnan(first["residual"].values)))
    yield f"{counted(len(files), 'fit')} of the same {counted(points, 'point')}, by AIC = chi square + 2 p"
    yield ""
    table = table.sort_values("AIC - least", kind="stable")
    yield from table.to_string(index=False, float_format="{:.6g}".format).splitlines()
    for dataset, file in zip(datasets, files, strict=True):
        if (dataset["status"].values & POOR_FIT).any():
            yield f"{file}: a poor fit: the residual exceeds the noise, and weights mean little"
