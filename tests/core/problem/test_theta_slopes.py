"""The slopes of theta against differentiation at 40 digits."""

import mpmath
import numpy as np
import pytest

from gradhesion.core.problem.material import theta_slopes


def _logarithm(k: mpmath.mpf, nu: mpmath.mpf) -> mpmath.mpf:
    """Give ln theta as it stands in section 2 of docs/theory.md."""
    beta = mpmath.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    c = 2 ** (1 + k) * mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2) / mpmath.gamma(2 + k)
    c /= mpmath.pi
    front = 2 ** (1 + k) * (1 + k) * mpmath.cos(k * mpmath.pi / 2) * mpmath.gamma(1 + k / 2)
    whole = front / (mpmath.sqrt(mpmath.pi) * c * beta * mpmath.sin(beta * mpmath.pi / 2) * mpmath.gamma((1 + k) / 2))
    return mpmath.log(whole)


@pytest.mark.parametrize(
    ("k", "nu"),
    [(0.3, 0.3), (0.9, 0.45), (0.999, 0.3), (0.5, 0.5), (0.9999, 0.5), (1e-4, 0.2), (0.7, -0.5), (0.999999, 0.5)],
)
def test_against_forty_digits(k: float, nu: float) -> None:
    mpmath.mp.dps = 40
    exponent, ratio = mpmath.mpf(k), mpmath.mpf(nu)
    by_k, by_nu = theta_slopes(k, nu)
    step = mpmath.mpf(10) ** -15
    exact_k = mpmath.diff(lambda t: _logarithm(t, ratio), exponent, h=step)
    exact_nu = mpmath.diff(lambda t: _logarithm(exponent, t), ratio, h=step)
    # sums of ten terms of the size of the digamma function; 1 - k has lost its last digits before
    assert abs(by_k - exact_k) <= 1e-13 * (1 + abs(exact_k))
    assert abs(by_nu - exact_nu) <= 1e-13 * (1 + abs(exact_nu))


def test_ends_of_the_range() -> None:
    by_k, by_nu = theta_slopes([0.0, 1.0], [0.3, 0.5])
    assert by_nu[0] == 0.0
    assert np.isnan(by_nu[1])
    near, _ = theta_slopes(1.0 - 1e-9, 0.5)
    assert by_k[1] == pytest.approx(float(near), abs=1e-7)
    outside = np.array(theta_slopes([1.0, -0.1, 0.5, 0.5], [0.3, 0.3, 0.6, -1.0]))
    assert np.all(np.isnan(outside))
