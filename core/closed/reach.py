"""The largest radius on which results of scenes depend, and the slope of the punch there: small-slope theory's range.

    contact_slope = (a/R)^(m-1)    the slope of r^m/(m R^(m-1)) at a

a is the pull-off radius for results of the pull-off only; else the turning radius, or for an unbounded punch
without a turn the largest end of a jump: beyond it the saturated cycle loses nothing. Loading arrives there, on the
last branch, by its last jump, and unloading leaves from further inside.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.names import REACH, TURNS
from gradhesion.core.problem.outputs import OUTPUTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE

SMALL: Final = 1.0
"""The slope up to which the punch counts as shallow: at a = R a sphere is twice as deep as its paraboloid."""


def _parts(outputs: Sequence[str]) -> set[str]:
    """Return on what of a cycle some outputs depend."""
    return {OUTPUTS[name].depends_on if name in OUTPUTS else "cycle" for name in outputs} - {""}


def depends_on_contact(outputs: Sequence[str]) -> bool:
    """Report whether any of some outputs depends on a radius of contact.

    >>> depends_on_contact(["wave_slope"]), depends_on_contact(["wave_slope", "pull_off_force"])
    (False, True)
    """
    return bool(_parts(outputs))


def slopes_of(radii: NDArray[np.float64], profile: Profile) -> NDArray[np.float64]:
    """Return the slopes of a punch at radii a/R, of their shape."""
    slopes: NDArray[np.float64] = radii ** (profile.exponent - 1.0)
    return slopes


def is_steep(slopes: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Report which slopes of a punch are no longer small, in their shape; a slope without value is not."""
    steep: NDArray[np.bool_] = slopes > SMALL
    return steep


def radius_of(outputs: Sequence[str], parameters: Mapping[str, ArrayLike]) -> str:
    """Name the result that is the largest radius on which outputs depend; without outputs that of the whole cycle."""
    if _parts(outputs) == {"pull-off"}:
        return "pull_off_radius"
    turned = any(name in parameters for name in TURNS)
    return REACH if not turned and np.isinf(parameters["a_max_over_R"]).any() else "turning_radius"


def slope_at(
    found: Mapping[str, NDArray[Any]], radius: str, parameters: Mapping[str, ArrayLike], profile: Profile
) -> NDArray[np.float64]:
    """Return the slope of the punch at a radius found in each scene, 0 without contact and NaN without a value."""
    status, values = found["status"].astype(np.int16), found[radius]
    if radius == REACH:
        rim = np.broadcast_to(np.asarray(parameters["a_max_over_R"], dtype=float), status.shape)
        values = np.where(np.isinf(rim), values, rim)
    slopes = np.where(status & NO_VALUE, np.nan, slopes_of(values, profile))
    return np.where(status & NO_CONTACT, 0.0, slopes)
