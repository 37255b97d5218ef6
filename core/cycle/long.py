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
from gradhesion.core.curve.folds import CHUNK, find_folds, scan
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
    state_at,
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
    start_state,
    started_within,
    unload_from,
    visited_within,
    walk_loading,
    walk_on,
)
from gradhesion.core.cycle.pull_off import Lowest, deeper
from gradhesion.core.cycle.ties import loading_is_tied, unloading_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.cycle.waves import GAUSS, Waves, fill_from_zero, fill_rule, mix_wave, start_of, wave_of, waves_from
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.layout import HM, HUU, ROWS, Source, Table, end_of
from gradhesion.core.types import Floats, Integers

NEAR: Final = 24
"""The last wave next to the centre that is walked in any case."""
MOST: Final = 1_000_000
"""Waves within the contact, at most."""
_ENDED: Final = NEAR + 4
"""Folds that end by this wave are all traced next to the centre."""
BEFORE: Final = NEAR + 7
"""The wave to which the table next to the centre must reach."""
_WINDOW: Final = 5
"""Waves of the piece at the end."""
_SMOOTH: Final = 3e-7
"""Of a sum: the most that its last two polynomials may find; what is missed is about the square."""
_MOST_WALKED: Final = 200_000
"""Waves between that are walked, at most."""

# Rows of what a wave loses: outwards, from the highest top of the wave before to its own; inwards, from its lowest
# bottom to that of the wave before; in how many jumps; and whether a jump leaves a contact that is not one disc.
OUTWARDS, INWARDS, JUMPS_OUTWARDS, JUMPS_INWARDS, SHUT = range(5)
LOSSES: Final = 5

FOLDS, LEVEL, BOTTOM, TURN = range(4)
"""What is looked for over waves: the end of folds; a level that is reached; the lowest bottom; where a cycle turns."""


class Space(NamedTuple):
    """Room for a few waves: their table, their branches, those of what is measured, and lists of columns."""

    nodes: Floats
    polys: Floats
    trace: Floats
    measured: Floats
    visited: Integers
    stack: Integers
    slopes: Floats


def space_for(bins: int) -> Space:
    """Return room for that many bins."""
    columns = [np.empty(bins + 8, dtype=np.int64) for _ in range(2)]
    return Space(*room_of(bins), room_for(bins), room_for(bins), *columns, np.empty(CHUNK))


class Long(NamedTuple):
    """What long curves of one exponent are walked with.

    table     from 0 to beyond wave NEAR
    source    what bins are filled from
    waves     those of the table
    most      the last wave that is looked at
    disc      what the tests of the contact need
    contact   whether they are wanted
    start, scratch, window, ends   room: for the table; for waves that are looked at; that are walked; at the end
    """

    table: Table
    source: Source
    waves: Waves
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


class Begun(NamedTuple):
    """How loading begins.

    wave      the first wave whose top it reaches; NEAR: it has come there, next to the centre
    state     where it jumps to that wave from: a top next to the centre, or no contact
    lost, jumps   by then, or by the top of wave NEAR
    below     the energy below that state, at its depth
    landing   where the jump-in lands, inf if it is still to come
    reach     the last landing by then
    endless   whether it stands on the endless branch already
    one_disc, tied   of its jumps and decisions
    """

    wave: int
    state: State
    lost: float
    jumps: float
    below: float
    landing: float
    reach: float
    endless: bool
    one_disc: bool
    tied: bool


class Seed(NamedTuple):
    """Where the waves to be summed begin.

    wave    the wave up to whose top or bottom all is known; -1: none before the end
    lost, jumps   up to there
    last    the depth at which unloading leaves contact
    landing   where the jump-in lands
    one_disc, tied   of its jumps and decisions
    """

    wave: int
    lost: float
    jumps: float
    last: float
    landing: float
    one_disc: bool
    tied: bool


@leaf
def on(curve: Curve, table: Table) -> Curve:
    """Return the same curve on another table."""
    return Curve(table, curve.B, curve.g, curve.by_depth, curve.by_load)


@kernel
def _waves_on(long: Long, curve: Curve, number: float, count: int, space: Space) -> Curve:
    """Return a curve on a few waves from one on."""
    return on(curve, waves_from(long.waves, number, count, space.nodes, space.polys))


@kernel
def _from_zero(long: Long, number: int, space: Space) -> None:
    """Let the table in `space`, which begins at a wave, know the integrals from 0 to there."""
    column = np.empty((ROWS, 1))
    fill_from_zero(long.waves, number, long.scratch.nodes, long.scratch.polys, column)
    for row in range(HM, HUU + 1):
        space.nodes[row, 0] = column[row, 0]


@kernel
def _trace(curve: Curve, first: int, last: int, count: int, slopes: Floats, trace: Floats) -> int:
    """Add the branches in some bins of a few waves to `count` of them; one that comes from below them begins there."""
    if count == 0:
        trace[CLOSE_PAIR, 0] = math.inf
        if slope_at(curve, first) > 0.0:
            depth, load = depth_and_load(curve, first, -1.0)
            trace[START, 0], trace[START_DEPTH, 0], trace[START_LOAD, 0] = curve.table.start, depth, load
            trace[START_LEVEL, 0] = coordinate_of(curve, depth, load)
            trace[END, 0] = trace[END_LEVEL, 0] = math.inf
            trace[UNLOADED, 0] = math.nan
            count = 1
    return scan(curve, first, last, count, slopes, trace)[0]


@leaf
def _highest(trace: Floats, first: int, last: int) -> int:
    """Return the branch that ends highest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[END_LEVEL, j] > trace[END_LEVEL, best] else best
    return best


@leaf
def _lowest(trace: Floats, first: int, last: int) -> int:
    """Return the branch that starts lowest of some."""
    best = first
    for j in range(first + 1, last):
        best = j if trace[START_LEVEL, j] < trace[START_LEVEL, best] else best
    return best


@kernel
def _turn_in(long: Long, sought: Sought, number: int) -> float:
    """Return where loading along a wave first reaches the level of what is measured, inf if it does not."""
    space, per = long.scratch, long.waves.per
    trace, visited = space.trace, space.visited
    curve = _waves_on(long, sought.curve, number - 1.0, 2, space)
    measured = on(sought.measured, curve.table)
    first = _trace(curve, 0, per, 0, space.slopes, trace)
    count = _trace(curve, per, 2 * per, first, space.slopes, trace)
    if count == 0:
        return math.inf
    visited[0] = _highest(trace, 0, max(first, 1))
    trace[LANDING, visited[0]] = trace[START, visited[0]]
    trace[LOADED, visited[0]] = trace[LOADING_JUMPS, visited[0]] = 0.0
    visits = walk_on(curve, trace, visited[0] + 1, count, visited, 1, end_state(trace, visited[0]))
    rising = _trace(measured, 0, 2 * per, 0, space.slopes, space.measured)
    return turning_radius(measured, sought.level, trace, visited, visits, space.measured, rising)


@kernel
def _is_past(long: Long, sought: Sought, number: int) -> bool:
    """Return whether a wave is at what is looked for, or past it."""
    space, per, trace = long.scratch, long.waves.per, long.scratch.trace
    if sought.what == FOLDS:
        mix_wave(long.waves, float(number), 1, 0, space.nodes, space.polys)
        table = long.table
        edge = Table(
            table.k, table.exponent, table.share, 0.0, table.width, 0.0, 0.0, 0, 1, space.nodes, space.polys
        )
        return slope_at(on(sought.curve, edge), 0) >= 0.0
    if sought.what == TURN:
        return _turn_in(long, sought, number) < math.inf
    if sought.what == LEVEL:
        curve = _waves_on(long, sought.curve, float(number), 1, space)
        count = _trace(curve, 0, per, 0, space.slopes, trace)
        top = coordinate_at(curve, per) if slope_at(curve, per) >= 0.0 else -math.inf
        for j in range(count):
            top = max(top, trace[END_LEVEL, j]) if trace[END_LEVEL, j] < math.inf else top
        return top > sought.level
    curve = _waves_on(long, sought.curve, float(number), 2, space)
    if slope_at(curve, 0) >= 0.0:
        return True
    first = _trace(curve, 0, per, 0, space.slopes, trace)
    count = _trace(curve, per, 2 * per, first, space.slopes, trace)
    own = trace[START_LEVEL, _lowest(trace, 0, first)] if first > 0 else math.inf
    return (trace[START_LEVEL, _lowest(trace, first, count)] if count > first else math.inf) > own


@kernel
def _first_wave(long: Long, sought: Sought, guess: float, low: int, high: int) -> int:
    """Return the first wave from `low` on that is past what is looked for, `high` if none below is."""
    at = int(max(min(guess, high - 1.0), float(low))) if high > low else low
    before, past = low - 1, high
    step = 1
    if at < high and _is_past(long, sought, at):
        past = at
        while past > low:
            at = max(past - step, low)
            if not _is_past(long, sought, at):
                before = at
                break
            past, step = at, 2 * step
    else:
        before = at
        while before + step < high:
            at = before + step
            if _is_past(long, sought, at):
                past = at
                break
            before, step = at, 2 * step
    while past - before > 1:
        at = (past + before) // 2
        if _is_past(long, sought, at):
            past = at
        else:
            before = at
    return past


@leaf
def _share(curve: Curve, y: float) -> float:
    """Return tau/(1+tau), the share of the load in what is prescribed, at a radius."""
    tau = curve.by_load * y ** (1.0 + curve.table.k)
    return tau / (curve.by_depth + tau)


@leaf
def _guess(long: Long, curve: Curve, what: int, level: float) -> float:
    """Return about which wave is looked for, by the envelopes of waves whose crests and troughs are alike."""
    waves, m, eta = long.waves, curve.table.exponent, 0.5 * (1.0 - curve.table.k)
    crest = 1.0 - curve.g * waves.lowest
    if what == FOLDS:
        power = m - 1.0 - eta
        return wave_of(waves, (curve.g * waves.steepest / (curve.B * m)) ** (1.0 / power)) if power > 0.0 else 1e300
    y = 1.0
    for _ in range(6):
        share = _share(curve, y)
        if what == BOTTOM:
            y = ((eta + (1.0 + curve.table.k) * share) * crest / (curve.B * m)) ** (1.0 / (m - eta))
        else:
            rest = 1.0 - curve.table.share * share
            y = (max(2.0 - crest, 0.0) / (curve.B * rest)) ** (1.0 / (m - eta))
            reached = level / (curve.by_depth + curve.by_load * y ** (1.0 + curve.table.k)) if level > 0.0 else 0.0
            y = max(y, (reached / (curve.B * rest)) ** (1.0 / m))
    return wave_of(waves, y)


@kernel
def end_of_folds(long: Long, curve: Curve) -> int:
    """Return the first wave that begins on the endless branch, next to the last folds; long.most if there is none."""
    return _first_wave(long, Sought(FOLDS, curve, 0.0, curve), _guess(long, curve, FOLDS, 0.0), 1 + NEAR, long.most)


@kernel
def _jumps_are_open(long: Long, curve: Curve, space: Space, visits: int, rim: float) -> bool:
    """Return whether the contact is one disc during all jumps between branches that are visited, and from them to a rim."""
    for v in range(1, visits + 1):
        state = end_state(space.trace, space.visited[v - 1])
        if state.y >= rim:
            return True
        landing = min(rim, space.trace[LANDING, space.visited[v]] if v < visits else rim)
        if not gap_is_open(curve, long.disc, state.y, state.depth, landing):
            return False
    return True


@kernel
def _wave_losses(long: Long, curve: Curve, number: float, outwards: bool, inwards: bool, out: Floats) -> bool:
    """Put what a wave loses into `out` (LOSSES,), on the ways that are asked for; return whether it is regular."""
    space, per = long.scratch, long.waves.per
    trace, visited = space.trace, space.visited
    piece = _waves_on(long, curve, number - 1.0, 2, space)
    for edge in range(3):
        if slope_at(piece, edge * per) >= 0.0:
            return False
    first = _trace(piece, 0, per, 0, space.slopes, trace)
    count = _trace(piece, per, 2 * per, first, space.slopes, trace)
    if first < 1 or count <= first:
        return False
    out[:] = 0.0
    if outwards:
        top = _highest(trace, 0, first)
        trace[LOADED, top] = trace[LOADING_JUMPS, top] = 0.0
        visited[0] = top
        visits = walk_on(piece, trace, first, count, visited, 1, end_state(trace, top))
        if visits < 2:  # noqa: PLR2004
            return False
        out[OUTWARDS] = trace[LOADED, visited[visits - 1]]
        out[JUMPS_OUTWARDS] = trace[LOADING_JUMPS, visited[visits - 1]]
        if long.contact and not _jumps_are_open(long, piece, space, visits, trace[LANDING, visited[visits - 1]]):
            out[SHUT] = 1.0
    if inwards:
        low, inner = _lowest(trace, first, count), _lowest(trace, 0, first)
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
    """Put the sums of what some waves lose into `sums` (LOSSES,); return whether it is smooth. `values` is room.

    The outermost places are looked at first, where the jumps differ most.
    """
    places, weights, last = np.empty(GAUSS), np.empty(GAUSS), np.empty((2, GAUSS))
    fill_rule(float(count), places, weights, last)
    for n in range(GAUSS):
        i = 0 if n == 0 else GAUSS - n
        if not _wave_losses(long, curve, first + places[i], outwards, inwards, values[i]):
            return False
        if values[i, JUMPS_OUTWARDS] != values[0, JUMPS_OUTWARDS] or values[i, JUMPS_INWARDS] != values[0, JUMPS_INWARDS]:
            return False
    for row in range(LOSSES):
        total = miss = other = 0.0
        for i in range(GAUSS):
            total += weights[i] * values[i, row]
            miss += last[0, i] * values[i, row]
            other += last[1, i] * values[i, row]
        if row <= INWARDS and abs(miss) + abs(other) > _SMOOTH * abs(total):
            return False
        sums[row] = total
    return True


@kernel
def _sum_waves(
    long: Long,
    curve: Curve,
    first: int,
    last: int,
    inner: float,
    outer: float,
    outwards: bool,
    inwards: bool,
    total: Floats,
) -> bool:
    """Add what the waves `first` to `last` lose to `total` (LOSSES,); return whether they are regular.

    `inner` and `outer` are the waves next to them where losses are not smooth; panels are as long as twice their
    distance from these, and halved where that proves too long.
    """
    values, part = np.empty((GAUSS, LOSSES)), np.empty(LOSSES)
    left, longest, walked = first, 1e300, 0
    while left <= last:
        count = int(min(2.0 * (left - inner), (outer - left) / 1.5, longest, last - left + 1.0))
        if count > 2 * GAUSS:
            if not _panel(long, curve, left, count, outwards, inwards, values, part):
                longest = 0.5 * count
                continue
            total += part
        else:
            count = min(max(count, 1), last - left + 1)
            walked += count
            if walked > _MOST_WALKED:
                return False
            for number in range(left, left + count):
                if not _wave_losses(long, curve, float(number), outwards, inwards, part):
                    return False
                total += part
        left += count
        longest *= 2.0
    return True


@kernel
def trace_start(long: Long, curve: Curve, folds: int) -> int:
    """Trace the waves up to NEAR, or all folds if they end soon; return the number of branches.

    `folds` is that of `end_of_folds`.
    """
    last = BEFORE - 1.0 if folds <= _ENDED else NEAR + 1.0
    space, y_end = long.start, start_of(long.waves, last) - 0.5 * long.waves.width
    count = find_folds(on(curve, long.table), y_end, space.slopes, space.trace)
    if count > 0 and folds <= _ENDED:
        space.trace[END, count - 1] = space.trace[END_LEVEL, count - 1] = math.inf
    return count


@kernel
def begin(long: Long, curve: Curve, count: int, folds: int) -> Begun:
    """Let loading go over the `count` branches next to the centre, and find the wave to which it jumps from there."""
    space, start, near = long.start, on(curve, long.table), start_of(long.waves, float(NEAR))
    trace, visited = space.trace, space.visited
    visits = walk_loading(start, trace, count, visited)
    limits = np.array([0.0, -1.0])
    tied = loading_is_tied(start, long.source, end_of(long.table), trace, count)
    if visits == 0:
        state, landing, reach, lost, jumps, below = State(0.0, 0.0, 0.0), math.inf, math.inf, 0.0, 0.0, 0.0
        is_open = not long.contact or loading_is_one_disc(start, long.disc, trace, visited, 0, near, limits)
    else:
        j = visited[visits - 1]
        state, landing, reach = end_state(trace, j), trace[LANDING, visited[0]], trace[LANDING, j]
        lost, jumps = trace[LOADED, j], trace[LOADING_JUMPS, j]
        is_open = not long.contact or loading_is_one_disc(start, long.disc, trace, visited, visits, reach, limits)
        if state.y == math.inf:
            return Begun(NEAR, state, lost, jumps, 0.0, landing, reach, True, is_open, tied)
        if state.y > near and folds > _ENDED:
            return Begun(NEAR, state, lost, jumps, 0.0, landing, reach, False, is_open, tied)
        below = energy_between(start, state.depth, 0.0, state.y)
        is_open = is_open and (not long.contact or gap_is_open(start, long.disc, state.y, state.depth, near))
    level = coordinate_of(curve, state.depth, state.load)
    sought = Sought(LEVEL, curve, level, curve)
    wave = _first_wave(long, sought, _guess(long, curve, LEVEL, level), 1 + NEAR, long.most)
    return Begun(wave, state, lost, jumps, below, landing, reach, False, is_open, tied)


@kernel
def seed_loading(long: Long, curve: Curve, begun: Begun, last: int) -> tuple[Seed, int]:
    """Let loading jump to its first wave, if that is no later than `last`; return that, and the branches in `window`."""
    if begun.wave == NEAR:
        return Seed(NEAR, begun.lost, begun.jumps, 0.0, begun.landing, begun.one_disc, begun.tied), 0
    if begun.wave > last:
        return Seed(-1, begun.lost, begun.jumps, 0.0, begun.landing, begun.one_disc, begun.tied), 0
    space = long.window
    trace, visited = space.trace, space.visited
    piece = _waves_on(long, curve, begun.wave - 1.0, 2, space)
    _from_zero(long, begun.wave - 1, space)
    count = _trace(piece, 0, piece.table.bins, 0, space.slopes, trace)
    visits = walk_on(piece, trace, 0, count, visited, 0, State(0.0, begun.state.depth, begun.state.load))
    if visits == 0:
        return Seed(-1, begun.lost, begun.jumps, 0.0, begun.landing, begun.one_disc, begun.tied), 0
    j = visited[visits - 1]
    landing = trace[LANDING, visited[0]] if begun.jumps == 0.0 else begun.landing
    one_disc = begun.one_disc
    if long.contact and one_disc:
        one_disc = _jumps_are_open(long, piece, space, visits, trace[LANDING, j])
    tied = begun.tied or loading_is_tied(piece, long.source, end_of(piece.table), trace, count)
    lost = begun.lost + trace[LOADED, j] - begun.below
    return Seed(begun.wave, lost, begun.jumps + trace[LOADING_JUMPS, j], 0.0, landing, one_disc, tied), visits


@kernel
def _leave_far(long: Long, curve: Curve, state: State, starts: int) -> Unloaded:
    """Return what unloading loses from a state on that jumps to a branch next to the centre, or out of contact.

    `curve` stands on waves that know the integrals from 0; `starts` branches are traced next to the centre.
    """
    space = long.start
    j = inner_branch(space.trace, starts - 1, coordinate_of(curve, state.depth, state.load))
    if j < 0:
        dead = curve.by_depth == 0.0  # a dead load falls without end: its jump-out is left out
        lost = 0.0 if dead else jump_energy(curve, state.y, state.depth, state.load, 0.0)
        return Unloaded(lost, 1.0, state.depth)
    start, trace = on(curve, long.table), space.trace
    level = coordinate_of(curve, state.depth, state.load)
    landing = at_level(start, level, trace[START, j], trace[END, j], ACCURACY)
    lost = jump_energy(start, 0.0, state.depth, state.load, landing) - energy_between(curve, state.depth, 0.0, state.y)
    fill_unloading(start, trace, j, space.stack)
    return Unloaded(
        lost + trace[UNLOADED, j], 1.0 + trace[UNLOADING_JUMPS, j], trace[START_DEPTH, int(trace[LAST, j])]
    )


@kernel
def seed_unloading(long: Long, curve: Curve, starts: int, last: int) -> Seed:
    """Find where unloading leaves contact, if that is no later than wave `last`, and what it loses from there on."""
    guess = _guess(long, curve, BOTTOM, 0.0)
    wave = _first_wave(long, Sought(BOTTOM, curve, 0.0, curve), guess, NEAR, last + 1)
    if wave > last:
        return Seed(-1, 0.0, 0.0, 0.0, 0.0, True, False)
    if wave == NEAR:
        start, trace = on(curve, long.table), long.start.trace
        near = started_within(trace, starts, start_of(long.waves, float(NEAR)))
        if near < starts:
            low = _lowest(trace, near, starts)
            fill_unloading(start, trace, low, long.start.stack)
            tied = unloading_is_tied(start, long.source, trace[START, low], trace, starts)
            lost, jumps = trace[UNLOADED, low], trace[UNLOADING_JUMPS, low]
            return Seed(NEAR, lost, jumps, trace[START_DEPTH, int(trace[LAST, low])], 0.0, True, tied)
    space, per = long.window, long.waves.per
    piece = _waves_on(long, curve, wave - 1.0, 3, space)
    _from_zero(long, wave - 1, space)
    inside = _trace(piece, 0, per, 0, space.slopes, space.trace)
    first = _trace(piece, per, 2 * per, inside, space.slopes, space.trace)
    count = _trace(piece, 2 * per, 3 * per, first, space.slopes, space.trace)
    low = _lowest(space.trace, inside, first)
    tied = unloading_is_tied(piece, long.source, space.trace[START, _lowest(space.trace, first, count)], space.trace, count)
    left = _leave_far(long, piece, start_state(space.trace, low), starts)
    return Seed(wave, left.lost, left.jumps, left.last, 0.0, True, tied)


class Looped(NamedTuple):
    """A cycle up to a rim, as path.py has it, and what else is known of it.

    landing, reach   where the jump-in and the last jump of loading land
    """

    loaded: Loaded
    unloaded: Unloaded
    landing: float
    reach: float
    one_disc: bool
    tied: bool


@kernel
def trace_end(long: Long, curve: Curve, end: int, needs_zero: bool) -> tuple[Curve, int]:
    """Trace the waves `end` - 2 to `end` + 2 in `ends`; return the curve on them and the number of branches."""
    piece = _waves_on(long, curve, end - 2.0, _WINDOW, long.ends)
    if needs_zero:
        _from_zero(long, end - 2, long.ends)
    return piece, _trace(piece, 0, piece.table.bins, 0, long.ends.slopes, long.ends.trace)


@kernel
def _far_landing(long: Long, curve: Curve, begun: Begun, rim: float, loaded: Loaded) -> tuple[Loaded, float]:
    """Return what loading loses that jumps from a state to the endless branch far out, or to the rim, and where it lands.

    It lands no earlier than in `begun.wave`; `loaded` has what is known of the state at the rim.
    """
    state, space = begun.state, long.window
    level = coordinate_of(curve, state.depth, state.load)
    sought = Sought(LEVEL, curve, level, curve)
    wave = _first_wave(long, sought, _guess(long, curve, LEVEL, level), begun.wave, long.most)
    landing = BEYOND
    if start_of(long.waves, float(wave)) < rim:
        piece = _waves_on(long, curve, float(wave), 1, space)
        landing = at_level(piece, level, piece.table.start, math.inf, ACCURACY)
    if landing == BEYOND or landing > rim:
        wave, landing = int(wave_of(long.waves, rim)), rim
        piece = _waves_on(long, curve, float(wave), 1, space)
    _from_zero(long, wave, space)
    lost = jump_energy(piece, 0.0, state.depth, state.load, landing)
    deepest = loaded.deepest
    if rim < math.inf and landing < rim:
        deepest, _ = state_at(on(curve, long.table), long.source, rim)
    elif rim < math.inf:
        depth, load = state_at(on(curve, long.table), long.source, rim)
        fall = level - coordinate_of(curve, depth, load)
        deepest = depth + fall / softness(curve, rim ** (1.0 + curve.table.k))
    in_to_rim = landing == rim and begun.jumps == 0.0
    return Loaded(begun.lost + lost - begun.below, begun.jumps + 1.0, deepest, in_to_rim, True), landing


@kernel
def finish_loading(
    long: Long, piece: Curve, count: int, begun: Begun, seed: Seed, end: int, rim: float, wants_depth: bool
) -> tuple[Loaded, float, float, bool, bool]:
    """Let loading go over the waves at the end; return what it loses, its first and last landings, and two flags.

    `seed` has what is lost up to wave `end` - 2 if it has a wave. The flags: one disc; a close decision.
    """
    space, source = long.ends, long.source
    trace, visited = space.trace, space.visited
    landing, reach, one_disc = seed.landing, begun.reach, seed.one_disc
    if seed.wave >= 0:
        top = _highest(trace, 0, started_within(trace, count, start_of(long.waves, end - 1.0)))
        trace[LANDING, top], trace[LOADED, top], trace[LOADING_JUMPS, top] = trace[START, top], seed.lost, seed.jumps
        visited[0] = top
        visits = walk_on(piece, trace, top + 1, count, visited, 1, end_state(trace, top))
    else:
        visits = walk_on(piece, trace, 0, count, visited, 0, State(0.0, begun.state.depth, begun.state.load))
        for v in range(visits):
            trace[LOADED, visited[v]] += begun.lost - begun.below
            trace[LOADING_JUMPS, visited[v]] += begun.jumps
        if visits > 0 and begun.jumps == 0.0:
            landing = trace[LANDING, visited[0]]
    tied = seed.tied or loading_is_tied(piece, source, rim, trace, count)
    n = visited_within(trace, visited, visits, rim)
    if n > 0:
        reach = trace[LANDING, visited[n - 1]]
    if long.contact and one_disc:
        one_disc = _jumps_are_open(long, piece, space, n, rim)
    loaded = load_to(piece, source, rim, trace, visited, visits, wants_depth)
    if not loaded.known or n == 0:  # the endless branch is far out, or nothing is met within the rim
        state, lost, jumps, below = begun.state, begun.lost, begun.jumps, begun.below
        if n > 0:
            j = visited[n - 1]
            state, lost, jumps = end_state(trace, j), trace[LOADED, j], trace[LOADING_JUMPS, j]
            _from_zero(long, end - 2, space)
            below = energy_between(piece, state.depth, 0.0, state.y)
        after = Begun(end, state, lost, jumps, below, landing, reach, False, True, False)
        loaded, last = _far_landing(long, piece, after, rim, loaded)
        landing, reach = last if jumps == 0.0 else landing, last
    return loaded, landing, reach, one_disc, tied


@kernel
def finish_unloading(
    long: Long, piece: Curve, count: int, seed: Seed, starts: int, end: int, rim: float
) -> tuple[Unloaded, bool]:
    """Let unloading go from a rim over the waves at the end; return what it loses, and whether a decision is close."""
    space, source = long.ends, long.source
    trace = space.trace
    within = started_within(trace, count, rim)
    low, left = 0, Unloaded(seed.lost, seed.jumps, seed.last)
    if seed.wave >= 0:
        low = _lowest(trace, 0, started_within(trace, count, start_of(long.waves, end - 1.0)))
    elif within > 0:
        low = _lowest(trace, 0, within)
        left = _leave_far(long, piece, start_state(trace, low), starts)
    trace[UNLOADED, low], trace[UNLOADING_JUMPS, low], trace[LAST, low] = left.lost, left.jumps, low
    tied = seed.tied or unloading_is_tied(piece, source, rim, trace, count)
    if within == 0 or trace[END, within - 1] < rim:
        depth, load = state_at(piece, source, rim)
        if inner_branch(trace, within - 1, coordinate_of(piece, depth, load)) < 0:
            return _leave_far(long, piece, State(rim, depth, load), starts), tied
    unloaded = unload_from(piece, source, rim, trace, count, space.stack)
    return Unloaded(unloaded.lost, unloaded.jumps, left.last), tied


@kernel
def turn_far(long: Long, curve: Curve, measured: Curve, target: float, begun: Begun, rim: float) -> float:
    """Return where loading first reaches a target of what is measured, a rim at most; inf: not within long.most waves."""
    low = begun.wave + 1
    if begun.wave > NEAR and begun.wave < long.most:
        space = long.window
        _, visits = seed_loading(long, curve, begun, long.most)
        piece = Curve(
            waves_from(long.waves, begun.wave - 1.0, 2, space.nodes, space.polys),
            measured.B,
            measured.g,
            measured.by_depth,
            measured.by_load,
        )
        rising = _trace(piece, 0, piece.table.bins, 0, space.slopes, space.measured)
        found = turning_radius(piece, target, space.trace, space.visited, visits, space.measured, rising)
        if found < math.inf:
            return min(found, rim)
    high = long.most if rim == math.inf else int(min(float(long.most), wave_of(long.waves, rim) + 1.0))
    sought = Sought(TURN, curve, target, measured)
    wave = _first_wave(long, sought, _guess(long, measured, LEVEL, target), low, high)
    if wave == high:
        return rim if high < long.most else math.inf
    return min(_turn_in(long, sought, wave), rim)


@kernel
def lowest_far(long: Long, curve: Curve, rim: float) -> Lowest:
    """Return the lowest load within a rim beyond the waves next to the centre, as `lowest_load` does."""
    curve = load_curve(curve)
    high = long.most if rim == math.inf else int(min(float(long.most), wave_of(long.waves, rim)))
    guess = _guess(long, curve, BOTTOM, 0.0)
    wave = _first_wave(long, Sought(BOTTOM, curve, 0.0, curve), guess, NEAR - 1, high)
    if wave >= long.most:
        return Lowest(0.0, 0.0, 0.0, 0.0, False)
    space = long.scratch
    piece = _waves_on(long, curve, wave - 1.0, 3, space)
    best = Lowest(0.0, 0.0, 0.0, 0.0, True)
    if rim <= end_of(piece.table):
        i, t = place_of(piece.table, rim)
        best = deeper(best, depth_and_load(piece, i, t)[1], rim)
    for j in range(_trace(piece, 0, piece.table.bins, 0, space.slopes, space.trace)):
        y = space.trace[START, j]
        if piece.table.start < y <= rim:
            best = deeper(best, space.trace[START_LOAD, j], y)
    return best


@kernel
def _between(
    long: Long,
    curve: Curve,
    out: Seed,
    back: Seed,
    last: int,
    folds: int,
    outwards: bool,
    inwards: bool,
    total: Floats,
) -> bool:
    """Add what the waves up to `last` lose to `total`, from the seed of each way on; return whether they are regular."""
    outer = float(folds) - 1.0 if folds < long.most else 1e300
    low = _guess(long, curve, BOTTOM, 0.0)
    first = out.wave if outwards else back.wave
    if outwards and inwards and out.wave != back.wave:
        first = max(out.wave, back.wave)
        inner = 0.5 * out.wave if out.wave < back.wave else min(low, back.wave - 1.0)
        if not _sum_waves(
            long, curve, min(out.wave, back.wave) + 1, first, inner, outer, first != out.wave, first == out.wave, total
        ):
            return False
    inner = min(low, back.wave - 1.0) if inwards else 0.5 * first
    return _sum_waves(long, curve, first + 1, last, max(inner, 0.5 * first), outer, outwards, inwards, total)


@leaf
def _with_losses(seed: Seed, lost: float, jumps: float, is_open: bool) -> Seed:
    """Return a seed with what is lost from it up to the end added."""
    one_disc = seed.one_disc and is_open
    return Seed(seed.wave, seed.lost + lost, seed.jumps + jumps, seed.last, seed.landing, one_disc, seed.tied)


@leaf
def _unknown() -> Looped:
    """Return that a cycle is not known."""
    return Looped(Loaded(0.0, 0.0, 0.0, False, False), Unloaded(0.0, 0.0, 0.0), 0.0, 0.0, True, False)


@kernel
def _end_wave(long: Long, folds: int, rim: float) -> int:
    """Return the wave in which the path ends: that of the rim, or the one before the endless branch."""
    return int(min(folds - 1.0, wave_of(long.waves, rim))) if rim < math.inf else folds - 1


@kernel
def loop_far(
    long: Long, closing: Curve, opening: Curve, same: bool, folds: int, begun: Begun, starts: int, rim: float, depth: bool
) -> Looped:
    """Return the cycle up to a rim; `same`: closing and opening are one curve; `depth`: the depth at far rims is wanted.

    `folds`, `begun` and `starts` are those of `end_of_folds`, `begin` and `trace_start` of closing.
    """
    end, total = _end_wave(long, folds, rim), np.zeros(LOSSES)
    if end > MOST or begun.wave >= long.most and rim == math.inf:
        return _unknown()
    out = Seed(-1, begun.lost, begun.jumps, 0.0, begun.landing, begun.one_disc, begun.tied)
    back = Seed(-1, 0.0, 0.0, 0.0, 0.0, True, False)
    piece, count = on(closing, long.table), 0
    landing, reach, one_disc, tied = begun.landing, begun.reach, begun.one_disc, begun.tied
    ended = folds <= _ENDED
    if not ended:
        out, _ = seed_loading(long, closing, begun, end - 2)
        if same:
            back = seed_unloading(long, opening, starts, end - 2)
        outwards, inwards = out.wave >= 0, same and back.wave >= 0
        if (outwards or inwards) and not _between(
            long, closing, out, back, end - 2, folds, outwards, inwards, total
        ):
            return _unknown()
        out = _with_losses(out, total[OUTWARDS], total[JUMPS_OUTWARDS], total[SHUT] == 0.0)
        back = _with_losses(back, total[INWARDS], total[JUMPS_INWARDS], True)
        piece, count = trace_end(long, closing, end, out.wave < 0 or same and back.wave < 0)
        loaded, landing, reach, one_disc, tied = finish_loading(long, piece, count, begun, out, end, rim, depth)
    elif begun.endless:
        deepest = math.inf
        if rim < math.inf:
            deepest, _ = state_at(piece, long.source, rim)
        loaded = Loaded(begun.lost, begun.jumps, deepest, False, True)
    else:
        loaded, reach = _far_landing(long, closing, begun, rim, Loaded(0.0, 0.0, math.inf, False, True))
        landing = reach if begun.jumps == 0.0 else landing
    if not same:
        folds = end_of_folds(long, opening)
        end, total[:] = _end_wave(long, folds, rim), 0.0
        starts = trace_start(long, opening, folds)
        ended = folds <= _ENDED
        if not ended:
            back = seed_unloading(long, opening, starts, end - 2)
            if back.wave >= 0 and not _between(long, opening, out, back, end - 2, folds, False, True, total):
                return _unknown()
            back = _with_losses(back, total[INWARDS], total[JUMPS_INWARDS], True)
            piece, count = trace_end(long, opening, end, back.wave < 0)
    if ended:
        j, start, trace = starts - 1, on(opening, long.table), long.start.trace
        fill_unloading(start, trace, j, long.start.stack)
        last = trace[START_DEPTH, int(trace[LAST, j])]
        unloaded, close = Unloaded(trace[UNLOADED, j], trace[UNLOADING_JUMPS, j], last), False
    else:
        unloaded, close = finish_unloading(long, piece, count, back, starts, end, rim)
    return Looped(loaded, unloaded, landing, reach, one_disc, tied or close)
