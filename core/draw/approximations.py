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


def _turns(frame: Frame, pulls: tuple[float, ...], end: float) -> Floats:
    """Return where punches of some pulls have no depth, their fold and their least load, in order, up to an end."""
    m, k = frame.punch.exponent, frame.k
    levels = 1.0, 0.5 * (1.0 - k) / m, 0.5 * (3.0 + k) / m
    places = np.unique([frame.place(level, pull) for pull in pulls for level in levels])
    return places[(places > 0.0) & (places < end)]


def _sampled(drawn: Drawn, line: Line, places: Floats) -> Floats:
    """Return points of a line from no contact through places to the end of what is drawn, (3, n)."""
    corners = line.points(np.concatenate([[0.0], places, [drawn.end]]))
    return sample(line, corners, np.arange(corners.shape[1]) > 0, spans_of(corners))[0]


def _through(drawn: Drawn, line: Line, places: Floats) -> tuple[Floats, Floats, Floats]:
    """Return their radii a/R, depths and loads."""
    y, depth, load = _sampled(drawn, line, places)
    return drawn.frame.radii(y, drawn.end), depth, load


def draw_smooth(drawn: Drawn) -> tuple[Floats, ...]:
    """Return the curve of the same power without waves, at the work of opening."""
    places = _turns(drawn.frame, (1.0,), drawn.end)
    return _through(drawn, _smooth_line(drawn.frame, 1.0), places)


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
    return _through(drawn, line, np.union1d(folds, extrema))


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
    corners = _turns(frame, (rise, fall), drawn.end)
    y = np.unique(np.concatenate([_sampled(drawn, line, corners)[0] for line in lines]))
    return frame.radii(y, drawn.end), *(row for line in lines for row in line.points(y)[1:])


def draw_effective(drawn: Drawn) -> tuple[NDArray[Any], ...]:
    """Return the effective path of a cycle; its last variable is 1 at a point that is reached by a jump.

    Loading starts without contact at depth 0, touches the mean surface and jumps in there, to the a_2 of (5.34). For
    chi_+ >= 1 there is no radius a_2: contact grows from a point, without a jump. A rim within a_2 is reached by the
    jump-in, and unloading starts from there along the line (5.32). At k = 1 contact ends by shrinking to a point. An
    unbounded punch that does not turn is loaded up to 2 a_2, or to the pull-off radius of its unloading envelope if
    that is larger. The sum of P d(delta) over its lines is the energy of the solver of envelopes with the rim at the
    turn, chords apart.
    """
    frame, m, k = drawn.frame, drawn.frame.punch.exponent, drawn.frame.k
    rise, fall, height = _envelopes(frame)
    turn = drawn.turn
    if frame.rim == np.inf and not drawn.turned:
        turn = max(REACH * frame.place(1.0, rise), frame.place(0.5 * (3.0 + k) / m, fall))
    rise += frame.root - 1.0
    up, down = (_smooth_line(frame, pull, height) for pull in (rise, fall))
    start, stop = frame.place(1.0, rise), min(turn, frame.place(0.5 * (1.0 - k) / m, fall))
    raised = height * frame.units[1]

    _, last_depth, last_load = down.points(np.array([turn]))[:, 0]
    if start < turn:
        places = _turns(frame, (rise,), turn)
        loading = up.points(np.concatenate([[start], places[places > start], [turn]]))
        if start > 0.0:
            loading[1, 0] = raised  # already so to rounding
    else:  # the rim is reached by the jump-in, and contact there is a flat punch
        flat = turn ** (1.0 + k) * frame.units[2] / frame.units[1]
        loading = np.array([[turn], [raised], [last_load + flat * (raised - last_depth)]])
    places = _turns(frame, (fall,), turn)[::-1]
    unloading = down.points(np.concatenate([[turn], places[places > stop], [stop] if stop < turn else []]))
    before = np.array([[0.0, 0.0], [0.0, raised], [0.0, 0.0]])[:, : 2 if start > 0.0 and height > 0.0 else 1]
    out = np.array([[0.0], [unloading[1, -1]], [0.0]])[:, : 1 if stop > 0.0 else 0]
    scales = spans_of(np.concatenate([before, loading, unloading, out], axis=1))
    smooth = [
        sample(line, own, np.arange(own.shape[1]) > 0, scales)[0] for line, own in ((up, loading), (down, unloading))
    ]
    y, depth, load = np.concatenate([before, *smooth, out], axis=1)
    jump = np.zeros(y.size)
    jump[before.shape[1]], jump[-1] = start > 0.0, stop > 0.0
    return frame.radii(y, turn if turn == drawn.turn else np.nan), depth, load, jump
