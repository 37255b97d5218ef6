"""What a scene tells of itself, by other routes: gains, saturation, roughness, residual, and which of them has no value."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import REPORTS, Harmonic, Loading, Profile, solve
from gradhesion.core.equations.jkr import indentation
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

SCENE: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.03}
SCENE |= {"a_max_over_R": 0.8}
VALUES = ("pull_off_force", "dissipated_energy")
GAINS = ("adhesion_gain", "energy_gain")
PATTERN = (ToughnessHarmonic(n=1, cos=0.2, sin=0.1), ToughnessHarmonic(n=3, sin=0.1))
LENGTH = {"toughness_wavelength_over_R": 0.13}
KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "plain": ({"a_max_over_R": np.array([0.05, 0.2, 0.8, np.inf])}, {}),
    "two works": ({"closing_ratio": np.array([0.4, 1.0])}, {}),
    "turned": ({"indentation_max_over_R": 0.05}, {}),
    "pattern of toughness": (LENGTH, {"toughness": Toughness(PATTERN)}),
    "pattern of work, machine": (
        LENGTH | {"machine_stiffness": 0.1},
        {"toughness": Toughness(PATTERN, "work"), "loading": Loading(control="machine")},
    ),
}


@pytest.mark.parametrize(("more", "how"), KINDS.values(), ids=KINDS)
def test_gains_are_those_over_the_smooth_punch_of_the_same_kind(more: dict[str, Any], how: dict[str, Any]) -> None:
    wavy, smooth = (solve(SCENE | more | change, (*VALUES, *GAINS), **how) for change in ({}, {"A": 0.0}))
    for value, gain in zip(VALUES, GAINS, strict=True):
        np.testing.assert_allclose(wavy[gain], wavy[value] / smooth[value], rtol=1e-14)
        assert np.all(smooth[gain] == 1.0)


def test_the_roughness_parameter_of_a_homogeneous_half_space() -> None:
    """chi = r/s; at k = 0, M = E*, s = sqrt(2 pi dgamma/M) and r = pi A lambda^(1/2)."""
    found = solve(SCENE | {"k": 0.0}, ("roughness_parameter",))["roughness_parameter"]
    r = math.pi * SCENE["A"] * math.sqrt(SCENE["lambda_over_R"])
    assert math.isclose(found, r / math.sqrt(2 * math.pi / SCENE["modulus"]), rel_tol=1e-14)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("waves", [(Harmonic(n=1),), (Harmonic(n=1), Harmonic(n=2, cos=0.3, sin=-0.2))])
def test_waves_that_are_short_gain_what_their_roughness_says(k: float, waves: tuple[Harmonic, ...]) -> None:
    """(1 + chi)^2, whether or not their crests are as sharp as their troughs."""
    short = SCENE | {"k": k, "lambda_over_R": 1e-5, "A": 3.0, "a_max_over_R": np.inf}
    found = solve(short, ("roughness_parameter", "adhesion_gain"), profile=Profile(harmonics=waves))
    assert math.isclose(found["adhesion_gain"], (1 + found["roughness_parameter"]) ** 2, rel_tol=1e-4)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.8, 0.97])
@pytest.mark.parametrize("amplitude", [0.0, 0.01, 0.05])
def test_nothing_folds_beyond_the_saturation_radius(k: float, amplitude: float) -> None:
    scene = SCENE | {"k": k, "A": amplitude}
    fold = float(solve(scene, ("saturation_radius",))["saturation_radius"])
    material = stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"])
    just = fold - np.array([2e-3, 1e-3, 0.0]) * min(fold, scene["lambda_over_R"])
    for radii, sign in ((np.linspace(fold, 4 * fold + 1.0, 4000), 1.0), (just, -1.0)):
        depths = indentation(k, material, radii, scene["lambda_over_R"], amplitude)
        assert np.all(sign * np.diff(depths) > 0.0)


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_a_pattern_saturates_too_and_leaves_the_roughness_of_the_punch(of: str) -> None:
    how, scene = {"toughness": Toughness(PATTERN, of)}, SCENE | {"A": 0.003, "toughness_wavelength_over_R": 0.04}
    found = solve(scene, ("saturation_radius", "roughness_parameter"), **how)
    beyond = found["saturation_radius"] * np.array([1.001, 2.0])
    one, other = solve(scene | {"a_max_over_R": beyond}, ["dissipated_energy"], **how)["dissipated_energy"]
    assert one == pytest.approx(other, rel=1e-12)
    chi = solve(SCENE | {"A": 0.003}, ["roughness_parameter"])["roughness_parameter"]
    assert found["roughness_parameter"] == pytest.approx(chi, rel=1e-13)


def test_what_has_no_report() -> None:
    many = solve(SCENE | {"lambda_over_R": 1e-5, "A": 0.05, "k": 0.0, "modulus": 1e4}, ("energy_residual",))
    assert np.isnan(many["energy_residual"])
    assert many["status"] & NO_VALUE == 0
    wrong = solve(SCENE | {"A": np.array([0.02, -1.0]), "a_max_over_R": np.array([-0.5, 0.5])}, REPORTS)
    assert np.isnan([wrong[name] for name in REPORTS]).all()
    with pytest.raises(ValueError, match="exact solver only"):
        solve(SCENE, ("energy_gain",), solver="envelope")
    with pytest.raises(ValueError, match="dead load"):
        solve(SCENE, ["energy_residual"], loading=Loading(control="load"))
