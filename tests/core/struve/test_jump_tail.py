"""Oscillating and slow parts of the pair beyond z = 40 against Bessel functions, and their integral by quadrature."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.numbers.circle import TWO_PI

EPS = 2.0**-52
EXPONENTS = [0.0, 0.41, 1 - 1e-9, 1.0]
PLACES = [6.4, 7.3, 9.9, 31.0, 400.3]


def _lanes(rows: np.ndarray, z: float) -> np.ndarray:
    """The polynomials of a tail at z."""
    values: np.ndarray = np.polynomial.polynomial.polyval(2.0 * (40.0 / z) ** 2 - 1.0, rows)
    return values


def _parts(k: float, z: Any) -> tuple[Any, Any, Any]:
    """The oscillating part of S0, the rest of it, and the mean square of the first."""
    order = mpmath.mpf(k) / 2
    front = mpmath.sqrt(mpmath.pi) / 2 * mpmath.gamma((1 + mpmath.mpf(k)) / 2) * (2 / z) ** order
    even, odd = mpmath.besselj(order, z), mpmath.bessely(order, z)
    return front * odd, front * (mpmath.struveh(order, z) - odd), front**2 * (even**2 + odd**2) / 2


def _phases(table: Any, x: float) -> tuple[float, float]:
    """C z^(-n) sin psi and C z^(-n) cos psi."""
    power = (TWO_PI * x) ** (-0.5 * (1.0 + table["k"]))
    turns = complex(mpmath.expjpi(2 * mpmath.mpf(x)))
    sine, cosine = turns.imag, turns.real
    return (
        power * (sine * table["cos_phase"] - cosine * table["sin_phase"]),
        power * (cosine * table["cos_phase"] + sine * table["sin_phase"]),
    )


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("x", PLACES)
def test_parts_of_the_pair(k: float, x: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    z = TWO_PI * x
    lanes, (height, square) = _lanes(table["jump_tail"], z), _lanes(table["slow_tail"], z)
    s, c = _phases(table, x)
    with mpmath.workdps(30):
        wave, rest, mean = _parts(k, 2 * mpmath.pi * mpmath.mpf(x))
    amplitude = table["amplitude"] * z ** (-0.5 * (1.0 + k))
    assert abs(lanes[0] * s + lanes[1] / z * c - wave) <= 6 * EPS * amplitude
    assert abs(height / z - rest) <= 4 * EPS * rest
    assert abs(0.5 * amplitude**2 * square - mean) <= 4 * EPS * mean


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("x", PLACES[::2])
def test_integral_of_the_squares(k: float, x: float, table_of: Callable[[float], Any]) -> None:
    """From one place to another a little more than half a wave away, in units of z^(1+k) times the size of w0^2 z."""
    table = table_of(k)
    ends, size = [x, x + 0.61], 0.0
    values = []
    for place in ends:
        z = TWO_PI * place
        _, _, _, _, even1, odd1, even2, odd2 = _lanes(table["jump_tail"], z)
        s, c = _phases(table, place)
        values.append(
            z ** (1.0 + k) * (c * even1 - s * odd1 / z + z * (2.0 * s * c * even2 + (c * c - s * s) * odd2 / z))
        )
        size = max(size, z ** (1.0 + k) * (np.hypot(s, c) + z * np.hypot(s, c) ** 2))
    with mpmath.workdps(25):

        def integrand(z: Any) -> Any:
            wave, rest, mean = _parts(k, z)
            return z ** (k + 2) * (wave * (2 * rest + wave) - mean)

        exact = mpmath.quad(integrand, [2 * mpmath.pi * mpmath.mpf(place) for place in ends])
    # the phases of two places, and eight terms
    assert abs(values[0] - values[1] - exact) <= 12 * EPS * size


@pytest.mark.parametrize("k", EXPONENTS)
def test_series_of_the_stretch(k: float, table_of: Callable[[float], Any]) -> None:
    for eta in (-0.1, -0.03, 1e-9, 0.05, 0.1):
        value = np.polynomial.polynomial.polyval(eta, table_of(k)["inverse_stretch"])
        assert abs(value - (1.0 + eta) ** (-0.5 * (1.0 - k))) <= 4 * EPS
