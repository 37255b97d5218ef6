"""Whether the contact of one cosine is one disc on the waves that a trace leaves out: a smooth function of the wave.

The opening outside the end of a wave's branch is sampled at a few of them (waves/cosine.py makes the wave a real
number), and its least value is searched only where it is near zero.
"""

import math
from typing import Final

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.least import GOLDEN, STEPS, least_opening
from gradhesion.core.curve.branches import RUN, RUN_FIRST, RUN_LAST, RUN_LEAST, Trace
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.face import is_always_one_disc
from gradhesion.core.types import Table
from gradhesion.core.waves.cosine import end_of_wave

_SAMPLES: Final = 12
"""Waves of a regular run at which the opening is computed."""
_SMOOTH: Final = 0.25
"""Least opening of the samples from which on nothing lower is searched between them."""


@kernel()
def least_of_wave(table: Table, curve: Cosine, wave: float) -> float:
    """Return the least opening outside the end of a wave's branch; `wave` is any real number."""
    shifted, x = end_of_wave(table, curve, wave)
    return least_opening(table, shifted, x, x + 1.0)


@kernel()
def least_of_run(table: Table, curve: Cosine, first: float, last: float) -> float:
    """Return the least opening outside the ends of regular waves: a smooth function of the wave, sampled."""
    first = max(first, 1.0)
    ratio = power(last / first, 1.0 / (_SAMPLES - 1.0))
    least, at, wave = math.inf, first, first
    for _ in range(_SAMPLES):
        value = least_of_wave(table, curve, min(wave, last))
        if value < least:
            least, at = value, wave
        wave *= ratio
    if least < 0.0 or least > _SMOOTH or last == first:
        return least
    low, high = max(first, at / ratio), min(last, at * ratio)
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    one, other = least_of_wave(table, curve, inner), least_of_wave(table, curve, outer)
    for _ in range(STEPS):
        if min(one, other) < 0.0:
            break
        if one < other:
            high, outer, other = outer, inner, one
            inner = high - GOLDEN * (high - low)
            one = least_of_wave(table, curve, inner)
        else:
            low, inner, one = inner, outer, other
            outer = low + GOLDEN * (high - low)
            other = least_of_wave(table, curve, outer)
    return min(least, one, other)


@kernel()
def least_of_gap(table: Table, curve: Cosine, trace: Trace) -> float:
    """Return the least opening on the waves of the gap that loading passes: that of all rims, or their own."""
    least: float = trace[RUN, RUN_LEAST]
    if math.isnan(least):
        return least_of_run(table, curve, trace[RUN, RUN_FIRST], trace[RUN, RUN_LAST])
    return least


@kernel()
def note_run(table: Table, curve: Cosine, last: float, trace: Trace) -> None:
    """Note whether the contact is one disc on the waves of a gap, where the result is the same for all rims.

    That is so if it is not one disc on the first of them, or surely is on all up to wave `last`.
    """
    first = trace[RUN, RUN_FIRST]
    if is_always_one_disc(table, curve) or not first < last < math.inf:
        return
    least = least_of_wave(table, curve, max(first, 1.0))
    if least >= 0.0:
        least = least_of_run(table, curve, first, last)
        if least <= _SMOOTH:
            return
    trace[RUN, RUN_LEAST] = least
