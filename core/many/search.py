"""Waves of a curve one at a time, and the first of them at which something begins or ends."""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.folds import scan
from gradhesion.core.curve.trace import room_for
from gradhesion.core.curve.values import Curve, coordinate_at, coordinate_of, depth_and_load, slope_at, softness
from gradhesion.core.cycle.disc import Disc
from gradhesion.core.cycle.path import end_state, walk_on
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.jit import inlined, kernel, leaf
from gradhesion.core.many.waves import Waves, fill_from_zero, wave_of, waves_from
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.layout import Table
from gradhesion.core.types import Floats, Integers

NEAR: Final = 24
"""The last wave next to the centre that is walked in any case."""
MOST: Final = 1_000_000
"""Waves within the contact, at most."""
BORN: Final = 3
"""Waves from the first that may have folds on that are walked before others are summed."""

FOLDS, BIRTH, LEVEL, BOTTOM, TURN = range(5)
"""What is looked for over waves: the end of folds, or, where waves win over the power, their beginning; a level that is
reached; the lowest bottom; where a cycle turns."""


class Space(NamedTuple):
    """Room for a few waves: their table, their branches, those of what is measured, and lists of columns."""

    nodes: Floats
    polys: Floats
    trace: Floats
    measured: Floats
    visited: Integers
    stack: Integers


def space_for(bins: int) -> Space:
    """Return room for that many bins."""
    columns = [np.empty(bins + 8, dtype=np.int64) for _ in range(2)]
    return Space(*room_of(bins), room_for(bins), room_for(bins), *columns)


class Long(NamedTuple):
    """What long curves of one exponent are walked with.

    table     from 0 to beyond wave `near`
    waves     those of the table
    near      the last wave next to the centre, NEAR or more
    most      the first wave that is not looked at
    disc      what the tests of the contact need
    contact   whether they are wanted
    start, scratch, window, ends   room: for the table; for two waves that are looked at; for three that are walked; for
              five at the end
    """

    table: Table
    waves: Waves
    near: int
    most: int
    disc: Disc
    contact: bool
    start: Space
    scratch: Space
    window: Space
    ends: Space


class Sought(NamedTuple):
    """What is looked for over the waves of a curve: see FOLDS; the level; and what is measured where a cycle turns."""

    what: int
    curve: Curve
    level: float
    measured: Curve


@leaf
def on(curve: Curve, table: Table) -> Curve:
    """Return the same curve on another table."""
    return Curve(table, curve.B, curve.g, curve.by_depth, curve.by_load)


@kernel
def trace_branches(curve: Curve, per: int, trace: Floats) -> tuple[int, int, int]:
    """Trace a few waves; return how many branches begin in the first, in all but the last, and in all of them.

    A branch that comes from below them begins where they do.
    """
    first = others = count = 0
    trace[at.CLOSE_PAIR, 0] = math.inf
    if slope_at(curve, 0) > 0.0:
        depth, load = depth_and_load(curve, 0, -1.0)
        trace[at.START, 0], trace[at.START_DEPTH, 0], trace[at.START_LOAD, 0] = curve.table.start, depth, load
        trace[at.START_LEVEL, 0] = coordinate_of(curve, depth, load)
        trace[at.END, 0] = trace[at.END_LEVEL, 0] = math.inf
        trace[at.UNLOADED, 0] = math.nan
        count = 1
    waves = curve.table.bins // per
    for wave in range(waves):
        others = count
        count, _ = scan(curve, wave * per, (wave + 1) * per, count, trace)
        if wave == 0:
            first = count
    return first, others, count


@kernel
def trace_waves(long: Long, curve: Curve, number: float, space: Space) -> tuple[Curve, int, int, int]:
    """Fill a space with the waves from one on, and trace them; return their curve and what `trace_branches` returns."""
    piece = on(curve, waves_from(long.waves, number, space.nodes, space.polys))
    first, second, count = trace_branches(piece, long.waves.per, space.trace)
    return piece, first, second, count


@kernel
def from_zero(long: Long, number: int, space: Space) -> None:
    """Let the table in a space, which begins at a wave, know the integrals from 0 to there."""
    fill_from_zero(long.waves, number, long.scratch.nodes, long.scratch.polys, space.nodes)


@kernel
def highest_end(trace: Floats, first: int, last: int) -> int:
    """Return the branch that ends highest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[at.END_LEVEL, j] > trace[at.END_LEVEL, best] else best
    return best


@kernel
def lowest_start(trace: Floats, first: int, last: int) -> int:
    """Return the branch that starts lowest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[at.START_LEVEL, j] < trace[at.START_LEVEL, best] else best
    return best


@kernel
def turning_in(long: Long, own: Curve, target: float, table: Table, space: Space, visits: int) -> tuple[float, int]:
    """Return where loading, which visits branches of a piece, first reaches a target, inf if nowhere.

    And the number of branches of its `own` curve, that of the target, whose trace is filled.
    """
    curve = on(own, table)
    rising = trace_branches(curve, long.waves.per, space.measured)[2]
    return turning_radius(curve, target, space.trace, space.visited, visits, space.measured, rising), rising


@kernel
def turn_in(long: Long, sought: Sought, number: int) -> float:
    """Return where loading along a wave first reaches the level of what is measured, inf if it does not."""
    space = long.scratch
    trace, visited = space.trace, space.visited
    curve, first, _, count = trace_waves(long, sought.curve, number - 1.0, space)
    if first == 0:
        return math.inf
    top = highest_end(trace, 0, first)
    trace[at.LANDING, top], trace[at.LOADED, top], trace[at.LOADING_JUMPS, top] = trace[at.START, top], 0.0, 0.0
    visited[0], visits = top, count - count + 1
    visits = walk_on(curve, trace, top + 1, count, visited, visits, end_state(trace, top))
    return turning_in(long, sought.measured, sought.level, curve.table, space, visits)[0]


@inlined
def _is_past(long: Long, sought: Sought, number: int) -> bool:
    """Return whether a wave is at what is looked for, or past it."""
    trace, per = long.scratch.trace, long.waves.per
    if sought.what == TURN:
        return turn_in(long, sought, number) < math.inf
    if sought.what <= BIRTH:
        table = waves_from(long.waves, float(number), long.scratch.nodes, long.scratch.polys)
        return (slope_at(on(sought.curve, table), 0) < 0.0) == (sought.what == BIRTH)
    curve, first, _, count = trace_waves(long, sought.curve, float(number), long.scratch)
    if sought.what == BOTTOM:
        own = trace[at.START_LEVEL, lowest_start(trace, 0, first)] if first > 0 else math.inf
        after = trace[at.START_LEVEL, lowest_start(trace, first, count)] if count > first else math.inf
        return slope_at(curve, 0) >= 0.0 or after > own
    top = coordinate_at(curve, per) if slope_at(curve, per) >= 0.0 else -math.inf
    for j in range(first):
        top = (
            max(top, trace[at.END_LEVEL, j]) if trace[at.END, j] < curve.table.start + per * curve.table.width else top
        )
    return top > sought.level


@kernel
def first_wave(long: Long, sought: Sought, low: int, high: int) -> int:
    """Return the first wave from `low` on that is past what is looked for, `high` if none below is.

    From a guess on in steps that are doubled until it lies between, and then by bisection.
    """
    before, past, step = low - 1, high, 1
    tried = int(max(min(guess(long, sought), high - 1.0), float(low)))
    while past - before > 1:
        if _is_past(long, sought, tried):
            past = tried
        else:
            before = tried
        if past < high and before >= low:
            tried = (past + before) // 2
        else:
            tried = max(past - step, low) if past < high else min(before + step, high - 1)
            step *= 2
    return past


@kernel
def guess(long: Long, sought: Sought) -> float:
    """Return about which wave is looked for, by the envelopes of waves whose crests and troughs are alike."""
    waves, curve = long.waves, sought.measured
    k, m, eta = waves.k, waves.exponent, 0.5 * (1.0 - waves.k)
    crest = 1.0 - curve.g * waves.lowest
    if sought.what <= BIRTH:
        power = m - 1.0 - eta
        steep = curve.g * waves.steepest / (curve.B * m)
        return wave_of(waves, steep ** (1.0 / power)) if power != 0.0 else 1e300
    y = 1.0
    if sought.what == BOTTOM:  # through a machine there may be two: from outside to the outer one
        y = ((eta + 1.0 + k) * crest / (curve.B * m)) ** (1.0 / (m - eta))
    for _ in range(6):
        y = max(y, 1.0)  # the envelope has no meaning within a wave
        weight = softness(curve, y ** (1.0 + k))
        share = 1.0 - curve.by_depth / weight  # of the load in what is prescribed
        if sought.what == BOTTOM:
            y = ((eta + (1.0 + k) * share) * crest / (curve.B * m)) ** (1.0 / (m - eta))
        else:
            size = curve.B * (1.0 - waves.share * share)
            y = (max(2.0 - crest, 0.0) / size) ** (1.0 / (m - eta))
            y = max(y, (max(sought.level, 0.0) / (weight * size)) ** (1.0 / m))
    return wave_of(waves, y)


@kernel
def end_of_folds(long: Long, curve: Curve) -> int:
    """Return the first wave that begins on the endless branch, next to the last folds; long.most if there is none."""
    if long.waves.exponent - 1.0 < 0.5 * (1.0 - long.waves.k):  # waves win over the power
        return long.most
    return first_wave(long, Sought(FOLDS, curve, 0.0, curve), long.near + 1, long.most)


@inlined
def from_birth(long: Long, curve: Curve) -> Long:
    """Return the same with more waves next to the centre where folds begin only beyond them: a curve of low power."""
    near = long.near
    if long.waves.exponent - 1.0 < 0.5 * (1.0 - long.waves.k):
        near = max(near, BORN + first_wave(long, Sought(BIRTH, curve, 0.0, curve), near, long.most))
    return with_limits(long, near, long.most)


@leaf
def with_limits(long: Long, near: int, most: int) -> Long:
    """Return the same from one wave to another, its `near` and `most`."""
    return Long(
        long.table, long.waves, near, most, long.disc, long.contact, long.start, long.scratch, long.window, long.ends
    )
