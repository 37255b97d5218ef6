"""The radii between which folds can lie, from bounds of the waves.

With C the amplitude of z^n S0 and h_n = |cos_n + i sin_n|, for every k (a scan)

    |cos V_S(y) + sin V_T(y)| <= h C y^c (1 + 0.35/y^2)         and, for y small, h T0(0) (1 + y)

so that D > 0 wherever, and D < 0 wherever the level is larger than what is left of it here,

    m B z^(m-1+n) > q + g C sum h_n n^(1+c) (z + 0.35/(n^2 z))
"""

import math

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.harmonics.cosine_bins import integral_at_zero
from gradhesion.core.types import Harmonics, Table

_EXCESS = 0.35
_INNERMOST = 1e-30
"""z where a search begins if depth rises from zero contact on (k = 1)."""
_WITHOUT_ADHESION = 1e-60
"""And where it begins if waves outweigh adhesion even there: a cone among them, or sines, and next to no adhesion."""
_PLACES = (1.0, 1e-1, 1e-2, 1e-4, 1e-8, 1e-16)
"""Where the search begins if the coordinate surely falls there, and so before."""
_BISECTIONS = 200
_CLOSE = 1.02
"""Ratio of a bound to the best one of its kind that is near enough: a search a little longer costs less than powers."""
_OUTERMOST = 1e250


@kernel()
def wave_bounds(table: Table, series: Harmonics, gain: float) -> tuple[float, float, float, float]:
    """Return the factors of z and 1/z far out, and those of z^n and z^(1+n) near zero contact."""
    c = 0.5 * (1.0 - table.k)
    far, correction, near, near_slope = 0.0, 0.0, 0.0, 0.0
    start = integral_at_zero(table.k)
    for i in range(series.shape[0]):
        n = series[i, 0]
        h = gain * math.hypot(series[i, 1], series[i, 2])
        far += table.amplitude * h * n ** (1.0 + c)
        correction += _EXCESS * table.amplitude * h * n ** (c - 1.0)
        near += start * h * n
        near_slope += start * h * n * n
    return far, correction, near, near_slope


@kernel()
def _surely_falls(
    level: float, push: float, s: float, n: float, bounds: tuple[float, float, float, float], z: float, far_out: bool
) -> bool:
    """Return whether D < 0 at z, by what `wave_bounds` says of the waves far out or near zero contact."""
    far, correction, near, near_slope = bounds
    waves = far * z + correction / z if far_out else z**n * (near + near_slope * z)
    return level > push * z**s + waves


@kernel()
def first_fold_bound(basis: Basis, curve: Series) -> float:
    """Return z before which the coordinate surely falls; where it need not, a z far below all others."""
    table, _, series = basis
    B, m, g, alpha, _ = curve
    k = table.k
    level = 0.5 * (1.0 - k) if alpha > 0.0 else 0.5 * (3.0 + k)
    n = 0.5 * (1.0 + k)
    s, push = m - 1.0 + n, m * B
    bounds = wave_bounds(table, series, g)
    low = _INNERMOST
    if not _surely_falls(level, push, s, n, bounds, low, NO):
        if not (level > 0.0 and _surely_falls(level, push, s, n, bounds, _WITHOUT_ADHESION, NO)):
            return _INNERMOST
        low = _WITHOUT_ADHESION
    for place in _PLACES:
        if _surely_falls(level, push, s, n, bounds, place, NO):
            low = place
            break
    for far_out in (False, True):  # both right sides grow, the second from z = 1 on
        if far_out and (low < 1.0 or not _surely_falls(level, push, s, n, bounds, low, YES)):
            break
        high = 2.0 * low
        while high < _OUTERMOST and _surely_falls(level, push, s, n, bounds, high, far_out):
            low, high = high, high * high if high > 2.0 else 2.0 * high
        for _ in range(_BISECTIONS):
            middle = math.sqrt(low) * math.sqrt(high)
            if not _CLOSE * low < middle < high:
                break
            if _surely_falls(level, push, s, n, bounds, middle, far_out):
                low = middle
            else:
                high = middle
    return low


@kernel()
def last_fold_bound(basis: Basis, curve: Series) -> float:
    """Return z beyond which the coordinate surely rises; inf where folds need not end."""
    table, _, series = basis
    B, m, g, _, beta = curve
    k = table.k
    level = 0.5 * (1.0 - k) if beta == 0.0 else 0.5 * (3.0 + k)
    s, push = m - 1.0 + 0.5 * (1.0 + k), m * B
    far, correction, _, _ = wave_bounds(table, series, g)
    low = _INNERMOST
    if far > 0.0:
        if s > 1.0:
            start = math.log(far / push) / (s - 1.0)  # from there on the left side less the right one rises
            if start > math.log(_OUTERMOST):
                return math.inf
            low = max(low, math.exp(start))
        elif not (s == 1.0 and push > far):
            return math.inf
    high = 2.0 * low
    while not push * high**s > level + far * high + correction / high:
        low, high = high, high * high if high > 2.0 else 2.0 * high
        if high > _OUTERMOST:
            return math.inf
    for _ in range(_BISECTIONS):
        middle = math.sqrt(low) * math.sqrt(high)
        if not low < middle < high / _CLOSE:
            break
        if push * middle**s > level + far * middle + correction / middle:
            high = middle
        else:
            low = middle
    return high
