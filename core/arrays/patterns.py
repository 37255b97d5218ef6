"""The patterns of toughness of arrays of scenes: how low each comes, and up to where it is known."""

import math
from functools import lru_cache
from typing import Final

import numpy as np

from gradhesion.core.arrays.prepared import Scenes
from gradhesion.core.problem.curves import Patterns
from gradhesion.core.problem.toughness import Toughness, first_violation, lowest, rows_of_pattern

_BEYOND: Final = 0.25
"""Of the least t within a rim beyond which it has the wrong sign: cells reach a little further."""


@lru_cache(maxsize=32)
def _extremes(toughness: Toughness) -> tuple[float, float]:
    """Return the lowest and the highest value of the series."""
    rows = rows_of_pattern(toughness)
    return lowest(rows), -lowest(rows * np.array([1.0, -1.0, -1.0]))


def patterns_of(toughness: Toughness, scenes: Scenes) -> Patterns:
    """Return the patterns of the curves of scenes."""
    rims = scenes.rim
    wavelength, amplitude = scenes.others
    rows, (low, high) = rows_of_pattern(toughness), _extremes(toughness)
    with np.errstate(all="ignore"):  # a scene out of range has no value
        least = 1.0 + np.minimum(amplitude * low, amplitude * high)
    limit = np.full(least.shape, math.inf)
    within = rims if rims.shape[0] > 1 else np.broadcast_to(rims, (least.size, rims.shape[1]))
    doubtful = (least < (1e-12 if toughness.of == "work" else 0.0)) & np.isfinite(amplitude) & (wavelength > 0.0)
    for i in np.flatnonzero(doubtful).tolist():
        place = first_violation(toughness, float(amplitude[i]))
        if place < math.inf:
            limit[i] = place * wavelength[i] * (1.0 - 1e-12)
            furthest = np.max(np.where(within[i] <= limit[i], within[i], 0.0)) / wavelength[i]
            least[i] = _BEYOND * (1.0 + lowest(rows * np.array([1.0, amplitude[i], amplitude[i]]), furthest))
    return Patterns(rows, toughness.of == "work", wavelength, amplitude, np.maximum(least, 0.0), limit)
