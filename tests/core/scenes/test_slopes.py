"""Sensitivities against reference values, differences of the values, similarity, and their limits."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import PARAMETERS, SENSITIVITIES, Harmonic, Loading, Profile, solve
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "sensitivities.json").read_text())
VALUES = ("pull_off_force", "dissipated_energy")
FURTHER = (
    "machine_stiffness",
    "indentation_max_over_R",
    "load_max",
    "closing_ratio",
    "toughness_wavelength_over_R",
    "toughness_amplitude",
)
"""Parameters beyond the seven, in the order of the last axis."""
SCENE = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": 500.0,
    "c0_over_R": 0.1,
    "lambda_over_R": 0.1,
    "A": 0.03,
    "a_max_over_R": 0.57,
}
PROMISED = 1e-8
STEP = 2e-5
PLACES = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
OF_DIFFERENCES = 1e-7
"""What a difference of fourth order of the values is good to: 10 eps over the step, and the square of a landing."""
Scenes = dict[str, NDArray[np.float64]]
BOTH = Profile(harmonics=(Harmonic(n=1, cos=0.8, sin=0.2), Harmonic(n=3, cos=0.1, sin=0.25)))
PATTERN = Toughness(harmonics=(ToughnessHarmonic(n=1, cos=0.4, sin=0.2), ToughnessHarmonic(n=2, cos=0.1)))
OF_WORK = Toughness(harmonics=PATTERN.harmonics, of="work")


def random_scenes(count: int, seed: int, low: float = -1.3, high: float = 0.0) -> Scenes:
    rng = np.random.default_rng(seed)
    return {
        "k": rng.uniform(0.01, 0.95, count),
        "nu": rng.uniform(-0.2, 0.48, count),
        "modulus": 10 ** rng.uniform(1.5, 3.5, count),
        "c0_over_R": 10 ** rng.uniform(-2.5, -0.5, count),
        "lambda_over_R": 10 ** rng.uniform(low, high, count),
        "A": 10 ** rng.uniform(-3, -1, count),
        "a_max_over_R": 10 ** rng.uniform(-1.0, 0.3, count),
    }


def columns(scenes: Scenes) -> list[str]:
    """Return the parameters of the last axis."""
    return [*PARAMETERS, *(name for name in FURTHER if name in scenes)]


def moved(scenes: Scenes, name: str, step: float) -> Scenes:
    """Return scenes with one parameter changed: k and nu by a step, others by a factor."""
    return {**scenes, name: scenes[name] + step if name in ("k", "nu") else scenes[name] * np.exp(step)}


def largest_error(scenes: Scenes, name: str, value: str, **settings: Any) -> tuple[float, int]:
    """Return the largest deviation of a sensitivity from differences of the values, and of how many scenes.

    Scenes whose jumps, or whose place of the pull-off, change between the steps are left out.
    """
    places = ["loading_jumps", "unloading_jumps", "pull_off_radius"]
    settings = {"check_contact": False, **settings}
    own = solve(scenes, [value, *places, f"{value}_sensitivity"], **settings)
    change, same = np.zeros(own["status"].shape), own[value] > 0.0
    for place, weight in PLACES.items():
        other = solve(moved(scenes, name, place * STEP), [value, *places], **settings)
        with np.errstate(all="ignore"):
            change += weight / STEP * other[value] / own[value]
        same &= (other[places[0]] == own[places[0]]) & (other[places[1]] == own[places[1]])
        same &= np.isclose(other[places[2]], own[places[2]], rtol=1e-3)
    found = own[f"{value}_sensitivity"][..., columns(scenes).index(name)]
    sizes = 1.0 + np.abs(own[f"{value}_sensitivity"]).max(axis=-1)
    return float((np.abs(found - change) / sizes)[same].max()), int(same.sum())


def test_reference_values() -> None:
    scenes = {name: np.array([one["input"][name] for one in REFERENCE]) for name in PARAMETERS}
    found = solve(scenes, SENSITIVITIES)
    for value in VALUES:
        exact = np.array([[one[value][name] for name in PARAMETERS] for one in REFERENCE])
        np.testing.assert_allclose(found[f"{value}_sensitivity"], exact, rtol=PROMISED, atol=PROMISED)


KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "one cosine": ({}, {}),
    "unbounded": ({"a_max_over_R": np.inf}, {}),
    "two harmonics under a load": ({}, {"profile": BOTH, "loading": Loading(control="load")}),
    "a cone": ({}, {"profile": Profile(exponent=1.0)}),
    "a machine": ({"machine_stiffness": 0.4}, {"loading": Loading(control="machine")}),
    "turned at a depth": ({"indentation_max_over_R": 0.02, "a_max_over_R": np.inf}, {}),
    "turned at a load": ({"load_max": 0.7, "a_max_over_R": np.inf}, {"profile": BOTH}),
    "two works": ({"closing_ratio": 0.4}, {}),
    "two works, turned": ({"closing_ratio": 0.4, "indentation_max_over_R": 0.02, "a_max_over_R": np.inf}, {}),
    "two works, turned where a jump lands": (
        {"closing_ratio": 0.4, "indentation_max_over_R": 1e-3, "a_max_over_R": np.inf, "machine_stiffness": 0.05},
        {"loading": Loading(control="machine")},
    ),
    "a pattern": ({"toughness_wavelength_over_R": 0.3, "toughness_amplitude": 0.7}, {"toughness": PATTERN}),
    "a pattern of the work, two works": (
        {"toughness_wavelength_over_R": 0.2, "toughness_amplitude": 0.7, "closing_ratio": 0.6},
        {"toughness": OF_WORK},
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_against_differences(kind: str) -> None:
    further, settings = KINDS[kind]
    scenes = random_scenes(80, 3)
    scenes |= {name: np.full(80, value) for name, value in further.items()}
    for name in columns(scenes):
        if np.isfinite(scenes[name]).all():
            for value in VALUES:
                error, number = largest_error(scenes, name, value, **settings)
                assert number > 50, (name, value)
                assert error < OF_DIFFERENCES, (name, value)


def test_long_curves_against_differences() -> None:
    scenes = random_scenes(10, 5, -2.9, -2.5) | {"a_max_over_R": np.full(10, 0.37)}
    for value in VALUES:
        for name in ("modulus", "A"):
            error, number = largest_error(scenes, name, value)
            assert number > 5
            assert error < OF_DIFFERENCES, (name, value)


def test_similarity() -> None:
    """Sums over the powers of R of the parameters, which are those of the values in units of R dgamma and of dgamma."""
    for control in ("displacement", "load"):
        found = solve(random_scenes(300, 8), SENSITIVITIES, check_contact=False, loading=Loading(control=control))
        for value, power in zip(VALUES, (0.0, 2.0), strict=True):
            of = dict(zip(PARAMETERS, np.moveaxis(found[f"{value}_sensitivity"], -1, 0), strict=True))
            terms = [of["c0_over_R"], of["lambda_over_R"], of["A"], of["a_max_over_R"], -3.0 * of["modulus"]]
            sizes = 1.0 + np.abs(terms).sum(axis=0)
            assert np.max(np.abs(sum(terms) - power) / sizes) < 1e-12


def test_the_smooth_cycle() -> None:
    """The energy is a number of k times M^(-2/(3+k)), and the force (3+k)/3 (section 3 of docs/theory.md)."""
    k = SCENE["k"]
    found = solve(SCENE | {"A": 0.0, "a_max_over_R": np.inf}, SENSITIVITIES)
    force, energy = (dict(zip(PARAMETERS, found[name], strict=True)) for name in SENSITIVITIES)
    assert energy["modulus"] == pytest.approx(-2.0 / (3.0 + k), rel=1e-12)
    assert abs(force["modulus"]) < 1e-12
    assert force["k"] == pytest.approx(1.0 / (3.0 + k), rel=1e-9)


def test_what_has_no_influence() -> None:
    smooth, ungraded, endless = (
        solve({**SCENE, **change}, SENSITIVITIES) for change in ({"A": 0.0}, {"k": 0.0}, {"a_max_over_R": np.inf})
    )
    for name in SENSITIVITIES:
        assert smooth[name][PARAMETERS.index("lambda_over_R")] == smooth[name][PARAMETERS.index("A")] == 0.0
        assert ungraded[name][PARAMETERS.index("c0_over_R")] == ungraded[name][PARAMETERS.index("nu")] == 0.0
        assert endless[name][PARAMETERS.index("a_max_over_R")] == 0.0


def test_the_softest_gradient() -> None:
    """At k = 1 only nu = 1/2 has a stiffness."""
    found, near = (solve(SCENE | {"k": k, "nu": 0.5}, SENSITIVITIES) for k in (1.0, 1.0 - 1e-7))
    for name in SENSITIVITIES:
        assert np.isnan(found[name]).tolist() == [parameter == "nu" for parameter in PARAMETERS]
        own, other = (np.delete(one[name], 1) for one in (found, near))
        np.testing.assert_allclose(own, other, rtol=1e-4, atol=1e-4)


def test_equal_works() -> None:
    """The derivative by the ratio is that from below, where the cycle turns; an unbounded cycle has none."""
    turned = {**SCENE, "indentation_max_over_R": 0.05}
    whole = solve({**turned, "closing_ratio": 1.0}, [VALUES[1], SENSITIVITIES[1]])
    below = [solve({**turned, "closing_ratio": 1.0 - step}, [VALUES[1]])[VALUES[1]] for step in (1e-4, 2e-4)]
    change = (1.5 * whole[VALUES[1]] - 2.0 * below[0] + 0.5 * below[1]) / 1e-4 / whole[VALUES[1]]
    assert whole[SENSITIVITIES[1]][-1] == pytest.approx(change, rel=1e-4)
    endless = solve({**SCENE, "a_max_over_R": np.inf, "closing_ratio": [0.5, 1.0]}, SENSITIVITIES)
    assert endless[SENSITIVITIES[0]][:, -1].tolist() == [0.0, 0.0]
    assert np.isnan(endless[SENSITIVITIES[1]][0]).all()
    assert np.isnan(endless[SENSITIVITIES[1]][1]).tolist() == [False] * 7 + [True]


def test_closing_without_adhesion() -> None:
    found = solve({**SCENE, "closing_ratio": [0.0, 1e-12]}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert found[name][0, -1] == 0.0
        np.testing.assert_allclose(found[name][0], found[name][1], rtol=1e-4, atol=1e-4)


def test_without_a_value_there_is_no_sensitivity() -> None:
    none = solve(SCENE | {"indentation_max_over_R": -0.1}, SENSITIVITIES)
    wrong = solve(SCENE | {"nu": [0.3, 0.7]}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert np.isnan(none[name]).all()
        assert np.isfinite(wrong[name][0]).all()
        assert np.isnan(wrong[name][1]).all()


def test_the_last_axis_has_what_is_given_in_order() -> None:
    further = {"machine_stiffness": 0.4, "indentation_max_over_R": 0.02, "closing_ratio": 0.4}
    further |= {"toughness_wavelength_over_R": 0.3, "toughness_amplitude": [[0.3], [0.5]]}
    outputs = [SENSITIVITIES[1], "delta_max", SENSITIVITIES[0]]
    settings: Any = {"toughness": PATTERN, "loading": Loading(control="machine")}
    found = solve({**SCENE, **further, "A": [0.01, 0.02, 0.03]}, outputs, **settings)
    assert list(found) == [*outputs, "status"]
    assert found[SENSITIVITIES[0]].shape == found[SENSITIVITIES[1]].shape == (2, 3, 12)
    alone = solve({**SCENE, **further, "toughness_amplitude": 0.5, "A": 0.02}, outputs, **settings)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(found[name][1, 1], alone[name])


def test_a_harmonic_is_a_wave_of_its_own() -> None:
    one = solve(SCENE, SENSITIVITIES, profile=Profile(harmonics=(Harmonic(n=3, cos=0.5),)))
    alike = SCENE | {"lambda_over_R": SCENE["lambda_over_R"] / 3, "A": 1.5 * SCENE["A"]}
    other = solve(alike, SENSITIVITIES)
    for name in SENSITIVITIES:
        np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-12)


def test_only_the_exact_solver_has_them() -> None:
    with pytest.raises(ValueError, match="pull_off_force_sensitivity"):
        solve(SCENE, SENSITIVITIES, solver="asymptotic")


def test_threads_make_no_difference() -> None:
    scenes = random_scenes(2500, 9)
    one, two = (solve(scenes, SENSITIVITIES, threads=threads) for threads in (1, 2))
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(one[name], two[name])
