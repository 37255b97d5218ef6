"""The points of a measured loop: which of them load and which unload, which are neighbours, and how these differ."""

from math import comb
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from gradhesion.core.types import Floats, Truths

_Ints = NDArray[np.int32]
_Places = NDArray[np.intp]

TURN: Final = 0.2
"""How far the depth moves back at a turn, in parts of its span: noise, drift and creep in a pause are less."""
_STILL: Final = 8.0
"""Standard deviations of the depth within which a point has not moved."""
_BLOCKS: Final = 4096
"""Blocks of points whose extremes are searched for turns."""
_SPIKE: Final = 5
"""Points of the running median, which removes a spike."""
FEWEST: Final = 40
"""Number of points below which nothing is said of their order."""
_COARSE: Final = 0.12
"""Step between neighbours, in parts of the span of the depth, above which many turns mean that there is no order."""
_OF_NORMAL: Final = 0.6744897501960817
"""The median of the absolute value of a normal variable of unit variance."""
_SHUFFLED: Final = 3.0
"""How much smaller differences of load are in the order of depth, if the points are in no order of their own."""
_STEP: Final = 0.05
"""Steps of the depth, in parts of its span, below which points are in order."""


def ways(depth: Floats, cycle: _Ints | None = None) -> tuple[Truths, _Ints]:
    """Find which points unload, from their order, and the number of the cycle of each.

    Depths, (n,), are in the order in which they were measured, in any unit. A cycle that is known loads up to its
    deepest point. If none is, they count from 1, and a new one begins where the depth has fallen and rises again, each
    time by a fifth of its span.

    >>> unloading, cycle = ways(np.array([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0]))
    >>> unloading.astype(int).tolist(), cycle.tolist()
    ([0, 0, 0, 1, 1, 0, 0, 1], [1, 1, 1, 1, 1, 2, 2, 2])
    """
    unloading = np.zeros(depth.size, bool)
    if cycle is not None:
        order, begin = pieces(unloading, cycle)
        for own in np.split(order, begin[1:]):
            unloading[own[int(np.argmax(depth[own])) + 1 :]] = True
        return unloading, cycle
    smooth = median_filter(depth, _SPIKE, mode="nearest") if depth.size > 10 * _SPIKE else depth
    far = TURN * float(np.ptp(smooth))
    still = min(_STILL * of_differences(depth, np.zeros(1, np.intp)), 0.25 * far)
    number = np.ones(depth.size, np.int32)
    falling, at, now = False, 0, 1  # the last extreme so far, and the number of the cycle
    for i in _extremes(smooth).tolist():
        if smooth[i] <= smooth[at] if falling else smooth[i] >= smooth[at]:
            at = i
        elif abs(smooth[i] - smooth[at]) >= far > 0.0:
            if smooth is not depth:  # the running median flattens a turn
                least = max(0, at - _SPIKE // 2)
                near = depth[least : at + _SPIKE // 2 + 1] * (-1.0 if falling else 1.0)
                at = least + near.size - 1 - int(np.argmax(near[::-1]))
            if falling:  # points that stay there, as after a jump out of contact, belong to the branch before
                at += int(np.flatnonzero(depth[at : max(at, i) + 1] <= depth[at] + still)[-1])
            falling = not falling
            now += not falling
            unloading[at + 1 :], number[at + 1 :] = falling, now
            at = i
    return unloading, number


def _extremes(row: Floats) -> _Places:
    """Give the places of the extremes of short blocks; those of the row are among them."""
    if row.size <= 2 * _BLOCKS:
        return np.arange(row.size)
    length = -(-row.size // _BLOCKS)
    whole = row.size // length * length
    begin, blocks = np.arange(0, whole, length), row[:whole].reshape(-1, length)
    found = (begin + blocks.argmin(axis=1), begin + blocks.argmax(axis=1), np.arange(whole, row.size))
    return np.unique(np.concatenate(found))


def has_order(depth: Floats, cycle: _Ints | None = None) -> bool:
    """Return whether points, given as to `ways`, are in an order in which a loop can be measured.

    False where there are far more turns than cycles, with hardly a point between them; True of few points.

    >>> up = np.linspace(0.0, 1.0, 100)
    >>> has_order(up), has_order(np.random.default_rng(0).permutation(up))
    (True, False)
    """
    if depth.size < FEWEST:
        return True
    known = 1 if cycle is None else np.unique(cycle).size
    row = depth if cycle is None else depth[np.argsort(cycle, kind="stable")]
    step = float(np.median(np.abs(np.diff(row))))
    return int(ways(row)[1].max()) <= 2 * known + 1 or step < _COARSE * float(np.ptp(depth))


def pieces(unloading: Truths, cycle: _Ints) -> tuple[_Places, _Places]:
    """Sort points by cycle and branch, in their own order within these; return their places, and where branches begin.

    >>> order, begin = pieces(np.array([False, True, False]), np.ones(3, np.int32))
    >>> order.tolist(), begin.tolist()
    ([0, 2, 1], [0, 2])
    """
    branch = 2 * np.unique(cycle, return_inverse=True)[1] + unloading if np.ptp(cycle) else unloading.astype(np.intp)
    order = np.argsort(branch, kind="stable")
    return order, np.concatenate([[0], np.flatnonzero(np.diff(branch[order])) + 1])


def along(depth: Floats, load: Floats, unloading: Truths, cycle: _Ints) -> tuple[_Places, _Places]:
    """Sort points as `pieces` does, but by depth within a branch if they come in no order.

    >>> mixed = np.random.default_rng(0).permutation(100).astype(float)
    >>> order, _ = along(mixed, mixed, np.zeros(100, bool), np.ones(100, np.int32))
    >>> bool(np.all(np.diff(mixed[order]) > 0.0))
    True
    """
    order, begin = pieces(unloading, cycle)
    if not np.median(np.abs(np.diff(depth[order]))) > _STEP * np.ptp(depth):
        return order, begin
    sort = np.lexsort((depth, unloading, cycle))
    shuffled = of_differences(load[order], begin) > _SHUFFLED * of_differences(load[sort], begin)
    return (sort if shuffled else order), begin


def of_differences(row: Floats, begin: _Places, order: int = 2, sound: Truths | None = None) -> float:
    """Estimate the standard deviation of white noise by the median of differences of neighbours; 0 without any.

    Differences are taken within the pieces of a row (n,) that begin at some places, of values that are `sound`. The
    higher their order, the less bends of the curve affect them, and the more jumps do.

    >>> row = np.random.default_rng(0).standard_normal(1000) + 5.0 * np.sin(np.arange(1000) / 10.0)
    >>> round(of_differences(row, np.array([0]), order=6), 1)
    1.0
    """
    if row.size <= order:
        return 0.0
    piece = np.searchsorted(begin, np.arange(row.size), "right")
    use = piece[order:] == piece[:-order]
    if sound is not None:
        bad = np.concatenate([[0], np.cumsum(~sound)])
        use &= bad[order + 1 :] == bad[: -order - 1]
    size = np.abs(np.diff(row, order)[use])
    norm = _OF_NORMAL * float(np.sqrt(comb(2 * order, order)))
    return float(np.median(size)) / norm if size.size else 0.0
