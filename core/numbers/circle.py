"""Sine and cosine of 2 pi x, exact in the phase at any x.

The sine of a rounded 2 pi x is wrong by 1e-14 at x = 10 and by 1e-9 at x = 1e6. Here x is reduced to the nearest
quarter turn first, which is exact in floating point.
"""

from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.intrinsics import ROUND, fma, turned, zero_from

TWO_PI: Final = 6.283185307179586
TWO_PI_LOW: Final = 2.4492935982947064e-16
"""2 pi = TWO_PI + TWO_PI_LOW to 33 digits."""
_PHASELESS: Final = 2.0**49


@kernel(contract=True)
def _sine_cosine(r: float) -> tuple[float, float]:
    """Return sin r and cos r for |r| <= pi/4 (polynomials of least maximal error, 0.6 ulp)."""
    u = r * r
    s = 1.591810123027412e-10 * u - 2.5051131455427946e-08
    s = s * u + 2.755731610068303e-06
    s = s * u - 0.0001984126983674977
    s = s * u + 0.008333333333330946
    s = s * u - 0.16666666666666666
    c = -1.1382614868556325e-11 * u + 2.0876146024689747e-09
    c = c * u - 2.7557317270560326e-07
    c = c * u + 2.4801587298763433e-05
    c = c * u - 0.0013888888888887395
    c = c * u + 0.041666666666666664
    return r + r * u * s, 1.0 - (0.5 * u - u * u * c)


@kernel(contract=True)
def sine_cosine_of_turns(x: float) -> tuple[float, float]:
    """Return sin(2 pi x) and cos(2 pi x) for 0 <= x < 2^49; beyond, x resolves no phase, and 0 is used.

    x is a number or eight (lanes.py).
    """
    x = zero_from(x, _PHASELESS)
    quarters = 4.0 * x + ROUND
    rest = fma(quarters - ROUND, -0.25, x)  # exact
    s, c = _sine_cosine(fma(rest, TWO_PI_LOW, rest * TWO_PI))
    return turned(s, c, quarters)
