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
from gradhesion.core.cycle.path import Loaded, load_to, snap_in, unload_from, visited_within, walk_loading
from gradhesion.core.cycle.pull_off import Lowest, lowest_load, serves
from gradhesion.core.cycle.residual import work_of_cycle
from gradhesion.core.cycle.ties import loading_is_tied, rim_is_tied, target_is_tied, unloading_is_tied
from gradhesion.core.cycle.turning import turning_radius
from gradhesion.core.edge.pattern import Pattern, patterned_table
from gradhesion.core.jit import inlined, kernel, leaf
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import AT_A_LOAD, AT_DEPTH, AT_RIM, Punch
from gradhesion.core.scenes.requests import Wanted
from gradhesion.core.scenes.results import Cycle, no_value, put_force, put_losses, put_no_contact, put_pull_off
from gradhesion.core.scenes.tables import Task
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
    branches            of closing; negative: the table is too short
    visits              those that loading visits
    measured            branches of `turning`
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
    visits: int
    measured: int


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


@kernel
def _turn(walked: Walked, turn: int, reduced: Floats, i: int) -> float:
    """Return where scene i turns; its rim if nowhere within the table before, 0 if there is no contact."""
    target = reduced[at.TARGET_VALUE, i] / math.sqrt(walked.ratio)
    if turn == AT_DEPTH and target < 0.0:
        return 0.0
    found = turning_radius(
        measured_curve(walked.closing, turn),
        target,
        walked.loading,
        walked.columns[0],
        walked.visits,
        walked.turning,
        walked.measured,
    )
    return min(found, float(reduced[at.RIM_Y, i]))


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
def _target_is_tied(walked: Walked, turn: int, y: float, reduced: Floats, i: int) -> bool:
    """Return whether the target of scene i, which turns at y, is close to a highest one before."""
    target = reduced[at.TARGET_VALUE, i] / math.sqrt(walked.ratio)
    return target_is_tied(
        measured_curve(walked.closing, turn),
        target,
        y,
        walked.loading,
        walked.columns[0],
        walked.visits,
        walked.turning,
        walked.measured,
    )


@leaf
def _is_tied(walked: Walked, opened: int, y: float, at_rim: bool) -> bool:
    """Return whether a decision of a cycle that turns at y is close, but for the turn."""
    closing, opening = walked.closing, walked.opening
    tied = rim_is_tied(closing, y) or loading_is_tied(closing, y, at_rim, walked.loading, walked.branches)
    tied = tied or (walked.ratio < 1.0 and rim_is_tied(opening, y))
    return tied or unloading_is_tied(opening, y, walked.unloading, opened)


@leaf
def _put_cycle(walked: Walked, wanted: Wanted, opened: int, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store what the cycle of scene i, which turns at y, loses; return its bits of status, -1: too short a table.

    `opened` is the number of branches of opening.
    """
    closing, opening, loading, visited = walked.closing, walked.opening, walked.loading, walked.columns[0]
    loaded = load_to(closing, y, loading, visited, walked.visits)
    if not loaded.known:
        return -1
    unloaded = unload_from(opening, y, walked.unloading, opened, walked.columns[1])
    n, rim = visited_within(loading, visited, walked.visits, y), reduced[at.RIM_Y, i]
    beyond = n > 0 and y == rim and reduced[at.WINDOW, i] < y <= loading[END, visited[n - 1]]
    if beyond and walked.pattern.rows.shape[1] == 0:
        # on the endless branch: whether the table reaches to this rim depends on the scenes beside (far_rims)
        loaded = Loaded(loaded.lost, loaded.jumps, math.inf, loaded.in_to_rim, True)
    reach = loading[LANDING, visited[n - 1]] if n > 0 else y
    landing = min(loading[LANDING, visited[0]] if walked.visits > 0 else math.inf, rim)
    cycle = Cycle(loaded, unloaded, y, reach, snap_in(closing, landing))
    bits = put_losses(cycle, opening, walked.pattern, walked.ratio, reduced, i, out)
    if wanted.residual:
        top = y  # where one curve leads out beyond the last landing and back, its load does no work
        if walked.ratio == 1.0 and n > 0 and loading[END, visited[n - 1]] == math.inf:
            top = min(y, 1.01 * reach, end_of(closing.table))
        work = work_of_cycle(closing, opening, top, loading, walked.visits, visited, walked.unloading, opened)
        out[at.RESIDUAL, i] = out[at.ENERGY, i] - work * 2.0 * math.pi * reduced[at.LENGTH, i] ** 2
    return bits | (CLOSE_TO_A_JUMP if _is_tied(walked, opened, y, y >= rim) else 0)


@leaf
def turns_of(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> Walked:
    """Store where scenes of one curve turn, in TURN, as a reduced radius; return their curve of closing as walked.

    The curve is traced as far as some scene is sure to turn, and farther where a jump has passed its target.
    """
    rooms, turn, table, far = task.rooms, task.punch.turn, task.table, 0.0
    nodes, polys, ratio = rooms.nodes, rooms.polys, reduced[at.CLOSING, first]
    pattern = pattern_of(task.punch, scenes, reduced, first)
    loading, columns = rooms.traces[CLOSING_TRACE], rooms.columns
    for i in range(first, last):
        far = max(far, reduced[at.NEED, i] if turn != AT_RIM else reduced[at.RIM_Y, i])
    while True:
        closing = curve_of(table, task.crest, pattern, reduced, first, math.sqrt(ratio), far, nodes[0], polys[0])
        opening, unloading, turning = closing, loading, loading
        if ratio != 1.0:
            opening = curve_of(table, task.crest, pattern, reduced, first, 1.0, far, nodes[1], polys[1])
            unloading = rooms.traces[OPENING_TRACE]
        rooms.limits[0], rooms.limits[1] = 0.0, -1.0
        branches, visits = find_folds(closing, far, loading), 0
        measured = branches
        if branches >= 0:
            visits = walk_loading(closing, loading, branches, columns[0])
        if branches >= 0 and turn != AT_RIM:  # losses forgive the error of a landing, but not where a cycle turns
            _polish_landings(closing, loading, columns[0], visits)
            own = measured_curve(closing, turn)
            if own.by_depth != closing.by_depth or own.by_load != closing.by_load:
                turning = rooms.traces[MEASURED_TRACE]
                measured = find_folds(own, far, turning)
        walked = Walked(
            closing, opening, pattern, ratio, loading, unloading, turning, columns, branches, visits, measured
        )
        farther = False
        for i in range(first, last):
            out[at.TURN, i] = math.nan
            if branches >= 0:
                out[at.TURN, i] = reduced[at.RIM_Y, i] if turn == AT_RIM else _turn(walked, turn, reduced, i)
            if (
                turn != AT_RIM
                and out[at.TURN, i] == reduced[at.RIM_Y, i]
                and far < min(reduced[at.RIM_Y, i], end_of(table))
            ):
                farther = True  # not reached as far as the curve is traced
        if not farther:
            return walked
        far = min(2.0 * far, end_of(table))


@kernel
def _last_fold(opening: Curve, trace: Floats) -> float:
    """Return the radius of the outermost fold of opening, 0 if there is none; the trace is overwritten."""
    count = find_folds(opening, math.inf, trace)
    if count <= 0:
        return 0.0 if count == 0 else math.inf
    return float(trace[START, count - 1] if trace[END, count - 1] == math.inf else trace[END, count - 1])


@leaf
def open_curve(walked: Walked, turn: int, first: int, last: int, out: Floats) -> tuple[int, float]:
    """Trace the curve of opening of scenes whose TURN is stored; return its branches and the farthest turn.

    Those that turn beyond the table get SHORT as status and no TURN.
    """
    end, farthest, opened = end_of(walked.opening.table), 0.0, walked.branches
    for i in range(first, last):
        beyond = turn != AT_RIM and out[at.TURN, i] >= end and opened >= 0
        if math.isnan(out[at.TURN, i]) or beyond:
            no_value(out, i, at.SHORT)
        else:
            farthest = max(farthest, out[at.TURN, i])
    if walked.ratio < 1.0 and opened >= 0 and farthest > 0.0:
        opened = find_folds(walked.opening, farthest, walked.unloading)
    return opened, farthest


@inlined
def solve_curve(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1, all of one curve and valid; store their results, or SHORT as status."""
    wanted, turn = task.wanted, task.punch.turn
    walked = turns_of(task, scenes, reduced, first, last, out)
    opened, farthest = open_curve(walked, turn, first, last, out)
    patterned = walked.pattern.rows.shape[1] > 0
    pull = load_curve(walked.opening)
    if not patterned:
        pull = Curve(task.by_load, pull.B, pull.g, 0.0, 1.0)
    lowest, last_fold, bins = Lowest(0.0, 0.0, 0.0, 0.0, True), 0.0, pull.table.bins
    if farthest > 0.0:
        lowest = lowest_load(pull, farthest, 0, bins)
    if wanted.saturation and walked.branches >= 0:
        last_fold = _last_fold(walked.opening, task.rooms.traces[MEASURED_TRACE])
    for i in range(first, last):
        y = out[at.TURN, i]
        if math.isnan(y):
            continue
        if y == 0.0:
            put_no_contact(scenes, i, out)
            continue
        own, bits = lowest, -1
        if not serves(lowest, farthest, y):
            own = lowest_load(pull, y, 0, bins)
        if walked.branches >= 0 and opened >= 0 and own.known and (own.load < 0.0 or patterned):
            bits = _put_cycle(walked, wanted, opened, y, reduced, i, out)
        if bits < 0:
            no_value(out, i, at.SHORT)
            continue
        if turn != AT_RIM and _target_is_tied(walked, turn, y, reduced, i):
            bits |= CLOSE_TO_A_JUMP
        if wanted.contact and not _loading_keeps_one_disc(task, walked, y, reduced, i):
            bits |= LOADING_NOT_ONE_DISC
        out[at.STATUS, i] = bits | put_pull_off(own, y, reduced, i, out)
        out[at.SATURATION, i] = last_fold * reduced[at.LENGTH, i]


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
            no_value(out, end, at.SHORT if reduced[at.VALID, end] > 0.0 else NO_VALUE)
    return end


@leaf
def solve_patterned_forces(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the pull-off alone of the scenes `first` to `last` - 1 with a pattern: no farther than it can be."""
    rooms = task.rooms
    for i in range(first, last):
        if curve_end(task.reach, scenes, reduced, i, i + 1, out) == i:
            continue
        pattern = pattern_of(task.punch, scenes, reduced, i)
        lowest = Lowest(0.0, 0.0, 0.0, 0.0, False)
        for y_end in (reduced[at.NEED, i], end_of(task.table)):
            if not lowest.known:
                own = curve_of(task.table, task.crest, pattern, reduced, i, 1.0, y_end, rooms.nodes[0], rooms.polys[0])
                pull = Curve(own.table, own.B, own.g, 0.0, 1.0)
                lowest = lowest_load(pull, reduced[at.RIM_Y, i], 0, own.table.bins)
        put_force(lowest, reduced, i, out)


@inlined
def solve_exponent(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the scenes `first` to `last` - 1 of one exponent, on arrays that Python holds."""
    if not task.wanted.cycle and task.punch.turn == AT_RIM:  # of an interface with a pattern
        solve_patterned_forces(task, scenes, reduced, first, last, out)
        return
    start = first
    while start < last:
        end = curve_end(task.reach, scenes, reduced, start, last, out)
        if end > start:
            solve_curve(task, scenes, reduced, start, end, out)
        start = max(end, start + 1)
