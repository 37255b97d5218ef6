"""Where the folds and troughs of one cosine wave on a paraboloid can stand."""

import math
from typing import TYPE_CHECKING

from flint import arb

if TYPE_CHECKING:
    from gradhesion.twin.curve import Curve


def window(curve: "Curve", c: arb) -> tuple[arb, arb]:
    """Phases z0 < z1 with no zero of the tilt below z0 or above z1.

    Below: |V| <= V(0) = 2/(1+k), so the tilt is negative while (b + g V(0)) z^p < c. Above: with alpha = (k-1)/2,
    |V| <= 2/z^2 + 2^alpha G(1+alpha) z^(-1-alpha) (1 + (2+alpha)/z) from steepest descent, and the tilt is positive.
    """
    b, p = 2 / (1 + float(curve.k)), (3 + float(curve.k)) / 2
    alpha, g, level = (float(curve.k) - 1) / 2, float(curve.waviness), float(c)
    low = 0.999 * (level / (b * (1 + g))) ** (1 / p)
    amplitude = 2**alpha * math.gamma(1 + alpha)
    high = max(low, 1.0)
    while b <= 1.001 * (
        g * (2 / high**2 + amplitude * high ** (-1 - alpha) * (1 + (2 + alpha) / high)) + level * high**-p
    ):
        high *= 1.01
    return arb(low), arb(high)


def grid(curve: "Curve", c: arb, end: arb | None) -> list[arb]:
    """Return the window of the zeros up to `end`, cut where the Taylor polynomials of S0 change."""
    low, high = window(curve, c)
    if end is not None and end < high:
        high = end
    edges = [low]
    edges += [arb(2 * j + 1) / 4 for j in range(math.floor(2 * float(low)), math.ceil(2 * float(high)) + 1)]
    return [low, *(e for e in edges if low < e < high), high] if low < high else []
