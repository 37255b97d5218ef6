"""Whether the contact stays one disc while it is loaded up to a rim: the gap outside it must nowhere be negative.

Only radii that a jump of loading passes have to be tested, for the contact before the jump (docs/theory.md,
sections 12 and 15); the jump from zero contact leaves the profile itself. Unloading is always one disc. On a branch the
gap at a given radius falls as the contact grows, so that its end is the worst place. And where the gap is not negative
up to the place of landing, it is not beyond either: on the branch of landing depth_H exceeds the depth, and every later
end of a branch stands deeper than this one.

A jump is surely open if the coordinate falls over it by no more than the stretch of the contact before it, which the
trace shows. Else the least opening is searched (contact/least.py).
"""

import math

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.contact.least import least_opening
from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    NOWHERE,
    RUN,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    START_DEPTH,
    Trace,
    ends,
)
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.face import (
    AnyCurve,
    AnyTable,
    coordinate_at,
    gap_in,
    is_always_one_disc,
    surely_open,
    touches_at_centre,
    waves_are_one_disc,
)


@kernel()
def is_surely_open(table: AnyTable, curve: AnyCurve, left: float, fall: float) -> bool:
    """Return whether a jump leaves one disc because the coordinate falls by no more than `fall` over it."""
    return surely_open(table, curve, left) >= fall


@kernel()
def jump_is_one_disc(table: AnyTable, curve: AnyCurve, left: float, end: float) -> bool:
    """Return whether the gap of the contact that a jump leaves, 0 for none, is nowhere negative up to `end`."""
    return touches_at_centre(table, curve, end) if left == 0.0 else least_opening(table, curve, left, end) >= 0.0


@kernel()
def climb_is_one_disc(
    table: AnyTable, curve: AnyCurve, count: int, trace: Trace, rim: float, left: float, level: float, whole: float
) -> bool:
    """Return whether loading over the branches of a trace, and on to the rim, keeps the contact one disc.

    It begins at the radius x = `left` and the coordinate `level`; branches and rim are `whole` waves further out, and a
    rim of -inf is none.
    """
    from_level = -math.inf
    for branch in range(count + 1):
        if branch < count:
            from_level = min(from_level, trace[START_DEPTH, branch])
            if trace[END_DEPTH, branch] <= level:
                continue
        elif left < whole + rim:
            from_level = min(from_level, coordinate_at(table, curve, rim, whole))
        else:
            break
        if left == 0.0 or not is_surely_open(table, curve, left, level - from_level):
            end = whole + (find_level(table, curve, level, ends(trace, branch), whole) if branch < count else rim)
            if not jump_is_one_disc(table, curve, left, end):
                return False
        if branch < count:
            left, level, from_level = whole + trace[END, branch], trace[END_DEPTH, branch], math.inf
    return True


@kernel()
def limits_from(
    table: AnyTable, curve: AnyCurve, first: int, last: int, now: int, count: int, trace: Trace, furthest: float
) -> tuple[float, float]:
    """Return what `disc_limits` does, from jumps that land on the branches `first` to `last`, `count` for the rim.

    Loading, one disc so far, leaves the branch `now` before.
    """
    gap, lowest = gap_in(curve, trace), math.inf
    for branch in range(first, last + 1):
        landing = furthest
        if branch < count:
            lowest = min(lowest, trace[START_DEPTH, branch])
            landing = trace[ARRIVAL, branch]
            if landing == math.inf:
                continue
        left, end = trace[END, now] if now >= 0 else 0.0, min(furthest, landing)
        across = now < gap <= branch
        if across and branch < count and trace[RUN, RUN_LAST] >= trace[RUN, RUN_FIRST]:
            if not waves_are_one_disc(table, curve, trace):
                return left, left
            end = trace[RUN, RUN_LANDING]
        if left < end:
            if branch == count:
                lowest = min(lowest, coordinate_at(table, curve, furthest, 0.0))
            surely = now >= 0 and not across and is_surely_open(table, curve, left, trace[END_DEPTH, now] - lowest)
            if not surely and not jump_is_one_disc(table, curve, left, end):
                return left, landing
        now, lowest = branch, math.inf
    return math.inf, math.inf


@kernel()
def disc_limits(table: AnyTable, curve: AnyCurve, count: int, trace: Trace, furthest: float) -> tuple[float, float]:
    """Return the radius up to which loading keeps the contact one disc, and that from which on it does not.

    They are those of the first jump that does not, as far as `furthest`; for a rim between the two `is_one_disc` tests
    again. Infinite where loading keeps one disc throughout.

    The trace is what `walk` (path/cosine.py, path/general.py) or `stride` (path/cosine_long.py) has returned;
    `furthest` is the rim in x = a/lambda, the largest one if there are several.
    """
    if is_always_one_disc(table, curve):
        return math.inf, math.inf
    return limits_from(table, curve, NONE, count, NOWHERE, count, trace, furthest)


@kernel()
def is_one_disc(table: AnyTable, curve: AnyCurve, limits: tuple[float, float], rim: float) -> bool:
    """Return whether loading keeps the contact one disc up to a rim, from the limits of its curve."""
    low, high = limits
    if rim <= low or rim >= high:
        return rim <= low
    return jump_is_one_disc(table, curve, low, rim)
