"""The jumps of a cycle under controlled displacement, one by one: where they happen, and what each of them costs.

They are the corners of the path (path.py) that are reached by a jump; their energies are those of
curve/cosine_energy.py.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.closed.smooth import smooth_energy_from_zero
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import ROWS, WORK
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.curves.forms import EXACT, Numbers
from gradhesion.core.curves.path import DEPTH, JUMP, LOAD, PLACE, UNLOADING, find_corners
from gradhesion.core.curves.subject import Subject
from gradhesion.core.struve.circle import TWO_PI


@kernel()
def fill_energies(kind: int, table: Any, numbers: Numbers, before: Any, after: Any, depths: Any, energies: Any) -> None:
    """Put what each jump loses from one place to another in `energies`, over 2 pi l^2 dgamma; one place may be 0.

    A smooth punch (kind PLAIN) jumps from zero contact and to zero contact only.
    """
    curve = Cosine(numbers[0], numbers[1], 0.0)
    work = np.empty((ROWS, 16))[WORK]
    for i in range(before.size):
        place = max(before[i], after[i])
        if kind != EXACT:
            energies[i] = smooth_energy_from_zero(table.k, place, depths[i])
        elif before[i] == 0.0 or after[i] == 0.0:
            energies[i] = energy_from_zero(table, curve, place, depths[i])
        else:
            energies[i] = jump_energy(table, curve, before[i], after[i], work)
            continue
        if after[i] == 0.0:
            energies[i] = -energies[i]


def list_jumps(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return every jump of a cycle, in the order of the path: from the jump-in to the jump-out.

    Parameters
    ----------
    subject
        A scene whose branches are known.

    Returns
    -------
    The variables `jump_...` (draw.CURVES), one item a jump: its depth delta/R, the contact radii a/R between which it
    happens (0: no contact), the energy that it dissipates over R^2 dgamma, the loads P/(1.5 pi R dgamma) before and
    after, whether it is on unloading, and whether it starts or ends at the rim. An energy may be negative: a jump on
    loading over a groove that adhesion does not close gains some, but the contact is no single disc then
    (status.LOADING_NOT_ONE_DISC). An unbounded punch has all the jumps that there are.

    Notes
    -----
    The energies sum up to the `dissipated_energy` of `solve`: to 1e-12, whether that walks every wave or sums over
    them.
    """
    form, trace = subject.exact, subject.trace
    assert trace is not None  # noqa: S101 (draw.py asks first)
    rim = subject.end / form.radius_scale
    corners = find_corners(form.kind, form.table, form.numbers, trace, np.empty(0), rim, subject.bounded)
    after = np.flatnonzero(corners[JUMP] > 0.0)
    before = after - 1
    left, reached, depths = corners[PLACE, before], corners[PLACE, after], corners[DEPTH, after]
    energies = np.empty(after.size)
    fill_energies(form.kind, form.table, form.numbers, left, reached, depths, energies)
    length = form.radius_scale / (TWO_PI if form.kind == EXACT else 1.0)
    at_rim = ((left == rim) | (reached == rim)) & subject.bounded
    return {
        "jump_indentation": depths * form.depth_scale,
        "jump_radius_before": np.where(left == rim, subject.end, left * form.radius_scale),
        "jump_radius_after": np.where(reached == rim, subject.end, reached * form.radius_scale),
        "jump_energy": TWO_PI * length * length * energies,
        "jump_load_before": corners[LOAD, before] * form.load_scale,
        "jump_load_after": corners[LOAD, after] * form.load_scale,
        "jump_unloading": corners[UNLOADING, after].astype(np.int8),
        "jump_at_rim": at_rim.astype(np.int8),
    }
