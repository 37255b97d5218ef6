"""How a cycle of many waves ends: loading far out or at its rim, unloading next to the centre or out of contact."""

import math
from typing import NamedTuple

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.energy import energy_between, jump_energy
from gradhesion.core.curve.levels import BEYOND, at_level
from gradhesion.core.curve.levels import LANDING as ACCURACY
from gradhesion.core.curve.values import Curve, coordinate_of, softness, state_in
from gradhesion.core.cycle.disc import gap_is_open
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
    walk_on,
)
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, unloading_is_tied
from gradhesion.core.jit import inlined, kernel
from gradhesion.core.many.losses import jumps_are_open
from gradhesion.core.many.search import (
    BOTTOM,
    LEVEL,
    Long,
    Sought,
    first_wave,
    from_zero,
    highest_end,
    lowest_start,
    on,
    trace_waves,
)
from gradhesion.core.many.waves import start_of, wave_of, waves_from
from gradhesion.core.table.layout import end_of


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
    if trace[at.START, j] > start_of(long.waves, float(long.near)):
        return Unloaded(math.inf, 0.0, 0.0)
    start = on(curve, long.table)
    landing = at_level(start, level, trace[at.START, j], trace[at.END, j], ACCURACY)
    lost = jump_energy(start, 0.0, state.depth, state.load, landing) - energy_between(curve, state.depth, 0.0, state.y)
    fill_unloading(start, trace, j, long.start.stack)
    last = trace[at.START_DEPTH, int(trace[at.LAST, j])]
    return Unloaded(lost + trace[at.UNLOADED, j], 1.0 + trace[at.UNLOADING_JUMPS, j], last)


@kernel
def leave(long: Long, curve: Curve, starts: int, last: int) -> Leaving:
    """Find the wave of the lowest bottom, and what unloading loses from there on, if it is no later than `last`."""
    wave = first_wave(long, Sought(BOTTOM, curve, 0.0, curve), long.near, last + 1)
    if wave > last:
        return Leaving(wave, 0.0, 0.0, 0.0, False)
    if wave == long.near:
        start, trace = on(curve, long.table), long.start.trace
        first = started_within(trace, starts, start_of(long.waves, float(wave)))
        low = lowest_start(trace, first, starts) if first < starts else starts - 1
        fill_unloading(start, trace, low, long.start.stack)
        tied = unloading_is_tied(start, trace[at.START, low], trace, starts)
        depth = trace[at.START_DEPTH, int(trace[at.LAST, low])]
        return Leaving(wave, trace[at.UNLOADED, low], trace[at.UNLOADING_JUMPS, low], depth, tied)
    space = long.window
    piece, first, others, count = trace_waves(long, curve, wave - 1.0, space)
    from_zero(long, wave - 1, space)
    after = space.trace[at.START, lowest_start(space.trace, others, count)]
    tied = unloading_is_tied(piece, after, space.trace, count)
    left = _leave_far(long, piece, start_state(space.trace, lowest_start(space.trace, first, others)), starts)
    return Leaving(wave, left.lost, left.jumps, left.last, tied)


@inlined
def _far_landing(long: Long, curve: Curve, before: Loading, rim: float) -> tuple[Loaded, Loading]:
    """Return what loading loses that jumps to the endless branch far out, or to the rim, and how it stands there.

    It lands no earlier than in wave before.wave.
    """
    state, space = before.state, long.window
    level = coordinate_of(curve, state.depth, state.load)
    wave = first_wave(long, Sought(LEVEL, curve, level, curve), before.wave, long.most)
    at_rim = float(wave) > wave_of(long.waves, rim)
    if at_rim:
        wave = int(wave_of(long.waves, rim))
    elif wave == long.most:
        return Loaded(0.0, 0.0, 0.0, False, False), before
    piece = on(curve, waves_from(long.waves, float(wave), space.nodes, space.polys))
    from_zero(long, wave, space)
    landing = BEYOND if at_rim else at_level(piece, level, piece.table.start, math.inf, ACCURACY)
    at_rim = landing == BEYOND or landing > rim
    landing, deepest = rim if at_rim else landing, math.inf
    if at_rim:
        deepest, load = state_in(piece, rim)
        fall = level - coordinate_of(curve, deepest, load)
        deepest += fall / softness(curve, rim ** (1.0 + curve.table.k))
    lost = before.lost + jump_energy(piece, 0.0, state.depth, state.load, landing) - before.below
    jumps, first = before.jumps + 1.0, before.jumps == 0.0
    snap = snap_in(piece, landing) if first else before.snap
    last = landing if first or not at_rim else before.last
    loaded = Loaded(lost, jumps, deepest, at_rim and first, True)
    return loaded, Loading(wave, True, state, lost, jumps, 0.0, snap, last, before.one_disc, before.tied)


@inlined
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
        top = highest_end(trace, 0, started_within(trace, count, start_of(long.waves, last + 1.0)))
        trace[at.LANDING, top] = min(before.last, trace[at.START, top])
        trace[at.LOADED, top], trace[at.LOADING_JUMPS, top] = before.lost, before.jumps
        visited[0], visits = top, count - count + 1
        visits = walk_on(piece, trace, top + 1, count, visited, visits, end_state(trace, top))
    else:
        none = count - count
        visits = walk_on(piece, trace, none, count, visited, none, State(0.0, before.state.depth, before.state.load))
        for v in range(visits):
            trace[at.LOADED, visited[v]] += before.lost - before.below
            trace[at.LOADING_JUMPS, visited[v]] += before.jumps
    n = visited_within(trace, visited, visits, rim)
    one_disc = before.one_disc and (not long.contact or jumps_are_open(long, piece, space, n, rim))
    if long.contact and one_disc and rim < edge and rim < end_of(piece.table):
        one_disc = gap_is_open(piece, long.disc, rim, state_in(piece, rim)[0], min(edge, end_of(piece.table)))
    tied = before.tied or rim_is_tied(piece, rim) or loading_is_tied(piece, rim, rim >= edge, trace, count)
    state, lost, jumps, below = before.state, before.lost, before.jumps, before.below
    snap, landing = before.snap, before.last
    if n > 0:
        j = visited[n - 1]
        state, landing = end_state(trace, j), trace[at.LANDING, j]
        lost, jumps = trace[at.LOADED, j], trace[at.LOADING_JUMPS, j]
        snap = snap if before.jumps > 0.0 else snap_in(piece, trace[at.LANDING, visited[0]])
    loaded = load_to(piece, rim, trace, visited, visits)
    if loaded.known and n > 0:
        # on the endless branch; the depth at a rim there is left to who knows it beside any other scenes
        if loaded.deepest == math.inf and rim < edge and wave_of(long.waves, rim) < long.most:
            table = waves_from(long.waves, float(int(wave_of(long.waves, rim))), long.window.nodes, long.window.polys)
            depth, _ = state_in(on(piece, table), rim)
            loaded = Loaded(loaded.lost, loaded.jumps, depth, loaded.in_to_rim, True)
        return loaded, Loading(last, True, state, lost, jumps, 0.0, snap, landing, one_disc, tied)
    if n > 0:
        from_zero(long, last, space)
        below = energy_between(piece, state.depth, 0.0, state.y)
    begun = Loading(last, False, state, lost, jumps, below, snap, landing, one_disc, tied)
    return _far_landing(long, piece, begun, rim)


@inlined
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
        low = lowest_start(trace, 0, started_within(trace, count, start_of(long.waves, last + 1.0)))
    else:
        low = lowest_start(trace, 0, max(within, 1))
        if within > 0:
            left = _leave_far(long, piece, start_state(trace, low), starts)
    trace[at.UNLOADED, low], trace[at.UNLOADING_JUMPS, low], trace[at.LAST, low] = left.lost, left.jumps, low
    if within == 0 or trace[at.END, within - 1] < rim:
        if rim > end_of(piece.table):  # folds go on beyond what is looked at
            return Unloaded(math.inf, 0.0, 0.0), tied
        depth, load = state_in(piece, rim)
        if inner_branch(trace, within - 1, coordinate_of(piece, depth, load)) < 0:
            return _leave_far(long, piece, State(rim, depth, load), starts), tied
    unloaded = unload_from(piece, rim, trace, count, space.stack)
    return Unloaded(unloaded.lost, unloaded.jumps, left.last), tied
