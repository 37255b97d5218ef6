"""The values that a parameter expands to, and what is wrong with those of all parameters together."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.keys import INPUTS, Path
from gradhesion.cli.study.form.inputs import Entry, Range
from gradhesion.cli.study.form.mistakes import Mistake
from gradhesion.cli.terminal.wording import shown

Values = float | NDArray[np.float64]
"""The values of a parameter: a float is fixed, an array is an axis."""

MOST_VALUES: Final = 10_000_000
"""Values of one axis: it is held in memory, and so are its kin."""

DIGITS: Final = 12
"""Significant digits of the decimals that the values of a range are moved to, where these are within rounding."""


def expanded(entry: Entry) -> Values:
    """
    Expand a valid input of a study; a range begins and ends at exactly its `start` and `stop`.

    >>> expanded(0.3)
    0.3
    >>> expanded(Range(start=0.01, stop=1.0, num=3, spacing="log"))
    array([0.01, 0.1 , 1.  ])
    """
    if isinstance(entry, Range):
        space = np.geomspace if entry.spacing == "log" else np.linspace
        low, high = sorted((entry.start, entry.stop))
        values = space(entry.start, entry.stop, entry.num)
        values = _shortest(values, np.abs(values) if entry.spacing == "log" else max(abs(entry.start), abs(entry.stop)))
        values = np.clip(values, low, high)
        values[0], values[-1] = entry.start, entry.stop
        return values + 0.0  # no negative zeros
    if isinstance(entry, list):
        return np.array(entry, dtype=np.float64) + 0.0
    return float(entry) + 0.0


def _shortest(values: NDArray[np.float64], size: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """
    Move values to decimals of a few digits that are within the rounding of a range of this `size`.

    So that a value can be selected by what one would write: 0.69 and not 0.6900000000000001.

    >>> float(_shortest(np.array([0.6900000000000001]), 1.0)[0])
    0.69
    """
    with np.errstate(all="ignore"):
        places = np.clip(DIGITS - 1 - np.floor(np.log10(size)), -22, 22)
        power = 10.0 ** np.abs(places)  # exact to 10^22
        decimals = np.where(places >= 0, np.rint(values * power) / power, np.rint(values / power) * power)
        near = np.abs(decimals - values) <= 4 * np.finfo(float).eps * size  # of a few roundings in making the range
    moved = np.where(near & np.isfinite(decimals), decimals, values)
    return moved if np.unique(moved).size == np.unique(values).size else values


def mistake_of_range(path: Path, written: Any, entry: Entry) -> Mistake | None:
    """Check that a range makes sense as a whole, and that an axis can be held in memory."""
    if isinstance(entry, list) and len(entry) > MOST_VALUES:
        return Mistake(path, written, f"more than {MOST_VALUES:,} values in one list; split the study")
    if not isinstance(entry, Range):
        return None
    start, stop, num = entry.start, entry.stop, entry.num
    if num > MOST_VALUES:
        return Mistake((*path, "num"), num, f"more than {MOST_VALUES:,} values in one axis; split the study")
    if num == 1 and start != stop:
        sentence = "one value cannot be at both start and stop; use num = 2 or more, or a list of one value"
        return Mistake((*path, "num"), num, sentence)
    if num > 1 and start == stop:
        value = shown(written["start"])
        sentence = f"start and stop are the same, so the value {value} repeats; write [{value}] or another stop"
        return Mistake(path, written, sentence)
    if entry.spacing == "log" and min(start, stop) <= 0:
        end = "start" if start <= 0 else "stop"
        return Mistake((*path, end), written[end], 'log spacing needs values > 0; raise it, or use spacing = "linear"')
    return None


def mistakes_of_grid(axes: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the axes of a grid: no value twice, no impossible material, and a size that can be done."""
    for name, values in axes.items():
        if isinstance(values, np.ndarray):
            unique, counts = np.unique(values, return_counts=True)
            if np.any(counts > 1):
                value = float(unique[np.argmax(counts > 1)])
                places = np.flatnonzero(values == value)[:2].tolist()
                unit = "" if INPUTS[name].unit == "1" else f" {INPUTS[name].unit}"
                items = f"items {places[0]} and {places[1]}"
                sentence = f"the axis repeats the value {shown(value)}{unit} ({items}); remove one"
                yield Mistake((INPUTS[name].table, name), values.tolist()[:9], sentence)
    if {"k", "nu"} <= axes.keys() and np.any(axes["k"] == 1.0):
        others = np.atleast_1d(axes["nu"])
        others = others[others != 0.5]
        if others.size:
            sentence = f"with k = 1 and nu = {others[0]} the surface has no stiffness; use nu = 0.5, or k below 1"
            yield Mistake(("parameters", "k"), 1.0, sentence)


def mistakes_of_points(lists: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the lists of points: one length, and no impossible material in any scene."""
    lengths = {name: values.size for name, values in lists.items() if isinstance(values, np.ndarray)}
    first = next(iter(lengths), "")
    for name, length in lengths.items():
        if length != lengths[first]:
            sentence = (
                f"it has {length} values, but {first} has {lengths[first]}; "
                'with layout = "points" all lists have one length (a single number applies to all scenes)'
            )
            yield Mistake((INPUTS[name].table, name), np.asarray(lists[name]).tolist()[:9], sentence)
    if {"k", "nu"} <= lists.keys() and len({lengths[name] for name in ("k", "nu") if name in lengths}) <= 1:
        k, nu = np.broadcast_arrays(np.atleast_1d(lists["k"]), np.atleast_1d(lists["nu"]))
        scenes = np.flatnonzero((k == 1.0) & (nu != 0.5))
        if scenes.size:
            scene = int(scenes[0])
            more = f" (and {scenes.size - 1} more)" if scenes.size > 1 else ""
            sentence = (
                f"with k = 1 and nu = {nu[scene]} in scene {scene}{more}, counted from 0, the surface has no "
                "stiffness; use nu = 0.5 there, or k below 1"
            )
            yield Mistake(("parameters", "k"), 1.0, sentence)
