"""The distance of points to a connected curve in the plane, with its derivatives when the curve moves.

The curve is given by vertices. Where it bends between two of them, it is the cubic over their chord whose tangents are
those of the parabolas through three vertices; the foot of a point is searched on the chord, and its distance measured
to the cubic.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from gradhesion.core.jit import kernel
from gradhesion.core.types import Floats, Integers, Truths

_BLOCK: Final = 16
"""Pieces in a box: where a box is further from a point than the nearest piece so far, all of them are skipped."""

_STEPS: Final = 2
"""Steps of Newton's from the foot on a chord to that on the curve."""


@dataclass(frozen=True, eq=False)
class Feet:
    """Where points are nearest to a curve."""

    distance: Floats
    """Signed: positive on the left of the piece."""
    piece: Integers
    """The number of the piece, that of its first vertex."""
    share: Floats
    """How far along it, 0 to 1."""
    normal: Floats
    """Rows of the direction in which the distance grows, of length 1."""

    def slopes(self, moving: Floats) -> Floats:
        """Return the derivatives of the distances as the vertices move.

        Parameters
        ----------
        moving
            The derivatives of the vertices, of shape (vertices, 2, parameters); how a vertex moves along the curve has
            no effect but at corners.

        Returns
        -------
        Of shape (points, parameters).
        """
        share = self.share[:, None, None]
        moved = (1.0 - share) * moving[self.piece] + share * moving[self.piece + 1]
        return np.asarray(-np.einsum("ij,ijk->ik", self.normal, moved))


@kernel
def _boxes(chain: Floats) -> Floats:
    """Return the lowest x and y, then the highest, of each block of the pieces of a chain (m, 2): (blocks, 4)."""
    pieces = chain.shape[0] - 1
    boxes = np.empty(((pieces + _BLOCK - 1) // _BLOCK, 4))
    for block in range(boxes.shape[0]):
        first, last = block * _BLOCK, min((block + 1) * _BLOCK, pieces)
        for axis in range(2):
            low = high = chain[first, axis]
            for i in range(first + 1, last + 1):
                low, high = min(low, chain[i, axis]), max(high, chain[i, axis])
            boxes[block, axis], boxes[block, axis + 2] = low, high
    return boxes


@kernel
def _nearest(x: float, y: float, chain: Floats, boxes: Floats, guess: int) -> tuple[int, float]:
    """Return the piece of a chain (m, 2) that is nearest to a point, and how far along it; blocks as of `_boxes`."""
    best, piece, share = np.inf, 0, 0.0
    for turn in range(boxes.shape[0]):
        block = guess if turn == 0 else turn - 1 if turn <= guess else turn
        aside = max(boxes[block, 0] - x, 0.0, x - boxes[block, 2])
        above = max(boxes[block, 1] - y, 0.0, y - boxes[block, 3])
        if aside * aside + above * above >= best:
            continue
        for i in range(block * _BLOCK, min((block + 1) * _BLOCK, chain.shape[0] - 1)):
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
def _tangents(chain: Floats, curved: Truths) -> Floats:
    """Return dx and dy over the length of the chord at the vertices of a chain (m, 2), where it is curved: (m, 2)."""
    count = chain.shape[0]
    found, length = np.zeros((count, 2)), np.ones(count)
    for i in range(1, count):
        size = np.hypot(chain[i, 0] - chain[i - 1, 0], chain[i, 1] - chain[i - 1, 1])
        length[i] = size if size > 0.0 else 1.0
    for axis in range(2):
        for i in range(1, count - 1):
            if curved[i] and curved[i + 1]:
                before = (chain[i, axis] - chain[i - 1, axis]) / length[i]
                after = (chain[i + 1, axis] - chain[i, axis]) / length[i + 1]
                found[i, axis] = (length[i + 1] * before + length[i] * after) / (length[i] + length[i + 1])
        for i in range(1, count):
            begins, ends = not curved[i - 1], i == count - 1 or not curved[i + 1]
            if curved[i] and (begins or ends):
                chord = (chain[i, axis] - chain[i - 1, axis]) / length[i]
                if begins:
                    found[i - 1, axis] = chord if ends else 2.0 * chord - found[i, axis]
                if ends:
                    found[i, axis] = 2.0 * chord - found[i - 1, axis]
    return found


@kernel
def _feet(
    points: Floats, chain: Floats, curved: Truths, distance: Floats, piece: Integers, share: Floats, normal: Floats
) -> None:
    """Fill distance (n,), piece (n,), share (n,) and normal (n, 2) of points (n, 2) to a chain (m, 2)."""
    boxes, tangents = _boxes(chain), _tangents(chain, curved)
    last = chain.shape[0] - 2
    guess = 0
    for j in range(points.shape[0]):
        x, y = points[j, 0], points[j, 1]
        i, t = _nearest(x, y, chain, boxes, guess)
        guess = i // _BLOCK
        run, rise = chain[i + 1, 0] - chain[i, 0], chain[i + 1, 1] - chain[i, 1]
        length = np.hypot(run, rise)
        if length > 0.0:
            run, rise = run / length, rise / length
        else:
            run, rise = 1.0, 0.0
        left = x - chain[i, 0] - t * length * run, y - chain[i, 1] - t * length * rise
        size = np.hypot(left[0], left[1])
        way = run, rise
        at_end = not 0.0 < t < 1.0
        if at_end:  # at a corner both its pieces decide the side
            other = min(i + 1, last) if t == 1.0 else max(i - 1, 0)
            ahead, over = chain[other + 1, 0] - chain[other, 0], chain[other + 1, 1] - chain[other, 1]
            far = np.hypot(ahead, over)
            if far > 0.0:
                way = run + ahead / far, rise + over / far
        sign = -1.0 if way[0] * left[1] - way[1] * left[0] < 0.0 else 1.0
        piece[j], share[j], distance[j] = i, t, sign * size
        if at_end and size > 0.0:
            normal[j, 0], normal[j, 1] = sign * left[0] / size, sign * left[1] / size
            continue
        normal[j, 0], normal[j, 1] = -rise, run
        if curved[i + 1]:
            begin = length * (run * tangents[i, 1] - rise * tangents[i, 0])
            end = length * (run * tangents[i + 1, 1] - rise * tangents[i + 1, 0])
            above = sign * size
            for _ in range(_STEPS):  # to the foot on the cubic, whose height over the chord is that of its tangents
                height = t * (1.0 - t) * ((1.0 - t) * begin - t * end)
                tilt = (1.0 - t) * (1.0 - 3.0 * t) * begin - t * (2.0 - 3.0 * t) * end
                bend = (6.0 * t - 4.0) * begin + (6.0 * t - 2.0) * end
                off = (share[j] - t) * length * length + (above - height) * tilt
                slope = -length * length - tilt * tilt + (above - height) * bend
                t = min(max(t - off / slope, 0.0), 1.0) if slope < 0.0 else t
            height = t * (1.0 - t) * ((1.0 - t) * begin - t * end)
            tilt = ((1.0 - t) * (1.0 - 3.0 * t) * begin - t * (2.0 - 3.0 * t) * end) / length
            unit = np.hypot(1.0, tilt)
            distance[j] = (above - height - (share[j] - t) * length * tilt) / unit
            normal[j, 0], normal[j, 1] = (-rise - tilt * run) / unit, (run - tilt * rise) / unit
            share[j] = t


def feet(points: Floats, chain: Floats, curved: Truths | None = None) -> Feet:
    """Find where points are nearest to a connected curve.

    Parameters
    ----------
    points
        Rows of x and y, shape (n, 2).
    chain
        The vertices in order, rows of x and y; two or more, shape (m, 2).
    curved
        Whether the way to each vertex is part of a smooth curve, of which the vertices are points; else it is straight.
        Shape (m,).

    Returns
    -------
    The feet. Of a circle with 64 vertices distances are right to 3e-6 of its radius, and to 2e-5 of points that
    are 3 % of it away, where chords are off by 1e-3.

    Examples
    --------
    >>> feet(np.array([[0.5, 1.0], [0.5, -2.0], [3.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])).distance.tolist()
    [1.0, -2.0, 2.0]
    """
    count = points.shape[0]
    bent = np.zeros(chain.shape[0], bool) if curved is None else curved
    found = Feet(np.empty(count), np.empty(count, np.int64), np.empty(count), np.empty((count, 2)))
    own = np.ascontiguousarray(points), np.ascontiguousarray(chain), np.ascontiguousarray(bent)
    _feet(*own, found.distance, found.piece, found.share, found.normal)
    return found
