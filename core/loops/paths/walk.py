"""Which radii a contact passes, from a grid of radii: those where the prescribed level has a new extreme.

Loading visits the radii at which the level is larger than at all smaller radii, unloading those at which it is smaller
than at all larger ones; what lies between is jumped over. The grid has the extrema of the level among its radii, and
cubics between its points give the places where jumps land. A vertex of a path is put on the curve itself at such a
radius: an error of the radius moves it along the curve. In all functions `level` has the derivative `rate` at `radius`,
arrays (n,) in the order in which the edge moves.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.jit import kernel
from gradhesion.core.types import Floats, Truths

_NEWTON: Final = 4
"""Steps to the root of a cubic from that of its chord: they double the digits."""


@kernel
def crossing(radius: Floats, level: Floats, rate: Floats, at: int, target: float) -> float:
    """Return where the cubic from the place before `at` to it meets a target, which is above that and not above it."""
    width, low, rise = radius[at] - radius[at - 1], level[at - 1], level[at] - level[at - 1]
    begin, end = rate[at - 1] * width, rate[at] * width
    bend, twist = 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise
    share = (target - low) / rise
    for _ in range(_NEWTON):
        off = low + share * (begin + share * (bend + share * twist)) - target
        slope = begin + share * (2.0 * bend + 3.0 * share * twist)
        if slope > 0.0:
            share = min(max(share - off / slope, 0.0), 1.0)
    return float(radius[at - 1] + share * width)


@kernel
def met(radius: Floats, jump: Truths, level: Floats, rate: Floats, target: float) -> float:
    """Return the radius at which a level is first reached on the way of `climb`, NaN where it is not."""
    for i in range(radius.size):
        if level[i] >= target:
            return radius[i] if i == 0 or jump[i] else crossing(radius, level, rate, i, target)
    return math.nan


@kernel
def climb(radius: Floats, level: Floats, rate: Floats, start: float) -> tuple[Floats, Truths]:
    """Return the radii that are passed as a level grows from a start, and whether each is reached by a jump.

    Of a cubic with a maximum of 2 at -1, which is passed again at 2:

    >>> a = np.linspace(-2.0, 3.0, 51)
    >>> radii, jump = climb(a, a**3 - 3.0 * a, 3.0 * a**2 - 3.0, -10.0)
    >>> radii[jump].round(3).tolist()
    [-2.0, 2.0]
    """
    radii, jump = np.empty(2 * radius.size), np.zeros(2 * radius.size, np.bool_)
    size, last, top = 0, -1, start
    for i in range(radius.size):
        if level[i] > top:
            jump[size] = last < i - 1 or i == 0
            if i > 0 and last < i - 1:
                radii[size] = crossing(radius, level, rate, i, top)
                size += 1
            radii[size], last, top = radius[i], i, level[i]
            size += 1
    return radii[:size], jump[:size]
