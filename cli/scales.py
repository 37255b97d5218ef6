"""Axes of a dataset as axes of a picture: their spacing, and a place for infinity."""

import numpy as np
from numpy.typing import NDArray


def spacing(values: NDArray[np.float64]) -> str:
    """
    Tell how the values of an axis are spaced, inf apart.

    >>> spacing(np.array([0.01, 0.1, 1.0, np.inf]))
    'log-spaced'
    >>> spacing(np.array([0.0, 0.1, 0.2]))
    'evenly spaced'
    """
    finite = np.sort(values[np.isfinite(values)])
    if finite.size < 3:
        return "listed"
    steps = np.diff(finite)
    if np.ptp(steps) <= 1e-6 * np.max(steps):
        return "evenly spaced"
    if finite[0] > 0 and np.ptp(np.diff(np.log(finite))) <= 1e-6 * np.log(finite[-1] / finite[0]):
        return "log-spaced"
    return "listed"
