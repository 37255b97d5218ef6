"""Intervals of fitted numbers by profile likelihoods: how far each can be moved, all others fitted anew.

For a linear problem the sum of squares of the residuals, less its minimum, grows as the square of the displacement; an
interval ends where it has grown to the square of a quantile of Student's t. Its root is nearly linear in the
displacement, so that a secant finds the end in a few steps.
"""

from typing import Final

import numpy as np

from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.types import Floats

_NEAR: Final = 0.01
"""Accuracy of the end of an interval, in parts of the quantile."""
_FINE: Final = 1e-5
"""Tolerance for the sum of squares and the numbers: a rise by 4 is known to a hundredth of it."""
_TRIALS: Final = 8
"""Steps to an end, at most."""
_FURTHEST: Final = 4.0
"""Longest step, in parts of the displacement so far: beyond it a linear estimate is unreliable."""


def profile_interval(
    misfit: Misfit, best: Floats, number: int, along: Floats, factor: float, unit: float
) -> tuple[float, float]:
    """Return how low and how high one number may be.

    Parameters
    ----------
    misfit
        The loop.
    best
        The minimum, shape (unknown,).
    number
        Which of its numbers is moved.
    along
        How all numbers move with it in the linear problem: standard deviation times correlation; its own item
        is its standard deviation. Shape (unknown,).
    factor
        The quantile at which an interval ends, in standard deviations.
    unit
        The variance of a residual, by which sums of squares are divided.

    Returns
    -------
    The ends, as numbers are searched; an end of the range where the misfit does not grow enough within it. Where the
    misfit is lower than at `best` on the way, it counts as that of `best`.
    """
    least = float(np.sum(misfit.residual(best) ** 2))
    ends = []
    for sign in (-1.0, 1.0):
        limit = misfit.low[number] if sign < 0.0 else misfit.high[number]
        most = sign * (limit - best[number])
        way, before, start = factor * float(along[number]), (0.0, 0.0), best
        for _ in range(_TRIALS):
            at_limit = way >= most
            way = min(way, most)
            moved = start + (sign * way - (start[number] - best[number])) * along / along[number]
            moved = np.clip(moved, misfit.low, misfit.high)
            moved[number] = best[number] + sign * way
            found = misfit.refined(moved, held=[number], most=20, tolerance=_FINE).x
            grown = float(np.sum(misfit.residual(found) ** 2)) - least
            reached = float(np.sqrt(max(0.0, grown) / unit))
            if abs(reached - factor) < _NEAR * factor or (at_limit and reached < factor):
                break
            slope = (reached - before[1]) / (way - before[0]) if way != before[0] else 0.0
            step = (factor - reached) / slope if slope > 0.0 else way
            before, start = (way, reached), found
            way = float(np.clip(way + step, 0.2 * way, (1.0 + _FURTHEST) * way))
        ends.append(float(best[number] + sign * way))
    return ends[0], ends[1]
