"""The bins below z = 40: the truncation of a series, and the stored coefficients against series of 50 digits."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.polynomial import chebyshev

from gradhesion.core.struve.bins import ECONOMISATION, economisation
from gradhesion.core.struve.layout import BIN_TERMS, BIN_WIDTH, BINS

EPS = 2.0**-52


def test_economisation_keeps_low_degrees() -> None:
    np.testing.assert_array_equal(economisation(19, 11)[:, :11], np.eye(11))


def test_economisation_is_truncation_in_chebyshev_polynomials() -> None:
    rng = np.random.default_rng(9)
    for taylor in rng.standard_normal((20, 19)):
        truncated = chebyshev.cheb2poly(chebyshev.poly2cheb(taylor)[:11])
        np.testing.assert_allclose(economisation(19, 11) @ taylor, truncated, rtol=0, atol=1e-12)


def test_economisation_of_one_power() -> None:
    """t^3 without T3/4 is 3 t/4."""
    assert economisation(4, 3)[:, 3].tolist() == [0.0, 0.75, 0.0]


def test_shape() -> None:
    assert ECONOMISATION.shape == (BIN_TERMS, 19)


@pytest.mark.parametrize("k", [0.0, 1e-12, 0.3, 0.5, 0.9, 1 - 1e-12, 1.0])
def test_bins_against_series(
    k: float, table_of: Callable[[float], Any], slow_pair: Callable[..., tuple[mpmath.mpf, mpmath.mpf]]
) -> None:
    mpmath.mp.dps = 50
    bins = table_of(k)["bins"]
    for i in [0, 1, 7, 23, 48, BINS - 1]:
        for t in (-1.0, -0.71, 0.0, 0.53, 1.0):
            z = mpmath.mpf(BIN_WIDTH) * (i + (1 + mpmath.mpf(t)) / 2)
            if z == 0:
                continue
            s0, s1 = slow_pair(k, z)
            exact = [s0 / z, s1 / z, (1 - z * s1) / (1 + k), ((1 + k) * s0 - (2 + k) * s1) / z]
            amplitude = min(1.0, float(z) ** (-0.5 * (1 + k)))
            sizes = [amplitude / max(1.0, float(z)), amplitude / max(1.0, float(z)) ** 2, amplitude]
            sizes.append(amplitude / max(1.0, float(z)))
            for lane in range(4):
                # the polynomial itself, in exact arithmetic: only the stored coefficients and the degree err
                value = sum(Fraction(c) * Fraction(t) ** j for j, c in enumerate(bins[i, :, lane].tolist()))
                error = abs(mpmath.mpf(value.numerator) / value.denominator - exact[lane])
                assert error <= 2 * EPS * max(sizes[lane], abs(float(exact[lane])))
