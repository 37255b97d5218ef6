"""How the energy of a jump on a general curve changes with the numbers of the curve, at fixed ends of the jump.

    e = int_{z1}^{z2} z [1 - rho^2] dz,    rho = 1 + u,    u = (Y(z) - Y_j)/((alpha + beta z^(1+k)) z^c)

(curve/general_energy.py). What is prescribed is stationary at a fold, and the integrand vanishes where a jump lands, so
that as of one cosine (sensitivities/jump_slopes.py) the ends may be held:

    de/dp = int -2 z rho (du/dp) dz

Here the slopes are those by ln B, ln g and ln(beta/alpha), the machine's share, each with the coordinate of the jump
that follows, and by that coordinate Y_j alone. Only the ratio of alpha and beta counts: alpha may be held.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core._jit import kernel
from gradhesion.core.curve.cosine_energy import NODES, SHORT_NODES, SHORT_WEIGHTS, WEIGHTS
from gradhesion.core.curve.general import Basis, Curve, coordinate, state
from gradhesion.core.curve.general_energy import (
    _GROWTH,
    _GROWTH_OF_MACHINE,
    _INNER_NODES,
    _INNER_WEIGHTS,
    _PANEL,
    _SHORT,
    _SMOOTH,
    Left,
    _longest_panel,
    drop,
    place_left,
)
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, EXPONENT, GAIN, SHARE
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.struve.series import sums

Parts: TypeAlias = tuple[float, float, float]
"""B, g and the machine's share times the slopes of the coordinate by them, at fixed alpha."""
Near: TypeAlias = tuple[Any, Any, Any, Any, Any]
"""Of neighbouring exponents: the tables, the bins of each, the series, the curves, and the weights in d/dk."""
_AREA: Final = TWO_PI * TWO_PI
NOTHING: Final = (0.0, 0.0, 0.0)


@kernel()
def curve_beside(near: Near, j: int) -> Curve:
    """Return the curve of a neighbouring exponent; its basis is (near[0][j], near[1][j], near[2])."""
    curves = near[3]
    return curves[j, 0], curves[j, 1], curves[j, 2], curves[j, 3], curves[j, 4]


@kernel(contract=True)
def parts_of(basis: Basis, curve: Curve, x: float, whole: float) -> Parts:
    """Return the parts of the coordinate at whole + x > 0."""
    table, cosines, series = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    bend = B * z * z if m == 2.0 else B * z**m
    t = beta / (power * power)
    w0, w1, _, _ = sums(table, cosines, series, x, whole)
    pressed, waves = t * bend * (m / (1.0 + table.k + m)), t * g * z * w1
    return alpha * bend + pressed, alpha * g * z * w0 + waves, pressed + waves - t * z * power


@kernel(contract=True)
def _slopes_of_rise(
    basis: Basis, curve: Curve, left: Left, more: Parts, x: float, whole: float
) -> tuple[float, float, float, float, float]:
    """Return u and its slopes by ln B, ln g, the share and Y_j; `more` is what the parts of Y_j are less than there.

    Differences to the place that is left come first, as in curve/general_energy.py.
    """
    table, cosines, series = basis
    _, m, g, alpha, beta = curve
    whole1, x1, wave0, wave1, above, bend1, stretch1 = left
    by_bend, by_gain, by_share = more
    k = table.k
    place1 = whole1 + x1
    z = TWO_PI * (whole + x)
    stretch = z * amplitude_power(table, z)
    lag = ((whole - whole1) + (x - x1)) / place1
    ratio = math.log1p(lag)
    w0, w1, _, _ = sums(table, cosines, series, x, whole)
    bent = lag * (2.0 + lag) if m == 2.0 else math.expm1(m * ratio)
    stretched = math.expm1(0.5 * (1.0 - k) * ratio)
    bend, wave = alpha * bend1 * bent, alpha * (g * z * w0 - wave0)
    rise = above + (bend + wave - alpha * stretch1 * stretched)
    front = 0.0
    if beta > 0.0:
        place1 = TWO_PI * place1
        front, front1 = beta * (z / stretch) * (z / stretch), beta * (place1 / stretch1) * (place1 / stretch1)
        grown = (lag - stretched) * (2.0 + lag + stretched) / ((1.0 + stretched) * (1.0 + stretched))
        pressed = front1 * (m / (1.0 + k + m)) * bend1 * (grown + bent + grown * bent)
        waved = front * g * z * w1 - beta * wave1
        load = pressed + waved - front1 * stretch1 * (grown + stretched + grown * stretched)
        bend, wave, rise = bend + pressed, wave + waved, rise + load
        by_share += load
    stiffness = alpha + front
    norm = 1.0 / (stiffness * stretch)
    u = rise * norm
    return u, (bend + by_bend) * norm, (wave + by_gain) * norm, by_share * norm - u * front / stiffness, -norm


@kernel(contract=True)
def drop_slopes(
    basis: Basis, curve: Curve, left: Left, more: Parts, low: float, high: float, whole: float, sign: float, total: Any
) -> None:
    """Add `sign` times the slopes of what `drop` of curve/general_energy.py returns, times 4 pi^2."""
    _, _, series = basis
    longest = _longest_panel(series)
    bends, gains, shares, levels = 0.0, 0.0, 0.0, 0.0
    while low < high:
        width = min(longest, 2.0 * (whole + low))
        panels = max(1, math.ceil((high - low) / width - 1e-9))
        width = (high - low) / panels if panels < 3 else width
        short = width <= _SHORT * longest and width <= whole + low
        for i in range(SHORT_NODES.size if short else NODES.size):
            x = low + width * (SHORT_NODES[i] if short else NODES[i])
            weight = width * (SHORT_WEIGHTS[i] if short else WEIGHTS[i])
            u, bend, gain, share, level = _slopes_of_rise(basis, curve, left, more, x, whole)
            part = -2.0 * weight * (whole + x) * (1.0 + u)
            bends += part * bend
            gains += part * gain
            shares += part * share
            levels += part * level
        low = low + width if panels > 1 else high
    total[BEND] += sign * _AREA * bends
    total[GAIN] += sign * _AREA * gains
    total[SHARE] += sign * _AREA * shares
    total[DEPTH] += sign * _AREA * levels


@kernel(contract=True)
def _slopes_from_zero(
    basis: Basis, curve: Curve, parts: Parts, x: float, level: float, weight: float, total: Any
) -> None:
    """Add the slopes at one radius of a jump from or to zero contact."""
    table, cosines, series = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    stretch, t = z * power, beta / (power * power)
    w0, w1, _, _ = sums(table, cosines, series, x, 0.0)
    bend = B * z * z if m == 2.0 else B * z**m
    pressed, waved = t * bend * (m / (1.0 + table.k + m)), t * g * z * w1
    load = pressed + waved - t * stretch
    bend, wave = alpha * bend + pressed, alpha * g * z * w0 + waved
    norm = 1.0 / ((alpha + t) * stretch)
    u = (bend + wave + (load - pressed - waved) - alpha * stretch - level) * norm
    part = -2.0 * weight * x * (1.0 + u)
    total[BEND] += part * (bend - parts[0]) * norm
    total[GAIN] += part * (wave - parts[1]) * norm
    total[SHARE] += part * ((load - parts[2]) * norm - u * t / (alpha + t))
    total[DEPTH] -= part * norm


@kernel()
def add_from_zero(basis: Basis, curve: Curve, parts: Parts, x: float, level: float, sign: float, total: Any) -> None:
    """Add `sign` times the slopes of a jump at Y = level from zero contact to x; those of the level are `parts`.

    The panels are those of `energy_from_zero` in curve/general_energy.py.
    """
    table, _, series = basis
    _, _, _, alpha, beta = curve
    longest = _longest_panel(series)
    inner = min(_SMOOTH * x, longest * (0.25 / (_PANEL * TWO_PI)))
    growth = _GROWTH
    if alpha * beta > 0.0:
        growth = _GROWTH_OF_MACHINE
        inner = min(inner, _SMOOTH * (alpha / beta) ** (1.0 / (1.0 + table.k)) / TWO_PI)
    high, scale = x, sign * _AREA
    while high > inner:
        low = max(high - longest, high / growth)
        for i in range(NODES.size):
            place, weight = low + (high - low) * NODES[i], scale * (high - low) * WEIGHTS[i]
            _slopes_from_zero(basis, curve, parts, place, level, weight, total)
        high = low
    for i in range(NODES.size):
        _slopes_from_zero(basis, curve, parts, high * _INNER_NODES[i], level, scale * high * _INNER_WEIGHTS[i], total)


@kernel()
def drop_nearby(near: Near, start: float, waves: float, low: float, high: float, whole: float) -> float:
    """Return the slope by k of `drop` from the place waves + start, but for what k itself adds to the sum."""
    weights = near[4]
    total = 0.0
    for j in range(weights.size):
        basis, curve = (near[0][j], near[1][j], near[2]), curve_beside(near, j)
        left = place_left(basis, curve, start, waves, 0.0)
        total += weights[j] * drop(basis, curve, left, low, high, whole)
    return _AREA * total


@kernel()
def add_drop(
    basis: Basis, curve: Curve, near: Near, start: float, waves: float, end: float, sign: float, total: Any
) -> None:
    """Add `sign` times the slopes of a jump between waves + start, which it leaves, and waves + end."""
    left = place_left(basis, curve, start, waves, 0.0)
    low, high = min(start, end), max(start, end)
    drop_slopes(basis, curve, left, NOTHING, low, high, waves, sign, total)
    total[EXPONENT] += sign * drop_nearby(near, start, waves, low, high, waves)


@kernel()
def rise_to(basis: Basis, curve: Curve, left: Left, x: float, whole: float) -> float:
    """Return u = rho - 1 at whole + x of a jump from the place `left`."""
    u, _, _, _, _ = _slopes_of_rise(basis, curve, left, NOTHING, x, whole)
    return u


@kernel()
def rim_slope_of(basis: Basis, curve: Curve, level: float, x: float, whole: float = 0.0) -> float:
    """Return z^2 (1 - rho^2), the slope by ln x of the energy of a jump at Y = level that ends at x, on no branch."""
    _, _, _, alpha, beta = curve
    z, stretch, front, _, _ = state(basis, curve, x, whole)
    u = (coordinate(basis, curve, x, whole) - level) / ((alpha + beta * front) * stretch)
    return -z * z * u * (2.0 + u)
