"""The lowest load: against scans of the whole curve, at the rim, and against the parabola that ends its search."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.curve.cosine import Cosine, load, slope
from gradhesion.core.pull_off.cosine import load_at_rim, lowest_load
from gradhesion.core.struve.table import struve_pair

EPS = 2.0**-52
TWO_PI = 2 * math.pi
EXPONENTS = [0.0, 0.33, 0.78, 1 - 1e-12, 1.0]
X = np.concatenate([np.geomspace(1e-6, 0.01, 300), np.arange(0.01, 70.0, 0.005)])


def _loads(k: float, curve: Any, x: NDArray[np.float64]) -> NDArray[np.float64]:
    b, g, _ = curve
    s0, s1, _, _ = struve_pair(k, x)
    z = TWO_PI * x
    values: NDArray[np.float64] = z ** (1 + k) * (b * z * z / (3 + k) + g * z * (s0 - s1) - z ** (0.5 * (1 - k)))
    return values


def _curves(seed: int, count: int, k: float) -> list[Cosine]:
    rng = np.random.default_rng(seed)
    made = []
    while len(made) < count:
        b, g = 10.0 ** rng.uniform(-4, 1.5), 10.0 ** rng.uniform(-3, 0.7)
        if (0.5 * (3 + k) * (1 + 1.8 * g) * 2 / b) ** (2 / (3 + k)) < 300:
            made.append(Cosine(b, g, 0.0))
    return made


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("rim", [0.013, 0.41, 1.83, 7.7, math.inf])
def test_nothing_is_lower(k: float, rim: float, table_of: Callable[[float], Any]) -> None:
    for curve in _curves(30, 40, k):
        value, place, _ = lowest_load(table_of(k), curve, rim, 0.0)
        assert 0.0 < place <= rim
        scan = _loads(k, curve, X[rim >= X])
        assert value <= scan.min() + 16 * EPS * abs(scan.min())
        assert math.isclose(value, load(table_of(k), curve, place), rel_tol=8 * EPS)


@pytest.mark.parametrize("k", EXPONENTS)
def test_it_is_a_trough_or_the_rim(k: float, table_of: Callable[[float], Any]) -> None:
    for curve in _curves(31, 40, k):
        for rim in (0.3, 4.4, math.inf):
            _, place, _ = lowest_load(table_of(k), curve, rim, 0.0)
            d, d1, d2, _ = slope(table_of(k), curve, 0.5 * (3 + k), place)
            if place == rim:
                assert d <= 0.0 or lowest_load(table_of(k), curve, rim, 0.0)[0] < 0.0
            else:
                size = (3 + k) * (TWO_PI * place) ** (-0.5 * (1 + k))
                assert abs(d) <= 16 * EPS * size + 1e-11 * d1 * d1 / (abs(d2) + abs(d1))
                assert d1 > 0.0


@pytest.mark.parametrize("k", EXPONENTS)
def test_never_higher_for_a_larger_punch(k: float, table_of: Callable[[float], Any]) -> None:
    rims = [*np.geomspace(1e-3, 60.0, 400).tolist(), math.inf]
    for curve in _curves(32, 10, k):
        values = np.array([lowest_load(table_of(k), curve, rim, 0.0)[0] for rim in rims])
        assert (np.diff(values) <= 4 * EPS * np.abs(values[1:])).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_no_load_lies_below_the_parabola(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    z = TWO_PI * X
    for curve in _curves(33, 40, k):
        b, g, _ = curve
        abscissa = z ** (0.5 * (3 + k))
        floor = abscissa * (b * abscissa / (3 + k) - 1 - table["amplitude"] * g * (1 + 2.1 / z**2))
        size = abscissa * (b * abscissa / (3 + k) + 1 + g)
        assert (_loads(k, curve, X) >= floor - 8 * EPS * size).all()


def test_rim_keeps_its_rounding_error(table_of: Callable[[float], Any]) -> None:
    """The rim a_max/lambda is rounded; the second part of it moves the load along its slope."""
    table = table_of(0.33)
    curve = Cosine(0.0021, 0.8, 0.0)
    x, low = 17.3, 3e-9
    assert math.isclose(load_at_rim(table, curve, x, low), load(table, curve, x + low), rel_tol=1e-13)
    assert load_at_rim(table, curve, x, 0.0) == pytest.approx(load(table, curve, x), rel=4 * EPS)


def test_vanishing_waves_leave_the_smooth_punch(table_of: Callable[[float], Any]) -> None:
    """The lowest Y (Y/(3+k) - 1)/b is -(3+k)/4b at Y = b z^((3+k)/2) = (3+k)/2."""
    for k in EXPONENTS:
        for b in (0.01, 3.3):
            value, place, _ = lowest_load(table_of(k), Cosine(b, 1e-300, 0.0), math.inf, 0.0)
            assert math.isclose(value * b, -(3 + k) / 4, rel_tol=8 * EPS)
            assert math.isclose(b * (TWO_PI * place) ** (0.5 * (3 + k)), 0.5 * (3 + k), rel_tol=1e-11)


def test_short_waves_reach_the_envelope(table_of: Callable[[float], Any]) -> None:
    """Pull-off tends to (1 + C g)^2 that of the smooth punch as b falls at fixed gain: within 1/z of it."""
    for k in (0.0, 0.33, 0.78, 1.0):
        table = table_of(k)
        for g in (0.2, 1.1):
            chi = float(table["amplitude"]) * g
            for b in (1e-5, 1e-7):
                value, place, _ = lowest_load(table, Cosine(b, g, 0.0), math.inf, 0.0)
                limit = -(3 + k) / 4 * (1 + chi) ** 2
                assert abs(value * b / limit - 1) < 3.0 / (TWO_PI * place)
                assert value * b > limit * (1 + 3.0 / (TWO_PI * place) ** 2)
