"""The cycles of scenes of one exponent, on one table.

Loading follows the curve of closing, in whose units B and g are larger by 1/sqrt(ratio), unloading that of opening
(physics 16); at ratio 1 both are one. Scenes that follow each other and differ in rim and target alone share their
traces; what each of them gets does not depend on the others.
"""

import math
from typing import NamedTuple

from gradhesion.core.curve.folds import find_folds
from gradhesion.core.curve.levels import polished
from gradhesion.core.curve.trace import END, END_LEVEL, LANDING, START
from gradhesion.core.curve.values import Curve, load_curve, state_in
from gradhesion.core.cycle.disc import gap_is_open, loading_is_one_disc
from gradhesion.core.cycle.jumps import list_loading_jumps, list_unloading_jumps
from gradhesion.core.cycle.path import Cycle, Loaded, load_to, snap_in, unload_from, visited_within, walk_loading
from gradhesion.core.cycle.pull_off import Lowest, lowest_load, serves
from gradhesion.core.cycle.residual import work_of_cycle
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, target_is_tied, unloading_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.edge.pattern import Pattern, patterned_table
from gradhesion.core.jit import inlined, kernel, leaf
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scenes import results
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import AT_A_LOAD, AT_DEPTH, AT_RIM, Punch
from gradhesion.core.scenes.tables import Rooms, Task
from gradhesion.core.table.layout import Table, end_of
from gradhesion.core.types import Floats, Integers


class Walked(NamedTuple):
    """The curves of a scene, that of closing traced and walked.

    closing, opening    the curves, which are one at ratio 1
    pattern             of toughness
    ratio               of the works of closing and opening
    loading, unloading  traces of the two, which are one at ratio 1
    turning             a trace of what is measured where cycles turn: that of closing if that is prescribed
    columns             those that loading visits, and a stack of unloading, (2, branches)
    branches, opened    of closing and of opening; negative: the table is too short
    visits              those that loading visits
    measured            branches of `turning`
    farthest            radius at which one of its scenes turns
    """

    closing: Curve
    opening: Curve
    pattern: Pattern
    ratio: float
    loading: Floats
    unloading: Floats
    turning: Floats
    columns: Integers
    branches: int
    opened: int
    visits: int
    measured: int
    farthest: float


CLOSING_TRACE, OPENING_TRACE, MEASURED_TRACE = range(3)


@kernel
def pattern_of(punch: Punch, scenes: Floats, reduced: Floats, i: int) -> Pattern:
    """Return the pattern of toughness of scene i."""
    amplitude = scenes[at.PATTERN_AMPLITUDE, i]
    waves, most, steep = reduced[at.PATTERN_WAVES, i], reduced[at.MOST, i], reduced[at.STEEP, i]
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
    B, g = reduced[at.BY_POWER, i] / root, reduced[at.BY_WAVES, i] / root
    if pattern.rows.shape[1] > 0:
        table = patterned_table(table, crest, g, pattern, min(y_end, end_of(table)), nodes, polys)
        g = 1.0
    return Curve(table, B, g, reduced[at.BY_DEPTH, i], reduced[at.BY_LOAD, i])


@leaf
def curves_of(
    table: Table, crest: float, rooms: Rooms, pattern: Pattern, reduced: Floats, i: int, y_end: float
) -> tuple[Curve, Curve]:
    """Return the curves of closing and of opening of scene i, which are one where both have the same work.

    `crest` is that of a task, `rooms` have room for tables with a pattern, which are filled up to y_end.
    """
    ratio = reduced[at.CLOSING, i]
    closing = curve_of(table, crest, pattern, reduced, i, math.sqrt(ratio), y_end, rooms.nodes[0], rooms.polys[0])
    opening = closing
    if ratio != 1.0:
        opening = curve_of(table, crest, pattern, reduced, i, 1.0, y_end, rooms.nodes[1], rooms.polys[1])
    return closing, opening


@kernel
def same_curve(scenes: Floats, reduced: Floats, i: int, j: int) -> bool:
    """Return whether two scenes differ in rim and target alone."""
    for row in (at.EXPONENT, at.BY_POWER, at.BY_WAVES, at.LENGTH, at.BY_LOAD, at.CLOSING, at.PATTERN_WAVES):
        if reduced[row, i] != reduced[row, j]:
            return False
    return bool(scenes[at.PATTERN_AMPLITUDE, i] == scenes[at.PATTERN_AMPLITUDE, j])


@leaf
def measured_curve(curve: Curve, turn: int) -> Curve:
    """Return the curve with that prescribed at which cycles turn."""
    if turn == AT_A_LOAD:
        return Curve(curve.table, curve.B, curve.g, 0.0, 1.0)
    return Curve(curve.table, curve.B, curve.g, 1.0, 0.0)


@kernel
def _polish_landings(closing: Curve, loading: Floats, visited: Integers, visits: int) -> None:
    """Bring the radii at which loading lands to rounding."""
    level = 0.0
    for v in range(visits):
        j = visited[v]
        loading[LANDING, j] = polished(closing, loading[LANDING, j], level)
        level = loading[END_LEVEL, j]


@leaf
def _loading_keeps_one_disc(task: Task, walked: Walked, y: float, reduced: Floats, i: int) -> bool:
    """Return whether the contact stays one disc on loading up to y, where the cycle turns, and around it there."""
    rim, root, plain = reduced[at.RIM_Y, i], math.sqrt(walked.ratio), walked.closing
    if walked.pattern.rows.shape[1] > 0:
        B, g = reduced[at.BY_POWER, i] / root, reduced[at.BY_WAVES, i] / root
        plain = Curve(task.table, B, g, plain.by_depth, plain.by_load)
    visited, visits = walked.columns[0], walked.visits
    one = loading_is_one_disc(plain, task.disc, walked.loading, visited, visits, y, task.rooms.limits)
    if one and y < rim:
        depth, _ = state_in(walked.closing, y)
        one = gap_is_open(plain, task.disc, y, depth, rim)
    return one


@leaf
def _is_tied(walked: Walked, turn: int, y: float, reduced: Floats, i: int) -> bool:
    """Return whether a decision of the cycle of scene i, which turns at y, is close."""
    closing, opening, trace = walked.closing, walked.opening, walked.loading
    at_rim = y >= reduced[at.RIM_Y, i]
    tied = rim_is_tied(closing, y) or loading_is_tied(closing, y, at_rim, trace, walked.branches)
    tied = tied or (walked.ratio < 1.0 and rim_is_tied(opening, y))
    tied = tied or unloading_is_tied(opening, y, walked.unloading, walked.opened)
    if turn == AT_RIM or tied:
        return tied
    own, target = measured_curve(closing, turn), reduced[at.TARGET_VALUE, i] / math.sqrt(walked.ratio)
    visited, visits = walked.columns[0], walked.visits
    return target_is_tied(own, target, y, trace, visited, visits, walked.turning, walked.measured)


@leaf
def _put_cycle(walked: Walked, task: Task, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store what the cycle of scene i, which turns at y, loses; return its bits of status, -1: too short a table."""
    closing, opening, loading, visited = walked.closing, walked.opening, walked.loading, walked.columns[0]
    loaded = load_to(closing, y, loading, visited, walked.visits)
    if not loaded.known:
        return -1
    unloaded = unload_from(opening, y, walked.unloading, walked.opened, walked.columns[1])
    n, rim = visited_within(loading, visited, walked.visits, y), reduced[at.RIM_Y, i]
    beyond = n > 0 and y == rim and reduced[at.WINDOW, i] < y <= loading[END, visited[n - 1]]
    if beyond and walked.pattern.rows.shape[1] == 0:
        # on the endless branch: whether the table reaches to this rim depends on the scenes beside (far_rims)
        loaded = Loaded(loaded.lost, loaded.jumps, math.inf, loaded.in_to_rim, True)
    reach = loading[LANDING, visited[n - 1]] if n > 0 else y
    landing = min(loading[LANDING, visited[0]] if walked.visits > 0 else math.inf, rim)
    one_disc = not task.wanted.contact or _loading_keeps_one_disc(task, walked, y, reduced, i)
    tied = _is_tied(walked, task.punch.turn, y, reduced, i)
    cycle = Cycle(loaded, unloaded, y, reach, snap_in(closing, landing), one_disc, tied)
    bits = results.put_losses(cycle, opening, walked.pattern, walked.ratio, reduced, i, out)
    if task.wanted.residual:
        jumps, count, total = task.rooms.jumps, 0, 0
        top = y  # where one curve leads out beyond the last landing and back, its load does no work
        if walked.ratio == 1.0 and n > 0 and loading[END, visited[n - 1]] == math.inf:
            top = min(y, 1.01 * reach, end_of(closing.table))
        if top <= end_of(closing.table):
            count = list_loading_jumps(closing, top, loading, visited, walked.visits, jumps)
            total = list_unloading_jumps(opening, top, walked.unloading, walked.opened, jumps, count)
        work = work_of_cycle(closing, opening, top, jumps, count, total)
        out[results.RESIDUAL, i] = out[results.ENERGY, i] - work * 2.0 * math.pi * reduced[at.LENGTH, i] ** 2
    return bits


@leaf
def walk_curve(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> Walked:
    """Trace and walk the curves that scenes share; store where they turn, in TURN, as a reduced radius.

    The curve of closing is traced as far as some scene is sure to turn, and farther where a jump has passed its target.
    Scenes that turn beyond the table get SHORT as status and no TURN.
    """
    rooms, turn, end, far = task.rooms, task.punch.turn, end_of(task.table), 0.0
    pattern, ratio = pattern_of(task.punch, scenes, reduced, first), reduced[at.CLOSING, first]
    loading, columns = rooms.traces[CLOSING_TRACE], rooms.columns
    for i in range(first, last):
        far = max(far, reduced[at.NEED, i] if turn != AT_RIM else reduced[at.RIM_Y, i])
    farther = True
    while farther:
        closing, opening = curves_of(task.table, task.crest, rooms, pattern, reduced, first, far)
        own, turning = measured_curve(closing, turn), loading
        rooms.limits[0], rooms.limits[1] = 0.0, -1.0
        branches, visits = find_folds(closing, far, loading), 0
        measured = branches
        if branches >= 0:
            visits = walk_loading(closing, loading, branches, columns[0])
        if branches >= 0 and turn != AT_RIM:  # losses forgive the error of a landing, but not where a cycle turns
            _polish_landings(closing, loading, columns[0], visits)
            if own.by_depth != closing.by_depth or own.by_load != closing.by_load:
                turning = rooms.traces[MEASURED_TRACE]
                measured = find_folds(own, far, turning)
        farther = False
        for i in range(first, last):
            rim, target = reduced[at.RIM_Y, i], reduced[at.TARGET_VALUE, i] / math.sqrt(ratio)
            y = rim if branches >= 0 else math.nan
            if branches >= 0 and turn != AT_RIM:
                y = 0.0
                if turn != AT_DEPTH or target >= 0.0:
                    y = min(turning_radius(own, target, loading, columns[0], visits, turning, measured), rim)
                farther = farther or (y == rim and far < min(rim, end))  # not reached as far as the curve is traced
            out[results.TURN, i] = y
        far = min(2.0 * far, end)
    opened, farthest = branches, 0.0
    for i in range(first, last):
        y = out[results.TURN, i]
        if math.isnan(y) or (turn != AT_RIM and y >= end and branches >= 0):
            results.no_value(out, i, results.SHORT)
        else:
            farthest = max(farthest, y)
    unloading = loading if ratio == 1.0 else rooms.traces[OPENING_TRACE]
    if ratio < 1.0 and branches >= 0 and farthest > 0.0:
        opened = find_folds(opening, farthest, unloading)
    traces = loading, unloading, turning, columns
    return Walked(closing, opening, pattern, ratio, *traces, branches, opened, visits, measured, farthest)


@kernel
def _last_fold(opening: Curve, trace: Floats) -> float:
    """Return the radius of the outermost fold of opening, 0 if there is none; NaN: the table is too short."""
    count = find_folds(opening, math.inf, trace)
    if count <= 0:
        return 0.0 if count == 0 else math.nan
    return float(trace[START, count - 1] if trace[END, count - 1] == math.inf else trace[END, count - 1])


@inlined
def solve_curve(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1, all of one curve and valid; store their results, or SHORT as status."""
    walked = walk_curve(task, scenes, reduced, first, last, out)
    patterned, farthest = walked.pattern.rows.shape[1] > 0, walked.farthest
    pull = load_curve(walked.opening)
    if not patterned:
        pull = Curve(task.by_load, pull.B, pull.g, 0.0, 1.0)
    lowest, bins = Lowest(0.0, 0.0, 0.0, 0.0, True), pull.table.bins
    if farthest > 0.0:
        lowest = lowest_load(pull, farthest, 0, bins)
    for i in range(first, last):
        y = out[results.TURN, i]
        if math.isnan(y):
            continue
        if y == 0.0:
            results.put_no_contact(scenes, i, out)
            continue
        own, bits = lowest, -1
        if not serves(lowest, farthest, y):
            own = lowest_load(pull, y, 0, bins)
        if walked.branches >= 0 and walked.opened >= 0 and own.known and (own.load < 0.0 or patterned):
            bits = _put_cycle(walked, task, y, reduced, i, out)
        if bits >= 0:
            out[results.STATUS, i] = bits | results.put_pull_off(own, y, reduced, i, out)
        else:
            results.no_value(out, i, results.SHORT)


@kernel
def curve_end(reach: float, scenes: Floats, reduced: Floats, start: int, last: int, out: Floats) -> int:
    """Return the end of the scenes from `start` on that share its curve; `start` if it cannot be solved (stored).

    Scenes that must be known beyond `reach` are left as SHORT.
    """
    end, solvable = start, True
    while end < last and solvable and (end == start or same_curve(scenes, reduced, start, end)):  # NaN is no curve
        solvable = reduced[at.VALID, end] > 0.0 and reduced[at.NEED, end] <= reach
        if solvable:
            end += 1
        else:
            results.no_value(out, end, results.SHORT if reduced[at.VALID, end] > 0.0 else NO_VALUE)
    return end


@leaf
def _solve_forces(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the pull-off alone of the scenes `first` to `last` - 1: with a pattern no farther than it can be."""
    table, nodes, polys = task.by_load, task.rooms.nodes[0], task.rooms.polys[0]
    for i in range(first, last):
        if curve_end(task.reach, scenes, reduced, i, i + 1, out) == i:
            continue
        pattern, lowest = pattern_of(task.punch, scenes, reduced, i), Lowest(0.0, 0.0, 0.0, 0.0, False)
        for y_end in (reduced[at.NEED, i], end_of(table)):
            if not lowest.known:
                own = curve_of(table, task.crest, pattern, reduced, i, 1.0, y_end, nodes, polys)
                lowest = lowest_load(own, reduced[at.RIM_Y, i], 0, own.table.bins)
        results.put_force(lowest, reduced, i, out)


@leaf
def _fill_saturation(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Store the outermost folds of the scenes `first` to `last` - 1."""
    nodes, polys = task.rooms.nodes[0], task.rooms.polys[0]
    for i in range(first, last):
        y = math.inf
        if reduced[at.WINDOW, i] < math.inf or not reduced[at.VALID, i]:
            if curve_end(task.reach, scenes, reduced, i, i + 1, out) == i:
                continue
            pattern = pattern_of(task.punch, scenes, reduced, i)
            own = curve_of(task.table, task.crest, pattern, reduced, i, 1.0, reduced[at.NEED, i], nodes, polys)
            y = _last_fold(own, task.rooms.traces[OPENING_TRACE])
        out[results.SATURATION, i] = y * reduced[at.LENGTH, i]
        out[results.STATUS, i] = results.SHORT if math.isnan(y) else 0.0


@inlined
def solve_exponent(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1 of one exponent, on arrays that Python holds."""
    if task.wanted.saturation:
        _fill_saturation(task, scenes, reduced, first, last, out)
        return
    if not task.wanted.cycle and task.punch.turn == AT_RIM:
        _solve_forces(task, scenes, reduced, first, last, out)
        return
    start = first
    while start < last:
        end = curve_end(task.reach, scenes, reduced, start, last, out)
        if end > start:
            solve_curve(task, scenes, reduced, start, end, out)
        start = max(end, start + 1)
