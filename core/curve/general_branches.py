"""The branches of a curve between its folds, in the rows of core/curve/branches.py: on each the coordinate Y rises."""

import math
from typing import Final, TypeAlias

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import END, END_DEPTH, START, START_DEPTH
from gradhesion.core.curve.general import Basis, Series, coordinate, rise
from gradhesion.core.curve.general_folds import Zeros
from gradhesion.core.face import depth_of_point
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.types import Floats

START_LEVEL: Final = START_DEPTH
END_LEVEL: Final = END_DEPTH
"""The coordinates at the two ends."""
Rows: TypeAlias = Floats
"""Branches of a general curve: the rows START, START_LEVEL, END and END_LEVEL, of shape (4 or more, branches or more);
x is beyond some whole waves where these are given, levels are coordinates in s l^c."""
_STEPS: Final = 200
_OUTERMOST: Final = 1e100
_FAR: Final = 1e6
"""End of a branch over its start from which on that is no bracket for a search."""
_SURE: Final = 1e-6
"""Step over the length on which the slope changes, whose cube is below rounding."""


@kernel()
def fill_branches(
    basis: Basis, curve: Series, zeros: Zeros, count: int, rises: bool, rim: float, trace: Rows, whole: float = 0.0
) -> int:
    """Fill the trace from the folds within the rim; return the number of branches. All stand `whole` waves out.

    The last branch ends at the rim if no fold ends it before.
    """
    _, _, _, alpha, _ = curve
    branches = 0
    inside = rises
    if rises:  # contact grows from a point (k = 1): without load
        trace[START, 0], trace[START_LEVEL, 0] = 0.0, alpha * depth_of_point(basis, curve)
    for i in range(count):
        if inside:
            trace[END, branches], trace[END_LEVEL, branches] = zeros[i], coordinate(basis, curve, zeros[i], whole)
            branches += 1
        else:
            trace[START, branches], trace[START_LEVEL, branches] = zeros[i], coordinate(basis, curve, zeros[i], whole)
        inside = not inside
    if inside:
        trace[END, branches] = rim
        trace[END_LEVEL, branches] = coordinate(basis, curve, rim, whole) if rim < math.inf else math.inf
        branches += 1
    return branches


@kernel()
def find_level(
    basis: Basis, curve: Series, target: float, branch: tuple[float, float, float, float], whole: float = 0.0
) -> float:
    """Return where a branch meets a coordinate between those of its ends (Halley, kept in the bracket).

    `branch` has what `ends` of core/curve/branches.py returns.
    """
    low, low_level, high, high_level = branch
    if not low_level < target < high_level:
        return low if target <= low_level else high
    if high > _FAR * (1.0 + whole + low):  # or infinite
        step = whole + low if whole + low > 0.0 else 1.0
        high = low + step
        high_level = coordinate(basis, curve, high, whole)
        while high < _OUTERMOST and not high_level > target:
            step *= 2.0
            low, low_level, high = high, high_level, high + step
            high_level = coordinate(basis, curve, high, whole)
    x = 0.5 * (low + high)
    share = (target - low_level) / (high_level - low_level)
    if 0.0 < share < 1.0:  # a half wave of a cosine has both its ends level, as the branch has
        x = low + (high - low) * math.acos(1.0 - 2.0 * share) / math.pi
        x = x if low < x < high else 0.5 * (low + high)
    for _ in range(_STEPS):
        here, rate, bow = rise(basis, curve, x, whole)
        rest = here - target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        bend = 0.5 * rest * bow
        if abs(bend) > 0.5 * rate * rate:
            bend = 0.0
        step = -rest * rate / (rate * rate - bend)
        next_x = x + step / TWO_PI
        if low <= next_x <= high and abs(step) * (abs(bow) + abs(rate)) <= _SURE * abs(rate) * min(1.0, whole + x):
            return next_x
        x = next_x
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x
