"""A cycle of loading and unloading under displacement control: its jumps and the energy that they cost.

The curve's folds bound its *branches*, on which depth rises with the radius (the contact is stable). Loading climbs a
branch to its end and jumps outwards to the next branch that reaches higher; unloading descends to the branch's start
and jumps inwards to the next branch that reaches lower. Where unloading goes from the start of a branch does not
depend on where it came from, so that the loss from there to the end is kept with the branch; nor does loading depend
on the rim until it gets there. All rims of one curve therefore share one trace.

The trace is an array of one column a branch, rows as named below, with one row more for the work of jump_energy.py.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import kernel
from gradhesion.core.curve import Curve, depth, slope
from gradhesion.core.folds import fold_of_arch, last_arch, survey_arch
from gradhesion.core.jump_energy import energy_from_zero, jump_energy
from gradhesion.core.struve.circle import TWO_PI

START, START_DEPTH, END, END_DEPTH = 0, 1, 2, 3
ARRIVAL, LOADING_LOSS, LOADING_JUMPS = 4, 5, 6
UNLOADING_LOSS, UNLOADING_JUMPS, LAST_DEPTH = 7, 8, 9
WORK: Final = 10
ROWS: Final = 11
_STEPS: Final = 100


@kernel()
def find_depth(table: Any, curve: Curve, target: float, branch: Any) -> float:
    """Return where a rising branch meets a depth between those of its two ends (Newton, kept in the bracket)."""
    level = 0.5 * (1.0 - table.k)
    low, low_depth, high, high_depth = branch[START], branch[START_DEPTH], branch[END], branch[END_DEPTH]
    if high == math.inf:
        step = 0.25 + 0.25 * low
        high = low + step
        high_depth = depth(table, curve, high)
        while high_depth <= target:
            low, low_depth = high, high_depth
            step *= 2.0
            high += step
            high_depth = depth(table, curve, high)
    # a half wave of a cosine has both its ends level, as the branch has
    share = (target - low_depth) / (high_depth - low_depth)
    x = low + (high - low) * math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * share))) / math.pi
    for _ in range(_STEPS):
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
        d, d1, _, rest = slope(table, curve, level, x)
        rest -= target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        step = -rest * d / (d * d - 0.5 * rest * d1)
        x += step / TWO_PI
        # the loss is stationary at the place of landing: its error is the square of what is left here
        if low < x < high and abs(step) * (abs(d1) + abs(d)) < 1e-3 * abs(d):
            return x
    return x


@kernel()
def trace_branches(table: Any, curve: Curve, furthest: float, scratch: Any) -> tuple[int, Any]:
    """Fill the branches that begin within `furthest` (inf: all); return their number and the trace.

    The trace is `scratch` where that is long enough. The last branch ends at infinity or at its true fold.
    """
    level = 0.5 * (1.0 - table.k)
    final = last_arch(table, curve, level)
    wanted = min(final, (TWO_PI * furthest - table.phase) / math.pi + 3.5)
    trace = scratch
    if wanted + 4.0 > scratch.shape[1]:
        trace = np.empty((ROWS, int(wanted) + 4))
    count = 0
    inside = False
    if level == 0.0:  # k = 1: the first branch starts at zero contact, at the depth -1
        trace[START, 0], trace[START_DEPTH, 0] = 0.0, -1.0
        trace[UNLOADING_JUMPS, 0] = -1.0
        inside = True
    i = 0
    while i <= final:
        kind, low, peak, high = survey_arch(table, curve, level, i)
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for _ in range(abs(kind)):
            x, bottom = fold_of_arch(table, curve, level, i, kind, low, peak, high, rising)
            if rising and x > furthest:
                return count, trace
            if rising:
                trace[START, count], trace[START_DEPTH, count] = x, bottom
                trace[UNLOADING_JUMPS, count] = -1.0  # not known yet
            else:
                trace[END, count], trace[END_DEPTH, count] = x, bottom
                count += 1
                if x > furthest:
                    return count, trace
            inside = rising
            rising = not rising
        if not inside and high > furthest:
            break
        i += 1
    if inside:
        trace[END, count] = trace[END_DEPTH, count] = math.inf
        count += 1
    return count, trace


@kernel()
def load_up(table: Any, curve: Curve, count: int, trace: Any, furthest: float, losses: bool) -> None:
    """Follow loading from branch to branch; keep where it arrives on each (inf: never) and what was lost by then."""
    trace[ARRIVAL, :count] = math.inf
    now = 0
    while now < count and trace[END_DEPTH, now] <= 0.0:
        now += 1
    if now == count or trace[START, now] > furthest:
        return
    x = find_depth(table, curve, 0.0, trace[:, now])
    loss, jumps = energy_from_zero(table, curve, x, 0.0) if losses else 0.0, 1.0
    while True:
        trace[ARRIVAL, now], trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now] = x, loss, jumps
        left, level = trace[END, now], trace[END_DEPTH, now]
        if left >= furthest:
            return
        now += 1
        while now < count and trace[END_DEPTH, now] <= level:
            now += 1
        if now == count or trace[START, now] > furthest:
            return
        x = find_depth(table, curve, level, trace[:, now])
        if losses:
            loss += jump_energy(table, curve, left, x, trace[WORK])
        jumps += 1.0


@kernel()
def loading_to(table: Any, curve: Curve, count: int, trace: Any, rim: float, losses: bool) -> tuple[float, float]:
    """Return what loading up to the rim loses, and its jumps."""
    now = count - 1
    while now >= 0 and not trace[ARRIVAL, now] <= rim:
        now -= 1
    if now < 0:  # from zero contact to the rim at once
        return energy_from_zero(table, curve, rim, 0.0) if losses else 0.0, 1.0
    loss, jumps = trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]
    left = trace[END, now]
    if left < rim:
        if losses:
            loss += jump_energy(table, curve, left, rim, trace[WORK])
        jumps += 1.0
    return loss, jumps


@kernel()
def _lower_branch(trace: Any, now: int, level: float) -> int:
    """Return the next branch inwards from `now` that reaches below a depth, -1 if none does."""
    while now >= 0 and trace[START_DEPTH, now] >= level:
        now -= 1
    return now


@kernel()
def unload_from(table: Any, curve: Curve, trace: Any, branch: int, losses: bool) -> None:
    """Complete what unloading loses from the start of a branch to the end of contact, on it and all that it visits."""
    # outwards to inwards until a branch is known, then back
    now = branch
    while trace[UNLOADING_JUMPS, now] < 0.0:
        if now == 0 and trace[START, 0] == 0.0:  # k = 1: the contact shrinks to a point
            trace[UNLOADING_LOSS, 0], trace[UNLOADING_JUMPS, 0], trace[LAST_DEPTH, 0] = 0.0, 0.0, -1.0
            break
        start, level = trace[START, now], trace[START_DEPTH, now]
        lower = _lower_branch(trace, now - 1, level)
        if lower < 0:
            trace[UNLOADING_LOSS, now] = -energy_from_zero(table, curve, start, level) if losses else 0.0
            trace[UNLOADING_JUMPS, now], trace[LAST_DEPTH, now] = 1.0, level
            break
        now = lower
    inner = now
    now = branch
    while now > inner:
        # the way back is the way in: fill from the innermost unknown branch outwards
        outer = now
        lower = _lower_branch(trace, outer - 1, trace[START_DEPTH, outer])
        while lower > inner:
            outer = lower
            lower = _lower_branch(trace, outer - 1, trace[START_DEPTH, outer])
        loss = 0.0
        if losses:
            landing = find_depth(table, curve, trace[START_DEPTH, outer], trace[:, lower])
            loss = jump_energy(table, curve, trace[START, outer], landing, trace[WORK])
        trace[UNLOADING_LOSS, outer] = loss + trace[UNLOADING_LOSS, lower]
        trace[UNLOADING_JUMPS, outer] = 1.0 + trace[UNLOADING_JUMPS, lower]
        trace[LAST_DEPTH, outer] = trace[LAST_DEPTH, lower]
        inner = outer


@kernel()
def unloading_from(
    table: Any, curve: Curve, count: int, trace: Any, rim: float, rim_depth: float, losses: bool
) -> tuple[float, float, float]:
    """Return what unloading from the rim loses, its jumps, and the depth at which contact ends."""
    now = count - 1
    while now >= 0 and trace[START, now] > rim:
        now -= 1
    loss, jumps = 0.0, 0.0
    if now < 0 or trace[END, now] < rim:  # the rim is on a falling part: unloading leaves it by a jump
        now = _lower_branch(trace, now, rim_depth)
        if now < 0:
            return -energy_from_zero(table, curve, rim, rim_depth) if losses else 0.0, 1.0, rim_depth
        if losses:
            landing = find_depth(table, curve, rim_depth, trace[:, now])
            loss = jump_energy(table, curve, rim, landing, trace[WORK])
        jumps = 1.0
    unload_from(table, curve, trace, now, losses)
    return loss + trace[UNLOADING_LOSS, now], jumps + trace[UNLOADING_JUMPS, now], trace[LAST_DEPTH, now]


@kernel()
def highest_depth(count: int, trace: Any, rim: float, rim_depth: float) -> float:
    """Return the largest depth on the way to the rim, 0 if all are negative."""
    highest = max(0.0, rim_depth)
    for now in range(count):
        if trace[END, now] < rim:
            highest = max(highest, trace[END_DEPTH, now])
    return highest
