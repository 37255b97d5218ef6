"""Values between two items of an axis, and reductions of an axis: each with the status that belongs to it."""

from dataclasses import dataclass, replace
from typing import Final, NamedTuple
from warnings import catch_warnings

import numpy as np
import xarray

QUANTILES: Final = {"p05": 0.05, "p50": 0.5, "median": 0.5, "p95": 0.95}
"""The quantiles that an axis may be reduced to, by what they are called."""
REDUCTIONS: Final = ("max", "min", "mean", "sum", *QUANTILES, "argmax", "argmin")
"""How an axis may be reduced; the last two give the place of the extreme."""
FLAT: Final = 1e-9
"""Values that differ by less, over their size, are equal: what is left is rounding."""


class Between(NamedTuple):
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
    left_out: int = 0
    """The scenes without a value, or failed, that reductions have left out."""
    at_end: xarray.DataArray | None = None
    """Whether an extreme whose place is taken is at an end of its axis, beyond which it may lie."""
    flat: int = 0
    """The places left out because the values along the axis are equal but for rounding: no extreme has a place."""


def interpolated(taken: Taken, place: Between) -> Taken:
    """Give values between two items, the only ones of an axis that are left; flags of either hold.

    Numbers of jumps and flags have nothing between them: they are those of the nearer item.
    """
    values, status = ([one.isel({place.axis: i}, drop=True) for i in (0, 1)] for one in (taken.values, taken.status))
    if taken.values.dtype.kind == "f":
        made = (1.0 - place.share) * values[0] + place.share * values[1]
    else:
        made = values[1] if place.share >= 0.5 else values[0]
    made = made.assign_coords({place.axis: place.value}).assign_attrs(taken.values.attrs).rename(taken.values.name)
    return replace(taken, values=made, status=status[0] | status[1])


def reduced(taken: Taken, axis: str, how: str) -> Taken:
    """Reduce an axis to an extreme, its place, or the mean of its items; what has no value (NaN) is left out.

    The status is that of the scene of the extreme, or has the flags of all scenes of a mean, a sum or a quantile.
    """
    coordinate = taken.values[axis].values
    going = [name for name in taken.values.coords if axis in taken.values[name].dims]
    values, status = (one.drop_vars(going, errors="ignore") for one in (taken.values, taken.status))
    there = values.notnull()
    if not how.endswith(("max", "min")):
        flags = status.where(there, 0).astype(status.dtype).reduce(np.bitwise_or.reduce, axis)
        with catch_warnings(action="ignore"):  # where all are NaN, so is what is made of them
            if how in QUANTILES:
                made = values.quantile(QUANTILES[how], axis, skipna=True, keep_attrs=True).drop_vars("quantile")
            else:
                made = getattr(values, how)(axis, skipna=True, keep_attrs=True).where(there.any(axis))
        return Taken(values=made, status=flags, left_out=taken.left_out)
    place = values.fillna(-np.inf).argmax(axis) if how.endswith("max") else values.fillna(np.inf).argmin(axis)
    found = there.any(axis)
    flags = status.isel({axis: place}).where(found, 0).astype(status.dtype)
    made, at_end, flat = values.isel({axis: place}).where(found), None, 0
    if how.startswith("arg"):
        least, greatest = values.min(axis), values.max(axis)
        equal = (greatest - least) <= FLAT * np.maximum(abs(least), abs(greatest))
        made = place.copy(data=coordinate[place.values]).where(found & ~equal)
        at_end, flat = made.isin([coordinate.min(), coordinate.max()]), int(equal.sum())
    made = made.rename(values.name).assign_attrs(values.attrs)
    return Taken(values=made, status=flags, left_out=taken.left_out, at_end=at_end, flat=flat)
