"""Means of many raw points along a loop: short blocks of neighbours, none of which bends or jumps."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.loops.measured.points import along, of_differences
from gradhesion.core.types import Floats, Truths

_Places = NDArray[np.intp]

MOST: Final = 2000
"""Points that are fitted as they are; more are averaged to about as many means."""
_BENT: Final = 2.5  # standard deviations of noise by which blocks bend at most
_TOGETHER: Final = 7  # neighbouring blocks whose bends are tested together, since those of the curve have one sign
_JUMPS: Final = 6.0
"""Standard deviations of noise between neighbours, beside what they differ by as a rule, from which on it jumps."""
_ORDER: Final = 6
"""Order of the differences of means that detect noise which is not white: bends of the curve are of lower order."""
_SLOWER: Final = 1.2  # how much larger noise is then than that of neighbouring points, at least


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
    slow = [of_differences(row, _ORDER) * math.sqrt(length) for row in means]
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
