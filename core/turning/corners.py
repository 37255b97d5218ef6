"""The corners in depth or load that loading passes: where it lands on a branch, each extremum, and where it leaves.

Between two corners of one branch the measured coordinate, depth or load, rises or falls throughout. Where it is first
as large as a target, loading has either just landed, or stands between two corners.
"""

import math
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, NONE, constant, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, Trace
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, coordinate, size
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.curve.general_folds import Search, find_folds
from gradhesion.core.face import find_all_folds, measured_by, size_at, window
from gradhesion.core.types import Floats

PLACE, VALUE, TERMS, KIND = 0, 1, 2, 3
"""Rows: x beyond whole waves, the measured coordinate there, the size of its terms, and what the corner is."""
LANDING, FOLD, OPEN = map(constant, range(3))
"""Where a jump lands, a fold of the measured or of the prescribed coordinate, and the end of what is known."""
ROWS: Final = 4
_INNERMOST: Final = 1e-30
"""x from which on folds are searched for where contact grows from a point."""


Corners: TypeAlias = Floats
"""Corners in the order of loading, in the rows above, of shape (ROWS, corners or more)."""


class Place(NamedTuple):
    """Where corners are searched for."""

    search: Search  # room for a search of folds
    zeros: Floats  # room for what it finds, of shape (MOST_FOLDS,)
    whole: float  # the whole waves beyond which places are given
    last: float  # x beyond which the measured coordinate has no fold (`last_corner`)


Found: TypeAlias = tuple[bool, float, bool, bool]
"""Whether the target is reached, at which x, whether a step of that place is near, and whether a jump to there has
passed the target."""


@kernel()
def last_corner(basis: Basis, curve: Series, by_load: bool) -> float:
    """Return x beyond which what is measured has no fold on a branch.

    Depth rises on every branch, and load under its own control.
    """
    if not (by_load and curve.alpha > 0.0):
        return 0.0
    _, last = window(basis, measured_by(curve, by_load))
    return last


@kernel()
def _put(
    basis: Basis, measured: Series, corners: Corners, count: int, x: float, kind: int, whole: float
) -> tuple[Corners, int]:
    """Append a corner; return the corners, moved where there was no room, and their number."""
    if count == corners.shape[1]:
        more = np.empty((ROWS, 2 * count))
        more[:, :count] = corners
        corners = more
    place = whole + x
    corners[PLACE, count] = x
    corners[VALUE, count] = coordinate(basis, measured, x, whole) if place > 0.0 else 0.0
    corners[TERMS, count] = size(basis, measured, x, whole) if whole > 0.0 else size_at(basis, measured, x)
    corners[KIND, count] = kind
    return corners, count + 1


@kernel()
def append_corners(
    basis: Basis,
    curve: Series,
    by_load: bool,
    way: tuple[float, float, bool],
    room: Place,
    corners: Corners,
    count: int,
) -> tuple[Corners, int]:
    """Append the corners of what loading passes of one branch to the `count` that there are.

    The load is measured, or the depth; `way` are the x of landing, that of the end, and whether this is a fold of the
    curve.
    """
    search, zeros, whole, last = room
    begin, end, ends_in_fold = way
    measured = measured_by(curve, by_load)
    corners, count = _put(basis, measured, corners, count, begin, LANDING, whole)
    last = min(end, last - whole)
    if begin < last:
        if whole == 0.0:
            found, _, _ = find_all_folds(basis, measured, max(begin, _INNERMOST), last, zeros)
        else:
            found, _, _ = find_folds(basis, measured, begin, last, search, zeros, whole)
        for i in range(found):
            corners, count = _put(basis, measured, corners, count, zeros[i], FOLD, whole)
    return _put(basis, measured, corners, count, end, FOLD if ends_in_fold else OPEN, whole)


@kernel()
def corners_of(
    basis: Basis, curve: Series, by_load: bool, branches: int, trace: Trace, furthest: float, room: Place
) -> tuple[Corners, int]:
    """Return the corners of all that loading visits up to x = `furthest`, and their number."""
    corners, count = np.empty((ROWS, 2 * branches + 16)), NONE
    for branch in range(branches):
        begin, end = trace[ARRIVAL, branch], trace[END, branch]
        if begin <= furthest and begin < math.inf:
            way = (begin, min(end, furthest), end < furthest)
            corners, count = append_corners(basis, curve, by_load, way, room, corners, count)
    return corners, count


@kernel()
def first_reached(
    basis: Basis, curve: Series, by_load: bool, corners: Corners, count: int, target: float, whole: float
) -> Found:
    """Return where loading first reaches a target on the way through some corners."""
    measured = measured_by(curve, by_load)
    close = NO
    for i in range(count):
        value, kind = corners[VALUE, i], corners[KIND, i]
        if kind == FOLD and abs(value - target) <= CLOSE * corners[TERMS, i]:
            close = True
        if value < target:
            continue
        if kind == LANDING:
            return True, corners[PLACE, i], close, True
        low, high = corners[PLACE, i - 1], corners[PLACE, i]
        return True, find_level(basis, measured, target, (low, corners[VALUE, i - 1], high, value), whole), close, False
    return False, math.inf, close, False
