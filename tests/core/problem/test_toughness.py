"""Patterns of toughness: what they may be, and where they have the sign that they must have."""

import math

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


def drawn(seed: int, of: str = "toughness") -> Toughness:
    rng = np.random.default_rng(seed)
    numbers = rng.choice(np.arange(1, 9), 3, replace=False).tolist()
    return Toughness(tuple(ToughnessHarmonic(n=n, cos=rng.normal(), sin=rng.normal()) for n in numbers), of)


def values(toughness: Toughness, end: float) -> tuple[np.ndarray, np.ndarray]:
    u = np.linspace(0.0, end, 200_001)
    phases = [2.0 * math.pi * harmonic.n * u for harmonic in toughness.harmonics]
    return u, sum(h.cos * np.cos(x) + h.sin * np.sin(x) for h, x in zip(toughness.harmonics, phases, strict=True))


@pytest.mark.parametrize("n", [0, 1.5, 10_001])
def test_a_harmonic_out_of_range(n: float) -> None:
    with pytest.raises(ValueError, match="whole number"):
        ToughnessHarmonic(n=n)  # type: ignore[arg-type]


def test_patterns_out_of_range() -> None:
    one = ToughnessHarmonic(n=2, sin=0.1)
    with pytest.raises(ValueError, match="must be finite"):
        ToughnessHarmonic(n=1, cos=math.inf)
    with pytest.raises(ValueError, match="1 to 64"):
        Toughness(())
    with pytest.raises(ValueError, match="more than once"):
        Toughness((one, one))
    with pytest.raises(ValueError, match="toughness, work"):
        Toughness((one,), "energy")
    assert rows_of_pattern(Toughness((one, ToughnessHarmonic(n=1)))).tolist() == [[2.0, 0.0, 0.1]]


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("end", [1.0, 0.3, 0.05])
def test_the_lowest_value_is_that_of_a_dense_grid(seed: int, end: float) -> None:
    pattern = drawn(seed)
    _, dense = values(pattern, end)
    assert -1e-6 < lowest(rows_of_pattern(pattern), end) - dense.min() < 1e-14


@pytest.mark.parametrize("seed", range(20))
def test_the_first_radius_with_a_wrong_sign(seed: int) -> None:
    rng = np.random.default_rng(seed + 100)
    pattern, amplitude, end, wavelength = drawn(seed), rng.uniform(0.1, 1.0), rng.choice([0.2, 1.0]), 0.37
    u, dense = values(pattern, end)
    below = 1.0 + amplitude * dense < 0.0
    found = violation(pattern, amplitude, wavelength, end * wavelength)
    assert (found is not None) == below.any()
    if found is not None:
        assert found == pytest.approx(u[np.argmax(below)] * wavelength, abs=2.0 * wavelength * u[1])


def test_a_toughness_may_vanish_at_a_radius_and_a_work_may_not() -> None:
    for even, odd, place in ((-1.0, 0.0, 0.0), (0.0, -1.0, 1.0 / 12.0)):
        harmonic = (ToughnessHarmonic(n=3, cos=even, sin=odd),)
        assert first_violation(Toughness(harmonic), 1.0) == math.inf
        assert first_violation(Toughness(harmonic, "work"), 1.0) == pytest.approx(place, abs=1e-7)
        assert first_violation(Toughness(harmonic), 1.0 + 1e-9) == pytest.approx(place, abs=1e-4)
        assert first_violation(Toughness(harmonic, "work"), 1.0 - 1e-9) == math.inf
    assert violation(Toughness(harmonic, "work"), 1.0, 2.0, 0.16) is None, "it vanishes beyond the rim"


def test_many_harmonics_of_high_number() -> None:
    rng = np.random.default_rng(3)
    numbers = rng.choice(np.arange(1, 10_001), 64, replace=False).tolist()
    pattern = Toughness(tuple(ToughnessHarmonic(n=n, cos=rng.normal(), sin=rng.normal()) for n in numbers))
    low = lowest(rows_of_pattern(pattern))
    assert violation(pattern, 0.999 / -low, 0.1, math.inf) is None
    assert violation(pattern, 1.001 / -low, 0.1, math.inf) is not None
