"""How far out, and how far in, a depth or a load can be met: bounds by the envelopes of the curve of one cosine.

With chi = g C both hold at every z:

    depth >= b z^2/2 - (1 + chi) z^c
    -(1 + 1.06 chi) z^c <= load/z^(1+k) - b z^2/(3+k) <= -(1 - chi) z^c
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import LARGEST
from gradhesion.core.types import Table

_WIDE: Final = 1.06
"""The most by which the waves of the load exceed chi z^c downwards."""


@kernel(contract=True)
def _envelope(k: float, b: float, pull: float, z: float, by_load: bool) -> float:
    """Return b z^2/2 - pull z^c, or that of the load."""
    power = z ** (0.5 * (1.0 - k))
    if by_load:
        return z ** (1.0 + k) * (b * z * z / (3.0 + k) - pull * power)
    return 0.5 * b * z * z - pull * power


@kernel()
def reach(k: float, b: float, pull: float, target: float, by_load: bool, outwards: bool) -> float:
    """Return x where an envelope rises through a target >= 0, rounded outwards or inwards by some percent at most."""
    near = (target * (3.0 + k) / b) ** (1.0 / (3.0 + k)) if by_load else math.sqrt(2.0 * target / b)
    _, power = math.frexp(near)
    low, high = 0.0, math.ldexp(1.0, power)  # a power of two, whichever this is
    while _envelope(k, b, pull, high, by_load) <= target:
        low, high = high, 2.0 * high
        if high > LARGEST:
            return math.inf
    while low == 0.0:
        if _envelope(k, b, pull, 0.5 * high, by_load) <= target:
            low = 0.5 * high
        elif high < 1.0 / LARGEST:
            return 0.0
        else:
            high *= 0.5
    for _ in range(6):
        middle = 0.5 * (low + high)
        if _envelope(k, b, pull, middle, by_load) <= target:
            low = middle
        else:
            high = middle
    return (high if outwards else low) / TWO_PI


@kernel()
def reach_outwards(table: Table, curve: Cosine, target: float, by_load: bool) -> float:
    """Return x beyond which the depth (or the load) exceeds a target."""
    b, g, _ = curve
    chi = g * table.amplitude
    return reach(table.k, b, 1.0 + (_WIDE * chi if by_load else chi), target, by_load, YES)
