"""Cycles of more waves than are walked: what a wave loses is a smooth function of its number.

Loading and unloading are walked where something begins or ends: over the waves next to the centre, where the jump-in
lands, where unloading leaves contact, and at the rim or the last folds. What the waves between lose is sampled and
summed (waves.py); they are walked one by one where it is not smooth. Jumps across waves that are not summed lose a form
of integrals from the centre, which are known at every wave.

Every wave reaches higher than those before it from the landing of the jump-in on, and dips less deep than the one
outside it up to where unloading leaves contact: both are looked for by bisection.
"""

import math

import numpy as np

from gradhesion.core.curve import trace as at
from gradhesion.core.curve.energy import energy_between
from gradhesion.core.curve.folds import find_folds
from gradhesion.core.curve.values import Curve, coordinate_of, depth_and_load, load_curve, place_of
from gradhesion.core.cycle.disc import loading_is_one_disc
from gradhesion.core.cycle.path import Cycle, Loaded, State, Unloaded, end_state, snap_in, walk_loading, walk_on
from gradhesion.core.cycle.pull_off import Lowest, deeper
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, target_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.jit import allocating, inlined, kernel
from gradhesion.core.many.ends import Leaving, Loading, finish_loading, finish_unloading, leave
from gradhesion.core.many.losses import (
    INWARDS,
    JUMPS_INWARDS,
    JUMPS_OUTWARDS,
    OUTWARDS,
    SHUT,
    jumps_are_open,
    sum_waves,
)
from gradhesion.core.many.search import (
    BOTTOM,
    LEVEL,
    MOST,
    TURN,
    Long,
    Sought,
    end_of_folds,
    first_wave,
    from_zero,
    on,
    trace_branches,
    trace_waves,
    turn_in,
    turning_in,
)
from gradhesion.core.many.waves import start_of, wave_of, waves_from
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats


@allocating
def begin(long: Long, curve: Curve, folds: int) -> tuple[Loading, int]:
    """Let loading go over the waves next to the centre, and find the wave to which it jumps from there.

    Return that, and the number of branches there; `folds` is that of `end_of_folds`.
    """
    space, start, near = long.start, on(curve, long.table), start_of(long.waves, float(long.near))
    trace, visited = space.trace, space.visited
    y_end = start_of(long.waves, long.near + 1.0) - 0.5 * long.waves.width
    count = find_folds(start, y_end, trace)
    if count > 0 and folds <= long.near + 1:
        trace[at.END, count - 1] = trace[at.END_LEVEL, count - 1] = math.inf
    visits = walk_loading(start, trace, count, visited)
    state, lost, jumps, below, snap, last = State(0.0, 0.0, 0.0), 0.0, 0.0, 0.0, 0.0, math.inf
    if visits > 0:
        j = visited[visits - 1]
        state, lost, jumps = end_state(trace, j), trace[at.LOADED, j], trace[at.LOADING_JUMPS, j]
        snap, last = snap_in(start, trace[at.LANDING, visited[0]]), trace[at.LANDING, j]
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
    wave = first_wave(long, Sought(LEVEL, curve, level, curve), long.near + 1, long.most)
    return Loading(wave, False, state, lost, jumps, below, snap, last, one_disc, tied), count


@kernel
def land(long: Long, curve: Curve, before: Loading) -> tuple[Loading, int]:
    """Let loading jump to its first wave; return how it stands there, and how many branches it visits in `window`."""
    space = long.window
    trace, visited = space.trace, space.visited
    piece, _, _, count = trace_waves(long, curve, before.wave - 2.0, space)
    from_zero(long, before.wave - 2, space)
    none = count - count
    visits = walk_on(piece, trace, none, count, visited, none, State(0.0, before.state.depth, before.state.load))
    if visits == 0:
        return before, visits
    j = visited[visits - 1]
    landing = trace[at.LANDING, j]
    one_disc = before.one_disc and (not long.contact or jumps_are_open(long, piece, space, visits, landing))
    tied = before.tied or loading_is_tied(piece, end_of(piece.table), False, trace, count)
    lost, jumps = before.lost + trace[at.LOADED, j] - before.below, before.jumps + trace[at.LOADING_JUMPS, j]
    snap = snap_in(piece, trace[at.LANDING, visited[0]]) if before.jumps == 0.0 else before.snap
    state = end_state(trace, j)
    return Loading(before.wave, True, state, lost, jumps, 0.0, snap, landing, one_disc, tied), visits


@inlined
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
        found, rising = turning_in(long, measured, target, piece.table, space, visits)
    if found == math.inf:
        high = int(min(float(long.most), wave_of(long.waves, rim) + 1.0))
        sought = Sought(TURN, curve, target, measured)
        wave = first_wave(long, sought, min(before.wave + 1, high), high)
        if wave == high:
            return rim if high < long.most else math.inf, False
        found = turn_in(long, sought, wave)
        piece = on(measured, waves_from(long.waves, wave - 1.0, space.nodes, space.polys))
        rising, visits = trace_branches(piece, long.waves.per, space.measured)[2], 0
    if found < start_of(long.waves, long.near + 2.0):
        return 0.0, False
    tied = target_is_tied(piece, target, found, space.trace, space.visited, visits, space.measured, rising)
    return min(found, rim), tied


@inlined
def lowest_far(long: Long, curve: Curve, rim: float) -> Lowest:
    """Return the lowest load within a rim beyond the waves next to the centre, as `lowest_load` does."""
    curve, space = load_curve(curve), long.window
    high = int(min(float(long.most), wave_of(long.waves, rim)))
    wave = first_wave(long, Sought(BOTTOM, curve, 0.0, curve), long.near - 1, high)
    if wave >= long.most:
        return Lowest(0.0, 0.0, 0.0, 0.0, False)
    piece, _, _, count = trace_waves(long, curve, wave - 1.0, space)
    best = Lowest(0.0, 0.0, 0.0, 0.0, True)
    if rim <= end_of(piece.table):
        i, t = place_of(piece.table, rim)
        best = deeper(best, depth_and_load(piece, i, t)[1], rim)
    for j in range(count):
        y = space.trace[at.START, j]
        if piece.table.start < y <= rim:
            best = deeper(best, space.trace[at.START_LOAD, j], y)
    return best


@kernel
def last_fold(long: Long, curve: Curve) -> float:
    """Return the radius of the outermost fold, 0 if there is none; NaN: not within long.most waves."""
    folds, trace = end_of_folds(long, curve), long.ends.trace
    if folds == long.most:
        return math.nan
    piece, _, _, count = trace_waves(long, curve, max(folds - 2.0, float(long.near)), long.ends)
    if count == 0 or trace[at.START, 0] == piece.table.start:
        trace = long.start.trace
        count = find_folds(on(curve, long.table), start_of(long.waves, long.near + 1.0), trace)
    if count <= 0:
        return 0.0
    return float(trace[at.END, count - 1] if trace[at.END, count - 1] < math.inf else trace[at.START, count - 1])


@kernel
def _end_wave(long: Long, folds: int, rim: float) -> int:
    """Return the wave before the last two of a path, which ends at its rim or on the endless branch."""
    return int(max(min(folds - 1.0, wave_of(long.waves, rim)) - 2.0, float(long.near)))


@inlined
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
    tied: bool,
    total: Floats,
) -> Cycle:
    """Return the cycle up to a rim of a punch that ends at an `edge`; `same`: closing and opening are one curve.

    `folds`, `begun` and `starts` are those of `end_of_folds` and `begin` of closing; `tied` whether it is close that
    the cycle ends there; `total` is room, (LOSSES,).
    """
    unknown = Cycle(Loaded(0.0, 0.0, 0.0, False, False), Unloaded(0.0, 0.0, 0.0), rim, 0.0, 0.0, True, False)
    last = _end_wave(long, folds, rim)
    if last > MOST:
        return unknown
    if not begun.landed and begun.wave <= last:
        begun, _ = land(long, closing, begun)
    left = leave(long, opening, starts, last) if same else Leaving(last + 1, 0.0, 0.0, 0.0, False)
    from_top = begun.wave if begun.landed else last
    total[:] = 0.0
    if not sum_waves(long, closing, from_top, min(left.wave, last), last, folds, total):
        return unknown
    if begun.landed:
        one_disc = begun.one_disc and total[SHUT] == 0.0
        lost, jumps = begun.lost + total[OUTWARDS], begun.jumps + total[JUMPS_OUTWARDS]
        begun = Loading(begun.wave, True, begun.state, lost, jumps, 0.0, begun.snap, begun.last, one_disc, begun.tied)
    piece, _, _, count = trace_waves(long, closing, float(last), long.ends)
    if not begun.landed or left.wave > last:
        from_zero(long, last, long.ends)
    loaded, ended = finish_loading(long, piece, count, begun, last, rim, edge)
    if not loaded.known:
        return unknown
    if not same:
        folds = end_of_folds(long, opening)
        _, starts = begin(long, opening, folds)
        last = _end_wave(long, folds, rim)
        left = leave(long, opening, starts, last)
        total[:] = 0.0
        if not sum_waves(long, opening, last, min(left.wave, last), last, folds, total):
            return unknown
        piece, _, _, count = trace_waves(long, opening, float(last), long.ends)
        if left.wave > last:
            from_zero(long, last, long.ends)
    lost, jumps = left.lost + total[INWARDS], left.jumps + total[JUMPS_INWARDS]
    left = Leaving(left.wave, lost, jumps, left.depth, left.tied or (not same and rim_is_tied(piece, rim)))
    unloaded, close = finish_unloading(long, piece, count, left, starts, last, rim)
    if unloaded.lost == math.inf:
        return unknown
    return Cycle(loaded, unloaded, rim, ended.last, ended.snap, ended.one_disc, tied or ended.tied or close)
