"""What a call asks for, and how its scenes are cut into parts for threads."""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.processors import processors
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import Punch
from gradhesion.core.table.basis import is_interpolated
from gradhesion.core.types import Floats, Integers

Places: TypeAlias = slice | Integers
"""Of scenes among all."""
_SCENES: Final = 1000
"""Scenes of a part, at least: a millisecond or more."""
_MOST_SCENES: Final = 4000
"""And at most: a megabyte of results. (No powers of 2, by which all rows would share the same few lines of a cache.)"""


class Wanted(NamedTuple):
    """What of a scene is wanted."""

    cycle: bool  # anything but the pull-off
    contact: bool  # whether loading keeps the contact one disc
    residual: bool  # the loop integral
    saturation: bool  # the radius beyond which there is no fold


class Request(NamedTuple):
    """What a call asks for.

    arrays      an array for each row of parameters (rows.py), all broadcastable
    shape       that of all of them together, which is that of the scenes
    punch       what they share
    """

    arrays: list[Floats]
    shape: tuple[int, ...]
    punch: Punch


def columns_of(request: Request) -> tuple[list[Floats], int]:
    """Return each row of parameters, of one item or one a scene, and the number of scenes."""
    shape = request.shape
    full = [a if a.size == 1 or a.shape == shape else np.broadcast_to(a, shape) for a in request.arrays]
    return [a.reshape(-1) for a in full], math.prod(shape)


def scenes_of(columns: list[Floats], first: int, last: int) -> Floats:
    """Return the parameters of the scenes `first` to `last` - 1, (PARAMETER_ROWS, scenes)."""
    scenes = np.empty((len(columns), last - first))
    for row, column in enumerate(columns):
        scenes[row] = column if column.size == 1 else column[first:last]
    return scenes


def _by_exponent(columns: list[Floats], first: int, last: int) -> tuple[Floats, Places]:
    """Return the scenes `first` to `last` - 1 in the order of their exponents, and their places among all."""
    scenes = scenes_of(columns, first, last)
    if not (scenes[at.K, 1:] < scenes[at.K, :-1]).any():
        return scenes, slice(first, last)
    order = np.argsort(scenes[at.K], kind="stable")
    return np.ascontiguousarray(scenes[:, order]), first + order


def set_lengths(punch: Punch, scenes: Floats) -> None:
    """Give smooth punches on a pattern its wavelength, where that is shorter: another has no meaning for them."""
    if punch.rows.shape[1] > 0:
        smooth = (scenes[at.AMPLITUDE] == 0.0) & (scenes[at.PATTERN_WAVELENGTH] < scenes[at.WAVELENGTH])
        smooth &= scenes[at.WAVELENGTH] < np.inf  # which is out of range
        scenes[at.WAVELENGTH, smooth] = scenes[at.PATTERN_WAVELENGTH, smooth]


def run_parts(request: Request, work: Callable[[Floats, Places], None], threads: int | None) -> None:
    """Do the work on parts of the scenes, in the order of their exponents, on threads that each take the next part.

    `work` takes the parameters of a part, (PARAMETER_ROWS, scenes), and the places of its scenes among all. Parts of a
    long series, whose bins are not interpolated in k, have one exponent.
    """
    punch, (columns, count) = request.punch, columns_of(request)
    workers = 1 if count < 2 * _SCENES else min(threads or processors(), -(-count // _SCENES))
    size = max(_SCENES, min(_MOST_SCENES, -(-count // (4 * workers)))) if workers > 1 else _MOST_SCENES

    def part(first: int) -> None:
        """Do the work on one part."""
        scenes, places = _by_exponent(columns, first, min(first + size, count))
        set_lengths(punch, scenes)
        if is_interpolated(punch.waves):
            work(scenes, places)
            return
        ends = [*(np.flatnonzero(np.diff(scenes[at.K]) != 0.0) + 1), scenes.shape[1]]
        numbers = np.arange(count)[places]
        for start, end in pairwise([0, *ends]):
            work(np.ascontiguousarray(scenes[:, start:end]), numbers[start:end])

    if workers < 2:
        for first in range(0, count, size):
            part(first)
        return
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(part, range(0, count, size)))
