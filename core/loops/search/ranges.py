"""The ranges of a fit of a loop, those of zeros from the data; and which values lie at an end of their range."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from gradhesion.core.loops.measured.features import BaseLine, ContactPoint
from gradhesion.core.loops.paths.offsets import DEPTH_ZERO, LOAD_ZERO, TILT, Offsets
from gradhesion.core.types import Floats, Truths

_NEAR: Final = 0.01
"""Part of a range: a value closer than this to an end is on the bound."""
_WIDE: Final = 10.0
"""Ratio of stop to start above which a range is measured by its logarithm."""


def zeros_of(points: Floats, back: Truths, line: BaseLine | None, contact: ContactPoint | None) -> tuple[float, float]:
    """Return estimates of the load out of contact and of the depth at which contact begins."""
    first = points[~back] if not back.all() else points
    at = int(np.argmin(first[:, 0]))
    level = float(first[at, 1]) if line is None else line.level
    if contact is not None:
        return level, 0.0
    end = math.nan if line is None else line.ends[0]
    return level, float(first[at, 0]) if math.isnan(end) and not back.all() else end


def searched(
    points: Floats, free: Mapping[str, tuple[float, float]], zeros: Offsets, line: BaseLine | None
) -> dict[str, tuple[float, float]]:
    """Return the ends of the ranges that are searched, by name, those of offsets after those that are free.

    Unless `zeros` says where, depths are searched within the data, rows of depth in m and load in N of shape (n, 2),
    and loads within the pull-off force of the base line.
    """
    ranges = {name: (float(low), float(high)) for name, (low, high) in free.items()}
    least, span = points.min(axis=0), np.ptp(points, axis=0)
    own = {DEPTH_ZERO: (least[0], least[0] + span[0]), LOAD_ZERO: (least[1] - 0.1 * span[1], least[1] + span[1])}
    if line is not None:
        reach = line.level - float(least[1]) + 5.0 * line.spread
        own[LOAD_ZERO] = (line.level - reach, line.level + reach)
    if zeros.slope:
        own[TILT] = (-span[1] / span[0], span[1] / span[0])
    given = {DEPTH_ZERO: zeros.indentation, LOAD_ZERO: zeros.load}
    own |= {name: ends for name, ends in given.items() if isinstance(ends, tuple)}
    return ranges | {name: (float(own[name][0]), float(own[name][1])) for name in zeros.names}


def is_on_bound(value: float, ends: tuple[float, float]) -> bool:
    """Say whether a value is within 1 % of a range of an end of it."""
    low, high = ends
    if low > 0.0 and high > _WIDE * low:
        value, low, high = math.log(value), math.log(low), math.log(high)
    return value - low < _NEAR * (high - low) or high - value < _NEAR * (high - low)
