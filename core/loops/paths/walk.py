"""Which states a contact passes, from states on a grid of radii: those at which what is prescribed has a new extreme.

Loading visits the radii at which the level is larger than at all smaller radii, unloading those at which it is smaller
than at all larger ones; what lies between is jumped over. Between radii of the grid, states are cubics: they give
folds, where a jump begins, and landings, where it ends. A vertex of a path lies on the curve itself at such a radius:
an error of the radius moves it along the curve.

Rows of `states` are displacement, load, and what both grow by with the radius, at radii (n,) in the order in which the
edge moves.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.jit import allocating, kernel
from gradhesion.core.types import Floats, Truths

_NEWTON: Final = 4  # steps to the root of a cubic from that of its chord: they double the digits


@allocating
def between(radius: Floats, states: Floats, at: int, share: float) -> tuple[float, Floats]:
    """Return the radius and the state (4,) at a share of the way from the place before `at` to it."""
    found = states[:, at].copy()
    if share == 1.0:
        return radius[at], found
    width = radius[at] - radius[at - 1]
    for row in range(2):
        low, rise = states[row, at - 1], states[row, at] - states[row, at - 1]
        begin, end = states[row + 2, at - 1] * width, states[row + 2, at] * width
        bend, twist = 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise
        found[row] = low + share * (begin + share * (bend + share * twist))
        found[row + 2] = (begin + share * (2.0 * bend + 3.0 * share * twist)) / width
    return radius[at - 1] + share * width, found


@kernel
def _crossing(low: float, high: float, begin: float, end: float, target: float) -> float:
    """Return the share of the way at which a cubic from a low value to a high one, of such slopes, meets a target."""
    rise = high - low
    bend, twist = 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise
    share = (target - low) / rise
    for _ in range(_NEWTON):
        off = low + share * (begin + share * (bend + share * twist)) - target
        slope = begin + share * (2.0 * bend + 3.0 * share * twist)
        if slope > 0.0:
            share = min(max(share - off / slope, 0.0), 1.0)
    return share


def met(radius: Floats, states: Floats, jump: Truths, aim: tuple[float, float], target: float) -> tuple[int, float]:
    """Return where parts `aim` of displacement and load first reach a target on the way of `climb`.

    A place and the share of the way to it from the one before, 1 where a jump to it passes the target; the number of
    places if it is not reached.
    """
    level = np.array(aim) @ states[:2]
    reached = np.flatnonzero(level >= target)
    at = int(reached[0]) if reached.size else radius.size
    if at in (0, radius.size) or jump[at]:
        return at, 1.0
    begin, end = (radius[at] - radius[at - 1]) * (np.array(aim) @ states[2:, at - 1 : at + 1])
    return at, _crossing(level[at - 1], level[at], begin, end, target)


@allocating
def _with_tops(radius: Floats, states: Floats, row: int, sign: float) -> tuple[Floats, Floats]:
    """Return radii and states with those among them where a row, times a sign, has its maxima between two radii."""
    places, found = np.empty(2 * radius.size), np.empty((4, 2 * radius.size))
    size = 0
    for i in range(radius.size):
        if i > 0:
            width = sign * (radius[i] - radius[i - 1])
            begin, end = width * states[row + 2, i - 1], width * states[row + 2, i]
            if begin > 0.0 and end < 0.0:  # the slope is a parabola with one root in between
                rise = sign * (states[row, i] - states[row, i - 1])
                bend, twist = 3.0 * rise - 2.0 * begin - end, 3.0 * (begin + end - 2.0 * rise)
                share = begin / (math.sqrt(max(bend * bend - twist * begin, 0.0)) - bend)
                if 0.0 < share < 1.0:
                    places[size], found[:, size] = between(radius, states, i, share)
                    size += 1
        places[size], found[:, size] = radius[i], states[:, i]
        size += 1
    return places[:size], found[:, :size].copy()


@allocating
def climb(radius: Floats, states: Floats, row: int, sign: float, start: float) -> tuple[Floats, Floats, Truths]:
    """Return radii and states that are passed as a row of the states, times a sign, grows from a start.

    Behind them, whether each is reached by a jump. Of a cubic with a maximum of 2 at -1, which is passed again at 2:

    >>> a = np.linspace(-2.0, 3.0, 51)
    >>> states = np.stack([a**3 - 3.0 * a, a, 3.0 * a**2 - 3.0, np.ones(51)])
    >>> radii, _, jump = climb(a, states, 0, 1.0, -10.0)
    >>> radii[jump].round(3).tolist()
    [-2.0, 2.0]
    """
    grid, known = _with_tops(radius, states, row, sign)
    radii, passed, jump = np.empty(2 * grid.size), np.empty((4, 2 * grid.size)), np.zeros(2 * grid.size, np.bool_)
    size, last, top = 0, -1, start
    for i in range(grid.size):
        level = sign * known[row, i]
        if level > top:
            jump[size] = last < i - 1 or i == 0
            if i > 0 and last < i - 1:
                width = sign * (grid[i] - grid[i - 1])
                begin, end = width * known[row + 2, i - 1], width * known[row + 2, i]
                share = _crossing(sign * known[row, i - 1], level, begin, end, top)
                radii[size], passed[:, size] = between(grid, known, i, share)
                size += 1
            radii[size], passed[:, size], last, top = grid[i], known[:, i], i, level
            size += 1
    return radii[:size], passed[:, :size].copy(), jump[:size]
