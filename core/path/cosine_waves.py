"""Single waves of a long curve of one cosine: which reaches a depth first, which starts lowest, which a rim is on.

The envelopes of the waves give the place, and neighbours are compared from there. So far out that no double resolves
the phase, or which of two neighbours is lower, the envelopes have the last word.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.branches import (
    END,
    END_DEPTH,
    START,
    START_DEPTH,
    UNKNOWN,
    UNLOADING_JUMPS,
    Trace,
)
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.face import size_at
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import MOST_ARCHES
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table
from gradhesion.core.waves.cosine import fold_of_wave

_MOST_NEAR_RIM: Final = 2.0e13
"""Arches up to which a phase is resolved near a rim: to a hundredth, of waves that are 10^-13 of all."""
_ORDERED: Final = 20.0
"""Times the square of what rounding leaves of a phase, below which neighbours need not be in order (is_reported)."""
_ROUNDING: Final = 4.0 * 2.0**-52
"""Of the terms of a depth, what rounding adds to the difference of two."""
_HALVINGS: Final = 200
_NEWTON_STEPS: Final = 8
_NEAR_WAVE: Final = 0.3
"""Last step of Newton's method, in z, in search of a wave."""


@kernel()
def is_reported(table: Table, curve: Cosine, arch: float) -> bool:
    """Return whether a double resolves places on an arch well enough to walk there.

    A fold that is off by e has a depth that is off by e^2/2 of the wave; neighbours differ by 2 pi b z^n/(g C) of it.
    """
    b, g, _ = curve
    z = math.pi * arch
    e = 2.0**-52 * z
    rise = TWO_PI * b / (amplitude_power(table, z) * g * table.amplitude)
    return arch < MOST_ARCHES or (arch < _MOST_NEAR_RIM and _ORDERED * e * e < rise)


@kernel()
def wave_of(table: Table, start: float) -> float:
    """Return the number of the wave whose branch starts at x: half a wave to none before its centre."""
    return np.floor(start - table.phase / TWO_PI + 0.75)


@kernel()
def first_wave_above(
    table: Table, curve: Cosine, low: float, high: float, level: float
) -> tuple[float, float, float, float, float]:
    """Return the first wave after `low`, which ends below a depth, that ends above it; `high` does.

    It is where the upper envelope b z^2/2 - (1 - C g) z^c + g passes the depth, or next to it. Then come place and
    depth of its end, and of that of the wave before it; NaN for `high` and `low` themselves.
    """
    b, g, _ = curve
    stretch = 1.0 - g * table.amplitude
    # beyond it: Newton's method comes down to it from there
    z = math.sqrt(2.0 * max(level - g, 0.0) / b) + power(2.0 * max(stretch, 0.0) / b, 2.0 / (3.0 + table.k))
    z = max(z, TWO_PI * low)
    for _ in range(_NEWTON_STEPS):
        pull = stretch * z * amplitude_power(table, z)
        step = (0.5 * b * z * z - pull + g - level) / (b * z - 0.5 * (1.0 - table.k) * pull / z)
        z = max(z - step, TWO_PI * low)
        if abs(step) < _NEAR_WAVE:
            break
    middle = np.floor(z / TWO_PI - table.phase / TWO_PI)
    end, top, end_before, top_before = math.nan, math.nan, math.nan, math.nan
    step = 1.0
    for _ in range(_HALVINGS):
        if high - low <= 1.0:
            break
        middle = max(low + 1.0, min(high - 1.0, middle))
        place, end_depth = fold_of_wave(table, curve, middle, NO)
        if end_depth > level:
            high, end, top, middle = middle, place, end_depth, middle - step
        else:
            low, end_before, top_before, middle = middle, place, end_depth, middle + step
        step *= 2.0
        if not low < middle < high:
            middle = np.floor(0.5 * (low + high))
    return high, end, top, end_before, top_before


@kernel()
def lowest_wave(table: Table, curve: Cosine, low: float, high: float) -> tuple[float, bool]:
    """Return the wave between two others whose branch starts lowest, and whether a neighbour hardly starts higher.

    The starts fall up to it and rise from it on.

    It is where the lower envelope b z^2/2 - (1 + C g) z^c is lowest, or next to it. Where neighbours differ by no more
    than rounding, from some 10^8 waves on, their order says nothing, and the place of the envelope is as good as any.
    """
    b, g, _ = curve
    k = table.k
    z = power(0.5 * (1.0 - k) * (1.0 + g * table.amplitude) / b, 2.0 / (3.0 + k))
    middle = np.floor(z / TWO_PI - table.phase / TWO_PI)
    step, close = 1.0, NO
    for _ in range(_HALVINGS):  # the lowest is one of low .. high
        if high <= low:
            break
        middle = max(low, min(high - 1.0, middle))
        place, here = fold_of_wave(table, curve, middle, YES)
        _, beyond = fold_of_wave(table, curve, middle + 1.0, YES)
        difference, size = abs(beyond - here), size_at(table, curve, place)
        close = close or difference <= CLOSE * size
        if difference <= _ROUNDING * size:
            return middle, close
        if beyond < here:
            low, middle = middle + 1.0, middle + step
        else:
            high, middle = middle, middle - step
        step *= 2.0
        if not low <= middle < high:
            middle = np.floor(0.5 * (low + high))
    return low, close


@kernel()
def put_nominal_branch(table: Table, curve: Cosine, rim: float, final: float, trace: Trace, near: int) -> float:
    """Put the branch of a rim whose phase no double resolves into the trace, by the envelopes; return its wave.

    Beyond the end of the folds at wave `final` it is the last one, which has no end.
    """
    b, g, _ = curve
    place = min(rim, final)
    z = TWO_PI * place
    pull, chi = z * amplitude_power(table, z), g * table.amplitude
    trace[START, near], trace[START_DEPTH, near] = place, 0.5 * b * z * z - (1.0 + chi) * pull + g
    trace[END, near], trace[END_DEPTH, near] = math.inf, 0.5 * b * z * z - (1.0 - chi) * pull + g
    if rim > final:
        trace[END_DEPTH, near] = math.inf
    trace[UNLOADING_JUMPS, near] = UNKNOWN
    return np.floor(place - table.phase / TWO_PI)
