"""The waves of a profile and their derivatives by k: against differences of independent functions, near and far."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.harmonics.series import sums
from gradhesion.core.harmonics.series_by_k import sums_by_k

PAIR = np.array([[1.0, 1.0, 0.3], [3.0, 0.2, -0.1]])
MANY = np.array([[float(n), 1.0 / n, 0.3 / n**2] for n in range(1, 9)])
ROUNDING = 4e-12
"""Of differences of steps of 2^-9: 20 eps over the step."""
PLACES = [0.013, 0.4, 3.1, 6.3, 6.6, 17.2, 300.7]


def left_out(x: float) -> float:
    """Return what differences leave out over the wave: step^4/5 of the fifth derivative.

    That of 1/(1+k), which S0/z begins with, is 120 at k = 0, and far out that of z^(-k/2) is most.
    """
    return 2.0**-36 / 5 * (3.0 + 0.5 * math.log(1 + 2 * math.pi * x)) ** 5 + ROUNDING


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize("x", PLACES)
def test_of_one_cosine(k: float, x: float) -> None:
    """S0 and S1 by hypergeometric series of 30 digits."""
    cosine = np.array([[1.0, 1.0, 0.0]])
    (table, waves), (change, wave_change) = tables_of(k, cosine), changes_of(k, cosine)
    found = sums_by_k(table, waves, cosine, change[0], wave_change, x, 0.0)
    z = 2 * mpmath.pi * mpmath.mpf(x)

    def s0(exponent: mpmath.mpf) -> mpmath.mpf:
        return z / (1 + exponent) * mpmath.hyp1f2(1, mpmath.mpf(3) / 2, (3 + exponent) / 2, -z * z / 4)

    values, rates = (
        [of(one) for one in (k, k + 2)] for of in (lambda one: s0(mpmath.mpf(one)), lambda one: mpmath.diff(s0, one))
    )
    exacts, slopes = ((first, first - second) for first, second in (values, rates))
    amplitude = min(1.0, (2 * math.pi * x) ** (-0.5 * (1 + k)))
    for own, exact in zip(found[:2], exacts, strict=True):
        assert abs(own - float(exact)) < 1e-14 * max(amplitude, abs(float(exact)))
    for own, slope in zip(found[2:], slopes, strict=True):
        assert abs(own - float(slope)) < left_out(x) * amplitude


@pytest.mark.parametrize("rows", [PAIR, MANY])
@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize("x", PLACES)
def test_of_series(rows: np.ndarray, k: float, x: float) -> None:
    """Also from the table of a series: the values of harmonics/series.py, and their differences."""
    (table, waves), (change, wave_change) = tables_of(k, rows), changes_of(k, rows)
    found = sums_by_k(table, waves, rows, change[0], wave_change, x, 0.0)
    own = sums(table, waves, rows, x, 0.0)[:2]
    size = (1 + 2 * math.pi * x) ** (-0.5 * (1 + k)) * float(np.sum(rows[:, 0] ** 0.5 * np.abs(rows[:, 1])))
    np.testing.assert_allclose(found[:2], own, rtol=0, atol=1e-14 * size)
    step = 2.0**-8 if k < 0.5 else -(2.0**-8)
    around = [np.array(sums(*tables_of(k + i * step, rows), rows, x, 0.0)[:2]) for i in range(7)]
    weights = np.array([-147, 360, -450, 400, -225, 72, -10]) / 60  # of sixth order
    slopes = sum(weight * values for weight, values in zip(weights, around, strict=True)) / step
    np.testing.assert_allclose(found[2:], slopes, rtol=0, atol=left_out(x) * size)
