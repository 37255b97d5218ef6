"""Whether the contact stays one disc while it is loaded, for any profile and control (docs/theory.md, section 15).

As in core/contact/cosine_disc.py only jumps of loading have to be looked at: for the contact that a jump leaves the gap
must not be negative at the radii that the jump passes. The jump from zero contact leaves the profile itself
(contact/touch.py).

A jump is surely open if the coordinate Y falls over it by no more than (1 + tau) Delta of the contact that is left.
Else the opening of contact/general_gap.py is taken at 17 radii in a little more than the shortest wave; it is searched
for its least value only where that is near zero.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.cosine_disc import next_window, place_of
from gradhesion.core.contact.general_gap import (
    Edge,
    edge_at,
    growth_of_a_panel,
    opening,
    openings_between,
    shortest_wave,
)
from gradhesion.core.contact.touch import touches_at_centre
from gradhesion.core.curve.branches import ARRIVAL, END, ends
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_branches import END_LEVEL, START_LEVEL, find_level
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.fractional import NODES
from gradhesion.core.struve.power import amplitude_power

_WINDOW: Final = 1.125
"""Shortest waves that are looked at together."""
_CLEAR: Final = 0.02
"""The parabola through three of 17 openings is nearer than this to their least value, in parts of what they span."""
_MOST_WINDOWS: Final = 64.0
"""Windows of one wave, or wavelengths of a series, over which nothing is left out."""
_GOLDEN: Final = 0.5 * (math.sqrt(5.0) - 1.0)
_STEPS: Final = 30
"""Of the golden section: they leave 1e-6 of the bracket, and 1e-12 of the least value."""


@kernel()
def _search(basis: Basis, curve: Series, edge: Edge, low: float, high: float) -> float:
    """Return the least opening between two radii, or the first negative one that is met (golden section)."""
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    first, second = opening(basis, curve, edge, inner), opening(basis, curve, edge, outer)
    for _ in range(_STEPS):
        if min(first, second) < 0.0:
            break
        if first < second:
            high, outer, second = outer, inner, first
            inner = high - _GOLDEN * (high - low)
            first = opening(basis, curve, edge, inner)
        else:
            low, inner, first = inner, outer, second
            outer = low + _GOLDEN * (high - low)
            second = opening(basis, curve, edge, outer)
    return min(first, second)


@kernel()
def _bottom(openings: Any, i: int) -> float:
    """Return the lowest point of the parabola through the openings i - 1, i, i + 1, or the opening i if it is lower."""
    count = NODES.size
    if not 0 < i < count:
        return openings[i]
    here = NODES[i]
    before, after = NODES[i - 1] - here, (NODES[i + 1] if i + 1 < count else 1.0) - here
    left, right = (openings[i - 1] - openings[i]) / before, (openings[i + 1] - openings[i]) / after
    curvature = (right - left) / (after - before)
    rate = right - curvature * after
    place = -0.5 * rate / curvature if curvature > 0.0 else math.inf
    return openings[i] + 0.5 * rate * place if before < place < after else openings[i]


@kernel()
def _is_low(openings: Any, i: int, clear: float) -> bool:
    """Return whether an opening is the least among its neighbours, and not clear of a level."""
    count = NODES.size
    if (i > 0 and openings[i - 1] < openings[i]) or (i < count and openings[i + 1] < openings[i]):
        return False
    # next to an end the least may lie between, though the end itself is no least
    return _bottom(openings, min(max(i, 1), count - 1)) <= clear or openings[i] <= clear


@kernel()
def _least_in_window(
    basis: Basis, curve: Series, edge: Edge, low: float, high: float, heights: Any, openings: Any
) -> float:
    """Return the least opening between two radii, given that there is none below 0 up to `low`.

    Beyond `low` > a the opening is no less than what the radii from there on contribute, which is taken first. What
    those within contribute, over (x^2 - low^2)^c, falls outwards: at `high` it serves the whole window.
    """
    table, _, _ = basis
    a, _, _, _ = edge
    count = NODES.size
    openings_between(basis, curve, edge, low, high, heights, openings)
    # the polynomial in x^2 feels the branch point at x = 0
    distance = 1.0 + 2.0 * low * low / ((high - low) * (high + low))
    error = 1e-9 + 10.0 * (distance + math.sqrt(distance * distance - 1.0)) ** (-count)
    error *= max(1.0, np.max(np.abs(heights)))
    least, span = np.min(openings), np.max(openings) - np.min(openings)
    clear = _CLEAR * max(1.0, span)
    if least > clear + error:
        return least
    if low > a:
        share = (high - low) * (high + low) / ((high - a) * (high + a))
        last = opening(basis, curve, edge, high)
        if last < 0.0:
            return last
        within = last / (share * amplitude_power(table, share)) - openings[count]
        if least + max(0.0, within) > clear + error:
            return least + max(0.0, within)
    if low > a or error > _CLEAR:
        for i in range(count + 1):
            openings[i] = opening(basis, curve, edge, place_of(low, high, i))
            if openings[i] < 0.0:
                return openings[i]
        clear = _CLEAR * max(1.0, np.max(openings) - np.min(openings))
        least = np.min(openings)
    elif least < -error:
        return least
    for i in range(count + 1):
        if _is_low(openings, i, clear):
            before = place_of(low, high, i - 1) if i > 0 else low
            after = place_of(low, high, min(i + 1, count))
            least = min(
                least,
                opening(basis, curve, edge, place_of(low, high, i)),
                _search(basis, curve, edge, before, after),
            )
            if least < 0.0:
                return least
    return least


@kernel()
def least_opening(basis: Basis, curve: Series, start: float, end: float) -> float:
    """Return about the least opening at the radii up to `end` around the contact of radius `start` > 0.

    The sign is that of the least gap. Above 0 the value is a lower bound, or good to some hundredths; below 0 it is the
    opening at one of the radii where the gap is negative.
    """
    _, _, series = basis
    _, m, _, _, _ = curve
    heights, openings = np.empty(NODES.size), np.empty(NODES.size + 1)
    edge = edge_at(basis, curve, start)
    window, growth = _WINDOW * shortest_wave(series), growth_of_a_panel(m)
    least, low, period = 1.0, start, start
    windows = _MOST_WINDOWS * max(1.0, 1.0 / window)
    while low < end:
        high = min(end, low + window, low * growth)
        least = min(least, _least_in_window(basis, curve, edge, low, high, heights, openings))
        if least < 0.0 or high == end:
            break
        low = next_window(low, high, heights)
        windows -= 1
        if windows < 0 and low > period + 1.0:  # far out one wavelength in a tenth of the radius
            low = period = max(low, min(end, 1.1 * low))
    return least


@kernel()
def is_surely_open(basis: Basis, curve: Series, left: float, fall: float) -> bool:
    """Return whether a jump leaves one disc because the coordinate falls by no more than `fall` over it."""
    table, _, _ = basis
    _, _, _, alpha, beta = curve
    z = TWO_PI * left
    power = amplitude_power(table, z)
    return (alpha + beta / (power * power)) * z * power >= fall


@kernel()
def jump_is_one_disc(basis: Basis, curve: Series, left: float, end: float) -> bool:
    """Return whether the gap of the contact that a jump of loading leaves is nowhere negative at the radii it passes.

    Parameters
    ----------
    basis, curve
        Those of curve/general.py.
    left, end
        The radius x that is left, 0 for no contact, and that of landing, or the rim.
    """
    if left == 0.0:
        return touches_at_centre(basis, curve, end)
    return least_opening(basis, curve, left, end) >= 0.0


@kernel()
def climb_is_one_disc(
    basis: Basis, curve: Series, count: int, trace: Any, rim: float, left: float, level: float, whole: float
) -> bool:
    """Return whether loading over the branches of a trace, and on to the rim, keeps the contact one disc.

    It begins at the radius x = `left` and the coordinate `level`; branches and rim are `whole` waves further out, and a
    rim of -inf is none.
    """
    lowest = -math.inf
    for branch in range(count + 1):
        if branch < count:
            lowest = min(lowest, trace[START_LEVEL, branch])
            if trace[END_LEVEL, branch] <= level:
                continue
        elif left < whole + rim:
            lowest = min(lowest, coordinate(basis, curve, rim, whole))
        else:
            break
        if left == 0.0 or not is_surely_open(basis, curve, left, level - lowest):
            end = whole + (find_level(basis, curve, level, ends(trace, branch), whole) if branch < count else rim)
            if not jump_is_one_disc(basis, curve, left, end):
                return False
        if branch < count:
            left, level, lowest = whole + trace[END, branch], trace[END_LEVEL, branch], math.inf
    return True


@kernel()
def disc_limits(basis: Basis, curve: Series, count: int, trace: Any, furthest: float) -> tuple[float, float]:
    """Return the place up to which loading keeps the contact one disc, and that from which on it does not.

    They are those of the first jump that does not, as far as `furthest`; for a rim between the two `is_one_disc` looks
    anew. Infinite where loading keeps one disc throughout. The trace is that of path/general.py.
    """
    now, lowest = -1, math.inf
    for branch in range(count + 1):
        landing = furthest
        if branch < count:
            lowest = min(lowest, trace[START_LEVEL, branch])
            landing = trace[ARRIVAL, branch]
            if landing == math.inf:
                continue
        left = trace[END, now] if now >= 0 else 0.0
        if branch == count:
            if left >= furthest:
                break
            lowest = min(lowest, coordinate(basis, curve, furthest))
        surely = now >= 0 and is_surely_open(basis, curve, left, trace[END_LEVEL, now] - lowest)
        if not surely and not jump_is_one_disc(basis, curve, left, landing):
            return left, landing
        now, lowest = branch, math.inf
    return math.inf, math.inf


@kernel()
def is_one_disc(basis: Basis, curve: Series, limits: tuple[float, float], rim: float) -> bool:
    """Return whether loading keeps the contact one disc up to a rim, from the limits of its curve."""
    low, high = limits
    if rim <= low or rim >= high:
        return rim <= low
    return jump_is_one_disc(basis, curve, low, rim)
