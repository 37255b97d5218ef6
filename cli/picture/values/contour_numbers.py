"""Numbers on contours: where one fits into the frame, keeps clear of numbers and other lines, and nowhere else."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.contour import QuadContourSet
from numpy.typing import NDArray

from gradhesion.cli.picture.labels import Unit

Places = NDArray[np.float64]

SIZE: Final = "x-small"

SPACE: Final = 2.0
"""The space around a number, in pixels."""

LINE: Final = 1.8
"""The length of a line that has room for a number, in widths of the number: a shorter one would be a stub."""

STEP: Final = 2.0
"""The distance of points along a line, in pixels."""

MOST_BETWEEN: Final = 100
"""Points between two vertices of a line; those further apart belong to two pieces."""

TRIES: Final = 60
"""Places tried along a line."""

BEND: Final = 0.96
"""A number stands where its line is straight: the chord over the arc below it is no less than this."""


def number_contours(contours: Sequence[tuple[QuadContourSet, Unit]]) -> None:
    """
    Put a number on each line where there is room; the layout of the figure must stand.

    The best place of a line is the straightest one, and among straight ones that in the middle.
    """
    taken: list[Places] = []
    for lines, unit in contours:
        transform = lines.get_transform()
        frame = np.array(lines.axes.get_window_extent().extents)
        crossed = [_points(transform.transform(path.vertices)) for path in lines.get_paths()]
        for item, level in enumerate(lines.levels):
            others = np.vstack([np.empty((0, 2)), *crossed[:item], *crossed[item + 1 :]])
            width, height = _size(lines, unit.number(level))
            box = np.array([width, height]) + 2.0 * SPACE
            best: tuple[float, Places] | None = None
            pieces = lines.get_paths()[item]
            for piece in pieces.to_polygons(closed_only=False):
                line = transform.transform(piece)
                lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
                if lengths[-1] < LINE * width:
                    continue
                for share in np.linspace(0.0, 1.0, TRIES + 2)[1:-1]:
                    middle = share * lengths[-1]
                    ends = np.array([_at(line, lengths, middle + step * box[0]) for step in (-0.5, 0.0, 0.5)])
                    chord = ends[2] - ends[0]
                    straight = float(np.hypot(*chord)) / box[0]
                    corners = _corners(ends[1], chord, box)
                    if straight < BEND or not _within(corners, frame) or _covers(corners, others):
                        continue
                    if any(_touch(corners, other) for other in taken):
                        continue
                    rank = straight - 0.2 * abs(share - 0.5)
                    if best is None or rank > best[0]:
                        best = rank, np.vstack([ends[1:2], corners])
            if best is not None:
                x, y = transform.inverted().transform(best[1][0])
                lines.clabel(manual=[(x, y)], fmt=unit.number, fontsize=SIZE, inline_spacing=SPACE)
                taken.append(best[1][1:])


def _size(lines: QuadContourSet, words: str) -> tuple[float, float]:
    """Measure a number, in pixels."""
    text = lines.axes.text(0.0, 0.0, words, fontsize=SIZE)
    box = text.get_window_extent()
    text.remove()
    return float(box.width), float(box.height)


def _at(line: Places, lengths: Places, length: float) -> Places:
    """Find the place on a line at a length along it; beyond an end it is the end."""
    return np.array([np.interp(length, lengths, row) for row in line.T])


def _corners(middle: Places, along: Places, box: Places) -> Places:
    """Give the corners of a box of a width and a height that is turned along a direction."""
    ahead = along / max(float(np.hypot(*along)), 1e-12)
    aside = np.array([-ahead[1], ahead[0]])
    return np.array(
        [middle + 0.5 * (i * box[0] * ahead + j * box[1] * aside) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )


def _points(line: Places) -> Places:
    """Put points along lines, so near to each other that none passes through a number between two of them."""
    counts = np.ceil(np.hypot(*np.diff(line, axis=0).T) / STEP).astype(int)
    counts = np.where((counts > MOST_BETWEEN) | (counts < 1), 1, counts)  # from the end of a piece to the next
    pieces = [
        start + np.linspace(0.0, 1.0, count, endpoint=False)[:, np.newaxis] * (end - start)
        for start, end, count in zip(line[:-1], line[1:], counts, strict=True)
    ]
    return np.vstack([np.empty((0, 2)), *pieces])


def _covers(corners: Places, points: Places) -> bool:
    """
    Report whether a box has points in it.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> _covers(square, np.array([[0.5, 0.5]])), _covers(square, np.array([[0.5, 1.5]]))
    (True, False)
    """
    inside = np.ones(len(points), bool)
    for side in (corners[1] - corners[0], corners[2] - corners[1]):
        along = (points - corners[0]) @ side
        inside &= (along >= 0.0) & (along <= side @ side)
    return bool(inside.any())


def _within(corners: Places, frame: Places) -> bool:
    """Report whether all corners are inside a frame (left, bottom, right, top)."""
    return bool((corners >= frame[:2]).all() and (corners <= frame[2:]).all())


def _touch(one: Places, other: Places) -> bool:
    """
    Report whether two boxes overlap: no side of either has all of the other beyond it.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> _touch(square, square + 0.5), _touch(square, square + 2.0)
    (True, False)
    """
    for box in (one, other):
        for side in np.roll(box, -1, axis=0) - box:
            normal = np.array([-side[1], side[0]])
            first, second = one @ normal, other @ normal
            if first.max() < second.min() or second.max() < first.min():
                return False
    return True
