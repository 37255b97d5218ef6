"""Interpolated tables against tables of their own."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.struve.interpolated import ROUNDING, interpolated_tables
from gradhesion.core.struve.layout import EXPONENT_SPAN, TABLE
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.table import build_table

EPS = 2.0**-52
EXPONENTS = np.concatenate([np.random.default_rng(3).uniform(0.0, 1.0, 24), [0.0, 1e-9, 0.5, 1.0 - 1e-9, 1.0]])


@pytest.fixture(scope="module")
def tables() -> tuple[NDArray[Any], NDArray[Any]]:
    """Give the tables of some exponents, interpolated and their own."""
    return interpolated_tables(EXPONENTS, whole=True), np.array([build_table(k) for k in EXPONENTS.tolist()])


def test_constants_are_no_polynomials(tables: tuple[NDArray[Any], NDArray[Any]]) -> None:
    found, own = tables
    for name in ("k", "amplitude", "phase", "cos_phase", "sin_phase"):
        np.testing.assert_array_equal(found[name], own[name])
    np.testing.assert_array_equal(own["rounding"], 1.0)
    np.testing.assert_array_equal(found["rounding"], ROUNDING)


@pytest.mark.parametrize("x", [1e-3, 0.11, 0.7, 1.9, 3.3, 6.2, 6.4, 30.0, 1e4, 1e9])
def test_the_pair(x: float, tables: tuple[NDArray[Any], NDArray[Any]]) -> None:
    for found, own, k in zip(*tables, EXPONENTS.tolist(), strict=True):
        z = 2.0 * math.pi * x
        wave = own["amplitude"] * z ** (-0.5 * (1.0 + k)) if z > 1.0 else 0.0
        for got, value in zip(pair(found, x), pair(own, x), strict=True):
            assert abs(got - value) <= 48 * EPS * max(abs(value), wave)


@pytest.mark.parametrize("field", ["moment_series", "moment_bins", "arches", "fractional", "theta", "theta_front"])
def test_the_other_fields(field: str, tables: tuple[NDArray[Any], NDArray[Any]]) -> None:
    found, own = tables
    sizes = np.abs(own[field])
    if field.endswith("bins"):  # a bin is a polynomial: its largest coefficient counts
        sizes = np.broadcast_to(sizes.max(axis=2, keepdims=True), sizes.shape)
    elif field == "arches":  # x, X and Q at both ends: at an inflection Q is nearly nothing
        sizes = np.maximum(sizes, np.roll(sizes, 3, axis=2)).max(axis=1, keepdims=True)
    elif field != "theta_front":
        sizes = sizes.max(axis=tuple(range(1, sizes.ndim)), keepdims=True)
    # 16 terms of a Chebyshev series; over 0 <= k <= 1 the last X, z^((3+k)/2) at z = 800, grows by 28, and 800 radians
    # known to an ulp leave 800 ulp of Q where it goes through zero
    assert (np.abs(found[field] - own[field]) <= (1024 if field == "arches" else 256) * EPS * sizes).all()


def test_powers_of_two(tables: tuple[NDArray[Any], NDArray[Any]]) -> None:
    found, own = tables
    span = np.abs(np.arange(2 * EXPONENT_SPAN) - EXPONENT_SPAN)
    # rounding the exponent k e costs its size in ulp
    error = np.abs(found["power_exponent"] / own["power_exponent"] - 1.0)
    assert (error <= (8.0 + span) * EPS).all()


def test_no_exponent_no_table() -> None:
    assert interpolated_tables(np.empty(0)).shape == (0,)
    assert interpolated_tables(np.empty(0)).dtype == TABLE
