"""Tables of gradient exponents, made once and kept."""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.struve.cosine_bins import build_cosine_bins
from gradhesion.core.struve.series import with_table
from gradhesion.core.struve.series_table import has_table
from gradhesion.core.struve.table import build_table

table_of = lru_cache(maxsize=128)(build_table)
"""The table of an exponent, kept for the next call (56 kB each)."""


@lru_cache(maxsize=128)
def _tables(k: float) -> tuple[Any, NDArray[np.float64]]:
    return build_table(k), build_cosine_bins(k)


@lru_cache(maxsize=16)
def _waves(k: float, rows: bytes) -> NDArray[np.float64]:
    table, bins = _tables(k)
    return with_table(table, bins, np.frombuffer(rows).reshape(-1, 3).copy())


def tables_of(k: float, rows: NDArray[np.float64] | None = None) -> tuple[Any, NDArray[np.float64]]:
    """Return the tables of an exponent, the second with that of a series if there are many harmonics."""
    table, bins = _tables(k)
    if rows is None or not has_table(rows):
        return table, bins.ravel()
    return table, _waves(k, rows.tobytes())
