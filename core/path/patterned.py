"""The branches of a curve on a patterned interface with the cycle on them, as path/general.py."""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.branches import ROWS, UNKNOWN, UNLOADING_JUMPS, Trace
from gradhesion.core.curve.general import Basis
from gradhesion.core.curve.general_branches import fill_branches
from gradhesion.core.curve.general_folds import MOST_FOLDS
from gradhesion.core.curve.patterned import Patterned, are_too_many, folds_up_to
from gradhesion.core.path.general_ties import first_close_pair
from gradhesion.core.path.loading import load_up
from gradhesion.core.path.ties import note_loading

_ROOM: Final = 16
"""Floats that a jump has room for (core/face.py)."""


@kernel()
def walk(
    basis: Basis, curve: Patterned, bounds: tuple[float, float], furthest: float, losses: bool
) -> tuple[int, Trace, float]:
    """Do what `walk` of path/general.py does; all folds stand between the two places of `bounds`."""
    zeros = np.empty(MOST_FOLDS)
    count, rises, tangency = 0, NO, math.inf
    first, last = bounds[0], min(bounds[1], furthest)
    if first < last:
        if are_too_many(basis, first, last):
            return -1, np.empty((ROWS, 0)), math.inf
        count, rises, tangency = folds_up_to(basis, curve, first, last, zeros)
    trace = np.empty((ROWS, max(_ROOM, count // 2 + 2)))
    if count < 0:
        return -1, trace, tangency
    branches = fill_branches(basis, curve, zeros, count, rises, furthest, trace, 0.0)
    trace[UNLOADING_JUMPS, :branches] = UNKNOWN
    load_up(basis, curve, branches, trace, furthest, losses)
    note_loading(basis, curve, branches, trace, furthest)
    return branches, trace, min(tangency, first_close_pair(zeros, count, 0.0))
