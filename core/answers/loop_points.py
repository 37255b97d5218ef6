"""The points of a measured loop: which of them load and which unload, how noisy they are, and what is added to them."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

OFFSETS: Final = ("indentation_offset", "load_offset")
"""What is added to the depth and the load of the path of a loop: the zeros of the instrument."""
TURN: Final = 0.2
"""How far the depth goes back for a turn, in parts of its span: noise and creep are less."""
_DIFFERENCES: Final = 2
"""Order of the differences by which noise is estimated: smooth parts of a curve have small ones."""
_OF_NORMAL: Final = 0.6744897501960817
"""The median of the absolute value of a normal variable of unit variance."""
FLOOR: Final = 1e-4
"""The least noise, in parts of the span: what is measured has no more digits than an instrument."""


def ways(depth: _Array, cycle: NDArray[np.int32] | None = None) -> tuple[NDArray[np.bool_], NDArray[np.int32]]:
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
        Whether each point does, shape (n,).
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
        for number in np.unique(cycle):
            own = np.flatnonzero(cycle == number)
            unloading[own[int(np.argmax(depth[own])) + 1 :]] = True
        return unloading, cycle
    far = TURN * float(np.ptp(depth))
    unloading, number = np.zeros(depth.size, bool), np.ones(depth.size, np.int32)
    falling, at, now = False, 0, 1  # the last extreme so far, and the number of the cycle
    for i in range(1, depth.size):
        ahead = depth[i] < depth[at] if falling else depth[i] > depth[at]
        if ahead or depth[i] == depth[at]:
            at = i
        elif abs(depth[i] - depth[at]) >= far > 0.0:
            falling = not falling
            now += not falling
            unloading[at + 1 :], number[at + 1 :] = falling, now
            at = i
    return unloading, number


def noise(depth: _Array, load: _Array, unloading: NDArray[np.bool_], cycle: NDArray[np.int32]) -> tuple[float, float]:
    """Estimate the standard deviations of depth and load from differences between neighbours.

    Parameters
    ----------
    depth, load
        In the order in which the points were measured, in any unit; shape (n,).
    unloading, cycle
        The way and the cycle of each point, shape (n,): differences are taken within one.

    Returns
    -------
    Standard deviations of white noise, by the median of second differences, which jumps hardly move. A tenth of a
    thousandth of the span at least. Of points that are further apart than the curve bends it is too high.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> depth, load = np.linspace(0.0, 1.0, 2000), np.linspace(0.0, 5.0, 2000)
    >>> rows = (depth + 0.01 * rng.standard_normal(2000), load + 0.2 * rng.standard_normal(2000))
    >>> back, one = np.zeros(2000, bool), np.ones(2000, np.int32)
    >>> [round(size, 2) for size in noise(*rows, back, one)]
    [0.01, 0.2]
    """
    found = []
    for row in (depth, load):
        pieces = [
            np.diff(row[(cycle == number) & (unloading == way)], _DIFFERENCES)
            for number in np.unique(cycle)
            for way in (False, True)
        ]
        differences = np.abs(np.concatenate(pieces))
        size = float(np.median(differences)) / (_OF_NORMAL * np.sqrt(6.0)) if differences.size else 0.0
        found.append(float(max(size, FLOOR * float(np.ptp(row)), np.finfo(float).tiny)))
    return found[0], found[1]
