"""Sensitivities of force and energy on a patterned interface, against differences of the values."""

import itertools
import math

import numpy as np
import pytest

from gradhesion.core import SENSITIVITIES, Harmonic, Loading, Profile, solve
from gradhesion.core.problem.names import PARAMETERS, PATTERN
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

HARMONICS = (ToughnessHarmonic(n=1, cos=0.2, sin=0.1), ToughnessHarmonic(n=2, sin=0.1))
PROFILE = Profile(exponent=2.2, harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=2, cos=0.2)))
VALUES = ("pull_off_force", "dissipated_energy")
SCENE = {
    "k": 0.1,
    "nu": 0.3,
    "modulus": 300.0,
    "c0_over_R": 0.03,
    "lambda_over_R": 0.17,
    "A": 0.004,
    "a_max_over_R": 0.437,
    "toughness_wavelength_over_R": 0.113,
    "toughness_amplitude": 0.8,
}
TURN = {"indentation_max_over_R": 0.05, "a_max_over_R": 2.0}


@pytest.mark.parametrize("of", ["toughness", "work"])
@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_differences(of: str, control: str) -> None:
    known = {"toughness": Toughness(HARMONICS, of), "profile": PROFILE, "loading": Loading(control=control)}
    driven = SCENE | ({"machine_stiffness": 0.3} if control == "machine" else {})
    for turn, change in itertools.product(({}, TURN), ({}, {"A": 0.0, "k": 0.6})):
        scene = driven | turn | change
        names = [
            name for name in (*PARAMETERS, "machine_stiffness", "indentation_max_over_R", *PATTERN) if name in scene
        ]
        found = solve(scene, (*VALUES, *SENSITIVITIES), **known)
        step = 2e-5
        shape = (len(names), 4)
        points = {name: np.full(shape, value) for name, value in scene.items()}
        for row, name in enumerate(names):
            steps = step * np.array([-2, -1, 1, 2])
            points[name][row] = scene[name] + steps if name in PARAMETERS[:2] else scene[name] * np.exp(steps)
        beside = solve(points, VALUES, **known)
        for value, slopes in zip(VALUES, SENSITIVITIES, strict=True):
            expected = beside[value] @ [1, -8, 8, -1] / (12 * step) / float(found[value])
            assert found[slopes].shape == (len(names),)
            assert found[slopes] == pytest.approx(expected, rel=1e-7, abs=2e-8)


def test_the_sum_rule_of_similarity() -> None:
    """All lengths but a_max's own unit: 0 for the force in 1.5 pi R dgamma, 2 for the energy over R^2 dgamma."""
    found = solve(SCENE, SENSITIVITIES, toughness=Toughness(HARMONICS))
    for slopes, expected in zip(SENSITIVITIES, (0.0, 2.0), strict=True):
        _, _, modulus, c0, wavelength, amplitude, rim, pattern, _ = found[slopes].tolist()
        assert c0 + wavelength + amplitude + rim + pattern - 3.0 * modulus == pytest.approx(expected, abs=1e-12)


def test_forces_that_are_met_at_the_turn() -> None:
    """Short of the first groove that is jumped over, the force moves with the place of the turn."""
    wavy = {"modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.055, "toughness_amplitude": 0.2}
    scene = SCENE | wavy | {"a_max_over_R": math.inf, "indentation_max_over_R": 0.005}
    known = {"toughness": Toughness(HARMONICS, "work")}
    found = solve(scene, (*VALUES, *SENSITIVITIES), **known)
    assert int(found["status"]) & 4, "the pull-off is at the turn"
    step = 1e-4
    for column, name in ((2, "modulus"), (7, "indentation_max_over_R"), (8, PATTERN[0]), (9, PATTERN[1])):
        points = scene | {name: scene[name] * np.exp(step * np.array([-2, -1, 1, 2]))}
        beside = solve(points, VALUES, **known)["pull_off_force"]
        expected = beside @ [1, -8, 8, -1] / (12 * step) / float(found["pull_off_force"])
        assert float(found[SENSITIVITIES[0]][column]) == pytest.approx(float(expected), rel=1e-8), name


def test_without_a_given_amplitude_there_is_no_column_for_it() -> None:
    given = {name: value for name, value in SCENE.items() if name != "toughness_amplitude"}
    found = solve(given, SENSITIVITIES, toughness=Toughness(HARMONICS))
    assert found[SENSITIVITIES[0]].shape == (len(PARAMETERS) + 1,)
