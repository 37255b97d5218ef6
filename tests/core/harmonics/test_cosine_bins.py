"""The integrals of the sines against Bessel functions of 40 digits, at the gate of the pair."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.harmonics.cosine_bins import build_cosine_bins, integral_at_zero
from gradhesion.core.harmonics.series import integrals
from gradhesion.core.struve.table import build_table

pytestmark = pytest.mark.slow


@kernel()
def both(table, cosines, x, x_low, out):  # type: ignore[no-untyped-def]
    for i in range(x.size):
        _, _, _, _, out[0, i], out[1, i] = integrals(table, cosines, x[i], x_low[i])


def _exact(k: float, x: mpmath.mpf, j: int) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return T_j and its local amplitude."""
    order, z = mpmath.mpf(k) / 2 + j, 2 * mpmath.pi * x
    front = mpmath.sqrt(mpmath.pi) / 2 * mpmath.gamma(order + 0.5)
    if z == 0:
        return front / mpmath.gamma(order + 1), mpmath.mpf(0)
    front *= (2 / z) ** order
    value = front * mpmath.besselj(order, z)
    return value, front * mpmath.hypot(mpmath.besselj(order, z), mpmath.bessely(order, z)) if z > 1.5 else 0


@pytest.mark.parametrize("k", [0.0, 1e-8, 0.1, 0.3, 0.5, 0.77, 0.9, 1.0 - 1e-8, 1.0])
def test_against_bessel_functions(k: float) -> None:
    rng = np.random.default_rng(1)
    switch = 40.0 / (2.0 * math.pi)
    x = np.concatenate(
        [
            [0.0, 1e-9, 0.25, np.nextafter(switch, 0.0), np.nextafter(switch, 9.0)],
            rng.uniform(0.0, switch, 60),
            10.0 ** rng.uniform(math.log10(switch), 2.6, 40),
        ]
    )
    low = x * rng.uniform(-1.0, 1.0, x.size) * 2.0**-54
    out = np.empty((2, x.size))
    both(build_table(k), build_cosine_bins(k).ravel(), x, low, out)
    with mpmath.workdps(40):
        for j in (0, 1):
            for place, below, found in zip(x.tolist(), low.tolist(), out[j].tolist(), strict=True):
                value, amplitude = _exact(k, mpmath.mpf(place) + below, j)
                assert abs(found - value) <= 1e-15 * max(abs(value), amplitude), (j, place)


def test_phase_far_out() -> None:
    """At k = 1, T0 is sin(z)/z: at 10^6 waves its phase is that of the exact x."""
    x = np.array([1e6 + 0.1, 12345.678, 1e9 + 0.25])
    low = np.array([1e-11, -1e-13, 0.0])
    out = np.empty((2, 3))
    both(build_table(1.0), build_cosine_bins(1.0).ravel(), x, low, out)
    with mpmath.workdps(40):
        for place, below, found in zip(x.tolist(), low.tolist(), out[0].tolist(), strict=True):
            z = 2 * mpmath.pi * (mpmath.mpf(place) + below)
            assert abs(found - mpmath.sin(z) / z) <= 1e-15 / z


def test_at_zero() -> None:
    assert integral_at_zero(0.0) == pytest.approx(math.pi / 2, rel=4e-16)
    assert integral_at_zero(1.0) == pytest.approx(1.0, rel=4e-16)
