"""What all searches for starts share: parts of a loop, rough refinement, and which vectors are worth refining."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import Model
from gradhesion.core.types import Floats

COARSE: Final = 140
"""Points that starts are compared with."""
_WORSE: Final = 0.5
"""Robust size of a misfit for each point: a vector worse than the best by more is refined no further."""
_NOISE: Final = 0.533, 0.518
"""Mean and standard deviation of the robust size of a point whose distance is its noise: of ln(1 + z^2), z normal."""
_CLEAR: Final = 4.0
"""Standard deviations of the robust size of a loop within which a misfit is noise."""


def coarse(misfit: Misfit, count: int) -> slice:
    """Choose about this many of the points, evenly."""
    return slice(None, None, max(1, misfit.back.size // count))


def carried(misfit: Misfit, other: Misfit, vector: Floats) -> Floats:
    """Return a vector with the numbers that another loop has of the same names, others in the middle of their range."""
    own = dict(zip(other.names, vector, strict=True))
    middle = 0.5 * (misfit.low + misfit.high)
    return np.array([own.get(name, each) for name, each in zip(misfit.names, middle, strict=True)])


def without(model: Model, names: Sequence[str]) -> tuple[dict[str, float], tuple[str, ...]]:
    """Return what is fixed and what is searched of a loop, less some names."""
    fixed = {name: value for name, value in model.fixed.items() if name not in names}
    return fixed, tuple(name for name in model.names if name not in names)


def put(misfit: Misfit, vector: Floats, values: Mapping[str, float]) -> list[int]:
    """Set the numbers of a vector that are searched under some names, and return their places."""
    places = {misfit.names.index(name): value for name, value in values.items() if name in misfit.names}
    for place, value in places.items():
        vector[place] = value
    return [*places]


def shares_of(misfit: Misfit, number: int, count: int) -> Floats:
    """Return values of a number evenly within its range, none at its ends; shape (count,)."""
    shares: Floats = (np.arange(count) + 0.5) / count
    return misfit.low[number] + shares * (misfit.high[number] - misfit.low[number])


def roughly(misfit: Misfit, vectors: Sequence[Floats], few: slice, most: int, held: Sequence[int] = ()) -> list[Floats]:
    """Refine vectors by some of the points in at most so many steps, whatever outliers there are."""
    return [misfit.refined(vector, few, loss="soft_l1", most=most, held=held, tolerance=1e-4).x for vector in vectors]


def distinct(vectors: list[Floats], misfit: Misfit, near: float = 1e-3) -> list[Floats]:
    """Return those of some vectors that are not near an earlier one: a part of the ranges in every number."""
    kept: list[Floats] = []
    width = misfit.high - misfit.low
    for vector in vectors:
        if all(np.max(np.abs(vector - other) / width) > near for other in kept):
            kept.append(vector)
    return kept


def near_best(vectors: list[Floats], misfit: Misfit) -> list[Floats]:
    """Return those of some vectors, the best first, that are not far worse than the best: refining may change that."""
    few = coarse(misfit, COARSE)
    sizes = [misfit.size(vector, few) for vector in vectors]
    most = sizes[0] + _WORSE * misfit.back[few].size
    return [vector for vector, size in zip(vectors, sizes, strict=True) if size <= most]


def best_of(misfit: Misfit, vectors: list[Floats], few: slice, count: int) -> list[Floats]:
    """Return the best of some vectors, in order."""
    sizes = [misfit.size(vector, few) for vector in vectors]
    return [vectors[i] for i in np.argsort(sizes, kind="stable")[:count]]


def is_noise(misfit: Misfit, vector: Floats, few: slice) -> bool:
    """Say whether a vector leaves no more than noise at some of the points."""
    count = misfit.back[few].size
    return misfit.size(vector, few) <= _NOISE[0] * count + _CLEAR * _NOISE[1] * count**0.5
