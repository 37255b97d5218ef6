"""How the energy of a jump on a general curve changes with the numbers of the curve, at fixed ends of the jump.

    e = int_{z1}^{z2} z [1 - rho^2] dz,    rho = 1 + u,    u = (Y(z) - Y_j)/((alpha + beta z^(1+k)) z^c)

(curve/general_energy.py). What is prescribed is stationary at a fold, and the integrand vanishes where a jump lands, so
that as of one cosine (sensitivities/jump_slopes.py) the ends may be fixed:

    de/dp = int -2 z rho (du/dp) dz

Here the slopes are those by ln B, ln g, ln(beta/alpha), the machine's share, and k at fixed B, g and share, each with
the coordinate of the jump that follows, and by that coordinate Y_j alone. Only the ratio of alpha and beta matters:
alpha may be fixed.
"""

import math
from typing import Any, Final, NamedTuple, TypeAlias

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series, coordinate, state
from gradhesion.core.curve.general_energy import Left, place_left
from gradhesion.core.curve.panels import (
    INNER_PLACES,
    INNER_SHARES,
    PLACES,
    SHARES,
    panel_inwards,
    panel_outwards,
    panels_to_zero,
)
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.harmonics.series_by_k import sums_by_k
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, EXPONENT, GAIN, SHARE
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Slopes
from gradhesion.core.waves.general import NOWHERE

Parts: TypeAlias = tuple[float, float, float, float]
"""B, g and the machine's share times the slopes of the coordinate by them, at fixed alpha, and that by k."""
Change: TypeAlias = tuple[Any, Any]
"""The derivatives of the tables by k (harmonics/series_by_k.py): one record, and the flat array."""
_AREA: Final = TWO_PI * TWO_PI
NOTHING: Final = (0.0, 0.0, 0.0, 0.0)


class Terms(NamedTuple):
    """What depth and load are made of at a place; the load, and all of it, is over z^(1+k)."""

    stretch: float  # z^c
    front: float  # beta z^(1+k)
    logarithm: float  # ln z
    wave0: float  # the waves of depth, g z w0
    wave1: float  # and of load, g z w1
    bend: float  # B z^m
    by_depth: float  # how depth and load change with k
    by_load: float


class Jump(NamedTuple):
    """A jump whose slopes are found."""

    left: Left  # the place that it leaves
    more: Parts  # by how much the parts of that place exceed those of the jump's coordinate
    held: float  # the slope of that coordinate by k


NO_JUMP: Final = Jump(NOWHERE, NOTHING, 0.0)


@kernel(contract=True)
def _terms(basis: Basis, curve: Series, change: Change, x: float, whole: float) -> Terms:
    """Return the terms of depth and load at whole + x > 0."""
    table, cosine_bins, series = basis
    B, m, g, _, beta = curve
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    stretch, logarithm = z * power, math.log(z)
    w0, w1, w0_k, w1_k = sums_by_k(table, cosine_bins, series, change[0][0], change[1], x, whole)
    bend = B * z * z if m == 2.0 else B * z**m
    pull = 0.5 * logarithm * stretch  # stretch falls by this
    by_depth = g * z * w0_k + pull
    share = m / (1.0 + table.k + m)
    load = bend * share + g * z * w1 - stretch
    by_load = logarithm * load + g * z * w1_k + pull - bend * share / (1.0 + table.k + m)
    return Terms(stretch, beta / (power * power), logarithm, g * z * w0, g * z * w1, bend, by_depth, by_load)


@kernel(contract=True)
def parts_of(basis: Basis, curve: Series, change: Change, x: float, whole: float) -> Parts:
    """Return the parts of the coordinate at whole + x > 0."""
    _, m, _, alpha, _ = curve
    stretch, front, _, wave0, wave1, bend, by_depth, by_load = _terms(basis, curve, change, x, whole)
    pressed, waved = front * bend * (m / (1.0 + basis[0].k + m)), front * wave1
    return (
        alpha * bend + pressed,
        alpha * wave0 + waved,
        pressed + waved - front * stretch,
        alpha * by_depth + front * by_load,
    )


@kernel(contract=True)
def _slopes_of_rise(
    basis: Basis, curve: Series, change: Change, left: Left, more: Parts, held: float, x: float, whole: float
) -> tuple[float, float, float, float, float, float]:
    """Return u and its slopes by ln B, ln g, the share, k and Y_j.

    `more` is by how much the parts of the place that is left exceed those of Y_j, `held` the slope of Y_j by k.
    Differences to the place that is left come first, as in curve/general_energy.py.
    """
    _, m, _, alpha, beta = curve
    whole1, x1, wave0, wave1, above, bend1, stretch1 = left
    by_bend, by_gain, by_share, _ = more
    k = basis[0].k
    place1 = whole1 + x1
    stretch, front, logarithm, here0, here1, _, by_depth, by_load = _terms(basis, curve, change, x, whole)
    lag = ((whole - whole1) + (x - x1)) / place1
    ratio = math.log1p(lag)
    bent = lag * (2.0 + lag) if m == 2.0 else math.expm1(m * ratio)
    stretched = math.expm1(0.5 * (1.0 - k) * ratio)
    bend, wave = alpha * bend1 * bent, alpha * (here0 - wave0)
    rise = above + (bend + wave - alpha * stretch1 * stretched)
    if beta > 0.0:
        place1 = TWO_PI * place1
        front1 = beta * (place1 / stretch1) * (place1 / stretch1)
        grown = (lag - stretched) * (2.0 + lag + stretched) / ((1.0 + stretched) * (1.0 + stretched))
        pressed = front1 * (m / (1.0 + k + m)) * bend1 * (grown + bent + grown * bent)
        waved = front * here1 - beta * wave1
        load = pressed + waved - front1 * stretch1 * (grown + stretched + grown * stretched)
        bend, wave, rise = bend + pressed, wave + waved, rise + load
        by_share += load
    stiffness = alpha + front
    norm, share = 1.0 / (stiffness * stretch), front / stiffness
    u = rise * norm
    by_k = (alpha * by_depth + front * by_load - held) * norm - u * logarithm * (share - 0.5)
    return u, (bend + by_bend) * norm, (wave + by_gain) * norm, by_share * norm - u * share, by_k, -norm


@kernel(contract=True)
def drop_slopes(
    basis: Basis,
    curve: Series,
    change: Change,
    jump: Jump,
    way: tuple[float, float],
    whole: float,
    sign: float,
    total: Slopes,
) -> None:
    """Add `sign` times the slopes of what `drop` of curve/general_energy.py returns, times 4 pi^2.

    `way` are the x, beyond `whole` waves, that the jump passes; `total` are slopes by the numbers of jump_slopes.py, of
    shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    left, more, held = jump
    low, high = way
    _, _, series = basis
    shortest = highest_harmonic(series)
    bends, gains, shares, exponents, levels = 0.0, 0.0, 0.0, 0.0, 0.0
    while low < high:
        width, beyond, begin, end = panel_outwards(low, high, whole, shortest)
        for i in range(begin, end):
            x = low + width * PLACES[i]
            weight = width * SHARES[i]
            u, bend, gain, share, by_k, level = _slopes_of_rise(basis, curve, change, left, more, held, x, whole)
            part = -2.0 * weight * (whole + x) * (1.0 + u)
            bends += part * bend
            gains += part * gain
            shares += part * share
            exponents += part * by_k
            levels += part * level
        low = beyond
    total[BEND] += sign * _AREA * bends
    total[GAIN] += sign * _AREA * gains
    total[SHARE] += sign * _AREA * shares
    total[EXPONENT] += sign * _AREA * exponents
    total[DEPTH] += sign * _AREA * levels


@kernel(contract=True)
def _slopes_from_zero(
    basis: Basis, curve: Series, change: Change, parts: Parts, x: float, level: float, weight: float, total: Slopes
) -> None:
    """Add the slopes at one radius of a jump from or to zero contact."""
    _, m, _, alpha, _ = curve
    stretch, front, logarithm, wave0, wave1, bend, by_depth, by_load = _terms(basis, curve, change, x, 0.0)
    pressed, waved = front * bend * (m / (1.0 + basis[0].k + m)), front * wave1
    load = pressed + waved - front * stretch
    stiffness = alpha + front
    norm, share = 1.0 / (stiffness * stretch), front / stiffness
    u = (alpha * (bend + wave0 - stretch) + load - level) * norm
    part = -2.0 * weight * x * (1.0 + u)
    total[BEND] += part * (alpha * bend + pressed - parts[0]) * norm
    total[GAIN] += part * (alpha * wave0 + waved - parts[1]) * norm
    total[SHARE] += part * ((load - parts[2]) * norm - u * share)
    by_k = (alpha * by_depth + front * by_load - parts[3]) * norm - u * logarithm * (share - 0.5)
    total[EXPONENT] += part * by_k
    total[DEPTH] -= part * norm


@kernel()
def add_from_zero(
    basis: Basis, curve: Series, change: Change, parts: Parts, x: float, level: float, sign: float, total: Slopes
) -> None:
    """Add `sign` times the slopes of a jump at Y = level from zero contact to x; those of the level are `parts`.

    The panels are those of `energy_from_zero` in curve/general_energy.py.
    """
    table, _, series = basis
    _, _, _, alpha, beta = curve
    shortest = highest_harmonic(series)
    inner, growth = panels_to_zero(table.k, alpha, beta, x, shortest)
    high, scale = x, sign * _AREA
    while high > inner:
        low, begin, end = panel_inwards(high, growth, shortest)
        for i in range(begin, end):
            place, weight = low + (high - low) * PLACES[i], scale * (high - low) * SHARES[i]
            _slopes_from_zero(basis, curve, change, parts, place, level, weight, total)
        high = low
    for i in range(INNER_PLACES.size):
        place, weight = high * INNER_PLACES[i], scale * high * INNER_SHARES[i]
        _slopes_from_zero(basis, curve, change, parts, place, level, weight, total)


@kernel()
def jump_from(basis: Basis, curve: Series, change: Change, start: float, whole: float) -> Jump:
    """Return the jump that leaves the curve at whole + start."""
    _, _, _, held = parts_of(basis, curve, change, start, whole)
    return Jump(place_left(basis, curve, start, whole, 0.0), NOTHING, held)


@kernel()
def add_drop(
    basis: Basis, curve: Series, change: Change, start: float, waves: float, end: float, sign: float, total: Slopes
) -> None:
    """Add `sign` times the slopes of a jump between waves + start, which it leaves, and waves + end."""
    jump = jump_from(basis, curve, change, start, waves)
    drop_slopes(basis, curve, change, jump, (min(start, end), max(start, end)), waves, sign, total)


@kernel()
def rise_to(basis: Basis, curve: Series, change: Change, start: float, waves: float, end: float) -> float:
    """Return u = rho - 1 at waves + end of a jump that leaves the curve at waves + start."""
    left, more, held = jump_from(basis, curve, change, start, waves)
    u, _, _, _, _, _ = _slopes_of_rise(basis, curve, change, left, more, held, end, waves)
    return u


@kernel()
def rim_slope_of(basis: Basis, curve: Series, level: float, x: float, whole: float = 0.0) -> float:
    """Return z^2 (1 - rho^2), the slope by ln x of the energy of a jump at Y = level that ends at x, on no branch."""
    _, _, _, alpha, beta = curve
    z, stretch, front, _, _ = state(basis, curve, x, whole)
    u = (coordinate(basis, curve, x, whole) - level) / ((alpha + beta * front) * stretch)
    return -z * z * u * (2.0 + u)
