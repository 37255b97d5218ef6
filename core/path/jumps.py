"""Where jumps of a path land and what they lose, eight of them at once where they stand far enough out.

A path is known as far as its branches are known: which of them it visits does not depend on where it lands on them. So
its jumps are listed first. Those of one cosine beyond z = 40 are worked on together, each for itself: the values do not
depend on how many there are.
"""

import math
from typing import Any, TypeAlias

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.curve.at_once import find_depths
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    LANDING,
    LOADING_LOSS,
    START,
    START_DEPTH,
    UNLOADING_LOSS,
    WORK,
)
from gradhesion.core.curve.cosine_energy import energies_at_once
from gradhesion.core.path.passage import find_place, loss_between, loss_from_zero
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.lanes import LANES, Lanes, eight, lane_of, with_lane
from gradhesion.core.struve.layout import SWITCH

Waiting: TypeAlias = tuple[int, Lanes, Lanes]
"""How many jumps wait, and the branches from and to which they go."""


@kernel()
def nobody() -> Waiting:
    """Return that no jump waits."""
    return NONE, eight(0.0), eight(0.0)


@kernel()
def _one(table: Any, curve: Any, trace: Any, before: int, after: int, outwards: bool, losses: bool) -> None:
    """Find where one jump lands and what it loses; before = -1 stands for no contact."""
    if outwards:
        left, level = (trace[END, before], trace[END_DEPTH, before]) if before >= 0 else (0.0, 0.0)
    else:
        left, level = trace[START, before], trace[START_DEPTH, before]
    x = find_place(table, curve, level, trace, after)
    loss = 0.0
    if losses:
        loss = loss_from_zero(table, curve, x) if before < 0 else loss_between(table, curve, left, x, trace[WORK])
    if outwards:
        trace[ARRIVAL, after], trace[LOADING_LOSS, after] = x, loss
    else:
        trace[LANDING, before], trace[UNLOADING_LOSS, before] = x, loss


@kernel()
def _eight(table: Any, curve: Any, trace: Any, waiting: Waiting, outwards: bool, losses: bool) -> None:
    """Do the same for all that wait."""
    count, befores, afters = waiting
    left = level = low = low_depth = high = high_depth = eight(0.0)
    for lane in range(LANES):
        some = min(lane, count - 1)
        before, after = int(lane_of(befores, some)), int(lane_of(afters, some))
        left = with_lane(left, lane, trace[END if outwards else START, before])
        level = with_lane(level, lane, trace[END_DEPTH if outwards else START_DEPTH, before])
        low = with_lane(low, lane, trace[START, after])
        low_depth = with_lane(low_depth, lane, trace[START_DEPTH, after])
        high = with_lane(high, lane, trace[END, after])
        high_depth = with_lane(high_depth, lane, trace[END_DEPTH, after])
    place = find_depths(table, curve, level, low, low_depth, high, high_depth)
    loss = energies_at_once(table, curve, left, place) if losses else eight(0.0)
    for lane in range(count):
        before, after = int(lane_of(befores, lane)), int(lane_of(afters, lane))
        x, lost = lane_of(place, lane), lane_of(loss, lane)
        if math.isnan(x + lost):
            _one(table, curve, trace, before, after, outwards, losses)
        elif outwards:
            trace[ARRIVAL, after], trace[LOADING_LOSS, after] = x, lost
        else:
            trace[LANDING, before], trace[UNLOADING_LOSS, before] = x, lost


@kernel()
def finish(table: Any, curve: Any, trace: Any, waiting: Waiting, outwards: bool, losses: bool) -> None:
    """Find where those land that still wait, and what they lose."""
    if len(curve) == 3:  # noqa: SIM102 (numba drops the branch by the length alone)
        if waiting[0] > 0:
            _eight(table, curve, trace, waiting, outwards, losses)


@kernel()
def add(
    table: Any, curve: Any, trace: Any, waiting: Waiting, before: int, after: int, outwards: bool, losses: bool
) -> Waiting:
    """Take in a jump from a branch, -1 for no contact, to another one; return those that wait.

    Once `finish` has been called, where it lands and what it loses stands in the trace: in ARRIVAL and LOADING_LOSS of
    the branch that loading reaches, or in LANDING and UNLOADING_LOSS of the one that unloading leaves.
    """
    if len(curve) == 3:
        near = min(trace[END if outwards else START, max(before, 0)], trace[START, after])
        if before >= 0 and TWO_PI * near >= SWITCH and trace[END, after] < math.inf:
            count, befores, afters = waiting
            waiting = count + 1, with_lane(befores, count, float(before)), with_lane(afters, count, float(after))
            if count + 1 == LANES:
                _eight(table, curve, trace, waiting, outwards, losses)
                waiting = nobody()
            return waiting
    _one(table, curve, trace, before, after, outwards, losses)
    return waiting
