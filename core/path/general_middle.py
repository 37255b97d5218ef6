"""Which waves of a long curve are regular, so that they can be summed, and which are to be walked.

A wave is regular where the coordinate falls at the place at which waves are cut: branches end before it, and begin
after it.
"""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import NO, constant, kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.types import Floats
from gradhesion.core.waves.general import NEAREST, cut_of, falls_at_cut

BEGINNING: Final = 16.0
"""Waves walked at the beginning."""
NEAR_RIM: Final = 3.0
"""Waves walked before the rim."""
NEAR_END: Final = 8.0
"""Waves walked before the folds end, and after."""
SHORTEST: Final = 64.0
"""Waves in the middle that are worth being summed."""
LONGEST_WALK: Final = 512.0
"""Waves up to which a curve is walked."""
_SAMPLES: Final = 40
IRREGULAR, FEW, REGULAR = map(constant, range(3))
"""Long curves that cannot be summed; whose folds end so early that they can be walked; and that are summed."""
MOST_WAVES: Final = 1e14
"""Waves beyond which doubles do not resolve the coordinates of neighbours."""


class Middle(NamedTuple):
    """The waves of a long curve that are summed."""

    kind: int  # IRREGULAR, FEW or REGULAR
    until: float  # x up to which folds are searched for
    cut: float  # where waves are cut, 0 .. 1 (waves/general.py)
    again: float  # the wave from which on folds may begin anew, 0 if they do not cease
    begin: float  # the first and the last wave to be summed
    end: float
    ends: bool  # whether folds end beyond


@kernel()
def places_between(low: float, high: float) -> Floats:
    """Return whole waves between two, in equal ratios, of shape (_SAMPLES,)."""
    places = np.empty(_SAMPLES)
    for i in range(_SAMPLES):
        places[i] = np.floor(low * (high / low) ** (i / (_SAMPLES - 1.0)))
    places[0], places[_SAMPLES - 1] = low, high
    return places


@kernel()
def _change(basis: Basis, curve: Series, cut: float, low: float, high: float) -> float:
    """Return the last whole wave that begins as `low` does, with a fall or not, where `high` does not."""
    first = falls_at_cut(basis, curve, cut, low)
    while high - low > 1.0:
        middle = np.floor(0.5 * (low + high))
        if falls_at_cut(basis, curve, cut, middle) == first:
            low = middle
        else:
            high = middle
    return low


@kernel()
def regular_waves(
    basis: Basis, curve: Series, cut: float, first: float, last: float
) -> tuple[float, float, float, bool]:
    """Return which waves of a long curve are to be summed, folds standing between the places `first` and `last` only.

    Returns
    -------
    The wave from which on folds may begin anew, 0 if they do not cease; the first and the last wave that are to be
    summed; and whether folds end beyond.
    """
    low = np.ceil(max(first, NEAREST))
    high = np.floor(last - cut)
    places = places_between(low, high)
    outer = _SAMPLES - 1
    while outer >= 0 and not falls_at_cut(basis, curve, cut, places[outer]):
        outer -= 1
    if outer < 0:
        return 0.0, low, low, True
    ends = outer < _SAMPLES - 1
    end = high - NEAR_RIM
    if ends:
        end = _change(basis, curve, cut, places[outer], places[outer + 1]) - NEAR_END
    inner = outer
    while inner > 0 and falls_at_cut(basis, curve, cut, places[inner - 1]):
        inner -= 1
    if inner == 0:
        return 0.0, low + BEGINNING, end, ends
    begin = _change(basis, curve, cut, places[inner - 1], places[inner])
    again = begin - BEGINNING
    for i in range(inner):
        if falls_at_cut(basis, curve, cut, places[i]):
            again = 0.0
    return again if again > low + BEGINNING else 0.0, begin + BEGINNING, end, ends


@kernel()
def middle_of(basis: Basis, curve: Series, first: float, last: float, apart: float) -> Middle:
    """Return what of a long curve, whose folds stand between `first` and `last` only, is to be summed.

    The sums begin and end `apart` waves further in than they could.
    """
    table, _, series = basis
    if last > MOST_WAVES or last - first < 2.0 * SHORTEST:
        return Middle(IRREGULAR, last, 0.0, 0.0, 0.0, 0.0, NO)
    cut = cut_of(table, series)
    again, begin, end, ends = regular_waves(basis, curve, cut, first, last)
    until = end + 1.0 + 2.0 * NEAR_END if ends else last + 1.0
    begin, end = begin + apart, end - apart
    if end - begin >= SHORTEST:
        return Middle(REGULAR, until, cut, again, begin, end, ends)
    if ends and again == 0.0:
        until = min(last, max(begin, end + NEAR_END) + NEAR_END + apart)
        return Middle(FEW, until, cut, again, begin, end, ends)
    return Middle(IRREGULAR, last, cut, again, begin, end, ends)
