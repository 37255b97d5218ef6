"""The jumps of one cycle, one by one, read off its traces; what other curves lose between the same radii.

Loading and unloading are listed apart, for an edge that opens at a larger work than it closes at goes along two curves.
"""

import math
from typing import Final

from gradhesion.core.curve.energy import jump_energy
from gradhesion.core.curve.levels import EXACTLY, at_level, polished
from gradhesion.core.curve.trace import END, END_LEVEL, LANDING, START, START_LEVEL
from gradhesion.core.curve.values import Curve, coordinate_of, state_in
from gradhesion.core.cycle.path import inner_branch, started_within
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import end_of
from gradhesion.core.types import Floats, Integers

# Rows of jumps, (JUMP_ROWS, jumps): the state that is left, the radius of landing and its branch (-1: none), the loss.
LEFT, LEFT_DEPTH, LEFT_LOAD, LANDED, LANDED_BRANCH, LOSS = range(6)
JUMP_ROWS: Final = 6


@leaf
def _put_jump(jumps: Floats, n: int, y: float, depth: float, load: float, landing: float, branch: int) -> int:
    """Store jump n; return the number of jumps."""
    jumps[LEFT, n], jumps[LEFT_DEPTH, n], jumps[LEFT_LOAD, n] = y, depth, load
    jumps[LANDED, n], jumps[LANDED_BRANCH, n] = landing, branch
    return n + 1


@kernel
def list_loading_jumps(curve: Curve, rim: float, trace: Floats, visited: Integers, visits: int, jumps: Floats) -> int:
    """Store the jumps of loading up to a rim, all rows but LOSS, radii to rounding; return their number."""
    n, y, depth, load, level = 0, 0.0, 0.0, 0.0, 0.0
    for v in range(visits):
        j = visited[v]
        if trace[LANDING, j] > rim:
            break
        n = _put_jump(jumps, n, y, depth, load, polished(curve, trace[LANDING, j], level), j)
        y, level = polished(curve, trace[END, j], math.nan), trace[END_LEVEL, j]
        if y < rim:
            depth, load = state_in(curve, y)
    if y < rim:
        n = _put_jump(jumps, n, y, depth, load, rim, -1)
    return n


@kernel
def list_unloading_jumps(curve: Curve, rim: float, trace: Floats, count: int, jumps: Floats, n: int) -> int:
    """Store the jumps of unloading from a rim behind the first n, all rows but LOSS; return the number of jumps."""
    y, depth, load, level = rim, math.inf, math.inf, math.inf
    if rim <= end_of(curve.table):  # else it is on the endless branch
        depth, load = state_in(curve, rim)
        level = coordinate_of(curve, depth, load)
    j = started_within(trace, count, rim) - 1
    on_branch = j >= 0 and trace[END, j] >= rim
    while True:
        if on_branch:  # it is followed down to its start
            y, level = polished(curve, trace[START, j], math.nan), trace[START_LEVEL, j]
            if y == 0.0:  # the contact has shrunk to a point
                return n
            depth, load = state_in(curve, y)
            j -= 1
        j = inner_branch(trace, j, level)
        if j < 0:
            return _put_jump(jumps, n, y, depth, load, 0.0, -1)
        landing = at_level(curve, level, trace[START, j], trace[END, j], EXACTLY)
        n = _put_jump(jumps, n, y, depth, load, polished(curve, landing, level), j)
        on_branch = True


@kernel
def frozen_loss(curve: Curve, jumps: Floats, first: int, last: int) -> float:
    """Store what the jumps `first` to `last` - 1 would lose on a curve between their radii; return the sum.

    In 2 pi l^2 dgamma. All radii but a rim are stationary, so that the first derivatives of this are those of the loss.
    The jump-out of a dead load, which has no bounded energy, loses nothing here.
    """
    total = 0.0
    for n in range(first, last):
        y, depth, load = jumps[LEFT, n], 0.0, 0.0
        if y > 0.0:
            depth, load = state_in(curve, y)
        jumps[LOSS, n] = 0.0
        if jumps[LANDED, n] > 0.0 or curve.by_depth > 0.0:
            jumps[LOSS, n] = jump_energy(curve, y, depth, load, jumps[LANDED, n])
        total += jumps[LOSS, n]
    return total
