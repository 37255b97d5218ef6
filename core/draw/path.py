"""The equilibrium curve of a scene, the path of its cycle and the jumps on it.

The corners of a path come first: where it starts, where it jumps to, where depth or load turns, where a branch ends.
Flags mark how they are reached: along the curve or by a straight line, by a jump or not, on which branch, loading or
unloading. The curve between them is sampled (sampling.py). Jumps keep what is prescribed.
"""

from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.trace import END, START
from gradhesion.core.cycle.jumps import (
    JUMP_ROWS,
    LANDED,
    LANDED_BRANCH,
    LEFT,
    LOSS,
    frozen_loss,
    list_loading_jumps,
    list_unloading_jumps,
)
from gradhesion.core.draw.sampling import sample, spans_of
from gradhesion.core.draw.scene import Drawn, Frame, Side, ends_of
from gradhesion.core.scenes import rows as at
from gradhesion.core.types import Floats

_Corner: TypeAlias = tuple[float, ...]
Y, DEPTH, LOAD, JOINED, BRANCH, JUMP = range(6)
"""Rows of corners: point as of sampling.py, the branch from 1 on (0: no contact), and flags."""
_ROUNDING: Final = 1e-12  # relative distance of radii that are one


def draw_equilibrium(drawn: Drawn, *, closing: bool = False) -> tuple[NDArray[Any], ...]:
    """Return the radius, depth and load of a whole curve, and whether it is stable, from no contact to the end.

    It is that of opening, or of `closing`. Folds count as not stable, so that the line between two points is stable
    where one of them is: each branch has a point in its inside.
    """
    side, end = drawn.sides[0 if closing else 1], drawn.end
    edges = np.concatenate([[0.0], ends_of(side.trace, end), [end]])
    extrema = side.extrema[side.extrema < end]
    lonely = np.searchsorted(extrema, edges[1:]) == np.searchsorted(extrema, edges[:-1])
    middles = 0.5 * (edges[1:] + edges[:-1])[lonely]
    y, depth, load = sample(side.line, side.line.points(np.unique(np.concatenate([edges, extrema, middles]))))[0]
    starts, ends = side.trace[[START, END]]
    branch = np.searchsorted(starts, y, "left") - 1  # the last one that starts below
    stable = (branch >= 0) & (y < np.append(ends, 0.0)[branch])
    stable |= (y == 0.0) & (starts[:1] == 0.0).any()
    return drawn.frame.radii(y, end), depth, load, stable


def _put_along(side: Side, corners: list[_Corner], y: float, branch: float) -> None:
    """Append the corners of a way along a branch: extrema of depth or load on the way to a radius y, then y itself.

    It begins at the last corner; nothing is appended if that is at y. `branch` is the number of the branch, from 1 on.
    """
    start, extrema = corners[-1][Y], side.extrema
    if abs(y - start) <= _ROUNDING * start:
        return
    between = extrema[(extrema > min(y, start)) & (extrema < max(y, start))]
    places = [*(between if y > start else between[::-1]), y]
    corners += [(*point, 1.0, branch, 0.0) for point in side.line.points(np.array(places)).T.tolist()]


def _put_jump(frame: Frame, side: Side, corners: list[_Corner], y: float, branch: float) -> None:
    """Jump from the last corner to a radius, 0 out of contact.

    Contact there is a flat punch, pushed off equilibrium until it has what is prescribed: by nothing on a branch. A
    dead load that lets go keeps its depth.
    """
    _, before_depth, before_load, *_ = corners[-1]
    by_depth, by_load = frame.reduced[[at.BY_DEPTH, at.BY_LOAD], 0] / frame.units[1:]
    y, depth, load = side.line.points(np.array([y]))[:, 0].tolist()
    stiffness = y ** (1.0 + frame.k) * frame.units[2] / frame.units[1]
    softness = by_depth + by_load * stiffness
    push = (by_depth * (before_depth - depth) + by_load * (before_load - load)) / softness if softness > 0.0 else 0.0
    depth = before_depth if by_load == 0.0 or softness == 0.0 else depth + push
    load = before_load if by_depth == 0.0 else load + stiffness * push
    corners.append((y, depth, load, 0.0, branch, 1.0))


def _corners_of(drawn: Drawn) -> tuple[Floats, Floats, int, Floats, int]:
    """Return the corners of a path, columns of the rows above, and the jumps of its cycle.

    These are the corners of loading; those of unloading, from equilibrium at the turn on; the first of them that is not
    the last of loading: 0 if the contact is pinned on the way between, else 1; the jumps (JUMP_ROWS, jumps), in the
    order of the corners that are reached by one; the number of those of loading.
    """
    frame, turn, (closing, opening) = drawn.frame, drawn.turn, drawn.sides
    jumps = np.empty((JUMP_ROWS, closing.trace.shape[1] + opening.trace.shape[1] + 2))
    loading = list_loading_jumps(closing.curve, turn, closing.trace, closing.visited, closing.visited.size, jumps)
    total = list_unloading_jumps(opening.curve, turn, opening.trace, opening.trace.shape[1], jumps, loading)
    frozen_loss(closing.curve, jumps, 0, loading)
    frozen_loss(opening.curve, jumps, loading, total)
    ways = jumps[[LEFT, LANDED, LANDED_BRANCH], :total].T.tolist()
    up: list[_Corner] = [(0.0,) * 6]
    branch, pinned = 0.0, frame.root < 1.0
    for left, landed, to in ways[:loading]:
        if left > 0.0:
            _put_along(closing, up, left, branch)
        branch = to + 1.0
        if to < 0.0:  # flat against the rim: on none of the branches within it
            branch, pinned = 1.0 + np.count_nonzero(closing.trace[START] <= turn), True
        _put_jump(frame, closing, up, landed, branch)
    _put_along(closing, up, turn, branch)

    down: list[_Corner] = [(*opening.line.points(np.array([turn]))[:, 0].tolist(), 0.0, branch, 0.0)]
    branch = float(np.searchsorted(opening.trace[START], turn, "right"))
    for left, landed, to in ways[loading:]:
        if left != turn:
            _put_along(opening, down, left, branch)
        branch = to + 1.0
        _put_jump(frame, opening, down, landed, branch)
    if branch > 0.0:  # the contact shrinks to a point, or is none (radius 0) to rounding
        _put_along(opening, down, 0.0, branch)
    if drawn.grows:
        up[1] = (*up[1][:JUMP], 0.0)
    return np.array(up).T, np.array(down).T, 0 if pinned else 1, jumps[:, :total], loading


def draw_path(drawn: Drawn) -> tuple[NDArray[Any], ...]:
    """Return the path of a cycle: from depth zero without contact up to the turn, and back until contact ends.

    The line from the point before is a jump, or unloading, if a point is marked so. Unloading begins pinned where the
    equilibrium of opening at the turn is not as deep as loading comes there. The path of an unbounded punch turns at
    the end of the drawn range. The sum of P d(delta) over its lines is the energy of a cycle but for the chords.
    """
    up, down, first, _, _ = _corners_of(drawn)
    scales = spans_of(np.concatenate([up[:3], down[:3]], axis=1))
    rows = []
    for unloading, (own, side) in enumerate(zip((up, down), drawn.sides, strict=True)):
        points, owner = sample(side.line, np.ascontiguousarray(own[:3]), scales, own[JOINED] > 0.0)
        rows.append([*points, own[BRANCH, owner], own[JUMP, owner], np.full(owner.size, unloading)])
    y, *others = (np.concatenate([of_up, of_down[first:]]) for of_up, of_down in zip(*rows, strict=True))
    return drawn.frame.radii(y, drawn.turn), *others


def draw_jumps(drawn: Drawn) -> tuple[NDArray[Any], ...]:
    """Return every jump of a cycle, in the order of the path: from the jump-in to the jump-out.

    An energy may be negative: a jump on loading over a groove that adhesion does not close gains some, but the contact
    is no single disc then. The jump-out under load control has no bounded energy and is left out, as in
    `dissipated_energy`.
    """
    frame, (up, down, first, jumps, loading) = drawn.frame, _corners_of(drawn)
    corners = np.concatenate([up, down[:, first:]], axis=1)
    after, unloading = np.flatnonzero(corners[JUMP]), np.arange(jumps.shape[1]) >= loading
    if drawn.grows:
        jumps, unloading = jumps[:, 1:], unloading[1:]
    kept = (jumps[LANDED] > 0.0) | (frame.reduced[at.BY_DEPTH, 0] > 0.0)
    jumps, unloading, after = jumps[:, kept], unloading[kept], after[kept]
    before, rim = after - 1, drawn.turn if drawn.turn == frame.rim else np.nan
    work = 2.0 * np.pi * frame.units[0] ** 2 * np.where(unloading, 1.0, frame.root**2)
    return (
        corners[DEPTH, before],
        frame.radii(jumps[LEFT], drawn.turn),
        frame.radii(jumps[LANDED], drawn.turn),
        work * jumps[LOSS],
        corners[LOAD, before],
        corners[LOAD, after],
        unloading,
        (jumps[LEFT] == rim) | (jumps[LANDED] == rim),
    )
