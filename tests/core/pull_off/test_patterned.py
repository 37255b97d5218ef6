"""The pull-off on a patterned interface, against the lowest load on a dense grid."""

import math

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from tests.core.slow_pattern import SlowScene

HARMONICS = ((1, 0.5, -0.2), (3, 0.1, 0.2))
FORCE = ("pull_off_force", "pull_off_radius")


def pattern(of: str) -> Toughness:
    return Toughness(tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in HARMONICS), of)


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize(("length", "amplitude"), [(0.07, 0.0), (0.011, 0.002), (0.003, 0.001), (2.1, 0.02)])
def test_the_lowest_of_a_grid(of: str, length: float, amplitude: float) -> None:
    """With two wavelengths that have no common measure the lowest trough may stand waves from the lowest bound."""
    scene = {"k": 0.21, "nu": 0.2, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.0173, "A": amplitude}
    scene |= {"toughness_wavelength_over_R": length, "toughness_amplitude": 0.8}
    rows = [(n, 0.8 * even, 0.8 * odd) for n, even, odd in HARMONICS]
    slow = SlowScene(0.21, 0.2, 300.0, 0.1, 0.0173, amplitude, rows, length, of)
    radii = np.linspace(1e-4, 1.2, 240_001)
    loads = slow.state(radii)[1]
    rims = np.array([0.05, 0.17, 0.26, 1.2, math.inf])
    found = solve(scene | {"a_max_over_R": rims}, FORCE, toughness=pattern(of))
    for i, rim in enumerate(rims.tolist()):
        at_rim = float(slow.state(rim)[1]) if rim < math.inf else 0.0
        low = -min(float(loads[radii <= rim].min()), at_rim) / (1.5 * math.pi)
        assert -1e-13 * low <= float(found["pull_off_force"][i]) - low <= 3e-5 * low  # a grid misses the trough by that
        place = float(found["pull_off_radius"][i])
        assert -float(slow.state(place)[1]) / (1.5 * math.pi) == pytest.approx(
            float(found["pull_off_force"][i]), rel=1e-12
        )
        assert bool(found["status"][i] & 4) == (place == rim)


def test_far_out_the_lowest_trough_has_the_highest_toughness() -> None:
    fine = Toughness((ToughnessHarmonic(n=1, sin=1.0),))
    scene = {
        "k": 0.0,
        "nu": 0.3,
        "modulus": 500.0,
        "c0_over_R": 1.0,
        "lambda_over_R": 0.013,
        "A": 0.0,
        "a_max_over_R": 0.5,
    }
    scene |= {"toughness_wavelength_over_R": 5e-5, "toughness_amplitude": 0.3}
    assert float(solve(scene, FORCE, toughness=fine)["pull_off_force"]) == pytest.approx(1.3**2, rel=1e-7)
