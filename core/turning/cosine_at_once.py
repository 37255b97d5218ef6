"""Where loading of one cosine first reaches eight depths among the regular waves of a long curve, found at once.

The upper envelope of the curve puts each depth on a wave, or next to one; the ends of this and of its neighbour show on
which branch loading reaches it. What takes longer is left to turning/first_reached.py, each lane for itself.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.at_once import find_depths
from gradhesion.core.curve.cosine import Cosine, slopes_at_once
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import Lanes, any_above, chosen, eight, floor_of, root_of, size_of
from gradhesion.core.struve.power import amplitude_powers
from gradhesion.core.types import Table
from gradhesion.core.waves.cosine_at_once import folds_at_once

_ENVELOPE_STEPS: Final = 4
_STEPS: Final = 3
SURE: Final = 1e-8
"""The last step of Newton's method, in curvature lengths: what is left is its square."""


@kernel(contract=True)
def turns_at_once(table: Table, curve: Cosine, targets: Lanes) -> tuple[Lanes, Lanes, Lanes, Lanes, Lanes]:
    """Return where the curve first rises through eight depths, NaN where that takes longer.

    Then come the wave on whose branch that is, the place and the depth of the end of this branch, and the depth at
    which the branch before ends.
    """
    b, g, _ = curve
    level = 0.5 * (1.0 - table.k)
    stretch = 1.0 - g * table.amplitude
    excess = (2.0 / b) * (targets - g)
    z = root_of(chosen(0.0, excess, excess, 0.0)) + (2.0 * max(stretch, 0.0) / b) ** (2.0 / (3.0 + table.k))
    for _ in range(_ENVELOPE_STEPS):
        pull = stretch * z * amplitude_powers(table, z)
        z = z - (0.5 * b * z * z - pull + (g - targets)) / (b * z - level * pull / z)
    middle = floor_of((z - table.phase) / TWO_PI)
    end, top = folds_at_once(table, curve, middle, eight(-1.0))
    below = chosen(top, targets, 1.0, 0.0)
    wave = middle + below
    other_end, other_top = folds_at_once(table, curve, middle + (2.0 * below - 1.0), eight(-1.0))
    before = chosen(1.0, below, top, other_top)
    end, top = chosen(1.0, below, other_end, end), chosen(1.0, below, other_top, top)
    start, low = folds_at_once(table, curve, wave, eight(1.0))
    x = find_depths(table, curve, targets, start, low, end, top)
    found = eight(math.nan)
    for _ in range(_STEPS):
        d, d1, _, _, here = slopes_at_once(table, curve, level, x)
        step = (targets - here) / d
        x = x + step / TWO_PI
        sure = chosen(size_of(step) * (size_of(d1) + size_of(d)), SURE * size_of(d), x, math.nan)
        found = chosen(found, found, found, chosen(start, sure, chosen(sure, end, sure, math.nan), math.nan))
        if not any_above(found, math.inf):
            break
    found = chosen(before, targets, chosen(targets, top, found, math.nan), math.nan)
    return found, wave, end, top, before
