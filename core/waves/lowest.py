"""The lowest load of millions of waves.

The lowest trough of a wave is a smooth function of its number (waves/general.py), which falls up to one wave and rises
from it on: some waves in equal steps bracket that wave, bisection finds it, and its neighbours are compared one by
one.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import START
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.curve.general_branches import START_LEVEL
from gradhesion.core.pull_off.lowest_two import Lowest, lower
from gradhesion.core.waves.general import DOWN, Room, branches_of_wave, furthest_end

_SAMPLES: Final = 25
_NEIGHBOURS: Final = 2.0


@kernel()
def _trough(basis: Basis, curve: Series, cut: float, wave: float, work: Room) -> float:
    """Return the lowest trough of a wave, inf without any."""
    rows = work[2][0]
    _, level, _ = furthest_end(DOWN, rows, branches_of_wave(basis, curve, wave, cut, work, rows))
    return level


@kernel()
def lowest_of_waves(
    basis: Basis, curve: Series, cut: float, low: float, high: float, best: Lowest, work: Room
) -> tuple[bool, Lowest]:
    """Return the lowest trough of the whole waves `low` to `high`, and whether each has one.

    `curve` is that of controlled load.
    """
    places, values = np.empty(_SAMPLES), np.empty(_SAMPLES)
    middle = 0
    for i in range(_SAMPLES):
        places[i] = np.floor(low + (high - low) * (i / (_SAMPLES - 1.0)) + 0.5)
        values[i] = _trough(basis, curve, cut, places[i], work)
        if values[i] == math.inf:
            return False, best
        if values[i] < values[middle]:
            middle = i
    inner, outer = places[max(0, middle - 1)], places[min(_SAMPLES - 1, middle + 1)]
    while outer - inner > 1.0:
        wave = np.floor(0.5 * (inner + outer))
        if _trough(basis, curve, cut, wave, work) < _trough(basis, curve, cut, wave - 1.0, work):
            inner = wave
        else:
            outer = wave
    rows = work[2][0]
    wave = max(low, inner - _NEIGHBOURS)
    while wave <= min(high, outer + _NEIGHBOURS):
        count = branches_of_wave(basis, curve, wave, cut, work, rows)
        for i in range(count):
            best = lower(best, rows[START_LEVEL, i], wave + rows[START, i])
        wave += 1.0
    return True, best
