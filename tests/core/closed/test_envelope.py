"""The envelopes against the loop integral of their load over depth, the numbers of the paper, and other theories."""

import math
from typing import Any

import mpmath
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.problem.profile import swings
from tests.core.scene import EPS, adhesion, envelope_loop, profile_of, scene_of_ratio

EXPONENTS = [0.0, 0.2, 0.53, 0.9, 1.0 - 1e-9]
WAVES = ((1, 1.0, 0.1), (3, 0.2, -0.3), (4, 0.0, 0.2))
PROFILE = profile_of(1.4, *WAVES)
LOOPS = [*((k, 0.72, 5.8) for k in EXPONENTS), (0.2, 0.031, 0.21), (0.2, 0.72, 0.9), (0.2, 1.0, 1.63), (0.2, 2.6, 5.8)]


def envelope(scene: dict[str, Any]) -> dict[str, Any]:
    return solve(scene, OUTPUTS, solver="envelope")


@pytest.mark.parametrize(("k", "chi", "reach"), LOOPS)
def test_the_energy_is_the_loop_integral_of_load_over_depth(k: float, chi: float, reach: float) -> None:
    M, rim = 37.0, reach * 37.0 ** (-1 / (3 + k))
    scene, one = scene_of_ratio(k, M, 0.0023, chi, rim), chi * adhesion(k, M)
    up, down = (one * swing for swing in swings(k, WAVES))
    with mpmath.workdps(20):
        expected = [float(envelope_loop(k, M, *of, rim)) for of in ((2.0, one, one), (1.4, up, down))]
    assert envelope(scene)["dissipated_energy"] == pytest.approx(expected[0], rel=400 * EPS)
    found = solve(scene, ["dissipated_energy"], solver="envelope", profile=PROFILE)["dissipated_energy"]
    assert found == pytest.approx(expected[1], rel=2000 * EPS)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("chi", [0.23, 3.1])
def test_the_pull_off_force_is_that_of_a_smooth_punch_of_greater_adhesion(k: float, chi: float) -> None:
    M, s = 410.0, adhesion(k, 410.0)
    result = envelope(scene_of_ratio(k, M, 0.0019, chi, math.inf))
    assert result["pull_off_force"] == pytest.approx((3 + k) / 3 * (1 + chi) ** 2, rel=20 * EPS)
    a = float(result["pull_off_radius"])
    assert a ** ((3 + k) / 2) == pytest.approx((1 + k) * (3 + k) / 4 * s * (1 + chi), rel=50 * EPS)
