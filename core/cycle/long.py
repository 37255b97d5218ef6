"""Cycles of more waves than are walked: what a wave loses is a smooth function of its number.

Loading and unloading are walked where something begins or ends: over the waves next to the centre, where the jump-in
lands, where unloading leaves contact, and at the rim or the last folds. What the waves between lose is sampled and
summed (waves.py); they are walked one by one where it is not smooth. Jumps across waves that are not summed lose a form
of integrals from the centre, which are known at every wave.

Every wave reaches higher than those before it from the landing of the jump-in on, and dips less deep than the one
outside it up to where unloading leaves contact: both are looked for by bisection.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.energy import energy_between, jump_energy
from gradhesion.core.curve.folds import find_folds, scan
from gradhesion.core.curve.levels import BEYOND, at_level
from gradhesion.core.curve.levels import LANDING as ACCURACY
from gradhesion.core.curve.trace import (
    CLOSE_PAIR,
    END,
    END_LEVEL,
    LANDING,
    LAST,
    LOADED,
    LOADING_JUMPS,
    START,
    START_DEPTH,
    START_LEVEL,
    START_LOAD,
    UNLOADED,
    UNLOADING_JUMPS,
    room_for,
)
from gradhesion.core.curve.values import (
    Curve,
    coordinate_at,
    coordinate_of,
    depth_and_load,
    load_curve,
    place_of,
    slope_at,
    softness,
    state_in,
)
from gradhesion.core.cycle.disc import Disc, gap_is_open, loading_is_one_disc
from gradhesion.core.cycle.path import (
    Loaded,
    State,
    Unloaded,
    end_state,
    fill_unloading,
    inner_branch,
    load_to,
    snap_in,
    start_state,
    started_within,
    unload_from,
    visited_within,
    walk_loading,
    walk_on,
)
from gradhesion.core.cycle.pull_off import Lowest, deeper
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, target_is_tied, unloading_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.cycle.waves import GAUSS, Waves, fill_from_zero, fill_rule, start_of, wave_of, waves_from
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.layout import Table, end_of
from gradhesion.core.types import Floats, Integers

NEAR: Final = 24
"""The last wave next to the centre that is walked in any case."""
MOST: Final = 1_000_000
"""Waves within the contact, at most."""
_BORN: Final = 3
"""Waves from the first that may have folds on that are walked before others are summed."""
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


class Loading(NamedTuple):
    """How loading begins.

    wave      the wave up to whose top it is known, or to which it jumps
    landed    whether it is known up to there
    state     where it jumps from: a top next to the centre, or no contact
    lost, jumps   by then
    below     the energy below that state, at its depth
    snap      the pull after the jump-in
    last      the last landing by then, inf if there was none
    one_disc, tied   of its jumps and decisions
    """

    wave: int
    landed: bool
    state: State
    lost: float
    jumps: float
    below: float
    snap: float
    last: float
    one_disc: bool
    tied: bool


class Leaving(NamedTuple):
    """How unloading ends: from the lowest bottom of a wave on.

    wave      that wave, or one beyond those that were looked at
    lost, jumps   from there on
    depth     at which contact ends
    tied      whether a decision is close
    """

    wave: int
    lost: float
    jumps: float
    depth: float
    tied: bool


class Looped(NamedTuple):
    """A cycle up to a rim, as path.py has it.

    reach   where loading lands last
    snap    the pull after the jump-in
    """

    loaded: Loaded
    unloaded: Unloaded
    reach: float
    snap: float
    one_disc: bool
    tied: bool


@leaf
def on(curve: Curve, table: Table) -> Curve:
    """Return the same curve on another table."""
    return Curve(table, curve.B, curve.g, curve.by_depth, curve.by_load)


@kernel
def _trace(curve: Curve, per: int, trace: Floats) -> tuple[int, int, int]:
    """Trace a few waves; return how many branches begin in the first, in all but the last, and in all of them.

    A branch that comes from below them begins where they do.
    """
    first = others = count = 0
    trace[CLOSE_PAIR, 0] = math.inf
    if slope_at(curve, 0) > 0.0:
        depth, load = depth_and_load(curve, 0, -1.0)
        trace[START, 0], trace[START_DEPTH, 0], trace[START_LOAD, 0] = curve.table.start, depth, load
        trace[START_LEVEL, 0] = coordinate_of(curve, depth, load)
        trace[END, 0] = trace[END_LEVEL, 0] = math.inf
        trace[UNLOADED, 0] = math.nan
        count = 1
    waves = curve.table.bins // per
    for wave in range(waves):
        others = count
        count, _ = scan(curve, wave * per, (wave + 1) * per, count, trace)
        if wave == 0:
            first = count
    return first, others, count


@kernel
def _trace_waves(long: Long, curve: Curve, number: float, space: Space) -> tuple[Curve, int, int, int]:
    """Fill a space with the waves from one on, and trace them; return the curve on them, and what `_trace` returns."""
    piece = on(curve, waves_from(long.waves, number, space.nodes, space.polys))
    first, second, count = _trace(piece, long.waves.per, space.trace)
    return piece, first, second, count


@kernel
def _from_zero(long: Long, number: int, space: Space) -> None:
    """Let the table in a space, which begins at a wave, know the integrals from 0 to there."""
    fill_from_zero(long.waves, number, long.scratch.nodes, long.scratch.polys, space.nodes)


@kernel
def _highest(trace: Floats, first: int, last: int) -> int:
    """Return the branch that ends highest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[END_LEVEL, j] > trace[END_LEVEL, best] else best
    return best


@kernel
def _lowest(trace: Floats, first: int, last: int) -> int:
    """Return the branch that starts lowest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[START_LEVEL, j] < trace[START_LEVEL, best] else best
    return best


@kernel
def _turn_in(long: Long, sought: Sought, number: int) -> float:
    """Return where loading along a wave first reaches the level of what is measured, inf if it does not."""
    space = long.scratch
    trace, visited = space.trace, space.visited
    curve, first, _, count = _trace_waves(long, sought.curve, number - 1.0, space)
    if first == 0:
        return math.inf
    top = _highest(trace, 0, first)
    trace[LANDING, top], trace[LOADED, top], trace[LOADING_JUMPS, top] = trace[START, top], 0.0, 0.0
    visited[0], visits = top, count - count + 1
    visits = walk_on(curve, trace, top + 1, count, visited, visits, end_state(trace, top))
    measured = on(sought.measured, curve.table)
    rising = _trace(measured, long.waves.per, space.measured)[2]
    return turning_radius(measured, sought.level, trace, visited, visits, space.measured, rising)


@kernel
def _is_past(long: Long, sought: Sought, number: int) -> bool:
    """Return whether a wave is at what is looked for, or past it."""
    trace, per = long.scratch.trace, long.waves.per
    if sought.what == TURN:
        return _turn_in(long, sought, number) < math.inf
    if sought.what <= BIRTH:
        table = waves_from(long.waves, float(number), long.scratch.nodes, long.scratch.polys)
        return (slope_at(on(sought.curve, table), 0) < 0.0) == (sought.what == BIRTH)
    curve, first, _, count = _trace_waves(long, sought.curve, float(number), long.scratch)
    if sought.what == BOTTOM:
        own = trace[START_LEVEL, _lowest(trace, 0, first)] if first > 0 else math.inf
        after = trace[START_LEVEL, _lowest(trace, first, count)] if count > first else math.inf
        return slope_at(curve, 0) >= 0.0 or after > own
    top = coordinate_at(curve, per) if slope_at(curve, per) >= 0.0 else -math.inf
    for j in range(first):
        top = max(top, trace[END_LEVEL, j]) if trace[END, j] < curve.table.start + per * curve.table.width else top
    return top > sought.level


@kernel
def _first_wave(long: Long, sought: Sought, low: int, high: int) -> int:
    """Return the first wave from `low` on that is past what is looked for, `high` if none below is.

    From a guess on in steps that are doubled until it lies between, and then by bisection.
    """
    before, past, step = low - 1, high, 1
    at = int(max(min(_guess(long, sought), high - 1.0), float(low)))
    while past - before > 1:
        if _is_past(long, sought, at):
            past = at
        else:
            before = at
        if past < high and before >= low:
            at = (past + before) // 2
        else:
            at = max(past - step, low) if past < high else min(before + step, high - 1)
            step *= 2
    return past


@kernel
def _guess(long: Long, sought: Sought) -> float:
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
    return _first_wave(long, Sought(FOLDS, curve, 0.0, curve), long.near + 1, long.most)


@kernel
def from_birth(long: Long, curve: Curve) -> Long:
    """Return the same with more waves next to the centre where folds begin only beyond them: a curve of low power."""
    near = long.near
    if long.waves.exponent - 1.0 < 0.5 * (1.0 - long.waves.k):
        near = max(near, _BORN + _first_wave(long, Sought(BIRTH, curve, 0.0, curve), near, long.most))
    return Long(
        long.table,
        long.waves,
        near,
        long.most,
        long.disc,
        long.contact,
        long.start,
        long.scratch,
        long.window,
        long.ends,
    )


@kernel
def _jumps_are_open(long: Long, curve: Curve, space: Space, visits: int, rim: float) -> bool:
    """Return whether the contact is one disc during all jumps between visited branches, and from them to a rim."""
    for v in range(1, visits + 1):
        state = end_state(space.trace, space.visited[v - 1])
        if state.y >= rim:
            return True
        landing = min(rim, space.trace[LANDING, space.visited[v]] if v < visits else rim)
        if not gap_is_open(curve, long.disc, state.y, state.depth, landing):
            return False
    return True


@kernel
def _losses(long: Long, curve: Curve, number: float, space: Space, outwards: bool, inwards: bool, out: Floats) -> bool:
    """Put what some waves lose into `out` (LOSSES,), on the ways that are asked for; return whether they are regular.

    They are those from `number` on that a space holds besides the one before.
    """
    trace, visited = space.trace, space.visited
    piece, first, others, count = _trace_waves(long, curve, number - 1.0, space)
    for edge in range(0, piece.table.bins + 1, long.waves.per):
        if slope_at(piece, edge) >= 0.0:
            return False
    if first < 1 or count <= others:
        return False
    out[:] = 0.0
    if outwards:
        top = _highest(trace, 0, first)
        trace[LOADED, top] = trace[LOADING_JUMPS, top] = 0.0
        visited[0], visits = top, count - count + 1
        visits = walk_on(piece, trace, first, count, visited, visits, end_state(trace, top))
        last = visited[visits - 1]
        if last < others:
            return False
        out[OUTWARDS], out[JUMPS_OUTWARDS] = trace[LOADED, last], trace[LOADING_JUMPS, last]
        if long.contact and not _jumps_are_open(long, piece, space, visits, trace[LANDING, last]):
            out[SHUT] = 1.0
    if inwards:
        low, inner = _lowest(trace, others, count), _lowest(trace, 0, first)
        if trace[START_LEVEL, inner] >= trace[START_LEVEL, low]:
            return False
        trace[UNLOADED, inner] = trace[UNLOADING_JUMPS, inner] = 0.0
        fill_unloading(piece, trace, low, space.stack)
        out[INWARDS], out[JUMPS_INWARDS] = trace[UNLOADED, low], trace[UNLOADING_JUMPS, low]
    return True


@kernel
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


@kernel
def _sum_waves(long: Long, curve: Curve, out: int, back: int, last: int, folds: int, total: Floats) -> bool:
    """Add what the waves up to `last` lose to `total` (LOSSES,), outwards those after wave `out`, inwards after `back`.

    Return whether they are regular. Losses are not smooth next to where the bottoms are lowest and next to the end of
    `folds`: panels are _LONG times as long as their distance from these, and halved where that proves too long.
    """
    values, part = np.empty((GAUSS + 2, LOSSES)), np.empty(LOSSES)
    lowest = back - 1.0
    if back == long.near:  # it may be anywhere below
        lowest = min(lowest, 1.1 * _guess(long, Sought(BOTTOM, curve, 0.0, curve)) + 1.0)
    outer = folds - 1.0 if folds < long.most else 1e300
    left, longest, walked = min(out, back) + 1, 1e300, 0
    while left <= last:
        outwards, inwards = left > out, left > back
        inner = max(lowest, 0.5 * left) if inwards else 0.5 * left
        if long.near > NEAR:  # folds have just begun
            inner = max(inner, float(long.near - _BORN))
        ahead = min(last + 1.0, 1.0 + (out if out >= left else back if back >= left else last)) - left
        count = int(min(_LONG * (left - inner), (outer - left) * _LONG / (1.0 + _LONG), longest, ahead))
        if count > 2 * GAUSS + 2:
            if not _panel(long, curve, left, count, outwards, inwards, values, part):
                longest = 0.5 * count
                continue
            total += part
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
                total += part
                number += _AT_ONCE if several else 1
        left += count
        longest *= 2.0
    return True


@kernel
def begin(long: Long, curve: Curve, folds: int) -> tuple[Loading, int]:
    """Let loading go over the waves next to the centre, and find the wave to which it jumps from there.

    Return that, and the number of branches there; `folds` is that of `end_of_folds`.
    """
    space, start, near = long.start, on(curve, long.table), start_of(long.waves, float(long.near))
    trace, visited = space.trace, space.visited
    y_end = start_of(long.waves, long.near + 1.0) - 0.5 * long.waves.width
    count = find_folds(start, y_end, trace)
    if count > 0 and folds <= long.near + 1:
        trace[END, count - 1] = trace[END_LEVEL, count - 1] = math.inf
    visits = walk_loading(start, trace, count, visited)
    state, lost, jumps, below, snap, last = State(0.0, 0.0, 0.0), 0.0, 0.0, 0.0, 0.0, math.inf
    if visits > 0:
        j = visited[visits - 1]
        state, lost, jumps = end_state(trace, j), trace[LOADED, j], trace[LOADING_JUMPS, j]
        snap, last = snap_in(start, trace[LANDING, visited[0]]), trace[LANDING, j]
    tied = loading_is_tied(start, y_end, False, trace, count)
    one_disc = True
    if long.contact:
        limits, end = np.array([0.0, -1.0]), near if state.y < near else last
        one_disc = loading_is_one_disc(start, long.disc, trace, visited, visits, end, limits)
    if state.y > near:
        return Loading(long.near, True, state, lost, jumps, 0.0, snap, last, one_disc, tied), count
    if visits > 0:
        below = energy_between(start, state.depth, 0.0, state.y)
    level = coordinate_of(curve, state.depth, state.load)
    wave = _first_wave(long, Sought(LEVEL, curve, level, curve), long.near + 1, long.most)
    return Loading(wave, False, state, lost, jumps, below, snap, last, one_disc, tied), count


@kernel
def land(long: Long, curve: Curve, before: Loading) -> tuple[Loading, int]:
    """Let loading jump to its first wave; return how it stands there, and how many branches it visits in `window`."""
    space = long.window
    trace, visited = space.trace, space.visited
    piece, _, _, count = _trace_waves(long, curve, before.wave - 2.0, space)
    _from_zero(long, before.wave - 2, space)
    none = count - count
    visits = walk_on(piece, trace, none, count, visited, none, State(0.0, before.state.depth, before.state.load))
    if visits == 0:
        return before, visits
    j = visited[visits - 1]
    one_disc = before.one_disc and (not long.contact or _jumps_are_open(long, piece, space, visits, trace[LANDING, j]))
    tied = before.tied or loading_is_tied(piece, end_of(piece.table), False, trace, count)
    lost, jumps = before.lost + trace[LOADED, j] - before.below, before.jumps + trace[LOADING_JUMPS, j]
    snap = snap_in(piece, trace[LANDING, visited[0]]) if before.jumps == 0.0 else before.snap
    return Loading(
        before.wave, True, end_state(trace, j), lost, jumps, 0.0, snap, trace[LANDING, j], one_disc, tied
    ), visits


@kernel
def _leave_far(long: Long, curve: Curve, state: State, starts: int) -> Unloaded:
    """Return what unloading loses from a state on that jumps to a branch next to the centre, or out of contact.

    `curve` stands on waves that know the integrals from 0; `starts` branches are traced next to the centre. The loss is
    inf, for unknown, if waves between may be lower as well (a cone in a soft machine).
    """
    trace, level = long.start.trace, coordinate_of(curve, state.depth, state.load)
    j = inner_branch(trace, starts - 1, level)
    if j < 0:
        dead = curve.by_depth == 0.0  # a dead load falls without end: its jump-out is left out
        lost = 0.0 if dead else jump_energy(curve, state.y, state.depth, state.load, 0.0)
        return Unloaded(lost, 1.0, state.depth)
    if trace[START, j] > start_of(long.waves, float(long.near)):
        return Unloaded(math.inf, 0.0, 0.0)
    start = on(curve, long.table)
    landing = at_level(start, level, trace[START, j], trace[END, j], ACCURACY)
    lost = jump_energy(start, 0.0, state.depth, state.load, landing) - energy_between(curve, state.depth, 0.0, state.y)
    fill_unloading(start, trace, j, long.start.stack)
    last = trace[START_DEPTH, int(trace[LAST, j])]
    return Unloaded(lost + trace[UNLOADED, j], 1.0 + trace[UNLOADING_JUMPS, j], last)


@kernel
def leave(long: Long, curve: Curve, starts: int, last: int) -> Leaving:
    """Find the wave of the lowest bottom, and what unloading loses from there on, if it is no later than `last`."""
    wave = _first_wave(long, Sought(BOTTOM, curve, 0.0, curve), long.near, last + 1)
    if wave > last:
        return Leaving(wave, 0.0, 0.0, 0.0, False)
    if wave == long.near:
        start, trace = on(curve, long.table), long.start.trace
        first = started_within(trace, starts, start_of(long.waves, float(wave)))
        low = _lowest(trace, first, starts) if first < starts else starts - 1
        fill_unloading(start, trace, low, long.start.stack)
        tied = unloading_is_tied(start, trace[START, low], trace, starts)
        depth = trace[START_DEPTH, int(trace[LAST, low])]
        return Leaving(wave, trace[UNLOADED, low], trace[UNLOADING_JUMPS, low], depth, tied)
    space = long.window
    piece, first, others, count = _trace_waves(long, curve, wave - 1.0, space)
    _from_zero(long, wave - 1, space)
    after = space.trace[START, _lowest(space.trace, others, count)]
    tied = unloading_is_tied(piece, after, space.trace, count)
    left = _leave_far(long, piece, start_state(space.trace, _lowest(space.trace, first, others)), starts)
    return Leaving(wave, left.lost, left.jumps, left.last, tied)


@kernel
def _far_landing(long: Long, curve: Curve, before: Loading, rim: float) -> tuple[Loaded, Loading]:
    """Return what loading loses that jumps to the endless branch far out, or to the rim, and how it stands there.

    It lands no earlier than in wave before.wave.
    """
    state, space = before.state, long.window
    level = coordinate_of(curve, state.depth, state.load)
    wave = _first_wave(long, Sought(LEVEL, curve, level, curve), before.wave, long.most)
    at_rim = float(wave) > wave_of(long.waves, rim)
    if at_rim:
        wave = int(wave_of(long.waves, rim))
    elif wave == long.most:
        return Loaded(0.0, 0.0, 0.0, False, False), before
    piece = on(curve, waves_from(long.waves, float(wave), space.nodes, space.polys))
    _from_zero(long, wave, space)
    landing = BEYOND if at_rim else at_level(piece, level, piece.table.start, math.inf, ACCURACY)
    at_rim = landing == BEYOND or landing > rim
    landing, deepest = rim if at_rim else landing, math.inf
    if at_rim:
        deepest, load = state_in(piece, rim)
        fall = level - coordinate_of(curve, deepest, load)
        deepest += fall / softness(curve, rim ** (1.0 + curve.table.k))
    lost, jumps = (
        before.lost + jump_energy(piece, 0.0, state.depth, state.load, landing) - before.below,
        before.jumps + 1.0,
    )
    first = before.jumps == 0.0
    snap, last = snap_in(piece, landing) if first else before.snap, landing if first or not at_rim else before.last
    loaded = Loaded(lost, jumps, deepest, at_rim and first, True)
    return loaded, Loading(wave, True, state, lost, jumps, 0.0, snap, last, before.one_disc, before.tied)


@kernel
def finish_loading(
    long: Long, piece: Curve, count: int, before: Loading, last: int, rim: float, edge: float
) -> tuple[Loaded, Loading]:
    """Let loading go over the `count` branches at the end, up to a rim; return what it loses, and how it stands there.

    `before` has what is lost by the top of wave `last`, the first one in `ends`, if it has landed by then. `edge` is
    the rim of the punch.
    """
    space = long.ends
    trace, visited = space.trace, space.visited
    if before.landed:
        top = _highest(trace, 0, started_within(trace, count, start_of(long.waves, last + 1.0)))
        trace[LANDING, top] = min(before.last, trace[START, top])
        trace[LOADED, top], trace[LOADING_JUMPS, top] = before.lost, before.jumps
        visited[0], visits = top, count - count + 1
        visits = walk_on(piece, trace, top + 1, count, visited, visits, end_state(trace, top))
    else:
        none = count - count
        visits = walk_on(piece, trace, none, count, visited, none, State(0.0, before.state.depth, before.state.load))
        for v in range(visits):
            trace[LOADED, visited[v]] += before.lost - before.below
            trace[LOADING_JUMPS, visited[v]] += before.jumps
    n = visited_within(trace, visited, visits, rim)
    one_disc = before.one_disc and (not long.contact or _jumps_are_open(long, piece, space, n, rim))
    if long.contact and one_disc and rim < edge and rim < end_of(piece.table):
        one_disc = gap_is_open(piece, long.disc, rim, state_in(piece, rim)[0], min(edge, end_of(piece.table)))
    tied = before.tied or rim_is_tied(piece, rim) or loading_is_tied(piece, rim, rim >= edge, trace, count)
    state, lost, jumps, below, snap, landing = (
        before.state,
        before.lost,
        before.jumps,
        before.below,
        before.snap,
        before.last,
    )
    if n > 0:
        j = visited[n - 1]
        state, lost, jumps, landing = end_state(trace, j), trace[LOADED, j], trace[LOADING_JUMPS, j], trace[LANDING, j]
        snap = snap if before.jumps > 0.0 else snap_in(piece, trace[LANDING, visited[0]])
    loaded = load_to(piece, rim, trace, visited, visits)
    if loaded.known and n > 0:
        # on the endless branch; the depth at a rim there is left to who knows it beside any other scenes
        if loaded.deepest == math.inf and rim < edge and wave_of(long.waves, rim) < long.most:
            table = waves_from(long.waves, float(int(wave_of(long.waves, rim))), long.window.nodes, long.window.polys)
            depth, _ = state_in(on(piece, table), rim)
            loaded = Loaded(loaded.lost, loaded.jumps, depth, loaded.in_to_rim, True)
        return loaded, Loading(last, True, state, lost, jumps, 0.0, snap, landing, one_disc, tied)
    if n > 0:
        _from_zero(long, last, space)
        below = energy_between(piece, state.depth, 0.0, state.y)
    return _far_landing(
        long, piece, Loading(last, False, state, lost, jumps, below, snap, landing, one_disc, tied), rim
    )


@kernel
def finish_unloading(
    long: Long, piece: Curve, count: int, after: Leaving, starts: int, last: int, rim: float
) -> tuple[Unloaded, bool]:
    """Let unloading go from a rim over the `count` branches at the end; return what it loses, and if that is close.

    `after` has what is lost from the bottom of wave `last` on, the first one in `ends`, if it leaves no later.
    """
    space = long.ends
    trace, within = space.trace, started_within(space.trace, count, rim)
    tied = after.tied or unloading_is_tied(piece, rim, trace, count)
    left = Unloaded(after.lost, after.jumps, after.depth)
    if after.wave <= last:
        low = _lowest(trace, 0, started_within(trace, count, start_of(long.waves, last + 1.0)))
    else:
        low = _lowest(trace, 0, max(within, 1))
        if within > 0:
            left = _leave_far(long, piece, start_state(trace, low), starts)
    trace[UNLOADED, low], trace[UNLOADING_JUMPS, low], trace[LAST, low] = left.lost, left.jumps, low
    if within == 0 or trace[END, within - 1] < rim:
        depth, load = state_in(piece, rim)
        if inner_branch(trace, within - 1, coordinate_of(piece, depth, load)) < 0:
            return _leave_far(long, piece, State(rim, depth, load), starts), tied
    unloaded = unload_from(piece, rim, trace, count, space.stack)
    return Unloaded(unloaded.lost, unloaded.jumps, left.last), tied


@kernel
def turn_far(
    long: Long, curve: Curve, measured: Curve, target: float, before: Loading, rim: float
) -> tuple[float, bool]:
    """Return where loading first reaches a target of what is measured, a rim at most, and whether that is close.

    0: next to the centre, where waves are walked; inf: not within long.most waves.
    """
    start, space = on(measured, long.table), long.start
    rising = find_folds(start, end_of(long.table), space.measured)
    visits = int(before.jumps)
    found = turning_radius(start, target, space.trace, space.visited, visits, space.measured, rising)
    if found < math.inf:
        return 0.0, False
    space, visits = long.window, 0
    if not before.landed and before.wave < long.most:
        visits = land(long, curve, before)[1]
        piece = on(measured, waves_from(long.waves, before.wave - 2.0, space.nodes, space.polys))
        rising = _trace(piece, long.waves.per, space.measured)[2]
        found = turning_radius(piece, target, space.trace, space.visited, visits, space.measured, rising)
    if found == math.inf:
        high = int(min(float(long.most), wave_of(long.waves, rim) + 1.0))
        sought = Sought(TURN, curve, target, measured)
        wave = _first_wave(long, sought, min(before.wave + 1, high), high)
        if wave == high:
            return rim if high < long.most else math.inf, False
        found = _turn_in(long, sought, wave)
        piece = on(measured, waves_from(long.waves, wave - 1.0, space.nodes, space.polys))
        rising, visits = _trace(piece, long.waves.per, space.measured)[2], 0
    if found < start_of(long.waves, long.near + 2.0):
        return 0.0, False
    tied = target_is_tied(piece, target, found, space.trace, space.visited, visits, space.measured, rising)
    return min(found, rim), tied


@kernel
def lowest_far(long: Long, curve: Curve, rim: float) -> Lowest:
    """Return the lowest load within a rim beyond the waves next to the centre, as `lowest_load` does."""
    curve, space = load_curve(curve), long.window
    high = int(min(float(long.most), wave_of(long.waves, rim)))
    wave = _first_wave(long, Sought(BOTTOM, curve, 0.0, curve), long.near - 1, high)
    if wave >= long.most:
        return Lowest(0.0, 0.0, 0.0, 0.0, False)
    piece, _, _, count = _trace_waves(long, curve, wave - 1.0, space)
    best = Lowest(0.0, 0.0, 0.0, 0.0, True)
    if rim <= end_of(piece.table):
        i, t = place_of(piece.table, rim)
        best = deeper(best, depth_and_load(piece, i, t)[1], rim)
    for j in range(count):
        y = space.trace[START, j]
        if piece.table.start < y <= rim:
            best = deeper(best, space.trace[START_LOAD, j], y)
    return best


@kernel
def last_fold(long: Long, curve: Curve) -> float:
    """Return the radius of the outermost fold, 0 if there is none; NaN: not within long.most waves."""
    folds, trace = end_of_folds(long, curve), long.ends.trace
    if folds == long.most:
        return math.nan
    piece, _, _, count = _trace_waves(long, curve, max(folds - 2.0, float(long.near)), long.ends)
    if count == 0 or trace[START, 0] == piece.table.start:
        trace = long.start.trace
        count = find_folds(on(curve, long.table), start_of(long.waves, long.near + 1.0), trace)
    if count <= 0:
        return 0.0
    return float(trace[END, count - 1] if trace[END, count - 1] < math.inf else trace[START, count - 1])


@kernel
def _end_wave(long: Long, folds: int, rim: float) -> int:
    """Return the wave before the last two of a path, which ends at its rim or on the endless branch."""
    return int(max(min(folds - 1.0, wave_of(long.waves, rim)) - 2.0, float(long.near)))


@kernel
def loop_far(
    long: Long,
    closing: Curve,
    opening: Curve,
    same: bool,
    folds: int,
    begun: Loading,
    starts: int,
    rim: float,
    edge: float,
) -> Looped:
    """Return the cycle up to a rim of a punch that ends at an `edge`; `same`: closing and opening are one curve.

    `folds`, `begun` and `starts` are those of `end_of_folds` and `begin` of closing.
    """
    unknown = Looped(Loaded(0.0, 0.0, 0.0, False, False), Unloaded(0.0, 0.0, 0.0), 0.0, 0.0, True, False)
    last, total = _end_wave(long, folds, rim), np.zeros(LOSSES)
    if last > MOST:
        return unknown
    if not begun.landed and begun.wave <= last:
        begun, _ = land(long, closing, begun)
    left = leave(long, opening, starts, last) if same else Leaving(last + 1, 0.0, 0.0, 0.0, False)
    from_top = begun.wave if begun.landed else last
    if not _sum_waves(long, closing, from_top, min(left.wave, last), last, folds, total):
        return unknown
    if begun.landed:
        one_disc = begun.one_disc and total[SHUT] == 0.0
        lost, jumps = begun.lost + total[OUTWARDS], begun.jumps + total[JUMPS_OUTWARDS]
        begun = Loading(begun.wave, True, begun.state, lost, jumps, 0.0, begun.snap, begun.last, one_disc, begun.tied)
    piece, _, _, count = _trace_waves(long, closing, float(last), long.ends)
    if not begun.landed or left.wave > last:
        _from_zero(long, last, long.ends)
    loaded, ended = finish_loading(long, piece, count, begun, last, rim, edge)
    if not loaded.known:
        return unknown
    if not same:
        folds = end_of_folds(long, opening)
        _, starts = begin(long, opening, folds)
        last = _end_wave(long, folds, rim)
        left = leave(long, opening, starts, last)
        total[:] = 0.0
        if not _sum_waves(long, opening, last, min(left.wave, last), last, folds, total):
            return unknown
        piece, _, _, count = _trace_waves(long, opening, float(last), long.ends)
        if left.wave > last:
            _from_zero(long, last, long.ends)
    lost, jumps = left.lost + total[INWARDS], left.jumps + total[JUMPS_INWARDS]
    left = Leaving(left.wave, lost, jumps, left.depth, left.tied or (not same and rim_is_tied(piece, rim)))
    unloaded, tied = finish_unloading(long, piece, count, left, starts, last, rim)
    if unloaded.lost == math.inf:
        return unknown
    return Looped(loaded, unloaded, ended.last, ended.snap, ended.one_disc, ended.tied or tied)
