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


def _peaks(heights: Floats) -> Truths:
    """Return where finite heights of a sweep (*places, cells) are not below their neighbours, diagonal ones too."""
    neighbours = maximum_filter(heights, size=(*(3 for _ in heights.shape[1:]), 1), mode="nearest")
    return (heights == neighbours) & np.isfinite(heights)


def basins_of(heights: Floats) -> tuple[tuple[Integers, ...], Floats]:
    """Find the highest points of basins that may hold the optimum of their cell, in a sweep (*places, cells).

    Return their indices, an array (basins,) for each axis, and a bound for each of them, of shape (basins,): its height
    plus its height above its neighbours.
    """
    peaks, rise = _peaks(heights), np.zeros_like(heights)
    finite = np.where(np.isfinite(heights), heights, np.nan)
    for axis in range(heights.ndim - 1):
        steps = np.abs(np.diff(finite, axis=axis))
        steps = np.where(np.isnan(steps), np.inf, steps)  # next to infeasible points there is no bound
        none = np.zeros_like(heights.take([0], axis))
        rise += np.maximum(np.concatenate([none, steps], axis), np.concatenate([steps, none], axis))
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
    """Report for each cell, shape (cells,), whether a sweep at half the resolution has no basin where its optimum is.

    `heights` are the values of the sweep, of shape (points of each searched input..., cells), `places` the optima on a
    scale from 0 to 1, of shape (searched inputs, cells), NaN where there is none.
    """
    coarse = heights[(*(slice(None, None, 2) for _ in heights.shape[1:]), slice(None))]
    indices = np.nonzero(_peaks(coarse))
    shown: Truths = np.any(np.isnan(places), axis=0)  # where nothing is feasible no optimum is missed
    spacing = 1.0 / (coarse.shape[0] - 1)
    near = np.ones(indices[-1].size, bool)
    for own, index in zip(places, indices[:-1], strict=True):
        near &= np.abs(own[indices[-1]] - spacing * index) <= spacing * (1.0 + WIDTH)
    shown[indices[-1][near]] = True
    return np.logical_not(shown)
