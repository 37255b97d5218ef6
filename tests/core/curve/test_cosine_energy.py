"""The energy of a jump against quadrature of the potential's drop at 25 digits, and its sum rules."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine_energy import SHORT, energy_from_zero, jump_energy

pytestmark = pytest.mark.slow

EPS = 2.0**-52
EXPONENTS = [0.0, 0.41, 1 - 1e-12, 1.0]
CURVES = [Cosine(0.02, 0.9, 0.0), Cosine(1.7, 0.31, 0.0), Cosine(0.003, 2.2, 0.0)]
RADII = [0.0021, 0.2, 0.9, 3.3, 6.9]
JUMPS = [
    (0.03, 0.2),
    (0.03, 1.4),
    (1.4, 0.03),
    (0.61, 0.93),
    (0.7, 2.6),
    (5.1, 4.3),
    (7.9, 6.6),
    (6.2, 6.6),
    (6.4, 7.2),
]
Pair = Callable[..., tuple[mpmath.mpf, mpmath.mpf]]
WORK = np.empty(64)


def _turns(x: float) -> mpmath.mpf:
    return 2 * mpmath.pi * mpmath.mpf(x)


def _drop(k: float, curve: Any, start: mpmath.mpf, end: mpmath.mpf, level: Any, pair: Pair) -> tuple[Any, float]:
    """Integrate z (1 - rho^2) from z = start to end; also give the integral of the size of its terms."""
    b, g, _ = curve
    c = (1 - mpmath.mpf(k)) / 2

    def integrand(z: mpmath.mpf) -> mpmath.mpf:
        rho = (b * z * z / 2 + g * z * pair(k, z)[0] - level) / z**c
        return z * (1 - rho**2)

    low, high = min(start, end), max(start, end)
    # z = u^4 takes the branch point at 0; a node every half wave takes the waves
    inner = min(high, mpmath.mpf(2))
    total, size = mpmath.mpf(0), 0.0
    if low < inner:
        ends = [low ** mpmath.mpf("0.25"), inner ** mpmath.mpf("0.25")]
        total += mpmath.quad(lambda u: integrand(u**4) * 4 * u**3 if u else mpmath.mpf(0), ends)
    if inner < high:
        count = 1 + int((high - max(low, inner)) / 3)
        total += mpmath.quad(integrand, mpmath.linspace(max(low, inner), high, count + 1))
    for z in np.linspace(float(low) + 1e-9, float(high), 50):
        size = max(size, z + z * float(b * z * z / 2 + g * z ** float(c) + abs(level)) ** 2 / z ** (2 * float(c)))
    return (total if end > start else -total), size * float(high - low)


def with_curves(places: list[Any]) -> list[tuple[float, Any, Any]]:
    """Each exponent with each place once, and both with curves of each balance of bend, wave and stretch."""
    return [
        (k, CURVES[(i + j) % len(CURVES)], place) for i, k in enumerate(EXPONENTS) for j, place in enumerate(places)
    ]


@pytest.mark.parametrize(("k", "curve", "x"), with_curves(RADII))
def test_from_zero(k: float, curve: Any, x: float, table_of: Callable[[float], Any], slow_pair: Pair) -> None:
    mpmath.mp.dps = 20
    for level in (0.0, -0.73):
        exact, size = _drop(k, curve, mpmath.mpf(0), _turns(x), level, slow_pair)
        # the moments of 12 eps and four terms of the size of the integrand
        assert abs(energy_from_zero(table_of(k), curve, x, level) - exact) <= 12 * EPS * size


@pytest.mark.parametrize(("k", "curve", "ends"), with_curves(JUMPS))
def test_between_radii(
    k: float, curve: Any, ends: tuple[float, float], table_of: Callable[[float], Any], slow_pair: Pair
) -> None:
    mpmath.mp.dps = 20
    start, end = ends
    b, g, _ = curve
    z = _turns(start)
    level = b * z * z / 2 + g * z * slow_pair(k, z)[0] - z ** ((1 - mpmath.mpf(k)) / 2)
    exact, size = _drop(k, curve, z, _turns(end), level, slow_pair)
    assert abs(jump_energy(table_of(k), curve, start, end, WORK) - exact) <= 24 * EPS * size


def test_no_way_costs_nothing(table_of: Callable[[float], Any]) -> None:
    for x in (0.01, 0.6, 3.3, 7.7, 40.0):
        assert jump_energy(table_of(0.41), CURVES[0], x, x, WORK) == 0.0


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_long_ways_are_sums(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """Gauss's rule and the antiderivative are two ways to one number: from x1 to x2 at the depth of x1."""
    table = table_of(k)
    for start, end in [(0.05, 9.3), (0.9, 0.5), (3.3, 17.7), (12.0, 8.3), (11.0, 0.01)]:
        level = depth(table, curve, start)
        whole = energy_from_zero(table, curve, end, level) - energy_from_zero(table, curve, start, level)
        size = sum(abs(energy_from_zero(table, curve, x, y)) for x in (start, end) for y in (0.0, level))
        size += level * level * (2 * math.pi * max(start, end)) ** (1 + k)
        size += abs(level) * curve[0] * (2 * math.pi * max(start, end)) ** (3 + k)
        assert abs(jump_energy(table, curve, start, end, WORK) - whole) <= 40 * EPS * size


def test_panels_join(table_of: Callable[[float], Any]) -> None:
    """Both rules, on either side of the length where the longer one takes over."""
    table = table_of(0.41)
    for end in (3.3 + SHORT, 9.9 + SHORT, 3.3 + 1.25, 3.3 + 2.5):
        near = [
            jump_energy(table, CURVES[0], end - SHORT, place, WORK) for place in (end * (1 - 1e-12), end * (1 + 1e-12))
        ]
        assert math.isclose(*near, rel_tol=1e-9)


def test_a_jump_outwards_may_gain(table_of: Callable[[float], Any]) -> None:
    """Weak adhesion: on the way outwards rho < -1, and the drop is negative; inwards it is a loss."""
    table = table_of(0.0)
    curve = Cosine(1e-4, 6.0, 0.0)
    level = depth(table, curve, 2.4)
    values = [jump_energy(table, curve, 2.4, x, WORK) for x in np.linspace(2.5, 3.5, 11)]
    assert min(values) < 0.0
    assert level == depth(table, curve, 2.4)
