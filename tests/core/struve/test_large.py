"""The expansion from z = 40 on: its slow parts against their integrals, and its agreement with the bins."""

from collections.abc import Callable
from typing import Any

import mpmath
import numba
import numpy as np
import pytest

from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.struve.pair import pair_above, pair_below
from gradhesion.core.struve.power import amplitude_power

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-12, 0.27, 0.5, 0.81, 1 - 1e-12, 1.0]


@numba.njit
def _both(table: Any, x: float) -> tuple[Any, Any]:
    z = TWO_PI * x
    return pair_below(table, x, z), pair_above(table, x, z, amplitude_power(table, z))


def _slow(table: Any, z: float) -> list[float]:
    w = SWITCH / z
    t = 2.0 * w * w - 1.0
    return [float(np.polynomial.polynomial.polyval(t, table["tail"][:, lane])) for lane in range(8)]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("z", [40.0, 47.3, 91.7, 1234.5])
def test_slow_parts_are_their_integrals(k: float, z: float, table_of: Callable[[float], Any]) -> None:
    re0, im0, re1, im1, g0, g1, h0, h1 = _slow(table_of(k), z)
    descent = []
    slow = []
    for j in (0, 1):
        alpha = (mpmath.mpf(k) - 1) / 2 + j
        # P_j = (-2 i z)^(1+alpha) U(1+alpha, 2+2 alpha, -2 i z), the confluent hypergeometric function of Tricomi
        descent.append((-2j * z) ** (1 + alpha) * mpmath.hyperu(1 + alpha, 2 + 2 * alpha, -2j * mpmath.mpf(z)))
        slow += [
            z * mpmath.quad(lambda u, a=alpha: (1 + u * u) ** a * mpmath.exp(-z * u), [0, 0.05, 0.3, 3, 9]),
            -z * z * mpmath.quad(lambda u, a=alpha: u * (1 + u * u) ** a * mpmath.exp(-z * u), [0, 0.05, 0.3, 3, 9]),
        ]
    exact = [
        descent[0].real,
        z * descent[0].imag,
        descent[1].real,
        z * descent[1].imag,
        slow[0],
        slow[2],
        slow[1],
        slow[3],
    ]
    for value, truth in zip([re0, im0, re1, im1, g0, g1, h0, h1], exact, strict=True):
        # eight roundings of a polynomial whose terms beyond the first are small; z Im P enters divided by z
        assert abs(value - truth) <= 4 * EPS * max(1.0, abs(float(truth)))


@pytest.mark.parametrize("k", EXPONENTS)
def test_it_meets_the_bins(k: float, table_of: Callable[[float], Any]) -> None:
    amplitude = SWITCH ** (-0.5 * (1 + k))
    sizes = np.array([amplitude, amplitude / SWITCH, amplitude, amplitude / SWITCH])
    for x in (SWITCH - np.linspace(1e-9, 1e-3, 50)) / TWO_PI:
        below, above = np.array(_both(table_of(k), x))
        assert (np.abs(below - above) <= 8 * EPS * np.maximum(sizes, np.abs(below))).all()
