"""The distance of points to a connected curve in the plane, with its derivatives when the curve moves."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_AT_ONCE: Final = 2**20
"""Pairs of a point and a piece that are compared at a time."""


@dataclass(frozen=True, eq=False)
class Feet:
    """Where points are nearest to a curve.

    Attributes
    ----------
    distance
        Signed: positive on the left of the piece.
    piece
        The number of the piece, that of its first vertex.
    share
        How far along it, 0 to 1.
    normal
        Rows of the direction in which the distance grows, of length 1.
    """

    distance: _Array
    piece: NDArray[np.intp]
    share: _Array
    normal: _Array

    def slopes(self, moving: _Array, jump: NDArray[np.bool_]) -> _Array:
        """Return the derivatives of the distances as the vertices move.

        Parameters
        ----------
        moving
            The derivatives of the vertices, of shape (vertices, 2, parameters); how a vertex moves along the curve has
            no effect.
        jump
            Whether each vertex is reached by a jump, which moves as the vertex does that it starts from.

        Returns
        -------
        Of shape (points, parameters).
        """
        after = np.where(jump[self.piece + 1], self.piece, self.piece + 1)
        share = self.share[:, None]
        slopes = np.empty((self.piece.size, moving.shape[2]))
        first = np.einsum("ij,ijk->ik", self.normal, moving[self.piece])
        second = np.einsum("ij,ijk->ik", self.normal, moving[after])
        np.subtract(-(1.0 - share) * first, share * second, out=slopes)
        return slopes


def feet(points: _Array, chain: _Array) -> Feet:
    """Find where points are nearest to a connected curve.

    Parameters
    ----------
    points
        Rows of x and y, shape (n, 2).
    chain
        The vertices in order, rows of x and y; two or more, shape (m, 2).

    Examples
    --------
    >>> feet(np.array([[0.5, 1.0], [0.5, -2.0], [3.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])).distance.tolist()
    [1.0, -2.0, 2.0]
    """
    run = np.diff(chain, axis=0)
    length = np.maximum(np.sum(run**2, axis=1), np.finfo(float).tiny)
    piece = np.empty(points.shape[0], dtype=np.intp)
    rows = max(1, _AT_ONCE // len(run))
    for start in range(0, points.shape[0], rows):
        part = slice(start, start + rows)
        x, y = points[part, :1] - chain[:-1, 0], points[part, 1:] - chain[:-1, 1]
        along = np.clip((x * run[:, 0] + y * run[:, 1]) / length, 0.0, 1.0)
        x -= along * run[:, 0]
        y -= along * run[:, 1]
        piece[part] = np.argmin(x * x + y * y, axis=1)
    own, away = run[piece], points - chain[piece]
    share = np.clip(np.sum(away * own, axis=1) / length[piece], 0.0, 1.0)
    left = away - share[:, None] * own
    size = np.hypot(left[:, 0], left[:, 1])
    unit = run / np.sqrt(length)[:, None]
    ahead, behind = np.minimum(piece + 1, len(run) - 1), np.maximum(piece - 1, 0)
    way = unit[piece] + np.where(
        (share == 1.0)[:, None], unit[ahead], np.where((share == 0.0)[:, None], unit[behind], 0.0)
    )  # of a corner the side is that of both its pieces
    sign = np.where(way[:, 0] * left[:, 1] - way[:, 1] * left[:, 0] < 0.0, -1.0, 1.0)
    across = np.column_stack([-unit[piece, 1], unit[piece, 0]])
    ends = ((share == 0.0) | (share == 1.0)) & (size > 0.0)
    out = sign[:, None] * left / np.where(size > 0.0, size, 1.0)[:, None]
    return Feet(sign * size, piece, share, np.where(ends[:, None], out, across))
