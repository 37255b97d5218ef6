"""The cycles of scenes of one exponent, on one table.

Loading follows the curve of closing, in whose units B and g are larger by 1/sqrt(ratio), unloading that of opening
(physics 16); at ratio 1 both are one. Scenes that follow each other and differ in rim and target alone share their
traces; what each of them gets does not depend on the others.
"""

import math
from typing import NamedTuple

from gradhesion.core.curve.folds import CLOSE, find_folds
from gradhesion.core.curve.trace import END, LANDING, START
from gradhesion.core.curve.values import Curve, coordinate_of, load_curve, softness, state_at
from gradhesion.core.cycle.disc import Disc, gap_is_open, loading_is_one_disc
from gradhesion.core.cycle.path import Loaded, Unloaded, load_to, unload_from, visited_within, walk_loading
from gradhesion.core.cycle.pull_off import Filling, Lowest, lowest_load
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
from gradhesion.core.table.layout import Source, Table, end_of
from gradhesion.core.types import Floats


class Task(NamedTuple):
    """What scenes of one exponent are solved with.

    punch     what all scenes share
    wanted    what is wanted of them
    table     without pattern
    by_load   the table of the pull-off: the same, but for the leading terms of short waves
    crest     a bound of -U' y^((k-1)/2) beyond the table
    source    what bins are filled from, at rims beyond the table
    disc      what the tests of the contact need
    filling   how bins are filled for the pull-off
    rooms     room
    reach     scenes that must be known beyond it are left as SHORT
    """

    punch: Punch
    wanted: Wanted
    table: Table
    by_load: Table
    crest: float
    source: Source
    disc: Disc
    filling: Filling
    rooms: Rooms
    reach: float


class Pair(NamedTuple):
    """The curves of a scene: that of closing, and that of opening; the same without pattern; and its pattern."""

    closing: Curve
    opening: Curve
    plain: Curve  # of closing, without pattern
    pattern: Pattern
    ratio: float


@leaf
def pattern_of(punch: Punch, scenes: Floats, reduced: Floats, i: int) -> Pattern:
    """Return the pattern of toughness of scene i."""
    amplitude = scenes[PATTERN_AMPLITUDE, i]
    waves, most, steep = reduced[PATTERN_WAVES, i], reduced[MOST, i], reduced[STEEP, i]
    return Pattern(punch.rows, waves, amplitude, punch.of_work, most, steep)


@kernel
def curves_of(task: Task, scenes: Floats, reduced: Floats, i: int, y_end: float) -> Pair:
    """Return the curves of scene i, tables of an interface with a pattern filled up to y_end."""
    ratio = reduced[CLOSING, i]
    root = math.sqrt(ratio)
    B, g, by_depth, by_load = reduced[BY_POWER, i], reduced[BY_WAVES, i], reduced[BY_DEPTH, i], reduced[BY_LOAD, i]
    pattern = pattern_of(task.punch, scenes, reduced, i)
    plain = Curve(task.table, B / root, g / root, by_depth, by_load)
    if pattern.rows.shape[1] == 0:
        return Pair(plain, Curve(task.table, B, g, by_depth, by_load), plain, pattern, ratio)
    end, rooms = min(y_end, end_of(task.table)), task.rooms
    nodes, polys = rooms.closing_nodes, rooms.closing_polys
    table = patterned_table(task.table, task.crest, g / root, pattern, end, nodes, polys)
    closing = Curve(table, B / root, 1.0, by_depth, by_load)
    if ratio == 1.0:
        return Pair(closing, closing, plain, pattern, ratio)
    nodes, polys = rooms.opening_nodes, rooms.opening_polys
    table = patterned_table(task.table, task.crest, g, pattern, end, nodes, polys)
    return Pair(closing, Curve(table, B, 1.0, by_depth, by_load), plain, pattern, ratio)


@leaf
def same_curve(scenes: Floats, reduced: Floats, i: int, j: int) -> bool:
    """Return whether two scenes differ in rim and target alone."""
    same = reduced[BY_POWER, i] == reduced[BY_POWER, j] and reduced[BY_WAVES, i] == reduced[BY_WAVES, j]
    same = same and reduced[LENGTH, i] == reduced[LENGTH, j] and reduced[BY_LOAD, i] == reduced[BY_LOAD, j]
    same = (
        same and reduced[CLOSING, i] == reduced[CLOSING, j] and reduced[PATTERN_WAVES, i] == reduced[PATTERN_WAVES, j]
    )
    return same and scenes[PATTERN_AMPLITUDE, i] == scenes[PATTERN_AMPLITUDE, j]


class Walked(NamedTuple):
    """A traced and walked curve of closing."""

    pair: Pair
    count: int  # its branches; negative: the table is too short
    visits: int  # those that loading visits
    measured: Curve  # with the prescribed quantity at which cycles turn
    branches: Floats  # its trace
    measured_count: int


@kernel
def _walk(task: Task, scenes: Floats, reduced: Floats, i: int, y_end: float) -> Walked:
    """Trace the curve of closing of scene i up to y_end, and let loading go along it."""
    rooms = task.rooms
    pair = curves_of(task, scenes, reduced, i, y_end if y_end < math.inf else reduced[WINDOW, i])
    closing = pair.closing
    count = find_folds(closing, y_end, rooms.slopes, rooms.closing)
    visits = walk_loading(closing, rooms.closing, count, rooms.visited) if count >= 0 else 0
    if task.punch.turn == AT_A_LOAD and closing.by_depth > 0.0 and count >= 0:
        measured = load_curve(closing)
        rising = find_folds(measured, y_end, rooms.slopes, rooms.measured)
        return Walked(pair, count, visits, measured, rooms.measured, rising)
    measured = closing
    if task.punch.turn == AT_DEPTH:
        measured = Curve(closing.table, closing.B, closing.g, 1.0, 0.0)
    rising = count
    if task.punch.turn == AT_DEPTH and closing.by_load > 0.0 and count >= 0:
        rising = find_folds(measured, y_end, rooms.slopes, rooms.measured)
        return Walked(pair, count, visits, measured, rooms.measured, rising)
    return Walked(pair, count, visits, measured, rooms.closing, rising)


@kernel
def _turn(task: Task, walked: Walked, reduced: Floats, i: int) -> float:
    """Return where scene i turns; inf if nowhere within the table, 0 if there is no contact."""
    if task.punch.turn == AT_RIM:
        return float(reduced[RIM_Y, i])
    target = reduced[TARGET_VALUE, i] / math.sqrt(walked.pair.ratio)
    if task.punch.turn == AT_DEPTH and target < 0.0:
        return 0.0
    rooms = task.rooms
    found = turning_radius(
        walked.measured,
        target,
        rooms.closing,
        rooms.visited,
        walked.visits,
        walked.branches,
        walked.measured_count,
    )
    return min(found, float(reduced[RIM_Y, i]))


@kernel
def _snap_in(pair: Pair, source: Source, landing: float) -> float:
    """Return the pull after the jump from zero contact to a radius, at the coordinate 0, in the unit of load of closing."""
    depth, load = state_at(pair.closing, source, landing)
    stiffness = landing ** (1.0 + pair.closing.table.k)
    return stiffness * coordinate_of(pair.closing, depth, load) / softness(pair.closing, stiffness) - load


@kernel
def _loading_keeps_one_disc(task: Task, walked: Walked, y: float, rim: float) -> bool:
    """Return whether the contact stays one disc on loading up to y, where the cycle turns, and there, out to the rim."""
    rooms, plain = task.rooms, walked.pair.plain
    if not loading_is_one_disc(plain, task.disc, rooms.closing, rooms.visited, walked.visits, y, rooms.limits):
        return False
    if y >= rim:
        return True
    depth, _ = state_at(walked.pair.closing, task.source, y)
    return gap_is_open(plain, task.disc, y, depth, rim)


@kernel
def _ties(task: Task, walked: Walked, opened: int, y: float, reduced: Floats, i: int) -> bool:
    """Return whether a decision of the cycle of scene i, which turns at y, is close."""
    rooms, pair, source = task.rooms, walked.pair, task.source
    if rim_is_tied(pair.closing, y) or loading_is_tied(pair.closing, source, y, rooms.closing, walked.count):
        return True
    trace = rooms.closing if pair.ratio == 1.0 else rooms.opening
    if pair.ratio < 1.0 and rim_is_tied(pair.opening, y):
        return True
    if unloading_is_tied(pair.opening, source, y, trace, opened):
        return True
    if task.punch.turn == AT_RIM:
        return False
    target = reduced[TARGET_VALUE, i] / math.sqrt(pair.ratio)
    return target_is_tied(walked.measured, target, y, walked.branches, walked.measured_count)


@leaf
def no_value(out: Floats, i: int, status: float) -> None:
    """Store that a scene has no value."""
    out[:, i] = math.nan
    out[STATUS, i] = status


@kernel
def put_no_contact(scenes: Floats, i: int, out: Floats) -> int:
    """Store a cycle that turns before contact is made; return its status."""
    out[:, i] = 0.0
    out[PULL_OFF_RADIUS, i] = out[JUMP_OUT, i] = out[SNAP, i] = math.nan
    out[DEEPEST, i], out[STATUS, i] = scenes[TARGET, i], NO_CONTACT
    return NO_CONTACT


@kernel
def put_pull_off(lowest: Lowest, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store the pull-off of a cycle that turns at y; return its bits of status."""
    out[FORCE, i] = -lowest.load * reduced[LOAD, i] * UNIT_OF_FORCE
    out[PULL_OFF_RADIUS, i] = lowest.y * reduced[LENGTH, i]
    tied = lowest.second < lowest.load * (1.0 - CLOSE) and lowest.second_y != lowest.y
    return (PULL_OFF_AT_RIM if lowest.y == y else 0) | (CLOSE_TO_A_JUMP if tied else 0)


@kernel
def put_edge(task: Task, pair: Pair, landing: float, y: float, reduced: Floats, i: int, out: Floats) -> None:
    """Store what depends on the edge being stuck between closing and opening, for a cycle that turns at y.

    `landing` is where the jump-in lands, or the rim.
    """
    root, k = math.sqrt(pair.ratio), task.table.k
    out[FRONT, i] = out[PINNED, i] = out[SNAP, i] = 0.0
    if pair.ratio < 1.0:
        out[FRONT, i] = out[PINNED, i] = math.inf
        if y < math.inf:
            area = 2.0 * math.pi * reduced[LENGTH, i] ** 2
            out[FRONT, i] = (1.0 - pair.ratio) * area * edge_area(pair.opening.table, pair.pattern, y)
            stretch = toughness_at(pair.pattern, y) * y ** (0.5 * (1.0 - k)) * reduced[DEPTH, i]
            by_machine = softness(pair.opening, y ** (1.0 + k)) if pair.opening.by_depth > 0.0 else 1.0
            out[PINNED, i] = (1.0 - root) * stretch * by_machine
    if pair.opening.by_depth > 0.0:
        out[SNAP, i] = _snap_in(pair, task.source, landing) * root * reduced[LOAD, i] * UNIT_OF_FORCE


@kernel
def put_losses(
    task: Task,
    pair: Pair,
    loaded: Loaded,
    unloaded: Unloaded,
    y: float,
    landings: tuple[float, float],
    reduced: Floats,
    i: int,
    out: Floats,
) -> int:
    """Store what a cycle that turns at y loses, given the first and last `landings` of loading; return its bits of status."""
    area = 2.0 * math.pi * reduced[LENGTH, i] ** 2
    out[LOADING, i], out[UNLOADING, i] = loaded.lost * area * pair.ratio, unloaded.lost * area
    out[LOADING_JUMPS, i], out[UNLOADING_JUMPS, i] = loaded.jumps, unloaded.jumps
    out[DEEPEST, i] = loaded.deepest * reduced[DEPTH, i] * math.sqrt(pair.ratio)
    out[JUMP_OUT, i] = unloaded.last * reduced[DEPTH, i]
    put_edge(task, pair, landings[0], y, reduced, i, out)
    out[ENERGY, i] = out[LOADING, i] + out[UNLOADING, i] + out[FRONT, i]
    out[TURN, i], out[REACH, i] = y * reduced[LENGTH, i], landings[1] * reduced[LENGTH, i]
    return JUMP_IN_TO_RIM if loaded.in_to_rim and y == reduced[RIM_Y, i] else 0


@kernel
def _put_cycle(
    task: Task, walked: Walked, opened: int, y: float, scenes: Floats, reduced: Floats, i: int, out: Floats
) -> int:
    """Store what the cycle of scene i, which turns at y, loses; return its bits of status, -1 if the table is too short."""
    rooms, pair, source = task.rooms, walked.pair, task.source
    trace = rooms.closing if pair.ratio == 1.0 else rooms.opening
    loaded = load_to(pair.closing, source, y, rooms.closing, rooms.visited, walked.visits, task.wanted.depth)
    if not loaded.known:
        return -1
    unloaded = unload_from(pair.opening, source, y, trace, opened, rooms.stack)
    n = visited_within(rooms.closing, rooms.visited, walked.visits, y)
    landing = rooms.closing[LANDING, rooms.visited[0]] if walked.visits > 0 else math.inf
    reach = rooms.closing[LANDING, rooms.visited[n - 1]] if n > 0 else y
    landings = min(landing, reduced[RIM_Y, i]), reach
    bits = put_losses(task, pair, loaded, unloaded, y, landings, reduced, i, out)
    if task.wanted.residual:
        area = 2.0 * math.pi * reduced[LENGTH, i] ** 2
        work = work_of_cycle(
            pair.closing, pair.opening, source, y, rooms.closing, walked.visits, rooms.visited, trace, opened
        )
        out[RESIDUAL, i] = math.nan if math.isnan(work) else out[ENERGY, i] - work * area
    if task.wanted.contact and not _loading_keeps_one_disc(task, walked, y, reduced[RIM_Y, i]):
        bits |= LOADING_NOT_ONE_DISC
    if _ties(task, walked, opened, y, reduced, i):
        bits |= CLOSE_TO_A_JUMP
    return bits


@kernel
def _turns_of(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> Walked:
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
            y = _turn(task, walked, reduced, i) if walked.count >= 0 else math.nan
            if task.punch.turn != AT_RIM and y == reduced[RIM_Y, i] and far < min(y, end):
                farther = True  # not reached as far as the curve is traced
            out[TURN, i] = y
        if not farther:
            return walked
        far = min(2.0 * far, end)


@kernel
def _last_fold(task: Task, pair: Pair, walked: Walked) -> float:
    """Return the radius of the outermost fold of opening, 0 if there is none; the trace of loads is overwritten."""
    if walked.count < 0 or pair.opening.g == 0.0:
        return 0.0
    trace = task.rooms.measured
    count = find_folds(pair.opening, math.inf, task.rooms.slopes, trace)
    if count <= 0:
        return 0.0 if count == 0 else math.inf
    return trace[START, count - 1] if trace[END, count - 1] == math.inf else trace[END, count - 1]


@kernel
def solve_curve(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1, all of one curve and valid; store their results, or SHORT as status."""
    rooms = task.rooms
    walked = _turns_of(task, scenes, reduced, first, last, out)
    pair = walked.pair
    farthest = 0.0
    for i in range(first, last):
        beyond = task.punch.turn != AT_RIM and out[TURN, i] >= end_of(pair.closing.table) and walked.count >= 0
        if math.isnan(out[TURN, i]) or beyond:
            no_value(out, i, SHORT)
        else:
            farthest = max(farthest, out[TURN, i])
    opened = walked.count
    if pair.ratio < 1.0 and walked.count >= 0 and farthest > 0.0:
        opened = find_folds(pair.opening, farthest, rooms.slopes, rooms.opening)
    pull = pair.opening
    if pair.pattern.rows.shape[1] == 0:
        pull = Curve(task.by_load, pull.B, pull.g, pull.by_depth, pull.by_load)
    lowest = lowest_load(pull, farthest, task.filling) if farthest > 0.0 else Lowest(0.0, 0.0, 0.0, 0.0, True)
    last_fold = _last_fold(task, pair, walked) if task.wanted.saturation else 0.0
    rooms.limits[0], rooms.limits[1] = 0.0, -1.0
    for i in range(first, last):
        y = out[TURN, i]
        if math.isnan(y):
            continue
        if y == 0.0:
            put_no_contact(scenes, i, out)
            continue
        own = lowest
        if y < farthest and (
            lowest.y > y or lowest.second_y > y or lowest.y == farthest or lowest.second_y == farthest
        ):
            own = lowest_load(pull, y, task.filling)
        bits = -1
        if walked.count >= 0 and opened >= 0 and own.known and own.load < 0.0:
            bits = _put_cycle(task, walked, opened, y, scenes, reduced, i, out)
        if bits < 0:
            no_value(out, i, SHORT)
            continue
        out[STATUS, i] = bits | put_pull_off(own, y, reduced, i, out)
        out[SATURATION, i] = last_fold * reduced[LENGTH, i]


@leaf
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
def solve_cycles(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1 of one exponent."""
    start = first
    while start < last:
        end = start + 1
        if _may_be_solved(task, scenes, reduced, start, out):
            while (
                end < last
                and same_curve(scenes, reduced, start, end)
                and _may_be_solved(task, scenes, reduced, end, out)
            ):
                end += 1
            solve_curve(task, scenes, reduced, start, end, out)
        start = end


@kernel
def solve_forces(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the pull-off alone of scenes that end at their rims, without pattern: no trace is made."""
    for i in range(first, last):
        if not is_valid(task.punch, scenes, reduced, i):
            no_value(out, i, NO_VALUE)
            continue
        curve = Curve(task.by_load, reduced[BY_POWER, i], reduced[BY_WAVES, i], 0.0, 1.0)
        rim = reduced[RIM_Y, i]
        lowest = lowest_load(curve, rim, task.filling)
        out[:, i] = math.nan
        out[TURN, i] = rim * reduced[LENGTH, i]
        out[STATUS, i] = SHORT
        if lowest.known:
            out[STATUS, i] = put_pull_off(lowest, rim, reduced, i, out)
