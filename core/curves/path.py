"""The path of a cycle under controlled displacement: branches, jumps, and the contact pinned at the rim.

The corners of the path come first, in order: where it starts, where it jumps to, where the load turns, where a branch
ends. They say how they are reached: along the curve or by a straight line, by a jump or not, on which branch, loading
or unloading. What lies between is sampled (sampling.py).
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, START_DEPTH
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curves.equilibrium import scales_of
from gradhesion.core.curves.forms import EXACT, Numbers, pinned_load, point
from gradhesion.core.curves.knots import landed
from gradhesion.core.curves.sampling import sample
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.path.unloading import descend, leave_rim

PLACE, DEPTH, LOAD, JOINED, BRANCH, JUMP, UNLOADING = 0, 1, 2, 3, 4, 5, 6
"""Rows of the corners."""
_ROWS: Final = 7


@kernel()
def _put(
    corners: Any, count: int, place: float, depth: float, load: float, flags: tuple[bool, float, bool, bool]
) -> int:
    """Append a corner with its flags: joined along the curve, branch, jump, unloading."""
    joined, branch, jump, unloading = flags
    corners[PLACE, count], corners[DEPTH, count], corners[LOAD, count] = place, depth, load
    corners[JOINED, count], corners[BRANCH, count] = joined, branch
    corners[JUMP, count], corners[UNLOADING, count] = jump, unloading
    return count + 1


@kernel()
def _along(
    kind: int,
    table: Any,
    numbers: Numbers,
    load_folds: Any,
    corners: Any,
    count: int,
    end: tuple[float, float],
    branch: float,
    unloading: bool,
) -> int:
    """Append the way along a branch from the last corner to a place of known depth, the turns of the load between."""
    start = corners[PLACE, count - 1]
    place, depth = end
    low, high = min(start, place), max(start, place)
    first = np.searchsorted(load_folds, low, side="right")
    last = np.searchsorted(load_folds, high, side="left")
    flags = (YES, branch, NO, unloading)
    for j in range(last - first):
        fold = load_folds[last - 1 - j] if unloading else load_folds[first + j]
        fold_depth, fold_load = point(kind, table, numbers, fold)
        count = _put(corners, count, fold, fold_depth, fold_load, flags)
    if place != start:
        _, load = point(kind, table, numbers, place)
        count = _put(corners, count, place, depth, load, flags)
    return count


@kernel()
def _land(
    kind: int, table: Any, numbers: Numbers, corners: Any, count: int, guess: float, branch: float, unloading: bool
) -> int:
    """Append the place of a branch to which the path jumps at the depth of the last corner."""
    level = corners[DEPTH, count - 1]
    place = landed(table, Cosine(numbers[0], numbers[1], 0.0), level, guess) if kind == EXACT else guess
    _, load = point(kind, table, numbers, place)
    return _put(corners, count, place, level, load, (NO, branch, YES, unloading))


@kernel()
def find_corners(kind: int, table: Any, numbers: Numbers, trace: Any, load_folds: Any, rim: float, pinned: bool) -> Any:
    """Return the corners of the path up to a rim and back, one a column.

    Unless the rim is `pinned`, the end of a drawn range stands in for it: loading arrives there along the last branch.
    """
    curve = Cosine(numbers[0], numbers[1], 0.0)
    branches = trace.shape[1]
    while branches > 0 and trace[START, branches - 1] > rim:
        branches -= 1
    at_rim = branches + 1.0
    rim_depth, rim_load = point(kind, table, numbers, rim)
    corners = np.empty((_ROWS, 2 * load_folds.size + 4 * branches + 8))
    count = _put(corners, NONE, 0.0, 0.0, 0.0, (NO, 0.0, NO, NO))

    # loading: up each branch that it arrives on, to its end or to the rim
    left, level = 0.0, 0.0
    for branch in range(branches):
        arrival = trace[ARRIVAL, branch]
        if not arrival <= rim:
            continue
        count = _land(kind, table, numbers, corners, count, arrival, branch + 1.0, NO)
        if trace[END, branch] < rim:
            left, level = trace[END, branch], trace[END_DEPTH, branch]
        else:
            left, level = rim, rim_depth
        count = _along(kind, table, numbers, load_folds, corners, count, (left, level), branch + 1.0, NO)
    if left < rim:  # no branch within the rim reaches higher
        load = pinned_load(kind, table.k, rim, rim_depth, rim_load, level)
        count = _put(corners, count, rim, level, load, (NO, at_rim, YES, NO))
    if pinned and level > rim_depth:
        count = _put(corners, count, rim, rim_depth, rim_load, (NO, at_rim, NO, YES))

    # unloading: down each branch to its start
    now, landing = leave_rim(table, curve, branches, trace, rim, rim_depth)
    place, level = rim, rim_depth
    if now >= 0:
        descend(table, curve, trace, now, NO)
    while now >= 0:
        if landing != rim:
            count = _land(kind, table, numbers, corners, count, landing, now + 1.0, YES)
        place, level = trace[START, now], trace[START_DEPTH, now]
        count = _along(kind, table, numbers, load_folds, corners, count, (place, level), now + 1.0, YES)
        landing = trace[LANDING, now]
        now = int(trace[NEXT, now])
    if place > 0.0:  # else the contact has shrunk to a point (k = 1)
        count = _put(corners, count, 0.0, level, 0.0, (NO, 0.0, YES, YES))
    return corners[:, :count]


def draw_corners(form: Form, corners: NDArray[np.float64], end: float) -> dict[str, NDArray[Any]]:
    """Return the variables `path_...` (draw.CURVES) through corners; `end` is the rim (in R)."""
    rim = end / form.radius_scale
    knots = np.ascontiguousarray(corners[:3])
    points, owners = sample(form.kind, form.table, form.numbers, knots, corners[JOINED] > 0.0, scales_of(knots))
    radius, depth, load = form.scaled(points)
    radius[points[0] == rim] = end
    return {
        "path_contact_radius": radius,
        "path_indentation": depth,
        "path_load": load,
        "path_branch": corners[BRANCH, owners].astype(np.int32),
        "path_jump": corners[JUMP, owners].astype(np.int8),
        "path_unloading": corners[UNLOADING, owners].astype(np.int8),
    }


def draw_path(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return the path of a cycle: loading from depth zero without contact to full contact, unloading to its end.

    Parameters
    ----------
    subject
        A scene whose branches are known.

    Returns
    -------
    The variables `path_...` (draw.CURVES). Flags and branch tell how a point is reached: the line from the point before
    is a jump, or unloading, if the point is marked so. A jump is one straight line at its depth. Loading ends where
    contact is full, at the largest depth on the way; unloading begins pinned at the rim if the equilibrium at the rim
    is not as deep. The path of an unbounded punch turns round on the last, endless branch, at the end of the range.

    Notes
    -----
    The sum of P d(delta) over its lines is the energy of a cycle (docs/theory.md, section 10) but for the chords.
    """
    form, trace = subject.exact, subject.trace
    assert trace is not None  # noqa: S101 (draw.py asks first)
    rim = subject.end / form.radius_scale
    corners = find_corners(form.kind, form.table, form.numbers, trace, subject.load_folds, rim, subject.bounded)
    return draw_corners(form, corners, subject.end)
