"""The machine operations against exact rational arithmetic."""

import math
import struct
from fractions import Fraction

import numba
import numpy as np
import pytest

from gradhesion.core.numbers.intrinsics import bits_of, float_of, fma, make_horner

_horner3 = make_horner(3, 5)


@numba.njit
def _fma(a: float, b: float, c: float) -> float:
    return fma(a, b, c)


@numba.njit
def _bits(value: float) -> int:
    return bits_of(value)


@numba.njit
def _float(bits: int) -> float:
    return float_of(bits)


@numba.njit
def _three(coefficients: np.ndarray, t: float) -> tuple[float, float, float]:
    return _horner3(coefficients, t)


def test_fma_rounds_once() -> None:
    rng = np.random.default_rng(1)
    for a, b in rng.standard_normal((500, 2)):
        c = -a * b  # what is left is the rounding error of the product
        assert _fma(a, b, c) == float(Fraction(a) * Fraction(b) + Fraction(c))
        assert _fma(a, b, 0.37) == float(Fraction(a) * Fraction(b) + Fraction(0.37))


@pytest.mark.parametrize("value", [0.0, -0.0, 1.0, -1.7, 5e-324, 1.7976931348623157e308, math.inf, -math.inf])
def test_bits_and_back(value: float) -> None:
    assert _bits(value) == struct.unpack("<q", struct.pack("<d", value))[0]
    assert struct.pack("<d", _float(_bits(value))) == struct.pack("<d", value)


def test_bits_of_nan() -> None:
    assert math.isnan(_float(_bits(math.nan)))


def test_horner_takes_every_lane_for_itself() -> None:
    rng = np.random.default_rng(2)
    for _ in range(100):
        coefficients, t = rng.standard_normal((5, 3)), rng.uniform(-1, 1)
        for lane, value in enumerate(_three(coefficients, t)):
            column = coefficients[:, lane].tolist()
            exact = sum(Fraction(c) * Fraction(t) ** j for j, c in enumerate(column))
            size = sum(abs(c) * abs(t) ** j for j, c in enumerate(column))
            # four steps of one or two roundings each
            assert abs(Fraction(value) - exact) <= 4 * 2.0**-52 * size
