"""Scenes of more waves than are walked, of one exponent: their results as the other loops store them."""

import math

from gradhesion.core.curve.values import Curve
from gradhesion.core.cycle.long import (
    Long,
    begin,
    end_of_folds,
    loop_far,
    lowest_far,
    turn_far,
)
from gradhesion.core.cycle.pull_off import lowest_load
from gradhesion.core.jit import kernel
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes.cycles import Task, curves_of, no_value, put_losses, put_no_contact, put_pull_off
from gradhesion.core.scenes.reduced import (
    AT_A_LOAD,
    AT_DEPTH,
    AT_RIM,
    LENGTH,
    RIM_Y,
    TARGET_VALUE,
    is_valid,
)
from gradhesion.core.scenes.results import SHORT, STATUS, TURN
from gradhesion.core.types import Floats


@kernel
def _solve(task: Task, long: Long, pull: Long, scenes: Floats, reduced: Floats, i: int, out: Floats) -> int:
    """Store the results of scene i; return its status, -1 if it must be walked."""
    pair = curves_of(task, scenes, reduced, i, 0.0)
    closing, opening, same = pair.closing, pair.opening, pair.ratio == 1.0
    y = reduced[RIM_Y, i]
    if task.punch.turn == AT_DEPTH and reduced[TARGET_VALUE, i] < 0.0:
        return put_no_contact(scenes, i, out)
    if task.wanted.cycle or task.punch.turn != AT_RIM:
        folds = end_of_folds(long, closing)
        begun, starts = begin(long, closing, folds)
        if task.punch.turn != AT_RIM:
            by_load = 1.0 if task.punch.turn == AT_A_LOAD else 0.0
            measured = Curve(closing.table, closing.B, closing.g, 1.0 - by_load, by_load)
            y = turn_far(long, closing, measured, reduced[TARGET_VALUE, i] / math.sqrt(pair.ratio), begun, y)
            if y == 0.0:
                return -1
    lowest = lowest_load(Curve(task.by_load, opening.B, opening.g, 0.0, 1.0), y, task.filling)
    if not lowest.known:
        lowest = lowest_far(pull, Curve(task.by_load, opening.B, opening.g, 0.0, 1.0), y)
    if not lowest.known or not lowest.load < 0.0:
        return NO_VALUE | TOO_MANY_WAVES
    bits = put_pull_off(lowest, y, reduced, i, out)
    out[TURN, i] = y * reduced[LENGTH, i]
    if not task.wanted.cycle and task.punch.turn == AT_RIM:
        return bits
    looped = loop_far(long, closing, opening, same, folds, begun, starts, y, task.wanted.depth)
    if not looped.loaded.known:
        return NO_VALUE | TOO_MANY_WAVES
    landings = min(looped.first, reduced[RIM_Y, i]), looped.last
    bits |= put_losses(task, pair, looped.loaded, looped.unloaded, y, landings, reduced, i, out)
    if not looped.one_disc:
        bits |= LOADING_NOT_ONE_DISC
    return bits | (CLOSE_TO_A_JUMP if looped.tied else 0)


@kernel
def solve_long(task: Task, long: Long, pull: Long, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve scenes of one exponent; `pull` is `long` with the waves of the pull-off."""
    for i in range(scenes.shape[1]):
        no_value(out, i, NO_VALUE)
        if not is_valid(task.punch, scenes, reduced, i):
            continue
        status = _solve(task, long, pull, scenes, reduced, i, out)
        if status < 0 or status & NO_VALUE:
            no_value(out, i, SHORT)
        out[STATUS, i] = SHORT if status < 0 else status
