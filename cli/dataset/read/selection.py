"""Parts of a dataset: axes fixed at a value, and axes reduced to an extreme or a mean.

The words of `--at` and `--over` become a `Selection` here; it narrows a dataset without loading it.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from decimal import Decimal
from typing import Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reductions import REDUCTIONS, Between, Taken, interpolated, reduced
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, RAGGED
from gradhesion.cli.names.outputs import unit_of
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.study.text.quantities import factor_between
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core import FAILED
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL

SLACK: Final = 1e-9
"""Values that differ by less, over their size, are one: they are typed with fewer digits than they have."""
QUANTITY: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\D.*)?")
"""A number, and its unit if it has one."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Selection:
    """What of a dataset is wanted."""

    fixed: Mapping[str, int] = field(default_factory=dict)
    """The item at which each of some axes is fixed."""
    parts: Mapping[str, NDArray[np.intp]] = field(default_factory=dict)
    """The items that are left of each of some axes, or of the scenes of points."""
    between: tuple[Between, ...] = ()
    """Axes fixed at a value between two items."""
    over: Mapping[str, str] = field(default_factory=dict)
    """The reduction of each of some axes, in the order in which they are done."""
    notes: tuple[str, ...] = ()
    """What was wished and is met by another value, the nearest of the axis."""

    def narrowed(self, dataset: xarray.Dataset) -> xarray.Dataset:
        """Fix axes, whose values stay as coordinates, and cut others, to two items where one is to interpolate.

        Nothing is loaded, and what is to be reduced stays: see `taken`.
        """
        items = {**self.fixed, **self.parts, **{one.axis: [*one.items] for one in self.between}}
        narrow = dataset.isel(items, missing_dims="ignore")
        for curve, count in RAGGED.items():
            if count in dataset and EXTENTS[curve] in dataset.dims:  # the items of all scenes, one after the other
                scenes = dataset[count].copy(data=np.arange(dataset[count].size).reshape(dataset[count].shape))
                owners = np.repeat(scenes.values.ravel(), dataset[count].values.ravel())
                left = np.isin(owners, scenes.isel(items, missing_dims="ignore"))
                narrow = narrow.isel({EXTENTS[curve]: np.flatnonzero(left)})
        return narrow

    def taken(self, values: xarray.DataArray, status: xarray.DataArray) -> Taken:
        """Interpolate and reduce a variable of a narrowed dataset, with its status; scenes without a value are NaN."""
        values = values.load()
        values = values.where(np.isfinite(values)) if values.dtype.kind == "f" else values
        taken = Taken(values=values, status=status.load())
        for one in self.between:
            taken = interpolated(taken, one)
        if self.over:
            there = taken.values.notnull() & ((taken.status & FAILED) == 0)
            taken = replace(taken, values=taken.values.where(there), left_out=int((~there).sum()))
        for axis, how in self.over.items():
            taken = reduced(taken, axis, how)
        return taken


def selection_of(
    dataset: xarray.Dataset,
    at: Sequence[str] = (),
    over: Sequence[str] = (),
    *,
    interpolate: bool = False,
    ways: Sequence[str] = REDUCTIONS,
) -> Selection:
    """Read wishes such as at = ["lambda_over_R=0.1", "R=2 um", "A=0.01:", "solver=exact"] and over = ["k=max"].

    An axis is fixed at its nearest value, by ratio if it is log-spaced, or interpolated there; cut to a range; or
    reduced in one of some `ways`. Numbers without a unit are in SI. Of points the scenes with these values stay.
    DatasetError says which wish cannot be read or met, and what to write instead.
    """
    dims = dataset["status"].dims
    fixed: dict[str, int] = {}
    parts: dict[str, NDArray[np.intp]] = {}
    between: list[Between] = []
    named: set[str] = set()
    notes: list[str] = []
    for option, axis, text in _wishes(dataset, "--at", at, named):
        if axis == SOLVER:
            known = [str(solver) for solver in dataset[SOLVER].values]
            if text not in known:
                raise DatasetError(f"{option}: not a solver of this dataset; {did_you_mean(text, known)}")
            fixed[axis] = known.index(text)
            continue
        values = np.asarray(dataset[axis].values, dtype=float)
        place = None if ":" in text else _between(option, values, axis, value_in(text, axis, option))
        if place is None:
            left = _within(option, values, ends_in(text, axis, option))
        else:
            nearest = place.items[round(place.share)]
            left = np.flatnonzero(values == values[nearest])
            if place.share > 0.0 and not interpolate:
                notes.append(f"{option}: shows {axis} = {values[nearest]:.10g}{_unit(axis)}, its nearest value")
        if axis not in dims:  # of points, which have it along their scenes
            if interpolate:
                raise DatasetError(f"{option}: points cannot be interpolated; leave --interpolate out")
            parts[SCENE] = np.intersect1d(parts.get(SCENE, left), left)
        elif place is None:
            parts[axis] = left
        elif interpolate and place.share > 0.0:
            between.append(place)
        else:
            fixed[axis] = nearest
    if not parts.get(SCENE, np.zeros(1)).size:
        raise DatasetError(f"--at {' --at '.join(at)}: no scene has all these values; leave one of them out")
    if interpolate and not at:
        raise DatasetError("--interpolate: there is nothing to interpolate; add --at AXIS=VALUE")
    reductions: dict[str, str] = {}
    for option, axis, how in _wishes(dataset, "--over", over, named):
        if axis == SOLVER or axis not in dims:
            raise DatasetError(f"{option}: solvers and points cannot be reduced; choose some of them with --at")
        if how not in ways:
            raise DatasetError(f"{option}: not a reduction; {did_you_mean(how, ways)}")
        if how.startswith("arg") and any(other.startswith("arg") for other in reductions.values()):
            raise DatasetError(f"{option}: the place of an extreme is already requested; reduce by max, min or mean")
        reductions[axis] = how
    return Selection(fixed=fixed, parts=parts, between=tuple(between), over=reductions, notes=tuple(notes))


def is_log(values: NDArray[np.float64]) -> bool:
    """Report whether the ratios of the finite values of an axis are more even than their differences."""
    finite = np.unique(values[np.isfinite(values)])
    if finite.size < 2 or finite[0] <= 0 or finite[-1] < 5 * finite[0]:
        return False
    steps, ratios = np.diff(finite), np.diff(np.log(finite))
    return bool(finite.size == 2 or np.std(ratios) / np.mean(ratios) < np.std(steps) / np.mean(steps))


def _wishes(dataset: xarray.Dataset, option: str, words: Sequence[str], named: set[str]) -> Iterator[tuple[str, ...]]:
    """Take wishes apart: what was written, the axis and the rest; each axis of the dataset may be named once."""
    for word in words:
        axis, sign, rest = (part.strip() for part in word.partition("="))
        if not (axis and sign and rest):
            raise DatasetError(f"{option} {word}: write {option} AXIS={'VALUE' if option == '--at' else 'max'}")
        check_axis(dataset, f"{option} {word}", axis)
        if axis in named:
            raise DatasetError(f"{option} {word}: {axis} is fixed or reduced already; keep one of the two")
        named.add(axis)
        yield f"{option} {word}", axis, rest


def _unit(axis: str) -> str:
    """Give the unit of an axis behind a value; nothing if it has none."""
    return f" {PHYSICAL[axis].unit}" if axis in PHYSICAL else ""


def axes_of(dataset: xarray.Dataset) -> list[str]:
    """List the axes of a dataset; of points, the parameters that they have instead, and the solvers."""
    dims = [str(axis) for axis in dataset["status"].dims]
    return [axis for axis in dims if axis != SCENE] + (
        [name for name in INPUTS if name in dataset.coords and dataset[name].dims == (SCENE,)] if SCENE in dims else []
    )


def check_axis(dataset: xarray.Dataset, option: str, axis: str) -> None:
    """Refuse what is not an axis of a dataset."""
    known = axes_of(dataset)
    if axis in known:
        return
    remedy = did_you_mean(axis, known) if known else "it has a single scene and no axes"
    if axis in dataset.coords and dataset[axis].ndim == 0:
        remedy = f"{axis} is {dataset[axis].item():g}{_unit(axis)} in the whole dataset"
    raise DatasetError(f"{option}: not an axis of this dataset; {remedy}")


def in_unit(text: str, unit: str) -> float:
    """Read a number, or a quantity as so many of a unit; NaN where it is neither."""
    with suppress(ValueError):
        return float(text)
    parts = QUANTITY.fullmatch(text)
    factor = factor_between(parts[2], unit) if parts and parts[2] else None
    return float(Decimal(parts[1]) * factor) if parts and factor else np.nan


def value_in(text: str, name: str, option: str) -> float:
    """Read a value of a variable, a number in SI or a quantity; `option` is what has it, for a refusal.

    >>> value_in("10 mJ", "dissipated_energy_si", "--levels"), value_in("0.5", "A", "--levels")
    (0.01, 0.5)
    """
    value = in_unit(text, unit_of(name))
    if np.isnan(value):
        own = (
            f"is in {unit_of(name)}; write a number or a quantity" if unit_of(name) != "1" else "is a number; write one"
        )
        raise DatasetError(f'{option}: "{text}" is not a value of {name}, which {own}')
    return value


def ends_in(text: str, name: str, option: str) -> tuple[float, float]:
    """Read a range of a variable such as 0.1:0.5, either end of which may be left out."""
    first, _, last = (end.strip() for end in text.partition(":"))
    low, high = value_in(first or "-inf", name, option), value_in(last or "inf", name, option)
    if low > high:
        raise DatasetError(f"{option}: the lower end comes first; exchange the two")
    return low, high


def _within(option: str, values: NDArray[np.float64], ends: tuple[float, float]) -> NDArray[np.intp]:
    """Find the items of an axis within a range."""
    low, high = ends
    left = np.flatnonzero((low - SLACK * abs(low) <= values) & (values <= high + SLACK * abs(high)))
    if not left.size:
        raise DatasetError(f"{option}: no value of the axis is within; it has {values.min():g} to {values.max():g}")
    return left


def _between(option: str, values: NDArray[np.float64], axis: str, value: float) -> Between:
    """Find the two items that a value lies between, by ratio if the axis is log-spaced; or twice that which has it."""
    if (same := np.flatnonzero(np.isclose(values, value, rtol=SLACK, atol=0.0))).size:
        item = int(same[0] if np.isinf(value) else same[np.argmin(np.abs(values[same] - value))])
        return Between(axis=axis, value=value, items=(item, item), share=0.0)
    rising = np.argsort(values, kind="stable")[: np.isfinite(values).sum()]
    upper = int(np.searchsorted(values[rising], value))
    if not 0 < upper < rising.size:
        written = f"{values.min():g} to {values.max():g}{_unit(axis)}"
        raise DatasetError(f"{option}: outside the axis, which has values of {written}; choose one within")
    items = (int(rising[upper - 1]), int(rising[upper]))
    low, place, high = (np.log if is_log(values) else np.array)([values[items[0]], value, values[items[1]]])
    return Between(axis=axis, value=value, items=items, share=float((place - low) / (high - low)))
