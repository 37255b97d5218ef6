"""The path of a cycle of any profile under any control, read from what core/path/general.py notes of its branches.

Jumps keep the coordinate Y = alpha depth + beta load that is prescribed. Without contact the load is zero and the depth
Y/alpha. Under load control (alpha = 0) the punch falls without end once contact is lost: the path ends there, with
contact radius 0 at the depth and the load of the last fold.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, LANDING, NEXT, START, START_DEPTH
from gradhesion.core.curve.general import Series
from gradhesion.core.curve.general_energy import energy_from_zero, jump_energy
from gradhesion.core.curves.forms import point
from gradhesion.core.curves.path import BRANCH, DEPTH, JOINED, JUMP, LOAD, PLACE, UNLOADING, draw_corners
from gradhesion.core.curves.subject import Subject
from gradhesion.core.path.unloading import descend, leave_rim
from gradhesion.core.struve.circle import TWO_PI

_ROWS: Final = 7


class _Walk:
    """The corners of a path, as they are met."""

    def __init__(self, subject: Subject) -> None:
        self.form = subject.exact
        self.turns = subject.load_folds
        self.curve = Series(*self.form.numbers[:5])
        _, _, _, self.alpha, self.beta = self.curve
        self.corners: list[tuple[float, ...]] = []

    def put(
        self, place: float, depth: float, load: float, joined: bool, branch: float, jump: bool, unloading: bool
    ) -> None:
        """Append a corner."""
        corner = [0.0] * _ROWS
        corner[PLACE], corner[DEPTH], corner[LOAD] = place, depth, load
        corner[JOINED], corner[BRANCH], corner[JUMP], corner[UNLOADING] = joined, branch, jump, unloading
        self.corners.append(tuple(corner))

    def at(self, place: float) -> tuple[float, float]:
        """Return depth and load of the curve."""
        depth, load = point(self.form.kind, self.form.table, self.form.numbers, place)
        return depth, load

    def kept(self, depth: float, load: float) -> tuple[float, float]:
        """Return the state after a jump from the last corner: what is prescribed is the same to the last digit."""
        last = self.corners[-1]
        return (last[DEPTH] if self.beta == 0.0 else depth), (last[LOAD] if self.alpha == 0.0 else load)

    def land(self, place: float, number: float, unloading: bool) -> None:
        """Jump to a place on a branch."""
        self.put(place, *self.kept(*self.at(place)), False, number, True, unloading)

    def along(self, place: float, number: float, unloading: bool) -> None:
        """Go along a branch to a place, by the turns between."""
        start = self.corners[-1][PLACE]
        turns = self.turns[(self.turns > min(start, place)) & (self.turns < max(start, place))]
        for turn in [*(turns[::-1] if unloading else turns).tolist(), *([place] if place != start else [])]:
            self.put(turn, *self.at(turn), True, number, False, unloading)

    def pin(self, rim: float, level: float, number: float) -> None:
        """Jump to the pinned contact at the rim at a level."""
        depth, load = self.at(rim)
        front = (TWO_PI * rim) ** (1.0 + float(self.form.table[0]["k"]))
        push = (level - self.alpha * depth - self.beta * load) / (self.alpha + self.beta * front)
        self.put(rim, *self.kept(depth + push, load + front * push), False, number, True, False)


def find_corners(subject: Subject) -> NDArray[np.float64]:
    """Return the corners of the path up to the rim and back, one a column, with the rows of path.py."""
    assert subject.trace is not None  # noqa: S101 (draw.py asks first)
    walk = _Walk(subject)
    rim = subject.end / walk.form.radius_scale
    trace = subject.trace
    branches = trace.shape[1]
    at_rim = branches + 1.0
    rim_depth, rim_load = walk.at(rim)
    rim_level = walk.alpha * rim_depth + walk.beta * rim_load
    walk.put(0.0, 0.0, 0.0, False, 0.0, False, False)
    left, level = 0.0, 0.0
    for branch in np.flatnonzero(trace[ARRIVAL] <= rim).tolist():
        walk.land(float(trace[ARRIVAL, branch]), branch + 1.0, False)
        if trace[END, branch] < rim:
            left, level = float(trace[END, branch]), float(trace[END_DEPTH, branch])
        else:
            left, level = rim, rim_level
        walk.along(left, branch + 1.0, False)
    if left < rim:
        walk.pin(rim, level, at_rim)
        if level > rim_level:
            walk.put(rim, rim_depth, rim_load, False, at_rim, False, True)
    now, landing = leave_rim(walk.form.table, walk.curve, branches, trace, rim, rim_level)
    if now >= 0:
        descend(walk.form.table, walk.curve, trace, now, False)
    left, level = rim, rim_level
    while now >= 0:
        if landing != rim:
            walk.land(landing, now + 1.0, True)
        left, level = float(trace[START, now]), float(trace[START_DEPTH, now])
        walk.along(left, now + 1.0, True)
        landing, now = float(trace[LANDING, now]), int(trace[NEXT, now])
    if left > 0.0:
        depth = level / walk.alpha if walk.alpha > 0.0 else walk.corners[-1][DEPTH]
        walk.put(0.0, *walk.kept(depth, 0.0), False, 0.0, True, True)
    return np.ascontiguousarray(np.array(walk.corners).T)


def draw_path(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return the variables `path_...` (draw.CURVES). A jump is one straight line at its coordinate."""
    return draw_corners(subject.exact, find_corners(subject), subject.end)


def list_jumps(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return the variables `jump_...` (draw.CURVES), one item a jump; the depth is that before it.

    The jump-out under load control has no bounded energy and is left out, as in `dissipated_energy`.
    """
    form = subject.exact
    rim = subject.end / form.radius_scale
    curve = Series(*form.numbers[:5])
    _, _, _, alpha, beta = curve
    corners = find_corners(subject)
    after = np.flatnonzero((corners[JUMP] > 0.0) & ((corners[PLACE] > 0.0) | (alpha > 0.0)))
    before = after - 1
    left, reached = corners[PLACE, before], corners[PLACE, after]
    levels = alpha * corners[DEPTH, before] + beta * corners[LOAD, before]
    energies = np.empty(after.size)
    for i, (start, end) in enumerate(zip(left.tolist(), reached.tolist(), strict=True)):
        if start == 0.0:
            energies[i] = energy_from_zero(form.table, curve, end, levels[i])
        elif end == 0.0:
            energies[i] = -energy_from_zero(form.table, curve, start, levels[i])
        else:
            energies[i] = jump_energy(form.table, curve, start, end, 0.0)
    length = form.radius_scale / TWO_PI
    at_rim = ((left == rim) | (reached == rim)) & subject.bounded
    return {
        "jump_indentation": corners[DEPTH, before] * form.depth_scale,
        "jump_radius_before": np.where(left == rim, subject.end, left * form.radius_scale),
        "jump_radius_after": np.where(reached == rim, subject.end, reached * form.radius_scale),
        "jump_energy": TWO_PI * length * length * energies,
        "jump_load_before": corners[LOAD, before] * form.load_scale,
        "jump_load_after": corners[LOAD, after] * form.load_scale,
        "jump_unloading": corners[UNLOADING, after].astype(np.int8),
        "jump_at_rim": at_rim.astype(np.int8),
    }
