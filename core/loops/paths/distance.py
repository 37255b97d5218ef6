"""The distance of points to a connected curve in the plane, with its derivatives when the curve moves.

The curve is given by vertices. Where it bends between two of them, it is the cubic over their chord that has its
tangents there; the foot of a point is searched on the chord, or the two that it is between, and then on the cubic.
"""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import allocating, kernel
from gradhesion.core.types import Floats, Integers, Truths

_BLOCK: Final = 16  # pieces in a box: of one further away than the nearest piece so far all are skipped
_STEPS: Final = 5  # steps of Newton to the foot on a curve, the first of them to that on its chord
_LEAST: Final = 0.5
"""Least change of the slope that they divide by, over that of a straight line: it is 0 at the centre of curvature."""


class Feet(NamedTuple):
    """Where points are nearest to a curve."""

    distance: Floats  # signed: positive on the left of the piece
    piece: Integers  # its number, that of its first vertex
    share: Floats  # how far along its chord, 0 to 1
    normal: Floats  # rows of the direction in which the distance grows, of length 1
    bent: Truths  # whether the foot is on a smooth curve, not at one of its ends

    def slopes(self, moving: Floats, tangents: Floats) -> Floats:
        """Return the derivatives of the distances, (points, parameters), from those of the vertices.

        `moving` is of shape (vertices, 2, parameters), `tangents` as to `feet`. How a vertex moves along the curve has
        no effect but at corners: inside a smooth piece it is left out, so that what only moves points along has none.
        """
        across = tangents[:, ::-1] * [-1.0, 1.0] / np.maximum(np.hypot(*tangents.T), np.finfo(float).tiny)[:, None]
        found = np.zeros((self.share.size, moving.shape[2]))
        for place, part in ((self.piece, 1.0 - self.share), (self.piece + 1, self.share)):
            own = across[place] * np.sign(np.einsum("ij,ij->i", across[place], self.normal))[:, None]
            normal = np.where(self.bent[:, None], own, self.normal)
            found -= np.einsum("ij,ijk->ik", part[:, None] * normal, moving[place])
        return found


@kernel
def _nearest(x: float, y: float, chain: Floats, boxes: Floats, first: int, last: int) -> tuple[int, float]:
    """Return the piece of a chain (m, 2), of those from `first` to `last`, nearest to a point, and how far along."""
    best, piece, share = np.inf, first, 0.0
    for block in range(first // _BLOCK, last // _BLOCK + 1):
        aside = max(boxes[block, 0] - x, 0.0, x - boxes[block, 2])
        above = max(boxes[block, 1] - y, 0.0, y - boxes[block, 3])
        if aside * aside + above * above >= best:
            continue
        for i in range(max(block * _BLOCK, first), min((block + 1) * _BLOCK, last + 1)):
            run, rise = chain[i + 1, 0] - chain[i, 0], chain[i + 1, 1] - chain[i, 1]
            away, up = x - chain[i, 0], y - chain[i, 1]
            length = run * run + rise * rise
            along = min(max((away * run + up * rise) / length, 0.0), 1.0) if length > 0.0 else 0.0
            left, over = away - along * run, up - along * rise
            distance = left * left + over * over
            if distance < best:
                best, piece, share = distance, i, along
    return piece, share


@kernel
def _slope(run: float, rise: float, tangent: Floats) -> float:
    """Return the slope of a tangent (2,) over a direction of length 1; no more than 1."""
    along, aside = run * tangent[0] + rise * tangent[1], run * tangent[1] - rise * tangent[0]
    return min(max(aside / along, -1.0), 1.0) if along != 0.0 else 0.0


@kernel
def _on_piece(
    point: Floats, chain: Floats, tangents: Floats, curved: Truths, i: int
) -> tuple[float, float, float, float]:
    """Return the share of the foot of a point on a piece, the signed distance, and its normal; inf of no length."""
    run, rise = chain[i + 1, 0] - chain[i, 0], chain[i + 1, 1] - chain[i, 1]
    length = np.hypot(run, rise)
    if length == 0.0:
        return 0.0, np.inf, 0.0, 1.0
    run, rise = run / length, rise / length
    begin = _slope(run, rise, tangents[i]) if curved[i + 1] else 0.0
    end = _slope(run, rise, tangents[i + 1]) if curved[i + 1] else 0.0
    left, over = point[0] - chain[i, 0], point[1] - chain[i, 1]
    at, above = (run * left + rise * over) / length, (run * over - rise * left) / length
    t, off, slope, bend = 0.0, above, 0.0, 0.0
    for _ in range(_STEPS):
        t = min(max(t + (at - t + off * slope) / max(1.0 + slope * slope - off * bend, _LEAST), 0.0), 1.0)
        off = above - t * (1.0 - t) * ((1.0 - t) * begin - t * end)
        slope = (1.0 - t) * (1.0 - 3.0 * t) * begin - t * (2.0 - 3.0 * t) * end
        bend = (6.0 * t - 4.0) * begin + (6.0 * t - 2.0) * end
    size, unit = np.hypot(at - t, off) * length, np.hypot(1.0, slope)
    sign = -1.0 if off + slope * (t - at) < 0.0 else 1.0
    return t, sign * size, -(rise + slope * run) / unit, (run - slope * rise) / unit


@allocating
def _feet(points: Floats, chain: Floats, tangents: Floats, curved: Truths, among: Integers, boxes: Floats) -> Feet:
    """Find the feet; arguments are as to `feet`, and the lowest x and y of pieces `_BLOCK` by `_BLOCK`, the highest."""
    count = points.shape[0]
    distance, piece, share = np.full(count, np.inf), np.zeros(count, np.int64), np.zeros(count)
    normal, bent = np.zeros((count, 2)), np.zeros(count, np.bool_)
    for j in range(count):
        first, last = among[j]
        i, t = _nearest(points[j, 0], points[j, 1], chain, boxes, first, last)
        other = min(i + 1, last) if t == 1.0 else max(i - 1, first)
        piece[j], share[j] = i, t
        for near in range(1 if 0.0 < t < 1.0 else 2):  # between two chords the foot may be on the curve over either
            on = other if near else i
            found = _on_piece(points[j], chain, tangents, curved, on)
            if abs(found[1]) < abs(distance[j]):
                piece[j], share[j], distance[j], normal[j, 0], normal[j, 1] = on, *found
        i, t = piece[j], share[j]
        if 0.0 < t < 1.0:
            bent[j] = curved[i + 1]
            continue
        vertex = i + 1 if t == 1.0 else i
        bent[j] = first < vertex <= last and curved[vertex] and curved[vertex + 1]
        left, over, across, up = points[j, 0] - chain[vertex, 0], points[j, 1] - chain[vertex, 1], 0.0, 0.0
        for on in (max(vertex - 1, first), min(vertex, last)):  # at a corner both its pieces decide the side
            run, rise = chain[on + 1, 0] - chain[on, 0], chain[on + 1, 1] - chain[on, 1]
            far = np.hypot(run, rise)
            if far > 0.0:
                across, up = across - rise / far, up + run / far
        size, sign = np.hypot(left, over), -1.0 if across * left + up * over < 0.0 else 1.0
        distance[j] = sign * size
        normal[j, 0], normal[j, 1] = (sign * left / size, sign * over / size) if size > 0.0 else (across, up)
    return Feet(distance, piece, share, normal, bent)


def feet(
    points: Floats, chain: Floats, tangents: Floats | None = None, curved: Truths | None = None,
    among: Integers | None = None,
) -> Feet:  # fmt: skip
    """Find where points, rows of x and y (n, 2), are nearest to a connected curve.

    Its vertices `chain` (m, 2), two or more, are in order; `tangents` are its directions there, of any length and
    either sense. The way to each that is `curved`, (m,), is part of a smooth curve, else straight. The foot of a point
    is on one of the pieces from the first to the last that are its own, rows of `among` (n, 2), on any if not given.

    Of a circle with 64 vertices distances are right to 1e-6 of its radius, and to 2e-6 of points that are 3 % of it
    away, where chords are off by 1e-3; with 32, those of points 4 radii outside to 2e-5. They are continuous.

    >>> feet(np.array([[0.5, 1.0], [0.5, -2.0], [3.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])).distance.tolist()
    [1.0, -2.0, 2.0]
    """
    pieces = len(chain) - 1
    tangents = chain if tangents is None else tangents
    curved = np.zeros(pieces + 1, bool) if curved is None else curved
    among = np.tile([0, pieces - 1], (len(points), 1)) if among is None else among
    first, ends = np.arange(0, pieces, _BLOCK), (chain[:-1], chain[1:])
    boxes = np.hstack([pick.reduceat(pick(*ends), first) for pick in (np.minimum, np.maximum)])
    points, chain, tangents = map(np.ascontiguousarray, (points, chain, tangents))
    return _feet(points, chain, tangents, curved, among, boxes)
