"""The table of an exponent as a whole: what it records, and that it is the same however it is made."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.struve.layout import ARCHES, TABLE
from gradhesion.core.struve.table import build_table, struve_pair

EPS = 2.0**-52


@pytest.mark.parametrize("k", [0.0, 1e-16, 0.37, 0.5, 1 - 1e-12, 1.0])
def test_constants(k: float) -> None:
    table = build_table(k)
    amplitude = 2 ** ((mpmath.mpf(k) - 1) / 2) * mpmath.gamma((1 + mpmath.mpf(k)) / 2)
    phase = (1 + mpmath.mpf(k)) * mpmath.pi / 4
    assert table["k"] == k
    # gamma of the mathematical library is good to 3 ulp on [1/2, 1]
    assert abs(table["amplitude"] / amplitude - 1) <= 4 * EPS
    assert abs(table["phase"] / phase - 1) <= EPS
    assert abs(table["cos_phase"] - amplitude * mpmath.cos(phase)) <= 5 * EPS
    assert abs(table["sin_phase"] - amplitude * mpmath.sin(phase)) <= 5 * EPS


def test_no_coefficient_is_left_out() -> None:
    table = build_table(0.613)
    assert table.dtype == TABLE
    for name in TABLE.names or ():
        if name == "place" or np.asarray(table[name]).dtype.kind == "i":  # of what is interpolated
            assert not np.asarray(table[name]).any(), name
            continue
        values = np.asarray(table[name])
        assert np.isfinite(values).all(), name
        assert (values != 0.0).any(), name
    for name in ("bins", "tail", "power_mantissa", "power_exponent", "moment_series", "moment_bins"):
        assert (table[name] != 0.0).all(), name
    assert len(table["arches"]) == ARCHES + 1


def test_the_same_twice() -> None:
    assert build_table(0.29).tobytes() == build_table(0.29).tobytes()
    np.testing.assert_array_equal(build_table(0.0)["bins"], build_table(-0.0)["bins"])


def test_integers_are_exponents() -> None:
    assert struve_pair(1, 0.25).tolist() == struve_pair(1.0, 0.25).tolist()


def test_quarter_wave_at_exponent_one() -> None:
    s0, s1, d0, _ = struve_pair(1.0, 0.25)
    z = math.pi / 2
    np.testing.assert_allclose([s0, d0], [1 / z, (1 - 1 / z) / z], rtol=3 * EPS)
    np.testing.assert_allclose(s1, (1 - 2 * d0) / z, rtol=6 * EPS)
