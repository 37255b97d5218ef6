"""Values between two items of an axis, and reductions of an axis: each with the status that belongs to it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray

from gradhesion.core import FAILED

QUANTILES: Final = {"p05": 0.05, "p50": 0.5, "median": 0.5, "p95": 0.95}
"""The quantiles that an axis may be reduced to, by what they are called."""

REDUCTIONS: Final = ("max", "min", "mean", "sum", *QUANTILES, "argmax", "argmin")
"""How an axis may be reduced; the last two give the place of the extreme."""


@dataclass(frozen=True, kw_only=True)
class Between:
    """A place between two items of an axis."""

    axis: str
    value: float
    items: tuple[int, int]
    share: float
    """How far it is from the first to the second, in the axis or in its logarithm, from 0 to 1."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Taken:
    """What is taken of a variable."""

    values: xarray.DataArray
    status: xarray.DataArray
    left_out: int
    """The scenes without a value, or failed, that reductions have left out."""
    at_end: xarray.DataArray | None = None
    """Whether an extreme whose place is taken is at an end of its axis, beyond which it may lie."""
    flat: int = 0
    """The places left out because the values along the axis are equal but for rounding: no extreme has a place."""


FLAT: Final = 1e-9
"""Values that differ by less, over their size, are equal: what is left is rounding."""


def placed(values: xarray.DataArray, axis: str, how: str) -> tuple[xarray.DataArray, xarray.DataArray]:
    """Report where the extreme along an axis is at an end of it, and where there is none since the values are equal."""
    there = values.notnull()
    least, greatest = values.min(axis), values.max(axis)
    flat = (greatest - least) <= FLAT * np.maximum(abs(least), abs(greatest))
    order = np.argsort(np.argsort(values[axis].values, kind="stable"), kind="stable")  # an axis may fall
    place = values.fillna(-np.inf).argmax(axis) if how.endswith("max") else values.fillna(np.inf).argmin(axis)
    rank = xarray.DataArray(order[place.values], place.coords, place.dims)
    ends = (rank == 0) | (rank == order.size - 1)
    return (ends & there.any(axis) & ~flat).drop_vars(axis, errors="ignore"), flat.drop_vars(axis, errors="ignore")


def without_failed(values: xarray.DataArray, status: xarray.DataArray) -> tuple[xarray.DataArray, int]:
    """Give scenes that have failed no value; count those that have none."""
    there = values.notnull() & ((status & FAILED) == 0)
    return values.where(there), int((~there).sum())


def interpolated(
    values: xarray.DataArray, status: xarray.DataArray, place: Between
) -> tuple[xarray.DataArray, xarray.DataArray]:
    """
    Give values between two items, the only ones of an axis that are left; flags of either hold.

    Numbers of jumps and flags have nothing between them: they are those of the nearer item.
    """
    first, second = (values.isel({place.axis: item}, drop=True) for item in (0, 1))
    if values.dtype.kind == "f":
        made = (1.0 - place.share) * first + place.share * second
    else:
        made = second if place.share >= 0.5 else first
    made = made.assign_coords({place.axis: place.value}).assign_attrs(values.attrs).rename(values.name)
    flags = status.isel({place.axis: 0}, drop=True) | status.isel({place.axis: 1}, drop=True)
    return made, flags


def reduced(
    values: xarray.DataArray, status: xarray.DataArray, axis: str, how: str
) -> tuple[xarray.DataArray, xarray.DataArray]:
    """
    Reduce an axis to an extreme, its place, or the mean of its items; what has no value (NaN) is left out.

    The status is that of the scene of the extreme, or has the flags of all scenes of a mean, a sum or a quantile.
    """
    coordinate = values[axis]
    going = [name for name in values.coords if axis in values[name].dims]
    values, status = (one.drop_vars([name for name in going if name in one.coords]) for one in (values, status))
    there = values.notnull()
    if how in ("mean", "sum", *QUANTILES):
        flags = status.where(there, 0).astype(status.dtype).reduce(np.bitwise_or.reduce, axis)
        if how == "mean":
            return values.mean(axis, skipna=True, keep_attrs=True), flags
        if how == "sum":
            return values.sum(axis, skipna=True, min_count=1, keep_attrs=True), flags
        return values.quantile(QUANTILES[how], axis, skipna=True, keep_attrs=True).drop_vars("quantile"), flags
    place = values.fillna(-np.inf).argmax(axis) if how.endswith("max") else values.fillna(np.inf).argmin(axis)
    found = there.any(axis)
    flags = status.isel({axis: place}).where(found, 0).astype(status.dtype)
    if how.startswith("arg"):
        made = xarray.DataArray(coordinate.values[place.values], place.coords, place.dims)
    else:
        made = values.isel({axis: place})
    return made.where(found).rename(values.name).assign_attrs(values.attrs), flags
