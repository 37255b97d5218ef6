"""The noise of the points of a measured loop, estimated from the points alone."""

from math import sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.loops.measured.points import along, of_differences
from gradhesion.core.types import Floats, Truths

FLOOR: Final = 1e-6
"""Least noise, in parts of the span, that computing needs: below the digits of any instrument."""
_REPEATED: Final = 0.7
"""Number of different values over that of all, below which a row is digitised more coarsely than its steps."""


def noise_of(depth: Floats, load: Floats, unloading: Truths, cycle: NDArray[np.int32]) -> tuple[float, float]:
    """Estimate the standard deviations of depth and load from the points alone.

    Depths and loads are in the order in which the points were measured, in any unit; `unloading` and `cycle` are the
    way and the cycle of each; all of shape (n,). White noise is that of the median of second differences, which neither
    drift nor jumps move, and of a coarse digit at least (its step over the root of 12); at least a millionth of the
    span. It is too high of points further apart than the curve bends. Where points are in no order and have to be
    sorted by depth, the noise of depth cannot be seen, and that of load contains it.

    >>> rng = np.random.default_rng(0)
    >>> depth, load = np.linspace(0.0, 1.0, 2000), np.linspace(0.0, 5.0, 2000)
    >>> rows = (depth + 0.01 * rng.standard_normal(2000), load + 0.2 * rng.standard_normal(2000))
    >>> back, one = np.zeros(2000, bool), np.ones(2000, np.int32)
    >>> [round(size, 2) for size in noise_of(*rows, back, one)]
    [0.01, 0.2]
    """
    order, begin = along(depth, unloading, cycle)
    least = float(np.finfo(float).tiny)
    found = [
        max(of_differences(row[order]), _digit(row[order], begin), FLOOR * float(np.ptp(row)), least)
        for row in (depth, load)
    ]
    return found[0], found[1]


def _digit(row: Floats, begin: NDArray[np.intp]) -> float:
    """Give the standard deviation of rounding, where the longest branch of a row has many equal values on a grid."""
    longest = max(np.split(row, begin[1:]), key=np.size)
    steps = np.diff(np.unique(longest))
    if not 0 < steps.size < _REPEATED * longest.size - 1.0:
        return 0.0
    multiples = steps / steps.min()
    is_grid = np.mean(np.abs(multiples - np.rint(multiples)) < 0.1) > 0.9
    return float(steps.min()) / sqrt(12.0) if is_grid else 0.0
