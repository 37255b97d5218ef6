"""Points of a curve between exact knots: as few as a smooth picture needs.

Between two knots the radius, the depth and the load are each monotone. A piece is halved until the curve stays within
`TOLERANCE` of its chord in all three planes, each axis in units of the drawn span, at the middle and at both quarters
(the middle of an S lies on its chord). Three places may miss the waves of a piece of more than half a wave, where no
fold is a knot: there the amplitude of the waves has to be below the tolerance as well. Distances are taken across the
chord: a wave that is as high as the picture but narrower than a line needs no more than its folds.
"""

from typing import Any, Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curves.forms import point, ripple
from gradhesion.core.face import AnyTable
from gradhesion.core.types import Floats, Integers, Truths

TOLERANCE: Final = 1.2e-4
"""Of the drawn span; elsewhere than at the three places an error may be half as large again, 2e-4 at most."""
_HALVINGS: Final = 30
"""A piece of 2^-30 of the distance of two knots is a point."""


@kernel()
def _across(r: float, d: float, p: float, start: Floats, end: Floats, scales: Floats) -> bool:
    """Return whether a step is within the tolerance of the chord from start to end, in all three planes.

    Points are (place, depth, load), of shape (3,); the scales that multiply them too.
    """
    r1, d1, p1 = (end[0] - start[0]) * scales[0], (end[1] - start[1]) * scales[1], (end[2] - start[2]) * scales[2]
    r, d, p = r * scales[0], d * scales[1], p * scales[2]
    r1_squared, d1_squared, p1_squared = r1 * r1, d1 * d1, p1 * p1
    least = TOLERANCE * TOLERANCE
    return (
        (r * d1 - d * r1) ** 2 <= least * (r1_squared + d1_squared)
        and (r * p1 - p * r1) ** 2 <= least * (r1_squared + p1_squared)
        and (d * p1 - p * d1) ** 2 <= least * (d1_squared + p1_squared)
    )


@kernel()
def _is_straight(table: AnyTable, numbers: Any, start: Floats, end: Floats, scales: Floats) -> bool:
    """Return whether a piece is near its chord: at three places and, if they may miss its waves, in these.

    Points and scales are those of `_across`, of shape (3,).
    """
    half_wave, _, _ = ripple(table, numbers, 1.0)
    if abs(end[0] - start[0]) > half_wave:
        _, depth, load = ripple(table, numbers, max(start[0], end[0]))
        if not _across(0.0, depth, load, start, end, scales):
            return False
    for share in (0.5, 0.25, 0.75):
        step = share * (end[0] - start[0])
        depth, load = point(table, numbers, start[0] + step)
        if not _across(step, depth - start[1], load - start[2], start, end, scales):
            return False
    return True


@kernel()
def _grown(points: Floats, owners: Integers) -> tuple[Floats, Integers]:
    """Return points (3, n) and owners (n,) in twice the room."""
    room = owners.size
    more_points, more_owners = np.empty((3, 2 * room)), np.empty(2 * room, np.int64)
    for i in range(room):  # numba checks the shapes of whole arrays, by a text that takes seconds to compile
        for row in range(3):
            more_points[row, i] = points[row, i]
        more_owners[i] = owners[i]
    return more_points, more_owners


@kernel()
def sample(table: AnyTable, numbers: Any, knots: Floats, joined: Truths, scales: Floats) -> tuple[Floats, Integers]:
    """Return points of a form through knots, of shape (3, n), and the knot that each leads up to.

    Parameters
    ----------
    table, numbers
        The form (forms.py).
    knots
        Rows of place, depth and load, in the order of the path, which may go in- or outwards; shape (3, knots).
    joined
        Whether the path comes to a knot along the curve (else by a straight line); shape (knots,).
    scales
        One over the drawn span of place, depth and load; shape (3,).
    """
    count = knots.shape[1]
    room = 4 * count + 64
    points, owners = np.empty((3, room)), np.empty(room, np.int64)
    ends, levels = np.empty((3, _HALVINGS + 2)), np.empty(_HALVINGS + 2, np.int64)
    start = np.empty(3)
    size = 0
    for i in range(count):
        top = 0
        if joined[i]:
            for row in range(3):
                start[row], ends[row, 0] = knots[row, i - 1], knots[row, i]
            levels[0], top = 0, 1
        while top > 0:  # the ends on the stack go towards the start
            end, level = ends[:, top - 1], levels[top - 1]
            if level == _HALVINGS or _is_straight(table, numbers, start, end, scales):
                top -= 1
                if top > 0:  # the last end is the knot itself
                    if size == owners.size:
                        points, owners = _grown(points, owners)
                    for row in range(3):
                        points[row, size] = start[row] = end[row]
                    owners[size] = i
                    size += 1
            else:
                levels[top - 1] = level + 1
                middle = 0.5 * (start[0] + end[0])
                ends[0, top], levels[top] = middle, level + 1
                ends[1, top], ends[2, top] = point(table, numbers, middle)
                top += 1
        if size == owners.size:
            points, owners = _grown(points, owners)
        for row in range(3):
            points[row, size] = knots[row, i]
        owners[size] = i
        size += 1
    return points[:, :size], owners[:size]
