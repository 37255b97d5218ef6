"""The cycles of scenes of one exponent, on one table.

Loading follows the curve of closing, in whose units B and g are larger by 1/sqrt(ratio), unloading that of opening
(physics 16); at ratio 1 both are one. Scenes that follow each other and differ in rim and target alone share their
traces; what each of them gets does not depend on the others.
"""

import math
from typing import NamedTuple

import numpy as np

from gradhesion.core.curve.folds import CLOSE, find_folds
from gradhesion.core.curve.levels import polished
from gradhesion.core.curve.trace import END, END_LEVEL, LANDING, START
from gradhesion.core.curve.values import Curve, softness, state_in
from gradhesion.core.cycle.disc import Disc, gap_is_open, loading_is_one_disc
from gradhesion.core.cycle.path import Loaded, Unloaded, load_to, snap_in, unload_from, visited_within, walk_loading
from gradhesion.core.cycle.pull_off import Lowest, lowest_load
from gradhesion.core.cycle.residual import work_of_cycle
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, target_is_tied, unloading_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.edge.pattern import Pattern, edge_area, patterned_table, toughness_at
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_CONTACT,
    NO_VALUE,
    PULL_OFF_AT_RIM,
)
from gradhesion.core.scenes.reduced import (
    AT_A_LOAD,
    AT_DEPTH,
    AT_RIM,
    BY_DEPTH,
    BY_LOAD,
    BY_POWER,
    BY_WAVES,
    CLOSING,
    DEPTH,
    LENGTH,
    LOAD,
    MOST,
    NEED,
    PATTERN_AMPLITUDE,
    PATTERN_WAVES,
    RIM_Y,
    STEEP,
    TARGET,
    TARGET_VALUE,
    UNIT_OF_FORCE,
    WINDOW,
    Punch,
    is_valid,
)
from gradhesion.core.scenes.results import (
    DEEPEST,
    ENERGY,
    FORCE,
    FRONT,
    JUMP_OUT,
    LOADING,
    LOADING_JUMPS,
    PINNED,
    PULL_OFF_RADIUS,
    REACH,
    RESIDUAL,
    SATURATION,
    SHORT,
    SNAP,
    STATUS,
    TURN,
    UNLOADING,
    UNLOADING_JUMPS,
    Rooms,
    Wanted,
)
from gradhesion.core.table.layout import Table, end_of
from gradhesion.core.types import Floats


class Task(NamedTuple):
    """What scenes of one exponent are solved with.

    punch     what all scenes share
    wanted    what is wanted of them
    table     without pattern
    by_load   the table of the pull-off: the same, but for the leading terms of short waves
    crest     a bound of -U' y^((k-1)/2) beyond the table
    disc      what the tests of the contact need
    rooms     room
    reach     scenes that must be known beyond it are left as SHORT
    """

    punch: Punch
    wanted: Wanted
    table: Table
    by_load: Table
    crest: float
    disc: Disc
    rooms: Rooms
    reach: float


class Walked(NamedTuple):
    """The curves of a scene, that of closing traced and walked."""

    closing: Curve
    opening: Curve
    pattern: Pattern
    ratio: float  # of the works of closing and opening
    limits: Floats  # (2,): those of `loading_is_one_disc`
    branches: int  # of closing; negative: the table is too short
    visits: int  # those that loading visits
    measured: int  # branches of the depth or load at which cycles turn, of a trace of its own; -1: those of closing


CLOSING_TRACE, OPENING_TRACE, MEASURED_TRACE = range(3)


@kernel
def pattern_of(punch: Punch, scenes: Floats, reduced: Floats, i: int) -> Pattern:
    """Return the pattern of toughness of scene i."""
    amplitude = scenes[PATTERN_AMPLITUDE, i]
    waves, most, steep = reduced[PATTERN_WAVES, i], reduced[MOST, i], reduced[STEEP, i]
    return Pattern(punch.rows, waves, amplitude, punch.of_work, most, steep)


@kernel
def curve_of(
    table: Table,
    crest: float,
    pattern: Pattern,
    reduced: Floats,
    i: int,
    root: float,
    y_end: float,
    nodes: Floats,
    polys: Floats,
) -> Curve:
    """Return a curve of scene i, sizes over `root`: on a table, or of a table with its pattern, filled up to y_end.

    `crest` is that of a task, `nodes` and `polys` are room for the table with a pattern.
    """
    B, g = reduced[BY_POWER, i] / root, reduced[BY_WAVES, i] / root
    if pattern.rows.shape[1] > 0:
        table = patterned_table(table, crest, g, pattern, min(y_end, end_of(table)), nodes, polys)
        g = 1.0
    return Curve(table, B, g, reduced[BY_DEPTH, i], reduced[BY_LOAD, i])


@kernel
def same_curve(scenes: Floats, reduced: Floats, i: int, j: int) -> bool:
    """Return whether two scenes differ in rim and target alone."""
    for row in (BY_POWER, BY_WAVES, LENGTH, BY_LOAD, CLOSING, PATTERN_WAVES):
        if reduced[row, i] != reduced[row, j]:
            return False
    return bool(scenes[PATTERN_AMPLITUDE, i] == scenes[PATTERN_AMPLITUDE, j])


@leaf
def measured_curve(curve: Curve, turn: int) -> Curve:
    """Return the curve with that prescribed at which cycles turn."""
    if turn == AT_A_LOAD:
        return Curve(curve.table, curve.B, curve.g, 0.0, 1.0)
    return Curve(curve.table, curve.B, curve.g, 1.0, 0.0)


@kernel
def _walk(task: Task, scenes: Floats, reduced: Floats, i: int, y_end: float) -> Walked:
    """Trace the curve of closing of scene i up to y_end, and let loading go along it."""
    rooms, turn = task.rooms, task.punch.turn
    ratio = reduced[CLOSING, i]
    pattern = pattern_of(task.punch, scenes, reduced, i)
    nodes, polys, table, crest = rooms.nodes, rooms.polys, task.table, task.crest
    closing = curve_of(table, crest, pattern, reduced, i, math.sqrt(ratio), y_end, nodes[0], polys[0])
    opening = closing
    if ratio != 1.0:
        opening = curve_of(table, crest, pattern, reduced, i, 1.0, y_end, nodes[1], polys[1])
    trace = rooms.traces[CLOSING_TRACE]
    count = find_folds(closing, y_end, trace)
    visits, measured = 0, -1
    if count >= 0:
        visits = walk_loading(closing, trace, count, rooms.columns[0])
        if turn != AT_RIM:  # losses forgive the error of a landing, but not where a cycle turns
            level = 0.0
            for v in range(visits):
                j = rooms.columns[0, v]
                trace[LANDING, j] = polished(closing, trace[LANDING, j], level)
                level = trace[END_LEVEL, j]
        own = measured_curve(closing, turn)
        if (turn != AT_RIM and own.by_depth != closing.by_depth) or (turn == AT_DEPTH and closing.by_load > 0.0):
            measured = find_folds(own, y_end, rooms.traces[MEASURED_TRACE])
    limits = np.array([0.0, -1.0])
    return Walked(closing, opening, pattern, ratio, limits, count, visits, measured)


@kernel
def _turn(task: Task, walked: Walked, reduced: Floats, i: int) -> float:
    """Return where scene i turns; its rim if nowhere within the table before, 0 if there is no contact."""
    if task.punch.turn == AT_RIM:
        return float(reduced[RIM_Y, i])
    target = reduced[TARGET_VALUE, i] / math.sqrt(walked.ratio)
    if task.punch.turn == AT_DEPTH and target < 0.0:
        return 0.0
    rooms = task.rooms
    own = walked.measured >= 0
    found = turning_radius(
        measured_curve(walked.closing, task.punch.turn),
        target,
        rooms.traces[CLOSING_TRACE],
        rooms.columns[0],
        walked.visits,
        rooms.traces[MEASURED_TRACE if own else CLOSING_TRACE],
        walked.measured if own else walked.branches,
    )
    return min(found, float(reduced[RIM_Y, i]))


@kernel
def _loading_keeps_one_disc(task: Task, walked: Walked, y: float, reduced: Floats, i: int) -> bool:
    """Return whether the contact stays one disc on loading up to y, where the cycle turns, and around it there."""
    rooms, rim, root = task.rooms, reduced[RIM_Y, i], math.sqrt(walked.ratio)
    weights = walked.closing
    plain = Curve(
        task.table, reduced[BY_POWER, i] / root, reduced[BY_WAVES, i] / root, weights.by_depth, weights.by_load
    )
    trace, visited = rooms.traces[CLOSING_TRACE], rooms.columns[0]
    if not loading_is_one_disc(plain, task.disc, trace, visited, walked.visits, y, walked.limits):
        return False
    if y >= rim:
        return True
    depth, _ = state_in(walked.closing, y)
    return gap_is_open(plain, task.disc, y, depth, rim)


@kernel
def _is_tied(task: Task, walked: Walked, opened: int, y: float, reduced: Floats, i: int) -> bool:
    """Return whether a decision of the cycle of scene i, which turns at y, is close."""
    traces, closing, opening = task.rooms.traces, walked.closing, walked.opening
    at_rim = y >= reduced[RIM_Y, i]
    if rim_is_tied(closing, y) or loading_is_tied(closing, y, at_rim, traces[CLOSING_TRACE], walked.branches):
        return True
    if walked.ratio < 1.0 and rim_is_tied(opening, y):
        return True
    if unloading_is_tied(opening, y, traces[CLOSING_TRACE if walked.ratio == 1.0 else OPENING_TRACE], opened):
        return True
    if task.punch.turn == AT_RIM:
        return False
    target = reduced[TARGET_VALUE, i] / math.sqrt(walked.ratio)
    own = walked.measured >= 0
    branches = traces[MEASURED_TRACE if own else CLOSING_TRACE]
    count = walked.measured if own else walked.branches
    return target_is_tied(measured_curve(closing, task.punch.turn), target, y, branches, count)


@leaf
def no_value(out: Floats, i: int, status: float) -> None:
    """Store that a scene has no value."""
    out[:, i] = math.nan
    out[STATUS, i] = status


@kernel
def put_no_contact(scenes: Floats, i: int, out: Floats) -> None:
    """Store a cycle that turns before contact is made."""
    out[:, i] = 0.0
    out[PULL_OFF_RADIUS, i] = out[JUMP_OUT, i] = out[SNAP, i] = math.nan
    out[DEEPEST, i], out[STATUS, i] = scenes[TARGET, i], NO_CONTACT


@kernel
def put_pull_off(lowest: Lowest, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store the pull-off of a cycle that turns at y; return its bits of status."""
    if not lowest.load < 0.0:  # a centre without toughness: the contact shrinks to a point, and never pulls
        out[FORCE, i], out[PULL_OFF_RADIUS, i] = 0.0, math.nan
        return 0
    out[FORCE, i] = -lowest.load * reduced[LOAD, i] * UNIT_OF_FORCE
    out[PULL_OFF_RADIUS, i] = lowest.y * reduced[LENGTH, i]
    tied = lowest.second < lowest.load * (1.0 - CLOSE) and lowest.second_y != lowest.y
    return (PULL_OFF_AT_RIM if lowest.y == y else 0) | (CLOSE_TO_A_JUMP if tied else 0)


@kernel
def _put_edge(opening: Curve, pattern: Pattern, ratio: float, y: float, reduced: Floats, i: int, out: Floats) -> None:
    """Store what depends on the edge being stuck between closing and opening, for a cycle that turns at y."""
    root, k = math.sqrt(ratio), opening.table.k
    out[FRONT, i] = out[PINNED, i] = 0.0
    if ratio == 1.0:
        return
    out[FRONT, i] = out[PINNED, i] = math.inf
    if y < math.inf:
        area = 2.0 * math.pi * reduced[LENGTH, i] ** 2
        out[FRONT, i] = (1.0 - ratio) * area * edge_area(opening.table, pattern, y)
        stretch = toughness_at(pattern, y) * y ** (0.5 * (1.0 - k)) * reduced[DEPTH, i]
        by_machine = softness(opening, y ** (1.0 + k)) if opening.by_depth > 0.0 else 1.0
        out[PINNED, i] = (1.0 - root) * stretch * by_machine


class Cycle(NamedTuple):
    """What a cycle has lost, in the units of its curves.

    turn      the radius at which it turns
    reach     of the last landing of loading
    snap      the pull after the jump-in
    """

    loaded: Loaded
    unloaded: Unloaded
    turn: float
    reach: float
    snap: float


@kernel
def put_losses(
    cycle: Cycle, opening: Curve, pattern: Pattern, ratio: float, reduced: Floats, i: int, out: Floats
) -> int:
    """Store what the cycle of scene i loses; return its bits of status."""
    area, root = 2.0 * math.pi * reduced[LENGTH, i] ** 2, math.sqrt(ratio)
    loaded, unloaded = cycle.loaded, cycle.unloaded
    out[LOADING, i], out[UNLOADING, i] = loaded.lost * area * ratio, unloaded.lost * area
    out[LOADING_JUMPS, i], out[UNLOADING_JUMPS, i] = loaded.jumps, unloaded.jumps
    out[DEEPEST, i], out[JUMP_OUT, i] = loaded.deepest * reduced[DEPTH, i] * root, unloaded.last * reduced[DEPTH, i]
    out[SNAP, i] = cycle.snap * root * reduced[LOAD, i] * UNIT_OF_FORCE if opening.by_depth > 0.0 else 0.0
    _put_edge(opening, pattern, ratio, cycle.turn, reduced, i, out)
    out[ENERGY, i] = out[LOADING, i] + out[UNLOADING, i] + out[FRONT, i]
    out[TURN, i], out[REACH, i] = cycle.turn * reduced[LENGTH, i], cycle.reach * reduced[LENGTH, i]
    return JUMP_IN_TO_RIM if loaded.in_to_rim and cycle.turn == reduced[RIM_Y, i] else 0


@kernel
def _put_cycle(task: Task, walked: Walked, opened: int, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store what the cycle of scene i, which turns at y, loses; return its bits of status, -1: too short a table."""
    rooms, closing, opening = task.rooms, walked.closing, walked.opening
    loading, visited = rooms.traces[CLOSING_TRACE], rooms.columns[0]
    unloading = loading if walked.ratio == 1.0 else rooms.traces[OPENING_TRACE]
    loaded = load_to(closing, y, loading, visited, walked.visits)
    if not loaded.known:
        return -1
    unloaded = unload_from(opening, y, unloading, opened, rooms.columns[1])
    n = visited_within(loading, visited, walked.visits, y)
    beyond = n > 0 and y == reduced[RIM_Y, i] and reduced[WINDOW, i] < y <= loading[END, visited[n - 1]]
    if beyond and walked.pattern.rows.shape[1] == 0:
        # on the endless branch: whether the table reaches to this rim depends on the scenes beside (far_rims)
        loaded = Loaded(loaded.lost, loaded.jumps, math.inf, loaded.in_to_rim, True)
    reach = loading[LANDING, visited[n - 1]] if n > 0 else y
    landing = min(loading[LANDING, visited[0]] if walked.visits > 0 else math.inf, reduced[RIM_Y, i])
    cycle = Cycle(loaded, unloaded, y, reach, snap_in(closing, landing))
    bits = put_losses(cycle, opening, walked.pattern, walked.ratio, reduced, i, out)
    if task.wanted.residual:
        top = y  # where one curve leads out beyond the last landing and back, its load does no work
        if walked.ratio == 1.0 and n > 0 and loading[END, visited[n - 1]] == math.inf:
            top = min(y, 1.01 * reach, end_of(closing.table))
        work = work_of_cycle(closing, opening, top, loading, walked.visits, visited, unloading, opened)
        out[RESIDUAL, i] = out[ENERGY, i] - work * 2.0 * math.pi * reduced[LENGTH, i] ** 2
    if task.wanted.contact and not _loading_keeps_one_disc(task, walked, y, reduced, i):
        bits |= LOADING_NOT_ONE_DISC
    if _is_tied(task, walked, opened, y, reduced, i):
        bits |= CLOSE_TO_A_JUMP
    return bits


@kernel
def turns_of(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> Walked:
    """Store where scenes of one curve turn, in TURN, as a reduced radius; return their curve of closing as walked.

    The curve is traced as far as some scene is sure to turn, and farther where a jump has passed its target.
    """
    far = 0.0
    for i in range(first, last):
        far = max(far, reduced[NEED, i] if task.punch.turn != AT_RIM else reduced[RIM_Y, i])
    end = end_of(task.table)
    while True:
        walked = _walk(task, scenes, reduced, first, far)
        farther = False
        for i in range(first, last):
            y = _turn(task, walked, reduced, i) if walked.branches >= 0 else math.nan
            if task.punch.turn != AT_RIM and y == reduced[RIM_Y, i] and far < min(y, end):
                farther = True  # not reached as far as the curve is traced
            out[TURN, i] = y
        if not farther:
            return walked
        far = min(2.0 * far, end)


@kernel
def _last_fold(task: Task, walked: Walked) -> float:
    """Return the radius of the outermost fold of opening, 0 if there is none; the third trace is overwritten."""
    if walked.branches < 0:
        return 0.0
    trace = task.rooms.traces[MEASURED_TRACE]
    count = find_folds(walked.opening, math.inf, trace)
    if count <= 0:
        return 0.0 if count == 0 else math.inf
    return float(trace[START, count - 1] if trace[END, count - 1] == math.inf else trace[END, count - 1])


@kernel
def open_curve(task: Task, walked: Walked, first: int, last: int, out: Floats) -> tuple[int, float]:
    """Trace the curve of opening of scenes whose TURN is stored; return its branches and the farthest turn.

    Those that turn beyond the table get SHORT as status and no TURN.
    """
    end, farthest = end_of(walked.opening.table), 0.0
    for i in range(first, last):
        beyond = task.punch.turn != AT_RIM and out[TURN, i] >= end and walked.branches >= 0
        if math.isnan(out[TURN, i]) or beyond:
            no_value(out, i, SHORT)
        else:
            farthest = max(farthest, out[TURN, i])
    opened = walked.branches
    if walked.ratio < 1.0 and walked.branches >= 0 and farthest > 0.0:
        opened = find_folds(walked.opening, farthest, task.rooms.traces[OPENING_TRACE])
    return opened, farthest


@kernel
def solve_curve(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1, all of one curve and valid; store their results, or SHORT as status."""
    walked = turns_of(task, scenes, reduced, first, last, out)
    opening = walked.opening
    opened, farthest = open_curve(task, walked, first, last, out)
    table = task.by_load if walked.pattern.rows.shape[1] == 0 else opening.table
    pull = Curve(table, opening.B, opening.g, 0.0, 1.0)
    lowest = Lowest(0.0, 0.0, 0.0, 0.0, True)
    if farthest > 0.0:
        lowest = lowest_load(pull, farthest, 0, table.bins)
    last_fold = _last_fold(task, walked) if task.wanted.saturation else 0.0
    for i in range(first, last):
        y = out[TURN, i]
        if math.isnan(y):
            continue
        if y == 0.0:
            put_no_contact(scenes, i, out)
            continue
        own = lowest
        if y < farthest and max(lowest.y, lowest.second_y) > y:
            own = lowest_load(pull, y, 0, table.bins)
        bits = -1
        if walked.branches >= 0 and opened >= 0 and own.known and (own.load < 0.0 or task.punch.rows.shape[1] > 0):
            bits = _put_cycle(task, walked, opened, y, reduced, i, out)
        if bits < 0:
            no_value(out, i, SHORT)
            continue
        out[STATUS, i] = bits | put_pull_off(own, y, reduced, i, out)
        out[SATURATION, i] = last_fold * reduced[LENGTH, i]


@kernel
def _may_be_solved(task: Task, scenes: Floats, reduced: Floats, i: int, out: Floats) -> bool:
    """Return whether scene i is valid and within reach; store what it is if not."""
    if not is_valid(task.punch, scenes, reduced, i):
        no_value(out, i, NO_VALUE)
        return False
    if reduced[NEED, i] > task.reach:
        no_value(out, i, SHORT)
        return False
    return True


@kernel
def curve_end(task: Task, scenes: Floats, reduced: Floats, start: int, last: int, out: Floats) -> int:
    """Return the end of the scenes from `start` on that share its curve; `start` if it cannot be solved (stored)."""
    end = start
    while end < last and (end == start or same_curve(scenes, reduced, start, end)):  # NaN is no curve, not even its own
        if not _may_be_solved(task, scenes, reduced, end, out):
            return end
        end += 1
    return end


@kernel
def put_force(lowest: Lowest, reduced: Floats, i: int, out: Floats) -> None:
    """Store the pull-off of scene i, whose cycle ends at its rim, and nothing else."""
    out[:, i] = math.nan
    out[TURN, i] = reduced[RIM_Y, i] * reduced[LENGTH, i]
    out[STATUS, i] = put_pull_off(lowest, reduced[RIM_Y, i], reduced, i, out) if lowest.known else SHORT


@kernel
def solve_patterned_forces(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the pull-off alone of the scenes `first` to `last` - 1 with a pattern: no farther than it can be."""
    rooms = task.rooms
    for i in range(first, last):
        if not _may_be_solved(task, scenes, reduced, i, out):
            continue
        pattern = pattern_of(task.punch, scenes, reduced, i)
        lowest = Lowest(0.0, 0.0, 0.0, 0.0, False)
        for y_end in (reduced[NEED, i], end_of(task.table)):
            if not lowest.known:
                own = curve_of(task.table, task.crest, pattern, reduced, i, 1.0, y_end, rooms.nodes[0], rooms.polys[0])
                pull = Curve(own.table, own.B, own.g, 0.0, 1.0)
                lowest = lowest_load(pull, reduced[RIM_Y, i], 0, own.table.bins)
        put_force(lowest, reduced, i, out)


@kernel
def solve_cycles(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1 of one exponent."""
    if not task.wanted.cycle and task.punch.turn == AT_RIM and task.punch.rows.shape[1] > 0:
        solve_patterned_forces(task, scenes, reduced, first, last, out)
        return
    start = first
    while start < last:
        end = curve_end(task, scenes, reduced, start, last, out)
        if end > start:
            solve_curve(task, scenes, reduced, start, end, out)
        start = max(end, start + 1)
