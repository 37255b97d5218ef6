"""Loading: up a branch to its end, then outwards at that depth to the next branch that reaches higher.

The curve is any of core/face.py; "depth" stands for what is prescribed.
"""

import math

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    HIGHEST,
    LOADING_JUMPS,
    LOADING_LOSS,
    NOWHERE,
    START,
    WORK,
    Trace,
    branch_within,
)
from gradhesion.core.face import AnyCurve, AnyTable, find_place, loss_between, loss_from_zero


@kernel()
def arrive(trace: Trace, branch: int, x: float, loss: float, jumps: float) -> None:
    """Keep where loading arrives on a branch, what it has lost by then, and in how many jumps."""
    trace[ARRIVAL, branch], trace[LOADING_LOSS, branch], trace[LOADING_JUMPS, branch] = x, loss, jumps


@kernel()
def next_higher(trace: Trace, branch: int, count: int, level: float) -> int:
    """Return the first branch from `branch` on that ends above a depth, `count` if none does."""
    while branch < count and trace[END_DEPTH, branch] <= level:
        branch += 1
    return branch


@kernel()
def climb(table: AnyTable, curve: AnyCurve, now: int, count: int, trace: Trace, furthest: float, losses: bool) -> int:
    """Follow loading from branch `now` on, outwards to `furthest`; return the last branch that it arrives on.

    now = -1 stands for no contact: the first jump is that from zero contact, at the depth 0.
    """
    loss, jumps = (trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]) if now >= 0 else (0.0, 0.0)
    while True:
        left, level = (trace[END, now], trace[END_DEPTH, now]) if now >= 0 else (0.0, 0.0)
        higher = next_higher(trace, now + 1, count, level)
        if left >= furthest or higher == count or trace[START, higher] > furthest:
            return now
        x = find_place(table, curve, level, trace, higher)
        if losses and now < 0:
            loss += loss_from_zero(table, curve, x)
        elif losses:
            loss += loss_between(table, curve, left, x, trace[WORK])
        jumps += 1.0
        arrive(trace, higher, x, loss, jumps)
        now = higher


@kernel()
def load_up(table: AnyTable, curve: AnyCurve, count: int, trace: Trace, furthest: float, losses: bool) -> int:
    """Follow loading from zero contact; return the last branch that it arrives on, -1 if none."""
    trace[ARRIVAL, :count] = math.inf
    return climb(table, curve, NOWHERE, count, trace, furthest, losses)


@kernel()
def loading_to(
    table: AnyTable, curve: AnyCurve, count: int, trace: Trace, rim: float, losses: bool
) -> tuple[float, float]:
    """Return what loading up to the rim loses, and its jumps."""
    now = branch_within(count, trace, rim)
    while now >= 0 and not trace[ARRIVAL, now] <= rim:
        now -= 1
    if now < 0:  # from zero contact to the rim at once
        return loss_from_zero(table, curve, rim) if losses else 0.0, 1.0
    loss, jumps = trace[LOADING_LOSS, now], trace[LOADING_JUMPS, now]
    left = trace[END, now]
    if left < rim:
        if losses:
            loss += loss_between(table, curve, left, rim, trace[WORK])
        jumps += 1.0
    return loss, jumps


@kernel()
def jumps_in_to(count: int, trace: Trace, rim: float) -> bool:
    """Return whether loading goes from zero contact to the rim at once."""
    branch = 0
    while branch < count and not trace[ARRIVAL, branch] <= rim:
        branch += 1
    return branch == count


@kernel()
def highest_depth(count: int, trace: Trace, rim: float, rim_depth: float) -> float:
    """Return the largest depth on the way to the rim, 0 if all are negative."""
    now = branch_within(count, trace, rim)
    if now >= 0 and trace[END, now] >= rim:
        now -= 1
    return max(rim_depth, trace[HIGHEST, now] if now >= 0 else 0.0, 0.0)
