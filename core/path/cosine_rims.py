"""Eight rims among the regular waves of a long curve at once: the place of each, and the losses next to it.

Far from its beginning, and from where its folds end, loading goes from every wave to the next one, and so does
unloading. There a rim needs no branch of a trace (path/cosine_long.py). The slope of the curve at the rim tells whether
it stands on a branch; the sums over waves (waves/cosine_running.py) go to the last jump before the rim; and what is
left is the jump to the rim, from the end of the last branch, and the one away from it. Both are found for eight rims
together, each for itself.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.at_once import find_depths
from gradhesion.core.curve.branches import END_DEPTH, LOADING_IS_CLOSE, WORK
from gradhesion.core.curve.cosine import Cosine, slopes_at_once
from gradhesion.core.curve.cosine_energy import energies_at_once, jump_energy
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import Lanes, any_above, chosen, eight, floor_of, lane_of
from gradhesion.core.path.cosine_long import Long, entry, leave_lowest, sum_of_gap
from gradhesion.core.path.ties import highest_before, is_within, unloading_is_close
from gradhesion.core.problem.results import Cycle
from gradhesion.core.types import Table
from gradhesion.core.waves.cosine_at_once import folds_at_once


class Stands(NamedTuple):
    """How eight rims stand among regular waves, each number for all of them; NaN is what takes longer."""

    branch: Lanes  # the wave of the last branch that starts within the rim
    on: Lanes  # 1 where the rim stands on that branch, else 0
    reached: Lanes  # 1 where loading arrives on it before the rim, else 0
    here: Lanes  # the depth at the rim, in s l^c
    value: Lanes  # D there (curve/cosine.py)
    rate: Lanes  # its derivative by z
    end: Lanes  # x and depth of the end from which loading goes to the rim
    top: Lanes
    bottom: Lanes  # the depth at which the branch starts, -inf where the rim stands on it
    landing: Lanes  # x where unloading lands on it, 0 where the rim stands on it
    up: Lanes  # what the jumps to the rim, and away from it, lose, in 2 pi l^2 dgamma
    down: Lanes


FURTHEST: Final = 1.0e9
"""Arches within which neighbours are no near tie, and a float tells on which side of a fold a rim stands."""


@kernel(contract=True)
def stand_at_once(table: Table, curve: Cosine, rims: Lanes, losses: bool) -> Stands:
    """Return how eight rims x = a/lambda stand among regular waves; with `losses` the energies of jumps as well."""
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
    return Stands(branch, on, reached, here, value, rate, end, top, bottom, landing, up, down)


@kernel()
def cycle_among(
    table: Table, curve: Cosine, stands: Stands, lane: int, rim: float, long: Long, losses: bool
) -> tuple[bool, Cycle, float]:
    """Return whether one of the rims stands among regular waves, its cycle if so, and the wave that loading enters.

    That is the first one of the gap on which it stands. The rim is x = a/lambda, number `lane` of `stands`.
    """
    shared, trace = long.shared[0], long.trace
    near, now = shared.near, shared.last_up
    branch, on, reached = lane_of(stands.branch, lane), lane_of(stands.on, lane), lane_of(stands.reached, lane)
    end, top, landing = lane_of(stands.end, lane), lane_of(stands.top, lane), lane_of(stands.landing, lane)
    level = trace[END_DEPTH, now] if now >= 0 else 0.0
    nothing = Cycle(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if not top > level or math.isnan(end + landing):
        return False, nothing, 0.0
    wave, _, loaded, loading_jumps = entry(table, curve, branch, long, losses)
    leave_lowest(table, curve, long, losses)
    lowest = shared.lowest
    if not max(wave, lowest) < branch - 1.0:
        return False, nothing, 0.0
    last = branch - 1.0 if on == reached else branch - 2.0
    unloaded = shared.lowest_loss
    if losses:
        up, down = lane_of(stands.up, lane), lane_of(stands.down, lane)
        if math.isnan(up):
            up = jump_energy(table, curve, end, rim, trace[WORK])
        if math.isnan(down):
            down = jump_energy(table, curve, rim, landing, trace[WORK])
        loaded += sum_of_gap(table, curve, long, wave, last, YES, YES) + up
        unloaded += sum_of_gap(table, curve, long, lowest + 1.0, branch, NO, YES) + down
    loading_jumps += last + 1.0 - wave + (1.0 - reached)
    unloading_jumps = shared.lowest_jumps + branch - lowest + (1.0 - on)
    deepest = max(lane_of(stands.here, lane), top, highest_before(trace, near - 1), 0.0)
    return True, Cycle(loaded, loading_jumps, unloaded, unloading_jumps, shared.lowest_last, deepest), wave


@kernel()
def is_close_among(
    table: Table, curve: Cosine, stands: Stands, lane: int, rim: float, long: Long, turned: bool
) -> bool:
    """Return what `is_close_to_a_jump` (path/ties.py) does for one of the rims that stand among regular waves."""
    shared, trace = long.shared[0], long.trace
    near, lower = shared.near, shared.lowest_branch
    if shared.first_close <= rim or (near > 0 and trace[LOADING_IS_CLOSE, near - 1] > 0.0):
        return True
    here, on = lane_of(stands.here, lane), lane_of(stands.on, lane) > 0.0
    if not turned:
        value, rate = lane_of(stands.value, lane), lane_of(stands.rate, lane)
        if abs(value) <= 2.0 * CLOSE * TWO_PI * rim * abs(rate):
            return True
        if on and is_within(table, curve, abs(here - lane_of(stands.top, lane)), rim):
            return True
    if not on and is_within(table, curve, abs(here - lane_of(stands.bottom, lane)), rim):
        return True
    return lower >= 0 and unloading_is_close(table, curve, trace, lower)
