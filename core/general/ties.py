"""Near-degenerate decisions on the path of a general curve, as core/ties.py: an error of 1e-12 in an input turns them.

Each is a comparison of two coordinates that differ by less than CLOSE of their terms, or of two places. Those of
loading are noted with the branches up to which they are taken, those of unloading with the branches from which on.
"""

import math
from typing import Any, Final

from gradhesion.core._jit import NO, YES, kernel
from gradhesion.core.branches import (
    CALLER,
    END,
    END_DEPTH,
    HIGHEST,
    LOADING_IS_CLOSE,
    START,
    START_DEPTH,
    UNKNOWN,
    UNLOADING_IS_CLOSE,
)
from gradhesion.core.folds import CLOSE
from gradhesion.core.general.curve import Basis, Curve, size, slope
from gradhesion.core.struve.circle import TWO_PI

_PAIR: Final = 8.0 * CLOSE
"""Two folds at a distance w in z have an extremum of w^2/8 of its terms between them."""


@kernel()
def is_near(basis: Basis, curve: Curve, first: float, other: float, x: float, whole: float) -> bool:
    """Return whether two coordinates differ by less than CLOSE of their terms at whole + x."""
    return abs(first - other) <= CLOSE * size(basis, curve, x, whole)


@kernel()
def first_close_pair(zeros: Any, count: int, whole: float) -> float:
    """Return the first of the folds that has another so near that the pair may vanish, inf if none has."""
    for i in range(1, count):
        width = TWO_PI * (zeros[i] - zeros[i - 1])
        if width * width <= _PAIR * min(1.0, TWO_PI * (whole + zeros[i])) ** 2:
            return zeros[i]
    return math.inf


@kernel()
def is_at_a_fold(basis: Basis, curve: Curve, x: float, whole: float) -> bool:
    """Return whether whole + x is a fold, as far as anybody can tell: by a step of Newton's method."""
    value, rate, _ = slope(basis, curve, x, whole)
    return abs(value) <= 2.0 * CLOSE * TWO_PI * (whole + x) * abs(rate)


@kernel()
def note_loading(basis: Basis, curve: Curve, count: int, trace: Any, furthest: float) -> None:
    """Note the highest coordinate up to the end of each branch, and whether a decision of loading was close before."""
    highest, close = 0.0, NO
    for branch in range(count):
        top = trace[END_DEPTH, branch]
        if trace[END, branch] < furthest and is_near(basis, curve, top, highest, trace[END, branch], 0.0):
            close = YES
        highest = max(highest, top)
        trace[HIGHEST, branch], trace[LOADING_IS_CLOSE, branch] = highest, close
        trace[UNLOADING_IS_CLOSE, branch] = UNKNOWN


@kernel()
def _scan_inwards(basis: Basis, curve: Curve, trace: Any, branch: int, level: float, place: float) -> tuple[bool, int]:
    """Return whether a branch from `branch` inwards hardly starts below a level, and the first that does, -1 if none.

    The level is that of the curve at `place`.
    """
    close = NO
    while branch >= 0:
        bottom = trace[START_DEPTH, branch]
        if is_near(basis, curve, bottom, level, place, 0.0):
            close = YES
        if bottom < level:
            break
        branch -= 1
    return close, branch


@kernel()
def _unloading_is_close(basis: Basis, curve: Curve, trace: Any, branch: int) -> bool:
    """Return whether a decision of unloading is close from the start of a branch on."""
    now = branch
    while trace[UNLOADING_IS_CLOSE, now] < 0.0:  # inwards to where it is known, or to a close decision
        if trace[START, now] == 0.0:
            trace[UNLOADING_IS_CLOSE, now] = NO
            break
        close, lower = _scan_inwards(basis, curve, trace, now - 1, trace[START_DEPTH, now], trace[START, now])
        if close or lower < 0:
            trace[UNLOADING_IS_CLOSE, now] = close
            break
        trace[CALLER, lower] = now
        now = lower
    while now != branch:
        outer = int(trace[CALLER, now])
        trace[UNLOADING_IS_CLOSE, outer] = trace[UNLOADING_IS_CLOSE, now]
        now = outer
    return trace[UNLOADING_IS_CLOSE, branch] > 0.0


@kernel()
def is_close_to_a_jump(
    basis: Basis, curve: Curve, count: int, trace: Any, tangency: float, rim: float, rim_level: float, turned: bool
) -> bool:
    """Return whether an error of 1e-12 in an input could change the number of jumps of a cycle up to the rim.

    Parameters
    ----------
    count, trace, tangency
        What `walk` (path.py) has returned.
    rim, rim_level
        The rim and the coordinate there.
    turned
        Whether the rim is a place that loading surely reaches, and no edge of a punch.
    """
    if tangency <= rim and tangency < math.inf:
        return True
    now = count - 1
    while now >= 0 and trace[START, now] > rim:
        now -= 1
    on_branch = now >= 0 and trace[END, now] >= rim
    before = now - 1 if on_branch else now
    if before >= 0 and trace[LOADING_IS_CLOSE, before] > 0.0:
        return True
    if rim < math.inf and not turned:
        if is_at_a_fold(basis, curve, rim, 0.0):
            return True
        highest = trace[HIGHEST, before] if before >= 0 else 0.0
        if on_branch and is_near(basis, curve, rim_level, highest, rim, 0.0):
            return True
    if on_branch:
        return _unloading_is_close(basis, curve, trace, now)
    close, lower = _scan_inwards(basis, curve, trace, now, rim_level, rim)
    return close or (lower >= 0 and _unloading_is_close(basis, curve, trace, lower))
