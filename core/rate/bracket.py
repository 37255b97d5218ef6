"""A zero between two places at which a function has different signs, by the rule of false position (Illinois).

The caller evaluates the function between two tries: a function that is a whole step cannot be passed to a kernel.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import kernel

TRIALS: Final = 60
_SURE: Final = 2e-15


class Bracket(NamedTuple):
    """Two places, the values there, and which of them stayed at the last try: -1 the high one, 1 the low one."""

    low: float
    high: float
    first: float  # may be infinite
    second: float
    side: int


@kernel()
def place_to_try(bracket: Bracket) -> float:
    """Return a place within the bracket."""
    low, high, first, second, _ = bracket
    middle = (low * second - high * first) / (second - first)
    return middle if low < middle < high else 0.5 * low + 0.5 * high


@kernel()
def narrowed(bracket: Bracket, place: float, value: float) -> Bracket:
    """Return the bracket updated by the value at a place within it."""
    low, high, first, second, side = bracket
    if (value < 0.0) == (first < 0.0):
        return Bracket(place, high, value, 0.5 * second if side < 0 else second, -1)
    return Bracket(low, place, 0.5 * first if side > 0 else first, value, 1)


@kernel()
def is_found(bracket: Bracket, value: float, small: float) -> bool:
    """Return whether the last value is small enough, or no double is left between the two places."""
    return abs(value) <= small or not bracket.high - bracket.low > _SURE * bracket.high or not abs(value) < math.inf
