"""The points of a measured loop: which of them load and which unload."""

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from gradhesion.core.loops.measured.neighbours import of_differences, pieces
from gradhesion.core.types import Floats, Truths

_Ints = NDArray[np.int32]

TURN: Final = 0.2
"""How far the depth moves back at a turn, in parts of its span: noise, drift and creep in a pause are less."""
_STILL: Final = 8.0
"""Standard deviations of the depth within which a point has not moved."""
_BLOCKS: Final = 4096
"""Blocks of points whose extremes are searched for turns."""
_SPIKE: Final = 5
"""Points of the running median, which removes a spike."""


def ways(depth: Floats, cycle: _Ints | None = None) -> tuple[Truths, _Ints]:
    """Find which points unload, from their order.

    Parameters
    ----------
    depth
        In the order in which the points were measured, any unit; shape (n,).
    cycle
        The number of the cycle of each point, if known; one cycle loads up to its deepest point. If not known, a new
        one begins where the depth has fallen and rises again, each time by a fifth of its span.

    Returns
    -------
    unloading
        Whether each point unloads, shape (n,).
    cycle
        The number of its cycle, from 1 if these were found here; shape (n,).

    Examples
    --------
    >>> unloading, cycle = ways(np.array([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0]))
    >>> unloading.astype(int).tolist(), cycle.tolist()
    ([0, 0, 0, 1, 1, 0, 0, 1], [1, 1, 1, 1, 1, 2, 2, 2])
    """
    if cycle is not None:
        unloading = np.zeros(depth.size, bool)
        order, begin = pieces(unloading, cycle)
        for own in np.split(order, begin[1:]):
            unloading[own[int(np.argmax(depth[own])) + 1 :]] = True
        return unloading, cycle
    smooth = median_filter(depth, _SPIKE, mode="nearest") if depth.size > 10 * _SPIKE else depth
    far = TURN * float(np.ptp(smooth))
    still = min(_STILL * of_differences(depth, np.zeros(1, np.intp)), 0.25 * far)
    unloading, number = np.zeros(depth.size, bool), np.ones(depth.size, np.int32)
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


def _extremes(row: Floats) -> NDArray[np.intp]:
    """Give the places of the extremes of short blocks; those of the row are among them."""
    if row.size <= 2 * _BLOCKS:
        return np.arange(row.size)
    length = -(-row.size // _BLOCKS)
    whole = row.size // length * length
    begin = np.arange(0, whole, length)
    blocks = row[:whole].reshape(-1, length)
    found = (begin + blocks.argmin(axis=1), begin + blocks.argmax(axis=1), np.arange(whole, row.size))
    return np.unique(np.concatenate(found))
