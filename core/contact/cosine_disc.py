"""Whether the contact stays one disc while it is loaded up to a rim: the gap outside it must nowhere be negative.

Only radii that a jump of loading passes have to be looked at, for the contact that the jump leaves (docs/theory.md,
section 12). Unloading is always one disc. On a branch the gap at a given radius falls as the contact grows, so that its
end is the worst place. And where the gap is not negative up to the place of landing, it is not beyond either: on the
branch of landing depth_H exceeds the depth, and every later end of a branch stands deeper than this one.

A jump is surely open where depth_H is nowhere below its depth, which the trace tells: between two starts of branches
depth_H exceeds the depth of the outer start by the stretch at least. Else the opening of contact/cosine_gap.py is taken
at 17 radii a wave; only where its least value there is near zero it is searched for.
"""

import math
from typing import Any, Final

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.contact.cosine_gap import Edge, edge_at, opening, openings_between, trough_gap
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    NOWHERE,
    RUN,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    RUN_LEAST,
    START_DEPTH,
    VALUES,
    WORK,
)
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.fractional import NODES, interpolated
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.waves.cosine import end_of_wave

ALWAYS_ONE: Final = 0.5
"""C g up to which every contact under a depth of 0 or more is one disc."""
_WINDOW: Final = 1.125
"""Waves that are looked at together."""
_CLEAR: Final = 0.02
"""The parabola through three of 17 openings is nearer than this to their least value; below it is searched for."""
_GOLDEN: Final = 0.5 * (math.sqrt(5.0) - 1.0)
_STEPS: Final = 30
"""Of the golden section: they leave 1e-6 of the bracket, and 1e-12 of the least value."""
_MOST_WINDOWS: Final = 64
"""Windows of a jump; over longer jumps the troughs of the profile further out are sampled."""
_SAMPLES: Final = 12
"""Waves of a regular run at which the opening is taken."""
_SMOOTH: Final = 0.25
"""Least opening of the samples from which on nothing lower is looked for between them."""


@kernel()
def place_of(low: float, high: float, i: int) -> float:
    """Return node i of a window, its end for the last i."""
    if i >= NODES.size:
        return high
    return math.sqrt(low * low + (high - low) * (high + low) * NODES[i])


@kernel()
def _least_of(openings: Any) -> tuple[int, float]:
    """Return the place of the least of 17 openings, and the lowest point of the parabola through it."""
    count = NODES.size
    at = 0
    for i in range(1, count + 1):
        if openings[i] < openings[at]:
            at = i
    middle = min(max(at, 1), count - 1)
    here = NODES[middle]
    before, after = NODES[middle - 1] - here, (NODES[middle + 1] if middle + 1 < count else 1.0) - here
    left, right = (openings[middle - 1] - openings[middle]) / before, (openings[middle + 1] - openings[middle]) / after
    curvature = (right - left) / (after - before)
    rate = right - curvature * after
    place = -0.5 * rate / curvature if curvature > 0.0 else 0.0
    if before < place < after and curvature > 0.0:
        return at, min(openings[at], openings[middle] + 0.5 * rate * place)
    return at, openings[at]


@kernel()
def _least_between_nodes(openings: Any, at: int) -> float:
    """Return the least value next to node `at`, the last for 1, of the polynomial through openings (golden section)."""
    low = NODES[at - 1] if at > 0 else 0.0
    high = NODES[at + 1] if at + 1 < NODES.size else 1.0
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    first, second = interpolated(openings, inner), interpolated(openings, outer)
    for _ in range(_STEPS):
        if first < second:
            high, outer, second = outer, inner, first
            inner = high - _GOLDEN * (high - low)
            first = interpolated(openings, inner)
        else:
            low, inner, first = inner, outer, second
            outer = low + _GOLDEN * (high - low)
            second = interpolated(openings, outer)
    return min(first, second, openings[at])


@kernel()
def _search(table: Any, curve: Cosine, edge: Edge, low: float, high: float) -> float:
    """Return the least opening between two radii, or the first negative one that is met (golden section)."""
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    first, second = opening(table, curve, edge, inner), opening(table, curve, edge, outer)
    for _ in range(_STEPS):
        if min(first, second) < 0.0:
            break
        if first < second:
            high, outer, second = outer, inner, first
            inner = high - _GOLDEN * (high - low)
            first = opening(table, curve, edge, inner)
        else:
            low, inner, first = inner, outer, second
            outer = low + _GOLDEN * (high - low)
            second = opening(table, curve, edge, outer)
    return min(first, second)


@kernel()
def _least_in_window(
    table: Any, curve: Cosine, edge: Edge, low: float, high: float, heights: Any, openings: Any
) -> float:
    """Return the least opening between two radii, given that there is none below 0 up to `low`.

    Beyond `low` > a the opening is no less than what the radii from there on contribute, which is taken first.
    """
    a, _, _, _ = edge
    openings_between(table, curve, edge, low, high, heights, openings)
    # the polynomial in x^2 feels the branch point at x = 0
    distance = 1.0 + 2.0 * low * low / ((high - low) * (high + low))
    error = 1e-9 + 10.0 * (distance + math.sqrt(distance * distance - 1.0)) ** (-NODES.size)
    at, least = _least_of(openings)
    if least > _CLEAR + error:
        return least
    if low > a or error > _CLEAR:
        for i in range(NODES.size + 1):
            openings[i] = opening(table, curve, edge, place_of(low, high, i))
            if openings[i] < 0.0:
                return openings[i]
        at, least = _least_of(openings)
        if least > _CLEAR:
            return least
    elif openings[at] < -error:
        return openings[at]
    else:
        least = _least_between_nodes(openings, at)
        if abs(least) > 10.0 * error:
            return least
    return min(
        opening(table, curve, edge, place_of(low, high, at)),
        _search(
            table,
            curve,
            edge,
            place_of(low, high, at - 1) if at > 0 else low,
            place_of(low, high, min(at + 1, NODES.size)),
        ),
    )


@kernel()
def next_window(low: float, high: float, heights: Any) -> float:
    """Return where the next window may begin: where the last part begins on which depth_H lies above, or at `high`."""
    i = NODES.size - 1
    while i > 0 and heights[i] < 0.0:
        i -= 1
    while i > 0 and heights[i - 1] >= 0.0:
        i -= 1
    return place_of(low, high, i) if i > 0 else high


@kernel()
def least_opening(table: Any, curve: Cosine, start: float, end: float, heights: Any, openings: Any) -> float:
    """Return about the least opening at the radii up to `end` around the contact that ends its branch at `start`.

    The sign is that of the least gap. Above 0 the value is a lower bound, or good to some hundredths; below 0 it is the
    opening at one of the radii where the gap is negative.
    """
    edge = edge_at(table, curve, start)
    least = 1.0
    low = start
    for _ in range(_MOST_WINDOWS):
        high = min(end, low + _WINDOW)
        least = min(least, _least_in_window(table, curve, edge, low, high, heights, openings))
        if least < 0.0 or high == end:
            return least
        low = next_window(low, high, heights)
    trough = math.ceil(low)
    while trough <= end:
        least = min(least, trough_gap(table, curve, edge, trough))
        trough = math.ceil(1.1 * trough)
    return least


@kernel(entry=True)
def _least_of_wave(table: Any, curve: Cosine, wave: float, heights: Any, openings: Any) -> float:
    """Return the least opening outside the end of a wave's branch; `wave` is any real number."""
    shifted, x = end_of_wave(table, curve, wave)
    return least_opening(table, shifted, x, x + 1.0, heights, openings)


@kernel(entry=True)
def _least_of_run(table: Any, curve: Cosine, first: float, last: float, heights: Any, openings: Any) -> float:
    """Return the least opening outside the ends of regular waves: a smooth function of the wave, sampled."""
    first = max(first, 1.0)
    ratio = power(last / first, 1.0 / (_SAMPLES - 1.0))
    least, at = math.inf, first
    wave = first
    for _ in range(_SAMPLES):
        value = _least_of_wave(table, curve, min(wave, last), heights, openings)
        if value < least:
            least, at = value, wave
        wave *= ratio
    if least < 0.0 or least > _SMOOTH or last == first:
        return least
    low, high = max(first, at / ratio), min(last, at * ratio)
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    one = _least_of_wave(table, curve, inner, heights, openings)
    other = _least_of_wave(table, curve, outer, heights, openings)
    for _ in range(_STEPS):
        if min(one, other) < 0.0:
            break
        if one < other:
            high, outer, other = outer, inner, one
            inner = high - _GOLDEN * (high - low)
            one = _least_of_wave(table, curve, inner, heights, openings)
        else:
            low, inner, one = inner, outer, other
            outer = low + _GOLDEN * (high - low)
            other = _least_of_wave(table, curve, outer, heights, openings)
    return min(least, one, other)


@kernel()
def limits_from(
    table: Any, curve: Cosine, first: int, last: int, now: int, count: int, trace: Any, furthest: float
) -> tuple[float, float]:
    """Return what `disc_limits` does, from jumps that land on the branches `first` to `last`, `count` for the rim.

    Loading, one disc so far, leaves the branch `now` before.
    """
    heights, openings = trace[WORK], trace[VALUES]
    gap = trace[RUN, GAP]  # the branches from here on stand beyond waves that were not walked
    lowest = math.inf
    for branch in range(first, last + 1):
        rim = branch == count
        if not rim:
            lowest = min(lowest, trace[START_DEPTH, branch])
            if trace[ARRIVAL, branch] == math.inf:
                continue
        left = trace[END, now] if now >= 0 else 0.0
        landing = furthest if rim else trace[ARRIVAL, branch]
        end = min(furthest, landing)
        across = now < gap <= branch
        if across and not rim and trace[RUN, RUN_LAST] >= trace[RUN, RUN_FIRST]:
            least = trace[RUN, RUN_LEAST]
            if math.isnan(least):
                least = _least_of_run(table, curve, trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST], heights, openings)
            if least < 0.0:
                return left, left
            end = trace[RUN, RUN_LANDING]
        if now >= 0 and left < end:
            if rim:
                lowest = min(lowest, depth(table, curve, furthest))
            z = TWO_PI * left
            above = lowest + z * amplitude_power(table, z) >= trace[END_DEPTH, now]
            if (across or not above) and least_opening(table, curve, left, end, heights, openings) < 0.0:
                return left, landing
        now, lowest = branch, math.inf
    return math.inf, math.inf


@kernel()
def disc_limits(table: Any, curve: Cosine, count: int, trace: Any, furthest: float) -> tuple[float, float]:
    """Return the radius up to which loading keeps the contact one disc, and that from which on it does not.

    They are those of the first jump that does not, as far as `furthest`; for a rim between the two `is_one_disc` looks
    anew. Infinite where loading keeps one disc throughout.

    Parameters
    ----------
    table, curve
        The tables of the exponent, and the curve.
    count, trace
        What `walk` (path/cosine.py) or `stride` (path/cosine_long.py) has returned.
    furthest
        The rim in x = a/lambda, the largest one if there are several.
    """
    _, g, _ = curve
    if g * table.amplitude <= ALWAYS_ONE:
        return math.inf, math.inf
    return limits_from(table, curve, NONE, count, NOWHERE, count, trace, furthest)


@kernel()
def note_run(table: Any, curve: Cosine, last: float, trace: Any) -> None:
    """Note whether the contact is one disc on the waves of a gap, where that serves all rims.

    It does if the first of them is none, and if all up to wave `last` surely are.
    """
    _, g, _ = curve
    first = trace[RUN, RUN_FIRST]
    if g * table.amplitude <= ALWAYS_ONE or not first < last < math.inf:
        return
    least = _least_of_wave(table, curve, max(first, 1.0), trace[WORK], trace[VALUES])
    if least >= 0.0:
        least = _least_of_run(table, curve, first, last, trace[WORK], trace[VALUES])
        if least <= _SMOOTH:
            return
    trace[RUN, RUN_LEAST] = least


@kernel()
def is_one_disc(table: Any, curve: Cosine, limits: tuple[float, float], rim: float, trace: Any) -> bool:
    """Return whether loading keeps the contact one disc up to a rim, from the limits of its curve."""
    low, high = limits
    if rim <= low or rim >= high:
        return rim <= low
    return least_opening(table, curve, low, rim, trace[WORK], trace[VALUES]) >= 0.0
