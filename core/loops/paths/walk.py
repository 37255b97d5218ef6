"""Which radii a contact passes, from a grid of radii: those where the prescribed level has a new extreme.

Loading visits the radii at which the level is larger than at all smaller radii, unloading those at which it is smaller
than at all larger ones; what lies between is jumped over. The grid has the extrema of the level among its radii, and
cubics between its points give the places where jumps land. A vertex of a path is put on the curve itself at such a
radius: an error of the radius moves it along the curve.
"""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.types import Floats, Integers, Truths

_NEWTON: Final = 4
"""Steps to the root of a cubic from that of its chord: they double the digits."""


class Walk(NamedTuple):
    """The radii that are passed, and whether each is reached by a jump; both (n,)."""

    radius: Floats
    jump: Truths


def crossing(radius: Floats, level: Floats, rate: Floats, at: Integers, target: Floats | float) -> Floats:
    """Return the radii at which targets are met before the places `at` (m,) of a grid, and behind those before.

    By the cubics that have the levels and their derivatives at both; radius, level and rate are of shape (n,).
    """
    start, width, low, rise = radius[at - 1], np.diff(radius)[at - 1], level[at - 1], np.diff(level)[at - 1]
    begin, end = rate[at - 1] * width, rate[at] * width
    bend, twist = 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise
    share = (target - low) / rise
    for _ in range(_NEWTON):
        off = low + share * (begin + share * (bend + share * twist)) - target
        slope = begin + share * (2.0 * bend + 3.0 * share * twist)
        share = np.clip(share - np.where(slope > 0.0, off / np.where(slope > 0.0, slope, 1.0), 0.0), 0.0, 1.0)
    return np.asarray(start + share * width)


def met(walk: Walk, level: Floats, rate: Floats, target: float) -> float | None:
    """Return the radius at which a level (n,) with the derivative `rate` is first reached; None where it is not."""
    above = level >= target
    i = int(np.argmax(above)) if above.any() else -1
    if i <= 0 or walk.jump[i]:
        return None if i < 0 else float(walk.radius[i])
    return float(crossing(walk.radius, level, rate, np.array([i]), target)[0])


def climb(radius: Floats, level: Floats, rate: Floats, start: float) -> Walk:
    """Return the radii that the contact passes as a level grows from a start; above it a branch is reached by a jump.

    `radius` (n,) is in the order in which the edge moves, rising or falling, the extrema of the level among it; `rate`
    is the derivative of the level. Of a cubic with a maximum of 2 at -1, which is passed again at 2:

    >>> a = np.linspace(-2.0, 3.0, 51)
    >>> radii, jump = climb(a, a**3 - 3.0 * a, 3.0 * a**2 - 3.0, -10.0)
    >>> radii[jump].round(3).tolist()
    [-2.0, 2.0]
    """
    before = np.maximum.accumulate(np.append(start, level[:-1]))
    passed = level > before
    at = np.flatnonzero(passed)
    jump = np.zeros(at.size, bool)
    jump[:1] = at[:1] == 0
    landed = at[(at > 0) & ~passed[at - 1]]
    places = np.searchsorted(at, landed)
    landings = crossing(radius, level, rate, landed, before[landed])
    return Walk(np.insert(radius[at], places, landings), np.insert(jump, places, True))
