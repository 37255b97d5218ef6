"""The effective path of a cycle, without the single waves: envelopes and the line between them, (5.28)-(5.35).

In the units of smooth.py, with chi = r/s, depth counted from the mean surface and X = z^((3+k)/2), of a paraboloid

    jump-in            at depth 0 to z_2, X = 2 (1-chi)                            (5.34)
    loading            along the envelope of the pull 1 - chi to z_max
    early unloading    load = z_max^(1+k) depth - X^2 (1+k)/(2 (3+k)),   over a depth 2 chi z_max^((1-k)/2)   (5.32)
    unloading          along the envelope of the pull 1 + chi to z_4, X = (1-k)/2 (1+chi)      (5.35)
    jump-out           at that depth

and of any profile along the envelopes of closed/general_envelope.py in the same way.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves.envelope import Envelopes, envelopes_of
from gradhesion.core.curves.equilibrium import scales_of
from gradhesion.core.curves.sampling import sample
from gradhesion.core.curves.subject import Subject
from gradhesion.core.problem.profile import Profile

REACH: Final = 2.0
"""Radius at which the path of an unbounded punch turns, in a_2 (as in Fig. 9)."""


def turning_place(subject: Subject, envelopes: Envelopes) -> float:
    """Return z_max: that of the rim; of an unbounded punch 2 z_2, or that of the pull-off if it lies further out."""
    up, _, (rise, fall), turns = envelopes
    if subject.bounded:
        return subject.rim / up.radius_scale
    return max(REACH * turns.place(turns.zero, rise), turns.place(turns.least, fall))


def draw_effective(subject: Subject, profile: Profile) -> dict[str, NDArray[Any]]:
    """Return the effective path of a cycle.

    Parameters
    ----------
    subject, profile
        Any scene under displacement control, and its punch.

    Returns
    -------
    The variables `effective_...` (draw.CURVES); `effective_jump` is 1 at a point that is reached by a jump. Depths
    include the mean height lambda A. Loading starts without contact at depth 0, touches the mean surface at lambda A
    and jumps in there, to the a_2 of (5.34). For r >= s there is no radius a_2: contact grows from a point, without a
    jump. A rim within a_2 is reached by the jump-in, and unloading starts from there along the line (5.32). At k = 1
    contact ends by shrinking to a point. An unbounded punch is loaded up to 2 a_2, or to the pull-off radius of the
    unloading envelope if that is larger.

    Notes
    -----
    The sum of P d(delta) over its lines is the energy of `solver = "envelope"` with the rim at the turn, chords apart.
    """
    envelopes = envelopes_of(subject, profile)
    up, down, (rise, fall), levels = envelopes
    turn, height = turning_place(subject, envelopes), up.numbers.height
    start, stop = levels.place(levels.zero, rise), min(turn, levels.place(levels.fold, fall))

    _, last_depth, last_load = down.states(np.array([turn]))[:, 0]
    if start < turn:
        turns = levels.places((rise,), turn)
        loading = up.states(np.concatenate([[start], turns[turns > start], [turn]]))
        if start > 0.0:
            loading[1, 0] = height  # already so to rounding
    else:  # the rim is reached by the jump-in, and contact there is a flat punch
        loading = np.array([[turn], [height], [last_load + down.flat_stiffness(turn) * (height - last_depth)]])
    turns = levels.places((fall,), turn)[::-1]
    unloading = down.states(np.concatenate([[turn], turns[turns > stop], [stop] if stop < turn else []]))
    before = np.array([[0.0, 0.0], [0.0, height], [0.0, 0.0]])[:, : 2 if start > 0.0 and height > 0.0 else 1]
    out = np.array([[0.0], [unloading[1, -1]], [0.0]])[:, : 1 if stop > 0.0 else 0]
    scales = scales_of(np.concatenate([before, loading, unloading, out], axis=1))

    pieces = [before]
    for form, corners in ((up, loading), (down, unloading)):
        joined = np.arange(corners.shape[1]) > 0
        pieces.append(sample(form.table, form.numbers, np.ascontiguousarray(corners), joined, scales)[0])
    pieces.append(out)
    points = np.concatenate(pieces, axis=1)
    jump = np.zeros(points.shape[1], dtype=np.int8)
    jump[before.shape[1]] = 1 if start > 0.0 else 0
    jump[-1] = out.shape[1]
    radius, depth, load = up.scaled(points)
    if subject.bounded:
        radius[points[0] == turn] = subject.rim
    return {
        "effective_contact_radius": radius,
        "effective_indentation": depth,
        "effective_load": load,
        "effective_jump": jump,
    }
