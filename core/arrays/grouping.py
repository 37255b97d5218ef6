"""Scenes in groups that share what they can: one table an exponent, one trace a curve, any number of rims on it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.names import PARAMETERS

_TASK: Final = 2048
"""Scenes a task: some milliseconds, a thousand times the cost of handing it to a thread."""


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

    def tasks(self) -> list[tuple[float, NDArray[np.int64]]]:
        """Cut the curves into tasks of one exponent each."""
        k, size = self.k, max(1, _TASK // max(1, self.rims[0].shape[1]))
        if k.size == 0:
            return []
        order = np.arange(k.size) if np.all(k[1:] >= k[:-1]) else np.argsort(k, kind="stable")
        ordered = k[order]
        first = np.flatnonzero(np.concatenate([[True], ordered[1:] != ordered[:-1]]))
        tasks = []
        for exponent, group in zip(ordered[first].tolist(), np.split(order, first[1:]), strict=True):
            tasks += [(exponent, group[i : i + size]) for i in range(0, group.size, size)]
        return tasks


def _shared_axes(shapes: Sequence[tuple[int, ...]], dimensions: int) -> int:
    """Return how many of the last axes no parameter of a curve varies along."""
    for axis in range(dimensions):
        if any(shape[dimensions - 1 - axis] > 1 for shape in shapes):
            return axis
    return dimensions


def _flat(array: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.array(np.broadcast_to(array, shape), order="C").reshape(math.prod(shape))


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
    shape = np.broadcast_shapes(*(array.shape for array in arrays))
    arrays = [array.reshape((1,) * (len(shape) - array.ndim) + array.shape) for array in arrays]
    of_curves, of_rims = arrays[: -len(along)], arrays[-len(along) :]
    shared = _shared_axes([array.shape for array in of_curves], len(shape))
    curve_shape, rim_shape = shape[: len(shape) - shared], shape[len(shape) - shared :]
    lead = (slice(None),) * len(curve_shape) + (0,) * shared
    own = any(length > 1 for array in of_rims for length in array.shape[: len(curve_shape)])
    rows = curve_shape if own else (1,) * len(curve_shape)
    rims = tuple(_flat(array, rows + rim_shape).reshape(-1, math.prod(rim_shape)) for array in of_rims)
    k, nu, modulus, c0, wavelength, amplitude, *others = (_flat(array[lead], curve_shape) for array in of_curves)
    return Grouped(shape, k, nu, modulus, c0, wavelength, amplitude, rims, tuple(others))
