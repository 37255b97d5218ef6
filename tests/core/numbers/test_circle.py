"""Sine and cosine of turns against 40 digits."""

import math

import mpmath
import numba
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.numbers.circle import TWO_PI, TWO_PI_LOW, sine_cosine_of_turns

EPS = 2.0**-52


@numba.njit
def _circle(x: NDArray[np.float64]) -> NDArray[np.float64]:
    out = np.empty((2, x.size))
    for i in range(x.size):
        out[0, i], out[1, i] = sine_cosine_of_turns(x[i])
    return out


def test_two_pi_in_two_parts() -> None:
    mpmath.mp.dps = 50
    assert abs(mpmath.mpf(TWO_PI) + mpmath.mpf(TWO_PI_LOW) - 2 * mpmath.pi) < 1e-32


@pytest.mark.parametrize("scale", [1e-9, 1e-3, 1.0, 1e3, 1e6, 1e11, 2.0**48])
def test_any_phase(scale: float) -> None:
    x = scale * np.random.default_rng(4).uniform(0, 1, 1000)
    sine, cosine = _circle(x)
    mpmath.mp.dps = 40
    for value, other, place in zip(sine, cosine, x, strict=True):
        turns = mpmath.mpf(place) - mpmath.nint(place)
        # relative, as the reduction is exact also next to a zero: the rounding of 2 pi r and 0.6 ulp of the polynomials
        exact, exact_cosine = mpmath.sinpi(2 * turns), mpmath.cospi(2 * turns)
        assert abs(value - exact) <= 1.5 * EPS * abs(exact)
        assert abs(other - exact_cosine) <= 1.5 * EPS * abs(exact_cosine)


def test_quarters_are_exact() -> None:
    x = np.concatenate([np.arange(64) / 4.0, 2.0**40 + np.arange(8) / 4.0, 2.0**49 - np.arange(1, 5) / 8.0])
    sine, cosine = _circle(x)
    turns = x % 1.0
    whole = (turns % 0.25) == 0.0
    np.testing.assert_array_equal(sine[whole], np.round(np.sin(TWO_PI * turns[whole])))
    np.testing.assert_array_equal(cosine[whole], np.round(np.cos(TWO_PI * turns[whole])))
    np.testing.assert_allclose(np.abs(sine[~whole & (turns % 0.125 == 0.0)]), math.sqrt(0.5), rtol=EPS)


def test_the_two_lie_on_the_circle() -> None:
    x = np.random.default_rng(5).uniform(0, 100, 10_000)
    sine, cosine = _circle(x)
    np.testing.assert_allclose(sine**2 + cosine**2, 1.0, rtol=2 * EPS)


def test_nan_and_inf_are_nan() -> None:
    assert np.isnan(_circle(np.array([math.nan, math.inf]))).all()


def test_zero() -> None:
    assert _circle(np.array([0.0])).tolist() == [[0.0], [1.0]]
