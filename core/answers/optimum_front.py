"""The Pareto front of two merits."""

from collections.abc import Sequence

import numpy as np

from gradhesion.core.types import Floats, Integers


def front(values: Sequence[Floats]) -> Integers:
    """Return the numbers, shape (n,), of the points that no other one excels in both values, by falling first value.

    Parameters
    ----------
    values
        Two arrays of one dimension, each to be maximised; points with NaN are left out.

    Examples
    --------
    >>> front([np.array([1.0, 3.0, 2.0, 2.0]), np.array([5.0, 1.0, 4.0, 3.0])]).tolist()
    [1, 2, 0]
    """
    first, second = values
    there = np.flatnonzero(~(np.isnan(first) | np.isnan(second)))
    order = there[np.lexsort((-second[there], -first[there]))]
    highest = np.maximum.accumulate(second[order])
    before = np.concatenate([[-np.inf], highest[:-1]])
    return order[second[order] > before]
