"""Eight rims among the regular waves of a long curve at once: where each stands, and what is lost next to it.

Far from its beginning, and from where its folds end, loading goes from every wave to the next one, and so does
unloading. There a rim needs no branch of a trace (path/cosine_long.py). The slope of the curve at the rim tells whether
it stands on a branch; the sums over waves (waves/cosine_running.py) go to the last jump before the rim; and what is
left is the jump to the rim, from the end of the last branch, and the one away from it. Both are found for eight rims
together, each for itself.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.at_once import find_depths
from gradhesion.core.curve.branches import END_DEPTH, LOADING_IS_CLOSE, WORK
from gradhesion.core.curve.cosine import Cosine, slopes_at_once
from gradhesion.core.curve.cosine_energy import energies_at_once, jump_energy
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.path.cosine_long import (
    FIRST_CLOSE,
    LAST_UP,
    LOWEST,
    LOWEST_BRANCH,
    LOWEST_JUMPS,
    LOWEST_LAST,
    LOWEST_LOSS,
    NEAR,
    entry,
    leave_lowest,
    sum_of_gap,
)
from gradhesion.core.path.ties import highest_before, is_within, unloading_is_close
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.lanes import Lanes, any_above, chosen, eight, floor_of, lane_of
from gradhesion.core.waves.cosine_at_once import folds_at_once

Stands: TypeAlias = tuple[Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes]
BRANCH, ON, REACHED, HERE, VALUE, RATE, END, TOP, BOTTOM, LANDING, UP, DOWN = range(12)
"""The wave of the last branch that starts within each rim; 1 where the rim stands on it; 1 where loading arrives on it
before the rim; the depth at the rim, D there, and its derivative; the end from which loading goes to the rim, and its
depth; the depth at which the branch starts (-inf where the rim stands on it), and where unloading lands on it; what the
jumps to the rim, and away from it, lose. NaN is what takes longer."""
FURTHEST: Final = 1.0e9
"""Arches within which neighbours are no near tie, and a float tells on which side of a fold a rim stands."""


@kernel(contract=True)
def stand_at_once(table: Any, curve: Cosine, rims: Lanes, losses: bool) -> Stands:
    """Return how eight rims stand among regular waves."""
    turns = rims - table.phase / TWO_PI
    value, rate, _, _, here = slopes_at_once(table, curve, 0.5 * (1.0 - table.k), rims)
    nearest = floor_of(turns + 0.5)
    on = chosen(0.0, value, 1.0, 0.0)
    branch = nearest - (1.0 - on) * chosen(nearest, turns, 0.0, 1.0)
    left = branch - on
    end, top = folds_at_once(table, curve, left, eight(-1.0))
    reached = on * chosen(top, here, 1.0, 0.0)
    bottom, landing, up, down = eight(-math.inf), eight(0.0), eight(0.0), eight(0.0)
    if losses:  # noqa: SIM102 (a flag first, then what only it needs)
        if any_above(1.0 - reached, 0.0):
            up = chosen(1.0, reached, 0.0, energies_at_once(table, curve, end, rims))
    if any_above(1.0 - on, 0.0):
        start, low = folds_at_once(table, curve, left, eight(1.0))
        target = chosen(1.0, on, 0.5 * (low + top), here)
        landing = find_depths(table, curve, target, start, low, end, top)
        landing = chosen(1.0, on, 0.0, landing)
        if losses:
            down = chosen(1.0, on, 0.0, energies_at_once(table, curve, rims, landing))
        bottom = chosen(1.0, on, -math.inf, low)
    return branch, on, reached, here, value, rate, end, top, bottom, landing, up, down


@kernel()
def cycle_among(
    table: Any,
    curve: Cosine,
    stands: Stands,
    lane: int,
    rim: float,
    final: float,
    long: Any,
    trace: Any,
    losses: bool,
) -> tuple[bool, float, float, float, float, float, float, float]:
    """Return the cycle of one of the rims, as far as it stands among regular waves (the first of what is returned).

    Then come what loading loses and its jumps, the same of unloading, the depth at which contact ends, the largest
    depth, and the wave on which loading enters those of the gap.
    """
    shared, sums, room = long
    near, now = int(shared[NEAR]), int(shared[LAST_UP])
    branch, on, reached = lane_of(stands[BRANCH], lane), lane_of(stands[ON], lane), lane_of(stands[REACHED], lane)
    end, top, landing = lane_of(stands[END], lane), lane_of(stands[TOP], lane), lane_of(stands[LANDING], lane)
    level = trace[END_DEPTH, now] if now >= 0 else 0.0
    if not top > level or math.isnan(end + landing):
        return False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    wave, _, loaded, loading_jumps = entry(table, curve, branch, long, trace, losses)
    leave_lowest(table, curve, long, final, trace, losses)
    lowest = shared[LOWEST]
    if not max(wave, lowest) < branch - 1.0:
        return False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    last = branch - 1.0 if on == reached else branch - 2.0
    unloaded = shared[LOWEST_LOSS]
    if losses:
        up, down = lane_of(stands[UP], lane), lane_of(stands[DOWN], lane)
        if math.isnan(up):
            up = jump_energy(table, curve, end, rim, trace[WORK])
        if math.isnan(down):
            down = jump_energy(table, curve, rim, landing, trace[WORK])
        loaded += sum_of_gap(table, curve, sums[0], wave, last, YES, final, YES, room) + up
        unloaded += sum_of_gap(table, curve, sums[1], lowest + 1.0, branch, NO, final, YES, room) + down
    loading_jumps += last + 1.0 - wave + (1.0 - reached)
    unloading_jumps = shared[LOWEST_JUMPS] + branch - lowest + (1.0 - on)
    deepest = max(lane_of(stands[HERE], lane), top, highest_before(trace, near - 1), 0.0)
    return True, loaded, loading_jumps, unloaded, unloading_jumps, shared[LOWEST_LAST], deepest, wave


@kernel()
def is_close_among(
    table: Any, curve: Cosine, stands: Stands, lane: int, rim: float, long: Any, trace: Any, turned: bool
) -> bool:
    """Return what `is_close_to_a_jump` (path/ties.py) does for one of the rims that stand among regular waves."""
    shared, _, _ = long
    near, lower = int(shared[NEAR]), int(shared[LOWEST_BRANCH])
    if shared[FIRST_CLOSE] <= rim or (near > 0 and trace[LOADING_IS_CLOSE, near - 1] > 0.0):
        return True
    here, on = lane_of(stands[HERE], lane), lane_of(stands[ON], lane) > 0.0
    if not turned:
        value, rate = lane_of(stands[VALUE], lane), lane_of(stands[RATE], lane)
        if abs(value) <= 2.0 * CLOSE * TWO_PI * rim * abs(rate):
            return True
        if on and is_within(table, curve, abs(here - lane_of(stands[TOP], lane)), rim):
            return True
    if not on and is_within(table, curve, abs(here - lane_of(stands[BOTTOM], lane)), rim):
        return True
    return lower >= 0 and unloading_is_close(table, curve, trace, lower)
