"""What casts doubt on values of a dataset: flags of `status`, and numbers beyond the range of the model."""

import math
import tomllib
from collections.abc import Callable, Iterator
from operator import gt, lt
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.names.curves import curve_of
from gradhesion.cli.names.outputs import BEST, value_of
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core import doubts_about
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF, RESOLUTION_TOO_COARSE
from gradhesion.core.closed.reach import SMALL
from gradhesion.core.problem.names import CONTACT_SLOPE, RANGE, TURNS
from gradhesion.core.problem.profile import Harmonic, Profile, rows_of, swings
from gradhesion.core.problem.status import DOUBTFUL

if TYPE_CHECKING:
    import xarray

DOUBTS: Final = DOUBTFUL | LINEAR_DEVIATION_OFF | RESOLUTION_TOO_COARSE
"""All bits that cast doubt on some variable."""
SHORT_RANGED: Final = 5.0
"""The Tabor parameter from which on JKR holds (Johnson & Greenwood 1997)."""
LONG_RANGED: Final = 0.1
"""The Tabor parameter up to which the limit of Derjaguin, Muller & Toporov holds instead."""
ONE_DISC: Final = 2.0 / np.sqrt(np.pi)
"""Johnson's alpha at chi = 1/2, up to which short waves keep the contact one disc (docs/theory.md, section 12)."""
STEEPEST: Final = 0.5
"""A slope of waves that is no longer small: a linear half-space errs by about its square."""


def doubts_of(variable: str, dataset: "xarray.Dataset") -> int:
    """Give the bits that cast doubt on a variable of a dataset, whatever it says of its output.

    >>> import xarray
    >>> none = xarray.Dataset()
    >>> doubts_of("dissipated_energy_si", none) == doubts_of("path_load", none) == DOUBTFUL
    True
    >>> doubts_of("delta_max_std_si", none) & ~doubts_of("delta_max", none) == LINEAR_DEVIATION_OFF
    True
    """
    plain = value_of(variable)
    turned = any(name in dataset.coords for name in TURNS)  # at a depth or a load: loading decides on all that follows
    bits = doubts_about(curve_of(plain) or plain, turned=turned)
    if variable.startswith(BEST):
        bits |= RESOLUTION_TOO_COARSE
    sampled = any(str(name).removesuffix("_si").endswith("_std_linear") for name in dataset.data_vars)
    linear = ("_std_linear",) if sampled else ("_std", "_std_linear")  # the deviation of samples is as good as these
    return bits | LINEAR_DEVIATION_OFF if variable.removesuffix("_si").endswith(linear) else bits


class Limit(NamedTuple):
    """When a validity number leaves the range of the model, and what that means."""

    compare: Callable[[Any, float], Any]
    value: float
    condition: str
    words: str


LIMITS: Final = {
    "tabor_parameter": Limit(lt, SHORT_RANGED, f"below {SHORT_RANGED:g}", "the attraction is too long-ranged for JKR"),
    "wave_tabor_parameter": Limit(
        lt, SHORT_RANGED, "below 5, waves higher than the range", "the attraction is too long-ranged for the crests"
    ),
    "wave_slope": Limit(gt, STEEPEST, f"above {STEEPEST:g}", "slopes are not small, as a linear half-space needs"),
    "johnson_alpha": Limit(lt, ONE_DISC, "below 1.13 (chi above 1/2)", "contact on loading may not be one disc"),
    CONTACT_SLOPE: Limit(gt, SMALL, f"above {SMALL:g} (a > R)", "contact reaches slopes that are not small"),
}
"""By the validity number."""


def beyond_by(number: str, dataset: "xarray.Dataset", block: Block = ()) -> "xarray.DataArray | None":
    """Report which scenes of a dataset, or a block of them, a validity number puts beyond its limit; None: unknown.

    The slope of the contact is known of every scene: what is not marked is within its limit.
    """
    if number in dataset.data_vars:
        part = dataset[number][block]
        beyond = part.copy(data=LIMITS[number].compare(part.values, LIMITS[number].value))
        if number == "wave_tabor_parameter":  # waves shallower than the range are not felt
            beyond = beyond & (part["A"] * part["lambda_over_R"] > part[RANGE])
        return beyond
    if number == CONTACT_SLOPE and STEEP in dataset.coords:
        return dataset[STEEP][block] > 0
    return None


def count_beyond(number: str, dataset: "xarray.Dataset") -> int:
    """Count the scenes of a dataset that a validity number puts beyond its limit, as far as that is known."""
    if number == CONTACT_SLOPE and is_cone(dataset):
        return dataset["status"].size
    if number == "wave_slope" and number not in dataset:
        return _steep_waves(dataset)
    blocks = (beyond_by(number, dataset, block) for block in tiling_of(dataset["status"]))
    return sum(int(beyond.sum()) for beyond in blocks if beyond is not None)


def is_cone(dataset: "xarray.Dataset") -> bool:
    """Report whether the punch of a dataset is a cone, whose slope is 1 at every radius."""
    return str(dataset.attrs.get("profile", "")).partition(" ")[0] == "r"


def slope_warnings(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say in one line how many scenes reach slopes of the punch that are not small, if any does."""
    scenes = counted(dataset["status"].size, "scene")
    if is_cone(dataset):
        yield f"a cone of slope 1: slopes are not small in any of {scenes}"
    elif steep := count_beyond(CONTACT_SLOPE, dataset):
        yield f"{steep:,} of {scenes}: {LIMITS[CONTACT_SLOPE].words} (a > R)"


def tabor_warnings(number: float, comment: str) -> Iterator[str]:
    """Say where a Tabor parameter is too small for JKR; `comment` says of which range of the attraction it is.

    >>> list(tabor_warnings(12.0, "")), list(tabor_warnings(0.05, "with a range of 1 nm"))[0][:58]
    ([], 'Tabor parameter 0.05 (with a range of 1 nm) is below 0.1: ')
    """
    if number < LONG_RANGED:
        limit, words = LONG_RANGED, "JKR does not apply, but the limit of Derjaguin, Muller & Toporov"
    elif number < SHORT_RANGED:
        limit, words = SHORT_RANGED, "the attraction is too long-ranged for JKR, and the fitted values are doubtful"
    else:
        return
    yield f"Tabor parameter {number:.2g} ({comment}) is below {limit:g}: {words}"


def steepness(rows: NDArray[np.float64]) -> float:
    """Give the steepest slope of waves over A, by their rows (n, cos, sin): 2 pi of one cosine.

    >>> steepness(np.array([[1.0, 1.0, 0.0]])) == 2.0 * math.pi
    True
    """
    return 2.0 * math.pi * max(swings(-1.0, tuple(map(tuple, rows.tolist())))) if len(rows) else 0.0


def _steep_waves(dataset: "xarray.Dataset") -> int:
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
