"""Does a punch touch first at its centre? Before the first jump, from zero contact, the gap is the profile itself.

    f(r) = B z^m/(m front) + g sum_n [cos_n (1 - cos 2 pi n x) + sin_n sin 2 pi n x]     in the units of depth

must not be negative up to the radius where this jump lands. From one wavelength to the next only the power grows, so
that the first is enough. A cosine of positive amplitude is never negative; sines, and cosines of negative
amplitude, may be.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.face import punch_of
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.types import Harmonics

_EPS: Final = 2.0**-52
_ROUNDING: Final = 8.0
"""Error of the sum over the waves in units of the last place."""
_MOST_STEPS: Final = 100_000_000
"""More than any series needs: some ten steps for each of its shortest waves."""


@kernel()
def front_at(k: float, m: float) -> float:
    """Return G(m/2) G(n)/(2 G(n + m/2)), by which the power presses in."""
    n = 0.5 * (1.0 + k)
    return 0.5 * math.exp(math.lgamma(0.5 * m) + math.lgamma(n) - math.lgamma(n + 0.5 * m))


@kernel()
def _waves(series: Harmonics, x: float) -> float:
    """Return the sum over the waves at x, small ones to all their digits near x = 0."""
    total = 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        half = math.sin(0.5 * TWO_PI * n * x)
        total += 2.0 * series[i, 1] * half * half
        if series[i, 2] != 0.0:
            total += series[i, 2] * math.sin(TWO_PI * n * x)
    return total


@kernel()
def profile_at(basis: Basis, curve: Series, x: float) -> float:
    """Return f at x."""
    _, series, g = punch_of(basis, curve)
    B, m, _, _, _ = curve
    return B / (m * front_at(basis.table.k, m)) * (TWO_PI * x) ** m + g * _waves(series, x)


@kernel()
def touches_at_centre(basis: Basis, curve: Series, end: float) -> bool:
    """Return whether the profile is nowhere below 0 up to the radius x = `end`.

    A step h is safe if the chord of the waves and the tangent of the power, which is convex, together exceed what the
    waves can sag below their chord, h^2/8 of the bound of their curvature. Else it is halved; the last digits of the
    waves are left open.
    """
    _, series, g = punch_of(basis, curve)
    B, m, _, _, _ = curve
    slope, curvature, negative = 0.0, 0.0, False
    for i in range(series.shape[0]):
        n = TWO_PI * series[i, 0]
        slope += n * series[i, 2]
        curvature += n * n * math.hypot(series[i, 1], series[i, 2])
        negative = negative or series[i, 1] < 0.0 or series[i, 2] != 0.0
    if not negative or g == 0.0:
        return True
    bend = B / (m * front_at(basis.table.k, m))
    if g * slope + (TWO_PI * bend if m == 1.0 else 0.0) < 0.0:  # it falls from the centre on
        return False
    end = min(end, 1.0)
    rounding = 0.0
    for i in range(series.shape[0]):
        n = TWO_PI * series[i, 0]
        rounding += _ROUNDING * _EPS * g * min(1.0 + n, n * end) * math.hypot(series[i, 1], series[i, 2])
    x, here = 0.0, 0.0
    step = end
    for _ in range(_MOST_STEPS):
        if x >= end:
            return True
        there = min(end, x + step)
        next_one = g * _waves(series, there)
        if bend * (TWO_PI * there) ** m + next_one < -rounding:
            return False
        width = there - x
        sag = 0.125 * g * curvature * width * width
        power = bend * (TWO_PI * x) ** m
        rise = m * power / x * width if x > 0.0 else 0.0
        if power + min(here, rise + next_one) >= sag - rounding:
            x, here = there, next_one
            step = 2.0 * width
        else:
            step = 0.5 * width
    return True
