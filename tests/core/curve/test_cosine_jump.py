"""The energy of a jump from its two ends, against quadrature at 20 digits and against that by panels."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine_energy import energy_by_panels, energy_from_zero
from gradhesion.core.curve.cosine_jump import energy_between
from gradhesion.core.numbers.circle import TWO_PI

EPS = 2.0**-52
EXPONENTS = [0.0, 0.41, 1.0]
JUMPS = [(0.2, 0.9), (0.61, 0.07), (3.1, 4.4), (5.9, 5.2), (6.2, 7.1), (7.9, 6.1), (6.5, 7.4), (9.9, 8.6), (60.2, 61.3)]
WORK = np.empty(64)
Pair = Callable[..., tuple[mpmath.mpf, mpmath.mpf]]


def _exact(k: float, curve: tuple[float, float, float], start: float, end: float, pair: Pair) -> mpmath.mpf:
    """The integral of z (1 - rho^2) at the depth of the curve at the start."""
    b, g, _ = (mpmath.mpf(number) for number in curve)
    c = (1 - mpmath.mpf(k)) / 2
    z1, z2 = (2 * mpmath.pi * mpmath.mpf(x) for x in (start, end))

    def hertz(z: mpmath.mpf) -> mpmath.mpf:
        return b * z * z / 2 + g * z * pair(k, z)[0]

    level = hertz(z1) - z1**c
    steps = 2 + int(abs(end - start) * 3)
    return mpmath.quad(lambda z: z * (1 - ((hertz(z) - level) / z**c) ** 2), mpmath.linspace(z1, z2, steps))


def _curve(k: float, x: float, chi: float, share: float, amplitude: float) -> Cosine:
    """A curve whose folds end beyond x for a share below 1, of a chi."""
    return Cosine(share * chi * (TWO_PI * x) ** (-0.5 * (1.0 + k)), chi / amplitude, 0.0)


def _of_nodes(start: float, end: float) -> float:
    """The integral of z, whose part is left where rho crosses 1 on the way."""
    return 0.5 * TWO_PI**2 * abs(start - end) * (start + end)


@pytest.mark.slow
@pytest.mark.parametrize("k", EXPONENTS)
def test_against_quadrature(k: float, table_of: Callable[[float], Any], slow_pair: Pair) -> None:
    """Each jump at each exponent, of one of three curves; another of each exponent."""
    table, curves = table_of(k), ((0.02, 0.3), (0.4, 0.9), (1.5, 0.1))
    for place, (start, end) in enumerate(JUMPS, EXPONENTS.index(k)):
        chi, share = curves[place % len(curves)]
        curve = _curve(k, start, chi, share, float(table["amplitude"]))
        energy, size = energy_between(table, curve, start, end)
        with mpmath.workdps(20):
            exact = _exact(k, curve, start, end, slow_pair)
        # two ends of ten terms, each of at most the size, and a sum of nodes of the size of z
        assert abs(energy - exact) <= 20 * EPS * (size + _of_nodes(start, end)), (start, end, chi, share)


@pytest.mark.parametrize("k", EXPONENTS)
def test_against_panels(k: float, table_of: Callable[[float], Any]) -> None:
    """Random jumps that keep what is asked of their size agree with quadrature, far out and near by."""
    rng = np.random.default_rng(5)
    table = table_of(k)
    kept = 0
    for _ in range(400):
        start = 10.0 ** rng.uniform(-1, 4)
        end = max(0.05, start + rng.uniform(-1.2, 1.2))
        curve = _curve(k, start, 10.0 ** rng.uniform(-2, 0.3), rng.uniform(0, 1), float(table["amplitude"]))
        energy, size = energy_between(table, curve, start, end)
        if abs(energy) < 0.01 * size:
            continue
        kept += 1
        other = energy_by_panels(table, curve, start, end, WORK)
        assert abs(energy - other) <= 20 * EPS * (size + _of_nodes(start, end) + abs(energy)), (curve, start, end)
    assert kept > 250


@pytest.mark.parametrize("k", EXPONENTS)
def test_long_ways_are_those_by_way_of_zero_contact(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    for start, end in ((0.05, 5.3), (5.1, 0.4), (4.4, 9.7)):
        curve = _curve(k, start, 0.7, 0.3, float(table["amplitude"]))
        level = depth(table, curve, start)
        whole = energy_from_zero(table, curve, end, level) - energy_from_zero(table, curve, start, level)
        energy, size = energy_between(table, curve, start, end)
        assert abs(energy - whole) <= 20 * EPS * size


def test_no_way_costs_nothing(table_of: Callable[[float], Any]) -> None:
    for x in (0.2, 5.0, 7.1, 300.0):
        energy, size = energy_between(table_of(0.41), Cosine(0.003, 0.9, 0.0), x, x)
        assert abs(energy) <= 2 * EPS * size


def test_no_size_is_known_of_too_long_a_jump(table_of: Callable[[float], Any]) -> None:
    _, size = energy_between(table_of(0.41), Cosine(0.003, 0.9, 0.0), 7.0, 9.0)
    assert size == np.inf
    _, size = energy_between(table_of(0.41), (0.003, 0.9, 0.2), 6.0, 6.2)
    assert size == np.inf
