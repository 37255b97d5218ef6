"""Which radii a contact passes, from a grid of radii: those where the prescribed coordinate has a new extreme.

Loading visits the radii at which the coordinate is larger than at all smaller radii, unloading those at which it is
smaller than at all larger ones; what lies between is jumped over. A grid shows the branches; their ends are the
extrema of parabolas through three of its points, and the places where a jump lands are roots of cubics through four.
A vertex of a path is put on the curve itself at such a radius: an error of the radius moves it along the curve.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import kernel
from gradhesion.core.types import Floats, Truths

_NEWTON: Final = 5
"""Steps to the root of a cubic from that of a chord: they double the digits."""
_FEWEST: Final = 5
"""Points of a branch below which a chord stands for the cubic."""


class Walk(NamedTuple):
    """The results of `climb`: radii that are passed, whether each is reached by a jump, and the level; all (n,)."""

    radius: Floats
    jump: Truths
    level: Floats

    def met(self, target: float) -> float | None:
        """Return the radius at which a level is first reached, None where it is not."""
        radius, jump, level = self
        i = int(np.argmax(level >= target)) if level.size else 0
        if not level.size or not level[i] >= target:
            return None
        if i == 0 or jump[i]:
            return float(radius[i])
        jumps = np.append(np.flatnonzero(jump), radius.size)
        edge = int(np.searchsorted(jumps, i))
        first = int(jumps[edge - 1]) if edge else 0
        branch = slice(first, int(jumps[edge]))
        if radius[branch].size < _FEWEST:
            share = (target - level[i - 1]) / (level[i] - level[i - 1])
            return float(radius[i - 1] + share * (radius[i] - radius[i - 1]))
        return float(crossing(radius[branch], level[branch], i - first, target))


@kernel
def _top(radius: Floats, level: Floats, at: int) -> tuple[float, float]:
    """Return radius and value of a maximum near a place, by the parabola through three points; arrays (n,)."""
    if at == 0 or at == radius.size - 1:
        return radius[at], level[at]
    x0, x2 = radius[at - 1] - radius[at], radius[at + 1] - radius[at]
    left, right = (level[at - 1] - level[at]) / x0, (level[at + 1] - level[at]) / x2
    bend = (right - left) / (x2 - x0)
    if not bend < 0.0:
        return radius[at], level[at]
    slope = left - bend * x0
    step = min(max(-0.5 * slope / bend, min(x0, x2)), max(x0, x2))
    return radius[at] + step, max(level[at], level[at] + step * (slope + bend * step))


@kernel
def crossing(radius: Floats, level: Floats, at: int, target: float) -> float:
    """Return where a target is met before a place, by the cubic through four points; arrays (n,)."""
    i = min(max(at - 2, 0), radius.size - 4)
    x0, x1, x2, x3 = radius[i], radius[i + 1], radius[i + 2], radius[i + 3]
    y0, y1, y2, y3 = level[i], level[i + 1], level[i + 2], level[i + 3]
    d01, d12, d23 = (y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1), (y3 - y2) / (x3 - x2)
    d012, d123 = (d12 - d01) / (x2 - x0), (d23 - d12) / (x3 - x1)
    d0123 = (d123 - d012) / (x3 - x0)
    low, high = min(radius[at - 1], radius[at]), max(radius[at - 1], radius[at])
    rise = level[at] - level[at - 1]
    share = (target - level[at - 1]) / rise if rise > 0.0 else 1.0
    place = radius[at - 1] + min(max(share, 0.0), 1.0) * (radius[at] - radius[at - 1])
    for _ in range(_NEWTON):
        u0, u1, u2 = place - x0, place - x1, place - x2
        slope = d01 + (u0 + u1) * d012 + (u0 * u1 + u0 * u2 + u1 * u2) * d0123
        off = y0 + u0 * (d01 + u1 * (d012 + u2 * d0123)) - target
        if slope == 0.0 or not abs(off / slope) < math.inf:
            break
        place = min(max(place - off / slope, low), high)
    return place


@kernel
def _ended(radii: Floats, jump: Truths, size: int, end: float) -> int:
    """Return how many of the radii passed, shape (n,), are before the end of a branch: the last may be beyond."""
    beyond = size > 1 and not jump[size - 1] and (end - radii[size - 1]) * (radii[size - 1] - radii[size - 2]) < 0.0
    return size - 1 if beyond else size


@kernel
def climb(radius: Floats, level: Floats, start: float) -> tuple[Floats, Truths, Floats]:
    """Return the radii that the contact passes as a level grows.

    Parameters
    ----------
    radius
        In the order in which the edge moves, rising or falling; shape (n,), n >= 4.
    level
        What is prescribed, at these; shape (n,).
    start
        The level from which it grows. A branch that begins above it is reached by a jump.

    Returns
    -------
    The radii that are passed, with the ends of branches and the places where jumps land among them; whether each is
    reached by a jump; and the level at each: arrays of one shape.

    Examples
    --------
    Of a cubic with a maximum of 2 at -1, which is passed again at 2:

    >>> a = np.linspace(-2.0, 3.0, 51)
    >>> radii, jump, level = climb(a, a**3 - 3.0 * a, -10.0)
    >>> radii[jump].round(3).tolist(), level[np.flatnonzero(jump)[1:] - 1].round(2).tolist()
    ([-2.0, 2.0], [2.0])
    """
    count = radius.size
    radii, jump, levels = np.empty(3 * count + 1), np.zeros(3 * count + 1, np.bool_), np.empty(3 * count + 1)
    size, top, last = 0, start, -1
    for i in range(count):
        if not level[i] > top:
            continue
        if last < i - 1 or size == 0:  # a branch ends, and the next one begins
            target = start
            if last >= 0:
                end, target = _top(radius, level, last)
                size = _ended(radii, jump, size, end)
                radii[size], levels[size] = end, target
                size += 1
            if i > 0 and level[i] > target:
                radii[size], levels[size], jump[size] = crossing(radius, level, i, target), target, True
                size += 1
            else:
                jump[size] = True
        if level[i] > top:
            radii[size], levels[size] = radius[i], level[i]
            size += 1
            top, last = level[i], i
    if 0 <= last < count - 1:
        end, target = _top(radius, level, last)
        size = _ended(radii, jump, size, end)
        radii[size], levels[size] = end, target
        size += 1
    return radii[:size], jump[:size], levels[:size]
