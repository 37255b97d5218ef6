"""Means of many raw points along a loop: short blocks of neighbours, none of which bends or jumps."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.loops.measured.points import along, of_differences
from gradhesion.core.types import Floats, Truths

_Ints = NDArray[np.intp]

MOST: Final = 2000
"""Points that are fitted as they are; more are averaged to about as many means."""
_SIGMAS: Final = 5.0
"""Factor by which the sum of squares about a straight line, or one step, may exceed that of noise."""
_NEIGHBOURS: Final = 15
"""Blocks whose bends are tested together: together they show less than any one of them does."""
_CLIPPED: Final = 9.0
"""The most that the bend of one block adds to those of its neighbours, so that a jump does not affect them."""
_TOGETHER: Final = 1.0 + 4.0 * math.sqrt(2.0 / _NEIGHBOURS)
"""Mean square of their bends over that of noise, above which they are halved."""
_CORRELATED: Final = 1.3
"""Variance about a parabola over that of neighbours, above which noise is not white."""
_ORDER: Final = 6
"""Order of the differences of means that detect noise which is not white: bends of the curve are of lower order."""
_SLOWER: Final = 1.2
"""How much larger noise is then than that of neighbouring points, at least."""
_LEAST: Final = 5
"""Points of a block in the test of whether noise is white."""
_ROUNDING: Final = 1e-10
"""Sum of squares, over that of the length of a block, below which it is rounding, even in a row free of noise."""
_OF_SQUARE: Final = 0.4549364231195727
"""The median of the square of a normal variable of unit variance."""


@dataclass(frozen=True, eq=False)
class Averaged:
    """Means of neighbouring points, in the order of cycles and branches; arrays of shape (m,)."""

    depth: Floats
    load: Floats
    unloading: Truths
    cycle: NDArray[np.int32]
    counts: Floats
    """How many points each is the mean of."""
    noise: tuple[float, float]
    """Standard deviations of a point, from which those of these means follow: higher where noise is not white."""


def averaged(
    depth: Floats,
    load: Floats,
    unloading: Truths,
    cycle: NDArray[np.int32],
    noise: tuple[float, float],
    most: int = MOST,
) -> Averaged:
    """Average neighbouring points of one cycle and branch, unless there are no more than `most`.

    Blocks of one length give about `most` means. A block whose points are not on a straight line along the branch, as
    far as noise shows, is halved until they are, so that no mean lies across a jump or beside a bend of the curve by
    more than about its own noise. Points, (n,), are as to `noise_of`, whose result `noise` is; those in no order are
    sorted by depth. Where noise about short parabolas is larger, it is not white, and that larger value is used.

    >>> depth = np.linspace(0.0, 1.0, 100_000)
    >>> load = np.where(depth < 0.5003, 0.0, 1.0)
    >>> found = averaged(depth, load, np.zeros(100_000, bool), np.ones(100_000, np.int32), (1e-6, 1e-3))
    >>> found.depth.size < 2050, set(found.load.tolist()), found.counts.sum()
    (True, {0.0, 1.0}, np.float64(100000.0))
    """
    if depth.size <= most:
        return Averaged(depth, load, unloading, cycle, np.ones(depth.size), noise)
    order, begin = along(depth, load, unloading, cycle)
    rows = np.stack([depth[order] / noise[0], load[order] / noise[1]])
    length, ends = max(2, round(depth.size / most)), [*begin[1:], depth.size]
    waiting = np.concatenate([np.arange(a, b, length) for a, b in zip(begin, ends, strict=True)])
    size = np.diff(waiting, append=depth.size)
    rows -= np.repeat(np.add.reduceat(rows, waiting, axis=1) / size, size, axis=1)  # so that squares lose no digits
    moments = _moments(rows, waiting, size)
    scale = _not_white(*moments, size)
    steps = np.median(np.abs(np.diff(rows, axis=1)), axis=1)
    done: list[_Ints] = []
    while waiting.size:
        bad = _bent(*moments, size, *scale)
        pair = waiting[size == 2]  # on both sides of a jump their difference is no scatter
        step = np.abs(rows[:, pair + 1] - rows[:, pair])
        bad[size == 2] |= (step > _SIGMAS * np.sqrt(2.0 * scale[0]) + 3.0 * steps[:, None]).any(axis=0)
        done.append(waiting[~bad])
        half = (size[bad] + 1) // 2
        waiting = np.column_stack([waiting[bad], waiting[bad] + half]).ravel()
        size = np.column_stack([half, size[bad] - half]).ravel()
        moments = _moments(rows, waiting, size)
    first = np.sort(np.concatenate(done))
    counts = np.diff(np.append(first, depth.size))
    means = [np.add.reduceat(row[order], first) / counts for row in (depth, load)]
    whole, branch = counts == length, np.searchsorted(first, begin)
    slow = [of_differences(row, branch, _ORDER, whole) * math.sqrt(length) for row in means]
    found = [slower if _SLOWER * own < slower else own for own, slower in zip(noise, slow, strict=True)]
    sides, cycles = unloading[order][first], cycle[order][first]
    return Averaged(means[0], means[1], sides, cycles, counts.astype(float), (found[0], found[1]))


def _moments(rows: Floats, first: _Ints, size: _Ints) -> tuple[Floats, Floats]:
    """Give, of blocks, the sums of squares about straight lines and the sums along parabolas, over their norms."""
    begin = np.cumsum(size) - size
    at = np.arange(int(size.sum())) - np.repeat(begin, size)
    own = rows if at.size == rows.shape[1] else rows[:, np.repeat(first, size) + at]
    count = size.astype(float)
    u = at - np.repeat(0.5 * (count - 1.0), size)
    total, line, second, square = (np.add.reduceat(own * by, begin, axis=1) for by in (1.0, u, u * u, own))
    of_line = count * (count**2 - 1.0) / 12.0
    of_bend = of_line * (count**2 - 4.0) / 15.0
    rest = square - total**2 / count - line**2 / np.where(of_line > 0.0, of_line, 1.0)
    bend = (second - total * (count**2 - 1.0) / 12.0) / np.sqrt(np.where(of_bend > 0.0, of_bend, np.inf))
    least = _ROUNDING * square
    return np.maximum(rest - least, 0.0), np.where(bend**2 > least, bend, 0.0)


def _not_white(rest: Floats, bend: Floats, size: _Ints) -> tuple[Floats, Floats]:
    """Give the variances of points about lines, and of bends, that noise has in this row: 1 where it is white."""
    own = size >= _LEAST
    if not own.any():
        return np.ones((2, 1)), np.ones((2, 1))
    about = np.median((rest - bend**2)[:, own] / (size[own] - 3), axis=1, keepdims=True)
    also = np.median(bend[:, own] ** 2, axis=1, keepdims=True) / _OF_SQUARE
    drifts = about > _CORRELATED
    return np.where(drifts, about, 1.0), np.where(drifts, np.maximum(also, 1.0), 1.0)


def _bent(rest: Floats, bend: Floats, size: _Ints, of_points: Floats, of_bends: Floats) -> Truths:
    """Return which blocks are not straight, by the variances that noise has."""
    free = np.maximum(size - 2.0, 0.0)
    scattered = rest / of_points > free + _SIGMAS * np.sqrt(2.0 * free) + _SIGMAS
    square, window = bend**2 / of_bends, np.ones(min(_NEIGHBOURS, size.size))
    together = np.stack([np.convolve(np.minimum(row, _CLIPPED), window, "same") for row in square]) / window.size
    bent = (scattered | (square > _SIGMAS**2) | (together > _TOGETHER)).any(axis=0)
    return np.asarray(bent & (size > 1))
