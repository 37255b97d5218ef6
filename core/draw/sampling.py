"""Points of a curve between corners: as few as a smooth picture needs.

Between two corners the radius, the depth and the load are each monotone. A piece is halved until the curve stays
within TOLERANCE of its chord in all three planes, each axis in units of the drawn span, at the middle and at both
quarters (the middle of an S lies on its chord). Three places may miss the waves of a piece of more than half a wave,
where no fold is a corner: there the waves themselves have to be below the tolerance as well. Distances are taken across
the chord: a wave that is as high as the picture but narrower than a line needs no more than its folds.
"""

from collections.abc import Callable
from itertools import combinations
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.values import Curve, depth_at_centre, slope_at, state_at
from gradhesion.core.jit import kernel
from gradhesion.core.table.filling import waves_at
from gradhesion.core.table.layout import EXACT, Source
from gradhesion.core.types import Floats, Integers, Truths

TOLERANCE: Final = 1.2e-4
"""Of the drawn span; elsewhere than at the three places an error may be half as large again, 2e-4 at most."""
_HALVINGS: Final = 30  # a piece of 2^-30 of the distance of two corners is a point


class Line(NamedTuple):
    """What can be drawn as a curve. Points are rows of reduced radius y, depth/R and load/(1.5 pi R w), (3, n).

    points      from radii y (n,) to points
    half_wave   half its shortest wave, in y; inf without waves
    swing       from radii y (n,) to how far its waves swing in y, depth and load: points less their means
    """

    points: Callable[[Floats], Floats]
    half_wave: float = np.inf
    swing: Callable[[Floats], Floats] = np.zeros_like


@kernel
def _fill_states(curve: Curve, source: Source, points: Floats) -> None:
    """Put depth and load, in the units of the curve, below the radii y in the first row of `points` (3, n)."""
    for i in range(points.shape[1]):
        if points[0, i] > 0.0:
            points[1, i], points[2, i] = state_at(curve, source, points[0, i])
        else:  # without contact
            points[1, i] = points[2, i] = 0.0
            if curve.table.k == 1.0 or slope_at(curve, 0) > 0.0:  # the first branch begins at a point
                points[1, i] = depth_at_centre(curve)
            elif source.form != EXACT:
                points[1, i] = curve.g * waves_at(source, 0.0)[0]


def line_of(curve: Curve, source: Source, units: Floats, half_wave: float, crest: float) -> Line:
    """Return a curve of equilibrium as a line.

    `units` are those of radius and depth in R, and of load, (3,); `crest` bounds its waves of depth over y^((1-k)/2),
    in the unit of depth.
    """
    k = curve.table.k

    def points(y: Floats) -> Floats:
        """Return states at radii."""
        found = np.array([y, y, y], dtype=float)
        _fill_states(curve, source, found)
        return found * np.array([[1.0], [units[1]], [units[2]]])

    def swing(y: Floats) -> Floats:
        """Return how far waves swing."""
        depth = crest * y ** (0.5 * (1.0 - k))
        return np.array([0.0 * y, units[1] * depth, units[2] * depth * y ** (1.0 + k)])

    return Line(points, half_wave, swing)


def spans_of(corners: Floats) -> Floats:
    """Return one over the spans of points, (3, 1); 0 where all are equal."""
    spans = np.ptp(corners, axis=1)[:, None]
    return np.divide(1.0, spans, out=np.zeros((3, 1)), where=spans > 0.0)


def _across(step: Floats, chord: Floats) -> Truths:
    """Return where steps (3, ..., n) from the start of chords (3, n) lead out of their tolerance, in some plane."""
    far = np.zeros(step.shape[1:], dtype=np.bool_)
    for i, j in combinations(range(3), 2):
        far |= np.abs(chord[i] * step[j] - chord[j] * step[i]) > TOLERANCE * np.hypot(chord[i], chord[j])
    return far


def sample(
    line: Line, corners: Floats, scales: Floats | None = None, joined: Truths | None = None
) -> tuple[Floats, Integers]:
    """Return points of a line through corners, and the corner that each leads up to.

    `corners` are points in the order of the path, which may go in- or outwards, (3, n); `scales` are those of
    `spans_of`, of all that is drawn if that is more; `joined` says whether the path comes to each along the curve (else
    by a straight line), (n,): to all but the first if not given.
    """
    scales = spans_of(corners) if scales is None else scales
    ends = np.arange(1, corners.shape[1]) if joined is None else np.flatnonzero(joined)
    first, last = corners[:, ends - 1], corners[:, ends]  # of each piece
    start, width = ends.astype(np.float64) - 1.0, np.ones(ends.size)  # its place: corners have their numbers
    places, points = [np.arange(corners.shape[1], dtype=np.float64)], [corners]
    for _ in range(_HALVINGS):
        if not start.size:
            break
        steps = last[0] - first[0]
        inner = line.points(np.concatenate([first[0] + share * steps for share in (0.25, 0.5, 0.75)])).reshape(3, 3, -1)
        chord = (last - first) * scales
        bent = np.abs(steps) > line.half_wave
        bent[bent] = _across(line.swing(np.maximum(first[0], last[0])[bent]) * scales, chord[:, bent])
        bent |= _across((inner - first[:, None]) * scales[:, None], chord).any(axis=0)
        start, width, first, last = start[bent], 0.5 * width[bent], first[:, bent], last[:, bent]
        middle = inner[:, 1, bent]
        places.append(start + width)
        points.append(middle)
        start, width = np.concatenate([start, start + width]), np.tile(width, 2)
        first, last = np.concatenate([first, middle], axis=1), np.concatenate([middle, last], axis=1)
    place = np.concatenate(places)
    order = np.argsort(place)
    return np.concatenate(points, axis=1)[:, order], np.ceil(place[order]).astype(np.int64)
