"""The power z^(-(1+k)/2), the amplitude of every oscillating term, in 3 ns.

z = 2^e m with 1 <= m < 2: a stored power of 2^e times a polynomial in m. The product k e is kept in two parts, else
rounding it would cost |k e ln 2| units in the last place.
"""

import math
from typing import Any, Final

from gradhesion.core._jit import kernel
from gradhesion.core.struve.intrinsics import bits_of, float_of, fma
from gradhesion.core.struve.lanes import LANES, Lanes, lane_of, with_lane
from gradhesion.core.struve.layout import EXPONENT_SPAN, MANTISSA_BITS, POWER_TERMS

_MANTISSA: Final = (1 << 52) - 1
_ONE: Final = 0x3FF0000000000000
_LN2: Final = math.log(2.0)
_ROOT_HALF: Final = math.sqrt(0.5)


@kernel()
def build_power(k: float, mantissa: Any, exponent: Any) -> None:
    """Fill the two tables (layout.py)."""
    power = -0.5 * (1.0 + k)
    slices = mantissa.shape[0]
    taylor = [0.0] * 10
    for i in range(slices):
        centre = 1.0 + (i + 0.5) / slices
        ratio = 0.5 / slices / centre
        scale = centre ** (-0.5 * k) / math.sqrt(centre)
        term = 1.0
        for n in range(10):
            taylor[n] = term
            term *= (power - n) / (n + 1.0) * ratio
        # t^9, t^8 and t^7 are below 1e-17 and are cut through T9, T8 (Chebyshev economisation down to degree 6)
        rest = taylor[9] / 256.0
        taylor[7] += 576.0 * rest
        taylor[5] -= 432.0 * rest
        taylor[3] += 120.0 * rest
        taylor[1] -= 9.0 * rest
        rest = taylor[8] / 128.0
        taylor[6] += 256.0 * rest
        taylor[4] -= 160.0 * rest
        taylor[2] += 32.0 * rest
        taylor[0] -= rest
        rest = taylor[7] / 64.0
        taylor[5] += 112.0 * rest
        taylor[3] -= 56.0 * rest
        taylor[1] += 7.0 * rest
        for n in range(POWER_TERMS):
            mantissa[i, n] = scale * taylor[n]
    for i in range(exponent.size):
        e = i - EXPONENT_SPAN
        high = -0.5 * k * e
        low = fma(-0.5 * k, float(e), -high)
        halves = 2.0 ** (-(e // 2)) * (1.0 if e % 2 == 0 else _ROOT_HALF)
        exponent[i] = 2.0**high * (1.0 + low * _LN2) * halves


@kernel(contract=True)
def amplitude_power(table: Any, z: float) -> float:
    """Return z^(-(1+k)/2) for 2^-512 <= z < 2^512."""
    bits = bits_of(z)
    c = table.power_mantissa[(bits >> (52 - MANTISSA_BITS)) & ((1 << MANTISSA_BITS) - 1)]
    t = 2.0 * float_of(((bits << MANTISSA_BITS) & _MANTISSA) | _ONE) - 3.0
    t2 = t * t
    value = (c[0] + c[1] * t) + t2 * ((c[2] + c[3] * t) + t2 * ((c[4] + c[5] * t) + t2 * c[6]))
    return value * table.power_exponent[(bits >> 52) - 1023 + EXPONENT_SPAN]


@kernel()
def amplitude_powers(table: Any, z: Lanes) -> Lanes:
    """Return the powers of eight z."""
    powers = z
    for lane in range(LANES):
        powers = with_lane(powers, lane, amplitude_power(table, lane_of(z, lane)))
    return powers
