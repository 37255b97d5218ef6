"""What jumps of the leading form of short waves lose, against quadrature of 25 digits of the form as printed."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis
from gradhesion.core.curve.short_wave import ShortWave, waves_of
from gradhesion.core.face import depth_at, loss_between, loss_from_zero, loss_to_zero

ONE = ((1, 1.0, 0.0),)
TWO = ((1, 1.0, 0.1), (3, -0.2, 0.3))
SHARE = 1e-13
"""Of the size of the terms: 16 nodes leave 2e-15 of the panel next to zero contact, and powers of z some roundings."""
EPSILON = 2.0**-52


def loss(k: float, waves: Any, curve: ShortWave, level: float, low: float, high: float) -> tuple[float, float]:
    """Return int z (1 - rho^2) dz, rho = (depth_H - level)/z^c, and the integral of the size of its terms."""
    B, m, g = (mpmath.mpf(value) for value in curve[:3])
    gradient = mpmath.mpf(k)
    c, shift = (1 - gradient) / 2, (1 + gradient) * mpmath.pi / 4
    C = 2 ** ((gradient - 1) / 2) * mpmath.gamma((1 + gradient) / 2)

    def square(z: Any) -> Any:
        wave = sum(
            mpmath.mpf(n) ** c * (even * mpmath.sin(n * z - shift) + odd * mpmath.cos(n * z - shift))
            for n, even, odd in waves
        )
        mean = g * sum(even for _, even, _ in waves)
        return z * ((B * z**m + mean - level) / z**c + g * C * wave) ** 2

    places = 2 * mpmath.pi * mpmath.mpf(low), 2 * mpmath.pi * mpmath.mpf(high)
    pieces = mpmath.linspace(*places, int(places[1] - places[0]) + 2)
    if low == 0.0:
        pieces = [0, *(pieces[1] * mpmath.mpf(10) ** -j for j in range(8, 0, -1)), *pieces[1:]]
    with mpmath.workdps(25):
        integral = mpmath.quad(square, pieces, method="gauss-legendre")
    plain = (places[1] ** 2 - places[0] ** 2) / 2
    return float(plain - integral), float(plain + integral)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "waves", "exponent"),
    [
        (0.0, ONE, 2.0),
        (0.0, TWO, 2.6),
        (0.37, TWO, 1.0),
        (0.37, ONE, 8.0),
        (0.37, TWO, 2.6),
        (1.0, TWO, 1.0),
        (1.0, ONE, 8.0),
    ],
)
def test_the_losses_are_the_integrals(k: float, waves: Any, exponent: float) -> None:
    table, _ = tables_of(k)
    basis = Basis(table, *waves_of(table, np.array(waves, dtype=float)))
    bend = 0.4 / (exponent * 40.0 ** (exponent - 1 - 0.5 * (1 - k)))
    curve = ShortWave(bend, exponent, 0.4 / float(table["amplitude"]), 1.0, 0.0)
    work = np.empty(16)
    for start, end in ((0.2, 1.3), (2.9, 2.1), (3.3, 11.7)):
        low, high = min(start, end), max(start, end)
        expected, size = loss(k, waves, curve, depth_at(basis, curve, start, 0.0), low, high)
        found = loss_between(basis, curve, start, end, work)
        assert abs(found - math.copysign(1.0, end - start) * expected) <= SHARE * size
    for x, level in ((0.4, 0.0), (2.6, 0.0), (0.4, -0.3), (2.6, 1.7)):
        expected, size = loss(k, waves, curve, level, 0.0, x)
        assert abs(loss_to_zero(basis, curve, x, level) + expected) <= SHARE * size
        if level == 0.0:
            assert abs(loss_from_zero(basis, curve, x) - expected) <= SHARE * size
    assert loss_from_zero(basis, curve, 0.0) == 0.0
    to_point = loss_between(basis, curve, 2.6, 0.0, work)
    assert to_point == pytest.approx(loss_to_zero(basis, curve, 2.6, depth_at(basis, curve, 2.6, 0.0)), rel=1e-13)
