"""The least opening (contact/gap.py) at the radii around a contact: below 0 the contact is not one disc.

The opening is computed at 17 radii in a little more than the shortest wave, and its least value searched only where it
is near zero.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.gap import Edge, opening, openings_between
from gradhesion.core.face import AnyCurve, AnyTable, edge_at, panels_of, table_of
from gradhesion.core.struve.fractional import NODES
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats

_WINDOW: Final = 1.125
"""Shortest waves in one window."""
_CLEAR: Final = 0.02
"""The parabola through three of 17 openings is nearer than this to their least value, in parts of their range."""
_MOST_WINDOWS: Final = 64.0
"""Windows of one wave, or wavelengths of a series, in which every radius is tested."""
GOLDEN: Final = 0.5 * (math.sqrt(5.0) - 1.0)
STEPS: Final = 30
"""Steps of the golden section: they leave 1e-6 of the bracket, and 1e-12 of the least value."""


@kernel()
def place_of(low: float, high: float, i: int) -> float:
    """Return node i of a window, its end for the last i."""
    return high if i >= NODES.size else math.sqrt(low * low + (high - low) * (high + low) * NODES[i])


@kernel()
def _search(table: AnyTable, curve: AnyCurve, edge: Edge, low: float, high: float) -> float:
    """Return the least opening between two radii, or the first negative one found (golden section)."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    first, second = opening(table, curve, edge, inner), opening(table, curve, edge, outer)
    for _ in range(STEPS):
        if min(first, second) < 0.0:
            break
        if first < second:
            high, outer, second = outer, inner, first
            inner = high - GOLDEN * (high - low)
            first = opening(table, curve, edge, inner)
        else:
            low, inner, first = inner, outer, second
            outer = low + GOLDEN * (high - low)
            second = opening(table, curve, edge, outer)
    return min(first, second)


@kernel()
def _bottom(openings: Floats, i: int) -> float:
    """Return the least of the parabola through openings i - 1, i and i + 1 of NODES.size + 1, or the one i."""
    count = NODES.size
    here = NODES[i]
    before, after = NODES[i - 1] - here, (NODES[i + 1] if i + 1 < count else 1.0) - here
    left, right = (openings[i - 1] - openings[i]) / before, (openings[i + 1] - openings[i]) / after
    curvature = (right - left) / (after - before)
    rate = right - curvature * after
    place = -0.5 * rate / curvature if curvature > 0.0 else math.inf
    return openings[i] + 0.5 * rate * place if before < place < after else openings[i]


@kernel()
def _is_low(openings: Floats, i: int, clear: float) -> bool:
    """Return whether opening i of NODES.size + 1 is the least of its neighbours, and not clear of a level."""
    count = NODES.size
    if (i > 0 and openings[i - 1] < openings[i]) or (i < count and openings[i + 1] < openings[i]):
        return False
    # next to an end the least may lie between, though the end itself is no least
    return _bottom(openings, min(max(i, 1), count - 1)) <= clear or openings[i] <= clear


@kernel()
def _least_in_window(
    table: AnyTable, curve: AnyCurve, edge: Edge, low: float, high: float, heights: Floats, openings: Floats
) -> float:
    """Return the least opening between two radii x, given that there is none below 0 up to `low`.

    `heights` and `openings` are room for F and the openings at the places of the window (contact/gap.py), of shapes
    (NODES.size,) and (NODES.size + 1,).

    Beyond `low` > a the opening is no less than the contribution of the radii from there on, which is computed first.
    That of the radii within, over (x^2 - low^2)^c, falls outwards: its value at `high` is a bound for the whole window.
    """
    a, count = edge.x, NODES.size
    openings_between(table, curve, edge, low, high, heights, openings)
    # the polynomial in x^2 is limited by the branch point at x = 0
    distance = 1.0 + 2.0 * low * low / ((high - low) * (high + low))
    error = 1e-9 + 10.0 * (distance + math.sqrt(distance * distance - 1.0)) ** (-count)
    at, most, highest = 0, -math.inf, 1.0
    for i in range(count + 1):
        at, most = i if openings[i] < openings[at] else at, max(most, openings[i])
        highest = max(highest, abs(heights[min(i, count - 1)]))
    error *= highest
    clear = _CLEAR * max(1.0, most - openings[at])
    least = min(openings[at], _bottom(openings, min(max(at, 1), count - 1)))
    if least > clear + error:
        return least
    if low > a:
        share = (high - low) * (high + low) / ((high - a) * (high + a))
        last = opening(table, curve, edge, high)
        if last < 0.0:
            return last
        within = last / (share * amplitude_power(table_of(table, curve), share)) - openings[count]
        if least + max(0.0, within) > clear + error:
            return least + max(0.0, within)
    if low > a or error > _CLEAR:
        for i in range(count + 1):
            openings[i] = opening(table, curve, edge, place_of(low, high, i))
            if openings[i] < 0.0:
                return openings[i]
        clear = _CLEAR * max(1.0, np.max(openings) - np.min(openings))
        least = np.min(openings)
    elif openings[at] < -error:
        return openings[at]
    else:
        least = openings[at]
    for i in range(count + 1):
        if _is_low(openings, i, clear):
            before = place_of(low, high, i - 1) if i > 0 else low
            after = place_of(low, high, min(i + 1, count))
            least = min(
                least, opening(table, curve, edge, place_of(low, high, i)), _search(table, curve, edge, before, after)
            )
            if least < 0.0:
                return least
    return least


@kernel()
def next_window(low: float, high: float, heights: Floats) -> float:
    """Return x where the next window may begin: at the last part on which F (NODES.size values) is >= 0, or `high`."""
    i = NODES.size - 1
    while i > 0 and heights[i] < 0.0:
        i -= 1
    while i > 0 and heights[i - 1] >= 0.0:
        i -= 1
    return place_of(low, high, i) if i > 0 else high


@kernel()
def least_opening(table: AnyTable, curve: AnyCurve, start: float, end: float) -> float:
    """Return about the least opening at the radii up to `end` around the contact of radius `start` > 0.

    The sign is that of the least gap. Above 0 the value is a lower bound, or good to some hundredths; below 0 it is the
    opening at one of the radii where the gap is negative.
    """
    heights, openings = np.empty(NODES.size), np.empty(NODES.size + 1)
    edge = edge_at(table, curve, start)
    short, growth = panels_of(table, curve)
    window = _WINDOW * short
    least, low, period = 1.0, start, start
    windows = _MOST_WINDOWS * max(1.0, 1.0 / window)
    while low < end:
        high = min(end, low + window, low * growth)
        least = min(least, _least_in_window(table, curve, edge, low, high, heights, openings))
        if least < 0.0 or high == end:
            break
        low = next_window(low, high, heights)
        windows -= 1
        if windows < 0 and low > period + 1.0:  # far out one wavelength in a tenth of the radius
            low = period = max(low, min(end, 1.1 * low))
    return least
