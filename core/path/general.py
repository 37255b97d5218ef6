"""The branches of a general curve with the cycle on them: where loading arrives, where unloading goes, what they lose.

The records are those of one cosine (core/curve/branches.py), and the same kernels fill and read them
(core/path/loading.py, core/path/unloading.py), by the functions of core/face.py, as `walk` finds the folds. They are
the same for all rims of a curve: loading does not depend on the rim until it gets there, and unloading does not depend
on where it came from.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.branches import ROWS, UNKNOWN, UNLOADING_JUMPS, Trace
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, slope, state
from gradhesion.core.curve.general_branches import fill_branches
from gradhesion.core.curve.general_folds import MOST_FOLDS, Zeros
from gradhesion.core.face import find_all_folds
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.loading import load_up
from gradhesion.core.path.ties import PAIR, note_loading

_ROOM: Final = 16
"""Floats that a jump has room for (core/face.py)."""


@kernel()
def first_close_pair(zeros: Zeros, count: int, whole: float) -> float:
    """Return the first of the folds that has another so near that the pair may vanish, inf if none has.

    They stand at `zeros` beyond some whole waves (path/ties.py says when a decision is close).
    """
    for i in range(1, count):
        width = TWO_PI * (zeros[i] - zeros[i - 1])
        if width * width <= PAIR * min(1.0, TWO_PI * (whole + zeros[i])) ** 2:
            return zeros[i]
    return math.inf


@kernel()
def is_at_a_fold(basis: Basis, curve: Series, x: float, whole: float) -> bool:
    """Return whether whole + x is a fold, as far as anybody can tell: by a step of Newton's method."""
    value, rate, _ = slope(basis, curve, x, whole)
    return abs(value) <= 2.0 * CLOSE * TWO_PI * (whole + x) * abs(rate)


@kernel()
def walk(
    basis: Basis, curve: Series, bounds: tuple[float, float], furthest: float, losses: bool
) -> tuple[int, Trace, float]:
    """Follow loading up to x = `furthest`, fold by fold: they stand between the two places of `bounds`.

    Returns
    -------
    The number of branches, -1 if there are too many to trace; the trace, whose last branch ends at `furthest` if
    no fold ends it before; and the innermost place at which a pair of folds is about to be born or to vanish, else inf.
    """
    zeros = np.empty(MOST_FOLDS)
    count, rises, tangency = 0, NO, math.inf
    first, last = bounds[0], min(bounds[1], furthest)
    if first < last:
        count, rises, tangency = find_all_folds(basis, curve, first, last, zeros)
    trace = np.empty((ROWS, max(_ROOM, count // 2 + 2)))
    if count < 0:
        return -1, trace, tangency
    branches = fill_branches(basis, curve, zeros, count, rises, furthest, trace, 0.0)
    trace[UNLOADING_JUMPS, :branches] = UNKNOWN
    load_up(basis, curve, branches, trace, furthest, losses)
    note_loading(basis, curve, branches, trace, furthest)
    return branches, trace, min(tangency, first_close_pair(zeros, count, 0.0))


@kernel()
def depth_at_full_contact(basis: Basis, curve: Series, rim: float, level: float, whole: float) -> float:
    """Return the depth at which loading ends: pinned at the rim, at the coordinate `level` or that of the rim."""
    _, _, _, alpha, beta = curve
    _, _, front, depth, load = state(basis, curve, rim, whole)
    own = alpha * depth + beta * load
    return depth + max(0.0, level - own) / (alpha + beta * front)
