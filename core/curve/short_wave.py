"""The leading asymptotic form of a short wave, lambda << a: its curve, folds and pull-off.

In the units of curve/cosine.py, with z = 2 pi a/lambda, c = (1-k)/2, n = (1+k)/2, phi = (1+k) pi/4, X = z^((3+k)/2) and
chi = r/s, (5.15)-(5.20) of Jin, Guo & Wan (2013) become

    depth = b z^2/2 + g - z^c [1 - chi sin(z - phi)]
    load  = X { b X/(3+k) - 1 + chi sin(z - phi) }

The term g is the mean height of the wave, which the printed form drops; the load has none to this order. The error is
of the order lambda/a, and nothing is claimed where the contact is no larger than a wave. At k = 1 the depth is exact.

Both slopes vanish where F = 0, at the levels c and (3+k)/2 of curve/cosine.py:

    F(z) = chi cos theta - u,   theta = z - phi - atan(level/z),   u = (level - b z^(1+n))/sqrt(z^2 + level^2)

u falls steadily, so that folds stand only where |u| <= chi, and where cos theta rises F rises through zero once at
most. Half wave i has theta between (i-1) pi and i pi: cos theta rises if i is even.
"""

import math
from typing import NamedTuple

import numpy as np

from gradhesion.core.closed.envelope import envelope_force
from gradhesion.core.closed.smooth import FORCE_SCALE
from gradhesion.core.compiler.jit import kernel


class ShortWave(NamedTuple):
    """The leading form of a short wave under displacement control: k, b, chi, g and phi; its places are z, not x."""

    k: float
    bend: float
    chi: float
    gain: float
    phase: float


MOST_HALVES = 2**18
"""Half waves that are walked at most: the energy of more, which is that of the envelopes to 1e-5, has no value."""
FURTHEST = 1e12
"""z beyond which a double no longer tells the phase well."""
_STEPS = 100


@kernel()
def depth(wave: ShortWave, z: float) -> float:
    """Return the reduced depth."""
    k, b, chi, g, phi = wave
    return 0.5 * b * z * z + g - z ** (0.5 * (1.0 - k)) * (1.0 - chi * math.sin(z - phi))


@kernel()
def load(wave: ShortWave, z: float) -> float:
    """Return the reduced load."""
    k, b, chi, _, phi = wave
    abscissa = z ** (0.5 * (3.0 + k))
    return abscissa * (b * abscissa / (3.0 + k) - 1.0 + chi * math.sin(z - phi))


@kernel()
def _slow_part(wave: ShortWave, level: float, z: float) -> float:
    """Return u."""
    k, b, _, _, _ = wave
    return (level - b * z ** (0.5 * (3.0 + k))) / math.hypot(z, level)


@kernel()
def _fold_function(wave: ShortWave, level: float, z: float) -> tuple[float, float]:
    """Return F and its slope at z > 0."""
    k, b, chi, _, phi = wave
    square = z * z + level * level
    root = math.sqrt(square)
    theta = z - phi - math.atan2(level, z)
    power = b * z ** (0.5 * (1.0 + k))
    u = (level - power * z) / root
    u_slope = -0.5 * (3.0 + k) * power / root - u * z / square
    return chi * math.cos(theta) - u, -chi * math.sin(theta) * (1.0 + level / square) - u_slope


@kernel()
def depth_slope(wave: ShortWave, z: float) -> float:
    """Return d depth/dz."""
    k = wave.k
    level = 0.5 * (1.0 - k)
    value, _ = _fold_function(wave, level, z)
    return value * math.hypot(z, level) / z ** (0.5 * (1.0 + k))


@kernel()
def half_at(wave: ShortWave, level: float, z: float) -> float:
    """Return the half wave in which z lies."""
    return max(0.0, np.floor((z - wave.phase - math.atan2(level, z)) / math.pi) + 1.0)


@kernel()
def outer_edge(wave: ShortWave, level: float, i: float) -> float:
    """Return where half wave i ends: z - atan(level/z) = phi + i pi (Newton)."""
    place = wave.phase + i * math.pi
    if i < 0.0:
        return 0.0
    z = place + math.atan2(level, place + 0.5)
    for _ in range(3):
        z -= (z - place - math.atan2(level, z)) / (1.0 + level / (z * z + level * level))
    return z


@kernel()
def window_end(wave: ShortWave, level: float, target: float) -> float:
    """Return about where u falls to a target."""
    low, high = 0.0, 1.0
    while _slow_part(wave, level, high) > target and high < FURTHEST:
        low, high = high, 2.0 * high
    while high - low > 0.1:
        middle = 0.5 * (low + high)
        if _slow_part(wave, level, middle) > target:
            low = middle
        else:
            high = middle
    return high


@kernel()
def _find_zero(wave: ShortWave, level: float, low: float, high: float, rising: bool) -> float:
    """Return the zero of F between low and high (Newton, kept in the bracket)."""
    _, _, chi, _, phi = wave
    middle = 0.5 * (low + high)
    # where the cosine of the middle's half wave takes the value that the slow part has there
    theta = middle - phi - math.atan2(level, middle)
    half = np.floor(theta / math.pi)
    angle = math.acos(max(-1.0, min(1.0, _slow_part(wave, level, middle) / chi)))
    z = middle - theta + (half * math.pi + angle if half % 2.0 == 0.0 else (half + 1.0) * math.pi - angle)
    for _ in range(_STEPS):
        if not low < z < high:
            z = 0.5 * (low + high)
            if z <= low or z >= high:
                break
        value, slope = _fold_function(wave, level, z)
        if (value < 0.0) == rising:
            low = z
        else:
            high = z
        step = value / slope
        z -= step
        if abs(step) < 1e-8 * min(1.0, z):
            break
    return z


@kernel()
def _find_extremum(wave: ShortWave, level: float, low: float, high: float) -> float:
    """Return where the slope of F changes sign (halving)."""
    _, first = _fold_function(wave, level, low)
    for _ in range(50):
        middle = 0.5 * (low + high)
        _, slope = _fold_function(wave, level, middle)
        if (slope > 0.0) == (first > 0.0):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel()
def folds_of_half(wave: ShortWave, level: float, i: float) -> tuple[int, float, float, bool]:
    """Return the number of zeros of F in half wave i, where they are, and if F rises through the first."""
    low, high = outer_edge(wave, level, i - 1.0), outer_edge(wave, level, i)
    first = -level  # the sign of F towards z = 0; at k = 1, level 0, it rises from zero
    if i > 0.0:
        first, _ = _fold_function(wave, level, low)
    last, _ = _fold_function(wave, level, high)
    rising = first < 0.0
    if rising != (last < 0.0):
        return 1, _find_zero(wave, level, low, high, rising), math.nan, rising
    if i % 2.0 == 0.0:
        return 0, math.nan, math.nan, rising
    # two where cos theta falls: next to the crest as the window begins, next to the trough as it ends
    middle = 0.5 * (low + high)
    peak = _find_extremum(wave, level, low, middle) if rising else _find_extremum(wave, level, middle, high)
    value, _ = _fold_function(wave, level, peak)
    if rising == (value < 0.0):
        return 0, math.nan, math.nan, rising
    inner, outer = _find_zero(wave, level, low, peak, rising), _find_zero(wave, level, peak, high, not rising)
    return 2, inner, outer, rising


@kernel()
def _floor(wave: ShortWave, z: float) -> float:
    """Return the parabola that touches the load from below."""
    k, b, chi, _, _ = wave
    abscissa = z ** (0.5 * (3.0 + k))
    return abscissa * (b * abscissa / (3.0 + k) - 1.0 - chi)


@kernel()
def lowest_load(wave: ShortWave, z_rim: float) -> tuple[float, float]:
    """Return the lowest reduced load over (0, z_rim] and the z where it is met; far out, those of the envelope."""
    k, b, chi, _, _ = wave
    level = 0.5 * (3.0 + k)
    z = (level * (1.0 + chi) / b) ** (1.0 / level)
    if min(z, z_rim) > FURTHEST:
        shrink = (1.0 / b) ** (1.0 / level)  # to the length at which b = 1
        force, place = envelope_force(k, chi, z_rim / shrink)
        return -force / (FORCE_SCALE * b), place * shrink
    best, best_z = 0.0, 0.0
    if z_rim < math.inf:
        best, best_z = load(wave, z_rim), z_rim
    start = half_at(wave, level, min(z, z_rim))
    for outwards in (True, False):
        i = start if outwards else start - 1.0
        while 0.0 <= i < start + MOST_HALVES:
            edge = outer_edge(wave, level, i - 1.0 if outwards else i)
            if edge >= z_rim or (i != start and _floor(wave, edge) >= best):
                break
            count, inner, outer, rising = folds_of_half(wave, level, i)
            place = inner if rising else outer
            if count > 0 and place < z_rim:
                value = load(wave, place)
                if value < best:
                    best, best_z = value, place
            i += 1.0 if outwards else -1.0
    return best, best_z


@kernel()
def find_depth(wave: ShortWave, target: float, low: float, high: float) -> float:
    """Return where the branch between low and high meets a depth, low if it is nowhere so deep."""
    if depth(wave, low) >= target:
        return low
    if high == math.inf:
        step = 1.0
        high = low + step
        while depth(wave, high) <= target:
            low = high
            step *= 2.0
            high += step
    z = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = depth(wave, z) - target
        if rest < 0.0:
            low = z
        else:
            high = z
        new = z - rest / depth_slope(wave, z)
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                break
        if abs(new - z) < 1e-9 * min(1.0, z):
            return new
        z = new
    return z
