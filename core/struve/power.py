"""The power z^(-(1+k)/2), the amplitude of every oscillating term, in 3 ns.

z = 2^e m with 1 <= m < 2: a stored power of 2^e times a polynomial in m. The product k e is kept in two parts, else
rounding it would cost |k e ln 2| units in the last place.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.intrinsics import ROUND, bits_of, float_of, fma, parts_of, scaled
from gradhesion.core.numbers.lanes import Lanes
from gradhesion.core.struve.layout import EXPONENT_SPAN, MANTISSA_BITS, POWER_TERMS
from gradhesion.core.types import Floats, Table

_MANTISSA: Final = (1 << 52) - 1
_ONE: Final = 0x3FF0000000000000
_LN2: Final = math.log(2.0)
_ROOT_HALF: Final = math.sqrt(0.5)


@kernel()
def build_power(k: float, mantissa: Floats, exponent: Floats) -> None:
    """Fill the two tables, of shapes (2^MANTISSA_BITS, POWER_TERMS) and (2 EXPONENT_SPAN,)."""
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
def amplitude_power(table: Table, z: float) -> float:
    """Return z^(-(1+k)/2) for 2^-512 <= z < 2^512."""
    bits = bits_of(z)
    c = table.power_mantissa[(bits >> (52 - MANTISSA_BITS)) & ((1 << MANTISSA_BITS) - 1)]
    t = 2.0 * float_of(((bits << MANTISSA_BITS) & _MANTISSA) | _ONE) - 3.0
    t2 = t * t
    value = (c[0] + c[1] * t) + t2 * ((c[2] + c[3] * t) + t2 * ((c[4] + c[5] * t) + t2 * c[6]))
    return value * table.power_exponent[(bits >> 52) - 1023 + EXPONENT_SPAN]


@kernel(contract=True)
def _logarithms(m: Lanes) -> Lanes:
    """Return the logarithms of base 2 of eight numbers from sqrt(1/2) to sqrt(2): the error is 4e-17 of their size."""
    s = (m - 1.0) / (m + 1.0)
    u = s * s
    v = u * u
    low = (2.8853900817779268 + 0.9617966939259898 * u) + v * (0.5770780163455203 + 0.4121985858409005 * u)
    high = (0.32059853491395984 + 0.262334352504183 * u) + v * (0.2209130842311768 + 0.2136589569431927 * u)
    return s * (low + v * v * high)


@kernel(contract=True)
def _powers_of_two(r: Lanes) -> Lanes:
    """Return 2^r for eight r from -1/2 to 1/2: the error is 2e-17."""
    u = r * r
    v = u * u
    low = 0.24022650695910158 + 0.055504108664821625 * r + u * (0.009618129107587256 + 0.001333355814640647 * r)
    middle = 0.00015403530463724353 + 1.5252733841556773e-05 * r
    high = (
        1.3215432535912375e-06 + 1.0178057087733941e-07 * r + u * (7.074194297288521e-09 + 4.4558179083360645e-10 * r)
    )
    return 1.0 + (0.6931471805599453 * r + u * (low + v * (middle + u * high)))


@kernel()
def amplitude_powers(table: Table, z: Lanes) -> Lanes:
    """Return the powers of eight z, to two units in the last place, for 2^-512 <= z < 2^512.

    They come from polynomials of least maximal error, for logarithm and exponential: table look-ups of eight are slow.
    """
    m, e = parts_of(z)
    n = 0.5 * (1.0 + table.k)
    part = -n * _logarithms(m)
    whole = -n * e
    rounded = (whole + part) + ROUND
    r = ((whole - (rounded - ROUND)) + fma(-n, e, -whole)) + part
    return scaled(_powers_of_two(r), rounded)
