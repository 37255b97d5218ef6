"""How steep the waves of a dataset are, whether or not `wave_slope` is one of its outputs."""

import math
import tomllib
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.problem.profile import Harmonic, Profile, rows_of, swings

if TYPE_CHECKING:
    import xarray

STEEPEST: Final = 0.5
"""A slope that is no longer small: a linear half-space errs by about its square."""


def steepness(rows: NDArray[np.float64]) -> float:
    """
    Give the steepest slope of waves over A, by their rows (n, cos, sin): 2 pi of one cosine.

    >>> steepness(np.array([[1.0, 1.0, 0.0]])) == 2.0 * math.pi
    True
    """
    return 2.0 * math.pi * max(swings(-1.0, tuple(map(tuple, rows.tolist())))) if len(rows) else 0.0


def steep_waves(dataset: "xarray.Dataset") -> int:
    """Count the scenes whose waves are steep; 0 where that is not known: without a study, or of random waves."""
    if "study" not in dataset.attrs or "A" not in dataset.coords:
        return 0
    try:
        table: Any = tomllib.loads(dataset.attrs["study"]).get("profile", {})
        table = tomllib.loads(dataset.attrs["profile_fit"]) if "profile_fit" in dataset.attrs else table
        harmonics = tuple(Harmonic(**one) for one in table.get("harmonics", [{"n": 1}]))
    except (ValueError, TypeError, AttributeError, RecursionError):
        return 0
    if "spectrum" in table:
        return 0
    steep = dataset["A"].values * steepness(rows_of(Profile(harmonics=harmonics))) > STEEPEST
    return int(np.count_nonzero(steep)) * dataset["status"].size // steep.size
