"""What a scene tells of itself, by other routes: gains, saturation, roughness, residual, and which of them has no value."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import REPORTS, Loading, solve
from gradhesion.core.equations.jkr import indentation
from gradhesion.core.problem.status import NO_VALUE
from tests.core.scene import Waves, material_of, pattern_of, profile_of, scene_of, strengths_of

SCENE = scene_of(0.3, 0.3, 500.0, 0.01, 0.1, 0.03, 0.8)
VALUES = ("pull_off_force", "dissipated_energy")
GAINS = ("adhesion_gain", "energy_gain")
PATTERN = ((1, 0.2, 0.1), (3, 0.0, 0.1))
LENGTH = {"toughness_wavelength_over_R": 0.13}
KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "plain": ({"a_max_over_R": np.array([0.05, 0.2, 0.8, np.inf])}, {}),
    "two works": ({"closing_ratio": np.array([0.4, 1.0])}, {}),
    "turned": ({"indentation_max_over_R": 0.05}, {}),
    "pattern of toughness": (LENGTH, {"toughness": pattern_of("toughness", *PATTERN)}),
    "pattern of work, machine": (
        LENGTH | {"machine_stiffness": 0.1},
        {"toughness": pattern_of("work", *PATTERN), "loading": Loading(control="machine")},
    ),
}


@pytest.mark.parametrize(("more", "how"), KINDS.values(), ids=KINDS)
def test_gains_are_those_over_the_smooth_punch_of_the_same_kind(more: dict[str, Any], how: dict[str, Any]) -> None:
    wavy, smooth = (solve(SCENE | more | change, (*VALUES, *GAINS), **how) for change in ({}, {"A": 0.0}))
    for value, gain in zip(VALUES, GAINS, strict=True):
        np.testing.assert_allclose(wavy[gain], wavy[value] / smooth[value], rtol=1e-14)
        assert np.all(smooth[gain] == 1.0)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("waves", [((1, 1.0, 0.0),), ((1, 1.0, 0.0), (2, 0.3, -0.2))])
def test_waves_that_are_short_gain_what_their_roughness_says(k: float, waves: Waves) -> None:
    """(1 + chi)^2, whether or not their crests are as sharp as their troughs; of one cosine chi = r/s."""
    short = SCENE | {"k": k, "lambda_over_R": 1e-5, "A": 3.0, "a_max_over_R": np.inf}
    found = solve(short, ("roughness_parameter", "adhesion_gain"), profile=profile_of(2.0, *waves))
    assert math.isclose(found["adhesion_gain"], (1 + found["roughness_parameter"]) ** 2, rel_tol=1e-4)
    s, r = strengths_of(short)
    assert (found["roughness_parameter"] == pytest.approx(r / s, rel=1e-13)) == (len(waves) == 1)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.97])
@pytest.mark.parametrize("amplitude", [0.0, 0.01, 0.05])
def test_nothing_folds_beyond_the_saturation_radius(k: float, amplitude: float) -> None:
    scene = SCENE | {"k": k, "A": amplitude}
    fold = float(solve(scene, ("saturation_radius",))["saturation_radius"])
    just = fold - np.array([2e-3, 1e-3, 0.0]) * min(fold, scene["lambda_over_R"])
    for radii, sign in ((np.linspace(fold, 4 * fold + 1.0, 4000), 1.0), (just, -1.0)):
        depths = indentation(k, material_of(scene), radii, scene["lambda_over_R"], amplitude)
        assert np.all(sign * np.diff(depths) > 0.0)


def test_what_has_no_report() -> None:
    many = solve(SCENE | {"lambda_over_R": 1e-5, "A": 0.05, "k": 0.0, "modulus": 1e4}, ("energy_residual",))
    assert np.isnan(many["energy_residual"])
    assert many["status"] & NO_VALUE == 0
    wrong = solve(SCENE | {"A": np.array([0.02, -1.0]), "a_max_over_R": np.array([-0.5, 0.5])}, REPORTS)
    assert np.isnan([wrong[name] for name in REPORTS]).all()
    with pytest.raises(ValueError, match="exact solver only"):
        solve(SCENE, ("energy_gain",), solver="envelope")
