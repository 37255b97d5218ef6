"""Eight numbers at once against one after the other: the same bits."""

import math
from typing import Any

import numba
import numpy as np
import pytest

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import sine_cosine_of_turns
from gradhesion.core.numbers.intrinsics import fma, make_horner
from gradhesion.core.numbers.lanes import (
    LANES,
    any_above,
    chosen,
    eight,
    floor_of,
    lane_of,
    load,
    next_lane,
    root_of,
    size_of,
    store,
    sum_of,
    with_lane,
)

_horner2 = make_horner(2, 5)


@kernel()
def operators_at_once(a: Any, b: Any, number: float, out: Any) -> None:
    """Put what operators and functions make of eight numbers into the rows of `out`."""
    x, y = load(a, 0), load(b, 0)
    store(out[0], 0, x + y)
    store(out[1], 0, x - number)
    store(out[2], 0, number * y)
    store(out[3], 0, x / y)
    store(out[4], 0, -x)
    store(out[5], 0, size_of(x))
    store(out[6], 0, root_of(size_of(x)))
    store(out[7], 0, floor_of(x))
    store(out[8], 0, fma(x, number, y))
    store(out[9], 0, chosen(x, y, number, x))
    store(out[10], 0, with_lane(eight(number), 3, lane_of(y, 5)))
    out[11, 0] = sum_of(x)


def test_operators_act_on_each_number() -> None:
    rng = np.random.default_rng(1)
    a, b, number = rng.normal(size=LANES), rng.normal(size=LANES), 0.37
    out = np.empty((12, LANES))
    operators_at_once(a, b, number, out)
    ones = [a + b, a - number, number * b, a / b, -a, np.abs(a), np.sqrt(np.abs(a)), np.floor(a)]
    for row, expected in zip(out, ones, strict=False):
        np.testing.assert_array_equal(row, expected)
    np.testing.assert_allclose(out[8], a * number + b, rtol=0, atol=2 * 2.0**-53)
    np.testing.assert_array_equal(out[9], np.where(a <= b, number, a))
    np.testing.assert_array_equal(out[10], np.where(np.arange(LANES) == 3, b[5], number))
    total = 0.0
    for value in a.tolist():
        total += value
    assert out[11, 0] == total


@kernel()
def is_any_above(a: Any, bound: float) -> bool:
    """Do what `any_above` does for the numbers of an array."""
    found: bool = any_above(load(a, 0), bound)
    return found


def test_any_above() -> None:
    a = np.arange(float(LANES))
    assert not is_any_above(a, LANES - 1.0)
    assert is_any_above(a, LANES - 1.5)
    a[2] = math.nan
    assert is_any_above(a, math.inf), "a NaN is not within"


@kernel(contract=True)
def both_ways(x: Any, coefficients: Any, out: Any) -> None:
    """Put sines, cosines and two polynomials into four rows, at once, and into four more, one after the other."""
    places = load(x, 0)
    sine, cosine = sine_cosine_of_turns(places)
    first, second = _horner2(coefficients, places)
    store(out[0], 0, sine)
    store(out[1], 0, cosine)
    store(out[2], 0, first)
    store(out[3], 0, second)
    for i in range(LANES):
        out[4, i], out[5, i] = sine_cosine_of_turns(x[i])
        out[6, i], out[7, i] = _horner2(coefficients, x[i])


def test_formulas_have_the_same_bits() -> None:
    rng = np.random.default_rng(2)
    coefficients, out = rng.normal(size=(5, 2)), np.empty((8, LANES))
    for size in (1.0, 1e3, 1e9, 2.0**48, 2.0**60):
        both_ways(size * rng.random(LANES), coefficients, out)
        np.testing.assert_array_equal(out[:4], out[4:])


def test_other_arrays_are_refused() -> None:
    with pytest.raises(numba.TypingError, match="neighbours"):
        is_any_above(np.arange(2.0 * LANES)[::2], 1.0)


@kernel()
def collected(numbers: Any, out: Any) -> None:
    """Put numbers into lanes, one behind the other."""
    values = eight(math.nan)
    for number in range(numbers.size):
        values = next_lane(values, number, numbers[number])
    store(out, 0, values)


@pytest.mark.parametrize("count", [1, 3, LANES])
def test_lanes_that_wait_for_others_hold_the_first(count: int) -> None:
    numbers, out = np.arange(2.0, 2.0 + count), np.empty(LANES)
    collected(numbers, out)
    np.testing.assert_array_equal(out, [*numbers, *[2.0] * (LANES - count)])
