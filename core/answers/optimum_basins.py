"""Basins of a sweep: the points from which an optimum is refined.

Each searched input runs from 0 to 1 over its range.
"""

from typing import Final

import numpy as np
from scipy.ndimage import maximum_filter

from gradhesion.core.answers.optimum_merit import WIDTH
from gradhesion.core.types import Floats, Integers, Truths

_MOST_BASINS: Final = 12
"""Number of basins refined in a cell: those with the highest bounds."""


def basins_of(heights: Floats) -> tuple[tuple[Integers, ...], Floats]:
    """Find the highest points of basins that may hold the optimum of their cell: indices, the cells last.

    And a bound for each of them: its height plus its height above its neighbours, of shape (basins,). The axes of
    `heights` are those of a sweep, cells last.
    """
    inputs = heights.ndim - 1
    neighbours = maximum_filter(heights, size=(*(3 for _ in range(inputs)), 1), mode="nearest")
    peaks = (heights == neighbours) & np.isfinite(heights)
    rise = np.zeros_like(heights)
    for axis in range(inputs):
        steps = np.abs(np.diff(np.where(np.isfinite(heights), heights, np.nan), axis=axis))
        steps = np.where(np.isnan(steps), np.inf, steps)  # next to infeasible points there is no bound
        ends = [(0, 0)] * heights.ndim
        ends[axis] = (1, 1)
        padded = np.pad(steps, ends)
        first, last = [slice(None)] * heights.ndim, [slice(None)] * heights.ndim
        first[axis], last[axis] = slice(None, -1), slice(1, None)
        rise += np.maximum(padded[tuple(first)], padded[tuple(last)])
    promised = np.full(heights.shape, -np.inf)
    promised[peaks] = heights[peaks] + rise[peaks]
    best = heights.reshape(-1, heights.shape[-1]).max(axis=0)
    peaks &= promised >= best
    flat = np.where(peaks, promised, -np.inf).reshape(-1, heights.shape[-1])
    if flat.shape[0] > _MOST_BASINS:
        least = -np.partition(-flat, _MOST_BASINS - 1, axis=0)[_MOST_BASINS - 1]
        highest = np.argmax(heights.reshape(flat.shape), axis=0)
        kept = (flat >= least) & np.isfinite(flat)
        kept[highest, np.arange(flat.shape[1])] |= np.isfinite(best)
        peaks = kept.reshape(heights.shape)
    return tuple(np.nonzero(peaks)), promised[peaks]


def is_new(heights: Floats, places: Floats) -> Truths:
    """Report for each cell whether a sweep at half the resolution has no basin where its optimum is."""
    inputs = heights.ndim - 1
    coarse = heights[(*(slice(None, None, 2) for _ in range(inputs)), slice(None))]
    peaks = (coarse == maximum_filter(coarse, size=(*(3 for _ in range(inputs)), 1), mode="nearest")) & np.isfinite(
        coarse
    )
    indices = np.nonzero(peaks)
    shown: Truths = np.any(np.isnan(places), axis=0)  # where nothing is feasible no optimum is missed
    spacing = 1.0 / (coarse.shape[0] - 1)
    near = np.ones(indices[-1].size, bool)
    for own, index in zip(places, indices[:-1], strict=True):
        near &= np.abs(own[indices[-1]] - spacing * index) <= spacing * (1.0 + WIDTH)
    shown[indices[-1][near]] = True
    return np.logical_not(shown)
