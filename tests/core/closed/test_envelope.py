"""The envelopes against the loop integral of their load over depth, the numbers of the paper, and other theories."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.problem.profile import swings
from gradhesion.twin import stated
from gradhesion.twin.shape import Shape
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
    # a rim within that radius: the load of the envelope there, and continuous
    rim, K = 0.77 * a, 2 ** (1 - k) * M / (1 + k)
    load = K * (2 * rim ** (3 + k) / ((1 + k) * (3 + k)) - s * (1 + chi) * rim ** ((3 + k) / 2))
    at_rim, near = (envelope(scene_of_ratio(k, M, 0.0019, chi, one)) for one in (rim, a * (1 - 1e-9)))
    assert at_rim["pull_off_force"] == pytest.approx(-load / (1.5 * math.pi), rel=100 * EPS)
    assert at_rim["pull_off_radius"] == rim
    assert near["pull_off_force"] == pytest.approx(result["pull_off_force"], rel=100 * EPS)


def test_an_unbounded_punch_loses_without_end_with_waviness_alone() -> None:
    for profile in (None, PROFILE):
        scenes = (scene_of_ratio(0.37, 90.0, 0.01, chi, math.inf) for chi in (0.2, 0.0))
        wavy, smooth = (solve(scene, OUTPUTS, solver="envelope", profile=profile) for scene in scenes)
        assert wavy["dissipated_energy"] == wavy["delta_max"] == math.inf
        assert wavy["status"] == 0
        assert np.isfinite([wavy["pull_off_force"], smooth["dissipated_energy"]]).all()


def test_the_twin_has_the_same_envelopes() -> None:
    rng = np.random.default_rng(8)
    for _ in range(20):
        k = float(rng.choice([0.0, 1e-7, 0.23, 0.71, 1.0]))
        rim = math.inf if rng.random() < 0.1 else 10 ** rng.uniform(-2.0, 0.5)
        chi = 0.0 if rng.random() < 0.1 else 10 ** rng.uniform(-2.0, 0.5)
        scene = scene_of_ratio(k, 10.0 ** rng.uniform(0.0, 5.0), 10.0 ** rng.uniform(-4.0, -1.0), chi, rim)
        values = solve(scene, OUTPUTS, solver="envelope", profile=PROFILE)
        for name, one in stated.expected(scene, OUTPUTS, "envelope", Shape(1.4, WAVES)).items():
            assert stated.deviation(float(values[name]), one) <= one.error, name
