"""The path of a cycle, read from the trace of its branches: branches, jumps, and the contact pinned at the rim.

The corners of the path come first, in order: where it starts, where it jumps to, where depth or load turns, where a
branch ends. Flags mark how they are reached: along the curve or by a straight line, by a jump or not, on which branch,
loading or unloading. The curve between them is sampled (sampling.py).

Jumps keep the coordinate Y = alpha depth + beta load that is prescribed: the depth for one cosine. Without contact the
load is zero and the depth Y/alpha. Under load control (alpha = 0) the punch falls without end once contact is lost: the
path ends there, with contact radius 0 at the depth and the load of the last fold.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, START_DEPTH
from gradhesion.core.curves.equilibrium import scales_of
from gradhesion.core.curves.knots import landed
from gradhesion.core.curves.sampling import sample
from gradhesion.core.curves.subject import Subject
from gradhesion.core.path.unloading import descend, leave_rim

PLACE, DEPTH, LOAD, JOINED, BRANCH, JUMP, UNLOADING = 0, 1, 2, 3, 4, 5, 6
"""Rows of the corners: place, depth and load as those of the form, the branch from 1 on (0: no contact), and flags."""


class _Walk:
    """The corners of a path in order, with NaN for values that follow from the curve or from the corner before."""

    def __init__(self, subject: Subject) -> None:
        self.form, self.turns = subject.exact, subject.load_folds
        self.corners: list[tuple[float, ...]] = []

    def put(self, place: float, branch: float, *flags: bool, depth: float = math.nan, load: float = math.nan) -> None:
        """Append a corner with its flags: joined along the curve, jump, unloading."""
        joined, jump, unloading = flags
        self.corners.append((place, depth, load, joined, branch, jump, unloading))

    def land(self, guess: float, level: float, branch: float, unloading: bool) -> None:
        """Jump to the place of a branch at a level."""
        form = self.form
        place = landed(form.table, form.curve, level, guess) if form.is_one_wave else guess
        self.put(place, branch, False, True, unloading)

    def along(self, place: float, branch: float, unloading: bool) -> None:
        """Go along a branch to a place, by the turns of depth and load between."""
        start = self.corners[-1][PLACE]
        low, high = min(start, place), max(start, place)
        turns = self.turns[np.searchsorted(self.turns, low, "right") : np.searchsorted(self.turns, high, "left")]
        for turn in turns[::-1].tolist() if unloading else turns.tolist():
            self.put(turn, branch, True, False, unloading)
        if place != start:
            self.put(place, branch, True, False, unloading)

    def filled(self) -> NDArray[np.float64]:
        """Return the corners, one a column, with depth and load; a jump keeps what is prescribed."""
        corners = np.ascontiguousarray(np.array(self.corners).T)
        found = self.form.states(corners[PLACE])
        for row in (DEPTH, LOAD):
            corners[row] = np.where(np.isnan(corners[row]), found[row], corners[row])
        alpha, beta = self.form.coordinate
        for i in np.flatnonzero(corners[JUMP]).tolist():
            if beta == 0.0:
                corners[DEPTH, i] = corners[DEPTH, i - 1]
            if alpha == 0.0:
                corners[LOAD, i] = corners[LOAD, i - 1]
                if corners[PLACE, i] == 0.0:
                    corners[DEPTH, i] = corners[DEPTH, i - 1]
        return corners


def find_corners(subject: Subject) -> NDArray[np.float64]:
    """Return the corners of the path up to the rim and back, one a column.

    Of an unbounded punch the end of the drawn range stands in for the rim: loading arrives there along the last branch.
    """
    assert subject.trace is not None  # noqa: S101 (draw.py asks first)
    walk, form = _Walk(subject), subject.exact
    alpha, beta = form.coordinate
    rim = subject.end / form.radius_scale
    trace = np.ascontiguousarray(subject.trace[:, subject.trace[START] <= rim])
    branches = trace.shape[1]
    at_rim = branches + 1.0
    _, rim_depth, rim_load = form.states(np.array([rim]))[:, 0].tolist()
    rim_level = alpha * rim_depth + beta * rim_load

    # loading: up each branch that it arrives on, to its end or to the rim
    walk.put(0.0, 0.0, False, False, False, depth=0.0, load=0.0)
    left, level = 0.0, 0.0
    for branch in np.flatnonzero(trace[ARRIVAL] <= rim).tolist():
        walk.land(float(trace[ARRIVAL, branch]), level, branch + 1.0, False)
        left, level = rim, rim_level
        if trace[END, branch] < rim:
            left, level = float(trace[END, branch]), float(trace[END_DEPTH, branch])
        walk.along(left, branch + 1.0, False)
    if left < rim:  # no branch within the rim reaches higher: the contact there is a flat punch
        flat = form.flat_stiffness(rim)
        push = (level - rim_level) / (alpha + beta * flat)
        walk.put(rim, at_rim, False, True, False, depth=rim_depth + push, load=rim_load + flat * push)
    if subject.bounded and level > rim_level:
        walk.put(rim, at_rim, False, False, True)

    # unloading: down each branch to its start
    now, landing = leave_rim(form.table, form.curve, branches, trace, rim, rim_level)
    if now >= 0:
        descend(form.table, form.curve, trace, now, False)
    left, level = rim, rim_level
    while now >= 0:
        if landing != rim:
            walk.land(landing, level, now + 1.0, True)
        left, level = float(trace[START, now]), float(trace[START_DEPTH, now])
        walk.along(left, now + 1.0, True)
        landing, now = float(trace[LANDING, now]), int(trace[NEXT, now])
    if left > 0.0:  # else the contact has shrunk to a point (k = 1)
        walk.put(0.0, 0.0, False, True, True, depth=level / alpha if alpha > 0.0 else math.nan, load=0.0)
    return walk.filled()


def draw_path(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return the path of a cycle: loading from depth zero without contact to full contact, unloading to its end.

    The branches of the scene are known; the variables are `path_...` (draw.CURVES). Flags and branch mark how a point
    is reached: the line from the point before is a jump, or unloading, if the point is marked so. A jump is one
    straight line at its coordinate. Loading ends where contact is full, at the largest coordinate on the way; unloading
    begins pinned at the rim if the equilibrium at the rim is not as deep. The path of an unbounded punch turns round on
    the last, endless branch, at the end of the range.

    Notes
    -----
    The sum of P d(delta) over its lines is the energy of a cycle (docs/theory.md, section 10) but for the chords.
    """
    form, corners = subject.exact, find_corners(subject)
    knots = np.ascontiguousarray(corners[:3])
    points, owners = sample(form.table, form.numbers, knots, corners[JOINED] > 0.0, scales_of(knots))
    radius, depth, load = form.scaled(points)
    radius[points[0] == subject.end / form.radius_scale] = subject.end
    return {
        "path_contact_radius": radius,
        "path_indentation": depth,
        "path_load": load,
        "path_branch": corners[BRANCH, owners].astype(np.int32),
        "path_jump": corners[JUMP, owners].astype(np.int8),
        "path_unloading": corners[UNLOADING, owners].astype(np.int8),
    }
