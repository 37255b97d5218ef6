"""Fits of the same data compared: by Akaike's criterion, chi square + 2 p, with the noise that all of them have."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.dataset.read.soundness import is_fit
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import LOOP
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.problem.status import POOR_FIT

_CLOSE: Final = 1e-9
"""Relative difference from which on noise is another."""


def fits_compared(datasets: Sequence[xarray.Dataset], files: Sequence[Path]) -> Iterator[str]:
    """
    Compare fits of the same data: p values each, the differences of the criterion to the least, and their weights.

    Raises
    ------
    DatasetError
        One is no fit, or they differ in data, noise, branch or averaging, so that their misfits cannot be compared.
    """
    first = datasets[0]
    for dataset, file in zip(datasets, files, strict=True):
        if not is_fit(dataset):
            raise DatasetError(f"{file}: contains no fit; only fits can be compared, so name one file")
        if why := _apart(first, dataset):
            raise DatasetError(
                f"{file}: {why} {files[0]}, so that their misfits cannot be compared; fit the same points with the "
                "same noise"
            )
        if np.isnan(dataset["chi_square"].values).any():
            raise DatasetError(f"{file}: a loop has no fit, so that the total misfit is undefined; leave its file out")
    values = [dataset.sizes[PARAMETER] * dataset.sizes.get(LOOP, 1) for dataset in datasets]
    misfits = [float(dataset["chi_square"].sum()) for dataset in datasets]
    criteria = np.array(misfits) + 2.0 * np.array(values)
    weights = np.exp(-0.5 * (criteria - criteria.min()))
    weights /= weights.sum()
    loops = f" in {counted(first.sizes[LOOP], 'loop')}" if LOOP in first.dims else ""
    points = int(np.sum(~np.isnan(first["residual"].values)))
    yield f"{counted(len(files), 'fit')} of the same {counted(points, 'point')}{loops}, by AIC = chi square + 2 p"
    yield ""
    width = max(4, *(len(str(file)) for file in files))
    yield f"{'file':<{width}}  {'p':>4}  {'chi square':>12}  {'AIC - least':>11}  {'weight':>8}"
    for i in np.argsort(criteria, kind="stable"):
        difference = criteria[i] - criteria.min()
        row = f"{values[i]:>4}  {misfits[i]:>12.6g}  {difference:>11.4g}  {weights[i]:>8.2g}"
        yield f"{files[i]!s:<{width}}  {row}"
    for dataset, file in zip(datasets, files, strict=True):
        if (dataset["status"].values & POOR_FIT).any():
            yield f"{file}: a poor fit: the residual exceeds the noise, and weights mean little"


def _apart(one: xarray.Dataset, other: xarray.Dataset) -> str:
    """Say in which of their data two fits differ; nothing if in none."""
    if one.attrs.get("data_sha256") != other.attrs.get("data_sha256") or (LOOP in one.dims) != (LOOP in other.dims):
        return "is a fit of other data (sha256) than"
    for name, what in (("raw_points", "other points (rows or branch)"), ("kept_points", "another averaging")):
        if name in one and name in other and not np.array_equal(one[name].values, other[name].values):
            return f"has {what} than" if name == "kept_points" else f"is a fit of {what} than"
    for name, what in (
        ("unloading", "another branch than"),
        ("indentation", "other depths than"),
        ("load", "other loads than"),
    ):
        values, others = (dataset[f"measured_{name}"].values for dataset in (one, other))
        if values.shape != others.shape or not np.array_equal(values, others, equal_nan=values.dtype.kind == "f"):
            return f"has {what}"
    for name in ("noise_of_indentation", "noise_of_load"):
        noise, others = (
            np.asarray(dataset[name] if name in dataset else dataset.attrs.get(name, np.nan), dtype=float)
            for dataset in (one, other)
        )
        if not np.allclose(noise, others, rtol=_CLOSE, atol=0.0, equal_nan=True):
            return f"has another noise ({np.ravel(others)[0]:.4g}, not {np.ravel(noise)[0]:.4g}, in {name}) than"
    return ""
