"""The rims of a punch with one cosine wave that no walk reaches (path/cosine_long.py)."""

import math
from typing import Any

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.contact.cosine_disc import ALWAYS_ONE, NOWHERE, limits_from, note_run
from gradhesion.core.curve.branches import RUN, RUN_FIRST, RUN_LAST, RUN_LEAST
from gradhesion.core.curve.cosine import Curve
from gradhesion.core.path.cosine import is_long, is_unresolved
from gradhesion.core.path.cosine_long import (
    DISC_INNER,
    DISC_OUTER,
    LAST_UP,
    NEAR,
    NEAR_RIM,
    RUN_SEEN,
    begin_long,
    ends_folds,
    is_told,
    stride,
)
from gradhesion.core.path.ties import first_close_pair
from gradhesion.core.problem.results import CONTACT, wants_losses
from gradhesion.core.scene.cosine_rim import limits_of, read_rim, slopes_of


@kernel()
def _limits_beyond(
    table: Any, curve: Curve, count: int, trace: Any, long: Any, rim: float, final: float, slots: Any
) -> tuple[float, float, float]:
    """Return what `limits_of` does for one rim; the beginning and the waves of the gap are looked at once."""
    tangency = first_close_pair(count, trace)
    _, g, _ = curve
    if slots[CONTACT] < 0 or g * table.amplitude <= ALWAYS_ONE:
        return math.inf, math.inf, tangency
    shared, _, _ = long
    near, now = int(shared[NEAR]), int(shared[LAST_UP])
    if math.isnan(shared[DISC_INNER]):
        inner, outer = limits_from(table, curve, NONE, near - 1, NOWHERE, near, trace, math.inf)
        shared[DISC_INNER], shared[DISC_OUTER] = inner, outer
    if math.isnan(shared[RUN_SEEN]) and trace[RUN, RUN_LAST] >= trace[RUN, RUN_FIRST]:
        note_run(table, curve, math.floor(0.5 * final - NEAR_RIM), trace)
        shared[RUN_SEEN] = 1.0
    inner, outer = shared[DISC_INNER], shared[DISC_OUTER]
    if inner == math.inf:
        inner, outer = limits_from(table, curve, near, count, now, count, trace, rim)
    return inner, outer, tangency


@kernel()
def solve_long(
    table: Any,
    curve: Curve,
    arches: tuple[float, float],
    scales: Any,
    wavelength: float,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    scratch: Any,
    sense: Any,
    around: Any,
) -> None:
    """Follow the cycle of a wavy punch for its rims that no walk reaches: they share its beginning and its sums.

    Those beyond the folds, or among the last of them, share all of the trace.
    """
    losses, final = wants_losses(slots), arches[1]
    trace, long = begin_long(table, curve, arches, scratch, losses, 1.0)
    furthest, told = 0.0, is_told(table, curve, final)
    for i in range(rims.size):
        x = rims[i] / wavelength
        if is_unresolved(arches, x) or not is_long(table, arches, x):
            continue
        if told and ends_folds(table, arches, x):
            furthest = max(furthest, x)
            continue
        count = stride(table, curve, arches, x, trace, long, losses, 1.0)
        limits = _limits_beyond(table, curve, count, trace, long, x, final, slots)
        slopes = slopes_of(table, curve, sense, around, count, trace, final) if len(sense) > 0 else ()
        read_rim(table, curve, scales, count, trace, limits, x, slots, out, status, i, sense, around, final, slopes)
    if furthest == 0.0:
        return
    trace[RUN, RUN_LEAST] = math.nan  # these look at the waves of their own gap
    count = stride(table, curve, arches, furthest, trace, long, losses, 1.0)
    limits = limits_of(table, curve, count, trace, furthest, slots)
    slopes = slopes_of(table, curve, sense, around, count, trace, final) if len(sense) > 0 else ()
    for i in range(rims.size):
        x = rims[i] / wavelength
        if not is_unresolved(arches, x) and is_long(table, arches, x) and ends_folds(table, arches, x):
            read_rim(table, curve, scales, count, trace, limits, x, slots, out, status, i, sense, around, final, slopes)
