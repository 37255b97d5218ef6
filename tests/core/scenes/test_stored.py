"""Scenes that were solved to 30 digits, as good as doubles can be; and what a scene tells of itself, by other routes."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, FLAGS, OUTPUTS, PARAMETERS, REPORTS, Loading, doubts_about, solve
from gradhesion.core.equations.jkr import indentation
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, NO_VALUE, PULL_OFF_AT_RIM
from tests.core.scene import EPS, Waves, material_of, pattern_of, profile_of, scene_of, strengths_of

SEVERAL = FLAGS["loading_contact_not_one_disc"]
JUMPS_MAY_DIFFER = 1e-10
"""Below this margin (tests/twin/README.md) a number of jumps is that of a neighbouring scene of doubles."""


@pytest.fixture(scope="module")
def stored() -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Parameters of 2,184 scenes, what is expected of them, and what is found."""
    file = json.loads((Path(__file__).parents[2] / "twin" / "scenes.json").read_text(encoding="utf-8"))
    columns = zip(file["columns"], zip(*file["scenes"], strict=True), strict=True)
    words = ("group", "note")
    numbers = {name: np.array(own, dtype=float) for name, own in columns if name not in words}  # null is NaN
    expected = {name: np.where(np.isnan(column), math.inf, column) for name, column in numbers.items()}
    scenes = {name: expected[name] for name in PARAMETERS}
    return scenes, expected, solve(scenes, OUTPUTS)


def test_values(stored: tuple[dict[str, Any], ...]) -> None:
    """Signed jumps may cancel, and a pull-off be flat: the conditions are the sizes of the terms over the result."""
    scenes, expected, found = stored
    assert found["status"].size == 2184
    assert not (found["status"] & FAILED).any()
    limits = {"pull_off_force": 64 * EPS, "dissipated_energy": 1e-12 * expected["energy_condition"]}
    limits["pull_off_radius"] = 1e-13 * np.maximum(1.0, expected["radius_condition"])
    for name, limit in limits.items():
        assert (np.abs(found[name] / expected[name] - 1.0) <= limit).all(), name
    bounded = np.isfinite(scenes["a_max_over_R"])
    for name in ("delta_max", "delta_jump_out"):  # differences of terms of the sizes a^2 and Delta, below 1 here
        far = np.isinf(expected[name])
        assert not (far & bounded).any()
        assert np.array_equal(np.isinf(found[name]), far)
        assert (np.abs(found[name][~far] - expected[name][~far]) <= 32 * EPS).all(), name
    unsure = expected["margin_jumps"] < JUMPS_MAY_DIFFER
    assert unsure.sum() <= 12
    for name in ("loading_jumps", "unloading_jumps"):
        assert (np.abs(found[name] - expected[name]) <= unsure).all(), name


def test_the_residual_is_rounding(stored: tuple[dict[str, Any], ...]) -> None:
    """The loop integral is another way to the energy; its own rounding grows with the load that cancels in it."""
    scenes, expected, together = stored
    found = solve(scenes, ("dissipated_energy", "energy_residual"))
    np.testing.assert_array_equal(found["dissipated_energy"], together["dissipated_energy"])
    share = np.abs(found["energy_residual"] / found["dissipated_energy"])
    assert np.median(share) <= 4e-14
    assert np.quantile(share[expected["loading_jumps"] <= 5], 0.99) <= 1e-12
    assert share[(found["status"] & CLOSE_TO_A_JUMP) != 0].max() <= 1e-9


def test_a_cycle_that_gains_is_flagged() -> None:
    """Weak adhesion: a state on the way of a jump is pressed shut at its edge, and the contact no single disc."""
    values = solve(scene_of(1.0, 0.5, 900.0, 0.1, 0.11, [0.0, 0.1, 2.3], 0.16))
    assert (values["status"] & SEVERAL).tolist() == [0, 0, SEVERAL]
    assert values["dissipated_energy"][2] < 0.0 < values["dissipated_energy"][1]
    assert doubts_about("loading_energy") & SEVERAL
    assert not doubts_about("unloading_energy") & SEVERAL


@pytest.mark.parametrize("A", [0.0, 1e-9])
def test_what_the_rim_decides(A: float) -> None:
    """Smooth contact has its pull-off at X = (3+k)/2 and lands at X = 2, in units of section 11 of docs/theory.md."""
    k, scene = 0.31, scene_of(0.31, 0.27, 173.0, 0.37, 0.043, A, 1.0)
    pull, land = (np.array([(3 + k) / 2, 2.0]) * 0.5 * (1 + k) * strengths_of(scene)[0]) ** (2 / (3 + k))
    rims = {"a_max_over_R": np.array([0.5 * pull, 0.999 * pull, 1.001 * pull, 0.999 * land, 1.001 * land])}
    status = solve(scene | rims, OUTPUTS)["status"]
    assert ((status & PULL_OFF_AT_RIM) != 0).tolist() == [True, True, False, False, False]
    assert ((status & JUMP_IN_TO_RIM) != 0).tolist() == [True, True, True, True, False]
    assert np.array_equal(solve(scene | rims, ("pull_off_force",))["status"], status & PULL_OFF_AT_RIM)


SCENE = scene_of(0.3, 0.3, 500.0, 0.01, 0.1, 0.03, 0.8)
VALUES = ("pull_off_force", "dissipated_energy")
GAINS = ("adhesion_gain", "energy_gain")
PATTERN = ((1, 0.2, 0.1), (3, 0.0, 0.1))
LENGTH = {"toughness_wavelength_over_R": 0.13}
OF_WORK = {"toughness": pattern_of("work", *PATTERN)}
BY_MACHINE = {"loading": Loading(control="machine")}
KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "plain": ({"a_max_over_R": np.array([0.05, 0.2, 0.8, np.inf])}, {}),
    "two works": ({"closing_ratio": np.array([0.4, 1.0])}, {}),
    "turned": ({"indentation_max_over_R": 0.05}, {}),
    "pattern of toughness": (LENGTH, {"toughness": pattern_of("toughness", *PATTERN)}),
    "pattern of work, machine": (LENGTH | {"machine_stiffness": 0.1}, OF_WORK | BY_MACHINE),
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
