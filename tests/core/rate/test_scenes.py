"""Scenes of many waves, and of none."""

import math

import pytest

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.arrays.rate import close_at_speed, open_at_speed
from gradhesion.core.problem.profile import WAVY
from gradhesion.core.problem.rate import MOST_WAVES, Rate
from gradhesion.core.problem.status import NO_VALUE, TOLERANCE_NOT_MET, TOO_MANY_WAVES

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "a_max_over_R": 0.5, "speed_over_reference": 0.1}
LAW = Rate(exponent=0.6)


def test_short_waves_tend_to_none_and_to_the_toughness_that_they_add() -> None:
    """Waves of 1e-5 and of amplitude 1e-7 of that count for nothing; all ten thousand of them are followed."""
    waves = SCENE | {"lambda_over_R": 5e-5, "A": [0.0, 1e-7]}
    smooth, wavy = open_at_speed(waves, LAW, WAVY, Loading(), 1)["pull_off_force"]
    assert wavy == pytest.approx(smooth, rel=1e-5)


def test_waves_are_counted_by_the_shortest() -> None:
    many = SCENE | {"lambda_over_R": 4.0 * 0.5 / MOST_WAVES, "A": 1e-3}
    short = Profile(harmonics=(Harmonic(n=1), Harmonic(n=5, cos=0.1)))
    for solve_at_speed in (open_at_speed, close_at_speed):
        assert solve_at_speed(many, LAW, short, Loading(), 1)["status"] == NO_VALUE | TOO_MANY_WAVES
        smooth = many | {"A": 0.0, "lambda_over_R": 1e-9}
        assert solve_at_speed(smooth, LAW, short, Loading(), 1)["status"] == 0


def test_a_wavelength_does_not_matter_without_waves() -> None:
    smooth = SCENE | {"lambda_over_R": [1e-3, 0.1, 7.0], "A": 0.0}
    for name in ("pull_off_force", "opening_energy", "delta_jump_out"):
        one, *others = open_at_speed(smooth, LAW, WAVY, Loading(), 1)[name].tolist()
        assert others == pytest.approx([one, one], rel=1e-12)


def test_an_edge_that_is_too_slow_says_so() -> None:
    slow = SCENE | {"lambda_over_R": 0.1, "A": 0.01, "speed_over_reference": 1e-9}
    assert open_at_speed(slow, Rate(exponent=2.0), WAVY, Loading(), 1)["status"] & TOLERANCE_NOT_MET
    assert open_at_speed(slow, Rate(exponent=1.0), WAVY, Loading(), 1)["status"] == 0
    turned = slow | {"a_max_over_R": math.inf, "delta_max": 0.02}
    assert close_at_speed(turned, Rate(exponent=2.0), WAVY, Loading(), 1)["status"] & TOLERANCE_NOT_MET
