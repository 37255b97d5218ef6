"""The noise of the points of a measured loop, estimated from the points alone."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.loops.measured.points import along, of_differences, pieces
from gradhesion.core.types import Floats, Truths

FLOOR: Final = 1e-6
"""Least noise, in parts of the span, that computing needs: below the digits of any instrument."""
_UNSEEN: Final = 0.04
"""Part of the variance of the load that noise of the depth may add without being noticed."""
_REPEATED: Final = 0.7
"""Number of different values over that of all, below which a row is digitised more coarsely than its steps."""
_WINDOW: Final = 16
"""Neighbouring points that give a slope, of points in no order; of many points, a share of a branch."""
_TINY: Final = float(np.finfo(float).tiny)


def noise_of(depth: Floats, load: Floats, unloading: Truths, cycle: NDArray[np.int32]) -> tuple[float, float]:
    """Estimate the standard deviations of depth and load from the points alone.

    Depths and loads are in the order in which the points were measured, in any unit; `unloading` and `cycle` are the
    way and the cycle of each, within which differences are taken; all of shape (n,). White noise is that of the median
    of second differences, which neither drift nor jumps move, and of a coarse digit at least (its step over the root of
    12). Where the points of a branch are in no order, that of load is found where the curve is flat and that of depth
    where it is steep. At least a millionth of the span; too high of points further apart than the curve bends.

    >>> rng = np.random.default_rng(0)
    >>> depth, load = np.linspace(0.0, 1.0, 2000), np.linspace(0.0, 5.0, 2000)
    >>> rows = (depth + 0.01 * rng.standard_normal(2000), load + 0.2 * rng.standard_normal(2000))
    >>> back, one = np.zeros(2000, bool), np.ones(2000, np.int32)
    >>> [round(size, 2) for size in noise_of(*rows, back, one)]
    [0.01, 0.2]
    """
    file, begin = pieces(unloading, cycle)
    order, _ = along(depth, load, unloading, cycle)
    x, y = depth[order], load[order]
    in_order = np.array_equal(order, file)
    found = (of_differences(x, begin), of_differences(y, begin)) if in_order else _of_no_order(x, y, begin)
    sizes = [
        max(size, FLOOR * float(np.ptp(row)), _digit(row[file], begin), _TINY)
        for size, row in zip(found, (depth, load), strict=True)
    ]
    return sizes[0], sizes[1]


def _digit(row: Floats, begin: NDArray[np.intp]) -> float:
    """Give the standard deviation of rounding, where a row has many equal values and all are multiples of a step."""
    longest = max(np.split(row, begin[1:]), key=lambda piece: piece.size)
    values = np.unique(longest)
    steps = np.diff(values)
    steps = steps[steps > 1e-12 * float(np.abs(values).max(initial=0.0))]
    if not steps.size or steps.size + 1 >= _REPEATED * longest.size:
        return 0.0
    multiples = steps / steps.min()
    is_grid = np.mean(np.abs(multiples - np.rint(multiples)) < 0.1) > 0.9
    return float(steps.min()) / float(np.sqrt(12.0)) if is_grid else 0.0


def _of_no_order(depth: Floats, load: Floats, begin: NDArray[np.intp]) -> tuple[float, float]:
    """Estimate the noise of points sorted by depth: about straight lines, where these are flat and where steep."""
    many = max(_WINDOW, depth.size // (_WINDOW**2 * begin.size))
    starts = [np.arange(a, b - many + 1, many) for a, b in zip(begin, [*begin[1:], depth.size], strict=True)]
    place = np.concatenate(starts)[:, None] + np.arange(many)
    if not place.size:
        return 0.0, of_differences(load, begin)
    x, y = (row[place] - row[place].mean(axis=1, keepdims=True) for row in (depth, load))
    slope = np.sum(x * y, axis=1) / np.maximum(np.sum(x * x, axis=1), _TINY)
    rest = np.sum((y - slope[:, None] * x) ** 2, axis=1) / (many - 2)
    rank = np.argsort(np.abs(slope))
    quarter = -(-rank.size // 4)
    flat, steep = rank[:quarter], rank[-quarter:]
    of_load = float(np.median(rest[flat]))
    seen = max(float(np.median(rest[steep])) - of_load, _UNSEEN * of_load)
    return float(np.sqrt(seen / max(float(np.median(slope[steep] ** 2)), _TINY))), float(np.sqrt(of_load))
