"""A variable of a dataset: its dimensions, type and attributes, and where its values come from."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.tiling import Block


@dataclass(frozen=True, kw_only=True)
class Variable:
    """A variable of a dataset; a coordinate knows its values, an output gets them block by block."""

    dimensions: tuple[str, ...]
    dtype: str
    attributes: dict[str, Any]
    values: NDArray[Any] | None = None
    made: Callable[[Block], NDArray[np.float64]] | None = None
    """Makes the values of a block of a coordinate that may be as large as an output."""
    blank: float | None = None
    """What stands where there is no value, if `_FillValue` says so."""
