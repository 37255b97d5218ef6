"""Minima that the noise allows are told apart where there are two valleys, and only there."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from gradhesion.core.loops.search.minima import others

COVARIANCE = np.diag([1.0, 4.0])


def at(x: float, y: float, rise: float) -> Any:
    """A minimum whose sum of squares is above that of the best by so much."""
    return SimpleNamespace(x=np.array([x, y]), cost=0.5 * (100.0 + rise))


def test_another_valley_is_named() -> None:
    best, other = at(0.0, 0.0, 0.0), at(20.0, 0.0, 2.0)
    assert others([best, other], COVARIANCE, 1.0) == [other]


def test_a_place_in_the_same_valley_is_none() -> None:
    """At 4 standard deviations a parabola has risen by 16: a rise of 15 is on its slope."""
    assert others([at(0.0, 0.0, 0.0), at(2.0, 2.0, 2.0)], COVARIANCE, 1.0) == []
    assert others([at(0.0, 0.0, 0.0), at(4.0, 0.0, 5.0)], COVARIANCE, 1.0) == []


def test_what_the_noise_does_not_allow_is_none_unless_there_is_more_noise() -> None:
    """95 % of chi square of two numbers are below 5.99."""
    pair = [at(0.0, 0.0, 0.0), at(40.0, 0.0, 6.5)]
    assert others(pair, COVARIANCE, 1.0) == []
    assert others(pair, COVARIANCE, 1.2) == pair[1:]


def test_one_of_two_that_are_alike_is_kept() -> None:
    found = others([at(0.0, 0.0, 0.0), at(20.0, 0.0, 1.0), at(20.5, 0.0, 1.1), at(-20.0, 0.0, 1.2)], COVARIANCE, 1.0)
    assert [one.x[0] for one in found] == [20.0, -20.0]
