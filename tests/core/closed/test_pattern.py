"""The area that the work of adhesion of a pattern weighs."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from gradhesion.core.closed.pattern import pattern_area
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

HARMONICS = (
    ToughnessHarmonic(n=1, cos=0.3, sin=-0.1),
    ToughnessHarmonic(n=4, sin=0.2),
    ToughnessHarmonic(n=5, cos=0.1),
)


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize(("wavelength", "radius"), [(0.31, 1.7), (0.31, 0.011), (5.0, 1e-4)])
def test_it_is_the_integral(of: str, wavelength: float, radius: float) -> None:
    def density(r: float) -> float:
        phase = 2.0 * math.pi * r / wavelength
        t = 1.0 + 0.9 * sum(h.cos * math.cos(h.n * phase) + h.sin * math.sin(h.n * phase) for h in HARMONICS)
        return 2.0 * math.pi * r * (t * t if of == "toughness" else t)

    ends = np.linspace(0.0, radius, 2 + math.ceil(10 * radius / wavelength))
    parts = [quad(density, a, b, epsabs=0.0, epsrel=1e-13)[0] for a, b in pairwise(ends)]
    assert pattern_area(Toughness(HARMONICS, of), 0.9, wavelength, radius) == pytest.approx(math.fsum(parts), rel=1e-14)


def test_it_broadcasts() -> None:
    found = pattern_area(Toughness(HARMONICS), [0.0, 1.0], 0.1, [[0.0], [0.5], [2.0]])
    assert found.shape == (3, 2)
    assert found[:, 0] == pytest.approx(math.pi * np.array([0.0, 0.25, 4.0]), rel=1e-15)
    assert found[0, 1] == 0.0
