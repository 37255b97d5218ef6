"""Folds and landing radii beyond z = 40, eight at a time.

They are found as in cosine_folds.py and branches.py, each independently of the other seven. Out there the first guesses
are so good that one step is the rule.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, slopes_at_once
from gradhesion.core.curve.cosine_folds import LAST_STEP_OF_DEPTH, half_wave
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import Lanes, any_above, chosen, eight, floor_of, size_of
from gradhesion.core.struve.power import amplitude_powers
from gradhesion.core.types import Table

_STEPS: Final = 3
_LAST_STEP_OF_LANDING: Final = 1e-2
"""As that of branches.py."""


@kernel(contract=True)
def guess_zeros(table: Table, curve: Cosine, level: float, arches: Lanes, signs: Lanes) -> Lanes:
    """Return what `guess_zero` does for eight folds; `signs` is 1 where D rises, else -1.

    The slow part is expanded about the summits.
    """
    b, g, lag = curve
    k = table.k
    n = 0.5 * (1.0 + k)
    sign = 1.0 - 2.0 * (arches - 2.0 * floor_of(0.5 * arches))  # of the wave at its summit
    centre = table.phase + arches * math.pi + TWO_PI * lag
    slow, inverse = b / amplitude_powers(table, centre), 1.0 / centre
    pull = 1.0 / (g * table.amplitude)
    shift = 0.5 * (1.0 - k) + 0.125 * (1.0 - k * k)
    z = centre
    for _ in range(2):
        away = (z - centre) * inverse
        rise = slow * (1.0 + n * away * (1.0 + 0.5 * (n - 1.0) * away * (1.0 + (n - 2.0) / 3.0 * away)))
        over = 1.0 / z
        cosine = sign * (level * over - rise) * pull
        share = 0.5 - 0.5 * chosen(cosine, -1.0, -1.0, chosen(1.0, cosine, 1.0, cosine))
        z = centre + shift * over - sign * signs * (math.pi * half_wave(share))
    return z / TWO_PI


@kernel(contract=True)
def find_zeros(
    table: Table, curve: Cosine, level: float, lows: Lanes, highs: Lanes, guesses: Lanes
) -> tuple[Lanes, Lanes]:
    """Return what `find_zero` does for eight folds beyond z = 40, NaN where that takes longer.

    Each stands alone between `lows` and `highs`.
    """
    x = chosen(lows, guesses, chosen(guesses, highs, guesses, highs), lows)
    found, depths = eight(math.nan), eight(math.nan)
    for _ in range(_STEPS):
        d, d1, d2, d3, depth = slopes_at_once(table, curve, level, x)
        square = d1 * d1
        step = d * (0.5 * d * d2 - square) / (d1 * (square - d * d2) + d * d * d3 * (1.0 / 6.0))
        x = x + step / TWO_PI
        size = size_of(d1)
        new = chosen(size_of(step) * (size_of(d2) + size), LAST_STEP_OF_DEPTH * size, x, math.nan)
        new = chosen(lows, new, chosen(new, highs, new, math.nan), math.nan)
        there = depth + step * (d + step * (0.5 * d1 + step * (d2 * (1.0 / 6.0) + step * d3 * (1.0 / 24.0))))
        depths = chosen(found, found, depths, chosen(new, new, there, math.nan))
        found = chosen(found, found, found, new)
        if not any_above(found, math.inf):
            break
    return found, depths


@kernel(contract=True)
def find_depths(
    table: Table, curve: Cosine, target: Lanes, low: Lanes, low_depth: Lanes, high: Lanes, high_depth: Lanes
) -> Lanes:
    """Return what `find_depth` does for eight branches beyond z = 40 that end, NaN where that takes longer."""
    level = 0.5 * (1.0 - table.k)
    share = (target - low_depth) / (high_depth - low_depth)
    x = low + (high - low) * half_wave(share)
    found = eight(math.nan)
    for _ in range(_STEPS):
        d, d1, d2, _, depth = slopes_at_once(table, curve, level, x)
        rest = depth - target
        square, bend = d * d, rest * d1
        step = (rest * (0.5 * bend - square)) / (d * (square - bend) + rest * rest * d2 * (1.0 / 6.0))
        x = x + step / TWO_PI
        near = chosen(size_of(step) * (size_of(d1) + size_of(d)), _LAST_STEP_OF_LANDING * size_of(d), x, math.nan)
        found = chosen(found, found, found, chosen(low, near, chosen(near, high, near, math.nan), math.nan))
        if not any_above(found, math.inf):
            break
    return found
