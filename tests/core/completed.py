"""Interpolated tables with all that kernels fill when they read it."""

from typing import Any

import numba
from numpy.typing import NDArray

from gradhesion.core.struve.filling import ask_for_arches, ask_for_bin, ask_for_moments


@numba.njit
def _complete(tables: NDArray[Any]) -> None:
    for j in range(tables.size):
        for i in range(tables[j].lacks_bin.size):
            ask_for_bin(tables[j], i)
        for i in range(tables[j].lacks_moments.size):
            ask_for_moments(tables[j], i)
        for i in range(tables[j].lacks_arches.size):
            ask_for_arches(tables[j], i)


def completed(tables: NDArray[Any]) -> NDArray[Any]:
    """Fill what tables lack, and return them."""
    _complete(tables)
    return tables
