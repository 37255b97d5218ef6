"""The universal pair against stored 30-digit values, its identities and its closed forms."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, load, store
from gradhesion.core.struve.pair import first_functions
from gradhesion.core.struve.power import amplitude_powers
from gradhesion.core.struve.table import struve_pair

EPS = 2.0**-52
PLACES = np.concatenate([np.random.default_rng(8).uniform(0, 12, 2000), np.geomspace(1e-9, 1e6, 500)])
EXPONENTS = [0.0, 1e-12, 0.21, 0.5, 0.83, 1 - 1e-12, 1.0]


@kernel()
def first_at_once(table: Any, x: Any, out: Any) -> None:
    """Put S0 and z^(-n) at eight places into the rows of `out`."""
    places = load(x, 0)
    z = TWO_PI * places
    power = amplitude_powers(table, z)
    store(out[0], 0, first_functions(table, 0.0, places, z, power))
    store(out[1], 0, power)


@pytest.mark.parametrize("k", EXPONENTS)
def test_eight_at_once(k: float, table_of: Callable[[float], Any]) -> None:
    """Within, across and beyond z = 40, where the two forms meet."""
    out = np.empty((2, LANES))
    for low, high in [(0.1, 1.2), (5.9, 6.8), (6.4, 7.5), (90.3, 91.4)]:
        x = np.linspace(low, high, LANES)
        first_at_once(table_of(k), x, out)
        z = 2 * math.pi * x
        # a rounding or two apart, of the amplitude
        assert (np.abs(out[0] - struve_pair(k, x)[0]) <= 4 * EPS * z ** (-0.5 * (1 + k))).all()
        # of the power from its table, and of the other one
        assert (np.abs(out[1] / z ** (-0.5 * (1 + k)) - 1) <= 4 * EPS).all()


def test_the_reference(struve_rows: NDArray[np.float64], pair_error: Callable[..., NDArray[np.float64]]) -> None:
    worst = np.zeros(4)
    for k in np.unique(struve_rows[:, 0]):
        x = np.unique(struve_rows[struve_rows[:, 0] == k, 1])
        worst = np.maximum(worst, pair_error(k, x, struve_pair(k, x)).max(axis=1))
    # a polynomial of 0.6 ulp, or an amplitude, a sine and a slow part of about one rounding each
    assert (worst <= 5 * EPS).all(), worst / EPS


@pytest.mark.parametrize("k", [1e-15, 0.061, 0.449, 0.7183, 0.999999])
def test_other_exponents(k: float, slow_pair: Callable[..., tuple[mpmath.mpf, mpmath.mpf]]) -> None:
    for x in [1e-7, 0.03, 0.0796, 0.5, 1.77, 3.01, 6.3, 6.4, 9.9, 31.7]:
        z = 2 * mpmath.pi * mpmath.mpf(x)
        s0, s1 = slow_pair(k, z)
        exact = [s0, s1, (1 - z * s1) / (1 + k), ((1 + k) * s0 - (2 + k) * s1) / z]
        amplitude = float(min(z, z ** (-(1 + mpmath.mpf(k)) / 2)))
        for value, truth in zip(struve_pair(k, x), exact, strict=True):
            assert abs(value - truth) <= 5 * EPS * max(abs(float(truth)), amplitude)


@pytest.mark.parametrize("k", EXPONENTS)
def test_first_identity(k: float) -> None:
    s0, s1, d0, _ = struve_pair(k, PLACES)
    z = 2 * math.pi * PLACES
    size = 1 + z * np.abs(s1) + np.abs(d0) + z * (np.abs(s0) + np.abs(s1))
    # the last term of the size: z is rounded here
    assert (np.abs((1 + k) * d0 - (1 - z * s1)) <= 4 * EPS * size).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_second_identity(k: float) -> None:
    s0, s1, _, d1 = struve_pair(k, PLACES)
    z = 2 * math.pi * PLACES
    size = (1 + k) * np.abs(s0) + (2 + k) * np.abs(s1) + z * np.abs(d1) + z * (np.abs(s0) + np.abs(s1))
    assert (np.abs(z * d1 - (1 + k) * s0 + (2 + k) * s1) <= 4 * EPS * size).all()


def test_gradient_of_exponent_one() -> None:
    """S0 = (1 - cos z)/z and S1 from S0' = (1 - z S1)/2: double zeros of S0 at whole waves."""
    x = np.concatenate([PLACES[PLACES < 1e3], np.arange(1, 200), np.arange(1, 200) + 1e-9])
    s0, s1, _, _ = struve_pair(1.0, x)
    for place, value, other in zip(x, s0, s1, strict=True):
        z = 2 * mpmath.pi * mpmath.mpf(float(place))
        exact = 2 * mpmath.sin(z / 2) ** 2 / z
        exact_s1 = (1 - 2 * (mpmath.sin(z) - exact) / z) / z if z > 1e-3 else z / 4
        amplitude = float(min(z / 2, 1 / z))
        assert abs(value - exact) <= 4 * EPS * amplitude
        assert abs(other - exact_s1) <= 4 * EPS * max(float(exact_s1), amplitude) + float(min(z, 1e-3)) ** 3


def test_whole_waves_at_exponent_one() -> None:
    s0, s1, d0, _ = struve_pair(1.0, np.arange(1.0, 1000.0))
    z = 2 * math.pi * np.arange(1.0, 1000.0)
    assert (np.abs(s0) <= 3 * EPS / z).all()
    assert (np.abs(d0) <= 3 * EPS / z).all()
    np.testing.assert_allclose(s1, 1 / z, rtol=4 * EPS)


def test_zero_radius() -> None:
    for k in EXPONENTS:
        s0, s1, d0, d1 = struve_pair(k, 0.0)
        assert (s0, s1) == (0.0, 0.0)
        np.testing.assert_allclose([d0, d1], [1 / (1 + k), 1 / (3 + k)], rtol=2 * EPS)


def test_edges_of_bins_and_the_switch() -> None:
    """No step where one expansion hands over to the next."""
    edges = np.concatenate([np.arange(1, 80) * 0.5, [40.0]]) / (2 * math.pi)
    inside, outside = np.nextafter(edges, 0), np.nextafter(edges, 9)
    for k in EXPONENTS:
        s0, s1, d0, d1 = struve_pair(k, inside)
        slopes = np.array([d0, d1, s1 - s0])  # of S0, S1, S0'
        steps = (struve_pair(k, outside) - struve_pair(k, inside))[:3] - 2 * math.pi * slopes * (outside - inside)
        assert (np.abs(steps) <= 4 * EPS * np.maximum(np.abs([s0, s1, d0]), (6 * inside) ** -0.5)).all()


def test_shapes_and_nan() -> None:
    assert struve_pair(0.3, np.zeros((2, 3))).shape == (4, 2, 3)
    assert struve_pair(0.3, np.array([])).shape == (4, 0)
    values = struve_pair(0.3, [1.0, math.nan, 2.0])
    assert np.isnan(values[:, 1]).all()
    np.testing.assert_array_equal(values[:, [0, 2]], struve_pair(0.3, [1.0, 2.0]))


def test_continuous_in_the_exponent() -> None:
    for k in (0.0, 0.5, 1.0 - 2.0**-52):
        near = np.nextafter(k, 2.0)
        np.testing.assert_allclose(struve_pair(k, PLACES), struve_pair(near, PLACES), rtol=0, atol=8 * EPS)
