"""The reference solver over patterns of toughness: kappa and its slopes."""

import pytest
from flint import arb

from gradhesion.twin.general import Shape
from gradhesion.twin.general.pattern import Pattern


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_slopes_of_kappa_are_those_of_differences(of: str) -> None:
    lengths = {"toughness_wavelength_over_R": 0.13, "toughness_amplitude": 0.9}
    pattern = Pattern(lengths, Shape(pattern=((1, 0.2, -0.1), (3, 0.05, 0.1)), pattern_of=of))
    a, step = arb(0.37), arb(2) ** -40
    (low, below, _), (kappa, first, second), (high, above, _) = (
        pattern.at(a * (1 + sign * step)) for sign in (-1, 0, 1)
    )
    assert float((high - low) / (2 * step)) == pytest.approx(float(first), rel=1e-10)
    assert float((above - below) / (2 * step)) == pytest.approx(float(second), rel=1e-10)
    assert abs(float(kappa)) <= pattern.greatest
