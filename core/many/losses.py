"""What the waves between the first and the last ones of a cycle lose: sampled and summed where it is smooth."""

from typing import Final

import numpy as np

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.values import Curve, slope_at
from gradhesion.core.cycle.disc import gap_is_open
from gradhesion.core.cycle.path import end_state, fill_unloading, walk_on
from gradhesion.core.jit import allocating, inlined, kernel
from gradhesion.core.many.search import (
    BORN,
    BOTTOM,
    NEAR,
    Long,
    Sought,
    Space,
    guess,
    highest_end,
    lowest_start,
    trace_waves,
)
from gradhesion.core.many.waves import GAUSS, fill_rule
from gradhesion.core.types import Floats

_LONG: Final = 3.0
"""Length of a panel, in its distance from a place where losses are not smooth."""

_AT_ONCE: Final = 4
"""Waves that are walked at once, in the room for five."""

_SMOOTH: Final = 5e-8
"""Of a sum: the most that its last two polynomials may find; what is missed is about the square."""

_MOST_WALKED: Final = 200_000
"""Waves between that are walked, at most."""

# Rows of what a wave loses: outwards, from the highest top of the wave before to its own; inwards, from its lowest
# bottom to that of the wave before; in how many jumps; and whether a jump leaves a contact that is not one disc.
OUTWARDS, INWARDS, JUMPS_OUTWARDS, JUMPS_INWARDS, SHUT = range(5)
LOSSES: Final = 5


@kernel
def jumps_are_open(long: Long, curve: Curve, space: Space, visits: int, rim: float) -> bool:
    """Return whether the contact is one disc during all jumps between visited branches, and from them to a rim."""
    for v in range(1, visits + 1):
        state = end_state(space.trace, space.visited[v - 1])
        if state.y >= rim:
            return True
        landing = min(rim, space.trace[at.LANDING, space.visited[v]] if v < visits else rim)
        if not gap_is_open(curve, long.disc, state.y, state.depth, landing):
            return False
    return True


@kernel
def _losses(long: Long, curve: Curve, number: float, space: Space, outwards: bool, inwards: bool, out: Floats) -> bool:
    """Put what some waves lose into `out` (LOSSES,), on the ways that are asked for; return whether they are regular.

    They are those from `number` on that a space holds besides the one before.
    """
    trace, visited = space.trace, space.visited
    piece, first, others, count = trace_waves(long, curve, number - 1.0, space)
    for edge in range(0, piece.table.bins + 1, long.waves.per):
        if slope_at(piece, edge) >= 0.0:
            return False
    if first < 1 or count <= others:
        return False
    out[:] = 0.0
    if outwards:
        top = highest_end(trace, 0, first)
        trace[at.LOADED, top] = trace[at.LOADING_JUMPS, top] = 0.0
        visited[0], visits = top, count - count + 1
        visits = walk_on(piece, trace, first, count, visited, visits, end_state(trace, top))
        last = visited[visits - 1]
        if last < others:
            return False
        out[OUTWARDS], out[JUMPS_OUTWARDS] = trace[at.LOADED, last], trace[at.LOADING_JUMPS, last]
        if long.contact and not jumps_are_open(long, piece, space, visits, trace[at.LANDING, last]):
            out[SHUT] = 1.0
    if inwards:
        low, inner = lowest_start(trace, others, count), lowest_start(trace, 0, first)
        if trace[at.START_LEVEL, inner] >= trace[at.START_LEVEL, low]:
            return False
        trace[at.UNLOADED, inner], trace[at.UNLOADING_JUMPS, inner], trace[at.LAST, inner] = 0.0, 0.0, inner
        fill_unloading(piece, trace, low, space.stack)
        if trace[at.LAST, low] != inner:  # bottoms that differ by rounding: it leaves contact
            return False
        out[INWARDS], out[JUMPS_INWARDS] = trace[at.UNLOADED, low], trace[at.UNLOADING_JUMPS, low]
    return True


@inlined
def _panel(
    long: Long, curve: Curve, first: int, count: int, outwards: bool, inwards: bool, values: Floats, sums: Floats
) -> bool:
    """Put the sums of what some waves lose into `sums` (LOSSES,); return whether it is smooth.

    The first and the last wave are looked at themselves, before all others, for there the jumps differ most. `values`
    is room, (GAUSS + 2, LOSSES).
    """
    places, weights, last = np.empty(GAUSS), np.empty(GAUSS), np.empty((2, GAUSS))
    fill_rule(count - 2.0, places, weights, last)
    for i in range(-2, GAUSS):
        place = places[i] + 1.0 if i >= 0 else 0.0 if i == -1 else count - 1.0
        own = values[i + 2]
        if not _losses(long, curve, first + place, long.scratch, outwards, inwards, own):
            return False
        out, back = own[JUMPS_OUTWARDS], own[JUMPS_INWARDS]
        if out != values[0, JUMPS_OUTWARDS] or back != values[0, JUMPS_INWARDS]:
            return False
    for row in range(LOSSES):
        total = miss = other = 0.0
        for i in range(GAUSS):
            total += weights[i] * values[i + 2, row]
            miss += last[0, i] * values[i + 2, row]
            other += last[1, i] * values[i + 2, row]
        if row <= INWARDS and abs(miss) + abs(other) > _SMOOTH * abs(total):
            return False
        sums[row] = total + values[0, row] + values[1, row]
    sums[JUMPS_OUTWARDS], sums[JUMPS_INWARDS] = count * values[0, JUMPS_OUTWARDS], count * values[0, JUMPS_INWARDS]
    return True


@allocating
def sum_waves(long: Long, curve: Curve, out: int, back: int, last: int, folds: int, total: Floats) -> bool:
    """Add what the waves up to `last` lose to `total` (LOSSES,), outwards those after wave `out`, inwards after `back`.

    Return whether they are regular. Losses are not smooth next to where the bottoms are lowest and next to the end of
    `folds`: panels are _LONG times as long as their distance from these, and halved where that proves too long.
    """
    values, part = np.empty((GAUSS + 2, LOSSES)), np.empty(LOSSES)
    lowest = back - 1.0
    if back == long.near:  # it may be anywhere below
        lowest = min(lowest, 1.1 * guess(long, Sought(BOTTOM, curve, 0.0, curve)) + 1.0)
    outer = folds - 1.0 if folds < long.most else 1e300
    left, longest, walked = min(out, back) + 1, 1e300, 0
    while left <= last:
        outwards, inwards = left > out, left > back
        inner = max(lowest, 0.5 * left) if inwards else 0.5 * left
        if long.near > NEAR:  # folds have just begun
            inner = max(inner, float(long.near - BORN))
        ahead = min(last + 1.0, 1.0 + (out if out >= left else back if back >= left else last)) - left
        count = int(min(_LONG * (left - inner), (outer - left) * _LONG / (1.0 + _LONG), longest, ahead))
        if count > 2 * GAUSS + 2:
            if not _panel(long, curve, left, count, outwards, inwards, values, part):
                longest = 0.5 * count
                continue
            for row in range(LOSSES):
                total[row] += part[row]
        else:
            count = int(min(max(count, 1.0), ahead))
            walked += count
            if walked > _MOST_WALKED:
                return False
            number = left
            while number < left + count:
                several = number + _AT_ONCE <= left + count
                space = long.ends if several else long.scratch
                if not _losses(long, curve, float(number), space, outwards, inwards, part):
                    return False
                for row in range(LOSSES):
                    total[row] += part[row]
                number += _AT_ONCE if several else 1
        left += count
        longest *= 2.0
    return True
