"""Where scenes leave the range of the model: validity numbers beyond their limits."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.keys import ADHESION_RANGE


@dataclass(frozen=True, kw_only=True)
class Limit:
    """Beyond what a validity number leaves the range of the model, and what that means."""

    beyond: Callable[[NDArray[np.float64]], NDArray[np.bool_]]
    condition: str
    words: str


SHORT_RANGED: Final = 5.0
"""The Tabor parameter from which on JKR holds (Johnson & Greenwood 1997)."""
STEEP: Final = 0.5
"""A slope that is no longer small: a linear half-space errs by about its square."""
ONE_DISC: Final = 2.0 / np.sqrt(np.pi)
"""Johnson's alpha at chi = 1/2, up to which short waves keep the contact one disc (docs/theory.md, section 12)."""

LIMITS: Final = {
    "tabor_parameter": Limit(
        beyond=lambda values: values < SHORT_RANGED,
        condition=f"below {SHORT_RANGED:g}",
        words="the attraction is too long-ranged for JKR",
    ),
    "wave_tabor_parameter": Limit(
        beyond=lambda values: values < SHORT_RANGED,
        condition=f"below {SHORT_RANGED:g}, waves higher than the range",
        words="the attraction is too long-ranged for the crests",
    ),
    "wave_slope": Limit(
        beyond=lambda values: values > STEEP,
        condition=f"above {STEEP:g}",
        words="slopes are not small, as a linear half-space needs",
    ),
    "johnson_alpha": Limit(
        beyond=lambda values: values < ONE_DISC,
        condition="below 1.13 (chi above 1/2)",
        words="contact on loading may not be one disc",
    ),
}
"""By the validity number."""


def is_beyond(part: xarray.DataArray) -> xarray.DataArray:
    """Report which scenes are beyond the limit of a validity number, which is the name of the array."""
    name = str(part.name)
    beyond = part.copy(data=LIMITS[name].beyond(part.values))
    if name == "wave_tabor_parameter":  # waves shallower than the range are not felt
        beyond = beyond & (part["A"] * part["lambda_over_R"] > part[ADHESION_RANGE])
    return beyond
