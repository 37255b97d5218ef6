"""Profiles, controls, patterns and rates: what is refused, and what is left out."""

import dataclasses
import math
from typing import Any

import pytest

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic
from tests.core.scene import scene_of

SCENE = scene_of(0.31, 0.27, 430.0, 0.013, 0.11, 0.023, 0.7)
THRICE = (Harmonic(n=1), Harmonic(n=3), Harmonic(n=1))
REFUSED: list[tuple[Any, dict[str, Any], str]] = [
    *((Profile, {"exponent": value}, "exponent") for value in (0.99, math.inf, math.nan)),
    (Profile, {"harmonics": ()}, "harmonics"),
    (Profile, {"harmonics": tuple(Harmonic(n=n) for n in range(1, 66))}, "65"),
    (Profile, {"harmonics": THRICE}, r"\[1\]"),
    *((Harmonic, {"n": n}, f"n = {n}") for n in (0, 1.5)),
    *((Harmonic, {"n": 2} | bad, "n = 2") for bad in ({"cos": math.nan}, {"sin": math.inf})),
    (Loading, {"control": "force"}, "displacement, load, machine"),
    *((ToughnessHarmonic, {"n": n}, "whole number") for n in (0, 1.5, 10_001)),
    (ToughnessHarmonic, {"n": 1, "cos": math.inf}, "must be finite"),
    (Toughness, {"harmonics": ()}, "1 to 64"),
    (Toughness, {"harmonics": (ToughnessHarmonic(n=2, sin=0.1),) * 2}, "more than once"),
    (Toughness, {"harmonics": (ToughnessHarmonic(n=2, sin=0.1),), "of": "energy"}, "toughness, work"),
    *((Rate, {"exponent": value}, "exponent = ") for value in (0.0, 0.0999, 2.0001, math.nan, math.inf)),
    (Rate, {"exponent": 0.6, "closing": "slow"}, "closing = "),
]


@pytest.mark.parametrize(("kind", "values", "told"), REFUSED)
def test_what_is_out_of_range(kind: Any, values: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        kind(**values)


@pytest.mark.parametrize(
    ("given", "cos", "sin"),
    [({}, 1.0, 0.0), ({"sin": 0.2}, 0.0, 0.2), ({"cos": 0.0}, 0.0, 0.0), ({"cos": 0.3, "sin": 0.2}, 0.3, 0.2)],
)
def test_what_a_harmonic_leaves_out(given: dict[str, float], cos: float, sin: float) -> None:
    harmonic = Harmonic(n=3, **given)
    assert (harmonic.cos, harmonic.sin) == (cos, sin)
    assert dataclasses.replace(harmonic, n=3) == harmonic


def test_a_whole_number_is_a_power_like_any_other() -> None:
    """Kernels are compiled for floats: one of an integer would be compiled anew."""
    assert isinstance(Profile(exponent=3).exponent, float)
    assert Profile(exponent=3) == Profile(exponent=3.0)
