"""Scenes of more waves than are walked, of one exponent: their results as the other loops store them."""

import math

from gradhesion.core.borrowed import borrowed
from gradhesion.core.curve.values import Curve
from gradhesion.core.cycle.long import Long, begin, end_of_folds, from_birth, last_fold, loop_far, lowest_far, turn_far
from gradhesion.core.cycle.pull_off import lowest_load
from gradhesion.core.cycle.waves import start_of
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes.cycles import (
    Cycle,
    Task,
    measured_curve,
    no_value,
    pattern_of,
    put_force,
    put_losses,
    put_no_contact,
    put_pull_off,
)
from gradhesion.core.scenes.reduced import (
    AT_DEPTH,
    AT_RIM,
    BY_DEPTH,
    BY_LOAD,
    BY_POWER,
    BY_WAVES,
    CLOSING,
    LENGTH,
    NEED,
    RIM_Y,
    TARGET_VALUE,
    VALID,
    WINDOW,
)
from gradhesion.core.scenes.results import SATURATION, SHORT, STATUS
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats


@leaf
def _curve(task: Task, reduced: Floats, i: int, root: float) -> Curve:
    """Return a curve of scene i, sizes over `root`."""
    B, g = reduced[BY_POWER, i] / root, reduced[BY_WAVES, i] / root
    return Curve(task.table, B, g, reduced[BY_DEPTH, i], reduced[BY_LOAD, i])


@kernel
def solve_long(
    task: Task, every: Long, pull: Long, scenes: Floats, reduced: Floats, walkable: float, out: Floats
) -> None:
    """Solve scenes of one exponent; others are left as SHORT: irregular ones, and those that end next to the centre.

    Of the latter NEED is set to what they need; irregular ones that reach beyond `walkable` have no value. `pull` is
    `every` with the waves of the pull-off.
    """
    task, every, pull, scenes, reduced, out = borrowed((task, every, pull, scenes, reduced, out))
    turn, bins = task.punch.turn, task.by_load.bins
    for i in range(scenes.shape[1]):
        no_value(out, i, NO_VALUE)
        if not reduced[VALID, i]:
            continue
        if turn == AT_DEPTH and reduced[TARGET_VALUE, i] < 0.0:
            put_no_contact(scenes, i, out)
            continue
        edge, tied, root = reduced[RIM_Y, i], False, math.sqrt(reduced[CLOSING, i])
        closing, opening = _curve(task, reduced, i, root), _curve(task, reduced, i, 1.0)
        long = from_birth(every, closing)
        if start_of(long.waves, long.near + 2.0) > end_of(long.table):
            out[STATUS, i] = NO_VALUE | TOO_MANY_WAVES
            continue
        folds, y = end_of_folds(long, closing), edge
        begun, starts = begin(long, closing, folds)
        if turn != AT_RIM:
            target = reduced[TARGET_VALUE, i] / root
            y, tied = turn_far(long, closing, measured_curve(closing, turn), target, begun, edge)
        if y < start_of(long.waves, long.near + 4.0):
            no_value(out, i, SHORT)
            reduced[NEED, i] = start_of(long.waves, long.near + 8.0)
            continue
        load = Curve(task.by_load, opening.B, opening.g, 0.0, 1.0)
        lowest = lowest_load(load, y, 0, bins)
        if not lowest.known:
            lowest = lowest_far(pull, load, y)
        out[STATUS, i] = NO_VALUE | TOO_MANY_WAVES
        if not (lowest.known and lowest.load < 0.0):
            continue
        if not task.wanted.cycle and turn == AT_RIM:
            put_force(lowest, reduced, i, out)
            continue
        looped = loop_far(long, closing, opening, root == 1.0, folds, begun, starts, y, edge)
        if not looped.loaded.known:
            no_value(out, i, SHORT if reduced[NEED, i] < walkable else NO_VALUE | TOO_MANY_WAVES)
            continue
        cycle = Cycle(looped.loaded, looped.unloaded, y, looped.reach, looped.snap)
        pattern = pattern_of(task.punch, scenes, reduced, i)
        bits = put_losses(cycle, opening, pattern, reduced[CLOSING, i], reduced, i, out)
        bits |= put_pull_off(lowest, y, reduced, i, out)
        if not looped.one_disc:
            bits |= LOADING_NOT_ONE_DISC
        out[STATUS, i] = bits | (CLOSE_TO_A_JUMP if tied or looped.tied else 0)


@kernel
def fill_saturation(task: Task, long: Long, reduced: Floats, out: Floats) -> None:
    """Store the radii of the outermost folds of opening, of scenes that have a value."""
    task, long, reduced, out = borrowed((task, long, reduced, out))
    for i in range(reduced.shape[1]):
        if out[STATUS, i] < NO_VALUE or not int(out[STATUS, i]) & NO_VALUE:
            y = last_fold(long, _curve(task, reduced, i, 1.0)) if reduced[WINDOW, i] < math.inf else math.inf
            out[SATURATION, i] = y * reduced[LENGTH, i]  # NaN, and flagged, if there are too many waves up to it
            if math.isnan(y):
                out[STATUS, i] = int(out[STATUS, i]) | TOO_MANY_WAVES
