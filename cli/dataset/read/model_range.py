"""Where scenes leave the range of the model: validity numbers beyond their limits."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.waves import STEEPEST
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.closed.reach import SMALL, is_steep
from gradhesion.core.problem.names import CONTACT_SLOPE, RANGE


@dataclass(frozen=True, kw_only=True)
class Limit:
    """Beyond what a validity number leaves the range of the model, and what that means."""

    beyond: Callable[[NDArray[np.float64]], NDArray[np.bool_]]
    condition: str
    words: str


SHORT_RANGED: Final = 5.0
"""The Tabor parameter from which on JKR holds (Johnson & Greenwood 1997)."""
LONG_RANGED: Final = 0.1
"""The Tabor parameter up to which the limit of Derjaguin, Muller & Toporov holds instead."""
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
        beyond=lambda values: values > STEEPEST,
        condition=f"above {STEEPEST:g}",
        words="slopes are not small, as a linear half-space needs",
    ),
    "johnson_alpha": Limit(
        beyond=lambda values: values < ONE_DISC,
        condition="below 1.13 (chi above 1/2)",
        words="contact on loading may not be one disc",
    ),
    CONTACT_SLOPE: Limit(
        beyond=is_steep,
        condition=f"above {SMALL:g} (a > R)",
        words="contact reaches slopes that are not small",
    ),
}
"""By the validity number."""


def beyond_by(number: str, dataset: xarray.Dataset, block: Block = ()) -> xarray.DataArray | None:
    """Report which scenes of a dataset, or a block of them, a validity number puts beyond its limit; None: unknown.

    The slope of the contact is known of every scene: what is not marked is within its limit.
    """
    if number in dataset.data_vars:
        return is_beyond(dataset[number][block])
    if number == CONTACT_SLOPE and STEEP in dataset.coords:
        return dataset[STEEP][block] > 0
    return None


def is_beyond(part: xarray.DataArray) -> xarray.DataArray:
    """Report which scenes are beyond the limit of a validity number, which is the name of the array."""
    name = str(part.name)
    beyond = part.copy(data=LIMITS[name].beyond(part.values))
    if name == "wave_tabor_parameter":  # waves shallower than the range are not felt
        beyond = beyond & (part["A"] * part["lambda_over_R"] > part[RANGE])
    return beyond


def is_cone(dataset: xarray.Dataset) -> bool:
    """Report whether the punch of a dataset is a cone, whose slope is 1 at every radius."""
    return str(dataset.attrs.get("profile", "")).partition(" ")[0] == "r"


def steep_scenes(dataset: xarray.Dataset) -> int:
    """Count the scenes whose contact reaches a slope of the punch that is not small."""
    blocks = (beyond_by(CONTACT_SLOPE, dataset, block) for block in tiling_of(dataset["status"]))
    return sum(int(beyond.sum()) for beyond in blocks if beyond is not None)


def slope_warnings(dataset: xarray.Dataset) -> Iterator[str]:
    """Say in one line how many scenes reach slopes of the punch that are not small, if any does."""
    if is_cone(dataset):
        yield f"a cone of slope 1: slopes are not small in any of {counted(dataset['status'].size, 'scene')}"
    elif steep := steep_scenes(dataset):
        share = f"{steep:,} of {counted(dataset['status'].size, 'scene')}"
        yield f"{share}: {LIMITS[CONTACT_SLOPE].words} (a > R)"


def tabor_warnings(number: float, comment: str) -> Iterator[str]:
    """
    Say where a Tabor parameter is too small for JKR; `comment` says of which range of the attraction it is.

    >>> list(tabor_warnings(12.0, "")), list(tabor_warnings(0.05, "with a range of 1 nm"))[0][:58]
    ([], 'Tabor parameter 0.05 (with a range of 1 nm) is below 0.1: ')
    """
    if number < LONG_RANGED:
        yield (
            f"Tabor parameter {number:.2g} ({comment}) is below {LONG_RANGED:g}: JKR does not apply, but the limit of "
            "Derjaguin, Muller & Toporov"
        )
    elif number < SHORT_RANGED:
        yield (
            f"Tabor parameter {number:.2g} ({comment}) is below {SHORT_RANGED:g}: the attraction is too long-ranged "
            "for JKR, and the fitted values are doubtful"
        )
