"""Which points of a loop are neighbours on it, and how they differ."""

from math import comb
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.types import Floats, Truths

_Ints = NDArray[np.int32]
_Places = NDArray[np.intp]

_OF_NORMAL: Final = 0.6744897501960817
"""The median of the absolute value of a normal variable of unit variance."""
_SHUFFLED: Final = 3.0
"""How much smaller differences of load are in the order of depth, if the points are in no order of their own."""
_STEP: Final = 0.05
"""Steps of the depth, in parts of its span, below which points are in order."""


def pieces(unloading: Truths, cycle: _Ints) -> tuple[_Places, _Places]:
    """Sort points by cycle and branch, in their own order within these.

    Returns
    -------
    order
        The places of the points, branch by branch; shape (n,).
    begin
        Where each branch begins in it.

    Examples
    --------
    >>> order, begin = pieces(np.array([False, True, False]), np.ones(3, np.int32))
    >>> order.tolist(), begin.tolist()
    ([0, 2, 1], [0, 2])
    """
    branch = 2 * np.unique(cycle, return_inverse=True)[1] + unloading if np.ptp(cycle) else unloading.astype(np.intp)
    order = np.argsort(branch, kind="stable")
    return order, np.concatenate([[0], np.flatnonzero(np.diff(branch[order])) + 1])


def along(depth: Floats, load: Floats, unloading: Truths, cycle: _Ints) -> tuple[_Places, _Places]:
    """Sort points along their branches: as they come, or by depth if they come in no order.

    Parameters
    ----------
    depth, load, unloading, cycle
        As those of `gradhesion.core.loops.measured.noise.noise_of`.

    Returns
    -------
    As those of `pieces`.

    Examples
    --------
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
    """Estimate white noise by differences of neighbours that lie in one piece and are sound.

    Parameters
    ----------
    row
        Sorted as by `pieces`, shape (n,).
    begin
        Where its pieces begin.
    order
        Of the differences: the higher, the less bends of the curve affect them, and the more jumps do.
    sound
        Whether each value may be used, shape (n,); all if not given.

    Returns
    -------
    The standard deviation, by the median; 0 where there is no difference.

    Examples
    --------
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
