"""Shared by all formulae: arrays of floats that are NaN out of range, and the unit of load."""

import math
from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]

LOAD_UNIT: Final = 1.5 * math.pi
"""1.5 pi R dgamma over R dgamma."""


def exponent_of(k: ArrayLike) -> Array:
    """Return k as an array, NaN outside [0, 1]."""
    values = np.asarray(k, dtype=float)
    return np.where((values >= 0.0) & (values <= 1.0), values, np.nan)


def positive(values: ArrayLike) -> Array:
    """Return an array, NaN where it is not above 0."""
    array = np.asarray(values, dtype=float)
    return np.where(array > 0.0, array, np.nan)


def not_negative(values: ArrayLike) -> Array:
    """Return an array, NaN where it is not 0 or more."""
    array = np.asarray(values, dtype=float)
    return np.where(array >= 0.0, array, np.nan)


def power_of(exponent: ArrayLike) -> Array:
    """Return the power m of a smooth profile as an array, NaN below 1."""
    m = np.asarray(exponent, dtype=float)
    return np.where(m >= 1.0, m, np.nan)


def point_by_point(formula: Callable[..., float], *numbers: ArrayLike) -> Array:
    """Return a formula of floats at every point of broadcast arrays, NaN where one of them is NaN."""
    arrays = np.broadcast_arrays(*numbers)
    out = np.full(arrays[0].shape, np.nan)
    for place in np.ndindex(out.shape):
        point = [float(array[place]) for array in arrays]
        if not any(math.isnan(number) for number in point):
            out[place] = formula(*point)
    return out
