"""Loading and unloading over pieces of a long curve (path/general_long.py), from a state to a state.

Loading follows the running maximum of the coordinate outwards, unloading its running minimum inwards. A piece is an
array of branches in the rows of curve/general_branches.py, with places x beyond some whole waves (struve/series.py);
its last branch may end at the rim.

Each jump may be noted, for whoever asks more of a cycle than what it loses: a row of kind, whole waves, start, end, and
whether the rim cuts the jump short. The first row counts; without rows there are no notes.
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, constant, kernel
from gradhesion.core.curve.branches import END, START, ends
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_branches import END_LEVEL, START_LEVEL, find_level
from gradhesion.core.path.general_ties import is_near
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero

State: TypeAlias = tuple[float, float, float, float, float, bool]
"""Of loading or unloading: its loss and jumps so far, the coordinate, the place that it leaves next (whole waves and x
beyond them, both 0 for no contact), and whether a decision was close."""

NOTED_UP, NOTED_DOWN, NOTED_JUMP, NOTED_IN, NOTED_OUT = map(constant, range(5))
"""What is noted: waves that are summed, their first and last one for start and end; a jump; and those from and to zero
contact, whose other end is their start."""
_COLUMNS: Final = 5


@kernel()
def notes_for(rows: int) -> Any:
    """Return room for notes."""
    notes = np.empty((rows, _COLUMNS))
    if rows > 0:
        notes[0, 0] = 0.0
    return notes


@kernel()
def note(notes: Any, kind: int, waves: float, start: float, end: float, cut: bool) -> None:
    """Note a jump, or waves that are summed."""
    if notes.shape[0] == 0:
        return
    notes[0, 0] += 1.0
    row = int(notes[0, 0])
    if row < notes.shape[0]:
        notes[row, 0], notes[row, 1], notes[row, 2], notes[row, 3], notes[row, 4] = kind, waves, start, end, cut


@kernel()
def _note_leap(notes: Any, state: State, x: float, whole: float, cut: bool) -> None:
    """Note the jump outwards from a state to whole + x."""
    _, _, _, waves, left, _ = state
    if waves + left == 0.0:
        note(notes, NOTED_IN, whole, x, 0.0, cut)
    else:
        note(notes, NOTED_JUMP, waves, left, (whole - waves) + x, cut)


@kernel()
def _leap(basis: Basis, curve: Series, state: State, x: float, whole: float) -> float:
    """Return e of the jump outwards from a state to whole + x."""
    _, _, level, waves, left, _ = state
    if waves + left == 0.0:
        return jump_from_zero(basis, curve, x, level, whole)
    return jump_between(basis, curve, left, (whole - waves) + x, waves)


@kernel()
def climb(
    basis: Basis,
    curve: Series,
    count: int,
    trace: Any,
    state: State,
    losses: bool,
    whole: float,
    sure: float,
    notes: Any,
) -> State:
    """Follow loading from a state over the branches of a trace, `whole` waves out.

    It surely reaches the place `sure`: whether the curve there is higher is no close decision.
    """
    for branch in range(count):
        loss, jumps, level, _, _, close = state
        top = trace[END_LEVEL, branch]
        end = trace[END, branch]
        if top < math.inf and end != sure and is_near(basis, curve, top, level, end, whole):
            close = True
        if top > level:
            if losses or end == math.inf:
                x = find_level(basis, curve, level, ends(trace, branch), whole)
                end = x if end == math.inf else end  # nothing leaves it: where loading has arrived
            if losses:
                loss += _leap(basis, curve, state, x, whole)
                _note_leap(notes, state, x, whole, NO)
            state = (loss, jumps + 1.0, top, whole, end, close)
        else:
            state = (loss, jumps, level, state[3], state[4], close)
    return state


@kernel()
def reach_rim(basis: Basis, curve: Series, rim: float, state: State, losses: bool, whole: float, notes: Any) -> State:
    """Follow loading from its last branch to the rim."""
    loss, jumps, level, waves, left, close = state
    if (waves - whole) + left < rim < math.inf:
        if losses:
            loss += _leap(basis, curve, state, rim, whole)
            _note_leap(notes, state, rim, whole, YES)
        jumps += 1.0
    return loss, jumps, level, waves, left, close


@kernel()
def leave_rim(basis: Basis, curve: Series, count: int, trace: Any, rim: float, whole: float) -> tuple[int, State]:
    """Return the branches of a trace inside of where unloading is when it has left the rim, and its state."""
    if count > 0 and trace[END, count - 1] == rim:
        return count - 1, (0.0, 0.0, trace[START_LEVEL, count - 1], whole, trace[START, count - 1], NO)
    return count, (0.0, 0.0, coordinate(basis, curve, rim, whole), whole, rim, NO)


@kernel()
def descend(
    basis: Basis, curve: Series, count: int, trace: Any, state: State, losses: bool, whole: float, notes: Any
) -> State:
    """Follow unloading from a state inwards over the first `count` branches of a trace, `whole` waves out."""
    for branch in range(count - 1, -1, -1):
        loss, jumps, level, waves, left, close = state
        bottom = trace[START_LEVEL, branch]
        if is_near(basis, curve, bottom, level, left, waves):
            close = True
        if bottom < level:
            if losses:
                x = find_level(basis, curve, level, ends(trace, branch), whole)
                loss += jump_between(basis, curve, left, (whole - waves) + x, waves)
                note(notes, NOTED_JUMP, waves, left, (whole - waves) + x, NO)
            state = (loss, jumps + 1.0, bottom, whole, trace[START, branch], close)
        else:
            state = (loss, jumps, level, waves, left, close)
    return state


@kernel()
def leave(basis: Basis, curve: Series, state: State, losses: bool, notes: Any) -> State:
    """Follow unloading from the last branch to zero contact."""
    loss, jumps, level, waves, left, close = state
    if waves + left > 0.0:
        jumps += 1.0
        if losses:
            loss -= jump_from_zero(basis, curve, left, level, waves)
            note(notes, NOTED_OUT, waves, left, 0.0, NO)
    return loss, jumps, level, waves, left, close
