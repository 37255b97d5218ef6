"""Groups of scenes that share work: one table per exponent, one trace per curve, any number of rims on it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.tasks import groups_of
from gradhesion.core.problem.names import PARAMETERS

_TASK: Final = 2048
"""Scenes of a task: some milliseconds, a thousand times the cost of starting it on a thread."""
_FEW: Final = 64
"""Curves of an exponent from which on computing a table for it saves time."""
_SHORT: Final = 256
"""Scenes of a call that one thread solves before several could start."""
_SEVERAL: Final = 8
"""Exponents whose own tables such a call reads side by side."""
_TOGETHER: Final = 512
"""Exponents of few curves that are one task."""
_MANY: Final = 128
"""Exponents of few curves from which on interpolating tables saves time."""

_LOOKED_AT: Final = 1024
"""Curves by whose exponents it is judged whether all differ."""


def are_few(counts: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Report which exponents, by the numbers of their curves, are to have interpolated tables; shape of `counts`."""
    few = counts < _FEW
    return few & (np.count_nonzero(few) >= _MANY)


def _seem_to_differ(k: NDArray[np.float64]) -> bool:
    """Report whether nearly all of some curves have an exponent k (curves,) of their own, by the first ones."""
    return k.size >= _LOOKED_AT and np.unique(k[:_LOOKED_AT]).size > 0.9 * _LOOKED_AT


@dataclass(frozen=True)
class Task:
    """Curves of one task.

    Attributes
    ----------
    exponents
        Their gradient exponents, shape (exponents,): one, several of a short call, or many of few curves each.
    which
        Of each curve, the number of its exponent; shape (curves,).
    index
        Of each curve, its number among all; shape (curves,).
    interpolated
        Whether its tables are interpolated (struve/interpolated.py), which takes less time for few curves.
    """

    exponents: NDArray[np.float64]
    which: NDArray[np.int64]
    index: NDArray[np.int64]
    interpolated: bool = False


@dataclass(frozen=True)
class Grouped:
    """The scenes of broadcast parameters: curves that have rims.

    Attributes
    ----------
    shape
        The broadcast shape; its last axes are those of the rims.
    k, nu, modulus, c0_over_R, lambda_over_R, A
        Of each curve; shape (curves,).
    rims
        What varies along a curve, one array a name, all of the same shape: (1, rims), or (curves, rims) where the rims
        of one of them differ from curve to curve.
    others
        Further parameters of each curve; shape (curves,).
    """

    shape: tuple[int, ...]
    k: NDArray[np.float64]
    nu: NDArray[np.float64]
    modulus: NDArray[np.float64]
    c0_over_R: NDArray[np.float64]  # noqa: N815 -- the name of the parameter
    lambda_over_R: NDArray[np.float64]  # noqa: N815
    A: NDArray[np.float64]
    rims: tuple[NDArray[np.float64], ...]
    others: tuple[NDArray[np.float64], ...] = ()

    @property
    def size(self) -> tuple[int, int]:
        """The number of curves, and of rims on each."""
        return self.k.size, self.rims[0].shape[1]

    def tasks(
        self,
        some: NDArray[np.int64] | None = None,
        *,
        scenes: int = _TASK,
        together: int = _TOGETHER,
        as_they_stand: bool = False,
    ) -> list[Task]:
        """Cut curves into tasks: those of one exponent, of all in a short call, or of many that have few curves each.

        Parameters
        ----------
        some
            The numbers of the curves, shape (n,); all of them if not given.
        scenes, together
            Scenes of a task, and exponents of few curves, at most.
        as_they_stand
            Whether curves that have an exponent each may be left in their order: so they are read and written faster,
            and tables slower, where neighbours have close exponents.
        """
        k, size = self.k if some is None else self.k[some], max(1, scenes // max(1, self.rims[0].shape[1]))
        if k.size == 0:
            return []
        if k[0] == k[-1] and (k == k[0]).all():
            alike = np.arange(k.size) if some is None else some
            parts = (alike[i : i + size] for i in range(0, k.size, size))
            return [Task(k[:1], np.zeros(index.size, dtype=np.int64), index) for index in parts]
        if as_they_stand and _seem_to_differ(k):
            order = np.arange(k.size) if some is None else some
            return [
                Task(k[i : i + size], np.arange(min(size, k.size - i)), order[i : i + size], interpolated=True)
                for i in range(0, k.size, size)
            ]
        order, first = groups_of(k)
        ordered = k[order]
        order = order if some is None else some[order]
        counts = np.diff(first, append=k.size)
        if first.size <= _SEVERAL and k.size * self.rims[0].shape[1] <= _SHORT:
            return [Task(ordered[first], np.repeat(np.arange(first.size), counts), order)]
        few = are_few(counts)
        tasks = []
        for begin, count in zip(first[~few].tolist(), counts[~few].tolist(), strict=True):
            group = order[begin : begin + count]
            for i in range(0, count, size):
                index = group[i : i + size]
                tasks.append(Task(ordered[begin : begin + 1], np.zeros(index.size, dtype=np.int64), index))
        exponents, left = ordered[first[few]], order[np.repeat(few, counts)]
        counts = counts[few]
        ends = np.cumsum(counts)
        begin, i = 0, 0
        while i < exponents.size:
            last = max(i + 1, min(i + together, int(np.searchsorted(ends, begin + size, side="right"))))
            which = np.repeat(np.arange(last - i), counts[i:last])
            tasks.append(Task(exponents[i:last], which, left[begin : ends[last - 1]], interpolated=True))
            begin, i = int(ends[last - 1]), last
        return tasks


def _shared_axes(shapes: Sequence[tuple[int, ...]], dimensions: int) -> int:
    """Return how many of the last axes no parameter of a curve varies along."""
    for axis in range(dimensions):
        if any(shape[dimensions - 1 - axis] != 1 for shape in shapes):
            return axis
    return dimensions


def _flat(array: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return a new array, broadcast to a shape, of one axis."""
    spread = np.empty(shape)
    spread[...] = array
    return spread.reshape(spread.size)


def grouped(
    parameters: Mapping[str, ArrayLike], along: Sequence[str] = PARAMETERS[-1:], more: Sequence[str] = ()
) -> Grouped:
    """Group the scenes of broadcast parameters.

    Parameters
    ----------
    parameters
        An array for each name of `PARAMETERS` and of `along`, all broadcastable.
    along
        The names of what may vary along a curve.
    more
        Further parameters of a curve.
    """
    names = (*PARAMETERS[:-1], *more, *along)
    arrays: list[NDArray[Any]] = [np.asarray(parameters[name], dtype=float) for name in names]
    shape = np.broadcast(*arrays).shape
    arrays = [array.reshape((1,) * (len(shape) - array.ndim) + array.shape) for array in arrays]
    of_curves, of_rims = arrays[: -len(along)], arrays[-len(along) :]
    shared = _shared_axes([array.shape for array in of_curves], len(shape))
    curve_shape, rim_shape = shape[: len(shape) - shared], shape[len(shape) - shared :]
    lead = (slice(None),) * len(curve_shape) + (0,) * shared
    own = any(length > 1 for array in of_rims for length in array.shape[: len(curve_shape)])
    rows = curve_shape if own else (1,) * len(curve_shape)
    rims = tuple(_flat(array, rows + rim_shape).reshape(math.prod(rows), math.prod(rim_shape)) for array in of_rims)
    k, nu, modulus, c0, wavelength, amplitude, *others = (_flat(array[lead], curve_shape) for array in of_curves)
    return Grouped(shape, k, nu, modulus, c0, wavelength, amplitude, rims, tuple(others))
