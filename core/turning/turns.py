"""The targets at which cycles turn, and the results."""

from typing import NamedTuple

from gradhesion.core.types import AnyBits, Floats


class Turns(NamedTuple):
    """Rims of one curve and what their cycles turn at; a loop over curves has an axis of curves before that of rims."""

    rims: Floats  # a_max/R, or in wavelengths, of shape (rims,)
    targets: Floats  # what the cycles turn at, of the same shape: depths in R or loads in 1.5 pi R dgamma, or in units
    # of the curve
    by_load: bool  # whether they are loads
    check: bool  # whether the contact that turns is tested for being one disc
    radii: Floats  # found: where unloading starts, in units of the rims, 0 without contact, NaN without a value
    flags: AnyBits  # found: bits of the status, int8 or int16 of the same shape
