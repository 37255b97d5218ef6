"""Cycles that were solved to 30 digits, as good as doubles can be; what a scene tells of itself; two works and patterns.

Other stored cycles, random ones against the twin, sums and neighbours are in tests/conformance.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, FLAGS, OUTPUTS, PARAMETERS, REPORTS, Loading, doubts_about, solve
from gradhesion.core.equations import hertz
from gradhesion.core.equations.jkr import adhesive_depth, indentation
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, NO_VALUE, PULL_OFF_AT_RIM, TOO_MANY_WAVES
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from tests.core.scene import ENDLESS, EPS, Waves, material_of, pattern_of, profile_of, scene_of, strengths_of

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


@pytest.mark.parametrize(
    ("k", "end"), [(0.31, {}), (0.32, {"indentation_max_over_R": 0.0005}), (0.33, {"load_max": 0.01})]
)
def test_the_saturation_radius_is_that_of_the_curve_wherever_a_cycle_ends(k: float, end: dict[str, float]) -> None:
    """Of some hundred waves that fold the cycle meets a few; it is solved first, as no longer table is kept then."""
    whole = scene_of(k, 0.3, 500.0, 0.01, 0.01, 0.03, math.inf)
    part = solve(whole | {"a_max_over_R": 0.03} | end, ("saturation_radius",))
    assert not part["status"] & FAILED
    expected = float(solve(whole, ("saturation_radius",))["saturation_radius"])
    assert 1.0 < expected < 2.0
    assert part["saturation_radius"] == pytest.approx(expected, rel=1e-12)


def test_what_has_no_report() -> None:
    many = solve(SCENE | {"lambda_over_R": 1e-5, "A": 0.05, "k": 0.0, "modulus": 1e4}, ("energy_residual",))
    assert np.isnan(many["energy_residual"])
    assert many["status"] & NO_VALUE == 0
    wrong = solve(SCENE | {"A": np.array([0.02, -1.0]), "a_max_over_R": np.array([-0.5, 0.5])}, REPORTS)
    assert np.isnan([wrong[name] for name in REPORTS]).all()
    with pytest.raises(ValueError, match="exact solver only"):
        solve(SCENE, ("energy_gain",), solver="envelope")


BALL = scene_of(0.1, 0.3, 500.0, 0.01, 0.1, 0.02, 0.5)
ROW = (1, 0.6, 0.8)


def test_without_adhesion_on_approach_contact_grows_as_hertz_has_it() -> None:
    """A paraboloid at the depth d touches within a = sqrt((1+k) d) (Hertz at k = 0)."""
    depth = np.array([0.001, 0.02, 0.3])
    scene = BALL | ENDLESS | {"A": 0.0, "indentation_max_over_R": depth, "closing_ratio": 0.0}
    found = solve(scene, ["turning_radius", "loading_jumps", "loading_energy", "snap_in_force"])
    np.testing.assert_allclose(found["turning_radius"], np.sqrt(1.1 * depth), rtol=4.0 * EPS)
    assert not found["loading_jumps"].any()
    assert not found["loading_energy"].any()
    assert np.isnan(found["snap_in_force"]).all()


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("exponent", [1.0, 1.3, 2.0])
def test_without_adhesion_on_approach_a_pattern_of_toughness_changes_nothing(exponent: float, control: str) -> None:
    """Loading follows the contact without adhesion; at k = 0 its first jump is within 1e-30 of a tip with a slope."""
    k, moduli = np.array([[0.0], [0.3]]), np.array([1e-3, 16.0, 1e6])
    scenes = scene_of(k, 0.5, moduli, 0.015, 0.0075, 0.011, 0.022, closing_ratio=0.0)
    scenes |= {"machine_stiffness": 0.3} if control == "machine" else {}
    names = ("loading_jumps", "loading_energy", "delta_max")
    how: dict[str, Any] = {"profile": profile_of(exponent, (1, -0.94, 0.33), (4, -0.56, 0.15))}
    how["loading"] = Loading(control=control)
    plain = solve(scenes, names, **how)
    pattern = {"toughness_wavelength_over_R": 0.03, "toughness_amplitude": 0.3}
    found = solve(scenes | pattern, names, toughness=pattern_of("toughness", (1, 1.0, 0.5)), **how)
    assert (plain["loading_jumps"] > 0).any()
    for name, rtol in zip(names, (0.0, 1e-9, 1e-12), strict=True):
        np.testing.assert_allclose(found[name], plain[name], rtol=rtol)


def test_what_has_no_bound_is_infinite() -> None:
    without = ("dissipated_energy", "front_energy", "pinned_depth")
    found = solve(BALL | ENDLESS | {"closing_ratio": [0.5, 1.0]}, [*without, "pull_off_force", "loading_energy"])
    for name in without:
        assert np.isinf(found[name]).tolist() == [True, False]
    assert found["pull_off_force"][0] == found["pull_off_force"][1]
    assert np.isfinite(found["loading_energy"]).all()


def test_a_contact_that_a_machine_presses_after_the_jump_has_no_pull() -> None:
    """The waves descend from the tip, so that contact begins under a load above 0."""
    profile = profile_of(3.0, (1, 0.31, -0.28), (2, 0.06, -0.07), (3, -0.38, -0.01))
    scene = scene_of(0.8, 0.3, 1200.0, 0.0433, 0.46, 0.0816, 0.72, closing_ratio=0.85)
    assert solve(scene, ["snap_in_force"], profile=profile)["snap_in_force"] < 0.0, "at depth 0 it is pressed"
    scene["machine_stiffness"] = np.array([0.01, 0.02, 0.04, 0.056, 0.1, 1.0, 100.0])
    held = solve(scene, ["snap_in_force"], profile=profile, loading=Loading(control="machine"))
    assert np.isnan(held["snap_in_force"]).all()


PLAIN = scene_of(0.23, 0.3, 400.0, 0.05, 0.1, 0.004, 0.47)
PATTERNED = PLAIN | {"toughness_wavelength_over_R": 0.07, "toughness_amplitude": 0.5}


def test_a_centre_without_adhesion() -> None:
    """Contact grows from a point and shrinks to one: nothing pulls, nothing is lost; whether it jumps there is rounding."""
    scene = PATTERNED | {"A": 0.0, "toughness_amplitude": 1.0, "toughness_wavelength_over_R": 3.0, "a_max_over_R": 0.2}
    found = solve(scene, OUTPUTS, toughness=pattern_of("toughness", (1, -1.0, 0.0)))
    assert float(found["pull_off_force"]) == 0.0
    assert np.isnan(found["pull_off_radius"])
    assert found["status"] & CLOSE_TO_A_JUMP
    for name in ("dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out"):
        assert abs(float(found[name])) < 1e-15 * float(found["delta_max"]), name  # of the terms that cancel


def test_patterns_are_followed_to_ten_thousand_waves() -> None:
    """Fine waves of chi on a smooth punch lose 4 pi chi a^2 beyond it, less by the order of their length (section 10)."""
    smooth, one = PLAIN | {"A": 0.0, "k": 0.0, "a_max_over_R": 0.5}, pattern_of("toughness", ROW)
    scene = smooth | {"toughness_amplitude": 0.3}
    found = solve(scene | {"toughness_wavelength_over_R": 5e-5}, OUTPUTS, toughness=one)
    assert found["status"] == 0
    assert min(int(found[name]) for name in ("loading_jumps", "unloading_jumps")) > 6_000
    up, down = (solve(smooth | {"modulus": 400.0 / w}, OUTPUTS) for w in (0.7**2, 1.3**2))
    limit = 0.7**2 * up["loading_energy"] + 1.3**2 * down["unloading_energy"] + math.pi * 0.25 * (1.3**2 - 0.7**2)
    assert float(found["dissipated_energy"]) == pytest.approx(float(limit), rel=2e-2)
    assert float(found["pull_off_force"]) == pytest.approx(1.3**2, rel=1e-7)
    finer = scene | {"toughness_wavelength_over_R": 5e-6}
    found = solve(finer | {"a_max_over_R": np.array([0.01, 0.5])}, ["dissipated_energy"], toughness=one)
    turned = solve(finer | {"load_max": 30.0}, ["dissipated_energy"], toughness=one)
    assert found["status"][1] == turned["status"] == NO_VALUE | TOO_MANY_WAVES
    assert not found["status"][0] & NO_VALUE, "a rim that is near enough has its values"


@pytest.mark.parametrize("wave", [[0.2], [0.2, 0.0]], ids=["one", "and an empty one"])
def test_a_rim_beyond_all_jumps_has_the_toughness_that_is_there(wave: list[float]) -> None:
    """The depth of a smooth punch at its rim: Hertz's, less what adhesion pulls the surface out."""
    punch = {"k": 0.2, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.05}
    rims, length = np.geomspace(0.5, 40.0, 9), 0.3
    scenes = punch | {"lambda_over_R": 0.2, "A": 0.0, "a_max_over_R": rims, "toughness_wavelength_over_R": length}
    own = Toughness(harmonics=tuple(ToughnessHarmonic(n=n, cos=size) for n, size in enumerate(wave, 1)))
    toughness = 1.0 + 0.2 * np.cos(2.0 * np.pi * rims / length)
    stretch = toughness * adhesive_depth(0.2, stiffness(**punch), rims)
    found = solve(scenes, ["delta_max"], toughness=own)["delta_max"]
    np.testing.assert_allclose(found, hertz.indentation(0.2, rims, 0.2, 0.0) - stretch, rtol=1e-12)
