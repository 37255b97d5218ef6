"""The values that an input expands to, and what is wrong with those of one input."""

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.rules.form import Entry
from gradhesion.cli.study.rules.keys import Range
from gradhesion.core.problem.inputs import INPUTS

Values = float | NDArray[np.float64]
"""The values of a parameter: a float is fixed, an array is an axis."""
MOST_VALUES: Final = 10_000_000
"""Values of one axis: it is held in memory, and so are its kin."""
DIGITS: Final = 12
"""Significant digits of the decimals that the values of a range are moved to, where these are within rounding."""


def expanded(entry: Entry) -> Values:
    """Expand a valid input of a study; a range begins and ends at exactly its `start` and `stop`.

    >>> expanded(0.3)
    0.3
    >>> expanded(Range(start=0.01, stop=1.0, num=3, spacing="log"))
    array([0.01, 0.1 , 1.  ])
    """
    if not isinstance(entry, Range):
        return np.array(entry, dtype=np.float64) + 0.0 if isinstance(entry, list) else float(entry) + 0.0
    if entry.num is None:  # searched
        return np.array(entry.ends)
    ends = np.array([entry.start, entry.stop]) + 0.0  # no negative zeros
    spaced = np.geomspace if entry.spacing == "log" else np.linspace
    values = spaced(ends[0], ends[1], entry.num)
    values = _shortest(values, np.abs(values) if entry.spacing == "log" else np.abs(ends).max())
    values = np.clip(values, ends.min(), ends.max())
    values[0], values[-1] = ends
    return np.asarray(values + 0.0)


def _shortest(values: NDArray[np.float64], size: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Move values to decimals of a few digits that are within the rounding of a range of this `size`.

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


def range_mistakes(name: str, entry: Entry) -> Iterator[tuple[str, str]]:
    """Check that a range makes sense as a whole, and that an axis can be held in memory."""
    at = f"{INPUTS[name].table}.{name}"
    if isinstance(entry, list) and len(entry) > MOST_VALUES:
        yield at, f"more than {MOST_VALUES:,} values in one list; split the study"
    if not isinstance(entry, Range):
        return
    if entry.num and entry.num > MOST_VALUES:
        yield f"{at}.num", f"more than {MOST_VALUES:,} values in one axis; split the study"
    elif entry.num == 1 and entry.start != entry.stop:
        yield f"{at}.num", "one value cannot be at both start and stop; use num = 2 or more, or a list of one value"
    elif entry.start == entry.stop and entry.num != 1:
        yield at, "start and stop are the same; write another stop, or a number"
    elif entry.spacing == "log" and entry.ends[0] <= 0.0:
        end = "start" if entry.start <= 0.0 else "stop"
        yield f"{at}.{end}", 'log spacing needs values > 0; raise it, or use spacing = "linear"'


def repeated(name: str, values: Values) -> Iterator[tuple[str, str]]:
    """Check that an axis has no value twice."""
    unique, counts = np.unique(values, return_counts=True)
    if counts.max(initial=1) > 1:
        value = float(unique[counts.argmax()])
        first, second, *_ = np.flatnonzero(values == value).tolist()
        unit = "" if INPUTS[name].unit == "1" else f" {INPUTS[name].unit}"
        words = f"the axis repeats the value {value!r}{unit} (items {first} and {second}); remove one"
        yield f"{INPUTS[name].table}.{name}", words
