"""The cycle of any profile under any control: core/loading.py and core/unloading.py with a coordinate for the depth.

Loading follows the running maximum of the coordinate from 0 outwards, unloading its running minimum from the rim
inwards. The last branch of a trace may end at the rim. Places are x beyond some whole waves (series.py).
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core._jit import NO, kernel
from gradhesion.core.folds import CLOSE
from gradhesion.core.general.branches import END, END_LEVEL, START, START_LEVEL, fill_branches, find_level
from gradhesion.core.general.contact import loading_is_one_disc
from gradhesion.core.general.curve import Basis, Curve, coordinate, size, state
from gradhesion.core.general.folds import MOST_FOLDS, find_folds, room
from gradhesion.core.general.passage import jump_between, jump_from_zero
from gradhesion.core.struve.circle import TWO_PI

State: TypeAlias = tuple[float, float, float, float, float, bool]
"""Of loading or unloading: its loss and jumps so far, the coordinate, the place that it leaves next (whole waves and x
beyond them, both 0 for no contact), and whether a decision was close."""
_PAIR: Final = 8.0 * CLOSE


@kernel()
def _is_close(basis: Basis, curve: Curve, first: float, other: float, x: float, whole: float) -> bool:
    """Return whether two coordinates differ by less than CLOSE of their terms."""
    return abs(first - other) <= CLOSE * size(basis, curve, x, whole)


@kernel()
def _leap(basis: Basis, curve: Curve, state: State, x: float, whole: float) -> float:
    """Return e of the jump outwards from a state to whole + x."""
    _, _, level, waves, left, _ = state
    if waves + left == 0.0:
        return jump_from_zero(basis, curve, x, level, whole)
    return jump_between(basis, curve, left, (whole - waves) + x, waves)


@kernel()
def climb(basis: Basis, curve: Curve, count: int, trace: Any, state: State, losses: bool, whole: float) -> State:
    """Follow loading from a state over the branches of a trace, `whole` waves out."""
    for branch in range(count):
        loss, jumps, level, _, _, close = state
        top = trace[branch, END_LEVEL]
        if top < math.inf and _is_close(basis, curve, top, level, trace[branch, END], whole):
            close = True
        if top > level:
            if losses:
                loss += _leap(basis, curve, state, find_level(basis, curve, level, trace[branch], whole), whole)
            state = (loss, jumps + 1.0, top, whole, trace[branch, END], close)
        else:
            state = (loss, jumps, level, state[3], state[4], close)
    return state


@kernel()
def reach_rim(basis: Basis, curve: Curve, rim: float, state: State, losses: bool, whole: float) -> State:
    """Follow loading from its last branch to the rim."""
    loss, jumps, level, waves, left, close = state
    if (waves - whole) + left < rim < math.inf:
        if losses:
            loss += _leap(basis, curve, state, rim, whole)
        jumps += 1.0
    return loss, jumps, level, waves, left, close


@kernel()
def leave_rim(basis: Basis, curve: Curve, count: int, trace: Any, rim: float, whole: float) -> tuple[int, State]:
    """Return the branches of a trace inside of where unloading is when it has left the rim, and its state."""
    if count > 0 and trace[count - 1, END] == rim:
        return count - 1, (0.0, 0.0, trace[count - 1, START_LEVEL], whole, trace[count - 1, START], NO)
    return count, (0.0, 0.0, coordinate(basis, curve, rim, whole), whole, rim, NO)


@kernel()
def descend(basis: Basis, curve: Curve, count: int, trace: Any, state: State, losses: bool, whole: float) -> State:
    """Follow unloading from a state inwards over the first `count` branches of a trace, `whole` waves out."""
    for branch in range(count - 1, -1, -1):
        loss, jumps, level, waves, left, close = state
        bottom = trace[branch, START_LEVEL]
        if _is_close(basis, curve, bottom, level, left, waves):
            close = True
        if bottom < level:
            if losses:
                x = find_level(basis, curve, level, trace[branch], whole)
                loss += jump_between(basis, curve, left, (whole - waves) + x, waves)
            state = (loss, jumps + 1.0, bottom, whole, trace[branch, START], close)
        else:
            state = (loss, jumps, level, waves, left, close)
    return state


@kernel()
def leave(basis: Basis, curve: Curve, state: State, losses: bool) -> State:
    """Follow unloading from the last branch to zero contact."""
    loss, jumps, level, waves, left, close = state
    if waves + left > 0.0:
        jumps += 1.0
        if losses:
            loss -= jump_from_zero(basis, curve, left, level, waves)
    return loss, jumps, level, waves, left, close


@kernel()
def folds_are_close(zeros: Any, count: int, rim: float, whole: float) -> bool:
    """Return whether two folds, or a fold and the rim, can hardly be told apart."""
    for i in range(count):
        if abs(zeros[i] - rim) <= 2.0 * CLOSE * (whole + zeros[i]):
            return True
        if i > 0:
            width = TWO_PI * (zeros[i] - zeros[i - 1])
            if width * width <= _PAIR * min(1.0, TWO_PI * (whole + zeros[i])) ** 2:
                return True
    return False


@kernel()
def walk(basis: Basis, curve: Curve, first: float, last: float, rim: float, tasks: tuple[bool, bool, bool]) -> Any:
    """Follow the cycle up to a rim, fold by fold: they stand between the places `first` and `last`.

    Parameters
    ----------
    tasks
        Whether what is lost shall be told, whether what the end of contact loses is a part of it, and whether loading
        shall be tested for keeping the contact one disc.

    Returns
    -------
    Whether it could be done; the states at the end of loading and of unloading (the coordinate that loading ends with,
    and the place that the last jump leaves, 0 if contact ends at a point), whether a decision was close, whether
    the contact stays one disc as far as was asked, and the rim as whole waves (none) and x beyond them.
    """
    losses, last_loss, test = tasks
    nothing = (0.0, 0.0, 0.0, 0.0, 0.0, NO)
    zeros = np.empty(MOST_FOLDS)
    count, rises, tangency = 0, False, math.inf
    if first < last:
        count, rises, tangency = find_folds(basis, curve, first, last, room(), zeros, 0.0)
    if count < 0:
        return False, nothing, nothing, False, True, 0.0, rim
    trace = np.empty((count // 2 + 2, 4))
    branches = fill_branches(basis, curve, zeros, count, rises, rim, trace, 0.0)
    close = tangency < math.inf or folds_are_close(zeros, count, rim, 0.0)
    loading = climb(basis, curve, branches, trace, nothing, losses, 0.0)
    loading = reach_rim(basis, curve, rim, loading, losses, 0.0)
    inside, unloading = leave_rim(basis, curve, branches, trace, rim, 0.0)
    unloading = descend(basis, curve, inside, trace, unloading, losses, 0.0)
    unloading = leave(basis, curve, unloading, losses and last_loss)
    one_disc = not test or loading_is_one_disc(basis, curve, branches, trace, rim)
    return True, loading, unloading, close or loading[5] or unloading[5], one_disc, 0.0, rim


@kernel()
def depth_at_full_contact(basis: Basis, curve: Curve, rim: float, level: float, whole: float) -> float:
    """Return the depth at which loading ends: pinned at the rim, at the coordinate `level` or that of the rim."""
    _, _, _, alpha, beta = curve
    _, _, front, depth, load = state(basis, curve, rim, whole)
    own = alpha * depth + beta * load
    return depth + max(0.0, level - own) / (alpha + beta * front)
