"""Folds: where D changes its sign, found from its values at the edges of bins and a bound of how far it can swing."""

import math
from typing import Final

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.values import (
    Curve,
    bin_of,
    coordinate_of,
    depth_and_load,
    depth_at_centre,
    radius_of,
    slope_at,
    slope_in,
    slope_near,
    slope_terms_at,
)
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import BE, BP, BV, HALF, QPOW, QUP, RLOW, RPOW, Y, end_of
from gradhesion.core.types import Floats

_CHUNK: Final = 32
"""Bins after which it is asked whether the folds have come to an end."""
CLOSE: Final = 1e-10
"""Decisions closer than this, relative to the sizes of their terms, are reported as close_to_a_jump."""
TOO_SHORT: Final = -2
"""In the place of a number of branches: the table ends before what was asked for."""
FULL: Final = -1
"""The trace has no room left."""
_TINY: Final = 1e-300
"""Stands for a D of 0 at a double zero, so that it has a sign."""


@leaf
def zero_in(curve: Curve, i: int, low: float, high: float, guess: float, rising: bool) -> tuple[float, float]:
    """Return the place in bin i, between two at which D has different signs, where D is 0, and the depth there.

    Halley's method kept within the bracket. The place is good to 1e-9 of a bin (values of folds forgive its square);
    under a load to 1e-12, since the depth is not stationary there.
    """
    t, depth = guess, 0.0
    near, bend = 4e-4, 4e-3  # the next step is this one times the square of its part of the distance to D' = 0
    if curve.by_load != 0.0:
        near, bend = 1e-6, 1e-4
    for _ in range(60):
        D, D1, D2, depth = slope_in(curve, i, t)
        if (D > 0.0) == rising:
            high = t
        else:
            low = t
        step = -2.0 * D * D1 / (2.0 * D1 * D1 - D * D2)
        ahead = t + step
        if not (low <= ahead <= high):
            ahead = 0.5 * (low + high)
            step = ahead - t
        if (abs(step) < near and abs(step * D2) < bend * abs(D1)) or step == 0.0:
            if curve.by_load == 0.0:  # what the last step still changes
                depth += step * (D + step * (0.5 * D1 + step * D2 / 6.0))
            return ahead, depth
        t = ahead
    return t, depth


@kernel
def pair_in(curve: Curve, i: int, sign: float) -> tuple[bool, float, float]:
    """Look for a pair of folds in bin i, at whose edges D has this sign: whether D has an extremum of the other one.

    Return whether it has, the place of its extremum, and D there times the half width (infinite: there is no extremum).
    """
    _, left, _, _ = slope_near(curve, i, -1.0)
    _, right, _, _ = slope_near(curve, i, 1.0)
    D, t, low, high = sign * math.inf, 0.0, -1.0, 1.0
    ahead = left / (left - right) * 2.0 - 1.0
    for _ in range(60 if left * sign < 0.0 < right * sign else 0):
        t = ahead
        D, D1, D2, _ = slope_near(curve, i, t)
        if D1 * sign > 0.0:
            high = t
        else:
            low = t
        ahead = t - D1 / D2
        if not (low < ahead < high):
            ahead = 0.5 * (low + high)
        if abs(ahead - t) < 1e-7:
            break
    return D * sign <= 0.0, t, D if D != 0.0 else -sign * _TINY


@kernel
def _turn_of_slope(curve: Curve, i: int, low: float, high: float, sign: float) -> float:
    """Return the place between two where sign D' turns from positive to negative, or the reverse, by bisection."""
    _, D1, _, _ = slope_near(curve, i, low)
    rises = D1 * sign > 0.0
    for _ in range(40):
        t = 0.5 * (low + high)
        _, D1, _, _ = slope_near(curve, i, t)
        if (D1 * sign > 0.0) == rises:
            low = t
        else:
            high = t
    return 0.5 * (low + high)


@kernel
def detour_in(curve: Curve, i: int, sign: float) -> tuple[bool, float, float]:
    """Look for three folds in bin i, over which sign D goes from below to above 0: whether it falls below 0 again.

    Return that, and the places of the crest and of the trough between them. D' must be positive at both edges and
    negative somewhere between: at the least of D', which is looked for where D'' turns.
    """
    _, left, left2, _ = slope_near(curve, i, -1.0)
    _, right, right2, _ = slope_near(curve, i, 1.0)
    low, high, middle, D1 = -1.0, 1.0, 0.0, sign
    if left * sign > 0.0 < right * sign and left2 * sign < 0.0 < right2 * sign:
        while high - low > 1e-12 and D1 * sign >= 0.0:
            middle = 0.5 * (low + high)
            _, D1, D2, _ = slope_near(curve, i, middle)
            if D2 * sign < 0.0:
                low = middle
            else:
                high = middle
    crest = trough = top = bottom = 0.0
    if D1 * sign < 0.0:
        crest = _turn_of_slope(curve, i, -1.0, middle, sign)
        trough = _turn_of_slope(curve, i, middle, 1.0, sign)
        top, _, _, _ = slope_near(curve, i, crest)
        bottom, _, _, _ = slope_near(curve, i, trough)
    return top * sign > 0.0 and bottom * sign < 0.0, crest, trough


@leaf
def swing_in(curve: Curve, i: int) -> float:
    """Return a bound of how far D within bin i is from the line through its values at the edges, in the unit of D.

    D is the slope d depth/dy of table/layout.py, of which curves count the terms: B m y^(m-1) + g U' - q E, with q from
    (1-k)/2 (depth prescribed) to (3+k)/2 (load). Rows BV, BP and BE bound h^2/2 times the second derivatives of U',
    m y^(m-1) and E, h being the half width; `highest` is the largest q, which bounds that of a machine as well.
    """
    nodes = curve.table.nodes
    highest = 0.5 * (1.0 - curve.table.k) + (1.0 + curve.table.k if curve.by_load != 0.0 else 0.0)
    return curve.g * nodes[BV, i] + curve.B * nodes[BP, i] + highest * nodes[BE, i]


@leaf
def _guess_of(older: float, before: float, after: float) -> float:
    """Return where in a bin D is about 0, by the parabola through three edges, the last two around the bin."""
    bend = after - 2.0 * before + older
    share = before / (before - after)
    share -= 0.5 * bend * share * (share - 1.0) / (after - before + bend * (share - 0.5))
    return 2.0 * min(max(share, 0.02), 0.98) - 1.0


@kernel
def _add_fold(
    curve: Curve, i: int, low: float, high: float, guess: float, rising: bool, trace: Floats, count: int
) -> int:
    """Put the fold of bin i between two places into the trace, the start of a branch or its end.

    Return the number of branches, FULL if there is no room.
    """
    t, depth = zero_in(curve, i, low, high, guess, rising)
    load = 0.0
    if curve.by_load != 0.0:
        depth, load = depth_and_load(curve, i, t)
    y, level = radius_of(curve.table, i, t), coordinate_of(curve, depth, load)
    if count < 0 or count >= trace.shape[1]:
        count = FULL
    elif rising:
        trace[at.START, count], trace[at.START_DEPTH, count], trace[at.START_LOAD, count] = y, depth, load
        trace[at.START_LEVEL, count], trace[at.UNLOADED, count] = level, math.nan
        trace[at.END, count] = trace[at.END_LEVEL, count] = math.inf
        count += 1
    else:
        trace[at.END, count - 1], trace[at.END_DEPTH, count - 1], trace[at.END_LOAD, count - 1] = y, depth, load
        trace[at.END_LEVEL, count - 1] = level
    return count


@kernel
def _add_folds(curve: Curve, i: int, older: float, before: float, after: float, trace: Floats, count: int) -> int:
    """Put the folds of bin i, in which D may turn on its way, into the trace: none to three.

    D is `before` and `after` at its edges, and `older` an edge below. Return the number of branches, or FULL.
    """
    rises, swing, half = after > 0.0, swing_in(curve, i), curve.table.nodes[HALF, i]
    sign, close = 1.0 if rises else -1.0, CLOSE * slope_terms_at(curve, i)
    if (before > 0.0) == rises:
        found, t, extreme = pair_in(curve, i, sign)
        if found:
            guess = -1.0 + (t + 1.0) * before * half / (before * half - extreme)
            count = _add_fold(curve, i, -1.0, t, guess, not rises, trace, count)
            guess = t + (1.0 - t) * extreme / (extreme - after * half)
            count = _add_fold(curve, i, t, 1.0, guess, rises, trace, count)
        if abs(extreme) <= close * half:
            trace[at.CLOSE_PAIR, 0] = min(trace[at.CLOSE_PAIR, 0], curve.table.nodes[Y, i])
    else:
        found, crest, trough = detour_in(curve, i, sign)
        if found:
            count = _add_fold(curve, i, -1.0, crest, 0.5 * (crest - 1.0), rises, trace, count)
            count = _add_fold(curve, i, crest, trough, 0.5 * (crest + trough), not rises, trace, count)
            count = _add_fold(curve, i, trough, 1.0, 0.5 * (trough + 1.0), rises, trace, count)
        else:
            count = _add_fold(curve, i, -1.0, 1.0, _guess_of(older, before, after), rises, trace, count)
    if abs(after) <= close and swing > 0.5 * abs(before):
        trace[at.CLOSE_PAIR, 0] = min(trace[at.CLOSE_PAIR, 0], curve.table.nodes[Y, i])
    return count


@leaf
def _folds_end(curve: Curve, i: int) -> bool:
    """Return whether the bounds of the table say that there is no fold from bin i on."""
    k, nodes = curve.table.k, curve.table.nodes
    highest = 0.5 * (1.0 - k) + (1.0 + k if curve.by_load != 0.0 else 0.0)
    return curve.B * nodes[RPOW, i] + curve.g * nodes[RLOW, i] > highest / nodes[Y, i]


@kernel
def scan(curve: Curve, first: int, last: int, count: int, trace: Floats) -> tuple[int, bool]:
    """Add the folds in the bins `first` to `last` - 1 to `count` branches.

    Return the number of branches (FULL: no room) and whether the bounds of the table say that no fold follows.
    """
    # else the power loses against the waves: folds need not end
    may_end = curve.g == 0.0 or curve.table.exponent - 1.0 >= 0.5 * (1.0 - curve.table.k)
    older = before = slope_at(curve, first)
    start, ended = first, may_end and _folds_end(curve, first)
    while start < last and count >= 0 and not ended:
        end = min(start + _CHUNK, last)
        for i in range(start, end):
            after = slope_at(curve, i + 1)
            crosses, swing = (before > 0.0) != (after > 0.0), swing_in(curve, i)
            if crosses and abs(after - before) >= 4.0 * swing:  # one fold, and no more
                count = _add_fold(curve, i, -1.0, 1.0, _guess_of(older, before, after), after > 0.0, trace, count)
            elif crosses or min(abs(before), abs(after)) < swing:
                count = _add_folds(curve, i, older, before, after, trace, count)
            older, before = before, after
        start = end
        ended = may_end and _folds_end(curve, end)
    return count, ended


@leaf
def first_bin(curve: Curve) -> int:
    """Return a bin below which D < 0 for certain."""
    nodes = curve.table.nodes
    base = 0.5 * (1.0 - curve.table.k)
    low, high = 0, curve.table.bins
    while high - low > 1:
        i = (low + high) // 2
        if curve.B * nodes[QPOW, i] + curve.g * nodes[QUP, i] < base:
            low = i
        else:
            high = i
    return low


@kernel
def close_end(curve: Curve, last: int, count: int, trace: Floats) -> None:
    """End an open branch at the lower edge of bin `last`, where the search has ended: no cycle gets there."""
    if count > 0 and trace[at.END, count - 1] == math.inf:
        trace[at.END, count - 1] = curve.table.nodes[Y, last]
        depth, load = depth_and_load(curve, last - 1, 1.0)
        trace[at.END_DEPTH, count - 1], trace[at.END_LOAD, count - 1] = depth, load
        trace[at.END_LEVEL, count - 1] = coordinate_of(curve, depth, load)


@kernel
def find_folds(curve: Curve, y_end: float, trace: Floats) -> int:
    """Fill the trace with all branches that begin below a radius, and return their number, FULL or TOO_SHORT.

    The last branch is endless (END = inf) if no fold follows at all.
    """
    first, last = first_bin(curve), curve.table.bins
    if y_end < end_of(curve.table):
        last = bin_of(curve.table, y_end) + 1
    count, trace[at.CLOSE_PAIR, 0] = 0, math.inf
    if slope_at(curve, first) > 0.0:  # k = 1, or a first fold below the table: the first branch begins at 0
        depth = depth_at_centre(curve)
        trace[at.START, 0], trace[at.START_DEPTH, 0], trace[at.START_LOAD, 0] = 0.0, depth, 0.0
        trace[at.START_LEVEL, 0] = coordinate_of(curve, depth, 0.0)
        trace[at.END, 0], trace[at.END_LEVEL, 0], trace[at.UNLOADED, 0] = math.inf, math.inf, math.nan
        count = 1
    count, ended = scan(curve, first, last, count, trace)
    if count >= 0 and not ended:
        if last == curve.table.bins and y_end > end_of(curve.table):
            count = TOO_SHORT
        else:
            close_end(curve, last, count, trace)
    return count
