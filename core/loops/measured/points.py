"""The order of the points of a measured loop: which load, which unload, which are neighbours, and their noise."""

from math import comb, sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.types import Floats, Truths

_Ints = NDArray[np.int32]
_Places = NDArray[np.intp]

TURN: Final = 0.2
"""How far the depth moves back at a turn, in parts of its span: noise, drift and creep in a pause are less."""
_STILL: Final = 8.0  # standard deviations of the depth within which a point has not moved
_BLOCKS: Final = 4096  # blocks of points whose extremes are searched for turns: a search of all would take minutes
_TIE: Final = 1e-9  # part of a turn that decides between equal depths
_SPIKE: Final = 3  # points of the running median, which removes a spike
FEWEST: Final = 40
"""Number of points below which nothing is said of their order."""
_COARSE: Final = 0.12
"""Median step between neighbours, in parts of the span of the depth, from which on points are in no order."""
_SORTED: Final = 0.05  # the same of one branch: to sort it by depth does no harm from there on
FLOOR: Final = 1e-6
"""Least noise, in parts of the span, that computing needs: below the digits of any instrument."""
_REPEATED: Final = 0.7
"""Number of different values over that of all, below which a row is digitised more coarsely than its steps."""
_OF_NORMAL: Final = 0.6744897501960817  # the median of the absolute value of a normal variable of unit variance


def ways(depth: Floats, cycle: _Ints | None = None) -> tuple[Truths, _Ints]:
    """Find which points unload, from their order, and the number of the cycle of each.

    Depths, (n,), are in the order in which they were measured, in any unit. A cycle that is known loads up to its
    deepest point. If none is, they count from 1, and a new one begins where the depth has fallen and rises again, each
    time by a fifth of its span.

    >>> unloading, cycle = ways(np.array([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0]))
    >>> unloading.astype(int).tolist(), cycle.tolist()
    ([0, 0, 0, 1, 1, 0, 0, 1], [1, 1, 1, 1, 1, 2, 2, 2])
    """
    from scipy.ndimage import median_filter  # noqa: PLC0415 (readers of fits do without)
    from scipy.signal import find_peaks  # noqa: PLC0415 (it takes half a second)

    if cycle is not None:
        unloading = np.zeros(depth.size, bool)
        order, begin = along(depth, unloading, cycle, sort=False)
        for own in np.split(order, begin[1:]):
            unloading[own[int(np.argmax(depth[own])) + 1 :]] = True
        return unloading, cycle
    smooth = median_filter(depth, _SPIKE, mode="nearest") if depth.size > FEWEST else depth
    far = TURN * float(np.ptp(smooth))
    smooth = smooth - np.linspace(0.0, _TIE * far, depth.size)  # of equal tops the first counts, of bottoms the last
    place = _extremes(smooth)
    deepest = place[find_peaks(np.append(smooth.min(), smooth[place]), prominence=far)[0] - 1]  # perhaps the first
    shallowest = place[find_peaks(-smooth[place], prominence=far)[0]]
    # points that stay there, as after a jump out of contact, belong to the cycle before
    still = smooth[shallowest] + min(_STILL * of_differences(depth), 0.25 * far)
    ends = [
        at + int(np.flatnonzero(smooth[at:until] <= level)[-1])
        for at, until, level in zip(shallowest, np.append(deepest[1:], depth.size), still, strict=False)
    ]
    begun, ended = (np.searchsorted(np.array(turns, int), np.arange(depth.size)) for turns in (deepest, ends))
    return begun > ended, (ended + 1).astype(np.int32)


def _extremes(row: Floats) -> _Places:
    """Return the places of the extremes of short blocks; those of the row are among them."""
    length = max(1, row.size // _BLOCKS)
    begin = np.arange(0, row.size - length + 1, length)
    blocks = row[: begin.size * length].reshape(-1, length)
    rest = np.arange(begin.size * length, row.size)
    return np.unique(np.concatenate([begin + blocks.argmin(axis=1), begin + blocks.argmax(axis=1), rest]))


def has_order(depth: Floats, cycle: _Ints | None = None) -> bool:
    """Return whether points, given as to `ways`, are in an order in which a loop can be measured; True of few points.

    >>> up = np.linspace(0.0, 1.0, 100)
    >>> has_order(up), has_order(np.random.default_rng(0).permutation(up))
    (True, False)
    """
    row = depth if cycle is None else depth[np.argsort(cycle, kind="stable")]
    return row.size < FEWEST or bool(np.median(np.abs(np.diff(row))) < _COARSE * np.ptp(row))


def along(depth: Floats, unloading: Truths, cycle: _Ints, *, sort: bool = True) -> tuple[_Places, _Places]:
    """Return the places of points by cycle and branch, and where branches begin among them.

    Within a branch they keep their order; if that is none, they are sorted by depth.

    >>> order, begin = along(np.zeros(3), np.array([False, True, False]), np.ones(3, np.int32))
    >>> order.tolist(), begin.tolist()
    ([0, 2, 1], [0, 2])
    """
    order = np.lexsort((unloading, cycle))
    if sort and np.median(np.abs(np.diff(depth[order]))) > _SORTED * np.ptp(depth):
        order = np.lexsort((depth, unloading, cycle))
    branch = 2 * cycle.astype(np.int64) + unloading
    return order, np.append(0, np.flatnonzero(np.diff(branch[order])) + 1)


def of_differences(row: Floats, order: int = 2) -> float:
    """Estimate the standard deviation of white noise by the median of differences of neighbours; 0 without any.

    Drift and jumps do not affect it. The higher the order of the differences, the less bends of the curve do.

    >>> row = np.random.default_rng(0).standard_normal(1000) + 5.0 * np.sin(np.arange(1000) / 10.0)
    >>> round(of_differences(row, order=6), 1)
    1.0
    """
    if row.size <= order:
        return 0.0
    return float(np.median(np.abs(np.diff(row, order)))) / (_OF_NORMAL * sqrt(comb(2 * order, order)))


def noise_of(depth: Floats, load: Floats, unloading: Truths, cycle: _Ints) -> tuple[float, float]:
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


def _digit(row: Floats, begin: _Places) -> float:
    """Give the standard deviation of rounding, where the longest branch of a row has many equal values on a grid."""
    longest = max(np.split(row, begin[1:]), key=np.size)
    steps = np.diff(np.unique(longest))
    if not 0 < steps.size < _REPEATED * longest.size - 1.0:
        return 0.0
    multiples = steps / steps.min()
    is_grid = np.mean(np.abs(multiples - np.rint(multiples)) < 0.1) > 0.9
    return float(steps.min()) / sqrt(12.0) if is_grid else 0.0
