"""The jumps of a cycle, one by one: where they occur, and the energy of each.

They are the corners of the path (path.py) that are reached by a jump; their energies are those of core/face.py.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.closed.smooth import smooth_energy_from_zero
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import ROWS, WORK
from gradhesion.core.curves.path import DEPTH, JUMP, LOAD, PLACE, UNLOADING, find_corners
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.face import loss_between, loss_from_zero, loss_to_zero
from gradhesion.core.numbers.circle import TWO_PI


@kernel()
def lost(table: Any, curve: Any, start: float, end: float, level: float, work: Any) -> float:
    """Return the energy lost in a jump at a level between two places, over 2 pi l^2 dgamma; one of them may be 0."""
    if start == 0.0:
        return loss_from_zero(table, curve, end)
    if end == 0.0:
        return loss_to_zero(table, curve, start, level)
    return loss_between(table, curve, start, end, work)


def _lost_by(form: Form, start: float, end: float, level: float, work: Any) -> float:
    """Return this energy for a form: a smooth punch jumps from zero contact and to zero contact only."""
    if not form.is_plain:
        return lost(form.table, form.curve, start, end, level, work)
    energy: float = smooth_energy_from_zero(form.table["k"], max(start, end), level)
    return energy if start == 0.0 else -energy


def list_jumps(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return every jump of a cycle, in the order of the path: from the jump-in to the jump-out.

    The branches of the scene are known; the variables are `jump_...` (draw.CURVES), one item a jump: the depth delta/R
    before it, the contact radii a/R between which it happens (0: no contact), the energy that it dissipates over R^2
    dgamma, the loads P/(1.5 pi R dgamma) before and after, whether it is on unloading, and whether it starts or ends at
    the rim. An energy may be negative: a jump on loading over a groove that adhesion does not close gains some, but the
    contact is no single disc then (status.LOADING_NOT_ONE_DISC). An unbounded punch has all jumps of its curve.
    The jump-out under load control has no bounded energy and is left out, as in `dissipated_energy`.

    Notes
    -----
    The energies add up to the `dissipated_energy` of `solve`: to 1e-12, whether that traces every wave or sums over
    them.
    """
    form, corners = subject.exact, find_corners(subject)
    rim = subject.end / form.radius_scale
    alpha, beta = form.coordinate
    after = np.flatnonzero((corners[JUMP] > 0.0) & ((corners[PLACE] > 0.0) | (alpha > 0.0)))
    before = after - 1
    left, reached = corners[PLACE, before], corners[PLACE, after]
    levels = alpha * corners[DEPTH, before] + beta * corners[LOAD, before]
    work = np.empty((ROWS, 16))[WORK]
    jumps = zip(left.tolist(), reached.tolist(), levels.tolist(), strict=True)
    energies = np.array([_lost_by(form, start, end, level, work) for start, end, level in jumps])
    length = form.radius_scale / (1.0 if form.is_plain else TWO_PI)
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
