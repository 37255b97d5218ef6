"""The power x^p of floats of any size, as plain arithmetic: a loop of it becomes vector operations, 1-3 ns each.

With x = 2^e m, m from sqrt(1/2) to sqrt(2), and s = (m - 1)/(m + 1)

    log2 x = e + 2/ln 2 (s + s^3/3 + ...)

in two parts, s and its product with 2/ln 2 being rounded on the way: the exponent multiplies what is left, which is
2^-58. The product with p, in two parts too, is a whole number n and the rest f, |f| <= 1/2, and x^p = 2^n 2^f.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.intrinsics import bits_of, float_of, fma
from gradhesion.core.types import Floats

_ROOT_HALF: Final = 0x3FE6A09E667F3BCD
"""The bits of sqrt(1/2)."""
_EXPONENT: Final = -(1 << 52)
"""The bits of sign and exponent."""
_ONE: Final = 1023
"""What is added to an exponent."""
_WHOLE: Final = 1.5 * 2.0**52
_BITS_OF_WHOLE: Final = 0x4338000000000000
"""Added to a float it leaves the nearest whole number in the last bits; added to one as bits it makes that a float."""
_SMALLEST: Final = 2.0**-1022
_UP: Final = 54.0
"""By this power of 2 what is smaller is multiplied first."""
_BEYOND: Final = 2044.0
"""A power of 2 that overflows, and with minus underflows, while half of it does not."""
_SCALE: Final = 2.8853900817779268
_SCALE_REST: Final = 4.0710547481862066e-17
"""2/ln 2 in two parts."""
_L0: Final = 0.961796693925976
_L1: Final = 0.5770780163541355
_L2: Final = 0.412198583898078
_L3: Final = 0.32059873801756367
_L4: Final = 0.2623236397004895
_L5: Final = 0.221189987214124
_L6: Final = 0.21087079476015172
"""(2/ln 2) (atanh(s)/s - 1)/s^2 in s^2, through the Chebyshev nodes of its range, to 5e-16."""
_E0: Final = 0.6931471805599453
_E1: Final = 0.24022650695910097
_E2: Final = 0.0555041086648216
_E3: Final = 0.009618129107606888
_E4: Final = 0.0013333558146416936
_E5: Final = 0.0001540353044173605
_E6: Final = 1.525273382983612e-05
_E7: Final = 1.321544258792169e-06
_E8: Final = 1.0178062445845774e-07
_E9: Final = 7.072585949269223e-09
_E10: Final = 4.4549605981865186e-10
"""(2^f - 1)/f in f, in the same way, to 1.3e-17."""


@kernel(inline=True)
def _power(x: float, p: float) -> float:
    """Return x^p, as `power`."""
    tiny = x < _SMALLEST
    bits = bits_of(x * 2.0**_UP if tiny else x)
    above = bits - _ROOT_HALF
    e = float_of((above >> 52) + _BITS_OF_WHOLE) - (_WHOLE + _UP if tiny else _WHOLE)
    m = float_of(bits - (above & _EXPONENT))
    up, down = m + 1.0, m - 1.0
    up_rest = 1.0 - (up - m)
    inverse = 1.0 / up
    s = down * inverse
    s_rest = (fma(-s, up, down) - s * up_rest) * inverse
    s2 = s * s
    s4 = s2 * s2
    tail = fma(s4, fma(s4, fma(s4, _L6, fma(s2, _L5, _L4)), fma(s2, _L3, _L2)), fma(s2, _L1, _L0))
    high = s * _SCALE
    low = fma(s, _SCALE, -high) + fma(s, _SCALE_REST, s_rest * _SCALE) + s * s2 * tail
    logarithm = e + high
    rest = (high - (logarithm - e)) + low
    y = p * logarithm
    y_rest = fma(p, logarithm, -y) + p * rest
    y = min(max(y, -_BEYOND), _BEYOND)
    shifted = y + _WHOLE
    f = (y - (shifted - _WHOLE)) + y_rest
    f2 = f * f
    f4 = f2 * f2
    series = fma(f2, fma(f, _E3, _E2), fma(f, _E1, _E0))
    middle = fma(f2, fma(f, _E7, _E6), fma(f, _E5, _E4))
    series = fma(f4, fma(f4, fma(f2, _E10, fma(f, _E9, _E8)), middle), series)
    n = bits_of(shifted) - _BITS_OF_WHOLE
    half = n >> 1
    value = fma(f, series, 1.0) * float_of((half + _ONE) << 52) * float_of((n - half + _ONE) << 52)
    return value if 0.0 < x < math.inf or p == 0.0 else x


@kernel()
def power(x: float, p: float) -> float:
    """Return x^p for x >= 0 and 0 <= p <= 4, within 0.9 eps; a result below 2^-1022 within a unit of the last place.

    NaN stays NaN, and x^0 is 1 for all other x.
    """
    return _power(x, p)


@kernel()
def fill_powers(count: int, x: Floats, p: Floats, found: Floats) -> None:
    """Put the first `count` of x^p into `found`, each as `power` has it, in vector operations; all of shape (n,)."""
    for i in range(count):
        found[i] = _power(x[i], p[i])
