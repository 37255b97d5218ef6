"""Ties: decisions on the path that an error of 1e-12 in an input could turn.

Force, energy and depths are continuous in every parameter; the number of jumps and the radius of the pull-off are not.
They change where one decision of the path does: whether a branch reaches higher than the depth of a jump outwards, or
lower than that of a jump inwards, whether the rim lies on a branch, and whether an arch holds a pair of folds at all.
Each is a comparison of two numbers of known size; one that they win or lose by less than CLOSE of that size is a tie.

On a long curve (cycle.py) the branches that are summed are not looked at: each is visited, and their neighbours stand
apart by a wave.
"""

import math
from typing import Any, Final

from gradhesion.core._jit import kernel
from gradhesion.core.branches import END, END_DEPTH, START, START_DEPTH, TANGENCY
from gradhesion.core.curve import Curve, depth
from gradhesion.core.folds import CLOSE
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power

_PAIR: Final = 8.0 * CLOSE
"""Two folds at a distance w in z have an extremum of w^2/8 of its terms between them."""


@kernel()
def tolerance(table: Any, curve: Curve, x: float) -> float:
    """Return CLOSE times the size of the terms of the depth at x."""
    b, g, _ = curve
    z = TWO_PI * x
    if z <= 0.0:
        return CLOSE
    return CLOSE * (0.5 * b * z * z + z * amplitude_power(table, z) * (1.0 + g * table.amplitude) + g)


@kernel()
def _rim_is_close_to_a_fold(count: int, trace: Any, rim: float) -> bool:
    """Return whether the rim stands on a fold, as far as anybody can tell."""
    for branch in range(count):
        near = min(abs(trace[START, branch] - rim), abs(trace[END, branch] - rim))
        if near <= 2.0 * CLOSE * rim:
            return True
    return False


@kernel()
def _folds_are_close(count: int, trace: Any, rim: float) -> bool:
    """Return whether a pair of folds within the rim is about to vanish, or another about to be born."""
    if trace[TANGENCY, 0] <= rim and trace[TANGENCY, 0] < math.inf:
        return True
    for branch in range(count):
        place = trace[START, branch]
        if place > rim:
            return False
        width = trace[END, branch] - place
        if branch > 0:
            width = min(width, place - trace[END, branch - 1])
        if place > 0.0 and (TWO_PI * width) ** 2 <= _PAIR * min(1.0, TWO_PI * place) ** 2:
            return True
    return False


@kernel()
def _loading_is_close(
    table: Any, curve: Curve, count: int, trace: Any, rim: float, rim_depth: float, turned: bool
) -> bool:
    """Return whether a branch hardly reaches the depth of the jump over it, or hardly misses it.

    That on which loading turns back is surely reached.
    """
    level = 0.0
    for branch in range(count):
        if trace[START, branch] > rim or trace[END, branch] == math.inf == rim:
            break
        inside = trace[END, branch] <= rim
        if turned and not inside:
            break
        top = trace[END_DEPTH, branch] if inside else rim_depth
        place = trace[END, branch] if inside else rim
        if abs(top - level) <= tolerance(table, curve, place):
            return True
        level = max(level, top)
    return False


@kernel()
def _unloading_is_close(table: Any, curve: Curve, count: int, trace: Any, rim: float, rim_depth: float) -> bool:
    """Return whether a branch hardly reaches down to the depth of the jump over it, or hardly misses it."""
    level, place = rim_depth, rim
    for branch in range(count - 1, -1, -1):
        if trace[START, branch] > rim:
            continue
        bottom = trace[START_DEPTH, branch]
        if trace[END, branch] >= rim:  # the rim is on it
            level, place = bottom, trace[START, branch]
            continue
        if abs(bottom - level) <= tolerance(table, curve, place):
            return True
        if bottom < level:
            level, place = bottom, trace[START, branch]
    return False


@kernel()
def rim_is_close(table: Any, curve: Curve, count: int, trace: Any, rim: float) -> bool:
    """Return whether the rim stands on a fold, or hardly reaches, or misses, the depth of a jump.

    That is all that belongs to the rim, and not to a cycle that turns there.
    """
    if rim == math.inf:
        return False
    if _rim_is_close_to_a_fold(count, trace, rim):
        return True
    level = 0.0
    for branch in range(count):
        if trace[END, branch] <= rim:
            level = max(level, trace[END_DEPTH, branch])
        elif trace[START, branch] <= rim:
            return bool(abs(depth(table, curve, rim) - level) <= tolerance(table, curve, rim))
    return False


@kernel()
def is_close_to_a_jump(
    table: Any, curve: Curve, count: int, trace: Any, rim: float, rim_depth: float, turned: bool
) -> bool:
    """Return whether an error of 1e-12 in an input could change the number of jumps of a cycle up to the rim.

    Where the rim is a turning point of another punch (`turned`), what belongs to the rim itself is left out.
    """
    if rim < math.inf and not turned and _rim_is_close_to_a_fold(count, trace, rim):
        return True
    return (
        _folds_are_close(count, trace, rim)
        or _loading_is_close(table, curve, count, trace, rim, rim_depth, turned)
        or _unloading_is_close(table, curve, count, trace, rim, rim_depth)
    )
