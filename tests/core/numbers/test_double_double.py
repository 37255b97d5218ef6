"""Double-double arithmetic against exact rational arithmetic."""

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from gradhesion.core.numbers import double_double as dd

Pair = tuple[float, float]
TINY = 2.0**-102
"""Two roundings of the low part; the products that are left out are of this size too."""


def _exact(pair: Pair) -> Fraction:
    return Fraction(pair[0]) + Fraction(pair[1])


def _draws(count: int) -> list[tuple[Pair, Pair]]:
    rng = np.random.default_rng(3)
    draws = []
    for _ in range(count):
        high = rng.standard_normal(2) * 10.0 ** rng.uniform(-6, 6, 2)
        low = high * rng.uniform(-0.5, 0.5, 2) * 2.0**-53
        draws.append(((float(high[0]), float(low[0])), (float(high[1]), float(low[1]))))
    return draws


def _normal(pair: Pair) -> bool:
    return pair[0] + pair[1] == pair[0]


def test_two_sum_is_exact_jitted_and_plain() -> None:
    for (a, _), (b, _) in _draws(300):
        total = dd.two_sum(a, b)
        assert _exact(total) == Fraction(a) + Fraction(b)
        assert dd.two_sum.py_func(a, b) == total


def test_two_sum_of_a_hidden_term() -> None:
    assert dd.two_sum(1.0, 1e-300) == (1.0, 1e-300)
    assert dd.two_sum(1e-300, 1.0) == (1.0, 1e-300)


@pytest.mark.parametrize(
    ("function", "exact"),
    [
        (dd.multiply, lambda a, b: a * b),
        (dd.divide, lambda a, b: a / b),
    ],
)
def test_products(function: Callable[..., Pair], exact: Callable[..., Fraction]) -> None:
    for a, b in _draws(300):
        result = function(a, b)
        truth = exact(_exact(a), _exact(b))
        assert _normal(result)
        assert abs(_exact(result) - truth) <= 2 * TINY * abs(truth)


def test_sum() -> None:
    for a, b in _draws(300):
        result = dd.add(a, b)
        assert _normal(result)
        # relative to the terms: this sum may cancel
        assert abs(_exact(result) - _exact(a) - _exact(b)) <= TINY * (abs(_exact(a)) + abs(_exact(b)))


@pytest.mark.parametrize("factor", [3.0, -0.7, 1e-5])
def test_scale_and_shrink(factor: float) -> None:
    for a, _ in _draws(300):
        larger, smaller = dd.scale(a, factor), dd.shrink(a, factor)
        assert _normal(larger)
        assert _normal(smaller)
        assert abs(_exact(larger) - _exact(a) * Fraction(factor)) <= TINY * abs(_exact(larger))
        assert abs(_exact(smaller) - _exact(a) / Fraction(factor)) <= TINY * abs(_exact(smaller))
        assert abs(_exact(dd.shrink(larger, factor)) - _exact(a)) <= 2 * TINY * abs(_exact(a))
