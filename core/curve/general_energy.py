"""The energy lost in a jump at a fixed coordinate, under any control (docs/theory.md, section 15).

    e = int_{z1}^{z2} z [kappa^2 - rho^2] dz,    rho = kappa + (Y(z) - Y_j)/((alpha + beta z^(1+k)) z^c)

in units of 2 pi l^2 dgamma, from the radius that is left to the one that is reached; rho = kappa on the equilibrium
curve, 1 on a plain interface. Gauss's rule in panels short against the shortest wave, and against the distance from the
branch point at z = 0. rho - kappa is free of kappa, and kappa^2 is a series or its square: even where kappa is a root
the rule needs no more than the waves of the two.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series, slope
from gradhesion.core.curve.panels import (
    INNER_PLACES,
    INNER_SHARES,
    PLACES,
    SHARES,
    SMOOTH,
    panel_after,
    panel_inwards,
    panel_outwards,
    panels_to_zero,
    rule_between,
)
from gradhesion.core.face import relative_toughness, shortest_wave, waves_at
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats


class Left(NamedTuple):
    """A place on the curve that defines the coordinate of a jump; depths in s l^c."""

    waves: float  # whole waves, and x beyond them
    x: float
    wave0: float  # the waves of depth and of load there, g z w0 and g z^(2+k) w1
    wave1: float
    above: float  # by how much the coordinate there exceeds that of the jump, 0 where the jump leaves the curve there
    bend: float  # B z^m
    stretch: float  # z^c


_STEPS: Final = 200
_SURE: Final = 1e-8
"""Step of Newton's method, in waves, whose square is below rounding."""


@kernel()
def place_left(basis: Basis, curve: Series, x: float, whole: float, above: float = 0.0) -> Left:
    """Return a place that a jump leaves, or one at which the coordinate is above that of the jump."""
    table, _, _ = basis
    B, m, g, _, _ = curve
    z = TWO_PI * (whole + x)
    w0, w1, _, _ = waves_at(basis, curve, x, whole)
    power = amplitude_power(table, z)
    bend = B * z * z if m == 2.0 else B * z**m
    return Left(whole, x, g * z * w0, g * z * w1 / (power * power), above, bend, z * power)


@kernel(contract=True)
def rise_from(basis: Basis, curve: Series, left: Left, x: float, whole: float) -> float:
    """Return [Y(z) - Y_j]/((alpha + beta z^(1+k)) z^c); each term's difference first, however large the terms are."""
    table, _, _ = basis
    _, m, g, alpha, beta = curve
    whole1, x1, wave0, wave1, above, bend1, stretch1 = left
    k = table.k
    place1 = whole1 + x1
    z = TWO_PI * (whole + x)
    stretch = z * amplitude_power(table, z)
    lag = ((whole - whole1) + (x - x1)) / place1  # of z behind the place, over it
    ratio = math.log1p(lag)
    w0, w1, _, _ = waves_at(basis, curve, x, whole)
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
def find_landing(basis: Basis, curve: Series, left: Left, low: float, high: float, whole: float) -> float:
    """Return where the branch from whole + low to whole + high meets the coordinate of the place `left`.

    Newton's method for the difference of the two, kept in the bracket: the coordinates themselves are larger than what
    a wave adds to them by the number of waves.
    """
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = rise_from(basis, curve, left, x, whole)
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
def drop(basis: Basis, curve: Series, left: Left, low: float, high: float, whole: float) -> float:
    """Return int x (kappa^2 - rho^2) dx from whole + low to whole + high, at the coordinate of the place `left`."""
    shortest = shortest_wave(basis, curve)
    total = 0.0
    while low < high:
        width, beyond, begin, end = panel_outwards(low, high, whole, shortest)
        part = 0.0
        for i in range(begin, end):
            x = low + width * PLACES[i]
            u = rise_from(basis, curve, left, x, whole)
            part -= SHARES[i] * (whole + x) * u * (2.0 * relative_toughness(basis, curve, whole + x) + u)
        total += width * part
        low = beyond
    return total


@kernel()
def jump_energy(basis: Basis, curve: Series, start: float, end: float, whole: float = 0.0) -> float:
    """Return e of a jump from x = start > 0 on the curve to x = end > 0, both beyond `whole` waves."""
    left = place_left(basis, curve, start, whole)
    total = drop(basis, curve, left, min(start, end), max(start, end), whole)
    return total * (TWO_PI * TWO_PI if end > start else -TWO_PI * TWO_PI)


@kernel(contract=True)
def balance(basis: Basis, curve: Series, x: float) -> tuple[float, float]:
    """Return Y on the curve at a radius, and (alpha + beta z^(1+k)) z^c: rho is kappa + (Y - Y_j) over that."""
    table, _, _ = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    stretch, t = z * power, beta / (power * power)
    w0, w1, _, _ = waves_at(basis, curve, x, 0.0)
    bend = B * z * z if m == 2.0 else B * z**m
    depth, height = bend + g * z * w0 - stretch, bend * (m / (1.0 + table.k + m)) + g * z * w1 - stretch
    return alpha * depth + t * height, (alpha + t) * stretch


@kernel(contract=True)
def _from_zero(basis: Basis, curve: Series, x: float, level: float) -> float:
    """Return x (kappa^2 - rho^2) at a radius of a jump from or to zero contact."""
    value, scale = balance(basis, curve, x)
    u = (value - level) / scale
    return -x * u * (2.0 * relative_toughness(basis, curve, x) + u)


@kernel()
def energy_from_zero(basis: Basis, curve: Series, x: float, level: float) -> float:
    """Return e of a jump at Y = level from zero contact to x >= 0; the way back has the other sign."""
    if x == 0.0:
        return 0.0
    shortest = shortest_wave(basis, curve)
    inner, growth = panels_to_zero(basis.table.k, curve.alpha, curve.beta, x, shortest)
    total, high = 0.0, x
    while high > inner:
        low, begin, end = panel_inwards(high, growth, shortest)
        part = 0.0
        for i in range(begin, end):
            part += SHARES[i] * _from_zero(basis, curve, low + (high - low) * PLACES[i], level)
        total += (high - low) * part
        high = low
    part = 0.0
    for i in range(INNER_PLACES.size):
        part += INNER_SHARES[i] * _from_zero(basis, curve, high * INNER_PLACES[i], level)
    return (total + high * part) * TWO_PI * TWO_PI


@kernel(contract=True)
def _parts(basis: Basis, curve: Series, x: float) -> tuple[float, float, float]:
    """Return x (kappa^2 - rho^2) at a radius of a jump from or to zero contact as a polynomial of Y_j."""
    value, scale = balance(basis, curve, x)
    own, share = relative_toughness(basis, curve, x), 1.0 / scale
    u = value * share
    return -x * u * (2.0 * own + u), 2.0 * x * (own + u) * share, -x * share * share


@kernel()
def _with_panel(
    basis: Basis, curve: Series, low: float, high: float, shortest: float, total: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Return integrals of `_parts` with those over a panel away from zero, which may be the part of one."""
    first, second, third = 0.0, 0.0, 0.0
    begin, end = rule_between(low, high, shortest)
    for i in range(begin, end):
        parts = _parts(basis, curve, low + (high - low) * PLACES[i])
        first += SHARES[i] * parts[0]
        second += SHARES[i] * parts[1]
        third += SHARES[i] * parts[2]
    width = high - low
    return total[0] + width * first, total[1] + width * second, total[2] + width * third


@kernel()
def _innermost_parts(basis: Basis, curve: Series, high: float) -> tuple[float, float, float]:
    """Return integrals of `_parts` over the panel from zero contact on."""
    first, second, third = 0.0, 0.0, 0.0
    for i in range(INNER_PLACES.size):
        parts = _parts(basis, curve, high * INNER_PLACES[i])
        first += INNER_SHARES[i] * parts[0]
        second += INNER_SHARES[i] * parts[1]
        third += INNER_SHARES[i] * parts[2]
    return high * first, high * second, high * third


@kernel()
def energies_in(
    basis: Basis, curve: Series, x: float, first_level: float, other_level: float, stations: Floats
) -> tuple[float, float]:
    """Return e of the jumps at two coordinates from zero contact to x, as `energy_from_zero`.

    Panels end at stations, the same for any x, where the last one begins: many x, rims within the jump-in or the
    jump-out, share all but that. `stations`, shape (4, n), has places, infinite where nothing has been found yet, and
    up to them the integrals of the coefficients of a polynomial in Y.
    """
    shortest = shortest_wave(basis, curve)
    low, growth = panels_to_zero(basis.table.k, curve.alpha, curve.beta, math.inf, shortest)
    if not SMOOTH * x > low:
        energy = energy_from_zero(basis, curve, x, first_level)
        return energy, energy_from_zero(basis, curve, x, other_level) if other_level != first_level else energy
    total, j = (0.0, 0.0, 0.0), 0
    while True:
        known = j < stations.shape[1] and stations[0, j] < math.inf
        if known:
            total = (stations[1, j], stations[2, j], stations[3, j])
        elif j == 0:
            total = _innermost_parts(basis, curve, low)
        if not known and j < stations.shape[1]:
            stations[0, j], stations[1, j], stations[2, j], stations[3, j] = low, total[0], total[1], total[2]
        high = panel_after(low, growth, shortest)
        if high >= x:
            break
        if not (j + 1 < stations.shape[1] and stations[0, j + 1] < math.inf):
            total = _with_panel(basis, curve, low, high, shortest, total)
        low, j = high, j + 1
    first, second, third = _with_panel(basis, curve, low, x, shortest, total)
    square = TWO_PI * TWO_PI
    return (
        (first + first_level * (second + first_level * third)) * square,
        (first + other_level * (second + other_level * third)) * square,
    )
