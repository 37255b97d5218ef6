"""Zeros of functions whose zeros are known."""

import math
from collections.abc import Callable

import pytest

from gradhesion.core.rate.bracket import TRIALS, Bracket, is_found, narrowed, place_to_try


@pytest.mark.parametrize(
    ("function", "zero"),
    [
        (lambda x: x * x - 2.0, math.sqrt(2.0)),
        (lambda x: 2.0 - x * x, math.sqrt(2.0)),
        (lambda x: math.exp(-x) - 0.5, math.log(2.0)),
        (lambda x: -math.log(x) if x > 0.0 else math.inf, 1.0),
    ],
)
def test_a_zero(function: Callable[[float], float], zero: float) -> None:
    bracket, place = Bracket(0.0, 3.0, function(0.0), function(3.0), 0), math.nan
    trials = 0
    for _ in range(TRIALS):
        place, trials = place_to_try(bracket), trials + 1
        assert bracket.low < place < bracket.high
        value = function(place)
        if is_found(bracket, value, 1e-15):
            break
        bracket = narrowed(bracket, place, value)
    assert abs(function(place)) <= 4e-15
    assert abs(place - zero) < 1e-15
    assert trials <= 30
