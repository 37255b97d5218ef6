"""The energy lost in a jump at a fixed coordinate, whatever is prescribed (docs/theory.md, section 15).

    e = int_{z1}^{z2} z [1 - rho^2] dz,    rho = 1 + (Y(z) - Y_j)/((alpha + beta z^(1+k)) z^c)

in units of 2 pi l^2 dgamma, from the radius that is left to the one that is reached; rho = 1 on the equilibrium curve.
Gauss's rule in panels short against the shortest wave, and against the distance from the branch point at z = 0.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core._jit import kernel
from gradhesion.core.curve.cosine_energy import LONG, NODES, SHORT, SHORT_NODES, SHORT_WEIGHTS, WEIGHTS
from gradhesion.core.curve.general import Basis, Curve, slope
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.struve.series import sums

Left: TypeAlias = tuple[float, float, float, float, float, float, float]
"""A place on the curve that tells the coordinate of a jump: whole waves, x beyond them, there the waves of depth and of
load, by how much the coordinate there exceeds that of the jump (0 where the jump leaves the curve there), and there
B z^m and z^c."""
_PANEL: Final = LONG
"""Waves a panel of 16 nodes."""
_SHORT: Final = SHORT / LONG
"""The part of it for which 12 nodes serve."""
_GROWTH: Final = 4.5
"""Outer over inner end of a panel: its distance from the branch point leaves 1e-15."""
_GROWTH_OF_MACHINE: Final = 3.0
"""The same where alpha + beta z^(1+k) has zeros beside the panel."""
_POWER: Final = 7
_INNER_NODES: Final = NODES**_POWER
_INNER_WEIGHTS: Final = WEIGHTS * _POWER * NODES ** (_POWER - 1)
_SMOOTH: Final = 1.0 / 9.0
"""Innermost panel over the radius, or over that where powers of z change their balance."""
_STEPS: Final = 200
_SURE: Final = 1e-8
"""Step of Newton's method, in waves, whose square is below rounding."""


@kernel()
def _longest_panel(series: Any) -> float:
    shortest = 0.0
    for i in range(series.shape[0]):
        shortest = max(shortest, series[i, 0])
    return _PANEL / shortest if shortest > 0.0 else math.inf


@kernel()
def place_left(basis: Basis, curve: Curve, x: float, whole: float, above: float = 0.0) -> Left:
    """Return a place that a jump leaves, or one at which the coordinate is above that of the jump."""
    table, cosine_bins, series = basis
    B, m, g, _, _ = curve
    z = TWO_PI * (whole + x)
    w0, w1, _, _ = sums(table, cosine_bins, series, x, whole)
    power = amplitude_power(table, z)
    return whole, x, g * z * w0, g * z * w1 / (power * power), above, B * z**m, z * power


@kernel(contract=True)
def _rise(basis: Basis, curve: Curve, left: Left, x: float, whole: float) -> float:
    """Return [Y(z) - Y_j]/((alpha + beta z^(1+k)) z^c); each term's difference first, however large the terms are."""
    table, cosine_bins, series = basis
    _, m, g, alpha, beta = curve
    whole1, x1, wave0, wave1, above, bend1, stretch1 = left
    k = table.k
    place1 = whole1 + x1
    z = TWO_PI * (whole + x)
    stretch = z * amplitude_power(table, z)
    lag = ((whole - whole1) + (x - x1)) / place1  # of z behind the place, over it
    ratio = math.log1p(lag)
    w0, w1, _, _ = sums(table, cosine_bins, series, x, whole)
    bent = lag * (2.0 + lag) if m == 2.0 else math.expm1(m * ratio)
    stretched = math.expm1(0.5 * (1.0 - k) * ratio)
    rise = above + alpha * (bend1 * bent + g * z * w0 - wave0 - stretch1 * stretched)
    front = 0.0
    if beta > 0.0:
        place1 = TWO_PI * place1
        front, front1 = beta * (z / stretch) * (z / stretch), beta * (place1 / stretch1) * (place1 / stretch1)
        # z^(1+k) is the square of z over z^c
        grown = (lag - stretched) * (2.0 + lag + stretched) / ((1.0 + stretched) * (1.0 + stretched))
        share = m / (1.0 + k + m) * bend1 * (grown + bent + grown * bent)
        rise += (
            front1 * (share - stretch1 * (grown + stretched + grown * stretched)) + front * g * z * w1 - beta * wave1
        )
    return rise / ((alpha + front) * stretch)


@kernel()
def find_landing(basis: Basis, curve: Curve, left: Left, low: float, high: float, whole: float) -> float:
    """Return where the branch from whole + low to whole + high meets the coordinate of the place `left`.

    Newton's method for the difference of the two, kept in the bracket: the coordinates themselves are larger than what
    a wave adds to them by the number of waves.
    """
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = _rise(basis, curve, left, x, whole)
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        value, _, _ = slope(basis, curve, x, whole)
        z = TWO_PI * (whole + x)
        step = -rest * amplitude_power(basis[0], z) * (whole + x) / value
        if low <= x + step <= high and abs(step) <= _SURE:  # what is left is its square
            return x + step
        x += step
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def drop(basis: Basis, curve: Curve, left: Left, low: float, high: float, whole: float) -> float:
    """Return int x (1 - rho^2) dx from whole + low to whole + high, at the coordinate of the place `left`."""
    _, _, series = basis
    longest = _longest_panel(series)
    total = 0.0
    while low < high:
        width = min(longest, 2.0 * (whole + low))
        panels = max(1, math.ceil((high - low) / width - 1e-9))
        width = (high - low) / panels if panels < 3 else width
        part = 0.0
        if width <= _SHORT * longest and width <= whole + low:
            for i in range(SHORT_NODES.size):
                x = low + width * SHORT_NODES[i]
                u = _rise(basis, curve, left, x, whole)
                part -= SHORT_WEIGHTS[i] * (whole + x) * u * (2.0 + u)
        else:
            for i in range(NODES.size):
                x = low + width * NODES[i]
                u = _rise(basis, curve, left, x, whole)
                part -= WEIGHTS[i] * (whole + x) * u * (2.0 + u)
        total += width * part
        low = low + width if panels > 1 else high
    return total


@kernel()
def jump_energy(basis: Basis, curve: Curve, start: float, end: float, whole: float = 0.0) -> float:
    """Return e of a jump from x = start > 0 on the curve to x = end > 0, both beyond `whole` waves."""
    left = place_left(basis, curve, start, whole)
    total = drop(basis, curve, left, min(start, end), max(start, end), whole)
    return total * (TWO_PI * TWO_PI if end > start else -TWO_PI * TWO_PI)


@kernel(contract=True)
def _from_zero(basis: Basis, curve: Curve, x: float, level: float) -> float:
    """Return x (1 - rho^2) at a radius of a jump from or to zero contact."""
    table, cosine_bins, series = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    stretch, t = z * power, beta / (power * power)
    w0, w1, _, _ = sums(table, cosine_bins, series, x, 0.0)
    bend = B * z * z if m == 2.0 else B * z**m
    depth, height = bend + g * z * w0 - stretch, bend * (m / (1.0 + table.k + m)) + g * z * w1 - stretch
    u = (alpha * depth + t * height - level) / ((alpha + t) * stretch)
    return -x * u * (2.0 + u)


@kernel()
def energy_from_zero(basis: Basis, curve: Curve, x: float, level: float) -> float:
    """Return e of a jump at Y = level from zero contact to x; the way back has the other sign.

    In the innermost panel the powers of z that have a branch point at 0 are made smooth by x = h t^7: with 16 nodes
    that leaves 2e-15 of its share, and 1e-15 of waves that turn by no more than 1/4 there.
    """
    table, _, series = basis
    _, _, _, alpha, beta = curve
    longest = _longest_panel(series)
    inner = min(_SMOOTH * x, longest * (0.25 / (_PANEL * TWO_PI)))
    growth = _GROWTH
    if alpha * beta > 0.0:  # the machine's share of the stiffness changes there
        growth = _GROWTH_OF_MACHINE
        inner = min(inner, _SMOOTH * (alpha / beta) ** (1.0 / (1.0 + table.k)) / TWO_PI)
    total, high = 0.0, x
    while high > inner:
        low = max(high - longest, high / growth)
        part = 0.0
        for i in range(NODES.size):
            part += WEIGHTS[i] * _from_zero(basis, curve, low + (high - low) * NODES[i], level)
        total += (high - low) * part
        high = low
    part = 0.0
    for i in range(NODES.size):
        part += _INNER_WEIGHTS[i] * _from_zero(basis, curve, high * _INNER_NODES[i], level)
    return (total + high * part) * TWO_PI * TWO_PI
