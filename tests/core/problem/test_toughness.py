"""Patterns of toughness: what they may be, and where they have the sign that they must have."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core.problem.toughness import (
    Toughness,
    ToughnessHarmonic,
    first_violation,
    lowest,
    rows_of_pattern,
    violation,
)
from tests.core.scene import pattern_of


def drawn(seed: int, count: int = 3, most: int = 9) -> Toughness:
    rng = np.random.default_rng(seed)
    numbers = rng.choice(np.arange(1, most), count, replace=False).tolist()
    return pattern_of("toughness", *((n, rng.normal(), rng.normal()) for n in numbers))


def values(toughness: Toughness, end: float) -> tuple[Any, Any]:
    u = np.linspace(0.0, end, 200_001)
    phases = [2.0 * math.pi * harmonic.n * u for harmonic in toughness.harmonics]
    return u, sum(h.cos * np.cos(x) + h.sin * np.sin(x) for h, x in zip(toughness.harmonics, phases, strict=True))


@pytest.mark.parametrize("seed", range(12))
def test_the_lowest_value_and_the_first_radius_with_a_wrong_sign_are_those_of_a_dense_grid(seed: int) -> None:
    pattern, wavelength = drawn(seed), 0.37
    assert rows_of_pattern(Toughness((*pattern.harmonics, ToughnessHarmonic(n=64)))).shape == (3, 3)
    for end in (1.0, 0.3, 0.05):
        u, dense = values(pattern, end)
        assert -1e-6 < lowest(rows_of_pattern(pattern), end) - dense.min() < 1e-14
        for amplitude in (0.2, 0.7):
            below = 1.0 + amplitude * dense < 0.0
            found = violation(pattern, amplitude, wavelength, end * wavelength)
            assert (found is not None) == below.any()
            if found is not None:
                assert found == pytest.approx(u[np.argmax(below)] * wavelength, abs=2.0 * wavelength * u[1])


def test_a_toughness_may_vanish_at_a_radius_and_a_work_may_not() -> None:
    for even, odd, place in ((-1.0, 0.0, 0.0), (0.0, -1.0, 1.0 / 12.0)):
        tough, work = (pattern_of(of, (3, even, odd)) for of in ("toughness", "work"))
        assert first_violation(tough, 1.0) == math.inf
        assert first_violation(work, 1.0) == pytest.approx(place, abs=1e-7)
        assert first_violation(tough, 1.0 + 1e-9) == pytest.approx(place, abs=1e-4)
        assert first_violation(work, 1.0 - 1e-9) == math.inf
    assert violation(work, 1.0, 2.0, 0.16) is None, "it vanishes beyond the rim"


def test_many_harmonics_of_high_number() -> None:
    pattern = drawn(3, 64, 10_001)
    low = lowest(rows_of_pattern(pattern))
    assert violation(pattern, 0.999 / -low, 0.1, math.inf) is None
    assert violation(pattern, 1.001 / -low, 0.1, math.inf) is not None
