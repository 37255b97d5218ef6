"""The law of a moving edge, checked."""

import math
from typing import Any

import pytest

from gradhesion.core.problem.toughness import EXPONENTS, Rate


def test_what_is_admitted() -> None:
    for exponent in EXPONENTS:
        assert Rate(exponent=exponent, closing="same").exponent == exponent


@pytest.mark.parametrize("exponent", [0.0, 0.0999, 2.0001, math.nan, math.inf])
def test_an_exponent_out_of_range(exponent: float) -> None:
    with pytest.raises(ValueError, match=r"exponent = "):
        Rate(exponent=exponent)


def test_an_unknown_closing() -> None:
    given: Any = {"exponent": 0.6, "closing": "fast"}
    with pytest.raises(ValueError, match="one of quasi-static, same"):
        Rate(**given)
