"""One wave far from zero contact: its folds, where a jump to its neighbour lands, and the energy of the jump.

A place is `whole` + x, in waves, and its phase comes from x alone. So `whole` may be any real number, of any size: what
belongs to a wave is a smooth function of its index, and no digit of the phase is lost at 10^14 waves. The centre of
wave w, where the cosine of the fold function is largest, stands at w + phi/2 pi.

A jump is found from differences alone: of the depth to that of the place that is left, each term's own. The depth
itself is larger than what a wave adds to it by the number of waves, and the adhesive stretch by 1/chi.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import LONG, panel_above
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.pair import pair_above
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table, Work

Left: TypeAlias = tuple[float, float, float]
"""z, z S0 and z^c at the place that a jump leaves."""
NEAREST: Final = 8.0
"""The innermost wave: z > 40 from the one before it on."""
FAR: Final = 4.0e6
"""Waves up to which a double resolves a place and its phase together well enough to sum a gap."""
_STEPS: Final = 100
LAST_STEP: Final = 1e-4
"""A cubically convergent step of this size leaves 1e-12, and the loss is stationary at a fold (cosine_folds.py)."""
LAST_LANDING: Final = 1e-3
"""The same of a landing (curve/branches.py)."""
WIDE: Final = 2.2
"""Half the width of a branch, in radians, from which on both its folds are found."""
_RATIO_TERMS: Final = 9
"""Terms of (1 + e)^c - 1 for |e| < 0.04, a wave over its place."""


@kernel(contract=True, inline=True)
def slope_of(
    table: Table, curve: Cosine, x: float, z: float, power: float
) -> tuple[float, float, float, float, float, float]:
    """Return what `slope_at` does from z and z^(-n), numbers or eight of them (numbers/lanes.py)."""
    b, g, _ = curve
    k = table.k
    n = 0.5 * (1.0 + k)
    s0, s1, d0, _ = pair_above(table, x, z, power)
    v = s0 + z * d0
    v1 = 2.0 * d0 + z * (s1 - s0)
    v2 = (1.0 - k) * s1 - (2.0 - k) * s0 - z * d0
    pull = 0.5 * (1.0 - k) * power
    bend = n * pull / z
    return b * z + g * v - pull, b + g * v1 + bend, g * v2 - (n + 1.0) * bend / z, z, z * s0, z * power


@kernel(contract=True)
def slope_at(table: Table, curve: Cosine, whole: float, x: float) -> tuple[float, float, float, float, float, float]:
    """Return D at the level of the depth, its first two derivatives with respect to z, z, z S0 and z^c."""
    z = TWO_PI * (whole + x)
    return slope_of(table, curve, x, z, amplitude_power(table, z))


@kernel(contract=True)
def _rise(table: Table, curve: Cosine, left: Left, step: float, z: float, wave: float) -> float:
    """Return the depth less that at the start of the jump, `step` waves further in; `wave` is z S0 here."""
    b, g, _ = curve
    z1, wave1, stretch1 = left
    c = 0.5 * (1.0 - table.k)
    e = TWO_PI * step / z1
    ratio = 1.0
    for j in range(_RATIO_TERMS, 0, -1):
        ratio = 1.0 + ratio * e * ((c - j) / (j + 1.0))
    return 0.5 * b * (z + z1) * (TWO_PI * step) + g * (wave - wave1) - stretch1 * (c * e * ratio)


@kernel(contract=True)
def _angle(table: Table, curve: Cosine, z: float) -> float:
    """Return the distance of a fold near z from the centre of its wave, in z: cos = (level/z - b z^n)/(g C)."""
    b, g, _ = curve
    cosine = (0.5 * (1.0 - table.k) / z - b / amplitude_power(table, z)) / (g * table.amplitude)
    return math.acos(max(-1.0, min(1.0, cosine)))


@kernel(contract=True)
def _fold_near(
    table: Table, curve: Cosine, whole: float, centre: float, rising: bool, guess: float
) -> tuple[float, float, float, float, float, float]:
    """Return x of the start (rising) or the end of the branch around a centre, from a guess (Halley, in a bracket).

    Then x, z, z S0 and z^c of the last place before it, and what the depth gains from there (curve/cosine_folds.py).
    """
    low, high = (centre - 0.5, centre) if rising else (centre, centre + 0.5)
    x = guess if low < guess < high else 0.5 * (low + high)
    for _ in range(_STEPS):
        d, d1, d2, z, wave, stretch = slope_at(table, curve, whole, x)
        if d == 0.0:
            break
        if (d < 0.0) == rising:
            low = x
        else:
            high = x
        step = -d * d1 / (d1 * d1 - 0.5 * d * d2)
        new = x + step / TWO_PI
        if abs(step) * (abs(d2) + abs(d1)) < LAST_STEP * abs(d1) and low <= new <= high:
            return new, x, z, wave, stretch, step * (d + step * (0.5 * d1 + step * d2 / 6.0))
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                break
        x = new
    _, _, _, z, wave, stretch = slope_at(table, curve, whole, x)
    return x, x, z, wave, stretch, 0.0


@kernel(contract=True)
def _fold(table: Table, curve: Cosine, whole: float, centre: float, rising: bool) -> float:
    """Return x of the start (rising) or the end of the branch around a centre."""
    k = table.k
    z = TWO_PI * (whole + centre)
    angle = _angle(table, curve, z)
    angle = _angle(table, curve, z - angle if rising else z + angle) / TWO_PI
    shift = (0.5 * (1.0 - k) + 0.125 * (1.0 - k * k)) / (TWO_PI * z)
    x, _, _, _, _, _ = _fold_near(table, curve, whole, centre, rising, centre + shift - (angle if rising else -angle))
    return x


@kernel(contract=True)
def _landing(table: Table, curve: Cosine, whole: float, left: Left, start: float, centre: float, rising: bool) -> float:
    """Return x where the branch around a centre meets the depth of the place that is left, x = start.

    The fold on the far side of the landing is found; the other one stands about at the other side of the centre. Where
    folds are about to end, landing is close to it, and it must be found; before that it only bounds the search, and is
    estimated: depth rises by g C z^c (2 sin u - 2 u cos u) between two folds at the angles -u and u.
    """
    _, g, _ = curve
    guess = start + (1.0 if start < centre else -1.0)
    far, x, z, wave, stretch, gain = _fold_near(table, curve, whole, centre, rising, guess)
    rest = _rise(table, curve, left, x - start, z, wave) + gain
    angle = TWO_PI * abs(far - centre)
    near = 2.0 * centre - far
    if angle > WIDE:
        near, x, z, wave, _, gain = _fold_near(table, curve, whole, centre, not rising, near)
        near_rest = _rise(table, curve, left, x - start, z, wave) + gain
    else:
        drop = 2.0 * g * table.amplitude * stretch * (math.sin(angle) - angle * math.cos(angle))
        near_rest = rest + (drop if rising else -drop)
    low, low_rest, high, high_rest = (far, rest, near, near_rest) if rising else (near, near_rest, far, rest)
    share = low_rest / (low_rest - high_rest)
    if not 0.0 < share < 1.0:
        return low if share <= 0.0 else high
    x = low + (high - low) * math.acos(1.0 - 2.0 * share) / math.pi
    x = x if low < x < high else 0.5 * (low + high)
    for _ in range(_STEPS):
        d, d1, _, z, wave, _ = slope_at(table, curve, whole, x)
        rest = _rise(table, curve, left, x - start, z, wave)
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        step = -rest * d / (d * d - 0.5 * rest * d1)
        x += step / TWO_PI
        # the loss is stationary at the place of landing: its error is the square of the remaining step
        if low <= x <= high and abs(step) * (abs(d1) + abs(d)) < LAST_LANDING * abs(d):
            return x
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def ends_of_jump(table: Table, curve: Cosine, whole: float, outwards: bool) -> tuple[float, float, Left]:
    """Return where the jump from the wave `whole` + 2 to the next one starts and lands, and the place at its start."""
    centre = table.phase / TWO_PI + 2.0
    start = _fold(table, curve, whole, centre, not outwards)
    _, _, _, z, height, stretch = slope_at(table, curve, whole, start)
    left = (z, height, stretch)
    landing = _landing(table, curve, whole, left, start, centre + (1.0 if outwards else -1.0), not outwards)
    return start, landing, left


@kernel()
def landing_of_wave(table: Table, curve: Cosine, wave: float, outwards: bool) -> float:
    """Return where the jump from a wave to the next one lands, in waves from the wave."""
    _, landing, _ = ends_of_jump(table, curve, wave - 2.0, outwards)
    return landing - 2.0


@kernel()
def jump_of_wave(table: Table, curve: Cosine, wave: float, outwards: bool, work: Work) -> tuple[float, float]:
    """Return where the jump from a wave to the next one lands, in waves from the wave, and what it loses.

    Outwards it leaves the end of the wave's branch, inwards its start. `wave` is any real number from NEAREST on.
    """
    whole = wave - 2.0
    start, landing, left = ends_of_jump(table, curve, whole, outwards)
    low, high = min(start, landing), max(start, landing)
    panels = int((high - low) / LONG) + 1
    width = (high - low) / panels
    total = 0.0
    for i in range(panels):
        total += panel_above(table, curve, whole, start, left, low + i * width, width, work)
    return landing - 2.0, total * (TWO_PI if outwards else -TWO_PI)


@kernel()
def fold_of_wave(table: Table, curve: Cosine, wave: float, rising: bool) -> tuple[float, float]:
    """Return the place in waves where the branch of a wave starts (rising) or ends, and the depth there."""
    b, g, _ = curve
    whole = wave - 2.0
    x = _fold(table, curve, whole, table.phase / TWO_PI + 2.0, rising)
    _, _, _, z, height, stretch = slope_at(table, curve, whole, x)
    return whole + x, 0.5 * b * z * z + g * height - stretch


@kernel()
def branch_of_wave(table: Table, curve: Cosine, wave: float) -> tuple[float, float, float, float]:
    """Return place and depth of the start, and of the end, of the branch of a wave."""
    start, start_depth = fold_of_wave(table, curve, wave, YES)
    end, end_depth = fold_of_wave(table, curve, wave, NO)
    return start, start_depth, end, end_depth


@kernel()
def end_of_wave(table: Table, curve: Cosine, wave: float) -> tuple[Cosine, float]:
    """Return a curve that lags (curve/cosine.py), and the place on it where the branch of a wave ends.

    Beyond FAR it is that of a wave nearer to zero contact with the same cosine at its folds: accurate where chi z is
    large, and enough for the sign of a gap.
    """
    b, g, _ = curve
    whole = np.floor(wave)
    lag = wave - whole
    if whole > FAR:
        b *= (wave / (FAR + lag)) ** (0.5 * (1.0 + table.k))
        whole = FAR
    shifted = Cosine(b, g, lag)
    place, _ = fold_of_wave(table, shifted, whole + lag, NO)
    return shifted, place
