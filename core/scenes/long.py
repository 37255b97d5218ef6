"""Scenes of more waves than are walked, of one exponent: their results as the other loops store them."""

import math
import threading
from collections import OrderedDict
from functools import partial
from typing import Final

import numpy as np

from gradhesion.core.curve.values import Curve
from gradhesion.core.cycle.pull_off import lowest_load
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.many.loop import begin, last_fold, loop_far, lowest_far, turn_far
from gradhesion.core.many.losses import LOSSES
from gradhesion.core.many.search import MOST, NEAR, Long, end_of_folds, from_birth, space_for, with_limits
from gradhesion.core.many.waves import Waves, reach_of, start_of, waves_of
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes import results
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.cycles import measured_curve, pattern_of
from gradhesion.core.scenes.reduced import AT_DEPTH, AT_RIM, Punch, disc_of
from gradhesion.core.scenes.requests import Wanted
from gradhesion.core.scenes.tables import MOST_BINS, Task, long_table, rooms_for, solve_some
from gradhesion.core.table.filling import width_of
from gradhesion.core.table.layout import BY_LOAD as OF_PULL_OFF
from gradhesion.core.table.layout import EXACT, GEOMETRIC, PER_WAVE, end_of
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers

_WALKED: Final = 600
"""Waves that are walked; scenes of more are summed."""
_WALKED_WITH_WORK: Final = 2000
"""The same where the loop integral is wanted, which is not summed."""
_WALKED_BINS: Final = 40_000
"""Bins that are walked at most, where waves have many: 23 MB."""
_BINS_OF_A_WAVE: Final = 1024
"""Bins of a wave at most, where waves are summed: 5 MB for each doubling of their number."""
_KEPT_WAVES: Final = 64e6
"""Bytes of all waves (many/waves.py) that are kept between calls."""


@leaf
def _curve(task: Task, reduced: Floats, i: int, root: float) -> Curve:
    """Return a curve of scene i, sizes over `root`."""
    B, g = reduced[at.BY_POWER, i] / root, reduced[at.BY_WAVES, i] / root
    return Curve(task.table, B, g, reduced[at.BY_DEPTH, i], reduced[at.BY_LOAD, i])


@kernel
def solve_long(
    task: Task,
    every: Long,
    pull: Long,
    most: Integers,
    scenes: Floats,
    reduced: Floats,
    walkable: float,
    total: Floats,
    out: Floats,
) -> None:
    """Solve scenes of one exponent; others are left as SHORT: irregular ones, and those that end next to the centre.

    Of the latter NEED is set to what they need; irregular ones that reach beyond `walkable` have no value. `pull` is
    `every` with the waves of the pull-off; `most` is the wave at which the search of each scene ends, (scenes,);
    `total` is room, (LOSSES,).
    """
    turn, bins = task.punch.turn, task.by_load.bins
    for i in range(scenes.shape[1]):
        results.no_value(out, i, NO_VALUE)
        if not reduced[at.VALID, i]:
            continue
        if turn == AT_DEPTH and reduced[at.TARGET_VALUE, i] < 0.0:
            results.put_no_contact(scenes, i, out)
            continue
        edge, tied, root = reduced[at.RIM_Y, i], False, math.sqrt(reduced[at.CLOSING, i])
        closing, opening = _curve(task, reduced, i, root), _curve(task, reduced, i, 1.0)
        long = from_birth(with_limits(every, every.near, most[i]), closing)
        if start_of(long.waves, long.near + 2.0) > end_of(long.table):
            out[results.STATUS, i] = NO_VALUE | TOO_MANY_WAVES
            continue
        folds, y = end_of_folds(long, closing), edge
        begun, starts = begin(long, closing, folds)
        if turn != AT_RIM:
            target = reduced[at.TARGET_VALUE, i] / root
            y, tied = turn_far(long, closing, measured_curve(closing, turn), target, begun, edge)
        if y < start_of(long.waves, long.near + 4.0):
            results.no_value(out, i, results.SHORT)
            reduced[at.NEED, i] = start_of(long.waves, long.near + 8.0)
            continue
        load = Curve(task.by_load, opening.B, opening.g, 0.0, 1.0)
        lowest = lowest_load(load, y, 0, bins)
        if not lowest.known:
            lowest = lowest_far(with_limits(pull, pull.near, most[i]), load, y)
        out[results.STATUS, i] = NO_VALUE | TOO_MANY_WAVES
        if not (lowest.known and lowest.load < 0.0):
            continue
        if not task.wanted.cycle and turn == AT_RIM:
            results.put_force(lowest, reduced, i, out)
            continue
        cycle = loop_far(long, closing, opening, root == 1.0, folds, begun, starts, y, edge, tied, total)
        if not cycle.loaded.known:
            results.no_value(out, i, results.SHORT if reduced[at.NEED, i] < walkable else NO_VALUE | TOO_MANY_WAVES)
            continue
        pattern = pattern_of(task.punch, scenes, reduced, i)
        bits = results.put_losses(cycle, opening, pattern, reduced[at.CLOSING, i], reduced, i, out)
        out[results.STATUS, i] = bits | results.put_pull_off(lowest, y, reduced, i, out)


@kernel
def fill_saturation(task: Task, every: Long, most: Integers, reduced: Floats, out: Floats) -> None:
    """Store the radii of the outermost folds of opening, of scenes whose folds end; `most` as of `solve_long`."""
    for i in range(reduced.shape[1]):
        y = last_fold(with_limits(every, every.near, most[i]), _curve(task, reduced, i, 1.0))
        out[results.SATURATION, i] = y * reduced[at.LENGTH, i]
        out[results.STATUS, i] = NO_VALUE | TOO_MANY_WAVES if math.isnan(y) else 0


_waves: OrderedDict[tuple[object, ...], Waves] = OrderedDict()
_lock = threading.Lock()


def _long_of(punch: Punch, wanted: Wanted, k: float, form: int, most: int) -> tuple[Task, Long]:
    """Return what scenes of an exponent are summed with, up to a number of waves."""
    near = NEAR + 3.0
    if punch.exponent - 1.0 < 0.5 * (1.0 - k):  # folds may begin far out
        near = _WALKED_BINS / (PER_WAVE * float(punch.waves[:, 0].max()))
    table, source, crest = long_table(punch, k, form, 1, 2.0 * math.pi * near, exactly=True)
    key = (punch.exponent, punch.waves.tobytes(), k, form)
    with _lock:
        waves = _waves.pop(key, None)
        if waves is None or most + 8 > reach_of(waves):
            waves = waves_of(table, source, crest, crests_of(k, punch.waves)[2], most + 8.0)
        _waves[key] = waves
        while len(_waves) > 1 and sum(own.values.nbytes for own in _waves.values()) > _KEPT_WAVES:
            _waves.popitem(last=False)
    rooms = rooms_for(0, patterned=False)
    disc = disc_of(punch, k, rooms.weights)
    task = Task(punch, wanted, table, table, crest, disc, rooms, math.inf)
    spaces = (space_for(bins) for bins in (table.bins, 2 * waves.per, 3 * waves.per, 5 * waves.per))
    return task, Long(table, waves, NEAR, most, disc, wanted.contact, *spaces)


def _walked(punch: Punch, wanted: Wanted) -> float:
    """Return the radius up to which scenes are walked, beyond which they are summed: inf for those that cannot be."""
    per = PER_WAVE * float(punch.waves[:, 0].max())
    if punch.rows.shape[1] > 0 or per > _BINS_OF_A_WAVE:
        return math.inf
    waves, bins = (_WALKED_WITH_WORK, MOST_BINS - 2 * GEOMETRIC) if wanted.residual else (_WALKED, _WALKED_BINS)
    return 2.0 * math.pi * min(waves, max(bins / per, 64.0))


def solve_summed(punch: Punch, wanted: Wanted, form: int, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve scenes of one exponent that have more waves than are walked; others, and irregular ones, stay SHORT."""
    far = np.flatnonzero(reduced[at.NEED] > _walked(punch, wanted))
    solve_some(partial(_solve_summed, punch, wanted, form), far, scenes, reduced, out)


def _solve_summed(punch: Punch, wanted: Wanted, form: int, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve scenes of one exponent by sums over their waves."""
    k, reach = float(scenes[at.K, 0]), reduced[at.NEED]
    if punch.turn != AT_RIM:  # a jump may pass where a cycle turns
        reach = np.minimum(np.fmax(reach, reduced[at.WINDOW]), reduced[at.RIM_Y])
    most = np.minimum(reach / (2.0 * math.pi) + 3.0, MOST + 8.0).astype(np.int64)
    task, long = _long_of(punch, wanted, k, form, int(most.max()))
    if wanted.saturation:
        fill_saturation(task, long, most, reduced, out)
        return
    pull = long
    if form != EXACT:
        by_load, pull = _long_of(punch, wanted, k, OF_PULL_OFF, int(most.max()))
        task = task._replace(by_load=by_load.table)
    walkable = (MOST_BINS - 2 * GEOMETRIC) * width_of(punch.waves)
    solve_long(task, long, pull, most, scenes, reduced, walkable, np.empty(LOSSES), out)
