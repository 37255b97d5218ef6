"""The folds of a curve: all zeros of D(z; level), arch by arch.

On an arch (struve/arches.py) the fold function F = b X + g Q - level is concave or convex in X. Its signs at the two
edges, known from the table without any evaluation, leave three cases: different signs, one fold; equal signs on the
far side of the arch's curvature, none; equal signs on the near side, two or none, as the extremum between them tells.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, slope, slopes
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import chosen, root_of
from gradhesion.core.struve.arches import inner_edge, summit
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table

_STEPS = 100
"""Halving alone ends after 60 steps; 3 is the rule."""
LAST_STEP: Final = 1e-3
"""A step of the fourth order of this size (relative to a curvature length) leaves 1e-12, and
depth, load and energy are stationary at a fold: their error is the square of that."""
LAST_STEP_OF_DEPTH: Final = 3e-3
"""The same where only depth and energy matter: the error is 1e-10 of the place, and 1e-15 of the depth."""
Edge: TypeAlias = tuple[float, float, float]
"""x, X and F at the edge of an arch."""
CLOSE: Final = 4e-12
"""A part of its terms by which an input error of 1e-12 may move a number."""
FEW: Final = 20.0
"""z up to which a curve is walked from the start."""


@kernel(contract=True)
def find_zero(
    table: Table, curve: Cosine, level: float, low: float, high: float, rising: bool, guess: float, last_step: float
) -> tuple[float, float]:
    """Return the only zero of D between low and high, where D rises or falls through it, and the depth there.

    Householder's iteration of the fourth order, kept in the bracket. The depth is continued to the zero from the last
    point but one, to the fifth order of the last step; it is that of the fold only if the level is that of the depth.
    """
    x = guess if low < guess < high else 0.5 * (low + high)
    d, d1, d2, d3, depth = slopes(table, curve, level, x)
    for _ in range(_STEPS):
        if d == 0.0:
            break
        if (d < 0.0) == rising:
            low = x
        else:
            high = x
        square = d1 * d1
        step = -d * (square - 0.5 * d * d2) / (d1 * (square - d * d2) + d * d * d3 / 6.0)
        new = x + step / TWO_PI
        small = abs(step) * (abs(d2) + abs(d1)) < last_step * abs(d1) * min(1.0, TWO_PI * x)
        # Where level/z^n outweighs all else in D, inside the first fold, D D'' is (3+k)/(1+k) times D'^2, and where it
        # passes 2 the step of the fourth order vanishes without a zero: Newton's does not.
        small &= abs(d) * (abs(d2) + abs(d1)) < 2.0 * last_step * square * min(1.0, TWO_PI * x)
        if small and low <= new <= high:
            return new, depth + step * (d + step * (0.5 * d1 + step * (d2 / 6.0 + step * d3 / 24.0)))
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                break
        x = new
        d, d1, d2, d3, depth = slopes(table, curve, level, x)
    return x, depth


@kernel()
def find_extremum(table: Table, curve: Cosine, level: float, low: float, high: float, concave: bool) -> float:
    """Return where F has its extremum on an arch: the zero of R + (1+n) b/g, R monotone (Newton, kept in the bracket).

    In terms of D this is n D/z + D' + n level z^(-n)/z - n level z^(-n)/z = 0, that is (z^n D)' = 0.
    """
    n = 0.5 * (1.0 + table.k)
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        z = TWO_PI * x
        d, d1, d2, _ = slope(table, curve, level, x)
        value = n * d + z * d1
        rate = (n + 1.0) * d1 + z * d2
        if value == 0.0:
            return x
        if (value > 0.0) == concave:
            low = x
        else:
            high = x
        new = x - value / rate / TWO_PI
        if not low < new < high:
            new = 0.5 * (low + high)
            if new <= low or new >= high:
                return x
        elif abs(new - x) < 1e-9 * x:
            return new
        x = new
    return x


@kernel(contract=True)
def half_wave(share: float) -> float:
    """Return acos(1 - 2 share)/pi to 3e-5, for 0 < share < 1, a number or eight."""
    least = chosen(share, 0.5, share, 1.0 - share)
    place = root_of(least) * (0.63659317 + least * (0.10770327 + least * (0.03327311 + least * 0.06647575)))
    return chosen(share, 0.5, place, 1.0 - place)


@kernel(contract=True)
def guess_zero(table: Table, curve: Cosine, level: float, i: int, place: float, outer: bool) -> float:
    """Return about where D = 0 on arch i, inside or outside its summit.

    At large z, D z^(n-1) = g C cos(z - phi) + b z^n - level/z: the cosine is known where the slow part is, first at
    `place` and then at the first guess; the next term of the expansion turns the phase by shift/z. The first
    fold of all may lie at a tiny z, where V = 2 z/(1+k).
    """
    b, g, lag = curve
    k = table.k
    if i == 0 and not outer:
        z = power(level / (b + 2.0 * g / (1.0 + k)), 2.0 / (3.0 + k))
        if z < 1.0:
            return z / TWO_PI
    sign = 1.0 if i % 2 == 0 else -1.0
    centre = table.phase + i * math.pi + TWO_PI * lag
    shift = 0.5 * (1.0 - k) + 0.125 * (1.0 - k * k)
    z = TWO_PI * place
    for _ in range(2):
        cosine = sign * (level / z - b / amplitude_power(table, z)) / (g * table.amplitude)
        angle = math.pi * half_wave(0.5 - 0.5 * max(-1.0, min(1.0, cosine)))
        z = centre + (angle if outer else -angle) + shift / z
        if not z > 0.0:
            return place
    return z / TWO_PI


@kernel()
def edge_of(table: Table, curve: Cosine, level: float, i: int) -> Edge:
    """Return x, X and F at the inner edge of arch i."""
    b, g, _ = curve
    x, abscissa, height = inner_edge(table, i)
    if i == 0 and level == 0.0:  # k = 1: F starts at zero and rises
        return x, abscissa, 1.0
    return x, abscissa, b * abscissa + g * height - level


@kernel()
def survey_between(
    table: Table, curve: Cosine, level: float, i: int, inner: Edge, outer: Edge
) -> tuple[int, float, float, float]:
    """Return what stands on arch i: 0, 1 (F rises through 0), -1 (falls) or 2 folds, and where to look for them.

    Its two edges are given. The places are the inner edge, a point at which F has the other sign (2 folds only), and
    the outer edge. Where there is no fold but nearly a pair, they are that of the extremum and what is missing to it,
    in parts of the terms of F.
    """
    b, g, _ = curve
    low, low_abscissa, first = inner
    high, high_abscissa, last = outer
    if first < 0.0 <= last:
        return 1, low, high, high
    if last < 0.0 <= first:
        return -1, low, high, high
    concave = i % 2 == 0
    if concave != (first < 0.0):
        return 0, low, 1.0, high
    sign = 1.0 if concave else -1.0
    peak, peak_abscissa, height = summit(table, i)
    # F is nowhere beyond the summit's height on the line's better side
    terms = b * high_abscissa + level
    if sign * (b * (high_abscissa if concave else low_abscissa) + g * height - level) <= -CLOSE * terms:
        return 0, low, 1.0, high
    if sign * (b * peak_abscissa + g * height - level) <= 0.0:
        peak = find_extremum(table, curve, level, low, high, concave)
        value, _, _, _ = slope(table, curve, level, peak)
        if sign * value <= 0.0:
            missing = abs(value) / (amplitude_power(table, TWO_PI * peak) * terms)
            return 0, peak, missing, high
    return 2, low, peak, high


@kernel()
def survey_arch(table: Table, curve: Cosine, level: float, i: int) -> tuple[int, float, float, float]:
    """Return what `survey_between` does, from the number of the arch alone."""
    inner, outer = edge_of(table, curve, level, i), edge_of(table, curve, level, i + 1)
    return survey_between(table, curve, level, i, inner, outer)


@kernel()
def fold_of_arch(
    table: Table,
    curve: Cosine,
    level: float,
    i: int,
    survey: tuple[int, float, float, float],
    rising: bool,
    guess: float,
    last_step: float = LAST_STEP,
) -> tuple[float, float]:
    """Return where D rises (or falls) through zero on an arch, from its survey, and the depth there.

    A `guess` that cannot be right is replaced by a better one. The `last_step` is that of `find_zero`.
    """
    kind, low, peak, high = survey
    outer = rising != (i % 2 == 0)
    if kind == 2 and outer:
        low = peak
    elif kind == 2:
        high = peak
    if not low < guess < high:
        guess = guess_zero(table, curve, level, i, peak, outer)
    return find_zero(table, curve, level, low, high, rising, guess, last_step)


@kernel(contract=True)
def last_arch(table: Table, curve: Cosine, level: float) -> float:
    """Return the index of an arch beyond which no fold can stand: b z^n > g C (1 + 0.35/z^2) + level/z from there on.

    |V| <= C z^(1-n) (1 + 0.35/z^2) holds for every k. The left side less the right is concave and rises, so that
    Newton's iteration from the left climbs to its zero from below; one arch and a half more make up for what is left.
    """
    b, g, _ = curve
    n = 0.5 * (1.0 + table.k)
    chi = g * table.amplitude
    z = max(power(chi / b, 1.0 / n), power(level / b, 1.0 / (1.0 + n)))
    for _ in range(7):
        if not z > 1.0:
            return 1.0
        slow, pull, wave = b / amplitude_power(table, z), level / z, 0.35 * chi / (z * z)
        step = (slow - pull - chi - wave) / (n * slow + pull + 2.0 * wave)
        z -= step * z
        if step > -1e-9:
            break
    return (z - table.phase) / math.pi + 1.5


@kernel(contract=True)
def first_arch(table: Table, curve: Cosine, level: float) -> float:
    """Return the index of an arch before which no fold can stand: level/z - b z^n > g C (1 + 0.35/z^2) up to there.

    The left side less a constant is convex and falls, so that Newton's iteration from the left stays left of its zero.
    """
    b, g, _ = curve
    n = 0.5 * (1.0 + table.k)
    chi = g * table.amplitude
    z = 0.5 * level / chi
    if not z > FEW:
        return 0.0
    z = min(z, power(0.5 * level / b, 1.0 / (1.0 + n)))
    for _ in range(6):
        if not z > FEW:
            return 0.0
        slow = b / amplitude_power(table, z)
        most = chi * (1.0 + 0.35 / (z * z))  # it falls as z grows: a bound for all that is to come
        z += max(0.0, (level / z - slow - most) / (level / (z * z) + n * slow / z))
    return np.floor((z - table.phase) / math.pi - 1.0)
