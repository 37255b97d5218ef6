"""Curves of one scene without its single waves, in closed form, and those of their leading terms.

In the units of the scene, with y = 2 pi a/lambda and c = (1-k)/2, a punch without waves has

    depth = B y^m - pull y^c + height,    load = y^(1+k) [m/(1+k+m) B y^m - pull y^c]

smooth       pull 1, height 0
envelopes    pull 1 - chi_+ on loading and 1 + chi_- on unloading (closed/envelope.py), their height the mean of the
             waves; closing at another work of adhesion takes its root for the first 1
effective    the path along them, without the single waves, (5.28)-(5.35): jump-in at the depth 0, counted from the mean
             surface; loading along its envelope; early unloading at the radius of the turn, where the load is linear in
             the depth; unloading along its envelope; jump-out at its fold

What is drawn are arrays (points,) of a/R, depth/R and load/(1.5 pi R w_o), in the order of CURVES (problem/names.py).
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.values import Curve
from gradhesion.core.draw.sampling import Line, line_of, sample, spans_of
from gradhesion.core.draw.scene import Drawn, Frame, extrema_of, table_for, waves_of
from gradhesion.core.problem.profile import swings
from gradhesion.core.scenes import rows as at
from gradhesion.core.table.layout import BY_DEPTH, BY_LOAD
from gradhesion.core.table.leading import amplitude_of
from gradhesion.core.types import Floats

REACH: Final = 2.0
"""Radius at which the effective path of an unbounded punch turns, in a_2 (as in Fig. 9)."""


def _smooth_line(frame: Frame, pull: float, height: float = 0.0) -> Line:
    """Return the line of a punch without waves, of a pull, its depth raised by a height."""
    k, m, B, units = frame.k, frame.punch.exponent, frame.reduced[at.BY_POWER, 0], frame.units

    def points(y: Floats) -> Floats:
        """Return states at radii."""
        own, adhesion = B * y**m, pull * y ** (0.5 * (1.0 - k))
        load = y ** (1.0 + k) * (m / (1.0 + k + m) * own - adhesion)
        return np.array([y, units[1] * (own - adhesion + height), units[2] * load])

    return Line(points)


def _corners(frame: Frame, pulls: tuple[float, ...], start: float, end: float) -> Floats:
    """Return the radii y from start to end, rising, and between them those of depth 0, least depth and least load.

    That is of the lines of these pulls: depth and load are monotone between the radii.
    """
    m, k = frame.punch.exponent, frame.k
    levels = 1.0, 0.5 * (1.0 - k) / m, 0.5 * (3.0 + k) / m
    places = [frame.place(level, pull) for pull in pulls for level in levels]
    return np.unique(np.clip([start, *places, end], start, end))


def _through(drawn: Drawn, line: Line, places: Floats) -> tuple[Floats, Floats, Floats]:
    """Return a/R, depth/R and load/(1.5 pi R w_o) of points of a line through places y, (points,) each."""
    y, depth, load = sample(line, line.points(places))[0]
    return drawn.frame.radii(y, drawn.end), depth, load


def draw_smooth(drawn: Drawn) -> tuple[Floats, ...]:
    """Return the curve of the same power without waves, at the work of opening."""
    return _through(drawn, _smooth_line(drawn.frame, 1.0), _corners(drawn.frame, (1.0,), 0.0, drawn.end))


def draw_asymptotic(drawn: Drawn) -> tuple[Floats, ...] | None:
    """Return the curve of the leading terms of short waves, (5.15)-(5.20), None if it folds too often.

    Depth includes the mean height that the printed form drops. It is not valid where the contact is no larger than a
    wave.
    """
    frame, end = drawn.frame, drawn.end
    if frame.reduced[at.BY_WAVES, 0] == 0.0:
        return draw_smooth(drawn)
    B, g = frame.reduced[[at.BY_POWER, at.BY_WAVES], 0].tolist()
    need = min(frame.reduced[at.WINDOW, 0], end)
    while True:
        made, by_load = (table_for(frame, form, need) for form in (BY_DEPTH, BY_LOAD))
        if made is None or by_load is None:
            return None
        by_depth = Curve(made[0], B, g, 1.0, 0.0)
        folds, extrema = (extrema_of(curve, end) for curve in (by_depth, Curve(by_load[0], B, g, 0.0, 1.0)))
        if folds is not None and extrema is not None:
            break
        need = min(3.0 * need, end)
    line = line_of(by_depth, made[1], frame.units, *waves_of(frame))
    return _through(drawn, line, np.unique(np.concatenate([[0.0, end], folds, extrema])))


def _envelopes(frame: Frame) -> tuple[float, float, float]:
    """Return the pulls of the envelopes of loading and unloading, and the mean height of the waves."""
    g, waves = frame.reduced[at.BY_WAVES, 0], frame.punch.waves
    up, down = swings(frame.k, tuple(map(tuple, waves.tolist())))
    one = g * amplitude_of(frame.k)
    return float(1.0 - one * up), float(1.0 + one * down), float(g * waves[:, 1].sum())


def draw_envelope(drawn: Drawn) -> tuple[Floats, ...]:
    """Return the two envelopes of the asymptotic curve at common radii, (5.21)-(5.27).

    Depths include the mean height of the waves; without it the exact curve would not lie between.
    """
    frame = drawn.frame
    rise, fall, height = _envelopes(frame)
    rise += frame.root - 1.0
    lines = [_smooth_line(frame, pull, height) for pull in (rise, fall)]
    corners = _corners(frame, (rise, fall), 0.0, drawn.end)
    y = np.unique(np.concatenate([sample(line, line.points(corners))[0][0] for line in lines]))
    return frame.radii(y, drawn.end), *(row for line in lines for row in line.points(y)[1:])


def draw_effective(drawn: Drawn) -> tuple[NDArray[Any], ...]:
    """Return the effective path of a cycle: a/R, depth/R, load/(1.5 pi R w_o), and 1.0 where a jump arrives, else 0.0.

    All are (points,), in the order of the path: without contact from depth 0 to the mean surface; jump-in to a_2 of
    the work of closing (5.34); the loading envelope up to the turn; the straight line (5.32) to the unloading
    envelope; down that to its fold; jump-out. An unbounded punch that does not turn has the turn at REACH times the a_2
    of the work of opening, or at the radius of the pull-off if that is larger. For chi_+ >= 1 contact grows from a
    point, without a jump. If the rim is within a_2, the jump-in ends there, on the line (5.32). At k = 1 contact
    shrinks to a point, without a jump.
    The area of the loop is the energy of solver = "envelope" with the rim at the turn, but for the chords drawn.
    """
    frame, turn = drawn.frame, drawn.turn
    m, k = frame.punch.exponent, frame.k
    rise, fall, height = _envelopes(frame)
    if frame.rim == np.inf and not drawn.turned:  # beyond a_2 of the work of opening and the pull-off
        turn = max(REACH * frame.place(1.0, rise), frame.place(0.5 * (3.0 + k) / m, fall))
    rise += frame.root - 1.0  # from here on loading is at the work of closing
    up, down = (_smooth_line(frame, pull, height) for pull in (rise, fall))
    landing, left = frame.place(1.0, rise), min(turn, frame.place(0.5 * (1.0 - k) / m, fall))
    raised = height * frame.units[1]

    unloading = down.points(_corners(frame, (fall,), left, turn)[::-1])
    if landing < turn:
        loading = up.points(_corners(frame, (rise,), landing, turn))
        if landing > 0.0:
            loading[1, 0] = raised  # already so to rounding
    else:  # the jump-in reaches the rim: one point, on the line of the flat punch through the unloading envelope there
        _, depth, load = unloading[:, 0]
        flat = turn ** (1.0 + k) * frame.units[2] / frame.units[1]
        loading = np.array([[turn], [raised], [load + flat * (raised - depth)]])
    # without contact: depth 0, then the mean surface if contact jumps in there; at the end the depth of the jump-out
    before = np.array([[0.0, 0.0], [0.0, raised], [0.0, 0.0]])[:, : 2 if landing > 0.0 and height > 0.0 else 1]
    out = np.array([[0.0], [unloading[1, -1]], [0.0]])[:, : 1 if left > 0.0 else 0]
    scales = spans_of(np.concatenate([before, loading, unloading, out], axis=1))
    smooth = [sample(line, own, scales)[0] for line, own in ((up, loading), (down, unloading))]
    y, depth, load = np.concatenate([before, *smooth, out], axis=1)
    jump = np.zeros(y.size)
    jump[before.shape[1]], jump[-1] = landing > 0.0, left > 0.0
    return frame.radii(y, turn if turn == drawn.turn else np.nan), depth, load, jump
