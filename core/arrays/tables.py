"""Tables of gradient exponents, made once and kept."""

from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.arrays.grouping import Task
from gradhesion.core.harmonics.cosine_bins import build_cosine_bins
from gradhesion.core.harmonics.series import with_table
from gradhesion.core.harmonics.series_by_k import change_of
from gradhesion.core.harmonics.series_table import COSINES, has_table
from gradhesion.core.sensitivities.neighbours import exponents_beside
from gradhesion.core.struve.interpolated import interpolated_tables, table_of_each
from gradhesion.core.struve.table import build_table


@lru_cache(maxsize=128)
def _own(k: float) -> NDArray[Any]:
    """Return the table of an exponent as an array of shape (1,)."""
    return np.array([build_table(k)])


def table_of(k: float) -> Any:
    """Return the table of an exponent, kept for the next call (75 kB each)."""
    return _own(k)[0]


@lru_cache(maxsize=16)
def _own_of_several(exponents: tuple[float, ...]) -> NDArray[Any]:
    """Return the tables of some exponents side by side, of shape (exponents,)."""
    return np.concatenate([_own(k) for k in exponents])


def tables_for(task: Task, *, forces: bool = False) -> NDArray[Any]:
    """Return the tables of a task, for kernels that look up each of them (struve/current.py).

    A value that is no exponent has the table of exponent 0. With `forces` only pull-off forces are computed from them.
    Their shape is (exponents,), or (1,) where they are interpolated one after the other.
    """
    exponents = np.where((task.exponents >= 0.0) & (task.exponents <= 1.0), task.exponents, 0.0)
    if task.interpolated:
        return table_of_each(exponents, forces=forces)
    return _own(float(exponents[0])) if exponents.size == 1 else _own_of_several(tuple(exponents.tolist()))


def neighbours_for(task: Task) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Return the weights of derivatives by the exponents of a task (sensitivities/neighbours.py), a row for each.

    Returns
    -------
    The tables of neighbours and their weights, of shape (exponents, 4).
    """
    inside = np.where((task.exponents >= 0.0) & (task.exponents <= 1.0), task.exponents, 0.0)
    beside = [exponents_beside(float(k)) for k in inside]
    exponents = np.array([others for others, _ in beside])
    if task.interpolated:
        tables = interpolated_tables(exponents.ravel())
    else:
        tables = np.concatenate([_own(k) for k in exponents.ravel().tolist()])
    return tables.reshape(exponents.shape), np.array([weights for _, weights in beside])


_NO_SINES: Final = np.zeros(COSINES)
"""Used for the table of sines where a profile has none: no value depends on it, the sizes of terms a little."""


@lru_cache(maxsize=128)
def _tables(k: float) -> tuple[Any, NDArray[np.float64]]:
    """Return the table of an exponent and its bins of T0 and T1, of shape (BINS, BIN_TERMS, 4)."""
    return build_table(k), build_cosine_bins(k)


@lru_cache(maxsize=16)
def _waves(k: float, rows: bytes) -> NDArray[np.float64]:
    """Return the flat array of harmonics/series_table.py of an exponent and a series, its rows as bytes."""
    table, bins = _tables(k)
    return with_table(table, bins, np.frombuffer(rows).reshape(-1, 3).copy())


def tables_of(
    k: float, rows: NDArray[np.float64] | None = None, *, interpolated: bool = False
) -> tuple[Any, NDArray[np.float64]]:
    """Return the tables of an exponent, the second with that of a series if there are many harmonics.

    They are `interpolated` on demand, where they can be: the second one is of sines, and of many harmonics.
    """
    if interpolated and rows is not None and not rows[:, 2].any() and not has_table(rows):
        return interpolated_tables(np.array([k]), whole=True)[0], _NO_SINES
    table, bins = _tables(k)
    if rows is None or not has_table(rows):
        return table, bins.ravel()
    return table, _waves(k, rows.tobytes())


@lru_cache(maxsize=16)
def _changes(k: float, rows: bytes) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Return the result of `changes_of` for a series, given its rows as bytes."""
    series = np.frombuffer(rows).reshape(-1, 3).copy()
    exponents, weights = exponents_beside(k)
    return change_of(tables_of(k, series), [tables_of(other, series) for other in exponents], weights)


def changes_of(k: float, rows: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Return the derivatives of the tables of an exponent by the exponent (harmonics/series_by_k.py)."""
    return _changes(k, rows.tobytes())
