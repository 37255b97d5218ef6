"""Loading and unloading over pieces of a long curve (path/general_long.py), from a state to a state.

Loading follows the running maximum of the coordinate outwards, unloading its running minimum inwards. A piece is an
array of branches in the rows of curve/general_branches.py, with places x beyond some whole waves (harmonics/series.py);
its last branch may end at the rim.

Each jump may be noted, for results other than the energy: a row of kind, whole waves, start, end, and
whether the rim cuts the jump short. The first row counts; without rows there are no notes.
"""

import math
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, constant, kernel
from gradhesion.core.curve.branches import END, START, ends
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, coordinate, size
from gradhesion.core.curve.general_branches import END_LEVEL, START_LEVEL, Rows, find_level
from gradhesion.core.types import Floats
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero

Notes: TypeAlias = Floats
"""Notes of jumps: the first row counts the others; of shape (rows, 5), without rows for none."""


class State(NamedTuple):
    """How far loading or unloading has come."""

    loss: float  # what it has lost so far, in 2 pi l^2 dgamma
    jumps: float  # how many it has made
    level: float  # the coordinate, in s l^c
    waves: float  # the place that it leaves next: whole waves,
    left: float  # and x beyond them; both 0 for no contact
    close: bool  # whether a decision was close


class Piece(NamedTuple):
    """Branches of a part of a long curve."""

    branches: int  # how many they are
    rows: Rows  # the branches, at x beyond some whole waves
    whole: float  # these waves


NOTED_UP, NOTED_DOWN, NOTED_JUMP, NOTED_IN, NOTED_OUT = map(constant, range(5))
"""What is noted: waves that are summed, their first and last one for start and end; a jump; and those from and to zero
contact, whose other end is their start."""
_COLUMNS: Final = 5


@kernel()
def notes_for(rows: int) -> Floats:
    """Return room for notes, of shape (rows, 5); the first of them counts the others."""
    notes = np.empty((rows, _COLUMNS))
    if rows > 0:
        notes[0, 0] = 0.0
    return notes


@kernel()
def note(notes: Notes, kind: int, waves: float, start: float, end: float, cut: bool) -> None:
    """Note a jump, or waves that are summed."""
    if notes.shape[0] == 0:
        return
    notes[0, 0] += 1.0
    row = int(notes[0, 0])
    if row < notes.shape[0]:
        notes[row, 0], notes[row, 1], notes[row, 2], notes[row, 3], notes[row, 4] = kind, waves, start, end, cut


@kernel()
def _note_leap(notes: Notes, state: State, x: float, whole: float, cut: bool) -> None:
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
def _is_near(basis: Basis, curve: Series, first: float, other: float, x: float, whole: float) -> bool:
    """Return whether two coordinates differ by less than CLOSE of their terms at whole + x."""
    return abs(first - other) <= CLOSE * size(basis, curve, x, whole)


@kernel()
def climb(basis: Basis, curve: Series, piece: Piece, state: State, sure: float, losses: bool, notes: Notes) -> State:
    """Follow loading from a state over the branches of a piece; return the state at the end of the last it visits.

    It surely reaches the x `sure`: whether the curve there is higher is no close decision. With `losses` the energies
    of jumps are found, and noted in rows of `notes` (`notes_for`).
    """
    count, rows, whole = piece
    for branch in range(count):
        loss, jumps, level, _, _, close = state
        top = rows[END_LEVEL, branch]
        end = rows[END, branch]
        if top < math.inf and end != sure and _is_near(basis, curve, top, level, end, whole):
            close = True
        if top > level:
            if losses or end == math.inf:
                x = find_level(basis, curve, level, ends(rows, branch), whole)
                end = x if end == math.inf else end  # nothing leaves it: where loading has arrived
            if losses:
                loss += _leap(basis, curve, state, x, whole)
                _note_leap(notes, state, x, whole, NO)
            state = State(loss, jumps + 1.0, top, whole, end, close)
        else:
            state = State(loss, jumps, level, state.waves, state.left, close)
    return state


@kernel()
def reach_rim(basis: Basis, curve: Series, rim: float, state: State, losses: bool, whole: float, notes: Notes) -> State:
    """Follow loading from its last branch to the rim, at x = `rim` beyond `whole` waves."""
    loss, jumps, level, waves, left, close = state
    if (waves - whole) + left < rim < math.inf:
        if losses:
            loss += _leap(basis, curve, state, rim, whole)
            _note_leap(notes, state, rim, whole, YES)
        jumps += 1.0
    return State(loss, jumps, level, waves, left, close)


@kernel()
def leave_rim(basis: Basis, curve: Series, piece: Piece, rim: float) -> tuple[int, State]:
    """Return how many branches of a piece are inside of where unloading is when it has left the rim, and its state."""
    count, rows, whole = piece
    if count > 0 and rows[END, count - 1] == rim:
        return count - 1, State(0.0, 0.0, rows[START_LEVEL, count - 1], whole, rows[START, count - 1], NO)
    return count, State(0.0, 0.0, coordinate(basis, curve, rim, whole), whole, rim, NO)


@kernel()
def descend(basis: Basis, curve: Series, piece: Piece, state: State, losses: bool, notes: Notes) -> State:
    """Follow unloading from a state inwards over the branches of a piece; `losses` and `notes` as of `climb`."""
    count, rows, whole = piece
    for branch in range(count - 1, -1, -1):
        loss, jumps, level, waves, left, close = state
        bottom = rows[START_LEVEL, branch]
        if _is_near(basis, curve, bottom, level, left, waves):
            close = True
        if bottom < level:
            if losses:
                x = find_level(basis, curve, level, ends(rows, branch), whole)
                loss += jump_between(basis, curve, left, (whole - waves) + x, waves)
                note(notes, NOTED_JUMP, waves, left, (whole - waves) + x, NO)
            state = State(loss, jumps + 1.0, bottom, whole, rows[START, branch], close)
        else:
            state = State(loss, jumps, level, waves, left, close)
    return state


@kernel()
def leave(basis: Basis, curve: Series, state: State, losses: bool, notes: Notes) -> State:
    """Follow unloading from the last branch to zero contact."""
    loss, jumps, level, waves, left, close = state
    if waves + left > 0.0:
        jumps += 1.0
        if losses:
            loss -= jump_from_zero(basis, curve, left, level, waves)
            note(notes, NOTED_OUT, waves, left, 0.0, NO)
    return State(loss, jumps, level, waves, left, close)
