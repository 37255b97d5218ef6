"""Unloading: down a branch to its start, then inwards at that depth to the next branch that reaches lower.

Where unloading goes from the start of a branch does not depend on where it came from, so that the branch on which it
lands next, the place there, and the loss from the start to the end of contact are kept with the branch. The loop
integral and the drawn path read them. The curve is any of core/face.py; "depth" stands for what is prescribed, but
in the depth at which contact ends.
"""

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import (
    CALLER,
    END,
    LANDING,
    LAST_DEPTH,
    NEXT,
    START,
    START_DEPTH,
    UNLOADING_JUMPS,
    UNLOADING_LOSS,
    WORK,
    Trace,
    branch_within,
)
from gradhesion.core.face import AnyCurve, AnyTable, depth_at, find_place, loss_between, loss_to_zero


@kernel()
def leave(trace: Trace, branch: int, loss: float, jumps: float, last_depth: float) -> None:
    """Keep what unloading loses from the start of a branch to the end of contact, its jumps, and the depth there."""
    trace[UNLOADING_LOSS, branch], trace[UNLOADING_JUMPS, branch], trace[LAST_DEPTH, branch] = loss, jumps, last_depth


@kernel()
def next_lower(trace: Trace, branch: int, level: float) -> int:
    """Return the first branch from `branch` inwards that starts below a depth, -1 if none does."""
    while branch >= 0 and trace[START_DEPTH, branch] >= level:
        branch -= 1
    return branch


@kernel()
def descend(table: AnyTable, curve: AnyCurve, trace: Trace, branch: int, losses: bool) -> None:
    """Complete where unloading goes from the start of a branch on, and what it loses, for all that it visits."""
    now = branch
    while trace[UNLOADING_JUMPS, now] < 0.0:  # inwards to where it is known, or to the end of contact
        start, level = trace[START, now], trace[START_DEPTH, now]
        lower = next_lower(trace, now - 1, level)
        trace[NEXT, now] = lower
        if start == 0.0:  # k = 1: the contact shrinks to a point
            leave(trace, now, 0.0, 0.0, depth_at(table, curve, start, level))
        elif lower < 0:
            loss = loss_to_zero(table, curve, start, level) if losses else 0.0
            leave(trace, now, loss, 1.0, depth_at(table, curve, start, level))
        else:
            landing = find_place(table, curve, level, trace, lower)
            loss = loss_between(table, curve, start, landing, trace[WORK]) if losses else 0.0
            trace[LANDING, now], trace[UNLOADING_LOSS, now] = landing, loss
            trace[CALLER, lower] = now
            now = lower
    while now != branch:  # and back
        outer = int(trace[CALLER, now])
        loss = trace[UNLOADING_LOSS, now] + trace[UNLOADING_LOSS, outer]
        leave(trace, outer, loss, trace[UNLOADING_JUMPS, now] + 1.0, trace[LAST_DEPTH, now])
        now = outer


@kernel()
def jumps_out_from(count: int, trace: Trace, rim: float, rim_depth: float) -> bool:
    """Return whether unloading goes from the rim to zero contact at once."""
    now = branch_within(count, trace, rim)
    return not (now >= 0 and trace[END, now] >= rim) and next_lower(trace, now, rim_depth) < 0


@kernel()
def leave_rim(
    table: AnyTable, curve: AnyCurve, count: int, trace: Trace, rim: float, rim_depth: float
) -> tuple[int, float]:
    """Return the branch on which unloading is when it has left the rim, -1 for none, and where it arrives there.

    That is the rim itself where it stands on a branch; else unloading leaves it by a jump.
    """
    now = branch_within(count, trace, rim)
    if now >= 0 and trace[END, now] >= rim:
        return now, rim
    now = next_lower(trace, now, rim_depth)
    return now, find_place(table, curve, rim_depth, trace, now) if now >= 0 else 0.0


@kernel()
def unloading_from(
    table: AnyTable, curve: AnyCurve, count: int, trace: Trace, rim: float, rim_depth: float, losses: bool
) -> tuple[float, float, float]:
    """Return what unloading from the rim loses, its jumps, and the depth at which contact ends."""
    now, landing = leave_rim(table, curve, count, trace, rim, rim_depth)
    if now < 0:
        loss = loss_to_zero(table, curve, rim, rim_depth) if losses else 0.0
        return loss, 1.0, depth_at(table, curve, rim, rim_depth)
    loss, jumps = 0.0, 0.0
    if landing != rim:
        loss = loss_between(table, curve, rim, landing, trace[WORK]) if losses else 0.0
        jumps = 1.0
    descend(table, curve, trace, now, losses)
    return loss + trace[UNLOADING_LOSS, now], jumps + trace[UNLOADING_JUMPS, now], trace[LAST_DEPTH, now]
