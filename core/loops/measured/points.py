"""The points of a measured loop: which of them load and unload, which are neighbours, their noise, and their means."""

import math
from dataclasses import dataclass
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
MOST: Final = 2000
"""Points that are fitted as they are; more are averaged to about as many means."""
_BENT: Final = 2.5  # standard deviations of noise by which blocks bend at most
_TOGETHER: Final = 7  # neighbouring blocks whose bends are tested together, since those of the curve have one sign
_JUMPS: Final = 6.0
"""Standard deviations of noise between neighbours, beside what they differ by as a rule, from which on it jumps."""
_BENDS: Final = 6
"""Order of the differences of means that detect noise which is not white: bends of the curve are of lower order."""
_SLOWER: Final = 1.2  # how much larger noise is then than that of neighbouring points, at least


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
    if sort and depth.size > 1 and np.median(np.abs(np.diff(depth[order]))) > _SORTED * np.ptp(depth):
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
    return float(np.median(np.abs(np.diff(row, order)))) / (_OF_NORMAL * math.sqrt(math.comb(2 * order, order)))


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
    return float(steps.min()) / math.sqrt(12.0) if is_grid else 0.0


@dataclass(frozen=True, eq=False)
class Averaged:
    """Means of neighbouring points, in the order of cycles and branches; arrays of shape (m,).

    `noise` are the standard deviations of a point, from which those of its means follow: higher where it is not white.
    """

    depth: Floats
    load: Floats
    unloading: Truths
    cycle: _Ints
    counts: Floats  # how many points each is the mean of
    noise: tuple[float, float]


def averaged(
    depth: Floats, load: Floats, unloading: Truths, cycle: _Ints, noise: tuple[float, float], most: int = MOST
) -> Averaged:
    """Average neighbouring points of one cycle and branch, unless there are no more than `most`.

    Blocks of one length give about `most` means. A block that bends or jumps by more than noise does is halved until
    none does, so that no mean lies across a jump or far beside a bend. Points, (n,), are as to `noise_of`, whose result
    `noise` is. Where means of blocks scatter more than white noise would, that larger noise is used.

    >>> depth = np.linspace(0.0, 1.0, 100_000)
    >>> load = np.where(depth < 0.5003, 0.0, 1.0)
    >>> found = averaged(depth, load, np.zeros(100_000, bool), np.ones(100_000, np.int32), (1e-6, 1e-3))
    >>> found.depth.size < 2100, set(found.load.tolist()), found.counts.sum()
    (True, {0.0, 1.0}, np.float64(100000.0))
    """
    if depth.size <= most:
        return Averaged(depth, load, unloading, cycle, np.ones(depth.size), noise)
    order, begin = along(depth, unloading, cycle)
    rows, length = np.stack([depth[order], load[order]]), max(2, round(depth.size / most))
    ends = [*begin[1:], depth.size]
    first = np.concatenate([np.arange(a, b, length) for a, b in zip(begin, ends, strict=True)])
    means = np.add.reduceat(rows, first, axis=1)[:, np.diff(first, append=depth.size) == length] / length
    slow = [of_differences(row, _BENDS) * math.sqrt(length) for row in means]
    found = [slower if _SLOWER * own < slower else own for own, slower in zip(noise, slow, strict=True)]
    while (bad := _bent(rows / np.array(found)[:, None], first)).any():
        half = (np.diff(first, append=depth.size)[bad] + 1) // 2
        first = np.sort(np.concatenate([first, first[bad] + half]))
    counts = np.diff(first, append=depth.size).astype(float)
    means = np.add.reduceat(rows, first, axis=1) / counts
    sides, cycles = unloading[order][first], cycle[order][first]
    return Averaged(means[0], means[1], sides, cycles, counts, (found[0], found[1]))


def _bent(rows: Floats, first: _Places) -> Truths:
    """Return which blocks of rows (2, n), over their noise, begun at some places, bend or jump by more than noise."""
    size = np.diff(first, append=rows.shape[1])
    count = np.repeat(size.astype(float), size)
    place = np.arange(rows.shape[1]) - np.repeat(first, size)
    steps = np.abs(np.diff(rows, axis=1, prepend=0.0))
    steps[:, place == 0] = 0.0
    usual = np.median(steps, axis=1, keepdims=True)
    jumps = np.maximum.reduceat(steps, first, axis=1) > _JUMPS * math.sqrt(2.0) + 3.0 * usual
    parabola = (place - 0.5 * (count - 1.0)) ** 2 - (count**2 - 1.0) / 12.0  # its sum over a block is 0
    norm = np.sqrt(np.maximum(np.add.reduceat(parabola**2, first), 1e-9))
    bends = np.add.reduceat((rows - np.repeat(rows[:, first], size, axis=1)) * parabola, first, axis=1) / norm
    window = np.full(min(_TOGETHER, size.size), _TOGETHER**-0.5)
    together = np.array([np.convolve(row * (size > 2), window, "same") for row in bends])
    return np.asarray((jumps | (np.abs(together) > _BENT) & (size > 2)).any(axis=0) & (size > 1))
